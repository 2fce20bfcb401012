"""A multisine about all axes, within limits: that separates all effects that a record cannot, or that calibrates best.

The first is D_s-optimal, compound over all pairs, the second A- or D-optimal for what the parameters add to the variance of the
compensated channels (A. Atkinson, A. Donev, R. Tobias, Optimum Experimental Designs, 2007, ch. 10 and 21); amplitudes by SLSQP
(D. Kraft 1988), phases by M. Schroeder (IEEE Trans. Inf. Theory 16, 1970).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import linalg, optimize

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import one_thread
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.least_squares import compute_r_factor
from ragg_runtime.estimation.observation import combine_output
from ragg_runtime.estimation.scores import demodulate_residual
from ragg_runtime.estimation.whitening import Piece
from ragg_runtime.identification.next_motion import (
    AT_REST,
    LONGEST,
    RATIOS,
    SIMULATED,
    Alternatives,
    Separation,
    Sinusoid,
    find_limit,
    list_axes,
    whiten_motion,
)
from ragg_runtime.identification.parameters import find_combinations
from ragg_runtime.identification.selection import make_problem

Array = NDArray[np.float64]
Tone = tuple[str, float, float]
"""Axis, frequency, Hz, and largest amplitude, SI."""
Worth = Callable[[Sequence[Sinusoid]], float]

GRID = (*RATIOS, 6.0, 8.0, 12.0)
"""Frequencies of the multisine, over the spin frequency."""

CANDIDATES = 12
"""Sinusoids among which amplitudes are shared out: those that alone are worth most."""

STEP = 0.02
"""Share of a limit by which an amplitude is moved to find the slope of the criterion."""

LEAST = 0.02
"""Share of a limit below which a sinusoid is left out."""

SWEEPS = 2
"""In which sinusoids are exchanged; further ones change little."""

ITERATIONS = 25
"""Of the programming; the criterion is flat about its maximum."""


@dataclass(frozen=True)
class Design:
    """A multisine, and what it promises of each pair of alternatives."""

    sinusoids: tuple[Sinusoid, ...]
    separations: tuple[Separation, ...]

    def as_json(self) -> dict[str, object]:
        """What it promises."""
        return {"separations": [x.as_json() for x in self.separations]}


@one_thread
def design(
    f: Fitted,
    pairs: Sequence[tuple[str, str]],
    limits: Mapping[str, float],
    *,
    duration: float,
    band: tuple[float, float],
) -> Design | None:
    """The motion of ``duration`` s with frequencies within ``band``, Hz, that is best for these pairs of alternatives.

    ``None`` if there is nothing to separate, or no frequency within the band.
    """
    asked = Alternatives.of(f, make_problem(f), pairs, both=True)
    tones = list_tones(f.instrument.spin_frequency, limits, band)
    if not asked.pairs or not tones:
        return None

    def worth(motion: Sequence[Sinusoid]) -> float:
        there = asked.separations(asked.rows(motion, duration=duration))
        return float(np.sum(np.log1p([then**2 for then, _ in there])))

    motion = _best(worth, tones, limits)
    return Design(sinusoids=motion, separations=tuple(asked.promises(motion, duration)))


def _best(worth: Worth, tones: Sequence[Tone], limits: Mapping[str, float]) -> tuple[Sinusoid, ...]:
    """The multisine of the largest worth: of those sinusoids that alone are worth most, and those that are together."""
    alone = [worth([(*t, 0.0)]) for t in tones]
    order = sorted(range(len(tones)), key=lambda n: (-alone[n], n))
    together = _exchanged(worth, tones, order)
    best = list(dict.fromkeys([*together, *order]))[:CANDIDATES]
    tones = [tones[n] for n in sorted(best)]
    starts = share_evenly(tones), _mostly([sorted(best).index(n) for n in together], tones)
    found = max((_climbed(worth, tones, limits, x) for x in starts), key=lambda x: x[1])
    return multisine(tones, found[0])


def _exchanged(worth: Worth, tones: Sequence[Tone], order: Sequence[int]) -> list[int]:
    """One sinusoid about each axis, the best together: exchanged one after the other (R. Meyer and C. Nachtsheim, Technometrics 37,
    1995), from those that are best alone.
    """
    of_axis = {
        axis: [n for n, t in enumerate(tones) if t[0] == axis] for axis in dict.fromkeys(t[0] for t in tones)
    }
    chosen = {axis: next(n for n in order if n in own) for axis, own in of_axis.items()}
    for _ in range(SWEEPS):
        before = dict(chosen)
        for axis, own in of_axis.items():
            others = [(*tones[n], 0.0) for other, n in chosen.items() if other != axis]
            chosen[axis] = max(own, key=lambda n: (worth([*others, (*tones[n], 0.0)]), -n))
        if chosen == before:
            break
    return list(chosen.values())


def _mostly(few: Sequence[int], tones: Sequence[Tone]) -> Array:
    """Shares of the largest amplitudes: nearly all for a few sinusoids."""
    axes = [axis for axis, _, _ in tones]
    shares = np.full(len(tones), STEP)
    for n in few:
        shares[n] = 1.0 - STEP * axes.count(axes[n])
    return shares


def list_tones(spin: float, limits: Mapping[str, float], band: tuple[float, float]) -> list[Tone]:
    """The sinusoids within a band."""
    found = []
    for axis in list_axes(limits):
        for ratio in GRID:
            frequency = ratio * (abs(spin) or AT_REST)
            if band[0] <= frequency <= band[1]:
                slope = find_limit(limits, axis, slope=True) / (2 * np.pi * frequency)
                found.append((axis, frequency, float(min(find_limit(limits, axis), slope))))
    return found


def share_evenly(tones: Sequence[Tone]) -> Array:
    """Shares that are alike for all sinusoids about an axis."""
    axes = [axis for axis, _, _ in tones]
    return np.array([1.0 / axes.count(axis) for axis in axes])


def _climbed(
    worth: Worth, tones: Sequence[Tone], limits: Mapping[str, float], start: Array
) -> tuple[Array, float]:
    """Shares where the criterion is largest, and its value there."""

    def slopes(x: Array) -> Array:
        here, *there = (
            worth(multisine(tones, y, least=0.0)) for y in [x, *(x + STEP * e for e in np.eye(len(x)))]
        )
        return (np.array(there) - here) / STEP

    found = optimize.minimize(  # type: ignore[call-overload]
        lambda x: -worth(multisine(tones, x, least=0.0)),
        start,
        jac=lambda x: -slopes(x),
        bounds=[(0.0, 1.0)] * len(tones),
        constraints=optimize.LinearConstraint(np.array(_peaks(tones, limits)), -np.inf, 1.0),
        method="SLSQP",
        options={"maxiter": ITERATIONS, "ftol": 1e-3},
    )
    x = np.clip(found.x, 0.0, None)
    x = x / max(1.0, *(float(A @ x) for A in _peaks(tones, limits)))
    return x, worth(multisine(tones, x))


def _peaks(tones: Sequence[Tone], limits: Mapping[str, float]) -> list[Array]:
    """Rows A with A x <= 1: the sum of amplitudes about an axis, which no peak exceeds, and that of their rates of change."""
    rows = []
    for axis in dict.fromkeys(axis for axis, _, _ in tones):
        own = np.array([axis == t[0] for t in tones], dtype=np.float64)
        size = np.array([amplitude for _, _, amplitude in tones])
        rows.append(own * size / find_limit(limits, axis))
        slope = find_limit(limits, axis, slope=True)
        if slope < np.inf:
            rows.append(own * size * 2 * np.pi * np.array([t[1] for t in tones]) / slope)
    return rows


def multisine(tones: Sequence[Tone], x: Array, least: float = LEAST) -> tuple[Sinusoid, ...]:
    """The sinusoids of some shares, with phases that keep the peaks low."""
    found: list[Sinusoid] = []
    for axis in dict.fromkeys(axis for axis, _, _ in tones):
        own = [(t, float(s)) for t, s in zip(tones, x, strict=True) if t[0] == axis]
        found += [
            (axis, frequency, share * amplitude, -np.pi * k * (k + 1) / len(own))
            for k, ((_, frequency, amplitude), share) in enumerate(own)
            if share > least
        ]
    return tuple(found)


Criterion = Literal["A", "D"]

MATTER = 1e-3
"""Share of the channels' variance by parameters below which a direction does not count for D: its volume would be of nothing."""


