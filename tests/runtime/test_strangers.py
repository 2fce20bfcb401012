"""Names from strangers' files are text everywhere: on the terminal, in JSON, in reports."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from ragg_runtime import api
from ragg_runtime.base.errors import printable
from ragg_runtime.cli.main import main
from ragg_runtime.io import write_flight
from ragg_runtime.simulate import simulated

NAME = "\x1b[31m<script>alert(1)\u202e&\"'"


def test_what_steers_a_terminal_is_shown() -> None:
    assert printable("a\x1b[31m\u202e\x07\udcff\x9b") == r"a\x1b[31m\u202e\x07\udcff\x9b"
    assert printable("Γ_xx = 1 ± 2\n\tµg") == "Γ_xx = 1 ± 2\n\tµg"


def test_a_flight_with_such_a_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    m = api.new("model")
    write_flight(simulated(m.instrument, [], seed=1, duration=60.0, rate=8.0), "plain.parquet")
    shutil.move("plain.parquet", f"{NAME}.parquet")
    main(["compare", "model", f"{NAME}.parquet", "--json", "out.json", "--report", "out.html"])
    said = capsys.readouterr()
    assert "\x1b" not in said.out
    assert "\u202e" not in said.out
    assert r"\x1b[31m<script>alert(1)\u202e" in said.out
    page = Path("out.html").read_text("utf-8")
    assert "<script>alert" not in page
    assert "&lt;script&gt;alert(1)" in page
    made = json.loads(Path("out.json").read_text("utf-8"))["provenance"]
    assert made["flights"][0]["path"] == f"{NAME}.parquet"


def test_an_error_about_such_a_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    api.new("model")
    Path(f"{NAME}.csv").write_text(f"time [s],{NAME}[x [g]\n0,0\n", "utf-8")
    with pytest.raises(SystemExit) as end:
        main(["compare", "model", f"{NAME}.csv"])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert "\x1b" not in said
    assert "\u202e" not in said
