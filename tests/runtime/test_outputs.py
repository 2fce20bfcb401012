"""What commands write: never over what they read, all of it before a model changes, with what made it, in the same bytes."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import threading
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import commands
import numpy as np
import pytest

from ragg_runtime import api
from ragg_runtime.cli.main import main
from ragg_runtime.io import write_flight
from ragg_runtime.simulate import simulate_flight

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="devices, links and pipes of Unix")


@pytest.fixture(scope="module")
def given(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """A model directory with an effect, and a flight of 150 s."""
    place = tmp_path_factory.mktemp("outputs")
    m = api.new(place / "model")
    write_flight(
        simulate_flight(m.instrument, [], seed=3, duration=150.0, rate=8.0), place / "flight.parquet"
    )
    api.add(m, "thermal-scale")
    return place / "model", place / "flight.parquet"


def state(*places: Path) -> dict[str, bytes]:
    files = [p for x in places for p in ((x,) if x.is_file() else sorted(x.rglob("*"))) if p.is_file()]
    return {str(p): p.read_bytes() for p in files}


def ragg(*arguments: object, redirect: str = "", cwd: Path | None = None) -> tuple[int, str]:
    """Exit status and stderr of a command, its output redirected by a shell if that is asked for."""
    if not redirect and cwd is None:
        here = commands.ragg(*arguments)
        assert "Traceback" not in here.stderr, here.stderr
        return here.returncode, here.stderr
    line = f'exec "$0" -m ragg_runtime "$@" {redirect}'
    found = subprocess.run(
        ["sh", "-c", line, sys.executable, *map(str, arguments)], capture_output=True, text=True, cwd=cwd
    )
    assert "Traceback" not in found.stderr, found.stderr
    return found.returncode, found.stderr


@pytest.mark.parametrize("how", ["report", "json", "stdout full", "stdout closed", "json full"])
def test_a_result_that_cannot_be_written_leaves_the_model_as_it_was(how, given, tmp_path) -> None:
    model, flight = given
    before = state(model, flight)
    nowhere = tmp_path / "nowhere"
    further: dict[str, tuple[list[object], str]] = {
        "report": (["--report", nowhere / "r.html"], ""),
        "json": (["--json", nowhere / "r.json"], ""),
        "stdout full": ([], "> /dev/full"),
        "stdout closed": ([], ">&-"),
        "json full": (["--json", "/dev/full"], ""),
    }
    arguments, redirect = further[how]
    command = (
        ["add", model, "odd-quadratic", flight] if how == "report" else ["remove", model, "thermal-scale"]
    )
    status, said = ragg(*command, *arguments, redirect=redirect)
    assert status == 2, said
    assert said.count("ragg:") == 1
    assert state(model, flight) == before
    assert list(tmp_path.iterdir()) == []


def test_streams_that_are_closed(given: tuple[Path, Path]) -> None:
    for redirect, status in (("2>&-", 0), ("0<&- 1>&- 2>&-", 2)):
        assert ragg("history", given[0], redirect=redirect)[0] == status


FILES = ("model.toml", "history.json", "calibration.json", "mapping.toml", "generated/manifest.json")


@pytest.mark.parametrize("over", ["flight", *FILES, "link"])
@pytest.mark.parametrize("option", ["--json", "--report"])
def test_nothing_is_written_over_what_is_read(option: str, over: str, given: tuple[Path, Path]) -> None:
    model, flight = given
    target = flight if over == "flight" else model / over
    if over == "link":
        target = model.parent / "hard-link"
        target.unlink(missing_ok=True)
        os.link(flight, target)
    before = state(model, flight)
    status, said = ragg("compare", model, flight, option, target)
    assert status == 2, said
    assert "the result would overwrite" in said
    assert state(model, flight) == before


def test_a_result_replaces_no_file_of_another_model(given: tuple[Path, Path], tmp_path: Path) -> None:
    """Of commands that know no model, too."""
    model, _ = given
    before = state(model)
    for name in ("model.toml", "history.json"):
        status, said = ragg("effects", "lag", "--json", model / name)
        assert status == 2, said
        assert "overwrite a file of a model directory" in said
    assert state(model) == before


@pytest.mark.parametrize("command", ["compensate", "next-motion", "simulate"])
def test_a_series_is_not_written_over_what_is_read(command: str, given: tuple[Path, Path]) -> None:
    model, flight = given
    before = state(model, flight)
    read = ["--motion", flight] if command == "simulate" else [flight]
    status, said = ragg(command, model, *read, "-o", flight)
    assert status == 2, said
    assert "overwrite what the command reads" in said
    assert state(model, flight) == before


def test_two_results_do_not_share_a_file_and_a_flight_is_not_flown_over_its_model(given, tmp_path) -> None:
    model, flight = given
    status, said = ragg("compare", model, flight, "--json", tmp_path / "x", "--report", tmp_path / "x")
    assert (status, "two results" in said) == (2, True)
    sheet = tmp_path / "sheet.csv"
    sheet.symlink_to(model / "model.toml")
    before = state(model)
    assert ragg("simulate", model, "-o", sheet)[0] == 2
    assert state(model) == before


def test_devices_and_pipes_are_written_to(given: tuple[Path, Path], tmp_path: Path) -> None:
    model, _ = given
    assert ragg("history", model, "--json", "/dev/null")[0] == 0
    assert Path("/dev/null").is_char_device()
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    read: list[str] = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_text()), daemon=True)
    reader.start()
    assert ragg("history", model, "--json", pipe)[0] == 0
    reader.join(10)
    assert [s["action"] for s in json.loads(read[0])["steps"]] == ["new", "add"]
    assert pipe.is_fifo()
    out = tmp_path / "out"
    assert ragg("history", model, "--json", "/dev/stdout", redirect=f"> {out}")[0] == 0
    assert json.loads(out.read_text())["steps"]


DAY = re.compile(r"20\d\d-\d\d-\d\d")


def json_of(arguments: Sequence[str], folder: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Any, str]:
    monkeypatch.chdir(folder)
    monkeypatch.setattr(sys, "argv", ["ragg", *arguments, "--json", "result.json"])
    main(sys.argv[1:])
    text = (folder / "result.json").read_text("utf-8")
    return json.loads(text), text


@pytest.mark.parametrize(
    "arguments", [["compare", "model", "flight.parquet"], ["effects", "lag"]], ids=" ".join
)
def test_a_result_names_what_made_it(given, monkeypatch, arguments) -> None:
    place = given[0].parent
    found, text = json_of(arguments, place, monkeypatch)
    made = found["provenance"]
    assert made["python"] == "{}.{}.{}".format(*sys.version_info)
    assert {n: made[n] for n in ("numpy", "scipy", "sympy")} == {
        n: version(n) for n in ("numpy", "scipy", "sympy")
    }
    assert made["command"] == shlex.join(["ragg", *arguments, "--json", "result.json"])
    if "model" in arguments:
        digest = hashlib.sha256((place / "model" / "model.toml").read_bytes()).hexdigest()
        assert (made["model"], made["model_digest"]) == ("model", digest)
    if "flight.parquet" in arguments:
        digest = hashlib.sha256((place / "flight.parquet").read_bytes()).hexdigest()
        assert made["flights"] == [{"path": "flight.parquet", "digest": digest}]
        assert not DAY.search(text), "a result of today is no other than one of tomorrow"
    assert json_of(arguments, place, monkeypatch)[1] == text


def test_a_change_names_the_state_before_and_after(given, monkeypatch, tmp_path) -> None:
    api.new(tmp_path / "model")
    toml = tmp_path / "model" / "model.toml"
    digests = [hashlib.sha256(toml.read_bytes()).hexdigest()]
    for arguments in (["add", "model", "lag"], ["remove", "model", "lag"]):
        made = json_of(arguments, tmp_path, monkeypatch)[0]["provenance"]
        digests.append(hashlib.sha256(toml.read_bytes()).hexdigest())
        assert [made["model_digest_before"], made["model_digest"]] == digests[-2:]
    assert digests[0] == digests[2] != digests[1]


def test_the_same_result_on_any_number_of_threads(given, monkeypatch) -> None:
    """BLAS splits sums by the number of its threads; the verdict and the figures must not notice. ``make test`` has one."""
    words = ["diagnose", "model", "flight.parquet", "--json", "result.json"]
    place, threads = given[0].parent, {"OPENBLAS_NUM_THREADS": "2", "OMP_NUM_THREADS": "2"}
    results = [json_of(words[:3], place, monkeypatch)[1]]
    program = [sys.executable, "-m", "ragg_runtime"]
    subprocess.run([*program, *words], cwd=place, env=os.environ | threads, capture_output=True, check=True)
    results.append((place / "result.json").read_text("utf-8"))
    if np.lib.NumpyVersion(np.__version__) >= "2.0.0":
        assert results[0] == results[1]
    else:  # BLAS of that time: sums depend on where in memory their terms lie
        first, second = (json.loads(r) for r in results)
        assert (first["verdict"], first["found"]) == (second["verdict"], second["found"])
        errors = [[r["error_after"]["rms_Eo"] for r in x["ranking"]] for x in (first, second)]
        np.testing.assert_allclose(errors[0], errors[1], rtol=1e-3)
