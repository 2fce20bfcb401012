"""``python -m ragg_runtime.experiments docs [FILE]`` writes the page; else as ``ragg experiment``."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from ragg_runtime.base.errors import UserError
from ragg_runtime.experiments.command import experiment
from ragg_runtime.experiments.page import DEFAULT, page


@experiment.command("docs")
@click.argument("file", type=click.Path(dir_okay=False, path_type=Path), default=DEFAULT)
def docs(file: Path) -> None:
    """Write docs/experiments.md anew."""
    file.write_text(page(), encoding="utf-8")
    click.echo(f"wrote {file}", err=True)


if __name__ == "__main__":
    try:
        experiment(prog_name="python -m ragg_runtime.experiments")
    except UserError as problem:
        click.echo(f"error: {problem.message}", err=True)
        sys.exit(2)
