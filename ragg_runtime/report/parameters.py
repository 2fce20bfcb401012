"""Calibrated parameters as tables, and what the record determines of them.

The covariance is read in the combinations of four accelerometers that G_out depends on: Sigma, D^12, D^34, D^1234 (Eq.
18-19).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from ragg_runtime.estimation.fitted import Fitted, posterior
from ragg_runtime.estimation.regressors import Column
from ragg_runtime.identification import parameters as combinations
from ragg_runtime.identification.parameters import UNSEEN
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import Matrix, Section, Table

Array = NDArray[np.float64]

DETERMINED = 0.5
"""Posterior over prior standard deviation below which a principal direction of all parameters is determined."""

SHARE = 0.03
"""Squared share of an unseen direction below which a combination is taken not to be part of it."""

PATTERNS = tuple(("Σ" if name == "Sigma" else name, signs) for name, signs in combinations.PATTERNS)
"""The combinations, as a page writes them."""

HALF_SEEN = 0.5
"""Posterior over prior variance of a direction of a group below which its formula is shown."""

LIKE_ONE = 0.05
"""Relative distance of a factor from one within which it is not written."""

LISTED = 16
"""Parameters and pairs that are listed, the largest first."""

MOST_LABELS = 60
"""Directions of a matrix of correlations: beyond these nobody reads it."""


@dataclass(frozen=True)
class Direction:
    """A named direction of the parameters: ``D12 β_z``. ``weight``: its coordinate is weight * pattern(p / scale)."""

    pattern: str
    column: Column
    weight: float

    def __str__(self) -> str:
        return " ".join(x for x in (self.pattern, written(self.column)) if x)


@dataclass(frozen=True)
class Group:
    """Directions that the record cannot tell apart, how many are lost, and the sums of them that it does determine."""

    members: tuple[Direction, ...]
    unseen: int
    seen: tuple[str, ...]


@dataclass(frozen=True)
class Visibility:
    """What the record determines: counts, directions not seen at all, and groups seen only together."""

    determined: int
    total: int
    unseen: tuple[Direction, ...]
    groups: tuple[Group, ...]


def written(column: Column) -> str:
    """The symbol of a calibrated parameter: ``β_z``."""
    pieces = numbers.symbol(column.symbol) if column.symbol else ((numbers.clean(column.name), False),)
    return "".join(f"_{text}" if lowered else text for text, lowered in pieces)


def _positions(f: Fitted) -> list[list[int]]:
    """Positions of the columns of each parameter."""
    found: dict[str, list[int]] = {}
    for n, c in enumerate(f.calibration.columns):
        found.setdefault(c.name, []).append(n)
    return list(found.values())


def value_cells(f: Fitted, positions: Sequence[int], weights: Sequence[Array]) -> list[str]:
    """Calibrated value ± std [nominal value] of sums of a parameter's columns; in parentheses what the record adds little to."""
    c, fitted = f.calibration, posterior(f)
    own = [c.columns[n] for n in positions]
    at, unit = c.index[list(positions)], own[0].unit_factor
    cells = []
    for u in weights:
        a = np.zeros(len(c.columns))
        a[list(positions)] = u * np.array([q.scale for q in own])
        std = fitted.std(a)
        sheet = float(u @ f.sheet[at]) / unit
        nominal = numbers.plain(sheet) if np.count_nonzero(u) == 1 else numbers.rounded(sheet, std / unit)
        value = numbers.plus_minus(float(u @ c.p[at]) / unit, std / unit)
        seen = std < UNSEEN * float(np.linalg.norm(a))
        cells.append(f"{value} [{nominal}]" if seen else f"({nominal})")
    return cells


def single_rows(f: Fitted) -> list[tuple[str, ...]]:
    """(parameter, unit, value of each accelerometer), as :func:`value_cells` writes them."""
    return [(*_head(f, p), *value_cells(f, p, list(np.eye(len(p))))) for p in _positions(f)]


