"""Signatures: what each candidate effect would add to V_j.

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: adc-nonlinearity, angular-jitter, anisoinertia, arm-length, arm-sag, arm-stretch, balancing-loop, bearing-run-out, bias-drift, bias-hysteresis, bias-step, carrier-gradient, clock-drift, cubic-cross, cubic-input, encoder-harmonic, fuel-gradient, gain-drift, gain-step, gradient-offset, gyro-bias, gyro-delay, gyro-g-sensitivity, gyro-misalignment, gyro-scale, imu-acceleration-bias, imu-acceleration-misalignment, imu-acceleration-quadratic, imu-acceleration-scale, imu-filter, imu-lever-arm, imu-misalignment, imu-skew, imu-thermal, inner-temperature, lag, magnetic-axial-bias, magnetic-bias, magnetic-scale, misalignment-drift, misalignment-step, mount-compliance, mount-hysteresis, mount-resonance, near-mass, odd-quadratic, output-curve, output-filter, output-gain-step, pendulum-angular, pressure-bias, second-order-drift, second-order-loop, second-order-misalignment, second-order-step, self-gradient, self-gradient-yaw, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, spin-rate-offset, spin-servo, thermal-bias, thermal-lag, thermal-misalignment, thermal-scale, thermal-second-order, time-offset, vibration-level, vibration-rectification.
The instrument unexpanded, one accelerometer at a time: V_j at the disc angle plus the constant angle of
its nominal place, and its derivatives; G_out = V_1 + V_2 - V_3 - V_4 (Eq. 15). Units are SI, V in volts.
`inputs` is a (n_inputs, N) array in the order of INPUTS; `p` a vector in the order of PARAMETERS
(one value, or four in the order A1, A2, A3, A4).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

INPUTS: tuple[str, ...] = (
    "a_x",
    "a_y",
    "a_z",
    "omega_x",
    "omega_y",
    "omega_z",
    "omegadot_x",
    "omegadot_y",
    "omegadot_z",
    "Gamma_xx",
    "Gamma_xy",
    "Gamma_xz",
    "Gamma_yy",
    "Gamma_yz",
    "Gamma_zz",
    "B_x",
    "B_y",
    "B_z",
    "heat_rr",
    "heat_rt",
    "heat_start",
    "heat_tt",
    "mount_a_x",
    "mount_a_y",
    "mount_a_z",
    "mount_omega_x",
    "mount_omega_y",
    "mount_omega_z",
    "mount_omegadot_x",
    "mount_omegadot_y",
    "mount_omegadot_z",
    "play_axial",
    "play_radial",
    "play_tangential",
    "slip_axial",
    "slip_radial",
    "slip_tangential",
    "G_out",
    "angular_vibration_rms",
    "balance_current",
    "d2_a_x",
    "d2_a_y",
    "d2_a_z",
    "d2_omegadot_x",
    "d2_omegadot_y",
    "d2_omegadot_z",
    "d2_spin_angle",
    "d_a_x",
    "d_a_y",
    "d_a_z",
    "d_omegadot_x",
    "d_omegadot_y",
    "d_omegadot_z",
    "d_spin_angle",
    "d_temperature",
    "fuel_mass",
    "pitch",
    "pressure",
    "roll",
    "second_order_current",
    "temperature",
    "vibration_rms",
    "yaw",
)
PARAMETERS: tuple[tuple[str, int], ...] = (
    ("radius", 1),
    ("spin_frequency", 1),
    ("dR", 4),
    ("beta_x", 4),
    ("beta_z", 4),
    ("vartheta_x", 4),
    ("vartheta_y", 4),
    ("vartheta_z", 4),
    ("K0", 4),
    ("K1", 4),
    ("K2", 4),
    ("K4", 4),
    ("K5", 4),
    ("K6", 4),
    ("K7", 4),
    ("K8", 4),
    ("k_VI", 4),
)
ROWS: tuple[tuple[str, bool], ...] = (  # derivative of V_j by; True: one value for the instrument
    ("adc-nonlinearity.h", False),
    ("angular-jitter.W_xx", True),
    ("angular-jitter.W_xy", True),
    ("angular-jitter.W_xz", True),
    ("angular-jitter.W_yy", True),
    ("angular-jitter.W_yz", True),
    ("angular-jitter.W_zz", True),
    ("anisoinertia.K_ip", False),
    ("arm-length.delta_R", True),
    ("arm-sag.c_z", False),
    ("arm-stretch.c_r", False),
    ("balancing-loop.dK1_di", False),
    ("balancing-loop.dK2_di", False),
    ("bearing-run-out.c_x1", True),
    ("bearing-run-out.s_x1", True),
    ("bearing-run-out.c_y1", True),
    ("bearing-run-out.s_y1", True),
    ("bearing-run-out.c_z1", True),
    ("bearing-run-out.s_z1", True),
    ("bearing-run-out.c_x2", True),
    ("bearing-run-out.s_x2", True),
    ("bearing-run-out.c_y2", True),
    ("bearing-run-out.s_y2", True),
    ("bearing-run-out.c_z2", True),
    ("bearing-run-out.s_z2", True),
    ("bias-drift.dK0_dt", False),
    ("bias-hysteresis.h_i", False),
    ("bias-hysteresis.h_o", False),
    ("bias-hysteresis.h_p", False),
    ("bias-hysteresis.w", True),
    ("bias-step.dK0", False),
    ("carrier-gradient.G_xx", True),
    ("carrier-gradient.G_xy", True),
    ("carrier-gradient.G_xz", True),
    ("carrier-gradient.G_yy", True),
    ("carrier-gradient.G_yz", True),
    ("carrier-gradient.F_xx", True),
    ("carrier-gradient.F_xy", True),
    ("carrier-gradient.F_xz", True),
    ("carrier-gradient.F_yy", True),
    ("carrier-gradient.F_yz", True),
    ("clock-drift.epsilon", True),
    ("cubic-cross.K_iio", False),
    ("cubic-cross.K_iip", False),
    ("cubic-cross.K_ioo", False),
    ("cubic-cross.K_iop", False),
    ("cubic-cross.K_ipp", False),
    ("cubic-cross.K_ooo", False),
    ("cubic-cross.K_oop", False),
    ("cubic-cross.K_opp", False),
    ("cubic-cross.K_ppp", False),
    ("cubic-input.K_iii", False),
    ("encoder-harmonic.c_1", True),
    ("encoder-harmonic.s_1", True),
    ("encoder-harmonic.c_2", True),
    ("encoder-harmonic.s_2", True),
    ("encoder-harmonic.c_3", True),
    ("encoder-harmonic.s_3", True),
    ("encoder-harmonic.c_4", True),
    ("encoder-harmonic.s_4", True),
    ("fuel-gradient.G_xx", True),
    ("fuel-gradient.G_xy", True),
    ("fuel-gradient.G_xz", True),
    ("fuel-gradient.G_yy", True),
    ("fuel-gradient.G_yz", True),
    ("gain-drift.dK1_dt", False),
    ("gain-step.dK1", False),
    ("gradient-offset.G_xx", True),
    ("gradient-offset.G_xy", True),
    ("gradient-offset.G_xz", True),
    ("gradient-offset.G_yy", True),
    ("gradient-offset.G_yz", True),
    ("gyro-bias.b_x", True),
    ("gyro-bias.b_y", True),
    ("gyro-bias.b_z", True),
    ("gyro-delay.delta_w", True),
    ("gyro-delay.delta_d", True),
    ("gyro-g-sensitivity.d_xx", True),
    ("gyro-g-sensitivity.d_xy", True),
    ("gyro-g-sensitivity.d_xz", True),
    ("gyro-g-sensitivity.d_yx", True),
    ("gyro-g-sensitivity.d_yy", True),
    ("gyro-g-sensitivity.d_yz", True),
    ("gyro-g-sensitivity.d_zx", True),
    ("gyro-g-sensitivity.d_zy", True),
    ("gyro-g-sensitivity.d_zz", True),
    ("gyro-misalignment.m_xy", True),
    ("gyro-misalignment.m_xz", True),
    ("gyro-misalignment.m_yx", True),
    ("gyro-misalignment.m_yz", True),
    ("gyro-misalignment.m_zx", True),
    ("gyro-misalignment.m_zy", True),
    ("gyro-scale.s_x", True),
    ("gyro-scale.s_y", True),
    ("gyro-scale.s_z", True),
    ("imu-acceleration-bias.b_x", True),
    ("imu-acceleration-bias.b_y", True),
    ("imu-acceleration-bias.b_z", True),
    ("imu-acceleration-misalignment.m_xy", True),
    ("imu-acceleration-misalignment.m_xz", True),
    ("imu-acceleration-misalignment.m_yx", True),
    ("imu-acceleration-misalignment.m_yz", True),
    ("imu-acceleration-misalignment.m_zx", True),
    ("imu-acceleration-misalignment.m_zy", True),
    ("imu-acceleration-quadratic.q_x", True),
    ("imu-acceleration-quadratic.q_y", True),
    ("imu-acceleration-scale.s_x", True),
    ("imu-acceleration-scale.s_y", True),
    ("imu-acceleration-scale.s_z", True),
    ("imu-filter.b_a", True),
    ("imu-filter.b_w", True),
    ("imu-lever-arm.l_x", True),
    ("imu-lever-arm.l_y", True),
    ("imu-lever-arm.l_z", True),
    ("imu-misalignment.e_x", True),
    ("imu-misalignment.e_y", True),
    ("imu-misalignment.e_z", True),
    ("imu-skew.delta_x", True),
    ("imu-skew.delta_y", True),
    ("imu-thermal.db_x_dT", True),
    ("imu-thermal.db_y_dT", True),
    ("imu-thermal.ds_x_dT", True),
    ("imu-thermal.ds_y_dT", True),
    ("inner-temperature.b", False),
    ("inner-temperature.s", False),
    ("inner-temperature.b_0", False),
    ("inner-temperature.s_0", False),
    ("inner-temperature.tau", True),
    ("lag.tau", False),
    ("magnetic-axial-bias.dK0_dBz", False),
    ("magnetic-bias.dK0_dB", False),
    ("magnetic-scale.dK1_dB", False),
    ("misalignment-drift.dvartheta_y_dt", False),
    ("misalignment-step.dvartheta_y", False),
    ("mount-compliance.c_yx", False),
    ("mount-compliance.c_yy", False),
    ("mount-compliance.c_yz", False),
    ("mount-compliance.c_zx", False),
    ("mount-compliance.c_zy", False),
    ("mount-compliance.c_zz", False),
    ("mount-hysteresis.e_yx", False),
    ("mount-hysteresis.e_yz", False),
    ("mount-hysteresis.e_zx", False),
    ("mount-hysteresis.w", True),
    ("mount-resonance.share", True),
    ("mount-resonance.f_0", True),
    ("mount-resonance.Q", True),
    ("near-mass.T_xxx", True),
    ("near-mass.T_xxy", True),
    ("near-mass.T_xxz", True),
    ("near-mass.T_xyy", True),
    ("near-mass.T_xyz", True),
    ("near-mass.T_yyy", True),
    ("near-mass.T_yyz", True),
    ("near-mass.T_xxxx", True),
    ("near-mass.T_xxxy", True),
    ("near-mass.T_xxxz", True),
    ("near-mass.T_xxyy", True),
    ("near-mass.T_xxyz", True),
    ("near-mass.T_xyyy", True),
    ("near-mass.T_xyyz", True),
    ("near-mass.T_yyyy", True),
    ("near-mass.T_yyyz", True),
    ("odd-quadratic.K_oq", False),
    ("output-curve.c_2", True),
    ("output-curve.c_3", True),
    ("output-filter.b", True),
    ("output-gain-step.g", True),
    ("pendulum-angular.K_pa", False),
    ("pressure-bias.dK0_dp", False),
    ("second-order-drift.dK2_dt", False),
    ("second-order-loop.b", False),
    ("second-order-misalignment.kappa", True),
    ("second-order-step.dK2", False),
    ("self-gradient.G_xx_roll", True),
    ("self-gradient.G_xy_roll", True),
    ("self-gradient.G_xz_roll", True),
    ("self-gradient.G_yy_roll", True),
    ("self-gradient.G_yz_roll", True),
    ("self-gradient.G_xx_pitch", True),
    ("self-gradient.G_xy_pitch", True),
    ("self-gradient.G_xz_pitch", True),
    ("self-gradient.G_yy_pitch", True),
    ("self-gradient.G_yz_pitch", True),
    ("self-gradient-yaw.G_d", True),
    ("self-gradient-yaw.G_xy", True),
    ("self-gradient-yaw.G_xz", True),
    ("self-gradient-yaw.G_yz", True),
    ("spin-axis-tilt.alpha_x", True),
    ("spin-axis-tilt.alpha_y", True),
    ("spin-axis-wobble.w_x", True),
    ("spin-axis-wobble.w_y", True),
    ("spin-phase-offset.phi_0", True),
    ("spin-rate-jitter.sigma_phi", True),
    ("spin-rate-jitter.sigma_walk", True),
    ("spin-rate-offset.epsilon", True),
    ("spin-servo.c", True),
    ("thermal-bias.dK0_dT", False),
    ("thermal-lag.dK0_dTdot", False),
    ("thermal-lag.dK1_dTdot", False),
    ("thermal-misalignment.dvartheta_y_dT", False),
    ("thermal-scale.dK1_dT", False),
    ("thermal-second-order.dK2_dT", False),
    ("time-offset.delta_t", True),
    ("vibration-level.L_xx", True),
    ("vibration-level.L_xy", True),
    ("vibration-level.L_xz", True),
    ("vibration-level.L_yy", True),
    ("vibration-level.L_yz", True),
    ("vibration-level.L_zz", True),
    ("vibration-rectification.P_xx", True),
    ("vibration-rectification.P_xy", True),
    ("vibration-rectification.P_xz", True),
    ("vibration-rectification.P_yy", True),
    ("vibration-rectification.P_yz", True),
    ("vibration-rectification.P_zz", True),
)
SIZE: int = sum(size for _, size in PARAMETERS)
SIGNS: tuple[int, ...] = (1, 1, -1, -1, )
COS_J: tuple[float, ...] = (1.0, -1.0, 0.0, 0.0, )
SIN_J: tuple[float, ...] = (0.0, 0.0, 1.0, -1.0, )


def accelerometer(j: int, time: Array, cos_phi: Array, sin_phi: Array, inputs: Array, q: Array) -> Array:
    """V_j, (N,), V, of accelerometer j = 0 ... 3; q holds its own value of every parameter."""
    a_x = inputs[0]
    a_y = inputs[1]
    a_z = inputs[2]
    omega_x = inputs[3]
    omega_y = inputs[4]
    omega_z = inputs[5]
    omegadot_x = inputs[6]
    omegadot_y = inputs[7]
    omegadot_z = inputs[8]
    Gamma_xx = inputs[9]
    Gamma_xy = inputs[10]
    Gamma_xz = inputs[11]
    Gamma_yy = inputs[12]
    Gamma_yz = inputs[13]
    Gamma_zz = inputs[14]
    d2_spin_angle = inputs[46]
    d_spin_angle = inputs[53]
    radius = q[0]
    dR = q[2]
    beta_x = q[3]
    beta_z = q[4]
    vartheta_y = q[6]
    vartheta_z = q[7]
    K0 = q[8]
    K1 = q[9]
    K2 = q[10]
    K4 = q[11]
    K5 = q[12]
    K6 = q[13]
    K7 = q[14]
    K8 = q[15]
    k_VI = q[16]
    cos_j, sin_j = COS_J[j], SIN_J[j]
    x0 = omega_y**2.0
    x1 = d_spin_angle + omega_z
    x2 = -x1
    x3 = -x1*x2
    M_xx = -Gamma_xx - x0 - x3
    x4 = d2_spin_angle + omegadot_z
    M_xy = -Gamma_xy + omega_x*omega_y - x4
    x5 = d_spin_angle*omega_x
    M_xz = -Gamma_xz - omega_x*x2 + omegadot_y - x5
    M_yx = -Gamma_xy + omega_x*omega_y + x4
    x6 = omega_x**2.0
    M_yy = -Gamma_yy - x3 - x6
    x7 = d_spin_angle*omega_y
    M_yz = -Gamma_yz + omega_y*x1 - omegadot_x - x7
    M_zx = -Gamma_xz + omega_x*x1 - omegadot_y + x5
    M_zy = -Gamma_yz - omega_y*x2 + omegadot_x + x7
    M_zz = -Gamma_zz - x0 - x6
    cos_psi = cos_j*cos_phi - sin_j*sin_phi
    sin_psi = cos_j*sin_phi + cos_phi*sin_j
    x8 = dR + radius
    f_disc_r_x = x8
    f_disc_r_y = beta_z*x8
    f_disc_r_z = beta_x*x8
    f_disc_tau_zy = -beta_x*beta_z
    f_r_x = cos_psi*f_disc_r_x - f_disc_r_y*sin_psi
    f_r_y = cos_psi*f_disc_r_y + f_disc_r_x*sin_psi
    x9 = beta_z*cos_psi + sin_psi
    f_tau_xx = -x9
    x10 = -beta_z*sin_psi + cos_psi
    f_tau_xy = x10
    f_tau_yx = x10
    f_tau_yy = x9
    f_tau_zx = -beta_x*cos_psi - f_disc_tau_zy*sin_psi
    f_tau_zy = -beta_x*sin_psi + cos_psi*f_disc_tau_zy
    f_f_x = M_xx*f_r_x + M_xy*f_r_y + M_xz*f_disc_r_z + a_x
    f_f_y = M_yx*f_r_x + M_yy*f_r_y + M_yz*f_disc_r_z + a_y
    f_f_z = M_zx*f_r_x + M_zy*f_r_y + M_zz*f_disc_r_z + a_z
    f_f_xj = f_f_x*f_tau_xx + f_f_y*f_tau_xy
    f_f_yj = -beta_x*f_f_z + f_f_x*f_tau_yx + f_f_y*f_tau_yy
    f_f_zj = f_f_x*f_tau_zx + f_f_y*f_tau_zy - f_f_z
    f_f_i = f_f_xj + f_f_yj*vartheta_z - f_f_zj*vartheta_y
    q_disc_r_x = x8
    q_r_x = cos_psi*q_disc_r_x
    q_r_y = q_disc_r_x*sin_psi
    q_f_x = M_xx*q_r_x + M_xy*q_r_y + a_x
    q_f_y = M_yx*q_r_x + M_yy*q_r_y + a_y
    q_f_z = M_zx*q_r_x + M_zy*q_r_y + a_z
    q_f_xj = cos_psi*q_f_y - q_f_x*sin_psi
    q_f_yj = cos_psi*q_f_x + q_f_y*sin_psi
    i_sensed = K0 + K2*q_f_xj**2.0 - K4*q_f_xj*q_f_z + K5*q_f_yj**2.0 + K6*q_f_xj*q_f_yj + K7*q_f_z**2.0 - K8*q_f_yj*q_f_z + f_f_i
    V = K1*i_sensed*k_VI

    return np.asarray(V) + np.zeros(len(time))


def derivatives(j: int, time: Array, cos_phi: Array, sin_phi: Array, inputs: Array, q: Array) -> Array:
    """Derivatives of V_j, (len(ROWS), N), in the order of ROWS."""
    a_x = inputs[0]
    a_y = inputs[1]
    a_z = inputs[2]
    omega_x = inputs[3]
    omega_y = inputs[4]
    omega_z = inputs[5]
    omegadot_x = inputs[6]
    omegadot_y = inputs[7]
    omegadot_z = inputs[8]
    Gamma_xx = inputs[9]
    Gamma_xy = inputs[10]
    Gamma_xz = inputs[11]
    Gamma_yy = inputs[12]
    Gamma_yz = inputs[13]
    Gamma_zz = inputs[14]
    B_x = inputs[15]
    B_y = inputs[16]
    B_z = inputs[17]
    C__heat_rr = inputs[18]
    C__heat_rt = inputs[19]
    C__heat_start = inputs[20]
    C__heat_tt = inputs[21]
    C__mount_a_x = inputs[22]
    C__mount_a_y = inputs[23]
    C__mount_a_z = inputs[24]
    C__mount_omega_x = inputs[25]
    C__mount_omega_y = inputs[26]
    C__mount_omega_z = inputs[27]
    C__mount_omegadot_x = inputs[28]
    C__mount_omegadot_y = inputs[29]
    C__mount_omegadot_z = inputs[30]
    C__play_axial = inputs[31]
    C__play_radial = inputs[32]
    C__play_tangential = inputs[33]
    C__slip_axial = inputs[34]
    C__slip_radial = inputs[35]
    C__slip_tangential = inputs[36]
    G_out = inputs[37]
    angular_vibration_rms = inputs[38]
    balance_current = inputs[39]
    d2_a_x = inputs[40]
    d2_a_y = inputs[41]
    d2_a_z = inputs[42]
    d2_omegadot_x = inputs[43]
    d2_omegadot_y = inputs[44]
    d2_omegadot_z = inputs[45]
    d2_spin_angle = inputs[46]
    d_a_x = inputs[47]
    d_a_y = inputs[48]
    d_a_z = inputs[49]
    d_omegadot_x = inputs[50]
    d_omegadot_y = inputs[51]
    d_omegadot_z = inputs[52]
    d_spin_angle = inputs[53]
    d_temperature = inputs[54]
    fuel_mass = inputs[55]
    pitch = inputs[56]
    pressure = inputs[57]
    roll = inputs[58]
    second_order_current = inputs[59]
    temperature = inputs[60]
    vibration_rms = inputs[61]
    yaw = inputs[62]
    radius = q[0]
    dR = q[2]
    beta_x = q[3]
    beta_z = q[4]
    vartheta_x = q[5]
    vartheta_y = q[6]
    vartheta_z = q[7]
    K0 = q[8]
    K1 = q[9]
    K2 = q[10]
    K4 = q[11]
    K5 = q[12]
    K6 = q[13]
    K7 = q[14]
    K8 = q[15]
    k_VI = q[16]
    cos_j, sin_j = COS_J[j], SIN_J[j]
    x0 = np.cos(pitch)
    x1 = np.cos(yaw)
    attitude_xx = x0*x1
    x2 = np.sin(yaw)
    x3 = np.cos(roll)
    x4 = x2*x3
    x5 = np.sin(pitch)
    x6 = np.sin(roll)
    x7 = x1*x6
    attitude_xy = -x4 + x5*x7
    x8 = x2*x6
    x9 = x1*x3
    attitude_xz = x5*x9 + x8
    attitude_yx = x0*x2
    attitude_yy = x5*x8 + x9
    attitude_yz = x4*x5 - x7
    attitude_zx = -x5
    attitude_zy = x0*x6
    attitude_zz = x0*x3
    cos_yaw = x1
    sin_yaw = x2
    x10 = omega_y**2.0
    x11 = d_spin_angle + omega_z
    x12 = -x11
    x13 = -x11*x12
    M_xx = -Gamma_xx - x10 - x13
    x14 = d2_spin_angle + omegadot_z
    x15 = omega_x*omega_y
    x16 = Gamma_xy - x15
    M_xy = -x14 - x16
    x17 = -omegadot_y
    x18 = d_spin_angle*omega_x
    x19 = x17 + x18
    M_xz = -Gamma_xz - omega_x*x12 - x19
    x20 = omegadot_z + x15
    x21 = -Gamma_xy + x20
    M_yx = d2_spin_angle + x21
    x22 = omega_x**2.0
    M_yy = -Gamma_yy - x13 - x22
    x23 = d_spin_angle*omega_y
    x24 = omegadot_x + x23
    M_yz = -Gamma_yz + omega_y*x11 - x24
    x25 = Gamma_xz + omegadot_y
    M_zx = omega_x*x11 + x18 - x25
    x26 = -omegadot_x
    M_zy = -Gamma_yz - omega_y*x12 + x23 - x26
    x27 = x10 + x22
    x28 = -Gamma_zz - x27
    M_zz = x28
    cos_psi = cos_j*cos_phi - sin_j*sin_phi
    sin_psi = cos_j*sin_phi + cos_phi*sin_j
    x29 = dR + radius
    b_disc_r_x = x29
    x30 = beta_z*x29
    b_disc_r_y = x30
    x31 = beta_x*x29
    b_disc_r_z = x31
    x32 = -beta_x*beta_z
    b_disc_tau_zy = x32
    b_r_x = b_disc_r_x*cos_psi - b_disc_r_y*sin_psi
    b_r_y = b_disc_r_x*sin_psi + b_disc_r_y*cos_psi
    x33 = beta_z*cos_psi + sin_psi
    x34 = -x33
    b_tau_xx = x34
    x35 = -beta_z*sin_psi + cos_psi
    b_tau_xy = x35
    b_tau_yx = x35
    b_tau_yy = x33
    x36 = beta_x*cos_psi
    b_tau_zx = -b_disc_tau_zy*sin_psi - x36
    x37 = beta_x*sin_psi
    b_tau_zy = b_disc_tau_zy*cos_psi - x37
    x38 = d_spin_angle*sin_phi
    x39 = -x38
    rate_cos_phi_true = x39
    x40 = cos_phi*d_spin_angle
    rate_sin_phi_true = x40
    x41 = d2_spin_angle*sin_phi
    x42 = d_spin_angle**2.0
    x43 = cos_phi*x42
    x44 = -x41 - x43
    rate_rate_cos_phi_true = x44
    x45 = cos_phi*d2_spin_angle
    x46 = sin_phi*x42
    x47 = x45 - x46
    rate_rate_sin_phi_true = x47
    b_f_x = M_xx*b_r_x + M_xy*b_r_y + M_xz*b_disc_r_z + a_x
    b_f_y = M_yx*b_r_x + M_yy*b_r_y + M_yz*b_disc_r_z + a_y
    b_f_z = M_zx*b_r_x + M_zy*b_r_y + M_zz*b_disc_r_z + a_z
    b_f_xj = b_f_x*b_tau_xx + b_f_y*b_tau_xy
    b_f_yj = b_f_x*b_tau_yx + b_f_y*b_tau_yy - b_f_z*beta_x
    b_f_zj = b_f_x*b_tau_zx + b_f_y*b_tau_zy - b_f_z
    f_disc_r_x = x29
    f_disc_r_y = x30
    f_disc_r_z = x31
    f_disc_tau_zy = x32
    f_r_x = cos_psi*f_disc_r_x - f_disc_r_y*sin_psi
    f_r_y = cos_psi*f_disc_r_y + f_disc_r_x*sin_psi
    f_tau_xx = x34
    f_tau_xy = x35
    f_tau_yx = x35
    f_tau_yy = x33
    f_tau_zx = -f_disc_tau_zy*sin_psi - x36
    f_tau_zy = cos_psi*f_disc_tau_zy - x37
    x48 = x29**(-1.0)
    f_arm_x = f_r_x*x48
    f_arm_y = f_r_y*x48
    f_arm_z = f_disc_r_z*x48
    x49 = 2.0*omega_y
    x50 = omegadot_y*x49
    x51 = 2.0*d_spin_angle
    x52 = 2.0*omega_z
    x53 = -x51 - x52
    x54 = d2_spin_angle*x53 + omegadot_z*x53
    x55 = -x50 + x54
    rate_M_xx = x55
    x56 = omega_x*omegadot_y + omega_y*omegadot_x
    x57 = -d_omegadot_z + x56
    rate_M_xy = x57
    x58 = omega_x*omegadot_z
    x59 = d_omegadot_y + omega_z*omegadot_x + x58
    rate_M_xz = x59
    V2__rate_cos_phi_true = x39
    V2__rate_sin_phi_true = x40
    rate_cos_psi = V2__rate_cos_phi_true*cos_j - V2__rate_sin_phi_true*sin_j
    rate_sin_psi = V2__rate_cos_phi_true*sin_j + V2__rate_sin_phi_true*cos_j
    rate_b_r_x = b_disc_r_x*rate_cos_psi - b_disc_r_y*rate_sin_psi
    rate_b_r_y = b_disc_r_x*rate_sin_psi + b_disc_r_y*rate_cos_psi
    rate_b_f_x = M_xx*rate_b_r_x + M_xy*rate_b_r_y + b_disc_r_z*rate_M_xz + b_r_x*rate_M_xx + b_r_y*rate_M_xy + d_a_x
    x60 = d_omegadot_z + x56
    rate_M_yx = x60
    x61 = 2.0*omegadot_x
    x62 = omega_x*x61
    x63 = x54 - x62
    rate_M_yy = x63
    x64 = omega_y*omegadot_z
    x65 = -d_omegadot_x + omega_z*omegadot_y + x64
    rate_M_yz = x65
    rate_b_f_y = M_yx*rate_b_r_x + M_yy*rate_b_r_y + b_disc_r_z*rate_M_yz + b_r_x*rate_M_yx + b_r_y*rate_M_yy + d_a_y
    x66 = 2.0*d2_spin_angle
    x67 = omega_z + x51
    x68 = -d_omegadot_y + omega_x*x66 + omegadot_x*x67 + x58
    rate_M_zx = x68
    x69 = d_omegadot_x + omega_y*x66 + omegadot_y*x67 + x64
    rate_M_zy = x69
    x70 = -x50 - x62
    rate_M_zz = x70
    rate_b_f_z = M_zx*rate_b_r_x + M_zy*rate_b_r_y + b_disc_r_z*rate_M_zz + b_r_x*rate_M_zx + b_r_y*rate_M_zy + d_a_z
    rate_b_tau_yx = -beta_z*rate_sin_psi + rate_cos_psi
    rate_b_tau_yy = beta_z*rate_cos_psi + rate_sin_psi
    rate_b_f_yj = b_f_x*rate_b_tau_yx + b_f_y*rate_b_tau_yy + b_tau_yx*rate_b_f_x + b_tau_yy*rate_b_f_y - beta_x*rate_b_f_z
    rate_b_tau_zx = -b_disc_tau_zy*rate_sin_psi - beta_x*rate_cos_psi
    rate_b_tau_zy = b_disc_tau_zy*rate_cos_psi - beta_x*rate_sin_psi
    rate_b_f_zj = b_f_x*rate_b_tau_zx + b_f_y*rate_b_tau_zy + b_tau_zx*rate_b_f_x + b_tau_zy*rate_b_f_y - rate_b_f_z
    rate_V2__rate_cos_phi_true = x44
    rate_V2__rate_sin_phi_true = x47
    x71 = 2.0*omegadot_y**2.0
    x72 = d_omegadot_y*x49
    x73 = 2.0*omegadot_z
    x74 = -x66 - x73
    x75 = d2_spin_angle*x74 + d_omegadot_z*x53 + omegadot_z*x74
    x76 = -x71 - x72 + x75
    rate_rate_M_xx = x76
    x77 = d_omegadot_x*omega_y + d_omegadot_y*omega_x + omegadot_y*x61
    x78 = -d2_omegadot_z + x77
    rate_rate_M_xy = x78
    x79 = d_omegadot_z*omega_x
    x80 = d2_omegadot_y + d_omegadot_x*omega_z + omegadot_x*x73 + x79
    rate_rate_M_xz = x80
    rate_rate_cos_psi = cos_j*rate_V2__rate_cos_phi_true - rate_V2__rate_sin_phi_true*sin_j
    rate_rate_sin_psi = cos_j*rate_V2__rate_sin_phi_true + rate_V2__rate_cos_phi_true*sin_j
    rate_rate_b_r_x = b_disc_r_x*rate_rate_cos_psi - b_disc_r_y*rate_rate_sin_psi
    rate_rate_b_r_y = b_disc_r_x*rate_rate_sin_psi + b_disc_r_y*rate_rate_cos_psi
    x81 = 2.0*rate_b_r_x
    x82 = 2.0*rate_b_r_y
    rate_rate_b_f_x = M_xx*rate_rate_b_r_x + M_xy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_xz + b_r_x*rate_rate_M_xx + b_r_y*rate_rate_M_xy + d2_a_x + rate_M_xx*x81 + rate_M_xy*x82
    x83 = d2_omegadot_z + x77
    rate_rate_M_yx = x83
    x84 = 2.0*omegadot_x**2.0
    x85 = 2.0*omega_x
    x86 = d_omegadot_x*x85
    x87 = x75 - x84 - x86
    rate_rate_M_yy = x87
    x88 = d_omegadot_z*omega_y
    x89 = -d2_omegadot_x + d_omegadot_y*omega_z + omegadot_y*x73 + x88
    rate_rate_M_yz = x89
    rate_rate_b_f_y = M_yx*rate_rate_b_r_x + M_yy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_yz + b_r_x*rate_rate_M_yx + b_r_y*rate_rate_M_yy + d2_a_y + rate_M_yx*x81 + rate_M_yy*x82
    x90 = omegadot_z + x66
    x91 = -d2_omegadot_y + d_omegadot_x*x67 + omegadot_x*omegadot_z + omegadot_x*x66 + omegadot_x*x90 + x79
    rate_rate_M_zx = x91
    x92 = d2_omegadot_x + d_omegadot_y*x67 + omegadot_y*omegadot_z + omegadot_y*x66 + omegadot_y*x90 + x88
    rate_rate_M_zy = x92
    x93 = -x71 - x72 - x84 - x86
    rate_rate_M_zz = x93
    rate_rate_b_f_z = M_zx*rate_rate_b_r_x + M_zy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_zz + b_r_x*rate_rate_M_zx + b_r_y*rate_rate_M_zy + d2_a_z + rate_M_zx*x81 + rate_M_zy*x82
    rate_rate_b_tau_yx = -beta_z*rate_rate_sin_psi + rate_rate_cos_psi
    rate_rate_b_tau_yy = beta_z*rate_rate_cos_psi + rate_rate_sin_psi
    x94 = 2.0*rate_b_f_x
    x95 = 2.0*rate_b_f_y
    rate_rate_b_f_yj = b_f_x*rate_rate_b_tau_yx + b_f_y*rate_rate_b_tau_yy + b_tau_yx*rate_rate_b_f_x + b_tau_yy*rate_rate_b_f_y - beta_x*rate_rate_b_f_z + rate_b_tau_yx*x94 + rate_b_tau_yy*x95
    rate_rate_b_tau_zx = -b_disc_tau_zy*rate_rate_sin_psi - beta_x*rate_rate_cos_psi
    rate_rate_b_tau_zy = b_disc_tau_zy*rate_rate_cos_psi - beta_x*rate_rate_sin_psi
    rate_rate_b_f_zj = b_f_x*rate_rate_b_tau_zx + b_f_y*rate_rate_b_tau_zy + b_tau_zx*rate_rate_b_f_x + b_tau_zy*rate_rate_b_f_y + rate_b_tau_zx*x94 + rate_b_tau_zy*x95 - rate_rate_b_f_z
    f_f_x = M_xx*f_r_x + M_xy*f_r_y + M_xz*f_disc_r_z + a_x
    f_f_y = M_yx*f_r_x + M_yy*f_r_y + M_yz*f_disc_r_z + a_y
    f_f_z = M_zx*f_r_x + M_zy*f_r_y + M_zz*f_disc_r_z + a_z
    f_f_xj = f_f_x*f_tau_xx + f_f_y*f_tau_xy
    f_f_yj = -beta_x*f_f_z + f_f_x*f_tau_yx + f_f_y*f_tau_yy
    f_f_zj = f_f_x*f_tau_zx + f_f_y*f_tau_zy - f_f_z
    f_f_i = f_f_xj + f_f_yj*vartheta_z - f_f_zj*vartheta_y
    f_f_o = -f_f_xj*vartheta_z + f_f_yj + f_f_zj*vartheta_x
    f_f_p = f_f_xj*vartheta_y - f_f_yj*vartheta_x + f_f_zj
    q_disc_r_x = x29
    q_r_x = cos_psi*q_disc_r_x
    q_r_y = q_disc_r_x*sin_psi
    q_arm_x = q_r_x*x48
    q_arm_y = q_r_y*x48
    q_f_x = M_xx*q_r_x + M_xy*q_r_y + a_x
    q_f_y = M_yx*q_r_x + M_yy*q_r_y + a_y
    q_f_z = M_zx*q_r_x + M_zy*q_r_y + a_z
    q_f_xj = cos_psi*q_f_y - q_f_x*sin_psi
    q_f_yj = cos_psi*q_f_x + q_f_y*sin_psi
    x96 = K6*q_f_yj
    x97 = q_f_xj**2.0
    x98 = K4*q_f_z
    x99 = K8*q_f_z
    i_sensed = K0 + K2*x97 + K5*q_f_yj**2.0 + K7*q_f_z**2.0 + f_f_i + q_f_xj*x96 - q_f_xj*x98 - q_f_yj*x99
    V2__rate_M_xx = x55
    V2__rate_M_xy = x57
    V2__rate_M_xz = x59
    V2__rate_cos_psi = cos_j*rate_cos_phi_true - rate_sin_phi_true*sin_j
    V2__rate_sin_psi = cos_j*rate_sin_phi_true + rate_cos_phi_true*sin_j
    rate_f_r_x = V2__rate_cos_psi*f_disc_r_x - V2__rate_sin_psi*f_disc_r_y
    rate_f_r_y = V2__rate_cos_psi*f_disc_r_y + V2__rate_sin_psi*f_disc_r_x
    rate_f_f_x = M_xx*rate_f_r_x + M_xy*rate_f_r_y + V2__rate_M_xx*f_r_x + V2__rate_M_xy*f_r_y + V2__rate_M_xz*f_disc_r_z + d_a_x
    V2__rate_M_yx = x60
    V2__rate_M_yy = x63
    V2__rate_M_yz = x65
    rate_f_f_y = M_yx*rate_f_r_x + M_yy*rate_f_r_y + V2__rate_M_yx*f_r_x + V2__rate_M_yy*f_r_y + V2__rate_M_yz*f_disc_r_z + d_a_y
    x100 = V2__rate_cos_psi*beta_z + V2__rate_sin_psi
    rate_f_tau_xx = -x100
    x101 = V2__rate_cos_psi - V2__rate_sin_psi*beta_z
    rate_f_tau_xy = x101
    rate_f_f_xj = f_f_x*rate_f_tau_xx + f_f_y*rate_f_tau_xy + f_tau_xx*rate_f_f_x + f_tau_xy*rate_f_f_y
    V2__rate_M_zx = x68
    V2__rate_M_zy = x69
    V2__rate_M_zz = x70
    rate_f_f_z = M_zx*rate_f_r_x + M_zy*rate_f_r_y + V2__rate_M_zx*f_r_x + V2__rate_M_zy*f_r_y + V2__rate_M_zz*f_disc_r_z + d_a_z
    rate_f_tau_yx = x101
    rate_f_tau_yy = x100
    rate_f_f_yj = -beta_x*rate_f_f_z + f_f_x*rate_f_tau_yx + f_f_y*rate_f_tau_yy + f_tau_yx*rate_f_f_x + f_tau_yy*rate_f_f_y
    rate_f_tau_zx = -V2__rate_cos_psi*beta_x - V2__rate_sin_psi*f_disc_tau_zy
    rate_f_tau_zy = V2__rate_cos_psi*f_disc_tau_zy - V2__rate_sin_psi*beta_x
    rate_f_f_zj = f_f_x*rate_f_tau_zx + f_f_y*rate_f_tau_zy + f_tau_zx*rate_f_f_x + f_tau_zy*rate_f_f_y - rate_f_f_z
    rate_f_f_i = rate_f_f_xj + rate_f_f_yj*vartheta_z - rate_f_f_zj*vartheta_y
    rate_V2__rate_M_xx = x76
    rate_V2__rate_M_xy = x78
    rate_V2__rate_M_xz = x80
    rate_V2__rate_cos_psi = cos_j*rate_rate_cos_phi_true - rate_rate_sin_phi_true*sin_j
    rate_V2__rate_sin_psi = cos_j*rate_rate_sin_phi_true + rate_rate_cos_phi_true*sin_j
    rate_rate_f_r_x = f_disc_r_x*rate_V2__rate_cos_psi - f_disc_r_y*rate_V2__rate_sin_psi
    rate_rate_f_r_y = f_disc_r_x*rate_V2__rate_sin_psi + f_disc_r_y*rate_V2__rate_cos_psi
    x102 = 2.0*rate_f_r_x
    x103 = 2.0*rate_f_r_y
    rate_rate_f_f_x = M_xx*rate_rate_f_r_x + M_xy*rate_rate_f_r_y + V2__rate_M_xx*x102 + V2__rate_M_xy*x103 + d2_a_x + f_disc_r_z*rate_V2__rate_M_xz + f_r_x*rate_V2__rate_M_xx + f_r_y*rate_V2__rate_M_xy
    rate_V2__rate_M_yx = x83
    rate_V2__rate_M_yy = x87
    rate_V2__rate_M_yz = x89
    rate_rate_f_f_y = M_yx*rate_rate_f_r_x + M_yy*rate_rate_f_r_y + V2__rate_M_yx*x102 + V2__rate_M_yy*x103 + d2_a_y + f_disc_r_z*rate_V2__rate_M_yz + f_r_x*rate_V2__rate_M_yx + f_r_y*rate_V2__rate_M_yy
    x104 = beta_z*rate_V2__rate_cos_psi + rate_V2__rate_sin_psi
    rate_rate_f_tau_xx = -x104
    x105 = -beta_z*rate_V2__rate_sin_psi + rate_V2__rate_cos_psi
    rate_rate_f_tau_xy = x105
    x106 = 2.0*rate_f_f_x
    x107 = 2.0*rate_f_f_y
    rate_rate_f_f_xj = f_f_x*rate_rate_f_tau_xx + f_f_y*rate_rate_f_tau_xy + f_tau_xx*rate_rate_f_f_x + f_tau_xy*rate_rate_f_f_y + rate_f_tau_xx*x106 + rate_f_tau_xy*x107
    rate_V2__rate_M_zx = x91
    rate_V2__rate_M_zy = x92
    rate_V2__rate_M_zz = x93
    rate_rate_f_f_z = M_zx*rate_rate_f_r_x + M_zy*rate_rate_f_r_y + V2__rate_M_zx*x102 + V2__rate_M_zy*x103 + d2_a_z + f_disc_r_z*rate_V2__rate_M_zz + f_r_x*rate_V2__rate_M_zx + f_r_y*rate_V2__rate_M_zy
    rate_rate_f_tau_yx = x105
    rate_rate_f_tau_yy = x104
    rate_rate_f_f_yj = -beta_x*rate_rate_f_f_z + f_f_x*rate_rate_f_tau_yx + f_f_y*rate_rate_f_tau_yy + f_tau_yx*rate_rate_f_f_x + f_tau_yy*rate_rate_f_f_y + rate_f_tau_yx*x106 + rate_f_tau_yy*x107
    rate_rate_f_tau_zx = -beta_x*rate_V2__rate_cos_psi - f_disc_tau_zy*rate_V2__rate_sin_psi
    rate_rate_f_tau_zy = -beta_x*rate_V2__rate_sin_psi + f_disc_tau_zy*rate_V2__rate_cos_psi
    rate_rate_f_f_zj = f_f_x*rate_rate_f_tau_zx + f_f_y*rate_rate_f_tau_zy + f_tau_zx*rate_rate_f_f_x + f_tau_zy*rate_rate_f_f_y + rate_f_tau_zx*x106 + rate_f_tau_zy*x107 - rate_rate_f_f_z
    rate_rate_f_f_i = rate_rate_f_f_xj + rate_rate_f_f_yj*vartheta_z - rate_rate_f_f_zj*vartheta_y
    rate_q_r_x = V2__rate_cos_psi*q_disc_r_x
    rate_q_r_y = V2__rate_sin_psi*q_disc_r_x
    rate_q_f_x = M_xx*rate_q_r_x + M_xy*rate_q_r_y + V2__rate_M_xx*q_r_x + V2__rate_M_xy*q_r_y + d_a_x
    rate_q_f_y = M_yx*rate_q_r_x + M_yy*rate_q_r_y + V2__rate_M_yx*q_r_x + V2__rate_M_yy*q_r_y + d_a_y
    rate_q_f_xj = V2__rate_cos_psi*q_f_y - V2__rate_sin_psi*q_f_x + cos_psi*rate_q_f_y - rate_q_f_x*sin_psi
    rate_q_f_yj = V2__rate_cos_psi*q_f_x + V2__rate_sin_psi*q_f_y + cos_psi*rate_q_f_x + rate_q_f_y*sin_psi
    rate_q_f_z = M_zx*rate_q_r_x + M_zy*rate_q_r_y + V2__rate_M_zx*q_r_x + V2__rate_M_zy*q_r_y + d_a_z
    rate_rate_q_r_x = q_disc_r_x*rate_V2__rate_cos_psi
    rate_rate_q_r_y = q_disc_r_x*rate_V2__rate_sin_psi
    x108 = 2.0*rate_q_r_x
    x109 = 2.0*rate_q_r_y
    rate_rate_q_f_x = M_xx*rate_rate_q_r_x + M_xy*rate_rate_q_r_y + V2__rate_M_xx*x108 + V2__rate_M_xy*x109 + d2_a_x + q_r_x*rate_V2__rate_M_xx + q_r_y*rate_V2__rate_M_xy
    rate_rate_q_f_y = M_yx*rate_rate_q_r_x + M_yy*rate_rate_q_r_y + V2__rate_M_yx*x108 + V2__rate_M_yy*x109 + d2_a_y + q_r_x*rate_V2__rate_M_yx + q_r_y*rate_V2__rate_M_yy
    x110 = 2.0*rate_q_f_y
    x111 = 2.0*rate_q_f_x
    rate_rate_q_f_xj = V2__rate_cos_psi*x110 - V2__rate_sin_psi*x111 + cos_psi*rate_rate_q_f_y - q_f_x*rate_V2__rate_sin_psi + q_f_y*rate_V2__rate_cos_psi - rate_rate_q_f_x*sin_psi
    rate_rate_q_f_yj = V2__rate_cos_psi*x111 + V2__rate_sin_psi*x110 + cos_psi*rate_rate_q_f_x + q_f_x*rate_V2__rate_cos_psi + q_f_y*rate_V2__rate_sin_psi + rate_rate_q_f_y*sin_psi
    rate_rate_q_f_z = M_zx*rate_rate_q_r_x + M_zy*rate_rate_q_r_y + V2__rate_M_zx*x108 + V2__rate_M_zy*x109 + d2_a_z + q_r_x*rate_V2__rate_M_zx + q_r_y*rate_V2__rate_M_zy
    x112 = 2.0*K2
    x113 = 2.0*K5
    x114 = 2.0*K7
    x115 = q_f_xj*x112 + x96 - x98
    x116 = K6*q_f_xj + q_f_yj*x113 - x99
    x117 = K4*q_f_xj + K8*q_f_yj - q_f_z*x114
    rate_rate_i_sensed = rate_q_f_xj*(-K4*rate_q_f_z + K6*rate_q_f_yj + rate_q_f_xj*x112) + rate_q_f_yj*(K6*rate_q_f_xj - K8*rate_q_f_z + rate_q_f_yj*x113) - rate_q_f_z*(K4*rate_q_f_xj + K8*rate_q_f_yj - rate_q_f_z*x114) + rate_rate_f_f_i + rate_rate_q_f_xj*x115 + rate_rate_q_f_yj*x116 - rate_rate_q_f_z*x117
    x118 = f_tau_xx + f_tau_yx*vartheta_z - f_tau_zx*vartheta_y
    vibration_axis_ix = x118
    x119 = f_tau_xy + f_tau_yy*vartheta_z - f_tau_zy*vartheta_y
    vibration_axis_iy = x119
    x120 = -beta_x*vartheta_z + vartheta_y
    vibration_axis_iz = x120
    vibration_axis_ox = -f_tau_xx*vartheta_z + f_tau_yx + f_tau_zx*vartheta_x
    vibration_axis_oy = -f_tau_xy*vartheta_z + f_tau_yy + f_tau_zy*vartheta_x
    vibration_axis_oz = -beta_x - vartheta_x
    vibration_axis_px = f_tau_xx*vartheta_y - f_tau_yx*vartheta_x + f_tau_zx
    vibration_axis_py = f_tau_xy*vartheta_y - f_tau_yy*vartheta_x + f_tau_zy
    vibration_axis_pz = beta_x*vartheta_x - 1
    bar_i_vibration_rectification = K1*k_VI
    bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x117
    bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x116
    bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x115
    bar_q_f_y = bar_q_i_second_order_misalignment*cos_psi + bar_q_o_second_order_misalignment*sin_psi
    bar_q_f_x = -bar_q_i_second_order_misalignment*sin_psi + bar_q_o_second_order_misalignment*cos_psi
    bar_q_spin_axis_wobble_tau_yz = bar_q_o_second_order_misalignment*q_f_z
    bar_q_spin_axis_wobble_tau_yy = bar_q_o_second_order_misalignment*q_f_y
    bar_q_spin_axis_wobble_tau_yx = bar_q_o_second_order_misalignment*q_f_x
    bar_q_spin_axis_wobble_tau_xz = bar_q_i_second_order_misalignment*q_f_z
    bar_q_spin_axis_wobble_tau_xy = bar_q_i_second_order_misalignment*q_f_y
    bar_q_spin_axis_wobble_tau_xx = bar_q_i_second_order_misalignment*q_f_x
    bar_q_spin_axis_wobble_r_z = M_xz*bar_q_f_x + M_yz*bar_q_f_y - M_zz*bar_q_p_second_order_misalignment
    bar_q_spin_axis_wobble_r_y = M_xy*bar_q_f_x + M_yy*bar_q_f_y - M_zy*bar_q_p_second_order_misalignment
    bar_q_spin_axis_wobble_r_x = M_xx*bar_q_f_x + M_yx*bar_q_f_y - M_zx*bar_q_p_second_order_misalignment
    bar_q_disc_r_x = bar_q_spin_axis_wobble_r_x*cos_psi + bar_q_spin_axis_wobble_r_y*sin_psi
    bar_f_f_zj = -bar_i_vibration_rectification*vartheta_y
    bar_f_f_yj = bar_i_vibration_rectification*vartheta_z
    bar_f_f_z = -bar_f_f_yj*beta_x - bar_f_f_zj
    bar_f_f_y = bar_f_f_yj*f_tau_yy + bar_f_f_zj*f_tau_zy + bar_i_vibration_rectification*f_tau_xy
    bar_f_f_x = bar_f_f_yj*f_tau_yx + bar_f_f_zj*f_tau_zx + bar_i_vibration_rectification*f_tau_xx
    bar_rate_rate_dR_arm_stretch = bar_f_f_x*f_arm_x + bar_f_f_y*f_arm_y + bar_f_f_z*f_arm_z + bar_q_f_x*q_arm_x + bar_q_f_y*q_arm_y
    x121 = 2.0*x11
    bar_rate_dR_arm_stretch = bar_f_f_x*(-f_arm_y*x121 + 2.0*f_arm_z*omega_y) + bar_f_f_y*(f_arm_x*x121 - f_arm_z*x85) + bar_f_f_z*(-f_arm_x*x49 + 2.0*f_arm_y*omega_x) - bar_q_f_x*q_arm_y*x121 + bar_q_f_y*q_arm_x*x121 - bar_q_p_second_order_misalignment*(-q_arm_x*x49 + q_arm_y*x85)
    bar_f_spin_axis_wobble_tau_zz = bar_f_f_zj*f_f_z
    bar_f_spin_axis_wobble_tau_zy = bar_f_f_zj*f_f_y
    bar_f_spin_axis_wobble_tau_zx = bar_f_f_zj*f_f_x
    bar_f_spin_axis_wobble_tau_yz = bar_f_f_yj*f_f_z
    bar_f_spin_axis_wobble_tau_yy = bar_f_f_yj*f_f_y
    bar_f_spin_axis_wobble_tau_yx = bar_f_f_yj*f_f_x
    bar_f_spin_axis_wobble_tau_xz = bar_i_vibration_rectification*f_f_z
    bar_f_spin_axis_wobble_tau_xy = bar_i_vibration_rectification*f_f_y
    bar_f_spin_axis_wobble_tau_xx = bar_i_vibration_rectification*f_f_x
    bar_f_spin_axis_wobble_r_z = M_xz*bar_f_f_x + M_yz*bar_f_f_y + M_zz*bar_f_f_z
    bar_f_spin_axis_wobble_r_y = M_xy*bar_f_f_x + M_yy*bar_f_f_y + M_zy*bar_f_f_z
    bar_f_spin_axis_wobble_r_x = M_xx*bar_f_f_x + M_yx*bar_f_f_y + M_zx*bar_f_f_z
    bar_f_disc_r_y = -bar_f_spin_axis_wobble_r_x*sin_psi + bar_f_spin_axis_wobble_r_y*cos_psi
    bar_f_disc_r_x = bar_f_spin_axis_wobble_r_x*cos_psi + bar_f_spin_axis_wobble_r_y*sin_psi
    bar_K2_thermal_second_order = bar_i_vibration_rectification*x97
    bar_K1_thermal_scale = i_sensed*k_VI
    bar_vartheta_y_thermal_misalignment = -bar_i_vibration_rectification*f_f_zj
    bar_vartheta_z_mount_hysteresis = bar_i_vibration_rectification*f_f_yj
    bar_dR_arm_stretch = bar_f_disc_r_x + bar_f_disc_r_y*beta_z + bar_f_spin_axis_wobble_r_z*beta_x + bar_q_disc_r_x
    x122 = bar_f_f_z - bar_q_p_second_order_misalignment
    bar_rate_rate_run_out_z = x122
    x123 = bar_f_f_y + bar_q_f_y
    bar_rate_rate_run_out_y = x123
    x124 = bar_f_f_x + bar_q_f_x
    bar_rate_rate_run_out_x = x124
    bar_rate_run_out_z = bar_f_f_x*x49 - bar_f_f_y*x85 + bar_q_f_x*x49 - bar_q_f_y*x85
    bar_rate_run_out_y = -bar_f_f_x*x52 + 2.0*bar_f_f_z*omega_x - bar_q_f_x*x52 - bar_q_p_second_order_misalignment*x85
    bar_rate_run_out_x = bar_f_f_y*x52 - bar_f_f_z*x49 + bar_q_f_y*x52 + bar_q_p_second_order_misalignment*x49
    x125 = omega_x*omega_z
    x126 = omegadot_y + x125
    x127 = -Gamma_xz + x126
    x128 = omega_y*omega_z
    x129 = -Gamma_yz - omegadot_x + x128
    bar_run_out_z = bar_f_f_x*x127 + bar_f_f_y*x129 + bar_f_f_z*x28 + bar_q_f_x*x127 + bar_q_f_y*x129 - bar_q_p_second_order_misalignment*x28
    x130 = omegadot_x + x128
    x131 = -Gamma_yz + x130
    x132 = -omegadot_z - x16
    x133 = omega_z**2.0
    x134 = x133 + x22
    x135 = -Gamma_yy - x134
    bar_run_out_y = bar_f_f_x*x132 + bar_f_f_y*x135 + bar_f_f_z*x131 + bar_q_f_x*x132 + bar_q_f_y*x135 - bar_q_p_second_order_misalignment*x131
    x136 = x125 - x25
    x137 = x10 + x133
    x138 = -Gamma_xx - x137
    bar_run_out_x = bar_f_f_x*x138 + bar_f_f_y*x21 + bar_f_f_z*x136 + bar_q_f_x*x138 + bar_q_f_y*x21 - bar_q_p_second_order_misalignment*x136
    bar_wobble_zy = bar_f_spin_axis_wobble_r_z*f_r_y + bar_f_spin_axis_wobble_tau_xz*f_tau_xy + bar_f_spin_axis_wobble_tau_yz*f_tau_yy + bar_f_spin_axis_wobble_tau_zz*f_tau_zy + bar_q_spin_axis_wobble_r_z*q_r_y + bar_q_spin_axis_wobble_tau_xz*cos_psi + bar_q_spin_axis_wobble_tau_yz*sin_psi
    bar_wobble_zx = bar_f_spin_axis_wobble_r_z*f_r_x + bar_f_spin_axis_wobble_tau_xz*f_tau_xx + bar_f_spin_axis_wobble_tau_yz*f_tau_yx + bar_f_spin_axis_wobble_tau_zz*f_tau_zx + bar_q_spin_axis_wobble_r_z*q_r_x - bar_q_spin_axis_wobble_tau_xz*sin_psi + bar_q_spin_axis_wobble_tau_yz*cos_psi
    bar_wobble_yz = bar_f_spin_axis_wobble_r_y*f_disc_r_z - bar_f_spin_axis_wobble_tau_yy*beta_x - bar_f_spin_axis_wobble_tau_zy - bar_q_p_second_order_misalignment*q_f_y
    bar_wobble_xz = bar_f_spin_axis_wobble_r_x*f_disc_r_z - bar_f_spin_axis_wobble_tau_yx*beta_x - bar_f_spin_axis_wobble_tau_zx - bar_q_p_second_order_misalignment*q_f_x
    bar_sin_psi = -bar_f_spin_axis_wobble_r_x*f_disc_r_y + bar_f_spin_axis_wobble_r_y*f_disc_r_x - bar_f_spin_axis_wobble_tau_xx - bar_f_spin_axis_wobble_tau_xy*beta_z - bar_f_spin_axis_wobble_tau_yx*beta_z + bar_f_spin_axis_wobble_tau_yy - bar_f_spin_axis_wobble_tau_zx*f_disc_tau_zy - bar_f_spin_axis_wobble_tau_zy*beta_x + bar_q_spin_axis_wobble_r_y*q_disc_r_x - bar_q_spin_axis_wobble_tau_xx + bar_q_spin_axis_wobble_tau_yy
    bar_cos_psi = bar_f_spin_axis_wobble_r_x*f_disc_r_x + bar_f_spin_axis_wobble_r_y*f_disc_r_y - bar_f_spin_axis_wobble_tau_xx*beta_z + bar_f_spin_axis_wobble_tau_xy + bar_f_spin_axis_wobble_tau_yx + bar_f_spin_axis_wobble_tau_yy*beta_z - bar_f_spin_axis_wobble_tau_zx*beta_x + bar_f_spin_axis_wobble_tau_zy*f_disc_tau_zy + bar_q_spin_axis_wobble_r_x*q_disc_r_x + bar_q_spin_axis_wobble_tau_xy + bar_q_spin_axis_wobble_tau_yx
    x139 = bar_f_f_z*f_disc_r_z
    bar_M_zz = x139
    x140 = bar_f_f_z*f_r_y
    x141 = bar_q_p_second_order_misalignment*q_r_y
    bar_M_zy = x140 - x141
    x142 = bar_q_p_second_order_misalignment*q_r_x
    bar_M_zx = bar_f_f_z*f_r_x - x142
    x143 = bar_f_f_y*f_disc_r_z
    bar_M_yz = x143
    x144 = bar_f_f_y*f_r_y
    x145 = bar_q_f_y*q_r_y
    bar_M_yy = x144 + x145
    x146 = bar_q_f_y*q_r_x
    bar_M_yx = bar_f_f_y*f_r_x + x146
    x147 = bar_f_f_x*f_disc_r_z
    bar_M_xz = x147
    x148 = bar_f_f_x*f_r_y
    x149 = bar_q_f_x*q_r_y
    bar_M_xy = x148 + x149
    x150 = bar_q_f_x*q_r_x
    bar_M_xx = bar_f_f_x*f_r_x + x150
    x151 = -bar_M_xy + bar_M_yx
    bar_spin_acceleration_true = x151
    x152 = bar_M_zx*omega_x
    x153 = bar_M_zy*omega_y
    x154 = bar_M_xx*x53 + bar_M_yy*x53
    bar_spin_rate_true = 2.0*x152 + 2.0*x153 + x154
    bar_sin_phi_true = -bar_cos_psi*sin_j + bar_sin_psi*cos_j
    bar_cos_phi_true = bar_cos_psi*cos_j + bar_sin_psi*sin_j
    bar_sin_delta_phi = -bar_cos_phi_true*sin_phi + bar_sin_phi_true*cos_phi
    bar_time_offset_omegadot_z = x151
    bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx
    bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy
    bar_time_offset_omega_z = bar_M_xz*omega_x + bar_M_yz*omega_y + x152 + x153 + x154
    bar_time_offset_omega_y = -bar_M_xx*x49 + bar_M_xy*omega_x + bar_M_yx*omega_x + bar_M_yz*omega_z + bar_M_zy*x67 - bar_M_zz*x49
    bar_time_offset_omega_x = bar_M_xy*omega_y + bar_M_xz*omega_z + bar_M_yx*omega_y - bar_M_yy*x85 + bar_M_zx*x67 - bar_M_zz*x85
    bar_time_offset_a_z = x122
    bar_time_offset_a_y = x123
    bar_time_offset_a_x = x124
    bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy
    bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx
    bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx
    x155 = a_y*bar_time_offset_a_z
    x156 = bar_time_offset_omega_z*omega_y
    x157 = bar_time_offset_omegadot_z*omegadot_y
    x158 = x156 + x157
    bar_imu_turn_zy = x155 + x158
    x159 = a_x*bar_time_offset_a_z
    x160 = bar_time_offset_omega_z*omega_x + bar_time_offset_omegadot_z*omegadot_x
    x161 = x159 + x160
    bar_imu_turn_zx = x161
    x162 = a_z*bar_time_offset_a_y
    x163 = bar_time_offset_omega_y*omega_z + bar_time_offset_omegadot_y*omegadot_z
    x164 = x162 + x163
    bar_imu_turn_yz = x164
    x165 = a_x*bar_time_offset_a_y
    x166 = bar_time_offset_omega_y*omega_x + bar_time_offset_omegadot_y*omegadot_x
    bar_imu_turn_yx = x165 + x166
    x167 = a_z*bar_time_offset_a_x
    x168 = bar_time_offset_omega_x*omega_z
    x169 = bar_time_offset_omegadot_x*omegadot_z
    x170 = x168 + x169
    bar_imu_turn_xz = x167 + x170
    x171 = a_y*bar_time_offset_a_x
    x172 = bar_time_offset_omega_x*omega_y + bar_time_offset_omegadot_x*omegadot_y
    bar_imu_turn_xy = x171 + x172
    x173 = angular_vibration_rms**2.0
    x174 = bar_M_yy*x173
    x175 = bar_M_zz*x173
    x176 = bar_M_xx*x173
    x177 = K1*bar_K1_thermal_scale
    x178 = bar_run_out_x*cos_phi
    x179 = bar_run_out_y*cos_phi
    x180 = bar_run_out_z*cos_phi
    x181 = 2.0*cos_phi
    x182 = 2.0*sin_phi
    x183 = rate_cos_phi_true*x181 - rate_sin_phi_true*x182
    x184 = cos_phi**2.0
    x185 = sin_phi**2.0
    x186 = x184 - x185
    x187 = 2.0*rate_cos_phi_true**2.0 + rate_rate_cos_phi_true*x181 - rate_rate_sin_phi_true*x182 - 2.0*rate_sin_phi_true**2.0
    x188 = rate_cos_phi_true*x182 + rate_sin_phi_true*x181
    x189 = 4.0*rate_cos_phi_true*rate_sin_phi_true + rate_rate_cos_phi_true*x182 + rate_rate_sin_phi_true*x181
    x190 = attitude_yx**2.0
    x191 = attitude_yz**2.0
    x192 = attitude_xx*attitude_yx
    x193 = attitude_xz*attitude_yz
    x194 = -x193
    x195 = attitude_xx*attitude_zx
    x196 = attitude_xz*attitude_zz
    x197 = -x196
    x198 = attitude_yx*attitude_zx
    x199 = attitude_yz*attitude_zz
    x200 = -x199
    x201 = attitude_xz**2.0
    x202 = attitude_xx**2.0
    x203 = attitude_zx**2.0
    x204 = attitude_zz**2.0
    x205 = 1 - x204
    x206 = 2.0*bar_M_xx
    x207 = attitude_xx*x206
    x208 = 2.0*bar_M_yy
    x209 = attitude_yx*x208
    x210 = 2.0*attitude_zx
    x211 = bar_M_zz*x210
    x212 = attitude_xx*attitude_zy
    x213 = attitude_xy*attitude_zx
    x214 = attitude_yx*attitude_zy
    x215 = attitude_yy*attitude_zx
    x216 = attitude_xx*attitude_yy
    x217 = attitude_xy*attitude_yx
    x218 = attitude_xx*attitude_yz
    x219 = attitude_xz*attitude_yx
    x220 = attitude_yx*attitude_zz
    x221 = attitude_yz*attitude_zx
    x222 = attitude_xx*attitude_zz
    x223 = attitude_xz*attitude_zx
    x224 = attitude_xy**2.0
    x225 = attitude_xy*attitude_yy
    x226 = attitude_xy*attitude_zy
    x227 = attitude_yy*attitude_zy
    x228 = attitude_yy**2.0
    x229 = attitude_zy**2.0
    x230 = attitude_xy*attitude_xz
    x231 = attitude_yy*attitude_yz
    x232 = 2.0*attitude_zy*attitude_zz
    x233 = attitude_xy*attitude_yz
    x234 = attitude_xz*attitude_yy
    x235 = attitude_xy*attitude_zz
    x236 = attitude_xz*attitude_zy
    x237 = attitude_yy*attitude_zz
    x238 = attitude_yz*attitude_zy
    x239 = -fuel_mass*x193
    x240 = -fuel_mass*x196
    x241 = -fuel_mass*x199
    x242 = -fuel_mass*x201
    x243 = -fuel_mass*x191
    x244 = -fuel_mass*x204
    x245 = bar_M_xx*fuel_mass
    x246 = 2.0*x245
    x247 = attitude_xx*x246
    x248 = bar_M_yy*fuel_mass
    x249 = 2.0*x248
    x250 = attitude_yx*x249
    x251 = bar_M_zz*fuel_mass
    x252 = x210*x251
    x253 = bar_time_offset_a_x*d_a_x
    x254 = bar_time_offset_a_y*d_a_y
    x255 = bar_time_offset_a_z*d_a_z
    x256 = bar_time_offset_omega_x*omegadot_x
    x257 = bar_time_offset_omega_y*omegadot_y
    x258 = bar_time_offset_omega_z*omegadot_z
    x259 = bar_time_offset_omegadot_x*d_omegadot_x
    x260 = bar_time_offset_omegadot_y*d_omegadot_y
    x261 = bar_time_offset_omegadot_z*d_omegadot_z
    x262 = bar_i_vibration_rectification*f_f_i**2.0
    x263 = f_f_o**2.0
    x264 = bar_i_vibration_rectification*f_f_i
    x265 = f_f_p**2.0
    x266 = bar_sin_delta_phi*cos_phi
    x267 = bar_spin_rate_true*x38
    x268 = 4.0*cos_phi
    x269 = cos_phi**3.0
    x270 = sin_phi**3.0
    x271 = 9.0*x184
    x272 = 9.0*x42
    x273 = 3.0*x269
    x274 = 9.0*x185
    x275 = cos_phi**4.0
    x276 = sin_phi**4.0
    x277 = x184*x185
    x278 = 16.0*x269
    x279 = 16.0*x42
    x280 = 4.0*d_spin_angle
    x281 = 24.0*x277
    x282 = 4.0*d2_spin_angle
    x283 = -bar_M_zz*fuel_mass
    x284 = -bar_M_zz
    x285 = x256 + x257 + x258
    x286 = x259 + x260 + x261
    x287 = -x167
    x288 = -x155
    x289 = a_x*bar_time_offset_a_x
    x290 = a_y*bar_time_offset_a_y
    x291 = temperature - 293.15
    x292 = -x291
    x293 = C__heat_rr*sin_j**2.0 - 2.0*C__heat_rt*cos_j*sin_j + C__heat_tt*cos_j**2.0
    x294 = bar_i_vibration_rectification*i_sensed
    x295 = -C__play_radial*sin_j + C__play_tangential*cos_j
    x296 = f_r_x*x139
    x297 = 0.5*q_r_x**2.0
    x298 = 0.5*f_disc_r_z**2.0
    x299 = f_r_x**2.0
    x300 = 0.5*x299
    x301 = x298 - x300
    x302 = f_r_x*x147
    x303 = 0.5*q_r_y**2.0
    x304 = 0.5*f_r_y**2.0
    x305 = x298 - x304
    x306 = f_r_x*x143
    x307 = (1/6)*q_r_x**3.0
    x308 = f_r_x*x298
    x309 = -1/6*f_r_x**3.0 + x308
    x310 = f_disc_r_z**3.0
    x311 = (1/6)*x310
    x312 = -0.5*f_disc_r_z*x299 + x311
    x313 = f_r_y*x296
    x314 = f_r_y*x298
    x315 = -f_r_y*x300 + x314
    x316 = -f_r_x*x304 + x308
    x317 = f_disc_r_z*x304
    x318 = (1/6)*q_r_y**3.0
    x319 = -1/6*f_r_y**3.0 + x314
    x320 = x311 - x317
    x321 = bar_i_vibration_rectification*rate_rate_i_sensed
    x322 = -bar_M_zz*x6
    x323 = -bar_M_zz*x5
    x324 = -cos_yaw**2.0 + sin_yaw**2.0 + 1
    x325 = -x324
    x326 = cos_yaw*sin_yaw
    x327 = cos_yaw - 1
    x328 = -Gamma_zz
    x329 = 2.0*Gamma_yz
    x330 = 2.0*Gamma_xz
    x331 = vibration_rms**2.0
    x332 = K4*vibration_axis_ix
    x333 = vibration_axis_px*x332
    x334 = K6*vibration_axis_ix
    x335 = vibration_axis_ox*x334
    x336 = K8*vibration_axis_ox
    x337 = vibration_axis_px*x336
    x338 = K2*vibration_axis_ix**2.0
    x339 = K5*vibration_axis_ox**2.0
    x340 = K7*vibration_axis_px**2.0
    x341 = vibration_axis_py*x332
    x342 = K4*vibration_axis_px
    x343 = vibration_axis_iy*x342
    x344 = vibration_axis_oy*x334
    x345 = K6*vibration_axis_ox
    x346 = vibration_axis_iy*x345
    x347 = vibration_axis_py*x336
    x348 = K8*vibration_axis_px
    x349 = vibration_axis_oy*x348
    x350 = vibration_axis_ix*x112
    x351 = vibration_axis_iy*x350
    x352 = vibration_axis_ox*x113
    x353 = vibration_axis_oy*x352
    x354 = vibration_axis_px*x114
    x355 = vibration_axis_py*x354
    x356 = vibration_axis_pz*x332
    x357 = vibration_axis_iz*x342
    x358 = vibration_axis_oz*x334
    x359 = vibration_axis_iz*x345
    x360 = vibration_axis_pz*x336
    x361 = vibration_axis_oz*x348
    x362 = vibration_axis_iz*x350
    x363 = vibration_axis_oz*x352
    x364 = vibration_axis_pz*x354
    x365 = K4*vibration_axis_iy
    x366 = vibration_axis_py*x365
    x367 = K6*vibration_axis_iy
    x368 = vibration_axis_oy*x367
    x369 = K8*vibration_axis_oy
    x370 = vibration_axis_py*x369
    x371 = K2*vibration_axis_iy**2.0
    x372 = K5*vibration_axis_oy**2.0
    x373 = K7*vibration_axis_py**2.0
    x374 = vibration_axis_pz*x365
    x375 = K4*vibration_axis_iz
    x376 = vibration_axis_py*x375
    x377 = vibration_axis_oz*x367
    x378 = K6*vibration_axis_iz
    x379 = vibration_axis_oy*x378
    x380 = vibration_axis_pz*x369
    x381 = K8*vibration_axis_oz
    x382 = vibration_axis_py*x381
    x383 = vibration_axis_iy*vibration_axis_iz*x112
    x384 = vibration_axis_oy*vibration_axis_oz*x113
    x385 = vibration_axis_py*vibration_axis_pz*x114
    x386 = vibration_axis_pz*x375
    x387 = vibration_axis_oz*x378
    x388 = vibration_axis_pz*x381
    x389 = K2*vibration_axis_iz**2.0
    x390 = K5*vibration_axis_oz**2.0
    x391 = K7*vibration_axis_pz**2.0

    D = np.empty((len(ROWS), len(time)))
    D[0] = bar_i_vibration_rectification*np.sign(i_sensed)  # adc-nonlinearity.h
    D[1] = -x174 - x175  # angular-jitter.W_xx
    D[2] = -bar_spin_axis_tilt_Gamma_xy*x173  # angular-jitter.W_xy
    D[3] = -bar_spin_axis_tilt_Gamma_xz*x173  # angular-jitter.W_xz
    D[4] = -x175 - x176  # angular-jitter.W_yy
    D[5] = -bar_spin_axis_tilt_Gamma_yz*x173  # angular-jitter.W_yz
    D[6] = -x174 - x176  # angular-jitter.W_zz
    D[7] = bar_i_vibration_rectification*(f_tau_xx*omega_x + f_tau_xy*omega_y)*(f_tau_zx*omega_x + f_tau_zy*omega_y - x11)  # anisoinertia.K_ip
    D[8] = bar_dR_arm_stretch  # arm-length.delta_R
    D[9] = b_f_zj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_zj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_zj  # arm-sag.c_z
    D[10] = b_f_yj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_yj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_yj  # arm-stretch.c_r
    D[11] = balance_current*x177  # balancing-loop.dK1_di
    D[12] = bar_K2_thermal_second_order*second_order_current  # balancing-loop.dK2_di
    D[13] = bar_rate_rate_run_out_x*rate_rate_cos_phi_true + bar_rate_run_out_x*rate_cos_phi_true + x178  # bearing-run-out.c_x1
    D[14] = bar_rate_rate_run_out_x*rate_rate_sin_phi_true + bar_rate_run_out_x*rate_sin_phi_true + bar_run_out_x*sin_phi  # bearing-run-out.s_x1
    D[15] = bar_rate_rate_run_out_y*rate_rate_cos_phi_true + bar_rate_run_out_y*rate_cos_phi_true + x179  # bearing-run-out.c_y1
    D[16] = bar_rate_rate_run_out_y*rate_rate_sin_phi_true + bar_rate_run_out_y*rate_sin_phi_true + bar_run_out_y*sin_phi  # bearing-run-out.s_y1
    D[17] = bar_rate_rate_run_out_z*rate_rate_cos_phi_true + bar_rate_run_out_z*rate_cos_phi_true + x180  # bearing-run-out.c_z1
    D[18] = bar_rate_rate_run_out_z*rate_rate_sin_phi_true + bar_rate_run_out_z*rate_sin_phi_true + bar_run_out_z*sin_phi  # bearing-run-out.s_z1
    D[19] = bar_rate_rate_run_out_x*x187 + bar_rate_run_out_x*x183 + bar_run_out_x*x186  # bearing-run-out.c_x2
    D[20] = bar_rate_rate_run_out_x*x189 + bar_rate_run_out_x*x188 + x178*x182  # bearing-run-out.s_x2
    D[21] = bar_rate_rate_run_out_y*x187 + bar_rate_run_out_y*x183 + bar_run_out_y*x186  # bearing-run-out.c_y2
    D[22] = bar_rate_rate_run_out_y*x189 + bar_rate_run_out_y*x188 + x179*x182  # bearing-run-out.s_y2
    D[23] = bar_rate_rate_run_out_z*x187 + bar_rate_run_out_z*x183 + bar_run_out_z*x186  # bearing-run-out.c_z2
    D[24] = bar_rate_rate_run_out_z*x189 + bar_rate_run_out_z*x188 + x180*x182  # bearing-run-out.s_z2
    D[25] = bar_i_vibration_rectification*time  # bias-drift.dK0_dt
    D[26] = bar_i_vibration_rectification*(-C__slip_radial*sin_j + C__slip_tangential*cos_j)  # bias-hysteresis.h_i
    D[27] = bar_i_vibration_rectification*(C__slip_radial*cos_j + C__slip_tangential*sin_j)  # bias-hysteresis.h_o
    D[28] = -C__slip_axial*bar_i_vibration_rectification  # bias-hysteresis.h_p
    D[29] = 0  # bias-hysteresis.w
    D[30] = bar_i_vibration_rectification  # bias-step.dK0
    D[31] = -bar_M_xx*(-x201 + x202 - 1) - bar_M_yy*(x190 - x191) - bar_M_zz*(x203 + x205) + bar_spin_axis_tilt_Gamma_xy*(x192 + x194) + bar_spin_axis_tilt_Gamma_xz*(x195 + x197) + bar_spin_axis_tilt_Gamma_yz*(x198 + x200)  # carrier-gradient.G_xx
    D[32] = -attitude_xy*x207 - attitude_yy*x209 - attitude_zy*x211 + bar_spin_axis_tilt_Gamma_xy*(x216 + x217 - 1) + bar_spin_axis_tilt_Gamma_xz*(x212 + x213) + bar_spin_axis_tilt_Gamma_yz*(x214 + x215)  # carrier-gradient.G_xy
    D[33] = -attitude_xz*x207 - attitude_yz*x209 - attitude_zz*x211 + bar_spin_axis_tilt_Gamma_xy*(x218 + x219) + bar_spin_axis_tilt_Gamma_xz*(x222 + x223 - 1) + bar_spin_axis_tilt_Gamma_yz*(x220 + x221)  # carrier-gradient.G_xz
    D[34] = -bar_M_xx*(-x201 + x224) - bar_M_yy*(-x191 + x228 - 1) - bar_M_zz*(x205 + x229) + bar_spin_axis_tilt_Gamma_xy*(x194 + x225) + bar_spin_axis_tilt_Gamma_xz*(x197 + x226) + bar_spin_axis_tilt_Gamma_yz*(x200 + x227)  # carrier-gradient.G_yy
    D[35] = -bar_M_zz*x232 + bar_spin_axis_tilt_Gamma_xy*(x233 + x234) + bar_spin_axis_tilt_Gamma_xz*(x235 + x236) + bar_spin_axis_tilt_Gamma_yz*(x237 + x238 - 1) - x206*x230 - x208*x231  # carrier-gradient.G_yz
    D[36] = -bar_M_xx*(fuel_mass*x202 + x242) - bar_M_yy*(fuel_mass*x190 + x243) - bar_M_zz*(fuel_mass*x203 + x244) + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x192 + x239) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x195 + x240) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x198 + x241)  # carrier-gradient.F_xx
    D[37] = -attitude_xy*x247 - attitude_yy*x250 - attitude_zy*x252 + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x216 + fuel_mass*x217) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x212 + fuel_mass*x213) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x214 + fuel_mass*x215)  # carrier-gradient.F_xy
    D[38] = -attitude_xz*x247 - attitude_yz*x250 - attitude_zz*x252 + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x218 + fuel_mass*x219) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x222 + fuel_mass*x223) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x220 + fuel_mass*x221)  # carrier-gradient.F_xz
    D[39] = -bar_M_xx*(fuel_mass*x224 + x242) - bar_M_yy*(fuel_mass*x228 + x243) - bar_M_zz*(fuel_mass*x229 + x244) + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x225 + x239) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x226 + x240) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x227 + x241)  # carrier-gradient.F_yy
    D[40] = bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x233 + fuel_mass*x234) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x235 + fuel_mass*x236) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x237 + fuel_mass*x238) - x230*x246 - x231*x249 - x232*x251  # carrier-gradient.F_yz
    D[41] = time*x253 + time*x254 + time*x255 + time*x256 + time*x257 + time*x258 + time*x259 + time*x260 + time*x261  # clock-drift.epsilon
    D[42] = f_f_o*x262  # cubic-cross.K_iio
    D[43] = f_f_p*x262  # cubic-cross.K_iip
    D[44] = x263*x264  # cubic-cross.K_ioo
    D[45] = f_f_o*f_f_p*x264  # cubic-cross.K_iop
    D[46] = x264*x265  # cubic-cross.K_ipp
    D[47] = bar_i_vibration_rectification*f_f_o**3.0  # cubic-cross.K_ooo
    D[48] = bar_i_vibration_rectification*f_f_p*x263  # cubic-cross.K_oop
    D[49] = bar_i_vibration_rectification*f_f_o*x265  # cubic-cross.K_opp
    D[50] = bar_i_vibration_rectification*f_f_p**3.0  # cubic-cross.K_ppp
    D[51] = bar_i_vibration_rectification*f_f_i**3.0  # cubic-input.K_iii
    D[52] = bar_spin_acceleration_true*x44 + x266 - x267  # encoder-harmonic.c_1
    D[53] = bar_sin_delta_phi*sin_phi + bar_spin_acceleration_true*x47 + bar_spin_rate_true*x40  # encoder-harmonic.s_1
    D[54] = bar_sin_delta_phi*x186 + bar_spin_acceleration_true*(-4.0*x184*x42 + 4.0*x185*x42 - x268*x41) - x267*x268  # encoder-harmonic.c_2
    D[55] = bar_spin_acceleration_true*(2.0*d2_spin_angle*x184 - 8.0*sin_phi*x43 - x185*x66) + bar_spin_rate_true*(x184*x51 - x185*x51) + x182*x266  # encoder-harmonic.s_2
    D[56] = bar_sin_delta_phi*(-3.0*cos_phi*x185 + x269) + bar_spin_acceleration_true*(27.0*cos_phi*x185*x42 + 3.0*d2_spin_angle*x270 - x269*x272 - x271*x41) + bar_spin_rate_true*(3.0*d_spin_angle*x270 - x271*x38)  # encoder-harmonic.c_3
    D[57] = bar_sin_delta_phi*(3.0*sin_phi*x184 - x270) + bar_spin_acceleration_true*(d2_spin_angle*x273 - 27.0*x184*x46 + x270*x272 - x274*x45) + bar_spin_rate_true*(d_spin_angle*x273 - x274*x40)  # encoder-harmonic.s_3
    D[58] = bar_sin_delta_phi*(x275 + x276 - 6.0*x277) + bar_spin_acceleration_true*(16.0*cos_phi*d2_spin_angle*x270 + 96.0*x184*x185*x42 - x275*x279 - x276*x279 - x278*x41) + bar_spin_rate_true*(16.0*cos_phi*d_spin_angle*x270 - x278*x38)  # encoder-harmonic.c_4
    D[59] = bar_sin_delta_phi*(4.0*sin_phi*x269 - x268*x270) + bar_spin_acceleration_true*(-d2_spin_angle*x281 - 64.0*x269*x46 + 64.0*x270*x43 + x275*x282 + x276*x282) + bar_spin_rate_true*(-d_spin_angle*x281 + x275*x280 + x276*x280)  # encoder-harmonic.s_4
    D[60] = -x245 - x283  # fuel-gradient.G_xx
    D[61] = bar_spin_axis_tilt_Gamma_xy*fuel_mass  # fuel-gradient.G_xy
    D[62] = bar_spin_axis_tilt_Gamma_xz*fuel_mass  # fuel-gradient.G_xz
    D[63] = -x248 - x283  # fuel-gradient.G_yy
    D[64] = bar_spin_axis_tilt_Gamma_yz*fuel_mass  # fuel-gradient.G_yz
    D[65] = time*x177  # gain-drift.dK1_dt
    D[66] = x177  # gain-step.dK1
    D[67] = -bar_M_xx - x284  # gradient-offset.G_xx
    D[68] = bar_spin_axis_tilt_Gamma_xy  # gradient-offset.G_xy
    D[69] = bar_spin_axis_tilt_Gamma_xz  # gradient-offset.G_xz
    D[70] = -bar_M_yy - x284  # gradient-offset.G_yy
    D[71] = bar_spin_axis_tilt_Gamma_yz  # gradient-offset.G_yz
    D[72] = -bar_time_offset_omega_x  # gyro-bias.b_x
    D[73] = -bar_time_offset_omega_y  # gyro-bias.b_y
    D[74] = -bar_time_offset_omega_z  # gyro-bias.b_z
    D[75] = x285  # gyro-delay.delta_w
    D[76] = x286  # gyro-delay.delta_d
    D[77] = -a_x*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_x  # gyro-g-sensitivity.d_xx
    D[78] = -a_y*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_y  # gyro-g-sensitivity.d_xy
    D[79] = -a_z*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_z  # gyro-g-sensitivity.d_xz
    D[80] = -a_x*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_x  # gyro-g-sensitivity.d_yx
    D[81] = -a_y*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_y  # gyro-g-sensitivity.d_yy
    D[82] = -a_z*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_z  # gyro-g-sensitivity.d_yz
    D[83] = -a_x*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_x  # gyro-g-sensitivity.d_zx
    D[84] = -a_y*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_y  # gyro-g-sensitivity.d_zy
    D[85] = -a_z*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_z  # gyro-g-sensitivity.d_zz
    D[86] = -x172  # gyro-misalignment.m_xy
    D[87] = -x170  # gyro-misalignment.m_xz
    D[88] = -x166  # gyro-misalignment.m_yx
    D[89] = -x163  # gyro-misalignment.m_yz
    D[90] = -x160  # gyro-misalignment.m_zx
    D[91] = -x158  # gyro-misalignment.m_zy
    D[92] = -bar_time_offset_omega_x*omega_x - bar_time_offset_omegadot_x*omegadot_x  # gyro-scale.s_x
    D[93] = -bar_time_offset_omega_y*omega_y - bar_time_offset_omegadot_y*omegadot_y  # gyro-scale.s_y
    D[94] = -bar_time_offset_omega_z*omega_z - bar_time_offset_omegadot_z*omegadot_z  # gyro-scale.s_z
    D[95] = -bar_time_offset_a_x  # imu-acceleration-bias.b_x
    D[96] = -bar_time_offset_a_y  # imu-acceleration-bias.b_y
    D[97] = -bar_time_offset_a_z  # imu-acceleration-bias.b_z
    D[98] = -x171  # imu-acceleration-misalignment.m_xy
    D[99] = x287  # imu-acceleration-misalignment.m_xz
    D[100] = -x165  # imu-acceleration-misalignment.m_yx
    D[101] = -x162  # imu-acceleration-misalignment.m_yz
    D[102] = -x159  # imu-acceleration-misalignment.m_zx
    D[103] = x288  # imu-acceleration-misalignment.m_zy
    D[104] = -a_x**2.0*bar_time_offset_a_x  # imu-acceleration-quadratic.q_x
    D[105] = -a_y**2.0*bar_time_offset_a_y  # imu-acceleration-quadratic.q_y
    D[106] = -x289  # imu-acceleration-scale.s_x
    D[107] = -x290  # imu-acceleration-scale.s_y
    D[108] = -a_z*bar_time_offset_a_z  # imu-acceleration-scale.s_z
    D[109] = -bar_time_offset_a_x*d2_a_x - bar_time_offset_a_y*d2_a_y - bar_time_offset_a_z*d2_a_z  # imu-filter.b_a
    D[110] = -bar_time_offset_omega_x*d_omegadot_x - bar_time_offset_omega_y*d_omegadot_y - bar_time_offset_omega_z*d_omegadot_z - bar_time_offset_omegadot_x*d2_omegadot_x - bar_time_offset_omegadot_y*d2_omegadot_y - bar_time_offset_omegadot_z*d2_omegadot_z  # imu-filter.b_w
    D[111] = bar_time_offset_a_x*x137 - bar_time_offset_a_y*x20 + bar_time_offset_a_z*(-x125 - x17)  # imu-lever-arm.l_x
    D[112] = bar_time_offset_a_x*(omegadot_z - x15) + bar_time_offset_a_y*x134 - bar_time_offset_a_z*x130  # imu-lever-arm.l_y
    D[113] = -bar_time_offset_a_x*x126 + bar_time_offset_a_y*(-x128 - x26) + bar_time_offset_a_z*x27  # imu-lever-arm.l_z
    D[114] = -bar_imu_turn_yz + bar_imu_turn_zy  # imu-misalignment.e_x
    D[115] = bar_imu_turn_xz - bar_imu_turn_zx  # imu-misalignment.e_y
    D[116] = -bar_imu_turn_xy + bar_imu_turn_yx  # imu-misalignment.e_z
    D[117] = x253  # imu-skew.delta_x
    D[118] = x254  # imu-skew.delta_y
    D[119] = bar_time_offset_a_x*x292  # imu-thermal.db_x_dT
    D[120] = bar_time_offset_a_y*x292  # imu-thermal.db_y_dT
    D[121] = -x289*x291  # imu-thermal.ds_x_dT
    D[122] = -x290*x291  # imu-thermal.ds_y_dT
    D[123] = bar_i_vibration_rectification*x293  # inner-temperature.b
    D[124] = x177*x293  # inner-temperature.s
    D[125] = C__heat_start*bar_i_vibration_rectification  # inner-temperature.b_0
    D[126] = C__heat_start*x177  # inner-temperature.s_0
    D[127] = 0  # inner-temperature.tau
    D[128] = -bar_i_vibration_rectification*rate_f_f_i  # lag.tau
    D[129] = bar_i_vibration_rectification*(B_x*f_tau_zx + B_y*f_tau_zy - B_z)  # magnetic-axial-bias.dK0_dBz
    D[130] = bar_i_vibration_rectification*(B_x*x118 + B_y*x119 + B_z*x120)  # magnetic-bias.dK0_dB
    D[131] = x294*(B_x*f_tau_xx + B_y*f_tau_xy)  # magnetic-scale.dK1_dB
    D[132] = bar_vartheta_y_thermal_misalignment*time  # misalignment-drift.dvartheta_y_dt
    D[133] = bar_vartheta_y_thermal_misalignment  # misalignment-step.dvartheta_y
    D[134] = b_f_xj*bar_vartheta_y_thermal_misalignment  # mount-compliance.c_yx
    D[135] = b_f_yj*bar_vartheta_y_thermal_misalignment  # mount-compliance.c_yy
    D[136] = b_f_zj*bar_vartheta_y_thermal_misalignment  # mount-compliance.c_yz
    D[137] = b_f_xj*bar_vartheta_z_mount_hysteresis  # mount-compliance.c_zx
    D[138] = b_f_yj*bar_vartheta_z_mount_hysteresis  # mount-compliance.c_zy
    D[139] = b_f_zj*bar_vartheta_z_mount_hysteresis  # mount-compliance.c_zz
    D[140] = bar_vartheta_y_thermal_misalignment*x295  # mount-hysteresis.e_yx
    D[141] = -C__play_axial*bar_vartheta_y_thermal_misalignment  # mount-hysteresis.e_yz
    D[142] = bar_vartheta_z_mount_hysteresis*x295  # mount-hysteresis.e_zx
    D[143] = 0  # mount-hysteresis.w
    D[144] = C__mount_a_x*bar_time_offset_a_x + C__mount_a_y*bar_time_offset_a_y + C__mount_a_z*bar_time_offset_a_z + C__mount_omega_x*bar_time_offset_omega_x + C__mount_omega_y*bar_time_offset_omega_y + C__mount_omega_z*bar_time_offset_omega_z + C__mount_omegadot_x*bar_time_offset_omegadot_x + C__mount_omegadot_y*bar_time_offset_omegadot_y + C__mount_omegadot_z*bar_time_offset_omegadot_z  # mount-resonance.share
    D[145] = 0  # mount-resonance.f_0
    D[146] = 0  # mount-resonance.Q
    D[147] = bar_f_f_x*x301 - bar_q_f_x*x297 + x296  # near-mass.T_xxx
    D[148] = bar_f_f_y*x301 + bar_f_f_z*f_disc_r_z*f_r_y - bar_q_f_y*x297 - f_r_x*x148 - q_r_x*x149  # near-mass.T_xxy
    D[149] = bar_f_f_z*x301 + bar_q_p_second_order_misalignment*x297 - x302  # near-mass.T_xxz
    D[150] = bar_f_f_x*x305 + bar_f_f_z*f_disc_r_z*f_r_x - bar_q_f_x*x303 - f_r_x*x144 - q_r_x*x145  # near-mass.T_xyy
    D[151] = bar_q_p_second_order_misalignment*q_r_x*q_r_y - f_r_x*x140 - f_r_y*x147 - x306  # near-mass.T_xyz
    D[152] = bar_f_f_y*x305 - bar_q_f_y*x303 + f_r_y*x139  # near-mass.T_yyy
    D[153] = bar_f_f_z*x305 + bar_q_p_second_order_misalignment*x303 - f_r_y*x143  # near-mass.T_yyz
    D[154] = bar_f_f_x*x309 - bar_f_f_z*x312 - bar_q_f_x*x307  # near-mass.T_xxxx
    D[155] = bar_f_f_x*x315 + bar_f_f_y*x309 - bar_q_f_y*x307 - x149*x297 + x313  # near-mass.T_xxxy
    D[156] = bar_f_f_x*x312 + bar_f_f_z*x309 + bar_q_p_second_order_misalignment*x307  # near-mass.T_xxxz
    D[157] = bar_f_f_x*x316 + bar_f_f_y*x315 + bar_f_f_z*(f_disc_r_z*x300 - 1/3*x310 + x317) - x145*x297 - x150*x303  # near-mass.T_xxyy
    D[158] = bar_f_f_y*x312 + bar_f_f_z*x315 - f_r_y*x302 + x141*x297  # near-mass.T_xxyz
    D[159] = bar_f_f_x*x319 + bar_f_f_y*x316 - bar_q_f_x*x318 - x146*x303 + x313  # near-mass.T_xyyy
    D[160] = bar_f_f_x*x320 + bar_f_f_z*x316 - f_r_y*x306 + x142*x303  # near-mass.T_xyyz
    D[161] = bar_f_f_y*x319 - bar_f_f_z*x320 - bar_q_f_y*x318  # near-mass.T_yyyy
    D[162] = bar_f_f_y*x320 + bar_f_f_z*x319 + bar_q_p_second_order_misalignment*x318  # near-mass.T_yyyz
    D[163] = x264*np.abs(f_f_i)  # odd-quadratic.K_oq
    D[164] = -G_out*x294  # output-curve.c_2
    D[165] = -G_out**2.0*x294  # output-curve.c_3
    D[166] = x321  # output-filter.b
    D[167] = x294  # output-gain-step.g
    D[168] = bar_i_vibration_rectification*(-beta_x*x14 + f_tau_yx*x24 - f_tau_yy*x19)  # pendulum-angular.K_pa
    D[169] = bar_i_vibration_rectification*(pressure - 101325)  # pressure-bias.dK0_dp
    D[170] = bar_K2_thermal_second_order*time  # second-order-drift.dK2_dt
    D[171] = x321  # second-order-loop.b
    D[172] = bar_q_i_second_order_misalignment*(f_f_i - q_f_xj) + bar_q_o_second_order_misalignment*(f_f_o - q_f_yj) + bar_q_p_second_order_misalignment*(f_f_p + q_f_z)  # second-order-misalignment.kappa
    D[173] = bar_K2_thermal_second_order  # second-order-step.dK2
    D[174] = -bar_M_xx*x6 - x322  # self-gradient.G_xx_roll
    D[175] = bar_spin_axis_tilt_Gamma_xy*x6  # self-gradient.G_xy_roll
    D[176] = bar_spin_axis_tilt_Gamma_xz*x6  # self-gradient.G_xz_roll
    D[177] = -bar_M_yy*x6 - x322  # self-gradient.G_yy_roll
    D[178] = bar_spin_axis_tilt_Gamma_yz*x6  # self-gradient.G_yz_roll
    D[179] = -bar_M_xx*x5 - x323  # self-gradient.G_xx_pitch
    D[180] = bar_spin_axis_tilt_Gamma_xy*x5  # self-gradient.G_xy_pitch
    D[181] = bar_spin_axis_tilt_Gamma_xz*x5  # self-gradient.G_xz_pitch
    D[182] = -bar_M_yy*x5 - x323  # self-gradient.G_yy_pitch
    D[183] = bar_spin_axis_tilt_Gamma_yz*x5  # self-gradient.G_yz_pitch
    D[184] = -bar_M_xx*x325 - bar_M_yy*x324 + 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw  # self-gradient-yaw.G_d
    D[185] = bar_spin_axis_tilt_Gamma_xy*x325 + x206*x326 - x208*x326  # self-gradient-yaw.G_xy
    D[186] = bar_spin_axis_tilt_Gamma_xz*x327 + bar_spin_axis_tilt_Gamma_yz*sin_yaw  # self-gradient-yaw.G_xz
    D[187] = -bar_spin_axis_tilt_Gamma_xz*sin_yaw + bar_spin_axis_tilt_Gamma_yz*x327  # self-gradient-yaw.G_yz
    D[188] = -Gamma_xy*bar_spin_axis_tilt_Gamma_xz + Gamma_xz*bar_spin_axis_tilt_Gamma_xy - bar_M_yy*x329 + bar_M_zz*x329 + bar_spin_axis_tilt_Gamma_yz*(-Gamma_yy - x328) - x156 - x157 + x164 + x288  # spin-axis-tilt.alpha_x
    D[189] = Gamma_xy*bar_spin_axis_tilt_Gamma_yz - Gamma_yz*bar_spin_axis_tilt_Gamma_xy + bar_M_xx*x330 - bar_M_zz*x330 + bar_spin_axis_tilt_Gamma_xz*(Gamma_xx + x328) + x161 - x168 - x169 + x287  # spin-axis-tilt.alpha_y
    D[190] = bar_wobble_xz*sin_phi - bar_wobble_yz*cos_phi - bar_wobble_zx*sin_phi + bar_wobble_zy*cos_phi  # spin-axis-wobble.w_x
    D[191] = bar_wobble_xz*cos_phi + bar_wobble_yz*sin_phi - bar_wobble_zx*cos_phi - bar_wobble_zy*sin_phi  # spin-axis-wobble.w_y
    D[192] = bar_sin_delta_phi  # spin-phase-offset.phi_0
    D[193] = bar_sin_delta_phi  # spin-rate-jitter.sigma_phi
    D[194] = bar_sin_delta_phi  # spin-rate-jitter.sigma_walk
    D[195] = bar_sin_delta_phi*d_spin_angle*time + bar_spin_acceleration_true*x66 + bar_spin_rate_true*(d2_spin_angle*time + d_spin_angle)  # spin-rate-offset.epsilon
    D[196] = -bar_sin_delta_phi*omegadot_z - bar_spin_acceleration_true*d2_omegadot_z - bar_spin_rate_true*d_omegadot_z  # spin-servo.c
    D[197] = bar_i_vibration_rectification*x291  # thermal-bias.dK0_dT
    D[198] = bar_i_vibration_rectification*d_temperature  # thermal-lag.dK0_dTdot
    D[199] = d_temperature*x177  # thermal-lag.dK1_dTdot
    D[200] = bar_vartheta_y_thermal_misalignment*x291  # thermal-misalignment.dvartheta_y_dT
    D[201] = x177*x291  # thermal-scale.dK1_dT
    D[202] = bar_K2_thermal_second_order*x291  # thermal-second-order.dK2_dT
    D[203] = x253 + x254 + x255 + x285 + x286  # time-offset.delta_t
    D[204] = bar_i_vibration_rectification*(x331*x333 + x331*x335 + x331*x337 + x331*x338 + x331*x339 + x331*x340)  # vibration-level.L_xx
    D[205] = bar_i_vibration_rectification*(x331*x341 + x331*x343 + x331*x344 + x331*x346 + x331*x347 + x331*x349 + x331*x351 + x331*x353 + x331*x355)  # vibration-level.L_xy
    D[206] = bar_i_vibration_rectification*(x331*x356 + x331*x357 + x331*x358 + x331*x359 + x331*x360 + x331*x361 + x331*x362 + x331*x363 + x331*x364)  # vibration-level.L_xz
    D[207] = bar_i_vibration_rectification*(x331*x366 + x331*x368 + x331*x370 + x331*x371 + x331*x372 + x331*x373)  # vibration-level.L_yy
    D[208] = bar_i_vibration_rectification*(x331*x374 + x331*x376 + x331*x377 + x331*x379 + x331*x380 + x331*x382 + x331*x383 + x331*x384 + x331*x385)  # vibration-level.L_yz
    D[209] = bar_i_vibration_rectification*(x331*x386 + x331*x387 + x331*x388 + x331*x389 + x331*x390 + x331*x391)  # vibration-level.L_zz
    D[210] = bar_i_vibration_rectification*(x333 + x335 + x337 + x338 + x339 + x340)  # vibration-rectification.P_xx
    D[211] = bar_i_vibration_rectification*(x341 + x343 + x344 + x346 + x347 + x349 + x351 + x353 + x355)  # vibration-rectification.P_xy
    D[212] = bar_i_vibration_rectification*(x356 + x357 + x358 + x359 + x360 + x361 + x362 + x363 + x364)  # vibration-rectification.P_xz
    D[213] = bar_i_vibration_rectification*(x366 + x368 + x370 + x371 + x372 + x373)  # vibration-rectification.P_yy
    D[214] = bar_i_vibration_rectification*(x374 + x376 + x377 + x379 + x380 + x382 + x383 + x384 + x385)  # vibration-rectification.P_yz
    D[215] = bar_i_vibration_rectification*(x386 + x387 + x388 + x389 + x390 + x391)  # vibration-rectification.P_zz
    return D


def values_of(j: int, p: Array) -> Array:
    """The parameters of accelerometer j: of those with four values, its own."""
    q = np.empty(len(PARAMETERS))
    start = 0
    for n, (_, size) in enumerate(PARAMETERS):
        q[n] = p[start + (j if size == 4 else 0)]
        start += size
    return q


def voltages(time: Array, cos_phi: Array, sin_phi: Array, inputs: Array, p: Array) -> Array:
    """V_1 ... V_4, (4, N), V."""
    return np.stack([accelerometer(j, time, cos_phi, sin_phi, inputs, values_of(j, p)) for j in range(4)])


def output(time: Array, cos_phi: Array, sin_phi: Array, inputs: Array, p: Array) -> Array:
    """G_out, (N,), V (Eq. 15)."""
    v = voltages(time, cos_phi, sin_phi, inputs, p)
    return np.asarray((v[0] + v[1]) - (v[2] + v[3]))
