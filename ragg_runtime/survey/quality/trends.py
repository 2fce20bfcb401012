"""What levels and noise of the lines depend on: heading, altitude, temperature, turbulence; days, and drift within them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import timedelta

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from ragg_runtime.flight.record import Array
from ragg_runtime.survey.quality.by_line import LineFigures, mean, names
from ragg_runtime.survey.quality.discs import Discs, combinations
from ragg_runtime.survey.quality.spectra import filled

SPARE = 3
"""Lines beyond the number of coefficients that a fit needs before it is shown."""

WINDOW = 20.0
"""Length, s, of the windows whose mean is held against their mean square of vertical acceleration."""


@dataclass(frozen=True)
class Dependence:
    """One coefficient of a linear fit over the lines: what depends on what, by how much, and how surely."""

    of: str
    on: str
    slope: float
    std: float
    unit: str
    p_value: float


@dataclass(frozen=True)
class Day:
    """One day (or flight): lines, the mean level of a channel and its standard deviation, drift within it, Eo/h."""

    name: str
    channel: str
    lines: int
    level: float
    std: float
    step: float | None
    step_std: float | None
    drift: float | None
    drift_std: float | None


def dependences(found: Sequence[LineFigures]) -> list[Dependence]:
    """Levels of every channel, and noise of every combination, fitted to all conditions at once.

    Every day has a constant of its own: instruments are adjusted between days, and their levels jump.
    """
    conditions = _conditions(found)
    day = [_day(f) for f in found]
    result = []
    for name in names(found, "levels"):
        y = np.array([f.levels.get(name, np.nan) for f in found])
        chosen = {n: c for n, c in conditions.items() if n[0] != "turbulence"}
        result += _fitted(f"mean of {name}", y, chosen, day)
    for name in names(found, "noise"):
        y = np.array([f.noise.get(name, np.nan) for f in found])
        result += _fitted(f"noise of {name}", y, conditions, day)
    return result


def rectification(found: Sequence[LineFigures], discs: Discs) -> list[Dependence]:
    """What vertical acceleration leaves behind once it is squared: combinations against its mean square.

    Means of windows of 20 s, less the line's own mean, all lines together: a coefficient in Eo/(m/s^2)^2.
    """
    pieces: dict[str, list[tuple[Array, Array]]] = {}
    for f in found:
        if f.rough is None:
            continue
        size = max(4, round(WINDOW * f.line.rate))
        power = _windows(f.rough.values**2, size)
        for c in combinations(f.line, discs):
            whole = filled(c.values)
            if whole is not None and len(power) > 2:
                level = _windows(whole, size)
                pieces.setdefault(c.name, []).append((power - power.mean(), level - level.mean()))
    result = []
    for name, parts in pieces.items():
        x, y = (np.concatenate([p[k] for p in parts]) for k in (0, 1))
        freedom = len(x) - len(parts) - 1
        if freedom < SPARE or not np.sum(x**2) > 0:
            continue
        slope = float(np.sum(x * y) / np.sum(x**2))
        std = float(np.sqrt(np.sum((y - slope * x) ** 2) / freedom / np.sum(x**2)))
        p = float(2 * stats.t.sf(abs(slope) / std, freedom)) if std > 0 else 1.0
        result.append(
            Dependence(
                of=f"{name}",
                on="vertical acceleration squared",
                slope=slope,
                std=std,
                unit="Eo/(m/s^2)^2",
                p_value=p,
            )
        )
    return result


def days(found: Sequence[LineFigures]) -> list[Day]:
    """Levels from day to day (from flight to flight, without dates), and drift within each."""
    groups: dict[str, list[LineFigures]] = {}
    for f in found:
        groups.setdefault(_day(f), []).append(f)
    if len(groups) < 2 and not any(f.line.origin for f in found):
        return []
    result = []
    for name in names(found, "levels"):
        before: tuple[float, float] | None = None
        for day, lines in groups.items():
            y = np.array([f.levels.get(name, np.nan) for f in lines])
            hours = np.array([_hours(f) for f in lines])
            there = np.isfinite(y)
            if not there.any():
                continue
            level = float(np.mean(y[there]))
            std = float(np.std(y[there], ddof=1) / np.sqrt(there.sum())) if there.sum() > 1 else float("nan")
            step = None if before is None else level - before[0]
            step_std = None if before is None else float(np.hypot(std, before[1]))
            drift = _slope(hours[there], y[there])
            result.append(
                Day(
                    name=day,
                    channel=name,
                    lines=int(there.sum()),
                    level=level,
                    std=std,
                    step=step,
                    step_std=step_std,
                    drift=None if drift is None else drift[0],
                    drift_std=None if drift is None else drift[1],
                )
            )
            before = (level, std)
    return result


def _conditions(found: Sequence[LineFigures]) -> Mapping[tuple[str, str], Array]:
    """(what, unit of a slope per it) -> (lines,) values, of what all lines have and that varies."""
    columns: dict[tuple[str, str], list[float]] = {}
    for f in found:
        direction = np.nan if f.track is None else f.track.direction
        columns.setdefault(("cos(heading)", "Eo"), []).append(float(np.cos(direction)))
        columns.setdefault(("sin(heading)", "Eo"), []).append(float(np.sin(direction)))
        for name, unit in (("altitude", "Eo/m"), ("temperature", "Eo/K")):
            value = mean(f.line, name)
            columns.setdefault((name, unit), []).append(np.nan if value is None else value)
        rough = np.nan if f.rough is None else f.rough.size
        columns.setdefault(("turbulence", "Eo/(m/s^2)"), []).append(rough)
    arrays = {n: np.array(v) for n, v in columns.items()}
    return {
        n: v
        for n, v in arrays.items()
        if np.isfinite(v).all() and np.ptp(v) > 1e-9 * max(1.0, np.abs(v).max())
    }


def _fitted(
    of: str, y: Array, conditions: Mapping[tuple[str, str], Array], day: Sequence[str]
) -> list[Dependence]:
    there = np.isfinite(y)
    if not there.any():
        return []
    _, group = np.unique(np.array(day)[there], return_inverse=True)
    design, kept = _independent({n: _within(v[there], group) for n, v in conditions.items()})
    y = _within(y[there], group)
    freedom = len(y) - design.shape[1] - len(set(group))
    if not kept or freedom < SPARE:
        return []
    solution, *_ = np.linalg.lstsq(design, y, rcond=None)
    variance = float(np.sum((y - design @ solution) ** 2)) / freedom
    covariance = variance * np.linalg.inv(design.T @ design)
    result = []
    for k, (name, unit, centre) in enumerate(kept):
        std = float(np.sqrt(covariance[k, k]))
        p = float(2 * stats.t.sf(abs(solution[k]) / std, freedom)) if std > 0 else 1.0
        result.append(
            Dependence(
                of=of, on=name, slope=float(solution[k] / centre), std=std / centre, unit=unit, p_value=p
            )
        )
    return result


def _within(values: Array, group: NDArray[np.int64]) -> Array:
    """Values less the mean of their group."""
    means = np.bincount(group, values) / np.bincount(group)
    return np.asarray(values - means[group])


def _independent(conditions: Mapping[tuple[str, str], Array]) -> tuple[Array, list[tuple[str, str, float]]]:
    """Centred, scaled columns of the conditions that are not nearly made up of those before them."""
    columns: list[NDArray[np.float64]] = []
    kept: list[tuple[str, str, float]] = []
    for (name, unit), values in conditions.items():
        scale = float(np.std(values))
        if scale < 1e-9 * max(1.0, float(np.max(np.abs(values)))):
            continue
        column = values / scale
        left = column
        if columns:
            before = np.column_stack(columns)
            left = column - before @ np.linalg.lstsq(before, column, rcond=None)[0]
        if np.std(left) > 0.05:  # else 1/400 of its variance is its own: nobody could tell the two apart
            columns.append(column)
            kept.append((name, unit, scale))
    return (np.column_stack(columns) if columns else np.empty((0, 0))), kept


def _windows(values: Array, size: int) -> Array:
    count = len(values) // size
    return np.asarray(values[: count * size].reshape(count, size).mean(axis=1))


def _day(f: LineFigures) -> str:
    if f.line.origin is not None:
        return (f.line.origin + timedelta(seconds=float(f.line.time[0]))).date().isoformat()
    flight = mean(f.line, "flight")
    return f"flight {flight:g}" if flight is not None else f.line.flight


def _hours(f: LineFigures) -> float:
    origin = 0.0 if f.line.origin is None else f.line.origin.timestamp()
    return (origin + float(f.line.time[0])) / 3600.0


def _slope(x: Array, y: Array) -> tuple[float, float] | None:
    """Slope of a line through points and its standard deviation; ``None`` with too few."""
    if len(x) < 2 + SPARE or np.ptp(x) == 0:
        return None
    fit = stats.linregress(x - x.mean(), y)
    return float(fit.slope), float(fit.stderr)
