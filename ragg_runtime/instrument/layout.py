"""Where the accelerometers are: discs, places, signs and outputs, as in model.toml. The paper's four are one such
layout.

A disc spins about its ``axis`` (measurement frame); its angle 0 lies along ``zero``. At an accelerometer e_r points
outward, e_t along the turn, e_a along the axis. The nominal triad of the paper is (e_t, e_r, -e_a); a ``direction`` of
the input axis other than e_t turns it by the smallest rotation that takes e_t there (from e_t to -e_t: half a turn
about e_a).
"""

from __future__ import annotations

import math
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Vector3 = tuple[float, float, float]

X_AXIS: Vector3 = (1.0, 0.0, 0.0)
Y_AXIS: Vector3 = (0.0, 1.0, 0.0)
Z_AXIS: Vector3 = (0.0, 0.0, 1.0)
TANGENTIAL: Vector3 = (0.0, 1.0, 0.0)  # direction of an input axis along the turn, in (e_r, e_t, e_a)

AXIAL: Vector3 = (0.0, 0.0, 1.0)

QUARTER = math.pi / 2

# highest multiple of the spin rate that second-order terms of a rotating force reach (Eq. 17).
HIGHEST_HARMONIC = 4


@dataclass(frozen=True)
class Disc:
    """A disc, turning or standing still.

    ``spin_frequency``: Hz; 0: at rest unless its angle is recorded. ``axis``, ``zero``: perpendicular unit
    vectors in the measurement frame, of the spin and of angle 0. ``angle_column``: of its encoder.
    """

    name: str
    spin_frequency: float
    axis: Vector3 = Z_AXIS
    zero: Vector3 = X_AXIS
    angle_column: str = "spin_angle"

    @property
    def level(self) -> bool:
        """Whether its frame is the measurement frame: angle 0 along x, axis along z."""
        return self.axis == Z_AXIS and self.zero == X_AXIS

    @property
    def across(self) -> tuple[Vector3, Vector3]:
        """Where its angle 0 and a quarter turn point, in the measurement frame."""
        (a, b, c), (x, y, z) = self.axis, self.zero
        return self.zero, (b * z - c * y, c * x - a * z, a * y - b * x)


@dataclass(frozen=True)
class AccelerometerPosition:
    """Where an accelerometer sits, and how it counts.

    ``disc``, ``output``: counted from 0. ``angle``: on the disc, rad, in the sense of the turn. ``radius``, ``height``:
    from the axis, and along it from the disc's centre, m. ``direction``: of the input axis in (e_r, e_t, e_a).
    ``sign``: 1 or -1.
    """

    name: str
    disc: int
    angle: float
    radius: float
    height: float = 0.0
    direction: Vector3 = TANGENTIAL
    sign: int = 1
    output: int = 0

    @cached_property
    def cosine_sine(self) -> tuple[float, float]:
        """Of the angle; exact at quarters of a turn."""
        quarters = self.angle / QUARTER
        nearest = round(quarters)
        if abs(quarters - nearest) < 1e-12:
            return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[nearest % 4]
        return math.cos(self.angle), math.sin(self.angle)

    @property
    def carrier(self) -> complex:
        """How the gradient across the spin axis shows in its voltage, over k1 R: 1 and -1 in the paper's (Eq. 30)."""
        (c, s), (radial, tangential, _) = self.cosine_sine, self.direction
        return complex(tangential, -radial) * complex(c * c - s * s, 2 * c * s)


@dataclass(frozen=True)
class Output:
    """An output before demodulation: a column of the flight; ``members``, all of one disc, count with ``signs``."""

    name: str
    disc: int
    members: tuple[int, ...]
    signs: tuple[int, ...]
    carriers: tuple[complex, ...]
    """How the gradient across the spin axis shows in each voltage, over k1 R: see :func:`gain`."""
    radii: tuple[float, ...]
    angles: tuple[tuple[float, float], ...]
    """Cosine and sine of each member's angle on the disc."""

    @property
    def patterns(self) -> tuple[tuple[str, tuple[float, ...]], ...]:
        """Harmonic and weights (members,) with which it sees a parameter: sign times cos and sin of n = 0 ... 4 times the angle."""
        angles = np.array([math.atan2(s, c) for c, s in self.angles])
        patterns: list[tuple[str, Array]] = []
        for n in range(HIGHEST_HARMONIC + 1):
            for name, wave in (("cos", np.cos), ("sin", np.sin)):
                w = np.array(self.signs) * wave(n * angles)
                w[np.abs(w) < 1e-12] = 0.0
                if not np.any(w):
                    continue
                w = w / w[int(np.argmax(np.abs(w)))]
                if not any(np.allclose(w, v, atol=1e-9) for _, v in patterns):
                    patterns.append((f"{name} {n}" if n else "const", w))
        return tuple((name, tuple(float(x) for x in w)) for name, w in patterns)

    def combined(self, v: Array) -> Array:
        """(N,): its members' voltages (members, N) with their signs; equal signs are added first (Eq. 15)."""
        signs = np.array(self.signs)
        return np.asarray(v[signs > 0].sum(axis=0) - v[signs < 0].sum(axis=0))


