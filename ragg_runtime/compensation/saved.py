"""calibration.json of a model directory: the calibrations that were kept, the last one in force."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.regressors import Column

Array = NDArray[np.float64]

KEPT = 20
"""Calibrations that are kept, the latest: each takes some 30 kB, most of it their information."""

LEAST = 1e-3
"""Least diagonal number of the square root of the information: the sheet alone, in its own units, says 1."""

_FORM = '{"calibrations": [...]}, as `ragg calibrate --save` writes it'
_REMEDY = "restore the file, or calibrate again: ragg calibrate MODEL FLIGHT... --save (after removing it)"


@dataclass(frozen=True)
class Saved:
    """A calibration as it was kept.

    ``time``: UTC, ISO 8601. ``effects``, ``form``, ``derivation``: of the model, with the digest of its derivation.
    ``layout``: the chain's parameters and how many values each has. ``p``, ``sheet`` (size,) SI: calibrated, and of
    model.toml then. ``columns``, ``index``: the fitted parameters and their places in ``p``. ``information`` (n, n):
    upper triangular R in units of the scales, prior included (variances span sixteen decades: a covariance would round
    them away). ``validity``: channel -> least and largest value, SI. ``flights``: name -> SHA-256. ``error``: nominal,
    calibrated, holdout.
    """

    time: str
    effects: tuple[str, ...]
    form: str
    derivation: str
    layout: tuple[tuple[str, int], ...]
    p: Array
    sheet: Array
    columns: tuple[Column, ...]
    index: NDArray[np.intp]
    information: Array
    converged: bool
    validity: Mapping[str, tuple[float, float]]
    flights: Mapping[str, str]
    error: Mapping[str, Any]

    def as_json(self) -> dict[str, Any]:
        """The entry as it stands in the file."""
        return {
            "time": self.time,
            "converged": self.converged,
            "model": {"effects": list(self.effects), "form": self.form, "derivation": self.derivation},
            "values": _by_name(self.layout, self.p),
            "sheet": _by_name(self.layout, self.sheet),
            "fitted": [
                {
                    "name": c.name,
                    "accelerometer": c.accelerometer,
                    "effect": c.effect,
                    "place": int(k),
                    "scale": c.scale,
                    "unit": c.unit,
                    "unit_factor": c.unit_factor,
                }
                for c, k in zip(self.columns, self.index, strict=True)
            ],
            "square_root_information": [
                [float(x) for x in row[n:]] for n, row in enumerate(self.information)
            ],
            "validity": {name: list(limits) for name, limits in self.validity.items()},
            "flights": dict(self.flights),
            "error": dict(self.error),
        }


def _by_name(layout: Sequence[tuple[str, int]], p: Array) -> dict[str, list[float]]:
    found, start = {}, 0
    for name, size in layout:
        found[name] = [float(x) for x in p[start : start + size]]
        start += size
    return found


def with_another(text: str | None, new: Saved, where: str) -> str:
    """The text of calibration.json with one more calibration, the oldest forgotten beyond :data:`KEPT`."""
    before = () if text is None else read(text, where)
    entries = [s.as_json() for s in (*before, new)[-KEPT:]]
    lines = ",\n".join(json.dumps(e, allow_nan=False, ensure_ascii=False) for e in entries)
    return f'{{"calibrations": [\n{lines}\n]}}\n'


def read(text: str, where: str) -> tuple[Saved, ...]:
    """The calibrations in the text of a calibration.json, oldest first; UserError if anything in it cannot be."""
    try:
        content = json.loads(text)
        found = tuple(_entry(e) for e in content["calibrations"])
        if not found:
            raise ValueError("no calibration in it")
        return found
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError) as error:
        what = f"no {error}" if isinstance(error, KeyError) else str(error)
        raise UserError(
            "the saved calibration is damaged", where=where, found=what[:200], expected=_FORM, remedy=_REMEDY
        ) from None


def _entry(e: Mapping[str, Any]) -> Saved:
    layout = tuple((str(name), len(values)) for name, values in e["values"].items())
    p = _numbers([x for values in e["values"].values() for x in values], "values")
    sheet = _numbers([x for values in e["sheet"].values() for x in values], "sheet")
    if [(str(n), len(v)) for n, v in e["sheet"].items()] != list(layout):
        raise ValueError("sheet and values name different parameters")
    index = np.array([int(c["place"]) for c in e["fitted"]], dtype=np.intp)
    if len(set(index.tolist())) != len(index):
        raise ValueError("a parameter is fitted twice")
    columns = tuple(_column(c) for c in e["fitted"])
    return Saved(
        time=str(e["time"]),
        effects=tuple(str(x) for x in e["model"]["effects"]),
        form=str(e["model"]["form"]),
        derivation=str(e["model"]["derivation"]),
        layout=layout,
        p=p,
        sheet=sheet,
        columns=columns,
        index=index,
        information=_information(e["square_root_information"], len(columns)),
        converged=bool(e["converged"]),
        validity={str(n): (float(low), float(high)) for n, (low, high) in e["validity"].items()},
        flights={str(n): str(d) for n, d in e["flights"].items()},
        error=dict(e["error"]),
    )


def _column(c: Mapping[str, Any]) -> Column:
    scale, factor = _numbers([c["scale"], c["unit_factor"]], "scale and unit_factor")
    if not (scale > 0.0 and factor > 0.0):
        raise ValueError("a scale or unit_factor is not positive")
    return Column(
        name=str(c["name"]),
        accelerometer=None if c["accelerometer"] is None else int(c["accelerometer"]),
        scale=float(scale),
        unit=str(c["unit"]),
        unit_factor=float(factor),
        effect=None if c["effect"] is None else str(c["effect"]),
    )


def _information(rows: Sequence[Sequence[Any]], n: int) -> Array:
    if len(rows) != n or any(len(row) != n - k for k, row in enumerate(rows)):
        raise ValueError("the square root of the information is no upper triangle of the fitted parameters")
    R = np.zeros((n, n))
    for k, row in enumerate(rows):
        R[k, k:] = _numbers(row, "square_root_information")
    if n and not np.min(np.abs(np.diag(R))) > LEAST:
        raise ValueError("the square root of the information is singular")
    return R


def _numbers(values: Sequence[Any], what: str) -> Array:
    found = np.array(values, dtype=np.float64)
    if not np.isfinite(found).all():
        raise ValueError(f"{what}: a number is not finite")
    return found
