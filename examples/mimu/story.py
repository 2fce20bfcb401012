"""What the page on real measurements (docs/explanation/real-measurements.md) computes, from the record beside this file."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
from numpy.typing import NDArray
from scipy.optimize import least_squares

from examples.mimu.record import G0
from examples.mimu.sheet import sheet
from ragg_runtime.estimation.fitted import Fitted, fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.instrument.instrument import EffectSetting, Instrument
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight
from ragg_runtime.io.record import ANGULAR_RATE
from ragg_runtime.model import derive

Array = NDArray[np.float64]

HERE = Path(__file__).parent
RADIUS = 13.364
"""mm."""


@dataclass(frozen=True)
class RestCalibration:
    """A calibration on rests and motion.

    ``rms`` of the rests' and of the motion's G_out, m/s^2; ``arm`` and ``lift`` values and uncertainties (2, 4), mm;
    ``effect`` parameter -> value and uncertainty, in its display unit.
    """

    fitted: Fitted
    rms: tuple[float, ...]
    arm: Array
    lift: Array
    effect: dict[str, tuple[float, float]]


UNLIFTED = sheet(height="0 mm", lift="10")
"""A sheet that knows nothing of the 2 mm between the two sides of the board, and not that it does not."""


def sure_of_angles(text: str) -> str:
    """A sheet that is sure of its angles to 0.02 degrees."""
    return re.sub(r"((?:beta_z|vartheta_.) = .*?sigma = )3", r"\g<1>0.02", text)


SHORT = 1.4
"""mm by which a sheet that is sure of its radius (to 0.02 mm) has it too small."""

LEFT_OUT: Mapping[str, str] = {
    "lever arm": sheet(height="0 mm", lift="0.3"),
    "arm length": sheet(height="0 mm", lift="10", radius=f"{RADIUS - SHORT:.5g} mm", arm="0.02"),
    "misalignments": sure_of_angles(UNLIFTED),
    "gyro scale": UNLIFTED,
}
"""Sheets in which something is left out, and that are sure of it. With the last the rates are read with :data:`MISREAD`."""

MISREAD = 1.03
"""Factor on all rates, as of one who takes 15.9 counts per deg/s where the chip gives 16.4."""


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


def calibrated(
    text: str, effects: tuple[str, ...] = (), motion: Path = HERE / "motion.parquet", misread: float = 1.0
) -> RestCalibration:
    """Calibrate a sheet, with these effects in the model beside its own."""
    i = parse_instrument(text)
    i = dataclasses.replace(i, effects=(*i.effects, *(EffectSetting(e) for e in effects)))
    model = derive.derive_without_signatures(i, i.form)
    f = fit(model, i, observe_flights(flights(i, motion, misread), i))
    c = f.calibration
    std = np.sqrt(np.diag(c.covariance)) * np.array([q.scale for q in c.columns])

    def of(name: str, factor: float) -> Array:
        at = [n for n, q in enumerate(c.columns) if q.name == name]
        return factor * np.array([c.p[c.index[at]], std[at]])

    own = [n for n, q in enumerate(c.columns) if q.effect]
    (scored,) = f.score([np.zeros(f.size)])
    return RestCalibration(
        fitted=f,
        rms=tuple(G0 * float(np.sqrt(x)) for x in scored.mean_square),
        arm=of("dR", 1e3) + np.array([[f.instrument.radius * 1e3], [0.0]]),
        lift=of("beta_x", RADIUS),
        effect={
            c.columns[n].name: (
                float(c.p[c.index[n]] / c.columns[n].unit_factor),
                float(std[n] / c.columns[n].unit_factor),
            )
            for n in own
        },
    )


def diagnosed(text: str, misread: float = 1.0, motion: Path = HERE / "motion.parquet") -> Diagnosis:
    """What ``ragg diagnose`` says of rests and motion."""
    i = parse_instrument(text)
    return diagnosed_of(i, flights(i, motion, misread))


def diagnosed_of(i: Instrument, both: Sequence[Flight]) -> Diagnosis:
    """The same of any flights of the array."""
    return diagnose(derive.load_model(i), i, both, partial(derive.with_effects, i))


TOLERANCE = 0.03
"""Of a chip's scale by its data sheet (InvenSense MPU-9150, initial calibration), relative."""

CHIPS = 4
"""Whose mean is the specific force of the record, along each axis."""


def gravity() -> tuple[float, float, float]:
    """g, m/s^2, by the rests: the mean of three axes, what the data sheet leaves open of it, and the scatter of the axes.

    The rests tell the scale of the axes against each other and their biases (an ellipsoid becomes a sphere); how long
    its radius is in m/s^2, the chips' scale alone says.
    """
    table = pq.read_table(HERE / "rests.parquet")
    force = np.stack([table[f"a_{k}"].to_numpy() for k in "xyz"], axis=1)
    force = force[np.isfinite(np.stack([table[f"V_{j}"].to_numpy() for j in range(1, 5)])).all(axis=0)]

    def off(p: Array) -> Array:
        shape = np.array([[p[3], p[6], p[7]], [0.0, p[4], p[8]], [0.0, 0.0, p[5]]])
        return np.asarray(np.linalg.norm((force - p[:3]) @ shape.T, axis=1) - G0)

    gains = least_squares(off, np.array([0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0])).x[3:6]
    axes = G0 / gains
    g = float(np.mean(axes))
    return g, g * TOLERANCE / float(np.sqrt(3 * CHIPS)), float(np.std(axes, ddof=1))


def pm(value: float, std: float, digits: int = 2) -> str:
    return f"{value:.{digits}f} ± {std:.{digits}f}"


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def known(unlifted: RestCalibration, delayed: RestCalibration) -> str:
    """What is known from elsewhere, beside what the fit says."""

    def four(x: Array) -> str:
        return ", ".join(pm(v, s) for v, s in x.T) + " mm"

    g, open_, scatter = gravity()
    return table(
        ("quantity", "found", "known"),
        (
            ("arms A1 ... A4, sheet 13.364 ± 0.5 mm", four(unlifted.arm), "13.364 mm (survey)"),
            ("the same, `gyro-delay` in the model", four(delayed.arm), "13.364 mm"),
            ("front above back, as height of each (sheet: 0)", four(unlifted.lift), "2.00 mm"),
            ("g, from the rests", f"{pm(g, open_)} m/s² (axes scatter by {scatter:.2f})", "9.82 m/s²"),
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
