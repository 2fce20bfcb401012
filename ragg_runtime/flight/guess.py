"""A first ``mapping.toml`` from what a file says: names and units. What it does not say is marked, not guessed.

Every line carries how sure it is: *certain* (the contract's own name), *likely* (a name that is usual for it),
*guess* (a name that may stand for several things). Units come from the file alone; where it gives none, the
numbers themselves are looked at only for a remark beside the question mark.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.names import LONGEST, is_column
from ragg_runtime.flight.formats import open_file
from ragg_runtime.flight.instants import GPS_EPOCH, is_clock, way_of
from ragg_runtime.flight.mapping import UNKNOWN
from ragg_runtime.flight.names import ROLES, role_of
from ragg_runtime.flight.record import DEMODULATED, SI_UNITS, is_demodulated
from ragg_runtime.flight.source import Heading, Look, Table, is_unit
from ragg_runtime.instrument.units import units

_LOOKED_AT = 20_000  # rows whose numbers are looked at for remarks
_DATED = (datetime(1995, 1, 1, tzinfo=UTC), datetime(2045, 1, 1, tzinfo=UTC))
_EPOCHS = ((GPS_EPOCH, "GPS time"), (datetime(1970, 1, 1, tzinfo=UTC), "Unix time"))

NEAR_G = 0.1
"""Relative distance from gravity, on the median, within which a vertical channel's unit is guessed: less than platforms feel on average."""


@dataclass(frozen=True)
class Draft:
    """A mapping to begin with.

    Attributes
    ----------
    text
        The file.
    questions
        What has to be answered.
    unused
        Columns that nothing is made of.
    sure
        Channel -> ``certain``, ``likely`` or ``guess``.
    """

    text: str
    questions: tuple[str, ...]
    unused: tuple[str, ...]
    sure: Mapping[str, str]


def draft(path: Path) -> Draft:
    """Look at a file's first table and write a mapping for it."""
    tables = open_file(path, Look(text=True))
    table = tables[0]
    values = sample(table)
    lines: list[str] = [
        f"# How ragg reads {path.name}: written by `ragg map`, to be looked over.",
        '# certain: the name is ragg\'s own; likely: usual for it; guess: look twice. "?" waits for an answer.',
        "",
    ]
    questions: list[str] = []
    used: set[str] = set()
    sure: dict[str, str] = {}
    lines += _file(table, tables, used)
    lines += _time(table, values, used, questions)
    lines += _columns(table, values, used, questions, sure)
    unused = [h for h in table.headings if h.name not in used]
    if unused:
        lines += ["", "# Not used (any column can be kept as an auxiliary channel under a name of its own):"]
        lines += [f"# {_key(h.name)} = {_entry(h.name, h.unit or UNKNOWN)}" for h in unused if not h.text]
    if any(is_demodulated(r.name) for h in table.headings if (r := role_of(h.name)) is not None):
        lines += [
            "",
            "# How inline and cross were made, if it is known:",
            "# [demodulator]",
            '# kind = "butterworth"',
            '# cutoff = "0.18 Hz"',
            "# order = 6",
        ]
    return Draft(
        text="\n".join(lines) + "\n",
        questions=tuple(questions),
        unused=tuple(h.name for h in unused),
        sure=MappingProxyType(sure),
    )


def _file(table: Table, tables: Sequence[Table], used: set[str]) -> list[str]:
    if len(tables) > 1 or table.line is not None:
        names = [str(t.line) for t in tables]
        shown = ", ".join(f'"{_quoted(n)}"' for n in names[:6]) + (", ..." if len(names) > 6 else "")
        return [
            f"# {len(tables)} lines, told apart by the file itself; [file] lines = [...] picks some: {shown}",
            "",
        ]
    role = ROLES["line"]
    name = next((h.name for h in table.headings if role.fits(h.name)), None)
    if name is None:
        return []
    used.add(name)
    return [
        "[file]",
        f'line = "{_quoted(name)}"  # likely: tells flight lines apart; take it out if it does not',
        "",
    ]


def _time(
    table: Table, values: Mapping[str, NDArray[Any]], used: set[str], questions: list[str]
) -> list[str]:
    found = _instants(table, values)
    if found is not None:
        names, form, sure = found
        used.update(names)
        shown = f'"{_quoted(names[0])}"' if len(names) == 1 else str(list(names)).replace("'", '"')
        return ["[time]", f"column = {shown}  # {sure}", f'format = "{form}"', ""]
    fits = [h for h in table.headings if not h.text and ROLES["time"].fits(h.name)]
    if not fits:
        questions.append("[time] column: which column is time?")
        return [
            "[time]",
            f'column = "{UNKNOWN}"  # no column has a name that is usual for time',
            f'unit = "{UNKNOWN}"',
            "",
        ]
    h = min(fits, key=lambda h: (h.name != "time", not h.unit))
    used.add(h.name)
    sure = "certain" if h.name == "time" else "likely"
    lines = ["[time]", f'column = "{_quoted(h.name)}"  # {sure}']
    unit, remark = _unit(h, "time", values[h.name], questions, "[time]")
    lines.append(f'unit = "{unit}"{remark}')
    return [*lines, *_origin(values[h.name]), ""]


