"""The analytical model of the RAGG, folded for evaluation (paper, Eq. 1-15, with the rate of the disc in Eq. 9).

Derived; do not edit: change the derivation and run `make derive`.

Seen from the turning disc G_out is one polynomial in twelve motion numbers; all that the instrument's
parameters contribute is folded into its coefficients beforehand. Evaluated in blocks that stay in cache.
Units are SI, G_out in volts. `inputs` is a (n_inputs, N) array in the order of INPUTS; `p` a vector in
the order of PARAMETERS (one value, or four in the order A1, A2, A3, A4).
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
SIZE: int = sum(size for _, size in PARAMETERS)
BLOCK: int = 4096


def fold(p: Array) -> list[float]:
    """The coefficients of the polynomial: all that the instrument's parameters contribute."""
    wide = np.asarray(p, dtype=np.longdouble)  # what is folded once may be folded carefully
    radius = wide[0]
    dR, beta_x, beta_z, vartheta_x, vartheta_y, vartheta_z, K0, K1, K2, K4, K5, K6, K7, K8, k_VI = wide[2:].reshape(-1, 4)
    R, k1 = radius + dR, k_VI * K1
    e = [
        R*k1,
        k1,
        K2*R**2.0*k1,
        -K4*R**2.0*k1,
        K5*R**2.0*k1,
        K6*R**2.0*k1,
        K7*R**2.0*k1,
        -K8*R**2.0*k1,
        (R*beta_x*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1),
        (R*beta_x*k1)*(beta_x*vartheta_y - beta_z + vartheta_z),
        (R*beta_x*k1)*(-beta_x*vartheta_z + vartheta_y),
        (R*beta_z*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1),
        (R*beta_z*k1)*(beta_x*vartheta_y - beta_z + vartheta_z),
        (R*beta_z*k1)*(beta_x*vartheta_y + vartheta_z),
        (R*beta_z*k1)*(-beta_x*vartheta_z + vartheta_y),
        (R*k1)*(beta_x*vartheta_y - beta_z + vartheta_z),
        (R*k1)*(-beta_x*vartheta_z + vartheta_y),
        2.0*K2*R*k1,
        -K4*R*k1,
        2.0*K5*R*k1,
        K6*R*k1,
        2.0*K7*R*k1,
        -K8*R*k1,
        (beta_z*k1)*(beta_x*vartheta_y + vartheta_z),
        k1*(beta_x*vartheta_y - beta_z + vartheta_z),
        k1*(-beta_x*vartheta_z + vartheta_y),
        K0*k1,
        K2*k1,
        -K4*k1,
        K5*k1,
        K6*k1,
        K7*k1,
        -K8*k1,
    ]
    return [
        float(e[26][0] + e[26][1] - e[26][2] - e[26][3]),
        float(e[1][2] - e[1][3] + e[24][0] - e[24][1] + e[23][2] - e[23][3]),
        float(e[1][0] - e[1][1] + e[23][0] - e[23][1] - e[24][2] + e[24][3]),
        float(e[25][0] + e[25][1] - e[25][2] - e[25][3]),
        float(e[15][0] + e[15][1] - e[11][2] - e[11][3]),
        float(e[0][2] + e[0][3] + e[12][0] + e[12][1] + e[13][2] + e[13][3]),
        float(e[9][0] - e[9][1] + e[8][2] - e[8][3]),
        float(e[0][0] + e[0][1] + e[13][0] + e[13][1] + e[12][2] + e[12][3]),
        float(e[11][0] + e[11][1] - e[15][2] - e[15][3]),
        float(e[8][0] - e[8][1] - e[9][2] + e[9][3]),
        float(e[16][0] - e[16][1] + e[14][2] - e[14][3]),
        float(e[14][0] - e[14][1] - e[16][2] + e[16][3]),
        float(e[10][0] + e[10][1] - e[10][2] - e[10][3]),
        float(e[29][0] + e[29][1] - e[27][2] - e[27][3]),
        float(e[30][0] + e[30][1] + e[30][2] + e[30][3]),
        float(e[32][0] - e[32][1] + e[28][2] - e[28][3]),
        float(e[19][0] - e[19][1]),
        float(-e[17][2] + e[17][3]),
        float(e[20][0] - e[20][1]),
        float(e[20][2] - e[20][3]),
        float(e[22][0] + e[22][1]),
        float(e[18][2] + e[18][3]),
        float(e[27][0] + e[27][1] - e[29][2] - e[29][3]),
        float(e[28][0] - e[28][1] - e[32][2] + e[32][3]),
        float(e[20][0] - e[20][1]),
        float(e[20][2] - e[20][3]),
        float(e[17][0] - e[17][1]),
        float(-e[19][2] + e[19][3]),
        float(e[18][0] + e[18][1]),
        float(-e[22][2] - e[22][3]),
        float(e[31][0] + e[31][1] - e[31][2] - e[31][3]),
        float(e[22][0] + e[22][1]),
        float(e[18][2] + e[18][3]),
        float(e[18][0] + e[18][1]),
        float(-e[22][2] - e[22][3]),
        float(e[21][0] - e[21][1]),
        float(-e[21][2] + e[21][3]),
        float(e[4][0] + e[4][1]),
        float(e[5][0] + e[5][1]),
        float(e[7][0] - e[7][1]),
        float(-e[2][2] - e[2][3]),
        float(e[5][2] + e[5][3]),
        float(e[3][2] - e[3][3]),
        float(e[2][0] + e[2][1]),
        float(e[3][0] - e[3][1]),
        float(-e[4][2] - e[4][3]),
        float(-e[7][2] + e[7][3]),
        float(e[6][0] + e[6][1]),
        float(-e[6][2] - e[6][3]),
    ]


