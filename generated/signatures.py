"""Signatures: what each candidate effect would add to V_j.

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: adc-nonlinearity, angular-jitter, anisoinertia, arm-length, arm-sag, arm-stretch, bearing-run-out, bias-drift, bias-step, clock-drift, cubic-cross, cubic-input, disc-spin, encoder-harmonic, fuel-gradient, gain-drift, gain-step, gradient-offset, gyro-bias, gyro-delay, gyro-g-sensitivity, gyro-scale, imu-acceleration-bias, imu-acceleration-misalignment, imu-acceleration-scale, imu-lever-arm, imu-misalignment, lag, magnetic-bias, mount-compliance, near-mass, odd-quadratic, output-filter, output-gain-step, pendulum-angular, pressure-bias, second-order-loop, second-order-misalignment, self-gradient, self-gradient-yaw, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, spin-rate-offset, spin-servo, thermal-bias, thermal-lag, thermal-scale, time-offset, vibration-level, vibration-rectification.
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
    "angular_vibration_rms",
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
    ("bias-step.dK0", False),
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
    ("imu-acceleration-scale.s_x", True),
    ("imu-acceleration-scale.s_y", True),
    ("imu-acceleration-scale.s_z", True),
    ("imu-lever-arm.l_x", True),
    ("imu-lever-arm.l_y", True),
    ("imu-lever-arm.l_z", True),
    ("imu-misalignment.e_x", True),
    ("imu-misalignment.e_y", True),
    ("imu-misalignment.e_z", True),
    ("lag.tau", False),
    ("magnetic-bias.dK0_dB", False),
    ("mount-compliance.c_yx", False),
    ("mount-compliance.c_yy", False),
    ("mount-compliance.c_yz", False),
    ("mount-compliance.c_zx", False),
    ("mount-compliance.c_zy", False),
    ("mount-compliance.c_zz", False),
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
    ("output-filter.b", True),
    ("output-gain-step.g", True),
    ("pendulum-angular.K_pa", False),
    ("pressure-bias.dK0_dp", False),
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
    ("thermal-scale.dK1_dT", False),
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
    angular_vibration_rms = inputs[18]
    d2_a_x = inputs[19]
    d2_a_y = inputs[20]
    d2_a_z = inputs[21]
    d2_omegadot_x = inputs[22]
    d2_omegadot_y = inputs[23]
    d2_omegadot_z = inputs[24]
    d2_spin_angle = inputs[25]
    d_a_x = inputs[26]
    d_a_y = inputs[27]
    d_a_z = inputs[28]
    d_omegadot_x = inputs[29]
    d_omegadot_y = inputs[30]
    d_omegadot_z = inputs[31]
    d_spin_angle = inputs[32]
    d_temperature = inputs[33]
    fuel_mass = inputs[34]
    pitch = inputs[35]
    pressure = inputs[36]
    roll = inputs[37]
    temperature = inputs[38]
    vibration_rms = inputs[39]
    yaw = inputs[40]
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
    cos_yaw = np.cos(yaw)
    sin_yaw = np.sin(yaw)
    x0 = omega_y**2.0
    x1 = omega_z**2.0
    x2 = x0 + x1
    x3 = -Gamma_xx - x2
    M_xx = x3
    x4 = omega_x*omega_y
    x5 = -Gamma_xy - omegadot_z + x4
    M_xy = x5
    x6 = omega_x*omega_z
    x7 = omegadot_y + x6
    x8 = -Gamma_xz + x7
    M_xz = x8
    x9 = omegadot_z + x4
    x10 = -Gamma_xy + x9
    M_yx = x10
    x11 = omega_x**2.0
    x12 = x1 + x11
    x13 = -Gamma_yy - x12
    M_yy = x13
    x14 = omega_y*omega_z
    x15 = -Gamma_yz - omegadot_x + x14
    M_yz = x15
    x16 = -Gamma_xz - omegadot_y + x6
    M_zx = x16
    x17 = omegadot_x + x14
    x18 = -Gamma_yz + x17
    M_zy = x18
    x19 = x0 + x11
    x20 = -Gamma_zz - x19
    M_zz = x20
    cos_psi = cos_j*cos_phi - sin_j*sin_phi
    sin_psi = cos_j*sin_phi + cos_phi*sin_j
    x21 = dR + radius
    b_disc_r_x = x21
    x22 = beta_z*x21
    b_disc_r_y = x22
    x23 = beta_x*x21
    b_disc_r_z = x23
    x24 = -beta_x*beta_z
    b_disc_tau_zy = x24
    b_r_x = b_disc_r_x*cos_psi - b_disc_r_y*sin_psi
    b_r_y = b_disc_r_x*sin_psi + b_disc_r_y*cos_psi
    x25 = beta_z*cos_psi + sin_psi
    x26 = -x25
    b_tau_xx = x26
    x27 = -beta_z*sin_psi + cos_psi
    b_tau_xy = x27
    b_tau_yx = x27
    b_tau_yy = x25
    x28 = beta_x*cos_psi
    b_tau_zx = -b_disc_tau_zy*sin_psi - x28
    x29 = beta_x*sin_psi
    b_tau_zy = b_disc_tau_zy*cos_psi - x29
    x30 = 2.0*sin_phi
    x31 = np.pi*spin_frequency
    x32 = -x30*x31
    rate_cos_phi_true = x32
    x33 = 2.0*cos_phi
    x34 = x31*x33
    rate_sin_phi_true = x34
    x35 = 4.0*cos_phi
    x36 = np.pi**2.0*spin_frequency**2.0
    x37 = -x35*x36
    rate_rate_cos_phi_true = x37
    x38 = 4.0*sin_phi
    x39 = -x36*x38
    rate_rate_sin_phi_true = x39
    x40 = 2.0*omega_z
    x41 = -d_spin_angle**2.0 - d_spin_angle*x40
    spin_xx = x41
    spin_yy = x41
    x42 = d_spin_angle*omega_x
    spin_zx = 2.0*x42
    x43 = d_spin_angle*omega_y
    spin_zy = 2.0*x43
    b_f_x = M_xx*b_r_x + M_xy*b_r_y + M_xz*b_disc_r_z + a_x
    b_f_y = M_yx*b_r_x + M_yy*b_r_y + M_yz*b_disc_r_z + a_y
    b_f_z = M_zx*b_r_x + M_zy*b_r_y + M_zz*b_disc_r_z + a_z
    b_f_xj = b_f_x*b_tau_xx + b_f_y*b_tau_xy
    b_f_yj = b_f_x*b_tau_yx + b_f_y*b_tau_yy - b_f_z*beta_x
    b_f_zj = b_f_x*b_tau_zx + b_f_y*b_tau_zy - b_f_z
    f_disc_r_x = x21
    f_disc_r_y = x22
    f_disc_r_z = x23
    f_disc_tau_zy = x24
    f_r_x = cos_psi*f_disc_r_x - f_disc_r_y*sin_psi
    f_r_y = cos_psi*f_disc_r_y + f_disc_r_x*sin_psi
    f_tau_xx = x26
    f_tau_xy = x27
    f_tau_yx = x27
    f_tau_yy = x25
    f_tau_zx = -f_disc_tau_zy*sin_psi - x28
    f_tau_zy = cos_psi*f_disc_tau_zy - x29
    x44 = x21**(-1.0)
    f_arm_x = f_r_x*x44
    f_arm_y = f_r_y*x44
    f_arm_z = f_disc_r_z*x44
    x45 = 2.0*omega_y
    x46 = omegadot_y*x45
    x47 = omegadot_z*x40
    x48 = -x46 - x47
    rate_M_xx = x48
    x49 = omega_x*omegadot_y + omega_y*omegadot_x
    x50 = -d_omegadot_z + x49
    rate_M_xy = x50
    x51 = omega_x*omegadot_z + omega_z*omegadot_x
    x52 = d_omegadot_y + x51
    rate_M_xz = x52
    V2__rate_cos_phi_true = x32
    V2__rate_sin_phi_true = x34
    rate_cos_psi = V2__rate_cos_phi_true*cos_j - V2__rate_sin_phi_true*sin_j
    rate_sin_psi = V2__rate_cos_phi_true*sin_j + V2__rate_sin_phi_true*cos_j
    rate_b_r_x = b_disc_r_x*rate_cos_psi - b_disc_r_y*rate_sin_psi
    rate_b_r_y = b_disc_r_x*rate_sin_psi + b_disc_r_y*rate_cos_psi
    rate_b_f_x = M_xx*rate_b_r_x + M_xy*rate_b_r_y + b_disc_r_z*rate_M_xz + b_r_x*rate_M_xx + b_r_y*rate_M_xy + d_a_x
    x53 = d_omegadot_z + x49
    rate_M_yx = x53
    x54 = 2.0*omegadot_x
    x55 = omega_x*x54
    x56 = -x47 - x55
    rate_M_yy = x56
    x57 = omega_y*omegadot_z + omega_z*omegadot_y
    x58 = -d_omegadot_x + x57
    rate_M_yz = x58
    rate_b_f_y = M_yx*rate_b_r_x + M_yy*rate_b_r_y + b_disc_r_z*rate_M_yz + b_r_x*rate_M_yx + b_r_y*rate_M_yy + d_a_y
    x59 = -d_omegadot_y + x51
    rate_M_zx = x59
    x60 = d_omegadot_x + x57
    rate_M_zy = x60
    x61 = -x46 - x55
    rate_M_zz = x61
    rate_b_f_z = M_zx*rate_b_r_x + M_zy*rate_b_r_y + b_disc_r_z*rate_M_zz + b_r_x*rate_M_zx + b_r_y*rate_M_zy + d_a_z
    rate_b_tau_yx = -beta_z*rate_sin_psi + rate_cos_psi
    rate_b_tau_yy = beta_z*rate_cos_psi + rate_sin_psi
    rate_b_f_yj = b_f_x*rate_b_tau_yx + b_f_y*rate_b_tau_yy + b_tau_yx*rate_b_f_x + b_tau_yy*rate_b_f_y - beta_x*rate_b_f_z
    rate_b_tau_zx = -b_disc_tau_zy*rate_sin_psi - beta_x*rate_cos_psi
    rate_b_tau_zy = b_disc_tau_zy*rate_cos_psi - beta_x*rate_sin_psi
    rate_b_f_zj = b_f_x*rate_b_tau_zx + b_f_y*rate_b_tau_zy + b_tau_zx*rate_b_f_x + b_tau_zy*rate_b_f_y - rate_b_f_z
    rate_V2__rate_cos_phi_true = x37
    rate_V2__rate_sin_phi_true = x39
    x62 = d_omegadot_z*x40 + 2.0*omegadot_z**2.0
    x63 = d_omegadot_y*x45 + 2.0*omegadot_y**2.0
    x64 = -x62 - x63
    rate_rate_M_xx = x64
    x65 = d_omegadot_x*omega_y + d_omegadot_y*omega_x + omegadot_y*x54
    x66 = -d2_omegadot_z + x65
    rate_rate_M_xy = x66
    x67 = d_omegadot_x*omega_z + d_omegadot_z*omega_x + omegadot_z*x54
    x68 = d2_omegadot_y + x67
    rate_rate_M_xz = x68
    rate_rate_cos_psi = cos_j*rate_V2__rate_cos_phi_true - rate_V2__rate_sin_phi_true*sin_j
    rate_rate_sin_psi = cos_j*rate_V2__rate_sin_phi_true + rate_V2__rate_cos_phi_true*sin_j
    rate_rate_b_r_x = b_disc_r_x*rate_rate_cos_psi - b_disc_r_y*rate_rate_sin_psi
    rate_rate_b_r_y = b_disc_r_x*rate_rate_sin_psi + b_disc_r_y*rate_rate_cos_psi
    x69 = 2.0*rate_b_r_x
    x70 = 2.0*rate_b_r_y
    rate_rate_b_f_x = M_xx*rate_rate_b_r_x + M_xy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_xz + b_r_x*rate_rate_M_xx + b_r_y*rate_rate_M_xy + d2_a_x + rate_M_xx*x69 + rate_M_xy*x70
    x71 = d2_omegadot_z + x65
    rate_rate_M_yx = x71
    x72 = 2.0*omega_x
    x73 = d_omegadot_x*x72 + 2.0*omegadot_x**2.0
    x74 = -x62 - x73
    rate_rate_M_yy = x74
    x75 = d_omegadot_y*omega_z + d_omegadot_z*omega_y + 2.0*omegadot_y*omegadot_z
    x76 = -d2_omegadot_x + x75
    rate_rate_M_yz = x76
    rate_rate_b_f_y = M_yx*rate_rate_b_r_x + M_yy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_yz + b_r_x*rate_rate_M_yx + b_r_y*rate_rate_M_yy + d2_a_y + rate_M_yx*x69 + rate_M_yy*x70
    x77 = -d2_omegadot_y + x67
    rate_rate_M_zx = x77
    x78 = d2_omegadot_x + x75
    rate_rate_M_zy = x78
    x79 = -x63 - x73
    rate_rate_M_zz = x79
    rate_rate_b_f_z = M_zx*rate_rate_b_r_x + M_zy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_zz + b_r_x*rate_rate_M_zx + b_r_y*rate_rate_M_zy + d2_a_z + rate_M_zx*x69 + rate_M_zy*x70
    rate_rate_b_tau_yx = -beta_z*rate_rate_sin_psi + rate_rate_cos_psi
    rate_rate_b_tau_yy = beta_z*rate_rate_cos_psi + rate_rate_sin_psi
    x80 = 2.0*rate_b_f_x
    x81 = 2.0*rate_b_f_y
    rate_rate_b_f_yj = b_f_x*rate_rate_b_tau_yx + b_f_y*rate_rate_b_tau_yy + b_tau_yx*rate_rate_b_f_x + b_tau_yy*rate_rate_b_f_y - beta_x*rate_rate_b_f_z + rate_b_tau_yx*x80 + rate_b_tau_yy*x81
    rate_rate_b_tau_zx = -b_disc_tau_zy*rate_rate_sin_psi - beta_x*rate_rate_cos_psi
    rate_rate_b_tau_zy = b_disc_tau_zy*rate_rate_cos_psi - beta_x*rate_rate_sin_psi
    rate_rate_b_f_zj = b_f_x*rate_rate_b_tau_zx + b_f_y*rate_rate_b_tau_zy + b_tau_zx*rate_rate_b_f_x + b_tau_zy*rate_rate_b_f_y + rate_b_tau_zx*x80 + rate_b_tau_zy*x81 - rate_rate_b_f_z
    f_f_x = M_xx*f_r_x + M_xy*f_r_y + M_xz*f_disc_r_z + a_x
    f_f_y = M_yx*f_r_x + M_yy*f_r_y + M_yz*f_disc_r_z + a_y
    f_f_z = M_zx*f_r_x + M_zy*f_r_y + M_zz*f_disc_r_z + a_z
    f_f_xj = f_f_x*f_tau_xx + f_f_y*f_tau_xy
    f_f_yj = -beta_x*f_f_z + f_f_x*f_tau_yx + f_f_y*f_tau_yy
    f_f_zj = f_f_x*f_tau_zx + f_f_y*f_tau_zy - f_f_z
    f_f_i = f_f_xj + f_f_yj*vartheta_z - f_f_zj*vartheta_y
    f_f_o = -f_f_xj*vartheta_z + f_f_yj + f_f_zj*vartheta_x
    f_f_p = f_f_xj*vartheta_y - f_f_yj*vartheta_x + f_f_zj
    q_disc_r_x = x21
    q_r_x = cos_psi*q_disc_r_x
    q_r_y = q_disc_r_x*sin_psi
    q_arm_x = q_r_x*x44
    q_arm_y = q_r_y*x44
    q_f_x = M_xx*q_r_x + M_xy*q_r_y + a_x
    q_f_y = M_yx*q_r_x + M_yy*q_r_y + a_y
    q_f_z = M_zx*q_r_x + M_zy*q_r_y + a_z
    q_f_xj = cos_psi*q_f_y - q_f_x*sin_psi
    q_f_yj = cos_psi*q_f_x + q_f_y*sin_psi
    x82 = K6*q_f_yj
    x83 = K4*q_f_z
    x84 = K8*q_f_z
    i_sensed = K0 + K2*q_f_xj**2.0 + K5*q_f_yj**2.0 + K7*q_f_z**2.0 + f_f_i + q_f_xj*x82 - q_f_xj*x83 - q_f_yj*x84
    V2__rate_M_xx = x48
    V2__rate_M_xy = x50
    V2__rate_M_xz = x52
    V2__rate_cos_psi = cos_j*rate_cos_phi_true - rate_sin_phi_true*sin_j
    V2__rate_sin_psi = cos_j*rate_sin_phi_true + rate_cos_phi_true*sin_j
    rate_f_r_x = V2__rate_cos_psi*f_disc_r_x - V2__rate_sin_psi*f_disc_r_y
    rate_f_r_y = V2__rate_cos_psi*f_disc_r_y + V2__rate_sin_psi*f_disc_r_x
    rate_f_f_x = M_xx*rate_f_r_x + M_xy*rate_f_r_y + V2__rate_M_xx*f_r_x + V2__rate_M_xy*f_r_y + V2__rate_M_xz*f_disc_r_z + d_a_x
    V2__rate_M_yx = x53
    V2__rate_M_yy = x56
    V2__rate_M_yz = x58
    rate_f_f_y = M_yx*rate_f_r_x + M_yy*rate_f_r_y + V2__rate_M_yx*f_r_x + V2__rate_M_yy*f_r_y + V2__rate_M_yz*f_disc_r_z + d_a_y
    x85 = V2__rate_cos_psi*beta_z + V2__rate_sin_psi
    rate_f_tau_xx = -x85
    x86 = V2__rate_cos_psi - V2__rate_sin_psi*beta_z
    rate_f_tau_xy = x86
    rate_f_f_xj = f_f_x*rate_f_tau_xx + f_f_y*rate_f_tau_xy + f_tau_xx*rate_f_f_x + f_tau_xy*rate_f_f_y
    V2__rate_M_zx = x59
    V2__rate_M_zy = x60
    V2__rate_M_zz = x61
    rate_f_f_z = M_zx*rate_f_r_x + M_zy*rate_f_r_y + V2__rate_M_zx*f_r_x + V2__rate_M_zy*f_r_y + V2__rate_M_zz*f_disc_r_z + d_a_z
    rate_f_tau_yx = x86
    rate_f_tau_yy = x85
    rate_f_f_yj = -beta_x*rate_f_f_z + f_f_x*rate_f_tau_yx + f_f_y*rate_f_tau_yy + f_tau_yx*rate_f_f_x + f_tau_yy*rate_f_f_y
    rate_f_tau_zx = -V2__rate_cos_psi*beta_x - V2__rate_sin_psi*f_disc_tau_zy
    rate_f_tau_zy = V2__rate_cos_psi*f_disc_tau_zy - V2__rate_sin_psi*beta_x
    rate_f_f_zj = f_f_x*rate_f_tau_zx + f_f_y*rate_f_tau_zy + f_tau_zx*rate_f_f_x + f_tau_zy*rate_f_f_y - rate_f_f_z
    rate_f_f_i = rate_f_f_xj + rate_f_f_yj*vartheta_z - rate_f_f_zj*vartheta_y
    rate_V2__rate_M_xx = x64
    rate_V2__rate_M_xy = x66
    rate_V2__rate_M_xz = x68
    rate_V2__rate_cos_psi = cos_j*rate_rate_cos_phi_true - rate_rate_sin_phi_true*sin_j
    rate_V2__rate_sin_psi = cos_j*rate_rate_sin_phi_true + rate_rate_cos_phi_true*sin_j
    rate_rate_f_r_x = f_disc_r_x*rate_V2__rate_cos_psi - f_disc_r_y*rate_V2__rate_sin_psi
    rate_rate_f_r_y = f_disc_r_x*rate_V2__rate_sin_psi + f_disc_r_y*rate_V2__rate_cos_psi
    x87 = 2.0*rate_f_r_x
    x88 = 2.0*rate_f_r_y
    rate_rate_f_f_x = M_xx*rate_rate_f_r_x + M_xy*rate_rate_f_r_y + V2__rate_M_xx*x87 + V2__rate_M_xy*x88 + d2_a_x + f_disc_r_z*rate_V2__rate_M_xz + f_r_x*rate_V2__rate_M_xx + f_r_y*rate_V2__rate_M_xy
    rate_V2__rate_M_yx = x71
    rate_V2__rate_M_yy = x74
    rate_V2__rate_M_yz = x76
    rate_rate_f_f_y = M_yx*rate_rate_f_r_x + M_yy*rate_rate_f_r_y + V2__rate_M_yx*x87 + V2__rate_M_yy*x88 + d2_a_y + f_disc_r_z*rate_V2__rate_M_yz + f_r_x*rate_V2__rate_M_yx + f_r_y*rate_V2__rate_M_yy
    x89 = beta_z*rate_V2__rate_cos_psi + rate_V2__rate_sin_psi
    rate_rate_f_tau_xx = -x89
    x90 = -beta_z*rate_V2__rate_sin_psi + rate_V2__rate_cos_psi
    rate_rate_f_tau_xy = x90
    x91 = 2.0*rate_f_f_x
    x92 = 2.0*rate_f_f_y
    rate_rate_f_f_xj = f_f_x*rate_rate_f_tau_xx + f_f_y*rate_rate_f_tau_xy + f_tau_xx*rate_rate_f_f_x + f_tau_xy*rate_rate_f_f_y + rate_f_tau_xx*x91 + rate_f_tau_xy*x92
    rate_V2__rate_M_zx = x77
    rate_V2__rate_M_zy = x78
    rate_V2__rate_M_zz = x79
    rate_rate_f_f_z = M_zx*rate_rate_f_r_x + M_zy*rate_rate_f_r_y + V2__rate_M_zx*x87 + V2__rate_M_zy*x88 + d2_a_z + f_disc_r_z*rate_V2__rate_M_zz + f_r_x*rate_V2__rate_M_zx + f_r_y*rate_V2__rate_M_zy
    rate_rate_f_tau_yx = x90
    rate_rate_f_tau_yy = x89
    rate_rate_f_f_yj = -beta_x*rate_rate_f_f_z + f_f_x*rate_rate_f_tau_yx + f_f_y*rate_rate_f_tau_yy + f_tau_yx*rate_rate_f_f_x + f_tau_yy*rate_rate_f_f_y + rate_f_tau_yx*x91 + rate_f_tau_yy*x92
    rate_rate_f_tau_zx = -beta_x*rate_V2__rate_cos_psi - f_disc_tau_zy*rate_V2__rate_sin_psi
    rate_rate_f_tau_zy = -beta_x*rate_V2__rate_sin_psi + f_disc_tau_zy*rate_V2__rate_cos_psi
    rate_rate_f_f_zj = f_f_x*rate_rate_f_tau_zx + f_f_y*rate_rate_f_tau_zy + f_tau_zx*rate_rate_f_f_x + f_tau_zy*rate_rate_f_f_y + rate_f_tau_zx*x91 + rate_f_tau_zy*x92 - rate_rate_f_f_z
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
    x93 = 2.0*rate_q_r_x
    x94 = 2.0*rate_q_r_y
    rate_rate_q_f_x = M_xx*rate_rate_q_r_x + M_xy*rate_rate_q_r_y + V2__rate_M_xx*x93 + V2__rate_M_xy*x94 + d2_a_x + q_r_x*rate_V2__rate_M_xx + q_r_y*rate_V2__rate_M_xy
    rate_rate_q_f_y = M_yx*rate_rate_q_r_x + M_yy*rate_rate_q_r_y + V2__rate_M_yx*x93 + V2__rate_M_yy*x94 + d2_a_y + q_r_x*rate_V2__rate_M_yx + q_r_y*rate_V2__rate_M_yy
    x95 = 2.0*rate_q_f_y
    x96 = 2.0*rate_q_f_x
    rate_rate_q_f_xj = V2__rate_cos_psi*x95 - V2__rate_sin_psi*x96 + cos_psi*rate_rate_q_f_y - q_f_x*rate_V2__rate_sin_psi + q_f_y*rate_V2__rate_cos_psi - rate_rate_q_f_x*sin_psi
    rate_rate_q_f_yj = V2__rate_cos_psi*x96 + V2__rate_sin_psi*x95 + cos_psi*rate_rate_q_f_x + q_f_x*rate_V2__rate_cos_psi + q_f_y*rate_V2__rate_sin_psi + rate_rate_q_f_y*sin_psi
    rate_rate_q_f_z = M_zx*rate_rate_q_r_x + M_zy*rate_rate_q_r_y + V2__rate_M_zx*x93 + V2__rate_M_zy*x94 + d2_a_z + q_r_x*rate_V2__rate_M_zx + q_r_y*rate_V2__rate_M_zy
    x97 = 2.0*K2
    x100 = q_f_xj*x97 + x82 - x83
    x98 = 2.0*K5
    x101 = K6*q_f_xj + q_f_yj*x98 - x84
    x99 = 2.0*K7
    x102 = K4*q_f_xj + K8*q_f_yj - q_f_z*x99
    rate_rate_i_sensed = rate_q_f_xj*(-K4*rate_q_f_z + K6*rate_q_f_yj + rate_q_f_xj*x97) + rate_q_f_yj*(K6*rate_q_f_xj - K8*rate_q_f_z + rate_q_f_yj*x98) - rate_q_f_z*(K4*rate_q_f_xj + K8*rate_q_f_yj - rate_q_f_z*x99) + rate_rate_f_f_i + rate_rate_q_f_xj*x100 + rate_rate_q_f_yj*x101 - rate_rate_q_f_z*x102
    x103 = f_tau_xx + f_tau_yx*vartheta_z - f_tau_zx*vartheta_y
    vibration_axis_ix = x103
    x104 = f_tau_xy + f_tau_yy*vartheta_z - f_tau_zy*vartheta_y
    vibration_axis_iy = x104
    x105 = -beta_x*vartheta_z + vartheta_y
    vibration_axis_iz = x105
    vibration_axis_ox = -f_tau_xx*vartheta_z + f_tau_yx + f_tau_zx*vartheta_x
    vibration_axis_oy = -f_tau_xy*vartheta_z + f_tau_yy + f_tau_zy*vartheta_x
    vibration_axis_oz = -beta_x - vartheta_x
    vibration_axis_px = f_tau_xx*vartheta_y - f_tau_yx*vartheta_x + f_tau_zx
    vibration_axis_py = f_tau_xy*vartheta_y - f_tau_yy*vartheta_x + f_tau_zy
    vibration_axis_pz = beta_x*vartheta_x - 1
    bar_i_vibration_rectification = K1*k_VI
    bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x102
    bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x101
    bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x100
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
    x106 = d_spin_angle + omega_z
    x107 = 2.0*x106
    bar_rate_dR_arm_stretch = bar_f_f_x*(-f_arm_y*x107 + 2.0*f_arm_z*omega_y) + bar_f_f_y*(f_arm_x*x107 - f_arm_z*x72) + bar_f_f_z*(-f_arm_x*x45 + 2.0*f_arm_y*omega_x) - bar_q_f_x*q_arm_y*x107 + bar_q_f_y*q_arm_x*x107 - bar_q_p_second_order_misalignment*(-q_arm_x*x45 + q_arm_y*x72)
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
    bar_K1_thermal_scale = i_sensed*k_VI
    bar_vartheta_z_mount_compliance = bar_i_vibration_rectification*f_f_yj
    bar_vartheta_y_mount_compliance = -bar_i_vibration_rectification*f_f_zj
    bar_dR_arm_stretch = bar_f_disc_r_x + bar_f_disc_r_y*beta_z + bar_f_spin_axis_wobble_r_z*beta_x + bar_q_disc_r_x
    x108 = bar_f_f_z - bar_q_p_second_order_misalignment
    bar_rate_rate_run_out_z = x108
    x109 = bar_f_f_y + bar_q_f_y
    bar_rate_rate_run_out_y = x109
    x110 = bar_f_f_x + bar_q_f_x
    bar_rate_rate_run_out_x = x110
    bar_rate_run_out_z = bar_f_f_x*x45 - bar_f_f_y*x72 + bar_q_f_x*x45 - bar_q_f_y*x72
    bar_rate_run_out_y = -bar_f_f_x*x40 + 2.0*bar_f_f_z*omega_x - bar_q_f_x*x40 - bar_q_p_second_order_misalignment*x72
    bar_rate_run_out_x = bar_f_f_y*x40 - bar_f_f_z*x45 + bar_q_f_y*x40 + bar_q_p_second_order_misalignment*x45
    bar_run_out_z = bar_f_f_x*x8 + bar_f_f_y*x15 + bar_f_f_z*x20 + bar_q_f_x*x8 + bar_q_f_y*x15 - bar_q_p_second_order_misalignment*x20
    bar_run_out_y = bar_f_f_x*x5 + bar_f_f_y*x13 + bar_f_f_z*x18 + bar_q_f_x*x5 + bar_q_f_y*x13 - bar_q_p_second_order_misalignment*x18
    bar_run_out_x = bar_f_f_x*x3 + bar_f_f_y*x10 + bar_f_f_z*x16 + bar_q_f_x*x3 + bar_q_f_y*x10 - bar_q_p_second_order_misalignment*x16
    bar_wobble_zy = bar_f_spin_axis_wobble_r_z*f_r_y + bar_f_spin_axis_wobble_tau_xz*f_tau_xy + bar_f_spin_axis_wobble_tau_yz*f_tau_yy + bar_f_spin_axis_wobble_tau_zz*f_tau_zy + bar_q_spin_axis_wobble_r_z*q_r_y + bar_q_spin_axis_wobble_tau_xz*cos_psi + bar_q_spin_axis_wobble_tau_yz*sin_psi
    bar_wobble_zx = bar_f_spin_axis_wobble_r_z*f_r_x + bar_f_spin_axis_wobble_tau_xz*f_tau_xx + bar_f_spin_axis_wobble_tau_yz*f_tau_yx + bar_f_spin_axis_wobble_tau_zz*f_tau_zx + bar_q_spin_axis_wobble_r_z*q_r_x - bar_q_spin_axis_wobble_tau_xz*sin_psi + bar_q_spin_axis_wobble_tau_yz*cos_psi
    bar_wobble_yz = bar_f_spin_axis_wobble_r_y*f_disc_r_z - bar_f_spin_axis_wobble_tau_yy*beta_x - bar_f_spin_axis_wobble_tau_zy - bar_q_p_second_order_misalignment*q_f_y
    bar_wobble_xz = bar_f_spin_axis_wobble_r_x*f_disc_r_z - bar_f_spin_axis_wobble_tau_yx*beta_x - bar_f_spin_axis_wobble_tau_zx - bar_q_p_second_order_misalignment*q_f_x
    bar_sin_psi = -bar_f_spin_axis_wobble_r_x*f_disc_r_y + bar_f_spin_axis_wobble_r_y*f_disc_r_x - bar_f_spin_axis_wobble_tau_xx - bar_f_spin_axis_wobble_tau_xy*beta_z - bar_f_spin_axis_wobble_tau_yx*beta_z + bar_f_spin_axis_wobble_tau_yy - bar_f_spin_axis_wobble_tau_zx*f_disc_tau_zy - bar_f_spin_axis_wobble_tau_zy*beta_x + bar_q_spin_axis_wobble_r_y*q_disc_r_x - bar_q_spin_axis_wobble_tau_xx + bar_q_spin_axis_wobble_tau_yy
    bar_cos_psi = bar_f_spin_axis_wobble_r_x*f_disc_r_x + bar_f_spin_axis_wobble_r_y*f_disc_r_y - bar_f_spin_axis_wobble_tau_xx*beta_z + bar_f_spin_axis_wobble_tau_xy + bar_f_spin_axis_wobble_tau_yx + bar_f_spin_axis_wobble_tau_yy*beta_z - bar_f_spin_axis_wobble_tau_zx*beta_x + bar_f_spin_axis_wobble_tau_zy*f_disc_tau_zy + bar_q_spin_axis_wobble_r_x*q_disc_r_x + bar_q_spin_axis_wobble_tau_xy + bar_q_spin_axis_wobble_tau_yx
    x111 = bar_f_f_z*f_disc_r_z
    bar_M_zz = x111
    x112 = bar_f_f_z*f_r_y
    x113 = bar_q_p_second_order_misalignment*q_r_y
    bar_M_zy = x112 - x113
    x114 = bar_q_p_second_order_misalignment*q_r_x
    bar_M_zx = bar_f_f_z*f_r_x - x114
    x115 = bar_f_f_y*f_disc_r_z
    bar_M_yz = x115
    x116 = bar_f_f_y*f_r_y
    x117 = bar_q_f_y*q_r_y
    bar_M_yy = x116 + x117
    x118 = bar_q_f_y*q_r_x
    bar_M_yx = bar_f_f_y*f_r_x + x118
    x119 = bar_f_f_x*f_disc_r_z
    bar_M_xz = x119
    x120 = bar_f_f_x*f_r_y
    x121 = bar_q_f_x*q_r_y
    bar_M_xy = x120 + x121
    x122 = bar_q_f_x*q_r_x
    bar_M_xx = bar_f_f_x*f_r_x + x122
    bar_sin_phi_true = -bar_cos_psi*sin_j + bar_sin_psi*cos_j
    bar_cos_phi_true = bar_cos_psi*cos_j + bar_sin_psi*sin_j
    bar_sin_delta_phi = -bar_cos_phi_true*sin_phi + bar_sin_phi_true*cos_phi
    bar_time_offset_omegadot_z = -bar_M_xy + bar_M_yx
    bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx
    bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy
    bar_time_offset_omega_z = -bar_M_xx*x40 + bar_M_xz*omega_x - bar_M_yy*x40 + bar_M_yz*omega_y + bar_M_zx*omega_x + bar_M_zy*omega_y
    bar_time_offset_omega_y = -bar_M_xx*x45 + bar_M_xy*omega_x + bar_M_yx*omega_x + bar_M_yz*omega_z + bar_M_zy*omega_z - bar_M_zz*x45
    bar_time_offset_omega_x = bar_M_xy*omega_y + bar_M_xz*omega_z + bar_M_yx*omega_y - bar_M_yy*x72 + bar_M_zx*omega_z - bar_M_zz*x72
    bar_time_offset_a_z = x108
    bar_time_offset_a_y = x109
    bar_time_offset_a_x = x110
    bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy
    bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx
    bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx
    x123 = a_y*bar_time_offset_a_z
    x124 = bar_time_offset_omega_z*omega_y
    x125 = bar_time_offset_omegadot_z*omegadot_y
    bar_imu_turn_zy = x123 + x124 + x125
    x126 = a_x*bar_time_offset_a_z
    x127 = bar_time_offset_omega_z*omega_x + bar_time_offset_omegadot_z*omegadot_x + x126
    bar_imu_turn_zx = x127
    x128 = a_z*bar_time_offset_a_y
    x129 = bar_time_offset_omega_y*omega_z + bar_time_offset_omegadot_y*omegadot_z + x128
    bar_imu_turn_yz = x129
    x130 = a_x*bar_time_offset_a_y
    bar_imu_turn_yx = bar_time_offset_omega_y*omega_x + bar_time_offset_omegadot_y*omegadot_x + x130
    x131 = a_z*bar_time_offset_a_x
    x132 = bar_time_offset_omega_x*omega_z
    x133 = bar_time_offset_omegadot_x*omegadot_z
    bar_imu_turn_xz = x131 + x132 + x133
    x134 = a_y*bar_time_offset_a_x
    bar_imu_turn_xy = bar_time_offset_omega_x*omega_y + bar_time_offset_omegadot_x*omegadot_y + x134
    x135 = angular_vibration_rms**2.0
    x136 = bar_M_yy*x135
    x137 = bar_M_zz*x135
    x138 = bar_M_xx*x135
    x139 = bar_run_out_x*cos_phi
    x140 = bar_run_out_y*cos_phi
    x141 = bar_run_out_z*cos_phi
    x142 = rate_cos_phi_true*x33 - rate_sin_phi_true*x30
    x143 = cos_phi**2.0
    x144 = sin_phi**2.0
    x145 = x143 - x144
    x146 = 2.0*rate_cos_phi_true**2.0 + rate_rate_cos_phi_true*x33 - rate_rate_sin_phi_true*x30 - 2.0*rate_sin_phi_true**2.0
    x147 = rate_cos_phi_true*x30 + rate_sin_phi_true*x33
    x148 = 4.0*rate_cos_phi_true*rate_sin_phi_true + rate_rate_cos_phi_true*x30 + rate_rate_sin_phi_true*x33
    x149 = bar_time_offset_a_x*d_a_x
    x150 = bar_time_offset_a_y*d_a_y
    x151 = bar_time_offset_a_z*d_a_z
    x152 = bar_time_offset_omega_x*omegadot_x
    x153 = bar_time_offset_omega_y*omegadot_y
    x154 = bar_time_offset_omega_z*omegadot_z
    x155 = bar_time_offset_omegadot_x*d_omegadot_x
    x156 = bar_time_offset_omegadot_y*d_omegadot_y
    x157 = bar_time_offset_omegadot_z*d_omegadot_z
    x158 = bar_i_vibration_rectification*f_f_i**2.0
    x159 = f_f_o**2.0
    x160 = bar_i_vibration_rectification*f_f_i
    x161 = f_f_p**2.0
    x162 = bar_sin_delta_phi*cos_phi
    x163 = cos_phi**3.0
    x164 = sin_phi**3.0
    x165 = -bar_M_zz*fuel_mass
    x166 = K1*bar_K1_thermal_scale
    x167 = -bar_M_zz
    x168 = x152 + x153 + x154
    x169 = x155 + x156 + x157
    x170 = -x131
    x171 = -x123
    x172 = -omegadot_y
    x173 = f_r_x*x111
    x174 = 0.5*q_r_x**2.0
    x175 = 0.5*f_disc_r_z**2.0
    x176 = f_r_x**2.0
    x177 = 0.5*x176
    x178 = x175 - x177
    x179 = f_r_x*x119
    x180 = 0.5*q_r_y**2.0
    x181 = 0.5*f_r_y**2.0
    x182 = x175 - x181
    x183 = f_r_x*x115
    x184 = (1/6)*q_r_x**3.0
    x185 = f_r_x*x175
    x186 = -1/6*f_r_x**3.0 + x185
    x187 = f_disc_r_z**3.0
    x188 = (1/6)*x187
    x189 = -0.5*f_disc_r_z*x176 + x188
    x190 = f_r_y*x173
    x191 = f_r_y*x175
    x192 = -f_r_y*x177 + x191
    x193 = -f_r_x*x181 + x185
    x194 = f_disc_r_z*x181
    x195 = (1/6)*q_r_y**3.0
    x196 = -1/6*f_r_y**3.0 + x191
    x197 = x188 - x194
    x198 = bar_i_vibration_rectification*rate_rate_i_sensed
    x199 = np.sin(roll)
    x200 = -bar_M_zz*x199
    x201 = np.sin(pitch)
    x202 = -bar_M_zz*x201
    x203 = -cos_yaw**2.0 + sin_yaw**2.0 + 1
    x204 = -x203
    x205 = 2.0*cos_yaw*sin_yaw
    x206 = cos_yaw - 1
    x207 = -Gamma_zz
    x208 = 2.0*Gamma_yz
    x209 = 2.0*Gamma_xz
    x210 = temperature - 293.15
    x211 = vibration_rms**2.0
    x212 = K4*vibration_axis_ix
    x213 = vibration_axis_px*x212
    x214 = K6*vibration_axis_ix
    x215 = vibration_axis_ox*x214
    x216 = K8*vibration_axis_ox
    x217 = vibration_axis_px*x216
    x218 = K2*vibration_axis_ix**2.0
    x219 = K5*vibration_axis_ox**2.0
    x220 = K7*vibration_axis_px**2.0
    x221 = vibration_axis_py*x212
    x222 = K4*vibration_axis_px
    x223 = vibration_axis_iy*x222
    x224 = vibration_axis_oy*x214
    x225 = K6*vibration_axis_ox
    x226 = vibration_axis_iy*x225
    x227 = vibration_axis_py*x216
    x228 = K8*vibration_axis_px
    x229 = vibration_axis_oy*x228
    x230 = vibration_axis_ix*x97
    x231 = vibration_axis_iy*x230
    x232 = vibration_axis_ox*x98
    x233 = vibration_axis_oy*x232
    x234 = vibration_axis_px*x99
    x235 = vibration_axis_py*x234
    x236 = vibration_axis_pz*x212
    x237 = vibration_axis_iz*x222
    x238 = vibration_axis_oz*x214
    x239 = vibration_axis_iz*x225
    x240 = vibration_axis_pz*x216
    x241 = vibration_axis_oz*x228
    x242 = vibration_axis_iz*x230
    x243 = vibration_axis_oz*x232
    x244 = vibration_axis_pz*x234
    x245 = K4*vibration_axis_iy
    x246 = vibration_axis_py*x245
    x247 = K6*vibration_axis_iy
    x248 = vibration_axis_oy*x247
    x249 = K8*vibration_axis_oy
    x250 = vibration_axis_py*x249
    x251 = K2*vibration_axis_iy**2.0
    x252 = K5*vibration_axis_oy**2.0
    x253 = K7*vibration_axis_py**2.0
    x254 = vibration_axis_pz*x245
    x255 = K4*vibration_axis_iz
    x256 = vibration_axis_py*x255
    x257 = vibration_axis_oz*x247
    x258 = K6*vibration_axis_iz
    x259 = vibration_axis_oy*x258
    x260 = vibration_axis_pz*x249
    x261 = K8*vibration_axis_oz
    x262 = vibration_axis_py*x261
    x263 = vibration_axis_iy*vibration_axis_iz*x97
    x264 = vibration_axis_oy*vibration_axis_oz*x98
    x265 = vibration_axis_py*vibration_axis_pz*x99
    x266 = vibration_axis_pz*x255
    x267 = vibration_axis_oz*x258
    x268 = vibration_axis_pz*x261
    x269 = K2*vibration_axis_iz**2.0
    x270 = K5*vibration_axis_oz**2.0
    x271 = K7*vibration_axis_pz**2.0

    D = np.empty((len(ROWS), len(time)))
    D[0] = bar_i_vibration_rectification*np.sign(i_sensed)  # adc-nonlinearity.h
    D[1] = -x136 - x137  # angular-jitter.W_xx
    D[2] = -bar_spin_axis_tilt_Gamma_xy*x135  # angular-jitter.W_xy
    D[3] = -bar_spin_axis_tilt_Gamma_xz*x135  # angular-jitter.W_xz
    D[4] = -x137 - x138  # angular-jitter.W_yy
    D[5] = -bar_spin_axis_tilt_Gamma_yz*x135  # angular-jitter.W_yz
    D[6] = -x136 - x138  # angular-jitter.W_zz
    D[7] = bar_i_vibration_rectification*(f_tau_xx*omega_x + f_tau_xy*omega_y)*(f_tau_zx*omega_x + f_tau_zy*omega_y - x106)  # anisoinertia.K_ip
    D[8] = bar_dR_arm_stretch  # arm-length.delta_R
    D[9] = b_f_zj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_zj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_zj  # arm-sag.c_z
    D[10] = b_f_yj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_yj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_yj  # arm-stretch.c_r
    D[11] = bar_rate_rate_run_out_x*rate_rate_cos_phi_true + bar_rate_run_out_x*rate_cos_phi_true + x139  # bearing-run-out.c_x1
    D[12] = bar_rate_rate_run_out_x*rate_rate_sin_phi_true + bar_rate_run_out_x*rate_sin_phi_true + bar_run_out_x*sin_phi  # bearing-run-out.s_x1
    D[13] = bar_rate_rate_run_out_y*rate_rate_cos_phi_true + bar_rate_run_out_y*rate_cos_phi_true + x140  # bearing-run-out.c_y1
    D[14] = bar_rate_rate_run_out_y*rate_rate_sin_phi_true + bar_rate_run_out_y*rate_sin_phi_true + bar_run_out_y*sin_phi  # bearing-run-out.s_y1
    D[15] = bar_rate_rate_run_out_z*rate_rate_cos_phi_true + bar_rate_run_out_z*rate_cos_phi_true + x141  # bearing-run-out.c_z1
    D[16] = bar_rate_rate_run_out_z*rate_rate_sin_phi_true + bar_rate_run_out_z*rate_sin_phi_true + bar_run_out_z*sin_phi  # bearing-run-out.s_z1
    D[17] = bar_rate_rate_run_out_x*x146 + bar_rate_run_out_x*x142 + bar_run_out_x*x145  # bearing-run-out.c_x2
    D[18] = bar_rate_rate_run_out_x*x148 + bar_rate_run_out_x*x147 + x139*x30  # bearing-run-out.s_x2
    D[19] = bar_rate_rate_run_out_y*x146 + bar_rate_run_out_y*x142 + bar_run_out_y*x145  # bearing-run-out.c_y2
    D[20] = bar_rate_rate_run_out_y*x148 + bar_rate_run_out_y*x147 + x140*x30  # bearing-run-out.s_y2
    D[21] = bar_rate_rate_run_out_z*x146 + bar_rate_run_out_z*x142 + bar_run_out_z*x145  # bearing-run-out.c_z2
    D[22] = bar_rate_rate_run_out_z*x148 + bar_rate_run_out_z*x147 + x141*x30  # bearing-run-out.s_z2
    D[23] = bar_i_vibration_rectification*time  # bias-drift.dK0_dt
    D[24] = bar_i_vibration_rectification  # bias-step.dK0
    D[25] = time*x149 + time*x150 + time*x151 + time*x152 + time*x153 + time*x154 + time*x155 + time*x156 + time*x157  # clock-drift.epsilon
    D[26] = f_f_o*x158  # cubic-cross.K_iio
    D[27] = f_f_p*x158  # cubic-cross.K_iip
    D[28] = x159*x160  # cubic-cross.K_ioo
    D[29] = f_f_o*f_f_p*x160  # cubic-cross.K_iop
    D[30] = x160*x161  # cubic-cross.K_ipp
    D[31] = bar_i_vibration_rectification*f_f_o**3.0  # cubic-cross.K_ooo
    D[32] = bar_i_vibration_rectification*f_f_p*x159  # cubic-cross.K_oop
    D[33] = bar_i_vibration_rectification*f_f_o*x161  # cubic-cross.K_opp
    D[34] = bar_i_vibration_rectification*f_f_p**3.0  # cubic-cross.K_ppp
    D[35] = bar_i_vibration_rectification*f_f_i**3.0  # cubic-input.K_iii
    D[36] = bar_f_f_x*(-d2_spin_angle*f_r_y + f_r_x*spin_xx) + bar_f_f_y*(d2_spin_angle*f_r_x + f_r_y*spin_yy) + bar_f_f_z*(f_r_x*spin_zx + f_r_y*spin_zy) + bar_q_f_x*(-d2_spin_angle*q_r_y + q_r_x*spin_xx) + bar_q_f_y*(d2_spin_angle*q_r_x + q_r_y*spin_yy) - bar_q_p_second_order_misalignment*(q_r_x*spin_zx + q_r_y*spin_zy)  # disc-spin.share
    D[37] = x162  # encoder-harmonic.c_1
    D[38] = bar_sin_delta_phi*sin_phi  # encoder-harmonic.s_1
    D[39] = bar_sin_delta_phi*x145  # encoder-harmonic.c_2
    D[40] = x162*x30  # encoder-harmonic.s_2
    D[41] = bar_sin_delta_phi*(-3.0*cos_phi*x144 + x163)  # encoder-harmonic.c_3
    D[42] = bar_sin_delta_phi*(3.0*sin_phi*x143 - x164)  # encoder-harmonic.s_3
    D[43] = bar_sin_delta_phi*(cos_phi**4.0 + sin_phi**4.0 - 6.0*x143*x144)  # encoder-harmonic.c_4
    D[44] = bar_sin_delta_phi*(x163*x38 - x164*x35)  # encoder-harmonic.s_4
    D[45] = -bar_M_xx*fuel_mass - x165  # fuel-gradient.G_xx
    D[46] = bar_spin_axis_tilt_Gamma_xy*fuel_mass  # fuel-gradient.G_xy
    D[47] = bar_spin_axis_tilt_Gamma_xz*fuel_mass  # fuel-gradient.G_xz
    D[48] = -bar_M_yy*fuel_mass - x165  # fuel-gradient.G_yy
    D[49] = bar_spin_axis_tilt_Gamma_yz*fuel_mass  # fuel-gradient.G_yz
    D[50] = time*x166  # gain-drift.dK1_dt
    D[51] = x166  # gain-step.dK1
    D[52] = -bar_M_xx - x167  # gradient-offset.G_xx
    D[53] = bar_spin_axis_tilt_Gamma_xy  # gradient-offset.G_xy
    D[54] = bar_spin_axis_tilt_Gamma_xz  # gradient-offset.G_xz
    D[55] = -bar_M_yy - x167  # gradient-offset.G_yy
    D[56] = bar_spin_axis_tilt_Gamma_yz  # gradient-offset.G_yz
    D[57] = -bar_time_offset_omega_x  # gyro-bias.b_x
    D[58] = -bar_time_offset_omega_y  # gyro-bias.b_y
    D[59] = -bar_time_offset_omega_z  # gyro-bias.b_z
    D[60] = x168  # gyro-delay.delta_w
    D[61] = x169  # gyro-delay.delta_d
    D[62] = -a_x*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_x  # gyro-g-sensitivity.d_xx
    D[63] = -a_y*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_y  # gyro-g-sensitivity.d_xy
    D[64] = -a_z*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_z  # gyro-g-sensitivity.d_xz
    D[65] = -a_x*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_x  # gyro-g-sensitivity.d_yx
    D[66] = -a_y*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_y  # gyro-g-sensitivity.d_yy
    D[67] = -a_z*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_z  # gyro-g-sensitivity.d_yz
    D[68] = -a_x*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_x  # gyro-g-sensitivity.d_zx
    D[69] = -a_y*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_y  # gyro-g-sensitivity.d_zy
    D[70] = -a_z*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_z  # gyro-g-sensitivity.d_zz
    D[71] = -bar_time_offset_omega_x*omega_x - bar_time_offset_omegadot_x*omegadot_x  # gyro-scale.s_x
    D[72] = -bar_time_offset_omega_y*omega_y - bar_time_offset_omegadot_y*omegadot_y  # gyro-scale.s_y
    D[73] = -bar_time_offset_omega_z*omega_z - bar_time_offset_omegadot_z*omegadot_z  # gyro-scale.s_z
    D[74] = -bar_time_offset_a_x  # imu-acceleration-bias.b_x
    D[75] = -bar_time_offset_a_y  # imu-acceleration-bias.b_y
    D[76] = -bar_time_offset_a_z  # imu-acceleration-bias.b_z
    D[77] = -x134  # imu-acceleration-misalignment.m_xy
    D[78] = x170  # imu-acceleration-misalignment.m_xz
    D[79] = -x130  # imu-acceleration-misalignment.m_yx
    D[80] = -x128  # imu-acceleration-misalignment.m_yz
    D[81] = -x126  # imu-acceleration-misalignment.m_zx
    D[82] = x171  # imu-acceleration-misalignment.m_zy
    D[83] = -a_x*bar_time_offset_a_x  # imu-acceleration-scale.s_x
    D[84] = -a_y*bar_time_offset_a_y  # imu-acceleration-scale.s_y
    D[85] = -a_z*bar_time_offset_a_z  # imu-acceleration-scale.s_z
    D[86] = bar_time_offset_a_x*x2 - bar_time_offset_a_y*x9 + bar_time_offset_a_z*(-x172 - x6)  # imu-lever-arm.l_x
    D[87] = bar_time_offset_a_x*(omegadot_z - x4) + bar_time_offset_a_y*x12 - bar_time_offset_a_z*x17  # imu-lever-arm.l_y
    D[88] = -bar_time_offset_a_x*x7 + bar_time_offset_a_y*(omegadot_x - x14) + bar_time_offset_a_z*x19  # imu-lever-arm.l_z
    D[89] = -bar_imu_turn_yz + bar_imu_turn_zy  # imu-misalignment.e_x
    D[90] = bar_imu_turn_xz - bar_imu_turn_zx  # imu-misalignment.e_y
    D[91] = -bar_imu_turn_xy + bar_imu_turn_yx  # imu-misalignment.e_z
    D[92] = -bar_i_vibration_rectification*rate_f_f_i  # lag.tau
    D[93] = bar_i_vibration_rectification*(B_x*x103 + B_y*x104 + B_z*x105)  # magnetic-bias.dK0_dB
    D[94] = b_f_xj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yx
    D[95] = b_f_yj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yy
    D[96] = b_f_zj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yz
    D[97] = b_f_xj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zx
    D[98] = b_f_yj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zy
    D[99] = b_f_zj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zz
    D[100] = bar_f_f_x*x178 - bar_q_f_x*x174 + x173  # near-mass.T_xxx
    D[101] = bar_f_f_y*x178 + bar_f_f_z*f_disc_r_z*f_r_y - bar_q_f_y*x174 - f_r_x*x120 - q_r_x*x121  # near-mass.T_xxy
    D[102] = bar_f_f_z*x178 + bar_q_p_second_order_misalignment*x174 - x179  # near-mass.T_xxz
    D[103] = bar_f_f_x*x182 + bar_f_f_z*f_disc_r_z*f_r_x - bar_q_f_x*x180 - f_r_x*x116 - q_r_x*x117  # near-mass.T_xyy
    D[104] = bar_q_p_second_order_misalignment*q_r_x*q_r_y - f_r_x*x112 - f_r_y*x119 - x183  # near-mass.T_xyz
    D[105] = bar_f_f_y*x182 - bar_q_f_y*x180 + f_r_y*x111  # near-mass.T_yyy
    D[106] = bar_f_f_z*x182 + bar_q_p_second_order_misalignment*x180 - f_r_y*x115  # near-mass.T_yyz
    D[107] = bar_f_f_x*x186 - bar_f_f_z*x189 - bar_q_f_x*x184  # near-mass.T_xxxx
    D[108] = bar_f_f_x*x192 + bar_f_f_y*x186 - bar_q_f_y*x184 - x121*x174 + x190  # near-mass.T_xxxy
    D[109] = bar_f_f_x*x189 + bar_f_f_z*x186 + bar_q_p_second_order_misalignment*x184  # near-mass.T_xxxz
    D[110] = bar_f_f_x*x193 + bar_f_f_y*x192 + bar_f_f_z*(f_disc_r_z*x177 - 1/3*x187 + x194) - x117*x174 - x122*x180  # near-mass.T_xxyy
    D[111] = bar_f_f_y*x189 + bar_f_f_z*x192 - f_r_y*x179 + x113*x174  # near-mass.T_xxyz
    D[112] = bar_f_f_x*x196 + bar_f_f_y*x193 - bar_q_f_x*x195 - x118*x180 + x190  # near-mass.T_xyyy
    D[113] = bar_f_f_x*x197 + bar_f_f_z*x193 - f_r_y*x183 + x114*x180  # near-mass.T_xyyz
    D[114] = bar_f_f_y*x196 - bar_f_f_z*x197 - bar_q_f_y*x195  # near-mass.T_yyyy
    D[115] = bar_f_f_y*x197 + bar_f_f_z*x196 + bar_q_p_second_order_misalignment*x195  # near-mass.T_yyyz
    D[116] = x160*np.abs(f_f_i)  # odd-quadratic.K_oq
    D[117] = x198  # output-filter.b
    D[118] = bar_i_vibration_rectification*i_sensed  # output-gain-step.g
    D[119] = bar_i_vibration_rectification*(-beta_x*(d2_spin_angle + omegadot_z) + f_tau_yx*(omegadot_x + x43) + f_tau_yy*(-x172 - x42))  # pendulum-angular.K_pa
    D[120] = bar_i_vibration_rectification*(pressure - 101325)  # pressure-bias.dK0_dp
    D[121] = x198  # second-order-loop.b
    D[122] = bar_q_i_second_order_misalignment*(f_f_i - q_f_xj) + bar_q_o_second_order_misalignment*(f_f_o - q_f_yj) + bar_q_p_second_order_misalignment*(f_f_p + q_f_z)  # second-order-misalignment.kappa
    D[123] = -bar_M_xx*x199 - x200  # self-gradient.G_xx_roll
    D[124] = bar_spin_axis_tilt_Gamma_xy*x199  # self-gradient.G_xy_roll
    D[125] = bar_spin_axis_tilt_Gamma_xz*x199  # self-gradient.G_xz_roll
    D[126] = -bar_M_yy*x199 - x200  # self-gradient.G_yy_roll
    D[127] = bar_spin_axis_tilt_Gamma_yz*x199  # self-gradient.G_yz_roll
    D[128] = -bar_M_xx*x201 - x202  # self-gradient.G_xx_pitch
    D[129] = bar_spin_axis_tilt_Gamma_xy*x201  # self-gradient.G_xy_pitch
    D[130] = bar_spin_axis_tilt_Gamma_xz*x201  # self-gradient.G_xz_pitch
    D[131] = -bar_M_yy*x201 - x202  # self-gradient.G_yy_pitch
    D[132] = bar_spin_axis_tilt_Gamma_yz*x201  # self-gradient.G_yz_pitch
    D[133] = -bar_M_xx*x204 - bar_M_yy*x203 + 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw  # self-gradient-yaw.G_d
    D[134] = bar_M_xx*x205 - bar_M_yy*x205 + bar_spin_axis_tilt_Gamma_xy*x204  # self-gradient-yaw.G_xy
    D[135] = bar_spin_axis_tilt_Gamma_xz*x206 + bar_spin_axis_tilt_Gamma_yz*sin_yaw  # self-gradient-yaw.G_xz
    D[136] = -bar_spin_axis_tilt_Gamma_xz*sin_yaw + bar_spin_axis_tilt_Gamma_yz*x206  # self-gradient-yaw.G_yz
    D[137] = -Gamma_xy*bar_spin_axis_tilt_Gamma_xz + Gamma_xz*bar_spin_axis_tilt_Gamma_xy - bar_M_yy*x208 + bar_M_zz*x208 + bar_spin_axis_tilt_Gamma_yz*(-Gamma_yy - x207) - x124 - x125 + x129 + x171  # spin-axis-tilt.alpha_x
    D[138] = Gamma_xy*bar_spin_axis_tilt_Gamma_yz - Gamma_yz*bar_spin_axis_tilt_Gamma_xy + bar_M_xx*x209 - bar_M_zz*x209 + bar_spin_axis_tilt_Gamma_xz*(Gamma_xx + x207) + x127 - x132 - x133 + x170  # spin-axis-tilt.alpha_y
    D[139] = bar_wobble_xz*sin_phi - bar_wobble_yz*cos_phi - bar_wobble_zx*sin_phi + bar_wobble_zy*cos_phi  # spin-axis-wobble.w_x
    D[140] = bar_wobble_xz*cos_phi + bar_wobble_yz*sin_phi - bar_wobble_zx*cos_phi - bar_wobble_zy*sin_phi  # spin-axis-wobble.w_y
    D[141] = bar_sin_delta_phi  # spin-phase-offset.phi_0
    D[142] = bar_sin_delta_phi  # spin-rate-jitter.sigma_phi
    D[143] = bar_sin_delta_phi  # spin-rate-jitter.sigma_walk
    D[144] = 2.0*bar_sin_delta_phi*time*x31  # spin-rate-offset.epsilon
    D[145] = -bar_sin_delta_phi*omegadot_z  # spin-servo.c
    D[146] = bar_i_vibration_rectification*x210  # thermal-bias.dK0_dT
    D[147] = bar_i_vibration_rectification*d_temperature  # thermal-lag.dK0_dTdot
    D[148] = d_temperature*x166  # thermal-lag.dK1_dTdot
    D[149] = x166*x210  # thermal-scale.dK1_dT
    D[150] = x149 + x150 + x151 + x168 + x169  # time-offset.delta_t
    D[151] = bar_i_vibration_rectification*(x211*x213 + x211*x215 + x211*x217 + x211*x218 + x211*x219 + x211*x220)  # vibration-level.L_xx
    D[152] = bar_i_vibration_rectification*(x211*x221 + x211*x223 + x211*x224 + x211*x226 + x211*x227 + x211*x229 + x211*x231 + x211*x233 + x211*x235)  # vibration-level.L_xy
    D[153] = bar_i_vibration_rectification*(x211*x236 + x211*x237 + x211*x238 + x211*x239 + x211*x240 + x211*x241 + x211*x242 + x211*x243 + x211*x244)  # vibration-level.L_xz
    D[154] = bar_i_vibration_rectification*(x211*x246 + x211*x248 + x211*x250 + x211*x251 + x211*x252 + x211*x253)  # vibration-level.L_yy
    D[155] = bar_i_vibration_rectification*(x211*x254 + x211*x256 + x211*x257 + x211*x259 + x211*x260 + x211*x262 + x211*x263 + x211*x264 + x211*x265)  # vibration-level.L_yz
    D[156] = bar_i_vibration_rectification*(x211*x266 + x211*x267 + x211*x268 + x211*x269 + x211*x270 + x211*x271)  # vibration-level.L_zz
    D[157] = bar_i_vibration_rectification*(x213 + x215 + x217 + x218 + x219 + x220)  # vibration-rectification.P_xx
    D[158] = bar_i_vibration_rectification*(x221 + x223 + x224 + x226 + x227 + x229 + x231 + x233 + x235)  # vibration-rectification.P_xy
    D[159] = bar_i_vibration_rectification*(x236 + x237 + x238 + x239 + x240 + x241 + x242 + x243 + x244)  # vibration-rectification.P_xz
    D[160] = bar_i_vibration_rectification*(x246 + x248 + x250 + x251 + x252 + x253)  # vibration-rectification.P_yy
    D[161] = bar_i_vibration_rectification*(x254 + x256 + x257 + x259 + x260 + x262 + x263 + x264 + x265)  # vibration-rectification.P_yz
    D[162] = bar_i_vibration_rectification*(x266 + x267 + x268 + x269 + x270 + x271)  # vibration-rectification.P_zz
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
