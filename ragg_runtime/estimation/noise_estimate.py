"""Estimate the noise of an observation from what no column explains about a point."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy import fft, optimize

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.drifting_noise import DriftingNoise
from ragg_runtime.estimation.least_squares import add_prior, join
from ragg_runtime.estimation.likelihood_ratio import find_best_edges, find_floor, test
from ragg_runtime.estimation.noise import (
    Level,
    NoiseModel,
    SpectralLine,
    describe_disturbances,
    describe_level,
    estimate_level,
    level_quantities,
)
from ragg_runtime.estimation.observation import (
    ROWS,
    Observation,
    measure_information_per_sample,
    split_at_blocks,
    spread,
)
from ragg_runtime.estimation.regressors import LinearisationPoint, group_by_effect
from ragg_runtime.estimation.spectrum import (
    LOWEST,
    ProjectedResidual,
    Spectrum,
    Stretch,
    compute_periodogram,
    cut_lines,
    estimate,
    fit_columns,
    project_columns,
)
from ragg_runtime.estimation.whitening import Piece, pass_over
from ragg_runtime.io.record import ANGULAR_RATE, SPECIFIC_FORCE
from ragg_runtime.model.record import take_quantities
from ragg_runtime.signals.fir import fill_gaps, find_nonzero

Array = NDArray[np.float64]

# greatest length of the whitening filter, samples: red noise needs as much memory as it has power
TAPS = 24576
# most segments of a flight of which the noise is estimated: 260,000 samples tell a smooth spectrum
NOISE_SEGMENTS = 8
# times that what columns and gaps have taken of noise that is not white is computed anew, with the spectrum that it led to
AGAIN = 3
RED = 1.5  # density at the lowest frequencies over that in the middle from which noise is red, and that is done for columns
# series of noise that show what gaps take: of a third of a single frequency's power that is missing they tell a tenth
DRAWS, NEIGHBOURS = 16, 9
SHORTEST = 128  # least number of samples of which noise can be estimated


CONSTANT = Level()  # a level that follows nothing


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
    if o.recorded.demodulated:
        return _estimate_channel_noise(at, o)
    parts = _fit_segments(at, o, None, chosen)
    apart: Array | None = None
    for _ in range(TURNS_OF_AXES):
        turn = _find_principal_components(parts)
        if turn is None:
            break
        apart = turn if apart is None else turn @ apart
        parts = _fit_segments(at, o, apart, chosen)
    means = average_residuals(at, o, _make_unit_noise(o, apart)) if slow else None
    noise = _estimate_spectra(parts, o, CONSTANT, means)
    level = _choose_level(parts, o, noise)
    if level.parts:
        # what is loud has been in the fit: of what is quiet columns have left more than the noise
        parts = _fit_segments(at, o, apart, chosen, level)
        noise = _estimate_spectra(parts, o, level, means)
    noise = replace(noise, combinations=apart, lines=_list_lines(parts, o, level))
    if not o.smoothed:  # what is left of sensors' noise in the band of the motion is not white
        if level.parts:
            noise = _choose_form(at, o, noise, chosen)
        noise = _prefer_drift(at, o, noise, chosen)
    events = [d.later(p.rows.start / o.record.rate) for p in parts for x in p.outputs for d in x.events]
    texts = describe_disturbances(events), describe_level(level)
    words = "; ".join(w for w in texts if w is not None) or None
    free = sum(max(1.0, len(x.rest) - x.rank - p.taken) for p in parts for x in p.outputs)
    return replace(noise, disturbed=words, freedom=free)


@dataclass(frozen=True)
class _Part:
    """What is left of a segment over the level: of every output, at its ``rows``; ``taken``: degrees of freedom of an unknown gradient.

    ``random``: variance (rows,) that each random effect would add, one output after the other, by its id.
    """

    rows: slice
    outputs: tuple[ProjectedResidual, ...]
    taken: float
    random: Mapping[str, Array]

    @property
    def valid(self) -> NDArray[np.bool_]:
        """(N,): which samples are."""
        return self.outputs[0].valid


# gain in log likelihood a sample from which voltages are turned to their principal components: a correlation of 0.43 between two
SHARED = 0.1

# most times that voltages are turned to their principal components. Each is fitted by itself, which takes some of what they share:
# noise that is shared became 30 times weaker with each turn in the others.
TURNS_OF_AXES = 4


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


# widths of a line, one over the length of a window, from which on it is told from a multiple of the spin rate: one nearer is left to
# the search beside those, for what is fitted to it would take of what turns with the disc
RESOLVED = 4.0
TURNS = 4  # multiples up to which that is so (line_rival.MULTIPLES)


def compute_line_width(o: Observation) -> float:
    """Hz on either side of a line within which another is the same one, which wanders."""
    seconds = float(o.record.time[-1] - o.record.time[0])
    return RESOLVED / min(seconds, unknown_gradient.WINDOW_SECONDS)


def _list_lines(parts: Sequence[_Part], o: Observation, level: Level) -> tuple[SpectralLine, ...]:
    """The lines of the output, multiples of the spin rate excepted; none where the motion has lines, from which they may come."""
    r, width = o.record, compute_line_width(o)
    spin = unknown_gradient.measure_spin_frequency(o) if r.turning else np.inf
    lines: list[SpectralLine] = []
    for p in parts:
        loud = np.broadcast_to(level.of(take_quantities(o.record, p.rows)), p.valid.shape)[p.valid]
        for m, x in enumerate(p.outputs):
            at = np.array([d.at if d.kind == "line" else np.inf for d in x.events])
            for f in at[np.isfinite(at)]:
                near = [q for q in lines if q.output == m and abs(f - q.frequency) < width]
                turns = int(np.rint(f / spin))
                if 1 <= turns <= TURNS and abs(f - turns * spin) < width:
                    continue
                # several next to each other are one that wanders
                line = loud * np.sum(x.shapes[np.abs(at - f) < width], axis=0)
                lines.append(SpectralLine(m, float(f), 0.0 if near else float(np.sqrt(2 * np.mean(line**2)))))
    return () if lines and any(_has_lines(o, p) for p in parts) else tuple(lines)


# share of the power of a channel of the motion from which a line counts: by a smaller one an effect that is missing would show less
# than a thirtieth of what it shows by the rest of the motion
LOUD = 1e-3


def _has_lines(o: Observation, p: _Part) -> bool:
    """Whether any channel of the motion has a line, over a part."""
    for name in (*SPECIFIC_FORCE, *ANGULAR_RATE):
        if name not in o.record.wide:
            continue
        x = o.record.wide[name][p.rows]
        x = np.where(p.valid, x - np.mean(x[p.valid]), 0.0)
        power = compute_periodogram(x, o.record.rate)[1][LOWEST:-1]
        if np.sum(power - cut_lines(power)) > LOUD * np.sum(power):
            return True
    return False


def _estimate_spectra(
    parts: Sequence[_Part], o: Observation, level: Level, means: Sequence[Stretch] | None
) -> NoiseModel:
    """The noise's spectra, given how its level changes."""
    rate, band = o.record.rate, unknown_gradient.find_band(o)
    spin = unknown_gradient.measure_spin_frequency(o) if o.record.turning else None
    loud = [np.mean(np.square(level.of(take_quantities(o.record, p.rows)))) for p in parts]
    mean = float(np.sqrt(np.mean(loud)))
    models, filters = [], []
    for m in range(len(o.series)):
        residuals = [p.outputs[m] for p in parts]
        slow = [] if means is None else [replace(means[m], rest=means[m].rest / mean)]
        low = slow[0].high if slow else 0.0
        whole = [Stretch(x.series, rate, x.kept, low) for x in residuals]
        model = estimate([*whole, *slow], band, spin)
        for _ in range(AGAIN):
            coloured = model.red > RED and residuals[0].columns.size > 0
            if not coloured and all(x.valid.all() for x in residuals):
                break
            filled = []
            for x in residuals:
                series, lost = _fill(x.series, x.valid, model)
                kept = np.maximum(x.measure_kept(model if coloured else None) - lost, 0.0)
                filled.append(Stretch(series, rate, kept, low))
            model = estimate([*filled, *slow], band, spin)
        models.append(model)
        if o.smoothed:  # what little there is above the band of the motion is motion below its sensors' noise, and not stationary
            model = model.raise_floor()
        filters.append(model.whitening_filter(min(TAPS, len(o.record.time))))
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


