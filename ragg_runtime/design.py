"""Linearised fits: the columns of a model and of its candidate effects, whitened, as one triangle.

Everything that calibration and diagnosis ask of a flight is in the triangular factor R of its whitened
columns: a flight of any length becomes a matrix of a few hundred rows, and flights are joined by
stacking their triangles. (A QR update, not normal equations: the columns' sizes span fifteen decades.)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import interpolate, linalg, signal

from ragg_runtime.demodulate import low_pass
from ragg_runtime.evaluate import GRADIENTS, Record, unit_factor
from ragg_runtime.instrument import PARAMETERS, Instrument
from ragg_runtime.load import Chain, Effect, Model
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
    """What of a flight is fitted: m output series over N samples.

    ``kind`` is ``G_out`` (m = 1), ``voltages`` (m = 4) or ``channels``: inline and cross are all that was
    recorded; then the data are the channels put back on their carriers (m = 1, see :func:`narrow`), and
    every column passes through the same demodulator. All in V.
    """

    kind: str
    record: Record
    data: Array
    name: str


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
        scales = q.plausible_si(instrument.accelerometers[q.name], instrument.g0)
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


def derivatives(chain: Chain, r: Record, p: Array) -> tuple[Array, dict[tuple[str, int | None], Array]]:
    """V_j (4, N) and dV_j by every row of the module: (name, accelerometer or None) -> (4, N) or (N,).

    A row of one accelerometer's own parameter is (N,): the derivative of its own voltage.
    """
    x = r.inputs(chain)
    V = np.empty((4, len(r.time)))
    by: dict[tuple[str, int | None], Array] = {}
    for name, shared in chain.ROWS:
        if shared:
            by[name, None] = np.empty((4, len(r.time)))
    for j in range(4):
        q = chain.values_of(j, p)
        V[j] = chain.accelerometer(j, r.time, r.cos_phi, r.sin_phi, x, q)
        rows = chain.derivatives(j, r.time, r.cos_phi, r.sin_phi, x, q)
        for (name, shared), row in zip(chain.ROWS, rows, strict=True):
            if shared:
                by[name, None][j] = row
            else:
                by[name, j + 1] = row
    return V, by


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


def orthonormal(columns: Array) -> Array:
    """(rows, k): orthonormal basis of columns (n, rows); those that vanish (knots in a gap) span nothing."""
    norms = np.linalg.norm(columns, axis=1)
    return np.asarray(np.linalg.qr(columns[norms > 1e-9 * np.max(norms, initial=0.0)].T)[0])


KNOT_SECONDS = 10.0
"""Distance of the knots of an unknown gradient: it follows periods of half a minute and longer."""

MOST_KNOTS = 400
"""Most knots of an unknown gradient; on a record longer than an hour they lie further apart."""


def gradient_nuisance(observation: Observation, scale: Array) -> Array:
    """Columns (n, m, N) of an unknown, slowly varying gravity gradient, if none was recorded.

    The gradient enters as T_1 sin 2 phi + T_2 cos 2 phi (Eq. 30) with T_1, T_2 cubic splines of time.
    ``scale`` (m,) holds its size in each output.
    """
    r = observation.record
    if all(g in r.channels for g in GRADIENTS):
        return np.empty((0, *observation.data.shape))
    count = max(4, min(MOST_KNOTS, int(np.ceil(r.time[-1] / KNOT_SECONDS)) + 3))
    knots = np.concatenate([[0.0] * 3, np.linspace(0.0, r.time[-1], count - 2), [r.time[-1]] * 3])
    splines = interpolate.BSpline.design_matrix(r.time, knots, 3).toarray().T
    double = np.stack([2 * r.sin_phi * r.cos_phi, r.cos_phi**2 - r.sin_phi**2])
    series = (splines[:, None, :] * double[None]).reshape(-1, 1, len(r.time))
    return np.asarray(series * scale[None, :, None])


def triangle(columns: Array) -> Array:
    """Triangular factor (n, n) of columns (n, rows): the same inner products in n rows."""
    n = columns.shape[0]
    R = linalg.qr(columns.T, mode="r", overwrite_a=True, check_finite=False)[0][:n]
    if R.shape[0] < n:
        R = np.vstack([R, np.zeros((n - R.shape[0], n))])
    return np.asarray(np.triu(R))


def join(triangles: Sequence[Array]) -> Array:
    """The triangle of several records together."""
    if len(triangles) == 1:
        return triangles[0]
    return triangle(np.vstack(triangles).T)


def names(columns: Sequence[Column]) -> Mapping[str, int]:
    """Label -> position."""
    return {c.label: n for n, c in enumerate(columns)}
