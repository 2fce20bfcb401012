"""Whole flights through the recursive filter: what a computer on board would have found."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.compensate import seeing, without_gradients
from ragg_runtime.compensation.frozen import information
from ragg_runtime.compensation.recursive import Followed, Online, Tuning
from ragg_runtime.compensation.saved import Saved
from ragg_runtime.compensation.series import Quality
from ragg_runtime.fit.columns import spelt
from ragg_runtime.fit.observation import Observation, observations_of
from ragg_runtime.fit.segments import ROWS
from ragg_runtime.flight import Flight
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import column_endings
from ragg_runtime.model.evaluate import scale_factor, vector
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]

CHANNELS = ("inline", "cross", "inline_std", "cross_std")


def followed(
    model: Model, instrument: Instrument, x: Flight, saved: Saved | None, asked: Tuning
) -> tuple[dict[str, NDArray[Any]], list[dict[str, Any]]]:
    """The series of a flight, and what the filter of each output says at its end; ``asked.noise`` is a density.

    It begins from the calibration that was ``saved``, without one from the test sheet.
    """
    x = without_gradients(x)
    endings = column_endings(instrument.layout.output_names)
    root = None if saved is None else information(saved, model, instrument)
    columns: dict[str, NDArray[Any]] = {}
    told = []
    observed = observations_of([x], instrument)
    for o in (observed[k] for k in seeing(instrument, observed)):
        if o.recorded.demodulated:
            raise UserError(
                "the filter works on the output before demodulation",
                where=x.path or x.name,
                found="inline and cross",
                expected=o.output.name,
            )
        p = vector(model, instrument) if saved is None else saved.p
        volts = asked.noise / np.sqrt(2.0) * scale_factor(model, p, o.place) * np.sqrt(o.record.rate / 2)
        f = Online(model, instrument, replace(asked, noise=float(volts)), p, root, o.place)
        got = _fed(f, o)
        columns["time"] = got.time + float(x.time[0])
        end = endings[o.place]
        columns |= {f"inline{end}": got.inline, f"cross{end}": got.cross}
        columns |= {f"inline{end}_std": got.inline_std, f"cross{end}_std": got.cross_std}
        columns[f"quality{end}"] = _quality(got.time, o)
        told.append({"flight": o.name, "samples": len(o.record.time), "parameters": _parameters(f)})
    return columns, told


def _quality(time: Array, o: Observation) -> NDArray[np.int64]:
    """Of every instant: bridged where one of the samples since the instant before is missing."""
    step = 1.0 / o.record.rate
    heard = np.searchsorted(o.record.time[o.record.valid], time, "right")
    due = np.rint(np.diff(time, prepend=o.record.time[0] - step) / step)
    return np.where(np.diff(heard, prepend=0) < due, int(Quality.BRIDGED), 0)


def _fed(f: Online, o: Observation) -> Followed:
    """A whole flight through the filter, in parts that fit into memory."""
    n, parts = len(o.record.time), []
    for first in range(0, n, ROWS):
        some = slice(first, min(first + ROWS, n))
        parts.append(f.feed(o.part(some)))
        progress.step(float(some.stop - some.start))
    return Followed(*(np.concatenate([getattr(x, n) for x in parts]) for n in ("time", *CHANNELS)))


def _parameters(f: Online) -> list[dict[str, Any]]:
    p, root = f.parameters()
    std = np.linalg.norm(np.linalg.inv(root), axis=1) * f.scale
    return [
        {
            "name": c.name,
            "accelerometer": c.accelerometer,
            **spelt(c.accelerometer, c.accelerometer_name),
            "value": float(p[k] / c.unit_factor),
            "std": float(s / c.unit_factor),
            "unit": c.unit,
        }
        for c, k, s in zip(f.columns, f.index, std, strict=True)
    ]
