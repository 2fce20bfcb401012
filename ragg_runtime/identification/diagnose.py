"""Which physical effect is missing: the method, its verdict, and what the record cannot tell.

The model is calibrated, every candidate tested on what no parameter absorbs, strong ones derived into the model one after the
other; a refit with all chosen effects shows whether the residual comes down to noise.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit

from ragg_runtime.base.threads import one_thread
from ragg_runtime.estimation import fitted as fitted_
from ragg_runtime.estimation import regressors as design
from ragg_runtime.estimation import whitening
from ragg_runtime.estimation.calibration import QUIET, off_sheet
from ragg_runtime.estimation.fitted import Fitted, Scored, calibrated, fit
from ragg_runtime.estimation.observation import Observation, observations_of
from ragg_runtime.estimation.scores import Error
from ragg_runtime.estimation.thinning import thinned
from ragg_runtime.estimation.whitening import Piece
from ragg_runtime.identification import (
    claims,
    comparison,
    contenders,
    next_motion,
    omnibus,
    selection,
    sequential,
    strong,
)
from ragg_runtime.identification.claims import Regression, Robust
from ragg_runtime.identification.comparison import Explained, explained
from ragg_runtime.identification.contenders import Extend
from ragg_runtime.identification.likelihood_ratio import Test, Variance, pooled
from ragg_runtime.identification.line_rival import LineRival, Steady, line_rival
from ragg_runtime.identification.omnibus import Remainder
from ragg_runtime.identification.parameters import parameter_values, visible_combinations
from ragg_runtime.identification.ranking import (
    Ranked,
    _not_testable,
    _place,
    _ranked_random,
    _ranking,
    _sizes,
    staged,
    weighed,
    with_probability,
)
from ragg_runtime.identification.result import Diagnosis, Disagreement, groups, words
from ragg_runtime.identification.selection import Field
from ragg_runtime.identification.strong import Stage, Taken
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.evaluate import vector
from ragg_runtime.model.model import Model, Recogniser

Array = NDArray[np.float64]


@one_thread
def diagnose(
    model: Model,
    instrument: Instrument,
    flights: Sequence[Flight],
    extend: Extend | None = None,
    limits: Mapping[str, float] = next_motion.LIMITS,
) -> Diagnosis:
    """Find which of the model's candidate effects the flights, of one instrument, need.

    ``extend`` derives the model with the chosen effects for the final, nonlinear check, which is linear without it; ``limits`` are
    the largest amplitudes ``a`` (m/s^2) and ``omega`` (rad/s) of a motion to fly next.
    """
    observations = thinned(model, instrument, observations_of(flights, instrument))
    f = fit(model, instrument, observations)
    return diagnose_fitted(f, flights, extend, limits)


@one_thread
def diagnose_fitted(
    f: Fitted,
    flights: Sequence[Flight],
    extend: Extend | None = None,
    limits: Mapping[str, float] = next_motion.LIMITS,
) -> Diagnosis:
    """As :func:`diagnose`, on flights that are already fitted; ``limits`` as for ``next_motion.proposals``."""
    output = _output_effects(f, flights)
    first = Stage.of(f)
    apart = contradiction(first)
    # before strong effects, whose columns take the place of these
    ranked = _ranking(first.fitted, first.field, first.choice, first.instants, output)
    budget = strong.Budget()
    steps, last = ([], first.without_choice()) if apart else strong.taken(first, extend, budget)
    last, outcome = confirmed(steps, last, extend)
    found = Conclusion.of(first, steps, last, outcome, extend, bool(apart), output)
    if not apart and len(flights) > 1 and found.contradictory:
        apart = disagreement(f, flights, extend)
        found = replace(found, verdict="unexplained", claims=()) if apart else found
    outcome, left = found.outcome, found.left
    ranking = _ranked(*ranked, steps, last, found)
    credence = weighed(last.field, steps).within(found.share)
    rivals = selection.rivals(first.field, first.choice) if not steps else {t.effect: t.rivals for t in steps}
    return Diagnosis(
        verdict=found.verdict,
        fitted=first.fitted,
        ranking=tuple(
            sorted(
                (with_probability(r, credence, first.field.candidates) for r in ranking),
                key=_place([*found.claims, *outcome.effects]),
            )
        ),
        found=found.claims,
        not_testable=tuple(_not_testable(first.fitted, first.field)),
        remainder=left if found.remains else _without_terms(left),
        remainder_share=_share(outcome, left) if found.remains else 0.0,
        before=ranked[1],
        scored=outcome.scored,
        noise_floor=outcome.noise_floor,
        sizes=tuple(_sizes(first.fitted, first.field)),
        target=outcome.target,
        coefficients=outcome.coefficients,
        next_motion=tuple(
            next_motion.proposals(first.fitted, first.field, next_motion.pairs_of(rivals), limits)
        ),
        complaint=outcome.complaint,
        remark=found.remark(words(apart), budget.spent),
        reason=found.reason(words(apart), budget.spent),
        disagree=apart,
        tests=round(first.field.effective_count, 3),
        explained=outcome.explained,
        groups=groups(found.claims, ranking, found.steady),
        credible_set=credence.credible,
        holds=_followed(
            outcome.target, [(t.effect, t.instant) for t in steps] + [*last.instants.items()], found.claims
        ),
        staged=bool(steps),
        off_sheet=tuple(
            off_sheet(outcome.target.model, outcome.target.instrument, outcome.target.calibration)
        ),
    )


def _share(o: Outcome, left: Remainder) -> float:
    """Of what the outcome leaves above the noise the share that generic terms explain."""
    above = sum(s.square for s in left.searches) - o.target.calibration.rows
    by_terms = sum(s.chi2 for s in left.searches)
    return min(1.0, by_terms / max(above, by_terms, 1.0))


@dataclass(frozen=True, eq=False)
class Outcome:
    """Flights with some ``effects`` in the model, and what they leave.

    Effects that are not derived into the model of ``target`` are in its candidate columns ``given``.
    """

    effects: tuple[str, ...]
    target: Fitted
    given: tuple[int, ...]
    coefficients: Array
    scored: Scored
    remainder: Remainder
    random: Mapping[str, Test]

    @staticmethod
    def of(f: Fitted, effects: Sequence[str], given: Sequence[int]) -> Outcome:
        v = f.vector(f.coefficients(given)[0], given) if given else np.zeros(f.size)
        (scored,) = f.score([v])
        rem, random = _remainder(f, given)
        return Outcome(
            effects=tuple(effects),
            target=f,
            given=tuple(given),
            coefficients=v,
            scored=scored,
            remainder=rem,
            random={e: x.test() for e, x in random.items()},
        )

    @cached_property
    def robust(self) -> Robust:
        return Robust.of(Regression.of(self.target, self.given))

    @cached_property
    def noise_floor(self) -> float:
        return fitted_.noise_floor(self.target)

    @cached_property
    def explained(self) -> Explained:
        return explained(self.target, self.scored)

    @property
    def complaint(self) -> str | None:
        """What speaks against the fit, in words."""
        return self.target.calibration.complaint

    @property
    def remains(self) -> bool:
        """Whether the discrepancy is significant."""
        return self.remainder.significant or self.loud

    @cached_property
    def loud(self) -> bool:
        return comparison.loud(self.target, self.scored, self.noise_floor)

    def significance(self, effect: str, log_p: float | None, *, doubted: bool) -> float:
        """Logarithm of the p-value of an effect beside the others (see ``claims.Significance.log_p``)."""
        return self.robust.significance(effect).log_p(log_p, doubted=doubted)


@dataclass(frozen=True, eq=False)
class Conclusion:
    """The verdict, the effects that are claimed, and what is left beside them.

    ``open``: effects that the record speaks for, but not surely enough; ``line``, ``steady``: see ``line_rival``; ``share``: probability
    of what the search chose against generic terms; ``rival``: these do as well.
    """

    verdict: str
    claims: tuple[str, ...]
    outcome: Outcome
    left: Remainder
    line: LineRival | None
    steady: tuple[Steady, ...]
    open: tuple[str, ...]
    share: float = 1.0
    rival: bool = False

    @property
    def remains(self) -> bool:
        return self.verdict in ("unexplained", "partly-explained")

    @staticmethod
    def of(
        first: Stage,
        steps: Sequence[Taken],
        last: Stage,
        outcome: Outcome,
        extend: Extend | None,
        apart: bool,
        output: Sequence[str],
    ) -> Conclusion:
        """Judge what the search has chosen."""
        line, steady = line_rival(steps, last)
        if line is not None and not line.better(outcome.remainder):
            line = None
        count = first.field.count + len(outcome.random)
        log_p = _p_values(last)
        base = omnibus.remainders(first.fitted) if outcome.effects else None
        share = 1.0 if base is None else float(expit(_ahead(first, steps, outcome, count, base)))
        weak: list[str] = []
        while not (line or apart) and (e := _weakest(outcome, log_p, first.field)):
            weak.append(e)
            outcome = _without(first, steps, last, outcome, e, extend)
        left = outcome.remainder if line is None else line.within(outcome.remainder)
        random = sorted((t.log_p, e) for e, t in outcome.random.items() if selection.significant(t, count))
        # noise that follows the motion is louder where the motion is: a random effect says so itself
        remains = line is not None or left.significant or outcome.complaint is not None
        remains = remains or (outcome.loud and not random)
        claimed: tuple[str, ...] = ()
        doubted = apart or outcome.explained.complaint is not None
        if not (line or doubted):
            claimed = () if base is None else _claims(first, steps, outcome, count, base)
        rival = bool(outcome.effects) and not claimed and not remains
        if rival and base is not None:  # generic terms do as well as what was chosen: they are what is left
            _, left = claims.generic_evidence(base, np.inf, _rank(steps, first, outcome))
        remains = remains or rival or doubted
        if not remains:
            claimed = (*claimed, *(e for _, e in random[:1]))
        if not (line or doubted):  # what the recorder did stands in the record, whatever else does
            claimed = (*claimed, *output)
        verdict = ("partly-explained" if claimed else "unexplained") if remains else "missing-effect"
        verdict = verdict if remains or claimed else "adequate"
        beside = last.choice.conditional
        unsure = sorted((t.log_p, e) for e, t in beside.items() if t.rank and t.log_p < np.log(OPEN))
        return Conclusion(
            verdict=verdict,
            claims=claimed,
            outcome=outcome,
            left=left,
            line=line,
            steady=tuple(s for s in steady if s.effect in claimed),
            open=tuple(dict.fromkeys(e for e in (*weak, *(e for _, e in unsure)) if e not in claimed)),
            share=share,
            rival=rival,
        )

    @property
    def contradictory(self) -> bool:
        """Whether flights that contradict each other would explain the verdict."""
        loud = self.outcome.target.calibration.excess > QUIET
        return self.verdict == "unexplained" or (self.remains and loud)

    def remark(self, apart: str | None, spent: bool) -> str | None:
        """What is wrong with the record, or what else than the effects found would do, or how the record is disturbed."""
        doubt = apart or self.outcome.explained.complaint
        if doubt is not None:
            return doubt
        if self.line is not None:
            return self.line.words
        disturbed = comparison.disturbed(self.outcome.target)
        said = [s.words for s in self.steady]
        said += [f"the search was ended after {strong.FITS} fits"] if spent and self.remains else []
        return "; ".join([*said, *([] if disturbed is None else [disturbed])]) or None

    def reason(self, apart: str | None, spent: bool) -> str | None:
        """In one sentence, why the verdict is not ``adequate``, and what is odd about the record."""
        remark = self.remark(apart, spent)
        if self.verdict == "adequate" or apart or self.line or self.outcome.explained.complaint:
            return remark
        sure = "is sure" if len(self.claims) == 1 else "are sure"
        how = sure if self.remains else "is missing" if len(self.claims) == 1 else "are missing"
        said = [f"{listed(self.claims)} {how}"] if self.claims else []
        if self.remains:
            said.append(self._left())
        if self.open:
            said.append(
                f"the record does not suffice to say whether {listed(self.open[:3], 'or')} is there, too"
            )
        return "; ".join([*said, *([] if remark is None else [remark])])

    def _left(self) -> str:
        """What remains, in words."""
        o = self.outcome
        terms = [f"{t.term.harmonic} x {t.term.product}" for x in self.left.searches for t in x.terms]
        if self.rival and terms:
            return f"{listed(o.effects)} would do, but no better than a generic term, {terms[0]}"
        rms = o.scored.whole.rms_Eo
        found = [] if o.complaint is None else [o.complaint]
        if terms:
            found.append(f"what remains is more than noise, mostly {terms[0]}")
        return "; ".join(found) or (
            f"what remains, {rms:.3g} Eo, is more than the noise of {o.noise_floor:.3g} Eo"
        )


OPEN = 0.1
"""p-value from which an effect is named as one for which the record does not suffice."""


def listed(names: Sequence[str], word: str = "and") -> str:
    return f" {word} ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _p_values(last: Stage) -> dict[str, float]:
    """Of what the last stage has chosen, each beside the others."""
    chosen = last.choice.chosen
    return {e: last.field.tests([o for o in chosen if o != e])[e].log_p for e in chosen}


def _weakest(o: Outcome, log_p: Mapping[str, float], field: Field) -> str | None:
    """The effect that is not significant with a variance that its own scores tell, the least significant of several."""
    doubted = o.remainder.significant
    level = selection.FAMILY if len(o.effects) == 1 else selection.FURTHER
    p = {e: o.significance(e, log_p.get(e), doubted=doubted) for e in o.effects}
    weakest = max(p, key=lambda e: (p[e], e), default=None)
    if weakest is None or field.significant(Test(0.0, 1, p[weakest], ()), level):
        return None
    return weakest


def _claims(
    first: Stage, steps: Sequence[Taken], o: Outcome, count: int, base: Sequence[Remainder]
) -> tuple[str, ...]:
    """What of an outcome's effects may be claimed (``claims``)."""
    if not o.effects:
        return ()
    instants = {e.id for e in first.fitted.model.candidates if e.kind == "step"}
    lasting = [e for e in o.effects if e not in instants]  # the instant of a step is from all of the record
    if any(claims.held_out_gain(o.robust.regression, e) < -claims.WORSE for e in lasting):
        return ()
    chi2, single = _explained(first, o) - _rank(steps, first, o), claims.best_single(base)
    ahead = _ahead(first, steps, o, count, base)
    if o.remains:
        return o.effects if chi2 > claims.MORE * single and ahead > claims.PLAINLY else ()
    # of one effect that leaves but noise and generic terms that do as well, the one that is known to occur is taken
    if len(o.effects) == 1:
        return o.effects if ahead > -claims.PLAINLY else ()
    feigned = single > claims.NEARLY * chi2
    return o.effects if ahead > claims.PLAINLY * (2 * len(o.effects) - 1 if feigned else 1) else ()


