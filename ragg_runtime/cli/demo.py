"""The main job on a flight of the numerical reference with a hidden effect: compare, diagnose, add (``ragg demo``)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.shared import next_command, notes_of
from ragg_runtime.identification.parameters import ParameterValue
from ragg_runtime.io import write_flight
from ragg_runtime.report.page import Origin
from ragg_runtime.report.pages import add_page, diagnose_page
from ragg_runtime.simulate import simulated
from ragg_runtime.wording import describe, numbers
from ragg_runtime.wording.sections import Section, render_text

HIDDEN = ("thermal-scale", "dK1_dT", (0.0, 0.0, 6e-8, 0.0))
"""What is hidden in the flight: effect, parameter, its values in A1 ... A4, 1/K."""

COMBINATIONS = {"Sigma": (1, 1, 1, 1), "D1234": (1, 1, -1, -1), "D12": (1, -1, 0, 0), "D34": (0, 0, 1, -1)}


def make_flight(path: Path) -> None:
    """Write the flight: twelve minutes at 1 g in turbulence, with a temperature-dependent scale factor in A3."""
    effect, name, values = HIDDEN
    hidden = f"{effect}:{name}={'/'.join(f'{x:g}' for x in values)}"
    write_flight(simulated(api.example(), [hidden], seed=2026, duration=720.0, rate=16.0), path)


def _recovered(parameters: Sequence[ParameterValue]) -> list[str]:
    """What was hidden beside what was found: of the combination of accelerometers that the record determines best."""
    effect, _, values = HIDDEN
    q = max(parameters, key=lambda q: abs(q.value) / q.std if q.std else 0.0)
    weights = COMBINATIONS[q.name.split()[0]]
    true = sum(w * x for w, x in zip(weights, values, strict=True))
    return [
        f"hidden:    {effect}: {describe.parameter_label(q.as_json())} = {numbers.with_unit(numbers.number(true, 2), q.unit)}",
        f"recovered: {effect}: {describe.parameter_line(q.as_json())}",
    ]


def _show(command: str, sections: tuple[Section, ...] = ()) -> None:
    print(f"\n\033[1m$ {command}\033[0m", flush=True)
    if sections:
        print(render_text(sections))


def main(output: Path, flight: Path | None = None, command: str = "ragg demo") -> Path:
    """Run the loop in ``output``, which must not exist, on ``flight`` (else one is made); returns the report."""
    if output.exists():
        raise UserError("the folder exists already", where=output, remedy="choose another with --output")
    output.mkdir(parents=True)
    if flight is None:
        flight = output / "flight.parquet"
        make_flight(flight)

    model = output / "model"
    _show(f"ragg new {model}")
    m = api.new(model)
    flights = api.read_flights(m, [flight])

    check = next_command("diagnose", model, flights)
    before = api.compare(m, flights).as_json()
    said = describe.describe_comparison(before, [x.name for x in flights], check)
    _show(next_command("compare", model, flights), (*said, *notes_of(flights)))

    diagnosis = api.diagnose(m, flights)
    then = next_command("add", model, flights, None, diagnosis.found[0]) if diagnosis.found else ""
    _show(check, describe.describe_diagnosis(diagnosis.as_json(), then))
    origin = Origin("Demonstration: diagnosis", command, api.sources(m, flights))
    (output / "diagnosis.html").write_text(diagnose_page(diagnosis, origin), "utf-8")
    if diagnosis.verdict != "missing-effect":
        raise UserError("the demonstration did not find the hidden effect", found=diagnosis.verdict)

    for effect in diagnosis.found:
        result = api.add(m, effect, flights)
        m = result.loaded
        said = describe.describe_addition(result.as_json(), [e.id for e in m.model.effects])
        _show(next_command("add", model, flights, effect=effect), said)
    assert result.before is not None
    assert result.after is not None

    steps = [s.as_json() for s in m.directory.history]
    _show(f"ragg history {model}", describe.describe_history(steps))
    origin = Origin("Demonstration: the effect added", command, api.sources(m, flights))
    report = output / "report.html"
    report.write_text(add_page(steps, result.before, result.after, origin, diagnosis), "utf-8")
    last = (
        *_recovered(result.combinations),
        f"Reports: {output / 'diagnosis.html'}  {report}",
        f"In a browser: ragg studio {model} {flight}",
    )
    print(f"\n{render_text([Section(sentences=last)])}")
    return report
