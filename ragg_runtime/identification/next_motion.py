"""Which motion to fly next: for every pair of rivals the sinusoid about one axis, within limits, that separates them best.

Separation is what of one effect's fitted signal neither the model nor the rival can imitate, in standard deviations.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.linearise import Point, linearised
from ragg_runtime.estimation.square_root import triangle
from ragg_runtime.identification.selection import Field
from ragg_runtime.io.record import is_disc_angle
from ragg_runtime.signals.fir import filtered

Array = NDArray[np.float64]
Sinusoid = tuple[str, float, float, float]
"""Axis, frequency, Hz, amplitude, SI, and phase, rad."""

RATIOS = (0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0)
"""Frequencies that are tried, over the spin frequency."""

HIGHEST = 0.2
"""Highest frequency of a motion over the rate of its record: the record must hold its rate of change as well."""

WORTHWHILE = 1.05
"""Factor by which a motion must part two effects farther than a longer record of what there is already."""

AXES = ("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z")

LIMITS: Mapping[str, float] = {"a": 0.49, "omega": 2.4e-3}
"""Largest amplitudes, m/s^2 and rad/s: 50 mg and 500 deg/h, what a stabilised platform lets through."""

SIMULATED = 96.0
"""Length of the motion that is computed, s."""

DURATION = 600.0
"""Length of the motion that is proposed, s; information grows with it."""

AT_REST = 0.25
"""What counts as the spin frequency of a disc that stands still, Hz: the paper's."""

APART = 3.0
"""Standard deviations at which two effects count as told apart."""

RIVALS = 3
"""Most rivals of an effect for which a motion is sought."""


@dataclass(frozen=True)
class Proposal:
    """A motion that separates ``effect`` from ``rival``.

    ``amplitude`` in SI, m/s^2 or rad/s; ``ratio`` is its frequency over the spin's; ``now`` and ``then`` are
    the separations, in standard deviations, of the record as it is and with ``duration`` s of the motion.
    """

    effect: str
    rival: str
    axis: str
    ratio: float
    frequency: float
    amplitude: float
    duration: float
    now: float
    then: float

    @property
    def separates(self) -> bool:
        """Whether the motion would tell the two apart."""
        return self.then > APART

    def in_words(self) -> str:
        """One sentence."""
        if not self.separates:
            return (
                f"no motion within the limits tells {self.effect} from {self.rival}: they act alike"
                f" (at best {self.then:.1g} sigma)"
            )
        if self.axis.startswith("a_"):
            size = f"{self.amplitude / 9.80665e-3:.3g} mg"
        else:
            size = f"{np.rad2deg(self.amplitude) * 3600:.3g} deg/h"
        return (
            f"to tell {self.effect} from {self.rival}: {self.duration:.0f} s of {self.axis} = {size} at"
            f" {self.frequency:.4g} Hz ({self.ratio:g} x spin): {self.now:.2g} -> {self.then:.3g} sigma"
        )

    def as_json(self) -> dict[str, object]:
        return {
            "effect": self.effect,
            "rival": self.rival,
            "axis": self.axis,
            "frequency_over_spin": self.ratio,
            "frequency_Hz": self.frequency,
            "amplitude": self.amplitude,
            "unit": "m/s^2" if self.axis.startswith("a_") else "rad/s",
            "duration_s": self.duration,
            "separation_now": self.now,
            "separation_then": self.then,
            "separates": self.separates,
        }


