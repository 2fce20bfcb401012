"""What may be wrong with a record that does not fit: hypotheses of unit, sign, axis, clock and sheet, compared by one score."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations, permutations, product

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.regressors import list_base_columns
from ragg_runtime.instrument.instrument import PARAMETERS
from ragg_runtime.io.record import ANGULAR_ACCELERATION
from ragg_runtime.model.model import make_vector
from ragg_runtime.screening import timing
from ragg_runtime.screening.linear_fit import (
    INDEPENDENT,
    RARE,
    Hypothesis,
    LinearFit,
    Rows,
    Sampler,
    compute_residual,
    find_stem,
    fit_rows,
)
from ragg_runtime.signals.derivative import runs

Array = NDArray[np.float64]

SUSPICIOUS = 30.0  # residual, Eo, from which mistakes are looked for; missing effects seldom leave as much
# sum of squares of the parameters' moves, in plausible sizes, from which mistakes are looked for
SURPRISING = 150.0
# rows on which all mistakes of unit, sign and axis are tried, and how many of the best are tried on more
FEW, MOST_TRIED = 400, 24
# parts of a record of which one, at least, has no mistake if another part has one
PIECES = 6
# gain in log evidence from which a hypothesis is named: a residual five times smaller. No missing effect looks like that.
NAMED = INDEPENDENT * float(np.log(5.0))
FIVEFOLD = 2.0 * float(np.log(5.0))  # the same of one row, by which a part of a record differs from the rest
# difference in log evidence within which another hypothesis explains the record as well: what the choice of rows makes
AS_GOOD = INDEPENDENT * float(np.log(1.1))

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
    def what(self) -> str:
        """In words, the others too."""
        return self.best.what + (f" (or: {'; or: '.join(self.others)})" if self.others else "")

    @property
    def factor(self) -> float:
        """By how much the part that the model cannot explain falls."""
        return self.before.share / max(self.best.fitted.share, 1e-300)


def find_mistake(s: Sampler) -> Finding | None:
    """The hypothesis that explains a record, or ``None`` if it looks as it should (or none explains it)."""
    before = s.fit()
    if before.rms < SUSPICIOUS and before.surprise < SURPRISING and before.kept > 1.0 - RARE:
        return None
    hypotheses = [*_propose_sheets(s), *_propose_columns(s), *timing.propose_times(s)]
    parts = [] if s.recorded.demodulated else _propose_midway(s)
    if (before.kept < 1.0 - RARE or before.share > timing.LARGE) and not s.recorded.demodulated:
        parts += timing.propose_parts(s)
    # a part of few enough rows: a robust fit has passed over them
    return _choose(before, [*hypotheses, *parts]) or (Finding(parts[0], (), before) if parts else None)


def _choose(before: LinearFit, hypotheses: Sequence[Hypothesis]) -> Finding | None:
    """The best hypothesis that is clearly better than the record as it is and than a model that predicts nothing.

    A record is not taken to be wrong where wider priors explain it as it is.
    """
    sheets = [h.fitted.score for h in hypotheses if h.kind == "sheet"]
    threshold = min(before.score, 0.0) - NAMED
    limit = min([threshold, *(score - AS_GOOD for score in sheets)])
    order = sorted(((h.score(before), h) for h in hypotheses), key=lambda x: x[0])
    order = [(score, h) for score, h in order if score <= (threshold if h.kind == "sheet" else limit)]
    if not order:
        return None
    least, best = order[0]
    near = [h.what for score, h in order[1:] if score < least + AS_GOOD and h.kind != "sheet"]
    return Finding(best, tuple(near[:2]), before)


# --- a sheet with priors that are too narrow ------------------------------------------------------------


def _propose_sheets(s: Sampler) -> Iterator[Hypothesis]:
    """Sheets that are less sure of the scale factors, of everything, or of both."""
    instrument, everything = s.instrument, {q.name: WIDE for q in PARAMETERS}
    for factors in ({"K1": WIDE_K1}, everything, {**everything, "K1": WIDE_K1}):
        widths = {
            q.name: max(1.0, factors[q.name] * float(np.median(usual / instrument.sigma(q.name))))
            for q in PARAMETERS
            if q.name in factors
            for usual in [q.plausible_si(instrument.accelerometers[q.name], instrument.g0)]
        }
        wider = replace(instrument, widths={**instrument.widths, **widths})
        fitted = replace(s, instrument=wider).fit()
        yield Hypothesis(
            what=f"the test sheet is too confident: {_describe_farthest(s, fitted)}",
            remedy="check it, or give the parameter a larger sigma in model.toml",
            fitted=fitted,
            kind="sheet",
            calming=len(factors) == 1,  # effects move angles and biases, but no scale factor by so much
        )


def _describe_farthest(s: Sampler, fitted: LinearFit) -> str:
    """The parameters that lie farthest from their sheet, in its sigmas: both values of up to three."""
    sheet = make_vector(s.model, s.instrument)
    moves = [((fitted.p[k] - sheet[k]) / c.scale, c, k) for c, k in list_base_columns(s.model, s.instrument)]
    moves = sorted((x for x in moves if x[1].effect is None), key=lambda x: -abs(x[0]))
    worst = [x for x in moves[:3] if abs(x[0]) > abs(moves[0][0]) / 10]
    return ", ".join(
        f"{c.name} of {c.accelerometer_name} is {fitted.p[k] / c.unit_factor:.6g} instead of"
        f" {sheet[k] / c.unit_factor:.6g} +- {c.scale / c.unit_factor:.2g} {c.unit}"
        for _, c, k in worst
    )


# --- mistakes of unit, sign and axis -------------------------------------------------------------------


@dataclass(frozen=True)
class ColumnMistake:
    """One possible mistake of unit, sign, axis or order."""

    what: str  # in words
    remedy: str
    undo: Callable[[Rows], Rows]  # rows as they are -> rows without it
    plainness: int = 0  # of mistakes that explain a record equally well the smallest is named first


def _propose_columns(s: Sampler) -> list[Hypothesis]:
    """The most promising mistakes of unit, sign and axis."""
    rows, few = s.take(), s.take(s.rows(most=FEW))
    rough = [(fit_rows(m.undo(few)).score, m) for m in list_mistakes(rows)]
    rough.sort(key=lambda x: x[0] + x[1].plainness / 2)
    best = [m for score, m in rough[:MOST_TRIED] if score < rough[0][0] + NAMED]
    return [Hypothesis(m.what, m.remedy, fit_rows(m.undo(rows)), m.plainness / 2, calming=True) for m in best]


def _propose_midway(s: Sampler) -> list[Hypothesis]:
    """A mistake of unit, sign or axis in a part of the record: of a logger that was started anew with other settings."""
    rows, least = s.rows(most=timing.PART_ROWS), np.inf
    mistakes = list(list_mistakes(s.take(rows)))
    for known in np.array_split(rows, min(PIECES, len(rows))):
        fitted = s.fit(known)
        costs = _measure_costs(s.take(rows), fitted, mistakes)
        states = timing.find_path(costs, timing.SWITCH)
        changes = timing.SWITCH * np.count_nonzero(np.diff(states))
        total = float(np.sum(costs[states, np.arange(len(rows))])) + changes
        if total < least:
            least, best, path = total, fitted, states
    if not path.any():
        return []
    m = mistakes[int(np.argmax(np.bincount(path)[1:]))]
    beside = [s.rows(int(rows[k]), int(rows[k + 1]) + 1, len(rows)) for k in np.flatnonzero(np.diff(path))]
    rows = np.unique(np.concatenate([rows, *beside]))
    costs = _measure_costs(s.take(rows), best, [m])
    there = timing.find_path(costs, timing.SWITCH) == 1
    if len(runs(there)) != 1 or there.all():
        return []
    was, undone, rest = (float(np.mean(x)) for x in (costs[0, there], costs[1, there], costs[0, ~there]))
    if was - max(undone, rest) < FIVEFOLD or undone - rest > FIVEFOLD:  # else the part fits as the rest does
        return []
    begins, ends = s.flight.time[rows[there][[0, -1]]]
    what = f"between t = {begins:.5g} s and t = {ends:.5g} s {m.what}"
    remedy = f"cut the record there, and in that part {m.remedy}"
    fitted = fit_rows(_undo_between(m, begins, ends, s.take()))
    return [Hypothesis(what, remedy, fitted, m.plainness / 2 + 1.0, kind="part")]


def _measure_costs(rows: Rows, fitted: LinearFit, mistakes: Sequence[ColumnMistake]) -> Array:
    """(1 + mistakes, n): what each of some rows speaks against it being as it is, or having one of the mistakes, by a fitted model."""
    left = [compute_residual(x, fitted) for x in (rows, *(m.undo(rows) for m in mistakes))]
    plainness = np.array([0.0, *(m.plainness / left[0].shape[-1] for m in mistakes)])
    return np.asarray(np.log(fitted.rms**2 + np.mean(np.square(left), axis=1)) + plainness[:, None])


def _undo_between(m: ColumnMistake, begins: float, ends: float, rows: Rows) -> Rows:
    """Rows without a mistake that they have between two instants, s."""
    there, undone = (rows.record.time >= begins) & (rows.record.time <= ends), m.undo(rows)
    columns = {n: np.where(there, undone.record.wide[n], x) for n, x in rows.record.wide.items()}
    return replace(rows.change(columns), data=np.where(there, undone.data, rows.data))


def list_mistakes(rows: Rows) -> Iterator[ColumnMistake]:
    """Every mistake of units, signs, axes and order that such rows may hold."""
    written = rows.sampler.flight.written or rows.sampler.flight.channels
    derived = ANGULAR_ACCELERATION[0] not in written  # from the rates, whose mistakes it shares
    yield from list_channel_mistakes(rows) if rows.sampler.recorded.demodulated else _propose_outputs(rows)
    for stem in ("a", "omega", *(() if derived else ("omegadot",)), *(["Gamma"] * rows.gradient_recorded)):
        columns = "Gamma" if stem == "Gamma" else ", ".join(f"{stem}_{k}" for k in "xyz")
        first = next(n for n in rows.record.wide if find_stem(n) == stem)
        for what, remedy, factor in _list_units(rows, columns, first, stem):
            if stem == "omega" and derived:
                yield ColumnMistake(what, remedy, _scale(("omega", "omegadot"), factor))
                continue
            yield ColumnMistake(what, remedy, _scale((stem,), factor))
            if stem == "omega":
                what, remedy = f"{what}, and omegadot likewise", f"{remedy}, and that of omegadot"
                yield ColumnMistake(what, remedy, _scale(("omega", "omegadot"), factor), 1)
    if rows.gradient_recorded:
        remedy = "multiply Gamma by -1: f = a + ... - Gamma r"
        yield ColumnMistake("the sign of Gamma is reversed", remedy, _scale(("Gamma",), -1.0))
    yield from _propose_axes(derived)


_UNITS = {
    "a": ("m/s^2", "g", "mg", "mGal"),
    "omega": ("rad/s", "deg/s", "deg/h", "mrad/s", "urad/s"),
    "omegadot": ("rad/s^2", "deg/s^2", "deg/h/s", "deg/h^2"),
    "Gamma": ("s^-2", "Eo"),
    "G": ("V", "mV", "uV", "kV"),
    "inline": ("s^-2", "Eo"),
}
"""Units in which quantities may be, SI first."""


def _list_units(rows: Rows, columns: str, first: str, quantity: str) -> Iterator[tuple[str, str, float]]:
    """What, remedy and factor of every unit that columns may have instead of that which the file gives to the ``first`` of them."""
    units, possible = rows.sampler.instrument.units, _UNITS[quantity]
    file_unit = rows.sampler.flight.written.get(first, possible[0])
    size, factors = float(units.to_si(1.0, file_unit, possible[0])), [1.0]
    verb = "are" if "," in columns or " and " in columns or "..." in columns else "is"
    for unit in possible:
        factor = float(units.to_si(1.0, unit, possible[0])) / size
        if all(abs(factor / f - 1) > 1e-9 for f in factors):
            factors.append(factor)
            yield f"{columns} {verb} in {unit}, not in {file_unit}", f"write the unit [{unit}]", factor


def _scale(stems: tuple[str, ...], factor: float) -> Callable[[Rows], Rows]:
    def undo(rows: Rows) -> Rows:
        return rows.change({n: factor * x for n, x in rows.record.wide.items() if find_stem(n) in stems})

    return undo


def _mix(factors: Array) -> Callable[[Rows], Rows]:
    """The output's series (m, n) times factors (m, m)."""
    return lambda rows: replace(rows, data=factors @ rows.data)


