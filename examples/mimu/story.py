"""The page on real measurements: everything on it is computed here, from the record beside this file.

python -m examples.mimu.story [ROOT]
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from jinja2 import Template
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

from examples.mimu.record import G0
from examples.mimu.sheet import sheet
from ragg_runtime.diagnosis.diagnose import diagnose
from ragg_runtime.diagnosis.result import Diagnosis
from ragg_runtime.fit.fitted import Fitted, fit
from ragg_runtime.fit.observation import observations_of
from ragg_runtime.flight import read_flight
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model.model import Model
from ragg_runtime.model_dir import derive

Array = NDArray[np.float64]

HERE = Path(__file__).parent
RADIUS = 13.364
"""mm."""


@dataclass(frozen=True)
class Found:
    """A calibration on rests and motion.

    ``rms`` of the rests' and of the motion's G_out, m/s^2; ``arm`` and ``lift`` values and uncertainties (2, 4), mm;
    ``effect`` parameter -> value and uncertainty, in its display unit.
    """

    fitted: Fitted
    rms: tuple[float, ...]
    arm: Array
    lift: Array
    effect: dict[str, tuple[float, float]]


def calibrated(text: str, effects: tuple[str, ...] = (), motion: Path = HERE / "motion.parquet") -> Found:
    """Calibrate a sheet, with these effects in the model."""
    i = parse_instrument(text)
    k = derive.known(i)
    model, _ = derive.derived(tuple(k.get(e) for e in effects), (), i.form, i.layout)
    i = i.with_effects(tuple(EffectSetting(e) for e in effects))
    paths = (HERE / "rests.parquet", motion)
    f = fit(model, i, observations_of([read_flight(p, i.g0, accelerometers=i.layout) for p in paths], i))
    c = f.calibration
    std = np.sqrt(np.diag(c.covariance)) * np.array([q.scale for q in c.columns])

    def of(name: str, factor: float) -> Array:
        at = [n for n, q in enumerate(c.columns) if q.name == name]
        return factor * np.array([c.p[c.index[at]], std[at]])

    own = [n for n, q in enumerate(c.columns) if q.effect]
    (scored,) = f.score([np.zeros(f.size)])
    return Found(
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


def diagnosed(text: str) -> Diagnosis:
    """What ``ragg diagnose`` says of rests and motion."""
    i = parse_instrument(text)
    flights = [read_flight(HERE / f"{n}.parquet", i.g0, accelerometers=i.layout) for n in ("rests", "motion")]

    def extended(model: Model, ids: object, /, *, candidates: bool = False) -> Model:
        return derive.with_effects(i, model, tuple(ids), candidates=candidates)  # type: ignore[call-overload]

    return diagnose(derive.model_of(i), i, flights, extended)


BESIDE = 1
"""Samples on either side of a saturated one at which a derivative would be a guess."""


def without_acceleration(folder: Path) -> Path:
    """The motion without the measured angular acceleration: the reader then derives it from the rate.

    It is given a fair chance: samples beside saturated ones are left out.
    """
    table = pq.read_table(HERE / "motion.parquet")
    guessed = binary_dilation(np.isnan(table["omega_x"].to_numpy()), np.ones(2 * BESIDE + 1))
    for n in [n for n in table.column_names if n.startswith("V_")]:
        values = pa.array(np.where(guessed, np.nan, table[n].to_numpy()))
        table = table.set_column(table.column_names.index(n), table.schema.field(n), values)
    path = folder / "derived.parquet"
    pq.write_table(table.select([n for n in table.column_names if not n.startswith("omegadot")]), path)
    return path


def residuals(found: Found) -> list[Array]:
    """What is left of the motion's voltages, each by itself, m/s^2."""
    (piece,) = found.fitted.flown[1].each(lambda p: p)
    return [G0 * e[piece.observation.record.valid] for e in piece.residual]


def figure(cases: dict[str, Found], path: Path) -> None:
    """How large what is left is: sorted sizes of the voltages' residuals, of each case."""
    fig = Figure(figsize=(7.0, 3.4), layout="constrained")
    left, right = fig.subplots(1, 2)
    for name, found in cases.items():
        e = np.sort(np.abs(np.concatenate(residuals(found))))
        left.loglog(e, 1 - np.arange(len(e)) / len(e), label=name, lw=1.4)
    left.set(xlabel="|residual| of a voltage, m/s²", ylabel="share above", xlim=(1e-2, 100), ylim=(1e-3, 1))
    left.legend(fontsize=7, frameon=False)
    for n, (name, found) in enumerate(cases.items()):
        if "derived" in name:
            continue
        x = np.arange(4) + 0.18 * n
        right.errorbar(x - 0.27, found.arm[0], 3 * found.arm[1], fmt="o", ms=3, lw=1, color=f"C{n}")
    right.axhline(RADIUS, color="0.5", lw=0.8)
    right.set(xticks=range(4), xticklabels=["A1", "A2", "A3", "A4"], ylabel="arm, mm (bars: 3 sigma)")
    right.text(0.5, RADIUS, "survey", fontsize=7, color="0.4", ha="center", va="bottom")
    fig.savefig(path, dpi=140, metadata={"Software": None})


def pm(value: float, std: float, digits: int = 2) -> str:
    return f"{value:.{digits}f} ± {std:.{digits}f}"


def main(root: Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        derived = calibrated(sheet(), motion=without_acceleration(Path(folder)))
    survey = calibrated(sheet())
    delay = calibrated(sheet(), ("gyro-delay",))
    unlifted = calibrated(sheet(height="0 mm", lift="10"))
    lever = calibrated(sheet(height="0 mm", lift="0.3"), ("imu-lever-arm", "gyro-delay"))
    arm = calibrated(sheet(radius="12 mm", arm="2"))
    told = diagnosed(sheet(height="0 mm", lift="0.3"))
    cases = {
        "angular acceleration derived": derived,
        "measured by the back": survey,
        "and gyro-delay": delay,
    }
    figure(cases, root / "docs" / "real-measurements.png")
    sizes = {n: np.concatenate(residuals(f)) for n, f in cases.items()}
    page = Template((HERE / "page.md.j2").read_text("utf-8"), trim_blocks=True, lstrip_blocks=True).render(
        pm=pm,
        rms={n: float(np.sqrt(np.mean(e**2))) for n, e in sizes.items()},
        median={n: float(np.median(np.abs(e))) for n, e in sizes.items()},
        derived=derived,
        survey=survey,
        delay=delay,
        unlifted=unlifted,
        lever=lever,
        arm=arm,
        told=told,
        terms=told.terms(),
    )
    (root / "docs" / "real-measurements.md").write_text(page, "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE.parents[1])
