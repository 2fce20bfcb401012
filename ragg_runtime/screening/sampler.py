"""Some rows of a flight as a model needs them, as they are or with a mistake undone, so that a fit costs milliseconds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from generated.output_effects.saturation import clipped
from ragg_runtime.instrument.demodulation import OURS
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import Disc, Output
from ragg_runtime.io import Flight
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model.evaluator import ChainModule
from ragg_runtime.model.record import (
    SPIN,
    disc_angle,
    find_start,
    make_kernel,
    record,
    spin,
    strip_derivative,
)
from ragg_runtime.model.recorded import RecordedSeries, find_recorded
from ragg_runtime.signals.fir import convolve

Array = NDArray[np.float64]
Index = NDArray[np.intp]
Mask = NDArray[np.bool_]

MOST = 1500
"""Rows that a fit takes: many times the number of parameters."""

WANTED = 128
"""Samples of demodulated channels that a stretch holds at least, where they were recorded more seldom than the motion."""

TELLING = 512
"""Samples of demodulated channels that are looked at of a stretch: neighbours are much alike."""


@dataclass(frozen=True)
class Rows:
    """n rows of a flight, not necessarily neighbours (neighbours where only the channels are recorded).

    Attributes
    ----------
    recorded
        Which form of the output ``data`` is.
    data
        (m, n) V: the output; of channels k_ggi (inline/2, -cross).
    time, phi
        (n,) s since the flight's first sample; disc angle, rad.
    channels
        Name -> (n,) SI; time derivatives (``d_a_x``) that the model asks for among them.
    taps
        Low-pass of the demodulator; empty if there is none.
    output, names
        The output, and the columns that hold it.
    usable
        (n,) rows whose output is there; ``None``: all.
    """

    recorded: RecordedSeries
    data: Array
    time: Array
    phi: Array
    channels: Mapping[str, Array]
    taps: Array
    output: Output
    names: tuple[str, ...]
    usable: Mask | None = None

    def inputs(self, chain: ChainModule) -> Array:
        """(n_inputs, n) in the order of the chain's INPUTS; what was not recorded is zero."""
        x = np.zeros((len(chain.INPUTS), len(self.time)))
        for n, name in enumerate(chain.INPUTS):
            if name in self.channels:
                x[n] = self.channels[name]
        return x

    def seen(self, raw: Array) -> Array:
        """(..., m, n): what the recorded output sees of what it is before demodulation."""
        if not self.recorded.demodulated:
            return raw
        carriers = 2 * np.stack([np.sin(2 * self.phi), np.cos(2 * self.phi)])
        return convolve(raw * carriers, self.taps, "same")

    @property
    def inner(self) -> Index:
        """Rows that are fitted: where the output is there, and a demodulator has seen enough of the record on either side."""
        inside = np.ones(len(self.time), dtype=np.bool_)
        edge = len(self.taps) // 2
        inside[:edge] = False
        inside[len(inside) - edge :] = False
        found = np.flatnonzero(inside if self.usable is None else inside & self.usable)
        return found[:: max(1, len(found) // TELLING)] if self.recorded.demodulated else found

    @property
    def gradient_recorded(self) -> bool:
        return all(g in self.channels for g in GRADIENT)


@dataclass(frozen=True)
class Sampler:
    """Takes rows of a flight's output ``place`` for fits; ``usable`` (N,) are those whose output is there and not saturated."""

    flight: Flight
    instrument: Instrument
    recorded: RecordedSeries
    usable: Mask
    derived: Mapping[str, Array]
    taps: Array
    columns: tuple[str, ...]
    place: int = 0

    @property
    def output(self) -> Output:
        return self.instrument.layout.outputs[self.place]

    @property
    def disc(self) -> Disc:
        return self.instrument.layout.discs[self.output.disc]

    @property
    def has_encoder(self) -> bool:
        return self.disc.angle_column in self.flight.channels

    def rows(self, first: int = 0, last: int | None = None, most: int = MOST) -> Index:
        """At most ``most`` usable rows of a segment; neighbours where only the channels are recorded."""
        if self.recorded.demodulated:
            whole = np.arange(first, len(self.usable) if last is None else last)
            every = len(self.usable) / max(float(np.sum(self.usable)), 1.0)
            return whole[: max(most, len(self.taps) + max(2 * len(self.taps), round(WANTED * every)))]
        there = np.flatnonzero(self.usable[first:last]) + first
        return there[np.linspace(0, len(there) - 1, min(most, len(there))).astype(np.intp)]

    def take(
        self,
        rows: Index,
        *,
        motion_later: int | Index = 0,
        of: Sequence[str] = ("a", "omega", "omegadot", "Gamma"),
        output_later: int | Index = 0,
        spin_frequency: float | None = None,
        phase: float | Array = 0.0,
        backwards: bool = False,
    ) -> Rows:
        """Rows of the flight.

        Parameters
        ----------
        rows
            (n,) which.
        motion_later, of, output_later
            Samples by which the quantities ``of`` motion, or the output, are taken later than recorded, one or (n,); rows that
            would lie outside are left out.
        spin_frequency
            Hz, in place of the instrument's (or the encoder's angle).
        phase
            rad, added to the disc angle; one, or (n,).
        backwards
            Let the disc turn the other way.
        """
        x, n = self.flight, len(self.flight)
        at = np.array([rows, rows + motion_later, rows + output_later])
        inside = ((at >= 0) & (at < n)).all(axis=0)
        rows, moved_to, output_at = at[:, inside]
        time, start = x.time[rows] - x.time[0], find_start(x, self.instrument)
        f = self.disc.spin_frequency if spin_frequency is None else spin_frequency
        if self.has_encoder and spin_frequency is None:
            phi = x.channels[self.disc.angle_column][rows]
        else:
            phi = disc_angle(time, f, start)
        moved = {
            name for name in (*x.channels, *self.derived) if {find_stem(name), strip_derivative(name)} & {*of}
        }
        channels = {
            name: v[moved_to] if name in moved else v[rows]
            for name, v in (*x.channels.items(), *self.derived.items())
        }
        if spin_frequency is not None:
            channels |= {name: spin(name, None, len(rows), x.rate, f) for name in SPIN}
        if backwards:
            phi = -phi
            channels |= {name: -channels[name] for name in SPIN if name in channels}
        data = np.nan_to_num(np.stack([x.outputs[v][output_at] for v in self.columns]), copy=False)
        if self.recorded.demodulated:  # inline and cross
            data *= self.instrument.scale_factor * np.array([[0.5], [-1.0]])
        return Rows(
            recorded=self.recorded,
            data=data,
            time=time,
            phi=phi + (phase if isinstance(phase, float) else phase[inside]),
            channels=channels,
            taps=self.taps,
            output=self.output,
            names=self.columns,
            usable=self.usable[output_at] if self.recorded.demodulated else None,
        )


def find_stem(name: str) -> str:
    """``a`` of ``a_x`` and of its time derivative ``d_a_x``."""
    return strip_derivative(name).rsplit("_", 1)[0]


def make_sampler(
    flight: Flight, instrument: Instrument, inputs: tuple[str, ...] = (), place: int = 0
) -> Sampler:
    """Prepare a flight for taking rows; ``inputs`` are the names that the model asks for, ``place`` the output.

    Raises
    ------
    ValueError
        If the flight does not have this output.
    """
    layout = instrument.layout
    output = layout.outputs[place]
    form = find_recorded(flight, layout, place)
    columns = None if form is None else form.columns(layout, output, flight.outputs)
    if form is None or columns is None:
        raise ValueError("the flight lacks this output")
    usable = flight.valid & np.isfinite([flight.outputs[name] for name in columns]).all(axis=0)
    if output.name in flight.outputs and usable.any():
        usable &= ~clipped(flight.outputs[output.name], usable)
    how = flight.demodulation or instrument.demodulation or OURS
    whole = record(flight, instrument, place)
    rates = {n: x for n in inputs if strip_derivative(n) != n and (x := whole.series(n)) is not None}
    return Sampler(
        flight=flight,
        instrument=instrument,
        recorded=form,
        usable=usable,
        derived=rates,
        taps=make_kernel(how, flight.rate).centred if form.demodulated else np.zeros(0),
        columns=columns,
        place=place,
    )