def _rank(steps: Sequence[Taken], first: Stage, o: Outcome) -> int:
    """Number of coefficients that were tested of an outcome's effects."""
    tests = dict(first.choice.tests) | {t.effect: t.test for t in steps}
    return sum(max(1, tests[e].rank) if e in tests else 1 for e in o.effects)


def _ahead(first: Stage, steps: Sequence[Taken], o: Outcome, count: int, base: Sequence[Remainder]) -> float:
    """Log evidence by which an outcome's effects are ahead of the best generic terms of as many coefficients."""
    chi2, rank = _explained(first, o), _rank(steps, first, o)
    spread = max(claims.spread_of(o.remainder), o.target.calibration.excess) if o.remains else 1.0
    # with a cap, if nothing remains: no terms explain more than all
    terms, _ = claims.generic_evidence(base, np.inf if o.remains else chi2, rank, spread)
    return claims.evidence(chi2, rank, [count] * len(o.effects), spread) - terms


SECOND_ORDER = 0.05
"""Share by which second orders may change what an effect explains: more is not its doing, but that of a base that has moved."""


def _explained(first: Stage, o: Outcome) -> float:
    """Chi-square that an outcome's effects explain of what the model leaves without them."""
    field = first.field
    known = [e for e in o.effects if e in field.candidates]
    linear = field.joint([[n for n, _ in field.candidates[e]] for e in known])[0] if known else 0.0
    if o.given or len(known) < len(o.effects):
        return linear
    # second orders of strong effects: what is left once they are derived into the model, with a noise that is estimated anew
    fitted = float(np.sum(field.P[:, -1] ** 2) - o.target.whole[-1, -1] ** 2)
    return max(linear, min(fitted, (1.0 + SECOND_ORDER) * linear))


