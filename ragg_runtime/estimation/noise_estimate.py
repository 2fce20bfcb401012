"""Estimate the noise of an observation from what no column explains about a point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy import fft

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation import noise_level, unknown_gradient
from ragg_runtime.estimation.least_squares import add_prior
from ragg_runtime.estimation.noise import NoiseModel, SpectralLine, level_quantities
from ragg_runtime.estimation.noise_level import Level
from ragg_runtime.estimation.observation import (
    ROWS,
    THINNER,
    Observation,
    Segment,
    measure_information_per_sample,
    spread,
    take_beginnings,
)
from ragg_runtime.estimation.regressors import LinearisationPoint
from ragg_runtime.estimation.residual import (
    Disturbance,
    ProjectedResidual,
    describe_disturbances,
    fit_columns,
    place_valid,
)
from ragg_runtime.estimation.spectrum import (
    LOWEST,
    Averages,
    Spectrum,
    compute_periodogram,
    cut_lines,
    estimate,
)
from ragg_runtime.estimation.whitening import Piece, divide_flight, is_long, pass_over
from ragg_runtime.io.record import ANGULAR_RATE, SPECIFIC_FORCE
from ragg_runtime.model.record import take_quantities
from ragg_runtime.signals.fir import fill_gaps

Array = NDArray[np.float64]

TAPS = 24576
"""Greatest length of the whitening filter, samples: red noise needs as much memory as it has power."""

NOISE_SEGMENTS = 8
"""Most segments of a flight of which the noise is estimated: 260,000 samples tell a smooth spectrum."""

AGAIN = 3
"""Times that what columns and gaps have taken of noise that is not white is computed anew, with the spectrum that it led to."""

RED = 1.5
"""Density at the lowest frequencies over that in the middle from which that is done for columns."""

DRAWS, NEIGHBOURS = 16, 9
"""Series of noise that show what gaps take: of a third of a single frequency's power that is missing they tell a tenth."""

SHORTEST = 128
"""Least number of samples of which noise can be estimated."""


CONSTANT = Level()
"""A level that follows nothing."""


def estimate_noise(
    at: LinearisationPoint,
    o: Observation,
    *,
    most: int = NOISE_SEGMENTS,
    samples: int = NOISE_SEGMENTS * ROWS,
    slow: bool = True,
) -> NoiseModel:
    """The noise of an observation, from what no column and no unknown gradient explains about a point.

    Parameters
    ----------
    at
        Parameters, and the columns that are fitted: base and candidates.
    most, samples
        Most samples of which it is estimated, in all: of ``most`` segments the beginnings.
    slow
        Whether means over all of a flight that is longer than one segment are looked at, too.

    Raises
    ------
    UserError
        If the record is too short.
    """
    if np.sum(o.record.valid) < SHORTEST:
        raise UserError(
            "the record is too short to estimate its noise",
            where=o.name,
            found=f"{int(np.sum(o.record.valid))} valid samples",
            expected=f"at least {SHORTEST}",
            remedy="give a longer or cleaner recording",
        )
    chosen = _choose_segments(o, most, samples)
    parts = _fit_segments(at, o, None, chosen)
    if o.recorded.demodulated:
        return _estimate_of_channels(parts, o)
    apart: Array | None = None
    for _ in range(TURNS_OF_AXES):
        turn = _find_principal_components(parts)
        if turn is None:
            break
        apart = turn if apart is None else turn @ apart
        parts = _fit_segments(at, o, apart, chosen)
    means = average_residuals(at, o, _make_unit_noise(o, apart)) if slow else None
    noise = _estimate_spectra(parts, o, CONSTANT, means)
    level = _level(parts, o, noise)
    if (
        level.parts
    ):  # what is loud has been in the fit: of what is quiet columns have left more than the noise
        parts = _fit_segments(at, o, apart, chosen, level)
        noise = _estimate_spectra(parts, o, level, means)
    noise = replace(noise, combinations=apart, lines=_list_lines(parts, o))
    if level.parts:
        either = (replace(noise, level_first=x) for x in (False, True))
        noise = max(either, key=lambda n: _compute_evidence(at, o, n, chosen))
    said = (
        describe_disturbances(_collect_disturbances(parts, o.record.rate)),
        noise_level.describe_level(level),
    )
    words = "; ".join(w for w in said if w is not None) or None
    free = sum(max(1.0, len(x.rest) - x.rank - p.taken) for p in parts for x in p.outputs)
    return replace(noise, disturbed=words, freedom=free)


