"""What compensation does to a gradient, and what its calibrations are worth, in the reference.

python -m benchmarks.compensation                   gain from 1 s to 1 h; a figure of the site
python -m benchmarks.compensation --calibration     designed calibration runs against even multisines of the same size
python -m benchmarks.compensation --drift           coverage on surveys of several flights with parameters that walk
"""

from __future__ import annotations

import dataclasses
import sys
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation.compensate import prepare
from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.estimation.regressors import compute_residual
from ragg_runtime.estimation.scores import demodulate_residual
from ragg_runtime.identification import next_motion
from ragg_runtime.identification.next_motion import Sinusoid
from ragg_runtime.io import Flight
from ragg_runtime.model.model import load_packaged
from ragg_runtime.next_flight import ChannelVariance
from ragg_runtime.reference.motion import MotionSignals, Sinusoids
from ragg_runtime.reference.scenario import Scenario, draw_gradient, draw_motion, scenario
from ragg_runtime.reference.simulate import combine
from ragg_runtime.signals.demodulators import DEMODULATORS, find_demodulator

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

PERIODS = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0, 40.0, 90.0, 240.0, 600.0, 1200.0, 3600.0])
"""Of the waves that are laid over a flight together, s."""

SIZE = 20.0
"""Of each wave, Eo."""


def transfer(duration: float = 7200.0) -> dict[str, tuple[Complex, Complex]]:
    """Demodulator -> gains of compensation and of the low-pass alone over :data:`PERIODS`."""
    s = scenario(21, duration=duration, rate=4.0)  # the motion ends at 1.8 Hz
    x = s.simulate({}).flight()
    t = x.time
    basis = np.exp(2j * np.pi * (t[:, None] / PERIODS + np.arange(len(PERIODS)) / 7))
    g = SIZE * basis.sum(axis=1)
    phi = 2 * np.pi * s.sheet.spin_frequency * t
    waves = 1e-9 * s.instrument.scale_factor * (g.real / 2 * np.sin(2 * phi) - g.imag * np.cos(2 * phi))
    more = dataclasses.replace(x, outputs={"G_out": x.outputs["G_out"] + waves})
    found, both = {}, [prepare(load_packaged(), s.sheet, [y], "self").channels[0][0] for y in (more, x)]
    for name in DEMODULATORS:
        c, other = (dataclasses.replace(y, demodulator=find_demodulator(name, s.rate)) for y in both)
        difference = c.compensate().gradient - other.compensate().gradient
        ok = np.isfinite(difference.real)
        gains = np.linalg.lstsq(basis[ok], difference[ok] / SIZE, rcond=None)[0]
        found[name] = gains, np.asarray(c.demodulator.response(1 / PERIODS))
    return found


def draw_transfer(file: Path) -> None:
    """Gain over period of each demodulator, with and without compensation: a figure of the site."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    fig, ax = plt.subplots(figsize=(7.2, 4.0), layout="constrained")
    for name, (gains, alone) in transfer().items():
        (line,) = ax.semilogx(PERIODS, abs(alone), lw=1.2, label=f"{name}: low-pass alone")
        ax.semilogx(
            PERIODS, abs(gains), "o", ms=5, mfc="none", color=line.get_color(), label=f"{name}: compensated"
        )
    ax.set(xlabel="period of the gradient, s", ylabel="gain", ylim=(-0.05, 1.1))
    ax.grid(alpha=0.3)
    ax.legend(fontsize=8)
    fig.savefig(file, dpi=130)


# --- calibration runs ----------------------------------------------------------------------------------

RUN = 600.0
"""Of a calibration run, s."""

PAPER_ORDER = {"second-order-misalignment": {"kappa": 0.0}}
"""No angles in second-order terms, as in the model that is calibrated."""


def fly_sinusoids(s: Scenario, motion: Sequence[Sinusoid], duration: float) -> Flight:
    """The scenario's instrument in a multisine about the mean of its flight."""
    t = np.arange(int(s.duration * s.rate)) / s.rate
    parts = {}
    for group in ("a", "omega"):
        for k, signal in zip("xyz", getattr(s.motion, group), strict=True):
            own = [x[1:] for x in motion if x[0] == f"{group}_{k}"]
            f, size, phase = zip(*own, strict=True) if own else ((), (), ())
            parts[f"{group}_{k}"] = Sinusoids(float(np.mean(signal.value(t))), size, f, phase)
    x, y, z, wx, wy, wz = (parts[n] for n in next_motion.AXES)
    other = dataclasses.replace(
        s, motion=MotionSignals((x, y, z), (wx, wy, wz)), seed=s.seed + 1000, duration=duration
    )
    return other.simulate(PAPER_ORDER).flight("run")


