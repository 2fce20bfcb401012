"""The motion of the packaged record treated otherwise, from its packets: unmarked, at one instant, with the clocks' slips beside it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

from examples.mimu.clocks import SEEN, Clock, at_one_instant, clocks, of_back
from examples.mimu.record import G0, PLACES, RATE, Array, motion, read
from ragg_runtime.flight import Flight, write_flight

PACKETS = Path(__file__).parent / "motion.bin.gz"


def trusted(saturated: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(N,): samples whose derivatives are no guesses."""
    good = ~binary_dilation(saturated, np.ones(SEEN + 2))
    good[:SEEN] = good[-SEEN:] = False
    return np.asarray(good)


@cache
def told() -> tuple[Clock, ...]:
    """The clocks of the eight chips, by the gyroscopes of the packaged motion."""
    _, rate, saturated = read(PACKETS)
    return tuple(clocks(rate, trusted(saturated)))


def ages(count: int) -> Array:
    """(count, 8) s of the packaged motion."""
    t = np.arange(count) / RATE
    return np.stack([c.age(t) for c in told()], axis=1)


def tangents() -> Array:
    """(4, 3): input axes of A1 ... A4."""
    angle = np.deg2rad([degrees for _, degrees in PLACES])
    return np.stack([-np.sin(angle), np.cos(angle), np.zeros(4)], axis=1)


def unmarked(folder: Path) -> Path:
    """The motion with the samples at which something is saturated as the chips gave them."""
    force, rate, saturated = read(PACKETS)
    path = folder / "unmarked.parquet"
    write_flight(replace(motion(force, rate, np.zeros_like(saturated)), name="unmarked"), path)
    return path


def synchronous(folder: Path, *, outputs: bool = True, wrong: int = 0) -> Path:
    """The motion at one instant for all chips, the ``outputs`` too; or else with channels slip_1 ... slip_4 beside them.

    ``slip_j``, m/s^2, is what the age of A_j's chip makes of the jerk that the back feels. ``wrong``: ages of so many samples
    before, as a counter-check.
    """
    force, rate, saturated = read(PACKETS)
    age = np.roll(ages(len(force)), wrong, axis=0)
    omega = at_one_instant(rate, age).mean(axis=1)
    a, alpha, jerk = of_back(force, omega, age)
    plain = motion(force, rate, saturated)
    slips = -np.stack([age[:, 2 * corner] for corner, _ in PLACES]) * (tangents() @ jerk.T)
    made = {"a": a, "omega": omega, "omegadot": alpha}
    channels = {f"{n}_{k}": x[:, i] for n, x in made.items() for i, k in enumerate("xyz")}
    channels |= {} if outputs else {f"slip_{j + 1}": x for j, x in enumerate(slips)}
    for x in channels.values():
        x[saturated] = np.nan
    V = {n: v - outputs * x / G0 for (n, v), x in zip(plain.outputs.items(), slips, strict=True)}
    path = folder / f"synchronous-{int(outputs)}-{wrong}.parquet"
    write_flight(
        Flight(time=plain.time, channels=dict(plain.channels) | channels, outputs=V, name="motion"), path
    )
    return path
