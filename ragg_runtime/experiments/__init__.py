"""The three experiments of the paper's Section III, repeated: its printed values (Tables VI to VIII) beside ours.

M. Yu and T. Cai, *Mathematic Model And Error Analysis of Moving-base Rotating Accelerometer Gravity Gradiometer*. III.A: a point mass that
circles a perfect instrument; III.B and III.C: the imperfect instrument of Table V in regular motion and in the turbulence of Table VII.

Left open by the paper: vartheta_x (here 0); in III.A and III.B sampling (here 16 Hz; one round of the mass, 370 s; 64 turns), the
low-pass (here 0.2 Hz, 100 dB) and a test mass in III.B (here none); in III.C records (here of 600 s, several seeds) and sampling: 20 Hz
with central differences, a choice made *after* looking at Table VIII: of 10 to 50 Hz, central and backward differences, it alone
meets the four sigmas of the simplified model and the order of the angular acceleration (Section IV).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from generated import analytical, simplified
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.units import EOTVOS
from ragg_runtime.reference.gravity import PointMass
from ragg_runtime.reference.motion import MotionSignals, Sinusoids, disc_angle, still
from ragg_runtime.reference.scenario import perfect, table_v
from ragg_runtime.reference.simulate import Simulation, simulate
from ragg_runtime.signals.demodulators import Demodulated, demodulate
from ragg_runtime.wording.sections import make_environment

Array = NDArray[np.float64]

DEGREE_PER_HOUR = np.pi / 180 / 3600


@dataclass(frozen=True)
class Printed:
    """A number as the paper prints it: its digits, ``unit`` (empty for a pure number), section or table; ``order``: of
    magnitude only.
    """

    text: str
    unit: str
    where: str
    order: bool = False

    @property
    def value(self) -> float:
        """The number."""
        return float(self.text)

    def matches(self, ours: float) -> bool:
        """Whether ``ours`` has the printed digits, or the printed order of magnitude (a third of it up to ten times)."""
        if self.order:
            ratio = ours / self.value
            return ratio > 0.0 and -0.5 <= math.log10(ratio) < 1.0
        mantissa, _, exponent = self.text.partition("e")
        decimals = len(mantissa.partition(".")[2])
        return abs(ours - self.value) <= 0.5000001 * 10.0 ** (int(exponent or 0) - decimals)


MASS = 486.0  # kg, Section III.A
MASS_POSITION = (1.2, 0.0, 0.0)  # m, at the start
# angular rate of the mass: mean and amplitude in deg/h, and the angular frequency of the sine in rad/s
MASS_RATE = (3600.0, 360.0, 0.0628)

TABLE_VI: Mapping[str, tuple[float, float]] = {
    "a_x": (0.08, 0.005),
    "a_y": (0.06, 0.006),
    "a_z": (0.1, 0.05),
    "omega_x": (1000, 700),
    "omega_y": (1500, 900),
    "omega_z": (2000, 800),
}
"""Constant and amplitude of sin(Omega t): g for a, deg/h for omega."""

# mean and standard deviation of a_z, mg, and of each angular rate, deg/h
TABLE_VII = ((100.0, 10.0, 0.0, 0.0), (100.0, 10.0, 100.0, 50.0), (200.0, 10.0, 100.0, 50.0))
HORIZONTAL = 0.15  # Section III.C: rms of a_x and of a_y over that of a_z

_VIII = """
        M_in    M_cs    Ms_in   Ms_cs  sigma_in  sigma_cs  sigmas_in  sigmas_cs
    1   -0.037  -0.0004 -0.080  0.033  0.062     0.031     0.11       0.052
    2   -0.032  -0.001  -0.09   0.015  0.068     0.032     0.294      0.149
    3   -0.145  -0.001  -0.253  0.134  0.064     0.029     0.556      0.281
