"""NumPy: a module a model, and the package file."""

from __future__ import annotations

import json
from collections.abc import Sequence

from derive.emit.render import environment, to_numpy
from derive.folded import Folded
from derive.ir import AmplitudeTerm, ChainProgram, Harmonic

BLOCK = 4096
"""Samples that are evaluated together: large enough to make NumPy's calls cheap, small enough for the second cache."""


def harmonic(m: Harmonic) -> dict[str, str]:
    return {f"{m.name}.py": _render("harmonic.py.j2", m=m)}


def folded(m: Folded) -> dict[str, str]:
    return {f"{m.name}.py": _render("folded.py.j2", m=m)}


def chain(m: ChainProgram, *, packaged: bool) -> dict[str, str]:
    return {f"{m.name}.py": _render("chain.py.j2", m=m)}


def package_file(modules: Sequence[str]) -> str:
    """``__init__.py`` of a generated package."""
    names = sorted(modules)
    return (
        '"""Derived models; do not edit: change the derivation and derive again. See manifest.json."""\n\n'
        f"from . import {', '.join(names)}\n\n__all__ = {json.dumps(names)}\n"
    )


def _render(template: str, **values: object) -> str:
    env = environment(__name__)
    env.filters["numpy_term"] = _term
    env.globals["numpy_block"] = BLOCK
    return env.get_template(template).render(**values)


def _term(t: AmplitudeTerm) -> str:
    inner = " + ".join(f"{k.combination}({to_numpy(k.expression)})" for k in t.coefficients)
    if t.motion == 1:
        return inner
    if len(t.coefficients) > 1:
        inner = f"({inner})"
    motion = to_numpy(t.motion)
    return f"{inner} * {motion}" if t.motion.is_Pow or t.motion.is_Symbol else f"{inner} * ({motion})"
