"""Every form carries a version; a newer one is refused with the release that it needs, and left as it is."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from ragg_runtime.base import transaction
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.form_version import Form, NewerFormError, installed
from ragg_runtime.cli.main import main
from ragg_runtime.compensation import saved
from ragg_runtime.flight.mapping import parse_mapping
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model_dir.directory import NAMES
from ragg_runtime.model_dir.history import history_text, read_history
from ragg_runtime.survey import journal, task
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.doctor import examined

NEWER = {"version": 2, "written_by": "ragg 7.1.0"}
MAPPING = '[time]\ncolumn = "t"\n'


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return loop.new(tmp_path / "model").directory.path


def sheet(model: Path) -> str:
    return (model / "model.toml").read_text("utf-8")


def refused_history(model: Path) -> None:
    (model / "history.json").write_text(json.dumps({**NEWER, "steps": []}), "utf-8")
    read_history(model / "history.json")


def refused_change(model: Path) -> None:
    commit = model / transaction.WORK / "commit"
    commit.mkdir(parents=True)
    content = {**NEWER, "folders": {}, "files": [], "removed": ["spectra"]}
    (commit / "journal.json").write_text(json.dumps(content), "utf-8")
    transaction.places(model, NAMES)


def refused_journal(model: Path) -> None:
    given = task.job(sheet(model), model / "model.toml")
    path = model / "results.jsonl"
    path.write_text(json.dumps({**journal.head(given), **NEWER}) + "\n", "utf-8")
    with journal.journal(path) as kept:
        kept.read(given, [])


def toml(text: str) -> str:
    return "".join(f"{k} = {json.dumps(v)}\n" for k, v in NEWER.items()) + text


REFUSED: dict[str, Callable[[Path], object]] = {
    "model.toml": lambda m: parse_instrument(toml(sheet(m)), m / "model.toml"),
    "history.json": refused_history,
    "calibration.json": lambda m: saved.read(json.dumps({**NEWER, "calibrations": []}), "calibration.json"),
    "the record of a change": refused_change,
    "results of a survey": refused_journal,
    "mapping.toml": lambda m: parse_mapping(toml(MAPPING), m / "mapping.toml"),
}


@pytest.mark.parametrize("form", REFUSED)
def test_a_newer_form_is_refused(form: str, model: Path) -> None:
    with pytest.raises(NewerFormError) as refused:
        REFUSED[form](model)
    said = refused.value.message
    assert "is of a newer version of this program" in said
    assert "found: version 2, written by ragg 7.1.0" in said
    assert f"expected: version 1 or older; this is ragg {installed('ragg')}" in said
    assert "ragg 7.1.0 or a newer one is needed" in said


@pytest.mark.parametrize("form", ["history.json", "the record of a change"])
def test_what_is_newer_is_not_damaged(form: str, model: Path) -> None:
    """The doctor puts nothing aside."""
    with pytest.raises(NewerFormError):
        REFUSED[form](model)
    before = {p: p.read_bytes() for p in model.rglob("*") if p.is_file()}
    for mend in (False, True):
        with pytest.raises(NewerFormError):
            examined(model, mend=mend)
    assert {p: p.read_bytes() for p in model.rglob("*") if p.is_file()} == before


@pytest.mark.parametrize("version", [0, -1, 1.0, True, "1", None, [1]])
def test_a_version_is_a_whole_number(version: object) -> None:
    with pytest.raises(UserError, match="whole number from 1 on"):
        Form("it").check({"version": version}, "file")


@pytest.mark.parametrize("writer", [None, 5, "", "x" * 99, "a\nfound: b"])
def test_a_writer_that_says_nothing_of_use(writer: object) -> None:
    with pytest.raises(NewerFormError) as refused:
        Form("it").check({"version": 9, "written_by": writer}, "file")
    said = refused.value.message
    assert len(said.splitlines()) == 4
    assert "or a newer one is needed" in said


def test_this_version_and_none_are_read(model: Path) -> None:
    text = sheet(model)
    assert parse_instrument(f"version = 1\n{text}").form == parse_instrument(text).form
    assert parse_mapping(f"version = 1\n{MAPPING}", model).columns == {"t"}
    assert json.loads((model / "history.json").read_text("utf-8"))["version"] == 1
    assert json.loads(history_text(()))["written_by"] == f"ragg {installed('ragg')}"


def test_results_carry_their_version(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for command in (["history", str(model)], ["effects"], ["effects", "lag"]):
        main([*command, "--json", "-"])
        found = json.loads(capsys.readouterr().out)
        assert next(iter(found.items())) == ("version", 1)
        assert re.fullmatch(r"\d+\.\d+\.\d+.*|not installed", found["provenance"]["ragg"])
