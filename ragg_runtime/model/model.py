"""Derived models as Python objects: the packaged one, or one derived for a list of effects; over a record."""

from __future__ import annotations

import importlib
import json
import sys
from collections.abc import Container, Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import resources
from types import ModuleType
from typing import Any, Protocol, cast

import numpy as np
from numpy.typing import NDArray

from generated.output_effects import RECOGNISERS
from ragg_runtime.base.errors import UserError, at, check_keys
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.layout import PAPER, Layout, Output, scale
from ragg_runtime.instrument.units import EOTVOS, Units
from ragg_runtime.model.chain import Chain, ChainModule
from ragg_runtime.model.record import Record

Array = NDArray[np.float64]


class Recogniser(Protocol):
    """A module that recognises an effect of the recorder, with certainty: no level is spent on it.

    It examines the outputs, or the columns that it names as ``CHANNELS``.
    """

    def present(self, values: Array, valid: NDArray[np.bool_], noise: float) -> bool:
        """Whether a series (N,), SI, shows it; ``valid`` (N,) are usable samples, ``noise`` the output's standard deviation, V."""


@dataclass(frozen=True)
class DerivedParameter:
    """A parameter of an effect; ``unit`` is for display, ``symbol`` its name in the parameter vector.

    ``physical`` is the only possible value besides the neutral one, ``largest`` a size above which anybody would see it without a
    model (``None``: any). ``plausible`` is of a
    navigation instrument; of another it grows with the sigma that the sheet gives the accelerometers' parameter ``like``.
    ``late``, ``growing``: which quantities of the motion it makes late (:mod:`ragg_runtime.model.memory`). ``shape``: it does
    nothing while the others are neutral.
    """

    name: str
    symbol: str
    latex: str
    unit: str
    meaning: str
    plausible: float
    shared: bool
    neutral: float | None
    channel: str | None
    fitted: bool
    physical: float | None = None
    largest: float | None = None
    like: str | None = None
    late: tuple[str, ...] = ()
    growing: bool = False
    shape: bool = False

    @property
    def default(self) -> float:
        """Where no value is given, in display units: the only physical one, if there is but one."""
        return self.physical if self.physical is not None else self.neutral or 0.0


@dataclass(frozen=True)
class DerivedEffect:
    """A physical effect, from the manifest of the derivation.

    ``switches``: whether it does where a voltage passes zero;
    ``memory``: through what it takes the record (:mod:`ragg_runtime.model.memory`); ``searched``: whether a diagnosis looks for it;
    ``contains``: effects that are special cases.
    """

    id: str
    title: str
    physics: str
    source: str
    equation: str
    limits: str
    channels: tuple[str, ...]
    kind: str
    parameters: tuple[DerivedParameter, ...]
    either: bool = False
    switches: bool = False
    memory: str | None = None
    searched: bool = True
    contains: tuple[str, ...] = ()

    def missing(self, recorded: Container[str]) -> tuple[str, ...]:
        """The channels that it needs and that a flight with these ``recorded`` lacks."""
        missing = tuple(c for c in self.channels if c not in recorded)
        return () if self.either and len(missing) < len(self.channels) else missing


@dataclass(frozen=True)
class Model:
    """A derived model.

    ``effects``: in the model beyond the paper's instrument; ``candidates``: not in it, with ``signatures``. ``recognisers``: of those
    that act on the output channel, by id.
    """

    effects: tuple[DerivedEffect, ...]
    candidates: tuple[DerivedEffect, ...]
    chain: Chain
    signatures: Chain
    digest: str
    recognisers: Mapping[str, Recogniser] = field(default_factory=dict, repr=False, compare=False)

    @property
    def layout(self) -> Layout:
        """Whose accelerometers the chain is."""
        return self.chain.layout

    def effect(self, identifier: str) -> DerivedEffect | None:
        """The effect of this id, in the model or not; ``None`` if unknown."""
        return next((e for e in (*self.effects, *self.candidates) if e.id == identifier), None)


def load_packaged(kinematics: str = "platform") -> Model:
    """The model of the paper, without further effects, as derived and committed; or that of full kinematics."""
    return _load("generated" if kinematics == "platform" else "generated.full")


@cache
def _load(package: str) -> Model:
    root = resources.files(package)
    names = ("chain", "folded", "signatures")
    modules = {n: importlib.import_module(f"{package}.{n}") for n in names}
    c = {f"{n}.{kind}": root.joinpath("c", f"{n}.{kind}").read_text("utf-8") for n in names for kind in "ch"}
    # compiled once for all flights, a derived model for one fit
    return _make_model(json.loads(root.joinpath("manifest.json").read_text("utf-8")), modules, c, quick=False)


