"""From the analytical to the simplified model: what an envelope of motion and instruments lets one neglect.

Section II.B of the paper, computed. :func:`simplified` gives Eq. 42-47 for the paper's envelope, and the model that follows from
the same rule for any other; :func:`certified_bound` gives what the dropped part can amount to, with proof;
:func:`derive.simplify.page.critical_conditions` gives Tables I to III. All SI; errors in eotvos.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from typing import Any

import sympy as sp
from sympy.polys.rings import PolyElement

from derive.propagation import (
    COEFFICIENT_PARAMETERS,
    COEFFICIENTS,
    MOTION_NUMBERS,
    Collected,
    collect,
    from_generic,
    motion_numbers,
)
from derive.stages import Kinematics
from derive.symbols import ANGLES, MOTION, SECOND_ORDER, SPIN_ACCELERATION, SPIN_RATE, symbol

Vector = tuple[float, ...]

EOTVOS = Fraction(1, 10**9)
"""1 Eo in s^-2."""


@dataclass(frozen=True)
class Envelope:
    """Bounds on magnitudes: motion and parameters lie in the box |value| <= bound.

    Attributes
    ----------
    a, omega, omegadot
        Of each component of the specific force (m/s^2), rate (rad/s) and angular acceleration (rad/s^2).
    Gamma
        Of every component of the gravity gradient, s^-2.
    radius, dR
        Nominal radius and bound of its error, m.
    beta_x, beta_z, vartheta_x, vartheta_y, vartheta_z
        Of the angles, rad.
    K0
        Of the null bias, m/s^2.
    K2, K4, K5, K6, K7, K8
        Of the second-order coefficients, 1/(m/s^2).
    imbalance
        Of k_j1 / k_1 - 1, with k_1 the nominal scale factor (its value does not matter).
    spin_frequency
        Of the disc, Hz.
    allotted
        Error that one term may leave when it is dropped, Eo (Section II.B.1: 0.1 Eo).
    kinematics
        Whose rotation the accelerometers sense; in ``full`` kinematics the spin is part of the motion.
    spin_acceleration
        Of the disc angle, rad/s^2; 0: the spin is steady.
    """

    a: Vector
    omega: Vector
    omegadot: Vector
    Gamma: float
    radius: float
    dR: float
    beta_x: float
    beta_z: float
    vartheta_x: float
    vartheta_y: float
    vartheta_z: float
    K0: float
    K2: float
    K4: float
    K5: float
    K6: float
    K7: float
    K8: float
    imbalance: float
    spin_frequency: float
    allotted: float = 0.1
    kinematics: Kinematics = "platform"
    spin_acceleration: float = 0.0

    def parameter(self, name: str) -> Fraction:
        """Bound of one of the :data:`COEFFICIENT_PARAMETERS`; of k1 in units of its nominal value."""
        if name == "k1":
            return 1 + Fraction(self.imbalance)
        if name == "R":
            return Fraction(self.radius) + Fraction(self.dR)
        return Fraction(getattr(self, name))

    def nominal(self, name: str) -> Fraction:
        """As :meth:`parameter`, with k1 and R at their nominal values: what Eq. 31-41 take."""
        return {"k1": Fraction(1), "R": Fraction(self.radius)}.get(name) or self.parameter(name)

    def departure(self, powers: Sequence[int]) -> Fraction:
        """Bound of |p_j / p - 1| for p = k1^m R^n, given the powers of :data:`COEFFICIENT_PARAMETERS`.

        It is what a combination D leaves of a product that is nominally equal for all accelerometers.
        """
        k1, R = powers[:2]
        return (1 + Fraction(self.imbalance)) ** k1 * (1 + Fraction(self.dR) / Fraction(self.radius)) ** R - 1

    @property
    def least_scale_factor(self) -> Fraction:
        """Lower bound of k_ggi = sum_j k_j1 R_j, m."""
        return 4 * (1 - Fraction(self.imbalance)) * (Fraction(self.radius) - Fraction(self.dR))

    def channel(self, name: str) -> Fraction:
        """Bound of a motion channel (a_x, omegadot_z, Gamma_xy ...)."""
        if name == SPIN_RATE.name:
            turn = 2 * math.pi * self.spin_frequency
            return Fraction(turn) * (
                1 + Fraction(1, 2**50)
            )  # never below the exact product, however it was rounded
        if name == SPIN_ACCELERATION.name:
            return Fraction(self.spin_acceleration)
        kind, _, axis = name.partition("_")
        value = getattr(self, kind)
        return Fraction(value if kind == "Gamma" else value["xyz".index(axis)])

    def motion(self) -> Mapping[str, Fraction]:
        """Bounds of a, T and S (:data:`MOTION_NUMBERS`) over the envelope, through Eq. 16."""
        return ranges(self.channel, self.kinematics)


def ranges(
    bound: Callable[[str], Fraction | int], kinematics: Kinematics = "platform"
) -> Mapping[str, Fraction]:
    """Bounds of a, T and S by those of the motion channels (Eq. 16), which are independent.

    A square keeps its sign: T_1 = (omega_y^2 - omega_x^2 + ...) / 2 is smaller than the sum of its terms.
    """
    channels = [Fraction(bound(name)) for name in _channels(kinematics)]
    bounds = {}
    for name, terms in _polynomials(kinematics).items():
        low = high = Fraction(0)
        for powers, c in terms:
            size = abs(c) * product(channels, powers)
            square = all(n % 2 == 0 for n in powers)
            if c < 0 or not square:
                low -= size
            if c > 0 or not square:
                high += size
        bounds[name] = max(-low, high)
    return bounds


def _channels(kinematics: Kinematics) -> tuple[str, ...]:
    spin = () if kinematics == "platform" else (SPIN_RATE.name, SPIN_ACCELERATION.name)
    return (*(c.name for c in MOTION), *spin)


@cache
def _polynomials(kinematics: Kinematics) -> dict[str, tuple[tuple[tuple[int, ...], Fraction], ...]]:
    """a, T and S as polynomials in the motion channels: powers and coefficient of each term."""
    numbers = motion_numbers(kinematics)
    channels = [symbol(n) for n in _channels(kinematics)]
    return {
        name: tuple(
            (powers, Fraction(int(c.p), int(c.q)))
            for powers, c in sp.Poly(numbers.get(name, symbol(name)), *channels).terms()
        )
        for name in MOTION_NUMBERS
    }


def product(bounds: Sequence[Fraction], powers: Sequence[int]) -> Fraction:
    """Product of bounds to their powers."""
    return math.prod((b**n for b, n in zip(bounds, powers, strict=True) if n), start=Fraction(1))


G0 = 9.8
"""m/s^2 per g: the value with which the paper's k_ggi = 4.54e-4 V/Eo comes out."""
RADIUS, SPIN_FREQUENCY = 0.1, 0.25
"""m, Hz."""
ARCSECOND = PER_HOUR = math.pi / 648000
"""rad, and rad/s of a degree per hour."""

