"""Harmonics of the outputs of any layout, at any order: Eq. 17-19 for accelerometers that are anywhere.

By its own angle on the disc every accelerometer of an instrument has the same series: motion numbers of its disc times
coefficients that are made of where it is (r), where its input axis points (i) and what its transducer does (k1, K0, and Q,
its second-order terms by the directions of the disc). Adding
accelerometers at angles alpha_j with their signs s_j weighs harmonic n by s_j cos(n alpha_j) and s_j sin(n alpha_j): these
are what D^12, D^34, D^1234 and Sigma become. Of four quarter turns they are those four, which is found, not assumed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

import sympy as sp
from sympy import QQ
from sympy.polys.domains import QQ_I
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement, PolyRing

from derive import stages
from derive.folded import SPIN_CHANNELS
from derive.harmonics import Series, rotating, series, split
from derive.layout import AXES, HEIGHT, TURN, Layout, instrument_parameters
from derive.propagation import MOTION_NUMBERS, gradient_in_motion_numbers, motion_numbers
from derive.stages import Kinematics, Order
from derive.symbols import COS_PHI, MOTION, SECOND_ORDER, SIN_PHI, Channel, Parameter, symbol
from derive.tape import Program, Tape, partials, settled

_DIRECTIONS = "rtz"

Generic = Mapping[tuple[int, str], Mapping[tuple[int, ...], sp.Expr]]
"""(harmonic, "c" or "s") -> {powers of the motion numbers: coefficient in the numbers of a place}."""


@dataclass(frozen=True)
class Combination:
    """A weighted sum over the accelerometers of an output: D^12 and its like.

    ``weights`` has one number for each member, ``rest`` what the exact weights have beyond these.
    """

    name: str
    weights: tuple[float, ...]
    rest: tuple[float, ...]


@dataclass(frozen=True)
class OutputHarmonics:
    """An output as a Fourier series in its disc's angle.

    ``weighed`` says for (harmonic, "c" or "s") which combination the weights s_j cos(n alpha_j), s_j sin(n alpha_j) are,
    and its sign; those that vanish are left out.
    """

    name: str
    members: tuple[int, ...]
    combinations: tuple[Combination, ...]
    weighed: Mapping[tuple[int, str], tuple[str, int]]

    def amplitude(
        self, generic: Generic, n: int, phase: str
    ) -> Mapping[tuple[tuple[int, ...], str], sp.Expr]:
        """The amplitude of cos or sin(n phi): (motion monomial, combination) -> what is combined.

        With psi_j = phi + alpha_j, cos n psi_j = cos(n alpha_j) cos n phi - sin(n alpha_j) sin n phi, and the like for sin.
        """
        found: dict[tuple[tuple[int, ...], str], sp.Expr] = {}
        for source in ("c", "s"):
            weight = self.weighed.get((n, "c" if source == phase else "s"))
            if weight is None:
                continue
            turn = -1 if (source, phase) == ("c", "s") else 1
            for motion, coefficient in generic.get((n, source), {}).items():
                key = (motion, weight[0])
                found[key] = found.get(key, sp.Integer(0)) + turn * weight[1] * coefficient
        return {k: v for k, v in found.items() if v != 0}


@dataclass(frozen=True)
class LayoutHarmonics:
    """The outputs of an instrument in the paper's form.

    Attributes
    ----------
    generic
        The series of one accelerometer in its own angle.
    place
        The numbers of a place that occur (``k1``, ``r_r`` ..., ``i_r`` ..., ``Q_rr`` ...) by the parameters and the layout's
        constants, in order; ``q`` is the place that second-order terms see, where it is another than ``r``.
    numbers
        T_1 ... S_4 that occur, by the inputs along the axes of the disc at rest.
    axes
        The inputs along the axes of the disc at rest; without outputs where all discs are level.
    """

    title: str
    generic: Generic
    place: tuple[tuple[str, sp.Expr], ...]
    numbers: tuple[tuple[str, sp.Expr], ...]
    axes: Program
    outputs: tuple[OutputHarmonics, ...]
    layout: Layout
    inputs: tuple[Channel, ...]
    parameters: tuple[Parameter, ...]

    @property
    def highest(self) -> int:
        return max(n for n, _ in self.generic)


def layout_harmonics(title: str, order: Order, kinematics: Kinematics, layout: Layout) -> LayoutHarmonics:
    """Derive the harmonics of an instrument's outputs."""
    values = numbers_of_place(order, layout)
    generic = generic_series(
        tuple((n, v) for n, v in values.items() if v.is_Integer), order.second_order_angles
    )
    plain = {symbol(n): v for n, v in values.items() if n in _Q and v.as_coeff_Mul()[1].is_Symbol}
    if plain:  # of nominal axes K_2 and the like stand by themselves
        generic = {key: {m: e.xreplace(plain) for m, e in of.items()} for key, of in generic.items()}
    used = {s.name for of in generic.values() for e in of.values() for s in e.free_symbols}
    used |= {s.name for n, v in values.items() if n in used for s in v.free_symbols}  # Q by the axes
    moved = {k for of in generic.values() for m in of for k, power in enumerate(m) if power}
    numbers = motion_numbers(kinematics)
    return LayoutHarmonics(
        title=title,
        generic=generic,
        place=tuple((n, v) for n, v in values.items() if n in used),
        numbers=tuple((n, numbers[n]) for k, n in enumerate(MOTION_NUMBERS) if k in moved and n in numbers),
        axes=_along_axes(layout),
        outputs=tuple(_output(layout, k) for k in range(len(layout.outputs))),
        layout=layout.without_common(),
        inputs=MOTION if kinematics == "platform" else (*MOTION, *SPIN_CHANNELS),
        parameters=instrument_parameters(layout),
    )


