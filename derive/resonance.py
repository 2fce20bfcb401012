"""What passes a resonance of free frequency and Q: series that the runtime forms of the record, as channels of the derivation.

A Taylor series in the period fails where the resonance is near what is recorded. So the record itself is passed through it, at the
values to which a fit has come (``ragg_runtime.model.resonance``), with its derivatives by the two parameters: a hook has only to
define where the response enters, and how it changes with their distance from the neutral values.
"""

from __future__ import annotations

import sympy as sp

from derive.context import Context
from derive.effect import EffectParameter, Values

FREQUENCY, QUALITY = 5.0, 10.0
"""Hz, and 1: where a search begins. Isolators and stabilised platforms resonate at 2 to 20 Hz, with Q from 3 to 30."""

PARAMETERS = (
    EffectParameter(
        "f_0", "f_0", "Hz", "frequency of the resonance", 3.0, shared=True, neutral=FREQUENCY, shape=True
    ),
    EffectParameter("Q", "Q", "1", "its quality factor", 5.0, shared=True, neutral=QUALITY, shape=True),
)


def response(name: str, p: Values, c: Context, *, changes: bool = True) -> sp.Expr:
    """The series of this name behind the resonance; without its ``changes`` where they are negligible."""
    whole = c.channel(name)
    if changes:
        whole += (p.f_0 - sp.Float(FREQUENCY)) * c.channel(f"{name}_by_f_0")
        whole += (p.Q - sp.Float(QUALITY)) * c.channel(f"{name}_by_Q")
    return whole
