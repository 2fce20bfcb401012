"""Unrecorded vibration, whose squares do not average to zero."""

from __future__ import annotations

import sympy as sp

from derive.context import Context
from derive.effect import Effect, Values, shared_components
from derive.stages import Motion, SensedForce, misalignment_matrix
from derive.symbols import COMPONENTS, symmetric


def rectified(P: sp.Matrix, c: Context) -> sp.Expr:
    """Mean of the second-order terms of Eq. 1 over a force of covariance P (3 x 3, measurement frame), m/s^2."""
    assert c.geometry is not None
    k = c.parameters
    axes = misalignment_matrix(k["vartheta_x"], k["vartheta_y"], k["vartheta_z"]) * c.geometry.tau
    axes = sp.Matrix(3, 3, lambda m, n: c.tape.let(f"vibration_axis_{'iop'[m]}{'xyz'[n]}", axes[m, n]))
    seen = axes * c.in_disc_frame(P) * axes.T
    # Mean of Eq. 1 over force with the covariance ``seen`` along i, o, p: only second powers survive.
    return (
        k["K2"] * seen[0, 0]
        + k["K5"] * seen[1, 1]
        + k["K7"] * seen[2, 2]
        + k["K4"] * seen[0, 2]
        + k["K6"] * seen[0, 1]
        + k["K8"] * seen[1, 2]
    )


def vibration_rectification(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    P = symmetric(p, "P")
    return i + rectified(P, c)


VIBRATION_RECTIFICATION = Effect(
    id="vibration-rectification",
    title="Rectified vibration",
    physics=(
        "Vibration above the recorder's bandwidth averages to zero in the linear terms, but its squares and products in the second-order "
        "terms leave a steady force that turns with the disc."
    ),
    source="IEEE Std 1293, vibration rectification, with the second-order terms of paper, Eq. 1",
    equation=(
        r"I_j/K_{j1} \mathrel{+}= K_2 P_{ii} + K_5 P_{oo} + K_7 P_{pp} + K_4 P_{ip} + K_6 P_{io}"
        r" + K_8 P_{op},\; P_{ab} = \bm\tau_a^T \bm P \bm\tau_b"
    ),
    limits=(
        "Covariance constant over the record (else vibration-level), zero mean, fast against the turn of the disc; exact for Eq. 1, "
        "rectification by third-order terms is neglected. P must be positive semidefinite."
    ),
    parameters=shared_components("P", COMPONENTS, "g^2", "covariance {k} of the unrecorded vibration", 1e-4),
    transducer=vibration_rectification,
)


def vibration_level(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
    level = c.channel("vibration_rms")
    L = symmetric(p, "L")
    return i + level**2 * rectified(L, c)


VIBRATION_LEVEL = Effect(
    id="vibration-level",
    title="Rectified vibration of a recorded level",
    physics=(
        "Vibration above the recorder's bandwidth varies with engine power and air; its level is recorded, and second-order coefficients "
        "rectify it into a force that follows the square of that level."
    ),
    source="IEEE Std 1293, vibration rectification; a vibration meter's root mean square",
    equation=r"\bm P(t) = \bm L\, v(t)^2, \text{ in the place of the constant } \bm P \text{ of vibration-rectification}",
    limits=(
        "As vibration-rectification; the vibration keeps its directions and shares while its level changes. What is constant is "
        "vibration-rectification."
    ),
    channels=("vibration_rms",),
    parameters=shared_components("L", COMPONENTS, "1", "covariance {k} over the square of the level", 1.0),
    transducer=vibration_level,
)


def angular_jitter(m: Motion, p: Values, c: Context) -> Motion:
    W = symmetric(p, "W")
    # the mean of w x (w x r) is (W - tr W) r, and M holds -Gamma
    return m._replace(Gamma=m.Gamma - c.channel("angular_vibration_rms") ** 2 * (W - W.trace() * sp.eye(3)))


ANGULAR_JITTER = Effect(
    id="angular-jitter",
    title="Unrecorded angular jitter",
    physics=(
        "Angular vibration faster than the recorded rate averages to zero, but its squares do not: the centrifugal force of the jitter "
        "is a gradient that grows with the square of its level."
    ),
    source="paper, Eq. 9: the square of the angular rate; levels of 1e-4 rad/s, 10 Eo, on stabilised platforms",
    equation=r"\langle[\bm\omega]_\times^2\rangle \mathrel{+}= (\bm W - \operatorname{tr}\bm W)\, w(t)^2",
    limits=(
        "Zero mean, fast against the turn of the disc, with constant directions; the level is recorded. A level that does not change "
        "looks like gradient-offset."
    ),
    channels=("angular_vibration_rms",),
    parameters=shared_components(
        "W", COMPONENTS, "1", "covariance {k} of the rate over the square of the level", 1.0
    ),
    sensing=angular_jitter,
)
