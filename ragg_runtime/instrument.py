"""The instrument: nominal parameters and effects of one gradiometer, read from ``model.toml``."""

from __future__ import annotations

import dataclasses
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ragg_runtime.errors import UserError, at, did_you_mean
from ragg_runtime.parameters import DISC_UNITS, PARAMETER, PARAMETERS, Parameter, Vector
from ragg_runtime.units import RawQuantity, Units, read_quantity, units

__all__ = [
    "PARAMETER",
    "PARAMETERS",
    "EffectSetting",
    "Instrument",
    "Parameter",
    "parse_instrument",
    "read_instrument",
    "read_text",
]


@dataclass(frozen=True)
class EffectSetting:
    """An entry of ``effects`` in model.toml.

    ``values`` holds the parameters as the user wrote them (value and unit): the effect's own definition
    knows their SI unit, see :meth:`si`. ``expression`` is ``None`` for an effect of the catalogue, else the
    keys ``stage``, ``add`` and ``params`` of an effect that the user wrote as one line; ``params`` maps the
    name of a parameter to at least ``{"unit": ...}``.
    """

    id: str
    values: Mapping[str, RawQuantity] = field(default_factory=lambda: MappingProxyType({}))
    expression: Mapping[str, Any] | None = None

    def si(
        self, name: str, si_unit: str, g0: float, *, shared: bool = False, where: str | None = None
    ) -> Vector | None:
        """Value of parameter ``name`` in ``si_unit``: (1,) if ``shared``, else (4,); None if not given."""
        if name not in self.values:
            return None
        raw = self.values[name]
        place = at(where, f"effect {self.id}", name)
        if shared and isinstance(raw.value, tuple):
            raise UserError(
                "the parameter is shared by the accelerometers", where=place, found=raw, expected="one number"
            )
        value = np.atleast_1d(np.asarray(raw.value, dtype=np.float64))
        converted = np.asarray(units(g0).to_si(value, raw.unit, si_unit, place), dtype=np.float64)
        return _finite(converted if shared else np.broadcast_to(converted, (4,)).copy(), place)


@dataclass(frozen=True, eq=False)
class Instrument:
    """One gradiometer in SI: disc (m, Hz, m/s^2), ``accelerometers`` name -> (4,) for A1 ... A4, effects.

    Every name of :data:`PARAMETERS` is present. ``sigmas`` holds how sure the sheet is of some of them, name -> (4,);
    the others are as sure as is plausible (:meth:`sigma`). Build with :func:`read_instrument` or :meth:`build`.
    """

    radius: float
    spin_frequency: float
    g0: float
    accelerometers: Mapping[str, Vector]
    effects: tuple[EffectSetting, ...] = ()
    path: Path | None = None
    effects_folder: Path | None = None
    sigmas: Mapping[str, Vector] = field(default_factory=lambda: MappingProxyType({}))

    @classmethod
    def build(
        cls,
        radius: float,
        spin_frequency: float,
        g0: float,
        accelerometers: Mapping[str, ArrayLike],
        effects: tuple[EffectSetting, ...] = (),
        path: Path | None = None,
        effects_folder: Path | None = None,
        sigmas: Mapping[str, ArrayLike] | None = None,
    ) -> Instrument:
        """An instrument from SI values: scalars stand for all four accelerometers, missing ones are 0."""
        _check_names(accelerometers, PARAMETER, "accelerometers")
        for p in PARAMETERS:
            if p.required and p.name not in accelerometers:
                raise UserError(
                    f"{p.name} ({p.description}) is missing",
                    where=at(path, "[accelerometers]"),
                    expected=f'{p.name} = {{ value = ..., unit = "{p.display_unit}" }}',
                )
        vectors = {name: _vector(accelerometers.get(name, 0.0)) for name in PARAMETER}
        made = cls(
            radius=radius,
            spin_frequency=spin_frequency,
            g0=g0,
            accelerometers=MappingProxyType(vectors),
            effects=tuple(effects),
            path=path,
            effects_folder=effects_folder,
            sigmas=MappingProxyType({name: _vector(v) for name, v in (sigmas or {}).items()}),
        )
        _check_physical(made)
        return made

    def replace(self, **changes: ArrayLike) -> Instrument:
        """The same instrument with some accelerometer parameters changed (SI, scalar or (4,))."""
        _check_names(changes, PARAMETER, "accelerometers")
        vectors = dict(self.accelerometers) | {name: _vector(v) for name, v in changes.items()}
        return dataclasses.replace(self, accelerometers=MappingProxyType(vectors))

    def sigma(self, name: str) -> Vector:
        """How far a parameter of the accelerometers may be from its sheet, (4,) SI: as the sheet says, or plausible."""
        if name in self.sigmas:
            return self.sigmas[name]
        return PARAMETER[name].plausible_si(self.accelerometers[name], self.g0)

    def with_effects(self, effects: tuple[EffectSetting, ...]) -> Instrument:
        """The same instrument with another list of effects."""
        return dataclasses.replace(self, effects=tuple(effects))

    def effect(self, effect_id: str) -> EffectSetting | None:
        """The entry of this effect, or None."""
        return next((e for e in self.effects if e.id == effect_id), None)

    @property
    def scale_factor(self) -> float:
        """k_ggi = sum of k_VI K1 R_j, in V s^2: volts of G_out per s^-2 of gradient (Eq. 15)."""
        k = self.accelerometers
        return float(np.sum(k["k_VI"] * k["K1"] * (self.radius + k["dR"])))

    @property
    def units(self) -> Units:
        """Units with this instrument's g0."""
        return units(self.g0)


