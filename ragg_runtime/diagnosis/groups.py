"""What is found, each as one thing: an effect with those that the record cannot tell from it, under a name where it has one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ragg_runtime.diagnosis.line_rival import Steady
from ragg_runtime.diagnosis.ranking import Ranked


@dataclass(frozen=True)
class Group:
    """Effects that are one finding, the one that would be added first.

    ``name`` says what they make, where that is all that the record shows: ``constant term at twice the spin rate``.
    """

    effects: tuple[str, ...]
    name: str | None

    def as_json(self) -> dict[str, object]:
        return {"name": self.name, "effects": list(self.effects)}


def groups(found: Sequence[str], ranking: Sequence[Ranked], steady: Sequence[Steady]) -> tuple[Group, ...]:
    """One group of each effect that is found."""
    others = {r.effect: r.indistinguishable_from for r in ranking}
    names = {s.effect: s.name for s in steady}
    return tuple(Group(effects=(e, *others.get(e, ())), name=names.get(e)) for e in found)
