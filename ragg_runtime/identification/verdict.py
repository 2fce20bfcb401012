"""The verdict: what is claimed of what the search has found, what remains, and why, in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import expit

from ragg_runtime.identification import claims, comparison, omnibus, selection, strong
from ragg_runtime.identification.claims import Significance
from ragg_runtime.identification.likelihood_ratio import Test
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
    share: float = 1.0
    rival: bool = False
    one: str | None = None
    shared: ResidualTerm | None = None

    @property
    def remains(self) -> bool:
        return self.verdict in ("unexplained", "partly-explained")

    @staticmethod
    def of(found: Evidence, output: Sequence[str], *, apart: bool) -> Conclusion:
        """Judge what the search has found; ``output``: what the recorder did."""
        chosen, line, steady = _without_lines(found)
        count = found.first.field.count + len(chosen.random)
        base = omnibus.search_residuals(found.first.fitted) if chosen.effects else []
        before = _Lead.of(found, chosen, count, base)
        outcome, weak = (chosen, []) if apart else _drop_unfounded(found, chosen)
        one = _find_common_kind(found, outcome.effects)
        lead = before if outcome is chosen else _Lead.of(found, outcome, count, base)
        claimed = _choose_claims(outcome, lead, base)
        while not (claimed or one or outcome.remains) and len(outcome.effects) > 1:
            # generic terms do as well as all of these, but perhaps not as well as those without the weakest
            weakest, less = _drop_weakest(found, outcome)
            if less.remains:
                break
            outcome, weak = less, [*weak, weakest]
            lead = _Lead.of(found, outcome, count, base)
            claimed = _choose_claims(outcome, lead, base)
        one = one or (_find_better_kind(found, outcome) if claimed else None)
        left = outcome.remainder if line is None else line.within(outcome.remainder)
        random = _list_random(outcome, count)
        doubted = apart or outcome.explained.complaint is not None
        claimed = () if doubted or one is not None else claimed
        # noise that follows the motion grows with the motion: a random effect models just that
        exceeds = outcome.exceeds_noise and not random
        remains = line is not None or left.significant or outcome.complaint is not None or exceeds
        rival = lead is not None and not claimed and not remains
        if lead is not None and rival:  # generic terms do as well as what was chosen: they are what is left
            _, left = claims.weigh_generic_terms(base, np.inf, lead.rank)
        remains = remains or rival or doubted
        if not remains:
            claimed = (*claimed, *random[:1])
        if not doubted:  # what the recorder did is certain, whatever else is in the record
            claimed = (*claimed, *output)
        alone = lead is not None and len(claimed) == 1 and claimed == outcome.effects
        return Conclusion(
            verdict=name_verdict(claimed=bool(claimed), remains=remains),
            claims=claimed,
            outcome=outcome,
            left=left,
            line=line,
            steady=tuple(s for s in steady if s.effect in claimed),
            open=_list_unsure(found.last, weak, claimed),
            share=1.0 if before is None else float(expit(before.ahead)),
            rival=rival,
            one=None if claimed else one,
            shared=_find_shared_term(lead.chi2, base) if lead is not None and alone else None,
        )

    def remarks(self, apart: str | None, spent: bool) -> list[str]:
        """What is wrong with the record, or what else than the effects found would do, or how the record is disturbed."""
        doubt = apart or self.outcome.explained.complaint
        if doubt is not None:
            return [doubt]
        disturbed = comparison.describe_disturbance(self.outcome.target)
        said = [] if self.line is None else [self.line.words]
        said += [s.words for s in self.steady]
        said += [f"the search stopped after {strong.FITS} fits"] if spent and self.remains else []
        return [*said, *([] if disturbed is None else [disturbed])]

    def reasons(self, apart: str | None, spent: bool) -> list[Reason]:
        """Why the verdict is not ``adequate``, and what is odd about the record."""
        remarks = [Reason(text) for text in self.remarks(apart, spent)]
        if self.verdict == "adequate" or apart or self.outcome.explained.complaint:
            return remarks
        found = []
        if self.claims:
            sure = "is certain" if len(self.claims) == 1 else "are certain"
            how = sure if self.remains else "is missing" if len(self.claims) == 1 else "are missing"
            found.append(Reason(f"{join_names(self.claims)} {how}", is_verdict=True))
        if self.remains:
            found += self._left()
        if self.open:
            names = join_names(self.open[:3], "or")
            found.append(Reason(f"the record is not sufficient to decide whether {names} is also present"))
        return [*found, *remarks]

    def _left(self) -> list[Reason]:
        """What remains, in words."""
        o = self.outcome
        terms = [f"{t.term.harmonic} x {t.term.product}" for x in self.left.searches for t in x.terms]
        if self.one:
            cases = f"{join_names(o.effects)} would explain it, but {self.one} may explain it better"
            return [Reason(f"{cases}: add {self.one} and compare")]
        if self.rival:
            generic = f"a generic term, {terms[0]}" if terms else "generic terms"
            return [Reason(f"{join_names(o.effects)} would explain it no better than {generic}")]
        found = [] if o.complaint is None else [Reason(o.complaint)]
        if terms:
            found.append(
                Reason(f"the residual is more than noise, mostly {terms[0]}", is_verdict=True),
            )
        noise = "the residual is more than noise by all generic terms together, none of which stands out"
        if o.exceeds_noise:
            rms = o.scored.whole.rms_Eo
            noise = f"the residual, {rms:.3g} Eo, is more than the noise of {o.noise_floor:.3g} Eo"
        return found or [Reason(noise, is_verdict=True)]


OPEN = 0.1
"""p-value from which an effect is named as one for which the record does not suffice."""


def _without_lines(found: Evidence) -> tuple[Outcome, LineAlternative | None, tuple[Steady, ...]]:
    """The outcome without the effects in whose place a line near a multiple of the spin rate does as well; that line, and those effects
    that are no more than a line at the multiple.
    """
    outcome = found.outcome
    line, steady = find_line_rival(found.steps, found.last)
    if line is None or not line.better(outcome.remainder):
        return outcome, None, steady
    for e in line.effects:
        outcome = found.without(outcome, e) if e in outcome.effects else outcome
    return outcome, line, steady


def _list_random(o: Outcome, count: int) -> list[str]:
    """The random effects that are significant next to the noise model, whose level has shapes of its own, the surest first."""
    tests = ((t, e) for e, t in o.random.items() if selection.is_significant(t, count, selection.FURTHER))
    return [e for _, e in sorted((t.log_p, e) for t, e in tests)]


def _drop_unfounded(found: Evidence, o: Outcome) -> tuple[Outcome, list[str]]:
    """The outcome without the effects that are not significant beside the others, and these, in the order in which they went."""
    weak: list[str] = []
    needed: list[str] = []
    while True:
        e = _find_weakest(found, o, needed)
        if e is not None and not (o.widened and e in found.log_p) and _is_needed(found, o, e):
            needed.append(e)
            continue
        e = e or _find_contradicted(o, found.first) or _find_unfitted(found, o)
        if e is None:
            return o, weak
        weak.append(e)
        needed = []  # beside that effect
        o = found.without(o, e)


def _list_unsure(last: Stage, weak: Sequence[str], claimed: Sequence[str]) -> tuple[str, ...]:
    """Effects that the record speaks for, but not surely enough: those that went, and others beside what the last stage chose."""
    beside = last.choice.conditional
    near = sorted((t.log_p, e) for e, t in beside.items() if t.rank and t.log_p < np.log(OPEN))
    return tuple(dict.fromkeys(e for e in (*weak, *(e for _, e in near)) if e not in claimed))


def _find_weakest(found: Evidence, o: Outcome, needed: Sequence[str]) -> str | None:
    """The effect that is not significant with the variance of its own scores, the least significant of several.

    Those of the last stage were tested beside the sheet as it was then. If it proves less sure, each competes with one still less sure.
    """
    log_p, asked = found.log_p, [e for e in o.effects if e not in needed]
    p = {
        e: _log_p_by_fit(found, o, e)
        if o.widened and e in log_p
        else _log_p(o, o.significance(e), log_p.get(e))
        for e in asked
    }
    weakest = max(p, key=lambda e: (p[e], e), default=None)
    return None if weakest is None or _is_significant(found, o, p[weakest]) else weakest


def _drop_weakest(found: Evidence, o: Outcome) -> tuple[str, Outcome]:
    """The least significant effect, and the outcome without it."""
    p = {e: _log_p(o, o.significance(e), found.log_p.get(e)) for e in o.effects}
    weakest = max(p, key=lambda e: (p[e], e))
    return weakest, found.without(o, weakest)


def _log_p(o: Outcome, s: Significance, log_p: float | None) -> float:
    """Of an effect; 0 if it does not explain plainly more than the best generic term does of what is left."""
    left = claims.find_strongest(o.remainder) if o.remainder.significant else None
    if left is not None and s.chi2 - s.rank < claims.MORE * left.z**2:
        return 0.0
    return s.log_p(log_p, doubted=o.remainder.significant)


def _is_significant(found: Evidence, o: Outcome, log_p: float) -> bool:
    level = selection.FAMILY if len(o.effects) == 1 else selection.FURTHER
    return found.first.field.significant(Test(0.0, 1, log_p, ()), level)


def _is_needed(found: Evidence, o: Outcome, effect: str) -> bool:
    """Whether an effect is significant by the fit without it: far from there a linearisation may be wrong about what it explains."""
    return _is_significant(found, o, _log_p_by_fit(found, o, effect))


def _log_p_by_fit(found: Evidence, o: Outcome, effect: str) -> float:
    """Of an effect, by the fit without it."""
    by_fit = replace(o.significance(effect), chi2=max(0.0, found.gain(o, effect)))
    return max(_log_p(o, by_fit, None), by_fit.log_p(None, doubted=True))


def _find_contradicted(o: Outcome, first: Stage) -> str | None:
    """The effect that held-out blocks of time speak against most, if plainly; the instant of a step is from all of the record."""
    instants = {e.id for e in first.fitted.model.candidates if e.kind == "step"}
    speaks = {e: claims.weigh_held_out(o.robust.regression, e) for e in o.effects if e not in instants}
    worst = min(speaks, key=lambda e: (speaks[e], e), default=None)
    return worst if worst is not None and speaks[worst] < -claims.PLAINLY else None


def _find_unfitted(found: Evidence, o: Outcome) -> str | None:
    """The least significant effect of a fit that has not converged."""
    log_p = {} if o.complaint is None else {e: found.test(e).log_p for e in o.effects}
    return max(log_p, key=lambda e: (log_p[e], e), default=None)


@dataclass(frozen=True)
class _Lead:
    """What an outcome's effects explain, a chi-square with ``rank`` coefficients, and the log evidence by which they are ahead of generic
    terms.
    """

    chi2: float
    rank: int
    ahead: float

    @staticmethod
    def of(found: Evidence, o: Outcome, count: int, base: Sequence[Remainder]) -> _Lead | None:
        """Against the terms of the searches ``base``; ``None`` without effects. ``count``: of how many they were chosen."""
        if not o.effects:
            return None
        chi2, rank = found.explained(o)
        return _Lead(chi2, rank, _compare_with_terms(found, o, chi2, rank, count, base))


def _choose_claims(o: Outcome, lead: _Lead | None, base: Sequence[Remainder]) -> tuple[str, ...]:
    """What of an outcome's effects may be claimed (``claims``)."""
    if lead is None:
        return ()
    if o.remains:
        more = lead.chi2 - lead.rank > claims.MORE * claims.find_best_single(base)
        return o.effects if more and lead.ahead > claims.PLAINLY else ()
    # between an effect that leaves only noise and generic terms that do as well, the effect, known to occur, is taken
    least = -claims.PLAINLY if len(o.effects) == 1 else 0.0
    return o.effects if lead.ahead > least else ()


