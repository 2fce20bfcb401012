"""What ``ragg compensate`` finds: the gradient as columns of every flight, and how good they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import one_thread
from ragg_runtime.compensation import frozen
from ragg_runtime.compensation.compensate import Compensated, Kind, meaning, prepared
from ragg_runtime.compensation.output import Table, joined, write_series
from ragg_runtime.compensation.recursive import Tuning, followed, following
from ragg_runtime.compensation.saved import Saved
from ragg_runtime.compensation.series import MEANING
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.model import Model
from ragg_runtime.wording import describe_other
from ragg_runtime.wording.sections import render_notebook

QUALITY: Mapping[str, str] = MappingProxyType({str(q.name): text for q, text in MEANING.items()})
"""What the marks of samples mean, by the name under which a compensation counts them."""


@dataclass(frozen=True)
class Compensation:
    """The result of ``compensate``; ``series`` are the columns (name -> (N,)) of every flight, ``units`` theirs, in order."""

    name: str
    result: Mapping[str, Any]
    series: tuple[Mapping[str, NDArray[Any]], ...]
    units: Mapping[str, str]

    def __repr__(self) -> str:
        flights = ", ".join(x["flight"] for x in self.result["flights"])
        return f"<compensation of {flights} by {self.name}, {self.result['calibration']}>"

    def _repr_html_(self) -> str | None:
        online = self.result["calibration"] == "online"
        return None if online else render_notebook(describe_other.describe_compensation(self.as_json(), ""))

    def as_json(self) -> dict[str, Any]:
        """As ``ragg compensate --json`` writes it."""
        return dict(self.result)

    def write(self, path: Path | str) -> None:
        """The series of all flights, one after the other, into a file of the format that its ending names."""
        write_series(Path(path), self.series, self.units)


@dataclass(frozen=True)
class Compensator:
    """A model by its name, with which flights are compensated."""

    name: str
    model: Model
    instrument: Instrument

    def _found(
        self, result: dict[str, Any], series: Sequence[Mapping[str, NDArray[Any]]], units: Mapping[str, str]
    ) -> Compensation:
        told = result | {"quality": meaning()}
        return Compensation(self.name, told, tuple(series), MappingProxyType(dict(units)))

    @one_thread
    def compensate(
        self, flights: Sequence[Flight], kind: Kind, demodulator: str, saved: Saved | None
    ) -> Compensation:
        """By a calibration on the flights themselves, or by the ``saved`` one, which only ``frozen`` takes."""
        p = prepared(self.model, self.instrument, flights, kind, saved)
        each = [[Compensated(p, n, demodulator) for n in p.of_flight(k)] for k in range(len(p.flights))]
        table = _table(each, p.flights)
        kept: list[Mapping[str, NDArray[Any]]] = []
        for k, (flight, outputs) in enumerate(zip(p.flights, each, strict=True)):
            rows = [
                table.rows(np.array(flight.time[parts[0].rows]), parts, k + 1)
                for parts in zip(*(x.segments() for x in outputs), strict=True)
            ]
            kept.append(joined(rows, list(table.units)))
        d = each[0][0].demodulator
        result = {
            "calibration": kind,
            "converged": p.converged,
            "effects": [e.id for e in self.model.effects],
            "demodulator": {
                "name": d.name,
                "what": d.description,
                "latency_s": d.latency,
                "bandwidth_Hz": d.bandwidth,
            },
            "flights": [x.as_json() for outputs in each for x in outputs],
        }
        if saved is not None and p.change is not None:
            told = {"made": saved.time, "flights": dict(saved.flights), "converged": saved.converged}
            result["frozen"] = told | p.change.as_json()
            if not p.change.holds:
                other = frozen.other_origin(self.model, self.instrument, p.flights, saved, p.change)
                result["notes"] = [frozen.warning(saved.time, p.change), *([] if other is None else [other])]
        return self._found(result, kept, table.units)

    @one_thread
    def follow(
        self,
        flights: Sequence[Flight],
        saved: Saved | None,
        noise: float | None,
        walk: float | None,
        forget: float,
    ) -> Compensation:
        """Calibrate and compensate sample by sample, from the ``saved`` calibration, else from the sheet."""
        density = self._density(saved) if noise is None else noise
        walk = following(density) if walk is None else walk
        asked = Tuning(noise=density, walk=walk, forget=forget)
        found = [followed(self.model, self.instrument, x, saved, asked) for x in flights]
        result = {
            "calibration": "online",
            "started": "sheet" if saved is None else f"calibration made {saved.time}",
            "noise_Eo_per_rtHz": density,
            "walk_Eo_per_rts": walk,
            "follows_within_s": density / (np.sqrt(2.0) * walk) if walk > 0.0 else None,
            "forget_s": forget if np.isfinite(forget) else None,
            "effects": [e.id for e in self.model.effects],
            "flights": [entry for _, entries in found for entry in entries],
        }
        number = {"flight": np.int64} if len(found) > 1 else {}
        series: list[Mapping[str, NDArray[Any]]] = [
            {**s, **{n: np.full(len(s["time"]), k, dtype=kind) for n, kind in number.items()}}
            for k, (s, _) in enumerate(found, 1)
        ]
        plain = {"time": "s", "flight": "1"}
        units = {n: plain.get(n, "1" if n.startswith("quality") else "Eo") for n in series[0]}
        return self._found(result, series, units)

    def _density(self, saved: Saved | None) -> float:
        """What a kept calibration left in the cross channel, Eo/sqrt(Hz)."""
        left = None if saved is None else saved.error.get("calibrated", {}).get("cross_Eo_per_rtHz")
        if not isinstance(left, float) or not left > 0.0:
            raise UserError(
                "how large the noise is cannot be known",
                where=self.name,
                found=f"{'no' if saved is None else 'a'} saved calibration{'' if saved is None else ' without a demodulated error'}",
                remedy="say it: --noise 2 (Eo/sqrt(Hz) of the cross channel), or calibrate first: ragg calibrate ... --save",
            )
        return left


def _table(each: Sequence[Sequence[Compensated]], flights: Sequence[Flight]) -> Table:
    """The columns of all flights, which must have the same outputs."""
    tables = [Table.of(outputs, several=len(flights) > 1) for outputs in each if outputs]
    for flight, outputs in zip(flights, each, strict=True):
        if [x.setting.observation.place for x in outputs] != [x.setting.observation.place for x in each[0]]:
            raise UserError(
                "the flights do not have the same outputs",
                where=flight.path or flight.name,
                found=", ".join(x.setting.observation.output.name for x in outputs)
                or "none that sees a gradient",
                expected=", ".join(x.setting.observation.output.name for x in each[0]),
                remedy="compensate them one by one",
            )
    return tables[0]
