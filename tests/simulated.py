"""Simulated flights: the sampling rate that most of them have, and their diagnosis."""

from __future__ import annotations

from functools import partial

from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model import derive
from ragg_runtime.reference.scenario import Scenario

RATE = 8.0
"""Hz: the platform passes nothing of note above 2 Hz (reference/turbulence.py), so that sixteen samples a second tell no more."""


def diagnosed(known: Scenario | Instrument, *flights: Flight) -> Diagnosis:
    """With all that the catalogue can derive. ``known``: the sheet, or a scenario that has one."""
    sheet = known.sheet if isinstance(known, Scenario) else known
    return diagnose(derive.load_model(sheet), sheet, flights, partial(derive.with_effects, sheet))
