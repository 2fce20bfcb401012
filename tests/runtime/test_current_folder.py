"""No code from the current folder: neither in a command nor in the processes that it starts."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import ragg_runtime
from ragg_runtime.flight import write_flight
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated

ROOT = Path(ragg_runtime.__file__).parents[1]
# As pip writes the command.
COMMAND = (
    "import sys\nfrom ragg_runtime.cli.main import main\nif __name__ == '__main__':\n    sys.exit(main())\n"
)
EVIL = "import os\nos.close(os.open({mark!r}, os.O_CREAT | os.O_WRONLY))\nraise SystemExit('executed')\n"
# Of the standard library, of others, of this program: what is looked up early and late.
NAMES = (
    *("pickle", "multiprocessing", "struct", "json", "selectors", "socket", "tempfile", "random", "hashlib"),
    *("signal", "queue", "threading", "click", "numpy", "scipy", "sympy", "pandas", "pyarrow", "pint"),
    *("platformdirs", "matplotlib", "threadpoolctl", "derive", "generated", "sitecustomize"),
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a model and a short flight, in which everything that is imported has a double."""
    place = tmp_path_factory.mktemp("folder")
    m = loop.new(place / "model")
    write_flight(simulated(m.instrument, [], seed=1, duration=90.0, rate=16.0), place / "f.parquet")
    for name in NAMES:
        text = EVIL.format(mark=str(place / f"executed-{name}"))
        (place / f"{name}.py").write_text(text)
    for name in ("generated", "derive"):  # a package comes before a module of its name
        (place / name).mkdir()
        (place / name / "__init__.py").write_text(EVIL.format(mark=str(place / f"executed-{name}")))
    return place


def run(folder: Path, *words: str | Path, **environment: str) -> str:
    clean = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "PYTHONSAFEPATH")}
    done = subprocess.run(
        [str(w) for w in words],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
        env=clean | environment,
    )
    assert not list(folder.glob("executed-*")), done.stderr
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_program_as_a_module(folder: Path) -> None:
    assert "new" in run(folder, sys.executable, "-m", "ragg_runtime", "history", "model")
    assert "1800" not in run(folder, sys.executable, "-m", "ragg_runtime", "compare", "model", "f.parquet")


@pytest.mark.parametrize("by", ["command", "module"])
def test_the_workers_of_a_survey(folder: Path, tmp_path: Path, by: str) -> None:
    (tmp_path / "ragg").write_text(COMMAND)
    words = [tmp_path / "ragg"] if by == "command" else ["-m", "ragg_runtime"]
    assert "1 flight:" in run(folder, sys.executable, *words, "survey", "model", "f.parquet", "--jobs", "1")


def test_a_checkout_that_is_not_installed(tmp_path: Path) -> None:
    """Where the current folder is the program itself, it serves; workers find it too."""
    for name in ("ragg_runtime", "derive", "generated"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    code = "import ragg_runtime, generated; print(ragg_runtime.__file__, generated.__file__)"
    assert run(tmp_path, sys.executable, "-c", code).count(str(tmp_path)) == 2
    out = run(tmp_path, sys.executable, "-m", "ragg_runtime", "effects")
    assert "thermal-scale" in out
    (tmp_path / "data").mkdir()
    m = loop.new(tmp_path / "data" / "model")
    write_flight(
        simulated(m.instrument, [], seed=1, duration=90.0, rate=16.0), tmp_path / "data" / "f.parquet"
    )
    words = ["survey", "data/model", "data/f.parquet", "--jobs", "1"]
    assert "1 flight:" in run(tmp_path, sys.executable, "-m", "ragg_runtime", *words)


def test_a_file_of_settings_of_figures_is_none_of_ours(folder: Path, tmp_path: Path) -> None:
    """The same input gives the same report, whatever matplotlib finds in the current folder."""
    (tmp_path / "matplotlibrc").write_text(
        "backend: module://evil\ntext.usetex: True\nlines.marker: x\naxes.facecolor: red\n"
    )
    pages = []
    for cwd in (folder, tmp_path):
        words = ["compare", folder / "model", folder / "f.parquet", "--report", tmp_path / "r.html"]
        run(cwd, sys.executable, "-m", "ragg_runtime", *words)
        pages.append((tmp_path / "r.html").read_text("utf-8"))
    assert pages[0] == pages[1]
