"""Which motion to fly next: for every pair of alternatives the sinusoid about one axis, within limits, that separates them best.

Separation is what of one effect's signal neither the model nor the other effect can imitate, in standard deviations: the root mean
square over the posterior of the effect's coefficients. Their prior is Gaussian, of one variance that the evidence of the flights
fixes (D. MacKay, Neural Computation 4, 1992); directions that the flights do not determine promise nothing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.least_squares import compute_r_factor, orthonormalise
from ragg_runtime.estimation.regressors import LinearisationPoint, linearise
from ragg_runtime.identification.selection import ProjectedProblem
from ragg_runtime.io.record import is_disc_angle

Array = NDArray[np.float64]
Sinusoid = tuple[str, float, float, float]
"""Axis, frequency, Hz, amplitude, SI, and phase, rad."""

RATIOS = (0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0)
"""Frequencies that are tried, over the spin frequency."""

HIGHEST = 0.2
"""Highest frequency of a motion over the rate of its record: the record must hold its rate of change as well."""

WORTHWHILE = 1.05
"""Factor by which a motion must separate two effects farther than a longer record of what there is already."""

AXES = ("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z")

MASS = ("mass_x", "mass_y", "mass_z")
"""How far a body beside the instrument, ``near-sphere`` or ``near-cuboid`` of the model, is moved: axes where a limit says so."""

LIMITS: Mapping[str, float] = {"a": 0.49, "omega": 2.4e-3}
"""Largest amplitudes, m/s^2 and rad/s: 50 mg and 500 deg/h, what a stabilised platform lets through."""

SIMULATED = 96.0
"""Length of the motion that is computed while the best one is sought, s."""

DURATION = 600.0
"""Length of the motion that is proposed, s; information grows with it."""

LONGEST = 1800.0
"""Length of the motion for which separations are predicted, s; those of a longer one grow with the root of its length."""

AT_REST = 0.25
"""What counts as the spin frequency of a disc that does not turn, Hz: the paper's."""

APART = 3.0
"""Standard deviations at which two effects count as distinguishable."""

ALTERNATIVES = 3
"""Most alternatives of an effect for which a motion is sought."""

DETERMINED = 3.0
"""Information of the flights about a direction, over that of the prior, from which it is determined: its standard deviation is
halved."""

STRENGTHS = np.logspace(0.0, 12.0, 49)
"""Prior variances of the coefficients that are tried, over the variance with which flights determine the best direction."""


@dataclass(frozen=True)
class Separation:
    """By how many standard deviations ``rival`` is ruled out if ``effect`` is present.

    ``now``: by the flights; ``then``: once the motion has been flown as well, with its standard deviation ``spread``, because the
    size of the effect is known no better.
    """

    effect: str
    rival: str
    now: float
    then: float
    spread: float

    def as_json(self) -> dict[str, object]:
        return asdict(self)


@dataclass(frozen=True)
class Proposal:
    """A motion that separates two effects: a sinusoid about one axis, of :data:`DURATION`, and its ``ratio`` to the spin's frequency."""

    separation: Separation
    sinusoid: Sinusoid
    ratio: float

    @property
    def separates(self) -> bool:
        """Whether the motion would separate the two."""
        return self.separation.then > APART

    def as_json(self) -> dict[str, object]:
        s, (axis, frequency, amplitude, _) = self.separation, self.sinusoid
        return {
            "effect": s.effect,
            "rival": s.rival,
            "axis": axis,
            "frequency_over_spin": self.ratio,
            "frequency_Hz": frequency,
            "amplitude": amplitude,
            "unit": find_unit(axis),
            "duration_s": DURATION,
            "separation_now": s.now,
            "separation_then": s.then,
            "separation_spread": s.spread,
            "separates": self.separates,
        }


