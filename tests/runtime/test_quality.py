"""What screening found is part of the verdict: effects that coarse, noisy or stuck motion sensors feign are not claimed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.quality import heed_flags
from ragg_runtime.model.model import packaged
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.screening import screen, timing
from tests.rate import RATE

pytestmark = pytest.mark.usefixtures("no_next_motion")

STEP = 32 / 65536 * 9.8
"""m/s^2: 16 bits over +-16 g."""


def test_what_is_odd_about_the_motion_is_the_reason_and_not_an_effect(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(timing, "propose_times", lambda *_: [])  # test_screening_mistakes.py has these
    s, model = scenario(3, duration=150.0, rate=RATE, trim="table-v"), packaged()
    x = s.simulate().flight()
    rng = np.random.default_rng(1)
    changed = {
        "in steps of": {n: np.round(x.channels[n] / STEP) * STEP for n in ("a_x", "a_y", "a_z")},
        "have a noise floor of": {
            n: x.channels[n] + 1e-3 * rng.standard_normal(len(x)) for n in ("a_x", "a_y", "a_z")
        },
        "a_x does not change at all": {"a_x": np.full(len(x), float(np.mean(x.channels["a_x"])))},
    }
    flown = {
        words: screen(model, s.sheet, replace(x, channels={**x.channels, **channels}))
        for words, channels in changed.items()
    }
    for words, flight in flown.items():
        assert any(words in note for note in flight.notes)
    coarse, still = flown["in steps of"], flown["a_x does not change at all"]
    d = diagnose(model, s.sheet, [coarse])
    heeded = heed_flags(d, [coarse], lambda f: diagnose(model, s.sheet, f))
    assert heeded.found == ()
    assert (
        heeded.verdict == "adequate" or "in steps of" in str(heeded.reason) or "imitate" in str(heeded.reason)
    )
    assert d.verdict != "adequate"
    heeded = heed_flags(d, [still], lambda _: pytest.fail("there is no noise to feign anything"))
    assert (heeded.verdict, heeded.found) == ("unexplained", ())
    assert "a_x does not change at all" in str(heeded.reason)
