"""LaTeX: the equations of the harmonic models, and those of the paper, below ``latex/``."""

from __future__ import annotations

import re
from collections.abc import Mapping

import sympy as sp

from derive.emit.printers import to_latex
from derive.emit.render import environment
from derive.folded import Folded
from derive.ir import AmplitudeTerm, Chain, Coefficient, Harmonic
from derive.output_harmonics import Combination, LayoutHarmonics, OutputHarmonics
from derive.propagation import Term, monomial
from derive.symbols import symbol


def harmonic(m: Harmonic) -> dict[str, str]:
    return {f"latex/{m.name}.tex": _render("harmonic.tex.j2", m=m, term=_term)}


def folded(m: Folded) -> dict[str, str]:
    return {}


def chain(m: Chain, *, packaged: bool) -> dict[str, str]:
    return {}


def paper(starred: Mapping[str, sp.Expr], ideal: Mapping[str, tuple[Term, ...]]) -> dict[str, str]:
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


def layout_harmonics(m: LayoutHarmonics) -> dict[str, str]:
    """The outputs of any layout as harmonics."""
    place = [(_placed(symbol(n)), _placed(e)) for n, e in m.place if n != str(e)]
    outputs = [
        {
            "name": o.name,
            "members": ", ".join(m.layout.names[j] for j in o.members),
            "combinations": [
                (_COMBINED.get(k.name) or _numbered(k.name), _weights(k)) for k in o.combinations
            ],
            "amplitudes": _amplitudes(m, o),
        }
        for o in m.outputs
    ]
    return {"harmonics.tex": _render("layout_harmonics.tex.j2", m=m, place=place, outputs=outputs)}


def _amplitudes(m: LayoutHarmonics, o: OutputHarmonics) -> list[tuple[str, list[str]]]:
    found = []
    for n in range(m.highest + 1):
        for phase in "cs" if n else "c":
            terms = [
                rf"{_COMBINED.get(name) or _numbered(name)}_{{{_placed(e)}}}"
                + ("" if not any(motion) else rf"\, {to_latex(monomial(motion))}")
                for (motion, name), e in o.amplitude(m.generic, n, phase).items()
            ]
            if terms:
                found.append((rf"A_{{{n}}}" + (f"^{phase}" if n else ""), terms))
    return found


_COMBINED = {"D12": "D^{12}", "D34": "D^{34}", "D1234": "D^{1234}", "Sigma": r"\sum\nolimits"}


def _numbered(name: str) -> str:
    return rf"\mathcal{{{name[0]}}}^{{{name[1:]}}}"


def _weights(k: Combination) -> str:
    return " ".join(
        f"{'-' if w < 0 else '+' if j else ''} {'' if abs(w) == 1 else f'{abs(w):.9g}'} x_{{{j + 1}}}"
        for j, w in enumerate(k.weights)
        if w
    )


def _placed(e: sp.Expr) -> str:
    """With the numbers of a place by the directions of the disc."""
    names = {s: _index(s.name) for s in sorted(e.free_symbols, key=str) if _PLACE.fullmatch(s.name)}
    return to_latex(e, symbol_names=names)


_PLACE = re.compile("[iopqrQ]_[rtz]+")


def _index(name: str) -> str:
    letter, _, directions = name.partition("_")
    return rf"{letter}_{{{directions}}}"


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