def _find_common_kind(found: Evidence, effects: Sequence[str]) -> str | None:
    """The effect of which several of these, or what cannot be told from them, are special cases: of a resonance its low frequencies."""
    return next((k for k, cases in _count_cases(found, effects).items() if cases > 1), None)


def _find_better_kind(found: Evidence, o: Outcome) -> str | None:
    """The effect of which one of an outcome's effects is a special case, and which explains plainly more than all of them."""
    kinds = (k for k, cases in _count_cases(found, o.effects).items() if cases)
    return next((k for k in kinds if found.weigh_instead(o, k) > claims.PLAINLY), None)


def _count_cases(found: Evidence, effects: Sequence[str]) -> dict[str, int]:
    """How many of the effects, or what cannot be told from them, are special cases of each that is not searched for."""
    others = found.alternatives()
    groups = [{e, *others.get(e, ())} for e in effects]
    # those that are searched for have been compared themselves
    kinds = {e.id: {e.id, *e.contains} for e in found.first.fitted.model.candidates if not e.searched}
    return {k: sum(bool(own & g) for g in groups) for k, own in kinds.items()}


def _find_shared_term(chi2: float, base: Sequence[Remainder]) -> ResidualTerm | None:
    """The generic term, cosine and sine of it, that explains what an effect does, up to what the filter of such terms changes."""
    enough = (1.0 - claims.SECOND_ORDER) * chi2
    for s in (s for b in base for s in b.searches if s.steady):
        both = [t.chi2 for t in s.steady[:2] if t.term.words == s.steady[0].term.words]
        if sum(both) >= enough:
            return s.steady[0]
    return None


