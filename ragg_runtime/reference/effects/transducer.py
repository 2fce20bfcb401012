"""Stage 4: bias, scale factor, higher-order terms and the lag of an accelerometer."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.reference.effects import CATALOGUE, Injected, memory
from ragg_runtime.reference.geometry import Taylor, carry
from ragg_runtime.reference.motion import MotionState

Array = NDArray[np.float64]
Triple = tuple[Array, Array, Array]
Triad = tuple[Taylor, Taylor, Taylor]

REFERENCE_TEMPERATURE = 293.15  # temperature (K) at which bias and scale factor have their test-sheet values
REFERENCE_PRESSURE = 101325.0  # pressure (Pa) at which the bias has its test-sheet value

_REFERENCES = {"temperature": REFERENCE_TEMPERATURE, "pressure": REFERENCE_PRESSURE}

_CUBIC_POWERS = {
    f"K_{name}": tuple(name.count(axis) for axis in "iop")
    for name in ("iio", "iip", "ioo", "iop", "ipp", "ooo", "oop", "opp", "ppp")
}


def follow(
    quantity: str, j: int, time: Array, auxiliaries: Mapping[str, Array], effects: Injected
) -> list[Array]:
    """By how much each effect that the catalogue has of it changes a parameter of accelerometer j at the time, (N,) each."""
    changes = []
    for effect, values in effects.items():
        for name, q in CATALOGUE[effect].items():
            if q.changes != quantity or not np.any(values[name]):
                continue
            if q.by == "step":
                x = (time >= values["t_step"]).astype(np.float64)
            else:
                x = time if q.by == "time" else auxiliaries[q.by] - _REFERENCES.get(q.by, 0.0)
            changes.append(np.asarray((values[name][j] if q.per_accelerometer else values[name]) * x))
    return changes


def bias(
    j: int, K0: float, time: Array, auxiliaries: Mapping[str, Array], effects: Injected
) -> Array | float:
    """Null bias of accelerometer j, m/s^2."""
    value = sum(follow("K0", j, time, auxiliaries, effects), K0)
    if slipping := effects.get("bias-hysteresis"):
        for n, axis in enumerate("iop"):
            value = value + slipping[f"h_{axis}"][j] * auxiliaries[memory.friction("bias-hysteresis", j, n)]
    if creeping := effects.get("bias-creep"):
        for n, axis in enumerate("iop"):
            value = value + creeping[f"c_{axis}"][j] * auxiliaries[memory.friction("bias-creep", j, n)]
        value = value + creeping["c_0"][j] * auxiliaries[memory.former("bias-creep")]
    if cycling := effects.get("thermal-hysteresis"):
        value = value + cycling["h"][j] * auxiliaries[memory.CYCLE]
    if heated := effects.get("inner-temperature"):
        value = value + heated["b"][j] * auxiliaries[memory.heat(j)]
        value = value + heated["b_0"][j] * auxiliaries[memory.former("inner-temperature")]
    return value


def gain(j: int, time: Array, auxiliaries: Mapping[str, Array], effects: Injected) -> Array | float:
    """Factor on the scale factor of accelerometer j."""
    factor: Array | float = 1.0
    for change in follow("K1", j, time, auxiliaries, effects):
        factor = factor * (1 + change)
    if heated := effects.get("inner-temperature"):
        former = heated["s_0"][j] * auxiliaries[memory.former("inner-temperature")]
        factor = factor * (1 + heated["s"][j] * auxiliaries[memory.heat(j)] + former)
    return factor


def case_rate(triad: Triad, motion: MotionState) -> Triple:
    """Angular rate of a case about its x, y and z axes, rad/s, from where these axes move to."""
    moving = [np.cross(motion.omega, v.value, axis=0) + v.first for v in triad]
    x, y, z = triad

    def towards(velocity: Array, axis: Taylor) -> Array:
        return np.asarray(np.sum(velocity * axis.value, axis=0))

    return towards(moving[1], z), towards(moving[2], x), towards(moving[0], y)


def case_acceleration(triad: Triad, motion: MotionState) -> Triple:
    """Angular acceleration of a case about its x, y and z axes, rad/s^2, from where these axes turn to."""
    x, y, z = ((v.value, carry(v, motion.omega, motion.omegadot)) for v in triad)

    def about(next_: tuple[Array, Array], last: tuple[Array, Array]) -> Array:
        # u'' = alpha x u + Omega x (Omega x u); of the two, the first alone is antisymmetric.
        return np.asarray(np.sum(next_[1] * last[0] - last[1] * next_[0], axis=0) / 2)

    return about(y, z), about(z, x), about(x, y)


def further_terms(
    j: int, f: Triple, triad: Triad, motion: MotionState, auxiliaries: Mapping[str, Array], effects: Injected
) -> Array | float:
    """What accelerometer j adds to Eq. 1, m/s^2; ``f`` is f_i, f_o, f_p; ``triad`` tau_x, tau_y, tau_z, (3, N) each."""
    f_i = f[0]
    total: Array | float = 0.0
    if cubic := effects.get("cubic-input"):
        total = total + cubic["K_iii"][j] * f_i**3
    if cross := effects.get("cubic-cross"):
        for name, powers in _CUBIC_POWERS.items():
            total = total + cross[name][j] * np.prod([v**n for v, n in zip(f, powers, strict=True)], axis=0)
    if odd := effects.get("odd-quadratic"):
        total = total + odd["K_oq"][j] * f_i * np.abs(f_i)
    if pendulum := effects.get("pendulum-angular"):
        total = total + pendulum["K_pa"][j] * case_acceleration(triad, motion)[1]
    if uneven := effects.get("anisoinertia"):
        about_x, _, about_z = case_rate(triad, motion)
        total = total + uneven["K_ip"][j] * about_x * about_z
    if magnetic := effects.get("magnetic-bias"):
        total = total + magnetic["dK0_dB"][j] * _along(triad[0], auxiliaries)
    if across := effects.get("magnetic-axial-bias"):
        total = total + across["dK0_dBz"][j] * _along(triad[2], auxiliaries)
    return total


def _along(axis: Taylor, auxiliaries: Mapping[str, Array]) -> Array:
    """Magnetic field along an axis (3, N), T."""
    x, y, z = axis.value
    return np.asarray(auxiliaries["B_x"] * x + auxiliaries["B_y"] * y + auxiliaries["B_z"] * z)


def torque_gain(j: int, triad: Triad, auxiliaries: Mapping[str, Array], effects: Injected) -> Array | float:
    """Factor by which the field in the torquer's gap changes the current of accelerometer j."""
    flux = effects.get("magnetic-scale")
    level = {**auxiliaries, "B_z": np.zeros(1)}
    return 1.0 if flux is None else 1 + flux["dK1_dB"][j] * _along(triad[0], level)


