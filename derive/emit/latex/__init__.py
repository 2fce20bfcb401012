"""LaTeX: the equations of the harmonic models, and those of the paper, below ``latex/``."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from derive.emit.render import environment, to_latex
from derive.ir import AmplitudeTerm, Coefficient, Harmonic
from derive.propagation import MonomialTerm, monomial
from derive.symbols import symbol


def harmonic(m: Harmonic) -> dict[str, str]:
    return {f"latex/{m.name}.tex": _render("harmonic.tex.j2", m=m, term=_term)}


def paper(starred: Mapping[str, sp.Expr], ideal: Mapping[str, tuple[MonomialTerm, ...]]) -> dict[str, str]:
    """Eq. 5b and Eq. 30."""
    terms = []
    for name, row in ideal.items():
        carrier = "" if name == "A_0" else rf"\{'cos' if name[-1] == 'c' else 'sin'} {name[2:-1]}\Omega t"
        for t in row:
            coefficient = rf"\sum\nolimits_{{{to_latex(t.coefficient.as_expr())}}}"
            terms.append(f"{coefficient} {to_latex(monomial(t.motion))} {carrier}")
    rows = [(to_latex(symbol(name)), e) for name, e in starred.items()]
    text = _render("paper.tex.j2", starred=rows, ideal=" + ".join(terms))
    return {"latex/paper.tex": text}


def _render(template: str, **values: object) -> str:
    return environment(__name__).get_template(template).render(**values)


def _term(t: AmplitudeTerm) -> str:
    inner = " + ".join(_coefficient(t.coefficients))
    motion = "" if t.motion == 1 else to_latex(t.motion)
    return rf"{inner}\, {motion}" if motion else inner


def _coefficient(coefficients: tuple[Coefficient, ...]) -> list[str]:
    by: dict[str, str] = {}
    for k in coefficients:  # D^12 and the like are linear: the parts of one coefficient are joined
        text = to_latex(k.expression)
        joint = "" if k.combination not in by else " " if text.startswith("-") else " + "
        by[k.combination] = by.get(k.combination, "") + joint + text
    if set(by) == {"D12", "D34"}:
        return [rf"D^{{12,34}}_{{{by['D12']},\, {by['D34']}}}"]
    names = {"D12": "D^{12}", "D34": "D^{34}", "D1234": "D^{1234}", "Sigma": r"\sum\nolimits"}
    return [rf"{names[c]}_{{{e}}}" for c, e in by.items()]
