"""A first ``mapping.toml`` from names and units of a file. Missing units are marked, not guessed.

Every line carries how sure it is: *certain* (the contract's own name), *likely* or *guess*. Units come from the file
alone. Whatever is odd about a column, the others are written.

What a column may be is told by the words of its name, of which loggers have many for the same things. A name is taken apart into words,
and a unit among them is taken off. A quantity and a direction are looked for; words that say that it is no reading (``covariance``,
``bias``) rule it out, unknown ones make it a guess.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import resources
from itertools import product
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from derive.names import LONGEST
from ragg_runtime.base.errors import UserError, is_column
from ragg_runtime.instrument.units import units
from ragg_runtime.io.files import read_tables
from ragg_runtime.io.instants import are_packed, find_order, find_parts
from ragg_runtime.io.mapping import UNKNOWN
from ragg_runtime.io.record import ANGULAR_RATE, DEMODULATED, SI_UNITS, SPECIFIC_FORCE
from ragg_runtime.io.tables import DataColumn, DataTable, is_unit, read_numbers

OUTPUTS = ("G_out", "V_", "inline")  # how channels begin of which one must be there
_LOOKED_AT = 20_000  # rows of a sample
_FEW = 5  # different cells that are no numbers, in a column of numbers
_TIMES = ("time", "line", "week", "second_of_week", "date", "clock")

RANKS = ("certain", "likely", "guess")


@dataclass(frozen=True)
class Role:
    """A channel that a column may be."""

    name: str
    sure: str = "likely"  # one of RANKS
    scale: float = 1.0  # between column and channel, where the name tells it
    why: str = ""
    direction: str = ""  # of a component whose axis the other columns decide, as the name calls it

    @property
    def rank(self) -> int:
        return RANKS.index(self.sure)


_HALF = "an inline output is usually (Gamma_xx - Gamma_yy)/2; ragg's inline is twice that"
_NAMES = tomllib.loads(resources.files("ragg_runtime.io").joinpath("names.toml").read_text("utf-8"))
_SCALARS = [
    (
        Role(entry["name"].replace("@", k), entry.get("sure", "likely"), *told),
        entry["pattern"].replace("@", word),
    )
    for entry in _NAMES["scalars"]
    for told in [(2.0, _HALF) if "half" in entry else (1.0, entry.get("why", ""))]
    for k, word in entry.get("of", {"": ""}).items()
]
_FRAMES, _SHORT = _NAMES["frames"], _NAMES["short"]
_LONG = "|".join(
    dict.fromkeys([*"xyz", *(d for f in _FRAMES for d in f if len(d) > 1), "xv_?[123]", "[0-9]"])
)
_DIRECTION = rf"(?:{_LONG}|{'|'.join(_SHORT)})"
_NEUTRAL, _NO_READING = (re.compile(_NAMES[n]) for n in ("neutral", "no_reading"))

Roles = Mapping[str, tuple[Role, ...]]
Instants = tuple[tuple[str, ...], str, str]


@dataclass(frozen=True)
class Draft:
    """A mapping to begin with."""

    text: str
    questions: tuple[str, ...]  # to be answered
    sure: Mapping[str, str]  # channel -> one of RANKS
    notes: tuple[str, ...] = ()  # what could not be taken


def draft_mapping(path: Path) -> Draft:
    """Look at the table of a file that has most of what a flight has, and write a mapping for it."""
    tables, table = _pick(read_tables(path), path)
    table, odd = _read_numbers(table)
    questions: list[str] = []
    roles = _find_roles(table.names)
    line = next((n for n in table.names if _has(roles[n], "line")), None) if len(tables) == 1 else None
    time, used = _draft_time(table, roles, odd, questions)
    rest = [c for c in table.columns if c.name not in (line, *used)]
    channels = _take_roles(rest, roles)
    unused = [c for c in rest if c.name not in {c.name for c, _ in channels.values()}]
    texts = [f"{c.name}: no numbers ({_show_cell(c)}), not used" for c in unused if not c.is_number]
    lacking = [n for n in (*SPECIFIC_FORCE, *ANGULAR_RATE) if n not in channels]
    if not any(n.startswith(OUTPUTS) for n in channels):
        lacking.append("the output (G_out, V_1 ... or inline and cross)")
    remarks = [f"no column is recognised as {', '.join(lacking)}: name it in [columns]"] if lacking else []
    lines = [
        f"# How ragg reads {_quote(path.name)}: drafted by `ragg map`; check every line.",
        '# certain: ragg\'s own name; likely: a usual name; guess: check it. Replace every "?".',
        *(f"# {_quote(n)}" for n in table.notes),
        "",
        *_draft_file(table, tables, line),
        *("[time]", *time, "", "[columns]"),
        *(_draft_channel(n, c, role, odd, questions) for n, (c, role) in channels.items()),
    ]
    if unused:
        lines += ["", "# Not used (any column can be used as an auxiliary channel of any name):"]
    for c in unused:
        kept = f"{_make_key(c.name)} = {_write_entry(c.name, c.unit or UNKNOWN)}"
        lines.append(f"# {kept}" if c.is_number else f"# no numbers: {_quote(c.name)} ({_show_cell(c)})")
    return Draft(
        text="\n".join([*lines, *(f"# {x}" for x in remarks)]) + "\n",
        questions=tuple(questions),
        sure=MappingProxyType({n: role.sure for n, (_, role) in channels.items()}),
        notes=(*table.notes, *texts, *remarks),
    )


def sample_table(path: Path) -> DataTable:
    """The first rows of the table that a mapping would be drafted for."""
    table = _pick(read_tables(path), path)[1]
    return table.rows(np.arange(min(len(table), _LOOKED_AT)))


def _pick(tables: Sequence[DataTable], path: Path) -> tuple[list[DataTable], DataTable]:
    """The tables that are alike to the one with most columns of known roles, and that one."""
    tables = [t for t in tables if t.columns]
    if not tables:
        raise UserError("the file holds no table", where=path, expected="vectors of numbers of one length")
    best = max(tables, key=lambda t: (len({r[0].name for r in _find_roles(t.names).values() if r}), len(t)))
    alike = [t for t in tables if {*t.names} == {*best.names}]
    return alike, replace(alike[0], part=best.part if len(alike) < len(tables) else "")


def _read_numbers(table: DataTable) -> tuple[DataTable, dict[str, list[str]]]:
    """The table with columns of text that are mostly numbers as numbers, and ``null`` for the few cells of them that are none."""
    columns, odd = [], {}
    for c in table.columns:
        if c.is_text:
            read, spoiled = read_numbers(c, table.decimal)
            cells = sorted({*c.values[spoiled]})
            if len(cells) <= _FEW and np.mean(np.isfinite(read.values)) > 0.5:
                odd[c.name] = [_write("null", cells)] * bool(cells)
                c = read
        columns.append(c)
    return replace(table, columns=tuple(columns)), odd


def _draft_file(table: DataTable, tables: Sequence[DataTable], name: str | None) -> list[str]:
    """Which part of the file, and which lines."""
    above, lines = [], []
    if len(tables) > 1:
        shown = _write("lines", [str(t.line) for t in tables[:6]])
        above = [f"# {len(tables)} lines; [file] picks some, such as {shown}", ""]
    if table.part:
        lines.append(_write("part", table.part, "likely: the file holds several tables that differ"))
    if name is not None:
        lines.append(_write("line", name, "likely: names the flight lines; remove it if it does not"))
    return [*above, "[file]", *lines, ""] if lines else above


def _write(key: str, value: str | Sequence[str], remark: str = "") -> str:
    """A line of TOML with a text, or a list of them, and a remark."""
    texts = [f'"{_quote(v)}"' for v in ((value,) if isinstance(value, str) else value)]
    text = texts[0] if isinstance(value, str) else f"[{', '.join(texts)}]"
    return f"{key} = {text}" + f"  # {remark}" * bool(remark)


# --- time ----------------------------------------------------------------------------------------------


def _has(roles: Sequence[Role], *names: str) -> bool:
    return any(r.name in names for r in roles)


def _draft_time(
    table: DataTable, roles: Roles, odd: Mapping[str, Sequence[str]], questions: list[str]
) -> tuple[list[str], tuple[str, ...]]:
    """The lines of [time], and the names of its columns."""
    if (instants := _find_instants(table, roles)) is not None:
        names, form, sure = instants
        asked = f'is {_show_cell(table.column(names[0]))} "d/m/y" or "m/d/y"?' if form == UNKNOWN else ""
        questions += [f"[time] format: {asked}"] * bool(asked)
        column = names if len(names) > 1 else names[0]
        return [_write("column", column, sure), _write("format", form, asked)], names
    numbers = [c for c in table.columns if not c.is_text]
    fits = [c for c in numbers if c.is_instant or _has(roles[c.name], "time", "second_of_week")]
    if not fits:  # an index without a name, unless it counts the rows
        fits = [c for c in numbers if c.name == table.index and np.any(c.values % 1 != 0)]
    if not fits:
        questions.append("[time] column: which column is time?")
        remark = 'no column has a usual name for time; or, of even samples, only: rate = "16 Hz"'
        return [_write("column", UNKNOWN, remark), _write("unit", UNKNOWN)], ()
    c = min(fits, key=lambda c: (c.name != "time", np.mean(np.diff(c.values) > 0) < 0.5, not c.unit))
    unit, remark = _find_unit(replace(c, unit=c.unit.split(" since ")[0]), "time", questions, "[time]")
    column = _write("column", c.name, "certain" if c.name == "time" else "likely")
    return [column, _write("unit", unit, remark), *odd.get(c.name, ())], (c.name,)


def _find_instants(table: DataTable, roles: Roles) -> Instants | None:
    """Columns that hold instants as such, their format (``?``: one of two), and how sure that is."""
    if any(c.name == "time" and not c.is_text and c.unit and not are_packed(c.values) for c in table.columns):
        return None
    by_role = {r: c for c in reversed(table.columns) for r in _TIMES[2:] if _has(roles[c.name], r)}
    week, second, date, clock = map(by_role.get, _TIMES[2:])
    if week is not None and second is not None:
        return (week.name, second.name), "gps", "likely: GPS week and seconds"
    texts = sorted((c for c in table.columns if c.is_text), key=lambda c: not _has(roles[c.name], "time"))
    parts = [(c, find_parts(_find_first_cell(c))) for c in texts]
    parts += [(c, (True, True)) for c in table.columns if not c.is_text and are_packed(c.values)]
    whole = [((c.name,), _find_form(c), "certain: a date and a time") for c, both in parts if all(both)]
    of_day = "certain: a time of the day, or an elapsed time"
    clocks = [((c.name,), "clock", of_day) for c, (_, timed) in parts if timed]
    if date is None or clock is None or date is clock:
        return next(iter(whole + clocks), None)
    form = _find_form(date).replace("iso", "date clock")
    pair = (date.name, clock.name), form, "likely: a date and a time of the day"
    dates_differ = len(np.unique(date.values)) == len(table)  # they have times of their own
    return whole[0] if whole and dates_differ else pair


def _find_form(c: DataColumn) -> str:
    """The format of dates: ``iso``, ``d/m/y``, ``m/d/y``, or ``?`` where both are possible."""
    if not c.is_text:
        return "iso"
    return {"ymd": "iso", "dmy": "d/m/y", "mdy": "m/d/y"}.get(find_order(c.values) or "", UNKNOWN)


def _find_first_cell(c: DataColumn) -> str:
    """The first cell of a column that is not empty, as text."""
    return next((str(v) for v in c.values if str(v)), "")


def _show_cell(c: DataColumn) -> str:
    return _quote(repr(_find_first_cell(c)[:40])) if c.is_text else "dates"


# --- channels ------------------------------------------------------------------------------------------


def _take_roles(columns: Sequence[DataColumn], roles: Roles) -> dict[str, tuple[DataColumn, Role]]:
    """Channel -> its column: the surest name wins, then the order of the file."""
    numbers = [c for c in columns if c.is_number]
    candidates = [(c, r) for c in numbers for r in roles[c.name][:1] if not _has(roles[c.name], *_TIMES)]
    channels: dict[str, tuple[DataColumn, Role]] = {}
    for c, role in sorted(candidates, key=lambda x: x[1].rank):
        channels.setdefault(role.name, (c, role))
    channels |= _take_by_unit([c for c in numbers if not roles[c.name]], channels)
    return {n: channels[n] for n in dict.fromkeys([*SI_UNITS, *channels]) if n in channels}


def _take_by_unit(
    columns: Sequence[DataColumn], channels: Mapping[str, Any]
) -> dict[str, tuple[DataColumn, Role]]:
    """Channels without a usual name, in any language: the only columns with such a unit, whose names end with an axis."""
    additions: dict[str, tuple[DataColumn, Role]] = {}
    for names in (SPECIFIC_FORCE, ANGULAR_RATE, ("G_out",), ("pressure",)):
        alike = [c for c in columns if c.unit and units(9.8).fits(c.unit, SI_UNITS[names[0]])]
        why, beside = "the only column with such a unit", OUTPUTS if names == ("G_out",) else names
        if len(names) == 3:
            by_stem: dict[str, list[DataColumn]] = {}
            for c in sorted(alike, key=lambda c: c.name[-1].lower()):
                by_stem.setdefault(c.name[:-1], []).append(c)
            triads = [t for t in by_stem.values() if "".join(c.name[-1] for c in t).lower() == "xyz"]
            alike, why = triads[0] if len(triads) == 1 else [], "by its unit and axis"
        if len(alike) == len(names) and not any(n.startswith(beside) for n in channels):
            additions |= {n: (c, Role(n, "guess", why=why)) for n, c in zip(names, alike, strict=True)}
    return additions


def _draft_channel(
    name: str, c: DataColumn, role: Role, odd: Mapping[str, Sequence[str]], questions: list[str]
) -> str:
    """The line of a channel, with how sure it is."""
    unit, remark = _find_unit(c, name, questions, f"[columns] {name}")
    further = [f"scale = {role.scale:g}"] if role.scale != 1.0 else []
    comment = role.sure + (f": {role.why}" if role.why else "") + (f"; {remark}" if remark else "")
    return f"{_make_key(name)} = {_write_entry(c.name, unit, *further, *odd.get(c.name, ()))}  # {comment}"


def _find_unit(c: DataColumn, name: str, questions: list[str], where: str) -> tuple[str, str]:
    """The unit to write and a remark; a question where the file gives none or one that cannot be."""
    stem = re.sub(r"_[^_]+$", "", name)
    si = SI_UNITS.get(name) or (SI_UNITS.get(stem) if stem in DEMODULATED else None)
    unit = units(9.8).find_meant(c.unit, si) if c.unit and si else c.unit
    if unit and is_unit(unit):
        return unit, ""
    named = _take_unit(_fold(c.name))[1]
    if not c.unit and named and si is not None and units(9.8).fits(named, si):
        return named, "likely: from its name"
    reason = f"the file has {c.unit!r}, a wrong unit for it" if c.unit else "the file gives none"
    questions.append(f"{where}: unit of {c.name!r} ({reason})")
    return UNKNOWN, _quote(reason)


def _write_entry(column: str, unit: str, *further: str) -> str:
    return f"{{ {', '.join([_write('column', column), _write('unit', unit), *further])} }}"


def _make_key(name: str) -> str:
    """A channel's name: the column's own, or one made of its letters."""
    return name if is_column(name) else ("c_" + re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_"))[:LONGEST]


def _quote(text: str) -> str:
    """Text inside a TOML string or comment: no quotes, no lines, nothing that cannot be printed."""
    text = text.replace("\\", "\\\\").replace('"', '\\"')
    return "".join(c if c.isprintable() else f"\\u{min(ord(c), 0xFFFF):04x}" for c in text)


# --- what a name says ----------------------------------------------------------------------------------


def _find_roles(columns: Sequence[str]) -> Roles:
    """What columns may be by their names without units: column -> its roles, the surest first."""
    by_column = {c: _read_name(c) for c in columns}
    directions = {(r.name, r.direction) for roles in by_column.values() for r in roles if r.direction}
    axes: dict[tuple[str, str], tuple[str, str]] = {}
    for stem, frame in product(("a", "omega", "omegadot", "B"), reversed(_FRAMES)):
        four = frame == ["1", "2", "3"] and (stem, "4") in directions  # the disc's own accelerometers
        if all((stem, d) in directions for d in frame) and not four:
            axes |= {(stem, d): (x, ", ".join(frame)) for d, x in zip(frame, "xyz", strict=True)}
    return {c: tuple(sorted(_turn(roles, axes), key=lambda r: r.rank)) for c, roles in by_column.items()}


def _turn(roles: Iterable[Role], axes: dict[tuple[str, str], tuple[str, str]]) -> Iterable[Role]:
    """Roles with directions as those of axes, as far as the table has all three."""
    for r in roles:
        if not r.direction:
            yield r
        elif r.direction in "xyz":
            yield replace(r, name=f"{r.name}_{r.direction}", direction="")
        elif (r.name, r.direction) in axes:
            axis, three = axes[r.name, r.direction]
            yield replace(r, name=f"{r.name}_{axis}", sure="guess", why=f"{three} as x, y, z?")


def _read_name(column: str) -> list[Role]:
    """The roles of a column by itself; its own name is certain."""
    if column in SI_UNITS or any(r.name == column != "line" for r, _ in _SCALARS):
        return [Role(column, "certain"), *_read_scalars(column)]
    scale = -1.0 if column.lstrip().startswith("-") else 1.0
    parts = re.split(r"[/.]", column.replace("'", ""))
    inner = ["_".join(parts[k:]) for k in range(len(parts))]
    roles: list[Role] = []
    for text in (*inner, re.sub(r"\(.*\)", "", column)):  # perhaps without a remark in brackets
        roles += _read_scalars(text) or [replace(r, scale=scale) for r in _read_vectors(text)]
    return roles


def _read_scalars(name: str) -> list[Role]:
    folded = _fold(name)
    plain, _ = _take_unit(folded)
    bare = "_".join(w for w in plain.split("_") if w in ("out", "ggi") or not _NEUTRAL.fullmatch(w))
    texts = (folded, plain, bare)
    return [r for r, pattern in _SCALARS if any(re.fullmatch(pattern, t, re.IGNORECASE) for t in texts)]


def _read_vectors(name: str) -> list[Role]:
    """The component that a name says: ``AccX``, ``gyro_fwd_dps``, ``X-Acceleration``."""
    text, _ = _take_unit(_fold(name))
    if (m := re.fullmatch(r"([pqr])(?:_(?:body|b))?", text)) is not None:
        return [Role("omega", "guess", direction=m[1])]
    for stem, words, sure in ((v["name"], v["pattern"], v.get("sure", "likely")) for v in _NAMES["vectors"]):
        glued = rf"(?:({_LONG})_?|({_DIRECTION})_)?({words})(?:_?({_LONG})|_({_DIRECTION}))?"
        for m in re.finditer(rf"(?:^|(?<=_)){glued}(?=_|$)", text):
            if len(m[3]) == 1 and m.start() > 0 and not (m[1] or m[4]):
                continue  # a letter in the middle
            rest = [w for w in f"{text[: m.start()]}_{text[m.end() :]}".split("_") if w]
            rest = [w for w in rest if not re.fullmatch(words, w) and not _NEUTRAL.fullmatch(w)]
            directions = [d for d in m.group(1, 2, 4, 5) if d]
            directions += [w for w in rest if re.fullmatch(_LONG, w) or w in ("xv", "yv", "zv")]
            rest = [w for w in rest if w not in directions]
            if len(directions) != 1 or any(map(_NO_READING.fullmatch, rest)):
                continue
            direction = _SHORT.get(directions[0], directions[0].replace("_", ""))
            return [Role(stem, "guess" if rest else sure, direction=direction)]
    return []


def _fold(name: str) -> str:
    """The words of a name in small letters, divided by ``_``."""
    words = re.sub(r"(?<=[a-z]{2})(?=[A-Z])|(?<=[A-Z]{2})(?=[A-Z][a-z])", "_", name)
    return re.sub(r"[\W_]+", "_", words).strip("_").lower()


def _take_unit(folded: str) -> tuple[str, str]:
    """The words without the unit among them, and the unit."""
    for unit, pattern in _NAMES["units"].items():
        if (m := re.search(rf"(?<=[a-z0-9])_(?:{pattern})(?=_|$)", folded)) is not None:
            return (folded[: m.start()] + folded[m.end() :]), unit
    return folded, {"millis": "ms", "micros": "us"}.get(folded, "")
