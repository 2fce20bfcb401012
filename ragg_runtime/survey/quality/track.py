"""Where a line was flown: positions in metres, length, direction, speed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ragg_runtime.flight.record import Array
from ragg_runtime.survey.quality.lines import SurveyLine

EARTH = 6371e3
"""m: the mean radius, for positions given as latitude and longitude (a map needs no better)."""


@dataclass(frozen=True, eq=False)
class Track:
    """East and north, (N,) m each, gaps interpolated; the line's straight direction, rad from north over east."""

    east: Array
    north: Array
    direction: float

    @property
    def length(self) -> float:
        """m along the track."""
        return float(np.sum(np.hypot(np.diff(self.east), np.diff(self.north))))

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Its upright box in its own direction, m: east and north of the middle, half the length, half the width."""
        x, y = self.along()
        u, v = (x.max() + x.min()) / 2.0, (y.max() + y.min()) / 2.0
        s, c = np.sin(self.direction), np.cos(self.direction)
        middle = self.east[0] + u * s + v * c, self.north[0] + u * c - v * s
        return float(middle[0]), float(middle[1]), float(np.ptp(x)) / 2.0, float(np.ptp(y)) / 2.0

    def along(self) -> tuple[Array, Array]:
        """(N,) m along and to the right of the straight direction, from the first sample."""
        e, n = self.east - self.east[0], self.north - self.north[0]
        s, c = np.sin(self.direction), np.cos(self.direction)
        return e * s + n * c, e * c - n * s


def tracks(lines: Sequence[SurveyLine]) -> list[Track | None]:
    """The track of every line, in one frame; ``None`` where a line has no positions, or stands still."""
    metres = [_positions(x, "easting", "northing") for x in lines]
    angles = [
        None if p is not None else _positions(x, "longitude", "latitude")
        for p, x in zip(metres, lines, strict=True)
    ]
    placed = [p for p in angles if p is not None]
    angles = [None if p is None else (_one_side(p[0], placed[0][0]), p[1]) for p in angles]
    means = [[float(np.mean(x)) for x in p] for p in angles if p is not None]
    middle = np.mean(means or [[0.0, 0.0]], axis=0)
    found: list[Track | None] = []
    for p, q in zip(metres, angles, strict=True):
        if p is not None:
            found.append(_track(*p))
        elif q is not None:
            found.append(_track(EARTH * np.cos(middle[1]) * (q[0] - middle[0]), EARTH * (q[1] - middle[1])))
        else:
            found.append(None)
    return found


def _one_side(longitude: Array, other: Array) -> Array:
    """(N,) rad without the whole turn at the date line, within a line and from another line's first sample."""
    whole = np.unwrap(longitude)
    return np.asarray(whole - 2.0 * np.pi * np.rint((np.mean(whole) - other[0]) / (2.0 * np.pi)))


def _positions(line: SurveyLine, *names: str) -> tuple[Array, Array] | None:
    """East and north as two channels have them, gaps interpolated; ``None`` without half of the samples."""
    values = [line.channels.get(n) for n in names]
    if any(v is None or not np.isfinite(v).sum() > len(line) / 2 for v in values):
        return None
    a, b = (_bridged(v) for v in values if v is not None)
    return a, b


def _bridged(values: Array) -> Array:
    there = np.isfinite(values)
    return values if there.all() else np.interp(np.arange(len(values)), np.flatnonzero(there), values[there])


def _track(east: Array, north: Array) -> Track | None:
    """The direction is that of the principal axis, signed as flown."""
    if not np.ptp(east) + np.ptp(north) > 0:
        return None
    e, n = east - np.mean(east), north - np.mean(north)
    axis = 0.5 * np.arctan2(2 * np.sum(e * n), np.sum(n * n) - np.sum(e * e))
    flown = (east[-1] - east[0]) * np.sin(axis) + (north[-1] - north[0]) * np.cos(axis)
    return Track(east=east, north=north, direction=float(axis + (np.pi if flown < 0 else 0.0)) % (2 * np.pi))
