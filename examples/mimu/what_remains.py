"""What remains while it moves, followed: the suspects one by one, and the clocks of the chips."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from examples.mimu.by_hand import gravity_on_rates
from examples.mimu.clocks import ages
from examples.mimu.record import RATE, Array, read
from examples.mimu.story import HERE, UNLIFTED, Found, calibrated, pm, residuals, table
from examples.mimu.variants import PACKETS, synchronous, told, trusted

SLIPS = (
    'effects = [{ id = "clocks", stage = "transducer", '
    'add = "c_1 * slip_1 + c_2 * slip_2 + c_3 * slip_3 + c_4 * slip_4", '
    'params = { c_1 = { unit = "1" }, c_2 = { unit = "1" }, c_3 = { unit = "1" }, c_4 = { unit = "1" } } }]'
)
"""An effect of one's own: what each chip's clock makes of the jerk, offered to all four accelerometers."""

OWN_SHEET = UNLIFTED.replace("effects = []", SLIPS)

NEAR = 2
"""Samples from a saturated one up to which a sample counts as beside it."""


def slips_of(folder: Path) -> Array:
    """(4, 4) values and (4, 4) standard deviations: of each accelerometer (row) the coefficients of the four slips."""
    found = calibrated(OWN_SHEET, ("gyro-delay",), synchronous(folder, outputs=False))
    c = found.fitted.calibration
    values, stds = np.zeros((4, 4)), np.zeros((4, 4))
    for n, q in enumerate(c.columns):
        if q.effect == "clocks" and q.accelerometer is not None:
            at = q.accelerometer - 1, int(q.name[-1]) - 1
            values[at] = c.p[c.index[n]]
            stds[at] = np.sqrt(c.covariance[n, n]) * q.scale
    return np.stack([values, stds])


def slips_table(x: Array) -> str:
    rows = [
        (
            f"A{j + 1}",
            *(pm(v, s) if j != k else f"**{pm(v, s)}**" for k, (v, s) in enumerate(zip(*row, strict=True))),
        )
        for j, row in enumerate(zip(*x, strict=True))
    ]
    return table(("", *(f"slip of A{k}'s chip" for k in range(1, 5))), rows)


def clock_figure() -> bytes:
    """Ages of the eight chips, folded with the period at which each slips past the reader, and their sawteeth. PNG."""
    _, rate, saturated = read(PACKETS)
    found, swift = ages(rate, trusted(saturated))
    fig = Figure(figsize=(7.2, 3.4), layout="constrained")
    axes = fig.subplots(2, 4, sharex=True, sharey=True)
    turns = np.linspace(0.0, 1.0, 400)
    for k, (ax, clock) in enumerate(zip(axes.flat, told(), strict=True)):
        at = np.mod(clock.slip * swift / RATE, 1.0)
        ax.plot(at, 1e3 * (found[k] - np.median(found[k])), ".", ms=1.6, color="C0", alpha=0.6)
        ax.plot(turns, 1e3 * clock.age(turns / clock.slip), color="C1", lw=1.0)
        ax.set_title(f"chip {k + 1}: {clock.slip:.2f} Hz", fontsize=8)
        ax.tick_params(labelsize=7)
        ax.set(ylim=(-1.1, 1.1), xlim=(0, 1))
    fig.supxlabel("turns of the slip", fontsize=8)
    fig.supylabel("age of a gyroscope's sample, ms", fontsize=8)
    made = io.BytesIO()
    fig.savefig(made, dpi=140, metadata={"Software": None})
    return made.getvalue()


def beside(found: Found, saturated: NDArray[np.bool_]) -> tuple[float, float]:
    """rms of the whitened residual of the voltages within :data:`NEAR` samples of a saturated one, and elsewhere."""
    (piece,) = found.fitted.prepared[1].each(lambda p: p)
    distance = distance_transform_edt(~saturated)[piece.sample]
    e = piece.white[-1]
    near = distance <= NEAR
    return float(np.sqrt(np.mean(e[near] ** 2))), float(np.sqrt(np.mean(e[~near] ** 2)))


def suspects(delay: Found, saturated: NDArray[np.bool_]) -> str:
    """What else might be the rest, how that was looked at, and what came out; ``delay``: the fit with gyro-delay."""
    worst, chance = gravity_on_rates(*at_rest())
    scaled = calibrated(UNLIFTED, ("gyro-delay", "gyro-scale"))
    scale = ", ".join(pm(*x, 3) for n, x in scaled.effect.items() if "scale" in n)
    sensitive = calibrated(UNLIFTED, ("gyro-delay", "gyro-g-sensitivity"))
    near, far = beside(delay, saturated)
    rows = [
        (
            "delay of the gyroscopes",
            "`gyro-delay`",
            f"yes: {pm(*(1e3 * x for x in delay.effect['gyro-delay.delta_w']))} ms",
        ),
        (
            "g-sensitivity of the gyroscopes",
            "rates at rest against gravity; `gyro-g-sensitivity` in motion",
            f"{worst:.3f} deg/s per g (3 sigma: {chance:.3f}), a thousandth of the rest; in motion the rms goes from "
            f"{delay.rms[1]:.2f} to {sensitive.rms[1]:.2f} m/s²: no",
        ),
        ("scale of the gyroscopes", "`gyro-scale`", f"{scale}: as the data sheet says"),
        ("scale of the accelerometers", "rests, radius of the sphere", "g, above"),
        (
            "impacts above the band",
            "share of the voltages' power above a quarter of the sampling rate",
            f"{100 * aliased(delay):.0f} %: they are there, and fold; that is why ages cannot be undone by a derivative",
        ),
        (
            "saturation beside the marked samples",
            f"residual within {NEAR} samples of one, in standard deviations of the noise (elsewhere)",
            f"{near:.2f} ({far:.2f}): no",
        ),
        ("clocks of the chips", "above", "yes: most of it"),
    ]
    return table(("suspect", "looked at by", "found"), rows)


def at_rest() -> tuple[Array, Array]:
    """(20, 3) each: mean specific force, m/s^2, and rate, rad/s, of every rest."""
    t = pq.read_table(HERE / "rests.parquet")
    there = np.flatnonzero(np.isfinite(t["V_1"].to_numpy()))
    rest = np.cumsum(np.diff(there, prepend=there[0]) > 1)
    means = [
        np.stack(
            [[np.mean(t[f"{n}_{k}"].to_numpy()[there[rest == r]]) for k in "xyz"] for r in np.unique(rest)]
        )
        for n in ("a", "omega")
    ]
    return means[0], means[1]


def whole_rms(found: Found) -> float:
    """rms of what is left of the voltages while it moves, m/s^2."""
    return float(np.sqrt(np.mean(np.concatenate(residuals(found)) ** 2)))


def aliased(found: Found) -> float:
    """Share of the voltages' power in the upper half of the band that the record has."""
    (piece,) = found.fitted.prepared[1].each(lambda p: p)
    data = piece.observation.data
    power = np.abs(np.fft.rfft(data * np.hanning(data.shape[1]), axis=1)) ** 2
    return float(np.sum(power[:, power.shape[1] // 2 :]) / np.sum(power[:, 1:]))
