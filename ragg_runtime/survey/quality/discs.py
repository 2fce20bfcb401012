"""Which channels belong together: the discs (or complements) of an instrument, and combinations without gravity in them.

The industry counts in UV and NE: UV = (Gamma_xx - Gamma_yy)/2, half of this project's inline, and NE = Gamma_xy,
its cross. Noise of a disc is the same in both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.record import Array
from ragg_runtime.survey.quality.lines import SurveyLine


@dataclass(frozen=True)
class Discs:
    """The discs of a survey, by the endings of their channels' names, and how they stand to each other.

    ``complements`` measure the same twice (two sets of accelerometers on one disc, as in Falcon), so that their
    difference is noise; ``orthogonal`` axes of three discs make the sum of the inline channels the trace of the
    gradient, which is zero (as in FTG).
    """

    names: tuple[str, ...]
    arrangement: str


@dataclass(frozen=True)
class Combination:
    """A combination of channels that holds no gravity: its name and (N,) Eo."""

    name: str
    values: Array


def discs_of(lines: Sequence[SurveyLine], arrangement: str | None = None) -> Discs:
    """The discs that all lines have; two are taken for complements and three for orthogonal, unless it is said."""
    common = set.intersection(*(set(x.gradients) for x in lines))
    endings = [n.partition("_")[2] for n in lines[0].gradients if n in common and not n.startswith("Gamma")]
    names = tuple(dict.fromkeys(endings))
    inline = tuple(e for e in names if channel("inline", e) in common)
    if arrangement is None:
        arrangement = {2: "complements", 3: "orthogonal"}.get(len(inline), "single")
    needed = {"complements": 2, "orthogonal": 3}.get(arrangement)
    if needed is not None and len(inline) != needed:
        raise UserError(
            f"the arrangement {arrangement!r} needs {needed} discs",
            found=f"{len(inline)}: {', '.join(sorted(common)) or 'no gradients that all lines have'}",
            expected="channels such as inline_A, cross_A, inline_B, cross_B",
        )
    return Discs(names if arrangement == "single" else inline, arrangement)


def channel(kind: str, disc: str) -> str:
    return f"{kind}_{disc}" if disc else kind


def uv(line: SurveyLine, disc: str) -> Array:
    """(N,) Eo: (Gamma_xx - Gamma_yy)/2 of a disc."""
    return line.channels[channel("inline", disc)] / 2.0


def ne(line: SurveyLine, disc: str) -> Array:
    """(N,) Eo: Gamma_xy of a disc."""
    return line.channels[channel("cross", disc)]


def combinations(line: SurveyLine, discs: Discs) -> list[Combination]:
    """What holds no gravity: the in-line sum, or half the differences of the complements (noise of their mean)."""
    if discs.arrangement == "orthogonal":
        total = np.sum([uv(line, d) for d in discs.names], axis=0) / np.sqrt(3.0)
        return [Combination("in-line sum", total)]
    if discs.arrangement == "complements":
        a, b = discs.names
        found = [Combination("difference UV", (uv(line, a) - uv(line, b)) / 2.0)]
        if crossed(line, discs):
            found.append(Combination("difference NE", (ne(line, a) - ne(line, b)) / 2.0))
        return found
    return []


def crossed(line: SurveyLine, discs: Discs) -> bool:
    """Whether every disc has its cross channel."""
    return all(channel("cross", d) in line.channels for d in discs.names)
