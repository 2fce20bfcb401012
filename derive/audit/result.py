"""The audit itself: every printed equation against the derivation, with proof and cost of what is wrong.

Where everything is rational, equal means equal: at the points of :mod:`derive.audit.direct` a right equation leaves 0, a
misprint leaves a number. What a difference costs is evaluated in the paper's dynamic experiment (Tables V and VI).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sympy.polys.rings import PolyElement

from derive.audit import direct
from derive.audit.compare import (
    ANALYTICAL,
    MODEL_RING,
    MOTION,
    SIMPLIFIED,
    TRANSDUCER,
    Equation,
    EquationComparison,
    Mistake,
    Rational,
    Reading,
    amplitude,
    compare,
    derived_amplitude,
    derived_motion,
    derived_transducer,
    expand_motion,
    expand_rate,
    in_printed_order,
    model_reader,
    motion_reader,
    read,
    transducer_reader,
)
from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS, collect
from derive.simplify import ARCSECOND, EOTVOS, G0, PER_HOUR, RADIUS, SPIN_FREQUENCY, TABLE_V, TABLE_VI
from derive.simplify import simplified as simplified_model
from derive.symbols import COMPONENTS

# --- Evaluation, exactly or over series ---

WEIGHTS = {"D12": (1, -1, 0, 0), "D34": (0, 0, 1, -1), "D1234": (1, 1, -1, -1), "Sigma": (1, 1, 1, 1)}
"""Weights of A_1 ... A_4 as the paper defines its combinations below Eq. 19."""


def value(p: PolyElement, numbers: Mapping[str, Any], of: Callable[[Fraction], Any] = Fraction) -> Any:
    """A polynomial at named numbers, or series; ``of`` makes numbers of their kind of its coefficients."""
    total = of(Fraction(0))
    names = [s.name for s in p.ring.symbols]
    for powers, c in p.terms():
        factors = (numbers[n] ** k for n, k in zip(names, powers, strict=True) if k)
        total = total + math.prod(factors, start=of(Fraction(int(c.numerator), int(c.denominator))))
    return total


def amplitude_value(
    p: PolyElement,
    accelerometers: Mapping[str, Sequence[Any]],
    motion: Mapping[str, Any],
    of: Callable[[Fraction], Any] = Fraction,
) -> Any:
    """An amplitude of Eq. 18 or 19 (independent motion numbers only), four values each of the accelerometers' parameters."""
    four = {**accelerometers, **WEIGHTS}
    return sum(value(p, {n: v[j] for n, v in four.items()} | dict(motion), of) for j in range(4))


@cache
def _printed_motion() -> Mapping[str, PolyElement]:
    """The printed Eq. 16 as it is read, omega_im^2 by its components."""
    return {e.left: read(e, motion_reader(), expand_rate()).total for e in MOTION}


def motion_numbers(point: direct.NumericPoint) -> dict[str, Fraction]:
    """T_1 ... S_5 by the *printed* Eq. 16, and everything else that Eq. 18 and 19 name."""
    rates = direct.rates(point)
    numbers = {f"a_{k}": v for k, v in zip("xyz", point.a, strict=True)}
    numbers |= {left: value(p, rates) for left, p in _printed_motion().items()}
    return numbers | {n: rates[n] for n in ("omegadot_x", "omegadot_y")}


def wave(name: str, point: direct.NumericPoint) -> Fraction:
    """cos or sin of n times the disc angle, for an amplitude's name."""
    real, imaginary = Fraction(1), Fraction(0)
    for _ in range(int(name[2])):
        c, s = point.cosine, point.sine
        real, imaginary = real * c - imaginary * s, real * s + imaginary * c
    return imaginary if name.endswith("s") else real


def output(amplitudes: Mapping[str, PolyElement], point: direct.NumericPoint) -> Fraction:
    """G_out of Eq. 17 with these amplitudes."""
    motion = motion_numbers(point)
    terms = (amplitude_value(p, point.accelerometers, motion) * wave(n, point) for n, p in amplitudes.items())
    return sum(terms, Fraction(0))


def current(rows: Mapping[str, PolyElement], point: direct.NumericPoint, j: int) -> Fraction:
    """I_j / K_j1 - K_j0 of Eq. 5a with these coefficients, for the force a of the point."""
    x, y, z = point.a
    k = {left: value(p, {n: v[j] for n, v in point.accelerometers.items()}) for left, p in rows.items()}
    linear = x + y * k[r"\vartheta_{jz}^*"] - z * k[r"\vartheta_{jy}^*"]
    squares = k["K_{j2}^*"] * x * x + k["K_{j5}^*"] * y * y + k["K_{j7}^*"] * z * z
    return Fraction(linear + squares + k["K_{j6}^*"] * x * y + k["K_{j4}^*"] * x * z + k["K_{j8}^*"] * y * z)


# --- The dynamic experiment ---
# Units are the paper's: specific force in g, k1 in V/g, K_p in g/g^2. A radius then counts in m over g0, so that radius times
# gradient is in g.

Array = NDArray[np.float64]

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
    G /= scale_factor() * float(EOTVOS)
    rms = math.sqrt(float(np.mean(G**2)))
    T1, T2 = (float(np.mean(2 * G * f(2 * ANGLES))) for f in (np.sin, np.cos))
    # Rounding must not show: what is zero but for the last digits is zero.
    floor = 1e-9 * rms
    return Cost(rms, 2 * T1 if abs(T1) > floor else 0.0, -T2 if abs(T2) > floor else 0.0)


