"""The output of a gradiometer from its motion, with NumPy alone: python ragg_model.py < MOTION.csv > OUT.csv

MOTION.csv has a header, one `name [unit]` a column, in the SI units of model.json. Where omegadot is not there it is the
derivative of omega; gradients that are not there are zero; without spin_angle the disc angle is 2 pi spin_frequency t
from the first row on.
"""

import csv
import json
import sys
from pathlib import Path

import chain
import numpy as np

MODEL = json.loads((Path(__file__).parent / "model.json").read_text("utf-8"))
WEIGHTS = np.array(json.loads((Path(__file__).parent / "derivative.json").read_text("utf-8")))
PARAMETERS = np.concatenate([q["values"] for q in MODEL["parameters"]])


def output(columns):
    """G_out (N,), V, of columns (name -> (N,)) in SI units, evenly spaced in time."""
    time = np.asarray(columns["time"], dtype=float)
    t = time - time[0]
    columns = dict(columns)
    for axis in "xyz":
        if f"omegadot_{axis}" not in columns and any(
            x["column"] == f"omegadot_{axis}" for x in MODEL["inputs"]
        ):
            columns[f"omegadot_{axis}"] = differentiate(columns[f"omega_{axis}"], t)
    series = []
    for x in MODEL["inputs"]:
        name = x["column"]
        if name not in columns and not name.startswith("Gamma_"):
            raise SystemExit(f"ragg_model: the column {name} is missing; expected in {x['unit']}")
        value = np.asarray(columns.get(name, np.zeros(len(t))), dtype=float)
        for _ in range(x["derivative"]):
            value = differentiate(value, t)
        series.append(value)
    phi = columns.get("spin_angle", 2 * np.pi * np.mod(PARAMETERS[1] * t, 1.0))
    v = [
        chain.accelerometer(j, t, np.cos(phi), np.sin(phi), np.array(series), chain.values_of(j, PARAMETERS))
        for j in range(4)
    ]
    return (v[0] + v[1]) - (v[2] + v[3])


def differentiate(x, t):
    """Time derivative of an evenly sampled series of at least as many samples as a window has."""
    half = len(WEIGHTS) - 1
    if len(x) < 2 * half + 1:
        raise SystemExit(f"ragg_model: too few rows to differentiate; expected at least {2 * half + 1}")
    y = np.asarray(x, dtype=float) - x[0]
    slope = np.empty(len(y))
    slope[half : len(y) - half] = np.convolve(y, WEIGHTS[half][::-1], mode="valid")
    for k in range(half):
        slope[k] = WEIGHTS[k] @ y[: 2 * half + 1]
        slope[len(y) - 1 - k] = -(WEIGHTS[k] @ y[: -2 * half - 2 : -1])
    return slope * ((len(t) - 1) / (t[-1] - t[0]))


def read(lines):
    """Columns of a CSV with a header of `name [unit]`; SystemExit at a unit that is not the one in model.json."""
    rows = csv.reader(line for line in lines if line.strip() and not line.startswith("#"))
    units = {x["column"]: x["unit"] for x in MODEL["inputs"]} | {"time": "s", "spin_angle": "rad"}
    header = [name.strip().rstrip("]").split("[") for name in next(rows)]
    for name, *unit in header:
        wanted = units.get(name.strip())
        if wanted is not None and (not unit or unit[0].strip() != wanted):
            raise SystemExit(f"ragg_model: the column {name.strip()} is not in SI units; expected {wanted}")
    values = np.array([[float(x) if x.strip() else np.nan for x in row] for row in rows])
    return {name[0].strip(): values[:, k] for k, name in enumerate(header)}


if __name__ == "__main__":
    motion = read(sys.stdin)
    print("time,G_out")
    for time, G in zip(motion["time"], output(motion)):
        print(f"{time:.17g},{G:.17g}")
