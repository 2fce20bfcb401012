"""A gravity gradient that was not recorded, and the one that an output has seen: what a model explains removed, demodulated.

Unknown, it is T_1 sin 2 phi + T_2 cos 2 phi (Eq. 30), T_1 and T_2 cubic splines of periods of half a minute and longer, projected
out of data and columns, window by window; lines of the output likewise.

With e = G_out - model(motion, no gradient), inline + i cross are the low-pass of e (4 sin 2 phi - 2 i cos 2 phi) / k_ggi. The model's
own response to that first estimate then replaces the ideal one, which leaves the second order.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy import interpolate

from ragg_runtime.base.progress import split_range
from ragg_runtime.estimation.least_squares import orthonormalise
from ragg_runtime.estimation.noise import NoiseModel
from ragg_runtime.estimation.observation import ROWS, Observation, combine_output
from ragg_runtime.instrument.layout import X_AXIS, Y_AXIS
from ragg_runtime.instrument.units import EOTVOS
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model.memory import move_record
from ragg_runtime.model.model import Model, scale_factor
from ragg_runtime.model.record import Record, take_quantities
from ragg_runtime.signals.demodulators import Demodulator, spread_across
from ragg_runtime.signals.fir import Floats

Array = NDArray[np.float64]

KNOT_SECONDS = 10.0  # distance of the knots of the splines
WINDOW_SECONDS = 300.0  # length of a window of time with splines of its own

# time before a window in which its splines begin: longer ago, a whitening filter has no memory of a signal that oscillates at twice
# the spin rate
LEAD_SECONDS = 100.0


# frequency, Hz, up to which the splines follow a signal, and so take noise away: half a period a knot, and a margin
TAKEN = 0.6 / KNOT_SECONDS


@dataclass(frozen=True)
class Window:
    """What an unknown gradient spans in one window of a segment: ``plain`` (k, m valid) before whitening, one output after the
    other, and the orthonormal basis ``white`` (len(places), k) in the whitened rows ``places``.
    """

    samples: slice
    plain: Array
    places: NDArray[np.intp]
    white: Array

    @cached_property
    def raw(self) -> Array:
        """(m valid, k): orthonormal basis before whitening."""
        return orthonormalise(self.plain)

    def lean(self) -> Window:
        """What whitened rows need of it."""
        return replace(self, plain=np.empty((0, 0)))


def is_unknown(o: Observation) -> bool:
    """Whether the gradient was not recorded."""
    return not all(g in o.record.wide for g in GRADIENT)


def find_band(o: Observation) -> tuple[float, float] | None:
    """Frequencies of G_out, Hz, that an unknown gradient takes; ``None`` if it is known."""
    if not is_unknown(o):
        return None
    carrier = 2 * measure_spin_frequency(o)
    return carrier - TAKEN, carrier + TAKEN


def measure_spin_frequency(o: Observation) -> float:
    """Mean, Hz, by the encoder where there is one."""
    r = o.record
    if "spin_angle" not in r.wide:
        return r.spin_frequency
    step = np.angle(np.exp(1j * np.diff(np.asarray(r.wide["spin_angle"][: 1 << 16]))))
    return float(np.abs(np.mean(step))) * r.rate / (2 * np.pi)


def make_splines(time: Array, cosine: Array, sine: Array) -> Array:
    """(n, N): T_1 times a carrier's sine and T_2 times its cosine for every basis spline of T_1 and of T_2 over ``time``."""
    count = max(4, int(np.ceil((time[-1] - time[0]) / KNOT_SECONDS)) + 3)
    knots = np.concatenate([[time[0]] * 3, np.linspace(time[0], time[-1], count - 2), [time[-1]] * 3])
    basis = interpolate.BSpline.design_matrix(time, knots, 3).toarray().T
    double = np.stack([sine, cosine])
    return np.asarray((basis[:, None, :] * double[None]).reshape(-1, len(time)))


