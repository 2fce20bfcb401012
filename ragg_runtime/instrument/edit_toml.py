"""Changes to a ``model.toml`` that leave the user's comments, order and spelling as they are."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT

from ragg_runtime.base.errors import UserError, did_you_mean
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.instrument.parameters import PARAMETER
from ragg_runtime.instrument.units import RawQuantity


def set_parameters(
    text: str,
    values: Mapping[str, RawQuantity],
    sigmas: Mapping[str, tuple[float, ...] | None] = MappingProxyType({}),
    fixed: Mapping[str, bool] = MappingProxyType({}),
) -> str:
    """``text`` of a model.toml with some of ``[accelerometers]`` set, comments kept.

    ``sigmas``, in the values' units, replace those of the sheet, ``None`` takes them out; of what is not named they stay where the unit
    does. ``fixed`` marks those that are not fitted. Raises UserError for an unknown parameter.
    """
    document = _document(text)
    table: Any = document.setdefault("accelerometers", tomlkit.table())
    for name, quantity in values.items():
        if name not in PARAMETER:
            raise UserError(
                f"the accelerometer has no parameter {name!r}",
                expected="one of " + ", ".join(PARAMETER),
                remedy=did_you_mean(name, PARAMETER),
            )
        _put(table, name, quantity_table(quantity))
        if name in sigmas:
            table[name].pop("sigma", None)
        if sigma := sigmas.get(name):
            table[name].add("sigma", [plain_number(v) for v in sigma])
        if name in fixed:
            table[name].pop("fixed", None)
        if fixed.get(name):
            table[name].add("fixed", True)
    return tomlkit.dumps(document)


def add_effect(text: str, setting: EffectSetting) -> str:
    """``text`` with the effect at the end of ``effects``, or with its values changed if it is there."""
    document = _document(text)
    entries = _entries(document)
    place = _place(entries, setting.id)
    if place is None:
        entry = _entry(setting)
        if isinstance(entries, AoT):
            table = tomlkit.table()
            table.update(entry if not isinstance(entry, str) else {"id": str(entry)})
            entry = table
        entries.append(entry)
    elif isinstance(entries[place], str):
        comment = entries[place].trivia.comment
        entries[place] = _entry(setting)
        entries[place].trivia.comment = comment
    else:
        for name, quantity in setting.values.items():
            _put(entries[place], name, quantity_table(quantity))
    return tomlkit.dumps(document)


def remove_effect(text: str, effect_id: str) -> str:
    """``text`` without the effect; UserError if it is not there."""
    document = _document(text)
    entries = _entries(document)
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


def _entries(document: tomlkit.TOMLDocument) -> Any:
    if "effects" not in document:
        # A plain key must come before the first table.
        fresh = tomlkit.document()
        fresh.add("effects", tomlkit.array())
        document_text = tomlkit.dumps(fresh) + tomlkit.dumps(document)
        document.clear()
        document.update(tomlkit.parse(document_text))
    return document["effects"]


def _entry(setting: EffectSetting) -> Any:
    if not setting.values and setting.expression is None:
        return tomlkit.item(setting.id)
    entry = tomlkit.inline_table()
    entry.add("id", setting.id)
    if setting.expression is not None:
        entry.add("stage", setting.expression["stage"])
        entry.add("add", setting.expression["add"])
        for name, parameter in setting.expression["params"].items():
            inner = tomlkit.inline_table()
            inner.update({k: v for k, v in parameter.items() if k != "value" or name not in setting.values})
            if name not in setting.values:
                entry.add(name, inner)
    for name, quantity in setting.values.items():
        entry.add(name, quantity_table(quantity))
    return entry


def quantity_table(quantity: RawQuantity) -> Any:
    table = tomlkit.inline_table()
    value = quantity.value
    table.add("value", [plain_number(v) for v in value] if isinstance(value, tuple) else plain_number(value))
    table.add("unit", quantity.unit)
    return table


def plain_number(value: float) -> int | float:
    """Whole numbers are written as people write them: 30, not 30.0."""
    value = float(np.float64(value))
    return int(value) if value.is_integer() and abs(value) < 1e6 else value


def _put(table: Any, name: str, item: Any) -> None:
    """Set a quantity; the sigma of the old one stays where the unit does, and whether it is fixed."""
    if name in table:
        old = table[name]
        if isinstance(old, dict) and "sigma" in old and old.get("unit") == item.get("unit"):
            item.add("sigma", old["sigma"])
        if isinstance(old, dict) and old.get("fixed"):
            item.add("fixed", True)
        trivia = getattr(old, "trivia", None)
        table[name] = item
        if trivia is not None:
            table[name].trivia.comment = trivia.comment
            table[name].trivia.comment_ws = trivia.comment_ws
    else:
        table.add(name, item)


def _place(entries: Any, effect_id: str) -> int | None:
    return next((n for n, e in enumerate(entries) if _id(e) == effect_id), None)


def _id(entry: Any) -> str:
    return str(entry["id"] if isinstance(entry, dict) else entry)
