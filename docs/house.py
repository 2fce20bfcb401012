"""The picture of the house: rooms on their floors, read from the layers that import-linter holds."""

from __future__ import annotations

import html
import re
import tomllib
from collections.abc import Sequence
from pathlib import Path

WIDTH, GAP, LINE, LETTER = 920, 12, 15, 6.4


def floors(root: Path) -> list[list[tuple[str, str]]]:
    """(room, the first sentence of its docstring) on every floor, from the top."""
    contracts = tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    layers = next(c["layers"] for c in contracts if c["type"] == "layers")
    return [[(r.strip(), _sentence(root, r.strip())) for r in floor.split("|")] for floor in layers]


def _sentence(root: Path, room: str) -> str:
    text = (root / "ragg_runtime" / room / "__init__.py").read_text("utf-8")
    words = " ".join(text.split('"""')[1].split())
    return re.split(r"(?<!Eq)\. ", words)[0].rstrip(".").replace("``", "")


def drawn(root: Path) -> str:
    """The picture as SVG: every room may import what is on the floors below it."""
    rows = [*floors(root), [("derive", "The physics, symbolic"), ("generated", "What the derivation yields")]]
    boxes, y = [], 0
    for row in rows:
        made, high = _row(row, y)
        boxes += made
        y += high + GAP
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {y}" role="img"'
        ' font-family="sans-serif"><title>The rooms and their floors</title>' + "".join(boxes) + "</svg>\n"
    )


def _row(rooms: Sequence[tuple[str, str]], y: int) -> tuple[list[str], int]:
    """The boxes of a floor, and its height."""
    width = (WIDTH - GAP * (len(rooms) - 1)) // len(rooms)
    texts = [_lines(says, int((width - 24) / LETTER)) for _, says in rooms]
    height = 38 + LINE * max(map(len, texts))
    found = []
    for k, ((name, _), lines) in enumerate(zip(rooms, texts, strict=True)):
        x = k * (width + GAP)
        found.append(
            f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="6" fill="#dbe7f3" stroke="#4b6b88"/>'
            f'<text x="{x + 12}" y="{y + 24}" font-size="17" font-weight="600" fill="#12283a">{name}</text>'
        )
        for n, line in enumerate(lines):
            found.append(
                f'<text x="{x + 12}" y="{y + 42 + LINE * n}" font-size="12.5" fill="#2c4257">'
                f"{html.escape(line)}</text>"
            )
    return found, height


def _lines(text: str, most: int) -> list[str]:
    lines = [""]
    for word in text.split():
        if len(lines[-1]) + len(word) + 1 > most:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines
