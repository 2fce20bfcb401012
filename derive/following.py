"""Parameters of the accelerometers that follow something, linearly: time, temperature, pressure, or an instant passed."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from derive.effect import Context, EffectParameter, Parameters, Values

REFERENCE_KELVIN = sp.Rational(29315, 100)
"""Temperature at which the test sheet's values hold; another one is absorbed by them."""

REFERENCE_PASCAL = sp.Integer(101325)
"""Pressure at which they hold."""

T_STEP = EffectParameter("t_step", "t_s", "s", "instant of the step", 1.0, shared=True, fitted=False)
"""Of every effect that begins at once; the diagnosis estimates it."""

Driver = Callable[[Values, Context], sp.Expr]
Instrument = Callable[[Parameters, Values, Context], Parameters]


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

    def instrument(k: Parameters, p: Values, c: Context) -> Parameters:
        change = p[slope] * driver(p, c)
        return {name: k[name] * (1 + change) if name == "K1" else k[name] + change}

    return instrument