def convert(j: int, bracket: Array, effects: Injected) -> Array:
    """What the converter of accelerometer j makes of its current, m/s^2."""
    uneven = effects.get("adc-nonlinearity")
    return bracket if uneven is None else bracket + uneven["h"][j] * np.sign(bracket)


def widths(effects: Injected, count: int) -> Array:
    """How far the loops of the accelerometers reach, (count,) s: before and after, where their delay is allowed for."""
    return np.sqrt(effects["second-order-loop"]["b"] if "second-order-loop" in effects else np.zeros(count))


def loop_quadrature(width: float) -> tuple[tuple[float, float], ...]:
    """Delays (s) and weights of 1/(1 - w^2 s^2): the past and the future, weighed by exp(-|x|/w)/(2 w)."""
    return tuple((side * d, w / 2) for d, w in lag_quadrature(width) for side in (1.0, -1.0))


_NODES, _WEIGHTS = np.polynomial.laguerre.laggauss(10)


def lags(effects: Injected, count: int) -> Array:
    """Time constants of the accelerometers, (count,) s."""
    return effects["lag"]["tau"] if "lag" in effects else np.zeros(count)


def lag_quadrature(tau: float) -> tuple[tuple[float, float], ...]:
    """Delays (s) and weights of 1/(1 + tau s): u(t) = integral of exp(-x) V(t - tau x) dx, Gauss-Laguerre."""
    return tuple((tau * float(x), float(w)) for x, w in zip(_NODES, _WEIGHTS, strict=True))


def averaging(b: float) -> tuple[tuple[float, float], ...]:
    """Delays (s) and weights of an average over a converter's interval T, centred, b = T^2/24; empty: there is none."""
    half = np.sqrt(24 * b) / 2
    nodes, weights = np.polynomial.legendre.leggauss(5)
    return tuple((half * float(x), float(w) / 2) for x, w in zip(nodes, weights, strict=True)) if b else ()
