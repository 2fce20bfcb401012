"""The reference pages hold what the code reads and writes; README's commands work as they are typed."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
import pyarrow.parquet as pq
import pytest
from commands import ragg

from docs import made
from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import COMMANDS, cli
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.report import plots

DISC = '[disc]\nradius = "0.1 m"\nspin_frequency = "0.25 Hz"\ng0 = "9.8 m/s^2"\n'
DISCS = '[[disc]]\nspin_frequency = "0.25 Hz"\n'
LAST = '[accelerometers]\nK1 = "10 mA/g"\nk_VI = "1e9 ohm"\n'
WITH_AN_UNKNOWN_KEY = {
    "Top level": "odd = 1",
    "[model]": "[model]\nodd = 1",
    "[model], order": "[model]\norder = { odd = 1 }",
    "[disc]": "[disc]\nodd = 1",
    "[[disc]]": f"{DISCS}odd = 1\n{LAST}",
    "[[disc.accelerometer]]": f"{DISCS}[[disc.accelerometer]]\nodd = 1\n{LAST}",
    "[accelerometers]": f"{DISC}[accelerometers]\nodd = 1",
    "[demodulator]": f"[demodulator]\nodd = 1\n{DISC}{LAST}",
}
"""Section of the page -> a model.toml that is refused, with the keys that are known there."""


@pytest.mark.parametrize("title", WITH_AN_UNKNOWN_KEY)
def test_the_page_of_model_toml_has_every_key_that_is_read_and_no_other(title: str) -> None:
    with pytest.raises(UserError, match="unknown key 'odd'") as refused:
        parse_instrument(WITH_AN_UNKNOWN_KEY[title])
    assert refused.value.expected is not None
    known = set(str(refused.value.expected).removeprefix("one of ").split(", "))
    name, _, table = title.partition(", ")
    page = made.model_toml()
    listed = set(
        re.findall(r"^\| `([\w.]+)` ", page.split(f"## {name}\n", 1)[1].split("\n## ", 1)[0], re.MULTILINE)
    )
    if table:
        listed = {k.removeprefix(f"{table}.") for k in listed if k.startswith(f"{table}.")}
    elif name == "Top level":
        listed |= {t.strip("[]") for t in re.findall(r"^## (\[\w+\])$", page, re.MULTILINE)}
    else:
        listed = {k for k in listed if "." not in k}
    assert listed == known


def test_the_page_of_json_has_every_command_that_writes_any_and_every_key_a_meaning() -> None:
    shown = {line.split()[0] for line in made.LINES} | {"compare", "diagnose", "add"}
    context = click.Context(cli)
    commands = {name: cli.get_command(context, name) for name in COMMANDS}
    assert {n for n, c in commands.items() if c and any(p.name == "json_file" for p in c.params)} == shown
    with pytest.raises(KeyError, match="odd of compare"):
        made.meaning("compare", "error.odd", made.read_meanings())


def test_the_json_of_commands_that_fit_nothing_has_meanings(tmp_path, monkeypatch) -> None:
    """Of the others the tests of these commands: ``commands.ragg`` looks up every key."""
    monkeypatch.chdir(tmp_path)
    pq.write_table(pq.read_table(made.FLIGHT).slice(0, 960), "flight.parquet")
    for line in (
        "new model",
        "effects",
        "effects lag",
        "info flight.parquet",
        "convert flight.parquet flight.csv",
        "simulate model -o simulated.parquet --duration 60 --spin -0.25",
        "add model bias-drift",
        "history model",
        "remove model bias-drift",
    ):
        done = ragg(*line.split(), "--json", "written.json")
        assert done.returncode == 0, line + done.stderr


ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")
SAMPLES = 2880
"""Three minutes of the shipped flight are enough for all that README shows."""


def block(heading: str) -> str:
    """The indented block of a section of README."""
    section = README.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    return "".join(f"{x}\n" for x in re.findall(r"^    (.*)$|^$", section, flags=re.MULTILINE)).strip()


SHELL, PYTHON = block("Step by step"), block("From Python")
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


def test_the_commands_work_as_typed_and_print_the_next_one(said: dict[str, str], clone: Path) -> None:
    assert "NOT adequate" in said["compare"]
    assert "thermal-scale" in said["diagnose"]
    assert "the model is now adequate" in said["add"]
    assert "thermal-scale" in said["history"]
    for name in re.findall(r"(?:--report|-o) (\S+)", SHELL):
        assert (clone / name).stat().st_size > 1000, name
    assert (clone / "my-model-c" / "Makefile").exists()
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


def test_a_process_of_its_own_sees_the_model_and_removing_makes_it_what_it_was(said, clone) -> None:
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
