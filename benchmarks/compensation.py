"""What compensation does to a gradient, in the reference: its gain from 1 s to 1 h, a figure of the site."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.compensation.compensate import prepare
from ragg_runtime.model.model import load_packaged
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.signals.demodulators import DEMODULATORS, find_demodulator

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

# Of the waves that are laid over a flight together, s
PERIODS = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 20.0, 40.0, 90.0, 240.0, 600.0, 1200.0, 3600.0])
SIZE = 20.0  # of each wave, Eo


def transfer() -> dict[str, tuple[Complex, Complex]]:
    """Demodulator -> gains of compensation and of the low-pass alone over :data:`PERIODS`."""
    s = scenario(21, duration=7200.0, rate=4.0)  # the motion ends at 1.8 Hz
    x = s.simulate({}).flight()
    t = x.time
    basis = np.exp(2j * np.pi * (t[:, None] / PERIODS + np.arange(len(PERIODS)) / 7))
    g = SIZE * basis.sum(axis=1)
    phi = 2 * np.pi * s.sheet.spin_frequency * t
    waves = 1e-9 * s.instrument.scale_factor * (g.real / 2 * np.sin(2 * phi) - g.imag * np.cos(2 * phi))
    more = replace(x, outputs={"G_out": x.outputs["G_out"] + waves})
    pairs, both = {}, [prepare(load_packaged(), s.sheet, [y], "self").channels[0][0] for y in (more, x)]
    for name in DEMODULATORS:
        c, other = (replace(y, demodulator=find_demodulator(name, s.rate)) for y in both)
        difference = c.compensate().gradient - other.compensate().gradient
        ok = np.isfinite(difference.real)
        gains = np.linalg.lstsq(basis[ok], difference[ok] / SIZE, rcond=None)[0]
        pairs[name] = gains, np.asarray(c.demodulator.response(1 / PERIODS))
    return pairs


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


if __name__ == "__main__":
    for name, (gains, alone) in transfer().items():
        for period, gain, low in zip(PERIODS, gains, alone, strict=True):
            print(f"{name:12} {period:7g} s  {abs(gain):.4f}, low-pass alone {abs(low):.4f}")
