"""The noise with which motion and gradients are measured: found, and smoothed where that explains the output better.

A model sees the measured motion, x = true + noise (errors in variables: W. Fuller, Measurement Error Models, 1987). The noise goes through
the model into the residual, coefficients of x come out too small, and filters and delays of x are feigned, because they smooth it. All
that ends if the model sees the best linear prediction of the true motion instead: what noise is left of that does not correlate with it
(regression calibration: R. Carroll, D. Ruppert, L. Stefanski, C. Crainiceanu, Measurement Error in Nonlinear Models, 2006, chapter 4).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy import fft, signal
from scipy.sparse.linalg import LinearOperator, cg

from ragg_runtime.io import Flight
from ragg_runtime.io.record import (
    ANGULAR_ACCELERATION,
    ANGULAR_RATE,
    GRADIENT,
    SPECIFIC_FORCE,
    WIDEST_SPIKE,
    Flag,
)
from ragg_runtime.model.model import scale_factor
from ragg_runtime.screening.linear_fit import Sampler
from ragg_runtime.screening.readings import change_columns
from ragg_runtime.signals.derivative import PREDICTED, find_short_runs, predict_missing, runs
from ragg_runtime.signals.fir import find_step

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Index = NDArray[np.intp]

FALLS = 0.99
"""Factor by which the residual must fall. Of noise that makes less than a seventh of it ten thousand samples tell no more than
two sigma."""

NOTICED = float(np.sqrt(1.0 - FALLS**2))  # share of the residual that noise must make for that
NOTED = 0.01  # per cent by which coefficients would be too small, from which that is noted
# factor by which the residual falls from which noise of a recorded gradient is most of it: what smoothing leaves of that is seen
MOSTLY = 0.5
# samples of a window of the spectrum, and bands whose mean densities are compared: the least is the floor
WINDOW, BANDS = 256, 8
# ratio of the two lowest bands below which they are white noise; motion falls off. Of 4,800 samples a band is known to 3 %.
FLAT = 1.2

SURE = 6.0
"""Standard deviations of the spectrum by which motion must be above the noise to be kept. With 3, what passed in single bands was
filtered out by effects again: of five effect-free flights one had a false claim and one was unexplained."""

BLOCK = 1 << 16  # samples that are smoothed together: at its ends a prediction is 1.5 times less sure
# samples in the middle of a record, at most, by which its noise is measured, and it is decided whether its motion is smoothed
TRIED = 4 * BLOCK
# error of the smoothed motion, in standard deviations of its noise, at which the conjugate gradients end, and their largest number
CLOSE, MOST = 1e-3, 400
TRIANGLE = np.array([0.25, 0.5, 0.25])  # weights that smooth a spectrum over neighbouring frequencies

SCATTER = 0.56
"""Relative standard deviation of that of one window per record: sqrt(0.53 x 0.6), of Hann windows that overlap by half, whose neighbouring
frequencies have a correlation of 0.44 (P. Welch, IEEE Trans. AU 15, 1967, 70)."""


@dataclass(frozen=True)
class MotionNoise:
    """White noise of a column: its standard deviation, SI, and the ``step`` in which it is recorded (0: none)."""

    std: float
    step: float


def measure_noise(x: Array, present: Mask) -> MotionNoise:
    """The noise of a column (N,): that of its converter's steps or of the flat floor of its spectrum, if it has one, whichever is more.

    The floor is an upper bound, as motion may have one, too.
    """
    step = find_step(x[present]) or 0.0
    bands = np.array_split(_measure_spectrum(x, present)[0][2:-1], BANDS)
    lowest, next_one = sorted(float(np.mean(b)) for b in bands if len(b))[:2]
    floor = float(np.sqrt(0.5 * lowest)) if next_one < FLAT * lowest else 0.0
    return MotionNoise(max(step / float(np.sqrt(12.0)), floor), step)


def _measure_spectrum(x: Array, present: Mask) -> tuple[Array, float]:
    """One-sided density (m,) of a column (N,), per cycle per sample, smoothed, and its relative standard deviation.

    By all stretches of samples that are ``present`` in which a few at most are missing at a time.
    """
    whole = present | find_short_runs(~present, WIDEST_SPIKE)
    lengths = np.array([r.stop - r.start for r in runs(whole)])
    window = WINDOW
    while window > 8 and np.sum(lengths[lengths >= window]) < max(8 * window, 0.5 * np.sum(lengths)):
        window //= 2
    filled, parts = predict_missing(x, present), runs(whole, window)
    share = np.array([r.stop - r.start for r in parts], dtype=np.float64)
    welch = partial(signal.welch, nperseg=window, detrend="linear")
    densities = [welch(filled[r])[1] for r in parts]
    density = np.average(densities, axis=0, weights=share)
    smoothed = np.convolve(np.pad(density, 1, mode="edge"), TRIANGLE, mode="valid")
    return smoothed, SCATTER * float(np.sqrt(window / np.sum(share)))


def smooth_noisy_motion(s: Sampler) -> Flight:
    """The flight with its noisy sensors smoothed, one after the other, and flagged.

    That a floor is noise is a hypothesis: with motion smoothed that is none, the model explains less of the output.
    """
    valid = s.flight.valid
    if not runs(valid, PREDICTED + 1):
        return s.flight  # of motion that is held at a lower rate, for example, nothing can be told
    whole, tried = slice(0, len(valid)), _find_middle(s.usable)
    rows = s.rows(tried.start, tried.stop)
    before = s.fit(rows)
    for names in (SPECIFIC_FORCE, ANGULAR_RATE, ANGULAR_ACCELERATION, GRADIENT):
        if names is ANGULAR_ACCELERATION and names[0] not in s.flight.written:
            continue  # derived from the rates
        x, rng = s.flight.channels, np.random.default_rng(0)
        there = {n: x[n][tried] for n in names if n in x}
        noise = {n: q for n, v in there.items() if (q := measure_noise(v, valid[tried])).std > 0.0}
        noisier = {n: x[n] + q.std * rng.standard_normal(len(valid)) for n, q in noise.items()}
        if not noise or _compare(before.p, s, _change(s, noisier), rows) < NOTICED * before.rms:
            continue
        smoothed = _smooth(s, noise, tried)
        after = smoothed.fit(rows)
        if after.rms >= FALLS * before.rms:
            continue
        flag = _describe(s, noise, before.rms, after.rms)
        if names is GRADIENT and after.rms < MOSTLY * before.rms:
            channels = {n: v for n, v in x.items() if n not in GRADIENT}
            text = f"{flag.reason}; it is not used but taken to be unknown and to vary slowly"
            return replace(s.flight, channels=channels).flagged([replace(flag, reason=text)])
        smoothed = smoothed if tried == whole else _smooth(s, noise, whole)
        s, before = replace(smoothed, flight=smoothed.flight.flagged([flag])), after
    return s.flight


def _find_middle(usable: Mask) -> slice:
    """The whole of a short record, else the span of the :data:`TRIED` usable samples in its middle."""
    places = np.flatnonzero(usable)
    if len(places) <= TRIED:
        return slice(0, len(usable))
    middle = places[(len(places) - TRIED) // 2 :][:TRIED]
    return slice(int(middle[0]), int(middle[-1]) + 1)


def _smooth(s: Sampler, noise: Mapping[str, MotionNoise], rows: slice) -> Sampler:
    """The same with noisy columns smoothed, in some rows."""
    x = s.flight
    return _change(s, {n: predict_true(x.channels[n], x.valid, q.std, rows) for n, q in noise.items()})


def _compare(p: Array, one: Sampler, other: Sampler, rows: Index) -> float:
    """Eo rms: how far apart the outputs of a model with parameters ``p`` are at the rows of two flights."""
    chain, records = one.model.chain, (one.take(rows).record, other.take(rows).record)
    first, second = (chain.output(r.time, r.inputs(chain), p, r.phi, which=one.place) for r in records)
    return float(np.std(second - first)) / abs(scale_factor(one.model, p, one.place))


def _change(s: Sampler, columns: Mapping[str, Array]) -> Sampler:
    """The same with other columns of motion, and the angular acceleration that follows from them."""
    return s.with_flight(change_columns(s.flight, columns))


def predict_true(x: Array, present: Mask, std: float, rows: slice = slice(None)) -> Array:
    """A column (N,) with the best linear prediction of it without its white noise in some rows, from its samples that are ``present``.

    It is B C^-1 x, C the covariance of the measured column, B that of the true one with it: with the ends and gaps that the record has.
    """
    prediction = np.array(x)
    density, scatter = _measure_spectrum(x, present)
    white = 2.0 * std**2  # one-sided
    ratio = np.where(density > white * (1.0 + SURE * scatter), density / white, 1.0)
    wanted = np.arange(len(x))[rows]
    for block in np.array_split(wanted, -(-len(wanted) // BLOCK)):
        there = block[present[block]]
        if len(there) > 2:
            prediction[block] = _predict_block(x[there], there - block[0], len(block), std, ratio)
    return prediction


def _predict_block(x: Array, at: Index, count: int, std: float, ratio: Array) -> Array:
    """(count,): the prediction for a block of which samples x (n,) at some rows are there.

    ``ratio`` (m,): of the density to that of the noise, at even frequencies up to the Nyquist frequency.
    """
    size = fft.next_fast_len(2 * count, real=True)
    S = np.interp(fft.rfftfreq(size), np.linspace(0.0, 0.5, len(ratio)), ratio)

    def filter_by(gain: Array, v: Array) -> Array:
        whole = np.zeros(size)
        whole[at] = v
        return np.asarray(fft.irfft(fft.rfft(whole) * gain, size))

    def make_operator(gain: Array) -> LinearOperator:
        return LinearOperator((len(at), len(at)), lambda v: filter_by(gain, v)[at], dtype=np.float64)

    trend = np.polynomial.Polynomial.fit(at, x, 1)
    whitened, _ = cg(
        make_operator(S),
        (x - trend(at)) / std,
        rtol=0.0,
        atol=CLOSE * np.sqrt(len(at)),
        M=make_operator(1.0 / S),
        maxiter=MOST,
    )
    return np.asarray(trend(np.arange(count)) + std * filter_by(S - 1.0, whitened)[:count])


def _describe(s: Sampler, noise: Mapping[str, MotionNoise], before: float, after: float) -> Flag:
    x, units = s.flight, s.instrument.units
    loudest = max(noise, key=lambda n: noise[n].std)
    q, gradient = noise[loudest], loudest in GRADIENT
    stepped = q.step / np.sqrt(12.0) > 0.5 * q.std
    unit = "Eo" if gradient else x.written.get(loudest, x.units[loudest])
    size = (q.step if stepped else q.std) / float(units.to_si(1.0, unit, x.units[loudest]))
    size, unit = (1e3 * size, f"m{unit}") if unit == "g" else (size, unit)
    verb, have = ("is", "has") if len(noise) == 1 else ("are", "have")
    what = (
        f"{verb} recorded in steps of {size:.3g} {unit}"
        if stepped
        else f"{have} a noise floor of {size:.2g} {unit} rms"
    )
    weaker = 100.0 * max(
        min(1.0, n.std**2 / max(float(np.var(x.channels[c][x.valid])), 1e-300)) for c, n in noise.items()
    )
    text = f"{', '.join(noise)} {what}: the noise is smoothed, and the model leaves {after:.3g} instead of {before:.3g} Eo"
    if weaker > NOTED and not gradient:  # which hardly varies
        text += f" (with it coefficients would be up to {weaker:.2g} % too small)"
    return Flag(tuple(noise), text, kind="motion-noise")
