"""What a model is for: compensated channels of the flights that are open, with their band."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight import Flight
from ragg_runtime.studio.tracks import Pyramid, pyramid
from ragg_runtime.wording import numbers
from ragg_runtime.workflow import after
from ragg_runtime.workflow.after import Compensation
from ragg_runtime.workflow.loop import Loaded

Array = NDArray[np.float64]


def compensated(m: Loaded, flights: Sequence[Flight], kind: str, demodulator: str) -> Compensation:
    """As ``ragg compensate``."""
    if not flights:
        raise UserError("no flight is open", remedy="choose one first")
    return after.compensate(m, flights, kind, demodulator)  # type: ignore[arg-type]


def kept(m: Loaded) -> str | None:
    """Where the calibration comes from that is kept with the model, or why it does not count; ``None``: there is none."""
    if m.directory.calibration is None:
        return None
    try:
        saved = after.saved_calibration(m)
    except UserError as e:
        return f"not used: {e.what}"
    return f"of {saved.time[:16].replace('T', ' ')} UTC, on {numbers.listed([numbers.clean(n) for n in saved.flights])}"


def curve(c: Compensation | None, what: str, flight: int) -> Pyramid:
    """``inline`` and such, or ``inline:low`` and ``inline:high``: one standard uncertainty below and above it, Eo."""
    name, _, edge = what.partition(":")
    if (
        c is None
        or not 0 <= flight < len(c.series)
        or f"{name}_std" not in c.units
        or edge not in ("", "low", "high")
    ):
        raise UserError("there is no such compensated channel", found=what[:40])
    x = c.series[flight]
    time, sign = x["time"], {"": 0.0, "low": -1.0, "high": 1.0}[edge]
    step = float(time[-1] - time[0]) / max(1, len(time) - 1)
    return pyramid(
        float(time[0]),
        step,
        len(time),
        lambda s: x[name][s] + sign * x[f"{name}_std"][s] if sign else x[name][s],
    )


def file_of(c: Compensation, name: str) -> bytes:
    """The series as CSV or Parquet, by the ending of the name."""
    with tempfile.TemporaryDirectory(prefix="ragg-") as folder:
        path = Path(folder, name)
        c.write(path)
        return path.read_bytes()


def shown_compensation(c: Compensation) -> dict[str, Any]:
    """What the page says of it, in the digits of the terminal."""
    r = c.as_json()
    return {
        "calibration": r["calibration"],
        "converged": r["converged"],
        "demodulator": r["demodulator"],
        "channels": [n for n, unit in c.units.items() if unit == "Eo" and f"{n}_std" in c.units],
        "outputs": [_output(x) for x in r["flights"]],
        "count": len(c.series),
    }


def _output(x: Mapping[str, Any]) -> dict[str, Any]:
    density = [x["density"][k] for k in ("before", "after", "noise")]
    return {
        "flight": numbers.clean(str(x["flight"])),
        "output": numbers.clean(str(x["output"])),
        "samples": x["samples"],
        "good": x["good"],
        "rows": [
            [c, *(numbers.number(d.get(f"{c}_Eo_per_rtHz")) for d in density)] for c in ("inline", "cross")
        ],
        "quality": [[count, after.QUALITY[name]] for name, count in x["quality"].items() if count],
        "contributions": [
            [numbers.clean(str(t["of"])), numbers.number(t["inline_Eo"]), numbers.number(t["cross_Eo"])]
            for t in x["contributions"]
        ],
    }
