"""The noise of a record, estimated from its residual, and the filter that makes it white.

With 1/f noise taken for white, a nominal 5 % test raises false alarms on nearly every effect-free record;
so every column of every fit passes through the same whitening filter as the data (:class:`noise.NoiseModel`).
The residual is what regressors, lines and jumps leave, fitted jointly; the share of the noise that they absorb is known.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy import fft, interpolate, linalg, optimize, signal

from ragg_runtime.base.progress import split_range
from ragg_runtime.estimation.least_squares import compute_r_factor
from ragg_runtime.signals.fir import GROUP, fill_gaps, filter_columns, find_nonzero, place_valid

Array = NDArray[np.float64]

LOWEST = 3  # first bin of a periodogram that is used
BELOW = 4.0  # so far, in log frequency, the model goes on below it
SMOOTH = 0.7  # half width in log frequency over which the fitted spectrum averages the periodogram
KNOTS = 9  # coefficients of the log-spectrum: enough for red, white and a broad resonance, too few for a line
LOOSE = 0.05  # how much a finer spline is held back where it is fine, over elsewhere

# intervals of a finer spline between zero and the Nyquist frequency, taken where the spectrum plainly asks for it: what is left of a
# derived angular acceleration stands in a narrow band near the top. Hundreds of bins lie in each, so that a line does not bend it.
FINE = 12


@dataclass(frozen=True)
class Spectrum:
    """A smooth one-sided power spectral density: a cubic spline of its logarithm over log frequency.

    Attributes
    ----------
    rate
        Sampling rate, Hz.
    log_f, log_psd
        Sorted natural logarithms of frequency (Hz) and density (unit^2/Hz) on a fine grid; held constant
        outside it.
    spread
        Standard error of ``log_psd``: only a few bins of a periodogram determine the lowest frequencies.
    """

    rate: float
    log_f: Array
    log_psd: Array
    spread: Array

    def psd(self, f: Array) -> Array:
        """One-sided density at frequencies f, Hz (the lowest of the grid is used at and near zero)."""
        with np.errstate(divide="ignore"):
            return np.asarray(np.exp(np.interp(np.log(np.abs(f)), self.log_f, self.log_psd)))

    @property
    def rms(self) -> float:
        """Root of the density integrated from 0 to the Nyquist frequency."""
        lowest = float(np.exp(self.log_f[0] + BELOW)) / LOWEST  # one over the length of the record
        f = np.geomspace(min(lowest, self.rate / 4), self.rate / 2, 4097)
        S = self.psd(f)
        area = np.sum(np.diff(f) * (S[1:] + S[:-1]) / 2.0)  # NumPy 1 has no trapezoid
        return float(np.sqrt(area + S[0] * f[0]))

    @property
    def red(self) -> float:
        """Density at the lowest frequency that was seen over that in the middle (of the logarithm)."""
        low = self.log_f[0] + BELOW
        at = np.exp([low, (low + self.log_f[-1]) / 2])
        lowest, middle = self.psd(at)
        return float(lowest / middle)

    def raise_floor(self) -> Spectrum:
        """The same, nowhere less than in the middle (of the logarithm) of its frequencies."""
        middle = (self.log_f[0] + BELOW + self.log_f[-1]) / 2
        return replace(self, log_psd=np.maximum(self.log_psd, np.log(self.psd(np.exp(middle)))))

    def whitening_filter(self, length: int) -> Array:
        """Causal minimum-phase FIR (length,) that turns this noise into white noise of unit variance.

        Of n bins the mean of 1/density is 1/n larger than that of the noise: the density is corrected by this where few bins determine it.
        """
        n = 1 << max(13, (4 * length - 1).bit_length())
        f: Array = np.fft.fftfreq(n, 1 / self.rate).astype(np.float64)
        # Kolmogorov: the causal half of the cepstrum of 1/sqrt(two-sided density, per sample).
        cautious = replace(self, log_psd=self.log_psd + self.spread**2).psd(f)
        cepstrum = np.fft.ifft(-0.5 * np.log(cautious * self.rate / 2)).real
        cepstrum[1 : n // 2] *= 2
        cepstrum[n // 2 + 1 :] = 0
        return np.asarray(np.fft.ifft(np.exp(np.fft.fft(cepstrum))).real[:length])


@dataclass(frozen=True)
class Stretch:
    """A contiguous residual, ``rest`` (N,) at a ``rate``, Hz, which tells the noise from ``low`` to ``high``, Hz.

    ``kept``: the share of the noise that a fit has left it at each frequency of its periodogram; ``None``: all.
    """

    rest: Array
    rate: float
    kept: Array | None = None
    low: float = 0.0
    high: float = np.inf


def estimate(
    residual: Sequence[Stretch], without: tuple[float, float] | None = None, spin: float | None = None
) -> Spectrum:
    """Spectrum of the noise, at the rate of the first of several stretches of residual, by Whittle fits.

    Frequencies ``without`` (from, to, Hz) are not looked at: there the residual has lost what is no noise. ``spin``: the spin rate,
    Hz; about one and two times it the spectrum is resolved finely where it asks for that.

    First alpha f^-b + omega_T (paper, Eq. 53), b from 1 to 2, which also extrapolates the noise below the lowest
    frequency of the record; then a smooth correction, a spline of the logarithm over log frequency, fitted
    as a gamma generalised linear model. Neither bends to a single line.
    """
    rate = residual[0].rate
    f, p, count = _pool_periodograms(residual, without)
    whole, low = np.ones_like(f, dtype=bool), f <= np.sqrt(f[0] * f[-1])
    choices = []
    for humps in _list_humps(spin):
        # what a steep end does to the lower half, in the logarithm, is none of its matter
        for band, dense in ((whole, None), (low, rate)):
            kept = _leave_out_humps(humps, f, band)
            base = _fit_red_and_white(f[kept], p[kept], count[kept])
            choices.append((*_fit_correction(f, p, count, base, dense, humps), humps))
    # twice the log likelihood against the number of coefficients (BIC)
    _, log_density, humps = min(choices, key=lambda c: c[0])
    x = np.log(f)
    grid = np.linspace(x[0] - BELOW, x[-1], 513)
    near = np.abs(np.clip(grid, x[0], x[-1])[:, None] - x[None, :]) < SMOOTH
    hump = np.any(_make_hats(np.exp(grid), humps), axis=1)
    near[hump] = np.abs(np.exp(grid[hump])[:, None] - f[None, :]) < APART
    spread = 1 / np.sqrt(np.maximum(near @ count, 1.0))
    model = Spectrum(rate, grid, log_density(np.exp(grid)), spread)
    # the level once more alone: the penalties must not bias it
    level = float(np.sum(count * p / model.psd(f)) / np.sum(count))
    return replace(model, log_psd=model.log_psd + np.log(level))


FREE = 0.1  # how much they are held back: hardly

# Hz between nodes of what is resolved about a multiple of the spin rate, and how many there are on either side: noise that modulates a
# carrier is as far from it as the noise is slow, and as strong on both sides
APART, HATS = 0.08, 2


def _list_humps(spin: float | None) -> list[tuple[float, ...]]:
    """Frequencies about which the spectrum may be resolved finely."""
    return [()] if spin is None else [(), (spin,), (2 * spin,), (spin, 2 * spin)]


def _make_hats(f: Array, humps: Sequence[float]) -> Array:
    """(n, HATS for each hump): hat functions of the distance from the humps, Hz; narrower where humps are close."""
    apart = min(APART, 0.32 * humps[0]) if humps else APART
    away = [np.abs(f - h) / apart for h in humps]
    hats = [np.clip(1.0 - np.abs(x - k), 0.0, None) for x in away for k in range(HATS)]
    return np.stack(hats, axis=1) if hats else np.empty((len(f), 0))


def _leave_out_humps(humps: Sequence[float], f: Array, band: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The frequencies of a band (mask (n,) of f) outside the humps, if these are most of the band; else the band."""
    beside = band & ~np.any(_make_hats(f, humps), axis=1)
    return beside if 2 * np.sum(beside) > np.sum(band) else band


