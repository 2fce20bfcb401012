"""What the system refuses, and what files hold, ends in one message."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from ragg_runtime import api
from ragg_runtime.cli.main import main

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="such names and streams")


def run(*words: str | Path, shell: str = "", cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """``ragg`` in a shell, with redirections."""
    command = " ".join([sys.executable, "-m", "ragg_runtime", *map(str, words), shell])
    root = str(Path(api.__file__).parents[1])
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
    return api.new(tmp_path / "model").directory.path


def test_streams_that_are_closed(model: Path) -> None:
    """Where stdout is full, or a model would change: test_outputs.py."""
    for shell, status in (("2>&-", 0), ("0<&- 1>&- 2>&-", 2)):
        done = run("history", model, shell=shell)
        assert done.returncode == status, (shell, done.stderr)
        assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    "step",
    [
        {"before": 3},
        {"before": {"calibrated": [1]}},
        {"after": {"rms_Eo": "many"}},
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


def test_every_refusal_of_the_system_names_its_place(
    model: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuses(*_: object) -> None:
        raise OSError(40, "Too many levels of symbolic links", "/some\n/where")

    monkeypatch.setattr(api, "load", refuses)
    with pytest.raises(SystemExit) as end:
        main(["compare", str(model), "f.csv"])
    assert end.value.code == 2
    assert capsys.readouterr().err == "ragg: /some\\n/where: Too many levels of symbolic links\n"
