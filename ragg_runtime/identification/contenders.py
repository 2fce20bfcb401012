"""Effects as contenders: derived into the model of some flights and fitted nonlinearly, and what they leave."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Protocol

import numpy as np

from ragg_runtime.estimation.calibration import charge_wider_priors, measure_to_nominal, restore_priors
from ragg_runtime.estimation.fitted import Fitted, calibrate_certain
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.model.model import Model


class Extend(Protocol):
    """Derives a model with further effects; with ``candidates`` also the signatures of the rest.

    Given by the caller: this package cannot derive.
    """

    def __call__(self, model: Model, ids: Sequence[str], /, *, candidates: bool = False) -> Model: ...


def derive_with(
    f: Fitted,
    ids: Sequence[str],
    instants: Mapping[str, float],
    extend: Extend,
    *,
    candidates: bool = False,
    held: frozenset[str] = frozenset(),
) -> tuple[Model, Instrument]:
    """The model of some flights with further effects in it, and the priors of the sheet, with the instants of steps.

    Coefficients labelled in ``held`` are not fitted.
    """
    model = extend(f.model, ids, candidates=candidates)
    steps = tuple(
        EffectSetting(e, MappingProxyType({"t_step": RawQuantity(instants[e], "s")}))
        for e in ids
        if e in instants
    )
    sheet = replace(
        restore_priors(f.instrument), effects=(*f.instrument.effects, *steps), held=f.instrument.held | held
    )
    return model, sheet


SCALES = (0.4, 0.8, 1.6, 3.2)
"""Where a fit of what has a memory begins, over the neutral value of the first of its shapes: of a resonance 2, 4, 8 and 16 Hz."""


def choose_start(f: Fitted, model: Model, sheet: Instrument, effect: str) -> Instrument:
    """The sheet with the shape of an effect that has a memory at which it leaves least, while the shape is held; from another a fit may
    end in a narrow minimum. Values that the sheet has stay.
    """
    own = next(e for e in model.effects if e.id == effect)
    shapes = [q for q in own.parameters if q.shape]
    if own.memory is None or sheet.effect(effect) not in (None, EffectSetting(effect)):
        return sheet
    others = tuple(s for s in sheet.effects if s.id != effect)
    held = sheet.held | {f"{effect}.{q.name}" for q in shapes}
    found = []
    for scale in SCALES:
        value = RawQuantity(scale * shapes[0].default, shapes[0].unit)
        begun = EffectSetting(effect, MappingProxyType({shapes[0].name: value}))
        found.append(replace(sheet, effects=(*others, begun)))
    left = [fit_contender(f, model, replace(s, held=held)).chi2 for s in found]
    return found[int(np.argmin(left))]


@dataclass(frozen=True)
class ContenderFit:
    """What effects in the model leave: chi-square, with what the parameters cost, and whether the fit came to an optimum."""

    chi2: float
    arrived: bool


def fit_contender(f: Fitted, model: Model, sheet: Instrument) -> ContenderFit:
    """What a nonlinear fit to the flights of a fit leaves with effects in the model, by its noise.

    Every parameter that only the sheet knew before, and the record does now, costs 2 (AIC).
    """
    _, instrument, c = calibrate_certain(model, sheet, f.observations, noise=f.calibration.noise)
    x = -measure_to_nominal(model, instrument, c)
    known = len(c.columns) - float(np.trace(c.covariance))
    left_out = f.calibration.rows - c.rows  # each would have its share of the noise
    own = x[[n for n, q in enumerate(c.columns) if q.effect is not None]]
    # Cauchy's tails for those of the prior: of two effects that explain the same, fifty and sixty times as large as usual,
    # Gaussian ones would exclude one, and of a fault nothing is known but what size is usual
    tails = float(np.sum(np.log1p(own**2) - own**2))
    return ContenderFit(
        chi2=c.chi2 + left_out + 2.0 * known + tails + charge_wider_priors(instrument, c),
        arrived=c.converged,
    )
