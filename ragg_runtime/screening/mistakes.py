"""What may be wrong with a record that does not fit: hypotheses of unit, sign, axis, clock and sheet, compared by one score."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations, permutations, product

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.regressors import list_base_columns
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.instrument.units import Units
from ragg_runtime.io.record import ANGULAR_ACCELERATION
from ragg_runtime.model.evaluate import make_vector
from ragg_runtime.model.model import Model
from ragg_runtime.screening import other_demodulator, timing
from ragg_runtime.screening.linear_fit import INDEPENDENT, RARE, Hypothesis, LinearFit, fit_rows
from ragg_runtime.screening.sampler import Rows, Sampler, find_stem

Array = NDArray[np.float64]

SUSPICIOUS = 30.0
"""Residual, Eo, from which mistakes are looked for; missing effects seldom leave as much."""

SURPRISING = 150.0
"""Sum of squares of the parameters' moves, in plausible sizes, from which mistakes are looked for."""

FEW, MOST_TRIED = 400, 24
"""Rows on which all mistakes of unit, sign and axis are tried, and how many of the best are tried on more."""

LARGE = 0.2
"""Share of the output that the model leaves from which a record may be two: effects, a step of the gain too, leave a hundredth."""

NAMED = INDEPENDENT * float(np.log(5.0))
"""Gain in log evidence from which a hypothesis is named: a residual five times smaller. No missing effect looks like that."""

AS_GOOD = INDEPENDENT * float(np.log(1.1))
"""Difference in log evidence within which another hypothesis explains the record as well: what the choice of rows makes."""

WIDE, WIDE_K1 = 10.0, 100.0
"""Times the usual errors of a test sheet that a sheet may be off; scale factors, of another range or instrument, by 10 %. A third
and three times as much give the same answers (docs/contributors/decisions.md)."""


@dataclass(frozen=True)
class Finding:
    """The hypothesis that explains a record best, ``others`` that do as well, and the model of the record as it is."""

    best: Hypothesis
    others: tuple[str, ...]
    before: LinearFit

    @property
    def factor(self) -> float:
        """By how much the part that the model cannot explain falls."""
        return self.before.share / max(self.best.fitted.share, 1e-300)


def find_mistake(model: Model, instrument: Instrument, s: Sampler) -> Finding | None:
    """The hypothesis that explains a record, or ``None`` if it looks as it should (or none explains it).

    Parameters
    ----------
    model, instrument
        What the record is compared with.
    s : Sampler
        The record.
    """
    rows = s.take(s.rows())
    before = fit_rows(model, instrument, rows)
    if before.rms < SUSPICIOUS and before.surprise < SURPRISING and before.kept > 1.0 - RARE:
        return None
    tried = [*_sheets(model, instrument, rows), *_wrong(model, instrument, s, rows)]
    tried += timing.propose_times(model, instrument, s)
    if before.share > LARGE and not s.recorded.demodulated:
        tried += timing.propose_parts(model, instrument, s)
    found = _chosen(before, tried)
    if not s.recorded.demodulated or (found is not None and found.factor > 5.0):
        return found
    made = other_demodulator.propose_demodulator(
        model, instrument, s
    )  # takes a while: if nothing else would do
    return _chosen(before, [*tried, made])


def _chosen(before: LinearFit, tried: Sequence[Hypothesis]) -> Finding | None:
    """The best hypothesis that is clearly better than the record as it is and than a model that predicts nothing.

    A record is not taken to be wrong where wider priors explain it as it is.
    """
    sheets = [h.fitted.score for h in tried if h.kind == "sheet"]
    stands = min(before.score, 0.0) - NAMED
    limit = min([stands, *(score - AS_GOOD for score in sheets)])
    order = sorted(((h.score(before), h) for h in tried), key=lambda x: x[0])
    order = [(score, h) for score, h in order if score <= (stands if h.kind == "sheet" else limit)]
    if not order:
        return None
    least, best = order[0]
    near = [h.what for score, h in order[1:] if score < least + AS_GOOD and h.kind != "sheet"]
    return Finding(best, tuple(near[:2]), before)


# --- a sheet with priors that are too narrow ------------------------------------------------------------


