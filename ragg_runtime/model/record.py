"""A flight as a model sees it: motion and auxiliaries in SI, disc angle, valid samples; and what of an output it holds."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from generated import folded
from ragg_runtime.instrument.instrument import OURS, Demodulation, Instrument
from ragg_runtime.instrument.layout import Layout, Output, Vector3, gain
from ragg_runtime.io import Flight
from ragg_runtime.io.record import DEMODULATED, RATES, SPECIFIC_FORCE
from ragg_runtime.model.chain import Chain
from ragg_runtime.signals.demodulators import Demodulator, find_demodulator
from ragg_runtime.signals.derivative import (
    DEGREES,
    choose_degree,
    differentiate,
    interpolate_even,
    runs,
    smooth_slope,
    split_angle,
)
from ragg_runtime.signals.fir import convolve

Array = NDArray[np.float64]


PARALLEL = 1e-9  # sine of the angle between two input axes below which they are parallel
# further samples on either side of a part of a record: second derivatives are then those of the whole
HALO = 32


# the chain's name for the reading of its own output's converter, whatever that output is called
READING = "G_out"
# rate and acceleration of the disc angle: in every record, with an encoder or without
SPIN = ("d_spin_angle", "d2_spin_angle")
SPIN_WINDOW = 0.6  # half the segment, s, over which the encoder's angle is smoothed for its rate
EVEN = 1e-7  # steps by which instants that count as even may be off: the last digits of a time of a day


@dataclass(frozen=True)
class Record:
    """What of a flight enters a model: the whole of it, or a part.

    ``time`` (N,) s since the first sample of the flight; ``start``, s: from angle 0 of a disc without an encoder to that
    sample. ``wide``: name -> (before + N + after,), SI, of a part with ``halo`` = (before, after) further samples.
    ``rate``, ``spin_frequency``: Hz. ``angle_column``: of the disc that the output belongs to. ``phase``, rad: a
    gradient shows as T_1 sin(2 phi + phase) + T_2 cos(2 phi + phase). ``axes``: first two of the disc at rest in the
    measurement frame; ``None``: x and y. ``every``: samples from one recorded inline and cross to the next. ``whole``:
    what this is a part of, from its sample ``first`` on, those of the halo among them.
    ``input_axes``: cosine and sine of the angle of each of the output's accelerometers, and its share in the power of equal noises.
    ``reading``: the output as its converter gave it, (before + N + after,) V; ``None`` where something else is fitted.
    """

    time: Array
    wide: Mapping[str, Array]
    rate: float
    valid: NDArray[np.bool_]
    spin_frequency: float
    halo: tuple[int, int] = (0, 0)
    angle_column: str = "spin_angle"
    phase: float = 0.0
    turning: bool = True
    axes: tuple[Vector3, Vector3] | None = None
    demodulation: Demodulation = OURS
    every: int = 1
    whole: Record | None = None
    first: int = 0
    start: float = 0.0
    input_axes: tuple[tuple[float, float, float], ...] = ((1.0, 0.0, 0.5), (0.0, 1.0, 0.5))
    reading: Array | None = None

    @cached_property
    def low_pass(self) -> Demodulator:
        """The low-pass of inline and cross."""
        d = self.demodulation
        return find_demodulator(d.kind, self.rate, d.cutoff, d.order)

    @property
    def recorded(self) -> frozenset[str]:
        """The channels that an effect may need and this has."""
        return frozenset((*self.wide, *([] if self.reading is None else [READING])))

    @cached_property
    def channels(self) -> Mapping[str, Array]:
        """Name -> (N,), SI."""
        return {n: self._cut_halo(x) for n, x in self.wide.items()}

    @cached_property
    def phi(self) -> Array:
        """(N,) rad: the disc angle, the encoder's or 2 pi frac(spin_frequency (start + time))."""
        if self.angle_column in self.wide:
            return self._cut_halo(self.wide[self.angle_column])
        return disc_angle(self.time, self.spin_frequency, self.start)

    @cached_property
    def quadratures(self) -> tuple[Array, Array]:
        """Cosine and sine, (N,), of the gradient's carriers: G_out holds T_1 sin + T_2 cos."""
        double = 2 * (self.phi + self.phase / 2)
        return np.asarray(np.cos(double)), np.asarray(np.sin(double))

    @cached_property
    def carriers(self) -> tuple[Array, Array]:
        """Carriers that make one series of inline and cross: the gradient's; a quarter turn a sample, if these were thinned out."""
        if self.every == 1:
            return self.quadratures
        angle = np.pi / 2 * np.remainder(np.rint(self.time * self.rate), 4.0 * self.every) / self.every
        return np.asarray(np.cos(angle)), np.asarray(np.sin(angle))

    @cached_property
    def cos_phi(self) -> Array:
        return np.asarray(np.cos(self.phi))

    @cached_property
    def sin_phi(self) -> Array:
        return np.asarray(np.sin(self.phi))

    @cached_property
    def spin(self) -> Mapping[str, Array]:
        """Rate and acceleration of the disc angle, (before + N + after,); a part has those of the whole record."""
        size = len(self.time) + sum(self.halo)
        if self.whole is not None:
            return {n: x[self.first : self.first + size] for n, x in self.whole.spin.items()}
        if self.angle_column in self.wide:
            return measure_spin(self.wide[self.angle_column], self.time, self.rate)
        return make_spin(self.spin_frequency, size)

    def inputs(self, chain: Chain) -> Array:
        """(n_inputs, N) in the order of the chain's INPUTS; channels that were not recorded are zero."""
        x = np.zeros((len(chain.INPUTS), len(self.time)))
        for n, name in enumerate(chain.INPUTS):
            series = self.series(name)
            if series is not None:
                x[n] = series
        return x

    def series(self, name: str) -> Array | None:
        """A channel, or the time derivative ``d_<channel>``, ``d2_<channel>`` of one; ``None`` if unknown."""
        wide = self._find_wide(name)
        return None if wide is None else self._cut_halo(wide)

    def quantity(self, name: str) -> Array:
        """(N,): what a level of noise may follow: ``time``, ``phi`` (0 to 2 pi), a channel, ``abs(CHANNEL)``, or ``abs(VECTOR)``, a length.

        ``input(K)``: size of the specific force along the input axis of the output's accelerometer K; ``input``, ``input-rms``: mean
        and quadratic mean of these, weighted by the power that each adds.
        """
        if name == "time":
            return self.time
        if name == "phi":
            return np.asarray(np.mod(self.phi, 2 * np.pi))
        if name.partition("(")[0] in ("input", "input-rms"):
            x, y, _ = self.along_disc()
            along, across = y * self.cos_phi - x * self.sin_phi, x * self.cos_phi + y * self.sin_phi
            cosines, sines, weights = np.array(self.input_axes).T
            forces = np.abs(np.outer(cosines, along) - np.outer(sines, across))
            if name == "input":
                return np.asarray(weights @ forces)
            return np.asarray(
                np.sqrt(weights @ forces**2) if name == "input-rms" else forces[int(name[6:-1])]
            )
        if name in self.channels:
            return self.channels[name]
        inner = name[4:-1]
        parts = [self.channels[n] for n in (inner, *(f"{inner}_{k}" for k in "xyz")) if n in self.channels]
        return np.asarray(np.linalg.norm(parts, axis=0))

    @property
    def different_axes(self) -> list[int]:
        """Of the output's accelerometers those with different input axes, the first of each two that are parallel."""
        axes: list[int] = []
        for k, (c, s, _) in enumerate(self.input_axes):
            if all(abs(c * self.input_axes[j][1] - s * self.input_axes[j][0]) > PARALLEL for j in axes):
                axes.append(k)
        return axes

    def along_disc(self, prefix: str = "") -> tuple[Array, Array, Array]:
        """The specific force along the axes of the disc at rest, (N,) each, m/s^2; with the prefix ``d_`` or ``d2_`` its derivative."""
        a = [x for n in SPECIFIC_FORCE if (x := self.series(f"{prefix}{n}")) is not None]
        if self.axes is None:
            return a[0], a[1], a[2]
        axes = (*self.axes, np.cross(*self.axes))
        x, y, z = (np.asarray(sum(w * v for w, v in zip(axis, a, strict=True))) for axis in axes)
        return x, y, z

    def part(self, rows: slice, only: Container[str] | None = None) -> Record:
        """Some of the samples, copied, with what derivatives need of their neighbours; ``only`` some channels, and the angle."""
        n, a, b = len(self.time), rows.start, rows.stop
        if (a, b) == (0, n):
            return self
        halo = min(a, HALO), min(n - b, HALO)
        first = self.halo[0] + a - halo[0]
        window = slice(first, first + halo[0] + b - a + halo[1])
        names = [k for k in self.wide if only is None or k in only or k == self.angle_column]
        wide = {k: np.array(self.wide[k][window]) for k in names}
        reading = None if self.reading is None else np.array(self.reading[window])
        for x in (*wide.values(), *([] if reading is None else [reading])):
            if not np.isfinite(np.dot(x, x)):  # cheap, and true wherever something is not finite
                x[~np.isfinite(x)] = 0.0
        return replace(
            self,
            time=np.array(self.time[rows]),
            wide=wide,
            valid=np.array(self.valid[rows]),
            halo=halo,
            whole=self.whole or self,
            first=self.first + first,
            reading=reading,
        )

    def shift(self, moves: Mapping[str, tuple[float, float]]) -> Record:
        """The record with motion taken from later in it: quantity (``a`` ...) -> lateness, s, at time 0 and per second.

        An angular rate is shifted by the integral of the recorded angular acceleration, as in the chain's series: with its own, noisier
        slope, the optimum of a fit would depend on where it starts.
        """
        wide, samples = dict(self.wide), len(self.time) + sum(self.halo)
        at = np.arange(samples, dtype=np.float64)
        time = self.time if self.whole is None else self.whole.time[self.first : self.first + samples]
        later = {q: (offset + drift * time) * self.rate for q, (offset, drift) in moves.items()}
        for quantity, shift in later.items():
            names = [n for n in (quantity, *(f"{quantity}_{k}" for k in "xyz")) if n in wide]
            series = [self.wide[n] for n in names]
            if quantity == "omega" and all(f"omegadot_{n[-1]}" in wide for n in names):
                slopes = [self.wide[f"omegadot_{n[-1]}"] / self.rate for n in names]
                instants = at + later.get("omegadot", 0.0)
                ends = [np.clip(x, -1.0, samples) for x in (instants, instants - shift)]
                upper, lower = (interpolate_even(slopes, x, integral=True) for x in ends)
                moved = np.stack(series) + upper - lower
            else:
                moved = interpolate_even(series, np.clip(at + shift, -1.0, samples))
            wide |= dict(zip(names, moved, strict=True))
        return replace(self, wide=wide)

    def _cut_halo(self, x: Array) -> Array:
        return x[self.halo[0] : len(x) - self.halo[1]]

    def _find_wide(self, name: str) -> Array | None:
        if name in self.wide:
            return self.wide[name]
        if name == READING:
            return self.reading
        if name in SPIN:
            return self.spin[name]
        for prefix, base in (("d_", name[2:]), ("d2_", f"d_{name[3:]}")):
            if name.startswith(prefix):
                inner = self._find_wide(base)
                return None if inner is None else differentiate(inner, self.rate)
        return None


