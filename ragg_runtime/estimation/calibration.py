"""Fit a model's parameters to flights, each with a prior about the test sheet's value, as wide as the sheet or the record gives."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation import regressors as design
from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.least_squares import Linear, Minimum, add_prior, join, minimise
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.noise_estimate import estimate_noise
from ragg_runtime.estimation.observation import Observation
from ragg_runtime.estimation.regressors import Column, LinearisationPoint, list_tested_columns, spell_name
from ragg_runtime.estimation.unknown_gradient import Window
from ragg_runtime.estimation.whitening import Piece, find_segments, pass_over
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.model.evaluate import make_vector, scale_factor
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]

LEAN = 10.0
"""In an unweighted fit the noise counts as no less than what is left over this: the prior then weighs little, but keeps parameters from
drifting.
"""


@dataclass(frozen=True)
class Calibration:
    """Parameters fitted to one or more flights.

    ``p`` is the parameter vector of the model's chain, SI; ``covariance`` (n, n) that of the fitted ones in units of their scales,
    prior included; ``rows`` counts whitened samples; ``chi2`` includes the prior, ``excess`` is that of the data alone over their
    number, and ``unheld`` what the linearised problem would leave of it without the prior.
    """

    p: Array
    columns: tuple[Column, ...]
    index: NDArray[np.intp]
    covariance: Array
    noise: tuple[NoiseModel, ...]
    rows: int
    chi2: float
    excess: float
    unheld: float
    converged: bool
    reason: str

    @property
    def in_scales(self) -> Array:
        """(n,): the fitted parameters, each over its scale."""
        return np.asarray(self.p[self.index] / np.array([c.scale for c in self.columns]))

    @property
    def complaint(self) -> str | None:
        """Why it is not to be trusted, in words; ``None`` if it is."""
        return None if self.converged else f"the calibration has not converged: {self.reason}"


@dataclass(frozen=True)
class _Fall(Linear):
    """A fit linearised about a point: R factor ``data`` (n + 1, n + 1) of [base | residual] without the prior, the prior's centre
    ``to_nominal`` (n,) as seen from the point, in scales, and ``sums`` (n + 1,), V, of the columns and residual of each output.
    """

    data: Array
    to_nominal: Array
    sums: Mapping[int, Array]
    rows: int

    @property
    def excess(self) -> float:
        """Chi-square of the data over their number."""
        return float(self.data[:, -1] @ self.data[:, -1]) / max(self.rows, 1)

    @property
    def unheld(self) -> float:
        """The same at the end of the step that the data ask for without the prior."""
        return float(self.data[-1, -1] ** 2) / max(self.rows, 1)

    def over(self, size: float) -> _Fall:
        """The same with a noise so many times as large."""
        fall = _make_linear(self.data / size, self.to_nominal)
        rest = fall.rest if np.isfinite(self.rest) else np.inf
        return replace(self, R=fall.R, y=fall.y, rest=rest, data=self.data / size)


@dataclass(frozen=True)
class _Task:
    """What is fitted: chi-square as a function of the parameters' distance x (n,) from the sheet, in scales."""

    model: Model
    instrument: Instrument
    observations: Sequence[Observation]

    @cached_property
    def columns(self) -> tuple[Column, ...]:
        return tuple(c for c, _ in design.list_base_columns(self.model, self.instrument))

    @cached_property
    def index(self) -> NDArray[np.intp]:
        """(n,): places of the fitted parameters in the parameter vector."""
        return np.array([i for _, i in design.list_base_columns(self.model, self.instrument)])

    @cached_property
    def nominal(self) -> Array:
        return make_vector(self.model, self.instrument)

    @cached_property
    def scale(self) -> Array:
        return np.array([c.scale for c in self.columns])

    def vector(self, x: Array) -> Array:
        """Parameter vector, SI."""
        p = self.nominal.copy()
        p[self.index] += x * self.scale
        return p

    def linearisation(self, noise: Sequence[NoiseModel]) -> Callable[[Array], _Fall]:
        """The fit with a noise as a function of the point about which it is linearised."""
        found = [find_segments(o) for o in self.observations]
        # what an unknown gradient spans of a flight of one segment is the same at every point
        windows = [
            unknown_gradient.make_windows(o, s[0].rows, n) if len(s) == 1 else None
            for o, n, s in zip(self.observations, noise, found, strict=True)
        ]
        return lambda x: self.at(x, noise, windows)

    def at(self, x: Array, noise: Sequence[NoiseModel], windows: Sequence[Sequence[Window] | None]) -> _Fall:
        """Linearised about x."""
        p = self.vector(x)
        places = {o.place for o in self.observations}
        if not all(scale_factor(self.model, p, place) > 0.0 for place in places):
            return self._nowhere(x)
        point = LinearisationPoint(self.model, self.instrument, p, with_candidates=False)
        r_factors, rows = [], 0
        sums = {o.place: np.zeros(len(x) + 1) for o in self.observations}
        for o, n, w in zip(self.observations, noise, windows, strict=True):
            for T, count, part in pass_over(point, o, n, _r_factor, chosen=find_segments(o), windows=w):
                r_factors.append(T)
                rows += count
                sums[o.place] += part
        data = join(r_factors)
        if not np.isfinite(data).all():
            return self._nowhere(x)
        fall = _make_linear(data, -x)
        return _Fall(R=fall.R, y=fall.y, rest=fall.rest, data=data, to_nominal=-x, sums=sums, rows=rows)

    def size(self, noise: Sequence[NoiseModel]) -> float:
        """Root of the mean power of what no column explains, V, lines included."""
        records = [o.record for o in self.observations]
        powers = [n.power * n.swell(r) + n.line_power for n, r in zip(noise, records, strict=True)]
        return float(np.sqrt(np.mean(powers)))

    def _nowhere(self, x: Array) -> _Fall:
        """A point at which the model is no instrument: infinitely far from any record."""
        n = len(x)
        return _Fall(
            R=np.eye(n),
            y=np.zeros(n),
            rest=np.inf,
            data=np.zeros((n + 1, n + 1)),
            to_nominal=-x,
            sums={},
            rows=1,
        )


