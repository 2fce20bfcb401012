"""Where the accelerometers are: discs, places, signs and outputs. The paper's four are one such layout.

A layout is data and nothing else: positions, directions and signs as they are written in model.toml. The derived
models take their constants from :mod:`ragg_runtime.stations`, the numerical reference makes its own.

Conventions, said once. A disc spins about its ``axis`` (measurement frame); its angle 0 lies along ``zero``. At the
angle of an accelerometer e_r points outward, e_t along the turn, e_a along the axis. The nominal triad of the paper is
(e_t, e_r, -e_a); a ``direction`` of the input axis other than e_t turns that triad by the smallest rotation that takes
e_t there (from e_t to -e_t: half a turn about e_a).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

Vector3 = tuple[float, float, float]

X_AXIS: Vector3 = (1.0, 0.0, 0.0)
Z_AXIS: Vector3 = (0.0, 0.0, 1.0)
TANGENTIAL: Vector3 = (0.0, 1.0, 0.0)
"""Direction of an input axis along the turn, in (e_r, e_t, e_a)."""

QUARTER = math.pi / 2


@dataclass(frozen=True)
class Disc:
    """A disc, turning or standing still.

    Attributes
    ----------
    name
        As in model.toml; empty for the paper's one.
    spin_frequency
        Hz; 0: it stands still unless its angle is recorded.
    axis, zero
        Unit vectors in the measurement frame, perpendicular: the axis of the spin, and where angle 0 points.
    angle_column
        Column of a flight with its encoder's angle.
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


@dataclass(frozen=True)
class Place:
    """Where an accelerometer sits, and how it counts.

    Attributes
    ----------
    name
        As in model.toml (A1 ...).
    disc, output
        Which, counted from 0.
    angle
        On the disc, rad, from its angle 0 in the sense of the turn.
    radius, height
        Distance from the axis, and along it from the disc's centre, m.
    direction
        Unit vector of the input axis in (e_r, e_t, e_a).
    sign
        Of its voltage in the output, 1 or -1.
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
        whole = round(quarters)
        if abs(quarters - whole) < 1e-12:
            return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[whole % 4]
        return math.cos(self.angle), math.sin(self.angle)


@dataclass(frozen=True)
class Output:
    """An output before demodulation: a column of the flight, the sum of voltages with their signs.

    ``members`` are places of the layout, ``signs`` theirs; all are on one disc.
    """

    name: str
    disc: int
    members: tuple[int, ...]
    signs: tuple[int, ...]


@dataclass(frozen=True)
class Layout:
    """All discs and accelerometers of an instrument, in the order of model.toml."""

    discs: tuple[Disc, ...]
    places: tuple[Place, ...]
    output_names: tuple[str, ...] = ("G_out",)

    @cached_property
    def outputs(self) -> tuple[Output, ...]:
        found = []
        for k, name in enumerate(self.output_names):
            members = tuple(j for j, p in enumerate(self.places) if p.output == k)
            signs = tuple(self.places[j].sign for j in members)
            found.append(Output(name, self.places[members[0]].disc, members, signs))
        return tuple(found)

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
        return tuple(dict.fromkeys((f"V_{self.places[j].name}", f"V_{j + 1}")))

    def spinning(self, disc: int) -> bool:
        return self.discs[disc].spin_frequency != 0.0


_FOUR = tuple(
    Place(name=f"A{k}", disc=0, angle=quarters * QUARTER, radius=1.0, sign=sign)
    for k, quarters, sign in ((1, 0, 1), (2, 2, 1), (3, 1, -1), (4, 3, -1))
)
"""The paper's places (Section II.A) and signs (Eq. 15); the one definition of them at run time."""


def paper(radius: float, spin_frequency: float) -> Layout:
    """The paper's instrument: A1 ... A4 at 0, 180, 90 and 270 degrees, G_out = V_1 + V_2 - V_3 - V_4."""
    places = tuple(
        Place(name=p.name, disc=0, angle=p.angle, radius=radius, sign=p.sign) for p in _FOUR
    )
    return Layout(discs=(Disc(name="", spin_frequency=spin_frequency),), places=places)


PAPER = paper(1.0, 1.0)
"""The paper's layout, where only names, signs and number matter."""


def unit(v: Sequence[float]) -> Vector3:
    """A vector (3,) scaled to length 1; one along an axis stays exact."""
    length = math.sqrt(math.fsum(x * x for x in v))
    return (v[0] / length, v[1] / length, v[2] / length)


def perpendicular(v: Sequence[float], axis: Vector3) -> Vector3:
    """The direction of ``v`` less its part along a unit vector."""
    along = math.fsum(a * b for a, b in zip(v, axis, strict=True))
    return unit([a - along * b for a, b in zip(v, axis, strict=True)])


def turned_with(axis: Vector3, v: Vector3) -> Vector3:
    """``v`` after the smallest rotation that takes z to ``axis`` (to -z: half a turn about x)."""
    x, y, z = axis
    if z <= -1.0 + 1e-15:
        return (v[0], -v[1], -v[2])
    lean = x * v[0] + y * v[1]
    across = v[2] - lean / (1.0 + z)
    return (v[0] + x * across, v[1] + y * across, z * v[2] - lean)
