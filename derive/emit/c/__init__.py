"""C17: a header and a source a model, below ``c/``."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import count
from typing import Any

import mpmath
import sympy as sp

from derive.emit.render import environment, to_c
from derive.folded import Folded
from derive.ir import ChainProgram, Harmonic
from derive.tape import Program


def harmonic(m: Harmonic) -> dict[str, str]:
    coefficients = [k for _, terms in m.amplitudes for t in terms for k in t.coefficients]
    expressions = list(dict.fromkeys(k.expression for k in coefficients))
    parts = [(k.combination, expressions.index(k.expression), to_c(k.expression)) for k in coefficients]
    number = count()
    lines = [
        (name, [([next(number) for _ in t.coefficients], t.motion) for t in terms])
        for name, terms in m.amplitudes
    ]
    return _both("harmonic", m.name, m=m, folded=parts, expressions=expressions, lines=lines)


def folded(m: Folded) -> dict[str, str]:
    return _both("folded", m.name, m=m)


@dataclass(frozen=True)
class Turned(Program):
    """A program that finds cosine and sine of some of its inputs, the ``angles``, in arrays ``cos_of_<name>``, ``sin_of_<name>``."""

    angles: tuple[str, ...] = ()

    @staticmethod
    def of(program: Program, inputs: Sequence[str]) -> Turned:
        symbols = {
            f: sp.Symbol(f"{f.func.__name__}_of_{f.args[0]}[i]")
            for _, e in (*program.assignments, *program.outputs)
            for f in e.atoms(sp.cos, sp.sin)
            if str(f.args[0]) in inputs
        }
        return Turned(
            assignments=tuple((s, e.xreplace(symbols)) for s, e in program.assignments),
            outputs=tuple((n, e.xreplace(symbols)) for n, e in program.outputs),
            angles=tuple(sorted({str(f.args[0]) for f in symbols})),
        )


def chain(m: ChainProgram, *, packaged: bool) -> dict[str, str]:
    """The packaged models are whole in C; of a model directory, C serves to evaluate it elsewhere."""
    if not packaged and m.name != "chain":
        return {}
    inputs = [c.local for c in m.inputs]
    m = replace(m, value=Turned.of(m.value, inputs), derivatives=Turned.of(m.derivatives, inputs))
    return _both("chain", m.name, m=m, whole=m.name == "signatures")


def plain(m: ChainProgram) -> dict[str, str]:
    """G_out alone, in the order of operations of the NumPy code."""
    return {f"plain.{end}": _render(f"plain.{end}.j2", m=m) for end in ("h", "c")}


def _both(form: str, name: str, **values: object) -> dict[str, str]:
    return {f"c/{name}.{end}": _render(f"{form}.{end}.j2", **values) for end in ("h", "c")}


def _render(template: str, **values: object) -> str:
    env = environment(__name__)
    env.globals |= _constants()
    return env.get_template(template).render(**values)


BLOCK = 128
"""Samples that are evaluated together in C: what is between two loops stays in the first cache."""

PIECE = 16
"""Samples of the folded model that are evaluated together: few, so that the arithmetic of the disc angle and the memory traffic
of the channels overlap, and two vectors at least."""

DIGITS = 40
"""Of what is rounded to a float64 at the end."""

TERMS = 7
"""Terms of each polynomial: it is then within 3e-18 of sine and cosine, an eightieth of the last bit of one."""


@cache
def _constants() -> Mapping[str, object]:
    """What ``fast.c.j2`` wants of the fast sine and cosine: the polynomials as C, and multiples of pi."""
    sine, cosine = _polynomials()
    return {
        "block": BLOCK,
        "piece": PIECE,
        "sine": _horner(sine),
        "cosine": _horner(cosine[1:]),
        "cosine_first": repr(cosine[0]),
        "two_pi": repr(float(2 * sp.pi)),
        "per_turn": _two_parts(1 / (2 * sp.pi)),
    }


def _polynomials() -> tuple[Sequence[float], Sequence[float]]:
    """Of S(z) = sin(2 pi r) / r - 2 pi, with 2 pi as a float64, and C(z) = (cos(2 pi r) - 1) / z, with z = r^2, lowest power first.

    Interpolated at Chebyshev's nodes for |r| up to an eighth of a turn, which is all but minimax (Muller, Elementary Functions,
    3.2). The first coefficient of C is exact but for its rounding, as what it leaves is divided by z.
    """
    context = mpmath.mp.clone()
    context.dps = DIGITS
    turn, end = 2 * context.pi, context.mpf(1) / 64
    as_float = context.mpf(float(turn))

    def sine(z: Any) -> Any:
        r = context.sqrt(z)
        return context.sin(turn * r) / r - as_float

    def cosine(z: Any) -> Any:
        return ((context.cos(turn * context.sqrt(z)) - 1) / z + turn**2 / 2) / z

    def fit(f: Callable[[Any], Any], terms: int) -> list[float]:
        return [float(c) for c in reversed(context.chebyfit(f, [0, end], terms))]

    return fit(sine, TERMS), [float(-(turn**2) / 2), *fit(cosine, TERMS - 1)]


def _horner(coefficients: Sequence[float]) -> str:
    """In z, the square of the angle."""
    text = repr(coefficients[-1])
    for c in reversed(coefficients[:-1]):
        text = f"FMA(z, {text}, {c!r})"
    return text


def _two_parts(x: sp.Expr) -> tuple[str, str]:
    high = float(x.evalf(DIGITS))
    return repr(high), repr(float((x - sp.Rational(high)).evalf(DIGITS)))
