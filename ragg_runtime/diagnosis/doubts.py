"""What a fit cannot vouch for, however quiet its residual: channels that sampling may have spoiled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.diagnosis.explained import Explained
from ragg_runtime.diagnosis.vertical_force import misrecorded
from ragg_runtime.fit.fitted import Fitted, estimated
from ragg_runtime.fit.observation import Observation
from ragg_runtime.model.demodulation import built
from ragg_runtime.model.evaluate import output

Array = NDArray[np.float64]

AS_LARGE = 10.0
"""Most times that what sampling may spoil is larger than what is left: if it were more, the record would show it. On channels
that were thinned out from 16 Hz to 4 Hz it is foreseen 3 to 8 times too large."""

FALLS = -2.0
"""Slope of a spectrum, in logarithms, below half the sampling rate that is taken to go on beyond it; the noise of a motion record,
which sampling folds nothing of into channels, is flat."""

BAND = (0.6, 0.95)
"""Part of the frequencies below half the sampling rate over which that slope is measured."""

PIECE_SECONDS = 100.0
"""Length of the pieces of which the spectrum is averaged."""

SIDELOBES = ("kaiser", 30.0)
"""Window of that spectrum: the output is ten million eotvos where the spectrum must see one."""

LEAST_BINS = 8
"""Bins of a spectrum from which its slope is fitted: with fewer the slope is the scatter's."""


def spoiled(f: Fitted, e: Explained) -> str | None:
    """Why a fit confirms neither the model nor an effect, in words; ``None`` if nothing speaks against it."""
    return e.complaint or misrecorded(f) or thinned(f)


def thinned(f: Fitted) -> str | None:
    """Channels that may have been made at a higher rate: then sampling spoils what the motion holds beyond half of this one.

    A model that is evaluated at the record's instants and demodulated there folds what G_out has beyond half the sampling
    rate into its channels; where these were made at a higher rate and thinned out, they do not hold it, and the motion
    at that rate is not known. How large that is, is foreseen by the slope of the model's own spectrum.
    """
    for x, k_ggi in zip(f.prepared, f.scales, strict=True):
        o = x.observation
        if not o.recorded.demodulated or o.record.demodulation.rate is not None or not o.record.turning:
            continue
        left = float(np.sqrt(estimated(x)))
        spoiled = _spoiled(f, o)
        if left < spoiled < AS_LARGE * left:
            rate = o.record.rate
            return (
                f"inline and cross may have been made at a higher rate and thinned out to {rate:.6g} Hz: the motion goes on beyond"
                f" half of it, and what sampling then spoils, up to {spoiled / k_ggi:.3g} Eo, is as large as what the"
                f" model leaves, {left / k_ggi:.3g} Eo; give motion and channels at the rate at which they were made; if"
                f' it is this one, say so: [demodulator] rate = "{rate:.6g} Hz"'
            )
    return None


def _spoiled(f: Fitted, o: Observation) -> float:
    """rms, V, within the channels, of what sampling may spoil if they were made at a higher rate."""
    r = o.record
    through = o.recorded.through
    G = output(f.model.chain, r, f.calibration.p, o.output)
    G = np.where(np.isfinite(G), G, 0.0)
    inside = r.valid
    if not inside.any():
        return 0.0
    other = np.sqrt(
        np.mean(
            np.square((through(G, r, built(r.demodulation, 2 * r.rate).thinned(2)) - through(G, r))[inside])
        )
    )
    return float(
        np.hypot(
            other, np.sqrt(_folded(G, r.rate, abs(r.spin_frequency)) * o.recorded.noise_share(r) * r.rate / 2)
        )
    )


def _folded(G: Array, rate: float, spin: float) -> float:
    """Density, V^2/Hz, of what folds onto the carriers, by the slope of the spectrum of an output (N,) below half the rate."""
    from scipy import signal  # slow to import, and few records need it

    size = min(len(G), int(PIECE_SECONDS * rate))
    f, P = signal.welch(G, rate, nperseg=size, window=SIDELOBES)
    top = (f > BAND[0] * rate / 2) & (f < BAND[1] * rate / 2) & (P > 0)
    if np.sum(top) < LEAST_BINS:
        return 0.0
    slope, level = np.polyfit(np.log(f[top]), np.log(P[top]), 1)
    return float(np.exp(level + slope * np.log(rate - 2 * spin))) if slope < FALLS else 0.0
