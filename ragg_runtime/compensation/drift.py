"""Parameters that drift: a random walk from block to block of time, theta_{k+1} = theta_k + w, smoothed over all flights.

The blocks' R factors are the measurements of a square-root information filter, forward and backward (G. Bierman, Factorization
Methods for Discrete Sequential Estimation, 1977; D. Fraser and J. Potter, IEEE Trans. Autom. Control 14, 1969). Which parameters
walk, and how fast, is chosen by the evidence of the forward filter: kind by kind, the same share of the sheet's error an hour for
all accelerometers (as GOCE: C. Siemes et al. 2012). The filter is linearised twice: a fit of constant parameters to a drift is far
from parameters that walk, and counts the walk as noise.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from ragg_runtime.base.progress import split_range
from ragg_runtime.compensation.calibrate import invert_root, list_base_r_factors, move_parameters
from ragg_runtime.estimation.calibration import estimate_noises
from ragg_runtime.estimation.fitted import Fitted, prepare_evidence
from ragg_runtime.estimation.least_squares import join
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import BLOCKS, make_block_edges
from ragg_runtime.estimation.whitening import Piece
from ragg_runtime.io import Flight

Array = NDArray[np.float64]

# decades of the standard deviation after an hour, over the sheet's error, within which a walk is sought
SLOWEST, FASTEST = -6.0, 1.0
WORTH = 4.5  # log evidence that a walk must gain: what distinguishes two explanations elsewhere

HOUR = 3600.0

STAIRS = (
    8  # steps a turn in which parameters follow a line: far more than the two cycles a turn of the gradient
)
# variance of a random walk about the line between its means over successive blocks, over that of its change in a block
WITHIN = 0.128

NEAR, TURNS = 0.1, 4
"""Largest distance of the smoothed parameters' mean from the point of linearisation, over the sheet's error; most linearisations.
At a distance of 4.6 compensated channels kept 6 Eo instead of 2.
"""


class Epoch(NamedTuple):
    """A block of time: its flight, its samples, and its middle, s, in the flight and since the first flight began."""

    flight: int
    rows: slice
    middle: float
    elapsed: float


@dataclass(frozen=True)
class Drift:
    """Parameters in blocks of time.

    ``rates``: name -> standard deviation of its walk after an hour, over the sheet's error. ``steps`` (epochs, n): the smoothed
    parameters less the calibrated ones, and ``roots`` (epochs, n, n) of their covariance, in scales. ``epochs`` are in order of time;
    ``timed``: whether the flights' stamps say how much lies between them.
    """

    f: Fitted
    rates: Mapping[str, float]
    epochs: tuple[Epoch, ...]
    steps: Array
    roots: Array
    timed: bool

    def follow(self, flight: int) -> Iterator[tuple[slice, Array, Array]]:
        """Samples of a flight, their parameters (n,) less the calibrated ones, and a root (n, m) of the covariance, in scales.

        Blocks have means. Between their middles parameters are linear, as a step from block to block rings at the gradient's
        frequency. From there a walk is off by ``WITHIN`` of its variance over a block.
        """
        r = self.f.flights[flight].record
        indices = [k for k, e in enumerate(self.epochs) if e.flight == flight]
        middles = [self.epochs[k].middle for k in indices]
        walk = np.array([self.rates.get(q.name, 0.0) for q in self.f.calibration.columns])
        for k in indices:
            rows = self.epochs[k].rows
            count = rows.stop - rows.start
            off = np.diag(walk * np.sqrt(WITHIN * count / r.rate / HOUR))[:, walk > 0]
            root = np.hstack([self.roots[k], off])
            length = max(1, int(r.rate / (STAIRS * abs(r.spin_frequency)))) if self.rates else count
            for stair in split_range(count, length):
                first, stop = rows.start + stair.start, rows.start + stair.stop
                middle = float(r.time[first] + r.time[stop - 1]) / 2
                before, share = divmod(float(np.interp(middle, middles, range(len(indices)))), 1.0)
                a, b = indices[int(before)], indices[min(int(before) + 1, len(indices) - 1)]
                yield slice(first, stop), (1.0 - share) * self.steps[a] + share * self.steps[b], root

    def as_json(self) -> dict[str, Any]:
        """The rates of those that walk, and their values in every block."""
        names = {o.flight: o.flight_name for o in self.f.observations}
        columns, values = self.f.calibration.columns, self.f.calibration.in_scales + self.steps
        rates, states = [], []
        for name, rate in self.rates.items():
            kind = [q for q in columns if q.name == name]
            per_root_hour = rate * max(q.scale / q.unit_factor for q in kind)
            rates.append({"name": name, "per_root_hour": per_root_hour, "unit": kind[0].unit})
        for n, q in ((n, q) for n, q in enumerate(columns) if q.name in self.rates):
            factor = q.scale / q.unit_factor
            stds = factor * np.linalg.norm(self.roots[:, n], axis=1)
            for e, value, std in zip(self.epochs, factor * values[:, n], stds, strict=True):
                state = {"flight": names[e.flight], "time_s": e.middle, "elapsed_s": e.elapsed}
                state |= {"name": q.name, "accelerometer": q.accelerometer}
                states.append({**state, "value": float(value), "std": float(std), "unit": q.unit})
        return {"timed": self.timed, "rates": rates, "states": states}


def smooth_drift(f: Fitted, flights: Sequence[Flight]) -> Drift:
    """Find which parameters drift, and follow them through all flights.

    Parameters
    ----------
    f
        A fit of constant parameters to the flights.
    flights
        The same flights, in any order, for their times: the parameters walk on between them (:func:`find_starts`).

    Returns
    -------
    Drift
        The parameters in each block of time, about a fit to which they are near.
    """
    starts, timed = find_starts(flights)
    d = _smooth(f, starts, timed, None)
    for turn in range(TURNS):
        mean = np.mean(d.steps, axis=0)
        if not d.rates or (turn and np.max(np.abs(mean)) < NEAR):
            break
        c = d.f.calibration
        noise = c.noise if turn else tuple(_estimate_noise(d))
        c = replace(c, p=move_parameters(c, mean), noise=noise)
        f = prepare_evidence(f.model, f.instrument, f.observations, c, candidates=False)
        d = _smooth(f, starts, timed, d.rates if turn else None)
    return d


def _estimate_noise(d: Drift) -> list[NoiseModel]:
    """Of every observation what nothing explains beside the parameters as they drift: constant ones leave their walk as noise."""
    f, residuals = d.f, []
    for x in f.prepared:
        o, steps = x.observation, np.zeros((len(x.observation.record.time), f.n_base))
        for rows, step, _ in d.follow(o.flight):
            steps[rows] = step

        def drift(piece: Piece, steps: Array = steps) -> Array:
            return np.asarray(np.einsum("nmk,kn->mk", piece.columns[: f.n_base], steps[piece.rows]))

        walked = np.concatenate([*x.each(drift, whitened=False)], axis=1)
        residuals.append(replace(o, series=tuple(np.atleast_2d(o.data) - walked)))
    return estimate_noises(f.model, f.instrument, residuals, f.calibration.p)


def _smooth(f: Fitted, starts: Sequence[float], timed: bool, rates: Mapping[str, float] | None) -> Drift:
    """The parameters in each block of time, everything linear about a fit; how fast they walk is sought if ``rates`` is ``None``."""
    blocks = []
    for n, start in enumerate(starts):
        indices = [k for k, o in enumerate(f.observations) if o.flight == n]
        t = f.observations[indices[0]].record.time
        edges = make_block_edges(len(t))
        for b in range(BLOCKS):
            rows = slice(int(edges[b]), int(edges[b + 1]))
            if rows.start < rows.stop:
                middle = float(t[rows.start] + t[rows.stop - 1]) / 2
                r_factor = join([list_base_r_factors(f, k)[b] for k in indices])
                blocks.append((Epoch(n, rows, middle, start + middle), r_factor))
    blocks.sort(key=lambda x: x[0].elapsed)
    epochs, measured = zip(*blocks, strict=True)
    hours = np.diff([e.elapsed for e in epochs]) / HOUR
    prior = np.column_stack([np.eye(f.n_base), f.to_nominal])
    names = [q.name for q in f.calibration.columns]
    if rates is None:
        rates = _find_rates(prior, measured, hours, names)
    walk = np.array([rates.get(n, 0.0) for n in names])
    forward, _ = _filter(prior, measured, hours, walk)
    backward, _ = _filter(prior[:0], measured[::-1], hours[::-1], walk, before=True)
    joined = [
        np.asarray(np.linalg.qr(np.vstack(pair), mode="r"))[: f.n_base]
        for pair in zip(forward, backward[::-1], strict=True)
    ]
    roots = np.array([invert_root(R[:, :-1]) for R in joined])
    steps = np.array([np.linalg.solve(R[:, :-1], R[:, -1]) for R in joined])
    return Drift(f, rates, epochs, steps, roots, timed)


def find_starts(flights: Sequence[Flight]) -> tuple[list[float], bool]:
    """When each flight begins, s after the first, and whether their stamps say so.

    Dates do; times of a day do unless flights would overlap, which are then of several days. Else flights follow without gaps.
    """
    first = [float(x.time[0]) for x in flights]
    days = [x.origin for x in flights]
    if all(days):
        first = [t + (day - days[0]).total_seconds() for t, day in zip(first, days, strict=True)]  # type: ignore[operator]
    ordered = sorted(zip(first, flights, strict=True), key=lambda x: x[0])
    overlap = any(a + x.duration > b for (a, x), (b, _) in pairwise(ordered))
    if all(days) or (all(x.instants for x in flights) and not overlap):
        return [t - ordered[0][0] for t in first], True
    ends = np.cumsum([0.0, *(x.duration for x in flights)])
    return [float(end) for end in ends[:-1]], len(flights) == 1


def _find_rates(
    prior: Array, measured: Sequence[Array], hours: Array, names: Sequence[str]
) -> dict[str, float]:
    """The kinds of parameter that walk, and how fast: forward selection by the evidence, with earlier choices fitted again at each step."""

    def evidence(rates: Mapping[str, float]) -> float:
        return _filter(prior, measured, hours, np.array([rates.get(n, 0.0) for n in names]))[1]

    def fit_rate(name: str, others: Mapping[str, float]) -> tuple[float, float]:
        best = optimize.minimize_scalar(
            lambda x: -evidence({**others, name: 10.0**x}),
            bounds=(SLOWEST, FASTEST),
            method="bounded",
            options={"xatol": 0.1},
        )
        return -float(best.fun), float(10.0**best.x)

    walks: dict[str, float] = {}
    log_evidence = evidence(walks)
    while True:
        tried = {n: fit_rate(n, walks) for n in dict.fromkeys(names) if n not in walks}
        name = max(tried, key=lambda n: tried[n][0], default=None)
        if name is None or tried[name][0] < log_evidence + WORTH:
            return walks
        walks[name] = tried[name][1]
        for n in [*walks]:
            others = {k: r for k, r in walks.items() if k != n}
            log_evidence, walks[n] = fit_rate(n, others)
            without = evidence(others)
            if log_evidence < without + WORTH:
                log_evidence, walks = without, others


def _filter(
    prior: Array, measured: Sequence[Array], hours: Array, walk: Array, *, before: bool = False
) -> tuple[list[Array], float]:
    """The R factors (n, n + 1) after each block (``before``: before it), and the log evidence of all blocks."""
    n = measured[0].shape[1] - 1
    R, r_factors, evidence = prior, [], 0.0
    for k, T in enumerate(measured):
        previous = R
        updated = np.asarray(np.linalg.qr(np.vstack([R, T]), mode="r"))
        R = updated[:n]
        if len(previous) == n:
            evidence += float(np.sum(np.log(np.abs(np.diag(previous)))) - np.sum(np.log(np.abs(np.diag(R)))))
            evidence -= float(np.sum(updated[n:, -1] ** 2)) / 2
        r_factors.append(previous if before else R)
        if k < len(hours):
            R = walk_on(R, walk * np.sqrt(max(hours[k], 1e-6)))
    return r_factors, evidence


def walk_on(R: Array, step: Array) -> Array:
    """The R factor after a step of the walk with standard deviations (n,); the parameters before it are eliminated."""
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