def make_windows(o: Observation, rows: slice, noise: NoiseModel, *, whitened: bool = True) -> list[Window]:
    """The windows of one segment of a flight; none if the gradient is known and the output has no lines. Those that are not
    ``whitened`` span nothing of whitened rows, and take a fourth of the time.
    """
    if not is_unknown(o) and not noise.lines:
        return []
    r = o.record
    valid = np.array(r.valid[rows])
    rank = np.concatenate([[0], np.cumsum(valid)])
    count = max(1, round((rows.stop - rows.start) / (WINDOW_SECONDS * r.rate)))
    edges = [int(k) for k in np.linspace(rows.start, rows.stop, count + 1)]

    def window(ends: tuple[int, int]) -> Window | None:
        a, b = ends
        lead = int(min(a, LEAD_SECONDS * r.rate, noise.memory))
        here = np.array(r.valid[a - lead : b])
        if np.sum(here[lead:]) < 2:
            return None
        shares = np.empty((0, len(o.series), len(here)))
        if is_unknown(o):
            part = r.part(slice(a - lead, b), only=())
            shares = _share_among_series(o, make_splines(part.time, *part.carriers) * here)
        plain = np.concatenate([shares[:, m, lead:][:, here[lead:]] for m in range(len(o.series))], axis=1)
        samples = slice(a - rows.start, b - rows.start)
        if not whitened:
            return Window(samples, plain, np.empty(0, dtype=np.intp), np.empty((0, 0)))
        level = noise.level.of(take_quantities(r, slice(a - lead, b)))
        lines = noise.line_columns(r.time[a - lead : b], len(o.series))
        together = np.concatenate([shares, lines * here])
        white = noise.whiten(together, here, level, lead=lead)
        first, last = int(rank[a - rows.start]), int(rank[b - rows.start])
        places = np.concatenate([np.arange(first, last) + m * int(rank[-1]) for m in range(noise.outputs)])
        return Window(samples, plain, places, orthonormalise(white))

    return [w for w in map(window, pairwise(edges)) if w is not None]


def _share_among_series(o: Observation, X: Array) -> Array:
    """What each series sees of T_1 sin 2 phi and T_2 cos 2 phi in turn, (k, m, N), by the sheet's scale factors."""
    g = np.ones(1, dtype=np.complex128)
    if o.recorded.separate:
        radii = np.array(o.output.radii)
        g = o.gains * np.array(o.output.carriers) * radii / (np.max(radii) or 1.0)
    real, imaginary = g.real[:, None], g.imag[:, None]
    sine, cosine = X[0::2, None], X[1::2, None]
    shares = np.empty((len(X), len(g), X.shape[1]))
    shares[0::2] = real * sine + imaginary * cosine
    shares[1::2] = real * cosine - imaginary * sine
    return shares


def project(columns: Floats, windows: Sequence[Window]) -> None:
    """Take what an unknown gradient spans out of whitened columns (n, rows), in place."""
    for w in windows:
        Q, part = w.white.astype(columns.dtype, copy=False), columns[:, w.places]
        columns[:, w.places] = part - (part @ Q) @ Q.T


def take_out(e: Array, windows: Sequence[Window], valid: NDArray[np.bool_]) -> Array:
    """Take the fitted unknown gradient out of residuals (k, m, N): it is signal, not error."""
    gradient = [w for w in windows if len(w.plain)]
    if not gradient:
        return e
    left = e.copy()
    k, m, _ = e.shape
    for w in gradient:
        inside = np.flatnonzero(valid[w.samples]) + w.samples.start
        y = e[:, :, inside].reshape(k, m * len(inside))  # of no residual at all, too
        left[:, :, inside] = (y - (y @ w.raw) @ w.raw.T).reshape(k, m, len(inside))
    return left


Complex = NDArray[np.complex128]

# times that holes are filled with the gradient found: what remains is the share of the holes to this power + 1
BRIDGES = 2


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
        factors = np.empty(len(self.observation.record.time))
        for b in self.blocks:
            factors[b.rows] = self.find_scale_factor(b.p)
        return factors

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
            for part in split_range(b.rows.stop - b.rows.start, ROWS):
                rows = slice(b.rows.start + part.start, b.rows.start + part.stop)
                r, x, moved = self.make_inputs(rows, gradient)
                G[rows] = self.model.chain.output(r.time, x, b.p - moved, r.phi, which=self.observation.place)
        return G

    def demodulate(self, e: Array) -> Complex:
        """Inline + i cross (N,), Eo, of a residual (N,), V."""
        return self.demodulator.low_pass(self.mixer * e)

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