@dataclass(frozen=True)
class Strength:
    """Posterior of an effect's coefficients along the directions that flights determine.

    ``directions`` (size, d): coefficients of all columns along each; ``mean``, ``std`` (d,): the posterior, independent along them.
    """

    directions: Array
    mean: Array
    std: Array

    def separation(self, R: Array) -> tuple[float, float]:
        """Root mean square, and standard deviation, of the norm of R (d, d) times the coefficients."""
        A = R.T @ R
        squares = float(self.mean @ A @ self.mean + np.sum(np.diag(A) * self.std**2))
        if squares <= 0.0:
            return 0.0, 0.0
        C = A * self.std  # A times the covariance's root
        variance = 2 * float(np.sum((C * self.std[:, None]) * (C * self.std[:, None]).T))
        variance += 4 * float(np.sum((C.T @ self.mean) ** 2))
        return float(np.sqrt(squares)), float(np.sqrt(variance / squares) / 2)


def estimate_strength(
    f: Fitted, problem: ProjectedProblem, effect: str, beside: Sequence[str] = ()
) -> Strength:
    """The coefficients of an effect by the flights, marginal over the model's parameters and the effects ``beside`` it."""
    own = [f.n_base + n for n in problem.testable(effect)]
    others = [*range(f.n_base), *list_columns(f, problem, beside)]
    k = len(others)
    R = _lower_block(f.whole[:, [*others, *own, -1]], k)
    U, s, V = np.linalg.svd(R[:, :-1], full_matrices=False)
    if not len(s) or not s[0] > 0.0:
        return Strength(np.zeros((f.size, 0)), np.zeros(0), np.zeros(0))
    y = U.T @ R[:, -1]
    gain = np.outer(STRENGTHS, (s / s[0]) ** 2)  # information over the prior's, (strengths, directions)
    evidence = np.sum(y**2 * gain / (1 + gain) - np.log1p(gain), axis=1) / 2
    gain = gain[int(np.argmax(evidence))]
    some = gain > DETERMINED
    directions = np.zeros((f.size, int(np.sum(some))))
    directions[own] = V[some].T
    shrunk = (gain / (1 + gain))[some]
    return Strength(directions, shrunk * y[some] / s[some], np.sqrt(shrunk) / s[some])


def _lower_block(rows: Array, first: int) -> Array:
    """The R factor of the columns from ``first`` on, those before them projected out."""
    return np.asarray(np.linalg.qr(rows, mode="r"))[first:, first:]


def list_columns(f: Fitted, problem: ProjectedProblem, effects: Sequence[str]) -> list[int]:
    """Places among all columns of those of effects."""
    return [f.n_base + n for e in effects for n, _ in problem.candidates[e]]


