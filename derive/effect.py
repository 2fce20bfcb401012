"""What a physical effect is: a change at one or more stages of the instrument, in one file.

A file ``derive/effects/<id with underscores>.py`` defines ``EFFECT = Effect(...)``; nothing else has to
be touched. From it follow the extended model, the effect's signature, the calibration of its parameters,
its page in the documentation and its conformance tests.

An effect is not an additive term of the output: it changes a stage, and the stages after it see the
change, so that its couplings with misalignment and second-order coefficients are kept.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

import sympy as sp
from sympy import Expr

from derive import stages
from derive.names import EXPECTED, is_name, parameter_in_code
from derive.stages import Force, Geometry, Kinematics, Motion, Order, SensedForce, Spin
from derive.symbols import COS_PHI, MOTION, SIN_PHI, SPIN_ACCELERATION, SPIN_RATE, TIME, local, symbol
from derive.tape import EVERYTHING, About, Tape

__all__ = [
    "Context",
    "Effect",
    "EffectParameter",
    "Expr",
    "Geometry",
    "Motion",
    "Parameters",
    "SensedForce",
    "Values",
    "components",
    "shared",
]

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

    def enter(self, parameters: frozenset[sp.Symbol]) -> None:
        """What is written down next is an effect's with these fitted parameters (none: that of the instrument).

        What a candidate changes is of first order in its own parameters, all of them ``small``; what others change is of
        second order there, so that the time derivatives of the instrument without them serve.
        """
        candidate = bool(parameters) and parameters <= self.small
        self.about = About(self.small - parameters, 0) if candidate else About(self.small)

    def in_disc_frame(self, v: sp.Matrix) -> sp.Matrix:
        """A vector (3) or tensor (3 x 3) of the measurement frame along the axes in which motion and geometry are resolved.

        These are those of the disc at rest, z along its axis; of a disc as the paper's they are the same.
        """
        return v if self.axes is None else self._turn(self.axes.T, v, "in_disc")

    def in_measurement_frame(self, v: sp.Matrix) -> sp.Matrix:
        """The other way round."""
        return v if self.axes is None else self._turn(self.axes, v, "in_measurement")

    def _turn(self, by: sp.Matrix, v: sp.Matrix, name: str) -> sp.Matrix:
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


Parameters: TypeAlias = Mapping[str, Expr]
"""Parameters of an accelerometer by name: K0, K1, dR, vartheta_y ..."""

STAGES = ("sensing", "disc_angle", "geometry", "field", "instrument", "second_order", "transducer")
"""Those that an effect may change, in their order."""

Kind = Literal["deterministic", "step", "random", "output"]


@dataclass(frozen=True)
class EffectParameter:
    """A parameter that an effect brings.

    Attributes
    ----------
    unit
        Display unit (pint notation); inside the model it is in SI.
    plausible
        Size, in ``unit``, at which a careful engineer would no longer be surprised.
    shared
        One value for the instrument (True) or one for each accelerometer.
    neutral
        Value at which the effect vanishes.
    channel
        Recorded channel without which this parameter alone has no influence (``None``: none).
    fitted
        False for what is set (or scanned), not calibrated by least squares.
    physical
        The only physically possible value besides the neutral one, used where no value is given (``None``: any).
    largest
        Size, in ``unit``, above which anybody would see it without a model (``None``: none): no diagnosis claims a larger one.
    like
        Parameter of the accelerometers (``K1`` ...) that shows the grade of the sensors: where a sheet gives it a sigma
        larger than is plausible of a navigation instrument, what is plausible here is as many times larger.
    late
        Quantities (``a``, ``omega``, ``omegadot``, or a component, ``a_x``) that are recorded later by its value, s,
        than they were true: a fit
        takes them from there, so that ``sensing`` has to describe only what is left of it.
    growing
        Whether they are later by that in every second of the record.
    shape
        Whether it but shapes what the others of the effect do: while these are neutral it has no signature.
    """

    name: str
    latex: str
    unit: str
    meaning: str
    plausible: float
    shared: bool = False
    neutral: float = 0.0
    channel: str | None = None
    fitted: bool = True
    physical: float | None = None
    largest: float | None = None
    like: str | None = None
    late: tuple[str, ...] = ()
    growing: bool = False
    shape: bool = False


def shared(
    name: str, latex: str, unit: str, meaning: str, plausible: float, **further: Any
) -> EffectParameter:
    """A parameter of which the instrument has one value; ``further`` as :class:`EffectParameter` has it."""
    return EffectParameter(name, latex, unit, meaning, plausible, shared=True, **further)


def components(
    letter: str,
    names: Iterable[str],
    unit: str,
    meaning: str,
    plausible: float,
    latex: str = "",
    **further: Any,
) -> tuple[EffectParameter, ...]:
    """A parameter for each component of a vector or tensor, shared unless it is said not to be.

    Parameters
    ----------
    letter
        What all are called: ``G`` gives ``G_xx`` ...
    names
        Of the components, ``x`` or ``xy`` ...
    meaning
        With ``{k}`` for the component, ``{0}``, ``{1}`` for its letters.
    latex
        Letter in formulas, if it is another one.
    further
        Of all parameters alike, as :class:`EffectParameter` has them.
    """
    return tuple(
        EffectParameter(
            f"{letter}_{k}",
            f"{latex or letter}_{k}" if len(k) == 1 else f"{latex or letter}_{{{k}}}",
            unit,
            meaning.format(*k, k=k),
            plausible,
            **{"shared": True} | further,
        )
        for k in names
    )


class Values(dict[str, Expr]):
    """The symbols of an effect's parameters: ``p.K_iii`` or ``p["K_iii"]``."""

    def __getattr__(self, name: str) -> Expr:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"the effect has no parameter {name}") from None


