"""Calibrated parameters as tables, and what the record determines of them.

The covariance is read in the combinations of four accelerometers that G_out depends on: Sigma, D^12, D^34, D^1234 (Eq.
18-19).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.fitted import Fitted, posterior
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.identification import parameters as combinations
from ragg_runtime.identification.parameters import SEEN, UNSEEN
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import Section, Table

Array = NDArray[np.float64]

DETERMINED = 0.5
"""The same for the principal directions of all parameters, which a record sees well or not at all."""

SHARE = 0.03
"""Squared share of an unseen direction below which a combination is taken not to be part of it."""

PATTERNS = tuple(("Σ" if name == "Sigma" else name, signs) for name, signs in combinations.PATTERNS)
"""The combinations, as a page writes them."""

HALF_SEEN = 0.5
"""Posterior over prior variance of a direction of a group below which its formula is shown."""

LIKE_ONE = 0.05
"""Relative distance of a factor from one within which it is not written."""


@dataclass(frozen=True)
class Symbol:
    """How a parameter is written, and its name in model.toml."""

    text: str
    name: str


@dataclass(frozen=True)
class Cell:
    """One value: calibrated ± std, nominal, and whether the record sees it (``seen``, ``part``, ``unseen``)."""

    value: str
    nominal: str
    state: str


@dataclass(frozen=True)
class Row:
    """A parameter: its symbol, unit and cells (four accelerometers or patterns, or one if shared)."""

    symbol: Symbol
    unit: str
    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class Piece:
    """A term of a combination in words: factor (empty: 1), pattern and symbol."""

    sign: str
    factor: str
    pattern: str
    symbol: Symbol


@dataclass(frozen=True)
class Group:
    """Combinations that the record cannot tell apart, and the sums of them that it does see."""

    members: tuple[Piece, ...]
    unseen: int
    seen: tuple[tuple[Piece, ...], ...]


@dataclass(frozen=True)
class Visibility:
    """What the record determines: counts, combinations not seen at all, and groups seen only together."""

    determined: int
    total: int
    unseen: tuple[tuple[str, tuple[Symbol, ...]], ...]
    groups: tuple[Group, ...]
    patterns: bool


def symbol_of(column: Column) -> Symbol:
    """The written symbol of a calibrated parameter."""
    pieces = numbers.symbol(column.symbol) if column.symbol else ((numbers.clean(column.name), False),)
    return Symbol("".join(f"_{text}" if lowered else text for text, lowered in pieces), column.name)


def _names(f: Fitted) -> dict[str, list[int]]:
    """Parameter name -> positions of its columns."""
    found: dict[str, list[int]] = {}
    for n, c in enumerate(f.calibration.columns):
        found.setdefault(c.name, []).append(n)
    return found


def _state(ratio: float) -> str:
    return "seen" if ratio < SEEN else "part" if ratio < UNSEEN else "unseen"


def by_accelerometer(f: Fitted) -> list[Row]:
    """Calibrated value ± std and nominal value of every parameter, in display units."""
    c = f.calibration
    nominal = f.sheet[c.index]
    ratio = np.sqrt(np.diag(posterior(f).covariance))
    rows = []
    for positions in _names(f).values():
        first = c.columns[positions[0]]
        cells = []
        for n in positions:
            q = c.columns[n]
            value, std = c.p[c.index[n]] / q.unit_factor, ratio[n] * q.scale / q.unit_factor
            cells.append(
                Cell(
                    numbers.plus_minus(value, std),
                    numbers.plain(nominal[n] / q.unit_factor),
                    _state(ratio[n]),
                )
            )
        rows.append(Row(symbol_of(first), numbers.unit(first.unit), tuple(cells)))
    return rows


def by_combination(f: Fitted) -> list[Row]:
    """The same of the sums and differences of the four accelerometers (parameters of one value left out)."""
    c = f.calibration
    nominal = f.sheet[c.index]
    fitted = posterior(f)
    rows = []
    for positions in _names(f).values():
        if len(positions) != 4 or not f.instrument.layout.like_paper:
            continue
        first = c.columns[positions[0]]
        scale = np.array([c.columns[n].scale for n in positions])
        cells = []
        for _, weights in PATTERNS:
            u = np.array(weights) * combinations.gains(f.model, c.p, first.name)
            a = np.zeros(len(c.columns))
            a[positions] = u * scale
            std = fitted.std(a) / first.unit_factor
            ratio = fitted.std(a) / float(np.linalg.norm(a))
            value = float(u @ c.p[c.index[positions]]) / first.unit_factor
            before = float(u @ nominal[positions]) / first.unit_factor
            cells.append(Cell(numbers.plus_minus(value, std), numbers.rounded(before, std), _state(ratio)))
        rows.append(Row(symbol_of(first), numbers.unit(first.unit), tuple(cells)))
    return rows


@dataclass(frozen=True)
class _Direction:
    """A unit vector of the basis in which directions are named."""

    pattern: str
    column: Column
    weight: float


def _in_patterns(f: Fitted) -> bool:
    """Whether directions are named as sums of A1 ... A4 with signs: those that the paper's G_out depends on."""
    form = f.observations[0].recorded
    return f.instrument.layout.like_paper and not (form.separate or form.demodulated)


