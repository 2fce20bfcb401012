"""Calibrate and compensate sample by sample: a square-root information filter of the parameters and of the gradient.

A filter is of one output. Its states are the fitted parameters (steps from a point p, in their scales) and the channels
inline and cross, a random walk. What is kept is the R factor and the right-hand side z of R x = z; a sample is one
more row.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import one_thread, split_range
from ragg_runtime.compensation.channel import Quality
from ragg_runtime.compensation.compensate import Compensation, find_seeing, leave_out_gradients
from ragg_runtime.compensation.saved import Saved, saved_calibration
from ragg_runtime.estimation.least_squares import marginalise
from ragg_runtime.estimation.observation import ROWS, Observation, combine_output, observe_flights
from ragg_runtime.estimation.regressors import (
    Column,
    LinearisationPoint,
    linearise,
    list_base_columns,
    list_own_columns,
)
from ragg_runtime.identification.parameters import list_parameter_values
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import column_endings
from ragg_runtime.io import Flight
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model.evaluate import make_vector, scale_factor
from ragg_runtime.model.model import Model
from ragg_runtime.model.recorded import put_on_carriers
from ragg_runtime.signals.demodulate import CUTOFF
from ragg_runtime.workspace import Loaded

Array = NDArray[np.float64]

UPDATE = 0.25
"""The gradient takes a step of its walk after so many seconds: it does not change within them."""

FADE = 10.0
"""Parameters forget in steps of so many seconds."""

STEEPER = 2.0
"""Walk of the inline channel over that of the cross one: Gamma_xx - Gamma_yy of a field without a preferred direction varies
twice as much as Gamma_xy, and its noise is twice as large."""

UNKNOWN_EO = 1e4
"""Standard deviation of the gradient before anything is known, Eo: three times the Earth's own."""


@dataclass(frozen=True)
class Tuning:
    """How an online filter works.

    ``noise``: standard deviation of a sample of G_out, V. ``walk``: of the cross channel, Eo/sqrt(s), the inline one
    twice as much; 0: they are constant. ``forget``: time constant, s, with which parameters forget the flight.
    Infinite: never.
    """

    noise: float
    walk: float = 0.0
    forget: float = float("inf")


class Followed(NamedTuple):
    """What a filter had found at some instants: (k,) each; channels in Eo."""

    time: Array
    inline: Array
    cross: Array
    inline_std: Array
    cross_std: Array


