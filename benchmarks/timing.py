"""Timing: functions in turn, so that whatever else the machine does strikes all of them alike."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from benchmarks import RATIO, Row


@dataclass(frozen=True)
class Timing:
    """Times of one function, s, in the order of the rounds."""

    seconds: tuple[float, ...]

    @property
    def median(self) -> float:
        return statistics.median(self.seconds)

    @property
    def least(self) -> float:
        return min(self.seconds)

    @property
    def quartiles(self) -> tuple[float, float]:
        if len(self.seconds) < 2:
            return self.seconds[0], self.seconds[0]
        low, _, high = statistics.quantiles(self.seconds, n=4, method="inclusive")
        return low, high


def interleaved(
    functions: Mapping[str, Callable[[], object]],
    repeats: int,
    inner: int = 1,
    warm: bool = True,
    clock: Callable[[], float] = time.perf_counter,
    prime: bool = False,
) -> dict[str, Timing]:
    """Call every function once in each of ``repeats`` rounds (``inner`` times in a row, and divide by that).

    ``warm``: call each once before, untimed (compilation, caches). ``clock``: ``time.process_time`` for work on
    one core of a machine that others use too. ``prime``: call each once, untimed, before its turn, so that its
    data are in the caches again.
    """
    if warm:
        for function in functions.values():
            function()
    times: dict[str, list[float]] = {name: [] for name in functions}
    for _ in range(repeats):
        for name, function in functions.items():
            if prime:
                function()
            start = clock()
            for _ in range(inner):
                function()
            times[name].append((clock() - start) / inner)
    return {name: Timing(tuple(t)) for name, t in times.items()}


def ratio(over: Timing, under: Timing) -> Row:
    """``over`` divided by ``under``, round by round: median and quartiles. Name and target are for the caller."""
    rounds = Timing(tuple(a / b for a, b in zip(over.seconds, under.seconds, strict=True)))
    low, high = rounds.quartiles
    return Row("", rounds.median, RATIO, low=low, high=high)


def fixed_peer() -> Callable[[], object]:
    """A fixed piece of work of the kind a diagnosis does, some 0.1 s: a ratio to it outlives the machine.

    NumPy alone, never to be changed: QR of 10,000 x 60, a Fourier transform of 2^18, sines of 10^6.
    """
    import numpy as np

    draw = np.random.default_rng(0)
    A, x = draw.standard_normal((10_000, 60)), draw.standard_normal(2**18)
    angle = np.linspace(0.0, 1e3, 1_000_000)

    def work() -> object:
        return np.linalg.qr(A, mode="r"), np.fft.rfft(x), np.sin(angle)

    return work


def against_fixed_peer(
    functions: Mapping[str, Callable[[], object]],
    repeats: int = 3,
    targets: Mapping[str, float] | None = None,
    warm: bool = True,
) -> list[Row]:
    """Seconds of each function, and its ratio to :func:`fixed_peer`, measured in turn.

    ``targets``: name -> largest number of seconds that was aimed at.
    """
    peer = fixed_peer()
    found = interleaved({**functions, "fixed peer": peer}, repeats, warm=warm)
    rows = []
    for name in functions:
        low, high = found[name].quartiles
        median, limit = found[name].median, (targets or {}).get(name)
        goal = {} if limit is None else {"target": f"at most {limit:g} s", "met": median <= limit}
        rows.append(Row(name, median, "s", low=low, high=high, **goal))
        r = ratio(found[name], found["fixed peer"])
        rows.append(Row(f"{name}, to the fixed peer", r.value, RATIO, low=r.low, high=r.high))
    return rows
