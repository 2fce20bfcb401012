"""What the commands share: kinds of arguments, options, and how a result is written."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.shell_completion import CompletionItem

from ragg_runtime.base.errors import UserError, one_line, printable
from ragg_runtime.cli.outputs import STDOUT, OutputFile, asked

if TYPE_CHECKING:
    from ragg_runtime.flight import Flight
    from ragg_runtime.workflow.loop import Loaded

DIRECTORY = click.Path(path_type=Path)
OUTPUT = OutputFile()
json_option = click.option(
    "--json", "json_file", type=OUTPUT, metavar="FILE", help="Write the result as JSON (- is stdout)."
)
mapping_option = click.option(
    "--map",
    "mapping",
    type=DIRECTORY,
    metavar="FILE",
    help="What the columns of the flight files are (ragg map).",
)
series_option = click.option(
    "-o",
    "--output",
    type=OutputFile(records=True),
    required=True,
    metavar="OUT",
    help="File to write (.csv, .parquet, .nc).",
)
report_option = click.option(
    "--report", "report_file", type=OUTPUT, metavar="FILE.html", help="Write a self-contained report."
)


class Finite(click.FloatRange):
    """A number in a range: neither infinite nor none."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        found = super().convert(value, param, ctx)
        if not math.isfinite(found):
            self.fail(f"{value!r} is no finite number", param, ctx)
        return found


def under_way(text: str) -> None:
    """What is being done, on stderr."""
    click.echo(f"... {text}", err=True)


def load(model_dir: Path) -> Loaded:
    """The model directory; what is odd about it is said on stderr."""
    from ragg_runtime.workflow import loop

    m = loop.load(model_dir)
    for note in m.notes:
        click.echo(one_line(f"note: {model_dir}: {note}"), err=True)
    return m


def about(m: Loaded, read: Sequence[Flight], title: str | None = None) -> dict[str, Any]:
    """What a page says about itself: its title (else those of model and flights), command, sources and notes."""
    from ragg_runtime.workflow import loop

    return {
        "title": f"{m.name} and {', '.join(x.name for x in read)}" if title is None else title,
        "command": command_line(),
        "sources": loop.sources(m, read),
        "notes": loop.notes(m, read),
    }


def emit(result: dict[str, Any], json_file: str | None, text: str) -> None:
    """Text to stdout, JSON where asked (then stdout is the JSON alone if it is ``-``)."""
    import json

    if json_file is not None:
        from ragg_runtime.base.provenance import provenance

        made = {} if "provenance" in result else {"provenance": provenance(command_line())}
        result = result | made
    if json_file in STDOUT:
        click.echo(json.dumps(result, indent=1, allow_nan=False))
        return
    if json_file is not None:
        asked().write(json_file, json.dumps(result, indent=1, allow_nan=False) + "\n")
    click.echo(printable(text))


def write_report(file: str | None, make: Callable[[], str]) -> None:
    if file is not None:
        under_way("writing the report")
        asked().write(file, make())
        click.echo(one_line(f"report: {file}"), err=True)


@contextlib.contextmanager
def telling() -> Iterator[None]:
    """While a result is written on which the change of a model waits: it must not be lost on the way."""
    try:
        yield
    except OSError as error:
        raise UserError(
            "the result cannot be written, so the model is left as it was",
            where=error.filename or "stdout",
            found=error.strerror,
            remedy="make room, or send the result to another file",
        ) from None


def command_line() -> str:
    """The command that runs, as it stands in results."""
    from ragg_runtime.base.provenance import command

    return command()


def catalogued(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Effects of the catalogue, each with its title where the shell shows it."""
    from ragg_runtime.workflow.catalogue import effects

    found = [(str(e["id"]), str(e["title"])) for e in effects()]
    return [CompletionItem(e, help=title) for e, title in found if e.startswith(incomplete)]


def addable(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """The catalogue's, and those that the model lists, without those that it has with values."""
    listed = _listed(ctx.params.get("model_dir"))
    own = [e for e, has_values in listed.items() if not has_values and e.startswith(incomplete)]
    others = [x for x in catalogued(ctx, param, incomplete) if x.value not in listed]
    return [*(CompletionItem(e, help="listed in model.toml") for e in own), *others]


def present(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Effects that the model lists."""
    return [CompletionItem(e) for e in _listed(ctx.params.get("model_dir")) if e.startswith(incomplete)]


def _listed(model_dir: Any) -> dict[str, bool]:
    """Effects of a model.toml -> whether they have values; nothing of one that cannot be read: completion never fails."""
    import tomllib

    from ragg_runtime.base.errors import UserError
    from ragg_runtime.base.files import read_text

    try:
        entries = tomllib.loads(read_text(Path(model_dir) / "model.toml")).get("effects", [])
        rows = [{"id": e} if isinstance(e, str) else dict(e) for e in entries]
        return {str(r["id"]): any(isinstance(v, dict) and "value" in v for v in r.values()) for r in rows}
    except (OSError, ValueError, KeyError, TypeError, UserError):
        return {}
