"""Emitters: the frozen result (``derive.ir``) to source text, through jinja templates, which hold loops, not decisions.

A target of generation is a package in this folder, found by its name. It has a function for each form of a model that it writes:

    harmonic(m: Harmonic)                   a model as harmonics of the spin: sums of amplitudes times cosines and sines
    folded(m: Folded)                       a model as one polynomial, the parameters folded into its coefficients
    chain(m: ChainProgram, *, packaged)     a model as a chain of small named expressions; packaged: of the program itself, not of a
                                            model directory
    paper(starred, ideal)                   Eq. 5b and Eq. 30 of the paper, for documents

Each returns :data:`Files`. It sees the frozen result (``derive.ir``, ``derive.folded``) and nothing of the derivation.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Mapping
from functools import cache
from types import ModuleType
from typing import Any

Files = Mapping[str, str]
"""Path below ``generated/`` -> text."""


@cache
def targets() -> tuple[ModuleType, ...]:
    """Every package in this folder."""
    names = sorted(m.name for m in pkgutil.iter_modules(__path__) if m.ispkg)
    return tuple(importlib.import_module(f"{__name__}.{n}") for n in names)


def write_form(files: dict[str, str], form: str, *model: Any, **how: Any) -> None:
    """Add what the targets make of a form of a model; no two may write the same file."""
    for t in targets():
        if hasattr(t, form):
            additions = getattr(t, form)(*model, **how)
            if both := files.keys() & additions.keys():
                raise ValueError(f"two targets write {sorted(both)}")
            files |= additions
