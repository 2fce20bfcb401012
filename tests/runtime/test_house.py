"""The house stays one that can be lived in: small files and functions, few rooms, and each says which others it stands on."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGES = ("derive", "ragg", "ragg_runtime", "benchmarks", "examples")
LONGEST_FILE, LONGEST_FUNCTION = 400, 60


@cache
def sources() -> dict[str, str]:
    found = (p for package in PACKAGES for p in sorted((ROOT / package).rglob("*.py")))
    return {p.relative_to(ROOT).as_posix(): p.read_text("utf-8") for p in found}


@cache
def trees() -> dict[str, ast.Module]:
    return {name: ast.parse(text) for name, text in sources().items()}


def test_no_file_is_too_long() -> None:
    assert [name for name, text in sources().items() if text.count("\n") > LONGEST_FILE] == []


def test_no_function_is_too_long() -> None:
    found = [
        f"{name}: {node.name}"
        for name, tree in trees().items()
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        and (node.end_lineno or 0) - node.lineno >= LONGEST_FUNCTION
    ]
    assert found == []


RUNTIME = ROOT / "ragg_runtime"
MOST_ROOMS, MOST_ARROWS = 20, 95
"""Packages of the runtime, and imports from one to another, ``derive`` and ``generated`` among these."""


@cache
def arrows() -> dict[str, list[str]]:
    """Room -> the rooms that it imports from, anywhere in its files."""
    rooms = [p.parent.name for p in sorted(RUNTIME.glob("*/__init__.py"))]
    found: dict[str, set[str]] = {room: set() for room in rooms}
    for name, tree in trees().items():
        top, room, *_ = name.split("/")
        if top != "ragg_runtime" or room not in found:
            continue
        for node in ast.walk(tree):
            modules = [a.name for a in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.level == 0:
                modules = [f"{node.module}.{a.name}" for a in node.names]
            for first, second, *_ in (f"{m}.".split(".") for m in modules):
                if first in ("derive", "generated"):
                    found[room].add(first)
                elif first == "ragg_runtime" and second in found:
                    found[room].add(second)
    return {room: sorted(others - {room}) for room, others in found.items()}


def test_every_room_says_which_others_it_imports() -> None:
    for room, others in arrows().items():
        names = [f"``{o}``" for o in others]
        listed = " and ".join(filter(None, (", ".join(names[:-1]), *names[-1:])))
        text = (RUNTIME / room / "__init__.py").read_text("utf-8")
        said = " ".join((ast.get_docstring(ast.parse(text)) or "").split())
        assert said.endswith(f"Imports {listed or 'nothing of ours'}."), f"{room} imports {listed}"


def test_rooms_and_arrows_are_few() -> None:
    found = arrows()
    assert len(found) <= MOST_ROOMS
    assert sum(map(len, found.values())) <= MOST_ARROWS


BY_PLACE = 4
"""Values of a record that may be told by their place where it is built; of more each is said by its name."""


def test_records_are_built_by_keyword() -> None:
    """But for tables, outside functions and in the audit of printed numbers: they are read by their columns."""
    ours = {
        name: tree
        for name, tree in trees().items()
        if name.startswith(("ragg_runtime/", "derive/")) and not name.startswith("derive/audit/")
    }
    records = {
        c.name
        for tree in ours.values()
        for c in ast.walk(tree)
        if isinstance(c, ast.ClassDef) and any("dataclass" in ast.unparse(d) for d in c.decorator_list)
    }
    found = {
        f"{name}:{call.lineno} {ast.unparse(call.func)}"
        for name, tree in ours.items()
        for f in ast.walk(tree)
        if isinstance(f, ast.FunctionDef | ast.Lambda)
        for call in ast.walk(f)
        if isinstance(call, ast.Call)
        and len(call.args) > BY_PLACE
        and not any(isinstance(a, ast.Starred) for a in call.args)
        and ast.unparse(call.func).split(".")[-1] in records
    }
    assert found == set()
