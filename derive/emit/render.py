"""The jinja environment of all emitters, and the NumPy, C and LaTeX text of a model."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import jinja2
import sympy as sp

from derive.emit import fast
from derive.emit.printers import to_c, to_fused_c, to_latex, to_numpy
from derive.folded import Folded
from derive.ir import AmplitudeTerm, Chain, Coefficient, Harmonic
from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS, Term
from derive.symbols import ACCELEROMETER, QUARTER_TURNS, SIGNS, symbol
from derive.tape import Program


@cache
def environment() -> jinja2.Environment:
    env = jinja2.Environment(
        loader=jinja2.PackageLoader("derive.emit", "templates"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # the output is source code, not markup
    )
    env.filters |= {"np": to_numpy, "c": to_c, "fused": to_fused_c, "tex": to_latex}
    env.filters |= {"c_name": _c_name, "numpy_term": _numpy_term}
    env.globals |= {
        "quarter_turns": QUARTER_TURNS,
        "signs": SIGNS,
        "per_accelerometer": [p.name for p in ACCELEROMETER],
        "coefficient_parameters": COEFFICIENT_PARAMETERS,
        "program_inputs": _program_inputs,
        "trig": _trig,
        **fast.constants(),
    }
    return env


def render(template: str, **values: object) -> str:
    return environment().get_template(template).render(**values)


def harmonic_numpy(m: Harmonic) -> str:
    return render("harmonic.py.j2", m=m)


def harmonic_c(m: Harmonic) -> tuple[str, str]:
    """Header and source."""
    folded: list[tuple[str, str, str]] = []
    expressions: list[sp.Expr] = []
    lines: list[tuple[str, list[tuple[list[int], sp.Expr]]]] = []
    for name, terms in m.amplitudes:
        row = []
        for t in terms:
            numbers = []
            for k in t.coefficients:
                if k.expression not in expressions:
                    expressions.append(k.expression)
                numbers.append(len(folded))
                folded.append((k.combination, str(expressions.index(k.expression)), to_c(k.expression)))
            row.append((numbers, t.motion))
        lines.append((name, row))
    values = {"m": m, "folded": folded, "expressions": expressions, "lines": lines}
    return render("harmonic.h.j2", **values), render("harmonic.c.j2", **values)


def harmonic_latex(m: Harmonic) -> str:
    return render("harmonic.tex.j2", m=m, term=_latex_term)


def paper_latex(starred: Mapping[str, sp.Expr], ideal: Mapping[str, tuple[Term, ...]]) -> str:
    """Eq. 5b and Eq. 30."""
    terms = []
    for name, row in ideal.items():
        carrier = "" if name == "A_0" else rf"\{'cos' if name[-1] == 'c' else 'sin'} {name[2:-1]}\Omega t"
        for t in row:
            number = sp.Mul(*(symbol(n) ** k for n, k in zip(MOTION_NUMBERS, t.motion, strict=True)))
            coefficient = rf"\sum\nolimits_{{{to_latex(t.coefficient.as_expr())}}}"
            terms.append(f"{coefficient} {to_latex(number)} {carrier}")
    rows = [(to_latex(symbol(name)), e) for name, e in starred.items()]
    return render("paper.tex.j2", starred=rows, ideal=" + ".join(terms))


def folded_c(m: Folded) -> tuple[str, str]:
    """Header and source."""
    return render("folded.h.j2", m=m), render("folded.c.j2", m=m)


def folded_numpy(m: Folded) -> str:
    return render("folded.py.j2", m=m)


def chain_numpy(m: Chain) -> str:
    return render("chain.py.j2", m=m)


def chain_c(m: Chain) -> tuple[str, str]:
    return render("chain.h.j2", m=m), render("chain.c.j2", m=m)


def plain_c(m: Chain) -> tuple[str, str]:
    """Header and source of G_out alone, in the order of operations of the NumPy code."""
    return render("plain.h.j2", m=m), render("plain.c.j2", m=m)


def _trig(n: int, phase: str) -> str:
    return "1" if n == 0 else f"{phase}{n}"


def _c_name(name: str) -> str:
    return name.replace("-", "_").replace(".", "__")


def _program_inputs(program: Program, among: list[str]) -> list[str]:
    read = {s.name for s in program.inputs()}
    return [n for n in among if n in read]


def _numpy_term(t: AmplitudeTerm) -> str:
    inner = " + ".join(f"{k.combination}({to_numpy(k.expression)})" for k in t.coefficients)
    if t.motion == 1:
        return inner
    if len(t.coefficients) > 1:
        inner = f"({inner})"
    return (
        f"{inner} * {to_numpy(t.motion)}"
        if t.motion.is_Pow or t.motion.is_Symbol
        else f"{inner} * ({to_numpy(t.motion)})"
    )


def _latex_term(t: AmplitudeTerm) -> str:
    inner = " + ".join(_latex_coefficient(t.coefficients))
    motion = "" if t.motion == 1 else to_latex(t.motion)
    return rf"{inner}\, {motion}" if motion else inner


def _latex_coefficient(coefficients: tuple[Coefficient, ...]) -> list[str]:
    by: dict[str, str] = {}
    for k in coefficients:  # D^12 and the like are linear: the parts of one coefficient are joined
        text = to_latex(k.expression)
        joint = "" if k.combination not in by else " " if text.startswith("-") else " + "
        by[k.combination] = by.get(k.combination, "") + joint + text
    if set(by) == {"D12", "D34"}:
        return [rf"D^{{12,34}}_{{{by['D12']},\, {by['D34']}}}"]
    names = {"D12": "D^{12}", "D34": "D^{34}", "D1234": "D^{1234}", "Sigma": r"\sum\nolimits"}
    return [rf"{names[c]}_{{{e}}}" for c, e in by.items()]
