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
from scipy import linalg

from ragg_runtime import design, gradient
from ragg_runtime.design import Column, Observation
from ragg_runtime.errors import UserError
from ragg_runtime.evaluate import scale_factor, vector
from ragg_runtime.instrument import Instrument
from ragg_runtime.load import Model
from ragg_runtime.passes import Noise, Piece, Point, flight_segments, passed
from ragg_runtime.segments import Segment
from ragg_runtime.whiten import NoiseModel, estimate

Array = NDArray[np.float64]

TAPS = 24576
"""Greatest length of the whitening filter, samples: red noise needs as much memory as it has power."""

REACH = 5.0
"""Farthest that a parameter is fitted from its nominal value, in scales."""

SETTLED = 0.01, 2e-3
"""The step of a fit is its last if it gains less chi-square than this, or moves no parameter by this many scales: what
is quadratic in so small a step is below the noise of any record."""

NOISE_SEGMENTS = 8
"""Most segments of a flight of which the noise is estimated: 260,000 samples tell a smooth spectrum."""

WHITE_SEGMENTS = 4
"""Most segments on which the first fit, with noise still taken as white, is made."""

SHORTEST = 128
"""Least number of samples of which noise can be estimated."""


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


def estimate_noise(at: Point, o: Observation) -> Noise:
    """Noise of each output from what no column (base, candidate, unknown gradient) explains."""
    r = o.record
    if np.sum(r.valid) < SHORTEST:
        raise UserError(
            "the record is too short to estimate its noise",
            where=o.name,
            found=f"{int(np.sum(r.valid))} valid samples",
            expected=f"at least {SHORTEST}",
            remedy="give a longer or cleaner recording",
        )
    plain = Noise((), (np.ones(1),) * len(o.series))
    found: list[list[Array]] = [[] for _ in o.series]
    squares, freedom = np.zeros(len(o.series)), np.zeros(len(o.series))
    share = []

    def left(piece: Piece) -> tuple[float, list[tuple[Array, float, float]]] | None:
        valid = piece.observation.record.valid
        if np.sum(valid) < SHORTEST:
            return None
        taken = sum(w.white.shape[1] for w in piece.windows) / len(o.series)
        outputs = []
        for flat in np.split(piece.white, len(o.series), axis=1):
            solution, rank = _least_squares(flat)
            y = flat[-1]
            rest = y - solution @ flat[:-1]
            # The fit takes as many degrees of freedom as it has columns; an unknown gradient takes its own band.
            e = np.zeros(len(valid))
            e[valid] = rest * np.sqrt(len(y) / max(1.0, len(y) - rank))
            gain = design.noise_gain(r.rate) if o.kind == "channels" else 1.0
            free = len(y) * max(0.1, 1 - (rank + taken) / (gain * len(y)))
            outputs.append((e, float(np.sum(rest**2)) / gain, free))
        return float(np.mean(valid)), outputs

    for part in passed(at, o, plain, left, chosen=spread(flight_segments(o), NOISE_SEGMENTS)):
        if part is None:
            continue
        share.append(part[0])
        for m, (e, square, free) in enumerate(part[1]):
            found[m].append(e)
            squares[m] += square
            freedom[m] += free
    models, filters = [], []
    for m, e_m in enumerate(found):
        if o.kind == "channels":
            # Within the demodulator's band the noise of G_out is taken as white; its size is estimated.
            sigma = float(np.sqrt(squares[m] / freedom[m]))
            flat_psd = np.full(2, np.log(2 * sigma**2 / r.rate))
            models.append(NoiseModel(r.rate, np.array([-20.0, 20.0]), flat_psd, np.zeros(2)))
            filters.append(np.array([1.0 / sigma]))
            continue
        noise = estimate(e_m, r.rate, gradient.band(o))
        # Short gaps are closed by zeros, which lowers the density by the fraction that is missing.
        noise = replace(noise, log_psd=noise.log_psd - np.log(np.mean(share)))
        models.append(noise)
        filters.append(noise.whitening_filter(int(min(TAPS, len(r.time)))))
    return Noise(tuple(models), tuple(filters))


def spread(found: Sequence[Segment], most: int) -> list[Segment]:
    """At most so many of the segments, evenly spread."""
    if len(found) <= most:
        return list(found)
    return [found[k] for k in np.linspace(0, len(found) - 1, most).round().astype(int)]


ABSENT = 1e-11
"""Relative size of a direction of (normalised) columns that is rounding rather than physics."""


