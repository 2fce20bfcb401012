"""Derive models at run time: the one place, beside the command line, where the runtime meets the derivation.

A model directory's own ``generated/`` is never executed: what is executed is what this program has just
derived for the directory's list of effects. The files are there to be read, compiled and compared.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from derive import pipeline
from derive.effect import Effect as SymbolicEffect
from derive.effects import catalogue, from_sources
from derive.expression import ExpressionError, from_expression
from ragg_runtime.errors import UserError, at, did_you_mean
from ragg_runtime.instrument import EffectSetting, Instrument
from ragg_runtime.load import Model, from_files, packaged
from ragg_runtime.trust import trusted_sources


@dataclass(frozen=True)
class Known:
    """The effects that a model directory can use: the catalogue's, its own folder's, its one-line ones."""

    effects: tuple[SymbolicEffect, ...]

    def get(self, identifier: str, where: str | None = None) -> SymbolicEffect:
        """The effect of this id; UserError if there is none."""
        for e in self.effects:
            if e.id == identifier:
                return e
        names = [e.id for e in self.effects]
        near = did_you_mean(identifier, names)
        raise UserError(
            "unknown effect",
            where=where,
            found=repr(identifier),
            expected="an id listed by `ragg effects`",
            remedy=near or f"one of {', '.join(names)}",
        )


def known(instrument: Instrument) -> Known:
    """Every effect that this instrument's model directory can use."""
    found = list(catalogue())
    taken = {e.id for e in found}
    own: list[SymbolicEffect] = []
    if instrument.effects_folder is not None:
        sources = trusted_sources(instrument.effects_folder, instrument.path)
        try:
            own += from_sources(sources)
        except ValueError as error:
            raise UserError(
                "an effect of your own cannot be read", where=str(instrument.effects_folder), found=str(error)
            ) from error
    own += [_expression(s, instrument.path) for s in instrument.effects if s.expression is not None]
    for e in own:
        if e.id in taken:
            raise UserError(
                "an effect of your own has the id of another one",
                where=at(instrument.path, "effects"),
                found=repr(e.id),
                remedy="choose another id",
            )
        taken.add(e.id)
    return Known((*found, *own))


def _expression(s: EffectSetting, path: Path | None) -> SymbolicEffect:
    where = at(path, f"effect {s.id}")
    assert s.expression is not None
    try:
        return from_expression(
            s.id, str(s.expression["stage"]), str(s.expression["add"]), s.expression["params"]
        )
    except ExpressionError as error:
        raise UserError("the expression is not understood", where=where, found=str(error)) from error


def model_of(instrument: Instrument) -> Model:
    """The model for an instrument's list of effects: the packaged one, or one derived for it."""
    if not instrument.effects and instrument.effects_folder is None:
        return packaged()
    k = known(instrument)
    own = any(e not in catalogue() for e in k.effects)
    if not instrument.effects and not own:
        return packaged()
    return derived(tuple(_chosen(instrument, k)), k.effects)[0]


def _chosen(instrument: Instrument, k: Known) -> list[SymbolicEffect]:
    return [k.get(s.id, at(instrument.path, "effects")) for s in instrument.effects]


@cache
def derived(
    effects: tuple[SymbolicEffect, ...], candidates: tuple[SymbolicEffect, ...]
) -> tuple[Model, Mapping[str, str]]:
    """A model with these effects, and the files that its derivation yields."""
    files = pipeline.derive_model(effects, candidates)
    return from_files(files), files


def with_effects(instrument: Instrument, model: Model, further: Sequence[str]) -> Model:
    """``model`` with further effects derived into it; without signatures of any more."""
    k = known(instrument)
    chosen = tuple(k.get(i) for i in (*(e.id for e in model.effects), *further))
    return derived(chosen, ())[0]


def files_of(instrument: Instrument) -> Mapping[str, str]:
    """What ``generated/`` of a model directory must hold for its list of effects; empty for no effects."""
    if not instrument.effects:
        return {}
    k = known(instrument)
    return derived(tuple(_chosen(instrument, k)), k.effects)[1]
