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

from ragg_runtime.base.errors import UserError, at, check_keys
from ragg_runtime.instrument import form as forms
from ragg_runtime.instrument.demodulation import Demodulation
from ragg_runtime.instrument.form import Form
from ragg_runtime.instrument.layout import PAPER, Layout, scale
from ragg_runtime.instrument.parameters import PARAMETER, PARAMETERS, Vector
from ragg_runtime.instrument.units import RawQuantity, Units, check_finite, read_si, units


@dataclass(frozen=True)
class EffectSetting:
    """An entry of ``effects`` in model.toml; ``values`` as the user wrote them, with units.

    ``fixed``: parameters that are not fitted.
    ``expression``: ``stage``, ``add`` and ``params`` (name -> at least ``unit``) of an effect that is one line; else
    ``None``.
    """

    id: str
    values: Mapping[str, RawQuantity] = field(default_factory=lambda: MappingProxyType({}))
    expression: Mapping[str, Any] | None = None
    fixed: frozenset[str] = frozenset()

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
        value = read_si(raw, si_unit, g0, place)
        return value if shared else np.broadcast_to(value, (count,)).copy()


@dataclass(frozen=True, eq=False)
class Instrument:
    """One gradiometer in SI: layout, g0 (m/s^2), ``accelerometers`` name -> (n,), one each, effects.

    ``sigmas``: how sure the sheet is of some parameters, name -> (n,). ``widths``: kind of parameter -> how many times wider than
    usual its prior is.
    ``fixed``: parameters that are not fitted, but stay as model.toml has them; ``held``: labels of effects' coefficients likewise.
    ``angle_origin``: where the angle of a disc without an encoder is 0, ``zero`` (of ``time``) or ``first-sample``; ``None``: at
    zero of seconds, at the first of stamps that are instants.
    """

    layout: Layout
    g0: float
    accelerometers: Mapping[str, Vector]
    effects: tuple[EffectSetting, ...] = ()
    path: Path | None = None
    sigmas: Mapping[str, Vector] = field(default_factory=lambda: MappingProxyType({}))
    form: Form = forms.PAPER
    demodulation: Demodulation | None = None
    widths: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    fixed: frozenset[str] = frozenset()
    held: frozenset[str] = frozenset()
    angle_origin: str | None = None

    @classmethod
    def build(
        cls,
        layout: Layout,
        g0: float,
        accelerometers: Mapping[str, ArrayLike],
        *,
        sigmas: Mapping[str, ArrayLike] | None = None,
        **others: Any,
    ) -> Instrument:
        """An instrument from SI values: scalars hold for all accelerometers, missing ones are 0.

        ``others`` are further fields, as they are.
        """
        check_keys(accelerometers, PARAMETER, "[accelerometers]")
        for p in PARAMETERS:
            if p.required and p.name not in accelerometers:
                raise UserError(
                    f"{p.name} ({p.description}) is missing",
                    where=at(others.get("path"), "[accelerometers]"),
                    expected=f'{p.name} = {{ value = ..., unit = "{p.display_unit}" }}',
                )
        vectors = {name: _vector(accelerometers.get(name, 0.0), layout.size) for name in PARAMETER}
        known = {name: _vector(v, layout.size) for name, v in (sigmas or {}).items()}
        made = cls(layout, g0, MappingProxyType(vectors), sigmas=MappingProxyType(known), **others)
        _check_physical(made)
        return made

    def replace(self, **changes: ArrayLike) -> Instrument:
        """The same instrument with some accelerometer parameters changed (SI, scalar or (n,))."""
        check_keys(changes, PARAMETER, "[accelerometers]")
        changed = {name: _vector(v, self.layout.size) for name, v in changes.items()}
        return dataclasses.replace(self, accelerometers=MappingProxyType({**self.accelerometers, **changed}))

    def sigma(self, name: str) -> Vector:
        """How far a parameter of the accelerometers may be from its sheet, (n,) SI: by the sheet, or plausible."""
        said = self.sigmas.get(name)
        usual = PARAMETER[name].plausible_si(self.accelerometers[name], self.g0)
        return (usual if said is None else said) * self.widths.get(name, 1.0)

    def grade(self, name: str | None) -> float:
        """How many times wider the sheet's prior of a parameter is than for a navigation instrument; 1 if it gives none."""
        if name is None or not (name in self.sigmas or name in self.widths):
            return 1.0
        usual = PARAMETER[name].plausible_si(self.accelerometers[name], self.g0)
        return max(1.0, float(np.median(self.sigma(name) / usual)))

    def effect(self, effect_id: str) -> EffectSetting | None:
        """The entry of this effect, or None."""
        return next((e for e in self.effects if e.id == effect_id), None)

    @property
    def radius(self) -> float:
        """Of the first accelerometer, m."""
        return self.layout.places[0].radius

    @property
    def spin_frequency(self) -> float:
        """Of the first accelerometer's disc, Hz."""
        return self.layout.discs[self.layout.places[0].disc].spin_frequency

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


def _vector(value: ArrayLike, count: int) -> Vector:
    vector = np.broadcast_to(np.asarray(value, dtype=np.float64), (count,)).copy()
    vector.flags.writeable = False
    return vector


def _check_physical(i: Instrument) -> None:
    k, of_paper = i.accelerometers, i.layout.of_paper
    positive = {"g0": (i.g0, "m/s^2")}
    if of_paper:  # other discs may be at rest, with accelerometers at their centres
        positive |= {"radius": (i.radius, "m"), "spin_frequency": (i.spin_frequency, "Hz")}
    for name, (value, unit) in positive.items():
        if not (np.isfinite(value) and value > 0):
            raise UserError(
                f"{name} must be positive",
                where=at(i.path, f"[disc] {name}"),
                found=f"{value:g} {unit}",
                expected="a positive number",
            )
    for name, vector in k.items():
        where = at(i.path, f"[accelerometers] {name}")
        check_finite(vector, where)
        if PARAMETER[name].required and np.any(vector == 0):
            raise UserError(f"{name} must not be zero", where=where, found=vector.tolist())
    R = i.radii + k["dR"]
    if np.any(R < 0) or (np.any(R == 0) and of_paper):
        raise UserError(
            "the distance from the disc centre, radius + dR, must be positive",
            where=at(i.path, "[accelerometers] dR"),
            found=f"{R.tolist()} m",
        )
