"""How probable each effect is: all sets of up to three effects, weighed by their evidence.

On the triangle of a record, with base columns projected out, a set S of effects says y = X_S b + unit noise. With Zellner's
prior b ~ N(0, g (X'X)^-1) the evidence of S against the empty set is exact,

    log B_S(g) = chi2_S / 2 * g / (1 + g) - k_S / 2 * log(1 + g),

with chi2_S what the set explains and k_S its number of coefficients (A. Zellner 1986; F. Liang et al., J. Am. Stat.
Assoc. 103, 2008). How strong an effect is nobody knows beforehand: g is averaged over eight decades. Each effect is present with
probability 1/E of E, independently of the others: one is missing on average, and the number of ways in which one might be
wrong is paid for (J. Scott and J. Berger, Ann. Stat. 38, 2010).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.special import logsumexp

from ragg_runtime.evidence.likelihood_ratio import sub_blocks
from ragg_runtime.evidence.selection import Field

Array = NDArray[np.float64]

LARGEST = 3
"""Most effects of a set."""

STRENGTHS = np.logspace(0.0, 8.0, 17)
"""Prior variance of an effect over that of the noise, g: from what hides in the noise to 1e4 times its standard deviation."""

HELD = 0.95
"""Probability that the credible set holds together."""

KEPT = 40.0
"""Log odds below the best set from which a set has no weight: 40 are 1e-17, and no sum of 20,000 sets shows them."""

RIDGE = 1e-9
"""Added to the inner products of orthonormal blocks: effects that coincide count once."""


@dataclass(frozen=True)
class Probabilities:
    """Posterior over sets of effects.

    Attributes
    ----------
    of
        Effect id -> probability that it is missing in the model.
    credible
        Smallest list of sets, the most probable first, that together hold :data:`HELD`; the empty set is ``()``.
    sets
        Probability of every set that has weight.
    """

    of: Mapping[str, float]
    credible: tuple[tuple[str, ...], ...]
    sets: Mapping[tuple[str, ...], float]


@dataclass(frozen=True)
class _Block:
    """One way in which an effect may be present: orthonormal directions (rows, k), what y has along them, log weight."""

    effect: str
    Q: Array
    along: Array
    weight: float


def probabilities(f: Field, given: Sequence[str] = ()) -> Probabilities:
    """Weigh all sets of up to :data:`LARGEST` of the field's effects; ``given`` are sure and projected out beforehand."""
    return summed(*weights(f, given))


def weights(f: Field, given: Sequence[str] = ()) -> tuple[dict[tuple[str, ...], float], list[str]]:
    """Logarithms of the weights of all those sets, and the effects in them."""
    P, floor = f.P, f.floor
    if given:
        P, floor = f.onto([n for e in given for n, _ in f.candidates[e]])
    blocks = [b for e in f.candidates if e not in given for b in _blocks(f, P, floor, e)]
    effects = sorted({b.effect for b in blocks})
    if not effects:
        return {(): 0.0}, []
    odds = -np.log(max(1, len(effects) - 1))  # of presence, with probability 1/E
    alone = _evidence(blocks, np.arange(len(blocks), dtype=np.intp)[:, None])
    ways: dict[tuple[str, ...], list[float]] = {(): [0.0]}
    for b, value in zip(blocks, alone, strict=True):
        ways.setdefault((b.effect,), []).append(float(value) + odds)
    logs = {s: float(logsumexp(v)) for s, v in ways.items()}
    best = sorted(_best(blocks, alone), key=lambda b: b.effect)
    for size in range(2, LARGEST + 1):
        sets = np.array(list(combinations(range(len(best)), size)), dtype=np.intp).reshape(-1, size)
        values = _evidence(best, sets) + size * odds
        logs.update(zip(combinations((b.effect for b in best), size), values.tolist(), strict=True))
    return logs, effects


def _blocks(f: Field, P: Array, floor: Array, effect: str) -> list[_Block]:
    """The ways in which an effect may be present, those that the record can see."""
    made = []
    for places, count in sub_blocks(f.candidates[effect]):
        X = P[:, list(places)]
        usable = np.linalg.norm(X, axis=0) > floor[list(places)]
        if not usable.any():
            continue
        if len(places) == 1:
            Q = X / np.linalg.norm(X)
        else:
            U, s, _ = np.linalg.svd(X[:, usable], full_matrices=False)
            Q = U[:, s > s[0] * 1e-7]
        weight = -float(np.log(count)) - f.penalty.get(effect, 0.0)
        made.append(_Block(effect=effect, Q=Q, along=Q.T @ P[:, -1], weight=weight))
    return made


def _best(blocks: Sequence[_Block], alone: Array) -> list[_Block]:
    """The most probable way of each effect, by which it stands in larger sets (its weight is paid there, too)."""
    chosen: dict[str, tuple[float, _Block]] = {}
    for b, value in zip(blocks, alone, strict=True):
        if b.effect not in chosen or value > chosen[b.effect][0]:
            chosen[b.effect] = (float(value), b)
    return [b for _, b in chosen.values()]


def _evidence(blocks: Sequence[_Block], sets: NDArray[np.intp]) -> Array:
    """log B (n,) of sets (n, size) of blocks against the empty set, g averaged and the blocks' weights in."""
    if not len(sets):
        return np.empty(0)
    Q = np.concatenate([b.Q for b in blocks], axis=1)
    y = np.concatenate([b.along for b in blocks])
    inner = Q.T @ Q
    length = np.array([len(b.along) for b in blocks])
    start = np.cumsum(length) - length
    # the shortest block first: fewer shapes, each of which is worked on at once
    sets = np.take_along_axis(sets, np.argsort(length[sets], axis=1, kind="stable"), axis=1)
    chi2, freedom = np.empty(len(sets)), np.sum(length[sets], axis=1)
    shapes, which = np.unique(length[sets], axis=0, return_inverse=True)
    for n, shape in enumerate(shapes):
        members = np.flatnonzero(which.ravel() == n)
        first = start[sets[members]]
        at = np.concatenate([first[:, [m]] + np.arange(k) for m, k in enumerate(shape)], axis=1)
        G = inner[at[:, :, None], at[:, None, :]] + RIDGE * np.eye(at.shape[1])
        chi2[members] = np.sum(y[at] * np.linalg.solve(G, y[at][:, :, None])[:, :, 0], axis=1)
    weight = np.sum(np.array([b.weight for b in blocks])[sets], axis=1)
    shrink = STRENGTHS / (1.0 + STRENGTHS)
    each = 0.5 * chi2[:, None] * shrink - 0.5 * freedom[:, None] * np.log1p(STRENGTHS)
    averaged: Array = np.asarray(logsumexp(each, axis=1)) - np.log(len(STRENGTHS)) + weight
    return averaged


def summed(logs: Mapping[tuple[str, ...], float], effects: Sequence[str]) -> Probabilities:
    """What logarithms of weights of sets say of each effect."""
    top = max(logs.values())
    kept = {s: v for s, v in logs.items() if v > top - KEPT}
    total = float(logsumexp(list(kept.values())))
    sets = {s: float(np.exp(v - total)) for s, v in sorted(kept.items(), key=lambda x: (-x[1], x[0]))}
    of = dict.fromkeys(effects, 0.0)
    for s, p in sets.items():
        for e in s:
            of[e] += p
    credible, held = [], 0.0
    for s, p in sets.items():
        credible.append(s)
        held += p
        if held >= HELD:
            break
    return Probabilities(of={e: min(1.0, p) for e, p in of.items()}, credible=tuple(credible), sets=sets)
