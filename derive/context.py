"""What the chain of an accelerometer is evaluated in: recorded motion, disc angle, derivatives by time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import sympy as sp

from derive.stages import Force, Geometry, Motion, SensedForce
from derive.symbols import COS_PHI, MOTION, SIN_PHI, TIME, symbol
from derive.tape import Tape

OMEGA = 2 * sp.pi * symbol("spin_frequency")
"""Angular rate of the disc, rad/s."""

DERIVATIVE_OF: Mapping[str, str] = {f"omega_{k}": f"omegadot_{k}" for k in "xyz"}
_STATIONARY = frozenset({"Gamma", "temperature", "pressure"})


@dataclass
class Context:
    """What a hook may ask for, beyond its stage's own values.

    ``motion``, ``geometry``, ``force`` and ``sensed`` are those of the stages already passed; a hook of
    the stage ``instrument`` sees the force of the unchanged instrument.
    """

    tape: Tape
    motion: Motion
    cos_phi: sp.Expr = COS_PHI
    sin_phi: sp.Expr = SIN_PHI
    geometry: Geometry | None = None
    force: Force | None = None
    sensed: SensedForce | None = None
    parameters: Mapping[str, sp.Expr] = field(default_factory=dict)
    time: sp.Symbol = TIME
    Omega: sp.Expr = OMEGA

    def channel(self, name: str) -> sp.Symbol:
        """A recorded channel by its column name."""
        return symbol(name)

    def harmonic(self, n: int) -> tuple[sp.Expr, sp.Expr]:
        """cos(n phi), sin(n phi) of the disc angle, as polynomials in its cosine and sine."""
        z = sp.expand((COS_PHI + sp.I * SIN_PHI) ** n)
        return sp.re(z), sp.im(z)

    def rate(self, e: sp.Expr) -> sp.Expr:
        """Total time derivative: the disc turns at Omega, the motion's rates are channels ``d_<name>``."""
        return self.tape.rate(sp.sympify(e), _symbol_rate)

    def shifted(self, e: sp.Expr, delta: sp.Expr) -> sp.Expr:
        """``e`` at the instant t + delta, to second order in delta."""
        first = self.rate(e)
        return e + delta * first + delta**2 / 2 * self.rate(first)


def _symbol_rate(s: sp.Symbol) -> sp.Expr:
    if s == COS_PHI:
        return -OMEGA * SIN_PHI
    if s == SIN_PHI:
        return OMEGA * COS_PHI
    if s == TIME:
        return sp.Integer(1)
    name = s.name
    if name in DERIVATIVE_OF:
        return symbol(DERIVATIVE_OF[name])
    if name.startswith("d_"):
        return symbol(f"d2_{name[2:]}")
    if name in _MOVING:
        return symbol(f"d_{name}")
    return sp.Integer(0)  # constants, and what varies slowly (gradients, temperature)


_MOVING = frozenset(c.name for c in MOTION if c.name.split("_")[0] not in _STATIONARY)
