"""Flights that contradict each other: each alone is what the model says, but with other parameters."""

from __future__ import annotations

from collections.abc import Sequence

from ragg_runtime.diagnosis.strong import Stage
from ragg_runtime.fit.fitted import Fitted, calibrated
from ragg_runtime.fit.observation import Observation
from ragg_runtime.fit.off_sheet import QUIET

UNEXPLAINED = 10.0
"""Times the noise's chi-square that all effects of the catalogue together must leave, as far as linear tests tell, for flights to
contradict each other: of one effect between flights, however strong, they leave the noise (0.95 to 1.0 in what was tried); of three
instruments in place of one, ten million times as much."""


def contradiction(first: Stage) -> str | None:
    """That flights contradict each other, in words, and which of them agree; ``None`` if they do not.

    ``first`` is the stage without any effect in the model. An effect that acts between flights alone (a temperature that is
    another one in each) is none of this: its column tells it.
    """
    f = first.fitted
    flights: dict[int, list[Observation]] = {}
    for o in f.observations:
        flights.setdefault(o.flight, []).append(o)
    left = float(first.field.P[-1, -1] ** 2)
    if len(flights) < 2 or left < UNEXPLAINED * f.calibration.rows:
        return None
    if not all(_quiet(f, x) for x in flights.values()):
        return None
    agree: list[list[Sequence[Observation]]] = []
    for one in flights.values():
        group = next((g for g in agree if _quiet(f, [*g[0], *one])), None)
        if group is None:
            agree.append([one])
        else:
            group.append(one)
    names = "; ".join(", ".join(x[0].flight_name for x in g) for g in agree)
    return (
        f"each of the {len(flights)} flights alone is explained to its noise, but they contradict each other, and no effect of"
        f" the catalogue acts so between flights. Those that agree: {names}. Was the instrument, its mounting, an axis or a unit"
        " changed between them? ragg calibrate of each shows what differs; diagnose those together that agree"
    )


def _quiet(f: Fitted, observations: Sequence[Observation]) -> bool:
    """Whether the model leaves but noise of some of the observations."""
    return calibrated(f.model, f.instrument, observations)[1].excess <= QUIET
