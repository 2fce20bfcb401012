"""Is anything left? A search over generic terms of the residual, and the names of those that are there.

After the model and the chosen effects are projected out, every term of the dictionary is scored against
what remains. The largest score of an effect-free record is known, so its significance is; terms are taken
one by one (orthogonal matching pursuit) while the largest is significant.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from ragg_runtime.calibrate import Noise
from ragg_runtime.terms import Dictionary, Term
from ragg_runtime.whiten import whiten

Array = NDArray[np.float64]

FAMILY = 0.01
"""Probability with which the whole dictionary of an effect-free record may raise a false alarm."""

MOST_TERMS = 8


@dataclass(frozen=True)
class Found:
    """A generic term in a residual.

    Attributes
    ----------
    coefficient
        V per SI unit of the product of channels.
    z
        Its significance when it was taken, in standard deviations.
    chi2
        What it explained then.
    """

    term: Term
    coefficient: float
    std: float
    z: float
    chi2: float


@dataclass(frozen=True)
class Omnibus:
    """The search over one flight's dictionary: p-value of the largest score, and the terms taken."""

    log_p: float
    tried: int
    terms: tuple[Found, ...]
    chi2: float
    residual: Array

    @property
    def significant(self) -> bool:
        return bool(self.log_p < np.log(FAMILY))


def search(
    dictionary: Dictionary,
    valid: NDArray[np.bool_],
    noise: Noise,
    weights: Array,
    Q: Array,
    residual: Array,
    view: Callable[[Array], Array] | None = None,
    most: int = MOST_TERMS,
) -> Omnibus:
    """Score the dictionary against a whitened residual.

    Parameters
    ----------
    weights
        (m,): how much of a term each output sees (for voltages every output is searched as one).
    Q
        (rows, k): what is projected out.
    residual
        (rows,): whitened, already projected.
    view
        What the recorder made of G_out before it was recorded (a demodulator), if anything.
    """
    series: list[tuple[Term, float]] = []
    pieces: list[NDArray[np.float32]] = []
    basis32 = Q.astype(np.float32)
    for terms, x in dictionary.chunks():
        if view is not None:
            x = view(x.astype(np.float64)).astype(np.float32)
        parts = []
        for w, taps in zip(weights, noise.filters, strict=True):
            parts.append(np.float32(w) * whiten(x, taps, valid))
        X = np.concatenate(parts, axis=1)
        before = np.linalg.norm(X, axis=1)
        X -= (X @ basis32) @ basis32.T
        after = np.linalg.norm(X, axis=1)
        # in single precision a column that is nearly all in the base has no direction of its own left
        good = after > 1e-3 * before
        scale = np.where(good, after, np.float32(np.inf))
        pieces.append((X / scale[:, None]).astype(np.float32))
        series += list(zip(terms, scale, strict=True))
    X = np.concatenate(pieces)
    pieces.clear()
    scales = np.array([s for _, s in series])
    tried = int(np.sum(np.isfinite(scales)))
    e = residual.astype(np.float32)
    taken: list[Found] = []
    directions: list[Array] = []
    left = np.ones(len(X))  # squared norm that remains of every unit column
    score = (X @ e).astype(float)
    log_p_first = 0.0
    chi2 = 0.0
    for round_ in range(most + 1):
        z = np.where(left > 0.05, score / np.sqrt(np.maximum(left, 0.05)), 0.0)
        k = int(np.argmax(np.abs(z)))
        log_p = min(0.0, float(stats.norm.logsf(abs(z[k]))) + np.log(2 * max(tried, 1)))
        if round_ == 0:
            log_p_first = log_p
        if log_p >= np.log(FAMILY) or round_ == most:
            break
        q = X[k].astype(float)
        for d in directions:
            q -= d * (d @ q)
        norm = float(np.linalg.norm(q))
        q /= norm
        directions.append(q)
        along = (X @ q.astype(np.float32)).astype(float)
        amount = float(q @ residual)
        score -= along * amount
        left -= along**2
        chi2 += amount**2
        term = series[k][0]
        std = 1.0 / (float(scales[k]) * norm * dictionary.rms(term))
        taken.append(Found(term, amount * std, std, float(z[k]), amount**2))
    return Omnibus(log_p_first, tried, tuple(taken), chi2, residual)


def strongest(found: Sequence[Found]) -> list[Found]:
    return sorted(found, key=lambda t: -t.chi2)
