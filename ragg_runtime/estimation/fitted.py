"""A model calibrated on flights, with what all tests and scores need."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import series_name
from ragg_runtime.base.progress import one_thread, split_range
from ragg_runtime.estimation import calibration, regressors, whitening
from ragg_runtime.estimation.calibration import QUIET, Calibration, widen_priors
from ragg_runtime.estimation.least_squares import Linear, add_prior, fold, make_prior, pick_columns
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import BLOCKS, Observation
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.estimation.scores import Error, finite, measure_errors, pool_errors
from ragg_runtime.estimation.thinning import leave_out_extrapolated, leave_out_uncertain, measure_beyond
from ragg_runtime.estimation.whitening import PreparedFlight, prepare_flight
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model, make_vector, scale_factor
from ragg_runtime.signals.demodulators import find_demodulator, low_pass

Array = NDArray[np.float64]

FITTED_BLOCKS = tuple(b for b in range(BLOCKS) if (b // 4) % 2 == 0)
# blocks of time on which a held-out fit is made; the others, in turn with them, score it
HELD_OUT_BLOCKS = tuple(b for b in range(BLOCKS) if b not in FITTED_BLOCKS)
TOGETHER = 1 << 27  # residuals that are held in memory together
WIDENED = 3  # most times that a sheet is taken to be less sure than it says


@dataclass(frozen=True)
class Scored:
    """How large one residual is.

    ``held_out`` is over the blocks of time that a held-out fit does not see; ``mean_square`` of each flight, V^2, within the fitted
    band; ``blocks`` (flights, BLOCKS) the rms, V, NaN without valid samples.
    """

    whole: Error
    held_out: Error
    mean_square: tuple[float, ...]
    blocks: Array


@dataclass(frozen=True)
class Fitted:
    """A model fitted to flights, and everything that evidence is read from.

    ``r_factors`` holds for every flight the R factor of its whitened columns [base | candidates | residual]
    in each block of time; all tests are made on them alone. ``sums`` (BLOCKS, size + 1) are those of the plain columns.
    """

    model: Model
    instrument: Instrument
    observations: tuple[Observation, ...]
    calibration: Calibration
    prepared: tuple[PreparedFlight, ...]
    r_factors: tuple[tuple[Array, ...], ...]
    sums: tuple[Array, ...]
    to_nominal: Array
    scales: tuple[float, ...]
    """k_ggi of every observation's output, V/Eo."""

    @property
    def sheet(self) -> Array:
        """(P,): the parameters as in model.toml."""
        return make_vector(self.model, self.instrument)

    @property
    def k_ggi(self) -> float:
        """That of the first."""
        return self.scales[0]

    @property
    def first(self) -> list[int]:
        """Place of each flight's first observation."""
        return [
            n for n, o in enumerate(self.observations) if not n or o.flight != self.observations[n - 1].flight
        ]

    @property
    def flights(self) -> list[Observation]:
        """One observation of each flight, of however many outputs."""
        return [self.observations[n] for n in self.first]

    @property
    def n_base(self) -> int:
        return len(self.calibration.columns)

    @property
    def candidates(self) -> Sequence[Column]:
        """Columns of the candidate effects; none where nothing was prepared for their tests."""
        return self.prepared[0].at.candidates

    @property
    def size(self) -> int:
        """Number of regressors, base and candidates."""
        return int(self.r_factors[0][0].shape[1]) - 1

    @cached_property
    def beyond(self) -> tuple[float, ...]:
        """Mean square, V^2, of what thinning took of each observation: no column reaches there, it is noise."""
        return tuple(measure_beyond(self.model, self.calibration.p, o) for o in self.observations)

    @cached_property
    def data(self) -> Array:
        """R factor of all flights, without the prior."""
        return fold([t for factors in self.r_factors for t in factors])

    @cached_property
    def whole(self) -> Array:
        """R factor of all flights, the prior in it."""
        return fold([self.data, self._prior])

    @cached_property
    def half(self) -> Array:
        """The same over the blocks on which a held-out fit is made."""
        return fold([*(factors[b] for factors in self.r_factors for b in FITTED_BLOCKS), self._prior])

    @property
    def _prior(self) -> Array:
        return make_prior(range(self.n_base), self.size + 1, self.to_nominal)

    def coefficients(self, extra: Sequence[int], *, held_out: bool = False) -> tuple[Array, Array]:
        """Fit of base and ``extra`` candidate regressors, in scales, with its covariance, priors included.

        With ``held_out`` only the blocks of :data:`FITTED_BLOCKS` are fitted. The null biases take the residual's mean.
        """
        T, n = self.half if held_out else self.whole, self.n_base
        picked = [*range(n), *(n + k for k in extra)]
        posterior = Linear(add_prior(pick_columns(T, n, [*picked[n:], -1]), range(n, len(picked))))
        coefficients = posterior.step
        blocks = list(FITTED_BLOCKS if held_out else range(BLOCKS))
        biases = regressors.find_null_biases(self.calibration.columns)
        for place in dict.fromkeys(o.place for o in self.observations):
            parts = [x[blocks] for x, o in zip(self.sums, self.observations, strict=True) if o.place == place]
            sums = np.sum(parts, axis=(0, 1))[[*picked, -1]]
            coefficients = regressors.level_biases(coefficients, sums, biases)
        return coefficients, posterior.covariance

    def vector(self, coefficients: Array, extra: Sequence[int] = ()) -> Array:
        """(size,): coefficients of base and ``extra`` candidates among those of all columns."""
        v = np.zeros(self.size)
        v[: self.n_base] = coefficients[: self.n_base]
        v[[self.n_base + k for k in extra]] = coefficients[self.n_base :]
        return v

    def fit_held_out(self, extra: Sequence[int] = ()) -> Array:
        """(size,): coefficients of all regressors by a fit to the blocks of time :data:`FITTED_BLOCKS`."""
        return self.vector(self.coefficients(extra, held_out=True)[0], extra)

    def residuals(self, v: Array | None = None) -> list[Array]:
        """Residual of G_out, (N,) V, of every flight, also once regressors have coefficients (size,)."""
        v = np.zeros(self.size) if v is None else v
        return [x.residuals(v[None])[0] for x in self.prepared]

    def score(self, vectors: Sequence[Array]) -> list[Scored]:
        """Scores of the residuals with each of these coefficients (size,)."""
        most = max(1, TOGETHER // sum(len(o.record.time) for o in self.observations))
        scores = []
        for part in split_range(len(vectors), most):
            scores += self._score_each([x.residuals(np.stack(vectors[part])) for x in self.prepared])
        return scores

    def score_residuals(self, residuals: Sequence[Array]) -> Scored:
        """The score of residuals (N,), V, one of each flight."""
        return self._score_each([e[None] for e in residuals])[0]

    def _score_each(self, residuals: Sequence[Array]) -> list[Scored]:
        """The score of each of k residuals, (k, N) of every flight."""
        blocks, squares, samples, errors = [], [], [], []
        for x, e, k_ggi, beyond in zip(self.prepared, residuals, self.scales, self.beyond, strict=True):
            r = x.observation.record
            of_block = np.repeat(np.arange(BLOCKS), np.diff(x.edges))
            held_out = np.isin(of_block, HELD_OUT_BLOCKS)
            power = np.array([np.bincount(of_block, one**2, BLOCKS) for one in e])
            count = np.bincount(of_block, r.valid, BLOCKS)
            with np.errstate(invalid="ignore"):
                blocks.append(np.sqrt(power / count + beyond))
            squares.append(np.sum(power, axis=1) / np.sum(count))
            samples.append([np.sum(r.valid), np.sum(r.valid & held_out)])
            errors.append(measure_errors(e, r, k_ggi, [np.ones_like(held_out), held_out], beyond))
        scores = []
        for n in range(len(residuals[0])):
            groups = zip(*(x[n] for x in errors), strict=True)
            whole, held = (pool_errors(x, w) for x, w in zip(groups, np.transpose(samples), strict=True))
            squared = tuple(float(x[n]) for x in squares)
            scores.append(Scored(whole, held, squared, np.stack([x[n] for x in blocks])))
        return scores


def calibrate_certain(
    model: Model,
    instrument: Instrument,
    observations: Sequence[Observation],
    *,
    noise: Sequence[NoiseModel] | None = None,
    start: Array | None = None,
    unweighted: bool = False,
) -> tuple[list[Observation], Instrument, Calibration]:
    """The parameters, the samples that the model describes, which are fitted, and the instrument with priors as wide as these require."""
    fit = partial(calibrate, model, instrument, noise=noise, start=start, unweighted=unweighted)
    observations = leave_out_uncertain(model, instrument, observations)
    result = fit(observations)
    kept = leave_out_extrapolated(model, result[1].p, observations)
    if all(a is b for a, b in zip(kept, observations, strict=True)):
        return (observations, *result)
    return (kept, *fit(kept))


def calibrate(
    model: Model,
    instrument: Instrument,
    observations: Sequence[Observation],
    *,
    noise: Sequence[NoiseModel] | None = None,
    start: Array | None = None,
    unweighted: bool = False,
) -> tuple[Instrument, Calibration]:
    """The parameters, and the instrument with wider priors where these bring the residual down to noise."""
    fit = partial(calibration.fit, model, observations=observations, noise=noise, unweighted=unweighted)
    first = instrument, (c := fit(instrument, start=start))
    for _ in range(WIDENED):
        wider = widen_priors(model, instrument, c) if c.converged else None
        if wider is None:  # or where it has not come to an optimum, which alone tells how wide
            break
        instrument, c = wider, fit(wider, start=c.p)
    return (instrument, c) if c.converged and c.excess <= QUIET else first


@one_thread
def fit(
    model: Model,
    instrument: Instrument,
    observations: Sequence[Observation],
    noise: Sequence[NoiseModel] | None = None,
    start: Array | None = None,
    *,
    unweighted: bool = False,
    candidates: bool = True,
) -> Fitted:
    """Calibrate a model on flights and prepare the evidence.

    ``noise`` is estimated unless given; ``unweighted``: all samples weigh the same. Without ``candidates`` no effect can be tested.
    """
    observations, instrument, c = calibrate_certain(
        model, instrument, observations, noise=noise, start=start, unweighted=unweighted
    )
    return prepare_evidence(model, instrument, observations, c, candidates=candidates)


@one_thread
def prepare_evidence(
    model: Model,
    instrument: Instrument,
    observations: Sequence[Observation],
    c: Calibration,
    *,
    candidates: bool = True,
) -> Fitted:
    """The evidence about a calibration, however it was found; of its parameters alone without ``candidates``."""
    tested = regressors.list_tested_columns(model, instrument, [o.record for o in observations])
    at = regressors.make_point(model, instrument, c.p, tested if candidates else ())
    prepared = tuple(prepare_flight(o, noise, at) for o, noise in zip(observations, c.noise, strict=True))
    r_factors, sums = zip(*(whitening.factor_blocks(x) for x in prepared), strict=True)
    return Fitted(
        model=model,
        instrument=instrument,
        observations=tuple(observations),
        calibration=c,
        prepared=prepared,
        r_factors=r_factors,
        sums=sums,
        to_nominal=calibration.measure_to_nominal(model, instrument, c),
        scales=tuple(scale_factor(model, c.p, o.place) for o in observations),
    )


def release_held(f: Fitted, *, candidates: bool = False) -> Fitted:
    """The evidence about the same values with the coefficients that were held among the columns: what is reported are combinations
    that the record determines of all.
    """
    if not f.instrument.held:
        return f
    instrument = replace(f.instrument, held=frozenset())
    columns, index = zip(*regressors.list_base_columns(f.model, instrument), strict=True)
    c = replace(f.calibration, columns=columns, index=np.array(index, dtype=np.intp))
    free = prepare_evidence(f.model, instrument, f.observations, c, candidates=candidates)
    return replace(free, calibration=replace(c, covariance=free.coefficients(())[1]))


def measure_swell(f: Fitted) -> float:
    """rms of all the noise over that of the floor."""
    return float(np.sqrt(np.mean([x.noise.swell(x.observation.record) for x in f.prepared])))


def measure_lines(f: Fitted) -> float:
    """rms of the lines that are taken for noise, Eo."""
    power = [x.noise.line_power_of(x.observation.signs) for x in f.prepared]
    return float(np.sqrt(np.mean(power / np.square(f.scales))))


def estimate_variance(x: PreparedFlight) -> float:
    """Variance of the estimated noise of what was observed as G_out, V^2."""
    share = x.observation.recorded.noise_share(x.observation.record)
    return share * x.noise.variance(x.observation.signs)


def measure_noise_floor(f: Fitted) -> float:
    """rms of the noise of G_out before demodulation, Eo."""
    power = np.add([estimate_variance(x) for x in f.prepared], f.beyond)
    return float(np.sqrt(np.mean(power / np.square(f.scales))))


def compute_noise_psd(w: PreparedFlight, spin: float, f: Array) -> Array:
    """One-sided, V^2/Hz; where only the channels were recorded, through their low-pass about 2 spin."""
    psd = w.noise_psd(f)
    if not w.observation.recorded.demodulated:
        return psd
    r = w.observation.record
    H = r.low_pass.response(np.minimum(np.abs(f - 2 * spin), r.rate / 2))
    return np.asarray(psd * np.abs(H) ** 2)


def predict_demodulated_noise(w: PreparedFlight, k_ggi: float, multiple: int, amplitude: float) -> float:
    """Standard deviation, Eo, of LP(amplitude cos(2 pi multiple spin t) noise)."""
    r = w.observation.record
    spin, slowest = abs(r.spin_frequency), r.rate / len(r.time)  # what is slower is not in the record

    def psd(frequency: Array) -> Array:
        return compute_noise_psd(w, spin, np.maximum(frequency, slowest))

    power = find_demodulator("fir", r.rate).pass_power(psd, multiple * spin)
    share = 0.25 if multiple else 0.5  # of the square of the amplitude: of a wave half of it is on average
    return amplitude * float(np.sqrt(share * power)) / k_ggi


def predict_channel_noise(f: Fitted) -> tuple[float, float]:
    """Standard deviation of (inline, cross) that the noise alone would give, Eo; NaN if the low-pass is too long."""
    values = [
        [predict_demodulated_noise(w, k, 2, a) for a in (4.0, 2.0)]
        for w, k in zip(f.prepared, f.scales, strict=True)
        if w.observation.record.turning and _is_long(w)
    ]
    if not values:
        return float("nan"), float("nan")
    inline, cross = np.sqrt(np.mean(np.square(values), axis=0))
    return float(inline), float(cross)


def list_noise_floor(f: Fitted, rms_Eo: float) -> dict[str, float | None]:
    """The noise floor as JSON: before demodulation (Eo), and what the noise alone would give in the channels."""
    inline, cross = predict_channel_noise(f)
    return {"rms_Eo": rms_Eo, "inline_Eo": finite(inline), "cross_Eo": finite(cross)}


def predict_harmonic_noise(f: Fitted, harmonics: Iterable[str]) -> dict[str, float]:
    """The same at harmonics of the spin (const, cos 1 ...), Eo."""
    works = [(w, s) for w, s in zip(f.prepared, f.scales, strict=True) if _is_long(w)]
    noise = {}
    for h in harmonics:
        _, k = series_name.harmonic(h)
        squares = [predict_demodulated_noise(w, s, k, 2.0 if k else 1.0) ** 2 for w, s in works]
        noise[h] = float(np.sqrt(np.mean(squares))) if squares else float("nan")
    return noise


def _is_long(w: PreparedFlight) -> bool:
    r = w.observation.record
    return len(r.time) >= 2 * len(low_pass(r.rate))
