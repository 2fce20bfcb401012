"""From the lines of the flights to numbers: how often right, how often a false alarm, how large an error."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

Line = Mapping[str, Any]
"""The JSON object of one flight (``fly``), with its ``id`` and ``kind``."""

COLUMN_KINDS = ("deterministic", "step")
"""Kinds of effects that are columns of a fit: the only ones that other methods can select."""

OURS = "ragg diagnose"


@dataclass(frozen=True)
class Share:
    """``hits`` of ``total``."""

    hits: int
    total: int

    @property
    def value(self) -> float:
        return self.hits / self.total if self.total else float("nan")

    def interval(self, z: float = 1.96) -> tuple[float, float]:
        """Wilson's 95 % interval."""
        n, p = self.total, self.value
        if not n:
            return (float("nan"), float("nan"))
        middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
        half = z / (1 + z**2 / n) * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
        return (float(middle - half), float(middle + half))


def share(lines: Iterable[Line], test: Callable[[Line], bool]) -> Share:
    """How many of the lines pass a test; those that crashed do not."""
    passed = ["crash" not in x and test(x) for x in lines]
    return Share(sum(passed), len(passed))


def truths(x: Line) -> list[str]:
    """What was hidden."""
    return [h["effect"] for h in x["hidden"]]


def is_column(x: Line) -> bool:
    """Whether all that was hidden are columns of a fit."""
    return all(h["kind"] in COLUMN_KINDS for h in x["hidden"])


def group(x: Line, effect: str) -> set[str]:
    """An effect with those that the diagnosis says it cannot tell from it."""
    twins = next((r["twins"] for r in x["ranking"] if r["effect"] == effect), [])
    return {effect, *twins}


def claimed(x: Line) -> set[str]:
    """All found effects with their groups."""
    return set().union(*(group(x, e) for e in x["found"]))


def right_first(x: Line) -> bool:
    """The hidden effect is found and ranks first, alone or in its group."""
    (truth,) = truths(x)
    return bool(x["ranking"]) and truth in group(x, x["ranking"][0]["effect"]) and truth in claimed(x)


def right_alone(x: Line) -> bool:
    """Right first, and no further effect is claimed."""
    return right_first(x) and len(x["found"]) == 1


def both(x: Line) -> bool:
    return set(truths(x)) <= claimed(x)


def exactly_both(x: Line) -> bool:
    return both(x) and len(x["found"]) == len(truths(x))


def group_size(x: Line) -> int:
    """Size of the group in which the hidden effect came first."""
    return len(group(x, x["ranking"][0]["effect"]))


def alarmed(x: Line) -> bool:
    return bool(x["verdict"] != "adequate")


def unexplained(x: Line) -> bool:
    return bool(x["verdict"] == "unexplained")


@dataclass(frozen=True)
class Peer:
    """The same questions to another method. What no method can tell from the hidden effect counts as it."""

    name: str

    def effects(self, x: Line) -> list[str]:
        return list(x["peers"][self.name]["effects"])

    @staticmethod
    def _meant(hidden: Mapping[str, Any]) -> set[str]:
        return {hidden["effect"], *hidden["twins"]}

    def alarmed(self, x: Line) -> bool:
        return bool(self.effects(x))

    def right_first(self, x: Line) -> bool:
        found = self.effects(x)
        return bool(found) and found[0] in self._meant(x["hidden"][0])

    def right_alone(self, x: Line) -> bool:
        return self.right_first(x) and len(self.effects(x)) == 1

    def both(self, x: Line) -> bool:
        found = set(self.effects(x))
        return all(found & self._meant(h) for h in x["hidden"])

    def exactly_both(self, x: Line) -> bool:
        return self.both(x) and len(self.effects(x)) == len(x["hidden"])

    def claims_nothing(self, x: Line) -> bool:
        return not self.effects(x)


def ratios(lines: Iterable[Line], which: int) -> list[float]:
    """Error after adding what was found over the oracle's: calibrated (0) or held out (1)."""
    return [x["errors"]["tool"][which] / x["errors"]["oracle"][which] for x in lines if x["errors"]]


def family_p(x: Line) -> float:
    """p-value of the best effect of an effect-free flight, corrected for the number tested."""
    best = min((r["log_p"] for r in x["ranking"]), default=0.0)
    return min(1.0, x["tested"] * float(np.exp(best)))


def remainder_p(x: Line) -> float:
    """p-value of the search of an effect-free flight's remainder, corrected for the terms tried."""
    return float(np.exp(x["remainder_log_p"]))


def of_kind(lines: Iterable[Line], *kinds: str, crashed: bool = False) -> list[Line]:
    """Lines of these kinds; with ``crashed`` also those that hold nothing but a crash."""
    return [x for x in lines if x["kind"] in kinds and (crashed or "crash" not in x)]


def crashes(lines: Iterable[Line]) -> list[Line]:
    return [x for x in lines if "crash" in x]


def by_effect(lines: Sequence[Line]) -> dict[str, dict[str, Share]]:
    """Effect -> kind of flight -> how often right first, or found among two."""
    found: dict[str, dict[str, Share]] = {}
    for kind, test in (("single-10", right_first), ("single-5", right_first), ("two", None)):
        for x in of_kind(lines, kind):
            for effect in truths(x):
                hit = test(x) if test else effect in claimed(x)
                old = found.setdefault(effect, {}).get(kind, Share(0, 0))
                found[effect][kind] = Share(old.hits + hit, old.total + 1)
    return dict(sorted(found.items()))
