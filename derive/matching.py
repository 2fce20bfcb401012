"""What sums and products of a list of expressions have in common: ``opt_cse`` of SymPy for commuting scalars, to the letter.

SymPy asks of every node whether it is a matrix or a list, puts every product together anew, and keeps its sets in order,
which does not matter where whole numbers stand for expressions.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import sympy as sp


@dataclass(frozen=True, eq=False)
class Noted:
    """An expression to be: of a kind, made of ``args``, expressions or others that are noted."""

    func: type[sp.Expr]
    args: tuple[sp.Expr | Noted | int, ...]


def noted(expressions: Iterable[sp.Expr]) -> dict[sp.Expr, Noted]:
    """How parts of the expressions are better made: a sign apart, as a quotient, of what others are made of as well."""
    found: dict[sp.Expr, Noted] = {}
    sums: dict[sp.Expr, None] = {}
    products: dict[sp.Expr, None] = {}
    seen: set[sp.Expr] = set()

    def look(e: sp.Expr) -> None:
        if not e.args or e in seen:
            return
        seen.add(e)
        for part in e.args:
            look(part)
        if e.could_extract_minus_sign():
            negative = sp.Add(*(-term for term in e.args)) if e.is_Add else -e
            if not negative.is_Atom:
                found[e] = Noted(sp.Mul, (sp.S.NegativeOne, negative))
                seen.add(negative)
                e = negative
        if e.is_Mul:
            products[e] = None
        elif e.is_Add:
            sums[e] = None
        elif e.is_Pow and e.exp.could_extract_minus_sign():
            found[e] = Noted(sp.Pow, (sp.Pow(e.base, -e.exp), -1))

    for e in expressions:
        look(e)
    for kind, among in ((sp.Add, sums), (sp.Mul, products)):
        _Matching(kind, among).find(found)
    return found


class _Matching:
    """Sums, or products, by the numbers of what they are made of; the short ones first, which others may hold whole."""

    def __init__(self, kind: type[sp.Expr], among: Iterable[sp.Expr]) -> None:
        self.kind = kind
        self.whole = sorted(among, key=lambda e: len(e.args))
        self.numbers: dict[sp.Expr | Noted, int] = {}
        self.parts: list[sp.Expr | Noted] = []  # number -> what it stands for
        self.users: list[set[int]] = []  # number -> which of the whole hold it
        self.own = [set(map(self._number, e.args)) for e in self.whole]
        for n, own in enumerate(self.own):
            for part in own:
                self.users[part].add(n)

    def _number(self, part: sp.Expr | Noted) -> int:
        n = self.numbers.setdefault(part, len(self.numbers))
        if n == len(self.parts):
            self.parts.append(part)
            self.users.append(set())
        return n

    def _noted(self, parts: Iterable[int]) -> Noted:
        return Noted(self.kind, tuple(self.parts[n] for n in sorted(parts)))

    def _replace(self, which: int, common: set[int], by: int) -> None:
        for part in common:
            self.users[part].discard(which)
        self.own[which] = (self.own[which] - common) | {by}
        self.users[by].add(which)

    def find(self, found: dict[sp.Expr, Noted]) -> None:
        """Note each that shares two parts or more with a later one; the smallest that is shared comes first."""
        changed: set[int] = set()
        for i, whole in enumerate(self.whole):
            counts = Counter(j for part in self.own[i] for j in self.users[part] if j > i)
            candidates = [j for j, c in sorted(counts.items(), key=lambda item: item[::-1]) if c > 1]
            while candidates:
                changed.update(self._share(i, candidates))
            if i in changed:
                found[whole] = self._noted(self.own[i])
            for part in self.own[i]:
                self.users[part].discard(i)

    def _share(self, i: int, candidates: list[int]) -> Sequence[int]:
        """What i has in common with the first of the candidates becomes one part of all that hold it."""
        first = candidates.pop(0)
        common = self.own[i] & self.own[first]
        if len(common) < 2:  # a part of it was replaced already
            return ()
        whole = common == self.own[i]
        by = self._number(self.whole[i] if whole else self._noted(common))
        others = [j for j in candidates if common <= self.own[j]]
        held = [*([] if whole else [i]), first, *others]
        for j in held:
            self._replace(j, common, by)
        return held
