"""How probable each effect is, those included that were derived into the model one after the other."""

from __future__ import annotations

import math
from collections.abc import Container, Sequence
from dataclasses import replace

from ragg_runtime.diagnosis.ranking import Ranked
from ragg_runtime.diagnosis.strong import Taken
from ragg_runtime.evidence import probability
from ragg_runtime.evidence.probability import Probabilities
from ragg_runtime.evidence.selection import Field


def weighed(field: Field, steps: Sequence[Taken]) -> Probabilities:
    """The probabilities of what is left, and of what is in the model: there rivals that would do as well share alike."""
    sets = probability.weighed(field)
    for t in steps:
        sets = sets.with_one_of((t.effect, *t.rivals))
    return sets.probabilities()


def with_probability(r: Ranked, found: Probabilities, columns: Container[str]) -> Ranked:
    """The row with its effect's probability.

    Of an effect that has ``columns`` but is in none of the sets, the model has another one that explains the same, and better, or
    does as well without it: none. Random effects and those of the output channel are no columns, and not enumerated: there it
    is the largest that the p-value allows at even odds, 1 / (1 - e p ln p) (T. Sellke, M. Bayarri, J. Berger, Am. Stat. 55, 2001).
    """
    if r.effect in found.of or r.effect in columns:
        return replace(r, probability=found.of.get(r.effect, 0.0))
    if r.log_p >= -1.0:
        return replace(r, probability=0.5)
    bound = -math.exp(1.0 + r.log_p) * r.log_p if r.log_p > -700.0 else 0.0
    return replace(r, probability=1.0 / (1.0 + bound))
