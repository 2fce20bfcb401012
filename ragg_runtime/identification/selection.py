"""Which effects: forward selection among sets of them, on R factors alone."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain, combinations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation import likelihood_ratio
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.likelihood_ratio import Test, list_ways, log_bayes, weigh
from ragg_runtime.estimation.observation import BLOCKS
from ragg_runtime.estimation.regressors import Column, group_by_effect
from ragg_runtime.estimation.scores import DISTINGUISHABLE, INDISTINGUISHABLE
from ragg_runtime.estimation.whitening import PreparedFlight

Array = NDArray[np.float64]

# probability with which the whole catalogue of an effect-free record may raise a false alarm
FAMILY = false_alarms.CATALOGUE
# the same for each effect beside the first: a chance companion would spoil what is found
FURTHER = false_alarms.COMPANION
MOST = 4  # most effects that are claimed at once
# log evidence by which another set of effects must be better to take the place of a chosen one
SWAPPED = 2.0

# log evidence (a factor of 1,100: 3 sigma beside 5) by which many coefficients may cost an effect that explains as much; with more it
# is no alternative
AS_SURE = 7.0


Blocks = Mapping[str, tuple[int, ...]]  # effects with the columns that each needs
Weights = Mapping[frozenset[str], float]  # how probable sets of effects are, up to a common factor


@dataclass(frozen=True)
class ProjectedProblem:
    """An R factor [base | candidates | residual] with the prior in, and the effects in it.

    ``candidates`` are columns after the base, by effect; ``penalty`` the logarithm of the number of variants an effect was chosen
    from; ``norms`` the candidates' whitened norms before projection; ``freedom`` that of the noise. ``flights``: those whose
    samples temper the tests, where the noise is uneven.
    ``contains``: the special cases of effects, which are no alternatives to them.
    """

    T: Array
    n_base: int
    candidates: Mapping[str, tuple[tuple[int, Column], ...]]
    penalty: Mapping[str, float] = field(default_factory=dict)
    freedom: float = np.inf
    flights: tuple[PreparedFlight, ...] = ()
    contains: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    norms: Array = field(init=False)
    P: Array = field(init=False)
    _cache: dict[tuple[str, ...], Mapping[str, Test]] = field(init=False, default_factory=dict)
    """Tests by the effects beside them: a selection asks for the same again when it swaps and drops."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "norms", np.linalg.norm(self.T[:, self.n_base :], axis=0))
        P = self.T[self.n_base :, self.n_base :]
        # with a positive diagonal: the signs of rows are rounding, and what is drawn of noise along them would change
        object.__setattr__(self, "P", P * np.where(np.diag(P) < 0.0, -1.0, 1.0)[:, None])

    @property
    def chi2(self) -> float:
        """Of what the base leaves, its priors included."""
        return float(np.sum(self.P[:, -1] ** 2))

    @property
    def floor(self) -> Array:
        return likelihood_ratio.find_floor(self.norms)

    def testable(self, effect: str) -> list[int]:
        """Columns of an effect that keep enough after projection to be tested."""
        left = np.linalg.norm(self.P, axis=0)
        return [n for n, _ in self.candidates[effect] if left[n] > self.floor[n]]

    def onto(self, columns: Sequence[int]) -> tuple[Array, Array]:
        """P with ``columns`` projected out of all others, and the floor that then holds."""
        U = likelihood_ratio.find_basis(self.P, columns, self.floor, weakest=0.0)
        if not U.shape[1]:
            return self.P, self.floor
        left = self.P - U @ (U.T @ self.P)
        # what a column shares with those already in may be all of it: then it cannot be tested either
        floor = np.maximum(self.floor, 1e-3 * np.linalg.norm(self.P, axis=0))
        return left, floor

    def tests(self, beside: Sequence[str] = ()) -> Mapping[str, Test]:
        """The test of every effect but those ``beside``, which are projected out."""
        key = tuple(beside)
        if key not in self._cache:
            self._cache[key] = self._compute_tests(key)
        return self._cache[key]

    def _compute_tests(self, beside: Sequence[str]) -> dict[str, Test]:
        P, floor = self.P, self.floor
        if beside:
            P, floor = self.onto([n for e in beside for n, _ in self.candidates[e]])
        tests = {
            e: likelihood_ratio.test(P, columns, floor, self.penalty.get(e, 0.0), self.freedom)
            for e, columns in self.candidates.items()
            if e not in beside
        }
        # tests that say nothing stay as they are
        raised = [e for e, t in tests.items() if t.rank > 0 and t.log_p <= np.log(FAMILY)]
        if self.flights and raised:
            base = [*range(self.n_base), *(self.n_base + n for e in beside for n, _ in self.candidates[e])]
            norms = np.linalg.norm(P, axis=0)
            tested = [[self.n_base + n for n in tests[e].which if norms[n] > floor[n]] for e in raised]
            scatter = likelihood_ratio.measure_scatter(self.T, self.flights, base, tested)
            for e, by, freedom in zip(raised, scatter.inflation, scatter.freedom, strict=True):
                tests[e] = likelihood_ratio.temper_test(tests[e], float(by), float(freedom), self.freedom)
        return tests

    @cached_property
    def count(self) -> int:
        """Number of effects that can be tested."""
        return sum(t.rank > 0 for t in self.tests().values())

    @cached_property
    def effective_count(self) -> float:
        """Number of independent tests that err as often as these, which are alike (:func:`likelihood_ratio.estimate_effective_number`)."""
        effects = (list_ways(self.P, c, self.floor) for c in self.candidates.values())
        return likelihood_ratio.estimate_effective_number([ways for ways in effects if ways], FAMILY)

    @cached_property
    def sets(self) -> Weights:
        """How probable each set of up to :data:`LARGEST` effects is."""
        return _weigh_sets(self)

    def significant(self, t: Test, family: float = FAMILY) -> bool:
        """Whether the test of an effect is significant over the family."""
        sure, possible = (is_significant(t, count, family) for count in (self.count, 1))
        return sure or (possible and is_significant(t, self.effective_count, family))

    def joint(self, blocks: Sequence[Sequence[int]]) -> tuple[float, int]:
        """(chi-square, rank) of the union of column blocks."""
        Q = likelihood_ratio.find_basis(self.P, [n for b in blocks for n in b], self.floor)
        return float(np.sum((Q.T @ self.P[:, -1]) ** 2)), Q.shape[1]


