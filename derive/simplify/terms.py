"""Sizes of the terms of the analytical model; the simplified model keeps the large ones (Eq. 31-47)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from sympy.polys.rings import PolyElement

from derive.propagation import (
    COEFFICIENT_PARAMETERS,
    COEFFICIENTS,
    MOTION_NUMBERS,
    Collected,
    collect,
    from_generic,
)
from derive.simplify.envelope import EOTVOS, PAPER_ENVELOPE, Envelope, product

Powers = tuple[int, ...]
Product = tuple[int, Powers, Powers]
"""A term: its harmonic, powers of the motion numbers, powers of the parameters."""
Generic = Mapping[tuple[int, str], Mapping[Powers, PolyElement]]

_SIGNAL = frozenset(
    (tuple(int(n == t) for n in MOTION_NUMBERS), tuple(int(p in ("k1", "R")) for p in COEFFICIENT_PARAMETERS))
    for t in ("T_1", "T_2")
)
"""k1 R T_1 and k1 R T_2: what the instrument is there to measure (Eq. 30)."""


@dataclass(frozen=True)
class Size:
    """How large a term may be: the product ``parameters`` x ``motion`` in one harmonic.

    ``motion`` holds powers of :data:`MOTION_NUMBERS`, ``parameters`` of :data:`COEFFICIENT_PARAMETERS`;
    ``eotvos`` is what one accelerometer contributes at most, divided by k_ggi (the measure of Eq. 31-41).
    """

    harmonic: int
    motion: Powers
    parameters: Powers
    eotvos: Fraction


def is_nominal(parameters: Powers) -> bool:
    """Whether a product of parameters is k1^m R^n: nominally equal for all accelerometers."""
    return not any(parameters[2:])


def balanced(harmonic: int, parameters: Powers) -> bool:
    """Whether the sum over the accelerometers leaves only the imbalance (D, not Sigma) of k1^m R^n."""
    return is_nominal(parameters) and harmonic % 4 != 2


def sizes(envelope: Envelope) -> tuple[Size, ...]:
    """The size of every term of the analytical model in an envelope, in its order."""
    bounds = envelope.motion()
    motions = [bounds[n] for n in MOTION_NUMBERS]
    nominal = [envelope.nominal(n) for n in COEFFICIENT_PARAMETERS]
    scale = 1 / (4 * Fraction(envelope.radius) * EOTVOS)
    found = []
    for (n, motion, parameters), c in collect().largest.items():
        left = envelope.departure(parameters) if balanced(n, parameters) else 1
        size = c * product(motions, motion) * product(nominal, parameters) * scale * left
        found.append(Size(n, motion, parameters, size))
    return tuple(found)


def simplified(envelope: Envelope = PAPER_ENVELOPE) -> Collected:
    """The simplified model for an envelope (Eq. 42-47 for the paper's).

    Of the analytical model it keeps every term that may exceed ``envelope.allotted``, and
    always the signal itself (Eq. 30). What it drops is bounded by :func:`derive.simplify.certified_bound`.
    """
    large = {(s.harmonic, s.motion, s.parameters) for s in sizes(envelope) if s.eotvos > envelope.allotted}
    return from_generic(_select(collect().generic, large))


def dropped(model: Collected) -> Generic:
    """Series of one accelerometer that the analytical model has and ``model`` has not."""
    difference: dict[tuple[int, str], dict[Powers, PolyElement]] = {}
    for key, terms in collect().generic.items():
        there = model.generic.get(key, {})
        left = {m: c - there.get(m, COEFFICIENTS.zero) for m, c in terms.items()}
        difference[key] = {m: c for m, c in left.items() if c}
    return difference


def _select(generic: Generic, chosen: set[Product]) -> Generic:
    """The terms of a series that are chosen, or signal; without the harmonics that this empties."""
    reduced: dict[tuple[int, str], dict[Powers, PolyElement]] = {}
    for (n, phase), terms in generic.items():
        of_phase = reduced.setdefault((n, phase), {})
        for motion, coefficient in terms.items():
            part = COEFFICIENTS.from_dict(
                {
                    p: c
                    for p, c in coefficient.terms()
                    if (n, motion, p) in chosen or (n == 2 and (motion, p) in _SIGNAL)
                }
            )
            if part:
                of_phase[motion] = part
    present = {n for (n, _), terms in reduced.items() if terms} | {0}
    return {key: terms for key, terms in reduced.items() if key[0] in present}


def certified_bound(envelope: Envelope, model: Collected) -> Mapping[int, Fraction]:
    """Upper bound of |G_full - G_model| / k_ggi over a whole envelope, at any disc angle: the share of each harmonic of the disc, Eo.

    The bound is their sum. It holds for the models as formulas: rounding in their evaluation comes on top.
    """
    amplitudes: dict[tuple[int, Powers, Powers], Fraction] = {}
    for (n, _), terms in dropped(model).items():
        for motion, coefficient in terms.items():
            for p, c in coefficient.terms():
                square = Fraction(int(c.numerator), int(c.denominator)) ** 2
                amplitudes[n, motion, p] = amplitudes.get((n, motion, p), Fraction(0)) + square
    bounds = envelope.motion()
    motions = [bounds[n] for n in MOTION_NUMBERS]
    largest = [envelope.parameter(n) for n in COEFFICIENT_PARAMETERS]
    nominal = [envelope.nominal(n) for n in COEFFICIENT_PARAMETERS]
    harmonics: dict[int, Fraction] = {}
    for (n, motion, p), square in amplitudes.items():
        size = product(motions, motion) * root_up(square * (8 if n % 2 else 16))
        if balanced(n, p):
            size *= envelope.departure(p) * product(nominal, p)
        else:
            size *= product(largest, p)
        harmonics[n] = harmonics.get(n, Fraction(0)) + size / envelope.least_scale_factor / EOTVOS
    return dict(sorted(harmonics.items()))


def root_up(square: Fraction, digits: int = 20) -> Fraction:
    """A rational at or above the root of a rational, within 10^-digits; a rational root itself."""
    scale = 10**digits
    radicand = square.numerator * square.denominator * scale**2
    root = math.isqrt(radicand)
    return Fraction(root + (root * root != radicand), square.denominator * scale)