def _without(
    first: Stage, steps: Sequence[Taken], last: Stage, o: Outcome, effect: str, extend: Extend | None
) -> Outcome:
    """An outcome without one of its effects, fitted again."""
    kept = [e for e in o.effects if e != effect]
    if not kept:
        return Outcome.of(first.fitted, (), ())
    if extend is None or not (steps or o.target is not last.fitted):
        given = [n for e in kept for n, _ in last.field.candidates[e]]
        return Outcome.of(last.fitted, kept, given)
    instants = dict(last.instants) | {t.effect: t.instant for t in steps if t.instant is not None}
    model, instrument = contenders.derived(first.fitted, kept, instants, extend)
    return Outcome.of(fit(model, instrument, first.fitted.observations), kept, ())


def _ranked(
    ranking: Sequence[Ranked], before: Error, steps: Sequence[Taken], last: Stage, found: Conclusion
) -> list[Ranked]:
    """The effects as they stand in the ranking; ``ranking`` is the first stage's, ``before`` the error without any."""
    random = {} if found.remains else found.outcome.random
    ranking = [*ranking, *_ranked_random(random, before)]
    if steps:
        chosen = last.choice.chosen
        later = (
            _ranking(last.fitted, last.field, last.choice, last.instants, only=chosen)[0] if chosen else []
        )
        ranking = staged(steps, later, ranking, found.outcome.target)
    if found.verdict != "partly-explained":
        return list(ranking)
    robust = found.outcome.robust
    covariance = claims.with_shift(robust.sandwich, claims.shift(robust, found.left))
    return [_beside_rest(r, found.outcome, covariance) if r.effect in found.claims else r for r in ranking]


