"""Signatures: what each candidate effect would add to V_j.

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: anisoinertia, arm-sag, arm-stretch, bias-drift, bias-step, clock-drift, cubic-cross, cubic-input, encoder-harmonic, gain-drift, gain-step, gradient-offset, gyro-bias, gyro-g-sensitivity, gyro-scale, imu-acceleration-bias, imu-acceleration-misalignment, imu-acceleration-scale, imu-lever-arm, imu-misalignment, lag, magnetic-bias, mount-compliance, near-mass, odd-quadratic, output-filter, output-gain-step, pendulum-angular, pressure-bias, second-order-misalignment, self-gradient, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, spin-rate-offset, thermal-bias, thermal-lag, thermal-scale, time-offset, vibration-rectification.
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
    rate_M_xx = -x26 + x29
    x30 = omega_x*omegadot_y + omega_y*omegadot_x
    rate_M_xy = -d_omegadot_z + x30
    x31 = omega_x*omegadot_z
    rate_M_xz = d_omegadot_y + omega_z*omegadot_x + x31
    x32 = d_spin_angle*sin_phi
    rate_cos_phi_true = -x32
    x33 = cos_phi*d_spin_angle
    rate_sin_phi_true = x33
    rate_cos_psi = cos_j*rate_cos_phi_true - rate_sin_phi_true*sin_j
    rate_sin_psi = cos_j*rate_sin_phi_true + rate_cos_phi_true*sin_j
    rate_b_r_x = b_disc_r_x*rate_cos_psi - b_disc_r_y*rate_sin_psi
    rate_b_r_y = b_disc_r_x*rate_sin_psi + b_disc_r_y*rate_cos_psi
    rate_b_f_x = M_xx*rate_b_r_x + M_xy*rate_b_r_y + b_disc_r_z*rate_M_xz + b_r_x*rate_M_xx + b_r_y*rate_M_xy + d_a_x
    rate_M_yx = d_omegadot_z + x30
    x34 = 2.0*omegadot_x
    x35 = omega_x*x34
    rate_M_yy = x29 - x35
    x36 = omega_y*omegadot_z
    rate_M_yz = -d_omegadot_x + omega_z*omegadot_y + x36
    rate_b_f_y = M_yx*rate_b_r_x + M_yy*rate_b_r_y + b_disc_r_z*rate_M_yz + b_r_x*rate_M_yx + b_r_y*rate_M_yy + d_a_y
    x37 = 2.0*d2_spin_angle
    x38 = omega_z + x27
    rate_M_zx = -d_omegadot_y + omega_x*x37 + omegadot_x*x38 + x31
    rate_M_zy = d_omegadot_x + omega_y*x37 + omegadot_y*x38 + x36
    rate_M_zz = -x26 - x35
    rate_b_f_z = M_zx*rate_b_r_x + M_zy*rate_b_r_y + b_disc_r_z*rate_M_zz + b_r_x*rate_M_zx + b_r_y*rate_M_zy + d_a_z
    x39 = -beta_z*rate_sin_psi + rate_cos_psi
    rate_b_tau_yx = x39
    x40 = beta_z*rate_cos_psi + rate_sin_psi
    rate_b_tau_yy = x40
    rate_b_f_yj = b_f_x*rate_b_tau_yx + b_f_y*rate_b_tau_yy + b_tau_yx*rate_b_f_x + b_tau_yy*rate_b_f_y - beta_x*rate_b_f_z
    x41 = beta_x*rate_cos_psi
    rate_b_tau_zx = -b_disc_tau_zy*rate_sin_psi - x41
    x42 = beta_x*rate_sin_psi
    rate_b_tau_zy = b_disc_tau_zy*rate_cos_psi - x42
    rate_b_f_zj = b_f_x*rate_b_tau_zx + b_f_y*rate_b_tau_zy + b_tau_zx*rate_b_f_x + b_tau_zy*rate_b_f_y - rate_b_f_z
    x43 = 2.0*omegadot_y**2.0
    x44 = d_omegadot_y*x25
    x45 = 2.0*omegadot_z
    x46 = -x37 - x45
    x47 = d2_spin_angle*x46 + d_omegadot_z*x28 + omegadot_z*x46
    rate_rate_M_xx = -x43 - x44 + x47
    x48 = d_omegadot_x*omega_y + d_omegadot_y*omega_x + omegadot_y*x34
    rate_rate_M_xy = -d2_omegadot_z + x48
    x49 = d_omegadot_z*omega_x
    rate_rate_M_xz = d2_omegadot_y + d_omegadot_x*omega_z + omegadot_x*x45 + x49
    x50 = d2_spin_angle*sin_phi
    x51 = d_spin_angle**2.0
    x52 = cos_phi*x51
    x53 = -x50 - x52
    rate_rate_cos_phi_true = x53
    x54 = cos_phi*d2_spin_angle
    x55 = sin_phi*x51
    x56 = x54 - x55
    rate_rate_sin_phi_true = x56
    rate_rate_cos_psi = cos_j*rate_rate_cos_phi_true - rate_rate_sin_phi_true*sin_j
    rate_rate_sin_psi = cos_j*rate_rate_sin_phi_true + rate_rate_cos_phi_true*sin_j
    rate_rate_b_r_x = b_disc_r_x*rate_rate_cos_psi - b_disc_r_y*rate_rate_sin_psi
    rate_rate_b_r_y = b_disc_r_x*rate_rate_sin_psi + b_disc_r_y*rate_rate_cos_psi
    x57 = 2.0*rate_b_r_x
    x58 = 2.0*rate_b_r_y
    rate_rate_b_f_x = M_xx*rate_rate_b_r_x + M_xy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_xz + b_r_x*rate_rate_M_xx + b_r_y*rate_rate_M_xy + d2_a_x + rate_M_xx*x57 + rate_M_xy*x58
    rate_rate_M_yx = d2_omegadot_z + x48
    x59 = 2.0*omegadot_x**2.0
    x60 = 2.0*omega_x
    x61 = d_omegadot_x*x60
    rate_rate_M_yy = x47 - x59 - x61
    x62 = d_omegadot_z*omega_y
    rate_rate_M_yz = -d2_omegadot_x + d_omegadot_y*omega_z + omegadot_y*x45 + x62
    rate_rate_b_f_y = M_yx*rate_rate_b_r_x + M_yy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_yz + b_r_x*rate_rate_M_yx + b_r_y*rate_rate_M_yy + d2_a_y + rate_M_yx*x57 + rate_M_yy*x58
    x63 = omegadot_z + x37
    rate_rate_M_zx = -d2_omegadot_y + d_omegadot_x*x38 + omegadot_x*omegadot_z + omegadot_x*x37 + omegadot_x*x63 + x49
    rate_rate_M_zy = d2_omegadot_x + d_omegadot_y*x38 + omegadot_y*omegadot_z + omegadot_y*x37 + omegadot_y*x63 + x62
    rate_rate_M_zz = -x43 - x44 - x59 - x61
    rate_rate_b_f_z = M_zx*rate_rate_b_r_x + M_zy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_zz + b_r_x*rate_rate_M_zx + b_r_y*rate_rate_M_zy + d2_a_z + rate_M_zx*x57 + rate_M_zy*x58
    x64 = -beta_z*rate_rate_sin_psi + rate_rate_cos_psi
    rate_rate_b_tau_yx = x64
    x65 = beta_z*rate_rate_cos_psi + rate_rate_sin_psi
    rate_rate_b_tau_yy = x65
    x66 = 2.0*rate_b_f_x
    x67 = 2.0*rate_b_f_y
    rate_rate_b_f_yj = b_f_x*rate_rate_b_tau_yx + b_f_y*rate_rate_b_tau_yy + b_tau_yx*rate_rate_b_f_x + b_tau_yy*rate_rate_b_f_y - beta_x*rate_rate_b_f_z + rate_b_tau_yx*x66 + rate_b_tau_yy*x67
    x68 = beta_x*rate_rate_cos_psi
    rate_rate_b_tau_zx = -b_disc_tau_zy*rate_rate_sin_psi - x68
    x69 = beta_x*rate_rate_sin_psi
    rate_rate_b_tau_zy = b_disc_tau_zy*rate_rate_cos_psi - x69
    rate_rate_b_f_zj = b_f_x*rate_rate_b_tau_zx + b_f_y*rate_rate_b_tau_zy + b_tau_zx*rate_rate_b_f_x + b_tau_zy*rate_rate_b_f_y + rate_b_tau_zx*x66 + rate_b_tau_zy*x67 - rate_rate_b_f_z
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
    x70 = K6*q_f_yj
    x71 = K4*q_f_z
    x72 = K8*q_f_z
    i_sensed = K0 + K2*q_f_xj**2.0 + K5*q_f_yj**2.0 + K7*q_f_z**2.0 + f_f_i + q_f_xj*x70 - q_f_xj*x71 - q_f_yj*x72
    rate_f_r_x = f_disc_r_x*rate_cos_psi - f_disc_r_y*rate_sin_psi
    rate_f_r_y = f_disc_r_x*rate_sin_psi + f_disc_r_y*rate_cos_psi
    rate_f_f_x = M_xx*rate_f_r_x + M_xy*rate_f_r_y + d_a_x + f_disc_r_z*rate_M_xz + f_r_x*rate_M_xx + f_r_y*rate_M_xy
    rate_f_f_y = M_yx*rate_f_r_x + M_yy*rate_f_r_y + d_a_y + f_disc_r_z*rate_M_yz + f_r_x*rate_M_yx + f_r_y*rate_M_yy
    rate_f_f_z = M_zx*rate_f_r_x + M_zy*rate_f_r_y + d_a_z + f_disc_r_z*rate_M_zz + f_r_x*rate_M_zx + f_r_y*rate_M_zy
    rate_f_tau_xx = -x40
    rate_f_tau_xy = x39
    rate_f_f_xj = f_f_x*rate_f_tau_xx + f_f_y*rate_f_tau_xy + f_tau_xx*rate_f_f_x + f_tau_xy*rate_f_f_y
    rate_f_tau_yx = x39
    rate_f_tau_yy = x40
    rate_f_f_yj = -beta_x*rate_f_f_z + f_f_x*rate_f_tau_yx + f_f_y*rate_f_tau_yy + f_tau_yx*rate_f_f_x + f_tau_yy*rate_f_f_y
    rate_f_tau_zx = -f_disc_tau_zy*rate_sin_psi - x41
    rate_f_tau_zy = f_disc_tau_zy*rate_cos_psi - x42
    rate_f_f_zj = f_f_x*rate_f_tau_zx + f_f_y*rate_f_tau_zy + f_tau_zx*rate_f_f_x + f_tau_zy*rate_f_f_y - rate_f_f_z
    rate_f_f_i = rate_f_f_xj + rate_f_f_yj*vartheta_z - rate_f_f_zj*vartheta_y
    rate_rate_f_r_x = f_disc_r_x*rate_rate_cos_psi - f_disc_r_y*rate_rate_sin_psi
    rate_rate_f_r_y = f_disc_r_x*rate_rate_sin_psi + f_disc_r_y*rate_rate_cos_psi
    x73 = 2.0*rate_f_r_x
    x74 = 2.0*rate_f_r_y
    rate_rate_f_f_x = M_xx*rate_rate_f_r_x + M_xy*rate_rate_f_r_y + d2_a_x + f_disc_r_z*rate_rate_M_xz + f_r_x*rate_rate_M_xx + f_r_y*rate_rate_M_xy + rate_M_xx*x73 + rate_M_xy*x74
    rate_rate_f_f_y = M_yx*rate_rate_f_r_x + M_yy*rate_rate_f_r_y + d2_a_y + f_disc_r_z*rate_rate_M_yz + f_r_x*rate_rate_M_yx + f_r_y*rate_rate_M_yy + rate_M_yx*x73 + rate_M_yy*x74
    rate_rate_f_f_z = M_zx*rate_rate_f_r_x + M_zy*rate_rate_f_r_y + d2_a_z + f_disc_r_z*rate_rate_M_zz + f_r_x*rate_rate_M_zx + f_r_y*rate_rate_M_zy + rate_M_zx*x73 + rate_M_zy*x74
    rate_rate_f_tau_xx = -x65
    rate_rate_f_tau_xy = x64
    x75 = 2.0*rate_f_f_x
    x76 = 2.0*rate_f_f_y
    rate_rate_f_f_xj = f_f_x*rate_rate_f_tau_xx + f_f_y*rate_rate_f_tau_xy + f_tau_xx*rate_rate_f_f_x + f_tau_xy*rate_rate_f_f_y + rate_f_tau_xx*x75 + rate_f_tau_xy*x76
    rate_rate_f_tau_yx = x64
    rate_rate_f_tau_yy = x65
    rate_rate_f_f_yj = -beta_x*rate_rate_f_f_z + f_f_x*rate_rate_f_tau_yx + f_f_y*rate_rate_f_tau_yy + f_tau_yx*rate_rate_f_f_x + f_tau_yy*rate_rate_f_f_y + rate_f_tau_yx*x75 + rate_f_tau_yy*x76
    rate_rate_f_tau_zx = -f_disc_tau_zy*rate_rate_sin_psi - x68
    rate_rate_f_tau_zy = f_disc_tau_zy*rate_rate_cos_psi - x69
    rate_rate_f_f_zj = f_f_x*rate_rate_f_tau_zx + f_f_y*rate_rate_f_tau_zy + f_tau_zx*rate_rate_f_f_x + f_tau_zy*rate_rate_f_f_y + rate_f_tau_zx*x75 + rate_f_tau_zy*x76 - rate_rate_f_f_z
    rate_rate_f_f_i = rate_rate_f_f_xj + rate_rate_f_f_yj*vartheta_z - rate_rate_f_f_zj*vartheta_y
    rate_q_r_x = q_disc_r_x*rate_cos_psi
    rate_q_r_y = q_disc_r_x*rate_sin_psi
    rate_q_f_x = M_xx*rate_q_r_x + M_xy*rate_q_r_y + d_a_x + q_r_x*rate_M_xx + q_r_y*rate_M_xy
    rate_q_f_y = M_yx*rate_q_r_x + M_yy*rate_q_r_y + d_a_y + q_r_x*rate_M_yx + q_r_y*rate_M_yy
    rate_q_f_z = M_zx*rate_q_r_x + M_zy*rate_q_r_y + d_a_z + q_r_x*rate_M_zx + q_r_y*rate_M_zy
    rate_q_f_xj = cos_psi*rate_q_f_y - q_f_x*rate_sin_psi + q_f_y*rate_cos_psi - rate_q_f_x*sin_psi
    rate_q_f_yj = cos_psi*rate_q_f_x + q_f_x*rate_cos_psi + q_f_y*rate_sin_psi + rate_q_f_y*sin_psi
    rate_rate_q_r_x = q_disc_r_x*rate_rate_cos_psi
    rate_rate_q_r_y = q_disc_r_x*rate_rate_sin_psi
    x77 = 2.0*rate_q_r_x
    x78 = 2.0*rate_q_r_y
    rate_rate_q_f_x = M_xx*rate_rate_q_r_x + M_xy*rate_rate_q_r_y + d2_a_x + q_r_x*rate_rate_M_xx + q_r_y*rate_rate_M_xy + rate_M_xx*x77 + rate_M_xy*x78
    rate_rate_q_f_y = M_yx*rate_rate_q_r_x + M_yy*rate_rate_q_r_y + d2_a_y + q_r_x*rate_rate_M_yx + q_r_y*rate_rate_M_yy + rate_M_yx*x77 + rate_M_yy*x78
    rate_rate_q_f_z = M_zx*rate_rate_q_r_x + M_zy*rate_rate_q_r_y + d2_a_z + q_r_x*rate_rate_M_zx + q_r_y*rate_rate_M_zy + rate_M_zx*x77 + rate_M_zy*x78
    x79 = 2.0*rate_q_f_y
    x80 = 2.0*rate_q_f_x
    rate_rate_q_f_xj = cos_psi*rate_rate_q_f_y - q_f_x*rate_rate_sin_psi + q_f_y*rate_rate_cos_psi + rate_cos_psi*x79 - rate_rate_q_f_x*sin_psi - rate_sin_psi*x80
    rate_rate_q_f_yj = cos_psi*rate_rate_q_f_x + q_f_x*rate_rate_cos_psi + q_f_y*rate_rate_sin_psi + rate_cos_psi*x80 + rate_rate_q_f_y*sin_psi + rate_sin_psi*x79
    x81 = 2.0*K2
    x82 = 2.0*K5
    x83 = 2.0*K7
    x84 = q_f_xj*x81 + x70 - x71
    x85 = K6*q_f_xj + q_f_yj*x82 - x72
    x86 = K4*q_f_xj + K8*q_f_yj - q_f_z*x83
    rate_rate_i_sensed = rate_q_f_xj*(-K4*rate_q_f_z + K6*rate_q_f_yj + rate_q_f_xj*x81) + rate_q_f_yj*(K6*rate_q_f_xj - K8*rate_q_f_z + rate_q_f_yj*x82) - rate_q_f_z*(K4*rate_q_f_xj + K8*rate_q_f_yj - rate_q_f_z*x83) + rate_rate_f_f_i + rate_rate_q_f_xj*x84 + rate_rate_q_f_yj*x85 - rate_rate_q_f_z*x86
    x87 = f_tau_xx + f_tau_yx*vartheta_z - f_tau_zx*vartheta_y
    vibration_axis_ix = x87
    x88 = f_tau_xy + f_tau_yy*vartheta_z - f_tau_zy*vartheta_y
    vibration_axis_iy = x88
    x89 = -beta_x*vartheta_z + vartheta_y
    vibration_axis_iz = x89
    vibration_axis_ox = -f_tau_xx*vartheta_z + f_tau_yx + f_tau_zx*vartheta_x
    vibration_axis_oy = -f_tau_xy*vartheta_z + f_tau_yy + f_tau_zy*vartheta_x
    vibration_axis_oz = -beta_x - vartheta_x
    vibration_axis_px = f_tau_xx*vartheta_y - f_tau_yx*vartheta_x + f_tau_zx
    vibration_axis_py = f_tau_xy*vartheta_y - f_tau_yy*vartheta_x + f_tau_zy
    vibration_axis_pz = beta_x*vartheta_x - 1
    bar_i_vibration_rectification = K1*k_VI
    bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x86
    bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x85
    bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x84
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
    x90 = 2.0*x1
    bar_rate_dR_arm_stretch = bar_f_f_x*(-f_arm_y*x90 + 2.0*f_arm_z*omega_y) + bar_f_f_y*(f_arm_x*x90 - f_arm_z*x60) + bar_f_f_z*(-f_arm_x*x25 + 2.0*f_arm_y*omega_x) - bar_q_f_x*q_arm_y*x90 + bar_q_f_y*q_arm_x*x90 - bar_q_p_second_order_misalignment*(-q_arm_x*x25 + q_arm_y*x60)
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
    x91 = bar_f_f_z*f_disc_r_z
    bar_M_zz = x91
    x92 = bar_f_f_z*f_r_y
    x93 = bar_q_p_second_order_misalignment*q_r_y
    bar_M_zy = x92 - x93
    x94 = bar_q_p_second_order_misalignment*q_r_x
    bar_M_zx = bar_f_f_z*f_r_x - x94
    x95 = bar_f_f_y*f_disc_r_z
    bar_M_yz = x95
    x96 = bar_f_f_y*f_r_y
    x97 = bar_q_f_y*q_r_y
    bar_M_yy = x96 + x97
    x98 = bar_q_f_y*q_r_x
    bar_M_yx = bar_f_f_y*f_r_x + x98
    x99 = bar_f_f_x*f_disc_r_z
    bar_M_xz = x99
    x100 = bar_f_f_x*f_r_y
    x101 = bar_q_f_x*q_r_y
    bar_M_xy = x100 + x101
    x102 = bar_q_f_x*q_r_x
    bar_M_xx = bar_f_f_x*f_r_x + x102
    x103 = -bar_M_xy + bar_M_yx
    bar_spin_acceleration_true = x103
    x104 = bar_M_zx*omega_x
    x105 = bar_M_zy*omega_y
    x106 = bar_M_xx*x28 + bar_M_yy*x28
    bar_spin_rate_true = 2.0*x104 + 2.0*x105 + x106
    bar_sin_phi_true = -bar_cos_psi*sin_j + bar_sin_psi*cos_j
    bar_cos_phi_true = bar_cos_psi*cos_j + bar_sin_psi*sin_j
    bar_sin_delta_phi = -bar_cos_phi_true*sin_phi + bar_sin_phi_true*cos_phi
    bar_time_offset_omegadot_z = x103
    bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx
    bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy
    bar_time_offset_omega_z = bar_M_xz*omega_x + bar_M_yz*omega_y + x104 + x105 + x106
    bar_time_offset_omega_y = -bar_M_xx*x25 + bar_M_xy*omega_x + bar_M_yx*omega_x + bar_M_yz*omega_z + bar_M_zy*x38 - bar_M_zz*x25
    bar_time_offset_omega_x = bar_M_xy*omega_y + bar_M_xz*omega_z + bar_M_yx*omega_y - bar_M_yy*x60 + bar_M_zx*x38 - bar_M_zz*x60
    bar_time_offset_a_z = bar_f_f_z - bar_q_p_second_order_misalignment
    bar_time_offset_a_y = bar_f_f_y + bar_q_f_y
    bar_time_offset_a_x = bar_f_f_x + bar_q_f_x
    bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy
    bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx
    bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx
    x107 = a_y*bar_time_offset_a_z
    x108 = bar_time_offset_omega_z*omega_y
    x109 = bar_time_offset_omegadot_z*omegadot_y
    bar_imu_turn_zy = x107 + x108 + x109
    x110 = a_x*bar_time_offset_a_z
    x111 = bar_time_offset_omega_z*omega_x + bar_time_offset_omegadot_z*omegadot_x + x110
    bar_imu_turn_zx = x111
    x112 = a_z*bar_time_offset_a_y
    x113 = bar_time_offset_omega_y*omega_z + bar_time_offset_omegadot_y*omegadot_z + x112
    bar_imu_turn_yz = x113
    x114 = a_x*bar_time_offset_a_y
    bar_imu_turn_yx = bar_time_offset_omega_y*omega_x + bar_time_offset_omegadot_y*omegadot_x + x114
    x115 = a_z*bar_time_offset_a_x
    x116 = bar_time_offset_omega_x*omega_z
    x117 = bar_time_offset_omegadot_x*omegadot_z
    bar_imu_turn_xz = x115 + x116 + x117
    x118 = a_y*bar_time_offset_a_x
    bar_imu_turn_xy = bar_time_offset_omega_x*omega_y + bar_time_offset_omegadot_x*omegadot_y + x118
    x119 = bar_time_offset_a_x*d_a_x
    x120 = bar_time_offset_a_y*d_a_y
    x121 = bar_time_offset_a_z*d_a_z
    x122 = bar_time_offset_omega_x*omegadot_x
    x123 = bar_time_offset_omega_y*omegadot_y
    x124 = bar_time_offset_omega_z*omegadot_z
    x125 = bar_time_offset_omegadot_x*d_omegadot_x
    x126 = bar_time_offset_omegadot_y*d_omegadot_y
    x127 = bar_time_offset_omegadot_z*d_omegadot_z
    x128 = bar_i_vibration_rectification*f_f_i**2.0
    x129 = f_f_o**2.0
    x130 = bar_i_vibration_rectification*f_f_i
    x131 = f_f_p**2.0
    x132 = bar_sin_delta_phi*cos_phi
    x133 = bar_spin_rate_true*x32
    x134 = 4.0*cos_phi
    x135 = cos_phi**2.0
    x136 = sin_phi**2.0
    x137 = cos_phi**3.0
    x138 = sin_phi**3.0
    x139 = 9.0*x135
    x140 = 9.0*x51
    x141 = 3.0*x137
    x142 = 9.0*x136
    x143 = cos_phi**4.0
    x144 = sin_phi**4.0
    x145 = x135*x136
    x146 = 16.0*x137
    x147 = 16.0*x51
    x148 = 4.0*d_spin_angle
    x149 = 24.0*x145
    x150 = 4.0*d2_spin_angle
    x151 = K1*bar_K1_thermal_scale
    x152 = -bar_M_zz
    x153 = -x115
    x154 = -x107
    x155 = omega_x*omega_z
    x156 = omega_z**2.0
    x157 = omega_y*omega_z
    x158 = f_r_x*x91
    x159 = 0.5*q_r_x**2.0
    x160 = 0.5*f_disc_r_z**2.0
    x161 = f_r_x**2.0
    x162 = 0.5*x161
    x163 = x160 - x162
    x164 = f_r_x*x99
    x165 = 0.5*q_r_y**2.0
    x166 = 0.5*f_r_y**2.0
    x167 = x160 - x166
    x168 = f_r_x*x95
    x169 = (1/6)*q_r_x**3.0
    x170 = f_r_x*x160
    x171 = -1/6*f_r_x**3.0 + x170
    x172 = f_disc_r_z**3.0
    x173 = (1/6)*x172
    x174 = -0.5*f_disc_r_z*x161 + x173
    x175 = f_r_y*x158
    x176 = f_r_y*x160
    x177 = -f_r_y*x162 + x176
    x178 = -f_r_x*x166 + x170
    x179 = f_disc_r_z*x166
    x180 = (1/6)*q_r_y**3.0
    x181 = -1/6*f_r_y**3.0 + x176
    x182 = x173 - x179
    x183 = np.sin(roll)
    x184 = -bar_M_zz*x183
    x185 = np.sin(pitch)
    x186 = -bar_M_zz*x185
    x187 = -Gamma_zz
    x188 = 2.0*Gamma_yz
    x189 = 2.0*Gamma_xz
    x190 = temperature - 293.15
    x191 = K4*vibration_axis_ix
    x192 = K6*vibration_axis_ix
    x193 = K8*vibration_axis_ox
    x194 = K4*vibration_axis_px
    x195 = K6*vibration_axis_ox
    x196 = K8*vibration_axis_px
    x197 = vibration_axis_ix*x81
    x198 = vibration_axis_ox*x82
    x199 = vibration_axis_px*x83
    x200 = K4*vibration_axis_iy
    x201 = K6*vibration_axis_iy
    x202 = K8*vibration_axis_oy
    x203 = K4*vibration_axis_iz
    x204 = K6*vibration_axis_iz
    x205 = K8*vibration_axis_oz

    D = np.empty((len(ROWS), len(time)))
    D[0] = bar_i_vibration_rectification*(f_tau_xx*omega_x + f_tau_xy*omega_y)*(f_tau_zx*omega_x + f_tau_zy*omega_y - x1)  # anisoinertia.K_ip
    D[1] = b_f_zj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_zj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_zj  # arm-sag.c_z
    D[2] = b_f_yj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_yj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_yj  # arm-stretch.c_r
    D[3] = bar_i_vibration_rectification*time  # bias-drift.dK0_dt
    D[4] = bar_i_vibration_rectification  # bias-step.dK0
    D[5] = time*x119 + time*x120 + time*x121 + time*x122 + time*x123 + time*x124 + time*x125 + time*x126 + time*x127  # clock-drift.epsilon
    D[6] = f_f_o*x128  # cubic-cross.K_iio
    D[7] = f_f_p*x128  # cubic-cross.K_iip
    D[8] = x129*x130  # cubic-cross.K_ioo
    D[9] = f_f_o*f_f_p*x130  # cubic-cross.K_iop
    D[10] = x130*x131  # cubic-cross.K_ipp
    D[11] = bar_i_vibration_rectification*f_f_o**3.0  # cubic-cross.K_ooo
    D[12] = bar_i_vibration_rectification*f_f_p*x129  # cubic-cross.K_oop
    D[13] = bar_i_vibration_rectification*f_f_o*x131  # cubic-cross.K_opp
    D[14] = bar_i_vibration_rectification*f_f_p**3.0  # cubic-cross.K_ppp
    D[15] = bar_i_vibration_rectification*f_f_i**3.0  # cubic-input.K_iii
    D[16] = bar_spin_acceleration_true*x53 + x132 - x133  # encoder-harmonic.c_1
    D[17] = bar_sin_delta_phi*sin_phi + bar_spin_acceleration_true*x56 + bar_spin_rate_true*x33  # encoder-harmonic.s_1
    D[18] = bar_sin_delta_phi*(x135 - x136) + bar_spin_acceleration_true*(-x134*x50 - 4.0*x135*x51 + 4.0*x136*x51) - x133*x134  # encoder-harmonic.c_2
    D[19] = bar_spin_acceleration_true*(2.0*d2_spin_angle*x135 - 8.0*sin_phi*x52 - x136*x37) + bar_spin_rate_true*(x135*x27 - x136*x27) + 2.0*sin_phi*x132  # encoder-harmonic.s_2
    D[20] = bar_sin_delta_phi*(-3.0*cos_phi*x136 + x137) + bar_spin_acceleration_true*(27.0*cos_phi*x136*x51 + 3.0*d2_spin_angle*x138 - x137*x140 - x139*x50) + bar_spin_rate_true*(3.0*d_spin_angle*x138 - x139*x32)  # encoder-harmonic.c_3
    D[21] = bar_sin_delta_phi*(3.0*sin_phi*x135 - x138) + bar_spin_acceleration_true*(d2_spin_angle*x141 - 27.0*x135*x55 + x138*x140 - x142*x54) + bar_spin_rate_true*(d_spin_angle*x141 - x142*x33)  # encoder-harmonic.s_3
    D[22] = bar_sin_delta_phi*(x143 + x144 - 6.0*x145) + bar_spin_acceleration_true*(16.0*cos_phi*d2_spin_angle*x138 + 96.0*x135*x136*x51 - x143*x147 - x144*x147 - x146*x50) + bar_spin_rate_true*(16.0*cos_phi*d_spin_angle*x138 - x146*x32)  # encoder-harmonic.c_4
    D[23] = bar_sin_delta_phi*(4.0*sin_phi*x137 - x134*x138) + bar_spin_acceleration_true*(-d2_spin_angle*x149 - 64.0*x137*x55 + 64.0*x138*x52 + x143*x150 + x144*x150) + bar_spin_rate_true*(-d_spin_angle*x149 + x143*x148 + x144*x148)  # encoder-harmonic.s_4
    D[24] = time*x151  # gain-drift.dK1_dt
    D[25] = x151  # gain-step.dK1
    D[26] = -bar_M_xx - x152  # gradient-offset.G_xx
    D[27] = bar_spin_axis_tilt_Gamma_xy  # gradient-offset.G_xy
    D[28] = bar_spin_axis_tilt_Gamma_xz  # gradient-offset.G_xz
    D[29] = -bar_M_yy - x152  # gradient-offset.G_yy
    D[30] = bar_spin_axis_tilt_Gamma_yz  # gradient-offset.G_yz
    D[31] = -bar_time_offset_omega_x  # gyro-bias.b_x
    D[32] = -bar_time_offset_omega_y  # gyro-bias.b_y
    D[33] = -bar_time_offset_omega_z  # gyro-bias.b_z
    D[34] = -a_x*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_x  # gyro-g-sensitivity.d_xx
    D[35] = -a_y*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_y  # gyro-g-sensitivity.d_xy
    D[36] = -a_z*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_z  # gyro-g-sensitivity.d_xz
    D[37] = -a_x*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_x  # gyro-g-sensitivity.d_yx
    D[38] = -a_y*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_y  # gyro-g-sensitivity.d_yy
    D[39] = -a_z*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_z  # gyro-g-sensitivity.d_yz
    D[40] = -a_x*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_x  # gyro-g-sensitivity.d_zx
    D[41] = -a_y*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_y  # gyro-g-sensitivity.d_zy
    D[42] = -a_z*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_z  # gyro-g-sensitivity.d_zz
    D[43] = -bar_time_offset_omega_x*omega_x - bar_time_offset_omegadot_x*omegadot_x  # gyro-scale.s_x
    D[44] = -bar_time_offset_omega_y*omega_y - bar_time_offset_omegadot_y*omegadot_y  # gyro-scale.s_y
    D[45] = -bar_time_offset_omega_z*omega_z - bar_time_offset_omegadot_z*omegadot_z  # gyro-scale.s_z
    D[46] = -bar_time_offset_a_x  # imu-acceleration-bias.b_x
    D[47] = -bar_time_offset_a_y  # imu-acceleration-bias.b_y
    D[48] = -bar_time_offset_a_z  # imu-acceleration-bias.b_z
    D[49] = -x118  # imu-acceleration-misalignment.m_xy
    D[50] = x153  # imu-acceleration-misalignment.m_xz
    D[51] = -x114  # imu-acceleration-misalignment.m_yx
    D[52] = -x112  # imu-acceleration-misalignment.m_yz
    D[53] = -x110  # imu-acceleration-misalignment.m_zx
    D[54] = x154  # imu-acceleration-misalignment.m_zy
    D[55] = -a_x*bar_time_offset_a_x  # imu-acceleration-scale.s_x
    D[56] = -a_y*bar_time_offset_a_y  # imu-acceleration-scale.s_y
    D[57] = -a_z*bar_time_offset_a_z  # imu-acceleration-scale.s_z
    D[58] = bar_time_offset_a_x*(x0 + x156) - bar_time_offset_a_y*x9 + bar_time_offset_a_z*(-x155 - x6)  # imu-lever-arm.l_x
    D[59] = bar_time_offset_a_x*(omegadot_z - x4) + bar_time_offset_a_y*(x10 + x156) + bar_time_offset_a_z*(-omegadot_x - x157)  # imu-lever-arm.l_y
    D[60] = bar_time_offset_a_x*(-omegadot_y - x155) + bar_time_offset_a_y*(-x13 - x157) + bar_time_offset_a_z*x14  # imu-lever-arm.l_z
    D[61] = -bar_imu_turn_yz + bar_imu_turn_zy  # imu-misalignment.e_x
    D[62] = bar_imu_turn_xz - bar_imu_turn_zx  # imu-misalignment.e_y
    D[63] = -bar_imu_turn_xy + bar_imu_turn_yx  # imu-misalignment.e_z
    D[64] = -bar_i_vibration_rectification*rate_f_f_i  # lag.tau
    D[65] = bar_i_vibration_rectification*(B_x*x87 + B_y*x88 + B_z*x89)  # magnetic-bias.dK0_dB
    D[66] = b_f_xj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yx
    D[67] = b_f_yj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yy
    D[68] = b_f_zj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yz
    D[69] = b_f_xj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zx
    D[70] = b_f_yj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zy
    D[71] = b_f_zj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zz
    D[72] = bar_f_f_x*x163 - bar_q_f_x*x159 + x158  # near-mass.T_xxx
    D[73] = bar_f_f_y*x163 + bar_f_f_z*f_disc_r_z*f_r_y - bar_q_f_y*x159 - f_r_x*x100 - q_r_x*x101  # near-mass.T_xxy
    D[74] = bar_f_f_z*x163 + bar_q_p_second_order_misalignment*x159 - x164  # near-mass.T_xxz
    D[75] = bar_f_f_x*x167 + bar_f_f_z*f_disc_r_z*f_r_x - bar_q_f_x*x165 - f_r_x*x96 - q_r_x*x97  # near-mass.T_xyy
    D[76] = bar_q_p_second_order_misalignment*q_r_x*q_r_y - f_r_x*x92 - f_r_y*x99 - x168  # near-mass.T_xyz
    D[77] = bar_f_f_y*x167 - bar_q_f_y*x165 + f_r_y*x91  # near-mass.T_yyy
    D[78] = bar_f_f_z*x167 + bar_q_p_second_order_misalignment*x165 - f_r_y*x95  # near-mass.T_yyz
    D[79] = bar_f_f_x*x171 - bar_f_f_z*x174 - bar_q_f_x*x169  # near-mass.T_xxxx
    D[80] = bar_f_f_x*x177 + bar_f_f_y*x171 - bar_q_f_y*x169 - x101*x159 + x175  # near-mass.T_xxxy
    D[81] = bar_f_f_x*x174 + bar_f_f_z*x171 + bar_q_p_second_order_misalignment*x169  # near-mass.T_xxxz
    D[82] = bar_f_f_x*x178 + bar_f_f_y*x177 + bar_f_f_z*(f_disc_r_z*x162 - 1/3*x172 + x179) - x102*x165 - x159*x97  # near-mass.T_xxyy
    D[83] = bar_f_f_y*x174 + bar_f_f_z*x177 - f_r_y*x164 + x159*x93  # near-mass.T_xxyz
    D[84] = bar_f_f_x*x181 + bar_f_f_y*x178 - bar_q_f_x*x180 - x165*x98 + x175  # near-mass.T_xyyy
    D[85] = bar_f_f_x*x182 + bar_f_f_z*x178 - f_r_y*x168 + x165*x94  # near-mass.T_xyyz
    D[86] = bar_f_f_y*x181 - bar_f_f_z*x182 - bar_q_f_y*x180  # near-mass.T_yyyy
    D[87] = bar_f_f_y*x182 + bar_f_f_z*x181 + bar_q_p_second_order_misalignment*x180  # near-mass.T_yyyz
    D[88] = x130*np.abs(f_f_i)  # odd-quadratic.K_oq
    D[89] = bar_i_vibration_rectification*rate_rate_i_sensed  # output-filter.b
    D[90] = bar_i_vibration_rectification*i_sensed  # output-gain-step.g
    D[91] = bar_i_vibration_rectification*(-beta_x*x5 + f_tau_yx*x12 - f_tau_yy*x8)  # pendulum-angular.K_pa
    D[92] = bar_i_vibration_rectification*(pressure - 101325)  # pressure-bias.dK0_dp
    D[93] = bar_q_i_second_order_misalignment*(f_f_i - q_f_xj) + bar_q_o_second_order_misalignment*(f_f_o - q_f_yj) + bar_q_p_second_order_misalignment*(f_f_p + q_f_z)  # second-order-misalignment.kappa
    D[94] = -bar_M_xx*x183 - x184  # self-gradient.G_xx_roll
    D[95] = bar_spin_axis_tilt_Gamma_xy*x183  # self-gradient.G_xy_roll
    D[96] = bar_spin_axis_tilt_Gamma_xz*x183  # self-gradient.G_xz_roll
    D[97] = -bar_M_yy*x183 - x184  # self-gradient.G_yy_roll
    D[98] = bar_spin_axis_tilt_Gamma_yz*x183  # self-gradient.G_yz_roll
    D[99] = -bar_M_xx*x185 - x186  # self-gradient.G_xx_pitch
    D[100] = bar_spin_axis_tilt_Gamma_xy*x185  # self-gradient.G_xy_pitch
    D[101] = bar_spin_axis_tilt_Gamma_xz*x185  # self-gradient.G_xz_pitch
    D[102] = -bar_M_yy*x185 - x186  # self-gradient.G_yy_pitch
    D[103] = bar_spin_axis_tilt_Gamma_yz*x185  # self-gradient.G_yz_pitch
    D[104] = -Gamma_xy*bar_spin_axis_tilt_Gamma_xz + Gamma_xz*bar_spin_axis_tilt_Gamma_xy - bar_M_yy*x188 + bar_M_zz*x188 + bar_spin_axis_tilt_Gamma_yz*(-Gamma_yy - x187) - x108 - x109 + x113 + x154  # spin-axis-tilt.alpha_x
    D[105] = Gamma_xy*bar_spin_axis_tilt_Gamma_yz - Gamma_yz*bar_spin_axis_tilt_Gamma_xy + bar_M_xx*x189 - bar_M_zz*x189 + bar_spin_axis_tilt_Gamma_xz*(Gamma_xx + x187) + x111 - x116 - x117 + x153  # spin-axis-tilt.alpha_y
    D[106] = bar_wobble_xz*sin_phi - bar_wobble_yz*cos_phi - bar_wobble_zx*sin_phi + bar_wobble_zy*cos_phi  # spin-axis-wobble.w_x
    D[107] = bar_wobble_xz*cos_phi + bar_wobble_yz*sin_phi - bar_wobble_zx*cos_phi - bar_wobble_zy*sin_phi  # spin-axis-wobble.w_y
    D[108] = bar_sin_delta_phi  # spin-phase-offset.phi_0
    D[109] = bar_sin_delta_phi  # spin-rate-jitter.sigma_phi
    D[110] = bar_sin_delta_phi  # spin-rate-jitter.sigma_walk
    D[111] = bar_sin_delta_phi*d_spin_angle*time + bar_spin_acceleration_true*x37 + bar_spin_rate_true*(d2_spin_angle*time + d_spin_angle)  # spin-rate-offset.epsilon
    D[112] = bar_i_vibration_rectification*x190  # thermal-bias.dK0_dT
    D[113] = bar_i_vibration_rectification*d_temperature  # thermal-lag.dK0_dTdot
    D[114] = d_temperature*x151  # thermal-lag.dK1_dTdot
    D[115] = x151*x190  # thermal-scale.dK1_dT
    D[116] = x119 + x120 + x121 + x122 + x123 + x124 + x125 + x126 + x127  # time-offset.delta_t
    D[117] = bar_i_vibration_rectification*(K2*vibration_axis_ix**2.0 + K5*vibration_axis_ox**2.0 + K7*vibration_axis_px**2.0 + vibration_axis_ox*x192 + vibration_axis_px*x191 + vibration_axis_px*x193)  # vibration-rectification.P_xx
    D[118] = bar_i_vibration_rectification*(vibration_axis_iy*x194 + vibration_axis_iy*x195 + vibration_axis_iy*x197 + vibration_axis_oy*x192 + vibration_axis_oy*x196 + vibration_axis_oy*x198 + vibration_axis_py*x191 + vibration_axis_py*x193 + vibration_axis_py*x199)  # vibration-rectification.P_xy
    D[119] = bar_i_vibration_rectification*(vibration_axis_iz*x194 + vibration_axis_iz*x195 + vibration_axis_iz*x197 + vibration_axis_oz*x192 + vibration_axis_oz*x196 + vibration_axis_oz*x198 + vibration_axis_pz*x191 + vibration_axis_pz*x193 + vibration_axis_pz*x199)  # vibration-rectification.P_xz
    D[120] = bar_i_vibration_rectification*(K2*vibration_axis_iy**2.0 + K5*vibration_axis_oy**2.0 + K7*vibration_axis_py**2.0 + vibration_axis_oy*x201 + vibration_axis_py*x200 + vibration_axis_py*x202)  # vibration-rectification.P_yy
    D[121] = bar_i_vibration_rectification*(vibration_axis_iy*vibration_axis_iz*x81 + vibration_axis_oy*vibration_axis_oz*x82 + vibration_axis_oy*x204 + vibration_axis_oz*x201 + vibration_axis_py*vibration_axis_pz*x83 + vibration_axis_py*x203 + vibration_axis_py*x205 + vibration_axis_pz*x200 + vibration_axis_pz*x202)  # vibration-rectification.P_yz
    D[122] = bar_i_vibration_rectification*(K2*vibration_axis_iz**2.0 + K5*vibration_axis_oz**2.0 + K7*vibration_axis_pz**2.0 + vibration_axis_oz*x204 + vibration_axis_pz*x203 + vibration_axis_pz*x205)  # vibration-rectification.P_zz
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
