"""Exact evaluation of printed and derived equations at the points of :mod:`derive.audit.direct`.

Everything is rational, so equal means equal: a right equation leaves 0, a misprint leaves a number.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import cache

from sympy.polys.rings import PolyElement

from derive.audit import direct
from derive.audit.compare import MOTION
from derive.audit.reading import motion_reader
from derive.propagation import COEFFICIENT_PARAMETERS

_WEIGHTS = {"D12": (1, -1, 0, 0), "D34": (0, 0, 1, -1), "D1234": (1, 1, -1, -1), "Sigma": (1, 1, 1, 1)}
"""Weights of A_1 ... A_4 as the paper defines its combinations below Eq. 19."""


def value(p: PolyElement, numbers: Mapping[str, Fraction]) -> Fraction:
    """A polynomial at named numbers."""
    total = Fraction(0)
    names = [s.name for s in p.ring.symbols]
    for powers, c in p.terms():
        product = Fraction(int(c.numerator), int(c.denominator))
        for n, k in zip(names, powers, strict=True):
            if k:
                product *= numbers[n] ** k
        total += product
    return total


@cache
def _printed_motion() -> Mapping[str, PolyElement]:
    """The printed Eq. 16 as it is read."""
    reader = motion_reader()
    return {e.left: sum(map(reader.read, e.terms), reader.ring.zero) for e in MOTION}


def motion_numbers(point: direct.NumericPoint) -> dict[str, Fraction]:
    """T_1 ... S_5 by the *printed* Eq. 16, and everything else that Eq. 18 and 19 name."""
    rates = direct.rates(point)
    square = rates.pop("omega_im^2")
    # omega_im occurs squared only; its own value, perhaps irrational, is never needed.
    numbers = {f"a_{k}": v for k, v in zip("xyz", point.a, strict=True)}
    for left, p in _printed_motion().items():
        at = [s.name for s in p.ring.symbols].index("omega_im")
        total = Fraction(0)
        for powers, c in p.terms():
            plain = p.ring.from_dict({tuple(0 if n == at else k for n, k in enumerate(powers)): c})
            total += value(plain, rates) * (square if powers[at] else 1)
        numbers[left] = total
    return numbers | {n: rates[n] for n in ("omegadot_x", "omegadot_y")}


Named = tuple[tuple[str, int], ...]


def amplitude_value(p: PolyElement, point: direct.NumericPoint, motion: Mapping[str, Fraction]) -> Fraction:
    """An amplitude of Eq. 18 or 19 (independent motion numbers only) for the point's four accelerometers."""
    names = [s.name for s in p.ring.symbols]
    by_motion: dict[Named, Fraction] = {}
    for powers, c in p.terms():
        named = [(n, k) for n, k in zip(names, powers, strict=True) if k]
        weights = next(_WEIGHTS[n] for n, _ in named if n in _WEIGHTS)
        of_parameters = [(n, k) for n, k in named if n in COEFFICIENT_PARAMETERS]
        inner = Fraction(0)
        for j, w in enumerate(weights):
            if w:
                inner += w * _product((point.accelerometers[n][j], k) for n, k in of_parameters)
        outer = tuple((n, k) for n, k in named if n in motion)
        coefficient = Fraction(int(c.numerator), int(c.denominator)) * inner
        by_motion[outer] = by_motion.get(outer, Fraction(0)) + coefficient
    return sum(
        (c * _product((motion[n], k) for n, k in outer) for outer, c in by_motion.items()), Fraction(0)
    )


def _product(factors: Iterable[tuple[Fraction, int]]) -> Fraction:
    """Of numbers to their powers; common factors are taken out once."""
    numerator = denominator = 1
    for x, power in factors:
        numerator *= x.numerator**power
        denominator *= x.denominator**power
    return Fraction(numerator, denominator)


def wave(name: str, point: direct.NumericPoint) -> Fraction:
    """cos or sin of n times the disc angle, for an amplitude's name."""
    real, imaginary = Fraction(1), Fraction(0)
    for _ in range(int(name[2])):
        c, s = point.cosine, point.sine
        real, imaginary = real * c - imaginary * s, real * s + imaginary * c
    return imaginary if name.endswith("s") else real


def output(amplitudes: Mapping[str, PolyElement], point: direct.NumericPoint) -> Fraction:
    """G_out of Eq. 17 with these amplitudes."""
    motion = motion_numbers(point)
    terms = (amplitude_value(p, point, motion) * wave(n, point) for n, p in amplitudes.items())
    return sum(terms, Fraction(0))


def current(rows: Mapping[str, PolyElement], point: direct.NumericPoint, j: int) -> Fraction:
    """I_j / K_j1 - K_j0 of Eq. 5a with these coefficients, for the force a of the point."""
    numbers = {n: point.accelerometers[n][j] for n in ("K2", "K4", "K5", "K6", "K7", "K8")}
    numbers |= {f"vartheta_{k}": point.accelerometers[f"vartheta_{k}"][j] for k in "xyz"}
    x, y, z = point.a
    k = {left: value(p, numbers) for left, p in rows.items()}
    linear = x + y * k[r"\vartheta_{jz}^*"] - z * k[r"\vartheta_{jy}^*"]
    squares = k["K_{j2}^*"] * x * x + k["K_{j5}^*"] * y * y + k["K_{j7}^*"] * z * z
    return linear + squares + k["K_{j6}^*"] * x * y + k["K_{j4}^*"] * x * z + k["K_{j8}^*"] * y * z
