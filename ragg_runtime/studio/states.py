"""Other states of a model: with another test sheet, as it was, with an effect of one's own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from ragg_runtime.api import Loaded, as_of, change
from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.edit_toml import add_effect, set_parameters
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.parameters import PARAMETERS
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.model import derive
from ragg_runtime.model.directory import Step, load_model_dir
from ragg_runtime.wording import numbers


def edited(
    m: Loaded, values: Mapping[str, RawQuantity], sigmas: Mapping[str, tuple[float, ...] | None]
) -> Loaded:
    """Change values of the test sheet, and how sure it is of them (``None``: it does not say)."""
    return change(m, set_parameters(m.directory.text, values, sigmas), "edit", ", ".join(values))


def changed_by_others(m: Loaded) -> bool:
    """Whether the directory holds another state than the one that was loaded."""
    return load_model_dir(m.directory.path).digest != m.directory.digest


def with_own(m: Loaded, effect: str, add: str, units: Mapping[str, str]) -> Loaded:
    """The model with an effect of one's own listed, ``add`` at the transducer (unit of each parameter), in memory alone."""
    parameters = MappingProxyType({n: MappingProxyType({"unit": u}) for n, u in units.items()})
    expression = MappingProxyType({"stage": "transducer", "add": add, "params": parameters})
    if effect in {e.id for e in derive.known(m.instrument).effects}:
        raise UserError(
            "an effect of this id exists already", found=repr(effect[:80]), remedy="choose another name"
        )
    return as_of(m, add_effect(m.directory.text, EffectSetting(effect, expression=expression)))


def text_of(history: Sequence[Step], step: int) -> str:
    """model.toml as it was after a step; UserError if that was not kept."""
    if not history[step].text:
        raise UserError(
            "that state was not kept: an older version made the step",
            found=f"step {step + 1}",
            remedy="remove effects one by one instead",
        )
    return history[step].text


def branches(history: Sequence[Step]) -> tuple[list[int], list[int]]:
    """Steps on the present branch, and those that undo has left (nearest last); undo and redo are steps themselves."""
    past: list[int] = []
    future: list[int] = []
    for n, s in enumerate(history):
        if s.action == "calibrate":
            continue  # the model stays as it is
        if s.action == "undo" and len(past) > 1:
            future.append(past.pop())
        elif s.action == "redo" and future:
            past.append(future.pop())
        else:
            past.append(n)
            future.clear()
    return past, future


NO_STATES = ("undo", "redo", "calibrate")
"""Steps after which the model is one that it was before."""


def tree(history: Sequence[Step]) -> dict[int, tuple[int | None, int]]:
    """Of every step that made a state: that from which it was made, and the lane in which it is drawn."""
    found: dict[int, tuple[int | None, int]] = {}
    lanes = 0
    for n, s in enumerate(history):
        if s.action in NO_STATES:
            continue
        past, _ = branches(history[:n])
        origin: int | None = past[-1] if past else None
        if s.action == "restore" and s.effect.isdigit() and int(s.effect) in found:
            origin = int(s.effect)
        taken = any(parent == origin for parent, _ in found.values())
        lane = lanes if origin is None or taken else found[origin][1]
        lanes = max(lanes, lane + 1)
        found[n] = (origin, lane)
    return found


Json = dict[str, Any]
Edit = tuple[RawQuantity, tuple[float, ...] | None]
"""Values of a parameter, and the sheet's sigmas in the same unit (``None``: it says nothing)."""


def shown_sheet(i: Instrument) -> Json:
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


def asked_sheet(values: object) -> dict[str, Edit]:
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