@dataclass(frozen=True)
class Planned:
    """A parameter, its standard deviation by the flights so far, and once the motion has been flown as well; in ``unit``."""

    name: str
    accelerometer: int | None
    unit: str
    now: float
    then: float

    def as_json(self) -> dict[str, object]:
        return asdict(self)


@dataclass(frozen=True)
class CalibrationDesign(Design):
    """The multisine that calibrates best, each parameter as planned, the combinations of accelerometers' that it determines, and the
    rms that the parameters' uncertainty adds to inline and cross, Eo, ``now`` and ``then``.
    """

    criterion: Criterion
    parameters: tuple[Planned, ...]
    combinations: tuple[Planned, ...]
    now: tuple[float, float]
    then: tuple[float, float]

    def as_json(self) -> dict[str, object]:
        """What it promises."""
        channels = {"now": self.now, "planned": self.then}
        return super().as_json() | {
            "criterion": self.criterion,
            "channels": {k: {"inline_Eo": v[0], "cross_Eo": v[1]} for k, v in channels.items()},
            "parameters": [q.as_json() for q in self.parameters],
            "combinations": [q.as_json() for q in self.combinations],
        }


@dataclass(frozen=True)
class Information:
    """The information of flights about the parameters, and how these show in the compensated channels of their motion.

    ``root`` (n, n): R factor of the information, prior included; ``shown`` (2, n, n): R factors of the mean product of the changes of
    inline, and of cross, Eo, by a scale of each parameter.
    """

    f: Fitted
    root: Array
    shown: Array

    @staticmethod
    def of(f: Fitted) -> Information:
        return Information(f, np.triu(f.whole[: f.n_base, : f.n_base]), _channel_changes(f))

    def with_motion(self, motion: Sequence[Sinusoid], simulated: float, duration: float) -> Array:
        """(n, n): the inverse of the R factor with so much, s, of a motion."""
        at = replace(self.f.prepared[0].at, only=())
        X = compute_r_factor(whiten_motion(self.f, at, motion, simulated))
        return self.inverse(np.vstack([self.root, np.sqrt(duration / simulated) * X]))

    @staticmethod
    def inverse(rows: Array) -> Array:
        R = np.linalg.qr(rows, mode="r")
        return np.asarray(linalg.solve_triangular(R, np.eye(len(R))))

    def channels(self, inverse: Array) -> tuple[float, float]:
        """The rms that the parameters add to inline and cross, Eo."""
        inline, cross = (float(np.linalg.norm(G @ inverse)) for G in self.shown)
        return inline, cross

    def matter(self) -> Array:
        """(d, n): the directions that make up the channels' variance by the flights so far."""
        G = np.vstack([*self.shown])
        U, s, _ = np.linalg.svd(G @ self.inverse(self.root), full_matrices=False)
        return np.asarray(U[:, s**2 > MATTER * np.sum(s**2)].T @ G)