def combination_rows(f: Fitted) -> list[tuple[str, ...]]:
    """The same of the sums and differences of the four accelerometers (parameters of one value left out)."""
    rows = []
    for positions in _positions(f):
        if len(positions) == 4 and f.instrument.layout.like_paper:
            g = combinations.gains(f.model, f.calibration.p, f.calibration.columns[positions[0]].name)
            cells = value_cells(f, positions, [np.array(signs) * g for _, signs in PATTERNS])
            rows.append((*_head(f, positions), *cells))
    return rows


def _head(f: Fitted, positions: Sequence[int]) -> tuple[str, str]:
    column = f.calibration.columns[positions[0]]
    symbol = written(column)
    name = "" if column.name == symbol else f"  {column.name}"
    return f"{symbol}{name}", numbers.unit(column.unit)


def directions_of(f: Fitted) -> tuple[list[Direction], Array]:
    """Named directions and their (k, n) unit vectors over the fitted parameters, in scales.

    They are sums of A1 ... A4 with signs where the record is of the paper's G_out, which depends on these.
    """
    form, columns = f.observations[0].recorded, f.calibration.columns
    patterns = f.instrument.layout.like_paper and not (form.separate or form.demodulated)
    directions, rows = [], []
    for positions in _positions(f):
        together = patterns and len(positions) == 4
        for k, n in enumerate(positions):
            name, signs = PATTERNS[k] if together else (columns[n].accelerometer_name, (1.0,))
            u = np.array(signs, dtype=float) / np.linalg.norm(signs)
            row = np.zeros(len(columns))
            row[positions if together else [n]] = u
            directions.append(Direction(name, columns[n], 1.0 / float(np.linalg.norm(signs))))
            rows.append(row)
    return directions, np.array(rows)


def visibility(f: Fitted) -> Visibility:
    """Which directions of the parameters the record determines, and which it leaves at their prior."""
    directions, U = directions_of(f)
    variance, vectors = np.linalg.eigh(U @ posterior(f).covariance @ U.T)
    null = vectors[:, variance >= DETERMINED**2]
    P = null @ null.T
    own = np.diag(P)
    shared = np.flatnonzero((own > SHARE) & (own <= 1.0 - SHARE))
    count, label = connected_components(np.abs(P[np.ix_(shared, shared)]) > SHARE, directed=False)
    groups = [_group(directions, P, shared[label == k]) for k in range(count)]
    return Visibility(
        determined=len(own) - null.shape[1],
        total=len(own),
        unseen=tuple(directions[n] for n in np.flatnonzero(own > 1.0 - SHARE)),
        groups=tuple(g for g in groups if g.unseen),
    )


def _group(directions: Sequence[Direction], P: Array, members: NDArray[np.intp]) -> Group:
    values, vectors = np.linalg.eigh(P[np.ix_(members, members)])
    seen, own = vectors[:, values < HALF_SEEN], tuple(directions[n] for n in members)
    return Group(own, len(members) - seen.shape[1], tuple(_formula(own, v) for v in _simple(seen)))


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


def _formula(directions: Sequence[Direction], v: Array) -> str:
    """A determined combination over the parameters in display units, its first term with factor one: ``Σ K_2 − Σ K_5``."""
    text = ""
    first: tuple[float, str] | None = None
    for d, x in zip(directions, v, strict=True):
        if x == 0.0:
            continue
        factor = float(x) * d.weight / (d.column.scale / d.column.unit_factor)
        first = first or (factor, d.column.unit)
        ratio, sized = factor / first[0], ""
        if abs(abs(ratio) - 1.0) > LIKE_ONE or d.column.unit != first[1]:
            unit = "" if d.column.unit == first[1] else f" {_quotient(first[1], d.column.unit)}"
            sized = f"{numbers.number(abs(ratio), 2)}{unit} · "
        sign = f"{numbers.MINUS} " if ratio < 0 else "+ " if text else ""
        text += f"{' ' if text else ''}{sign}{sized}{d}"
    return text


def _quotient(a: str, b: str) -> str:
    top, bottom = numbers.unit(a) or "1", numbers.unit(b)
    if not bottom:
        return top
    return f"{top}/({bottom})" if "/" in bottom or "·" in bottom else f"{top}/{bottom}"


