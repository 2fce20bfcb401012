"""Quality control of flights as lines of a survey: of their files, or of what compensation made of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import scratch
from ragg_runtime.compensation.output import writing
from ragg_runtime.flight import Flight
from ragg_runtime.survey.quality.qc import Quality, qc
from ragg_runtime.workflow.after import Compensation
from ragg_runtime.workflow.loaded import Loaded, mapping_of

BESIDE = (
    "easting",
    "northing",
    "latitude",
    "longitude",
    "altitude",
    "temperature",
    "a_z",
    "vertical_velocity",
)
"""Channels of a flight that quality control looks at beside the gradients."""


def quality(m: Loaded, paths: Sequence[Path], flights: Sequence[Flight], c: Compensation | None) -> Quality:
    """As ``ragg qc`` of the files, if they hold demodulated channels; else of what compensation made of them."""
    if paths and all("inline" in x.outputs for x in flights):
        return qc(list(dict.fromkeys(paths)), mapping_of(m, None))
    if c is None:
        raise UserError(
            "these flights hold no demodulated channels yet",
            expected="inline and cross",
            remedy="compensate them first",
        )
    with scratch() as folder:
        pairs = zip(flights, c.series, strict=True)
        return qc([_line(Path(folder, str(k)), x, rows, c) for k, (x, rows) in enumerate(pairs)])


def _line(folder: Path, x: Flight, rows: Mapping[str, NDArray[Any]], c: Compensation) -> Path:
    """A compensated flight as a line of a survey: its gradients, and what was recorded beside them."""
    known = [n for n in c.units if n == "time" or (c.units[n] == "Eo" and f"{n}_std" in c.units)]
    beside = {n: x.channels[n] for n in BESIDE if n in x.channels}
    units = {n: c.units[n] for n in known} | {n: x.units[n] for n in beside}
    name = "".join(k if k.isalnum() or k in "-_ ." else "_" for k in x.name)[:80].lstrip(".") or "flight"
    folder.mkdir()
    path = folder / f"{name}.parquet"
    with writing(path, len(rows["time"]), units) as write:
        write({n: rows[n] for n in known} | beside)
    return path
