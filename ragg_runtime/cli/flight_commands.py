"""Commands that compare a model with flights, and what comes after: calibration, compensation, export."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError, printable
from ragg_runtime.cli import shared
from ragg_runtime.cli.shared import (
    PLACE,
    Command,
    Finite,
    OutputFile,
    command_line,
    conclude,
    flights_argument,
    limit_option,
    load,
    mapping_option,
    model_argument,
    next_command,
    origin_of,
    read,
    series_option,
    under_way,
)

if TYPE_CHECKING:
    from ragg_runtime.api import Added, Loaded
    from ragg_runtime.identification.motion_design import Criterion
    from ragg_runtime.next_flight import NextFlight


@click.command(cls=Command, report=True)
@model_argument
@flights_argument
@mapping_option
@click.option("--ladder", is_flag=True, help="Show what each simplification of the model costs, too.")
@click.option("--calibration", type=click.Choice(["frozen", "self"]), default="self", show_default=True,
              help="As `ragg calibrate --save` kept it; fitted to these flights.")  # fmt: skip
@click.option("--frozen", is_flag=True, help="The same as --calibration frozen.")
def compare(
    model_dir: Path,
    flights: Sequence[Path],
    mapping: Path | None,
    ladder: bool,
    calibration: str,
    frozen: bool,
) -> None:
    """Show how far the model is from flights, and where."""
    from ragg_runtime import api
    from ragg_runtime.wording import describe

    m = load(model_dir)
    if frozen or calibration == "frozen":
        _compare_frozen(m, flights, mapping)
        return
    records = read(m, flights, mapping)
    under_way("calibrating and comparing")
    with progress.shown("compare", sum(map(len, records))):
        c = api.compare(m, records, ladder=ladder)

    def page() -> str:
        from ragg_runtime.report.pages import compare_page

        return compare_page(c, origin_of(m, records))

    result = c.as_json()
    then = next_command("diagnose", model_dir, records, mapping)
    said = describe.describe_comparison(result, [x.name for x in records], then)
    conclude(result | api.origin(m, records, command_line()), said, page, records)


def _compare_frozen(m: Loaded, flights: Sequence[Path], mapping: Path | None) -> None:
    """``ragg compare --frozen``."""
    from ragg_runtime import api
    from ragg_runtime.wording import describe

    odd = _calibration_notes(m)
    records = read(m, flights, mapping)
    under_way("comparing with the saved calibration")
    with progress.shown("compare", sum(map(len, records))):
        h = api.compare_frozen(m, records)

    def page() -> str:
        from ragg_runtime.report.pages import compare_page

        title = f"{m.name}, frozen, and {', '.join(x.name for x in records)}"
        return compare_page(h.comparison, origin_of(m, records, title, odd), h)

    result = h.as_json()
    then, again = (next_command(v, m.directory.path, records, mapping) for v in ("diagnose", "calibrate"))
    said = describe.describe_held(result, [x.name for x in records], then, again)
    origin = api.origin(m, records, command_line()) | {"notes": [*odd, *api.notes(m, records)]}
    conclude(result | origin, said, page, records)


def _calibration_notes(m: Loaded) -> list[str]:
    """What is odd about the saved calibration, also on stderr."""
    from ragg_runtime import api

    odd = api.calibration_notes(m)
    for note in odd:
        click.echo(printable(f"note: {note}"), err=True)
    return odd


@click.command(cls=Command, report=True)
@model_argument
@flights_argument
@limit_option
@mapping_option
def diagnose(model_dir: Path, flights: Sequence[Path], limits: Sequence[str], mapping: Path | None) -> None:
    """Find which physical effect is missing."""
    from ragg_runtime import api
    from ragg_runtime.wording import describe

    m = load(model_dir)
    allowed = api.motion_limits(m, limits)
    records = read(m, flights, mapping)
    under_way("calibrating, then testing every effect of the catalogue")
    with progress.shown("diagnose", sum(map(len, records))):
        d = api.diagnose(m, records, allowed)

    def page() -> str:
        from ragg_runtime.report.pages import diagnose_page

        return diagnose_page(d, origin_of(m, records))

    result = d.as_json()
    then = next_command("add", model_dir, records, mapping, d.found[0]) if d.found else ""
    conclude(
        result | api.origin(m, records, command_line()),
        describe.describe_diagnosis(result, then),
        page,
        records,
    )


@click.command(cls=Command, report=True)
@model_argument
@click.argument("effect", shell_complete=shared.complete_addable)
@click.argument("flights", type=PLACE, nargs=-1)
@mapping_option
def add(model_dir: Path, effect: str, flights: Sequence[Path], mapping: Path | None) -> None:
    """Add an effect: derive again, calibrate, show the error."""
    from ragg_runtime import api
    from ragg_runtime.wording import describe

    m = load(model_dir)
    if shared.running().report_file is not None and not flights:
        raise UserError("a report of `add` needs a flight", remedy="name a flight file after the effect")
    records = read(m, flights, mapping) if flights else []
    under_way(f"deriving the model with {effect}{', calibrating' if flights else ''}")

    def tell(result: Added) -> None:
        def page() -> str:
            from ragg_runtime.report.pages import add_page

            assert result.before is not None
            assert result.after is not None
            steps = [s.as_json() for s in result.loaded.directory.history]
            origin = origin_of(result.loaded, records, f"{m.name}: {effect} added")
            return add_page(steps, result.before, result.after, origin)

        found = result.as_json()
        then = next_command("diagnose", m.directory.path, records, mapping)
        said = describe.describe_addition(found, [e.id for e in result.loaded.model.effects], then)
        with shared.before_change():
            origin = api.origin(result.loaded, records, command_line(), before=m)
            conclude(found | origin, said, page, records)

    with progress.shown("add", sum(map(len, records))):
        result = api.add(m, effect, records, tell)
    if not result.converged:
        shared.running().place()  # report and JSON say why; they are the result
        raise UserError(
            "nothing was added: the model is as it was",
            where=", ".join(x.name for x in records),
            found=result.after.complaint if result.after else None,
            remedy=f"see what else is missing: {next_command('diagnose', model_dir, records, mapping)}; "
            "or what is wrong with the record",
        )


@click.command("next-motion", cls=Command, report=True)
@model_argument
@flights_argument
@click.option(
    "-o",
    "--output",
    type=OutputFile(records=True),
    required=True,
    metavar="MOTION",
    help="Motion file to write.",
)
@limit_option
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
@click.option("--for", "purpose", type=click.Choice(["effects", "calibration"]), default="effects", show_default=True,
              help="Separate effects, or calibrate what the compensated channels need.")  # fmt: skip
@click.option("--criterion", type=click.Choice(["A", "D"]), default="A", show_default=True,
              help="calibration: least mean variance of the channels, or least volume.")  # fmt: skip
@click.option("--run-sheet", type=OutputFile(), metavar="FILE.md",
              help="calibration: what whoever flies it reads.")  # fmt: skip
@mapping_option
def next_motion(
    model_dir: Path,
    flights: Sequence[Path],
    output: str,
    limits: Sequence[str],
    purpose: str,
    criterion: Criterion,
    run_sheet: str | None,
    mapping: Path | None,
    **options: Any,
) -> None:
    """Design the motion to fly next.

    The motion separates effects that these flights cannot distinguish, or calibrates best.
    """
    from ragg_runtime import api
    from ragg_runtime.next_flight import calibration_flight, next_flight, write_motion
    from ragg_runtime.wording import describe_other

    if run_sheet is not None and purpose != "calibration":
        raise UserError("a run sheet is of a calibration", where="--run-sheet", expected="--for calibration")
    m = load(model_dir)
    records, most = read(m, flights, mapping), api.motion_limits(m, limits)
    found: NextFlight
    if purpose == "calibration":
        found = planned = calibration_flight(m, records, most, criterion=criterion, **options)
        if run_sheet is not None:
            shared.running().write(run_sheet, planned.run_sheet())
    else:
        found = next_flight(m, records, most, **options)
    write_motion(found, Path(output))
    said = describe_other.describe_next_motion(found.as_json(), output)

    def page() -> str:
        from ragg_runtime.report.pages import info_page

        return info_page(said, [found.motion()], origin_of(m, records))

    conclude(found.as_json() | api.origin(m, records, command_line()), said, page)


@click.command(cls=Command, report=True)
@model_argument
@flights_argument
@click.option("--save", is_flag=True,
              help="Keep the calibration (and a mapping that is given) in the model directory, for --frozen.")  # fmt: skip
@click.option("--plan", type=PLACE, metavar="PLAN.json",
              help="Certify each parameter against a plan of next-motion --for calibration.")  # fmt: skip
@click.option("--drift", is_flag=True, help="Follow the parameters that drift through the flights.")
@mapping_option
def calibrate(
    model_dir: Path,
    flights: Sequence[Path],
    save: bool,
    plan: Path | None,
    drift: bool,
    mapping: Path | None,
) -> None:
    """Fit the parameters, with their uncertainty."""
    from ragg_runtime import api
    from ragg_runtime.next_flight import certify, read_plan
    from ragg_runtime.wording import describe_other

    m = load(model_dir)
    planned = None if plan is None else read_plan(plan)
    records = read(m, flights, mapping)
    under_way("calibrating")
    with progress.shown("compare", sum(map(len, records))):
        kept = api.calibrate(m, records, save, mapping, drift=drift)
    use = f"{next_command('compensate', m.directory.path, records)} -o compensated.csv --calibration frozen"
    found = kept.as_json()
    if planned is not None:
        found["certificate"] = certify(planned, found["parameters"])
    said = describe_other.describe_calibration(found, [x.name for x in records], use if kept.saved else "")

    def page() -> str:
        from ragg_runtime.report.pages import calibrate_page

        return calibrate_page(said, kept.calibrated.fitted, origin_of(m, records))

    conclude(found | api.origin(kept.loaded, records, command_line()), said, page, records)


@click.command(cls=Command, report=True)
@model_argument
@flights_argument
@series_option
@click.option(
    "--calibration",
    type=click.Choice(["frozen", "self", "crossed", "smoothed", "online"]),
    default="self",
    show_default=True,
    help="As `ragg calibrate --save` kept it; fitted to these flights; each block of time fitted to all others; drifting "
    "from block to block; sample by sample, as on board (`export --c` is the same filter in C).",
)
@click.option("--frozen", is_flag=True, help="The same as --calibration frozen.")
@click.option(
    "--demodulator",
    type=click.Choice(["fir", "butterworth", "causal"]),
    default="fir",
    show_default=True,
    help="FIR 0.2 Hz; order 6, 0.18 Hz, forward and backward; the same forward alone.",
)
@click.option("--noise", type=Finite(0.0, min_open=True),
              help="online: Eo/sqrt(Hz) of the cross channel (default: from the saved calibration).")  # fmt: skip
@click.option("--walk", type=Finite(0.0),
              help="online: how fast the gradient may wander, Eo/sqrt(s) (default: as a low-pass of 0.2 Hz).")  # fmt: skip
@click.option("--forget", type=Finite(0.0, min_open=True),
              help="online: time constant of forgetting, s (default: nothing is forgotten).")  # fmt: skip
@mapping_option
def compensate(
    model_dir: Path,
    flights: Sequence[Path],
    output: str,
    calibration: Literal["frozen", "self", "crossed", "smoothed", "online"],
    frozen: bool,
    demodulator: str,
    noise: float | None,
    walk: float | None,
    forget: float | None,
    mapping: Path | None,
) -> None:
    """Remove modelled motion errors, demodulate.

    The result is the gravity gradient as the instrument saw it, with its uncertainty.
    """
    from ragg_runtime import api
    from ragg_runtime.wording import describe_other

    out = Path(output)
    api.check_output(out)
    calibration = "frozen" if frozen else calibration
    if calibration != "online" and any(x is not None for x in (noise, walk, forget)):
        raise UserError(
            "--noise, --walk and --forget are of the recursive filter", expected="--calibration online"
        )
    m = load(model_dir)
    kept = calibration == "frozen" or (calibration == "online" and m.directory.calibration is not None)
    odd = _calibration_notes(m) if kept else []
    under_way(f"reading {len(flights)} flight{'' if len(flights) == 1 else 's'}")
    records = api.read_for_compensation(m, flights, mapping)
    under_way("compensating" if calibration in ("frozen", "online") else "calibrating and compensating")
    with progress.shown("compare", sum(map(len, records))):
        c = api.compensate(
            m, records, calibration, demodulator, out, noise=noise, walk=walk, forget=forget or float("inf")
        )
    result = c.as_json()
    made = describe_other.describe_online if calibration == "online" else describe_other.describe_compensation
    said = made(result, output)

    def page() -> str:
        from ragg_runtime.report.pages import compensate_page

        return compensate_page(said, c.series, origin_of(m, records, notes=odd))

    notes = [*result.get("notes", ()), *odd, *api.notes(m, records)]
    origin = api.origin(m, records, command_line()) | {"notes": notes}
    conclude(result | {"output": str(out)} | origin, said, page, records)


@click.command(cls=Command, json=False)
@model_argument
@click.argument("folder", type=PLACE, metavar="DIR")
@click.option(
    "--c", "form", flag_value="c", help="A C17 program: make -C DIR; ragg_model < MOTION.csv > OUT.csv."
)
@click.option("--numpy", "form", flag_value="numpy", help="A folder that runs with NumPy alone.")
@click.option(
    "--json", "form", flag_value="json", help="One document: description, parameters with units, an example."
)
@click.option("--harmonics", "form", flag_value="harmonics",
              help="Outputs as harmonics of the disc's angle: LaTeX and NumPy, without effects.")  # fmt: skip
def export(model_dir: Path, folder: Path, form: str | None) -> None:
    """Write the model with its values as C, NumPy or JSON.

    The values are those of `ragg calibrate --save`, else of model.toml.
    """
    from ragg_runtime import api

    if form is None:
        raise UserError(
            "say what to export",
            expected="--c, --numpy, --json or --harmonics",
            remedy="see: ragg export --help",
        )
    exported = api.contents(load(model_dir))
    for place in api.write_export(exported, folder, form):
        click.echo(f"written: {place}")
    click.echo("\n".join([f"with {exported.origin}", *exported.limits()]))


@click.command(cls=Command, report=True)
@model_argument
@flights_argument
@click.option(
    "--jobs", type=click.IntRange(1), help="Processes on this machine (default: one per processor)."
)
@click.option(
    "--scheduler",
    metavar="tcp://HOST:PORT",
    help="Let the workers of a Dask cluster do it. What answers there can run code here: trusted addresses only.",
)
@click.option("--resume", type=PLACE, metavar="FILE", help="Results file: continue it, and add what is done.")
@click.option("--table", "table_file", type=OutputFile(records=True), metavar="FILE.parquet",
              help="Write a table with a row for each flight.")  # fmt: skip
@mapping_option
def survey(
    model_dir: Path,
    flights: Sequence[Path],
    jobs: int | None,
    scheduler: str | None,
    resume: Path | None,
    table_file: str | None,
    mapping: Path | None,
) -> None:
    """Diagnose many flights, one by one."""
    from ragg_runtime import api
    from ragg_runtime.api import of_survey
    from ragg_runtime.survey import run
    from ragg_runtime.survey.result import check_place, parquet

    m = load(model_dir)
    if table_file is not None:
        check_place(Path(table_file))
    with run.results_file(resume) as file:
        s = api.survey(
            m,
            flights,
            jobs=jobs,
            scheduler=scheduler,
            resume=file,
            progress=run.show_progress(),
            mapping=mapping,
        )
    origin, about = of_survey(m, s, command_line())

    def page() -> str:
        from ragg_runtime.report.page import Origin
        from ragg_runtime.report.pages import survey_page

        return survey_page(s, Origin(**about))

    if table_file is not None:
        shared.running().write(table_file, parquet(s.records))
    conclude(s.as_json() | origin, s.sections(model_dir), page)
