"""What screening found about the records, in the verdict: a note and a verdict never contradict each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io import Flight


def heed_flags(d: Diagnosis, flights: Sequence[Flight]) -> Diagnosis:
    """The diagnosis with what is still wrong with the records as its reason.

    Parameters
    ----------
    d
        What the records say, taken as they are.
    flights
        The same records, with their flags.

    Returns
    -------
    Diagnosis
        Nothing is claimed of a record that holds something odd, but effects that describe just that.
    """
    flags = [(x, f) for x in flights for f in x.flags if f.open]
    if not flags or d.verdict == "adequate":
        return d
    several = len(flights) > 1
    reasons = [f"{x.name}: {f.reason}" if several else f.reason for x, f in flags]
    said = "; ".join([*reasons, *([] if d.reason is None else [d.reason])])
    if d.found and all(set(d.found) <= set(f.effects) for _, f in flags):
        return replace(d, reason=said)
    return replace(d, verdict="unexplained", found=(), groups=(), reason=said)
