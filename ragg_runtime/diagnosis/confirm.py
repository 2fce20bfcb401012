"""What was chosen by linear tests, derived into the model and fitted anew, and what that leaves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.diagnosis.contenders import Extend
from ragg_runtime.diagnosis.strong import Stage
from ragg_runtime.evidence.random_effects import Variance, pooled
from ragg_runtime.fit import columns as design
from ragg_runtime.fit import prepared_flight
from ragg_runtime.fit.fitted import Fitted, fit
from ragg_runtime.fit.passes import Piece
from ragg_runtime.lack_of_fit import omnibus
from ragg_runtime.lack_of_fit.remainder import Remainder
from ragg_runtime.model.evaluate import vector
from ragg_runtime.model.model import Model

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Confirmed:
    """What the chosen effects of the last stage leave.

    Attributes
    ----------
    final
        The flights fitted with the chosen effects derived into the model; ``None`` if that cannot be done: then everything
        is linear.
    remainder, random
        What is left, and the random effects in it.
    """

    final: Fitted | None
    remainder: Remainder
    random: Mapping[str, Variance]


def confirmed(last: Stage, extend: Extend | None) -> Confirmed:
    """The chosen effects of the last stage fitted in the model."""
    f, field, choice = last.fitted, last.field, last.choice
    final = _derived(f, choice.chosen, extend)
    given = [n for e in choice.chosen for n, _ in field.candidates[e]]
    rem, random = _remainder(f, given) if final is None else _remainder(final, ())
    return Confirmed(final=final, remainder=rem, random=random)


def _derived(f: Fitted, chosen: Sequence[str], extend: Extend | None) -> Fitted | None:
    """The chosen effects derived into the model and everything fitted again, if that can be done."""
    steps = {e.id for e in f.model.candidates if e.kind == "step"}
    if not chosen or extend is None or (steps & set(chosen)):
        return None
    extended = extend(f.model, chosen)
    start = _linear(f, chosen, extended)
    return fit(extended, f.instrument, f.observations, f.calibration.noise, start)


def _linear(f: Fitted, chosen: Sequence[str], extended: Model) -> Array:
    """Parameter vector of the extended model as the linear fit has it, SI."""
    own = [(n, c) for n, c in enumerate(f.candidates) if c.effect in chosen]
    fitted, _ = f.coefficients([n for n, _ in own])
    columns = (*f.calibration.columns, *(c for _, c in own))
    before = (*f.calibration.p[f.calibration.index], *(0.0 for _ in own))
    value = {c.label: b + x * c.scale for c, b, x in zip(columns, before, fitted, strict=True)}
    p = vector(extended, f.instrument)
    for c, place in design.base_columns(extended, f.instrument):
        p[place] = value[c.label]
    return p


def _remainder(f: Fitted, given: Sequence[int]) -> tuple[Remainder, dict[str, Variance]]:
    """What is left once ``given`` columns are projected out, and the sums of random effects, in one pass."""
    random = _random_columns(f)
    searches, counted = [], []
    for x, triangles in zip(f.prepared, f.triangles, strict=True):
        taken = prepared_flight.projector(triangles, f.n_base, given)
        lean, projector, places = taken.lean(x, list(random.values()))

        def variances(piece: Piece, y: Array, places: Sequence[int] = places) -> dict[str, Variance]:
            return {e: Variance.of(piece, k, y) for e, k in zip(random, places, strict=True)}

        found, more = omnibus.search(lean, projector, variances)
        searches.append(found)
        counted += more
    return Remainder(tuple(searches)), {e: pooled([v[e] for v in counted]) for e in random}


def _random_columns(f: Fitted) -> dict[str, int]:
    """The place of every random effect's column."""
    if any(o.recorded.demodulated for o in f.observations):
        return {}  # neighbouring samples of a demodulated channel are not independent
    columns = f.candidates
    found = {}
    for e in f.model.candidates:
        own = [n for n, c in enumerate(columns) if c.effect == e.id]
        if e.kind == "random" and own:
            found[e.id] = f.n_base + own[0]
    return found
