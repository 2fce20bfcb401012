"""What screening found is part of the verdict: noisy motion is smoothed, stuck motion is the reason, the end of a range left out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import toeplitz
from scipy.signal import lfilter

from generated.output_effects import imu_saturation
from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.observation import observe
from ragg_runtime.identification.comparison import compare
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.result import Reason, heed_flags
from ragg_runtime.instrument.units import EOTVOS
from ragg_runtime.io.record import GRADIENT, Flag
from ragg_runtime.model.model import load_packaged
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.screening import screen
from ragg_runtime.screening.motion_noise import predict_true
from ragg_runtime.screening.screen import AT_REST, list_remarks
from tests.rate import RATE
from tests.runtime.diagnosed import diagnosed

STEP = 32 / 65536 * 9.8
"""m/s^2: 16 bits over +-16 g."""


def test_what_is_odd_about_the_motion_is_the_reason_and_not_an_effect() -> None:
    s, model = scenario(4, duration=150.0, rate=RATE, trim="table-v"), load_packaged()
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
    # the noise that steps leave is as loud throughout
    assert (d.verdict, d.found, d.remark) == (
        "adequate",
        (),
        None,
    )
    assert d.noise_floor == pytest.approx(d.before.rms_Eo, rel=0.1)
    heeded = heed_flags(diagnose(model, s.sheet, [still]), [still])
    assert (heeded.verdict, heeded.found) == ("unexplained", ())
    assert "a_x does not change at all" in str(heeded.reason)
    odd = x.flagged([Flag((), "a spin rate of its own", open=True, effects=("spin-rate-offset",))])
    two = replace(d, verdict="missing-effect", found=("magnetic-scale", "spin-rate-offset"))
    heeded = heed_flags(two, [odd])
    assert (heeded.verdict, heeded.found) == ("partly-explained", ("spin-rate-offset",))
    assert "magnetic-scale would explain it, but" in " ".join(r.text for r in heeded.reasons)
    for levels, said in ((1, False), (3, True), (40, False)):
        warm = 290.0 + np.floor(levels * np.arange(len(x)) / len(x))
        flagged = x.flagged(list_remarks(s.sheet, replace(x, channels={**x.channels, "temperature": warm})))
        drifts = heed_flags(replace(d, verdict="missing-effect", found=("gain-drift",)), [flagged])
        assert (drifts.found, "may look like a drift" in str(drifts.reason)) == (("gain-drift",), said)
    at_rest = replace(x, channels={n: np.full(len(x), np.mean(v)) for n, v in x.channels.items()})
    little = heed_flags(replace(d, reasons=()), [x.flagged(list_remarks(s.sheet, at_rest))])
    assert (little.verdict, little.reason) == ("adequate", AT_REST)
    stuck = replace(x, channels={**x.channels, "a_z": np.full(len(x), 9.8)})
    stuck = stuck.flagged(list_remarks(s.sheet, stuck))
    unsteady = heed_flags(replace(d, reasons=(Reason("the noise level changes over the record"),)), [stuck])
    assert unsteady.verdict == "unexplained"
    assert str(unsteady.reason).startswith("a_z does not change at all")


def test_noise_is_smoothed_to_the_best_prediction_at_the_ends_and_beside_gaps_too() -> None:
    rng = np.random.default_rng(5)
    n, pole, std = 2000, 0.9, 2.0
    x = lfilter([1.0], [1.0, -pole], rng.standard_normal(n + 200))[200:]
    there = np.ones(n, dtype=np.bool_)
    there[1600:1620] = False
    there[rng.random(n) < 0.08] = False  # codes of missing values: no run of a hundred samples is whole
    measured = x + std * rng.standard_normal(n)
    C = toeplitz(pole ** np.arange(n) / (1 - pole**2))[np.ix_(there, there)]
    best = C @ np.linalg.solve(C + std**2 * np.eye(len(C)), measured[there])
    errors = [
        float(np.sqrt(np.mean((e - x[there]) ** 2)))
        for e in (predict_true(measured, there, std)[there], best, measured[there])
    ]
    assert errors[0] < 1.15 * errors[1] < 0.7 * errors[2]


@pytest.mark.parametrize(("size", "used"), [(5.0, True), (50.0, False)])
def test_a_noisy_gradient_is_smoothed_or_not_used(size: float, used: bool) -> None:
    s, model = scenario(3, duration=150.0, rate=RATE, trim="table-v"), load_packaged()
    x = s.simulate().flight()
    rng = np.random.default_rng(1)
    noisy = {n: x.channels[n] + size * EOTVOS * rng.standard_normal(len(x)) for n in GRADIENT}
    flight = screen(model, s.sheet, replace(x, channels={**x.channels, **noisy}))
    assert ("Gamma_xx" in flight.channels) == used
    assert any("have a noise floor of" in note and "Eo" in note for note in flight.notes)
    assert diagnose(model, s.sheet, [flight]).verdict == "adequate"


SAMPLES = 4000
TIME = np.arange(SAMPLES) / 16.0
MOVING = np.sin(0.3 * TIME) + 0.2 * np.random.default_rng(1).standard_normal(SAMPLES)
ALL = np.ones(SAMPLES, dtype=bool)


def test_the_end_of_a_range_is_recognised() -> None:
    found = imu_saturation.clipped(np.clip(MOVING, -0.9, 0.9), ALL)
    assert np.array_equal(found, np.abs(MOVING) >= 0.9)
    assert imu_saturation.present(np.clip(MOVING, -0.9, 0.9), ALL, 0.0)
    assert "temperature" not in imu_saturation.CHANNELS


@pytest.mark.parametrize(
    "x",
    [
        MOVING,
        np.zeros(SAMPLES),
        np.full(SAMPLES, 9.8),  # at rest
        np.round(MOVING * 8) / 8,  # coarsely quantised
        np.round(np.sin(0.3 * TIME) * 100) / 100,  # and slow, so that it dwells at its largest values
        np.r_[
            np.round(20 * np.sin(0.02 * TIME[:600])), np.round(20 * MOVING[600:]).clip(-18, 18)
        ],  # 20 steps
        np.sin(2 * np.pi * TIME / 16),  # repeats itself, sample by sample
    ],
    ids=["noise", "zero", "at rest", "coarse", "dwells", "few steps", "periodic"],
)
def test_what_is_no_end_of_a_range(x: np.ndarray) -> None:
    assert not imu_saturation.clipped(x, ALL).any()


def test_a_flight_with_saturated_gyroscopes_is_diagnosed() -> None:
    s = scenario(47, duration=300.0)
    rates = s.simulate().channels["omega_y"]
    limit = float(np.quantile(np.abs(rates), 0.98))
    flight = s.simulate({"imu-saturation": {"omega_max": limit}}).flight()
    assert float(np.max(np.abs(flight.channels["omega_y"]))) == limit
    assert not np.any(observe(flight, s.sheet).record.valid[np.abs(rates) >= limit])
    d = diagnosed(s, flight)
    assert "imu-saturation" in d.found
    with pytest.raises(UserError, match="must be positive"):
        s.simulate({"imu-saturation": {"a_max": -1.0}})


def test_a_record_of_two_lines_and_a_long_turn_is_judged_by_what_it_has() -> None:
    """With a gap as long as the record the noise floor came out half as large, and an adequate model was none."""
    s = scenario(5, duration=600.0)
    x = s.simulate({}).flight()
    outputs = {n: np.where((x.time > 150.0) & (x.time < 450.0), np.nan, v) for n, v in x.outputs.items()}
    whole, parts = (compare(load_packaged(), s.sheet, [y]) for y in (x, replace(x, outputs=outputs)))
    assert parts.adequate, parts.grounds
    assert parts.noise_floor == pytest.approx(whole.noise_floor, rel=0.1)
