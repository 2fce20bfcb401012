"""The record of the dynamic experiment: Table VI over whole turns of the disc, with variants."""

from __future__ import annotations

import numpy as np

from ragg_runtime.experiments import paper
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.reference import Motion, Simulation, Sinusoids, simulate
from ragg_runtime.reference.effects import EffectValues
from ragg_runtime.reference.gravity import Gravity, PointMass
from ragg_runtime.reference.instruments import table_v
from ragg_runtime.reference.rotation import Rotations

TURNS = 64

WITH_MASS = PointMass(paper.MASS, paper.MASS_POSITION)
"""The test mass of Section III.A where it starts."""


def regular_motion() -> Motion:
    """Table VI."""
    g0, frequency = table_v().g0, table_v().spin_frequency

    def signal(name: str) -> Sinusoids:
        unit = g0 if name.startswith("a") else paper.DEGREE_PER_HOUR
        mean, amplitude = paper.TABLE_VI[name]
        return Sinusoids(mean * unit, [amplitude * unit], [frequency], [0.0])

    a_x, a_y, a_z, w_x, w_y, w_z = (signal(n) for n in ("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z"))
    return Motion((a_x, a_y, a_z), (w_x, w_y, w_z))


def regular_run(
    instrument: Instrument | None = None,
    *,
    gravity: Gravity | None = None,
    rotations: Rotations = "first-order",
    effects: EffectValues | None = None,
    rate: float = 16.0,
    turns: int = 1,
) -> Simulation:
    """The numerical model in the motion of Table VI.

    Means over one turn are exact at 16 Hz: no product of the motion goes beyond the 8th harmonic of the disc,
    and there are 64 samples to a turn.
    """
    known = table_v() if instrument is None else instrument
    return simulate(
        known,
        regular_motion(),
        float(np.rint(turns / known.spin_frequency)),
        rate,
        gravity=gravity,
        rotations=rotations,
        effects=effects,
        auxiliaries={},
    )
