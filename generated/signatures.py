"""Signatures: what each candidate effect would add to V_j.

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: anisoinertia, arm-sag, arm-stretch, bias-drift, bias-step, clock-drift, cubic-cross, cubic-input, disc-spin, encoder-harmonic, gain-drift, gain-step, gradient-offset, gyro-bias, gyro-g-sensitivity, gyro-scale, imu-acceleration-bias, imu-acceleration-misalignment, imu-acceleration-scale, imu-lever-arm, imu-misalignment, lag, magnetic-bias, mount-compliance, near-mass, odd-quadratic, output-filter, output-gain-step, pendulum-angular, pressure-bias, second-order-misalignment, self-gradient, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, spin-rate-offset, thermal-bias, thermal-lag, thermal-scale, time-offset, vibration-rectification.
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
    rate_M_xx = -x27 - x28
    x29 = omega_x*omegadot_y + omega_y*omegadot_x
    rate_M_xy = -d_omegadot_z + x29
    x30 = omega_x*omegadot_z + omega_z*omegadot_x
    rate_M_xz = d_omegadot_y + x30
    x31 = 2.0*sin_phi
    x32 = np.pi*spin_frequency
    rate_cos_phi_true = -x31*x32
    x33 = 2.0*x32
    rate_sin_phi_true = cos_phi*x33
    rate_cos_psi = cos_j*rate_cos_phi_true - rate_sin_phi_true*sin_j
    rate_sin_psi = cos_j*rate_sin_phi_true + rate_cos_phi_true*sin_j
    rate_b_r_x = b_disc_r_x*rate_cos_psi - b_disc_r_y*rate_sin_psi
    rate_b_r_y = b_disc_r_x*rate_sin_psi + b_disc_r_y*rate_cos_psi
    rate_b_f_x = M_xx*rate_b_r_x + M_xy*rate_b_r_y + b_disc_r_z*rate_M_xz + b_r_x*rate_M_xx + b_r_y*rate_M_xy + d_a_x
    rate_M_yx = d_omegadot_z + x29
    x34 = 2.0*omegadot_x
    x35 = omega_x*x34
    rate_M_yy = -x28 - x35
    x36 = omega_y*omegadot_z + omega_z*omegadot_y
    rate_M_yz = -d_omegadot_x + x36
    rate_b_f_y = M_yx*rate_b_r_x + M_yy*rate_b_r_y + b_disc_r_z*rate_M_yz + b_r_x*rate_M_yx + b_r_y*rate_M_yy + d_a_y
    rate_M_zx = -d_omegadot_y + x30
    rate_M_zy = d_omegadot_x + x36
    rate_M_zz = -x27 - x35
    rate_b_f_z = M_zx*rate_b_r_x + M_zy*rate_b_r_y + b_disc_r_z*rate_M_zz + b_r_x*rate_M_zx + b_r_y*rate_M_zy + d_a_z
    x37 = -beta_z*rate_sin_psi + rate_cos_psi
    rate_b_tau_yx = x37
    x38 = beta_z*rate_cos_psi + rate_sin_psi
    rate_b_tau_yy = x38
    rate_b_f_yj = b_f_x*rate_b_tau_yx + b_f_y*rate_b_tau_yy + b_tau_yx*rate_b_f_x + b_tau_yy*rate_b_f_y - beta_x*rate_b_f_z
    x39 = beta_x*rate_cos_psi
    rate_b_tau_zx = -b_disc_tau_zy*rate_sin_psi - x39
    x40 = beta_x*rate_sin_psi
    rate_b_tau_zy = b_disc_tau_zy*rate_cos_psi - x40
    rate_b_f_zj = b_f_x*rate_b_tau_zx + b_f_y*rate_b_tau_zy + b_tau_zx*rate_b_f_x + b_tau_zy*rate_b_f_y - rate_b_f_z
    x41 = d_omegadot_z*x21 + 2.0*omegadot_z**2.0
    x42 = d_omegadot_y*x26 + 2.0*omegadot_y**2.0
    rate_rate_M_xx = -x41 - x42
    x43 = d_omegadot_x*omega_y + d_omegadot_y*omega_x + omegadot_y*x34
    rate_rate_M_xy = -d2_omegadot_z + x43
    x44 = d_omegadot_x*omega_z + d_omegadot_z*omega_x + omegadot_z*x34
    rate_rate_M_xz = d2_omegadot_y + x44
    x45 = 4.0*cos_phi
    x46 = np.pi**2.0*spin_frequency**2.0
    rate_rate_cos_phi_true = -x45*x46
    x47 = 4.0*sin_phi
    rate_rate_sin_phi_true = -x46*x47
    rate_rate_cos_psi = cos_j*rate_rate_cos_phi_true - rate_rate_sin_phi_true*sin_j
    rate_rate_sin_psi = cos_j*rate_rate_sin_phi_true + rate_rate_cos_phi_true*sin_j
    rate_rate_b_r_x = b_disc_r_x*rate_rate_cos_psi - b_disc_r_y*rate_rate_sin_psi
    rate_rate_b_r_y = b_disc_r_x*rate_rate_sin_psi + b_disc_r_y*rate_rate_cos_psi
    x48 = 2.0*rate_b_r_x
    x49 = 2.0*rate_b_r_y
    rate_rate_b_f_x = M_xx*rate_rate_b_r_x + M_xy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_xz + b_r_x*rate_rate_M_xx + b_r_y*rate_rate_M_xy + d2_a_x + rate_M_xx*x48 + rate_M_xy*x49
    rate_rate_M_yx = d2_omegadot_z + x43
    x50 = 2.0*omega_x
    x51 = d_omegadot_x*x50 + 2.0*omegadot_x**2.0
    rate_rate_M_yy = -x41 - x51
    x52 = d_omegadot_y*omega_z + d_omegadot_z*omega_y + 2.0*omegadot_y*omegadot_z
    rate_rate_M_yz = -d2_omegadot_x + x52
    rate_rate_b_f_y = M_yx*rate_rate_b_r_x + M_yy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_yz + b_r_x*rate_rate_M_yx + b_r_y*rate_rate_M_yy + d2_a_y + rate_M_yx*x48 + rate_M_yy*x49
    rate_rate_M_zx = -d2_omegadot_y + x44
    rate_rate_M_zy = d2_omegadot_x + x52
    rate_rate_M_zz = -x42 - x51
    rate_rate_b_f_z = M_zx*rate_rate_b_r_x + M_zy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_zz + b_r_x*rate_rate_M_zx + b_r_y*rate_rate_M_zy + d2_a_z + rate_M_zx*x48 + rate_M_zy*x49
    x53 = -beta_z*rate_rate_sin_psi + rate_rate_cos_psi
    rate_rate_b_tau_yx = x53
    x54 = beta_z*rate_rate_cos_psi + rate_rate_sin_psi
    rate_rate_b_tau_yy = x54
    x55 = 2.0*rate_b_f_x
    x56 = 2.0*rate_b_f_y
    rate_rate_b_f_yj = b_f_x*rate_rate_b_tau_yx + b_f_y*rate_rate_b_tau_yy + b_tau_yx*rate_rate_b_f_x + b_tau_yy*rate_rate_b_f_y - beta_x*rate_rate_b_f_z + rate_b_tau_yx*x55 + rate_b_tau_yy*x56
    x57 = beta_x*rate_rate_cos_psi
    rate_rate_b_tau_zx = -b_disc_tau_zy*rate_rate_sin_psi - x57
    x58 = beta_x*rate_rate_sin_psi
    rate_rate_b_tau_zy = b_disc_tau_zy*rate_rate_cos_psi - x58
    rate_rate_b_f_zj = b_f_x*rate_rate_b_tau_zx + b_f_y*rate_rate_b_tau_zy + b_tau_zx*rate_rate_b_f_x + b_tau_zy*rate_rate_b_f_y + rate_b_tau_zx*x55 + rate_b_tau_zy*x56 - rate_rate_b_f_z
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
    x59 = K6*q_f_yj
    x60 = K4*q_f_z
    x61 = K8*q_f_z
    i_sensed = K0 + K2*q_f_xj**2.0 + K5*q_f_yj**2.0 + K7*q_f_z**2.0 + f_f_i + q_f_xj*x59 - q_f_xj*x60 - q_f_yj*x61
    rate_f_r_x = f_disc_r_x*rate_cos_psi - f_disc_r_y*rate_sin_psi
    rate_f_r_y = f_disc_r_x*rate_sin_psi + f_disc_r_y*rate_cos_psi
    rate_f_f_x = M_xx*rate_f_r_x + M_xy*rate_f_r_y + d_a_x + f_disc_r_z*rate_M_xz + f_r_x*rate_M_xx + f_r_y*rate_M_xy
    rate_f_f_y = M_yx*rate_f_r_x + M_yy*rate_f_r_y + d_a_y + f_disc_r_z*rate_M_yz + f_r_x*rate_M_yx + f_r_y*rate_M_yy
    rate_f_f_z = M_zx*rate_f_r_x + M_zy*rate_f_r_y + d_a_z + f_disc_r_z*rate_M_zz + f_r_x*rate_M_zx + f_r_y*rate_M_zy
    rate_f_tau_xx = -x38
    rate_f_tau_xy = x37
    rate_f_f_xj = f_f_x*rate_f_tau_xx + f_f_y*rate_f_tau_xy + f_tau_xx*rate_f_f_x + f_tau_xy*rate_f_f_y
    rate_f_tau_yx = x37
    rate_f_tau_yy = x38
    rate_f_f_yj = -beta_x*rate_f_f_z + f_f_x*rate_f_tau_yx + f_f_y*rate_f_tau_yy + f_tau_yx*rate_f_f_x + f_tau_yy*rate_f_f_y
    rate_f_tau_zx = -f_disc_tau_zy*rate_sin_psi - x39
    rate_f_tau_zy = f_disc_tau_zy*rate_cos_psi - x40
    rate_f_f_zj = f_f_x*rate_f_tau_zx + f_f_y*rate_f_tau_zy + f_tau_zx*rate_f_f_x + f_tau_zy*rate_f_f_y - rate_f_f_z
    rate_f_f_i = rate_f_f_xj + rate_f_f_yj*vartheta_z - rate_f_f_zj*vartheta_y
    rate_rate_f_r_x = f_disc_r_x*rate_rate_cos_psi - f_disc_r_y*rate_rate_sin_psi
    rate_rate_f_r_y = f_disc_r_x*rate_rate_sin_psi + f_disc_r_y*rate_rate_cos_psi
    x62 = 2.0*rate_f_r_x
    x63 = 2.0*rate_f_r_y
    rate_rate_f_f_x = M_xx*rate_rate_f_r_x + M_xy*rate_rate_f_r_y + d2_a_x + f_disc_r_z*rate_rate_M_xz + f_r_x*rate_rate_M_xx + f_r_y*rate_rate_M_xy + rate_M_xx*x62 + rate_M_xy*x63
    rate_rate_f_f_y = M_yx*rate_rate_f_r_x + M_yy*rate_rate_f_r_y + d2_a_y + f_disc_r_z*rate_rate_M_yz + f_r_x*rate_rate_M_yx + f_r_y*rate_rate_M_yy + rate_M_yx*x62 + rate_M_yy*x63
    rate_rate_f_f_z = M_zx*rate_rate_f_r_x + M_zy*rate_rate_f_r_y + d2_a_z + f_disc_r_z*rate_rate_M_zz + f_r_x*rate_rate_M_zx + f_r_y*rate_rate_M_zy + rate_M_zx*x62 + rate_M_zy*x63
    rate_rate_f_tau_xx = -x54
    rate_rate_f_tau_xy = x53
    x64 = 2.0*rate_f_f_x
    x65 = 2.0*rate_f_f_y
    rate_rate_f_f_xj = f_f_x*rate_rate_f_tau_xx + f_f_y*rate_rate_f_tau_xy + f_tau_xx*rate_rate_f_f_x + f_tau_xy*rate_rate_f_f_y + rate_f_tau_xx*x64 + rate_f_tau_xy*x65
    rate_rate_f_tau_yx = x53
    rate_rate_f_tau_yy = x54
    rate_rate_f_f_yj = -beta_x*rate_rate_f_f_z + f_f_x*rate_rate_f_tau_yx + f_f_y*rate_rate_f_tau_yy + f_tau_yx*rate_rate_f_f_x + f_tau_yy*rate_rate_f_f_y + rate_f_tau_yx*x64 + rate_f_tau_yy*x65
    rate_rate_f_tau_zx = -f_disc_tau_zy*rate_rate_sin_psi - x57
    rate_rate_f_tau_zy = f_disc_tau_zy*rate_rate_cos_psi - x58
    rate_rate_f_f_zj = f_f_x*rate_rate_f_tau_zx + f_f_y*rate_rate_f_tau_zy + f_tau_zx*rate_rate_f_f_x + f_tau_zy*rate_rate_f_f_y + rate_f_tau_zx*x64 + rate_f_tau_zy*x65 - rate_rate_f_f_z
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
    x66 = 2.0*rate_q_r_x
    x67 = 2.0*rate_q_r_y
    rate_rate_q_f_x = M_xx*rate_rate_q_r_x + M_xy*rate_rate_q_r_y + d2_a_x + q_r_x*rate_rate_M_xx + q_r_y*rate_rate_M_xy + rate_M_xx*x66 + rate_M_xy*x67
    rate_rate_q_f_y = M_yx*rate_rate_q_r_x + M_yy*rate_rate_q_r_y + d2_a_y + q_r_x*rate_rate_M_yx + q_r_y*rate_rate_M_yy + rate_M_yx*x66 + rate_M_yy*x67
    rate_rate_q_f_z = M_zx*rate_rate_q_r_x + M_zy*rate_rate_q_r_y + d2_a_z + q_r_x*rate_rate_M_zx + q_r_y*rate_rate_M_zy + rate_M_zx*x66 + rate_M_zy*x67
    x68 = 2.0*rate_q_f_y
    x69 = 2.0*rate_q_f_x
    rate_rate_q_f_xj = cos_psi*rate_rate_q_f_y - q_f_x*rate_rate_sin_psi + q_f_y*rate_rate_cos_psi + rate_cos_psi*x68 - rate_rate_q_f_x*sin_psi - rate_sin_psi*x69
    rate_rate_q_f_yj = cos_psi*rate_rate_q_f_x + q_f_x*rate_rate_cos_psi + q_f_y*rate_rate_sin_psi + rate_cos_psi*x69 + rate_rate_q_f_y*sin_psi + rate_sin_psi*x68
    x70 = 2.0*K2
    x71 = 2.0*K5
    x72 = 2.0*K7
    x73 = q_f_xj*x70 + x59 - x60
    x74 = K6*q_f_xj + q_f_yj*x71 - x61
    x75 = K4*q_f_xj + K8*q_f_yj - q_f_z*x72
    rate_rate_i_sensed = rate_q_f_xj*(-K4*rate_q_f_z + K6*rate_q_f_yj + rate_q_f_xj*x70) + rate_q_f_yj*(K6*rate_q_f_xj - K8*rate_q_f_z + rate_q_f_yj*x71) - rate_q_f_z*(K4*rate_q_f_xj + K8*rate_q_f_yj - rate_q_f_z*x72) + rate_rate_f_f_i + rate_rate_q_f_xj*x73 + rate_rate_q_f_yj*x74 - rate_rate_q_f_z*x75
    x76 = f_tau_xx + f_tau_yx*vartheta_z - f_tau_zx*vartheta_y
    vibration_axis_ix = x76
    x77 = f_tau_xy + f_tau_yy*vartheta_z - f_tau_zy*vartheta_y
    vibration_axis_iy = x77
    x78 = -beta_x*vartheta_z + vartheta_y
    vibration_axis_iz = x78
    vibration_axis_ox = -f_tau_xx*vartheta_z + f_tau_yx + f_tau_zx*vartheta_x
    vibration_axis_oy = -f_tau_xy*vartheta_z + f_tau_yy + f_tau_zy*vartheta_x
    vibration_axis_oz = -beta_x - vartheta_x
    vibration_axis_px = f_tau_xx*vartheta_y - f_tau_yx*vartheta_x + f_tau_zx
    vibration_axis_py = f_tau_xy*vartheta_y - f_tau_yy*vartheta_x + f_tau_zy
    vibration_axis_pz = beta_x*vartheta_x - 1
    bar_i_vibration_rectification = K1*k_VI
    bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x75
    bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x74
    bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x73
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
    x79 = d_spin_angle + omega_z
    x80 = 2.0*x79
    bar_rate_dR_arm_stretch = bar_f_f_x*(-f_arm_y*x80 + 2.0*f_arm_z*omega_y) + bar_f_f_y*(f_arm_x*x80 - f_arm_z*x50) + bar_f_f_z*(-f_arm_x*x26 + 2.0*f_arm_y*omega_x) - bar_q_f_x*q_arm_y*x80 + bar_q_f_y*q_arm_x*x80 - bar_q_p_second_order_misalignment*(-q_arm_x*x26 + q_arm_y*x50)
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
    x81 = bar_f_f_z*f_disc_r_z
    bar_M_zz = x81
    x82 = bar_f_f_z*f_r_y
    x83 = bar_q_p_second_order_misalignment*q_r_y
    bar_M_zy = x82 - x83
    x84 = bar_q_p_second_order_misalignment*q_r_x
    bar_M_zx = bar_f_f_z*f_r_x - x84
    x85 = bar_f_f_y*f_disc_r_z
    bar_M_yz = x85
    x86 = bar_f_f_y*f_r_y
    x87 = bar_q_f_y*q_r_y
    bar_M_yy = x86 + x87
    x88 = bar_q_f_y*q_r_x
    bar_M_yx = bar_f_f_y*f_r_x + x88
    x89 = bar_f_f_x*f_disc_r_z
    bar_M_xz = x89
    x90 = bar_f_f_x*f_r_y
    x91 = bar_q_f_x*q_r_y
    bar_M_xy = x90 + x91
    x92 = bar_q_f_x*q_r_x
    bar_M_xx = bar_f_f_x*f_r_x + x92
    bar_sin_phi_true = -bar_cos_psi*sin_j + bar_sin_psi*cos_j
    bar_cos_phi_true = bar_cos_psi*cos_j + bar_sin_psi*sin_j
    bar_sin_delta_phi = -bar_cos_phi_true*sin_phi + bar_sin_phi_true*cos_phi
    bar_time_offset_omegadot_z = -bar_M_xy + bar_M_yx
    bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx
    bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy
    bar_time_offset_omega_z = -bar_M_xx*x21 + bar_M_xz*omega_x - bar_M_yy*x21 + bar_M_yz*omega_y + bar_M_zx*omega_x + bar_M_zy*omega_y
    bar_time_offset_omega_y = -bar_M_xx*x26 + bar_M_xy*omega_x + bar_M_yx*omega_x + bar_M_yz*omega_z + bar_M_zy*omega_z - bar_M_zz*x26
    bar_time_offset_omega_x = bar_M_xy*omega_y + bar_M_xz*omega_z + bar_M_yx*omega_y - bar_M_yy*x50 + bar_M_zx*omega_z - bar_M_zz*x50
    bar_time_offset_a_z = bar_f_f_z - bar_q_p_second_order_misalignment
    bar_time_offset_a_y = bar_f_f_y + bar_q_f_y
    bar_time_offset_a_x = bar_f_f_x + bar_q_f_x
    bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy
    bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx
    bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx
    x93 = a_y*bar_time_offset_a_z
    x94 = bar_time_offset_omega_z*omega_y
    x95 = bar_time_offset_omegadot_z*omegadot_y
    bar_imu_turn_zy = x93 + x94 + x95
    x96 = a_x*bar_time_offset_a_z
    x97 = bar_time_offset_omega_z*omega_x + bar_time_offset_omegadot_z*omegadot_x + x96
    bar_imu_turn_zx = x97
    x98 = a_z*bar_time_offset_a_y
    x99 = bar_time_offset_omega_y*omega_z + bar_time_offset_omegadot_y*omegadot_z + x98
    bar_imu_turn_yz = x99
    x100 = a_x*bar_time_offset_a_y
    bar_imu_turn_yx = bar_time_offset_omega_y*omega_x + bar_time_offset_omegadot_y*omegadot_x + x100
    x101 = a_z*bar_time_offset_a_x
    x102 = bar_time_offset_omega_x*omega_z
    x103 = bar_time_offset_omegadot_x*omegadot_z
    bar_imu_turn_xz = x101 + x102 + x103
    x104 = a_y*bar_time_offset_a_x
    bar_imu_turn_xy = bar_time_offset_omega_x*omega_y + bar_time_offset_omegadot_x*omegadot_y + x104
    x105 = bar_time_offset_a_x*d_a_x
    x106 = bar_time_offset_a_y*d_a_y
    x107 = bar_time_offset_a_z*d_a_z
    x108 = bar_time_offset_omega_x*omegadot_x
    x109 = bar_time_offset_omega_y*omegadot_y
    x110 = bar_time_offset_omega_z*omegadot_z
    x111 = bar_time_offset_omegadot_x*d_omegadot_x
    x112 = bar_time_offset_omegadot_y*d_omegadot_y
    x113 = bar_time_offset_omegadot_z*d_omegadot_z
    x114 = bar_i_vibration_rectification*f_f_i**2.0
    x115 = f_f_o**2.0
    x116 = bar_i_vibration_rectification*f_f_i
    x117 = f_f_p**2.0
    x118 = bar_sin_delta_phi*cos_phi
    x119 = cos_phi**2.0
    x120 = sin_phi**2.0
    x121 = cos_phi**3.0
    x122 = sin_phi**3.0
    x123 = K1*bar_K1_thermal_scale
    x124 = -bar_M_zz
    x125 = -x101
    x126 = -x93
    x127 = -omegadot_y
    x128 = f_r_x*x81
    x129 = 0.5*q_r_x**2.0
    x130 = 0.5*f_disc_r_z**2.0
    x131 = f_r_x**2.0
    x132 = 0.5*x131
    x133 = x130 - x132
    x134 = f_r_x*x89
    x135 = 0.5*q_r_y**2.0
    x136 = 0.5*f_r_y**2.0
    x137 = x130 - x136
    x138 = f_r_x*x85
    x139 = (1/6)*q_r_x**3.0
    x140 = f_r_x*x130
    x141 = -1/6*f_r_x**3.0 + x140
    x142 = f_disc_r_z**3.0
    x143 = (1/6)*x142
    x144 = -0.5*f_disc_r_z*x131 + x143
    x145 = f_r_y*x128
    x146 = f_r_y*x130
    x147 = -f_r_y*x132 + x146
    x148 = -f_r_x*x136 + x140
    x149 = f_disc_r_z*x136
    x150 = (1/6)*q_r_y**3.0
    x151 = -1/6*f_r_y**3.0 + x146
    x152 = x143 - x149
    x153 = np.sin(roll)
    x154 = -bar_M_zz*x153
    x155 = np.sin(pitch)
    x156 = -bar_M_zz*x155
    x157 = -Gamma_zz
    x158 = 2.0*Gamma_yz
    x159 = 2.0*Gamma_xz
    x160 = temperature - 293.15
    x161 = K4*vibration_axis_ix
    x162 = K6*vibration_axis_ix
    x163 = K8*vibration_axis_ox
    x164 = K4*vibration_axis_px
    x165 = K6*vibration_axis_ox
    x166 = K8*vibration_axis_px
    x167 = vibration_axis_ix*x70
    x168 = vibration_axis_ox*x71
    x169 = vibration_axis_px*x72
    x170 = K4*vibration_axis_iy
    x171 = K6*vibration_axis_iy
    x172 = K8*vibration_axis_oy
    x173 = K4*vibration_axis_iz
    x174 = K6*vibration_axis_iz
    x175 = K8*vibration_axis_oz

    D = np.empty((len(ROWS), len(time)))
    D[0] = bar_i_vibration_rectification*(f_tau_xx*omega_x + f_tau_xy*omega_y)*(f_tau_zx*omega_x + f_tau_zy*omega_y - x79)  # anisoinertia.K_ip
    D[1] = b_f_zj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_zj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_zj  # arm-sag.c_z
    D[2] = b_f_yj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_yj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_yj  # arm-stretch.c_r
    D[3] = bar_i_vibration_rectification*time  # bias-drift.dK0_dt
    D[4] = bar_i_vibration_rectification  # bias-step.dK0
    D[5] = time*x105 + time*x106 + time*x107 + time*x108 + time*x109 + time*x110 + time*x111 + time*x112 + time*x113  # clock-drift.epsilon
    D[6] = f_f_o*x114  # cubic-cross.K_iio
    D[7] = f_f_p*x114  # cubic-cross.K_iip
    D[8] = x115*x116  # cubic-cross.K_ioo
    D[9] = f_f_o*f_f_p*x116  # cubic-cross.K_iop
    D[10] = x116*x117  # cubic-cross.K_ipp
    D[11] = bar_i_vibration_rectification*f_f_o**3.0  # cubic-cross.K_ooo
    D[12] = bar_i_vibration_rectification*f_f_p*x115  # cubic-cross.K_oop
    D[13] = bar_i_vibration_rectification*f_f_o*x117  # cubic-cross.K_opp
    D[14] = bar_i_vibration_rectification*f_f_p**3.0  # cubic-cross.K_ppp
    D[15] = bar_i_vibration_rectification*f_f_i**3.0  # cubic-input.K_iii
    D[16] = bar_f_f_x*(-d2_spin_angle*f_r_y + f_r_x*spin_xx) + bar_f_f_y*(d2_spin_angle*f_r_x + f_r_y*spin_yy) + bar_f_f_z*(f_r_x*spin_zx + f_r_y*spin_zy) + bar_q_f_x*(-d2_spin_angle*q_r_y + q_r_x*spin_xx) + bar_q_f_y*(d2_spin_angle*q_r_x + q_r_y*spin_yy) - bar_q_p_second_order_misalignment*(q_r_x*spin_zx + q_r_y*spin_zy)  # disc-spin.share
    D[17] = x118  # encoder-harmonic.c_1
    D[18] = bar_sin_delta_phi*sin_phi  # encoder-harmonic.s_1
    D[19] = bar_sin_delta_phi*(x119 - x120)  # encoder-harmonic.c_2
    D[20] = x118*x31  # encoder-harmonic.s_2
    D[21] = bar_sin_delta_phi*(-3.0*cos_phi*x120 + x121)  # encoder-harmonic.c_3
    D[22] = bar_sin_delta_phi*(3.0*sin_phi*x119 - x122)  # encoder-harmonic.s_3
    D[23] = bar_sin_delta_phi*(cos_phi**4.0 + sin_phi**4.0 - 6.0*x119*x120)  # encoder-harmonic.c_4
    D[24] = bar_sin_delta_phi*(x121*x47 - x122*x45)  # encoder-harmonic.s_4
    D[25] = time*x123  # gain-drift.dK1_dt
    D[26] = x123  # gain-step.dK1
    D[27] = -bar_M_xx - x124  # gradient-offset.G_xx
    D[28] = bar_spin_axis_tilt_Gamma_xy  # gradient-offset.G_xy
    D[29] = bar_spin_axis_tilt_Gamma_xz  # gradient-offset.G_xz
    D[30] = -bar_M_yy - x124  # gradient-offset.G_yy
    D[31] = bar_spin_axis_tilt_Gamma_yz  # gradient-offset.G_yz
    D[32] = -bar_time_offset_omega_x  # gyro-bias.b_x
    D[33] = -bar_time_offset_omega_y  # gyro-bias.b_y
    D[34] = -bar_time_offset_omega_z  # gyro-bias.b_z
    D[35] = -a_x*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_x  # gyro-g-sensitivity.d_xx
    D[36] = -a_y*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_y  # gyro-g-sensitivity.d_xy
    D[37] = -a_z*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_z  # gyro-g-sensitivity.d_xz
    D[38] = -a_x*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_x  # gyro-g-sensitivity.d_yx
    D[39] = -a_y*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_y  # gyro-g-sensitivity.d_yy
    D[40] = -a_z*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_z  # gyro-g-sensitivity.d_yz
    D[41] = -a_x*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_x  # gyro-g-sensitivity.d_zx
    D[42] = -a_y*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_y  # gyro-g-sensitivity.d_zy
    D[43] = -a_z*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_z  # gyro-g-sensitivity.d_zz
    D[44] = -bar_time_offset_omega_x*omega_x - bar_time_offset_omegadot_x*omegadot_x  # gyro-scale.s_x
    D[45] = -bar_time_offset_omega_y*omega_y - bar_time_offset_omegadot_y*omegadot_y  # gyro-scale.s_y
    D[46] = -bar_time_offset_omega_z*omega_z - bar_time_offset_omegadot_z*omegadot_z  # gyro-scale.s_z
    D[47] = -bar_time_offset_a_x  # imu-acceleration-bias.b_x
    D[48] = -bar_time_offset_a_y  # imu-acceleration-bias.b_y
    D[49] = -bar_time_offset_a_z  # imu-acceleration-bias.b_z
    D[50] = -x104  # imu-acceleration-misalignment.m_xy
    D[51] = x125  # imu-acceleration-misalignment.m_xz
    D[52] = -x100  # imu-acceleration-misalignment.m_yx
    D[53] = -x98  # imu-acceleration-misalignment.m_yz
    D[54] = -x96  # imu-acceleration-misalignment.m_zx
    D[55] = x126  # imu-acceleration-misalignment.m_zy
    D[56] = -a_x*bar_time_offset_a_x  # imu-acceleration-scale.s_x
    D[57] = -a_y*bar_time_offset_a_y  # imu-acceleration-scale.s_y
    D[58] = -a_z*bar_time_offset_a_z  # imu-acceleration-scale.s_z
    D[59] = bar_time_offset_a_x*x2 - bar_time_offset_a_y*x6 + bar_time_offset_a_z*(-x127 - x4)  # imu-lever-arm.l_x
    D[60] = bar_time_offset_a_x*(omegadot_z - x3) + bar_time_offset_a_y*x8 - bar_time_offset_a_z*x10  # imu-lever-arm.l_y
    D[61] = -bar_time_offset_a_x*x5 + bar_time_offset_a_y*(omegadot_x - x9) + bar_time_offset_a_z*x11  # imu-lever-arm.l_z
    D[62] = -bar_imu_turn_yz + bar_imu_turn_zy  # imu-misalignment.e_x
    D[63] = bar_imu_turn_xz - bar_imu_turn_zx  # imu-misalignment.e_y
    D[64] = -bar_imu_turn_xy + bar_imu_turn_yx  # imu-misalignment.e_z
    D[65] = -bar_i_vibration_rectification*rate_f_f_i  # lag.tau
    D[66] = bar_i_vibration_rectification*(B_x*x76 + B_y*x77 + B_z*x78)  # magnetic-bias.dK0_dB
    D[67] = b_f_xj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yx
    D[68] = b_f_yj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yy
    D[69] = b_f_zj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yz
    D[70] = b_f_xj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zx
    D[71] = b_f_yj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zy
    D[72] = b_f_zj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zz
    D[73] = bar_f_f_x*x133 - bar_q_f_x*x129 + x128  # near-mass.T_xxx
    D[74] = bar_f_f_y*x133 + bar_f_f_z*f_disc_r_z*f_r_y - bar_q_f_y*x129 - f_r_x*x90 - q_r_x*x91  # near-mass.T_xxy
    D[75] = bar_f_f_z*x133 + bar_q_p_second_order_misalignment*x129 - x134  # near-mass.T_xxz
    D[76] = bar_f_f_x*x137 + bar_f_f_z*f_disc_r_z*f_r_x - bar_q_f_x*x135 - f_r_x*x86 - q_r_x*x87  # near-mass.T_xyy
    D[77] = bar_q_p_second_order_misalignment*q_r_x*q_r_y - f_r_x*x82 - f_r_y*x89 - x138  # near-mass.T_xyz
    D[78] = bar_f_f_y*x137 - bar_q_f_y*x135 + f_r_y*x81  # near-mass.T_yyy
    D[79] = bar_f_f_z*x137 + bar_q_p_second_order_misalignment*x135 - f_r_y*x85  # near-mass.T_yyz
    D[80] = bar_f_f_x*x141 - bar_f_f_z*x144 - bar_q_f_x*x139  # near-mass.T_xxxx
    D[81] = bar_f_f_x*x147 + bar_f_f_y*x141 - bar_q_f_y*x139 - x129*x91 + x145  # near-mass.T_xxxy
    D[82] = bar_f_f_x*x144 + bar_f_f_z*x141 + bar_q_p_second_order_misalignment*x139  # near-mass.T_xxxz
    D[83] = bar_f_f_x*x148 + bar_f_f_y*x147 + bar_f_f_z*(f_disc_r_z*x132 - 1/3*x142 + x149) - x129*x87 - x135*x92  # near-mass.T_xxyy
    D[84] = bar_f_f_y*x144 + bar_f_f_z*x147 - f_r_y*x134 + x129*x83  # near-mass.T_xxyz
    D[85] = bar_f_f_x*x151 + bar_f_f_y*x148 - bar_q_f_x*x150 - x135*x88 + x145  # near-mass.T_xyyy
    D[86] = bar_f_f_x*x152 + bar_f_f_z*x148 - f_r_y*x138 + x135*x84  # near-mass.T_xyyz
    D[87] = bar_f_f_y*x151 - bar_f_f_z*x152 - bar_q_f_y*x150  # near-mass.T_yyyy
    D[88] = bar_f_f_y*x152 + bar_f_f_z*x151 + bar_q_p_second_order_misalignment*x150  # near-mass.T_yyyz
    D[89] = x116*np.abs(f_f_i)  # odd-quadratic.K_oq
    D[90] = bar_i_vibration_rectification*rate_rate_i_sensed  # output-filter.b
    D[91] = bar_i_vibration_rectification*i_sensed  # output-gain-step.g
    D[92] = bar_i_vibration_rectification*(-beta_x*(d2_spin_angle + omegadot_z) + f_tau_yx*(omegadot_x + x24) + f_tau_yy*(-x127 - x23))  # pendulum-angular.K_pa
    D[93] = bar_i_vibration_rectification*(pressure - 101325)  # pressure-bias.dK0_dp
    D[94] = bar_q_i_second_order_misalignment*(f_f_i - q_f_xj) + bar_q_o_second_order_misalignment*(f_f_o - q_f_yj) + bar_q_p_second_order_misalignment*(f_f_p + q_f_z)  # second-order-misalignment.kappa
    D[95] = -bar_M_xx*x153 - x154  # self-gradient.G_xx_roll
    D[96] = bar_spin_axis_tilt_Gamma_xy*x153  # self-gradient.G_xy_roll
    D[97] = bar_spin_axis_tilt_Gamma_xz*x153  # self-gradient.G_xz_roll
    D[98] = -bar_M_yy*x153 - x154  # self-gradient.G_yy_roll
    D[99] = bar_spin_axis_tilt_Gamma_yz*x153  # self-gradient.G_yz_roll
    D[100] = -bar_M_xx*x155 - x156  # self-gradient.G_xx_pitch
    D[101] = bar_spin_axis_tilt_Gamma_xy*x155  # self-gradient.G_xy_pitch
    D[102] = bar_spin_axis_tilt_Gamma_xz*x155  # self-gradient.G_xz_pitch
    D[103] = -bar_M_yy*x155 - x156  # self-gradient.G_yy_pitch
    D[104] = bar_spin_axis_tilt_Gamma_yz*x155  # self-gradient.G_yz_pitch
    D[105] = -Gamma_xy*bar_spin_axis_tilt_Gamma_xz + Gamma_xz*bar_spin_axis_tilt_Gamma_xy - bar_M_yy*x158 + bar_M_zz*x158 + bar_spin_axis_tilt_Gamma_yz*(-Gamma_yy - x157) + x126 - x94 - x95 + x99  # spin-axis-tilt.alpha_x
    D[106] = Gamma_xy*bar_spin_axis_tilt_Gamma_yz - Gamma_yz*bar_spin_axis_tilt_Gamma_xy + bar_M_xx*x159 - bar_M_zz*x159 + bar_spin_axis_tilt_Gamma_xz*(Gamma_xx + x157) - x102 - x103 + x125 + x97  # spin-axis-tilt.alpha_y
    D[107] = bar_wobble_xz*sin_phi - bar_wobble_yz*cos_phi - bar_wobble_zx*sin_phi + bar_wobble_zy*cos_phi  # spin-axis-wobble.w_x
    D[108] = bar_wobble_xz*cos_phi + bar_wobble_yz*sin_phi - bar_wobble_zx*cos_phi - bar_wobble_zy*sin_phi  # spin-axis-wobble.w_y
    D[109] = bar_sin_delta_phi  # spin-phase-offset.phi_0
    D[110] = bar_sin_delta_phi  # spin-rate-jitter.sigma_phi
    D[111] = bar_sin_delta_phi  # spin-rate-jitter.sigma_walk
    D[112] = bar_sin_delta_phi*time*x33  # spin-rate-offset.epsilon
    D[113] = bar_i_vibration_rectification*x160  # thermal-bias.dK0_dT
    D[114] = bar_i_vibration_rectification*d_temperature  # thermal-lag.dK0_dTdot
    D[115] = d_temperature*x123  # thermal-lag.dK1_dTdot
    D[116] = x123*x160  # thermal-scale.dK1_dT
    D[117] = x105 + x106 + x107 + x108 + x109 + x110 + x111 + x112 + x113  # time-offset.delta_t
    D[118] = bar_i_vibration_rectification*(K2*vibration_axis_ix**2.0 + K5*vibration_axis_ox**2.0 + K7*vibration_axis_px**2.0 + vibration_axis_ox*x162 + vibration_axis_px*x161 + vibration_axis_px*x163)  # vibration-rectification.P_xx
    D[119] = bar_i_vibration_rectification*(vibration_axis_iy*x164 + vibration_axis_iy*x165 + vibration_axis_iy*x167 + vibration_axis_oy*x162 + vibration_axis_oy*x166 + vibration_axis_oy*x168 + vibration_axis_py*x161 + vibration_axis_py*x163 + vibration_axis_py*x169)  # vibration-rectification.P_xy
    D[120] = bar_i_vibration_rectification*(vibration_axis_iz*x164 + vibration_axis_iz*x165 + vibration_axis_iz*x167 + vibration_axis_oz*x162 + vibration_axis_oz*x166 + vibration_axis_oz*x168 + vibration_axis_pz*x161 + vibration_axis_pz*x163 + vibration_axis_pz*x169)  # vibration-rectification.P_xz
    D[121] = bar_i_vibration_rectification*(K2*vibration_axis_iy**2.0 + K5*vibration_axis_oy**2.0 + K7*vibration_axis_py**2.0 + vibration_axis_oy*x171 + vibration_axis_py*x170 + vibration_axis_py*x172)  # vibration-rectification.P_yy
    D[122] = bar_i_vibration_rectification*(vibration_axis_iy*vibration_axis_iz*x70 + vibration_axis_oy*vibration_axis_oz*x71 + vibration_axis_oy*x174 + vibration_axis_oz*x171 + vibration_axis_py*vibration_axis_pz*x72 + vibration_axis_py*x173 + vibration_axis_py*x175 + vibration_axis_pz*x170 + vibration_axis_pz*x172)  # vibration-rectification.P_yz
    D[123] = bar_i_vibration_rectification*(K2*vibration_axis_iz**2.0 + K5*vibration_axis_oz**2.0 + K7*vibration_axis_pz**2.0 + vibration_axis_oz*x174 + vibration_axis_pz*x173 + vibration_axis_pz*x175)  # vibration-rectification.P_zz
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