@dataclass(frozen=True)
class _Part:
    """What is left of a segment: of every output, at its ``rows``; ``taken`` are degrees of freedom of an unknown gradient.

    ``random``: variance (valid,) that each random effect would add to every output, by its id.
    """

    rows: slice
    valid: NDArray[np.bool_]
    outputs: tuple[ProjectedResidual, ...]
    taken: float
    random: Mapping[str, tuple[Array, ...]]

    def rest(self, m: int) -> Array:
        """(N,): of an output, zero where a sample is not valid."""
        return place_valid(self.outputs[m].rest, self.valid)


SHARED = 0.1
"""Gain in log likelihood a sample from which voltages are turned to their principal components: a correlation of 0.43 between two."""

TURNS_OF_AXES = 4
"""Most times that voltages are turned to their principal components. Each is fitted by itself, which takes some of what they share: noise
that is shared became 30 times weaker with each turn in the others."""


def _find_principal_components(parts: Sequence[_Part]) -> Array | None:
    """(m, m), orthonormal rows: the principal components of the residuals of m voltages; ``None`` if they share little.

    What shakes a whole disc (a servo of the spin, an angular acceleration that the motion sensors measure poorly) is in all voltages at
    once: taken one by one each would seem as noisy as that, and what they share would look like a signal. It is one component.
    """
    if len(parts[0].outputs) == 1:
        return None
    rests = np.concatenate([np.stack([x.rest for x in p.outputs]) for p in parts], axis=1)
    if -0.5 * np.linalg.slogdet(np.corrcoef(rests))[1] < SHARED:
        return None
    return np.asarray(np.linalg.eigh(rests @ rests.T)[1].T)


RESOLVED = 4.0
"""Widths of a line, one over the length of a window, from which on it is told from a multiple of the spin rate: one nearer
is left to the search beside those, for what is fitted to it would take of what turns with the disc."""

TURNS = 4
"""Multiples up to which that is so (``line_rival.MULTIPLES``)."""


def compute_line_width(o: Observation) -> float:
    """Hz on either side of a line within which another is the same one, which wanders."""
    seconds = float(o.record.time[-1] - o.record.time[0])
    return RESOLVED / min(seconds, unknown_gradient.WINDOW_SECONDS)


def _list_lines(parts: Sequence[_Part], o: Observation) -> tuple[SpectralLine, ...]:
    """The lines of the output that are none of the motion's: where that has lines itself, they may be."""
    r, width = o.record, compute_line_width(o)
    spin = unknown_gradient.measure_spin_frequency(o) if r.turning else np.inf
    found: list[SpectralLine] = []
    for p in parts:
        for m, x in enumerate(p.outputs):
            lines = np.array([d.at if d.kind == "line" else np.inf for d in x.found])
            for f in lines[np.isfinite(lines)]:
                near = [q for q in found if q.output == m and abs(f - q.frequency) < width]
                turns = int(np.rint(f / spin))
                if 1 <= turns <= TURNS and abs(f - turns * spin) < width:
                    continue
                # several next to each other are one that wanders
                own = np.sum(x.shapes[np.abs(lines - f) < width], axis=0)
                found.append(SpectralLine(m, float(f), 0.0 if near else float(np.sqrt(2 * np.mean(own**2)))))
    return () if found and any(_has_lines(o, p) for p in parts) else tuple(found)


LOUD = 1e-3
"""Share of the power of a channel of the motion from which a line counts: by a smaller one an effect that is missing would show less
than a thirtieth of what it shows by the rest of the motion."""


