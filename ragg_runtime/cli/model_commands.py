"""Commands about a model directory, the catalogue and flight files, and the simulator."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError, count, one_line, printable
from ragg_runtime.base.files import write_text
from ragg_runtime.cli.main import cli
from ragg_runtime.cli.shared import (
    PLACE,
    RESULT,
    Command,
    Later,
    command_line,
    conclude,
    load,
    make_source,
    mapping_option,
    model_argument,
    output_option,
    series_option,
    show_notes,
)
from ragg_runtime.wording import describe, describe_other, numbers
from ragg_runtime.wording.sections import Section, render_text

if TYPE_CHECKING:
    from ragg_runtime import api, io
    from ragg_runtime import simulate as simulator
    from ragg_runtime.api import Loaded
    from ragg_runtime.report import pages
else:
    api, io, pages, simulator = map(Later, ("api", "io", "report.pages", "simulate"))


@click.command(cls=Command, json=False, hidden=True)
@click.option("--out", type=PLACE, help="Root of the project to write to (default: where ragg is installed).")
@click.option("--check", is_flag=True, help="Only check that the committed code matches the derivation.")
def derive(out: Path | None, check: bool) -> None:
    """Derive all models and generate their code."""
    from ragg_runtime.model import derive as derivation

    root = derivation.find_root() if out is None else out
    if not check:
        changed = derivation.rederive(root)
        for name in changed:
            click.echo(one_line(f"written: {root / name}"))
        click.echo(
            f"{len(changed)} files changed."
            if changed
            else "Nothing changed: all files match the derivation."
        )
        return
    derivation.check(root)
    click.echo("The committed code matches the derivation byte for byte.")


@click.command(cls=Command)
@model_argument
@click.option("--from", "source", type=PLACE, metavar="FILE.toml", help="Test sheet to start from.")
@mapping_option
def new(model_dir: Path, source: Path | None, mapping: Path | None) -> None:
    """Make a model directory from a test sheet."""
    m = show_notes(api.new(model_dir, source, mapping), model_dir)
    place, effects = one_line(str(m.directory.path)), [e.id for e in m.model.effects]
    sections = describe.say_plainly(
        f"{place}: created; {describe.write_effects(effects)}",
        f"Edit {place}/model.toml, then: ragg compare {place} FLIGHT",
    )
    conclude({"model": place, "effects": effects}, sections, make_source(m))


@click.command(cls=Command)
@click.argument("identifier", metavar="[ID]", required=False)
def effects(identifier: str | None) -> None:
    """List the catalogue of effects; with ID, one in full."""
    from ragg_runtime.model.derive import effects as catalogue

    entries = catalogue()
    if identifier is None:
        conclude(entries.as_json(), entries.sections())
    else:
        conclude(dict(entries[identifier]), describe_other.describe_effect(entries[identifier]))


@click.command(cls=Command)
@model_argument
@click.argument("effect")
def remove(model_dir: Path, effect: str) -> None:
    """Remove an effect from the model."""
    before = load(model_dir)

    def tell(m: Loaded) -> None:
        ids = [e.id for e in m.model.effects]
        sections = describe.say_plainly(f"removed {effect}; {describe.write_effects(ids)}")
        conclude({"effect": effect, "effects": ids}, sections, make_source(m, before=before))

    api.remove(before, effect, tell)


@click.command(cls=Command, report=True)
@model_argument
def history(model_dir: Path) -> None:
    """Show the error after every step."""
    from ragg_runtime.base.files import provenance
    from ragg_runtime.model.directory import compute_digest, load_model_dir

    d = load_model_dir(model_dir)  # not derived: the steps of a model that no longer can be are shown, too
    steps = [s.as_json() for s in d.history]
    model = {"model": str(d.path), "model_digest": compute_digest(d.text)}
    result = {"steps": steps, "provenance": provenance(command_line(), model)}
    sections = (Section(table=describe.tabulate_history(steps)),)

    def page() -> str:
        return pages.write_history(steps, api.Source(command_line(), title=f"{d.path.name}: history"))

    conclude(result, sections, page=page)


@click.command(cls=Command)
@model_argument
@series_option
@click.option(
    "--effect",
    "hidden",
    multiple=True,
    metavar="ID:NAME=VALUE[,NAME=...]",
    help="Hide an effect in the flight; VALUE in the effect's units, four values joined by /.",
)
@click.option(
    "--seed", type=click.IntRange(0), default=0, show_default=True, help="Seed of motion, gradient and noise."
)
@click.option("--instrument-seed", type=click.IntRange(0), default=0, show_default=True,
              help="Seed of the true instrument: flights with the same seed share it.")  # fmt: skip
@click.option("--duration", type=click.FloatRange(1.0, 1e6), default=1800.0, show_default=True, help="s")
@click.option("--rate", type=click.FloatRange(1.0, 1000.0), default=16.0, show_default=True, help="Hz")
@click.option("--noise", type=click.FloatRange(0.0), default=2.0, show_default=True, help="Eo/sqrt(Hz)")
@click.option(
    "--shape", type=click.Choice(["flat", "dryden", "kolmogorov", "resonant"]), help="Spectrum of the motion."
)
@click.option("--sheet-error", type=click.FloatRange(0.0), default=1.0, show_default=True,
              help="How far the true instrument is from the test sheet (0: not at all).")  # fmt: skip
@click.option(
    "--motion", type=PLACE, metavar="FILE", help="Motion to fly (a flight file; sets duration and rate)."
)
@mapping_option
@click.option(
    "--gradient/--no-gradient", default=False, show_default=True, help="Record the gravity gradient."
)
@click.option("--voltages", is_flag=True, help="Record V_1 ... V_4 too.")
def simulate(
    model_dir: Path, output: str, hidden: Sequence[str], mapping: Path | None, gradient: bool, **options: Any
) -> None:
    """Simulate a flight, hidden effects on request."""
    m = load(model_dir)
    progress.remark("simulating")
    flight = simulator.simulate_flight(
        m.instrument, hidden, mapping=api.mapping_of(m, mapping), no_gradient=not gradient, **options
    )
    io.write_flight(flight, output)
    text = f"{one_line(output)}: {len(flight.time)} samples at {numbers.hertz(flight.rate)}"
    result = {"output": output, "samples": len(flight.time), "rate_Hz": flight.rate, "effects": list(hidden)}
    conclude(result, describe.say_plainly(text), make_source(m))


@click.command(cls=Command, json=False)
@click.option("--output", type=PLACE, default=Path("ragg-demo"), show_default=True, help="Folder to make.")
def demo(output: Path) -> None:
    """Find a hidden effect in a simulated flight, add it."""
    if output.exists():
        raise UserError("the folder exists already", where=output, remedy="choose another with --output")
    output.mkdir(parents=True)
    model, flight, report, diagnosis, added = (
        str(output / name)
        for name in ("model", "flight.parquet", "report.html", "diagnosis.html", "added.json")
    )
    make_flight(flight)
    _run("new", model)
    _run("compare", model, flight)
    _run("diagnose", model, flight, "--report", diagnosis)
    _run("add", model, HIDDEN[0], flight, "--report", report, "--json", added)
    _run("history", model)
    sections = describe.say_plainly(
        *_describe_recovery(json.loads(Path(added).read_text("utf-8"))),
        f"Reports: {diagnosis}  {report}",
        f"In a browser: ragg studio {model} {flight}",
    )
    click.echo(f"\n{render_text(sections)}")


@click.command(cls=Command, report=True)
@click.argument("flight", type=PLACE)
@mapping_option
def info(flight: Path, mapping: Path | None) -> None:
    """Show what a flight file holds, and what is assumed."""
    from ragg_runtime.io.files import PAPER_G, describe_flight
    from ragg_runtime.io.mapping import read_mapping

    mapped = None if mapping is None else read_mapping(mapping)
    contents = describe_flight(flight, mapped)
    sections = describe_other.describe_flight_file(contents)

    def page() -> str:
        usable = not any(r["refused"] for r in contents["records"])
        records = io.read_flights(flight, PAPER_G, mapping=mapped) if usable else []
        digests = [(contents["path"], contents["path"], contents["sha256"])]
        source = api.Source(command_line(), files=digests, title=flight.name)
        return pages.write_info(sections, records, source)

    conclude(contents, sections, page=page)


@click.command(cls=Command)
@click.argument("source", metavar="IN", type=PLACE)
@click.argument("target", metavar="OUT", type=RESULT)
@mapping_option
def convert(source: Path, target: str, mapping: Path | None) -> None:
    """Write a flight file in another format.

    The ending of OUT selects it; numbers, names and units are unchanged. Reads CSV, Parquet, NetCDF, HDF5, MATLAB and Excel; writes
    CSV, Parquet and NetCDF.
    """
    from ragg_runtime.io.files import convert as _convert
    from ragg_runtime.io.mapping import read_mapping

    done = _convert(source, Path(target), None if mapping is None else read_mapping(mapping))
    for note in done["notes"]:
        click.echo(printable(f"note: {note}"), err=True)
    lines = f"{done['lines']} lines, " if done["lines"] > 1 else ""
    text = f"{target}: {lines}{done['rows']} rows of {len(done['columns'])} columns"
    conclude(done, describe.say_plainly(text))


@click.command(name="map", cls=Command, json=False)
@click.argument("flight", type=PLACE)
@output_option("mapping.toml", "File to write (default: stdout).", required=False)
def map_command(flight: Path, output: str | None) -> None:
    """Draft a mapping for a file with other column names.

    A mapping names the columns, their units and the format of time. Units that the file lacks are marked "?" for you to
    answer; none is guessed.
    """
    from ragg_runtime.io.draft import draft_mapping

    draft = draft_mapping(flight)
    if output is None:
        click.echo(printable(draft.text), nl=False)
    else:
        if Path(output).exists():
            raise UserError(
                "the mapping exists already", where=output, remedy="choose another name or remove it first"
            )
        write_text(Path(output), draft.text)
        click.echo(printable(f"{output}: written; check it, then use it: --map {output}"), err=True)
    guesses = [name for name, rating in draft.sure.items() if rating == "guess"]
    if guesses:
        click.echo(f"guessed from units or unusual names: {', '.join(guesses)}", err=True)
    for note in draft.notes:
        click.echo(one_line(f"note: {note}"), err=True)
    if draft.questions:
        are = "is" if len(draft.questions) == 1 else "are"
        click.echo(f'{count(len(draft.questions), "question")} {are} open, marked with "?":', err=True)
        for question in draft.questions:
            click.echo(printable(f"  {question}"), err=True)


@click.command()
@click.argument("model_dir", metavar="[MODEL]", type=PLACE, required=False)
@click.argument("flights", metavar="[FLIGHT...]", type=PLACE, nargs=-1)
@click.option(
    "--port", type=click.IntRange(0, 65535), default=0, help="Port on 127.0.0.1 (default: a free one)."
)
@click.option("--no-browser", is_flag=True, help="Only print the address.")
def studio(model_dir: Path | None, flights: Sequence[Path], port: int, no_browser: bool) -> None:
    """Work in a browser: compare, diagnose, add, apply.

    Prints the address and serves until interrupted, to this machine only. Files are read and written below the
    folders of MODEL and FLIGHT (without them: the working directory) and nowhere else.
    """
    from ragg_runtime.studio.serve import serve

    serve(model_dir, flights, port, click.echo, browser=not no_browser)


# what is hidden in the flight: effect, parameter, its values in A1 ... A4, 1/K.
HIDDEN = ("thermal-scale", "dK1_dT", (0.0, 0.0, 6e-8, 0.0))


def make_flight(path: str) -> None:
    """Write the flight: twelve minutes at 1 g in turbulence, with a temperature-dependent scale factor in A3."""
    effect, name, values = HIDDEN
    hidden = f"{effect}:{name}={'/'.join(f'{x:g}' for x in values)}"
    flight = simulator.simulate_flight(
        api.example(), [hidden], seed=2026, instrument_seed=2026, duration=720.0
    )
    io.write_flight(flight, path)


def _run(*words: str) -> None:
    click.echo(f"\n\033[1m$ ragg {' '.join(words)}\033[0m")
    cli.main(args=list(words), prog_name="ragg", standalone_mode=False, obj=list(words))


def _describe_recovery(added: Mapping[str, Any]) -> list[str]:
    """The hidden and the recovered value of the combination of accelerometers that the record determines best."""
    effect, _, values = HIDDEN
    q = max(added["combinations"], key=describe.significance)
    true = sum(w * x for w, x in zip(q["weights"], values, strict=True))
    return [
        f"hidden:    {effect}: {describe.label_parameter(q)} = {numbers.with_unit(numbers.number(true, 2), q['unit'])}",
        f"recovered: {effect}: {describe.write_parameter(q)}",
    ]
