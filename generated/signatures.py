"""Signatures: what each candidate effect would add to V_j.

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: adc-nonlinearity, angular-jitter, anisoinertia, arm-length, arm-sag, arm-stretch, balancing-loop, bearing-run-out, bias-drift, bias-hysteresis, bias-step, carrier-gradient, clock-drift, cubic-cross, cubic-input, disc-spin, encoder-harmonic, fuel-gradient, gain-drift, gain-step, gradient-offset, gyro-bias, gyro-delay, gyro-g-sensitivity, gyro-misalignment, gyro-scale, imu-acceleration-bias, imu-acceleration-misalignment, imu-acceleration-quadratic, imu-acceleration-scale, imu-filter, imu-lever-arm, imu-misalignment, imu-skew, imu-thermal, inner-temperature, lag, magnetic-axial-bias, magnetic-bias, magnetic-scale, misalignment-drift, misalignment-step, mount-compliance, mount-hysteresis, mount-resonance, near-mass, odd-quadratic, output-curve, output-filter, output-gain-step, pendulum-angular, pressure-bias, second-order-drift, second-order-loop, second-order-misalignment, second-order-step, self-gradient, self-gradient-yaw, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, spin-rate-offset, spin-servo, thermal-bias, thermal-lag, thermal-misalignment, thermal-scale, thermal-second-order, time-offset, vibration-level, vibration-rectification.
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
    ("disc-spin.share", True),
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
    x1 = omega_z**2.0
    M_xx = -Gamma_xx - x0 - x1
    M_xy = -Gamma_xy + omega_x*omega_y - omegadot_z
    M_xz = -Gamma_xz + omega_x*omega_z + omegadot_y
    M_yx = -Gamma_xy + omega_x*omega_y + omegadot_z
    x2 = omega_x**2.0
    M_yy = -Gamma_yy - x1 - x2
    M_yz = -Gamma_yz + omega_y*omega_z - omegadot_x
    M_zx = -Gamma_xz + omega_x*omega_z - omegadot_y
    M_zy = -Gamma_yz + omega_y*omega_z + omegadot_x
    M_zz = -Gamma_zz - x0 - x2
    cos_psi = cos_j*cos_phi - sin_j*sin_phi
    sin_psi = cos_j*sin_phi + cos_phi*sin_j
    x3 = dR + radius
    f_disc_r_x = x3
    f_disc_r_y = beta_z*x3
    f_disc_r_z = beta_x*x3
    f_disc_tau_zy = -beta_x*beta_z
    f_r_x = cos_psi*f_disc_r_x - f_disc_r_y*sin_psi
    f_r_y = cos_psi*f_disc_r_y + f_disc_r_x*sin_psi
    x4 = beta_z*cos_psi + sin_psi
    f_tau_xx = -x4
    x5 = -beta_z*sin_psi + cos_psi
    f_tau_xy = x5
    f_tau_yx = x5
    f_tau_yy = x4
    f_tau_zx = -beta_x*cos_psi - f_disc_tau_zy*sin_psi
    f_tau_zy = -beta_x*sin_psi + cos_psi*f_disc_tau_zy
    f_f_x = M_xx*f_r_x + M_xy*f_r_y + M_xz*f_disc_r_z + a_x
    f_f_y = M_yx*f_r_x + M_yy*f_r_y + M_yz*f_disc_r_z + a_y
    f_f_z = M_zx*f_r_x + M_zy*f_r_y + M_zz*f_disc_r_z + a_z
    f_f_xj = f_f_x*f_tau_xx + f_f_y*f_tau_xy
    f_f_yj = -beta_x*f_f_z + f_f_x*f_tau_yx + f_f_y*f_tau_yy
    f_f_zj = f_f_x*f_tau_zx + f_f_y*f_tau_zy - f_f_z
    f_f_i = f_f_xj + f_f_yj*vartheta_z - f_f_zj*vartheta_y
    q_disc_r_x = x3
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
    spin_frequency = q[1]
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
    x11 = omega_z**2.0
    x12 = x10 + x11
    x13 = -Gamma_xx - x12
    M_xx = x13
    x14 = omega_x*omega_y
    x15 = -Gamma_xy - omegadot_z + x14
    M_xy = x15
    x16 = omega_x*omega_z
    x17 = omegadot_y + x16
    x18 = -Gamma_xz + x17
    M_xz = x18
    x19 = omegadot_z + x14
    x20 = -Gamma_xy + x19
    M_yx = x20
    x21 = omega_x**2.0
    x22 = x11 + x21
    x23 = -Gamma_yy - x22
    M_yy = x23
    x24 = omega_y*omega_z
    x25 = -Gamma_yz - omegadot_x + x24
    M_yz = x25
    x26 = -Gamma_xz - omegadot_y + x16
    M_zx = x26
    x27 = omegadot_x + x24
    x28 = -Gamma_yz + x27
    M_zy = x28
    x29 = x10 + x21
    x30 = -Gamma_zz - x29
    M_zz = x30
    cos_psi = cos_j*cos_phi - sin_j*sin_phi
    sin_psi = cos_j*sin_phi + cos_phi*sin_j
    x31 = dR + radius
    b_disc_r_x = x31
    x32 = beta_z*x31
    b_disc_r_y = x32
    x33 = beta_x*x31
    b_disc_r_z = x33
    x34 = -beta_x*beta_z
    b_disc_tau_zy = x34
    b_r_x = b_disc_r_x*cos_psi - b_disc_r_y*sin_psi
    b_r_y = b_disc_r_x*sin_psi + b_disc_r_y*cos_psi
    x35 = beta_z*cos_psi + sin_psi
    x36 = -x35
    b_tau_xx = x36
    x37 = -beta_z*sin_psi + cos_psi
    b_tau_xy = x37
    b_tau_yx = x37
    b_tau_yy = x35
    x38 = beta_x*cos_psi
    b_tau_zx = -b_disc_tau_zy*sin_psi - x38
    x39 = beta_x*sin_psi
    b_tau_zy = b_disc_tau_zy*cos_psi - x39
    x40 = 2.0*sin_phi
    x41 = np.pi*spin_frequency
    x42 = -x40*x41
    rate_cos_phi_true = x42
    x43 = 2.0*cos_phi
    x44 = x41*x43
    rate_sin_phi_true = x44
    x45 = 4.0*cos_phi
    x46 = np.pi**2.0*spin_frequency**2.0
    x47 = -x45*x46
    rate_rate_cos_phi_true = x47
    x48 = 4.0*sin_phi
    x49 = -x46*x48
    rate_rate_sin_phi_true = x49
    x50 = 2.0*omega_z
    x51 = -d_spin_angle**2.0 - d_spin_angle*x50
    spin_xx = x51
    spin_yy = x51
    x52 = d_spin_angle*omega_x
    spin_zx = 2.0*x52
    x53 = d_spin_angle*omega_y
    spin_zy = 2.0*x53
    b_f_x = M_xx*b_r_x + M_xy*b_r_y + M_xz*b_disc_r_z + a_x
    b_f_y = M_yx*b_r_x + M_yy*b_r_y + M_yz*b_disc_r_z + a_y
    b_f_z = M_zx*b_r_x + M_zy*b_r_y + M_zz*b_disc_r_z + a_z
    b_f_xj = b_f_x*b_tau_xx + b_f_y*b_tau_xy
    b_f_yj = b_f_x*b_tau_yx + b_f_y*b_tau_yy - b_f_z*beta_x
    b_f_zj = b_f_x*b_tau_zx + b_f_y*b_tau_zy - b_f_z
    f_disc_r_x = x31
    f_disc_r_y = x32
    f_disc_r_z = x33
    f_disc_tau_zy = x34
    f_r_x = cos_psi*f_disc_r_x - f_disc_r_y*sin_psi
    f_r_y = cos_psi*f_disc_r_y + f_disc_r_x*sin_psi
    f_tau_xx = x36
    f_tau_xy = x37
    f_tau_yx = x37
    f_tau_yy = x35
    f_tau_zx = -f_disc_tau_zy*sin_psi - x38
    f_tau_zy = cos_psi*f_disc_tau_zy - x39
    x54 = x31**(-1.0)
    f_arm_x = f_r_x*x54
    f_arm_y = f_r_y*x54
    f_arm_z = f_disc_r_z*x54
    x55 = 2.0*omega_y
    x56 = omegadot_y*x55
    x57 = omegadot_z*x50
    x58 = -x56 - x57
    rate_M_xx = x58
    x59 = omega_x*omegadot_y + omega_y*omegadot_x
    x60 = -d_omegadot_z + x59
    rate_M_xy = x60
    x61 = omega_x*omegadot_z + omega_z*omegadot_x
    x62 = d_omegadot_y + x61
    rate_M_xz = x62
    V2__rate_cos_phi_true = x42
    V2__rate_sin_phi_true = x44
    rate_cos_psi = V2__rate_cos_phi_true*cos_j - V2__rate_sin_phi_true*sin_j
    rate_sin_psi = V2__rate_cos_phi_true*sin_j + V2__rate_sin_phi_true*cos_j
    rate_b_r_x = b_disc_r_x*rate_cos_psi - b_disc_r_y*rate_sin_psi
    rate_b_r_y = b_disc_r_x*rate_sin_psi + b_disc_r_y*rate_cos_psi
    rate_b_f_x = M_xx*rate_b_r_x + M_xy*rate_b_r_y + b_disc_r_z*rate_M_xz + b_r_x*rate_M_xx + b_r_y*rate_M_xy + d_a_x
    x63 = d_omegadot_z + x59
    rate_M_yx = x63
    x64 = 2.0*omegadot_x
    x65 = omega_x*x64
    x66 = -x57 - x65
    rate_M_yy = x66
    x67 = omega_y*omegadot_z + omega_z*omegadot_y
    x68 = -d_omegadot_x + x67
    rate_M_yz = x68
    rate_b_f_y = M_yx*rate_b_r_x + M_yy*rate_b_r_y + b_disc_r_z*rate_M_yz + b_r_x*rate_M_yx + b_r_y*rate_M_yy + d_a_y
    x69 = -d_omegadot_y + x61
    rate_M_zx = x69
    x70 = d_omegadot_x + x67
    rate_M_zy = x70
    x71 = -x56 - x65
    rate_M_zz = x71
    rate_b_f_z = M_zx*rate_b_r_x + M_zy*rate_b_r_y + b_disc_r_z*rate_M_zz + b_r_x*rate_M_zx + b_r_y*rate_M_zy + d_a_z
    rate_b_tau_yx = -beta_z*rate_sin_psi + rate_cos_psi
    rate_b_tau_yy = beta_z*rate_cos_psi + rate_sin_psi
    rate_b_f_yj = b_f_x*rate_b_tau_yx + b_f_y*rate_b_tau_yy + b_tau_yx*rate_b_f_x + b_tau_yy*rate_b_f_y - beta_x*rate_b_f_z
    rate_b_tau_zx = -b_disc_tau_zy*rate_sin_psi - beta_x*rate_cos_psi
    rate_b_tau_zy = b_disc_tau_zy*rate_cos_psi - beta_x*rate_sin_psi
    rate_b_f_zj = b_f_x*rate_b_tau_zx + b_f_y*rate_b_tau_zy + b_tau_zx*rate_b_f_x + b_tau_zy*rate_b_f_y - rate_b_f_z
    rate_V2__rate_cos_phi_true = x47
    rate_V2__rate_sin_phi_true = x49
    x72 = d_omegadot_z*x50 + 2.0*omegadot_z**2.0
    x73 = d_omegadot_y*x55 + 2.0*omegadot_y**2.0
    x74 = -x72 - x73
    rate_rate_M_xx = x74
    x75 = d_omegadot_x*omega_y + d_omegadot_y*omega_x + omegadot_y*x64
    x76 = -d2_omegadot_z + x75
    rate_rate_M_xy = x76
    x77 = d_omegadot_x*omega_z + d_omegadot_z*omega_x + omegadot_z*x64
    x78 = d2_omegadot_y + x77
    rate_rate_M_xz = x78
    rate_rate_cos_psi = cos_j*rate_V2__rate_cos_phi_true - rate_V2__rate_sin_phi_true*sin_j
    rate_rate_sin_psi = cos_j*rate_V2__rate_sin_phi_true + rate_V2__rate_cos_phi_true*sin_j
    rate_rate_b_r_x = b_disc_r_x*rate_rate_cos_psi - b_disc_r_y*rate_rate_sin_psi
    rate_rate_b_r_y = b_disc_r_x*rate_rate_sin_psi + b_disc_r_y*rate_rate_cos_psi
    x79 = 2.0*rate_b_r_x
    x80 = 2.0*rate_b_r_y
    rate_rate_b_f_x = M_xx*rate_rate_b_r_x + M_xy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_xz + b_r_x*rate_rate_M_xx + b_r_y*rate_rate_M_xy + d2_a_x + rate_M_xx*x79 + rate_M_xy*x80
    x81 = d2_omegadot_z + x75
    rate_rate_M_yx = x81
    x82 = 2.0*omega_x
    x83 = d_omegadot_x*x82 + 2.0*omegadot_x**2.0
    x84 = -x72 - x83
    rate_rate_M_yy = x84
    x85 = d_omegadot_y*omega_z + d_omegadot_z*omega_y + 2.0*omegadot_y*omegadot_z
    x86 = -d2_omegadot_x + x85
    rate_rate_M_yz = x86
    rate_rate_b_f_y = M_yx*rate_rate_b_r_x + M_yy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_yz + b_r_x*rate_rate_M_yx + b_r_y*rate_rate_M_yy + d2_a_y + rate_M_yx*x79 + rate_M_yy*x80
    x87 = -d2_omegadot_y + x77
    rate_rate_M_zx = x87
    x88 = d2_omegadot_x + x85
    rate_rate_M_zy = x88
    x89 = -x73 - x83
    rate_rate_M_zz = x89
    rate_rate_b_f_z = M_zx*rate_rate_b_r_x + M_zy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_zz + b_r_x*rate_rate_M_zx + b_r_y*rate_rate_M_zy + d2_a_z + rate_M_zx*x79 + rate_M_zy*x80
    rate_rate_b_tau_yx = -beta_z*rate_rate_sin_psi + rate_rate_cos_psi
    rate_rate_b_tau_yy = beta_z*rate_rate_cos_psi + rate_rate_sin_psi
    x90 = 2.0*rate_b_f_x
    x91 = 2.0*rate_b_f_y
    rate_rate_b_f_yj = b_f_x*rate_rate_b_tau_yx + b_f_y*rate_rate_b_tau_yy + b_tau_yx*rate_rate_b_f_x + b_tau_yy*rate_rate_b_f_y - beta_x*rate_rate_b_f_z + rate_b_tau_yx*x90 + rate_b_tau_yy*x91
    rate_rate_b_tau_zx = -b_disc_tau_zy*rate_rate_sin_psi - beta_x*rate_rate_cos_psi
    rate_rate_b_tau_zy = b_disc_tau_zy*rate_rate_cos_psi - beta_x*rate_rate_sin_psi
    rate_rate_b_f_zj = b_f_x*rate_rate_b_tau_zx + b_f_y*rate_rate_b_tau_zy + b_tau_zx*rate_rate_b_f_x + b_tau_zy*rate_rate_b_f_y + rate_b_tau_zx*x90 + rate_b_tau_zy*x91 - rate_rate_b_f_z
    f_f_x = M_xx*f_r_x + M_xy*f_r_y + M_xz*f_disc_r_z + a_x
    f_f_y = M_yx*f_r_x + M_yy*f_r_y + M_yz*f_disc_r_z + a_y
    f_f_z = M_zx*f_r_x + M_zy*f_r_y + M_zz*f_disc_r_z + a_z
    f_f_xj = f_f_x*f_tau_xx + f_f_y*f_tau_xy
    f_f_yj = -beta_x*f_f_z + f_f_x*f_tau_yx + f_f_y*f_tau_yy
    f_f_zj = f_f_x*f_tau_zx + f_f_y*f_tau_zy - f_f_z
    f_f_i = f_f_xj + f_f_yj*vartheta_z - f_f_zj*vartheta_y
    f_f_o = -f_f_xj*vartheta_z + f_f_yj + f_f_zj*vartheta_x
    f_f_p = f_f_xj*vartheta_y - f_f_yj*vartheta_x + f_f_zj
    q_disc_r_x = x31
    q_r_x = cos_psi*q_disc_r_x
    q_r_y = q_disc_r_x*sin_psi
    q_arm_x = q_r_x*x54
    q_arm_y = q_r_y*x54
    q_f_x = M_xx*q_r_x + M_xy*q_r_y + a_x
    q_f_y = M_yx*q_r_x + M_yy*q_r_y + a_y
    q_f_z = M_zx*q_r_x + M_zy*q_r_y + a_z
    q_f_xj = cos_psi*q_f_y - q_f_x*sin_psi
    q_f_yj = cos_psi*q_f_x + q_f_y*sin_psi
    x92 = K6*q_f_yj
    x93 = q_f_xj**2.0
    x94 = K4*q_f_z
    x95 = K8*q_f_z
    i_sensed = K0 + K2*x93 + K5*q_f_yj**2.0 + K7*q_f_z**2.0 + f_f_i + q_f_xj*x92 - q_f_xj*x94 - q_f_yj*x95
    V2__rate_M_xx = x58
    V2__rate_M_xy = x60
    V2__rate_M_xz = x62
    V2__rate_cos_psi = cos_j*rate_cos_phi_true - rate_sin_phi_true*sin_j
    V2__rate_sin_psi = cos_j*rate_sin_phi_true + rate_cos_phi_true*sin_j
    rate_f_r_x = V2__rate_cos_psi*f_disc_r_x - V2__rate_sin_psi*f_disc_r_y
    rate_f_r_y = V2__rate_cos_psi*f_disc_r_y + V2__rate_sin_psi*f_disc_r_x
    rate_f_f_x = M_xx*rate_f_r_x + M_xy*rate_f_r_y + V2__rate_M_xx*f_r_x + V2__rate_M_xy*f_r_y + V2__rate_M_xz*f_disc_r_z + d_a_x
    V2__rate_M_yx = x63
    V2__rate_M_yy = x66
    V2__rate_M_yz = x68
    rate_f_f_y = M_yx*rate_f_r_x + M_yy*rate_f_r_y + V2__rate_M_yx*f_r_x + V2__rate_M_yy*f_r_y + V2__rate_M_yz*f_disc_r_z + d_a_y
    x96 = V2__rate_cos_psi*beta_z + V2__rate_sin_psi
    rate_f_tau_xx = -x96
    x97 = V2__rate_cos_psi - V2__rate_sin_psi*beta_z
    rate_f_tau_xy = x97
    rate_f_f_xj = f_f_x*rate_f_tau_xx + f_f_y*rate_f_tau_xy + f_tau_xx*rate_f_f_x + f_tau_xy*rate_f_f_y
    V2__rate_M_zx = x69
    V2__rate_M_zy = x70
    V2__rate_M_zz = x71
    rate_f_f_z = M_zx*rate_f_r_x + M_zy*rate_f_r_y + V2__rate_M_zx*f_r_x + V2__rate_M_zy*f_r_y + V2__rate_M_zz*f_disc_r_z + d_a_z
    rate_f_tau_yx = x97
    rate_f_tau_yy = x96
    rate_f_f_yj = -beta_x*rate_f_f_z + f_f_x*rate_f_tau_yx + f_f_y*rate_f_tau_yy + f_tau_yx*rate_f_f_x + f_tau_yy*rate_f_f_y
    rate_f_tau_zx = -V2__rate_cos_psi*beta_x - V2__rate_sin_psi*f_disc_tau_zy
    rate_f_tau_zy = V2__rate_cos_psi*f_disc_tau_zy - V2__rate_sin_psi*beta_x
    rate_f_f_zj = f_f_x*rate_f_tau_zx + f_f_y*rate_f_tau_zy + f_tau_zx*rate_f_f_x + f_tau_zy*rate_f_f_y - rate_f_f_z
    rate_f_f_i = rate_f_f_xj + rate_f_f_yj*vartheta_z - rate_f_f_zj*vartheta_y
    rate_V2__rate_M_xx = x74
    rate_V2__rate_M_xy = x76
    rate_V2__rate_M_xz = x78
    rate_V2__rate_cos_psi = cos_j*rate_rate_cos_phi_true - rate_rate_sin_phi_true*sin_j
    rate_V2__rate_sin_psi = cos_j*rate_rate_sin_phi_true + rate_rate_cos_phi_true*sin_j
    rate_rate_f_r_x = f_disc_r_x*rate_V2__rate_cos_psi - f_disc_r_y*rate_V2__rate_sin_psi
    rate_rate_f_r_y = f_disc_r_x*rate_V2__rate_sin_psi + f_disc_r_y*rate_V2__rate_cos_psi
    x98 = 2.0*rate_f_r_x
    x99 = 2.0*rate_f_r_y
    rate_rate_f_f_x = M_xx*rate_rate_f_r_x + M_xy*rate_rate_f_r_y + V2__rate_M_xx*x98 + V2__rate_M_xy*x99 + d2_a_x + f_disc_r_z*rate_V2__rate_M_xz + f_r_x*rate_V2__rate_M_xx + f_r_y*rate_V2__rate_M_xy
    rate_V2__rate_M_yx = x81
    rate_V2__rate_M_yy = x84
    rate_V2__rate_M_yz = x86
    rate_rate_f_f_y = M_yx*rate_rate_f_r_x + M_yy*rate_rate_f_r_y + V2__rate_M_yx*x98 + V2__rate_M_yy*x99 + d2_a_y + f_disc_r_z*rate_V2__rate_M_yz + f_r_x*rate_V2__rate_M_yx + f_r_y*rate_V2__rate_M_yy
    x100 = beta_z*rate_V2__rate_cos_psi + rate_V2__rate_sin_psi
    rate_rate_f_tau_xx = -x100
    x101 = -beta_z*rate_V2__rate_sin_psi + rate_V2__rate_cos_psi
    rate_rate_f_tau_xy = x101
    x102 = 2.0*rate_f_f_x
    x103 = 2.0*rate_f_f_y
    rate_rate_f_f_xj = f_f_x*rate_rate_f_tau_xx + f_f_y*rate_rate_f_tau_xy + f_tau_xx*rate_rate_f_f_x + f_tau_xy*rate_rate_f_f_y + rate_f_tau_xx*x102 + rate_f_tau_xy*x103
    rate_V2__rate_M_zx = x87
    rate_V2__rate_M_zy = x88
    rate_V2__rate_M_zz = x89
    rate_rate_f_f_z = M_zx*rate_rate_f_r_x + M_zy*rate_rate_f_r_y + V2__rate_M_zx*x98 + V2__rate_M_zy*x99 + d2_a_z + f_disc_r_z*rate_V2__rate_M_zz + f_r_x*rate_V2__rate_M_zx + f_r_y*rate_V2__rate_M_zy
    rate_rate_f_tau_yx = x101
    rate_rate_f_tau_yy = x100
    rate_rate_f_f_yj = -beta_x*rate_rate_f_f_z + f_f_x*rate_rate_f_tau_yx + f_f_y*rate_rate_f_tau_yy + f_tau_yx*rate_rate_f_f_x + f_tau_yy*rate_rate_f_f_y + rate_f_tau_yx*x102 + rate_f_tau_yy*x103
    rate_rate_f_tau_zx = -beta_x*rate_V2__rate_cos_psi - f_disc_tau_zy*rate_V2__rate_sin_psi
    rate_rate_f_tau_zy = -beta_x*rate_V2__rate_sin_psi + f_disc_tau_zy*rate_V2__rate_cos_psi
    rate_rate_f_f_zj = f_f_x*rate_rate_f_tau_zx + f_f_y*rate_rate_f_tau_zy + f_tau_zx*rate_rate_f_f_x + f_tau_zy*rate_rate_f_f_y + rate_f_tau_zx*x102 + rate_f_tau_zy*x103 - rate_rate_f_f_z
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
    x104 = 2.0*rate_q_r_x
    x105 = 2.0*rate_q_r_y
    rate_rate_q_f_x = M_xx*rate_rate_q_r_x + M_xy*rate_rate_q_r_y + V2__rate_M_xx*x104 + V2__rate_M_xy*x105 + d2_a_x + q_r_x*rate_V2__rate_M_xx + q_r_y*rate_V2__rate_M_xy
    rate_rate_q_f_y = M_yx*rate_rate_q_r_x + M_yy*rate_rate_q_r_y + V2__rate_M_yx*x104 + V2__rate_M_yy*x105 + d2_a_y + q_r_x*rate_V2__rate_M_yx + q_r_y*rate_V2__rate_M_yy
    x106 = 2.0*rate_q_f_y
    x107 = 2.0*rate_q_f_x
    rate_rate_q_f_xj = V2__rate_cos_psi*x106 - V2__rate_sin_psi*x107 + cos_psi*rate_rate_q_f_y - q_f_x*rate_V2__rate_sin_psi + q_f_y*rate_V2__rate_cos_psi - rate_rate_q_f_x*sin_psi
    rate_rate_q_f_yj = V2__rate_cos_psi*x107 + V2__rate_sin_psi*x106 + cos_psi*rate_rate_q_f_x + q_f_x*rate_V2__rate_cos_psi + q_f_y*rate_V2__rate_sin_psi + rate_rate_q_f_y*sin_psi
    rate_rate_q_f_z = M_zx*rate_rate_q_r_x + M_zy*rate_rate_q_r_y + V2__rate_M_zx*x104 + V2__rate_M_zy*x105 + d2_a_z + q_r_x*rate_V2__rate_M_zx + q_r_y*rate_V2__rate_M_zy
    x108 = 2.0*K2
    x109 = 2.0*K5
    x110 = 2.0*K7
    x111 = q_f_xj*x108 + x92 - x94
    x112 = K6*q_f_xj + q_f_yj*x109 - x95
    x113 = K4*q_f_xj + K8*q_f_yj - q_f_z*x110
    rate_rate_i_sensed = rate_q_f_xj*(-K4*rate_q_f_z + K6*rate_q_f_yj + rate_q_f_xj*x108) + rate_q_f_yj*(K6*rate_q_f_xj - K8*rate_q_f_z + rate_q_f_yj*x109) - rate_q_f_z*(K4*rate_q_f_xj + K8*rate_q_f_yj - rate_q_f_z*x110) + rate_rate_f_f_i + rate_rate_q_f_xj*x111 + rate_rate_q_f_yj*x112 - rate_rate_q_f_z*x113
    x114 = f_tau_xx + f_tau_yx*vartheta_z - f_tau_zx*vartheta_y
    vibration_axis_ix = x114
    x115 = f_tau_xy + f_tau_yy*vartheta_z - f_tau_zy*vartheta_y
    vibration_axis_iy = x115
    x116 = -beta_x*vartheta_z + vartheta_y
    vibration_axis_iz = x116
    vibration_axis_ox = -f_tau_xx*vartheta_z + f_tau_yx + f_tau_zx*vartheta_x
    vibration_axis_oy = -f_tau_xy*vartheta_z + f_tau_yy + f_tau_zy*vartheta_x
    vibration_axis_oz = -beta_x - vartheta_x
    vibration_axis_px = f_tau_xx*vartheta_y - f_tau_yx*vartheta_x + f_tau_zx
    vibration_axis_py = f_tau_xy*vartheta_y - f_tau_yy*vartheta_x + f_tau_zy
    vibration_axis_pz = beta_x*vartheta_x - 1
    bar_i_vibration_rectification = K1*k_VI
    bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x113
    bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x112
    bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x111
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
    x117 = d_spin_angle + omega_z
    x118 = 2.0*x117
    bar_rate_dR_arm_stretch = bar_f_f_x*(-f_arm_y*x118 + 2.0*f_arm_z*omega_y) + bar_f_f_y*(f_arm_x*x118 - f_arm_z*x82) + bar_f_f_z*(-f_arm_x*x55 + 2.0*f_arm_y*omega_x) - bar_q_f_x*q_arm_y*x118 + bar_q_f_y*q_arm_x*x118 - bar_q_p_second_order_misalignment*(-q_arm_x*x55 + q_arm_y*x82)
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
    bar_K2_thermal_second_order = bar_i_vibration_rectification*x93
    bar_K1_thermal_scale = i_sensed*k_VI
    bar_vartheta_y_thermal_misalignment = -bar_i_vibration_rectification*f_f_zj
    bar_vartheta_z_mount_hysteresis = bar_i_vibration_rectification*f_f_yj
    bar_dR_arm_stretch = bar_f_disc_r_x + bar_f_disc_r_y*beta_z + bar_f_spin_axis_wobble_r_z*beta_x + bar_q_disc_r_x
    x119 = bar_f_f_z - bar_q_p_second_order_misalignment
    bar_rate_rate_run_out_z = x119
    x120 = bar_f_f_y + bar_q_f_y
    bar_rate_rate_run_out_y = x120
    x121 = bar_f_f_x + bar_q_f_x
    bar_rate_rate_run_out_x = x121
    bar_rate_run_out_z = bar_f_f_x*x55 - bar_f_f_y*x82 + bar_q_f_x*x55 - bar_q_f_y*x82
    bar_rate_run_out_y = -bar_f_f_x*x50 + 2.0*bar_f_f_z*omega_x - bar_q_f_x*x50 - bar_q_p_second_order_misalignment*x82
    bar_rate_run_out_x = bar_f_f_y*x50 - bar_f_f_z*x55 + bar_q_f_y*x50 + bar_q_p_second_order_misalignment*x55
    bar_run_out_z = bar_f_f_x*x18 + bar_f_f_y*x25 + bar_f_f_z*x30 + bar_q_f_x*x18 + bar_q_f_y*x25 - bar_q_p_second_order_misalignment*x30
    bar_run_out_y = bar_f_f_x*x15 + bar_f_f_y*x23 + bar_f_f_z*x28 + bar_q_f_x*x15 + bar_q_f_y*x23 - bar_q_p_second_order_misalignment*x28
    bar_run_out_x = bar_f_f_x*x13 + bar_f_f_y*x20 + bar_f_f_z*x26 + bar_q_f_x*x13 + bar_q_f_y*x20 - bar_q_p_second_order_misalignment*x26
    bar_wobble_zy = bar_f_spin_axis_wobble_r_z*f_r_y + bar_f_spin_axis_wobble_tau_xz*f_tau_xy + bar_f_spin_axis_wobble_tau_yz*f_tau_yy + bar_f_spin_axis_wobble_tau_zz*f_tau_zy + bar_q_spin_axis_wobble_r_z*q_r_y + bar_q_spin_axis_wobble_tau_xz*cos_psi + bar_q_spin_axis_wobble_tau_yz*sin_psi
    bar_wobble_zx = bar_f_spin_axis_wobble_r_z*f_r_x + bar_f_spin_axis_wobble_tau_xz*f_tau_xx + bar_f_spin_axis_wobble_tau_yz*f_tau_yx + bar_f_spin_axis_wobble_tau_zz*f_tau_zx + bar_q_spin_axis_wobble_r_z*q_r_x - bar_q_spin_axis_wobble_tau_xz*sin_psi + bar_q_spin_axis_wobble_tau_yz*cos_psi
    bar_wobble_yz = bar_f_spin_axis_wobble_r_y*f_disc_r_z - bar_f_spin_axis_wobble_tau_yy*beta_x - bar_f_spin_axis_wobble_tau_zy - bar_q_p_second_order_misalignment*q_f_y
    bar_wobble_xz = bar_f_spin_axis_wobble_r_x*f_disc_r_z - bar_f_spin_axis_wobble_tau_yx*beta_x - bar_f_spin_axis_wobble_tau_zx - bar_q_p_second_order_misalignment*q_f_x
    bar_sin_psi = -bar_f_spin_axis_wobble_r_x*f_disc_r_y + bar_f_spin_axis_wobble_r_y*f_disc_r_x - bar_f_spin_axis_wobble_tau_xx - bar_f_spin_axis_wobble_tau_xy*beta_z - bar_f_spin_axis_wobble_tau_yx*beta_z + bar_f_spin_axis_wobble_tau_yy - bar_f_spin_axis_wobble_tau_zx*f_disc_tau_zy - bar_f_spin_axis_wobble_tau_zy*beta_x + bar_q_spin_axis_wobble_r_y*q_disc_r_x - bar_q_spin_axis_wobble_tau_xx + bar_q_spin_axis_wobble_tau_yy
    bar_cos_psi = bar_f_spin_axis_wobble_r_x*f_disc_r_x + bar_f_spin_axis_wobble_r_y*f_disc_r_y - bar_f_spin_axis_wobble_tau_xx*beta_z + bar_f_spin_axis_wobble_tau_xy + bar_f_spin_axis_wobble_tau_yx + bar_f_spin_axis_wobble_tau_yy*beta_z - bar_f_spin_axis_wobble_tau_zx*beta_x + bar_f_spin_axis_wobble_tau_zy*f_disc_tau_zy + bar_q_spin_axis_wobble_r_x*q_disc_r_x + bar_q_spin_axis_wobble_tau_xy + bar_q_spin_axis_wobble_tau_yx
    x122 = bar_f_f_z*f_disc_r_z
    bar_M_zz = x122
    x123 = bar_f_f_z*f_r_y
    x124 = bar_q_p_second_order_misalignment*q_r_y
    bar_M_zy = x123 - x124
    x125 = bar_q_p_second_order_misalignment*q_r_x
    bar_M_zx = bar_f_f_z*f_r_x - x125
    x126 = bar_f_f_y*f_disc_r_z
    bar_M_yz = x126
    x127 = bar_f_f_y*f_r_y
    x128 = bar_q_f_y*q_r_y
    bar_M_yy = x127 + x128
    x129 = bar_q_f_y*q_r_x
    bar_M_yx = bar_f_f_y*f_r_x + x129
    x130 = bar_f_f_x*f_disc_r_z
    bar_M_xz = x130
    x131 = bar_f_f_x*f_r_y
    x132 = bar_q_f_x*q_r_y
    bar_M_xy = x131 + x132
    x133 = bar_q_f_x*q_r_x
    bar_M_xx = bar_f_f_x*f_r_x + x133
    bar_sin_phi_true = -bar_cos_psi*sin_j + bar_sin_psi*cos_j
    bar_cos_phi_true = bar_cos_psi*cos_j + bar_sin_psi*sin_j
    bar_sin_delta_phi = -bar_cos_phi_true*sin_phi + bar_sin_phi_true*cos_phi
    bar_time_offset_omegadot_z = -bar_M_xy + bar_M_yx
    bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx
    bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy
    bar_time_offset_omega_z = -bar_M_xx*x50 + bar_M_xz*omega_x - bar_M_yy*x50 + bar_M_yz*omega_y + bar_M_zx*omega_x + bar_M_zy*omega_y
    bar_time_offset_omega_y = -bar_M_xx*x55 + bar_M_xy*omega_x + bar_M_yx*omega_x + bar_M_yz*omega_z + bar_M_zy*omega_z - bar_M_zz*x55
    bar_time_offset_omega_x = bar_M_xy*omega_y + bar_M_xz*omega_z + bar_M_yx*omega_y - bar_M_yy*x82 + bar_M_zx*omega_z - bar_M_zz*x82
    bar_time_offset_a_z = x119
    bar_time_offset_a_y = x120
    bar_time_offset_a_x = x121
    bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy
    bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx
    bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx
    x134 = a_y*bar_time_offset_a_z
    x135 = bar_time_offset_omega_z*omega_y
    x136 = bar_time_offset_omegadot_z*omegadot_y
    x137 = x135 + x136
    bar_imu_turn_zy = x134 + x137
    x138 = a_x*bar_time_offset_a_z
    x139 = bar_time_offset_omega_z*omega_x + bar_time_offset_omegadot_z*omegadot_x
    x140 = x138 + x139
    bar_imu_turn_zx = x140
    x141 = a_z*bar_time_offset_a_y
    x142 = bar_time_offset_omega_y*omega_z + bar_time_offset_omegadot_y*omegadot_z
    x143 = x141 + x142
    bar_imu_turn_yz = x143
    x144 = a_x*bar_time_offset_a_y
    x145 = bar_time_offset_omega_y*omega_x + bar_time_offset_omegadot_y*omegadot_x
    bar_imu_turn_yx = x144 + x145
    x146 = a_z*bar_time_offset_a_x
    x147 = bar_time_offset_omega_x*omega_z
    x148 = bar_time_offset_omegadot_x*omegadot_z
    x149 = x147 + x148
    bar_imu_turn_xz = x146 + x149
    x150 = a_y*bar_time_offset_a_x
    x151 = bar_time_offset_omega_x*omega_y + bar_time_offset_omegadot_x*omegadot_y
    bar_imu_turn_xy = x150 + x151
    x152 = angular_vibration_rms**2.0
    x153 = bar_M_yy*x152
    x154 = bar_M_zz*x152
    x155 = bar_M_xx*x152
    x156 = K1*bar_K1_thermal_scale
    x157 = bar_run_out_x*cos_phi
    x158 = bar_run_out_y*cos_phi
    x159 = bar_run_out_z*cos_phi
    x160 = rate_cos_phi_true*x43 - rate_sin_phi_true*x40
    x161 = cos_phi**2.0
    x162 = sin_phi**2.0
    x163 = x161 - x162
    x164 = 2.0*rate_cos_phi_true**2.0 + rate_rate_cos_phi_true*x43 - rate_rate_sin_phi_true*x40 - 2.0*rate_sin_phi_true**2.0
    x165 = rate_cos_phi_true*x40 + rate_sin_phi_true*x43
    x166 = 4.0*rate_cos_phi_true*rate_sin_phi_true + rate_rate_cos_phi_true*x40 + rate_rate_sin_phi_true*x43
    x167 = attitude_yx**2.0
    x168 = attitude_yz**2.0
    x169 = attitude_xx*attitude_yx
    x170 = attitude_xz*attitude_yz
    x171 = -x170
    x172 = attitude_xx*attitude_zx
    x173 = attitude_xz*attitude_zz
    x174 = -x173
    x175 = attitude_yx*attitude_zx
    x176 = attitude_yz*attitude_zz
    x177 = -x176
    x178 = attitude_xz**2.0
    x179 = attitude_xx**2.0
    x180 = attitude_zx**2.0
    x181 = attitude_zz**2.0
    x182 = 1 - x181
    x183 = 2.0*bar_M_xx
    x184 = attitude_xx*x183
    x185 = 2.0*bar_M_yy
    x186 = attitude_yx*x185
    x187 = 2.0*attitude_zx
    x188 = bar_M_zz*x187
    x189 = attitude_xx*attitude_zy
    x190 = attitude_xy*attitude_zx
    x191 = attitude_yx*attitude_zy
    x192 = attitude_yy*attitude_zx
    x193 = attitude_xx*attitude_yy
    x194 = attitude_xy*attitude_yx
    x195 = attitude_xx*attitude_yz
    x196 = attitude_xz*attitude_yx
    x197 = attitude_yx*attitude_zz
    x198 = attitude_yz*attitude_zx
    x199 = attitude_xx*attitude_zz
    x200 = attitude_xz*attitude_zx
    x201 = attitude_xy**2.0
    x202 = attitude_xy*attitude_yy
    x203 = attitude_xy*attitude_zy
    x204 = attitude_yy*attitude_zy
    x205 = attitude_yy**2.0
    x206 = attitude_zy**2.0
    x207 = attitude_xy*attitude_xz
    x208 = attitude_yy*attitude_yz
    x209 = 2.0*attitude_zy*attitude_zz
    x210 = attitude_xy*attitude_yz
    x211 = attitude_xz*attitude_yy
    x212 = attitude_xy*attitude_zz
    x213 = attitude_xz*attitude_zy
    x214 = attitude_yy*attitude_zz
    x215 = attitude_yz*attitude_zy
    x216 = -fuel_mass*x170
    x217 = -fuel_mass*x173
    x218 = -fuel_mass*x176
    x219 = -fuel_mass*x178
    x220 = -fuel_mass*x168
    x221 = -fuel_mass*x181
    x222 = bar_M_xx*fuel_mass
    x223 = 2.0*x222
    x224 = attitude_xx*x223
    x225 = bar_M_yy*fuel_mass
    x226 = 2.0*x225
    x227 = attitude_yx*x226
    x228 = bar_M_zz*fuel_mass
    x229 = x187*x228
    x230 = bar_time_offset_a_x*d_a_x
    x231 = bar_time_offset_a_y*d_a_y
    x232 = bar_time_offset_a_z*d_a_z
    x233 = bar_time_offset_omega_x*omegadot_x
    x234 = bar_time_offset_omega_y*omegadot_y
    x235 = bar_time_offset_omega_z*omegadot_z
    x236 = bar_time_offset_omegadot_x*d_omegadot_x
    x237 = bar_time_offset_omegadot_y*d_omegadot_y
    x238 = bar_time_offset_omegadot_z*d_omegadot_z
    x239 = bar_i_vibration_rectification*f_f_i**2.0
    x240 = f_f_o**2.0
    x241 = bar_i_vibration_rectification*f_f_i
    x242 = f_f_p**2.0
    x243 = bar_sin_delta_phi*cos_phi
    x244 = cos_phi**3.0
    x245 = sin_phi**3.0
    x246 = -bar_M_zz*fuel_mass
    x247 = -bar_M_zz
    x248 = x233 + x234 + x235
    x249 = x236 + x237 + x238
    x250 = -x146
    x251 = -x134
    x252 = a_x*bar_time_offset_a_x
    x253 = a_y*bar_time_offset_a_y
    x254 = -omegadot_y
    x255 = temperature - 293.15
    x256 = -x255
    x257 = C__heat_rr*sin_j**2.0 - 2.0*C__heat_rt*cos_j*sin_j + C__heat_tt*cos_j**2.0
    x258 = bar_i_vibration_rectification*i_sensed
    x259 = -C__play_radial*sin_j + C__play_tangential*cos_j
    x260 = f_r_x*x122
    x261 = 0.5*q_r_x**2.0
    x262 = 0.5*f_disc_r_z**2.0
    x263 = f_r_x**2.0
    x264 = 0.5*x263
    x265 = x262 - x264
    x266 = f_r_x*x130
    x267 = 0.5*q_r_y**2.0
    x268 = 0.5*f_r_y**2.0
    x269 = x262 - x268
    x270 = f_r_x*x126
    x271 = (1/6)*q_r_x**3.0
    x272 = f_r_x*x262
    x273 = -1/6*f_r_x**3.0 + x272
    x274 = f_disc_r_z**3.0
    x275 = (1/6)*x274
    x276 = -0.5*f_disc_r_z*x263 + x275
    x277 = f_r_y*x260
    x278 = f_r_y*x262
    x279 = -f_r_y*x264 + x278
    x280 = -f_r_x*x268 + x272
    x281 = f_disc_r_z*x268
    x282 = (1/6)*q_r_y**3.0
    x283 = -1/6*f_r_y**3.0 + x278
    x284 = x275 - x281
    x285 = bar_i_vibration_rectification*rate_rate_i_sensed
    x286 = -bar_M_zz*x6
    x287 = -bar_M_zz*x5
    x288 = -cos_yaw**2.0 + sin_yaw**2.0 + 1
    x289 = -x288
    x290 = cos_yaw*sin_yaw
    x291 = cos_yaw - 1
    x292 = -Gamma_zz
    x293 = 2.0*Gamma_yz
    x294 = 2.0*Gamma_xz
    x295 = vibration_rms**2.0
    x296 = K4*vibration_axis_ix
    x297 = vibration_axis_px*x296
    x298 = K6*vibration_axis_ix
    x299 = vibration_axis_ox*x298
    x300 = K8*vibration_axis_ox
    x301 = vibration_axis_px*x300
    x302 = K2*vibration_axis_ix**2.0
    x303 = K5*vibration_axis_ox**2.0
    x304 = K7*vibration_axis_px**2.0
    x305 = vibration_axis_py*x296
    x306 = K4*vibration_axis_px
    x307 = vibration_axis_iy*x306
    x308 = vibration_axis_oy*x298
    x309 = K6*vibration_axis_ox
    x310 = vibration_axis_iy*x309
    x311 = vibration_axis_py*x300
    x312 = K8*vibration_axis_px
    x313 = vibration_axis_oy*x312
    x314 = vibration_axis_ix*x108
    x315 = vibration_axis_iy*x314
    x316 = vibration_axis_ox*x109
    x317 = vibration_axis_oy*x316
    x318 = vibration_axis_px*x110
    x319 = vibration_axis_py*x318
    x320 = vibration_axis_pz*x296
    x321 = vibration_axis_iz*x306
    x322 = vibration_axis_oz*x298
    x323 = vibration_axis_iz*x309
    x324 = vibration_axis_pz*x300
    x325 = vibration_axis_oz*x312
    x326 = vibration_axis_iz*x314
    x327 = vibration_axis_oz*x316
    x328 = vibration_axis_pz*x318
    x329 = K4*vibration_axis_iy
    x330 = vibration_axis_py*x329
    x331 = K6*vibration_axis_iy
    x332 = vibration_axis_oy*x331
    x333 = K8*vibration_axis_oy
    x334 = vibration_axis_py*x333
    x335 = K2*vibration_axis_iy**2.0
    x336 = K5*vibration_axis_oy**2.0
    x337 = K7*vibration_axis_py**2.0
    x338 = vibration_axis_pz*x329
    x339 = K4*vibration_axis_iz
    x340 = vibration_axis_py*x339
    x341 = vibration_axis_oz*x331
    x342 = K6*vibration_axis_iz
    x343 = vibration_axis_oy*x342
    x344 = vibration_axis_pz*x333
    x345 = K8*vibration_axis_oz
    x346 = vibration_axis_py*x345
    x347 = vibration_axis_iy*vibration_axis_iz*x108
    x348 = vibration_axis_oy*vibration_axis_oz*x109
    x349 = vibration_axis_py*vibration_axis_pz*x110
    x350 = vibration_axis_pz*x339
    x351 = vibration_axis_oz*x342
    x352 = vibration_axis_pz*x345
    x353 = K2*vibration_axis_iz**2.0
    x354 = K5*vibration_axis_oz**2.0
    x355 = K7*vibration_axis_pz**2.0

    D = np.empty((len(ROWS), len(time)))
    D[0] = bar_i_vibration_rectification*np.sign(i_sensed)  # adc-nonlinearity.h
    D[1] = -x153 - x154  # angular-jitter.W_xx
    D[2] = -bar_spin_axis_tilt_Gamma_xy*x152  # angular-jitter.W_xy
    D[3] = -bar_spin_axis_tilt_Gamma_xz*x152  # angular-jitter.W_xz
    D[4] = -x154 - x155  # angular-jitter.W_yy
    D[5] = -bar_spin_axis_tilt_Gamma_yz*x152  # angular-jitter.W_yz
    D[6] = -x153 - x155  # angular-jitter.W_zz
    D[7] = bar_i_vibration_rectification*(f_tau_xx*omega_x + f_tau_xy*omega_y)*(f_tau_zx*omega_x + f_tau_zy*omega_y - x117)  # anisoinertia.K_ip
    D[8] = bar_dR_arm_stretch  # arm-length.delta_R
    D[9] = b_f_zj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_zj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_zj  # arm-sag.c_z
    D[10] = b_f_yj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_yj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_yj  # arm-stretch.c_r
    D[11] = balance_current*x156  # balancing-loop.dK1_di
    D[12] = bar_K2_thermal_second_order*second_order_current  # balancing-loop.dK2_di
    D[13] = bar_rate_rate_run_out_x*rate_rate_cos_phi_true + bar_rate_run_out_x*rate_cos_phi_true + x157  # bearing-run-out.c_x1
    D[14] = bar_rate_rate_run_out_x*rate_rate_sin_phi_true + bar_rate_run_out_x*rate_sin_phi_true + bar_run_out_x*sin_phi  # bearing-run-out.s_x1
    D[15] = bar_rate_rate_run_out_y*rate_rate_cos_phi_true + bar_rate_run_out_y*rate_cos_phi_true + x158  # bearing-run-out.c_y1
    D[16] = bar_rate_rate_run_out_y*rate_rate_sin_phi_true + bar_rate_run_out_y*rate_sin_phi_true + bar_run_out_y*sin_phi  # bearing-run-out.s_y1
    D[17] = bar_rate_rate_run_out_z*rate_rate_cos_phi_true + bar_rate_run_out_z*rate_cos_phi_true + x159  # bearing-run-out.c_z1
    D[18] = bar_rate_rate_run_out_z*rate_rate_sin_phi_true + bar_rate_run_out_z*rate_sin_phi_true + bar_run_out_z*sin_phi  # bearing-run-out.s_z1
    D[19] = bar_rate_rate_run_out_x*x164 + bar_rate_run_out_x*x160 + bar_run_out_x*x163  # bearing-run-out.c_x2
    D[20] = bar_rate_rate_run_out_x*x166 + bar_rate_run_out_x*x165 + x157*x40  # bearing-run-out.s_x2
    D[21] = bar_rate_rate_run_out_y*x164 + bar_rate_run_out_y*x160 + bar_run_out_y*x163  # bearing-run-out.c_y2
    D[22] = bar_rate_rate_run_out_y*x166 + bar_rate_run_out_y*x165 + x158*x40  # bearing-run-out.s_y2
    D[23] = bar_rate_rate_run_out_z*x164 + bar_rate_run_out_z*x160 + bar_run_out_z*x163  # bearing-run-out.c_z2
    D[24] = bar_rate_rate_run_out_z*x166 + bar_rate_run_out_z*x165 + x159*x40  # bearing-run-out.s_z2
    D[25] = bar_i_vibration_rectification*time  # bias-drift.dK0_dt
    D[26] = bar_i_vibration_rectification*(-C__slip_radial*sin_j + C__slip_tangential*cos_j)  # bias-hysteresis.h_i
    D[27] = bar_i_vibration_rectification*(C__slip_radial*cos_j + C__slip_tangential*sin_j)  # bias-hysteresis.h_o
    D[28] = -C__slip_axial*bar_i_vibration_rectification  # bias-hysteresis.h_p
    D[29] = 0  # bias-hysteresis.w
    D[30] = bar_i_vibration_rectification  # bias-step.dK0
    D[31] = -bar_M_xx*(-x178 + x179 - 1) - bar_M_yy*(x167 - x168) - bar_M_zz*(x180 + x182) + bar_spin_axis_tilt_Gamma_xy*(x169 + x171) + bar_spin_axis_tilt_Gamma_xz*(x172 + x174) + bar_spin_axis_tilt_Gamma_yz*(x175 + x177)  # carrier-gradient.G_xx
    D[32] = -attitude_xy*x184 - attitude_yy*x186 - attitude_zy*x188 + bar_spin_axis_tilt_Gamma_xy*(x193 + x194 - 1) + bar_spin_axis_tilt_Gamma_xz*(x189 + x190) + bar_spin_axis_tilt_Gamma_yz*(x191 + x192)  # carrier-gradient.G_xy
    D[33] = -attitude_xz*x184 - attitude_yz*x186 - attitude_zz*x188 + bar_spin_axis_tilt_Gamma_xy*(x195 + x196) + bar_spin_axis_tilt_Gamma_xz*(x199 + x200 - 1) + bar_spin_axis_tilt_Gamma_yz*(x197 + x198)  # carrier-gradient.G_xz
    D[34] = -bar_M_xx*(-x178 + x201) - bar_M_yy*(-x168 + x205 - 1) - bar_M_zz*(x182 + x206) + bar_spin_axis_tilt_Gamma_xy*(x171 + x202) + bar_spin_axis_tilt_Gamma_xz*(x174 + x203) + bar_spin_axis_tilt_Gamma_yz*(x177 + x204)  # carrier-gradient.G_yy
    D[35] = -bar_M_zz*x209 + bar_spin_axis_tilt_Gamma_xy*(x210 + x211) + bar_spin_axis_tilt_Gamma_xz*(x212 + x213) + bar_spin_axis_tilt_Gamma_yz*(x214 + x215 - 1) - x183*x207 - x185*x208  # carrier-gradient.G_yz
    D[36] = -bar_M_xx*(fuel_mass*x179 + x219) - bar_M_yy*(fuel_mass*x167 + x220) - bar_M_zz*(fuel_mass*x180 + x221) + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x169 + x216) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x172 + x217) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x175 + x218)  # carrier-gradient.F_xx
    D[37] = -attitude_xy*x224 - attitude_yy*x227 - attitude_zy*x229 + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x193 + fuel_mass*x194) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x189 + fuel_mass*x190) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x191 + fuel_mass*x192)  # carrier-gradient.F_xy
    D[38] = -attitude_xz*x224 - attitude_yz*x227 - attitude_zz*x229 + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x195 + fuel_mass*x196) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x199 + fuel_mass*x200) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x197 + fuel_mass*x198)  # carrier-gradient.F_xz
    D[39] = -bar_M_xx*(fuel_mass*x201 + x219) - bar_M_yy*(fuel_mass*x205 + x220) - bar_M_zz*(fuel_mass*x206 + x221) + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x202 + x216) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x203 + x217) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x204 + x218)  # carrier-gradient.F_yy
    D[40] = bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x210 + fuel_mass*x211) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x212 + fuel_mass*x213) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x214 + fuel_mass*x215) - x207*x223 - x208*x226 - x209*x228  # carrier-gradient.F_yz
    D[41] = time*x230 + time*x231 + time*x232 + time*x233 + time*x234 + time*x235 + time*x236 + time*x237 + time*x238  # clock-drift.epsilon
    D[42] = f_f_o*x239  # cubic-cross.K_iio
    D[43] = f_f_p*x239  # cubic-cross.K_iip
    D[44] = x240*x241  # cubic-cross.K_ioo
    D[45] = f_f_o*f_f_p*x241  # cubic-cross.K_iop
    D[46] = x241*x242  # cubic-cross.K_ipp
    D[47] = bar_i_vibration_rectification*f_f_o**3.0  # cubic-cross.K_ooo
    D[48] = bar_i_vibration_rectification*f_f_p*x240  # cubic-cross.K_oop
    D[49] = bar_i_vibration_rectification*f_f_o*x242  # cubic-cross.K_opp
    D[50] = bar_i_vibration_rectification*f_f_p**3.0  # cubic-cross.K_ppp
    D[51] = bar_i_vibration_rectification*f_f_i**3.0  # cubic-input.K_iii
    D[52] = bar_f_f_x*(-d2_spin_angle*f_r_y + f_r_x*spin_xx) + bar_f_f_y*(d2_spin_angle*f_r_x + f_r_y*spin_yy) + bar_f_f_z*(f_r_x*spin_zx + f_r_y*spin_zy) + bar_q_f_x*(-d2_spin_angle*q_r_y + q_r_x*spin_xx) + bar_q_f_y*(d2_spin_angle*q_r_x + q_r_y*spin_yy) - bar_q_p_second_order_misalignment*(q_r_x*spin_zx + q_r_y*spin_zy)  # disc-spin.share
    D[53] = x243  # encoder-harmonic.c_1
    D[54] = bar_sin_delta_phi*sin_phi  # encoder-harmonic.s_1
    D[55] = bar_sin_delta_phi*x163  # encoder-harmonic.c_2
    D[56] = x243*x40  # encoder-harmonic.s_2
    D[57] = bar_sin_delta_phi*(-3.0*cos_phi*x162 + x244)  # encoder-harmonic.c_3
    D[58] = bar_sin_delta_phi*(3.0*sin_phi*x161 - x245)  # encoder-harmonic.s_3
    D[59] = bar_sin_delta_phi*(cos_phi**4.0 + sin_phi**4.0 - 6.0*x161*x162)  # encoder-harmonic.c_4
    D[60] = bar_sin_delta_phi*(x244*x48 - x245*x45)  # encoder-harmonic.s_4
    D[61] = -x222 - x246  # fuel-gradient.G_xx
    D[62] = bar_spin_axis_tilt_Gamma_xy*fuel_mass  # fuel-gradient.G_xy
    D[63] = bar_spin_axis_tilt_Gamma_xz*fuel_mass  # fuel-gradient.G_xz
    D[64] = -x225 - x246  # fuel-gradient.G_yy
    D[65] = bar_spin_axis_tilt_Gamma_yz*fuel_mass  # fuel-gradient.G_yz
    D[66] = time*x156  # gain-drift.dK1_dt
    D[67] = x156  # gain-step.dK1
    D[68] = -bar_M_xx - x247  # gradient-offset.G_xx
    D[69] = bar_spin_axis_tilt_Gamma_xy  # gradient-offset.G_xy
    D[70] = bar_spin_axis_tilt_Gamma_xz  # gradient-offset.G_xz
    D[71] = -bar_M_yy - x247  # gradient-offset.G_yy
    D[72] = bar_spin_axis_tilt_Gamma_yz  # gradient-offset.G_yz
    D[73] = -bar_time_offset_omega_x  # gyro-bias.b_x
    D[74] = -bar_time_offset_omega_y  # gyro-bias.b_y
    D[75] = -bar_time_offset_omega_z  # gyro-bias.b_z
    D[76] = x248  # gyro-delay.delta_w
    D[77] = x249  # gyro-delay.delta_d
    D[78] = -a_x*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_x  # gyro-g-sensitivity.d_xx
    D[79] = -a_y*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_y  # gyro-g-sensitivity.d_xy
    D[80] = -a_z*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_z  # gyro-g-sensitivity.d_xz
    D[81] = -a_x*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_x  # gyro-g-sensitivity.d_yx
    D[82] = -a_y*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_y  # gyro-g-sensitivity.d_yy
    D[83] = -a_z*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_z  # gyro-g-sensitivity.d_yz
    D[84] = -a_x*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_x  # gyro-g-sensitivity.d_zx
    D[85] = -a_y*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_y  # gyro-g-sensitivity.d_zy
    D[86] = -a_z*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_z  # gyro-g-sensitivity.d_zz
    D[87] = -x151  # gyro-misalignment.m_xy
    D[88] = -x149  # gyro-misalignment.m_xz
    D[89] = -x145  # gyro-misalignment.m_yx
    D[90] = -x142  # gyro-misalignment.m_yz
    D[91] = -x139  # gyro-misalignment.m_zx
    D[92] = -x137  # gyro-misalignment.m_zy
    D[93] = -bar_time_offset_omega_x*omega_x - bar_time_offset_omegadot_x*omegadot_x  # gyro-scale.s_x
    D[94] = -bar_time_offset_omega_y*omega_y - bar_time_offset_omegadot_y*omegadot_y  # gyro-scale.s_y
    D[95] = -bar_time_offset_omega_z*omega_z - bar_time_offset_omegadot_z*omegadot_z  # gyro-scale.s_z
    D[96] = -bar_time_offset_a_x  # imu-acceleration-bias.b_x
    D[97] = -bar_time_offset_a_y  # imu-acceleration-bias.b_y
    D[98] = -bar_time_offset_a_z  # imu-acceleration-bias.b_z
    D[99] = -x150  # imu-acceleration-misalignment.m_xy
    D[100] = x250  # imu-acceleration-misalignment.m_xz
    D[101] = -x144  # imu-acceleration-misalignment.m_yx
    D[102] = -x141  # imu-acceleration-misalignment.m_yz
    D[103] = -x138  # imu-acceleration-misalignment.m_zx
    D[104] = x251  # imu-acceleration-misalignment.m_zy
    D[105] = -a_x**2.0*bar_time_offset_a_x  # imu-acceleration-quadratic.q_x
    D[106] = -a_y**2.0*bar_time_offset_a_y  # imu-acceleration-quadratic.q_y
    D[107] = -x252  # imu-acceleration-scale.s_x
    D[108] = -x253  # imu-acceleration-scale.s_y
    D[109] = -a_z*bar_time_offset_a_z  # imu-acceleration-scale.s_z
    D[110] = -bar_time_offset_a_x*d2_a_x - bar_time_offset_a_y*d2_a_y - bar_time_offset_a_z*d2_a_z  # imu-filter.b_a
    D[111] = -bar_time_offset_omega_x*d_omegadot_x - bar_time_offset_omega_y*d_omegadot_y - bar_time_offset_omega_z*d_omegadot_z - bar_time_offset_omegadot_x*d2_omegadot_x - bar_time_offset_omegadot_y*d2_omegadot_y - bar_time_offset_omegadot_z*d2_omegadot_z  # imu-filter.b_w
    D[112] = bar_time_offset_a_x*x12 - bar_time_offset_a_y*x19 + bar_time_offset_a_z*(-x16 - x254)  # imu-lever-arm.l_x
    D[113] = bar_time_offset_a_x*(omegadot_z - x14) + bar_time_offset_a_y*x22 - bar_time_offset_a_z*x27  # imu-lever-arm.l_y
    D[114] = -bar_time_offset_a_x*x17 + bar_time_offset_a_y*(omegadot_x - x24) + bar_time_offset_a_z*x29  # imu-lever-arm.l_z
    D[115] = -bar_imu_turn_yz + bar_imu_turn_zy  # imu-misalignment.e_x
    D[116] = bar_imu_turn_xz - bar_imu_turn_zx  # imu-misalignment.e_y
    D[117] = -bar_imu_turn_xy + bar_imu_turn_yx  # imu-misalignment.e_z
    D[118] = x230  # imu-skew.delta_x
    D[119] = x231  # imu-skew.delta_y
    D[120] = bar_time_offset_a_x*x256  # imu-thermal.db_x_dT
    D[121] = bar_time_offset_a_y*x256  # imu-thermal.db_y_dT
    D[122] = -x252*x255  # imu-thermal.ds_x_dT
    D[123] = -x253*x255  # imu-thermal.ds_y_dT
    D[124] = bar_i_vibration_rectification*x257  # inner-temperature.b
    D[125] = x156*x257  # inner-temperature.s
    D[126] = C__heat_start*bar_i_vibration_rectification  # inner-temperature.b_0
    D[127] = C__heat_start*x156  # inner-temperature.s_0
    D[128] = 0  # inner-temperature.tau
    D[129] = -bar_i_vibration_rectification*rate_f_f_i  # lag.tau
    D[130] = bar_i_vibration_rectification*(B_x*f_tau_zx + B_y*f_tau_zy - B_z)  # magnetic-axial-bias.dK0_dBz
    D[131] = bar_i_vibration_rectification*(B_x*x114 + B_y*x115 + B_z*x116)  # magnetic-bias.dK0_dB
    D[132] = x258*(B_x*f_tau_xx + B_y*f_tau_xy)  # magnetic-scale.dK1_dB
    D[133] = bar_vartheta_y_thermal_misalignment*time  # misalignment-drift.dvartheta_y_dt
    D[134] = bar_vartheta_y_thermal_misalignment  # misalignment-step.dvartheta_y
    D[135] = b_f_xj*bar_vartheta_y_thermal_misalignment  # mount-compliance.c_yx
    D[136] = b_f_yj*bar_vartheta_y_thermal_misalignment  # mount-compliance.c_yy
    D[137] = b_f_zj*bar_vartheta_y_thermal_misalignment  # mount-compliance.c_yz
    D[138] = b_f_xj*bar_vartheta_z_mount_hysteresis  # mount-compliance.c_zx
    D[139] = b_f_yj*bar_vartheta_z_mount_hysteresis  # mount-compliance.c_zy
    D[140] = b_f_zj*bar_vartheta_z_mount_hysteresis  # mount-compliance.c_zz
    D[141] = bar_vartheta_y_thermal_misalignment*x259  # mount-hysteresis.e_yx
    D[142] = -C__play_axial*bar_vartheta_y_thermal_misalignment  # mount-hysteresis.e_yz
    D[143] = bar_vartheta_z_mount_hysteresis*x259  # mount-hysteresis.e_zx
    D[144] = 0  # mount-hysteresis.w
    D[145] = C__mount_a_x*bar_time_offset_a_x + C__mount_a_y*bar_time_offset_a_y + C__mount_a_z*bar_time_offset_a_z + C__mount_omega_x*bar_time_offset_omega_x + C__mount_omega_y*bar_time_offset_omega_y + C__mount_omega_z*bar_time_offset_omega_z + C__mount_omegadot_x*bar_time_offset_omegadot_x + C__mount_omegadot_y*bar_time_offset_omegadot_y + C__mount_omegadot_z*bar_time_offset_omegadot_z  # mount-resonance.share
    D[146] = 0  # mount-resonance.f_0
    D[147] = 0  # mount-resonance.Q
    D[148] = bar_f_f_x*x265 - bar_q_f_x*x261 + x260  # near-mass.T_xxx
    D[149] = bar_f_f_y*x265 + bar_f_f_z*f_disc_r_z*f_r_y - bar_q_f_y*x261 - f_r_x*x131 - q_r_x*x132  # near-mass.T_xxy
    D[150] = bar_f_f_z*x265 + bar_q_p_second_order_misalignment*x261 - x266  # near-mass.T_xxz
    D[151] = bar_f_f_x*x269 + bar_f_f_z*f_disc_r_z*f_r_x - bar_q_f_x*x267 - f_r_x*x127 - q_r_x*x128  # near-mass.T_xyy
    D[152] = bar_q_p_second_order_misalignment*q_r_x*q_r_y - f_r_x*x123 - f_r_y*x130 - x270  # near-mass.T_xyz
    D[153] = bar_f_f_y*x269 - bar_q_f_y*x267 + f_r_y*x122  # near-mass.T_yyy
    D[154] = bar_f_f_z*x269 + bar_q_p_second_order_misalignment*x267 - f_r_y*x126  # near-mass.T_yyz
    D[155] = bar_f_f_x*x273 - bar_f_f_z*x276 - bar_q_f_x*x271  # near-mass.T_xxxx
    D[156] = bar_f_f_x*x279 + bar_f_f_y*x273 - bar_q_f_y*x271 - x132*x261 + x277  # near-mass.T_xxxy
    D[157] = bar_f_f_x*x276 + bar_f_f_z*x273 + bar_q_p_second_order_misalignment*x271  # near-mass.T_xxxz
    D[158] = bar_f_f_x*x280 + bar_f_f_y*x279 + bar_f_f_z*(f_disc_r_z*x264 - 1/3*x274 + x281) - x128*x261 - x133*x267  # near-mass.T_xxyy
    D[159] = bar_f_f_y*x276 + bar_f_f_z*x279 - f_r_y*x266 + x124*x261  # near-mass.T_xxyz
    D[160] = bar_f_f_x*x283 + bar_f_f_y*x280 - bar_q_f_x*x282 - x129*x267 + x277  # near-mass.T_xyyy
    D[161] = bar_f_f_x*x284 + bar_f_f_z*x280 - f_r_y*x270 + x125*x267  # near-mass.T_xyyz
    D[162] = bar_f_f_y*x283 - bar_f_f_z*x284 - bar_q_f_y*x282  # near-mass.T_yyyy
    D[163] = bar_f_f_y*x284 + bar_f_f_z*x283 + bar_q_p_second_order_misalignment*x282  # near-mass.T_yyyz
    D[164] = x241*np.abs(f_f_i)  # odd-quadratic.K_oq
    D[165] = -G_out*x258  # output-curve.c_2
    D[166] = -G_out**2.0*x258  # output-curve.c_3
    D[167] = x285  # output-filter.b
    D[168] = x258  # output-gain-step.g
    D[169] = bar_i_vibration_rectification*(-beta_x*(d2_spin_angle + omegadot_z) + f_tau_yx*(omegadot_x + x53) + f_tau_yy*(-x254 - x52))  # pendulum-angular.K_pa
    D[170] = bar_i_vibration_rectification*(pressure - 101325)  # pressure-bias.dK0_dp
    D[171] = bar_K2_thermal_second_order*time  # second-order-drift.dK2_dt
    D[172] = x285  # second-order-loop.b
    D[173] = bar_q_i_second_order_misalignment*(f_f_i - q_f_xj) + bar_q_o_second_order_misalignment*(f_f_o - q_f_yj) + bar_q_p_second_order_misalignment*(f_f_p + q_f_z)  # second-order-misalignment.kappa
    D[174] = bar_K2_thermal_second_order  # second-order-step.dK2
    D[175] = -bar_M_xx*x6 - x286  # self-gradient.G_xx_roll
    D[176] = bar_spin_axis_tilt_Gamma_xy*x6  # self-gradient.G_xy_roll
    D[177] = bar_spin_axis_tilt_Gamma_xz*x6  # self-gradient.G_xz_roll
    D[178] = -bar_M_yy*x6 - x286  # self-gradient.G_yy_roll
    D[179] = bar_spin_axis_tilt_Gamma_yz*x6  # self-gradient.G_yz_roll
    D[180] = -bar_M_xx*x5 - x287  # self-gradient.G_xx_pitch
    D[181] = bar_spin_axis_tilt_Gamma_xy*x5  # self-gradient.G_xy_pitch
    D[182] = bar_spin_axis_tilt_Gamma_xz*x5  # self-gradient.G_xz_pitch
    D[183] = -bar_M_yy*x5 - x287  # self-gradient.G_yy_pitch
    D[184] = bar_spin_axis_tilt_Gamma_yz*x5  # self-gradient.G_yz_pitch
    D[185] = -bar_M_xx*x289 - bar_M_yy*x288 + 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw  # self-gradient-yaw.G_d
    D[186] = bar_spin_axis_tilt_Gamma_xy*x289 + x183*x290 - x185*x290  # self-gradient-yaw.G_xy
    D[187] = bar_spin_axis_tilt_Gamma_xz*x291 + bar_spin_axis_tilt_Gamma_yz*sin_yaw  # self-gradient-yaw.G_xz
    D[188] = -bar_spin_axis_tilt_Gamma_xz*sin_yaw + bar_spin_axis_tilt_Gamma_yz*x291  # self-gradient-yaw.G_yz
    D[189] = -Gamma_xy*bar_spin_axis_tilt_Gamma_xz + Gamma_xz*bar_spin_axis_tilt_Gamma_xy - bar_M_yy*x293 + bar_M_zz*x293 + bar_spin_axis_tilt_Gamma_yz*(-Gamma_yy - x292) - x135 - x136 + x143 + x251  # spin-axis-tilt.alpha_x
    D[190] = Gamma_xy*bar_spin_axis_tilt_Gamma_yz - Gamma_yz*bar_spin_axis_tilt_Gamma_xy + bar_M_xx*x294 - bar_M_zz*x294 + bar_spin_axis_tilt_Gamma_xz*(Gamma_xx + x292) + x140 - x147 - x148 + x250  # spin-axis-tilt.alpha_y
    D[191] = bar_wobble_xz*sin_phi - bar_wobble_yz*cos_phi - bar_wobble_zx*sin_phi + bar_wobble_zy*cos_phi  # spin-axis-wobble.w_x
    D[192] = bar_wobble_xz*cos_phi + bar_wobble_yz*sin_phi - bar_wobble_zx*cos_phi - bar_wobble_zy*sin_phi  # spin-axis-wobble.w_y
    D[193] = bar_sin_delta_phi  # spin-phase-offset.phi_0
    D[194] = bar_sin_delta_phi  # spin-rate-jitter.sigma_phi
    D[195] = bar_sin_delta_phi  # spin-rate-jitter.sigma_walk
    D[196] = 2.0*bar_sin_delta_phi*time*x41  # spin-rate-offset.epsilon
    D[197] = -bar_sin_delta_phi*omegadot_z  # spin-servo.c
    D[198] = bar_i_vibration_rectification*x255  # thermal-bias.dK0_dT
    D[199] = bar_i_vibration_rectification*d_temperature  # thermal-lag.dK0_dTdot
    D[200] = d_temperature*x156  # thermal-lag.dK1_dTdot
    D[201] = bar_vartheta_y_thermal_misalignment*x255  # thermal-misalignment.dvartheta_y_dT
    D[202] = x156*x255  # thermal-scale.dK1_dT
    D[203] = bar_K2_thermal_second_order*x255  # thermal-second-order.dK2_dT
    D[204] = x230 + x231 + x232 + x248 + x249  # time-offset.delta_t
    D[205] = bar_i_vibration_rectification*(x295*x297 + x295*x299 + x295*x301 + x295*x302 + x295*x303 + x295*x304)  # vibration-level.L_xx
    D[206] = bar_i_vibration_rectification*(x295*x305 + x295*x307 + x295*x308 + x295*x310 + x295*x311 + x295*x313 + x295*x315 + x295*x317 + x295*x319)  # vibration-level.L_xy
    D[207] = bar_i_vibration_rectification*(x295*x320 + x295*x321 + x295*x322 + x295*x323 + x295*x324 + x295*x325 + x295*x326 + x295*x327 + x295*x328)  # vibration-level.L_xz
    D[208] = bar_i_vibration_rectification*(x295*x330 + x295*x332 + x295*x334 + x295*x335 + x295*x336 + x295*x337)  # vibration-level.L_yy
    D[209] = bar_i_vibration_rectification*(x295*x338 + x295*x340 + x295*x341 + x295*x343 + x295*x344 + x295*x346 + x295*x347 + x295*x348 + x295*x349)  # vibration-level.L_yz
    D[210] = bar_i_vibration_rectification*(x295*x350 + x295*x351 + x295*x352 + x295*x353 + x295*x354 + x295*x355)  # vibration-level.L_zz
    D[211] = bar_i_vibration_rectification*(x297 + x299 + x301 + x302 + x303 + x304)  # vibration-rectification.P_xx
    D[212] = bar_i_vibration_rectification*(x305 + x307 + x308 + x310 + x311 + x313 + x315 + x317 + x319)  # vibration-rectification.P_xy
    D[213] = bar_i_vibration_rectification*(x320 + x321 + x322 + x323 + x324 + x325 + x326 + x327 + x328)  # vibration-rectification.P_xz
    D[214] = bar_i_vibration_rectification*(x330 + x332 + x334 + x335 + x336 + x337)  # vibration-rectification.P_yy
    D[215] = bar_i_vibration_rectification*(x338 + x340 + x341 + x343 + x344 + x346 + x347 + x348 + x349)  # vibration-rectification.P_yz
    D[216] = bar_i_vibration_rectification*(x350 + x351 + x352 + x353 + x354 + x355)  # vibration-rectification.P_zz
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
