"""The angular acceleration derived from the rate: as good as the record allows, and no reason to accuse a model."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from ragg_runtime.estimation.fitted import measure_noise_floor
from ragg_runtime.identification.comparison import compare
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE
from ragg_runtime.model.model import load_packaged
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.screening import screen
from ragg_runtime.signals.derivative import (
    REACH,
    bridge_gaps,
    derive_accelerations,
    differentiate,
    differentiate_rate,
    predict_missing,
)

RATE = 16.0


def test_what_a_wide_band_gives() -> None:
    t = np.arange(4000) / RATE
    rng = np.random.default_rng(1)
    w, phase = 2 * np.pi * rng.uniform(0.01, 0.85 * RATE / 2, 60), rng.uniform(0, 2 * np.pi, 60)
    x, dx = np.sin(np.outer(t, w) + phase).sum(axis=1), (np.cos(np.outer(t, w) + phase) * w).sum(axis=1)
    derived, sure = differentiate_rate(x, RATE)
    assert np.std((derived - dx)[sure]) < 3e-6 * np.std(dx)
    assert np.std((differentiate(x, RATE) - dx)[sure]) > 0.02 * np.std(dx)
    assert np.flatnonzero(sure)[[0, -1]].tolist() == [REACH, len(t) - REACH - 1]
    x[::300] = np.nan
    derived, sure = differentiate_rate(x, RATE)
    assert np.isnan(derived[::300]).all()
    assert np.nanstd((derived - dx)[sure]) < 0.4 * np.nanstd(derived - dx), (
        "one-sided ends are not relied upon"
    )


def test_lost_rates_are_predicted_from_those_beside_them() -> None:
    """A spline errs by a fortieth of such motion."""
    rng, there = np.random.default_rng(3), np.ones(4800, dtype=np.bool_)
    x = np.convolve(rng.standard_normal(4900), np.convolve(np.hanning(9), np.hanning(9)), "same")[:4800]
    for k in range(100, 4700, 150):
        there[k : k + 3] = False
    off = np.std(
        [(f - x)[~there] for f in (predict_missing(x, there), bridge_gaps(x, there, smooth=True))], axis=1
    )
    assert off[0] < off[1] / 10
    # nothing to learn from
    assert np.array_equal(predict_missing(x, ~there), bridge_gaps(x, ~there, smooth=True))


def test_gaps_cost_little_of_short_runs() -> None:
    x = np.sin(np.arange(1000) / 5.0)
    x[::50] = np.nan
    assert np.mean(differentiate_rate(x, RATE)[1]) > 0.7


def derived(seed: int, rate: float, trim: str, duration: float):  # type: ignore[no-untyped-def]
    """A flight of an instrument whose sheet is right but for its errors, without recorded acceleration."""
    s = scenario(seed, trim=trim, duration=duration, rate=rate)  # type: ignore[arg-type]
    flight = s.simulate().flight()
    channels = {n: v for n, v in flight.channels.items() if n not in ANGULAR_ACCELERATION}
    slopes, valid = derive_accelerations([channels[n] for n in ANGULAR_RATE], flight.time)
    channels |= dict(zip(ANGULAR_ACCELERATION, slopes, strict=True))
    flight = dataclasses.replace(flight, channels=channels, valid=valid)
    return s.sheet, screen(load_packaged(), s.sheet, flight)


def test_an_unmatched_instrument_sampled_slowly_is_not_accused() -> None:
    """Twenty of twenty such flights were: the error stands in a narrow band at the top, and beside the ends.

    Where the turbulence comes in bursts the error does so too, and one in three may be unexplained.
    """
    sheet, flight = derived(7000, 8.0, "table-v", 450.0)
    assert diagnose(load_packaged(), sheet, [flight]).verdict == "adequate"


def test_the_error_of_the_derivative_is_part_of_the_noise() -> None:
    sheet, flight = derived(7016, 8.0, "table-v", 900.0)
    c = compare(load_packaged(), sheet, [flight])
    assert c.calibrated.rms_Eo == pytest.approx(measure_noise_floor(c.fitted), rel=0.15)
    assert c.noise_floor > 3 * 2.8, "it is the largest part"
