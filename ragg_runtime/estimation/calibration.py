"""Fit a model's parameters to flights, each with a prior about the test sheet's value, as wide as the sheet or the record gives."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property, partial
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.least_squares import Linear, add_prior, join, minimise
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.noise_estimate import estimate_noise
from ragg_runtime.estimation.observation import Observation
from ragg_runtime.estimation.regressors import (
    Column,
    LinearisationPoint,
    find_null_biases,
    level_biases,
    list_base_columns,
    list_tested_columns,
    make_point,
    spell_name,
)
from ragg_runtime.estimation.unknown_gradient import Window, make_windows
from ragg_runtime.estimation.whitening import Piece, pass_over
from ragg_runtime.instrument.instrument import PARAMETERS, Instrument
from ragg_runtime.model.memory import allows_memories
from ragg_runtime.model.model import Model, make_vector, scale_factor

Array = NDArray[np.float64]

# in an unweighted fit the noise counts as no less than what is left over this: the prior then weighs little, but keeps parameters from
# drifting
LEAN = 10.0


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
    """A fit linearised about a point: R factor ``data`` (n + 1, n + 1) of [base | residual] without the prior, which is in ``T``, the
    ``sums`` (n + 1,), V, of the columns and residual of each output, and the number of whitened ``rows``.
    """

    data: Array
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


# of every observation its noise, and what an unknown gradient spans by that in each segment, whatever the parameters are
Weights = Sequence[tuple[NoiseModel, Sequence[Sequence[Window]]]]


@dataclass(frozen=True)
class _Task:
    """What is fitted: chi-square as a function of the parameters' distance x (n,) from the sheet, in scales."""

    model: Model
    observations: Sequence[Observation]
    nominal: Array
    columns: tuple[Column, ...]
    index: NDArray[np.intp]

    @cached_property
    def scale(self) -> Array:
        return np.array([c.scale for c in self.columns])

    def vector(self, x: Array) -> Array:
        """Parameter vector, SI."""
        p = self.nominal.copy()
        p[self.index] += x * self.scale
        return p

    def weigh(self, noise: Sequence[NoiseModel] | None) -> Weights:
        """The weights by a noise; ``None``: by white noise of one volt in every series."""
        white = [NoiseModel.white(o.record.rate, len(o.series)) for o in self.observations]
        pairs = zip(self.observations, white if noise is None else noise, strict=True)
        return [(n, [[w.lean() for w in make_windows(o, x, n)] for x in o.segments]) for o, n in pairs]

    def linearise(self, x: Array, weights: Weights, size: float = 1.0) -> _Fall:
        """The fit about x, with noise ``size`` times that of the weights; where the model is no instrument it is infinitely far from any
        record.
        """
        p, n = self.vector(x), len(x)
        data, rows = np.full((n + 1, n + 1), np.nan), 0
        sums = {o.place: np.zeros(n + 1) for o in self.observations}
        scaled = all(scale_factor(self.model, p, place) > 0.0 for place in sums)
        if scaled and allows_memories(self.model, p):
            point, r_factors = LinearisationPoint(self.model, p, self.columns), []
            for o, (noise, spanned) in zip(self.observations, weights, strict=True):
                for T, count, part in pass_over(point, o, noise, _reduce_piece, spanned=spanned):
                    r_factors.append(T)
                    rows += count
                    sums[o.place] += part
            data = join(r_factors) / size
        if not np.isfinite(data).all():
            return _Fall(np.diag([*np.ones(n), np.inf]), np.zeros_like(data), {}, 1)
        return _Fall(add_prior(data, range(n), -x), data, sums, rows)