class Online:
    """The filter. Samples are fed in order of time, in parts of any length; NaN and gaps are passed over."""

    def __init__(
        self,
        model: Model,
        instrument: Instrument,
        tuning: Tuning,
        p: Array | None = None,
        root: Array | None = None,
        place: int = 0,
    ) -> None:
        """Begin at parameters ``p`` (size,) with ``root`` (all, all) of the information in scales, else at the sheet."""
        self.model, self.instrument, self.tuning, self.place = model, instrument, tuning, place
        nominal = make_vector(model, instrument)
        self.p = nominal.copy() if p is None else p.copy()
        every = list_base_columns(model, instrument)
        self.own = list_own_columns([c for c, _ in every], instrument, place)
        self.columns: tuple[Column, ...] = tuple(every[k][0] for k in self.own)
        self.index = np.array([every[k][1] for k in self.own], dtype=np.intp)
        self.scale = np.array([c.scale for c in self.columns])
        self.to_nominal = (nominal[self.index] - self.p[self.index]) / self.scale
        self.k_ggi = scale_factor(model, self.p, place)
        n = len(self.columns)
        self.R = np.zeros((n + 2, n + 3))
        self.R[:n, :n] = np.eye(n) if root is None else marginalise(root, self.own)
        self.R[n:, n : n + 2] = np.eye(2) / UNKNOWN_EO
        self._waiting: list[Array] = []
        self._before: float | None = None
        self._waited = self._faded = 0.0

    def feed(self, o: Observation) -> Followed:
        """Take a flight, or the next part of it (recorded gradients are not looked at); what was found on the way."""
        rows, known = self._rows(o), []
        for t, row, valid in zip(o.record.time, rows, o.record.valid, strict=True):
            dt = 0.0 if self._before is None else float(t) - self._before
            self._before = float(t)
            self._waited += dt
            self._faded += dt
            stepped = self._waited >= UPDATE
            if stepped:
                self._fold()
                self._walk()
            if self._faded >= FADE:
                self._fold()
                self._fade()
            if valid and np.isfinite(row).all():
                self._waiting.append(row)
            if stepped:
                self._fold()
                known.append((float(t), *self.gradient()))
        self._fold()
        return Followed(*np.array(known).reshape(-1, 5).T)

    def _rows(self, o: Observation) -> Array:
        """(N, n + 3): every sample as a row of the least squares, over the noise."""
        r = o.record
        wide = {name: x for name, x in r.wide.items() if name not in GRADIENT}
        bare = replace(o, record=replace(r, wide=wide))
        columns = combine_output(
            bare, linearise(LinearisationPoint(self.model, self.instrument, self.p, False), bare)
        )
        columns = columns[[*self.own, len(columns) - 1]]
        zero, one = np.zeros(len(r.time)), np.ones(len(r.time))
        gradient = np.stack(
            [put_on_carriers(one, zero, r, self.k_ggi), put_on_carriers(zero, one, r, self.k_ggi)]
        )
        return np.asarray(np.concatenate([columns[:-1], gradient, columns[-1:]]).T / self.tuning.noise)

    def _fold(self) -> None:
        if self._waiting:
            self.R = _eliminate(np.vstack([self.R, *self._waiting]))[: len(self.R)]
            self._waiting.clear()

    def _walk(self) -> None:
        """The gradient takes a step: g' = g + w, w of variance walk^2 t; w is eliminated."""
        t, self._waited = self._waited, 0.0
        if self.tuning.walk == 0.0:
            return
        n = len(self.columns)
        whole = np.zeros((n + 4, n + 5))
        whole[:2, :2] = np.diag([1.0 / STEEPER, 1.0]) / (self.tuning.walk * np.sqrt(t))
        whole[2:, :2] = -self.R[:, n : n + 2]
        whole[2:, 2:] = self.R
        self.R = _eliminate(whole)[2:, 2:]

    def _fade(self) -> None:
        t, self._faded = self._faded, 0.0
        kept = float(np.exp(-t / self.tuning.forget))
        if kept == 1.0:
            return
        n = len(self.columns)
        before = np.diag([1.0] * n + [1.0 / UNKNOWN_EO] * 2)
        known = np.column_stack([before, np.append(self.to_nominal, np.zeros(2))])
        whole = np.vstack([np.sqrt(kept) * self.R, np.sqrt(1.0 - kept) * known])
        self.R = _eliminate(whole)[: n + 2]

    def gradient(self) -> tuple[float, float, float, float]:
        """inline, cross, and their standard deviations, Eo, marginal over the parameters."""
        n = len(self.columns)
        inverse = np.linalg.inv(self.R[n:, n : n + 2])
        inline, cross = inverse @ self.R[n:, -1]
        std = np.linalg.norm(inverse, axis=1)
        return float(inline), float(cross), float(std[0]), float(std[1])

    def parameters(self) -> tuple[Array, Array]:
        """Parameter vector (size,), SI, and root (n, n) of the information of the fitted ones, in scales."""
        self._fold()
        n = len(self.columns)
        x = linalg.solve_triangular(self.R[:, : n + 2], self.R[:, -1])
        p = self.p.copy()
        p[self.index] += x[:n] * self.scale
        return p, marginalise(self.R[:, : n + 2], range(n))


def _eliminate(rows: Array) -> Array:
    """The R factor of rows."""
    return np.asarray(np.linalg.qr(rows, mode="r"))


# --- the command ---------------------------------------------------------------------------------------


