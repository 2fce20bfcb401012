"""The test sheet as a table to look at and to change: values of every accelerometer, and how sure the sheet is of them."""

from __future__ import annotations

from typing import Any

import numpy as np

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.wording import numbers

Json = dict[str, Any]
Edit = tuple[RawQuantity, tuple[float, ...] | None]
"""Values of a parameter, and the sheet's sigmas in the same unit (``None``: it says nothing)."""


def shown(i: Instrument) -> Json:
    """Names of the accelerometers, and of each parameter values, sigmas and plausible errors in its display unit."""
    known, rows = i.units, []
    for q in PARAMETERS:
        v = i.accelerometers[q.name]

        def of(x: Any, digits: int, unit: str = q.si_unit, to: str = q.display_unit) -> list[float]:
            return [float(f"{y:.{digits}g}") for y in known.from_si(np.asarray(x), unit, to)]

        rows.append(
            {
                "name": q.name,
                "symbol": [list(p) for p in numbers.symbol(q.symbol)],
                "meaning": q.description,
                "unit": q.display_unit,
                "unit_shown": numbers.unit(q.display_unit),
                "values": of(v, 12),
                "plausible": of(q.plausible_si(v, i.g0), 4),
                "sigma": of(i.sigmas[q.name], 12) if q.name in i.sigmas else None,
            }
        )
    return {"names": list(i.layout.names), "rows": rows}


def asked(values: object) -> dict[str, Edit]:
    """What a page sends of it: name -> value (as many numbers as accelerometers), unit, sigma."""
    found: dict[str, Edit] = {}
    for name, given in values.items() if isinstance(values, dict) else ():
        own = given if isinstance(given, dict) else {}
        unit, sigma = own.get("unit"), own.get("sigma")
        if not isinstance(unit, str) or len(unit) > 80:
            raise UserError("a unit is needed", where=str(name)[:40], found=repr(unit)[:80])
        value = _numbers(own.get("value"), str(name))
        found[str(name)] = (
            RawQuantity(value, unit),
            None if sigma is None else _numbers(sigma, f"{name}, sigma"),
        )
    if not found:
        raise UserError("no value was changed", remedy="change one, then save")
    return found


def _numbers(given: object, where: str) -> tuple[float, ...]:
    if isinstance(given, list) and given and all(type(x) in (int, float) for x in given):
        return tuple(float(x) for x in given)
    raise UserError("numbers are needed", where=where[:40], found=repr(given)[:80])
