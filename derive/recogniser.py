"""Recognition of an effect of the recorder: the part of its file that works on numbers.

Such an effect has no stage, and nothing of it is derived. Its file defines ``present`` beside ``EFFECT`` (and ``CHANNELS``, the
columns in which it is looked for, where these are not the outputs); that, and whatever ``present`` needs, goes to
``generated/output_effects/`` unchanged, without what imports the derivation. What it imports of another such effect
(``from derive.effects import saturation``) it has from there, too.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping

from derive.effect import Effect
from derive.names import id_in_code

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
            own = slice(node.lineno - 1, node.end_lineno)
            lines[own] = [x.replace("from derive.effects", f"from generated.{FOLDER}") for x in lines[own]]
    kept = "\n".join(lines).strip()
    return re.sub("\n{4,}", "\n\n\n", kept) + "\n"


def _of_derivation(node: ast.stmt) -> bool:
    if isinstance(node, ast.ImportFrom):
        first, _, rest = (node.module or "").partition(".")
        return first == "derive" and rest.partition(".")[0] != "effects"
    return isinstance(node, ast.Assign) and any(
        isinstance(t, ast.Name) and t.id == "EFFECT" for t in node.targets
    )


def files(effects: Iterable[Effect]) -> Mapping[str, str]:
    """Path below ``generated/`` -> text: a module for each effect of the recorder among these."""
    return {
        f"{FOLDER}/{id_in_code(e.id)}.py": f'"""Recogniser of {e.id}."""\n\n{e.recogniser}'
        for e in effects
        if e.kind == "output"
    }


def package_file(effects: Iterable[Effect]) -> Mapping[str, str]:
    """``__init__.py`` of the modules: every recogniser by its effect's id."""
    ids = [e.id for e in effects if e.kind == "output"]
    names = [id_in_code(i) for i in ids]
    body = "".join(f'    "{i}": {n},\n' for i, n in zip(ids, names, strict=True))
    text = (
        '"""Effects of the recorder, by their ids: whether a series shows them; do not edit, see derive/effects/."""\n\n'
        f"from . import {', '.join(names)}\n\nRECOGNISERS = {{\n{body}}}\n"
    )
    return {f"{FOLDER}/__init__.py": text}
