"""Time derivatives of uniformly sampled records; of a recorded angular rate, and where it can be relied upon."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache

import numpy as np
import scipy  # its parts are loaded when they are first used: commands without a flight need none
from numpy.typing import NDArray

from ragg_runtime.signals.fir import fill_gaps

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

WINDOW = 25  # samples that enter one derivative
# end of the band for which the derivative is designed, of the Nyquist frequency; at an edge a wider one would multiply noise by 200
BAND, EDGE_BAND = 0.65, 0.42

_EDGE = 6  # samples at either end where the window is so one-sided that noise needs holding down
_POLYNOMIAL = 4  # polynomials up to this degree are differentiated exactly


def differentiate(x: Array, rate: float) -> Array:
    """Time derivative of ``x`` along its last axis, in units of x per second.

    A window of 25 samples, weighted by least squares for motion below 65 % of the Nyquist frequency, exact
    for polynomials up to the fourth degree. Error over amplitude of the derivative, of sines up to 40 % of
    Nyquist: below 3e-6 with six samples or more on either side; towards an end or a gap 5e-5, the last
    sample but one 1.5e-4, the last 1e-3. White noise of ``x`` grows by 1.5 ``rate`` inside, 3 ``rate`` at the
    seventh sample, 6 ``rate`` at the last but one, 30 ``rate`` at the last. Above the band this is no derivative.

    Parameters
    ----------
    x
        (..., N), NaN where there is no sample. Each run of samples is differentiated by itself.
    rate
        Sampling rate, Hz.

    Returns
    -------
    (..., N); NaN at missing samples and in runs of a single sample.
    """
    result = np.full_like(x, np.nan)
    for run in runs(np.atleast_1d(np.isfinite(x).all(axis=tuple(range(x.ndim - 1))))):
        result[..., run] = _differentiate_run(x[..., run]) * rate
    return result


def runs(present: Mask, shortest: int = 1) -> list[slice]:
    """The contiguous runs of True at least ``shortest`` long, in order."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], present.astype(np.int8), [0]])))
    return [slice(int(a), int(b)) for a, b in edges.reshape(-1, 2) if b - a >= shortest]


def find_short_runs(x: Mask, longest: int) -> Mask:
    """(N,): which are True in a run of at most so many."""
    short = np.array(x)
    for run in runs(x, longest + 1):
        short[run] = False
    return short


def _differentiate_run(x: Array) -> Array:
    """Derivative per sample of an uninterrupted run."""
    n = x.shape[-1]
    if n < 2:
        return np.full_like(x, np.nan)
    x = x - x[..., :1]  # a large constant would cost digits at the ends
    window = min(n, WINDOW)
    half = window // 2
    result = np.asarray(scipy.ndimage.correlate1d(x, weights(window, half), axis=-1, mode="nearest"))
    for k in range(half):
        result[..., k] = x[..., :window] @ weights(window, k)
        result[..., n - 1 - k] = -(x[..., : -window - 1 : -1] @ weights(window, k))
    return result


@cache
def weights(window: int, at: int, band: float = BAND) -> Array:
    """Weights (window,) of the derivative, per sample, at sample ``at`` of the window.

    Least squares of the relative error of the frequency response up to ``band``, at an edge up to :data:`EDGE_BAND`, plus the noise
    gain with a small weight, under the constraint that low polynomials come out exactly.
    """
    edge = min(at, window - 1 - at) < _EDGE
    band = min(band, EDGE_BAND) if edge else band
    k = np.arange(window) - float(at)
    theta = (np.arange(2000) + 0.5) / 2000 * band * np.pi
    scale = 1 / np.maximum(theta, 0.05 * np.pi) / np.sqrt(len(theta))
    phase = np.outer(theta, k)
    response = np.concatenate([np.cos(phase) * scale[:, None], np.sin(phase) * scale[:, None]])
    target = np.concatenate([np.zeros_like(theta), theta * scale])
    degree = min(_POLYNOMIAL, window - 1)
    moments = np.stack([(k / window) ** d for d in range(degree + 1)])
    moment = np.zeros(degree + 1)
    moment[1] = 1 / window
    q, r = np.linalg.qr(moments.T, mode="complete")
    fixed = q[:, : degree + 1] @ np.linalg.solve(r[: degree + 1].T, moment)
    free = q[:, degree + 1 :]
    damping = 3e-5 if edge else 1e-6
    left = np.concatenate([response @ free, damping * free])
    right = np.concatenate([target - response @ fixed, -damping * fixed])
    weights = np.asarray(fixed + free @ np.linalg.lstsq(left, right, rcond=None)[0])
    if 2 * at == window - 1:
        weights = (weights - weights[::-1]) / 2  # to the last bit: a constant must give zero
    weights.flags.writeable = False
    return weights


