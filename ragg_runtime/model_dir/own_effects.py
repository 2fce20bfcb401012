"""Effects in Python from installed packages and the folder ``RAGG_EFFECTS``, never from a model directory (it is code)."""

from __future__ import annotations

import inspect
import os
from collections.abc import Mapping
from functools import cache
from importlib.metadata import entry_points
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import read_text

if TYPE_CHECKING:
    from derive.effect import Effect

GROUP = "ragg.effects"
"""The group of entry points of packages; each is a module with ``EFFECT``."""

VARIABLE = "RAGG_EFFECTS"
"""Names a folder of Python files with ``EFFECT``."""


def own_sources() -> Mapping[str, str]:
    """The text of every module that defines such an effect, by its name or path."""
    return {name: inspect.getsource(module) for name, module in _installed().items()} | _in_folder()


def own_effects() -> tuple[Effect, ...]:
    """The effects themselves, by id; UserError if one cannot be read."""
    sources = own_sources()
    if not sources:  # to import what derives takes a while
        return ()
    from derive.effects import of_module, of_text

    found = []
    for name, text in sources.items():
        try:
            module = _installed().get(name)
            found.append(of_text(Path(name), text) if module is None else of_module(module, text))
        except ValueError as error:
            raise _unread(name, error) from error
    return tuple(sorted(found, key=lambda e: e.id))


def own_entries() -> tuple[Mapping[str, Any], ...]:
    """What a catalogue says of them."""
    found = own_effects()
    if not found:
        return ()
    from derive.ir import manifest_of_effect

    return tuple(manifest_of_effect(e) for e in found)


@cache
def _installed() -> Mapping[str, ModuleType]:
    found = {}
    for entry in sorted(entry_points(group=GROUP), key=lambda e: e.value):
        try:
            found[entry.value] = entry.load()
        except Exception as error:
            raise _unread(entry.value, error) from error
    return found


def _in_folder() -> dict[str, str]:
    named = os.environ.get(VARIABLE)
    if not named:
        return {}
    if not Path(named).is_dir():
        raise UserError("there is no folder of effects", where=VARIABLE, found=named)
    files = sorted(p for p in Path(named).glob("*.py") if not p.name.startswith((".", "_")))
    return {str(path): read_text(path) for path in files}


def _unread(where: str, error: Exception) -> UserError:
    return UserError("an effect of your own cannot be read", where=where, found=str(error))
