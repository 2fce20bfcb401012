"""What comes after a model, for the command line and for notebooks: calibrate, compare frozen, compensate, export."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib import resources
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import one_thread
from ragg_runtime.compensation import calibrated as _calibrated
from ragg_runtime.compensation import frozen as _frozen
from ragg_runtime.compensation.calibrated import Calibrated
from ragg_runtime.compensation.compensate import (
    Compensated,
    Kind,
    meaning,
    prepared,
)
from ragg_runtime.compensation.export.contents import Contents
from ragg_runtime.compensation.export.numpy_folder import json_files, numpy_files, write_folder
from ragg_runtime.compensation.export.program import c_program
from ragg_runtime.compensation.frozen import Held
from ragg_runtime.compensation.output import Table, joined, write_series
from ragg_runtime.compensation.recursive import Tuning, followed, following
from ragg_runtime.compensation.saved import Saved, with_another
from ragg_runtime.compensation.series import MEANING
from ragg_runtime.io import Flight
from ragg_runtime.io.files import require_writable
from ragg_runtime.io.record import distinct
from ragg_runtime.model.evaluate import vector
from ragg_runtime.model.record import GRADIENTS
from ragg_runtime.model_dir import derive
from ragg_runtime.model_dir.directory import CALIBRATION, replace_model_dir
from ragg_runtime.model_dir.history import Step
from ragg_runtime.wording import describe
from ragg_runtime.wording.sections import render_notebook
from ragg_runtime.workflow.loop import Flights, Loaded, mapping_text, read_flights


@dataclass(frozen=True)
class Kept:
    """The result of ``calibrate``: the calibration, and the model directory as it is afterwards."""

    loaded: Loaded
    calibrated: Calibrated
    saved: bool

    def __repr__(self) -> str:
        seen, of = self.calibrated.directions
        return (
            f"<calibration of {self.loaded.name}: {self.calibrated.error.rms_Eo:.4g} Eo rms, "
            f"{seen} of {of} directions seen>"
        )

    def _repr_html_(self) -> str:
        names = [o.name for o in self.calibrated.fitted.observations]
        return render_notebook(describe.describe_calibration(self.as_json(), names))

    def as_json(self) -> dict[str, Any]:
        return self.calibrated.as_json() | {"saved": self.saved}


def calibrate(m: Loaded, flights: Flights, save: bool = False, mapping: Path | None = None) -> Kept:
    """Fit the parameters to flights; ``save`` keeps them (and ``mapping``) in the model directory, older ones as history."""
    flights = read_flights(m, flights, mapping)
    distinct(flights)
    text = None if mapping is None else mapping_text(mapping)
    c = _calibrated.calibrated(m.model, m.instrument, flights)
    return Kept(loaded=_saved(m, c, flights, text) if save else m, calibrated=c, saved=save)


def _saved(m: Loaded, c: Calibrated, flights: Sequence[Flight], mapping: str | None) -> Loaded:
    d = m.directory
    new = _calibrated.to_save(c, flights, datetime.now(UTC).isoformat(timespec="seconds"))
    digests = MappingProxyType(dict(new.flights))
    step = Step(action="calibrate", time=new.time, after=new.error, flights=digests)
    directory = replace_model_dir(
        d,
        d.text,
        generated=derive.files_of(d.instrument),
        step=step,
        calibration=lambda text: with_another(text, new, str(d.path / CALIBRATION)),
        mapping=mapping,
    )
    return Loaded(directory, m.model, m.notes)


def saved_calibration(m: Loaded) -> Saved:
    """The calibration that the model directory keeps; UserError if there is none, or if it is of another model."""
    return _frozen.in_force(m.directory.calibration, m.directory.path / CALIBRATION, m.model, m.instrument)


def compare_frozen(m: Loaded, flights: Flights) -> Held:
    """How far the model is from flights with the parameters as they were kept, and how these hold."""
    flights = read_flights(m, flights)
    distinct(flights)
    return _frozen.hold(m.model, m.instrument, flights, saved_calibration(m))


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
        return None if online else render_notebook(describe.describe_compensation(self.as_json(), ""))

    def as_json(self) -> dict[str, Any]:
        return dict(self.result)

    def write(self, path: Path | str) -> None:
        """The series of all flights, one after the other, into a file of the format that its ending names."""
        write_series(Path(path), self.series, self.units)


QUALITY: Mapping[str, str] = MappingProxyType({str(q.name): text for q, text in MEANING.items()})
"""What the marks of samples mean, by the name under which a compensation counts them."""


@one_thread
def compensate(
    m: Loaded,
    flights: Flights,
    calibration: Kind | Literal["online"] = "self",
    demodulator: str = "fir",
    output: Path | str | None = None,
    *,
    noise: float | None = None,
    walk: float | None = None,
    forget: float = float("inf"),
) -> Compensation:
    """The gravity gradient as the instrument saw it: everything removed that the model explains, demodulated.

    Parameters
    ----------
    calibration
        ``self``: the parameters are fitted to these flights; ``crossed``: every block of time has those fitted to all
        others; ``frozen``: as ``calibrate(..., save=True)`` kept them; ``online``: followed sample by sample by the recursive
        filter, as a computer on board would, from the calibration that is kept, else from the sheet. It needs no demodulator.
    demodulator
        ``fir``, ``butterworth`` or ``causal``.
    output
        A file for the series.
    noise
        Of ``online``: density of the noise of the cross channel about twice the spin rate, Eo/sqrt(Hz); by default what the kept
        calibration left.
    walk
        Of ``online``, of the cross channel, Eo/sqrt(s), twice that of the inline one; by default both are followed with the time
        constant of the demodulators' low-pass, 1/(2 pi 0.2 Hz).
    forget
        Of ``online``: time constant, s, with which the parameters forget the flight.
    """
    flights = read_for_compensation(m, flights)
    if calibration == "online":
        return _online(m, flights, output, noise, walk, forget)
    saved = saved_calibration(m) if calibration == "frozen" else None
    if saved is None:
        distinct(flights)
    p = prepared(m.model, m.instrument, flights, calibration, saved)
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
        "calibration": calibration,
        "converged": p.converged,
        "effects": [e.id for e in m.model.effects],
        "demodulator": {
            "name": d.name,
            "what": d.description,
            "latency_s": d.latency,
            "bandwidth_Hz": d.bandwidth,
        },
        "flights": [x.as_json() for outputs in each for x in outputs],
        "quality": meaning(),
    }
    if saved is not None and p.change is not None:
        told = {"made": saved.time, "flights": dict(saved.flights), "converged": saved.converged}
        result["frozen"] = told | p.change.as_json()
        if not p.change.holds:
            origin = _frozen.other_origin(m.model, m.instrument, p.flights, saved, p.change)
            result["notes"] = [_frozen.warning(saved.time, p.change), *([] if origin is None else [origin])]
    found = Compensation(name=m.name, result=result, series=tuple(kept), units=MappingProxyType(table.units))
    if output is not None:
        found.write(output)
    return found


def _online(
    m: Loaded,
    flights: Sequence[Flight],
    output: Path | str | None,
    noise: float | None,
    walk: float | None,
    forget: float,
) -> Compensation:
    saved = None if m.directory.calibration is None else saved_calibration(m)
    result, series = online(m, flights, saved, noise, walk, forget)
    units = {
        n: "s" if n == "time" else "1" if n.startswith(("quality", "flight")) else "Eo" for n in series[0]
    }
    found = Compensation(
        name=m.name,
        result=result | {"quality": meaning()},
        series=tuple(series),
        units=MappingProxyType(units),
    )
    if output is not None:
        found.write(output)
    return found


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


def contents(m: Loaded) -> Contents:
    """What is exported of a model: with the calibration that was kept, else with the values of model.toml."""
    saved, origin = None, "values of model.toml, not calibrated"
    if m.directory.calibration is not None:
        try:
            saved = saved_calibration(m)
            origin = f"calibrated {saved.time} on {', '.join(saved.flights)}"
        except UserError as error:
            origin = f"values of model.toml: {error.what}"
    folded = {n: text for n, text in m.model.sources.items() if n.startswith("folded")}
    if not m.instrument.layout.like_paper:  # of a single accelerometer a volt has few digits: then bit by bit
        folded = {}
    return Contents(
        name=m.name,
        model=m.model,
        instrument=m.instrument,
        p=vector(m.model, m.instrument) if saved is None else saved.p,
        sources=folded or derive.plain_c(m.instrument),
        module=_chain(m),
        origin=origin,
        information=None if saved is None else _frozen.information(saved, m.model, m.instrument),
        calibration=None if saved is None else saved.as_json(),
    )


def _chain(m: Loaded) -> str:
    """The text of the chain in NumPy."""
    files = derive.files_of(m.instrument)
    if files:
        return files["chain.py"]
    kinematics = m.instrument.form.kinematics
    package = "generated" if kinematics == "platform" else "generated.full"
    return resources.files(package).joinpath("chain.py").read_text("utf-8")


def export(m: Loaded, folder: Path, form: str) -> list[Path]:
    """Write the model into a folder, as ``c``, ``numpy``, ``json`` or ``harmonics``; the files."""
    return written(contents(m), folder, form)


def written(c: Contents, folder: Path, form: str) -> list[Path]:
    """Write what is exported into a folder; the files."""
    if form not in FORMS:
        raise UserError("unknown form of export", found=repr(form), expected=", ".join(FORMS))
    return write_folder(folder, FORMS[form](c))


def _harmonics(c: Contents) -> Mapping[str, str]:
    """The outputs as harmonics of their discs' angles, beside the values that go into them."""
    return {**derive.harmonics_of(c.instrument), **json_files(c)}


