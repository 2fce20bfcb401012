"""How large the project is: lines of Python per folder, words of Markdown, committed files; beside what they may be."""

from __future__ import annotations

import subprocess
from pathlib import Path

MOST = {
    "ragg_runtime": 24_000,
    "derive": 8_000,
    "tests": 12_000,
    "benchmarks + examples": 3_000,
    "words of Markdown": 25_000,
    "committed files": 450,
}


def committed(*patterns: str) -> list[Path]:
    listing = subprocess.run(
        ["git", "ls-files", "-z", *patterns], capture_output=True, text=True, check=True
    ).stdout
    return [p for p in map(Path, listing.split("\0")[:-1]) if p.is_file()]


def lines(folders: str) -> int:
    return sum(p.read_bytes().count(b"\n") for f in folders.split(" + ") for p in committed(f"{f}/*.py"))


found = {name: lines(name) for name in list(MOST)[:4]}
found["words of Markdown"] = sum(len(p.read_text("utf-8").split()) for p in committed("*.md"))
found["committed files"] = len(committed())
for name, most in MOST.items():
    print(f"{name:22} {found[name]:7,} of {most:7,}{'' if found[name] <= most else '  over'}")
