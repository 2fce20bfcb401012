"""Where lines cross, what they say there; and lines that were flown again."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import lsqr

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.record import Array
from ragg_runtime.survey.quality.lines import SurveyLine
from ragg_runtime.survey.quality.track import Track

STEEPEST = np.radians(20.0)
"""Angle between two lines from which on they cross: parallel lines that wander over each other do not."""

BESIDE = 100.0
"""m: mean distance up to which two parallel lines are repeats of each other."""

OVERLAP = 0.5
"""Share of the shorter line along which repeats go together."""

MOST_CROSSINGS = 1_000_000
"""Crossings of all lines, beyond which the positions are no tracks: the largest surveys have some hundred thousand."""

_CHUNK = 64  # samples of a track that are compared as one box first
_BOXES = 1024  # of them that are held against those of another line at once
_POINTS = 400  # places along a pair of repeats at which they are compared


@dataclass(frozen=True)
class Crossing:
    """Where two lines cross: their numbers, the places in samples (with fractions), and the position."""

    first: int
    second: int
    at_first: float
    at_second: float
    east: float
    north: float


@dataclass(frozen=True)
class Misfits:
    """Differences of one channel at the crossings.

    Attributes
    ----------
    channel, count
        The channel, and the crossings at which both lines have a value.
    rms
        Root mean square of the differences.
    noise
        Their standard deviation over the root of two: the share of one line.
    levelled
        The same after one constant for each line (least squares) has been taken away.
    """

    channel: str
    count: int
    rms: float
    noise: float
    levelled: float


@dataclass(frozen=True)
class Repeat:
    """Two lines along one track: names, metres that they share, and channel -> std of half their difference."""

    first: str
    second: str
    shared: float
    noise: Mapping[str, float]


def crossings(tracks: Sequence[Track | None]) -> list[Crossing]:
    """Every place at which two lines that are not parallel cross."""
    placed = [(k, t) for k, t in enumerate(tracks) if t is not None]
    boxes = [_boxes(t) for _, t in placed]
    low = np.array([b[0].min(axis=0) for b in boxes]).reshape(-1, 2)
    high = np.array([b[1].max(axis=0) for b in boxes]).reshape(-1, 2)
    steep = _angles([t for _, t in placed])
    found: list[Crossing] = []
    for k, (i, first) in enumerate(placed):
        rest = slice(k + 1, None)
        near = np.all((low[k] <= high[rest]) & (low[rest] <= high[k]), axis=1)
        others = k + 1 + np.flatnonzero(near)
        for m in others[steep(k, others) >= STEEPEST]:
            j, second = placed[m]
            for a, b in _meeting(boxes[k], boxes[m]):
                found += _crossed(i, j, first, second, a * _CHUNK, b * _CHUNK)
                if len(found) > MOST_CROSSINGS:
                    raise UserError(
                        "lines cross so often that their positions are no tracks",
                        where="columns of positions (easting and northing, or latitude and longitude)",
                        found=f"more than {MOST_CROSSINGS} crossings",
                        remedy="check these columns, or name others in a mapping: ragg map FLIGHT -o mapping.toml",
                    )
    return found


def misfits(
    lines: Sequence[SurveyLine], found: Sequence[Crossing], channels: Sequence[str]
) -> tuple[list[Misfits], dict[str, Array]]:
    """Of every channel that has at least three crossings; and the levelled differences, NaN where there is none."""
    result, every = [], {}
    for name in channels:
        d = np.array([_difference(lines, c, name) for c in found])
        there = np.isfinite(d)
        if there.sum() < 3:
            continue
        left, levelled = _levelled(d[there], [c for c, t in zip(found, there, strict=True) if t], len(lines))
        every[name] = np.full(len(d), np.nan)
        every[name][there] = left
        result.append(
            Misfits(
                channel=name,
                count=int(there.sum()),
                rms=float(np.sqrt(np.mean(d[there] ** 2))),
                noise=float(np.std(d[there]) / np.sqrt(2.0)),
                levelled=levelled,
            )
        )
    return result, every


def repeats(
    lines: Sequence[SurveyLine], tracks: Sequence[Track | None], channels: Sequence[str]
) -> list[Repeat]:
    """Pairs of lines that go along one track, and how they differ there."""
    placed = [(k, t) for k, t in enumerate(tracks) if t is not None]
    steep = _angles([t for _, t in placed])
    east, north, half, width = np.array([t.box for _, t in placed]).reshape(-1, 4).T
    reach = 1.06 * (half + width) + BESIDE  # with it two circles meet wherever the boxes below do
    found = []
    for k, (i, first) in enumerate(placed):
        e, n = east[k + 1 :] - east[k], north[k + 1 :] - north[k]
        others = k + 1 + np.flatnonzero(np.hypot(e, n) <= reach[k] + reach[k + 1 :])
        angle = steep(k, others)
        # What _shared asks for cannot be where the boxes are further from each other, along the first or across it.
        s, c, turn = np.sin(first.direction), np.cos(first.direction), np.sin(angle)
        e, n = east[others] - east[k], north[others] - north[k]
        near = np.abs(e * s + n * c) <= 1.0 + half[k] + half[others] + width[others] * turn
        near &= np.abs(e * c - n * s) <= 1.0 + BESIDE + width[k] + width[others] + half[others] * turn
        for m in others[near & (angle <= STEEPEST)]:
            j, second = placed[m]
            shared = _shared(first, second)
            if shared is not None:
                noise = _compared(lines[i], lines[j], first, second, shared, channels)
                length = float(shared[1] - shared[0])
                found.append(Repeat(lines[i].name, lines[j].name, length, noise))
    return found


def _boxes(track: Track) -> tuple[Array, Array]:
    """(n, 2) lowest and highest east and north of stretches of a track; each goes on to the next one's first sample."""
    points = np.column_stack([track.east, track.north])
    starts = np.arange(0, max(len(points) - 1, 1), _CHUNK)
    pieces = [points[s : s + _CHUNK + 1] for s in starts]
    return np.array([p.min(axis=0) for p in pieces]), np.array([p.max(axis=0) for p in pieces])