def _propose_outputs(rows: Rows) -> Iterator[ColumnMistake]:
    names = rows.sampler.columns
    what = names[0] if len(names) == 1 else f"{names[0]} ... {names[-1]}"
    one = np.eye(len(names))
    yield ColumnMistake(f"the sign of {what} is reversed", f"multiply {what} by -1", _mix(-one))
    for text, remedy, factor in _list_units(rows, what, names[0], "G"):
        yield ColumnMistake(text, remedy, _mix(factor * one))
    for i, j in combinations(range(len(names)), 2):
        swapped = one.copy()
        swapped[[i, j]] = one[[j, i]]
        text = f"{names[i]} and {names[j]} are exchanged"
        yield ColumnMistake(text, "exchange the names of the columns", _mix(swapped), 2)


# by which people define the channels otherwise: (Gamma_xx - Gamma_yy)/2, Gamma_yy - Gamma_xx, 2 Gamma_xy, ...
FACTORS = (1.0, -1.0, 2.0, -2.0, 0.5, -0.5)


def list_channel_mistakes(rows: Rows) -> Iterator[ColumnMistake]:
    """Inline and cross with other units, names, signs or factors than Gamma_xx - Gamma_yy and Gamma_xy."""
    for text, remedy, factor in _list_units(rows, "inline and cross", "inline", "inline"):
        yield ColumnMistake(text, remedy, _mix(factor * np.eye(2)))
    exchanged = np.array([[0.0, -0.5], [-2.0, 0.0]])
    yield ColumnMistake("inline and cross are exchanged", "exchange their names", _mix(exchanged), 1)
    definitions = {"inline": "Gamma_xx - Gamma_yy", "cross": "Gamma_xy"}
    for factors in product(FACTORS, FACTORS):
        changed = [(n, x) for n, x in zip(definitions, factors, strict=True) if x != 1.0]
        if changed:
            what = "; ".join(f"{n} is {1 / x:g} times {definitions[n]}" for n, x in changed)
            remedy = ", ".join(f"multiply {n} by {x:g}" for n, x in changed)
            yield ColumnMistake(what, remedy, _mix(np.diag(factors)), 2 * len(changed))


