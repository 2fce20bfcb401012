"""Whether a line in the record explains as much as an effect that was chosen: then the effect is not named."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ragg_runtime.base import false_alarms
from ragg_runtime.diagnosis.strong import Stage, Taken
from ragg_runtime.evidence import selection
from ragg_runtime.fit.fitted import Fitted
from ragg_runtime.lack_of_fit import near_lines
from ragg_runtime.lack_of_fit.dictionary import Term
from ragg_runtime.lack_of_fit.near_lines import NearLine
from ragg_runtime.lack_of_fit.omnibus import Found
from ragg_runtime.lack_of_fit.remainder import Remainder

SLIP = 6.6
"""Chi-square by which a line must be off the multiple: what keeps step with the disc is taken for the disc's, and seems as far
off it in one of a hundred (one degree of freedom)."""


@dataclass(frozen=True)
class LineRival:
    """A line that explains as much as an effect.

    Attributes
    ----------
    line, effect
        Which, in the place of which.
    own, beside
        Chi-square that the effect explains beside the others that are chosen, and what these do.
    """

    line: NearLine
    effect: str
    own: float
    beside: float

    @property
    def words(self) -> str:
        return (
            f"the output has a line at about {self.line.frequency:.5g} Hz, beside a multiple of the spin rate: it explains as much"
            f" as {self.effect} would, so that none is named"
        )

    def better(self, rem: Remainder, alone: bool) -> bool:
        """Whether it also explains as much as the effect does together with the best generic term in a remainder; or as
        that term ``alone``, in the place of all that was chosen.
        """
        if not rem.significant:
            return True
        best = max((t.z**2 for s in rem.searches for t in s.terms), default=0.0)
        gain = self.line.chi2 + self.beside if alone else self.line.chi2 - self.own
        return gain > best - selection.INDISTINGUISHABLE

    def within(self, rem: Remainder) -> Remainder:
        """A remainder in which this line is what is left."""
        chi2 = self.line.chi2
        found = Found(
            term=Term(f"line {self.line.frequency:.5g} Hz", ()),
            coefficient=self.line.amplitude,
            std=self.line.amplitude / float(np.sqrt(max(chi2, 1.0))),
            z=float(np.sqrt(chi2)),
            chi2=chi2,
            mean_square=self.line.amplitude**2 / 2,
            kind="line",
        )
        first, *others = rem.searches
        log_p = min(first.log_p, self.line.log_p)
        return Remainder((replace(first, log_p=log_p, terms=(found,), chi2=chi2), *others))


def line_rival(steps: Sequence[Taken], last: Stage) -> LineRival | None:
    """The first of the effects chosen, the strong ones before the others, in whose place a line would do as well."""
    for t in steps:
        if (line := _in_place(t.before, (), t.test.chi2)) is not None:
            return LineRival(line=line, effect=t.effect, own=t.test.chi2, beside=0.0)
    field, choice = last.field, last.choice
    for e in choice.chosen:
        others = [o for o in choice.chosen if o != e]
        beside = field.joint([choice.blocks[o] for o in others])[0] if others else 0.0
        given = [n for o in others for n, _ in field.candidates[o]]
        if (line := _in_place(last.fitted, given, choice.chi2 - beside)) is not None:
            return LineRival(line=line, effect=e, own=choice.chi2 - beside, beside=beside)
    return None


def _in_place(f: Fitted, given: Sequence[int], chi2: float) -> NearLine | None:
    line = near_lines.best(f, given)
    if line is None or line.slip < SLIP or line.chi2 < chi2 - selection.INDISTINGUISHABLE:
        return None
    if line.log_p > np.log(false_alarms.REMAINDER):
        return None
    return line