@dataclass(frozen=True)
class Effect:
    """A physical effect. Hooks are pure functions; those left out change nothing.

    Attributes
    ----------
    id, title, physics, source, limits
        Name in commands and files; a heading; a paragraph; where it is described; where it stops to hold.
    parameters
        What it brings. Their symbols are ``p.<name>`` in the hooks.
    channels
        Recorded channels it needs beyond the motion, by column name (``temperature`` ...).
    either
        Whether one of several channels is enough: those that are not recorded then count as zero.
    kind
        ``deterministic``; ``step`` (starts at an unknown instant, parameter ``t_step``); ``random`` (the
        parameter is the size of a random process; the hook gives the sensitivity to it); ``output``
        (acts on the recorded output channel; no hook: its file defines how it is recognised in the values).
    sensing
        (motion, p, c) -> motion at the disc centre from the recorded one.
    disc_angle
        (p, c) -> increment of the disc angle, rad.
    geometry
        (geometry, p, c) -> position and triad in the measurement frame.
    field
        (r, p, c) -> specific force in the measurement frame, m/s^2, added to that of Eq. 11 at r.
    instrument
        (k, p, c) -> changed parameters of the accelerometer (a mapping of those that change).
    second_order
        (q, f, p, c) -> force that the second-order terms see; f is the full sensed force.
    transducer
        (i, f, p, c) -> I_j/K_j1, m/s^2, from that of Eq. 1.
    switches
        Whether it changes at once where an accelerometer's voltage passes zero: a fit then does without the samples of which
        the sheet leaves the side open.
    memory
        What it takes from the record through something with a memory, which its parameters of ``shape`` describe: the motion of
        a ``mount``, the force on an ``accelerometer``, both through a resonance, the torquer's ``heat``, a bias that ``slip``s and
        a mount with ``play``, a bias of ``creep`` and a mount that ``flow``s, a ``cycle`` of temperature (:mod:`derive.hooks`).
    searched
        Whether a diagnosis looks for it; one that can look like many others is only added by name.
    contains
        Effects that it holds as special cases: where one of them does as well, it is no alternative.
    moot
        (order, kinematics) -> whether a model of that kind holds it already, so that it is not offered.
    recogniser
        Of ``output``: source of ``present(values, valid, noise)``, which its file defines (see :mod:`derive.effects`).
    """

    id: str
    title: str
    physics: str
    source: str
    equation: str
    parameters: tuple[EffectParameter, ...]
    limits: str = ""
    channels: tuple[str, ...] = ()
    either: bool = False
    kind: Kind = "deterministic"
    sensing: Callable[[Motion, Values, Context], Motion] | None = None
    disc_angle: Callable[[Values, Context], sp.Expr] | None = None
    geometry: Callable[[Geometry, Values, Context], Geometry] | None = None
    field: Callable[[sp.Matrix, Values, Context], sp.Matrix] | None = None
    instrument: Callable[[Parameters, Values, Context], Parameters] | None = None
    second_order: Callable[[SensedForce, SensedForce, Values, Context], SensedForce] | None = None
    transducer: Callable[[sp.Expr, SensedForce, Values, Context], sp.Expr] | None = None
    switches: bool = False
    memory: str | None = None
    searched: bool = True
    contains: tuple[str, ...] = ()
    moot: Callable[[Order, Kinematics], bool] = lambda order, kinematics: False
    recogniser: str = ""

    def __post_init__(self) -> None:
        names = [q.name for q in self.parameters]
        channels = (*self.channels, *(q.channel for q in self.parameters if q.channel is not None))
        for name in (self.id, *names, *channels):
            if not is_name(name):
                raise ValueError(f"effect {self.id!r:.80}: name {name!r:.80}: expected {EXPECTED}")
        if len(set(names)) != len(names):
            raise ValueError(f"{self.id}: parameter names must differ, found {names}")
        if not names:
            raise ValueError(f"{self.id}: an effect needs at least one parameter")
        hooked = any(getattr(self, stage) for stage in STAGES)
        if self.kind == "output" and hooked:
            raise ValueError(f"{self.id}: an effect of the output channel has no hook")
        if self.kind != "output" and not hooked:
            raise ValueError(f"{self.id}: no stage is changed; give at least one hook")

    @property
    def at_zero(self) -> bool:
        """Whether it does nothing with all its fitted parameters at zero."""
        return all(q.neutral == 0.0 for q in self.parameters if q.fitted)

    def symbol(self, q: EffectParameter) -> sp.Symbol:
        """Symbol of a parameter, unique over all effects."""
        return symbol(parameter_in_code(self.id, q.name))

    @property
    def values(self) -> Values:
        return Values({q.name: self.symbol(q) for q in self.parameters})
