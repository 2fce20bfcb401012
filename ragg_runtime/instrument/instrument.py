"""The instrument of a ``model.toml``: parameters with units and plausible errors, form of the model, effects."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ragg_runtime.base.errors import UserError, at, check_choice, check_keys, check_table
from ragg_runtime.instrument.layout import PAPER, Layout, scale
from ragg_runtime.instrument.units import STANDARD_G0, RawQuantity, Units, read_quantity, read_si, units

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class AccelerometerParameter:
    """A parameter of an accelerometer; 0 where model.toml leaves it out, unless ``required``.

    ``plausible``: a usual error of the test sheet, in ``display_unit``; if ``relative``, a fraction of the nominal
    value.
    """

    name: str
    symbol: str
    si_unit: str
    display_unit: str
    description: str
    plausible: float
    relative: bool = False
    required: bool = False

    def plausible_si(self, nominal: Vector, g0: float) -> Vector:
        """Plausible error of each value of ``nominal`` (any shape), in ``si_unit``, with g = ``g0`` m/s^2."""
        if self.relative:
            return np.abs(nominal) * self.plausible
        return np.full_like(nominal, _convert(self.plausible, self.display_unit, self.si_unit, g0))


@cache  # a search for mistakes asks a thousand times
def _convert(value: float, unit: str, si_unit: str, g0: float) -> float:
    return units(g0).to_si(value, unit, si_unit)


def _second_order(index: int, product: str) -> AccelerometerParameter:
    text = f"second-order coefficient of {product}"
    return AccelerometerParameter(f"K{index}", f"K_{index}", "1/(m/s^2)", "ug/g^2", text, 20.0)


def _angle(name: str, symbol: str, text: str) -> AccelerometerParameter:
    return AccelerometerParameter(name, symbol, "rad", "arcsec", text, 100.0)


PARAMETERS: tuple[AccelerometerParameter, ...] = (
    AccelerometerParameter("dR", "dR", "m", "um", "radial distance error", 50.0),
    _angle("beta_x", r"\beta_x", "altitude angle of the mounting position"),
    _angle("beta_z", r"\beta_z", "initial phase angle of the mounting position"),
    _angle("vartheta_x", r"\vartheta_x", "misalignment about the tangential axis"),
    _angle("vartheta_y", r"\vartheta_y", "misalignment about the radial axis"),
    _angle("vartheta_z", r"\vartheta_z", "misalignment about the axial axis"),
    AccelerometerParameter("K0", "K_0", "m/s^2", "ug", "null bias", 50.0),
    AccelerometerParameter(
        "K1", "K_1", "A/(m/s^2)", "mA/g", "linear scale factor", 1e-3, relative=True, required=True
    ),
    _second_order(2, "f_i^2"),
    _second_order(4, "f_i f_p"),
    _second_order(5, "f_o^2"),
    _second_order(6, "f_i f_o"),
    _second_order(7, "f_p^2"),
    _second_order(8, "f_o f_p"),
    AccelerometerParameter(
        "k_VI", "k_{V/I}", "V/A", "ohm", "current-to-voltage gain", 1e-3, relative=True, required=True
    ),
)
"""The accelerometer's parameters, in the order in which every parameter vector holds them."""

# the same by name
PARAMETER: Mapping[str, AccelerometerParameter] = MappingProxyType({p.name: p for p in PARAMETERS})

DISC_UNITS: Mapping[str, str] = MappingProxyType({"radius": "m", "spin_frequency": "Hz", "g0": "m/s^2"})


@dataclass(frozen=True)
class Form:
    """The table ``[model]``; what it leaves out is the paper's.

    ``kinematics``: ``platform`` (Eq. 9) or ``full`` (of the disc, which turns). ``mounting``: power to which rotations
    are kept, or ``exact``. ``misalignment``: 1 (C of Eq. 2) or ``exact``. ``second_order_angles``: whether second-order
    terms see the force along the axes as they are.
    """

    kinematics: Literal["platform", "full"] = "platform"
    mounting: int | str = 1
    misalignment: int | str = 1
    second_order_angles: bool = False

    @property
    def preset(self) -> str | None:
        """``paper`` or ``exact``, if the order is one of these."""
        return next((name for name, order in PRESETS.items() if order == self.order), None)

    @property
    def order(self) -> Mapping[str, int | str | bool]:
        return {k: v for k, v in asdict(self).items() if k != "kinematics"}

    def words(self) -> str:
        """In half a sentence."""
        order = self.preset or ", ".join(
            f'{k} = "{v}"' if isinstance(v, str) else f"{k} = {str(v).lower()}" for k, v in self.order.items()
        )
        return f"kinematics {self.kinematics}, order {order}"


PAPER_FORM = Form()

PRESETS: Mapping[str, Mapping[str, int | str | bool]] = {
    "paper": PAPER_FORM.order,
    "exact": Form(mounting="exact", misalignment="exact", second_order_angles=True).order,
}

_CHOICES: Mapping[str, tuple[int | str | bool, ...]] = {
    "mounting": (1, 2, "exact"),
    "misalignment": (1, "exact"),
    "second_order_angles": (True, False),
}


def read_form(table: object, path: Path | None = None) -> tuple[Form, str | None]:
    """``[model]`` of a parsed model.toml, and its ``angle_origin``; ``None``: it is not there, which means the paper's."""
    where = at(path, "[model]")
    table = check_table({} if table is None else table, "model", path, "[model]")
    check_keys(table, ("kinematics", "order", "angle_origin"), where)
    kinematics = check_choice(
        table.get("kinematics", PAPER_FORM.kinematics), ("platform", "full"), f"{where} kinematics"
    )
    if "angle_origin" in table:
        check_choice(table["angle_origin"], ("zero", "first-sample"), f"{where} angle_origin")
    order = _read_order(table.get("order", {}), f"{where} order")
    return Form(kinematics=kinematics, **order), table.get("angle_origin")


