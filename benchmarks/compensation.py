"""What compensation does to a gradient, and what its calibrations are worth, in the reference.

python -m benchmarks.compensation                   gain from 1 s to 1 h; a figure of the site
python -m benchmarks.compensation --calibration     designed calibration runs against even multisines of the same size
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
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
from ragg_runtime.reference.scenario import Scenario, scenario
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
    more = replace(x, outputs={"G_out": x.outputs["G_out"] + waves})
    found, both = {}, [prepare(load_packaged(), s.sheet, [y], "self").channels[0][0] for y in (more, x)]
    for name in DEMODULATORS:
        c, other = (replace(y, demodulator=find_demodulator(name, s.rate)) for y in both)
        difference = c.compensate().gradient - other.compensate().gradient
        ok = np.isfinite(difference.real)
        gains = np.linalg.lstsq(basis[ok], difference[ok] / SIZE, rcond=None)[0]
        found[name] = gains, np.asarray(c.demodulator.response(1 / PERIODS))
    return found


def print_gains() -> None:
    """Of each demodulator."""
    for name, (gains, alone) in transfer().items():
        for period, gain, low in zip(PERIODS, gains, alone, strict=True):
            print(f"{name:12} {period:7g} s  {abs(gain):.4f}, low-pass alone {abs(low):.4f}")


def draw_transfer(file: Path) -> None:
    """Gain over period of each demodulator, with and without compensation: a figure of the site."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    fig, ax = plt.subplots(figsize=(7.2, 4.0), layout="constrained")
    for name, (gains, alone) in transfer().items():
        (line,) = ax.semilogx(PERIODS, abs(alone), lw=1.2, label=f"{name}: low-pass alone")
        style = {"ms": 5, "mfc": "none", "color": line.get_color(), "label": f"{name}: compensated"}
        ax.semilogx(PERIODS, abs(gains), "o", **style)
    ax.set(xlabel="period of the gradient, s", ylabel="gain", ylim=(-0.05, 1.1))
    ax.grid(alpha=0.3)
    ax.legend(fontsize=8)
    fig.savefig(file, dpi=130)


# --- calibration runs ------------------------------------------------------------------------------------

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
    other = replace(s, motion=MotionSignals((x, y, z), (wx, wy, wz)), seed=s.seed + 1000, duration=duration)
    return other.simulate(PAPER_ORDER).flight("run")


def calibrate_by_runs(seed: int) -> dict[tuple[str, float], Array]:
    """Of each run by name and length, s, (2, 2) rms, Eo, that the parameters add to inline and cross: as uncertain, as they err."""
    s = scenario(seed, duration=300.0, rate=8.0)
    sim = s.simulate(PAPER_ORDER)
    flight = sim.flight()
    (clean,) = observe_flights([replace(flight, outputs=dict(sim.outputs_noise_free))], s.sheet)

    def fitted(*flights: Flight) -> ChannelVariance:
        observed = observe_flights(flights, s.sheet)
        return ChannelVariance.of(fit(load_packaged(), s.sheet, observed, candidates=False))

    first, band = fitted(flight), (0.0, next_motion.HIGHEST * s.rate)
    tones = next_motion.list_tones(s.sheet.spin_frequency, next_motion.LIMITS, band)
    designed = next_motion.find_motion(first.known, first.weigh_variance, tones, RUN)
    even = next_motion.share_evenly(tones)
    found = {}
    for name, motion, times in (
        ("none", (), 0),
        ("designed", designed, 1),
        *(("even", even, n) for n in (1, 2, 4)),
    ):
        c = fitted(flight, fly_sinusoids(s, motion, times * RUN)) if times else first
        f = c.known.f
        left = compute_residual(
            f.model, clean, f.calibration.p
        )  # what the parameters are wrong by: without noise
        g = demodulate_residual(left[0], clean.record, f.k_ggi)
        g = g[np.isfinite(g)]
        error = [np.sqrt(np.mean(x**2)) for x in (g.real, g.imag)]
        found[name, times * RUN] = np.array([c.rms(c.known.root), error])
    return found


def print_calibrations(seeds: Sequence[int] = range(8)) -> None:
    """Root mean squares over instruments."""
    every = [calibrate_by_runs(seed) for seed in seeds]
    print(f"{len(every)} instruments, flight of 300 s and a run; inline, cross, Eo: uncertain by, wrong by")
    for name, duration in every[0]:
        sure, error = np.sqrt(np.mean([x[name, duration] ** 2 for x in every], axis=0))
        print(f"{name:9} {duration:5.0f} s  {sure[0]:.3f} {sure[1]:.3f}  {error[0]:.3f} {error[1]:.3f}")


if __name__ == "__main__":
    (print_calibrations if sys.argv[1:] == ["--calibration"] else print_gains)()
