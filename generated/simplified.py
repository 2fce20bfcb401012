"""The simplified analytical model of the RAGG (paper, Eq. 42-47).

Derived; do not edit: change the derivation and run `make derive`.

    G_out = A_0 + sum_n (A_nc cos n phi + A_ns sin n phi),   phi = 2 pi spin_frequency t

Units are SI: specific force m/s^2, angular rate rad/s, gradients s^-2, G_out V.
`inputs` is a (n_inputs, N) array in the order of INPUTS; `p` a vector in the order of PARAMETERS
(one value, or four in the order A1, A2, A3, A4). D12, D34, D1234 and Sigma are the paper's.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

INPUTS: tuple[str, ...] = (
    "a_x",  # m/s^2: specific force of the disc centre, x (f_cmm)
    "a_y",  # m/s^2: specific force of the disc centre, y (f_cmm)
    "a_z",  # m/s^2: specific force of the disc centre, z (f_cmm)
    "omega_x",  # rad/s: angular rate against inertial space, x
    "omega_y",  # rad/s: angular rate against inertial space, y
    "omega_z",  # rad/s: angular rate against inertial space, z
    "omegadot_x",  # rad/s^2: angular acceleration, x
    "omegadot_y",  # rad/s^2: angular acceleration, y
    "omegadot_z",  # rad/s^2: angular acceleration, z
    "Gamma_xx",  # s^-2: gravity gradient xx at the disc centre
    "Gamma_xy",  # s^-2: gravity gradient xy at the disc centre
    "Gamma_xz",  # s^-2: gravity gradient xz at the disc centre
    "Gamma_yy",  # s^-2: gravity gradient yy at the disc centre
    "Gamma_yz",  # s^-2: gravity gradient yz at the disc centre
    "Gamma_zz",  # s^-2: gravity gradient zz at the disc centre
)
PARAMETERS: tuple[tuple[str, int], ...] = (
    ("radius", 1),  # m: nominal distance of the accelerometers from the disc centre
    ("spin_frequency", 1),  # Hz: rotation frequency of the disc
    ("dR", 4),  # m: radial distance error
    ("beta_x", 4),  # rad: altitude angle of the mounting position
    ("beta_z", 4),  # rad: initial phase angle of the mounting position
    ("vartheta_x", 4),  # rad: misalignment about the tangential axis
    ("vartheta_y", 4),  # rad: misalignment about the radial axis
    ("vartheta_z", 4),  # rad: misalignment about the axial axis
    ("K0", 4),  # m/s^2: null bias
    ("K1", 4),  # A/(m/s^2): linear scale factor
    ("K2", 4),  # 1/(m/s^2): second-order coefficient of f_i^2
    ("K4", 4),  # 1/(m/s^2): second-order coefficient of f_i f_p
    ("K5", 4),  # 1/(m/s^2): second-order coefficient of f_o^2
    ("K6", 4),  # 1/(m/s^2): second-order coefficient of f_i f_o
    ("K7", 4),  # 1/(m/s^2): second-order coefficient of f_p^2
    ("K8", 4),  # 1/(m/s^2): second-order coefficient of f_o f_p
    ("k_VI", 4),  # V/A: current-to-voltage gain
)
AMPLITUDES: tuple[str, ...] = ("A_0", "A_1c", "A_1s", "A_2c", "A_2s", )
SIZE: int = sum(size for _, size in PARAMETERS)
SIGNS: tuple[int, ...] = (1, 1, -1, -1, )
QUARTER_TURNS: tuple[int, ...] = (0, 2, 1, 3, )
BLOCK = 4096


def disc_angle(t: Array, spin_frequency: float) -> Array:
    """Disc angle, rad, within half a turn of 0. The turns are dropped exactly, whatever the time.

    The rounding error of spin_frequency * t (Dekker's product) is kept, so that the angle is as
    good at t = 1e6 s as at t = 0.
    """
    turns = spin_frequency * t
    f_high = (f := 134217729.0 * spin_frequency) - (f - spin_frequency)
    t_high = (s := 134217729.0 * t) - (s - t)
    f_low, t_low = spin_frequency - f_high, t - t_high
    error = ((f_high * t_high - turns) + f_high * t_low + f_low * t_high) + f_low * t_low
    return np.asarray(2.0 * np.pi * ((turns - np.rint(turns)) + error))


def D12(x: Array) -> float:
    return float(x[0] - x[1])


def D34(x: Array) -> float:
    return float(x[2] - x[3])


def D1234(x: Array) -> float:
    return float((x[0] + x[1]) - (x[2] + x[3]))


def Sigma(x: Array) -> float:
    return float((x[0] + x[1]) + (x[2] + x[3]))


def motion_numbers(inputs: Array) -> tuple[Array, ...]:
    """(T_1, T_2, T_3, T_4, T_5, T_6, S_1, S_2), each (N,), s^-2 (Eq. 16)."""
    a_x, a_y, a_z, omega_x, omega_y, omega_z, omegadot_x, omegadot_y, omegadot_z, Gamma_xx, Gamma_xy, Gamma_xz, Gamma_yy, Gamma_yz, Gamma_zz = inputs
    T_1 = 0.5*Gamma_xx - 0.5*Gamma_yy - 0.5*omega_x**2.0 + 0.5*omega_y**2.0
    T_2 = -Gamma_xy + omega_x*omega_y
    T_3 = Gamma_yz - omega_y*omega_z - omegadot_x
    T_4 = Gamma_xz - omega_x*omega_z + omegadot_y
    T_5 = 0.5*Gamma_xx + 0.5*Gamma_yy + 0.5*omega_x**2.0 + 0.5*omega_y**2.0 + omega_z**2.0
    T_6 = omegadot_z
    S_1 = Gamma_xz - omega_x*omega_z - omegadot_y
    S_2 = Gamma_yz - omega_y*omega_z + omegadot_x
    return T_1, T_2, T_3, T_4, T_5, T_6, S_1, S_2


def amplitudes(inputs: Array, p: Array) -> Array:
    """The amplitudes of Eq. 17, (5, N), V, in the order of AMPLITUDES."""
    a_x, a_y, a_z = inputs[:3]
    T_1, T_2, T_3, T_4, T_5, T_6, S_1, S_2 = motion_numbers(inputs)
    radius = p[0]
    dR = p[2:6]
    beta_x = p[6:10]
    beta_z = p[10:14]
    vartheta_x = p[14:18]
    vartheta_y = p[18:22]
    vartheta_z = p[22:26]
    K0 = p[26:30]
    K1 = p[30:34]
    K2 = p[34:38]
    K4 = p[38:42]
    K5 = p[42:46]
    K6 = p[46:50]
    K7 = p[50:54]
    K8 = p[54:58]
    k_VI = p[58:62]
    R = radius + dR
    k1 = k_VI * K1
    A = np.empty((len(AMPLITUDES), inputs.shape[1]))
    A[0] = (  # A_0
        D1234(K0*k1)
        + D1234(k1*(-beta_x*vartheta_z + vartheta_y)) * a_z
        + D1234(-R*k1*vartheta_z) * T_5
        + D1234(R*k1) * T_6
        + D1234((0.5*k1)*(K2 + K5)) * a_x**2.0
        + D1234((0.5*k1)*(K2 + K5)) * a_y**2.0
        + D1234(K7*k1) * a_z**2.0
    )
    A[1] = (  # A_1c
        (D12(k1*(beta_x*vartheta_y - beta_z + vartheta_z)) + D34(k1) + D34(beta_z*k1*vartheta_z)) * a_x
        + (D12(k1) + D12(beta_z*k1*vartheta_z) + D34(k1*(-beta_x*vartheta_y + beta_z - vartheta_z))) * a_y
        + D34(R*k1*vartheta_y) * T_3
        + D12(-R*k1*vartheta_y) * T_4
        + D34(-R*beta_x*k1) * S_1
        + D12(-R*beta_x*k1) * S_2
        + (D12(-K8*k1) + D34(-K4*k1)) * (a_x*a_z)
        + (D12(-K4*k1) + D34(K8*k1)) * (a_y*a_z)
    )
    A[2] = (  # A_1s
        (D12(-k1) + D12(-beta_z*k1*vartheta_z) + D34(k1*(beta_x*vartheta_y - beta_z + vartheta_z))) * a_x
        + (D12(k1*(beta_x*vartheta_y - beta_z + vartheta_z)) + D34(k1) + D34(beta_z*k1*vartheta_z)) * a_y
        + D12(-R*k1*vartheta_y) * T_3
        + D34(-R*k1*vartheta_y) * T_4
        + D12(R*beta_x*k1) * S_1
        + D34(-R*beta_x*k1) * S_2
        + (D12(K4*k1) + D34(-K8*k1)) * (a_x*a_z)
        + (D12(-K8*k1) + D34(-K4*k1)) * (a_y*a_z)
    )
    A[3] = (  # A_2c
        Sigma((R*k1)*(2.0*beta_z - vartheta_z)) * T_1
        + Sigma(R*k1) * T_2
        + Sigma((0.5*k1)*(-K2 + K5)) * a_x**2.0
        + Sigma(K6*k1) * (a_x*a_y)
        + Sigma((0.5*k1)*(K2 - K5)) * a_y**2.0
    )
    A[4] = (  # A_2s
        Sigma(R*k1) * T_1
        + Sigma((R*k1)*(-2.0*beta_z + vartheta_z)) * T_2
        + Sigma(-0.5*K6*k1) * a_x**2.0
        + Sigma(k1*(-K2 + K5)) * (a_x*a_y)
        + Sigma(0.5*K6*k1) * a_y**2.0
    )
    return A


def output(t: Array, inputs: Array, p: Array, angle: Array | None = None) -> Array:
    """G_out, (N,), V, at the times t (N,), s; `angle` (N,), rad, is the disc's own encoder if recorded."""
    phi = disc_angle(t, float(p[1])) if angle is None else angle
    G = np.empty(len(phi))
    for start in range(0, len(phi), BLOCK):
        part = slice(start, start + BLOCK)
        A = amplitudes(inputs[:, part], p)
        g = A[0].copy()
        for n in range(1, 3):
            g += A[2 * n - 1] * np.cos(n * phi[part]) + A[2 * n] * np.sin(n * phi[part])
        G[part] = g
    return G


def _basis(psi: Array, inputs: Array) -> Array:
    """(29, N): harmonics of an accelerometer's own angle times motion monomials."""
    a_x, a_y, a_z = inputs[:3]
    T_1, T_2, T_3, T_4, T_5, T_6, S_1, S_2 = motion_numbers(inputs)
    c1, s1 = np.cos(1 * psi), np.sin(1 * psi)
    c2, s2 = np.cos(2 * psi), np.sin(2 * psi)
    X = np.empty((29, len(psi)))
    X[0] = 1 * (a_x**2.0)
    X[1] = 1 * (a_y**2.0)
    X[2] = 1 * (a_z**2.0)
    X[3] = 1 * (a_z)
    X[4] = 1 * (T_5)
    X[5] = 1 * (T_6)
    X[6] = 1
    X[7] = c1 * (a_x*a_z)
    X[8] = c1 * (a_x)
    X[9] = c1 * (a_y*a_z)
    X[10] = c1 * (a_y)
    X[11] = c1 * (T_4)
    X[12] = c1 * (S_2)
    X[13] = s1 * (a_x*a_z)
    X[14] = s1 * (a_x)
    X[15] = s1 * (a_y*a_z)
    X[16] = s1 * (a_y)
    X[17] = s1 * (T_3)
    X[18] = s1 * (S_1)
    X[19] = c2 * (a_x**2.0)
    X[20] = c2 * (a_x*a_y)
    X[21] = c2 * (a_y**2.0)
    X[22] = c2 * (T_1)
    X[23] = c2 * (T_2)
    X[24] = s2 * (a_x**2.0)
    X[25] = s2 * (a_x*a_y)
    X[26] = s2 * (a_y**2.0)
    X[27] = s2 * (T_1)
    X[28] = s2 * (T_2)
    return X


def _slopes(q: Array, radius: float) -> Array:
    """(14, 29): derivatives of the basis' coefficients by k1, R, beta_x, beta_z, vartheta_x, vartheta_y, vartheta_z, K0, K2, K4, K5, K6, K7, K8."""
    dR, beta_x, beta_z, vartheta_x, vartheta_y, vartheta_z, K0, K1, K2, K4, K5, K6, K7, K8, k_VI = q
    R = radius + dR
    k1 = k_VI * K1
    C = np.zeros((14, 29))
    C[0, 0] = 0.5*(K2 + K5)
    C[0, 1] = 0.5*(K2 + K5)
    C[0, 2] = K7
    C[0, 3] = 1.0*(-beta_x*vartheta_z + vartheta_y)
    C[0, 4] = -R*vartheta_z
    C[0, 5] = R
    C[0, 6] = K0
    C[0, 7] = -K8
    C[0, 8] = 1.0*(beta_x*vartheta_y - beta_z + vartheta_z)
    C[0, 9] = -K4
    C[0, 10] = 1.0*(beta_z*vartheta_z + 1)
    C[0, 11] = -R*vartheta_y
    C[0, 12] = -R*beta_x
    C[0, 13] = K4
    C[0, 14] = 1.0*(-beta_z*vartheta_z - 1)
    C[0, 15] = -K8
    C[0, 16] = 1.0*(beta_x*vartheta_y - beta_z + vartheta_z)
    C[0, 17] = -R*vartheta_y
    C[0, 18] = R*beta_x
    C[0, 19] = 0.5*(-K2 + K5)
    C[0, 20] = K6
    C[0, 21] = 0.5*(K2 - K5)
    C[0, 22] = R*(2.0*beta_z - vartheta_z)
    C[0, 23] = R
    C[0, 24] = -0.5*K6
    C[0, 25] = 1.0*(-K2 + K5)
    C[0, 26] = 0.5*K6
    C[0, 27] = R
    C[0, 28] = R*(-2.0*beta_z + vartheta_z)
    C[1, 4] = -k1*vartheta_z
    C[1, 5] = k1
    C[1, 11] = -k1*vartheta_y
    C[1, 12] = -beta_x*k1
    C[1, 17] = -k1*vartheta_y
    C[1, 18] = beta_x*k1
    C[1, 22] = k1*(2.0*beta_z - vartheta_z)
    C[1, 23] = k1
    C[1, 27] = k1
    C[1, 28] = k1*(-2.0*beta_z + vartheta_z)
    C[2, 3] = -k1*vartheta_z
    C[2, 8] = k1*vartheta_y
    C[2, 12] = -R*k1
    C[2, 16] = k1*vartheta_y
    C[2, 18] = R*k1
    C[3, 8] = -k1
    C[3, 10] = k1*vartheta_z
    C[3, 14] = -k1*vartheta_z
    C[3, 16] = -k1
    C[3, 22] = 2.0*R*k1
    C[3, 28] = -2.0*R*k1
    C[5, 3] = k1
    C[5, 8] = beta_x*k1
    C[5, 11] = -R*k1
    C[5, 16] = beta_x*k1
    C[5, 17] = -R*k1
    C[6, 3] = -beta_x*k1
    C[6, 4] = -R*k1
    C[6, 8] = k1
    C[6, 10] = beta_z*k1
    C[6, 14] = -beta_z*k1
    C[6, 16] = k1
    C[6, 22] = -R*k1
    C[6, 28] = R*k1
    C[7, 6] = k1
    C[8, 0] = 0.5*k1
    C[8, 1] = 0.5*k1
    C[8, 19] = -0.5*k1
    C[8, 21] = 0.5*k1
    C[8, 25] = -k1
    C[9, 9] = -k1
    C[9, 13] = k1
    C[10, 0] = 0.5*k1
    C[10, 1] = 0.5*k1
    C[10, 19] = 0.5*k1
    C[10, 21] = -0.5*k1
    C[10, 25] = k1
    C[11, 20] = k1
    C[11, 24] = -0.5*k1
    C[11, 26] = 0.5*k1
    C[12, 2] = k1
    C[13, 7] = -k1
    C[13, 15] = -k1
    return C


def jacobian(t: Array, inputs: Array, p: Array, angle: Array | None = None) -> Array:
    """Derivative of G_out by every parameter, (SIZE, N), in the order of PARAMETERS."""
    phi = disc_angle(t, float(p[1])) if angle is None else angle
    J = np.zeros((SIZE, len(phi)))
    for j in range(4):
        q = p[2:].reshape(-1, 4)[:, j]
        X = _basis(phi + QUARTER_TURNS[j] * (np.pi / 2), inputs)
        by = dict(zip(("k1", "R", "beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z", "K0", "K2", "K4", "K5", "K6", "K7", "K8", ), SIGNS[j] * (_slopes(q, float(p[0])) @ X), strict=True))
        K1, k_VI = q[[7, 14]]
        by["dR"] = by["R"]
        by["K1"] = k_VI * by["k1"]
        by["k_VI"] = K1 * by["k1"]
        J[0] += by["R"]
        for n, name in enumerate(("dR", "beta_x", "beta_z", "vartheta_x", "vartheta_y", "vartheta_z", "K0", "K1", "K2", "K4", "K5", "K6", "K7", "K8", "k_VI", )):
            if name in by:
                J[2 + 4 * n + j] = by[name]
    if angle is None:
        A = amplitudes(inputs, p)
        for n in range(1, 3):
            slope = n * (A[2 * n] * np.cos(n * phi) - A[2 * n - 1] * np.sin(n * phi))
            J[1] += 2.0 * np.pi * t * slope
    return J