def _compare_with_terms(
    found: Evidence, o: Outcome, chi2: float, rank: int, count: int, base: Sequence[Remainder]
) -> float:
    """Log evidence by which an outcome's effects are ahead of the best generic terms of as many coefficients."""
    spread = max(claims.measure_spread(o.remainder), o.target.calibration.excess) if o.remains else 1.0
    # with a cap, if nothing remains: no terms explain more than all
    terms, _ = claims.weigh_generic_terms(base, np.inf if o.remains else chi2, rank, spread)
    if not o.remains and len(o.effects) > 1:
        terms = max(terms, _weigh_strong_term(found, chi2, base))
    charge = len(o.effects) * float(np.log(count)) + found.charge(o)
    return claims.weigh_claims(chi2, rank, charge, spread) - terms


def _weigh_strong_term(found: Evidence, chi2: float, base: Sequence[Remainder]) -> float:
    """Log evidence of the strongest generic term, if a linear fit is too rough for it, with the model fitted again beside it."""
    (s, *more) = base[0].searches
    if more or not s.steady or s.steady[0].chi2 < strong.STRONG:
        return -np.inf
    left = claims.fit_beside(found.first.fitted, s.steady[0])
    if left is None:
        return -np.inf
    explained = found.first.field.chi2 - left
    return claims.weigh_claims(min(explained, chi2 + 1.0), 1, float(np.log(s.tried)))
