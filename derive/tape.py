"""A straight-line program of SymPy expressions, and its exact derivatives.

The chain of stages is recorded as a tape of small named expressions instead of one large one: it stays
readable when printed, and differentiating it costs a small multiple of itself (reverse accumulation),
whereas differentiating the expanded output costs minutes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from itertools import count

import sympy as sp

from derive.symbols import is_taken, symbol


def variables(e: sp.Expr) -> list[sp.Symbol]:
    """The symbols of an expression, by name: never iterate over ``free_symbols`` (its order is hashed)."""
    return sorted(e.free_symbols, key=lambda s: s.name)


@cache
def partials(e: sp.Expr) -> Mapping[sp.Symbol, sp.Expr]:
    """All first derivatives of an expression, by symbol in order of name; those that vanish are left out.

    One pass over the tree for all symbols: calling ``sympy.diff`` for one after the other costs ten times
    as much where an expression has many. Models that are derived one after the other share most of their expressions.
    """
    products: dict[sp.Symbol, list[sp.Expr]] = {}

    def descend(e: sp.Expr, factor: sp.Expr) -> None:
        if e.is_Symbol:
            products.setdefault(e, []).append(factor)
        elif e.is_Add:
            for term in e.args:
                descend(term, factor)
        elif e.is_Mul:
            for n, part in enumerate(e.args):
                if not part.is_Number:
                    descend(part, sp.Mul(factor, *e.args[:n], *e.args[n + 1 :]))
        elif isinstance(e, sp.Heaviside):
            pass  # flat but at the instant of the step itself
        elif isinstance(e, (sp.sign, sp.Abs)) and not e.args[0].is_extended_real:
            # SymPy does not evaluate these where it cannot infer that their argument, a quotient say, is real.
            if isinstance(e, sp.Abs):
                descend(e.args[0], factor * sp.sign(e.args[0]))
        elif e.is_Pow and e.exp.is_Number:
            descend(e.base, sp.Mul(factor, e.exp, sp.Pow(e.base, e.exp - 1)))
        else:
            slopes = {s: _slope(e, s) for s in variables(e)}
            if any(d.has(*_OPEN) for d in slopes.values()):  # of a function of such a sign or modulus
                descend(e.args[0], factor * e.fdiff())
                return
            for s, d in slopes.items():
                products.setdefault(s, []).append(factor * d)

    descend(e, sp.Integer(1))
    sums = {s: sp.Add(*products[s]) for s in sorted(products, key=lambda s: s.name)}
    return {s: d for s, d in sums.items() if d != 0}


_OPEN = (sp.Derivative, sp.re, sp.im, sp.atan2)
"""What SymPy writes where it does not carry a derivative out, or takes an argument for complex."""


def _slope(e: sp.Expr, s: sp.Symbol) -> sp.Expr:
    """The derivative of a function; of a step that is zero, but at the step itself, where no sample ever is."""
    return sp.diff(e, s).replace(sp.DiracDelta, lambda *_: sp.Integer(0))


def _is_plain(e: sp.Expr) -> bool:
    """Whether it is a number, a symbol, or a negative one."""
    return e.is_Atom or (e.is_Mul and len(e.args) == 2 and e.args[0] == -1 and e.args[1].is_Atom)


@dataclass(frozen=True)
class Program:
    """Assignments in order of evaluation, and the outputs by name."""

    assignments: tuple[tuple[sp.Symbol, sp.Expr], ...]
    outputs: tuple[tuple[str, sp.Expr], ...]

    @cached_property
    def inputs(self) -> tuple[sp.Symbol, ...]:
        """Symbols that are read but never assigned, by name."""
        assigned = {s for s, _ in self.assignments}
        read = {s for _, e in (*self.assignments, *self.outputs) for s in e.free_symbols}
        return tuple(sorted(read - assigned, key=lambda s: s.name))


@dataclass(frozen=True)
class About:
    """What of a time derivative is wanted: terms of at most degree ``most`` in the ``small`` symbols.

    A signature is a derivative by parameters at zero: what is of second order in these is nothing to it, and nested
    time derivatives would consist of little else.
    """

    small: frozenset[sp.Symbol] = frozenset()
    most: int = 1


EVERYTHING = About()

ByInput = Callable[[sp.Symbol], sp.Expr]
"""The derivative by an input symbol."""


@dataclass
class Tape:
    """Records assignments, with their partial and total time derivatives."""

    _values: dict[sp.Symbol, sp.Expr] = field(default_factory=dict)
    _rates: dict[tuple[sp.Symbol, About], sp.Expr] = field(default_factory=dict)
    _degrees: dict[frozenset[sp.Symbol], dict[sp.Expr, int]] = field(default_factory=dict)

    @property
    def assignments(self) -> list[tuple[sp.Symbol, sp.Expr]]:
        """Names and values, in order."""
        return [*self._values.items()]

    def let(self, name: str, value: sp.Expr) -> sp.Expr:
        """Name a value. Constants, symbols and their negatives are passed through.

        Naming the same value again by the same name gives the same symbol; another value gets another one, and
        so does the name of an input: names are made of the ids of effects, which may be anything.
        """
        value = sp.sympify(value, strict=True)
        if _is_plain(value):
            return value
        s, tried = symbol(name), 1
        while is_taken(s.name) or self._values.get(s, value) != value:
            tried += 1
            s = symbol(f"V{tried}__{name}")
        self._values[s] = value
        return s

    def let_each(self, name: str, values: sp.Matrix, rows: str = "xyz", columns: str = "xyz") -> sp.Matrix:
        """Name the components of a vector (3), ``name_x`` ..., or the entries of a matrix (3 x 3), ``name_xx`` ..."""
        ends = rows if values.shape[1] == 1 else [f"{i}{k}" for i in rows for k in columns]
        named = [self.let(f"{name}_{end}", e) for end, e in zip(ends, values, strict=True)]
        return sp.Matrix(*values.shape, named)

    def rate(self, e: sp.Expr, base: Callable[[sp.Symbol], sp.Expr], about: About = EVERYTHING) -> sp.Expr:
        """Total time derivative of ``e``; ``base`` gives that of a symbol that is not on the tape."""
        terms = []
        for s, d in partials(e).items():
            if self.degree(d, about.small) > about.most:
                continue
            rate = self._rate_of(s, base, about)
            if rate == 0:
                continue
            room = about.most - self.degree(rate, about.small)
            terms.append(sp.Mul(self._up_to(d, room, about.small), rate))
        return sp.Add(*terms)

    def _up_to(self, e: sp.Expr, most: int, small: frozenset[sp.Symbol]) -> sp.Expr:
        """The terms of a sum that are of at most this degree."""
        if not small:
            return e
        return sp.Add(*(t for t in sp.Add.make_args(e) if self.degree(t, small) <= most))

    def degree(self, e: sp.Expr, small: frozenset[sp.Symbol]) -> int:
        """The lowest degree in the ``small`` symbols, at least, of any term of an expression."""
        if not small or e.is_Number:
            return 0
        degrees = self._degrees.setdefault(small, {})
        if (degree := degrees.get(e)) is None:
            degree = degrees[e] = self._degree(e, small)
        return degree

    def _degree(self, e: sp.Expr, small: frozenset[sp.Symbol]) -> int:
        if e.is_Symbol:
            return 1 if e in small else self.degree(self._values[e], small) if e in self._values else 0
        degrees = [self.degree(a, small) for a in e.args]
        if e.is_Add:
            return min(degrees)
        if e.is_Mul:
            return sum(degrees)
        if e.is_Pow and e.exp.is_Integer and e.exp.is_positive:
            return int(e.exp) * degrees[0]
        return int(isinstance(e, sp.sin) and degrees[0] > 0)

    def _rate_of(self, s: sp.Symbol, base: Callable[[sp.Symbol], sp.Expr], about: About) -> sp.Expr:
        if s not in self._values:
            return base(s)
        if (s, about) not in self._rates:
            self._rates[s, about] = self.let(f"rate_{s.name}", self.rate(self._values[s], base, about))
        return self._rates[s, about]

    def derivatives(self, output: sp.Expr, at: Settled, prefix: str = "bar") -> tuple[Settled, ByInput]:
        """Record the reverse accumulation of ``output`` where some symbols have values (``at``).

        The values are put into every slope before it is used: what vanishes there is never multiplied out. Returns the
        tape settled with what was recorded, and the derivative by any input symbol.
        """
        adjoint: dict[sp.Symbol, list[sp.Expr]] = {}

        def scatter(e: sp.Expr, seed: sp.Expr) -> None:
            for s, d in partials(e).items():
                if (slope := d.xreplace(at.known)) != 0:
                    adjoint.setdefault(s, []).append(seed * slope)

        scatter(output, sp.Integer(1))
        forward = self.assignments
        for s, e in reversed(forward):
            if s in adjoint and (seed := sp.Add(*adjoint[s])) != 0:
                scatter(e, self.let(f"{prefix}_{s.name}", seed))
        both = replace(at, assignments=(*at.assignments, *self.assignments[len(forward) :]))
        return both, lambda s: sp.Add(*adjoint.get(s, []))


@dataclass(frozen=True)
class Settled:
    """Assignments in which some symbols have values: ``known`` are these, and what became constant or another's name."""

    known: Mapping[sp.Symbol, sp.Expr]
    assignments: tuple[tuple[sp.Symbol, sp.Expr], ...]

    def program(self, outputs: Iterable[tuple[str, sp.Expr]]) -> Program:
        """Share subexpressions, drop what nobody reads."""
        final = [(name, sp.sympify(e, strict=True).xreplace(self.known)) for name, e in outputs]
        return _share(live(self.assignments, final), final)