def _read_order(order: object, where: str) -> dict[str, Any]:
    if isinstance(order, str):
        return dict(PRESETS[check_choice(order, tuple(PRESETS), where)])
    if not isinstance(order, dict):
        expected = '"paper", "exact" or { mounting = 1, misalignment = 1, second_order_angles = false }'
        raise UserError("the order is invalid", where=where, found=repr(order), expected=expected)
    check_keys(order, _CHOICES, where)
    return {k: check_choice(v, _CHOICES[k], f"{where}: {k}") for k, v in order.items()}


# --- [demodulator] of model.toml or of a mapping: how inline and cross were made before they were recorded ---

# of a Butterworth low-pass: beyond it, at a hundredth of the sampling rate, its sections lose their precision
MOST_ORDER = 12


@dataclass(frozen=True)
class Demodulation:
    """A low-pass of the mixed output; ``None``: the usual ``cutoff``, Hz, or ``order``, which fir does not have."""

    kind: str = "fir"
    cutoff: float | None = None
    order: int | None = None

    def words(self) -> str:
        """In half a sentence."""
        text = {
            "fir": "the linear-phase low-pass of this program",
            "butterworth": f"a Butterworth low-pass, forward and backward, of order {self.order}",
            "causal": f"a causal Butterworth low-pass of order {self.order}",
        }[self.kind]
        return text + (f" at {self.cutoff:.3g} Hz" if self.cutoff is not None else "")

    def entries(self) -> dict[str, str | int]:
        """Keys and values for a file."""
        cutoff = {} if self.cutoff is None else {"cutoff": f"{self.cutoff} Hz"}
        return {"kind": self.kind, **cutoff, **({} if self.order is None else {"order": self.order})}


OURS = Demodulation()


def read_demodulation(table: object, where: str) -> Demodulation | None:
    """``[demodulator]`` of a parsed file; ``None``: it is not there. UserError names the key."""
    if table is None:
        return None
    table = check_table(table, "demodulator", where, "[demodulator]")
    kind = table.get("kind", "fir")
    check_choice(kind, ("fir", "butterworth", "causal"), at(where, "kind"), "there is no such demodulator")
    check_keys(table, ("kind", "cutoff") if kind == "fir" else ("kind", "cutoff", "order"), where)
    if missing := [k for k in ("cutoff", "order") if k not in table and kind != "fir"]:
        raise UserError(
            f"the demodulator {kind} is not described",
            where=where,
            found=f"no {', '.join(missing)}",
            expected="cutoff, order",
            remedy="ask whoever made the channels",
        )
    order = table.get("order")
    if order is not None and not (type(order) is int and 1 <= order <= MOST_ORDER):
        raise UserError(
            "no such order", where=at(where, "order"), found=repr(order)[:60], expected=f"1 to {MOST_ORDER}"
        )
    return Demodulation(
        kind, _read_cutoff(table["cutoff"], at(where, "cutoff")) if "cutoff" in table else None, order
    )


def _read_cutoff(raw: object, where: str) -> float:
    value = float(read_si(read_quantity(raw, where, count=1), "Hz", STANDARD_G0, where)[0])
    if value <= 0.0:
        raise UserError("cutoff must be positive", where=where, found=str(raw)[:60])
    return value


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
    form: Form = PAPER_FORM
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
        **fields: Any,
    ) -> Instrument:
        """An instrument from SI values: scalars hold for all accelerometers, missing ones are 0.

        ``fields`` are further fields, as they are.
        """
        check_keys(accelerometers, PARAMETER, "[accelerometers]")
        for p in PARAMETERS:
            if p.required and p.name not in accelerometers:
                raise UserError(
                    f"{p.name} ({p.description}) is missing",
                    where=at(fields.get("path"), "[accelerometers]"),
                    expected=f'{p.name} = {{ value = ..., unit = "{p.display_unit}" }}',
                )
        vectors = {name: _make_vector(accelerometers.get(name, 0.0), layout.size) for name in PARAMETER}
        priors = {name: _make_vector(v, layout.size) for name, v in (sigmas or {}).items()}
        instrument = cls(layout, g0, MappingProxyType(vectors), sigmas=MappingProxyType(priors), **fields)
        _check_physical(instrument)
        return instrument

    def replace(self, **changes: ArrayLike) -> Instrument:
        """The same instrument with some accelerometer parameters changed (SI, scalar or (n,))."""
        check_keys(changes, PARAMETER, "[accelerometers]")
        changed = {name: _make_vector(v, self.layout.size) for name, v in changes.items()}
        return dataclasses.replace(self, accelerometers=MappingProxyType({**self.accelerometers, **changed}))

    def sigma(self, name: str) -> Vector:
        """How far a parameter of the accelerometers may be from its sheet, (n,) SI: by the sheet, or plausible."""
        prior = self.sigmas.get(name)
        usual = PARAMETER[name].plausible_si(self.accelerometers[name], self.g0)
        return (usual if prior is None else prior) * self.widths.get(name, 1.0)

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


def _make_vector(value: ArrayLike, count: int) -> Vector:
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
        if PARAMETER[name].required and np.any(vector == 0):
            raise UserError(f"{name} must not be zero", where=where, found=vector.tolist())
    R = i.radii + k["dR"]
    if np.any(R < 0) or (np.any(R == 0) and of_paper):
        raise UserError(
            "the distance from the disc centre, radius + dR, must be positive",
            where=at(i.path, "[accelerometers] dR"),
            found=f"{R.tolist()} m",
        )
