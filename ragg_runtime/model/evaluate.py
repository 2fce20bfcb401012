"""A model over a record: parameter vectors, output voltages, scale factors."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import at, check_keys
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.layout import PAPER, Output, scale
from ragg_runtime.instrument.units import EOTVOS, Units
from ragg_runtime.model.chain import Chain
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import Record

Array = NDArray[np.float64]


def evaluate_voltages(chain: Chain, r: Record, p: Array, o: Output = PAPER.outputs[0]) -> Array:
    """V_j of the accelerometers of an output, (members, N), V."""
    return chain.voltages(r.time, r.inputs(chain), p, r.phi, o.members)


def evaluate_output(chain: Chain, r: Record, p: Array, o: Output = PAPER.outputs[0]) -> Array:
    """An output, (N,), V (Eq. 15)."""
    return o.combined(evaluate_voltages(chain, r, p, o))


def scale_factor(model: Model, p: Array, output: int = 0) -> float:
    """k_ggi of an output, V/Eo (Eq. 30)."""
    values = name_values(model.chain, p)
    k1, R = values["k_VI"] * values["K1"], values["radius"] + values["dR"]
    return scale(model.layout.outputs[output], k1, R) * EOTVOS


def name_values(chain: Chain, p: Array) -> dict[str, Array]:
    """A parameter vector as name -> values (one or four)."""
    return {name: p[place] for name, place in chain.places.items()}


def make_vector(model: Model, instrument: Instrument) -> Array:
    """The parameter vector of ``model.chain``, SI, from model.toml's values; effects' parameters else neutral.

    UserError if model.toml gives an effect a parameter that it does not have, or one of a wrong dimension.
    """
    known, layout = instrument.units, instrument.layout
    spins = np.array([layout.discs[q.disc].spin_frequency for q in layout.places])
    values = {"radius": instrument.radii, "spin_frequency": spins}
    if layout.like_paper:  # one value each
        values = {name: v[:1] for name, v in values.items()}
    values |= instrument.accelerometers
    for e in model.effects:
        setting = instrument.effect(e.id) or EffectSetting(e.id)
        where = None if instrument.path is None else str(instrument.path)
        check_keys(setting.values, [q.name for q in e.parameters], at(where, "effects", e.id))
        for q in e.parameters:
            size, si = 1 if q.shared else layout.size, known.base_unit(q.unit)
            given = setting.si(q.name, si, known.g0, shared=q.shared, where=where, count=size)
            neutral = np.full(size, q.default * find_unit_factor(q.unit, known))
            values[q.symbol] = neutral if given is None else given
    return np.concatenate([values[name] for name, _ in model.chain.PARAMETERS])


@cache
def find_unit_factor(unit: str, known: Units) -> float:
    """SI value of one display unit."""
    return float(known.to_si(1.0, unit, known.base_unit(unit)))
