"""Signatures: what each candidate effect would add to V_j.

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: anisoinertia, arm-sag, arm-stretch, bias-drift, bias-step, clock-drift, cubic-cross, cubic-input, disc-spin, encoder-harmonic, gain-drift, gain-step, gradient-offset, gyro-bias, gyro-delay, gyro-g-sensitivity, gyro-scale, imu-acceleration-bias, imu-acceleration-misalignment, imu-acceleration-scale, imu-lever-arm, imu-misalignment, lag, magnetic-bias, mount-compliance, near-mass, odd-quadratic, output-filter, output-gain-step, pendulum-angular, pressure-bias, second-order-misalignment, self-gradient, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, spin-rate-offset, thermal-bias, thermal-lag, thermal-scale, time-offset, vibration-rectification.
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
    ("disc-spin.share", True),
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
    x0 = omega_y**2.0
    x1 = omega_z**2.0
    x2 = x0 + x1
    M_xx = -Gamma_xx - x2
    x3 = omega_x*omega_y
    M_xy = -Gamma_xy - omegadot_z + x3
    x4 = omega_x*omega_z
    x5 = omegadot_y + x4
    M_xz = -Gamma_xz + x5
    x6 = omegadot_z + x3
    M_yx = -Gamma_xy + x6
    x7 = omega_x**2.0
    x8 = x1 + x7
    M_yy = -Gamma_yy - x8
    x9 = omega_y*omega_z
    M_yz = -Gamma_yz - omegadot_x + x9
    M_zx = -Gamma_xz - omegadot_y + x4
    x10 = omegadot_x + x9
    M_zy = -Gamma_yz + x10
    x11 = x0 + x7
    M_zz = -Gamma_zz - x11
    cos_psi = cos_j*cos_phi - sin_j*sin_phi
    sin_psi = cos_j*sin_phi + cos_phi*sin_j
    x12 = dR + radius
    b_disc_r_x = x12
    x13 = beta_z*x12
    b_disc_r_y = x13
    x14 = beta_x*x12
    b_disc_r_z = x14
    x15 = -beta_x*beta_z
    b_disc_tau_zy = x15
    b_r_x = b_disc_r_x*cos_psi - b_disc_r_y*sin_psi
    b_r_y = b_disc_r_x*sin_psi + b_disc_r_y*cos_psi
    x16 = beta_z*cos_psi + sin_psi
    x17 = -x16
    b_tau_xx = x17
    x18 = -beta_z*sin_psi + cos_psi
    b_tau_xy = x18
    b_tau_yx = x18
    b_tau_yy = x16
    x19 = beta_x*cos_psi
    b_tau_zx = -b_disc_tau_zy*sin_psi - x19
    x20 = beta_x*sin_psi
    b_tau_zy = b_disc_tau_zy*cos_psi - x20
    x21 = 2.0*omega_z
    x22 = -d_spin_angle**2.0 - d_spin_angle*x21
    spin_xx = x22
    spin_yy = x22
    x23 = d_spin_angle*omega_x
    spin_zx = 2.0*x23
    x24 = d_spin_angle*omega_y
    spin_zy = 2.0*x24
    b_f_x = M_xx*b_r_x + M_xy*b_r_y + M_xz*b_disc_r_z + a_x
    b_f_y = M_yx*b_r_x + M_yy*b_r_y + M_yz*b_disc_r_z + a_y
    b_f_z = M_zx*b_r_x + M_zy*b_r_y + M_zz*b_disc_r_z + a_z
    b_f_xj = b_f_x*b_tau_xx + b_f_y*b_tau_xy
    b_f_yj = b_f_x*b_tau_yx + b_f_y*b_tau_yy - b_f_z*beta_x
    b_f_zj = b_f_x*b_tau_zx + b_f_y*b_tau_zy - b_f_z
    f_disc_r_x = x12
    f_disc_r_y = x13
    f_disc_r_z = x14
    f_disc_tau_zy = x15
    f_r_x = cos_psi*f_disc_r_x - f_disc_r_y*sin_psi
    f_r_y = cos_psi*f_disc_r_y + f_disc_r_x*sin_psi
    f_tau_xx = x17
    f_tau_xy = x18
    f_tau_yx = x18
    f_tau_yy = x16
    f_tau_zx = -f_disc_tau_zy*sin_psi - x19
    f_tau_zy = cos_psi*f_disc_tau_zy - x20
    x25 = x12**(-1.0)
    f_arm_x = f_r_x*x25
    f_arm_y = f_r_y*x25
    f_arm_z = f_disc_r_z*x25
    x26 = 2.0*omega_y
    x27 = omegadot_y*x26
    x28 = omegadot_z*x21
    x29 = -x27 - x28
    rate_M_xx = x29
    x30 = omega_x*omegadot_y + omega_y*omegadot_x
    x31 = -d_omegadot_z + x30
    rate_M_xy = x31
    x32 = omega_x*omegadot_z + omega_z*omegadot_x
    x33 = d_omegadot_y + x32
    rate_M_xz = x33
    x34 = 2.0*sin_phi
    x35 = np.pi*spin_frequency
    x36 = -x34*x35
    rate_cos_phi_true = x36
    x37 = 2.0*x35
    x38 = cos_phi*x37
    rate_sin_phi_true = x38
    rate_cos_psi = cos_j*rate_cos_phi_true - rate_sin_phi_true*sin_j
    rate_sin_psi = cos_j*rate_sin_phi_true + rate_cos_phi_true*sin_j
    rate_b_r_x = b_disc_r_x*rate_cos_psi - b_disc_r_y*rate_sin_psi
    rate_b_r_y = b_disc_r_x*rate_sin_psi + b_disc_r_y*rate_cos_psi
    rate_b_f_x = M_xx*rate_b_r_x + M_xy*rate_b_r_y + b_disc_r_z*rate_M_xz + b_r_x*rate_M_xx + b_r_y*rate_M_xy + d_a_x
    x39 = d_omegadot_z + x30
    rate_M_yx = x39
    x40 = 2.0*omegadot_x
    x41 = omega_x*x40
    x42 = -x28 - x41
    rate_M_yy = x42
    x43 = omega_y*omegadot_z + omega_z*omegadot_y
    x44 = -d_omegadot_x + x43
    rate_M_yz = x44
    rate_b_f_y = M_yx*rate_b_r_x + M_yy*rate_b_r_y + b_disc_r_z*rate_M_yz + b_r_x*rate_M_yx + b_r_y*rate_M_yy + d_a_y
    x45 = -d_omegadot_y + x32
    rate_M_zx = x45
    x46 = d_omegadot_x + x43
    rate_M_zy = x46
    x47 = -x27 - x41
    rate_M_zz = x47
    rate_b_f_z = M_zx*rate_b_r_x + M_zy*rate_b_r_y + b_disc_r_z*rate_M_zz + b_r_x*rate_M_zx + b_r_y*rate_M_zy + d_a_z
    rate_b_tau_yx = -beta_z*rate_sin_psi + rate_cos_psi
    rate_b_tau_yy = beta_z*rate_cos_psi + rate_sin_psi
    rate_b_f_yj = b_f_x*rate_b_tau_yx + b_f_y*rate_b_tau_yy + b_tau_yx*rate_b_f_x + b_tau_yy*rate_b_f_y - beta_x*rate_b_f_z
    rate_b_tau_zx = -b_disc_tau_zy*rate_sin_psi - beta_x*rate_cos_psi
    rate_b_tau_zy = b_disc_tau_zy*rate_cos_psi - beta_x*rate_sin_psi
    rate_b_f_zj = b_f_x*rate_b_tau_zx + b_f_y*rate_b_tau_zy + b_tau_zx*rate_b_f_x + b_tau_zy*rate_b_f_y - rate_b_f_z
    x48 = d_omegadot_z*x21 + 2.0*omegadot_z**2.0
    x49 = d_omegadot_y*x26 + 2.0*omegadot_y**2.0
    x50 = -x48 - x49
    rate_rate_M_xx = x50
    x51 = d_omegadot_x*omega_y + d_omegadot_y*omega_x + omegadot_y*x40
    x52 = -d2_omegadot_z + x51
    rate_rate_M_xy = x52
    x53 = d_omegadot_x*omega_z + d_omegadot_z*omega_x + omegadot_z*x40
    x54 = d2_omegadot_y + x53
    rate_rate_M_xz = x54
    x55 = 4.0*cos_phi
    x56 = np.pi**2.0*spin_frequency**2.0
    x57 = -x55*x56
    rate_rate_cos_phi_true = x57
    x58 = 4.0*sin_phi
    x59 = -x56*x58
    rate_rate_sin_phi_true = x59
    rate_rate_cos_psi = cos_j*rate_rate_cos_phi_true - rate_rate_sin_phi_true*sin_j
    rate_rate_sin_psi = cos_j*rate_rate_sin_phi_true + rate_rate_cos_phi_true*sin_j
    rate_rate_b_r_x = b_disc_r_x*rate_rate_cos_psi - b_disc_r_y*rate_rate_sin_psi
    rate_rate_b_r_y = b_disc_r_x*rate_rate_sin_psi + b_disc_r_y*rate_rate_cos_psi
    x60 = 2.0*rate_b_r_x
    x61 = 2.0*rate_b_r_y
    rate_rate_b_f_x = M_xx*rate_rate_b_r_x + M_xy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_xz + b_r_x*rate_rate_M_xx + b_r_y*rate_rate_M_xy + d2_a_x + rate_M_xx*x60 + rate_M_xy*x61
    x62 = d2_omegadot_z + x51
    rate_rate_M_yx = x62
    x63 = 2.0*omega_x
    x64 = d_omegadot_x*x63 + 2.0*omegadot_x**2.0
    x65 = -x48 - x64
    rate_rate_M_yy = x65
    x66 = d_omegadot_y*omega_z + d_omegadot_z*omega_y + 2.0*omegadot_y*omegadot_z
    x67 = -d2_omegadot_x + x66
    rate_rate_M_yz = x67
    rate_rate_b_f_y = M_yx*rate_rate_b_r_x + M_yy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_yz + b_r_x*rate_rate_M_yx + b_r_y*rate_rate_M_yy + d2_a_y + rate_M_yx*x60 + rate_M_yy*x61
    x68 = -d2_omegadot_y + x53
    rate_rate_M_zx = x68
    x69 = d2_omegadot_x + x66
    rate_rate_M_zy = x69
    x70 = -x49 - x64
    rate_rate_M_zz = x70
    rate_rate_b_f_z = M_zx*rate_rate_b_r_x + M_zy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_zz + b_r_x*rate_rate_M_zx + b_r_y*rate_rate_M_zy + d2_a_z + rate_M_zx*x60 + rate_M_zy*x61
    rate_rate_b_tau_yx = -beta_z*rate_rate_sin_psi + rate_rate_cos_psi
    rate_rate_b_tau_yy = beta_z*rate_rate_cos_psi + rate_rate_sin_psi
    x71 = 2.0*rate_b_f_x
    x72 = 2.0*rate_b_f_y
    rate_rate_b_f_yj = b_f_x*rate_rate_b_tau_yx + b_f_y*rate_rate_b_tau_yy + b_tau_yx*rate_rate_b_f_x + b_tau_yy*rate_rate_b_f_y - beta_x*rate_rate_b_f_z + rate_b_tau_yx*x71 + rate_b_tau_yy*x72
    rate_rate_b_tau_zx = -b_disc_tau_zy*rate_rate_sin_psi - beta_x*rate_rate_cos_psi
    rate_rate_b_tau_zy = b_disc_tau_zy*rate_rate_cos_psi - beta_x*rate_rate_sin_psi
    rate_rate_b_f_zj = b_f_x*rate_rate_b_tau_zx + b_f_y*rate_rate_b_tau_zy + b_tau_zx*rate_rate_b_f_x + b_tau_zy*rate_rate_b_f_y + rate_b_tau_zx*x71 + rate_b_tau_zy*x72 - rate_rate_b_f_z
    f_f_x = M_xx*f_r_x + M_xy*f_r_y + M_xz*f_disc_r_z + a_x
    f_f_y = M_yx*f_r_x + M_yy*f_r_y + M_yz*f_disc_r_z + a_y
    f_f_z = M_zx*f_r_x + M_zy*f_r_y + M_zz*f_disc_r_z + a_z
    f_f_xj = f_f_x*f_tau_xx + f_f_y*f_tau_xy
    f_f_yj = -beta_x*f_f_z + f_f_x*f_tau_yx + f_f_y*f_tau_yy
    f_f_zj = f_f_x*f_tau_zx + f_f_y*f_tau_zy - f_f_z
    f_f_i = f_f_xj + f_f_yj*vartheta_z - f_f_zj*vartheta_y
    f_f_o = -f_f_xj*vartheta_z + f_f_yj + f_f_zj*vartheta_x
    f_f_p = f_f_xj*vartheta_y - f_f_yj*vartheta_x + f_f_zj
    q_disc_r_x = x12
    q_r_x = cos_psi*q_disc_r_x
    q_r_y = q_disc_r_x*sin_psi
    q_arm_x = q_r_x*x25
    q_arm_y = q_r_y*x25
    q_f_x = M_xx*q_r_x + M_xy*q_r_y + a_x
    q_f_y = M_yx*q_r_x + M_yy*q_r_y + a_y
    q_f_z = M_zx*q_r_x + M_zy*q_r_y + a_z
    q_f_xj = cos_psi*q_f_y - q_f_x*sin_psi
    q_f_yj = cos_psi*q_f_x + q_f_y*sin_psi
    x73 = K6*q_f_yj
    x74 = K4*q_f_z
    x75 = K8*q_f_z
    i_sensed = K0 + K2*q_f_xj**2.0 + K5*q_f_yj**2.0 + K7*q_f_z**2.0 + f_f_i + q_f_xj*x73 - q_f_xj*x74 - q_f_yj*x75
    V2__rate_M_xx = x29
    V2__rate_M_xy = x31
    V2__rate_M_xz = x33
    V2__rate_cos_phi_true = x36
    V2__rate_sin_phi_true = x38
    V2__rate_cos_psi = V2__rate_cos_phi_true*cos_j - V2__rate_sin_phi_true*sin_j
    V2__rate_sin_psi = V2__rate_cos_phi_true*sin_j + V2__rate_sin_phi_true*cos_j
    rate_f_r_x = V2__rate_cos_psi*f_disc_r_x - V2__rate_sin_psi*f_disc_r_y
    rate_f_r_y = V2__rate_cos_psi*f_disc_r_y + V2__rate_sin_psi*f_disc_r_x
    rate_f_f_x = M_xx*rate_f_r_x + M_xy*rate_f_r_y + V2__rate_M_xx*f_r_x + V2__rate_M_xy*f_r_y + V2__rate_M_xz*f_disc_r_z + d_a_x
    V2__rate_M_yx = x39
    V2__rate_M_yy = x42
    V2__rate_M_yz = x44
    rate_f_f_y = M_yx*rate_f_r_x + M_yy*rate_f_r_y + V2__rate_M_yx*f_r_x + V2__rate_M_yy*f_r_y + V2__rate_M_yz*f_disc_r_z + d_a_y
    x76 = V2__rate_cos_psi*beta_z + V2__rate_sin_psi
    rate_f_tau_xx = -x76
    x77 = V2__rate_cos_psi - V2__rate_sin_psi*beta_z
    rate_f_tau_xy = x77
    rate_f_f_xj = f_f_x*rate_f_tau_xx + f_f_y*rate_f_tau_xy + f_tau_xx*rate_f_f_x + f_tau_xy*rate_f_f_y
    V2__rate_M_zx = x45
    V2__rate_M_zy = x46
    V2__rate_M_zz = x47
    rate_f_f_z = M_zx*rate_f_r_x + M_zy*rate_f_r_y + V2__rate_M_zx*f_r_x + V2__rate_M_zy*f_r_y + V2__rate_M_zz*f_disc_r_z + d_a_z
    rate_f_tau_yx = x77
    rate_f_tau_yy = x76
    rate_f_f_yj = -beta_x*rate_f_f_z + f_f_x*rate_f_tau_yx + f_f_y*rate_f_tau_yy + f_tau_yx*rate_f_f_x + f_tau_yy*rate_f_f_y
    rate_f_tau_zx = -V2__rate_cos_psi*beta_x - V2__rate_sin_psi*f_disc_tau_zy
    rate_f_tau_zy = V2__rate_cos_psi*f_disc_tau_zy - V2__rate_sin_psi*beta_x
    rate_f_f_zj = f_f_x*rate_f_tau_zx + f_f_y*rate_f_tau_zy + f_tau_zx*rate_f_f_x + f_tau_zy*rate_f_f_y - rate_f_f_z
    rate_f_f_i = rate_f_f_xj + rate_f_f_yj*vartheta_z - rate_f_f_zj*vartheta_y
    rate_V2__rate_M_xx = x50
    rate_V2__rate_M_xy = x52
    rate_V2__rate_M_xz = x54
    rate_V2__rate_cos_phi_true = x57
    rate_V2__rate_sin_phi_true = x59
    rate_V2__rate_cos_psi = cos_j*rate_V2__rate_cos_phi_true - rate_V2__rate_sin_phi_true*sin_j
    rate_V2__rate_sin_psi = cos_j*rate_V2__rate_sin_phi_true + rate_V2__rate_cos_phi_true*sin_j
    rate_rate_f_r_x = f_disc_r_x*rate_V2__rate_cos_psi - f_disc_r_y*rate_V2__rate_sin_psi
    rate_rate_f_r_y = f_disc_r_x*rate_V2__rate_sin_psi + f_disc_r_y*rate_V2__rate_cos_psi
    x78 = 2.0*rate_f_r_x
    x79 = 2.0*rate_f_r_y
    rate_rate_f_f_x = M_xx*rate_rate_f_r_x + M_xy*rate_rate_f_r_y + V2__rate_M_xx*x78 + V2__rate_M_xy*x79 + d2_a_x + f_disc_r_z*rate_V2__rate_M_xz + f_r_x*rate_V2__rate_M_xx + f_r_y*rate_V2__rate_M_xy
    rate_V2__rate_M_yx = x62
    rate_V2__rate_M_yy = x65
    rate_V2__rate_M_yz = x67
    rate_rate_f_f_y = M_yx*rate_rate_f_r_x + M_yy*rate_rate_f_r_y + V2__rate_M_yx*x78 + V2__rate_M_yy*x79 + d2_a_y + f_disc_r_z*rate_V2__rate_M_yz + f_r_x*rate_V2__rate_M_yx + f_r_y*rate_V2__rate_M_yy
    x80 = beta_z*rate_V2__rate_cos_psi + rate_V2__rate_sin_psi
    rate_rate_f_tau_xx = -x80
    x81 = -beta_z*rate_V2__rate_sin_psi + rate_V2__rate_cos_psi
    rate_rate_f_tau_xy = x81
    x82 = 2.0*rate_f_f_x
    x83 = 2.0*rate_f_f_y
    rate_rate_f_f_xj = f_f_x*rate_rate_f_tau_xx + f_f_y*rate_rate_f_tau_xy + f_tau_xx*rate_rate_f_f_x + f_tau_xy*rate_rate_f_f_y + rate_f_tau_xx*x82 + rate_f_tau_xy*x83
    rate_V2__rate_M_zx = x68
    rate_V2__rate_M_zy = x69
    rate_V2__rate_M_zz = x70
    rate_rate_f_f_z = M_zx*rate_rate_f_r_x + M_zy*rate_rate_f_r_y + V2__rate_M_zx*x78 + V2__rate_M_zy*x79 + d2_a_z + f_disc_r_z*rate_V2__rate_M_zz + f_r_x*rate_V2__rate_M_zx + f_r_y*rate_V2__rate_M_zy
    rate_rate_f_tau_yx = x81
    rate_rate_f_tau_yy = x80
    rate_rate_f_f_yj = -beta_x*rate_rate_f_f_z + f_f_x*rate_rate_f_tau_yx + f_f_y*rate_rate_f_tau_yy + f_tau_yx*rate_rate_f_f_x + f_tau_yy*rate_rate_f_f_y + rate_f_tau_yx*x82 + rate_f_tau_yy*x83
    rate_rate_f_tau_zx = -beta_x*rate_V2__rate_cos_psi - f_disc_tau_zy*rate_V2__rate_sin_psi
    rate_rate_f_tau_zy = -beta_x*rate_V2__rate_sin_psi + f_disc_tau_zy*rate_V2__rate_cos_psi
    rate_rate_f_f_zj = f_f_x*rate_rate_f_tau_zx + f_f_y*rate_rate_f_tau_zy + f_tau_zx*rate_rate_f_f_x + f_tau_zy*rate_rate_f_f_y + rate_f_tau_zx*x82 + rate_f_tau_zy*x83 - rate_rate_f_f_z
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
    x84 = 2.0*rate_q_r_x
    x85 = 2.0*rate_q_r_y
    rate_rate_q_f_x = M_xx*rate_rate_q_r_x + M_xy*rate_rate_q_r_y + V2__rate_M_xx*x84 + V2__rate_M_xy*x85 + d2_a_x + q_r_x*rate_V2__rate_M_xx + q_r_y*rate_V2__rate_M_xy
    rate_rate_q_f_y = M_yx*rate_rate_q_r_x + M_yy*rate_rate_q_r_y + V2__rate_M_yx*x84 + V2__rate_M_yy*x85 + d2_a_y + q_r_x*rate_V2__rate_M_yx + q_r_y*rate_V2__rate_M_yy
    x86 = 2.0*rate_q_f_y
    x87 = 2.0*rate_q_f_x
    rate_rate_q_f_xj = V2__rate_cos_psi*x86 - V2__rate_sin_psi*x87 + cos_psi*rate_rate_q_f_y - q_f_x*rate_V2__rate_sin_psi + q_f_y*rate_V2__rate_cos_psi - rate_rate_q_f_x*sin_psi
    rate_rate_q_f_yj = V2__rate_cos_psi*x87 + V2__rate_sin_psi*x86 + cos_psi*rate_rate_q_f_x + q_f_x*rate_V2__rate_cos_psi + q_f_y*rate_V2__rate_sin_psi + rate_rate_q_f_y*sin_psi
    rate_rate_q_f_z = M_zx*rate_rate_q_r_x + M_zy*rate_rate_q_r_y + V2__rate_M_zx*x84 + V2__rate_M_zy*x85 + d2_a_z + q_r_x*rate_V2__rate_M_zx + q_r_y*rate_V2__rate_M_zy
    x88 = 2.0*K2
    x89 = 2.0*K5
    x90 = 2.0*K7
    x91 = q_f_xj*x88 + x73 - x74
    x92 = K6*q_f_xj + q_f_yj*x89 - x75
    x93 = K4*q_f_xj + K8*q_f_yj - q_f_z*x90
    rate_rate_i_sensed = rate_q_f_xj*(-K4*rate_q_f_z + K6*rate_q_f_yj + rate_q_f_xj*x88) + rate_q_f_yj*(K6*rate_q_f_xj - K8*rate_q_f_z + rate_q_f_yj*x89) - rate_q_f_z*(K4*rate_q_f_xj + K8*rate_q_f_yj - rate_q_f_z*x90) + rate_rate_f_f_i + rate_rate_q_f_xj*x91 + rate_rate_q_f_yj*x92 - rate_rate_q_f_z*x93
    x94 = f_tau_xx + f_tau_yx*vartheta_z - f_tau_zx*vartheta_y
    vibration_axis_ix = x94
    x95 = f_tau_xy + f_tau_yy*vartheta_z - f_tau_zy*vartheta_y
    vibration_axis_iy = x95
    x96 = -beta_x*vartheta_z + vartheta_y
    vibration_axis_iz = x96
    vibration_axis_ox = -f_tau_xx*vartheta_z + f_tau_yx + f_tau_zx*vartheta_x
    vibration_axis_oy = -f_tau_xy*vartheta_z + f_tau_yy + f_tau_zy*vartheta_x
    vibration_axis_oz = -beta_x - vartheta_x
    vibration_axis_px = f_tau_xx*vartheta_y - f_tau_yx*vartheta_x + f_tau_zx
    vibration_axis_py = f_tau_xy*vartheta_y - f_tau_yy*vartheta_x + f_tau_zy
    vibration_axis_pz = beta_x*vartheta_x - 1
    bar_i_vibration_rectification = K1*k_VI
    bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x93
    bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x92
    bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x91
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
    x97 = d_spin_angle + omega_z
    x98 = 2.0*x97
    bar_rate_dR_arm_stretch = bar_f_f_x*(-f_arm_y*x98 + 2.0*f_arm_z*omega_y) + bar_f_f_y*(f_arm_x*x98 - f_arm_z*x63) + bar_f_f_z*(-f_arm_x*x26 + 2.0*f_arm_y*omega_x) - bar_q_f_x*q_arm_y*x98 + bar_q_f_y*q_arm_x*x98 - bar_q_p_second_order_misalignment*(-q_arm_x*x26 + q_arm_y*x63)
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
    x99 = bar_f_f_z*f_disc_r_z
    bar_M_zz = x99
    x100 = bar_f_f_z*f_r_y
    x101 = bar_q_p_second_order_misalignment*q_r_y
    bar_M_zy = x100 - x101
    x102 = bar_q_p_second_order_misalignment*q_r_x
    bar_M_zx = bar_f_f_z*f_r_x - x102
    x103 = bar_f_f_y*f_disc_r_z
    bar_M_yz = x103
    x104 = bar_f_f_y*f_r_y
    x105 = bar_q_f_y*q_r_y
    bar_M_yy = x104 + x105
    x106 = bar_q_f_y*q_r_x
    bar_M_yx = bar_f_f_y*f_r_x + x106
    x107 = bar_f_f_x*f_disc_r_z
    bar_M_xz = x107
    x108 = bar_f_f_x*f_r_y
    x109 = bar_q_f_x*q_r_y
    bar_M_xy = x108 + x109
    x110 = bar_q_f_x*q_r_x
    bar_M_xx = bar_f_f_x*f_r_x + x110
    bar_sin_phi_true = -bar_cos_psi*sin_j + bar_sin_psi*cos_j
    bar_cos_phi_true = bar_cos_psi*cos_j + bar_sin_psi*sin_j
    bar_sin_delta_phi = -bar_cos_phi_true*sin_phi + bar_sin_phi_true*cos_phi
    bar_time_offset_omegadot_z = -bar_M_xy + bar_M_yx
    bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx
    bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy
    bar_time_offset_omega_z = -bar_M_xx*x21 + bar_M_xz*omega_x - bar_M_yy*x21 + bar_M_yz*omega_y + bar_M_zx*omega_x + bar_M_zy*omega_y
    bar_time_offset_omega_y = -bar_M_xx*x26 + bar_M_xy*omega_x + bar_M_yx*omega_x + bar_M_yz*omega_z + bar_M_zy*omega_z - bar_M_zz*x26
    bar_time_offset_omega_x = bar_M_xy*omega_y + bar_M_xz*omega_z + bar_M_yx*omega_y - bar_M_yy*x63 + bar_M_zx*omega_z - bar_M_zz*x63
    bar_time_offset_a_z = bar_f_f_z - bar_q_p_second_order_misalignment
    bar_time_offset_a_y = bar_f_f_y + bar_q_f_y
    bar_time_offset_a_x = bar_f_f_x + bar_q_f_x
    bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy
    bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx
    bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx
    x111 = a_y*bar_time_offset_a_z
    x112 = bar_time_offset_omega_z*omega_y
    x113 = bar_time_offset_omegadot_z*omegadot_y
    bar_imu_turn_zy = x111 + x112 + x113
    x114 = a_x*bar_time_offset_a_z
    x115 = bar_time_offset_omega_z*omega_x + bar_time_offset_omegadot_z*omegadot_x + x114
    bar_imu_turn_zx = x115
    x116 = a_z*bar_time_offset_a_y
    x117 = bar_time_offset_omega_y*omega_z + bar_time_offset_omegadot_y*omegadot_z + x116
    bar_imu_turn_yz = x117
    x118 = a_x*bar_time_offset_a_y
    bar_imu_turn_yx = bar_time_offset_omega_y*omega_x + bar_time_offset_omegadot_y*omegadot_x + x118
    x119 = a_z*bar_time_offset_a_x
    x120 = bar_time_offset_omega_x*omega_z
    x121 = bar_time_offset_omegadot_x*omegadot_z
    bar_imu_turn_xz = x119 + x120 + x121
    x122 = a_y*bar_time_offset_a_x
    bar_imu_turn_xy = bar_time_offset_omega_x*omega_y + bar_time_offset_omegadot_x*omegadot_y + x122
    x123 = bar_time_offset_a_x*d_a_x
    x124 = bar_time_offset_a_y*d_a_y
    x125 = bar_time_offset_a_z*d_a_z
    x126 = bar_time_offset_omega_x*omegadot_x
    x127 = bar_time_offset_omega_y*omegadot_y
    x128 = bar_time_offset_omega_z*omegadot_z
    x129 = bar_time_offset_omegadot_x*d_omegadot_x
    x130 = bar_time_offset_omegadot_y*d_omegadot_y
    x131 = bar_time_offset_omegadot_z*d_omegadot_z
    x132 = bar_i_vibration_rectification*f_f_i**2.0
    x133 = f_f_o**2.0
    x134 = bar_i_vibration_rectification*f_f_i
    x135 = f_f_p**2.0
    x136 = bar_sin_delta_phi*cos_phi
    x137 = cos_phi**2.0
    x138 = sin_phi**2.0
    x139 = cos_phi**3.0
    x140 = sin_phi**3.0
    x141 = K1*bar_K1_thermal_scale
    x142 = -bar_M_zz
    x143 = x126 + x127 + x128
    x144 = x129 + x130 + x131
    x145 = -x119
    x146 = -x111
    x147 = -omegadot_y
    x148 = f_r_x*x99
    x149 = 0.5*q_r_x**2.0
    x150 = 0.5*f_disc_r_z**2.0
    x151 = f_r_x**2.0
    x152 = 0.5*x151
    x153 = x150 - x152
    x154 = f_r_x*x107
    x155 = 0.5*q_r_y**2.0
    x156 = 0.5*f_r_y**2.0
    x157 = x150 - x156
    x158 = f_r_x*x103
    x159 = (1/6)*q_r_x**3.0
    x160 = f_r_x*x150
    x161 = -1/6*f_r_x**3.0 + x160
    x162 = f_disc_r_z**3.0
    x163 = (1/6)*x162
    x164 = -0.5*f_disc_r_z*x151 + x163
    x165 = f_r_y*x148
    x166 = f_r_y*x150
    x167 = -f_r_y*x152 + x166
    x168 = -f_r_x*x156 + x160
    x169 = f_disc_r_z*x156
    x170 = (1/6)*q_r_y**3.0
    x171 = -1/6*f_r_y**3.0 + x166
    x172 = x163 - x169
    x173 = np.sin(roll)
    x174 = -bar_M_zz*x173
    x175 = np.sin(pitch)
    x176 = -bar_M_zz*x175
    x177 = -Gamma_zz
    x178 = 2.0*Gamma_yz
    x179 = 2.0*Gamma_xz
    x180 = temperature - 293.15
    x181 = K4*vibration_axis_ix
    x182 = K6*vibration_axis_ix
    x183 = K8*vibration_axis_ox
    x184 = K4*vibration_axis_px
    x185 = K6*vibration_axis_ox
    x186 = K8*vibration_axis_px
    x187 = vibration_axis_ix*x88
    x188 = vibration_axis_ox*x89
    x189 = vibration_axis_px*x90
    x190 = K4*vibration_axis_iy
    x191 = K6*vibration_axis_iy
    x192 = K8*vibration_axis_oy
    x193 = K4*vibration_axis_iz
    x194 = K6*vibration_axis_iz
    x195 = K8*vibration_axis_oz

    D = np.empty((len(ROWS), len(time)))
    D[0] = bar_i_vibration_rectification*(f_tau_xx*omega_x + f_tau_xy*omega_y)*(f_tau_zx*omega_x + f_tau_zy*omega_y - x97)  # anisoinertia.K_ip
    D[1] = b_f_zj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_zj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_zj  # arm-sag.c_z
    D[2] = b_f_yj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_yj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_yj  # arm-stretch.c_r
    D[3] = bar_i_vibration_rectification*time  # bias-drift.dK0_dt
    D[4] = bar_i_vibration_rectification  # bias-step.dK0
    D[5] = time*x123 + time*x124 + time*x125 + time*x126 + time*x127 + time*x128 + time*x129 + time*x130 + time*x131  # clock-drift.epsilon
    D[6] = f_f_o*x132  # cubic-cross.K_iio
    D[7] = f_f_p*x132  # cubic-cross.K_iip
    D[8] = x133*x134  # cubic-cross.K_ioo
    D[9] = f_f_o*f_f_p*x134  # cubic-cross.K_iop
    D[10] = x134*x135  # cubic-cross.K_ipp
    D[11] = bar_i_vibration_rectification*f_f_o**3.0  # cubic-cross.K_ooo
    D[12] = bar_i_vibration_rectification*f_f_p*x133  # cubic-cross.K_oop
    D[13] = bar_i_vibration_rectification*f_f_o*x135  # cubic-cross.K_opp
    D[14] = bar_i_vibration_rectification*f_f_p**3.0  # cubic-cross.K_ppp
    D[15] = bar_i_vibration_rectification*f_f_i**3.0  # cubic-input.K_iii
    D[16] = bar_f_f_x*(-d2_spin_angle*f_r_y + f_r_x*spin_xx) + bar_f_f_y*(d2_spin_angle*f_r_x + f_r_y*spin_yy) + bar_f_f_z*(f_r_x*spin_zx + f_r_y*spin_zy) + bar_q_f_x*(-d2_spin_angle*q_r_y + q_r_x*spin_xx) + bar_q_f_y*(d2_spin_angle*q_r_x + q_r_y*spin_yy) - bar_q_p_second_order_misalignment*(q_r_x*spin_zx + q_r_y*spin_zy)  # disc-spin.share
    D[17] = x136  # encoder-harmonic.c_1
    D[18] = bar_sin_delta_phi*sin_phi  # encoder-harmonic.s_1
    D[19] = bar_sin_delta_phi*(x137 - x138)  # encoder-harmonic.c_2
    D[20] = x136*x34  # encoder-harmonic.s_2
    D[21] = bar_sin_delta_phi*(-3.0*cos_phi*x138 + x139)  # encoder-harmonic.c_3
    D[22] = bar_sin_delta_phi*(3.0*sin_phi*x137 - x140)  # encoder-harmonic.s_3
    D[23] = bar_sin_delta_phi*(cos_phi**4.0 + sin_phi**4.0 - 6.0*x137*x138)  # encoder-harmonic.c_4
    D[24] = bar_sin_delta_phi*(x139*x58 - x140*x55)  # encoder-harmonic.s_4
    D[25] = time*x141  # gain-drift.dK1_dt
    D[26] = x141  # gain-step.dK1
    D[27] = -bar_M_xx - x142  # gradient-offset.G_xx
    D[28] = bar_spin_axis_tilt_Gamma_xy  # gradient-offset.G_xy
    D[29] = bar_spin_axis_tilt_Gamma_xz  # gradient-offset.G_xz
    D[30] = -bar_M_yy - x142  # gradient-offset.G_yy
    D[31] = bar_spin_axis_tilt_Gamma_yz  # gradient-offset.G_yz
    D[32] = -bar_time_offset_omega_x  # gyro-bias.b_x
    D[33] = -bar_time_offset_omega_y  # gyro-bias.b_y
    D[34] = -bar_time_offset_omega_z  # gyro-bias.b_z
    D[35] = x143  # gyro-delay.delta_w
    D[36] = x144  # gyro-delay.delta_d
    D[37] = -a_x*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_x  # gyro-g-sensitivity.d_xx
    D[38] = -a_y*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_y  # gyro-g-sensitivity.d_xy
    D[39] = -a_z*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_z  # gyro-g-sensitivity.d_xz
    D[40] = -a_x*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_x  # gyro-g-sensitivity.d_yx
    D[41] = -a_y*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_y  # gyro-g-sensitivity.d_yy
    D[42] = -a_z*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_z  # gyro-g-sensitivity.d_yz
    D[43] = -a_x*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_x  # gyro-g-sensitivity.d_zx
    D[44] = -a_y*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_y  # gyro-g-sensitivity.d_zy
    D[45] = -a_z*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_z  # gyro-g-sensitivity.d_zz
    D[46] = -bar_time_offset_omega_x*omega_x - bar_time_offset_omegadot_x*omegadot_x  # gyro-scale.s_x
    D[47] = -bar_time_offset_omega_y*omega_y - bar_time_offset_omegadot_y*omegadot_y  # gyro-scale.s_y
    D[48] = -bar_time_offset_omega_z*omega_z - bar_time_offset_omegadot_z*omegadot_z  # gyro-scale.s_z
    D[49] = -bar_time_offset_a_x  # imu-acceleration-bias.b_x
    D[50] = -bar_time_offset_a_y  # imu-acceleration-bias.b_y
    D[51] = -bar_time_offset_a_z  # imu-acceleration-bias.b_z
    D[52] = -x122  # imu-acceleration-misalignment.m_xy
    D[53] = x145  # imu-acceleration-misalignment.m_xz
    D[54] = -x118  # imu-acceleration-misalignment.m_yx
    D[55] = -x116  # imu-acceleration-misalignment.m_yz
    D[56] = -x114  # imu-acceleration-misalignment.m_zx
    D[57] = x146  # imu-acceleration-misalignment.m_zy
    D[58] = -a_x*bar_time_offset_a_x  # imu-acceleration-scale.s_x
    D[59] = -a_y*bar_time_offset_a_y  # imu-acceleration-scale.s_y
    D[60] = -a_z*bar_time_offset_a_z  # imu-acceleration-scale.s_z
    D[61] = bar_time_offset_a_x*x2 - bar_time_offset_a_y*x6 + bar_time_offset_a_z*(-x147 - x4)  # imu-lever-arm.l_x
    D[62] = bar_time_offset_a_x*(omegadot_z - x3) + bar_time_offset_a_y*x8 - bar_time_offset_a_z*x10  # imu-lever-arm.l_y
    D[63] = -bar_time_offset_a_x*x5 + bar_time_offset_a_y*(omegadot_x - x9) + bar_time_offset_a_z*x11  # imu-lever-arm.l_z
    D[64] = -bar_imu_turn_yz + bar_imu_turn_zy  # imu-misalignment.e_x
    D[65] = bar_imu_turn_xz - bar_imu_turn_zx  # imu-misalignment.e_y
    D[66] = -bar_imu_turn_xy + bar_imu_turn_yx  # imu-misalignment.e_z
    D[67] = -bar_i_vibration_rectification*rate_f_f_i  # lag.tau
    D[68] = bar_i_vibration_rectification*(B_x*x94 + B_y*x95 + B_z*x96)  # magnetic-bias.dK0_dB
    D[69] = b_f_xj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yx
    D[70] = b_f_yj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yy
    D[71] = b_f_zj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yz
    D[72] = b_f_xj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zx
    D[73] = b_f_yj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zy
    D[74] = b_f_zj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zz
    D[75] = bar_f_f_x*x153 - bar_q_f_x*x149 + x148  # near-mass.T_xxx
    D[76] = bar_f_f_y*x153 + bar_f_f_z*f_disc_r_z*f_r_y - bar_q_f_y*x149 - f_r_x*x108 - q_r_x*x109  # near-mass.T_xxy
    D[77] = bar_f_f_z*x153 + bar_q_p_second_order_misalignment*x149 - x154  # near-mass.T_xxz
    D[78] = bar_f_f_x*x157 + bar_f_f_z*f_disc_r_z*f_r_x - bar_q_f_x*x155 - f_r_x*x104 - q_r_x*x105  # near-mass.T_xyy
    D[79] = bar_q_p_second_order_misalignment*q_r_x*q_r_y - f_r_x*x100 - f_r_y*x107 - x158  # near-mass.T_xyz
    D[80] = bar_f_f_y*x157 - bar_q_f_y*x155 + f_r_y*x99  # near-mass.T_yyy
    D[81] = bar_f_f_z*x157 + bar_q_p_second_order_misalignment*x155 - f_r_y*x103  # near-mass.T_yyz
    D[82] = bar_f_f_x*x161 - bar_f_f_z*x164 - bar_q_f_x*x159  # near-mass.T_xxxx
    D[83] = bar_f_f_x*x167 + bar_f_f_y*x161 - bar_q_f_y*x159 - x109*x149 + x165  # near-mass.T_xxxy
    D[84] = bar_f_f_x*x164 + bar_f_f_z*x161 + bar_q_p_second_order_misalignment*x159  # near-mass.T_xxxz
    D[85] = bar_f_f_x*x168 + bar_f_f_y*x167 + bar_f_f_z*(f_disc_r_z*x152 - 1/3*x162 + x169) - x105*x149 - x110*x155  # near-mass.T_xxyy
    D[86] = bar_f_f_y*x164 + bar_f_f_z*x167 - f_r_y*x154 + x101*x149  # near-mass.T_xxyz
    D[87] = bar_f_f_x*x171 + bar_f_f_y*x168 - bar_q_f_x*x170 - x106*x155 + x165  # near-mass.T_xyyy
    D[88] = bar_f_f_x*x172 + bar_f_f_z*x168 - f_r_y*x158 + x102*x155  # near-mass.T_xyyz
    D[89] = bar_f_f_y*x171 - bar_f_f_z*x172 - bar_q_f_y*x170  # near-mass.T_yyyy
    D[90] = bar_f_f_y*x172 + bar_f_f_z*x171 + bar_q_p_second_order_misalignment*x170  # near-mass.T_yyyz
    D[91] = x134*np.abs(f_f_i)  # odd-quadratic.K_oq
    D[92] = bar_i_vibration_rectification*rate_rate_i_sensed  # output-filter.b
    D[93] = bar_i_vibration_rectification*i_sensed  # output-gain-step.g
    D[94] = bar_i_vibration_rectification*(-beta_x*(d2_spin_angle + omegadot_z) + f_tau_yx*(omegadot_x + x24) + f_tau_yy*(-x147 - x23))  # pendulum-angular.K_pa
    D[95] = bar_i_vibration_rectification*(pressure - 101325)  # pressure-bias.dK0_dp
    D[96] = bar_q_i_second_order_misalignment*(f_f_i - q_f_xj) + bar_q_o_second_order_misalignment*(f_f_o - q_f_yj) + bar_q_p_second_order_misalignment*(f_f_p + q_f_z)  # second-order-misalignment.kappa
    D[97] = -bar_M_xx*x173 - x174  # self-gradient.G_xx_roll
    D[98] = bar_spin_axis_tilt_Gamma_xy*x173  # self-gradient.G_xy_roll
    D[99] = bar_spin_axis_tilt_Gamma_xz*x173  # self-gradient.G_xz_roll
    D[100] = -bar_M_yy*x173 - x174  # self-gradient.G_yy_roll
    D[101] = bar_spin_axis_tilt_Gamma_yz*x173  # self-gradient.G_yz_roll
    D[102] = -bar_M_xx*x175 - x176  # self-gradient.G_xx_pitch
    D[103] = bar_spin_axis_tilt_Gamma_xy*x175  # self-gradient.G_xy_pitch
    D[104] = bar_spin_axis_tilt_Gamma_xz*x175  # self-gradient.G_xz_pitch
    D[105] = -bar_M_yy*x175 - x176  # self-gradient.G_yy_pitch
    D[106] = bar_spin_axis_tilt_Gamma_yz*x175  # self-gradient.G_yz_pitch
    D[107] = -Gamma_xy*bar_spin_axis_tilt_Gamma_xz + Gamma_xz*bar_spin_axis_tilt_Gamma_xy - bar_M_yy*x178 + bar_M_zz*x178 + bar_spin_axis_tilt_Gamma_yz*(-Gamma_yy - x177) - x112 - x113 + x117 + x146  # spin-axis-tilt.alpha_x
    D[108] = Gamma_xy*bar_spin_axis_tilt_Gamma_yz - Gamma_yz*bar_spin_axis_tilt_Gamma_xy + bar_M_xx*x179 - bar_M_zz*x179 + bar_spin_axis_tilt_Gamma_xz*(Gamma_xx + x177) + x115 - x120 - x121 + x145  # spin-axis-tilt.alpha_y
    D[109] = bar_wobble_xz*sin_phi - bar_wobble_yz*cos_phi - bar_wobble_zx*sin_phi + bar_wobble_zy*cos_phi  # spin-axis-wobble.w_x
    D[110] = bar_wobble_xz*cos_phi + bar_wobble_yz*sin_phi - bar_wobble_zx*cos_phi - bar_wobble_zy*sin_phi  # spin-axis-wobble.w_y
    D[111] = bar_sin_delta_phi  # spin-phase-offset.phi_0
    D[112] = bar_sin_delta_phi  # spin-rate-jitter.sigma_phi
    D[113] = bar_sin_delta_phi  # spin-rate-jitter.sigma_walk
    D[114] = bar_sin_delta_phi*time*x37  # spin-rate-offset.epsilon
    D[115] = bar_i_vibration_rectification*x180  # thermal-bias.dK0_dT
    D[116] = bar_i_vibration_rectification*d_temperature  # thermal-lag.dK0_dTdot
    D[117] = d_temperature*x141  # thermal-lag.dK1_dTdot
    D[118] = x141*x180  # thermal-scale.dK1_dT
    D[119] = x123 + x124 + x125 + x143 + x144  # time-offset.delta_t
    D[120] = bar_i_vibration_rectification*(K2*vibration_axis_ix**2.0 + K5*vibration_axis_ox**2.0 + K7*vibration_axis_px**2.0 + vibration_axis_ox*x182 + vibration_axis_px*x181 + vibration_axis_px*x183)  # vibration-rectification.P_xx
    D[121] = bar_i_vibration_rectification*(vibration_axis_iy*x184 + vibration_axis_iy*x185 + vibration_axis_iy*x187 + vibration_axis_oy*x182 + vibration_axis_oy*x186 + vibration_axis_oy*x188 + vibration_axis_py*x181 + vibration_axis_py*x183 + vibration_axis_py*x189)  # vibration-rectification.P_xy
    D[122] = bar_i_vibration_rectification*(vibration_axis_iz*x184 + vibration_axis_iz*x185 + vibration_axis_iz*x187 + vibration_axis_oz*x182 + vibration_axis_oz*x186 + vibration_axis_oz*x188 + vibration_axis_pz*x181 + vibration_axis_pz*x183 + vibration_axis_pz*x189)  # vibration-rectification.P_xz
    D[123] = bar_i_vibration_rectification*(K2*vibration_axis_iy**2.0 + K5*vibration_axis_oy**2.0 + K7*vibration_axis_py**2.0 + vibration_axis_oy*x191 + vibration_axis_py*x190 + vibration_axis_py*x192)  # vibration-rectification.P_yy
    D[124] = bar_i_vibration_rectification*(vibration_axis_iy*vibration_axis_iz*x88 + vibration_axis_oy*vibration_axis_oz*x89 + vibration_axis_oy*x194 + vibration_axis_oz*x191 + vibration_axis_py*vibration_axis_pz*x90 + vibration_axis_py*x193 + vibration_axis_py*x195 + vibration_axis_pz*x190 + vibration_axis_pz*x192)  # vibration-rectification.P_yz
    D[125] = bar_i_vibration_rectification*(K2*vibration_axis_iz**2.0 + K5*vibration_axis_oz**2.0 + K7*vibration_axis_pz**2.0 + vibration_axis_oz*x194 + vibration_axis_pz*x193 + vibration_axis_pz*x195)  # vibration-rectification.P_zz
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
