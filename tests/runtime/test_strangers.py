"""Names from strangers' files are text everywhere: on the terminal, in JSON, in reports."""

from __future__ import annotations

import dataclasses
import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError, printable
from ragg_runtime.cli.main import main
from ragg_runtime.flight import write_flight
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated

NAME = "\x1b[31m<script>alert(1)\u202e&\"'"


def test_what_steers_a_terminal_is_shown() -> None:
    assert printable("a\x1b[31m\u202e\x07\udcff\x9b") == r"a\x1b[31m\u202e\x07\udcff\x9b"
    assert printable("Γ_xx = 1 ± 2\n\tµg") == "Γ_xx = 1 ± 2\n\tµg"


def test_a_flight_with_such_a_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    m = loop.new("model")
    write_flight(simulated(m.instrument, [], seed=1, duration=240.0, rate=16.0), "plain.parquet")
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
    loop.new("model")
    Path(f"{NAME}.csv").write_text(f"time [s],{NAME}[x [g]\n0,0\n", "utf-8")
    with pytest.raises(SystemExit) as end:
        main(["compare", "model", f"{NAME}.csv"])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert "\x1b" not in said
    assert "\u202e" not in said


@pytest.mark.parametrize("identifier", ["../../etc", "a/b", "..", "", "lag\x00", "C:\\x", "-x", "a" * 300])
def test_ids_with_path_parts_are_unknown(tmp_path: Path, identifier: str) -> None:
    m = loop.new(tmp_path / "model")
    before = sorted(tmp_path.rglob("*"))
    for attempt in (loop.add, loop.remove):
        with pytest.raises(UserError):
            attempt(m, identifier)
    line = f'effects = [{{ id = {json.dumps(identifier)}, stage = "transducer", add = "K*f_i", K = {{ unit = "ug" }} }}]'
    toml = (tmp_path / "model" / "model.toml").read_text("utf-8").replace("effects = []", line)
    (tmp_path / "evil.toml").write_text(toml, "utf-8")
    with pytest.raises(UserError):
        loop.new(tmp_path / "second", tmp_path / "evil.toml")
    (tmp_path / "evil.toml").unlink()
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize(("parameter", "channel"), [("K1", "i_mine"), ("delta_phi", "x0"), ("V", "double")])
def test_names_of_generated_code_are_the_users_own(tmp_path: Path, parameter: str, channel: str) -> None:
    """An effect whose parameter and channel are called like locals of generated code is found at its true size."""
    toml = loop.new(tmp_path / "model").directory.path / "model.toml"
    line = (
        f'{{ id = "mine", stage = "transducer", add = "{parameter} * {channel}", {parameter} = '
        '{ unit = "ug/K", plausible = 1000 } }'
    )
    m = loop.load(tmp_path / "model")
    flight = simulated(m.instrument, [], seed=1, duration=240.0, rate=16.0)
    x = np.cos(2 * np.pi * 0.37 * flight.time)
    k, signs = m.instrument.accelerometers, np.array([1.0, 1.0, -1.0, -1.0])
    truth = 1e-3  # m/s^2 / K: about 100 ug/K
    weights = signs * k["k_VI"] * k["K1"]
    change = weights[0] * truth * x
    flight = dataclasses.replace(
        flight,
        channels={**flight.channels, channel: x},
        outputs={**flight.outputs, "G_out": flight.outputs["G_out"] + change},
        units={**flight.units, channel: "K"},
    )
    toml.write_text(toml.read_text("utf-8").replace("effects = []", f"effects = [{line}]"), "utf-8")
    added = loop.add(loop.load(tmp_path / "model"), "mine", [flight])
    assert {q.name for q in added.parameters} == {parameter}
    found = float(np.sum(weights * [q.value for q in added.parameters])) * 1e-6 * m.instrument.g0
    assert abs(found / weights[0] - truth) < 0.02 * truth
