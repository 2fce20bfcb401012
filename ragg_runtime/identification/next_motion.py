"""Which motion to fly next: sinusoids about the axes, within limits, that separate what the flights cannot.

A motion adds rows to the R factor of the flights, from which all criteria are read (A. Atkinson, A. Donev, R. Tobias, Optimum
Experimental Designs, 2007, ch. 10 and 21), as how far effects are separated (D_s-optimal, compound over all pairs).
Its frequencies are found by exchange, one axis after the other (R. Meyer and C. Nachtsheim, Technometrics 37, 1995).

Separation is what of one effect's signal neither the model nor the other effect can imitate, in standard deviations: the root mean
square over the posterior of the effect's coefficients. Their prior is Gaussian, of one variance that the evidence of the flights
fixes (D. MacKay, Neural Computation 4, 1992); directions that the flights do not determine promise nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.progress import one_thread
from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.least_squares import compute_r_factor, orthonormalise
from ragg_runtime.estimation.regressors import linearise
from ragg_runtime.identification.selection import ProjectedProblem
from ragg_runtime.io.record import is_disc_angle

Array = NDArray[np.float64]
Json = dict[str, Any]
Sinusoid = tuple[str, float, float, float]  # axis, frequency, Hz, amplitude, SI, and phase, rad
# frequencies that are tried, over the spin frequency
RATIOS = (0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0)
# highest frequency of a motion over the rate of its record: the record must hold its rate of change as well
HIGHEST = 0.2
# factor by which a motion must separate two effects farther than a longer record of what there is already
WORTHWHILE = 1.05

AXES = ("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z")

# how far a body beside the instrument is moved, an effect of the model that has these channels; axes where a limit says so
MASS = ("mass_x", "mass_y", "mass_z")

UNITS = {"a": "m/s^2", "omega": "rad/s", "mass": "m", "jerk": "m/s^3", "alpha": "rad/s^2", "speed": "m/s"}

# largest amplitudes, m/s^2 and rad/s: 50 mg and 500 deg/h, what a stabilised platform lets through
LIMITS: Mapping[str, float] = {"a": 0.49, "omega": 2.4e-3}
# the limit of the rate of change of each kind of motion; where it is not given there is none
SLOPES = {"a": "jerk", "omega": "alpha", "mass": "speed"}
SIMULATED = 96.0  # length of the motion that is computed while the best one is sought, s
DURATION = 600.0  # length of the motion that a diagnosis proposes, s; information grows with it
# most of a motion that is computed for what it promises, s; of a longer one uncertainties fall with the root of its length
LONGEST = 1800.0
SWEEPS = 2  # in which frequencies are exchanged; further ones change little
AT_REST = 0.25  # what counts as the spin frequency of a disc that does not turn, Hz: the paper's
APART = 3.0  # standard deviations at which two effects count as distinguishable
ALTERNATIVES = 3  # most alternatives of an effect for which a motion is sought
# information of the flights about a direction, over that of the prior, from which it is determined: its standard deviation is halved
DETERMINED = 3.0
# prior variances of the coefficients that are tried, over the variance with which flights determine the best direction
STRENGTHS = np.logspace(0.0, 12.0, 49)


# --- motions -------------------------------------------------------------------------------------------


def find_unit(axis: str) -> str:
    """SI unit of the motion about an axis."""
    return UNITS[axis.partition("_")[0]]


def find_limit(limits: Mapping[str, float], kind: str, k: str) -> float:
    """A limit of an axis, x, y or z: its own, or that of all axes."""
    return limits.get(f"{kind}_{k}", limits.get(kind, np.inf))


def list_tones(spin: float, limits: Mapping[str, float], band: tuple[float, float]) -> list[Sinusoid]:
    """The sinusoids of multiples of the spin frequency within a band, Hz, each as large as the limits let it be."""
    tones = []
    for axis in (*AXES, *MASS):
        kind, _, k = axis.partition("_")
        most, steepest = find_limit(limits, kind, k), find_limit(limits, SLOPES[kind], k)
        if most == np.inf:
            continue
        for ratio in RATIOS:
            frequency = ratio * (abs(spin) or AT_REST)
            if band[0] <= frequency <= band[1]:
                tones.append((axis, frequency, float(min(most, steepest / (2 * np.pi * frequency))), 0.0))
    return tones


def share_evenly(tones: Sequence[Sinusoid]) -> list[Sinusoid]:
    """All sinusoids together, of as large a share of the limits about an axis each, with phases that keep the peaks low.

    References
    ----------
    M. Schroeder, IEEE Trans. Inf. Theory 16, 1970.
    """
    shares: list[Sinusoid] = []
    for axis in dict.fromkeys(t[0] for t in tones):
        group = [t for t in tones if t[0] == axis]
        n = len(group)
        shares += [(axis, f, a / n, -np.pi * k * (k + 1) / n) for k, (_, f, a, _) in enumerate(group)]
    return shares


def move_channels(calm: Mapping[str, Array], motion: Sequence[Sinusoid], time: Array) -> dict[str, Array]:
    """The channels (N,) that sinusoids move, and their angular accelerations, added to their means."""
    channels: dict[str, Array] = {}
    for axis, frequency, amplitude, phase in motion:
        w = 2 * np.pi * frequency
        channels[axis] = channels.get(axis, calm[axis]) + amplitude * np.sin(w * time + phase)
        if axis.startswith("omega_"):
            name = axis.replace("omega_", "omegadot_")
            channels[name] = channels.get(name, calm[name]) + amplitude * w * np.cos(w * time + phase)
    return channels


def _continue_channels(f: Fitted, samples: int) -> dict[str, Array]:
    """Channels (samples,) without the motion that is sought: those of the motion at their mean; others, such as a temperature, do
    what they did from the beginning of the first flight, and then stay.
    """
    r = f.prepared[0].observation.record
    first = r.part(slice(0, min(len(r.time), samples)))
    channels = {name: np.zeros(samples) for name in MASS}  # a body is where it was put up
    for name, x in first.channels.items():
        if is_disc_angle(name) or name in MASS:
            continue
        if name.partition("_")[0] in ("a", "omega", "omegadot", "Gamma"):
            channels[name] = np.full(samples, float(np.mean(x[first.valid])) if first.valid.any() else 0.0)
        else:
            channels[name] = np.pad(x, (0, samples - len(x)), mode="edge")
    return channels


@dataclass(frozen=True)
class Knowledge:
    """What flights know of the base columns and of some ``candidates`` (columns of these), to which a motion adds.

    ``root`` (k, k): the R factor of these columns, the prior in it.
    """

    f: Fitted
    candidates: tuple[int, ...]
    root: Array

    @staticmethod
    def of(f: Fitted, candidates: Sequence[int] = ()) -> Knowledge:
        """Of the flights of a fit."""
        columns = [*range(f.n_base), *(f.n_base + k for k in candidates)]
        return Knowledge(f, tuple(candidates), np.asarray(np.linalg.qr(f.whole[:, columns], mode="r")))

    def fly(self, motion: Sequence[Sinusoid], duration: float, longest: float = SIMULATED) -> Array:
        """(k, k): the R factor once so much, s, of a motion has been flown as well; up to ``longest`` s of it are computed."""
        simulated = min(duration, longest)
        R = np.sqrt(duration / simulated) * compute_r_factor(self._whiten(motion, simulated))
        return np.asarray(np.linalg.qr(np.vstack([self.root, R]), mode="r"))

    def _whiten(self, motion: Sequence[Sinusoid], seconds: float) -> Array:
        """(k, samples): the columns in a motion, whitened with the noise of the first flight.

        Where that flight's gradient was not recorded it will not be known in the motion either, and is projected out.
        """
        x = self.f.prepared[0]
        o = x.observation
        n = int(seconds * o.record.rate)
        time = np.arange(n) / o.record.rate
        channels = _continue_channels(self.f, n)
        channels |= move_channels(channels, motion, time)
        r = replace(o.record, time=time, wide=channels, valid=np.ones(n, dtype=np.bool_), halo=(0, 0))
        r = replace(r, reading=None if r.reading is None else np.zeros(n))  # the model names it
        observation = replace(o, record=r, series=(np.zeros(n),) * len(o.series), name="motion", thin=None)
        at = replace(x.at, candidates=[x.at.candidates[k] for k in self.candidates])

        white = x.noise.whiten(linearise(at, observation)[:-1])
        if not unknown_gradient.is_unknown(o):
            return white
        gradient = unknown_gradient.make_splines(time, *r.carriers)[:, None] * o.signs[:, None]
        Q = orthonormalise(x.noise.whiten(gradient))
        return white - (white @ Q) @ Q.T


@one_thread
def find_motion(
    knowledge: Knowledge, worth: Callable[[Array], float], tones: Sequence[Sinusoid], duration: float
) -> list[Sinusoid]:
    """One sinusoid about each axis: those that give the R factor of most ``worth`` once flown together for ``duration`` s."""

    def weigh(motion: Sequence[Sinusoid]) -> float:
        return worth(knowledge.fly(motion, duration))

    of_axis = {axis: [t for t in tones if t[0] == axis] for axis in dict.fromkeys(t[0] for t in tones)}
    chosen = {axis: max(choices, key=lambda t: weigh([t])) for axis, choices in of_axis.items()}
    for _ in range(SWEEPS):
        before = dict(chosen)
        for axis, choices in of_axis.items():
            others = [t for other, t in chosen.items() if other != axis]
            chosen[axis] = max(choices, key=lambda t: weigh([*others, t]))
        if chosen == before:
            break
    return [*chosen.values()]


# --- the motion that separates effects -----------------------------------------------------------------


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

    def as_json(self) -> Json:
        """As the file of the command holds it."""
        return asdict(self)


@dataclass(frozen=True)
class Proposal:
    """The best sinusoid for two effects: about one axis, of :data:`DURATION`; ``frequency_over_spin`` is its ratio to the spin's."""

    effect: str
    rival: str
    axis: str
    frequency_over_spin: float
    frequency_Hz: float
    amplitude: float
    unit: str
    duration_s: float
    separation_now: float
    separation_then: float
    separation_spread: float

    def as_json(self) -> Json:
        """As the diagnosis states it; ``separates``: whether the motion would."""
        return asdict(self) | {"separates": self.separation_then > APART}