def _sheets(model: Model, instrument: Instrument, rows: Rows) -> Iterator[Hypothesis]:
    """Sheets that are less sure of the scale factors, of everything, or of both."""
    every = {q.name: WIDE for q in PARAMETERS}
    for factors in ({"K1": WIDE_K1}, every, {**every, "K1": WIDE_K1}):
        widths = {
            q.name: max(1.0, factors[q.name] * float(np.median(usual / instrument.sigma(q.name))))
            for q in PARAMETERS
            if q.name in factors
            for usual in [q.plausible_si(instrument.accelerometers[q.name], instrument.g0)]
        }
        wider = replace(instrument, widths={**instrument.widths, **widths})
        fitted = fit_rows(model, wider, rows)
        yield Hypothesis(
            what=f"the test sheet is too confident: {_farthest(model, instrument, fitted)}",
            remedy="check it, or give the parameter a larger sigma in model.toml",
            fitted=fitted,
            kind="sheet",
            calming=len(factors) == 1,  # effects move angles and biases, but no scale factor by so much
        )


def _farthest(model: Model, instrument: Instrument, fitted: LinearFit) -> str:
    """The parameters that lie farthest from their sheet, in its sigmas: both values of up to three."""
    sheet = make_vector(model, instrument)
    off = [((fitted.p[k] - sheet[k]) / c.scale, c, k) for c, k in list_base_columns(model, instrument)]
    off = sorted((x for x in off if x[1].effect is None), key=lambda x: -abs(x[0]))
    worst = [x for x in off[:3] if abs(x[0]) > abs(off[0][0]) / 10]
    return ", ".join(
        f"{c.name} of {c.accelerometer_name} is {fitted.p[k] / c.unit_factor:.6g} instead of"
        f" {sheet[k] / c.unit_factor:.6g} +- {c.scale / c.unit_factor:.2g} {c.unit}"
        for _, c, k in worst
    )


# --- mistakes of unit, sign and axis -------------------------------------------------------------------


@dataclass(frozen=True)
class ColumnMistake:
    """One possible mistake: in words, what to do, and rows as they are -> rows without it.

    ``plainness``: of mistakes that explain a record equally well the smallest is named first.
    """

    what: str
    remedy: str
    undo: Callable[[Rows], Rows]
    plainness: int = 0


def _wrong(model: Model, instrument: Instrument, s: Sampler, rows: Rows) -> list[Hypothesis]:
    """The most promising mistakes of unit, sign and axis."""
    few = s.take(s.rows(most=FEW))
    possible = list(
        list_mistakes(
            rows,
            instrument.units,
            s.flight.written,
            derived=ANGULAR_ACCELERATION[0] not in (s.flight.written or s.flight.channels),
        )
    )
    rough = [fit_rows(model, instrument, m.undo(few)) for m in possible]
    order = sorted(range(len(possible)), key=lambda k: rough[k].score + possible[k].plainness / 2)
    best = [possible[k] for k in order[:MOST_TRIED] if rough[k].score < rough[order[0]].score + NAMED]
    return [
        Hypothesis(m.what, m.remedy, fit_rows(model, instrument, m.undo(rows)), m.plainness / 2) for m in best
    ]


def list_mistakes(
    rows: Rows, known: Units, written: Mapping[str, str], *, derived: bool
) -> Iterator[ColumnMistake]:
    """Every mistake of units, signs, axes and order that such rows may hold.

    Parameters
    ----------
    rows
        The record.
    known, written
        Units with the model's g0; the unit that the file gives to each column (none: SI).
    derived
        Whether the angular acceleration was derived from the rate, so that both share its mistakes.
    """
    yield from _demodulated(rows) if rows.recorded.demodulated else _outputs(rows, known, written)
    yield from _units_of_motion(known, written, derived)
    if rows.gradient_recorded:
        undo = _scaled(("Gamma",), -1.0)
        yield ColumnMistake(
            "the sign of Gamma is reversed", "multiply Gamma by -1: f = a + ... - Gamma r", undo
        )
        yield _in_unit("Gamma", "Eo", "s^-2", _scaled(("Gamma",), 1e-9))
        yield _in_unit("Gamma", "s^-2", "Eo", _scaled(("Gamma",), 1e9))
    yield from _axes(derived)


