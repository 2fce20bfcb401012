"""The page of promises: every test that it names exists, and its figures are of one run."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests import promises

ROOT = Path(__file__).parents[2]
TEXT = promises.PAGE.read_text("utf-8")


def test_every_test_that_is_named_exists() -> None:
    named = set(re.findall(r"`((?:tests/[\w./-]*|test_\w+\.py|ragg_runtime/[\w./-]+))`", TEXT))
    assert len(named) > 20
    for name in sorted(named):
        place = ROOT / "tests" / "runtime" / name if name.startswith("test_") else ROOT / name
        assert place.exists(), f"{name} is named in docs/trust.md"


def test_every_target_that_is_named_exists() -> None:
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE))
    named = set(re.findall(r"`make ([a-z-]+)`", TEXT))
    assert len(named) > 4
    assert named <= targets


@pytest.mark.parametrize(
    "who",
    [
        "flight file",
        "model directory",
        "current folder",
        "scheduler",
        "browser page",
        "neighbour on the machine",
    ],
)
def test_every_adversary_has_a_test(who: str) -> None:
    rows = [line for line in TEXT.splitlines() if line.startswith(f"| **a {who}") or f"**the {who}" in line]
    assert rows
    assert all(re.search(r"`(test_\w+\.py|tests/\w+)", row.split("|")[-2]) for row in rows)


def test_the_figures_are_of_one_run() -> None:
    table = TEXT.split(promises.BEGIN)[1].split(promises.END)[0].strip()
    assert re.match(r"Commit [0-9a-f]{7,}, \d{4}-\d\d-\d\d, Python 3\.\d+\.", table)
    assert "| fuzzing | " in table
    assert "0 findings" in table
