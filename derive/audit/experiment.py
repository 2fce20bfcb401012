"""What a difference between two models costs in the paper's dynamic experiment (Tables V and VI).

Units are the paper's: specific force in g, k1 in V/g, K_p in g/g^2. A radius then counts in m over g0, so
that radius times gradient is in g.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from sympy.polys.rings import PolyElement

from derive.audit.reading import MODEL_RING
from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS

G0 = 9.8
"""m/s^2 per g: the value with which the paper's k_ggi = 4.54e-4 V/Eo comes out."""
RADIUS = 0.1
SPIN_FREQUENCY = 0.25
EOTVOS = 1e-9
SAMPLES = 32
"""Per revolution. The motion repeats with the disc, no product goes beyond the 8th harmonic: exact means."""

ARCSEC = math.pi / 648000
TABLE_V: Mapping[str, tuple[float, ...]] = {
    "dR": (0, 30, 35, 25),  # um
    "beta_x": (21, 14, 17, 19),  # arcsec
    "beta_z": (18, 8, 10, 20),
    "vartheta_y": (21, 10, 7, 19),
    "vartheta_z": (30, 19, 20, 9),
    "K0": (10, 2, 5, 8),  # ug
    "K1": (10, 11, 11.5, 12),  # mA/g
    "K2": (5, 1, 8, 7),  # ug/g^2
    "K4": (6, 12, 5, 16),
    "K5": (4, 11, 9, 13),
    "K6": (3, 12, 8, 10),
    "K7": (5, 15, 7, 17),
    "K8": (0, 7, 11, 20),
}
GAIN = 1e9  # ohm, all four
TABLE_VI: Mapping[str, tuple[float, float]] = {
    "a_x": (0.08, 0.005),  # g: constant, and amplitude of sin Omega t
    "a_y": (0.06, 0.006),
    "a_z": (0.1, 0.05),
    "omega_x": (1000, 700),  # deg/h
    "omega_y": (1500, 900),
    "omega_z": (2000, 800),
}


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
    scale = {"b": ARCSEC, "v": ARCSEC, "K": 1e-6}
    values |= {n: tuple(scale[n[0]] * x for x in v) for n, v in TABLE_V.items() if n not in ("dR", "K1")}
    return values


def scale_factor() -> float:
    """k_ggi, V s^2."""
    p = accelerometers()
    return sum(k * R for k, R in zip(p["k1"], p["R"], strict=True))


def angle(n: int) -> float:
    """Disc angle of sample n."""
    return 2 * math.pi * n / SAMPLES


@cache
def motion() -> Mapping[str, tuple[float, ...]]:
    """Table VI over one revolution, by the names of :data:`MODEL_RING` (g, s^-2); no gravity gradient."""
    sine, cosine = ([f(angle(n)) for n in range(SAMPLES)] for f in (math.sin, math.cos))
    per_hour = math.pi / 648000
    a = {n: tuple(m + v * s for s in sine) for n, (m, v) in TABLE_VI.items() if n[0] == "a"}
    rate = [[per_hour * (m + v * s) for s in sine] for m, v in (TABLE_VI[f"omega_{k}"] for k in "xyz")]
    spin = 2 * math.pi * SPIN_FREQUENCY
    turn = [[per_hour * v * spin * c for c in cosine] for _, v in (TABLE_VI[f"omega_{k}"] for k in "xyz")]
    w = list(zip(*rate, strict=True))
    d = list(zip(*turn, strict=True))

    def each(f: Callable[[Sequence[float], Sequence[float]], float]) -> tuple[float, ...]:
        return tuple(f(x, y) for x, y in zip(w, d, strict=True))

    return {
        **a,
        "T_1": each(lambda w, d: (w[1] ** 2 - w[0] ** 2) / 2),
        "T_2": each(lambda w, d: w[0] * w[1]),
        "T_3": each(lambda w, d: -w[1] * w[2] - d[0]),
        "T_4": each(lambda w, d: -w[0] * w[2] + d[1]),
        "T_5": each(lambda w, d: (w[0] ** 2 + w[1] ** 2) / 2 + w[2] ** 2),
        "T_6": each(lambda w, d: d[2]),
        "S_1": each(lambda w, d: -w[0] * w[2] - d[1]),
        "S_2": each(lambda w, d: -w[1] * w[2] + d[0]),
        "S_4": each(lambda w, d: w[0] ** 2 + w[1] ** 2),
    }


_NAMES = tuple(s.name for s in MODEL_RING.symbols)
MOTION_PLACES = slice(len(COEFFICIENT_PARAMETERS), len(COEFFICIENT_PARAMETERS) + len(MOTION_NUMBERS))
_WEIGHTS = {"D12": (1, -1, 0, 0), "D34": (0, 0, 1, -1), "D1234": (1, 1, -1, -1), "Sigma": (1, 1, 1, 1)}


def series(p: PolyElement) -> tuple[float, ...]:
    """One revolution of a polynomial of :data:`MODEL_RING` in the twelve motion numbers, V."""
    instrument = accelerometers()
    constants: dict[tuple[int, ...], float] = {}
    for powers, value in p.terms():
        named = [(n, k) for n, k in zip(_NAMES, powers, strict=True) if k]
        weights = next(_WEIGHTS[n] for n, _ in named if n in _WEIGHTS)
        inner = [(instrument[n], k) for n, k in named if n in instrument]
        products = (w * math.prod(v[j] ** k for v, k in inner) for j, w in enumerate(weights) if w)
        outer = powers[MOTION_PLACES]
        constants[outer] = constants.get(outer, 0.0) + float(value) * sum(products)
    total = [0.0] * SAMPLES
    for outer, c in constants.items():
        for n, v in enumerate(_moving(outer)):
            total[n] += c * v
    return tuple(total)


@cache
def _moving(powers: tuple[int, ...]) -> tuple[float, ...]:
    """One revolution of a product of motion numbers."""
    columns = [(motion()[n], k) for n, k in zip(_NAMES[MOTION_PLACES], powers, strict=True) if k]
    return tuple(math.prod(v[n] ** k for v, k in columns) for n in range(SAMPLES))


def output(amplitudes: Mapping[str, PolyElement]) -> tuple[float, ...]:
    """One revolution of G_out with these amplitudes (A_0, A_1c, A_1s ...), V (Eq. 17)."""
    total = [0.0] * SAMPLES
    for name, p in amplitudes.items():
        h = int(name[2])
        wave = math.sin if name.endswith("s") else math.cos
        for n, v in enumerate(series(p)):
            total[n] += v * wave(h * angle(n))
    return tuple(total)


def cost(amplitudes: Mapping[str, PolyElement]) -> Cost:
    """What a difference in the amplitudes costs."""
    unit = scale_factor() * EOTVOS
    G = [v / unit for v in output(amplitudes)]
    rms = math.sqrt(sum(v * v for v in G) / SAMPLES)
    T1 = sum(2 * v * math.sin(2 * angle(n)) for n, v in enumerate(G)) / SAMPLES
    T2 = sum(2 * v * math.cos(2 * angle(n)) for n, v in enumerate(G)) / SAMPLES
    # Rounding must not show: what is zero but for the last digits is zero.
    floor = 1e-9 * rms
    return Cost(rms, 2 * T1 if abs(T1) > floor else 0.0, -T2 if abs(T2) > floor else 0.0)
