"""Effects in one line: ``K_x * f_i**2 * temperature``, from text that is not to be trusted.

The text is parsed by Python's own parser into a syntax tree, of which only numbers, names, + - * / **,
parentheses and a few functions are translated to SymPy. Nothing is ever evaluated, and what is written into
generated files is the tree as text again: comments and odd spellings of names do not get there.
"""

from __future__ import annotations

import ast
import keyword
import operator
import re
import warnings
from collections.abc import Collection, Mapping
from typing import Any

import sympy as sp

from derive.effect import Context, Effect, EffectParameter, Values
from derive.names import EXPECTED, is_name
from derive.stages import SensedForce
from derive.symbols import MOTION, RATES, symbol

LONGEST = 500
"""Longest expression, characters."""

FUNCTIONS = {
    "abs": sp.Abs,
    "sin": sp.sin,
    "cos": sp.cos,
    "exp": sp.exp,
    "tanh": sp.tanh,
    "sqrt": sp.sqrt,
    "sign": sp.sign,
}
OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv}
STAGES = ("transducer",)
FORCES = ("f_i", "f_o", "f_p")
DEEPEST = 60
"""Deepest nesting."""

HIGHEST = 24
"""Highest degree: that of nested powers multiplies up."""

_BITS = 512  # of a number that powers and products of numbers may yield: 1e154
_LARGEST = 1e30
_WORD = re.compile(r"(?<![\w.])[A-Za-z]\w*", re.ASCII)
# Words of the grammar.
_TAKEN = frozenset({"time", "cos_phi", "sin_phi", *FORCES, *FUNCTIONS, *(c.name for c in MOTION), *RATES})


class ExpressionError(ValueError):
    """The expression is not of the grammar, or names something that does not exist."""


def from_expression(
    identifier: str, stage: str, add: str, parameters: Mapping[str, Mapping[str, Any]]
) -> Effect:
    """An effect that adds ``add`` at a stage.

    Parameters
    ----------
    stage
        ``transducer``: ``add`` is specific force, in m/s^2 with names in SI.
    add
        Names: f_i, f_o, f_p (force along input, output, pendulous axis), the motion channels, their time
        derivatives (``d_a_x``, ``d2_a_x``), ``time``, ``cos_phi``, ``sin_phi``, any recorded channel, and the
        parameters. The last two may have any other name.
    parameters
        Name -> {"unit": ..., optionally "shared": bool, "plausible": number}.

    Raises
    ------
    ExpressionError
    """
    if not is_name(identifier):
        raise ExpressionError(f"id {identifier[:80]!r}: expected {EXPECTED}")
    if stage not in STAGES:
        raise ExpressionError(f"stage {stage!r}: expected one of {', '.join(STAGES)}")
    tree = _parse(add, parameters)
    add = ast.unparse(tree)
    channels = _channels(tree, add, parameters)

    def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
        values: dict[str, sp.Expr] = {f"f_{axis}": v for axis, v in zip("iop", f, strict=True)}
        values |= {"cos_phi": c.cos_phi, "sin_phi": c.sin_phi, "time": c.time}
        values |= dict(p.items())
        return i + _translate(tree.body, lambda n: values[n] if n in values else c.channel(n))

    effect = Effect(
        id=identifier,
        title=f"{identifier}: {add}",
        physics="An effect of the user's own, given as one expression.",
        source="model.toml",
        equation=add,
        channels=channels,
        parameters=tuple(
            EffectParameter(
                name=name,
                latex=name,
                unit=str(q["unit"]),
                meaning=f"coefficient of {add}",
                plausible=_plausible(name, q.get("plausible", 1.0)),
                shared=_shared(name, q.get("shared", False)),
            )
            for name, q in parameters.items()
        ),
        transducer=transducer,
    )
    _check_size(tree, add, list(parameters))
    return effect


def _channels(tree: ast.Expression, add: str, parameters: Mapping[str, Mapping[str, Any]]) -> tuple[str, ...]:
    """Names of an expression that are channels; ExpressionError where a name is none, or a parameter does not occur."""
    names = sorted({n.id for n in ast.walk(tree) if isinstance(n, ast.Name)} - set(FUNCTIONS))
    for name in parameters:
        # In generated code its name is that of the effect and its own.
        if not is_name(name) or name in _TAKEN:
            raise ExpressionError(
                f"{name[:80]!r} cannot name a parameter: expected {EXPECTED}; no word of expressions"
            )
        if "-" in name:
            raise ExpressionError(f"{name!r} cannot be used in an expression, where - means minus: write _")
        if name not in names:
            raise ExpressionError(f"parameter {name} does not occur in {add!r}")
    if not parameters:
        raise ExpressionError("an effect needs at least one parameter with a unit")
    channels = tuple(n for n in names if n not in _TAKEN and n not in parameters)
    for name in channels:
        if not is_name(name):
            raise ExpressionError(f"{name[:80]!r} cannot name a channel: expected {EXPECTED}")
    return channels


