"""Which mistake a record most likely holds, if any."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations, permutations, product

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.units import Units
from ragg_runtime.io import Flight
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import differentiated
from ragg_runtime.screening import other_demodulator
from ragg_runtime.screening.quick_fit import Explained, explain, explain_all
from ragg_runtime.screening.subsample import Picker, Rows
from ragg_runtime.screening.timing import searches
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
    origin
        Whether the disc angle counts from elsewhere.
    """

    what: str
    remedy: str
    others: tuple[str, ...]
    before: Explained
    after: Explained
    timing: bool
    origin: bool = False

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
    origin: bool = False


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
            what=s.what,
            remedy=s.remedy,
            plainness=s.plainness,
            left=s.left,
            timing=s.shift,
            calming=s.origin,
            origin=s.origin,
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
        origin=first.origin,
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


Array = NDArray[np.float64]

AXES = "xyz"


@dataclass(frozen=True)
class Mistake:
    """One possible mistake.

    Attributes
    ----------
    what
        The mistake as a likely statement about the record: "a_x and a_y are exchanged".
    remedy
        What to do.
    undo
        Rows as they stand -> rows without the mistake.
    plainness
        Among mistakes that explain a record equally well the smallest is named first.
    """

    what: str
    remedy: str
    undo: Callable[[Rows], Rows]
    plainness: int = 0


def mistakes(
    rows: Rows, units_: Units, written: Mapping[str, str], *, rates_derived: bool
) -> Iterator[Mistake]:
    """Every mistake of units, signs, axes and order that such rows may hold.

    Parameters
    ----------
    rows
        The record.
    units_, written
        Units with the model's g0; the unit that the file gives to each column (none: SI).
    rates_derived
        Whether the angular acceleration was derived from the rate, so that both share its mistakes.
    """
    yield from _outputs(rows, units_, written)
    yield from _units_of_a(units_, written)
    yield from _units_of_omega(units_, written, rates_derived)
    if rows.gradient_recorded:
        yield from _gradients()
    yield from _axes(rates_derived)


def _scaled(names: tuple[str, ...], factor: float) -> Callable[[Rows], Rows]:
    def undo(rows: Rows) -> Rows:
        changed = {n: factor * x for n, x in rows.channels.items() if _stem(n) in names}
        return replace(rows, channels={**rows.channels, **changed})

    return undo


def _stem(name: str) -> str:
    """``a`` of ``a_x`` and of its time derivative ``d_a_x``."""
    return differentiated(name).rsplit("_", 1)[0]


def _outputs(rows: Rows, units_: Units, written: Mapping[str, str]) -> Iterator[Mistake]:
    what = f"{rows.names[0]} ... {rows.names[-1]}" if rows.recorded.separate else " and ".join(rows.names)

    def scaled(factor: float) -> Callable[[Rows], Rows]:
        return lambda r: replace(r, data=factor * r.data)

    if rows.recorded.demodulated:
        yield from _definitions()
        for factor, unit, given in ((1e-9, "Eo", "s^-2"), (1e9, "s^-2", "Eo")):
            yield Mistake(
                f"{what} are in {unit}, not in {given} as the header says",
                f"write the unit [{unit}]",
                scaled(factor),
            )
        yield Mistake(
            "inline and cross are exchanged",
            "exchange their names",
            lambda r: replace(r, data=np.stack([-r.data[1] / 2, -2 * r.data[0]])),
            1,
        )
        return
    yield Mistake(f"the sign of {what} is reversed", f"multiply {what} by -1", scaled(-1.0), 0)
    given = written.get(rows.names[0], "V")
    for unit, factor in _meant(units_, given, ("V", "mV", "uV", "kV")):
        yield Mistake(
            f"{what} {'are' if rows.recorded.separate else 'is'} in {unit}, not in {given}",
            f"write the unit [{unit}]",
            scaled(factor),
        )
    if not rows.recorded.separate:
        return
    for order in _orders(len(rows.names)):
        swapped = [k for k, was in enumerate(order) if was != k]
        if len(swapped) == 2:
            i, j = (rows.names[k] for k in swapped)
            text = f"{i} and {j} are exchanged"
        else:
            text = f"the order of {', '.join(rows.names)} is {', '.join(rows.names[k] for k in order)}"
        yield Mistake(
            text,
            "exchange the names of the columns",
            _reordered(order),
            len(swapped),
        )


DEFINED = (1.0, -1.0, 2.0, -2.0, 0.5, -0.5)
"""Factors by which people define the channels otherwise: (Gamma_xx - Gamma_yy)/2, Gamma_yy - Gamma_xx, 2 Gamma_xy, ..."""


def _definitions() -> Iterator[Mistake]:
    """Inline and cross with other signs or factors than Gamma_xx - Gamma_yy and Gamma_xy."""
    for inline, cross in product(DEFINED, DEFINED):
        changed = [(n, x) for n, x in (("inline", inline), ("cross", cross)) if x != 1.0]
        if not changed:
            continue
        if inline == cross == -1.0:
            what, remedy = "the sign of inline and cross is reversed", "multiply inline and cross by -1"
        else:
            what = "; ".join(_defined(n, x) for n, x in changed)
            remedy = ", ".join(f"multiply {n} by {x:g}" for n, x in changed)
        factors = np.array([[inline], [cross]])
        yield Mistake(what, remedy, partial(_each, factors=factors), 2 * len(changed) - 2 * (inline == cross))


def _defined(name: str, undo: float) -> str:
    """In words, what a channel is if so many times it is what it should be."""
    component = {"inline": "Gamma_xx - Gamma_yy", "cross": "Gamma_xy"}[name]
    size = {1.0: "", 2.0: "half of ", 0.5: "twice "}[abs(undo)]
    if not size:
        return f"the sign of {name} is reversed"
    return f"{name} is {'minus ' if undo < 0 else ''}{size}{component}"


