"""Commands about a model directory and the catalogue: all that needs no flight, and the simulator."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ragg_runtime.base.errors import UserError, one_line, printable
from ragg_runtime.cli import shared
from ragg_runtime.cli.shared import (
    DIRECTORY,
    Command,
    Finite,
    OutputFile,
    asked,
    command_line,
    emit,
    json_option,
    load,
    mapping_option,
    telling,
    under_way,
)

if TYPE_CHECKING:
    from ragg_runtime.workflow.loop import Loaded


@click.command(cls=Command)
@click.option(
    "--out", type=DIRECTORY, help="Root of the project to write to (default: where ragg is installed)."
)
@click.option("--check", is_flag=True, help="Only say whether the committed code matches the derivation.")
def derive(out: Path | None, check: bool) -> None:
    """Derive all models and generate their code."""
    from ragg_runtime.model_dir import publish

    root = publish.HOME if out is None else out
    if check:
        found = publish.checked(root)
        if found.difference:
            raise UserError(
                "the committed code does not match the derivation",
                where=root,
                found="\n" + found.difference,
                expected="the same files, byte for byte",
                remedy=found.versions
                or "run: make derive   (or: ragg derive), look at the change, and commit it",
            )
        click.echo("The committed code is what the derivation yields, byte for byte.")
        if found.versions:
            click.echo(f"note: it was derived with SymPy {found.committed_with}, and is the same here")
        return
    changed = publish.rederived(root)
    for name in changed:
        click.echo(one_line(f"written: {root / name}"))
    click.echo(f"{len(changed)} files changed." if changed else "Nothing changed: all files are as derived.")


@click.command(cls=Command)
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


@click.command(cls=Command)
@click.argument("identifier", metavar="[ID]", required=False, shell_complete=shared.catalogued)
@json_option
def effects(identifier: str | None, json_file: str | None) -> None:
    """The catalogue of physical effects; with ID one of them in full."""
    from ragg_runtime.workflow.catalogue import effects as catalogue
    from ragg_runtime.workflow.catalogue import in_words

    found = catalogue()
    if identifier is None:
        emit(found.as_json(), json_file, repr(found))
    else:
        emit(dict(found[identifier]), json_file, in_words(found[identifier]))


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.argument("effect", shell_complete=shared.present)
@json_option
def remove(model_dir: Path, effect: str, json_file: str | None) -> None:
    """Take an effect out of the model."""
    from ragg_runtime.workflow import loop

    before = load(model_dir)

    def tell(m: Loaded) -> None:
        left = [e.id for e in m.model.effects]
        with telling():
            emit(
                {"effect": effect, "effects": left} | loop.origin(m, (), command_line(), before=before),
                json_file,
                f"removed {effect}; effects left: {', '.join(left) or 'none'}",
            )

    loop.remove(before, effect, tell)


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@json_option
def history(model_dir: Path, json_file: str | None) -> None:
    """The error after every step."""
    from ragg_runtime.base.provenance import provenance
    from ragg_runtime.model_dir.directory import identity, load_model_dir
    from ragg_runtime.report import in_words

    d = load_model_dir(model_dir)  # not derived: a model that no longer can be is told its steps, too
    steps = [s.as_json() for s in d.history]
    origin = provenance(command_line(), identity(d))
    emit({"steps": steps, "provenance": origin}, json_file, in_words.history(steps))


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.option(
    "-o",
    "--output",
    type=OutputFile(records=True),
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
@click.option("--duration", type=Finite(1.0), default=1800.0, show_default=True, help="s")
@click.option("--rate", type=Finite(1.0), default=16.0, show_default=True, help="Hz")
@click.option("--noise", type=Finite(0.0), default=2.0, show_default=True, help="Eo/sqrt(Hz)")
@click.option(
    "--shape", type=click.Choice(["flat", "dryden", "kolmogorov", "resonant"]), help="Spectrum of the motion."
)
@click.option("--sheet-error", type=Finite(0.0), default=1.0, show_default=True,
              help="How far the true instrument lies from the test sheet (0: not at all).")  # fmt: skip
@click.option(
    "--motion", type=DIRECTORY, metavar="FILE", help="Fly this motion (a flight file; its length and rate)."
)
@mapping_option
@click.option(
    "--spin",
    multiple=True,
    metavar="[DISC:]HZ[,RAD@HZ[@RAD]]...",
    help="How a disc turns (all, if none is named): a rate, negative backwards, 0 none, and swings of so many rad at so "
    "many Hz, from a phase on. Its encoder is recorded. An encoder in --motion is flown, too.",
)
@click.option(
    "--gradient/--no-gradient", default=False, show_default=True, help="Record the gravity gradient."
)
@click.option("--voltages", is_flag=True, help="Record V_1 ... V_4 too.")
def simulate(
    model_dir: Path,
    output: str,
    hidden: Sequence[str],
    mapping: Path | None,
    gradient: bool,
    **options: Any,
) -> None:
    """A flight from the numerical reference, with hidden effects on request."""
    from ragg_runtime.io import write_flight
    from ragg_runtime.workflow.loop import mapping_of
    from ragg_runtime.workflow.simulate import simulated

    m = load(model_dir)
    under_way("flying")
    flight = simulated(
        m.instrument, hidden, mapping=mapping_of(m, mapping), no_gradient=not gradient, **options
    )
    write_flight(flight, output)
    click.echo(f"{one_line(str(output))}: {len(flight.time)} samples at {flight.rate:g} Hz")


@click.command(cls=Command)
@click.option(
    "--output", type=DIRECTORY, default=Path("ragg-demo"), show_default=True, help="Folder to make."
)
def demo(output: Path) -> None:
    """The main job on a simulated flight: find a hidden effect, add it, watch the error fall."""
    from ragg_runtime.cli import demo as _demo

    _demo.main(output, command=command_line())


@click.command(cls=Command)
@click.argument("source", metavar="IN", type=DIRECTORY)
@click.argument("target", metavar="OUT", type=DIRECTORY)
@mapping_option
def convert(source: Path, target: Path, mapping: Path | None) -> None:
    """Write a flight file in another format, by the ending of OUT: same numbers, names and units.

    Reads CSV, Parquet, NetCDF, HDF5, MATLAB and Excel; writes CSV, Parquet and NetCDF.
    """
    from ragg_runtime.io.files import convert as _convert
    from ragg_runtime.io.mapping import read_mapping

    if mapping is not None and mapping.resolve() == target.resolve():
        raise UserError("OUT is the mapping itself", where=target, remedy="name another file")
    done = _convert(source, target, None if mapping is None else read_mapping(mapping))
    for note in done.notes:
        click.echo(printable(f"note: {note}"), err=True)
    lines = f"{done.lines} lines, " if done.lines > 1 else ""
    click.echo(printable(f"{target}: {lines}{done.rows} rows of {len(done.columns)} columns"))


@click.command(name="map", cls=Command)
@click.argument("flight", type=DIRECTORY)
@click.option(
    "-o", "--output", type=OutputFile(), metavar="mapping.toml", help="File to write (default: stdout)."
)
def map_command(flight: Path, output: str | None) -> None:
    """Write a first mapping for a foreign file: which column is what, in which unit, and how time is written.

    What the file does not say is marked with "?" and asked for: units are never guessed.
    """
    from ragg_runtime.io.guess import draft

    made = draft(flight)
    if output is None:
        click.echo(printable(made.text), nl=False)
    else:
        if Path(output).exists():
            raise UserError(
                "the mapping exists already", where=output, remedy="choose another name or remove it first"
            )
        asked().write(output, made.text)
        click.echo(printable(f"{output}: written; look it over, then: --map {output}"), err=True)
    if made.questions:
        count = len(made.questions)
        click.echo(f'{count} question{"s are" if count > 1 else " is"} left, marked with "?":', err=True)
        for question in made.questions:
            click.echo(printable(f"  {question}"), err=True)
