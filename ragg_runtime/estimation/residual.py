"""The residual of a record's output after regressors, lines and jumps are fitted jointly, and the share of the noise that they absorb."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy import fft, linalg, signal

from ragg_runtime.base.progress import split_range
from ragg_runtime.estimation.least_squares import compute_r_factor
from ragg_runtime.estimation.spectrum import (
    LOWEST,
    Spectrum,
    Stretch,
    compute_periodogram,
    cut_lines,
    estimate,
)
from ragg_runtime.signals.fir import GROUP, fill_gaps, filter_columns, find_nonzero

Array = NDArray[np.float64]

STD_OF_MEDIAN = 1.4826
"""Standard deviation of normal noise over the median of its absolute value."""

MOST_LINES = 8
"""Most lines of a segment that are found at a time."""


@dataclass(frozen=True)
class Disturbance:
    """A line, Hz, or a jump, s since the first sample of the segment."""

    kind: str
    at: float

    def later(self, seconds: float) -> Disturbance:
        """The same of a segment that begins so much later."""
        return replace(self, at=self.at + seconds) if self.kind == "jump" else self

    def columns(self, time: Array) -> Array:
        """(k, N): what it spans; a line may be off its frequency a little."""
        if self.kind == "jump":
            return np.where(time >= self.at, 1.0, 0.0)[None]
        phase = 2 * np.pi * self.at * time
        slow = np.linspace(-1.0, 1.0, len(time))
        return np.stack([np.cos(phase), np.sin(phase), slow * np.cos(phase), slow * np.sin(phase)])


def find_lines(rest: Array, rate: float, without: tuple[float, float] | None) -> list[Disturbance]:
    """Those in a residual (N,), zero where it is not valid; none in a band (from, to, Hz) that has lost its noise."""
    f, p = (x[LOWEST:-1] for x in compute_periodogram(rest, rate))
    if without is not None:
        kept = (f < without[0]) | (f > without[1])
        f, p = f[kept], p[kept]
    quiet = cut_lines(p)
    high = np.flatnonzero(p > quiet)
    found: list[Disturbance] = []
    for k in sorted(high, key=lambda k: -p[k]):
        if len(found) == MOST_LINES:
            break
        if k in (0, len(p) - 1) or p[k] < max(p[k - 1], p[k + 1]):
            continue
        # the logarithm of a Hann window's peak is nearly a parabola
        a, b, c = np.log(p[k - 1 : k + 2])
        shift = 0.5 * (a - c) / (a - 2 * b + c) if a + c < 2 * b else 0.0
        found.append(Disturbance("line", float(f[k] + shift * (f[1] - f[0]))))
    return found


def describe_disturbances(found: Sequence[Disturbance]) -> str | None:
    """One sentence on them; ``None`` if there are none."""
    lines = sorted({float(f"{d.at:.4g}") for d in found if d.kind == "line"})
    jumps = sorted({round(d.at) for d in found if d.kind == "jump"})
    said = []
    if lines:
        said.append("lines at " + ", ".join(f"{x:.4g} Hz" for x in lines[:MOST_LINES]))
    if jumps:
        said.append("jumps at " + ", ".join(f"{x} s" for x in jumps))
    return "the output has " + " and ".join(said) if said else None


FILLED = 64
"""Columns whose gaps are filled together: what is needed for one is made anew for each group."""

ROUNDS = 6
"""Most times that lines and jumps are looked for in what is left beside those before."""


@dataclass(frozen=True)
class ProjectedResidual:
    """What columns leave of the last one.

    ``rest`` (rows,) is at the valid samples; ``rank`` the degrees of freedom of the columns; ``kept`` the share of white noise that
    they leave at each frequency of the periodogram; ``found`` the lines and jumps fitted jointly; ``shapes`` (k, rows) their
    fitted series. ``columns`` (n, rows) have ``coefficients`` (n,) and, times ``directions`` (n, k), are orthonormal. ``valid`` (N,)
    marks the rows.
    """

    rest: Array
    rank: float
    kept: Array
    found: list[Disturbance]
    shapes: Array
    coefficients: Array
    columns: Array = field(repr=False)
    directions: Array = field(repr=False)
    valid: NDArray[np.bool_] = field(repr=False)

    @property
    def series(self) -> Array:
        """(N,): what is left, zero where a sample is not valid."""
        return place_valid(self.rest, self.valid)

    def kept_of(self, noise: Spectrum | None) -> Array:
        """As ``kept``, but gaps are not lost, and of ``noise`` that is not white: power at each frequency over its density.

        Columns that follow slow noise take what is slowest of it, and in return leave as much of it at frequencies beside: of white
        noise the two balance, of red noise the second is little. With Q the columns' orthonormal basis, C the covariance and v a
        windowed wave it is v'Cv - 2 Re v'CQ Q'v + v'Q (Q'CQ) Q'v.
        """
        n, valid = len(self.valid), self.valid
        size, window = fft.next_fast_len(2 * n, real=True), signal.windows.hann(n, sym=False)
        if noise is None:
            return self.kept + float(np.sum(window[~valid] ** 2) / np.sum(window**2))
        density = noise.psd(fft.rfftfreq(size, 1.0 / noise.rate)) * noise.rate / 2
        own = fft.rfft(window, size)
        lags = fft.irfft(own.real**2 + own.imag**2, size) * fft.irfft(density, size)
        bins = n // 2 + 1
        power = np.interp(np.arange(bins) / n, fft.rfftfreq(size), fft.rfft(lags).real)
        Q, taps = self.directions.T @ self.columns, noise.whitening_filter(n)
        CQ, waves, cross = np.empty_like(Q), np.empty((len(Q), bins), complex), np.zeros(bins)
        for rows in split_range(len(Q), FILLED):
            wide = place_valid(Q[rows], valid)
            through = fft.irfft(fft.rfft(wide, size) * density, size)[:, :n] * valid
            CQ[rows] = through[:, valid]
            waves[rows] = fft.rfft(window * fill_gaps(wide, valid, taps))
            coloured = fft.rfft(window * fill_gaps(through, valid, taps))
            cross += 2.0 * np.sum((waves[rows].conj() * coloured).real, axis=0)
        parts = waves.view(float)  # real and imaginary parts side by side: half the work
        square = np.sum((parts * ((Q @ CQ.T) @ parts)).reshape(len(Q), -1, 2), axis=(0, 2))
        plain = noise.psd(np.arange(bins) * noise.rate / n) * noise.rate / 2
        return np.asarray(np.maximum(power - cross + square, 0.0) / (plain * np.sum(window**2)))


def fit_columns(
    flat: Array,
    valid: NDArray[np.bool_],
    rate: float,
    band: tuple[float, float] | None,
    through: Callable[[Array], Array] = lambda columns: columns,
    *,
    raised: bool = False,
) -> ProjectedResidual:
    """Project the first n of flat (n + 1, rows), and lines and jumps, out of the last.

    No line is looked for in ``band``; ``through`` does to columns (k, rows) what was done to ``flat``. ``raised``: jumps are judged by
    the noise's raised spectrum (:meth:`Spectrum.raise_floor`).
    """
    flat = flat[[*find_nonzero(flat[:-1]), True]]
    time = np.flatnonzero(valid) / rate
    left = project_columns(flat, valid)
    for _ in range(ROUNDS):
        more = find_lines(left.series, rate, band)
        if not more:
            jump = _find_best_jump(left, rate)
            if jump is None or not _is_significant(left, through(jump.columns(time))[0], rate, band, raised):
                break
            more = [jump]
        found = [*left.found, *more]
        spanned = [through(d.columns(time)) for d in found]
        left = project_columns(np.vstack([*spanned, flat]), valid)
        ends = np.cumsum([0, *(len(x) for x in spanned)])
        shapes = [left.coefficients[a:b] @ left.columns[a:b] for a, b in pairwise(ends)]
        left = replace(left, found=found, shapes=np.array(shapes))
    return left


def place_valid(rest: Array, valid: NDArray[np.bool_]) -> Array:
    """(..., N): of valid samples (..., rows), zero where a sample is not valid."""
    e = np.zeros((*rest.shape[:-1], len(valid)))
    e[..., valid] = rest
    return e


JUMP = 32.0
"""Least chi-square of a jump that the columns hide: above chance in 1,400 records of 640 s of red noise but for 6."""

INSTANTS = 96
"""Instants among which it is sought, and again about the best of them, to the sample."""


def _find_best_jump(left: ProjectedResidual, rate: float) -> Disturbance | None:
    """The jump that would explain most of the residual, fitted jointly with the columns; ``None`` if white noise would do."""
    n = len(left.rest)
    low, high = 0, n
    while True:
        edges = np.unique(np.linspace(low, high, INSTANTS + 1).astype(np.intp))[1:-1]
        starts = np.concatenate([[0], edges])
        spanned = left.directions.T @ np.add.reduceat(left.columns, starts, axis=1)
        after, shared = (
            np.cumsum(x[..., ::-1], axis=-1)[..., ::-1][..., 1:]
            for x in (np.add.reduceat(left.rest, starts), spanned)
        )
        own = (n - edges) - np.sum(shared**2, axis=0)
        own = np.where(own > 1e-3 * np.minimum(edges, n - edges), own, np.inf)
        best = int(np.argmax(after**2 / own))
        if high - low <= INSTANTS:
            break
        reach = -(-(high - low) // INSTANTS)
        low, high = max(0, int(edges[best]) - reach - 1), min(n, int(edges[best]) + reach + 1)
    variance = float(left.rest @ left.rest) / max(1.0, n - left.rank)
    if not float(after[best] ** 2 / own[best]) > JUMP * variance:
        return None
    return Disturbance("jump", float(np.flatnonzero(left.valid)[edges[best]] / rate))


def _is_significant(
    left: ProjectedResidual, column: Array, rate: float, band: tuple[float, float] | None, raised: bool
) -> bool:
    """Whether a further column (rows,) is significant against the noise beside it: red noise looks like jumps, too."""
    new = column - (left.directions @ (left.directions.T @ (left.columns @ column))) @ left.columns
    new /= np.linalg.norm(new)
    gone = new * float(new @ left.rest)
    kept = np.maximum(left.kept - _measure_taken(new[None], np.ones((1, 1)), left.valid), 0.0)
    model = estimate([Stretch(place_valid(left.rest - gone, left.valid), rate, kept)], band)
    taps = (model.raise_floor() if raised else model).whitening_filter(len(left.valid))
    white = filter_columns(place_valid(gone, left.valid)[None], taps)[0][left.valid]
    return float(white @ white) > JUMP


EVERY = 1024
"""Bins of a periodogram for which the share that columns leave is computed; it is interpolated in between."""


def _measure_taken(columns: Array, directions: Array, valid: NDArray[np.bool_]) -> Array:
    """Share of white noise that columns (n, rows) take at each frequency, |Q'v|^2 of windowed waves v; columns times ``directions``
    (n, k) are Q.
    """
    n = len(valid)
    window = signal.windows.hann(n, sym=False)
    size = fft.next_fast_len(n, real=True)  # a little finer than the periodogram's own frequencies
    bins = size // 2 + 1
    some = np.unique(np.r_[0 : min(bins, EVERY // 2), np.geomspace(1, bins, EVERY).astype(np.intp) - 1])
    waves = np.empty((len(columns), len(some)), dtype=np.complex128)

    for group in split_range(len(columns), GROUP):
        part = place_valid(columns[group] * window[valid], valid)
        waves[group] = fft.rfft(part, size, axis=1)[:, some]
    spanned = directions.T @ waves.view(np.float64)  # real and imaginary parts side by side: half the work
    taken = np.einsum("ij,ij->j", spanned, spanned).reshape(-1, 2).sum(axis=1)
    return np.asarray(np.interp(np.arange(n // 2 + 1) * (size / n), some, taken / np.sum(window**2)))


ABSENT = 1e-11
"""Relative size of a direction of (normalised) columns that is rounding rather than physics."""

NOTHING = 1e-7
"""Share of the noise along a direction that is not worth counting: a hundred of them change no periodogram by 1e-5."""


def project_columns(columns: Array, valid: NDArray[np.bool_]) -> ProjectedResidual:
    """Project the first n of columns (n + 1, rows) out of the last; numerically absent directions are faded out."""
    R = compute_r_factor(columns)
    n, window = len(R) - 1, signal.windows.hann(len(valid), sym=False)
    norms = np.linalg.norm(R[:, :n], axis=0)
    norms[norms == 0.0] = 1.0
    U, s, Vt = linalg.svd(R[:n, :n] / norms)
    faded = s**2 / (s**2 + (ABSENT * s[0]) ** 2)
    inverse = Vt.T / np.maximum(s, 1e-300) / norms[:, None]
    coefficients = inverse @ (faded * (U.T @ R[:n, n]))
    lost = faded * (2.0 - faded)  # what a faded fit takes of the noise's power
    some = lost > NOTHING
    directions = inverse[:, some] * np.sqrt(lost[some])
    there = np.sum(window[valid] ** 2) / np.sum(window**2)  # gaps count as lost
    return ProjectedResidual(
        rest=np.asarray(columns[-1] - coefficients @ columns[:-1]),
        rank=float(np.sum(faded)),
        kept=np.maximum(there - _measure_taken(columns[:-1], directions, valid), 0.0),
        found=[],
        shapes=np.empty((0, columns.shape[1])),
        coefficients=coefficients,
        columns=columns[:-1],
        directions=directions,
        valid=valid,
    )