def _instants(table: Table, values: Mapping[str, NDArray[Any]]) -> tuple[tuple[str, ...], str, str] | None:
    """Columns that hold instants as such, their format, and how sure that is."""
    by_role = {
        r: h
        for h in reversed(table.headings)
        for r in ("week", "second_of_week", "date", "clock")
        if ROLES[r].fits(h.name)
    }
    if "week" in by_role and "second_of_week" in by_role:
        return (
            (by_role["week"].name, by_role["second_of_week"].name),
            "gps",
            "likely: GPS week and seconds in it",
        )
    for h in table.headings:
        if h.text and not h.name.startswith("//") and (way := way_of(values[h.name])) is not None:
            text = next((str(t) for t in values[h.name] if str(t)), "")
            if way.dated and (":" in text or values[h.name].dtype.kind == "M"):
                return (h.name,), "iso", "certain: a date and a time in every row"
    if "date" in by_role and "clock" in by_role:
        return (
            (by_role["date"].name, by_role["clock"].name),
            "date clock",
            "likely: a date and a time of the day",
        )
    for h in table.headings:
        if h.text and len(values[h.name]) and is_clock(str(values[h.name][0])):
            return (h.name,), "clock", "certain: a time of the day in every row"
    return None


def _columns(
    table: Table,
    values: Mapping[str, NDArray[Any]],
    used: set[str],
    questions: list[str],
    sure: dict[str, str],
) -> list[str]:
    lines = ["[columns]"]
    taken: dict[str, str] = {}
    candidates = [
        (h, r) for h in table.headings if not h.text and h.name not in used and (r := role_of(h.name))
    ]
    # The surest name wins a channel: certain before likely before guess, then the order of the file.
    for h, role in sorted(candidates, key=lambda c: c[1].rank):
        if role.name in taken or role.name in ("time", "line", "week", "second_of_week", "date", "clock"):
            continue
        taken[role.name] = h.name
        used.add(h.name)
    order = [*SI_UNITS, *dict.fromkeys(r.name for _, r in candidates)]
    by_name = {h.name: h for h in table.headings}
    roles = {r.name: r for _, r in reversed(candidates)}
    for name in dict.fromkeys(n for n in order if n in taken):
        h = by_name[taken[name]]
        role = role_of(h.name) or roles[name]
        unit, remark = (
            (role.unit, "") if role.unit else _unit(h, name, values[h.name], questions, f"[columns] {name}")
        )
        sure[name] = role.sure
        scale = f", scale = {role.scale:g}" if role.scale != 1.0 else ""
        comment = f"  # {role.sure}" + (f": {role.why}" if role.why else "") + remark.replace("  # ", "; ", 1)
        lines.append(f'{_key(name)} = {{ column = "{_quoted(h.name)}", unit = "{unit}"{scale} }}{comment}')
    return lines


def _unit(h: Heading, name: str, values: NDArray[Any], questions: list[str], where: str) -> tuple[str, str]:
    """The unit to write and a remark; a question where the file gives none or one that cannot be."""
    si = SI_UNITS.get(name) or _of_others(name)
    if h.unit and is_unit(h.unit):
        if si is None or units(9.8).fits(h.unit, si):
            return h.unit, ""
        questions.append(f"{where}: the file says {h.unit!r}, which is no unit of it")
        return UNKNOWN, f"  # the file says {_quoted(h.unit)}, which is no unit of {name}"
    said = f"the file says {h.unit!r}, which is no unit that is known" if h.unit else "the file gives none"
    looks = _looks(name, values)
    questions.append(f"{where}: unit of {h.name!r} ({said}{'; ' + looks if looks else ''})")
    return UNKNOWN, f"  # {_quoted(said)}" + (f"; {looks}" if looks else "")


def _of_others(name: str) -> str | None:
    stem = re.sub(r"_[^_]+$", "", name)
    return SI_UNITS.get(stem) if stem in DEMODULATED else None


def _looks(name: str, values: NDArray[Any]) -> str:
    """What the numbers remind of, as a remark beside a question; never an answer."""
    v = values[np.isfinite(values)] if values.dtype.kind == "f" else np.empty(0)
    if not len(v):
        return "no number to look at"
    size = float(np.median(np.abs(v)))
    if name == "a_z":
        for unit, g in (("g", 1.0), ("m/s^2", 9.8), ("Gal", 980.0), ("mGal", 9.8e5)):
            if abs(size / g - 1.0) < NEAR_G:
                return f"the median is {size:.4g}, as gravity in {unit}"
    if name == "time" and len(v) > 1:
        return f"steps of {float(np.median(np.diff(v))):.6g}"
    return f"from {v.min():.6g} to {v.max():.6g}"


def _origin(values: NDArray[Any]) -> list[str]:
    """Remarks on when the record may have begun, if its seconds count from a usual epoch."""
    first = float(values[0]) if len(values) and np.isfinite(values[0]) else 0.0
    found = []
    for epoch, what in _EPOCHS:
        if 0.0 < first < 3e9 and _DATED[0] < (begun := epoch + timedelta(seconds=first)) < _DATED[1]:
            begins = begun.isoformat(timespec="seconds").replace("+00:00", "Z")
            origin = epoch.isoformat().replace("+00:00", "Z")
            found.append(f"# origin = {origin}  # guess: as {what} in seconds the record begins {begins}")
    return found


def sample(table: Table) -> dict[str, NDArray[Any]]:
    """The first rows of every column."""
    return {n: v[:_LOOKED_AT] for n, v in table.rows().items()}


def _entry(column: str, unit: str) -> str:
    return f'{{ column = "{_quoted(column)}", unit = "{_quoted(unit)}" }}'


def _key(name: str) -> str:
    """A channel's name: the column's own, or one made of its letters."""
    return name if is_column(name) else ("c_" + re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_"))[:LONGEST]


def _quoted(text: str) -> str:
    """Text inside a TOML string or comment: no quotes, no lines, nothing that cannot be printed."""
    text = text.replace("\\", "\\\\").replace('"', '\\"')
    return "".join(c if c.isprintable() else f"\\u{min(ord(c), 0xFFFF):04x}" for c in text)
