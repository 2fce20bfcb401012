"""Eq. 16: T and S, what the motion is on the disc."""

from __future__ import annotations

from derive.audit.printed.equation import Equation

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
