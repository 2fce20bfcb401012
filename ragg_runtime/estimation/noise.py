"""The noise of a flight: what neither the model nor any candidate effect explains of it, and its level from sample to sample.

A level that is taken as constant where it changes biases every test: noisy intervals weigh too much, and a
term that is large where the noise is large looks significant. A noise whose level follows what is known is made white of
unit variance by one factor per sample, before its filter; or, where it is that of white noise upon a drift, by another filter.
Whether the level follows something is asked by the studentised test of R. Koenker (J. Econometrics 17, 1981): the squares
against groups of samples, with their own fourth moment, so that heavy tails are no evidence.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation.drifting_noise import DriftingNoise, Past
from ragg_runtime.estimation.scores import log_sf
from ragg_runtime.estimation.spectrum import MOST_LINES, Disturbance, Spectrum
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, GRADIENT, SPECIFIC_FORCE, is_disc_angle
from ragg_runtime.model.record import Record
from ragg_runtime.signals.fir import Floats, fill_gaps, filter_columns

Array = NDArray[np.float64]

CHANGES = false_alarms.LEVEL  # p-value, over all that is asked, from which the level follows something
INTERVALS = 48  # intervals of time whose levels are compared
FINEST = 512  # most of those between which the level may change
# shares of the samples, in the order of some quantity, at which groups end: forces have long tails, and there the noise is loudest
GROUPS = (*(np.arange(1, 8) / 8), 15 / 16, 31 / 32)
# quantities between whose groups the level steps; with any other one it goes on smoothly, and variances may grow
STEPPED = ("time", "phi")
SECTORS = 16  # sectors of the disc's angle: a level that swells twice a turn takes eight for each time
ABSENT = 1e-9  # share of a direction's square below which it is rounding
FEWEST = 20  # samples that a group must have
MOST = 3  # most things that the level follows at once


@dataclass(frozen=True)
class LevelFactor:
    """A factor of the level: ``values`` (k,) of a quantity, which has a name: between ``at`` (k - 1,) of it, or, geometrically
    interpolated, where it is as large as ``at`` (k,).
    """

    name: str
    at: Array
    values: Array

    def of(self, quantity: Array) -> Array:
        """(N,): the factor where the quantity (N,) is so large."""
        if len(self.at) < len(self.values):
            return np.asarray(self.values[np.searchsorted(self.at, quantity, side="right")])
        return np.exp(np.interp(quantity, self.at, np.log(self.values)))

    @property
    def ratio(self) -> float:
        """Largest over smallest."""
        return float(np.max(self.values) / np.min(self.values))


@dataclass(frozen=True)
class Level:
    """The product of its parts, of mean square one over the record; without parts one everywhere."""

    parts: tuple[LevelFactor, ...] = ()
    scale: float = 1.0

    def of(self, quantity: Callable[[str], Array]) -> Array | float:
        """(N,): the level where quantities, by name, are (N,)."""
        level: Array | float = self.scale
        for p in self.parts:
            level = level * p.of(quantity(p.name))
        return level


def make_shapes(quantity: Callable[[str], Array], names: Iterable[str], level: Level) -> Array:
    """What a noise of known weights may still vary with: shapes (k, N) of the variance of whitened samples.

    An amplifier's noise is a floor, a part in proportion to what it amplifies, and their products: variances grow with the sizes
    of forces and rates and with their squares, and with auxiliary channels. A random effect is claimed only if it explains more.
    """
    shapes = [np.ones_like(quantity("time"))]
    for n in dict.fromkeys(names):
        if n not in STEPPED:
            x = quantity(n)
            shapes += [x, x**2] if n.startswith(("abs(", "input(")) or n in ("input-rms", "input") else [x]
    weight = np.broadcast_to(level.of(quantity), shapes[0].shape) ** -2.0
    return np.stack([np.ones_like(weight), *(f * weight for f in shapes)])


def score_excess(gram: Array) -> tuple[float, float]:
    """Score of a variance in squared residuals, standard normal where there is none, and the share of it that no shape explains.

    ``gram`` (k + 2, k + 2): inner products of shapes, of the variance, and of the squares, over samples, of which the first shape
    is constant. The squares' own fourth moment counts, so that heavy tails raise no alarm (R. Koenker).
    """
    count, size = gram[0, 0], np.sqrt(np.diag(gram))
    if not count > 0.0 or not np.all(size[-2:] > 0.0):
        return 0.0, 0.0
    size[size == 0.0] = 1.0
    C = gram / np.outer(size, size)
    k = len(C) - 2
    values, vectors = np.linalg.eigh(C[:k, :k])
    kept = values > ABSENT * values[-1]
    root = vectors[:, kept] / np.sqrt(values[kept])
    along = root.T @ C[:k, k:]
    left = C[k:, k:] - along.T @ along
    if left[0, 0] < ABSENT or left[1, 1] <= 0.0:
        return 0.0, 0.0
    return float(np.sqrt(count) * left[0, 1] / np.sqrt(left[0, 0] * left[1, 1])), float(left[0, 0])


def estimate_level(white: Array, quantities: Mapping[str, Array], alternatives: Mapping[str, Array]) -> Level:
    """The level of whitened residuals (N,) as a function of ``quantities``, (N,) each; ``time`` and ``phi`` have a meaning.

    Nothing is concluded once one of the ``alternatives``, variances (N,) that random effects would add, explains it best and more than
    quantities can: that is for a test of that effect.
    """
    parts: list[LevelFactor] = []
    u = white
    asked = len(quantities) + len(alternatives)
    alternatives = {n: x for n, x in alternatives.items() if _is_alternative(white, x, quantities, asked)}
    while len(parts) < MOST:
        tests = {n: _test_quantity(u, n, x) for n, x in (*quantities.items(), *alternatives.items())}
        follows = {n: t for n, t in tests.items() if t and t[0] + np.log(asked) < np.log(CHANGES)}
        best = max(follows, key=lambda n: (follows[n][1], n), default=None)
        if best is None or best in alternatives:
            break
        parts.append(follows[best][2])
        u = u / parts[-1].of(quantities[best])
    level = Level(tuple(parts)).of(quantities.__getitem__)
    return Level(tuple(parts), 1.0 / float(np.sqrt(np.mean(np.square(level)))))


def _is_alternative(u: Array, variance: Array, quantities: Mapping[str, Array], asked: int) -> bool:
    """Whether a variance (N,) explains more of u (N,) than shapes of the quantities can."""
    X = np.stack([*make_shapes(quantities.__getitem__, quantities, Level()), variance, u**2])
    return bool(special.log_ndtr(-score_excess(X @ X.T)[0]) + np.log(asked) < np.log(CHANGES))


def _test_quantity(u: Array, name: str, x: Array) -> tuple[float, float, LevelFactor] | None:
    """Whether the level of u (N,) is another in each group of a quantity x (N,): logarithm of the p-value that it is not, what that gains
    in description, and the level; ``None``: too few samples, or one interval of time.

    The gain is of log likelihood less BIC's penalty, with the squares' own fourth moment.
    """
    edges = _find_edges(name, x)
    if not len(edges):
        return None
    square = u**2
    count, power = _sum_groups(edges, x, square)
    if len(count) <= len(edges) or np.min(count) < FEWEST:
        return None
    mean = float(np.mean(square))
    ratio = float(np.mean(square**2)) / mean**2 - 1.0
    log_p = log_sf(float(np.sum(count * (power / count / mean - 1.0) ** 2)) / max(ratio, 1e-3), len(edges))
    if name == "time":  # a burst is short
        fine = np.quantile(x, np.linspace(0.0, 1.0, min(FINEST, len(x) // FEWEST) + 1)[1:-1])
        edges = _partition_intervals(fine, *_sum_groups(fine, x, square), float(np.mean(square**2)))
        if not len(edges):
            return None
        count, power = _sum_groups(edges, x, square)
    mean_of = power / count
    inner = max(2.0, float(np.mean(square**2)) / float(np.average(mean_of**2, weights=count)) - 1.0)
    gain = -0.5 * float(np.sum(count * np.log(np.maximum(mean_of / mean, 1e-300)))) * 2.0 / inner
    at = edges if name in STEPPED else _sum_groups(edges, x, x)[1] / count
    each = 2.0 if name == "time" else 1.0  # an instant, too
    gain -= 0.5 * each * len(edges) * float(np.log(len(u)))
    return log_p, gain, LevelFactor(name, np.asarray(at), np.sqrt(mean_of / mean))


def _sum_groups(edges: Array, x: Array, values: Array) -> tuple[Array, Array]:
    """Number and sum of values (N,) in each group of x (N,)."""
    which = np.searchsorted(edges, x, side="right")
    return np.bincount(which).astype(np.float64), np.bincount(which, values).astype(np.float64)


def _find_edges(name: str, x: Array) -> Array:
    if name == "time":
        intervals = min(INTERVALS, len(x) // (2 * FEWEST))
        return np.asarray(np.quantile(x, np.linspace(0.0, 1.0, intervals + 1)[1:-1]), dtype=np.float64)
    if name == "phi":
        return np.linspace(0.0, 2 * np.pi, SECTORS + 1)[1:-1]
    edges: Array = np.unique(np.quantile(x, GROUPS)).astype(np.float64)
    return edges[(edges > np.min(x)) & (edges <= np.max(x))]


def _partition_intervals(edges: Array, count: Array, power: Array, fourth: float) -> Array:
    """Edges between intervals of constant level: the partition of least Gaussian cost (BIC).

    A change costs its level and its instant; ``fourth`` is the mean fourth power.
    """
    # the variance of squares over their squared mean, 2 of a Gaussian, without the changes themselves
    ratio = max(2.0, fourth / float(np.average((power / count) ** 2, weights=count)) - 1.0)
    n = len(count)
    C, S = (np.concatenate([[0.0], np.cumsum(v)]) for v in (count, power))
    penalty = 2.0 * np.log(C[-1]) * ratio / 2.0
    best, last = np.full(n + 1, np.inf), np.zeros(n + 1, dtype=np.intp)
    best[0] = -penalty
    for b in range(1, n + 1):
        a = np.arange(b)
        cost = best[a] + (C[b] - C[a]) * np.log(np.maximum((S[b] - S[a]) / (C[b] - C[a]), 1e-300)) + penalty
        last[b] = int(np.argmin(cost))
        best[b] = cost[last[b]]
    ends = [n]
    while ends[-1] > 0:
        ends.append(int(last[ends[-1]]))
    cuts = np.array(ends[::-1])
    return np.asarray(edges[cuts[1:-1] - 1])


def describe_disturbances(disturbances: Sequence[Disturbance]) -> str | None:
    """Lines and jumps in one sentence; ``None`` if there are none."""
    lines = sorted({float(f"{d.at:.4g}") for d in disturbances if d.kind == "line"})
    jumps = sorted({round(d.at) for d in disturbances if d.kind == "jump"})
    texts = []
    if lines:
        texts.append("lines at " + ", ".join(f"{x:.4g} Hz" for x in lines[:MOST_LINES]))
    if jumps:
        texts.append("jumps at " + ", ".join(f"{x} s" for x in jumps))
    return "the output has " + " and ".join(texts) if texts else None


def describe_level(level: Level) -> str | None:
    """What the level follows, in one sentence; ``None`` if it is constant."""
    if not level.parts:
        return None
    names = {
        "time": "over the record",
        "phi": "with the disc angle",
        "input-rms": "with the specific force along the input axes",
        "input": "with the specific force along the input axes",
    }
    one = "with the specific force along one input axis"
    named = [names.get(p.name, one if p.name.startswith("input(") else f"with {p.name}") for p in level.parts]
    texts = [f"{name} ({p.ratio:.2g} times)" for name, p in zip(named, level.parts, strict=True)]
    return f"the noise level changes {' and '.join(texts)}; samples are weighted accordingly"


# channels whose own values are no quantity for a level, but their sizes
MOTION = frozenset((*SPECIFIC_FORCE, *ANGULAR_RATE, *ANGULAR_ACCELERATION, *GRADIENT))


@dataclass(frozen=True)
class SpectralLine:
    """A sinusoid in one of the whitened series: Hz, and its amplitude, V; 0 where that is counted with another one next to it."""

    output: int
    frequency: float
    amplitude: float


@dataclass(frozen=True)
class NoiseModel:
    """The noise of an observation of m series (:mod:`noise_estimate`); :meth:`whiten` makes it white, of unit variance.

    It is noise of a spectrum for every whitened series, whose level may follow what is known from sample to sample, and lines. What
    follows it is all of the noise (uniformly modulated noise: M. Priestley, J. R. Stat. Soc. B 27, 1965), or the white noise upon a drift
    (:mod:`drifting_noise`).
    The filters are causal and finite: linear, hence exact on columns however much larger than the noise they are, and a long record can
    be streamed through them. Samples that are not valid are interpolated, in data and columns alike, as the noise makes most likely
    (:func:`fir.fill_gaps`), and the filters start from rest: what the model explains it explains before and after; only the noise next to
    the start is not perfectly white.

    Attributes
    ----------
    spectra, filters
        Of every whitened series; taps of the filters, 1/V.
    level
        The noise level from sample to sample.
    drifts
        Of every whitened series whose level is of the white noise upon a drift: whitened by these in the place of the filters.
    lines
        Those that are neither of the motion nor next to a multiple of the spin rate; they are projected out of data and columns.
    combinations
        (m, m), orthonormal rows: the whitened series are these combinations of the observed ones; ``None``: they are these themselves.
    disturbed
        Which lines and jumps are no part of it, and how its level changes, in words.
    freedom
        Degrees of freedom from which it is known.
    """

    spectra: tuple[Spectrum, ...]
    filters: tuple[Array, ...]
    level: Level = field(default_factory=Level)
    drifts: tuple[DriftingNoise, ...] = ()
    lines: tuple[SpectralLine, ...] = ()
    combinations: Array | None = field(default=None, compare=False)
    disturbed: str | None = None
    freedom: float = np.inf

    @staticmethod
    def white(rate: float, outputs: int, size: float = 1.0) -> NoiseModel:
        """White noise of such a size, V, in every series."""
        level = np.full(2, np.log(2 * size**2 / rate))
        flat = Spectrum(rate, np.array([-20.0, 20.0]), level, np.zeros(2))
        return NoiseModel(spectra=(flat,) * outputs, filters=(np.array([1.0 / size]),) * outputs)

    @property
    def outputs(self) -> int:
        """Number of whitened series."""
        return len(self.filters)

    @property
    def memory(self) -> int:
        """Samples before one that its whitened value depends on."""
        return max(len(t) for t in self.filters) - 1

    @property
    def uneven(self) -> bool:
        """Whether its level changes."""
        return bool(self.level.parts)

    def line_power_of(self, signs: Array) -> float:
        """V^2, of the lines, of the output in which the series count so (m,)."""
        weights = self.weights(signs)
        return float(sum(weights[x.output] ** 2 * x.amplitude**2 / 2 for x in self.lines))

    def psd(self, f: Array, signs: Array) -> Array:
        """One-sided density at frequencies f, V^2/Hz, of the output in which the series count so (m,)."""
        weights = self.weights(signs) ** 2
        return np.asarray(sum(w * s.psd(f) for w, s in zip(weights, self.spectra, strict=True)))

    def variance(self, signs: Array) -> float:
        """V^2, of that output."""
        weights = self.weights(signs) ** 2
        return float(sum(w * s.rms**2 for w, s in zip(weights, self.spectra, strict=True)))

    def swell(self, r: Record) -> float:
        """Power of all noise of a record over that of the segments that it was estimated from."""
        return float(np.mean(np.square(np.broadcast_to(self.level.of(r.quantity), r.valid.shape)[r.valid])))

    @property
    def power(self) -> float:
        """V^2, mean over the whitened series, without lines."""
        return float(np.mean([s.rms**2 for s in self.spectra]))

    @property
    def line_power(self) -> float:
        """V^2, of the lines, mean over the series."""
        return sum(x.amplitude**2 / 2 for x in self.lines) / self.outputs

    def weights(self, w: Array) -> Array:
        """(outputs,): how what counts so in the series (m,) counts in the whitened ones."""
        return w if self.combinations is None else self.combinations @ w

    def whiten(
        self,
        columns: Array,
        valid: NDArray[np.bool_] | None = None,
        level: Array | float = 1.0,
        *,
        lead: int = 0,
    ) -> Array:
        """Columns (n, m, N) V of a whole flight, zero where a sample is not ``valid`` (N,), whitened: as :meth:`whiten_segment`."""
        return self.whiten_segment(columns, valid, level, None, lead=lead)[0]

    def whiten_segment(
        self,
        columns: Array,
        valid: NDArray[np.bool_] | None,
        level: Array | float,
        past: Sequence[Array | Past] | None,
        *,
        lead: int = 0,
    ) -> tuple[Array, Sequence[Array | Past]]:
        """Columns of a segment of a flight, whitened, and what the filters need to go on after it.

        Parameters
        ----------
        columns
            (n, m, N) V, zero where a sample is not ``valid`` (N,); gaps are filled as the noise makes most likely.
        level
            (N,) or one number: :attr:`level` at these samples.
        past
            Of the segment before; ``None``: the filters start from rest.
        lead
            First samples that are not wanted.

        Returns
        -------
        (n, rows): one output after the other; and the past of the next segment.
        """
        n = columns.shape[2]
        valid = np.ones(n, dtype=np.bool_) if valid is None else valid
        x = columns if self.combinations is None else np.matmul(self.combinations, columns)
        level = np.broadcast_to(level, n)
        white, end = [], []
        for k in range(self.outputs):
            y, after = self.whiten_series(x[:, k], k, valid, level, None if past is None else past[k], lead)
            white.append(y if valid.all() else y[:, valid[lead:]])
            end.append(after)
        return white[0] if len(white) == 1 else np.concatenate(white, axis=1), end

    def whiten_series(
        self,
        x: Floats,
        output: int,
        valid: NDArray[np.bool_] | None,
        level: Array,
        past: Floats | Past | None,
        lead: int,
    ) -> tuple[Floats | Array, Floats | Past]:
        """Columns (n, N) of one whitened series, all of whose samples are taken as they are where ``valid`` is ``None``: (n, N - lead)."""
        if self.drifts:
            assert not isinstance(past, np.ndarray)
            seen = np.ones(len(level), dtype=np.bool_) if valid is None else valid
            return self.drifts[output].whiten(x, level, seen, past, lead)
        assert not isinstance(past, Past)
        taps = self.filters[output]
        even = self._divide(x, level)
        filled = even if valid is None else fill_gaps(even, valid, taps)
        y = filter_columns(filled, taps, past, lead)
        if past is not None and len(level) < len(taps) - 1:
            filled = np.concatenate([past, filled], axis=1)
        return y, filled[:, max(0, filled.shape[1] - len(taps) + 1) :]

    def whiten_back(self, white: Array, weights: Array, valid: NDArray[np.bool_], level: Array) -> Array:
        """(N,): whitened series (outputs, N) through the transposed filters, and added by ``weights`` (outputs,): the product with a
        term of the output is that of the whitened term.
        """
        if self.drifts:
            each = zip(self.drifts, weights, white, strict=True)
            return np.asarray(sum(w * d.whiten_back(y, level, valid) for d, w, y in each))
        total = np.zeros(white.shape[1])
        for series, w, taps in zip(white, weights, self.filters, strict=True):
            total += filter_columns(np.ascontiguousarray(series[None, ::-1]), np.asarray(w * taps))[0, ::-1]
        return self._divide(total, level)

    def measure_log_size(self, level: Array, valid: NDArray[np.bool_]) -> float:
        """Sum of the logarithms of the standard deviations, V, of what is new in each valid sample (N,) of every whitened series."""
        if self.drifts:
            return sum(d.measure_log_size(level, valid) for d in self.drifts)
        return float(
            self.outputs * np.sum(np.log(level[valid]))
            - np.sum(valid) * sum(np.log(t[0]) for t in self.filters)
        )

    def _divide(self, x: Floats, level: Array) -> Floats:
        """Series (..., N) over the level."""
        return np.asarray(x / np.asarray(level, dtype=x.dtype)) if self.uneven else x

    def line_columns(self, time: Array, series: int) -> Array:
        """(k, m, n): what the lines span at some times, s, each in one of the m ``series``."""
        shown = np.eye(series) if self.combinations is None else self.combinations
        columns = [
            Disturbance("line", x.frequency).columns(time)[:, None] * shown[x.output][:, None]
            for x in self.lines
        ]
        return np.concatenate(columns) if columns else np.empty((0, series, len(time)))

    def variance_shapes(self, r: Record) -> Array:
        """(k, rows): what the variance of whitened samples may follow (:func:`make_shapes`), one output after the other."""
        shapes = make_shapes(r.quantity, level_quantities(r), self.level)[:, r.valid]
        return np.tile(shapes, self.outputs)


def level_quantities(r: Record) -> list[str]:
    """Names of what a level of noise may follow in a record."""
    names = ["time", *(f"abs({c})" for c in SPECIFIC_FORCE if c in r.wide)]
    names += [f"abs({c[0][:-2]})" for c in (ANGULAR_RATE, ANGULAR_ACCELERATION) if set(c) <= set(r.wide)]
    if set(SPECIFIC_FORCE) <= set(r.wide):
        names += ["abs(a)", "input-rms", *(("input",) if r.turning else ())]
        names += [f"input({k})" for k in r.different_axes] if len(r.different_axes) > 1 else []
    names += sorted(n for n in r.wide if n not in MOTION and not is_disc_angle(n))
    names += ["phi"] if r.turning else []
    return names
