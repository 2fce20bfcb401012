"""A few of the trials of ``make faults``."""

from __future__ import annotations

import sys

import pytest

from .__main__ import main


@pytest.mark.timeout(900)
@pytest.mark.skipif(sys.platform == "win32", reason="needs SIGKILL of a group of processes")
def test_killed_commands(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--trials", "1", "--seed", "1"]) == 0, capsys.readouterr().out
