"""What second-order coefficients make of unrecorded vibration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import sympy as sp

from derive.stages import misalignment_matrix

if TYPE_CHECKING:
    from derive.context import Context


def rectified(P: sp.Matrix, c: Context) -> sp.Expr:
    """Mean of the second-order terms of Eq. 1 over a force of covariance P (3 x 3, measurement frame), m/s^2."""
    k = c.parameters
    axes = misalignment_matrix(k["vartheta_x"], k["vartheta_y"], k["vartheta_z"]) * c.geometry.tau
    axes = c.tape.let_each("vibration_axis", axes, rows="iop")
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