def describe_parameters(f: Fitted) -> tuple[Section, ...]:
    """What the record determines of the parameters, their values and correlations, as sections."""
    v = visibility(f)
    known = (
        f"{v.determined} of {v.total} directions of the calibrated parameters are determined by this record"
    )
    text = [f"{known}; the others stay at their test-sheet values."]
    for pattern in dict.fromkeys(d.pattern for d in v.unseen):
        symbols = ", ".join(written(d.column) for d in v.unseen if d.pattern == pattern)
        text.append(f"Not observable: {f'{pattern} of ' if pattern else ''}{symbols}.")
    for g in v.groups:
        members, sums = (numbers.listed([str(x) for x in xs]) for xs in (g.members, g.seen))
        verb = "is" if len(g.seen) == 1 else "are"
        text.append(f"Degenerate: {f'of {members} only {sums} {verb} determined' if sums else members}.")
    found = [
        Section(title="What the record determines", sentences=tuple(text), detail=True, summary=f"{known}.")
    ]
    note = "Calibrated value ± standard deviation [test sheet]. In parentheses: the test sheet's value, to which the record adds little."
    if combined := combination_rows(f):
        names = [n for n, _ in PATTERNS]
        meaning = ", ".join(f"{n} = {describe.PATTERNS[n.replace('Σ', 'Sigma')]}" for n in names)
        table = _table(combined, names, f"{note} {meaning}, each weighted by its scale factor.")
        found.append(Section(title="Combinations of the accelerometers", table=table, detail=True))
    moved = Table(("parameter", "shift, prior standard deviations"), tuple(shifts(f)))
    matrix, pairs = correlations(f)
    strongest = Table(("parameter", "and", "correlation"), tuple(pairs), words=2)
    return (
        *found,
        Section(
            "Every parameter", table=_table(single_rows(f), f.instrument.layout.names, note), detail=True
        ),
        Section("Shift from the test sheet", table=moved, detail=True),
        Section("Correlations of the parameters", table=strongest, plots=(matrix,), detail=True),
    )


def _table(rows: Sequence[tuple[str, ...]], heads: Sequence[str], note: str) -> Table:
    whole = [(*r, *[""] * (2 + len(heads) - len(r))) for r in rows]
    return Table(("parameter", "unit", *heads), tuple(whole), words=2, note=note)


def shifts(f: Fitted) -> list[tuple[str, str]]:
    """(parameter, distance from the test sheet in plausible sizes) of the calibrated values that moved farthest."""
    c = f.calibration
    away = (c.p[c.index] - f.sheet[c.index]) / np.array([q.scale for q in c.columns])
    farthest = np.argsort(-np.abs(away), kind="stable")[:LISTED]
    own = [Direction(q.accelerometer_name, q, 1.0) for q in c.columns]
    return [(str(own[n]), numbers.number(float(away[n]), 2)) for n in farthest]


def correlations(f: Fitted) -> tuple[Matrix, list[tuple[str, str, str]]]:
    """The matrix of correlations of the directions that the record says something of, and its largest entries."""
    directions, U = directions_of(f)
    covariance = U @ posterior(f).covariance @ U.T
    std = np.sqrt(np.diag(covariance))
    kept = np.flatnonzero(std < UNSEEN)
    if len(kept) > MOST_LABELS:
        kept = np.sort(kept[np.argsort(std[kept], kind="stable")[:MOST_LABELS]])
    r = (covariance / np.outer(std, std))[np.ix_(kept, kept)]
    labels = tuple(str(directions[n]) for n in kept)
    i, j = np.triu_indices(len(r), 1)
    strongest = np.argsort(-np.abs(r[i, j]), kind="stable")[:LISTED]
    pairs = [(labels[i[k]], labels[j[k]], numbers.fixed(float(r[i[k], j[k]]), 3)) for k in strongest]
    caption = "Correlations of the calibrated parameters that this record determines, wholly or in part."
    return Matrix("correlations", "correlation matrix of the parameters", caption, labels, r), pairs