def _has_lines(o: Observation, p: _Part) -> bool:
    """Whether any channel of the motion has a line, over a part."""
    for name in (*SPECIFIC_FORCE, *ANGULAR_RATE):
        if name not in o.record.wide:
            continue
        x = o.record.wide[name][p.rows]
        power = compute_periodogram(np.where(p.valid, x - np.mean(x[p.valid]), 0.0), o.record.rate)[1][
            LOWEST:-1
        ]
        if np.sum(power - cut_lines(power)) > LOUD * np.sum(power):
            return True
    return False


def _estimate_spectra(
    parts: Sequence[_Part], o: Observation, level: Level, means: Sequence[Averages] | None
) -> NoiseModel:
    """The noise's spectra, given how its level changes."""
    rate, band = o.record.rate, unknown_gradient.find_band(o)
    spin = unknown_gradient.measure_spin_frequency(o) if o.record.turning else None
    loud = [level.of(take_quantities(o.record, p.rows)) for p in parts]
    mean = float(np.sqrt(np.mean([np.mean(np.square(x)) for x in loud])))
    models, filters = [], []
    for m in range(len(o.series)):
        rest = [p.rest(m) / x for p, x in zip(parts, loud, strict=True)]
        slow = None if means is None else replace(means[m], rest=means[m].rest / mean)
        model = estimate(rest, rate, band, [p.outputs[m].kept for p in parts], slow, spin)
        for _ in range(AGAIN):
            coloured = model.red > RED and parts[0].outputs[m].columns.size > 0
            if not coloured and all(p.valid.all() for p in parts):
                break
            filled = [_fill(x, p.valid, model) for p, x in zip(parts, rest, strict=True)]
            kept = [
                np.maximum(p.outputs[m].kept_of(model if coloured else None) - lost, 0.0)
                for p, (_, lost) in zip(parts, filled, strict=True)
            ]
            model = estimate([x for x, _ in filled], rate, band, kept, slow, spin)
        models.append(model)
        taps = TAPS if o.thin is None else TAPS // THINNER
        if o.smoothed:  # what little there is above the band of the motion is motion below its sensors' noise, and not stationary
            model = model.raise_floor()
        filters.append(model.whitening_filter(int(min(taps, len(o.record.time)))))
    return NoiseModel(spectra=tuple(models), filters=tuple(filters), level=level)


