"""Reads the printed equations of the paper into polynomials, and compares them with the derived ones, term by term.

The grammar is the paper's own: sums and products of numbers, powers, brackets, symbols with a subscript,
and the combinations ``D_{X}^{12}``, ``D_{X,Y}^{12,34}``, ``D_{X}^{1234}`` and ``\\sum_{X}``.

A printed equation is a sum of *atoms*: one number times one monomial, once brackets and the subscripts of
D and Sigma are multiplied out. Printed motion numbers depend on one another (omegadot_x = (S_2 - T_3)/2 and
the like), so an atom may touch several monomials of the derivation. It is confirmed if every monomial that
it touches has, over the whole printed equation, the derived coefficient.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from importlib import resources
from typing import Any

from sympy import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement, PolyRing

from derive.pipeline import starred
from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS, Collected, motion_numbers
from derive.symbols import COMPONENTS, SECOND_ORDER, symbol

_TOKEN = re.compile(
    r"(?P<head>D|\\sum)_\{|\}(?:\^\{(?P<close>[\d,]+)\})?|\^(?P<power>\d+)|(?P<number>\d+(?:\.\d+)?)"
    r"|(?P<symbol>\\?[A-Za-z]+(?:_(?:\{[^{}]*\}|\w))?)|(?P<sign>[-+(),])"
)
_IN_PYTHON = {
    "head": "combination({!r}, [",
    None: "], '')",
    "close": "], {!r})",
    "power": "**{}",
    "number": "number({!r})",
    "symbol": "symbol({!r})",
    "sign": "{}",
}


class NotReadable(ValueError):
    """The printed text does not follow the grammar, or names a symbol that the equation does not have."""


def ring_of(names: tuple[str, ...]) -> PolyRing:
    """A ring over the rationals whose generators bear these names."""
    return PolyRing([symbol(n) for n in names], QQ, lex)


def generators(ring: PolyRing) -> dict[str, PolyElement]:
    """The generators of a ring by their names."""
    return {s.name: g for s, g in zip(ring.symbols, ring.gens, strict=True)}


@dataclass(frozen=True)
class Reader:
    """Printed text in, polynomial out: token by token it is put into Python, whose operators the elements of the ring have.

    ``symbols`` gives the polynomial of every symbol by its LaTeX without braces (``\\theta_y``, ``K_j4``),
    and those of the combinations by their names in :data:`COMBINATIONS`.
    """

    ring: PolyRing
    symbols: Mapping[str, PolyElement]

    def read(self, text: str) -> PolyElement:
        """The polynomial of ``text``; raises :class:`NotReadable`."""
        meaning = {"number": self._number, "symbol": self._symbol, "combination": self._combination}
        try:
            return eval(_write_python(text), meaning)
        except (SyntaxError, KeyError, ValueError) as error:
            raise NotReadable(f"{text!r}: {error}") from error

    def _number(self, text: str) -> PolyElement:
        value = Fraction(text)
        return self.ring(QQ(value.numerator, value.denominator))

    def _symbol(self, text: str) -> PolyElement:
        return self.symbols[re.sub("[{}]", "", text)]

    def _combination(self, head: str, subscripts: list[PolyElement], which: str) -> PolyElement:
        names = ["Sigma"] if head == r"\sum" else [f"D{n}" for n in which.split(",")]
        return sum((self.symbols[n] * s for n, s in zip(names, subscripts, strict=True)), self.ring.zero)


def _write_python(text: str) -> str:
    """The text as an expression of Python, with the signs of multiplication that are not printed."""
    tokens, after_factor, at, text = [], False, 0, text.replace(" ", "")
    while at < len(text):
        token = _TOKEN.match(text, at)
        if token is None:
            raise NotReadable(f"{text!r}: stopped before {text[at:]!r}")
        at, kind = token.end(), token.lastgroup
        if after_factor and (kind in ("head", "number", "symbol") or token[0] == "("):
            tokens.append("*")
        tokens.append(_IN_PYTHON[kind].format(token[kind] if kind else ""))
        after_factor = kind not in ("head", "sign") or token[0] == ")"
    return "".join(tokens)


COMBINATIONS: tuple[str, ...] = ("D12", "D34", "D1234", "Sigma")

REDUNDANT_MOTION: tuple[str, ...] = ("S_3", "S_5", "omegadot_x", "omegadot_y", "omega_im")
"""Motion numbers that the paper writes beside the twelve independent ones of the derivation."""

MODEL_RING = ring_of((*COEFFICIENT_PARAMETERS, *MOTION_NUMBERS, *REDUNDANT_MOTION, *COMBINATIONS))
"""Ring of Eq. 18, 19 and 43-47: every monomial is a combination, its subscript and a product of motion."""

OUTER = slice(len(COEFFICIENT_PARAMETERS), None)
"""Of a monomial of it the motion and the combination, without the instrument's parameters."""

