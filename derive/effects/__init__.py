"""The catalogue of physical effects: one file each, found by its name.

``derive/effects/<id with underscores>.py`` must define ``EFFECT``, an :class:`derive.effect.Effect`
whose id matches the file. A user's own modules of that kind are read by :func:`of_module` and :func:`of_text`.
"""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import ModuleType

from derive.effect import Effect
from derive.recogniser import numbers_only


@cache
def catalogue() -> tuple[Effect, ...]:
    """Every packaged effect, by id."""
    names = sorted(m.name for m in pkgutil.iter_modules(__path__))
    modules = [importlib.import_module(f"{__name__}.{n}") for n in names]
    found = [_effect_of(m, n, inspect.getsource(m)) for m, n in zip(modules, names, strict=True)]
    return tuple(sorted(found, key=lambda e: e.id))


def of_module(module: ModuleType, text: str) -> Effect:
    """The effect of a user's own module, whose source is ``text``; ValueError if it defines none."""
    return _effect_of(module, None, text)


def of_text(path: Path, text: str) -> Effect:
    """The effect of a user's own Python file. The text is executed as given; neither the file nor its byte code is read again."""
    module = ModuleType(f"user_effect_{path.stem}")
    module.__file__ = str(path)
    try:
        exec(compile(text, str(path), "exec"), module.__dict__)
    except (Exception, SystemExit) as error:
        raise ValueError(f"{type(error).__name__}: {error}") from error
    return of_module(module, text)


def _effect_of(module: ModuleType, stem: str | None, text: str) -> Effect:
    effect = getattr(module, "EFFECT", None)
    if not isinstance(effect, Effect):
        raise ValueError(f"{module.__file__}: defines no EFFECT = Effect(...)")
    if stem is not None and effect.id.replace("-", "_") != stem:
        raise ValueError(f"{module.__file__}: its effect is named {effect.id!r}, expected the file's name")
    if effect.kind != "output":
        return effect
    if not callable(getattr(module, "present", None)):
        raise ValueError(f"{module.__file__}: an effect of the output needs present(values, valid, noise)")
    return replace(effect, recogniser=numbers_only(text))