def read_instrument(path: Path | str) -> Instrument:
    """The instrument of a ``model.toml``; UserError names file and key, what is there and what should be."""
    path = Path(path)
    text = read_text(path)
    return parse_instrument(text, path)


def read_text(path: Path, longest: int = 1 << 20) -> str:
    """The text of a user's file, UTF-8 with or without a byte-order mark, of at most ``longest`` bytes."""
    try:
        # A pipe or a device would be waited for, or never end.
        if path.exists() and not path.is_file() and not path.is_dir():
            raise UserError("a file is needed here, not a pipe or a device", where=path)
        with path.open("rb") as stream:
            data = stream.read(longest + 1)
        if len(data) > longest:
            raise UserError("the file is too long", where=path, expected=f"at most {longest} bytes")
        return data.decode("utf-8-sig")
    except FileNotFoundError:
        raise UserError(
            "the file does not exist", where=path, remedy="check the name and the folder"
        ) from None
    except IsADirectoryError:
        raise UserError("a file is needed here, not a directory", where=path) from None
    except UnicodeDecodeError as error:
        raise UserError(
            "the file is not UTF-8 text",
            where=path,
            found=f"byte {error.object[error.start]:#04x} at {error.start}",
        ) from None
    except OSError as error:
        raise UserError("the file cannot be read", where=path, found=error.strerror) from None


def parse_instrument(text: str, path: Path | None = None) -> Instrument:
    """As :func:`read_instrument`, from the text of the file; ``path`` names it in messages."""
    try:
        table = tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # numbers of thousands of digits, brackets in brackets
        raise UserError(
            "not a TOML file", where=path, found=str(error), expected="the form of model.toml"
        ) from None
    _check_names(table, ("disc", "accelerometers", "effects", "effects_folder"), None, path)
    disc = _disc(_table(table, "disc", path), path)
    accelerometers, sigmas = _accelerometers(_table(table, "accelerometers", path), disc["g0"], path)
    return Instrument.build(
        radius=disc["radius"],
        spin_frequency=disc["spin_frequency"],
        g0=disc["g0"],
        accelerometers=accelerometers,
        sigmas=sigmas,
        effects=_effects(table.get("effects", []), disc["g0"], path),
        path=path,
        effects_folder=_folder(table.get("effects_folder"), path),
    )


def _table(table: Mapping[str, Any], name: str, path: Path | None) -> Mapping[str, Any]:
    if name not in table:
        raise UserError(f"the table [{name}] is missing", where=path)
    found = table[name]
    if not isinstance(found, dict):
        raise UserError(f"{name} must be a table", where=path, found=repr(found), expected=f"[{name}]")
    return found


