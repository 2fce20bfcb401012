"""A multisine about all axes that tells apart, within limits, all effects that a record cannot.

The design is D_s-optimal, compound over all pairs (A. Atkinson, A. Donev, R. Tobias, Optimum Experimental Designs, 2007, ch. 10 and
21); amplitudes by SLSQP (D. Kraft 1988), phases by M. Schroeder (IEEE Trans. Inf. Theory 16, 1970).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from ragg_runtime.base.threads import one_thread
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.identification.next_motion import AT_REST, AXES, RATIOS, Pairs, Sinusoid, kind
from ragg_runtime.identification.selection import field_of, testable_effects

Array = NDArray[np.float64]
Tone = tuple[str, float, float]
"""Axis, frequency, Hz, and largest amplitude, SI."""
Worth = Callable[[Sequence[Sinusoid]], float]

SLOPES = {"a": "jerk", "omega": "alpha"}
"""The limit of the rate of change of each kind of motion, m/s^3 and rad/s^2; where it is not given there is none."""

GRID = (*RATIOS, 6.0, 8.0, 12.0)
"""Frequencies of the multisine, over the spin frequency."""

CANDIDATES = 12
"""Sinusoids among which amplitudes are shared out: those that alone are worth most."""

STEP = 0.02
"""Share of a limit by which an amplitude is moved to find the slope of the criterion."""

LEAST = 0.02
"""Share of a limit below which a sinusoid is left out."""

ITERATIONS = 25
"""Of the programming; the criterion is flat about its maximum."""

LONGEST = 1800.0
"""Length of the motion for which separations are predicted, s; those of a longer one grow with the root of its length."""


@dataclass(frozen=True)
class Separation:
    """By how many standard deviations a rival is ruled out if ``effect`` is what is there: now, and once the motion has been flown."""

    effect: str
    rival: str
    now: float
    then: float

    def as_json(self) -> dict[str, object]:
        return {"effect": self.effect, "rival": self.rival, "now": self.now, "then": self.then}


@dataclass(frozen=True)
class Design:
    """The multisine and what it promises."""

    sinusoids: tuple[Sinusoid, ...]
    separations: tuple[Separation, ...]


@one_thread
def design(
    f: Fitted,
    pairs: Sequence[tuple[str, str]],
    limits: Mapping[str, float],
    *,
    duration: float,
    band: tuple[float, float],
) -> Design | None:
    """The motion of ``duration`` s with frequencies within ``band``, Hz, that is best for these pairs of rivals.

    ``None`` if there is nothing to tell apart, or no frequency within the band.
    """
    # which of the two is there is not known
    both = dict.fromkeys([*pairs, *((r, e) for e, r in pairs)])
    asked = Pairs.of(f, field_of(f, testable_effects(f)), list(both))
    tones = tones_of(f.instrument.spin_frequency, limits, band)
    if not asked.known or not tones:
        return None

    def worth(motion: Sequence[Sinusoid]) -> float:
        there = asked.separations(asked.rows(motion, duration=duration))
        return float(np.sum(np.log1p(np.square(there))))

    alone = [worth([(*t, 0.0)]) for t in tones]
    best = sorted(range(len(tones)), key=lambda n: (-alone[n], n))[:CANDIDATES]
    tones = [tones[n] for n in sorted(best)]
    found = max((_climbed(worth, tones, limits, x) for x in _starts(tones, alone, best)), key=lambda x: x[1])
    motion = multisine(tones, found[0])
    length = min(duration, LONGEST)
    then = asked.separations(asked.rows(motion, simulated=length, duration=duration))
    return Design(
        sinusoids=motion,
        separations=tuple(
            Separation(effect=e, rival=r, now=now, then=later)
            for (e, r), now, later in zip(asked.known, asked.separations(), then, strict=True)
        ),
    )


def tones_of(spin: float, limits: Mapping[str, float], band: tuple[float, float]) -> list[Tone]:
    """The sinusoids within a band."""
    found = []
    for axis in AXES:
        for ratio in GRID:
            frequency = ratio * (abs(spin) or AT_REST)
            if band[0] <= frequency <= band[1]:
                slope = limits.get(SLOPES[kind(axis)], np.inf) / (2 * np.pi * frequency)
                found.append((axis, frequency, float(min(limits[kind(axis)], slope))))
    return found


def _starts(tones: Sequence[Tone], alone: Sequence[float], best: Sequence[int]) -> list[Array]:
    """Shares of the largest amplitudes: all alike, and the best sinusoid of every axis."""
    axes = [axis for axis, _, _ in tones]
    order = {n: k for k, n in enumerate(sorted(best))}
    first = np.full(len(tones), STEP)
    for axis in dict.fromkeys(axes):
        own = [n for n in best if axes[order[n]] == axis]
        first[order[max(own, key=lambda n: alone[n])]] = 1.0 - STEP * len(own)
    return [even(tones), first]


def even(tones: Sequence[Tone]) -> Array:
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
        rows.append(own * size / limits[kind(axis)])
        slope = limits.get(SLOPES[kind(axis)])
        if slope is not None:
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