def is_significant(t: Test, count: float, family: float = FAMILY) -> bool:
    """Whether a test of one of ``count`` effects is significant over the family."""
    return bool(t.rank > 0 and t.log_p + np.log(max(count, 1.0)) < np.log(family))


def choose(f: ProjectedProblem, *, beside: bool = False) -> Blocks:
    """Effects that together account for what the model lacks, each with the columns that it needs, in the order of their choice.

    Forward selection; after each addition the most probable set of as many effects takes the place of what is chosen. ``beside``: others
    are in the model.
    """
    chosen: Blocks = {}
    seen: set[frozenset[str]] = set()
    while len(chosen) < MOST and frozenset(chosen) not in seen:
        seen.add(frozenset(chosen))
        level = FURTHER if chosen or beside else FAMILY
        tests = f.tests([*chosen])
        significant = [e for e, t in tests.items() if f.significant(t, level)]
        if not significant:
            break
        best = min(significant, key=lambda e: (-tests[e].log_b, e))
        chosen = _choose_set(f, _settle_blocks(f, {**chosen, best: tests[best].which}))
    return chosen


def _choose_set(f: ProjectedProblem, chosen: Blocks) -> Blocks:
    """The most probable set of as many effects where it is plainly better, each of them significant beside the others."""
    if not 1 < len(chosen) <= LARGEST:
        return chosen
    best = max((s for s in f.sets if len(s) == len(chosen)), key=lambda s: (f.sets[s], sorted(s)))
    tests = {e: f.tests(sorted(best - {e}))[e] for e in sorted(best)}
    if best == chosen.keys() or not all(f.significant(t, FURTHER) for t in tests.values()):
        return chosen
    surest = sorted(tests, key=lambda e: -tests[e].log_b)
    instead = _settle_blocks(f, {e: tests[e].which for e in surest})
    return instead if weigh_blocks(f, instead) > weigh_blocks(f, chosen) + SWAPPED else chosen


def _settle_blocks(f: ProjectedProblem, blocks: Blocks) -> Blocks:
    """The columns of the chosen effects, each the best beside those of the others: their tests were beside all columns of these."""
    seen: set[tuple[tuple[int, ...], ...]] = set()
    while len(blocks) > 1 and (now := tuple(blocks.values())) not in seen:
        seen.add(now)
        for e in blocks:
            P, floor = f.onto([n for other in blocks if other != e for n in blocks[other]])
            beside = likelihood_ratio.test(P, f.candidates[e], floor, f.penalty.get(e, 0.0), f.freedom)
            blocks = {**blocks, e: beside.which} if beside.rank else blocks
    return blocks


def weigh_blocks(f: ProjectedProblem, blocks: Blocks) -> float:
    """Log evidence of effects together, each with these columns, charged for their choice."""
    chi2, rank = f.joint([*blocks.values()])
    return weigh(chi2, rank, charge=len(blocks) * float(np.log(max(f.count, 1))))


def are_alike(a: Test, b: Test) -> bool:
    """Whether the second explains as much as the first, or is not distinguishable by its evidence.

    Each is tempered by what its own scores vary, which is not known exactly: both are compared as the first is.
    """
    ahead = a.log_b - b.weigh_alone(a.inflation) + b.charge
    return (a.chi2 - b.chi2 < INDISTINGUISHABLE and ahead < AS_SURE) or ahead < DISTINGUISHABLE


def find_alternatives(f: ProjectedProblem, chosen: Blocks) -> dict[str, tuple[str, ...]]:
    """For every chosen effect those that would explain as much in its place."""
    result = {}
    for e in chosen:
        conditional = f.tests([o for o in chosen if o != e])
        equal = [o for o, t in conditional.items() if o != e and t.rank and are_alike(conditional[e], t)]
        result[e] = tuple(sorted(o for o in equal if e not in f.contains.get(o, ())))
    return result


