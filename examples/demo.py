"""``ragg demo`` on the flight that ships with the project: ``make demo``."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

from ragg_runtime.cli.model_commands import make_flight, run_demo

FLIGHT = Path(__file__).parent / "demo-flight.parquet"

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, default=Path("demo-output"))
    parser.add_argument("--make-flight", action="store_true", help="make the shipped flight again")
    arguments = parser.parse_args()
    if arguments.make_flight:
        make_flight(FLIGHT)
    else:
        if arguments.output.exists():
            shutil.rmtree(arguments.output)
        run_demo(arguments.output, FLIGHT)
