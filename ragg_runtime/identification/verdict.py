"""The verdict: what is claimed of what the search has found, what remains, and why, in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy.special import expit

from ragg_runtime.estimation.likelihood_ratio import Test, weigh
from ragg_runtime.estimation.scores import DISTINGUISHABLE
from ragg_runtime.identification import claims, comparison, omnibus, selection, strong
from ragg_runtime.identification.claims import Significance
from ragg_runtime.identification.line_rival import LineAlternative, Steady, find_line_rival
from ragg_runtime.identification.omnibus import Remainder, ResidualTerm
from ragg_runtime.identification.result import Reason, name_verdict
from ragg_runtime.identification.search import Evidence, Outcome
from ragg_runtime.identification.strong import Stage
from ragg_runtime.wording.numbers import join_names


@dataclass(frozen=True, eq=False)
class Conclusion:
    """The verdict, the effects that are claimed, and what remains.

    ``open``: effects that the record speaks for, but not surely enough; ``line``, ``steady``: see ``line_rival``; ``share``: probability
    of what the search chose against generic terms; ``rival``: these do as well; ``one``: the effect of which what it chose is a special
    case; ``shared``: the generic term that explains as much as the one claimed effect.
    """

    verdict: str
    claims: tuple[str, ...]
    outcome: Outcome
    left: Remainder
    line: LineAlternative | None
    steady: tuple[Steady, ...]
    open: tuple[str, ...]
    share: float
    rival: bool
    one: str | None
    shared: ResidualTerm | None

    @property
    def remains(self) -> bool:
        return self.verdict in ("unexplained", "partly-explained")

    @staticmethod
    def of(evidence: Evidence, output: Sequence[str], *, apart: bool) -> Conclusion:
        """Judge what the search has found; ``output``: what the recorder did."""
        chosen, line, steady = _drop_lines(evidence)
        base = omnibus.search_residuals(evidence.first.fitted) if chosen.effects else []
        count = evidence.first.problem.count + len(chosen.random)
        compare = partial(_compare_with_terms, evidence, base, count)
        outcome, weak = (chosen, []) if apart else _drop_unfounded(evidence, chosen)
        before = compare(chosen)
        lead = before if outcome is chosen else compare(outcome)
        while not (lead.claims or outcome.remains) and len(outcome.effects) > 1:
            # generic terms do as well as all of these, but perhaps not as well as those without the weakest
            _, weakest = _list_weakest(evidence, outcome)[0]
            less = evidence.without(outcome, [weakest])
            if less.remains:
                break
            outcome, weak = less, [*weak, weakest]
            lead = compare(outcome)
        one = _find_better_kind(evidence, outcome) if lead.claims else None
        left = outcome.remainder if line is None else line.within(outcome.remainder)
        random = _list_random(outcome, count)
        doubted = apart or outcome.explained.complaint is not None
        claimed = () if doubted or one is not None else lead.claims
        # noise that follows the motion grows with the motion: a random effect models just that
        exceeds = outcome.exceeds_noise and not random
        remains = line is not None or left.significant or outcome.complaint is not None or exceeds
        rival = bool(outcome.effects) and not claimed and not remains
        if rival:  # generic terms do as well as what was chosen: they are what is left
            _, left = claims.weigh_generic_terms(base, np.inf, lead.rank)
        remains = remains or rival or doubted
        if not remains:
            claimed = (*claimed, *random[:1])
        if not doubted:  # what the recorder did is certain, whatever else is in the record
            claimed = (*claimed, *output)
        alone = len(claimed) == 1 and claimed == outcome.effects
        return Conclusion(
            verdict=name_verdict(claimed=bool(claimed), remains=remains),
            claims=claimed,
            outcome=outcome,
            left=left,
            line=line,
            steady=tuple(s for s in steady if s.effect in claimed),
            open=_list_unsure(evidence.last, weak, claimed),
            share=float(expit(before.ahead)),
            rival=rival,
            one=None if claimed else one,
            shared=_find_shared_term(lead.chi2, base) if alone else None,
        )

    def reasons(self, apart: str | None, *, spent: bool) -> list[Reason]:
        """Why the verdict is not ``adequate``, and what is odd about the record; ``apart``: how its flights disagree."""
        doubt = apart or self.outcome.explained.complaint
        if doubt:
            return [Reason(doubt, kind="remark")]
        texts = [
            None if self.line is None else self.line.words,
            *(s.words for s in self.steady),
            f"the search stopped after {strong.FITS} fits" if spent and self.remains else None,
            comparison.describe_disturbance(self.outcome.target),
        ]
        remarks = [Reason(text, kind="remark") for text in texts if text is not None]
        reasons = []
        if self.claims:
            verb, how = "is" if len(self.claims) == 1 else "are", "certain" if self.remains else "missing"
            reasons.append(Reason(f"{join_names(self.claims)} {verb} {how}", kind="verdict"))
        if self.remains:
            reasons += self._describe_residual()
        if reasons and self.open:
            names = join_names(self.open[:3], "or")
            reasons.append(Reason(f"the record is not sufficient to decide whether {names} is also present"))
        return [*reasons, *remarks]

    def _describe_residual(self) -> list[Reason]:
        """What remains, in words."""
        o = self.outcome
        terms = [f"{t.term.harmonic} x {t.term.product}" for x in self.left.searches for t in x.terms]
        if self.one:
            cases = f"{join_names(o.effects)} would explain it, but {self.one} may explain it better"
            return [Reason(f"{cases}: add {self.one} and compare")]
        if self.rival:
            generic = f"a generic term, {terms[0]}" if terms else "generic terms"
            return [Reason(f"{join_names(o.effects)} would explain it no better than {generic}")]
        reasons = [] if o.complaint is None else [Reason(o.complaint)]
        noise = "the residual is more than noise by all generic terms together, none of which stands out"
        if terms:
            noise = f"the residual is more than noise, mostly {terms[0]}"
        elif o.exceeds_noise:
            rms = o.scored.whole.rms_Eo
            noise = f"the residual, {rms:.3g} Eo, is more than the noise of {o.noise_floor:.3g} Eo"
        return [*reasons, Reason(noise, kind="verdict")] if terms or not reasons else reasons


OPEN = 0.1  # p-value from which an effect is named as one for which the record does not suffice


def _drop_lines(evidence: Evidence) -> tuple[Outcome, LineAlternative | None, tuple[Steady, ...]]:
    """The outcome without the effects in whose place a line near a multiple of the spin rate does as well; that line, and those effects
    that are no more than a line at the multiple.
    """
    outcome = evidence.outcome
    line, steady = find_line_rival(evidence.steps, evidence.last)
    if line is None or not line.better(outcome.remainder):
        return outcome, None, steady
    return evidence.without(outcome, line.effects), line, steady


def _list_random(o: Outcome, count: int) -> list[str]:
    """The random effects that are significant next to the noise model, whose level has shapes of its own, the surest first."""
    tests = ((t, e) for e, t in o.random.items() if selection.is_significant(t, count, selection.FURTHER))
    return [e for _, e in sorted((t.log_p, e) for t, e in tests)]


def _drop_unfounded(evidence: Evidence, o: Outcome) -> tuple[Outcome, list[str]]:
    """The outcome without the effects that are not significant beside the others, and these, in the order in which they went.

    One at a time, as those that remain may be significant then; all at once if the budget of fits is spent.
    """
    weak: list[str] = []
    while o.effects:
        gone = [e for log_p, e in _list_weakest(evidence, o) if not _is_significant(evidence, o, log_p)]
        if not gone:
            other = _find_contradicted(o, evidence.first) or _find_unfitted(evidence, o)
            if other is None:
                break
            gone = [other]
        gone = gone if evidence.spent else gone[:1]
        weak += gone
        o = evidence.without(o, gone)
    return o, weak


def _list_unsure(last: Stage, weak: Sequence[str], claimed: Sequence[str]) -> tuple[str, ...]:
    """Effects that the record speaks for, but not surely enough: those that went, and others beside what the last stage chose."""
    beside = last.problem.tests([*last.chosen])
    near = sorted((t.log_p, e) for e, t in beside.items() if t.rank and t.log_p < np.log(OPEN))
    return tuple(dict.fromkeys(e for e in (*weak, *(e for _, e in near)) if e not in claimed))


def _list_weakest(evidence: Evidence, o: Outcome) -> list[tuple[float, str]]:
    """The logarithm of the p-value of every effect of an outcome, the least significant first."""
    return sorted(((_measure_log_p(evidence, o, e), e) for e in o.effects), reverse=True)


def _measure_log_p(evidence: Evidence, o: Outcome, effect: str) -> float:
    """Of an effect, with the variance of its own scores: by a linear test, or, where that may be wrong, by a fit without it.

    Far from there a linearisation may be wrong about what it explains. The effects of the last stage were tested beside the sheet as
    it was then: if that proves less sure, each competes with one still less sure.
    """
    s = o.regression.significance(effect)
    log_p = evidence.test(effect).log_p if effect in evidence.last.chosen else None
    linear = 0.0
    if not (o.widened and log_p is not None):
        linear = _compare_with_strongest(o, s, s.log_p(log_p, doubted=o.remainder.significant))
        if _is_significant(evidence, o, linear):
            return linear
    if evidence.spent:  # no fit is left for it
        return linear
    by_fit = replace(s, chi2=max(0.0, evidence.gain(o, effect)))
    return min(linear, _compare_with_strongest(o, by_fit, by_fit.log_p(None, doubted=True)))


def _compare_with_strongest(o: Outcome, s: Significance, log_p: float) -> float:
    """The p-value of an effect; 0 if it does not explain plainly more than the best generic term does of what is left."""
    left = [t.z**2 for x in o.remainder.searches for t in x.terms] if o.remainder.significant else []
    return 0.0 if s.chi2 - s.rank < claims.MORE * max(left, default=-np.inf) else log_p


def _is_significant(evidence: Evidence, o: Outcome, log_p: float) -> bool:
    level = selection.FAMILY if len(o.effects) == 1 else selection.FURTHER
    return evidence.first.problem.significant(Test(0.0, 1, log_p, ()), level)


def _find_contradicted(o: Outcome, first: Stage) -> str | None:
    """The effect that held-out blocks of time speak against most, if plainly; the instant of a step is from all of the record."""
    instants = {e.id for e in first.fitted.model.candidates if e.kind == "step"}
    speaks = {e: claims.weigh_held_out(o.regression, e) for e in o.effects if e not in instants}
    worst = min(speaks, key=lambda e: (speaks[e], e), default=None)
    return worst if worst is not None and speaks[worst] < -DISTINGUISHABLE else None


def _find_unfitted(evidence: Evidence, o: Outcome) -> str | None:
    """The least significant effect of a fit that has not converged."""
    log_p = {} if o.complaint is None else {e: evidence.test(e).log_p for e in o.effects}
    return max(log_p, key=lambda e: (log_p[e], e), default=None)


@dataclass(frozen=True)
class Lead:
    """What an outcome's effects explain, a chi-square with ``rank`` coefficients, the log evidence by which they are ahead of generic
    terms, and those that may be claimed (``claims``).
    """

    chi2: float
    rank: int
    ahead: float
    claims: tuple[str, ...]


def _compare_with_terms(evidence: Evidence, base: Sequence[Remainder], count: int, o: Outcome) -> Lead:
    """An outcome's effects, chosen of so many, with as many generic terms in searches of the residual of the model without effects."""
    if not o.effects:
        return Lead(0.0, 0, np.inf, ())
    chi2, rank = evidence.measure_chi2(o)
    charge = len(o.effects) * float(np.log(count)) + evidence.charge(o)
    ahead = _measure_lead(o, base, chi2, rank, charge)
    if o.remains:
        more = chi2 - rank > claims.MORE * claims.find_best_single(base)
        claimed = more and ahead > DISTINGUISHABLE
    else:
        # between an effect that leaves only noise and generic terms that do as well, the effect, known to occur, is taken
        claimed = ahead > (-DISTINGUISHABLE if len(o.effects) == 1 else 0.0)
    return Lead(chi2, rank, ahead, o.effects if claimed else ())


