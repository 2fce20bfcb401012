"""Effects in one line: ``K_x * f_i**2 * temperature``, from text that is not to be trusted.

The text is parsed by Python's own parser into a syntax tree, of which only numbers, names, + - * / **,
parentheses and a few functions are translated to SymPy. Nothing is ever evaluated.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import sympy as sp

from derive.effect import Effect, EffectParameter, Values
from derive.stages import SensedForce
from derive.symbols import MOTION, symbol

if TYPE_CHECKING:
    from derive.chain import Context

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
STAGES = ("transducer",)
FORCES = ("f_i", "f_o", "f_p")
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*")
_RESERVED = frozenset(
    {"time", "cos_phi", "sin_phi", "inputs", "q", "j", "D", "V", "np", "i", "n", "p", "in", "lambda"}
)


class ExpressionError(ValueError):
    """The expression is not of the grammar, or names something that does not exist."""


def from_expression(
    identifier: str, stage: str, add: str, parameters: Mapping[str, Mapping[str, Any]]
) -> Effect:
    """An effect that adds ``add`` at a stage.

    Parameters
    ----------
    stage
        ``transducer``: ``add`` is specific force, in m/s^2 once names stand for SI values.
    add
        Names: f_i, f_o, f_p (force along input, output, pendulous axis), the motion channels, ``time``,
        ``cos_phi``, ``sin_phi``, any recorded channel, and the parameters.
    parameters
        Name -> {"unit": ..., optionally "shared": bool, "plausible": number}.

    Raises
    ------
    ExpressionError
    """
    if stage not in STAGES:
        raise ExpressionError(f"stage {stage!r}: expected one of {', '.join(STAGES)}")
    tree = _parse(add)
    names = sorted({n.id for n in ast.walk(tree) if isinstance(n, ast.Name)} - set(FUNCTIONS))
    for name in parameters:
        if not _NAME.fullmatch(name) or name in FORCES or name in FUNCTIONS or name in _RESERVED:
            raise ExpressionError(f"{name!r} cannot name a parameter")
        if name not in names:
            raise ExpressionError(f"parameter {name} does not occur in {add!r}")
    if not parameters:
        raise ExpressionError("an effect needs at least one parameter with a unit")
    recorded = {c.name for c in MOTION}
    known = recorded | set(FORCES) | set(parameters) | {"time", "cos_phi", "sin_phi"}
    channels = tuple(n for n in names if n not in known)
    for name in channels:
        if not _NAME.fullmatch(name) or name in _RESERVED:
            raise ExpressionError(f"{name!r} cannot name a channel")

    def transducer(i: sp.Expr, f: SensedForce, p: Values, c: Context) -> sp.Expr:
        values: dict[str, sp.Expr] = {f"f_{axis}": v for axis, v in zip("iop", f, strict=True)}
        values |= {"cos_phi": c.cos_phi, "sin_phi": c.sin_phi, "time": c.time}
        values |= dict(p.items())
        return i + _translate(tree.body, lambda n: values.get(n, symbol(n)))

    effect = Effect(
        id=identifier,
        title=f"{identifier}: {add}",
        physics="An effect of the user's own, given as one expression.",
        source="model.toml",
        equation=add,
        channels=channels,
        parameters=tuple(
            EffectParameter(
                name,
                name,
                str(q["unit"]),
                f"coefficient of {add}",
                float(q.get("plausible", 1.0)),
                shared=bool(q.get("shared", False)),
            )
            for name, q in parameters.items()
        ),
        transducer=transducer,
    )
    probe = _translate(tree.body, symbol)
    for name in parameters:
        if probe.has(sp.zoo, sp.nan) or probe.xreplace({symbol(m): sp.Integer(0) for m in parameters}) != 0:
            raise ExpressionError(f"{add!r} does not vanish when its parameters ({name} ...) are zero")
    return effect


def _parse(text: str) -> ast.Expression:
    if len(text) > LONGEST:
        raise ExpressionError(f"longer than {LONGEST} characters")
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
        raise ExpressionError(f"{text!r} is not an expression ({error})") from None
    _translate(tree.body, symbol)
    return tree


def _translate(node: ast.expr, name: Any, depth: int = 0) -> sp.Expr:
    if depth > 60:
        raise ExpressionError("nested too deeply")

    def inner(n: ast.expr) -> sp.Expr:
        return _translate(n, name, depth + 1)

    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        if isinstance(node.value, bool):
            raise ExpressionError("True and False are not numbers")
        if abs(node.value) > 1e30:
            raise ExpressionError(f"the number {str(node.value)[:20]} is out of range")
        return sp.Integer(node.value) if isinstance(node.value, int) else sp.Rational(repr(node.value))
    if isinstance(node, ast.Name):
        return name(node.id)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.UAdd, ast.USub)):
        return inner(node.operand) if isinstance(node.op, ast.UAdd) else -inner(node.operand)
    if isinstance(node, ast.BinOp):
        left = inner(node.left)
        if isinstance(node.op, ast.Pow):
            exponent = node.right
            if not (
                isinstance(exponent, ast.Constant) and type(exponent.value) is int and 0 < exponent.value <= 8
            ):
                raise ExpressionError("an exponent must be a whole number from 1 to 8")
            return left**exponent.value
        right = inner(node.right)
        if isinstance(node.op, ast.Add):
            return left + right
        if isinstance(node.op, ast.Sub):
            return left - right
        if isinstance(node.op, ast.Mult):
            return left * right
        if isinstance(node.op, ast.Div):
            if right == 0:
                raise ExpressionError("division by zero")
            return left / right
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS:
        if len(node.args) != 1 or node.keywords:
            raise ExpressionError(f"{node.func.id} takes one argument")
        return FUNCTIONS[node.func.id](inner(node.args[0]))
    raise ExpressionError(
        f"{ast.unparse(node)[:40]!r} is not allowed: "
        f"numbers, names, + - * / **, parentheses and {', '.join(FUNCTIONS)}"
    )
