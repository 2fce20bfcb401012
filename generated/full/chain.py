"""The instrument as a chain of stages (paper, Eq. 1-15).

Derived; do not edit: change the derivation and derive again.

Effects beyond the paper's instrument: none.
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
    "d2_spin_angle",
    "d_spin_angle",
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
    ("dR", False),
    ("beta_x", False),
    ("beta_z", False),
    ("vartheta_x", False),
    ("vartheta_y", False),
    ("vartheta_z", False),
    ("K0", False),
    ("K1", False),
    ("K2", False),
    ("K4", False),
    ("K5", False),
    ("K6", False),
    ("K7", False),
    ("K8", False),
    ("k_VI", False),
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
    d2_spin_angle = inputs[15]
    d_spin_angle = inputs[16]
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
    d2_spin_angle = inputs[15]
    d_spin_angle = inputs[16]
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
    x11 = K6*q_f_xj
    x12 = q_f_xj**2.0
    x13 = q_f_yj**2.0
    x14 = q_f_z**2.0
    x15 = K4*q_f_z
    x16 = K8*q_f_z
    i_sensed = K0 + K2*x12 + K5*x13 + K7*x14 + f_f_i - q_f_xj*x15 + q_f_yj*x11 - q_f_yj*x16
    bar_i_sensed = K1*k_VI
    bar_q_f_yj = bar_i_sensed*(2.0*K5*q_f_yj + x11 - x16)
    bar_q_f_xj = bar_i_sensed*(2.0*K2*q_f_xj + K6*q_f_yj - x15)
    bar_q_f_z = bar_i_sensed*(-K4*q_f_xj + 2.0*K7*q_f_z - K8*q_f_yj)
    bar_q_f_y = bar_q_f_xj*cos_psi + bar_q_f_yj*sin_psi
    bar_q_f_x = -bar_q_f_xj*sin_psi + bar_q_f_yj*cos_psi
    bar_q_r_y = M_xy*bar_q_f_x + M_yy*bar_q_f_y + M_zy*bar_q_f_z
    bar_q_r_x = M_xx*bar_q_f_x + M_yx*bar_q_f_y + M_zx*bar_q_f_z
    bar_q_disc_r_x = bar_q_r_x*cos_psi + bar_q_r_y*sin_psi
    bar_f_f_zj = -bar_i_sensed*vartheta_y
    bar_f_f_yj = bar_i_sensed*vartheta_z
    bar_f_f_z = -bar_f_f_yj*beta_x - bar_f_f_zj
    bar_f_f_y = bar_f_f_yj*f_tau_yy + bar_f_f_zj*f_tau_zy + bar_i_sensed*f_tau_xy
    bar_f_f_x = bar_f_f_yj*f_tau_yx + bar_f_f_zj*f_tau_zx + bar_i_sensed*f_tau_xx
    bar_f_tau_zy = bar_f_f_zj*f_f_y
    bar_f_tau_zx = bar_f_f_zj*f_f_x
    bar_f_tau_yy = bar_f_f_yj*f_f_y
    bar_f_tau_yx = bar_f_f_yj*f_f_x
    bar_f_tau_xy = bar_i_sensed*f_f_y
    bar_f_tau_xx = bar_i_sensed*f_f_x
    bar_f_r_y = M_xy*bar_f_f_x + M_yy*bar_f_f_y + M_zy*bar_f_f_z
    bar_f_r_x = M_xx*bar_f_f_x + M_yx*bar_f_f_y + M_zx*bar_f_f_z
    bar_f_disc_tau_zy = -bar_f_tau_zx*sin_psi + bar_f_tau_zy*cos_psi
    bar_f_disc_r_z = M_xz*bar_f_f_x + M_yz*bar_f_f_y + M_zz*bar_f_f_z
    bar_f_disc_r_y = -bar_f_r_x*sin_psi + bar_f_r_y*cos_psi
    bar_f_disc_r_x = bar_f_r_x*cos_psi + bar_f_r_y*sin_psi
    x17 = bar_i_sensed*q_f_xj

    D = np.empty((len(ROWS), len(time)))
    D[0] = bar_f_disc_r_x + bar_f_disc_r_y*beta_z + bar_f_disc_r_z*beta_x + bar_q_disc_r_x  # dR
    D[1] = bar_f_disc_r_z*x8 - bar_f_disc_tau_zy*beta_z - bar_f_f_yj*f_f_z - bar_f_tau_zx*cos_psi - bar_f_tau_zy*sin_psi  # beta_x
    D[2] = bar_f_disc_r_y*x8 - bar_f_disc_tau_zy*beta_x - bar_f_tau_xx*cos_psi - bar_f_tau_xy*sin_psi - bar_f_tau_yx*sin_psi + bar_f_tau_yy*cos_psi  # beta_z
    D[3] = 0  # vartheta_x
    D[4] = -bar_i_sensed*f_f_zj  # vartheta_y
    D[5] = bar_i_sensed*f_f_yj  # vartheta_z
    D[6] = bar_i_sensed  # K0
    D[7] = i_sensed*k_VI  # K1
    D[8] = bar_i_sensed*x12  # K2
    D[9] = -q_f_z*x17  # K4
    D[10] = bar_i_sensed*x13  # K5
    D[11] = q_f_yj*x17  # K6
    D[12] = bar_i_sensed*x14  # K7
    D[13] = -bar_i_sensed*q_f_yj*q_f_z  # K8
    D[14] = K1*i_sensed  # k_VI
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