def _check_size(tree: ast.Expression, add: str, parameters: list[str]) -> None:
    """Refuse what does not vanish with its parameters, or grows without bound as they begin to."""
    probe = _translate(tree.body, symbol)
    neutral = {symbol(m): sp.Integer(0) for m in parameters}
    bad = (sp.zoo, sp.nan, sp.oo, -sp.oo, sp.DiracDelta)
    if probe.has(*bad) or probe.xreplace(neutral) != 0:
        raise ExpressionError(
            f"{add!r} does not vanish when its parameters ({', '.join(parameters)}) are zero"
        )
    for m in parameters:
        try:
            slope = probe.diff(symbol(m)).xreplace(neutral)
        except ValueError:  # SymPy leaves some derivatives open, and then finds that it differentiates by 0
            slope = sp.nan
        if slope.has(*bad, sp.Derivative):
            raise ExpressionError(f"{add!r} has no finite slope in {m} where its parameters are zero")


def _plausible(name: str, value: object) -> float:
    if isinstance(value, (int, float)) and not isinstance(value, bool) and 0 < value < _LARGEST:
        return float(value)
    raise ExpressionError(f"{name}: plausible {value!r}: expected a positive number, in the parameter's unit")


def _shared(name: str, value: object) -> bool:
    if isinstance(value, bool):
        return value
    raise ExpressionError(f"{name}: shared {value!r}: expected true or false")


def _parse(text: str, parameters: Collection[str]) -> ast.Expression:
    if len(text) > LONGEST:
        raise ExpressionError(f"longer than {LONGEST} characters")
    words = frozenset(keyword.kwlist)
    for names in (words.intersection(parameters), words):  # a channel may be called lambda
        try:
            tree = _tree(text, names)
            break
        except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
            reason = error.msg if isinstance(error, SyntaxError) else str(error)
    else:
        raise ExpressionError(f"{text!r} is not an expression ({reason})")
    if not text.isascii():
        raise ExpressionError(f"{text!r}: letters, digits and signs of ASCII only")
    _translate(tree.body, symbol)
    return tree


def _tree(text: str, words: Collection[str]) -> ast.Expression:
    """The syntax tree, in which these words of Python are names as others are."""
    spelt = _WORD.sub(lambda m: m[0] + "_" if m[0].rstrip("_") in words else m[0], text.strip())
    with warnings.catch_warnings():  # "0or 1" and the like: such warnings are about Python programs
        warnings.simplefilter("ignore")
        tree = ast.parse(spelt, mode="eval")
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and node.id.rstrip("_") in words:
            node.id = node.id[:-1]
    return tree


def _translate(node: ast.expr, name: Any, depth: int = 0, degree: int = 1) -> sp.Expr:
    """The tree in SymPy; ``degree`` is the product of the exponents applied to ``node``."""
    if depth > DEEPEST:
        raise ExpressionError("nested too deeply")

    def inner(n: ast.expr, times: int = 1) -> sp.Expr:
        return _translate(n, name, depth + 1, degree * times)

    if (
        isinstance(node, ast.Constant)
        and isinstance(node.value, (int, float))
        and type(node.value) is not bool
    ):
        return _constant(node.value)
    if isinstance(node, ast.Name):
        return name(node.id)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.UAdd, ast.USub)):
        return inner(node.operand) if isinstance(node.op, ast.UAdd) else -inner(node.operand)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
        n = node.right.value if isinstance(node.right, ast.Constant) else None
        if type(n) is not int or not 0 < n <= 8:
            raise ExpressionError("an exponent must be a whole number from 1 to 8")
        if degree * n > HIGHEST:
            raise ExpressionError(f"powers of powers: the degree is above {HIGHEST}")
        base = inner(node.left, n)
        if base.is_Rational and n * _bits(base) > _BITS:
            raise ExpressionError("a power of a number is out of range")
        return _require_size(base**n)
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        left, right = inner(node.left), inner(node.right)
        if isinstance(node.op, ast.Div) and right == 0:
            raise ExpressionError("division by zero")
        return _require_size(OPERATORS[type(node.op)](left, right))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS:
        if len(node.args) != 1 or node.keywords or isinstance(node.args[0], ast.Starred):
            raise ExpressionError(f"{node.func.id} takes one argument")
        argument = inner(node.args[0])
        # Numbers of numbers (exp(exp(30))) may have no digits that anyone could compute.
        if not argument.free_symbols and not (argument.is_Rational and abs(argument) <= 100):
            raise ExpressionError(f"{node.func.id} of a number: write its value")
        return FUNCTIONS[node.func.id](argument)
    raise ExpressionError(
        f"{_show(node)!r} is not allowed: numbers, names, + - * / **, parentheses and {', '.join(FUNCTIONS)}"
    )


def _constant(value: float) -> sp.Expr:
    if not abs(value) <= _LARGEST or (value != 0 and abs(value) < 1 / _LARGEST):
        # Python refuses to print integers of more than 4,300 digits.
        shown = str(value)[:20] if isinstance(value, float) else f"of {value.bit_length()} bits"
        raise ExpressionError(f"the number {shown} is out of range")
    return sp.Integer(value) if isinstance(value, int) else sp.Rational(repr(value))


def _bits(e: sp.Expr) -> int:
    return max(int(e.p).bit_length(), int(e.q).bit_length())


def _require_size(e: sp.Expr) -> sp.Expr:
    """``e``, unless it holds a number with more digits than any quantity has."""
    for number in e.atoms(sp.Rational):
        if _bits(number) > _BITS:
            raise ExpressionError("a number made of numbers is out of range")
    return e


def _show(node: ast.AST) -> str:
    try:
        return ast.unparse(node)[:40]
    except (RecursionError, ValueError):
        return type(node).__name__