def _measure_lead(o: Outcome, base: Sequence[Remainder], chi2: float, rank: int, charge: float) -> float:
    """Log evidence by which an outcome's effects, which explain a chi-square, are ahead of the best terms."""
    spread = max(1.0, o.target.calibration.excess) if o.remains else 1.0
    # with a cap, if nothing remains: no terms explain more than all
    terms, _ = claims.weigh_generic_terms(base, np.inf if o.remains else chi2, rank, spread)
    return weigh(chi2, rank, charge, spread) - terms


def _find_better_kind(evidence: Evidence, o: Outcome) -> str | None:
    """The effect that explains plainly more than all of an outcome's effects, of those that are not searched for and of which one of
    these, or what cannot be told from it, is a special case.
    """
    others = evidence.alternatives()
    names = {x for e in o.effects for x in (e, *others.get(e, ()))}
    # those that are searched for have been compared themselves
    kinds = (e for e in evidence.first.fitted.model.candidates if not e.searched)
    cases = (e.id for e in kinds if not names.isdisjoint((e.id, *e.contains)))
    return next((k for k in cases if evidence.weigh_instead(o, k) > DISTINGUISHABLE), None)


def _find_shared_term(chi2: float, base: Sequence[Remainder]) -> ResidualTerm | None:
    """The generic term, cosine and sine of it, that explains what an effect does, up to what the filter of such terms changes."""
    least = (1.0 - claims.SECOND_ORDER) * chi2
    for s in (s for b in base for s in b.searches if s.steady):
        both = [t.chi2 for t in s.steady[:2] if t.term.words == s.steady[0].term.words]
        if sum(both) >= least:
            return s.steady[0]
    return None
