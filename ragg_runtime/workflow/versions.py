"""Other states of a model: with another test sheet, as it was, with an effect of one's own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from datetime import UTC, datetime
from types import MappingProxyType

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.edit_toml import add_effect, set_parameters
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.model.settings import check_settings
from ragg_runtime.model_dir import derive
from ragg_runtime.model_dir.directory import load_model_dir, replace_model_dir
from ragg_runtime.model_dir.history import Step
from ragg_runtime.workflow.loop import Loaded, load


def change(m: Loaded, text: str, action: str, effect: str = "") -> Loaded:
    """Put another text in the place of model.toml, derive its model, and note the step in the history."""
    instrument = as_of(m, text).instrument
    step = Step(action, datetime.now(UTC).isoformat(timespec="seconds"), effect, text=text)
    directory = replace_model_dir(m.directory, text, generated=derive.files_of(instrument), step=step)
    return load(directory.path)


def edited(
    m: Loaded, values: Mapping[str, RawQuantity], sigmas: Mapping[str, tuple[float, ...] | None]
) -> Loaded:
    """Change values of the test sheet, and how sure it is of them (``None``: it does not say)."""
    return change(m, set_parameters(m.directory.text, values, sigmas), "edit", ", ".join(values))


def changed_by_others(m: Loaded) -> bool:
    """Whether the directory holds another state than the one that was loaded."""
    return load_model_dir(m.directory.path).digest != m.directory.digest


def as_of(m: Loaded, text: str) -> Loaded:
    """The model with another text of model.toml, in memory alone: the directory stays as it is."""
    instrument = parse_instrument(text, m.directory.path / "model.toml")
    model = derive.model_of(instrument)
    check_settings(model, instrument)
    return Loaded(replace(m.directory, text=text, instrument=instrument, generated=None), model, m.notes)


def with_own(m: Loaded, effect: str, add: str, units: Mapping[str, str]) -> Loaded:
    """The model with an effect of one's own listed, ``add`` at the transducer (unit of each parameter), in memory alone.

    :func:`ragg_runtime.workflow.loop.add` then calibrates it, and keeps it if that is wanted.
    """
    parameters = MappingProxyType({n: MappingProxyType({"unit": u}) for n, u in units.items()})
    expression = MappingProxyType({"stage": "transducer", "add": add, "params": parameters})
    if effect in {e.id for e in derive.known(m.instrument).effects}:
        raise UserError(
            "an effect of this id exists already", found=repr(effect[:80]), remedy="choose another name"
        )
    return as_of(m, add_effect(m.directory.text, EffectSetting(effect, expression=expression)))