TABLE_V: Mapping[str, tuple[float, ...]] = {
    "dR": (0, 30, 35, 25),  # um
    "beta_x": (21, 14, 17, 19),  # arcsec
    "beta_z": (18, 8, 10, 20),
    "vartheta_y": (21, 10, 7, 19),
    "vartheta_z": (30, 19, 20, 9),
    "K0": (10, 2, 5, 8),  # ug
    "K1": (10, 11, 11.5, 12),  # mA/g
    "K2": (5, 1, 8, 7),  # ug/g^2
    "K4": (6, 12, 5, 16),
    "K5": (4, 11, 9, 13),
    "K6": (3, 12, 8, 10),
    "K7": (5, 15, 7, 17),
    "K8": (0, 7, 11, 20),
}
"""Of the dynamic experiment: the four accelerometers."""

TABLE_VI: Mapping[str, tuple[float, float]] = {
    "a_x": (0.08, 0.005),  # g: constant, and amplitude of sin Omega t
    "a_y": (0.06, 0.006),
    "a_z": (0.1, 0.05),
    "omega_x": (1000, 700),  # deg/h
    "omega_y": (1500, 900),
    "omega_z": (2000, 800),
}
"""Its motion."""

_ANGLES: Mapping[str, Any] = dict.fromkeys(ANGLES, 1e-4)
_COEFFICIENTS: Mapping[str, Any] = dict.fromkeys(SECOND_ORDER, 1e-6 / G0)

