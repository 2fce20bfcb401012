"""``ragg next-motion``: the motion that would tell apart what the record cannot."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from ragg_runtime.cli.file_commands import mapping_option
from ragg_runtime.cli.outputs import Command, OutputFile


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
