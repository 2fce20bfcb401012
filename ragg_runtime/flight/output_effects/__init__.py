"""Effects of the recorder, each recognised in the values of the output: one file each, found by its name.

``<id with underscores>.py`` has ``present(values, valid, noise)``, and ``CHANNELS`` where it looks at columns of the motion
instead. What the effect *is* says the file of the same name in
``derive/effects/``, with ``kind="output"``.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterable, Mapping
from functools import cache
from typing import Protocol, cast

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Recogniser(Protocol):
    """A module that recognises an effect of the output channel. No chance is allowed for: what it says is certain."""

    def present(self, values: Array, valid: NDArray[np.bool_], noise: float) -> bool:
        """Whether an output (N,), V, shows it; ``valid`` (N,) are usable samples, ``noise`` its standard deviation, V."""


@cache
def recognisers() -> dict[str, Recogniser]:
    """Effect id -> its recogniser, in the order of the ids."""
    names = sorted(m.name for m in pkgutil.iter_modules(__path__))
    found = {n.replace("_", "-"): importlib.import_module(f"{__name__}.{n}") for n in names}
    return cast(dict[str, Recogniser], found)


def recognised(values: Array, valid: NDArray[np.bool_], noise: float, among: Iterable[str]) -> list[str]:
    """Those effects ``among`` some, by their ids, that an output shows."""
    known = set(among)
    of_output = {e: r for e, r in recognisers().items() if e in known and not hasattr(r, "CHANNELS")}
    return [e for e, r in of_output.items() if r.present(values, valid, noise)]


def recognised_in_motion(
    channels: Mapping[str, Array], valid: NDArray[np.bool_], among: Iterable[str]
) -> list[str]:
    """Those effects ``among`` some, by their ids, that the channels of a motion show."""
    known, found = set(among), []
    for e, r in recognisers().items():
        names = [n for n in getattr(r, "CHANNELS", ()) if e in known and n in channels]
        if any(r.present(channels[n], valid, 0.0) for n in names):
            found.append(e)
    return found