def _in_unit(
    what: str, unit: str, given: str, undo: Callable[[Rows], Rows], plainness: int = 0
) -> ColumnMistake:
    verb = "are" if "," in what or " and " in what or "..." in what else "is"
    return ColumnMistake(
        f"{what} {verb} in {unit}, not in {given}", f"write the unit [{unit}]", undo, plainness
    )


def _scaled(stems: tuple[str, ...], factor: float) -> Callable[[Rows], Rows]:
    def undo(rows: Rows) -> Rows:
        changed = {n: factor * x for n, x in rows.channels.items() if find_stem(n) in stems}
        return replace(rows, channels={**rows.channels, **changed})

    return undo


def _output_scaled(factors: float | Array) -> Callable[[Rows], Rows]:
    return lambda rows: replace(rows, data=factors * rows.data)


def _outputs(rows: Rows, known: Units, written: Mapping[str, str]) -> Iterator[ColumnMistake]:
    what = f"{rows.names[0]} ... {rows.names[-1]}" if rows.recorded.separate else " and ".join(rows.names)
    yield ColumnMistake(f"the sign of {what} is reversed", f"multiply {what} by -1", _output_scaled(-1.0))
    given = written.get(rows.names[0], "V")
    for unit, factor in _meant(known, given, ("V", "mV", "uV", "kV")):
        yield _in_unit(what, unit, given, _output_scaled(factor))
    if not rows.recorded.separate:
        return
    for order in _orders(len(rows.names)):
        swapped = [k for k, was in enumerate(order) if was != k]
        text = f"the order of {', '.join(rows.names)} is {', '.join(rows.names[k] for k in order)}"
        if len(swapped) == 2:
            text = f"{rows.names[swapped[0]]} and {rows.names[swapped[1]]} are exchanged"
        yield ColumnMistake(
            text, "exchange the names of the columns", partial(_reordered, order=order), len(swapped)
        )


def _reordered(rows: Rows, order: tuple[int, ...]) -> Rows:
    return replace(rows, data=rows.data[list(order)])


def _orders(count: int) -> Iterator[tuple[int, ...]]:
    """Orders in which voltages may be listed by mistake: any of up to four, of more those with two exchanged."""
    straight = tuple(range(count))
    if count <= 4:
        yield from (order for order in permutations(straight) if order != straight)
        return
    for i, j in combinations(straight, 2):
        order = list(straight)
        order[i], order[j] = j, i
        yield tuple(order)


DEFINED = (1.0, -1.0, 2.0, -2.0, 0.5, -0.5)
"""Factors by which people define the channels otherwise: (Gamma_xx - Gamma_yy)/2, Gamma_yy - Gamma_xx, 2 Gamma_xy, ..."""


def _demodulated(rows: Rows) -> Iterator[ColumnMistake]:
    """Inline and cross with other units, names, signs or factors than Gamma_xx - Gamma_yy and Gamma_xy."""
    for factor, unit, given in ((1e-9, "Eo", "s^-2"), (1e9, "s^-2", "Eo")):
        yield _in_unit("inline and cross", unit, given, _output_scaled(factor))
    yield ColumnMistake(
        "inline and cross are exchanged",
        "exchange their names",
        lambda r: replace(r, data=np.stack([-r.data[1] / 2, -2 * r.data[0]])),
        1,
    )
    for factors in product(DEFINED, DEFINED):
        changed = [(n, x) for n, x in zip(("inline", "cross"), factors, strict=True) if x != 1.0]
        undo = _output_scaled(np.array(factors)[:, None])
        if factors == (-1.0, -1.0):
            yield ColumnMistake(
                "the sign of inline and cross is reversed", "multiply inline and cross by -1", undo, 2
            )
        elif changed:
            remedy = ", ".join(f"multiply {n} by {x:g}" for n, x in changed)
            yield ColumnMistake("; ".join(_defined(n, x) for n, x in changed), remedy, undo, 2 * len(changed))


