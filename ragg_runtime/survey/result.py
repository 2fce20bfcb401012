"""The result of a survey."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from ragg_runtime.survey import summary
from ragg_runtime.survey.summary import Advice, Summary
from ragg_runtime.survey.task import Record
from ragg_runtime.wording import notebook
from ragg_runtime.wording.numbers import clean


@dataclass(frozen=True, repr=False)
class Survey:
    """The result: one record per flight, in the order of the flights' names, and their summary.

    ``records`` are JSON: ``flight``, ``file`` and either ``error`` (``kind``, ``message``) or what
    :func:`ragg_runtime.survey.task.examine` tells of a flight.
    """

    records: tuple[Record, ...]

    @property
    def done(self) -> tuple[Record, ...]:
        """Records of the flights that could be diagnosed."""
        return tuple(r for r in self.records if "verdict" in r)

    @property
    def failed(self) -> tuple[Record, ...]:
        """Records of the others."""
        return tuple(r for r in self.records if "verdict" not in r)

    @cached_property
    def summary(self) -> Summary:
        return summary.summarised(self.records)

    def __repr__(self) -> str:
        return f"<Survey: {counted(self.summary.counts)}>"

    def _repr_html_(self) -> str:
        return notebook.survey(self.records, counted(self.summary.counts), recommended(self, "MODEL_DIR"))

    def as_json(self) -> dict[str, object]:
        return {**self.summary.as_json(), "flights": list(self.records)}


_VERDICTS = {
    "adequate": "adequate",
    "missing-effect": "missing an effect",
    "unexplained": "unexplained",
    "error": "in error",
}


def counted(counts: Mapping[str, int]) -> str:
    """The verdicts in one line: ``12 flights: 8 adequate, 4 missing an effect``."""
    total = sum(counts.values())
    said = ", ".join(f"{counts[k]} {text}" for k, text in _VERDICTS.items() if counts[k])
    return f"{total} flight{'' if total == 1 else 's'}: {said}"


def recommended(s: Survey, model_dir: Path | str) -> list[str]:
    """What to do next, in sentences."""
    x = s.summary
    lines = []
    for a in x.advice:
        if a.firm:
            lines.append(f"recommended: {advised(a, len(s.done))}")
    chance = [a for a in x.advice if not a.firm]
    if chance:
        names = ", ".join(f"{a.effect} ({len(a.flights)})" for a in chance)
        lines.append(f"in so few flights that it may be chance: {names}")
    firm = [a for a in x.advice if a.firm]
    if firm:
        files = [_place(r) for r in s.done if r["flight"] in firm[0].flights]
        more = " ..." if len(files) > 3 else ""
        lines.append(f"next: ragg add {model_dir} {firm[0].effect} {' '.join(files[:3])}{more}")
    elif not x.advice and s.done and not x.counts["unexplained"]:
        lines.append("The model is adequate for every flight that was diagnosed.")
    if x.counts["unexplained"]:
        lines.append(
            f"{x.counts['unexplained']} flight(s) show something that no known effect explains: ragg diagnose them"
        )
    if not s.done:
        lines.append("No flight could be diagnosed.")
    return lines


def advised(a: Advice, done: int) -> str:
    """An advice in one sentence."""
    other = f" (or {', '.join(a.alternatives)}: these flights cannot tell)" if a.alternatives else ""
    return f"add {a.effect}, which {len(a.flights)} of {done} flights ask for{other}"


def _place(r: Mapping[str, Any]) -> str:
    """Where a flight is, from here if it is below, as a shell wants it."""
    path = Path(r["file"])
    below = path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path
    return shlex.quote(clean(str(below)))
