"""Samples that a fit does without: those at which a switch may be on either side, ends that late motion does not cover, and, of
long flights at a high rate, all but one in a few.

Output and motion pass a low-pass and every so many samples are kept. The model's output is made of the whole record and thinned;
its derivatives are those along the thinned motion, which must agree with the whole ones on an excerpt.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ragg_runtime.estimation import regressors as design
from ragg_runtime.estimation.observation import Observation, Thin, divide_into_segments, spread
from ragg_runtime.estimation.regressors import LinearisationPoint, compute_residual, linearise, make_point
from ragg_runtime.estimation.scores import STD_OF_MEDIAN
from ragg_runtime.estimation.spectrum import find_lines
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io.record import is_disc_angle
from ragg_runtime.model.memory import list_late, list_memories
from ragg_runtime.model.model import Model, make_vector
from ragg_runtime.model.record import HALO
from ragg_runtime.signals.derivative import FAR, WINDOW, bridge_gaps, find_short_runs
from ragg_runtime.signals.fir import convolve

Array = NDArray[np.float64]

OPEN = 3.0  # standard deviations of a voltage, as the sheet knows it, from zero up to which the side is open
LATEST = 3.0  # times the prior's width of a delay by which motion may be late
# samples at either end of a flight whose derivative has 6 and 30 times the error of one inside (differentiate)
EXTRAPOLATED = 2

# standard deviations of the residual beyond which one of them is left out with its like: four samples of 4 Hz left 8,289 of a
# chi-square of 182,000 beside the right effect, which leaves 860 without them
MISFIT = 5.0
# share of the samples beyond which none is left out: a sheet that knows so little of the switch cannot help
MOST_LEFT_OUT = 0.2


def leave_out_uncertain(
    model: Model, instrument: Instrument, observations: Sequence[Observation]
) -> list[Observation]:
    """The observations without the samples that the model does not describe: sides of a switch, ends of the motion."""
    observations = [_leave_out_ends(model, instrument, o) for o in observations]
    if not any(e.switches for e in model.effects):
        return observations
    results = []
    for o in observations:
        # a sample of channels is made of many: of those none is left out
        segments = [] if o.recorded.demodulated else divide_into_segments(len(o.record.valid))
        parts = [_find_open(model, instrument, o.part(rows)) for rows in segments]
        results.append(_leave_out(o, np.concatenate(parts)) if parts else o)
    return results


def leave_out_extrapolated(model: Model, p: Array, observations: Sequence[Observation]) -> list[Observation]:
    """The observations without the ends where a model that differentiates or moves the motion, with the parameters p, does not fit: of
    the flight, and beside gaps too wide for the spline over them.
    """
    if not (any(n.startswith(("d_", "d2_")) for n in model.chain.INPUTS) or [*list_late(model)]):
        return list(observations)
    results = []
    for o in observations:
        valid = o.record.valid
        ends = ndimage.binary_dilation(~valid & ~find_short_runs(~valid, FAR), iterations=WINDOW // 2)
        ends[:EXTRAPOLATED] = ends[-EXTRAPOLATED:] = True
        left = np.max(np.abs(compute_residual(model, o, p)), axis=0)
        std = STD_OF_MEDIAN * float(np.median(left[valid]))
        results.append(_leave_out(o, ends) if np.any(left[ends & valid] > MISFIT * std) else o)
    return results


def _leave_out(o: Observation, mask: NDArray[np.bool_]) -> Observation:
    """An observation without the samples of a mask (N,), unless these are too many."""
    valid = o.record.valid
    kept = valid & ~mask
    if np.array_equal(kept, valid) or np.sum(kept) < (1.0 - MOST_LEFT_OUT) * np.sum(valid):
        return o
    return replace(o, record=replace(o.record, valid=kept))


def _leave_out_ends(model: Model, instrument: Instrument, o: Observation) -> Observation:
    """Without as much of either end as motion may be late, and what an instrument may remember of what was before."""
    moving, memories = dict(list_late(model)), [*list_memories(model, make_vector(model, instrument))]
    r = o.record
    late = [
        c.scale * (r.time[-1] if moving[k].growing else 1.0) * r.rate
        for c, k in design.list_base_columns(model, instrument)
        if k in moving
    ]
    n = int(np.ceil(LATEST * max(late, default=0.0)))
    settled = LATEST * max((m.settles * r.rate for m in memories), default=0.0)
    begun = max(n, int(min(settled, MOST_LEFT_OUT / 2 * len(r.valid))))
    n = max(n, HALO if memories else 0)  # beyond the end the record is continued with its last value
    outside = np.ones(len(r.valid), dtype=np.bool_)
    outside[begun : len(outside) - n] = False
    return _leave_out(o, outside)


def _find_open(model: Model, instrument: Instrument, o: Observation) -> NDArray[np.bool_]:
    """(N,): whether the side of any of the output's accelerometers is open."""
    chain, r, p = model.chain, o.record, make_vector(model, instrument)
    x, members = r.inputs(chain), o.output.members
    rows = {name: k for k, (name, _) in enumerate(chain.ROWS)}
    base = [c for c, _ in design.list_base_columns(model, instrument) if c.effect is None]
    mask = np.zeros(len(r.time), dtype=np.bool_)
    for j, v in zip(members, chain.voltages(r.time, x, p, r.phi, members), strict=True):
        slopes = chain.derivatives(j, r.time, x, p, r.phi)
        variance = sum((slopes[rows[c.name]] * c.scale) ** 2 for c in base if c.accelerometer == j + 1)
        mask |= v**2 < OPEN**2 * variance
    return mask


