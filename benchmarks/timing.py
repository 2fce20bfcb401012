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
    clock: Callable[[], float] = time.process_time,
    prime: bool = False,
) -> dict[str, Timing]:
    """Call every function once for nothing, then in each of ``repeats`` rounds (``inner`` times in a row, and divide by that).

    ``prime``: call each once, untimed, before its turn, so that its data are in the caches again.
    """
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


def ratio(name: str, over: Timing, under: Timing, target: str | None = None) -> Row:
    """``over`` divided by ``under``, round by round: median and quartiles; ``target``: "at most X" or "at least X"."""
    rounds = Timing(tuple(a / b for a, b in zip(over.seconds, under.seconds, strict=True)))
    low, high = rounds.quartiles
    met = None
    if target is not None:
        limit = float(target.split()[-1])
        met = rounds.median <= limit if target.startswith("at most") else rounds.median >= limit
    return Row(name, rounds.median, RATIO, target=target, low=low, high=high, met=met)
