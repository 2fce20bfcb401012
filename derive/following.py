"""Parameters of the accelerometers that follow something, linearly: time, temperature, pressure, or an instant passed."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import sympy as sp

from derive.context import Context
from derive.effect import Values

REFERENCE_KELVIN = sp.Rational(29315, 100)
"""Temperature at which the test sheet's values hold; another one is absorbed by them."""

REFERENCE_PASCAL = sp.Integer(101325)
"""Pressure at which they hold."""

Driver = Callable[[Values, Context], sp.Expr]
Instrument = Callable[[Mapping[str, sp.Expr], Values, Context], Mapping[str, sp.Expr]]


def elapsed(p: Values, c: Context) -> sp.Expr:
    """Time, s."""
    return c.time


def warmth(p: Values, c: Context) -> sp.Expr:
    """Temperature above that of the sheet, K."""
    return c.channel("temperature") - REFERENCE_KELVIN


def overpressure(p: Values, c: Context) -> sp.Expr:
    """Pressure above that of the sheet, Pa."""
    return c.channel("pressure") - REFERENCE_PASCAL


def begun(p: Values, c: Context) -> sp.Expr:
    """1 from the instant ``t_step`` of the effect on, else 0."""
    return sp.Heaviside(c.time - p.t_step, 1)


def following(name: str, slope: str, driver: Driver) -> Instrument:
    """The hook of an effect by whose parameter ``slope`` that of the accelerometers follows; K1 relatively."""

    def instrument(k: Mapping[str, sp.Expr], p: Values, c: Context) -> Mapping[str, sp.Expr]:
        change = p[slope] * driver(p, c)
        return {name: k[name] * (1 + change) if name == "K1" else k[name] + change}

    return instrument