# one in so many samples may be kept; of one in two the whole record's residuals cost what the rest spares
EVERY = (12, 10, 8, 6, 5, 4, 3)
# edges of the low-pass over half the rate of the samples that are kept: what folds falls between them
PASSED, STOPPED = 0.8, 1.2
# of the low-pass, dB: of the output, a million times the noise, what folds is a tenth of that and no motion
ATTENUATION = 100.0
# Hz, of the samples that are kept, and of what passes beyond the fourth multiple of the spin rate: the motion about it
LEAST_RATE, ABOVE = 8.0, 2.0

# greatest relative difference between a column along the thinned motion and the thinned column: of the model's parameters, and of
# candidates, which are derived into the model once they are found
ALIKE, NEAR = 1e-3, 0.2
EXCERPTS, EXCERPT = 3, 12000  # segments on whose first samples the columns are compared, and most of these
SHORT = 8  # lengths of the low-pass that a segment must have at least
# share of the low-pass under which samples may be missing, as spikes are: straight lines then stand in their place
MISSING = 0.25
LOST = 0.05  # share of the samples that may be lost beside those that are missing


def thin_observations(
    model: Model, instrument: Instrument, observations: Sequence[Observation]
) -> list[Observation]:
    """Observations thinned as far as their columns about the sheet allow, those of one flight alike; short ones as they are."""
    candidates = design.list_candidate_columns(model, instrument)
    at = make_point(model, instrument, make_vector(model, instrument), candidates)
    most = [_find_most(at, o) for o in observations]
    results = []
    for o in observations:
        step = min(k for k, x in zip(most, observations, strict=True) if x.flight == o.flight)
        results.append(o if step == 1 else _keep_samples(_thin(o, step)))
    return results


def _find_most(at: LinearisationPoint, o: Observation) -> int:
    """The largest step at which its samples may be taken."""
    least = max(LEAST_RATE, 2 * (4 * o.record.spin_frequency + ABOVE) / PASSED)
    choices = [k for k in EVERY if o.record.rate >= k * least]
    if o.recorded.demodulated or len(o.segments) == 1 or not choices:
        return 1
    chosen = spread([rows for rows in o.segments if o.record.valid[rows].any()], EXCERPTS)
    pieces = [o.part(slice(rows.start, min(rows.start + EXCERPT, rows.stop))) for rows in chosen]
    whole = [linearise(at, _count_all(x))[:-1] for x in pieces]

    def is_enough(step: int) -> bool:
        thin = [_thin(x, step) for x in pieces]
        short = min(len(x.record.time) for x in pieces) < SHORT * len(thin[0].taps)
        return not short and _are_alike(at, thin, whole)

    if not is_enough(choices[-1]):  # a motion that shakes is soon known
        return 1
    step = next((k for k in choices[:-1] if is_enough(k)), choices[-1])
    lost = np.mean(o.record.valid) - np.mean(_find_supported(_thin(o, step)))
    return 1 if lost > LOST or any(_has_line(at, _thin(o.part(rows), step)) for rows in chosen) else step


def _count_all(o: Observation) -> Observation:
    """An observation all of whose samples count: of its motion alone something is asked."""
    return replace(o, record=replace(o.record, valid=np.ones_like(o.record.valid)))


