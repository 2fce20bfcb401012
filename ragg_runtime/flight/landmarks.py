"""Whether two flights hold the same record: what is counted twice as evidence accuses, and is none.

A landmark is a sample at which the specific force, or the output, is larger than at all samples near it. It stands
there whichever format the record is kept in, to how many digits it was printed, wherever it was cut and from when its
time is counted. Two flights whose landmarks agree in all columns, at one distance in time, are (parts of) one record.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.record import ANGULAR_RATE, DEMODULATED, SPECIFIC_FORCE, Flight

Array = NDArray[np.float64]
Index = NDArray[np.intp]

NEAR = 128
"""Samples on either side among which a landmark is the largest."""

SHARED = 3
"""Landmarks that two flights must share (all that they have, if those are fewer)."""

AGREEING = 0.5
"""Share of the landmarks of the time that two flights have in common that must agree: rounding moves some."""

DIGITS = 10.0
"""Difference, in steps of the last digit printed, up to which values are the same: a printed number of six digits has
steps that differ by ten from its smallest to its largest leading digit."""

TELLING = 30.0
"""Spread of a column over that difference from which agreement means something, in two columns at least."""

EXACT = 1e-9
"""Relative difference up to which values are the same in any case: more digits than these are not looked for."""

_STEPS = 200  # differences, the smallest ones, that tell the last digit
_PRINTED = 16384  # samples whose digits are looked at
_CHUNK = 1 << 20

SAME_RATE = 1e-3
"""Relative difference of two flights' rates up to which their samples are compared."""


@dataclass(frozen=True)
class Landmarks:
    """Landmarks of a flight.

    Attributes
    ----------
    name, rate
        Of the flight; Hz.
    rows
        (k,): samples, counted from the flight's first.
    columns
        Name -> (k,), SI: what was recorded there.
    digit, spread
        Name -> step of the last digit; standard deviation, SI.
    """

    name: str
    rate: float
    rows: Index
    columns: Mapping[str, Array]
    digit: Mapping[str, float]
    spread: Mapping[str, float]

    def as_json(self) -> dict[str, Any]:
        return {
            "rate": self.rate,
            "rows": self.rows.tolist(),
            "columns": {n: v.tolist() for n, v in self.columns.items()},
            "digit": dict(self.digit),
            "spread": dict(self.spread),
        }

    @staticmethod
    def from_json(name: str, x: Mapping[str, Any]) -> Landmarks:
        """Of a flight of this name."""
        return Landmarks(
            name=name,
            rate=x["rate"],
            rows=np.asarray(x["rows"], dtype=np.intp),
            columns={n: np.asarray(v, dtype=np.float64) for n, v in x["columns"].items()},
            digit=x["digit"],
            spread=x["spread"],
        )


@dataclass(frozen=True)
class Overlap:
    """What two flights share: landmarks, and the first and last of them, s from the second flight's begin."""

    landmarks: int
    first: float
    last: float


