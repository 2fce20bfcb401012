"""The outputs of a gradiometer from its motion, with NumPy alone: python ragg_model.py < MOTION.csv > OUT.csv

MOTION.csv has a header, one `name [unit]` per column, in the SI units of model.json. Gradients that are not there are zero;
omegadot, where it is not there, is derived from omega; without an encoder's column (spin_angle) the angle of a disc is
2 pi spin_frequency t, from t = 0 or from the first row, as model.json's "angle_origin" says.
"""

import csv
import itertools
import json
import sys
from pathlib import Path

import chain
import numpy as np

MODEL = json.loads((Path(__file__).parent / "model.json").read_text("utf-8"))
SLOPES = json.loads((Path(__file__).parent / "derivative.json").read_text("utf-8"))
SHORT, LONG, SPIN = np.array(SLOPES["short"]), np.array(SLOPES["long"]), SLOPES["spin"]
DEGREES = SPIN["degrees"]
PARAMETERS = np.concatenate([q["values"] for q in MODEL["parameters"]])
OMEGADOT = [f"omegadot_{axis}" for axis in "xyz"]


def outputs(columns):
    """Name -> (N,), V, of columns (name -> (N,)) in SI units, evenly spaced in time."""
    columns = {n: np.asarray(x, dtype=float) for n, x in columns.items()}
    t = columns["time"] - columns["time"][0]
    missing = [n for n in OMEGADOT if n not in columns]
    if len(missing) in (1, 2):
        raise SystemExit(
            f"ragg_model: the column {missing[0]} is missing; expected all of {', '.join(OMEGADOT)}, or none"
        )
    if missing:
        columns |= {
            n: acceleration(columns[f"omega{n[8:]}"], t) for n in OMEGADOT if f"omega{n[8:]}" in columns
        }
    return {o["name"]: voltage(o, columns, t) for o in MODEL["outputs"]}


def output(columns, name=None):
    """One output, by default the first, (N,), V."""
    return outputs(columns)[name or MODEL["outputs"][0]["name"]]


def voltage(o, columns, t):
    """An output (N,), V, by its entry of MODEL["outputs"]."""
    encoder = columns.get(o["spin_angle"])
    series = np.array([read_input(x, o, encoder, columns, t) for x in MODEL["inputs"]])
    phi = encoder
    if encoder is None:
        start = 0.0 if MODEL["angle_origin"] == "first-sample" else columns["time"][0]
        phi = disc_angle(t, o["spin_frequency"]) + disc_angle(start, o["spin_frequency"])
    c, s, added, taken = np.cos(phi), np.sin(phi), np.zeros(len(t)), np.zeros(len(t))
    for j, sign in zip(o["accelerometers"], o["signs"]):
        into = added if sign > 0 else taken
        into += chain.accelerometer(j, t, c, s, series, chain.values_of(j, PARAMETERS))
    return added - taken


def read_input(x, o, encoder, columns, t):
    """One series (N,) that the model reads: an entry of MODEL["inputs"], for an output."""
    if x["column"] == "disc":
        if encoder is not None:
            return spin(encoder, x["derivative"], t)
        return np.full(len(t), 2 * np.pi * o["spin_frequency"] if x["derivative"] == 1 else 0.0)
    name = x["column"]
    if name not in columns and not name.startswith("Gamma_"):
        raise SystemExit(f"ragg_model: the column {name} is missing; expected in {x['unit']}")
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
        raise SystemExit(f"ragg_model: too few rows to differentiate; expected at least {2 * half + 1}")
    y = x - x[0]
    slope = np.empty(len(y))
    slope[half : len(y) - half] = np.convolve(y, SHORT[half][::-1], mode="valid")
    for k in range(half):
        slope[k] = SHORT[k] @ y[: 2 * half + 1]
        slope[len(y) - 1 - k] = -(SHORT[k] @ y[: -2 * half - 2 : -1])
    return slope * rate_of(t)


def acceleration(omega, t):
    """Angular acceleration of a rate: amid the record by a longer window, good to 90 % of the Nyquist frequency."""
    slope, reach = differentiate(omega, t), len(LONG) // 2
    if len(omega) > 2 * reach:
        slope[reach : len(omega) - reach] = weighed(LONG, -1, omega - omega[0]) * rate_of(t)
    return slope