@cache
def numbers_of_place(order: Order, layout: Layout) -> Mapping[str, sp.Expr]:
    """The numbers of an accelerometer at its place: k1, K0, its input axis i, its place r, and Q of second-order terms.

    Where these terms do not see the angles, their place is another one: q.
    """
    common = dict(layout.common)
    turn = TURN.xreplace(common) if layout.has(TURN[0, 0]) else None
    height = HEIGHT.xreplace(common) if layout.has(HEIGHT) else sp.Integer(0)
    arm = symbol("radius") + symbol("dR")
    x, y, z = (symbol(f"vartheta_{k}") for k in "xyz")
    C = stages.misalignment_matrix(x, y, z, order.misalignment)
    g = stages.mounting(arm, symbol("beta_x"), symbol("beta_z"), order, height, turn)
    level = stages.mounting(arm, sp.Integer(0), sp.Integer(0), order, height, turn)
    found = {"k1": symbol("k_VI") * symbol("K1"), "K0": symbol("K0")}
    found |= dict(zip(_R, g.r, strict=True)) | dict(zip(_I, (C * g.tau)[0, :], strict=True))
    if order.second_order_angles:
        found |= dict(zip(_OP, (C * g.tau)[1:, :], strict=True))
        axes = sp.Matrix(3, 3, [symbol(n) for n in (*_I, *_OP)])
        found |= dict(zip(_Q, _second_order(axes), strict=True))
    else:
        found |= dict(zip(_Q, _second_order(level.tau), strict=True)) | dict(zip(_QR, level.r, strict=True))
    return {n: sp.sympify(v) for n, v in found.items()}


_I, _R, _QR = (tuple(f"{n}_{d}" for d in _DIRECTIONS) for n in "irq")
_OP = tuple(f"{n}_{d}" for n in "op" for d in _DIRECTIONS)
_PAIRS = tuple((k, m) for k in range(3) for m in range(k, 3))
_Q = tuple(f"Q_{_DIRECTIONS[k]}{_DIRECTIONS[m]}" for k, m in _PAIRS)


