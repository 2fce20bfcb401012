"""The columns of what is compensated, and their file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.compensate import Compensated
from ragg_runtime.compensation.series import Series
from ragg_runtime.instrument.layout import column_endings
from ragg_runtime.io.files import write_tables
from ragg_runtime.io.record import DEMODULATED
from ragg_runtime.io.tables import Column
from ragg_runtime.io.tables import Table as FileTable
from ragg_runtime.signals.tensor import COMPONENTS, Tensor, tensor

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Table:
    """The columns of one flight, by its outputs that see a gradient.

    ``endings`` of every output (``inline_A`` of ``G_out_A``), empty of an only one. ``tensor`` (6 + checks, 2 outputs):
    its components and the closure, by the channels; ``None``: not determined. ``several``: then ``flight`` counts
    flights from 1.
    """

    endings: tuple[str, ...]
    tensor: Array | None
    several: bool

    @staticmethod
    def of(outputs: Sequence[Compensated], *, several: bool) -> Table:
        layout = outputs[0].instrument.layout
        known = dict(zip(layout.output_names, column_endings(layout.output_names), strict=True))
        endings = tuple(known[x.setting.observation.output.name] for x in outputs)
        return Table(endings=endings, tensor=_by_channels(outputs), several=several)

    @property
    def units(self) -> dict[str, str]:
        """Columns and their units, in order."""
        found = {"time": "s"}
        for end in self.endings:
            found |= {f"{c}{end}": "Eo" for c in DEMODULATED}
            found |= {f"{c}{end}_std": "Eo" for c in DEMODULATED}
            found[f"quality{end}"] = "1"
        if self.tensor is not None:
            found |= {f"Gamma_{c}": "Eo" for c in COMPONENTS} | {f"Gamma_{c}_std": "Eo" for c in COMPONENTS}
            found |= dict.fromkeys(self._checks, "1")
        return found | ({"flight": "1"} if self.several else {})

    @property
    def _checks(self) -> list[str]:
        count = 0 if self.tensor is None else len(self.tensor) - len(COMPONENTS)
        return ["closure"] if count == 1 else [f"closure_{k + 1}" for k in range(count)]

    def rows(self, time: Array, parts: Sequence[Series], number: int) -> dict[str, NDArray[np.generic]]:
        """The columns of one segment: ``time`` (n,) s, a series of each output, and the number of the flight."""
        found: dict[str, NDArray[np.generic]] = {"time": time}
        for end, x in zip(self.endings, parts, strict=True):
            found |= {f"inline{end}": x.gradient.real, f"cross{end}": x.gradient.imag}
            found |= {f"inline{end}_std": x.std[0], f"cross{end}_std": x.std[1], f"quality{end}": x.quality}
        if self.tensor is not None:
            seen = np.concatenate([[x.gradient.real, x.gradient.imag] for x in parts])
            std = np.concatenate([x.std for x in parts])
            values = self.tensor @ seen
            spread = np.sqrt(self.tensor[: len(COMPONENTS)] ** 2 @ std**2)
            for k, c in enumerate(COMPONENTS):
                found |= {f"Gamma_{c}": values[k], f"Gamma_{c}_std": spread[k]}
            found |= dict(zip(self._checks, values[len(COMPONENTS) :], strict=True))
        return found | {"flight": np.full(len(time), number, dtype=np.int64)}


def _by_channels(outputs: Sequence[Compensated]) -> Array | None:
    """The tensor and its closure by the channels; ``None`` where the outputs do not determine it."""
    layout = outputs[0].instrument.layout
    observed = [x.setting.observation for x in outputs]
    axes = [layout.discs[o.output.disc].across for o in observed]
    std = np.array([s for x in outputs for s in x.setting.noise])
    try:
        found: Tensor = tensor(axes, np.eye(2 * len(outputs)), std)
    except UserError:
        return None
    return np.concatenate([found.gamma, found.closure])


def joined(
    parts: Sequence[Mapping[str, NDArray[np.generic]]], names: Sequence[str]
) -> dict[str, NDArray[np.generic]]:
    """The columns of all segments."""
    return {n: np.concatenate([r[n] for r in parts]) for n in names}


def write_series(path: Path, series: Sequence[Mapping[str, NDArray[Any]]], units: Mapping[str, str]) -> None:
    """Write the series of all flights, one after the other, as CSV, Parquet or NetCDF; ``units`` names the columns.

    Each begins and ends where there are values, which have the digits that their uncertainty warrants, and one more.
    """
    whole = joined([_with_values(s) for s in series], list(units))
    rounded = {n: _rounded(n, x, whole) for n, x in whole.items()}
    write_tables(path, [FileTable(tuple(Column(n, unit, rounded[n]) for n, unit in units.items()))])


def _with_values(series: Mapping[str, NDArray[Any]]) -> Mapping[str, NDArray[Any]]:
    """The rows from the first to the last in which a channel has a value; all if none has."""
    stds = [x for n, x in series.items() if n.endswith("_std")]
    if not stds:
        return series
    there = np.flatnonzero(np.any(np.isfinite(stds), axis=0))
    if not len(there):
        return series
    return {n: x[there[0] : there[-1] + 1] for n, x in series.items()}


def _rounded(name: str, x: NDArray[Any], columns: Mapping[str, NDArray[Any]]) -> NDArray[Any]:
    """A column to the second digit of the least of its standard deviations."""
    std = columns.get(name if name.endswith("_std") else f"{name}_std")
    if name.startswith("closure"):
        return np.round(x, 2)
    known = np.zeros(0) if std is None else std[np.isfinite(std) & (std > 0.0)]
    if not len(known):
        return x
    digits = 1 - int(np.floor(np.log10(np.min(known))))
    return np.round(x, digits + name.endswith("_std"))
