"""What the commands share: kinds of arguments, options, and how a result is written."""

from __future__ import annotations

import contextlib
import json
import math
import os
import shlex
import sys
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.shell_completion import CompletionItem

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.files import Target, read_text
from ragg_runtime.base.provenance import provenance
from ragg_runtime.report.page import Origin
from ragg_runtime.wording.sections import Section, render_text


class Later:
    """A module that is imported when it is first used: help and completion are there at once."""

    def __init__(self, name: str) -> None:
        self._name = f"ragg_runtime.{name}"

    def __getattr__(self, attribute: str) -> Any:
        return getattr(import_module(self._name), attribute)


if TYPE_CHECKING:
    from ragg_runtime import api
    from ragg_runtime.api import Loaded
    from ragg_runtime.io import Flight
else:
    api = Later("api")

STDOUT = ("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1")
"""Names of stdout; where JSON is asked for there, it is all that is written there."""

_RUN = f"{__name__}.run"
GENERATED = "generated"
_OF_A_MODEL = ("model.toml", "history.json", "calibration.json", "mapping.toml", GENERATED)
"""A model directory's own files, and the folder with the derived code."""


class OutputFile(click.Path):
    """The type of an option that names a file to write; only one for ``records`` may replace a record."""

    def __init__(self, *, records: bool = False) -> None:
        super().__init__(path_type=str)
        self.records = records

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        name = os.fsdecode(super().convert(value, param, ctx))
        path = Path(name)
        if not self.records and path.is_file() and path.stat().st_size:
            from ragg_runtime.io.files import find_ending  # only here: to import it takes a while

            if find_ending(path.name) is not None:
                raise _over("a record", path, "a file that is not empty, with the ending of a flight file")
            if path.name in _OF_A_MODEL and (path.resolve().parent / "model.toml").is_file():
                raise _over("a file of a model directory", path, path.name)
        return name


