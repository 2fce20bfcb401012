"""The paper's printed equations, compared term by term with the derived ones; here as a page of Markdown, for the documentation.

The printed equations are data for the audit alone: the derivation never sees them.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import sympy as sp
from sympy.polys.rings import PolyElement

from derive.audit.compare import COMBINATIONS, MODEL_RING, Rational
from derive.audit.result import PROOF_POINTS, Audit, Cost, Erratum, audit
from derive.emit.render import number, render_page
from derive.propagation import COEFFICIENT_PARAMETERS

Row = tuple[str, ...]


def page() -> str:
    """The page of errata, Markdown."""
    return render_page("derive.audit", "errata.md.j2", _context(audit()))


def _context(a: Audit) -> dict[str, Any]:
    costs = [max(e.cost.rms, abs(e.cost.inline), abs(e.cost.cross)) for e in a.errata if e.cost]
    return {
        "summary": _summary(a),
        "confirmed": str(a.confirmed),
        "printed": str(a.printed),
        "wrong": str(a.wrong),
        "worst_erratum": number(max(costs, default=0.0)),
        "neglected": _cost(a.neglected),
        "proof_points": str(PROOF_POINTS),
        "proof_verdict": "All differences are exactly 0." if a.proved else "**A difference is not 0.**",
        "errata": [_erratum(e) for e in a.errata],
        "beyond": [
            (f"${amplitude(b.amplitude)}$", f"${latex(b.terms)}$", *_cost(b.cost).values()) for b in a.beyond
        ],
        "simplified": ", ".join(f"${amplitude(n)}$" for n in a.simplified_amplitudes),
    }


def _cost(c: Cost | None) -> dict[str, str]:
    return {} if c is None else {n: number(getattr(c, n)) for n in ("rms", "inline", "cross")}


def _summary(a: Audit) -> list[Row]:
    groups: dict[str, list[int]] = {}
    for c in a.comparisons:
        row = groups.setdefault(c.equation.number, [0, 0, 0, 0])
        for n, v in enumerate((c.printed, c.confirmed, c.printed - c.confirmed, len(c.missing))):
            row[n] += v
    total = [sum(r[n] for r in groups.values()) for n in range(4)]
    return [
        (name, *map(str, row))
        for name, row in ({f"Eq. {n}": r for n, r in groups.items()} | {"all": total}).items()
    ]


def _erratum(e: Erratum) -> dict[str, Any]:
    right = e.mistake.right
    one = right.ring.domain.one
    return {
        "number": e.equation.number,
        "left": e.equation.left,
        "printed": e.equation.terms[e.mistake.term],
        "right": latex(right),
        "residual": "" if e.residual is None else number(e.residual, 6),
        "cost": _cost(e.cost),
        "changes": [
            (
                f"${latex(right.ring.from_dict({c.monomial: one}))}$",
                f"${rational(c.printed)}$",
                f"${rational(c.right)}$",
            )
            for c in e.mistake.changes
        ],
    }


_LATEX = {
    "k1": "k_1",
    **{f"{n}_{k}": rf"\{n}_{k}" for n in ("beta", "vartheta") for k in "xyz"},
    **{f"K{p}": f"K_{p}" for p in "0245678"},
    "omegadot_x": r"\omega_{imax}",
    "omegadot_y": r"\omega_{imay}",
    "omega_im": r"\omega_{im}",
}
_COMBINATION = {
    "D12": ("D", "^{12}"),
    "D34": ("D", "^{34}"),
    "D1234": ("D", "^{1234}"),
    "Sigma": (r"\sum", ""),
}
_NAMES = tuple(s.name for s in MODEL_RING.symbols)
_ANGLES_FIRST = sorted(range(len(COEFFICIENT_PARAMETERS)), key=lambda n: (n < 2, n))
_OUTER = slice(len(COEFFICIENT_PARAMETERS), len(_NAMES) - len(COMBINATIONS))


def latex(p: PolyElement) -> str:
    """A polynomial of MODEL_RING: combinations of subscripts, each times a product of motion numbers."""
    if p.ring is not MODEL_RING:
        return str(sp.latex(p.as_expr()))
    collected: dict[tuple[int, str], list[str]] = {}
    for powers, value in p.terms():
        which = next(n for n, k in enumerate(powers[-len(COMBINATIONS) :]) if k)
        outer = _product([(_NAMES[n], powers[n]) for n in range(*_OUTER.indices(len(_NAMES)))])
        inner = _product([(COEFFICIENT_PARAMETERS[n], powers[n]) for n in _ANGLES_FIRST])
        size = abs(value)
        factor = "" if size == 1 else rational(size)
        collected.setdefault((which, outer), []).append(f"{'-' if value < 0 else '+'}{factor}{inner}")
    text = ""
    for which, outer in sorted(collected):
        head, upper = _COMBINATION[COMBINATIONS[which]]
        # A subscript reads better when it does not begin with a minus sign.
        parts = sorted(collected[which, outer], key=lambda t: t[0] == "-")
        sign = parts[0][0]
        if sign == "-":
            parts = ["+" + t[1:] for t in parts]
        text += f" {sign} {head}_{{{''.join(parts).removeprefix('+')}}}{upper} {outer}".rstrip()
    return text.removeprefix(" + ").strip()


def _product(factors: Sequence[tuple[str, int]]) -> str:
    return " ".join(_LATEX.get(n, n) + (f"^{k}" if k > 1 else "") for n, k in factors if k)


def rational(x: Rational) -> str:
    """A rational number."""
    f = Fraction(int(x.numerator), int(x.denominator))
    if f.denominator == 1:
        return str(f.numerator)
    return ("-" if f < 0 else "") + rf"\tfrac{{{abs(f.numerator)}}}{{{f.denominator}}}"


def amplitude(name: str) -> str:
    """``A_2s`` as the paper writes it."""
    n = "" if name[2] == "1" else name[2]
    return "A_0" if name == "A_0" else rf"A_{{{n}\Omega}}^{name[-1]}"
