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
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import (
    SPIN,
    RecordedSeries,
    disc_angle,
    find_recorded,
    find_start,
    make_kernel,
    make_spin,
    record,
    strip_derivative,
)
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
    sampler
        What they are taken from.
    data
        (m, n) V: the output; of channels k_ggi (inline/2, -cross).
    time, phi
        (n,) s since the flight's first sample; disc angle, rad.
    channels
        Name -> (n,) SI; time derivatives (``d_a_x``) that the model asks for among them.
    usable
        (n,) rows whose output is there.
    """

    sampler: Sampler
    data: Array
    time: Array
    phi: Array
    channels: Mapping[str, Array]
    usable: Mask

    @property
    def inputs(self) -> Array:
        """(n_inputs, n) in the order of the model's INPUTS; what was not recorded is zero."""
        nothing = np.zeros(len(self.time))
        return np.array([self.channels.get(name, nothing) for name in self.sampler.model.chain.INPUTS])

    def seen(self, raw: Array) -> Array:
        """(..., m, n): what the recorded output sees of what it is before demodulation."""
        if not self.sampler.recorded.demodulated:
            return raw
        carriers = 2 * np.stack([np.sin(2 * self.phi), np.cos(2 * self.phi)])
        return convolve(raw * carriers, self.sampler.taps, "same")

    @property
    def inner(self) -> Index:
        """Rows that are fitted: of channels those where the demodulator has seen enough of the record on either side."""
        if not self.sampler.recorded.demodulated:
            return np.arange(len(self.time))
        edge = len(self.sampler.taps) // 2
        found = edge + np.flatnonzero(self.usable[edge : len(self.usable) - edge])
        return found[:: max(1, len(found) // TELLING)]

    @property
    def gradient_recorded(self) -> bool:
        return all(g in self.channels for g in GRADIENT)


@dataclass(frozen=True)
class Sampler:
    """Takes rows of the output ``place`` of a flight, for fits of a model.

    ``columns`` hold the output in the form ``recorded``; ``usable`` (N,): it is there and not saturated; ``derived``: time derivatives
    that the model asks for; ``taps``: low-pass of the demodulator.
    """

    model: Model
    instrument: Instrument
    flight: Flight
    place: int
    recorded: RecordedSeries
    columns: tuple[str, ...]
    usable: Mask
    derived: Mapping[str, Array]
    taps: Array

    def with_flight(self, flight: Flight) -> Sampler:
        """The same of another flight."""
        return make_sampler(self.model, self.instrument, flight, self.place)

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
        rows: Index | None = None,
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
            (n,) which; ``None``: as many as a fit takes.
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
        rows = self.rows() if rows is None else rows
        at = np.array([rows, rows + motion_later, rows + output_later])
        inside = ((at >= 0) & (at < n)).all(axis=0)
        rows, moved_to, output_at = at[:, inside]
        time = x.time[rows] - x.time[0]
        f = self.disc.spin_frequency if spin_frequency is None else spin_frequency
        if self.has_encoder and spin_frequency is None:
            phi = x.channels[self.disc.angle_column][rows]
        else:
            phi = disc_angle(time, f, find_start(x, self.instrument))
        channels = {
            name: v[moved_to if {find_stem(name), strip_derivative(name)} & {*of} else rows]
            for name, v in (*x.channels.items(), *self.derived.items())
        }
        if spin_frequency is not None:
            channels |= make_spin(f, len(rows))
        if backwards:
            phi = -phi
            channels |= {name: -channels[name] for name in SPIN if name in channels}
        data = np.nan_to_num(np.stack([x.outputs[v][output_at] for v in self.columns]), copy=False)
        if self.recorded.demodulated:  # inline and cross
            data *= self.instrument.scale_factor * np.array([[0.5], [-1.0]])
        turned = phase[inside] if isinstance(phase, np.ndarray) else phase
        return Rows(self, data, time, phi + turned, channels, self.usable[output_at])


def find_stem(name: str) -> str:
    """``a`` of ``a_x`` and of its time derivative ``d_a_x``."""
    return strip_derivative(name).rsplit("_", 1)[0]


def make_sampler(model: Model, instrument: Instrument, flight: Flight, place: int = 0) -> Sampler:
    """Prepare a flight for taking rows of its output ``place``, which it must have."""
    layout = instrument.layout
    output = layout.outputs[place]
    form = find_recorded(flight, layout, place)
    columns = form and form.columns(layout, output, flight.outputs)
    assert form and columns
    usable = flight.valid & np.isfinite([flight.outputs[name] for name in columns]).all(axis=0)
    if output.name in flight.outputs and usable.any():
        usable &= ~clipped(flight.outputs[output.name], usable)
    how = flight.demodulation or instrument.demodulation or OURS
    whole = record(flight, instrument, place)
    asked = (n for n in model.chain.INPUTS if strip_derivative(n) != n)
    return Sampler(
        model=model,
        instrument=instrument,
        flight=flight,
        place=place,
        recorded=form,
        columns=columns,
        usable=usable,
        derived={n: x for n in asked if (x := whole.series(n)) is not None},
        taps=make_kernel(how, flight.rate).centred if form.demodulated else np.zeros(0),
    )
