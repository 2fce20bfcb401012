"""Stretches in which a record is far noisier than elsewhere: they are no measure of its noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.signals.fir import filtered
from ragg_runtime.signals.noise_spectrum import Averages, NoiseModel, estimate
from ragg_runtime.signals.periodogram import hann

Array = NDArray[np.float64]

INTERVALS = 48
"""Stretches into which the residual is divided."""

LOUD = 4.0
"""Power of an interval over the median's of those before it, and of those after it, from which it is loud: louder than one side
alone is a noise that has changed its level."""

BESIDE = 16
"""Stretches on either side with which one is compared: twice as many as may be bursts, so that they do not shift a median."""

FEW = 1 / 6
"""Largest share of intervals that are bursts: more of them are noise whose level changes, which the estimate averages."""

MATTERS = 1.3
"""Mean power of all intervals over the median's from which bursts matter: the error then stands so far above the noise that
nothing is claimed; smaller ones stay in the noise, lest tests take them for evidence."""

TAPS = 1024
"""Length of the filter that makes the power of intervals comparable."""

ROUNDS = 3
"""Estimates, each without the bursts that the one before has shown."""


@dataclass(frozen=True)
class Burst:
    """Samples ``start`` to ``stop`` of a series, and their power over the noise's."""

    start: int
    stop: int
    factor: float


def quiet_estimate(
    residual: Sequence[Array],
    rate: float,
    without: tuple[float, float] | None = None,
    kept: Sequence[Array] | None = None,
    slow: Averages | None = None,
) -> tuple[NoiseModel, list[list[Burst]]]:
    """The spectrum of the noise from contiguous stretches of residual, bursts left out, and those of each stretch.

    ``without``, ``kept``, ``slow``: as in :func:`ragg_runtime.signals.noise_spectrum.estimate`.
    """
    model = estimate(residual, rate, without, kept, slow)
    bursts: list[list[Burst]] = [[] for _ in residual]
    for _ in range(ROUNDS):
        found = _bursts(residual, model)
        if [len(b) for b in found] == [len(b) for b in bursts]:
            break
        bursts = found
        model = _estimated(residual, bursts, rate, without, kept, slow)
    return model, bursts


def _estimated(
    residual: Sequence[Array],
    bursts: Sequence[Sequence[Burst]],
    rate: float,
    without: tuple[float, float] | None,
    kept: Sequence[Array] | None,
    slow: Averages | None,
) -> NoiseModel:
    left, heard, total = [], 0.0, 0.0
    for e, own in zip(residual, bursts, strict=True):
        e = e.copy()
        weight = hann(len(e)) ** 2  # as the periodogram of the estimate weighs the samples
        total += float(np.sum(weight))
        for b in own:
            e[b.start : b.stop] = weight[b.start : b.stop] = 0.0
        left.append(e)
        heard += float(np.sum(weight))
    model = estimate(left, rate, without, kept, slow)
    return NoiseModel(rate, model.log_f, model.log_psd + np.log(total / heard), model.spread)


def _bursts(residual: Sequence[Array], model: NoiseModel) -> list[list[Burst]]:
    taps = model.whitening_filter(TAPS)
    length = max(64, sum(len(e) for e in residual) // INTERVALS)
    intervals: list[tuple[int, int, int]] = []
    power: list[float] = []
    for k, e in enumerate(residual):
        white = filtered(e[None], taps)[0]
        for start in range(0, len(e), length):
            part = white[start : start + length]
            heard = part[e[start : start + length] != 0.0]  # what is not valid is zero
            if len(heard) > length // 2:
                intervals.append((k, start, min(start + length, len(e))))
                power.append(float(np.mean(heard**2)))
    found: list[list[Burst]] = [[] for _ in residual]
    if not power:
        return found
    middle = median(power)
    beside = [(power[max(0, n - BESIDE) : n], power[n + 1 : n + 1 + BESIDE]) for n in range(len(power))]
    near = [max(median(side) for side in sides if side) for sides in beside]
    loud = [n for n, v in enumerate(power) if v > LOUD * near[n]]
    if len(loud) > FEW * len(power) or np.mean(power) < MATTERS * middle:
        return found
    for n in loud:
        k, start, stop = intervals[n]
        found[k].append(Burst(start, stop, power[n] / near[n]))
    return found


SAID = 3
"""Most bursts that are named."""


def in_words(bursts: Sequence[tuple[int, int, float]], time: Array) -> str | None:
    """Where a record is too loud, in one sentence; ``None`` if nowhere. ``bursts`` as in ``Noise``, ``time`` (N,) s."""
    if not bursts:
        return None
    worst = sorted(bursts, key=lambda b: -b[2])[:SAID]
    intervals = ", ".join(
        f"{time[a]:.0f} to {time[min(b, len(time)) - 1]:.0f} s ({factor:.3g} times)"
        for a, b, factor in sorted(worst)
    )
    more = f" and {len(bursts) - SAID} more stretches" if len(bursts) > SAID else ""
    return f"the record is far noisier than elsewhere, in power, from {intervals}{more}: leave them out (NaN)"
