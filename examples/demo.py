"""``ragg demo`` on the flight that ships with the project: ``make demo``."""

from __future__ import annotations

import shutil
from pathlib import Path

from ragg_runtime.cli.model_commands import run_demo

OUTPUT = Path("demo-output")

if __name__ == "__main__":
    if OUTPUT.exists():
        shutil.rmtree(OUTPUT)
    run_demo(OUTPUT, Path(__file__).parent / "demo-flight.parquet")
