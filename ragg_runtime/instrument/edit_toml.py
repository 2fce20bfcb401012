"""Changes to a ``model.toml`` that leave the user's comments, order and spelling as they are."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT

from ragg_runtime.base.errors import UserError, check_keys, did_you_mean
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.instrument.parameters import PARAMETER
from ragg_runtime.instrument.units import RawQuantity

_NOTHING: Mapping[str, Any] = MappingProxyType({})


def set_parameters(
    text: str,
    values: Mapping[str, RawQuantity],
    sigmas: Mapping[str, tuple[float, ...] | None] = _NOTHING,
    fixed: Mapping[str, bool] = _NOTHING,
) -> str:
    """``text`` of a model.toml with some of ``[accelerometers]`` set, comments kept.

    ``sigmas``, in the values' units, replace those of the sheet, ``None`` takes them out; of what is not named they stay where the unit
    does. ``fixed`` marks those that are not fitted. Raises UserError for an unknown parameter.
    """
    document = _document(text)
    table: Any = document.setdefault("accelerometers", tomlkit.table())
    check_keys(values, PARAMETER, "[accelerometers]")
    for name, quantity in values.items():
        further: dict[str, Any] = {"fixed": fixed[name]} if name in fixed else {}
        if name in sigmas:
            further["sigma"] = [_plain_number(v) for v in sigmas[name] or ()]
        _put(table, name, quantity, further)
    return tomlkit.dumps(document)


def add_effect(text: str, setting: EffectSetting) -> str:
    """``text`` with the effect at the end of ``effects``, or with its values changed if it is there."""
    document = _document(text)
    if "effects" not in document:
        document = _document("effects = []\n" + text)  # a plain key must come before the first table
    entries: Any = document["effects"]
    place = _place(entries, setting.id)
    if place is None:
        entry = _entry(setting)
        if isinstance(entries, AoT):
            table = tomlkit.table()
            table.update(entry if isinstance(entry, dict) else {"id": setting.id})
            entry = table
        entries.append(entry)
    elif isinstance(entries[place], str):
        comment = entries[place].trivia.comment
        entries[place] = _entry(setting)
        entries[place].trivia.comment = comment
    else:
        for name, quantity in setting.values.items():
            _put(entries[place], name, quantity)
    return tomlkit.dumps(document)


def remove_effect(text: str, effect_id: str) -> str:
    """``text`` without the effect; UserError if it is not there."""
    document = _document(text)
    entries: Any = document.get("effects", [])
    place = _place(entries, effect_id)
    if place is None:
        known = [_id(e) for e in entries]
        raise UserError(
            f"the effect {effect_id!r} is not in the model",
            found="effects " + ", ".join(known) if known else "no effects",
            remedy=did_you_mean(effect_id, known),
        )
    del entries[place]
    return tomlkit.dumps(document)


def with_full_kinematics(text: str) -> str:
    """``text`` with ``[model] kinematics = "full"``, where it has no ``[model]`` (nor ``disc-spin``, which is another way to it)."""
    document = _document(text)
    if "model" in document or _place(document.get("effects", []), "disc-spin") is not None:
        return text
    return f'{text.rstrip()}\n\n[model]\nkinematics = "full"\n'


def _document(text: str) -> tomlkit.TOMLDocument:
    try:
        return tomlkit.parse(text)
    except (TOMLKitError, ValueError, RecursionError) as error:
        raise UserError("not a TOML file", found=str(error), expected="the form of model.toml") from None


def _entry(setting: EffectSetting) -> Any:
    if not setting.values and setting.expression is None:
        return tomlkit.item(setting.id)
    entry = tomlkit.inline_table()
    entry.add("id", setting.id)
    parameters: Mapping[str, Mapping[str, Any]] = _NOTHING
    if setting.expression is not None:
        entry.update({k: setting.expression[k] for k in ("stage", "add")})
        parameters = setting.expression["params"]
    for name in dict.fromkeys((*parameters, *setting.values)):
        entry.add(name, _table(setting.values.get(name), parameters.get(name, _NOTHING)))
    return entry


def _table(quantity: RawQuantity | None, further: Mapping[str, Any]) -> Any:
    """A quantity, and what is said of it besides, less what is false or empty."""
    table = tomlkit.inline_table()
    if quantity is not None:
        v = quantity.value
        table.add("value", [_plain_number(x) for x in v] if isinstance(v, tuple) else _plain_number(v))
        table.add("unit", quantity.unit)
    table.update({k: x for k, x in further.items() if k not in table and x not in (False, [])})
    return table


def _plain_number(value: float) -> int | float:
    """Whole numbers are written as people write them: 30, not 30.0."""
    value = float(np.float64(value))
    return int(value) if value.is_integer() and abs(value) < 1e6 else value


def _put(table: Any, name: str, quantity: RawQuantity, further: Mapping[str, Any] = _NOTHING) -> None:
    """Set a quantity; what is said of the old one besides stays, its sigma where the unit does."""
    old = table.get(name)
    kept = dict(old) if isinstance(old, dict) else {}
    if kept.get("unit") != quantity.unit:
        kept.pop("sigma", None)
    table[name] = _table(quantity, {**kept, **further})
    trivia = getattr(old, "trivia", None)
    if trivia is not None:
        table[name].trivia.comment, table[name].trivia.comment_ws = trivia.comment, trivia.comment_ws


def _place(entries: Any, effect_id: str) -> int | None:
    return next((n for n, e in enumerate(entries) if _id(e) == effect_id), None)


def _id(entry: Any) -> str:
    return str(entry["id"] if isinstance(entry, dict) else entry)
