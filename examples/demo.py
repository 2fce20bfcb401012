"""The main job, from a flight to a better model: compare, diagnose, add, and watch the error fall.

The flight was made by the numerical reference, which shares no equations with the derived models, with an
effect hidden in it (``make_flight``). Run it with ``make demo``.
"""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from ragg_runtime import texts, workflow
from ragg_runtime.errors import UserError
from ragg_runtime.flight import write_flight
from ragg_runtime.report import add_html, diagnose_html
from ragg_runtime.simulate import simulated

HERE = Path(__file__).parent
FLIGHT = HERE / "demo-flight.parquet"
HIDDEN = "thermal-scale:dK1_dT=0/0/6e-8/0"
COMMAND = "make demo"


def make_flight() -> None:
    """Make the shipped flight again: twelve minutes with a temperature-dependent scale factor in A3."""
    sheet = workflow.parse_instrument((HERE.parent / "ragg_runtime/example.toml").read_text("utf-8"))
    write_flight(simulated(sheet, [HIDDEN], seed=2026, duration=720.0, rate=16.0), FLIGHT)


def main(output: Path) -> Path:
    """Run the loop in ``output``; returns the report."""
    if output.exists():
        shutil.rmtree(output)
    output.mkdir(parents=True)

    def say(text: str) -> None:
        print(f"\n\033[1m$ {text}\033[0m", flush=True)

    model = output / "model"
    say(f"ragg new {model}")
    m = workflow.new(model)
    flights = workflow.read_flights(m, [FLIGHT])

    say(f"ragg compare {model} {FLIGHT.name}")
    before = workflow.compare(m, flights)
    print(texts.compared(before, flights))

    say(f"ragg diagnose {model} {FLIGHT.name}")
    diagnosis = workflow.diagnose(m, flights)
    print(texts.diagnosed(diagnosis, model))
    origin = workflow.sources(m, flights)
    page = diagnose_html(diagnosis, title="Demonstration: diagnosis", command=COMMAND, sources=origin)
    (output / "diagnosis.html").write_text(page, "utf-8")
    if diagnosis.verdict != "missing-effect":
        raise UserError("the demonstration did not find the hidden effect", found=diagnosis.verdict)

    for effect in diagnosis.found:
        say(f"ragg add {model} {effect} {FLIGHT.name}")
        result = workflow.add(m, effect, flights)
        print(texts.added(result))
        m = result.loaded
    assert result.before is not None
    assert result.after is not None

    say(f"ragg history {model}")
    steps = [s.as_json() for s in m.directory.history]
    print(texts.history(steps))
    page = add_html(
        steps,
        result.before,
        result.after,
        diagnosis,
        title="Demonstration: the effect added",
        command=COMMAND,
        sources=workflow.sources(m, flights),
    )
    report = output / "report.html"
    report.write_text(page, "utf-8")
    fell = f"{result.before.calibrated.rms_Eo:.3g} Eo to {result.after.calibrated.rms_Eo:.3g} Eo"
    print(f"\nThe error fell from {fell}; the noise is {result.after.noise_floor:.3g} Eo.")
    print(f"Reports: {output / 'diagnosis.html'}  {report}")
    return report


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, default=Path("demo-output"))
    parser.add_argument("--make-flight", action="store_true", help="make the shipped flight again")
    arguments = parser.parse_args()
    if arguments.make_flight:
        make_flight()
    else:
        main(arguments.output)
