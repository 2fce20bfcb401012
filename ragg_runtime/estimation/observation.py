"""What of a flight is fitted: the four voltages, G_out, or the demodulated channels; in segments that fit into memory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from generated.output_effects import imu_saturation, saturation
from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import PAPER, Output, scale
from ragg_runtime.io import Flight
from ragg_runtime.model.record import Record, RecordedSeries, find_recorded, record
from ragg_runtime.signals.fir import convolve

BLOCKS = 24  # segments of time of which each keeps an R factor of its own
ROWS = 30000  # most samples of a segment: a few hundred columns of them in float64 take less than 100 MB


def make_block_edges(samples: int) -> NDArray[np.intp]:
    """(BLOCKS + 1,): samples at which the blocks of time begin and end."""
    return np.linspace(0, samples, BLOCKS + 1).astype(np.intp)


def divide_into_segments(samples: int, most: int = ROWS) -> list[slice]:
    """The segments of a flight, in order, of nearly the same length."""
    edges = np.linspace(0, samples, max(1, -(-samples // most)) + 1).astype(int).tolist()
    return [slice(a, b) for a, b in pairwise(edges)]


def split_at_blocks(rows: slice, samples: int) -> list[tuple[int, slice]]:
    """Some of the ``samples`` of a flight by the blocks of time that they lie in: (block, its rows in the flight)."""
    edges = make_block_edges(samples).tolist()
    parts = [(b, slice(max(x, rows.start), min(y, rows.stop))) for b, (x, y) in enumerate(pairwise(edges))]
    return [(b, part) for b, part in parts if part.start < part.stop]


def spread(segments: Sequence[slice], most: int) -> list[slice]:
    """Up to ``most`` of the segments, evenly spread."""
    if len(segments) <= most:
        return list(segments)
    return [segments[k] for k in np.linspace(0, len(segments) - 1, most).round().astype(int)]


Array = NDArray[np.float64]

# samples of a gap that are kept, four times as many as what is missing is interpolated from: noise is not followed over more
LONGEST_GAP = 1024


def observe_flights(
    flights: Sequence[Flight], instrument: Instrument, *, whole: bool = False
) -> list[Observation]:
    """Every output of every flight: several where the layout has several, those that were recorded.

    Unless ``whole``, they lack the middle of long gaps: there their times jump by as much as was not recorded.
    """
    observations = []
    for n, x in enumerate(flights):
        forms = [find_recorded(x, instrument.layout, k) for k in range(len(instrument.layout.outputs))]
        observations += [replace(observe(x, instrument, k), flight=n) for k, form in enumerate(forms) if form]
    return observations if whole else [_shorten_gaps(o) for o in observations]


def observe(flight: Flight, instrument: Instrument, place: int = 0) -> Observation:
    """The most informative form of an output of a flight: its voltages if recorded, else G_out, else the channels."""
    layout = instrument.layout
    o = layout.outputs[place]
    r = record(flight, instrument, place)
    form = find_recorded(flight, layout, place)
    if form is None:
        raise UserError(f"the flight lacks the output {o.name}", where=flight.path or flight.name)
    a = instrument.accelerometers
    k_ggi = scale(o, a["k_VI"] * a["K1"], instrument.radii + a["dR"])
    columns = form.columns(layout, o, flight.outputs) or ()
    if form.demodulated:
        rows = np.flatnonzero(np.isfinite([flight.outputs[c] for c in columns]).all(axis=0) & r.valid)
        spacing = int(np.median(np.diff(rows))) if len(rows) > 1 else 1
        inside = np.zeros(len(r.time), dtype=bool)  # elsewhere the demodulator has not seen enough
        inside[r.low_pass.before : len(r.time) - r.low_pass.ahead] = True
        r = replace(r, every=spacing, valid=r.valid & inside)
    series = form.series([flight.outputs[c] for c in columns], r, k_ggi)
    if not (form.demodulated or form.separate):
        r = replace(r, reading=series[0])
    valid = _find_usable(flight, o, r.valid, series)
    if len(r.time) <= ROWS:  # longer ones are cleaned part by part
        r = replace(r, wide={n: np.where(np.isfinite(x), x, 0.0) for n, x in r.wide.items()})
        r = replace(r, reading=None if r.reading is None else np.nan_to_num(r.reading))
    name = flight.name if len(layout.outputs) == 1 else f"{flight.name}: {o.name}"
    slopes = (a["k_VI"] * a["K1"])[list(o.members)]
    return Observation(
        recorded=form,
        record=replace(r, valid=valid),
        series=series,
        name=name,
        output=o,
        place=place,
        gains=slopes / np.mean(slopes) if form.separate else np.ones(len(series)),
        smoothed=any(f.kind == "motion-noise" for f in flight.flags),
    )


def _find_usable(
    flight: Flight, o: Output, valid: NDArray[np.bool_], series: Sequence[Array]
) -> NDArray[np.bool_]:
    """Which samples hold a number in every series, and neither output nor motion at the end of its range."""
    usable = np.array(valid)
    for x in series:
        usable &= np.isfinite(x)
    if o.name in flight.outputs:
        usable &= ~saturation.clipped(flight.outputs[o.name], usable)
    for name in imu_saturation.CHANNELS:
        if name in flight.channels:
            usable &= ~imu_saturation.clipped(flight.channels[name], usable)
    return usable


def _shorten_gaps(o: Observation) -> Observation:
    """An observation without the middle of its long gaps."""
    r = o.record
    near = ndimage.maximum_filter1d(r.valid, LONGEST_GAP + 1)
    if near.all():
        return o
    short = replace(
        r,
        time=r.time[near],
        wide={n: x[near] for n, x in r.wide.items()},
        valid=r.valid[near],
        reading=None if r.reading is None else r.reading[near],
    )
    return replace(o, record=short, series=tuple(x[near] for x in o.series))


@dataclass(frozen=True)
class Observation:
    """What of a flight, or of a part of one, is fitted: m output series over N samples, V, in the form ``recorded``.

    ``place`` counts the observations (one of each output of each flight), ``flight`` the flights; ``gains`` (m,) are the sheet's
    scale factors over their mean; ``thin``: of what record this is a thinned one; ``smoothed``: whether motion has been smoothed.
    """

    recorded: RecordedSeries
    record: Record
    series: tuple[Array, ...]
    name: str
    output: Output = PAPER.outputs[0]
    place: int = 0
    flight: int = 0
    gains: Array = field(default_factory=lambda: np.ones(1))
    thin: Thin | None = None
    smoothed: bool = False

    @cached_property
    def data(self) -> Array:
        """(m, N), V; zero where a sample is not valid."""
        return np.stack([np.where(self.record.valid, x, 0.0) for x in self.series])

    @property
    def segments(self) -> list[slice]:
        """Samples that are in memory together. Demodulated channels are not divided: their columns pass a two-sided filter."""
        n = len(self.record.time)
        return divide_into_segments(n, max(n, ROWS) if self.recorded.demodulated else ROWS)

    @property
    def flight_name(self) -> str:
        """Name of the flight, without that of the output."""
        return self.name.removesuffix(f": {self.output.name}")

    @property
    def signs(self) -> Array:
        """(m,): how much each series counts in the output."""
        return self.recorded.signs(self.output)

    @property
    def weights(self) -> Array:
        """(m,): how much of a common term of G_out each series sees (for voltages each is searched as one)."""
        return np.asarray(self.signs / len(self.signs))

    def part(self, rows: slice) -> Observation:
        """Some of the samples."""
        if (rows.start, rows.stop) == (0, len(self.record.time)):
            return self
        return replace(
            self,
            record=self.record.part(rows),
            series=tuple(np.array(x[rows]) for x in self.series),
            thin=None if self.thin is None else self.thin.part(rows),
        )


@dataclass(frozen=True)
class Thin:
    """Where the samples of a thinned observation come from: every so many of the ``whole``, through the low-pass ``taps`` (2 h +
    1,), about its middle; ``rows`` says which of those kept these are.
    """

    whole: Observation
    step: int
    taps: Array
    rows: slice

    def part(self, rows: slice) -> Thin:
        """Some of the samples."""
        first = self.rows.start
        return replace(self, rows=slice(first + rows.start, first + rows.stop))

    def source(self) -> Observation:
        """The part of the whole that the samples are made of."""
        return self.whole.part(
            slice(self.rows.start * self.step, (self.rows.stop - 1) * self.step + len(self.taps))
        )

    def decimate(self, x: Array) -> Array:
        """Series (..., N) over the :meth:`source`, thinned: (..., n), a copy."""
        return convolve(x, self.taps)[..., :: self.step].copy()


def measure_information_per_sample(r: Record) -> float:
    """How many times more informative a sample of the channels is than one of a record at the full rate."""
    from scipy import signal  # slow to import, and only records of channels need it

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
    kept = count + 2 * float(beside @ squares(turn))
    return max(1.0, whole / kept) if count else 1.0


def combine_output(o: Observation, e: Array) -> Array:
    """G_out (..., N) of what an observation holds (..., m, N): itself, or the sum of the voltages with their signs (Eq. 15)."""
    return np.asarray(np.einsum("m,...mn->...n", o.signs, e))
