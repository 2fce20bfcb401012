"""What a computer on board would have found: flights sample by sample through the recursive filter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.recursive import Tuning, followed, following
from ragg_runtime.compensation.saved import Saved
from ragg_runtime.flight import Flight
from ragg_runtime.workflow.loaded import Loaded


def online(
    m: Loaded,
    flights: Sequence[Flight],
    saved: Saved | None,
    noise: float | None,
    walk: float | None,
    forget: float,
) -> tuple[dict[str, Any], list[Mapping[str, NDArray[Any]]]]:
    """Calibrate and compensate sample by sample, every flight from the calibration that is kept, else from the sheet.

    What is said of it, and the columns of every flight. Arguments as of :func:`ragg_runtime.workflow.after.compensate`.
    """
    density = _density(m, saved) if noise is None else noise
    walk = following(density) if walk is None else walk
    asked = Tuning(noise=density, walk=walk, forget=forget)
    found = [followed(m.model, m.instrument, x, saved, asked) for x in flights]
    result = {
        "calibration": "online",
        "started": "sheet" if saved is None else f"calibration made {saved.time}",
        "noise_Eo_per_rtHz": density,
        "walk_Eo_per_rts": walk,
        "follows_within_s": density / (np.sqrt(2.0) * walk) if walk > 0.0 else None,
        "forget_s": forget if np.isfinite(forget) else None,
        "effects": [e.id for e in m.model.effects],
        "flights": [entry for _, entries in found for entry in entries],
    }
    several = len(found) > 1
    return result, [
        {**s, "flight": np.full(len(s["time"]), k)} if several else s for k, (s, _) in enumerate(found, 1)
    ]


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
