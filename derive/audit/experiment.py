"""What a difference between two models costs in the paper's dynamic experiment (Tables V and VI).

Units are the paper's: specific force in g, k1 in V/g, K_p in g/g^2. A radius then counts in m over g0, so
that radius times gradient is in g.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from sympy.polys.rings import PolyElement

from derive.audit.compare import derived_motion
from derive.audit.proof import amplitude_value, value
from derive.simplify.envelope import ARCSECOND, G0, PER_HOUR, RADIUS, SPIN_FREQUENCY, TABLE_V, TABLE_VI
from derive.symbols import COMPONENTS

Array = NDArray[np.float64]

EOTVOS = 1e-9
SAMPLES = 32
"""Per revolution. The motion repeats with the disc, no product goes beyond the 8th harmonic: exact means."""
ANGLES = 2 * np.pi * np.arange(SAMPLES) / SAMPLES
GAIN = 1e9  # ohm, all four


@dataclass(frozen=True)
class Cost:
    """Of a difference in G_out over k_ggi, in eotvos.

    ``rms`` before demodulation; ``inline`` (Gamma_xx - Gamma_yy) and ``cross`` (Gamma_xy) after an ideal
    quadrature demodulation over whole revolutions: T_1 is the mean of 2 G sin 2 phi, T_2 of 2 G cos 2 phi.
    """

    rms: float
    inline: float
    cross: float


@cache
def accelerometers() -> Mapping[str, tuple[float, ...]]:
    """Four values of every parameter by the names of :data:`MODEL_RING`: Table V, in the paper's units, angles in radians."""
    values = {"R": tuple((RADIUS + 1e-6 * d) / G0 for d in TABLE_V["dR"]), "vartheta_x": (0.0,) * 4}
    values["k1"] = tuple(1e-3 * GAIN * k for k in TABLE_V["K1"])
    scale = {"b": ARCSECOND, "v": ARCSECOND, "K": 1e-6}
    values |= {n: tuple(scale[n[0]] * x for x in v) for n, v in TABLE_V.items() if n not in ("dR", "K1")}
    return values


def scale_factor() -> float:
    """k_ggi, V s^2."""
    p = accelerometers()
    return sum(k * R for k, R in zip(p["k1"], p["R"], strict=True))


@cache
def motion() -> Mapping[str, Array]:
    """Table VI over one revolution, by the names of :data:`MODEL_RING` (g, s^-2); no gravity gradient."""
    sine, cosine = np.sin(ANGLES), np.cos(ANGLES)
    spin = 2 * math.pi * SPIN_FREQUENCY
    unit = {"a": 1.0, "o": PER_HOUR}
    numbers = {n: unit[n[0]] * (m + v * sine) for n, (m, v) in TABLE_VI.items()}
    numbers |= {f"omegadot_{k}": unit["o"] * TABLE_VI[f"omega_{k}"][1] * spin * cosine for k in "xyz"}
    numbers |= {f"Gamma_{k}": np.zeros(SAMPLES) for k in COMPONENTS}
    return numbers | {n: value(p, numbers, float) for n, p in derived_motion().items()}


def cost(amplitudes: Mapping[str, PolyElement]) -> Cost:
    """What a difference in the amplitudes (A_0, A_1c, A_1s ...) costs (Eq. 17)."""
    G = np.zeros(SAMPLES)
    for name, p in amplitudes.items():
        wave = np.sin if name.endswith("s") else np.cos
        G += amplitude_value(p, accelerometers(), motion(), float) * wave(int(name[2]) * ANGLES)
    G /= scale_factor() * EOTVOS
    rms = math.sqrt(float(np.mean(G**2)))
    T1, T2 = (float(np.mean(2 * G * f(2 * ANGLES))) for f in (np.sin, np.cos))
    # Rounding must not show: what is zero but for the last digits is zero.
    floor = 1e-9 * rms
    return Cost(rms, 2 * T1 if abs(T1) > floor else 0.0, -T2 if abs(T2) > floor else 0.0)