@dataclass(frozen=True)
class Layout:
    """All discs and accelerometers of an instrument, in the order of model.toml."""

    discs: tuple[Disc, ...]
    places: tuple[AccelerometerPosition, ...]
    output_names: tuple[str, ...] = ("G_out",)

    @cached_property
    def outputs(self) -> tuple[Output, ...]:
        outputs = []
        for k, name in enumerate(self.output_names):
            members = tuple(j for j, p in enumerate(self.places) if p.output == k)
            places = [self.places[j] for j in members]
            signs, carriers = tuple(p.sign for p in places), tuple(p.carrier for p in places)
            radii, angles = tuple(p.radius for p in places), tuple(p.cosine_sine for p in places)
            outputs.append(Output(name, places[0].disc, members, signs, carriers, radii, angles))
        return tuple(outputs)

    @property
    def size(self) -> int:
        """Number of accelerometers."""
        return len(self.places)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(p.name for p in self.places)

    @cached_property
    def like_paper(self) -> bool:
        """Whether this is the paper's instrument: the packaged models are derived for it."""
        d = self.discs[0]
        placed = tuple((p.cosine_sine, p.sign) for p in self.places)
        return (
            len(self.discs) == 1
            and d.level
            and d.spin_frequency > 0
            and self.output_names == ("G_out",)
            and placed == tuple((p.cosine_sine, p.sign) for p in _FOUR)
            and len({p.radius for p in self.places}) == 1
            and all(p.height == 0.0 and p.direction == TANGENTIAL for p in self.places)
        )

    def voltage_columns(self, j: int) -> tuple[str, ...]:
        """Names under which a flight may hold the voltage of an accelerometer: V_<name>, or V_1 ... by its number."""
        if self.of_paper:
            return (f"V_{j + 1}",)
        return tuple(dict.fromkeys((f"V_{self.places[j].name}", f"V_{j + 1}")))

    def voltages(self, o: Output, columns: Container[str]) -> tuple[str, ...] | None:
        """The columns of an output's voltages among those that a flight has; ``None`` if not all are there."""
        names = [next((c for c in self.voltage_columns(j) if c in columns), None) for j in o.members]
        return None if None in names else tuple(c for c in names if c is not None)

    def formula(self, o: Output, voltages: Sequence[str]) -> str:
        """An output in words: V_1 + V_2 - V_3 - V_4."""
        text = " ".join(f"{'+' if s > 0 else '-'} {v}" for s, v in zip(o.signs, voltages, strict=True))
        return text.removeprefix("+ ")

    @cached_property
    def columns(self) -> tuple[str, ...]:
        """Every column of a flight that may hold something of this instrument's output before demodulation."""
        volts = (c for j in range(self.size) for c in self.voltage_columns(j))
        return tuple(dict.fromkeys((*self.output_names, *volts)))

    @property
    def of_paper(self) -> bool:
        """Whether model.toml describes it as the paper's, by [disc]."""
        return self.discs[0].name == ""


def column_endings(outputs: Sequence[str]) -> tuple[str, ...]:
    """Ending of the columns made of each output: none if there is one output, else its own (``_A`` of ``G_out_A``)."""
    if len(outputs) == 1:
        return ("",)
    short = tuple(f"_{n.removeprefix('G_out').strip('_') or n}" for n in outputs)
    return short if len(set(short)) == len(short) else tuple(f"_{n}" for n in outputs)


_FOUR = tuple(
    AccelerometerPosition(name=f"A{k}", disc=0, angle=quarters * QUARTER, radius=1.0, sign=sign)
    for k, quarters, sign in ((1, 0, 1), (2, 2, 1), (3, 1, -1), (4, 3, -1))
)
"""The paper's places (Section II.A) and signs (Eq. 15); the one definition of them at run time."""


