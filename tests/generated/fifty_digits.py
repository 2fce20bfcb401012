"""The instrument at 50 digits, written down from Eq. 1-15 in vectors: no symbol, no printing, no expansion.

The order of counting is the paper's: mounting rotations to first order in each angle and multiplied out,
misalignment to first order (Eq. 2), second-order terms without angles (below Eq. 5b).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
from numpy.typing import NDArray

from derive.audit import result
from derive.audit.compare import derived_amplitude, derived_motion
from derive.propagation import Collected
from derive.symbols import MOTION

Array = NDArray[np.float64]

CONTEXT: Any = mpmath.mp.clone()
CONTEXT.dps = 50
real = CONTEXT.mpf

PER_ACCELEROMETER = (
    "dR", "beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z",
    "K0", "K1", "K2", "K4", "K5", "K6", "K7", "K8", "k_VI",
)  # fmt: skip
PLACES = (0, 2, 1, 3)
SIGNS = (1, 1, -1, -1)


def exact(values: Array) -> list[Any]:
    """Float64 numbers as they are, without rounding."""
    return [real(float(v)) for v in values]


def _plus(*vectors: Sequence[Any]) -> list[Any]:
    return [sum(parts, real(0)) for parts in zip(*vectors, strict=True)]


def _times(s: Any, v: Sequence[Any]) -> list[Any]:
    return [s * x for x in v]


def _dot(u: Sequence[Any], v: Sequence[Any]) -> Any:
    return sum((x * y for x, y in zip(u, v, strict=True)), real(0))


def _cross(u: Sequence[Any], v: Sequence[Any]) -> list[Any]:
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def voltages(t: Any, x: Sequence[Any], p: Sequence[Any]) -> list[Any]:
    """V_1 ... V_4 at one instant; ``x`` the 15 motion channels, ``p`` the 62 parameters."""
    phi = 2 * CONTEXT.pi * p[1] * t
    return [
        voltage(
            {name: p[2 + 4 * n + j] for n, name in enumerate(PER_ACCELEROMETER)},
            p[0],
            phi + PLACES[j] * CONTEXT.pi / 2,
            x,
        )
        for j in range(4)
    ]


def _turned(v: Sequence[Any], axis: Sequence[Any], angle: Any) -> list[Any]:
    """A vector, turned about a unit axis, to first order."""
    return _plus(v, _times(angle, _cross(axis, v)))


def voltage(k: Mapping[str, Any], radius: Any, psi: Any, x: Sequence[Any]) -> Any:
    """V of one accelerometer with parameters ``k`` at the angle ``psi`` on the disc."""
    xx, xy, xz, yy, yz, zz = x[9:]
    Gamma, omega, omegadot = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)), x[3:6], x[6:9]

    def specific_force(r: Sequence[Any]) -> list[Any]:
        gravity = [-_dot(row, r) for row in Gamma]
        return _plus(x[0:3], _cross(omegadot, r), _cross(omega, _cross(omega, r)), gravity)

    e_r = [CONTEXT.cos(psi), CONTEXT.sin(psi), real(0)]
    e_t = [-CONTEXT.sin(psi), CONTEXT.cos(psi), real(0)]
    e_z = [real(0), real(0), real(1)]
    triad = [e_t, e_r, _times(-1, e_z)]

    def mounted(v: Sequence[Any], lift: Any) -> list[Any]:
        return _turned(_turned(v, e_t, lift), e_z, k["beta_z"])

    R = radius + k["dR"]
    f = specific_force(_times(R, mounted(e_r, -k["beta_x"])))
    sensed = [_dot(f, mounted(u, k["beta_x"])) for u in triad]
    # second-order terms: nominal place and triad, at the actual radius
    nominal = specific_force(_times(R, e_r))
    q_i, q_o, q_p = (_dot(nominal, u) for u in triad)
    i = sensed[0] + sensed[1] * k["vartheta_z"] - sensed[2] * k["vartheta_y"]
    i += k["K0"] + k["K2"] * q_i**2 + k["K5"] * q_o**2 + k["K7"] * q_p**2
    i += k["K4"] * q_i * q_p + k["K6"] * q_i * q_o + k["K8"] * q_o * q_p
    return k["k_VI"] * k["K1"] * i


def output(t: Any, x: Sequence[Any], p: Sequence[Any]) -> Any:
    """G_out (Eq. 15) at one instant."""
    return sum((s * v for s, v in zip(SIGNS, voltages(t, x, p), strict=True)), real(0))


def of_model(c: Collected, t: Any, x: Sequence[Any], p: Sequence[Any]) -> Any:
    """G_out of a collected model (Eq. 17), its exact rational polynomials put into numbers."""

    def number(f: Fraction) -> Any:
        return real(f.numerator) / f.denominator

    rates = dict(zip((m.name for m in MOTION), x, strict=True))
    motion = rates | {n: result.value(q, rates, number) for n, q in derived_motion().items()}
    parameters = {name: p[2 + 4 * n : 6 + 4 * n] for n, name in enumerate(PER_ACCELEROMETER)}
    parameters["k1"] = [k * gain for k, gain in zip(parameters["K1"], parameters["k_VI"], strict=True)]
    parameters["R"] = [p[0] + dR for dR in parameters["dR"]]
    phi, total = 2 * CONTEXT.pi * p[1] * t, real(0)
    for name in c.amplitudes:
        wave = CONTEXT.sin if name.endswith("s") else CONTEXT.cos
        value = result.amplitude_value(derived_amplitude(c, name), parameters, motion, number)
        total += value * wave(int(name[2]) * phi)
    return total
