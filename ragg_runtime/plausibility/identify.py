"""Which mistake a record most likely holds, if any."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ragg_runtime.flight import Flight
from ragg_runtime.flight.record import ANGULAR_ACCELERATION, ANGULAR_RATE
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model
from ragg_runtime.plausibility import other_demodulator
from ragg_runtime.plausibility.mistakes import mistakes
from ragg_runtime.plausibility.quick_fit import Explained, explain, explain_all
from ragg_runtime.plausibility.subsample import Picker
from ragg_runtime.plausibility.timing import searches
from ragg_runtime.signals.derivative import differentiate

SUSPICIOUS = 30.0
"""Residual, Eo, from which mistakes are looked for; missing effects seldom leave as much."""

SURPRISING = 150.0
"""Sum of squares of the parameters' moves, in plausible sizes, from which mistakes are looked for."""

FEW = 400
"""Rows on which all mistakes are tried."""

MOST_TRIED = 24
"""Mistakes that are tried once more, on more rows."""

SURELY = 6
"""Mistakes that are tried once more however they compare."""

NEARLY = 3.0
"""Factor over the least that a mistake undone leaves of the few rows up to which others are tried once more as well: few rows
tell what is left to a tenth or two, and only what is within ``AS_GOOD`` of the least is named."""

BETTER = 5.0
"""Factor by which the residual must fall once a mistake is undone: no missing effect looks like that."""

AS_GOOD = 1.1
"""Factor over the least that any mistake undone leaves within which another explains the record as well: the plainer is named."""

MUCH_CALMER = 30.0
"""Sum of squares of the parameters' moves, in plausible sizes, by which one mistake is more likely than another however plain
that is: the exponent of e^15 in their priors."""

NO_WORSE = 1.05
"""Factor by which the residual may grow where a mistake undone only calms the parameters: rows that are left out differ."""


@dataclass(frozen=True)
class LikelyMistake:
    """A likely mistake.

    Attributes
    ----------
    what, remedy
        In words.
    others
        What would explain the record as well.
    before, after
        What the model leaves of the record as it stands, and with the mistake undone.
    timing
        Whether only motion and output are apart in time.
    """

    what: str
    remedy: str
    others: tuple[str, ...]
    before: Explained
    after: Explained
    timing: bool

    @property
    def factor(self) -> float:
        """By how much the part that the model cannot explain falls."""
        return self.before.share / max(self.after.share, 1e-300)


@dataclass(frozen=True)
class _Tried:
    what: str
    remedy: str
    plainness: int
    left: Explained
    timing: bool = False
    calming: bool = True


def likely_mistake(model: Model, instrument: Instrument, p: Picker) -> LikelyMistake | None:
    """The mistake that explains a record, or ``None`` if it looks as it should (or no mistake explains it)."""
    rows = p.pick(p.rows())
    before = explain(model, instrument, rows)
    if before.rms < SUSPICIOUS and before.surprise < SURPRISING:
        return None
    few = p.pick(p.rows(most=FEW))
    rough = explain(model, instrument, few)
    possible = [*mistakes(rows, instrument.units, p.flight.written, rates_derived=derived_rates(p.flight))]
    screened = explain_all(model, instrument, (m.undo(few) for m in possible))
    promising = [(m, left) for m, left in zip(possible, screened, strict=True) if _explains(rough, left, 0.5)]
    promising = sorted(promising, key=lambda t: (t[1].share, t[1].surprise))[:MOST_TRIED]
    promising = [
        t for k, t in enumerate(promising) if k < SURELY or t[1].share < NEARLY * promising[0][1].share
    ]
    again = explain_all(model, instrument, (m.undo(rows) for m, _ in promising))
    tried = [
        _Tried(m.what, m.remedy, m.plainness, left) for (m, _), left in zip(promising, again, strict=True)
    ]
    tried += [
        _Tried(
            what=s.what, remedy=s.remedy, plainness=s.plainness, left=s.left, timing=s.shift, calming=False
        )
        for s in searches(model, instrument, p)
    ]
    found = _chosen(before, tried)
    if not p.recorded.demodulated or (found is not None and found.factor > BETTER):
        return found
    made = other_demodulator.best(model, instrument, p)  # takes a while: if nothing else would do
    return _chosen(before, [*tried, _otherwise(made)])


def _otherwise(made: other_demodulator.Made) -> _Tried:
    return _Tried(
        what=f"inline and cross were made by another demodulator, such as {made.how.words()}"
        if made.how.kind != "none"
        else f"inline and cross have passed {made.how.words()}",
        remedy=(
            f"if that is so, say it in model.toml or in a mapping: [demodulator] {made.how.toml()};"
            " else record G_out itself"
        ),
        plainness=3,
        left=made.left,
    )


def _chosen(before: Explained, tried: Sequence[_Tried]) -> LikelyMistake | None:
    convincing = [t for t in tried if _explains(before, t.left, calming=t.calming)]
    if not convincing:
        return None
    least = min(t.left.share for t in convincing)
    equal = [t for t in convincing if t.left.share < AS_GOOD * least]
    calm = min(t.left.surprise for t in equal)
    equal = sorted(
        (t for t in equal if t.left.surprise < calm + MUCH_CALMER),
        key=lambda t: t.plainness + t.left.surprise,
    )
    first = equal[0]
    others = tuple(t.what for t in equal[1:3])
    return LikelyMistake(
        what=first.what,
        remedy=first.remedy,
        others=others,
        before=before,
        after=first.left,
        timing=first.timing,
    )


def _explains(before: Explained, after: Explained, factor: float = 1.0, *, calming: bool = True) -> bool:
    if after.share * BETTER * factor < before.share:
        return True
    return (
        calming
        and before.surprise > SURPRISING
        and after.surprise * BETTER * factor < before.surprise
        and after.share * factor < NO_WORSE * before.share
    )


def derived_rates(x: Flight) -> bool:
    """Whether the angular acceleration is the derivative of the rate: then it has the rate's mistakes."""
    if x.written:
        return ANGULAR_ACCELERATION[0] not in x.written
    part = slice(0, min(len(x), 4096))
    for rate, change in zip(ANGULAR_RATE, ANGULAR_ACCELERATION, strict=True):
        if change not in x.channels:
            continue
        found = differentiate(x.channels[rate][part], x.rate)
        there = np.isfinite(found)
        there[:16] = there[-16:] = False
        given = x.channels[change][part]
        if not np.allclose(found[there], given[there], rtol=1e-9, atol=1e-9 * float(np.std(given))):
            return False
    return True
