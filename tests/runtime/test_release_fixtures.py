"""What 0.1.0 wrote is read by today's commands, with the meaning that it had."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import main
from ragg_runtime.flight import read_flight
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.survey import journal, run, summary, task
from ragg_runtime.workflow import loop

KEPT = Path(__file__).parents[1] / "fixtures" / "0.1.0"
EFFECTS = {"plain": [], "added": ["thermal-scale"], "own": ["warm-square", "lag"], "python": ["own-gain"]}
ONE_DISC = (KEPT / "plain" / "model.toml").read_text("utf-8")
MADE_IN = "/tmp/fix"  # where the flights of results.jsonl stood


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of everything, as the current folder; what is trusted is the test's own."""
    shutil.copytree(KEPT, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("RAGG_NATIVE", "off")
    return tmp_path


def ragg(*arguments: str, status: int = 0) -> None:
    try:
        main(list(arguments))
        found: object = 0
    except SystemExit as end:
        found = end.code or 0
    assert found == status


def told(*arguments: str) -> dict[str, Any]:
    """The JSON of a command."""
    ragg(*arguments, "--json", "out.json")
    found: dict[str, Any] = json.loads(Path("out.json").read_text("utf-8"))
    assert found["version"] == 1
    return found


def then(name: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((KEPT / name).read_text("utf-8"))
    return found


def missing(old: Any, new: Any, place: str = "") -> list[str]:
    """Where a result of today lacks a key that an old one has, or holds another type of JSON there."""
    if old is None or new is None:
        return []
    if isinstance(old, Mapping):
        if not isinstance(new, Mapping):
            return [f"{place}: no object"]
        lost = [f"{place}.{k}" for k in old if k not in new]
        return lost + [x for k in old if k in new for x in missing(old[k], new[k], f"{place}.{k}")]
    if isinstance(old, list):
        if not isinstance(new, list):
            return [f"{place}: no list"]
        return missing(old[0], new[0], f"{place}[0]") if old and new else []
    numbers = (int, float)
    same = type(old) is type(new) or (isinstance(old, numbers) and isinstance(new, numbers))
    return [] if same else [f"{place}: {type(new).__name__} for {type(old).__name__}"]


@pytest.mark.parametrize("name", EFFECTS)
def test_model_directories(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The history is told as it stands; the doctor brings the code up to date and leaves model.toml alone."""
    steps = json.loads((KEPT / name / "history.json").read_text("utf-8"))["steps"]
    assert told("history", name)["steps"] == steps
    if name == "python":
        ragg("doctor", name, status=2)
        assert "ragg trust python" in capsys.readouterr().out
        ragg("trust", name)
    ragg("doctor", name)
    assert Path(name, "model.toml").read_bytes() == (KEPT / name / "model.toml").read_bytes()
    assert told("history", name)["steps"] == steps
    m = loop.load(Path(name))
    assert [e.id for e in m.model.effects] == EFFECTS[name]
    assert m.notes == ()
    assert m.instrument.form == parse_instrument(ONE_DISC).form


def test_verdicts_and_errors() -> None:
    compared, diagnosed = (
        told("compare", "plain", "north.parquet"),
        told("diagnose", "plain", "north.parquet"),
    )
    old, older = then("compare.json"), then("diagnose.json")
    assert missing(old, compared) == []
    assert missing(older, diagnosed) == []
    assert (diagnosed["verdict"], diagnosed["found"]) == ("missing-effect", ["thermal-scale"])
    assert (older["verdict"], older["found"]) == ("missing-effect", ["thermal-scale"])
    assert compared["adequate"] is old["adequate"] is False
    for which in ("nominal", "calibrated", "holdout"):
        assert compared["error"][which]["rms_Eo"] == pytest.approx(old["error"][which]["rms_Eo"], rel=0.02)
    first, before = diagnosed["ranking"][0], older["ranking"][0]
    assert first["error_after"]["rms_Eo"] == pytest.approx(before["error_after"]["rms_Eo"], rel=0.02)


def test_a_model_with_an_effect_has_the_error_that_its_history_tells() -> None:
    after = then("history.json")["steps"][1]["after"]
    error = told("compare", "added", "north.parquet")
    assert error["adequate"] is True
    assert error["error"]["calibrated"]["rms_Eo"] == pytest.approx(after["calibrated"]["rms_Eo"], rel=0.02)


def test_adding_to_a_model_of_then() -> None:
    found, old = told("add", "plain", "thermal-scale", "north.parquet"), then("add.json")
    assert missing(old, found) == []
    for when in ("before", "after"):
        for which in ("calibrated", "holdout"):
            then_Eo = old[when][which]["rms_Eo"]
            assert found[when][which]["rms_Eo"] == pytest.approx(then_Eo, rel=0.02)
    assert missing(then("remove.json"), told("remove", "plain", "thermal-scale")) == []
    written = json.loads(Path("plain/history.json").read_text("utf-8"))
    assert written["version"] == 1
    assert written["steps"][:1] == json.loads((KEPT / "plain/history.json").read_text("utf-8"))["steps"]
    assert missing(then("history.json"), told("history", "plain")) == []
    assert missing(then("effects.json"), told("effects")) == []


def test_results_of_a_survey(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its journal: of another program, so not continued, and left as it is; by the same program it would be."""
    results = here / "results.jsonl"
    kept = results.read_text("utf-8").replace(MADE_IN, str(here))
    results.write_text(kept, "utf-8")
    flights = [here / "north.parquet", here / "south.parquet"]
    ragg("survey", "plain", *map(str, flights), "--resume", "results.jsonl", status=2)
    assert results.read_text("utf-8") == kept

    program = tuple(json.loads(kept.splitlines()[0])["program"].items())
    monkeypatch.setattr(task, "fingerprint", lambda: program)
    text = (here / "plain" / "model.toml").read_text("utf-8")
    found = run.survey(text, here / "plain" / "model.toml", flights, resume=results)
    old = {f["flight"]: f for f in then("survey.json")["flights"]}
    for record in found.records:
        assert record == old[record["flight"]] | {"file": str(here / record["flight"])}


def twelve_digits(x: object) -> object:
    """As JSON reads it, its numbers to twelve digits: logarithms differ in the last one from library to library."""
    return json.loads(json.dumps(x), parse_float=lambda text: float(f"{float(text):.12g}"))


def test_a_survey_told_as_json() -> None:
    """The same records are summed up to the same table."""
    old = then("survey.json")
    found = summary.summarised(old["flights"]).as_json()
    assert missing({k: old[k] for k in found}, json.loads(json.dumps(found))) == []
    assert found["counts"] == old["counts"]
    assert twelve_digits(found["recommendation"]) == twelve_digits(old["recommendation"])
    assert found["median_error"] == pytest.approx(old["median_error"])


def test_a_journal_says_whose_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    ragg("survey", "plain", "north.parquet", "--resume", "results.jsonl", status=2)
    said = capsys.readouterr().err
    assert "these results are of another version of the program" in said
    assert "what is done is kept" not in said  # nothing was done


def test_flights() -> None:
    csv, nc = (read_flight(Path(n), 9.8) for n in ("short.csv", "short.nc"))
    np.testing.assert_allclose(csv.outputs["G_out"], nc.outputs["G_out"], rtol=1e-12)
    assert set(csv.channels) == set(nc.channels)
    digests = {
        f["path"].rpartition("/")[2]: f["digest"] for f in then("survey.json")["provenance"]["flights"]
    }
    for name in ("north.parquet", "south.parquet"):
        assert read_flight(Path(name), 9.8).digest == digests[name] == journal.sha256(Path(name))


Change = Callable[[dict[str, Any]], object]
NONE: dict[str, Change] = {
    "no digest": lambda r: r.pop("sha256"),
    "a verdict of no survey": lambda r: r.update(verdict="fine"),
    "another flight's name": lambda r: r.update(flight="other.parquet"),
    "an effect that is no text": lambda r: r.update(found=[7]),
    "a name with a line end": lambda r: r.update(found=["lag\nverdict: adequate"]),
    "no error": lambda r: r.pop("error"),
    "an error without end": lambda r: r["noise_floor"].update(rms_Eo=10**400),
    "a parameter without spread": lambda r: r["parameters"][0].update(std=1e-300),
    "landmarks of two lengths": lambda r: r.update(
        landmarks={"rate": 8, "rows": [1], "columns": {"a_x": []}, "digit": {"a_x": 0}, "spread": {"a_x": 1}}
    ),
}


@pytest.mark.parametrize("change", NONE)
def test_a_record_that_no_survey_writes(change: str, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One message with its line; the results file stays as it is."""
    results = here / "results.jsonl"
    lines = results.read_text("utf-8").replace(MADE_IN, str(here)).splitlines(keepends=True)
    program = tuple(json.loads(lines[0])["program"].items())
    monkeypatch.setattr(task, "fingerprint", lambda: program)
    number = next(n for n, line in enumerate(lines) if '"flight":"north.parquet"' in line)
    record = json.loads(lines[number])
    NONE[change](record)
    lines[number] = json.dumps(record) + "\n"
    results.write_text("".join(lines), "utf-8")
    path = here / "plain" / "model.toml"
    with pytest.raises(UserError, match=f"line {number + 1}: this record is none that a survey writes"):
        run.survey(path.read_text("utf-8"), path, [here / "north.parquet"], resume=results)
    assert results.read_text("utf-8") == "".join(lines)


@pytest.mark.skipif(sys.platform == "win32", reason="pipes")
def test_a_pipe_is_no_results_file(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It was waited for without end."""
    os.mkfifo(here / "pipe.jsonl")
    ragg("survey", "plain", "north.parquet", "--resume", "pipe.jsonl", status=2)
    assert "not a regular file" in capsys.readouterr().err
