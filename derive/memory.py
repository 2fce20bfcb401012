"""What an instrument remembers: series that the runtime forms of the record, as channels of the derivation.

A Taylor series in a period or a time constant fails where it is as long as what is recorded. So the record itself is passed through
what has the memory, at the values to which a fit has come (``ragg_runtime.model.memory``), with derivatives by them: a hook has only
to say where the response enters, and how it changes with what is left of these values, which is their distance from the neutral ones.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from derive.context import Context
from derive.effect import EffectParameter, Values
from derive.stages import NOMINAL_TRIAD
from derive.symbols import COS_J, SIN_J

FREQUENCY, QUALITY = 5.0, 10.0
"""Hz, and 1: where a search begins. Isolators and stabilised platforms resonate at 2 to 20 Hz, with Q from 3 to 30."""


def _shape(
    name: str, latex: str, unit: str, meaning: str, plausible: float, neutral: float
) -> EffectParameter:
    return EffectParameter(name, latex, unit, meaning, plausible, shared=True, neutral=neutral, shape=True)


RESONANCE = (
    _shape("f_0", "f_0", "Hz", "frequency of the resonance", 3.0, FREQUENCY),
    _shape("Q", "Q", "1", "its quality factor", 5.0, QUALITY),
)

HEAT = (_shape("tau", r"\tau", "s", "time constant of the heat", 20.0, 40.0),)
"""A search begins at 40 s: a torquer in its housing takes from ten seconds to ten minutes."""

RELAXATION = (_shape("tau", r"\tau", "s", "time constant of the creep", 20.0, 20.0),)
"""Creep goes on in every decade of time: one that a record of minutes shows is of seconds to minutes."""

SLIP = (_shape("w", "w", "m/s^2", "force at which it slips", 0.02, 0.01),)
"""A milli-g; a search begins at a share of what the record's force changes by."""

THERMAL_SLIP = (_shape("w", "w", "K", "change at which it slips", 0.1, 0.1),)


def response(name: str, p: Values, c: Context, by: Sequence[EffectParameter] = ()) -> sp.Expr:
    """The series of this name, as it changes with the parameters ``by``; without, where these changes are too small to matter."""
    changes = ((p[q.name] - sp.Float(q.neutral)) * c.channel(f"{name}_by_{q.name}") for q in by)
    return sp.Add(c.channel(name), *changes)


def axes_on_disc(c: Context) -> sp.Matrix:
    """(3, 3): nominal x, y and z axis of the accelerometer, a row each, along axes that turn with the disc, of angle 0 on it."""
    axes = NOMINAL_TRIAD.T if c.turn_of_triad is None else c.turn_of_triad * NOMINAL_TRIAD.T
    return axes.T * sp.Matrix([[COS_J, SIN_J, 0], [-SIN_J, COS_J, 0], [0, 0, 1]])


def remembered_force(kind: str, p: Values, c: Context, by: Sequence[EffectParameter]) -> sp.Matrix:
    """(3,): what a memory of this ``kind``, which ``by`` describe, makes of the force along the accelerometer's nominal axes."""
    names = ("radial", "tangential", "axial")
    return axes_on_disc(c) * sp.Matrix([response(f"{kind}_{n}", p, c, by) for n in names])


def warmth(p: Values, c: Context) -> sp.Expr:
    """Square of the force along the input axis as the torquer's heat remembers it, m^2/s^4."""
    axis, terms = axes_on_disc(c)[0, :], []
    for i, a in enumerate("rta"):
        for k, b in enumerate("rta"[i:], i):
            weight = axis[i] * axis[k] * (1 if i == k else 2)
            terms += [weight * response(f"heat_{a}{b}", p, c, HEAT)] if weight != 0 else []
    return sp.Add(*terms)
