"""The paper's printed numbers that follow from its formulas, computed anew."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from derive.audit import experiment
from derive.audit.experiment import EOTVOS, G0


@dataclass(frozen=True)
class Number:
    """A printed number and the one computed, in the same unit."""

    where: str
    what: str
    printed: str
    computed: float
    unit: str

    @property
    def confirmed(self) -> bool:
        """Whether the printed number is the computed one, rounded to the digits printed."""
        mantissa, _, exponent = self.printed.partition("e")
        decimals = len(mantissa.partition(".")[2])
        last_digit = 10.0 ** (int(exponent or 0) - decimals)
        return abs(float(self.printed) - self.computed) <= 0.5000001 * last_digit


SPIN = 2 * math.pi * experiment.SPIN_FREQUENCY
SENSITIVITY = 0.1 * EOTVOS
"""s^-2: the error that Section II.B.1 allows a term."""
K, ANGLE, ARM, LINEAR = 1e-6, 1e-4, 0.1, 0.1
"""Sizes that Section II.B.1 assumes: K_p in g/g^2, angles in rad, R in m, acceleration in g."""

T_A = math.sqrt(4 * SENSITIVITY * G0 / (K * ARM))
"""Eq. 32 solved for T_n, s^-2."""
T_D = 4 * SENSITIVITY / (K * LINEAR)
"""Eq. 38 solved for T_n, s^-2."""


@dataclass(frozen=True)
class Critical:
    """Critical angular rate, angular acceleration, and amplitude at the spin rate (Eq. 36); radians, s."""

    omega: float
    omegadot: float
    amplitude: float


def critical(T: float, omega_squares: int = 2) -> Critical:
    """Eq. 33 and 36 for equal components, T in s^-2.

    T_5 = ``omega_squares`` omega^2 <= T gives omega, T_3 = omegadot + omega^2 <= T then omegadot. T_5 of
    Eq. 33 is 0.5 (1 + 1 + 2) omega^2 = 2 omega^2; the numbers printed follow from 4 omega^2.
    """
    omega = math.sqrt(T / omega_squares)
    omegadot = T - omega**2
    return Critical(omega, omegadot, min(omega, omegadot / SPIN))


@dataclass(frozen=True)
class Limit:
    """A critical value: as printed, as the print's own formula gives it, and as Eq. 33 gives it."""

    where: str
    what: str
    printed: str
    as_print_implies: float
    right: float
    unit: str

    @property
    def rounding(self) -> Number:
        return Number(self.where, self.what, self.printed, self.as_print_implies, self.unit)


def limits() -> tuple[Limit, ...]:
    """The critical values of Eq. 34 and 36 and of Tables I to III."""
    rows: list[Limit] = []
    degrees = math.degrees

    def add(where: str, printed: Mapping[str, str], T_printed: float, T_right: float) -> None:
        a, b = critical(T_printed, 4), critical(T_right, 2)
        for what, text in printed.items():
            unit = "deg/s^2" if what == "omegadot" else "deg/s"
            rows.append(Limit(where, what, text, degrees(getattr(a, what)), degrees(getattr(b, what)), unit))

    add("Eq. 34, 36", {"omega": "12.74", "omegadot": "8.51", "amplitude": "5.42"}, T_A, T_A)
    add("Table I", {"omega": "12.74", "omegadot": "8.51", "amplitude": "5.424"}, T_A, T_A)
    add("Table II", {"omega": "5.734", "omegadot": "1.72", "amplitude": "1.09"}, 4e7 * EOTVOS, T_D)
    for row, (omega, omegadot) in enumerate(
        (("0.0574", "1.71e-4"), ("5.734", "1.72"), ("5724", "1.72e4")), 1
    ):
        T = 4 * SENSITIVITY / ANGLE**row
        add(f"Table III, row {row}", {"omega": omega, "omegadot": omegadot}, T, T)
    return tuple(rows)


def numbers(largest_output: float) -> tuple[Number, ...]:
    """Other numbers; ``largest_output`` is the largest |G_out| of the dynamic experiment, V."""
    half_band = math.sqrt(0.2)
    arm = SENSITIVITY * ARM * 4
    rows = [
        Number("below Eq. 32", "critical T_n", "2e8", T_A / EOTVOS, "Eo"),
        Number("below Eq. 37", "critical a_n", "2e-3", math.sqrt(arm / (K * G0)), "g"),
        Number("below Eq. 37a", "critical a_n", "4e-8", arm / (1e-4 * G0), "g"),
        Number("below Eq. 38", "critical T_n", "4e7", T_D / EOTVOS, "Eo"),
        *(
            Number(
                "below Eq. 40", f"critical T_n, {n} angles", text, 4 * SENSITIVITY / ANGLE**n / EOTVOS, "Eo"
            )
            for n, text in enumerate(("4e3", "4e7", "4e11"), 1)
        ),
        *(
            Number("below Eq. 41", f"critical a_n, {n} angles", text, arm / (ANGLE**n * G0), "g")
            for n, text in enumerate(("4e-8", "4e-4", "4"), 1)
        ),
        Number("Section III.B", "k_ggi", "4.54e-4", experiment.scale_factor() * EOTVOS, "V/Eo"),
        Number("Section III.B", "largest output", "1e5", largest_output, "V"),
        *(
            Number(
                "Section III.C",
                f"noise density of sigma = {sigma} Eo",
                text,
                sigma / half_band,
                "Eo/sqrt(Hz)",
            )
            for sigma, text in ((0.06, "0.13"), (0.11, "0.25"), (0.294, "0.66"), (0.556, "1.24"))
        ),
        Number("Abstract", "least turbulence, 100 - 3 x 10", "70", 100 - 3 * 10, "mg"),
        Number("Abstract", "greatest turbulence, 200 + 3 x 10", "230", 200 + 3 * 10, "mg"),
    ]
    return tuple(rows)
