"""What compensation does to a gradient: transfer function from 1 s to 1 h, and coverage of its uncertainty.

python -m benchmarks.compensation [--seeds N]
"""

from __future__ import annotations

import argparse
import dataclasses
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation.compensate import (
    Kind,
    PreparedFlights,
    compensate_channel,
    make_channel,
    prepare,
)
from ragg_runtime.compensation.segment import OutputChannel
from ragg_runtime.io import Flight
from ragg_runtime.model.model import packaged
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.signals.demodulators import DEMODULATORS

Complex = NDArray[np.complex128]

PERIODS = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0, 40.0, 90.0, 240.0, 600.0, 1200.0, 3600.0])
"""Of the waves that are laid over a flight together, s."""

SIZE = 20.0
"""Of each wave, Eo."""


def ready(s: Scenario, x: Flight, kind: Kind) -> PreparedFlights:
    """The flight, calibrated."""
    return prepare(packaged(), s.sheet, [x], kind)


def series(p: PreparedFlights, name: str) -> tuple[Complex, NDArray[np.float64], OutputChannel]:
    """The compensated gradient, Eo, and its uncertainties."""
    c = make_channel(p, 0, name)
    x = compensate_channel(c)
    return x.gradient, x.std, c


def transfer(kind: Kind = "self", duration: float = 7200.0) -> dict[str, tuple[Complex, Complex]]:
    """Demodulator -> gains of compensation and of the low-pass alone over :data:`PERIODS`."""
    s = scenario(21, duration=duration, rate=4.0)  # the motion ends at 1.8 Hz
    x = s.simulate({}).flight()
    t = x.time
    basis = np.exp(2j * np.pi * (t[:, None] / PERIODS + np.arange(len(PERIODS)) / 7))
    g = SIZE * basis.sum(axis=1)
    phi = 2 * np.pi * s.sheet.spin_frequency * t
    waves = 1e-9 * s.instrument.scale_factor * (g.real / 2 * np.sin(2 * phi) - g.imag * np.cos(2 * phi))
    more = dataclasses.replace(x, outputs={"G_out": x.outputs["G_out"] + waves})
    found, both = {}, [ready(s, y, kind) for y in (more, x)]
    for name in DEMODULATORS:
        (with_waves, _, c), (without, _, _) = (series(p, name) for p in both)
        difference = with_waves - without
        ok = np.isfinite(difference.real)
        gains = np.linalg.lstsq(basis[ok], difference[ok] / SIZE, rcond=None)[0]
        found[name] = gains, np.asarray(c.demodulator.response(1 / PERIODS))
    return found


def coverage(kind: Kind, seeds: int) -> tuple[float, float, int]:
    """Shares of values whose truth lies within 1 and 1.96 standard uncertainties, and how many values were asked."""
    scores = []
    for seed in range(100, 100 + seeds):
        s = scenario(seed, duration=900.0, gradient_rms=50e-9)
        x = s.simulate({}).flight()
        g, std, c = series(ready(s, x, kind), "fir")
        channels = x.channels
        true = (channels["Gamma_xx"] - channels["Gamma_yy"] + 1j * channels["Gamma_xy"]) / 1e-9
        error = g - c.demodulator.low_passed(true)
        ok = np.isfinite(error.real)
        scores.append((np.stack([error.real, error.imag]) / std)[:, ok][:, ::48])
    z = np.abs(np.concatenate(scores, axis=1))
    return float(np.mean(z < 1.0)), float(np.mean(z < 1.96)), int(z.size)


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


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=12)
    kinds: tuple[Kind, ...] = ("self", "crossed")
    for kind in kinds:
        one, two, count = coverage(kind, parser.parse_args().seeds)
        print(f"coverage, {kind}: {one:.1%} within 1, {two:.1%} within 1.96, of {count} values")
    for name, (gains, alone) in transfer().items():
        for period, gain, low in zip(PERIODS, gains, alone, strict=True):
            print(f"{name:12} {period:7g} s  {abs(gain):.4f}, low-pass alone {abs(low):.4f}")


if __name__ == "__main__":
    main()
