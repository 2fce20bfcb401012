"""G_out folded, for evaluation: a polynomial in the twelve motion numbers as the turning disc sees them.

In the frame of the disc an accelerometer is at rest: with a and M resolved along the radial, the tangential and
the axial direction, its output holds no disc angle at all (this is verified, not assumed). The four differ
from the first by quarter turns, which only swap and change the signs of the numbers. So G_out is one
polynomial in twelve numbers whose coefficients are sums over the accelerometers, and everything that the
instrument's parameters contribute is folded into them beforehand.

That holds for other places than quarter turns and for any order as well: an accelerometer's coefficients in the
disc's own directions then come from a program for its position.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import sympy as sp
from sympy.polys.domains import QQ_I
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement, PolyRing

from derive import stages
from derive.chain import accelerometer, auxiliary_channel, recorded_motion
from derive.effect import RECORDED_SPIN
from derive.harmonics import NotHarmonic, converted, split
from derive.layout import AXES, SymbolicForm, SymbolicLayout, instrument_parameters
from derive.propagation import COEFFICIENT_PARAMETERS, COEFFICIENTS, part, readable, voltage_of_one
from derive.stages import PAPER, Kinematics, Order
from derive.symbols import (
    COS_PHI,
    MOTION,
    QUARTER_TURNS,
    SIGNS,
    SIN_PHI,
    SPIN_ACCELERATION,
    SPIN_RATE,
    Channel,
    Parameter,
    symbol,
)
from derive.tape import Program, Tape, settled

DIRECTIONS = "rtz"
"""Radial, tangential and axial direction of A1."""

TURNED: tuple[str, ...] = (
    *(f"a_{k}" for k in DIRECTIONS if k != "z"), "a_z",
    *(f"M_{i}{k}" for i in DIRECTIONS for k in DIRECTIONS),
)  # fmt: skip
"""a and M along the directions of the turning disc; a_z and M_zz are those of the measurement frame."""

Monomial = tuple[int, ...]
"""Powers of these numbers."""


SPIN_CHANNELS = tuple(auxiliary_channel(n) for n in sorted((SPIN_RATE.name, SPIN_ACCELERATION.name)))
"""Rate and acceleration of the disc angle, which full kinematics need, in the order in which a chain has them."""


@dataclass(frozen=True)
class AccelerometerTerm:
    """What one accelerometer adds to a coefficient: sign times an expression in its parameters."""

    sign: int
    expression: int
    accelerometer: int


@dataclass(frozen=True)
class Folded:
    """G_out by the numbers that the disc sees.

    Attributes
    ----------
    expressions
        What coefficients are made of, in the parameters of one accelerometer (k1, R, ...).
    coefficients
        c[0], c[1], ...: each a sum of parts; none where c[k] of an output is the sum of outputs k of ``own``.
    own
        Of one accelerometer the coefficients, where they depend on its place.
    numbers
        The motion numbers by the inputs and the cosine and sine of the disc angle.
    value
        G_out by the coefficients, as symbols ``c[k]``, and the numbers; nested, so that every product is
        formed once.
    """

    name: str
    title: str
    expressions: tuple[sp.Expr, ...]
    coefficients: tuple[tuple[AccelerometerTerm, ...], ...]
    own: Program
    numbers: Program
    value: sp.Expr
    inputs: tuple[Channel, ...]
    parameters: tuple[Parameter, ...]
    layout: SymbolicLayout

    @property
    def size(self) -> int:
        """Number of coefficients."""
        return len(self.coefficients) or len(self.own.outputs)


def folded(form: SymbolicForm) -> Folded:
    """Derive the folded form of an instrument's outputs."""
    kinematics, layout = form.kinematics, form.layout
    title = "The analytical model of the RAGG, folded for evaluation (paper, Eq. 1-15"
    title += ")." if kinematics == "platform" else ", with the rate of the disc in Eq. 9)."
    if layout.is_paper and form.order == PAPER:
        own = Program((), ())
        monomials, expressions, coefficients = _in_parts()
    else:
        expressions, coefficients = (), ()
        monomials, own = standing(form.order, layout)
    used = tuple(any(m[n] for m in monomials) for n in range(len(TURNED)))
    return Folded(
        name="folded",
        title=title,
        expressions=expressions,
        coefficients=coefficients,
        own=own,
        numbers=_numbers(kinematics, layout, used),
        value=_nest({m: symbol(f"c[{n}]") for n, m in enumerate(monomials)}, 0, _names(layout)),
        inputs=MOTION if kinematics == "platform" else (*MOTION, *SPIN_CHANNELS),
        parameters=instrument_parameters(layout),
        layout=layout.without_common(),
    )


