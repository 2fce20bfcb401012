"""Some rows of a flight as what a model needs of them, so that a fit costs milliseconds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime.flight import Flight
from ragg_runtime.flight.output_values import saturation
from ragg_runtime.flight.record import DEMODULATED, VOLTAGES
from ragg_runtime.flight.spool import let_go
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Chain
from ragg_runtime.model.record import GRADIENTS, SPIN, disc_angle, spin
from ragg_runtime.signals.demodulate import low_pass
from ragg_runtime.signals.derivative import differentiate

Array = NDArray[np.float64]
Index = NDArray[np.intp]
Mask = NDArray[np.bool_]
Kind = Literal["voltages", "G_out", "channels"]

MOST = 1500
"""Rows that a fit takes: many times the number of parameters."""


@dataclass(frozen=True)
class Rows:
    """n rows of a flight, not necessarily neighbours (neighbours where only the channels are recorded).

    Attributes
    ----------
    kind
        ``voltages``, ``G_out`` or ``channels`` (inline and cross alone): which output ``data`` is.
    data
        (m, n) V: the output; of channels k_ggi (inline/2, -cross).
    time, phi
        (n,) s since the flight's first sample; disc angle, rad.
    channels
        Name -> (n,) SI; time derivatives (``d_a_x``) that the model asks for among them.
    taps
        Low-pass of the demodulator; empty unless ``kind`` is ``channels``.
    """

    kind: Kind
    data: Array
    time: Array
    phi: Array
    channels: Mapping[str, Array]
    taps: Array

    def inputs(self, chain: Chain) -> Array:
        """(n_inputs, n) in the order of the chain's INPUTS; what was not recorded is zero."""
        x = np.zeros((len(chain.INPUTS), len(self.time)))
        for n, name in enumerate(chain.INPUTS):
            if name in self.channels:
                x[n] = self.channels[name]
        return x

    def before_demodulation(self, volts: Array, accelerometer: int | None) -> Array:
        """(4, n) or (1, n): the voltages, or G_out, of voltages (4, n), or of one accelerometer's (n,)."""
        if self.kind == "voltages":
            if accelerometer is None:
                return volts
            full = np.zeros((4, volts.shape[-1]))
            full[accelerometer - 1] = volts
            return full
        signs = np.array([1.0, 1.0, -1.0, -1.0])
        G = signs @ volts if accelerometer is None else signs[accelerometer - 1] * volts
        return np.asarray(G[None])

    def seen(self, raw: Array) -> Array:
        """(..., m, n): what the recorded output sees of :meth:`before_demodulation`."""
        if self.kind != "channels":
            return raw
        carriers = 2 * np.stack([np.sin(2 * self.phi), np.cos(2 * self.phi)])
        taps = self.taps.reshape((1,) * (raw.ndim - 1) + (-1,))
        return np.asarray(signal.oaconvolve(raw * carriers, taps, mode="same", axes=-1))

    @property
    def inner(self) -> Mask:
        """(n,) where a demodulator has seen enough of the record on either side."""
        inside = np.ones(len(self.time), dtype=np.bool_)
        edge = len(self.taps) // 2
        inside[:edge] = False
        inside[len(inside) - edge :] = False
        return inside

    @property
    def gradient_recorded(self) -> bool:
        return all(g in self.channels for g in GRADIENTS)


