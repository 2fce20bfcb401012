"""Strong effects, one after the other, each derived into the model before the next is asked for.

A signature is the effect to first order. Of an effect a thousand sigma strong the second order alone may be ten sigma
strong: enough to prefer a wrong effect, to name another one beside the right, and to raise the noise that is estimated.
So the strongest effect is chosen among those that come near it with each of them derived into the model and fitted
nonlinearly; with the best in the model everything is done anew: calibration, noise, tests of the rest. These fits begin at
the sheet: parameters that had to absorb what was missing may be far from it, in a valley that is long and curved.

Where the one that came next explains less by no more than what the chosen one leaves, an effect that is not in the model yet may
have decided between them: then the other one is followed to its end, too, and the ends are compared.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.diagnosis import contenders
from ragg_runtime.diagnosis.contenders import Contest, Extend, Left
from ragg_runtime.diagnosis.impossible import impossible
from ragg_runtime.diagnosis.step_scan import with_steps
from ragg_runtime.evidence import selection
from ragg_runtime.evidence.likelihood_ratio import Test
from ragg_runtime.evidence.selection import Choice, Field
from ragg_runtime.fit import calibrate
from ragg_runtime.fit.calibrate import Calibration
from ragg_runtime.fit.fitted import Fitted, fit
from ragg_runtime.fit.off_sheet import QUIET
from ragg_runtime.fit.significance import INDISTINGUISHABLE, log_sf
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model
from ragg_runtime.signals.noise_spectrum import Noise

Array = NDArray[np.float64]

STRONG = 2500.0
"""Chi-square of an effect from which it counts as strong (50 sigma): a linearisation that is right to 2 % then misses
one sigma."""

NEAR = 10.0
"""What an effect leaves over what the best leaves, in chi-square, up to which it is a contender: second orders may turn
the order of two."""

CONTENDERS = 3
"""Most effects that are tried in the model at each stage."""

OPEN = 4.0
"""What a contender leaves more than the chosen effect does, over what that leaves beside noise, up to which an effect that is not
in the model yet may have decided: of such an effect a twin may take four fifths."""

TRUNCATED = 2e-3
"""Share of a strong effect that is less than its model can be trusted to: it is kept to an order, and its couplings to
theirs, which are angles of a milliradian or two. Of an effect of 10,000 sigma twenty sigma are left over so, and say nothing
of a further one that is like it."""


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
    stage
        The one at which it was taken.
    open
        Contenders that an effect not yet in the model may have decided against, the best of them first.
    """

    effect: str
    test: Test
    before: Fitted
    after: Fitted
    rivals: tuple[str, ...]
    instant: float | None
    stage: Stage
    open: tuple[str, ...] = ()


End = tuple[list[Taken], Stage]
"""The strong effects, and the stage at which nothing strong is left, or nothing of the catalogue is what is missing."""

Block = tuple[Stage, str, tuple[int, ...]]
"""An effect, the stage whose field has its columns, and those of them that its test needs."""


def taken(first: Stage, extend: Extend | None) -> End:
    """The strong effects in the order of their strength, and the stage at which nothing strong is left."""
    if extend is None:
        return [], first
    end = _followed(first, [], first, extend)
    for n, t in enumerate(end[0]):
        if t.open and len(_blocks(end)) > n + 1:
            other = _followed(first, end[0][:n], t.stage, extend, (*t.open, t.effect))
            end = other if _better(other, end, first, extend) else end
            break
    return _with_rivals(end, first, extend)


def _followed(
    first: Stage, before: Sequence[Taken], stage: Stage, extend: Extend, begin: tuple[str, ...] = ()
) -> End:
    """One strong effect after the other from a stage on, the first of them that of ``begin``, whose others are open."""
    found = list(before)
    while stage.strong and len(found) < selection.MOST:
        one = _in_model(stage, begin[0], begin[1:], extend) if begin else _strongest(stage, extend)
        if one is None:
            return found, stage.without_choice()
        begin = ()
        found = _needed([*found, one], first.fitted, extend)
        stage = Stage.of(found[-1].after, beside=True)
    return found, stage


