"""Reads the printed LaTeX of :mod:`derive.audit.compare` into polynomials.

The grammar is the paper's own: sums and products of numbers, powers, brackets, symbols with a subscript,
and the combinations ``D_{X}^{12}``, ``D_{X,Y}^{12,34}``, ``D_{X}^{1234}`` and ``\\sum_{X}``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from fractions import Fraction

from sympy import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement, PolyRing

from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS
from derive.symbols import COMPONENTS, SECOND_ORDER, symbol

_TOKEN = re.compile(r"\s*(\d+(?:\.\d+)?|\\[A-Za-z]+|\S)")


class NotReadable(ValueError):
    """The printed text does not follow the grammar, or names a symbol that the equation does not have."""


def ring_of(names: tuple[str, ...]) -> PolyRing:
    """A ring over the rationals whose generators bear these names."""
    return PolyRing([symbol(n) for n in names], QQ, lex)


def generators(ring: PolyRing) -> dict[str, PolyElement]:
    """The generators of a ring by their names."""
    return {s.name: g for s, g in zip(ring.symbols, ring.gens, strict=True)}


class Reader:
    """A recursive-descent parser: printed text in, polynomial out.

    ``symbols`` gives the polynomial of every symbol by its LaTeX without braces (``\\theta_y``, ``K_j4``),
    and those of the combinations by their names in :data:`COMBINATIONS`.
    """

    def __init__(self, ring: PolyRing, symbols: Mapping[str, PolyElement]) -> None:
        self.ring = ring
        self.symbols = symbols
        self._tokens: list[str] = []
        self._at = 0

    def read(self, text: str) -> PolyElement:
        """The polynomial of ``text``; raises :class:`NotReadable`."""
        self._tokens, self._at = _TOKEN.findall(text), 0
        value = self._sum()
        if self._next():
            raise NotReadable(f"{text!r}: stopped before {self._next()!r}")
        return value

    def _next(self) -> str:
        return self._tokens[self._at] if self._at < len(self._tokens) else ""

    def _take(self, expected: str = "") -> str:
        token = self._next()
        if not token or (expected and token != expected):
            raise NotReadable(f"expected {expected or 'a symbol'!r}, found {token or 'the end'!r}")
        self._at += 1
        return token

    def _sum(self) -> PolyElement:
        total = self.ring.zero
        first = True
        while first or self._next() in ("+", "-"):
            sign = self._take() if self._next() in ("+", "-") else "+"
            term = self._product()
            total = total + term if sign == "+" else total - term
            first = False
        return total

    def _product(self) -> PolyElement:
        value = self._power()
        while self._next() not in ("", "+", "-", ")", "}", ","):
            value = value * self._power()
        return value

    def _power(self) -> PolyElement:
        token = self._take()
        if token in ("D", "\\sum"):
            return self._combination(token)
        if token == "(":
            base = self._sum()
            self._take(")")
        elif token[0].isdigit():
            number = Fraction(token)
            base = self.ring(QQ(number.numerator, number.denominator))
        else:
            base = self._symbol(token)
        if self._next() == "^":
            self._take()
            exponent = self._take()
            if not exponent.isdigit():
                raise NotReadable(f"expected a power, found {exponent!r}")
            return base ** int(exponent)
        return base

    def _symbol(self, head: str) -> PolyElement:
        name = head
        if self._next() == "_":
            self._take()
            name += "_" + self._group()
        if name not in self.symbols:
            raise NotReadable(f"unknown symbol {name}")
        return self.symbols[name]

    def _group(self) -> str:
        if self._next() != "{":
            return self._take()
        self._take("{")
        inside = ""
        while self._next() != "}":
            inside += self._take()
        self._take("}")
        return inside

    def _combination(self, head: str) -> PolyElement:
        self._take("_")
        self._take("{")
        subscripts = [self._sum()]
        while self._next() == ",":
            self._take()
            subscripts.append(self._sum())
        self._take("}")
        names = ["Sigma"]
        if head == "D":
            self._take("^")
            names = ["D" + part for part in self._group().split(",")]
        if len(names) != len(subscripts):
            raise NotReadable(f"{len(subscripts)} subscripts for {names}")
        return sum((self.symbols[n] * s for n, s in zip(names, subscripts, strict=True)), self.ring.zero)


COMBINATIONS: tuple[str, ...] = ("D12", "D34", "D1234", "Sigma")

REDUNDANT_MOTION: tuple[str, ...] = ("S_3", "S_5", "omegadot_x", "omegadot_y", "omega_im")
"""Motion numbers that the paper writes beside the twelve independent ones of the derivation."""

MODEL_RING = ring_of((*COEFFICIENT_PARAMETERS, *MOTION_NUMBERS, *REDUNDANT_MOTION, *COMBINATIONS))
"""Ring of Eq. 18, 19 and 43-47: every monomial is a combination, its subscript and a product of motion."""

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
