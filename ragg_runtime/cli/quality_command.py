"""The command ``ragg qc``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from ragg_runtime.cli.file_commands import FILE, mapping_option
from ragg_runtime.cli.outputs import Command, OutputFile


@click.command(cls=Command)
@click.argument("flights", type=FILE, nargs=-1, required=True)
@mapping_option
@click.option(
    "--arrangement",
    type=click.Choice(["single", "complements", "orthogonal"]),
    help="How the discs stand to each other (default: two are complements, three orthogonal).",
)
@click.option(
    "--limit", "limits", multiple=True, metavar="NAME=NUMBER", help="Another limit: in-line-sum=12."
)
@click.option(
    "--json", "json_file", type=OutputFile(), metavar="FILE", help="Write the result as JSON (- is stdout)."
)
@click.option(
    "--report", "report_file", type=OutputFile(), metavar="FILE.html", help="Write a self-contained report."
)
def qc(
    flights: Sequence[Path],
    mapping: Path | None,
    arrangement: str | None,
    limits: Sequence[str],
    json_file: str | None,
    report_file: str | None,
) -> None:
    """Quality control of survey lines, as they are delivered; neither motion nor a model is needed.

    Columns: time, inline and cross of one or more discs (inline_A, cross_A ...), positions (easting, northing
    or latitude, longitude), altitude, temperature, a_z or vertical_velocity; other names by --map.
    """
    from ragg_runtime.base.provenance import provenance
    from ragg_runtime.cli.shared import command_line, emit, write_report
    from ragg_runtime.flight.mapping import read_mapping
    from ragg_runtime.report.quality_page import quality_html, quality_text
    from ragg_runtime.survey.quality.qc import qc as _qc

    how = None if mapping is None else read_mapping(mapping)
    q = _qc(flights, how, arrangement=arrangement, limits=limits)
    title = ", ".join(p.name for p in flights[:3]) + (" ..." if len(flights) > 3 else "")
    write_report(report_file, lambda: quality_html(q, title=title, command=command_line()))
    files = [(str(p), digest) for p, (_, digest) in zip(flights, q.read.files, strict=True)]
    emit(q.as_json() | {"provenance": provenance(command_line(), files=files)}, json_file, quality_text(q))
