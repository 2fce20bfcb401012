"""A gravimeter in an aircraft as an instrument of one accelerometer: the Eotvos effect, left out and found.

    python -m examples.kauring GRAV.DAT

GRAV.DAT are the lines over Kauring (2012) in the sdist of galileoqc (folder docs/source/tutorials/Kauring_grv); its licence keeps
them out of this project. The gravimeter's specific force FZ is the output; the motion is what navigation says of it, the vertical
acceleration and normal gravity at height. Who forgets that the Earth turns lacks -2 omega_e cos(latitude) v_E.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.diagnosis.diagnose import diagnose
from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.fit.fitted import fit
from ragg_runtime.fit.observation import observations_of
from ragg_runtime.flight import Flight, read_flight, write_flight
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model_dir import derive

Array = NDArray[np.float64]

G0 = 9.8
MGAL = 1e-5
"""m/s^2."""

EARTH_RATE, EARTH_RADIUS = 7.292115e-5, 6.371e6
"""rad/s, m."""

COLUMNS = {
    "east": 0,
    "north": 1,
    "line": 2,
    "flight": 3,
    "second": 5,
    "latitude": 10,
    "FZ": 17,
    "AZ": 18,
    "LATCOR": 20,
    "FACOR": 22,
}
"""Places in GRAV.DAT by GRAV.DFN; latitude stands where that says longitude."""

BLOCK = 10.0
"""s that are averaged to a sample: what is faster the gravimeter and the navigation filter each in its own way."""

FEWEST = 200
"""Samples that a flight must have."""

SHEET = """effects = []
g0 = "9.8 m/s^2"
[model]
kinematics = "full"
[[disc]]
name = "gravimeter"
radius = "1 mm"
spin_frequency = "0 Hz"
[[disc.accelerometer]]
name = "Z"
angle = "0 deg"
sign = 1
output = "G_out"
direction = [0, 0, 1]
[accelerometers]
K0 = { value = 0, sigma = 1, unit = "mg" }
K1 = { value = 1, sigma = 1e-4, unit = "A/g" }
k_VI = { value = 1, unit = "ohm" }
"""

EOTVOS = (
    'effects = [{ id = "eotvos", stage = "transducer", add = "k * v_E", params = { k = { unit = "1/s" } } }]'
)
"""As an effect of one's own; v_E holds the cosine of the latitude."""


@dataclass(frozen=True)
class Found:
    """What the diagnosis says, and the coefficient of the effect with its uncertainty, in -2 omega_e."""

    diagnosis: Diagnosis
    ratio: float
    std: float


def blocks(line: dict[str, Array]) -> Array:
    """(n, 4): time s, vertical specific force by navigation m/s^2, output V, v_E cos(latitude) m/s, of whole blocks of a line."""
    t = line["second"]
    v_east, v_north = np.gradient(line["east"], t), np.gradient(line["north"], t)
    motion = (line["AZ"] + line["LATCOR"] - line["FACOR"]) * MGAL - (v_east**2 + v_north**2) / EARTH_RADIUS
    series = np.stack([motion, line["FZ"] * MGAL / G0, v_east * np.cos(np.deg2rad(line["latitude"]))])
    which = np.floor(t / BLOCK)
    numbers, counts = np.unique(which, return_counts=True)
    whole = numbers[counts == np.max(counts)]
    return np.array([[b * BLOCK, *series[:, which == b].mean(axis=1)] for b in whole])


def flights(path: Path, folder: Path, i: Instrument) -> list[Flight]:
    """The flights of the survey, each with its lines one after the other and gaps between them."""
    raw = np.loadtxt(path, usecols=list(COLUMNS.values()))
    data = dict(zip(COLUMNS, raw.T, strict=True))
    found = []
    for number in np.unique(data["flight"]):
        own = {n: x[data["flight"] == number] for n, x in data.items()}
        lines = [{n: x[own["line"] == k] for n, x in own.items()} for k in np.unique(own["line"])]
        B = np.concatenate([blocks(x) for x in lines])
        B = B[np.argsort(B[:, 0])]
        if len(B) < FEWEST or np.any(np.diff(B[:, 0]) == 0.0):
            continue
        names = ("a_x", "a_y", "omega_x", "omega_y", "omega_z", "omegadot_x", "omegadot_y", "omegadot_z")
        names += tuple(f"Gamma_{k}" for k in ("xx", "xy", "xz", "yy", "yz", "zz"))
        channels = dict.fromkeys(names, np.zeros(len(B))) | {"a_z": B[:, 1], "v_E": B[:, 3]}
        file = folder / f"flight-{number:.0f}.parquet"
        write_flight(
            Flight(time=B[:, 0] - B[0, 0], channels=channels, outputs={"G_out": B[:, 2]}, name=file.stem),
            file,
        )
        found.append(read_flight(file, i.g0, accelerometers=i.layout))
    return found


def eotvos(path: Path) -> Found:
    """Diagnose the survey without the effect, then fit it."""
    plain, own = parse_instrument(SHEET), parse_instrument(SHEET.replace("effects = []", EOTVOS))
    with tempfile.TemporaryDirectory() as folder:
        every = flights(path, Path(folder), plain)
        d = diagnose(derive.model_of(plain), plain, every, partial(derive.with_effects, plain))
        c = fit(derive.without_signatures(own, own.form), own, observations_of(every, own)).calibration
    (n,) = (n for n, q in enumerate(c.columns) if q.effect == "eotvos")
    unit = -2 * EARTH_RATE
    return Found(
        d, float(c.p[c.index[n]]) / unit, float(np.sqrt(c.covariance[n, n])) * c.columns[n].scale / abs(unit)
    )


def main(path: str) -> None:
    found = eotvos(Path(path))
    terms = ", ".join(
        f"{x['term']} ({x['coefficient']:.3g} {x['unit']})" for x in found.diagnosis.terms()[:3]
    )
    print(f"verdict without it: {found.diagnosis.verdict}; left over: {terms}")
    print(f"its coefficient, over -2 omega_e: {found.ratio:.4f} ± {found.std:.4f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
