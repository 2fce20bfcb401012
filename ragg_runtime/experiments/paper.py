"""What Section III prints: the set-ups of Tables VI and VII and the numbers to compare with.

M. Yu and T. Cai, *Mathematic Model And Error Analysis of Moving-base Rotating Accelerometer Gravity
Gradiometer*. The instrument of Table V is ``ragg_runtime.reference.instruments.table_v``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ragg_runtime.experiments.result import COLUMNS, Printed, Result, cells, markdown, reasons

CITATION = (
    "M. Yu and T. Cai, *Mathematic Model And Error Analysis of Moving-base Rotating Accelerometer Gravity "
    "Gradiometer*"
)

DEGREE_PER_HOUR = np.pi / 180 / 3600
ARCSEC = np.pi / 180 / 3600

MASS = 486.0
"""kg, Section III.A."""
MASS_POSITION = (1.2, 0.0, 0.0)
"""m, at the start."""
MASS_RATE = (3600.0, 360.0, 0.0628)
"""Angular rate of the mass: mean and amplitude in deg/h, and the angular frequency of the sine in rad/s."""

TABLE_VI: Mapping[str, tuple[float, float]] = {
    "a_x": (0.08, 0.005),
    "a_y": (0.06, 0.006),
    "a_z": (0.1, 0.05),
    "omega_x": (1000, 700),
    "omega_y": (1500, 900),
    "omega_z": (2000, 800),
}
"""Constant and amplitude of sin(Omega t): g for a, deg/h for omega."""


@dataclass(frozen=True)
class Turbulent:
    """A row of Table VII: mean and standard deviation of a_z, mg, and of each angular rate, deg/h."""

    a_mean: float
    a_std: float
    omega_mean: float
    omega_std: float


TABLE_VII: tuple[Turbulent, ...] = (
    Turbulent(100, 10, 0, 0),
    Turbulent(100, 10, 100, 50),
    Turbulent(200, 10, 100, 50),
)

HORIZONTAL = 0.15
"""Section III.C: rms of a_x and of a_y over that of a_z."""

TABLE_VIII: tuple[Mapping[str, str], ...] = (
    {
        "M_in": "-0.037", "M_cs": "-0.0004", "Ms_in": "-0.080", "Ms_cs": "0.033",
        "sigma_in": "0.062", "sigma_cs": "0.031", "sigmas_in": "0.11", "sigmas_cs": "0.052",
    },
    {
        "M_in": "-0.032", "M_cs": "-0.001", "Ms_in": "-0.09", "Ms_cs": "0.015",
        "sigma_in": "0.068", "sigma_cs": "0.032", "sigmas_in": "0.294", "sigmas_cs": "0.149",
    },
    {
        "M_in": "-0.145", "M_cs": "-0.001", "Ms_in": "-0.253", "Ms_cs": "0.134",
        "sigma_in": "0.064", "sigma_cs": "0.029", "sigmas_in": "0.556", "sigmas_cs": "0.281",
    },
)  # fmt: skip
"""Eo. M and sigma of the analytical, Ms and sigmas of the simplified model (the paper's M^s, sigma^s)."""


def table_viii(experiment: int, name: str) -> Printed:
    """An entry of Table VIII; ``experiment`` is 1, 2 or 3."""
    return Printed(TABLE_VIII[experiment - 1][name], "Eo", "Table VIII")


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

BANDWIDTH = 0.2
"""Hz, by which the paper turns a standard deviation into a noise density."""

DENSITIES: tuple[tuple[str, int, Printed], ...] = (
    ("analytical", 1, Printed("0.13", "Eo/sqrt(Hz)", "Section III.C")),
    ("simplified", 1, Printed("0.25", "Eo/sqrt(Hz)", "Section III.C")),
    ("simplified", 2, Printed("0.66", "Eo/sqrt(Hz)", "Section III.C")),
    ("simplified", 3, Printed("1.24", "Eo/sqrt(Hz)", "Section III.C")),
)
"""Model, turbulence experiment, noise density of the inline channel."""


_HEAD = """# The paper's experiments, repeated

Section III of
{citation}:
our numbers beside the printed ones (`python -m ragg_runtime.experiments`, as JSON with `--json`).

The numerical model of Eq. 49 to 53 stands for the instrument; the analytical (Eq. 17 to 19) and the
simplified model (Eq. 42 to 47) are the derived ones. The misprints of the printed equations cost too little to show here.

Of {rows} printed numbers, **{agree} agree**, **{open} hang on an input that the paper does not state**, and
**{unexplained} are unexplained**.

- *agrees*: ours has the printed digits, or the printed order of magnitude, or the printed number lies between
  the least and the greatest of our runs.
- *open input*: it does not, but an input that the paper does not state moves our number over a range that
  holds the printed one. This is no proof that the paper had that input.
- *unexplained*: neither.

No parameter of the instrument or the models is adjusted to meet the paper. Two choices were made with the
printed numbers in view, because the paper leaves them open: the sign of a model error, numerical minus
model (the other would make every printed error of Section III.B differ in sign from ours), and the
sampling of the turbulence, on which the simplified model's sigmas in experiments 2 and 3 rest.
"""


def page(results: Sequence[Result]) -> str:
    """The page of some experiments."""
    verdicts = Counter(row.verdict for r in results for row in r.rows)
    head = _HEAD.format(
        citation=CITATION,
        rows=sum(verdicts.values()),
        agree=verdicts["agrees"],
        open=verdicts["open input"],
        unexplained=verdicts["unexplained"],
    )
    return "\n".join([head, *(_section(r) for r in results)])


def _section(r: Result) -> str:
    parts = [f"## {r.title}", "\n".join(f"- {name}: {value}" for name, value in r.settings.items())]
    parts.append(markdown(COLUMNS, [cells(row) for row in r.rows]))
    parts += [f"- {text}" for text in reasons(r.rows)]
    for t in r.tables:
        parts += [f"### {t.title}", markdown(t.columns, t.rows), t.finding]
    return "\n\n".join(parts) + "\n"
