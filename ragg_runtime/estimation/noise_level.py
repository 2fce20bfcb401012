"""The level of the noise from sample to sample: it may change in time, with the motion, or with the disc's angle.

A level that is taken as constant where it changes biases every test: noisy intervals weigh too much, and a
term that is large where the noise is large looks significant. A noise whose level follows what is known is made white of
unit variance by one factor per sample, before its filter or after it, whichever is likelier (``NoiseModel.level_first``).
Whether the level follows something is asked by the studentised test of R. Koenker (J. Econometrics 17, 1981): the squares
against groups of samples, with their own fourth moment, so that heavy tails are no evidence.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation.scores import log_sf

Array = NDArray[np.float64]

CHANGES = false_alarms.LEVEL
"""p-value, over all that is asked, from which the level follows something."""

INTERVALS = 48
"""Intervals of time whose levels are compared."""

FINEST = 512
"""Most of those between which the level may change."""

GROUPS = (*(np.arange(1, 8) / 8), 15 / 16, 31 / 32)
"""Shares of the samples, in the order of some quantity, at which groups end: forces have long tails, and there the noise is loudest."""

STEPPED = ("time", "phi")
"""Quantities between whose groups the level steps; with any other one it goes on smoothly, and variances may grow."""

SECTORS = 16
"""Sectors of the disc's angle: a level that swells twice a turn takes eight for each time."""

ABSENT = 1e-9
"""Share of a direction's square below which it is rounding."""

FEWEST = 20
"""Samples that a group must have."""

MOST = 3
"""Most things that the level follows at once."""


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
    found = [np.ones_like(quantity("time"))]
    for n in dict.fromkeys(names):
        if n not in STEPPED:
            x = quantity(n)
            found += [x, x**2] if n.startswith(("abs(", "input(")) or n in ("input-rms", "input") else [x]
    weight = np.broadcast_to(level.of(quantity), found[0].shape) ** -2.0
    return np.stack([np.ones_like(weight), *(f * weight for f in found)])


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


def estimate_level(
    white: Array,
    quantities: Mapping[str, Array],
    alternatives: Mapping[str, Array],
) -> Level:
    """The level of whitened residuals (N,) as a function of ``quantities``, (N,) each; ``time`` and ``phi`` have a meaning.

    Nothing is concluded once one of the ``alternatives``, variances (N,) that random effects would add, explains it best and more than
    quantities can: that is for a test of that effect.
    """
    parts: list[LevelFactor] = []
    u = white
    asked = len(quantities) + len(alternatives)
    alternatives = {n: x for n, x in alternatives.items() if _is_alternative(white, x, quantities, asked)}
    while len(parts) < MOST:
        tests = {n: _test(u, n, x) for n, x in (*quantities.items(), *alternatives.items())}
        follows = {n: t for n, t in tests.items() if t.log_p + np.log(asked) < np.log(CHANGES)}
        best = max(follows, key=lambda n: (follows[n].gain, n), default=None)
        part = None if best is None else follows[best].part
        if best is None or part is None or best in alternatives:
            break
        parts.append(part)
        u = u / part.of(quantities[best])
    level = Level(tuple(parts)).of(quantities.__getitem__)
    return Level(tuple(parts), 1.0 / float(np.sqrt(np.mean(np.square(level)))))


def _is_alternative(u: Array, variance: Array, quantities: Mapping[str, Array], asked: int) -> bool:
    """Whether a variance (N,) explains more of u (N,) than shapes of the quantities can."""
    X = np.stack([*make_shapes(quantities.__getitem__, quantities, Level()), variance, u**2])
    return bool(special.log_ndtr(-score_excess(X @ X.T)[0]) + np.log(asked) < np.log(CHANGES))


@dataclass(frozen=True)
class _Follows:
    """Whether the level follows a quantity: logarithm of the p-value that it does not, how it does, and what that gains in description.

    ``gain``: of log likelihood less BIC's penalty, with the squares' own fourth moment.
    """

    log_p: float = 0.0
    part: LevelFactor | None = None
    gain: float = 0.0


def _test(u: Array, name: str, x: Array) -> _Follows:
    """Of u (N,) in groups of x (N,), in each of which the mean square may be another."""
    edges = _find_edges(name, x)
    if not len(edges):
        return _Follows()
    square = u**2
    count, power = _sum_groups(edges, x, square)
    if len(count) <= len(edges) or np.min(count) < FEWEST:
        return _Follows()
    mean = float(np.mean(square))
    ratio = float(np.mean(square**2)) / mean**2 - 1.0
    log_p = log_sf(float(np.sum(count * (power / count / mean - 1.0) ** 2)) / max(ratio, 1e-3), len(edges))
    if name == "time":  # a burst is short
        fine = np.quantile(x, np.linspace(0.0, 1.0, min(FINEST, len(x) // FEWEST) + 1)[1:-1])
        edges = _partition_intervals(fine, *_sum_groups(fine, x, square), float(np.mean(square**2)))
        if not len(edges):
            return _Follows()
        count, power = _sum_groups(edges, x, square)
    mean_of = power / count
    inner = max(2.0, float(np.mean(square**2)) / float(np.average(mean_of**2, weights=count)) - 1.0)
    gain = -0.5 * float(np.sum(count * np.log(np.maximum(mean_of / mean, 1e-300)))) * 2.0 / inner
    at = edges if name in STEPPED else _sum_groups(edges, x, x)[1] / count
    each = 2.0 if name == "time" else 1.0  # an instant, too
    return _Follows(
        log_p,
        LevelFactor(name, np.asarray(at), np.sqrt(mean_of / mean)),
        gain - 0.5 * each * len(edges) * float(np.log(len(u))),
    )


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
    said = [f"{name} ({p.ratio:.2g} times)" for name, p in zip(named, level.parts, strict=True)]
    return f"the noise level changes {' and '.join(said)}; samples are weighted accordingly"
