"""What screening found is part of the verdict: effects that coarse, noisy or stuck motion sensors feign are not claimed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.quality import heed_flags
from ragg_runtime.io import Flight
from ragg_runtime.model.model import packaged
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.screening import screen
from tests.rate import RATE

pytestmark = pytest.mark.usefixtures("no_next_motion")

STEP = 32 / 65536 * 9.8
"""m/s^2: 16 bits over +-16 g."""


def test_what_is_odd_about_the_motion_is_the_reason_and_not_an_effect() -> None:
    s, model = scenario(3, duration=150.0, rate=RATE, trim="table-v"), packaged()
    x = s.simulate().flight()
    coarse = {n: np.round(x.channels[n] / STEP) * STEP for n in ("a_x", "a_y", "a_z")}
    rng = np.random.default_rng(1)
    noisy = {n: x.channels[n] + 1e-3 * rng.standard_normal(len(x)) for n in ("a_x", "a_y", "a_z")}
    still = {"a_x": np.full(len(x), float(np.mean(x.channels["a_x"])))}

    def judged(flights: list[Flight]) -> tuple[str, tuple[str, ...], str]:
        d = heed_flags(diagnose(model, s.sheet, flights), flights, lambda f: diagnose(model, s.sheet, f))
        return d.verdict, d.found, str(d.reason)

    for channels, words in (
        (noisy, "have a noise floor of"),
        (still, "a_x does not change at all"),
        (coarse, "in steps of"),
    ):
        flown = screen(model, s.sheet, replace(x, channels={**x.channels, **channels}))
        assert any(words in note for note in flown.notes)
        if channels is noisy:  # steps are noise as well
            continue
        verdict, found, reason = judged([flown])
        assert found == ()
        assert verdict == "adequate" or words in reason or "imitate" in reason
