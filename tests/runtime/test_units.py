"""g is the model's g0 in every unit that is made with it; nothing is guessed, nothing hangs."""

from __future__ import annotations

import contextlib
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.units import RawQuantity, Units, read_quantity, units

G0 = st.floats(0.1, 100.0)
FINITE = st.floats(-1e12, 1e12, allow_nan=False)


@settings(deadline=None, max_examples=4)  # a registry of units for each takes a sixth of a second
@given(G0)
def test_g_is_g0_wherever_it_stands(g0: float) -> None:
    known = Units(g0)
    for unit, si_unit, expected in (
        ("g", "m/s^2", g0),
        ("mg", "m/s^2", 1e-3 * g0),
        ("ug", "m/s^2", 1e-6 * g0),
        ("µg", "m/s^2", 1e-6 * g0),
        ("mA/g", "A/(m/s^2)", 1e-3 / g0),
        ("ug/g", "1", 1e-6),
        ("ug/g^2", "1/(m/s^2)", 1e-6 / g0),
        ("ug/g^3", "(m/s^2)^-2", 1e-6 / g0**2),
        ("um/g", "s^2", 1e-6 / g0),
        ("rad/g", "rad/(m/s^2)", 1 / g0),
        ("g^2", "m^2/s^4", g0**2),
        ("ug/K", "m/s^2/K", 1e-6 * g0),
    ):
        assert known.to_si(1.0, unit, si_unit) == pytest.approx(expected, rel=1e-14), unit


@pytest.mark.parametrize(
    ("unit", "si_unit", "expected"),
    [
        ("Eo", "s^-2", 1e-9),
        ("Eo/m", "1/(s^2*m)", 1e-9),
        ("arcsec", "rad", math.pi / 180 / 3600),
        ("deg/h", "rad/s", math.pi / 180 / 3600),
        ("°", "rad", math.pi / 180),
        ("%", "1", 0.01),
        ("rad/s^0.5", "rad/s^0.5", 1.0),
        ("ug/(rad/s^2)", "m/s^2/(rad/s^2)", 9.8e-6),
        ("kg", "kg", 1.0),
        ("N/kg", "m/s^2", 1.0),
        ("Gal", "m/s^2", 0.01),
        ("rpm", "rad/s", 2 * math.pi / 60),
        ("rpm", "Hz", 1 / 60),
        ("rad/s", "Hz", 1 / (2 * math.pi)),
        ("deg/s", "Hz", 1 / 360),
        ("mG", "m/s^2", 9.8e-3),
        ("M/S2", "m/s^2", 1.0),
        ("MV", "V", 1e6),
        *((volt, "V", 1.0) for volt in ("Volt", "volts")),
        ("mVolt", "V", 1e-3),
        ("DEG/S", "rad/s", math.pi / 180),
        ("mdps", "rad/s", math.pi / 180e3),
        ("Deg/Hr", "rad/s", math.pi / 180 / 3600),
        ("m/s²", "m/s^2", 1.0),
        ("G", "m/s^2", 9.8),
        *((celsius, "K", 274.15) for celsius in ("\u2103", "C", "degC", "degrees_celsius")),
    ],
)
def test_conversions(unit: str, si_unit: str, expected: float) -> None:
    assert units(9.8).to_si(1.0, unit, si_unit) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    ("unit", "si_unit"), [("m", "s"), ("gram", "m/s^2"), ("ug/g^2", "m/s^2"), ("1", "V")]
)
def test_wrong_dimension_names_both(unit: str, si_unit: str) -> None:
    with pytest.raises(UserError, match="wrong dimension") as caught:
        units(9.8).to_si(1.0, unit, si_unit, "model.toml: [disc] radius")
    assert "model.toml: [disc] radius" in str(caught.value)
    assert repr(unit) in str(caught.value)
    assert repr(si_unit) in str(caught.value)


def test_hertz_is_no_angular_rate() -> None:
    with pytest.raises(UserError, match="frequency"):
        units(9.8).to_si(1.0, "Hz", "rad/s")


NO_UNITS = (
    *("furlogn", "m+s", "m;s", "2 m", "m 2", "m^", "m^^2", "m**n", "(m", "m)", "m/", "'m'", "m s^", "m^-", "//"),
    *("9**9**9", "m**9**9**9", "m^1e400", "m^99", "m" * 200, "__import__('os')", "lambda: 0", "m\x00"),
)  # fmt: skip


@pytest.mark.parametrize("unit", NO_UNITS)
def test_what_is_no_unit(unit: str) -> None:
    with pytest.raises(UserError, match="not a unit"):
        units(9.8).parse(unit, "here")


@settings(deadline=None)
@given(st.text(alphabet="mgsAVK019.^*/() -+uE", max_size=20))
def test_any_text_is_a_unit_or_a_user_error(text: str) -> None:
    with contextlib.suppress(UserError):
        assert units(9.8).base_unit(text)


@pytest.mark.parametrize(
    ("raw", "expected"),
    [
        ("0.1 m", RawQuantity(0.1, "m")),
        ("1e9ohm", RawQuantity(1e9, "ohm")),
        (" -2.5e-3  ug/g^2 ", RawQuantity(-0.0025, "ug/g^2")),
        ("3 1", RawQuantity(3.0, "1")),
        ("0,1 m", RawQuantity(0.1, "m")),
        ({"value": 3, "unit": "s"}, RawQuantity(3.0, "s")),
        ({"value": [1, 2.5, 0, -4], "unit": "um"}, RawQuantity((1.0, 2.5, 0.0, -4.0), "um")),
    ],
)
def test_quantities(raw: object, expected: RawQuantity) -> None:
    assert read_quantity(raw, "", count=4) == expected


@pytest.mark.parametrize(
    ("raw", "what"),
    [
        (5, "unit is missing"),
        ("5", "unit is missing"),
        ({"value": 5, "unit": 3}, "unit is not a text"),
        ({"value": 5, "unit": "m", "std": 1}, "not a quantity"),
        ("m", "not a quantity"),
        ("1.2.3 m", "not a quantity"),
        (True, "not a quantity"),
        ([1, 2, 3, 4], "not a quantity"),
        ({"value": [1, 2, 3], "unit": "m"}, "wrong number of values"),
        ({"value": [1, 2, 3, "4"], "unit": "m"}, "not a number"),
        ({"value": math.nan, "unit": "m"}, "not finite"),
        ({"value": [1, 2, math.inf, 4], "unit": "m"}, "not finite"),
        ("1e999 m", "not finite"),
        ("1 furlogn", "not a unit"),
        ("1,234 m", "not a unit"),  # a thousand, or one?
    ],
)
def test_what_is_no_quantity(raw: object, what: str) -> None:
    with pytest.raises(UserError, match=what) as caught:
        units(9.8).parse(read_quantity(raw, "f.toml: here", count=4).unit, "f.toml: here")
    assert caught.value.where == "f.toml: here"
    assert caught.value.found is not None


def test_message_holds_every_fact_and_travels_between_processes() -> None:
    import pickle

    error = UserError("wrong", where="here", found=3, expected="four", remedy="add one")
    assert str(error) == "here: wrong\n  found: 3\n  expected: four\n  remedy: add one"
    assert str(pickle.loads(pickle.dumps(error))) == str(error)
