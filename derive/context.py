"""What the chain of an accelerometer is evaluated in: recorded motion, disc angle, derivatives by time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import sympy as sp

from derive import stages
from derive.stages import Force, Geometry, Motion, SensedForce, Spin
from derive.symbols import COS_PHI, MOTION, SIN_PHI, SPIN_ACCELERATION, SPIN_RATE, TIME, local, symbol
from derive.tape import EVERYTHING, About, Tape

OMEGA = 2 * sp.pi * symbol("spin_frequency")
"""Angular rate of the disc as Eq. 14 has it, steady, rad/s."""

RECORDED_SPIN = Spin(SPIN_RATE, SPIN_ACCELERATION)
"""The spin by the recorded disc angle."""

DERIVATIVE_OF: Mapping[str, str] = {f"omega_{k}": f"omegadot_{k}" for k in "xyz"}
_STATIONARY = frozenset({"Gamma", "temperature", "pressure"})


@dataclass
class Context:
    """What a hook may ask for, beyond its stage's own values.

    ``motion``, ``geometry``, ``force`` and ``sensed`` are those of the stages already passed; a hook of
    the stage ``instrument`` sees the force of the unchanged instrument. ``spin`` is that of the true disc
    angle, ``case`` the motion of what is mounted on the disc, ``standing`` the axes of a disc at rest that is not level, from
    before the stage ``sensing`` on, ``turn_of_triad`` how its accelerometers are oriented (``None``: as the paper's). ``small``
    are parameters at zero of which only the first order counts, ``about`` what of a time derivative does.
    """

    tape: Tape
    motion: Motion
    cos_phi: sp.Expr = COS_PHI
    sin_phi: sp.Expr = SIN_PHI
    geometry: Geometry = field(init=False)
    force: Force = field(init=False)
    sensed: SensedForce = field(init=False)
    parameters: Mapping[str, sp.Expr] = field(default_factory=dict)
    time: sp.Symbol = TIME
    Omega: sp.Expr = OMEGA
    spin: Spin = RECORDED_SPIN
    axes: sp.Matrix | None = None
    turn_of_triad: sp.Matrix | None = None
    standing: sp.Matrix | None = None
    small: frozenset[sp.Symbol] = frozenset()
    about: About = EVERYTHING

    def enter(self, own: frozenset[sp.Symbol]) -> None:
        """What is written down next is an effect's with these fitted parameters (none: that of the instrument).

        What a candidate changes is of first order in its own parameters, all of them ``small``; what others change is of
        second order there, so that the time derivatives of the instrument without them serve.
        """
        candidate = bool(own) and own <= self.small
        self.about = About(self.small - own, 0) if candidate else About(self.small)

    def in_disc_frame(self, v: sp.Matrix) -> sp.Matrix:
        """A vector (3) or tensor (3 x 3) of the measurement frame along the axes in which motion and geometry are resolved.

        These are those of the disc at rest, z along its axis; of a disc as the paper's they are the same.
        """
        return v if self.axes is None else self._turned(self.axes.T, v, "in_disc")

    def in_measurement_frame(self, v: sp.Matrix) -> sp.Matrix:
        """The other way round."""
        return v if self.axes is None else self._turned(self.axes, v, "in_measurement")

    def _turned(self, by: sp.Matrix, v: sp.Matrix, name: str) -> sp.Matrix:
        """A turned vector or tensor, each component with a name of its own: what follows may differentiate it often."""
        return self.tape.let_each(name, by * v if v.shape[1] == 1 else by * v * by.T)

    @property
    def case(self) -> Motion:
        """The motion of the accelerometers' cases, which turn with the disc."""
        return stages.of_disc(self.motion, self.spin)

    def channel(self, name: str) -> sp.Symbol:
        """A recorded channel by its column name."""
        return symbol(local(name))

    def harmonic(self, n: int) -> tuple[sp.Expr, sp.Expr]:
        """cos(n phi), sin(n phi) of the disc angle, as polynomials in its cosine and sine."""
        terms = [(-1) ** (k // 2) * math.comb(n, k) * COS_PHI ** (n - k) * SIN_PHI**k for k in range(n + 1)]
        return sp.Add(*terms[::2]), sp.Add(*terms[1::2])

    def rate(self, e: sp.Expr) -> sp.Expr:
        """Total time derivative: the disc turns at Omega, the motion's rates are channels ``d_<name>``."""
        return self.tape.rate(sp.sympify(e, strict=True), self._symbol_rate, self.about)

    def _symbol_rate(self, s: sp.Symbol) -> sp.Expr:
        if s == COS_PHI:
            return -self.Omega * SIN_PHI
        if s == SIN_PHI:
            return self.Omega * COS_PHI
        if s == SPIN_RATE:
            return SPIN_ACCELERATION  # whose own rate is left out: no disc jerks so that it would show
        return _rate_of_channel(s)

    def shifted(self, e: sp.Expr, delta: sp.Expr) -> sp.Expr:
        """``e`` at the instant t + delta, to second order in delta."""
        first = self.rate(e)
        return e + delta * first + delta**2 / 2 * self.rate(first)


_MOVING = frozenset(c.name for c in MOTION if c.name.split("_")[0] not in _STATIONARY)


def _rate_of_channel(s: sp.Symbol) -> sp.Expr:
    name = s.name
    if s == TIME:
        return sp.Integer(1)
    if s == SPIN_ACCELERATION:
        return sp.Integer(0)
    if name in DERIVATIVE_OF:
        return symbol(DERIVATIVE_OF[name])
    if name in _MOVING:
        return symbol(f"d_{name}")
    if name.startswith("d_") and name[2:] in _MOVING:
        return symbol(f"d2_{name[2:]}")
    return sp.Integer(0)  # constants, and what varies slowly (gradients, temperature)