PAPER_ENVELOPE = Envelope(
    # "In gravity gradiometry the RAGG acceleration is usually in the order of 0.1 g" (below Eq. 41).
    a=(0.1 * G0,) * 3,
    # The greatest rate of the dynamic experiment: 2000 + 800 deg/h (Table VI).
    omega=(2800 * PER_HOUR,) * 3,
    # "the angular acceleration is in the order of 1e-3 ~ 1e-2 rad/s^2" (Section IV): the lower end.
    # Only there does the paper drop nothing that its own rule would keep (the page on the simplified model).
    omegadot=(1e-3,) * 3,
    # "The maximum gravitational gradient is of the order of 10^3 Eo" (below Eq. 32).
    Gamma=1e3 * 1e-9,
    radius=RADIUS,
    # The largest of Table V; Section II.B.1 gives none.
    dR=35e-6,
    # Section II.B.1, first paragraph.
    **_ANGLES,
    # The largest of Table V; Section II.B.1 gives none.
    K0=10e-6 * G0,
    # Section II.B.1: 1e-6 g/g^2.
    **_COEFFICIENTS,
    imbalance=1e-4,
    spin_frequency=SPIN_FREQUENCY,
)
"""Section II.B.1, each number as the paper gives it. It states no angular motion there: see ``omega``."""

_LARGEST: dict[str, Any] = {n: max(TABLE_V.get(n, (0.0,))) * ARCSECOND for n in ANGLES}
_LARGEST |= {n: max(TABLE_V[n]) * 1e-6 / G0 for n in SECOND_ORDER}
_SIX = {n: [TABLE_VI[f"{n}_{k}"] for k in "xyz"] for n in ("a", "omega")}
_TURN = 2 * math.pi * SPIN_FREQUENCY * PER_HOUR

DYNAMIC_EXPERIMENT = replace(
    PAPER_ENVELOPE,
    a=tuple((mean + swing) * G0 for mean, swing in _SIX["a"]),
    omega=tuple((mean + swing) * PER_HOUR for mean, swing in _SIX["omega"]),
    omegadot=tuple(swing * _TURN for _, swing in _SIX["omega"]),
    **_LARGEST,
    # Against their mean: a thousand times the 1e-4 of Section II.B.1.
    imbalance=1 - min(TABLE_V["K1"]) / (sum(TABLE_V["K1"]) / 4),
)
"""The smallest envelope that holds the dynamic experiment (Tables V and VI), Gamma as in Section II.B.1."""


# --- The terms of the analytical model ---

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


def balanced(harmonic: int, parameters: Powers) -> bool:
    """Whether a product is k1^m R^n, nominally equal for all accelerometers, and their sum leaves its imbalance (D, not Sigma)."""
    return not any(parameters[2:]) and harmonic % 4 != 2


def sizes(envelope: Envelope) -> tuple[Size, ...]:
    """The size of every term of the analytical model in an envelope, in its order."""
    bounds = envelope.motion()
    motions = [bounds[n] for n in MOTION_NUMBERS]
    nominal = [envelope.nominal(n) for n in COEFFICIENT_PARAMETERS]
    scale = 1 / (4 * Fraction(envelope.radius) * EOTVOS)
    terms = []
    for (n, motion, parameters), c in collect().largest.items():
        left = envelope.departure(parameters) if balanced(n, parameters) else 1
        size = c * product(motions, motion) * product(nominal, parameters) * scale * left
        terms.append(Size(n, motion, parameters, size))
    return tuple(terms)


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
        kept = model.generic.get(key, {})
        left = {m: c - kept.get(m, COEFFICIENTS.zero) for m, c in terms.items()}
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
