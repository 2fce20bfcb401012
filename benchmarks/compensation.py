"""What compensation does to a gradient: transfer function from 1 s to 1 h, coverage, and samples a second.

python -m benchmarks.compensation [--figure FILE.png]
"""

from __future__ import annotations

import argparse
import dataclasses
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation import calibrated
from ragg_runtime.compensation.compensate import Compensated, Kind, prepared
from ragg_runtime.compensation.saved import read, with_another
from ragg_runtime.io import Flight
from ragg_runtime.model.model import packaged
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.signals.demodulators import DEMODULATORS

Complex = NDArray[np.complex128]

PERIODS = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0, 40.0, 90.0, 240.0, 600.0, 1200.0, 3600.0)
"""Of the waves that are laid over a flight together, s."""

SIZE = 20.0
"""Of each wave, Eo."""


def series(s: Scenario, x: Flight, kind: Kind, name: str) -> tuple[Complex, NDArray[np.float64], Compensated]:
    """The compensated gradient, Eo, and its uncertainties."""
    c = Compensated(prepared(packaged(), s.sheet, [x], kind), 0, name)
    parts = list(c.segments())
    return np.concatenate([p.gradient for p in parts]), np.concatenate([p.std for p in parts], axis=1), c


def transfer(kind: Kind, duration: float = 7200.0) -> dict[str, list[tuple[float, complex, complex]]]:
    """Demodulator -> (period, gain of compensation, gain of the low-pass alone) of waves over a flight."""
    s = scenario(21, duration=duration)
    x = s.simulate({}).flight()
    t = x.time
    g = np.sum([SIZE * np.exp(2j * np.pi * (t / p + k / 7)) for k, p in enumerate(PERIODS)], axis=0)
    phi = 2 * np.pi * s.sheet.spin_frequency * t
    k_ggi = s.instrument.scale_factor * 1e-9
    waves = k_ggi * (g.real / 2 * np.sin(2 * phi) - g.imag * np.cos(2 * phi))
    more = dataclasses.replace(x, outputs={"G_out": x.outputs["G_out"] + waves})
    found = {}
    for name in DEMODULATORS:
        (with_waves, _, c), (without, _, _) = (series(s, y, kind, name) for y in (more, x))
        difference = with_waves - without
        ok = np.isfinite(difference.real)
        basis = np.stack([np.exp(2j * np.pi * (t[ok] / p + k / 7)) for k, p in enumerate(PERIODS)], axis=1)
        gains = np.linalg.lstsq(basis, difference[ok] / SIZE, rcond=None)[0]
        alone = c.demodulator.response(1 / np.array(PERIODS))
        found[name] = [(p, complex(a), complex(b)) for p, a, b in zip(PERIODS, gains, alone, strict=True)]
    return found


def coverage(kind: Kind, seeds: int) -> tuple[float, float, int]:
    """Shares of values whose truth lies within 1 and 1.96 standard uncertainties, and how many values were asked."""
    scores = []
    for seed in range(100, 100 + seeds):
        s = scenario(seed, duration=900.0, gradient_rms=50e-9)
        x = s.simulate({}).flight()
        g, std, c = series(s, x, kind, "fir")
        channels = x.channels
        true = (channels["Gamma_xx"] - channels["Gamma_yy"] + 1j * channels["Gamma_xy"]) / 1e-9
        error = g - c.demodulator.low_passed(true)
        ok = np.isfinite(error.real)
        scores.append((np.stack([error.real, error.imag]) / std)[:, ok][:, ::48])
    z = np.abs(np.concatenate(scores, axis=1))
    return float(np.mean(z < 1.0)), float(np.mean(z < 1.96)), int(z.size)


def speed(samples: int) -> tuple[float, float]:
    """Samples a second of the compensation itself, frozen, after the noise was estimated; and that estimate's time, s."""
    s = scenario(5, duration=1800.0, gradient_rms=30e-9)
    x = s.simulate({}, record_gradient=False).flight()
    c = calibrated.calibrated(packaged(), s.sheet, [x])
    saved = read(with_another(None, calibrated.to_save(c, [x], "now"), ""), "")[-1]
    times = -(-samples // len(x.time))
    long = dataclasses.replace(
        x,
        time=np.arange(times * len(x.time)) / x.rate,
        channels={n: np.tile(v, times) for n, v in x.channels.items()},
        outputs={n: np.tile(v, times) for n, v in x.outputs.items()},
        valid=np.ones(times * len(x.time), dtype=bool),
    )
    begun = time.perf_counter()
    compensated = Compensated(prepared(packaged(), s.sheet, [long], "frozen", saved), 0, "fir")
    before = time.perf_counter() - begun
    begun = time.process_time()
    for _ in compensated.segments():
        pass
    return len(long.time) / (time.process_time() - begun), before


def figure(found: dict[str, list[tuple[float, complex, complex]]], file: Path) -> None:
    """Gain over period of each demodulator, with and without compensation."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    fig, ax = plt.subplots(figsize=(7.2, 4.0), layout="constrained")
    for name, rows in found.items():
        periods = [p for p, _, _ in rows]
        (line,) = ax.semilogx(periods, [abs(b) for _, _, b in rows], lw=1.2, label=f"{name}: low-pass alone")
        ax.semilogx(periods, [abs(a) for _, a, _ in rows], "o", ms=5, mfc="none", color=line.get_color(),
                    label=f"{name}: compensated")  # fmt: skip
    ax.set(xlabel="period of the gradient, s", ylabel="gain", ylim=(-0.05, 1.1))
    ax.grid(alpha=0.3)
    ax.legend(fontsize=8)
    fig.savefig(file, dpi=130)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--figure", type=Path)
    parser.add_argument("--seeds", type=int, default=12)
    arguments = parser.parse_args()
    kinds: tuple[Kind, ...] = ("self", "crossed")
    for kind in kinds:
        one, two, count = coverage(kind, arguments.seeds)
        print(
            f"coverage, {kind}: {100 * one:.1f} % within 1, {100 * two:.1f} % within 1.96, of {count} values"
        )
    found = transfer("self")
    for name, rows in found.items():
        for period, gain, alone in rows:
            print(f"{name:12} {period:7g} s  {abs(gain):.4f}, low-pass alone {abs(alone):.4f}")
    if arguments.figure is not None:
        figure(found, arguments.figure)
    rate, before = speed(2_000_000)
    print(f"frozen, fir: {rate / 1e6:.2f} million samples a second of processor time, after {before:.1f} s")


if __name__ == "__main__":
    main()
