"""What small changes of the parameters make of an output, as weighted means over neighbouring samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.model.native.arguments import Series
from ragg_runtime.model.native.backends import Compiled, Evaluator

Array = NDArray[np.float64]

TOGETHER = 16
"""Parameter vectors that the generated C takes at a time."""

LONGEST = 128
"""Samples of a mean, at most, in the generated C: those of a block."""


def changes(
    e: Evaluator,
    t: Array,
    x: Series,
    p: Array,
    steps: Array,
    angle: Array,
    few: int,
    weights: Array,
    which: int = 0,
) -> Array:
    """(k, 2, N // few): means over ``few`` samples of G_out(p + step) - G_out(p), of each step, times ``weights`` (2,
    N).

    ``t`` (N,) s, ``x`` of each input (N,) SI or ``None``, ``angle`` (N,) rad; ``p`` (size,), ``steps`` (k, size), SI;
    ``which``: output.
    """
    count = len(t) // few
    if isinstance(e, Compiled) and e.folded and not e.several and few <= LONGEST:
        found = np.empty((len(steps), 2, count))
        weights = np.ascontiguousarray(weights)
        for first in range(0, len(steps), TOGETHER):
            some = slice(first, first + TOGETHER)
            e.library.changes("folded", e.case(t, x, p, angle), p + steps[some], few, weights, found[some])
        return found
    reference = e.output(t, x, p, angle, which=which)
    by_group = weights[:, : count * few].reshape(2, count, few) / few
    return np.array(
        [
            np.einsum(
                "nf,wnf->wn",
                (e.output(t, x, p + step, angle, which=which) - reference)[: count * few].reshape(count, few),
                by_group,
            )
            for step in steps
        ]
    ).reshape(len(steps), 2, count)
