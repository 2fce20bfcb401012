"""What screening found about the records, in the verdict: a note and a verdict never contradict each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ragg_runtime.identification.result import Diagnosis, Reason, name_verdict
from ragg_runtime.io import Flight


def heed_flags(d: Diagnosis, flights: Sequence[Flight]) -> Diagnosis:
    """The diagnosis with what is wrong with the records as its reason.

    Parameters
    ----------
    d
        The verdict of the records as they are.
    flights
        The same records, with their flags.

    Returns
    -------
    Diagnosis
        Nothing is claimed of a record that holds something odd, but effects that describe just that; of one with noisy motion no
        noise that follows the motion, as what smoothing leaves of the sensors' noise does so, too. Of one at rest, which the model
        explains, the reason says how little that means.
    """
    flags = [(x, f) for x in flights for f in x.flags if f.open or f.kind == "motion-noise"]
    # an output that exceeds stationary noise, where motion was not recorded, is not explained
    unknown = bool(d.reasons) and any(f.kind == "still" for _, f in flags)
    several = len(flights) > 1
    noted = tuple(Reason(f"{x.name}: {f.reason}" if several else f.reason) for x, f in flags)
    if not flags or (d.verdict == "adequate" and not unknown):
        little = [r for r, (_, f) in zip(noted, flags, strict=True) if f.kind == "still"]
        return replace(d, reasons=(*little, *d.reasons)) if little else d
    if any(f.kind == "motion-noise" for _, f in flags):
        d = _drop_random(d)
    odd = [f for _, f in flags if f.open]
    if not odd or (d.found and all(set(d.found) <= set(f.effects) for f in odd)):
        return replace(d, reasons=(*noted, *d.reasons))
    would = (
        (Reason(f"{', '.join(d.found)} would explain it, but such a record cannot confirm it"),)
        if d.found
        else ()
    )
    reasons = (*noted, *would, *(r for r in d.reasons if not r.is_verdict))
    return replace(d, verdict="unexplained", found=(), groups=(), reasons=reasons)


def _drop_random(d: Diagnosis) -> Diagnosis:
    """The diagnosis without random effects."""
    kinds = {e.id: e.kind for e in d.target.model.candidates}
    kept = tuple(e for e in d.found if kinds.get(e) != "random")
    if kept == d.found:
        return d
    groups = tuple(g for g in d.groups if g.effects[0] in kept)
    return replace(d, verdict=name_verdict(claimed=bool(kept), remains=d.remains), found=kept, groups=groups)
