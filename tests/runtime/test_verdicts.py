"""What a verdict needs besides quiet: an output that follows the motion, channels enough, and noise that is even."""

from __future__ import annotations

import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.identification import selection
from ragg_runtime.identification.comparison import compare
from ragg_runtime.identification.diagnose import complete_ranking, diagnose
from ragg_runtime.identification.dictionary import Term
from ragg_runtime.identification.result import group_findings
from ragg_runtime.identification.verdict import _of_one_kind
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.model import packaged
from ragg_runtime.reference.scenario import scenario

pytestmark = pytest.mark.usefixtures("no_next_motion")


def flown(seed: int = 3, duration: float = 90.0) -> tuple[Instrument, Flight]:
    s = scenario(seed, duration=duration)
    return s.sheet, s.simulate().flight()


def test_an_output_in_which_nothing_follows_the_motion_is_not_adequate() -> None:
    sheet, x = flown()
    shuffled = np.random.default_rng(1).permutation(x.outputs["G_out"])
    d = diagnose(packaged(), sheet, [replace(x, outputs={"G_out": shuffled})])
    assert (d.verdict, d.found) == ("unexplained", ())
    assert "the output does not follow the motion" in str(d.as_json()["reason"])
    assert d.explained is not None and d.explained.share < 0.5
    c = compare(packaged(), sheet, [replace(x, outputs={"G_out": shuffled})])
    assert not c.adequate


def test_a_right_model_explains_nearly_all() -> None:
    sheet, x = flown()
    c = compare(packaged(), sheet, [x])
    said = c.as_json()["explained"]
    assert c.adequate and isinstance(said, dict)
    assert 0.999 < said["share"] < 1.0


def test_noise_that_follows_the_motion_is_said_and_accuses_nothing() -> None:
    s = scenario(11, duration=300.0)
    sim = s.simulate()
    x = sim.flight()
    a = np.abs(x.channels["a_x"])
    noise = (sim.G_out - sim.G_out_noise_free) * (0.2 + a / np.sqrt(np.mean(a**2)))
    d = diagnose(packaged(), s.sheet, [replace(x, outputs={"G_out": sim.G_out_noise_free + noise})])
    assert d.verdict == "adequate"
    assert "the noise level changes with abs(a_x)" in str(d.as_json()["reason"])


@pytest.mark.parametrize(("frequency", "own"), [(0.5003, False), (0.5, True)])
def test_a_line_beside_a_multiple_of_the_spin_rate_accuses_nothing(frequency: float, own: bool) -> None:
    """At 300 s it slips by a tenth of a turn. What keeps step with the disc is the disc's."""
    s = scenario(12, duration=300.0)
    sim = s.simulate()
    x = sim.flight()
    size = 1.4 * np.std(sim.G_out - sim.G_out_noise_free)
    G = sim.G_out + size * np.cos(2 * np.pi * frequency * x.time + 1.0)
    d = diagnose(packaged(), s.sheet, [replace(x, outputs={"G_out": G})])
    assert d.ranking[0].log_p < -20.0  # an effect alone would be beyond doubt
    if own:
        assert d.verdict == "missing-effect"
        said = str(d.as_json()["reason"])
        assert f"{d.found[0]} acts as a constant term at twice the spin rate" in said
        assert "gradient-offset" in said  # of those that would do as well
        (group,) = d.groups
        assert group.name == "a constant term at twice the spin rate"
        assert group.effects[0] == d.found[0] and "gradient-offset" in group.effects
        assert f"Missing: one of {d.found[0]}" in d._repr_html_()
        assert f"; {group.name} explains as much: they are one finding" in d._repr_html_()
        return
    assert (d.verdict, d.found) == ("unexplained", ())
    said = re.search(r"a line at about ([0-9.]+) Hz", str(d.as_json()["reason"]))
    assert said is not None
    assert abs(float(said[1]) - frequency) < 0.2 / 300.0
    assert [t.kind for r in d.remainder.searches for t in r.terms] == ["line"]


def test_effects_that_look_alike_are_named_by_what_they_share() -> None:
    alike: Any = [SimpleNamespace(effect="spin-axis-tilt", indistinguishable_from=("imu-misalignment",))]
    shared: Any = SimpleNamespace(term=Term("cos 1", ("a_z",)))
    (group,) = group_findings(("spin-axis-tilt",), alike, (), shared)
    assert group.as_json() == {
        "name": "a term proportional to a_z at the spin rate",
        "effects": ["spin-axis-tilt", "imu-misalignment"],
    }
    (alone,) = group_findings(("bias-drift",), alike, (), shared)
    assert alone.name is None


@pytest.mark.parametrize(
    ("lost", "testable"),
    [
        (("B_z", "pitch"), {"magnetic-bias", "self-gradient"}),
        (("roll",), {"magnetic-bias", "self-gradient"}),
        (("B_x", "B_y", "B_z"), {"self-gradient"}),
        (("roll", "pitch"), {"magnetic-bias"}),
    ],
)
def test_an_effect_is_tested_with_the_channels_that_are_there(
    lost: tuple[str, ...], testable: set[str]
) -> None:
    sheet, x = flown(duration=40.0)
    x = replace(x, channels={n: v for n, v in x.channels.items() if n not in lost})
    found = selection.list_testable(fit(packaged(), sheet, observe_flights([x], sheet)))
    assert {"magnetic-bias", "self-gradient"} & set(found) == testable


def test_what_the_recorder_did_is_claimed_where_generic_terms_do_as_well_as_effects() -> None:
    """What remains is then that of the model without effects, which has other columns than the last fit."""
    evidence: Any = SimpleNamespace(steps=(), last=None)
    rival: Any = SimpleNamespace(verdict="partly-explained", rival=True, remains=True, claims=("saturation",))
    row: Any = SimpleNamespace(effect="saturation")
    assert complete_ranking([row], 0.0, evidence, rival) == [row]  # type: ignore[arg-type]


def test_the_low_frequencies_of_an_accelerometers_resonance_are_not_two_effects() -> None:
    fitted = SimpleNamespace(model=packaged())
    found: Any = SimpleNamespace(
        first=SimpleNamespace(fitted=fitted), alternatives=lambda: {"arm-sag": ("second-order-loop",)}
    )
    assert _of_one_kind(found, ("lag", "second-order-loop")) == "accelerometer-resonance"
    assert _of_one_kind(found, ("lag", "arm-sag")) == "accelerometer-resonance"
    assert _of_one_kind(found, ("lag", "thermal-scale")) is None
