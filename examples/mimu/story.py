"""What the page on real measurements (docs/explanation/real-measurements.md) computes, from the record beside this file."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from examples.mimu.sheet import sheet
from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight
from ragg_runtime.io.record import ANGULAR_RATE
from ragg_runtime.model import derive

Array = NDArray[np.float64]

HERE = Path(__file__).parent
RADIUS = 13.364
"""mm."""

UNLIFTED = sheet(height="0 mm", lift="10")
"""A sheet that knows nothing of the 2 mm between the two sides of the board, and not that it does not."""

FLAT = sheet(height="0 mm", lift="0.3")
"""One that is sure, to 0.3 degrees, that they are in one plane."""

SHORT = 1.4
"""mm by which a sheet that is sure of its radius (to 0.02 mm) has it too small."""

MISREAD = 1.03
"""Factor on all rates, as of one who takes 15.9 counts per deg/s where the chip gives 16.4."""


def short_arm(height: str | Sequence[str] = "0 mm") -> str:
    """A sheet whose radius is too small by :data:`SHORT`."""
    return sheet(height=height, lift="10", radius=f"{RADIUS - SHORT:.5g} mm", arm="0.02")


def sure_of_angles(text: str) -> str:
    """A sheet that is sure of its angles to 0.02 degrees."""
    return re.sub(r"((?:beta_z|vartheta_.) = .*?sigma = )3", r"\g<1>0.02", text)


def flights(
    i: Instrument, motion: Path, misread: float = 1.0, rests: Path = HERE / "rests.parquet"
) -> list[Flight]:
    """Rests and motion, the rates times a factor; channels of the motion alone are zero at rest."""
    lying, moved = (read_flight(p, i.g0, accelerometers=i.layout) for p in (rests, motion))
    still = {n: np.zeros(len(lying)) for n in moved.channels if n not in lying.channels}
    lying = replace(lying, channels={**lying.channels, **still})
    return [
        replace(x, channels={n: v * misread if n in ANGULAR_RATE else v for n, v in x.channels.items()})
        for x in (lying, moved)
    ]


def calibrated(text: str, *effects: str) -> tuple[Array, Array]:
    """Arms and lifts, each values and uncertainties (2, 4), mm, of a calibration with these effects in the model beside its own."""
    i = parse_instrument(text)
    i = replace(i, effects=(*i.effects, *(EffectSetting(e) for e in effects)))
    model = derive.load_model(i, candidates=False)
    f = fit(model, i, observe_flights(flights(i, HERE / "motion.parquet"), i))
    c = f.calibration
    std = np.sqrt(np.diag(c.covariance)) * np.array([q.scale for q in c.columns])

    def of(name: str, factor: float) -> Array:
        at = [n for n, q in enumerate(c.columns) if q.name == name]
        return factor * np.array([c.p[c.index[at]], std[at]])

    return of("dR", 1e3) + np.array([[f.instrument.radius * 1e3], [0.0]]), of("beta_x", RADIUS)


def diagnosed(text: str) -> Diagnosis:
    """What ``ragg diagnose`` says of rests and motion."""
    i = parse_instrument(text)
    return diagnosed_of(i, flights(i, HERE / "motion.parquet"))


def diagnosed_of(i: Instrument, both: Sequence[Flight]) -> Diagnosis:
    """The same of any flights of the array."""
    return diagnose(derive.load_model(i), i, both, partial(derive.with_effects, i))


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def known() -> str:
    """What is known from elsewhere, beside what the fit says."""

    def four(x: Array) -> str:
        return ", ".join(f"{v:.2f} ± {s:.2f}" for v, s in x.T) + " mm"

    (arm, lift), (later, _) = calibrated(UNLIFTED), calibrated(UNLIFTED, "gyro-delay")
    return table(
        ("quantity", "found", "known"),
        (
            ("arms A1 ... A4, sheet 13.364 ± 0.5 mm", four(arm), "13.364 mm (survey)"),
            ("the same, `gyro-delay` in the model", four(later), "13.364 mm"),
            ("front above back, as height of each (sheet: 0)", four(lift), "2.00 mm"),
        ),
    )


def ranked(d: Diagnosis, most: int = 4) -> str:
    """What a diagnosis ranks first, its verdict, and what it finds left over."""
    rows = [
        (
            f"`{r.effect}`",
            f"{r.log_p / np.log(10.0):.0f}" if np.isfinite(r.log_p) else "certain",
            ", ".join(
                f"{q.name} = {q.value:.2g} ± {q.std:.1g} {q.unit.removesuffix('1')}".rstrip()
                for q in r.parameters[:3]
            ),
        )
        for r in d.ranking[:most]
    ]
    said = f"\n\nVerdict: `{d.verdict}`" + (f", {', '.join(d.found)}" if d.found else "")
    left = [f"{x['harmonic']} × `{x['term']}`" for x in d.terms()[:3]] if d.verdict == "unexplained" else []
    more = [f"left over: {', '.join(left)}"] if left else []
    return table(("effect", "log10 p", "parameters"), rows) + "; ".join([said, *more]) + "."
