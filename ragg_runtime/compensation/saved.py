"""calibration.json of a model directory: the calibration that was kept."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.regressors import Column, list_base_columns
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.directory import CALIBRATION
from ragg_runtime.model.model import Model, make_vector, scale_factor
from ragg_runtime.workspace import Loaded

Array = NDArray[np.float64]

LEAST = 1e-3
"""Least diagonal number of the square root of the information: the sheet alone, in its own units, says 1."""


@dataclass(frozen=True)
class Saved:
    """A calibration as it was kept.

    ``time``: UTC, ISO 8601. ``model``: its ``effects``, its ``form``, and the digest of its ``derivation``. ``values``, ``sheet``:
    parameter -> SI, calibrated, and of model.toml then. ``columns``, ``index``: the fitted parameters and their places in ``p``.
    ``information`` (n, n): upper triangular R in units of the scales, prior included (variances span sixteen decades: a covariance
    would round them away). ``validity``: channel -> least and largest value, SI. ``flights``: name -> SHA-256. ``error``: nominal,
    calibrated, holdout.
    """

    time: str
    converged: bool
    model: Mapping[str, Any]
    values: Mapping[str, list[float]]
    sheet: Mapping[str, list[float]]
    columns: tuple[Column, ...]
    index: NDArray[np.intp]
    information: Array
    validity: Mapping[str, tuple[float, float]]
    flights: Mapping[str, str]
    error: Mapping[str, Any]

    @cached_property
    def p(self) -> Array:
        """(size,), SI: the calibrated parameters."""
        return np.concatenate([*self.values.values()])

    def as_text(self) -> str:
        """The text of calibration.json."""
        return f"{json.dumps(self.as_json(), allow_nan=False, ensure_ascii=False)}\n"

    def as_json(self) -> dict[str, Any]:
        """As in the file."""
        kept = ("time", "converged", "model", "values", "sheet", "validity", "flights", "error")
        return {
            **{name: getattr(self, name) for name in kept},
            "fitted": [
                {"name": c.name, "accelerometer": c.accelerometer, "scale": c.scale} for c in self.columns
            ],
            "square_root_information": [row[n:].tolist() for n, row in enumerate(self.information)],
        }

    def find_oddities(self, model: Model, instrument: Instrument) -> list[str]:
        """What is odd about the calibration, in sentences."""
        found = []
        if self.model["derivation"] != model.digest:
            found.append("the model has been derived anew since the calibration was saved")
        if not self.converged:
            found.append("the saved calibration had not converged")
        if not np.array_equal(np.concatenate([*self.sheet.values()]), make_vector(model, instrument)):
            found.append("model.toml has changed since the calibration was saved; the saved values are used")
        if "balancing-loop" in self.model["effects"]:
            found.append(
                "balancing loops change scale factors or second-order coefficients during every flight: the saved calibration holds only "
                "with their recorded currents"
            )
        return found


def _refuse(text: str) -> float:
    raise ValueError(f"{text} is not a number")


def saved_calibration(m: Loaded) -> Saved:
    """The calibration that a model directory keeps, in the present scales of the parameters that are fitted.

    Raises
    ------
    UserError
        If there is none, if it is damaged, or of another model.
    """
    kept, where = m.directory.calibration, m.directory.path / CALIBRATION
    again = f"calibrate: ragg calibrate {where.parent} FLIGHT... --save"
    if kept is None:
        raise UserError("the model has no saved calibration", where=where.parent, remedy=again)
    refuse = partial(UserError, where=where, remedy=again)
    try:
        return _read(json.loads(kept, parse_constant=_refuse), m, refuse)
    except (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError) as error:
        found = f"no {error}" if isinstance(error, KeyError) else str(error)[:200]
        raise refuse("the saved calibration is damaged", found=found) from None


def _read(e: Mapping[str, Any], m: Loaded, refuse: Callable[..., UserError]) -> Saved:
    """What was kept as a calibration of the present model; what speaks against it raises the error that ``refuse`` makes."""
    model, instrument = m.model, m.instrument
    effects, form = [x.id for x in model.effects], instrument.form.words()
    of, layout = e["model"], [(name, len(x)) for name, x in e["values"].items()]
    if (of["effects"], of["form"], layout) != (effects, form, [*model.chain.PARAMETERS]):
        raise refuse(
            "the saved calibration belongs to another model",
            found=f"{of['form']}, effects {', '.join(of['effects']) or 'none'}, made {e['time']}",
            expected=f"{form}, effects {', '.join(effects) or 'none'}",
        )
    columns, places = zip(*list_base_columns(model, instrument), strict=True)
    names = [(c.name, c.accelerometer) for c in columns]
    scales = {(x["name"], x["accelerometer"]): float(x["scale"]) for x in e["fitted"]}
    gone = [name for name, _ in scales.keys() - {*names}]
    if gone:
        what = "the saved calibration names a parameter that the model does not fit"
        raise refuse(what, found=min(gone))
    saved = Saved(
        time=str(e["time"]),
        converged=bool(e["converged"]),
        model=of,
        values=e["values"],
        sheet=e["sheet"],
        columns=columns,
        index=np.array(places, dtype=np.intp),
        information=_rescale(e["square_root_information"], scales, columns),
        validity={name: (float(low), float(high)) for name, (low, high) in e["validity"].items()},
        flights=dict(e["flights"]),
        error=dict(e["error"]),
    )
    nominal = make_vector(model, instrument)
    given = np.setdiff1d(
        np.arange(len(nominal)), [k for name, k in zip(names, places, strict=True) if name in scales]
    )
    if not np.array_equal(saved.p[given], nominal[given]):
        what = "model.toml was changed since the calibration was saved: values that are not fitted differ"
        raise refuse(what, found=f"a calibration made {saved.time}")
    if not scale_factor(model, saved.p) > 0.0:
        raise refuse("the saved calibration has no positive scale factor")
    return saved


def _rescale(
    upper: list[list[float]], scales: Mapping[tuple[str, int | None], float], columns: tuple[Column, ...]
) -> Array:
    """The root of the information, of which the rows of the upper triangle were kept in these scales, in those of the present columns; one
    that was not fitted then is as sure as the sheet.
    """
    R, kept = np.zeros((len(scales), len(scales))), list(scales)
    R[np.triu_indices(len(scales))] = np.concatenate(upper)
    if not np.min(np.abs(np.diag(R)), initial=np.inf) > LEAST:
        raise ValueError("the square root of the information is singular")
    rows, sheet = np.zeros((len(scales), len(columns))), np.zeros((len(columns), len(columns)))
    for n, c in enumerate(columns):
        if (name := (c.name, c.accelerometer)) in scales:
            rows[:, n] = R[:, kept.index(name)] * (c.scale / scales[name])
        else:
            sheet[n, n] = 1.0
    if sheet.any() or np.tril(rows, -1).any():
        rows = np.asarray(np.linalg.qr(np.vstack([rows, sheet]), mode="r"))
    return rows