def make_spin(spin_frequency: float, samples: int) -> dict[str, Array]:
    """Rate, rad/s, and acceleration, rad/s^2, of the angle of a disc that turns evenly, (samples,) each."""
    return dict(zip(SPIN, (np.full(samples, 2 * np.pi * spin_frequency), np.zeros(samples)), strict=True))


def measure_spin(encoder: Array, time: Array, rate: float) -> dict[str, Array]:
    """Rate, rad/s, and acceleration, rad/s^2, of the disc angle, (N,) each, by an encoder, rad; zero where it has none.

    The steady turn is taken at the samples' own instants; the rest, the swing, is so slow that it is differentiated as if they were even.
    """
    late = (time - time[:1]) * rate - np.arange(len(time))
    even = np.max(np.abs(late), initial=0.0) <= EVEN
    spin = make_spin(0.0, len(time))
    half = min(max(round(SPIN_WINDOW * rate), DEGREES[0]), HALO)
    segments = [
        (run, *split_angle(encoder[run], None if even else late[run]))
        for run in runs(np.isfinite(encoder), DEGREES[0] + 2)
    ]
    best = choose_degree((swing for _, _, swing in segments), half)
    for run, steady, swing in segments:
        window = min(half, (len(swing) - 1) // 2)
        degree = max(d for d in DEGREES if d == DEGREES[0] or d <= min(best, 2 * window - 1))
        spin[SPIN[0]][run] = (smooth_slope(swing, window, 1, degree) + steady) * rate
        spin[SPIN[1]][run] = smooth_slope(swing, window, 2, degree) * (rate * rate)
    return spin


def disc_angle(time: Array, spin_frequency: float, start: float = 0.0) -> Array:
    """2 pi frac(spin_frequency (start + t)), rad, with the rounding errors of the products kept; ``time`` (N,) s."""
    phi = folded.disc_angle(time, spin_frequency)
    return phi + folded.disc_angle(np.array([start]), spin_frequency) if start else phi


STANDING = 1e-3  # range of a recorded disc angle, rad, below which the disc stands still


def measure_phase(g: complex) -> float:
    """rad, between -pi and pi; 0 of any real number, whose sign is that of the scale factor."""
    return 0.0 if abs(g.imag) <= 1e-12 * abs(g) else float(np.angle(g))


def find_start(flight: Flight, instrument: Instrument) -> float:
    """Time, s, from angle 0 of a disc without an encoder to the first sample of a flight.

    Seconds count from 0 of ``time`` whatever the first sample is; instants from the first sample of the record, of which the flight
    may be a part; ``[model] angle_origin`` overrides both.
    """
    first = instrument.angle_origin == "first-sample" or (flight.instants and instrument.angle_origin is None)
    return float(flight.time[0]) - (flight.began or 0.0 if first else 0.0)


def record(flight: Flight, instrument: Instrument, output: int = 0) -> Record:
    """The record of a flight for the model of an output of the instrument."""
    # a long flight's columns stay on disk, unless they have to be shifted
    time = flight.time if flight.time[0] == 0.0 else flight.time - flight.time[0]
    layout, k = instrument.layout, instrument.accelerometers
    o = layout.outputs[output]
    disc = layout.discs[o.disc]
    turning = disc.spin_frequency != 0.0
    if disc.angle_column in flight.channels:
        turning = bool(np.ptp(flight.channels[disc.angle_column]) > STANDING)
    wide = {name: x for name, x in flight.channels.items() if name not in RATES}
    power = np.square((k["k_VI"] * k["K1"])[list(o.members)])
    return Record(
        time=time,
        wide=wide,
        rate=flight.rate,
        valid=flight.valid,
        spin_frequency=disc.spin_frequency,
        angle_column=disc.angle_column,
        phase=measure_phase(gain(o, k["k_VI"] * k["K1"], instrument.radii + k["dR"])),
        turning=turning,
        axes=None if disc.level else disc.across,
        demodulation=flight.demodulation or instrument.demodulation or OURS,
        start=find_start(flight, instrument),
        input_axes=tuple((*cs, float(w)) for cs, w in zip(o.angles, power / np.sum(power), strict=True)),
    )


def list_recorded_channels(flight: Flight, layout: Layout) -> frozenset[str]:
    """The channels of a flight that an effect may need."""
    has_output = any(o.name in flight.outputs for o in layout.outputs)
    return frozenset((*flight.channels, *([READING] if has_output else [])))


def strip_derivative(name: str) -> str:
    """The channel of a time derivative ``d_<channel>`` or ``d2_<channel>``; other names as they are."""
    return name.removeprefix("d2_").removeprefix("d_")


def take_quantities(r: Record, rows: slice) -> Callable[[str], Array]:
    """:meth:`Record.quantity` of some samples, which are copied only if one is asked for."""
    return lambda name: r.part(rows).quantity(name)


@dataclass(frozen=True)
class RecordedSeries:
    """What of an output a flight holds, as m series over N samples.

    ``kind``: the voltage of every accelerometer, each a series (m = 4 in the paper's instrument); the output, their sum with signs
    (Eq. 15); or inline and cross alone, put back on their carriers, of an instrument's only output. ``words``: for people.
    """

    kind: Literal["voltages", "G_out", "channels"]
    words: str

    @property
    def separate(self) -> bool:
        """Whether each accelerometer's voltage is a series of its own."""
        return self.kind == "voltages"

    @property
    def demodulated(self) -> bool:
        """Whether the recorder has demodulated it: neighbouring samples are not independent, and the mean is lost."""
        return self.kind == "channels"

    def columns(self, layout: Layout, o: Output, present: Container[str]) -> tuple[str, ...] | None:
        """The columns that hold it, among those that a flight has; ``None`` if not all are there."""
        if self.separate:
            return layout.voltages(o, present)
        names = DEMODULATED if self.demodulated else (o.name,)
        alone = len(layout.outputs) == 1 or not self.demodulated
        return names if alone and all(n in present for n in names) else None

    def series(self, columns: Sequence[Array], r: Record, k_ggi: float) -> tuple[Array, ...]:
        """The m series (N,), V, that are fitted, from its columns in SI; ``k_ggi`` in V s^2."""
        if not self.demodulated:
            return tuple(columns)
        inline, cross = columns
        return (put_on_carriers(inline, cross, r, k_ggi),)

    def signs(self, o: Output) -> Array:
        """(m,): how each series counts in the output."""
        return np.array(o.signs, dtype=np.float64) if self.separate else np.ones(1)

    def of_voltages(self, o: Output, v: Array) -> Array:
        """(m, N), V, before demodulation: of the members' voltages (members, N)."""
        return v if self.separate else np.asarray(np.array(o.signs, dtype=np.float64) @ v)[None]

    def through(self, G: Array, r: Record) -> Array:
        """The output before demodulation (..., N) behind the recorder's low-pass."""
        if not self.demodulated:
            return G
        taps = r.low_pass.centred
        cosine, sine = r.quadratures
        in_phase = convolve(2 * G * sine, taps, "same")
        quadrature = convolve(2 * G * cosine, taps, "same")
        cosine, sine = r.carriers
        return np.asarray(in_phase * sine + quadrature * cosine)

    def noise_share(self, r: Record) -> float:
        """Variance of white noise of unit variance after :meth:`through`."""
        return float(2 * np.sum(r.low_pass.taps**2)) if self.demodulated else 1.0


FORMS = (
    RecordedSeries("voltages", "V_1 … V_4"),
    RecordedSeries("G_out", "G_out"),
    RecordedSeries("channels", "inline and cross, remodulated"),
)
"""The most informative first."""


def find_recorded(flight: Flight, layout: Layout, place: int) -> RecordedSeries | None:
    """Which series of an output a flight has, the most informative; ``None``: none."""
    o = layout.outputs[place]
    return next((form for form in FORMS if form.columns(layout, o, flight.outputs) is not None), None)


def put_on_carriers(inline: Array, cross: Array, r: Record, k_ggi: float) -> Array:
    """Demodulated channels put back on carriers: k_ggi (inline/2 sin 2 phi - cross cos 2 phi), V; k_ggi in V per unit
    of the channels.
    """
    cosine, sine = r.carriers
    return np.asarray(k_ggi * (inline / 2 * sine - cross * cosine))
