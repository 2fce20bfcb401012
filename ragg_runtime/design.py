"""Linearised fits: the columns of a model and of its candidate effects, whitened, as one triangle.

Everything that calibration and diagnosis ask of a flight is in the triangular factor R of its whitened
columns: a flight of any length becomes a matrix of a few hundred rows, and flights are joined by
stacking their triangles. (A QR update, not normal equations: the columns' sizes span fifteen decades.)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import linalg, signal

from ragg_runtime.demodulate import low_pass
from ragg_runtime.evaluate import Record, unit_factor
from ragg_runtime.flight.spool import let_go
from ragg_runtime.instrument import PARAMETERS, Instrument
from ragg_runtime.load import Effect, Model
from ragg_runtime.units import Units, units

Array = NDArray[np.float64]

UNOBSERVABLE = ("k_VI", "vartheta_x")
"""Parameters that no record can tell: k_VI enters only as k_VI K1, vartheta_x not at the paper's order."""

EFFECT_PRIOR = 10.0
"""Width of the prior of an effect's parameter, in plausible sizes: what is missing may well surprise."""


@dataclass(frozen=True)
class Column:
    """One scalar parameter as a column of a fit.

    Attributes
    ----------
    name
        As shown: ``K2``, ``cubic-input.K_iii``.
    accelerometer
        1 ... 4, or ``None`` if shared.
    scale
        Width of the prior, SI: columns are derivatives times it.
    unit, unit_factor
        Display unit and its SI value.
    effect
        Id of the effect that brings it; ``None`` for the paper's instrument.
    """

    name: str
    accelerometer: int | None
    scale: float
    unit: str
    unit_factor: float
    effect: str | None

    @property
    def label(self) -> str:
        return self.name if self.accelerometer is None else f"{self.name}[{self.accelerometer}]"


@dataclass(frozen=True)
class Observation:
    """What of a flight, or of a part of one, is fitted: m output series over N samples.

    ``kind`` is ``G_out`` (m = 1), ``voltages`` (m = 4) or ``channels``: inline and cross are all that was
    recorded; then the data are the channels put back on their carriers (m = 1, see :func:`narrow`), and
    every column passes through the same demodulator. All in V.
    """

    kind: str
    record: Record
    series: tuple[Array, ...]
    name: str
    memo: list[tuple[Sequence[Array], list[Any]]] = field(default_factory=list, compare=False, repr=False)
    """What :mod:`ragg_runtime.gradient` has found for some filters."""

    @cached_property
    def data(self) -> Array:
        """(m, N), V; zero where a sample is not valid."""
        return np.stack([np.where(self.record.valid, x, 0.0) for x in self.series])

    @property
    def weights(self) -> Array:
        """(m,): how much of a common term of G_out each output sees (for voltages each is searched as one)."""
        return np.array([0.25, 0.25, -0.25, -0.25]) if self.kind == "voltages" else np.ones(1)

    def part(self, rows: slice) -> Observation:
        """Some of the samples."""
        if (rows.start, rows.stop) == (0, len(self.record.time)):
            return self
        series = tuple(np.array(x[rows]) for x in self.series)
        let_go(*self.series)
        return Observation(self.kind, self.record.part(rows), series, self.name)


def base_columns(model: Model, instrument: Instrument) -> list[tuple[Column, int]]:
    """The calibratable parameters of the model, each with its index in the parameter vector."""
    known = units(instrument.g0)
    found: list[tuple[Column, int]] = []
    start = {}
    position = 0
    for name, size in model.chain.PARAMETERS:
        start[name] = position
        position += size
    for q in PARAMETERS:
        if q.name in UNOBSERVABLE:
            continue
        factor = unit_factor(q.display_unit, known)
        scales = instrument.sigma(q.name)
        for j in range(4):
            column = Column(q.name, j + 1, float(scales[j]), q.display_unit, factor, None)
            found.append((column, start[q.name] + j))
    for e in model.effects:
        if e.kind in ("deterministic", "step"):
            found += [(c, start[s] + (c.accelerometer or 1) - 1) for c, s in _of_effect(e, known)]
    return found


def candidate_columns(model: Model, instrument: Instrument) -> list[Column]:
    """The parameters of the effects that are not in the model, in the order of the signatures' rows."""
    known = units(instrument.g0)
    return [c for e in model.candidates if e.kind != "output" for c, _ in _of_effect(e, known)]


