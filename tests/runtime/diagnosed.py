"""A diagnosis of simulated flights under their sheet, with all that the catalogue can derive."""

from __future__ import annotations

from functools import partial

from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.io import Flight
from ragg_runtime.model import derive
from ragg_runtime.reference.scenario import Scenario


def diagnosed(known: Scenario | Instrument, *flights: Flight) -> Diagnosis:
    """``known``: the sheet, or a scenario that has one."""
    sheet = known.sheet if isinstance(known, Scenario) else known
    return diagnose(derive.load_model(sheet), sheet, flights, partial(derive.with_effects, sheet))
