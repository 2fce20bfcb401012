"""calibration.json of a model directory: the calibrations that were kept, the last one in force."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, did_you_mean
from ragg_runtime.estimation.regressors import Column, list_base_columns
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.directory import CALIBRATION
from ragg_runtime.model.evaluate import make_vector, scale_factor
from ragg_runtime.model.model import Model
from ragg_runtime.workspace import Loaded

Array = NDArray[np.float64]

KEPT = 20
"""Calibrations that are kept, the latest: each takes some 30 kB, most of it their information."""

LEAST = 1e-3
"""Least diagonal number of the square root of the information: the sheet alone, in its own units, says 1."""


FITTED = ("name", "accelerometer", "effect", "scale", "unit", "unit_factor")
"""What is kept of a fitted parameter, beside its place."""


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
        """The entry as in the file."""
        return {
            "time": self.time,
            "converged": self.converged,
            "model": {"effects": list(self.effects), "form": self.form, "derivation": self.derivation},
            "values": self._by_name(self.p),
            "sheet": self._by_name(self.sheet),
            "fitted": [
                {"place": int(k)} | {name: getattr(c, name) for name in FITTED}
                for c, k in zip(self.columns, self.index, strict=True)
            ],
            "square_root_information": [
                [float(x) for x in row[n:]] for n, row in enumerate(self.information)
            ],
            "validity": {name: list(limits) for name, limits in self.validity.items()},
            "flights": dict(self.flights),
            "error": dict(self.error),
        }

    def _by_name(self, p: Array) -> dict[str, list[float]]:
        parts = np.split(p, np.cumsum([size for _, size in self.layout])[:-1])
        return {name: x.tolist() for (name, _), x in zip(self.layout, parts, strict=True)}

    def find_oddities(self, model: Model, instrument: Instrument) -> list[str]:
        """What is odd about the calibration, in sentences."""
        found = []
        if self.derivation != model.digest:
            found.append("the model has been derived anew since the calibration was saved")
        if not self.converged:
            found.append("the saved calibration had not converged")
        if not np.array_equal(self.sheet, make_vector(model, instrument)):
            found.append("model.toml has changed since the calibration was saved; the saved values are used")
        if "balancing-loop" in self.effects:
            found.append(
                "balancing loops change scale factors or second-order coefficients during every flight: the saved calibration holds only "
                "with their recorded currents"
            )
        return found


def add_entry(text: str | None, new: Saved, where: str) -> str:
    """The text of calibration.json with one more calibration, the oldest forgotten beyond :data:`KEPT`."""
    before = [] if text is None else _entries(text, where)
    lines = ",\n".join(
        json.dumps(e, allow_nan=False, ensure_ascii=False) for e in [*before, new.as_json()][-KEPT:]
    )
    return f'{{"calibrations": [\n{lines}\n]}}\n'


def read_saved(text: str, where: str) -> Saved:
    """The last calibration in the text of a calibration.json; UserError if anything in it cannot be."""
    entry = _entries(text, where)[-1]
    try:
        return _parse(entry)
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError) as error:
        raise _damaged(where, f"no {error}" if isinstance(error, KeyError) else str(error)) from None


def _entries(text: str, where: str) -> list[Any]:
    try:
        found = json.loads(text, parse_constant=_refuse)["calibrations"]
        if not (isinstance(found, list) and found):
            raise ValueError("no calibration in it")
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise _damaged(where, str(error)) from None
    return found


def _refuse(text: str) -> float:
    raise ValueError(f"{text} is not a number")


def _damaged(where: str, found: str) -> UserError:
    return UserError(
        "the saved calibration is damaged",
        where=where,
        found=found[:200],
        expected='{"calibrations": [...]}, as `ragg calibrate --save` writes it',
        remedy="restore the file, or calibrate again: ragg calibrate MODEL FLIGHT... --save (after removing it)",
    )


def _parse(e: Mapping[str, Any]) -> Saved:
    layout = tuple((str(name), len(values)) for name, values in e["values"].items())
    if [(str(name), len(values)) for name, values in e["sheet"].items()] != list(layout):
        raise ValueError("sheet and values name different parameters")
    p, sheet = (np.concatenate([*e[k].values()]).astype(np.float64) for k in ("values", "sheet"))
    columns = tuple(Column(**{name: c[name] for name in FITTED}) for c in e["fitted"])
    if not all(c.scale > 0.0 and c.unit_factor > 0.0 for c in columns):
        raise ValueError("a scale or unit_factor is not positive")
    index = np.array([int(c["place"]) for c in e["fitted"]], dtype=np.intp)
    if len({*index.tolist()}) != len(index):
        raise ValueError("a parameter is fitted twice")
    return Saved(
        time=str(e["time"]),
        effects=tuple(map(str, e["model"]["effects"])),
        form=str(e["model"]["form"]),
        derivation=str(e["model"]["derivation"]),
        layout=layout,
        p=p,
        sheet=sheet,
        columns=columns,
        index=index,
        information=_square(e["square_root_information"], len(columns)),
        converged=bool(e["converged"]),
        validity={str(n): (float(low), float(high)) for n, (low, high) in e["validity"].items()},
        flights={str(n): str(d) for n, d in e["flights"].items()},
        error=dict(e["error"]),
    )


def _square(rows: Sequence[Sequence[float]], n: int) -> Array:
    """(n, n) of the rows of an upper triangle."""
    if [len(row) for row in rows] != [*range(n, 0, -1)]:
        raise ValueError(
            "the square root of the information is not an upper triangle of the fitted parameters"
        )
    R = np.zeros((n, n))
    R[np.triu_indices(n)] = np.concatenate([*rows])
    if n and not np.min(np.abs(np.diag(R))) > LEAST:
        raise ValueError("the square root of the information is singular")
    return R


def saved_calibration(m: Loaded) -> Saved:
    """The calibration that a model directory keeps, in the present scales of the parameters that are fitted.

    Raises
    ------
    UserError
        If there is none, if it is damaged, or of another model.
    """
    kept, where = m.directory.calibration, m.directory.path / CALIBRATION
    model, instrument = m.model, m.instrument
    again = f"calibrate: ragg calibrate {where.parent} FLIGHT... --save"

    refuse = partial(UserError, where=where, remedy=again)
    if kept is None:
        raise UserError("the model has no saved calibration", where=where.parent, remedy=again)
    saved = read_saved(kept, str(where))
    effects, form = tuple(e.id for e in model.effects), instrument.form.words()
    if (saved.layout, saved.effects, saved.form) != (tuple(model.chain.PARAMETERS), effects, form):
        raise refuse(
            "the saved calibration belongs to another model",
            found=f"{saved.form}, effects {', '.join(saved.effects) or 'none'}, made {saved.time}",
            expected=f"{form}, effects {', '.join(effects) or 'none'}",
        )
    present = list_base_columns(model, instrument)
    places = {(c.name, c.accelerometer): k for c, k in present}
    for c, k in zip(saved.columns, saved.index, strict=True):
        if places.get((c.name, c.accelerometer)) != k:
            near = did_you_mean(c.name, [name for name, _ in places]) or again
            what = "the saved calibration names a parameter that the model does not fit"
            raise refuse(what, found=c.label, remedy=near)
    nominal = make_vector(model, instrument)
    given = np.setdiff1d(np.arange(len(nominal)), saved.index)
    if not np.array_equal(saved.p[given], nominal[given]):
        what = "model.toml was changed since the calibration was saved: values that are not fitted differ"
        raise refuse(what, found=f"a calibration made {saved.time}")
    if not scale_factor(model, saved.p) > 0.0:
        raise refuse("the saved calibration has no positive scale factor")
    return _rescale(saved, present)


def _rescale(saved: Saved, present: Sequence[tuple[Column, int]]) -> Saved:
    """The same in the scales of the present columns; one that was not fitted then is as sure as the sheet."""
    known = {int(k): n for n, k in enumerate(saved.index)}
    rows = np.zeros((len(known), len(present)))
    sheet = np.zeros((len(present), len(present)))
    for n, (c, k) in enumerate(present):
        if k in known:
            rows[:, n] = saved.information[:, known[k]] * (c.scale / saved.columns[known[k]].scale)
        else:
            sheet[n, n] = 1.0
    if sheet.any() or np.tril(rows, -1).any():
        rows = np.asarray(np.linalg.qr(np.vstack([rows, sheet]), mode="r"))
    columns, index = zip(*present, strict=True)
    return replace(saved, columns=columns, index=np.array(index, dtype=np.intp), information=rows)
