"""Figures of several lines as the package galileoQC (1.0.16) defines them, written anew: gaps, crossovers, repeats.

Which lines are held against each other galileoQC is told by lists; here every line is a traverse whose controls are all
lines that it meets, and repeats are the groups that :mod:`ragg_runtime.survey.quality.crossovers` finds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import splev, splrep
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from ragg_runtime.flight.record import Array
from ragg_runtime.survey.quality.crossovers import Repeat
from ragg_runtime.survey.quality.lines import SurveyLine
from ragg_runtime.survey.quality.track import Track

SHORTEST = 10
"""Samples below which a line is not compared with others (``checkRepeatLines``)."""


def gaps(lines: Sequence[SurveyLine]) -> list[dict[str, Any]]:
    """Lines and channels without a value at some samples, and at how many (``checkGaps``)."""
    found = []
    for x in lines:
        missing = {n: int(np.count_nonzero(np.isnan(v))) for n, v in x.channels.items()}
        missing = {n: k for n, k in missing.items() if k}
        if missing:
            found.append({"line": x.name, "missing": missing})
    return found


def crossovers(
    lines: Sequence[SurveyLine], tracks: Sequence[Track | None], channels: Sequence[str]
) -> list[dict[str, Any]]:
    """Of every line and channel: how it differs from the lines that it meets (``checkIntersection``).

    ``rms`` (its mode RMS) is the standard deviation of the differences, ``rms_root2`` that over the root of two,
    ``largest`` the largest one (its mode value).
    """
    found = []
    placed = [(k, t) for k, t in enumerate(tracks) if t is not None]
    ends = np.array([_ends(t) for _, t in placed]).reshape(-1, 4)
    for i, track in placed:
        line = lines[i]
        own = _ends(track)
        near = np.flatnonzero(_beside(ends, own))
        meet = near[_meet(ends[near], own)]
        bearing = _bearing(track)
        met = [(placed[k][0], intersection(track, placed[k][1], bearing)) for k in meet if placed[k][0] != i]
        for name in channels:
            d = np.array([_difference(line, lines[j], name, places) for j, places in met])
            d = d[np.isfinite(d)]
            if len(d):
                rms = float(np.std(d))
                found.append(
                    {
                        "line": line.name,
                        "channel": name,
                        "count": len(d),
                        "rms": rms,
                        "rms_root2": rms / float(np.sqrt(2.0)),
                        "largest": float(np.max(np.abs(d))),
                    }
                )
    return found


def intersection(traverse: Track, control: Track, bearing: float) -> tuple[int, int]:
    """Samples of both that are nearest to where their straight lines meet.

    In the frame of the traverse's bearing, rad: the control's sample nearest to its line, and the traverse's beside that one.
    """
    s, c = np.sin(bearing), np.cos(bearing)

    def turned(t: Track) -> tuple[Array, Array]:
        """Along the bearing, and across."""
        e, n = t.east - traverse.east[0], t.north - traverse.north[0]
        return s * e + c * n, c * e - s * n

    along, across = turned(control)
    at_control = int(np.argmin(np.abs(across)))
    at_traverse = int(np.argmin(np.abs(turned(traverse)[0] - along[at_control])))
    return at_traverse, at_control


def _difference(line: SurveyLine, other: SurveyLine, name: str, places: tuple[int, int]) -> float:
    if name not in line.channels or name not in other.channels:
        return float("nan")
    return float(line.channels[name][places[0]] - other.channels[name][places[1]])


def _bearing(t: Track) -> float:
    return float(np.arctan2(_inner_mean(np.diff(t.east)), _inner_mean(np.diff(t.north))))


def _inner_mean(x: Array) -> float:
    """The mean of what lies within one standard deviation of the mean."""
    return float(np.mean(x[np.abs(x - np.mean(x)) < np.std(x)])) if np.std(x) > 0 else float(np.mean(x))


def _ends(t: Track) -> Array:
    """(4,) m: east and north of the first sample, and of the last."""
    return np.array([t.east[0], t.north[0], t.east[-1], t.north[-1]])


def _beside(controls: Array, traverse: Array) -> NDArray[np.bool_]:
    """(n,): whether the upright boxes about the ends overlap, to a metre; where they do not no lines meet."""
    a, b = (f(controls[:, :2], controls[:, 2:]) for f in (np.minimum, np.maximum))
    c, d = (f(traverse[:2], traverse[2:]) for f in (np.minimum, np.maximum))
    return np.asarray(((a <= d + 1.0) & (c <= b + 1.0)).all(axis=1))


def _meet(controls: Array, traverse: Array) -> NDArray[np.bool_]:
    """(n,): whether the straight lines between the ends (n, 4) meet the one between the ends (4,)."""

    def turns(p: Array, q: Array, r: Array) -> NDArray[np.bool_]:
        return np.asarray((r[1] - p[1]) * (q[0] - p[0]) > (q[1] - p[1]) * (r[0] - p[0]))

    a, b, c, d = controls.T[:2], controls.T[2:], traverse[:2], traverse[2:]
    return np.asarray((turns(a, c, d) != turns(b, c, d)) & (turns(a, b, c) != turns(a, b, d)))


def groups(lines: Sequence[SurveyLine], found: Sequence[Repeat]) -> list[list[int]]:
    """Lines, by their numbers, that were flown along one track."""
    place = {x.name: k for k, x in enumerate(lines)}
    pairs = np.array([[place[r.first], place[r.second]] for r in found], dtype=np.intp).reshape(-1, 2)
    n = len(lines)
    joined = csr_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(n, n))
    _, labels = connected_components(joined, directed=False)
    order = np.argsort(labels, kind="stable")
    sets = [s.tolist() for s in np.split(order, np.cumsum(np.bincount(labels))[:-1])]
    return [s for s in sets if len(s) > 1]


def repeat_lines(
    lines: Sequence[SurveyLine], tracks: Sequence[Track | None], members: Sequence[int], channel: str
) -> dict[str, Any] | None:
    """Deviations of repeated lines from their mean (``checkRepeatLines``): of each, and of all of more than two.

    Along east or north, whichever the first line goes further; splines through the samples, at as many places as the
    shortest line has samples. ``None`` where the lines do not overlap or lack values.
    """
    first = tracks[members[0]]
    assert first is not None
    over_east = abs(first.east[-1] - first.east[0]) > abs(first.north[-1] - first.north[0])
    series = []
    for k in members:
        track, values = tracks[k], lines[k].channels.get(channel)
        if track is None or values is None:
            return None
        x = track.east if over_east else track.north
        good = np.isfinite(x + values)
        if np.sum(good) < SHORTEST:
            return None
        order = slice(None, None, -1) if x[good][1] < x[good][0] else slice(None)
        series.append((x[good][order], values[good][order]))
    low, high = max(x.min() for x, _ in series), min(x.max() for x, _ in series)
    if low >= high:
        return None
    base = np.linspace(low, high, min(len(x) for x, _ in series))
    try:
        values = np.stack([_along(x, v, base) for x, v in series])
    except ValueError:  # a line that turns back, or hardly overlaps
        return None
    off = values - values.mean(axis=0)
    names = [lines[k].name for k in members]
    each = {n: float(s) for n, s in zip(names, np.std(off, axis=1), strict=True)}
    every = float(np.mean(np.std(values, axis=0))) if len(members) > 2 else None
    return {"channel": channel, "lines": each, "all": every}


def _along(x: Array, values: Array, base: Array) -> Array:
    inside: NDArray[np.bool_] = (x > base[0]) & (x < base[-1])
    if np.sum(inside) < SHORTEST:
        raise ValueError("too few samples where the lines overlap")
    return np.asarray(splev(base - base[0], splrep(x[inside] - base[0], values[inside])))


def as_galileo(
    lines: Sequence[SurveyLine],
    tracks: Sequence[Track | None],
    repeats: Sequence[Repeat],
    channels: Sequence[str],
) -> Mapping[str, Any]:
    """All of them, for JSON."""
    flown = groups(lines, repeats)
    again = [repeat_lines(lines, tracks, g, n) for g in flown for n in channels]
    return {
        "gaps": gaps(lines),
        "crossovers": crossovers(lines, tracks, channels),
        "repeats": [r for r in again if r is not None],
    }