def _channel_changes(f: Fitted) -> Array:
    x, n = f.prepared[0], f.n_base
    k_ggi = f.scales[0]

    def changes(piece: Piece) -> Array:
        o = piece.observation
        g = np.array([demodulate_residual(e, o.record, k_ggi) for e in combine_output(o, piece.columns[:n])])
        return np.stack([g.real, g.imag], axis=1)[:, :, np.isfinite(g[0])]

    found = np.concatenate([*x.each(changes, whitened=False)], axis=2)  # (n, 2, instants)
    if not found.shape[2]:
        raise UserError(
            "no motion can be designed: the flight is too short to demodulate, or its disc does not turn",
            where=x.observation.name,
            remedy="give a longer flight of the motion that is to be compensated",
        )
    return np.asarray(np.stack([compute_r_factor(found[:, k]) for k in range(2)]) / np.sqrt(found.shape[2]))


@one_thread
def design_calibration(
    f: Fitted,
    limits: Mapping[str, float],
    *,
    duration: float,
    band: tuple[float, float],
    criterion: Criterion = "A",
) -> CalibrationDesign:
    """The motion of ``duration`` s, within limits and a band, Hz, that calibrates best for the motion of the flights.

    Criterion ``A``: least mean variance of inline and cross by the parameters; ``D``: least volume of the uncertainty of the
    directions that matter to them.
    """
    c = Information.of(f)
    important = c.matter()

    def worth(motion: Sequence[Sinusoid]) -> float:
        inverse = c.with_motion(motion, SIMULATED, duration)
        if criterion == "A":
            return -float(np.log(np.sum(np.square(c.channels(inverse)))))
        return -float(2 * np.sum(np.log(np.linalg.svd(important @ inverse, compute_uv=False))))

    motion = _best(worth, list_tones(f.instrument.spin_frequency, limits, band), limits)
    now, then = c.inverse(c.root), c.with_motion(motion, min(duration, LONGEST), duration)
    columns = f.calibration.columns
    determined = find_combinations(
        f.model, f.calibration.p, columns, lambda w: float(np.linalg.norm(w @ then))
    )
    return CalibrationDesign(
        sinusoids=motion,
        separations=(),
        criterion=criterion,
        parameters=tuple(
            Planned(
                q.name,
                q.accelerometer,
                q.unit,
                *(float(np.linalg.norm(x[k])) * q.scale / q.unit_factor for x in (now, then)),
            )
            for k, q in enumerate(columns)
        ),
        combinations=tuple(
            Planned(q.name, None, q.unit, *(float(np.linalg.norm(q.weights @ x)) for x in (now, then)))
            for q in determined
        ),
        now=c.channels(now),
        then=c.channels(then),
    )
