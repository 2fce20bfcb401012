"""Columns of a foreign file: a mapping for the user to complete, tried on the first rows, and kept with the model."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeGuard

import numpy as np

from ragg_runtime.api import Loaded, keep_mapping, mapping_of
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import read_text
from ragg_runtime.io.draft import draft_mapping, sample_table
from ragg_runtime.io.mapping import Mapped, parse_mapping
from ragg_runtime.io.record import ANGULAR_RATE, SI_UNITS, SPECIFIC_FORCE
from ragg_runtime.io.tables import DataColumn
from ragg_runtime.wording import numbers
from ragg_runtime.wording.sections import Section, Table, render_html

Json = dict[str, Any]

NEEDED = (*SPECIFIC_FORCE, *ANGULAR_RATE)  # channels that every flight has
UNWRITTEN = Path("mapping.toml")  # path of a mapping that is not saved yet, for messages


def draft(m: Loaded, path: Path) -> Json:
    """The model's own mapping if the file has its columns, else that of ``ragg map`` with its questions; and the file's columns."""
    columns, kept = sample_table(path).columns, mapping_of(m, None)
    names = [f"{c.name} [{c.unit}]" if c.unit else c.name for c in columns]
    if _describes(kept, columns):
        return {"text": read_text(kept.path), "questions": [], "columns": names, "kept": True}
    first = draft_mapping(path)
    questions = [*first.questions, *first.notes]
    return {"text": first.text, "questions": questions, "columns": names, "kept": kept is not None}


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


def try_mapping(m: Loaded, path: Path, text: str) -> Json:
    """What is still wrong with a mapping, and what its channels look like on the first rows."""
    try:
        mapping = parse_mapping(text, UNWRITTEN)
        missing, preview = [n for n in NEEDED if n not in mapping.channels], _preview(m, path, mapping)
        need = UserError("every flight has these channels: add their columns", where=", ".join(missing))
        return {"error": need.facts if missing else None, "preview": render_html([Section(table=preview)])}
    except UserError as e:
        return {"error": e.facts, "preview": ""}


def _preview(m: Loaded, path: Path, mapping: Mapped) -> Table:
    columns = {c.name: c for c in sample_table(path).columns}
    rows = []
    for name, e in mapping.channels.items():
        if e.column not in columns or not columns[e.column].is_number:
            raise UserError("the file has no such column of numbers", where=name, found=e.column)
        unit = e.unit or columns[e.column].unit
        si = SI_UNITS.get(name, unit)
        x = columns[e.column].values * e.factor + e.offset
        x = m.instrument.units.to_si(x, unit, si, f"[columns] {name}") if unit != si else x
        finite = x[np.isfinite(x)]
        ends = [float(f(finite)) for f in (np.min, np.median, np.max)] if len(finite) else [np.nan] * 3
        rows.append((name, numbers.unit(si), *(numbers.number(v, 4) for v in ends)))
    return Table(("channel", "unit", "minimum", "median", "maximum"), tuple(rows), words=2)


def keep(m: Loaded, path: Path, text: str, *, replace: bool) -> None:
    """Lay the mapping down in the model directory, where every command finds it; never over another unasked."""
    _preview(m, path, parse_mapping(text, UNWRITTEN))
    keep_mapping(m, text, replace=replace)
