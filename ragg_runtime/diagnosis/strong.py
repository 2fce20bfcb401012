"""Strong effects, one after the other, each derived into the model before the next is asked for.

A signature is the effect to first order. Of an effect a thousand sigma strong the second order alone may be ten sigma
strong: enough to prefer a wrong effect, to name another one beside the right, and to raise the noise that is estimated.
So the strongest effect is chosen among those that come near it with each of them derived into the model and fitted
nonlinearly; with the best in the model everything is done anew: calibration, noise, tests of the rest. These fits begin at
the sheet: parameters that had to absorb what was missing may be far from it, in a valley that is long and curved.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.diagnosis.impossible import impossible
from ragg_runtime.diagnosis.step_scan import with_steps
from ragg_runtime.evidence import selection
from ragg_runtime.evidence.likelihood_ratio import Test
from ragg_runtime.evidence.selection import Choice, Field
from ragg_runtime.fit import calibrate
from ragg_runtime.fit.calibrate import Calibration
from ragg_runtime.fit.fitted import WIDENED, Fitted, fit
from ragg_runtime.fit.off_sheet import with_room
from ragg_runtime.fit.significance import INDISTINGUISHABLE, log_sf
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.units import RawQuantity
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


class Extend(Protocol):
    """Derives a model with further effects; with ``candidates`` also the signatures of the rest.

    Given by the caller: this package cannot derive.
    """

    def __call__(self, model: Model, ids: Sequence[str], /, *, candidates: bool = False) -> Model: ...


@dataclass(frozen=True)
class Stage:
    """What is known with some effects in the model: the field of the rest, the flights fitted, and what is chosen."""

    field: Field
    fitted: Fitted
    instants: Mapping[str, float]
    choice: Choice

    @staticmethod
    def of(f: Fitted, *, beside: bool = False) -> Stage:
        """``beside``: effects were taken into the model before."""
        field, fitted, instants = with_steps(f)
        return Stage(field, fitted, instants, selection.choose(field, beside=beside))

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
    """The strong effects in the order of their strength, and the stage at which nothing strong is left."""
    found: list[Taken] = []
    stage = first
    while extend is not None and stage.strong and len(found) < selection.MOST:
        best = _strongest(stage, extend)
        found.append(best)
        found = _needed(found, first.fitted, extend)
        stage = Stage.of(found[-1].after, beside=True)
    return found, stage


def _strongest(stage: Stage, extend: Extend, without: tuple[str, ...] = ()) -> Taken:
    """The effect that explains most once it is in the model; of those that do equally well, the linear test's choice.

    ``without`` are effects that turned out to be no possible ones: at sizes that they cannot have.
    """
    f = stage.fitted
    tests = {e: t for e, t in stage.choice.tests.items() if t.rank and e not in without}
    total = float(np.sum(stage.field.P[:, -1] ** 2))
    least = min(total - t.chi2 for t in tests.values())
    near = [e for e, t in tests.items() if total - t.chi2 <= NEAR * max(least, 1.0)]
    near = sorted(near, key=lambda e: (tests[e].log_p, e))

    def score(e: str) -> float:
        held = frozenset(c.label for n, c in stage.field.candidates[e] if n not in tests[e].which)
        charge = _charge(stage.field.P[:, list(tests[e].which)], f.calibration.rows)
        return _score(f, charge, held, _derived(f, [e], stage.instants, extend))

    tried = near[:CONTENDERS]
    scores = {e: score(e) for e in tried} if len(tried) > 1 else dict.fromkeys(tried, 0.0)
    best = min(tried, key=lambda e: (scores[e], e))
    # effects with the same signature are all of its group, however many they are
    scores |= {e: score(e) for e in near[CONTENDERS:] if _alike(tests[e], tests[best])}
    equal = [e for e in near if scores.get(e, np.inf) < scores[best] + INDISTINGUISHABLE]
    effect = equal[0]
    model, instrument = _derived(f, [effect], stage.instants, extend, candidates=True)
    after = fit(model, instrument, f.observations)
    if len(tests) > 1 and impossible(after, (effect,)):
        return _strongest(stage, extend, (*without, effect))
    instant = stage.instants.get(effect)
    return Taken(effect, tests[effect], f, after, tuple(sorted(equal[1:])), instant)


def _alike(a: Test, b: Test) -> bool:
    """Whether two effects explain the same, as surely, as far as a linear test tells."""
    return abs(a.chi2 - b.chi2) < INDISTINGUISHABLE and a.log_p < b.log_p + selection.AS_SURE


def _charge(columns: Array, rows: int) -> float:
    """What the coefficients of columns (n, k) cost, in chi-square: BIC's logarithm of the number of rows for each direction that
    the record sees; of one that it does not, by which the evidence with a prior of unit width is lower, ln(1 + s^2).

    Otherwise an effect would lose to a twin for coefficients of which the record says nothing (the third angle of a turn,
    weak combinations of four accelerometers).
    """
    s = np.linalg.svd(columns, compute_uv=False)
    return float(np.sum(np.where(s < 1.0, np.log1p(s**2), np.log(rows))))


def _derived(
    f: Fitted, ids: Sequence[str], instants: Mapping[str, float], extend: Extend, candidates: bool = False
) -> tuple[Model, Instrument]:
    """The model of some flights with further effects in it, and the sheet with the instants of steps among them."""
    model = extend(f.model, ids, candidates=candidates)
    steps = tuple(
        EffectSetting(e, MappingProxyType({"t_step": RawQuantity(instants[e], "s")}))
        for e in ids
        if e in instants
    )
    return model, replace(f.instrument, effects=(*f.instrument.effects, *steps))


def _score(f: Fitted, charge: float, held: frozenset[str], derived: tuple[Model, Instrument]) -> float:
    """Chi-square that a nonlinear fit leaves with an effect in the model, and what its coefficients are charged.

    Those of its coefficients that its test does not need, labelled in ``held``, are held at zero, to second order about
    the fit: an effect of many would otherwise explain some of the noise for nothing. An effect that brings parameters to light
    which only the sheet knew before fits the noise with those too: every one that the record then knows costs 2 (AIC).
    """
    model, instrument = derived
    noise = f.calibration.noise
    c = calibrate.fit(model, instrument, f.observations, noise=noise)
    for _ in range(WIDENED):
        wider = with_room(model, instrument, c)
        if wider is None:
            break
        instrument = wider
        c = calibrate.fit(model, instrument, f.observations, noise=noise, start=c.p)
    others = [n for n, q in enumerate(c.columns) if q.label in held]
    values = np.array([c.p[c.index[n]] / c.columns[n].scale for n in others])
    cost, known = 0.0, len(c.columns) - float(np.trace(c.covariance))
    if others:
        # of a Gaussian: the variances once some of its variables are given
        C = c.covariance[:, others]
        given = np.linalg.solve(C[others], C.T)
        cost = float(values @ np.linalg.solve(C[others], values))
        known += float(np.sum(given * C.T)) - len(others)
    return c.chi2 + cost + charge + 2.0 * known


def _needed(found: list[Taken], first: Fitted, extend: Extend) -> list[Taken]:
    """Those taken without any that the later ones have made superfluous; the model is fitted anew without it."""
    last = found[-1].after
    for t in found[:-1]:
        if significance(last.calibration, t.effect) > np.log(selection.FURTHER):
            kept = [k for k in found if k is not t]
            instants = {k.effect: k.instant for k in kept if k.instant is not None}
            model, instrument = _derived(first, [k.effect for k in kept], instants, extend, candidates=True)
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
