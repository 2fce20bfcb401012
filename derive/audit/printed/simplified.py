"""Eq. 43, 45 and 47: the simplified model."""

from __future__ import annotations

from derive.audit.printed.equation import Equation

SIMPLIFIED: tuple[Equation, ...] = (
    Equation(
        "43",
        r"A_{2\Omega}^s",
        (
            r"T_1 \sum_{k_1 R}",
            r"+T_2 \sum_{(\vartheta_Z-2\beta_Z)k_1 R}",
            r"+a_x a_y \sum_{k_5-k_2}",
            r"-0.5\sum_{k_6}(a_x^2-a_y^2)",
        ),
    ),
    Equation(
        "43",
        r"A_{2\Omega}^c",
        (
            r"-T_1 \sum_{(\vartheta_Z-2\beta_Z)k_1 R}",
            r"+T_2 \sum_{k_1 R}",
            r"+0.5(a_x^2-a_y^2)\sum_{k_5-k_2}",
            r"+a_x a_y \sum_{k_6}",
        ),
    ),
    Equation(
        "45",
        r"A_\Omega^s",
        (
            r"D_{-(1+\beta_z \vartheta_z)k_1,(\vartheta_Z-\beta_Z+\beta_X \vartheta_Y)k_1}^{12,34}a_x",
            r"+D_{(\vartheta_z-\beta_z+\beta_X \vartheta_Y)k_1,(1+\beta_z \vartheta_z)k_1}^{12,34}a_y",
            r"+D_{k_4,-k_8}^{12,34}a_x a_z",
            r"-D_{k_8,k_4}^{12,34}a_y a_z",
            r"-D_{\theta_Y R}^{12}T_3",
            r"-D_{\theta_Y R}^{34}T_4",
            r"+D_{\beta_X k_1 R}^{12}S_1",
            r"-D_{\beta_X k_1 R}^{34}S_2",
        ),
    ),
    Equation(
        "45",
        r"A_\Omega^c",
        (
            r"D_{(\vartheta_z-\beta_z+\beta_X \vartheta_Y)k_1,(1+\beta_z \vartheta_z)k_1}^{12,34}a_x",
            r"+D_{(1+\beta_z \vartheta_z)k_1,-(\vartheta_z-\beta_z+\beta_X \vartheta_Y)k_1}^{12,34}a_y",
            r"-D_{k_8,k_4}^{12,34}a_x a_z",
            r"+D_{-k_4,k_8}^{12,34}a_y a_z",
            r"-D_{\theta_Y R}^{12}T_4",
            r"+D_{\theta_Y R}^{34}T_3",
            r"-D_{\beta_X k_1 R}^{34}S_1",
            r"-D_{\beta_X k_1 R}^{12}S_2",
        ),
    ),
    Equation(
        "47",
        r"A_0",
        (
            r"0.5D_{k_2+k_5}^{1234}(a_x^2+a_y^2)",
            r"+D_{k_7}^{1234}a_z^2",
            r"+D_{\theta_Y-\beta_X \theta_Z}^{1234}a_z",
            r"-D_{\theta_Z R}^{1234}T_5",
            r"+D_{k_1 R}^{1234}T_6",
            r"+D_{k_0}^{1234}",
        ),
    ),
)
"""Eq. 43 to 47: the simplified analytical model."""
