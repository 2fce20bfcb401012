"""The digits with which a file was written are part of its noise: known beforehand, and said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ragg_runtime.diagnosis.comparison import compare
from ragg_runtime.flight import Flight
from ragg_runtime.flight.digits import Written, digits_of, written
from ragg_runtime.instrument.units import units
from ragg_runtime.model.model import packaged
from ragg_runtime.reference.scenario import scenario

RANDOM = np.random.default_rng(5).standard_normal(600)


@pytest.mark.parametrize("digits", [2, 5, 9])
@pytest.mark.parametrize("size", [3e-7, 1.0, 4e5])
def test_significant_digits_are_counted(digits: int, size: float) -> None:
    x = np.array([float(f"{v:.{digits}g}") for v in size * RANDOM])
    found = written(x, 1.0)
    assert found is not None and (found.digits, found.step) == (digits, 0.0)
    apart = found.steps(x)
    assert np.all(apart < 10.0 ** (1 - digits) * np.abs(x) * 1.0001)
    assert np.all(apart > 10.0**-digits * np.abs(x) * 0.9999)


@pytest.mark.parametrize(("decimals", "unit"), [(3, 1.0), (1, 4.84813681e-6), (5, 9.8)])
def test_decimals_are_counted_in_the_files_unit(decimals: int, unit: float) -> None:
    x = np.round(20.0 * RANDOM, decimals)
    found = written(x * unit, unit)
    assert found is not None
    assert found.steps(x * unit) == pytest.approx(10.0**-decimals * unit)


def test_what_is_written_in_full_has_no_step() -> None:
    assert written(RANDOM, 1.0) is None
    assert written(RANDOM * 9.8, 9.8) is None
    assert Written(digits=3, step=0.0, unit_factor=1.0).steps(np.zeros(3)).max() < 1e-290


def rounded(x: Flight, digits: int, *, output: bool) -> Flight:
    def cut(values: np.ndarray) -> np.ndarray:
        return np.array([float(f"{v:.{digits}g}") for v in values])

    return replace(
        x,
        channels={n: cut(v) for n, v in x.channels.items()},
        outputs={n: cut(v) if output else v for n, v in x.outputs.items()},
    )


@pytest.mark.parametrize(("trim", "worst"), [("matched", "a_"), ("table-v", "G_out")])
def test_a_perfect_record_of_few_digits_is_adequate_and_its_noise_is_its_digits(
    trim: str, worst: str
) -> None:
    s = scenario(71, duration=90.0, noise_density=0.0, trim=trim)
    c = compare(packaged(), s.sheet, [rounded(s.simulate().flight(), 5, output=worst == "G_out")])
    assert c.adequate
    digits = c.fitted.rounding[0].rms / c.fitted.k_ggi
    assert c.calibrated.rms_Eo == pytest.approx(digits, rel=0.15)
    assert digits <= c.noise_floor < 1.15 * digits
    said = str(c.as_json()["reason"])
    assert "the digits of the file make" in said and f"most of it {worst}" in said


def test_a_record_in_full_is_said_nothing_of() -> None:
    s = scenario(72, duration=60.0)
    x = s.simulate().flight()
    assert not digits_of(x, units(9.8)).columns
    # a rate that is written in degrees an hour, and the acceleration derived of it
    turned = replace(
        x,
        channels={
            n: np.round(v / 4.84813681109536e-06, 2) * 4.84813681109536e-06 if n == "omega_x" else v
            for n, v in x.channels.items()
        },
        written={"time": "s", "omega_x": "deg/h", "G_out": "V"},
    )
    found = digits_of(turned, units(9.8))
    assert found.derived and list(found.columns) == ["omega_x"]
    assert found.columns["omega_x"].step == pytest.approx(0.01)
