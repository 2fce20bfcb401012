"""What a computer on board would have found: flights sample by sample through the recursive filter, for commands and notebooks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import one_thread
from ragg_runtime.compensation.output import writing
from ragg_runtime.compensation.recursive import Tuning, following
from ragg_runtime.compensation.sample_by_sample import followed
from ragg_runtime.compensation.saved import Saved
from ragg_runtime.flight import Flight
from ragg_runtime.workflow.after import saved_calibration
from ragg_runtime.workflow.loaded import Loaded

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Watched:
    """The result of ``online``: ``series`` of every flight (name -> (k,)), unless they went to a file."""

    name: str
    result: Mapping[str, Any]
    series: tuple[Mapping[str, Array], ...]

    def __repr__(self) -> str:
        flights = ", ".join(x["flight"] for x in self.result["flights"])
        return f"<{flights} sample by sample by {self.name}>"

    def as_json(self) -> dict[str, Any]:
        return dict(self.result)


@one_thread
def online(
    m: Loaded,
    flights: Sequence[Flight],
    noise: float | None = None,
    walk: float | None = None,
    forget: float = float("inf"),
    output: Path | None = None,
) -> Watched:
    """Calibrate and compensate sample by sample, every flight from the calibration that is kept, else from the sheet.

    Parameters
    ----------
    noise
        Density of the noise of the cross channel about twice the spin rate, Eo/sqrt(Hz); by default what the kept
        calibration left.
    walk
        Of the cross channel, Eo/sqrt(s), twice that of the inline one; by default both are followed with the time constant
        of the demodulators' low-pass, 1/(2 pi 0.2 Hz).
    forget
        Time constant, s, with which the parameters forget the flight.
    output
        A file for the series; without one they are in the result.
    """
    saved = None if m.directory.calibration is None else saved_calibration(m)
    density = _density(m, saved) if noise is None else noise
    walk = following(density) if walk is None else walk
    asked = Tuning(noise=density, walk=walk, forget=forget)
    found = [followed(m.model, m.instrument, x, saved, asked) for x in flights]
    series = [s for s, _ in found]
    _written(output, series)
    result = {
        "started": "sheet" if saved is None else f"calibration made {saved.time}",
        "noise_Eo_per_rtHz": density,
        "walk_Eo_per_rts": walk,
        "follows_within_s": density / (np.sqrt(2.0) * walk) if walk > 0.0 else None,
        "forget_s": forget if np.isfinite(forget) else None,
        "effects": [e.id for e in m.model.effects],
        "flights": [entry for _, entries in found for entry in entries],
    }
    return Watched(name=m.name, result=result, series=() if output is not None else tuple(series))


def _density(m: Loaded, saved: Saved | None) -> float:
    """What a kept calibration left in the cross channel, Eo/sqrt(Hz)."""
    left = None if saved is None else saved.error.get("calibrated", {}).get("cross_Eo_per_rtHz")
    if not isinstance(left, float) or not left > 0.0:
        raise UserError(
            "how large the noise is cannot be known",
            where=m.directory.path,
            found="no saved calibration"
            if saved is None
            else "a saved calibration without a demodulated error",
            remedy="say it: --noise 2 (Eo/sqrt(Hz) of the cross channel), or calibrate first: ragg calibrate ... --save",
        )
    return left


def _written(output: Path | None, series: Sequence[Mapping[str, Array]]) -> None:
    if output is None:
        return
    units = {n: "s" if n == "time" else "Eo" for n in series[0]}
    units |= {"flight": "1"} if len(series) > 1 else {}
    with writing(output, sum(len(s["time"]) for s in series), units) as write:
        for k, s in enumerate(series, 1):
            write({**s, "flight": np.full(len(s["time"]), k)})
