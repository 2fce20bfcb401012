"""Lines and jumps in what a fit leaves, found in the residual and fitted beside the model's columns before the noise is estimated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.spectrum import LOWEST, periodogram, without_lines

Array = NDArray[np.float64]

JUMP = 12.0
"""Robust standard deviations of the difference of the means of two neighbouring windows from which it is a jump: noise,
red or white, stays below 6 in a day."""

WINDOW = 10.0
"""Length of those windows, s."""


MOST = 8
"""Most lines, and most jumps, of a stretch."""


@dataclass(frozen=True)
class Disturbance:
    """A line, Hz, or a jump, s since the first sample of the stretch; ``size``: its amplitude over the noise's rms."""

    kind: str
    at: float
    size: float

    def columns(self, time: Array) -> Array:
        """(k, N): what it spans; a line may be off its frequency a little."""
        if self.kind == "jump":
            return np.where(time >= self.at, 1.0, 0.0)[None]
        phase = 2 * np.pi * self.at * time
        slow = np.linspace(-1.0, 1.0, len(time))
        return np.stack([np.cos(phase), np.sin(phase), slow * np.cos(phase), slow * np.sin(phase)])


def disturbances(
    rest: Array, valid: NDArray[np.bool_], rate: float, without: tuple[float, float] | None = None
) -> list[Disturbance]:
    """Those in a residual (N,), zero where it is not valid; no lines in a band (from, to, Hz) that has lost its noise."""
    return [*_lines(rest, rate, without), *_jumps(rest, valid, rate)]


def _lines(rest: Array, rate: float, without: tuple[float, float] | None) -> list[Disturbance]:
    f, p = (x[LOWEST:-1] for x in periodogram(rest, rate))
    if without is not None:
        kept = (f < without[0]) | (f > without[1])
        f, p = f[kept], p[kept]
    quiet = without_lines(p)
    high = np.flatnonzero(p > quiet)
    noise = float(np.sqrt(np.sum(quiet) * (f[1] - f[0])))
    found: list[Disturbance] = []
    for k in sorted(high, key=lambda k: -p[k]):
        if len(found) == MOST:
            break
        if k in (0, len(p) - 1) or p[k] < max(p[k - 1], p[k + 1]):
            continue
        # the logarithm of a Hann window's peak is nearly a parabola
        a, b, c = np.log(p[k - 1 : k + 2])
        shift = 0.5 * (a - c) / (a - 2 * b + c) if a + c < 2 * b else 0.0
        power = float(np.sum(p[max(0, k - 2) : k + 3])) * (f[1] - f[0])
        found.append(
            Disturbance("line", float(f[k] + shift * (f[1] - f[0])), float(np.sqrt(2 * power)) / noise)
        )
    return found


def _jumps(rest: Array, valid: NDArray[np.bool_], rate: float) -> list[Disturbance]:
    w = max(8, round(WINDOW * rate))
    n = len(rest)
    if n < 8 * w:
        return []
    total, count = (np.concatenate([[0.0], np.cumsum(x)]) for x in (rest, valid.astype(np.float64)))
    k = np.arange(w, n - w + 1)
    before, after = count[k] - count[k - w], count[k + w] - count[k]
    enough = (before > w / 2) & (after > w / 2)
    means = (total[k + w] - total[k]) / np.maximum(after, 1) - (total[k] - total[k - w]) / np.maximum(
        before, 1
    )
    step = np.where(enough, means, 0.0)
    spread = 1.4826 * float(np.median(np.abs(step[enough]))) if enough.any() else 0.0
    noise = float(np.median(np.abs(rest[valid]))) * 1.4826
    found: list[Disturbance] = []
    left = np.abs(step)
    while spread > 0.0 and len(found) < MOST and left.max() > JUMP * spread:
        at = int(np.argmax(left))
        found.append(Disturbance("jump", float(k[at] / rate), float(left[at]) / max(noise, 1e-300)))
        left[max(0, at - w) : at + w] = 0.0
    return found


def in_words(found: Sequence[Disturbance]) -> str | None:
    """One sentence on them; ``None`` if there are none."""
    lines = sorted({float(f"{d.at:.4g}") for d in found if d.kind == "line"})
    jumps = sorted({round(d.at) for d in found if d.kind == "jump"})
    said = []
    if lines:
        said.append("lines at " + ", ".join(f"{x:.4g} Hz" for x in lines[:MOST]))
    if jumps:
        said.append("jumps at " + ", ".join(f"{x} s" for x in jumps[:MOST]))
    return "the output has " + " and ".join(said) if said else None
