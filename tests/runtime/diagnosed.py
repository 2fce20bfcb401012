"""A diagnosis of simulated flights under their sheet, with all that the catalogue can derive; no motion to fly next is sought."""

from __future__ import annotations

from collections.abc import Sequence
from unittest import mock

from ragg_runtime.identification import next_motion
from ragg_runtime.identification.diagnose import diagnose
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io import Flight
from ragg_runtime.model import derive
from ragg_runtime.model import model as load
from ragg_runtime.reference.scenario import Scenario


def diagnosed(s: Scenario, *flights: Flight) -> Diagnosis:
    def extended(model: load.Model, ids: Sequence[str], /, *, candidates: bool = False) -> load.Model:
        return derive.with_effects(s.sheet, model, ids, candidates=candidates)

    with mock.patch.object(next_motion, "proposals", lambda *_: ()):
        return diagnose(load.packaged(), s.sheet, flights, extended)