def load_files(files: Mapping[str, str], layout: Layout = PAPER) -> Model:
    """A model from derived source texts (``derive.pipeline.derive_model``), for this layout.

    The texts are executed: pass only what the derivation of this program has just yielded or what is the same bytes.
    """
    modules = {}
    for name in sorted(n for n in files if n.endswith(".py") and n != "__init__.py"):
        stem = name.removesuffix(".py")
        module = ModuleType(f"ragg_derived_{stem.replace('/', '_')}")
        sys.modules[module.__name__] = module
        exec(compile(files[name], f"<derived/{name}>", "exec"), module.__dict__)
        modules[stem] = module
    c = {n.partition("/")[2]: text for n, text in files.items() if n.startswith(("c/", "fits/"))}
    manifest = json.loads(files["manifest.json"])
    return _make_model(manifest, modules, c, PAPER if layout.like_paper else layout)


def _make_model(
    manifest: Mapping[str, Any],
    modules: Mapping[str, ModuleType],
    c: Mapping[str, str],
    layout: Layout = PAPER,
    *,
    quick: bool = True,
) -> Model:
    effects = {e["id"]: _make_effect(e) for e in manifest["catalogue"]}
    present = manifest["effects"]

    def chain(name: str) -> Chain:
        sources = {n: text for n, text in c.items() if n.startswith("signatures.") == (name == "signatures")}
        folded = modules.get("folded") if name == "chain" else None
        return Chain(cast(ChainModule, modules[name]), layout, name, sources, quick, folded)

    searched = "signatures" in modules
    candidates = tuple(e for i, e in effects.items() if i not in present) if searched else ()
    of_file = {n.partition("/")[2].replace("_", "-"): m for n, m in modules.items() if "/" in n}
    recognisers = {**RECOGNISERS, **of_file}
    return Model(
        effects=tuple(effects[i] for i in present),
        candidates=candidates,
        chain=chain("chain"),
        signatures=chain("signatures" if searched else "chain"),
        digest=manifest["digest"],
        recognisers={
            i: cast(Recogniser, recognisers[i])
            for i in sorted(e.id for e in candidates if e.kind == "output")
        },
    )


def _make_effect(entry: Mapping[str, Any]) -> DerivedEffect:
    parameters = tuple(
        DerivedParameter(**{**q, "late": tuple(q.get("late", ()))}) for q in entry["parameters"]
    )
    several = {k: tuple(entry.get(k, ())) for k in ("channels", "contains")}
    return DerivedEffect(**{**entry, **several, "parameters": parameters})


def evaluate_voltages(chain: Chain, r: Record, p: Array, o: Output = PAPER.outputs[0]) -> Array:
    """V_j of the accelerometers of an output, (members, N), V."""
    return chain.voltages(r.time, r.inputs(chain), p, r.phi, o.members)


def evaluate_output(chain: Chain, r: Record, p: Array, o: Output = PAPER.outputs[0]) -> Array:
    """An output, (N,), V (Eq. 15)."""
    return o.combined(evaluate_voltages(chain, r, p, o))


def scale_factor(model: Model, p: Array, output: int = 0) -> float:
    """k_ggi of an output, V/Eo (Eq. 30)."""
    values = name_values(model.chain, p)
    k1, R = values["k_VI"] * values["K1"], values["radius"] + values["dR"]
    return scale(model.layout.outputs[output], k1, R) * EOTVOS


def name_values(chain: Chain, p: Array) -> dict[str, Array]:
    """A parameter vector as name -> values (one or four)."""
    return {name: p[place] for name, place in chain.places.items()}


def make_vector(model: Model, instrument: Instrument) -> Array:
    """The parameter vector of ``model.chain``, SI, from model.toml's values; effects' parameters else neutral.

    UserError if model.toml gives an effect a parameter that it does not have, or one of a wrong dimension; or a frequency or a time of 0.
    """
    units, layout = instrument.units, instrument.layout
    spins = np.array([layout.discs[q.disc].spin_frequency for q in layout.places])
    values = {"radius": instrument.radii, "spin_frequency": spins}
    if layout.like_paper:  # one value each
        values = {name: v[:1] for name, v in values.items()}
    values |= instrument.accelerometers
    for e in model.effects:
        setting = instrument.effect(e.id) or EffectSetting(e.id)
        where = None if instrument.path is None else str(instrument.path)
        check_keys(setting.values, [q.name for q in e.parameters], at(where, "effects", e.id))
        for q in e.parameters:
            size, si = 1 if q.shared else layout.size, units.base_unit(q.unit)
            value = setting.si(q.name, si, units.g0, shared=q.shared, where=where, count=size)
            if e.memory and q.shape and value is not None and not np.min(value) > 0.0:
                raise UserError(
                    f"{q.name} is not above zero",
                    where=at(where, "effects", e.id),
                    found=f"{np.min(value):g} {si}",
                    expected=f"such as {q.default:g} {q.unit}",
                )
            neutral = np.full(size, q.default * find_unit_factor(q.unit, units))
            values[q.symbol] = neutral if value is None else value
    return np.concatenate([values[name] for name, _ in model.chain.PARAMETERS])


@cache
def find_unit_factor(unit: str, units: Units) -> float:
    """SI value of one display unit."""
    return float(units.to_si(1.0, unit, units.base_unit(unit)))
