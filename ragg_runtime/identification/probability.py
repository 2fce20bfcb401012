"""How probable each effect is: all sets of up to three effects, weighed by their evidence.

With Zellner's prior b ~ N(0, g (X'X)^-1) the evidence of a set S against the empty one is exact (A. Zellner 1986; F. Liang et al.,
J. Am. Stat. Assoc. 103, 2008), log B_S(g) = chi2_S / 2 * g / (1 + g) - k_S / 2 * log(1 + g), with chi2_S what its k_S coefficients
explain. g is averaged over eight decades; each of E effects is present with probability 1/E (J. Scott and J. Berger, Ann. Stat. 38,
2010).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, combinations, compress

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.identification.likelihood_ratio import list_ways, log_bayes
from ragg_runtime.identification.selection import ProjectedProblem

Array = NDArray[np.float64]

LARGEST = 3
"""Most effects of a set."""

HELD = 0.95
"""Probability that the credible set holds together."""

KEPT = 40.0
"""Log odds below the best set from which a set has no weight: 40 are 1e-17, and no sum of 20,000 sets shows them."""

RIDGE = 1e-9
"""Added to the inner products of orthonormal blocks: effects that coincide count once."""


@dataclass(frozen=True)
class Probabilities:
    """Posterior over sets of effects: probability ``of`` each effect, and the ``credible`` sets, the smallest list, the most
    probable first, that holds :data:`HELD`; the empty set is ``()``.
    """

    of: Mapping[str, float]
    credible: tuple[tuple[str, ...], ...]

    def within(self, share: float) -> Probabilities:
        """The same where the catalogue has but a share of the probability; the rest, like what is not missing, is the empty set."""
        others = tuple(s for s in self.credible if s)
        credible = self.credible if share > HELD else ((), *others) if share > 1.0 - HELD else ((),)
        return Probabilities({e: p * share for e, p in self.of.items()}, credible)


@dataclass(frozen=True)
class Sets:
    """Sets of effects: which of the sorted effects each ``holds`` (sets, effects), and the logarithm of its weight (sets,)."""

    effects: tuple[str, ...]
    holds: NDArray[np.bool_]
    logs: Array

    def with_one_of(self, options: Sequence[str]) -> Sets:
        """The sets where one of ``options`` is sure to be present, each as probable as the others beforehand."""
        effects = tuple(sorted({*self.effects, *options}))
        holds = np.zeros((len(options), len(self.logs), len(effects)), dtype=bool)
        holds[:, :, [effects.index(e) for e in self.effects]] = self.holds
        for way, option in zip(holds, options, strict=True):
            way[:, effects.index(option)] = True
        logs = np.tile(self.logs - np.log(len(options)), len(options))
        return Sets(effects, *_merge_sets(holds.reshape(-1, len(effects)), logs))

    def probabilities(self) -> Probabilities:
        """The probability of each effect."""
        top = self.logs.max()
        kept = np.flatnonzero(self.logs > top - KEPT)
        share = np.exp(self.logs[kept] - top)
        share /= share.sum()
        of = np.sum(share[:, None] * self.holds[kept], axis=0)
        order = np.argsort(-share, kind="stable")
        enough = int(np.searchsorted(np.cumsum(share[order]), HELD)) + 1
        credible = tuple(tuple(compress(self.effects, self.holds[s])) for s in kept[order[:enough]])
        return Probabilities(dict(zip(self.effects, np.minimum(of, 1.0).tolist(), strict=True)), credible)


@dataclass(frozen=True)
class _Subspace:
    """One way in which an effect may be present: orthonormal directions (rows, k), what y has along them, log weight."""

    effect: str
    Q: Array
    along: Array
    weight: float


def weigh_sets(f: ProjectedProblem) -> Sets:
    """All sets of up to :data:`LARGEST` of the problem's effects, weighed."""
    blocks = [
        _Subspace(e, w.Q, w.Q.T @ f.P[:, -1], -float(np.log(w.count)) - f.penalty.get(e, 0.0))
        for e in sorted(f.candidates)
        for w in list_ways(f.P, f.candidates[e], f.floor, weakest=0.0)
    ]
    effects = tuple(dict.fromkeys(b.effect for b in blocks))
    odds = -np.log(max(1, len(effects) - 1))  # of presence, with probability 1/E
    alone = _weigh_evidence(blocks, np.arange(len(blocks), dtype=np.intp)[:, None])
    # the longest block first: it costs nothing in a set, and all sets of one shape are worked on at once
    best = sorted(_choose_best(blocks, alone), key=lambda b: (-len(b.along), b.effect))
    place = np.array([effects.index(b.effect) for b in best], dtype=np.intp)
    every = [np.array([effects.index(b.effect) for b in blocks], dtype=np.intp)[:, None]]
    logs = [np.zeros(1), alone + odds]
    for size in range(2, LARGEST + 1):
        flat = chain.from_iterable(combinations(range(len(best)), size))
        sets = np.fromiter(flat, dtype=np.intp).reshape(-1, size)
        every.append(place[sets])
        logs.append(_weigh_evidence(best, sets) + size * odds)
    holds = np.zeros((sum(map(len, logs)), len(effects)), dtype=bool)
    first = 1  # the empty set
    for sets in every:
        holds[np.arange(first, first + len(sets))[:, None], sets] = True
        first += len(sets)
    return Sets(effects, *_merge_sets(holds, np.concatenate(logs)))


