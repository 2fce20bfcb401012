"""Signatures: what each candidate effect would add to V_j.

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: arm-sag, arm-stretch, bias-drift, cubic-cross, cubic-input, disc-spin, encoder-harmonic, gain-drift, gain-step, gyro-scale, imu-lever-arm, imu-misalignment, lag, magnetic-bias, mount-compliance, near-mass, odd-quadratic, pendulum-angular, pressure-bias, second-order-misalignment, self-gradient, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, thermal-bias, thermal-scale, time-offset, vibration-rectification.
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
    ("arm-sag.c_z", False),
    ("arm-stretch.c_r", False),
    ("bias-drift.dK0_dt", False),
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
    ("gyro-scale.s_x", True),
    ("gyro-scale.s_y", True),
    ("gyro-scale.s_z", True),
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
    ("odd-quadratic.K_oq", False),
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
    ("thermal-bias.dK0_dT", False),
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
    pitch = inputs[32]
    pressure = inputs[33]
    roll = inputs[34]
    temperature = inputs[35]
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
    rate_sin_phi_true = 2.0*cos_phi*x32
    rate_cos_psi = cos_j*rate_cos_phi_true - rate_sin_phi_true*sin_j
    rate_sin_psi = cos_j*rate_sin_phi_true + rate_cos_phi_true*sin_j
    rate_b_r_x = b_disc_r_x*rate_cos_psi - b_disc_r_y*rate_sin_psi
    rate_b_r_y = b_disc_r_x*rate_sin_psi + b_disc_r_y*rate_cos_psi
    rate_b_f_x = M_xx*rate_b_r_x + M_xy*rate_b_r_y + b_disc_r_z*rate_M_xz + b_r_x*rate_M_xx + b_r_y*rate_M_xy + d_a_x
    rate_M_yx = d_omegadot_z + x29
    x33 = 2.0*omegadot_x
    x34 = omega_x*x33
    rate_M_yy = -x28 - x34
    x35 = omega_y*omegadot_z + omega_z*omegadot_y
    rate_M_yz = -d_omegadot_x + x35
    rate_b_f_y = M_yx*rate_b_r_x + M_yy*rate_b_r_y + b_disc_r_z*rate_M_yz + b_r_x*rate_M_yx + b_r_y*rate_M_yy + d_a_y
    rate_M_zx = -d_omegadot_y + x30
    rate_M_zy = d_omegadot_x + x35
    rate_M_zz = -x27 - x34
    rate_b_f_z = M_zx*rate_b_r_x + M_zy*rate_b_r_y + b_disc_r_z*rate_M_zz + b_r_x*rate_M_zx + b_r_y*rate_M_zy + d_a_z
    x36 = -beta_z*rate_sin_psi + rate_cos_psi
    rate_b_tau_yx = x36
    x37 = beta_z*rate_cos_psi + rate_sin_psi
    rate_b_tau_yy = x37
    rate_b_f_yj = b_f_x*rate_b_tau_yx + b_f_y*rate_b_tau_yy + b_tau_yx*rate_b_f_x + b_tau_yy*rate_b_f_y - beta_x*rate_b_f_z
    x38 = beta_x*rate_cos_psi
    rate_b_tau_zx = -b_disc_tau_zy*rate_sin_psi - x38
    x39 = beta_x*rate_sin_psi
    rate_b_tau_zy = b_disc_tau_zy*rate_cos_psi - x39
    rate_b_f_zj = b_f_x*rate_b_tau_zx + b_f_y*rate_b_tau_zy + b_tau_zx*rate_b_f_x + b_tau_zy*rate_b_f_y - rate_b_f_z
    x40 = d_omegadot_z*x21 + 2.0*omegadot_z**2.0
    x41 = d_omegadot_y*x26 + 2.0*omegadot_y**2.0
    rate_rate_M_xx = -x40 - x41
    x42 = d_omegadot_x*omega_y + d_omegadot_y*omega_x + omegadot_y*x33
    rate_rate_M_xy = -d2_omegadot_z + x42
    x43 = d_omegadot_x*omega_z + d_omegadot_z*omega_x + omegadot_z*x33
    rate_rate_M_xz = d2_omegadot_y + x43
    x44 = 4.0*cos_phi
    x45 = np.pi**2.0*spin_frequency**2.0
    rate_rate_cos_phi_true = -x44*x45
    x46 = 4.0*sin_phi
    rate_rate_sin_phi_true = -x45*x46
    rate_rate_cos_psi = cos_j*rate_rate_cos_phi_true - rate_rate_sin_phi_true*sin_j
    rate_rate_sin_psi = cos_j*rate_rate_sin_phi_true + rate_rate_cos_phi_true*sin_j
    rate_rate_b_r_x = b_disc_r_x*rate_rate_cos_psi - b_disc_r_y*rate_rate_sin_psi
    rate_rate_b_r_y = b_disc_r_x*rate_rate_sin_psi + b_disc_r_y*rate_rate_cos_psi
    x47 = 2.0*rate_b_r_x
    x48 = 2.0*rate_b_r_y
    rate_rate_b_f_x = M_xx*rate_rate_b_r_x + M_xy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_xz + b_r_x*rate_rate_M_xx + b_r_y*rate_rate_M_xy + d2_a_x + rate_M_xx*x47 + rate_M_xy*x48
    rate_rate_M_yx = d2_omegadot_z + x42
    x49 = 2.0*omega_x
    x50 = d_omegadot_x*x49 + 2.0*omegadot_x**2.0
    rate_rate_M_yy = -x40 - x50
    x51 = d_omegadot_y*omega_z + d_omegadot_z*omega_y + 2.0*omegadot_y*omegadot_z
    rate_rate_M_yz = -d2_omegadot_x + x51
    rate_rate_b_f_y = M_yx*rate_rate_b_r_x + M_yy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_yz + b_r_x*rate_rate_M_yx + b_r_y*rate_rate_M_yy + d2_a_y + rate_M_yx*x47 + rate_M_yy*x48
    rate_rate_M_zx = -d2_omegadot_y + x43
    rate_rate_M_zy = d2_omegadot_x + x51
    rate_rate_M_zz = -x41 - x50
    rate_rate_b_f_z = M_zx*rate_rate_b_r_x + M_zy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_zz + b_r_x*rate_rate_M_zx + b_r_y*rate_rate_M_zy + d2_a_z + rate_M_zx*x47 + rate_M_zy*x48
    rate_rate_b_tau_yx = -beta_z*rate_rate_sin_psi + rate_rate_cos_psi
    rate_rate_b_tau_yy = beta_z*rate_rate_cos_psi + rate_rate_sin_psi
    x52 = 2.0*rate_b_f_x
    x53 = 2.0*rate_b_f_y
    rate_rate_b_f_yj = b_f_x*rate_rate_b_tau_yx + b_f_y*rate_rate_b_tau_yy + b_tau_yx*rate_rate_b_f_x + b_tau_yy*rate_rate_b_f_y - beta_x*rate_rate_b_f_z + rate_b_tau_yx*x52 + rate_b_tau_yy*x53
    rate_rate_b_tau_zx = -b_disc_tau_zy*rate_rate_sin_psi - beta_x*rate_rate_cos_psi
    rate_rate_b_tau_zy = b_disc_tau_zy*rate_rate_cos_psi - beta_x*rate_rate_sin_psi
    rate_rate_b_f_zj = b_f_x*rate_rate_b_tau_zx + b_f_y*rate_rate_b_tau_zy + b_tau_zx*rate_rate_b_f_x + b_tau_zy*rate_rate_b_f_y + rate_b_tau_zx*x52 + rate_b_tau_zy*x53 - rate_rate_b_f_z
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
    x54 = K6*q_f_xj
    x55 = K4*q_f_xj
    x56 = K8*q_f_yj
    i_sensed = K0 + K2*q_f_xj**2.0 + K5*q_f_yj**2.0 + K7*q_f_z**2.0 + f_f_i + q_f_yj*x54 - q_f_z*x55 - q_f_z*x56
    rate_f_r_x = f_disc_r_x*rate_cos_psi - f_disc_r_y*rate_sin_psi
    rate_f_r_y = f_disc_r_x*rate_sin_psi + f_disc_r_y*rate_cos_psi
    rate_f_f_x = M_xx*rate_f_r_x + M_xy*rate_f_r_y + d_a_x + f_disc_r_z*rate_M_xz + f_r_x*rate_M_xx + f_r_y*rate_M_xy
    rate_f_f_y = M_yx*rate_f_r_x + M_yy*rate_f_r_y + d_a_y + f_disc_r_z*rate_M_yz + f_r_x*rate_M_yx + f_r_y*rate_M_yy
    rate_f_f_z = M_zx*rate_f_r_x + M_zy*rate_f_r_y + d_a_z + f_disc_r_z*rate_M_zz + f_r_x*rate_M_zx + f_r_y*rate_M_zy
    rate_f_tau_xx = -x37
    rate_f_tau_xy = x36
    rate_f_f_xj = f_f_x*rate_f_tau_xx + f_f_y*rate_f_tau_xy + f_tau_xx*rate_f_f_x + f_tau_xy*rate_f_f_y
    rate_f_tau_yx = x36
    rate_f_tau_yy = x37
    rate_f_f_yj = -beta_x*rate_f_f_z + f_f_x*rate_f_tau_yx + f_f_y*rate_f_tau_yy + f_tau_yx*rate_f_f_x + f_tau_yy*rate_f_f_y
    rate_f_tau_zx = -f_disc_tau_zy*rate_sin_psi - x38
    rate_f_tau_zy = f_disc_tau_zy*rate_cos_psi - x39
    rate_f_f_zj = f_f_x*rate_f_tau_zx + f_f_y*rate_f_tau_zy + f_tau_zx*rate_f_f_x + f_tau_zy*rate_f_f_y - rate_f_f_z
    rate_f_f_i = rate_f_f_xj + rate_f_f_yj*vartheta_z - rate_f_f_zj*vartheta_y
    x57 = f_tau_xx + f_tau_yx*vartheta_z - f_tau_zx*vartheta_y
    vibration_axis_ix = x57
    x58 = f_tau_xy + f_tau_yy*vartheta_z - f_tau_zy*vartheta_y
    vibration_axis_iy = x58
    x59 = -beta_x*vartheta_z + vartheta_y
    vibration_axis_iz = x59
    vibration_axis_ox = -f_tau_xx*vartheta_z + f_tau_yx + f_tau_zx*vartheta_x
    vibration_axis_oy = -f_tau_xy*vartheta_z + f_tau_yy + f_tau_zy*vartheta_x
    vibration_axis_oz = -beta_x - vartheta_x
    vibration_axis_px = f_tau_xx*vartheta_y - f_tau_yx*vartheta_x + f_tau_zx
    vibration_axis_py = f_tau_xy*vartheta_y - f_tau_yy*vartheta_x + f_tau_zy
    vibration_axis_pz = beta_x*vartheta_x - 1
    bar_i_vibration_rectification = K1*k_VI
    x60 = 2.0*K7
    bar_q_p_second_order_misalignment = bar_i_vibration_rectification*(-q_f_z*x60 + x55 + x56)
    x61 = 2.0*K5
    bar_q_o_second_order_misalignment = bar_i_vibration_rectification*(-K8*q_f_z + q_f_yj*x61 + x54)
    x62 = 2.0*K2
    bar_q_i_second_order_misalignment = bar_i_vibration_rectification*(-K4*q_f_z + K6*q_f_yj + q_f_xj*x62)
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
    x63 = 2.0*d_spin_angle + 2.0*omega_z
    bar_rate_dR_arm_stretch = bar_f_f_x*(-f_arm_y*x63 + 2.0*f_arm_z*omega_y) + bar_f_f_y*(f_arm_x*x63 - f_arm_z*x49) + bar_f_f_z*(-f_arm_x*x26 + 2.0*f_arm_y*omega_x) - bar_q_f_x*q_arm_y*x63 + bar_q_f_y*q_arm_x*x63 - bar_q_p_second_order_misalignment*(-q_arm_x*x26 + q_arm_y*x49)
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
    x64 = bar_f_f_z*f_disc_r_z
    bar_M_zz = x64
    x65 = bar_f_f_z*f_r_y
    bar_M_zy = -bar_q_p_second_order_misalignment*q_r_y + x65
    bar_M_zx = bar_f_f_z*f_r_x - bar_q_p_second_order_misalignment*q_r_x
    x66 = bar_f_f_y*f_disc_r_z
    bar_M_yz = x66
    x67 = bar_f_f_y*f_r_y
    x68 = bar_q_f_y*q_r_y
    bar_M_yy = x67 + x68
    bar_M_yx = bar_f_f_y*f_r_x + bar_q_f_y*q_r_x
    x69 = bar_f_f_x*f_disc_r_z
    bar_M_xz = x69
    x70 = bar_f_f_x*f_r_y
    x71 = bar_q_f_x*q_r_y
    bar_M_xy = x70 + x71
    bar_M_xx = bar_f_f_x*f_r_x + bar_q_f_x*q_r_x
    bar_sin_phi_true = -bar_cos_psi*sin_j + bar_sin_psi*cos_j
    bar_cos_phi_true = bar_cos_psi*cos_j + bar_sin_psi*sin_j
    bar_sin_delta_phi = -bar_cos_phi_true*sin_phi + bar_sin_phi_true*cos_phi
    bar_time_offset_omegadot_z = -bar_M_xy + bar_M_yx
    bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx
    bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy
    bar_time_offset_omega_z = -bar_M_xx*x21 + bar_M_xz*omega_x - bar_M_yy*x21 + bar_M_yz*omega_y + bar_M_zx*omega_x + bar_M_zy*omega_y
    bar_time_offset_omega_y = -bar_M_xx*x26 + bar_M_xy*omega_x + bar_M_yx*omega_x + bar_M_yz*omega_z + bar_M_zy*omega_z - bar_M_zz*x26
    bar_time_offset_omega_x = bar_M_xy*omega_y + bar_M_xz*omega_z + bar_M_yx*omega_y - bar_M_yy*x49 + bar_M_zx*omega_z - bar_M_zz*x49
    bar_time_offset_a_z = bar_f_f_z - bar_q_p_second_order_misalignment
    bar_time_offset_a_y = bar_f_f_y + bar_q_f_y
    bar_time_offset_a_x = bar_f_f_x + bar_q_f_x
    bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy
    bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx
    bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx
    x72 = a_y*bar_time_offset_a_z
    x73 = bar_time_offset_omega_z*omega_y
    x74 = bar_time_offset_omegadot_z*omegadot_y
    bar_imu_turn_zy = x72 + x73 + x74
    x75 = a_x*bar_time_offset_a_z + bar_time_offset_omega_z*omega_x + bar_time_offset_omegadot_z*omegadot_x
    bar_imu_turn_zx = x75
    x76 = a_z*bar_time_offset_a_y + bar_time_offset_omega_y*omega_z + bar_time_offset_omegadot_y*omegadot_z
    bar_imu_turn_yz = x76
    bar_imu_turn_yx = a_x*bar_time_offset_a_y + bar_time_offset_omega_y*omega_x + bar_time_offset_omegadot_y*omegadot_x
    x77 = a_z*bar_time_offset_a_x
    x78 = bar_time_offset_omega_x*omega_z
    x79 = bar_time_offset_omegadot_x*omegadot_z
    bar_imu_turn_xz = x77 + x78 + x79
    bar_imu_turn_xy = a_y*bar_time_offset_a_x + bar_time_offset_omega_x*omega_y + bar_time_offset_omegadot_x*omegadot_y
    x80 = bar_i_vibration_rectification*f_f_i**2.0
    x81 = f_f_o**2.0
    x82 = bar_i_vibration_rectification*f_f_i
    x83 = f_f_p**2.0
    x84 = bar_sin_delta_phi*cos_phi
    x85 = cos_phi**2.0
    x86 = sin_phi**2.0
    x87 = cos_phi**3.0
    x88 = sin_phi**3.0
    x89 = K1*bar_K1_thermal_scale
    x90 = -omegadot_y
    x91 = 0.5*q_r_x**2.0
    x92 = 0.5*f_disc_r_z**2.0
    x93 = -0.5*f_r_x**2.0 + x92
    x94 = 0.5*q_r_y**2.0
    x95 = -0.5*f_r_y**2.0 + x92
    x96 = np.sin(roll)
    x97 = -bar_M_zz*x96
    x98 = np.sin(pitch)
    x99 = -bar_M_zz*x98
    x100 = -Gamma_zz
    x101 = 2.0*Gamma_yz
    x102 = 2.0*Gamma_xz
    x103 = temperature - 293.15
    x104 = K4*vibration_axis_ix
    x105 = K6*vibration_axis_ix
    x106 = K8*vibration_axis_ox
    x107 = K4*vibration_axis_px
    x108 = K6*vibration_axis_ox
    x109 = K8*vibration_axis_px
    x110 = vibration_axis_ix*x62
    x111 = vibration_axis_ox*x61
    x112 = vibration_axis_px*x60
    x113 = K4*vibration_axis_iy
    x114 = K6*vibration_axis_iy
    x115 = K8*vibration_axis_oy
    x116 = K4*vibration_axis_iz
    x117 = K6*vibration_axis_iz
    x118 = K8*vibration_axis_oz

    D = np.empty((len(ROWS), len(time)))
    D[0] = b_f_zj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_zj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_zj  # arm-sag.c_z
    D[1] = b_f_yj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_yj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_yj  # arm-stretch.c_r
    D[2] = bar_i_vibration_rectification*time  # bias-drift.dK0_dt
    D[3] = f_f_o*x80  # cubic-cross.K_iio
    D[4] = f_f_p*x80  # cubic-cross.K_iip
    D[5] = x81*x82  # cubic-cross.K_ioo
    D[6] = f_f_o*f_f_p*x82  # cubic-cross.K_iop
    D[7] = x82*x83  # cubic-cross.K_ipp
    D[8] = bar_i_vibration_rectification*f_f_o**3.0  # cubic-cross.K_ooo
    D[9] = bar_i_vibration_rectification*f_f_p*x81  # cubic-cross.K_oop
    D[10] = bar_i_vibration_rectification*f_f_o*x83  # cubic-cross.K_opp
    D[11] = bar_i_vibration_rectification*f_f_p**3.0  # cubic-cross.K_ppp
    D[12] = bar_i_vibration_rectification*f_f_i**3.0  # cubic-input.K_iii
    D[13] = bar_f_f_x*(-d2_spin_angle*f_r_y + f_r_x*spin_xx) + bar_f_f_y*(d2_spin_angle*f_r_x + f_r_y*spin_yy) + bar_f_f_z*(f_r_x*spin_zx + f_r_y*spin_zy) + bar_q_f_x*(-d2_spin_angle*q_r_y + q_r_x*spin_xx) + bar_q_f_y*(d2_spin_angle*q_r_x + q_r_y*spin_yy) - bar_q_p_second_order_misalignment*(q_r_x*spin_zx + q_r_y*spin_zy)  # disc-spin.share
    D[14] = x84  # encoder-harmonic.c_1
    D[15] = bar_sin_delta_phi*sin_phi  # encoder-harmonic.s_1
    D[16] = bar_sin_delta_phi*(x85 - x86)  # encoder-harmonic.c_2
    D[17] = x31*x84  # encoder-harmonic.s_2
    D[18] = bar_sin_delta_phi*(-3.0*cos_phi*x86 + x87)  # encoder-harmonic.c_3
    D[19] = bar_sin_delta_phi*(3.0*sin_phi*x85 - x88)  # encoder-harmonic.s_3
    D[20] = bar_sin_delta_phi*(cos_phi**4.0 + sin_phi**4.0 - 6.0*x85*x86)  # encoder-harmonic.c_4
    D[21] = bar_sin_delta_phi*(-x44*x88 + x46*x87)  # encoder-harmonic.s_4
    D[22] = time*x89  # gain-drift.dK1_dt
    D[23] = x89  # gain-step.dK1
    D[24] = -bar_time_offset_omega_x*omega_x - bar_time_offset_omegadot_x*omegadot_x  # gyro-scale.s_x
    D[25] = -bar_time_offset_omega_y*omega_y - bar_time_offset_omegadot_y*omegadot_y  # gyro-scale.s_y
    D[26] = -bar_time_offset_omega_z*omega_z - bar_time_offset_omegadot_z*omegadot_z  # gyro-scale.s_z
    D[27] = bar_time_offset_a_x*x2 - bar_time_offset_a_y*x6 + bar_time_offset_a_z*(-x4 - x90)  # imu-lever-arm.l_x
    D[28] = bar_time_offset_a_x*(omegadot_z - x3) + bar_time_offset_a_y*x8 - bar_time_offset_a_z*x10  # imu-lever-arm.l_y
    D[29] = -bar_time_offset_a_x*x5 + bar_time_offset_a_y*(omegadot_x - x9) + bar_time_offset_a_z*x11  # imu-lever-arm.l_z
    D[30] = -bar_imu_turn_yz + bar_imu_turn_zy  # imu-misalignment.e_x
    D[31] = bar_imu_turn_xz - bar_imu_turn_zx  # imu-misalignment.e_y
    D[32] = -bar_imu_turn_xy + bar_imu_turn_yx  # imu-misalignment.e_z
    D[33] = -bar_i_vibration_rectification*rate_f_f_i  # lag.tau
    D[34] = bar_i_vibration_rectification*(B_x*x57 + B_y*x58 + B_z*x59)  # magnetic-bias.dK0_dB
    D[35] = b_f_xj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yx
    D[36] = b_f_yj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yy
    D[37] = b_f_zj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yz
    D[38] = b_f_xj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zx
    D[39] = b_f_yj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zy
    D[40] = b_f_zj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zz
    D[41] = bar_f_f_x*x93 - bar_q_f_x*x91 + f_r_x*x64  # near-mass.T_xxx
    D[42] = bar_f_f_y*x93 + bar_f_f_z*f_disc_r_z*f_r_y - bar_q_f_y*x91 - f_r_x*x70 - q_r_x*x71  # near-mass.T_xxy
    D[43] = bar_f_f_z*x93 + bar_q_p_second_order_misalignment*x91 - f_r_x*x69  # near-mass.T_xxz
    D[44] = bar_f_f_x*x95 + bar_f_f_z*f_disc_r_z*f_r_x - bar_q_f_x*x94 - f_r_x*x67 - q_r_x*x68  # near-mass.T_xyy
    D[45] = bar_q_p_second_order_misalignment*q_r_x*q_r_y - f_r_x*x65 - f_r_x*x66 - f_r_y*x69  # near-mass.T_xyz
    D[46] = bar_f_f_y*x95 - bar_q_f_y*x94 + f_r_y*x64  # near-mass.T_yyy
    D[47] = bar_f_f_z*x95 + bar_q_p_second_order_misalignment*x94 - f_r_y*x66  # near-mass.T_yyz
    D[48] = x82*np.abs(f_f_i)  # odd-quadratic.K_oq
    D[49] = bar_i_vibration_rectification*(-beta_x*(d2_spin_angle + omegadot_z) + f_tau_yx*(omegadot_x + x24) + f_tau_yy*(-x23 - x90))  # pendulum-angular.K_pa
    D[50] = bar_i_vibration_rectification*(pressure - 101325)  # pressure-bias.dK0_dp
    D[51] = bar_q_i_second_order_misalignment*(f_f_i - q_f_xj) + bar_q_o_second_order_misalignment*(f_f_o - q_f_yj) + bar_q_p_second_order_misalignment*(f_f_p + q_f_z)  # second-order-misalignment.kappa
    D[52] = -bar_M_xx*x96 - x97  # self-gradient.G_xx_roll
    D[53] = bar_spin_axis_tilt_Gamma_xy*x96  # self-gradient.G_xy_roll
    D[54] = bar_spin_axis_tilt_Gamma_xz*x96  # self-gradient.G_xz_roll
    D[55] = -bar_M_yy*x96 - x97  # self-gradient.G_yy_roll
    D[56] = bar_spin_axis_tilt_Gamma_yz*x96  # self-gradient.G_yz_roll
    D[57] = -bar_M_xx*x98 - x99  # self-gradient.G_xx_pitch
    D[58] = bar_spin_axis_tilt_Gamma_xy*x98  # self-gradient.G_xy_pitch
    D[59] = bar_spin_axis_tilt_Gamma_xz*x98  # self-gradient.G_xz_pitch
    D[60] = -bar_M_yy*x98 - x99  # self-gradient.G_yy_pitch
    D[61] = bar_spin_axis_tilt_Gamma_yz*x98  # self-gradient.G_yz_pitch
    D[62] = -Gamma_xy*bar_spin_axis_tilt_Gamma_xz + Gamma_xz*bar_spin_axis_tilt_Gamma_xy - bar_M_yy*x101 + bar_M_zz*x101 + bar_spin_axis_tilt_Gamma_yz*(-Gamma_yy - x100) - x72 - x73 - x74 + x76  # spin-axis-tilt.alpha_x
    D[63] = Gamma_xy*bar_spin_axis_tilt_Gamma_yz - Gamma_yz*bar_spin_axis_tilt_Gamma_xy + bar_M_xx*x102 - bar_M_zz*x102 + bar_spin_axis_tilt_Gamma_xz*(Gamma_xx + x100) + x75 - x77 - x78 - x79  # spin-axis-tilt.alpha_y
    D[64] = bar_wobble_xz*sin_phi - bar_wobble_yz*cos_phi - bar_wobble_zx*sin_phi + bar_wobble_zy*cos_phi  # spin-axis-wobble.w_x
    D[65] = bar_wobble_xz*cos_phi + bar_wobble_yz*sin_phi - bar_wobble_zx*cos_phi - bar_wobble_zy*sin_phi  # spin-axis-wobble.w_y
    D[66] = bar_sin_delta_phi  # spin-phase-offset.phi_0
    D[67] = bar_sin_delta_phi  # spin-rate-jitter.sigma_phi
    D[68] = bar_sin_delta_phi  # spin-rate-jitter.sigma_walk
    D[69] = bar_i_vibration_rectification*x103  # thermal-bias.dK0_dT
    D[70] = x103*x89  # thermal-scale.dK1_dT
    D[71] = bar_time_offset_a_x*d_a_x + bar_time_offset_a_y*d_a_y + bar_time_offset_a_z*d_a_z + bar_time_offset_omega_x*omegadot_x + bar_time_offset_omega_y*omegadot_y + bar_time_offset_omega_z*omegadot_z + bar_time_offset_omegadot_x*d_omegadot_x + bar_time_offset_omegadot_y*d_omegadot_y + bar_time_offset_omegadot_z*d_omegadot_z  # time-offset.delta_t
    D[72] = bar_i_vibration_rectification*(K2*vibration_axis_ix**2.0 + K5*vibration_axis_ox**2.0 + K7*vibration_axis_px**2.0 + vibration_axis_ox*x105 + vibration_axis_px*x104 + vibration_axis_px*x106)  # vibration-rectification.P_xx
    D[73] = bar_i_vibration_rectification*(vibration_axis_iy*x107 + vibration_axis_iy*x108 + vibration_axis_iy*x110 + vibration_axis_oy*x105 + vibration_axis_oy*x109 + vibration_axis_oy*x111 + vibration_axis_py*x104 + vibration_axis_py*x106 + vibration_axis_py*x112)  # vibration-rectification.P_xy
    D[74] = bar_i_vibration_rectification*(vibration_axis_iz*x107 + vibration_axis_iz*x108 + vibration_axis_iz*x110 + vibration_axis_oz*x105 + vibration_axis_oz*x109 + vibration_axis_oz*x111 + vibration_axis_pz*x104 + vibration_axis_pz*x106 + vibration_axis_pz*x112)  # vibration-rectification.P_xz
    D[75] = bar_i_vibration_rectification*(K2*vibration_axis_iy**2.0 + K5*vibration_axis_oy**2.0 + K7*vibration_axis_py**2.0 + vibration_axis_oy*x114 + vibration_axis_py*x113 + vibration_axis_py*x115)  # vibration-rectification.P_yy
    D[76] = bar_i_vibration_rectification*(vibration_axis_iy*vibration_axis_iz*x62 + vibration_axis_oy*vibration_axis_oz*x61 + vibration_axis_oy*x117 + vibration_axis_oz*x114 + vibration_axis_py*vibration_axis_pz*x60 + vibration_axis_py*x116 + vibration_axis_py*x118 + vibration_axis_pz*x113 + vibration_axis_pz*x115)  # vibration-rectification.P_yz
    D[77] = bar_i_vibration_rectification*(K2*vibration_axis_iz**2.0 + K5*vibration_axis_oz**2.0 + K7*vibration_axis_pz**2.0 + vibration_axis_oz*x117 + vibration_axis_pz*x116 + vibration_axis_pz*x118)  # vibration-rectification.P_zz
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
