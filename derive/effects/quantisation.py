from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from derive.effect import Effect, shared

Array = NDArray[np.float64]

ENOUGH = 1 << 20
"""Samples that show a lattice, if there is one."""

COARSE = 0.5
"""Quantisation step, in standard deviations of the noise, from which it is reported."""


GAPS = 100
"""Smallest distances of values whose common divisor is the step: the closest two of a wide range are several steps apart."""

OFF = 1e-3
"""Part of a step by which values may lie off its multiples, to the rounding of the file."""


def present(values: Array, valid: NDArray[np.bool_], noise: float) -> bool:
    """Of an output (N,), V, with the standard deviation of its noise, V."""
    return quantisation(values, valid, noise) is not None


def quantisation(G: Array, valid: NDArray[np.bool_], noise: float) -> float | None:
    """Quantisation step of an output, V, if it is not negligible against the noise."""
    values = np.unique(G[:ENOUGH][valid[:ENOUGH]])
    if len(values) < 3:
        return None
    steps = np.diff(values)
    q = float(np.min(steps))
    for distance in np.sort(steps)[:GAPS].tolist():
        while q >= COARSE * noise and (left := abs(distance - round(distance / q) * q)) > OFF * q:
            distance, q = q, left  # Euclid's algorithm
    if q < COARSE * noise:
        return None
    q = float(np.median(steps / np.rint(steps / q)))
    q = float(np.sum(steps) / np.rint(np.sum(steps) / q))
    if np.max(np.abs(values / q - np.rint(values / q))) > OFF:
        return None
    return q


EFFECT = Effect(
    id="quantisation",
    title="Quantisation of the output",
    physics="The converter of G_out has finite steps: the recorded values are multiples of a step.",
    source="resolution of the output converter",
    equation=r"G_{out} \leftarrow q\, \mathrm{round}(G_{out}/q)",
    limits="Uniform steps through zero, of G_out only.",
    kind="output",
    parameters=(shared("q", "q", "V", "step of the recorded output", 1e-3, fitted=False),),
)
