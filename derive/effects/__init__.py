"""The catalogue of physical effects: one file each, found by its name.

``derive/effects/<id with underscores>.py`` must define ``EFFECT``, an :class:`derive.effect.Effect`
whose id matches the file. A user's own folder of such files is read by :func:`from_folder`.
"""

from __future__ import annotations

import importlib
import importlib.util
import pkgutil
from functools import cache
from pathlib import Path
from types import ModuleType

from derive.effect import Effect


@cache
def catalogue() -> tuple[Effect, ...]:
    """Every packaged effect, by id."""
    names = sorted(m.name for m in pkgutil.iter_modules(__path__))
    return tuple(sorted((_effect_of(importlib.import_module(f"{__name__}.{n}"), n) for n in names), key=_id))


def from_folder(folder: Path) -> tuple[Effect, ...]:
    """The effects of a user's own folder (trusted Python: the files are executed), by id."""
    found = []
    for path in sorted(folder.glob("*.py")):
        spec = importlib.util.spec_from_file_location(f"user_effect_{path.stem}", path)
        if spec is None or spec.loader is None:
            raise ValueError(f"{path}: cannot be imported")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        found.append(_effect_of(module, path.stem))
    return tuple(sorted(found, key=_id))


def _effect_of(module: ModuleType, stem: str) -> Effect:
    effect = getattr(module, "EFFECT", None)
    if not isinstance(effect, Effect):
        raise ValueError(f"{module.__file__}: defines no EFFECT = Effect(...)")
    if effect.id.replace("-", "_") != stem:
        raise ValueError(f"{module.__file__}: its effect is named {effect.id!r}, expected the file's name")
    return effect


def _id(effect: Effect) -> str:
    return effect.id