def calibrate_by_runs(seed: int) -> list[tuple[str, float, Array, Array]]:
    """Of each run its name, length, s, and rms that the parameters add to inline and cross, Eo, as they are uncertain and as they err."""
    s = scenario(seed, duration=300.0, rate=8.0)
    sim = s.simulate(PAPER_ORDER)
    flight = sim.flight()
    (clean,) = observe_flights([dataclasses.replace(flight, outputs=dict(sim.outputs_noise_free))], s.sheet)

    def fitted(*flights: Flight) -> ChannelVariance:
        observed = observe_flights(flights, s.sheet)
        return ChannelVariance.of(fit(load_packaged(), s.sheet, observed, candidates=False))

    first, band = fitted(flight), (0.0, next_motion.HIGHEST * s.rate)
    tones = next_motion.list_tones(s.sheet.spin_frequency, next_motion.LIMITS, band)
    designed = next_motion.find_motion(first.known, first.weigh_variance, tones, RUN)
    even = next_motion.share_evenly(tones)
    runs: list[tuple[str, Sequence[Sinusoid], float]] = [("none", (), 0.0), ("designed", designed, RUN)]
    runs += [("even", even, times * RUN) for times in (1, 2, 4)]
    found = []
    for name, motion, duration in runs:
        c = fitted(flight, fly_sinusoids(s, motion, duration)) if duration else first
        f = c.known.f
        left = compute_residual(
            f.model, clean, f.calibration.p
        )  # of what has no noise: what the parameters are wrong by
        r = clean.record
        g = demodulate_residual(left[0], r, f.k_ggi)
        g = g[np.isfinite(g)]
        error = [np.sqrt(np.mean(x**2)) for x in (g.real, g.imag)]
        found.append((name, duration, np.array(c.rms(c.known.root)), np.array(error)))
    return found


def print_calibrations(seeds: Sequence[int] = range(8)) -> None:
    """Root mean squares over instruments."""
    every = [calibrate_by_runs(seed) for seed in seeds]
    print(f"{len(every)} instruments, flight of 300 s and a run; inline, cross, Eo: uncertain by, wrong by")
    for of_run in zip(*every, strict=True):
        name, duration, *_ = of_run[0]
        sure, error = (np.sqrt(np.mean(np.square([x[k] for x in of_run]), axis=0)) for k in (2, 3))
        print(f"{name:9} {duration:5.0f} s  {sure[0]:.3f} {sure[1]:.3f}  {error[0]:.3f} {error[1]:.3f}")


# --- surveys with parameters that walk -----------------------------------------------------------------

FLIGHTS, LENGTH = 4, 300.0
"""Of a survey, and the length of each, s."""


def fly_survey(seed: int) -> tuple[Scenario, list[Flight]]:
    """Flights with 0.2 to 2 h between them, over a gradient that varies by 30 Eo.

    Scale factors, and tilts of the input axes into a_z, of all four accelerometers walk by 1e-8 to 5e-7 after an hour, each kind in
    seven of ten surveys.
    """
    rng, s = np.random.default_rng(seed), scenario(seed, duration=LENGTH, rate=4.0)
    starts = np.cumsum([0.0, *(LENGTH + 3600 * rng.uniform(0.2, 2.0, FLIGHTS - 1))])
    seconds = np.arange(0.0, starts[-1] + LENGTH + 1.0)
    walks = np.cumsum(rng.standard_normal((2, 4, len(seconds))), axis=-1) / 60.0  # 1 after an hour
    walks *= (10 ** rng.uniform(-8.0, -6.3, 2) * (rng.random(2) < 0.7))[:, None, None]
    k, flights = s.instrument.accelerometers, []
    for n, start in enumerate(starts):
        own = dataclasses.replace(
            s,
            motion=draw_motion(np.random.default_rng([seed, n, 1]), LENGTH),
            gravity=draw_gradient(np.random.default_rng([seed, n, 2]), 30e-9),
            seed=1000 * seed + n,
        )
        sim = own.simulate({})
        gain, tilt = (np.stack([np.interp(start + sim.time, seconds, w) for w in of]) for of in walks)
        V = sim.voltages * (1 + gain) - (k["k_VI"] * k["K1"])[:, None] * tilt * sim.channels["a_z"]
        day = datetime(2026, 3, 1, 22, tzinfo=UTC) + timedelta(seconds=float(start))
        flights.append(dataclasses.replace(sim.flight(), outputs={"G_out": combine(V)}, origin=day))
    return s, flights


def score_survey(seed: int, kind: str) -> Array:
    """Errors of inline and cross over their standard uncertainties, every two seconds of all flights."""
    s, flights = fly_survey(seed)
    p = prepare(load_packaged(), s.sheet, flights, kind)  # type: ignore[arg-type]
    found = []
    for x, (c,) in zip(flights, p.channels, strict=True):
        y = c.compensate()
        g = x.channels["Gamma_xx"] - x.channels["Gamma_yy"] + 1j * x.channels["Gamma_xy"]
        off = y.gradient - c.demodulator.low_passed(g / 1e-9)
        found += [(off.real / y.std[0])[::8], (off.imag / y.std[1])[::8]]
    z = np.concatenate(found)
    return z[np.isfinite(z)]


def print_coverage(seeds: Sequence[int] = range(100, 120)) -> None:
    """Of each survey, and of all, the shares within 1 and 2 standard uncertainties."""
    for kind in ("smoothed", "self"):
        every = []
        for seed in seeds:
            every.append(score_survey(seed, kind))
            print(kind, seed, _coverage(every[-1]), flush=True)
        print(kind, "all", _coverage(np.concatenate(every)))


def _coverage(z: Array) -> str:
    inside = [float(np.mean(np.abs(z) < k)) for k in (1.0, 2.0)]
    return f"{100 * inside[0]:.1f} % {100 * inside[1]:.1f} %, rms {np.sqrt(np.mean(z**2)):.2f}, of {len(z)}"


def print_gains() -> None:
    """Of each demodulator."""
    for name, (gains, alone) in transfer().items():
        for period, gain, low in zip(PERIODS, gains, alone, strict=True):
            print(f"{name:12} {period:7g} s  {abs(gain):.4f}, low-pass alone {abs(low):.4f}")


if __name__ == "__main__":
    asked = {"--calibration": print_calibrations, "--drift": print_coverage}
    for word in sys.argv[1:] or [""]:
        asked.get(word, print_gains)()
