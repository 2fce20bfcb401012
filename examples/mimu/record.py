"""From the raw packets of the array to two flights: its rests, and its motion.

    python -m examples.mimu.record RAW.bin.gz FOLDER

RAW is a recording of H. Carlsson, I. Skog and J. Jalden (see LICENSE.mimu-array here). The four sensors of the front, at
the corners of a square, are the gradiometer: their axes along the tangents of the circle through them. Specific force is the
mean of the four of the back, angular rate that of all eight. Angular acceleration is what the four of the back feel beside
each other: no output of the gradiometer enters it, nor a derivative of what is sampled too slowly for one. At each corner front
and back may change places (``picked``): sixteen gradiometers on one board. ``sheet`` is its model.toml: what a data sheet and a ruler
say, and how sure they are.
"""

from __future__ import annotations

import gzip
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

from ragg_runtime.io import Flight, write_flight

Array = NDArray[np.float64]
Raw = tuple[Array, Array, NDArray[np.bool_]]
"""Specific force (N, 8, 3) m/s^2, angular rate (N, 8, 3) rad/s, by the axes of the board, and what is saturated (N,)."""

RATE = 62.5  # Hz
G0, PER_G, PER_DEGREE = 9.81, 2048.0, 16.4
"""m/s^2; counts per g and per deg/s, as the data sheet of the chip gives them for its ranges of 16 g and 2000 deg/s."""

HALF = 0.00945  # half the side of the square, m
THICK = 1e-3  # half the distance of the two sides of the board, m
CORNERS = ((-1, 1), (-1, -1), (1, 1), (1, -1))  # of sensors 1, 3, 5, 7 (front) and 2, 4, 6, 8 (back)
RADIUS = 13.364  # mm: of the circle through them
PLACES = ((2, 45, 1), (1, 225, 1), (0, 135, -1), (3, 315, -1))  # corner, angle, deg, and sign of A1 ... A4.
FRONT = tuple(2 * corner for corner, *_ in PLACES)  # sensors, counted from 0, that are A1 ... A4.
FULL_SCALE = 32760  # counts from which a sensor is saturated
REST = 0.05  # rad/s below which the array rests
BLOCK = 64  # samples of a rest that are averaged to one
MOTION_FROM = 30.0  # rad/s that the array must reach before it counts as thrown about
LENGTH = 45.0  # length of the second record, which begins there, s: as small as serves


def packets(raw: bytes) -> NDArray[np.int16]:
    """(N, 8, 2, 3) counts: sensor, accelerometer or gyroscope, axis; broken packets are left out."""
    at, counts = 0, []
    while at + 106 <= len(raw):
        end = at + 6 + raw[at + 3]
        complete = raw[at] == 0xAA and raw[at + 3] == 100
        if complete and sum(raw[at : end - 2]) & 0xFFFF == int.from_bytes(raw[end - 2 : end], "big"):
            counts.append(np.frombuffer(raw[at + 8 : at + 104], ">i2").reshape(8, 2, 3).astype(np.int16))
            at = end
        else:
            at += 1
    return np.array(counts)


@cache
def read(path: Path) -> Raw:
    """A recording."""
    counts = packets(gzip.decompress(path.read_bytes()))
    saturated = np.any(np.abs(counts.astype(int)) >= FULL_SCALE, axis=(1, 2, 3))
    force = counts[:, :, 0] * (G0 / PER_G)
    rate = counts[:, :, 1] * (np.pi / 180 / PER_DEGREE)
    for x in (force, rate):
        x[:, 1::2] = -x[:, 1::2][:, :, [1, 0, 2]]  # those of the back are turned over
    return force, rate, saturated


def places() -> Array:
    """(8, 3) m: where the sensors are, from the middle of the board."""
    return np.array([(HALF * x, HALF * y, z) for x, y in CORNERS for z in (THICK, -THICK)])


def others(picked: Sequence[int] = FRONT) -> list[int]:
    """The sensors that feel the motion: those that are not picked."""
    return [k for k in range(8) if k not in picked]


def lifts(picked: Sequence[int] = FRONT) -> Array:
    """(4,) m: how far each of those picked is above the middle of the others."""
    r = places()
    return np.asarray(r[list(picked), 2] - r[others(picked), 2].mean())


def angular_acceleration(force: Array, omega: Array, picked: Sequence[int] = FRONT) -> Array:
    """(N, 3) rad/s^2 from the four others, by least squares: what they feel beside each other, less omega x (omega x r)."""
    felt = others(picked)
    r = places()[felt] - places()[felt].mean(axis=0)
    lever = np.concatenate([np.cross(np.eye(3), x).T for x in r])  # alpha x r
    solution = np.linalg.pinv(np.hstack([np.tile(np.eye(3), (4, 1)), lever]))
    felt_force = force[:, felt] - np.cross(omega[:, None], np.cross(omega[:, None], r))
    return np.asarray(felt_force.reshape(len(force), 12) @ solution[3:].T)