def _better(a: End, b: End, first: Stage, extend: Extend) -> bool:
    """Whether one end is better than another: less is left, as BIC counts it; or as little, by fewer effects.

    As little is what differs by no more than the strongest effect can be trusted to.
    """
    sizes = [len(_blocks(end)) for end in (a, b)]
    trusted = TRUNCATED**2 * max(t.test.chi2 for found, _ in (a, b) for t in found)
    noise = min((last.fitted.calibration.noise for _, last in (a, b)), key=calibrate.loudness)
    now = _left(b, _blocks(b), noise, first, extend)
    other = _left(a, _blocks(a), noise, first, extend, now.ceiling)
    room = max(trusted, INDISTINGUISHABLE) if sizes[0] < sizes[1] else -INDISTINGUISHABLE
    return other.chi2 < now.chi2 + room


def _with_rivals(end: End, first: Stage, extend: Extend) -> End:
    """An end whose strong effects have those of their open contenders that do as well once all others are in the model."""
    found, last = end
    blocks, noise = _blocks(end), last.fitted.calibration.noise
    inside = {e for _, e, _ in blocks}
    undecided = [[e for e in t.open if e not in inside] for t in found]
    if not any(undecided) or len(blocks) < 2:
        return end
    now = _left(end, blocks, noise, first, extend)

    def equal(n: int, e: str) -> bool:
        t = found[n]
        swapped = [*blocks[:n], (t.stage, e, t.stage.choice.tests[e].which), *blocks[n + 1 :]]
        return _left(end, swapped, noise, first, extend, now.ceiling).chi2 < now.chi2 + INDISTINGUISHABLE

    rivals = [{e for e in some if equal(n, e)} for n, some in enumerate(undecided)]
    return [
        replace(t, rivals=tuple(sorted({*t.rivals, *own}))) for t, own in zip(found, rivals, strict=True)
    ], last


def _blocks(end: End) -> list[Block]:
    """All effects of an end, the strong ones first."""
    found, last = end
    strong = [(t.stage, t.effect, t.test.which) for t in found]
    return [*strong, *((last, e, last.choice.blocks[e]) for e in last.choice.chosen)]


def _left(
    end: End,
    blocks: Sequence[Block],
    noise: Sequence[Noise],
    first: Stage,
    extend: Extend,
    ceiling: float = np.inf,
) -> Left:
    """Chi-square that is left with effects in the model, and what their coefficients are charged; steps begin as in an end."""
    instants = dict(first.instants) | dict(end[1].instants)
    instants |= {t.effect: t.instant for t in end[0] if t.instant is not None}
    own = [(s.field, e, which) for s, e, which in blocks]
    return left_with(first.fitted, own, noise, instants, extend, ceiling)


def left_with(
    f: Fitted,
    blocks: Sequence[tuple[Field, str, Sequence[int]]],
    noise: Sequence[Noise],
    instants: Mapping[str, float],
    extend: Extend,
    ceiling: float = np.inf,
) -> Left:
    """What is left of flights with effects in the model, and what their coefficients are charged: of each the field that has its
    columns, and those of them that its test needs.
    """
    charged = sum(contenders.charge(q.P[:, list(which)], f.calibration.rows) for q, _, which in blocks)
    held = frozenset(label for q, e, which in blocks for label in _unneeded(q, e, which))
    extended = contenders.derived(f, [e for _, e, _ in blocks], instants, extend)
    found = contenders.left(f, noise, held, extended, ceiling)
    return replace(found, chi2=found.chi2 + charged)


def _unneeded(field: Field, effect: str, which: Sequence[int]) -> list[str]:
    """Labels of an effect's columns that its test does not need."""
    return [c.label for n, c in field.candidates[effect] if n not in which]


def _strongest(stage: Stage, extend: Extend) -> Taken | None:
    """The effect that explains most once it is in the model, of those that are possible at the size that they then have.

    ``None`` where an impossible one leaves but noise and no other comes near it: what is missing acts as it does, and is none of
    the catalogue. Nor is one of several of which none comes to an optimum.
    """
    f, tests = stage.fitted, {e: t for e, t in stage.choice.tests.items() if t.rank}

    def entered(e: str) -> tuple[frozenset[str], tuple[Model, Instrument]]:
        held = frozenset(_unneeded(stage.field, e, tests[e].which))
        return held, contenders.derived(f, [e], stage.instants, extend)

    contest = Contest(f, entered)
    while True:
        effect, rivals, undecided = _best(stage, tests, contest.left)
        if not contest.arrived:
            return None
        found = replace(_in_model(stage, effect, undecided, extend), rivals=rivals)
        if len(tests) == 1 or not impossible(found.after, (effect,)):
            return found
        if found.after.calibration.excess <= QUIET and not (rivals or undecided):
            return None
        tests.pop(effect)


