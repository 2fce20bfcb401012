"""Instruments and motions at random, of the sizes of Tables V and VI of the paper."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from derive.symbols import ACCELEROMETER, MOTION

Array = NDArray[np.float64]

G0 = 9.8
EOTVOS = 1e-9
_ARCSEC = np.pi / 648000
_PER_G = 1e-6 / G0
_DEGREE_PER_HOUR = np.pi / 648000

# The largest entry of every row of Table V (vartheta_x, which it leaves out, as the others).
_LARGEST = {
    "dR": 35e-6, "beta_x": 21 * _ARCSEC, "beta_z": 20 * _ARCSEC,
    "vartheta_x": 30 * _ARCSEC, "vartheta_y": 21 * _ARCSEC, "vartheta_z": 30 * _ARCSEC,
    "K0": 10e-6 * G0, "K2": 8 * _PER_G, "K4": 16 * _PER_G, "K5": 13 * _PER_G,
    "K6": 12 * _PER_G, "K7": 17 * _PER_G, "K8": 20 * _PER_G,
}  # fmt: skip


def instrument(draw: np.random.Generator) -> Array:
    """(62,), in the order of PARAMETERS: R = 0.1 m, 0.25 Hz, scale factors of 10 to 12 mA/g."""
    p = [0.1, 0.25]
    for q in ACCELEROMETER:
        if q.name == "K1":
            p += list(draw.uniform(10e-3, 12e-3, 4) / G0)
        elif q.name == "k_VI":
            p += [1e9] * 4
        else:
            p += list(draw.uniform(-1, 1, 4) * _LARGEST[q.name])
    return np.array(p)


def motion(draw: np.random.Generator, n: int) -> Array:
    """(15, n): specific force, angular rate and acceleration of Table VI, gradients of 1000 Eo."""
    spin = 2 * np.pi * 0.25
    largest = {
        "a_x": 0.085 * G0, "a_y": 0.066 * G0, "a_z": 0.15 * G0,
        "omega_x": 1700 * _DEGREE_PER_HOUR, "omega_y": 2400 * _DEGREE_PER_HOUR, "omega_z": 2800 * _DEGREE_PER_HOUR,
        "omegadot_x": 700 * _DEGREE_PER_HOUR * spin, "omegadot_y": 900 * _DEGREE_PER_HOUR * spin,
        "omegadot_z": 800 * _DEGREE_PER_HOUR * spin,
    }  # fmt: skip
    return np.stack([draw.uniform(-1, 1, n) * largest.get(c.name, 1000 * EOTVOS) for c in MOTION])


def signal(p: Array) -> float:
    """k_ggi = sum k_VI K1 R, V s^2: what one s^-2 of gradient gives."""
    parameters = p[2:].reshape(len(ACCELEROMETER), 4)
    at = {q.name: parameters[n] for n, q in enumerate(ACCELEROMETER)}
    return float(np.sum(at["k_VI"] * at["K1"] * (p[0] + at["dR"])))