ANGLE_RING = ring_of(("vartheta_x", "vartheta_y", "vartheta_z", *SECOND_ORDER))
"""Ring of Eq. 5b."""

RATE_RING = ring_of(
    (
        *(f"omega_{k}" for k in "xyz"),
        "omega_im",
        *(f"omegadot_{k}" for k in "xyz"),
        *(f"Gamma_{k}" for k in COMPONENTS),
    )
)
"""Ring of Eq. 16; omega_im is the magnitude of the angular rate."""


def model_reader() -> Reader:
    """Reader of Eq. 18, 19 and 43-47, into :data:`MODEL_RING`.

    ``k_p`` is k1 K_p and ``theta`` is k1 vartheta (Eq. 6a). Upper and lower case subscripts of the angles mean the same.
    """
    g = generators(MODEL_RING)
    table = {n: g[n] for n in (*MOTION_NUMBERS, "S_3", "S_5", "R", *COMBINATIONS)}
    table |= {r"\omega_i\max": g["omegadot_x"], r"\omega_imay": g["omegadot_y"], r"\omega_im": g["omega_im"]}
    table |= {"k_1": g["k1"]} | {f"k_{p}": g["k1"] * g[f"K{p}"] for p in "0245678"}
    for axis in "xyz":
        for printed in (axis, axis.upper()):
            if axis != "y":
                table[rf"\beta_{printed}"] = g[f"beta_{axis}"]
            table[rf"\vartheta_{printed}"] = g[f"vartheta_{axis}"]
            table[rf"\theta_{printed}"] = g[f"vartheta_{axis}"] * g["k1"]
    return Reader(MODEL_RING, table)


def transducer_reader() -> Reader:
    """Reader of Eq. 5b, into :data:`ANGLE_RING`; a missing subscript j is passed over."""
    g = generators(ANGLE_RING)
    table: dict[str, PolyElement] = {}
    for j in ("j", ""):
        table |= {rf"\vartheta_{j}{k}": g[f"vartheta_{k}"] for k in "xyz"}
        table |= {f"K_{j}{p}": g[f"K{p}"] for p in "245678"}
    return Reader(ANGLE_RING, table)


def motion_reader() -> Reader:
    """Reader of Eq. 16, into :data:`RATE_RING`, with T_xx ... read as Gamma_xx ..."""
    g = generators(RATE_RING)
    table = {rf"\omega_im{k}": g[f"omega_{k}"] for k in "xyz"}
    table |= {r"\omega_im": g["omega_im"], r"\omega_i\max": g["omegadot_x"]}
    table |= {rf"\omega_ima{k}": g[f"omegadot_{k}"] for k in "yz"}
    table |= {f"T_{k}": g[f"Gamma_{k}"] for k in COMPONENTS}
    return Reader(RATE_RING, table)


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
    return EquationComparison(printed.equation, len(atoms), confirmed, *_group(printed, wrong, missing))


def monomial(ring: PolyRing, powers: Monomial) -> PolyElement:
    """The monomial of these powers."""
    return ring.from_dict({powers: QQ(1)})


def _single_fix(weights: Mapping[Monomial, Rational], rest: Mapping[Monomial, Rational]) -> Rational | None:
    """What to add to an atom's value to put right every monomial it touches; None if nothing does."""
    fixes = [rest[m] / w if m in rest else None for m, w in weights.items()]
    return fixes[0] if fixes and fixes[0] is not None and all(f == fixes[0] for f in fixes) else None


