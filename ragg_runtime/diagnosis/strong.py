"""Strong effects, one after the other, each derived into the model before the next is asked for.

A signature is the effect to first order. Of an effect a thousand sigma strong the second order alone may be ten sigma
strong: enough to prefer a wrong effect, to name another one beside the right, and to raise the noise that is estimated.
So the strongest effect is chosen among those that come near it with each of them derived into the model and fitted
nonlinearly; with the best in the model everything is done anew: calibration, noise, tests of the rest. These fits begin at
the sheet: parameters that had to absorb what was missing may be far from it, in a valley that is long and curved.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.diagnosis import contenders
from ragg_runtime.diagnosis.contenders import Contest, Extend
from ragg_runtime.diagnosis.step_scan import with_steps
from ragg_runtime.evidence import selection
from ragg_runtime.evidence.likelihood_ratio import Test
from ragg_runtime.evidence.selection import Choice, Field
from ragg_runtime.fit.fitted import Fitted, fit
from ragg_runtime.fit.significance import INDISTINGUISHABLE
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]

STRONG = 2500.0
"""Chi-square of an effect from which it counts as strong (50 sigma): a linearisation that is right to 2 % then misses
one sigma."""

NEAR = 10.0
"""What an effect leaves over what the best leaves, in chi-square, up to which it is a contender: second orders may turn
the order of two."""

CONTENDERS = 3
"""Most effects that are tried in the model at each stage."""


@dataclass(frozen=True)
class Stage:
    """What is known with some effects in the model: the field of the rest, the flights fitted, and what is chosen."""

    field: Field
    fitted: Fitted
    instants: Mapping[str, float]
    choice: Choice

    @staticmethod
    def of(f: Fitted, *, beside: bool = False) -> Stage:
        """``beside``: of what is left beside effects that were taken into the model."""
        field, fitted, instants = with_steps(f)
        return Stage(field, fitted, instants, selection.choose(field, beside=beside))

    def without_choice(self) -> Stage:
        """The same, none of the effects being what is missing."""
        choice = replace(self.choice, chosen=(), blocks={}, conditional=self.choice.tests, chi2=0.0)
        return replace(self, choice=choice)

    @property
    def strong(self) -> bool:
        """Whether what is chosen is too strong for a linearisation."""
        return any(self.choice.tests[e].chi2 > STRONG for e in self.choice.chosen)


@dataclass(frozen=True)
class Taken:
    """An effect that was derived into the model.

    Attributes
    ----------
    effect, test
        Id, and its linear test at the stage where it was taken.
    before, after
        The flights fitted without and with it, those taken before in the model.
    rivals
        Effects that would have done as well, derived in its place.
    instant
        Of a step, s.
    """

    effect: str
    test: Test
    before: Fitted
    after: Fitted
    rivals: tuple[str, ...]
    instant: float | None


def taken(first: Stage, extend: Extend | None) -> tuple[list[Taken], Stage]:
    """The strong effects in the order of their strength, and the stage at which nothing strong is left, or nothing of the
    catalogue is what is missing.
    """
    found: list[Taken] = []
    stage = first
    while extend is not None and stage.strong and len(found) < selection.MOST:
        one = _strongest(stage, extend)
        if one is None:
            return found, stage.without_choice()
        found.append(one)
        stage = Stage.of(one.after, beside=True)
    return found, stage


def _unneeded(field: Field, effect: str, which: Sequence[int]) -> list[str]:
    """Labels of an effect's columns that its test does not need."""
    return [c.label for n, c in field.candidates[effect] if n not in which]


def _strongest(stage: Stage, extend: Extend) -> Taken | None:
    """The effect that explains most once it is in the model; ``None`` of several of which none comes to an optimum."""
    f, tests = stage.fitted, {e: t for e, t in stage.choice.tests.items() if t.rank}

    def entered(e: str) -> tuple[frozenset[str], tuple[Model, Instrument]]:
        held = frozenset(_unneeded(stage.field, e, tests[e].which))
        return held, contenders.derived(f, [e], stage.instants, extend)

    contest = Contest(f, entered)
    effect, rivals = _best(stage, tests, contest.left)
    return _in_model(stage, effect, rivals, extend) if contest.arrived else None


def _best(
    stage: Stage, tests: Mapping[str, Test], score: Callable[[Sequence[str]], dict[str, float]]
) -> tuple[str, tuple[str, ...]]:
    """Of some effects the one that leaves least by its ``score``, of those that do equally well the linear test's choice; with
    it those that would have done as well.
    """
    total = float(np.sum(stage.field.P[:, -1] ** 2))
    least = min(total - t.chi2 for t in tests.values())
    near = [e for e, t in tests.items() if total - t.chi2 <= NEAR * max(least, 1.0)]
    near = sorted(near, key=lambda e: (tests[e].log_p, e))
    tried = near[:CONTENDERS]
    left = score(tried) if len(tried) > 1 else dict.fromkeys(tried, 0.0)
    best = min(tried, key=lambda e: (left[e], e))
    # effects with the same signature are all of its group, however many they are
    alike = [e for e in near[CONTENDERS:] if _alike(tests[e], tests[best])]
    left |= score(alike) if alike else {}
    equal = [e for e in left if left[e] < left[best] + INDISTINGUISHABLE]
    effect = min(equal, key=near.index)
    as_near = [
        e for e in left if left[e] < left[effect] + INDISTINGUISHABLE and _as_sure(tests[e], tests[effect])
    ]
    return effect, tuple(sorted({*equal, *as_near} - {effect}))


def _in_model(stage: Stage, effect: str, rivals: tuple[str, ...], extend: Extend) -> Taken:
    """An effect of a stage derived into the model, and everything fitted anew."""
    f = stage.fitted
    model, instrument = contenders.derived(f, [effect], stage.instants, extend, candidates=True)
    for x in f.prepared:
        x.release()  # what is made now takes its place
    return Taken(
        effect=effect,
        test=stage.choice.tests[effect],
        before=f,
        after=fit(model, instrument, f.observations),
        rivals=rivals,
        instant=stage.instants.get(effect),
    )


def _alike(a: Test, b: Test) -> bool:
    """Whether two effects explain the same, as surely, as far as a linear test tells."""
    return abs(a.chi2 - b.chi2) < INDISTINGUISHABLE and _as_sure(a, b)


def _as_sure(a: Test, b: Test) -> bool:
    """Whether the first is no less sure for its many coefficients."""
    return a.log_p < b.log_p + selection.AS_SURE
