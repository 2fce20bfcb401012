"""Fit a model's parameters to flights, with the noise estimated on the way.

Only some combinations of the parameters leave a trace in the output; the others stay where the test
sheet puts them, because each parameter has a prior as wide as its plausible size about its nominal value.
(Without it a null direction wanders by its second-order effects, and the fit with it.)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.fit import columns as design
from ragg_runtime.fit.columns import Column
from ragg_runtime.fit.linearise import Point
from ragg_runtime.fit.noise import estimate_noise, spread
from ragg_runtime.fit.observation import Observation
from ragg_runtime.fit.passes import Piece, flight_segments, passed
from ragg_runtime.fit.square_root import Linear, join, triangle, with_prior
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.evaluate import scale_factor, vector
from ragg_runtime.model.model import Model
from ragg_runtime.signals.noise_spectrum import Noise, NoiseModel

Array = NDArray[np.float64]

REACH = 5.0
"""Farthest that a parameter is fitted from its nominal value, in scales."""

SETTLED = 0.01, 2e-3
"""The step of a fit is its last if it gains less chi-square than this, or moves no parameter by this many scales: what
is quadratic in so small a step is below the noise of any record."""

WHITE_SEGMENTS = 4
"""Most segments on which the first fit, with noise still taken as white, is made."""


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
        T = with_prior(join(triangles), range(len(away)), -away)
        normal = Linear(T[:-1, :-1], T[:-1, -1])
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
    return triangle(piece.white), piece.white.shape[1], piece.sums()


def _white(o: Observation, eotvos: float) -> Noise:
    flat = NoiseModel(o.record.rate, np.array([0.0, 1.0]), np.zeros(2), np.zeros(2))
    taps = np.array([1.0 / eotvos])
    m = len(o.series)
    return Noise((flat,) * m, (taps,) * m)
