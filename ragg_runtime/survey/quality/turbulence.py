"""How rough a line was: vertical acceleration from 0.3 to 10 Hz, or what the record allows of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ragg_runtime.flight.record import Array
from ragg_runtime.survey.quality.lines import SurveyLine
from ragg_runtime.survey.quality.spectra import band_pass, filled

BAND = (0.3, 10.0)
"""Hz: vertical acceleration in it is what the industry calls turbulence (Boggs and Dransfield, 2004)."""


@dataclass(frozen=True, eq=False)
class Turbulence:
    """(N,) m/s^2 of vertical acceleration, and in words what it was made of."""

    values: Array
    made_of: str

    @property
    def size(self) -> float:
        """Its standard deviation, m/s^2."""
        return float(np.std(self.values))


def turbulence(line: SurveyLine) -> Turbulence | None:
    """From the best channel there is; ``None`` without any."""
    high = min(BAND[1], 0.45 * line.rate)
    for name in ("vertical_acceleration", "a_z"):
        if name in line.channels:
            values = band_pass(line.channels[name], line.rate, *BAND)
            if values is not None:
                return Turbulence(values, f"{name}, {BAND[0]:g} to {high:.3g} Hz")
            whole = filled(line.channels[name])
            if whole is not None:
                return Turbulence(
                    whole - np.mean(whole), f"{name}, unfiltered: {line.rate:.3g} Hz is too slow"
                )
    for name, order in (("vertical_velocity", 1), ("altitude", 2)):
        whole = filled(line.channels[name]) if name in line.channels else None
        if whole is not None:
            values = np.diff(whole, n=order) * line.rate**order
            padded = np.concatenate([np.zeros(order - order // 2), values, np.zeros(order // 2)])
            return Turbulence(padded, f"{'second ' * (order == 2)}difference of {name} at {line.rate:.3g} Hz")
    return None