def _beside_rest(r: Ranked, o: Outcome, covariance: Array) -> Ranked:
    """A row with the values as they stand beside all that is claimed, and a covariance that knows of what remains."""
    c, f = o.target.calibration, o.target
    every = [*c.columns, *(f.candidates[k] for k in o.given)]
    E = [k for k, q in enumerate(every) if q.effect == r.effect]
    columns = [every[k] for k in E]
    values = (o.robust.value - o.robust.regression.centre)[E]
    instant = [q for q in r.parameters if q.name == "t_step"]
    own = covariance[np.ix_(E, E)]
    return replace(
        r,
        parameters=(*parameter_values(columns, values, own), *instant),
        combinations=tuple(visible_combinations(f.model, c.p, columns, values, own)),
    )


def _followed(
    target: Fitted, instants: Sequence[tuple[str, float | None]], found: Sequence[str]
) -> sequential.Evidence | None:
    """From when on the model no longer holds; a step that is found is such an instant itself."""
    if target.observations[0].recorded.demodulated:
        return None  # neighbouring samples of a demodulated channel are not independent
    followed = sequential.evidence(target)
    for effect, instant in instants:
        if effect in found and instant is not None:
            name = target.observations[0].flight_name
            change = sequential.Change(flight=name, until=instant, log_evidence=followed.limit)
            return replace(followed, change=change)
    return followed


