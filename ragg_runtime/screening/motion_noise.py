"""The noise with which motion is measured, what it makes of the output, and by how much it weakens coefficients.

A model sees the measured motion, x = true + noise (errors in variables: W. Fuller, Measurement Error Models, 1987). The noise goes through
the model into what is left of the output, and a coefficient of x comes out too small by var(noise) / var(x).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime.instrument.units import EOTVOS, Units
from ragg_runtime.io import Flight
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, GRADIENT, SPECIFIC_FORCE, Flag
from ragg_runtime.model.evaluate import scale_factor
from ragg_runtime.model.model import Model
from ragg_runtime.screening.linear_fit import LinearFit
from ragg_runtime.screening.sampler import Rows, Sampler
from ragg_runtime.signals.angular_acceleration import wide_weights
from ragg_runtime.signals.resolution import find_step

Array = NDArray[np.float64]

MATTERS = 0.1
"""Share of what a model leaves from which motion noise may feign an effect: below, ten thousand samples tell no such correlation."""

TOLD = 0.5
"""Share from which it is told."""

MOST = 1.5
"""Share above which a floor is none of the sensors: their noise cannot make more than what is left, but for how both are known."""

WINDOW, BANDS = 256, 8
"""Samples of a window of the spectrum, and bands whose mean densities are compared: the least is the floor."""

FLAT = 1.2
"""Ratio of the two lowest bands below which they are white noise; motion falls off. Of 4,800 samples a band is known to 3 %."""


@dataclass(frozen=True)
class MotionNoise:
    """White noise of a motion column: its standard deviation, SI, the ``step`` in which it is recorded (0: none), and the share
    ``weaker`` by which coefficients of it come out too small.
    """

    std: float
    step: float
    weaker: float


def measure_noise(flight: Flight) -> dict[str, MotionNoise]:
    """Of every recorded motion column; of the angular acceleration only where the file has it.

    The noise is what the steps of a converter make, or the floor of the spectrum, if it has a flat one, whichever is more; the
    floor is an upper bound, as motion may have one, too.
    """
    names = [*SPECIFIC_FORCE, *ANGULAR_RATE]
    names += [n for n in ANGULAR_ACCELERATION if n in flight.written]
    found = {}
    for n in (n for n in names if n in flight.channels):
        x = flight.channels[n][flight.valid]
        power = float(np.var(x)) if len(x) else 0.0
        if power > 0.0:
            step = find_step(x) or 0.0
            std = max(step / float(np.sqrt(12.0)), _floor(x))
            found[n] = MotionNoise(std, step, min(1.0, std**2 / power))
    return found


def _floor(x: Array) -> float:
    """Standard deviation of white noise as dense as the lowest band of the spectrum of x (N,); 0 where no two bands are alike."""
    _, density = signal.welch(x, nperseg=min(WINDOW, max(8, len(x) // 8)))
    lowest, next_one = sorted(float(np.mean(b)) for b in np.array_split(density[2:-1], BANDS) if len(b))[:2]
    return float(np.sqrt(0.5 * lowest)) if next_one < FLAT * lowest else 0.0


def leave_out_noisy_gradient(model: Model, s: Sampler, fitted: LinearFit) -> Flight:
    """The flight without its gravity gradient if noise of that makes a good part of what is left: unknown, it varies slowly."""
    recorded = [n for n in GRADIENT if n in s.flight.channels]
    errors = {n: e for n in recorded if (e := _floor(s.flight.channels[n][s.flight.valid])) > 0.0}
    if s.recorded.demodulated or not errors:
        return s.flight
    made = _made_of(model, s, s.take(s.rows()), errors, fitted)
    if not TOLD * fitted.rms < made < MOST * fitted.rms:
        return s.flight
    text = (
        f"{', '.join(errors)} have a noise floor of {max(errors.values()) / EOTVOS:.2g} Eo rms, which causes about {made:.2g} Eo of the"
        " output: the recorded gradient is not used; it is taken to be unknown and to vary slowly"
    )
    channels = {n: x for n, x in s.flight.channels.items() if n not in GRADIENT}
    return replace(s.flight, channels=channels).flagged([Flag((), text)])


def flag_noise(
    model: Model, known: Units, s: Sampler, fitted: LinearFit
) -> tuple[dict[str, float], list[Flag]]:
    """Standard deviations, SI, of the motion noise that matters in the output, and flags where it is a good part of what is left."""
    if s.recorded.demodulated:
        return {}, []
    rows, noise = s.take(s.rows()), measure_noise(s.flight)
    matters: dict[str, float] = {}
    flags = []
    for stem in ("a", "omega", "omegadot"):
        names = [n for n in noise if n.rsplit("_", 1)[0] == stem]
        errors = {n: noise[n].std for n in names}
        if (
            stem == "omega" and ANGULAR_ACCELERATION[0] not in s.flight.written
        ):  # derived from the rate, with its noise
            gain = float(np.linalg.norm(wide_weights())) * s.flight.rate
            errors |= {n.replace("omega", "omegadot"): gain * e for n, e in errors.items()}
        made = _made_of(model, s, rows, errors, fitted) if names else 0.0
        if MATTERS * fitted.rms < made < MOST * fitted.rms:
            matters |= {n: noise[n].std for n in names}
            if made > TOLD * fitted.rms:
                flags.append(_describe(s.flight, known, names, noise, made))
    return matters, flags


def _describe(
    x: Flight, known: Units, names: Sequence[str], noise: Mapping[str, MotionNoise], made: float
) -> Flag:
    loudest = max(names, key=lambda n: noise[n].std)
    q, unit = noise[loudest], x.written.get(loudest, x.units[loudest])
    stepped = q.step / np.sqrt(12.0) > 0.5 * q.std
    size = (q.step if stepped else q.std) / float(known.to_si(1.0, unit, x.units[loudest]))
    size, unit = (1e3 * size, f"m{unit}") if unit == "g" else (size, unit)
    weaker = 100.0 * max(noise[n].weaker for n in names)
    effect = f", and makes their coefficients up to {weaker:.2g} % too small" if weaker > 0.01 else ""
    verb, have = ("is", "has") if len(names) == 1 else ("are", "have")
    who, makes = ", ".join(names), f"about {made:.2g} Eo of the output{effect}"
    text = (
        f"{who} {verb} recorded in steps of {size:.3g} {unit}, which causes {makes}"
        if stepped
        else f"{who} {have} a noise floor of {size:.2g} {unit} rms; as sensor noise it causes {makes}"
    )
    return Flag(tuple(names), text, kind="motion-noise")


def _made_of(model: Model, s: Sampler, rows: Rows, errors: Mapping[str, float], fitted: LinearFit) -> float:
    """Eo rms: what random errors of this size, SI, of some channels make of the output."""
    rng = np.random.default_rng(0)
    moved = {n: rows.channels[n] + e * rng.standard_normal(len(rows.time)) for n, e in errors.items()}
    evaluate = model.compiled("numpy").output
    both = [
        evaluate(r.time, r.inputs(model.chain), fitted.p, r.phi, which=s.place)
        for r in (rows, replace(rows, channels={**rows.channels, **moved}))
    ]
    return float(np.std(both[1] - both[0])) / abs(scale_factor(model, fitted.p, s.place))