def landmarks(flight: Flight, most: int | None = None) -> Landmarks:
    """The landmarks of a flight; with ``most``, only so many, which stand out among more samples."""
    names = [n for n in (*SPECIFIC_FORCE, *ANGULAR_RATE) if n in flight.channels]
    series = {n: flight.channels[n] for n in names}
    series |= {n: flight.outputs[n] for n in ("G_out", *DEMODULATED) if n in flight.outputs}
    force = [series[n] for n in SPECIFIC_FORCE if n in series]
    rows, size = _maxima(force, flight.valid)
    if len(rows) == 0:  # at rest
        rows, size = _maxima([v for n, v in series.items() if n not in names][:1], flight.valid)
    near = NEAR
    while most is not None and len(rows) > most:
        near *= 2
        kept = [bool(size[k] >= np.max(size[np.abs(rows - rows[k]) <= near])) for k in range(len(rows))]
        rows, size = rows[kept], size[kept]
    middle = slice(max(0, (len(flight) - _PRINTED) // 2), (len(flight) + _PRINTED) // 2)
    some = {n: np.asarray(v[middle])[flight.valid[middle]] for n, v in series.items()}
    return Landmarks(
        name=str(flight.path or flight.name),
        rate=flight.rate,
        rows=rows,
        columns={n: np.asarray(v[rows]) for n, v in series.items()},
        digit={n: _digit(v) for n, v in some.items()},
        spread={n: float(np.nanstd(v)) if len(v) else 0.0 for n, v in some.items()},
    )


def overlap(one: Landmarks, other: Landmarks) -> Overlap | None:
    """What two flights share, or nothing."""
    names = [n for n in one.columns if n in other.columns]
    allowed = {n: DIGITS * (one.digit[n] + other.digit[n]) for n in names}
    worth = {n: max(one.spread[n], other.spread[n]) / (allowed[n] + 1e-300) for n in names}
    telling = sorted((n for n in names if worth[n] > TELLING), key=lambda n: -worth[n])
    if len(telling) < 2 or not len(one.rows) or abs(one.rate / other.rate - 1) > SAME_RATE:
        return None
    best = telling[0]
    order = np.argsort(other.columns[best])
    ranked = other.columns[best][order]
    low = np.searchsorted(ranked, one.columns[best] - allowed[best])
    high = np.searchsorted(ranked, one.columns[best] + allowed[best], "right")
    pairs = [(k, order[j]) for k in range(len(low)) for j in range(low[k], high[k])]
    agreeing = np.array(
        [
            p
            for p in pairs
            if all(_close(one.columns[n][p[0]], other.columns[n][p[1]], allowed[n]) for n in names)
        ],
        dtype=np.intp,
    ).reshape(-1, 2)
    if not len(agreeing):
        return None
    shifts, counts = np.unique(other.rows[agreeing[:, 1]] - one.rows[agreeing[:, 0]], return_counts=True)
    shift, count = int(shifts[np.argmax(counts)]), int(np.max(counts))
    moved = one.rows + shift
    common = int(np.sum((moved >= other.rows[0]) & (moved <= other.rows[-1])))
    if count < min(SHARED, len(one.rows), len(other.rows)) or count < AGREEING * common:
        return None
    found = other.rows[agreeing[:, 1]][other.rows[agreeing[:, 1]] - one.rows[agreeing[:, 0]] == shift]
    return Overlap(count, float(found.min()) / other.rate, float(found.max()) / other.rate)


def repeated(every: Sequence[Landmarks]) -> Iterator[tuple[int, int, Overlap]]:
    """(j, i, what they share) of each flight j that is the same record as one before it, the first such i.

    Landmarks are sorted by the most telling column that all flights have: only neighbours there can agree, and most
    pairs of flights (fifty million, of ten thousand flights) need not be looked at.
    """
    for j, earlier in enumerate(_neighbours(every)):
        for i in sorted(earlier):
            found = overlap(every[i], every[j])
            if found is not None:
                yield j, i, found
                break


def _neighbours(every: Sequence[Landmarks]) -> list[set[int]]:
    """For each flight those before it with a landmark that agrees in all columns that every flight has."""
    names = sorted(set.intersection(*(set(x.columns) for x in every))) if every else []
    if not names:
        return [set(range(j)) for j in range(len(every))]
    names.sort(key=lambda n: -float(np.median([x.spread[n] / (x.digit[n] + 1e-300) for x in every])))
    owner = np.repeat(np.arange(len(every)), [len(x.rows) for x in every])
    values = {n: np.concatenate([x.columns[n] for x in every]) for n in names}
    order = np.argsort(values[names[0]], kind="stable")
    order = order[np.isfinite(values[names[0]][order])]
    owner = owner[order]
    values = {n: v[order] for n, v in values.items()}
    room = {
        n: DIGITS * np.array([x.digit[n] for x in every])[owner] + EXACT * np.abs(values[n]) for n in names
    }
    widest = 2.0 * float(np.max(room[names[0]], initial=0.0))
    found: list[set[int]] = [set() for _ in every]
    for apart in range(1, len(owner)):
        near = np.flatnonzero(values[names[0]][apart:] - values[names[0]][:-apart] <= widest)
        if not len(near):
            break
        near = near[owner[near] != owner[near + apart]]
        for n in names:
            one, other = values[n][near], values[n][near + apart]
            same = np.abs(other - one) <= room[n][near] + room[n][near + apart]
            near = near[same | (np.isnan(one) & np.isnan(other))]
        for k in near:
            i, j = sorted((int(owner[k]), int(owner[k + apart])))
            found[j].add(i)
    return found


def distinct(flights: Sequence[Flight]) -> None:
    """UserError if two of the flights are the same record, or overlapping cuts of one."""
    if len(flights) < 2:
        return
    every = [landmarks(x) for x in flights]
    for j, i, found in repeated(every):
        raise UserError(
            same_record(every[i].name, found), where=every[j].name, remedy="give each record once, uncut"
        )


def same_record(name: str, found: Overlap) -> str:
    """In words."""
    return (
        f"the same record as {name}, as evidence it would count twice: the samples agree at {found.landmarks} marked "
        f"places from {found.first:.4g} s to {found.last:.4g} s after its begin"
    )


def _maxima(series: Sequence[Array], valid: NDArray[np.bool_]) -> tuple[Index, Array]:
    """Samples (k,) at which the length of a vector is larger than at NEAR others on either side, and that length."""
    n = len(valid)
    rows, sizes = [], []
    for start in range(0, n if series else 0, _CHUNK):
        first, last = max(0, start - NEAR), min(n, start + _CHUNK + NEAR)
        part = slice(first, last)
        length = np.sum([np.nan_to_num(np.asarray(x[part])) ** 2 for x in series], axis=0)
        length[~valid[part]] = -np.inf
        top = ndimage.maximum_filter1d(length, 2 * NEAR + 1, mode="nearest")
        found = np.flatnonzero((length == top) & np.isfinite(length)) + first
        inside = (found >= max(NEAR, start)) & (found < min(n - NEAR, start + _CHUNK))
        rows.append(found[inside])
        sizes.append(length[found[inside] - first])
    k, size = (np.concatenate(x) if x else np.empty(0) for x in (rows, sizes))
    alone = np.ones(len(k), dtype=np.bool_)  # where something stands still, all samples are the largest
    close = np.diff(k) <= NEAR
    alone[1:] &= ~close
    alone[:-1] &= ~close
    return k[alone].astype(np.intp), size[alone]


def _digit(values: Array) -> float:
    """The step of the last digit of the larger values (N,), of which their differences are multiples; 0 if of none."""
    values = values[np.isfinite(values)]
    if not len(values):
        return 0.0
    largest = float(np.max(np.abs(values)))
    steps = np.diff(np.unique(values[np.abs(values) > 0.3 * largest]))
    steps = np.sort(steps[steps > EXACT * largest])[:_STEPS]
    if not len(steps):
        return 0.0
    divisor = float(steps[0])
    for step in steps:
        rest = float(step)
        while rest > max(0.01 * divisor, EXACT * largest):
            divisor, rest = (rest, divisor % rest) if rest < divisor else (divisor, rest % divisor)
            rest = min(rest, divisor - rest)
        if divisor <= EXACT * largest:
            return 0.0
    return divisor


def _close(a: float, b: float, allowed: float) -> bool:
    return bool(abs(a - b) <= allowed + EXACT * abs(a)) or bool(np.isnan(a) and np.isnan(b))
