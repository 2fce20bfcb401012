"""Envelopes: how far motion and instrument may go. All SI; errors in eotvos."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from functools import cache, lru_cache
from typing import Any

import sympy as sp

from derive.propagation import MOTION_NUMBERS, motion_numbers
from derive.stages import Kinematics
from derive.symbols import MOTION, SPIN_ACCELERATION, SPIN_RATE, symbol

Vector = tuple[float, float, float]

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

    Raises
    ------
    ValueError
        If a bound is negative or not finite, or the instrument has no scale factor to divide by
        (imbalance >= 1, dR >= radius).
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

    def __post_init__(self) -> None:
        for f in fields(self):
            value = getattr(self, f.name)
            if isinstance(value, str):
                continue
            for v in value if isinstance(value, tuple) else (value,):
                if not (math.isfinite(v) and v >= 0):
                    raise ValueError(
                        f"the bound {f.name} of the envelope is {value!r}; its largest magnitude is expected,"
                        " finite numbers, zero or positive"
                    )
        if self.imbalance >= 1 or self.dR >= self.radius:
            raise ValueError(
                "the envelope holds an instrument without a scale factor: imbalance < 1 and dR < radius are expected,"
                f" not imbalance {self.imbalance} and dR {self.dR} m of radius {self.radius} m"
            )

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
        return _ranges(tuple(self.channel(n) for n in _channels(self.kinematics)), self.kinematics)

    def scaled(self, names: Sequence[str], factor: float) -> Envelope:
        """The envelope with these bounds multiplied by a factor."""
        changed: dict[str, Any] = {}
        for n in names:
            value = getattr(self, n)
            changed[n] = tuple(v * factor for v in value) if isinstance(value, tuple) else value * factor
        return replace(self, **changed)


def ranges(
    bound: Callable[[str], Fraction | int], kinematics: Kinematics = "platform"
) -> Mapping[str, Fraction]:
    """Bounds of a, T and S by those of the motion channels (Eq. 16), which are independent.

    A square keeps its sign: T_1 = (omega_y^2 - omega_x^2 + ...) / 2 is smaller than the sum of its terms.
    """
    return _ranges(tuple(Fraction(bound(name)) for name in _channels(kinematics)), kinematics)


@lru_cache(maxsize=64)
def _ranges(channels: tuple[Fraction, ...], kinematics: Kinematics) -> Mapping[str, Fraction]:
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
"""m/s^2, the paper's g."""
_ARCSECOND, _PER_HOUR = math.radians(1 / 3600), math.radians(1) / 3600
_SPIN = 0.25
_OMEGA = 2 * math.pi * _SPIN

PAPER_ENVELOPE = Envelope(
    # "In gravity gradiometry the RAGG acceleration is usually in the order of 0.1 g" (below Eq. 41).
    a=(0.1 * G0,) * 3,
    # The greatest rate of the dynamic experiment: 2000 + 800 deg/h (Table VI).
    omega=(2800 * _PER_HOUR,) * 3,
    # "the angular acceleration is in the order of 1e-3 ~ 1e-2 rad/s^2" (Section IV): the lower end.
    # Only there does the paper drop nothing that its own rule would keep (the page on the simplified model).
    omegadot=(1e-3,) * 3,
    # "The maximum gravitational gradient is of the order of 10^3 Eo" (below Eq. 32).
    Gamma=1e3 * 1e-9,
    radius=0.1,
    # The largest of Table V; Section II.B.1 gives none.
    dR=35e-6,
    # Section II.B.1, first paragraph.
    beta_x=1e-4,
    beta_z=1e-4,
    vartheta_x=1e-4,
    vartheta_y=1e-4,
    vartheta_z=1e-4,
    # The largest of Table V; Section II.B.1 gives none.
    K0=10e-6 * G0,
    # Section II.B.1: 1e-6 g/g^2.
    K2=1e-6 / G0,
    K4=1e-6 / G0,
    K5=1e-6 / G0,
    K6=1e-6 / G0,
    K7=1e-6 / G0,
    K8=1e-6 / G0,
    imbalance=1e-4,
    spin_frequency=_SPIN,
)
"""Section II.B.1, each number as the paper gives it. It states no angular motion there: see ``omega``."""

DYNAMIC_EXPERIMENT = Envelope(
    a=(0.085 * G0, 0.066 * G0, 0.15 * G0),
    omega=(1700 * _PER_HOUR, 2400 * _PER_HOUR, 2800 * _PER_HOUR),
    omegadot=(700 * _PER_HOUR * _OMEGA, 900 * _PER_HOUR * _OMEGA, 800 * _PER_HOUR * _OMEGA),
    Gamma=1e3 * 1e-9,
    radius=0.1,
    dR=35e-6,
    beta_x=21 * _ARCSECOND,
    beta_z=20 * _ARCSECOND,
    vartheta_x=0.0,
    vartheta_y=21 * _ARCSECOND,
    vartheta_z=30 * _ARCSECOND,
    K0=10e-6 * G0,
    K2=8e-6 / G0,
    K4=16e-6 / G0,
    K5=13e-6 / G0,
    K6=12e-6 / G0,
    K7=17e-6 / G0,
    K8=20e-6 / G0,
    # 10, 11, 11.5 and 12 mA/g against their mean: a thousand times the 1e-4 of Section II.B.1.
    imbalance=1 - 10 / 11.125,
    spin_frequency=_SPIN,
)
"""The smallest envelope that holds the dynamic experiment (Tables V and VI), Gamma as in Section II.B.1."""
