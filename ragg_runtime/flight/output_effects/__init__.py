"""Effects of the recorder, each recognised in the values of the output: one file each, found by its name.

``<id with underscores>.py`` has ``present(values, valid, noise)``. What the effect *is* says the file of the same name in
``derive/effects/``, with ``kind="output"``.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterable
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
    return [e for e, r in recognisers().items() if e in known and r.present(values, valid, noise)]
