"""Eq. 18 and 19: the analytical model."""

from __future__ import annotations

from derive.audit.printed.equation import Equation

ANALYTICAL: tuple[Equation, ...] = (
    Equation(
        "18",
        r"A_{4\Omega}^c",
        (
            r"0.5D_{(k_5-k_2)R^2}^{1234}(T_1^2-T_2^2)",
            r"-D_{k_6 R^2}^{1234}T_1 T_2",
        ),
    ),
    Equation(
        "18",
        r"A_{4\Omega}^s",
        (
            r"-D_{(k_5-k_2)R^2}^{1234}T_1 T_2",
            r"-0.5D_{k_6 R^2}^{1234}(T_1^2-T_2^2)",
        ),
    ),
    Equation(
        "18",
        r"A_{3\Omega}^s",
        (
            r"0.5(T_1 T_4+T_2 T_3)D_{k_4 R^2,k_8 R^2}^{12,34}",
            r"+0.5(T_1 T_3-T_2 T_4)D_{-k_8 R^2,k_4 R^2}^{12,34}",
            r"-(T_2 a_x-T_1 a_y)D_{(k_2-k_5)R,k_6 R}^{12,34}",
            r"+(T_1 a_x+T_2 a_y)D_{k_6 R,(k_5-k_2)R}^{12,34}",
        ),
    ),
    Equation(
        "18",
        r"A_{3\Omega}^c",
        (
            r"0.5(T_1 T_4+T_2 T_3)D_{-k_8 R^2,k_4 R^2}^{12,34}",
            r"-0.5(T_1 T_3-T_2 T_4)D_{k_4 R^2,k_8 R^2}^{12,34}",
            r"+(T_2 a_x-T_1 a_y)D_{k_6 R,(k_5-k_2)R}^{12,34}",
            r"+(T_1 a_x+T_2 a_y)D_{(k_2-k_5)R,k_6 R}^{12,34}",
        ),
    ),
    Equation(
        "18",
        r"A_{2\Omega}^s",
        (
            r"T_1(\sum_{k_1 R}+2\sum_{(\beta_z \theta_z+\beta_x \beta_z \theta_y)R})",
            r"+2T_1 T_6 \sum_{k_2 R^2}",
            r"-T_1 T_5 \sum_{k_6 R^2}",
            r"-T_1 a_z \sum_{k_4 R}",
            r"+T_2 \sum_{(\vartheta_Z-2\beta_Z+\beta_x \vartheta_y)k_1 R}",
            r"-2T_2 T_5 \sum_{k_5 R^2}",
            r"+T_2 T_6 \sum_{k_6 R^2}",
            r"-a_z T_2 \sum_{k_8 R}",
            r"+T_3(0.5a_x \sum_{k_8 R}+0.5a_y \sum_{k_4 R})",
            r"+\sum_{k_7 R^2}T_3 T_4",
            r"-T_4(0.5a_x \sum_{k_4 R}-0.5a_y \sum_{k_8 R})",
            r"+a_x a_y \sum_{k_5-k_2}",
            r"-0.5\sum_{k_6}(a_x^2-a_y^2)",
        ),
    ),
    Equation(
        "18",
        r"A_{2\Omega}^c",
        (
            r"T_2(\sum_{k_1 R}+2\sum_{(\beta_z \theta_z+\beta_x \beta_z \theta_y)R})",
            r"+2T_2 T_6 \sum_{k_2 R^2}",
            r"-T_2 T_5 \sum_{k_6 R^2}",
            r"-T_2 a_z \sum_{k_4 R}",
            r"-T_1 \sum_{(\vartheta_Z-2\beta_Z+\beta_x \vartheta_y)k_1 R}",
            r"+2T_1 T_5 \sum_{k_5 R^2}",
            r"-T_1 T_6 \sum_{k_6 R^2}",
            r"+T_1 a_z \sum_{k_8 R}",
            r"+T_3(0.5a_x \sum_{k_4 R}-0.5a_y \sum_{k_8 R})",
            r"+a_x a_y \sum_{k_6}",
            r"+T_4(0.5a_x \sum_{k_8 R}+0.5a_y \sum_{k_4 R})",
            r"+0.5(a_x^2-a_y^2)\sum_{k_5-k_2}",
            r"+0.5(T_4^2-T_3^2)\sum_{k_7 R^2}",
        ),
    ),
    Equation(
        "19",
        r"A_\Omega^s",
        (
            r"S_1 D_{(\beta_X+\beta_X^2\beta_Z \vartheta_Y)k_1 R,(\beta_X \beta_Z"
            r"-\beta_X^2\vartheta_Y)k_1 R}^{12,34}",
            r"+S_2 D_{(\beta_X \beta_Z-\beta_X^2\vartheta_Y)k_1 R,-(\beta_X"
            r"+\beta_X^2\beta_Z \theta_Y)k_1 R}^{12,34}",
            r"-D_{k_8,k_4}^{12,34}a_y a_z",
            r"+a_x D_{-(1+\beta_z \vartheta_z+\beta_X \beta_Z \vartheta_Y)k_1,(\vartheta_Z-\beta_Z"
            r"+\beta_X \vartheta_Y)k_1}^{12,34}",
            r"-D_{(k_2+k_5)R}^{34}T_1 a_x",
            r"+D_{(k_5+k_2)R}^{12}T_2 a_x",
            r"+D_{k_6 R,-2k_5 R}^{12,34}T_5 a_x",
            r"+D_{-2k_2 R,k_6 R}^{12,34}T_6 a_x",
            r"+a_y D_{(\vartheta_z-\beta_z+\beta_X \vartheta_Y)k_1,(1+\beta_z \vartheta_z"
            r"+\beta_X \beta_Z \vartheta_Y)k_1}^{12,34}",
            r"+D_{(k_2+k_5)R}^{12}T_1 a_y",
            r"+D_{(k_5+k_2)R}^{34}T_2 a_y",
            r"-D_{2k_5 R,k_6 R}^{12,34}T_5 a_y",
            r"+D_{k_6 R,2k_2 R}^{12,34}T_6 a_y",
            r"-(2D_{k_7 R}^{12}T_3+2D_{k_7 R}^{34}T_4)a_z",
            r"+D_{k_4,-k_8}^{12,34}a_x a_z",
            r"-2D_{\beta_X \theta_Z R,\beta_X \beta_Z \theta_Z R}^{12,34}\omega_{i\max}",
            r"+2D_{-\beta_X \beta_Z \theta_Z R,\beta_X \theta_Z R}^{12,34}\omega_{imay}",
            r"+D_{k_4 R^2}^{12}(0.5T_1 T_4-0.5T_2 T_3+T_3 T_6)",
            r"+D_{k_4 R^2}^{34}(0.5T_1 T_3+0.5T_2 T_4+T_4 T_6)",
            r"-D_{k_8 R^2}^{34}(0.5T_1 T_4-0.5T_2 T_3+T_4 T_5)",
            r"+D_{k_8 R^2}^{12}(0.5T_1 T_3+0.5T_2 T_4-T_3 T_5)",
            r"-D_{\theta_Y R,\beta_Z \theta_Y R}^{12,34}T_3",
            r"+D_{\beta_Z \theta_Y R,-\theta_Y R}^{12,34}T_4",
        ),
    ),
    Equation(
        "19",
        r"A_\Omega^c",
        (
            r"S_1 D_{(\beta_X \beta_Z-\beta_X^2\vartheta_y)k_1 R,-(\beta_X"
            r"+\beta_X^2\beta_Z \vartheta_Y)k_1 R}^{12,34}",
            r"-S_2 D_{(\beta_X+\beta_X^2\beta_Z \vartheta_Y)k_1 R,(\beta_X \beta_Z"
            r"-\beta_X^2\vartheta_y)k_1 R}^{12,34}",
            r"-D_{k_8,k_4}^{12,34}a_x a_z",
            r"+a_x D_{(\vartheta_z-\beta_z+\beta_X \vartheta_Y)k_1,(1+\beta_z \vartheta_z"
            r"+\beta_X \beta_Z \vartheta_Y)k_1}^{12,34}",
            r"-D_{(k_2+k_5)R}^{12}T_1 a_x",
            r"-D_{(k_2+k_5)R}^{34}T_2 a_x",
            r"-D_{2k_5 R,k_6 R}^{12,34}T_5 a_x",
            r"+D_{k_6 R,2k_2 R}^{12,34}T_6 a_x",
            r"+a_y D_{(1+\beta_z \vartheta_z+\beta_X \beta_Z \vartheta_Y)k_1,-(\vartheta_z-\beta_z"
            r"+\beta_X \vartheta_Y)k_1}^{12,34}",
            r"-D_{(k_2+k_5)R}^{34}T_1 a_y",
            r"+D_{(k_2+k_5)R}^{12}T_2 a_y",
            r"+D_{-k_6 R,2k_5 R}^{12,34}T_5 a_y",
            r"+D_{2k_2 R,-k_6 R}^{12,34}T_6 a_y",
            r"+(2D_{k_7 R}^{34}T_3-2D_{k_7 R}^{12}T_4)a_z",
            r"+D_{-k_4,k_8}^{12,34}a_y a_z",
            r"+2D_{-\beta_X \beta_Z \theta_Z R,\beta_X \theta_Z R}^{12,34}\omega_{i\max}",
            r"+2D_{\beta_X \theta_Z R,\beta_X \beta_Z \theta_Z R}^{12,34}\omega_{imay}",
            r"+D_{k_4 R^2}^{12}(0.5T_1 T_3+0.5T_2 T_4+T_4 T_6)",
            r"-D_{k_8 R^2}^{12}(0.5T_1 T_4-0.5T_2 T_3+T_4 T_5)",
            r"-D_{k_4 R^2}^{34}(0.5T_1 T_4-0.5T_2 T_3+T_3 T_6)",
            r"-D_{k_8 R^2}^{34}(0.5T_1 T_3+0.5T_2 T_4-T_3 T_5)",
            r"-D_{\theta_Y R,\beta_Z \theta_Y R}^{12,34}T_4",
            r"-D_{\beta_Z \theta_Y R,-\theta_Y R}^{12,34}T_3",
        ),
    ),
    Equation(
        "19",
        r"A_0",
        (
            r"0.5D_{k_2+k_5}^{1234}(a_x^2+a_y^2)",
            r"+0.5(D_{k_8 R}^{1234}T_4-D_{k_4 R}^{1234}T_3)a_x",
            r"+0.5(D_{k_4 R}^{1234}T_4+D_{k_8 R}^{1234}T_3)a_y",
            r"+(D_{\theta_Y-\beta_X \theta_Z}^{1234}-D_{k_4 R}^{1234}T_6+D_{k_8 R}^{1234}T_5)a_z",
            r"+D_{k_7}^{1234}a_z^2",
            r"+0.5D_{2\beta_X \beta_X \theta_Z R+\theta_y \beta_x R}^{1234}S_4",
            r"-D_{\beta_X \theta_Y R}^{1234}\omega_{im}^2",
            r"+D_{k_2 R^2}^{1234}(0.5T_1^2+0.5T_2^2+T_6^2)",
            r"+D_{k_5 R^2}^{1234}(0.5T_1^2+0.5T_2^2+T_5^2)",
            r"+0.5D_{k_7 R^2}^{1234}(T_3^2+T_4^2)",
            r"-D_{k_6 R^2}^{1234}T_5 T_6",
            r"-D_{\theta_Z R}^{1234}T_5",
            r"+D_{k_1 R}^{1234}T_6",
            r"+D_{k_0}^{1234}",
        ),
    ),
)
"""Eq. 18 and 19: the analytical model."""
