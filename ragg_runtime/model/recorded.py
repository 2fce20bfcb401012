"""What of an output a flight holds: its voltages, the output itself, or what a demodulator has made of it."""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.layout import Layout, Output
from ragg_runtime.io import Flight
from ragg_runtime.io.record import DEMODULATED
from ragg_runtime.model.record import Record
from ragg_runtime.signals.demodulators import Demodulator
from ragg_runtime.signals.fir import convolved

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Recorded:
    """What of an output a flight holds, as m series over N samples; one, and as it is before demodulation, unless a form says else.

    ``kind``: one word for it, for programs; ``words``: for people. ``separate``: each accelerometer's voltage is a series of its own.
    ``demodulated``: by the recorder; then neighbouring samples are not independent, and the mean is lost.
    """

    kind: ClassVar[str]
    words: ClassVar[str]
    separate: ClassVar[bool] = False
    demodulated: ClassVar[bool] = False

    def columns(self, layout: Layout, o: Output, held: Container[str]) -> tuple[str, ...] | None:
        """The columns that hold it, among those that a flight has; ``None`` if not all are there."""
        raise NotImplementedError

    def series(self, columns: Sequence[Array], r: Record, k_ggi: float) -> tuple[Array, ...]:
        """What is fitted, m series (N,), V, made of its columns in SI; ``k_ggi`` in V s^2."""
        return tuple(columns)

    def signs(self, o: Output) -> Array:
        """(m,): how each series counts in the output."""
        return np.ones(1)

    def of_voltages(self, o: Output, v: Array, accelerometer: int | None) -> Array:
        """(m, N), V, before demodulation: of the members' voltages (members, N), or of one accelerometer's (N,)."""
        signs = np.array(o.signs, dtype=np.float64)
        G = signs @ v if accelerometer is None else signs[o.members.index(accelerometer - 1)] * v
        return np.asarray(G[None])

    def through(self, G: Array, r: Record, low: Demodulator | None = None) -> Array:
        """What the recorder lets pass of the output (..., N) before demodulation, by its low-pass or another one."""
        return G

    def noise_share(self, r: Record) -> float:
        """Variance of white noise of unit variance after :meth:`through`."""
        return 1.0


@dataclass(frozen=True)
class Voltages(Recorded):
    """The voltage of every accelerometer of the output: m = 4 in the paper's instrument."""

    kind = "voltages"
    words = "V_1 … V_4"
    separate = True

    def columns(self, layout: Layout, o: Output, held: Container[str]) -> tuple[str, ...] | None:
        return layout.voltages(o, held)

    def signs(self, o: Output) -> Array:
        return np.array(o.signs, dtype=np.float64)

    def of_voltages(self, o: Output, v: Array, accelerometer: int | None) -> Array:
        if accelerometer is None:
            return v
        full = np.zeros((len(o.members), v.shape[-1]))
        full[o.members.index(accelerometer - 1)] = v
        return full


@dataclass(frozen=True)
class Summed(Recorded):
    """The output itself, G_out: the sum of voltages with their signs (Eq. 15)."""

    kind = "G_out"
    words = "G_out"

    def columns(self, layout: Layout, o: Output, held: Container[str]) -> tuple[str, ...] | None:
        return (o.name,) if o.name in held else None


@dataclass(frozen=True)
class Channels(Recorded):
    """Inline and cross alone, of an instrument's only output; the data are the channels put back on their carriers."""

    kind = "channels"
    words = "inline and cross, put back on their carriers"
    demodulated = True

    def columns(self, layout: Layout, o: Output, held: Container[str]) -> tuple[str, ...] | None:
        return DEMODULATED if len(layout.outputs) == 1 and all(n in held for n in DEMODULATED) else None

    def series(self, columns: Sequence[Array], r: Record, k_ggi: float) -> tuple[Array, ...]:
        inline, cross = columns
        return (carried(inline, cross, r, k_ggi),)

    def through(self, G: Array, r: Record, low: Demodulator | None = None) -> Array:
        """Demodulated and put back on the carriers."""
        taps = (low or r.low_pass).centred
        cosine, sine = r.quadratures
        in_phase = convolved(2 * G * sine, taps, "same")
        quadrature = convolved(2 * G * cosine, taps, "same")
        cosine, sine = r.carriers
        return np.asarray(in_phase * sine + quadrature * cosine)

    def noise_share(self, r: Record) -> float:
        return float(2 * np.sum(r.low_pass.taps**2))


FORMS: tuple[Recorded, ...] = (Voltages(), Summed(), Channels())
"""The most telling first."""


def recorded(flight: Flight, layout: Layout, place: int) -> Recorded | None:
    """What of an output a flight holds, the most telling; ``None``: nothing."""
    o = layout.outputs[place]
    return next((form for form in FORMS if form.columns(layout, o, flight.outputs) is not None), None)


def carried(inline: Array, cross: Array, r: Record, k_ggi: float) -> Array:
    """Demodulated channels put back on carriers: k_ggi (inline/2 sin 2 phi - cross cos 2 phi), V; k_ggi in V per unit
    of the channels.
    """
    cosine, sine = r.carriers
    return np.asarray(k_ggi * (inline / 2 * sine - cross * cosine))
