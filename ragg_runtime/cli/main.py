"""The command line, ``ragg``.

Results go to stdout, progress to stderr; the exit status is 0, 1 (a fault of the program) or 2 (bad input).
"""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Mapping, Sequence
from importlib import import_module
from types import MappingProxyType

import click

from ragg_runtime.base.errors import UserError, missing_package, one_line, printable

GROUPS: Mapping[str, Mapping[str, str]] = MappingProxyType(
    {
        "Model": dict.fromkeys(("new", "effects", "history", "remove"), "cli.model_commands"),
        "Flights": dict.fromkeys(("info", "map", "convert"), "cli.model_commands")
        | dict.fromkeys(("compare", "diagnose", "add", "next-motion"), "cli.flight_commands"),
        "After": dict.fromkeys(("calibrate", "compensate", "export"), "cli.flight_commands"),
        "Tools": {
            "survey": "cli.flight_commands",
            "studio": "cli.model_commands",
            "simulate": "cli.model_commands",
            "demo": "cli.model_commands",
            "derive": "cli.model_commands",
        },
    }
)
"""Group -> command -> module of ``ragg_runtime`` that defines it, imported when the command is asked for."""

COMMANDS: Mapping[str, str] = {name: place for group in GROUPS.values() for name, place in group.items()}


class _Commands(click.Group):
    """Commands in groups and in the order in which they are used, each from its module (click: lazy loading)."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        module = import_module(f"ragg_runtime.{COMMANDS[cmd_name]}")
        return next(x for x in vars(module).values() if isinstance(x, click.Command) and x.name == cmd_name)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        for title, names in GROUPS.items():
            commands = [(name, self.get_command(ctx, name)) for name in names]
            with formatter.section(title):
                formatter.write_dl([(n, c.get_short_help_str(60)) for n, c in commands if c and not c.hidden])


@click.group(
    cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100}
)
@click.version_option(package_name="ragg", prog_name="ragg")
def cli() -> None:
    """Instrument models of a rotating-accelerometer gravity gradiometer, derived symbolically.

    Compare a model with recorded flights, find the physical effect that is missing, add it, see the error
    fall: ragg new, compare, diagnose, add.
    """


def main(arguments: Sequence[str] | None = None) -> None:
    """Entry point: never a traceback for bad input."""
    try:
        for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
            os.environ.setdefault(name, "1")  # before NumPy is imported: its threads would turn idly
        words = sys.argv[1:] if arguments is None else list(arguments)
        cli.main(args=words, prog_name="ragg", standalone_mode=False, obj=words)
    except UserError as error:
        click.echo(printable(f"ragg: {error}"), err=True)
        sys.exit(2)
    except click.exceptions.Exit as end:
        sys.exit(end.exit_code)
    except (click.Abort, KeyboardInterrupt):
        click.echo("ragg: interrupted; nothing was changed", err=True)
        sys.exit(130)
    except click.ClickException as error:
        error.show()
        sys.exit(2)
    except BrokenPipeError:
        sys.exit(0)
    except MemoryError:
        click.echo("ragg: there is not enough memory; nothing was changed", err=True)
        sys.exit(2)
    except OSError as error:
        click.echo(f"ragg: {describe_refusal(error)}", err=True)
        sys.exit(2)
    except Exception as error:
        missing = missing_package(error)
        if missing is not None:
            click.echo(f"ragg: {missing}", err=True)
            sys.exit(2)
        traceback.print_exc()
        click.echo("ragg: this is a fault of the program, not of your input; please report it", err=True)
        sys.exit(1)


def describe_refusal(error: OSError) -> str:
    """An error of the system, and its place, in one line."""
    places = [os.fsdecode(p) for p in (error.filename, error.filename2) if isinstance(p, (str, bytes))]
    return one_line(": ".join([*([" and ".join(places)] if places else []), error.strerror or str(error)]))
