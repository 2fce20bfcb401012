"""README's five minutes, run as they are typed."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")


def blocks(heading: str) -> list[str]:
    """The indented blocks of a section of README."""
    section = README.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    found = re.findall(r"(?:^    .*\n(?:\n(?=    ))?)+", section, flags=re.MULTILINE)
    return [re.sub(r"^    ", "", b, flags=re.MULTILINE) for b in found]


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the commands need of a fresh clone: the files that they name."""
    place = tmp_path_factory.mktemp("clone")
    (place / "examples").mkdir()
    shutil.copy(ROOT / "examples" / "demo-flight.parquet", place / "examples")
    return place


def run(command: list[str], place: Path) -> str:
    own = {
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "OPENBLAS_NUM_THREADS": "1",
    }
    own["PYTHONPATH"] = str(ROOT)
    done = subprocess.run(
        command, cwd=place, env=os.environ | own, capture_output=True, text=True, timeout=280
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def typed(clone: Path) -> list[tuple[str, str]]:
    """Each line of the block of commands and what it printed. ``make demo`` has run: it makes the environment."""
    shell, _ = blocks("Five minutes to a first result")
    first, *lines = shell.splitlines()
    assert first == "make demo && . .venv/bin/activate"
    return [(line, run(["bash", "-euc", line], clone)) for line in lines]


def test_the_commands_of_the_five_minutes_work_as_typed(typed: list[tuple[str, str]], clone: Path) -> None:
    said = {line.split("#")[0].split()[1]: out for line, out in typed}
    assert "NOT adequate" in said["compare"]
    assert "thermal-scale" in said["diagnose"]
    assert "the model is now adequate" in said["add"]
    assert "thermal-scale" in said["history"]
    for line, _ in typed:
        for option in ("--report ", "-o "):
            for name in re.findall(f"{option}(\\S+)", line):
                assert (clone / name).stat().st_size > 1000, name
    assert (clone / "my-model-c" / "Makefile").exists()


def test_each_command_prints_the_next_one_with_its_real_paths(typed: list[tuple[str, str]]) -> None:
    said = {line.split("#")[0].split()[1]: out for line, out in typed}
    flight = "examples/demo-flight.parquet"
    assert f"next: ragg diagnose my-model {flight}" in said["compare"]
    assert f"next: ragg add my-model thermal-scale {flight}" in said["diagnose"]
    assert f"ragg compensate my-model {flight} -o compensated.csv --calibration frozen" in said["calibrate"]


def test_the_python_of_the_five_minutes_works_as_typed(typed: list[tuple[str, str]], clone: Path) -> None:
    _, code = blocks("Five minutes to a first result")
    tail = "\nassert d.found == ('thermal-scale',), d.found\nassert step.after.adequate\nassert analytical and simplified\n"
    run([sys.executable, "-c", code + tail], clone)
