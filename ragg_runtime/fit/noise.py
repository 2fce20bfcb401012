"""The noise of a flight: what neither the model nor any candidate effect explains of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.fit import unknown_gradient
from ragg_runtime.fit.bursts import quiet_estimate
from ragg_runtime.fit.disturbances import Disturbance, disturbances, in_words
from ragg_runtime.fit.linearise import Point
from ragg_runtime.fit.observation import Observation, noise_gain
from ragg_runtime.fit.passes import Piece, flight_segments, passed
from ragg_runtime.fit.segments import Segment
from ragg_runtime.fit.square_root import triangle
from ragg_runtime.signals.noise_spectrum import Noise, NoiseModel

Array = NDArray[np.float64]

TAPS = 24576
"""Greatest length of the whitening filter, samples: red noise needs as much memory as it has power."""

NOISE_SEGMENTS = 8
"""Most segments of a flight of which the noise is estimated: 260,000 samples tell a smooth spectrum."""

ROUNDS = 3
"""Most times that lines and jumps are looked for in what is left beside those before."""

SHORTEST = 128
"""Least number of samples of which noise can be estimated."""


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
    share, begun = [], []

    disturbed: list[Disturbance] = []

    def left(piece: Piece) -> tuple[float, list[tuple[Array, float, float]], int] | None:
        valid = piece.observation.record.valid
        if np.sum(valid) < SHORTEST:
            return None
        taken = sum(w.white.shape[1] for w in piece.windows) / len(o.series)
        outputs = []
        for flat in np.split(piece.white, len(o.series), axis=1):
            rest, rank, seen = _left(flat, valid, r.rate if o.kind != "channels" else None)
            y = flat[-1]
            # The fit takes as many degrees of freedom as it has columns; an unknown gradient takes its own band.
            e = np.zeros(len(valid))
            e[valid] = rest * np.sqrt(len(y) / max(1.0, len(y) - rank))
            gain = noise_gain(r.rate) if o.kind == "channels" else 1.0
            free = len(y) * max(0.1, 1 - (rank + taken) / (gain * len(y)))
            outputs.append((e, float(np.sum(rest**2)) / gain, free))
            first = piece.segment.rows.start / r.rate
            disturbed.extend(replace(d, at=d.at + first) if d.kind == "jump" else d for d in seen)
        return float(np.mean(valid)), outputs, piece.segment.rows.start

    for part in passed(at, o, plain, left, chosen=spread(flight_segments(o), NOISE_SEGMENTS)):
        if part is None:
            continue
        share.append(part[0])
        begun.append(part[2])
        for m, (e, square, free) in enumerate(part[1]):
            found[m].append(e)
            squares[m] += square
            freedom[m] += free
    models, filters = [], []
    bursts: list[tuple[int, int, float]] = []
    for m, e_m in enumerate(found):
        if o.kind == "channels":
            # Within the demodulator's band the noise of G_out is taken as white; its size is estimated.
            sigma = float(np.sqrt(squares[m] / freedom[m]))
            flat_psd = np.full(2, np.log(2 * sigma**2 / r.rate))
            models.append(NoiseModel(r.rate, np.array([-20.0, 20.0]), flat_psd, np.zeros(2)))
            filters.append(np.array([1.0 / sigma]))
            continue
        noise, loud = quiet_estimate(e_m, r.rate, unknown_gradient.band(o))
        bursts += [
            (first + b.start, first + b.stop, b.factor)
            for first, x in zip(begun, loud, strict=True)
            for b in x
        ]
        # Short gaps are closed by zeros, which lowers the density by the fraction that is missing.
        noise = replace(noise, log_psd=noise.log_psd - np.log(np.mean(share)))
        models.append(noise)
        filters.append(noise.whitening_filter(int(min(TAPS, len(r.time)))))
    return Noise(
        tuple(models), tuple(filters), tuple(sorted(bursts)), in_words(sorted(disturbed, key=lambda d: d.at))
    )


def _left(
    flat: Array, valid: NDArray[np.bool_], rate: float | None
) -> tuple[Array, float, list[Disturbance]]:
    """What columns leave of the last of flat (n + 1, rows), and lines and jumps in it; how many these count as; and these.

    Without ``rate`` lines and jumps are not looked for.
    """
    solution, rank = _least_squares(flat)
    rest = flat[-1] - solution @ flat[:-1]
    found: list[Disturbance] = []
    time = np.flatnonzero(valid) / (rate or 1.0)
    for _ in range(ROUNDS if rate else 0):
        e = np.zeros(len(valid))
        e[valid] = rest
        more = disturbances(e, valid, rate or 1.0)
        if not more:
            break
        found += more
        wide = np.vstack([*(d.columns(time) for d in found), flat])
        solution, rank = _least_squares(wide)
        rest = flat[-1] - solution @ wide[:-1]
    return rest, rank, found


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
    R = triangle(columns)
    n = len(R) - 1
    norms = np.linalg.norm(R[:, :n], axis=0)
    norms[norms == 0.0] = 1.0
    U, s, Vt = np.linalg.svd(R[:n, :n] / norms)
    faded = s**2 / (s**2 + (ABSENT * s[0]) ** 2)
    solution = Vt.T @ (faded / np.maximum(s, 1e-300) * (U.T @ R[:n, n]))
    return np.asarray(solution / norms), float(np.sum(faded))
