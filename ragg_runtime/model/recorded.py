"""What of an output a flight holds: its voltages, the output itself, or what a demodulator has made of it."""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.layout import Layout, Output
from ragg_runtime.io import Flight
from ragg_runtime.io.record import DEMODULATED
from ragg_runtime.model.record import Record
from ragg_runtime.signals.fir import convolve

Array = NDArray[np.float64]


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

    def columns(self, layout: Layout, o: Output, held: Container[str]) -> tuple[str, ...] | None:
        """The columns that hold it, among those that a flight has; ``None`` if not all are there."""
        if self.separate:
            return layout.voltages(o, held)
        wanted = DEMODULATED if self.demodulated else (o.name,)
        alone = len(layout.outputs) == 1 or not self.demodulated
        return wanted if alone and all(n in held for n in wanted) else None

    def series(self, columns: Sequence[Array], r: Record, k_ggi: float) -> tuple[Array, ...]:
        """What is fitted, m series (N,), V, made of its columns in SI; ``k_ggi`` in V s^2."""
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
        """What the recorder lets pass of the output (..., N) before demodulation."""
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
