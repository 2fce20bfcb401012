"""Parameters that drift: a random walk from block to block of time, theta_{k+1} = theta_k + w, smoothed over all flights.

The blocks' R factors are the measurements of a square-root information filter, forward and backward (G. Bierman, Factorization
Methods for Discrete Sequential Estimation, 1977; D. Fraser and J. Potter, IEEE Trans. Autom. Control 14, 1969). Which parameters
walk, and how fast, is what the evidence of the forward filter says: kind by kind, the same share of the sheet's error an hour for
all accelerometers (as GOCE: C. Siemes et al. 2012).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from ragg_runtime.compensation.calibrated import base, inverse
from ragg_runtime.compensation.series import Stretch, stretch_of
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.least_squares import join
from ragg_runtime.estimation.observation import BLOCKS, block_edges
from ragg_runtime.io import Flight

Array = NDArray[np.float64]

SLOWEST, FASTEST = -6.0, 1.0
"""Decades of the standard deviation after an hour, over the sheet's error, within which a walk is sought."""

WORTH = 4.5
"""Log evidence that a kind of parameter must gain by walking: as much as distinguishes two explanations elsewhere."""

HOUR = 3600.0


@dataclass(frozen=True)
class Drift:
    """Parameters in blocks of time.

    ``rates``: name -> standard deviation of its walk after an hour, over the sheet's error. ``time`` (k,): the middle of each block,
    s, and ``flight`` (k,) its flight. ``steps`` (k, n): the smoothed parameters less the calibrated ones, and ``roots`` (k, n, n)
    of their covariance, in scales.
    """

    f: Fitted
    rates: Mapping[str, float]
    flight: tuple[int, ...]
    block: tuple[int, ...]
    time: Array
    steps: Array
    roots: Array

    def stretches(self) -> list[tuple[Stretch, ...]]:
        """Of every observation its blocks, each with its own parameters."""
        c = self.f.calibration
        scale = np.array([q.scale for q in c.columns])
        found = []
        for o in self.f.observations:
            edges = block_edges(len(o.record.time))
            own = []
            for k, (flight, b) in enumerate(zip(self.flight, self.block, strict=True)):
                if flight != o.flight:
                    continue
                p = c.p.copy()
                p[c.index] += self.steps[k] * scale
                own.append(stretch_of(c, int(edges[b]), int(edges[b + 1]), p, self.roots[k]))
            found.append(tuple(own))
        return found

    def as_json(self) -> dict[str, Any]:
        """The rates of those that walk, and their values in every block."""
        c = self.f.calibration
        names = {o.flight: o.flight_name for o in self.f.observations}
        walking = [(n, q) for n, q in enumerate(c.columns) if q.name in self.rates]
        states = [
            {
                "flight": names[flight],
                "time_s": float(self.time[k]),
                "name": q.name,
                "accelerometer": q.accelerometer,
                "value": float((c.p[c.index[n]] + self.steps[k, n] * q.scale) / q.unit_factor),
                "std": float(np.linalg.norm(self.roots[k, n]) * q.scale / q.unit_factor),
                "unit": q.unit,
            }
            for n, q in walking
            for k, flight in enumerate(self.flight)
        ]
        rates = [
            {
                "name": name,
                "per_root_hour": rate * max(q.scale / q.unit_factor for q in c.columns if q.name == name),
                "unit": next(q.unit for q in c.columns if q.name == name),
            }
            for name, rate in self.rates.items()
        ]
        return {"rates": rates, "states": states}


