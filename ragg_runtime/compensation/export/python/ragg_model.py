"""The outputs of a gradiometer from its motion, with NumPy alone: python ragg_model.py < MOTION.csv > OUT.csv

MOTION.csv has a header, one `name [unit]` per column, in the SI units of model.json. Gradients that are not there are zero;
omegadot, where it is not there, is derived from omega; without an encoder's column (spin_angle) the angle of a disc is
2 pi spin_frequency t, from t = 0 or from the first row, by "angle_origin" of model.json.
"""

import json
import sys
from pathlib import Path

import chain
import numpy as np

MODEL = json.loads((Path(__file__).parent / "model.json").read_text("utf-8"))
SLOPES = json.loads((Path(__file__).parent / "derivative.json").read_text("utf-8"))
SHORT, LONG = np.array(SLOPES["short"]), np.array(SLOPES["long"])
PARAMETERS = np.concatenate([q["values"] for q in MODEL["parameters"]])
OMEGADOT = [f"omegadot_{axis}" for axis in "xyz"]


def outputs(columns):
    """Name -> (N,), V, of columns (name -> (N,)) in SI units, evenly spaced in time."""
    columns = {n: np.asarray(x, dtype=float) for n, x in columns.items()}
    t = columns["time"] - columns["time"][0]
    missing = [n for n in OMEGADOT if n not in columns]
    if len(missing) in (1, 2):
        fail(f"the column {missing[0]} is missing; expected all of {', '.join(OMEGADOT)}, or none")
    if missing and "omega_x" in columns:
        columns |= {n: acceleration(columns[f"omega{n[8:]}"], t) for n in OMEGADOT}
    return {o["name"]: voltage(o, columns, t) for o in MODEL["outputs"]}


def voltage(o, columns, t):
    """An output (N,), V, by its entry of MODEL["outputs"]."""
    phi = encoder = columns.get(o["spin_angle"])
    series = np.array([read_input(x, o, encoder, columns, t) for x in MODEL["inputs"]])
    if encoder is None:
        start = 0.0 if MODEL["angle_origin"] == "first-sample" else columns["time"][0]
        phi = disc_angle(t, o["spin_frequency"]) + disc_angle(start, o["spin_frequency"])
    added, subtracted = np.zeros(len(t)), np.zeros(len(t))
    for j, sign in zip(o["accelerometers"], o["signs"]):
        into = added if sign > 0 else subtracted
        into += chain.accelerometer(j, t, np.cos(phi), np.sin(phi), series, chain.values_of(j, PARAMETERS))
    return added - subtracted


def read_input(x, o, encoder, columns, t):
    """One series (N,) that the model reads: an entry of MODEL["inputs"], for an output."""
    if x["column"] == "disc":
        if encoder is not None:
            fail(f"the rate of the disc is not derived from {o['spin_angle']} here; use the C program")
        return np.full(len(t), 2 * np.pi * o["spin_frequency"] if x["derivative"] == 1 else 0.0)
    name = x["column"]
    if name not in columns and not name.startswith("Gamma_"):
        fail(f"the column {name} is missing; expected in {x['unit']}")
    value = columns.get(name, np.zeros(len(t)))
    for _ in range(x["derivative"]):
        value = differentiate(value, t)
    return value


def rate_of(t):
    """Hz."""
    return (len(t) - 1) / (t[-1] - t[0])


def differentiate(x, t):
    """Time derivative of an evenly sampled series of at least as many samples as a window has."""
    half = len(SHORT) - 1
    if len(x) < 2 * half + 1:
        fail(f"too few rows to differentiate; expected at least {2 * half + 1}")
    y, slope = x - x[0], np.empty(len(x))
    slope[half : len(y) - half] = np.correlate(y, SHORT[half], "valid")
    for k in range(half):
        slope[k] = SHORT[k] @ y[: 2 * half + 1]
        slope[len(y) - 1 - k] = -(SHORT[k] @ y[: -2 * half - 2 : -1])
    return slope * rate_of(t)


def acceleration(omega, t):
    """Angular acceleration of a rate: amid the record by a longer window, good to 90 % of the Nyquist frequency."""
    slope, reach = differentiate(omega, t), len(LONG) // 2
    if len(omega) > 2 * reach:
        slope[reach : len(omega) - reach] = np.correlate(omega - omega[0], LONG, "valid") * rate_of(t)
    return slope


def disc_angle(t, f):
    """2 pi frac(f t), with the rounding error of the product kept (Dekker)."""
    turns, p, q = f * t, 134217729.0 * f, 134217729.0 * t
    f1, t1 = p - (p - f), q - (q - t)
    f2, t2 = f - f1, t - t1
    return 2 * np.pi * ((turns - np.rint(turns)) + (((f1 * t1 - turns) + f1 * t2 + f2 * t1) + f2 * t2))


def read(file):
    """Columns of a CSV with a header of `name [unit]`; SystemExit at what is none, or in other units than model.json's."""
    lines = [line for line in file if line.strip() and not line.startswith("#")] or [""]
    units = {x["column"]: x["unit"] for x in MODEL["inputs"]} | {"time": "s"}
    units |= {o["spin_angle"]: "rad" for o in MODEL["outputs"]}
    header = [[x.strip(' "]\r\n') for x in name.split("[")] for name in lines[0].split(",")]
    if "time" not in (name[0] for name in header):
        fail("the column time is missing; use: ragg_model.py < MOTION.csv > OUT.csv")
    for name, *unit in header:
        if name in units and unit != [units[name]]:
            fail(f"the column {name} is not in SI units; expected {units[name]}")
    try:
        values = np.array([[float(x.strip() or "nan") for x in line.split(",")] for line in lines[1:]])
    except ValueError:
        fail("expected a number in every cell, and as many in every row")
    if len(values) < 2 or values.shape[1:] != (len(header),):
        fail("expected two rows or more, each with as many cells as the header")
    return {name[0]: without_codes(values[:, k], name[0]) for k, name in enumerate(header)}


def without_codes(x, name):
    """A column with NaN in the place of numbers that stand for a missing value."""
    codes = [*MODEL["missing"].get(name, []), *(MODEL["missing"][""] if name != "time" else [])]
    missing = [np.isclose(x, code, rtol=1e-6, atol=0.0) for code in codes] + [np.abs(x) >= 1e20]
    return np.where(np.any(missing, axis=0), np.nan, x)


def fail(message):
    """End at what cannot be done."""
    raise SystemExit(f"ragg_model: {message}")


if __name__ == "__main__":
    motion = read(sys.stdin)
    result = outputs(motion)
    print(",".join(["time", *result]))
    for row in zip(motion["time"], *result.values()):
        print(",".join(f"{x:.17g}" for x in row))
