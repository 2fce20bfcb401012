"""Compares printed equations with derived ones, term by term.

A printed equation is a sum of *atoms*: one number times one monomial, once brackets and the subscripts of
D and Sigma are multiplied out. Printed motion numbers depend on one another (omegadot_x = (S_2 - T_3)/2 and
the like), so an atom may touch several monomials of the derivation. It is confirmed if every monomial that
it touches has, over the whole printed equation, the derived coefficient.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

from sympy import QQ
from sympy.polys.rings import PolyElement, PolyRing

from derive.audit.reading import (
    ANGLE_RING,
    COMBINATIONS,
    MODEL_RING,
    RATE_RING,
    REDUNDANT_MOTION,
    Reader,
    generators,
)
from derive.pipeline import starred
from derive.propagation import Collected, motion_numbers
from derive.symbols import symbol

Monomial = tuple[int, ...]
Rational = Any
"""An element of QQ (SymPy's own rational, or gmpy2's where that is installed)."""
Expansion = Callable[[Monomial], PolyElement]
"""What a printed monomial means in the independent ones."""


@dataclass(frozen=True)
class Atom:
    """One number times one monomial of a printed term; ``term`` is that term's place in its equation."""

    term: int
    monomial: Monomial
    value: Rational


@dataclass(frozen=True)
class Change:
    """A monomial whose printed coefficient is not the derived one (0: not printed, or not to be)."""

    monomial: Monomial
    printed: Rational
    right: Rational


@dataclass(frozen=True)
class Mistake:
    """A printed term with the changes it needs; ``right`` is what it should be."""

    term: int
    changes: tuple[Change, ...]
    right: PolyElement


@dataclass(frozen=True)
class EquationComparison:
    """The outcome for one equation of so many ``printed`` atoms. ``missing`` are derived terms without a printed counterpart."""

    equation: Equation
    printed: int
    confirmed: int
    mistakes: tuple[Mistake, ...]
    missing: tuple[Change, ...]


@dataclass(frozen=True)
class Reading:
    """A printed equation as it is read: its terms, its atoms, and what each atom's monomial means."""

    equation: Equation
    ring: PolyRing
    terms: tuple[PolyElement, ...]
    atoms: tuple[Atom, ...]
    meaning: Mapping[Monomial, Mapping[Monomial, Rational]]
    total: PolyElement


def read(equation: Equation, reader: Reader, expand: Expansion | None = None) -> Reading:
    """Read one printed equation; ``expand`` rewrites its monomials in independent ones."""
    ring = reader.ring
    terms = tuple(reader.read(t) for t in equation.terms)
    atoms = tuple(Atom(n, m, v) for n, p in enumerate(terms) for m, v in p.terms())
    meaning = {a.monomial: expand(a.monomial) if expand else monomial(ring, a.monomial) for a in atoms}
    total = sum((meaning[a.monomial] * a.value for a in atoms), ring.zero)
    return Reading(equation, ring, terms, atoms, {m: dict(p.terms()) for m, p in meaning.items()}, total)


def compare(printed: Reading, derived: PolyElement) -> EquationComparison:
    """Compare one printed equation with its derivation (a polynomial in the ring of the reading)."""
    atoms, meaning = printed.atoms, printed.meaning
    rest = dict((derived - printed.total).terms())
    wrong: list[tuple[Atom, Rational]] = []
    for a in atoms:
        fix = _single_fix(meaning[a.monomial], rest)
        if fix is not None:
            wrong.append((a, a.value + fix))
            for m in meaning[a.monomial]:
                del rest[m]
    # A monomial that no single atom explains: blame every atom that touches it.
    blamed = {id(a) for a, _ in wrong}
    unexplained = (a for a in atoms if id(a) not in blamed and any(m in rest for m in meaning[a.monomial]))
    wrong += [(a, QQ(0)) for a in unexplained]
    touched = {m for a in atoms for m in meaning[a.monomial]}
    missing = [Change(m, QQ(0), v) for m, v in rest.items() if m not in touched]
    confirmed = len(atoms) - len(wrong)
    return EquationComparison(printed.equation, len(atoms), confirmed, *_grouped(printed, wrong, missing))


def monomial(ring: PolyRing, powers: Monomial) -> PolyElement:
    """The monomial of these powers."""
    return ring.from_dict({powers: QQ(1)})


def _single_fix(weights: Mapping[Monomial, Rational], rest: Mapping[Monomial, Rational]) -> Rational | None:
    """What to add to an atom's value to put right every monomial it touches; None if nothing does."""
    fixes = [rest[m] / w if m in rest else None for m, w in weights.items()]
    return fixes[0] if fixes and fixes[0] is not None and all(f == fixes[0] for f in fixes) else None


