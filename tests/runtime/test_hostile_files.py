"""Files of strangers: damaged ones and names in them are one clear message; a record that is given twice counts once."""

from __future__ import annotations

import dataclasses
import gzip
import hashlib
import json
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest
from flights_of_a_survey import in_process

from ragg_runtime import api
from ragg_runtime.base.errors import UserError, printable
from ragg_runtime.cli.main import main
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight, write_flight
from ragg_runtime.io.files import read_recordings
from ragg_runtime.io.mapping import parse_mapping
from ragg_runtime.io.record import distinct
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.simulate import simulate_flight
from ragg_runtime.survey import run
from tests.runtime.foreign_files import ENDINGS, HEADER, make_lines, write

MAPPING = """
[time]
column = "UTC"
format = "iso"
[columns]
a_x = { column = "ACC1", unit = "g", scale = 2.0 }
[axes]
x = "y"
y = "x"
z = "-z"
"""
SHEET = (Path(__file__).parents[2] / "ragg_runtime" / "example.toml").read_text("utf-8")


def broken(data: bytes, trial: int, rng: np.random.Generator) -> bytes:
    """Cut off, or with some bytes changed."""
    if trial % 3 == 0:
        return data[: rng.integers(1, len(data))]
    made = bytearray(data)
    for place in rng.integers(0, len(data), rng.integers(1, 6)):
        made[place] = rng.integers(0, 256)
    return bytes(made)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_damaged_file_is_read_or_refused_with_one_message(tmp_path: Path, ending: str) -> None:
    path = write(tmp_path / f"x{ending}", make_lines("1", "2"))
    data = path.read_bytes()
    assert all(len(s) == 60 for s in read_recordings(path))
    rng = np.random.default_rng(2)
    for trial in range(40):
        path.write_bytes(broken(data, trial, rng))
        try:
            for s in read_recordings(path):
                assert all(c.values.dtype == np.float64 for c in s.columns)
        except UserError as error:
            assert len(str(error)) < 3000, str(error)[:500]


@pytest.mark.parametrize(("parse", "text"), [(parse_mapping, MAPPING), (parse_instrument, SHEET)])
def test_a_damaged_text_is_read_or_refused_with_one_message(parse, text) -> None:
    parse(text, Path("x.toml"))
    rng = np.random.default_rng(3)
    for trial in range(150):
        try:
            parse(broken(text.encode(), trial, rng).decode("utf-8", "replace"), Path("x.toml"))
        except UserError as error:
            assert len(str(error)) < 3000, str(error)[:500]


@pytest.mark.parametrize("trick", ["external", "link", "virtual"])
def test_numbers_in_other_files_are_not_read(tmp_path: Path, trick: str) -> None:
    secret = tmp_path / "secret.bin"
    secret.write_bytes(np.arange(60.0).tobytes())
    other, path = (write(tmp_path / n, make_lines()) for n in ("other.h5", "x.h5"))
    with h5py.File(path, "a") as file:
        del file["G_out"]
        if trick == "external":
            file.create_dataset("G_out", shape=(60,), dtype="f8", external=[(str(secret), 0, 480)])
        elif trick == "link":
            file["G_out"] = h5py.ExternalLink(str(other), "/G_out")
        else:
            layout = h5py.VirtualLayout((60,), "f8")
            layout[:] = h5py.VirtualSource(str(other), "G_out", (60,))
            file.create_virtual_dataset("G_out", layout)
    with pytest.raises(UserError, match="output is missing"):
        read_flight(path, 9.8)


def test_groups_in_a_circle_end(tmp_path: Path) -> None:
    path = write(tmp_path / "x.h5", make_lines())
    with h5py.File(path, "a") as file:
        file.create_group("deeper").create_group("deeper")["round"] = file["/"]
    assert len(read_flight(path, 9.8)) == 60


def test_differing_tables_ask_for_a_choice(tmp_path: Path) -> None:
    path = tmp_path / "x.h5"
    with h5py.File(path, "w") as file:
        file["imu/time"], file["imu/a_x"] = np.arange(9.0), np.ones(9)
        file["ggi/time"], file["ggi/G_out"] = np.arange(5.0), np.ones(5)
    with pytest.raises(UserError) as refused:
        read_recordings(path)
    assert all(w in str(refused.value) for w in ("/imu", "/ggi", "[file] part"))


