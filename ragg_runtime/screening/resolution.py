"""The steps in which motion sensors are recorded, and what they make of the output."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.instrument.units import Units
from ragg_runtime.io import Flight
from ragg_runtime.io.angular_acceleration import wide_weights
from ragg_runtime.io.record import ANGULAR_ACCELERATION, ANGULAR_RATE, SPECIFIC_FORCE, Flag
from ragg_runtime.model.evaluate import scale_factor
from ragg_runtime.model.model import Model
from ragg_runtime.screening.linear_fit import Explained
from ragg_runtime.screening.sampler import Rows, Sampler
from ragg_runtime.signals.resolution import find_step

Array = NDArray[np.float64]

TOLD = 0.5
"""Share of what a model leaves that the steps must make for a note."""


def resolution_of(flight: Flight) -> Mapping[str, float]:
    """Step of every recorded motion column, SI; of the angular acceleration only where the file has it."""
    names = [*SPECIFIC_FORCE, *ANGULAR_RATE]
    names += [n for n in ANGULAR_ACCELERATION if n in flight.written]
    found = {n: find_step(flight.channels[n][flight.valid]) for n in names if n in flight.channels}
    return {n: step for n, step in found.items() if step is not None}


def coarse_sensors(model: Model, known: Units, s: Sampler, fitted: Explained) -> list[Flag]:
    """Flags of motion sensors whose steps make a good part of what the fitted model leaves of the output."""
    x, rows = s.flight, s.take(s.rows())
    groups: dict[tuple[str, str], list[str]] = {}
    for name, step in x.resolution.items():
        groups.setdefault((name.rsplit("_", 1)[0], f"{step:.3g}"), []).append(name)
    found = []
    for (stem, _), names in groups.items():
        step = x.resolution[names[0]]
        errors = {n: step / np.sqrt(12.0) for n in names}
        if (
            stem == "omega" and ANGULAR_ACCELERATION[0] not in x.written
        ):  # derived from the rate, with its steps
            gain = float(np.linalg.norm(wide_weights())) * x.rate
            errors |= {n.replace("omega", "omegadot"): gain * e for n, e in errors.items()}
        made = _made_of(model, s, rows, errors, fitted)
        if s.recorded.demodulated or made < TOLD * fitted.rms:
            continue
        unit = x.written.get(names[0], x.units[names[0]])
        size = step / float(known.to_si(1.0, unit, x.units[names[0]]))
        size, unit = (1e3 * size, f"m{unit}") if unit == "g" else (size, unit)
        verb = "is" if len(names) == 1 else "are"
        text = f"{', '.join(names)} {verb} recorded in steps of {size:.3g} {unit}, which make about {made:.2g} Eo of the output"
        found.append(Flag(tuple(names), text, len(x), kind="resolution"))
    return found


def _made_of(model: Model, s: Sampler, rows: Rows, errors: Mapping[str, float], fitted: Explained) -> float:
    """Eo rms: what random errors of this size, SI, of some channels make of the output."""
    rng = np.random.default_rng(0)
    moved = {n: rows.channels[n] + e * rng.standard_normal(len(rows.time)) for n, e in errors.items()}
    evaluate = model.compiled("numpy").output
    both = [
        evaluate(r.time, r.inputs(model.chain), fitted.p, r.phi, which=s.place)
        for r in (rows, replace(rows, channels={**rows.channels, **moved}))
    ]
    return float(np.std(both[1] - both[0])) / abs(scale_factor(model, fitted.p, s.place))
