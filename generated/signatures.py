"""Signatures: what each candidate effect would add to V_j.

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: accelerometer-resonance, adc-nonlinearity, angular-jitter, anisoinertia, arm-length, arm-sag, arm-stretch, balancing-loop, bearing-run-out, bias-drift, bias-hysteresis, bias-step, carrier-gradient, clock-drift, cubic-cross, cubic-input, disc-spin, encoder-harmonic, fuel-gradient, gain-drift, gain-step, gradient-offset, gyro-bias, gyro-delay, gyro-g-sensitivity, gyro-misalignment, gyro-scale, imu-acceleration-bias, imu-acceleration-misalignment, imu-acceleration-quadratic, imu-acceleration-scale, imu-filter, imu-lever-arm, imu-misalignment, imu-skew, imu-thermal, inner-temperature, lag, magnetic-axial-bias, magnetic-bias, magnetic-scale, misalignment-drift, misalignment-step, mount-compliance, mount-hysteresis, mount-resonance, near-mass, odd-quadratic, output-curve, output-filter, output-gain-step, pendulum-angular, pressure-bias, second-order-drift, second-order-loop, second-order-misalignment, self-gradient, self-gradient-yaw, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, spin-rate-offset, spin-servo, thermal-bias, thermal-lag, thermal-misalignment, thermal-scale, thermal-second-order, time-offset, vibration-level, vibration-rectification.
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
    "curvature_axial",
    "curvature_radial",
    "curvature_tangential",
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
    "rate_axial",
    "rate_radial",
    "rate_tangential",
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
    ("accelerometer-resonance.u", False),
    ("accelerometer-resonance.v", False),
    ("accelerometer-resonance.f_0", True),
    ("accelerometer-resonance.Q", True),
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
    C__curvature_axial = inputs[18]
    C__curvature_radial = inputs[19]
    C__curvature_tangential = inputs[20]
    C__heat_rr = inputs[21]
    C__heat_rt = inputs[22]
    C__heat_start = inputs[23]
    C__heat_tt = inputs[24]
    C__mount_a_x = inputs[25]
    C__mount_a_y = inputs[26]
    C__mount_a_z = inputs[27]
    C__mount_omega_x = inputs[28]
    C__mount_omega_y = inputs[29]
    C__mount_omega_z = inputs[30]
    C__mount_omegadot_x = inputs[31]
    C__mount_omegadot_y = inputs[32]
    C__mount_omegadot_z = inputs[33]
    C__play_axial = inputs[34]
    C__play_radial = inputs[35]
    C__play_tangential = inputs[36]
    C__rate_axial = inputs[37]
    C__rate_radial = inputs[38]
    C__rate_tangential = inputs[39]
    C__slip_axial = inputs[40]
    C__slip_radial = inputs[41]
    C__slip_tangential = inputs[42]
    G_out = inputs[43]
    angular_vibration_rms = inputs[44]
    balance_current = inputs[45]
    d2_a_x = inputs[46]
    d2_a_y = inputs[47]
    d2_a_z = inputs[48]
    d2_omegadot_x = inputs[49]
    d2_omegadot_y = inputs[50]
    d2_omegadot_z = inputs[51]
    d2_spin_angle = inputs[52]
    d_a_x = inputs[53]
    d_a_y = inputs[54]
    d_a_z = inputs[55]
    d_omegadot_x = inputs[56]
    d_omegadot_y = inputs[57]
    d_omegadot_z = inputs[58]
    d_spin_angle = inputs[59]
    d_temperature = inputs[60]
    fuel_mass = inputs[61]
    pitch = inputs[62]
    pressure = inputs[63]
    roll = inputs[64]
    temperature = inputs[65]
    vibration_rms = inputs[66]
    yaw = inputs[67]
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
    x152 = C__rate_tangential*cos_j
    x153 = C__rate_radial*sin_j
    x154 = C__rate_radial*cos_j + C__rate_tangential*sin_j
    x155 = C__curvature_tangential*cos_j
    x156 = C__curvature_radial*sin_j
    x157 = C__curvature_radial*cos_j + C__curvature_tangential*sin_j
    x158 = angular_vibration_rms**2.0
    x159 = bar_M_yy*x158
    x160 = bar_M_zz*x158
    x161 = bar_M_xx*x158
    x162 = K1*bar_K1_thermal_scale
    x163 = bar_run_out_x*cos_phi
    x164 = bar_run_out_y*cos_phi
    x165 = bar_run_out_z*cos_phi
    x166 = rate_cos_phi_true*x43 - rate_sin_phi_true*x40
    x167 = cos_phi**2.0
    x168 = sin_phi**2.0
    x169 = x167 - x168
    x170 = 2.0*rate_cos_phi_true**2.0 + rate_rate_cos_phi_true*x43 - rate_rate_sin_phi_true*x40 - 2.0*rate_sin_phi_true**2.0
    x171 = rate_cos_phi_true*x40 + rate_sin_phi_true*x43
    x172 = 4.0*rate_cos_phi_true*rate_sin_phi_true + rate_rate_cos_phi_true*x40 + rate_rate_sin_phi_true*x43
    x173 = attitude_yx**2.0
    x174 = attitude_yz**2.0
    x175 = attitude_xx*attitude_yx
    x176 = attitude_xz*attitude_yz
    x177 = -x176
    x178 = attitude_xx*attitude_zx
    x179 = attitude_xz*attitude_zz
    x180 = -x179
    x181 = attitude_yx*attitude_zx
    x182 = attitude_yz*attitude_zz
    x183 = -x182
    x184 = attitude_xz**2.0
    x185 = attitude_xx**2.0
    x186 = attitude_zx**2.0
    x187 = attitude_zz**2.0
    x188 = 1 - x187
    x189 = 2.0*bar_M_xx
    x190 = attitude_xx*x189
    x191 = 2.0*bar_M_yy
    x192 = attitude_yx*x191
    x193 = 2.0*attitude_zx
    x194 = bar_M_zz*x193
    x195 = attitude_xx*attitude_zy
    x196 = attitude_xy*attitude_zx
    x197 = attitude_yx*attitude_zy
    x198 = attitude_yy*attitude_zx
    x199 = attitude_xx*attitude_yy
    x200 = attitude_xy*attitude_yx
    x201 = attitude_xx*attitude_yz
    x202 = attitude_xz*attitude_yx
    x203 = attitude_yx*attitude_zz
    x204 = attitude_yz*attitude_zx
    x205 = attitude_xx*attitude_zz
    x206 = attitude_xz*attitude_zx
    x207 = attitude_xy**2.0
    x208 = attitude_xy*attitude_yy
    x209 = attitude_xy*attitude_zy
    x210 = attitude_yy*attitude_zy
    x211 = attitude_yy**2.0
    x212 = attitude_zy**2.0
    x213 = attitude_xy*attitude_xz
    x214 = attitude_yy*attitude_yz
    x215 = 2.0*attitude_zy*attitude_zz
    x216 = attitude_xy*attitude_yz
    x217 = attitude_xz*attitude_yy
    x218 = attitude_xy*attitude_zz
    x219 = attitude_xz*attitude_zy
    x220 = attitude_yy*attitude_zz
    x221 = attitude_yz*attitude_zy
    x222 = -fuel_mass*x176
    x223 = -fuel_mass*x179
    x224 = -fuel_mass*x182
    x225 = -fuel_mass*x184
    x226 = -fuel_mass*x174
    x227 = -fuel_mass*x187
    x228 = bar_M_xx*fuel_mass
    x229 = 2.0*x228
    x230 = attitude_xx*x229
    x231 = bar_M_yy*fuel_mass
    x232 = 2.0*x231
    x233 = attitude_yx*x232
    x234 = bar_M_zz*fuel_mass
    x235 = x193*x234
    x236 = bar_time_offset_a_x*d_a_x
    x237 = bar_time_offset_a_y*d_a_y
    x238 = bar_time_offset_a_z*d_a_z
    x239 = bar_time_offset_omega_x*omegadot_x
    x240 = bar_time_offset_omega_y*omegadot_y
    x241 = bar_time_offset_omega_z*omegadot_z
    x242 = bar_time_offset_omegadot_x*d_omegadot_x
    x243 = bar_time_offset_omegadot_y*d_omegadot_y
    x244 = bar_time_offset_omegadot_z*d_omegadot_z
    x245 = bar_i_vibration_rectification*f_f_i**2.0
    x246 = f_f_o**2.0
    x247 = bar_i_vibration_rectification*f_f_i
    x248 = f_f_p**2.0
    x249 = bar_sin_delta_phi*cos_phi
    x250 = cos_phi**3.0
    x251 = sin_phi**3.0
    x252 = -bar_M_zz*fuel_mass
    x253 = -bar_M_zz
    x254 = x239 + x240 + x241
    x255 = x242 + x243 + x244
    x256 = -x146
    x257 = -x134
    x258 = a_x*bar_time_offset_a_x
    x259 = a_y*bar_time_offset_a_y
    x260 = -omegadot_y
    x261 = temperature - 293.15
    x262 = -x261
    x263 = C__heat_rr*sin_j**2.0 - 2.0*C__heat_rt*cos_j*sin_j + C__heat_tt*cos_j**2.0
    x264 = bar_i_vibration_rectification*i_sensed
    x265 = -C__play_radial*sin_j + C__play_tangential*cos_j
    x266 = f_r_x*x122
    x267 = 0.5*q_r_x**2.0
    x268 = 0.5*f_disc_r_z**2.0
    x269 = f_r_x**2.0
    x270 = 0.5*x269
    x271 = x268 - x270
    x272 = f_r_x*x130
    x273 = 0.5*q_r_y**2.0
    x274 = 0.5*f_r_y**2.0
    x275 = x268 - x274
    x276 = f_r_x*x126
    x277 = (1/6)*q_r_x**3.0
    x278 = f_r_x*x268
    x279 = -1/6*f_r_x**3.0 + x278
    x280 = f_disc_r_z**3.0
    x281 = (1/6)*x280
    x282 = -0.5*f_disc_r_z*x269 + x281
    x283 = f_r_y*x266
    x284 = f_r_y*x268
    x285 = -f_r_y*x270 + x284
    x286 = -f_r_x*x274 + x278
    x287 = f_disc_r_z*x274
    x288 = (1/6)*q_r_y**3.0
    x289 = -1/6*f_r_y**3.0 + x284
    x290 = x281 - x287
    x291 = bar_i_vibration_rectification*rate_rate_i_sensed
    x292 = -bar_M_zz*x6
    x293 = -bar_M_zz*x5
    x294 = -cos_yaw**2.0 + sin_yaw**2.0 + 1
    x295 = -x294
    x296 = cos_yaw*sin_yaw
    x297 = cos_yaw - 1
    x298 = -Gamma_zz
    x299 = 2.0*Gamma_yz
    x300 = 2.0*Gamma_xz
    x301 = vibration_rms**2.0
    x302 = K4*vibration_axis_ix
    x303 = vibration_axis_px*x302
    x304 = K6*vibration_axis_ix
    x305 = vibration_axis_ox*x304
    x306 = K8*vibration_axis_ox
    x307 = vibration_axis_px*x306
    x308 = K2*vibration_axis_ix**2.0
    x309 = K5*vibration_axis_ox**2.0
    x310 = K7*vibration_axis_px**2.0
    x311 = vibration_axis_py*x302
    x312 = K4*vibration_axis_px
    x313 = vibration_axis_iy*x312
    x314 = vibration_axis_oy*x304
    x315 = K6*vibration_axis_ox
    x316 = vibration_axis_iy*x315
    x317 = vibration_axis_py*x306
    x318 = K8*vibration_axis_px
    x319 = vibration_axis_oy*x318
    x320 = vibration_axis_ix*x108
    x321 = vibration_axis_iy*x320
    x322 = vibration_axis_ox*x109
    x323 = vibration_axis_oy*x322
    x324 = vibration_axis_px*x110
    x325 = vibration_axis_py*x324
    x326 = vibration_axis_pz*x302
    x327 = vibration_axis_iz*x312
    x328 = vibration_axis_oz*x304
    x329 = vibration_axis_iz*x315
    x330 = vibration_axis_pz*x306
    x331 = vibration_axis_oz*x318
    x332 = vibration_axis_iz*x320
    x333 = vibration_axis_oz*x322
    x334 = vibration_axis_pz*x324
    x335 = K4*vibration_axis_iy
    x336 = vibration_axis_py*x335
    x337 = K6*vibration_axis_iy
    x338 = vibration_axis_oy*x337
    x339 = K8*vibration_axis_oy
    x340 = vibration_axis_py*x339
    x341 = K2*vibration_axis_iy**2.0
    x342 = K5*vibration_axis_oy**2.0
    x343 = K7*vibration_axis_py**2.0
    x344 = vibration_axis_pz*x335
    x345 = K4*vibration_axis_iz
    x346 = vibration_axis_py*x345
    x347 = vibration_axis_oz*x337
    x348 = K6*vibration_axis_iz
    x349 = vibration_axis_oy*x348
    x350 = vibration_axis_pz*x339
    x351 = K8*vibration_axis_oz
    x352 = vibration_axis_py*x351
    x353 = vibration_axis_iy*vibration_axis_iz*x108
    x354 = vibration_axis_oy*vibration_axis_oz*x109
    x355 = vibration_axis_py*vibration_axis_pz*x110
    x356 = vibration_axis_pz*x345
    x357 = vibration_axis_oz*x348
    x358 = vibration_axis_pz*x351
    x359 = K2*vibration_axis_iz**2.0
    x360 = K5*vibration_axis_oz**2.0
    x361 = K7*vibration_axis_pz**2.0

    D = np.empty((len(ROWS), len(time)))
    D[0] = bar_i_vibration_rectification*(-C__rate_axial*vartheta_y + beta_z*x154 - vartheta_z*(beta_z*(x152 - x153) + x154) - x152 + x153)  # accelerometer-resonance.u
    D[1] = bar_i_vibration_rectification*(-C__curvature_axial*vartheta_y + beta_z*x157 - vartheta_z*(beta_z*(x155 - x156) + x157) - x155 + x156)  # accelerometer-resonance.v
    D[2] = 0  # accelerometer-resonance.f_0
    D[3] = 0  # accelerometer-resonance.Q
    D[4] = bar_i_vibration_rectification*np.sign(i_sensed)  # adc-nonlinearity.h
    D[5] = -x159 - x160  # angular-jitter.W_xx
    D[6] = -bar_spin_axis_tilt_Gamma_xy*x158  # angular-jitter.W_xy
    D[7] = -bar_spin_axis_tilt_Gamma_xz*x158  # angular-jitter.W_xz
    D[8] = -x160 - x161  # angular-jitter.W_yy
    D[9] = -bar_spin_axis_tilt_Gamma_yz*x158  # angular-jitter.W_yz
    D[10] = -x159 - x161  # angular-jitter.W_zz
    D[11] = bar_i_vibration_rectification*(f_tau_xx*omega_x + f_tau_xy*omega_y)*(f_tau_zx*omega_x + f_tau_zy*omega_y - x117)  # anisoinertia.K_ip
    D[12] = bar_dR_arm_stretch  # arm-length.delta_R
    D[13] = b_f_zj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_zj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_zj  # arm-sag.c_z
    D[14] = b_f_yj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_yj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_yj  # arm-stretch.c_r
    D[15] = balance_current*x162  # balancing-loop.dK1_di
    D[16] = bar_rate_rate_run_out_x*rate_rate_cos_phi_true + bar_rate_run_out_x*rate_cos_phi_true + x163  # bearing-run-out.c_x1
    D[17] = bar_rate_rate_run_out_x*rate_rate_sin_phi_true + bar_rate_run_out_x*rate_sin_phi_true + bar_run_out_x*sin_phi  # bearing-run-out.s_x1
    D[18] = bar_rate_rate_run_out_y*rate_rate_cos_phi_true + bar_rate_run_out_y*rate_cos_phi_true + x164  # bearing-run-out.c_y1
    D[19] = bar_rate_rate_run_out_y*rate_rate_sin_phi_true + bar_rate_run_out_y*rate_sin_phi_true + bar_run_out_y*sin_phi  # bearing-run-out.s_y1
    D[20] = bar_rate_rate_run_out_z*rate_rate_cos_phi_true + bar_rate_run_out_z*rate_cos_phi_true + x165  # bearing-run-out.c_z1
    D[21] = bar_rate_rate_run_out_z*rate_rate_sin_phi_true + bar_rate_run_out_z*rate_sin_phi_true + bar_run_out_z*sin_phi  # bearing-run-out.s_z1
    D[22] = bar_rate_rate_run_out_x*x170 + bar_rate_run_out_x*x166 + bar_run_out_x*x169  # bearing-run-out.c_x2
    D[23] = bar_rate_rate_run_out_x*x172 + bar_rate_run_out_x*x171 + x163*x40  # bearing-run-out.s_x2
    D[24] = bar_rate_rate_run_out_y*x170 + bar_rate_run_out_y*x166 + bar_run_out_y*x169  # bearing-run-out.c_y2
    D[25] = bar_rate_rate_run_out_y*x172 + bar_rate_run_out_y*x171 + x164*x40  # bearing-run-out.s_y2
    D[26] = bar_rate_rate_run_out_z*x170 + bar_rate_run_out_z*x166 + bar_run_out_z*x169  # bearing-run-out.c_z2
    D[27] = bar_rate_rate_run_out_z*x172 + bar_rate_run_out_z*x171 + x165*x40  # bearing-run-out.s_z2
    D[28] = bar_i_vibration_rectification*time  # bias-drift.dK0_dt
    D[29] = bar_i_vibration_rectification*(-C__slip_radial*sin_j + C__slip_tangential*cos_j)  # bias-hysteresis.h_i
    D[30] = bar_i_vibration_rectification*(C__slip_radial*cos_j + C__slip_tangential*sin_j)  # bias-hysteresis.h_o
    D[31] = -C__slip_axial*bar_i_vibration_rectification  # bias-hysteresis.h_p
    D[32] = 0  # bias-hysteresis.w
    D[33] = bar_i_vibration_rectification  # bias-step.dK0
    D[34] = -bar_M_xx*(-x184 + x185 - 1) - bar_M_yy*(x173 - x174) - bar_M_zz*(x186 + x188) + bar_spin_axis_tilt_Gamma_xy*(x175 + x177) + bar_spin_axis_tilt_Gamma_xz*(x178 + x180) + bar_spin_axis_tilt_Gamma_yz*(x181 + x183)  # carrier-gradient.G_xx
    D[35] = -attitude_xy*x190 - attitude_yy*x192 - attitude_zy*x194 + bar_spin_axis_tilt_Gamma_xy*(x199 + x200 - 1) + bar_spin_axis_tilt_Gamma_xz*(x195 + x196) + bar_spin_axis_tilt_Gamma_yz*(x197 + x198)  # carrier-gradient.G_xy
    D[36] = -attitude_xz*x190 - attitude_yz*x192 - attitude_zz*x194 + bar_spin_axis_tilt_Gamma_xy*(x201 + x202) + bar_spin_axis_tilt_Gamma_xz*(x205 + x206 - 1) + bar_spin_axis_tilt_Gamma_yz*(x203 + x204)  # carrier-gradient.G_xz
    D[37] = -bar_M_xx*(-x184 + x207) - bar_M_yy*(-x174 + x211 - 1) - bar_M_zz*(x188 + x212) + bar_spin_axis_tilt_Gamma_xy*(x177 + x208) + bar_spin_axis_tilt_Gamma_xz*(x180 + x209) + bar_spin_axis_tilt_Gamma_yz*(x183 + x210)  # carrier-gradient.G_yy
    D[38] = -bar_M_zz*x215 + bar_spin_axis_tilt_Gamma_xy*(x216 + x217) + bar_spin_axis_tilt_Gamma_xz*(x218 + x219) + bar_spin_axis_tilt_Gamma_yz*(x220 + x221 - 1) - x189*x213 - x191*x214  # carrier-gradient.G_yz
    D[39] = -bar_M_xx*(fuel_mass*x185 + x225) - bar_M_yy*(fuel_mass*x173 + x226) - bar_M_zz*(fuel_mass*x186 + x227) + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x175 + x222) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x178 + x223) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x181 + x224)  # carrier-gradient.F_xx
    D[40] = -attitude_xy*x230 - attitude_yy*x233 - attitude_zy*x235 + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x199 + fuel_mass*x200) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x195 + fuel_mass*x196) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x197 + fuel_mass*x198)  # carrier-gradient.F_xy
    D[41] = -attitude_xz*x230 - attitude_yz*x233 - attitude_zz*x235 + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x201 + fuel_mass*x202) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x205 + fuel_mass*x206) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x203 + fuel_mass*x204)  # carrier-gradient.F_xz
    D[42] = -bar_M_xx*(fuel_mass*x207 + x225) - bar_M_yy*(fuel_mass*x211 + x226) - bar_M_zz*(fuel_mass*x212 + x227) + bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x208 + x222) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x209 + x223) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x210 + x224)  # carrier-gradient.F_yy
    D[43] = bar_spin_axis_tilt_Gamma_xy*(fuel_mass*x216 + fuel_mass*x217) + bar_spin_axis_tilt_Gamma_xz*(fuel_mass*x218 + fuel_mass*x219) + bar_spin_axis_tilt_Gamma_yz*(fuel_mass*x220 + fuel_mass*x221) - x213*x229 - x214*x232 - x215*x234  # carrier-gradient.F_yz
    D[44] = time*x236 + time*x237 + time*x238 + time*x239 + time*x240 + time*x241 + time*x242 + time*x243 + time*x244  # clock-drift.epsilon
    D[45] = f_f_o*x245  # cubic-cross.K_iio
    D[46] = f_f_p*x245  # cubic-cross.K_iip
    D[47] = x246*x247  # cubic-cross.K_ioo
    D[48] = f_f_o*f_f_p*x247  # cubic-cross.K_iop
    D[49] = x247*x248  # cubic-cross.K_ipp
    D[50] = bar_i_vibration_rectification*f_f_o**3.0  # cubic-cross.K_ooo
    D[51] = bar_i_vibration_rectification*f_f_p*x246  # cubic-cross.K_oop
    D[52] = bar_i_vibration_rectification*f_f_o*x248  # cubic-cross.K_opp
    D[53] = bar_i_vibration_rectification*f_f_p**3.0  # cubic-cross.K_ppp
    D[54] = bar_i_vibration_rectification*f_f_i**3.0  # cubic-input.K_iii
    D[55] = bar_f_f_x*(-d2_spin_angle*f_r_y + f_r_x*spin_xx) + bar_f_f_y*(d2_spin_angle*f_r_x + f_r_y*spin_yy) + bar_f_f_z*(f_r_x*spin_zx + f_r_y*spin_zy) + bar_q_f_x*(-d2_spin_angle*q_r_y + q_r_x*spin_xx) + bar_q_f_y*(d2_spin_angle*q_r_x + q_r_y*spin_yy) - bar_q_p_second_order_misalignment*(q_r_x*spin_zx + q_r_y*spin_zy)  # disc-spin.share
    D[56] = x249  # encoder-harmonic.c_1
    D[57] = bar_sin_delta_phi*sin_phi  # encoder-harmonic.s_1
    D[58] = bar_sin_delta_phi*x169  # encoder-harmonic.c_2
    D[59] = x249*x40  # encoder-harmonic.s_2
    D[60] = bar_sin_delta_phi*(-3.0*cos_phi*x168 + x250)  # encoder-harmonic.c_3
    D[61] = bar_sin_delta_phi*(3.0*sin_phi*x167 - x251)  # encoder-harmonic.s_3
    D[62] = bar_sin_delta_phi*(cos_phi**4.0 + sin_phi**4.0 - 6.0*x167*x168)  # encoder-harmonic.c_4
    D[63] = bar_sin_delta_phi*(x250*x48 - x251*x45)  # encoder-harmonic.s_4
    D[64] = -x228 - x252  # fuel-gradient.G_xx
    D[65] = bar_spin_axis_tilt_Gamma_xy*fuel_mass  # fuel-gradient.G_xy
    D[66] = bar_spin_axis_tilt_Gamma_xz*fuel_mass  # fuel-gradient.G_xz
    D[67] = -x231 - x252  # fuel-gradient.G_yy
    D[68] = bar_spin_axis_tilt_Gamma_yz*fuel_mass  # fuel-gradient.G_yz
    D[69] = time*x162  # gain-drift.dK1_dt
    D[70] = x162  # gain-step.dK1
    D[71] = -bar_M_xx - x253  # gradient-offset.G_xx
    D[72] = bar_spin_axis_tilt_Gamma_xy  # gradient-offset.G_xy
    D[73] = bar_spin_axis_tilt_Gamma_xz  # gradient-offset.G_xz
    D[74] = -bar_M_yy - x253  # gradient-offset.G_yy
    D[75] = bar_spin_axis_tilt_Gamma_yz  # gradient-offset.G_yz
    D[76] = -bar_time_offset_omega_x  # gyro-bias.b_x
    D[77] = -bar_time_offset_omega_y  # gyro-bias.b_y
    D[78] = -bar_time_offset_omega_z  # gyro-bias.b_z
    D[79] = x254  # gyro-delay.delta_w
    D[80] = x255  # gyro-delay.delta_d
    D[81] = -a_x*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_x  # gyro-g-sensitivity.d_xx
    D[82] = -a_y*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_y  # gyro-g-sensitivity.d_xy
    D[83] = -a_z*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_z  # gyro-g-sensitivity.d_xz
    D[84] = -a_x*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_x  # gyro-g-sensitivity.d_yx
    D[85] = -a_y*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_y  # gyro-g-sensitivity.d_yy
    D[86] = -a_z*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_z  # gyro-g-sensitivity.d_yz
    D[87] = -a_x*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_x  # gyro-g-sensitivity.d_zx
    D[88] = -a_y*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_y  # gyro-g-sensitivity.d_zy
    D[89] = -a_z*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_z  # gyro-g-sensitivity.d_zz
    D[90] = -x151  # gyro-misalignment.m_xy
    D[91] = -x149  # gyro-misalignment.m_xz
    D[92] = -x145  # gyro-misalignment.m_yx
    D[93] = -x142  # gyro-misalignment.m_yz
    D[94] = -x139  # gyro-misalignment.m_zx
    D[95] = -x137  # gyro-misalignment.m_zy
    D[96] = -bar_time_offset_omega_x*omega_x - bar_time_offset_omegadot_x*omegadot_x  # gyro-scale.s_x
    D[97] = -bar_time_offset_omega_y*omega_y - bar_time_offset_omegadot_y*omegadot_y  # gyro-scale.s_y
    D[98] = -bar_time_offset_omega_z*omega_z - bar_time_offset_omegadot_z*omegadot_z  # gyro-scale.s_z
    D[99] = -bar_time_offset_a_x  # imu-acceleration-bias.b_x
    D[100] = -bar_time_offset_a_y  # imu-acceleration-bias.b_y
    D[101] = -bar_time_offset_a_z  # imu-acceleration-bias.b_z
    D[102] = -x150  # imu-acceleration-misalignment.m_xy
    D[103] = x256  # imu-acceleration-misalignment.m_xz
    D[104] = -x144  # imu-acceleration-misalignment.m_yx
    D[105] = -x141  # imu-acceleration-misalignment.m_yz
    D[106] = -x138  # imu-acceleration-misalignment.m_zx
    D[107] = x257  # imu-acceleration-misalignment.m_zy
    D[108] = -a_x**2.0*bar_time_offset_a_x  # imu-acceleration-quadratic.q_x
    D[109] = -a_y**2.0*bar_time_offset_a_y  # imu-acceleration-quadratic.q_y
    D[110] = -x258  # imu-acceleration-scale.s_x
    D[111] = -x259  # imu-acceleration-scale.s_y
    D[112] = -a_z*bar_time_offset_a_z  # imu-acceleration-scale.s_z
    D[113] = -bar_time_offset_a_x*d2_a_x - bar_time_offset_a_y*d2_a_y - bar_time_offset_a_z*d2_a_z  # imu-filter.b_a
    D[114] = -bar_time_offset_omega_x*d_omegadot_x - bar_time_offset_omega_y*d_omegadot_y - bar_time_offset_omega_z*d_omegadot_z - bar_time_offset_omegadot_x*d2_omegadot_x - bar_time_offset_omegadot_y*d2_omegadot_y - bar_time_offset_omegadot_z*d2_omegadot_z  # imu-filter.b_w
    D[115] = bar_time_offset_a_x*x12 - bar_time_offset_a_y*x19 + bar_time_offset_a_z*(-x16 - x260)  # imu-lever-arm.l_x
    D[116] = bar_time_offset_a_x*(omegadot_z - x14) + bar_time_offset_a_y*x22 - bar_time_offset_a_z*x27  # imu-lever-arm.l_y
    D[117] = -bar_time_offset_a_x*x17 + bar_time_offset_a_y*(omegadot_x - x24) + bar_time_offset_a_z*x29  # imu-lever-arm.l_z
    D[118] = -bar_imu_turn_yz + bar_imu_turn_zy  # imu-misalignment.e_x
    D[119] = bar_imu_turn_xz - bar_imu_turn_zx  # imu-misalignment.e_y
    D[120] = -bar_imu_turn_xy + bar_imu_turn_yx  # imu-misalignment.e_z
    D[121] = x236  # imu-skew.delta_x
    D[122] = x237  # imu-skew.delta_y
    D[123] = bar_time_offset_a_x*x262  # imu-thermal.db_x_dT
    D[124] = bar_time_offset_a_y*x262  # imu-thermal.db_y_dT
    D[125] = -x258*x261  # imu-thermal.ds_x_dT
    D[126] = -x259*x261  # imu-thermal.ds_y_dT
    D[127] = bar_i_vibration_rectification*x263  # inner-temperature.b
    D[128] = x162*x263  # inner-temperature.s
    D[129] = C__heat_start*bar_i_vibration_rectification  # inner-temperature.b_0
    D[130] = C__heat_start*x162  # inner-temperature.s_0
    D[131] = 0  # inner-temperature.tau
    D[132] = -bar_i_vibration_rectification*rate_f_f_i  # lag.tau
    D[133] = bar_i_vibration_rectification*(B_x*f_tau_zx + B_y*f_tau_zy - B_z)  # magnetic-axial-bias.dK0_dBz
    D[134] = bar_i_vibration_rectification*(B_x*x114 + B_y*x115 + B_z*x116)  # magnetic-bias.dK0_dB
    D[135] = x264*(B_x*f_tau_xx + B_y*f_tau_xy)  # magnetic-scale.dK1_dB
    D[136] = bar_vartheta_y_thermal_misalignment*time  # misalignment-drift.dvartheta_y_dt
    D[137] = bar_vartheta_y_thermal_misalignment  # misalignment-step.dvartheta_y
    D[138] = b_f_xj*bar_vartheta_y_thermal_misalignment  # mount-compliance.c_yx
    D[139] = b_f_yj*bar_vartheta_y_thermal_misalignment  # mount-compliance.c_yy
    D[140] = b_f_zj*bar_vartheta_y_thermal_misalignment  # mount-compliance.c_yz
    D[141] = b_f_xj*bar_vartheta_z_mount_hysteresis  # mount-compliance.c_zx
    D[142] = b_f_yj*bar_vartheta_z_mount_hysteresis  # mount-compliance.c_zy
    D[143] = b_f_zj*bar_vartheta_z_mount_hysteresis  # mount-compliance.c_zz
    D[144] = bar_vartheta_y_thermal_misalignment*x265  # mount-hysteresis.e_yx
    D[145] = -C__play_axial*bar_vartheta_y_thermal_misalignment  # mount-hysteresis.e_yz
    D[146] = bar_vartheta_z_mount_hysteresis*x265  # mount-hysteresis.e_zx
    D[147] = 0  # mount-hysteresis.w
    D[148] = C__mount_a_x*bar_time_offset_a_x + C__mount_a_y*bar_time_offset_a_y + C__mount_a_z*bar_time_offset_a_z + C__mount_omega_x*bar_time_offset_omega_x + C__mount_omega_y*bar_time_offset_omega_y + C__mount_omega_z*bar_time_offset_omega_z + C__mount_omegadot_x*bar_time_offset_omegadot_x + C__mount_omegadot_y*bar_time_offset_omegadot_y + C__mount_omegadot_z*bar_time_offset_omegadot_z  # mount-resonance.share
    D[149] = 0  # mount-resonance.f_0
    D[150] = 0  # mount-resonance.Q
    D[151] = bar_f_f_x*x271 - bar_q_f_x*x267 + x266  # near-mass.T_xxx
    D[152] = bar_f_f_y*x271 + bar_f_f_z*f_disc_r_z*f_r_y - bar_q_f_y*x267 - f_r_x*x131 - q_r_x*x132  # near-mass.T_xxy
    D[153] = bar_f_f_z*x271 + bar_q_p_second_order_misalignment*x267 - x272  # near-mass.T_xxz
    D[154] = bar_f_f_x*x275 + bar_f_f_z*f_disc_r_z*f_r_x - bar_q_f_x*x273 - f_r_x*x127 - q_r_x*x128  # near-mass.T_xyy
    D[155] = bar_q_p_second_order_misalignment*q_r_x*q_r_y - f_r_x*x123 - f_r_y*x130 - x276  # near-mass.T_xyz
    D[156] = bar_f_f_y*x275 - bar_q_f_y*x273 + f_r_y*x122  # near-mass.T_yyy
    D[157] = bar_f_f_z*x275 + bar_q_p_second_order_misalignment*x273 - f_r_y*x126  # near-mass.T_yyz
    D[158] = bar_f_f_x*x279 - bar_f_f_z*x282 - bar_q_f_x*x277  # near-mass.T_xxxx
    D[159] = bar_f_f_x*x285 + bar_f_f_y*x279 - bar_q_f_y*x277 - x132*x267 + x283  # near-mass.T_xxxy
    D[160] = bar_f_f_x*x282 + bar_f_f_z*x279 + bar_q_p_second_order_misalignment*x277  # near-mass.T_xxxz
    D[161] = bar_f_f_x*x286 + bar_f_f_y*x285 + bar_f_f_z*(f_disc_r_z*x270 - 1/3*x280 + x287) - x128*x267 - x133*x273  # near-mass.T_xxyy
    D[162] = bar_f_f_y*x282 + bar_f_f_z*x285 - f_r_y*x272 + x124*x267  # near-mass.T_xxyz
    D[163] = bar_f_f_x*x289 + bar_f_f_y*x286 - bar_q_f_x*x288 - x129*x273 + x283  # near-mass.T_xyyy
    D[164] = bar_f_f_x*x290 + bar_f_f_z*x286 - f_r_y*x276 + x125*x273  # near-mass.T_xyyz
    D[165] = bar_f_f_y*x289 - bar_f_f_z*x290 - bar_q_f_y*x288  # near-mass.T_yyyy
    D[166] = bar_f_f_y*x290 + bar_f_f_z*x289 + bar_q_p_second_order_misalignment*x288  # near-mass.T_yyyz
    D[167] = x247*np.abs(f_f_i)  # odd-quadratic.K_oq
    D[168] = -G_out*x264  # output-curve.c_2
    D[169] = -G_out**2.0*x264  # output-curve.c_3
    D[170] = x291  # output-filter.b
    D[171] = x264  # output-gain-step.g
    D[172] = bar_i_vibration_rectification*(-beta_x*(d2_spin_angle + omegadot_z) + f_tau_yx*(omegadot_x + x53) + f_tau_yy*(-x260 - x52))  # pendulum-angular.K_pa
    D[173] = bar_i_vibration_rectification*(pressure - 101325)  # pressure-bias.dK0_dp
    D[174] = bar_K2_thermal_second_order*time  # second-order-drift.dK2_dt
    D[175] = x291  # second-order-loop.b
    D[176] = bar_q_i_second_order_misalignment*(f_f_i - q_f_xj) + bar_q_o_second_order_misalignment*(f_f_o - q_f_yj) + bar_q_p_second_order_misalignment*(f_f_p + q_f_z)  # second-order-misalignment.kappa
    D[177] = -bar_M_xx*x6 - x292  # self-gradient.G_xx_roll
    D[178] = bar_spin_axis_tilt_Gamma_xy*x6  # self-gradient.G_xy_roll
    D[179] = bar_spin_axis_tilt_Gamma_xz*x6  # self-gradient.G_xz_roll
    D[180] = -bar_M_yy*x6 - x292  # self-gradient.G_yy_roll
    D[181] = bar_spin_axis_tilt_Gamma_yz*x6  # self-gradient.G_yz_roll
    D[182] = -bar_M_xx*x5 - x293  # self-gradient.G_xx_pitch
    D[183] = bar_spin_axis_tilt_Gamma_xy*x5  # self-gradient.G_xy_pitch
    D[184] = bar_spin_axis_tilt_Gamma_xz*x5  # self-gradient.G_xz_pitch
    D[185] = -bar_M_yy*x5 - x293  # self-gradient.G_yy_pitch
    D[186] = bar_spin_axis_tilt_Gamma_yz*x5  # self-gradient.G_yz_pitch
    D[187] = -bar_M_xx*x295 - bar_M_yy*x294 + 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw  # self-gradient-yaw.G_d
    D[188] = bar_spin_axis_tilt_Gamma_xy*x295 + x189*x296 - x191*x296  # self-gradient-yaw.G_xy
    D[189] = bar_spin_axis_tilt_Gamma_xz*x297 + bar_spin_axis_tilt_Gamma_yz*sin_yaw  # self-gradient-yaw.G_xz
    D[190] = -bar_spin_axis_tilt_Gamma_xz*sin_yaw + bar_spin_axis_tilt_Gamma_yz*x297  # self-gradient-yaw.G_yz
    D[191] = -Gamma_xy*bar_spin_axis_tilt_Gamma_xz + Gamma_xz*bar_spin_axis_tilt_Gamma_xy - bar_M_yy*x299 + bar_M_zz*x299 + bar_spin_axis_tilt_Gamma_yz*(-Gamma_yy - x298) - x135 - x136 + x143 + x257  # spin-axis-tilt.alpha_x
    D[192] = Gamma_xy*bar_spin_axis_tilt_Gamma_yz - Gamma_yz*bar_spin_axis_tilt_Gamma_xy + bar_M_xx*x300 - bar_M_zz*x300 + bar_spin_axis_tilt_Gamma_xz*(Gamma_xx + x298) + x140 - x147 - x148 + x256  # spin-axis-tilt.alpha_y
    D[193] = bar_wobble_xz*sin_phi - bar_wobble_yz*cos_phi - bar_wobble_zx*sin_phi + bar_wobble_zy*cos_phi  # spin-axis-wobble.w_x
    D[194] = bar_wobble_xz*cos_phi + bar_wobble_yz*sin_phi - bar_wobble_zx*cos_phi - bar_wobble_zy*sin_phi  # spin-axis-wobble.w_y
    D[195] = bar_sin_delta_phi  # spin-phase-offset.phi_0
    D[196] = bar_sin_delta_phi  # spin-rate-jitter.sigma_phi
    D[197] = bar_sin_delta_phi  # spin-rate-jitter.sigma_walk
    D[198] = 2.0*bar_sin_delta_phi*time*x41  # spin-rate-offset.epsilon
    D[199] = -bar_sin_delta_phi*omegadot_z  # spin-servo.c
    D[200] = bar_i_vibration_rectification*x261  # thermal-bias.dK0_dT
    D[201] = bar_i_vibration_rectification*d_temperature  # thermal-lag.dK0_dTdot
    D[202] = d_temperature*x162  # thermal-lag.dK1_dTdot
    D[203] = bar_vartheta_y_thermal_misalignment*x261  # thermal-misalignment.dvartheta_y_dT
    D[204] = x162*x261  # thermal-scale.dK1_dT
    D[205] = bar_K2_thermal_second_order*x261  # thermal-second-order.dK2_dT
    D[206] = x236 + x237 + x238 + x254 + x255  # time-offset.delta_t
    D[207] = bar_i_vibration_rectification*(x301*x303 + x301*x305 + x301*x307 + x301*x308 + x301*x309 + x301*x310)  # vibration-level.L_xx
    D[208] = bar_i_vibration_rectification*(x301*x311 + x301*x313 + x301*x314 + x301*x316 + x301*x317 + x301*x319 + x301*x321 + x301*x323 + x301*x325)  # vibration-level.L_xy
    D[209] = bar_i_vibration_rectification*(x301*x326 + x301*x327 + x301*x328 + x301*x329 + x301*x330 + x301*x331 + x301*x332 + x301*x333 + x301*x334)  # vibration-level.L_xz
    D[210] = bar_i_vibration_rectification*(x301*x336 + x301*x338 + x301*x340 + x301*x341 + x301*x342 + x301*x343)  # vibration-level.L_yy
    D[211] = bar_i_vibration_rectification*(x301*x344 + x301*x346 + x301*x347 + x301*x349 + x301*x350 + x301*x352 + x301*x353 + x301*x354 + x301*x355)  # vibration-level.L_yz
    D[212] = bar_i_vibration_rectification*(x301*x356 + x301*x357 + x301*x358 + x301*x359 + x301*x360 + x301*x361)  # vibration-level.L_zz
    D[213] = bar_i_vibration_rectification*(x303 + x305 + x307 + x308 + x309 + x310)  # vibration-rectification.P_xx
    D[214] = bar_i_vibration_rectification*(x311 + x313 + x314 + x316 + x317 + x319 + x321 + x323 + x325)  # vibration-rectification.P_xy
    D[215] = bar_i_vibration_rectification*(x326 + x327 + x328 + x329 + x330 + x331 + x332 + x333 + x334)  # vibration-rectification.P_xz
    D[216] = bar_i_vibration_rectification*(x336 + x338 + x340 + x341 + x342 + x343)  # vibration-rectification.P_yy
    D[217] = bar_i_vibration_rectification*(x344 + x346 + x347 + x349 + x350 + x352 + x353 + x354 + x355)  # vibration-rectification.P_yz
    D[218] = bar_i_vibration_rectification*(x356 + x357 + x358 + x359 + x360 + x361)  # vibration-rectification.P_zz
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
