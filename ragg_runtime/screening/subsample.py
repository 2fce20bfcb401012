"""Some rows of a flight as what a model needs of them, so that a fit costs milliseconds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from generated.output_effects.saturation import clipped
from ragg_runtime.instrument.demodulation import OURS
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import PAPER, Disc, Output
from ragg_runtime.io import Flight
from ragg_runtime.model.chain import Chain
from ragg_runtime.model.demodulation import kernel
from ragg_runtime.model.record import (
    GRADIENTS,
    SPIN,
    differentiated,
    disc_angle,
    lateness,
    spin,
    spin_degree,
    start_of,
)
from ragg_runtime.model.recorded import Recorded, recorded
from ragg_runtime.signals.derivative import differentiate
from ragg_runtime.signals.fir import convolved

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
    """

    recorded: Recorded
    data: Array
    time: Array
    phi: Array
    channels: Mapping[str, Array]
    taps: Array
    output: Output = PAPER.outputs[0]
    names: tuple[str, ...] = ("G_out",)
    """Columns of ``data``."""
    usable: Mask | None = None
    """(n,) rows whose output is there; all, unless the rows are neighbours whatever they hold."""

    def inputs(self, chain: Chain) -> Array:
        """(n_inputs, n) in the order of the chain's INPUTS; what was not recorded is zero."""
        x = np.zeros((len(chain.INPUTS), len(self.time)))
        for n, name in enumerate(chain.INPUTS):
            if name in self.channels:
                x[n] = self.channels[name]
        return x

    def before_demodulation(self, volts: Array, accelerometer: int | None) -> Array:
        """(members, n) or (1, n): the output's voltages, or itself, of these, or of one accelerometer's (n,)."""
        return self.recorded.of_voltages(self.output, volts, accelerometer)

    def seen(self, raw: Array) -> Array:
        """(..., m, n): what the recorded output sees of :meth:`before_demodulation`."""
        if not self.recorded.demodulated:
            return raw
        carriers = 2 * np.stack([np.sin(2 * self.phi), np.cos(2 * self.phi)])
        return convolved(raw * carriers, self.taps, "same")

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
        return all(g in self.channels for g in GRADIENTS)


