"""What is left of all flights once a model is fitted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ragg_runtime.fit import prepared_flight
from ragg_runtime.fit.fitted import Fitted
from ragg_runtime.lack_of_fit import omnibus
from ragg_runtime.lack_of_fit.features import term_unit
from ragg_runtime.lack_of_fit.omnibus import Omnibus


@dataclass(frozen=True)
class Remainder:
    """What is left of all flights: one search of the dictionary a flight."""

    searches: tuple[Omnibus, ...]

    @property
    def log_p(self) -> float:
        """Significance of the largest score of all flights."""
        return min(0.0, min(s.log_p for s in self.searches) + float(np.log(len(self.searches))))

    @property
    def significant(self) -> bool:
        return bool(self.log_p < np.log(omnibus.FAMILY))


def remainder(f: Fitted, given: Sequence[int] = ()) -> Remainder:
    """Search what is left once base and ``given`` candidate columns are projected out."""
    found = []
    for x, triangles in zip(f.prepared, f.triangles, strict=True):
        lean, projector, _ = prepared_flight.projector(triangles, f.n_base, given).lean(x)
        found.append(omnibus.search(lean, projector, lambda piece, y: None)[0])
    return Remainder(tuple(found))


def terms_json(rem: Remainder, mean_squares: Sequence[float]) -> list[dict[str, object]]:
    """Generic terms in residuals of these mean squares, V^2, largest first; ``share`` is of the power."""
    best: dict[tuple[str, str], dict[str, object]] = {}
    for s, power in zip(rem.searches, mean_squares, strict=True):
        for t in s.terms:
            key = (t.term.harmonic, t.term.product)
            row = {
                "harmonic": t.term.harmonic,
                "term": t.term.product,
                "coefficient": float(t.coefficient),
                "std": float(t.std),
                "unit": term_unit(t.term.channels),
                "share": min(1.0, t.mean_square / power),
                "z": t.z,
            }
            if key not in best or abs(t.z) > abs(float(str(best[key]["z"]))):
                best[key] = row
    return sorted(best.values(), key=lambda x: -abs(float(str(x["z"]))))