@pytest.mark.parametrize(
    "text", ["a" * (3 << 20), ",".join(HEADER) + "\n" + "1" * (3 << 20), "# " + "a" * (3 << 20)]
)
def test_a_line_without_end(tmp_path: Path, text: str) -> None:
    (tmp_path / "flight.csv.gz").write_bytes(gzip.compress(text.encode()))
    with pytest.raises(UserError, match="not a table"):
        read_flight(tmp_path / "flight.csv.gz", 9.8)


STRANGE = "\x1b[31m<script>alert(1)\u202e&\"'"
SAID = "samples are spikes"


def test_what_steers_a_terminal_is_shown() -> None:
    assert printable("a\x1b[31m\u202e\x07\udcff\x9b") == r"a\x1b[31m\u202e\x07\udcff\x9b"
    assert printable("Γ_xx = 1 ± 2\n\tµg") == "Γ_xx = 1 ± 2\n\tµg"


@pytest.mark.usefixtures("no_figures")
def test_a_flight_with_such_a_name_and_spikes_in_it(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    m = api.new("model")
    x = simulate_flight(m.instrument, [], seed=1, duration=120.0, rate=8.0)
    G = x.outputs["G_out"] + np.where(np.arange(len(x)) % 97 == 50, 5 * np.std(x.outputs["G_out"]), 0.0)
    write_flight(dataclasses.replace(x, outputs={"G_out": G}), "plain.parquet")
    flight = Path("plain.parquet").rename(f"{STRANGE}.parquet")
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
    assert result["provenance"]["flights"][0]["path"] == f"{STRANGE}.parquet"
    assert SAID in said.out
    assert any(SAID in note for note in result["notes"])
    assert "What was done to the record" in page
    assert SAID in page
    assert "--json out.json --report out.html" in page
    for path in (Path("model", "model.toml"), flight):
        assert hashlib.sha256(path.read_bytes()).hexdigest() in page


def test_an_error_about_such_a_name(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    api.new("model")
    Path(f"{STRANGE}.csv").write_text(f"time [s],{STRANGE}[x [g]\n0,0\n", "utf-8")
    with pytest.raises(SystemExit) as end:
        main(["compare", "model", f"{STRANGE}.csv"])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert "\x1b" not in said
    assert "\u202e" not in said


@pytest.fixture(scope="module")
def loaded(tmp_path_factory: pytest.TempPathFactory) -> api.Loaded:
    return api.new(tmp_path_factory.mktemp("same") / "model")


@pytest.fixture(scope="module")
def short_flight(loaded: api.Loaded) -> Flight:
    return simulate_flight(loaded.instrument, [], seed=1, duration=150.0, rate=8.0)


def test_in_two_formats_it_is_refused_everywhere(loaded, short_flight, tmp_path) -> None:
    write_flight(short_flight, tmp_path / "x.csv")
    write_flight(short_flight, tmp_path / "y.parquet")
    both = [tmp_path / "x.csv", tmp_path / "y.parquet"]
    for use in (
        api.compare,
        api.diagnose,
        lambda m, x: api.add(m, "lag", x),
        lambda m, x: api.calibrate(m, x, save=True),
        api.compensate,
        api.compare_frozen,
    ):
        with pytest.raises(UserError, match=r"the same record as .*: it would count twice"):
            use(loaded, both)
    kept = api.load(loaded.directory.path)
    assert (kept.model.effects, kept.directory.calibration) == ((), None)


def test_other_records_are_others(short_flight: Flight) -> None:
    """The same motion flown again with other noise; flights at rest."""
    s = scenario(5, duration=150.0, trim="table-v")
    flights = [
        s.simulate().flight("once"),
        dataclasses.replace(s, seed=99).simulate().flight("again"),
        short_flight,
    ]
    rest = {n: np.full(len(short_flight), 9.8 if n == "a_z" else 0.0) for n in short_flight.channels}
    for seed in (1, 2):
        noise = np.random.default_rng(seed).normal(size=len(short_flight))
        flights.append(dataclasses.replace(short_flight, channels=rest, outputs={"G_out": noise}))
    distinct(flights)


def test_a_survey_counts_one_record_once(loaded, short_flight, tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(run, "examine_all", in_process)
    write_flight(short_flight, tmp_path / "a.parquet")
    write_flight(short_flight, tmp_path / "b.csv")
    kept = tmp_path / "kept.jsonl"
    for _ in range(2):
        s = api.survey(loaded, [tmp_path / "b.csv", tmp_path / "a.parquet"], resume=kept)
        assert [("verdict" in r, "error" in r) for r in s.records] == [(True, True), (False, True)]
        assert "the same record as" in s.records[1]["error"]["message"]
        assert "content" not in s.records[0]
    assert s.as_json()["counts"]["error"] == 1
