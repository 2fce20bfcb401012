"""a_z with the wrong sign, with gravity or without: said where record or sheet tell it, and proved untold elsewhere."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from ragg_runtime.diagnosis import vertical_force
from ragg_runtime.diagnosis.comparison import compare
from ragg_runtime.fit.fitted import Fitted, fit
from ragg_runtime.fit.observation import observations_of
from ragg_runtime.flight import Flight
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model import model
from ragg_runtime.reference.instruments import _UNCERTAINTY
from ragg_runtime.reference.scenario import Scenario, scenario

MODEL, G0 = model.packaged(), 9.8
WORDS = {
    (-1.0, 0.0): "a_z has the wrong sign",
    (1.0, 1.0): "a_z is 1 g too large",
    (1.0, -1.0): "a_z is 1 g too small",
    (-1.0, 1.0): "a_z has the wrong sign and is, then, 1 g too small",
}


@cache
def flown(voltages: bool, scale: float = 1.0) -> tuple[Scenario, Flight]:
    s = scenario(71, duration=150.0 if voltages else 300.0, turbulence_scale=scale)
    return s, s.simulate().flight(voltages=voltages)


def wrong(x: Flight, sign: float, gravity: float) -> Flight:
    return replace(x, channels={**x.channels, "a_z": sign * x.channels["a_z"] + gravity * G0})


def sure(sheet: Instrument) -> Instrument:
    """A sheet that says how sure it is, and is right about it."""
    return replace(sheet, sigmas={n: np.full(4, s) for n, s in _UNCERTAINTY.items() if s > 0.0})


def fitted(sheet: Instrument, x: Flight) -> Fitted:
    return fit(MODEL, sheet, observations_of([x], sheet))


def test_the_voltages_tell_the_sign_without_the_sheet() -> None:
    """On a motion so calm that the residual stands hardly above the noise."""
    s, x = flown(True, 0.02)
    assert vertical_force.misrecorded(fitted(s.sheet, x)) is None
    said = vertical_force.misrecorded(fitted(s.sheet, wrong(x, -1.0, 0.0)))
    assert said is not None and said.startswith("a_z has the wrong sign (or: omega_x and omega_y have): ")
    assert "multiply a_z by -1" in said


@pytest.mark.parametrize("mistake", WORDS)
def test_a_sure_sheet_tells_sign_and_gravity(mistake: tuple[float, float]) -> None:
    s, x = flown(False)
    c = compare(MODEL, sure(s.sheet), [wrong(x, *mistake)])
    assert not c.adequate
    assert str(c.as_json()["reason"]).startswith(f"{WORDS[mistake]}: with that undone")


def test_a_right_record_under_a_sure_sheet_is_left_alone() -> None:
    s, x = flown(False)
    c = compare(MODEL, sure(s.sheet), [x])
    assert c.adequate and c.as_json()["reason"] is None


def test_what_no_record_of_the_output_tells_is_not_said() -> None:
    """A model of mirrored angles and coefficients explains the same G_out: chi-square is the same, and nothing is claimed."""
    s, x = flown(False)
    right = fitted(s.sheet, x)
    for mistake in WORDS:
        f = fit(MODEL, s.sheet, observations_of([wrong(x, *mistake)], s.sheet), noise=right.calibration.noise)
        left, least = (float(y.data[:, -1] @ y.data[:, -1]) for y in (f, right))
        assert left == pytest.approx(least, abs=6.0)
        assert vertical_force.misrecorded(f) is None