def estimate_noises(
    model: Model, instrument: Instrument, observations: Sequence[Observation], p: Array
) -> list[NoiseModel]:
    """The noise of every observation: what neither parameters nor candidates explain about a parameter vector, SI."""
    tested = list_tested_columns(model, instrument, [o.record for o in observations])
    everything = LinearisationPoint(model, instrument, p, with_candidates=True, only=tested)
    return [estimate_noise(everything, o) for o in observations]


def fit(
    model: Model,
    instrument: Instrument,
    observations: Sequence[Observation],
    *,
    start: Array | None = None,
    noise: Sequence[NoiseModel] | None = None,
    unweighted: bool = False,
) -> Calibration:
    """Least squares on all flights at once, from the nominal values or from ``start``.

    First every sample weighs the same; from what is left the noise is estimated, and the fit goes on whitened, unless ``unweighted``
    is asked for, so that the rms is as small as it can be.
    """
    task = _Task(model, instrument, observations)
    x = np.zeros(len(task.index)) if start is None else (start - task.nominal)[task.index] / task.scale
    white = [NoiseModel.white(o.record.rate, len(o.series)) for o in observations]
    if noise is None:
        volts = task.linearisation(white)
        size = float(np.sqrt(volts(x).unheld))
        x = minimise(lambda at: volts(at).over(size), x).x
        noise = estimate_noises(model, instrument, observations, task.vector(x))
    if unweighted:
        volts = task.linearisation(white)
        size = max(task.size(noise), float(np.sqrt(volts(x).excess)) / LEAN)
        return _make_calibration(task, minimise(lambda at: volts(at).over(size), x), noise)
    return _make_calibration(task, minimise(task.linearisation(noise), x), noise)


def _make_calibration(task: _Task, found: Minimum[_Fall], noise: Sequence[NoiseModel]) -> Calibration:
    """The end of a fit as parameters, levelled."""
    at = found.at
    step = found.last
    for sums in at.sums.values():
        step = design.level_biases(step, sums, design.find_null_biases(task.columns))
    covariance = _make_linear(at.data / np.sqrt(max(1.0, at.excess)), at.to_nominal).covariance
    return Calibration(
        p=task.vector(found.x + step),
        columns=task.columns,
        index=task.index,
        covariance=covariance,
        noise=tuple(noise),
        rows=at.rows,
        chi2=at.cost,
        excess=at.excess,
        unheld=at.unheld,
        converged=found.converged,
        reason=found.reason,
    )


def _r_factor(piece: Piece) -> tuple[Array, int, Array]:
    return piece.r_factor(), piece.white.shape[1], piece.sums()


def _make_linear(T: Array, to_nominal: Array) -> Linear:
    """The fit of an R factor [base (n) | residual], the prior in it: its centre is ``to_nominal`` away, its width one scale."""
    R = add_prior(T, range(len(to_nominal)), to_nominal)
    return Linear(R[:-1, :-1], R[:-1, -1], float(R[-1, -1] ** 2))


FAR = 5.0
"""Standard errors of the sheet from which a parameter is named: none of a few dozen should be there by chance."""


@dataclass(frozen=True)
class OffSheet:
    """One parameter: its calibrated and the sheet's value in ``unit``, and their distance in the sheet's sigmas."""

    name: str
    accelerometer: int | None
    sigmas: float
    value: float
    sheet: float
    unit: str
    accelerometer_name: str = ""

    def as_json(self) -> dict[str, object]:
        return {
            "name": self.name,
            "accelerometer": self.accelerometer,
            "sigmas": self.sigmas,
            "value": self.value,
            "sheet": self.sheet,
            "unit": self.unit,
            **spell_name(self.accelerometer, self.accelerometer_name),
        }


