"""The shell completes ids of effects, those of the catalogue and a model's own, and never fails; help fits its lines."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import click
import pytest
from click.shell_completion import ShellComplete

from ragg_runtime.cli.main import COMMANDS, cli

RAGG = [sys.executable, "-m", "ragg_runtime"]


def completed(*words: str) -> list[str]:
    """What the shell is offered for the last word."""
    shell = ShellComplete(cli, {}, "ragg", "_RAGG_COMPLETE")
    return [c.value for c in shell.get_completions(list(words[:-1]), words[-1])]


@pytest.fixture
def model(tmp_path: Path) -> Path:
    own = '{ id = "satin-mine", stage = "transducer", add = "K_x * f_i", K_x = { unit = "1" } }'
    known = '{ id = "saturation", V_max = { value = 9.0, unit = "V" } }'
    (tmp_path / "model.toml").write_text(f"effects = [{own}, {known}, 'lag']\n")
    return tmp_path


def test_effects_are_offered_where_they_can_be_used(model: Path) -> None:
    assert completed("effects", "thermal-b") == ["thermal-bias"]
    assert completed("add", str(model), "sat") == ["satin-mine", "saturation"]
    assert completed("add", str(model / "none"), "sat") == ["saturation"]
    assert completed("remove", str(model), "sa") == ["satin-mine", "saturation"]
    for text in ("", "effects = 3", "effects = [[1]]", "effects = [{}]", "= = ="):
        (model / "model.toml").write_text(text)
        assert completed("remove", str(model), "s") == []


def test_the_line_that_switches_it_on_prints_a_script() -> None:
    own = {"_RAGG_COMPLETE": "zsh_source", "PYTHONPATH": str(Path(__file__).parents[2])}
    done = subprocess.run(RAGG, env=os.environ | own, capture_output=True, text=True, timeout=60)
    assert "_RAGG_COMPLETE" in done.stdout


def test_no_summary_is_cut_off() -> None:
    context = click.Context(cli)
    for name in COMMANDS:
        command = cli.get_command(context, name)
        assert command is not None
        summary = command.get_short_help_str(1000)
        assert summary == command.get_short_help_str(60), name
    shown = cli.get_help(context)
    assert "\n  derive " not in shown
    assert [x for x in ("Model:", "Flights:", "After:", "Tools:") if x not in shown] == []
