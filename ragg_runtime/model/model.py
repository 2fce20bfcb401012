"""Derived models as Python objects: the packaged one, or one derived for a list of effects."""

from __future__ import annotations

import importlib
import json
import sys
from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from importlib import resources
from types import ModuleType
from typing import Any, Protocol, cast

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.layout import PAPER, Layout
from ragg_runtime.model.evaluator import ChainModule, Evaluator, make_evaluator

Array = NDArray[np.float64]


class Recogniser(Protocol):
    """A module that recognises an effect of the recorder. Its result is certain: no level is spent on it.

    It is asked of the outputs, or of the columns that it names as ``CHANNELS``.
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
        """The channels that it needs and a flight, which has those recorded, does not have."""
        return list_missing_channels(self, recorded)


def list_missing_channels(e: Any, recorded: Container[str]) -> tuple[str, ...]:
    """As :meth:`DerivedEffect.missing`, of an effect of the derivation, too: it has ``channels`` and ``either``."""
    missing = tuple(c for c in e.channels if c not in recorded)
    return () if e.either and len(missing) < len(e.channels) else missing


MANY = 200_000
"""Samples from which the voltages of a model are worth half a second of compiling."""


@dataclass(frozen=True)
class Model:
    """A derived model.

    ``effects``: in the model beyond the paper's instrument; ``candidates``: not in it, with ``signatures``. ``chain``,
    ``signatures``, ``folded``: generated modules. ``c``: their C, file name -> text. ``layout``: whose accelerometers the
    chain is. ``own_recognisers``: of a model directory's effects, by id. ``lasting``: it comes with the program.
    """

    effects: tuple[DerivedEffect, ...]
    candidates: tuple[DerivedEffect, ...]
    chain: ChainModule
    signatures: ChainModule
    digest: str
    c: Mapping[str, str] = field(default_factory=dict, repr=False, compare=False)
    folded: ModuleType | None = field(default=None, repr=False, compare=False)
    layout: Layout = PAPER
    lasting: bool = field(default=False, compare=False)
    own_recognisers: Mapping[str, Recogniser] = field(default_factory=dict, repr=False, compare=False)

    @property
    def recognisers(self) -> Mapping[str, Recogniser]:
        """Effect id -> what recognises it, of the candidates that act on the output channel, in the order of their ids."""
        from generated.output_effects import RECOGNISERS

        every = {**cast(Mapping[str, Recogniser], RECOGNISERS), **self.own_recognisers}
        return {i: every[i] for i in sorted(e.id for e in self.candidates if e.kind == "output")}

    @property
    def sources(self) -> Mapping[str, str]:
        """The C of the model itself, without that of the candidates."""
        return {name: text for name, text in self.c.items() if not name.startswith("signatures")}

    @cached_property
    def evaluators(self) -> Callable[[str], Evaluator]:
        """``chain`` and ``signatures``, as fits evaluate them."""

        @cache
        def compiled(name: str) -> Evaluator:
            own = {n: text for n, text in self.c.items() if n.partition(".")[0] == name}
            # what comes with the program is compiled once for all flights, a derived model for one fit
            return make_evaluator(
                getattr(self, name), self.layout, own, name, quick=not self.lasting, quiet=True
            )

        return compiled

    def compiled(self, native: bool = True) -> Evaluator:
        """The model as machine code, compiled on first use; in NumPy where it is not to be, or, with a note, cannot be."""
        return make_evaluator(self.chain, self.layout, self.sources, native=native, folded=self.folded)

    def effect(self, identifier: str) -> DerivedEffect | None:
        """The effect of this id, in the model or not; ``None`` if unknown."""
        return next((e for e in (*self.effects, *self.candidates) if e.id == identifier), None)


def load_packaged(kinematics: str = "platform") -> Model:
    """The model of the paper, without further effects, as derived and committed; or that of full kinematics."""
    return _load_once(kinematics)  # one model, whether the default is spelt out or not


@cache
def _load_once(kinematics: str) -> Model:
    package = importlib.import_module("generated" if kinematics == "platform" else "generated.full")
    root = resources.files(package)
    manifest = json.loads(root.joinpath("manifest.json").read_text("utf-8"))

    chain, folded, signatures = (
        importlib.import_module(f"{package.__name__}.{n}") for n in ("chain", "folded", "signatures")
    )
    names = (f"{n}.{kind}" for n in ("chain", "folded", "signatures") for kind in ("c", "h"))
    c = {name: root.joinpath("c", name).read_text("utf-8") for name in names}
    return replace(_model(manifest, chain, signatures), c=c, folded=folded, lasting=True)


def load_files(files: Mapping[str, str], layout: Layout = PAPER) -> Model:
    """A model from derived source texts (``derive.pipeline.derive_model``), for this layout.

    The texts are executed: pass only what the derivation of this program has just yielded or what is the same bytes.
    """
    modules = {}
    output_effects = sorted(n for n in files if n.startswith("output_effects/") and n.endswith(".py"))
    for name in ("chain.py", "signatures.py", "folded.py", *output_effects):
        if name not in files:
            continue
        stem = name.removesuffix(".py")
        module = ModuleType(f"ragg_derived_{stem.replace('/', '_')}")
        sys.modules[module.__name__] = module
        exec(compile(files[name], f"<derived/{name}>", "exec"), module.__dict__)
        modules[stem] = module
    own = {
        stem.partition("/")[2].replace("_", "-"): cast(Recogniser, module)
        for stem, module in modules.items()
        if "/" in stem
    }
    c = {n.partition("/")[2]: text for n, text in files.items() if n.startswith(("c/", "fits/"))}
    model = _model(json.loads(files["manifest.json"]), modules["chain"], modules.get("signatures"))
    return replace(model, c=c, folded=modules.get("folded"), layout=layout, own_recognisers=own)


def _model(manifest: Mapping[str, Any], chain: ModuleType, signatures: ModuleType | None) -> Model:
    effects = tuple(_effect(e) for e in manifest["catalogue"])
    present = list(manifest["effects"])
    by_id = {e.id: e for e in effects}
    return Model(
        effects=tuple(by_id[i] for i in present),
        candidates=tuple(e for e in effects if e.id not in present) if signatures is not None else (),
        chain=cast(ChainModule, chain),
        signatures=cast(ChainModule, signatures or chain),
        digest=manifest["digest"],
    )


def _effect(entry: Mapping[str, Any]) -> DerivedEffect:
    parameters = tuple(
        DerivedParameter(**{**q, "late": tuple(q.get("late", ()))}) for q in entry["parameters"]
    )
    several = {k: tuple(entry.get(k, ())) for k in ("channels", "contains")}
    return DerivedEffect(**{**entry, **several, "parameters": parameters})
