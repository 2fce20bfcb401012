"""The parameters of an accelerometer and of the disc: symbol, units, meaning, plausible error."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.units import units

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class AccelerometerParameter:
    """A parameter of an accelerometer; 0 where model.toml leaves it out, unless ``required``.

    ``plausible``: a usual error of the test sheet, in ``display_unit``; if ``relative``, a fraction of the nominal
    value.
    """

    name: str
    symbol: str
    si_unit: str
    display_unit: str
    description: str
    plausible: float
    relative: bool = False
    required: bool = False

    def plausible_si(self, nominal: Vector, g0: float) -> Vector:
        """Plausible error of each value of ``nominal`` (any shape), in ``si_unit``, with g = ``g0`` m/s^2."""
        if self.relative:
            return np.abs(nominal) * self.plausible
        return np.full_like(nominal, _convert(self.plausible, self.display_unit, self.si_unit, g0))


@cache  # a search for mistakes asks a thousand times
def _convert(value: float, unit: str, si_unit: str, g0: float) -> float:
    return units(g0).to_si(value, unit, si_unit)


def _second_order(index: int, product: str) -> AccelerometerParameter:
    text = f"second-order coefficient of {product}"
    return AccelerometerParameter(f"K{index}", f"K_{index}", "1/(m/s^2)", "ug/g^2", text, 20.0)


def _angle(name: str, symbol: str, text: str) -> AccelerometerParameter:
    return AccelerometerParameter(name, symbol, "rad", "arcsec", text, 100.0)


PARAMETERS: tuple[AccelerometerParameter, ...] = (
    AccelerometerParameter("dR", "dR", "m", "um", "radial distance error", 50.0),
    _angle("beta_x", r"\beta_x", "altitude angle of the mounting position"),
    _angle("beta_z", r"\beta_z", "initial phase angle of the mounting position"),
    _angle("vartheta_x", r"\vartheta_x", "misalignment about the tangential axis"),
    _angle("vartheta_y", r"\vartheta_y", "misalignment about the radial axis"),
    _angle("vartheta_z", r"\vartheta_z", "misalignment about the axial axis"),
    AccelerometerParameter("K0", "K_0", "m/s^2", "ug", "null bias", 50.0),
    AccelerometerParameter(
        "K1", "K_1", "A/(m/s^2)", "mA/g", "linear scale factor", 1e-3, relative=True, required=True
    ),
    _second_order(2, "f_i^2"),
    _second_order(4, "f_i f_p"),
    _second_order(5, "f_o^2"),
    _second_order(6, "f_i f_o"),
    _second_order(7, "f_p^2"),
    _second_order(8, "f_o f_p"),
    AccelerometerParameter(
        "k_VI", "k_{V/I}", "V/A", "ohm", "current-to-voltage gain", 1e-3, relative=True, required=True
    ),
)
"""The accelerometer's parameters, in the order in which every parameter vector holds them."""

PARAMETER: Mapping[str, AccelerometerParameter] = MappingProxyType({p.name: p for p in PARAMETERS})
"""The same by name."""

DISC_UNITS: Mapping[str, str] = MappingProxyType({"radius": "m", "spin_frequency": "Hz", "g0": "m/s^2"})
