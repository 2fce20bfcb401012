"""Effects beyond the paper's model, injected into the numerical reference in full, nonlinear form, by stages.

Here: their ids, parameters, SI units and neutral values.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ragg_runtime.base.errors import UserError, check_keys

# parameters of one effect: (4,) per accelerometer, or () shared, SI
Values = Mapping[str, NDArray[np.float64]]
Injected = Mapping[str, Values]  # effects by id
# what a user passes: {id: {parameter: value or four values, SI}}; parameters left out are neutral
EffectValues = Mapping[str, Mapping[str, ArrayLike]]


@dataclass(frozen=True)
class InjectedParameter:
    """One number of an effect (``per_accelerometer``: one each), absent at ``neutral``.

    ``unit``: SI; m/s^2 is the unit of specific force, so 1/(m/s^2)^2 is the paper's g/g^3. ``changes``: what of an accelerometer
    changes by it (K1: as a share) in proportion to a channel, to ``time``, or from an instant (``step``) on: ``by``.
    ``positive``: not below zero, and not zero unless that is neutral; ``most``: the largest that the simulation is good for.
    """

    unit: str
    per_accelerometer: bool = False
    neutral: float = 0.0
    changes: str = ""
    by: str = ""
    positive: bool = False
    most: float = np.inf


def _each(unit: str, *names: str, **fields: Any) -> dict[str, InjectedParameter]:
    return {name: InjectedParameter(unit, True, **fields) for name in names}


def _shared(unit: str, *names: str, **fields: Any) -> dict[str, InjectedParameter]:
    return {name: InjectedParameter(unit, **fields) for name in names}


def _size(unit: str, name: str, neutral: float) -> dict[str, InjectedParameter]:
    return _shared(unit, name, neutral=neutral, positive=True)


_TRACELESS = ("xx", "xy", "xz", "yy", "yz")
_PAIRS = ("xy", "xz", "yx", "yz", "zx", "zy")
_TURNING = tuple(f"G_{c}_{axis}" for axis in ("roll", "pitch") for c in _TRACELESS)
_PLACE = _shared("m", "x", "y", "z", neutral=1.0)
_RESONANCE = _size("Hz", "f_0", 5.0) | _size("1", "Q", 10.0)
LONGEST_LAG = (
    0.03  # time constant (s) up to which the quadrature of a lag is good to 1e-10 for forces below 2.5 Hz
)

CATALOGUE: Mapping[str, Mapping[str, InjectedParameter]] = {
    "cubic-input": _each("1/(m/s^2)^2", "K_iii"),
    "cubic-cross": _each(
        "1/(m/s^2)^2", "K_iio", "K_iip", "K_ioo", "K_iop", "K_ipp", "K_ooo", "K_oop", "K_opp", "K_ppp"
    ),
    "odd-quadratic": _each("1/(m/s^2)", "K_oq"),
    # The reference's own form is Eq. 52, with the second-order terms along the measured axes: kappa = 1.
    "second-order-misalignment": _shared("1", "kappa", neutral=1.0),
    "lag": _each("s", "tau", positive=True, most=LONGEST_LAG),
    "pendulum-angular": _each("(m/s^2)/(rad/s^2)", "K_pa"),
    "thermal-bias": _each("(m/s^2)/K", "dK0_dT", changes="K0", by="temperature"),
    "thermal-scale": _each("1/K", "dK1_dT", changes="K1", by="temperature"),
    "magnetic-bias": _each("(m/s^2)/T", "dK0_dB"),
    "pressure-bias": _each("(m/s^2)/Pa", "dK0_dp", changes="K0", by="pressure"),
    "bias-drift": _each("(m/s^2)/s", "dK0_dt", changes="K0", by="time"),
    "gain-drift": _each("1/s", "dK1_dt", changes="K1", by="time"),
    "gain-step": _each("1", "dK1", changes="K1", by="step") | _shared("s", "t_step"),
    "arm-length": _shared("m", "delta_R"),
    "arm-stretch": _each("m/(m/s^2)", "c_r"),
    "arm-sag": _each("m/(m/s^2)", "c_z"),
    "mount-compliance": _each("rad/(m/s^2)", "c_yx", "c_yy", "c_yz", "c_zx", "c_zy", "c_zz"),
    "spin-axis-tilt": _shared("rad", "alpha_x", "alpha_y"),
    "spin-axis-wobble": _shared("rad", "w_x", "w_y"),
    "spin-phase-offset": _shared("rad", "phi_0"),
    "encoder-harmonic": _shared("rad", "c_1", "s_1", "c_2", "s_2", "c_3", "s_3", "c_4", "s_4"),
    "spin-rate-jitter": _shared("rad", "sigma_phi") | _shared("rad/s^0.5", "sigma_walk"),
    "disc-spin": _shared("1", "share"),
    "spin-rate-offset": _shared("1", "epsilon"),
    "gradient-offset": _shared("1/s^2", "G_xx", "G_xy", "G_xz", "G_yy", "G_yz"),
    "gyro-bias": _shared("rad/s", "b_x", "b_y", "b_z"),
    "gyro-g-sensitivity": _shared("(rad/s)/(m/s^2)", *(f"d_{i}{k}" for i in "xyz" for k in "xyz")),
    "imu-acceleration-scale": _shared("1", "s_x", "s_y", "s_z"),
    "imu-acceleration-bias": _shared("m/s^2", "b_x", "b_y", "b_z"),
    "imu-acceleration-misalignment": _shared("rad", *(f"m_{p}" for p in _PAIRS)),
    "clock-drift": _shared("1", "epsilon"),
    "bias-step": _each("m/s^2", "dK0", changes="K0", by="step") | _shared("s", "t_step"),
    "output-gain-step": _shared("1", "g", changes="K1", by="step") | _shared("s", "t_step"),
    "output-filter": _shared("s^2", "b", positive=True),
    "thermal-lag": _each("(m/s^2)/(K/s)", "dK0_dTdot", changes="K0", by="d_temperature")
    | _each("1/(K/s)", "dK1_dTdot", changes="K1", by="d_temperature"),
    "anisoinertia": _each("(m/s^2)/(rad/s)^2", "K_ip"),
    "time-offset": _shared("s", "delta_t"),
    "imu-lever-arm": _shared("m", "l_x", "l_y", "l_z"),
    "imu-misalignment": _shared("rad", "e_x", "e_y", "e_z"),
    "gyro-delay": _shared("s", "delta_w", "delta_d"),
    "gyro-scale": _shared("1", "s_x", "s_y", "s_z"),
    "self-gradient": _shared("1/s^2/rad", *_TURNING),
    "near-mass": _shared("1/(m s^2)", "T_xxx", "T_xxy", "T_xxz", "T_xyy", "T_xyz", "T_yyy", "T_yyz")
    | _shared(
        "1/m^2/s^2",
        *(f"T_{k}" for k in ["xxxx", "xxxy", "xxxz", "xxyy", "xxyz", "xyyy", "xyyz", "yyyy", "yyyz"]),
    ),
    "near-sphere": _shared("kg", "M") | _PLACE,
    "near-cuboid": _shared("kg", "M") | _PLACE | _shared("m", "l_x", "l_y", "l_z", neutral=0.5),
    "vibration-rectification": _shared("(m/s^2)^2", "P_xx", "P_xy", "P_xz", "P_yy", "P_yz", "P_zz"),
    "vibration-level": _shared("1", "L_xx", "L_xy", "L_xz", "L_yy", "L_yz", "L_zz"),
    "angular-jitter": _shared("1", "W_xx", "W_xy", "W_xz", "W_yy", "W_yz", "W_zz"),
    "fuel-gradient": _shared("1/s^2/kg", "G_xx", "G_xy", "G_xz", "G_yy", "G_yz"),
    "self-gradient-yaw": _shared("1/s^2", "G_d", "G_xy", "G_xz", "G_yz"),
    "spin-servo": _shared("s^2", "c"),
    "bearing-run-out": _shared("m", *(f"{a}_{k}{n}" for n in (1, 2) for k in "xyz" for a in "cs")),
    "adc-nonlinearity": _each("m/s^2", "h"),
    "second-order-loop": _each("s^2", "b", positive=True),
    "mount-resonance": _shared("1", "share") | _RESONANCE,
    "accelerometer-resonance": _each("s", "u") | _each("s^2", "v") | _RESONANCE,
    "bias-hysteresis": _each("m/s^2", "h_i", "h_o", "h_p") | _size("m/s^2", "w", 0.01),
    "mount-hysteresis": _each("rad", "e_yx", "e_yz", "e_zx") | _size("m/s^2", "w", 0.01),
    "bias-creep": _each("1", "c_i", "c_o", "c_p") | _each("m/s^2", "c_0") | _size("s", "tau", 20.0),
    "mount-creep": _each("rad/(m/s^2)", "e_yx", "e_yz", "e_zx")
    | _each("rad", "e_y0", "e_z0")
    | _size("s", "tau", 20.0),
    "thermal-hysteresis": _each("m/s^2", "h") | _size("K", "w", 0.1),
    "inner-temperature": _each("1/(m/s^2)", "b")
    | _each("1/(m/s^2)^2", "s")
    | _each("m/s^2", "b_0")
    | _each("1", "s_0")
    | _size("s", "tau", 40.0),
    "output-curve": _shared("1/V", "c_2") | _shared("1/V^2", "c_3"),
    "thermal-misalignment": _each("rad/K", "dvartheta_y_dT", changes="vartheta_y", by="temperature"),
    "thermal-second-order": _each("1/(m/s^2)/K", "dK2_dT", changes="K2", by="temperature"),
    "misalignment-drift": _each("rad/s", "dvartheta_y_dt", changes="vartheta_y", by="time"),
    "misalignment-step": _each("rad", "dvartheta_y", changes="vartheta_y", by="step")
    | _shared("s", "t_step"),
    "second-order-drift": _each("1/(m/s^2)/s", "dK2_dt", changes="K2", by="time"),
    "second-order-step": _each("1/(m/s^2)", "dK2", changes="K2", by="step") | _shared("s", "t_step"),
    "imu-filter": _shared("s^2", "b_a", "b_w", positive=True),
    "imu-skew": _shared("s", "delta_x", "delta_y"),
    "gyro-misalignment": _shared("rad", *(f"m_{p}" for p in _PAIRS)),
    "imu-acceleration-quadratic": _shared("1/(m/s^2)", "q_x", "q_y"),
    "imu-thermal": _shared("(m/s^2)/K", "db_x_dT", "db_y_dT") | _shared("1/K", "ds_x_dT", "ds_y_dT"),
    "magnetic-scale": _each("1/T", "dK1_dB"),
    "magnetic-axial-bias": _each("(m/s^2)/T", "dK0_dBz"),
    "carrier-gradient": _shared("1/s^2", *(f"G_{c}" for c in _TRACELESS))
    | _shared("1/s^2/kg", *(f"F_{c}" for c in _TRACELESS)),
    "balancing-loop": _each("1/A", "dK1_di", changes="K1", by="balance_current")
    | _each("1/(m/s^2)/A", "dK2_di", changes="K2", by="second_order_current"),
    "saturation": _size("V", "V_max", np.inf),
    "imu-saturation": _size("m/s^2", "a_max", np.inf) | _size("rad/s", "omega_max", np.inf),
    "quantisation": _shared("V", "q", positive=True),
}
"""Every effect and its parameters."""


def resolve(effects: EffectValues | None, count: int = 4) -> Injected:
    """Check what a user asked for and fill in the neutral values; UserError on what is unknown or no number.

    For each effect, all of its parameters: (count,) arrays per accelerometer, () arrays shared.
    """
    resolved: dict[str, Values] = {}
    for effect, values in (effects or {}).items():
        check_keys([effect], CATALOGUE, "effects of the simulator")
        parameters = CATALOGUE[effect]
        check_keys(values, parameters, f"effect {effect}")
        resolved[effect] = {
            name: _check_values(effect, name, parameter, values.get(name, parameter.neutral), count)
            for name, parameter in parameters.items()
        }
    return resolved


def find_channels(effect: str, parameters: Values) -> tuple[str, ...]:
    """Auxiliary channels without which an effect of these parameters has no meaning."""
    if effect == "self-gradient":
        turning = any(value != 0 for name, value in parameters.items() if name.endswith("_pitch"))
        return ("roll", "pitch") if turning else ("roll",)
    if effect == "carrier-gradient":
        fuel = any(value != 0 for name, value in parameters.items() if name.startswith("F_"))
        return ("roll", "pitch", "yaw", "fuel_mass") if fuel else ("roll", "pitch", "yaw")
    followed = [q.by.removeprefix("d_") for n, q in CATALOGUE[effect].items() if np.any(parameters[n])]
    return (
        *_CHANNELS.get(effect, ()),
        *(channel for channel in followed if channel not in ("", "time", "step")),
    )


_CHANNELS: Mapping[str, tuple[str, ...]] = {
    **dict.fromkeys(("thermal-hysteresis", "imu-thermal"), ("temperature",)),
    "magnetic-scale": ("B_x", "B_y"),
    **dict.fromkeys(("magnetic-bias", "magnetic-axial-bias"), ("B_x", "B_y", "B_z")),
    "vibration-level": ("vibration_rms",),
    "angular-jitter": ("angular_vibration_rms",),
    "fuel-gradient": ("fuel_mass",),
    "self-gradient-yaw": ("yaw",),
    **dict.fromkeys(("near-sphere", "near-cuboid"), ("mass_x", "mass_y", "mass_z")),
}


def _check_values(
    effect: str, name: str, parameter: InjectedParameter, raw: ArrayLike, count: int
) -> NDArray[np.float64]:
    try:
        value = np.asarray(raw, dtype=np.float64)
        value = np.broadcast_to(value, (count,)) if parameter.per_accelerometer else value.reshape(())
    except (TypeError, ValueError):
        value = np.array(np.nan)
    if np.any(np.isnan(value)):
        numbers = f"{'four' if count == 4 else count} numbers, or one for all,"
        raise UserError(
            f"wrong value for {name} of the effect {effect!r}",
            found=raw,
            expected=f"{numbers if parameter.per_accelerometer else 'one number'} in {parameter.unit}",
        )
    above = value > 0 if parameter.neutral else value >= 0
    if parameter.positive and not np.all(above & (value <= parameter.most)):
        raise UserError(
            f"{name} of the effect {effect!r} is out of range",
            found=f"{value.tolist()} {parameter.unit}",
            expected=f"{'above' if parameter.neutral else 'at least'} 0"
            + (f", at most {parameter.most:g}" if np.isfinite(parameter.most) else ""),
        )
    return value
