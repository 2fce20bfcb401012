"""README's five minutes, as they are typed."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from commands import ragg

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")
SAMPLES = 4800
"""Five minutes of the shipped flight are enough for all that README says of it."""


def blocks(heading: str) -> list[str]:
    """The indented blocks of a section of README."""
    section = README.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    found = re.findall(r"(?:^    .*\n(?:\n(?=    ))?)+", section, flags=re.MULTILINE)
    return [re.sub(r"^    ", "", b, flags=re.MULTILINE) for b in found]


SHELL, PYTHON = blocks("Five minutes to a first result")


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """What the commands need of a fresh clone, and the folder where they run: the files that they name."""
    place = tmp_path_factory.mktemp("clone")
    (place / "examples").mkdir()
    whole = pq.read_table(ROOT / "examples" / "demo-flight.parquet")
    pq.write_table(whole.slice(0, SAMPLES), place / "examples" / "demo-flight.parquet")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(place)
        yield place


@pytest.fixture(scope="module")
def said(clone: Path) -> dict[str, str]:
    """Each command of the block and what it printed. ``make demo`` has run: it makes the environment."""
    first, *lines = SHELL.splitlines()
    assert first == "make demo && . .venv/bin/activate"
    found = {}
    for line in lines:
        program, command, *rest = shlex.split(line, comments=True)
        done = ragg(command, *rest)
        assert (program, done.returncode) == ("ragg", 0), line + done.stderr
        found[command] = done.stdout
    return found


def test_the_commands_of_the_five_minutes_work_as_typed(said: dict[str, str], clone: Path) -> None:
    assert "NOT adequate" in said["compare"]
    assert "thermal-scale" in said["diagnose"]
    assert "the model is now adequate" in said["add"]
    assert "thermal-scale" in said["history"]
    for name in re.findall(r"(?:--report|-o) (\S+)", SHELL):
        assert (clone / name).stat().st_size > 1000, name
    assert (clone / "my-model-c" / "Makefile").exists()


def test_each_command_prints_the_next_one_with_its_real_paths(said: dict[str, str]) -> None:
    flight = "examples/demo-flight.parquet"
    assert f"next: ragg diagnose my-model {flight}" in said["compare"]
    assert f"next: ragg add my-model thermal-scale {flight}" in said["diagnose"]
    assert f"ragg compensate my-model {flight} -o compensated.csv --calibration frozen" in said["calibrate"]


def test_the_python_of_the_five_minutes_works_as_typed(clone: Path) -> None:
    made: dict[str, object] = {}
    exec(PYTHON, made)
    d, step = made["d"], made["step"]
    assert d.found == ("thermal-scale",)  # type: ignore[attr-defined]
    assert step.after.adequate  # type: ignore[attr-defined]
    assert made["analytical"] and made["simplified"]
