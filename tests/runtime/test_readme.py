"""README's commands as they are typed; their JSON is what the interface promises."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest
from commands import ragg

from ragg_runtime.identification import next_motion
from ragg_runtime.report import plots

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")
SAMPLES = 2880
"""Three minutes of the shipped flight are enough for all that README shows."""


def blocks(heading: str) -> list[str]:
    """The indented blocks of a section of README."""
    section = README.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    found = re.findall(r"(?:^    .*\n(?:\n(?=    ))?)+", section, flags=re.MULTILINE)
    return [re.sub(r"^    ", "", b, flags=re.MULTILINE) for b in found]


(SHELL,), (PYTHON,) = blocks("Step by step"), blocks("From Python")
"""The second is carried out in test_display.py."""


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """What the commands need of a fresh clone, and the folder where they run: the files that they name."""
    place = tmp_path_factory.mktemp("clone")
    (place / "examples").mkdir()
    whole = pq.read_table(ROOT / "examples" / "demo-flight.parquet")
    pq.write_table(whole.slice(0, SAMPLES), place / "examples" / "demo-flight.parquet")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(place)
        patch.setattr(plots, "draw_plot", lambda _: "<svg></svg>")  # test_report.py has figures
        patch.setattr(next_motion, "propose_motions", lambda *_: ())  # and test_next_motion.py these
        yield place


@pytest.fixture(scope="module")
def said(clone: Path) -> dict[str, str]:
    """Each command of the block and what it printed, its JSON kept beside."""
    found = {}
    for line in SHELL.splitlines():
        program, command, *rest = shlex.split(line, comments=True)
        more = ["--json", f"{command}.json"] if command in ("compare", "diagnose", "add", "history") else []
        done = ragg(command, *rest, *more)
        assert (program, done.returncode) == ("ragg", 0), line + done.stderr
        found[command] = done.stdout
    return found


def test_the_commands_work_as_typed(said: dict[str, str], clone: Path) -> None:
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


ERROR = {"rms_V", "rms_Eo", "inline_Eo", "cross_Eo", "inline_Eo_per_rtHz", "cross_Eo_per_rtHz"}
DIAGNOSIS = {"verdict", "ranking", "found", "not_testable", "unexplained"}
RANKED = {"effect", "p_value", "delta_bic", "error_before", "error_after", "error_after_holdout"}


def strict(text: str) -> Any:
    def refuse(name: str) -> None:
        raise AssertionError(f"{name} is not JSON")

    return json.loads(text, parse_constant=refuse)


def test_the_commands_speak_the_interface(said: dict[str, str], clone: Path) -> None:
    compared, diagnosed, added, history = (
        strict((clone / f"{n}.json").read_text()) for n in ("compare", "diagnose", "add", "history")
    )
    assert {"effects", "duration_s", "rate_Hz", "noise_floor", "where"} <= set(compared)
    assert (compared["adequate"], compared["samples"]) == (False, SAMPLES)
    assert all(set(compared["error"][k]) == ERROR for k in ("nominal", "calibrated", "holdout"))
    assert set(compared["where"]) == {"harmonics", "time", "motion"}
    assert {"harmonic", "term", "share"} <= set(compared["where"]["motion"][0])
    assert set(diagnosed) >= DIAGNOSIS
    assert (diagnosed["verdict"], diagnosed["found"]) == ("missing-effect", ["thermal-scale"])
    first = diagnosed["ranking"][0]
    assert set(first) >= RANKED
    assert set(first["parameters"][0]) == {"name", "accelerometer", "value", "std", "unit"}
    assert (clone / "diagnosis.html").read_text().startswith("<!")
    assert {"effect", "before", "after", "parameters"} <= set(added)
    assert added["after"]["calibrated"]["rms_Eo"] < 0.9 * added["before"]["calibrated"]["rms_Eo"]
    assert [s["action"] for s in history["steps"]] == ["new", "add"]


def test_a_process_of_its_own_sees_the_model_and_removing_makes_it_what_it_was(
    said: dict[str, str], clone: Path
) -> None:
    flight = "examples/demo-flight.parquet"
    assert (clone / "my-model" / "generated" / "manifest.json").is_file()
    words = [sys.executable, "-m", "ragg_runtime", "compare", "my-model", flight, "--json", "-"]
    again = subprocess.run(words, capture_output=True, text=True, check=True, timeout=120)
    assert strict(again.stdout)["adequate"] is True
    refused = ragg("add", "my-model", "thermal-scale", flight)
    assert (refused.returncode, "already" in refused.stderr) == (2, True)
    assert ragg("remove", "my-model", "thermal-scale").returncode == 0
    assert ragg("new", "another").returncode == 0
    assert (clone / "my-model" / "model.toml").read_text() == (clone / "another" / "model.toml").read_text()
    assert not (clone / "my-model" / "generated").exists()
