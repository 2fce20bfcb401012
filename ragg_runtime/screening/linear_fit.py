"""How well a model can explain some rows of a flight if its parameters may move as far as is plausible: one number.

One linear fit about the test sheet, with every parameter's prior, robust against outliers, the size of the
residual being the only thing unknown. It costs milliseconds; it is no calibration. The number is minus the log
evidence of the fit (D. MacKay, Neural Computation 4, 1992, 415): all that may be wrong with a record, a unit, an axis, a
clock or the sheet itself, is compared by it. Rows are taken as they are or with a mistake undone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from generated.output_effects.saturation import clipped
from ragg_runtime.estimation.least_squares import compute_r_factor
from ragg_runtime.estimation.regressors import Column, list_base_columns, list_own_columns, put_derivatives
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import Disc, Output
from ragg_runtime.io import Flight
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model.model import Model, evaluate_voltages, make_vector, scale_factor
from ragg_runtime.model.record import (
    Record,
    RecordedSeries,
    disc_angle,
    find_recorded,
    make_spin,
    record,
    strip_derivative,
)
from ragg_runtime.signals.fir import convolve

Array = NDArray[np.float64]
Index = NDArray[np.intp]
Mask = NDArray[np.bool_]

MOST = 1500  # rows that a fit takes: many times the number of parameters
# samples of demodulated channels that a stretch holds at least, where they were recorded more seldom than the motion
WANTED = 128
TELLING = 512  # samples of demodulated channels that are looked at of a stretch: neighbours are much alike


@dataclass(frozen=True)
class Rows:
    """n rows of a flight, not necessarily neighbours (neighbours where only the channels are recorded)."""

    sampler: Sampler  # what they are taken from
    data: Array  # (m, n) V: the output; of channels k_ggi (inline/2, -cross)
    record: Record  # their motion and disc angle; valid where the output is there

    def change(self, columns: Mapping[str, Array]) -> Rows:
        """The same with other columns (n,) of motion, or of the disc angle."""
        return replace(self, record=replace(self.record, wide={**self.record.wide, **columns}))

    def observe(self, raw: Array) -> Array:
        """(..., m, n): an output as it is recorded, from what it is before demodulation."""
        if not self.sampler.recorded.demodulated:
            return raw
        cosine, sine = self.record.quadratures
        return convolve(2 * raw * np.stack([sine, cosine]), self.record.low_pass.centred, "same")

    @property
    def inner(self) -> Index:
        """Rows that are fitted: of channels those where the demodulator has seen enough of the record on either side."""
        usable, edge = self.record.valid, self.sampler.reach
        if not self.sampler.recorded.demodulated:
            return np.arange(len(usable))
        rows = edge + np.flatnonzero(usable[edge : len(usable) - edge])
        return rows[:: max(1, len(rows) // TELLING)]

    def predict(self, p: Array) -> Array:
        """(m, n) V: the output of a model with parameters p, SI, before any demodulation."""
        s = self.sampler
        return s.recorded.of_voltages(s.output, evaluate_voltages(s.model.chain, self.record, p, s.output))

    @property
    def gradient_recorded(self) -> bool:
        return all(g in self.record.wide for g in GRADIENT)


@dataclass(frozen=True)
class Sampler:
    """Takes rows of an output of a flight, for fits of a model."""

    model: Model
    instrument: Instrument
    flight: Flight
    place: int  # of the output
    recorded: RecordedSeries  # the form in which it is recorded
    columns: tuple[str, ...]  # which hold it
    record: Record  # the whole flight, with the time derivatives that the model asks for; valid where the output is there and not saturated

    def with_flight(self, flight: Flight) -> Sampler:
        """The same of another flight."""
        return make_sampler(self.model, self.instrument, flight, self.place)

    @property
    def usable(self) -> Mask:
        return self.record.valid

    @property
    def output(self) -> Output:
        return self.instrument.layout.outputs[self.place]

    @property
    def disc(self) -> Disc:
        return self.instrument.layout.discs[self.output.disc]

    @property
    def has_encoder(self) -> bool:
        return self.disc.angle_column in self.flight.channels

    @property
    def reach(self) -> int:
        """Samples on either side that a recorded value of the output is made of."""
        return len(self.record.low_pass.centred) // 2 if self.recorded.demodulated else 0

    def rows(self, first: int = 0, last: int | None = None, most: int = MOST) -> Index:
        """At most ``most`` usable rows of a segment; neighbours where only the channels are recorded."""
        if self.recorded.demodulated:
            whole = np.arange(first, len(self.usable) if last is None else last)
            spacing, taps = len(self.usable) / max(float(np.sum(self.usable)), 1.0), 2 * self.reach + 1
            return whole[: max(most, taps + max(2 * taps, round(WANTED * spacing)))]
        positions = np.flatnonzero(self.usable[first:last]) + first
        return positions[np.linspace(0, len(positions) - 1, min(most, len(positions))).astype(np.intp)]

    def take(
        self,
        rows: Index | None = None,
        *,
        motion_later: int = 0,
        of: Sequence[str] = ("a", "omega", "omegadot", "Gamma"),
        output_later: int = 0,
        spin_frequency: float | None = None,
        phase: float | Array = 0.0,
    ) -> Rows:
        """Rows of the flight.

        Parameters
        ----------
        rows
            (n,) which; ``None``: as many as a fit takes.
        motion_later, of, output_later
            Samples by which the quantities ``of`` motion, or the output, are taken later than recorded; rows that would lie outside
            are left out.
        spin_frequency
            Hz, in place of the instrument's (or the encoder's angle).
        phase
            rad, added to the disc angle; one, or (n,).
        """
        r, n = self.record, len(self.flight)
        rows = self.rows() if rows is None else rows
        at = np.array([rows, rows + motion_later, rows + output_later])
        inside = ((at >= 0) & (at < n)).all(axis=0)
        rows, moved_to, output_at = at[:, inside]
        time = r.time[rows]
        wide = {
            name: v[moved_to if {find_stem(name), strip_derivative(name)} & {*of} else rows]
            for name, v in r.wide.items()
        }
        phi = wide.get(r.angle_column)
        if phi is None or spin_frequency is not None:
            f = r.spin_frequency if spin_frequency is None else spin_frequency
            phi = disc_angle(time, f, r.start)
            wide |= make_spin(f, len(rows))
        wide[r.angle_column] = phi + (phase[inside] if isinstance(phase, np.ndarray) else phase)
        data = np.nan_to_num(np.stack([self.flight.outputs[v][output_at] for v in self.columns]), copy=False)
        if self.recorded.demodulated:  # inline and cross
            data *= self.instrument.scale_factor * np.array([[0.5], [-1.0]])
        return Rows(self, data, replace(r, time=time, wide=wide, valid=self.usable[output_at]))

    def fit(self, rows: Index | None = None, **options: Any) -> LinearFit:
        """What the model leaves of rows, taken with these options."""
        return fit_rows(self.take(rows, **options))


def find_stem(name: str) -> str:
    """``a`` of ``a_x`` and of its time derivative ``d_a_x``."""
    return strip_derivative(name).rsplit("_", 1)[0]


def make_sampler(model: Model, instrument: Instrument, flight: Flight, place: int = 0) -> Sampler:
    """Prepare a flight for taking rows of its output ``place``, which it must have."""
    layout = instrument.layout
    output = layout.outputs[place]
    form = find_recorded(flight, layout, place)
    columns = form and form.columns(layout, output, flight.outputs)
    assert form and columns
    usable = flight.valid & np.isfinite([flight.outputs[name] for name in columns]).all(axis=0)
    if output.name in flight.outputs and usable.any():
        usable &= ~clipped(flight.outputs[output.name], usable)
    r = record(flight, instrument, place)
    derivatives = {n: x for n in model.chain.INPUTS if n not in r.wide and (x := r.series(n)) is not None}
    r = replace(r, wide={**r.wide, **derivatives}, valid=usable)
    return Sampler(model, instrument, flight, place, form, columns, r)


GRADIENT_SCALE = 1e4  # prior of a gravity gradient that was not recorded, Eo
OUTLIER = 8.0  # residual, in robust standard deviations, from which a sample is left out of the fit
# quantile of the residuals that tells their size. Not the median: where the residual is a beat rather than noise that says little.
QUARTILE = 0.75
QUARTILE_OF_NORMAL = 1.15  # the same quantile of the modulus of a normal variable, in standard deviations
RARE = 0.01  # probability of an outlier: what recorders' glitches make

INDEPENDENT = 150.0
"""Rows that a fit counts as, however many it takes: what a wrong model leaves is a wave and no noise. Measured on the benchmark's
flights, two choices of rows tell the residual of a record to 10 %, and the parameters' squared moves to 30: as many rows weigh
both alike (2 x 150 log 1.1)."""

SETTLED = 0.999  # factor by which the noise must still fall for the estimate to go on


@dataclass(frozen=True)
class LinearFit:
    """What a model leaves of rows of a record once its parameters are fitted."""

    rms: float  # of the residual without its outliers, Eo
    size: float  # of the output about its mean, Eo
    p: Array  # fitted parameter vector of the model's chain, SI
    gradient: Array  # (2,): the constant gradient, in GRADIENT_SCALE; () where it was recorded
    surprise: float  # sum of the squares of the parameters' moves, in plausible sizes
    # what the record determines of the parameters: the logarithm of prior over posterior volume, the price of wide priors
    volume: float
    kept: float = 1.0  # share of the rows that are no outliers

    @property
    def share(self) -> float:
        """Residual over output: the same in any unit of the output."""
        return self.rms / self.size if self.size > 0 else 1.0

    @property
    def misfit(self) -> float:
        """Minus the log likelihood of a row: 0 of a model that predicts nothing. An outlier is explained by nothing, and is rare."""
        return self.kept * float(np.log(max(self.share, 1e-300))) - (1.0 - self.kept) * float(np.log(RARE))

    @property
    def score(self) -> float:
        """Minus the log evidence, with :data:`INDEPENDENT` rows; the smaller the better."""
        return INDEPENDENT * self.misfit + self.surprise / 2 + self.volume


@dataclass(frozen=True)
class Hypothesis:
    """What may be wrong with a record or its sheet."""

    what: str  # in words
    remedy: str
    fitted: LinearFit  # what the model leaves if this is so
    # what orders hypotheses that explain as much, the plainest first: far below mistakes.AS_GOOD
    cost: float = 0.0
    # record (units, signs, axes, clock: the record is refused), shift (motion and output apart in time), origin (the disc angle counts
    # from elsewhere), losses (rows are missing all along), part (between two instants) or sheet (its priors are too narrow)
    kind: str = "record"
    effects: tuple[str, ...] = ()  # ids of those that describe the same
    # whether it is enough that the parameters stay closer to the sheet; a mistake of timing must leave less
    calming: bool = False

    def score(self, before: LinearFit) -> float:
        """Minus the log evidence: one number for any mistake; ``before``: the record as it is."""
        calmed = 0.0 if self.calming else max(0.0, before.surprise - self.fitted.surprise)
        return self.fitted.score + self.cost + calmed / 2


def fit_rows(rows: Rows) -> LinearFit:
    """Fit the model's parameters about the instrument's values, with their priors."""
    s, p = rows.sampler, make_vector(rows.sampler.model, rows.sampler.instrument)
    X, y = (x.reshape(*x.shape[:-2], -1) for x in linearise(rows))
    theta, kept, volume = fit_robustly(X, y)
    size = rows.data[:, rows.inner] / scale_factor(s.model, p, s.place)
    size = (size - np.mean(size, axis=1, keepdims=True)).reshape(-1)
    columns = list_columns(s)
    moves = theta[: len(columns)]
    for (column, place), move in zip(columns, moves, strict=True):
        p[place] += move * column.scale
    return LinearFit(
        rms=float(np.sqrt(np.mean((y - theta @ X)[kept] ** 2))),
        size=float(np.sqrt(np.mean(size[kept] ** 2))),
        p=p,
        gradient=theta[len(columns) :],
        surprise=float(np.sum(moves**2)),
        volume=volume,
        kept=float(np.mean(kept)),
    )


def list_columns(s: Sampler) -> list[tuple[Column, int]]:
    """The parameters of an output, each with its place in the parameter vector."""
    base = list_base_columns(s.model, s.instrument)
    return [base[k] for k in list_own_columns([c for c, _ in base], s.instrument, s.place)]


def linearise(rows: Rows) -> tuple[Array, Array]:
    """Derivatives of the output by every parameter, times the width of its prior, and by a gradient that was not recorded,
    (n, m, rows); and the residual at the sheet's values, (m, rows); Eo, at those of the rows that are fitted.
    """
    s, p = rows.sampler, make_vector(rows.sampler.model, rows.sampler.instrument)
    nominal, parameters = rows.predict(p), [c for c, _ in list_columns(s)]
    columns = np.zeros((len(parameters), *nominal.shape))
    where = (rows.record.time, rows.record.inputs(s.model.chain), rows.record.phi)
    put_derivatives(columns, s.model.chain, parameters, where, p, s.recorded, s.output)
    eotvos = scale_factor(s.model, p, s.place)
    gradient = () if rows.gradient_recorded else (_make_gradient(rows),)
    X, y = rows.observe(np.concatenate([columns / eotvos, *gradient])), rows.data - rows.observe(nominal)
    return X[..., rows.inner], y[:, rows.inner] / eotvos


def compute_residual(rows: Rows, fitted: LinearFit) -> Array:
    """(m, n) Eo: what a fitted model leaves of rows of an output that is not demodulated."""
    left = (rows.data - rows.predict(fitted.p)) / scale_factor(
        rows.sampler.model, fitted.p, rows.sampler.place
    )
    return left - fitted.gradient @ _make_gradient(rows).swapaxes(0, 1) if len(fitted.gradient) else left


def _make_gradient(rows: Rows) -> Array:
    """(2, m, N): columns of a constant gradient, before demodulation."""
    o = rows.sampler.output
    share = np.array(o.carriers) * np.array(o.radii) / max((*o.radii, 1e-300)) / len(o.members)
    wave = GRADIENT_SCALE * share[:, None] * np.exp(2j * rows.record.phi)
    return np.stack([rows.sampler.recorded.of_voltages(o, x) for x in (wave.imag, wave.real)])


def find_least(cost: Callable[[float], float], grid: NDArray[np.floating[Any]], finest: float) -> float:
    """Where a cost is least: on an even grid, then beside the best, at half the distance each time, down to ``finest``."""
    tried, step = {float(x): cost(float(x)) for x in grid}, float(grid[1] - grid[0])
    best = min(tried, key=tried.__getitem__)
    while step > finest:
        step /= 2
        tried |= {x: cost(x) for x in (best - step, best + step)}
        best = min(tried, key=tried.__getitem__)
    return best


def find_inliers(residual: Array) -> NDArray[np.bool_]:
    """Which residuals are no outliers, by their moduli, (..., rows)."""
    return np.asarray(residual <= OUTLIER * float(np.quantile(residual, QUARTILE)) / QUARTILE_OF_NORMAL)


def fit_robustly(X: Array, y: Array) -> tuple[Array, NDArray[np.bool_], float]:
    """Coefficients (n,) of columns X (n, rows), the rows that are no outliers of the fit, and the information about the coefficients."""
    kept = np.ones(len(y), dtype=np.bool_)
    theta, volume = fit_shrunken(X, y)
    for _ in range(10):
        residual = np.abs(y - theta @ X)
        inliers = find_inliers(residual)
        if np.array_equal(inliers, kept) or np.sum(inliers) < 2 * len(X):
            break
        kept = inliers
        theta, volume = fit_shrunken(X[:, kept], y[kept])
    return theta, kept, volume


def fit_shrunken(X: Array, y: Array) -> tuple[Array, float]:
    """Coefficients (n,) of columns X (n, rows), each with a prior of unit width, and y's information about them; y's noise is estimated.

    The noise is what the fit leaves: starting from "all is noise" it falls until fit and noise agree.
    """
    R = compute_r_factor(np.vstack([X, y]))
    n = len(X)
    U, s, Vt = np.linalg.svd(R[:n, :n])
    d = U.T @ R[:n, n]
    unexplained = float(R[n, n] ** 2)
    noise = max(float(np.mean(y**2)), 1e-30)
    for _ in range(200):
        residual = d * noise / (s**2 + noise)
        estimate = max((float(np.sum(residual**2)) + unexplained) / len(y), 1e-30)
        if estimate > SETTLED * noise:
            break
        noise = estimate
    volume = 0.5 * float(np.sum(np.log1p(s**2 * INDEPENDENT / (len(y) * noise))))
    return np.asarray(Vt.T @ (d * s / (s**2 + noise))), volume
