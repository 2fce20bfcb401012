"""README's five minutes, run as they are typed, and every command and file that README and the site name."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from ragg_runtime.cli.main import COMMANDS

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
PAGES = [p for p in PAGES if not {"_build", "_made"} & set(p.parts)]


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
    assert "The model is now adequate" in said["add"]
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


def test_all_that_readme_links_to_is_there() -> None:
    links = [x for x in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", README) if "://" not in x]
    assert len(links) > 20
    assert [x for x in links if not (ROOT / x).exists()] == []


def _named(pattern: str) -> Iterator[tuple[Path, str]]:
    for page in PAGES:
        for found in re.findall(pattern, page.read_text("utf-8"), flags=re.MULTILINE):
            yield page, found


def test_every_command_that_a_page_names_exists() -> None:
    known = set(COMMANDS)
    named = list(_named(r"(?:`|^    (?:\$ )?)ragg ([a-z][a-z-]+)"))
    assert len(named) > 50
    assert [(p.name, c) for p, c in named if c not in known] == []


def test_every_target_of_make_that_a_page_names_exists() -> None:
    known = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text("utf-8"), flags=re.MULTILINE))
    named = list(_named(r"(?:`|^    )make ([a-z][a-z-]+)"))
    assert len(named) > 15
    assert [(p.name, t) for p, t in named if t not in known] == []


def test_every_file_that_the_pages_about_the_house_name_exists() -> None:
    packages = ("derive", "ragg", "ragg_runtime", "generated", "benchmarks", "examples", "tests")
    files = [
        "/" + p.relative_to(ROOT).as_posix() for package in packages for p in (ROOT / package).rglob("*.py")
    ]
    named = {
        name
        for page in ("architecture.md", "house.md", "compensation.md", "formulas.md")
        for name in re.findall(r"`([a-z_0-9/]+\.py)`", (ROOT / "docs" / page).read_text("utf-8"))
    }
    assert len(named) > 30
    assert sorted(n for n in named if not any(f.endswith(f"/{n}") for f in files)) == []
