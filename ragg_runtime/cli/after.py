"""Commands of what comes after a model: ``ragg calibrate``, ``compare --frozen``, ``compensate``, ``export``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError, printable
from ragg_runtime.cli.file_commands import mapping_option
from ragg_runtime.cli.outputs import Command
from ragg_runtime.cli.shared import (
    DIRECTORY,
    Finite,
    about,
    command_line,
    emit,
    json_option,
    load,
    series_option,
    under_way,
    write_report,
)

if TYPE_CHECKING:
    from ragg_runtime.workflow.loop import Loaded


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
    from ragg_runtime.workflow import origin as made_from

    m = load(model_dir)
    under_way(f"reading {len(flights)} flight(s)")
    read = loop.read_flights(m, flights, mapping)
    under_way("calibrating")
    with progress.shown("compare", sum(map(len, read))):
        kept = after.calibrate(m, read, save, mapping)
    origin = made_from.origin(kept.loaded, read, command_line())
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
    from ragg_runtime.workflow import after
    from ragg_runtime.workflow import origin as made_from

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
    notes = [*result.get("notes", ()), *odd, *made_from.notes(m, read)]
    origin = made_from.origin(m, read, command_line()) | {"notes": notes}
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
    from ragg_runtime.workflow import origin as made_from

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
    origin = made_from.origin(m, read, command_line())
    then = [terminal.command(verb, m.directory.path, read, mapping) for verb in ("diagnose", "calibrate")]
    emit(
        h.as_json() | origin | {"notes": [*odd, *made_from.notes(m, read)]},
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
