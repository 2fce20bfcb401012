"""Delay of the filter that the output passes before it is recorded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import sympy as sp

from derive.effect import Effect, EffectParameter, Values
from derive.stages import SensedForce

if TYPE_CHECKING:
    from derive.context import Context


def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    first = c.rate(i)
    return i - p.tau * first + p.tau**2 * c.rate(first)


EFFECT = Effect(
    id="output-filter",
    title="Filter of the output",
    physics=(
        "An anti-alias filter, common to the four accelerometers, delays and smooths G_out against the motion record "
        "and the disc angle."
    ),
    source="first-order low-pass, 1/(1 + tau s), before the output's converter",
    equation=r"G_{out} \leftarrow G_{out}/(1 + \tau s)",
    limits=(
        "Expanded to second order in tau: tau must be far below the time scale of the output (0.1 s). The lag of four "
        "equal accelerometers is the same; filters of higher order differ in the second order alone."
    ),
    parameters=(
        EffectParameter("tau", r"\tau", "s", "time constant of the output's filter", 1e-6, shared=True),
    ),
    transducer=transducer,
)
