"""What a command says meanwhile, and when it is asked how."""

from __future__ import annotations

import time

import click
import pytest

from ragg_runtime.base import progress
from ragg_runtime.cli.main import COMMANDS, cli


@pytest.mark.parametrize(
    ("passes", "pause", "last"),
    [
        ([0.05] * 10, 12.0, "... 50 % done, about 120 s left"),
        ([1.0] * 2, 300.0, "... 600 s so far, longer than estimated"),
        ([0.1], 1.0, ""),  # a short command
    ],
)
def test_lines_tell_share_and_time_left(passes, pause, last, monkeypatch, capsys) -> None:
    now = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    with progress.shown("diagnose", 1000):
        for share in passes:
            now[0] += pause
            progress.step(progress.PASSES["diagnose"] * 1000 * share)
    assert ["", *capsys.readouterr().err.splitlines()][-1] == last
    progress.step(1.0)  # nobody listens any more
    assert capsys.readouterr().err == ""


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