def paper(radius: float, spin_frequency: float) -> Layout:
    """The paper's instrument: A1 ... A4 at 0, 180, 90 and 270 degrees, G_out = V_1 + V_2 - V_3 - V_4."""
    places = tuple(replace(p, radius=radius) for p in _FOUR)
    return Layout(discs=(Disc(name="", spin_frequency=spin_frequency),), places=places)


PAPER = paper(1.0, 1.0)  # the paper's layout, where only names, signs and number matter


# share of its accelerometers' gains below which an output is not made to see the gradient across the spin axis
CANCELLED = 1e-3


def gain(o: Output, k1: Array, R: Array) -> complex:
    """g, V s^2: an output is T_1 Im(g e^{2 i phi}) + T_2 Re(g e^{2 i phi}), with T_1 = (Gamma_xx - Gamma_yy)/2 and
    T_2 = -Gamma_xy by the axes of the disc at rest (Eq. 30).

    ``k1`` = k_VI K1 and radii ``R``, (n,), of all accelerometers of the layout.
    """
    w, weights = k1[list(o.members)] * R[list(o.members)], np.multiply(o.signs, o.carriers)
    return complex(np.sum(w * weights.real), np.sum(w * weights.imag))


def sees(o: Output, k1: Array, R: Array) -> bool:
    """Whether an output sees the gradient across the spin axis, or its accelerometers' shares of it cancel."""
    return abs(gain(o, k1, R)) > CANCELLED * _sum_gains(o, k1, R)


def scale(o: Output, k1: Array, R: Array) -> float:
    """k_ggi of an output, V s^2: volts per s^-2 of gradient (Eq. 30). Of an output that cancels it: of all members together."""
    g = gain(o, k1, R)
    if not sees(o, k1, R):
        return _sum_gains(o, k1, R)
    return abs(g) if any(c.imag for c in o.carriers) else g.real


def _sum_gains(o: Output, k1: Array, R: Array) -> float:
    return float(np.sum(np.abs(k1[list(o.members)] * R[list(o.members)])))


def normalise(v: ArrayLike) -> Vector3:
    """A vector (3,) scaled to length 1."""
    x = np.asarray(v, dtype=np.float64)
    a, b, c = (x / np.linalg.norm(x)).tolist()
    return a, b, c


def find_across(v: ArrayLike, axis: Vector3) -> Vector3:
    """The direction of ``v`` (3,) less its part along a unit vector."""
    return normalise(np.asarray(v) - np.dot(v, axis) * np.array(axis))


def least_rotation(start: Vector3, end: Vector3, spare: Vector3) -> Array:
    """(3, 3): the smallest rotation that takes a unit vector to another; to the opposite one half a turn about ``spare``."""
    c = float(np.dot(start, end))
    if c <= -1.0 + 1e-15:
        return 2.0 * np.outer(spare, spare) - np.eye(3)
    x, y, z = np.cross(start, end)
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + K + K @ K / (1.0 + c))


def list_constants(layout: Layout) -> Mapping[str, tuple[float, ...]]:
    """Name -> one number for each accelerometer; heights, turns and axes only where the layout has some."""
    places = layout.places
    values: dict[str, tuple[float, ...]] = {
        "cos_j": tuple(p.cosine_sine[0] for p in places),
        "sin_j": tuple(p.cosine_sine[1] for p in places),
    }
    if any(p.height != 0.0 for p in places):
        values["height_j"] = tuple(float(p.height) for p in places)
    if any(p.direction != TANGENTIAL for p in places):
        values |= _name_entries("turn", [least_rotation(TANGENTIAL, p.direction, AXIAL) for p in places])
    if not all(d.level for d in layout.discs):
        discs = [layout.discs[p.disc] for p in places]
        values |= _name_entries("axes", [np.column_stack([*d.across, d.axis]) for d in discs])
    return values


PARTS = 1_000_000  # of a degree: what an angle on the disc is written in


def find_degrees(layout: Layout) -> tuple[Fraction | None, ...]:
    """The exact angle of each accelerometer, as it was written; ``None``: it was not written in millionths of a degree."""
    parts = [math.degrees(p.angle) * PARTS for p in layout.places]
    # a part in 1e12: what turning degrees into radians rounds off
    return tuple(Fraction(round(x), PARTS) if abs(x - round(x)) < 1e-12 * PARTS else None for x in parts)


def _name_entries(name: str, matrices: list[Array]) -> dict[str, tuple[float, ...]]:
    # + 0.0 makes -0.0 the zero that it is
    return {
        f"{name}_{i}{k}_j": tuple(float(m[i, k]) + 0.0 for m in matrices) for i in range(3) for k in range(3)
    }
