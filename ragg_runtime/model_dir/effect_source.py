"""Does the Python of an effect do nothing but describe an effect?

An effect file imports SymPy and the derivation, writes formulas and ends in ``EFFECT = Effect(...)``. A file
that wants more (files, processes, the network, text that is evaluated) is unusual, and is not executed
before its user says so. This is a look at the text that catches what is plainly something else; it is not a
sandbox, and a file that was written to slip through may do so.
"""

from __future__ import annotations

import ast
import re

_MODULES = frozenset(
    re.findall(
        r"\S+",
        """__future__ cmath collections collections.abc dataclasses decimal enum fractions functools itertools math
    mpmath numbers numpy sympy typing
    derive.chain derive.context derive.effect derive.rotation derive.stages derive.symbols derive.transduction""",
    )
)
_REFUSED = frozenset(
    re.findall(
        r"\S+",
        """eval exec compile open input breakpoint setattr delattr globals locals vars builtins importlib
    os sys subprocess socket shutil pathlib ctypes pickle modules system popen
    sympify parse_expr parsing lambdify autowrap ufuncify preview utilities testing external interactive
    load loads loadtxt genfromtxt fromfile fromstring frombuffer memmap save savez savetxt tofile ctypeslib
    f2py lib DataSource""",
    )
)
# SymPy evaluates text that it is given in the place of a number; these take text as a name.
_TAKES_TEXT = frozenset(["Symbol", "symbols", "Dummy", "Function", "einsum"])


def unusual(text: bytes) -> str | None:
    """Why this source does more than describe an effect, with the line; ``None`` if it does not seem to."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        return None  # it cannot be executed either, and the error that says so is the better message
    nodes = list(ast.walk(tree))
    imported = {
        a.asname or a.name.split(".")[0]
        for node in nodes
        if isinstance(node, ast.Import)
        or (isinstance(node, ast.ImportFrom) and not (node.module or "").startswith("derive"))
        for a in node.names
    }
    for node in nodes:
        found = _imports(node) or _uses(node) or _calls(node, imported)
        if found is not None:
            return f"line {getattr(node, 'lineno', 1)}: {found}"
    return None


def _imports(node: ast.AST) -> str | None:
    if isinstance(node, ast.Import):
        return next((f"imports {a.name}" for a in node.names if a.name not in _MODULES), None)
    if isinstance(node, ast.ImportFrom):
        module = node.module or ""
        if node.level or not (module in _MODULES or module.startswith("derive.effects.")):
            return f"imports from {'.' * node.level}{module}"
        if module != "__future__":
            return next((f"imports {a.name}" for a in node.names if _refused(a.name) or a.name == "*"), None)
    return None


def _uses(node: ast.AST) -> str | None:
    if isinstance(node, ast.Name) and _refused(node.id):
        return f"uses {node.id}"
    if isinstance(node, ast.Attribute) and _refused(node.attr):
        return f"uses .{node.attr}"
    return None


def _calls(node: ast.AST, imported: set[str]) -> str | None:
    if not isinstance(node, ast.Call):
        return None
    arguments = [*node.args, *(k.value for k in node.keywords)]
    root: ast.expr = node.func
    while isinstance(root, ast.Attribute):
        root = root.value
    if isinstance(root, ast.Name) and root.id in imported:
        name = node.func.attr if isinstance(node.func, ast.Attribute) else root.id
        if name not in _TAKES_TEXT and any(map(_is_text, arguments)):
            return f"hands text to {name}"
    if isinstance(root, ast.Name) and root.id == "getattr":
        target = arguments[0] if arguments else None
        if not isinstance(target, ast.Name) or target.id in imported:
            return "uses getattr on a module"
    return None


def _refused(name: str) -> bool:
    return name in _REFUSED or (name.startswith("__") and name != "__all__")


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.JoinedStr) or (
        isinstance(node, ast.Constant) and isinstance(node.value, (str, bytes))
    )
