"""Resonances of a mount and of an accelerometer: found, with their frequency and Q, where the simulator has integrated them in time."""

from __future__ import annotations

import numpy as np
import pytest
from diagnosed import diagnosed

from ragg_runtime.estimation import fitted
from ragg_runtime.estimation.observation import observe
from ragg_runtime.model import derive
from ragg_runtime.model import model as load
from ragg_runtime.model.record import record
from ragg_runtime.model.resonance import neutral_values, with_responses
from ragg_runtime.reference.effects import EffectValues
from ragg_runtime.reference.scenario import scenario
from tests.rate import RATE


def hidden(effect: str, f_0: float, Q: float, share: float) -> EffectValues:
    """A mount, or a mode of the first accelerometer, that carries so much of it."""
    w = 2 * np.pi * f_0
    own: dict[str, object] = {"share": share}
    if effect == "accelerometer-resonance":
        own = {"u": [share / (w * Q), 0, 0, 0], "v": [share / w**2, 0, 0, 0]}
    return {effect: {"f_0": f_0, "Q": Q, **own}}  # type: ignore[dict-item]


@pytest.mark.parametrize(
    ("effect", "f_0", "Q", "share"),
    [
        ("mount-resonance", 1.3, 4.0, 1.0),
        ("accelerometer-resonance", 3.0, 15.0, 1e-5),
        ("accelerometer-resonance", 1.5, 6.0, 3e-7),
    ],
)
def test_frequency_and_q_are_fitted_down_to_noise(effect: str, f_0: float, Q: float, share: float) -> None:
    s = scenario(72, duration=240.0)
    sim = s.simulate(hidden(effect, f_0, Q, share))
    model = derive.with_effects(s.sheet, load.packaged(), [effect])
    f = fitted.fit(model, s.sheet, [observe(sim.flight(), s.sheet)], candidates=False)
    kept = f.observations[0].record.valid
    noise = float(np.std(sim.G_out - sim.G_out_noise_free))
    assert np.std(f.residuals(np.zeros(f.n_base))[0][kept]) < 1.02 * noise
    c = f.calibration
    found = {
        q.name.split(".")[1]: (c.p[k], q.scale * np.sqrt(v))
        for q, k, v in zip(c.columns, c.index, np.diag(c.covariance), strict=True)
        if q.effect
    }
    for name, true in (("f_0", f_0), ("Q", Q)):
        value, std = found[name]
        assert std < 0.1 * true
        assert abs(value - true) < 4 * std + 0.01 * true


def test_a_mount_that_resonates_is_named() -> None:
    s = scenario(5, duration=150.0, rate=RATE)
    d = diagnosed(s, s.simulate(hidden("mount-resonance", 3.0, 15.0, 1.0)).flight())
    assert d.found == ("mount-resonance",)


def test_the_low_frequencies_of_an_accelerometers_resonance_are_not_two_effects() -> None:
    s = scenario(5, duration=150.0, rate=RATE)
    d = diagnosed(s, s.simulate(hidden("accelerometer-resonance", 3.0, 15.0, 3e-6)).flight())
    assert (d.verdict, d.found) == ("unexplained", ())
    assert "add accelerometer-resonance and compare" in d.reasons[0].text


def test_a_part_of_a_record_hears_what_the_whole_one_does() -> None:
    s = scenario(72, duration=120.0)
    r = record(s.simulate().flight(), s.sheet)
    known = [*neutral_values(load.packaged().candidates)]
    names = ("mount_a_x", "curvature_tangential", "rate_radial_by_f_0", "rate_radial_by_Q")
    whole, part = (with_responses(x, known, names) for x in (r, r.part(slice(900, 1000))))
    for name in names:
        expected, got = whole.series(name), part.series(name)
        assert expected is not None and got is not None
        assert np.max(np.abs(got - expected[900:1000])) < 1e-4 * np.std(expected)