def columns(
    force: Array, rate: Array, picked: Sequence[int] = FRONT
) -> tuple[dict[str, Array], dict[str, Array]]:
    """Channels and outputs of a flight."""
    a, omega = force[:, others(picked)].mean(axis=1), rate.mean(axis=1)
    channels = {f"a_{k}": a[:, i] for i, k in enumerate("xyz")}
    channels |= {f"omega_{k}": omega[:, i] for i, k in enumerate("xyz")}
    alpha = angular_acceleration(force, omega, picked)
    channels |= {f"omegadot_{k}": alpha[:, i] for i, k in enumerate("xyz")}
    # The gradient of the Earth's field, 3e-6 s^-2, is nothing beside (2000 deg/s)^2 = 1e3 s^-2: known to be none.
    channels |= {f"Gamma_{k}": np.zeros(len(a)) for k in ("xx", "xy", "xz", "yy", "yz", "zz")}
    outputs = {}
    for j, (sensor, (_, degrees, _)) in enumerate(zip(picked, PLACES, strict=True)):
        angle = np.deg2rad(degrees)
        tangent = np.array([-np.sin(angle), np.cos(angle), 0.0])
        outputs[f"V_{j + 1}"] = force[:, sensor] @ tangent / G0  # 1 V per g
    return channels, outputs


def rests(force: Array, rate: Array, quiet: NDArray[np.bool_], picked: Sequence[int] = FRONT) -> Flight:
    """What the array felt while it lay still, averaged over :data:`BLOCK` samples."""
    n = len(force) // BLOCK
    at_rest = quiet[: n * BLOCK].reshape(n, BLOCK).all(axis=1)
    blocks = [x[: n * BLOCK].reshape(n, BLOCK, 8, 3) for x in (force, rate)]
    channels, outputs = columns(*(x.mean(axis=1) for x in blocks), picked)
    # The mean angular acceleration of a block is the change of the rate over it.
    omega, quarter = blocks[1].mean(axis=2), BLOCK // 4
    change = omega[:, -quarter:].mean(axis=1) - omega[:, :quarter].mean(axis=1)
    slope = change / ((BLOCK - quarter) / RATE)
    channels |= {f"omegadot_{k}": slope[:, i] for i, k in enumerate("xyz")}
    time = np.arange(n) * (BLOCK / RATE)
    return Flight(time=time, channels=channels, outputs=outputs, name="rests", valid=at_rest)


def motion(force: Array, rate: Array, saturated: NDArray[np.bool_], picked: Sequence[int] = FRONT) -> Flight:
    """The array thrown about, sample by sample; without what is saturated."""
    channels, outputs = columns(force, rate, picked)
    for name, x in (channels | outputs).items():
        if not name.startswith("Gamma"):
            x[saturated] = np.nan
    return Flight(time=np.arange(len(force)) / RATE, channels=channels, outputs=outputs, name="motion")


def parts(rate: Array) -> tuple[NDArray[np.bool_], int]:
    """(N,) where the array rests, and the sample from which it is thrown about; ``rate`` (N, 8, 3) rad/s."""
    size = np.linalg.norm(rate.mean(axis=1), axis=1)
    return ~binary_dilation(size > REST, np.ones(BLOCK)), int(np.argmax(size > MOTION_FROM))


def sheet(
    height: str | Sequence[str] = "2 mm",
    radius: str = f"{RADIUS} mm",
    lift: str = "5",
    arm: str = "0.5",
    turn: str = "3",
) -> str:
    """The model.toml; ``lift`` deg, ``arm`` mm and ``turn`` deg say how sure it is of beta_x, dR and the other angles; a ``height`` for
    each or all.
    """
    heights = (height,) * len(PLACES) if isinstance(height, str) else height
    text = f"""\
# Four of eight MEMS accelerometers on a board, along the tangents of the circle through them: a gradiometer
# that stands still. The measurement frame's origin is amidst the four on the back, 2 mm below.
effects = []
g0 = "9.81 m/s^2"

[model]
kinematics = "full"

[[disc]]
name = "A"
radius = "{radius}"
spin_frequency = "0 Hz"
"""
    for j, ((_, angle, sign), above) in enumerate(zip(PLACES, heights, strict=True), 1):
        text += f"""\
[[disc.accelerometer]]
name = "A{j}"
angle = "{angle} deg"
height = "{above}"
sign = {sign}
output = "G_out"
"""
    sigmas = {"dR": (0, arm, "mm"), "beta_x": (0, lift, "deg")}
    sigmas |= dict.fromkeys(("beta_z", "vartheta_x", "vartheta_y", "vartheta_z"), (0, turn, "deg"))
    sigmas |= {"K0": (0, 60, "mg"), "K1": (1, 0.03, "A/g")}
    sigmas |= {f"K{n}": (0, 2, "mg/g^2") for n in (2, 4, 5, 6, 7, 8)}
    lines = [f'{n} = {{ value = {v}, sigma = {s}, unit = "{u}" }}' for n, (v, s, u) in sigmas.items()]
    return "\n".join([f"{text}\n[accelerometers]", *lines, 'k_VI = { value = 1, unit = "ohm" }\n'])


def main(raw: str, folder: str) -> None:
    force, rate, saturated = read(Path(raw))
    quiet, start = parts(rate)
    end = start + round(LENGTH * RATE)
    target = Path(folder)
    write_flight(rests(force[:start], rate[:start], quiet[:start]), target / "rests.parquet")
    moving = [x[start:end] for x in (force, rate, saturated)]
    write_flight(motion(*moving), target / "motion.parquet")


if __name__ == "__main__":
    main(*sys.argv[1:])
