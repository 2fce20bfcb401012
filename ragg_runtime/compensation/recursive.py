"""Calibrate and compensate sample by sample: a square-root information filter of the parameters and of the gradient.

A filter is of one output. Its states are the fitted parameters (steps from a point p, in their scales) and the channels
inline and cross, a random walk. What is kept is the R factor and the right-hand side z of R x = z; a sample is one
more row.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.progress import one_thread, split_range
from ragg_runtime.compensation.calibrate import Saved, saved_calibration
from ragg_runtime.compensation.compensate import Compensation, Quality, find_sensitive, leave_out_gradients
from ragg_runtime.compensation.drift import walk_on
from ragg_runtime.estimation.least_squares import marginalise
from ragg_runtime.estimation.observation import ROWS, Observation, combine_output, observe_flights
from ragg_runtime.estimation.regressors import linearise, list_base_columns, list_own_columns, make_point
from ragg_runtime.identification.parameters import list_parameter_values
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import column_endings
from ragg_runtime.io import Flight
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model.model import Model, make_vector, scale_factor
from ragg_runtime.model.record import put_on_carriers
from ragg_runtime.signals.demodulators import CUTOFF
from ragg_runtime.workspace import Loaded

Array = NDArray[np.float64]

UPDATE = 0.25  # s between steps of the gradient's walk and of forgetting; the state is constant in between

STEEPER = 2.0
"""Walk of the inline channel over that of the cross one: in a field without a preferred direction Gamma_xx - Gamma_yy
varies twice as much as Gamma_xy; its noise is twice as large too."""

# standard deviation of the gradient before anything is known, Eo: three times the Earth's own
UNKNOWN_EO = 1e4


@dataclass(frozen=True)
class Tuning:
    """How an online filter works.

    ``noise``: density of the cross channel near twice the spin rate, Eo/sqrt(Hz). ``walk``: of the cross channel, Eo/sqrt(s), the
    inline one twice as much; 0: they are constant. ``forget``: time constant, s, with which parameters forget the flight.
    Infinite: never.
    """

    noise: float
    walk: float = 0.0
    forget: float = float("inf")


class Online:
    """The filter, from a saved calibration, else from the sheet."""

    def __init__(
        self, model: Model, instrument: Instrument, tuning: Tuning, saved: Saved | None = None, place: int = 0
    ) -> None:
        self.model, self.instrument, self.tuning, self.place = model, instrument, tuning, place
        nominal, columns = make_vector(model, instrument), list_base_columns(model, instrument)
        self.selection = list_own_columns([c for c, _ in columns], instrument, place)
        self.columns = [columns[k][0] for k in self.selection]
        self.p = nominal if saved is None else saved.p
        self.k_ggi = scale_factor(model, self.p, place)
        n, index = len(self.selection), [columns[k][1] for k in self.selection]
        scale = np.array([c.scale for c in self.columns])
        self.about, to_nominal = self.p[index] / scale, (nominal[index] - self.p[index]) / scale
        unit_prior = np.diag([1.0] * n + [1.0 / UNKNOWN_EO] * 2)
        self.sheet = np.column_stack([unit_prior, [*to_nominal, 0.0, 0.0]])
        self.R = np.column_stack([unit_prior, np.zeros(n + 2)])
        if saved is not None:
            self.R[:n, :n] = marginalise(saved.information, self.selection)

    def feed(self, o: Observation) -> Array:
        """Filter a flight, without recorded gradients: (6, k): time, inline, cross, their standard deviations, Eo, and quality, at every
        step of the gradient's walk.
        """
        step = self.tuning.walk * np.array([0.0] * len(self.selection) + [STEEPER, 1.0])
        before = walked = float(o.record.time[0])
        rows, flag = [], 0
        waiting: list[Array] = []
        for samples in split_range(len(o.record.time), ROWS):
            part = o.part(samples)
            for t, row, valid in zip(part.record.time, self.make_rows(part), part.record.valid, strict=True):
                stepped = t - walked >= UPDATE
                if stepped:
                    self._fold(waiting)
                    self.R = walk_on(self.R, step * np.sqrt(t - walked))
                    self._fade(t - walked)
                    walked = t
                usable = valid and bool(np.isfinite(row).all())
                if usable:
                    waiting.append(row)
                if not usable or t - before > 1.5 / o.record.rate:
                    flag = int(Quality.BRIDGED)
                before = t
                if stepped:
                    self._fold(waiting)
                    rows.append((t, *self.find_gradient(), flag))
                    flag = 0
            self._fold(waiting)
            progress.step(float(samples.stop - samples.start))
        return np.array(rows).reshape(-1, 6).T

    def make_rows(self, o: Observation) -> Array:
        """(N, n + 3): every sample as a row of the least squares, over the noise."""
        r = o.record
        bare = replace(o, record=replace(r, wide={n: x for n, x in r.wide.items() if n not in GRADIENT}))
        columns = combine_output(bare, linearise(make_point(self.model, self.instrument, self.p), bare))
        zero, one = np.zeros(len(r.time)), np.ones(len(r.time))
        gradient = [put_on_carriers(*x, r, self.k_ggi) for x in ((one, zero), (zero, one))]
        noise = self.tuning.noise / np.sqrt(2.0) * self.k_ggi * np.sqrt(r.rate / 2)
        return np.asarray(np.vstack([columns[self.selection], *gradient, columns[-1:]]).T / noise)

    def _fold(self, rows: list[Array]) -> None:
        """Take rows, which are used up."""
        if rows:
            self.R = np.asarray(np.linalg.qr(np.vstack([self.R, *rows]), mode="r"))[: len(self.R)]
            rows.clear()

    def _fade(self, t: float) -> None:
        """Forget the share of the flights' information that fades within t, s; the sheet's takes its place."""
        share = float(np.exp(-t / self.tuning.forget))
        if share < 1.0:
            self.R = np.sqrt(share) * self.R
            self._fold([np.sqrt(1.0 - share) * self.sheet])

    def find_gradient(self) -> Array:
        """(4,) Eo: inline, cross, and their standard deviations, marginal over the parameters."""
        root = np.linalg.inv(self.R[-2:, -3:-1])
        return np.concatenate([root @ self.R[-2:, -1], np.linalg.norm(root, axis=1)])

    def find_parameters(self) -> tuple[Array, Array]:
        """The fitted parameters (n,) and their covariance (n, n), in scales."""
        root = np.linalg.inv(self.R[:, :-1])[:-2]
        return self.about + np.linalg.solve(self.R[:, :-1], self.R[:, -1])[:-2], root @ root.T


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
    saved = None if m.directory.calibration is None else saved_calibration(m)
    density = _find_noise(m.name, saved) if noise is None else noise
    wander = float(density / np.sqrt(2.0) * 2 * np.pi * CUTOFF) if walk is None else walk
    series, entries = [], []
    for k, x in enumerate(flights, 1):
        columns, states = _follow_flight(m, leave_out_gradients(x), saved, Tuning(density, wander, forget))
        if len(flights) > 1:
            columns["flight"] = np.full(len(columns["time"]), k, dtype=np.int64)
        series.append(columns)
        entries += states
    result = {
        "calibration": "online",
        "started": "sheet" if saved is None else f"calibration made {saved.time}",
        "noise_Eo_per_rtHz": density,
        "walk_Eo_per_rts": wander,
        "follows_within_s": density / (np.sqrt(2.0) * wander) if wander > 0.0 else None,
        "forget_s": forget if np.isfinite(forget) else None,
        "effects": [e.id for e in m.model.effects],
        "flights": entries,
    }
    return Compensation(m.name, result, tuple(series))


def _find_noise(name: str, saved: Saved | None) -> float:
    """The noise of a saved calibration in the cross channel, Eo/sqrt(Hz); UserError if it is unknown."""
    density = None if saved is None else saved.error["calibrated"]["cross_Eo_per_rtHz"]
    if density is None:
        raise UserError(
            "the noise is not known",
            where=name,
            found="no saved calibration, or one of records that cannot be demodulated",
            remedy="give it: --noise 2 (Eo/sqrt(Hz) of the cross channel), or calibrate first: ragg calibrate ... --save",
        )
    return float(density)


def _follow_flight(
    m: Loaded, x: Flight, saved: Saved | None, tuning: Tuning
) -> tuple[dict[str, NDArray[Any]], list[dict[str, Any]]]:
    """The columns of a flight, and the state of each output's filter at its end."""
    endings = column_endings(m.instrument.layout.output_names)
    columns: dict[str, NDArray[Any]] = {}
    states = []
    observations = observe_flights([x], m.instrument, whole=True)
    for o in (observations[k] for k in find_sensitive(m.instrument, observations)):
        if o.recorded.demodulated:
            raise UserError(
                "the filter needs the output before demodulation",
                where=x.path or x.name,
                found="inline and cross",
                expected=o.output.name,
            )
        f = Online(m.model, m.instrument, tuning, saved, o.place)
        time, *channels, quality = f.feed(o)
        columns["time"] = time + float(x.time[0])
        names = (n.format(endings[o.place]) for n in ("inline{}", "cross{}", "inline{}_std", "cross{}_std"))
        columns |= dict(zip(names, channels, strict=True))
        columns[f"quality{endings[o.place]}"] = quality.astype(np.int64)
        values = list_parameter_values(f.columns, *f.find_parameters())
        parameters = [{**q.as_json(), "name": c.name} for q, c in zip(values, f.columns, strict=True)]
        states.append({"flight": o.name, "samples": len(o.record.time), "parameters": parameters})
    return columns, states