@dataclass(frozen=True)
class Picker:
    """Picks rows of a flight, as they stand or with a mistake of timing undone."""

    flight: Flight
    instrument: Instrument
    kind: Kind
    usable: Mask
    derived: Mapping[str, Array]
    taps: Array

    def rows(self, first: int = 0, last: int | None = None, most: int = MOST) -> Index:
        """At most ``most`` usable rows of a stretch; neighbours where only the channels are recorded."""
        there = (
            self._there if first == 0 and last is None else np.flatnonzero(self.usable[first:last]) + first
        )
        if self.kind == "channels":
            whole = np.arange(first, len(self.usable) if last is None else last)
            return whole[: max(most, 3 * len(self.taps))]
        return np.asarray(there[np.linspace(0, len(there) - 1, min(most, len(there))).astype(np.intp)])

    def pick(
        self,
        rows: Index,
        *,
        shift: int = 0,
        output_shift: int = 0,
        spin_frequency: float | None = None,
        phase: float = 0.0,
        even: bool = False,
        backwards: bool = False,
    ) -> Rows:
        """Rows of the flight.

        Parameters
        ----------
        rows
            Which.
        shift, output_shift
            Samples by which the motion, or the output, is taken later than it stands there; rows that
            would lie outside are left out.
        spin_frequency
            Hz, in place of the instrument's (or the encoder's angle).
        phase
            rad, added to the disc angle.
        even
            Take the samples as evenly spaced, whatever the file's instants say.
        backwards
            Let the disc turn the other way.
        """
        n = len(self.flight)
        inside = (rows + min(shift, output_shift, 0) >= 0) & (rows + max(shift, output_shift, 0) < n)
        rows = rows[inside]
        x = self.flight
        time = _picked(x.time, rows) - x.time[0]
        if even:
            time = rows * self.even[1]
        f = self.instrument.spin_frequency if spin_frequency is None else spin_frequency
        if "spin_angle" in x.channels and spin_frequency is None:
            phi = _picked(x.channels["spin_angle"], rows)
        else:
            phi = disc_angle(time, f)
        moved = rows + shift
        channels = {name: _picked(v, moved) for name, v in x.channels.items()}
        channels |= {name: _picked(v, moved) for name, v in self.derived.items()}
        if spin_frequency is not None:
            channels |= {name: spin(name, None, len(rows), x.rate, f) for name in SPIN}
        if backwards:
            phi = -phi
            channels |= {name: -channels[name] for name in SPIN if name in channels}
        data = np.stack([_picked(v, rows + output_shift) for v in self._output()])
        return Rows(self.kind, np.nan_to_num(data), time, phi + phase, channels, self.taps)

    @cached_property
    def _there(self) -> Index:
        return np.flatnonzero(self.usable)

    @cached_property
    def even(self) -> tuple[float, float]:
        """First instant, s, and interval, s, of the steady clock that the file's instants follow."""
        k = np.flatnonzero(self.flight.valid)
        k = k[:: max(1, len(k) // 65536)]
        time = self.flight.time[k]
        step, first = (float(c) for c in np.polyfit(k, time, 1))
        scatter = float(np.std(time - first - step * k))
        # A clock is set to a round rate: take it where the instants cannot tell it from the fitted one.
        error = 4 * scatter * np.sqrt(12 / len(k)) / (k[-1] - k[0])
        for digits in range(1, 10):
            rounded = 1 / float(f"{1 / step:.{digits}g}")
            if abs(rounded - step) < error:
                step = rounded
                break
        return float(np.mean(time - step * k)), step

    def _output(self) -> list[Array]:
        outputs = self.flight.outputs
        if self.kind == "voltages":
            return [outputs[v] for v in VOLTAGES]
        if self.kind == "G_out":
            return [outputs["G_out"]]
        k = self.instrument.scale_factor
        return [k / 2 * outputs["inline"], -k * outputs["cross"]]


CHUNK = 1 << 16
"""Rows of a whole flight that are looked at at a time."""


def _picked(column: Array, rows: Index) -> Array:
    """Some rows of a column; of one on disk, none of the rest stays in memory."""
    found = np.asarray(column[rows])
    let_go(column)
    return found


def picker(flight: Flight, instrument: Instrument, inputs: tuple[str, ...] = ()) -> Picker:
    """Prepare a flight for picking rows; ``inputs`` are the names that the model asks for."""
    if all(v in flight.outputs for v in VOLTAGES):
        kind: Kind = "voltages"
    elif "G_out" in flight.outputs:
        kind = "G_out"
    else:
        kind = "channels"
    usable = flight.valid.copy()
    for name in {"voltages": VOLTAGES, "G_out": ("G_out",), "channels": DEMODULATED}[kind]:
        usable &= np.isfinite(flight.outputs[name])
    if "G_out" in flight.outputs and usable.any():
        clipped = saturation(flight.outputs["G_out"], usable)
        if clipped is not None:
            usable &= ~clipped[1]
    derived = {}
    for name in inputs:
        if name in SPIN:
            encoder = flight.channels.get("spin_angle")
            derived[name] = spin(name, encoder, len(flight), flight.rate, instrument.spin_frequency)
            continue
        order = 2 if name.startswith("d2_") else 1
        base = name.removeprefix("d2_").removeprefix("d_")
        if base != name and base in flight.channels:
            series = flight.channels[base]
            for _ in range(order):
                series = differentiate(series, flight.rate)
            derived[name] = series
    taps = low_pass(flight.rate) if kind == "channels" else np.zeros(0)
    return Picker(flight, instrument, kind, usable, derived, taps)