def measure_to_nominal(model: Model, instrument: Instrument, c: Calibration) -> Array:
    """(n_base,): how far the nominal values are from the calibrated ones, in scales: the prior's centre."""
    scale = np.array([q.scale for q in c.columns])
    return np.asarray((make_vector(model, instrument)[c.index] - c.p[c.index]) / scale)


def list_off_sheet(model: Model, instrument: Instrument, c: Calibration) -> list[OffSheet]:
    """The instrument's parameters that ended more than :data:`FAR` sigmas from their sheet, farthest first."""
    sheet = make_vector(model, instrument)
    found = [
        OffSheet(
            name=q.name,
            accelerometer=q.accelerometer,
            sigmas=float((c.p[k] - sheet[k]) / q.scale) * instrument.widths.get(q.name, 1.0),
            value=float(c.p[k] / q.unit_factor),
            sheet=float(sheet[k] / q.unit_factor),
            unit=q.unit,
            accelerometer_name=q.accelerometer_name,
        )
        for q, k in zip(c.columns, c.index, strict=True)
        if q.effect is None
    ]
    return sorted((x for x in found if abs(x.sigmas) > FAR), key=lambda x: -abs(x.sigmas))


WIDE = 2.0
"""Root mean square of the distances of one kind of parameter, in the sheet's sigmas, from which the sheet is less sure of this kind
than it says (or than is plausible), by that factor."""

STATED = "stated"
"""The kind of all parameters of which the sheet says how sure it is."""

AGAIN = 1.5
"""Factor by which a width must have changed for the fit to be made again: the logarithm of a prior's width hardly matters."""

QUIET = 2.0
"""Excess of chi-square up to which the record says how far off the sheet parameters are; beyond it an effect is missing."""

HELD = 0.5
"""Share of what is left that must be the sheet's doing for a sheet that is less sure to be worth a fit: of what stays however wide it
is (linearised), not even a curved valley takes most."""


def widen_priors(model: Model, instrument: Instrument, c: Calibration) -> Instrument | None:
    """The instrument with each kind of parameter's prior as wide as the record requires, if that is wider than on the sheet.

    The widths are those of greatest evidence (empirical Bayes; MacKay, Neural Computation 4, 1992): the squared distances over the
    number of parameters that the record determines. ``None`` if nothing changes, or if no width brings the residual down to noise.
    """
    if c.unheld > max(QUIET, HELD * c.excess):
        return None
    now, then = instrument.widths, _estimate_widths(model, instrument, c)
    changed = any(
        not 1 / AGAIN < then.get(n, 1.0) / now.get(n, 1.0) < AGAIN for n in dict.fromkeys((*now, *then))
    )
    return replace(instrument, widths=MappingProxyType(then)) if changed else None


def restore_priors(instrument: Instrument, but: Iterable[str] = ()) -> Instrument:
    """The instrument with the priors of its sheet again, ``but`` for those of some parameters."""
    kept = {n: w for n, w in instrument.widths.items() if n in but}
    return replace(instrument, widths=MappingProxyType(kept))


def _estimate_widths(model: Model, instrument: Instrument, c: Calibration) -> dict[str, float]:
    """How many times each prior is wider than on the sheet, at least 1.

    Those of one unit are a kind; all with a sigma on the sheet are another one, doubted only where nothing speaks for an effect. Each
    parameter of an effect is one: the size of a fault is not known in advance.
    """
    kinds = {q.name: STATED if q.name in instrument.sigmas else q.si_unit for q in PARAMETERS}
    kinds |= {q.name: q.name for q in c.columns if q.effect is not None}
    squares = dict.fromkeys(kinds.values(), 0.0)
    told = dict.fromkeys(kinds.values(), 0.0)
    sheet = make_vector(model, instrument)
    for q, k, variance in zip(c.columns, c.index, np.diag(c.covariance), strict=True):
        x = float((c.p[k] - sheet[k]) / q.scale) * instrument.widths.get(q.name, 1.0)
        squares[kinds[q.name]] += x**2
        told[kinds[q.name]] += max(0.0, 1.0 - float(variance))
    width = {k: float(np.sqrt(x / max(told[k], 1.0))) for k, x in squares.items()}
    wide = {k: w >= WIDE and squares[k] >= FAR**2 for k, w in width.items()}
    wide[STATED] = wide.get(STATED, False) and c.excess <= QUIET
    return {n: width[k] for n, k in kinds.items() if wide[k]}


def charge_wider_priors(instrument: Instrument, c: Calibration) -> float:
    """The chi-square price of wider priors: the logarithm of the volume that they add, over the parameters that the record determines."""
    width = np.array([instrument.widths.get(q.name, 1.0) for q in c.columns])
    return float(2.0 * np.log(width) @ np.maximum(0.0, 1.0 - np.diag(c.covariance)))
