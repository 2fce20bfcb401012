"""The ``[[disc]]`` tables of a model.toml: any discs and accelerometers, read with one error for each thing wrong."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ragg_runtime.base.errors import UserError, at, did_you_mean
from ragg_runtime.base.names import is_name, read_name
from ragg_runtime.instrument.layout import (
    TANGENTIAL,
    X_AXIS,
    Z_AXIS,
    Disc,
    Layout,
    Place,
    Vector3,
    perpendicular,
    turned_with,
    unit,
)
from ragg_runtime.instrument.units import read_quantity, units

DISC_KEYS = ("name", "radius", "spin_frequency", "axis", "zero", "g0", "accelerometer")
PLACE_KEYS = ("name", "angle", "sign", "output", "radius", "height", "direction")

MOST = 64
"""Accelerometers that a layout may have: many times what any instrument has, few enough for a fit."""

_OTHERS = re.compile(
    r"time|line|(a|omega|omegadot)_[xyz]|Gamma_[xyz]{2}|spin_angle(_.*)?|inline|cross|temperature|roll|pitch|yaw|pressure|B_[xyz]"
)
"""Columns that mean something else in every flight."""

_EXAMPLE = '[[disc.accelerometer]]\\nname = "A1"\\nangle = "0 deg"\\nsign = 1\\noutput = "G_out"'


def read_layout(tables: Sequence[Any], path: Path | None) -> Layout:
    """The layout that ``[[disc]]`` tables describe; UserError names what is wrong."""
    discs: list[Disc] = []
    places: list[Place] = []
    outputs: dict[str, int] = {}
    for number, table in enumerate(tables, 1):
        if not isinstance(table, dict):
            raise UserError("disc must be a table", where=path, found=repr(table), expected="[[disc]]")
        named = table["name"] if is_name(table.get("name")) else str(number)
        where = at(path, f"[[disc]] {named}")
        _known(table, DISC_KEYS, where)
        discs.append(_disc(table, where, single=len(tables) == 1))
        radius = None if "radius" not in table else _number(table, "radius", "m", where)
        entries = table.get("accelerometer", [])
        if not isinstance(entries, list):
            raise UserError("accelerometer must be a list of tables", where=where, expected=_EXAMPLE)
        for k, entry in enumerate(entries, 1):
            places.append(_place(entry, at(where, f"accelerometer {k}"), number - 1, radius, outputs))
    layout = Layout(discs=tuple(discs), places=tuple(places), output_names=tuple(outputs))
    _check(layout, path)
    return layout


def _disc(table: Mapping[str, Any], where: str, *, single: bool) -> Disc:
    name = _text(table, "name", where, "A" if single else None)
    axis = _direction(table, "axis", where, Z_AXIS)
    zero = perpendicular(turned_with(axis, X_AXIS), axis) if axis != Z_AXIS else X_AXIS
    if "zero" in table:
        given = _direction(table, "zero", where, X_AXIS)
        if abs(math.fsum(a * b for a, b in zip(axis, given, strict=True))) > 1 - 1e-9:
            raise UserError("zero must not lie along the axis", where=where, found=list(given))
        zero = perpendicular(given, axis)
    return Disc(
        name=name,
        spin_frequency=_number(table, "spin_frequency", "Hz", where),
        axis=axis,
        zero=zero,
        angle_column="spin_angle" if single else f"spin_angle_{name}",
    )


def _place(entry: Any, where: str, disc: int, radius: float | None, outputs: dict[str, int]) -> Place:
    if not isinstance(entry, dict):
        raise UserError("an accelerometer must be a table", where=where, found=repr(entry), expected=_EXAMPLE)
    _known(entry, PLACE_KEYS, where)
    output = _text(entry, "output", where, None)
    sign = entry.get("sign")
    if isinstance(sign, bool) or sign not in (1, -1):
        raise UserError("sign must be 1 or -1", where=where, found=repr(sign), expected="sign = 1")
    own = _number(entry, "radius", "m", where) if "radius" in entry else radius
    if own is None:
        raise UserError("radius is missing", where=where, expected='radius = "0.1 m", here or in [[disc]]')
    return Place(
        name=_text(entry, "name", where, None),
        disc=disc,
        angle=_number(entry, "angle", "rad", where),
        radius=own,
        height=_number(entry, "height", "m", where) if "height" in entry else 0.0,
        direction=_direction(entry, "direction", where, TANGENTIAL),
        sign=int(sign),
        output=outputs.setdefault(output, len(outputs)),
    )


def _check(layout: Layout, path: Path | None) -> None:
    where = at(path, "[[disc]]")
    if not layout.places:
        raise UserError("there is no accelerometer", where=where, expected=_EXAMPLE)
    if len(layout.places) > MOST:
        raise UserError(
            "there are too many accelerometers",
            where=where,
            found=len(layout.places),
            expected=f"at most {MOST}",
        )
    for what, names in (("disc", [d.name for d in layout.discs]), ("accelerometer", list(layout.names))):
        twice = sorted({n for n in names if names.count(n) > 1})
        if twice:
            raise UserError(
                f"two of the same name: {what} {twice[0]!r}",
                where=where,
                remedy="give each a name of its own",
            )
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
    taken = {c for j in range(layout.size) for c in layout.voltage_columns(j)}
    for name in layout.output_names:
        if name in taken:
            raise UserError(f"the output {name} has the name of a voltage", where=where)
        if _OTHERS.fullmatch(name):
            raise UserError(
                f"the output {name} has the name of another column", where=where, expected="such as G_out_A"
            )


def _known(table: Mapping[str, Any], keys: Sequence[str], where: str) -> None:
    for name in table:
        if name not in keys:
            raise UserError(
                f"unknown key {name!r}",
                where=where,
                expected="one of " + ", ".join(keys),
                remedy=did_you_mean(str(name), keys),
            )


def _text(table: Mapping[str, Any], key: str, where: str, default: str | None) -> str:
    example = {"name": '"A1"', "output": '"G_out"'}[key]
    if key not in table and default is None:
        raise UserError(f"{key} is missing", where=where, expected=f"{key} = {example}")
    return read_name(table.get(key, default), at(where, key), example)


def _number(table: Mapping[str, Any], key: str, si_unit: str, where: str) -> float:
    place = at(where, key)
    if key not in table:
        unit_ = {"rad": "deg", "m": "m", "Hz": "Hz"}[si_unit]
        raise UserError(f"{key} is missing", where=where, expected=f'{key} = "... {unit_}"')
    raw = table[key]
    if isinstance(raw, int | float) and not isinstance(raw, bool) and raw == 0:
        return 0.0  # nothing has no unit
    q = read_quantity(raw, place, count=1)
    known = units(1.0)
    if known.uses_g(q.unit, place):
        raise UserError("g cannot be used here", where=place, found=q, expected=si_unit)
    value = float(known.to_si(np.asarray(q.value, dtype=np.float64), q.unit, si_unit, place))
    if not math.isfinite(value) or (key == "radius" and value < 0):
        raise UserError(
            f"{key} is out of range", where=place, found=q, expected="a finite number, not negative"
        )
    return value


def _direction(table: Mapping[str, Any], key: str, where: str, default: Vector3) -> Vector3:
    if key not in table:
        return default
    raw = table[key]
    numbers = isinstance(raw, list) and len(raw) == 3
    numbers = numbers and all(isinstance(v, int | float) and not isinstance(v, bool) for v in raw)
    if not numbers or not all(math.isfinite(float(v)) for v in raw) or not any(v != 0 for v in raw):
        raise UserError(
            f"{key} is not a direction",
            where=where,
            found=repr(raw),
            expected=f"{key} = [0, 0, 1], three numbers",
        )
    return unit([float(v) for v in raw])
