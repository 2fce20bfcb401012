"""Errata of the paper's text, and slips of notation."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass

from derive.audit.experiment import EOTVOS
from derive.audit.numbers import ANGLE, T_D
from derive.audit.printed import ANALYTICAL, MOTION, PRINTED, SIMPLIFIED, TRANSDUCER, Equation


@dataclass(frozen=True)
class Remark:
    """A slip of the text: where, what is printed, what is right, and why."""

    where: str
    printed: str
    right: str
    why: str


def slips() -> tuple[Remark, ...]:
    """Slips of notation, counted in the printed equations: they change no term."""

    def count(pattern: str, equations: Iterable[Equation] = PRINTED) -> int:
        return sum(len(re.findall(pattern, t)) for e in equations for t in e.terms)

    unused = [n for n in ("S_3", "S_5") if not count(re.escape(n), ANALYTICAL)]
    return (
        Remark(
            "Eq. 5b",
            f"{count(r'vartheta_[xyz]|K_[0-9]', TRANSDUCER)} symbols without their subscript $j$"
            r" ($\vartheta_x$, $K_7$, $K_4$ ...)",
            r"$\vartheta_{jx}$, $K_{j7}$, $K_{j4}$ ...",
            "they belong to accelerometer $A_j$ like all others; so read, all terms come out",
        ),
        Remark(
            "Eq. 16",
            f"$T_{{xx}}$, $T_{{xy}}$ ... {count(r'T_{[xyz]', MOTION)} times",
            r"$\Gamma_{xx}$, $\Gamma_{xy}$ ... (Eq. 14)",
            "with this reading all of Eq. 16 comes out (above)",
        ),
        Remark(
            "Eq. 16, 19",
            rf"$\omega_{{i\max}}$, {count(r'omega_{i.max}')} times",
            r"$\omega_{imax}$, the angular acceleration about x (Eq. 13)",
            r"an equation editor took the letters for the function $\max$",
        ),
        Remark(
            "Eq. 18-47",
            rf"subscripts $X, Y, Z$ of $\beta$, $\vartheta$, $\theta$ in capitals,"
            f" {count(r'(?:beta|theta)_[XYZ]')} times",
            "$x, y, z$",
            f"{count(r'(?:beta|theta)_[xyz]', ANALYTICAL + SIMPLIFIED)} times they are small,"
            " often in the same term",
        ),
        Remark(
            "Eq. 16",
            f"${'$, $'.join(unused)}$ are defined",
            "not needed",
            "no equation uses them; $S_3 = T_5 - T_1$ and $S_5 = T_2 + T_6$",
        ),
        Remark(
            "Eq. 19, 45, 47",
            r"$\theta_y$ beside $\vartheta_y k_1$",
            r"$\theta_y = k_1 \vartheta_y$, $\theta_z = k_1 \vartheta_z$ (Eq. 6a)",
            "two notations for one quantity, mixed within equations (and once confused: see the errata)",
        ),
    )


def remarks() -> tuple[Remark, ...]:
    """Errata of the text."""
    return (*_of_the_derivation(), *_of_the_simplification(), *_of_the_experiments())


def _of_the_derivation() -> tuple[Remark, ...]:
    """Section II.A."""
    miss = input_axis_miss(ANGLE, ANGLE, "yz")
    return (
        Remark(
            "Section II.A.1",
            r"rotating the measurement frame by $-\vartheta_{jy}$ about y, *then* by $-\vartheta_{jz}$"
            " about z brings the input axis onto $x_1$",
            r"by $-\vartheta_{jz}$ about z, then by $-\vartheta_{jy}$ about y",
            "C turns about x, y, z in this order (Eq. 5b, above), so it is undone from the last. With angles"
            f" of 1e-4 rad the order printed misses $x_1$ by {miss:.2g} rad: harmless",
        ),
        Remark(
            "Eq. 1",
            "$f_{jP}$",
            "$f_{jp}$",
            "the pendulous axis, as in the terms beside it",
        ),
        Remark(
            "below Eq. 5b",
            r"the misalignment angles $\vartheta_{jz}$, $\vartheta_{jy}$, $\vartheta_{jz}$",
            r"$\vartheta_{jx}$, $\vartheta_{jy}$, $\vartheta_{jz}$",
            "three angles are meant",
        ),
        Remark(
            "Eq. 8",
            r"$d\mathbf r^2/dt$, $d\mathbf r^2/dt^2$",
            r"$d^2\mathbf r/dt^2$",
            "second derivative of the position; the first one also lacks the square of dt",
        ),
        Remark(
            "below Eq. 16, Section II.B",
            r"$S_1 \sim S_6$",
            r"$S_1 \sim S_5$",
            f"Eq. 16 defines {sum(e.left.startswith('S') for e in MOTION)} of them; there is no $S_6$",
        ),
        Remark(
            "below Eq. 19",
            r"$D^{12}_{k1R}=k_{11}R_1-k_{22}R_2$",
            r"$D^{12}_{k1R}=k_{11}R_1-k_{21}R_2$",
            "the first subscript is the accelerometer, the second the parameter: $k_{22}$ is $A_2$'s"
            " second-order coefficient, of another unit. With $k_{21}$ the exact check comes out",
        ),
    )


def _of_the_simplification() -> tuple[Remark, ...]:
    """Section II.B."""
    return (
        Remark(
            "Section II.B.1 a)",
            r"$\sum_{k_jR^2}T_{n_1}T_{n_2}$, $D^{*}_{k_jR^2}T_{n_1}T_{n_2}$",
            r"$\sum_{k_pR^2}T_{n_1}T_{n_2}$, $D^{*}_{k_pR^2}T_{n_1}T_{n_2}$",
            "the subscript is the parameter p = 2, 4 ... 8, not the accelerometer",
        ),
        Remark(
            "below Eq. 36",
            "$A_{\\Omega critical}$ = 0.0945 rad/s = 5.42 deg/h",
            "5.42 deg/s",
            f"0.0945 rad/s is {math.degrees(0.0945):.2f} deg/s, or {math.degrees(0.0945) * 3600:.0f} deg/h",
        ),
        Remark(
            "below Eq. 37",
            "$K_{jp}=10^{-6}$ g",
            "$10^{-6}$ g/g$^2$",
            "unit of a second-order coefficient",
        ),
        Remark(
            "below Eq. 38",
            r"$(T_n)_{critical}=4\times10^7$ Eo",
            r"$4\times10^6$ Eo",
            f"0.1 Eo / (0.25 x 1e-6 g/g$^2$ x 0.1 g) = {T_D / EOTVOS / 1e6:.3g}e6 Eo: a factor of ten,"
            " with consequences for the simplified model (above)",
        ),
    )


def _of_the_experiments() -> tuple[Remark, ...]:
    """Section II.C, the experiments and the abstract."""
    doubled = 6.674e-11 * 486 / 1.2**2
    return (
        Remark(
            "Section II.C, after Eq. 53",
            r"inline channel $\Gamma_{xx}-\Gamma_{xy}$ (five times)",
            r"$\Gamma_{xx}-\Gamma_{yy}$",
            r"the inline channel is $2T_1 = \Gamma_{xx}-\Gamma_{yy}+\omega_{imy}^2-\omega_{imx}^2$"
            " (Eq. 16, confirmed)",
        ),
        Remark(
            "Eq. 49",
            r"$\mathbf f_{cmm}$ of Eq. 11 plus the whole attraction of the test mass at $A_j$",
            r"$\mathbf f_{cmm}$ without the test mass",
            r"$\mathbf f_{cmm}$ of Eq. 11 already holds $-\mathbf a_{gm}$, the attraction at the centre: it"
            f" would count twice ({doubled:.3g} m/s$^2$ for 486 kg at 1.2 m; common to the four, so a perfect"
            " instrument does not see it)",
        ),
        Remark(
            "Section III.A, Table V",
            "$k_{j0}$ in ug, $k_{j1}$ in mA/g, $k_{jp}$ in ug/g$^2$",
            "$K_{j0}$, $K_{j1}$, $K_{jp}$",
            "by Eq. 6a small $k$ are in V, V/g and V/g$^2$; so read, $k_{ggi}$ comes out (above)",
        ),
        Remark(
            "Abstract",
            r"the *mean* of air turbulence is in the range of 70 $\sim$ 230 mg",
            "the turbulence is in that range",
            "the means are 100 and 200 mg (Table VII); 70 and 230 mg are the means less and plus three"
            " standard deviations",
        ),
    )


def input_axis_miss(y: float, z: float, undone: str) -> float:
    """Angle (rad) between the input axis and x_1 after undoing C about ``undone``'s axes, first one first.

    C turns the frame by ``y`` about its y-axis, then by ``z`` about its z-axis (the turn about x before them
    leaves x_1 alone).
    """

    def turn(axis: int, angle: float, v: list[float]) -> list[float]:
        i, k = (axis + 1) % 3, (axis + 2) % 3
        w = list(v)
        w[i] = math.cos(angle) * v[i] - math.sin(angle) * v[k]
        w[k] = math.sin(angle) * v[i] + math.cos(angle) * v[k]
        return w

    angles = {"y": y, "z": z}
    turns = [(1, y), (2, z), *(("xyz".index(k), -angles[k]) for k in undone)]
    axis = [1.0, 0.0, 0.0]
    for about, angle in reversed(turns):  # from the frame's own coordinates back to the nominal ones
        axis = turn(about, angle, axis)
    return math.hypot(axis[1], axis[2])
