"""Stages 1 and 5: what is recorded of the true motion and of the output. None of these effects touches the truth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.reference.effects import Injected, Values
from ragg_runtime.reference.effects.memory import recoil
from ragg_runtime.reference.effects.transducer import REFERENCE_TEMPERATURE, averaging
from ragg_runtime.reference.geometry import by_vector
from ragg_runtime.reference.motion import MotionSignals, MotionState

Array = NDArray[np.float64]


def record_motion(
    motion: MotionSignals, time: Array, effects: Injected, temperature: Array | float = REFERENCE_TEMPERATURE
) -> MotionState:
    """Motion as the sensor, at a temperature in K, reports it at (N,) s.

    In this order: its place and delay, its orientation and gyroscopes, its accelerometers, its range.
    """
    delay = float(effects["time-offset"]["delta_t"]) if "time-offset" in effects else 0.0
    if drift := effects.get("clock-drift"):
        time = time - drift["epsilon"] * time
    at_sensor = _carry_to_sensor(motion, time, delay, effects)
    turned = _sense_rotation(motion, time, delay, at_sensor, effects)
    return _clip(replace(turned, a=_sense_force(turned.a, effects, temperature)), effects)


def _carry_to_sensor(motion: MotionSignals, time: Array, delay: float, effects: Injected) -> MotionState:
    """The motion at the sensor's place, delayed by its filters and its mount."""
    true = motion.at(time, delay)
    a, omega, omegadot = true.a, true.omega, true.omegadot
    if skewed := effects.get("imu-skew"):
        late = [motion.a[n](time, delay + float(skewed[f"delta_{k}"])) for n, k in enumerate("xy")]
        a = np.stack([*late, a[2]])
    if lever := effects.get("imu-lever-arm"):
        arm = np.array([lever["l_x"], lever["l_y"], lever["l_z"]])[:, None]
        a = a + np.cross(omegadot, arm, axis=0) + np.cross(omega, np.cross(omega, arm, axis=0), axis=0)
    if slow := effects.get("gyro-delay"):
        omega = motion.at(time, delay + float(slow["delta_w"])).omega
        omegadot = motion.at(time, delay + float(slow["delta_d"])).omegadot
    if filtered := effects.get("imu-filter"):
        a = a + sum(w * (motion.at(time, delay + d).a - true.a) for d, w in averaging(float(filtered["b_a"])))
        for d, w in averaging(float(filtered["b_w"])):
            past = motion.at(time, delay + d)
            omega = omega + w * (past.omega - true.omega)
            omegadot = omegadot + w * (past.omegadot - true.omegadot)
    if mount := effects.get("mount-resonance"):
        a = a + np.stack([recoil(mount, x, time, delay)[0] for x in motion.a])
        turning = [recoil(mount, x, time, delay) for x in motion.omega]
        omega = omega + np.stack([swing for swing, _ in turning])
        omegadot = omegadot + np.stack([rate for _, rate in turning])
    return MotionState(a, omega, omegadot)


def _sense_rotation(
    motion: MotionSignals, time: Array, delay: float, at_sensor: MotionState, effects: Injected
) -> MotionState:
    """The same by a sensor that is turned, and by its gyroscopes."""
    a, omega, omegadot = at_sensor.a, at_sensor.omega, at_sensor.omegadot
    if turned := effects.get("imu-misalignment"):
        # Components along axes turned by e: the inverse rotation of the vector.
        to_sensor = by_vector([turned["e_x"], turned["e_y"], turned["e_z"]]).T
        a, omega, omegadot = to_sensor @ a, to_sensor @ omega, to_sensor @ omegadot
    if scale := effects.get("gyro-scale"):
        factor = 1 + _vector(scale, "s")
        omega, omegadot = factor * omega, factor * omegadot
    if leaning := effects.get("gyro-misalignment"):
        axes = _make_sensor_axes(leaning)
        omega, omegadot = axes @ omega, axes @ omegadot
    if force := effects.get("gyro-g-sensitivity"):
        D = np.array([[force[f"d_{i}{k}"] for k in "xyz"] for i in "xyz"])
        jerk = np.stack([s(time, delay, 1) for s in motion.a])
        omega, omegadot = omega + D @ a, omegadot + D @ jerk
    if rates := effects.get("gyro-bias"):
        omega = omega + _vector(rates, "b")
    return MotionState(a, omega, omegadot)


def _sense_force(a: Array, effects: Injected, temperature: Array | float) -> Array:
    """(3, N): the specific force (3, N) by its accelerometers."""
    if skew := effects.get("imu-acceleration-misalignment"):
        a = _make_sensor_axes(skew) @ a
    if curved := effects.get("imu-acceleration-quadratic"):
        bent = [2 * x / (1 + np.sqrt(1 - 4 * curved[f"q_{k}"] * x)) for k, x in zip("xy", a, strict=False)]
        a = np.stack([*bent, a[2]])
    if scale := effects.get("imu-acceleration-scale"):
        a = (1 + _vector(scale, "s")) * a
    if offset := effects.get("imu-acceleration-bias"):
        a = a + _vector(offset, "b")
    if warm := effects.get("imu-thermal"):
        warmer = temperature - REFERENCE_TEMPERATURE
        level = [
            (1 + warm[f"ds_{k}_dT"] * warmer) * a[n] + warm[f"db_{k}_dT"] * warmer for n, k in enumerate("xy")
        ]
        a = np.stack([*level, a[2]])
    return a


def _clip(sensed: MotionState, effects: Injected) -> MotionState:
    """The same within the sensor's range."""
    ends = effects.get("imu-saturation")
    if not ends:
        return sensed
    a_max, omega_max = float(ends["a_max"]), float(ends["omega_max"])
    a, omega = np.clip(sensed.a, -a_max, a_max), np.clip(sensed.omega, -omega_max, omega_max)
    # a gyroscope at the end of its range is constant
    return MotionState(a, omega, np.where(np.abs(sensed.omega) > omega_max, 0.0, sensed.omegadot))


def _make_sensor_axes(skew: Values) -> Array:
    """(3, 3): what axes that lean report of a vector."""
    return np.array([[1.0 if i == k else float(skew[f"m_{i}{k}"]) for k in "xyz"] for i in "xyz"])


def _vector(values: Values, name: str) -> Array:
    """Three values, (3, 1)."""
    return np.array([[float(values[f"{name}_{k}"])] for k in "xyz"])


def record_output(G_out: Array, effects: Injected) -> Array:
    """G_out (N,) V, bent by a curve, clipped at +-V_max and then rounded to multiples of q."""
    if bent := effects.get("output-curve"):
        G_out = _reading(G_out, float(bent["c_2"]), float(bent["c_3"]))
    if limit := effects.get("saturation"):
        G_out = np.clip(G_out, -limit["V_max"], limit["V_max"])
    if (steps := effects.get("quantisation")) and steps["q"] > 0:
        G_out = steps["q"] * np.rint(G_out / steps["q"])
    return G_out


def _reading(G: Array, c_2: float, c_3: float) -> Array:
    """The reading r of a converter at the voltage G = r + c_2 r^2 + c_3 r^3, by Newton's method from r = G on."""
    r = G
    for _ in range(_NEWTON if c_2 or c_3 else 0):
        r = r - (r + c_2 * r**2 + c_3 * r**3 - G) / (1 + 2 * c_2 * r + 3 * c_3 * r**2)
    return np.asarray(r)


_NEWTON = 6  # steps that bring a curve of a per cent to the last digit