def _meeting(left: tuple[Array, Array], right: tuple[Array, Array]) -> Iterator[NDArray[np.int64]]:
    """Numbers (2,) of the stretches whose boxes overlap."""
    for start in range(0, len(left[0]), _BOXES):
        low, high = (x[start : start + _BOXES, None] for x in left)
        over = (low <= right[1][None]) & (high >= right[0][None])
        yield from np.argwhere(over.all(axis=2)) + np.array([start, 0])


def _crossed(i: int, j: int, first: Track, second: Track, a: int, b: int) -> list[Crossing]:
    """Crossings of one stretch of each: p + t r = q + u s with 0 <= t, u < 1 for every pair of steps."""
    p = np.column_stack([first.east, first.north])[a : a + _CHUNK + 1]
    q = np.column_stack([second.east, second.north])[b : b + _CHUNK + 1]
    r, s = np.diff(p, axis=0), np.diff(q, axis=0)
    gap = q[None, :-1] - p[:-1, None]
    cross = r[:, None, 0] * s[None, :, 1] - r[:, None, 1] * s[None, :, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (gap[..., 0] * s[None, :, 1] - gap[..., 1] * s[None, :, 0]) / cross
        u = (gap[..., 0] * r[:, None, 1] - gap[..., 1] * r[:, None, 0]) / cross
    hit = (t >= 0) & (t < 1) & (u >= 0) & (u < 1) & (cross != 0)
    return [
        Crossing(
            first=i,
            second=j,
            at_first=float(a + m + t[m, n]),
            at_second=float(b + n + u[m, n]),
            east=float(p[m, 0] + t[m, n] * r[m, 0]),
            north=float(p[m, 1] + t[m, n] * r[m, 1]),
        )
        for m, n in np.argwhere(hit)
    ]


def _angles(placed: Sequence[Track]) -> Callable[[int, NDArray[np.intp]], Array]:
    """Of a track's number: the angles, rad up to a right one, that it makes with others."""
    direction = np.array([t.direction for t in placed])
    return lambda k, others: np.abs(np.arcsin(np.sin(direction[k] - direction[others])))


def _difference(lines: Sequence[SurveyLine], c: Crossing, name: str) -> float:
    pair = [(lines[c.first], c.at_first), (lines[c.second], c.at_second)]
    values = [_at(x.channels[name], place) if name in x.channels else np.nan for x, place in pair]
    return float(values[0] - values[1])


def _at(values: Array, place: float) -> float:
    k = min(int(place), len(values) - 2)
    return float(values[k] + (place - k) * (values[k + 1] - values[k]))


def _levelled(d: Array, found: Sequence[Crossing], count: int) -> tuple[Array, float]:
    """What a constant for each line leaves, and its standard deviation over the root of two.

    The freedoms that the constants took are counted: lines that cross, less one for each group of them.
    """
    first, second = np.array([[c.first, c.second] for c in found]).T
    rows = np.arange(len(d))
    ones = np.ones(len(d))
    shape = (len(d), count)
    design = csr_array((ones, (rows, first)), shape=shape) - csr_array((ones, (rows, second)), shape=shape)
    left = d - design @ lsqr(design, d, atol=1e-12, btol=1e-12)[0]
    groups, _ = connected_components(csr_array((ones, (first, second)), shape=(count, count)), directed=False)
    freedom = len(d) - (count - groups)
    return left, float(np.sqrt(np.sum(left**2) / freedom / 2.0)) if freedom > 0 else float("nan")


def _shared(first: Track, second: Track) -> tuple[float, float] | None:
    """From where to where along the first line the second goes beside it, m; ``None`` if it does not."""
    s, c = np.sin(first.direction), np.cos(first.direction)
    x1, y1 = first.along()
    e, n = second.east - first.east[0], second.north - first.north[0]
    x2, y2 = e * s + n * c, e * c - n * s
    low, high = max(x1.min(), x2.min()), min(x1.max(), x2.max())
    if high - low < OVERLAP * min(np.ptp(x1), np.ptp(x2)):
        return None
    beside = np.abs(np.mean(y2[(x2 >= low) & (x2 <= high)]) - np.mean(y1[(x1 >= low) & (x1 <= high)]))
    return (float(low), float(high)) if beside < BESIDE else None


def _compared(
    a: SurveyLine,
    b: SurveyLine,
    first: Track,
    second: Track,
    shared: tuple[float, float],
    channels: Sequence[str],
) -> dict[str, float]:
    s, c = np.sin(first.direction), np.cos(first.direction)
    x1, _ = first.along()
    x2 = (second.east - first.east[0]) * s + (second.north - first.north[0]) * c
    places = np.linspace(*shared, _POINTS)
    found = {}
    for name in channels:
        if name in a.channels and name in b.channels:
            left, right = (_along(x, v.channels[name], places) for x, v in ((x1, a), (x2, b)))
            off = (left - right)[np.isfinite(left - right)]
            found[name] = float(np.std(off) / np.sqrt(2.0)) if len(off) else float("nan")
    return found


def _along(x: Array, values: Array, places: Array) -> Array:
    order = np.argsort(x)
    return np.asarray(np.interp(places, x[order], values[order]))