def spin(angle, order, t):
    """Rate (order 1) or acceleration (2) of an encoder's angle, by polynomials through the samples around each."""
    rate = rate_of(t)
    half = min(max(round(SPIN["seconds"] * rate), DEGREES[0]), SPIN["most"], (len(t) - 1) // 2)
    if 2 * half < DEGREES[0]:
        raise SystemExit("ragg_model: too few rows for the rate of a disc")
    steps = np.diff(angle)
    steps -= 2 * np.pi * np.rint(steps / (2 * np.pi))
    steady, window = np.cumsum(steps)[-1] / len(steps), 2 * half + 1
    x = np.concatenate([[0.0], np.cumsum(steps - steady)])
    degree, found = best_degree(x, half), np.empty(len(x))
    middle = polynomial_weights(half, 0, order, degree)
    found[half : len(x) - half] = (
        weighed(middle, -1, x) if order == 1 else weighed(without_mean(middle), 1, x)
    )
    for k in range(half):
        found[k] = np.cumsum(polynomial_weights(half, k - half, order, degree) * x[:window])[-1]
        found[len(x) - 1 - k] = np.cumsum(polynomial_weights(half, half - k, order, degree) * x[-window:])[-1]
    return (found + steady) * rate if order == 1 else found * (rate * rate)


def best_degree(x, half):
    """The degree with the least expected error of the second derivative: ragg_runtime/signals/derivative.py says why."""
    degrees = [d for d in DEGREES if d < 2 * half]
    if len(x) < 2 * (2 * half + 1) or len(degrees) < 2:
        return DEGREES[0]
    curvatures = [without_mean(polynomial_weights(half, 0, 2, d)) for d in degrees]
    left = without_mean(-polynomial_weights(half, 0, 0, degrees[-1]))
    kernels = [*(b - a for a, b in itertools.pairwise(curvatures)), left]
    gains = np.array([w @ w for w in kernels])
    squares = np.array([np.sum(weighed(w, 1, x) ** 2) for w in kernels])
    noise = np.maximum.accumulate((squares / gains)[::-1])[::-1]
    grows = 2 * noise[1:] * gains[:-1] - squares[:-1]
    return degrees[int(np.argmin(np.cumsum([0.0, *grows])))]


def without_mean(weights):
    """The same even weights with a middle one that makes their sum zero."""
    found, half = weights.copy(), len(weights) // 2
    found[half] = -2.0 * np.cumsum(found[:half])[-1]
    return found


def weighed(weights, sign, x):
    """A moving sum (N - 2 half,) with odd (sign -1) or even (1) weights; pairs are joined first."""
    half, n = len(weights) // 2, len(x)
    total = x[half : n - half] * weights[half]
    for k in range(half, 0, -1):
        total += (x[half - k : n - half - k] + sign * x[half + k : n - half + k]) * weights[half - k]
    return total


def polynomial_weights(half, at, order, degree):
    """Weights of 2 half + 1 samples for the derivative at one, counted from the middle (Gorry, Anal. Chem. 62 (1990) 570)."""
    everywhere, there = (
        gram(half, np.arange(-half, half + 1.0), degree),
        gram(half, np.array([float(at)]), degree),
    )
    total, below, above = 0.0, 1.0, 2.0 * half + 1.0
    for k in range(degree + 1):
        total = total + (2 * k + 1) * below / above * everywhere[k][0] * there[k][order]
        below *= 2 * half - k
        above = float(np.cumprod([2.0 * half + k + 2 - i for i in range(k + 2)])[-1])
    return total


def gram(half, t, degree):
    """Gram polynomials at t, and their first two derivatives: [degree][order]."""
    zero = np.zeros(len(t))
    found = [[zero + 1.0, zero, zero]]
    for k in range(1, degree + 1):
        whole = k * (2.0 * half - k + 1)
        a, b = (4 * k - 2) / whole, (k - 1) * (2.0 * half + k) / whole
        one, two = found[-1], found[-2] if k > 1 else [zero] * 3
        slopes = [zero, one[0], 2.0 * one[1]]
        found.append([a * (t * one[s] + slopes[s]) - b * two[s] for s in range(3)])
    return found


def disc_angle(t, f):
    """2 pi frac(f t), with the rounding error of the product kept (Dekker)."""
    turns, p, q = f * t, 134217729.0 * f, 134217729.0 * t
    f1, t1 = p - (p - f), q - (q - t)
    f2, t2 = f - f1, t - t1
    return 2 * np.pi * ((turns - np.rint(turns)) + (((f1 * t1 - turns) + f1 * t2 + f2 * t1) + f2 * t2))


def read(lines):
    """Columns of a CSV with a header of `name [unit]`; SystemExit at what is none, or in other units than model.json's."""
    rows = csv.reader(line for line in lines if line.strip() and not line.startswith("#"))
    units = {x["column"]: x["unit"] for x in MODEL["inputs"]} | {"time": "s"}
    units |= {o["spin_angle"]: "rad" for o in MODEL["outputs"]}
    header = [name.strip().rstrip("]").split("[") for name in next(rows, ())]
    if "time" not in (name[0].strip() for name in header):
        raise SystemExit("ragg_model: the column time is missing; use: ragg_model.py < MOTION.csv > OUT.csv")
    for name, *unit in header:
        wanted = units.get(name.strip())
        if wanted is not None and (not unit or unit[0].strip() != wanted):
            raise SystemExit(f"ragg_model: the column {name.strip()} is not in SI units; expected {wanted}")
    try:
        values = np.array([[float(x) if x.strip() else np.nan for x in row] for row in rows])
    except ValueError:
        raise SystemExit("ragg_model: expected a number in every cell, and as many in every row") from None
    if values.ndim != 2 or len(values) < 2 or values.shape[1] != len(header):
        raise SystemExit("ragg_model: expected two rows or more, each with as many cells as the header")
    return {name[0].strip(): values[:, k] for k, name in enumerate(header)}


if __name__ == "__main__":
    motion = read(sys.stdin)
    found = outputs(motion)
    print(",".join(["time", *found]))
    for row in zip(motion["time"], *found.values()):
        print(",".join(f"{x:.17g}" for x in row))
