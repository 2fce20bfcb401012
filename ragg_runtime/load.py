"""Derived models as Python objects: the packaged one, or one derived for a list of effects."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from importlib import resources
from types import ModuleType
from typing import TYPE_CHECKING, Any, Literal, Protocol, cast

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ragg_runtime.native import Evaluator

Array = NDArray[np.float64]


class Chain(Protocol):
    """A generated module: one accelerometer's V_j and its derivatives (see ``generated/chain.py``)."""

    INPUTS: tuple[str, ...]
    PARAMETERS: tuple[tuple[str, int], ...]
    ROWS: tuple[tuple[str, bool], ...]
    SIGNS: tuple[int, ...]
    SIZE: int

    def accelerometer(
        self, j: int, time: Array, cos_phi: Array, sin_phi: Array, inputs: Array, q: Array
    ) -> Array: ...

    def derivatives(
        self, j: int, time: Array, cos_phi: Array, sin_phi: Array, inputs: Array, q: Array
    ) -> Array: ...

    def values_of(self, j: int, p: Array) -> Array: ...


@dataclass(frozen=True)
class EffectParameter:
    """A parameter of an effect; ``unit`` is for display, ``symbol`` its name in the parameter vector."""

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


@dataclass(frozen=True)
class Effect:
    """What the runtime knows of a physical effect, from the manifest of the derivation."""

    id: str
    title: str
    physics: str
    source: str
    equation: str
    limits: str
    channels: tuple[str, ...]
    kind: str
    parameters: tuple[EffectParameter, ...]


@dataclass(frozen=True)
class Model:
    """A derived model.

    Attributes
    ----------
    effects
        Effects in the model beyond the paper's instrument.
    candidates
        Effects known but not in the model; their signatures are in ``signatures`` (none: no signatures).
    chain, signatures
        Generated modules.
    digest
        Digest of the derivation.
    sources
        The model in C: file name -> text, as derived.
    folded
        The generated module of the folded form, which only the paper's model has.
    """

    effects: tuple[Effect, ...]
    candidates: tuple[Effect, ...]
    chain: Chain
    signatures: Chain
    digest: str
    sources: Mapping[str, str] = field(default_factory=dict, repr=False, compare=False)
    folded: ModuleType | None = field(default=None, repr=False, compare=False)

    def compiled(self, backend: Literal["auto", "c", "numpy"] = "auto") -> Evaluator:
        """The model as machine code, compiled on first use; in NumPy, with a note, where that cannot be."""
        from ragg_runtime.native import evaluator

        return evaluator(self.chain, self.sources, self.folded, backend)

    def effect(self, identifier: str) -> Effect | None:
        """The effect of this id, in the model or not; ``None`` if unknown."""
        return next((e for e in (*self.effects, *self.candidates) if e.id == identifier), None)


@cache
def packaged() -> Model:
    """The model of the paper, without further effects, as derived and committed."""
    import generated
    from generated import chain, folded, signatures

    root = resources.files(generated)
    manifest = json.loads(root.joinpath("manifest.json").read_text("utf-8"))
    names = (f"{n}.{kind}" for n in ("chain", "folded") for kind in ("c", "h"))
    sources = {name: root.joinpath("c", name).read_text("utf-8") for name in names}
    return replace(_model(manifest, chain, signatures), sources=sources, folded=folded)


def from_files(files: Mapping[str, str], label: str = "derived") -> Model:
    """A model from derived source texts (``derive.pipeline.derive_model``).

    The texts are executed: pass only what the derivation of this program has just yielded or what is,
    byte for byte, the same.
    """
    modules = {}
    for name in ("chain", "signatures"):
        if f"{name}.py" not in files:
            continue
        module = ModuleType(f"ragg_{label}_{name}")
        sys.modules[module.__name__] = module
        exec(compile(files[f"{name}.py"], f"<{label}/{name}.py>", "exec"), module.__dict__)
        modules[name] = module
    model = _model(json.loads(files["manifest.json"]), modules["chain"], modules.get("signatures"))
    return replace(model, sources={f"chain.{kind}": files[f"c/chain.{kind}"] for kind in ("c", "h")})


def _model(manifest: Mapping[str, Any], chain: ModuleType, signatures: ModuleType | None) -> Model:
    effects = tuple(_effect(e) for e in manifest["catalogue"])
    present = list(manifest["effects"])
    by_id = {e.id: e for e in effects}
    return Model(
        tuple(by_id[i] for i in present),
        tuple(e for e in effects if e.id not in present) if signatures is not None else (),
        cast(Chain, chain),
        cast(Chain, signatures or chain),
        manifest["digest"],
    )


def _effect(entry: Mapping[str, Any]) -> Effect:
    parameters = tuple(EffectParameter(**q) for q in entry["parameters"])
    return Effect(**{**entry, "channels": tuple(entry["channels"]), "parameters": parameters})