def _disc(table: Mapping[str, Any], path: Path | None) -> dict[str, float]:
    _check_names(table, DISC_UNITS, "disc", path)
    for name in DISC_UNITS:
        if name not in table:
            raise UserError(
                f"{name} is missing", where=at(path, "[disc]"), expected=f'{name} = "... {DISC_UNITS[name]}"'
            )
    return {
        # g0 defines g and so cannot be given in g; radius and frequency do not depend on it.
        name: float(
            _si(
                read_quantity(table[name], at(path, f"[disc] {name}"), count=1),
                unit,
                None,
                at(path, f"[disc] {name}"),
            )[0]
        )
        for name, unit in DISC_UNITS.items()
    }


def _accelerometers(
    table: Mapping[str, Any], g0: float, path: Path | None
) -> tuple[dict[str, Vector], dict[str, Vector]]:
    """Values, and how sure the sheet is of those for which it says so, in SI."""
    _check_names(table, PARAMETER, "accelerometers", path)
    found, sigmas = {}, {}
    for name, raw in table.items():
        place = at(path, f"[accelerometers] {name}")
        si_unit = PARAMETER[name].si_unit
        own = {k: v for k, v in raw.items() if k != "sigma"} if isinstance(raw, dict) else raw
        quantity = read_quantity(own, place)
        found[name] = _si(quantity, si_unit, g0, place)
        if isinstance(raw, dict) and "sigma" in raw:
            where = f"{place}, sigma"
            sigma = read_quantity({"value": raw["sigma"], "unit": quantity.unit}, where)
            sigmas[name] = _si(sigma, si_unit, g0, where)
            if np.any(sigmas[name] <= 0):
                expected = f"one or four above 0, in {quantity.unit}; none if the sheet does not say"
                raise UserError("sigma must be positive", where=where, found=raw["sigma"], expected=expected)
    return found, sigmas


def _si(quantity: RawQuantity, si_unit: str, g0: float | None, where: str) -> Vector:
    value = np.atleast_1d(np.asarray(quantity.value, dtype=np.float64))
    if quantity.unit == si_unit:  # as g0 mostly is: nothing need be known of units for it
        return _finite(value, where)
    known = units(1.0 if g0 is None else g0)
    if g0 is None and known.uses_g(quantity.unit, where):
        raise UserError("g cannot be used here: g0 defines it", where=where, found=quantity, expected=si_unit)
    return _finite(np.asarray(known.to_si(value, quantity.unit, si_unit, where), dtype=np.float64), where)


def _effects(entries: object, g0: float, path: Path | None) -> tuple[EffectSetting, ...]:
    if not isinstance(entries, list):
        raise UserError(
            "effects must be a list", where=at(path, "effects"), found=repr(entries), expected='["lag"]'
        )
    found: list[EffectSetting] = []
    for number, entry in enumerate(entries, 1):
        setting = _effect(entry, at(path, f"effects, entry {number}"), units(g0))
        if any(e.id == setting.id for e in found):
            raise UserError(
                f"the effect {setting.id!r} is listed twice",
                where=at(path, "effects"),
                remedy="remove one entry",
            )
        found.append(setting)
    return tuple(found)


def _effect(entry: object, where: str, known: Units) -> EffectSetting:
    if isinstance(entry, str):
        entry = {"id": entry}
    if not isinstance(entry, dict) or not isinstance(entry.get("id"), str) or not entry["id"].strip():
        raise UserError(
            "not an effect",
            where=where,
            found=repr(entry),
            expected='"lag" or { id = "lag", tau = { value = [1, 1, 1, 1], unit = "ms" } }',
        )
    effect_id = entry["id"]
    where = f"{where} ({effect_id})"
    own = {name: raw for name, raw in entry.items() if name not in ("id", "stage", "add", "params")}
    if ("stage" in entry or "add" in entry) and "params" not in entry:
        # An effect in one line: its parameters stand beside stage and add, with or without a value.
        entry = {k: entry[k] for k in ("id", "stage", "add") if k in entry} | {"params": own}
        own = {}
    values = {name: known.quantity(raw, f"{where}: {name}") for name, raw in own.items()}
    expression = _expression(entry, where, known)
    if expression is not None:
        _check_names(values, expression["params"], None, where)
        for name, parameter in expression["params"].items():
            if "value" in parameter:
                values[name] = known.quantity(
                    {"value": parameter["value"], "unit": parameter["unit"]}, f"{where}: {name}"
                )
    return EffectSetting(effect_id, MappingProxyType(values), expression)