def _thin(o: Observation, step: int) -> Thin:
    taps = make_low_pass(step)
    return Thin(whole=o, step=step, taps=taps, rows=slice(0, (len(o.record.time) - len(taps)) // step + 1))


def make_low_pass(step: int) -> Array:
    """(2 h + 1,): taps, their sum 1, for one in so many samples (Kaiser's window)."""
    from scipy import signal  # slow to import, and only long flights need it

    half, shape = signal.kaiserord(ATTENUATION, (STOPPED - PASSED) / step)
    return np.asarray(signal.firwin(2 * (half // 2) + 1, 1.0 / step, window=("kaiser", shape)))


def measure_beyond(model: Model, p: Array, o: Observation) -> float:
    """Mean square, V^2 of G_out, of what thinning has taken of an observation's residual about parameters p, SI."""
    if o.thin is None:
        return 0.0
    whole, taps = o.thin.whole, o.thin.taps

    def taken(rows: slice) -> Array:
        part = whole.part(rows)
        e = part.signs @ compute_residual(model, part, p)
        slow, inner = convolve(e, taps), slice(len(taps) // 2, len(e) - len(taps) // 2)
        # the whole less the slow, one sample at a time: what both hold, an unknown gradient say, cancels
        square = ((e[inner] - slow) * (e[inner] + slow))[part.record.valid[inner]]
        return np.array([np.sum(square), len(square)])

    square, count = sum(map(taken, whole.segments), np.zeros(2))
    return max(0.0, float(square) / max(float(count), 1.0))


def _are_alike(at: LinearisationPoint, pieces: Sequence[Thin], whole: Sequence[Array]) -> bool:
    """Whether the columns of thinned pieces of a flight are the ``whole`` pieces' columns, thinned."""
    square = off = np.zeros(1)
    for thin, columns in zip(pieces, whole, strict=True):
        o = replace(_keep_samples(thin), thin=None)
        # towards an end or a gap derivatives are of one side
        inside = ndimage.binary_erosion(o.record.valid, iterations=HALO)
        if 2 * np.sum(inside) < len(inside):
            return False  # too few samples to determine the rest
        computed, expected = linearise(at, o)[:-1], thin.decimate(columns)
        square = square + np.sum(expected[:, :, inside] ** 2, axis=(1, 2))
        off = off + np.sum((computed - expected)[:, :, inside] ** 2, axis=(1, 2))
    most = np.where(np.arange(len(off)) < len(at.base), ALIKE, NEAR)
    # memory of fast motion is not that of thinned motion: once such an effect is in the model, the record is taken whole
    memories = {e.id for e in at.model.candidates if e.memory}
    asked = np.array([c.effect not in memories for c in (*at.base, *at.candidates)])
    return bool(np.all((off <= most**2 * square)[asked]))


def _has_line(at: LinearisationPoint, thin: Thin) -> bool:
    """Whether the part of a piece's residual that the low-pass removes has a line, which must be reported."""
    r, half, e = thin.whole.record, len(thin.taps) // 2, compute_residual(at.model, thin.whole, at.p)
    fast = e[:, half:-half] - convolve(e, thin.taps)
    kept = (0.0, STOPPED * r.rate / (2 * thin.step))
    return any(find_lines(x, r.rate, kept) for x in fast)


def _find_supported(thin: Thin) -> NDArray[np.bool_]:
    """(n,): which samples that are kept have nearly all that makes them."""
    weights = replace(thin, taps=np.abs(thin.taps) / np.sum(np.abs(thin.taps)))
    return np.asarray(weights.decimate(np.where(thin.whole.record.valid, 0.0, 1.0)) < MISSING)


def _keep_samples(thin: Thin) -> Observation:
    """The thinned observation."""
    o, half = thin.whole, len(thin.taps) // 2
    r = o.record

    def decimate(x: Array, *, angle: bool = False) -> Array:
        x = np.nan_to_num(bridge_gaps(np.array(x), r.valid & np.isfinite(x)))
        return thin.decimate(np.unwrap(x) if angle else x)  # of a disc's angle turns may be missing

    series = tuple(decimate(x) for x in o.series)
    record = replace(
        r,
        time=np.array(r.time[half :: thin.step][: thin.rows.stop]),
        wide={n: decimate(x, angle=is_disc_angle(n)) for n, x in r.channels.items()},
        reading=None if r.reading is None else series[0],
        rate=r.rate / thin.step,
        valid=_find_supported(thin),
        halo=(0, 0),
        whole=None,
        first=0,
    )
    return replace(o, record=record, series=series, thin=thin)
