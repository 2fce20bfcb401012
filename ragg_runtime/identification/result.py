"""The result of a diagnosis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.calibration import list_off_sheet
from ragg_runtime.estimation.fitted import Fitted, list_noise_floor, measure_noise_floor
from ragg_runtime.estimation.scores import Error
from ragg_runtime.identification import formula
from ragg_runtime.identification.dictionary import Term, find_channel_unit
from ragg_runtime.identification.line_rival import Steady
from ragg_runtime.identification.next_motion import Proposal
from ragg_runtime.identification.omnibus import Remainder, ResidualTerm, list_terms
from ragg_runtime.identification.ranking import Detectable, NotTestable, Ranked
from ragg_runtime.identification.search import Outcome
from ragg_runtime.io import Flight
from ragg_runtime.wording import describe
from ragg_runtime.wording.sections import render_notebook

Array = NDArray[np.float64]


def name_verdict(*, claimed: bool, remains: bool) -> str:
    """The verdict where something is ``claimed`` or not, and something significant ``remains`` or not."""
    if remains:
        return "partly-explained" if claimed else "unexplained"
    return "missing-effect" if claimed else "adequate"


@dataclass(frozen=True, repr=False)
class Diagnosis:
    """The result of ``diagnose``: the interface's JSON, and what the report draws."""

    verdict: str
    fitted: Fitted
    ranking: tuple[Ranked, ...]
    found: tuple[str, ...]
    not_testable: tuple[NotTestable, ...]
    remainder: Remainder
    remainder_share: float
    before: Error
    noise: Fitted
    """The fit of the noise floor."""
    sizes: tuple[Detectable, ...]
    outcome: Outcome
    """The fit with all that was chosen, claimed or not."""
    next_motion: tuple[Proposal, ...]
    reasons: tuple[Reason, ...]
    credible_set: tuple[tuple[str, ...], ...]
    change: ChangePoint | None
    """Where the model ceased to hold, if it held in the beginning."""
    groups: tuple[Group, ...]
    disagree: tuple[Disagreement, ...]
    tests: float
    """Number of independent tests that the catalogue is on these flights: times the least p-value it is the family's."""

    @property
    def converged(self) -> bool:
        """Whether the calibration with what was chosen in the model has converged; if not, ``complaint`` has the reason."""
        return self.complaint is None

    @property
    def complaint(self) -> str | None:
        """What speaks against the fit, in words."""
        return self.outcome.complaint

    @property
    def remark(self) -> str | None:
        """What is wrong with the record, or how it is disturbed."""
        return "; ".join(r.text for r in self.reasons if r.kind == "remark") or None

    @property
    def reason(self) -> str | None:
        """In one sentence, why the verdict is not ``adequate``, and what is odd about the record."""
        return "; ".join(r.text for r in self.reasons) or None

    @property
    def remains(self) -> bool:
        """Whether something significant remains besides what is found."""
        return self.verdict in ("unexplained", "partly-explained")

    @cached_property
    def noise_floor(self) -> float:
        """rms of the noise before demodulation, Eo."""
        return measure_noise_floor(self.noise)

    @property
    def after(self) -> Error:
        """Error with the effects chosen (claimed or not) in the model."""
        return self.outcome.scored.whole

    @property
    def final(self) -> Fitted | None:
        """The model with the chosen effects derived into it, if that was done."""
        return None if self.outcome.target is self.fitted else self.outcome.target

    @cached_property
    def residual(self) -> list[Array]:
        """(N,) V of every flight, calibrated, as the model is."""
        return self.fitted.residuals()

    @cached_property
    def residual_after(self) -> list[Array]:
        """(N,) V of every flight, with the effects chosen (claimed or not) in the model."""
        return self.outcome.target.residuals(self.outcome.coefficients)

    def terms(self) -> list[dict[str, object]]:
        """Generic terms in what remains (see :func:`ragg_runtime.identification.omnibus.list_terms`)."""
        return list_terms(self.remainder, self.outcome.scored.mean_square)

    def expression(self) -> str | None:
        """The strongest unexplained term as a line for ``effects`` in model.toml, under a name of one's own."""
        suggestion = self._suggested
        return None if suggestion is None else suggestion[1]

    def needs(self) -> list[str]:
        """Columns, in words, that a flight must have for :meth:`expression`."""
        suggestion = self._suggested
        return [] if suggestion is None else formula.list_effect_columns(suggestion[0])

    @cached_property
    def _suggested(self) -> tuple[Term, str] | None:
        steady = [t for s in self.remainder.searches for t in s.terms if t.kind == "steady"]
        for t in sorted(steady, key=lambda t: -abs(t.z)):
            term = t.term.felt
            unit = self.fitted.instrument.units.divide("m/s^2", map(find_channel_unit, term.channels))
            line = formula.write_effect(term, t.centre, unit)
            if line is not None:
                return term, line
        return None

    def __repr__(self) -> str:
        errors = [("before", self.before.rms_Eo), ("after", self.after.rms_Eo), ("noise", self.noise_floor)]
        text = f"{self.verdict}: {', '.join(self.found)}" if self.found else self.verdict
        return describe.summarize("Diagnosis", text, *errors)

    def _repr_html_(self) -> str:
        return render_notebook(describe.describe_diagnosis(self.as_json()))

    def as_json(self) -> dict[str, object]:
        o = self.outcome.target
        return {
            "verdict": self.verdict,
            "converged": self.converged,
            "reason": self.reason,
            "notes": [r.text for r in self.reasons if r.kind != "verdict"],
            "remark": self.complaint or self.remark,
            "off_sheet": [x.as_json() for x in list_off_sheet(o.model, o.instrument, o.calibration)],
            "ranking": [{"place": n, **r.as_json()} for n, r in enumerate(self.ranking, 1)],
            "tests": self.tests,
            "found": list(self.found),
            "groups": [g.as_json() for g in self.groups],
            "disagree": [x.as_json() for x in self.disagree],
            "not_testable": [asdict(n) for n in self.not_testable],
            "unexplained": {
                "share": self.remainder_share,
                "log10_p": float(self.remainder.log_p / np.log(10.0)),
                "terms": self.terms(),
                "expression": self.expression(),
                "needs": self.needs(),
            },
            "error": {"before": self.before.as_json(), "after": self.after.as_json()},
            "noise_floor": list_noise_floor(self.noise, self.noise_floor),
            "explained": {"share": self.outcome.explained.share},
            "credible_set": [list(s) for s in self.credible_set],
            "holds_until_s": None if self.change is None else self.change.until,
            "holds_until_flight": None if self.change is None else self.change.flight,
            "next_motion": [p.as_json() for p in self.next_motion],
            "detectable": [s.as_json() for s in self.sizes],
        }


