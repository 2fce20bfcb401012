"""How much of the output a model explains: one that explains nothing is not adequate, however quiet its residual is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ragg_runtime.fit import unknown_gradient
from ragg_runtime.fit.fitted import Fitted, Scored
from ragg_runtime.fit.observation import as_output


@dataclass(frozen=True)
class Explained:
    """What a model explains of the output.

    Attributes
    ----------
    share
        Of the power of the output about its mean.
    gain
        By how much its description of the output is better than a constant, by the BIC (G. Schwarz, Ann. Stat. 6, 1978): twice
        the gain in log likelihood less ln N for each of its parameters, of an unknown gradient's included.
    """

    share: float
    gain: float

    @property
    def complaint(self) -> str | None:
        """In words, that the model explains nothing; ``None`` if it explains something."""
        if self.gain > 0.0:
            return None
        return (
            f"nothing in the output follows the motion: the model explains {100 * self.share:.2g} % of it, no more than its"
            " parameters would of noise; is it the output of this flight and this instrument?"
        )


def explained(f: Fitted, scored: Scored) -> Explained:
    """What a fitted model that leaves a residual so large (``scored``) explains of the flights' outputs."""
    power = left = rows = 0.0
    parameters = float(f.n_base)
    for o, mean_square in zip(f.observations, scored.mean_square, strict=True):
        valid = o.record.valid
        count = float(np.sum(valid))
        G = as_output(o, o.data)[valid]
        power += float(np.var(G)) * count
        left += mean_square * count
        rows += count
        if unknown_gradient.unknown(o):
            span = float(o.record.time[-1] - o.record.time[0])
            parameters += 2 * (span / unknown_gradient.KNOT_SECONDS + 3)
    ratio = left / power if power > 0.0 else 1.0
    gain = -rows * float(np.log(max(ratio, 1e-300))) - parameters * float(np.log(max(rows, 1.0)))
    return Explained(share=max(0.0, 1.0 - ratio), gain=gain)