def _basis(f: Fitted) -> tuple[list[_Direction], Array]:
    """Named directions and their (k, n) unit vectors over the fitted parameters, in scales."""
    columns = f.calibration.columns
    patterns = _in_patterns(f)
    directions, rows = [], []
    for positions in _names(f).values():
        together = patterns and len(positions) == 4
        for k, n in enumerate(positions):
            row = np.zeros(len(columns))
            if together:
                name, weights = PATTERNS[k]
                u = np.array(weights, dtype=float)
                row[positions] = u / np.linalg.norm(u)
                directions.append(_Direction(name, columns[n], 1.0 / float(np.linalg.norm(u))))
            else:
                row[n] = 1.0
                directions.append(_Direction(columns[n].accelerometer_name, columns[n], 1.0))
            rows.append(row)
    return directions, np.array(rows)


def visibility(f: Fitted) -> Visibility:
    """Which directions of the parameters the record determines, and which it leaves at their prior."""
    directions, U = _basis(f)
    variance, vectors = np.linalg.eigh(U @ posterior(f).covariance @ U.T)
    null = vectors[:, variance >= DETERMINED**2]
    P = null @ null.T
    own = np.diag(P)
    alone = [n for n in range(len(own)) if own[n] > 1.0 - SHARE]
    shared = [n for n in range(len(own)) if SHARE < own[n] <= 1.0 - SHARE]
    unseen: dict[str, list[Symbol]] = {}
    for n in alone:
        unseen.setdefault(directions[n].pattern, []).append(symbol_of(directions[n].column))
    groups = [_group(f, directions, P, members) for members in _components(P, shared)]
    return Visibility(
        determined=len(own) - null.shape[1],
        total=len(own),
        unseen=tuple((k, tuple(v)) for k, v in unseen.items()),
        groups=tuple(g for g in groups if g.unseen),
        patterns=_in_patterns(f),
    )


def _components(P: Array, members: Sequence[int]) -> list[list[int]]:
    """Members that share an unseen direction, directly or through others."""
    left, found = list(members), []
    while left:
        group, queue = [], [left.pop(0)]
        while queue:
            n = queue.pop()
            group.append(n)
            near = [m for m in left if P[n, m] ** 2 > SHARE**2]
            left = [m for m in left if m not in near]
            queue += near
        found.append(sorted(group))
    return found


def _group(f: Fitted, directions: Sequence[_Direction], P: Array, members: Sequence[int]) -> Group:
    values, vectors = np.linalg.eigh(P[np.ix_(members, members)])
    seen = vectors[:, values < HALF_SEEN]
    formulas = tuple(_formula(f, [directions[n] for n in members], v) for v in _simple(seen))
    pieces = tuple(Piece("", "", directions[n].pattern, symbol_of(directions[n].column)) for n in members)
    return Group(pieces, len(members) - seen.shape[1], formulas)


def _simple(seen: Array) -> list[Array]:
    """A basis (rows) of the columns' span with as many zeros as Gauss-Jordan elimination gives."""
    rows = seen.T.copy()
    free = list(range(rows.shape[1]))
    for r in range(len(rows)):
        k = max(free, key=lambda c: abs(rows[r, c]))
        free.remove(k)
        rows[r] /= rows[r, k]
        for other in range(len(rows)):
            if other != r:
                rows[other] -= rows[other, k] * rows[r]
    return [np.where(np.abs(row) > SHARE, row, 0.0) for row in rows]


def _formula(f: Fitted, directions: Sequence[_Direction], v: Array) -> tuple[Piece, ...]:
    """A seen combination over the parameters in display units, its first term with factor one."""
    pieces: list[Piece] = []
    first: tuple[float, str] | None = None
    for d, x in zip(directions, v, strict=True):
        if x == 0.0:
            continue
        # the direction's coordinate is weight * pattern(p / scale)
        factor = float(x) * d.weight / (d.column.scale / d.column.unit_factor)
        if first is None:
            first = (factor, d.column.unit)
        ratio = factor / first[0]
        text = ""
        if abs(abs(ratio) - 1.0) > LIKE_ONE or d.column.unit != first[1]:
            text = numbers.number(abs(ratio), 2)
            if d.column.unit != first[1]:
                text += f" {_quotient(first[1], d.column.unit)}"
        sign = numbers.MINUS if ratio < 0 else "+" if pieces else ""
        pieces.append(Piece(sign, text, d.pattern, symbol_of(d.column)))
    return tuple(pieces)


