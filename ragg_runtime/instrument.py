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

from ragg_runtime import model_form
from ragg_runtime.errors import UserError, at, did_you_mean
from ragg_runtime.layout import PAPER, Layout, paper, scale
from ragg_runtime.layout_toml import read_layout
from ragg_runtime.model_form import Form, read_form
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
        self,
        name: str,
        si_unit: str,
        g0: float,
        *,
        shared: bool = False,
        where: str | None = None,
        count: int = PAPER.size,
    ) -> Vector | None:
        """Value of parameter ``name`` in ``si_unit``: (1,) if ``shared``, else (count,); None if not given."""
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
        return _finite(converted if shared else np.broadcast_to(converted, (count,)).copy(), place)


@dataclass(frozen=True, eq=False)
class Instrument:
    """One gradiometer in SI: disc (m, Hz, m/s^2), ``accelerometers`` name -> (n,), one each, effects, layout.

    Every name of :data:`PARAMETERS` is present. Build with :func:`read_instrument` or :meth:`build`. ``radius`` and
    ``spin_frequency`` are those of the first accelerometer and its disc; those of each are in ``layout``.
    """

    radius: float
    spin_frequency: float
    g0: float
    accelerometers: Mapping[str, Vector]
    effects: tuple[EffectSetting, ...] = ()
    path: Path | None = None
    effects_folder: Path | None = None
    form: Form = model_form.PAPER
    layout: Layout = PAPER

    def __post_init__(self) -> None:
        if self.layout.of_paper:  # the paper's one disc, described by radius and spin frequency
            object.__setattr__(self, "layout", paper(self.radius, self.spin_frequency))

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
        form: Form = model_form.PAPER,
        layout: Layout | None = None,
    ) -> Instrument:
        """An instrument from SI values: scalars stand for all accelerometers, missing ones are 0.

        Without a ``layout`` it is the paper's.
        """
        layout = paper(radius, spin_frequency) if layout is None else layout
        _check_names(accelerometers, PARAMETER, "accelerometers")
        for p in PARAMETERS:
            if p.required and p.name not in accelerometers:
                raise UserError(
                    f"{p.name} ({p.description}) is missing",
                    where=at(path, "[accelerometers]"),
                    expected=f'{p.name} = {{ value = ..., unit = "{p.display_unit}" }}',
                )
        vectors = {name: _vector(accelerometers.get(name, 0.0), layout.size) for name in PARAMETER}
        made = cls(
            radius=radius,
            spin_frequency=spin_frequency,
            g0=g0,
            accelerometers=MappingProxyType(vectors),
            effects=tuple(effects),
            path=path,
            effects_folder=effects_folder,
            layout=layout,
            form=form,
        )
        _check_physical(made)
        return made

    def replace(self, **changes: ArrayLike) -> Instrument:
        """The same instrument with some accelerometer parameters changed (SI, scalar or (n,))."""
        _check_names(changes, PARAMETER, "accelerometers")
        vectors = dict(self.accelerometers) | {
            name: _vector(v, self.layout.size) for name, v in changes.items()
        }
        return dataclasses.replace(self, accelerometers=MappingProxyType(vectors))

    def with_effects(self, effects: tuple[EffectSetting, ...]) -> Instrument:
        """The same instrument with another list of effects."""
        return dataclasses.replace(self, effects=tuple(effects))

    def effect(self, effect_id: str) -> EffectSetting | None:
        """The entry of this effect, or None."""
        return next((e for e in self.effects if e.id == effect_id), None)

    @property
    def scale_factor(self) -> float:
        """k_ggi of the first output, in V s^2: volts per s^-2 of gradient (Eq. 15 and 30)."""
        k = self.accelerometers
        return scale(self.layout.outputs[0], k["k_VI"] * k["K1"], self.radii + k["dR"])

    @property
    def radii(self) -> Vector:
        """(n,) m: nominal distance of each accelerometer from the axis of its disc."""
        return np.array([p.radius for p in self.layout.places])

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
    known = ("disc", "accelerometers", "effects", "effects_folder", "model", "g0")
    _check_names(table, known, None, path)
    layout, g0 = _discs(table, path)
    return Instrument.build(
        radius=layout.places[0].radius,
        spin_frequency=layout.discs[layout.places[0].disc].spin_frequency,
        g0=g0,
        accelerometers=_accelerometers(_table(table, "accelerometers", path), g0, path, layout.size),
        effects=_effects(table.get("effects", []), g0, path, layout.size),
        path=path,
        effects_folder=_folder(table.get("effects_folder"), path),
        layout=layout,
        form=read_form(table.get("model"), path),
    )


