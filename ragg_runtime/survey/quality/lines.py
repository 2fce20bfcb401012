"""Flight lines as they are delivered: demodulated channels of one or more discs, positions, auxiliaries; no motion needed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import numpy as np

from ragg_runtime.base.errors import UserError, at
from ragg_runtime.base.files import file_digest
from ragg_runtime.flight.files import flight_name
from ragg_runtime.flight.mapping import Mapped
from ragg_runtime.flight.record import SI_UNITS, Array, is_demodulated
from ragg_runtime.flight.sampling import uniform
from ragg_runtime.flight.source import Column, Source
from ragg_runtime.flight.sources import open_sources
from ragg_runtime.instrument.units import EOTVOS, Units, units

STANDARD_G = 9.80665
"""m/s^2, for units made with g: quality control has no model that says another (the metre convention's value)."""

SHORTEST = 30
"""Samples below which a line has no statistics."""

LARGEST = 1e100
"""Largest value of a channel, SI: the squares of all that are larger cannot be summed up."""

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
    refused: list[tuple[str, str]] = []
    notes: dict[str, None] = {}
    for path in paths:
        sources = open_sources(path, mapping, lenient=True)
        for s in sources:
            notes |= dict.fromkeys(s.notes)
            name = s.line if s.line is not None else flight_name(path)
            try:
                line = _line(s, name, flight_name(path))
                _check_new(line, lines)
                lines.append(line)
            except UserError as error:
                if len(sources) == 1 and len(paths) == 1:
                    raise
                refused.append((name, error.message))
    if not lines:
        raise UserError(
            "no line can be used",
            where=paths[0],
            found=refused[0][1].split("\n")[0] if refused else "no rows",
            expected="a column time and gradients (inline, cross, inline_A, cross_A ...), with units",
            remedy="say what the columns are: ragg map FLIGHT -o mapping.toml, then --map mapping.toml",
        )
    return Read(
        lines=tuple(sorted(lines, key=_begins)),
        refused=tuple(refused),
        files=tuple((p.name, file_digest(p)) for p in paths),
        notes=tuple(notes),
    )


def _check_new(line: SurveyLine, before: Sequence[SurveyLine]) -> None:
    """UserError if the same line was read before: it would agree with itself, and count twice."""
    for other in before:
        if len(other) == len(line) and other.gradients == line.gradients and _same(line, other):
            raise UserError(
                f"the same record as line {other.name} of {other.flight}: it would count twice",
                where=f"line {line.name} of {line.flight}",
                remedy="give each line once",
            )


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
        raise UserError("the column 'time' is missing", where=source.path, expected="time [s]")
    batches = list(source.batches())
    found = {}
    for c in columns:
        where = at(source.path, f"column {c.name!r}")
        raw = np.concatenate([np.empty(0), *(b[c.name] for b in batches)])
        found[c.name] = known.to_si(raw, c.unit, wanted[c.name], where)
        if _size(found[c.name]) > LARGEST:
            raise UserError(
                "a value is out of all proportion",
                where=where,
                found=f"{_size(found[c.name]):g}",
                expected=f"at most {LARGEST:g}",
            )
    time = found.pop("time")
    if len(time) < SHORTEST:
        raise UserError(
            "the line is too short",
            where=source.path,
            found=f"{len(time)} samples",
            expected=f"{SHORTEST} or more",
        )
    grid = uniform(time, source.path)
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


def _unit(column: Column, known: Units) -> str:
    """The SI unit of a column that is used; ``""`` for those without a unit, which are left out."""
    si = _OWN.get(column.name) or ("s^-2" if is_gradient(column.name) else SI_UNITS.get(column.name))
    if not column.unit:
        if column.name == "time" or is_gradient(column.name):
            raise UserError(
                "the column has no unit",
                where=f"column {column.name!r}",
                expected="Eo" if column.name != "time" else "s",
                remedy="say it in a mapping: ragg map FLIGHT -o mapping.toml",
            )
        return ""
    return si or known.base_unit(column.unit, f"column {column.name!r}")