def make_problem(f: Fitted, effects: Sequence[str] | None = None) -> ProjectedProblem:
    """The candidates of some effects, or of all that are deterministic and testable, on the R factor of everything; steps among them
    charged for the choice of their instant.
    """
    available = list_testable(f) if effects is None else effects
    kept = {e: tuple(c) for e, c in group_by_effect(f.candidates).items() if e in available}
    freedom = sum(n.freedom for n in f.calibration.noise)
    return ProjectedProblem(
        T=f.whole,
        n_base=f.n_base,
        candidates=kept,
        penalty={e.id: float(np.log(2 * BLOCKS)) for e in f.model.candidates if e.kind == "step"},
        freedom=freedom,
        flights=f.prepared if any(n.uneven for n in f.calibration.noise) else (),
        contains={e.id: e.contains for e in f.model.candidates},
    )


def list_testable(f: Fitted) -> list[str]:
    """Deterministic candidates of which every flight has the channels."""
    have = [o.record.recorded for o in f.observations]
    return [
        e.id
        for e in f.model.candidates
        if e.kind == "deterministic" and e.searched and not any(e.missing(h) for h in have)
    ]


# --- all sets of up to three effects, weighed by their evidence. With Zellner's prior
# b ~ N(0, g (X'X)^-1) the evidence of a set S against the empty one is exact (A. Zellner 1986; F. Liang et al., J. Am. Stat. Assoc. 103,
# 2008), log B_S(g) = chi2_S / 2 * g / (1 + g) - k_S / 2 * log(1 + g), with chi2_S what its k_S coefficients explain. g is averaged over
# eight decades; each of E effects is present with probability 1/E (J. Scott and J. Berger, Ann. Stat. 38, 2010).

LARGEST = 3  # most effects of a set
# added to the inner products of all orthonormal blocks but the first: effects that coincide count once
RIDGE = 1e-9


def _weigh_sets(f: ProjectedProblem) -> Weights:
    """All sets of up to :data:`LARGEST` of the problem's effects, weighed; in sets of several each is in its most probable way."""
    ways = [
        (e, w) for e in sorted(f.candidates) for w in list_ways(f.P, f.candidates[e], f.floor, weakest=0.0)
    ]
    names = [e for e, _ in ways]
    effects = [*dict.fromkeys(names)]
    odds = -float(np.log(max(1, len(effects) - 1)))  # of presence, with probability 1/E
    weights = np.array([odds - np.log(w.count) - f.penalty.get(e, 0.0) for e, w in ways])
    length = np.array([w.Q.shape[1] for _, w in ways], dtype=np.intp)
    Q = np.concatenate([np.zeros((len(f.P), 0)), *(w.Q for _, w in ways)], axis=1)

    def weigh_each(group: NDArray[np.intp]) -> Array:
        chi2 = _measure_jointly(Q, f.P[:, -1], length, group)
        return np.asarray(log_bayes(chi2, np.sum(length[group], axis=1)) + np.sum(weights[group], axis=1))

    sets = [np.zeros((1, 0), dtype=np.intp), np.arange(len(ways), dtype=np.intp)[:, None]]
    logs = [np.zeros(1), weigh_each(sets[1])]
    best = [max((n for n, x in enumerate(names) if x == e), key=logs[1].__getitem__) for e in effects]
    best = sorted(best, key=lambda n: -length[n])  # sets of one shape are worked on at once
    for size in range(2, LARGEST + 1):
        sets.append(np.array([*combinations(best, size)], dtype=np.intp).reshape(-1, size))
        logs.append(weigh_each(sets[-1]))
    log_weights = np.concatenate(logs)
    sums = defaultdict[frozenset[str], float](float)
    for members, weight in zip(
        chain(*(x.tolist() for x in sets)), np.exp(log_weights - log_weights.max()).tolist(), strict=True
    ):
        sums[frozenset(names[n] for n in members)] += weight
    return sums


def _measure_jointly(Q: Array, y: Array, length: NDArray[np.intp], sets: NDArray[np.intp]) -> Array:
    """Chi-square (n,) of data y explained by sets (n, size) of blocks of columns of Q; ``length``: columns of each block."""
    start, G, d = np.cumsum(length) - length, Q.T @ Q, Q.T @ y
    chi2, lengths = np.zeros(len(sets)), length[sets]
    shapes = lengths @ (1 + np.max(length, initial=0)) ** np.arange(sets.shape[1])
    for key in np.unique(shapes):
        members = np.flatnonzero(shapes == key)
        shape = lengths[members[0]]
        begins = start[sets[members]].T[:, :, None]
        at = np.concatenate([b + np.arange(k) for b, k in zip(begins, shape, strict=True)], axis=1)
        inner = G[at[:, :, None], at[:, None]] + RIDGE * np.diag(np.arange(at.shape[1]) >= shape[0])
        chi2[members] = np.sum(d[at] * np.linalg.solve(inner, d[at][..., None])[..., 0], axis=1)
    return chi2
