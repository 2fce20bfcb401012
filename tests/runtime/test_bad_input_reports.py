"""What was done to a record stands on the terminal, in the JSON and in the report of every command."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from bad_input_table import Row, flown, outputs, ran, struck

NOTE = "samples stand far off the neighbours"


@pytest.mark.parametrize(
    "command", [("compare", "model"), ("diagnose", "model"), ("add", "model", "thermal-scale")]
)
def test_the_notes_are_everywhere(command: tuple[str, ...], tmp_path: Path) -> None:
    row = Row(
        flown(outputs(struck), hidden=True),
        (NOTE,),
        (*command, "flight.csv", "--json", "x.json", "--report", "x.html"),
        0,
    )
    r = ran(row, tmp_path)
    assert r.status == 0, r.err
    assert NOTE in r.message
    assert any(NOTE in note for note in json.loads((tmp_path / "x.json").read_text())["notes"])
    page = (tmp_path / "x.html").read_text("utf-8")
    assert "What was done to the record" in page
    assert NOTE in page
