"""The instrument: nominal parameters and effects of one gradiometer, read from ``model.toml``."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ragg_runtime.base.errors import UserError, at, did_you_mean
from ragg_runtime.instrument.form import PAPER, Form
from ragg_runtime.instrument.parameters import DISC_UNITS, PARAMETER, PARAMETERS, Vector
from ragg_runtime.instrument.units import RawQuantity, Units, units


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

    Every name of :data:`PARAMETERS` is present. Build with :func:`read_instrument` or :meth:`build`.
    """

    radius: float
    spin_frequency: float
    g0: float
    accelerometers: Mapping[str, Vector]
    effects: tuple[EffectSetting, ...] = ()
    path: Path | None = None
    effects_folder: Path | None = None
    form: Form = PAPER

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
        form: Form = PAPER,
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
            radius, spin_frequency, g0, MappingProxyType(vectors), tuple(effects), path, effects_folder, form
        )
        _check_physical(made)
        return made

    def replace(self, **changes: ArrayLike) -> Instrument:
        """The same instrument with some accelerometer parameters changed (SI, scalar or (4,))."""
        _check_names(changes, PARAMETER, "accelerometers")
        vectors = dict(self.accelerometers) | {name: _vector(v) for name, v in changes.items()}
        return dataclasses.replace(self, accelerometers=MappingProxyType(vectors))

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
