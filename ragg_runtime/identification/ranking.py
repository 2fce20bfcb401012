"""The effects in order of their evidence, how probable each is, and those on which the record is silent."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation import likelihood_ratio, unknown_gradient
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.likelihood_ratio import Test
from ragg_runtime.estimation.scores import Error, finite
from ragg_runtime.identification.parameters import Estimates, ParameterValue
from ragg_runtime.identification.selection import ProjectedProblem
from ragg_runtime.identification.strong import AddedEffect, Stage
from ragg_runtime.model.model import DerivedEffect

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Ranked:
    """One effect and the evidence for it, alone; without columns nothing of it is fitted, and the error stays."""

    effect: str
    test: Test
    before: Error
    after: Error
    after_holdout: Error
    parameters: tuple[ParameterValue, ...] = ()
    combinations: tuple[ParameterValue, ...] = ()
    indistinguishable_from: tuple[str, ...] = ()
    probability: float | None = 0.0

    @staticmethod
    def without_columns(effect: str, test: Test, error: Error) -> Ranked:
        """The row of an effect of which nothing is fitted."""
        return Ranked(effect, test, error, error, error)

    def with_estimates(self, estimates: Estimates, instant: float | None) -> Ranked:
        """The row with the estimates of the effect's parameters, and the instant of a step, s."""
        values = estimates.list_parameters()
        if instant is not None:
            values += (ParameterValue("t_step", accelerometer=None, value=instant, std=0.0, unit="s"),)
        return replace(self, parameters=values, combinations=estimates.list_combinations())

    @property
    def instant(self) -> float | None:
        """Of a step, s."""
        return next((q.value for q in self.parameters if q.name == "t_step"), None)

    @property
    def log_p(self) -> float:
        """Logarithm of :attr:`p_value`."""
        return self.test.log_p

    @property
    def delta_bic(self) -> float:
        """-2 times the difference of log evidence, without the effect less with it: positive speaks for it."""
        return 2.0 * self.test.log_b

    @property
    def p_value(self) -> float:
        """p-value, corrected for the effect's own sub-blocks (0 where it underflows: see ``log_p``)."""
        return float(np.exp(self.log_p))

    def as_json(self) -> dict[str, object]:
        return {
            "effect": self.effect,
            "p_value": self.p_value,
            "log10_p": finite(self.log_p / np.log(10.0)),
            "chi2": finite(self.test.chi2),
            "rank": self.test.rank,
            "delta_bic": finite(self.delta_bic),
            "probability": self.probability,
            "error_before": self.before.as_json(),
            "error_after": self.after.as_json(),
            "error_after_holdout": self.after_holdout.as_json(),
            "parameters": [p.as_json() for p in self.parameters],
            "combinations": [p.as_json() for p in self.combinations],
            "indistinguishable_from": list(self.indistinguishable_from),
        }


@dataclass(frozen=True)
class NotTestable:
    """An effect on which this record is silent, and why."""

    effect: str
    why: str


def rank_effects(stage: Stage, only: Container[str] | None = None) -> list[Ranked]:
    """Every testable effect of a stage, or ``only`` some, with the evidence for it alone."""
    f, problem = stage.fitted, stage.problem
    extras = {e: problem.testable(e) for e, t in problem.tests().items() if t.rank}
    extras = {e: extra for e, extra in extras.items() if only is None or e in only}
    fits = {e: f.coefficients(extra) for e, extra in extras.items()}
    vectors = [f.vector(c, extras[e]) for e, (c, _) in fits.items()]
    vectors += [f.fit_held_out(extra) for extra in extras.values()]
    scored = f.score(vectors) if vectors else []
    ranked = []
    for n, (e, (c, covariance)) in enumerate(fits.items()):
        others = stage.alternatives
        alike = [others.get(e, ()), *((main, *x) for main, x in others.items() if e in x)]
        row = Ranked(
            effect=e,
            test=problem.tests()[e],
            before=stage.scored.whole,
            after=scored[n].whole,
            after_holdout=scored[n + len(fits)].held_out,
            indistinguishable_from=tuple(sorted({*alike[-1]} - {e})),
        )
        columns, k = dict(problem.candidates[e]), f.n_base
        tested = [columns[k] for k in extras[e]]
        estimates = Estimates(f.model, f.calibration.p, tested, c[k:], covariance[k:, k:])
        ranked.append(row.with_estimates(estimates, stage.instants.get(e)))
    return ranked


def rank_added(t: AddedEffect, free: Fitted) -> Ranked:
    """An effect that was derived into the model, by what the model leaves without and with it; ``free``: the flights with all of them, and
    all their coefficients.
    """
    (before,) = t.before.score([np.zeros(t.before.size)])
    after, held_out = t.after.score([np.zeros(t.after.size), t.after.fit_held_out()])
    row = Ranked(
        effect=t.effect,
        test=t.test,
        before=before.whole,
        after=after.whole,
        after_holdout=held_out.held_out,
        indistinguishable_from=t.alternatives,
    )
    fitted = Estimates.of_calibration(free)
    stepped = replace(fitted, values=fitted.values + free.coefficients(())[0])
    return row.with_estimates(stepped.select(t.effect), t.instant)