def _fit_correction(
    f: Array,
    p: Array,
    count: Array,
    base: Callable[[Array], Array],
    dense: float | None,
    humps: Sequence[float],
) -> tuple[float, Callable[[Array], Array]]:
    """The correction of ``base`` to the periodogram p (n,) at f (n,): its BIC, and the logarithm of the density that it makes.

    Knots are evenly spaced in the logarithm of the frequency, or, for a ``dense`` sampling rate, Hz, in that for low
    frequencies and in the frequency itself for high ones, FINE intervals to the Nyquist frequency.
    """

    def scale(g: Array) -> Array:
        return np.asarray(np.log(g) + (0.0 if dense is None else g * (2 * FINE / dense)))

    x, level = scale(f), base(f)
    size = KNOTS if dense is None else max(KNOTS, round(float(x[-1] - x[0])))
    inner = np.linspace(x[0], x[-1], size - 2)
    knots = np.concatenate([[x[0]] * 4, inner[1:-1], [x[-1]] * 4])
    X = interpolate.BSpline.design_matrix(np.clip(x, x[0], x[-1]), knots, 3).toarray()
    roughness = np.diff(np.eye(size), 2, axis=0)
    held = np.ones(size)
    if dense is not None:
        # What asks for it may be steep by decades near the top, and is held back little there. Low frequencies, of which
        # determined by few bins, of which a fit has absorbed some, are held to their base as usual.
        centre = np.array([np.mean(knots[k + 1 : k + 4]) for k in range(size)])
        held[centre > scale(np.array(dense / (2 * FINE)))] = LOOSE
    penalty = 20.0 * (roughness.T * held[1:-1]) @ roughness + 2.0 * np.diag(held)
    hats = _make_hats(f, humps)
    X = np.hstack([X, hats])
    penalty = linalg.block_diag(penalty, FREE * np.eye(hats.shape[1]))
    # the search begins near its end
    b = np.asarray(np.linalg.solve((count * X.T) @ X + penalty, (count * X.T) @ np.log(p / level)))
    for _ in range(50):
        ratio = p / (level * np.exp(X @ b))
        step = np.linalg.solve((count * X.T) @ X + penalty, (count * X.T) @ (ratio - 1) - penalty @ b)
        step *= min(1.0, 2.0 / max(float(np.max(np.abs(step))), 1e-300))
        b = b + step
        if np.max(np.abs(step)) < 1e-8:
            break
    fitted = X @ b
    cost = 2 * float(np.sum(count * (np.log(level) + fitted + p / (level * np.exp(fitted)))))
    spline, over = interpolate.BSpline(knots, b[:size], 3), b[size:]

    def log_density(g: Array) -> Array:
        near = np.clip(g, f[0], f[-1])
        return np.asarray(np.log(base(g)) + spline(scale(near)) + _make_hats(near, humps) @ over)

    return cost + X.shape[1] * float(np.log(len(f))), log_density


