"""Signatures: what each candidate effect would add to V_j.

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: anisoinertia, arm-sag, arm-stretch, bias-drift, bias-step, clock-drift, cubic-cross, cubic-input, encoder-harmonic, gain-drift, gain-step, gradient-offset, gyro-bias, gyro-delay, gyro-g-sensitivity, gyro-scale, imu-acceleration-bias, imu-acceleration-misalignment, imu-acceleration-scale, imu-lever-arm, imu-misalignment, lag, magnetic-bias, mount-compliance, near-mass, odd-quadratic, output-filter, output-gain-step, pendulum-angular, pressure-bias, second-order-misalignment, self-gradient, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, spin-rate-offset, thermal-bias, thermal-lag, thermal-scale, time-offset, vibration-rectification.
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
    "pitch",
    "pressure",
    "roll",
    "temperature",
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
    ("anisoinertia.K_ip", False),
    ("arm-sag.c_z", False),
    ("arm-stretch.c_r", False),
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
    ("encoder-harmonic.c_1", True),
    ("encoder-harmonic.s_1", True),
    ("encoder-harmonic.c_2", True),
    ("encoder-harmonic.s_2", True),
    ("encoder-harmonic.c_3", True),
    ("encoder-harmonic.s_3", True),
    ("encoder-harmonic.c_4", True),
    ("encoder-harmonic.s_4", True),
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
    ("spin-axis-tilt.alpha_x", True),
    ("spin-axis-tilt.alpha_y", True),
    ("spin-axis-wobble.w_x", True),
    ("spin-axis-wobble.w_y", True),
    ("spin-phase-offset.phi_0", True),
    ("spin-rate-jitter.sigma_phi", True),
    ("spin-rate-jitter.sigma_walk", True),
    ("spin-rate-offset.epsilon", True),
    ("thermal-bias.dK0_dT", False),
    ("thermal-lag.dK0_dTdot", False),
    ("thermal-lag.dK1_dTdot", False),
    ("thermal-scale.dK1_dT", False),
    ("time-offset.delta_t", True),
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
    d2_spin_angle = inputs[24]
    d_spin_angle = inputs[31]
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
    d2_a_x = inputs[18]
    d2_a_y = inputs[19]
    d2_a_z = inputs[20]
    d2_omegadot_x = inputs[21]
    d2_omegadot_y = inputs[22]
    d2_omegadot_z = inputs[23]
    d2_spin_angle = inputs[24]
    d_a_x = inputs[25]
    d_a_y = inputs[26]
    d_a_z = inputs[27]
    d_omegadot_x = inputs[28]
    d_omegadot_y = inputs[29]
    d_omegadot_z = inputs[30]
    d_spin_angle = inputs[31]
    d_temperature = inputs[32]
    pitch = inputs[33]
    pressure = inputs[34]
    roll = inputs[35]
    temperature = inputs[36]
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
    x0 = omega_y**2.0
    x1 = d_spin_angle + omega_z
    x2 = -x1
    x3 = -x1*x2
    M_xx = -Gamma_xx - x0 - x3
    x4 = omega_x*omega_y
    x5 = d2_spin_angle + omegadot_z
    M_xy = -Gamma_xy + x4 - x5
    x6 = -omegadot_y
    x7 = d_spin_angle*omega_x
    x8 = x6 + x7
    M_xz = -Gamma_xz - omega_x*x2 - x8
    x9 = omegadot_z + x4
    M_yx = -Gamma_xy + d2_spin_angle + x9
    x10 = omega_x**2.0
    M_yy = -Gamma_yy - x10 - x3
    x11 = d_spin_angle*omega_y
    x12 = omegadot_x + x11
    M_yz = -Gamma_yz + omega_y*x1 - x12
    M_zx = -Gamma_xz + omega_x*x1 - omegadot_y + x7
    x13 = -omegadot_x
    M_zy = -Gamma_yz - omega_y*x2 + x11 - x13
    x14 = x0 + x10
    M_zz = -Gamma_zz - x14
    cos_psi = cos_j*cos_phi - sin_j*sin_phi
    sin_psi = cos_j*sin_phi + cos_phi*sin_j
    x15 = dR + radius
    b_disc_r_x = x15
    x16 = beta_z*x15
    b_disc_r_y = x16
    x17 = beta_x*x15
    b_disc_r_z = x17
    x18 = -beta_x*beta_z
    b_disc_tau_zy = x18
    b_r_x = b_disc_r_x*cos_psi - b_disc_r_y*sin_psi
    b_r_y = b_disc_r_x*sin_psi + b_disc_r_y*cos_psi
    x19 = beta_z*cos_psi + sin_psi
    x20 = -x19
    b_tau_xx = x20
    x21 = -beta_z*sin_psi + cos_psi
    b_tau_xy = x21
    b_tau_yx = x21
    b_tau_yy = x19
    x22 = beta_x*cos_psi
    b_tau_zx = -b_disc_tau_zy*sin_psi - x22
    x23 = beta_x*sin_psi
    b_tau_zy = b_disc_tau_zy*cos_psi - x23
    b_f_x = M_xx*b_r_x + M_xy*b_r_y + M_xz*b_disc_r_z + a_x
    b_f_y = M_yx*b_r_x + M_yy*b_r_y + M_yz*b_disc_r_z + a_y
    b_f_z = M_zx*b_r_x + M_zy*b_r_y + M_zz*b_disc_r_z + a_z
    b_f_xj = b_f_x*b_tau_xx + b_f_y*b_tau_xy
    b_f_yj = b_f_x*b_tau_yx + b_f_y*b_tau_yy - b_f_z*beta_x
    b_f_zj = b_f_x*b_tau_zx + b_f_y*b_tau_zy - b_f_z
    f_disc_r_x = x15
    f_disc_r_y = x16
    f_disc_r_z = x17
    f_disc_tau_zy = x18
    f_r_x = cos_psi*f_disc_r_x - f_disc_r_y*sin_psi
    f_r_y = cos_psi*f_disc_r_y + f_disc_r_x*sin_psi
    f_tau_xx = x20
    f_tau_xy = x21
    f_tau_yx = x21
    f_tau_yy = x19
    f_tau_zx = -f_disc_tau_zy*sin_psi - x22
    f_tau_zy = cos_psi*f_disc_tau_zy - x23
    x24 = x15**(-1.0)
    f_arm_x = f_r_x*x24
    f_arm_y = f_r_y*x24
    f_arm_z = f_disc_r_z*x24
    x25 = 2.0*omega_y
    x26 = omegadot_y*x25
    x27 = 2.0*d_spin_angle
    x28 = -2.0*omega_z - x27
    x29 = d2_spin_angle*x28 + omegadot_z*x28
    x30 = -x26 + x29
    rate_M_xx = x30
    x31 = omega_x*omegadot_y + omega_y*omegadot_x
    x32 = -d_omegadot_z + x31
    rate_M_xy = x32
    x33 = omega_x*omegadot_z
    x34 = d_omegadot_y + omega_z*omegadot_x + x33
    rate_M_xz = x34
    x35 = d_spin_angle*sin_phi
    x36 = -x35
    rate_cos_phi_true = x36
    x37 = cos_phi*d_spin_angle
    rate_sin_phi_true = x37
    rate_cos_psi = cos_j*rate_cos_phi_true - rate_sin_phi_true*sin_j
    rate_sin_psi = cos_j*rate_sin_phi_true + rate_cos_phi_true*sin_j
    rate_b_r_x = b_disc_r_x*rate_cos_psi - b_disc_r_y*rate_sin_psi
    rate_b_r_y = b_disc_r_x*rate_sin_psi + b_disc_r_y*rate_cos_psi
    rate_b_f_x = M_xx*rate_b_r_x + M_xy*rate_b_r_y + b_disc_r_z*rate_M_xz + b_r_x*rate_M_xx + b_r_y*rate_M_xy + d_a_x
    x38 = d_omegadot_z + x31
    rate_M_yx = x38
    x39 = 2.0*omegadot_x
    x40 = omega_x*x39
    x41 = x29 - x40
    rate_M_yy = x41
    x42 = omega_y*omegadot_z
    x43 = -d_omegadot_x + omega_z*omegadot_y + x42
    rate_M_yz = x43
    rate_b_f_y = M_yx*rate_b_r_x + M_yy*rate_b_r_y + b_disc_r_z*rate_M_yz + b_r_x*rate_M_yx + b_r_y*rate_M_yy + d_a_y
    x44 = 2.0*d2_spin_angle
    x45 = omega_z + x27
    x46 = -d_omegadot_y + omega_x*x44 + omegadot_x*x45 + x33
    rate_M_zx = x46
    x47 = d_omegadot_x + omega_y*x44 + omegadot_y*x45 + x42
    rate_M_zy = x47
    x48 = -x26 - x40
    rate_M_zz = x48
    rate_b_f_z = M_zx*rate_b_r_x + M_zy*rate_b_r_y + b_disc_r_z*rate_M_zz + b_r_x*rate_M_zx + b_r_y*rate_M_zy + d_a_z
    rate_b_tau_yx = -beta_z*rate_sin_psi + rate_cos_psi
    rate_b_tau_yy = beta_z*rate_cos_psi + rate_sin_psi
    rate_b_f_yj = b_f_x*rate_b_tau_yx + b_f_y*rate_b_tau_yy + b_tau_yx*rate_b_f_x + b_tau_yy*rate_b_f_y - beta_x*rate_b_f_z
    rate_b_tau_zx = -b_disc_tau_zy*rate_sin_psi - beta_x*rate_cos_psi
    rate_b_tau_zy = b_disc_tau_zy*rate_cos_psi - beta_x*rate_sin_psi
    rate_b_f_zj = b_f_x*rate_b_tau_zx + b_f_y*rate_b_tau_zy + b_tau_zx*rate_b_f_x + b_tau_zy*rate_b_f_y - rate_b_f_z
    x49 = 2.0*omegadot_y**2.0
    x50 = d_omegadot_y*x25
    x51 = 2.0*omegadot_z
    x52 = -x44 - x51
    x53 = d2_spin_angle*x52 + d_omegadot_z*x28 + omegadot_z*x52
    x54 = -x49 - x50 + x53
    rate_rate_M_xx = x54
    x55 = d_omegadot_x*omega_y + d_omegadot_y*omega_x + omegadot_y*x39
    x56 = -d2_omegadot_z + x55
    rate_rate_M_xy = x56
    x57 = d_omegadot_z*omega_x
    x58 = d2_omegadot_y + d_omegadot_x*omega_z + omegadot_x*x51 + x57
    rate_rate_M_xz = x58
    x59 = d2_spin_angle*sin_phi
    x60 = d_spin_angle**2.0
    x61 = cos_phi*x60
    x62 = -x59 - x61
    rate_rate_cos_phi_true = x62
    x63 = cos_phi*d2_spin_angle
    x64 = sin_phi*x60
    x65 = x63 - x64
    rate_rate_sin_phi_true = x65
    rate_rate_cos_psi = cos_j*rate_rate_cos_phi_true - rate_rate_sin_phi_true*sin_j
    rate_rate_sin_psi = cos_j*rate_rate_sin_phi_true + rate_rate_cos_phi_true*sin_j
    rate_rate_b_r_x = b_disc_r_x*rate_rate_cos_psi - b_disc_r_y*rate_rate_sin_psi
    rate_rate_b_r_y = b_disc_r_x*rate_rate_sin_psi + b_disc_r_y*rate_rate_cos_psi
    x66 = 2.0*rate_b_r_x
    x67 = 2.0*rate_b_r_y
    rate_rate_b_f_x = M_xx*rate_rate_b_r_x + M_xy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_xz + b_r_x*rate_rate_M_xx + b_r_y*rate_rate_M_xy + d2_a_x + rate_M_xx*x66 + rate_M_xy*x67
    x68 = d2_omegadot_z + x55
    rate_rate_M_yx = x68
    x69 = 2.0*omegadot_x**2.0
    x70 = 2.0*omega_x
    x71 = d_omegadot_x*x70
    x72 = x53 - x69 - x71
    rate_rate_M_yy = x72
    x73 = d_omegadot_z*omega_y
    x74 = -d2_omegadot_x + d_omegadot_y*omega_z + omegadot_y*x51 + x73
    rate_rate_M_yz = x74
    rate_rate_b_f_y = M_yx*rate_rate_b_r_x + M_yy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_yz + b_r_x*rate_rate_M_yx + b_r_y*rate_rate_M_yy + d2_a_y + rate_M_yx*x66 + rate_M_yy*x67
    x75 = omegadot_z + x44
    x76 = -d2_omegadot_y + d_omegadot_x*x45 + omegadot_x*omegadot_z + omegadot_x*x44 + omegadot_x*x75 + x57
    rate_rate_M_zx = x76
    x77 = d2_omegadot_x + d_omegadot_y*x45 + omegadot_y*omegadot_z + omegadot_y*x44 + omegadot_y*x75 + x73
    rate_rate_M_zy = x77
    x78 = -x49 - x50 - x69 - x71
    rate_rate_M_zz = x78
    rate_rate_b_f_z = M_zx*rate_rate_b_r_x + M_zy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_zz + b_r_x*rate_rate_M_zx + b_r_y*rate_rate_M_zy + d2_a_z + rate_M_zx*x66 + rate_M_zy*x67
    rate_rate_b_tau_yx = -beta_z*rate_rate_sin_psi + rate_rate_cos_psi
    rate_rate_b_tau_yy = beta_z*rate_rate_cos_psi + rate_rate_sin_psi
    x79 = 2.0*rate_b_f_x
    x80 = 2.0*rate_b_f_y
    rate_rate_b_f_yj = b_f_x*rate_rate_b_tau_yx + b_f_y*rate_rate_b_tau_yy + b_tau_yx*rate_rate_b_f_x + b_tau_yy*rate_rate_b_f_y - beta_x*rate_rate_b_f_z + rate_b_tau_yx*x79 + rate_b_tau_yy*x80
    rate_rate_b_tau_zx = -b_disc_tau_zy*rate_rate_sin_psi - beta_x*rate_rate_cos_psi
    rate_rate_b_tau_zy = b_disc_tau_zy*rate_rate_cos_psi - beta_x*rate_rate_sin_psi
    rate_rate_b_f_zj = b_f_x*rate_rate_b_tau_zx + b_f_y*rate_rate_b_tau_zy + b_tau_zx*rate_rate_b_f_x + b_tau_zy*rate_rate_b_f_y + rate_b_tau_zx*x79 + rate_b_tau_zy*x80 - rate_rate_b_f_z
    f_f_x = M_xx*f_r_x + M_xy*f_r_y + M_xz*f_disc_r_z + a_x
    f_f_y = M_yx*f_r_x + M_yy*f_r_y + M_yz*f_disc_r_z + a_y
    f_f_z = M_zx*f_r_x + M_zy*f_r_y + M_zz*f_disc_r_z + a_z
    f_f_xj = f_f_x*f_tau_xx + f_f_y*f_tau_xy
    f_f_yj = -beta_x*f_f_z + f_f_x*f_tau_yx + f_f_y*f_tau_yy
    f_f_zj = f_f_x*f_tau_zx + f_f_y*f_tau_zy - f_f_z
    f_f_i = f_f_xj + f_f_yj*vartheta_z - f_f_zj*vartheta_y
    f_f_o = -f_f_xj*vartheta_z + f_f_yj + f_f_zj*vartheta_x
    f_f_p = f_f_xj*vartheta_y - f_f_yj*vartheta_x + f_f_zj
    q_disc_r_x = x15
    q_r_x = cos_psi*q_disc_r_x
    q_r_y = q_disc_r_x*sin_psi
    q_arm_x = q_r_x*x24
    q_arm_y = q_r_y*x24
    q_f_x = M_xx*q_r_x + M_xy*q_r_y + a_x
    q_f_y = M_yx*q_r_x + M_yy*q_r_y + a_y
    q_f_z = M_zx*q_r_x + M_zy*q_r_y + a_z
    q_f_xj = cos_psi*q_f_y - q_f_x*sin_psi
    q_f_yj = cos_psi*q_f_x + q_f_y*sin_psi
    x81 = K6*q_f_yj
    x82 = K4*q_f_z
    x83 = K8*q_f_z
    i_sensed = K0 + K2*q_f_xj**2.0 + K5*q_f_yj**2.0 + K7*q_f_z**2.0 + f_f_i + q_f_xj*x81 - q_f_xj*x82 - q_f_yj*x83
    V2__rate_M_xx = x30
    V2__rate_M_xy = x32
    V2__rate_M_xz = x34
    V2__rate_cos_phi_true = x36
    V2__rate_sin_phi_true = x37
    V2__rate_cos_psi = V2__rate_cos_phi_true*cos_j - V2__rate_sin_phi_true*sin_j
    V2__rate_sin_psi = V2__rate_cos_phi_true*sin_j + V2__rate_sin_phi_true*cos_j
    rate_f_r_x = V2__rate_cos_psi*f_disc_r_x - V2__rate_sin_psi*f_disc_r_y
    rate_f_r_y = V2__rate_cos_psi*f_disc_r_y + V2__rate_sin_psi*f_disc_r_x
    rate_f_f_x = M_xx*rate_f_r_x + M_xy*rate_f_r_y + V2__rate_M_xx*f_r_x + V2__rate_M_xy*f_r_y + V2__rate_M_xz*f_disc_r_z + d_a_x
    V2__rate_M_yx = x38
    V2__rate_M_yy = x41
    V2__rate_M_yz = x43
    rate_f_f_y = M_yx*rate_f_r_x + M_yy*rate_f_r_y + V2__rate_M_yx*f_r_x + V2__rate_M_yy*f_r_y + V2__rate_M_yz*f_disc_r_z + d_a_y
    x84 = V2__rate_cos_psi*beta_z + V2__rate_sin_psi
    rate_f_tau_xx = -x84
    x85 = V2__rate_cos_psi - V2__rate_sin_psi*beta_z
    rate_f_tau_xy = x85
    rate_f_f_xj = f_f_x*rate_f_tau_xx + f_f_y*rate_f_tau_xy + f_tau_xx*rate_f_f_x + f_tau_xy*rate_f_f_y
    V2__rate_M_zx = x46
    V2__rate_M_zy = x47
    V2__rate_M_zz = x48
    rate_f_f_z = M_zx*rate_f_r_x + M_zy*rate_f_r_y + V2__rate_M_zx*f_r_x + V2__rate_M_zy*f_r_y + V2__rate_M_zz*f_disc_r_z + d_a_z
    rate_f_tau_yx = x85
    rate_f_tau_yy = x84
    rate_f_f_yj = -beta_x*rate_f_f_z + f_f_x*rate_f_tau_yx + f_f_y*rate_f_tau_yy + f_tau_yx*rate_f_f_x + f_tau_yy*rate_f_f_y
    rate_f_tau_zx = -V2__rate_cos_psi*beta_x - V2__rate_sin_psi*f_disc_tau_zy
    rate_f_tau_zy = V2__rate_cos_psi*f_disc_tau_zy - V2__rate_sin_psi*beta_x
    rate_f_f_zj = f_f_x*rate_f_tau_zx + f_f_y*rate_f_tau_zy + f_tau_zx*rate_f_f_x + f_tau_zy*rate_f_f_y - rate_f_f_z
    rate_f_f_i = rate_f_f_xj + rate_f_f_yj*vartheta_z - rate_f_f_zj*vartheta_y
    rate_V2__rate_M_xx = x54
    rate_V2__rate_M_xy = x56
    rate_V2__rate_M_xz = x58
    rate_V2__rate_cos_phi_true = x62
    rate_V2__rate_sin_phi_true = x65
    rate_V2__rate_cos_psi = cos_j*rate_V2__rate_cos_phi_true - rate_V2__rate_sin_phi_true*sin_j
    rate_V2__rate_sin_psi = cos_j*rate_V2__rate_sin_phi_true + rate_V2__rate_cos_phi_true*sin_j
    rate_rate_f_r_x = f_disc_r_x*rate_V2__rate_cos_psi - f_disc_r_y*rate_V2__rate_sin_psi
    rate_rate_f_r_y = f_disc_r_x*rate_V2__rate_sin_psi + f_disc_r_y*rate_V2__rate_cos_psi
    x86 = 2.0*rate_f_r_x
    x87 = 2.0*rate_f_r_y
    rate_rate_f_f_x = M_xx*rate_rate_f_r_x + M_xy*rate_rate_f_r_y + V2__rate_M_xx*x86 + V2__rate_M_xy*x87 + d2_a_x + f_disc_r_z*rate_V2__rate_M_xz + f_r_x*rate_V2__rate_M_xx + f_r_y*rate_V2__rate_M_xy
    rate_V2__rate_M_yx = x68
    rate_V2__rate_M_yy = x72
    rate_V2__rate_M_yz = x74
    rate_rate_f_f_y = M_yx*rate_rate_f_r_x + M_yy*rate_rate_f_r_y + V2__rate_M_yx*x86 + V2__rate_M_yy*x87 + d2_a_y + f_disc_r_z*rate_V2__rate_M_yz + f_r_x*rate_V2__rate_M_yx + f_r_y*rate_V2__rate_M_yy
    x88 = beta_z*rate_V2__rate_cos_psi + rate_V2__rate_sin_psi
    rate_rate_f_tau_xx = -x88
    x89 = -beta_z*rate_V2__rate_sin_psi + rate_V2__rate_cos_psi
    rate_rate_f_tau_xy = x89
    x90 = 2.0*rate_f_f_x
    x91 = 2.0*rate_f_f_y
    rate_rate_f_f_xj = f_f_x*rate_rate_f_tau_xx + f_f_y*rate_rate_f_tau_xy + f_tau_xx*rate_rate_f_f_x + f_tau_xy*rate_rate_f_f_y + rate_f_tau_xx*x90 + rate_f_tau_xy*x91
    rate_V2__rate_M_zx = x76
    rate_V2__rate_M_zy = x77
    rate_V2__rate_M_zz = x78
    rate_rate_f_f_z = M_zx*rate_rate_f_r_x + M_zy*rate_rate_f_r_y + V2__rate_M_zx*x86 + V2__rate_M_zy*x87 + d2_a_z + f_disc_r_z*rate_V2__rate_M_zz + f_r_x*rate_V2__rate_M_zx + f_r_y*rate_V2__rate_M_zy
    rate_rate_f_tau_yx = x89
    rate_rate_f_tau_yy = x88
    rate_rate_f_f_yj = -beta_x*rate_rate_f_f_z + f_f_x*rate_rate_f_tau_yx + f_f_y*rate_rate_f_tau_yy + f_tau_yx*rate_rate_f_f_x + f_tau_yy*rate_rate_f_f_y + rate_f_tau_yx*x90 + rate_f_tau_yy*x91
    rate_rate_f_tau_zx = -beta_x*rate_V2__rate_cos_psi - f_disc_tau_zy*rate_V2__rate_sin_psi
    rate_rate_f_tau_zy = -beta_x*rate_V2__rate_sin_psi + f_disc_tau_zy*rate_V2__rate_cos_psi
    rate_rate_f_f_zj = f_f_x*rate_rate_f_tau_zx + f_f_y*rate_rate_f_tau_zy + f_tau_zx*rate_rate_f_f_x + f_tau_zy*rate_rate_f_f_y + rate_f_tau_zx*x90 + rate_f_tau_zy*x91 - rate_rate_f_f_z
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
    x92 = 2.0*rate_q_r_x
    x93 = 2.0*rate_q_r_y
    rate_rate_q_f_x = M_xx*rate_rate_q_r_x + M_xy*rate_rate_q_r_y + V2__rate_M_xx*x92 + V2__rate_M_xy*x93 + d2_a_x + q_r_x*rate_V2__rate_M_xx + q_r_y*rate_V2__rate_M_xy
    rate_rate_q_f_y = M_yx*rate_rate_q_r_x + M_yy*rate_rate_q_r_y + V2__rate_M_yx*x92 + V2__rate_M_yy*x93 + d2_a_y + q_r_x*rate_V2__rate_M_yx + q_r_y*rate_V2__rate_M_yy
    x94 = 2.0*rate_q_f_y
    x95 = 2.0*rate_q_f_x
    rate_rate_q_f_xj = V2__rate_cos_psi*x94 - V2__rate_sin_psi*x95 + cos_psi*rate_rate_q_f_y - q_f_x*rate_V2__rate_sin_psi + q_f_y*rate_V2__rate_cos_psi - rate_rate_q_f_x*sin_psi
    rate_rate_q_f_yj = V2__rate_cos_psi*x95 + V2__rate_sin_psi*x94 + cos_psi*rate_rate_q_f_x + q_f_x*rate_V2__rate_cos_psi + q_f_y*rate_V2__rate_sin_psi + rate_rate_q_f_y*sin_psi
    rate_rate_q_f_z = M_zx*rate_rate_q_r_x + M_zy*rate_rate_q_r_y + V2__rate_M_zx*x92 + V2__rate_M_zy*x93 + d2_a_z + q_r_x*rate_V2__rate_M_zx + q_r_y*rate_V2__rate_M_zy
    x97 = 2.0*K5
    x100 = K6*q_f_xj + q_f_yj*x97 - x83
    x98 = 2.0*K7
    x101 = K4*q_f_xj + K8*q_f_yj - q_f_z*x98
    x96 = 2.0*K2
    x99 = q_f_xj*x96 + x81 - x82
    rate_rate_i_sensed = rate_q_f_xj*(-K4*rate_q_f_z + K6*rate_q_f_yj + rate_q_f_xj*x96) + rate_q_f_yj*(K6*rate_q_f_xj - K8*rate_q_f_z + rate_q_f_yj*x97) - rate_q_f_z*(K4*rate_q_f_xj + K8*rate_q_f_yj - rate_q_f_z*x98) + rate_rate_f_f_i + rate_rate_q_f_xj*x99 + rate_rate_q_f_yj*x100 - rate_rate_q_f_z*x101
    x102 = f_tau_xx + f_tau_yx*vartheta_z - f_tau_zx*vartheta_y
    vibration_axis_ix = x102
    x103 = f_tau_xy + f_tau_yy*vartheta_z - f_tau_zy*vartheta_y
    vibration_axis_iy = x103
    x104 = -beta_x*vartheta_z + vartheta_y
    vibration_axis_iz = x104
    vibration_axis_ox = -f_tau_xx*vartheta_z + f_tau_yx + f_tau_zx*vartheta_x
    vibration_axis_oy = -f_tau_xy*vartheta_z + f_tau_yy + f_tau_zy*vartheta_x
    vibration_axis_oz = -beta_x - vartheta_x
    vibration_axis_px = f_tau_xx*vartheta_y - f_tau_yx*vartheta_x + f_tau_zx
    vibration_axis_py = f_tau_xy*vartheta_y - f_tau_yy*vartheta_x + f_tau_zy
    vibration_axis_pz = beta_x*vartheta_x - 1
    bar_i_vibration_rectification = K1*k_VI
    bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x101
    bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x100
    bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x99
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
    x105 = 2.0*x1
    bar_rate_dR_arm_stretch = bar_f_f_x*(-f_arm_y*x105 + 2.0*f_arm_z*omega_y) + bar_f_f_y*(f_arm_x*x105 - f_arm_z*x70) + bar_f_f_z*(-f_arm_x*x25 + 2.0*f_arm_y*omega_x) - bar_q_f_x*q_arm_y*x105 + bar_q_f_y*q_arm_x*x105 - bar_q_p_second_order_misalignment*(-q_arm_x*x25 + q_arm_y*x70)
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
    bar_wobble_zy = bar_f_spin_axis_wobble_r_z*f_r_y + bar_f_spin_axis_wobble_tau_xz*f_tau_xy + bar_f_spin_axis_wobble_tau_yz*f_tau_yy + bar_f_spin_axis_wobble_tau_zz*f_tau_zy + bar_q_spin_axis_wobble_r_z*q_r_y + bar_q_spin_axis_wobble_tau_xz*cos_psi + bar_q_spin_axis_wobble_tau_yz*sin_psi
    bar_wobble_zx = bar_f_spin_axis_wobble_r_z*f_r_x + bar_f_spin_axis_wobble_tau_xz*f_tau_xx + bar_f_spin_axis_wobble_tau_yz*f_tau_yx + bar_f_spin_axis_wobble_tau_zz*f_tau_zx + bar_q_spin_axis_wobble_r_z*q_r_x - bar_q_spin_axis_wobble_tau_xz*sin_psi + bar_q_spin_axis_wobble_tau_yz*cos_psi
    bar_wobble_yz = bar_f_spin_axis_wobble_r_y*f_disc_r_z - bar_f_spin_axis_wobble_tau_yy*beta_x - bar_f_spin_axis_wobble_tau_zy - bar_q_p_second_order_misalignment*q_f_y
    bar_wobble_xz = bar_f_spin_axis_wobble_r_x*f_disc_r_z - bar_f_spin_axis_wobble_tau_yx*beta_x - bar_f_spin_axis_wobble_tau_zx - bar_q_p_second_order_misalignment*q_f_x
    bar_sin_psi = -bar_f_spin_axis_wobble_r_x*f_disc_r_y + bar_f_spin_axis_wobble_r_y*f_disc_r_x - bar_f_spin_axis_wobble_tau_xx - bar_f_spin_axis_wobble_tau_xy*beta_z - bar_f_spin_axis_wobble_tau_yx*beta_z + bar_f_spin_axis_wobble_tau_yy - bar_f_spin_axis_wobble_tau_zx*f_disc_tau_zy - bar_f_spin_axis_wobble_tau_zy*beta_x + bar_q_spin_axis_wobble_r_y*q_disc_r_x - bar_q_spin_axis_wobble_tau_xx + bar_q_spin_axis_wobble_tau_yy
    bar_cos_psi = bar_f_spin_axis_wobble_r_x*f_disc_r_x + bar_f_spin_axis_wobble_r_y*f_disc_r_y - bar_f_spin_axis_wobble_tau_xx*beta_z + bar_f_spin_axis_wobble_tau_xy + bar_f_spin_axis_wobble_tau_yx + bar_f_spin_axis_wobble_tau_yy*beta_z - bar_f_spin_axis_wobble_tau_zx*beta_x + bar_f_spin_axis_wobble_tau_zy*f_disc_tau_zy + bar_q_spin_axis_wobble_r_x*q_disc_r_x + bar_q_spin_axis_wobble_tau_xy + bar_q_spin_axis_wobble_tau_yx
    x106 = bar_f_f_z*f_disc_r_z
    bar_M_zz = x106
    x107 = bar_f_f_z*f_r_y
    x108 = bar_q_p_second_order_misalignment*q_r_y
    bar_M_zy = x107 - x108
    x109 = bar_q_p_second_order_misalignment*q_r_x
    bar_M_zx = bar_f_f_z*f_r_x - x109
    x110 = bar_f_f_y*f_disc_r_z
    bar_M_yz = x110
    x111 = bar_f_f_y*f_r_y
    x112 = bar_q_f_y*q_r_y
    bar_M_yy = x111 + x112
    x113 = bar_q_f_y*q_r_x
    bar_M_yx = bar_f_f_y*f_r_x + x113
    x114 = bar_f_f_x*f_disc_r_z
    bar_M_xz = x114
    x115 = bar_f_f_x*f_r_y
    x116 = bar_q_f_x*q_r_y
    bar_M_xy = x115 + x116
    x117 = bar_q_f_x*q_r_x
    bar_M_xx = bar_f_f_x*f_r_x + x117
    x118 = -bar_M_xy + bar_M_yx
    bar_spin_acceleration_true = x118
    x119 = bar_M_zx*omega_x
    x120 = bar_M_zy*omega_y
    x121 = bar_M_xx*x28 + bar_M_yy*x28
    bar_spin_rate_true = 2.0*x119 + 2.0*x120 + x121
    bar_sin_phi_true = -bar_cos_psi*sin_j + bar_sin_psi*cos_j
    bar_cos_phi_true = bar_cos_psi*cos_j + bar_sin_psi*sin_j
    bar_sin_delta_phi = -bar_cos_phi_true*sin_phi + bar_sin_phi_true*cos_phi
    bar_time_offset_omegadot_z = x118
    bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx
    bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy
    bar_time_offset_omega_z = bar_M_xz*omega_x + bar_M_yz*omega_y + x119 + x120 + x121
    bar_time_offset_omega_y = -bar_M_xx*x25 + bar_M_xy*omega_x + bar_M_yx*omega_x + bar_M_yz*omega_z + bar_M_zy*x45 - bar_M_zz*x25
    bar_time_offset_omega_x = bar_M_xy*omega_y + bar_M_xz*omega_z + bar_M_yx*omega_y - bar_M_yy*x70 + bar_M_zx*x45 - bar_M_zz*x70
    bar_time_offset_a_z = bar_f_f_z - bar_q_p_second_order_misalignment
    bar_time_offset_a_y = bar_f_f_y + bar_q_f_y
    bar_time_offset_a_x = bar_f_f_x + bar_q_f_x
    bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy
    bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx
    bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx
    x122 = a_y*bar_time_offset_a_z
    x123 = bar_time_offset_omega_z*omega_y
    x124 = bar_time_offset_omegadot_z*omegadot_y
    bar_imu_turn_zy = x122 + x123 + x124
    x125 = a_x*bar_time_offset_a_z
    x126 = bar_time_offset_omega_z*omega_x + bar_time_offset_omegadot_z*omegadot_x + x125
    bar_imu_turn_zx = x126
    x127 = a_z*bar_time_offset_a_y
    x128 = bar_time_offset_omega_y*omega_z + bar_time_offset_omegadot_y*omegadot_z + x127
    bar_imu_turn_yz = x128
    x129 = a_x*bar_time_offset_a_y
    bar_imu_turn_yx = bar_time_offset_omega_y*omega_x + bar_time_offset_omegadot_y*omegadot_x + x129
    x130 = a_z*bar_time_offset_a_x
    x131 = bar_time_offset_omega_x*omega_z
    x132 = bar_time_offset_omegadot_x*omegadot_z
    bar_imu_turn_xz = x130 + x131 + x132
    x133 = a_y*bar_time_offset_a_x
    bar_imu_turn_xy = bar_time_offset_omega_x*omega_y + bar_time_offset_omegadot_x*omegadot_y + x133
    x134 = bar_time_offset_a_x*d_a_x
    x135 = bar_time_offset_a_y*d_a_y
    x136 = bar_time_offset_a_z*d_a_z
    x137 = bar_time_offset_omega_x*omegadot_x
    x138 = bar_time_offset_omega_y*omegadot_y
    x139 = bar_time_offset_omega_z*omegadot_z
    x140 = bar_time_offset_omegadot_x*d_omegadot_x
    x141 = bar_time_offset_omegadot_y*d_omegadot_y
    x142 = bar_time_offset_omegadot_z*d_omegadot_z
    x143 = bar_i_vibration_rectification*f_f_i**2.0
    x144 = f_f_o**2.0
    x145 = bar_i_vibration_rectification*f_f_i
    x146 = f_f_p**2.0
    x147 = bar_sin_delta_phi*cos_phi
    x148 = bar_spin_rate_true*x35
    x149 = 4.0*cos_phi
    x150 = cos_phi**2.0
    x151 = sin_phi**2.0
    x152 = cos_phi**3.0
    x153 = sin_phi**3.0
    x154 = 9.0*x150
    x155 = 9.0*x60
    x156 = 3.0*x152
    x157 = 9.0*x151
    x158 = cos_phi**4.0
    x159 = sin_phi**4.0
    x160 = x150*x151
    x161 = 16.0*x152
    x162 = 16.0*x60
    x163 = 4.0*d_spin_angle
    x164 = 24.0*x160
    x165 = 4.0*d2_spin_angle
    x166 = K1*bar_K1_thermal_scale
    x167 = -bar_M_zz
    x168 = x137 + x138 + x139
    x169 = x140 + x141 + x142
    x170 = -x130
    x171 = -x122
    x172 = omega_x*omega_z
    x173 = omega_z**2.0
    x174 = omega_y*omega_z
    x175 = f_r_x*x106
    x176 = 0.5*q_r_x**2.0
    x177 = 0.5*f_disc_r_z**2.0
    x178 = f_r_x**2.0
    x179 = 0.5*x178
    x180 = x177 - x179
    x181 = f_r_x*x114
    x182 = 0.5*q_r_y**2.0
    x183 = 0.5*f_r_y**2.0
    x184 = x177 - x183
    x185 = f_r_x*x110
    x186 = (1/6)*q_r_x**3.0
    x187 = f_r_x*x177
    x188 = -1/6*f_r_x**3.0 + x187
    x189 = f_disc_r_z**3.0
    x190 = (1/6)*x189
    x191 = -0.5*f_disc_r_z*x178 + x190
    x192 = f_r_y*x175
    x193 = f_r_y*x177
    x194 = -f_r_y*x179 + x193
    x195 = -f_r_x*x183 + x187
    x196 = f_disc_r_z*x183
    x197 = (1/6)*q_r_y**3.0
    x198 = -1/6*f_r_y**3.0 + x193
    x199 = x190 - x196
    x200 = np.sin(roll)
    x201 = -bar_M_zz*x200
    x202 = np.sin(pitch)
    x203 = -bar_M_zz*x202
    x204 = -Gamma_zz
    x205 = 2.0*Gamma_yz
    x206 = 2.0*Gamma_xz
    x207 = temperature - 293.15
    x208 = K4*vibration_axis_ix
    x209 = K6*vibration_axis_ix
    x210 = K8*vibration_axis_ox
    x211 = K4*vibration_axis_px
    x212 = K6*vibration_axis_ox
    x213 = K8*vibration_axis_px
    x214 = vibration_axis_ix*x96
    x215 = vibration_axis_ox*x97
    x216 = vibration_axis_px*x98
    x217 = K4*vibration_axis_iy
    x218 = K6*vibration_axis_iy
    x219 = K8*vibration_axis_oy
    x220 = K4*vibration_axis_iz
    x221 = K6*vibration_axis_iz
    x222 = K8*vibration_axis_oz

    D = np.empty((len(ROWS), len(time)))
    D[0] = bar_i_vibration_rectification*(f_tau_xx*omega_x + f_tau_xy*omega_y)*(f_tau_zx*omega_x + f_tau_zy*omega_y - x1)  # anisoinertia.K_ip
    D[1] = b_f_zj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_zj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_zj  # arm-sag.c_z
    D[2] = b_f_yj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_yj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_yj  # arm-stretch.c_r
    D[3] = bar_i_vibration_rectification*time  # bias-drift.dK0_dt
    D[4] = bar_i_vibration_rectification  # bias-step.dK0
    D[5] = time*x134 + time*x135 + time*x136 + time*x137 + time*x138 + time*x139 + time*x140 + time*x141 + time*x142  # clock-drift.epsilon
    D[6] = f_f_o*x143  # cubic-cross.K_iio
    D[7] = f_f_p*x143  # cubic-cross.K_iip
    D[8] = x144*x145  # cubic-cross.K_ioo
    D[9] = f_f_o*f_f_p*x145  # cubic-cross.K_iop
    D[10] = x145*x146  # cubic-cross.K_ipp
    D[11] = bar_i_vibration_rectification*f_f_o**3.0  # cubic-cross.K_ooo
    D[12] = bar_i_vibration_rectification*f_f_p*x144  # cubic-cross.K_oop
    D[13] = bar_i_vibration_rectification*f_f_o*x146  # cubic-cross.K_opp
    D[14] = bar_i_vibration_rectification*f_f_p**3.0  # cubic-cross.K_ppp
    D[15] = bar_i_vibration_rectification*f_f_i**3.0  # cubic-input.K_iii
    D[16] = bar_spin_acceleration_true*x62 + x147 - x148  # encoder-harmonic.c_1
    D[17] = bar_sin_delta_phi*sin_phi + bar_spin_acceleration_true*x65 + bar_spin_rate_true*x37  # encoder-harmonic.s_1
    D[18] = bar_sin_delta_phi*(x150 - x151) + bar_spin_acceleration_true*(-x149*x59 - 4.0*x150*x60 + 4.0*x151*x60) - x148*x149  # encoder-harmonic.c_2
    D[19] = bar_spin_acceleration_true*(2.0*d2_spin_angle*x150 - 8.0*sin_phi*x61 - x151*x44) + bar_spin_rate_true*(x150*x27 - x151*x27) + 2.0*sin_phi*x147  # encoder-harmonic.s_2
    D[20] = bar_sin_delta_phi*(-3.0*cos_phi*x151 + x152) + bar_spin_acceleration_true*(27.0*cos_phi*x151*x60 + 3.0*d2_spin_angle*x153 - x152*x155 - x154*x59) + bar_spin_rate_true*(3.0*d_spin_angle*x153 - x154*x35)  # encoder-harmonic.c_3
    D[21] = bar_sin_delta_phi*(3.0*sin_phi*x150 - x153) + bar_spin_acceleration_true*(d2_spin_angle*x156 - 27.0*x150*x64 + x153*x155 - x157*x63) + bar_spin_rate_true*(d_spin_angle*x156 - x157*x37)  # encoder-harmonic.s_3
    D[22] = bar_sin_delta_phi*(x158 + x159 - 6.0*x160) + bar_spin_acceleration_true*(16.0*cos_phi*d2_spin_angle*x153 + 96.0*x150*x151*x60 - x158*x162 - x159*x162 - x161*x59) + bar_spin_rate_true*(16.0*cos_phi*d_spin_angle*x153 - x161*x35)  # encoder-harmonic.c_4
    D[23] = bar_sin_delta_phi*(4.0*sin_phi*x152 - x149*x153) + bar_spin_acceleration_true*(-d2_spin_angle*x164 - 64.0*x152*x64 + 64.0*x153*x61 + x158*x165 + x159*x165) + bar_spin_rate_true*(-d_spin_angle*x164 + x158*x163 + x159*x163)  # encoder-harmonic.s_4
    D[24] = time*x166  # gain-drift.dK1_dt
    D[25] = x166  # gain-step.dK1
    D[26] = -bar_M_xx - x167  # gradient-offset.G_xx
    D[27] = bar_spin_axis_tilt_Gamma_xy  # gradient-offset.G_xy
    D[28] = bar_spin_axis_tilt_Gamma_xz  # gradient-offset.G_xz
    D[29] = -bar_M_yy - x167  # gradient-offset.G_yy
    D[30] = bar_spin_axis_tilt_Gamma_yz  # gradient-offset.G_yz
    D[31] = -bar_time_offset_omega_x  # gyro-bias.b_x
    D[32] = -bar_time_offset_omega_y  # gyro-bias.b_y
    D[33] = -bar_time_offset_omega_z  # gyro-bias.b_z
    D[34] = x168  # gyro-delay.delta_w
    D[35] = x169  # gyro-delay.delta_d
    D[36] = -a_x*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_x  # gyro-g-sensitivity.d_xx
    D[37] = -a_y*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_y  # gyro-g-sensitivity.d_xy
    D[38] = -a_z*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_z  # gyro-g-sensitivity.d_xz
    D[39] = -a_x*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_x  # gyro-g-sensitivity.d_yx
    D[40] = -a_y*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_y  # gyro-g-sensitivity.d_yy
    D[41] = -a_z*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_z  # gyro-g-sensitivity.d_yz
    D[42] = -a_x*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_x  # gyro-g-sensitivity.d_zx
    D[43] = -a_y*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_y  # gyro-g-sensitivity.d_zy
    D[44] = -a_z*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_z  # gyro-g-sensitivity.d_zz
    D[45] = -bar_time_offset_omega_x*omega_x - bar_time_offset_omegadot_x*omegadot_x  # gyro-scale.s_x
    D[46] = -bar_time_offset_omega_y*omega_y - bar_time_offset_omegadot_y*omegadot_y  # gyro-scale.s_y
    D[47] = -bar_time_offset_omega_z*omega_z - bar_time_offset_omegadot_z*omegadot_z  # gyro-scale.s_z
    D[48] = -bar_time_offset_a_x  # imu-acceleration-bias.b_x
    D[49] = -bar_time_offset_a_y  # imu-acceleration-bias.b_y
    D[50] = -bar_time_offset_a_z  # imu-acceleration-bias.b_z
    D[51] = -x133  # imu-acceleration-misalignment.m_xy
    D[52] = x170  # imu-acceleration-misalignment.m_xz
    D[53] = -x129  # imu-acceleration-misalignment.m_yx
    D[54] = -x127  # imu-acceleration-misalignment.m_yz
    D[55] = -x125  # imu-acceleration-misalignment.m_zx
    D[56] = x171  # imu-acceleration-misalignment.m_zy
    D[57] = -a_x*bar_time_offset_a_x  # imu-acceleration-scale.s_x
    D[58] = -a_y*bar_time_offset_a_y  # imu-acceleration-scale.s_y
    D[59] = -a_z*bar_time_offset_a_z  # imu-acceleration-scale.s_z
    D[60] = bar_time_offset_a_x*(x0 + x173) - bar_time_offset_a_y*x9 + bar_time_offset_a_z*(-x172 - x6)  # imu-lever-arm.l_x
    D[61] = bar_time_offset_a_x*(omegadot_z - x4) + bar_time_offset_a_y*(x10 + x173) + bar_time_offset_a_z*(-omegadot_x - x174)  # imu-lever-arm.l_y
    D[62] = bar_time_offset_a_x*(-omegadot_y - x172) + bar_time_offset_a_y*(-x13 - x174) + bar_time_offset_a_z*x14  # imu-lever-arm.l_z
    D[63] = -bar_imu_turn_yz + bar_imu_turn_zy  # imu-misalignment.e_x
    D[64] = bar_imu_turn_xz - bar_imu_turn_zx  # imu-misalignment.e_y
    D[65] = -bar_imu_turn_xy + bar_imu_turn_yx  # imu-misalignment.e_z
    D[66] = -bar_i_vibration_rectification*rate_f_f_i  # lag.tau
    D[67] = bar_i_vibration_rectification*(B_x*x102 + B_y*x103 + B_z*x104)  # magnetic-bias.dK0_dB
    D[68] = b_f_xj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yx
    D[69] = b_f_yj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yy
    D[70] = b_f_zj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yz
    D[71] = b_f_xj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zx
    D[72] = b_f_yj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zy
    D[73] = b_f_zj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zz
    D[74] = bar_f_f_x*x180 - bar_q_f_x*x176 + x175  # near-mass.T_xxx
    D[75] = bar_f_f_y*x180 + bar_f_f_z*f_disc_r_z*f_r_y - bar_q_f_y*x176 - f_r_x*x115 - q_r_x*x116  # near-mass.T_xxy
    D[76] = bar_f_f_z*x180 + bar_q_p_second_order_misalignment*x176 - x181  # near-mass.T_xxz
    D[77] = bar_f_f_x*x184 + bar_f_f_z*f_disc_r_z*f_r_x - bar_q_f_x*x182 - f_r_x*x111 - q_r_x*x112  # near-mass.T_xyy
    D[78] = bar_q_p_second_order_misalignment*q_r_x*q_r_y - f_r_x*x107 - f_r_y*x114 - x185  # near-mass.T_xyz
    D[79] = bar_f_f_y*x184 - bar_q_f_y*x182 + f_r_y*x106  # near-mass.T_yyy
    D[80] = bar_f_f_z*x184 + bar_q_p_second_order_misalignment*x182 - f_r_y*x110  # near-mass.T_yyz
    D[81] = bar_f_f_x*x188 - bar_f_f_z*x191 - bar_q_f_x*x186  # near-mass.T_xxxx
    D[82] = bar_f_f_x*x194 + bar_f_f_y*x188 - bar_q_f_y*x186 - x116*x176 + x192  # near-mass.T_xxxy
    D[83] = bar_f_f_x*x191 + bar_f_f_z*x188 + bar_q_p_second_order_misalignment*x186  # near-mass.T_xxxz
    D[84] = bar_f_f_x*x195 + bar_f_f_y*x194 + bar_f_f_z*(f_disc_r_z*x179 - 1/3*x189 + x196) - x112*x176 - x117*x182  # near-mass.T_xxyy
    D[85] = bar_f_f_y*x191 + bar_f_f_z*x194 - f_r_y*x181 + x108*x176  # near-mass.T_xxyz
    D[86] = bar_f_f_x*x198 + bar_f_f_y*x195 - bar_q_f_x*x197 - x113*x182 + x192  # near-mass.T_xyyy
    D[87] = bar_f_f_x*x199 + bar_f_f_z*x195 - f_r_y*x185 + x109*x182  # near-mass.T_xyyz
    D[88] = bar_f_f_y*x198 - bar_f_f_z*x199 - bar_q_f_y*x197  # near-mass.T_yyyy
    D[89] = bar_f_f_y*x199 + bar_f_f_z*x198 + bar_q_p_second_order_misalignment*x197  # near-mass.T_yyyz
    D[90] = x145*np.abs(f_f_i)  # odd-quadratic.K_oq
    D[91] = bar_i_vibration_rectification*rate_rate_i_sensed  # output-filter.b
    D[92] = bar_i_vibration_rectification*i_sensed  # output-gain-step.g
    D[93] = bar_i_vibration_rectification*(-beta_x*x5 + f_tau_yx*x12 - f_tau_yy*x8)  # pendulum-angular.K_pa
    D[94] = bar_i_vibration_rectification*(pressure - 101325)  # pressure-bias.dK0_dp
    D[95] = bar_q_i_second_order_misalignment*(f_f_i - q_f_xj) + bar_q_o_second_order_misalignment*(f_f_o - q_f_yj) + bar_q_p_second_order_misalignment*(f_f_p + q_f_z)  # second-order-misalignment.kappa
    D[96] = -bar_M_xx*x200 - x201  # self-gradient.G_xx_roll
    D[97] = bar_spin_axis_tilt_Gamma_xy*x200  # self-gradient.G_xy_roll
    D[98] = bar_spin_axis_tilt_Gamma_xz*x200  # self-gradient.G_xz_roll
    D[99] = -bar_M_yy*x200 - x201  # self-gradient.G_yy_roll
    D[100] = bar_spin_axis_tilt_Gamma_yz*x200  # self-gradient.G_yz_roll
    D[101] = -bar_M_xx*x202 - x203  # self-gradient.G_xx_pitch
    D[102] = bar_spin_axis_tilt_Gamma_xy*x202  # self-gradient.G_xy_pitch
    D[103] = bar_spin_axis_tilt_Gamma_xz*x202  # self-gradient.G_xz_pitch
    D[104] = -bar_M_yy*x202 - x203  # self-gradient.G_yy_pitch
    D[105] = bar_spin_axis_tilt_Gamma_yz*x202  # self-gradient.G_yz_pitch
    D[106] = -Gamma_xy*bar_spin_axis_tilt_Gamma_xz + Gamma_xz*bar_spin_axis_tilt_Gamma_xy - bar_M_yy*x205 + bar_M_zz*x205 + bar_spin_axis_tilt_Gamma_yz*(-Gamma_yy - x204) - x123 - x124 + x128 + x171  # spin-axis-tilt.alpha_x
    D[107] = Gamma_xy*bar_spin_axis_tilt_Gamma_yz - Gamma_yz*bar_spin_axis_tilt_Gamma_xy + bar_M_xx*x206 - bar_M_zz*x206 + bar_spin_axis_tilt_Gamma_xz*(Gamma_xx + x204) + x126 - x131 - x132 + x170  # spin-axis-tilt.alpha_y
    D[108] = bar_wobble_xz*sin_phi - bar_wobble_yz*cos_phi - bar_wobble_zx*sin_phi + bar_wobble_zy*cos_phi  # spin-axis-wobble.w_x
    D[109] = bar_wobble_xz*cos_phi + bar_wobble_yz*sin_phi - bar_wobble_zx*cos_phi - bar_wobble_zy*sin_phi  # spin-axis-wobble.w_y
    D[110] = bar_sin_delta_phi  # spin-phase-offset.phi_0
    D[111] = bar_sin_delta_phi  # spin-rate-jitter.sigma_phi
    D[112] = bar_sin_delta_phi  # spin-rate-jitter.sigma_walk
    D[113] = bar_sin_delta_phi*d_spin_angle*time + bar_spin_acceleration_true*x44 + bar_spin_rate_true*(d2_spin_angle*time + d_spin_angle)  # spin-rate-offset.epsilon
    D[114] = bar_i_vibration_rectification*x207  # thermal-bias.dK0_dT
    D[115] = bar_i_vibration_rectification*d_temperature  # thermal-lag.dK0_dTdot
    D[116] = d_temperature*x166  # thermal-lag.dK1_dTdot
    D[117] = x166*x207  # thermal-scale.dK1_dT
    D[118] = x134 + x135 + x136 + x168 + x169  # time-offset.delta_t
    D[119] = bar_i_vibration_rectification*(K2*vibration_axis_ix**2.0 + K5*vibration_axis_ox**2.0 + K7*vibration_axis_px**2.0 + vibration_axis_ox*x209 + vibration_axis_px*x208 + vibration_axis_px*x210)  # vibration-rectification.P_xx
    D[120] = bar_i_vibration_rectification*(vibration_axis_iy*x211 + vibration_axis_iy*x212 + vibration_axis_iy*x214 + vibration_axis_oy*x209 + vibration_axis_oy*x213 + vibration_axis_oy*x215 + vibration_axis_py*x208 + vibration_axis_py*x210 + vibration_axis_py*x216)  # vibration-rectification.P_xy
    D[121] = bar_i_vibration_rectification*(vibration_axis_iz*x211 + vibration_axis_iz*x212 + vibration_axis_iz*x214 + vibration_axis_oz*x209 + vibration_axis_oz*x213 + vibration_axis_oz*x215 + vibration_axis_pz*x208 + vibration_axis_pz*x210 + vibration_axis_pz*x216)  # vibration-rectification.P_xz
    D[122] = bar_i_vibration_rectification*(K2*vibration_axis_iy**2.0 + K5*vibration_axis_oy**2.0 + K7*vibration_axis_py**2.0 + vibration_axis_oy*x218 + vibration_axis_py*x217 + vibration_axis_py*x219)  # vibration-rectification.P_yy
    D[123] = bar_i_vibration_rectification*(vibration_axis_iy*vibration_axis_iz*x96 + vibration_axis_oy*vibration_axis_oz*x97 + vibration_axis_oy*x221 + vibration_axis_oz*x218 + vibration_axis_py*vibration_axis_pz*x98 + vibration_axis_py*x220 + vibration_axis_py*x222 + vibration_axis_pz*x217 + vibration_axis_pz*x219)  # vibration-rectification.P_yz
    D[124] = bar_i_vibration_rectification*(K2*vibration_axis_iz**2.0 + K5*vibration_axis_oz**2.0 + K7*vibration_axis_pz**2.0 + vibration_axis_oz*x221 + vibration_axis_pz*x220 + vibration_axis_pz*x222)  # vibration-rectification.P_zz
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