def _of_effect(e: Effect, known: Units) -> list[tuple[Column, str]]:
    columns = []
    for q in e.parameters:
        if not q.fitted:
            continue
        factor = unit_factor(q.unit, known)
        for j in (None,) if q.shared else (1, 2, 3, 4):
            column = Column(f"{e.id}.{q.name}", j, EFFECT_PRIOR * q.plausible * factor, q.unit, factor, e.id)
            columns.append((column, q.symbol))
    return columns


_COMBINATION = np.array([1.0, 1.0, -1.0, -1.0])


def combined(v: Array, accelerometer: int | None = None) -> Array:
    """G_out (N,) of voltages (4, N), or of one accelerometer's (N,) (Eq. 15)."""
    return np.asarray(_COMBINATION @ v if accelerometer is None else _COMBINATION[accelerometer - 1] * v)


def carried(inline: Array, cross: Array, r: Record, k_ggi: float) -> Array:
    """Demodulated channels put back on their carriers: k_ggi (inline/2 sin 2 phi - cross cos 2 phi), V.

    ``k_ggi`` in V per unit of the channels.
    """
    cosine, sine = r.cos_phi**2 - r.sin_phi**2, 2 * r.sin_phi * r.cos_phi
    return np.asarray(k_ggi * (inline / 2 * sine - cross * cosine))


def narrow(G: Array, r: Record) -> Array:
    """G_out (..., N) as the demodulator lets it through: demodulated and put back on the carriers."""
    taps = low_pass(r.rate).reshape((1,) * (G.ndim - 1) + (-1,))
    cosine, sine = r.cos_phi**2 - r.sin_phi**2, 2 * r.sin_phi * r.cos_phi
    in_phase = signal.oaconvolve(2 * G * sine, taps, mode="same", axes=-1)
    quadrature = signal.oaconvolve(2 * G * cosine, taps, mode="same", axes=-1)
    return np.asarray(in_phase * sine + quadrature * cosine)


def noise_gain(rate: float) -> float:
    """Variance of white noise of unit variance after :func:`narrow`."""
    return float(2 * np.sum(low_pass(rate) ** 2))


def observe(o: Observation, v: Array, accelerometer: int | None) -> Array:
    """What an observation sees of voltages: (4, N), or (N,) of one accelerometer -> (m, N)."""
    if o.kind == "voltages":
        if accelerometer is None:
            return v
        full = np.zeros((4, v.shape[-1]))
        full[accelerometer - 1] = v
        return full
    G = combined(v, accelerometer)
    return (narrow(G, o.record) if o.kind == "channels" else G)[None, :]


def null_biases(columns: Sequence[Column]) -> list[int]:
    """Places of the instrument's K0 among columns."""
    return [n for n, c in enumerate(columns) if c.name == "K0" and c.effect is None]


def levelled(coefficients: Array, sums: Array, biases: Sequence[int]) -> Array:
    """Coefficients (n,) with those at ``biases`` shifted until the residual of G_out has no mean.

    ``sums`` (n + 1,) are those of the columns and of the data over all samples; zeros: nothing is shifted. Noise that
    rises towards low frequencies leaves the mean of a record nearly free, and with it the null biases: by convention
    they take it.
    """
    own = sums[list(biases)]
    shifted = coefficients.copy()
    if np.any(own):
        left = sums[-1] - sums[:-1] @ coefficients
        shifted[list(biases)] += own * left / (own @ own)
    return shifted


def orthonormal(columns: Array) -> Array:
    """(rows, k): orthonormal basis of columns (n, rows); those that vanish (knots in a gap) span nothing."""
    norms = np.linalg.norm(columns, axis=1)
    return np.asarray(np.linalg.qr(columns[norms > 1e-9 * np.max(norms, initial=0.0)].T)[0])


CHUNK = 1024
"""Rows that enter a triangle at a time: they stay in the cache."""

PANEL = 16
"""Columns that LAPACK eliminates at a time."""


def triangle(columns: Array) -> Array:
    """Triangular factor (n, n) of columns (n, rows): the same inner products in n rows."""
    n, rows = columns.shape
    R = np.zeros((n, n), order="F")
    for start in range(0, rows, CHUNK):
        part = np.array(columns[:, start : start + CHUNK].T, order="F")
        R, *_ = linalg.lapack.dtpqrt(0, min(PANEL, n), R, part, overwrite_a=True, overwrite_b=True)
    return np.asarray(np.triu(R))


def join(triangles: Sequence[Array]) -> Array:
    """The triangle of several records together."""
    if len(triangles) == 1:
        return triangles[0]
    return triangle(np.vstack(triangles).T)


def names(columns: Sequence[Column]) -> Mapping[str, int]:
    """Label -> position."""
    return {c.label: n for n, c in enumerate(columns)}
