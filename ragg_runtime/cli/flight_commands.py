"""Commands that hold a model against flights: ``ragg compare``, ``diagnose``, ``add``, ``survey``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError, printable
from ragg_runtime.cli import shared
from ragg_runtime.cli.shared import (
    DIRECTORY,
    Command,
    Finite,
    OutputFile,
    about,
    asked,
    command_line,
    emit,
    json_option,
    load,
    mapping_option,
    report_option,
    series_option,
    telling,
    under_way,
    write_report,
)

if TYPE_CHECKING:
    from ragg_runtime.workflow.loop import Added, Loaded


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.argument("flights", type=DIRECTORY, nargs=-1, required=True)
@mapping_option
@click.option("--ladder", is_flag=True, help="Show what each simplification of the model is worth, too.")
@click.option(
    "--frozen", is_flag=True, help="Fit nothing: the parameters as `ragg calibrate --save` kept them."
)
@click.option("--calibration", type=click.Choice(["frozen", "self"]), default="self", hidden=True)
@json_option
@report_option
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
    from ragg_runtime.report import in_words
    from ragg_runtime.workflow import loop

    m = load(model_dir)
    if frozen or calibration == "frozen":
        compare_frozen(m, flights, mapping, json_file, report_file)
        return
    under_way(f"reading {len(flights)} flight(s)")
    read = loop.read_flights(m, flights, mapping)
    under_way("calibrating and comparing")
    with progress.shown("compare", sum(map(len, read))):
        c = loop.compare(m, read, ladder=ladder)

    def page() -> str:
        from ragg_runtime.report.compare_page import compare_html

        return compare_html(c, **about(m, read))

    write_report(report_file, page)
    emit(
        c.as_json() | loop.origin(m, read, command_line()),
        json_file,
        terminal.with_notes(
            in_words.compared(
                c, [x.name for x in read], terminal.command("diagnose", model_dir, read, mapping)
            ),
            read,
        ),
    )


@click.command(cls=Command)
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
@json_option
@report_option
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
    from ragg_runtime.report import in_words
    from ragg_runtime.workflow import loop

    m = load(model_dir)
    under_way(f"reading {len(flights)} flight(s)")
    read = loop.read_flights(m, flights, mapping)
    under_way("calibrating, then testing every effect of the catalogue")
    allowed = loop.motion_limits(m, limits)
    with progress.shown("diagnose", sum(map(len, read))):
        d = loop.diagnose(m, read, allowed)

    def page() -> str:
        from ragg_runtime.report.diagnose_page import diagnose_html

        return diagnose_html(d, **about(m, read))

    write_report(report_file, page)
    emit(
        d.as_json() | loop.origin(m, read, command_line()),
        json_file,
        terminal.with_notes(
            in_words.diagnosed(d, terminal.next_add(model_dir, read, mapping, d.found)), read
        ),
    )


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.argument("flights", type=DIRECTORY, nargs=-1, required=True)
@click.option(
    "--jobs", type=click.IntRange(1), help="Processes on this machine (default: one per processor)."
)
@click.option(
    "--scheduler",
    metavar="tcp://HOST:PORT",
    help="Let the workers of a Dask cluster do it. What answers there can run code here: trusted addresses only.",
)
@click.option(
    "--resume",
    type=DIRECTORY,
    metavar="FILE",
    help="Results file: continue what stands in it, add what is done.",
)
@click.option(
    "--table",
    "table_file",
    type=OutputFile(records=True),
    metavar="FILE.parquet",
    help="Write a table with a row a flight.",
)
@mapping_option
@json_option
@report_option
def survey(
    model_dir: Path,
    flights: Sequence[Path],
    mapping: Path | None,
    jobs: int | None,
    scheduler: str | None,
    resume: Path | None,
    table_file: str | None,
    json_file: str | None,
    report_file: str | None,
) -> None:
    """Diagnose many flights, each by itself, and sum them up."""
    from ragg_runtime.report import survey_text as text
    from ragg_runtime.survey import run
    from ragg_runtime.survey.result import check_place
    from ragg_runtime.workflow import loop
    from ragg_runtime.workflow.loop import of_survey

    m = load(model_dir)
    if table_file is not None:
        check_place(Path(table_file))
    with run.results_file(resume) as file, run.shown() as show:
        s = loop.survey(
            m,
            flights,
            jobs=jobs,
            scheduler=scheduler,
            resume=file,
            progress=show,
            mapping=mapping,
        )
    origin, about_page = of_survey(m, s, command_line())

    def page() -> str:
        from ragg_runtime.report.survey_page import survey_html

        return survey_html(s, **about_page)

    if table_file is not None:
        from ragg_runtime.survey.result import parquet

        asked().write(table_file, parquet(s.records))
    write_report(report_file, page)
    emit(s.as_json() | origin, json_file, text.surveyed(s, model_dir))


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.argument("effect", shell_complete=shared.addable)
@click.argument("flights", type=DIRECTORY, nargs=-1)
@mapping_option
@json_option
@report_option
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

    m = load(model_dir)
    if report_file is not None and not flights:
        raise UserError("a report of `add` needs a flight", remedy="name a flight file after the effect")
    under_way(f"reading {len(flights)} flight(s)")
    read = loop.read_flights(m, flights, mapping)
    under_way(f"deriving the model with {effect}, calibrating")

    def tell(result: Added) -> None:
        def page() -> str:
            from ragg_runtime.report.add_page import add_html

            assert result.before is not None
            assert result.after is not None
            return add_html(
                [s.as_json() for s in result.loaded.directory.history],
                result.before,
                result.after,
                **about(result.loaded, read, f"{m.name}: {effect} added"),
            )

        with telling():
            write_report(report_file, page)
            origin = loop.origin(result.loaded, read, command_line(), before=m)
            emit(result.as_json() | origin, json_file, terminal.added(result, read, mapping))

    with progress.shown("add", sum(map(len, read))):
        result = loop.add(m, effect, read, tell)
    if not result.converged:
        asked().place()  # report and JSON say why; they are the result
        raise UserError(
            "nothing was added: the model is as it was",
            where=", ".join(x.name for x in read),
            found=result.after.complaint if result.after else None,
            remedy=f"see what else is missing: {terminal.command('diagnose', model_dir, read, mapping)}; "
            "or what is wrong with the record",
        )


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.argument("flights", type=DIRECTORY, nargs=-1, required=True)
@click.option(
    "--save",
    is_flag=True,
    help="Keep the calibration (and the mapping, if one is given) in the model directory, for --frozen.",
)
@mapping_option
@json_option
def calibrate(
    model_dir: Path, flights: Sequence[Path], save: bool, mapping: Path | None, json_file: str | None
) -> None:
    """Fit the model's parameters: values, how sure they are, what the record sees of them."""
    from ragg_runtime.cli import terminal
    from ragg_runtime.workflow import after, loop

    m = load(model_dir)
    under_way(f"reading {len(flights)} flight(s)")
    read = loop.read_flights(m, flights, mapping)
    under_way("calibrating")
    with progress.shown("compare", sum(map(len, read))):
        kept = after.calibrate(m, read, save, mapping)
    origin = loop.origin(kept.loaded, read, command_line())
    emit(kept.as_json() | origin, json_file, terminal.calibrated(kept, read))


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.argument("flights", type=DIRECTORY, nargs=-1, required=True)
@series_option
@click.option(
    "--calibration",
    type=click.Choice(["frozen", "self", "crossed", "online"]),
    default="self",
    show_default=True,
    help="As saved; fitted to these flights; each block of time fitted to all others; sample by sample, as a computer on "
    "board would (`export --c`: the same filter in C).",
)
@click.option(
    "--demodulator",
    type=click.Choice(["fir", "butterworth", "causal"]),
    default="fir",
    show_default=True,
    help="FIR 0.2 Hz; order 6, 0.18 Hz, forward and backward; the same forward alone.",
)
@click.option(
    "--noise",
    type=Finite(0.0, min_open=True),
    help="online: Eo/sqrt(Hz), cross channel (default: what the saved calibration left).",
)
@click.option(
    "--walk",
    type=Finite(0.0),
    help="online: how fast the gradient may wander, Eo/sqrt(s) (default: as fast as a low-pass of 0.2 Hz follows it).",
)
@click.option(
    "--forget",
    type=Finite(0.0, min_open=True),
    help="online: time constant, s, of what is forgotten (default: nothing).",
)
@mapping_option
@json_option
def compensate(
    model_dir: Path,
    flights: Sequence[Path],
    output: str,
    calibration: Literal["frozen", "self", "crossed", "online"],
    demodulator: str,
    noise: float | None,
    walk: float | None,
    forget: float | None,
    mapping: Path | None,
    json_file: str | None,
) -> None:
    """The gravity gradient as the instrument saw it: all removed that the model explains, demodulated."""
    from ragg_runtime.cli import terminal
    from ragg_runtime.report import in_words
    from ragg_runtime.workflow import after, loop

    out = Path(output)
    after.check_output(out)
    if calibration != "online" and any(x is not None for x in (noise, walk, forget)):
        raise UserError(
            "--noise, --walk and --forget are of the recursive filter", expected="--calibration online"
        )
    m = load(model_dir)
    kept = calibration == "frozen" or (calibration == "online" and m.directory.calibration is not None)
    odd = _calibration_notes(m) if kept else []
    under_way(f"reading {len(flights)} flight(s)")
    read = after.read_for_compensation(m, flights, mapping)
    under_way(
        {"frozen": "compensating", "online": "following"}.get(calibration, "calibrating and compensating")
    )
    with progress.shown("compare", sum(map(len, read))):
        c = after.compensate(
            m, read, calibration, demodulator, out, noise=noise, walk=walk, forget=forget or float("inf")
        )
    result = c.as_json()
    notes = [*result.get("notes", ()), *odd, *loop.notes(m, read)]
    origin = loop.origin(m, read, command_line()) | {"notes": notes}
    emit(
        result | {"output": str(out)} | origin,
        json_file,
        terminal.with_notes(
            (in_words.watched if calibration == "online" else in_words.compensated)(result, out), read
        ),
    )


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.argument("folder", type=DIRECTORY, metavar="DIR")
@click.option(
    "--c", "form", flag_value="c", help="A C17 program: make -C DIR; ragg_model < MOTION.csv > OUT.csv."
)
@click.option("--numpy", "form", flag_value="numpy", help="A folder that runs with NumPy alone.")
@click.option(
    "--json", "form", flag_value="json", help="One document: description, parameters with units, an example."
)
@click.option(
    "--harmonics",
    "form",
    flag_value="harmonics",
    help="Outputs as harmonics of the disc's angle: LaTeX and NumPy, without effects.",
)
def export(model_dir: Path, folder: Path, form: str | None) -> None:
    """The model with its values, to run elsewhere: those of `calibrate --save`, else of model.toml."""
    from ragg_runtime.workflow import after

    if form is None:
        raise UserError(
            "say what to export",
            expected="--c, --numpy, --json or --harmonics",
            remedy="see: ragg export --help",
        )
    exported = after.contents(load(model_dir))
    for place in after.written(exported, folder, form):
        click.echo(f"written: {place}")
    click.echo("\n".join([f"with {exported.origin}", *exported.limits()]))


