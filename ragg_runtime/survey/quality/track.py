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

    def along(self) -> tuple[Array, Array]:
        """(N,) m along and to the right of the straight direction, from the first sample."""
        e, n = self.east - self.east[0], self.north - self.north[0]
        s, c = np.sin(self.direction), np.cos(self.direction)
        return e * s + n * c, e * c - n * s


def tracks(lines: Sequence[SurveyLine]) -> list[Track | None]:
    """The track of every line, in one frame; ``None`` where a line has no positions."""
    placed = [_positions(x) for x in lines]
    angles = [p for p, x in zip(placed, lines, strict=True) if p is not None and "easting" not in x.channels]
    middle = (
        np.mean([[np.nanmean(p[0]), np.nanmean(p[1])] for p in angles], axis=0) if angles else np.zeros(2)
    )
    found: list[Track | None] = []
    for p, x in zip(placed, lines, strict=True):
        if p is None:
            found.append(None)
            continue
        east, north = p
        if "easting" not in x.channels:
            east = EARTH * np.cos(middle[1]) * (east - middle[0])
            north = EARTH * (north - middle[1])
        found.append(_track(east, north))
    return found


def _positions(line: SurveyLine) -> tuple[Array, Array] | None:
    """East and north in m, or longitude and latitude in rad."""
    for names in (("easting", "northing"), ("longitude", "latitude")):
        values = [line.channels.get(n) for n in names]
        if all(v is not None and np.isfinite(v).sum() > len(line) / 2 for v in values):
            a, b = (_bridged(v) for v in values if v is not None)
            return a, b
    return None


def _bridged(values: Array) -> Array:
    there = np.isfinite(values)
    return values if there.all() else np.interp(np.arange(len(values)), np.flatnonzero(there), values[there])


def _track(east: Array, north: Array) -> Track:
    """The direction is that of the principal axis, signed as flown."""
    e, n = east - np.mean(east), north - np.mean(north)
    axis = 0.5 * np.arctan2(2 * np.sum(e * n), np.sum(n * n) - np.sum(e * e))
    flown = (east[-1] - east[0]) * np.sin(axis) + (north[-1] - north[0]) * np.cos(axis)
    return Track(east=east, north=north, direction=float(axis + (np.pi if flown < 0 else 0.0)) % (2 * np.pi))