def _second_order(axes: sp.Matrix) -> list[sp.Expr]:
    """Q_rr, Q_rt ...: the second-order terms of Eq. 1 as a quadratic form in f along the disc's directions."""
    f = sp.Matrix([symbol(f"f_{d}") for d in _DIRECTIONS])
    sensed = stages.SensedForce(*(axes * f))
    bracket = stages.transducer(sensed, sensed, {n: symbol(n) for n in ("K0", *SECOND_ORDER)})
    slopes = [partials(sp.sympify(partials(bracket).get(s, 0))) for s in f]
    return [slopes[k].get(f[m], sp.Integer(0)) / 2 for k, m in _PAIRS]


def generic_series(constants: tuple[tuple[str, sp.Integer], ...], one_place: bool) -> Generic:
    """As :func:`generic_polynomials`, to be read."""
    return {key: _readable(p) for key, p in generic_polynomials(constants, one_place).items()}


@cache
def generic_polynomials(
    constants: tuple[tuple[str, sp.Integer], ...], one_place: bool
) -> Mapping[tuple[int, str], Mapping[tuple[int, ...], PolyElement]]:
    """The series of one accelerometer; ``one_place``: second-order terms see the same place as the linear one."""
    fixed = {symbol(n): v for n, v in constants}
    names = ("k1", "K0", *_I, *_R, *_Q, *(() if one_place else _QR))
    open_ = [symbol(n) for n in names if symbol(n) not in fixed]
    ring = PolyRing([*open_, *(symbol(n) for n in MOTION_NUMBERS)], QQ_I, lex)
    known: dict[sp.Symbol, Series] = dict(zip((COS_PHI, SIN_PHI), rotating(ring), strict=True))
    known |= {symbol(n): series((), v, ring, {}) for n, v in gradient_in_motion_numbers().items()}
    # what the disc sees of a and M at its own angle
    spin = sp.Matrix([[COS_PHI, -SIN_PHI, 0], [SIN_PHI, COS_PHI, 0], [0, 0, 1]])
    a = spin.T * sp.Matrix([symbol(f"a_{k}") for k in "xyz"])
    M = spin.T * sp.Matrix(3, 3, lambda i, k: symbol(f"M_{'xyz'[i]}{'xyz'[k]}")) * spin
    tape = Tape()

    def force(at: Sequence[str]) -> list[sp.Expr]:
        f = a + M * sp.Matrix([symbol(n) for n in at]).xreplace(fixed)
        return [tape.let(f"f_{at[k]}", f[k]) for k in range(3)]

    def number(name: str) -> sp.Expr:
        return symbol(name).xreplace(fixed)

    f = force(_R)
    q = f if one_place else force(_QR)
    bracket = number("K0") + sum(number(n) * x for n, x in zip(_I, f, strict=True))
    bracket += sum(
        (1 if k == m else 2) * number(n) * q[k] * q[m] for n, (k, m) in zip(_Q, _PAIRS, strict=True)
    )
    v = series(tape.assignments, symbol("k1") * bracket, ring, known)
    inner, outer = range(len(open_)), range(len(open_), len(ring.gens))
    own = PolyRing(open_, QQ, lex)
    parts = {(0, "c"): v.cosine(0)}
    for n in range(1, v.highest + 1):
        parts |= {(n, "c"): v.cosine(n), (n, "s"): v.sine(n)}
    return {key: split(p, outer, own, inner) for key, p in parts.items()}


def _readable(terms: Mapping[tuple[int, ...], PolyElement]) -> Mapping[tuple[int, ...], sp.Expr]:
    """By degree in the motion numbers, then by the first; k1 stands before a sum that it multiplies."""
    in_order = sorted((m for m in terms if terms[m]), key=lambda m: (sum(m), tuple(-k for k in m)))
    k1 = symbol("k1")
    rest = {m: sp.expand(terms[m].as_expr() / k1) for m in in_order}
    return {m: sp.Mul(k1, e, evaluate=not e.is_Add) for m, e in rest.items()}


