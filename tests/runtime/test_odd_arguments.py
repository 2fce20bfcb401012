"""Numbers that are none, files that never end and tables without end: one message, at once."""

from __future__ import annotations

import os
import sys
from importlib import resources
from pathlib import Path
from typing import Any

import pytest

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import main
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.simulate import simulate_flight


@pytest.mark.parametrize("option", ["--duration", "--noise"])
@pytest.mark.parametrize("value", ["nan", "inf"])
def test_a_number_must_be_one(
    option: str, value: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["simulate", str(tmp_path / "m"), "-o", str(tmp_path / "x.csv"), option, value])
    assert ended.value.code == 2
    assert "not a finite number" in capsys.readouterr().err


@pytest.mark.skipif(sys.platform == "win32", reason="pipes and devices of Unix")
def test_a_test_sheet_that_never_ends(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for source in (tmp_path / "pipe", Path("/dev/zero")):
        with pytest.raises(UserError, match="not a pipe or a device"):
            api.new(tmp_path / "m", source)


def test_a_flight_longer_than_memory(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="too long to be simulated"):
        simulate_flight(api.new(tmp_path / "m").instrument, [], duration=1e18)


@pytest.mark.parametrize(
    "asked",
    [
        {"noise": 1e308},
        {"sheet_error": 1e300},
        {"spin": ["1e300"]},
        {"spin": ["0.25,0.1@1e300"]},
    ],
)
def test_a_flight_beyond_all_numbers_is_refused(asked: dict[str, Any]) -> None:
    """It ended in a traceback, or in a file of NaN."""
    instrument = parse_instrument(resources.files("ragg_runtime").joinpath("example.toml").read_text("utf-8"))
    with pytest.raises(UserError, match="values are not finite"):
        simulate_flight(instrument, [], duration=20.0, rate=8.0, **asked)
