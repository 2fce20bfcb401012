from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from derive.effect import Effect, shared

Array = NDArray[np.float64]

CLIPPED = 5
"""Samples at one and the same extreme value that make a saturated output."""


PART = 1 << 18
"""Samples that are looked at together."""


def present(values: Array, valid: NDArray[np.bool_], noise: float) -> bool:
    """Of an output (N,), V; the noise, V, does not matter."""
    return bool(np.any(clipped(values, valid)))


def clipped(values: Array, valid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(N,): the samples of an output that are at its extreme value, if there are many."""
    at = np.zeros(len(values), dtype=np.bool_)
    top = largest(values, valid)
    for rows, size in sizes(values, valid):
        at[rows] = size >= top * (1 - 1e-12)
    # a short record at coarse quantisation may repeat its maximum: neighbours at the top show clipping
    neighbours = np.count_nonzero(at[1:] & at[:-1])
    if top == 0.0 or np.count_nonzero(at) < CLIPPED or neighbours < 2:
        at[:] = False
    return at


def largest(values: Array, valid: NDArray[np.bool_]) -> float:
    """The largest absolute value."""
    return float(np.max([np.max(size) for _, size in sizes(values, valid)], initial=0.0))


def sizes(values: Array, valid: NDArray[np.bool_]) -> Iterator[tuple[slice, Array]]:
    """Rows and their absolute values, 0 where not valid, part by part: what lies on disk need not fit into memory."""
    for start in range(0, len(values), PART):
        rows = slice(start, start + PART)
        yield rows, np.abs(np.where(valid[rows], values[rows], 0.0))


EFFECT = Effect(
    id="saturation",
    title="Saturation of the output",
    physics="The amplifier or converter of G_out has a limit, which is recorded in place of larger values.",
    source="range of the output converter",
    equation=r"G_{out} \leftarrow \min(\max(G_{out}, -V_{max}), V_{max})",
    limits="Symmetric, of G_out only; single accelerometers do not saturate.",
    kind="output",
    parameters=(
        shared(
            "V_max",
            "V_{max}",
            "V",
            "largest output that is recorded",
            10.0,
            neutral=float("inf"),
            fitted=False,
        ),
    ),
)
