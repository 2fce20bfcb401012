"""The paper's notation: motion numbers T_1 ... T_6, S_1 ... S_5, and error-propagation coefficients.

T and S are not typed in: they are *defined* by how the gradient M = [omegadot]x + [omega]x[omega]x - Gamma
looks from the turning disc, and Eq. 16 follows. D^12, D^34, D^1234 and Sigma fall out of adding the four
accelerometers with their signs and places on the disc (Eq. 15).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from typing import Literal

import sympy as sp
from sympy import QQ
from sympy.polys.domains import QQ_I
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement, PolyRing

from derive import stages
from derive.chain import accelerometer, recorded_motion
from derive.effect import RECORDED_SPIN
from derive.harmonics import Series, constant, rotating, series, split
from derive.stages import Kinematics
from derive.symbols import COS_J, COS_PHI, QUARTER_TURNS, SIGNS, SIN_J, SIN_PHI, symbol

Combination = Literal["D12", "D34", "D1234", "Sigma"]

MOTION_NUMBERS: tuple[str, ...] = (
    "a_x", "a_y", "a_z", "T_1", "T_2", "T_3", "T_4", "T_5", "T_6", "S_1", "S_2", "S_4",
)  # fmt: skip
"""The twelve numbers that carry all motion: three of a, nine of M. (S_3 and S_5 are sums of T's.)"""

COEFFICIENT_PARAMETERS: tuple[str, ...] = (
    "k1", "R", "beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z",
    "K0", "K2", "K4", "K5", "K6", "K7", "K8",
)  # fmt: skip
"""What error-propagation coefficients are made of: k1 = k_VI K1 and R = radius + dR (Eq. 6a)."""


@cache
def _numbers_of_gradient() -> dict[str, sp.Expr]:
    """T and S by the entries of M, read off the harmonics of M as the turning disc sees it.

    Seen from an accelerometer at disc angle psi, a step along the radius changes the tangential force by
    T_6 + T_1 sin 2 psi + T_2 cos 2 psi, the radial one by -T_5 on average over a turn, and the axial one
    by -T_3 sin psi - T_4 cos psi. A step along z changes a_x by -S_1, a_y by -S_2, a_z by -S_4;
    a step along y changes a_y by -S_3, and one along x changes a_y by S_5.
    """
    M = sp.Matrix(3, 3, lambda i, k: symbol(f"M_{'xyz'[i]}{'xyz'[k]}"))
    ring = PolyRing(list(M), QQ_I, lex)
    turning = dict(zip((COS_PHI, SIN_PHI), rotating(ring), strict=True))
    radial, tangential = sp.Matrix([COS_PHI, SIN_PHI, 0]), sp.Matrix([-SIN_PHI, COS_PHI, 0])
    step = M * radial
    seen = {
        name: series((), axis.dot(step), ring, turning)
        for name, axis in (("t", tangential), ("r", radial), ("z", sp.Matrix([0, 0, 1])))
    }
    return {
        "T_1": seen["t"].sine(2).as_expr(),
        "T_2": seen["t"].cosine(2).as_expr(),
        "T_3": -seen["z"].sine(1).as_expr(),
        "T_4": -seen["z"].cosine(1).as_expr(),
        "T_5": -seen["r"].cosine(0).as_expr(),
        "T_6": seen["t"].cosine(0).as_expr(),
        "S_1": -M[0, 2],
        "S_2": -M[1, 2],
        "S_3": -M[1, 1],
        "S_4": -M[2, 2],
        "S_5": M[1, 0],
    }


@cache
def motion_numbers(kinematics: Kinematics = "platform") -> dict[str, sp.Expr]:
    """T_1 ... T_6 and S_1 ... S_5 in omega, omegadot and Gamma, s^-2 (Eq. 16); in full kinematics in phi', phi'' too."""
    motion = recorded_motion()
    M = stages.gradient(motion if kinematics == "platform" else stages.of_disc(motion, RECORDED_SPIN))
    entries = {symbol(f"M_{'xyz'[i]}{'xyz'[k]}"): M[i, k] for i in range(3) for k in range(3)}
    return {name: sp.expand(e.xreplace(entries)) for name, e in _numbers_of_gradient().items()}


@cache
def gradient_in_motion_numbers() -> dict[str, sp.Expr]:
    """The entries M_xx ... M_zz by T and S: the inverse of :func:`motion_numbers`."""
    names = [n for n in MOTION_NUMBERS if n[0] in "TS"]
    entries = [symbol(f"M_{i}{k}") for i in "xyz" for k in "xyz"]
    forward = _numbers_of_gradient()
    solution = next(iter(sp.linsolve([symbol(n) - forward[n] for n in names], entries)))
    return {s.name: value for s, value in zip(entries, solution, strict=True)}


@dataclass(frozen=True)
class MonomialTerm:
    """One term of an amplitude: combination[coefficient] times a monomial of motion numbers.

    ``motion`` holds the powers of :data:`MOTION_NUMBERS`; ``coefficient`` is a polynomial in
    :data:`COEFFICIENT_PARAMETERS` of one accelerometer, which ``combination`` sums over the four.
    """

    motion: tuple[int, ...]
    combination: Combination
    coefficient: PolyElement


@dataclass(frozen=True)
class Collected:
    """G_out as a Fourier series in the disc angle (Eq. 17): amplitudes A_0, A_1c, A_1s ... A_4s.

    ``generic`` is the series of one accelerometer in its own angle, from which the amplitudes follow:
    (harmonic, "c" or "s") -> {powers of the motion numbers: polynomial in the parameters}.
    """

    amplitudes: Mapping[str, tuple[MonomialTerm, ...]]
    generic: Mapping[tuple[int, str], Mapping[tuple[int, ...], PolyElement]]
    ring: PolyRing

    @cached_property
    def largest(self) -> Mapping[tuple[int, tuple[int, ...], tuple[int, ...]], Fraction]:
        """(harmonic, powers of the motion numbers, powers of the parameters) -> size of its coefficient, the larger of both phases'."""
        sizes: dict[tuple[int, tuple[int, ...], tuple[int, ...]], Fraction] = {}
        for (n, _), terms in self.generic.items():
            for motion, coefficient in terms.items():
                for parameters, c in coefficient.terms():
                    value = abs(Fraction(int(c.numerator), int(c.denominator)))
                    sizes[n, motion, parameters] = max(value, sizes.get((n, motion, parameters), value))
        return sizes


def monomial(powers: Sequence[int]) -> sp.Expr:
    """A product of powers of :data:`MOTION_NUMBERS`."""
    return sp.Mul(*(symbol(n) ** k for n, k in zip(MOTION_NUMBERS, powers, strict=True)))


COEFFICIENTS = PolyRing([symbol(n) for n in COEFFICIENT_PARAMETERS], QQ, lex)
"""The ring of error-propagation coefficients of one accelerometer, over the rationals."""

_ALL = PolyRing([symbol(n) for n in COEFFICIENT_PARAMETERS + MOTION_NUMBERS], QQ_I, lex)


@cache
def collect() -> Collected:
    """Derive Eq. 17-19 with the paper's order counting.

    They hold for either kinematics: the spin is in the motion numbers alone.
    """
    return from_generic(_generic(voltage_of_one(_ALL, gradient_in_motion_numbers())))


def voltage_of_one(ring: PolyRing, motion: Mapping[str, sp.Expr]) -> Series:
    """V_j at the disc angle of A1, in k1 = k_VI K1 and R = radius + dR (Eq. 6a).

    ``motion`` are a and M, as far as they are no generators of the ring, by generators and the cosine and sine of the angle.
    """
    generator = {s.name: constant(ring, g) for s, g in zip(ring.symbols, ring.gens, strict=True)}
    one, zero = constant(ring, ring.one), constant(ring, ring.zero)
    turning = dict(zip((COS_PHI, SIN_PHI), rotating(ring), strict=True))
    values = turning | {symbol(n): series((), e, ring, turning) for n, e in motion.items()}
    values |= {COS_J: one, SIN_J: zero, symbol("k_VI"): one, symbol("radius"): zero}
    values |= {symbol("K1"): generator["k1"], symbol("dR"): generator["R"]}
    a = accelerometer()
    return series(a.tape.assignments, a.voltage, ring, values)


def ideal(c: Collected) -> dict[str, tuple[MonomialTerm, ...]]:
    """Eq. 30: what is left for four equal accelerometers, perfectly mounted, without second-order terms.

    Imbalances D vanish, and of Sigma what is made of k1 and R alone remains.
    """
    left: dict[str, tuple[MonomialTerm, ...]] = {}
    for name, terms in c.amplitudes.items():
        sums = [(t, part(t.coefficient, nominal=True)) for t in terms if t.combination == "Sigma"]
        if kept := tuple(MonomialTerm(t.motion, t.combination, pure) for t, pure in sums if pure):
            left[name] = kept
    return left


def _generic(v: Series) -> dict[tuple[int, str], dict[tuple[int, ...], PolyElement]]:
    n = len(COEFFICIENT_PARAMETERS)
    inner, outer = range(n), range(n, n + len(MOTION_NUMBERS))
    parts: dict[tuple[int, str], PolyElement] = {(0, "c"): v.cosine(0)}
    for k in range(1, v.highest + 1):
        parts[k, "c"], parts[k, "s"] = v.cosine(k), v.sine(k)
    return {key: split(p, outer, COEFFICIENTS, inner) for key, p in parts.items()}


def from_generic(generic: Mapping[tuple[int, str], Mapping[tuple[int, ...], PolyElement]]) -> Collected:
    """Add the four accelerometers: the series of one, in its own angle, becomes the amplitudes of G_out."""
    amplitudes: dict[str, tuple[MonomialTerm, ...]] = {}
    for n, phase in generic:
        terms: dict[tuple[tuple[int, ...], Combination], PolyElement] = {}
        for source in ("c", "s"):
            for motion, coefficient in generic.get((n, source), {}).items():
                for combination, sign in _combinations(n, source, phase):
                    key = (motion, combination)
                    signed = coefficient if sign > 0 else -coefficient
                    terms[key] = terms[key] + signed if key in terms else signed
        ordered = sorted((k for k in terms if terms[k]), key=lambda k: (_reading_order(k[0]), k[1]))
        amplitudes[amplitude_name(n, phase)] = tuple(MonomialTerm(m, c, terms[m, c]) for m, c in ordered)
    return Collected(amplitudes, generic, COEFFICIENTS)


def amplitude_name(n: int, phase: str) -> str:
    """A_0, A_1c, A_1s ...: the amplitude of 1, cos(n Omega t), sin(n Omega t)."""
    return "A_0" if n == 0 else f"A_{n}{phase}"


def part(p: PolyElement, nominal: bool) -> PolyElement:
    """Of a coefficient the part k1^m R^n that all accelerometers share but for scale, or the rest.

    D^12[k1 (1 + small)] would round 1 + small, and its product with k1, before nearly equal numbers are
    subtracted; D^12[k1] + D^12[k1 small] does not. It halves the round-off of the whole model.
    """
    return p.ring.from_dict({m: c for m, c in p.terms() if nominal != any(m[2:])})


def readable(p: PolyElement) -> sp.Expr:
    """k1 R (...): the common factor first, as the paper writes it."""
    content, primitive = p.primitive()
    lowest = tuple(min(m[n] for m in primitive.monoms()) for n in range(len(p.ring.gens)))
    divided = {tuple(a - b for a, b in zip(m, lowest, strict=True)): c for m, c in primitive.terms()}
    common = p.ring.from_dict({lowest: content}).as_expr()
    return sp.Mul(common, p.ring.from_dict(divided).as_expr(), evaluate=len(divided) == 1)


def _reading_order(motion: tuple[int, ...]) -> tuple[object, ...]:
    """Terms without T, S and a first; then by degree and by the first motion number."""
    return (sum(motion), tuple(-p for p in motion))


_PATTERNS: Mapping[tuple[int, ...], Combination] = {
    (1, 1, 1, 1): "Sigma", (1, 1, -1, -1): "D1234", (1, -1, 0, 0): "D12", (0, 0, 1, -1): "D34",
}  # fmt: skip


@cache
def _combinations(n: int, source: str, target: str) -> Sequence[tuple[Combination, int]]:
    """How cos or sin(n psi_j) of the four accelerometers adds to cos or sin(n phi) of G_out.

    With psi_j = phi + q_j 90 deg: cos(n psi) = cos(n q 90) cos(n phi) - sin(n q 90) sin(n phi), and the
    like for sin. The four weights are one of Sigma, D^1234, or a sum of D^12 and D^34.
    """
    weights = []
    for q, sign in zip(QUARTER_TURNS, SIGNS, strict=True):
        turn = (1, 0, -1, 0)[n * q % 4], (0, 1, 0, -1)[n * q % 4]
        matrix = {("c", "c"): turn[0], ("c", "s"): -turn[1], ("s", "s"): turn[0], ("s", "c"): turn[1]}
        weights.append(sign * matrix[source, target])
    if n % 2:
        halves = ((*weights[:2], 0, 0), (0, 0, *weights[2:]))
        patterns = [h for h in halves if any(h)]
    else:
        patterns = [tuple(weights)] if any(weights) else []
    return [(_PATTERNS[p], 1) if p in _PATTERNS else (_PATTERNS[tuple(-w for w in p)], -1) for p in patterns]
