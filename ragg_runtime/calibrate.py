"""Fit a model's parameters to flights, with the noise estimated on the way.

Only some combinations of the parameters leave a trace in the output; the others stay where the test
sheet puts them, because each parameter has a prior as wide as its plausible size about its nominal value.
(Without it a null direction wanders by its second-order effects, and the fit with it.)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime import design
from ragg_runtime.design import Column, Observation
from ragg_runtime.errors import UserError
from ragg_runtime.evaluate import scale_factor, vector
from ragg_runtime.instrument import Instrument
from ragg_runtime.load import Model
from ragg_runtime.whiten import NoiseModel, estimate, whiten

Array = NDArray[np.float64]

TAPS = 32768
"""Greatest length of the whitening filter, samples: red noise needs as much memory as it has power."""

REACH = 5.0
"""Farthest that a parameter is fitted from its nominal value, in scales."""

SHORTEST = 128
"""Least number of samples of which noise can be estimated."""


@dataclass(frozen=True)
class Linearised:
    """A flight about one parameter vector, not yet whitened: (columns, m, N) and residual (m, N), V."""

    observation: Observation
    residual: Array
    nuisance: Array
    base: Array
    candidates: Array


@dataclass(frozen=True)
class Noise:
    """Noise of each output of an observation, and its whitening filters."""

    models: tuple[NoiseModel, ...]
    filters: tuple[Array, ...]


@dataclass(frozen=True)
class Calibration:
    """Parameters fitted to one or more flights.

    Attributes
    ----------
    p
        Parameter vector of the model's chain, SI.
    columns, index
        The fitted parameters and their places in ``p``.
    covariance
        (n, n) of the fitted parameters in units of their scales, prior included.
    noise
        Noise of every flight.
    rows
        Whitened samples in the fit.
    """

    p: Array
    columns: tuple[Column, ...]
    index: NDArray[np.intp]
    covariance: Array
    noise: tuple[Noise, ...]
    rows: int


def linearise(
    model: Model, instrument: Instrument, observation: Observation, p: Array, with_candidates: bool
) -> Linearised:
    """Residual and columns of one flight about p, in volts, each column times its parameter's scale."""
    r = observation.record
    V, by = design.derivatives(model.chain, r, p)
    residual = observation.data - design.observe(observation, V, None)
    base = np.stack(
        [
            design.observe(observation, by[c.name, c.accelerometer], c.accelerometer) * c.scale
            for c, _ in design.base_columns(model, instrument)
        ]
    )
    candidates = np.empty((0, *residual.shape))
    if with_candidates and (columns := design.candidate_columns(model, instrument)):
        q = np.concatenate([p, np.zeros(model.signatures.SIZE - len(p))])
        _, by = design.derivatives(model.signatures, r, q)
        candidates = np.stack(
            [
                design.observe(observation, by[c.name, c.accelerometer], c.accelerometer) * c.scale
                for c in columns
            ]
        )
    eotvos = scale_factor(model.chain, p)
    voltages = observation.kind == "voltages"
    size = np.array([0.25, 0.25, -0.25, -0.25]) if voltages else np.array([1.0])
    nuisance = design.gradient_nuisance(observation, size * 1e4 * eotvos)
    return Linearised(observation, residual, nuisance, base, candidates)


@dataclass(frozen=True)
class Whitened:
    """Whitened columns (n, rows) in the order base, candidates, residual, and the sample of every row."""

    columns: Array
    sample: NDArray[np.intp]


def nuisance_basis(nuisance: Array, noise: Noise, valid: NDArray[np.bool_]) -> Array | None:
    """(rows, k): orthonormal basis of the whitened nuisance columns; ``None`` if there are none."""
    if not len(nuisance):
        return None
    parts = [whiten(nuisance[:, m], taps, valid) for m, taps in enumerate(noise.filters)]
    return design.orthonormal(np.concatenate(parts, axis=1))


def whitened(lin: Linearised, noise: Noise, Q: Array | None) -> Whitened:
    """Every column through the noise's whitening filter, the nuisance basis Q projected out of all."""
    valid = lin.observation.record.valid
    parts, samples = [], []
    for m, taps in enumerate(noise.filters):
        blocks = (lin.base, lin.candidates)
        parts.append(whiten(np.concatenate([*(b[:, m] for b in blocks), lin.residual[None, m]]), taps, valid))
        samples.append(np.flatnonzero(valid))
    columns = np.concatenate(parts, axis=1)
    if Q is not None:
        columns -= (columns @ Q) @ Q.T
    return Whitened(columns, np.concatenate(samples))


