"""Which physical effect is missing: the method, its verdict, and what the record cannot separate.

The model is calibrated, every candidate tested on what no parameter absorbs, strong ones derived into the model one after the
other; a refit with all chosen effects shows whether the residual comes down to noise.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ragg_runtime.base.progress import one_thread
from ragg_runtime.estimation.fitted import Fitted, fit, measure_noise_floor, release_held
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.estimation.thinning import thin_observations
from ragg_runtime.identification import next_motion, ranking
from ragg_runtime.identification.claims import Regression, estimate_covariance
from ragg_runtime.identification.consistency import are_far_apart, find_change, find_disagreement
from ragg_runtime.identification.formula import propose_formulas
from ragg_runtime.identification.omnibus import Remainder
from ragg_runtime.identification.parameters import Estimates
from ragg_runtime.identification.ranking import Ranked, rank_effects
from ragg_runtime.identification.result import (
    ChangePoint,
    Diagnosis,
    Disagreement,
    describe_disagreement,
    group_findings,
    name_verdict,
)
from ragg_runtime.identification.search import Evidence, search
from ragg_runtime.identification.strong import Extend, Stage
from ragg_runtime.identification.verdict import Conclusion
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model.model import Model


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
    first = Stage.of(f)
    several = len(flights) > 1
    apart = find_disagreement(first, extend) if several and are_far_apart(first) else ()
    # a mistake that screening has named is in the whole record, anything else that is odd in some of its columns
    mistakes = [flag.effects for x in flights for flag in x.flags if flag.open and not flag.columns]
    evidence = search(first, extend, apart=bool(apart), mistakes=mistakes)
    output = _find_output_effects(f, flights)
    c = Conclusion.of(evidence, output, apart=bool(apart))
    if several and c.remains and not apart:
        apart = find_disagreement(first, extend)
        c = replace(c, verdict="unexplained", claims=()) if apart else c
    if not (apart or c.line or c.outcome.explained.complaint) and (c.remains or not c.claims):
        o, claimed = c.outcome, set(c.claims) & set(c.outcome.effects)
        beside = (o.target, o.extra) if claimed else (first.fitted, ())
        left = propose_formulas(*beside, c.left)
        if c.remains or left.significant:
            c = replace(c, verdict=name_verdict(claimed=bool(c.claims), remains=True), left=left)
    certain = [Ranked.without_columns(e, ranking.CERTAIN, first.scored.whole) for e in output]
    ranked = complete_ranking([*rank_effects(first), *certain], evidence, c)
    return _make_diagnosis(evidence, c, ranked, _choose_noise(f, c.outcome.target), apart, limits)


# factor up to which two estimates of a noise floor are one number: of slow noise it is hardly known better
SAME = 1.05


def _choose_noise(f: Fitted, target: Fitted) -> Fitted:
    """The fit whose noise floor is stated: without effects, as `compare` has it, unless that took what effects explain for noise."""
    ratio = measure_noise_floor(f) / measure_noise_floor(target)
    return f if 1.0 / SAME < ratio < SAME else target


def _make_diagnosis(
    evidence: Evidence,
    c: Conclusion,
    ranked: Sequence[Ranked],
    noise: Fitted,
    apart: tuple[Disagreement, ...],
    limits: Mapping[str, float],
) -> Diagnosis:
    """The result; ``noise``: the fit that gives the noise floor, ``apart``: how flights disagree."""
    first, outcome, left = evidence.first, c.outcome, c.left
    f, problem = first.fitted, first.problem
    credence = ranking.weigh_effects(evidence.last.problem, evidence.steps).within(c.share)
    chosen = [*dict.fromkeys([*c.claims, *outcome.effects])]
    place = {e: n for n, e in enumerate(chosen)}
    # of what the outcome leaves above the noise generic terms explain so much
    above = sum(s.square for s in left.searches) - outcome.target.calibration.rows
    by_terms = sum(s.chi2 for s in left.searches)
    rows = (ranking.add_probability(r, credence, problem.candidates) for r in ranked)
    groups = evidence.alternatives().items()
    pairs = [(e, r) for e, alternatives in groups for r in alternatives[: next_motion.ALTERNATIVES]]
    return Diagnosis(
        verdict=c.verdict,
        fitted=f,
        ranking=tuple(sorted(rows, key=lambda r: (place.get(r.effect, len(place)), r.log_p, r.effect))),
        found=c.claims,
        not_testable=tuple(ranking.list_not_testable(f, problem)),
        remainder=left if c.remains else Remainder(tuple(replace(s, terms=()) for s in left.searches)),
        remainder_share=min(1.0, by_terms / max(above, by_terms, 1.0)) if c.remains else 0.0,
        before=first.scored.whole,
        noise=noise,
        sizes=tuple(ranking.list_detectable(problem)),
        outcome=outcome,
        next_motion=tuple(next_motion.propose_motions(f, problem, pairs, limits)),
        reasons=tuple(c.reasons(describe_disagreement(apart), spent=evidence.spent)),
        disagree=apart,
        tests=round(problem.effective_count, 3),
        groups=group_findings(c.claims, ranked, c.steady, c.shared),
        credible_set=credence.credible,
        change=_find_change(outcome.target, evidence.instants, c.claims),
    )


def complete_ranking(ranked: Sequence[Ranked], evidence: Evidence, c: Conclusion) -> list[Ranked]:
    """The effects of the first stage's ranking, those that were derived into the model by what it leaves without and with them, and the
    random ones.
    """
    o, rows = c.outcome, [*ranked]
    if not c.remains:
        rows += [Ranked.without_columns(e, t, evidence.first.scored.whole) for e, t in o.random.items()]
    if evidence.steps:
        rows += rank_effects(evidence.last, only=evidence.last.chosen)
        free = release_held(o.target)
        rows += [ranking.rank_added(t, free) for t in evidence.steps]
    rows = [*{r.effect: r for r in rows}.values()]
    # beside a rival only what the recorder did is claimed, which has no columns
    return rows if c.verdict != "partly-explained" or c.rival else _restate_claims(rows, c)


def _restate_claims(rows: Sequence[Ranked], c: Conclusion) -> list[Ranked]:
    """The rows with values fitted beside all claimed effects, and a covariance that allows for the discrepancy."""
    o = c.outcome
    free = release_held(o.target, candidates=bool(o.extra))
    extra = [k for k, q in enumerate(free.candidates) if o.extra and q.effect in c.claims]
    fitted = [q.label for q in (*o.target.calibration.columns, *(o.target.candidates[k] for k in o.extra))]
    columns = [*free.calibration.columns, *(free.candidates[k] for k in extra)]
    robust = Regression.of(free, extra)
    covariance = estimate_covariance(robust, c.left, [q.label for q in columns], fitted)
    values = robust.value - robust.absent
    claimed = Estimates(free.model, free.calibration.p, columns, values, covariance)
    return [
        r.with_estimates(claimed.select(r.effect), r.instant) if r.effect in c.claims else r for r in rows
    ]


def _find_change(target: Fitted, instants: Mapping[str, float], claimed: Sequence[str]) -> ChangePoint | None:
    """The instant from which the model no longer holds: that of a claimed step, else as :func:`find_change` tells it."""
    if target.observations[0].recorded.demodulated:
        return None  # neighbouring samples of a demodulated channel are not independent
    steps = [instant for e, instant in instants.items() if e in claimed]
    return ChangePoint(target.observations[0].flight_name, steps[0]) if steps else find_change(target)


def _find_output_effects(f: Fitted, flights: Sequence[Flight]) -> list[str]:
    """Effects of the recorder, recognised in the columns in which each is looked for: the recorded outputs, or those it names."""
    effects = set()
    place = f.prepared[0].observation.place
    first = [(w, b) for w, b in zip(f.prepared, f.beyond, strict=True) if w.observation.place == place]
    for x, (w, fast) in zip(flights, first, strict=True):
        columns = {**x.channels, **x.outputs}
        noise = float(np.sqrt(w.noise.power + fast))
        outputs = [n for n in x.outputs if n in f.instrument.layout.columns]
        for effect, r in f.model.recognisers.items():
            looked_at = [columns[n] for n in getattr(r, "CHANNELS", outputs) if n in columns]
            if any(r.present(c, np.isfinite(c) & x.valid, noise) for c in looked_at):
                effects.add(effect)
    return sorted(effects)