# share of the noise that a fit must have left in a group of frequencies for them to tell its density
LEFT = 0.1


def _pool_periodograms(
    residual: Sequence[Stretch], without: tuple[float, float] | None
) -> tuple[Array, Array, Array]:
    """Frequencies, densities and numbers of averaged bins (in equal steps of log frequency).

    The power in a group of bins over what a fit has left of unit noise there is its density without bias, and as many
    remaining bins determine it.
    """
    frequency, density, share = [], [], []
    for x in residual:
        f, p = compute_periodogram(x.rest, x.rate)
        used = (f >= x.low) & (f < x.high)
        if without is not None:
            used &= (f < without[0]) | (f > without[1])
        # The lowest bins are bent by the mean, the taper and the drifts that a fit takes out.
        used[:LOWEST] = used[-1:] = False
        frequency.append(f[used])
        density.append(cut_lines(p[used]))
        share.append((np.ones(len(f)) if x.kept is None else x.kept)[used])
    f, p, left = np.concatenate(frequency), np.concatenate(density), np.concatenate(share)
    which = np.digitize(f, np.geomspace(f.min() * 0.999, f.max() * 1.001, 120))
    n, power, free, log_f = (
        np.asarray(np.bincount(which, x), dtype=np.float64) for x in (np.ones(len(f)), p, left, np.log(f))
    )
    informed = np.flatnonzero((n > 0) & (free >= LEFT * np.maximum(n, 1)))
    if len(informed) < KNOTS:  # so many columns that nothing is left of most: all the same
        informed = np.flatnonzero(n > 0)
        free = n * max(LEFT, float(np.mean(left)))
    # neighbouring bins of a Hann periodogram are correlated
    return np.exp(log_f[informed] / n[informed]), power[informed] / free[informed], free[informed] / 1.5


# density over that of its neighbourhood from which a bin is a line, no noise: of a day's million bins of noise the highest stands at
# about 14 times the mean
LINE = 25.0
# half width of the neighbourhood of a bin, as a share of its frequency: red noise changes little across it
NEIGHBOURS = 0.2
# half width of the neighbourhood, bins: those lower than twice this are left as they are, red noise being steep there
LEAST = 10


