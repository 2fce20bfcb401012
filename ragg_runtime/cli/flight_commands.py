"""Commands that hold a model against flights: ``ragg compare``, ``diagnose``, ``add``, ``survey``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError
from ragg_runtime.cli import completion
from ragg_runtime.cli.file_commands import mapping_option
from ragg_runtime.cli.outputs import Command, OutputFile, asked
from ragg_runtime.cli.shared import (
    DIRECTORY,
    about,
    command_line,
    emit,
    json_option,
    load,
    report_option,
    telling,
    under_way,
    write_report,
)

if TYPE_CHECKING:
    from ragg_runtime.workflow import loop


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
    from ragg_runtime.workflow import origin as made_from

    m = load(model_dir)
    if frozen or calibration == "frozen":
        from ragg_runtime.cli.after import compare_frozen

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
        c.as_json() | made_from.origin(m, read, command_line()),
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
    from ragg_runtime.workflow import origin as made_from

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
        d.as_json() | made_from.origin(m, read, command_line()),
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
    from ragg_runtime.survey import progress
    from ragg_runtime.survey.table import check_place
    from ragg_runtime.workflow import loop
    from ragg_runtime.workflow.origin import of_survey

    m = load(model_dir)
    if table_file is not None:
        check_place(Path(table_file))
    with progress.results_file(resume) as file, progress.shown() as show:
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
        from ragg_runtime.survey.table import parquet

        asked().write(table_file, parquet(s.records))
    write_report(report_file, page)
    emit(s.as_json() | origin, json_file, text.surveyed(s, model_dir))


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.argument("effect", shell_complete=completion.addable)
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
    from ragg_runtime.workflow import origin as made_from

    m = load(model_dir)
    if report_file is not None and not flights:
        raise UserError("a report of `add` needs a flight", remedy="name a flight file after the effect")
    under_way(f"reading {len(flights)} flight(s)")
    read = loop.read_flights(m, flights, mapping)
    under_way(f"deriving the model with {effect}, calibrating")

    def tell(result: loop.Added) -> None:
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
            origin = made_from.origin(result.loaded, read, command_line(), before=m)
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