@dataclass(frozen=True)
class ChangePoint:
    """Where the model ceased to hold: ``until`` the end of the last block of time in which it held, s of the flight's ``time``."""

    flight: str
    until: float


@dataclass(frozen=True)
class Reason:
    """A part of the reason of a verdict; ``kind``: ``verdict`` only repeats it, as a headline does, ``remark`` is about the record."""

    text: str
    kind: Literal["verdict", "remark", "note"] = "note"


@dataclass(frozen=True)
class Disagreement:
    """Flights that agree, and what these lack: others lack something else, and all together are not ``explained``, as these may be."""

    flights: tuple[str, ...]
    found: tuple[str, ...]
    explained: bool = True

    def as_json(self) -> dict[str, object]:
        return {"flights": list(self.flights), "found": list(self.found), "explained": self.explained}

    def in_words(self) -> str:
        """``lag and something unknown in friday, sunday``."""
        what = [*self.found, *([] if self.explained else ["something unknown"])] or ["nothing"]
        return f"{' and '.join(what)} in {', '.join(self.flights)}"


def describe_disagreement(apart: Sequence[Disagreement]) -> str | None:
    """How flights disagree, in a sentence; ``None`` if they do not."""
    if not apart:
        return None
    names = "; ".join(", ".join(g.flights) for g in apart)
    count = sum(len(g.flights) for g in apart)
    changed = "The instrument, its mounting, an axis or a unit may have changed between them"
    if any(g.found or not g.explained for g in apart):
        each = f"each of the {count} flights is explained separately, but not all together"
        lead = (
            each if all(g.explained for g in apart) else "one set of parameters does not explain all flights"
        )
        findings = "; ".join(g.in_words() for g in apart)
        return f"{lead}: {findings}. {changed}"
    return (
        f"each of the {count} flights is explained separately, but they are inconsistent, and no effect of"
        f" the catalogue explains the difference. Consistent flights: {names}. {changed}. Calibrate each flight to see what"
        " differs; diagnose consistent flights together"
    )


