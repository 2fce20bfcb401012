"""Expressions as source text (NumPy, C and LaTeX), and the jinja environment of all emitters, whose filters print them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from functools import cache

import jinja2
import sympy as sp
from sympy.printing.c import C99CodePrinter
from sympy.printing.codeprinter import CodePrinter
from sympy.printing.latex import LatexPrinter
from sympy.printing.numpy import NumPyPrinter

from derive.layout import HEIGHT, TURN
from derive.names import in_comment
from derive.propagation import COEFFICIENT_PARAMETERS
from derive.symbols import (
    ACCELEROMETER,
    INSTRUMENT,
    MOTION,
    QUARTER_TURNS,
    SIGNS,
    SPIN_ACCELERATION,
    SPIN_RATE,
)
from derive.tape import Program


class _Code(CodePrinter):
    """What is the same in every language: short decimals in the place of fractions."""

    def _print_Rational(self, e: sp.Rational) -> str:
        return _decimal(e) or str(super()._print_Rational(e))

    def parenthesize(self, item: sp.Expr, level: int, strict: bool = False) -> str:
        if item.is_Rational and item.is_positive and _decimal(item):
            return _decimal(item)
        return str(super().parenthesize(item, level, strict))


class _NumPy(_Code, NumPyPrinter):
    def __init__(self) -> None:
        super().__init__({"fully_qualified_modules": False})

    def _print_Heaviside(self, e: sp.Expr) -> str:
        return f"np.heaviside({self._print(e.args[0])}, 1.0)"

    def _print_Function(self, e: sp.Expr) -> str:
        return f"np.{super()._print_Function(e)}"

    def _print_Abs(self, e: sp.Expr) -> str:
        return f"np.abs({self._print(e.args[0])})"

    def _module_format(self, fqn: str, register: bool = True) -> str:
        return fqn.replace("numpy.", "np.")


class _C(_Code, C99CodePrinter):
    def _print_Pow(self, e: sp.Pow) -> str:
        if e.exp.is_Integer and 2 <= e.exp <= 6:
            base = self.parenthesize(e.base, sp.printing.precedence.PRECEDENCE["Mul"] + 1)
            return "(" + "*".join([base] * int(e.exp)) + ")"
        return str(super()._print_Pow(e))

    def _print_Integer(self, e: sp.Integer) -> str:
        return f"{int(e)}.0"

    def _print_Pi(self, e: sp.Expr) -> str:
        return repr(math.pi)  # M_PI is not in standard C

    def _print_Heaviside(self, e: sp.Expr) -> str:
        return f"(({self._print(e.args[0])}) >= 0.0 ? 1.0 : 0.0)"

    def _print_sign(self, e: sp.Expr) -> str:
        x = self._print(e.args[0])
        return f"((double)(({x}) > 0.0) - (double)(({x}) < 0.0))"


class _Fused(_C):
    """C in which every product that is added to something is a FMA(x, y, z): the same bits by any compiler."""

    def _print_Add(self, e: sp.Expr, order: str | None = None) -> str:
        plain, products = [], []
        for term in self._as_ordered_terms(e, order=order):
            sign, factors = self._factors(term)
            if len(factors) > 1:
                products.append((sign, factors))
            else:
                plain.append(sign + factors[0])
        if not plain:  # a positive one: the others' signs are part of a fused instruction, its own is not
            positive = next((n for n, (sign, _) in enumerate(products) if not sign), 0)
            sign, factors = products.pop(positive)
            plain.append(sign + "*".join(factors))
        total = " + ".join(plain).replace("+ -", "- ")
        for sign, (first, *others) in products:
            total = f"FMA({sign}{first}, {'*'.join(others)}, {total})"
        return total

    def _factors(self, term: sp.Expr) -> tuple[str, list[str]]:
        """Sign and printed factors of a product."""
        coefficient, rest = term.as_coeff_Mul()
        sign = "-" if coefficient.is_negative else ""
        factors = [] if abs(coefficient) is sp.S.One else [self._print(abs(coefficient))]
        for part in sp.Mul.make_args(rest):
            base, power = part.as_base_exp()
            times = int(power) if power.is_Integer and 0 < int(power) <= 6 else 1
            factor = base if times > 1 else part
            text = self._print(factor)
            bare = factor.is_Symbol or text.startswith("FMA(")
            factors += [text if bare else f"({text})"] * times
        return sign, factors


def _decimal(e: sp.Rational) -> str:
    """A rational that is a short decimal, exactly; otherwise nothing."""
    value = int(e.p) / int(e.q)
    text = repr(value)
    return text if sp.Rational(text) == e and "e" not in text else ""


class _LaTeX(LatexPrinter):
    def _print_Symbol(self, e: sp.Symbol, style: str = "plain") -> str:
        return _SYMBOLS.get(e.name) or str(super()._print_Symbol(e, style))


_SYMBOLS: dict[str, str] = {c.name: c.latex for c in MOTION}
_SYMBOLS |= {q.name: q.latex for q in INSTRUMENT} | {"k1": "k_1", "R": "R"}
_SYMBOLS |= {SPIN_RATE.name: r"{\dot\phi}", SPIN_ACCELERATION.name: r"\ddot\phi", HEIGHT.name: "h_j"}
_SYMBOLS |= {TURN[i, k].name: f"u_{{{'rtz'[i]}{'rtz'[k]}}}" for i in range(3) for k in range(3)}


_IN_NUMPY = _NumPy()
_IN_C, _IN_FUSED_C = _C({"contract": False}), _Fused({"contract": False})
_IN_WIDE_C = _C({"contract": False, "user_functions": {"sin": "sinl", "cos": "cosl"}})  # long double
_IN_LATEX = _LaTeX()
"""One printer each: to make one takes as long as to print an expression."""


@cache  # models that are derived one after the other share most of their expressions
def to_numpy(e: sp.Expr) -> str:
    return str(_IN_NUMPY.doprint(e))


@cache
def to_c(e: sp.Expr) -> str:
    return str(_IN_C.doprint(e))


@cache
def to_fused_c(e: sp.Expr) -> str:
    return str(_IN_FUSED_C.doprint(e))


def to_wide_c(e: sp.Expr) -> str:
    return str(_IN_WIDE_C.doprint(e))


def to_latex(e: sp.Expr) -> str:
    return str(_IN_LATEX.doprint(e))


@cache
def environment(package: str) -> jinja2.Environment:
    """For the templates in the folder ``templates`` of a package."""
    env = jinja2.Environment(
        loader=jinja2.PackageLoader(package, "templates"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # the output is source code, not markup
        optimized=False,  # most are rendered once: that takes longer than it spares
    )
    env.filters |= {"np": to_numpy, "c": to_c, "fused": to_fused_c, "wide": to_wide_c}
    env.filters |= {"tex": to_latex, "comment": in_comment}
    env.globals |= {
        "quarter_turns": QUARTER_TURNS,
        "signs": SIGNS,
        "per_accelerometer": [p.name for p in ACCELEROMETER],
        "coefficient_parameters": COEFFICIENT_PARAMETERS,
        "program_inputs": _program_inputs,
        "trig": _trig,
    }
    return env


def render_page(package: str, template: str, values: Mapping[str, object]) -> str:
    """A page of Markdown from a template in the folder ``templates`` of a package."""
    return environment(package).get_template(template).render(values).rstrip() + "\n"


def number(x: float | Fraction, digits: int = 3) -> str:
    """Significant digits; 4e6, not 4e+06."""
    mantissa, e, exponent = f"{float(x):.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def _trig(n: int, phase: str) -> str:
    return "1" if n == 0 else f"{phase}{n}"


def _program_inputs(program: Program, among: list[str]) -> list[str]:
    read = {s.name for s in program.inputs}
    return [n for n in among if n in read]
