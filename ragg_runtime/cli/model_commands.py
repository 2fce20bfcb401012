"""Commands about a model directory and the catalogue: all that needs no flight, and the simulator."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ragg_runtime.base.errors import UserError, one_line, printable
from ragg_runtime.cli import completion
from ragg_runtime.cli.file_commands import mapping_option
from ragg_runtime.cli.outputs import Command, OutputFile
from ragg_runtime.cli.shared import (
    DIRECTORY,
    Finite,
    command_line,
    emit,
    json_option,
    load,
    say_notes,
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
    """Derive all models and generate their code and pages."""
    from ragg_runtime.workflow import derivation

    root = derivation.HOME if out is None else out
    if check:
        found = derivation.checked(root)
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
    changed = derivation.rederived(root)
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
@click.argument("identifier", metavar="[ID]", required=False, shell_complete=completion.catalogued)
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
@click.argument("effect", shell_complete=completion.present)
@json_option
def remove(model_dir: Path, effect: str, json_file: str | None) -> None:
    """Take an effect out of the model."""
    from ragg_runtime.workflow import loop
    from ragg_runtime.workflow import origin as made_from

    before = load(model_dir)

    def tell(m: Loaded) -> None:
        left = [e.id for e in m.model.effects]
        with telling():
            emit(
                {"effect": effect, "effects": left} | made_from.origin(m, (), command_line(), before=before),
                json_file,
                f"removed {effect}; effects left: {', '.join(left) or 'none'}",
            )

    loop.remove(before, effect, tell)


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.option("--list", "only_list", is_flag=True, help="Only say what would be executed.")
@click.option("--forget", is_flag=True, help="Trust these files no longer.")
def trust(model_dir: Path, only_list: bool, forget: bool) -> None:
    """Let the Python files of the model's effects_folder be executed, exactly as they are now.

    Without this none is: read them first. MODEL_DIR may be a model.toml as well.
    """
    from ragg_runtime.workflow import upkeep

    found = upkeep.own_effects(model_dir)
    for line in found.lines():
        click.echo(line)
    if forget:
        was = upkeep.forget(found)
        click.echo("No longer on the list of trusted files." if was else "They were not on the list.")
    elif only_list:
        click.echo(f"{'On' if upkeep.is_trusted(found) else 'Not on'} the list of trusted files.")
    else:
        place = one_line(str(upkeep.trust(found)))
        click.echo(f"They will be executed as long as they stay as they are; written to {place}")


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@click.option("--look", is_flag=True, help="Change nothing.")
def doctor(model_dir: Path, look: bool) -> None:
    """What is damaged in a model directory; what can be mended without loss, is."""
    from ragg_runtime.workflow.doctor import examined

    found = examined(model_dir, mend=not look)
    for f in found:
        click.echo(printable(f"{f.what}\n  -> {f.way_back}" if f.way_back else f.what))
    if any(f.open for f in found):
        sys.exit(2)
    click.echo(f"{one_line(str(model_dir))}: {'mended' if found else 'in order'}")


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY, required=False)
def build(model_dir: Path | None) -> None:
    """Compile the model's C beforehand (otherwise on first use); without MODEL_DIR, the paper's model."""
    from ragg_runtime.workflow import upkeep

    made = upkeep.compiled(None if model_dir is None else load(model_dir))
    click.echo(f"{made.library}: {'compiled' if made.fresh else 'there already'}\n{made.command}")


@click.command(cls=Command)
@click.argument("model_dir", type=DIRECTORY)
@json_option
def history(model_dir: Path, json_file: str | None) -> None:
    """The error after every step."""
    from ragg_runtime.report import in_words
    from ragg_runtime.workflow import upkeep

    h = upkeep.history(model_dir, command_line())
    say_notes(model_dir, h.notes)
    emit({"steps": h.steps, "provenance": h.provenance}, json_file, in_words.history(h.steps))


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
@click.option("--no-gradient", is_flag=True, help="Leave the gravity gradient unrecorded.")
@click.option("--voltages", is_flag=True, help="Record V_1 ... V_4 too.")
def simulate(
    model_dir: Path, output: str, hidden: Sequence[str], mapping: Path | None, **options: Any
) -> None:
    """A flight from the numerical reference, with hidden effects on request."""
    from ragg_runtime.flight import write_flight
    from ragg_runtime.workflow.loaded import mapping_of
    from ragg_runtime.workflow.simulate import simulated

    m = load(model_dir)
    under_way("flying")
    flight = simulated(m.instrument, hidden, mapping=mapping_of(m, mapping), **options)
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
