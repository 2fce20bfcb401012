"""What the commands share: kinds of arguments, options, and how a result is written."""

from __future__ import annotations

import contextlib
import math
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.shell_completion import CompletionItem

from ragg_runtime.base.errors import UserError, one_line, printable
from ragg_runtime.base.files import Target

if TYPE_CHECKING:
    from ragg_runtime.io import Flight
    from ragg_runtime.workflow.loop import Loaded


class OutputFile(click.Path):
    """The type of an option that names a file to write; only one for ``records`` may replace a record."""

    def __init__(self, *, records: bool = False) -> None:
        super().__init__(path_type=str)
        self.records = records

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        name = os.fsdecode(super().convert(value, param, ctx))
        path = Path(name)
        if not self.records and path.is_file() and path.stat().st_size:
            from ragg_runtime.io.formats import ending_of  # only here: to import it takes a while

            if ending_of(path.name) is not None:
                raise _over("a record", path, "a file that is not empty, with the ending of a flight file")
            if path.name in _OF_A_MODEL[0] and (path.resolve().parent / "model.toml").is_file():
                raise _over("a file of a model directory", path, path.name)
        return name


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


STDOUT = ("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1")
"""Names of stdout; where JSON is asked for there, it is all that stands there."""

_KEY = f"{__name__}.outputs"
_OF_A_MODEL = (
    ("model.toml", "history.json", "calibration.json", "mapping.toml"),
    ("generated",),
)  # files, and folders with all in them


def _over(what: str, path: Path, found: str) -> UserError:
    return UserError(
        f"a result would be written over {what}",
        where=path,
        found=found,
        remedy="name another file, or delete this one first",
    )


class Outputs:
    """The files that a command was asked to write, ready to be written; :meth:`place` ends them all."""

    def __init__(self, targets: dict[str, Target]) -> None:
        self._targets = targets
        self._written: list[Target] = []

    def write(self, name: str, content: str | bytes) -> None:
        """Write one of them; nothing stands in its place yet, but what goes to stdout is said at once."""
        if name in STDOUT:
            self._targets[name] = Target(Path("/dev/stdout"))
        self._targets[name].write(content.encode() if isinstance(content, str) else content)
        self._written.append(self._targets[name])

    def place(self) -> None:
        for t in self._written:
            t.place()
        self._written.clear()

    def close(self) -> None:
        for t in self._targets.values():
            t.close()


def asked() -> Outputs:
    """The outputs of the command that runs."""
    found: Outputs = click.get_current_context().meta[_KEY]
    return found


class Command(click.Command):
    """A command whose outputs are made ready before it begins; all other paths that it takes are inputs."""

    def invoke(self, ctx: click.Context) -> Any:
        if sys.stdout is None:
            raise UserError(
                "the result cannot be written: stdout is closed",
                remedy="if it is not wanted, send it away: > /dev/null",
            )
        inputs = [Path(os.fsdecode(p)) for p in _paths(self, ctx, outputs=False)]
        with contextlib.closing(_opened(_paths(self, ctx, outputs=True), inputs)) as outputs:
            ctx.meta[_KEY] = outputs
            result = super().invoke(ctx)
            outputs.place()
        return result


def _paths(command: click.Command, ctx: click.Context, *, outputs: bool) -> list[str]:
    """Values of those parameters that name files to write, or of all other paths."""
    found: list[str] = []
    for p in command.params:
        value = ctx.params.get(p.name or "")
        if isinstance(p.type, click.Path) and isinstance(p.type, OutputFile) == outputs and value is not None:
            found += [str(v) for v in (value if p.multiple or p.nargs == -1 else (value,))]
    return found


def _opened(names: Sequence[str], inputs: Sequence[Path]) -> Outputs:
    targets: dict[str, Target] = {}
    outputs = Outputs(targets)
    try:
        for name in names:
            if name in STDOUT:
                continue
            _check(Path(name), inputs)
            for other in targets.values():
                if not other.is_stream and _same(Path(name), other.path):
                    raise UserError("two results would be written to one file", where=name)
            targets[name] = Target(Path(name))
    except BaseException:
        outputs.close()
        raise
    return outputs


def _check(path: Path, inputs: Iterable[Path]) -> None:
    """UserError if ``path`` is a file that the command reads, or one of a model directory's or folder's own."""
    for given in inputs:
        files, folders = [given], [given / f for f in _OF_A_MODEL[1]]
        if given.is_dir():
            files += [given / f for f in _OF_A_MODEL[0]]
        real = Path(os.path.realpath(path))
        inside = next((f for f in folders if Path(os.path.realpath(f)) in real.parents), None)
        over = next((f for f in files if _same(path, f)), inside)
        if over is not None:
            raise UserError(
                "a result would be written over what the command reads",
                where=path,
                found=f"the same as {over}" if over is not inside else f"a file in {over}",
                expected="a file of its own",
                remedy="name another file",
            )


def _same(one: Path, other: Path) -> bool:
    if os.path.realpath(one) == os.path.realpath(other):
        return True
    with contextlib.suppress(OSError):
        return one.samefile(other)
    return False
