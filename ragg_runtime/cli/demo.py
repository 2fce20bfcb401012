"""The main job on a flight of the numerical reference with a hidden effect: compare, diagnose, add (``ragg demo``)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ragg_runtime.base.errors import UserError
from ragg_runtime.cli import terminal
from ragg_runtime.identification.parameters import ParameterValue
from ragg_runtime.io import write_flight
from ragg_runtime.report import in_words
from ragg_runtime.report.add_page import add_html
from ragg_runtime.report.diagnose_page import diagnose_html
from ragg_runtime.wording import notebook
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated

HIDDEN = ("thermal-scale", "dK1_dT", (0.0, 0.0, 6e-8, 0.0))
"""What is hidden in the flight: effect, parameter, its values in A1 ... A4, 1/K."""

COMBINATIONS = {"Sigma": (1, 1, 1, 1), "D1234": (1, 1, -1, -1), "D12": (1, -1, 0, 0), "D34": (0, 0, 1, -1)}


def make_flight(path: Path) -> None:
    """Write the flight: twelve minutes at 1 g in turbulence, with a temperature-dependent scale factor in A3."""
    effect, name, values = HIDDEN
    hidden = f"{effect}:{name}={'/'.join(f'{x:g}' for x in values)}"
    write_flight(simulated(loop.example(), [hidden], seed=2026, duration=720.0, rate=16.0), path)


def _recovered(parameters: Sequence[ParameterValue]) -> list[str]:
    """What was hidden beside what was found: of the combination of accelerometers that the record determines best."""
    effect, _, values = HIDDEN
    q = max(parameters, key=lambda q: abs(q.value) / q.std if q.std else 0.0)
    weights = COMBINATIONS[q.name.split()[0]]
    true = sum(w * x for w, x in zip(weights, values, strict=True))
    return [
        f"hidden:    {effect}: {q.name} = {true:.4g} {q.unit}",
        f"recovered: {effect}: {notebook.parameter(q.as_json() | {'weights': ()})}",
    ]


def _say(command: str) -> None:
    print(f"\n\033[1m$ {command}\033[0m", flush=True)


def main(output: Path, flight: Path | None = None, command: str = "ragg demo") -> Path:
    """Run the loop in ``output``, which must not exist, on ``flight`` (else one is made); returns the report."""
    if output.exists():
        raise UserError("the folder exists already", where=output, remedy="choose another with --output")
    output.mkdir(parents=True)
    if flight is None:
        flight = output / "flight.parquet"
        make_flight(flight)

    model = output / "model"
    _say(f"ragg new {model}")
    m = loop.new(model)
    flights = loop.read_flights(m, [flight])

    check = terminal.command("diagnose", model, flights)
    _say(terminal.command("compare", model, flights))
    before = loop.compare(m, flights)
    print(terminal.with_notes(in_words.compared(before, [x.name for x in flights], check), flights))

    _say(check)
    diagnosis = loop.diagnose(m, flights)
    said = in_words.diagnosed(diagnosis, terminal.next_add(model, flights, None, diagnosis.found))
    print(terminal.with_notes(said, flights))
    origin = loop.sources(m, flights)
    page = diagnose_html(diagnosis, title="Demonstration: diagnosis", command=command, sources=origin)
    (output / "diagnosis.html").write_text(page, "utf-8")
    if diagnosis.verdict != "missing-effect":
        raise UserError("the demonstration did not find the hidden effect", found=diagnosis.verdict)

    for effect in diagnosis.found:
        _say(terminal.command("add", model, flights, effect=effect))
        result = loop.add(m, effect, flights)
        print(terminal.added(result, flights))
        m = result.loaded
    assert result.before is not None
    assert result.after is not None

    _say(f"ragg history {model}")
    steps = [s.as_json() for s in m.directory.history]
    print(in_words.history(steps))
    page = add_html(
        steps,
        result.before,
        result.after,
        diagnosis,
        title="Demonstration: the effect added",
        command=command,
        sources=loop.sources(m, flights),
    )
    report = output / "report.html"
    report.write_text(page, "utf-8")
    fell = f"{result.before.calibrated.rms_Eo:.3g} Eo to {result.after.calibrated.rms_Eo:.3g} Eo"
    print("\n" + "\n".join(_recovered(result.combinations)))
    print(f"The error fell from {fell}; the noise is {result.after.noise_floor:.3g} Eo.")
    print(f"Reports: {output / 'diagnosis.html'}  {report}")
    print(f"To see and touch all this: ragg studio {model} {flight}   (from a clone: make studio)")
    return report
