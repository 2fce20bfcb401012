"""One report as a user makes it: names of strangers are text in it, what was done is said, and what it was made of."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest

from ragg_runtime import api
from ragg_runtime.base.errors import printable
from ragg_runtime.cli.main import main
from ragg_runtime.io import write_flight
from ragg_runtime.simulate import simulate_flight

NAME = "\x1b[31m<script>alert(1)\u202e&\"'"
NOTE = "samples are spikes"


def test_what_steers_a_terminal_is_shown() -> None:
    assert printable("a\x1b[31m\u202e\x07\udcff\x9b") == r"a\x1b[31m\u202e\x07\udcff\x9b"
    assert printable("Γ_xx = 1 ± 2\n\tµg") == "Γ_xx = 1 ± 2\n\tµg"


@pytest.mark.usefixtures("no_figures")
def test_a_flight_with_such_a_name_and_spikes_in_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    m = api.new("model")
    x = simulate_flight(m.instrument, [], seed=1, duration=120.0, rate=8.0)
    G = x.outputs["G_out"] + np.where(np.arange(len(x)) % 97 == 50, 5 * np.std(x.outputs["G_out"]), 0.0)
    write_flight(dataclasses.replace(x, outputs={"G_out": G}), "plain.parquet")
    flight = Path("plain.parquet").rename(f"{NAME}.parquet")
    words = ["compare", "model", str(flight), "--json", "out.json", "--report", "out.html"]
    monkeypatch.setattr(sys, "argv", ["ragg", *words])
    main(words)
    said = capsys.readouterr()
    assert "\x1b" not in said.out
    assert "\u202e" not in said.out
    assert r"\x1b[31m<script>alert(1)\u202e" in said.out
    page = Path("out.html").read_text("utf-8")
    assert "<script>alert" not in page
    assert "&lt;script&gt;alert(1)" in page
    result = json.loads(Path("out.json").read_text("utf-8"))
    assert result["provenance"]["flights"][0]["path"] == f"{NAME}.parquet"
    assert NOTE in said.out
    assert any(NOTE in note for note in result["notes"])
    assert "What was done to the record" in page
    assert NOTE in page
    assert "--json out.json --report out.html" in page
    for path in (Path("model", "model.toml"), flight):
        assert hashlib.sha256(path.read_bytes()).hexdigest() in page
    for library in ("numpy", "scipy", "sympy"):
        assert f"{library} {version(library)}" in page
    assert api.load("model").model.digest in page


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
