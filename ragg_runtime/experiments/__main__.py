"""``python -m ragg_runtime.experiments [NAME...]``: the paper's experiments beside ours, as Markdown."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import click

from ragg_runtime.experiments import (
    Experiment,
    repeat_dynamic,
    repeat_multifrequency,
    repeat_turbulence,
    write_page,
)

EXPERIMENTS: Mapping[str, Callable[[], Experiment]] = {
    "multifrequency": repeat_multifrequency,
    "dynamic": repeat_dynamic,
    "turbulence": repeat_turbulence,
}


@click.command()
@click.argument("names", nargs=-1, metavar="[NAME...]", type=click.Choice(list(EXPERIMENTS)))
def main(names: Sequence[str]) -> None:
    """Repeat the paper's experiments (Section III): multifrequency, dynamic, turbulence; without a name all."""
    click.echo(write_page([EXPERIMENTS[name]() for name in names or EXPERIMENTS]), nl=False)


if __name__ == "__main__":
    main(prog_name="python -m ragg_runtime.experiments")