"""


def table_viii(experiment: int, name: str) -> Printed:
    """An entry of Table VIII, Eo, of experiment 1, 2 or 3: M and sigma of the analytical, Ms and sigmas of the simplified model."""
    heads, *rows = (line.split() for line in _VIII.strip().splitlines())
    return Printed(rows[experiment - 1][1 + heads.index(name)], "Eo", "Table VIII")


K_GGI = Printed("4.54e-4", "V/Eo", "Section III.B")
OUTPUT = Printed("1e5", "V", "Section III.B", order=True)
MODEL_ERROR = Printed("1e-3", "V", "Section III.B", order=True)
RELATIVE_ERROR = Printed("1e-8", "", "Section III.B", order=True)
GRADIENT_VOLTAGE = Printed("1e-2", "V", "Section III.B", order=True)

DYNAMIC: Mapping[tuple[str, str], Printed] = {
    ("analytical", "inline"): Printed("-0.72", "Eo", "Section III.B"),
    ("analytical", "cross"): Printed("0.56", "Eo", "Section III.B"),
    ("simplified", "inline"): Printed("-2.9", "Eo", "Section III.B"),
    ("simplified", "cross"): Printed("-0.99", "Eo", "Section III.B"),
}
"""Model errors after demodulation; the paper says "roughly"."""

DIFFERENCE: Mapping[str, Printed] = {
    "analytical": Printed("1e-3", "Eo", "Section III.A", order=True),
    "simplified": Printed("1e-3", "Eo", "Section III.A", order=True),
    "numerical": Printed("1e-1", "Eo", "Section III.A", order=True),
}
"""Differences of the demodulated outputs from the centre gradients."""


BANDWIDTH = 0.2  # Hz, by which the paper turns a standard deviation into a noise density

DENSITIES: tuple[tuple[str, int, Printed], ...] = (
    ("analytical", 1, Printed("0.13", "Eo/sqrt(Hz)", "Section III.C")),
    ("simplified", 1, Printed("0.25", "Eo/sqrt(Hz)", "Section III.C")),
    ("simplified", 2, Printed("0.66", "Eo/sqrt(Hz)", "Section III.C")),
    ("simplified", 3, Printed("1.24", "Eo/sqrt(Hz)", "Section III.C")),
)
"""Model, turbulence experiment, noise density of the inline channel."""


# --- the printed numbers beside ours -------------------------------------------------------------------


@dataclass(frozen=True)
class PrintedEntry:
    """A printed number beside ours, in the printed unit (the mean of several runs, ``spread`` their least and greatest)."""

    quantity: str
    printed: Printed
    ours: float
    spread: tuple[float, float] | None = None

    @property
    def agrees(self) -> bool:
        """Whether ours has the printed digits or order of magnitude, or the printed number lies between our runs."""
        inside = self.spread is not None and self.spread[0] <= self.printed.value <= self.spread[1]
        return inside or self.printed.matches(self.ours)


@dataclass(frozen=True)
class Experiment:
    """An experiment: its title, settings, the printed numbers beside ours, and why some differ."""

    title: str
    settings: Mapping[str, str]
    rows: tuple[PrintedEntry, ...]
    remarks: tuple[str, ...] = ()


# --- the experiments -----------------------------------------------------------------------------------

# Eq. 17-19 and Eq. 42-47, as derived.
DERIVED: dict[str, Any] = {"analytical": analytical, "simplified": simplified}
VARTHETA = (
    "The analytical model's error is second-order coefficients times angles (misalignments and mounting errors) alone, vartheta_x among "
    "them, which Table V does not give. With vartheta_x within 30 arcsec, the largest misalignment of Table V, each number that is printed "
    "of it can be had (1,000 draws; this is no proof that the paper had such angles)."
)


def predict(name: str, run: Simulation) -> Array:
    """G_out, (N,) V, of the ``analytical`` or ``simplified`` model, given the motion and gradients of a run."""
    model, sheet = DERIVED[name], run.instrument
    values = {"radius": [sheet.radius], "spin_frequency": [sheet.spin_frequency], **sheet.accelerometers}
    p = np.concatenate([values[q] for q, _ in model.PARAMETERS])
    return np.asarray(model.output(run.time, np.stack([run.channels[x] for x in model.INPUTS]), p))


def find_error(name: str, run: Simulation) -> Array:
    """Model error, (N,) V: output of the numerical model *minus* that of a derived one, which gives the paper's signs."""
    return np.asarray(run.G_out - predict(name, run))