def settled(assignments: Iterable[tuple[sp.Symbol, sp.Expr]], values: Mapping[sp.Symbol, sp.Expr]) -> Settled:
    """Put ``values`` in and propagate what became constant."""
    constants = dict(values)
    kept: list[tuple[sp.Symbol, sp.Expr]] = []
    for s, e in assignments:
        value = e.xreplace(constants)
        if _is_plain(value):
            constants[s] = value
        else:
            kept.append((s, value))
    return Settled(constants, tuple(kept))


def live(
    assignments: Sequence[tuple[sp.Symbol, sp.Expr]], outputs: list[tuple[str, sp.Expr]]
) -> list[tuple[sp.Symbol, sp.Expr]]:
    """The assignments that the outputs need."""
    needed = {s for _, e in outputs for s in e.free_symbols}
    kept = []
    for s, e in reversed(assignments):
        if s in needed:
            kept.append((s, e))
            needed |= e.free_symbols
    return kept[::-1]


def _share(assignments: list[tuple[sp.Symbol, sp.Expr]], outputs: list[tuple[str, sp.Expr]]) -> Program:
    """Common subexpressions, each assigned just before its first use."""
    expressions = [e for _, e in assignments] + [e for _, e in outputs]
    names = (symbol(f"x{n}") for n in count())
    shared, reduced = sp.cse(expressions, symbols=names, order="canonical")
    pending = dict(shared)
    placed: list[tuple[sp.Symbol, sp.Expr]] = []

    def place(e: sp.Expr) -> None:
        for s in variables(e):
            if s in pending:
                value = pending.pop(s)
                place(value)
                placed.append((s, value))

    for (s, _), e in zip(assignments, reduced, strict=False):
        place(e)
        placed.append((s, e))
    tail = reduced[len(assignments) :]
    for e in tail:
        place(e)
    return Program(tuple(placed), tuple((n, e) for (n, _), e in zip(outputs, tail, strict=True)))
