"""Eq. 5b: coefficients of the misaligned accelerometer."""

from __future__ import annotations

from derive.audit.printed.equation import Equation

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