def _without_terms(rem: Remainder) -> Remainder:
    return Remainder(tuple(replace(s, terms=()) for s in rem.searches))


def _output_effects(f: Fitted, flights: Sequence[Flight]) -> list[str]:
    """Effects of the recorder, recognised in the columns in which each is looked for: the recorded outputs, or those it names."""
    found = set()
    place = f.prepared[0].observation.place
    first = [(w, b) for w, b in zip(f.prepared, f.beyond, strict=True) if w.observation.place == place]
    for x, (w, fast) in zip(flights, first, strict=True):
        columns = {**x.channels, **x.outputs}
        noise = float(np.sqrt(w.noise.power + fast))
        outputs = [n for n in x.outputs if n in f.instrument.layout.columns]
        for effect, r in f.model.recognisers.items():
            looked_at = (columns[n] for n in getattr(r, "CHANNELS", outputs) if n in columns)
            if any(_present(r, c, x.valid, noise) for c in looked_at):
                found.add(effect)
    return sorted(found)


def _present(r: Recogniser, c: Array, valid: NDArray[np.bool_], noise: float) -> bool:
    """Whether an effect of the recorder shows in a column (N,), which is not kept in memory."""
    return r.present(c, np.isfinite(c) & valid, noise)


UNEXPLAINED = 10.0
"""Times the noise's chi-square that all effects of the catalogue together must leave for flights to contradict each other."""


def contradiction(first: Stage) -> tuple[Disagreement, ...]:
    """The flights that agree, where each is explained by the model and all together are not; ``first`` is the stage without effects."""
    f = first.fitted
    flights = _by_flight(f)
    left = float(first.field.P[-1, -1] ** 2)
    if len(flights) < 2 or left < UNEXPLAINED * f.calibration.rows:
        return ()
    if not all(_quiet(f, x) for x in flights):
        return ()
    agree: list[list[Sequence[Observation]]] = []
    for one in flights:
        group = next((g for g in agree if _quiet(f, [*g[0], *one])), None)
        if group is None:
            agree.append([one])
        else:
            group.append(one)
    return tuple(Disagreement(tuple(x[0].flight_name for x in g), ()) for g in agree)


