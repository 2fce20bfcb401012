"""The printed equations of the paper, as data (``printed.txt``) for the audit alone: nothing else may import this.

Misprints are kept: theta against vartheta, T_ij against Gamma_ij, subscripts without their j, upper against lower case.
An equation is known by the number in its label in the paper's source: 5b, 16, 18, 19, 43, 45 (A^s and A^c of the spin
rate), 47 (A_0 of the simplified model).
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import resources


@dataclass(frozen=True)
class Equation:
    """One printed equation: its number, its left side and the terms of its right side, as LaTeX."""

    number: str
    left: str
    terms: tuple[str, ...]


def _read() -> tuple[Equation, ...]:
    found: list[tuple[str, str, list[str]]] = []
    text = resources.files("derive.audit").joinpath("printed.txt").read_text("utf-8")
    for line in text.splitlines():
        if line.startswith("  "):
            found[-1][2].append(line.strip())
        elif not line.startswith("#"):
            number, _, left = line.partition(" ")
            found.append((number, left, []))
    return tuple(Equation(number, left, tuple(terms)) for number, left, terms in found)


PRINTED = _read()
TRANSDUCER = tuple(e for e in PRINTED if e.number == "5b")
MOTION = tuple(e for e in PRINTED if e.number == "16")
ANALYTICAL = tuple(e for e in PRINTED if e.number in ("18", "19"))
SIMPLIFIED = tuple(e for e in PRINTED if e.number in ("43", "45", "47"))