class Finite(click.FloatRange):
    """A number in a range: neither infinite nor none."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        found = super().convert(value, param, ctx)
        if not math.isfinite(found):
            self.fail(f"{value!r} is no finite number", param, ctx)
        return found


PLACE = click.Path(path_type=Path)
model_argument = click.argument("model_dir", type=PLACE)
flights_argument = click.argument("flights", type=PLACE, nargs=-1, required=True)
mapping_option = click.option(
    "--map",
    "mapping",
    type=PLACE,
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
limit_option = click.option(
    "--limit",
    "limits",
    multiple=True,
    metavar="WHAT=SIZE",
    help="Largest motion to fly next: a=50mg, omega=500deg/h, jerk=1m/s^3, alpha=1deg/s^2.",
)
_JSON = click.Option(
    ["--json", "json_file"], type=OutputFile(), metavar="FILE", help="Write the result as JSON (- is stdout)."
)
_REPORT = click.Option(
    ["--report", "report_file"], type=OutputFile(), metavar="FILE.html", help="Write a self-contained report."
)
_VERBOSE = click.Option(["-v", "--verbose"], is_flag=True, help="Show all details.")


class Run:
    """What a command was asked to write, ready to be written; :meth:`place` puts all of it in its place."""

    def __init__(self, targets: dict[str, Target], options: Mapping[str, Any]) -> None:
        self._targets = targets
        self._written: list[Target] = []
        self.json_file: str | None = options.get("json_file")
        self.report_file: str | None = options.get("report_file")
        self.verbose = bool(options.get("verbose"))

    def write(self, name: str, content: str | bytes) -> None:
        """Write one of the files; nothing is in its place yet, but what goes to stdout is written at once."""
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


class Command(click.Command):
    """A command whose outputs are made ready before it begins; all other paths that it takes are inputs.

    With ``json`` and ``report`` it has these options: :func:`conclude` writes what they ask for.
    """

    def __init__(self, *args: Any, json: bool = True, report: bool = False, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.params += [
            *([_JSON] if json else []),
            *([_REPORT] if report else []),
            *([_VERBOSE] if json else []),
        ]

    def invoke(self, ctx: click.Context) -> Any:
        if sys.stdout is None:
            raise UserError(
                "the result cannot be written: stdout is closed",
                remedy="if it is not wanted, send it away: > /dev/null",
            )
        targets = _opened(_paths(self, ctx, outputs=True), _paths(self, ctx, outputs=False))
        options: dict[str, Any] = {
            k: ctx.params.pop(k) for k in ("json_file", "report_file", "verbose") if k in ctx.params
        }
        with contextlib.closing(Run(targets, options)) as run:
            ctx.meta[_RUN] = run
            result = super().invoke(ctx)
            run.place()
        return result


def running() -> Run:
    """The outputs of the command that runs."""
    found: Run = click.get_current_context().meta[_RUN]
    return found


def under_way(text: str) -> None:
    """What is being done, on stderr."""
    click.echo(f"... {text}", err=True)


def load(model_dir: Path) -> Loaded:
    """The model directory; what is odd about it is said on stderr."""
    m = api.load(model_dir)
    for note in m.notes:
        click.echo(one_line(f"note: {model_dir}: {note}"), err=True)
    return m


def read(m: Loaded, flights: Sequence[Path], mapping: Path | None) -> list[Flight]:
    """The flights, read and examined."""
    under_way(f"reading {len(flights)} flight{'' if len(flights) == 1 else 's'}")
    return api.read_flights(m, flights, mapping)


@contextlib.contextmanager
def working(text: str, command: str, flights: Sequence[Flight]) -> Iterator[None]:
    """Say on stderr what is done meanwhile, and how far it is."""
    under_way(text)
    with progress.shown(command, sum(map(len, flights))):
        yield


@dataclass(frozen=True)
class Source:
    """What a result was made from: model and flights, the model before the command changed it, notes beside theirs."""

    m: Loaded
    flights: Sequence[Flight] = ()
    before: Loaded | None = None
    notes: Sequence[str] = ()

    def json(self) -> dict[str, object]:
        """``provenance`` and ``notes`` of the JSON."""
        made = api.origin(self.m, self.flights, command_line(), before=self.before)
        return made | {"notes": [*self.notes, *api.notes(self.m, self.flights)]}

    def origin(self, title: str | None) -> Origin:
        """Title, command, sources and notes of a page."""
        return Origin(
            title=title or f"{self.m.name} and {', '.join(x.name for x in self.flights)}",
            command=command_line(),
            sources=api.sources(self.m, self.flights),
            notes=(*self.notes, *api.notes(self.m, self.flights)),
            digest=self.m.model.digest,
        )


def conclude(
    result: Mapping[str, Any],
    sections: Sequence[Section],
    source: Source | None = None,
    page: Callable[[Origin], str] | None = None,
    title: str | None = None,
) -> None:
    """Write the report and the JSON where they are asked for, and say the result on stdout.

    Parameters
    ----------
    result
        The JSON, without what ``source`` adds.
    sections
        What is said of it. If JSON goes to stdout it is all that is written there.
    source
        What it was made from; notes on its flights are said below.
    page
        Makes the report, which has this ``title``.
    """
    run = running()
    if run.report_file is not None and page is not None:
        under_way("writing the report")
        origin = Origin(title or "", command_line(), ()) if source is None else source.origin(title)
        run.write(run.report_file, page(origin))
        click.echo(one_line(f"report: {run.report_file}"), err=True)
    if run.json_file is not None:
        whole = {**result, **({} if source is None else source.json())}
        whole.setdefault("provenance", provenance(command_line()))
        text = json.dumps(whole, indent=1, allow_nan=False)
        if run.json_file in STDOUT:
            click.echo(text)
            return
        run.write(run.json_file, text + "\n")
    noted = notes_of([] if source is None else source.flights)
    click.echo(render_text([*sections, *noted], verbose=run.verbose))


@contextlib.contextmanager
def before_change() -> Iterator[None]:
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


def notes_of(flights: Sequence[Flight]) -> list[Section]:
    """What the reader did to flights, every note once, with the flights that it is about."""
    about: dict[str, list[str]] = {}
    for x in flights:
        for note in x.notes:
            about.setdefault(str(note), []).append(x.name)
    lines = []
    for note, names in about.items():
        which = f"{len(names)} flights: " if len(names) > 3 else f"{', '.join(names)}: "
        lines.append(f"note: {which if len(flights) > 1 else ''}{note}")
    return [Section(sentences=tuple(lines))] if lines else []


def command_line() -> str:
    """The command that runs, as it is written in results."""
    words = click.get_current_context().find_root().obj
    return shlex.join(["ragg", *(sys.argv[1:] if words is None else words)])


def next_command(
    verb: str, model_dir: Path, flights: Sequence[Flight], mapping: Path | None = None, effect: str = ""
) -> str:
    """A command on the same model and flights, as a shell takes it: ``ragg add my-model lag day-1/flight.csv``."""
    files = dict.fromkeys(str(x.path) for x in flights if x.path is not None)
    words = [verb, str(model_dir), *([effect] if effect else []), *files]
    words += [] if mapping is None else ["--map", str(mapping)]
    return one_line(f"ragg {shlex.join(words)}{'' if files else ' FLIGHT'}")


def complete_effect(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Effects that the model lists, and, but for ``remove``, those of the catalogue with their titles."""
    from ragg_runtime.model.catalogue import effects

    found = dict.fromkeys(_listed(ctx.params.get("model_dir")), "listed in model.toml")
    if ctx.command.name != "remove":
        found |= {str(e["id"]): str(e["title"]) for e in effects()}
    return [CompletionItem(e, help=title) for e, title in found.items() if e.startswith(incomplete)]