BRIDGE, FAR = 7, 16
"""Degree of the spline over gaps, and gap, in usual distances, that is too wide for it. Over three samples of flights at 16 Hz it
errs by 3e-5 to 1e-4 of the standard deviation, a cubic one by 4e-3 to 1e-2; between rates held for two samples a cubic one left 600 Eo."""


def bridge_gaps(x: Array, present: Mask, *, smooth: bool = False, turning: bool = False) -> Array:
    """A series (N,) between the samples that are there (N,): linearly, or by a spline where gaps are not too wide.

    The angle of a disc is ``turning``: whole turns may be missing in it, and it turns on beyond the ends.
    """
    if present.all() or not present.any():
        return x
    at, k = np.flatnonzero(present), np.arange(len(x))
    values = np.unwrap(x[at]) if turning else x[at]
    turn = np.polyfit(at, values, 1) if turning and len(at) > 1 else np.zeros(1)
    off = values - np.polyval(turn, at)
    bridge, apart = np.interp(k, at, off), np.diff(at)
    wide = np.flatnonzero(apart > FAR * np.median(apart)) if smooth and len(apart) else np.arange(0)
    for group in np.split(np.arange(len(at)), wide + 1) if smooth else ():
        if len(group) > 1:
            inside, degree = slice(at[group[0]], at[group[-1]] + 1), min(BRIDGE, len(group) // 2 * 2 - 1)
            bridge[inside] = scipy.interpolate.make_interp_spline(at[group], off[group], degree)(k[inside])
    return np.where(present, x, bridge + np.polyval(turn, k))


PREDICTED = 24  # samples from which an autoregressive series predicts the next: as many as enter a derivative


def predict_missing(x: Array, present: Mask) -> Array:
    """A series (N,) whose gaps of up to ``PREDICTED`` samples are filled as an autoregressive series, with the least errors of prediction
    (A. Janssen, R. Veldhuis, L. Vries, IEEE Trans. ASSP 34, 1986, 317); other gaps, and all if few segments are complete, by a spline.
    """
    bridged, size = bridge_gaps(x, present, smooth=True), PREDICTED + 1
    complete = np.convolve(present, np.ones(size), "valid")[: 1 << 15] > PREDICTED + 0.5
    fixed = ~find_short_runs(~present, PREDICTED)
    fixed[:PREDICTED] = fixed[len(x) - PREDICTED :] = True
    if fixed.all() or np.sum(complete) < 4 * size:
        return bridged
    mean = np.mean(bridged)
    learnt = np.lib.stride_tricks.sliding_window_view(bridged - mean, size)[: len(complete)][complete]
    taps = np.r_[1.0, -np.linalg.lstsq(learnt[:, :-1], learnt[:, -1], rcond=1e-12)[0][::-1]]
    try:
        return np.asarray(fill_gaps((bridged - mean)[None], fixed, taps, rounding=0.0)[0] + mean)
    except np.linalg.LinAlgError:  # as singular as a constant
        return bridged


# degree of the spline that interpolates: at 42 % of the Nyquist frequency it errs by 4e-6 of the amplitude, at 65 % by 1e-3
SPLINE = 9


def interpolate_even(x: Sequence[Array], at: Array, *, integral: bool = False) -> Array:
    """Evenly sampled series (N,), or their integrals, at places between their samples, (n,), counted in samples: (series, n).

    Of an N too short for the spline, by a polynomial.
    """
    rows = np.stack(x, axis=-1)
    degree = min(SPLINE, (len(rows) - 1) // 2 * 2 - 1)
    first = rows[:1]  # a large constant would cost digits
    spline = scipy.interpolate.make_interp_spline(
        np.arange(len(rows), dtype=np.float64), rows - first, k=degree
    )
    values = spline(at) + first if not integral else spline.antiderivative()(at) + first * at[:, None]
    return np.asarray(values.T)


# of the polynomials that smooth a series for its slope: each leaves less of a fast swing out, and lets more noise in
DEGREES = (5, 7, 9, 11, 13)


def smooth_slope(x: Array, half: int, order: int, degree: int) -> Array:
    """First or second derivative per sample, (N,), by polynomials through ``half`` samples on either side.

    Towards an end the polynomial is that through the last 2 ``half`` + 1 samples. The operations and their order are
    those of the exported programs.
    """
    window, slope = 2 * half + 1, np.empty(len(x))
    middle = polynomial_weights(half, 0, order, degree)
    if order == 2:
        middle = middle.copy()  # its sum must be zero, or a series far from zero would leave its rounding
        middle[half] = -2.0 * np.cumsum(middle[:half])[-1]
    scipy.ndimage.correlate1d(x, middle, output=slope, mode="nearest")
    for k in range(half):
        slope[k] = np.cumsum(polynomial_weights(half, k - half, order, degree) * x[:window])[-1]
        slope[len(x) - 1 - k] = np.cumsum(polynomial_weights(half, half - k, order, degree) * x[-window:])[-1]
    return slope


def split_angle(angle: Array, late: Array | None = None) -> tuple[float, Array]:
    """Split an angle, rad, (N,), N > 1, in which whole turns may be missing, into its mean step a sample and its swing, (N,).

    ``late`` (N,): by how many steps each sample is later than an evenly spaced one.

    A swing of a radian keeps digits that an angle of thousands of radians would lose.
    """
    steps = np.diff(angle)
    steps -= 2 * np.pi * np.rint(steps / (2 * np.pi))
    mean = float(np.cumsum(steps)[-1]) / len(steps)
    late = np.zeros(len(angle)) if late is None else late
    mean /= 1.0 + float(late[-1] - late[0]) / len(steps)
    return mean, np.concatenate([[0.0], np.cumsum(steps - mean)]) - mean * (late - late[0])


def choose_degree(x: Iterable[Array], half: int) -> int:
    """The degree of DEGREES with the least expected error of the second derivative of runs of samples, (N,) each.

    From one degree to the next, weights change by w: the error's variance grows by s^2 |w|^2, and its bias falls by the mean
    square of the change less that (Mallows, Technometrics 15 (1973) 661). The noise variance s^2 is that of the residual of the
    highest degree, or of a later step if that is larger: rounding of an encoder may not be white. Runs shorter than two
    windows do not count.
    """
    degrees = [d for d in DEGREES if d < 2 * half]
    if len(degrees) < 2:
        return DEGREES[0]
    residual = -polynomial_weights(half, 0, 0, degrees[-1])
    residual[half] += 1.0
    kernels = [*np.diff([polynomial_weights(half, 0, 2, d) for d in degrees], axis=0), residual]
    squares = np.zeros(len(kernels))
    for run in x:
        if len(run) >= 2 * (2 * half + 1):
            inner = slice(half, len(run) - half)
            squares += [float(np.sum(scipy.ndimage.correlate1d(run, w)[inner] ** 2)) for w in kernels]
    gains = np.array([float(w @ w) for w in kernels])
    noise = np.maximum.accumulate((squares / gains)[::-1])[::-1]
    grows = 2 * noise[1:] * gains[:-1] - squares[:-1]
    return degrees[int(np.argmin(np.cumsum([0.0, *grows])))]


@cache
def polynomial_weights(half: int, at: int, order: int, degree: int) -> Array:
    """(2 half + 1,): weights of the derivative at a sample counted from the middle one (Gorry, Anal. Chem. 62 (1990) 570)."""
    everywhere = _evaluate_gram(half, np.arange(-half, half + 1.0), degree)
    at_sample = _evaluate_gram(half, np.array([float(at)]), degree)
    total, below, above = np.zeros(2 * half + 1), 1.0, 2.0 * half + 1.0
    for k in range(degree + 1):
        total = total + (2 * k + 1) * below / above * everywhere[k][0] * at_sample[k][order]
        below *= 2 * half - k
        above = float(np.cumprod([2.0 * half + k + 2 - i for i in range(k + 2)])[-1])
    total.flags.writeable = False
    return total


def _evaluate_gram(half: int, t: Array, degree: int) -> list[list[Array]]:
    """Gram polynomials of degree 0 ... ``degree`` at t, and their first two derivatives: [degree][order]."""
    zero = np.zeros(len(t))
    polynomials = [[zero + 1.0, zero, zero]]
    for k in range(1, degree + 1):
        divisor = k * (2.0 * half - k + 1)
        a, b = (4 * k - 2) / divisor, (k - 1) * (2.0 * half + k) / divisor
        last, before = polynomials[-1], polynomials[-2] if k > 1 else [zero] * 3
        slopes = [last[0] * 0.0, last[0], 2.0 * last[1]]
        polynomials.append([a * (t * last[s] + slopes[s]) - b * before[s] for s in range(3)])
    return polynomials


REACH = 64
"""Samples on either side that enter a derivative. Where there are fewer, next to an end or a gap, it is good to half the frequency and
not relied upon; of a short run an eighth at either end, or little would be left of a record with many gaps."""

WIDE_BAND = 0.9  # end of the band, of the Nyquist frequency
# deviation from even instants, in steps, from which they are followed: the last digits of a time of a day
JITTER = 1e-7
# of the splines through instants that jitter: their derivative is as good as the finite differences'
DEGREE = 5

NOTE = (
    f"omegadot_x, omegadot_y, omegadot_z are derived from omega, good to {100 * WIDE_BAND:.0f} % of the Nyquist frequency; up to"
    f" {REACH} samples next to an end or a gap, where they are poor, are not used"
)


def derive_accelerations(rates: Sequence[Array], time: Array) -> tuple[list[Array], Mask]:
    """The derivatives of angular rates, and whether they can be relied upon.

    Parameters
    ----------
    rates
        (N,) each, NaN where none was recorded.
    time
        (N,) s: the samples' own instants, which may jitter.

    Returns
    -------
    (N,) each, NaN where there is no rate; (N,) bool.
    """
    k = np.arange(len(time))
    even = np.asarray(np.polyval(np.polyfit(k, time, 1), k), dtype=np.float64)
    rate = (len(time) - 1) / float(time[-1] - time[0])
    jitters = bool(np.max(np.abs(time - even)) * rate > JITTER)
    straight = [resample(x, time, even) for x in rates] if jitters else rates
    derivatives, sure = zip(*(differentiate_rate(x, rate) for x in straight), strict=True)
    slopes = [resample(x, even, time) if jitters else x for x in derivatives]
    return slopes, np.all(sure, axis=0)


def differentiate_rate(omega: Array, rate: float) -> tuple[Array, Mask]:
    """Time derivative (N,) of an evenly sampled rate (N,), NaN where there is no sample, and where it can be relied upon."""
    result, sure = differentiate(omega, rate), np.zeros(len(omega), dtype=np.bool_)
    for run in runs(np.isfinite(omega)):
        n = run.stop - run.start
        if n > 2 * REACH:
            x = omega[run] - omega[run.start]
            inner = scipy.ndimage.correlate1d(x, wide_weights(), mode="nearest")[REACH : n - REACH]
            result[run.start + REACH : run.stop - REACH] = inner * rate
        unsure = min(REACH, n // 8)
        sure[run.start + unsure : run.stop - unsure] = n > 1
    return result, sure


def resample(x: Array, time: Array, instants: Array) -> Array:
    """A series (N,) at instants that are near its own, s; every run without a gap separately, NaN where it has no sample."""
    values = np.full(len(x), np.nan)
    for run in runs(np.isfinite(x)):
        size = run.stop - run.start
        degree = min(DEGREE, (size - 1) // 2 * 2 - 1)
        values[run] = (
            x[run]
            if size < 3
            else scipy.interpolate.make_interp_spline(time[run], x[run], degree)(instants[run])
        )
    return values


def wide_weights() -> Array:
    """Weights (2 REACH + 1,) of a derivative, per sample, at the middle one."""
    return weights(2 * REACH + 1, REACH, WIDE_BAND)
