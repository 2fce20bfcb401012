"""Signatures: what each candidate effect would add to V_j.

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: adc-nonlinearity, angular-jitter, anisoinertia, arm-length, arm-sag, arm-stretch, bearing-run-out, bias-drift, bias-step, clock-drift, cubic-cross, cubic-input, encoder-harmonic, fuel-gradient, gain-drift, gain-step, gradient-offset, gyro-bias, gyro-delay, gyro-g-sensitivity, gyro-scale, imu-acceleration-bias, imu-acceleration-misalignment, imu-acceleration-scale, imu-lever-arm, imu-misalignment, lag, magnetic-bias, mount-compliance, near-mass, odd-quadratic, output-filter, output-gain-step, pendulum-angular, pressure-bias, second-order-loop, second-order-misalignment, self-gradient, self-gradient-yaw, spin-axis-tilt, spin-axis-wobble, spin-phase-offset, spin-rate-jitter, spin-rate-offset, spin-servo, thermal-bias, thermal-lag, thermal-scale, time-offset, vibration-level, vibration-rectification.
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
    d2_spin_angle = inputs[25]
    d_spin_angle = inputs[32]
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
    x1 = d_spin_angle + omega_z
    x2 = -x1
    x3 = -x1*x2
    M_xx = -Gamma_xx - x0 - x3
    x4 = d2_spin_angle + omegadot_z
    x5 = omega_x*omega_y
    x6 = Gamma_xy - x5
    M_xy = -x4 - x6
    x7 = -omegadot_y
    x8 = d_spin_angle*omega_x
    x9 = x7 + x8
    M_xz = -Gamma_xz - omega_x*x2 - x9
    x10 = omegadot_z + x5
    x11 = -Gamma_xy + x10
    M_yx = d2_spin_angle + x11
    x12 = omega_x**2.0
    M_yy = -Gamma_yy - x12 - x3
    x13 = d_spin_angle*omega_y
    x14 = omegadot_x + x13
    M_yz = -Gamma_yz + omega_y*x1 - x14
    x15 = Gamma_xz + omegadot_y
    M_zx = omega_x*x1 - x15 + x8
    x16 = -omegadot_x
    M_zy = -Gamma_yz - omega_y*x2 + x13 - x16
    x17 = x0 + x12
    x18 = -Gamma_zz - x17
    M_zz = x18
    cos_psi = cos_j*cos_phi - sin_j*sin_phi
    sin_psi = cos_j*sin_phi + cos_phi*sin_j
    x19 = dR + radius
    b_disc_r_x = x19
    x20 = beta_z*x19
    b_disc_r_y = x20
    x21 = beta_x*x19
    b_disc_r_z = x21
    x22 = -beta_x*beta_z
    b_disc_tau_zy = x22
    b_r_x = b_disc_r_x*cos_psi - b_disc_r_y*sin_psi
    b_r_y = b_disc_r_x*sin_psi + b_disc_r_y*cos_psi
    x23 = beta_z*cos_psi + sin_psi
    x24 = -x23
    b_tau_xx = x24
    x25 = -beta_z*sin_psi + cos_psi
    b_tau_xy = x25
    b_tau_yx = x25
    b_tau_yy = x23
    x26 = beta_x*cos_psi
    b_tau_zx = -b_disc_tau_zy*sin_psi - x26
    x27 = beta_x*sin_psi
    b_tau_zy = b_disc_tau_zy*cos_psi - x27
    x28 = d_spin_angle*sin_phi
    x29 = -x28
    rate_cos_phi_true = x29
    x30 = cos_phi*d_spin_angle
    rate_sin_phi_true = x30
    x31 = d2_spin_angle*sin_phi
    x32 = d_spin_angle**2.0
    x33 = cos_phi*x32
    x34 = -x31 - x33
    rate_rate_cos_phi_true = x34
    x35 = cos_phi*d2_spin_angle
    x36 = sin_phi*x32
    x37 = x35 - x36
    rate_rate_sin_phi_true = x37
    b_f_x = M_xx*b_r_x + M_xy*b_r_y + M_xz*b_disc_r_z + a_x
    b_f_y = M_yx*b_r_x + M_yy*b_r_y + M_yz*b_disc_r_z + a_y
    b_f_z = M_zx*b_r_x + M_zy*b_r_y + M_zz*b_disc_r_z + a_z
    b_f_xj = b_f_x*b_tau_xx + b_f_y*b_tau_xy
    b_f_yj = b_f_x*b_tau_yx + b_f_y*b_tau_yy - b_f_z*beta_x
    b_f_zj = b_f_x*b_tau_zx + b_f_y*b_tau_zy - b_f_z
    f_disc_r_x = x19
    f_disc_r_y = x20
    f_disc_r_z = x21
    f_disc_tau_zy = x22
    f_r_x = cos_psi*f_disc_r_x - f_disc_r_y*sin_psi
    f_r_y = cos_psi*f_disc_r_y + f_disc_r_x*sin_psi
    f_tau_xx = x24
    f_tau_xy = x25
    f_tau_yx = x25
    f_tau_yy = x23
    f_tau_zx = -f_disc_tau_zy*sin_psi - x26
    f_tau_zy = cos_psi*f_disc_tau_zy - x27
    x38 = x19**(-1.0)
    f_arm_x = f_r_x*x38
    f_arm_y = f_r_y*x38
    f_arm_z = f_disc_r_z*x38
    x39 = 2.0*omega_y
    x40 = omegadot_y*x39
    x41 = 2.0*d_spin_angle
    x42 = 2.0*omega_z
    x43 = -x41 - x42
    x44 = d2_spin_angle*x43 + omegadot_z*x43
    x45 = -x40 + x44
    rate_M_xx = x45
    x46 = omega_x*omegadot_y + omega_y*omegadot_x
    x47 = -d_omegadot_z + x46
    rate_M_xy = x47
    x48 = omega_x*omegadot_z
    x49 = d_omegadot_y + omega_z*omegadot_x + x48
    rate_M_xz = x49
    V2__rate_cos_phi_true = x29
    V2__rate_sin_phi_true = x30
    rate_cos_psi = V2__rate_cos_phi_true*cos_j - V2__rate_sin_phi_true*sin_j
    rate_sin_psi = V2__rate_cos_phi_true*sin_j + V2__rate_sin_phi_true*cos_j
    rate_b_r_x = b_disc_r_x*rate_cos_psi - b_disc_r_y*rate_sin_psi
    rate_b_r_y = b_disc_r_x*rate_sin_psi + b_disc_r_y*rate_cos_psi
    rate_b_f_x = M_xx*rate_b_r_x + M_xy*rate_b_r_y + b_disc_r_z*rate_M_xz + b_r_x*rate_M_xx + b_r_y*rate_M_xy + d_a_x
    x50 = d_omegadot_z + x46
    rate_M_yx = x50
    x51 = 2.0*omegadot_x
    x52 = omega_x*x51
    x53 = x44 - x52
    rate_M_yy = x53
    x54 = omega_y*omegadot_z
    x55 = -d_omegadot_x + omega_z*omegadot_y + x54
    rate_M_yz = x55
    rate_b_f_y = M_yx*rate_b_r_x + M_yy*rate_b_r_y + b_disc_r_z*rate_M_yz + b_r_x*rate_M_yx + b_r_y*rate_M_yy + d_a_y
    x56 = 2.0*d2_spin_angle
    x57 = omega_z + x41
    x58 = -d_omegadot_y + omega_x*x56 + omegadot_x*x57 + x48
    rate_M_zx = x58
    x59 = d_omegadot_x + omega_y*x56 + omegadot_y*x57 + x54
    rate_M_zy = x59
    x60 = -x40 - x52
    rate_M_zz = x60
    rate_b_f_z = M_zx*rate_b_r_x + M_zy*rate_b_r_y + b_disc_r_z*rate_M_zz + b_r_x*rate_M_zx + b_r_y*rate_M_zy + d_a_z
    rate_b_tau_yx = -beta_z*rate_sin_psi + rate_cos_psi
    rate_b_tau_yy = beta_z*rate_cos_psi + rate_sin_psi
    rate_b_f_yj = b_f_x*rate_b_tau_yx + b_f_y*rate_b_tau_yy + b_tau_yx*rate_b_f_x + b_tau_yy*rate_b_f_y - beta_x*rate_b_f_z
    rate_b_tau_zx = -b_disc_tau_zy*rate_sin_psi - beta_x*rate_cos_psi
    rate_b_tau_zy = b_disc_tau_zy*rate_cos_psi - beta_x*rate_sin_psi
    rate_b_f_zj = b_f_x*rate_b_tau_zx + b_f_y*rate_b_tau_zy + b_tau_zx*rate_b_f_x + b_tau_zy*rate_b_f_y - rate_b_f_z
    rate_V2__rate_cos_phi_true = x34
    rate_V2__rate_sin_phi_true = x37
    x61 = 2.0*omegadot_y**2.0
    x62 = d_omegadot_y*x39
    x63 = 2.0*omegadot_z
    x64 = -x56 - x63
    x65 = d2_spin_angle*x64 + d_omegadot_z*x43 + omegadot_z*x64
    x66 = -x61 - x62 + x65
    rate_rate_M_xx = x66
    x67 = d_omegadot_x*omega_y + d_omegadot_y*omega_x + omegadot_y*x51
    x68 = -d2_omegadot_z + x67
    rate_rate_M_xy = x68
    x69 = d_omegadot_z*omega_x
    x70 = d2_omegadot_y + d_omegadot_x*omega_z + omegadot_x*x63 + x69
    rate_rate_M_xz = x70
    rate_rate_cos_psi = cos_j*rate_V2__rate_cos_phi_true - rate_V2__rate_sin_phi_true*sin_j
    rate_rate_sin_psi = cos_j*rate_V2__rate_sin_phi_true + rate_V2__rate_cos_phi_true*sin_j
    rate_rate_b_r_x = b_disc_r_x*rate_rate_cos_psi - b_disc_r_y*rate_rate_sin_psi
    rate_rate_b_r_y = b_disc_r_x*rate_rate_sin_psi + b_disc_r_y*rate_rate_cos_psi
    x71 = 2.0*rate_b_r_x
    x72 = 2.0*rate_b_r_y
    rate_rate_b_f_x = M_xx*rate_rate_b_r_x + M_xy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_xz + b_r_x*rate_rate_M_xx + b_r_y*rate_rate_M_xy + d2_a_x + rate_M_xx*x71 + rate_M_xy*x72
    x73 = d2_omegadot_z + x67
    rate_rate_M_yx = x73
    x74 = 2.0*omegadot_x**2.0
    x75 = 2.0*omega_x
    x76 = d_omegadot_x*x75
    x77 = x65 - x74 - x76
    rate_rate_M_yy = x77
    x78 = d_omegadot_z*omega_y
    x79 = -d2_omegadot_x + d_omegadot_y*omega_z + omegadot_y*x63 + x78
    rate_rate_M_yz = x79
    rate_rate_b_f_y = M_yx*rate_rate_b_r_x + M_yy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_yz + b_r_x*rate_rate_M_yx + b_r_y*rate_rate_M_yy + d2_a_y + rate_M_yx*x71 + rate_M_yy*x72
    x80 = omegadot_z + x56
    x81 = -d2_omegadot_y + d_omegadot_x*x57 + omegadot_x*omegadot_z + omegadot_x*x56 + omegadot_x*x80 + x69
    rate_rate_M_zx = x81
    x82 = d2_omegadot_x + d_omegadot_y*x57 + omegadot_y*omegadot_z + omegadot_y*x56 + omegadot_y*x80 + x78
    rate_rate_M_zy = x82
    x83 = -x61 - x62 - x74 - x76
    rate_rate_M_zz = x83
    rate_rate_b_f_z = M_zx*rate_rate_b_r_x + M_zy*rate_rate_b_r_y + b_disc_r_z*rate_rate_M_zz + b_r_x*rate_rate_M_zx + b_r_y*rate_rate_M_zy + d2_a_z + rate_M_zx*x71 + rate_M_zy*x72
    rate_rate_b_tau_yx = -beta_z*rate_rate_sin_psi + rate_rate_cos_psi
    rate_rate_b_tau_yy = beta_z*rate_rate_cos_psi + rate_rate_sin_psi
    x84 = 2.0*rate_b_f_x
    x85 = 2.0*rate_b_f_y
    rate_rate_b_f_yj = b_f_x*rate_rate_b_tau_yx + b_f_y*rate_rate_b_tau_yy + b_tau_yx*rate_rate_b_f_x + b_tau_yy*rate_rate_b_f_y - beta_x*rate_rate_b_f_z + rate_b_tau_yx*x84 + rate_b_tau_yy*x85
    rate_rate_b_tau_zx = -b_disc_tau_zy*rate_rate_sin_psi - beta_x*rate_rate_cos_psi
    rate_rate_b_tau_zy = b_disc_tau_zy*rate_rate_cos_psi - beta_x*rate_rate_sin_psi
    rate_rate_b_f_zj = b_f_x*rate_rate_b_tau_zx + b_f_y*rate_rate_b_tau_zy + b_tau_zx*rate_rate_b_f_x + b_tau_zy*rate_rate_b_f_y + rate_b_tau_zx*x84 + rate_b_tau_zy*x85 - rate_rate_b_f_z
    f_f_x = M_xx*f_r_x + M_xy*f_r_y + M_xz*f_disc_r_z + a_x
    f_f_y = M_yx*f_r_x + M_yy*f_r_y + M_yz*f_disc_r_z + a_y
    f_f_z = M_zx*f_r_x + M_zy*f_r_y + M_zz*f_disc_r_z + a_z
    f_f_xj = f_f_x*f_tau_xx + f_f_y*f_tau_xy
    f_f_yj = -beta_x*f_f_z + f_f_x*f_tau_yx + f_f_y*f_tau_yy
    f_f_zj = f_f_x*f_tau_zx + f_f_y*f_tau_zy - f_f_z
    f_f_i = f_f_xj + f_f_yj*vartheta_z - f_f_zj*vartheta_y
    f_f_o = -f_f_xj*vartheta_z + f_f_yj + f_f_zj*vartheta_x
    f_f_p = f_f_xj*vartheta_y - f_f_yj*vartheta_x + f_f_zj
    q_disc_r_x = x19
    q_r_x = cos_psi*q_disc_r_x
    q_r_y = q_disc_r_x*sin_psi
    q_arm_x = q_r_x*x38
    q_arm_y = q_r_y*x38
    q_f_x = M_xx*q_r_x + M_xy*q_r_y + a_x
    q_f_y = M_yx*q_r_x + M_yy*q_r_y + a_y
    q_f_z = M_zx*q_r_x + M_zy*q_r_y + a_z
    q_f_xj = cos_psi*q_f_y - q_f_x*sin_psi
    q_f_yj = cos_psi*q_f_x + q_f_y*sin_psi
    x86 = K6*q_f_yj
    x87 = K4*q_f_z
    x88 = K8*q_f_z
    i_sensed = K0 + K2*q_f_xj**2.0 + K5*q_f_yj**2.0 + K7*q_f_z**2.0 + f_f_i + q_f_xj*x86 - q_f_xj*x87 - q_f_yj*x88
    V2__rate_M_xx = x45
    V2__rate_M_xy = x47
    V2__rate_M_xz = x49
    V2__rate_cos_psi = cos_j*rate_cos_phi_true - rate_sin_phi_true*sin_j
    V2__rate_sin_psi = cos_j*rate_sin_phi_true + rate_cos_phi_true*sin_j
    rate_f_r_x = V2__rate_cos_psi*f_disc_r_x - V2__rate_sin_psi*f_disc_r_y
    rate_f_r_y = V2__rate_cos_psi*f_disc_r_y + V2__rate_sin_psi*f_disc_r_x
    rate_f_f_x = M_xx*rate_f_r_x + M_xy*rate_f_r_y + V2__rate_M_xx*f_r_x + V2__rate_M_xy*f_r_y + V2__rate_M_xz*f_disc_r_z + d_a_x
    V2__rate_M_yx = x50
    V2__rate_M_yy = x53
    V2__rate_M_yz = x55
    rate_f_f_y = M_yx*rate_f_r_x + M_yy*rate_f_r_y + V2__rate_M_yx*f_r_x + V2__rate_M_yy*f_r_y + V2__rate_M_yz*f_disc_r_z + d_a_y
    x89 = V2__rate_cos_psi*beta_z + V2__rate_sin_psi
    rate_f_tau_xx = -x89
    x90 = V2__rate_cos_psi - V2__rate_sin_psi*beta_z
    rate_f_tau_xy = x90
    rate_f_f_xj = f_f_x*rate_f_tau_xx + f_f_y*rate_f_tau_xy + f_tau_xx*rate_f_f_x + f_tau_xy*rate_f_f_y
    V2__rate_M_zx = x58
    V2__rate_M_zy = x59
    V2__rate_M_zz = x60
    rate_f_f_z = M_zx*rate_f_r_x + M_zy*rate_f_r_y + V2__rate_M_zx*f_r_x + V2__rate_M_zy*f_r_y + V2__rate_M_zz*f_disc_r_z + d_a_z
    rate_f_tau_yx = x90
    rate_f_tau_yy = x89
    rate_f_f_yj = -beta_x*rate_f_f_z + f_f_x*rate_f_tau_yx + f_f_y*rate_f_tau_yy + f_tau_yx*rate_f_f_x + f_tau_yy*rate_f_f_y
    rate_f_tau_zx = -V2__rate_cos_psi*beta_x - V2__rate_sin_psi*f_disc_tau_zy
    rate_f_tau_zy = V2__rate_cos_psi*f_disc_tau_zy - V2__rate_sin_psi*beta_x
    rate_f_f_zj = f_f_x*rate_f_tau_zx + f_f_y*rate_f_tau_zy + f_tau_zx*rate_f_f_x + f_tau_zy*rate_f_f_y - rate_f_f_z
    rate_f_f_i = rate_f_f_xj + rate_f_f_yj*vartheta_z - rate_f_f_zj*vartheta_y
    rate_V2__rate_M_xx = x66
    rate_V2__rate_M_xy = x68
    rate_V2__rate_M_xz = x70
    rate_V2__rate_cos_psi = cos_j*rate_rate_cos_phi_true - rate_rate_sin_phi_true*sin_j
    rate_V2__rate_sin_psi = cos_j*rate_rate_sin_phi_true + rate_rate_cos_phi_true*sin_j
    rate_rate_f_r_x = f_disc_r_x*rate_V2__rate_cos_psi - f_disc_r_y*rate_V2__rate_sin_psi
    rate_rate_f_r_y = f_disc_r_x*rate_V2__rate_sin_psi + f_disc_r_y*rate_V2__rate_cos_psi
    x91 = 2.0*rate_f_r_x
    x92 = 2.0*rate_f_r_y
    rate_rate_f_f_x = M_xx*rate_rate_f_r_x + M_xy*rate_rate_f_r_y + V2__rate_M_xx*x91 + V2__rate_M_xy*x92 + d2_a_x + f_disc_r_z*rate_V2__rate_M_xz + f_r_x*rate_V2__rate_M_xx + f_r_y*rate_V2__rate_M_xy
    rate_V2__rate_M_yx = x73
    rate_V2__rate_M_yy = x77
    rate_V2__rate_M_yz = x79
    rate_rate_f_f_y = M_yx*rate_rate_f_r_x + M_yy*rate_rate_f_r_y + V2__rate_M_yx*x91 + V2__rate_M_yy*x92 + d2_a_y + f_disc_r_z*rate_V2__rate_M_yz + f_r_x*rate_V2__rate_M_yx + f_r_y*rate_V2__rate_M_yy
    x93 = beta_z*rate_V2__rate_cos_psi + rate_V2__rate_sin_psi
    rate_rate_f_tau_xx = -x93
    x94 = -beta_z*rate_V2__rate_sin_psi + rate_V2__rate_cos_psi
    rate_rate_f_tau_xy = x94
    x95 = 2.0*rate_f_f_x
    x96 = 2.0*rate_f_f_y
    rate_rate_f_f_xj = f_f_x*rate_rate_f_tau_xx + f_f_y*rate_rate_f_tau_xy + f_tau_xx*rate_rate_f_f_x + f_tau_xy*rate_rate_f_f_y + rate_f_tau_xx*x95 + rate_f_tau_xy*x96
    rate_V2__rate_M_zx = x81
    rate_V2__rate_M_zy = x82
    rate_V2__rate_M_zz = x83
    rate_rate_f_f_z = M_zx*rate_rate_f_r_x + M_zy*rate_rate_f_r_y + V2__rate_M_zx*x91 + V2__rate_M_zy*x92 + d2_a_z + f_disc_r_z*rate_V2__rate_M_zz + f_r_x*rate_V2__rate_M_zx + f_r_y*rate_V2__rate_M_zy
    rate_rate_f_tau_yx = x94
    rate_rate_f_tau_yy = x93
    rate_rate_f_f_yj = -beta_x*rate_rate_f_f_z + f_f_x*rate_rate_f_tau_yx + f_f_y*rate_rate_f_tau_yy + f_tau_yx*rate_rate_f_f_x + f_tau_yy*rate_rate_f_f_y + rate_f_tau_yx*x95 + rate_f_tau_yy*x96
    rate_rate_f_tau_zx = -beta_x*rate_V2__rate_cos_psi - f_disc_tau_zy*rate_V2__rate_sin_psi
    rate_rate_f_tau_zy = -beta_x*rate_V2__rate_sin_psi + f_disc_tau_zy*rate_V2__rate_cos_psi
    rate_rate_f_f_zj = f_f_x*rate_rate_f_tau_zx + f_f_y*rate_rate_f_tau_zy + f_tau_zx*rate_rate_f_f_x + f_tau_zy*rate_rate_f_f_y + rate_f_tau_zx*x95 + rate_f_tau_zy*x96 - rate_rate_f_f_z
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
    x97 = 2.0*rate_q_r_x
    x98 = 2.0*rate_q_r_y
    rate_rate_q_f_x = M_xx*rate_rate_q_r_x + M_xy*rate_rate_q_r_y + V2__rate_M_xx*x97 + V2__rate_M_xy*x98 + d2_a_x + q_r_x*rate_V2__rate_M_xx + q_r_y*rate_V2__rate_M_xy
    rate_rate_q_f_y = M_yx*rate_rate_q_r_x + M_yy*rate_rate_q_r_y + V2__rate_M_yx*x97 + V2__rate_M_yy*x98 + d2_a_y + q_r_x*rate_V2__rate_M_yx + q_r_y*rate_V2__rate_M_yy
    x100 = 2.0*rate_q_f_x
    x99 = 2.0*rate_q_f_y
    rate_rate_q_f_xj = V2__rate_cos_psi*x99 - V2__rate_sin_psi*x100 + cos_psi*rate_rate_q_f_y - q_f_x*rate_V2__rate_sin_psi + q_f_y*rate_V2__rate_cos_psi - rate_rate_q_f_x*sin_psi
    rate_rate_q_f_yj = V2__rate_cos_psi*x100 + V2__rate_sin_psi*x99 + cos_psi*rate_rate_q_f_x + q_f_x*rate_V2__rate_cos_psi + q_f_y*rate_V2__rate_sin_psi + rate_rate_q_f_y*sin_psi
    rate_rate_q_f_z = M_zx*rate_rate_q_r_x + M_zy*rate_rate_q_r_y + V2__rate_M_zx*x97 + V2__rate_M_zy*x98 + d2_a_z + q_r_x*rate_V2__rate_M_zx + q_r_y*rate_V2__rate_M_zy
    x101 = 2.0*K2
    x102 = 2.0*K5
    x103 = 2.0*K7
    x104 = q_f_xj*x101 + x86 - x87
    x105 = K6*q_f_xj + q_f_yj*x102 - x88
    x106 = K4*q_f_xj + K8*q_f_yj - q_f_z*x103
    rate_rate_i_sensed = rate_q_f_xj*(-K4*rate_q_f_z + K6*rate_q_f_yj + rate_q_f_xj*x101) + rate_q_f_yj*(K6*rate_q_f_xj - K8*rate_q_f_z + rate_q_f_yj*x102) - rate_q_f_z*(K4*rate_q_f_xj + K8*rate_q_f_yj - rate_q_f_z*x103) + rate_rate_f_f_i + rate_rate_q_f_xj*x104 + rate_rate_q_f_yj*x105 - rate_rate_q_f_z*x106
    x107 = f_tau_xx + f_tau_yx*vartheta_z - f_tau_zx*vartheta_y
    vibration_axis_ix = x107
    x108 = f_tau_xy + f_tau_yy*vartheta_z - f_tau_zy*vartheta_y
    vibration_axis_iy = x108
    x109 = -beta_x*vartheta_z + vartheta_y
    vibration_axis_iz = x109
    vibration_axis_ox = -f_tau_xx*vartheta_z + f_tau_yx + f_tau_zx*vartheta_x
    vibration_axis_oy = -f_tau_xy*vartheta_z + f_tau_yy + f_tau_zy*vartheta_x
    vibration_axis_oz = -beta_x - vartheta_x
    vibration_axis_px = f_tau_xx*vartheta_y - f_tau_yx*vartheta_x + f_tau_zx
    vibration_axis_py = f_tau_xy*vartheta_y - f_tau_yy*vartheta_x + f_tau_zy
    vibration_axis_pz = beta_x*vartheta_x - 1
    bar_i_vibration_rectification = K1*k_VI
    bar_q_p_second_order_misalignment = bar_i_vibration_rectification*x106
    bar_q_o_second_order_misalignment = bar_i_vibration_rectification*x105
    bar_q_i_second_order_misalignment = bar_i_vibration_rectification*x104
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
    x110 = 2.0*x1
    bar_rate_dR_arm_stretch = bar_f_f_x*(-f_arm_y*x110 + 2.0*f_arm_z*omega_y) + bar_f_f_y*(f_arm_x*x110 - f_arm_z*x75) + bar_f_f_z*(-f_arm_x*x39 + 2.0*f_arm_y*omega_x) - bar_q_f_x*q_arm_y*x110 + bar_q_f_y*q_arm_x*x110 - bar_q_p_second_order_misalignment*(-q_arm_x*x39 + q_arm_y*x75)
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
    x111 = bar_f_f_z - bar_q_p_second_order_misalignment
    bar_rate_rate_run_out_z = x111
    x112 = bar_f_f_y + bar_q_f_y
    bar_rate_rate_run_out_y = x112
    x113 = bar_f_f_x + bar_q_f_x
    bar_rate_rate_run_out_x = x113
    bar_rate_run_out_z = bar_f_f_x*x39 - bar_f_f_y*x75 + bar_q_f_x*x39 - bar_q_f_y*x75
    bar_rate_run_out_y = -bar_f_f_x*x42 + 2.0*bar_f_f_z*omega_x - bar_q_f_x*x42 - bar_q_p_second_order_misalignment*x75
    bar_rate_run_out_x = bar_f_f_y*x42 - bar_f_f_z*x39 + bar_q_f_y*x42 + bar_q_p_second_order_misalignment*x39
    x114 = omega_x*omega_z
    x115 = omegadot_y + x114
    x116 = -Gamma_xz + x115
    x117 = omega_y*omega_z
    x118 = -Gamma_yz - omegadot_x + x117
    bar_run_out_z = bar_f_f_x*x116 + bar_f_f_y*x118 + bar_f_f_z*x18 + bar_q_f_x*x116 + bar_q_f_y*x118 - bar_q_p_second_order_misalignment*x18
    x119 = omegadot_x + x117
    x120 = -Gamma_yz + x119
    x121 = -omegadot_z - x6
    x122 = omega_z**2.0
    x123 = x12 + x122
    x124 = -Gamma_yy - x123
    bar_run_out_y = bar_f_f_x*x121 + bar_f_f_y*x124 + bar_f_f_z*x120 + bar_q_f_x*x121 + bar_q_f_y*x124 - bar_q_p_second_order_misalignment*x120
    x125 = x114 - x15
    x126 = x0 + x122
    x127 = -Gamma_xx - x126
    bar_run_out_x = bar_f_f_x*x127 + bar_f_f_y*x11 + bar_f_f_z*x125 + bar_q_f_x*x127 + bar_q_f_y*x11 - bar_q_p_second_order_misalignment*x125
    bar_wobble_zy = bar_f_spin_axis_wobble_r_z*f_r_y + bar_f_spin_axis_wobble_tau_xz*f_tau_xy + bar_f_spin_axis_wobble_tau_yz*f_tau_yy + bar_f_spin_axis_wobble_tau_zz*f_tau_zy + bar_q_spin_axis_wobble_r_z*q_r_y + bar_q_spin_axis_wobble_tau_xz*cos_psi + bar_q_spin_axis_wobble_tau_yz*sin_psi
    bar_wobble_zx = bar_f_spin_axis_wobble_r_z*f_r_x + bar_f_spin_axis_wobble_tau_xz*f_tau_xx + bar_f_spin_axis_wobble_tau_yz*f_tau_yx + bar_f_spin_axis_wobble_tau_zz*f_tau_zx + bar_q_spin_axis_wobble_r_z*q_r_x - bar_q_spin_axis_wobble_tau_xz*sin_psi + bar_q_spin_axis_wobble_tau_yz*cos_psi
    bar_wobble_yz = bar_f_spin_axis_wobble_r_y*f_disc_r_z - bar_f_spin_axis_wobble_tau_yy*beta_x - bar_f_spin_axis_wobble_tau_zy - bar_q_p_second_order_misalignment*q_f_y
    bar_wobble_xz = bar_f_spin_axis_wobble_r_x*f_disc_r_z - bar_f_spin_axis_wobble_tau_yx*beta_x - bar_f_spin_axis_wobble_tau_zx - bar_q_p_second_order_misalignment*q_f_x
    bar_sin_psi = -bar_f_spin_axis_wobble_r_x*f_disc_r_y + bar_f_spin_axis_wobble_r_y*f_disc_r_x - bar_f_spin_axis_wobble_tau_xx - bar_f_spin_axis_wobble_tau_xy*beta_z - bar_f_spin_axis_wobble_tau_yx*beta_z + bar_f_spin_axis_wobble_tau_yy - bar_f_spin_axis_wobble_tau_zx*f_disc_tau_zy - bar_f_spin_axis_wobble_tau_zy*beta_x + bar_q_spin_axis_wobble_r_y*q_disc_r_x - bar_q_spin_axis_wobble_tau_xx + bar_q_spin_axis_wobble_tau_yy
    bar_cos_psi = bar_f_spin_axis_wobble_r_x*f_disc_r_x + bar_f_spin_axis_wobble_r_y*f_disc_r_y - bar_f_spin_axis_wobble_tau_xx*beta_z + bar_f_spin_axis_wobble_tau_xy + bar_f_spin_axis_wobble_tau_yx + bar_f_spin_axis_wobble_tau_yy*beta_z - bar_f_spin_axis_wobble_tau_zx*beta_x + bar_f_spin_axis_wobble_tau_zy*f_disc_tau_zy + bar_q_spin_axis_wobble_r_x*q_disc_r_x + bar_q_spin_axis_wobble_tau_xy + bar_q_spin_axis_wobble_tau_yx
    x128 = bar_f_f_z*f_disc_r_z
    bar_M_zz = x128
    x129 = bar_f_f_z*f_r_y
    x130 = bar_q_p_second_order_misalignment*q_r_y
    bar_M_zy = x129 - x130
    x131 = bar_q_p_second_order_misalignment*q_r_x
    bar_M_zx = bar_f_f_z*f_r_x - x131
    x132 = bar_f_f_y*f_disc_r_z
    bar_M_yz = x132
    x133 = bar_f_f_y*f_r_y
    x134 = bar_q_f_y*q_r_y
    bar_M_yy = x133 + x134
    x135 = bar_q_f_y*q_r_x
    bar_M_yx = bar_f_f_y*f_r_x + x135
    x136 = bar_f_f_x*f_disc_r_z
    bar_M_xz = x136
    x137 = bar_f_f_x*f_r_y
    x138 = bar_q_f_x*q_r_y
    bar_M_xy = x137 + x138
    x139 = bar_q_f_x*q_r_x
    bar_M_xx = bar_f_f_x*f_r_x + x139
    x140 = -bar_M_xy + bar_M_yx
    bar_spin_acceleration_true = x140
    x141 = bar_M_zx*omega_x
    x142 = bar_M_zy*omega_y
    x143 = bar_M_xx*x43 + bar_M_yy*x43
    bar_spin_rate_true = 2.0*x141 + 2.0*x142 + x143
    bar_sin_phi_true = -bar_cos_psi*sin_j + bar_sin_psi*cos_j
    bar_cos_phi_true = bar_cos_psi*cos_j + bar_sin_psi*sin_j
    bar_sin_delta_phi = -bar_cos_phi_true*sin_phi + bar_sin_phi_true*cos_phi
    bar_time_offset_omegadot_z = x140
    bar_time_offset_omegadot_y = bar_M_xz - bar_M_zx
    bar_time_offset_omegadot_x = -bar_M_yz + bar_M_zy
    bar_time_offset_omega_z = bar_M_xz*omega_x + bar_M_yz*omega_y + x141 + x142 + x143
    bar_time_offset_omega_y = -bar_M_xx*x39 + bar_M_xy*omega_x + bar_M_yx*omega_x + bar_M_yz*omega_z + bar_M_zy*x57 - bar_M_zz*x39
    bar_time_offset_omega_x = bar_M_xy*omega_y + bar_M_xz*omega_z + bar_M_yx*omega_y - bar_M_yy*x75 + bar_M_zx*x57 - bar_M_zz*x75
    bar_time_offset_a_z = x111
    bar_time_offset_a_y = x112
    bar_time_offset_a_x = x113
    bar_spin_axis_tilt_Gamma_yz = -bar_M_yz - bar_M_zy
    bar_spin_axis_tilt_Gamma_xz = -bar_M_xz - bar_M_zx
    bar_spin_axis_tilt_Gamma_xy = -bar_M_xy - bar_M_yx
    x144 = a_y*bar_time_offset_a_z
    x145 = bar_time_offset_omega_z*omega_y
    x146 = bar_time_offset_omegadot_z*omegadot_y
    bar_imu_turn_zy = x144 + x145 + x146
    x147 = a_x*bar_time_offset_a_z
    x148 = bar_time_offset_omega_z*omega_x + bar_time_offset_omegadot_z*omegadot_x + x147
    bar_imu_turn_zx = x148
    x149 = a_z*bar_time_offset_a_y
    x150 = bar_time_offset_omega_y*omega_z + bar_time_offset_omegadot_y*omegadot_z + x149
    bar_imu_turn_yz = x150
    x151 = a_x*bar_time_offset_a_y
    bar_imu_turn_yx = bar_time_offset_omega_y*omega_x + bar_time_offset_omegadot_y*omegadot_x + x151
    x152 = a_z*bar_time_offset_a_x
    x153 = bar_time_offset_omega_x*omega_z
    x154 = bar_time_offset_omegadot_x*omegadot_z
    bar_imu_turn_xz = x152 + x153 + x154
    x155 = a_y*bar_time_offset_a_x
    bar_imu_turn_xy = bar_time_offset_omega_x*omega_y + bar_time_offset_omegadot_x*omegadot_y + x155
    x156 = angular_vibration_rms**2.0
    x157 = bar_M_yy*x156
    x158 = bar_M_zz*x156
    x159 = bar_M_xx*x156
    x160 = bar_run_out_x*cos_phi
    x161 = bar_run_out_y*cos_phi
    x162 = bar_run_out_z*cos_phi
    x163 = 2.0*cos_phi
    x164 = 2.0*sin_phi
    x165 = rate_cos_phi_true*x163 - rate_sin_phi_true*x164
    x166 = cos_phi**2.0
    x167 = sin_phi**2.0
    x168 = x166 - x167
    x169 = 2.0*rate_cos_phi_true**2.0 + rate_rate_cos_phi_true*x163 - rate_rate_sin_phi_true*x164 - 2.0*rate_sin_phi_true**2.0
    x170 = rate_cos_phi_true*x164 + rate_sin_phi_true*x163
    x171 = 4.0*rate_cos_phi_true*rate_sin_phi_true + rate_rate_cos_phi_true*x164 + rate_rate_sin_phi_true*x163
    x172 = bar_time_offset_a_x*d_a_x
    x173 = bar_time_offset_a_y*d_a_y
    x174 = bar_time_offset_a_z*d_a_z
    x175 = bar_time_offset_omega_x*omegadot_x
    x176 = bar_time_offset_omega_y*omegadot_y
    x177 = bar_time_offset_omega_z*omegadot_z
    x178 = bar_time_offset_omegadot_x*d_omegadot_x
    x179 = bar_time_offset_omegadot_y*d_omegadot_y
    x180 = bar_time_offset_omegadot_z*d_omegadot_z
    x181 = bar_i_vibration_rectification*f_f_i**2.0
    x182 = f_f_o**2.0
    x183 = bar_i_vibration_rectification*f_f_i
    x184 = f_f_p**2.0
    x185 = bar_sin_delta_phi*cos_phi
    x186 = bar_spin_rate_true*x28
    x187 = 4.0*cos_phi
    x188 = cos_phi**3.0
    x189 = sin_phi**3.0
    x190 = 9.0*x166
    x191 = 9.0*x32
    x192 = 3.0*x188
    x193 = 9.0*x167
    x194 = cos_phi**4.0
    x195 = sin_phi**4.0
    x196 = x166*x167
    x197 = 16.0*x188
    x198 = 16.0*x32
    x199 = 4.0*d_spin_angle
    x200 = 24.0*x196
    x201 = 4.0*d2_spin_angle
    x202 = -bar_M_zz*fuel_mass
    x203 = K1*bar_K1_thermal_scale
    x204 = -bar_M_zz
    x205 = x175 + x176 + x177
    x206 = x178 + x179 + x180
    x207 = -x152
    x208 = -x144
    x209 = f_r_x*x128
    x210 = 0.5*q_r_x**2.0
    x211 = 0.5*f_disc_r_z**2.0
    x212 = f_r_x**2.0
    x213 = 0.5*x212
    x214 = x211 - x213
    x215 = f_r_x*x136
    x216 = 0.5*q_r_y**2.0
    x217 = 0.5*f_r_y**2.0
    x218 = x211 - x217
    x219 = f_r_x*x132
    x220 = (1/6)*q_r_x**3.0
    x221 = f_r_x*x211
    x222 = -1/6*f_r_x**3.0 + x221
    x223 = f_disc_r_z**3.0
    x224 = (1/6)*x223
    x225 = -0.5*f_disc_r_z*x212 + x224
    x226 = f_r_y*x209
    x227 = f_r_y*x211
    x228 = -f_r_y*x213 + x227
    x229 = -f_r_x*x217 + x221
    x230 = f_disc_r_z*x217
    x231 = (1/6)*q_r_y**3.0
    x232 = -1/6*f_r_y**3.0 + x227
    x233 = x224 - x230
    x234 = bar_i_vibration_rectification*rate_rate_i_sensed
    x235 = np.sin(roll)
    x236 = -bar_M_zz*x235
    x237 = np.sin(pitch)
    x238 = -bar_M_zz*x237
    x239 = -cos_yaw**2.0 + sin_yaw**2.0 + 1
    x240 = -x239
    x241 = 2.0*cos_yaw*sin_yaw
    x242 = cos_yaw - 1
    x243 = -Gamma_zz
    x244 = 2.0*Gamma_yz
    x245 = 2.0*Gamma_xz
    x246 = temperature - 293.15
    x247 = vibration_rms**2.0
    x248 = K4*vibration_axis_ix
    x249 = vibration_axis_px*x248
    x250 = K6*vibration_axis_ix
    x251 = vibration_axis_ox*x250
    x252 = K8*vibration_axis_ox
    x253 = vibration_axis_px*x252
    x254 = K2*vibration_axis_ix**2.0
    x255 = K5*vibration_axis_ox**2.0
    x256 = K7*vibration_axis_px**2.0
    x257 = vibration_axis_py*x248
    x258 = K4*vibration_axis_px
    x259 = vibration_axis_iy*x258
    x260 = vibration_axis_oy*x250
    x261 = K6*vibration_axis_ox
    x262 = vibration_axis_iy*x261
    x263 = vibration_axis_py*x252
    x264 = K8*vibration_axis_px
    x265 = vibration_axis_oy*x264
    x266 = vibration_axis_ix*x101
    x267 = vibration_axis_iy*x266
    x268 = vibration_axis_ox*x102
    x269 = vibration_axis_oy*x268
    x270 = vibration_axis_px*x103
    x271 = vibration_axis_py*x270
    x272 = vibration_axis_pz*x248
    x273 = vibration_axis_iz*x258
    x274 = vibration_axis_oz*x250
    x275 = vibration_axis_iz*x261
    x276 = vibration_axis_pz*x252
    x277 = vibration_axis_oz*x264
    x278 = vibration_axis_iz*x266
    x279 = vibration_axis_oz*x268
    x280 = vibration_axis_pz*x270
    x281 = K4*vibration_axis_iy
    x282 = vibration_axis_py*x281
    x283 = K6*vibration_axis_iy
    x284 = vibration_axis_oy*x283
    x285 = K8*vibration_axis_oy
    x286 = vibration_axis_py*x285
    x287 = K2*vibration_axis_iy**2.0
    x288 = K5*vibration_axis_oy**2.0
    x289 = K7*vibration_axis_py**2.0
    x290 = vibration_axis_pz*x281
    x291 = K4*vibration_axis_iz
    x292 = vibration_axis_py*x291
    x293 = vibration_axis_oz*x283
    x294 = K6*vibration_axis_iz
    x295 = vibration_axis_oy*x294
    x296 = vibration_axis_pz*x285
    x297 = K8*vibration_axis_oz
    x298 = vibration_axis_py*x297
    x299 = vibration_axis_iy*vibration_axis_iz*x101
    x300 = vibration_axis_oy*vibration_axis_oz*x102
    x301 = vibration_axis_py*vibration_axis_pz*x103
    x302 = vibration_axis_pz*x291
    x303 = vibration_axis_oz*x294
    x304 = vibration_axis_pz*x297
    x305 = K2*vibration_axis_iz**2.0
    x306 = K5*vibration_axis_oz**2.0
    x307 = K7*vibration_axis_pz**2.0

    D = np.empty((len(ROWS), len(time)))
    D[0] = bar_i_vibration_rectification*np.sign(i_sensed)  # adc-nonlinearity.h
    D[1] = -x157 - x158  # angular-jitter.W_xx
    D[2] = -bar_spin_axis_tilt_Gamma_xy*x156  # angular-jitter.W_xy
    D[3] = -bar_spin_axis_tilt_Gamma_xz*x156  # angular-jitter.W_xz
    D[4] = -x158 - x159  # angular-jitter.W_yy
    D[5] = -bar_spin_axis_tilt_Gamma_yz*x156  # angular-jitter.W_yz
    D[6] = -x157 - x159  # angular-jitter.W_zz
    D[7] = bar_i_vibration_rectification*(f_tau_xx*omega_x + f_tau_xy*omega_y)*(f_tau_zx*omega_x + f_tau_zy*omega_y - x1)  # anisoinertia.K_ip
    D[8] = bar_dR_arm_stretch  # arm-length.delta_R
    D[9] = b_f_zj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_zj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_zj  # arm-sag.c_z
    D[10] = b_f_yj*bar_dR_arm_stretch + bar_rate_dR_arm_stretch*rate_b_f_yj + bar_rate_rate_dR_arm_stretch*rate_rate_b_f_yj  # arm-stretch.c_r
    D[11] = bar_rate_rate_run_out_x*rate_rate_cos_phi_true + bar_rate_run_out_x*rate_cos_phi_true + x160  # bearing-run-out.c_x1
    D[12] = bar_rate_rate_run_out_x*rate_rate_sin_phi_true + bar_rate_run_out_x*rate_sin_phi_true + bar_run_out_x*sin_phi  # bearing-run-out.s_x1
    D[13] = bar_rate_rate_run_out_y*rate_rate_cos_phi_true + bar_rate_run_out_y*rate_cos_phi_true + x161  # bearing-run-out.c_y1
    D[14] = bar_rate_rate_run_out_y*rate_rate_sin_phi_true + bar_rate_run_out_y*rate_sin_phi_true + bar_run_out_y*sin_phi  # bearing-run-out.s_y1
    D[15] = bar_rate_rate_run_out_z*rate_rate_cos_phi_true + bar_rate_run_out_z*rate_cos_phi_true + x162  # bearing-run-out.c_z1
    D[16] = bar_rate_rate_run_out_z*rate_rate_sin_phi_true + bar_rate_run_out_z*rate_sin_phi_true + bar_run_out_z*sin_phi  # bearing-run-out.s_z1
    D[17] = bar_rate_rate_run_out_x*x169 + bar_rate_run_out_x*x165 + bar_run_out_x*x168  # bearing-run-out.c_x2
    D[18] = bar_rate_rate_run_out_x*x171 + bar_rate_run_out_x*x170 + x160*x164  # bearing-run-out.s_x2
    D[19] = bar_rate_rate_run_out_y*x169 + bar_rate_run_out_y*x165 + bar_run_out_y*x168  # bearing-run-out.c_y2
    D[20] = bar_rate_rate_run_out_y*x171 + bar_rate_run_out_y*x170 + x161*x164  # bearing-run-out.s_y2
    D[21] = bar_rate_rate_run_out_z*x169 + bar_rate_run_out_z*x165 + bar_run_out_z*x168  # bearing-run-out.c_z2
    D[22] = bar_rate_rate_run_out_z*x171 + bar_rate_run_out_z*x170 + x162*x164  # bearing-run-out.s_z2
    D[23] = bar_i_vibration_rectification*time  # bias-drift.dK0_dt
    D[24] = bar_i_vibration_rectification  # bias-step.dK0
    D[25] = time*x172 + time*x173 + time*x174 + time*x175 + time*x176 + time*x177 + time*x178 + time*x179 + time*x180  # clock-drift.epsilon
    D[26] = f_f_o*x181  # cubic-cross.K_iio
    D[27] = f_f_p*x181  # cubic-cross.K_iip
    D[28] = x182*x183  # cubic-cross.K_ioo
    D[29] = f_f_o*f_f_p*x183  # cubic-cross.K_iop
    D[30] = x183*x184  # cubic-cross.K_ipp
    D[31] = bar_i_vibration_rectification*f_f_o**3.0  # cubic-cross.K_ooo
    D[32] = bar_i_vibration_rectification*f_f_p*x182  # cubic-cross.K_oop
    D[33] = bar_i_vibration_rectification*f_f_o*x184  # cubic-cross.K_opp
    D[34] = bar_i_vibration_rectification*f_f_p**3.0  # cubic-cross.K_ppp
    D[35] = bar_i_vibration_rectification*f_f_i**3.0  # cubic-input.K_iii
    D[36] = bar_spin_acceleration_true*x34 + x185 - x186  # encoder-harmonic.c_1
    D[37] = bar_sin_delta_phi*sin_phi + bar_spin_acceleration_true*x37 + bar_spin_rate_true*x30  # encoder-harmonic.s_1
    D[38] = bar_sin_delta_phi*x168 + bar_spin_acceleration_true*(-4.0*x166*x32 + 4.0*x167*x32 - x187*x31) - x186*x187  # encoder-harmonic.c_2
    D[39] = bar_spin_acceleration_true*(2.0*d2_spin_angle*x166 - 8.0*sin_phi*x33 - x167*x56) + bar_spin_rate_true*(x166*x41 - x167*x41) + x164*x185  # encoder-harmonic.s_2
    D[40] = bar_sin_delta_phi*(-3.0*cos_phi*x167 + x188) + bar_spin_acceleration_true*(27.0*cos_phi*x167*x32 + 3.0*d2_spin_angle*x189 - x188*x191 - x190*x31) + bar_spin_rate_true*(3.0*d_spin_angle*x189 - x190*x28)  # encoder-harmonic.c_3
    D[41] = bar_sin_delta_phi*(3.0*sin_phi*x166 - x189) + bar_spin_acceleration_true*(d2_spin_angle*x192 - 27.0*x166*x36 + x189*x191 - x193*x35) + bar_spin_rate_true*(d_spin_angle*x192 - x193*x30)  # encoder-harmonic.s_3
    D[42] = bar_sin_delta_phi*(x194 + x195 - 6.0*x196) + bar_spin_acceleration_true*(16.0*cos_phi*d2_spin_angle*x189 + 96.0*x166*x167*x32 - x194*x198 - x195*x198 - x197*x31) + bar_spin_rate_true*(16.0*cos_phi*d_spin_angle*x189 - x197*x28)  # encoder-harmonic.c_4
    D[43] = bar_sin_delta_phi*(4.0*sin_phi*x188 - x187*x189) + bar_spin_acceleration_true*(-d2_spin_angle*x200 - 64.0*x188*x36 + 64.0*x189*x33 + x194*x201 + x195*x201) + bar_spin_rate_true*(-d_spin_angle*x200 + x194*x199 + x195*x199)  # encoder-harmonic.s_4
    D[44] = -bar_M_xx*fuel_mass - x202  # fuel-gradient.G_xx
    D[45] = bar_spin_axis_tilt_Gamma_xy*fuel_mass  # fuel-gradient.G_xy
    D[46] = bar_spin_axis_tilt_Gamma_xz*fuel_mass  # fuel-gradient.G_xz
    D[47] = -bar_M_yy*fuel_mass - x202  # fuel-gradient.G_yy
    D[48] = bar_spin_axis_tilt_Gamma_yz*fuel_mass  # fuel-gradient.G_yz
    D[49] = time*x203  # gain-drift.dK1_dt
    D[50] = x203  # gain-step.dK1
    D[51] = -bar_M_xx - x204  # gradient-offset.G_xx
    D[52] = bar_spin_axis_tilt_Gamma_xy  # gradient-offset.G_xy
    D[53] = bar_spin_axis_tilt_Gamma_xz  # gradient-offset.G_xz
    D[54] = -bar_M_yy - x204  # gradient-offset.G_yy
    D[55] = bar_spin_axis_tilt_Gamma_yz  # gradient-offset.G_yz
    D[56] = -bar_time_offset_omega_x  # gyro-bias.b_x
    D[57] = -bar_time_offset_omega_y  # gyro-bias.b_y
    D[58] = -bar_time_offset_omega_z  # gyro-bias.b_z
    D[59] = x205  # gyro-delay.delta_w
    D[60] = x206  # gyro-delay.delta_d
    D[61] = -a_x*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_x  # gyro-g-sensitivity.d_xx
    D[62] = -a_y*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_y  # gyro-g-sensitivity.d_xy
    D[63] = -a_z*bar_time_offset_omega_x - bar_time_offset_omegadot_x*d_a_z  # gyro-g-sensitivity.d_xz
    D[64] = -a_x*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_x  # gyro-g-sensitivity.d_yx
    D[65] = -a_y*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_y  # gyro-g-sensitivity.d_yy
    D[66] = -a_z*bar_time_offset_omega_y - bar_time_offset_omegadot_y*d_a_z  # gyro-g-sensitivity.d_yz
    D[67] = -a_x*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_x  # gyro-g-sensitivity.d_zx
    D[68] = -a_y*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_y  # gyro-g-sensitivity.d_zy
    D[69] = -a_z*bar_time_offset_omega_z - bar_time_offset_omegadot_z*d_a_z  # gyro-g-sensitivity.d_zz
    D[70] = -bar_time_offset_omega_x*omega_x - bar_time_offset_omegadot_x*omegadot_x  # gyro-scale.s_x
    D[71] = -bar_time_offset_omega_y*omega_y - bar_time_offset_omegadot_y*omegadot_y  # gyro-scale.s_y
    D[72] = -bar_time_offset_omega_z*omega_z - bar_time_offset_omegadot_z*omegadot_z  # gyro-scale.s_z
    D[73] = -bar_time_offset_a_x  # imu-acceleration-bias.b_x
    D[74] = -bar_time_offset_a_y  # imu-acceleration-bias.b_y
    D[75] = -bar_time_offset_a_z  # imu-acceleration-bias.b_z
    D[76] = -x155  # imu-acceleration-misalignment.m_xy
    D[77] = x207  # imu-acceleration-misalignment.m_xz
    D[78] = -x151  # imu-acceleration-misalignment.m_yx
    D[79] = -x149  # imu-acceleration-misalignment.m_yz
    D[80] = -x147  # imu-acceleration-misalignment.m_zx
    D[81] = x208  # imu-acceleration-misalignment.m_zy
    D[82] = -a_x*bar_time_offset_a_x  # imu-acceleration-scale.s_x
    D[83] = -a_y*bar_time_offset_a_y  # imu-acceleration-scale.s_y
    D[84] = -a_z*bar_time_offset_a_z  # imu-acceleration-scale.s_z
    D[85] = bar_time_offset_a_x*x126 - bar_time_offset_a_y*x10 + bar_time_offset_a_z*(-x114 - x7)  # imu-lever-arm.l_x
    D[86] = bar_time_offset_a_x*(omegadot_z - x5) + bar_time_offset_a_y*x123 - bar_time_offset_a_z*x119  # imu-lever-arm.l_y
    D[87] = -bar_time_offset_a_x*x115 + bar_time_offset_a_y*(-x117 - x16) + bar_time_offset_a_z*x17  # imu-lever-arm.l_z
    D[88] = -bar_imu_turn_yz + bar_imu_turn_zy  # imu-misalignment.e_x
    D[89] = bar_imu_turn_xz - bar_imu_turn_zx  # imu-misalignment.e_y
    D[90] = -bar_imu_turn_xy + bar_imu_turn_yx  # imu-misalignment.e_z
    D[91] = -bar_i_vibration_rectification*rate_f_f_i  # lag.tau
    D[92] = bar_i_vibration_rectification*(B_x*x107 + B_y*x108 + B_z*x109)  # magnetic-bias.dK0_dB
    D[93] = b_f_xj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yx
    D[94] = b_f_yj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yy
    D[95] = b_f_zj*bar_vartheta_y_mount_compliance  # mount-compliance.c_yz
    D[96] = b_f_xj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zx
    D[97] = b_f_yj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zy
    D[98] = b_f_zj*bar_vartheta_z_mount_compliance  # mount-compliance.c_zz
    D[99] = bar_f_f_x*x214 - bar_q_f_x*x210 + x209  # near-mass.T_xxx
    D[100] = bar_f_f_y*x214 + bar_f_f_z*f_disc_r_z*f_r_y - bar_q_f_y*x210 - f_r_x*x137 - q_r_x*x138  # near-mass.T_xxy
    D[101] = bar_f_f_z*x214 + bar_q_p_second_order_misalignment*x210 - x215  # near-mass.T_xxz
    D[102] = bar_f_f_x*x218 + bar_f_f_z*f_disc_r_z*f_r_x - bar_q_f_x*x216 - f_r_x*x133 - q_r_x*x134  # near-mass.T_xyy
    D[103] = bar_q_p_second_order_misalignment*q_r_x*q_r_y - f_r_x*x129 - f_r_y*x136 - x219  # near-mass.T_xyz
    D[104] = bar_f_f_y*x218 - bar_q_f_y*x216 + f_r_y*x128  # near-mass.T_yyy
    D[105] = bar_f_f_z*x218 + bar_q_p_second_order_misalignment*x216 - f_r_y*x132  # near-mass.T_yyz
    D[106] = bar_f_f_x*x222 - bar_f_f_z*x225 - bar_q_f_x*x220  # near-mass.T_xxxx
    D[107] = bar_f_f_x*x228 + bar_f_f_y*x222 - bar_q_f_y*x220 - x138*x210 + x226  # near-mass.T_xxxy
    D[108] = bar_f_f_x*x225 + bar_f_f_z*x222 + bar_q_p_second_order_misalignment*x220  # near-mass.T_xxxz
    D[109] = bar_f_f_x*x229 + bar_f_f_y*x228 + bar_f_f_z*(f_disc_r_z*x213 - 1/3*x223 + x230) - x134*x210 - x139*x216  # near-mass.T_xxyy
    D[110] = bar_f_f_y*x225 + bar_f_f_z*x228 - f_r_y*x215 + x130*x210  # near-mass.T_xxyz
    D[111] = bar_f_f_x*x232 + bar_f_f_y*x229 - bar_q_f_x*x231 - x135*x216 + x226  # near-mass.T_xyyy
    D[112] = bar_f_f_x*x233 + bar_f_f_z*x229 - f_r_y*x219 + x131*x216  # near-mass.T_xyyz
    D[113] = bar_f_f_y*x232 - bar_f_f_z*x233 - bar_q_f_y*x231  # near-mass.T_yyyy
    D[114] = bar_f_f_y*x233 + bar_f_f_z*x232 + bar_q_p_second_order_misalignment*x231  # near-mass.T_yyyz
    D[115] = x183*np.abs(f_f_i)  # odd-quadratic.K_oq
    D[116] = x234  # output-filter.b
    D[117] = bar_i_vibration_rectification*i_sensed  # output-gain-step.g
    D[118] = bar_i_vibration_rectification*(-beta_x*x4 + f_tau_yx*x14 - f_tau_yy*x9)  # pendulum-angular.K_pa
    D[119] = bar_i_vibration_rectification*(pressure - 101325)  # pressure-bias.dK0_dp
    D[120] = x234  # second-order-loop.b
    D[121] = bar_q_i_second_order_misalignment*(f_f_i - q_f_xj) + bar_q_o_second_order_misalignment*(f_f_o - q_f_yj) + bar_q_p_second_order_misalignment*(f_f_p + q_f_z)  # second-order-misalignment.kappa
    D[122] = -bar_M_xx*x235 - x236  # self-gradient.G_xx_roll
    D[123] = bar_spin_axis_tilt_Gamma_xy*x235  # self-gradient.G_xy_roll
    D[124] = bar_spin_axis_tilt_Gamma_xz*x235  # self-gradient.G_xz_roll
    D[125] = -bar_M_yy*x235 - x236  # self-gradient.G_yy_roll
    D[126] = bar_spin_axis_tilt_Gamma_yz*x235  # self-gradient.G_yz_roll
    D[127] = -bar_M_xx*x237 - x238  # self-gradient.G_xx_pitch
    D[128] = bar_spin_axis_tilt_Gamma_xy*x237  # self-gradient.G_xy_pitch
    D[129] = bar_spin_axis_tilt_Gamma_xz*x237  # self-gradient.G_xz_pitch
    D[130] = -bar_M_yy*x237 - x238  # self-gradient.G_yy_pitch
    D[131] = bar_spin_axis_tilt_Gamma_yz*x237  # self-gradient.G_yz_pitch
    D[132] = -bar_M_xx*x240 - bar_M_yy*x239 + 2.0*bar_spin_axis_tilt_Gamma_xy*cos_yaw*sin_yaw  # self-gradient-yaw.G_d
    D[133] = bar_M_xx*x241 - bar_M_yy*x241 + bar_spin_axis_tilt_Gamma_xy*x240  # self-gradient-yaw.G_xy
    D[134] = bar_spin_axis_tilt_Gamma_xz*x242 + bar_spin_axis_tilt_Gamma_yz*sin_yaw  # self-gradient-yaw.G_xz
    D[135] = -bar_spin_axis_tilt_Gamma_xz*sin_yaw + bar_spin_axis_tilt_Gamma_yz*x242  # self-gradient-yaw.G_yz
    D[136] = -Gamma_xy*bar_spin_axis_tilt_Gamma_xz + Gamma_xz*bar_spin_axis_tilt_Gamma_xy - bar_M_yy*x244 + bar_M_zz*x244 + bar_spin_axis_tilt_Gamma_yz*(-Gamma_yy - x243) - x145 - x146 + x150 + x208  # spin-axis-tilt.alpha_x
    D[137] = Gamma_xy*bar_spin_axis_tilt_Gamma_yz - Gamma_yz*bar_spin_axis_tilt_Gamma_xy + bar_M_xx*x245 - bar_M_zz*x245 + bar_spin_axis_tilt_Gamma_xz*(Gamma_xx + x243) + x148 - x153 - x154 + x207  # spin-axis-tilt.alpha_y
    D[138] = bar_wobble_xz*sin_phi - bar_wobble_yz*cos_phi - bar_wobble_zx*sin_phi + bar_wobble_zy*cos_phi  # spin-axis-wobble.w_x
    D[139] = bar_wobble_xz*cos_phi + bar_wobble_yz*sin_phi - bar_wobble_zx*cos_phi - bar_wobble_zy*sin_phi  # spin-axis-wobble.w_y
    D[140] = bar_sin_delta_phi  # spin-phase-offset.phi_0
    D[141] = bar_sin_delta_phi  # spin-rate-jitter.sigma_phi
    D[142] = bar_sin_delta_phi  # spin-rate-jitter.sigma_walk
    D[143] = bar_sin_delta_phi*d_spin_angle*time + bar_spin_acceleration_true*x56 + bar_spin_rate_true*(d2_spin_angle*time + d_spin_angle)  # spin-rate-offset.epsilon
    D[144] = -bar_sin_delta_phi*omegadot_z - bar_spin_acceleration_true*d2_omegadot_z - bar_spin_rate_true*d_omegadot_z  # spin-servo.c
    D[145] = bar_i_vibration_rectification*x246  # thermal-bias.dK0_dT
    D[146] = bar_i_vibration_rectification*d_temperature  # thermal-lag.dK0_dTdot
    D[147] = d_temperature*x203  # thermal-lag.dK1_dTdot
    D[148] = x203*x246  # thermal-scale.dK1_dT
    D[149] = x172 + x173 + x174 + x205 + x206  # time-offset.delta_t
    D[150] = bar_i_vibration_rectification*(x247*x249 + x247*x251 + x247*x253 + x247*x254 + x247*x255 + x247*x256)  # vibration-level.L_xx
    D[151] = bar_i_vibration_rectification*(x247*x257 + x247*x259 + x247*x260 + x247*x262 + x247*x263 + x247*x265 + x247*x267 + x247*x269 + x247*x271)  # vibration-level.L_xy
    D[152] = bar_i_vibration_rectification*(x247*x272 + x247*x273 + x247*x274 + x247*x275 + x247*x276 + x247*x277 + x247*x278 + x247*x279 + x247*x280)  # vibration-level.L_xz
    D[153] = bar_i_vibration_rectification*(x247*x282 + x247*x284 + x247*x286 + x247*x287 + x247*x288 + x247*x289)  # vibration-level.L_yy
    D[154] = bar_i_vibration_rectification*(x247*x290 + x247*x292 + x247*x293 + x247*x295 + x247*x296 + x247*x298 + x247*x299 + x247*x300 + x247*x301)  # vibration-level.L_yz
    D[155] = bar_i_vibration_rectification*(x247*x302 + x247*x303 + x247*x304 + x247*x305 + x247*x306 + x247*x307)  # vibration-level.L_zz
    D[156] = bar_i_vibration_rectification*(x249 + x251 + x253 + x254 + x255 + x256)  # vibration-rectification.P_xx
    D[157] = bar_i_vibration_rectification*(x257 + x259 + x260 + x262 + x263 + x265 + x267 + x269 + x271)  # vibration-rectification.P_xy
    D[158] = bar_i_vibration_rectification*(x272 + x273 + x274 + x275 + x276 + x277 + x278 + x279 + x280)  # vibration-rectification.P_xz
    D[159] = bar_i_vibration_rectification*(x282 + x284 + x286 + x287 + x288 + x289)  # vibration-rectification.P_yy
    D[160] = bar_i_vibration_rectification*(x290 + x292 + x293 + x295 + x296 + x298 + x299 + x300 + x301)  # vibration-rectification.P_yz
    D[161] = bar_i_vibration_rectification*(x302 + x303 + x304 + x305 + x306 + x307)  # vibration-rectification.P_zz
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