def _fill(rest: Array, valid: NDArray[np.bool_], model: Spectrum) -> tuple[Array, Array]:
    """A residual (N,) with its gaps interpolated, and the share of the noise that its periodogram lacks even so."""
    n, rate = len(rest), model.rate
    if valid.all():
        return rest, np.zeros(n // 2 + 1)
    taps = model.whitening_filter(n)
    f = fft.rfftfreq(2 * n, 1.0 / rate)
    shape = np.where(f < LOWEST * rate / n, 0.0, np.sqrt(model.psd(f) * rate / 2))
    drawn = np.random.default_rng(0).standard_normal((DRAWS, 2 * n))
    noise = fft.irfft(fft.rfft(drawn) * shape, 2 * n)[:, :n]
    f, power = compute_periodogram(noise - fill_gaps(noise * valid, valid, taps), rate)
    share = np.convolve(np.mean(power, axis=0) / model.psd(f), np.full(NEIGHBOURS, 1 / NEIGHBOURS), "same")
    return fill_gaps(rest[None], valid, taps)[0], share


def _choose_segments(o: Observation, most: int, samples: int) -> list[Segment]:
    """The beginnings of at ``most`` so many segments, spread over the flight, with at most so many ``samples`` in all."""
    found = spread(divide_flight(o), most)
    if not o.recorded.demodulated:  # their columns pass a two-sided filter and are not divided
        found = take_beginnings(found, samples)
    return [s for s in found if np.sum(o.record.valid[s.rows]) >= SHORTEST]


def _fit_segments(
    at: LinearisationPoint,
    o: Observation,
    apart: Array | None,
    chosen: Sequence[Segment],
    level: Level = CONSTANT,
) -> list[_Part]:
    """What is left of some segments of the flight, of the series as they are or in combinations, by a fit that weighs by a level."""
    band = unknown_gradient.find_band(o)
    rate = None if o.recorded.demodulated else o.record.rate
    random = {e.id for e in at.model.candidates if e.kind == "random"}
    shown = [(n, c.effect) for n, c in enumerate(at.candidates, len(at.base)) if c.effect in random]

    def kept(x: ProjectedResidual, loud: Array) -> ProjectedResidual:
        x = replace(x, rest=x.rest * loud, shapes=x.shapes * loud)
        # of several segments only the means show what is slow
        return x if len(chosen) == 1 else replace(x, columns=np.empty(0), directions=np.empty(0))

    def part(piece: Piece) -> _Part:
        r = piece.observation.record
        valid, loud = r.valid, np.broadcast_to(level.of(r.quantity), r.valid.shape)[r.valid]
        each = np.split(piece.white[piece.nonzero], len(o.series), axis=1)
        known = [partial(_divide_by_level, piece, m, len(each), loud) for m in range(len(each))]
        return _Part(
            rows=piece.segment.rows,
            valid=valid,
            outputs=tuple(
                kept(fit_columns(x, valid, rate, band, t, raised=o.smoothed), loud)
                for x, t in zip(each, known, strict=True)
            ),
            taken=sum(w.white.shape[1] for w in piece.windows) / len(o.series),
            random={
                e: tuple(piece.white[place].reshape(len(o.series), -1) ** 2)
                for place, e in shown
                if e is not None
            },
        )

    return list(pass_over(at, o, _make_unit_noise(o, apart, level), part, chosen=chosen))


def _make_unit_noise(o: Observation, apart: Array | None, level: Level = CONSTANT) -> NoiseModel:
    """What leaves the series as they are, or in combinations, over a level."""
    plain = replace(NoiseModel.white(o.record.rate, len(o.series)), level=level)
    return plain if apart is None else replace(plain, combinations=apart)


def _divide_by_level(piece: Piece, m: int, outputs: int, loud: Array, columns: Array) -> Array:
    """Columns (k, rows) of one output over a level (rows,), without what an unknown gradient spans."""
    columns = columns / loud
    if not piece.windows:
        return columns
    wide = np.zeros((len(columns), outputs, columns.shape[1]))
    wide[:, m] = columns
    flat = wide.reshape(len(columns), -1)
    unknown_gradient.project(flat, piece.windows)
    return np.asarray(flat.reshape(wide.shape)[:, m])


def _estimate_of_channels(parts: Sequence[_Part], o: Observation) -> NoiseModel:
    """Within the demodulator's band the noise of G_out is taken as white; a sample of a seldom recorded channel counts for more."""
    gain, more = o.recorded.noise_share(o.record), measure_information_per_sample(o.record)
    squares = free = 0.0
    for p in parts:
        (x,) = p.outputs
        squares += float(np.sum(x.rest**2)) / gain
        # The fit takes as many degrees of freedom as it has columns; an unknown gradient takes its own band.
        free += len(x.rest) * max(0.1, 1 - (x.rank + p.taken) / (gain * more * len(x.rest)))
    sigma = float(np.sqrt(squares / free))
    density = np.full(2, np.log(2 * sigma**2 / o.record.rate))
    model = Spectrum(o.record.rate, np.array([-20.0, 20.0]), density, np.zeros(2))
    freedom = max(1.0, gain * more * free)
    return NoiseModel(spectra=(model,), filters=(np.array([np.sqrt(more) / sigma]),), freedom=freedom)


def _collect_disturbances(parts: Sequence[_Part], rate: float) -> list[Disturbance]:
    """Lines and jumps of all segments, in order."""
    found = [
        replace(d, at=d.at + p.rows.start / rate) if d.kind == "jump" else d
        for p in parts
        for x in p.outputs
        for d in x.found
    ]
    return sorted(found, key=lambda d: d.at)


def _level(parts: Sequence[_Part], o: Observation, noise: NoiseModel) -> Level:
    """Estimate the noise level from sample to sample."""
    names = level_quantities(o.record)
    white: list[Array] = []
    quantities: dict[str, list[Array]] = {n: [] for n in names}
    alternatives: dict[str, list[Array]] = {}
    for p in parts:
        r = o.record.part(p.rows)
        rests = np.stack([p.rest(m) for m in range(noise.outputs)])
        white.append(noise.whiten(rests[None], p.valid)[0])
        for m in range(noise.outputs):
            for n in names:
                quantities[n].append(r.quantity(n)[p.valid])
            for e, variance in p.random.items():
                alternatives.setdefault(e, []).append(variance[m])
    z = np.concatenate(white)
    # neighbours are alike where a part of the band has hardly any noise
    every = max(1, round(1.0 / float(np.mean(z**2))))
    return noise_level.estimate_level(
        z[::every],
        {n: np.concatenate(x)[::every] for n, x in quantities.items()},
        {e: np.concatenate(x)[::every] for e, x in alternatives.items()},
    )


VAGUE = 1e3
"""Scales of a column within which its coefficient is expected where noises are compared: none is known."""


def _compute_evidence(
    at: LinearisationPoint, o: Observation, noise: NoiseModel, chosen: Sequence[Segment]
) -> float:
    """Of a noise against one of the same filters and level: logarithm, whatever the coefficients of the columns in each segment are.

    Coefficients that are fitted with one noise take more of what is not that noise: residuals alone favour the noise they were made with.
    """
    found = 0.0
    for T in pass_over(at, o, noise, lambda piece: piece.r_factor(), chosen=chosen):
        n = len(T) - 1
        T[:, :n] *= VAGUE
        R = np.diag(add_prior(T, range(n), np.zeros(n)))
        found -= 0.5 * float(R[-1] ** 2) + float(np.sum(np.log(np.abs(R[:-1]))))
    return found


MEANS = 8192
"""Most means of a flight."""

PERIODS = 16.0
"""In a segment, up to which means tell the noise."""

MEANS_A_PERIOD = 8.0
"""Means a period, at least, of the noise that they tell: what is faster they show weaker, and something else in its place."""

FULL = 0.9
"""Share of its samples that must be valid for a mean to count: of fewer it has more white noise."""

ENOUGH = 2
"""Means for every column, at least."""


def average_residuals(
    at: LinearisationPoint, o: Observation, unwhitened: NoiseModel
) -> list[Averages] | None:
    """What all columns leave of each output's means; ``None`` of a flight seen in one piece, or in too few means.

    ``unwhitened``: the noise that makes the columns as they are, or in combinations.
    """
    if not is_long(o):
        return None
    n, m = len(o.record.time), len(o.series)
    every = -(-n // MEANS)
    count = np.bincount(np.flatnonzero(o.record.valid) // every, minlength=-(-n // every))
    sums: Array | None = None

    def summed(piece: Piece) -> tuple[int, Array]:
        boxes = piece.sample[: len(piece.sample) // m] // every
        each = piece.white.reshape(len(piece.white), m, -1)
        if not len(boxes):
            return 0, np.zeros((len(each), m, 0))
        starts = np.searchsorted(boxes, np.arange(boxes[0], boxes[-1] + 1))
        ends = np.append(starts[1:], len(boxes))
        found = np.add.reduceat(each, starts, axis=2)
        found[:, :, starts == ends] = 0.0  # of no sample
        return int(boxes[0]), found

    for first, part in pass_over(at, o, unwhitened, summed):
        if sums is None:
            sums = np.zeros((len(part), m, len(count)))
        sums[:, :, first : first + part.shape[2]] += part
    valid = count >= FULL * every
    if sums is None or np.sum(valid) < ENOUGH * len(sums):
        return None
    rate = o.record.rate / every
    longest = max(s.rows.stop - s.rows.start for s in divide_flight(o)) / o.record.rate
    below = min(PERIODS / longest, rate / MEANS_A_PERIOD)
    found = []
    for k in range(m):
        flat = sums[:, k, valid] / count[valid]
        left = fit_columns(flat, valid, rate, None)
        found.append(Averages(rest=place_valid(left.rest, valid), kept=left.kept, rate=rate, below=below))
    return found
