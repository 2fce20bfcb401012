"""The catalogue of physical effects: one file each, found by its name.

``derive/effects/<id with underscores>.py`` must define ``EFFECT``, an :class:`derive.effect.Effect`
whose id matches the file. A user's own modules of that kind are read by :func:`of_module` and :func:`of_text`.

An effect of the recorder has no stage, and nothing of it is derived. Its file defines ``present`` beside ``EFFECT`` (and
``CHANNELS``, the columns in which it is looked for, where these are not the outputs); that, and whatever ``present`` needs, goes
to ``generated/output_effects/`` unchanged, without what imports the derivation. What it imports of another such effect
(``from derive.effects import saturation``) it has from there, too.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import ModuleType

from derive.effect import Effect
from derive.names import id_in_code


@cache
def catalogue() -> tuple[Effect, ...]:
    """Every packaged effect, by id."""
    names = sorted(m.name for m in pkgutil.iter_modules(__path__))
    modules = [importlib.import_module(f"{__name__}.{n}") for n in names]
    effects = [_effect_of(m, n, inspect.getsource(m)) for m, n in zip(modules, names, strict=True)]
    return tuple(sorted(effects, key=lambda e: e.id))


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


FOLDER = "output_effects"
"""Below ``generated/``."""


def numbers_only(text: str) -> str:
    """The source of an effect's file without ``EFFECT``, its docstring and imports of the derivation."""
    lines = text.splitlines()
    body = ast.parse(text).body
    for node in reversed(body):
        if _of_derivation(node) or (node is body[0] and isinstance(node, ast.Expr)):
            del lines[node.lineno - 1 : node.end_lineno]
        elif isinstance(node, ast.ImportFrom):
            rows = slice(node.lineno - 1, node.end_lineno)
            lines[rows] = [x.replace("from derive.effects", f"from generated.{FOLDER}") for x in lines[rows]]
    kept = "\n".join(lines).strip()
    return re.sub("\n{4,}", "\n\n\n", kept) + "\n"


def _of_derivation(node: ast.stmt) -> bool:
    if isinstance(node, ast.ImportFrom):
        first, _, rest = (node.module or "").partition(".")
        return first == "derive" and rest.partition(".")[0] != "effects"
    return isinstance(node, ast.Assign) and any(
        isinstance(t, ast.Name) and t.id == "EFFECT" for t in node.targets
    )


def recognisers(effects: Iterable[Effect]) -> Mapping[str, str]:
    """Path below ``generated/`` -> text: a module for each effect of the recorder among these."""
    return {
        f"{FOLDER}/{id_in_code(e.id)}.py": f'"""Recogniser of {e.id}."""\n\n{e.recogniser}'
        for e in effects
        if e.kind == "output"
    }


def recogniser_package(effects: Iterable[Effect]) -> Mapping[str, str]:
    """``__init__.py`` of the modules: every recogniser by its effect's id."""
    ids = [e.id for e in effects if e.kind == "output"]
    names = [id_in_code(i) for i in ids]
    body = "".join(f'    "{i}": {n},\n' for i, n in zip(ids, names, strict=True))
    text = (
        '"""Effects of the recorder, by their ids: whether a series shows them; do not edit, see derive/effects/."""\n\n'
        f"from . import {', '.join(names)}\n\nRECOGNISERS = {{\n{body}}}\n"
    )
    return {f"{FOLDER}/__init__.py": text}