@dataclass(frozen=True)
class Alternatives:
    """Pairs (effect, rival) that flights do not separate, and what is known of each effect.

    ``places``: among all columns of the model's, then the alternatives' and those of effects beside a pair.
    ``nuisance``: of each pair the columns, counted in ``places``, that may absorb the effect.
    """

    f: Fitted
    pairs: tuple[tuple[str, str], ...]
    places: tuple[int, ...]
    nuisance: tuple[tuple[int, ...], ...]
    strengths: Mapping[str, Strength]

    @staticmethod
    def of(
        f: Fitted, problem: ProjectedProblem, pairs: Sequence[tuple[str, str]], *, both: bool = False
    ) -> Alternatives:
        """Of pairs (found effect, rival); ``both``: and of (rival, effect), as it may be either."""
        pairs = [(e, r) for e, r in pairs if e in problem.candidates and r in problem.candidates]
        found = dict.fromkeys(e for e, _ in pairs)
        asked = dict.fromkeys([*pairs, *((r, e) for e, r in pairs if both)])
        beside = {(e, r): [x for x in found if x not in (e, r)] for e, r in asked}
        strengths = {}
        for e, r in asked:
            if e not in strengths:
                without = beside[e, r] if e not in found else [x for x in found if x != e]
                strengths[e] = estimate_strength(f, problem, e, without)
        of_pair = {(e, r): list_columns(f, problem, [r, *beside[e, r]]) for e, r in asked}
        places = [*range(f.n_base), *sorted({k for own in of_pair.values() for k in own})]
        at = {k: n for n, k in enumerate(places)}
        nuisance = tuple((*range(f.n_base), *(at[k] for k in own)) for own in of_pair.values())
        return Alternatives(f, tuple(asked), tuple(places), nuisance, strengths)

    @cached_property
    def root(self) -> Array:
        """(k, k): R factor of [places | directions] of the flights, the prior in it."""
        signals = [self.f.whole[:, :-1] @ s.directions for s in self.strengths.values()]
        return np.asarray(np.linalg.qr(np.hstack([self.f.whole[:, list(self.places)], *signals]), mode="r"))

    def separations(self, *further: Array) -> list[tuple[float, float]]:
        """Of every pair its separation and the spread, with further rows (n, k) added to the flights."""
        rows = np.vstack([self.root, *further])
        own, start = {}, len(self.places)
        for e, s in self.strengths.items():
            own[e] = range(start, start + len(s.mean))
            start += len(s.mean)
        found = []
        for (e, _), nuisance in zip(self.pairs, self.nuisance, strict=True):
            R = _lower_block(rows[:, [*nuisance, *own[e]]], len(nuisance))
            found.append(self.strengths[e].separation(R))
        return found

    @cached_property
    def needed(self) -> list[int]:
        """The columns of candidates without which no separation is known."""
        signals = {
            int(k) for s in self.strengths.values() for k in np.flatnonzero(np.any(s.directions, axis=1))
        }
        return sorted({*self.places[self.f.n_base :], *signals})

    @cached_property
    def at(self) -> LinearisationPoint:
        """About what motions are linearised: of the candidates no columns but those that are needed."""
        at, n = self.f.prepared[0].at, self.f.n_base
        known = range(len(at.candidates)) if at.only is None else at.only
        return replace(at, only=tuple(known[k - n] for k in self.needed))

    def rows(
        self, motion: Sequence[Sinusoid], *, simulated: float = SIMULATED, duration: float = DURATION
    ) -> Array:
        """R factor (k, k) of [places | directions] of a motion, ``simulated`` s of it, weighted for ``duration``, whitened."""
        X = whiten_motion(self.f, self.at, motion, simulated)
        there = [*range(self.f.n_base), *self.needed]
        directions = np.hstack([s.directions for s in self.strengths.values()])[there]
        X = np.concatenate([X[[there.index(k) for k in self.places]], directions.T @ X])
        return np.asarray(np.sqrt(duration / simulated) * compute_r_factor(X))

    def promises(self, motion: Sequence[Sinusoid], duration: float) -> list[Separation]:
        """What so much, s, of a motion promises of every pair."""
        then = self.separations(self.rows(motion, simulated=min(duration, LONGEST), duration=duration))
        each = zip(self.pairs, self.separations(), then, strict=True)
        return [Separation(*pair, now, later, spread) for pair, (now, _), (later, spread) in each]


def whiten_motion(f: Fitted, at: LinearisationPoint, motion: Sequence[Sinusoid], simulated: float) -> Array:
    """(columns, samples): the columns at a point of so many seconds of a motion, whitened with the noise of the first flight.

    Where that flight's gradient was not recorded it will not be known in the motion either, and is projected out.
    """
    prepared = f.prepared[0]
    o, noise = prepared.observation, prepared.noise
    n = int(simulated * o.record.rate)
    time = np.arange(n) / o.record.rate
    channels = _continued(f, n)
    channels |= move_channels(channels, motion, time)
    r = replace(o.record, time=time, wide=channels, valid=np.ones(n, dtype=np.bool_), halo=(0, 0))
    r = replace(r, reading=None if r.reading is None else np.zeros(n))  # the model names it
    series = (np.zeros(n),) * len(o.series)
    made = replace(o, record=r, series=series, name="motion", thin=None)

    white = noise.whiten(linearise(at, made)[:-1])
    if not unknown_gradient.is_unknown(o):
        return white
    cosine, sine = r.carriers
    gradient = unknown_gradient.make_splines(time, cosine, sine)[:, None] * o.signs[:, None]
    Q = orthonormalise(noise.whiten(gradient))
    return white - (white @ Q) @ Q.T


