"""C17: a header and a source a model, below ``c/``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import sympy as sp

from derive.emit.c import fast
from derive.emit.printers import to_c
from derive.emit.render import environment
from derive.folded import Folded
from derive.ir import ChainProgram, Harmonic
from derive.tape import Program


def harmonic(m: Harmonic) -> dict[str, str]:
    own: list[tuple[str, str, str]] = []
    expressions: list[sp.Expr] = []
    lines: list[tuple[str, list[tuple[list[int], sp.Expr]]]] = []
    for name, terms in m.amplitudes:
        row = []
        for t in terms:
            numbers = []
            for k in t.coefficients:
                if k.expression not in expressions:
                    expressions.append(k.expression)
                numbers.append(len(own))
                own.append((k.combination, str(expressions.index(k.expression)), to_c(k.expression)))
            row.append((numbers, t.motion))
        lines.append((name, row))
    values = {"m": m, "folded": own, "expressions": expressions, "lines": lines}
    return _both("harmonic", m.name, **values)


def folded(m: Folded) -> dict[str, str]:
    return _both("folded", m.name, m=m)


@dataclass(frozen=True)
class Turned(Program):
    """A program that finds cosine and sine of some of its inputs, the ``angles``, in arrays ``cos_of_<name>``, ``sin_of_<name>``."""

    angles: tuple[str, ...] = ()

    @staticmethod
    def of(program: Program, inputs: Sequence[str]) -> Turned:
        found = {
            f: sp.Symbol(f"{f.func.__name__}_of_{f.args[0]}[i]")
            for _, e in (*program.assignments, *program.outputs)
            for f in e.atoms(sp.cos, sp.sin)
            if str(f.args[0]) in inputs
        }
        return Turned(
            assignments=tuple((s, e.xreplace(found)) for s, e in program.assignments),
            outputs=tuple((n, e.xreplace(found)) for n, e in program.outputs),
            angles=tuple(sorted({str(f.args[0]) for f in found})),
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
    env.globals |= fast.constants()
    return env.get_template(template).render(**values)