def cut_lines(p: Array) -> Array:
    """A periodogram with its lines cut down to their neighbourhood's median; of noise nothing is changed."""
    n = len(p)
    cut = p.copy()
    first = 2 * LEAST
    if n <= 2 * first:
        return cut
    # medians in neighbourhoods that grow with frequency, each half overlapping the next
    starts, centres, levels = first, [], []
    while starts < n:
        half = max(LEAST, int(NEIGHBOURS * starts))
        around = p[max(0, starts - half) : min(n, starts + half + 1)]
        centres.append(starts)
        levels.append(float(np.median(around)) / np.log(2.0))
        starts += max(1, half // 2)
    k = np.arange(first, n)
    level = np.exp(np.interp(np.log(k), np.log(centres), np.log(np.maximum(levels, 1e-300))))
    high = p[first:] > LINE * level
    cut[first:][high] = level[high]
    return cut


# of red noise, from flicker to a random walk, each as likely as any other before a record is seen
EXPONENTS = (1.0, 1.5, 2.0)


def _fit_red_and_white(f: Array, p: Array, count: Array) -> Callable[[Array], Array]:
    """alpha f^-b + omega_T by maximum (Whittle) likelihood for each of :data:`EXPONENTS`: the mean density, by their likelihoods.

    A few bins hardly determine the exponent, and below them all depends on it: there the mean is over the possible noise.
    """
    white = float(np.median(p[f >= np.sqrt(f[0] * f[-1])]))
    log_f = np.log(f / 0.1)

    def fitted(b: float) -> tuple[float, Array]:
        def cost(theta: Array) -> tuple[float, Array]:
            """And its gradient, by which the optimum is found to rounding."""
            flat, red = white * np.exp(theta[0]), white * np.exp(theta[1] - b * log_f)
            s = flat + red
            slope = count * (1.0 - p / s) / s
            return float(np.sum(count * (np.log(s) + p / s))), np.array([np.sum(slope) * flat, slope @ red])

        best = optimize.minimize(
            cost,
            np.array([0.0, -3.0]),
            jac=True,
            method="L-BFGS-B",
            bounds=[(-5, 5), (-14, 8)],
            options={"ftol": 1e-14, "gtol": 1e-8},
        )
        return float(best.fun), white * np.exp(best.x)

    fits = [fitted(b) for b in EXPONENTS]
    weights = np.exp(min(c for c, _ in fits) - np.array([c for c, _ in fits]))
    weights /= np.sum(weights)

    def density(g: Array) -> Array:
        each = zip(weights, EXPONENTS, fits, strict=True)
        return np.asarray(sum(w * (flat + red * (g / 0.1) ** -b) for w, b, (_, (flat, red)) in each))

    return density


def compute_periodogram(x: Array, rate: float) -> tuple[Array, Array]:
    """Frequencies, Hz, and one-sided density of x (..., N) less its mean, seen through a Hann window."""
    f, density = signal.periodogram(x, rate, "hann")
    return f, density


MOST_LINES = 8  # most lines of a segment that are found at a time


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
    """The lines in a residual (N,), zero where not valid, outside the band ``without`` (from, to, Hz), which has lost its noise."""
    f, p = (x[LOWEST:-1] for x in compute_periodogram(rest, rate))
    if without is not None:
        kept = (f < without[0]) | (f > without[1])
        f, p = f[kept], p[kept]
    quiet = cut_lines(p)
    high = np.flatnonzero(p > quiet)
    lines: list[Disturbance] = []
    for k in sorted(high, key=lambda k: -p[k]):
        if len(lines) == MOST_LINES:
            break
        if k in (0, len(p) - 1) or p[k] < max(p[k - 1], p[k + 1]):
            continue
        # the logarithm of a Hann window's peak is nearly a parabola
        a, b, c = np.log(p[k - 1 : k + 2])
        shift = 0.5 * (a - c) / (a - 2 * b + c) if a + c < 2 * b else 0.0
        lines.append(Disturbance("line", float(f[k] + shift * (f[1] - f[0]))))
    return lines


FILLED = 64  # columns whose gaps are filled together: what is needed for one is made anew for each group
ROUNDS = 6  # most times that lines and jumps are looked for in what is left beside those before


@dataclass(frozen=True)
class ProjectedResidual:
    """What columns leave of the last one.

    ``rest`` (rows,) is at the valid samples; ``rank`` the degrees of freedom of the columns; ``kept`` the share of white noise that
    they leave at each frequency of the periodogram; ``events`` the lines and jumps fitted jointly; ``shapes`` (k, rows) their
    fitted series. ``columns`` (n, rows) have ``coefficients`` (n,) and, times ``directions`` (n, k), are orthonormal. ``valid`` (N,)
    marks the rows.
    """

    rest: Array
    rank: float
    kept: Array
    coefficients: Array
    columns: Array
    directions: Array
    valid: NDArray[np.bool_]
    events: Sequence[Disturbance] = ()
    shapes: Array = field(default_factory=lambda: np.empty((0, 0)))

    @cached_property
    def basis(self) -> Array:
        """(k, rows): the columns, orthonormal."""
        return np.asarray(self.directions.T @ self.columns)

    @property
    def series(self) -> Array:
        """(N,): what is left, zero where a sample is not valid."""
        return place_valid(self.rest, self.valid)

    def measure_kept(self, noise: Spectrum | None) -> Array:
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
        transform = fft.rfft(window, size)
        lags = fft.irfft(transform.real**2 + transform.imag**2, size) * fft.irfft(density, size)
        bins = n // 2 + 1
        power = np.interp(np.arange(bins) / n, fft.rfftfreq(size), fft.rfft(lags).real)
        Q, taps = self.basis, noise.whitening_filter(n)
        CQ, waves, cross = np.empty_like(Q), np.empty((len(Q), bins), complex), np.zeros(bins)
        for rows in split_range(len(Q), FILLED):
            wide = place_valid(Q[rows], valid)
            through = fft.irfft(fft.rfft(wide, size) * density, size)[:, :n] * valid
            CQ[rows] = through[:, valid]
            waves[rows] = fft.rfft(window * fill_gaps(wide, valid, taps))
            coloured = fft.rfft(window * fill_gaps(through, valid, taps))
            cross += 2.0 * np.sum((waves[rows].conj() * coloured).real, axis=0)
        parts = waves.view(float)  # real and imaginary parts side by side: half the work
        square = np.einsum("kn,kn->n", parts, (Q @ CQ.T) @ parts).reshape(-1, 2).sum(axis=1)
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
        events = [*left.events, *more]
        spanned = [through(d.columns(time)) for d in events]
        left = project_columns(np.vstack([*spanned, flat]), valid)
        ends = np.cumsum([0, *(len(x) for x in spanned)])
        shapes = [left.coefficients[a:b] @ left.columns[a:b] for a, b in pairwise(ends)]
        left = replace(left, events=events, shapes=np.array(shapes))
    return left


# least chi-square of a jump that the columns hide: above chance in 1,400 records of 640 s of red noise but for 6
JUMP = 32.0
INSTANTS = 96  # instants among which it is sought, and again about the best of them, to the sample


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
        norm2 = (n - edges) - np.sum(shared**2, axis=0)
        norm2 = np.where(norm2 > 1e-3 * np.minimum(edges, n - edges), norm2, np.inf)
        best = int(np.argmax(after**2 / norm2))
        if high - low <= INSTANTS:
            break
        reach = -(-(high - low) // INSTANTS)
        low, high = max(0, int(edges[best]) - reach - 1), min(n, int(edges[best]) + reach + 1)
    variance = float(left.rest @ left.rest) / max(1.0, n - left.rank)
    if not float(after[best] ** 2 / norm2[best]) > JUMP * variance:
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


# bins of a periodogram for which the share that columns leave is computed; it is interpolated in between
EVERY = 1024


def _measure_taken(columns: Array, directions: Array, valid: NDArray[np.bool_]) -> Array:
    """Share of white noise that columns (n, rows) take at each frequency, |Q'v|^2 of windowed waves v; columns times ``directions``
    (n, k) are Q.
    """
    n = len(valid)
    window = signal.windows.hann(n, sym=False)
    size = fft.next_fast_len(n, real=True)  # a little finer than the periodogram's own frequencies
    bins = size // 2 + 1
    picked = np.unique(np.r_[0 : min(bins, EVERY // 2), np.geomspace(1, bins, EVERY).astype(np.intp) - 1])
    waves = np.empty((len(columns), len(picked)), dtype=np.complex128)

    for group in split_range(len(columns), GROUP):
        part = place_valid(columns[group] * window[valid], valid)
        waves[group] = fft.rfft(part, size, axis=1)[:, picked]
    spanned = directions.T @ waves.view(np.float64)  # real and imaginary parts side by side: half the work
    taken = np.einsum("ij,ij->j", spanned, spanned).reshape(-1, 2).sum(axis=1)
    return np.asarray(np.interp(np.arange(n // 2 + 1) * (size / n), picked, taken / np.sum(window**2)))


ABSENT = 1e-11  # relative size of a direction of (normalised) columns that is rounding rather than physics
# share of the noise along a direction that is not worth counting: a hundred of them change no periodogram by 1e-5
NOTHING = 1e-7


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
    present = lost > NOTHING
    directions = inverse[:, present] * np.sqrt(lost[present])
    share = np.sum(window[valid] ** 2) / np.sum(window**2)  # gaps count as lost
    return ProjectedResidual(
        rest=np.asarray(columns[-1] - coefficients @ columns[:-1]),
        rank=float(np.sum(faded)),
        kept=np.maximum(share - _measure_taken(columns[:-1], directions, valid), 0.0),
        coefficients=coefficients,
        columns=columns[:-1],
        directions=directions,
        valid=valid,
    )