@dataclass(frozen=True)
class Strength:
    """Posterior of an effect's coefficients along the directions that flights determine.

    ``directions`` (columns, d): coefficients along each; ``mean``, ``std`` (d,): the posterior, independent along them.
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


def estimate_strength(T: Array, columns: Sequence[int], others: Sequence[int]) -> Strength:
    """The coefficients of the ``columns`` of an R factor T [columns | residual], marginal over the ``others``."""
    R = _lower_block(T[:, [*others, *columns, -1]], len(others))
    U, s, V = np.linalg.svd(R[:, :-1], full_matrices=False)
    if not len(s) or not s[0] > 0.0:
        return Strength(np.zeros((T.shape[1] - 1, 0)), np.zeros(0), np.zeros(0))
    y = U.T @ R[:, -1]
    gain = np.outer(STRENGTHS, (s / s[0]) ** 2)  # information over the prior's, (strengths, directions)
    evidence = np.sum(y**2 * gain / (1 + gain) - np.log1p(gain), axis=1) / 2
    gain = gain[int(np.argmax(evidence))]
    determined = gain > DETERMINED
    directions = np.zeros((T.shape[1] - 1, int(np.sum(determined))))
    directions[columns] = V[determined].T
    shrunk = (gain / (1 + gain))[determined]
    return Strength(directions, shrunk * y[determined] / s[determined], np.sqrt(shrunk) / s[determined])


def _lower_block(rows: Array, first: int) -> Array:
    """The R factor of the columns from ``first`` on, those before them projected out."""
    return np.asarray(np.linalg.qr(rows, mode="r"))[first:, first:]


@dataclass(frozen=True)
class Alternatives:
    """Pairs (effect, rival) that flights do not separate, and of each what is known of the effect and which columns may absorb it."""

    known: Knowledge
    pairs: Mapping[tuple[str, str], tuple[Strength, tuple[int, ...]]]

    @staticmethod
    def of(
        f: Fitted, problem: ProjectedProblem, pairs: Sequence[tuple[str, str]], *, both: bool = False
    ) -> Alternatives:
        """Of pairs (found effect, rival); ``both``: and of (rival, effect), as it may be either."""
        pairs = [(e, r) for e, r in pairs if e in problem.candidates and r in problem.candidates]
        claims = dict.fromkeys(e for e, _ in pairs)
        asked = dict.fromkeys([*pairs, *((r, e) for e, r in pairs if both)])
        named = {e: [n for n, _ in problem.candidates[e]] for pair in asked for e in pair}
        needed = sorted({n for columns in named.values() for n in columns})
        knowledge = Knowledge.of(f, needed)
        place = {n: f.n_base + k for k, n in enumerate(needed)}
        T = f.whole[:, [*range(f.n_base), *(f.n_base + n for n in needed), -1]]

        def nuisance(effects: Sequence[str]) -> list[int]:
            return [*range(f.n_base), *(place[n] for e in effects for n in named[e])]

        strengths = {}
        for e, r in asked:
            # a rival takes the place of the effect that was found, beside what else was found
            without = [x for x in claims if x != e and (e in claims or x != r)]
            tested = [place[n] for n in problem.testable(e)]
            strength = estimate_strength(T, tested, nuisance(without))
            others = nuisance([r, *(x for x in claims if x not in (e, r))])
            strengths[e, r] = strength, tuple(others)
        return Alternatives(knowledge, strengths)

    def separations(self, R: Array) -> list[tuple[float, float]]:
        """The separation of every pair, and its spread, by an R factor of the known columns."""
        return [
            strength.separation(_lower_block(np.hstack([R[:, others], R @ strength.directions]), len(others)))
            for strength, others in self.pairs.values()
        ]

    def worth(self, R: Array) -> float:
        """Compound D_s-criterion."""
        return float(np.sum(np.log1p([then**2 for then, _ in self.separations(R)])))

    def promise(self, motion: Sequence[Sinusoid], duration: float) -> list[Separation]:
        """The separation of every pair now, and after ``duration`` s of a motion."""
        now = self.separations(self.known.root)
        then = self.separations(self.known.fly(motion, duration, LONGEST))
        return [Separation(*p, before, *s) for p, (before, _), s in zip(self.pairs, now, then, strict=True)]


def propose_motions(
    f: Fitted,
    problem: ProjectedProblem,
    pairs: Sequence[tuple[str, str]],
    limits: Mapping[str, float] = LIMITS,
) -> list[Proposal]:
    """The best sinusoid for every pair (effect, rival), the predicted separation next to today's."""
    asked = Alternatives.of(f, problem, pairs)
    if not asked.pairs:
        return []
    first = f.prepared[0].observation.record
    spin = abs(first.spin_frequency) or AT_REST
    tones = list_tones(spin, limits, (0.0, HIGHEST * first.rate))
    still, *moving = (asked.separations(asked.known.fly(t, DURATION)) for t in ([], *([t] for t in tones)))
    proposals = []
    for n in range(len(asked.pairs)):
        best = max(range(len(tones)), key=lambda m: moving[m][n][0], default=None)
        if best is not None and moving[best][n][0] > WORTHWHILE * still[n][0]:
            axis, frequency, amplitude, _ = tones[best]
            s, unit = asked.promise([tones[best]], DURATION)[n], find_unit(axis)
            motion = (axis, frequency / spin, frequency, amplitude, unit, DURATION)
            proposals.append(Proposal(s.effect, s.rival, *motion, s.now, s.then, s.spread))
    return proposals
