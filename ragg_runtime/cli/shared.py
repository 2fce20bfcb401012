"""What the commands share: kinds of arguments, options, and how a result is written."""

from __future__ import annotations

import json
import os
import shlex
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError, count, one_line
from ragg_runtime.base.files import check_writable, provenance, write_text
from ragg_runtime.wording.describe import group_notes
from ragg_runtime.wording.sections import Section, render_text


class Later:
    """A module that is imported when it is first used: help and completion are there at once."""

    def __init__(self, name: str) -> None:
        self._name = f"ragg_runtime.{name}"

    def __getattr__(self, attribute: str) -> Any:
        return getattr(import_module(self._name), attribute)


if TYPE_CHECKING:
    from ragg_runtime import api
    from ragg_runtime.api import Loaded, Source
    from ragg_runtime.io import Flight
else:
    api = Later("api")

# names of stdout; where JSON is asked for there, it is all that is written there
STDOUT = ("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1")
# commands that show the notes on the flights; the others, which come after, count them
SHOW_NOTES = ("compare", "diagnose")
OF_A_MODEL = ("model.toml", "history.json", "calibration.json", "mapping.toml")  # files of a model directory


PLACE = click.Path(path_type=Path)  # of what is read
RESULT = click.Path(path_type=str, writable=True)  # of what is written
model_argument = click.argument("model_dir", type=PLACE)
flights_argument = click.argument("flights", type=PLACE, nargs=-1, required=True)
mapping_option = click.option(
    "--map", "mapping", type=PLACE, metavar="FILE", help="Mapping of the flights' columns (see ragg map)."
)
frozen_option = click.option("--frozen", is_flag=True, help="The same as --calibration frozen.")


def output_option(metavar: str, text: str, *, required: bool = True) -> Callable[[Any], Any]:
    """``-o``, a file to write."""
    return click.option("-o", "--output", type=RESULT, required=required, metavar=metavar, help=text)


series_option = output_option("OUT", "File to write (.csv, .parquet, .nc).")
limit_option = click.option(
    "--limit",
    "limits",
    multiple=True,
    metavar="WHAT=SIZE",
    help="Largest motion to fly next: a=50mg, omega=500deg/h, jerk=1m/s^3, alpha=1deg/s^2; of one axis a_z=1mg; "
    "mass=0.5m, speed=0.1m/s: of a body beside the instrument.",
)
_JSON = click.Option(
    ["--json", "json_file"], type=RESULT, metavar="FILE", help="Write the result as JSON (- is stdout)."
)
_REPORT = click.Option(
    ["--report", "report_file"], type=RESULT, metavar="FILE.html", help="Write a self-contained report."
)
_VERBOSE = click.Option(["-v", "--verbose"], is_flag=True, help="Show all details.")


class Command(click.Command):
    """A command that looks at the files to write before it begins; all other paths that it takes are inputs.

    With ``json`` and ``report`` it has these options: :func:`conclude` writes what they ask for.
    """

    def __init__(self, *args: Any, json: bool = True, report: bool = False, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.params += [_JSON] * json + [_REPORT] * report + [_VERBOSE] * json

    def invoke(self, ctx: click.Context) -> Any:
        self._check_outputs(ctx)
        options = ("json_file", "report_file", "verbose")
        ctx.meta[__name__] = {k: ctx.params.pop(k, None) for k in options}
        return super().invoke(ctx)

    def _check_outputs(self, ctx: click.Context) -> None:
        """UserError if a file cannot be written, or is one that the command reads."""
        read: set[str] = set()
        written: list[str] = []
        for p in self.params:
            value = ctx.params.get(p.name or "")
            if isinstance(p.type, click.Path) and value is not None and value not in STDOUT:
                paths = value if isinstance(value, tuple) else (value,)
                if p.type.writable:
                    written += paths
                else:
                    read |= set(map(os.path.realpath, paths))
        for path in map(Path, written):
            place = Path(os.path.realpath(path))
            if str(place) in read or (str(place.parent) in read and place.name in OF_A_MODEL):
                raise UserError(
                    "the result would overwrite what the command reads",
                    where=path,
                    remedy="name another file",
                )
            check_writable(path)


def find_wanted(option: str) -> Any:
    """An option of the running command: ``json_file``, ``report_file`` or ``verbose``."""
    return click.get_current_context().meta[__name__][option]


def load(model_dir: Path) -> Loaded:
    """The model directory; its notes go to stderr."""
    return show_notes(api.load(model_dir), model_dir)


def show_notes(m: Loaded, model_dir: Path) -> Loaded:
    """The same model; its notes go to stderr."""
    for note in m.notes:
        click.echo(one_line(f"note: {model_dir}: {note}"), err=True)
    return m


def read(m: Loaded, flights: Sequence[Path], mapping: Path | None, *, gradient: bool = True) -> list[Flight]:
    """The flights, read and examined."""
    progress.remark(f"reading {count(len(flights), 'flight')}")
    return api.read_flights(m, flights, mapping, gradient=gradient)


def working(text: str, command: str, flights: Sequence[Flight]) -> AbstractContextManager[None]:
    """Report on stderr what is being done, and how far it is."""
    return progress.show_progress(text, command, sum(map(len, flights)))


def make_source(m: Loaded, flights: Sequence[Flight] = (), **fields: Any) -> Source:
    """The source of the running command's result; ``fields``: further fields."""
    return api.Source(command_line(), m, flights, **fields)


def conclude(
    result: Mapping[str, Any],
    sections: Sequence[Section],
    source: Source | None = None,
    page: Callable[[], str] | None = None,
    after: str = "",
) -> None:
    """Write the report and the JSON where they are asked for, and the result to stdout.

    Parameters
    ----------
    result
        The JSON, without what ``source`` adds.
    sections
        The result for the terminal. If JSON goes to stdout, nothing else is written there.
    source
        What it was made from; notes on its flights follow the result.
    page
        Makes the report.
    after
        The command that comes next.
    """
    report, document = find_wanted("report_file"), find_wanted("json_file")
    if report is not None and page is not None:
        progress.remark("writing the report")
        if report in STDOUT:
            click.echo(page(), nl=False)
        else:
            write_text(Path(report), page())
        click.echo(one_line(f"report: {report}"), err=True)
    if document is not None:
        content = {"provenance": provenance(command_line())} | dict(result)
        content |= {} if source is None else source.as_json()
        text = json.dumps(content, indent=1, allow_nan=False)
        if document in STDOUT:
            click.echo(text)
            return
        write_text(Path(document), text + "\n")
    noted = list_notes([] if source is None else source.flights)
    following = [Section(sentences=(f"next: {after}",))] if after else []
    click.echo(render_text([*sections, *following, *noted], verbose=bool(find_wanted("verbose"))))


def list_notes(flights: Sequence[Flight]) -> list[Section]:
    """Notes of the reader, each once with its flights; after the first commands only their number."""
    about = group_notes((x.name, str(note)) for x in flights for note in x.notes)
    lines = []
    for note, names in about.items():
        which = f"{len(names)} flights: " if len(names) > 3 else f"{', '.join(names)}: "
        lines.append(f"note: {which if len(flights) > 1 else ''}{note}")
    if not lines:
        return []
    if click.get_current_context().info_name in SHOW_NOTES:
        return [Section(sentences=tuple(lines))]
    summary = f"{count(len(lines), 'note')} on the flights"
    return [Section("Notes", tuple(lines), detail=True, summary=summary)]


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
