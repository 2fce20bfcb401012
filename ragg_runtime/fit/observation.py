"""What of a flight is fitted: the four voltages, G_out, or the demodulated channels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime.base.errors import UserError
from ragg_runtime.fit.segments import ROWS
from ragg_runtime.flight import Flight
from ragg_runtime.flight.digits import Digits, digits_of
from ragg_runtime.flight.output_effects.saturation import saturation
from ragg_runtime.flight.spool import let_go
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import PAPER, Output, scale
from ragg_runtime.model.record import Record, record, recorded
from ragg_runtime.signals.demodulators import Demodulator
from ragg_runtime.signals.noise_spectrum import Noise

Array = NDArray[np.float64]


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
    columns: dict[str, float] = {o.name: 1.0}  # and their squares' weights in G_out
    if kind == "voltages":
        columns = dict.fromkeys(layout.voltages(o, flight.outputs) or (), 1.0)
        series = tuple(flight.outputs[v] for v in columns)
    elif kind == "G_out":
        series = (flight.outputs[o.name],)
    else:
        a = instrument.accelerometers
        k_ggi = scale(o, a["k_VI"] * a["K1"], instrument.radii + a["dR"])
        there = np.isfinite(flight.outputs["inline"]) & np.isfinite(flight.outputs["cross"]) & r.valid
        r = replace(r, every=_spacing(there))
        series = (carried(flight.outputs["inline"], flight.outputs["cross"], r, k_ggi),)
        columns = {"inline": k_ggi**2 / 8, "cross": k_ggi**2 / 2}
        inside = np.zeros(len(r.time), dtype=bool)  # elsewhere the demodulator has not seen enough
        inside[r.low_pass.before : len(r.time) - r.low_pass.ahead] = True
        r = replace(r, valid=r.valid & inside)
    valid = np.array(r.valid)
    for x in series:
        valid &= np.isfinite(x)
    clipped = saturation(flight.outputs[o.name], valid) if o.name in flight.outputs else None
    if clipped is not None:
        valid &= ~clipped[1]
    let_go(*flight.outputs.values())
    wide = r.wide
    if len(r.time) <= ROWS:  # longer ones are cleaned part by part
        wide = {n: np.where(np.isfinite(x), x, 0.0) for n, x in r.wide.items()}
    name = flight.name if len(layout.outputs) == 1 else f"{flight.name}: {o.name}"
    digits = digits_of(flight, instrument.units)
    return Observation(
        kind=kind,
        record=replace(r, valid=valid, wide=wide),
        series=series,
        name=name,
        output=o,
        place=place,
        digits=digits,
        rounded={
            n: w * digits.columns[n].mean_square(flight.outputs[n][valid])
            for n, w in columns.items()
            if n in digits.columns
        },
    )


@dataclass(frozen=True)
class Observation:
    """What of a flight, or of a part of one, is fitted: m output series over N samples.

    ``kind`` is ``G_out`` (m = 1), ``voltages`` (m = 4 in the paper's instrument, those of the output's accelerometers)
    or ``channels``: inline and cross are all that was recorded; then the data are the channels put back on their
    carriers (m = 1, see :func:`narrow`), and every column passes through the same demodulator. All in V.

    ``output`` is the output of the instrument that is observed; a flight with several makes as many observations,
    ``place`` counts them. ``digits`` says how the columns were written, ``rounded`` what those of the output make in G_out, V^2.
    """

    kind: str
    record: Record
    series: tuple[Array, ...]
    name: str
    output: Output = PAPER.outputs[0]
    place: int = 0
    digits: Digits = field(default_factory=Digits)
    rounded: Mapping[str, float] = field(default_factory=dict)
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
    """Demodulated channels put back on carriers: k_ggi (inline/2 sin 2 phi - cross cos 2 phi), V.

    ``k_ggi`` in V per unit of the channels.
    """
    cosine, sine = r.carriers
    return np.asarray(k_ggi * (inline / 2 * sine - cross * cosine))


def narrow(G: Array, r: Record, through: Demodulator | None = None) -> Array:
    """G_out (..., N) as the demodulator, the record's own or another, lets it through: demodulated and put back on the carriers."""
    taps = (through or r.low_pass).centred.reshape((1,) * (G.ndim - 1) + (-1,))
    cosine, sine = r.quadratures
    in_phase = signal.oaconvolve(2 * G * sine, taps, mode="same", axes=-1)
    quadrature = signal.oaconvolve(2 * G * cosine, taps, mode="same", axes=-1)
    cosine, sine = r.carriers
    return np.asarray(in_phase * sine + quadrature * cosine)


def _spacing(there: NDArray[np.bool_]) -> int:
    """Samples from one of channels to the next."""
    at = np.flatnonzero(there)
    return max(1, int(np.median(np.diff(at)))) if len(at) > 1 else 1


def telling(r: Record) -> float:
    """How many times more a sample of the channels tells than one of a record of all of them: samples of noise in so narrow a
    band are much alike, and those that are left out would have told little.
    """
    taps, n = r.low_pass.taps, len(r.time)
    reach = min(len(taps), n)
    lags = np.arange(1, reach)
    alike = signal.correlate(taps, taps)[len(taps) :][: reach - 1] / float(np.sum(taps**2))

    def squares(turn: float) -> Array:
        return np.asarray(np.square(alike * np.cos(turn * lags)))

    x = r.valid.astype(np.float64)
    count = float(np.sum(x))
    beside = np.rint(signal.correlate(x, x, method="fft"))[n:][: reach - 1]
    whole = count + 2 * float(np.maximum(count - lags, 0.0) @ squares(4 * np.pi * r.spin_frequency / r.rate))
    turn = np.pi / (2 * r.every) if r.every > 1 else 4 * np.pi * r.spin_frequency / r.rate
    own = count + 2 * float(beside @ squares(turn))
    return max(1.0, whole / own) if count else 1.0


def noise_gain(r: Record) -> float:
    """Variance of white noise of unit variance after :func:`narrow`."""
    return float(2 * np.sum(r.low_pass.taps**2))


def as_output(o: Observation, e: Array) -> Array:
    """G_out (..., N) of what an observation holds (..., m, N): itself, or the sum of the voltages with their signs (Eq. 15)."""
    return np.asarray(np.einsum("m,...mn->...n", output_weights(o), e))


def output_weights(o: Observation) -> Array:
    """(m,): how much each output of an observation counts in G_out."""
    return len(o.weights) * o.weights if o.kind == "voltages" else o.weights
