"""A target of generation: a package beside this file with these functions, found by its name."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Protocol, cast

import sympy as sp

import derive.emit
from derive.folded import Folded
from derive.ir import ChainProgram, Harmonic
from derive.propagation import MonomialTerm

Files = Mapping[str, str]
"""Path below ``generated/`` -> text."""


class Target(Protocol):
    """A language: the files that each form of a model becomes in it; none of a form that it does not write.

    It sees the frozen result (``derive.ir``, ``derive.folded``) and nothing of the derivation.
    """

    def harmonic(self, m: Harmonic) -> Files:
        """A model as harmonics of the spin: sums of amplitudes times cosines and sines."""

    def folded(self, m: Folded) -> Files:
        """A model as one polynomial, the parameters folded into its coefficients."""

    def chain(self, m: ChainProgram, *, packaged: bool) -> Files:
        """A model as a chain of small named expressions; ``packaged``: of the program itself, not of a model directory."""

    def paper(self, starred: Mapping[str, sp.Expr], ideal: Mapping[str, tuple[MonomialTerm, ...]]) -> Files:
        """Eq. 5b and Eq. 30 of the paper, for documents."""


@cache
def targets() -> tuple[Target, ...]:
    """Every folder beside this file that is a package."""
    names = sorted(m.name for m in pkgutil.iter_modules(derive.emit.__path__) if m.ispkg)
    return tuple(cast(Target, importlib.import_module(f"derive.emit.{n}")) for n in names)


def joined(parts: Sequence[Files]) -> dict[str, str]:
    """The files of several targets or forms; no two may write the same."""
    found: dict[str, str] = {}
    for files in parts:
        if both := found.keys() & files.keys():
            raise ValueError(f"two targets write {sorted(both)}")
        found |= files
    return found
