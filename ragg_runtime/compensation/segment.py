"""The gravity gradient in one segment of a flight: what the model explains removed, demodulated, and how sure it is.

With e = G_out - model(motion, no gradient), inline + i cross are the low-pass of e (4 sin 2 phi - 2 i cos 2 phi) /
k_ggi. The model's own response to that first estimate then replaces the ideal one, which leaves the second order.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import IntFlag

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.calibration import Calibration
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import Observation, combine_output
from ragg_runtime.estimation.regressors import Column, put_derivatives
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import X_AXIS, Y_AXIS
from ragg_runtime.instrument.units import EOTVOS
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model import lateness
from ragg_runtime.model.evaluate import scale_factor, vector
from ragg_runtime.model.evaluator import Evaluator
from ragg_runtime.model.model import Model
from ragg_runtime.signals.demodulators import Demodulator, find_demodulator
from ragg_runtime.signals.tensor import spread_across

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

HOLES = 0.05
"""Share of the kernel that may fall on missing samples; they are bridged by the gradient found around them."""

FELT = 1e-4
"""Share of the kernel on missing samples from which their bridging is reported."""

BRIDGES = 2
"""Times that holes are filled with the gradient found: what remains is the share of the holes to this power + 1."""

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
    Quality.EDGE: "too near an end of the record for the low-pass: no value",
    Quality.GAP: "with more than 5 % of the samples missing under the low-pass: no value",
    Quality.BRIDGED: "with a missing or saturated sample that was bridged",
    Quality.MOTION: "with a motion channel outside its range in the saved calibration",
    Quality.AUXILIARY: "with another channel outside its range in the saved calibration",
    Quality.CALIBRATION: "by a calibration that does not hold for this flight",
}
"""What each bit says of samples."""


@dataclass(frozen=True)
class Block:
    """Samples of a flight with parameters ``p`` (size,), SI; ``root`` (n, k): of the covariance of those fitted, in scales."""

    rows: slice
    p: Array
    root: Array


def make_block(c: Calibration, rows: slice, step: Array | float, root: Array) -> Block:
    """Samples with parameters a ``step`` (n,) from the calibrated ones, in scales."""
    p = c.p.copy()
    p[c.index] += step * np.array([q.scale for q in c.columns])
    return Block(rows, p, root)


@dataclass(frozen=True)
class OutputChannel:
    """One output of a flight, with what compensates it.

    ``observation``: the whole flight, without recorded gradients. ``recorded``: inline + i cross (N,), Eo, if the flight was
    demodulated by its recorder. ``about`` (size,): the calibrated parameters, SI, of which ``columns`` are fitted. ``k_ggi``: V/Eo.
    ``spectrum``: the noise, and ``noise`` the standard deviations of inline and cross that it causes, Eo. ``validity``: channel ->
    range, SI; empty: not flagged. ``flags``: bits of the quality of all samples.
    """

    model: Model
    instrument: Instrument
    evaluator: Evaluator
    demodulator: Demodulator
    observation: Observation
    recorded: Complex | None
    blocks: tuple[Block, ...]
    about: Array
    columns: tuple[Column, ...]
    k_ggi: float
    spectrum: NoiseModel
    noise: tuple[float, float]
    validity: Mapping[str, tuple[float, float]]
    flags: int = 0


@dataclass(frozen=True)
class Compensated:
    """Compensated samples.

    ``gradient`` (n,): inline + i cross, Eo, NaN where there is none. ``nominal`` (n,): the residual, V, with the sheet's values.
    ``parameters`` (2, n): standard deviations by the parameters, Eo; ``std`` (2, n): with the noise. ``quality`` (n,): bits of
    :class:`Quality`.
    """

    gradient: Complex
    nominal: Array
    parameters: Array
    std: Array
    quality: NDArray[np.int64]


class ChannelSegment:
    """Samples ``rows`` of a channel, with so much of their neighbours as their values depend on, N samples together."""

    def __init__(self, c: OutputChannel, rows: slice, *, holes: bool = False) -> None:
        d, o = c.demodulator, c.observation
        times = 2 + (BRIDGES if holes else 0)
        self.c = c
        self.total = len(o.record.time)
        self.first = max(0, rows.start - times * d.before)
        self.last = min(self.total, rows.stop + times * d.ahead)
        self.own = slice(rows.start - self.first, rows.stop - self.first)
        part = o.part(slice(self.first, self.last))
        self.record = part.record
        self.G = combine_output(part, part.data)
        moved, rest = lateness.move_record(c.model, self.record, c.about)
        self.late = c.about - rest
        self.x = moved.inputs(c.model.chain)
        self.x[[n in GRADIENT for n in c.model.chain.INPUTS]] = 0.0
        phi = self.record.demodulation_angle
        self.sine, self.cosine = np.sin(2 * phi), np.cos(2 * phi)
        self.parts = [
            (slice(max(b.rows.start - self.first, 0), min(b.rows.stop, self.last) - self.first), b)
            for b in c.blocks
            if max(b.rows.start, self.first) < min(b.rows.stop, self.last)
        ]
        self.k = np.empty(len(phi))
        for some, b in self.parts:
            self.k[some] = scale_factor(c.model, b.p, o.place)
        self.mixer = np.stack([4 * self.sine / self.k, -2 * self.cosine / self.k])
        self.bare = self.predict()

    def predict(self) -> Array:
        """G_out (N,), V, of the present inputs."""
        G = np.empty(len(self.k))
        for some, b in self.parts:
            G[some] = self.predict_by(b.p, some)
        return G

    def predict_by(self, p: Array, some: slice = slice(None)) -> Array:
        """G_out (n,), V, of some samples by parameters p (size,), SI."""
        r = self.record
        return self.c.evaluator.output(
            r.time[some], self.x[:, some], p - self.late, r.phi[some], which=self.c.observation.place
        )

    def mix(self, e: Array) -> Complex:
        """inline + i cross (N,), Eo, of residuals (N,), V, before the low-pass."""
        mixed = np.empty(len(e), dtype=np.complex128)
        np.multiply(self.mixer[0], e, out=mixed.real)
        np.multiply(self.mixer[1], e, out=mixed.imag)
        return mixed

    def demodulate(self, e: Array) -> Complex:
        """inline + i cross (N,), Eo, of residuals (N,), V."""
        return self.c.demodulator.low_passed(self.mix(e))

    def ideal_response(self, g: Complex) -> Array:
        """What an ideal instrument makes of channels (N,), Eo: V."""
        return np.asarray(self.k * (g.real / 2 * self.sine - g.imag * self.cosine))

    def first_estimate(self) -> Complex:
        """The gradient (N,), Eo, as an ideal instrument would have seen it; holes are bridged."""
        missing = ~self.record.valid
        if self.c.recorded is not None:
            recorded = np.where(missing, 0.0, self.c.recorded[self.first : self.last])
            return np.asarray(recorded - self.demodulate(self.bare))
        e = self.G - self.bare
        e[missing] = 0.0
        g = self.demodulate(e)
        for _ in range(BRIDGES if missing.any() else 0):
            e[missing] = self.ideal_response(g)[missing]
            g = self.demodulate(e)
        return g

    def gradient(self) -> Complex:
        """(N,) Eo: the gradient as this instrument sees it; the model is left with it as its input, across the axis of the disc."""
        g = self.first_estimate()
        parts = spread_across(self.record.axes or (X_AXIS, Y_AXIS), EOTVOS * g.real, EOTVOS * g.imag)
        for n, name in enumerate(self.c.model.chain.INPUTS):
            if name in GRADIENT:
                self.x[n] = parts[GRADIENT.index(name)]
        off = self.mix(self.predict() - self.bare - self.ideal_response(g)).astype(np.complex64)
        return np.asarray(g - self.c.demodulator.low_passed(off))

    def change_by_parameters(self, few: int) -> Array:
        """(n, 2, N // few) Eo: inline and cross, before the low-pass, by the fitted parameters, each times its scale; means of ``few``."""
        c, count = self.c, len(self.k) // few
        columns = np.zeros((len(c.columns), len(c.observation.series), len(self.k)))
        chain = c.model.evaluators("chain")
        put_derivatives(columns, chain, c.columns, self.x, self.record, c.observation, c.about - self.late)
        J = combine_output(c.observation, columns)[:, : count * few].reshape(len(columns), count, few)
        mixer = self.mixer[:, : count * few].reshape(2, count, few) / few
        return np.asarray(np.einsum("wcf,ncf->nwc", mixer, J))

    def variance(self) -> Array:
        """(2, N) Eo^2: of inline and cross, by the parameters."""
        few = max(1, int(self.c.demodulator.rate // FINE))
        low_pass = find_demodulator(self.c.demodulator.name, self.c.demodulator.rate / few)
        change = self.change_by_parameters(few)
        count = change.shape[-1]
        along = np.empty(
            (self.parts[0][1].root.shape[1], 2, count)
        )  # independent steps of one standard deviation
        for some, b in self.parts:
            # a mean that two blocks share is that of the first
            own = slice(-(-some.start // few), min(-(-some.stop // few), count))
            along[..., own] = np.tensordot(b.root.T, change[..., own], 1)
        total = np.sum(low_pass.low_passed(along) ** 2, axis=0)
        centres = few * np.arange(count) + (few - 1) / 2  # the variance is linear between them
        return np.stack([np.interp(np.arange(len(self.k)), centres, x) for x in total])

    def nominal(self) -> Array:
        """(N,) V: the residual with the sheet's values and without a gradient, 0 where there is no sample."""
        r, sheet = self.record, vector(self.c.model, self.c.instrument)
        e = self.G - self.c.observation.recorded.through(self.predict_by(sheet), r)
        return np.where(r.valid, e, 0.0)

    def quality(self) -> NDArray[np.int64]:
        """(N,): bits of the samples."""
        bits = np.full(len(self.k), self.c.flags, dtype=np.int64)
        head, tail = self.c.demodulator.settling
        bits[: max(0, head - self.first)] |= Quality.EDGE
        if self.last > self.total - tail:
            bits[max(0, self.total - tail - self.first) :] |= Quality.EDGE
        self._flag_holes(bits)
        for name, (low, high) in self.c.validity.items():
            x = self.record.channels.get(name)
            if x is None or name in ("time", "spin_angle", *GRADIENT):
                continue
            moving = name.partition("_")[0] in ("a", "omega", "omegadot")
            beyond = np.maximum(low - x, x - high) > MARGIN * (high - low)
            bits[beyond] |= Quality.MOTION if moving else Quality.AUXILIARY
        return bits

    def _flag_holes(self, bits: NDArray[np.int64]) -> None:
        missing, d = ~self.record.valid, self.c.demodulator
        if self.c.recorded is not None:
            bits[missing] |= Quality.GAP
        elif missing.any():
            weights = replace(d, taps=np.abs(d.taps) / np.sum(np.abs(d.taps)))
            share = weights.low_passed(missing.astype(np.complex128)).real
            bits[share > HOLES] |= Quality.GAP
            bits[(share > FELT) & (share <= HOLES) & (bits & NO_VALUE == 0)] |= Quality.BRIDGED


def compensate_segment(c: OutputChannel, rows: slice, *, holes: bool) -> Compensated:
    """Compensate samples ``rows`` of a channel; ``holes``: whether samples are missing anywhere in it."""
    s = ChannelSegment(c, rows, holes=holes)
    nominal = s.nominal()[s.own]
    g = np.array(s.gradient()[s.own])
    variance = s.variance()[:, s.own]
    bits = s.quality()[s.own]
    parameters, std = np.sqrt(variance), np.sqrt(variance + np.array(c.noise)[:, None] ** 2)
    none = (bits & NO_VALUE) != 0
    g[none] = complex(np.nan, np.nan)
    parameters[:, none] = std[:, none] = np.nan
    return Compensated(g, nominal, parameters, std, bits)