@one_thread
def follow(
    m: Loaded,
    flights: Sequence[Flight],
    *,
    noise: float | None = None,
    walk: float | None = None,
    forget: float = float("inf"),
) -> Compensation:
    """Calibrate and compensate flights sample by sample, from the saved calibration, else from the test sheet.

    ``noise``, ``walk``, ``forget``: as of :func:`ragg.compensate`.

    Raises
    ------
    UserError
        If the noise is not known, or a flight holds no output before demodulation.
    """
    name, model, instrument = m.name, m.model, m.instrument
    saved = None if m.directory.calibration is None else saved_calibration(m)
    density = _known_noise(name, saved) if noise is None else noise
    wander = float(density / np.sqrt(2.0) * 2 * np.pi * CUTOFF) if walk is None else walk
    tuning = Tuning(noise=density, walk=wander, forget=forget)
    series, entries = [], []
    for k, x in enumerate(flights, 1):
        columns, said = _follow_flight(model, instrument, leave_out_gradients(x), saved, tuning)
        if len(flights) > 1:
            columns["flight"] = np.full(len(columns["time"]), k, dtype=np.int64)
        series.append(columns)
        entries += said
    result = {
        "calibration": "online",
        "started": "sheet" if saved is None else f"calibration made {saved.time}",
        "noise_Eo_per_rtHz": density,
        "walk_Eo_per_rts": wander,
        "follows_within_s": density / (np.sqrt(2.0) * wander) if wander > 0.0 else None,
        "forget_s": forget if np.isfinite(forget) else None,
        "effects": [e.id for e in model.effects],
        "flights": entries,
    }
    return Compensation.of(name, result, series)


def _known_noise(name: str, saved: Saved | None) -> float:
    """The noise of a saved calibration in the cross channel, Eo/sqrt(Hz); UserError if it is unknown."""
    left = None if saved is None else saved.error.get("calibrated", {}).get("cross_Eo_per_rtHz")
    if not isinstance(left, float) or not left > 0.0:
        raise UserError(
            "the noise is not known",
            where=name,
            found="no saved calibration"
            if saved is None
            else "a saved calibration without a demodulated error",
            remedy="give it: --noise 2 (Eo/sqrt(Hz) of the cross channel), or calibrate first: ragg calibrate ... --save",
        )
    return left


def _follow_flight(
    model: Model, instrument: Instrument, x: Flight, saved: Saved | None, tuning: Tuning
) -> tuple[dict[str, NDArray[Any]], list[dict[str, Any]]]:
    """The columns of a flight, and the state of each output's filter at its end; ``tuning.noise`` is a density."""
    endings = column_endings(instrument.layout.output_names)
    p, root = (make_vector(model, instrument), None) if saved is None else (saved.p, saved.information)
    columns: dict[str, NDArray[Any]] = {}
    said = []
    observations = observe_flights([x], instrument)
    for o in (observations[k] for k in find_seeing(instrument, observations)):
        if o.recorded.demodulated:
            raise UserError(
                "the filter needs the output before demodulation",
                where=x.path or x.name,
                found="inline and cross",
                expected=o.output.name,
            )
        volts = tuning.noise / np.sqrt(2.0) * scale_factor(model, p, o.place) * np.sqrt(o.record.rate / 2)
        f = Online(model, instrument, replace(tuning, noise=float(volts)), p, root, o.place)
        parts = []
        for rows in split_range(len(o.record.time), ROWS):
            parts.append(f.feed(o.part(rows)))
            progress.step(float(rows.stop - rows.start))
        got, end = Followed(*np.hstack(parts)), endings[o.place]
        columns["time"] = got.time + float(x.time[0])
        columns |= {f"{n}{end}": v for n, v in zip(("inline", "cross"), got[1:3], strict=True)}
        columns |= {f"{n}{end}_std": v for n, v in zip(("inline", "cross"), got[3:], strict=True)}
        columns[f"quality{end}"] = _flag_bridged(got.time, o)
        said.append({"flight": o.name, "samples": len(o.record.time), "parameters": _parameters_json(f)})
    return columns, said


def _flag_bridged(time: Array, o: Observation) -> NDArray[np.int64]:
    """Of every instant: bridged where one of the samples since the instant before is missing."""
    step = 1.0 / o.record.rate
    count = np.searchsorted(o.record.time[o.record.valid], time, "right")
    due = np.rint(np.diff(time, prepend=o.record.time[0] - step) / step)
    return np.where(np.diff(count, prepend=0) < due, int(Quality.BRIDGED), 0)


def _parameters_json(f: Online) -> list[dict[str, Any]]:
    p, root = f.parameters()
    inverse = np.linalg.inv(root)
    values = list_parameter_values(f.columns, p[f.index] / f.scale, inverse @ inverse.T)
    return [{**q.as_json(), "name": c.name} for q, c in zip(values, f.columns, strict=True)]
