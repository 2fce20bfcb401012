"""The catalogue of physical effects.

A module of this package defines one effect, or a family of effects that share a shape: every :class:`derive.effect.Effect` in it is
one of the catalogue. Modules of a user's own are read by :func:`of_module` and :func:`of_text`.
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
    modules = [importlib.import_module(f"{__name__}.{m.name}") for m in pkgutil.iter_modules(__path__)]
    return tuple(sorted((e for m in modules for e in of_module(m, inspect.getsource(m))), key=lambda e: e.id))


def of_module(module: ModuleType, text: str) -> tuple[Effect, ...]:
    """The effects of a module, whose source is ``text``; ValueError if it defines none."""
    effects = [e for e in vars(module).values() if isinstance(e, Effect)]
    if not effects:
        raise ValueError(f"{module.__file__}: defines no EFFECT = Effect(...)")
    return tuple(_recognised(e, module, text) if e.kind == "output" else e for e in effects)


def of_text(path: Path, text: str) -> tuple[Effect, ...]:
    """The effects of a user's own Python file. The text is executed as given; neither the file nor its byte code is read again."""
    module = ModuleType(f"user_effect_{path.stem}")
    module.__file__ = str(path)
    try:
        exec(compile(text, str(path), "exec"), module.__dict__)
    except (Exception, SystemExit) as error:
        raise ValueError(f"{type(error).__name__}: {error}") from error
    return of_module(module, text)


def _recognised(effect: Effect, module: ModuleType, text: str) -> Effect:
    """An effect of the output with what recognises it, alone in its module."""
    if not callable(getattr(module, "present", None)):
        raise ValueError(f"{module.__file__}: an effect of the output needs present(values, valid, noise)")
    return replace(effect, recogniser=numbers_only(text))
