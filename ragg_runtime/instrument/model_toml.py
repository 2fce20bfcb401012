"""Read ``model.toml``, and change it so that the user's comments, order and spelling stay."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT

from derive.names import is_name
from ragg_runtime.base.errors import (
    UserError,
    at,
    check_choice,
    check_keys,
    check_table,
    did_you_mean,
    read_name,
)
from ragg_runtime.instrument.instrument import (
    DISC_UNITS,
    PARAMETER,
    EffectSetting,
    Instrument,
    Vector,
    read_demodulation,
    read_form,
)
from ragg_runtime.instrument.layout import (
    TANGENTIAL,
    X_AXIS,
    Z_AXIS,
    AccelerometerPosition,
    Disc,
    Layout,
    Vector3,
    find_across,
    least_rotation,
    normalise,
    paper,
)
from ragg_runtime.instrument.units import STANDARD_G0, RawQuantity, Units, read_quantity, read_si, units


def parse_instrument(text: str, path: Path | None = None) -> Instrument:
    """The instrument of a ``model.toml``; UserError names file (``path``) and key, what is there and what should be."""
    try:
        table = tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # numbers of thousands of digits, brackets in brackets
        raise UserError(
            "not a TOML file", where=path, found=str(error), expected="the form of model.toml"
        ) from None
    if "effects_folder" in table:
        raise UserError(
            "Python is never taken from a model directory",
            where=at(path, "effects_folder"),
            found=repr(table["effects_folder"])[:200],
            remedy="inspect these files, move them to a folder of your own, name it in the environment variable "
            "RAGG_EFFECTS, and remove effects_folder from model.toml",
        )
    check_keys(table, ("disc", "accelerometers", "effects", "model", "g0", "demodulator"), path)
    form, angle_origin = read_form(table.get("model"), path)
    layout, g0 = _read_discs(table, path)
    accelerometers, sigmas, fixed = _read_accelerometers(
        _find_table(table, "accelerometers", path), g0, path, layout.size
    )
    return Instrument.build(
        layout,
        g0,
        accelerometers,
        sigmas=sigmas,
        fixed=fixed,
        effects=_read_effects(table.get("effects", []), units(g0), path, layout.size),
        path=path,
        form=form,
        angle_origin=angle_origin,
        demodulation=read_demodulation(table.get("demodulator"), at(path, "[demodulator]")),
    )


def _read_discs(table: Mapping[str, Any], path: Path | None) -> tuple[Layout, float]:
    """The layout of [disc] (the paper's) or of [[disc]] tables, and g0."""
    if not isinstance(table.get("disc"), list):
        if "g0" in table:
            raise UserError("g0 belongs in the table [disc]", where=at(path, "g0"))
        disc, where = _find_table(table, "disc", path), at(path, "[disc]")
        check_keys(disc, DISC_UNITS, where)
        radius, spin_frequency, g0 = (_read_number(disc, n, unit, where) for n, unit in DISC_UNITS.items())
        return paper(radius, spin_frequency), g0
    g0 = _read_number(table, "g0", "m/s^2", str(path)) if "g0" in table else STANDARD_G0
    return read_layout(table["disc"], path), g0


def _find_table(table: Mapping[str, Any], name: str, path: Path | None) -> Mapping[str, Any]:
    if name not in table:
        raise UserError(f"the table [{name}] is missing", where=path)
    return check_table(table[name], name, path, f"[{name}]")


def _read_accelerometers(
    table: Mapping[str, Any], g0: float, path: Path | None, count: int
) -> tuple[dict[str, Vector], dict[str, Vector], frozenset[str]]:
    """Values, their priors where the sheet gives any, in SI; and which are not fitted."""
    check_keys(table, PARAMETER, at(path, "[accelerometers]"))
    values, sigmas, fixed = {}, {}, set()
    for name, raw in table.items():
        place = at(path, f"[accelerometers] {name}")
        si_unit = PARAMETER[name].si_unit
        quantity = read_quantity(_drop_keys(raw, "sigma", "fixed"), place, count=count)
        values[name] = read_si(quantity, si_unit, g0, place)
        if _is_fixed(raw, place):
            fixed.add(name)
        if isinstance(raw, dict) and "sigma" in raw:
            where = f"{place}, sigma"
            sigma = read_quantity({"value": raw["sigma"], "unit": quantity.unit}, where, count=count)
            sigmas[name] = read_si(sigma, si_unit, g0, where)
            if np.any(sigmas[name] <= 0):
                expected = f"one or {count} above 0, in {quantity.unit}; omit it if unknown"
                raise UserError("sigma must be positive", where=where, found=raw["sigma"], expected=expected)
    return values, sigmas, frozenset(fixed)


def _is_fixed(raw: object, where: str) -> bool:
    return isinstance(raw, dict) and check_choice(raw.get("fixed", False), (False, True), f"{where}, fixed")


def _drop_keys(raw: object, *keys: str) -> object:
    """A quantity as written, without further keys."""
    return {k: v for k, v in raw.items() if k not in keys} if isinstance(raw, dict) else raw


def _read_effects(entries: object, u: Units, path: Path | None, count: int) -> tuple[EffectSetting, ...]:
    where = at(path, "effects")
    if not isinstance(entries, list):
        raise UserError("effects must be a list", where=where, found=repr(entries), expected='["lag"]')
    settings = [_read_effect(e, f"{where}, entry {n}", u, count) for n, e in enumerate(entries, 1)]
    if twice := _find_twice([e.id for e in settings]):
        raise UserError(f"the effect {twice!r} is listed twice", where=where, remedy="remove one entry")
    return tuple(settings)


def _find_twice(names: Sequence[str]) -> str | None:
    return next((n for n in sorted(names) if names.count(n) > 1), None)


def _read_effect(entry: object, where: str, u: Units, count: int) -> EffectSetting:
    """An entry of ``effects``: an id, or a table with values of parameters, or one with the expression and its parameters."""
    entry = {"id": entry} if isinstance(entry, str) else entry
    if not isinstance(entry, dict) or not isinstance(entry.get("id"), str):
        raise UserError(
            "not an effect",
            where=where,
            found=repr(entry),
            expected='"lag" or { id = "lag", tau = { value = [1, 1, 1, 1], unit = "ms" } }',
        )
    effect_id = read_name(entry["id"], at(where, "id"), '"lag"')
    where = f"{where} ({effect_id})"
    values = {name: raw for name, raw in entry.items() if name not in ("id", *_EXPRESSION)}
    for name in values:
        read_name(name, at(where, "the name of a parameter"), "tau")
    expression = None
    if any(key in entry for key in _EXPRESSION):
        expression = _read_expression(entry, values, where, u)
        values = {
            n: {k: q[k] for k in ("value", "unit")} for n, q in expression["params"].items() if "value" in q
        }
    fixed = {name for name, raw in values.items() if _is_fixed(raw, f"{where}: {name}")}
    quantities = {
        name: read_quantity(_drop_keys(raw, "fixed"), f"{where}: {name}", count=count)
        for name, raw in values.items()
    }
    for name, q in quantities.items():
        u.parse(q.unit, f"{where}: {name}")
    return EffectSetting(effect_id, MappingProxyType(quantities), expression, frozenset(fixed))


_EXPRESSION = ("stage", "add")  # keys of an effect in one line, beside its parameters


def _read_expression(
    entry: Mapping[str, Any], parameters: Mapping[str, Any], where: str, u: Units
) -> Mapping[str, Any]:
    """``stage``, ``add`` and ``params`` (name -> ``unit``, and ``value``, ``shared``, ``plausible`` where they are given)."""
    example = 'stage = "transducer", add = "K_x * f_i**3", K_x = { value = 0, unit = "ug/g^3" }'
    for key in _EXPRESSION:
        if not isinstance(entry.get(key), str):
            raise UserError(
                f"the effect's {key} is missing or not a text",
                where=where,
                found=repr(entry.get(key)),
                expected=example,
            )
    for name, raw in parameters.items():
        if not isinstance(raw, dict) or not isinstance(raw.get("unit"), str):
            raise UserError(
                "the parameter needs a unit", where=f"{where}: {name}", found=repr(raw), expected=example
            )
        check_keys(raw, ("value", "unit", "shared", "plausible"), f"{where}: {name}")
        u.parse(raw["unit"], f"{where}: {name}")
    return MappingProxyType({**{k: entry[k] for k in _EXPRESSION}, "params": dict(parameters)})


DISC_KEYS = ("name", "radius", "spin_frequency", "axis", "zero", "accelerometer")
PLACE_KEYS = ("name", "angle", "sign", "output", "radius", "height", "direction")

_EXAMPLE = '[[disc.accelerometer]]\\nname = "A1"\\nangle = "0 deg"\\nsign = 1\\noutput = "G_out"'


def read_layout(tables: Sequence[Any], path: Path | None) -> Layout:
    """The layout that ``[[disc]]`` tables describe; UserError names what is wrong."""
    discs: list[Disc] = []
    places: list[AccelerometerPosition] = []
    outputs: dict[str, int] = {}
    for number, table in enumerate(tables, 1):
        check_table(table, "disc", path, "[[disc]]")
        where = at(path, f"[[disc]] {table['name'] if is_name(table.get('name')) else number}")
        check_keys(table, DISC_KEYS, where)
        discs.append(_read_disc(table, where, single=len(tables) == 1))
        entries = table.get("accelerometer", [])
        if not isinstance(entries, list):
            raise UserError("accelerometer must be a list of tables", where=where, expected=_EXAMPLE)
        for k, entry in enumerate(entries, 1):
            place = at(where, f"accelerometer {k}")
            check_keys(check_table(entry, "an accelerometer", place, _EXAMPLE), PLACE_KEYS, place)
            default = {n: table[n] for n in ("radius",) if n in table}
            places.append(_read_position(default | entry, place, number - 1, outputs))
    layout = Layout(discs=tuple(discs), places=tuple(places), output_names=tuple(outputs))
    _check(layout, path)
    return layout


def _read_disc(table: Mapping[str, Any], where: str, *, single: bool) -> Disc:
    name = _read_name(table, "name", where, "A" if single else None)
    axis = _read_direction(table, "axis", where, Z_AXIS)
    zero = least_rotation(Z_AXIS, axis, X_AXIS)[:, 0].tolist()
    if "zero" in table:
        zero = _read_direction(table, "zero", where, X_AXIS)
        if abs(np.dot(axis, zero)) > 1 - 1e-9:
            raise UserError("zero must not lie along the axis", where=where, found=list(zero))
    return Disc(
        name=name,
        spin_frequency=_read_number(table, "spin_frequency", "Hz", where),
        axis=axis,
        zero=find_across(zero, axis),
        angle_column="spin_angle" if single else f"spin_angle_{name}",
    )


def _read_position(
    entry: Mapping[str, Any], where: str, disc: int, outputs: dict[str, int]
) -> AccelerometerPosition:
    output = _read_name(entry, "output", where)
    radius = _read_number(entry, "radius", "m", where)
    if radius < 0.0:
        raise UserError("radius is out of range", where=where, found=f"{radius} m", expected="not negative")
    sign = entry.get("sign")
    if type(sign) is not int or abs(sign) != 1:
        raise UserError("sign must be 1 or -1", where=where, found=repr(sign), expected="sign = 1")
    return AccelerometerPosition(
        name=_read_name(entry, "name", where),
        disc=disc,
        angle=_read_number(entry, "angle", "rad", where),
        radius=radius,
        height=_read_number(entry, "height", "m", where) if "height" in entry else 0.0,
        direction=_read_direction(entry, "direction", where, TANGENTIAL),
        sign=sign,
        output=outputs.setdefault(output, len(outputs)),
    )


def _check(layout: Layout, path: Path | None) -> None:
    where = at(path, "[[disc]]")
    if not layout.places:
        raise UserError("there is no accelerometer", where=where, expected=_EXAMPLE)
    for what, names in (("disc", [d.name for d in layout.discs]), ("accelerometer", list(layout.names))):
        if twice := _find_twice(names):
            remedy = "give each a name of its own"
            raise UserError(f"two of the same name: {what} {twice!r}", where=where, remedy=remedy)
    for o in layout.outputs:
        spread = {layout.discs[layout.places[j].disc].name for j in o.members}
        if len(spread) > 1:
            raise UserError(
                f"the output {o.name} is made of accelerometers of several discs",
                where=where,
                found=", ".join(sorted(spread)),
                expected="accelerometers of one disc",
                remedy="give each disc an output of its own, such as G_out_A and G_out_B",
            )
    voltages = {c for j in range(layout.size) for c in layout.voltage_columns(j)}
    for name in filter(voltages.__contains__, layout.output_names):
        raise UserError(f"the output {name} has the name of a voltage", where=where)


def _read_name(table: Mapping[str, Any], key: str, where: str, default: str | None = None) -> str:
    example = {"name": '"A1"', "output": '"G_out"'}[key]
    if key not in table and default is None:
        raise UserError(f"{key} is missing", where=where, expected=f"{key} = {example}")
    return read_name(table.get(key, default), at(where, key), example)


def _read_number(table: Mapping[str, Any], key: str, si_unit: str, where: str) -> float:
    """One number in SI."""
    place = f"{where} {key}"
    if key not in table:
        example = {"rad": "deg"}.get(si_unit, si_unit)
        raise UserError(f"{key} is missing", where=place, expected=f'{key} = "... {example}"')
    raw = table[key]
    if isinstance(raw, int | float) and not isinstance(raw, bool) and raw == 0:
        return 0.0  # nothing has no unit
    q = read_quantity(raw, place, count=1)
    # any g will do: that of most models, whose registry of units (a fifth of a second) is needed anyway
    return float(read_si(q, si_unit, STANDARD_G0, place)[0])


def _read_direction(table: Mapping[str, Any], key: str, where: str, default: Vector3) -> Vector3:
    if key not in table:
        return default
    raw = table[key]
    try:
        usable = len(raw) == 3 and all(math.isfinite(v) for v in raw) and any(raw)
    except (TypeError, OverflowError):  # no list of numbers
        usable = False
    if not usable:
        raise UserError(
            f"{key} is not a direction",
            where=where,
            found=repr(raw),
            expected=f"{key} = [0, 0, 1], three numbers",
        )
    return normalise(raw)


def add_effect(text: str, setting: EffectSetting) -> str:
    """``text`` with the effect at the end of ``effects``, or with its values changed if it is there."""
    document = _parse(text)
    if "effects" not in document:
        document = _parse("effects = []\n" + text)  # a plain key must come before the first table
    entries: Any = document["effects"]
    place = _find(entries, setting.id)
    if place is None:
        entry = _write_entry(setting)
        if isinstance(entries, AoT):
            table = tomlkit.table()
            table.update(entry if isinstance(entry, dict) else {"id": setting.id})
            entry = table
        entries.append(entry)
    elif isinstance(entries[place], str):
        comment = entries[place].trivia.comment
        entries[place] = _write_entry(setting)
        entries[place].trivia.comment = comment
    else:
        for name, quantity in setting.values.items():
            _put(entries[place], name, quantity)
    return tomlkit.dumps(document)


def remove_effect(text: str, effect_id: str) -> str:
    """``text`` without the effect; UserError if it is not there."""
    document = _parse(text)
    entries: Any = document.get("effects", [])
    place = _find(entries, effect_id)
    if place is None:
        ids = [_read_id(e) for e in entries]
        raise UserError(
            f"the effect {effect_id!r} is not in the model",
            found="effects " + ", ".join(ids) if ids else "no effects",
            remedy=did_you_mean(effect_id, ids),
        )
    del entries[place]
    return tomlkit.dumps(document)


def with_full_kinematics(text: str) -> str:
    """``text`` with ``[model] kinematics = "full"``, unless it has a ``[model]``, or ``disc-spin``, which also stands for it."""
    document = _parse(text)
    if "model" in document or _find(document.get("effects", []), "disc-spin") is not None:
        return text
    return f'{text.rstrip()}\n\n[model]\nkinematics = "full"\n'


def _parse(text: str) -> tomlkit.TOMLDocument:
    try:
        return tomlkit.parse(text)
    except (TOMLKitError, ValueError, RecursionError) as error:
        raise UserError("not a TOML file", found=str(error), expected="the form of model.toml") from None


def _write_entry(setting: EffectSetting) -> Any:
    if not setting.values:
        return tomlkit.item(setting.id)
    entry = tomlkit.inline_table()
    entry["id"] = setting.id
    for name, quantity in setting.values.items():
        _put(entry, name, quantity)
    return entry


def _write_number(value: float | tuple[float, ...]) -> int | float | list[Any]:
    """Whole numbers are written as people write them: 30, not 30.0."""
    if isinstance(value, tuple):
        return [_write_number(x) for x in value]
    value = float(value)
    return int(value) if value.is_integer() and abs(value) < 1e6 else value


def _put(table: Any, name: str, quantity: RawQuantity) -> None:
    """Set a quantity; what is said of the old one besides stays, its sigma where the unit does."""
    old = table.get(name)
    entry = dict(old) if isinstance(old, dict) else {}
    if entry.get("unit") != quantity.unit:
        entry.pop("sigma", None)
    table[name] = tomlkit.inline_table()
    written = {"value": _write_number(quantity.value), "unit": quantity.unit}
    table[name].update({**written, **entry, **written})
    if old is not None:
        table[name].trivia.comment, table[name].trivia.comment_ws = old.trivia.comment, old.trivia.comment_ws


def _find(entries: Any, effect_id: str) -> int | None:
    return next((n for n, e in enumerate(entries) if _read_id(e) == effect_id), None)


def _read_id(entry: Any) -> str:
    return str(entry["id"] if isinstance(entry, dict) else entry)
