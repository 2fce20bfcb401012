"""Polynomials of the audit's ring back into the paper's notation (LaTeX)."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import sympy as sp
from sympy.polys.rings import PolyElement

from derive.audit.compare import Rational
from derive.audit.reading import COMBINATIONS, MODEL_RING
from derive.propagation import COEFFICIENT_PARAMETERS

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
