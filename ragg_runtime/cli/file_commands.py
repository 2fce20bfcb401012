"""The commands about files alone: ``ragg convert`` and ``ragg map``."""

from __future__ import annotations

from pathlib import Path

import click

from ragg_runtime.base.errors import UserError, printable
from ragg_runtime.cli.outputs import Command, OutputFile, asked

FILE = click.Path(path_type=Path)
mapping_option = click.option(
    "--map", "mapping", type=FILE, metavar="FILE", help="What the columns of the flight files are (ragg map)."
)


@click.command(cls=Command)
@click.argument("source", metavar="IN", type=FILE)
@click.argument("target", metavar="OUT", type=FILE)
@mapping_option
def convert(source: Path, target: Path, mapping: Path | None) -> None:
    """Write a flight file in another format, by the ending of OUT: same numbers, names and units.

    Reads CSV, Parquet, NetCDF, HDF5, MATLAB and Excel; writes CSV, Parquet and NetCDF.
    """
    from ragg_runtime.flight.files import convert as _convert
    from ragg_runtime.flight.mapping import read_mapping

    if mapping is not None and mapping.resolve() == target.resolve():
        raise UserError("OUT is the mapping itself", where=target, remedy="name another file")
    done = _convert(source, target, None if mapping is None else read_mapping(mapping))
    for note in done.notes:
        click.echo(printable(f"note: {note}"), err=True)
    lines = f"{done.lines} lines, " if done.lines > 1 else ""
    click.echo(printable(f"{target}: {lines}{done.rows} rows of {len(done.columns)} columns"))


@click.command(name="map", cls=Command)
@click.argument("flight", type=FILE)
@click.option(
    "-o", "--output", type=OutputFile(), metavar="mapping.toml", help="File to write (default: stdout)."
)
def map_command(flight: Path, output: str | None) -> None:
    """Write a first mapping for a foreign file: which column is what, in which unit, and how time is written.

    What the file does not say is marked with "?" and asked for: units are never guessed.
    """
    from ragg_runtime.flight.guess import draft

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
