"""What screening found about the records, in the verdict: a note and a verdict never contradict each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ragg_runtime.identification.result import Diagnosis, Reason, name_verdict
from ragg_runtime.io import Flight


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
    others = [e for e in d.found if e not in described]
    would = (
        (Reason(f"{', '.join(others)} would explain it, but such a record cannot confirm it"),)
        if others
        else ()
    )
    reasons = (*noted, *would, *(r for r in d.reasons if r.kind != "verdict"))
    verdict = name_verdict(claimed=bool(described), remains=True)
    return replace(_claim_only(d, described), verdict=verdict, reasons=reasons)


def _claim_only(d: Diagnosis, kept: Sequence[str]) -> Diagnosis:
    """The diagnosis without the other effects."""
    if list(d.found) == list(kept):
        return d
    groups = tuple(g for g in d.groups if g.effects[0] in kept)
    verdict = name_verdict(claimed=bool(kept), remains=d.remains)
    return replace(d, verdict=verdict, found=tuple(kept), groups=groups)