def _least_squares(columns: Array) -> tuple[Array, float]:
    """Coefficients (n,) that fit the last of columns (n + 1, rows), and how many they count as.

    Directions that are numerically absent must not be amplified; they are faded out, not cut off, lest rounding decide
    on which side of an edge one is.
    """
    R = design.triangle(columns)
    n = len(R) - 1
    norms = np.linalg.norm(R[:, :n], axis=0)
    norms[norms == 0.0] = 1.0
    U, s, Vt = np.linalg.svd(R[:n, :n] / norms)
    faded = s**2 / (s**2 + (ABSENT * s[0]) ** 2)
    solution = Vt.T @ (faded / np.maximum(s, 1e-300) * (U.T @ R[:n, n]))
    return np.asarray(solution / norms), float(np.sum(faded))


def fit(
    model: Model,
    instrument: Instrument,
    observations: Sequence[Observation],
    *,
    start: Array | None = None,
    noise: Sequence[Noise] | None = None,
    iterations: int = 6,
) -> Calibration:
    """Gauss-Newton on all flights at once, from the nominal values or from ``start``.

    The model is so nearly linear in its parameters that two or three steps suffice. The noise is first
    taken as white; once the fit has settled it is estimated from what nothing explains, and the fit is
    repeated with every column whitened. In the end the null biases take the residual's mean (``design.levelled``).
    """
    nominal = vector(model, instrument)
    p = nominal.copy()
    found = design.base_columns(model, instrument)
    columns = tuple(c for c, _ in found)
    index = np.array([i for _, i in found])
    scale = np.array([c.scale for c in columns])
    begun = nominal if start is None else start
    away = np.clip((begun[index] - nominal[index]) / scale, -REACH, REACH)
    p[index] = nominal[index] + away * scale
    known = list(noise) if noise is not None else None
    eotvos = scale_factor(model.chain, nominal)
    white = [_white(o, eotvos) for o in observations]
    for iteration in range(iterations):
        at = Point(model, instrument, p.copy(), with_candidates=False)
        triangles, rows, sums = [], 0, np.zeros(len(columns) + 1)
        for k, o in enumerate(observations):
            noise_k, chosen = (
                (white[k], spread(flight_segments(o), WHITE_SEGMENTS)) if known is None else (known[k], None)
            )
            for T, count, part in passed(at, o, noise_k, _triangle, chosen=chosen):
                rows += count
                sums += part
                triangles.append(T)
        normal = with_prior(design.join(triangles), -away)
        # A strong effect that the model lacks must not drag the parameters out of all proportion:
        # they are where the signatures are evaluated.
        step = np.clip(away + normal.step, -REACH, REACH) - away
        settled = normal.gain(step) < SETTLED[0] or bool(np.max(np.abs(step)) < SETTLED[1])
        away = away + step
        p[index] = nominal[index] + away * scale
        if known is None and (settled or iteration == 2):
            everything = Point(model, instrument, p.copy(), with_candidates=True)
            known = [estimate_noise(everything, o) for o in observations]
        elif known is not None and settled:
            break
    assert known is not None
    p[index] += (design.levelled(step, sums, design.null_biases(columns)) - step) * scale
    return Calibration(p, columns, index, normal.covariance, tuple(known), rows)


def _triangle(piece: Piece) -> tuple[Array, int, Array]:
    return design.triangle(piece.white), piece.white.shape[1], piece.sums()


@dataclass(frozen=True)
class _Linear:
    """Linear least squares in scales, prior included: the triangle R (n, n) and the rotated data y (n,)."""

    R: Array
    y: Array

    @property
    def step(self) -> Array:
        """(n,): the solution."""
        return np.asarray(linalg.solve_triangular(self.R, self.y))

    @property
    def covariance(self) -> Array:
        """(n, n)."""
        inverse = np.linalg.inv(self.R)
        return np.asarray(inverse @ inverse.T)

    def gain(self, step: Array) -> float:
        """By how much a step lowers chi-square."""
        return float(self.y @ self.y - np.sum((self.y - self.R @ step) ** 2))


def with_prior(T: Array, to_nominal: Array) -> _Linear:
    """The fit of a triangle [base (n) | residual] and of the prior.

    The prior pulls every parameter to its nominal value, ``to_nominal`` away, with a width of one scale.
    """
    n = len(to_nominal)
    R = np.asarray(np.linalg.qr(np.vstack([T, np.column_stack([np.eye(n), to_nominal])]), mode="r"))
    return _Linear(R[:n, :n], R[:n, n])


def _white(o: Observation, eotvos: float) -> Noise:
    flat = NoiseModel(o.record.rate, np.array([0.0, 1.0]), np.zeros(2), np.zeros(2))
    taps = np.array([1.0 / eotvos])
    m = len(o.series)
    return Noise((flat,) * m, (taps,) * m)
