"""The analytical model of the RAGG (paper, Eq. 16-19).

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
AMPLITUDES: tuple[str, ...] = ("A_0", "A_1c", "A_1s", "A_2c", "A_2s", "A_3c", "A_3s", "A_4c", "A_4s", )
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
    """(T_1, T_2, T_3, T_4, T_5, T_6, S_1, S_2, S_4), each (N,), s^-2 (Eq. 16)."""
    a_x, a_y, a_z, omega_x, omega_y, omega_z, omegadot_x, omegadot_y, omegadot_z, Gamma_xx, Gamma_xy, Gamma_xz, Gamma_yy, Gamma_yz, Gamma_zz = inputs
    T_1 = 0.5*Gamma_xx - 0.5*Gamma_yy - 0.5*omega_x**2.0 + 0.5*omega_y**2.0
    T_2 = -Gamma_xy + omega_x*omega_y
    T_3 = Gamma_yz - omega_y*omega_z - omegadot_x
    T_4 = Gamma_xz - omega_x*omega_z + omegadot_y
    T_5 = 0.5*Gamma_xx + 0.5*Gamma_yy + 0.5*omega_x**2.0 + 0.5*omega_y**2.0 + omega_z**2.0
    T_6 = omegadot_z
    S_1 = Gamma_xz - omega_x*omega_z - omegadot_y
    S_2 = Gamma_yz - omega_y*omega_z + omegadot_x
    S_4 = Gamma_zz + omega_x**2.0 + omega_y**2.0
    return T_1, T_2, T_3, T_4, T_5, T_6, S_1, S_2, S_4


def amplitudes(inputs: Array, p: Array) -> Array:
    """The amplitudes of Eq. 17, (9, N), V, in the order of AMPLITUDES."""
    a_x, a_y, a_z = inputs[:3]
    T_1, T_2, T_3, T_4, T_5, T_6, S_1, S_2, S_4 = motion_numbers(inputs)
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
        + D1234((R*k1)*(-beta_x*beta_z**2.0*vartheta_y - beta_x*vartheta_y - beta_z**2.0*vartheta_z - vartheta_z)) * T_5
        + (D1234(R*k1) + D1234(R*beta_z**2.0*k1)) * T_6
        + D1234((R*beta_x*k1)*(beta_x*vartheta_z - vartheta_y)) * S_4
        + D1234((0.5*k1)*(K2 + K5)) * a_x**2.0
        + D1234(-0.5*K4*R*k1) * (T_3*a_x)
        + D1234(0.5*K8*R*k1) * (T_4*a_x)
        + D1234((0.5*k1)*(K2 + K5)) * a_y**2.0
        + D1234(0.5*K8*R*k1) * (T_3*a_y)
        + D1234(0.5*K4*R*k1) * (T_4*a_y)
        + D1234(K7*k1) * a_z**2.0
        + D1234(K8*R*k1) * (T_5*a_z)
        + D1234(-K4*R*k1) * (T_6*a_z)
        + D1234((0.5*R**2.0*k1)*(K2 + K5)) * T_1**2.0
        + D1234((0.5*R**2.0*k1)*(K2 + K5)) * T_2**2.0
        + D1234(0.5*K7*R**2.0*k1) * T_3**2.0
        + D1234(0.5*K7*R**2.0*k1) * T_4**2.0
        + D1234(K5*R**2.0*k1) * T_5**2.0
        + D1234(-K6*R**2.0*k1) * (T_5*T_6)
        + D1234(K2*R**2.0*k1) * T_6**2.0
    )
    A[1] = (  # A_1c
        (D12(k1*(beta_x*vartheta_y - beta_z + vartheta_z)) + D34(k1) + D34((beta_z*k1)*(beta_x*vartheta_y + vartheta_z))) * a_x
        + (D12(k1) + D12((beta_z*k1)*(beta_x*vartheta_y + vartheta_z)) + D34(k1*(-beta_x*vartheta_y + beta_z - vartheta_z))) * a_y
        + (D12((R*beta_z*k1)*(beta_x*vartheta_z - vartheta_y)) + D34((R*k1)*(-beta_x*vartheta_z + vartheta_y))) * T_3
        + (D12((R*k1)*(beta_x*vartheta_z - vartheta_y)) + D34((R*beta_z*k1)*(beta_x*vartheta_z - vartheta_y))) * T_4
        + (D12((R*beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z)) + D34((R*beta_x*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1))) * S_1
        + (D12((R*beta_x*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1)) + D34((R*beta_x*k1)*(beta_x*vartheta_y - beta_z + vartheta_z))) * S_2
        + (D12(-K8*k1) + D34(-K4*k1)) * (a_x*a_z)
        + D12((R*k1)*(-K2 - K5)) * (T_1*a_x)
        + D34((R*k1)*(-K2 - K5)) * (T_2*a_x)
        + (D12(-2.0*K5*R*k1) + D34(-K6*R*k1)) * (T_5*a_x)
        + (D12(K6*R*k1) + D34(2.0*K2*R*k1)) * (T_6*a_x)
        + (D12(-K4*k1) + D34(K8*k1)) * (a_y*a_z)
        + D34((R*k1)*(-K2 - K5)) * (T_1*a_y)
        + D12((R*k1)*(K2 + K5)) * (T_2*a_y)
        + (D12(-K6*R*k1) + D34(2.0*K5*R*k1)) * (T_5*a_y)
        + (D12(2.0*K2*R*k1) + D34(-K6*R*k1)) * (T_6*a_y)
        + D34(2.0*K7*R*k1) * (T_3*a_z)
        + D12(-2.0*K7*R*k1) * (T_4*a_z)
        + (D12(0.5*K4*R**2.0*k1) + D34(-0.5*K8*R**2.0*k1)) * (T_1*T_3)
        + (D12(-0.5*K8*R**2.0*k1) + D34(-0.5*K4*R**2.0*k1)) * (T_1*T_4)
        + (D12(0.5*K8*R**2.0*k1) + D34(0.5*K4*R**2.0*k1)) * (T_2*T_3)
        + (D12(0.5*K4*R**2.0*k1) + D34(-0.5*K8*R**2.0*k1)) * (T_2*T_4)
        + D34(K8*R**2.0*k1) * (T_3*T_5)
        + D34(-K4*R**2.0*k1) * (T_3*T_6)
        + D12(-K8*R**2.0*k1) * (T_4*T_5)
        + D12(K4*R**2.0*k1) * (T_4*T_6)
    )
    A[2] = (  # A_1s
        (D12(-k1) + D12((beta_z*k1)*(-beta_x*vartheta_y - vartheta_z)) + D34(k1*(beta_x*vartheta_y - beta_z + vartheta_z))) * a_x
        + (D12(k1*(beta_x*vartheta_y - beta_z + vartheta_z)) + D34(k1) + D34((beta_z*k1)*(beta_x*vartheta_y + vartheta_z))) * a_y
        + (D12((R*k1)*(beta_x*vartheta_z - vartheta_y)) + D34((R*beta_z*k1)*(beta_x*vartheta_z - vartheta_y))) * T_3
        + (D12((R*beta_z*k1)*(-beta_x*vartheta_z + vartheta_y)) + D34((R*k1)*(beta_x*vartheta_z - vartheta_y))) * T_4
        + (D12((R*beta_x*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1)) + D34((R*beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z))) * S_1
        + (D12((R*beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z)) + D34((R*beta_x*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1))) * S_2
        + (D12(K4*k1) + D34(-K8*k1)) * (a_x*a_z)
        + D34((R*k1)*(-K2 - K5)) * (T_1*a_x)
        + D12((R*k1)*(K2 + K5)) * (T_2*a_x)
        + (D12(K6*R*k1) + D34(-2.0*K5*R*k1)) * (T_5*a_x)
        + (D12(-2.0*K2*R*k1) + D34(K6*R*k1)) * (T_6*a_x)
        + (D12(-K8*k1) + D34(-K4*k1)) * (a_y*a_z)
        + D12((R*k1)*(K2 + K5)) * (T_1*a_y)
        + D34((R*k1)*(K2 + K5)) * (T_2*a_y)
        + (D12(-2.0*K5*R*k1) + D34(-K6*R*k1)) * (T_5*a_y)
        + (D12(K6*R*k1) + D34(2.0*K2*R*k1)) * (T_6*a_y)
        + D12(-2.0*K7*R*k1) * (T_3*a_z)
        + D34(-2.0*K7*R*k1) * (T_4*a_z)
        + (D12(0.5*K8*R**2.0*k1) + D34(0.5*K4*R**2.0*k1)) * (T_1*T_3)
        + (D12(0.5*K4*R**2.0*k1) + D34(-0.5*K8*R**2.0*k1)) * (T_1*T_4)
        + (D12(-0.5*K4*R**2.0*k1) + D34(0.5*K8*R**2.0*k1)) * (T_2*T_3)
        + (D12(0.5*K8*R**2.0*k1) + D34(0.5*K4*R**2.0*k1)) * (T_2*T_4)
        + D12(-K8*R**2.0*k1) * (T_3*T_5)
        + D12(K4*R**2.0*k1) * (T_3*T_6)
        + D34(-K8*R**2.0*k1) * (T_4*T_5)
        + D34(K4*R**2.0*k1) * (T_4*T_6)
    )
    A[3] = (  # A_2c
        Sigma((R*k1)*(beta_x*beta_z**2.0*vartheta_y - beta_x*vartheta_y + beta_z**2.0*vartheta_z + 2.0*beta_z - vartheta_z)) * T_1
        + (Sigma(R*k1) + Sigma((R*beta_z*k1)*(2.0*beta_x*vartheta_y - beta_z + 2.0*vartheta_z))) * T_2
        + Sigma((0.5*k1)*(-K2 + K5)) * a_x**2.0
        + Sigma(K6*k1) * (a_x*a_y)
        + Sigma(0.5*K4*R*k1) * (T_3*a_x)
        + Sigma(0.5*K8*R*k1) * (T_4*a_x)
        + Sigma((0.5*k1)*(K2 - K5)) * a_y**2.0
        + Sigma(-0.5*K8*R*k1) * (T_3*a_y)
        + Sigma(0.5*K4*R*k1) * (T_4*a_y)
        + Sigma(K8*R*k1) * (T_1*a_z)
        + Sigma(-K4*R*k1) * (T_2*a_z)
        + Sigma(2.0*K5*R**2.0*k1) * (T_1*T_5)
        + Sigma(-K6*R**2.0*k1) * (T_1*T_6)
        + Sigma(-K6*R**2.0*k1) * (T_2*T_5)
        + Sigma(2.0*K2*R**2.0*k1) * (T_2*T_6)
        + Sigma(-0.5*K7*R**2.0*k1) * T_3**2.0
        + Sigma(0.5*K7*R**2.0*k1) * T_4**2.0
    )
    A[4] = (  # A_2s
        (Sigma(R*k1) + Sigma((R*beta_z*k1)*(2.0*beta_x*vartheta_y - beta_z + 2.0*vartheta_z))) * T_1
        + Sigma((R*k1)*(-beta_x*beta_z**2.0*vartheta_y + beta_x*vartheta_y - beta_z**2.0*vartheta_z - 2.0*beta_z + vartheta_z)) * T_2
        + Sigma(-0.5*K6*k1) * a_x**2.0
        + Sigma(k1*(-K2 + K5)) * (a_x*a_y)
        + Sigma(0.5*K8*R*k1) * (T_3*a_x)
        + Sigma(-0.5*K4*R*k1) * (T_4*a_x)
        + Sigma(0.5*K6*k1) * a_y**2.0
        + Sigma(0.5*K4*R*k1) * (T_3*a_y)
        + Sigma(0.5*K8*R*k1) * (T_4*a_y)
        + Sigma(-K4*R*k1) * (T_1*a_z)
        + Sigma(-K8*R*k1) * (T_2*a_z)
        + Sigma(-K6*R**2.0*k1) * (T_1*T_5)
        + Sigma(2.0*K2*R**2.0*k1) * (T_1*T_6)
        + Sigma(-2.0*K5*R**2.0*k1) * (T_2*T_5)
        + Sigma(K6*R**2.0*k1) * (T_2*T_6)
        + Sigma(K7*R**2.0*k1) * (T_3*T_4)
    )
    A[5] = (  # A_3c
        (D12((R*k1)*(K2 - K5)) + D34(K6*R*k1)) * (T_1*a_x)
        + (D12(K6*R*k1) + D34((R*k1)*(-K2 + K5))) * (T_2*a_x)
        + (D12(-K6*R*k1) + D34((R*k1)*(K2 - K5))) * (T_1*a_y)
        + (D12((R*k1)*(K2 - K5)) + D34(K6*R*k1)) * (T_2*a_y)
        + (D12(-0.5*K4*R**2.0*k1) + D34(-0.5*K8*R**2.0*k1)) * (T_1*T_3)
        + (D12(-0.5*K8*R**2.0*k1) + D34(0.5*K4*R**2.0*k1)) * (T_1*T_4)
        + (D12(-0.5*K8*R**2.0*k1) + D34(0.5*K4*R**2.0*k1)) * (T_2*T_3)
        + (D12(0.5*K4*R**2.0*k1) + D34(0.5*K8*R**2.0*k1)) * (T_2*T_4)
    )
    A[6] = (  # A_3s
        (D12(K6*R*k1) + D34((R*k1)*(-K2 + K5))) * (T_1*a_x)
        + (D12((R*k1)*(-K2 + K5)) + D34(-K6*R*k1)) * (T_2*a_x)
        + (D12((R*k1)*(K2 - K5)) + D34(K6*R*k1)) * (T_1*a_y)
        + (D12(K6*R*k1) + D34((R*k1)*(-K2 + K5))) * (T_2*a_y)
        + (D12(-0.5*K8*R**2.0*k1) + D34(0.5*K4*R**2.0*k1)) * (T_1*T_3)
        + (D12(0.5*K4*R**2.0*k1) + D34(0.5*K8*R**2.0*k1)) * (T_1*T_4)
        + (D12(0.5*K4*R**2.0*k1) + D34(0.5*K8*R**2.0*k1)) * (T_2*T_3)
        + (D12(0.5*K8*R**2.0*k1) + D34(-0.5*K4*R**2.0*k1)) * (T_2*T_4)
    )
    A[7] = (  # A_4c
        D1234((0.5*R**2.0*k1)*(-K2 + K5)) * T_1**2.0
        + D1234(-K6*R**2.0*k1) * (T_1*T_2)
        + D1234((0.5*R**2.0*k1)*(K2 - K5)) * T_2**2.0
    )
    A[8] = (  # A_4s
        D1234(-0.5*K6*R**2.0*k1) * T_1**2.0
        + D1234((R**2.0*k1)*(K2 - K5)) * (T_1*T_2)
        + D1234(0.5*K6*R**2.0*k1) * T_2**2.0
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
        for n in range(1, 5):
            g += A[2 * n - 1] * np.cos(n * phi[part]) + A[2 * n] * np.sin(n * phi[part])
        G[part] = g
    return G


def _basis(psi: Array, inputs: Array) -> Array:
    """(118, N): harmonics of an accelerometer's own angle times motion monomials."""
    a_x, a_y, a_z = inputs[:3]
    T_1, T_2, T_3, T_4, T_5, T_6, S_1, S_2, S_4 = motion_numbers(inputs)
    c1, s1 = np.cos(1 * psi), np.sin(1 * psi)
    c2, s2 = np.cos(2 * psi), np.sin(2 * psi)
    c3, s3 = np.cos(3 * psi), np.sin(3 * psi)
    c4, s4 = np.cos(4 * psi), np.sin(4 * psi)
    X = np.empty((118, len(psi)))
    X[0] = 1 * (a_x**2.0)
    X[1] = 1 * (T_3*a_x)
    X[2] = 1 * (T_4*a_x)
    X[3] = 1 * (a_y**2.0)
    X[4] = 1 * (T_3*a_y)
    X[5] = 1 * (T_4*a_y)
    X[6] = 1 * (a_z**2.0)
    X[7] = 1 * (T_5*a_z)
    X[8] = 1 * (T_6*a_z)
    X[9] = 1 * (a_z)
    X[10] = 1 * (T_1**2.0)
    X[11] = 1 * (T_2**2.0)
    X[12] = 1 * (T_3**2.0)
    X[13] = 1 * (T_4**2.0)
    X[14] = 1 * (T_5**2.0)
    X[15] = 1 * (T_5*T_6)
    X[16] = 1 * (T_5)
    X[17] = 1 * (T_6**2.0)
    X[18] = 1 * (T_6)
    X[19] = 1 * (S_4)
    X[20] = 1
    X[21] = c1 * (a_x*a_z)
    X[22] = c1 * (T_1*a_x)
    X[23] = c1 * (T_5*a_x)
    X[24] = c1 * (T_6*a_x)
    X[25] = c1 * (a_x)
    X[26] = c1 * (a_y*a_z)
    X[27] = c1 * (T_2*a_y)
    X[28] = c1 * (T_5*a_y)
    X[29] = c1 * (T_6*a_y)
    X[30] = c1 * (a_y)
    X[31] = c1 * (T_4*a_z)
    X[32] = c1 * (T_1*T_3)
    X[33] = c1 * (T_1*T_4)
    X[34] = c1 * (T_2*T_3)
    X[35] = c1 * (T_2*T_4)
    X[36] = c1 * (T_3)
    X[37] = c1 * (T_4*T_5)
    X[38] = c1 * (T_4*T_6)
    X[39] = c1 * (T_4)
    X[40] = c1 * (S_1)
    X[41] = c1 * (S_2)
    X[42] = s1 * (a_x*a_z)
    X[43] = s1 * (T_2*a_x)
    X[44] = s1 * (T_5*a_x)
    X[45] = s1 * (T_6*a_x)
    X[46] = s1 * (a_x)
    X[47] = s1 * (a_y*a_z)
    X[48] = s1 * (T_1*a_y)
    X[49] = s1 * (T_5*a_y)
    X[50] = s1 * (T_6*a_y)
    X[51] = s1 * (a_y)
    X[52] = s1 * (T_3*a_z)
    X[53] = s1 * (T_1*T_3)
    X[54] = s1 * (T_1*T_4)
    X[55] = s1 * (T_2*T_3)
    X[56] = s1 * (T_2*T_4)
    X[57] = s1 * (T_3*T_5)
    X[58] = s1 * (T_3*T_6)
    X[59] = s1 * (T_3)
    X[60] = s1 * (T_4)
    X[61] = s1 * (S_1)
    X[62] = s1 * (S_2)
    X[63] = c2 * (a_x**2.0)
    X[64] = c2 * (a_x*a_y)
    X[65] = c2 * (T_3*a_x)
    X[66] = c2 * (T_4*a_x)
    X[67] = c2 * (a_y**2.0)
    X[68] = c2 * (T_3*a_y)
    X[69] = c2 * (T_4*a_y)
    X[70] = c2 * (T_1*a_z)
    X[71] = c2 * (T_2*a_z)
    X[72] = c2 * (T_1*T_5)
    X[73] = c2 * (T_1*T_6)
    X[74] = c2 * (T_1)
    X[75] = c2 * (T_2*T_5)
    X[76] = c2 * (T_2*T_6)
    X[77] = c2 * (T_2)
    X[78] = c2 * (T_3**2.0)
    X[79] = c2 * (T_4**2.0)
    X[80] = s2 * (a_x**2.0)
    X[81] = s2 * (a_x*a_y)
    X[82] = s2 * (T_3*a_x)
    X[83] = s2 * (T_4*a_x)
    X[84] = s2 * (a_y**2.0)
    X[85] = s2 * (T_3*a_y)
    X[86] = s2 * (T_4*a_y)
    X[87] = s2 * (T_1*a_z)
    X[88] = s2 * (T_2*a_z)
    X[89] = s2 * (T_1*T_5)
    X[90] = s2 * (T_1*T_6)
    X[91] = s2 * (T_1)
    X[92] = s2 * (T_2*T_5)
    X[93] = s2 * (T_2*T_6)
    X[94] = s2 * (T_2)
    X[95] = s2 * (T_3*T_4)
    X[96] = c3 * (T_1*a_x)
    X[97] = c3 * (T_2*a_x)
    X[98] = c3 * (T_1*a_y)
    X[99] = c3 * (T_2*a_y)
    X[100] = c3 * (T_1*T_3)
    X[101] = c3 * (T_1*T_4)
    X[102] = c3 * (T_2*T_3)
    X[103] = c3 * (T_2*T_4)
    X[104] = s3 * (T_1*a_x)
    X[105] = s3 * (T_2*a_x)
    X[106] = s3 * (T_1*a_y)
    X[107] = s3 * (T_2*a_y)
    X[108] = s3 * (T_1*T_3)
    X[109] = s3 * (T_1*T_4)
    X[110] = s3 * (T_2*T_3)
    X[111] = s3 * (T_2*T_4)
    X[112] = c4 * (T_1**2.0)
    X[113] = c4 * (T_1*T_2)
    X[114] = c4 * (T_2**2.0)
    X[115] = s4 * (T_1**2.0)
    X[116] = s4 * (T_1*T_2)
    X[117] = s4 * (T_2**2.0)
    return X


