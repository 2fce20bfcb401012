"""What a simplified model can leave out at most, with proof: exact rational arithmetic, rounded outwards.

The proof. At disc angle phi the dropped part of G_out is a sum over accelerometers j, harmonics n, products
m of motion numbers and products p of parameters of

    +-  p_j m (c cos n psi_j + s sin n psi_j),    psi_j = phi + q_j 90 deg.

The bracket is at most sqrt(c^2 + s^2) times |cos(n psi_j - delta)|, whose sum over the four accelerometers
is at most 4 for even n and 2 sqrt 2 for odd n, where |cos| and |sin| alternate. Motion numbers are bounded
by Eq. 16 term by term, parameters by the envelope. Where the four signs make a combination D of a product
k1^m R^n, the nominal part cancels and only the departure from it is left. k_ggi is bounded from below.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS, Collected
from derive.simplify.envelope import EOTVOS, Envelope, product
from derive.simplify.terms import Powers, balanced, dropped


@dataclass(frozen=True)
class Certificate:
    """Upper bound of |G_full - G_model| / k_ggi over a whole envelope, at any disc angle.

    ``harmonics`` gives the share of each harmonic of the disc, in Eo, exactly; the bound is their sum. It
    holds for the models as formulas: rounding in their evaluation comes on top.
    """

    harmonics: Mapping[int, Fraction]

    @property
    def exact(self) -> Fraction:
        """The bound in Eo."""
        return sum(self.harmonics.values(), Fraction(0))

    @property
    def eotvos(self) -> float:
        """The bound in Eo: the least float that is not below it."""
        return round_up(self.exact)


def certified_bound(envelope: Envelope, model: Collected, full: Collected | None = None) -> Certificate:
    """What ``model`` may miss of the analytical model (or of ``full``) anywhere in an envelope."""
    amplitudes: dict[tuple[int, Powers, Powers], Fraction] = {}
    for (n, _), terms in dropped(model, full).items():
        for motion, coefficient in terms.items():
            for p, c in coefficient.terms():
                square = Fraction(int(c.numerator), int(c.denominator)) ** 2
                amplitudes[n, motion, p] = amplitudes.get((n, motion, p), Fraction(0)) + square
    motions = [envelope.motion()[n] for n in MOTION_NUMBERS]
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
    return Certificate(dict(sorted(harmonics.items())))


def root_up(square: Fraction, digits: int = 20) -> Fraction:
    """A rational at or above the root of a rational, within 10^-digits; a rational root itself."""
    scale = 10**digits
    radicand = square.numerator * square.denominator * scale**2
    root = math.isqrt(radicand)
    return Fraction(root + (root * root != radicand), square.denominator * scale)


def round_up(x: Fraction) -> float:
    """The least float at or above ``x``."""
    nearest = float(x)
    return nearest if Fraction(nearest) >= x else math.nextafter(nearest, math.inf)
