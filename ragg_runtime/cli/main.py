"""The command line, ``ragg``.

Results go to stdout, progress to stderr; the exit status is 0, 1 (a fault of ours) or 2 (bad input).
"""

from __future__ import annotations

import sys
import traceback
from collections.abc import Sequence

import click

from ragg_runtime.base.errors import UserError, printable
from ragg_runtime.base.memory import reuse_memory
from ragg_runtime.cli import after, flight_commands, model_commands
from ragg_runtime.cli.boundary import hold_streams, refusal
from ragg_runtime.cli.file_commands import convert, map_command
from ragg_runtime.cli.next_motion_command import next_motion
from ragg_runtime.cli.quality_command import qc
from ragg_runtime.experiments.command import experiment
from ragg_runtime.studio.command import studio


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="ragg", prog_name="ragg")
def cli() -> None:
    """Instrument models of a rotating-accelerometer gravity gradiometer, derived, not typed.

    Compare the model with recorded flights, learn which physical effect it lacks, add it, watch the error
    fall: ragg new, compare, diagnose, add.
    """


for _command in (
    *model_commands.COMMANDS,
    *flight_commands.COMMANDS,
    *after.COMMANDS,
    convert,
    map_command,
    qc,
    next_motion,
    experiment,
    studio,
):
    cli.add_command(_command)


def main(arguments: Sequence[str] | None = None) -> None:
    """Entry point: never a traceback for bad input."""
    hold_streams()
    try:
        reuse_memory()
        cli.main(args=None if arguments is None else list(arguments), prog_name="ragg", standalone_mode=False)
    except UserError as error:
        click.echo(printable(f"ragg: {error}"), err=True)
        sys.exit(2)
    except click.exceptions.Exit as end:
        sys.exit(end.exit_code)
    except click.Abort:
        click.echo("ragg: interrupted; nothing was changed", err=True)
        sys.exit(130)
    except click.ClickException as error:
        error.show()
        sys.exit(2)
    except BrokenPipeError:
        sys.exit(0)
    except MemoryError:
        click.echo("ragg: there is not enough memory for this; nothing was changed", err=True)
        sys.exit(2)
    except KeyboardInterrupt:
        click.echo("ragg: interrupted; nothing was changed", err=True)
        sys.exit(130)
    except OSError as error:
        click.echo(f"ragg: {refusal(error)}", err=True)
        sys.exit(2)
    except Exception:
        traceback.print_exc()
        click.echo("ragg: this is a fault of the program, not of your input; please report it", err=True)
        sys.exit(1)
