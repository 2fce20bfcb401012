"""Whether a line in the record explains as much as an effect that was chosen: then the effect is not named."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeGuard

import numpy as np

from ragg_runtime.base import false_alarms
from ragg_runtime.diagnosis.strong import Stage, Taken
from ragg_runtime.evidence import selection
from ragg_runtime.fit.fitted import Fitted
from ragg_runtime.fit.significance import INDISTINGUISHABLE
from ragg_runtime.lack_of_fit import near_lines
from ragg_runtime.lack_of_fit.dictionary import Term
from ragg_runtime.lack_of_fit.near_lines import NearLine
from ragg_runtime.lack_of_fit.omnibus import Found
from ragg_runtime.lack_of_fit.remainder import Remainder

SLIP = 6.6
"""Chi-square by which a line must be off the multiple: what keeps step with the disc is taken for the disc's, and seems as far
off it in one of a hundred (one degree of freedom)."""


CONSTANT = 0.99
"""Share of what an effect explains that a sinusoid at the very multiple must explain for it to be called a constant term; the
rest is its couplings to the motion, which a strong one shows."""


@dataclass(frozen=True)
class LineRival:
    """A line that explains as much as an effect.

    Attributes
    ----------
    line, effect
        Which, in the place of which.
    own
        Chi-square that the effect explains beside the others that are chosen.
    """

    line: NearLine
    effect: str
    own: float

    @property
    def words(self) -> str:
        return (
            f"the output has a line at about {self.line.frequency:.5g} Hz, beside a multiple of the spin rate: it explains as much"
            f" as {self.effect} would, so that none is named"
        )

    def better(self, rem: Remainder) -> bool:
        """Whether it also explains as much as the effect does together with the best generic term in a remainder."""
        if not rem.significant:
            return True
        best = max((t.z**2 for s in rem.searches for t in s.terms), default=0.0)
        return self.line.chi2 - self.own > best - INDISTINGUISHABLE

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
        )
        first, *others = rem.searches
        log_p = min(first.log_p, self.line.log_p)
        return Remainder((replace(first, log_p=log_p, terms=(found,), chi2=chi2), *others))


@dataclass(frozen=True)
class Steady:
    """An effect of which the record shows no more than a constant term: a sinusoid at a multiple of the spin rate.

    Attributes
    ----------
    effect, others
        Its id, and the effects that would do as well.
    turns, frequency
        Multiple of the spin rate, and that in Hz.
    width
        How far off it a line may be that explains as much (3 sigma), Hz; ``None``: none does.
    """

    effect: str
    others: tuple[str, ...]
    turns: int
    frequency: float
    width: float | None

    @property
    def name(self) -> str:
        """What it is called."""
        times = {1: "the spin rate", 2: "twice the spin rate"}.get(
            self.turns, f"{self.turns} times the spin rate"
        )
        return f"constant term at {times}"

    @property
    def words(self) -> str:
        others = f", by {', '.join(self.others)} as well" if self.others else ""
        said = f"what {self.effect} explains is a {self.name}{others}"
        if self.width is None:
            return said
        return f"{said}; a line within {self.width:.1g} Hz of {self.frequency:.6g} Hz would do too"


def line_rival(steps: Sequence[Taken], last: Stage) -> tuple[LineRival | None, tuple[Steady, ...]]:
    """The first of the effects chosen, the strong ones before the others, in whose place a line beside a multiple of the spin
    rate would do as well; and those that are no more than a line at one.
    """
    steady = []
    for t in steps:
        line = near_lines.best(t.before, ())
        if _in_place(line, t.test.chi2):
            return LineRival(line=line, effect=t.effect, own=t.test.chi2), ()
        steady += _steady(t.before, line, t.effect, t.test.chi2, t.rivals)
    field, choice = last.field, last.choice
    rivals = selection.rivals(field, choice)
    for e in choice.chosen:
        others = [o for o in choice.chosen if o != e]
        beside = field.joint([choice.blocks[o] for o in others])[0] if others else 0.0
        line = near_lines.best(last.fitted, [n for o in others for n, _ in field.candidates[o]])
        if _in_place(line, choice.chi2 - beside):
            return LineRival(line=line, effect=e, own=choice.chi2 - beside), ()
        steady += _steady(last.fitted, line, e, choice.chi2 - beside, rivals[e])
    return None, tuple(steady)


def _in_place(line: NearLine | None, chi2: float) -> TypeGuard[NearLine]:
    """Whether a line, plainly off the multiple, explains as much."""
    return (
        line is not None
        and line.slip >= SLIP
        and line.chi2 >= chi2 - INDISTINGUISHABLE
        and line.log_p <= np.log(false_alarms.REMAINDER)
    )


def _steady(
    f: Fitted, line: NearLine | None, effect: str, chi2: float, others: Sequence[str]
) -> list[Steady]:
    """The effect, if a line at the very multiple explains as much, or all but a small part."""
    if line is None or line.chi2 - line.slip < min(chi2 - INDISTINGUISHABLE, CONSTANT * chi2):
        return []
    as_much = line.chi2 - line.slip >= chi2 - INDISTINGUISHABLE
    r = f.prepared[0].observation.record
    turns = round(line.frequency / r.spin_frequency)
    # Cramer-Rao: 12 over the square of duration and of signal to noise, rad/s (Rife and Boorstyn, IEEE Trans. IT 20, 1974)
    width = 3.0 * float(np.sqrt(12.0 / line.chi2)) / (2 * np.pi * float(r.time[-1] - r.time[0]))
    return [
        Steady(
            effect=effect,
            others=tuple(others),
            turns=turns,
            frequency=turns * r.spin_frequency,
            width=width if as_much else None,
        )
    ]