def _propose_axes(derived: bool) -> Iterator[ColumnMistake]:
    both: tuple[str, ...] = ("omega", "omegadot")
    groups = [(("a",), 0), (both, 0), (("a", *both), 1), *([] if derived else [(("omega",), 1)])]
    for (group, more), order, signs in product(groups, permutations(range(3)), product((1, -1), repeat=3)):
        if order == (0, 1, 2) and signs == (1, 1, 1):
            continue
        moved, flips = sum(order[k] != k for k in range(3)), sum(s < 0 for s in signs)
        yield ColumnMistake(
            "; ".join(_describe_axes(q, order, signs) for q in group if q != "omegadot"),
            "exchange the names of the columns or the signs, or rotate the record into the measurement frame",
            partial(_turn, group=group, order=order, signs=signs),
            2 * moved + 2 * flips + more,
        )


def _describe_axes(stem: str, order: tuple[int, ...], signs: tuple[int, ...]) -> str:
    """Which columns hold which component."""
    names = [f"{stem}_{k}" for k in "xyz"]
    flipped = [names[k] for k in range(3) if signs[k] < 0]
    moved = [names[k] for k in range(3) if order[k] != k]
    if not moved:
        return f"{' and '.join(flipped)} {'have' if len(flipped) > 1 else 'has'} the wrong sign"
    if not flipped and len(moved) == 2:
        return f"{moved[0]} and {moved[1]} are exchanged"
    sources = [f"{'-' if s < 0 else ''}{names[k]}" for k, s in zip(order, signs, strict=True)]
    return f"{', '.join(names)} are in the columns {', '.join(sources)}"


def _turn(rows: Rows, group: tuple[str, ...], order: tuple[int, ...], signs: tuple[int, ...]) -> Rows:
    changed: dict[str, Array] = {}
    for prefix, q in product(("", "d_", "d2_"), group):
        names = [f"{prefix}{q}_{k}" for k in "xyz"]
        if all(n in rows.record.wide for n in names):
            changed |= {names[k]: signs[k] * rows.record.wide[names[order[k]]] for k in range(3)}
    return rows.change(changed)
