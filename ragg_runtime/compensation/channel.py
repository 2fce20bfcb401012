"""The gravity gradient by one output of a flight: the series, its uncertainty, and a quality for each sample."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import IntFlag

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import progress
from ragg_runtime.base.progress import split_range
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import ROWS, combine_output
from ragg_runtime.estimation.regressors import Column, put_derivatives
from ragg_runtime.estimation.unknown_gradient import ModelledOutput, measure_spin_frequency
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.signals.demodulators import find_demodulator

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

# share of the kernel that may fall on missing samples; they are bridged by the gradient found around them
HOLES = 0.05
FELT = 1e-4  # share of the kernel on missing samples from which their bridging is reported
# rate, Hz, at which the uncertainty is followed: what the low-pass lets through does not change faster than 0.25 Hz
FINE = 4.0
MARGIN = 0.1  # by this share of its calibrated range a channel may go beyond it before that is flagged


class Quality(IntFlag):
    """Bits of ``quality``; 0 is good."""

    EDGE = 1
    GAP = 2
    BRIDGED = 4
    MOTION = 8
    AUXILIARY = 16
    CALIBRATION = 32


NO_VALUE = Quality.EDGE | Quality.GAP  # bits of samples without a value

MEANING = {
    Quality.EDGE: "too near an end of the record for the low-pass: no value",
    Quality.GAP: "with more than 5 % of the samples missing under the low-pass: no value",
    Quality.BRIDGED: "with a missing or saturated sample that was bridged",
    Quality.MOTION: "with a motion channel outside its range in the saved calibration",
    Quality.AUXILIARY: "with another channel outside its range in the saved calibration",
    Quality.CALIBRATION: "by a calibration that does not hold for this flight",
}
"""Meaning of each bit."""


@dataclass(frozen=True)
class Compensated:
    """Compensated samples.

    ``gradient`` (N,): inline + i cross, Eo, NaN where there is none. ``parameters`` (2, N): standard deviations by the parameters, Eo;
    ``std`` (2, N): with the noise. ``quality`` (N,): bits of :class:`Quality`.
    """

    gradient: Complex
    parameters: Array
    std: Array
    quality: NDArray[np.int64]


@dataclass(frozen=True)
class OutputChannel(ModelledOutput):
    """One output of a flight, with what compensates it; ``about`` are the calibrated parameters.

    ``columns``: those fitted. ``noise``: of the output. ``recorded``: inline + i cross (N,), Eo, if the flight was demodulated by its
    recorder. ``validity``: channel -> range, SI; empty: not flagged. ``flags``: bits of the quality of all samples.
    """

    columns: tuple[Column, ...]
    noise: NoiseModel
    recorded: Complex | None
    validity: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    flags: int = 0

    @property
    def noise_std(self) -> Array:
        """(2,): standard deviations of inline and cross, Eo, that stationary noise of the output causes."""
        carrier, signs = 2 * measure_spin_frequency(self.observation), self.observation.signs
        power = self.demodulator.pass_power(lambda f: self.noise.psd(f, signs), carrier)
        return np.array([2.0, 1.0]) * float(np.sqrt(power)) / self.find_scale_factor(self.about)

    def estimate_first(self, bare: Array) -> Complex:
        if self.recorded is None:
            return super().estimate_first(bare)
        recorded = np.where(self.observation.record.valid, self.recorded, 0.0)
        return np.asarray(recorded - self.demodulate(bare))

    def compensate(self) -> Compensated:
        """The gradient at all samples."""
        g = self.estimate_gradient()
        variance, bits = self.propagate_parameters(g), self.flag_samples()
        parameters = np.sqrt(variance)
        std = np.sqrt(variance + self.noise_std[:, None] ** 2)
        none = (bits & NO_VALUE) != 0
        g[none] = complex(np.nan, np.nan)
        parameters[:, none] = std[:, none] = np.nan
        return Compensated(g, parameters, std, bits)

    def propagate_parameters(self, g: Complex) -> Array:
        """(2, N) Eo^2: variance of inline and cross by the parameters, beside a gradient (N,), Eo."""
        step = max(1, int(self.demodulator.rate // FINE))
        count = len(g) // step
        deviations = np.empty(
            (self.blocks[0].root.shape[1], 2, count)
        )  # independent steps of one standard deviation
        for means in split_range(count, ROWS // step):
            change = self._change_by_parameters(slice(means.start * step, means.stop * step), g, step)
            for b in self.blocks:
                # a mean that two blocks share is that of the first
                first = max(-(-b.rows.start // step), means.start)
                last = min(-(-b.rows.stop // step), means.stop)
                if first < last:
                    changes = change[..., first - means.start : last - means.start]
                    deviations[..., first:last] = np.tensordot(b.root.T, changes, 1)
            progress.step(float(step * (means.stop - means.start)))
        low_pass = find_demodulator(self.demodulator.name, self.demodulator.rate / step)
        total = sum((low_pass.low_pass(x) ** 2 for x in deviations), np.zeros((2, count)))
        centres = step * np.arange(count) + (step - 1) / 2  # the variance is linear between them
        return np.stack([np.interp(np.arange(len(g)), centres, x) for x in total])

    def _change_by_parameters(self, rows: slice, g: Complex, step: int) -> Array:
        """(n, 2, rows / step) Eo: inline and cross by each parameter's scale, before the low-pass; means of ``step`` samples."""
        r, x, moved = self.make_inputs(rows, g)
        o, count = self.observation, len(r.time) // step
        J = np.zeros((len(self.columns), len(o.series), len(r.time)))
        inputs, p = (r.time, x, r.phi), self.about - moved
        put_derivatives(J, self.model.chain, self.columns, inputs, p, o.recorded, o.output)
        mixer = np.stack([self.mixer[rows].real, self.mixer[rows].imag]).reshape(2, count, step) / step
        return np.asarray(np.einsum("wcf,ncf->nwc", mixer, combine_output(o, J).reshape(len(J), count, step)))

    def flag_samples(self) -> NDArray[np.int64]:
        """(N,): bits of the samples."""
        r, d = self.observation.record, self.demodulator
        bits = np.full(len(r.time), self.flags, dtype=np.int64)
        head, tail = d.settling
        bits[:head] |= Quality.EDGE
        bits[len(bits) - tail :] |= Quality.EDGE
        missing = ~r.valid
        if self.recorded is not None:
            bits[missing] |= Quality.GAP
        elif missing.any():
            weights = replace(d, taps=np.abs(d.taps) / np.sum(np.abs(d.taps)))
            share = weights.low_pass(missing.astype(np.float64))
            bits[share > HOLES] |= Quality.GAP
            bits[(share > FELT) & (share <= HOLES) & (bits & NO_VALUE == 0)] |= Quality.BRIDGED
        for name, (low, high) in self.validity.items():
            x = r.channels.get(name)
            if x is None or name in ("time", "spin_angle", *GRADIENT):
                continue
            moving = name.partition("_")[0] in ("a", "omega", "omegadot")
            beyond = np.maximum(low - x, x - high) > MARGIN * (high - low)
            bits[beyond] |= Quality.MOTION if moving else Quality.AUXILIARY
        return bits
