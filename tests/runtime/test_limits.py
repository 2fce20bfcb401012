"""Texts that are far too long or too deep are refused early; nothing in a file is executed."""

from __future__ import annotations

import gzip
from pathlib import Path

import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.read_toml import read_instrument
from ragg_runtime.io import read_flight
from ragg_runtime.model_dir.history import read_history

UNITS = {
    "time": "s",
    **{f"a_{k}": "g" for k in "xyz"},
    **{f"omega_{k}": "rad/s" for k in "xyz"},
    "G_out": "V",
}
HEADER = ",".join(f"{n} [{u}]" for n, u in UNITS.items()) + "\n"


@pytest.mark.parametrize("text", ["a" * (3 << 20), HEADER + "1" * (3 << 20), "# " + "a" * (3 << 20)])
def test_a_line_without_end(tmp_path: Path, text: str) -> None:
    path = tmp_path / "flight.csv.gz"
    path.write_bytes(gzip.compress(text.encode()))
    with pytest.raises(UserError, match="a line of more than"):
        read_flight(path, 9.8)


def test_texts_that_are_too_long_or_too_deep(tmp_path: Path) -> None:
    path = tmp_path / "model.toml"
    path.write_text("#" * (2 << 20))
    with pytest.raises(UserError, match="too long"):
        read_instrument(path)
    path.write_text("a = " + "[" * 5000)
    with pytest.raises(UserError, match="not a TOML file"):
        read_instrument(path)
    path = tmp_path / "history.json"
    path.write_text("[" * 100_000)
    with pytest.raises(UserError, match="history is damaged"):
        read_history(path)
    path.write_text('{"steps": [{"action": ' + "9" * 5000 + "}]}")
    with pytest.raises(UserError, match="history is damaged"):
        read_history(path)