def estimate_noise(lin: Linearised) -> Noise:
    """Noise of each output from what no column (base, candidate, nuisance) explains."""
    r = lin.observation.record
    models, filters = [], []
    length = int(min(TAPS, len(r.time)))
    for m in range(lin.residual.shape[0]):
        X = np.concatenate([lin.base[:, m], lin.candidates[:, m]])[:, r.valid]
        X = X[np.any(X != 0.0, axis=1)]
        y = lin.residual[m, r.valid]
        taken = 0
        if len(lin.nuisance):
            Q = design.orthonormal(lin.nuisance[:, m][:, r.valid])
            X, y, taken = X - (X @ Q) @ Q.T, y - Q @ (Q.T @ y), Q.shape[1]
        e = np.zeros(len(r.time))
        solution, rank = _least_squares(X, y)
        e[r.valid] = y - X.T @ solution
        # The fit takes as many degrees of freedom as it has columns.
        e *= np.sqrt(len(y) / max(1, len(y) - rank - taken))
        if np.sum(r.valid) < SHORTEST:
            raise UserError(
                "the record is too short to estimate its noise",
                where=lin.observation.name,
                found=f"{int(np.sum(r.valid))} valid samples",
                expected=f"at least {SHORTEST}",
                remedy="give a longer or cleaner recording",
            )
        if lin.observation.kind == "channels":
            # Within the demodulator's band the noise of G_out is taken as white; its size is estimated.
            gain = design.noise_gain(r.rate)
            kept = max(0.1, 1 - (rank + taken) / (gain * len(y)))
            sigma = float(np.sqrt(np.mean((y - X.T @ solution) ** 2) / (gain * kept)))
            flat = np.full(2, np.log(2 * sigma**2 / r.rate))
            models.append(NoiseModel(r.rate, np.array([-20.0, 20.0]), flat))
            filters.append(np.array([1.0 / sigma]))
            continue
        # Short gaps are closed by zeros, which lowers the density by the fraction that is missing.
        noise = estimate([e], r.rate)
        if not r.valid.all():
            noise = replace(noise, log_psd=noise.log_psd - np.log(np.mean(r.valid)))
        models.append(noise)
        filters.append(noise.whitening_filter(length))
    return Noise(tuple(models), tuple(filters))


def _least_squares(X: Array, y: Array) -> tuple[Array, int]:
    """Truncated least squares: directions that are numerically absent must not be amplified."""
    norms = np.linalg.norm(X, axis=1)
    R = design.triangle(np.vstack([X / norms[:, None], y]))
    n = len(norms)
    solution, _, rank, _ = np.linalg.lstsq(R[:n, :n], R[:n, n], rcond=1e-12)
    return np.asarray(solution / norms), int(rank)


def fit(
    model: Model,
    instrument: Instrument,
    observations: Sequence[Observation],
    *,
    start: Array | None = None,
    noise: Sequence[Noise] | None = None,
    iterations: int = 6,
) -> Calibration:
    """Gauss-Newton on all flights at once.

    The model is so nearly linear in its parameters that two or three steps suffice. The noise is first
    taken as white; once the fit has settled it is estimated from what nothing explains, and the fit is
    repeated with every column whitened.
    """
    nominal = vector(model, instrument)
    p = nominal.copy() if start is None else start.copy()
    found = design.base_columns(model, instrument)
    columns = tuple(c for c, _ in found)
    index = np.array([i for _, i in found])
    scale = np.array([c.scale for c in columns])
    n = len(columns)
    known = list(noise) if noise is not None else None
    bases: list[Array | None] = []
    eotvos = scale_factor(model.chain, p)
    for iteration in range(iterations):
        triangles, rows = [], 0
        for k, o in enumerate(observations):
            lin = linearise(model, instrument, o, p, with_candidates=False)
            used = known[k] if known is not None else _white(o, eotvos)
            if len(bases) <= k:
                bases.append(nuisance_basis(lin.nuisance, used, o.record.valid))
            X = whitened(lin, used, bases[k]).columns
            rows += X.shape[1]
            triangles.append(design.triangle(X))
        step, covariance = solve(design.join(triangles), (nominal[index] - p[index]) / scale, n)
        # A strong effect that the model lacks must not drag the parameters out of all proportion:
        # they are where the signatures are evaluated.
        away = np.clip((p[index] - nominal[index]) / scale + step, -REACH, REACH)
        p[index] = nominal[index] + away * scale
        settled = bool(np.max(np.abs(step)) < 1e-3)
        if known is None and (settled or iteration == 2):
            known = [
                estimate_noise(linearise(model, instrument, o, p, with_candidates=True)) for o in observations
            ]
            bases = []
        elif known is not None and settled:
            break
    assert known is not None
    return Calibration(p, columns, index, covariance, tuple(known), rows)


def solve(R: Array, to_nominal: Array, n: int) -> tuple[Array, Array]:
    """Step (n,) and covariance (n, n), in scales, from a triangle [base (n) | ... | residual] and the prior.

    The prior pulls every parameter to its nominal value, ``to_nominal`` away, with a width of one scale.
    """
    rows = np.vstack([np.column_stack([R[:, :n], R[:, -1]]), np.column_stack([np.eye(n), to_nominal])])
    T = np.asarray(np.linalg.qr(rows, mode="r"))
    step = np.linalg.solve(T[:n, :n], T[:n, n])
    inverse = np.linalg.inv(T[:n, :n])
    return step, inverse @ inverse.T


def _white(o: Observation, eotvos: float) -> Noise:
    flat = NoiseModel(o.record.rate, np.array([0.0, 1.0]), np.zeros(2))
    taps = np.array([1.0 / eotvos])
    m = o.data.shape[0]
    return Noise((flat,) * m, (taps,) * m)
