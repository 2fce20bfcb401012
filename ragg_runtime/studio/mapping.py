"""Columns of a foreign file: drafting a mapping for the user to complete, trying it, and keeping it with the model."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, TypeGuard

import numpy as np
import tomlkit
from tomlkit.exceptions import TOMLKitError

from ragg_runtime.api import Loaded, keep_mapping, mapping_of
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import read_text
from ragg_runtime.io.draft import OUTPUTS, draft_mapping, sample_table
from ragg_runtime.io.mapping import UNKNOWN, Mapped, parse_mapping
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE
from ragg_runtime.io.tables import DataColumn
from ragg_runtime.wording import numbers

Json = dict[str, Any]

NEEDED = (*SPECIFIC_FORCE, *ANGULAR_RATE)  # channels that every flight has
POINTS = 160  # samples of a column that are drawn
UNWRITTEN = Path("mapping.toml")  # path of a mapping that is not saved yet, for messages


def draft(m: Loaded, path: Path) -> Json:
    """The model's own mapping if the file has its columns, else a first one by looking; and what the file holds."""
    columns, kept_mapping = sample_table(path).columns, mapping_of(m, None)
    if _describes(kept_mapping, columns):
        return _show(tomllib.loads(read_text(kept_mapping.path)), columns, {}, kept=True)
    first = draft_mapping(path)
    return _show(tomllib.loads(first.text), columns, first.sure, kept=kept_mapping is not None)


def _describes(mapping: Mapped | None, columns: Sequence[DataColumn]) -> TypeGuard[Mapped]:
    return mapping is not None and mapping.columns <= {c.name for c in columns}


def is_foreign(m: Loaded, path: Path) -> bool:
    """Whether the columns of a file that cannot be read must be described: they have other names, or no units.

    Not those that the model's own mapping describes: then something else is wrong.
    """
    try:
        if _describes(mapping_of(m, None), sample_table(path).columns):
            return False
        mapping = draft_mapping(path)
    except (UserError, OSError):
        return False
    ratings = [mapping.sure.get(n) for n in NEEDED]
    return bool(mapping.questions) or not any(ratings) or any(sure in ("likely", "guess") for sure in ratings)


def _show(data: Json, file_columns: Sequence[DataColumn], sure: Mapping[str, str], *, kept: bool) -> Json:
    rows = []
    columns = data.get("columns", {})
    missing = [n for n in NEEDED if n not in columns]
    if not any(n.startswith(OUTPUTS) for n in columns):
        missing.append("G_out")
    for name in (*columns, *missing):
        raw = columns.get(name, {"column": UNKNOWN, "unit": UNKNOWN})
        entry = {"column": raw} if isinstance(raw, str) else raw
        rating = "missing" if name in missing else sure.get(name, "certain")
        asks = rating in ("missing", "guess") or UNKNOWN in (entry["column"], entry.get("unit"))
        row = {"channel": name, "unit": "", "sign": 1, "scale": 1}
        rows.append({**row, **entry, "sure": rating, "asked": asks})
    time = {"format": "seconds", "unit": "s", **data.get("time", {"column": UNKNOWN})}
    return {
        "columns": [{"name": c.name, "unit": c.unit, "text": not c.is_number} for c in file_columns],
        "rows": rows,
        "time": {k: str(v) if k == "origin" else v for k, v in time.items()},
        "file": data.get("file", {}),
        "axes": {a: data.get("axes", {}).get(a, a) for a in "xyz"},
        "kept": kept,
    }


def write(entries: Mapping[str, Any]) -> str:
    """``mapping.toml`` from the page's entries; rows without a column are left out."""

    def table(values: Mapping[str, Any], *names: str) -> dict[str, Any]:
        return {k: values[k] for k in names if values.get(k) not in (None, "", [])}

    time, columns = entries.get("time", {}), tomlkit.table()
    seconds = time.get("format", "seconds") == "seconds"
    unit = table({"unit": "s", **time}, "unit") if seconds and not time.get("rate") else {}
    for row in entries.get("rows", []):
        if row.get("column") and row["column"] != UNKNOWN:
            entry = {k: v for k, v in row.items() if v != {"sign": 1, "scale": 1, "offset": 0}.get(k)}
            columns[row["channel"]] = tomlkit.inline_table()
            columns[row["channel"]].update(table(entry, "column", "unit", "sign", "scale", "offset"))
    document: dict[str, Any] = {"time": table(time, "column", "format", "rate") | unit}
    if seconds and (origin := _read_instant(time.get("origin"))):
        document["time"]["origin"] = origin
    document |= {"file": table(entries.get("file", {}), "line", "lines", "part"), "columns": columns}
    axes = {a: entries.get("axes", {}).get(a, a) for a in "xyz"}
    document |= {"axes": axes} if any(v != a for a, v in axes.items()) else {}
    try:
        return tomlkit.dumps({k: v for k, v in document.items() if v or k == "columns"})
    except (TypeError, ValueError, TOMLKitError):
        raise UserError("a text or a number is needed", where="the mapping") from None


def _read_instant(value: Any) -> datetime | None:
    try:
        return datetime.fromisoformat(value)
    except (TypeError, ValueError):
        return None


def try_mapping(m: Loaded, path: Path, entries: Mapping[str, Any]) -> Json:
    """The mapping as text, what is still wrong with it, and what its channels look like on the first rows."""
    text = ""
    try:
        text = write(entries)
        mapping = parse_mapping(text, UNWRITTEN)
        preview, missing = _preview(m, path, mapping), [n for n in NEEDED if n not in mapping.channels]
        need = UserError("every flight has these channels: choose their columns", where=", ".join(missing))
        return {"text": text, "error": need.facts if missing else None, "preview": preview}
    except UserError as e:
        return {"text": text, "error": e.facts, "preview": []}


def _preview(m: Loaded, path: Path, mapping: Mapped) -> list[Json]:
    columns = {c.name: c for c in sample_table(path).columns}
    rows = []
    for name, e in mapping.channels.items():
        if e.column not in columns:
            raise UserError("the file has no such column", where=name, found=e.column)
        if not columns[e.column].is_number:
            raise UserError("the column holds no numbers", where=name, found=e.column)
        unit = e.unit or columns[e.column].unit
        si = SI_UNITS.get(name, unit)
        x = columns[e.column].values * e.factor + e.offset
        x = m.instrument.units.to_si(x, unit, si, f"[columns] {name}") if unit != si else x
        finite = x[np.isfinite(x)]
        step = max(1, len(x) // POINTS)
        middle = numbers.number(float(np.median(finite)), 4) if len(finite) else numbers.ABSENT
        ends = [numbers.number(float(v), 3) for v in (finite.min(), finite.max())] if len(finite) else []
        row = {"channel": name, "unit": numbers.unit(si), "median": middle, "ends": ends}
        rows.append(row | {"points": [v if np.isfinite(v) else None for v in x[::step][:POINTS].tolist()]})
    return rows


def keep(m: Loaded, path: Path, entries: Mapping[str, Any], *, replace: bool) -> None:
    """Lay the mapping down in the model directory, where every command finds it; never over another unasked."""
    text = write(entries)
    _preview(m, path, parse_mapping(text, UNWRITTEN))
    keep_mapping(m, text, replace=replace)