def estimate_noises(
    model: Model, instrument: Instrument, observations: Sequence[Observation], p: Array
) -> list[NoiseModel]:
    """The noise of every observation: what neither parameters nor candidates explain about a parameter vector, SI."""
    tested = list_tested_columns(model, instrument, [o.record for o in observations])
    at = make_point(model, instrument, p, tested)
    return [estimate_noise(at, o) for o in observations]


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
    columns, index = zip(*list_base_columns(model, instrument), strict=True)
    task = _Task(model, observations, make_vector(model, instrument), columns, np.array(index))
    x = np.zeros(len(index)) if start is None else (start - task.nominal)[task.index] / task.scale
    if noise is None:
        even = task.weigh(None)
        size = float(np.sqrt(task.linearise(x, even).unheld))
        x = minimise(partial(task.linearise, weights=even, size=size), x).x
        noise = estimate_noises(model, instrument, observations, task.vector(x))
    weights, size = task.weigh(None if unweighted else noise), 1.0
    if unweighted:
        size = float(np.sqrt(task.linearise(x, weights).excess)) / LEAN
        pairs = [(n, o.record) for n, o in zip(noise, observations, strict=True)]
        power = np.mean([n.power * n.swell(r) + n.line_power for n, r in pairs])
        size = max(size, float(np.sqrt(power)))
    minimum = minimise(partial(task.linearise, weights=weights, size=size), x)
    at, step = minimum.at, minimum.last
    for sums in at.sums.values():
        step = level_biases(step, sums, find_null_biases(task.columns))
    posterior = Linear(add_prior(at.data / np.sqrt(max(1.0, at.excess)), range(len(x))))
    return Calibration(
        p=task.vector(minimum.x + step),
        columns=task.columns,
        index=task.index,
        covariance=posterior.covariance,
        noise=tuple(noise),
        rows=at.rows,
        chi2=at.cost,
        excess=at.excess,
        unheld=at.unheld,
        converged=minimum.converged,
        reason=minimum.reason,
    )


def _reduce_piece(piece: Piece) -> tuple[Array, int, Array]:
    return piece.r_factor(), piece.white.shape[1], piece.sums()


# standard errors of the sheet from which a parameter is named: none of a few dozen should be there by chance
FAR = 5.0


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
        name = spell_name(self.accelerometer, self.accelerometer_name)
        return {k: v for k, v in asdict(self).items() if k != "accelerometer_name"} | name


def measure_to_nominal(model: Model, instrument: Instrument, c: Calibration) -> Array:
    """(n_base,): how far the nominal values are from the calibrated ones, in scales: the prior's centre."""
    scale = np.array([q.scale for q in c.columns])
    return np.asarray((make_vector(model, instrument)[c.index] - c.p[c.index]) / scale)


def list_off_sheet(model: Model, instrument: Instrument, c: Calibration) -> list[OffSheet]:
    """The instrument's parameters that ended more than :data:`FAR` sigmas from their sheet, farthest first."""
    sheet, to_nominal = make_vector(model, instrument), measure_to_nominal(model, instrument, c)
    parameters = [
        OffSheet(
            name=q.name,
            accelerometer=q.accelerometer,
            sigmas=-float(far) * instrument.widths.get(q.name, 1.0),
            value=float(c.p[k] / q.unit_factor),
            sheet=float(sheet[k] / q.unit_factor),
            unit=q.unit,
            accelerometer_name=q.accelerometer_name,
        )
        for q, k, far in zip(c.columns, c.index, to_nominal, strict=True)
        if q.effect is None
    ]
    return sorted((x for x in parameters if abs(x.sigmas) > FAR), key=lambda x: -abs(x.sigmas))


# root mean square of the distances of one kind of parameter, in the sheet's sigmas, from which the sheet is less sure of this kind
# than it says (or than is plausible), by that factor
WIDE = 2.0
STATED = "stated"  # the kind of all parameters of which the sheet says how sure it is
# factor by which a width must have changed for the fit to be made again: the logarithm of a prior's width hardly matters
AGAIN = 1.5
# excess of chi-square up to which the record says how far off the sheet parameters are; beyond it an effect is missing
QUIET = 2.0

# share of what is left that must be the sheet's doing for a sheet that is less sure to be worth a fit: of what stays however wide it
# is (linearised), not even a curved valley takes most
HELD = 0.5


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
    freedom = dict.fromkeys(kinds.values(), 0.0)
    to_nominal = measure_to_nominal(model, instrument, c)
    for q, far, variance in zip(c.columns, to_nominal, np.diag(c.covariance), strict=True):
        squares[kinds[q.name]] += float(far * instrument.widths.get(q.name, 1.0)) ** 2
        freedom[kinds[q.name]] += max(0.0, 1.0 - float(variance))
    width = {k: float(np.sqrt(x / max(freedom[k], 1.0))) for k, x in squares.items()}
    wide = {k: w >= WIDE and squares[k] >= FAR**2 for k, w in width.items()}
    wide[STATED] = wide.get(STATED, False) and c.excess <= QUIET
    return {n: width[k] for n, k in kinds.items() if wide[k]}


def measure_deviance(instrument: Instrument, c: Calibration) -> float:
    """Chi-square of a fit with the price of wider priors: the logarithm of the volume that they add, over the parameters that the
    record determines.
    """
    width = np.array([instrument.widths.get(q.name, 1.0) for q in c.columns])
    return c.chi2 + float(2.0 * np.log(width) @ np.maximum(0.0, 1.0 - np.diag(c.covariance)))
