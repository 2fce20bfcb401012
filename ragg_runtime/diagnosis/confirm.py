"""What was chosen by linear tests, derived into the model and fitted anew, and what that leaves.

A linear test cannot tell effects apart whose signatures agree to first order. Where the chosen one, in the model, leaves
something that stands out, and a rival that the tests hold to be as good leaves nothing, it is the rival. Nor does it know how large an
effect may be: where the model leaves more than was promised, effects that it does as well without are none.
"""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.diagnosis.contenders import Extend
from ragg_runtime.diagnosis.impossible import impossible
from ragg_runtime.diagnosis.strong import Stage
from ragg_runtime.evidence import selection
from ragg_runtime.evidence.random_effects import Variance, pooled
from ragg_runtime.evidence.selection import Choice, Field
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
    """The choice that stands, and what it leaves.

    Attributes
    ----------
    field, choice
        Of the stage, without effects that turned out to be none, and with rivals in the place of what they beat.
    final
        The flights fitted with the chosen effects derived into the model; ``None`` if that cannot be done: then everything
        is linear.
    remainder, random
        What is left, and the random effects in it.
    """

    field: Field
    choice: Choice
    final: Fitted | None
    remainder: Remainder
    random: Mapping[str, Variance]


def confirmed(last: Stage, extend: Extend | None) -> Confirmed:
    """The chosen effects of the last stage, or rivals, fitted in the model."""
    f, field, choice = last.fitted, last.field, last.choice
    final = _derived(f, choice.chosen, extend)
    while final is not None and (wrong := impossible(final, choice.chosen)):
        field = _without(field, wrong)
        choice = selection.choose(field)
        final = _derived(f, choice.chosen, extend)
    given = [n for e in choice.chosen for n, _ in field.candidates[e]]
    rem, random = _remainder(f, given) if final is None else _remainder(final, ())
    found = Confirmed(field=field, choice=choice, final=final, remainder=rem, random=random)
    if final is None or not rem.significant:
        return found
    for other in _others(field, choice):
        final = _derived(f, other.chosen, extend)
        if final is None or impossible(final, other.chosen):
            continue
        rem, random = _remainder(final, ())
        if not rem.significant:
            return Confirmed(field=field, choice=other, final=final, remainder=rem, random=random)
    return found


def _without(field: Field, effects: Container[str]) -> Field:
    """The field without some of its effects."""
    return replace(field, candidates={e: c for e, c in field.candidates.items() if e not in effects})


def _chosen(
    field: Field, choice: Choice, chosen: Sequence[str], blocks: Mapping[str, tuple[int, ...]]
) -> Choice:
    """The choice with other effects chosen, of each the columns that its test needs."""
    chi2 = field.joint([blocks[e] for e in chosen])[0] if chosen else 0.0
    return replace(choice, chosen=tuple(chosen), blocks=blocks, conditional=field.tests(chosen), chi2=chi2)


def _others(field: Field, choice: Choice) -> list[Choice]:
    """The choice with each rival in the place of the effect that it cannot be told from."""
    found = []
    for e, rivals in selection.rivals(field, choice).items():
        tests = field.tests([o for o in choice.chosen if o != e])
        for r in rivals:
            chosen = tuple(r if o == e else o for o in choice.chosen)
            blocks = {o: choice.blocks[o] for o in chosen if o != r} | {r: tests[r].which}
            found.append(_chosen(field, choice, chosen, blocks))
    return found


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