def _listed(model_dir: Any) -> list[str]:
    """Effects of a model.toml; nothing of one that cannot be read: completion never fails."""
    try:
        entries = tomllib.loads(read_text(Path(model_dir) / "model.toml")).get("effects", [])
        return [e if isinstance(e, str) else str(e["id"]) for e in entries]
    except (OSError, ValueError, KeyError, TypeError, UserError):
        return []


def _over(what: str, path: Path, found: str) -> UserError:
    return UserError(
        f"a result would be written over {what}",
        where=path,
        found=found,
        remedy="name another file, or delete this one first",
    )


def _paths(command: click.Command, ctx: click.Context, *, outputs: bool) -> list[str]:
    """Values of those parameters that name files to write, or of all other paths."""
    found: list[str] = []
    for p in command.params:
        value = ctx.params.get(p.name or "")
        if isinstance(p.type, click.Path) and isinstance(p.type, OutputFile) == outputs and value is not None:
            found += [os.fsdecode(v) for v in (value if p.multiple or p.nargs == -1 else (value,))]
    return found


def _opened(names: Sequence[str], inputs: Sequence[str]) -> dict[str, Target]:
    """The files to write, made ready; UserError if one is read as well, or is written twice."""
    read = [Path(p) for p in inputs]
    read += [p / name for p in read if p.is_dir() for name in _OF_A_MODEL]
    with contextlib.ExitStack() as undo:
        targets: dict[str, Target] = {}
        for name in (n for n in names if n not in STDOUT):
            path = Path(name)
            over = next(
                (f for f in read if _same(path, f) or (f.name == GENERATED and _inside(path, f))), None
            )
            if over is not None:
                raise _over("what the command reads", path, f"the same as {over}, or a file in it")
            if any(not t.is_stream and _same(path, t.path) for t in targets.values()):
                raise UserError("two results would be written to one file", where=name)
            targets[name] = Target(path)
            undo.callback(targets[name].close)
        undo.pop_all()
    return targets


def _same(one: Path, other: Path) -> bool:
    if os.path.realpath(one) == os.path.realpath(other):
        return True
    with contextlib.suppress(OSError):
        return one.samefile(other)
    return False


def _inside(path: Path, folder: Path) -> bool:
    return Path(os.path.realpath(folder)) in Path(os.path.realpath(path)).parents