def _grouped(
    printed: Reading, wrong: list[tuple[Atom, Rational]], missing: list[Change]
) -> tuple[tuple[Mistake, ...], tuple[Change, ...]]:
    """Mistakes by printed term; a missing monomial is counted to the wrong term with the same motion."""
    ring = printed.ring
    mistakes = []
    left = list(missing)
    for n in sorted({a.term for a, _ in wrong}):
        changes = [Change(a.monomial, a.value, right) for a, right in wrong if a.term == n]
        motions = [_outer(ring, c.monomial) for c in changes]
        adopted = [c for c in left if ring is MODEL_RING and _outer(ring, c.monomial) in motions]
        left = [c for c in left if c not in adopted]
        right = printed.terms[n]
        for c in (*changes, *adopted):
            right = right + monomial(ring, c.monomial) * (c.right - c.printed)
        mistakes.append(Mistake(n, (*changes, *adopted), right))
    return tuple(mistakes), tuple(left)


@cache
def _outer(ring: PolyRing, powers: Monomial) -> tuple[tuple[str, int], ...]:
    """Motion and combination of a monomial of :data:`MODEL_RING`, without the instrument's parameters."""
    named = ((s.name, p) for s, p in zip(ring.symbols, powers, strict=True) if p)
    return tuple((n, p) for n, p in named if re.match(r"a_|T_|S_|omega|D|Sigma", n))


# --- Eq. 18, 19, 43-47 ---

_NAMES = tuple(s.name for s in MODEL_RING.symbols)


def amplitude(left: str) -> str:
    """Name of the amplitude on a printed left side: ``A_{2\\Omega}^s`` is A_2s."""
    found = re.fullmatch(r"A_\{?(\d?)\\Omega\}?\^([cs])", left)
    return f"A_{found[1] or 1}{found[2]}" if found else "A_0"


def derived_amplitude(collected: Collected, name: str) -> PolyElement:
    """An amplitude of the derivation, in :data:`MODEL_RING`."""
    rows = {}
    for t in collected.amplitudes[name]:
        combination = tuple(int(c == t.combination) for c in COMBINATIONS)
        for powers, value in t.coefficient.terms():
            rows[(*powers, *t.motion, *(0 for _ in REDUNDANT_MOTION), *combination)] = value
    return MODEL_RING.from_dict(rows)


@cache
def redundant() -> Mapping[str, PolyElement]:
    """The redundant motion numbers by the independent ones (the square of omega_im, for that one).

    All follow from T and S as linear functions of M (Eq. 16), except omega_im^2, for which Laplace's
    equation is needed: 2 T_5 + S_4 = 2 omega_im^2 + Gamma_xx + Gamma_yy + Gamma_zz.
    """
    g = generators(MODEL_RING)
    return {
        "S_3": g["T_5"] - g["T_1"],
        "S_5": g["T_2"] + g["T_6"],
        "omegadot_x": (g["S_2"] - g["T_3"]) / 2,
        "omegadot_y": (g["T_4"] - g["S_1"]) / 2,
        "omega_im": g["T_5"] + g["S_4"] / 2,
    }


def expand_motion() -> Expansion:
    """Rewrites a printed monomial of :data:`MODEL_RING` in the twelve independent motion numbers."""
    meanings = {
        _NAMES.index(name): (value, 2 if name == "omega_im" else 1) for name, value in redundant().items()
    }

    def expand(powers: Monomial) -> PolyElement:
        factor, kept = None, list(powers)
        for at, (value, unit) in meanings.items():
            if powers[at]:
                kept[at] = 0
                step = value ** (powers[at] // unit)
                factor = step if factor is None else factor * step
        plain = monomial(MODEL_RING, tuple(kept))
        return plain if factor is None else plain * factor

    return expand


@cache
def powers_by_name(powers: Monomial) -> Mapping[str, int]:
    """Powers of a monomial of :data:`MODEL_RING`, without the zeros."""
    return {n: p for n, p in zip(_NAMES, powers, strict=True) if p}


def select(p: PolyElement, keep: Callable[[Mapping[str, int]], bool]) -> PolyElement:
    """The terms of a polynomial whose named powers satisfy ``keep``."""
    return p.ring.from_dict({m: v for m, v in p.terms() if keep(powers_by_name(m))})


def printed_order(powers: Mapping[str, int]) -> bool:
    """The order of counting of Eq. 18 and 19: beta_z to the first power, everything else multiplied out."""
    return powers.get("beta_z", 0) <= 1


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


def derived_transducer() -> dict[str, PolyElement]:
    """Eq. 5b by its left sides, from the stages of the derivation: the coefficients of Eq. 5a, without K_0."""

    def left(name: str) -> str:
        return f"K_{{j{name[1:]}}}^*" if name.startswith("K") else rf"\vartheta_{{j{name[-1]}}}^*"

    return {left(name): ANGLE_RING.from_expr(e) for name, e in starred().items()}


def derived_motion() -> dict[str, PolyElement]:
    """T_1 ... S_5 of the derivation, in :data:`RATE_RING`."""
    return {name: RATE_RING.from_expr(e) for name, e in motion_numbers().items()}


def expand_rate(powers: tuple[int, ...]) -> PolyElement:
    """omega_im^2 by its components."""
    at = RATE_RING.symbols.index(symbol("omega_im"))
    kept = tuple(0 if n == at else p for n, p in enumerate(powers))
    plain = RATE_RING.from_dict({kept: QQ(1)})
    square = sum((generators(RATE_RING)[f"omega_{k}"] ** 2 for k in "xyz"), RATE_RING.zero)
    return plain * square if powers[at] else plain