FORMS: Mapping[str, Callable[[Contents], Mapping[str, str]]] = MappingProxyType(
    {"c": c_program, "numpy": numpy_files, "json": json_files, "harmonics": _harmonics}
)
"""Form of an export -> its files."""


def check_output(path: Path) -> None:
    """UserError if no compensated series is written in this format: said before anything is computed."""
    require_writable(path)


def read_for_compensation(m: Loaded, paths: Flights, mapping: Path | None = None) -> list[Flight]:
    """Read and examine flights without their gradients: nothing of these shall get into what is compensated."""
    return read_flights(m, paths, mapping, leave=frozenset(GRADIENTS))


def calibration_notes(m: Loaded) -> list[str]:
    """What is odd about the calibration that is kept."""
    return _frozen.notes(saved_calibration(m), m.model, m.instrument)


def online(
    m: Loaded,
    flights: Sequence[Flight],
    saved: Saved | None,
    noise: float | None,
    walk: float | None,
    forget: float,
) -> tuple[dict[str, Any], list[Mapping[str, NDArray[Any]]]]:
    """Calibrate and compensate sample by sample, from the calibration that is kept, else from the sheet."""
    density = _density(m, saved) if noise is None else noise
    walk = following(density) if walk is None else walk
    asked = Tuning(noise=density, walk=walk, forget=forget)
    found = [followed(m.model, m.instrument, x, saved, asked) for x in flights]
    result = {
        "calibration": "online",
        "started": "sheet" if saved is None else f"calibration made {saved.time}",
        "noise_Eo_per_rtHz": density,
        "walk_Eo_per_rts": walk,
        "follows_within_s": density / (np.sqrt(2.0) * walk) if walk > 0.0 else None,
        "forget_s": forget if np.isfinite(forget) else None,
        "effects": [e.id for e in m.model.effects],
        "flights": [entry for _, entries in found for entry in entries],
    }
    several = len(found) > 1
    return result, [
        {**s, "flight": np.full(len(s["time"]), k)} if several else s for k, (s, _) in enumerate(found, 1)
    ]


def _density(m: Loaded, saved: Saved | None) -> float:
    """What a kept calibration left in the cross channel, Eo/sqrt(Hz)."""
    left = None if saved is None else saved.error.get("calibrated", {}).get("cross_Eo_per_rtHz")
    if not isinstance(left, float) or not left > 0.0:
        raise UserError(
            "how large the noise is cannot be known",
            where=m.directory.path,
            found="no saved calibration"
            if saved is None
            else "a saved calibration without a demodulated error",
            remedy="say it: --noise 2 (Eo/sqrt(Hz) of the cross channel), or calibrate first: ragg calibrate ... --save",
        )
    return left
