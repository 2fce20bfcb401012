"""A command that is cut off between any two files; ``make faults`` kills commands at random moments."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.runtime.commands import ragg

from .__main__ import COMMANDS, OLD, prepared, state


@pytest.mark.parametrize("command", ["add", "calibrate"])
def test_a_command_that_is_cut_off_leaves_the_old_or_the_new_model(command, tmp_path, monkeypatch) -> None:
    """What lies there whenever a file is put in place is kept, as a kill would leave it, and the command repeated."""
    base = prepared(tmp_path / "base")
    places: list[Path] = []
    arguments, new = COMMANDS[command]
    words = arguments[:3] if command == "add" else arguments  # an effect is added without a flight as well
    replace = os.replace

    def photographed(source: Any, target: Any) -> None:
        places.append(Path(shutil.copytree(base, tmp_path / f"cut-{len(places)}")))
        replace(source, target)

    monkeypatch.chdir(base)
    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", photographed)
        assert ragg(*words).returncode == 0
    assert state(base) == new
    assert len(places) >= 2
    assert all(state(p) in (OLD, new) for p in places)
    monkeypatch.chdir(places[1])  # the history is written, the file that it tells of is not
    assert state(places[1]) == OLD
    assert ragg(*words).returncode == 0
    assert state(places[1]) == new