def _group(
    printed: Reading, wrong: list[tuple[Atom, Rational]], missing: list[Change]
) -> tuple[tuple[Mistake, ...], tuple[Change, ...]]:
    """Mistakes by printed term; a missing monomial is counted to the wrong term with the same motion."""
    ring = printed.ring
    mistakes = []
    left = list(missing)
    for n in sorted({a.term for a, _ in wrong}):
        changes = [Change(a.monomial, a.value, right) for a, right in wrong if a.term == n]
        motions = [c.monomial[OUTER] for c in changes]
        adopted = [c for c in left if ring is MODEL_RING and c.monomial[OUTER] in motions]
        left = [c for c in left if c not in adopted]
        right = printed.terms[n]
        for c in (*changes, *adopted):
            right = right + monomial(ring, c.monomial) * (c.right - c.printed)
        mistakes.append(Mistake(n, (*changes, *adopted), right))
    return tuple(mistakes), tuple(left)


# --- Eq. 18, 19, 43-47 ---


def amplitude(left: str) -> str:
    """Name of the amplitude on a printed left side: ``A_{2\\Omega}^s`` is A_2s."""
    match = re.fullmatch(r"A_\{?(\d?)\\Omega\}?\^([cs])", left)
    return f"A_{match[1] or 1}{match[2]}" if match else "A_0"


def derived_amplitude(collected: Collected, name: str) -> PolyElement:
    """An amplitude of the derivation, in :data:`MODEL_RING`."""
    rows = {}
    for t in collected.amplitudes[name]:
        combination = tuple(int(c == t.combination) for c in COMBINATIONS)
        for powers, value in t.coefficient.terms():
            rows[(*powers, *t.motion, *(0 for _ in REDUNDANT_MOTION), *combination)] = value
    return MODEL_RING.from_dict(rows)


def expand_motion() -> Expansion:
    """Rewrites a printed monomial of :data:`MODEL_RING` in the twelve independent motion numbers.

    The others are linear functions of M (Eq. 16), except omega_im^2, for which Laplace's equation is needed:
    2 T_5 + S_4 = 2 omega_im^2 + Gamma_xx + Gamma_yy + Gamma_zz.
    """
    g = generators(MODEL_RING)
    redundant = {
        "S_3": g["T_5"] - g["T_1"],
        "S_5": g["T_2"] + g["T_6"],
        "omegadot_x": (g["S_2"] - g["T_3"]) / 2,
        "omegadot_y": (g["T_4"] - g["S_1"]) / 2,
    }
    return _expansion(MODEL_RING, redundant, g["T_5"] + g["S_4"] / 2)


def expand_rate() -> Expansion:
    """Rewrites a printed monomial of :data:`RATE_RING` without omega_im."""
    g = generators(RATE_RING)
    return _expansion(RATE_RING, {}, g["omega_x"] ** 2 + g["omega_y"] ** 2 + g["omega_z"] ** 2)


def _expansion(ring: PolyRing, redundant: Mapping[str, PolyElement], square: PolyElement) -> Expansion:
    """Of monomials by what ``redundant`` generators mean, and the ``square`` of omega_im."""
    names = [s.name for s in ring.symbols]

    def expand(powers: Monomial) -> PolyElement:
        left = dict(zip(names, powers, strict=True))
        product = square ** (left.pop("omega_im") // 2)
        for name, value in redundant.items():
            product *= value ** left.pop(name)
        return product * monomial(ring, tuple(left.get(n, 0) for n in names))

    return expand


def in_printed_order(p: PolyElement) -> PolyElement:
    """The terms of a polynomial by the order of counting of Eq. 18 and 19: beta_z to the first power, all else multiplied out."""
    at = COEFFICIENT_PARAMETERS.index("beta_z")
    return p.ring.from_dict({m: v for m, v in p.terms() if m[at] <= 1})


@dataclass(frozen=True)
class Equation:
    """One printed equation: its number, its left side and the terms of its right side, as LaTeX."""

    number: str
    left: str
    terms: tuple[str, ...]


def _read() -> tuple[Equation, ...]:
    equations: list[tuple[str, str, list[str]]] = []
    text = resources.files("derive.audit").joinpath("printed.txt").read_text("utf-8")
    for line in text.splitlines():
        if line.startswith("  "):
            equations[-1][2].append(line.strip())
        elif not line.startswith("#"):
            number, _, left = line.partition(" ")
            equations.append((number, left, []))
    return tuple(Equation(number, left, tuple(terms)) for number, left, terms in equations)


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
