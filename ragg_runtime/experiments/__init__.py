"""The three experiments of the paper's Section III, repeated: its printed values (Tables VI to VIII) beside ours.

M. Yu and T. Cai, *Mathematic Model And Error Analysis of Moving-base Rotating Accelerometer Gravity Gradiometer*. The instrument of
Table V is ``ragg_runtime.reference.scenario.table_v``. Where the paper leaves an input open, our choice is stated.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ragg_runtime.wording.sections import make_environment

DEGREE_PER_HOUR = ARCSEC = np.pi / 180 / 3600


@dataclass(frozen=True)
class Printed:
    """A number as the paper prints it: its digits, ``unit`` (empty for a pure number), section or table; ``order``: of
    magnitude only.
    """

    text: str
    unit: str
    where: str
    order: bool = False

    @property
    def value(self) -> float:
        """The number."""
        return float(self.text)

    def matches(self, ours: float) -> bool:
        """Whether ``ours`` has the printed digits, or the printed order of magnitude (a third of it up to ten times)."""
        if self.order:
            ratio = ours / self.value
            return ratio > 0.0 and -0.5 <= math.log10(ratio) < 1.0
        mantissa, _, exponent = self.text.partition("e")
        decimals = len(mantissa.partition(".")[2])
        return abs(ours - self.value) <= 0.5000001 * 10.0 ** (int(exponent or 0) - decimals)


MASS = 486.0  # kg, Section III.A
MASS_POSITION = (1.2, 0.0, 0.0)  # m, at the start
# angular rate of the mass: mean and amplitude in deg/h, and the angular frequency of the sine in rad/s
MASS_RATE = (3600.0, 360.0, 0.0628)

TABLE_VI: Mapping[str, tuple[float, float]] = {
    "a_x": (0.08, 0.005),
    "a_y": (0.06, 0.006),
    "a_z": (0.1, 0.05),
    "omega_x": (1000, 700),
    "omega_y": (1500, 900),
    "omega_z": (2000, 800),
}
"""Constant and amplitude of sin(Omega t): g for a, deg/h for omega."""

# mean and standard deviation of a_z, mg, and of each angular rate, deg/h
TABLE_VII = ((100.0, 10.0, 0.0, 0.0), (100.0, 10.0, 100.0, 50.0), (200.0, 10.0, 100.0, 50.0))
HORIZONTAL = 0.15  # Section III.C: rms of a_x and of a_y over that of a_z

_VIII = """
        M_in    M_cs    Ms_in   Ms_cs  sigma_in  sigma_cs  sigmas_in  sigmas_cs
    1   -0.037  -0.0004 -0.080  0.033  0.062     0.031     0.11       0.052
    2   -0.032  -0.001  -0.09   0.015  0.068     0.032     0.294      0.149
    3   -0.145  -0.001  -0.253  0.134  0.064     0.029     0.556      0.281
"""


def table_viii(experiment: int, name: str) -> Printed:
    """An entry of Table VIII, Eo, of experiment 1, 2 or 3: M and sigma of the analytical, Ms and sigmas of the simplified model."""
    heads, *rows = (line.split() for line in _VIII.strip().splitlines())
    return Printed(rows[experiment - 1][1 + heads.index(name)], "Eo", "Table VIII")


K_GGI = Printed("4.54e-4", "V/Eo", "Section III.B")
OUTPUT = Printed("1e5", "V", "Section III.B", order=True)
MODEL_ERROR = Printed("1e-3", "V", "Section III.B", order=True)
RELATIVE_ERROR = Printed("1e-8", "", "Section III.B", order=True)
GRADIENT_VOLTAGE = Printed("1e-2", "V", "Section III.B", order=True)

DYNAMIC: Mapping[tuple[str, str], Printed] = {
    ("analytical", "inline"): Printed("-0.72", "Eo", "Section III.B"),
    ("analytical", "cross"): Printed("0.56", "Eo", "Section III.B"),
    ("simplified", "inline"): Printed("-2.9", "Eo", "Section III.B"),
    ("simplified", "cross"): Printed("-0.99", "Eo", "Section III.B"),
}
"""Model errors after demodulation; the paper says "roughly"."""

DIFFERENCE: Mapping[str, Printed] = {
    "analytical": Printed("1e-3", "Eo", "Section III.A", order=True),
    "simplified": Printed("1e-3", "Eo", "Section III.A", order=True),
    "numerical": Printed("1e-1", "Eo", "Section III.A", order=True),
}
"""Differences of the demodulated outputs from the centre gradients."""


BANDWIDTH = 0.2  # Hz, by which the paper turns a standard deviation into a noise density

DENSITIES: tuple[tuple[str, int, Printed], ...] = (
    ("analytical", 1, Printed("0.13", "Eo/sqrt(Hz)", "Section III.C")),
    ("simplified", 1, Printed("0.25", "Eo/sqrt(Hz)", "Section III.C")),
    ("simplified", 2, Printed("0.66", "Eo/sqrt(Hz)", "Section III.C")),
    ("simplified", 3, Printed("1.24", "Eo/sqrt(Hz)", "Section III.C")),
)
"""Model, turbulence experiment, noise density of the inline channel."""


# --- the printed numbers beside ours -------------------------------------------------------------------


@dataclass(frozen=True)
class PrintedEntry:
    """A printed number beside ours, in the printed unit (the mean of several runs, ``spread`` their least and greatest)."""

    quantity: str
    printed: Printed
    ours: float
    spread: tuple[float, float] | None = None

    @property
    def agrees(self) -> bool:
        """Whether ours has the printed digits or order of magnitude, or the printed number lies between our runs."""
        inside = self.spread is not None and self.spread[0] <= self.printed.value <= self.spread[1]
        return inside or self.printed.matches(self.ours)


@dataclass(frozen=True)
class Experiment:
    """An experiment: its title, settings, the printed numbers beside ours, and why some differ."""

    title: str
    settings: Mapping[str, str]
    rows: tuple[PrintedEntry, ...]
    remarks: tuple[str, ...] = ()


def _round(value: float) -> str:
    """Three significant digits; the same text on any machine but for the last of them."""
    return f"{value:.3g}" if value == 0 or 1e-3 <= abs(value) < 1e4 else f"{value:.2e}"


def write_page(experiments: Sequence[Experiment]) -> str:
    """The page of some experiments, as Markdown."""
    page = make_environment("ragg_runtime.experiments", {"digits": _round}).get_template("page.md.j2")
    return page.render(experiments=experiments, rows=[row for e in experiments for row in e.rows])
