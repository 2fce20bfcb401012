"""What the columns of a foreign file are: a first mapping to be answered, what comes of it, and keeping it with the model."""

from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.api import Loaded, keep_mapping, mapping_of
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import read_text
from ragg_runtime.io.draft import OUTPUTS, draft_mapping, sample_table
from ragg_runtime.io.mapping import UNKNOWN, Mapped, parse_mapping
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE
from ragg_runtime.io.tables import DataColumn
from ragg_runtime.wording import numbers

Json = dict[str, Any]

NEEDED = (*SPECIFIC_FORCE, *ANGULAR_RATE)
"""Channels that every flight has."""

POINTS = 160
"""Samples of a column that are drawn."""

UNWRITTEN = Path("mapping.toml")
"""Path of a mapping that is not saved yet, for messages."""


def draft(m: Loaded, path: Path) -> Json:
    """The model's own mapping if the file has its columns, else a first one by looking; and what the file holds."""
    columns = sample_table(path).columns
    names = {c.name for c in columns}
    own = mapping_of(m, None)
    if own is not None and own.columns <= names:
        return _show(tomllib.loads(read_text(own.path)), columns, {}, kept=True)
    made = draft_mapping(path)
    return _show(tomllib.loads(made.text), columns, made.sure, kept=own is not None)


def _show(data: Json, held: Sequence[DataColumn], sure: Mapping[str, str], *, kept: bool) -> Json:
    rows = []
    columns = data.get("columns", {})
    missing = [n for n in NEEDED if n not in columns]
    if not any(n.startswith(OUTPUTS) for n in columns):
        missing.append("G_out")
    for name in (*columns, *missing):
        raw = columns.get(name, {"column": UNKNOWN, "unit": UNKNOWN})
        entry = {"column": raw} if isinstance(raw, str) else raw
        how = "missing" if name in missing else sure.get(name, "certain")
        asks = how in ("missing", "guess") or UNKNOWN in (entry["column"], entry.get("unit"))
        rows.append({"channel": name, "unit": "", "sign": 1, "scale": 1, **entry, "sure": how, "asked": asks})
    time = {"format": "seconds", "unit": "s", **data.get("time", {"column": UNKNOWN})}
    return {
        "columns": [{"name": c.name, "unit": c.unit, "text": not c.is_number} for c in held],
        "rows": rows,
        "time": {k: str(v) if k == "origin" else v for k, v in time.items()},
        "file": data.get("file", {}),
        "axes": {a: data.get("axes", {}).get(a, a) for a in "xyz"},
        "kept": kept,
    }


def write(given: Mapping[str, Any]) -> str:
    """``mapping.toml`` from the page's entries; rows without a column are left out."""

    def table(values: Mapping[str, Any], names: tuple[str, ...]) -> list[str]:
        return [f"{k} = {_toml(values[k])}" for k in names if values.get(k) not in (None, "", [])]

    time = given.get("time", {})
    lines = ["[time]", *table(time, ("column", "format"))]
    if time.get("format", "seconds") == "seconds":
        lines += [f"unit = {_toml(time.get('unit', 's'))}"]
        lines += [f"origin = {time['origin']}"] if _instant(time.get("origin")) else []
    if given.get("file"):
        lines += ["", "[file]", *table(given["file"], ("line", "lines", "part"))]
    lines += ["", "[columns]"]
    for row in given.get("rows", []):
        if row.get("column") and row["column"] != UNKNOWN:
            parts = [f"{k} = {_toml(row[k])}" for k in ("column", "unit") if row.get(k)]
            parts += [f"{k} = {_toml(row[k])}" for k in ("sign", "scale") if row.get(k, 1) != 1]
            parts += [f"offset = {_toml(row['offset'])}"] if row.get("offset") else []
            lines.append(f"{json.dumps(row['channel'])} = {{ {', '.join(parts)} }}")
    axes = given.get("axes", {})
    if any(axes.get(a, a) != a for a in "xyz"):
        lines += ["", "[axes]", *(f"{a} = {_toml(axes.get(a, a))}" for a in "xyz")]
    return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    """Texts, numbers and lists of them are written alike in JSON and TOML."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        raise UserError("a number is needed", where="the mapping")
    return json.dumps(value, ensure_ascii=False)


def _instant(value: Any) -> bool:
    return isinstance(value, str) and bool(value) and all(c in "0123456789-:.TZ+ " for c in value)


def try_mapping(m: Loaded, path: Path, given: Mapping[str, Any]) -> Json:
    """The mapping as text, what is still wrong with it, and what its channels look like on the first rows."""
    text = ""
    try:
        text = write(given)
        how = parse_mapping(text, UNWRITTEN)
        return {"text": text, "error": None, "preview": _preview(m, path, how)}
    except UserError as e:
        return {"text": text, "error": e.facts, "preview": []}


def _preview(m: Loaded, path: Path, how: Mapped) -> list[Json]:
    columns = {c.name: c for c in sample_table(path).columns}
    found = []
    for name, e in how.channels.items():
        if e.column not in columns:
            raise UserError("the file has no such column", where=name, found=e.column)
        if not columns[e.column].is_number:
            raise UserError("the column holds no numbers", where=name, found=e.column)
        unit = e.unit or columns[e.column].unit
        si = SI_UNITS.get(name, unit)
        x = columns[e.column].values * e.factor + e.offset
        x = m.instrument.units.to_si(x, unit, si, f"[columns] {name}") if unit != si else x
        seen = x[np.isfinite(x)]
        step = max(1, len(x) // POINTS)
        middle = numbers.number(float(np.median(seen)), 4) if len(seen) else numbers.ABSENT
        ends = [numbers.number(float(v), 3) for v in (seen.min(), seen.max())] if len(seen) else []
        row = {"channel": name, "unit": numbers.unit(si), "median": middle, "ends": ends}
        found.append(row | {"points": x[::step][:POINTS].tolist()})
    return found


def keep(m: Loaded, path: Path, given: Mapping[str, Any], *, replace: bool) -> None:
    """Lay the mapping down in the model directory, where every command finds it; never over another unasked."""
    text = write(given)
    _preview(m, path, parse_mapping(text, UNWRITTEN))
    keep_mapping(m, text, replace=replace)
