"""Limits as the industry uses them, each with its source; every one can be set on the command line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ragg_runtime.base.errors import UserError, did_you_mean


@dataclass(frozen=True)
class Limit:
    """The largest value that a figure of a line may have."""

    name: str
    value: float
    unit: str
    what: str
    source: str


GIVEN = "given with --limit"
"""Source of a limit that is the user's own."""

LIMITS = (
    Limit(
        name="in-line-sum",
        value=17.0,
        unit="Eo",
        what="standard deviation of the in-line sum of a line, raw, three discs",
        source="galileoQC 1.0.16, ilsNoiseAnalysis (noiseSpec); the figure: Murphy, Recent developments with Air-FTG, "
        "Airborne Gravity 2010, p. 142",
    ),
    Limit(
        name="difference-noise",
        value=5.0,
        unit="Eo",
        what="half the standard deviation of the difference of complements, mean of UV and NE",
        source="galileoQC 1.0.16, diffNoiseVturb (error_spec); the figure: Dransfield and Christensen, Performance of "
        "airborne gravity gradiometers, The Leading Edge 32(8), 2013, p. 908",
    ),
    Limit(
        name="high-frequency-orthogonal",
        value=50.0,
        unit="Eo",
        what="largest rolling standard deviation (50 samples) above 0.1 Hz, raw channels of three discs",
        source="galileoQC 1.0.16, tutorial on FTG noise; why: Sunderland et al., Rev. Sci. Instrum. 93(6), 2022",
    ),
    Limit(
        name="high-frequency-complements",
        value=15.0,
        unit="Eo",
        what="largest rolling standard deviation (50 samples) above 0.15 Hz, complements or a single disc",
        source="galileoQC 1.0.16, tutorial on Falcon noise; why: Sunderland et al., Rev. Sci. Instrum. 93(6), 2022",
    ),
    Limit(
        name="vertical-acceleration",
        value=1.0,
        unit="m/s^2",
        what="standard deviation of the vertical acceleration of a line",
        source="galileoQC 1.0.16, checkVertAccStats (100 milli-g)",
    ),
    Limit(
        name="lag",
        value=1.0,
        unit="s",
        what="shift in time between complements",
        source="galileoQC 1.0.16, checkPhase (tolerance)",
    ),
    Limit(
        name="frobenius",
        value=30.0,
        unit="Eo",
        what="standard deviation of the tensor's Frobenius norm above 0.1 Hz, three discs",
        source="galileoQC 1.0.16, checkFrobenius (noiselimit)",
    ),
)


def limits_with(texts: Sequence[str]) -> dict[str, Limit]:
    """The limits by name, some replaced by texts such as ``in-line-sum=12``."""
    found = {x.name: x for x in LIMITS}
    for text in texts:
        name, _, size = text.partition("=")
        try:
            value = float(size)
        except ValueError:
            value = float("nan")
        if name not in found or not 0 < value < float("inf"):
            raise UserError(
                "the limit cannot be read",
                where="--limit",
                found=repr(text),
                expected="NAME=NUMBER, the number above zero, the name one of " + ", ".join(found),
                remedy=None if name in found else did_you_mean(name, found),
            )
        found[name] = replace(found[name], value=value, source=GIVEN)
    return found
