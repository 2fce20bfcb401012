"""``ragg experiment``: the paper's experiments on the command line."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from ragg_runtime.experiments.result import Result

_JSON = click.option(
    "--json", "json_file", type=click.Path(), metavar="FILE", help="Write the result as JSON (- is stdout)."
)
_FIGURES = click.option(
    "--figures",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Draw the paper's figures.",
)


@click.group()
def experiment() -> None:
    """Repeat the paper's experiments (Section III): our numbers beside the printed ones."""


@experiment.command("multifrequency")
@_JSON
@_FIGURES
def multifrequency_command(json_file: str | None, figures: Path | None) -> None:
    """A test mass circles a perfect instrument (Section III.A)."""
    from ragg_runtime.experiments.multifrequency import multifrequency

    _give(multifrequency(), json_file, figures)


@experiment.command("dynamic")
@_JSON
@_FIGURES
def dynamic_command(json_file: str | None, figures: Path | None) -> None:
    """The instrument of Table V in the motion of Table VI (Section III.B)."""
    from ragg_runtime.experiments.dynamic import dynamic

    _give(dynamic(), json_file, figures)


@experiment.command("turbulence")
@click.option("--seeds", type=click.IntRange(1), default=8, show_default=True, help="Records of each.")
@click.option("--rate", type=float, default=None, help="Sampling rate, Hz [default: 20].")
@click.option("--duration", type=float, default=None, help="Length of each record, s [default: 600].")
@_JSON
@_FIGURES
def turbulence_command(
    seeds: int, rate: float | None, duration: float | None, json_file: str | None, figures: Path | None
) -> None:
    """The instrument of Table V in the turbulence of Table VII (Section III.C, Table VIII)."""
    from ragg_runtime.experiments.turbulence import turbulence
    from ragg_runtime.experiments.turbulent import DURATION, RATE

    _give(
        turbulence(
            seeds=range(seeds),
            rate=RATE if rate is None else rate,
            duration=DURATION if duration is None else duration,
        ),
        json_file,
        figures,
    )


def _give(result: Result, json_file: str | None, figures: Path | None) -> None:
    if figures is not None:
        for path in result.figures(figures):
            click.echo(f"wrote {path}", err=True)
    if json_file is not None:
        from ragg_runtime.base import provenance
        from ragg_runtime.base.files import write_text

        made = provenance.provenance(provenance.command())
        found = provenance.versioned(result.as_json() | {"provenance": made})
        text = json.dumps(found, indent=1, allow_nan=False) + "\n"
        if json_file == "-":
            sys.stdout.write(text)
            return
        write_text(Path(json_file), text)
    click.echo(result.text(), nl=False)