def _expression(entry: Mapping[str, Any], where: str, known: Units) -> Mapping[str, Any] | None:
    keys = [k for k in ("stage", "add", "params") if k in entry]
    if not keys:
        return None
    example = 'stage = "transducer", add = "K_x * f_i**3", K_x = { value = 0, unit = "ug/g^3" }'
    for key, kind in (("stage", str), ("add", str), ("params", dict)):
        if not isinstance(entry.get(key), kind):
            raise UserError(
                f"the effect's {key} is missing or not a {'table' if kind is dict else 'text'}",
                where=where,
                found=repr(entry.get(key)),
                expected=example,
            )
    params: dict[str, Mapping[str, Any]] = {}
    for name, raw in entry["params"].items():
        table = {"unit": raw} if isinstance(raw, str) else raw
        if not isinstance(table, dict) or not isinstance(table.get("unit"), str):
            raise UserError(
                "the parameter needs a unit", where=f"{where}: {name}", found=repr(raw), expected=example
            )
        known.parse(table["unit"], f"{where}: {name}")
        params[name] = MappingProxyType(table)
    return MappingProxyType(
        {"stage": entry["stage"], "add": entry["add"], "params": MappingProxyType(params)}
    )


def _folder(raw: object, path: Path | None) -> Path | None:
    if raw is None:
        return None
    if not isinstance(raw, str) or not raw:
        raise UserError("effects_folder must be a path", where=path, found=repr(raw), expected='"my_effects"')
    folder = (path.parent if path else Path()) / raw
    if path is not None and not folder.is_dir():
        raise UserError(
            "the folder of own effects does not exist", where=at(path, "effects_folder"), found=folder
        )
    return folder


def _check_names(names: Any, known: Any, table: str | None, where: object = None) -> None:
    for name in names:
        if name not in known:
            raise UserError(
                f"unknown key {name!r}",
                where=at(where, None if table is None else f"[{table}]"),
                expected="one of " + ", ".join(known),
                remedy=did_you_mean(str(name), known),
            )


def _vector(value: ArrayLike) -> Vector:
    vector = np.broadcast_to(np.asarray(value, dtype=np.float64), (4,)).copy()
    vector.flags.writeable = False
    return vector


def _finite(value: Vector, where: str) -> Vector:
    if not np.all(np.isfinite(value)):
        raise UserError("the value is not finite in SI", where=where, found=value, expected="finite numbers")
    return value


def _check_physical(instrument: Instrument) -> None:
    path, k = instrument.path, instrument.accelerometers
    for name in DISC_UNITS:
        value = getattr(instrument, name)
        if not (np.isfinite(value) and value > 0):
            raise UserError(
                f"{name} must be positive",
                where=at(path, f"[disc] {name}"),
                found=f"{value:g} {DISC_UNITS[name]}",
                expected="a positive number",
            )
    for name, vector in k.items():
        _finite(vector, at(path, f"[accelerometers] {name}"))
    for name in ("K1", "k_VI"):
        if np.any(k[name] == 0):
            raise UserError(
                f"{name} must not be zero", where=at(path, f"[accelerometers] {name}"), found=k[name].tolist()
            )
    if np.any(instrument.radius + k["dR"] <= 0):
        raise UserError(
            "the distance from the disc centre, radius + dR, must be positive",
            where=at(path, "[accelerometers] dR"),
            found=f"{(instrument.radius + k['dR']).tolist()} m",
        )
