"""Commands that compare a model with flights, and what comes after: calibration, compensation, export."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from ragg_runtime.base.errors import UserError, printable
from ragg_runtime.base.files import write_bytes, write_text
from ragg_runtime.cli.shared import (
    PLACE,
    RESULT,
    Command,
    Later,
    command_line,
    conclude,
    find_wanted,
    flights_argument,
    frozen_option,
    limit_option,
    load,
    make_source,
    mapping_option,
    model_argument,
    next_command,
    output_option,
    read,
    series_option,
    working,
)
from ragg_runtime.wording import describe, describe_other

if TYPE_CHECKING:
    from ragg_runtime import api, next_flight
    from ragg_runtime.api import Added, Loaded
    from ragg_runtime.report import pages
else:
    api, next_flight, pages = map(Later, ("api", "next_flight", "report.pages"))


@click.command(cls=Command, report=True)
@model_argument
@flights_argument
@mapping_option
@click.option("--calibration", type=click.Choice(["frozen", "self"]), default="self", show_default=True,
              help="frozen: as `ragg calibrate --save` saved it; self: fitted to these flights.")  # fmt: skip
@frozen_option
def compare(
    model_dir: Path, flights: Sequence[Path], mapping: Path | None, calibration: str, frozen: bool
) -> None:
    """Show how far the model is from flights, and where."""
    m = load(model_dir)
    frozen = frozen or calibration == "frozen"
    odd = _list_oddities(m) if frozen else []
    records = read(m, flights, mapping)
    names = [x.name for x in records]
    with working("comparing" if frozen else "calibrating and comparing", "compare", records):
        saved = api.compare_frozen(m, records) if frozen else None
        c = api.compare(m, records) if saved is None else saved.comparison
    result = c.as_json() if saved is None else saved.as_json()
    sections = (describe.describe_held if frozen else describe.describe_comparison)(result, names)
    title = f"{m.name}, frozen, and {', '.join(names)}" if frozen else ""
    source = make_source(m, records, further=odd, title=title)
    after = "" if frozen or c.adequate else next_command("diagnose", model_dir, records, mapping)
    conclude(result, sections, source, lambda: pages.write_comparison(c, source, saved), after)


def _list_oddities(m: Loaded) -> list[str]:
    """Oddities of the saved calibration, which are also printed to stderr."""
    odd = api.saved_calibration(m).find_oddities(m.model, m.instrument)
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
    m = load(model_dir)
    allowed = api.parse_limits(m, limits)
    records = read(m, flights, mapping)
    with working("calibrating, then testing every effect of the catalogue", "diagnose", records):
        d = api.diagnose(m, records, allowed)
    result = d.as_json()
    after = next_command("add", model_dir, records, mapping, d.found[0]) if d.found else ""
    source = make_source(m, records)
    page = lambda: pages.write_diagnosis(d, source)  # noqa: E731
    conclude(result, describe.describe_diagnosis(result), source, page, after)


@click.command(cls=Command, report=True)
@model_argument
@click.argument("effect")
@click.argument("flights", type=PLACE, nargs=-1)
@mapping_option
def add(model_dir: Path, effect: str, flights: Sequence[Path], mapping: Path | None) -> None:
    """Add an effect: derive again, calibrate, show the error."""
    m = load(model_dir)
    if find_wanted("report_file") is not None and not flights:
        raise UserError(
            "a report of `add` needs a flight", remedy="give a flight: ragg add MODEL EFFECT FLIGHT"
        )
    records = read(m, flights, mapping) if flights else []
    check = next_command("diagnose", model_dir, records, mapping)
    use = next_command("calibrate", model_dir, records, mapping) + " --save"

    def tell(result: Added) -> None:
        def page() -> str:
            assert result.before is not None
            assert result.after is not None
            steps = [s.as_json() for s in result.loaded.directory.history]
            return pages.write_addition(steps, result.before, result.after, source)

        data = result.as_json()
        sections = describe.describe_addition(data, [e.id for e in result.loaded.model.effects])
        source = make_source(result.loaded, records, before=m, title=f"{m.name}: {effect} added")
        after = "" if result.after is None else use if result.after.adequate else check
        conclude(data, sections, source, page, after)

    with working(f"deriving the model with {effect}{', calibrating' if flights else ''}", "add", records):
        result = api.add(m, effect, records, tell)
    if not result.converged:
        raise UserError(
            "nothing was added; the model is unchanged",
            where=", ".join(x.name for x in records),
            found=result.after.complaint if result.after else None,
            remedy=f"see what else is missing: {check}; or what is wrong with the record",
        )


@click.command("next-motion", cls=Command, report=True)
@model_argument
@flights_argument
@output_option("MOTION", "Motion file to write.")
@limit_option
@click.option(
    "--band",
    type=float,
    nargs=2,
    default=None,
    metavar="LOW HIGH",
    help="Hz (default: all that the rate allows).",
)
@click.option("--duration", type=click.FloatRange(60.0, 86400.0), default=600.0, show_default=True, help="s")
@click.option("--rate", type=click.FloatRange(1.0, 1000.0), default=None, help="Hz (default: the flights').")
@click.option("--for", "purpose", type=click.Choice(["effects", "calibration"]), default="effects", show_default=True,
              help="Separate effects, or calibrate what the channels need.")  # fmt: skip
@click.option("--criterion", type=click.Choice(["A", "D"]), default="A", show_default=True,
              help="calibration: A: least mean variance of the channels; D: least volume.")  # fmt: skip
@click.option("--run-sheet", type=RESULT, metavar="FILE.md",
              help="calibration: instructions for the crew.")  # fmt: skip
@mapping_option
def next_motion(
    model_dir: Path,
    flights: Sequence[Path],
    output: str,
    limits: Sequence[str],
    run_sheet: str | None,
    mapping: Path | None,
    **options: Any,
) -> None:
    """Design the motion to fly next.

    The motion separates effects that these flights cannot distinguish, or calibrates best.
    """
    from ragg_runtime.io import write_flight

    if run_sheet is not None and options["purpose"] != "calibration":
        raise UserError(
            "a run sheet needs --for calibration", where="--run-sheet", expected="--for calibration"
        )
    m = load(model_dir)
    records, largest = read(m, flights, mapping), api.parse_limits(m, limits)
    design = next_flight.next_flight(m, records, largest, **options)
    if run_sheet is not None:
        write_text(Path(run_sheet), next_flight.write_run_sheet(design))
    write_flight(design.motion(), Path(output))
    sections = describe_other.describe_next_motion(design.as_json(), output)
    source = make_source(m, records)
    page = lambda: pages.write_info(sections, [design.motion()], source, "The next motion")  # noqa: E731
    conclude(design.as_json(), sections, source, page)


@click.command(cls=Command, report=True)
@model_argument
@flights_argument
@click.option("--save", is_flag=True,
              help="Save the calibration (and the mapping given with --map) in the model directory.")  # fmt: skip
@click.option("--plan", type=PLACE, metavar="PLAN.json",
              help="Certify each parameter against a plan of next-motion --for calibration.")  # fmt: skip
@click.option("--drift", is_flag=True, help="Estimate parameters that drift during the flights.")
@mapping_option
def calibrate(
    model_dir: Path, flights: Sequence[Path], save: bool, plan: Path | None, drift: bool, mapping: Path | None
) -> None:
    """Fit the parameters, with their uncertainty."""
    m = load(model_dir)
    planned = None if plan is None else next_flight.read_plan(plan)
    records = read(m, flights, mapping)
    with working("calibrating", "compare", records):
        c = api.calibrate(m, records, save, mapping, drift=drift)
    result = c.as_json()
    if planned is not None:
        result |= next_flight.certify(planned, c.calibrated.fitted, result)
    sections = describe_other.describe_calibration(result, [x.name for x in records])
    source = make_source(c.loaded, records)
    conclude(result, sections, source, lambda: pages.write_calibration(sections, c.calibrated.fitted, source))


@click.command(cls=Command, report=True)
@model_argument
@flights_argument
@series_option
@click.option(
    "--calibration",
    type=click.Choice(["frozen", "self", "crossed", "smoothed", "online"]),
    default="self",
    show_default=True,
    help="frozen: as `ragg calibrate --save` saved it; self: fitted to these flights; crossed: each block of time fitted to "
    "all others; smoothed: drifting from block to block; online: sample by sample.",
)
@frozen_option
@click.option(
    "--demodulator",
    type=click.Choice(["fir", "butterworth", "causal"]),
    default="fir",
    show_default=True,
    help="fir: 0.2 Hz, no delay; butterworth: order 6, 0.18 Hz, forward and backward; causal: forward only.",
)
@click.option("--noise", type=click.FloatRange(0.0, min_open=True), metavar="EO/SQRT(HZ)",
              help="online: noise of the cross channel (default: from the saved calibration).")  # fmt: skip
@click.option("--walk", type=click.FloatRange(0.0), metavar="EO/SQRT(S)",
              help="online: random walk of the gradient (default: as a low-pass of 0.2 Hz).")  # fmt: skip
@click.option("--forget", type=click.FloatRange(0.0, min_open=True), metavar="S",
              help="online: time constant of forgetting (default: never).")  # fmt: skip
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
    from ragg_runtime.io.files import find_format

    out = Path(output)
    find_format(out, write=True)  # before a long computation
    calibration = "frozen" if frozen else calibration
    if calibration != "online" and any(x is not None for x in (noise, walk, forget)):
        raise UserError(
            "--noise, --walk and --forget need --calibration online", expected="--calibration online"
        )
    m = load(model_dir)
    uses_saved = calibration == "frozen" or (calibration == "online" and m.directory.calibration is not None)
    odd = _list_oddities(m) if uses_saved else []
    records = read(m, flights, mapping, gradient=False)
    with working("compensating", "compare", records):
        c = api.compensate(
            m, records, calibration, demodulator, out, noise=noise, walk=walk, forget=forget or float("inf")
        )
    result = c.as_json()
    say = describe_other.describe_online if calibration == "online" else describe_other.describe_compensation
    sections = say(result, output)
    source = make_source(m, records, further=[*result.get("notes", ()), *odd])
    page = lambda: pages.write_compensation(sections, c.series, source)  # noqa: E731
    conclude(result | {"output": str(out)}, sections, source, page)


@click.command(cls=Command, json=False)
@model_argument
@click.argument("folder", type=PLACE, metavar="DIR")
@click.option(
    "--c", "form", flag_value="c", help="A C17 program: make -C DIR; ragg_model < MOTION.csv > OUT.csv."
)
@click.option("--numpy", "form", flag_value="numpy", help="A folder that needs only NumPy.")
@click.option(
    "--json", "form", flag_value="json", help="One document: description, parameters with units, an example."
)
def export(model_dir: Path, folder: Path, form: str | None) -> None:
    """Write the model with its values as C, NumPy or JSON.

    The values are those of `ragg calibrate --save`, else of model.toml.
    """
    if form is None:
        raise UserError(
            "choose what to export", expected="--c, --numpy or --json", remedy="see: ragg export --help"
        )
    exported = api.contents(load(model_dir))
    files = api.write_export(exported, folder, form)
    hint = f" Build with: make -C {printable(str(folder))}" if form == "c" else ""
    click.echo(f"{printable(str(folder))}: {len(files)} files.{hint}")
    click.echo("\n".join([f"Values: {exported.origin}", *exported.limits()]))


@click.command(cls=Command, report=True)
@model_argument
@flights_argument
@click.option(
    "--jobs", type=click.IntRange(1), help="Processes on this machine (default: one per processor)."
)
@click.option(
    "--scheduler",
    metavar="tcp://HOST:PORT",
    help="Use the workers of a Dask cluster. Its scheduler can run code on this machine: trusted addresses only.",
)
@click.option("--resume", type=PLACE, metavar="FILE", help="Results file to continue.")
@click.option("--table", "table_file", type=RESULT, metavar="FILE.parquet",
              help="Write a table with a row for each flight.")  # fmt: skip
@mapping_option
def survey(model_dir: Path, flights: Sequence[Path], table_file: str | None, **options: Any) -> None:
    """Diagnose many flights, one by one."""
    from ragg_runtime.survey.result import make_parquet
    from ragg_runtime.survey.run import tell_progress

    m = load(model_dir)
    s = api.survey(m, flights, progress=tell_progress, **options)
    source = api.source_of_survey(m, s, command_line())
    if table_file is not None:
        write_bytes(Path(table_file), make_parquet(s.records))
    result = s.as_json() | {"sources": [{"name": n, "sha256": digest} for n, digest in source.inputs]}
    page = lambda: pages.write_survey(s, source, model_dir)  # noqa: E731
    conclude(result, s.sections(model_dir), source, page)