def _in_parts() -> tuple[Sequence[Monomial], tuple[sp.Expr, ...], tuple[tuple[AccelerometerTerm, ...], ...]]:
    """Of the paper's instrument, whose quarter turns only swap numbers: coefficients as sums of few expressions."""
    monomials_of_one = _standing()
    expressions: dict[sp.Expr, int] = {}
    sums: dict[Monomial, list[AccelerometerTerm]] = {}
    for nominal in (True, False):  # equal parts of the coefficients first: little is lost when they cancel
        for j, (sign, quarter) in enumerate(zip(SIGNS, QUARTER_TURNS, strict=True)):
            for powers, coefficient in monomials_of_one.items():
                target, turned_sign = _turn(powers, quarter)
                coefficient_part = part(coefficient, nominal)
                if coefficient_part:
                    number = expressions.setdefault(readable(coefficient_part), len(expressions))
                    sums.setdefault(target, []).append(AccelerometerTerm(sign * turned_sign, number, j))
    monomials = sorted(sums, key=_reading)
    return monomials, tuple(expressions), tuple(tuple(sums[m]) for m in monomials)


def _standing() -> Mapping[Monomial, PolyElement]:
    """V_j of an accelerometer by the numbers along its own directions: powers of TURNED -> coefficient."""
    ring = PolyRing([symbol(n) for n in (*COEFFICIENT_PARAMETERS, *TURNED)], QQ_I, lex)
    spin = _spin()
    a = spin * sp.Matrix([symbol(n) for n in TURNED[:3]])
    M = spin * sp.Matrix(3, 3, [symbol(n) for n in TURNED[3:]]) * spin.T
    motion = {f"a_{x}": a[i] for i, x in enumerate("xyz")}
    motion |= {f"M_{x}{y}": M[i, k] for i, x in enumerate("xyz") for k, y in enumerate("xyz")}
    voltage = voltage_of_one(ring, motion)
    if voltage.highest:
        raise ValueError(
            "in the disc's frame the output still depends on the angle: the model is not symmetric about its axis"
        )
    n = len(COEFFICIENT_PARAMETERS)
    return split(voltage.cosine(0), range(n, n + len(TURNED)), COEFFICIENTS, range(n))


def _spin() -> sp.Matrix:
    """From the directions of the disc to the measurement frame."""
    return sp.Matrix([[COS_PHI, -SIN_PHI, 0], [SIN_PHI, COS_PHI, 0], [0, 0, 1]])


def _turn(powers: Monomial, quarter: int) -> tuple[Monomial, int]:
    """A monomial in an accelerometer's own numbers, ``quarter`` turns ahead, by those of the disc; its sign."""
    place = (("r", 1), ("t", 1)), (("t", 1), ("r", -1)), (("r", -1), ("t", -1)), (("t", -1), ("r", 1))
    to = {**dict(zip("rt", place[quarter], strict=True)), "z": ("z", 1)}
    turned, sign = [0] * len(TURNED), 1
    for name, power in zip(TURNED, powers, strict=True):
        letter, directions = name.split("_")
        sign *= sp.prod(to[d][1] for d in directions) ** power
        turned[TURNED.index(f"{letter}_{''.join(to[d][0] for d in directions)}")] += power
    return tuple(turned), int(sign)


def _nest(terms: Mapping[Monomial, sp.Symbol], first: int, names: tuple[str, ...]) -> sp.Expr:
    """A polynomial as c + v (... ) + w (...): every variable multiplies what holds it, from ``first`` on."""
    rest = dict(terms)
    total = rest.pop((0,) * len(TURNED), sp.Integer(0))
    for n in range(first, len(TURNED)):
        having = {m: c for m, c in rest.items() if m[n]}
        if having:
            lower = {(*m[:n], m[n] - 1, *m[n + 1 :]): c for m, c in having.items()}
            total += symbol(names[n]) * _nest(lower, n, names)
            rest = {m: c for m, c in rest.items() if m not in having}
    return total


def _names(layout: SymbolicLayout) -> tuple[str, ...]:
    """Of the turned numbers; where the disc's axis is not that of the measurement frame, its direction is called s."""
    return tuple(n.replace("z", "s") for n in TURNED) if layout.has(AXES[0, 0]) else TURNED