@dataclass(frozen=True)
class Pairs:
    """Pairs (effect, rival) of which flights have columns: ``places`` of the base's, then the rivals' columns among all;
    ``signals`` (effects, size) are the coefficients of every effect with a rival.
    """

    f: Fitted
    known: Sequence[tuple[str, str]]
    places: Sequence[int]
    rivals: Mapping[str, Sequence[int]]
    signals: Mapping[str, Array]
    _means: dict[int, Mapping[str, float]] = field(default_factory=dict, repr=False)

    @staticmethod
    def of(f: Fitted, field: Field, pairs: Sequence[tuple[str, str]]) -> Pairs:
        known = [(e, r) for e, r in pairs if e in field.candidates and r in field.candidates]
        own = {r: [f.n_base + n for n, _ in field.candidates[r]] for _, r in known}
        places = [*range(f.n_base), *sorted({k for some in own.values() for k in some})]
        rivals = {r: [places.index(k) for k in some] for r, some in own.items()}
        signals = {e: signal_of(f, field, e) for e, _ in known}
        return Pairs(f=f, known=known, places=places, rivals=rivals, signals=signals)

    @cached_property
    def root(self) -> Array:
        """(k, k): triangle of [places | signals] of the flights, the prior in it."""
        signals = [self.f.whole[:, :-1] @ v for v in self.signals.values()]
        return np.asarray(np.linalg.qr(np.column_stack([self.f.whole[:, self.places], *signals]), mode="r"))

    def separations(self, *further: Array) -> list[float]:
        """Of every pair, with further rows (n, k) beside the flights."""
        rows, names = np.vstack([self.root, *further]), list(self.signals)
        return [
            separation(rows, self.f.n_base, self.rivals[r], len(self.places) + names.index(e))
            for e, r in self.known
        ]

    @cached_property
    def at(self) -> Point:
        """About what motions are linearised: of the candidates no columns but those that are needed."""
        n = self.f.n_base
        needed = {*self.places[n:], *(int(k) for v in self.signals.values() for k in np.flatnonzero(v))}
        return replace(self.f.prepared[0].at, only=tuple(sorted(k - n for k in needed)))

    def rows(
        self, motion: Sequence[Sinusoid], *, simulated: float = SIMULATED, duration: float = DURATION
    ) -> Array:
        """Triangle (k, k) of [places | signals] of a motion, ``simulated`` s of it, weighted for ``duration``, whitened."""
        prepared, at = self.f.prepared[0], self.at
        o, noise = prepared.observation, prepared.noise
        n = int(simulated * o.record.rate)
        time = np.arange(n) / o.record.rate
        channels = {name: np.full(n, mean) for name, mean in self._calm(n).items()}
        channels |= moved(channels, motion, time)
        r = replace(o.record, time=time, wide=channels, valid=np.ones(n, dtype=np.bool_), halo=(0, 0))
        series = (np.zeros(n),) * len(o.series)
        made = replace(o, record=r, series=series, name="motion", thin=None, memo=[])
        X = linearised(at, made)[:-1]
        there = [*range(self.f.n_base), *(self.f.n_base + k for k in at.only or ())]
        signals = np.tensordot(np.array([v[there] for v in self.signals.values()]), X, 1)
        X = np.concatenate([X[[there.index(k) for k in self.places]], signals])
        white = [filtered(noise.series(X, m), taps[:n]) for m, taps in enumerate(noise.filters)]
        return np.asarray(np.sqrt(duration / simulated) * triangle(np.concatenate(white, axis=1)))

    def _calm(self, samples: int) -> Mapping[str, float]:
        """Means of the channels over so many samples of the flight's beginning."""
        if samples not in self._means:
            r = self.f.prepared[0].observation.record
            first = r.part(slice(0, min(len(r.time), samples)))
            self._means[samples] = {
                name: float(np.mean(x[first.valid])) if first.valid.any() else 0.0
                for name, x in first.channels.items()
                if not is_disc_angle(name)
            }
        return self._means[samples]


def proposals(
    f: Fitted, field: Field, pairs: Sequence[tuple[str, str]], limits: Mapping[str, float] = LIMITS
) -> list[Proposal]:
    """The best motion for every pair (effect, rival), the separation that it promises beside today's."""
    asked = Pairs.of(f, field, pairs)
    if not asked.known:
        return []

    def separations(motion: Sequence[Sinusoid]) -> list[float]:
        return asked.separations(asked.rows(motion))

    first = f.prepared[0].observation.record
    spin, rate = abs(first.spin_frequency) or AT_REST, first.rate
    motions = [
        (axis, ratio, limits[kind(axis)])
        for axis in AXES
        for ratio in RATIOS
        if ratio * spin <= HIGHEST * rate
    ]
    still, *moving = map(separations, [(), *([(axis, k * spin, size, 0.0)] for axis, k, size in motions)])
    found = []
    for n, ((e, r), now) in enumerate(zip(asked.known, asked.separations(), strict=True)):
        best = max(range(len(motions)), key=lambda m: moving[m][n], default=None)
        if best is None or moving[best][n] <= WORTHWHILE * still[n]:
            continue
        axis, ratio, size = motions[best]
        found.append(
            Proposal(
                effect=e,
                rival=r,
                axis=axis,
                ratio=ratio,
                frequency=ratio * spin,
                amplitude=size,
                duration=DURATION,
                now=now,
                then=moving[best][n],
            )
        )
    return found


def signal_of(f: Fitted, field: Field, effect: str) -> Array:
    """Coefficients (size,) of an effect alone, as the record has it."""
    extra = field.testable(effect)
    c, _ = f.coefficients(extra)
    v = f.vector(c, extra)
    v[: f.n_base] = 0.0
    return v


def separation(rows: Array, n_base: int, rival: Sequence[int], signal: int) -> float:
    """Norm of a signal, a column of rows (n, k), once base (with its prior) and the rival's columns are projected out."""
    R = np.asarray(np.linalg.qr(rows[:, [*range(n_base), *rival, signal]], mode="r"))
    return float(abs(R[-1, -1]))


def moved(calm: Mapping[str, Array], motion: Sequence[Sinusoid], time: Array) -> dict[str, Array]:
    """The channels (N,) that sinusoids move, and their angular accelerations, beside what they are without."""
    found: dict[str, Array] = {}
    for axis, frequency, amplitude, phase in motion:
        w = 2 * np.pi * frequency
        found[axis] = found.get(axis, calm[axis]) + amplitude * np.sin(w * time + phase)
        if axis.startswith("omega_"):
            name = axis.replace("omega_", "omegadot_")
            found[name] = found.get(name, calm[name]) + amplitude * w * np.cos(w * time + phase)
    return found


def kind(axis: str) -> str:
    """Which of the limits an axis has."""
    return axis.partition("_")[0]


def pairs_of(groups: Mapping[str, Sequence[str]]) -> list[tuple[str, str]]:
    """(effect, rival) of groups that the record cannot split."""
    return [(e, r) for e, rivals in groups.items() for r in rivals[:RIVALS]]
