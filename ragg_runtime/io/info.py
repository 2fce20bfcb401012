"""What a flight file holds, before any model: columns, units, rate, gaps, ranges, and what was assumed (``ragg info``)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import file_digest
from ragg_runtime.instrument.units import units
from ragg_runtime.io.assemble import make_flight
from ragg_runtime.io.files import find_format, flight_name, read_recordings, write_instant
from ragg_runtime.io.mapping import Mapped
from ragg_runtime.io.record import is_disc_angle
from ragg_runtime.io.sampling import make_grid
from ragg_runtime.io.tables import DataColumn, DataTable

PAPER_G = 9.8
"""m/s^2: the g of units such as mg where no model says its own."""

MOST_GAPS = 20
"""Gaps that are listed, the longest ones."""

Json = dict[str, Any]


def describe_flight(path: Path | str, mapping: Mapped | None = None) -> Json:
    """What a flight file holds.

    Parameters
    ----------
    path
        The file.
    mapping
        What its columns are, where it has names of its own.

    Returns
    -------
    dict
        ``path``, ``sha256``, ``format``, ``bytes``, and ``records``, one for each line. Of a record: ``name``, ``line`` (``None``: the
        file has only one record), ``rows``; ``start_s``, ``duration_s``, ``rate_Hz`` (``None`` where there is no uniform time), ``origin``
        (the instant at which time is 0, ISO 8601, or ``None``); ``gap_count``, ``missing`` samples in all gaps, ``gaps`` (the longest:
        from_s, to_s, samples); ``columns`` (name, unit in the file, samples with and without a value, minimum, maximum and mean in that
        unit); ``notes``: what was assumed, left out or looks odd; ``refused``: why the record cannot be used as it is, or ``None``.

    Raises
    ------
    UserError
        If the file cannot be read, or holds no table.
    """
    path = Path(path)
    made = read_recordings(path, mapping)
    return {
        "path": str(path),
        "sha256": file_digest(path),
        "format": find_format(path).name,
        "bytes": path.stat().st_size,
        "records": [_describe_record(r, flight_name(path), len(made) > 1) for r in made],
    }


def _describe_record(r: DataTable, name: str, several: bool) -> Json:
    notes, refused, grid = list(r.notes), None, None
    try:
        x = make_flight(r, PAPER_G)
        notes = [*x.notes]
        if not any(map(is_disc_angle, x.channels)):
            zero = "the first sample, since time is given as instants" if x.instants else "t = 0 of time"
            notes.append(
                f"no spin_angle: the disc angle counts from {zero} (angle_origin in model.toml overrides this)"
            )
    except UserError as error:
        refused = error.message
    try:
        time = r.column("time")
        grid = make_grid(units(PAPER_G).to_si(time.values, time.unit or "s", "s", "column 'time'"), r.place)
    except (KeyError, UserError):
        pass  # reported in ``refused``
    gaps = [] if grid is None else grid.gaps
    longest = sorted(sorted(gaps, key=lambda g: -g[2])[:MOST_GAPS])
    return {
        "name": f"{name}:{r.line}" if several else name,
        "line": r.line if several else None,
        "rows": len(r),
        "start_s": None if grid is None else float(grid.time[0]),
        "duration_s": None if grid is None else len(grid.time) * grid.step,
        "rate_Hz": None if grid is None else 1 / grid.step,
        "origin": None if r.origin is None else write_instant(r.origin),
        "gap_count": len(gaps),
        "missing": sum(g[2] for g in gaps),
        "gaps": [dict(zip(("from_s", "to_s", "samples"), g, strict=True)) for g in longest],
        "columns": list(map(_describe_column, r.columns)),
        "notes": notes,
        "refused": refused,
    }


def _describe_column(c: DataColumn) -> Json:
    there = c.values[np.isfinite(c.values)]
    ranges = [float(f(there)) if len(there) else None for f in (np.min, np.max, np.mean)]
    told = {"name": c.name, "unit": c.unit, "samples": len(there), "missing": len(c.values) - len(there)}
    return told | dict(zip(("minimum", "maximum", "mean"), ranges, strict=True))
