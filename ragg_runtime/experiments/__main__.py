"""``python -m ragg_runtime.experiments [NAME...]``: the paper's experiments beside ours, as Markdown or JSON."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import click

from ragg_runtime.base import provenance
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import write_text
from ragg_runtime.experiments.dynamic import repeat_dynamic
from ragg_runtime.experiments.multifrequency import repeat_multifrequency
from ragg_runtime.experiments.paper import Experiment, write_page
from ragg_runtime.experiments.turbulence import repeat_turbulence

EXPERIMENTS: Mapping[str, Callable[[], Experiment]] = {
    "multifrequency": repeat_multifrequency,
    "dynamic": repeat_dynamic,
    "turbulence": repeat_turbulence,
}


@click.command()
@click.argument("names", nargs=-1, metavar="[NAME...]", type=click.Choice(list(EXPERIMENTS)))
@click.option("--json", "json_file", metavar="FILE", help="Write the results as JSON (- is stdout).")
def main(names: Sequence[str], json_file: str | None) -> None:
    """Repeat the paper's experiments (Section III): multifrequency, dynamic, turbulence; without a name all."""
    found = {name: EXPERIMENTS[name]() for name in names or EXPERIMENTS}
    if json_file is None:
        click.echo(write_page(list(found.values())), nl=False)
        return
    made = provenance.provenance(provenance.command())
    whole = {n: e.as_json() for n, e in found.items()} | {"provenance": made}
    text = json.dumps(whole, indent=1, allow_nan=False) + "\n"
    if json_file == "-":
        click.echo(text, nl=False)
    else:
        write_text(Path(json_file), text)


if __name__ == "__main__":
    try:
        main(prog_name="python -m ragg_runtime.experiments")
    except UserError as problem:
        click.echo(f"error: {problem.message}", err=True)
        sys.exit(2)