def _merge_sets(holds: NDArray[np.bool_], logs: Array) -> tuple[NDArray[np.bool_], Array]:
    """Each set once, with the sum of its weights; in an order that depends on nothing but the sets."""
    bits = np.packbits(holds, axis=1)
    # a key that is the same for all: without effects there is no other
    order = np.lexsort(np.vstack([np.zeros(len(logs), dtype=np.uint8), 255 - bits.T])[::-1])
    bits = bits[order]
    new = np.concatenate([[True], np.any(bits[1:] != bits[:-1], axis=1)])
    return holds[order[new]], np.logaddexp.reduceat(logs[order], np.flatnonzero(new))


def _choose_best(blocks: Sequence[_Subspace], alone: Array) -> list[_Subspace]:
    """The most probable form of each effect, which represents it in larger sets (with its weight)."""
    chosen: dict[str, tuple[float, _Subspace]] = {}
    for b, value in zip(blocks, alone, strict=True):
        if b.effect not in chosen or value > chosen[b.effect][0]:
            chosen[b.effect] = (float(value), b)
    return [b for _, b in chosen.values()]


def _weigh_evidence(blocks: Sequence[_Subspace], sets: NDArray[np.intp]) -> Array:
    """log B (n,) of sets (n, size) of blocks against the empty set, g averaged and the blocks' weights in."""
    if not len(sets):
        return np.empty(0)
    Q = np.concatenate([b.Q for b in blocks], axis=1)
    y = np.concatenate([b.along for b in blocks])
    inner = Q.T @ Q
    length = np.array([len(b.along) for b in blocks])
    start = np.cumsum(length) - length
    lengths = length[sets]
    chi2, freedom = np.empty(len(sets)), np.sum(lengths, axis=1)
    shape = lengths @ (1 + length.max()) ** np.arange(sets.shape[1])
    for s in np.unique(shape):
        members = np.flatnonzero(shape == s)
        begins = zip(start[sets[members]].T, lengths[members[0]], strict=True)
        at, *further = [x + np.arange(k)[:, None] for x, k in begins]
        chi2[members] = np.sum(y[at] ** 2, axis=0)
        if further:  # what the first block, orthonormal, leaves of the others
            rest = np.concatenate(further)
            shared = inner[at[:, None], rest]
            G = inner[rest[:, None], rest] - np.einsum("aks,als->kls", shared, shared)
            chi2[members] += _eliminate(G, y[rest] - np.einsum("aks,as->ks", shared, y[at]))
    weight = np.sum(np.array([b.weight for b in blocks])[sets], axis=1)
    return np.asarray(log_bayes(chi2, freedom) + weight)


def _eliminate(G: Array, y: Array) -> Array:
    """y' G^-1 y (sets,) of inner products (k, k, sets) and (k, sets), by elimination in all sets at once; both are overwritten."""
    chi2 = np.zeros(y.shape[1])
    for j in range(len(y)):
        pivot = G[j, j] + RIDGE
        chi2 += y[j] ** 2 / pivot
        factor = G[j + 1 :, j] / pivot
        y[j + 1 :] -= factor * y[j]
        G[j + 1 :, j + 1 :] -= factor[:, None] * G[j, j + 1 :]
    return chi2
