"""The gravity gradient in one segment of a flight: what the model explains removed, demodulated, and how sure it is.

With e = G_out - model(motion, no gradient), inline + i cross are the low-pass of e (4 sin 2 phi - 2 i cos 2 phi) /
k_ggi. The model's own response to that first estimate then replaces the ideal one, which leaves the second order.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import IntFlag
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation.calibrated import base, inverse, with_sheet
from ragg_runtime.estimation.calibration import Calibration
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.least_squares import join
from ragg_runtime.estimation.observation import BLOCKS, Observation, as_output, block_edges
from ragg_runtime.estimation.scores import Stretch as Stretched
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import X_AXIS, Y_AXIS
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.instrument.units import EOTVOS, units
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model import lateness
from ragg_runtime.model.evaluate import scale_factor, unit_factor
from ragg_runtime.model.evaluator import Evaluator, changes
from ragg_runtime.model.model import Model
from ragg_runtime.model.record import Record
from ragg_runtime.signals.demodulators import Demodulator, demodulator
from ragg_runtime.signals.means import between
from ragg_runtime.signals.tensor import across

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Stretch:
    """Samples ``first`` to ``last`` of a flight with ``p`` (size,) in SI; ``directions`` (k, size): independent steps
    of one standard deviation from ``about``.
    """

    first: int
    last: int
    p: Array
    about: Array
    directions: Array

    def along(self, basis: Array) -> Stretch:
        """The same with fewer directions: ``basis`` (k, r), orthonormal columns."""
        return replace(self, directions=basis.T @ self.directions)


def stretch_of(c: Calibration, first: int, last: int, p: Array, root: Array) -> Stretch:
    """Samples ``first`` to ``last`` with parameters ``p``; ``root`` (n, k) of their covariance, in scales."""
    scale = np.array([q.scale for q in c.columns])
    directions = np.zeros((root.shape[1], len(p)))
    directions[:, c.index] = root.T * scale
    return Stretch(first=first, last=last, p=p, about=c.p, directions=directions)


def whole(c: Calibration, root: Array, samples: int) -> tuple[Stretch, ...]:
    """One calibration for all samples; ``root`` (n, k) of its covariance, in scales."""
    return (stretch_of(c, 0, samples, c.p, root),)


def crossed(f: Fitted) -> list[tuple[Stretch, ...]]:
    """Of every observation: each block of time with the calibration on everything else."""
    c = f.calibration
    scale = np.array([q.scale for q in c.columns])
    all_of = [base(x, f.n_base) for x in f.triangles]
    found = []
    for o in f.observations:
        edges = block_edges(len(o.record.time))
        stretches = []
        for b in range(BLOCKS):
            block = (o.flight, b)
            others = [
                t
                for x, ts in zip(f.observations, all_of, strict=True)
                for y, t in enumerate(ts)
                if (x.flight, y) != block
            ]
            normal = with_sheet(join(others), f.to_nominal)
            p = c.p.copy()
            p[c.index] += normal.step * scale
            stretches.append(stretch_of(c, int(edges[b]), int(edges[b + 1]), p, inverse(normal.R)))
        found.append(tuple(stretches))
    return found


def within(stretches: Sequence[Stretch], first: int, last: int) -> list[tuple[slice, Stretch]]:
    """The stretches of samples first ... last, with their places counted from ``first``."""
    found = []
    for s in stretches:
        a, b = max(s.first, first), min(s.last, last)
        if a < b:
            found.append((slice(a - first, b - first), s))
    return found


Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]

HOLES = 0.05
"""Share of the kernel that may fall on missing samples; they are bridged by the gradient found around them."""

BRIDGES = 2
"""Times that holes are filled with the gradient found: what remains is the share of the holes to this power + 1."""

STEP = 1e-4
"""Standard deviations of a difference that is a derivative: what is of second order (up to 1000 Eo a standard deviation
of the sheet, few of what a record leaves of it) stays below 0.1 Eo. A smaller one loses digits of the parameters: at 1e-5 it
was 0.016 Eo of 0.2, at 1e-4 0.002, of the example."""

FINE = 4.0
"""Rate, Hz, at which the uncertainty is followed: what the low-pass lets through does not change faster than 0.25 Hz."""

MARGIN = 0.1
"""By this share of its calibrated range a channel may go beyond it before that is flagged."""


class Quality(IntFlag):
    """Bits of ``quality``; 0 is good."""

    EDGE = 1
    GAP = 2
    BRIDGED = 4
    MOTION = 8
    AUXILIARY = 16
    CALIBRATION = 32


NO_VALUE = Quality.EDGE | Quality.GAP
"""Bits of samples without a value."""

MEANING = {
    Quality.EDGE: "the low-pass has not heard enough at this end of the record: no value",
    Quality.GAP: "more than 5 % of what the low-pass hears is missing: no value",
    Quality.BRIDGED: "a missing or saturated sample within reach was bridged",
    Quality.MOTION: "a motion channel is beyond the range that the calibration knows",
    Quality.AUXILIARY: "an auxiliary channel is beyond the range that the calibration knows",
    Quality.CALIBRATION: "the frozen calibration does not hold for this flight",
}
"""What each bit says."""


@dataclass(frozen=True)
class Setting:
    """What is the same for all segments of a flight.

    ``observation``: the whole flight, without recorded gradients, and one of its outputs. ``recorded``: inline + i
    cross (N,), Eo, if the flight was demodulated by its recorder. ``noise``: standard deviations of inline and cross
    that the noise causes, Eo. ``validity``: channel -> range, SI; empty: not flagged. ``rest``: variance, Eo^2, by
    directions that are not followed.  ``sheet`` (size,): the parameters as model.toml has them.
    """

    model: Model
    evaluator: Evaluator
    demodulator: Demodulator
    observation: Observation
    recorded: Complex | None
    stretches: tuple[Stretch, ...]
    noise: tuple[float, float]
    validity: dict[str, tuple[float, float]]
    sheet: Array
    rest: tuple[float, float] = (0.0, 0.0)

    @property
    def every(self) -> int:
        """Samples in a second: the channels hold nothing above half a hertz."""
        return max(1, int(self.demodulator.rate))

    def reach(self, holes: bool) -> tuple[int, int]:
        """Samples before and after a segment that its values depend on."""
        times = 2 + (BRIDGES if holes else 0)
        return times * self.demodulator.before, times * self.demodulator.ahead


@dataclass(frozen=True)
class Series:
    """Compensated samples.

    ``gradient`` (n,): inline + i cross, Eo, NaN where there is none. ``nominal``: the residual, V, with the sheet's values, of
    these samples. ``parameters`` (2, n): standard deviations by the parameters, Eo;
    ``std`` (2, n): with the noise. ``quality`` (n,): bits of :class:`Quality`.
    """

    rows: slice
    gradient: Complex
    nominal: Stretched
    parameters: Array
    std: Array
    quality: NDArray[np.int64]

    @property
    def good(self) -> Mask:
        return np.isfinite(self.gradient.real)


class Segment:
    """One segment, with so much of its neighbours as its values depend on."""

    def __init__(self, s: Setting, rows: slice, *, holes: bool) -> None:
        n = len(s.observation.record.time)
        before, after = s.reach(holes)
        self.s = s
        self.rows = rows
        self.first, self.last = max(0, rows.start - before), min(n, rows.stop + after)
        self.own = slice(rows.start - self.first, rows.stop - self.first)
        o = s.observation.part(slice(self.first, self.last))
        self.record: Record = o.record
        self.G = as_output(o, o.data)
        moved, rest = lateness.about(s.model, self.record, s.stretches[0].about)
        self.late = s.stretches[0].about - rest
        self.x = [None if n in GRADIENT else moved.series(n) for n in s.model.chain.INPUTS]
        self.places = {name: k for k, name in enumerate(s.model.chain.INPUTS) if name in GRADIENT}
        phi = self.record.demodulation_angle
        self.sine, self.cosine = np.sin(2 * phi), np.cos(2 * phi)
        self.parts = within(s.stretches, self.first, self.last)
        self.k = np.empty(len(phi))
        for some, stretch in self.parts:
            self.k[some] = scale_factor(s.model, stretch.p, o.place)
        self.mixer = np.stack([4 * self.sine / self.k, -2 * self.cosine / self.k])
        self.bare = self.output()

    def output(self) -> Array:
        """G_out (N,), V, of the present inputs."""
        G = np.empty(len(self.k))
        for some, stretch in self.parts:
            G[some] = self.by(stretch.p, some)
        return G

    def by(self, p: Array, some: slice = slice(None)) -> Array:
        """G_out (n,), V, of some samples by parameters p (size,), SI."""
        r, place = self.record, self.s.observation.place
        q = p - self.late
        return self.s.evaluator.output(r.time[some], self.inputs(some), q, r.phi[some], which=place)

    def inputs(self, some: slice) -> list[Array | None]:
        """The model's inputs of some samples; ``None``: zero."""
        return [None if x is None else x[some] for x in self.x]

    def mixed(self, e: Array) -> Complex:
        """inline + i cross (N,), Eo, of residuals (N,), V, before the low-pass."""
        mixed = np.empty(len(e), dtype=np.complex128)
        np.multiply(self.mixer[0], e, out=mixed.real)
        np.multiply(self.mixer[1], e, out=mixed.imag)
        return mixed

    def demodulated(self, e: Array) -> Complex:
        """inline + i cross (N,), Eo, of residuals (N,), V."""
        return self.s.demodulator.low_passed(self.mixed(e))

    def carried(self, g: Complex) -> Array:
        """What an ideal instrument makes of channels (N,), Eo: V."""
        return np.asarray(self.k * (g.real / 2 * self.sine - g.imag * self.cosine))

    def put(self, g: Complex) -> None:
        """Let the model see this gradient, Eo, which is across the axis of the disc."""
        axes = self.record.axes or (X_AXIS, Y_AXIS)
        parts = across(axes, EOTVOS * g.real, EOTVOS * g.imag)
        for name, place in self.places.items():
            self.x[place] = parts[GRADIENT.index(name)]

    def first_estimate(self) -> Complex:
        """The gradient as an ideal instrument would have seen it; holes are bridged."""
        valid = self.record.valid
        if self.s.recorded is not None:
            rec = np.where(valid, self.s.recorded[self.first : self.last], 0.0)
            return np.asarray(rec - self.demodulated(self.bare))
        e = self.G - self.bare
        if valid.all():
            return self.demodulated(e)
        e[~valid] = 0.0
        g = self.demodulated(e)
        for _ in range(BRIDGES):
            e[~valid] = self.carried(g)[~valid]
            g = self.demodulated(e)
        return g

    def gradient(self) -> Complex:
        """(N,) Eo: the gradient as this instrument sees it; the model is left with it as its input."""
        g = self.first_estimate()
        self.put(g)
        off = self.mixed(self.output() - self.bare - self.carried(g)).astype(np.complex64)
        return np.asarray(g - self.s.demodulator.low_passed(off))

    def directions(self) -> int:
        return len(self.parts[0][1].directions)

    def by_parameters(self) -> NDArray[np.complex64]:
        """(directions, N / few): how the gradient changes, to first order, a standard deviation along each direction,
        Eo; means over :data:`FINE` samples.
        """
        few, d = self.fewer
        count = len(self.k) // few
        mixed = np.empty((self.directions(), count), dtype=np.complex64)
        r, place = self.record, self.s.observation.place
        for some, stretch in self.parts:
            # a mean that two stretches share is that of the first
            first, last = -(-some.start // few), -(-some.stop // few)
            own = slice(first * few, min(last * few, count * few))
            if own.start >= own.stop:
                continue
            found = changes(
                self.s.evaluator,
                r.time[own],
                self.inputs(own),
                stretch.about - self.late,
                STEP * stretch.directions,
                r.phi[own],
                few,
                self.mixer[:, own] / STEP,
                place,
            )
            mixed[:, first : min(last, count)].real = found[:, 0]
            mixed[:, first : min(last, count)].imag = found[:, 1]
        return d.low_passed(mixed)

    @property
    def fewer(self) -> tuple[int, Demodulator]:
        """Samples of which the mean enters the uncertainty, and the low-pass at that rate."""
        d = self.s.demodulator
        few = max(1, int(d.rate // FINE))
        return few, demodulator(d.name, d.rate / few)

    def variance(self) -> Array:
        """(2, N) Eo^2: of inline and cross, by the parameters."""
        few, _ = self.fewer
        changes = self.by_parameters()
        total = np.stack([np.sum(changes.real**2, axis=0), np.sum(changes.imag**2, axis=0)])
        return between(total, few, len(self.k))

    def nominal(self) -> Stretched:
        """The residual of the segment's own samples, V, with the sheet's values and without a gradient."""
        r, own = self.record, self.own
        e = self.G - self.s.observation.recorded.through(self.by(self.s.sheet), r)
        e = np.where(r.valid, e, 0.0)[None, own]
        return Stretched(e, r.demodulation_angle[own], np.array(r.valid[None, own]), np.array(r.valid[own]))

    def quality(self) -> NDArray[np.int64]:
        """(N,): bits of the segment's samples."""
        d = self.s.demodulator
        n, total = len(self.k), len(self.s.observation.record.time)
        bits = np.zeros(n, dtype=np.int64)
        head, tail = d.settling
        bits[: max(0, head - self.first)] |= Quality.EDGE
        if self.last > total - tail:
            bits[max(0, total - tail - self.first) :] |= Quality.EDGE
        missing = ~self.record.valid
        if missing.any():
            if self.s.recorded is not None:
                bits[missing] |= Quality.GAP
            else:
                weights = replace(d, taps=np.abs(d.taps) / np.sum(np.abs(d.taps)))
                share = weights.low_passed(missing.astype(np.complex128)).real
                bits[share > HOLES] |= Quality.GAP
                bits[(share > FELT) & (share <= HOLES)] |= Quality.BRIDGED
        for name, (low, high) in self.s.validity.items():
            if name == "time" or name in GRADIENT or name == "spin_angle":
                continue
            x = self.record.channels.get(name)
            if x is None:
                continue
            room = MARGIN * (high - low)
            if np.min(x) >= low - room and np.max(x) <= high + room:
                continue
            beyond = (x < low - room) | (x > high + room)
            moving = name.partition("_")[0] in ("a", "omega", "omegadot")
            bits[beyond] |= Quality.MOTION if moving else Quality.AUXILIARY
        return bits


FELT = 1e-4
"""Share of the kernel on missing samples from which their bridging is told."""


def series(s: Setting, rows: slice, *, holes: bool) -> Series:
    """Compensate one segment."""
    segment = Segment(s, rows, holes=holes)
    nominal = segment.nominal()
    g = np.array(segment.gradient()[segment.own])
    variance = segment.variance()[:, segment.own] + np.array(s.rest)[:, None]
    bits = segment.quality()[segment.own]
    parameters, std = np.sqrt(variance), np.sqrt(variance + np.array(s.noise)[:, None] ** 2)
    none = (bits & NO_VALUE) != 0
    if none.any():
        g[none] = complex(np.nan, np.nan)
        parameters[:, none] = std[:, none] = np.nan
    return Series(rows=rows, gradient=g, nominal=nominal, parameters=parameters, std=std, quality=bits)


def basis(s: Setting, samples: Sequence[slice], neglected: float) -> tuple[Array, tuple[float, float]]:
    """(k, r): the directions of the parameters that matter, found on some stretches of a flight; and what the others
    add on the average to the variance of inline and cross, Eo^2: less than ``neglected`` of the noise's.
    """
    inline, cross = [], []
    for some in samples:
        segment = Segment(s, some, holes=False)
        segment.gradient()
        few, coarse = segment.fewer
        step = max(1, int(coarse.rate))  # the channels do not change within a second
        inside = slice(-(-segment.own.start // few), segment.own.stop // few, step)
        valued = (segment.quality() & NO_VALUE) == 0
        found = segment.by_parameters()[:, inside]
        there = valued[few // 2 :: few][inside][: found.shape[1]]
        if there.any():
            found = found[:, there]
        inline.append(found.real / s.noise[0])
        cross.append(found.imag / s.noise[1])
    D = np.concatenate([*inline, *cross], axis=1)
    U, _, _ = np.linalg.svd(D, full_matrices=False)
    share = np.cumsum((U.T @ D) ** 2, axis=0)
    left = share[-1] - share
    kept = int(np.argmax(np.max(left, axis=1) <= neglected))
    of_inline, of_cross = np.split(left[kept], 2)  # as many instants of both
    rest = np.mean(of_inline) * s.noise[0] ** 2, np.mean(of_cross) * s.noise[1] ** 2
    return U[:, : kept + 1], (float(rest[0]), float(rest[1]))


def neutral(model: Model, instrument: Instrument, p: Array) -> list[tuple[str, str | None, Array]]:
    """(name, effect, p with it at its neutral value) of everything that a model removes."""
    places, start = {}, 0
    for name, size in model.chain.PARAMETERS:
        places[name] = slice(start, start + size)
        start += size
    found: list[tuple[str, str | None, Array]] = []
    known = units(instrument.g0)
    for e in model.effects:
        changed = p.copy()
        for q in e.parameters:
            if q.fitted:
                changed[places[q.symbol]] = (q.neutral or 0.0) * unit_factor(q.unit, known)
        found.append((e.id, e.id, changed))
    for q0 in PARAMETERS:
        changed = p.copy()
        own = changed[places[q0.name]]
        # of a gain the mean carries the gradient itself: what disturbs is that the four differ
        changed[places[q0.name]] = np.mean(own) if q0.required else 0.0
        name = f"imbalance of {q0.name}" if q0.required else q0.name
        if not np.array_equal(changed, p):
            found.append((name, None, changed))
    return found


def contributions(
    s: Setting, samples: Sequence[slice], model: Model, instrument: Instrument
) -> list[dict[str, Any]]:
    """Root mean squares of inline and cross, Eo, on some stretches of a flight, largest first."""
    totals: dict[tuple[str, str | None], Array] = {}
    count = 0
    for rows in samples:
        p = s.stretches[0].p
        one = replace(s.stretches[0], first=0, last=len(s.observation.record.time))
        segment = Segment(replace(s, stretches=(one,)), rows, holes=False)
        good = (segment.quality()[segment.own] & NO_VALUE) == 0
        count += int(np.sum(good))
        for name, effect, changed in [("everything", None, np.zeros_like(p)), *neutral(model, instrument, p)]:
            e = segment.bare if name == "everything" else segment.bare - segment.by(changed)
            g = segment.demodulated(e)[segment.own][good]
            part = np.array([np.sum(g.real**2), np.sum(g.imag**2)])
            totals[name, effect] = totals.get((name, effect), np.zeros(2)) + part
    rows_ = []
    for (name, effect), squares in totals.items():
        inline, cross = np.sqrt(squares / count) if count else (np.nan, np.nan)
        if inline or cross:
            rows_.append({"of": name, "effect": effect, "inline_Eo": float(inline), "cross_Eo": float(cross)})
    return sorted(rows_, key=lambda r: -float(r["inline_Eo"] ** 2 + r["cross_Eo"] ** 2)) if count else []
