"""Which physical effect is missing: the method, its verdict, and what the record cannot separate.

The model is calibrated, every candidate tested on what no parameter absorbs, strong ones derived into the model one after the
other; a refit with all chosen effects shows whether the residual comes down to noise.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.threads import one_thread
from ragg_runtime.estimation.calibration import list_off_sheet
from ragg_runtime.estimation.fitted import Fitted, fit, measure_noise_floor, release_held
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.estimation.scores import Error
from ragg_runtime.estimation.thinning import thin_observations
from ragg_runtime.identification import (
    next_motion,
    sequential,
)
from ragg_runtime.identification.claims import Regression, Robust, add_shift
from ragg_runtime.identification.contenders import Extend
from ragg_runtime.identification.disagreement import are_far_apart, find_disagreement
from ragg_runtime.identification.formula import propose_formulas
from ragg_runtime.identification.omnibus import Remainder
from ragg_runtime.identification.parameters import Estimates
from ragg_runtime.identification.ranking import (
    Ranked,
    add_probability,
    list_detectable,
    list_not_testable,
    rank_effects,
    rank_stages,
    sort_by_choice,
    weigh_effects,
)
from ragg_runtime.identification.result import (
    Diagnosis,
    Disagreement,
    describe_disagreement,
    group_findings,
    name_verdict,
)
from ragg_runtime.identification.search import Evidence, Outcome, search
from ragg_runtime.identification.strong import Stage
from ragg_runtime.identification.verdict import Conclusion
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
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
    observations = thin_observations(model, instrument, observe_flights(flights, instrument))
    f = fit(model, instrument, observations)
    return diagnose_fitted(f, flights, extend, limits)


@one_thread
def diagnose_fitted(
    f: Fitted,
    flights: Sequence[Flight],
    extend: Extend | None = None,
    limits: Mapping[str, float] = next_motion.LIMITS,
) -> Diagnosis:
    """As :func:`diagnose`, on flights that are already fitted; ``limits`` as for ``next_motion.propose_motions``."""
    output = _find_output_effects(f, flights)
    first = Stage.of(f)
    several = len(flights) > 1
    apart = find_disagreement(first, extend) if several and are_far_apart(first) else ()
    # before strong effects, whose columns take the place of these
    ranked = rank_effects(first.fitted, first.field, first.choice, first.instants, output)
    evidence = search(first, extend, apart=bool(apart))
    found = Conclusion.of(evidence, output, apart=bool(apart))
    if several and found.remains and not apart:
        apart = find_disagreement(first, extend)
        found = replace(found, verdict="unexplained", claims=()) if apart else found
    if not (apart or found.line or found.outcome.explained.complaint) and (found.remains or not found.claims):
        o, claimed = found.outcome, set(found.claims) & set(found.outcome.effects)
        beside = (o.target, o.given) if claimed else (first.fitted, ())
        left = propose_formulas(*beside, found.left)
        if found.remains or left.significant:
            found = replace(found, verdict=name_verdict(claimed=bool(found.claims), remains=True), left=left)
    ranking = complete_ranking(*ranked, evidence, found)
    noise = _choose_noise(f, found.outcome.target)
    return _make_diagnosis(evidence, found, ranking, ranked[1], noise, apart, limits)


SAME = 1.05
"""Factor up to which two estimates of a noise floor are one number: of slow noise it is hardly known better."""


def _choose_noise(f: Fitted, target: Fitted) -> Fitted:
    """The fit whose noise floor is stated: without effects, as `compare` has it, unless that took what effects explain for noise."""
    ratio = measure_noise_floor(f) / measure_noise_floor(target)
    return f if 1.0 / SAME < ratio < SAME else target


def _make_diagnosis(
    evidence: Evidence,
    found: Conclusion,
    ranking: Sequence[Ranked],
    before: Error,
    noise: Fitted,
    apart: tuple[Disagreement, ...],
    limits: Mapping[str, float],
) -> Diagnosis:
    """What is reported; ``before``: the error without any effect, ``noise``: the fit of the noise floor, ``apart``: how flights
    disagree.
    """
    first, outcome, left, target = evidence.first, found.outcome, found.left, found.outcome.target
    credence = weigh_effects(evidence.last.field, evidence.steps).within(found.share)
    rows = (add_probability(r, credence, first.field.candidates) for r in ranking)
    pairs = next_motion.list_pairs(evidence.alternatives())
    return Diagnosis(
        verdict=found.verdict,
        fitted=first.fitted,
        ranking=tuple(sorted(rows, key=sort_by_choice([*found.claims, *outcome.effects]))),
        found=found.claims,
        not_testable=tuple(list_not_testable(first.fitted, first.field)),
        remainder=left if found.remains else _drop_terms(left),
        remainder_share=_share(outcome, left) if found.remains else 0.0,
        before=before,
        scored=outcome.scored,
        noise=noise,
        sizes=tuple(list_detectable(first.fitted, first.field)),
        target=target,
        coefficients=outcome.coefficients,
        next_motion=tuple(next_motion.propose_motions(first.fitted, first.field, pairs, limits)),
        complaint=outcome.complaint,
        remarks=tuple(found.remarks(describe_disagreement(apart), evidence.spent)),
        reasons=tuple(found.reasons(describe_disagreement(apart), evidence.spent)),
        disagree=apart,
        tests=round(first.field.effective_count, 3),
        explained=outcome.explained,
        groups=group_findings(found.claims, ranking, found.steady, found.shared),
        credible_set=credence.credible,
        holds=_find_change(target, evidence.instants, found.claims),
        staged=bool(evidence.steps),
        off_sheet=tuple(list_off_sheet(target.model, target.instrument, target.calibration)),
    )


def _share(o: Outcome, left: Remainder) -> float:
    """Of what the outcome leaves above the noise the share that generic terms explain."""
    above = sum(s.square for s in left.searches) - o.target.calibration.rows
    by_terms = sum(s.chi2 for s in left.searches)
    return min(1.0, by_terms / max(above, by_terms, 1.0))


def complete_ranking(
    ranking: Sequence[Ranked], before: Error, evidence: Evidence, found: Conclusion
) -> list[Ranked]:
    """The effects in the order of the ranking; ``ranking`` is the first stage's, ``before`` the error without any."""
    steps, last = evidence.steps, evidence.last
    random = {} if found.remains else found.outcome.random
    ranking = [*ranking, *(Ranked.without_columns(e, t, before) for e, t in random.items())]
    if steps:
        chosen = last.choice.chosen
        later = (
            rank_effects(last.fitted, last.field, last.choice, last.instants, only=chosen)[0]
            if chosen
            else []
        )
        ranking = rank_stages(steps, later, ranking, found.outcome.target)
    # beside a rival only what the recorder did is claimed, which has no columns
    if found.verdict != "partly-explained" or found.rival:
        return list(ranking)
    o = found.outcome
    free = release_held(o.target, candidates=bool(o.given))
    given = [k for k, q in enumerate(free.candidates) if o.given and q.effect in found.claims]
    fitted = [q.label for q in (*o.target.calibration.columns, *(o.target.candidates[k] for k in o.given))]
    columns = [*free.calibration.columns, *(free.candidates[k] for k in given)]
    robust = Robust.of(Regression.of(free, given))
    # the values as they stand beside all that is claimed, and a covariance that knows of what remains
    covariance = add_shift(robust, found.left, [q.label for q in columns], fitted)
    values = robust.value - robust.regression.absent
    claimed = Estimates(free.model, free.calibration.p, columns, values, covariance)
    return [
        r.with_estimates(claimed.select(r.effect), r.instant) if r.effect in found.claims else r
        for r in ranking
    ]


def _find_change(
    target: Fitted, instants: Sequence[tuple[str, float | None]], found: Sequence[str]
) -> sequential.SequentialTest | None:
    """From when on the model no longer holds; a step that is found is such an instant itself."""
    if target.observations[0].recorded.demodulated:
        return None  # neighbouring samples of a demodulated channel are not independent
    followed = sequential.follow_model(target)
    for effect, instant in instants:
        if effect in found and instant is not None:
            name = target.observations[0].flight_name
            change = sequential.ChangePoint(flight=name, until=instant, log_evidence=followed.limit)
            return replace(followed, change=change)
    return followed


def _drop_terms(rem: Remainder) -> Remainder:
    return Remainder(tuple(replace(s, terms=()) for s in rem.searches))


def _find_output_effects(f: Fitted, flights: Sequence[Flight]) -> list[str]:
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
