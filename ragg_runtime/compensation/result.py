"""What ``ragg compensate`` finds: the gradient as columns of every flight, their file, and how good they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation.segment import MEANING
from ragg_runtime.io import Flight
from ragg_runtime.io.files import write_tables
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.io.tables import DataColumn, DataTable
from ragg_runtime.wording import describe_other
from ragg_runtime.wording.sections import render_notebook


def without_gradients(flight: Flight) -> Flight:
    """A flight without recorded gradients, which must not enter what is compensated."""
    channels = {n: x for n, x in flight.channels.items() if n not in GRADIENT}
    return replace(flight, channels=channels) if len(channels) < len(flight.channels) else flight


@dataclass(frozen=True)
class Compensation:
    """The result of ``compensate``; ``series`` are the columns (name -> (N,)) of every flight."""

    name: str
    result: Mapping[str, Any]
    series: tuple[Mapping[str, NDArray[Any]], ...]

    @staticmethod
    def of(
        name: str, result: Mapping[str, Any], series: Sequence[Mapping[str, NDArray[Any]]]
    ) -> Compensation:
        """The result for JSON, with what the bits of ``quality`` mean."""
        meaning = {str(int(q)): f"{q.name}: {text}" for q, text in MEANING.items()}
        return Compensation(name, {**result, "quality": meaning}, tuple(series))

    def __repr__(self) -> str:
        flights = ", ".join(x["flight"] for x in self.result["flights"])
        return f"<compensation of {flights} by {self.name}, {self.result['calibration']}>"

    def _repr_html_(self) -> str | None:
        online = self.result["calibration"] == "online"
        return None if online else render_notebook(describe_other.describe_compensation(self.as_json(), ""))

    @property
    def units(self) -> dict[str, str]:
        """Columns and their units, in order."""
        return {n: _unit_of(n) for n in self.series[0]}

    def as_json(self) -> dict[str, Any]:
        """As ``ragg compensate --json`` writes it."""
        return dict(self.result)

    def write(self, path: Path | str) -> None:
        """The series of all flights, one after the other, into a file of the format that its ending names.

        Each begins and ends where there are values, which have the digits that their uncertainty warrants, and one more.
        """
        parts = [_with_values(s) for s in self.series]
        whole = {n: np.concatenate([s[n] for s in parts]) for n in self.units}
        columns = [DataColumn(n, unit, _round(n, whole)) for n, unit in self.units.items()]
        write_tables(Path(path), [DataTable(tuple(columns))])


def _unit_of(column: str) -> str:
    if column == "time":
        return "s"
    return "1" if column == "flight" or column.startswith(("quality", "closure")) else "Eo"


def _with_values(series: Mapping[str, NDArray[Any]]) -> Mapping[str, NDArray[Any]]:
    """The rows from the first to the last in which a channel has a value; all if none has."""
    stds = [x for n, x in series.items() if n.endswith("_std")]
    there = np.flatnonzero(np.any(np.isfinite(stds), axis=0))
    if not len(there):
        return series
    return {n: x[there[0] : there[-1] + 1] for n, x in series.items()}


def _round(name: str, columns: Mapping[str, NDArray[Any]]) -> NDArray[Any]:
    """A column to the second digit of the least of its standard deviations."""
    x = columns[name]
    if name.startswith("closure"):
        return np.round(x, 2)
    std = columns.get(name if name.endswith("_std") else f"{name}_std", np.zeros(0))
    known = std[np.isfinite(std) & (std > 0.0)]
    if not len(known):
        return x
    digits = 1 - int(np.floor(np.log10(np.min(known))))
    return np.round(x, digits + name.endswith("_std"))
