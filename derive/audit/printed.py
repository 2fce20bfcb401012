"""The printed equations of the paper, as data for the audit alone: nothing else may import this.

Verbatim LaTeX, misprints included (theta against vartheta, T_ij against Gamma_ij, subscripts without
their j, upper against lower case). Only spacing, line breaks, alignment and braces without meaning are
taken out, and every equation is cut into its top-level terms, each with its sign. An equation is known
by the number in its label in the paper's source: 5b, 16, 18, 19, 43, 45 (A^s and A^c of the spin rate),
47 (A_0 of the simplified model).
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Equation:
    """One printed equation: its number, its left side and the terms of its right side, as LaTeX."""

    number: str
    left: str
    terms: tuple[str, ...]


TRANSDUCER: tuple[Equation, ...] = (
    Equation(
        "5b",
        r"\vartheta_{jz}^*",
        (r"(\vartheta_{jz}+\vartheta_{jx}\vartheta_{jy})",),
    ),
    Equation(
        "5b",
        r"\vartheta_{jy}^*",
        (
            r"\vartheta_{jy}",
            r"-\vartheta_{jx}\vartheta_{jz}",
        ),
    ),
    Equation(
        "5b",
        r"K_{j2}^*",
        (
            r"K_{j2}",
            r"+K_{j4}\vartheta_{jy}",
            r"-K_{j6}\vartheta_{jz}",
            r"+K_{j7}\vartheta_{jy}^2",
            r"-K_{j8}\vartheta_{jy}\vartheta_{jz}",
            r"+K_{j5}\vartheta_{jz}^2",
        ),
    ),
    Equation(
        "5b",
        r"K_{j4}^*",
        (
            r"(1-\vartheta_{jy}^2+\vartheta_{jx}\vartheta_{jy}\vartheta_{jz})K_{j4}",
            r"+2(\vartheta_{jx}\vartheta_{jz}-\vartheta_{jy})K_{j2}",
            r"-2(\vartheta_{jy}\vartheta_{jz}^2+\vartheta_{jx}\vartheta_{jz})K_{j5}",
            r"+(\vartheta_{jx}+2\vartheta_{jy}\vartheta_{jz}-\vartheta_{jx}\vartheta_{jz}^2)K_{j6}",
            r"+2\vartheta_{jy}K_{j7}",
            r"+(\vartheta_{jy}^2\vartheta_{jz}+\vartheta_{jx}\vartheta_{jy}-\vartheta_{jz})K_{j8}",
        ),
    ),
    Equation(
        "5b",
        r"K_{j5}^*",
        (
            r"K_{j5}(1-2\vartheta_{jx}\vartheta_{jy}\vartheta_{jz}"
            r"+\vartheta_{jx}^2\vartheta_{jy}^2\vartheta_{jz}^2)",
            r"-K_{j8}(\vartheta_{jx}-\vartheta_{jx}^2\vartheta_{jy}\vartheta_{jz})",
            r"+K_{j7}\vartheta_{jx}^2",
            r"-K_{j4}(\vartheta_{jx}\vartheta_{jz}+\vartheta_{jx}^2\vartheta_{jy})",
            r"+K_{j2}(2\vartheta_{jx}\vartheta_{jy}\vartheta_{jz}+\vartheta_{jz}^2"
            r"+\vartheta_{jx}^2\vartheta_{jy}^2)",
            r"+K_{j6}(\vartheta_{jz}+\vartheta_{jx}\vartheta_{jy}"
            r"-\vartheta_{jx}\vartheta_{jy}\vartheta_{jz}^2-\vartheta_{jx}^2\vartheta_{jy}^2\vartheta_{jz})",
        ),
    ),
    Equation(
        "5b",
        r"K_{j6}^*",
        (
            r"(1-\vartheta_{jz}^2-2\vartheta_{jx}\vartheta_{jy}\vartheta_{jz})K_{j6}",
            r"+(2\vartheta_{jz}+2\vartheta_{jx}\vartheta_{jy})K_{j2}",
            r"+(\vartheta_{jx}\vartheta_{jy}^2+\vartheta_{jy}\vartheta_{jz}-\vartheta_{jx})K_{j4}",
            r"-2\vartheta_x \vartheta_y K_7",
            r"+(2\vartheta_x \vartheta_y \vartheta_z^2-2\vartheta_z)K_5",
            r"+(\vartheta_y+\vartheta_x \vartheta_z-\vartheta_x \vartheta_y^2\vartheta_z)K_8",
        ),
    ),
    Equation(
        "5b",
        r"K_{j7}^*",
        (
            r"K_{j7}",
            r"+(\vartheta_{jx}^2\vartheta_{jz}^2-2\vartheta_{jx}\vartheta_{jy}\vartheta_{jz}"
            r"+\vartheta_{jy}^2)K_{j2}",
            r"+(\vartheta_{jx}\vartheta_{jz}-\vartheta_{jy})K_{j4}",
            r"+(\vartheta_{jx}^2\vartheta_{jz}+\vartheta_{jx}\vartheta_{jy}\vartheta_{jz}^2"
            r"-\vartheta_{jx}\vartheta_{jy}-\vartheta_{jy}^2\vartheta_{jz})K_{j6}",
            r"+(\vartheta_{jx}^2+2\vartheta_{jx}\vartheta_{jy}\vartheta_{jz}"
            r"+\vartheta_{jy}^2\vartheta_{jz}^2)K_{j5}",
            r"+(\vartheta_{jx}+\vartheta_{jy}\vartheta_{jz})K_{j8}",
        ),
    ),
    Equation(
        "5b",
        r"K_{j8}^*",
        (
            r"(1-\vartheta_{jx}^2-2\vartheta_{jx}\vartheta_{jy}\vartheta_{jz})K_{j8}",
            r"+2(\vartheta_{jx}\vartheta_{jz}^2-\vartheta_{jx}\vartheta_{jy}^2"
            r"-\vartheta_{jy}\vartheta_{jz}+\vartheta_{jx}^2\vartheta_{jy}\vartheta_{jz})K_{j2}",
            r"+(\vartheta_{jz}+2\vartheta_{jx}\vartheta_{jy}-\vartheta_{jz}\vartheta_{jx}^2)K_4",
            r"-2\vartheta_{jx}K_{j7}",
            r"+(2\vartheta_{jx}+2\vartheta_{jy}\vartheta_{jz}"
            r"-2\vartheta_{jx}^2\vartheta_{jy}\vartheta_{jz}-2\vartheta_{jx}\vartheta_{jy}^2\vartheta_{jz}^2)K_{j5}",
            r"+(\vartheta_{jx}^2\vartheta_{jy}-\vartheta_{jx}^2\vartheta_{jy}\vartheta_{jz}^2"
            r"+2\vartheta_{jx}\vartheta_{jz}\vartheta_{jy}^2+2\vartheta_{jx}\vartheta_{jz}+\vartheta_{jy}\vartheta_{jz}^2-\vartheta_{jy})K_{j6}",
        ),
    ),
)
"""Eq. 5b: coefficients of Eq. 5a, the transducer with the misalignment written out."""

MOTION: tuple[Equation, ...] = (
    Equation(
        "16",
        r"T_1",
        (r"0.5(T_{xx}-T_{yy}+\omega_{imy}^2-\omega_{imx}^2)",),
    ),
    Equation(
        "16",
        r"T_2",
        (
            r"-T_{xy}",
            r"+\omega_{imx}\omega_{imy}",
        ),
    ),
    Equation(
        "16",
        r"T_3",
        (r"(T_{yz}-\omega_{imy}\omega_{imz}-\omega_{i\max})",),
    ),
    Equation(
        "16",
        r"T_4",
        (r"(T_{xz}-\omega_{imx}\omega_{imz}+\omega_{imay})",),
    ),
    Equation(
        "16",
        r"T_5",
        (r"0.5(T_{xx}+T_{yy}+\omega_{im}^2+\omega_{imz}^2)",),
    ),
    Equation(
        "16",
        r"T_6",
        (r"\omega_{imaz}",),
    ),
    Equation(
        "16",
        r"S_1",
        (
            r"T_{xz}",
            r"-\omega_{imx}\omega_{imz}",
            r"-\omega_{imay}",
        ),
    ),
    Equation(
        "16",
        r"S_2",
        (
            r"T_{yz}",
            r"-\omega_{imy}\omega_{imz}",
            r"+\omega_{i\max}",
        ),
    ),
    Equation(
        "16",
        r"S_3",
        (
            r"\omega_{imx}^2",
            r"+\omega_{imz}^2",
            r"+T_{yy}",
        ),
    ),
    Equation(
        "16",
        r"S_4",
        (
            r"\omega_{imx}^2",
            r"+\omega_{imy}^2",
            r"+T_{zz}",
        ),
    ),
    Equation(
        "16",
        r"S_5",
        (
            r"-T_{xy}",
            r"+\omega_{imx}\omega_{imy}",
            r"+\omega_{imaz}",
        ),
    ),
)
"""Eq. 16: the angular motion and the gradients, gathered."""

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

PRINTED: tuple[Equation, ...] = TRANSDUCER + MOTION + ANALYTICAL + SIMPLIFIED