def _choose_segments(o: Observation, most: int, samples: int) -> list[slice]:
    """The beginnings of up to ``most`` segments, spread over the flight, of up to ``samples`` samples in all."""
    segments = spread(o.segments, most)
    if not o.recorded.demodulated:  # their columns pass a two-sided filter and are not divided
        segments = [slice(x.start, min(x.stop, x.start + samples // len(segments))) for x in segments]
    return [rows for rows in segments if np.sum(o.record.valid[rows]) >= SHORTEST]


def _fit_segments(
    at: LinearisationPoint,
    o: Observation,
    apart: Array | None,
    chosen: Sequence[slice],
    level: Level = CONSTANT,
) -> list[_Part]:
    """Residuals of some segments of the flight, of the series or of combinations of them, by a fit weighted by a level."""
    band = unknown_gradient.find_band(o)
    random = {e.id for e in at.model.candidates if e.kind == "random"}
    shown = [(n, c.effect) for n, c in enumerate(at.candidates, len(at.base)) if c.effect in random]

    def part(piece: Piece) -> _Part:
        r, outputs = piece.observation.record, []
        loud = np.broadcast_to(level.of(r.quantity), r.valid.shape)[r.valid]
        for m, flat in enumerate(np.split(piece.white, len(o.series), axis=1)):
            through = partial(_divide_by_level, piece, m, len(o.series), loud)
            x = fit_columns(flat, r.valid, r.rate, band, through, raised=o.smoothed)
            # of several segments only the means show what is slow
            outputs.append(x if len(chosen) == 1 else replace(x, columns=np.empty(0), directions=np.empty(0)))
        return _Part(
            rows=piece.rows,
            outputs=tuple(outputs),
            taken=sum(w.white.shape[1] for w in piece.windows) / len(o.series),
            random={e: piece.white[place] ** 2 for place, e in shown if e is not None},
        )

    return list(pass_over(at, o, _make_unit_noise(o, apart, level), part, chosen=chosen))


def _make_unit_noise(o: Observation, apart: Array | None, level: Level = CONSTANT) -> NoiseModel:
    """A noise that whitens nothing: the series, or combinations of them, over a level."""
    return replace(NoiseModel.white(o.record.rate, len(o.series)), level=level, combinations=apart)


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


def _estimate_channel_noise(at: LinearisationPoint, o: Observation) -> NoiseModel:
    """Within the demodulator's band the noise of G_out is taken as white; a sample of a seldom recorded channel counts for more."""

    def project(piece: Piece) -> tuple[Array, float]:
        white = piece.white[[*find_nonzero(piece.white[:-1]), True]]
        x = project_columns(white, piece.observation.record.valid)
        # The fit takes as many degrees of freedom as it has columns; an unknown gradient takes its own band.
        return x.rest, x.rank + sum(w.white.shape[1] for w in piece.windows)

    gain, more = o.recorded.noise_share(o.record), measure_information_per_sample(o.record)
    ((rest, taken),) = pass_over(at, o, _make_unit_noise(o, None), project)
    free = len(rest) * max(0.1, 1 - taken / (gain * more * len(rest)))
    sigma = float(np.sqrt(np.sum(rest**2) / gain / free))
    white = NoiseModel.white(o.record.rate, 1, sigma)
    freedom = max(1.0, gain * more * free)
    return replace(white, filters=(np.array([np.sqrt(more) / sigma]),), freedom=freedom)


def _choose_level(parts: Sequence[_Part], o: Observation, noise: NoiseModel) -> Level:
    """Estimate the noise level from sample to sample."""
    z = [noise.whiten(np.stack([x.series for x in p.outputs])[None], p.valid)[0] for p in parts]
    # neighbours are alike where a part of the band has hardly any noise
    step = max(1, round(1.0 / float(np.mean(np.concatenate(z) ** 2))))

    def join(each: Iterable[Array]) -> Array:
        return np.concatenate([*each])[::step]

    records = [(o.record.part(p.rows), p.valid) for p in parts]
    quantities = {
        n: join(np.tile(r.quantity(n)[valid], noise.outputs) for r, valid in records)
        for n in level_quantities(o.record)
    }
    alternatives = {e: join(p.random[e] for p in parts) for e in parts[0].random}
    return estimate_level(join(z), quantities, alternatives)


# logarithm of how much likelier a level of all noise must be than one of the white noise upon a drift, and a drift beneath white noise
# than noise without one
PLAIN = 3.0


def _choose_form(
    at: LinearisationPoint, o: Observation, noise: NoiseModel, chosen: Sequence[slice]
) -> NoiseModel:
    """What a level multiplies: all of the noise, or the white noise upon a drift."""
    drifting, gain = _fit_drifts(at, o, noise, chosen)
    return drifting if gain >= -PLAIN else noise


def _fit_drifts(
    at: LinearisationPoint, o: Observation, noise: NoiseModel, chosen: Sequence[slice]
) -> tuple[NoiseModel, float]:
    """Random walks beneath the white noise of the level, as strong as is likeliest, and the log evidence by which they are likelier than
    a noise.

    Columns take most of what is slow: how strong it is the spectrum of their residual does not tell, but their evidence does.
    """
    samples = len(o.record.time)
    decay = float(np.exp(-2 * np.pi / (4.0 * samples)))
    whites = [1.0 / float(t[0]) for t in noise.filters]

    def make(log_ratio: float, variance: float = 1.0) -> NoiseModel:
        drifts = (
            DriftingNoise(decay, variance * w**2 * float(np.exp(log_ratio)), float(np.sqrt(variance)) * w)
            for w in whites
        )
        return replace(noise, drifts=tuple(drifts))

    # from less than anybody can see to as much as white noise in each sample; a first segment tells it as well as all
    best = optimize.minimize_scalar(
        lambda x: -_compute_evidence(at, o, make(x), chosen[:1])[0],
        bounds=(-2.0 * np.log(samples), 0.0),
        method="bounded",
        options={"xatol": 0.5},
    )
    log_ratio = float(best.x)
    evidence, variance = _compute_evidence(at, o, make(log_ratio), chosen)
    gain = evidence - _compute_evidence(at, o, noise, chosen)[0]
    drifting = make(log_ratio, variance)
    each = zip(drifting.drifts, drifting.spectra, strict=True)
    spectra = [replace(s, log_psd=np.log(d.psd(np.exp(s.log_f), s.rate))) for d, s in each]
    return replace(drifting, spectra=tuple(spectra)), gain


def _prefer_drift(
    at: LinearisationPoint, o: Observation, noise: NoiseModel, chosen: Sequence[slice]
) -> NoiseModel:
    """White noise upon a drift where the base alone is likelier beside it than with any effect beside the noise as it is.

    Many candidates take a drift whole: of their residual nothing tells that it is there, and one of them would be claimed.
    """
    if any(s.red > RED for s in noise.spectra):
        return noise  # they have not
    alone = replace(at, candidates=())
    drifting, gain = _fit_drifts(alone, o, noise, chosen)
    return drifting if gain > PLAIN and gain > _weigh_best_effect(at, o, noise, chosen) else noise


def _weigh_best_effect(
    at: LinearisationPoint, o: Observation, noise: NoiseModel, chosen: Sequence[slice]
) -> float:
    """Log evidence of the effect that best explains what the base leaves, which stays within its priors. A drift is as probable as any."""
    n, effects, samples = len(at.base), group_by_effect(at.candidates), len(o.record.time)

    def factor(piece: Piece) -> list[Array]:
        return [piece.r_factor(x.start, x.stop) for _, x in split_at_blocks(piece.rows, samples)]

    blocks = [T for each in pass_over(at, o, noise, factor, chosen=chosen) for T in each]
    T = add_prior(join(blocks), range(n))
    left = T[n:, n:]
    floor = find_floor(np.linalg.norm(T[:, n:], axis=0))
    unplaced = {e.id for e in at.model.candidates if e.kind == "step"} - at.instants.keys()
    steps = {e: effects.pop(e) for e in [*effects] if e in unplaced}
    tests = [test(left, columns, floor) for columns in effects.values()]
    tests += [t for t, _ in find_best_edges([blocks], np.zeros(n), steps).values()]
    return max((t.log_b for t in tests), default=0.0)


# scales of a column within which its coefficient is expected where noises are compared: none is known
VAGUE = 1e3


def _compute_evidence(
    at: LinearisationPoint, o: Observation, noise: NoiseModel, chosen: Sequence[slice]
) -> tuple[float, float]:
    """Logarithm, whatever the coefficients of the columns in each segment are, for the likeliest variance of whitened samples; and that.

    Coefficients that are fitted with one noise take more of what is not that noise: residuals alone favour the noise they were made with.
    """

    def weigh(piece: Piece) -> tuple[float, float, float]:
        T, r = piece.r_factor(), piece.observation.record
        n = len(T) - 1
        T[:, :n] *= VAGUE
        R = np.diag(add_prior(T, range(n), np.zeros(n)))
        size = noise.measure_log_size(np.broadcast_to(noise.level.of(r.quantity), r.valid.shape), r.valid)
        spanned = float(np.sum(1.0 - R[:-1] ** -2.0))
        free = piece.white.shape[1] - spanned
        return -float(np.sum(np.log(np.abs(R[:-1])))) - size, float(R[-1] ** 2), free

    total, square, free = np.sum(list(pass_over(at, o, noise, weigh, chosen=chosen)), axis=0)
    return float(total - 0.5 * free * (1.0 + np.log(square / free))), float(square / free)


MEANS = 8192  # most means of a flight
PERIODS = 16.0  # in a segment, up to which means tell the noise
# means a period, at least, of the noise that they tell: what is faster they show weaker, and something else in its place
MEANS_A_PERIOD = 8.0
FULL = 0.9  # share of its samples that must be valid for a mean to count: of fewer it has more white noise
ENOUGH = 2  # means for every column, at least


def average_residuals(at: LinearisationPoint, o: Observation, unwhitened: NoiseModel) -> list[Stretch] | None:
    """What all columns leave of each output's means; ``None`` of a flight seen in one piece, or in too few means.

    ``unwhitened``: the noise that makes the columns as they are, or in combinations.
    """
    if len(o.segments) == 1:
        return None
    n, m = len(o.record.time), len(o.series)
    length = -(-n // MEANS)
    count = np.bincount(np.flatnonzero(o.record.valid) // length, minlength=-(-n // length))
    sums = np.zeros((len(at.base) + len(at.candidates) + 1, m, len(count)))

    def add(piece: Piece) -> None:
        plain = np.zeros_like(piece.columns)
        plain[:, :, piece.observation.record.valid] = piece.white.reshape(len(sums), m, -1)
        boxes = slice(piece.rows.start // length, (piece.rows.stop - 1) // length + 1)
        edges = np.arange(boxes.start, boxes.stop) * length - piece.rows.start
        sums[:, :, boxes] += np.add.reduceat(plain, np.maximum(edges, 0), axis=2)

    for _ in pass_over(at, o, unwhitened, add):
        pass
    valid = count >= FULL * length
    if np.sum(valid) < ENOUGH * len(sums):
        return None
    rate = o.record.rate / length
    longest = max(rows.stop - rows.start for rows in o.segments) / o.record.rate
    below = min(PERIODS / longest, rate / MEANS_A_PERIOD)
    each = [fit_columns(sums[:, k, valid] / count[valid], valid, rate, None) for k in range(m)]
    return [Stretch(x.series, rate, x.kept, high=below) for x in each]
