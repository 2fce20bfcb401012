"""What of a flight is fitted: the four voltages, G_out, or the demodulated channels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime.fit.segments import ROWS
from ragg_runtime.flight import Flight
from ragg_runtime.flight.output_values import saturation
from ragg_runtime.flight.spool import let_go
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.record import Record, record
from ragg_runtime.signals.demodulate import low_pass

Array = NDArray[np.float64]


def observe(flight: Flight, instrument: Instrument) -> Observation:
    """The most telling output of a flight: the four voltages if recorded, else G_out, else the channels."""
    r = record(flight, instrument)
    volts = [f"V_{j}" for j in (1, 2, 3, 4)]
    if all(v in flight.outputs for v in volts):
        series, kind = tuple(flight.outputs[v] for v in volts), "voltages"
    elif "G_out" in flight.outputs:
        series, kind = (flight.outputs["G_out"],), "G_out"
    else:
        a = instrument.accelerometers
        k_ggi = float(np.sum(a["k_VI"] * a["K1"] * (instrument.radius + a["dR"])))
        series = (carried(flight.outputs["inline"], flight.outputs["cross"], r, k_ggi),)
        kind = "channels"
        edge = len(low_pass(r.rate)) // 2  # there our demodulator has not seen enough
        inside = np.zeros(len(r.time), dtype=bool)
        inside[edge : len(r.time) - edge] = True
        r = replace(r, valid=r.valid & inside)
    valid = np.array(r.valid)
    for x in series:
        valid &= np.isfinite(x)
    clipped = saturation(flight.outputs["G_out"], valid) if "G_out" in flight.outputs else None
    if clipped is not None:
        valid &= ~clipped[1]
    let_go(*flight.outputs.values())
    wide = r.wide
    if len(r.time) <= ROWS:  # longer ones are cleaned part by part
        wide = {n: np.where(np.isfinite(x), x, 0.0) for n, x in r.wide.items()}
    return Observation(kind, replace(r, valid=valid, wide=wide), series, flight.name)


@dataclass(frozen=True)
class Observation:
    """What of a flight, or of a part of one, is fitted: m output series over N samples.

    ``kind`` is ``G_out`` (m = 1), ``voltages`` (m = 4) or ``channels``: inline and cross are all that was
    recorded; then the data are the channels put back on their carriers (m = 1, see :func:`narrow`), and
    every column passes through the same demodulator. All in V.
    """

    kind: str
    record: Record
    series: tuple[Array, ...]
    name: str
    memo: list[tuple[Sequence[Array], list[Any]]] = field(default_factory=list, compare=False, repr=False)
    """What :mod:`ragg_runtime.fit.unknown_gradient` has found for some filters."""

    @cached_property
    def data(self) -> Array:
        """(m, N), V; zero where a sample is not valid."""
        return np.stack([np.where(self.record.valid, x, 0.0) for x in self.series])

    @property
    def weights(self) -> Array:
        """(m,): how much of a common term of G_out each output sees (for voltages each is searched as one)."""
        return np.array([0.25, 0.25, -0.25, -0.25]) if self.kind == "voltages" else np.ones(1)

    def part(self, rows: slice) -> Observation:
        """Some of the samples."""
        if (rows.start, rows.stop) == (0, len(self.record.time)):
            return self
        series = tuple(np.array(x[rows]) for x in self.series)
        let_go(*self.series)
        return Observation(self.kind, self.record.part(rows), series, self.name)


_COMBINATION = np.array([1.0, 1.0, -1.0, -1.0])


def combined(v: Array, accelerometer: int | None = None) -> Array:
    """G_out (N,) of voltages (4, N), or of one accelerometer's (N,) (Eq. 15)."""
    return np.asarray(_COMBINATION @ v if accelerometer is None else _COMBINATION[accelerometer - 1] * v)


def carried(inline: Array, cross: Array, r: Record, k_ggi: float) -> Array:
    """Demodulated channels put back on their carriers: k_ggi (inline/2 sin 2 phi - cross cos 2 phi), V.

    ``k_ggi`` in V per unit of the channels.
    """
    cosine, sine = r.cos_phi**2 - r.sin_phi**2, 2 * r.sin_phi * r.cos_phi
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
    """G_out (..., N) of what an observation holds (..., m, N): itself, or V_1 + V_2 - V_3 - V_4 (Eq. 15)."""
    return np.asarray(np.einsum("m,...mn->...n", output_weights(o), e))


def output_weights(o: Observation) -> Array:
    """(m,): how much each output of an observation counts in G_out."""
    return 4 * o.weights if o.kind == "voltages" else o.weights