def _best(
    stage: Stage, tests: Mapping[str, Test], score: Callable[[Sequence[str]], dict[str, float]]
) -> tuple[str, tuple[str, ...], tuple[str, ...]]:
    """Of some effects the one that leaves least by its ``score``; of those that do equally well, the linear test's choice.

    With it those that would have done as well, and those against which an effect not yet in the model may have decided.
    """
    total = float(np.sum(stage.field.P[:, -1] ** 2))
    least = min(total - t.chi2 for t in tests.values())
    near = [e for e, t in tests.items() if total - t.chi2 <= NEAR * max(least, 1.0)]
    near = sorted(near, key=lambda e: (tests[e].log_p, e))
    rows = stage.fitted.calibration.rows
    charge = {e: contenders.charge(stage.field.P[:, list(tests[e].which)], rows) for e in near}
    tried = near[:CONTENDERS]
    left = score(tried) if len(tried) > 1 else dict.fromkeys(tried, 0.0)
    best = min(tried, key=lambda e: (left[e] + charge[e], e))
    # effects with the same signature are all of its group, however many they are
    alike = [e for e in near[CONTENDERS:] if _alike(tests[e], tests[best])]
    left |= score(alike) if alike else {}
    equal = [e for e in left if left[e] + charge[e] < left[best] + charge[best] + INDISTINGUISHABLE]
    effect = min(equal, key=near.index)
    as_near = [
        e for e in left if left[e] < left[effect] + INDISTINGUISHABLE and _as_sure(tests[e], tests[effect])
    ]
    rivals = tuple(sorted({*equal, *as_near} - {effect}))
    # what nothing explains, and a degree of freedom for each column that could
    noise = float(stage.field.P[-1, -1] ** 2) + stage.field.P.shape[1]
    far = {e: left[e] - left[effect] for e in tried if e not in (effect, *rivals)}
    undecided = sorted((e for e in far if far[e] < OPEN * (left[effect] - noise)), key=lambda e: (far[e], e))
    return effect, rivals, tuple(undecided)


def _in_model(stage: Stage, effect: str, undecided: tuple[str, ...], extend: Extend) -> Taken:
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
        rivals=(),
        instant=stage.instants.get(effect),
        stage=stage,
        open=undecided,
    )


def _alike(a: Test, b: Test) -> bool:
    """Whether two effects explain the same, as surely, as far as a linear test tells."""
    return abs(a.chi2 - b.chi2) < INDISTINGUISHABLE and _as_sure(a, b)


def _as_sure(a: Test, b: Test) -> bool:
    """Whether the first is no less sure for its many coefficients."""
    return a.log_p < b.log_p + selection.AS_SURE


def _needed(found: list[Taken], first: Fitted, extend: Extend) -> list[Taken]:
    """Those taken without any that the later ones have made superfluous; the model is fitted anew without it."""
    last = found[-1].after
    for t in found[:-1]:
        if significance(last.calibration, t.effect) > np.log(selection.FURTHER):
            kept = [k for k in found if k is not t]
            instants = {k.effect: k.instant for k in kept if k.instant is not None}
            model, instrument = contenders.derived(
                first, [k.effect for k in kept], instants, extend, candidates=True
            )
            fitted = fit(model, instrument, first.observations)
            return _needed([*kept[:-1], replace(kept[-1], after=fitted)], first, extend)
    return found


def significance(c: Calibration, effect: str) -> float:
    """Logarithm of the p-value of an effect that is in the model: what its absence would cost, linearised."""
    own = [n for n, q in enumerate(c.columns) if q.effect == effect]
    values = np.array([c.p[c.index[n]] / c.columns[n].scale for n in own])
    information = np.linalg.inv(c.covariance[np.ix_(own, own)]) - np.eye(len(own))  # without the prior's
    seen = int(np.sum(np.linalg.eigvalsh(information) > 1.0))
    return log_sf(max(float(values @ information @ values), 0.0), seen)
