"""The command line, ``ragg``.

Results go to stdout, progress to stderr; the exit status is 0, 1 (a fault of ours) or 2 (bad input).
"""

from __future__ import annotations

import contextlib
import json
import math
import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError, one_line, printable
from ragg_runtime.base.memory import reuse_memory
from ragg_runtime.cli.boundary import hold_streams, refusal
from ragg_runtime.cli.file_commands import convert, map_command, mapping_option
from ragg_runtime.cli.outputs import STDOUT, Command, OutputFile, asked
from ragg_runtime.cli.quality_command import qc

if TYPE_CHECKING:
    from ragg_runtime.workflow.loop import Loaded

F = TypeVar("F", bound=Callable[..., Any])

DIRECTORY = click.Path(path_type=Path)
OUTPUT = OutputFile()
_json = click.option(
    "--json", "json_file", type=OUTPUT, metavar="FILE", help="Write the result as JSON (- is stdout)."
)
_report = click.option(
    "--report", "report_file", type=OUTPUT, metavar="FILE.html", help="Write a self-contained report."
)


class _Finite(click.FloatRange):
    """A number in a range: neither infinite nor none."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        found = super().convert(value, param, ctx)
        if not math.isfinite(found):
            self.fail(f"{value!r} is no finite number", param, ctx)
        return found


class _Group(click.Group):
    command_class = Command


@click.group(cls=_Group, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="ragg", prog_name="ragg")
def cli() -> None:
    """Instrument models of a rotating-accelerometer gravity gradiometer, derived, not typed.

    Compare the model with recorded flights, learn which physical effect it lacks, add it, watch the error
    fall: ragg new, compare, diagnose, add.
    """


def _progress(text: str) -> None:
    click.echo(f"... {text}", err=True)


def _load(model_dir: Path) -> Loaded:
    """The model directory; what is odd about it is told on stderr."""
    from ragg_runtime.workflow import loop

    m = loop.load(model_dir)
    if m.instrument.effects_folder is not None:
        asked().protect(m.instrument.effects_folder.glob("*.py"))
    _notes(model_dir, m.notes)
    return m


def _notes(model_dir: Path, notes: Sequence[str]) -> None:
    for note in notes:
        click.echo(one_line(f"note: {model_dir}: {note}"), err=True)


def _emit(result: dict[str, Any], json_file: str | None, text: str) -> None:
    """Text to stdout, JSON where asked (then stdout is the JSON alone if it is ``-``)."""
    if json_file is not None:
        from ragg_runtime.model_dir.provenance import provenance, versioned

        made = {} if "provenance" in result else {"provenance": provenance(_command())}
        result = versioned(result | made)
    if json_file in STDOUT:
        click.echo(json.dumps(result, indent=1, allow_nan=False))
        return
    if json_file is not None:
        asked().write(json_file, json.dumps(result, indent=1, allow_nan=False) + "\n")
    click.echo(printable(text))


def _write_report(file: str | None, make: Callable[[], str]) -> None:
    if file is not None:
        _progress("writing the report")
        asked().write(file, make())
        click.echo(one_line(f"report: {file}"), err=True)


@contextlib.contextmanager
def _telling() -> Iterator[None]:
    """While a result is told on which the change of a model waits: it must not be lost on the way."""
    try:
        yield
    except OSError as error:
        raise UserError(
            "the result cannot be told, so the model is left as it was",
            where=error.filename or "stdout",
            found=error.strerror,
            remedy="make room, or send the result to another file",
        ) from None


def _command() -> str:
    from ragg_runtime.model_dir.provenance import command

    return command()


@cli.command()
@click.option(
    "--out", type=DIRECTORY, help="Root of the project to write to (default: where ragg is installed)."
)
@click.option("--check", is_flag=True, help="Only say whether the committed code matches the derivation.")
def derive(out: Path | None, check: bool) -> None:
    """Derive all models and generate their code and pages."""
    from derive import everything
    from ragg_runtime.cli.publish import check_settled, publish

    root = out if out is not None else Path(str(everything.__file__)).parents[1]
    if check:
        check_settled(root)
        found, versions = everything.difference(root), everything.about_versions(root)
        if found:
            raise UserError(
                "the committed code does not match the derivation",
                where=root,
                found="\n" + found,
                expected="the same files, byte for byte",
                remedy=versions or "run: make derive   (or: ragg derive), look at the change, and commit it",
            )
        click.echo("The committed code is what the derivation yields, byte for byte.")
        if versions:
            click.echo(
                f"note: it was derived with SymPy {everything.committed_with(root)}, and is the same here"
            )
        return
    changed = publish(root, everything.below(root), whole=(everything.GENERATED,))
    for name in changed:
        click.echo(one_line(f"written: {root / name}"))
    click.echo(f"{len(changed)} files changed." if changed else "Nothing changed: all files are as derived.")


@cli.command()
@click.argument("model_dir", type=DIRECTORY)
@click.option("--from", "source", type=DIRECTORY, metavar="FILE.toml", help="Test sheet to start from.")
@mapping_option
def new(model_dir: Path, source: Path | None, mapping: Path | None) -> None:
    """Make a model directory from a test sheet."""
    from ragg_runtime.workflow import loop

    m = loop.new(model_dir, source, mapping)
    for note in m.notes:
        click.echo(one_line(f"note: {model_dir}: {note}"), err=True)
    place, effects = one_line(str(m.directory.path)), ", ".join(e.id for e in m.model.effects)
    click.echo(f"{place}: made, effects: {effects or 'none'}")
    click.echo(f"Edit {place}/model.toml, then: ragg compare {place} FLIGHT")


@cli.command()
@click.argument("identifier", metavar="[ID]", required=False)
@_json
def effects(identifier: str | None, json_file: str | None) -> None:
    """The catalogue of physical effects; with ID one of them in full."""
    from ragg_runtime.model.catalogue import effects as catalogue
    from ragg_runtime.model.catalogue import in_words

    found = catalogue()
    if identifier is None:
        _emit(found.as_json(), json_file, repr(found))
    else:
        _emit(dict(found[identifier]), json_file, in_words(found[identifier]))


@cli.command()
@click.argument("model_dir", type=DIRECTORY)
@click.argument("flights", type=DIRECTORY, nargs=-1, required=True)
@mapping_option
@click.option("--ladder", is_flag=True, help="Show what each simplification of the model is worth, too.")
@click.option(
    "--frozen", is_flag=True, help="Fit nothing: the parameters as `ragg calibrate --save` kept them."
)
@click.option("--calibration", type=click.Choice(["frozen", "self"]), default="self", hidden=True)
@_json
@_report
def compare(
    model_dir: Path,
    flights: Sequence[Path],
    mapping: Path | None,
    ladder: bool,
    frozen: bool,
    calibration: str,
    json_file: str | None,
    report_file: str | None,
) -> None:
    """How far is the model from the flight, and where does it fail?"""
    from ragg_runtime.cli import terminal
    from ragg_runtime.workflow import loop

    m = _load(model_dir)
    if frozen or calibration == "frozen":
        from ragg_runtime.cli.after import compare_frozen

        compare_frozen(m, flights, json_file, report_file)
        return
    _progress(f"reading {len(flights)} flight(s)")
    read = loop.read_flights(m, flights, mapping)
    _progress("calibrating and comparing")
    with progress.shown("compare", sum(map(len, read))):
        c = loop.compare(m, read, ladder=ladder)

    def page() -> str:
        from ragg_runtime.report import compare_html

        title = f"{m.name} and {', '.join(x.name for x in read)}"
        return compare_html(
            c, title=title, command=_command(), sources=loop.sources(m, read), notes=terminal.notes(m, read)
        )

    _write_report(report_file, page)
    _emit(c.as_json() | terminal.origin(m, read, _command()), json_file, terminal.compared(c, read))


@cli.command()
@click.argument("model_dir", type=DIRECTORY)
@click.argument("flights", type=DIRECTORY, nargs=-1, required=True)
@click.option(
    "--limit",
    "limits",
    multiple=True,
    metavar="WHAT=SIZE",
    help="largest amplitude of a motion to fly next: a=50mg, omega=500deg/h",
)
@mapping_option
@_json
@_report
def diagnose(
    model_dir: Path,
    flights: Sequence[Path],
    mapping: Path | None,
    limits: Sequence[str],
    json_file: str | None,
    report_file: str | None,
) -> None:
    """Which physical effect is missing?"""
    from ragg_runtime.cli import terminal
    from ragg_runtime.workflow import loop

    m = _load(model_dir)
    _progress(f"reading {len(flights)} flight(s)")
    read = loop.read_flights(m, flights, mapping)
    _progress("calibrating, then testing every effect of the catalogue")
    allowed = loop.motion_limits(m, limits)
    with progress.shown("diagnose", sum(map(len, read))):
        d = loop.diagnose(m, read, allowed)

    def page() -> str:
        from ragg_runtime.report import diagnose_html

        title = f"{m.name} and {', '.join(x.name for x in read)}"
        return diagnose_html(
            d, title=title, command=_command(), sources=loop.sources(m, read), notes=terminal.notes(m, read)
        )

    _write_report(report_file, page)
    _emit(
        d.as_json() | terminal.origin(m, read, _command()), json_file, terminal.diagnosed(d, model_dir, read)
    )


@cli.command()
@click.argument("model_dir", type=DIRECTORY)
@click.argument("flights", type=DIRECTORY, nargs=-1, required=True)
@click.option("--jobs", type=click.IntRange(1), help="Processes on this machine (default: one a processor).")
@click.option(
    "--scheduler",
    metavar="tcp://HOST:PORT",
    help="Let the workers of a Dask cluster do it. What answers there can run code here: trusted addresses only, "
    "tls://HOST:PORT beyond your own walls.",
)
@click.option("--tls-ca", type=DIRECTORY, metavar="FILE", help="Of a tls:// scheduler: who signed it (PEM).")
@click.option("--tls-cert", type=DIRECTORY, metavar="FILE", help="Your certificate for it (PEM).")
@click.option("--tls-key", type=DIRECTORY, metavar="FILE", help="The key of your certificate (PEM).")
@click.option(
    "--resume",
    type=DIRECTORY,
    metavar="FILE",
    help="Results file: continue what stands in it, add what is done.",
)
@mapping_option
@_json
@_report
def survey(
    model_dir: Path,
    flights: Sequence[Path],
    mapping: Path | None,
    jobs: int | None,
    scheduler: str | None,
    tls_ca: Path | None,
    tls_cert: Path | None,
    tls_key: Path | None,
    resume: Path | None,
    json_file: str | None,
    report_file: str | None,
) -> None:
    """Diagnose many flights, each by itself, and sum them up."""
    from ragg_runtime.cli import terminal
    from ragg_runtime.report import survey_text as text
    from ragg_runtime.survey import progress
    from ragg_runtime.survey.journal import sha256
    from ragg_runtime.survey.tls import tls_of, unproven
    from ragg_runtime.workflow import loop

    tls = tls_of(tls_ca, tls_cert, tls_key)
    m = _load(model_dir)
    warning = None if scheduler is None else unproven(scheduler)
    if warning is not None:
        click.echo(printable(f"note: {warning}"), err=True)
    with progress.results_file(resume) as file, progress.shown() as show:
        s = loop.survey(
            m,
            flights,
            jobs=jobs,
            scheduler=scheduler,
            tls=tls,
            resume=file,
            progress=show,
            mapping=mapping,
        )
    files = [(r["file"], r["sha256"] if "sha256" in r else sha256(Path(r["file"]))) for r in s.records]
    read = [(r["flight"], digest) for r, (_, digest) in zip(s.records, files, strict=True) if digest]
    sources = [*loop.sources(m, []), *read]

    def page() -> str:
        from ragg_runtime.report.survey_page import survey_html

        title = f"{m.name} and {len(s.records)} flights"
        return survey_html(s, title=title, command=_command(), digest=m.model.digest, sources=sources)

    _write_report(report_file, page)
    origin = terminal.origin(m, [], _command(), files=files)
    origin |= {"sources": [{"name": n, "sha256": d} for n, d in sources]}
    _emit(s.as_json() | origin, json_file, text.surveyed(s, model_dir))


@cli.command()
@click.argument("model_dir", type=DIRECTORY)
@click.argument("effect")
@click.argument("flights", type=DIRECTORY, nargs=-1)
@mapping_option
@_json
@_report
def add(
    model_dir: Path,
    effect: str,
    flights: Sequence[Path],
    mapping: Path | None,
    json_file: str | None,
    report_file: str | None,
) -> None:
    """Put an effect into the model, derive again, calibrate, show the error fall."""
    from ragg_runtime.cli import terminal
    from ragg_runtime.workflow import loop

    m = _load(model_dir)
    if report_file is not None and not flights:
        raise UserError("a report of `add` needs a flight", remedy="name a flight file after the effect")
    _progress(f"reading {len(flights)} flight(s)")
    read = loop.read_flights(m, flights, mapping)
    _progress(f"deriving the model with {effect}, calibrating")

    def tell(result: loop.Added) -> None:
        def page() -> str:
            from ragg_runtime.report import add_html

            assert result.before is not None
            assert result.after is not None
            return add_html(
                [s.as_json() for s in result.loaded.directory.history],
                result.before,
                result.after,
                title=f"{m.name}: {effect} added",
                command=_command(),
                sources=loop.sources(result.loaded, read),
                notes=terminal.notes(result.loaded, read),
            )

        with _telling():
            _write_report(report_file, page)
            origin = terminal.origin(result.loaded, read, _command(), before=m)
            _emit(result.as_json() | origin, json_file, terminal.added(result, read))

    with progress.shown("add", sum(map(len, read))):
        result = loop.add(m, effect, read, tell)
    if not result.converged:
        asked().place()  # report and JSON say why; they are the result
        raise UserError(
            "nothing was added: the model is as it was",
            where=", ".join(x.name for x in read),
            found=result.after.complaint if result.after else None,
            remedy="see what else is missing: ragg diagnose; or what is wrong with the record",
        )


@cli.command()
@click.argument("model_dir", type=DIRECTORY)
@click.argument("effect")
@_json
def remove(model_dir: Path, effect: str, json_file: str | None) -> None:
    """Take an effect out of the model."""
    from ragg_runtime.cli import terminal
    from ragg_runtime.workflow import loop

    before = _load(model_dir)

    def tell(m: Loaded) -> None:
        left = [e.id for e in m.model.effects]
        with _telling():
            _emit(
                {"effect": effect, "effects": left} | terminal.origin(m, (), _command(), before=before),
                json_file,
                f"removed {effect}; effects left: {', '.join(left) or 'none'}",
            )

    loop.remove(before, effect, tell)


@cli.command()
@click.argument("model_dir", type=DIRECTORY)
@click.option("--list", "only_list", is_flag=True, help="Only say what would be executed.")
@click.option("--forget", is_flag=True, help="Trust these files no longer.")
def trust(model_dir: Path, only_list: bool, forget: bool) -> None:
    """Let the Python files of the model's effects_folder be executed, exactly as they are now.

    Without this none is: read them first. MODEL_DIR may be a model.toml as well.
    """
    from ragg_runtime.instrument.read_toml import read_instrument
    from ragg_runtime.model_dir import trust as _trust
    from ragg_runtime.model_dir.directory import load_model_dir

    is_file = model_dir.is_file()
    instrument = read_instrument(model_dir) if is_file else load_model_dir(model_dir).instrument
    if instrument.effects_folder is None:
        raise UserError(
            "the model names no effects_folder", where=model_dir, remedy="there is nothing to trust"
        )
    found = _trust.read_effects(instrument.effects_folder)
    for line in found.lines():
        click.echo(line)
    if forget:
        was = _trust.forget(found)
        click.echo("No longer on the list of trusted files." if was else "They were not on the list.")
    elif only_list:
        click.echo(f"{'On' if _trust.is_trusted(found) else 'Not on'} the list of trusted files.")
    else:
        place = one_line(str(_trust.trust(found)))
        click.echo(f"They will be executed as long as they stay as they are; written to {place}")


@cli.command()
@click.argument("model_dir", type=DIRECTORY)
@click.option("--look", is_flag=True, help="Change nothing.")
def doctor(model_dir: Path, look: bool) -> None:
    """What is damaged in a model directory; what can be mended without loss, is."""
    from ragg_runtime.model_dir.doctor import examined

    found = examined(model_dir, mend=not look)
    for f in found:
        click.echo(printable(f"{f.what}\n  -> {f.way_back}" if f.way_back else f.what))
    if any(f.open for f in found):
        sys.exit(2)
    click.echo(f"{one_line(str(model_dir))}: {'mended' if found else 'in order'}")


@cli.command()
@click.argument("model_dir", type=DIRECTORY, required=False)
def build(model_dir: Path | None) -> None:
    """Compile the model's C beforehand (otherwise on first use); without MODEL_DIR, the paper's model."""
    from ragg_runtime.model import native
    from ragg_runtime.model.model import packaged

    model = packaged() if model_dir is None else _load(model_dir).model
    try:
        made = native.build(model.sources)
    except native.BuildError as error:
        raise UserError(
            "the model cannot be compiled", where=model_dir, found=error, remedy="without it NumPy serves"
        ) from None
    click.echo(f"{made.library}: {'compiled' if made.fresh else 'there already'}\n{made.command}")


@cli.command()
@click.argument("model_dir", type=DIRECTORY)
@_json
def history(model_dir: Path, json_file: str | None) -> None:
    """The error after every step."""
    from ragg_runtime.cli import terminal
    from ragg_runtime.model_dir.directory import load_model_dir
    from ragg_runtime.model_dir.provenance import provenance

    directory = load_model_dir(model_dir)
    _notes(model_dir, directory.notes)
    steps = [s.as_json() for s in directory.history]
    made = provenance(_command(), directory)
    _emit({"steps": steps, "provenance": made}, json_file, terminal.history(steps))


@cli.command()
@click.argument("model_dir", type=DIRECTORY)
@click.option(
    "-o",
    "--output",
    type=OUTPUT,
    required=True,
    metavar="FLIGHT",
    help="File to write (.csv, .parquet, .nc).",
)
@click.option(
    "--effect",
    "hidden",
    multiple=True,
    metavar="ID:NAME=VALUE[,NAME=...]",
    help="Hide an effect in the flight; VALUE in the effect's units, four values joined by /.",
)
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True)
@click.option("--duration", type=_Finite(1.0), default=1800.0, show_default=True, help="s")
@click.option("--rate", type=_Finite(1.0), default=16.0, show_default=True, help="Hz")
@click.option("--noise", type=_Finite(0.0), default=2.0, show_default=True, help="Eo/sqrt(Hz)")
@click.option(
    "--shape", type=click.Choice(["flat", "dryden", "kolmogorov", "resonant"]), help="Spectrum of the motion."
)
@click.option("--sheet-error", type=_Finite(0.0), default=1.0, show_default=True,
              help="How far the true instrument lies from the test sheet (0: not at all).")  # fmt: skip
@click.option(
    "--motion", type=DIRECTORY, metavar="FILE", help="Fly this motion (a flight file; its length and rate)."
)
@click.option("--no-gradient", is_flag=True, help="Leave the gravity gradient unrecorded.")
@click.option("--voltages", is_flag=True, help="Record V_1 ... V_4 too.")
def simulate(model_dir: Path, output: str, hidden: Sequence[str], **options: Any) -> None:
    """A flight from the numerical reference, with hidden effects on request."""
    from ragg_runtime.flight import write_flight
    from ragg_runtime.workflow.simulate import simulated

    m = _load(model_dir)
    _progress("flying")
    flight = simulated(m.instrument, hidden, **options)
    write_flight(flight, output)
    click.echo(f"{one_line(str(output))}: {len(flight.time)} samples at {flight.rate:g} Hz")


@cli.command()
@click.option(
    "--output", type=DIRECTORY, default=Path("ragg-demo"), show_default=True, help="Folder to make."
)
def demo(output: Path) -> None:
    """The main job on a simulated flight: find a hidden effect, add it, watch the error fall."""
    from ragg_runtime.cli import demo as _demo

    _demo.main(output, command=_command())


cli.add_command(convert)
cli.add_command(map_command)
cli.add_command(qc)


def main(arguments: Sequence[str] | None = None) -> None:
    """Entry point: never a traceback for bad input."""
    hold_streams()
    try:
        from ragg_runtime.cli import after
        from ragg_runtime.cli.next_motion_command import next_motion
        from ragg_runtime.experiments.command import experiment
        from ragg_runtime.studio.command import studio

        for command in (experiment, studio, next_motion, *after.COMMANDS):
            cli.add_command(command)
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
