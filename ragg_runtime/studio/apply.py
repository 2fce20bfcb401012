"""What a model is for: compensated channels of the flights that are open, with their band, and quality control of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import scratch
from ragg_runtime.compensation.compensate import Kind, without_gradients
from ragg_runtime.compensation.output import writing
from ragg_runtime.compensation.series import MEANING
from ragg_runtime.flight import Flight
from ragg_runtime.report.quality_page import quality_html
from ragg_runtime.signals.demodulators import DEMODULATORS
from ragg_runtime.studio.pyramid import Pyramid, pyramid
from ragg_runtime.survey.quality.lines import SurveyLine, read_lines
from ragg_runtime.survey.quality.qc import Quality, qc
from ragg_runtime.wording import numbers
from ragg_runtime.workflow import after
from ragg_runtime.workflow.after import Compensation
from ragg_runtime.workflow.loop import Loaded, mapping_of

Array = NDArray[np.float64]

BESIDE = (
    "easting",
    "northing",
    "latitude",
    "longitude",
    "altitude",
    "temperature",
    "a_z",
    "vertical_velocity",
)
"""Channels of a flight that quality control looks at beside the gradients."""


def compensated(m: Loaded, flights: Sequence[Flight], kind: str, demodulator: str) -> Compensation:
    """As ``ragg compensate``; nothing of a recorded gradient gets into it."""
    for given, known in ((kind, get_args(Kind)), (demodulator, DEMODULATORS)):
        if given not in known:
            raise UserError("there is no such choice", found=given[:40], expected=", ".join(known))
    if not flights:
        raise UserError("no flight is open", remedy="choose one first")
    bare = [without_gradients(x) for x in flights]
    return after.compensate(m, bare, kind, demodulator)  # type: ignore[arg-type]


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
    with scratch() as folder:
        path = Path(folder, name)
        with writing(path, sum(len(x["time"]) for x in c.series), c.units) as write:
            for rows in c.series:
                write(rows)
        return path.read_bytes()


def lines_of(m: Loaded, paths: Sequence[Path]) -> tuple[SurveyLine, ...]:
    """What the files hold as lines of a survey, which need no motion; nothing if they are none."""
    try:
        return read_lines(paths, mapping_of(m, None)).lines
    except UserError:
        return ()


def channel(x: SurveyLine, unit: str) -> Pyramid:
    """The channel of a line that this unit asks for, else its first, Eo."""
    y = x.channels[unit if unit in x.gradients else x.gradients[0]]
    return pyramid(0.0, 1.0 / x.rate, len(y), lambda s: y[s])


def quality(m: Loaded, paths: Sequence[Path], flights: Sequence[Flight], c: Compensation | None) -> Quality:
    """As ``ragg qc`` of the files, if they hold demodulated channels; else of what compensation made of them."""
    if paths and all("inline" in x.outputs for x in flights):
        return qc(list(dict.fromkeys(paths)), mapping_of(m, None))
    if c is None:
        raise UserError(
            "these flights hold no demodulated channels yet",
            expected="inline and cross",
            remedy="compensate them first",
        )
    with scratch() as folder:
        pairs = zip(flights, c.series, strict=True)
        return qc([_line(Path(folder, str(k)), x, rows, c) for k, (x, rows) in enumerate(pairs)])


def _line(folder: Path, x: Flight, rows: Mapping[str, NDArray[Any]], c: Compensation) -> Path:
    """A compensated flight as a line of a survey: its gradients, and what was recorded beside them."""
    known = [n for n in c.units if n == "time" or (c.units[n] == "Eo" and f"{n}_std" in c.units)]
    beside = {n: x.channels[n] for n in BESIDE if n in x.channels}
    units = {n: c.units[n] for n in known} | {n: x.units[n] for n in beside}
    name = "".join(k if k.isalnum() or k in "-_ ." else "_" for k in x.name)[:80].lstrip(".") or "flight"
    folder.mkdir()
    path = folder / f"{name}.parquet"
    with writing(path, len(rows["time"]), units) as write:
        write({n: rows[n] for n in known} | beside)
    return path


def shown_compensation(c: Compensation) -> dict[str, Any]:
    """What the page says of it, in the digits of the terminal."""
    r = c.as_json()
    meaning = {str(q.name): text for q, text in MEANING.items()}
    return {
        "calibration": r["calibration"],
        "converged": r["converged"],
        "demodulator": r["demodulator"],
        "channels": [n for n, unit in c.units.items() if unit == "Eo" and f"{n}_std" in c.units],
        "outputs": [_output(x, meaning) for x in r["flights"]],
        "count": len(c.series),
    }


def _output(x: Mapping[str, Any], meaning: Mapping[str, str]) -> dict[str, Any]:
    density = [x["density"][k] for k in ("before", "after", "noise")]
    return {
        "flight": numbers.clean(str(x["flight"])),
        "output": numbers.clean(str(x["output"])),
        "samples": x["samples"],
        "good": x["good"],
        "rows": [
            [c, *(numbers.number(d.get(f"{c}_Eo_per_rtHz")) for d in density)] for c in ("inline", "cross")
        ],
        "quality": [[count, meaning[name]] for name, count in x["quality"].items() if count],
        "contributions": [
            [numbers.clean(str(t["of"])), numbers.number(t["inline_Eo"]), numbers.number(t["cross_Eo"])]
            for t in x["contributions"]
        ],
    }


def quality_page(q: Quality, title: str, command: str) -> bytes:
    return quality_html(q, title=title, command=command).encode()
