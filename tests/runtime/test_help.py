"""The help of the command line fits its lines."""

from __future__ import annotations

import click

from ragg_runtime.cli.main import COMMANDS, cli


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