@dataclass(frozen=True)
class Picker:
    """Picks rows of a flight, as they stand or with a mistake of timing undone."""

    flight: Flight
    instrument: Instrument
    recorded: Recorded
    usable: Mask
    derived: Mapping[str, Array]
    taps: Array
    place: int = 0

    @property
    def output(self) -> Output:
        return self.instrument.layout.outputs[self.place]

    @property
    def disc(self) -> Disc:
        return self.instrument.layout.discs[self.output.disc]

    @cached_property
    def columns(self) -> tuple[str, ...]:
        """Of the flight, that hold the output."""
        return _columns(self.flight, self.instrument, self.place, self.recorded)

    def rows(self, first: int = 0, last: int | None = None, most: int = MOST) -> Index:
        """At most ``most`` usable rows of a stretch; neighbours where only the channels are recorded."""
        if self.recorded.demodulated:
            whole = np.arange(first, len(self.usable) if last is None else last)
            every = len(self.usable) / max(float(np.sum(self.usable)), 1.0)
            return whole[: max(most, len(self.taps) + max(2 * len(self.taps), round(WANTED * every)))]
        there = self.usable[first:last]
        count = int(np.count_nonzero(there))
        return _places(there, np.linspace(0, count - 1, min(most, count)).astype(np.intp)) + first

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
        run = _run(rows)
        x = self.flight
        time, start = _picked(x.time, run) - x.time[0], start_of(x, self.instrument)
        if even:
            time, start = rows * self.even[1], start + self.even[0] - x.time[0]
        f = self.disc.spin_frequency if spin_frequency is None else spin_frequency
        if self.disc.angle_column in x.channels and spin_frequency is None:
            phi = _picked(x.channels[self.disc.angle_column], run)
        else:
            phi = disc_angle(time, f, start)
        moved = _later(run, shift)
        channels = {name: _picked(v, moved) for name, v in (*x.channels.items(), *self.derived.items())}
        if spin_frequency is not None:
            channels |= {name: spin(name, None, len(rows), x.rate, f) for name in SPIN}
        if backwards:
            phi = -phi
            channels |= {name: -channels[name] for name in SPIN if name in channels}
        return self._rows(_later(run, output_shift), time, phi + phase, channels)

    def _rows(self, rows: Index | slice, time: Array, phi: Array, channels: Mapping[str, Array]) -> Rows:
        """With the output of these rows."""
        return Rows(
            recorded=self.recorded,
            data=np.nan_to_num(np.stack([_picked(v, rows) for v in self._output()]), copy=False),
            time=time,
            phi=phi,
            channels=channels,
            taps=self.taps,
            output=self.output,
            names=self.columns,
            usable=self.usable[rows] if self.recorded.demodulated else None,
        )

    @cached_property
    def even(self) -> tuple[float, float]:
        """First instant, s, and interval, s, of the steady clock that the file's instants follow."""
        count = int(np.count_nonzero(self.flight.valid))
        k = _places(self.flight.valid, np.arange(0, count, max(1, count // 65536)))
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
        if not self.recorded.demodulated:
            return [outputs[v] for v in self.columns]
        k = self.instrument.scale_factor
        return [k / 2 * outputs["inline"], -k * outputs["cross"]]


CHUNK = 1 << 16
"""Rows of a whole flight that are looked at at a time."""


def _places(there: Mask, which: Index) -> Index:
    """Where some of a mask's marks stand, counted among the marks, in order: an index of all would be eight times the mask."""
    found, before = [np.empty(0, dtype=np.intp)], 0
    for start in range(0, len(there), CHUNK):
        here = np.flatnonzero(there[start : start + CHUNK])
        first, last = np.searchsorted(which, (before, before + len(here)))
        found.append(here[which[first:last] - before] + start)
        before += len(here)
    return np.concatenate(found)


def _run(rows: Index) -> Index | slice:
    """Rows as a slice, if they are neighbours: of that a column is copied in one go."""
    neighbours = len(rows) > 1 and bool(np.all(rows[1:] == rows[:-1] + 1))
    return slice(int(rows[0]), int(rows[-1]) + 1) if neighbours else rows


def _later(rows: Index | slice, by: int) -> Index | slice:
    return slice(rows.start + by, rows.stop + by) if isinstance(rows, slice) else rows + by


def _picked(column: Array, rows: Index | slice) -> Array:
    """Some rows of a column, copied; of one on disk, none of the rest stays in memory."""
    return np.array(column[rows]) if isinstance(rows, slice) else np.asarray(column[rows])


def _columns(flight: Flight, instrument: Instrument, place: int, form: Recorded) -> tuple[str, ...]:
    layout = instrument.layout
    return form.columns(layout, layout.outputs[place], flight.outputs) or ()


def picker(flight: Flight, instrument: Instrument, inputs: tuple[str, ...] = (), place: int = 0) -> Picker:
    """Prepare a flight for picking rows; ``inputs`` are the names that the model asks for, ``place`` the output."""
    form = recorded(flight, instrument.layout, place)
    if form is None:
        raise ValueError("the flight does not hold this output")
    usable = flight.valid.copy()
    for name in _columns(flight, instrument, place, form):
        usable &= np.isfinite(flight.outputs[name])
    own = instrument.layout.outputs[place].name
    if own in flight.outputs and usable.any():
        usable &= ~clipped(flight.outputs[own], usable)
    derived = {}
    for name in inputs:
        if name in SPIN:
            disc = instrument.layout.discs[instrument.layout.outputs[place].disc]
            encoder = flight.channels.get(disc.angle_column)
            late = None if encoder is None else lateness(flight.time, flight.rate)
            degree = spin_degree(encoder, flight.rate, late)
            samples = 1 if encoder is None else len(flight)  # without an encoder it is a constant
            one = spin(name, encoder, samples, flight.rate, disc.spin_frequency, degree, late)
            derived[name] = np.broadcast_to(one, len(flight))
            continue
        order = 2 if name.startswith("d2_") else 1
        base = differentiated(name)
        if base != name and base in flight.channels:
            series = flight.channels[base]
            for _ in range(order):
                series = differentiate(series, flight.rate)
            derived[name] = series
    how = flight.demodulation or instrument.demodulation or OURS
    taps = kernel(how, flight.rate).centred if form.demodulated else np.zeros(0)
    return Picker(
        flight=flight,
        instrument=instrument,
        recorded=form,
        usable=usable,
        derived=derived,
        taps=taps,
        place=place,
    )
