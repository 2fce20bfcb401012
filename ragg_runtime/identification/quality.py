"""What screening found about the records, in the verdict: a note and a verdict never contradict each other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import false_alarms
from ragg_runtime.identification import claims
from ragg_runtime.identification.ranking import Ranked
from ragg_runtime.identification.result import Diagnosis, Reason, name_verdict
from ragg_runtime.io import Flight
from ragg_runtime.screening.repeated import derive_acceleration

FEIGNED = 1.0 / 3.0
"""Share of the standard deviations of what is found, or remains, that the noise must feign for that to be no more. Measured on flights
without effects, where it should be 1: 0.43 to 1.1, as what is feigned differs with what else is in the model."""


def heed_flags(
    d: Diagnosis, flights: Sequence[Flight], again: Callable[[Sequence[Flight]], Diagnosis]
) -> Diagnosis:
    """The diagnosis with what is wrong with the records as its reason.

    Parameters
    ----------
    d
        The verdict of the records as they are.
    flights
        The same records, with their flags.
    again
        Diagnoses other flights.

    Returns
    -------
    Diagnosis
        Nothing is claimed of a record that holds something odd, but effects that describe just that; nor what the
        noise of motion sensors feigns.
    """
    d = _without_imitations(d, flights, again)
    flags = [(x, f) for x in flights for f in x.flags if f.open or f.kind == "motion-noise"]
    # an output that exceeds stationary noise, where motion was not recorded, is not explained
    unknown = bool(d.reasons) and any(f.kind == "still" for _, f in flags)
    if not flags or (d.verdict == "adequate" and not unknown):
        return d
    several = len(flights) > 1
    noted = tuple(Reason(f"{x.name}: {f.reason}" if several else f.reason) for x, f in flags)
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


def _without_imitations(
    d: Diagnosis, flights: Sequence[Flight], again: Callable[[Sequence[Flight]], Diagnosis]
) -> Diagnosis:
    """The diagnosis without effects that the noise of motion sensors feigns.

    A filter or a delay correlates with the errors of the measured motion (errors in variables: W. Fuller, Measurement Error Models,
    1987). What that feigns is found by doing it again (J. Cook, L. Stefanski, J. Am. Stat. Assoc. 89, 1994, 1314): flights whose output
    is what the calibrated model makes of the recorded motion are diagnosed with motion that is off by as much once more. An
    effect that is significant there, and nearly as strong, is not claimed.
    """
    noisy = sorted({n for x in flights for n in x.motion_noise})
    if not noisy or d.verdict == "adequate" or len(d.residual) != len(flights):
        return d
    imitated = again([_measured_again(x, e) for x, e in zip(flights, d.residual, strict=True)])
    level = np.log(false_alarms.CATALOGUE)
    made = {r.effect: r for r in imitated.ranking if r.log_p < level}
    found = [r for r in d.ranking if r.effect in d.found]
    alike = [r.effect for r in found if _is_as_strong(made.get(r.effect), r) or _smooths_motion(d, r.effect)]
    if alike:  # what is significant only next to them is no longer significant
        alike += [r.effect for r in found if r.effect not in alike and r.log_p >= level]
    kept = tuple(e for e in d.found if e not in alike)
    term = _imitated_term(d, imitated) if d.remains else None
    if not alike and term is None:
        return d
    what = [*alike, *([] if term is None else [f"the residual (mostly {term})"])]
    are = "is" if len(what) == 1 else "are"
    said = f"{', '.join(what)} {are} no more than the noise of {', '.join(noisy)} can imitate"
    verdict = name_verdict(claimed=bool(kept), remains=d.remains and term is None)
    groups = tuple(g for g in d.groups if g.effects[0] in kept)
    return replace(d, verdict=verdict, found=kept, groups=groups, reasons=(Reason(said),))


def _imitated_term(d: Diagnosis, imitated: Diagnosis) -> str | None:
    """The strongest generic term that remains, if flights without any effect show something as strong, under whatever name."""
    remaining = claims.strongest(d.remainder)
    if remaining is None:
        return None
    made = claims.strongest(imitated.remainder)
    strengths = [0.0 if made is None else abs(made.z), *(float(np.sqrt(r.chi2)) for r in imitated.ranking)]
    if max(strengths) < FEIGNED * abs(remaining.z):
        return None
    return f"{remaining.term.harmonic} x {remaining.term.product}"


def _measured_again(x: Flight, residual: NDArray[np.float64]) -> Flight:
    """A flight whose output follows the recorded motion exactly, measured with sensors as noisy as its own."""
    rng = np.random.default_rng(0)
    name, G = next(iter((n, v) for n, v in x.outputs.items() if not n.startswith("V_")))
    moved = {n: x.channels[n] + std * rng.standard_normal(len(x)) for n, std in x.motion_noise.items()}
    changed = replace(x, channels={**x.channels, **moved}, outputs={name: G - residual}, flags=())
    return derive_acceleration(changed) if any(n.startswith("omega_") for n in moved) else changed


def _is_as_strong(made: Ranked | None, found: Ranked) -> bool:
    """Whether what was made without an effect explains as much by it as was found."""
    return made is not None and made.chi2 > FEIGNED**2 * found.chi2


def _smooths_motion(d: Diagnosis, effect: str) -> bool:
    """Whether an effect passes the motion through a resonance: the best prediction from noisy motion is a smoothed one."""
    e = d.target.model.effect(effect)
    return e is not None and e.memory == "mount"
