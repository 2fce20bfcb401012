"""What the report of ``ragg compare --frozen`` says instead: nothing was fitted, and how the calibration holds here."""

from __future__ import annotations

from typing import Any, Protocol

from ragg_runtime.diagnosis.comparison import Comparison
from ragg_runtime.fit.score import Error
from ragg_runtime.wording import numbers

MOVED = 8
"""Combinations that are listed, those that moved furthest first."""


class Held(Protocol):
    """How a saved calibration holds on flights: see ``compensation/frozen.py``."""

    @property
    def comparison(self) -> Comparison:
        """Model and flights, with the parameters as they were saved."""

    @property
    def free(self) -> Error:
        """The error if they were fitted to these flights."""

    @property
    def holds(self) -> bool:
        """Whether the step between both may be chance."""

    @property
    def p_value(self) -> float:
        """Of that step."""

    @property
    def chi2(self) -> float:
        """Of that step."""

    @property
    def degrees_of_freedom(self) -> int:
        """Directions in which it is tested."""

    def in_words(self) -> str:
        """How the calibration holds, in a sentence."""

    def drift(self) -> list[dict[str, Any]]:
        """Every visible combination, then and now."""

    def suspects(self) -> list[dict[str, Any]]:
        """Single parameters that would explain the step."""


def headline(h: Held) -> str:
    """Error with the saved parameters, whether they hold, and what a fit would leave."""
    frozen, free = numbers.number(h.comparison.calibrated.rms_Eo), numbers.number(h.free.rms_Eo)
    noise = numbers.number(h.comparison.noise_floor)
    holds = "The saved calibration holds here" if h.holds else "The saved calibration does not hold here"
    return f"{holds}: it leaves {frozen} Eo, parameters fitted to this record {free} Eo; the noise is {noise} Eo."


def lead(h: Held, said: list[str]) -> list[str]:
    """What follows: the test, and what is ``said`` of any error."""
    test = (
        f"Chi-square of the step from the saved parameters to what this record says: {numbers.number(h.chi2)} in"
        f" {h.degrees_of_freedom} directions (p = {h.p_value:.2g})."
    )
    return [test, *said]


def errors(h: Held) -> list[dict[str, Any]]:
    """Rows of the table of errors."""
    from ragg_runtime.report import panels  # slow to import, and words need none

    c = h.comparison
    return [
        panels.error_row("as model.toml says", c.nominal, "nominal values, nothing fitted"),
        panels.error_row("frozen", c.calibrated, "parameters as they were saved, nothing fitted here"),
        panels.error_row("free", h.free, "parameters fitted to this record"),
        panels.noise_row(c.fitted, c.noise_floor),
    ]


def section(h: Held) -> dict[str, Any]:
    """What moved since the calibration, and which single parameter would explain it."""
    rows = sorted(h.drift(), key=lambda r: -abs(r["z"]))[:MOVED]
    text = [
        f"{r['flight']}: {r['name']} was {r['frozen']:.5g} ± {r['frozen_std']:.2g}, is {r['value']:.5g} ± {r['std']:.2g}"
        f" {r['unit']} ({r['z']:+.1f} σ)."
        for r in rows
    ]
    text += [
        f"A change of {x['name']} by {x['change']:+.4g} {x['unit']} alone would explain {100 * x['share']:.0f} % of it."
        for x in h.suspects()
    ]
    return {"title": "What moved since it was saved", "text": text, "figures": []}