def disagreement(f: Fitted, flights: Sequence[Flight], extend: Extend | None) -> tuple[Disagreement, ...]:
    """What each of the flights lacks by itself, where each is explained so; nothing if one is not."""
    found: dict[tuple[str, ...], list[str]] = {}
    for x, own in zip(flights, _by_flight(f), strict=True):
        d = diagnose_fitted(fit(f.model, f.instrument, own), [x], extend)
        if d.remains:
            return ()
        found.setdefault(tuple(sorted(d.found)), []).append(own[0].flight_name)
    return tuple(Disagreement(tuple(names), effects) for effects, names in found.items())


def _by_flight(f: Fitted) -> list[list[Observation]]:
    flights: dict[int, list[Observation]] = {}
    for o in f.observations:
        flights.setdefault(o.flight, []).append(o)
    return list(flights.values())


def _quiet(f: Fitted, observations: Sequence[Observation]) -> bool:
    """Whether the model leaves but noise of some of the observations."""
    return calibrated(f.model, f.instrument, observations)[1].excess <= QUIET


def confirmed(steps: Sequence[Taken], last: Stage, extend: Extend | None) -> tuple[Stage, Outcome]:
    """The chosen effects fitted in the model; and the last stage without those that then have an impossible size."""
    f = last.fitted
    final = _derived(f, last.choice.chosen, extend)
    while final is not None and (wrong := strong.impossible(final, last.choice.chosen)):
        kept = {e: c for e, c in last.field.candidates.items() if e not in wrong}
        field = replace(last.field, candidates=kept)
        last = replace(last, field=field, choice=selection.choose(field))
        final = _derived(f, last.choice.chosen, extend)
    chosen = [*(t.effect for t in steps), *last.choice.chosen]
    given = [n for e in last.choice.chosen for n, _ in last.field.candidates[e]]
    return last, Outcome.of(f, chosen, given) if final is None else Outcome.of(final, chosen, ())


def _derived(f: Fitted, chosen: Sequence[str], extend: Extend | None) -> Fitted | None:
    """The chosen effects derived into the model and everything fitted again, if that can be done."""
    steps = {e.id for e in f.model.candidates if e.kind == "step"}
    if not chosen or extend is None or (steps & set(chosen)):
        return None
    extended = extend(f.model, chosen)
    start = _linear(f, chosen, extended)
    return fit(extended, f.instrument, f.observations, f.calibration.noise, start)


def _linear(f: Fitted, chosen: Sequence[str], extended: Model) -> Array:
    """Parameter vector of the extended model as the linear fit has it, SI."""
    own = [(n, c) for n, c in enumerate(f.candidates) if c.effect in chosen]
    fitted, _ = f.coefficients([n for n, _ in own])
    columns = (*f.calibration.columns, *(c for _, c in own))
    before = (*f.calibration.p[f.calibration.index], *(0.0 for _ in own))
    value = {c.label: b + x * c.scale for c, b, x in zip(columns, before, fitted, strict=True)}
    p = vector(extended, f.instrument)
    for c, place in design.base_columns(extended, f.instrument):
        p[place] = value[c.label]
    return p


def _remainder(f: Fitted, given: Sequence[int]) -> tuple[Remainder, dict[str, Variance]]:
    """What is left once ``given`` columns are projected out, and the sums of random effects, in one pass."""
    random = _random_columns(f)
    searches, counted = [], []
    for x, triangles in zip(f.prepared, f.triangles, strict=True):
        taken = whitening.projector(triangles, f.n_base, given)
        lean, projector, places = taken.lean(x, list(random.values()))

        def variances(piece: Piece, y: Array, places: Sequence[int] = places) -> dict[str, Variance]:
            return {e: Variance.of(piece, k, y) for e, k in zip(random, places, strict=True)}

        found, more = omnibus.search(lean, projector, variances)
        searches.append(found)
        counted += more
    return Remainder(tuple(searches)), {e: pooled([v[e] for v in counted]) for e in random}


def _random_columns(f: Fitted) -> dict[str, int]:
    """The place of every random effect's column."""
    if any(o.recorded.demodulated for o in f.observations):
        return {}  # neighbouring samples of a demodulated channel are not independent
    columns = f.candidates
    found = {}
    for e in f.model.candidates:
        own = [n for n, c in enumerate(columns) if c.effect == e.id]
        if e.kind == "random" and own:
            found[e.id] = f.n_base + own[0]
    return found