# --- The audit ---

PROOF_POINTS = 10
"""More than the nine functions 1, cos n phi, sin n phi (n to 4) of Eq. 17: equality fixes each amplitude."""
PROOF_SEED = 2018

Amplitudes = Mapping[str, PolyElement]

MOTION_PLACES = slice(len(COEFFICIENT_PARAMETERS), len(COEFFICIENT_PARAMETERS) + len(MOTION_NUMBERS))
"""Of the motion numbers in :data:`MODEL_RING`."""


@dataclass(frozen=True)
class Erratum:
    """A printed term that is wrong.

    ``residual`` is what G_out is off by, at the first proof point, if this term alone is left as printed (exactly 0 with the
    right one); ``cost`` is that of printed minus right in the dynamic experiment. Both are None for Eq. 5b and 16, whose terms
    are no terms of G_out.
    """

    equation: Equation
    mistake: Mistake
    residual: float | None
    cost: Cost | None


@dataclass(frozen=True)
class Beyond:
    """Derived terms of one amplitude and motion number beyond the printed order of counting."""

    amplitude: str
    terms: PolyElement
    cost: Cost


@dataclass(frozen=True)
class Audit:
    """Result of the audit.

    ``proved``: every exact check left nothing. ``neglected``: cost of simplified minus analytical model.
    ``simplified_amplitudes``: those Eq. 42 must have.
    """

    comparisons: tuple[EquationComparison, ...]
    errata: tuple[Erratum, ...]
    beyond: tuple[Beyond, ...]
    neglected: Cost
    simplified_amplitudes: tuple[str, ...]
    proved: bool

    @property
    def printed(self) -> int:
        """Number of printed atoms audited."""
        return sum(c.printed for c in self.comparisons)

    @property
    def confirmed(self) -> int:
        """Number of printed atoms that come out."""
        return sum(c.confirmed for c in self.comparisons)

    @property
    def wrong(self) -> int:
        """Number of printed atoms that are wrong."""
        return self.printed - self.confirmed


@cache
def audit() -> Audit:
    """Audit Eq. 5b, 16, 18, 19 and 43-47 against the current derivation."""
    collected, simple = collect(), simplified_model()
    full = {name: derived_amplitude(collected, name) for name in collected.amplitudes}
    analytical = {n: in_printed_order(p) for n, p in full.items()}
    simplified = {n: derived_amplitude(simple, n) for n in simple.amplitudes}
    transducer = derived_transducer()
    outcomes = [(r, compare(r, p)) for r, p in readings(analytical, simplified, transducer)]
    points = direct.points(PROOF_POINTS, PROOF_SEED)
    return Audit(
        comparisons=tuple(o for _, o in outcomes),
        errata=tuple(_erratum(r, m, points[0]) for r, o in outcomes for m in o.mistakes),
        beyond=tuple(_beyond(full, analytical)),
        neglected=cost({n: simplified.get(n, MODEL_RING.zero) - analytical[n] for n in analytical}),
        simplified_amplitudes=tuple(n for n, p in simplified.items() if p),
        proved=_prove(analytical, transducer, points),
    )


def readings(
    analytical: Amplitudes, simplified: Amplitudes, transducer: Mapping[str, PolyElement]
) -> list[tuple[Reading, PolyElement]]:
    """Every printed equation as read, with its derivation."""
    motion = derived_motion()
    reader, expand = model_reader(), expand_motion()
    pairs = [(read(e, transducer_reader()), transducer[e.left]) for e in TRANSDUCER]
    pairs += [(read(e, motion_reader(), expand_rate()), motion[e.left]) for e in MOTION]
    pairs += [(read(e, reader, expand), analytical[amplitude(e.left)]) for e in ANALYTICAL]
    return pairs + [(read(e, reader, expand), simplified[amplitude(e.left)]) for e in SIMPLIFIED]


def _prove(
    analytical: Amplitudes, transducer: Mapping[str, PolyElement], points: tuple[direct.NumericPoint, ...]
) -> bool:
    outputs = all(direct.output(p) == output(analytical, p) for p in points)
    return outputs and all(
        direct.current(p, j, p.a) == current(transducer, p, j) for p in points[:3] for j in range(4)
    )


def _erratum(r: Reading, m: Mistake, point: direct.NumericPoint) -> Erratum:
    residual = expense = None
    if r.ring is MODEL_RING:
        difference = {amplitude(r.equation.left): printed_minus_right(m)}
        residual, expense = float(output(difference, point)), cost(difference)
    return Erratum(r.equation, m, residual, expense)


def printed_minus_right(m: Mistake) -> PolyElement:
    """What a printed term of Eq. 18, 19 or 43-47 has too much, in the independent motion numbers."""
    expand = expand_motion()
    return sum((expand(c.monomial) * (c.printed - c.right) for c in m.changes), MODEL_RING.zero)


def _beyond(full: Amplitudes, kept: Amplitudes) -> list[Beyond]:
    rows = []
    for name in full:
        motions: dict[tuple[int, ...], dict[tuple[int, ...], Rational]] = {}
        for powers, value in (full[name] - kept[name]).terms():
            motions.setdefault(powers[MOTION_PLACES], {})[powers] = value
        for terms in motions.values():
            p = MODEL_RING.from_dict(terms)
            rows.append(Beyond(name, p, cost({name: p})))
    return rows
