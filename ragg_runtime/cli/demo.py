"""The main job on a flight of the numerical reference with a hidden effect: compare, diagnose, add (``ragg demo``)."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import cli
from ragg_runtime.io import write_flight
from ragg_runtime.simulate import simulate_flight
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import Section, render_text

HIDDEN = ("thermal-scale", "dK1_dT", (0.0, 0.0, 6e-8, 0.0))
"""What is hidden in the flight: effect, parameter, its values in A1 ... A4, 1/K."""


def make_flight(path: Path) -> None:
    """Write the flight: twelve minutes at 1 g in turbulence, with a temperature-dependent scale factor in A3."""
    effect, name, values = HIDDEN
    hidden = f"{effect}:{name}={'/'.join(f'{x:g}' for x in values)}"
    write_flight(
        simulate_flight(api.example(), [hidden], seed=2026, instrument_seed=2026, duration=720.0, rate=16.0),
        path,
    )


def run_demo(output: Path, flight: Path | None = None) -> None:
    """Run the commands of the loop in ``output``, which must not exist, on ``flight`` (else one is made)."""
    if output.exists():
        raise UserError("the folder exists already", where=output, remedy="choose another with --output")
    output.mkdir(parents=True)
    if flight is None:
        flight = output / "flight.parquet"
        make_flight(flight)
    model, report, diagnosis, added = (
        str(output / name) for name in ("model", "report.html", "diagnosis.html", "added.json")
    )
    _run("new", model)
    _run("compare", model, str(flight))
    _run("diagnose", model, str(flight), "--report", diagnosis)
    _run("add", model, HIDDEN[0], str(flight), "--report", report, "--json", added)
    _run("history", model)
    said = (
        *_recovered(json.loads(Path(added).read_text("utf-8"))),
        f"Reports: {diagnosis}  {report}",
        f"In a browser: ragg studio {model} {flight}",
    )
    click.echo(f"\n{render_text([Section(sentences=said)])}")


def _run(*words: str) -> None:
    click.echo(f"\n\033[1m$ ragg {' '.join(words)}\033[0m")
    cli.main(args=list(words), prog_name="ragg", standalone_mode=False, obj=list(words))


def _recovered(added: Mapping[str, Any]) -> list[str]:
    """What was hidden and what was found, of the combination of accelerometers that the record determines best."""
    effect, _, values = HIDDEN
    q = max(added["combinations"], key=describe.significance)
    true = sum(w * x for w, x in zip(q["weights"], values, strict=True))
    return [
        f"hidden:    {effect}: {describe.label_parameter(q)} = {numbers.with_unit(numbers.number(true, 2), q['unit'])}",
        f"recovered: {effect}: {describe.write_parameter(q)}",
    ]
