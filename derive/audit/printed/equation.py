"""What a printed equation is."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Equation:
    """One printed equation: its number, its left side and the terms of its right side, as LaTeX."""

    number: str
    left: str
    terms: tuple[str, ...]