def _numbers(kinematics: Kinematics, layout: SymbolicLayout, used: tuple[bool, ...]) -> Program:
    """The turned numbers by the inputs and cos_phi, sin_phi, shared subexpressions apart."""
    tape = Tape()
    motion = recorded_motion()
    M = tape.let_each("M", stages.gradient(motion))
    spin = _spin()
    if layout.has(AXES[0, 0]):
        spin = (AXES * spin).xreplace(dict(layout.common))
        spin = sp.Matrix(3, 3, lambda i, k: tape.let(f"e_{DIRECTIONS[k]}{'xyz'[i]}", spin[i, k]))
    label = "M" if kinematics == "platform" else "of_platform"  # M_zr is in full kinematics more than that
    along = DIRECTIONS[:2] + _names(layout)[-1][-1]
    half = tape.let_each(label, M * spin, columns=along)  # along x, y, z of what a step along r, t, z changes
    turned = spin.T * half
    if (
        kinematics == "full"
    ):  # what the spin adds looks from the disc as from the platform: its large part stays exact
        turned += stages.spin_gradient(motion._replace(omega=spin.T * motion.omega), RECORDED_SPIN)
    outputs = zip(_names(layout), (*(spin.T * motion.a), *turned), strict=True)
    used_outputs = [x for x, u in zip(outputs, used, strict=True) if u]
    return settled(tape.assignments, {}).program(used_outputs)


class Polynomial(dict[Monomial, sp.Expr]):
    """Coefficients by their monomials."""

    def __add__(self, other: Polynomial) -> Polynomial:
        total = Polynomial(self)
        for m, c in other.items():
            total[m] = total[m] + c if m in total else c
        return total

    def __mul__(self, other: Polynomial) -> Polynomial:
        products: dict[Monomial, list[sp.Expr]] = {}
        for m, c in self.items():
            for n, d in other.items():
                products.setdefault(tuple(a + b for a, b in zip(m, n, strict=True)), []).append(c * d)
        return Polynomial({m: sp.Add(*terms) for m, terms in products.items()})


def standing(order: Order, layout: SymbolicLayout) -> tuple[Sequence[Monomial], Program]:
    """V_j by the numbers :data:`TURNED`, at the angle 0 of the disc, whose directions are x, y and z there.

    The monomials that occur, and the program that gives their coefficients. What vanishes for every place of the layout is
    left out.
    """
    on_disc = {s.name for s in AXES}
    level = replace(layout, constants={n: v for n, v in layout.constants.items() if n not in on_disc})
    chain = accelerometer((), SymbolicForm(order, layout=level))
    tape, named = Tape(), chain.tape.assignments
    names = [*(f"a_{i}" for i in "xyz"), *(f"M_{i}{k}" for i in "xyz" for k in "xyz")]
    one: Monomial = (0,) * len(names)
    values = {
        symbol(n): Polynomial({tuple(int(k == at) for k in range(len(names))): sp.Integer(1)})
        for at, n in enumerate(names)
    }
    values |= {COS_PHI: Polynomial({one: sp.Integer(1)}), SIN_PHI: Polynomial()}  # the disc at its angle 0

    def of_symbol(s: sp.Symbol) -> Polynomial:
        return values.get(s, Polynomial({one: s}))

    def of_other(e: sp.Expr) -> Polynomial:
        inner = [converted(a, of_symbol, of_other) for a in e.args]
        if any(m != one for p in inner for m in p):
            raise NotHarmonic(f"{e} is no polynomial in the motion numbers")
        return Polynomial({one: e.func(*(p.get(one, sp.Integer(0)) for p in inner)) if e.args else e})

    for s, e in named:
        if s not in values:
            terms = converted(e, of_symbol, of_other).items()
            named_terms = {m: tape.let(f"{s.name}_{''.join(map(str, m))}", c) for m, c in terms if c != 0}
            values[s] = Polynomial(named_terms)
    voltage = converted(chain.voltage, of_symbol, of_other)
    outputs = [("".join(map(str, m)), c) for m, c in voltage.items()]
    kept = _find_occurring(tape, outputs, layout)
    monomials = sorted((m for m, (n, _) in zip(voltage, outputs, strict=True) if n in kept), key=_reading)
    at = dict(zip(voltage, outputs, strict=True))
    return monomials, settled(tape.assignments, dict(layout.common)).program([at[m] for m in monomials])


def _reading(m: Monomial) -> tuple[object, ...]:
    """By degree, then by the first number."""
    return sum(m), tuple(-k for k in m)


def _find_occurring(tape: Tape, outputs: Sequence[tuple[str, sp.Expr]], layout: SymbolicLayout) -> set[str]:
    """Outputs that do not vanish at some place of the layout, by its constants that are 0, 1 or -1."""
    places = {
        tuple((n, int(v[j])) for n, v in layout.constants.items() if v[j] in (0.0, 1.0, -1.0))
        for j in range(layout.size)
    }
    names: set[str] = set()
    for place in places:
        values: dict[sp.Symbol, sp.Expr] = {symbol(n): sp.Integer(v) for n, v in place}
        for s, e in tape.assignments:
            changed = e.xreplace(values)
            if changed.is_Atom or (-changed).is_Atom:
                values[s] = changed
        names |= {n for n, e in outputs if e.xreplace(values) != 0}
    return names