def disc_angle(t: Array, spin_frequency: float) -> Array:
    """2 pi frac(spin_frequency t), rad, with the rounding error of the product kept (Dekker)."""
    turns = spin_frequency * t
    split = 134217729.0
    f_high = (f := split * spin_frequency) - (f - spin_frequency)
    t_high = (s := split * t) - (s - t)
    f_low, t_low = spin_frequency - f_high, t - t_high
    error = ((f_high * t_high - turns) + f_high * t_low + f_low * t_high) + f_low * t_low
    return np.asarray(2 * np.pi * ((turns - np.rint(turns)) + error))


def _block(cos_phi: Array, sin_phi: Array, inputs: Array, c: list[float]) -> Array:
    """G_out of a block of samples, (N,), V."""
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
    of_platform_xr = M_xx*cos_phi + M_xy*sin_phi
    of_platform_xt = -M_xx*sin_phi + M_xy*cos_phi
    of_platform_yr = M_yx*cos_phi + M_yy*sin_phi
    of_platform_yt = -M_yx*sin_phi + M_yy*cos_phi
    of_platform_zr = M_zx*cos_phi + M_zy*sin_phi
    of_platform_zt = -M_zx*sin_phi + M_zy*cos_phi
    x3 = 2.0*d_spin_angle
    x4 = omega_z*x3
    x5 = d_spin_angle**2.0
    x6 = omega_x*x3
    x7 = omega_y*x3
    a_r = a_x*cos_phi + a_y*sin_phi
    a_t = -a_x*sin_phi + a_y*cos_phi
    M_rr = cos_phi*of_platform_xr + of_platform_yr*sin_phi - x4 - x5
    M_rt = cos_phi*of_platform_xt - d2_spin_angle + of_platform_yt*sin_phi
    M_rz = M_xz*cos_phi + M_yz*sin_phi
    M_tr = cos_phi*of_platform_yr + d2_spin_angle - of_platform_xr*sin_phi
    M_tt = cos_phi*of_platform_yt - of_platform_xt*sin_phi - x4 - x5
    M_tz = -M_xz*sin_phi + M_yz*cos_phi
    M_zr = cos_phi*x6 + of_platform_zr + sin_phi*x7
    M_zt = cos_phi*x7 + of_platform_zt - sin_phi*x6
    return np.asarray(M_rr*(M_rr*c[37] + M_tr*c[38] + M_zr*c[39] + c[4]) + M_rt*(M_rt*c[40] + M_tt*c[41] + M_zt*c[42] + c[5]) + M_rz*c[6] + M_tr*(M_tr*c[43] + M_zr*c[44] + c[7]) + M_tt*(M_tt*c[45] + M_zt*c[46] + c[8]) + M_tz*c[9] + M_zr*(M_zr*c[47] + c[10]) + M_zt*(M_zt*c[48] + c[11]) + M_zz*c[12] + a_r*(M_rr*c[16] + M_rt*c[17] + M_tr*c[18] + M_tt*c[19] + M_zr*c[20] + M_zt*c[21] + a_r*c[13] + a_t*c[14] + a_z*c[15] + c[1]) + a_t*(M_rr*c[24] + M_rt*c[25] + M_tr*c[26] + M_tt*c[27] + M_zr*c[28] + M_zt*c[29] + a_t*c[22] + a_z*c[23] + c[2]) + a_z*(M_rr*c[31] + M_rt*c[32] + M_tr*c[33] + M_tt*c[34] + M_zr*c[35] + M_zt*c[36] + a_z*c[30] + c[3]) + c[0])


def output(t: Array, inputs: Array, p: Array, angle: Array | None = None) -> Array:
    """G_out, (N,), V, at instants t, s (Eq. 15); `angle` is the disc angle, rad, by default 2 pi spin_frequency t."""
    c = fold(p)
    G = np.empty(inputs.shape[1])
    for start in range(0, len(G), BLOCK):
        part = slice(start, start + BLOCK)
        phi = disc_angle(t[part], float(p[1])) if angle is None else angle[part]
        G[part] = _block(np.cos(phi), np.sin(phi), inputs[:, part], c)
    return G
