"""Calibrate and compensate sample by sample: a square-root information filter of the parameters and of the gradient.

A filter is of one output. Its states are the fitted parameters (steps from a point p, in their scales) and the channels
inline and cross, a random walk. What is kept is the triangle R and the right-hand side z of R x = z; a sample is one
more row.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.compensate import seeing, without_gradients
from ragg_runtime.compensation.frozen import information
from ragg_runtime.compensation.saved import Saved
from ragg_runtime.compensation.series import Quality
from ragg_runtime.estimation.least_squares import of_some
from ragg_runtime.estimation.observation import ROWS, Observation, as_output, observations_of
from ragg_runtime.estimation.regressors import Column, Point, base_columns, linearised, own_columns, spelt
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import column_endings
from ragg_runtime.io import Flight
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model.evaluate import scale_factor, vector
from ragg_runtime.model.model import Model
from ragg_runtime.model.recorded import carried
from ragg_runtime.signals.demodulate import CUTOFF

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


def following(density: float) -> float:
    """Walk, Eo/sqrt(s), with which channels of a noise of so much, Eo/sqrt(Hz), are followed as the demodulators' low-pass would."""
    return float(density / np.sqrt(2.0) * 2 * np.pi * CUTOFF)


@dataclass(frozen=True)
class Followed:
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
        self.model, self.instrument, self.tuning = model, instrument, tuning
        self.nominal = vector(model, instrument)
        self.p = self.nominal.copy() if p is None else p.copy()
        self.place = place
        every = base_columns(model, instrument)
        self.own = own_columns([c for c, _ in every], instrument, place)
        found = [every[k] for k in self.own]
        self.columns: tuple[Column, ...] = tuple(c for c, _ in found)
        self.index = np.array([k for _, k in found], dtype=np.intp)
        self.scale = np.array([c.scale for c in self.columns])
        self.to_nominal = (self.nominal[self.index] - self.p[self.index]) / self.scale
        self.k_ggi = scale_factor(model, self.p, place)
        n = len(self.columns)
        self.R = np.zeros((n + 2, n + 3))
        self.R[:n, :n] = np.eye(n) if root is None else of_some(root, self.own)
        self.R[:n, -1] = self.R[:n, :n] @ (self.to_nominal if root is None else np.zeros(n))
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
        bare = replace(o, record=replace(r, wide=wide), memo=[])
        columns = as_output(bare, linearised(Point(self.model, self.instrument, self.p, False), bare))
        columns = columns[[*self.own, len(columns) - 1]]
        zero, one = np.zeros(len(r.time)), np.ones(len(r.time))
        gradient = np.stack([carried(one, zero, r, self.k_ggi), carried(zero, one, r, self.k_ggi)])
        return np.asarray(np.concatenate([columns[:-1], gradient, columns[-1:]]).T / self.tuning.noise)

    def _fold(self) -> None:
        if self._waiting:
            self.R = _triangle(np.vstack([self.R, *self._waiting]))[: len(self.R)]
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
        self.R = _triangle(whole)[2:, 2:]

    def _fade(self) -> None:
        t, self._faded = self._faded, 0.0
        kept = float(np.exp(-t / self.tuning.forget))
        if kept == 1.0:
            return
        n = len(self.columns)
        before = np.diag([1.0] * n + [1.0 / UNKNOWN_EO] * 2)
        known = np.column_stack([before, np.append(self.to_nominal, np.zeros(2))])
        whole = np.vstack([np.sqrt(kept) * self.R, np.sqrt(1.0 - kept) * known])
        self.R = _triangle(whole)[: n + 2]

    def gradient(self) -> tuple[float, float, float, float]:
        """inline, cross, and their standard deviations, Eo, whatever the parameters may be."""
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
        return p, of_some(self.R[:, : n + 2], range(n))


def _triangle(rows: Array) -> Array:
    """The triangular factor of rows."""
    return np.asarray(np.linalg.qr(rows, mode="r"))


CHANNELS = ("inline", "cross", "inline_std", "cross_std")


def followed(
    model: Model, instrument: Instrument, x: Flight, saved: Saved | None, asked: Tuning
) -> tuple[dict[str, NDArray[Any]], list[dict[str, Any]]]:
    """The series of a flight, and what the filter of each output says at its end; ``asked.noise`` is a density."""
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
