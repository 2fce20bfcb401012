"""What of a flight is fitted: the four voltages, G_out, or the demodulated channels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime.base.errors import UserError
from ragg_runtime.fit.segments import ROWS
from ragg_runtime.flight import Flight
from ragg_runtime.flight.output_effects.saturation import saturation
from ragg_runtime.flight.range_end import motion_at_the_end
from ragg_runtime.flight.spool import let_go
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import PAPER, Output, scale
from ragg_runtime.model.record import Record, record, recorded
from ragg_runtime.signals.demodulate import low_pass
from ragg_runtime.signals.noise_spectrum import Noise

Array = NDArray[np.float64]

MOTION_SATURATION = "motion-saturation"
"""Effect with which a model leaves out the samples at which a motion sensor is at the end of its range."""


def observations_of(flights: Sequence[Flight], instrument: Instrument) -> list[Observation]:
    """Every output of every flight: several where the layout has several, those that were recorded."""
    found = []
    for x in flights:
        kinds = [recorded(x, instrument.layout, k) for k in range(len(instrument.layout.outputs))]
        found += [observe(x, instrument, k) for k, kind in enumerate(kinds) if kind]
    return found


def observe(flight: Flight, instrument: Instrument, place: int = 0) -> Observation:
    """The most telling form of an output of a flight: its voltages if recorded, else G_out, else the channels."""
    layout = instrument.layout
    o = layout.outputs[place]
    r = record(flight, instrument, place)
    kind = recorded(flight, layout, place)
    if kind is None:
        raise UserError(f"the flight does not hold the output {o.name}", where=flight.path or flight.name)
    if kind == "voltages":
        series = tuple(flight.outputs[v] for v in layout.voltages(o, flight.outputs) or ())
    elif kind == "G_out":
        series = (flight.outputs[o.name],)
    else:
        a = instrument.accelerometers
        k_ggi = scale(o, a["k_VI"] * a["K1"], instrument.radii + a["dR"])
        series = (carried(flight.outputs["inline"], flight.outputs["cross"], r, k_ggi),)
        edge = len(low_pass(r.rate)) // 2  # there our demodulator has not seen enough
        inside = np.zeros(len(r.time), dtype=bool)
        inside[edge : len(r.time) - edge] = True
        r = replace(r, valid=r.valid & inside)
    valid = np.array(r.valid)
    for x in series:
        valid &= np.isfinite(x)
    recorded_too = (flight.outputs[o.name],) if o.name in flight.outputs else ()
    for x in (*recorded_too, *(series if kind == "voltages" else ())):
        clipped = saturation(x, valid)
        if clipped is not None:
            valid &= ~clipped[1]
    if instrument.effect(MOTION_SATURATION) is not None:
        for mask in motion_at_the_end(flight.channels, flight.valid).values():
            valid &= ~mask
    let_go(*flight.outputs.values())
    wide = r.wide
    if len(r.time) <= ROWS:  # longer ones are cleaned part by part
        wide = {n: np.where(np.isfinite(x), x, 0.0) for n, x in r.wide.items()}
    name = flight.name if len(layout.outputs) == 1 else f"{flight.name}: {o.name}"
    return Observation(kind, replace(r, valid=valid, wide=wide), series, name, o, place)


@dataclass(frozen=True)
class Observation:
    """What of a flight, or of a part of one, is fitted: m output series over N samples.

    ``kind`` is ``G_out`` (m = 1), ``voltages`` (m = 4 in the paper's instrument, those of the output's accelerometers)
    or ``channels``: inline and cross are all that was recorded; then the data are the channels put back on their
    carriers (m = 1, see :func:`narrow`), and every column passes through the same demodulator. All in V.

    ``output`` is the output of the instrument that is observed; a flight with several makes as many observations,
    ``place`` counts them.
    """

    kind: str
    record: Record
    series: tuple[Array, ...]
    name: str
    output: Output = PAPER.outputs[0]
    place: int = 0
    memo: list[tuple[Noise, list[Any]]] = field(default_factory=list, compare=False, repr=False)
    """What :mod:`ragg_runtime.fit.unknown_gradient` has found for some noise."""

    @cached_property
    def data(self) -> Array:
        """(m, N), V; zero where a sample is not valid."""
        return np.stack([np.where(self.record.valid, x, 0.0) for x in self.series])

    @property
    def weights(self) -> Array:
        """(m,): how much of a common term of G_out each output sees (for voltages each is searched as one)."""
        signs = np.array(self.output.signs, dtype=np.float64)
        return signs / len(signs) if self.kind == "voltages" else np.ones(1)

    def part(self, rows: slice) -> Observation:
        """Some of the samples."""
        if (rows.start, rows.stop) == (0, len(self.record.time)):
            return self
        series = tuple(np.array(x[rows]) for x in self.series)
        let_go(*self.series)
        return Observation(self.kind, self.record.part(rows), series, self.name, self.output, self.place)


def carried(inline: Array, cross: Array, r: Record, k_ggi: float) -> Array:
    """Demodulated channels put back on their carriers: k_ggi (inline/2 sin 2 phi - cross cos 2 phi), V.

    ``k_ggi`` in V per unit of the channels.
    """
    cosine, sine = r.cos_phi**2 - r.sin_phi**2, 2 * r.sin_phi * r.cos_phi
    if r.phase != 0.0:
        c, s = float(np.cos(r.phase)), float(np.sin(r.phase))
        cosine, sine = c * cosine - s * sine, c * sine + s * cosine
    return np.asarray(k_ggi * (inline / 2 * sine - cross * cosine))


def narrow(G: Array, r: Record) -> Array:
    """G_out (..., N) as the demodulator lets it through: demodulated and put back on the carriers."""
    taps = low_pass(r.rate).reshape((1,) * (G.ndim - 1) + (-1,))
    cosine, sine = r.cos_phi**2 - r.sin_phi**2, 2 * r.sin_phi * r.cos_phi
    in_phase = signal.oaconvolve(2 * G * sine, taps, mode="same", axes=-1)
    quadrature = signal.oaconvolve(2 * G * cosine, taps, mode="same", axes=-1)
    return np.asarray(in_phase * sine + quadrature * cosine)


def noise_gain(rate: float) -> float:
    """Variance of white noise of unit variance after :func:`narrow`."""
    return float(2 * np.sum(low_pass(rate) ** 2))


def as_output(o: Observation, e: Array) -> Array:
    """G_out (..., N) of what an observation holds (..., m, N): itself, or the sum of the voltages with their signs (Eq. 15)."""
    return np.asarray(np.einsum("m,...mn->...n", output_weights(o), e))


def output_weights(o: Observation) -> Array:
    """(m,): how much each output of an observation counts in G_out."""
    return len(o.weights) * o.weights if o.kind == "voltages" else o.weights
