"""Whether a calibration has arrived: its own word, and what a fit to half of the record says of it."""

from __future__ import annotations

import numpy as np

from ragg_runtime.fit.calibrate import Calibration
from ragg_runtime.fit.score import Error

BEATEN = 1.5
"""Error of the calibration over that of a fit to half of the record, on the other half, from which it is no optimum: what
is fitted to everything can hardly do worse there than what has not seen it."""

FAR = 10.0
"""Error of the fit to half of the record, on the other half, over the calibration's from which the halves contradict each
other, or the linearisation about the calibration does not hold."""


def complaint(c: Calibration, calibrated: Error, half: Error) -> str | None:
    """Why a calibration is not to be trusted, in words; ``None`` if it is.

    ``calibrated`` and ``half`` are what the calibrated parameters, and those fitted to half of the record, leave of the
    other half.
    """
    if not c.converged:
        return f"the calibration has not converged: {c.reason}"
    whole, other = calibrated.rms_V, half.rms_V
    if not (np.isfinite(whole) and np.isfinite(other)):
        return None
    if whole > BEATEN * other:
        return (
            f"the calibration has not converged: on half of the record it leaves {whole / other:.3g} times as much"
            " as parameters that were fitted to the other half alone"
        )
    if other > FAR * whole:
        return (
            f"the calibration has not converged: parameters fitted to half of the record leave {other / whole:.3g}"
            " times as much on the other half"
        )
    return None
