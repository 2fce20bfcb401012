"""The gravity gradient as an output saw it: what a model explains removed, demodulated.

With e = G_out - model(motion, no gradient), inline + i cross are the low-pass of e (4 sin 2 phi - 2 i cos 2 phi) / k_ggi. The model's
own response to that first estimate then replaces the ideal one, which leaves the second order.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.progress import split_range
from ragg_runtime.estimation.observation import ROWS, Observation, combine_output
from ragg_runtime.instrument.layout import X_AXIS, Y_AXIS
from ragg_runtime.instrument.units import EOTVOS
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model.memory import move_record
from ragg_runtime.model.model import Model, scale_factor
from ragg_runtime.model.record import Record
from ragg_runtime.signals.demodulators import Demodulator
from ragg_runtime.signals.tensor import spread_across

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

BRIDGES = 2
"""Times that holes are filled with the gradient found: what remains is the share of the holes to this power + 1."""


@dataclass(frozen=True)
class Block:
    """Samples of a flight with parameters ``p`` (size,), SI; ``root`` (n, k): of the covariance of those fitted, in scales."""

    rows: slice
    p: Array
    root: Array = field(default_factory=lambda: np.zeros((0, 0)))


@dataclass(frozen=True)
class ModelledOutput:
    """An output of a flight with the parameters of a model, which may differ between ``blocks`` of its samples.

    ``observation``: of the whole flight, N samples. ``about`` (size,), SI: the parameters that say how its motion is moved.
    ``demodulator``: the low-pass.
    """

    model: Model
    observation: Observation
    about: Array
    blocks: tuple[Block, ...]
    demodulator: Demodulator

    def find_scale_factor(self, p: Array) -> float:
        """V/Eo, by parameters p (size,), SI."""
        return scale_factor(self.model, p, self.observation.place)

    @cached_property
    def k_ggi(self) -> Array:
        """(N,) V/Eo."""
        found = np.empty(len(self.observation.record.time))
        for b in self.blocks:
            found[b.rows] = self.find_scale_factor(b.p)
        return found

    @cached_property
    def mixer(self) -> Complex:
        """(N,), 1/V: what a residual is multiplied by before the low-pass."""
        cosine, sine = self.observation.record.quadratures
        return np.asarray((4 * sine - 2j * cosine) / self.k_ggi)

    def make_inputs(self, rows: slice, gradient: Complex | None) -> tuple[Record, Array, Array]:
        """Of some samples their record, what the chain reads of it (inputs, n), and the parameters (size,) that have moved its motion.

        ``gradient``: inline + i cross (N,), Eo, in the place of what was recorded.
        """
        r = self.observation.part(rows).record
        moved, rest = move_record(self.model, r, self.about)
        x = moved.inputs(self.model.chain)
        g = np.zeros(len(r.time), dtype=np.complex128) if gradient is None else gradient[rows]
        across = spread_across(r.axes or (X_AXIS, Y_AXIS), EOTVOS * g.real, EOTVOS * g.imag)
        for n, name in enumerate(self.model.chain.INPUTS):
            if name in GRADIENT:
                x[n] = across[GRADIENT.index(name)]
        return r, x, self.about - rest

    def predict(self, gradient: Complex | None = None) -> Array:
        """The output (N,), V, of a gradient inline + i cross (N,), Eo."""
        G = np.zeros(len(self.observation.record.time))
        for b in self.blocks:
            for some in split_range(b.rows.stop - b.rows.start, ROWS):
                rows = slice(b.rows.start + some.start, b.rows.start + some.stop)
                r, x, moved = self.make_inputs(rows, gradient)
                G[rows] = self.model.chain.output(r.time, x, b.p - moved, r.phi, which=self.observation.place)
        return G

    def demodulate(self, e: Array) -> Complex:
        """Inline + i cross (N,), Eo, of a residual (N,), V."""
        return self.demodulator.low_passed(self.mixer * e)

    def respond_ideally(self, g: Complex) -> Array:
        """What an ideal instrument makes of inline + i cross (N,), Eo: V."""
        cosine, sine = self.observation.record.quadratures
        return np.asarray(self.k_ggi * (g.real / 2 * sine - g.imag * cosine))

    def estimate_first(self, bare: Array) -> Complex:
        """Inline + i cross (N,), Eo, as an ideal instrument would have seen it; holes are bridged.

        ``bare`` (N,), V: the output of no gradient.
        """
        o = self.observation
        missing = ~o.record.valid
        e = np.where(missing, 0.0, combine_output(o, o.data) - bare)
        g = self.demodulate(e)
        for _ in range(BRIDGES if missing.any() else 0):
            e[missing] = self.respond_ideally(g)[missing]
            g = self.demodulate(e)
        return g

    def estimate_gradient(self) -> Complex:
        """Inline + i cross (N,), Eo, as this instrument sees it."""
        bare = self.predict()
        first = self.estimate_first(bare)
        return first - self.demodulate(self.predict(first) - bare - self.respond_ideally(first))