def compare_frozen(
    m: Loaded,
    flights: Sequence[Path],
    mapping: Path | None,
    json_file: str | None,
    report_file: str | None,
) -> None:
    """``ragg compare --frozen``."""
    from ragg_runtime.cli import terminal
    from ragg_runtime.report import in_words
    from ragg_runtime.workflow import after, loop

    odd = _calibration_notes(m)
    under_way(f"reading {len(flights)} flight(s)")
    read = loop.read_flights(m, flights, mapping)
    under_way("comparing with the calibration that was kept")
    with progress.shown("compare", sum(map(len, read))):
        h = after.compare_frozen(m, read)

    def page() -> str:
        from ragg_runtime.report.compare_page import compare_html

        own = about(m, read, f"{m.name}, frozen, and {', '.join(x.name for x in read)}")
        return compare_html(h.comparison, **own | {"notes": [h.in_words(), *odd, *own["notes"]], "frozen": h})

    write_report(report_file, page)
    origin = loop.origin(m, read, command_line())
    then = [terminal.command(verb, m.directory.path, read, mapping) for verb in ("diagnose", "calibrate")]
    emit(
        h.as_json() | origin | {"notes": [*odd, *loop.notes(m, read)]},
        json_file,
        terminal.with_notes(in_words.held(h, [x.name for x in read], *then), read),
    )