def _defined(name: str, undo: float) -> str:
    """In words, what a channel is if so many times it is what it should be."""
    component = {"inline": "Gamma_xx - Gamma_yy", "cross": "Gamma_xy"}[name]
    size = {1.0: "", 2.0: "half of ", 0.5: "twice "}[abs(undo)]
    if not size:
        return f"the sign of {name} is reversed"
    return f"{name} is {'minus ' if undo < 0 else ''}{size}{component}"


def _meant(known: Units, given: str, possible: Sequence[str]) -> list[tuple[str, float]]:
    """(unit, factor): what may be meant instead of ``given``, and by how much the numbers then change."""
    found: list[tuple[str, float]] = []
    here = float(known.to_si(1.0, given, possible[0]))
    for unit in possible:
        factor = float(known.to_si(1.0, unit, possible[0])) / here
        if abs(factor - 1) > 1e-9 and not any(abs(factor / f - 1) < 1e-9 for _, f in found):
            found.append((unit, factor))
    return found


_MOTION_UNITS = {
    "a": ("m/s^2", "g", "mg", "mGal"),
    "omega": ("rad/s", "deg/s", "deg/h", "mrad/s", "urad/s"),
    "omegadot": ("rad/s^2", "deg/s^2", "deg/h/s", "deg/h^2"),
}
"""Quantities of motion and the units in which they may be, SI first."""


def _units_of_motion(known: Units, written: Mapping[str, str], derived: bool) -> Iterator[ColumnMistake]:
    both = ("omega", "omegadot")
    for stem, units in _MOTION_UNITS.items():
        if stem == "omegadot" and derived:
            continue
        columns, given = ", ".join(f"{stem}_{k}" for k in "xyz"), written.get(f"{stem}_x", units[0])
        for unit, factor in _meant(known, given, units):
            undone = both if stem == "omega" and derived else (stem,)
            yield _in_unit(columns, unit, given, _scaled(undone, factor))
            if stem == "omega" and not derived:
                one = _in_unit(columns, unit, given, _scaled(both, factor), 1)
                what, remedy = f"{one.what}, and omegadot likewise", f"{one.remedy}, and that of omegadot"
                yield replace(one, what=what, remedy=remedy)


def _axes(derived: bool) -> Iterator[ColumnMistake]:
    both: tuple[str, ...] = ("omega", "omegadot")
    groups = [(("a",), 0), (both, 0), (("a", *both), 1), *([] if derived else [(("omega",), 1)])]
    for (group, more), order, signs in product(groups, permutations(range(3)), product((1, -1), repeat=3)):
        if order == (0, 1, 2) and signs == (1, 1, 1):
            continue
        moved, flips = sum(order[k] != k for k in range(3)), sum(s < 0 for s in signs)
        yield ColumnMistake(
            "; ".join(_axes_in_words(q, order, signs) for q in group if q != "omegadot"),
            "exchange the names of the columns or the signs, or rotate the record into the measurement frame",
            partial(_turned, group=group, order=order, signs=signs),
            2 * moved + 2 * flips + more,
        )


def _axes_in_words(stem: str, order: tuple[int, ...], signs: tuple[int, ...]) -> str:
    """Which columns hold which component."""
    own = [f"{stem}_{k}" for k in "xyz"]
    flipped = [own[k] for k in range(3) if signs[k] < 0]
    moved = [own[k] for k in range(3) if order[k] != k]
    if not moved:
        return f"{' and '.join(flipped)} {'have' if len(flipped) > 1 else 'has'} the wrong sign"
    if not flipped and len(moved) == 2:
        return f"{moved[0]} and {moved[1]} are exchanged"
    found = [f"{'-' if s < 0 else ''}{own[k]}" for k, s in zip(order, signs, strict=True)]
    return f"{', '.join(own)} are in the columns {', '.join(found)}"


def _turned(rows: Rows, group: tuple[str, ...], order: tuple[int, ...], signs: tuple[int, ...]) -> Rows:
    changed: dict[str, Array] = {}
    for prefix, q in product(("", "d_", "d2_"), group):
        own = [f"{prefix}{q}_{k}" for k in "xyz"]
        if all(n in rows.channels for n in own):
            changed |= {own[k]: signs[k] * rows.channels[own[order[k]]] for k in range(3)}
    return replace(rows, channels={**rows.channels, **changed})