STANDARD_G0 = 9.8
"""What g means in a model.toml with [[disc]] that does not say it, m/s^2: the paper's value."""


def _discs(table: Mapping[str, Any], path: Path | None) -> tuple[Layout, float]:
    """The layout of [disc] (the paper's) or of [[disc]] tables, and g0."""
    if not isinstance(table.get("disc"), list):
        if "g0" in table:
            raise UserError("g0 belongs into the table [disc]", where=at(path, "g0"))
        disc = _disc(_table(table, "disc", path), path)
        return paper(disc["radius"], disc["spin_frequency"]), disc["g0"]
    given = [("g0", table["g0"])] if "g0" in table else []
    for number, entry in enumerate(table["disc"], 1):
        if isinstance(entry, dict) and "g0" in entry:
            given.append((f"[[disc]] {number}: g0", entry["g0"]))
    found = {
        float(_si(read_quantity(raw, at(path, key), count=1), DISC_UNITS["g0"], None, at(path, key))[0])
        for key, raw in given
    }
    if len(found) > 1:
        raise UserError("g0 is given twice", where=path, found=sorted(found), expected="one value")
    return read_layout(table["disc"], path), found.pop() if found else STANDARD_G0


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


def _accelerometers(table: Mapping[str, Any], g0: float, path: Path | None, count: int) -> dict[str, Vector]:
    _check_names(table, PARAMETER, "accelerometers", path)
    found = {}
    for name, raw in table.items():
        place = at(path, f"[accelerometers] {name}")
        found[name] = _si(read_quantity(raw, place, count=count), PARAMETER[name].si_unit, g0, place)
    return found


def _si(quantity: RawQuantity, si_unit: str, g0: float | None, where: str) -> Vector:
    value = np.atleast_1d(np.asarray(quantity.value, dtype=np.float64))
    if quantity.unit == si_unit:  # as g0 mostly is: nothing need be known of units for it
        return _finite(value, where)
    known = units(1.0 if g0 is None else g0)
    if g0 is None and known.uses_g(quantity.unit, where):
        raise UserError("g cannot be used here: g0 defines it", where=where, found=quantity, expected=si_unit)
    return _finite(np.asarray(known.to_si(value, quantity.unit, si_unit, where), dtype=np.float64), where)


def _effects(
    entries: object, g0: float, path: Path | None, count: int = PAPER.size
) -> tuple[EffectSetting, ...]:
    if not isinstance(entries, list):
        raise UserError(
            "effects must be a list", where=at(path, "effects"), found=repr(entries), expected='["lag"]'
        )
    found: list[EffectSetting] = []
    for number, entry in enumerate(entries, 1):
        setting = _effect(entry, at(path, f"effects, entry {number}"), units(g0), count)
        if any(e.id == setting.id for e in found):
            raise UserError(
                f"the effect {setting.id!r} is listed twice",
                where=at(path, "effects"),
                remedy="remove one entry",
            )
        found.append(setting)
    return tuple(found)


def _effect(entry: object, where: str, known: Units, count: int) -> EffectSetting:
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
    values = {name: known.quantity(raw, f"{where}: {name}", count=count) for name, raw in own.items()}
    expression = _expression(entry, where, known)
    if expression is not None:
        _check_names(values, expression["params"], None, where)
        for name, parameter in expression["params"].items():
            if "value" in parameter:
                values[name] = known.quantity(
                    {"value": parameter["value"], "unit": parameter["unit"]}, f"{where}: {name}", count=count
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


def _vector(value: ArrayLike, count: int) -> Vector:
    vector = np.broadcast_to(np.asarray(value, dtype=np.float64), (count,)).copy()
    vector.flags.writeable = False
    return vector


def _finite(value: Vector, where: str) -> Vector:
    if not np.all(np.isfinite(value)):
        raise UserError("the value is not finite in SI", where=where, found=value, expected="finite numbers")
    return value


def _check_physical(instrument: Instrument) -> None:
    path, k = instrument.path, instrument.accelerometers
    own_discs = not instrument.layout.of_paper  # which may stand still, with accelerometers at their centres
    for name in ("g0",) if own_discs else DISC_UNITS:
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
    R = instrument.radii + k["dR"]
    if np.any(R < 0) or (np.any(R == 0) and not own_discs):
        raise UserError(
            "the distance from the disc centre, radius + dR, must be positive",
            where=at(path, "[accelerometers] dR"),
            found=f"{R.tolist()} m",
        )