def _along_axes(layout: Layout) -> Program:
    """The motion along the axes of the disc at rest, by the names that the inputs have."""
    if not layout.has(AXES[0, 0]):
        return Program((), ())
    v = {c.name: c.symbol for c in MOTION}
    gradient = sp.Matrix(3, 3, lambda i, k: v["Gamma_" + "".join(sorted("xyz"[i] + "xyz"[k]))])
    vectors = [(n, AXES.T * sp.Matrix([v[f"{n}_{k}"] for k in "xyz"])) for n in ("a", "omega", "omegadot")]
    turned = AXES.T * gradient * AXES
    outputs = [(f"{n}_{'xyz'[k]}", e[k]) for n, e in vectors for k in range(3)]
    outputs += [(f"Gamma_{'xyz'[i]}{'xyz'[k]}", turned[i, k]) for i in range(3) for k in range(i, 3)]
    return settled((), dict(layout.common)).program(outputs)


_PAPER: Sequence[tuple[str, tuple[int, ...]]] = (
    ("D12", (1, -1, 0, 0)), ("D34", (0, 0, 1, -1)), ("D1234", (1, 1, -1, -1)), ("Sigma", (1, 1, 1, 1)),
)  # fmt: skip

_NOTHING = Fraction(1, 10**25)
"""A weight below it is zero: constants and their rest are exact to 1e-32."""


def _output(layout: Layout, which: int) -> OutputHarmonics:
    o = layout.outputs[which]
    exact = [
        [
            Fraction(layout.constants[n][j]) + Fraction(layout.rest[n][j] if n in layout.rest else 0)
            for j in o.members
        ]
        for n in ("cos_j", "sin_j")
    ]
    named: list[tuple[str, list[Fraction]]] = [
        (n, [Fraction(w) for w in ws]) for n, ws in _PAPER if len(o.members) == 4
    ]
    weighed: dict[tuple[int, str], tuple[str, int]] = {}
    cosines, sines = [Fraction(1)] * len(o.members), [Fraction(0)] * len(o.members)
    for n in range(HIGHEST + 1):
        for phase, of in (("c", cosines), ("s", sines)):
            weights = [s * w for s, w in zip(o.signs, of, strict=True)]
            if any(abs(w) > _NOTHING for w in weights):
                weighed[n, phase] = _named(named, weights, f"{'C' if phase == 'c' else 'S'}{n}")
        cosines, sines = (
            [c * x - s * y for c, s, x, y in zip(cosines, sines, *exact, strict=True)],
            [s * x + c * y for c, s, x, y in zip(cosines, sines, *exact, strict=True)],
        )
    used = {name for name, _ in weighed.values()}
    combinations = tuple(_combination(n, ws) for n, ws in named if n in used)
    return OutputHarmonics(o.name, o.members, combinations, weighed)


HIGHEST = 4
"""Second-order terms square what turns twice with the disc."""


def _named(named: list[tuple[str, list[Fraction]]], weights: list[Fraction], name: str) -> tuple[str, int]:
    """The combination that has these weights but for the sign: one that is known, or a new one."""
    for known, of in named:
        for sign in (1, -1):
            if all(abs(w - sign * x) < _NOTHING for w, x in zip(weights, of, strict=True)):
                return known, sign
    named.append((name, weights))
    return name, 1


def _combination(name: str, weights: Sequence[Fraction]) -> Combination:
    near = tuple(0.0 if abs(w) < _NOTHING else float(w) for w in weights)
    rest = tuple(
        0.0 if x == 0.0 or abs(w - Fraction(x)) < _NOTHING else float(w - Fraction(x))
        for w, x in zip(weights, near, strict=True)
    )
    return Combination(name, near, rest)
