"""A flight of any layout by the numerical reference, over a gradient that varies."""

from __future__ import annotations

from types import MappingProxyType

import numpy as np

from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.reference import EffectValues, simulate
from ragg_runtime.reference.scenario import draw_gradient, draw_motion, perturbed
from ragg_runtime.reference.simulate import eotvos_noise
from tests.rate import RATE


def flown_by(sheet: Instrument, duration: float, effects: EffectValues = MappingProxyType({})) -> Flight:
    """``duration`` s of an instrument that the sheet knows to a third of its errors, with white noise of 2 Eo/sqrt(Hz)."""
    s = simulate(
        perturbed(sheet, np.random.default_rng(5), 0.3),
        draw_motion(np.random.default_rng(3), duration),
        duration,
        RATE,
        gravity=draw_gradient(np.random.default_rng(4)),
        noise=eotvos_noise(2e-9, 0.1),
        kinematics="full",
        effects={"second-order-misalignment": {"kappa": 0.0}, **effects},
    )
    return s.flight()