@dataclass(frozen=True)
class Group:
    """Effects that are one finding, the one that would be added first; ``name``: what they share, where only that is observable."""

    effects: tuple[str, ...]
    name: str | None

    def as_json(self) -> dict[str, object]:
        return {"name": self.name, "effects": list(self.effects)}


def group_findings(
    claims: Sequence[str], ranking: Sequence[Ranked], steady: Sequence[Steady], shared: ResidualTerm | None
) -> tuple[Group, ...]:
    """One group of each effect that is found; ``shared``: a generic term that explains as much as the only one."""
    others = {r.effect: r.indistinguishable_from for r in ranking}
    names = {e: shared.term.words for e in claims if shared and others.get(e)}
    names |= {s.effect: s.name for s in steady}
    return tuple(Group(effects=(e, *others.get(e, ())), name=names.get(e)) for e in claims)


def heed_flags(d: Diagnosis, flights: Sequence[Flight]) -> Diagnosis:
    """The diagnosis of flights with what is wrong with them, their flags, as its reason.

    Nothing is claimed of a record that holds something odd, but effects that describe just that; of one with noisy motion no noise that
    follows the motion, as what smoothing leaves of the sensors' noise does so, too. Of one at rest, which the model explains, the
    reason says how little that means.
    """
    flags = [(x, f) for x in flights for f in x.flags if f.open or f.kind]
    # an output that exceeds stationary noise, where motion was not recorded, is not explained
    unknown = bool(d.reasons) and any(f.kind == "still" for _, f in flags)
    several = len(flights) > 1
    noted = tuple(Reason(f"{x.name}: {f.reason}" if several else f.reason) for x, f in flags)
    if not flags or (d.verdict == "adequate" and not unknown):
        little = [r for r, (_, f) in zip(noted, flags, strict=True) if f.kind == "still"]
        return replace(d, reasons=(*little, *d.reasons)) if little else d
    if any(f.kind == "motion-noise" for _, f in flags):
        kinds = {e.id: e.kind for e in d.fitted.model.candidates}
        d = _claim_only(d, [e for e in d.found if kinds.get(e) != "random"])
    odd = [f for _, f in flags if f.open]
    described = [e for e in d.found if all(e in f.effects for f in odd)]
    if not odd or (described and len(described) == len(d.found)):
        return replace(d, reasons=(*noted, *d.reasons))
    reasons = [*noted]
    if others := [e for e in d.found if e not in described]:
        reasons.append(Reason(f"{', '.join(others)} would explain it, but such a record cannot confirm it"))
    reasons += [r for r in d.reasons if r.kind != "verdict"]
    verdict = name_verdict(claimed=bool(described), remains=True)
    return replace(_claim_only(d, described), verdict=verdict, reasons=tuple(reasons))


def _claim_only(d: Diagnosis, kept: Sequence[str]) -> Diagnosis:
    """The diagnosis without the other effects."""
    if list(d.found) == list(kept):
        return d
    groups = tuple(g for g in d.groups if g.effects[0] in kept)
    verdict = name_verdict(claimed=bool(kept), remains=d.remains)
    return replace(d, verdict=verdict, found=tuple(kept), groups=groups)