def _slopes(q: Array, radius: float) -> Array:
    """(14, 118): derivatives of the basis' coefficients by k1, R, beta_x, beta_z, vartheta_x, vartheta_y, vartheta_z, K0, K2, K4, K5, K6, K7, K8."""
    dR, beta_x, beta_z, vartheta_x, vartheta_y, vartheta_z, K0, K1, K2, K4, K5, K6, K7, K8, k_VI = q
    R = radius + dR
    k1 = k_VI * K1
    C = np.zeros((14, 118))
    C[0, 0] = 0.5*(K2 + K5)
    C[0, 1] = -0.5*K4*R
    C[0, 2] = 0.5*K8*R
    C[0, 3] = 0.5*(K2 + K5)
    C[0, 4] = 0.5*K8*R
    C[0, 5] = 0.5*K4*R
    C[0, 6] = K7
    C[0, 7] = K8*R
    C[0, 8] = -K4*R
    C[0, 9] = 1.0*(-beta_x*vartheta_z + vartheta_y)
    C[0, 10] = (0.5*R**2.0)*(K2 + K5)
    C[0, 11] = (0.5*R**2.0)*(K2 + K5)
    C[0, 12] = 0.5*K7*R**2.0
    C[0, 13] = 0.5*K7*R**2.0
    C[0, 14] = K5*R**2.0
    C[0, 15] = -K6*R**2.0
    C[0, 16] = R*(-beta_x*beta_z**2.0*vartheta_y - beta_x*vartheta_y - beta_z**2.0*vartheta_z - vartheta_z)
    C[0, 17] = K2*R**2.0
    C[0, 18] = R*(beta_z**2.0 + 1)
    C[0, 19] = (R*beta_x)*(beta_x*vartheta_z - vartheta_y)
    C[0, 20] = K0
    C[0, 21] = -K8
    C[0, 22] = R*(-K2 - K5)
    C[0, 23] = -2.0*K5*R
    C[0, 24] = K6*R
    C[0, 25] = 1.0*(beta_x*vartheta_y - beta_z + vartheta_z)
    C[0, 26] = -K4
    C[0, 27] = R*(K2 + K5)
    C[0, 28] = -K6*R
    C[0, 29] = 2.0*K2*R
    C[0, 30] = 1.0*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1)
    C[0, 31] = -2.0*K7*R
    C[0, 32] = 0.5*K4*R**2.0
    C[0, 33] = -0.5*K8*R**2.0
    C[0, 34] = 0.5*K8*R**2.0
    C[0, 35] = 0.5*K4*R**2.0
    C[0, 36] = (R*beta_z)*(beta_x*vartheta_z - vartheta_y)
    C[0, 37] = -K8*R**2.0
    C[0, 38] = K4*R**2.0
    C[0, 39] = R*(beta_x*vartheta_z - vartheta_y)
    C[0, 40] = (R*beta_x)*(-beta_x*vartheta_y + beta_z - vartheta_z)
    C[0, 41] = (R*beta_x)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1)
    C[0, 42] = K4
    C[0, 43] = R*(K2 + K5)
    C[0, 44] = K6*R
    C[0, 45] = -2.0*K2*R
    C[0, 46] = 1.0*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1)
    C[0, 47] = -K8
    C[0, 48] = R*(K2 + K5)
    C[0, 49] = -2.0*K5*R
    C[0, 50] = K6*R
    C[0, 51] = 1.0*(beta_x*vartheta_y - beta_z + vartheta_z)
    C[0, 52] = -2.0*K7*R
    C[0, 53] = 0.5*K8*R**2.0
    C[0, 54] = 0.5*K4*R**2.0
    C[0, 55] = -0.5*K4*R**2.0
    C[0, 56] = 0.5*K8*R**2.0
    C[0, 57] = -K8*R**2.0
    C[0, 58] = K4*R**2.0
    C[0, 59] = R*(beta_x*vartheta_z - vartheta_y)
    C[0, 60] = (R*beta_z)*(-beta_x*vartheta_z + vartheta_y)
    C[0, 61] = (R*beta_x)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1)
    C[0, 62] = (R*beta_x)*(-beta_x*vartheta_y + beta_z - vartheta_z)
    C[0, 63] = 0.5*(-K2 + K5)
    C[0, 64] = K6
    C[0, 65] = 0.5*K4*R
    C[0, 66] = 0.5*K8*R
    C[0, 67] = 0.5*(K2 - K5)
    C[0, 68] = -0.5*K8*R
    C[0, 69] = 0.5*K4*R
    C[0, 70] = K8*R
    C[0, 71] = -K4*R
    C[0, 72] = 2.0*K5*R**2.0
    C[0, 73] = -K6*R**2.0
    C[0, 74] = R*(beta_x*beta_z**2.0*vartheta_y - beta_x*vartheta_y + beta_z**2.0*vartheta_z + 2.0*beta_z - vartheta_z)
    C[0, 75] = -K6*R**2.0
    C[0, 76] = 2.0*K2*R**2.0
    C[0, 77] = R*(2.0*beta_x*beta_z*vartheta_y - beta_z**2.0 + 2.0*beta_z*vartheta_z + 1)
    C[0, 78] = -0.5*K7*R**2.0
    C[0, 79] = 0.5*K7*R**2.0
    C[0, 80] = -0.5*K6
    C[0, 81] = 1.0*(-K2 + K5)
    C[0, 82] = 0.5*K8*R
    C[0, 83] = -0.5*K4*R
    C[0, 84] = 0.5*K6
    C[0, 85] = 0.5*K4*R
    C[0, 86] = 0.5*K8*R
    C[0, 87] = -K4*R
    C[0, 88] = -K8*R
    C[0, 89] = -K6*R**2.0
    C[0, 90] = 2.0*K2*R**2.0
    C[0, 91] = R*(2.0*beta_x*beta_z*vartheta_y - beta_z**2.0 + 2.0*beta_z*vartheta_z + 1)
    C[0, 92] = -2.0*K5*R**2.0
    C[0, 93] = K6*R**2.0
    C[0, 94] = R*(-beta_x*beta_z**2.0*vartheta_y + beta_x*vartheta_y - beta_z**2.0*vartheta_z - 2.0*beta_z + vartheta_z)
    C[0, 95] = K7*R**2.0
    C[0, 96] = R*(K2 - K5)
    C[0, 97] = K6*R
    C[0, 98] = -K6*R
    C[0, 99] = R*(K2 - K5)
    C[0, 100] = -0.5*K4*R**2.0
    C[0, 101] = -0.5*K8*R**2.0
    C[0, 102] = -0.5*K8*R**2.0
    C[0, 103] = 0.5*K4*R**2.0
    C[0, 104] = K6*R
    C[0, 105] = R*(-K2 + K5)
    C[0, 106] = R*(K2 - K5)
    C[0, 107] = K6*R
    C[0, 108] = -0.5*K8*R**2.0
    C[0, 109] = 0.5*K4*R**2.0
    C[0, 110] = 0.5*K4*R**2.0
    C[0, 111] = 0.5*K8*R**2.0
    C[0, 112] = (0.5*R**2.0)*(-K2 + K5)
    C[0, 113] = -K6*R**2.0
    C[0, 114] = (0.5*R**2.0)*(K2 - K5)
    C[0, 115] = -0.5*K6*R**2.0
    C[0, 116] = R**2.0*(K2 - K5)
    C[0, 117] = 0.5*K6*R**2.0
    C[1, 1] = -0.5*K4*k1
    C[1, 2] = 0.5*K8*k1
    C[1, 4] = 0.5*K8*k1
    C[1, 5] = 0.5*K4*k1
    C[1, 7] = K8*k1
    C[1, 8] = -K4*k1
    C[1, 10] = (R*k1)*(K2 + K5)
    C[1, 11] = (R*k1)*(K2 + K5)
    C[1, 12] = K7*R*k1
    C[1, 13] = K7*R*k1
    C[1, 14] = 2.0*K5*R*k1
    C[1, 15] = -2.0*K6*R*k1
    C[1, 16] = k1*(-beta_x*beta_z**2.0*vartheta_y - beta_x*vartheta_y - beta_z**2.0*vartheta_z - vartheta_z)
    C[1, 17] = 2.0*K2*R*k1
    C[1, 18] = k1*(beta_z**2.0 + 1)
    C[1, 19] = (beta_x*k1)*(beta_x*vartheta_z - vartheta_y)
    C[1, 22] = k1*(-K2 - K5)
    C[1, 23] = -2.0*K5*k1
    C[1, 24] = K6*k1
    C[1, 27] = k1*(K2 + K5)
    C[1, 28] = -K6*k1
    C[1, 29] = 2.0*K2*k1
    C[1, 31] = -2.0*K7*k1
    C[1, 32] = K4*R*k1
    C[1, 33] = -K8*R*k1
    C[1, 34] = K8*R*k1
    C[1, 35] = K4*R*k1
    C[1, 36] = (beta_z*k1)*(beta_x*vartheta_z - vartheta_y)
    C[1, 37] = -2.0*K8*R*k1
    C[1, 38] = 2.0*K4*R*k1
    C[1, 39] = k1*(beta_x*vartheta_z - vartheta_y)
    C[1, 40] = (beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z)
    C[1, 41] = (beta_x*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1)
    C[1, 43] = k1*(K2 + K5)
    C[1, 44] = K6*k1
    C[1, 45] = -2.0*K2*k1
    C[1, 48] = k1*(K2 + K5)
    C[1, 49] = -2.0*K5*k1
    C[1, 50] = K6*k1
    C[1, 52] = -2.0*K7*k1
    C[1, 53] = K8*R*k1
    C[1, 54] = K4*R*k1
    C[1, 55] = -K4*R*k1
    C[1, 56] = K8*R*k1
    C[1, 57] = -2.0*K8*R*k1
    C[1, 58] = 2.0*K4*R*k1
    C[1, 59] = k1*(beta_x*vartheta_z - vartheta_y)
    C[1, 60] = (beta_z*k1)*(-beta_x*vartheta_z + vartheta_y)
    C[1, 61] = (beta_x*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1)
    C[1, 62] = (beta_x*k1)*(-beta_x*vartheta_y + beta_z - vartheta_z)
    C[1, 65] = 0.5*K4*k1
    C[1, 66] = 0.5*K8*k1
    C[1, 68] = -0.5*K8*k1
    C[1, 69] = 0.5*K4*k1
    C[1, 70] = K8*k1
    C[1, 71] = -K4*k1
    C[1, 72] = 4.0*K5*R*k1
    C[1, 73] = -2.0*K6*R*k1
    C[1, 74] = k1*(beta_x*beta_z**2.0*vartheta_y - beta_x*vartheta_y + beta_z**2.0*vartheta_z + 2.0*beta_z - vartheta_z)
    C[1, 75] = -2.0*K6*R*k1
    C[1, 76] = 4.0*K2*R*k1
    C[1, 77] = k1*(2.0*beta_x*beta_z*vartheta_y - beta_z**2.0 + 2.0*beta_z*vartheta_z + 1)
    C[1, 78] = -K7*R*k1
    C[1, 79] = K7*R*k1
    C[1, 82] = 0.5*K8*k1
    C[1, 83] = -0.5*K4*k1
    C[1, 85] = 0.5*K4*k1
    C[1, 86] = 0.5*K8*k1
    C[1, 87] = -K4*k1
    C[1, 88] = -K8*k1
    C[1, 89] = -2.0*K6*R*k1
    C[1, 90] = 4.0*K2*R*k1
    C[1, 91] = k1*(2.0*beta_x*beta_z*vartheta_y - beta_z**2.0 + 2.0*beta_z*vartheta_z + 1)
    C[1, 92] = -4.0*K5*R*k1
    C[1, 93] = 2.0*K6*R*k1
    C[1, 94] = k1*(-beta_x*beta_z**2.0*vartheta_y + beta_x*vartheta_y - beta_z**2.0*vartheta_z - 2.0*beta_z + vartheta_z)
    C[1, 95] = 2.0*K7*R*k1
    C[1, 96] = k1*(K2 - K5)
    C[1, 97] = K6*k1
    C[1, 98] = -K6*k1
    C[1, 99] = k1*(K2 - K5)
    C[1, 100] = -K4*R*k1
    C[1, 101] = -K8*R*k1
    C[1, 102] = -K8*R*k1
    C[1, 103] = K4*R*k1
    C[1, 104] = K6*k1
    C[1, 105] = k1*(-K2 + K5)
    C[1, 106] = k1*(K2 - K5)
    C[1, 107] = K6*k1
    C[1, 108] = -K8*R*k1
    C[1, 109] = K4*R*k1
    C[1, 110] = K4*R*k1
    C[1, 111] = K8*R*k1
    C[1, 112] = (R*k1)*(-K2 + K5)
    C[1, 113] = -2.0*K6*R*k1
    C[1, 114] = (R*k1)*(K2 - K5)
    C[1, 115] = -K6*R*k1
    C[1, 116] = (2.0*R*k1)*(K2 - K5)
    C[1, 117] = K6*R*k1
    C[2, 9] = -k1*vartheta_z
    C[2, 16] = (R*k1*vartheta_y)*(-beta_z**2.0 - 1)
    C[2, 19] = (R*k1)*(2.0*beta_x*vartheta_z - vartheta_y)
    C[2, 25] = k1*vartheta_y
    C[2, 30] = beta_z*k1*vartheta_y
    C[2, 36] = R*beta_z*k1*vartheta_z
    C[2, 39] = R*k1*vartheta_z
    C[2, 40] = (R*k1)*(-2.0*beta_x*vartheta_y + beta_z - vartheta_z)
    C[2, 41] = (R*k1)*(-2.0*beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1)
    C[2, 46] = -beta_z*k1*vartheta_y
    C[2, 51] = k1*vartheta_y
    C[2, 59] = R*k1*vartheta_z
    C[2, 60] = -R*beta_z*k1*vartheta_z
    C[2, 61] = (R*k1)*(2.0*beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1)
    C[2, 62] = (R*k1)*(-2.0*beta_x*vartheta_y + beta_z - vartheta_z)
    C[2, 74] = (R*k1*vartheta_y)*(beta_z**2.0 - 1)
    C[2, 77] = 2.0*R*beta_z*k1*vartheta_y
    C[2, 91] = 2.0*R*beta_z*k1*vartheta_y
    C[2, 94] = (R*k1*vartheta_y)*(1 - beta_z**2.0)
    C[3, 16] = (2.0*R*beta_z*k1)*(-beta_x*vartheta_y - vartheta_z)
    C[3, 18] = 2.0*R*beta_z*k1
    C[3, 25] = -k1
    C[3, 30] = k1*(beta_x*vartheta_y + vartheta_z)
    C[3, 36] = (R*k1)*(beta_x*vartheta_z - vartheta_y)
    C[3, 40] = R*beta_x*k1
    C[3, 41] = (R*beta_x*k1)*(-beta_x*vartheta_y - vartheta_z)
    C[3, 46] = k1*(-beta_x*vartheta_y - vartheta_z)
    C[3, 51] = -k1
    C[3, 60] = (R*k1)*(-beta_x*vartheta_z + vartheta_y)
    C[3, 61] = (R*beta_x*k1)*(beta_x*vartheta_y + vartheta_z)
    C[3, 62] = R*beta_x*k1
    C[3, 74] = (2.0*R*k1)*(beta_x*beta_z*vartheta_y + beta_z*vartheta_z + 1)
    C[3, 77] = (2.0*R*k1)*(beta_x*vartheta_y - beta_z + vartheta_z)
    C[3, 91] = (2.0*R*k1)*(beta_x*vartheta_y - beta_z + vartheta_z)
    C[3, 94] = (2.0*R*k1)*(-beta_x*beta_z*vartheta_y - beta_z*vartheta_z - 1)
    C[5, 9] = k1
    C[5, 16] = (R*beta_x*k1)*(-beta_z**2.0 - 1)
    C[5, 19] = -R*beta_x*k1
    C[5, 25] = beta_x*k1
    C[5, 30] = beta_x*beta_z*k1
    C[5, 36] = -R*beta_z*k1
    C[5, 39] = -R*k1
    C[5, 40] = -R*beta_x**2.0*k1
    C[5, 41] = -R*beta_x**2.0*beta_z*k1
    C[5, 46] = -beta_x*beta_z*k1
    C[5, 51] = beta_x*k1
    C[5, 59] = -R*k1
    C[5, 60] = R*beta_z*k1
    C[5, 61] = R*beta_x**2.0*beta_z*k1
    C[5, 62] = -R*beta_x**2.0*k1
    C[5, 74] = (R*beta_x*k1)*(beta_z**2.0 - 1)
    C[5, 77] = 2.0*R*beta_x*beta_z*k1
    C[5, 91] = 2.0*R*beta_x*beta_z*k1
    C[5, 94] = (R*beta_x*k1)*(1 - beta_z**2.0)
    C[6, 9] = -beta_x*k1
    C[6, 16] = (R*k1)*(-beta_z**2.0 - 1)
    C[6, 19] = R*beta_x**2.0*k1
    C[6, 25] = k1
    C[6, 30] = beta_z*k1
    C[6, 36] = R*beta_x*beta_z*k1
    C[6, 39] = R*beta_x*k1
    C[6, 40] = -R*beta_x*k1
    C[6, 41] = -R*beta_x*beta_z*k1
    C[6, 46] = -beta_z*k1
    C[6, 51] = k1
    C[6, 59] = R*beta_x*k1
    C[6, 60] = -R*beta_x*beta_z*k1
    C[6, 61] = R*beta_x*beta_z*k1
    C[6, 62] = -R*beta_x*k1
    C[6, 74] = (R*k1)*(beta_z**2.0 - 1)
    C[6, 77] = 2.0*R*beta_z*k1
    C[6, 91] = 2.0*R*beta_z*k1
    C[6, 94] = (R*k1)*(1 - beta_z**2.0)
    C[7, 20] = k1
    C[8, 0] = 0.5*k1
    C[8, 3] = 0.5*k1
    C[8, 10] = 0.5*R**2.0*k1
    C[8, 11] = 0.5*R**2.0*k1
    C[8, 17] = R**2.0*k1
    C[8, 22] = -R*k1
    C[8, 27] = R*k1
    C[8, 29] = 2.0*R*k1
    C[8, 43] = R*k1
    C[8, 45] = -2.0*R*k1
    C[8, 48] = R*k1
    C[8, 63] = -0.5*k1
    C[8, 67] = 0.5*k1
    C[8, 76] = 2.0*R**2.0*k1
    C[8, 81] = -k1
    C[8, 90] = 2.0*R**2.0*k1
    C[8, 96] = R*k1
    C[8, 99] = R*k1
    C[8, 105] = -R*k1
    C[8, 106] = R*k1
    C[8, 112] = -0.5*R**2.0*k1
    C[8, 114] = 0.5*R**2.0*k1
    C[8, 116] = R**2.0*k1
    C[9, 1] = -0.5*R*k1
    C[9, 5] = 0.5*R*k1
    C[9, 8] = -R*k1
    C[9, 26] = -k1
    C[9, 32] = 0.5*R**2.0*k1
    C[9, 35] = 0.5*R**2.0*k1
    C[9, 38] = R**2.0*k1
    C[9, 42] = k1
    C[9, 54] = 0.5*R**2.0*k1
    C[9, 55] = -0.5*R**2.0*k1
    C[9, 58] = R**2.0*k1
    C[9, 65] = 0.5*R*k1
    C[9, 69] = 0.5*R*k1
    C[9, 71] = -R*k1
    C[9, 83] = -0.5*R*k1
    C[9, 85] = 0.5*R*k1
    C[9, 87] = -R*k1
    C[9, 100] = -0.5*R**2.0*k1
    C[9, 103] = 0.5*R**2.0*k1
    C[9, 109] = 0.5*R**2.0*k1
    C[9, 110] = 0.5*R**2.0*k1
    C[10, 0] = 0.5*k1
    C[10, 3] = 0.5*k1
    C[10, 10] = 0.5*R**2.0*k1
    C[10, 11] = 0.5*R**2.0*k1
    C[10, 14] = R**2.0*k1
    C[10, 22] = -R*k1
    C[10, 23] = -2.0*R*k1
    C[10, 27] = R*k1
    C[10, 43] = R*k1
    C[10, 48] = R*k1
    C[10, 49] = -2.0*R*k1
    C[10, 63] = 0.5*k1
    C[10, 67] = -0.5*k1
    C[10, 72] = 2.0*R**2.0*k1
    C[10, 81] = k1
    C[10, 92] = -2.0*R**2.0*k1
    C[10, 96] = -R*k1
    C[10, 99] = -R*k1
    C[10, 105] = R*k1
    C[10, 106] = -R*k1
    C[10, 112] = 0.5*R**2.0*k1
    C[10, 114] = -0.5*R**2.0*k1
    C[10, 116] = -R**2.0*k1
    C[11, 15] = -R**2.0*k1
    C[11, 24] = R*k1
    C[11, 28] = -R*k1
    C[11, 44] = R*k1
    C[11, 50] = R*k1
    C[11, 64] = k1
    C[11, 73] = -R**2.0*k1
    C[11, 75] = -R**2.0*k1
    C[11, 80] = -0.5*k1
    C[11, 84] = 0.5*k1
    C[11, 89] = -R**2.0*k1
    C[11, 93] = R**2.0*k1
    C[11, 97] = R*k1
    C[11, 98] = -R*k1
    C[11, 104] = R*k1
    C[11, 107] = R*k1
    C[11, 113] = -R**2.0*k1
    C[11, 115] = -0.5*R**2.0*k1
    C[11, 117] = 0.5*R**2.0*k1
    C[12, 6] = k1
    C[12, 12] = 0.5*R**2.0*k1
    C[12, 13] = 0.5*R**2.0*k1
    C[12, 31] = -2.0*R*k1
    C[12, 52] = -2.0*R*k1
    C[12, 78] = -0.5*R**2.0*k1
    C[12, 79] = 0.5*R**2.0*k1
    C[12, 95] = R**2.0*k1
    C[13, 2] = 0.5*R*k1
    C[13, 4] = 0.5*R*k1
    C[13, 7] = R*k1
    C[13, 21] = -k1
    C[13, 33] = -0.5*R**2.0*k1
    C[13, 34] = 0.5*R**2.0*k1
    C[13, 37] = -R**2.0*k1
    C[13, 47] = -k1
    C[13, 53] = 0.5*R**2.0*k1
    C[13, 56] = 0.5*R**2.0*k1
    C[13, 57] = -R**2.0*k1
    C[13, 66] = 0.5*R*k1
    C[13, 68] = -0.5*R*k1
    C[13, 70] = R*k1
    C[13, 82] = 0.5*R*k1
    C[13, 86] = 0.5*R*k1
    C[13, 88] = -R*k1
    C[13, 101] = -0.5*R**2.0*k1
    C[13, 102] = -0.5*R**2.0*k1
    C[13, 108] = -0.5*R**2.0*k1
    C[13, 111] = 0.5*R**2.0*k1
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
        for n in range(1, 5):
            slope = n * (A[2 * n] * np.cos(n * phi) - A[2 * n - 1] * np.sin(n * phi))
            J[1] += 2.0 * np.pi * t * slope
    return J