def smooth_drift(f: Fitted, flights: Sequence[Flight]) -> Drift:
    """Find which parameters drift, and follow them through all flights.

    Parameters
    ----------
    f
        A fit of constant parameters to the flights, about which everything is linear.
    flights
        The same flights, for their times: where their stamps are instants they say how long lies between flights; else one
        flight follows the other at once.

    Returns
    -------
    Drift
        The parameters in each block of time.
    """
    order, start = _timeline(flights)
    flight, block, time, elapsed, measured = [], [], [], [], []
    for n in order:
        own = [k for k, o in enumerate(f.observations) if o.flight == n]
        t = f.observations[own[0]].record.time
        edges = block_edges(len(t))
        for b in range(BLOCKS):
            if edges[b] == edges[b + 1]:
                continue
            middle = float(t[edges[b]] + t[edges[b + 1] - 1]) / 2
            flight.append(n)
            block.append(b)
            time.append(middle)
            elapsed.append(start[n] + middle)
            measured.append(join(base([f.triangles[k][b] for k in own], f.n_base)))
    hours = np.maximum(np.diff(elapsed), 0.0) / HOUR
    prior = np.column_stack([np.eye(f.n_base), f.to_nominal])
    names = [q.name for q in f.calibration.columns]
    rates = _find_rates(prior, measured, hours, names)
    walk = np.array([rates.get(n, 0.0) for n in names])
    forward, _ = _filter(prior, measured, hours, walk)
    nothing = np.zeros((0, f.n_base + 1))
    backward, _ = _filter(nothing, measured[::-1], hours[::-1], walk, before=True)
    steps, roots = [], []
    for ahead, back in zip(forward, backward[::-1], strict=True):
        R = np.asarray(np.linalg.qr(np.vstack([ahead, back]), mode="r"))[: f.n_base]
        roots.append(inverse(R[:, :-1]))
        steps.append(np.linalg.solve(R[:, :-1], R[:, -1]))
    return Drift(f, rates, tuple(flight), tuple(block), np.array(time), np.array(steps), np.array(roots))


def _timeline(flights: Sequence[Flight]) -> tuple[list[int], dict[int, float]]:
    """Flights in order of time, and when the time of each is zero, s."""
    numbers = list(range(len(flights)))
    if all(x.instants for x in flights):
        return sorted(numbers, key=lambda n: float(flights[n].time[0])), dict.fromkeys(numbers, 0.0)
    start, end = {}, 0.0
    for n, x in enumerate(flights):
        start[n] = end - float(x.time[0])
        end += x.duration
    return numbers, start


def _find_rates(
    prior: Array, measured: Sequence[Array], hours: Array, names: Sequence[str]
) -> dict[str, float]:
    """The kinds of parameter that walk, and how fast: forward selection by the evidence, each choice fitted anew beside the next."""

    def evidence(rates: Mapping[str, float]) -> float:
        return _filter(prior, measured, hours, np.array([rates.get(n, 0.0) for n in names]))[1]

    def fitted(name: str, others: Mapping[str, float]) -> tuple[float, float]:
        best = optimize.minimize_scalar(
            lambda x: -evidence({**others, name: 10.0**x}),
            bounds=(SLOWEST, FASTEST),
            method="bounded",
            options={"xatol": 0.1},
        )
        return -float(best.fun), float(10.0**best.x)

    found: dict[str, float] = {}
    known = evidence(found)
    while True:
        tried = {n: fitted(n, found) for n in dict.fromkeys(names) if n not in found}
        name = max(tried, key=lambda n: tried[n][0], default=None)
        if name is None or tried[name][0] < known + WORTH:
            return found
        found[name] = tried[name][1]
        for n in [*found]:
            others = {k: r for k, r in found.items() if k != n}
            known, found[n] = fitted(n, others)
            without = evidence(others)
            if known < without + WORTH:
                known, found = without, others


def _filter(
    prior: Array, measured: Sequence[Array], hours: Array, walk: Array, *, before: bool = False
) -> tuple[list[Array], float]:
    """The R factors (n, n + 1) after each block (``before``: before it), and the log evidence of all blocks."""
    n = measured[0].shape[1] - 1
    R, found, evidence = prior, [], 0.0
    for k, T in enumerate(measured):
        known = R
        whole = np.asarray(np.linalg.qr(np.vstack([R, T]), mode="r"))
        R = whole[:n]
        if len(known) == n:
            evidence += float(np.sum(np.log(np.abs(np.diag(known)))) - np.sum(np.log(np.abs(np.diag(R)))))
            evidence -= float(np.sum(whole[n:, -1] ** 2)) / 2
        found.append(known if before else R)
        if k < len(hours):
            R = _walked(R, walk * np.sqrt(max(hours[k], 1e-6)))
    return found, evidence


def _walked(R: Array, step: Array) -> Array:
    """The R factor after a step of the walk, of these standard deviations (n,): the parameters before it are eliminated."""
    moving = np.flatnonzero(step)
    m, n = len(moving), len(step)
    if not m:
        return R
    rows = np.zeros((m + len(R), m + n + 1))
    rows[:m, :m] = -np.diag(1.0 / step[moving])
    rows[range(m), m + moving] = 1.0 / step[moving]
    rows[m:, :m] = R[:, moving]
    rows[m:, m:] = R
    rows[m:, m + moving] = 0.0
    return np.asarray(np.linalg.qr(rows, mode="r"))[m : m + n, m:]