def _quotient(a: str, b: str) -> str:
    top, bottom = numbers.unit(a) or "1", numbers.unit(b)
    if not bottom:
        return top
    return f"{top}/({bottom})" if "/" in bottom or "·" in bottom else f"{top}/{bottom}"


def _single(f: Fitted, n: int) -> Piece:
    column = f.calibration.columns[n]
    return Piece("", "", column.accelerometer_name, symbol_of(column))


def describe_parameters(f: Fitted) -> tuple[Section, ...]:
    """What the record determines of the parameters, and their values, as sections."""
    v = visibility(f)
    known = (
        f"{v.determined} of {v.total} directions of the calibrated parameters are determined by this record"
    )
    text = [f"{known}; the others stay at their test-sheet values."]
    for name, symbols in v.unseen:
        text.append(f"Not observable: {f'{name} of ' if name else ''}{', '.join(s.text for s in symbols)}.")
    for g in v.groups:
        members = numbers.listed([piece_text(p) for p in g.members])
        sums = numbers.listed([" ".join(map(piece_text, row)) for row in g.seen])
        said = (
            f"of {members} only {sums} {'is' if len(g.seen) == 1 else 'are'} determined" if sums else members
        )
        text.append(f"Degenerate: {said}.")
    found = [
        Section(title="What the record determines", sentences=tuple(text), detail=True, summary=f"{known}.")
    ]
    note = "Calibrated value ± standard deviation [nominal value]."
    if combined := by_combination(f):
        names = [n for n, _ in PATTERNS]
        meaning = ", ".join(f"{n} = {describe.PATTERNS[n.replace('Σ', 'Sigma')]}" for n in names)
        table = _table(combined, names, f"{note} {meaning}, each weighted by its scale factor.")
        found.append(Section(title="Combinations of the accelerometers", table=table, detail=True))
    single = f"{note} In parentheses: the test sheet's value, to which the record adds little."
    table = _table(by_accelerometer(f), f.instrument.layout.names, single)
    moved = [(piece_text(p), numbers.number(sigma, 2)) for p, sigma in pulls(f, LISTED)]
    tied = [(piece_text(a), piece_text(b), numbers.fixed(r, 3)) for a, b, r in correlations(f, LISTED)]
    shift = Table(("parameter", "shift, prior standard deviations"), tuple(moved))
    strongest = Table(("parameter", "and", "correlation"), tuple(tied), words=2)
    return (
        *found,
        Section(title="Every parameter", table=table, detail=True),
        Section(title="Shift from the test sheet", table=shift, detail=True),
        Section(title="Strongest correlations", table=strongest, detail=True),
    )


LISTED = 16
"""Parameters and pairs that are listed, the largest first."""


def piece_text(p: Piece) -> str:
    """A term of a combination in one line."""
    return " ".join(x for x in (p.sign, p.factor and f"{p.factor} ·", p.pattern, p.symbol.text) if x)


def _table(rows: Sequence[Row], heads: Sequence[str], note: str) -> Table:
    def cell(c: Cell) -> str:
        return f"({c.nominal})" if c.state == "unseen" else f"{c.value} [{c.nominal}]"

    cells = [
        (
            f"{r.symbol.text}  {r.symbol.name}",
            r.unit,
            *map(cell, r.cells),
            *[""] * (len(heads) - len(r.cells)),
        )
        for r in rows
    ]
    return Table(("parameter", "unit", *heads), tuple(cells), words=2, note=note)


def pulls(f: Fitted, most: int) -> list[tuple[Piece, float]]:
    """(parameter, distance from the test sheet in plausible sizes) of the calibrated values that moved farthest."""
    c = f.calibration
    scale = np.array([q.scale for q in c.columns])
    away = (c.p[c.index] - f.sheet[c.index]) / scale
    order = np.argsort(-np.abs(away), kind="stable")[:most]
    return [(_single(f, n), float(away[n])) for n in order]


def correlations(f: Fitted, most: int) -> list[tuple[Piece, Piece, float]]:
    """(parameter, parameter, correlation) of the pairs that are correlated most, largest first."""
    covariance = posterior(f).covariance
    std = np.sqrt(np.diag(covariance))
    r = covariance / np.outer(std, std)
    i, j = np.triu_indices(len(r), 1)
    order = np.argsort(-np.abs(r[i, j]), kind="stable")[:most]
    return [(_single(f, i[k]), _single(f, j[k]), float(r[i[k], j[k]])) for k in order]
