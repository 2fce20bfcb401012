"""A model over a flight: parameter vectors, inputs, output voltages and their derivatives."""

from __future__ import annotations

from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.signal import savgol_filter

from ragg_runtime.flight import Flight
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import Layout, Output, scale
from ragg_runtime.instrument.units import Units, units
from ragg_runtime.model.model import Chain, Model
from ragg_runtime.model.record import HALO, Record

Array = NDArray[np.float64]

EOTVOS = 1e-9
"""1 Eo in s^-2."""


SPIN = ("d_spin_angle", "d2_spin_angle")
"""Rate and acceleration of the disc angle: in every record, with an encoder or without."""

SPIN_WINDOW = 0.6
"""Half the stretch, s, over which the encoder's angle is smoothed for its rate: its steps of some microradians, twice
differentiated, would be noise of many eotvos, and a disc does not swing faster than a few times a turn."""

_SPIN_DEGREE = 4


def spin(name: str, encoder: Array | None, samples: int, rate: float, spin_frequency: float) -> Array:
    """Rate, rad/s, or acceleration, rad/s^2, of the disc angle, (samples,), by the encoder (rad) if there is one.

    By least squares a polynomial of the fourth degree is laid through ``SPIN_WINDOW`` on either side of a sample.
    """
    order = SPIN.index(name) + 1
    if encoder is None:
        return np.full(samples, 2 * np.pi * spin_frequency if order == 1 else 0.0)
    half = min(max(round(SPIN_WINDOW * rate), _SPIN_DEGREE), HALO, (samples - 1) // 2)
    if 2 * half < _SPIN_DEGREE:
        return np.full(samples, np.nan)
    angle = np.unwrap(encoder)
    smooth = savgol_filter(angle - angle[0], 2 * half + 1, _SPIN_DEGREE, deriv=order, delta=1 / rate)
    return np.asarray(smooth, dtype=np.float64)


Kind = Literal["voltages", "G_out", "channels"]
"""What of an output a flight holds: its accelerometers' voltages, itself, or what a demodulator has made of it."""


def recorded(flight: Flight, layout: Layout, place: int) -> Kind | None:
    """What of an output was recorded, the most telling; ``None``: nothing."""
    o = layout.outputs[place]
    if layout.voltages(o, flight.outputs) is not None:
        return "voltages"
    if o.name in flight.outputs:
        return "G_out"
    return "channels" if len(layout.outputs) == 1 else None


STANDING = 1e-3
"""Range of a recorded disc angle, rad, below which the disc stands still."""


def phase(g: complex) -> float:
    """rad, between -pi and pi; 0 of a real number, whatever its sign: that is the sign of the scale factor."""
    return 0.0 if abs(g.imag) <= 1e-12 * abs(g) else float(np.angle(g))


def voltages(chain: Chain, r: Record, p: Array, o: Output) -> Array:
    """V_j of the accelerometers of an output, (members, N), V."""
    x = r.inputs(chain)
    return np.stack(
        [chain.accelerometer(j, r.time, r.cos_phi, r.sin_phi, x, chain.values_of(j, p)) for j in o.members]
    )


def output(chain: Chain, r: Record, p: Array, o: Output) -> Array:
    """An output, (N,), V (Eq. 15)."""
    return o.combined(voltages(chain, r, p, o))


def scale_factor(model: Model, p: Array, output: int = 0) -> float:
    """k_ggi of an output, V/Eo (Eq. 30)."""
    values = named(model.chain, p)
    k1, R = values["k_VI"] * values["K1"], values["radius"] + values["dR"]
    return scale(model.layout.outputs[output], k1, R) * EOTVOS


def named(chain: Chain, p: Array) -> dict[str, Array]:
    """A parameter vector as name -> values (one or four)."""
    result, start = {}, 0
    for name, size in chain.PARAMETERS:
        result[name] = p[start : start + size]
        start += size
    return result


def vector(model: Model, instrument: Instrument) -> Array:
    """The parameter vector of ``model.chain``, SI, from model.toml's values; neutral where none is given."""
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
    settings = {s.id: s for s in instrument.effects}
    for e in model.effects:
        setting = settings.get(e.id)
        for q in e.parameters:
            size = 1 if q.shared else layout.size
            given = setting.values.get(q.name) if setting else None
            if given is None:
                values[q.symbol] = np.full(size, (q.neutral or 0.0) * unit_factor(q.unit, known))
            else:
                si = known.base_unit(q.unit)
                value = known.to_si(np.asarray(given.value), given.unit, si, f"effect {e.id}, {q.name}")
                values[q.symbol] = np.broadcast_to(value, size).astype(float)
    return np.concatenate([values[name] for name, _ in model.chain.PARAMETERS])


@cache
def unit_factor(unit: str, known: Units) -> float:
    """SI value of one display unit."""
    return float(known.to_si(1.0, unit, known.base_unit(unit)))
