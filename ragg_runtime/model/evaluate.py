"""A model over a record: parameter vectors, output voltages in NumPy, scale factors."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import at, check_keys
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.layout import PAPER, Output, scale
from ragg_runtime.instrument.units import EOTVOS, Units, units
from ragg_runtime.model.evaluator import ChainModule, find_places
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import Record

Array = NDArray[np.float64]


def evaluate_voltages(chain: ChainModule, r: Record, p: Array, o: Output = PAPER.outputs[0]) -> Array:
    """V_j of the accelerometers of an output, (members, N), V."""
    x = r.inputs(chain)
    return np.stack(
        [chain.accelerometer(j, r.time, r.cos_phi, r.sin_phi, x, chain.values_of(j, p)) for j in o.members]
    )


def evaluate_output(chain: ChainModule, r: Record, p: Array, o: Output = PAPER.outputs[0]) -> Array:
    """An output, (N,), V (Eq. 15)."""
    return o.combined(evaluate_voltages(chain, r, p, o))


def scale_factor(model: Model, p: Array, output: int = 0) -> float:
    """k_ggi of an output, V/Eo (Eq. 30)."""
    values = name_values(model.chain, p)
    k1, R = values["k_VI"] * values["K1"], values["radius"] + values["dR"]
    return scale(model.layout.outputs[output], k1, R) * EOTVOS


def name_values(chain: ChainModule, p: Array) -> dict[str, Array]:
    """A parameter vector as name -> values (one or four)."""
    return {name: p[place] for name, place in find_places(chain).items()}


def make_vector(model: Model, instrument: Instrument) -> Array:
    """The parameter vector of ``model.chain``, SI, from model.toml's values; effects' parameters else neutral.

    UserError if model.toml gives an effect a parameter that it does not have, or one of a wrong dimension.
    """
    known = units(instrument.g0)
    layout = instrument.layout
    discs = [layout.discs[q.disc] for q in layout.places]
    values: dict[str, Array] = {
        "radius": instrument.radii,
        "spin_frequency": np.array([d.spin_frequency for d in discs]),
    }
    if layout.like_paper:  # one value each
        values = {name: v[:1] for name, v in values.items()}
    values |= {k: np.asarray(v, dtype=float) for k, v in instrument.accelerometers.items()}
    for e in model.effects:
        setting = instrument.effect(e.id) or EffectSetting(e.id)
        where = None if instrument.path is None else str(instrument.path)
        check_keys(setting.values, [q.name for q in e.parameters], at(where, "effects", e.id))
        for q in e.parameters:
            size = 1 if q.shared else layout.size
            si = known.base_unit(q.unit)
            given = setting.si(q.name, si, known.g0, shared=q.shared, where=where, count=size)
            values[q.symbol] = (
                np.full(size, q.default * find_unit_factor(q.unit, known)) if given is None else given
            )
    return np.concatenate([values[name] for name, _ in model.chain.PARAMETERS])


@cache
def find_unit_factor(unit: str, known: Units) -> float:
    """SI value of one display unit."""
    return float(known.to_si(1.0, unit, known.base_unit(unit)))
