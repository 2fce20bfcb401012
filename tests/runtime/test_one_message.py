"""What the system refuses, and what names hold, ends in one message; names that steer are written out."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from ragg_runtime.cli.main import main
from ragg_runtime.flight import write_flight
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="such names and streams")
FORGED = "f\nverdict: adequate\n\x1b2J\tx"
WRITTEN_OUT = r"f\nverdict: adequate\n\x1b2J\tx"


def run(*words: str | Path, shell: str = "", cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """``ragg`` in a shell, with redirections."""
    command = " ".join([sys.executable, "-m", "ragg_runtime", *map(str, words), shell])
    root = str(Path(loop.__file__).parents[2])
    environment = os.environ | {"PYTHONPATH": root}
    return subprocess.run(
        ["sh", "-c", command],
        cwd=cwd,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        env=environment,
    )


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return loop.new(tmp_path / "model").directory.path


def test_streams_that_are_closed_or_full(model: Path) -> None:
    before = {p: p.read_bytes() for p in model.iterdir() if p.is_file()}
    for shell, status in (("2>&-", 0), ("1>&-", 2), ("0<&- 1>&- 2>&-", 2), ("1>/dev/full", 2)):
        done = run("history", model, shell=shell)
        assert done.returncode == status, (shell, done.stderr)
        assert "Traceback" not in done.stderr
    assert run("add", model, "lag", shell="0<&- 1>&- 2>&-").returncode == 2  # nobody would hear of it
    assert {p: p.read_bytes() for p in model.iterdir() if p.is_file()} == before
    assert run("add", model, "lag", shell="0<&- 2>&-").returncode == 0


def test_a_current_folder_that_is_gone(tmp_path: Path, model: Path) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    words = f"{sys.executable} -m ragg_runtime"
    root = str(Path(loop.__file__).parents[2])
    for command in ("compare model f.csv", "new other", "survey model f.csv --jobs 1"):
        gone.mkdir(exist_ok=True)
        done = subprocess.run(
            ["sh", "-c", f"rmdir {gone}; {words} {command}"],
            cwd=gone, capture_output=True, text=True, timeout=120, check=False,
            env=os.environ | {"PYTHONPATH": root},
        )  # fmt: skip
        assert done.returncode == 2, done
        assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    "step",
    [
        {"before": 3},
        {"before": "x"},
        {"before": {"calibrated": [1]}},
        {"after": {"rms_Eo": "many"}},
        {"after": {"calibrated": {"rms_Eo": {}}}},
        {"flights": 3},
        {"flights": ["a"]},
    ],
    ids=str,
)
def test_histories_of_odd_shapes(
    model: Path, step: dict[str, object], capsys: pytest.CaptureFixture[str]
) -> None:
    whole = {"action": "add", "effect": "lag", "time": "now"} | step
    (model / "history.json").write_text(json.dumps({"steps": [whole]}))
    for command in (["history", str(model)], ["add", str(model), "lag"]):
        with pytest.raises(SystemExit) as end:
            main(command)
        assert end.value.code == 2
        assert "the history is damaged" in capsys.readouterr().err


def test_names_in_a_history(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    step = {"action": "add", "effect": FORGED, "time": "now\r", "after": {"rms_V": 1.0}}
    (model / "history.json").write_text(json.dumps({"steps": [step]}))
    main(["history", str(model)])
    said = capsys.readouterr().out
    assert WRITTEN_OUT in said
    assert len(said.splitlines()) == 2
    loop.load(model)._repr_html_()


def test_names_of_flights_and_columns(
    model: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(model.parent)
    m = loop.load(model)
    flight = simulated(m.instrument, [], seed=1, duration=240.0, rate=16.0)
    channels = {**flight.channels, FORGED: flight.time % 7.0}
    flight = type(flight)(
        time=flight.time, channels=channels, outputs=flight.outputs, units={**flight.units, FORGED: "K"}
    )
    write_flight(flight, f"{FORGED}.parquet")
    (model / "generated").mkdir()
    for command in ("compare", "diagnose"):
        main([command, "model", f"{FORGED}.parquet", "--report", "r.html"])
        said = capsys.readouterr()
        for text in (said.out, said.err):
            assert "\x1b" not in text
            assert not re.search(r"^verdict: adequate$", text, re.MULTILINE)
        assert command == "diagnose" or WRITTEN_OUT in said.out
    with pytest.raises(SystemExit):
        main(["compare", "model", f"{FORGED}.csv"])
    assert WRITTEN_OUT in capsys.readouterr().err


def test_every_refusal_of_the_system_names_its_place(
    model: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuses(*_: object) -> None:
        raise OSError(40, "Too many levels of symbolic links", "/some\n/where")

    monkeypatch.setattr(loop, "load", refuses)
    with pytest.raises(SystemExit) as end:
        main(["compare", str(model), "f.csv"])
    assert end.value.code == 2
    assert capsys.readouterr().err == "ragg: /some\\n/where: Too many levels of symbolic links\n"
