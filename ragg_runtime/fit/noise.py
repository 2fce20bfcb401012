"""The noise of a flight: what neither the model nor any candidate effect explains of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import signal

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
    kept: list[list[Array]] = [[] for _ in o.series]
    begun: list[int] = []
    disturbed: list[Disturbance] = []
    band = unknown_gradient.band(o)

    def left(piece: Piece) -> tuple[list[tuple[Array, float, float, Array]], int] | None:
        valid = piece.observation.record.valid
        if np.sum(valid) < SHORTEST:
            return None
        taken = sum(w.white.shape[1] for w in piece.windows) / len(o.series)
        outputs = []
        for flat in np.split(piece.white, len(o.series), axis=1):
            x = _left(flat, valid, r.rate if o.kind != "channels" else None, band)
            y = flat[-1]
            e = np.zeros(len(valid))
            e[valid] = x.rest
            # The fit takes as many degrees of freedom as it has columns; an unknown gradient takes its own band.
            gain = noise_gain(r.rate) if o.kind == "channels" else 1.0
            free = len(y) * max(0.1, 1 - (x.rank + taken) / (gain * len(y)))
            outputs.append((e, float(np.sum(x.rest**2)) / gain, free, x.kept))
            first = piece.segment.rows.start / r.rate
            disturbed.extend(replace(d, at=d.at + first) if d.kind == "jump" else d for d in x.found)
        return outputs, piece.segment.rows.start

    for part in passed(at, o, plain, left, chosen=spread(flight_segments(o), NOISE_SEGMENTS)):
        if part is None:
            continue
        begun.append(part[1])
        for m, (e, square, free, share) in enumerate(part[0]):
            found[m].append(e)
            kept[m].append(share)
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
        noise, loud = quiet_estimate(e_m, r.rate, band, kept[m])
        bursts += [
            (first + b.start, first + b.stop, b.factor)
            for first, x in zip(begun, loud, strict=True)
            for b in x
        ]
        models.append(noise)
        filters.append(noise.whitening_filter(int(min(TAPS, len(r.time)))))
    return Noise(
        tuple(models), tuple(filters), tuple(sorted(bursts)), in_words(sorted(disturbed, key=lambda d: d.at))
    )


@dataclass(frozen=True)
class _Left:
    """What columns leave of the last one.

    Attributes
    ----------
    rest
        (rows,): at the valid samples.
    rank
        How many degrees of freedom the columns count as.
    kept
        Share of white noise that they leave at each frequency of the periodogram; empty where that is not asked for.
    found
        Lines and jumps that were fitted beside them.
    """

    rest: Array
    rank: float
    kept: Array
    found: list[Disturbance]


def _left(
    flat: Array, valid: NDArray[np.bool_], rate: float | None, band: tuple[float, float] | None
) -> _Left:
    """What columns leave of the last of flat (n + 1, rows), with lines and jumps in it fitted beside them.

    No line is looked for in ``band``. Without ``rate`` (of a demodulated channel) neither they nor ``kept`` are looked for.
    """
    found: list[Disturbance] = []
    time = np.flatnonzero(valid) / (rate or 1.0)
    wide = flat
    for n in range(ROUNDS + 1):
        fit = _least_squares(wide)
        rest = flat[-1] - fit.solution @ wide[:-1]
        e = np.zeros(len(valid))
        e[valid] = rest
        more = disturbances(e, valid, rate, band) if rate and n < ROUNDS else []
        if not more:
            break
        found += more
        wide = np.vstack([*(d.columns(time) for d in found), flat])
    kept = _kept(wide[:-1], fit.directions, valid) if rate else np.empty(0)
    return _Left(rest=rest, rank=fit.rank, kept=kept, found=found)


EVERY = 1024
"""Bins of a periodogram for which the share that columns leave is computed; it is interpolated in between."""


def _kept(columns: Array, directions: Array, valid: NDArray[np.bool_]) -> Array:
    """Share of white noise that is left at each frequency once columns (n, rows) are fitted, gaps counted as lost.

    A fit leaves |v|^2 - |Q'v|^2 of the power along any direction v, with Q what the columns span (their leverage); here v
    is a windowed wave. Without it the noise would look quietest where the columns are: on a record of a minute by three
    times. ``directions`` (n, k): columns times it are Q.
    """
    window = signal.get_window("hann", len(valid))
    bins = len(valid) // 2 + 1
    some = np.unique(np.r_[0 : min(bins, EVERY // 2), np.geomspace(1, bins, EVERY).astype(np.intp) - 1])
    waves = np.empty((len(columns), len(some)), dtype=np.complex128)
    x = np.zeros(len(valid))
    for k, column in enumerate(columns):
        x[valid] = column * window[valid]
        waves[k] = np.fft.rfft(x)[some]
    taken = np.sum(np.abs(directions.T @ waves) ** 2, axis=0)
    left = (np.sum(window[valid] ** 2) - taken) / np.sum(window**2)
    return np.interp(np.arange(bins), some, np.maximum(left, 0.0))


def spread(found: Sequence[Segment], most: int) -> list[Segment]:
    """At most so many of the segments, evenly spread."""
    if len(found) <= most:
        return list(found)
    return [found[k] for k in np.linspace(0, len(found) - 1, most).round().astype(int)]


ABSENT = 1e-11
"""Relative size of a direction of (normalised) columns that is rounding rather than physics."""


@dataclass(frozen=True)
class _Fit:
    """Coefficients (n,), how many they count as, and ``directions`` (n, n): columns times it are orthonormal (or fade)."""

    solution: Array
    rank: float
    directions: Array


def _least_squares(columns: Array) -> _Fit:
    """The fit of columns (n + 1, rows) to the last of them.

    Directions that are numerically absent must not be amplified; they are faded out, not cut off, lest rounding decide
    on which side of an edge one is.
    """
    R = triangle(columns)
    n = len(R) - 1
    norms = np.linalg.norm(R[:, :n], axis=0)
    norms[norms == 0.0] = 1.0
    U, s, Vt = np.linalg.svd(R[:n, :n] / norms)
    faded = s**2 / (s**2 + (ABSENT * s[0]) ** 2)
    inverse = Vt.T / np.maximum(s, 1e-300) / norms[:, None]
    solution = inverse @ (faded * (U.T @ R[:n, n]))
    lost = np.sqrt(faded * (2.0 - faded))  # what a faded fit takes of the noise's power
    return _Fit(solution=solution, rank=float(np.sum(faded)), directions=inverse * lost)