def _continued(f: Fitted, samples: int) -> dict[str, Array]:
    """Channels (samples,) without the motion that is sought: those of the motion at their mean; others, such as a temperature, do
    what they did from the beginning of the first flight, and then stay.
    """
    r = f.prepared[0].observation.record
    first = r.part(slice(0, min(len(r.time), samples)))
    found = {}
    for name, x in first.channels.items():
        if is_disc_angle(name) or name in MASS:  # a body is where it was put up
            continue
        if name.partition("_")[0] in ("a", "omega", "omegadot", "Gamma"):
            found[name] = np.full(samples, float(np.mean(x[first.valid])) if first.valid.any() else 0.0)
        else:
            found[name] = np.pad(x, (0, samples - len(x)), mode="edge")
    return found


def propose_motions(
    f: Fitted,
    problem: ProjectedProblem,
    pairs: Sequence[tuple[str, str]],
    limits: Mapping[str, float] = LIMITS,
) -> list[Proposal]:
    """The best motion for every pair (effect, rival), the predicted separation next to today's."""
    asked = Alternatives.of(f, problem, pairs)
    if not asked.pairs:
        return []
    first = f.prepared[0].observation.record
    spin = abs(first.spin_frequency) or AT_REST
    ratios = [x for x in RATIOS if x * spin <= HIGHEST * first.rate]
    motions = [
        (ratio, (axis, ratio * spin, find_limit(limits, axis), 0.0)) for axis in AXES for ratio in ratios
    ]
    still = asked.separations(asked.rows(()))
    moving = [asked.separations(asked.rows([sinusoid])) for _, sinusoid in motions]
    found = []
    for n in range(len(asked.pairs)):
        best = max(range(len(motions)), key=lambda m: moving[m][n][0], default=None)
        if best is not None and moving[best][n][0] > WORTHWHILE * still[n][0]:
            ratio, sinusoid = motions[best]
            found.append(Proposal(asked.promises([sinusoid], DURATION)[n], sinusoid, ratio))
    return found


def move_channels(calm: Mapping[str, Array], motion: Sequence[Sinusoid], time: Array) -> dict[str, Array]:
    """The channels (N,) that sinusoids move, and their angular accelerations, added to their means."""
    found: dict[str, Array] = {}
    for axis, frequency, amplitude, phase in motion:
        w = 2 * np.pi * frequency
        found[axis] = found.get(axis, calm.get(axis, np.zeros(len(time)))) + amplitude * np.sin(
            w * time + phase
        )
        if axis.startswith("omega_"):
            name = axis.replace("omega_", "omegadot_")
            found[name] = found.get(name, calm[name]) + amplitude * w * np.cos(w * time + phase)
    return found


def find_unit(axis: str) -> str:
    """SI unit of the motion about an axis."""
    return {"a": "m/s^2", "omega": "rad/s", "mass": "m"}[axis.partition("_")[0]]


SLOPES = {"a": "jerk", "omega": "alpha", "mass": "speed"}
"""The limit of the rate of change of each kind of motion, m/s^3, rad/s^2 and m/s; where it is not given there is none."""


def find_limit(limits: Mapping[str, float], axis: str, *, slope: bool = False) -> float:
    """The largest amplitude about an axis, or of its rate of change: its own, or that of all axes."""
    kind, _, k = axis.partition("_")
    name = SLOPES[kind] if slope else kind
    return limits.get(f"{name}_{k}", limits.get(name, np.inf))


def list_axes(limits: Mapping[str, float]) -> tuple[str, ...]:
    """Those of the platform, and of a body that is moved."""
    return (*AXES, *(n for n in MASS if find_limit(limits, n) < np.inf))


def list_pairs(groups: Mapping[str, Sequence[str]]) -> list[tuple[str, str]]:
    """(effect, rival) of groups that the record cannot split."""
    return [(e, r) for e, alternatives in groups.items() for r in alternatives[:ALTERNATIVES]]