def _calibration_notes(m: Loaded) -> list[str]:
    """What is odd about the saved calibration, told on stderr as well."""
    from ragg_runtime.workflow import after

    odd = after.calibration_notes(m)
    for note in odd:
        click.echo(printable(f"note: {note}"), err=True)
    return odd


@click.command("next-motion", cls=Command)
@click.argument("model_dir", type=click.Path(path_type=Path))
@click.argument("flights", type=click.Path(path_type=Path), nargs=-1, required=True)
@click.option(
    "-o",
    "--output",
    type=OutputFile(records=True),
    required=True,
    metavar="MOTION",
    help="Motion file to write.",
)
@click.option(
    "--limit",
    "limits",
    multiple=True,
    metavar="WHAT=SIZE",
    help="a=50mg, omega=500deg/h; rates of change: jerk=1m/s^3, alpha=1deg/s^2.",
)
@click.option(
    "--band",
    type=float,
    nargs=2,
    default=None,
    metavar="LOW HIGH",
    help="Hz (default: all that the rate holds).",
)
@click.option("--duration", type=click.FloatRange(60.0, 86400.0), default=600.0, show_default=True, help="s")
@click.option("--rate", type=click.FloatRange(1.0, 1000.0), default=None, help="Hz (default: the flights').")
@mapping_option
@click.option(
    "--json", "json_file", type=OutputFile(), metavar="FILE", help="Write the result as JSON (- is stdout)."
)
def next_motion(
    model_dir: Path,
    flights: Sequence[Path],
    output: str,
    limits: Sequence[str],
    mapping: Path | None,
    json_file: str | None,
    **options: Any,
) -> None:
    """Which flight next: a motion that tells apart the effects that these flights cannot."""
    from ragg_runtime.cli.shared import emit, load
    from ragg_runtime.workflow import loop
    from ragg_runtime.workflow.next_flight import next_flight, write_motion

    m = load(model_dir)
    read = loop.read_flights(m, flights, mapping)
    found = next_flight(m, read, loop.motion_limits(m, limits), **options)
    write_motion(found, Path(output))
    emit(found.as_json(), json_file, f"{output}: {found.in_words()}")