CERTAIN = Test(log_p=-np.inf, chi2=np.inf, rank=1, which=(), log_b=np.inf)  # of what the recorder did


def list_not_testable(f: Fitted, problem: ProjectedProblem) -> list[NotTestable]:
    def why(e: DerivedEffect) -> str | None:
        missing = sorted({c for o in f.observations for c in e.missing(o.record.recorded)})
        if missing:
            return f"the flight has no channel {', '.join(missing)}"
        if not e.searched:
            return f"it can look like many other effects: add it by name, ragg add ... {e.id}"
        absorbed = e.id in problem.candidates and not problem.testable(e.id)
        return _describe_absorption(f, problem, e) if absorbed else None

    return [NotTestable(e.id, reason) for e in f.model.candidates if (reason := why(e)) is not None]


WEAK = 0.5  # share of a signature that the calibration leaves of one that is too weak, and not absorbed


def _describe_absorption(f: Fitted, problem: ProjectedProblem, e: DerivedEffect) -> str:
    """In words: which parameters of the model absorb an effect, or that it is too weak to be seen."""
    columns = [n for n, _ in problem.candidates[e.id]]
    n = f.n_base
    whole = np.linalg.norm(problem.T[:, [n + k for k in columns]], axis=0)
    left = np.linalg.norm(problem.P[:, columns], axis=0)
    k = int(np.argmax(whole))
    strongest = columns[k]
    if left[k] > WEAK * whole[k] or whole[k] < likelihood_ratio.TESTABLE:
        # what an unknown gradient can be has been taken out of the columns before
        unknown = any(map(unknown_gradient.is_unknown, f.observations))
        beside = "beside a gradient that is not recorded" if unknown else "in this flight"
        return f"not observable {beside}, even at a hundred times its plausible size"
    solution = np.linalg.solve(problem.T[:n, :n], problem.T[:n, n + strongest])
    names: dict[str, float] = {}
    for c, v, norm in zip(
        f.calibration.columns, solution, np.linalg.norm(problem.T[:, :n], axis=0), strict=True
    ):
        names[c.name] = names.get(c.name, 0.0) + float(np.abs(v * norm))
    most = sorted(names, key=lambda x: -names[x])[:3]
    share = float(left[k] / whole[k])
    return f"absorbed by {', '.join(most)}: the calibration leaves {100.0 * share:.2g} % of its signature"


@dataclass(frozen=True)
class Detectable:
    """Size of an effect's parameter, in its display unit, at which a record would show it at three sigma."""

    effect: str
    name: str
    size: float
    unit: str

    def as_json(self) -> dict[str, object]:
        return {"effect": self.effect, "name": self.name, "three_sigma": self.size, "unit": self.unit}


def list_detectable(problem: ProjectedProblem) -> list[Detectable]:
    """The detectable size of each parameter of each testable effect."""
    rows = []
    left = np.linalg.norm(problem.P, axis=0)
    for e, columns in problem.candidates.items():
        by_place = dict(columns)
        for name in dict.fromkeys(c.name for _, c in columns):
            best = [(left[n], by_place[n]) for n in problem.testable(e) if by_place[n].name == name]
            if best:
                norm, c = max(best, key=lambda x: float(x[0]))
                size = 3.0 / norm * c.scale / c.unit_factor
                rows.append(Detectable(effect=e, name=name.split(".", 1)[1], size=float(size), unit=c.unit))
    return rows


# --- how probable each effect is, of all sets of up to three (``ProjectedProblem.sets``)

HELD = 0.95  # probability that the credible set holds together


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


def weigh_effects(problem: ProjectedProblem, steps: Sequence[AddedEffect]) -> Probabilities:
    """The probabilities of the remaining effects, and of those in the model: equivalent alternatives share there."""
    weights = problem.sets
    for t in steps:
        # one of them is sure to be present, each as probable as the others beforehand
        options, more = (t.effect, *t.alternatives), defaultdict[frozenset[str], float](float)
        for option, (s, weight) in product(options, weights.items()):
            more[s | {option}] += weight
        weights = more
    total = sum(weights.values())
    of = {e: sum(w for s, w in weights.items() if e in s) / total for e in sorted(set().union(*weights))}
    sets = sorted((-w / total, tuple(sorted(s))) for s, w in weights.items())
    count = int(np.searchsorted(np.cumsum([-share for share, _ in sets]), HELD)) + 1
    return Probabilities({e: min(1.0, p) for e, p in of.items()}, tuple(s for _, s in sets[:count]))


def add_probability(r: Ranked, credence: Probabilities, columns: Container[str]) -> Ranked:
    """The row with its effect's probability: none where the model has another effect that explains the same; ``None`` of a random
    effect, of which there is no evidence but its p-value.
    """
    if r.effect in credence.of or r.effect in columns:
        return replace(r, probability=credence.of.get(r.effect, 0.0))
    return replace(r, probability=1.0 if np.isneginf(r.log_p) else None)