def demodulate_run(G: Array, run: Simulation) -> Demodulated:
    """Inline and cross channel, here in Eo, of an output or an error (N,) V."""
    rate = float(1 / (run.time[1] - run.time[0]))
    phi = disc_angle(run.instrument.spin_frequency, run.time)
    d = demodulate(G, phi, rate, run.instrument.scale_factor)
    return d._replace(inline=d.inline / EOTVOS, cross=d.cross / EOTVOS)


def average_turns(G: Array, run: Simulation) -> tuple[float, float]:
    """Inline and cross channel, Eo, by ideal demodulation: the mean over the whole turns of a record."""
    turn = round(1 / (run.instrument.spin_frequency * (run.time[1] - run.time[0])))
    turns = slice(0, run.time.size // turn * turn)
    phi = disc_angle(run.instrument.spin_frequency, run.time[turns])
    g = G[turns] / (run.instrument.scale_factor * EOTVOS)
    return float(np.mean(4 * g * np.sin(2 * phi))), float(-np.mean(2 * g * np.cos(2 * phi)))


def find_largest(*x: Array) -> float:
    """The largest magnitude."""
    return float(max(np.abs(v).max() for v in x))


RATE = 16.0  # Hz, of III.A and III.B


# --- III.A: who measures the gradient at the centre? ----------------------------------------------------

MODELS = ("numerical", *DERIVED)
ROUND = 460.0  # s; the demodulator's low-pass takes about 65 s off


def repeat_multifrequency() -> Experiment:
    """Repeat the experiment."""
    mass = PointMass(MASS, _follow_mass)
    run = simulate(perfect(), still(), ROUND, RATE, gravity=mass, auxiliaries={})
    rows = [
        PrintedEntry(f"{name} minus centre, largest of both channels", DIFFERENCE[name], find_largest(*x))
        for name, x in subtract_centre(run).items()
    ]
    settings = {
        "instrument": "perfect: 10 mA/g, 1e9 ohm, R = 0.1 m, 0.25 Hz",
        "mass": "486 kg at 1.2 m, turning with 3600 + 360 sin(0.0628 t) deg/h",
        "record": f"{ROUND:g} s at {RATE:g} Hz (not stated in the paper)",
        "low-pass": "0.2 Hz, 100 dB (the paper: FIR, 0.2 Hz)",
    }
    title = "Multi-frequency gravitational gradient experiment (Section III.A)"
    remark = (
        "The derived models measure the centre gradient exactly; the rest is the ripple of the low-pass, which the paper does not "
        "state: stop bands of 40 to 100 dB reach the printed order."
    )
    return Experiment(title, settings, tuple(rows), (remark,))


def _follow_mass(time: Array) -> Array:
    """Position of the mass, (3, N) m: it turns about z with 3600 + 360 sin(0.0628 t) deg/h."""
    mean, amplitude, frequency = MASS_RATE
    angle = DEGREE_PER_HOUR * (mean * time + amplitude / frequency * (1 - np.cos(frequency * time)))
    return float(MASS_POSITION[0]) * np.stack([np.cos(angle), np.sin(angle), np.zeros(time.size)])


def subtract_centre(run: Simulation) -> Mapping[str, tuple[Array, Array]]:
    """Model -> inline and cross, Eo, as demodulated, minus the gradients at the centre."""
    gamma = {k: run.channels[f"Gamma_{k}"] * 1e9 for k in ("xx", "yy", "xy")}
    differences = {}
    for name in MODELS:
        c = demodulate_run(run.G_out if name == "numerical" else predict(name, run), run)
        xx, yy, xy = (x[c.valid] for x in gamma.values())
        differences[name] = c.inline - (xx - yy), c.cross - xy
    return differences


# --- III.B: regular motion -----------------------------------------------------------------------------

TURNS = 64

WITH_MASS = PointMass(MASS, MASS_POSITION)  # the test mass of Section III.A where it starts


def repeat_dynamic() -> Experiment:
    """Repeat the experiment."""
    run = run_regular(turns=TURNS)
    errors = {name: find_error(name, run) for name in DERIVED}
    gradient = find_largest(run_regular(gravity=WITH_MASS).G_out - run_regular().G_out)
    output = find_largest(run.G_out)
    rows = [
        PrintedEntry("k_ggi", K_GGI, run.instrument.scale_factor * EOTVOS),
        PrintedEntry("output before demodulation", OUTPUT, output),
    ]
    for name, error in errors.items():
        rows.append(PrintedEntry(f"{name} model error before demodulation", MODEL_ERROR, find_largest(error)))
    relative = find_largest(errors["analytical"]) / output
    rows.append(PrintedEntry("relative error of the analytical model", RELATIVE_ERROR, relative))
    rows.append(PrintedEntry("voltage of the gravitational gradient", GRADIENT_VOLTAGE, gradient))
    for name, error in errors.items():
        for channel, ours in zip(("inline", "cross"), average_turns(error, run), strict=True):
            rows.append(PrintedEntry(f"{name} model error, {channel}", DYNAMIC[name, channel], ours))
    settings = {
        "instrument": "Table V, R = 0.1 m, 0.25 Hz; vartheta_x = 0 (not stated), g = 9.8 m/s^2",
        "motion": "Table VI; angular acceleration is the derivative of the angular rate",
        "record": f"{TURNS} turns at {RATE:g} Hz (not stated)",
        "model error": "numerical minus model; first-order rotations; no mass near",
    }
    title = "Dynamic experiment (Section III.B, Tables V and VI)"
    remarks = (
        VARTHETA,
        "Analytical minus simplified follows from Eq. 17-19 and 42-47 with Tables V and VI alone, whatever the numerical model.",
        "No gradient is stated for this experiment.",
    )
    return Experiment(title, settings, tuple(rows), remarks)


def run_regular(instrument: Instrument | None = None, *, turns: int = 1, **settings: Any) -> Simulation:
    """The numerical model in the motion of Table VI; means over one turn are exact at 16 Hz. ``settings``: as of :func:`simulate`."""
    sheet = instrument or table_v()
    a_x, a_y, a_z, w_x, w_y, w_z = (
        Sinusoids(mean * unit, [amplitude * unit], [sheet.spin_frequency], [0.0])
        for name, (mean, amplitude) in TABLE_VI.items()
        for unit in [sheet.g0 if name.startswith("a") else DEGREE_PER_HOUR]
    )
    duration = float(np.rint(turns / sheet.spin_frequency))
    motion = MotionSignals((a_x, a_y, a_z), (w_x, w_y, w_z))
    return simulate(sheet, motion, duration, RATE, auxiliaries={}, **settings)


# --- III.C: turbulence ---------------------------------------------------------------------------------

SAMPLED, DURATION = 20.0, 600.0  # Hz and s

SEEDS = range(8)
EXPERIMENTS = (1, 2, 3)
MARKS = {"analytical": "", "simplified": "s"}
SHORT = {"inline": "in", "cross": "cs"}

_LABELS = {
    f"{symbol}{mark}_{short}": f"{symbol}, {channel}, {model}"
    for model, mark in MARKS.items()
    for symbol in ("M", "sigma")
    for channel, short in SHORT.items()
}
"""The entries of Table VIII."""

_NO_ANGULAR_MOTION = (
    "In experiment 1, without angular motion, the two models differ only by products of three misalignment angles, so the printed "
    "simplified model cannot have an error other than the analytical one's there. The excess of the printed cross mean over the "
    "analytical one grows fourfold from experiment 1 to 3, where the mean acceleration doubles: as if the paper's program lacked a "
    "quadratic term that its equations have."
)


def repeat_turbulence() -> Experiment:
    """Repeat the three experiments: one record of each for each of :data:`SEEDS`."""
    values: dict[tuple[int, str], Array] = {}
    for e in EXPERIMENTS:
        moments = [measure_moments(run_turbulent(e, seed)) for seed in SEEDS]
        values |= {(e, name): np.array([s[name] for s in moments]) for name in _LABELS}
    rows = [
        _compare_values(f"exp. {e}: {label}", table_viii(e, name), values[e, name])
        for e in EXPERIMENTS
        for name, label in _LABELS.items()
    ]
    for model, e, density in DENSITIES:
        v = values[e, f"sigma{MARKS[model]}_in"] / np.sqrt(BANDWIDTH)
        rows.append(_compare_values(f"exp. {e}: noise density, {model}", density, v))
    settings = {
        "instrument": "Table V; vartheta_x = 0 (not stated)",
        "motion": "Table VII; independent Gaussian samples; horizontal mean and deviation 15 % of the "
        "vertical; angular acceleration by central differences (not stated)",
        "records": f"{len(SEEDS)} of {DURATION:g} s at {SAMPLED:g} Hz (not stated), one for each seed",
        "model error": "numerical minus model; first-order rotations; no accelerometer noise (not stated)",
    }
    title = "Turbulence experiments (Section III.C, Tables VII and VIII)"
    return Experiment(title, settings, tuple(rows), (VARTHETA, _NO_ANGULAR_MOTION))


def _compare_values(quantity: str, printed: Printed, x: Array) -> PrintedEntry:
    """The mean of our runs, (seeds,), beside a printed number."""
    return PrintedEntry(quantity, printed, float(x.mean()), (float(x.min()), float(x.max())))


def measure_moments(run: Simulation) -> dict[str, float]:
    """The entries of Table VIII for one record, Eo."""
    entries: dict[str, float] = {}
    for model, mark in MARKS.items():
        c = demodulate_run(find_error(model, run), run)
        for series, short in ((c.inline, "in"), (c.cross, "cs")):
            entries |= {f"M{mark}_{short}": float(series.mean()), f"sigma{mark}_{short}": float(series.std())}
    return entries


class SampledSignal:
    """A signal (N,) of known values and slopes at the instants n / :data:`SAMPLED`, where alone it is asked for."""

    def __init__(self, values: Array, slopes: Array) -> None:
        self._spline = CubicHermiteSpline(np.arange(len(values)) / SAMPLED, values, slopes)

    def __call__(self, time: Array, shift: float = 0.0, derivative: int = 0) -> Array:
        """Value or derivative at ``time - shift``, (N,)."""
        return np.asarray(self._spline(time - shift, derivative))


def draw_motion(rng: np.random.Generator, experiment: int) -> MotionSignals:
    """A row of Table VII. The horizontal accelerations have 15 percent of the vertical one's mean and standard deviation."""
    a_mean, a_std, omega_mean, omega_std = TABLE_VII[experiment - 1]
    size, milli_g = round(DURATION * SAMPLED), 1e-3 * table_v().g0

    def draw(mean: float, std: float, unit: float) -> SampledSignal:
        """Independent Gaussian samples; derivative (v[n+1] - v[n-1]) / (2 dt)."""
        v = mean * unit + std * unit * rng.standard_normal(size + 2)
        return SampledSignal(v[1:-1], (v[2:] - v[:-2]) * SAMPLED / 2)

    a_z = draw(a_mean, a_std, milli_g)
    a_x, a_y = (draw(HORIZONTAL * a_mean, HORIZONTAL * a_std, milli_g) for _ in range(2))
    w_x, w_y, w_z = (draw(omega_mean, omega_std, DEGREE_PER_HOUR) for _ in range(3))
    return MotionSignals((a_x, a_y, a_z), (w_x, w_y, w_z))


def run_turbulent(experiment: int, seed: int, instrument: Instrument | None = None) -> Simulation:
    """The numerical model in turbulence experiment 1, 2 or 3; one seed gives all three the same random numbers."""
    motion = draw_motion(np.random.default_rng(seed), experiment)
    return simulate(instrument or table_v(), motion, DURATION, SAMPLED, seed=seed, auxiliaries={})


def _round(value: float) -> str:
    """Three significant digits; the same text on any machine but for the last of them."""
    return f"{value:.3g}" if value == 0 or 1e-3 <= abs(value) < 1e4 else f"{value:.2e}"


def write_page(experiments: Sequence[Experiment]) -> str:
    """The page of some experiments, as Markdown."""
    page = make_environment("ragg_runtime.experiments", {"digits": _round}).get_template("page.md.j2")
    return page.render(experiments=experiments, rows=[row for e in experiments for row in e.rows])