def _each(rows: Rows, factors: Array) -> Rows:
    return replace(rows, data=factors * rows.data)


def _orders(count: int) -> Iterator[tuple[int, ...]]:
    """Orders in which voltages may stand by mistake: any of up to four, of more those with two exchanged."""
    straight = tuple(range(count))
    if count <= 4:
        yield from (order for order in permutations(straight) if order != straight)
        return
    for i, j in combinations(straight, 2):
        order = list(straight)
        order[i], order[j] = j, i
        yield tuple(order)


def _reordered(order: tuple[int, ...]) -> Callable[[Rows], Rows]:
    return lambda rows: replace(rows, data=rows.data[list(order)])


def _meant(units_: Units, given: str, possible: Sequence[str]) -> list[tuple[str, float]]:
    """(unit, factor): what may be meant instead of ``given``, and by how much the numbers then change."""
    found: list[tuple[str, float]] = []
    here = float(units_.to_si(1.0, given, possible[0]))
    for unit in possible:
        factor = float(units_.to_si(1.0, unit, possible[0])) / here
        if abs(factor - 1) > 1e-9 and not any(abs(factor / f - 1) < 1e-9 for _, f in found):
            found.append((unit, factor))
    return found


def _units_of_a(units_: Units, written: Mapping[str, str]) -> Iterator[Mistake]:
    given = written.get("a_x", "m/s^2")
    for unit, factor in _meant(units_, given, ("m/s^2", "g", "mg", "mGal")):
        yield Mistake(
            f"a_x, a_y, a_z are in {unit}, not in {given}",
            f"write the unit [{unit}]",
            _scaled(("a",), factor),
        )


def _units_of_omega(units_: Units, written: Mapping[str, str], rates_derived: bool) -> Iterator[Mistake]:
    both, rate, change = ("omega", "omegadot"), ("omega",), ("omegadot",)
    given = written.get("omega_x", "rad/s")
    for unit, factor in _meant(units_, given, ("rad/s", "deg/s", "deg/h", "mrad/s", "urad/s")):
        text = f"omega_x, omega_y, omega_z are in {unit}, not in {given}"
        write = f"write the unit [{unit}]"
        yield Mistake(text, write, _scaled(both if rates_derived else rate, factor))
        if not rates_derived:
            yield Mistake(
                f"{text}, and omegadot likewise", f"{write}, and that of omegadot", _scaled(both, factor), 1
            )
    if rates_derived:
        return
    given = written.get("omegadot_x", "rad/s^2")
    for unit, factor in _meant(units_, given, ("rad/s^2", "deg/s^2", "deg/h/s", "deg/h^2")):
        yield Mistake(
            f"omegadot_x, omegadot_y, omegadot_z are in {unit}, not in {given}",
            f"write the unit [{unit}]",
            _scaled(change, factor),
        )


def _gradients() -> Iterator[Mistake]:
    for factor, text, remedy in (
        (-1.0, "the sign of Gamma is reversed", "multiply Gamma by -1: f = a + ... - Gamma r"),
        (1e-9, "Gamma is in Eo, not in s^-2", "write the unit [Eo]"),
        (1e9, "Gamma is in s^-2, not in Eo", "write the unit [s^-2]"),
    ):
        yield Mistake(text, remedy, _scaled(("Gamma",), factor))


def _axes(rates_derived: bool) -> Iterator[Mistake]:
    groups: tuple[tuple[tuple[str, ...], int], ...] = (
        (("a",), 0),
        (("omega", "omegadot"), 0),
        (("a", "omega", "omegadot"), 1),
    )
    if not rates_derived:
        groups = (*groups, (("omega",), 1))
    for group, more in groups:
        for order, signs in product(permutations(range(3)), product((1, -1), repeat=3)):
            if order == (0, 1, 2) and signs == (1, 1, 1):
                continue
            moved = sum(order[k] != k for k in range(3))
            flips = sum(s < 0 for s in signs)
            yield Mistake(
                _axes_told(group, order, signs),
                "exchange the names of the columns or the signs, or turn the record into the measurement frame",
                partial(_turned, group=group, order=order, signs=signs),
                2 * moved + 2 * flips + more,
            )


def _axes_told(group: tuple[str, ...], order: tuple[int, ...], signs: tuple[int, ...]) -> str:
    """In words: which columns hold which component."""
    said = []
    for q in group:
        if q == "omegadot":
            continue
        own = [f"{q}_{k}" for k in AXES]
        flipped = [own[k] for k in range(3) if signs[k] < 0]
        if order == (0, 1, 2):
            said.append(f"{' and '.join(flipped)} {'have' if len(flipped) > 1 else 'has'} the wrong sign")
        elif not flipped and sum(order[k] != k for k in range(3)) == 2:
            i, j = (own[k] for k in range(3) if order[k] != k)
            said.append(f"{i} and {j} are exchanged")
        else:
            found = [f"{'-' if s < 0 else ''}{own[k]}" for k, s in zip(order, signs, strict=True)]
            said.append(f"{', '.join(own)} stand in the columns {', '.join(found)}")
    return "; ".join(said)


def _turned(rows: Rows, group: tuple[str, ...], order: tuple[int, ...], signs: tuple[int, ...]) -> Rows:
    changed: dict[str, Array] = {}
    for prefix in ("", "d_", "d2_"):
        for q in group:
            own = [f"{prefix}{q}_{k}" for k in AXES]
            if all(n in rows.channels for n in own):
                changed |= {own[k]: signs[k] * rows.channels[own[order[k]]] for k in range(3)}
    return replace(rows, channels={**rows.channels, **changed})
