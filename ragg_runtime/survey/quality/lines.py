"""Flight lines as they are delivered: demodulated channels of one or more discs, positions, auxiliaries; no motion needed."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.errors import UserError, at
from ragg_runtime.base.files import file_digest
from ragg_runtime.flight.files import flight_name
from ragg_runtime.flight.mapping import Mapped
from ragg_runtime.flight.record import SI_UNITS, Array, is_demodulated
from ragg_runtime.flight.sampling import Grid, uniform
from ragg_runtime.flight.source import Column, Source
from ragg_runtime.flight.sources import open_sources
from ragg_runtime.instrument.units import EOTVOS, Units, units

STANDARD_G = 9.80665
"""m/s^2, for units made with g: quality control has no model that says another (the metre convention's value)."""

SHORTEST = 30
"""Samples below which a line has no statistics."""

LARGEST = 1e100
"""Largest value of a channel, SI: the squares of all that are larger cannot be summed up."""

MOST: Mapping[str, float] = {"latitude": 1.6, "longitude": 6.3, "easting": 1e8, "northing": 1e8}
"""Largest positions, rad and m: a right angle, a whole turn, and more than any projection has, its zone in front."""

RATES = (1e-2, 1e6)
"""Hz: slower samples stand kilometres apart, faster ones nobody records; beyond them the time's unit is wrong."""

MAP = "say what the columns are: ragg map FLIGHT -o mapping.toml, then --map mapping.toml"

SAME = 1e-6
"""Difference, by the largest value, up to which channels are the same: in single precision, or printed to seven digits."""

_NAMED = ("easting", "northing", "altitude", "clearance")
_OWN: Mapping[str, str] = {
    **dict.fromkeys(_NAMED, "m"),
    "latitude": "rad",
    "longitude": "rad",
    "heading": "rad",
    "vertical_velocity": "m/s",
    "vertical_acceleration": "m/s^2",
    "flight": "1",
}


@dataclass(frozen=True, eq=False)
class SurveyLine:
    """One line, evenly sampled.

    Attributes
    ----------
    name, flight
        Of the line, and of the file that it stands in.
    time
        (N,) s from ``origin``, or from anywhere where that is ``None``.
    rate
        Samples a second.
    channels
        Name -> (N,): gradients in Eo, everything else in SI; NaN where nothing stands.
    """

    name: str
    flight: str
    time: Array
    rate: float
    channels: Mapping[str, Array]
    origin: datetime | None = None

    def __len__(self) -> int:
        return len(self.time)

    @property
    def gradients(self) -> tuple[str, ...]:
        """Names of the channels that are gradients."""
        return tuple(n for n in self.channels if is_gradient(n))

    @property
    def missing(self) -> int:
        """Samples at which a gradient is missing."""
        if not self.gradients:
            return 0
        return int(np.sum(np.any([np.isnan(self.channels[n]) for n in self.gradients], axis=0)))


@dataclass(frozen=True)
class Read:
    """What was read: the lines, (line, message) of those that could not be, (name, SHA-256) of files, notes."""

    lines: tuple[SurveyLine, ...]
    refused: tuple[tuple[str, str], ...]
    files: tuple[tuple[str, str], ...]
    notes: tuple[str, ...]


def is_gradient(name: str) -> bool:
    """Whether a channel is a gradient, by its name: ``inline``, ``cross_A``, ``Gamma_xx`` ..."""
    return not name.endswith("_std") and (is_demodulated(name) or name.partition("_")[0] == "Gamma")


def read_lines(paths: Sequence[Path], mapping: Mapped | None = None) -> Read:
    """The lines of all files; a line that cannot be used does not hinder the others."""
    lines: list[SurveyLine] = []
    refused: list[tuple[str, UserError]] = []
    before: dict[Any, list[tuple[float, int, SurveyLine]]] = {}
    notes: dict[str, None] = {}
    for path in paths:
        sources = open_sources(path, mapping, lenient=True)
        for s in sources:
            bare = [c.name for c in s.columns if not c.unit and (c.name in _OWN or c.name in SI_UNITS)]
            notes |= dict.fromkeys([*s.notes, *(f"{n} has no unit; it is left out" for n in bare)])
            name = s.line if s.line is not None else flight_name(path)
            try:
                line = _line(s, name, flight_name(path))
                _check_new(line, before)
                lines.append(line)
            except UserError as error:
                if len(sources) == 1 and len(paths) == 1:
                    raise
                refused.append((name, error))
    if not lines:
        name, first = refused[0]
        raise UserError(
            f"none of {len(refused)} lines can be used; the first: {first.what}",
            where=at(paths[0], f"line {name}"),
            found=first.found,
            expected=first.expected,
            remedy=first.remedy,
        )
    return Read(
        lines=tuple(sorted(lines, key=_begins)),
        refused=tuple((n, e.message) for n, e in refused),
        files=tuple((p.name, file_digest(p)) for p in paths),
        notes=(*notes, *_still(lines)),
    )


def _still(lines: Sequence[SurveyLine]) -> Iterator[str]:
    """In sentences, gradients that are missing or never change: their noise would look small."""
    for n in dict.fromkeys(n for x in lines for n in x.gradients):
        there = [x.channels[n] for x in lines if n in x.channels]
        still = sum(bool(np.all(np.isnan(v) | (v == v[np.argmax(~np.isnan(v))]))) for v in there)
        if still:
            yield f"{n} has no values, or one value alone, on {still} of {len(lines)} lines"


def _check_new(line: SurveyLine, before: dict[Any, list[tuple[float, int, SurveyLine]]]) -> None:
    """UserError if the same line was read before: it would agree with itself, and count twice.

    ``before``: (length, gradients) -> lines, by the size of their first gradient, by which most are told apart.
    """
    size = _size(line.channels[line.gradients[0]])
    alike, room = before.setdefault((len(line), line.gradients), []), 2.0 * SAME * size
    for _, _, other in alike[bisect_left(alike, (size - room,)) : bisect_left(alike, (size + room, np.inf))]:
        if _same(line, other):
            raise UserError(
                f"the same record as line {other.name} of {other.flight}: it would count twice",
                where=f"line {line.name} of {line.flight}",
                remedy="give each line once",
            )
    insort(alike, (size, len(alike), line))


def _same(line: SurveyLine, other: SurveyLine) -> bool:
    for n in line.gradients:
        a, b = line.channels[n], other.channels[n]
        if not np.allclose(a, b, rtol=0.0, atol=SAME * _size(a), equal_nan=True):
            return False
    return True


def _size(values: Array) -> float:
    """The largest value, without its sign; 0 if there is none."""
    return float(np.max(np.abs(values), initial=0.0, where=~np.isnan(values)))


def _begins(line: SurveyLine) -> tuple[float, float]:
    origin = 0.0 if line.origin is None else line.origin.timestamp()
    return (origin + float(line.time[0]), 0.0)


def _line(source: Source, name: str, flight: str) -> SurveyLine:
    known = units(STANDARD_G)
    wanted = {c.name: _unit(c, known) for c in source.columns}
    columns = [c for c in source.columns if wanted[c.name]]
    if not any(is_demodulated(c.name) for c in columns):
        raise UserError(
            "no gradient that a disc measured is among the columns",
            where=source.path,
            found=", ".join(c.name for c in source.columns)[:300],
            expected="inline, cross, inline_A, cross_A, inline_1 ... with a unit such as Eo",
            remedy="of a record before demodulation, `ragg compensate` makes them; other names need a mapping: ragg map",
        )
    if "time" not in wanted:
        raise UserError("the column 'time' is missing", where=source.path, expected="time [s]", remedy=MAP)
    batches = list(source.batches())
    found = {}
    for c in columns:
        where = at(source.path, f"column {c.name!r}")
        raw = np.concatenate([np.empty(0), *(b[c.name] for b in batches)])
        found[c.name] = known.to_si(raw, c.unit, wanted[c.name], where)
        most = MOST.get(c.name, LARGEST)
        if _size(found[c.name]) > most:
            raise UserError(
                "a value is out of all proportion",
                where=where,
                found=f"{_size(found[c.name]):g} {wanted[c.name]}",
                expected=f"at most {most:g} {wanted[c.name]}",
                remedy="check the column and its unit; a value that is missing is an empty cell",
            )
    time = found.pop("time")
    if len(time) < SHORTEST:
        raise UserError(
            "the line is too short",
            where=source.path,
            found=f"{len(time)} samples",
            expected=f"{SHORTEST} or more",
            remedy="if what divides the file into lines is another column, name it in a mapping: [file] line = ...",
        )
    grid = uniform(time, source.path)
    _check_clock(grid, source)
    channels = {}
    for n, values in found.items():
        whole = np.full(len(grid.time), np.nan)
        whole[grid.index] = values / EOTVOS if is_gradient(n) else values
        channels[n] = whole
    return SurveyLine(
        name=name,
        flight=flight,
        time=grid.time,
        rate=1.0 / grid.step,
        channels=channels,
        origin=source.origin,
    )


def _check_clock(grid: Grid, source: Source) -> None:
    """UserError where the rate is no rate of a survey, or the instants are no date."""
    where = at(source.path, "column 'time'")
    if not RATES[0] <= 1.0 / grid.step <= RATES[1]:
        raise UserError(
            "the rate is out of all proportion",
            where=where,
            found=f"a sample every {grid.step:g} s",
            expected=f"{RATES[0]:g} to {RATES[1]:g} samples a second",
            remedy="check the unit of the time",
        )
    try:
        if source.origin is not None:
            source.origin + timedelta(seconds=float(grid.time[0]))
    except OverflowError:
        raise UserError(
            "the time is no date",
            where=where,
            found=f"{grid.time[0]:g} s after {source.origin}",
            remedy="check the unit of the time, and the origin that the mapping gives",
        ) from None


def _unit(column: Column, known: Units) -> str:
    """The SI unit of a column that is used; ``""`` for those without a unit, which are left out."""
    si = _OWN.get(column.name) or ("s^-2" if is_gradient(column.name) else SI_UNITS.get(column.name))
    if not column.unit:
        if column.name == "time" or is_gradient(column.name):
            raise UserError(
                "the column has no unit",
                where=f"column {column.name!r}",
                expected="Eo" if column.name != "time" else "s",
                remedy=MAP,
            )
        return ""
    return si or known.base_unit(column.unit, f"column {column.name!r}")
