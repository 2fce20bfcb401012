"""Motion that was beyond the range of its sensors: recognised in the record, and believed where the model fails there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.fit.fitted import Fitted, fit
from ragg_runtime.fit.observation import MOTION_SATURATION, observations_of
from ragg_runtime.fit.passes import Piece
from ragg_runtime.flight import Flight
from ragg_runtime.flight.range_end import motion_at_the_end
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.model.record import recorded

Array = NDArray[np.float64]

LOUDER = 2.0
"""What the model leaves at the end of a range over what it leaves elsewhere, in power: a table that turns steadily at its
largest rate stands at one value, too, but there the model holds."""


def without(f: Fitted, flights: Sequence[Flight]) -> Fitted | None:
    """The flights fitted without samples at the end of a motion sensor's range; ``None`` if there are none."""
    if all(e.id != MOTION_SATURATION for e in f.model.candidates):
        return None
    masks = [_mask(x) for x in flights]
    if not any(m.any() for m in masks) or not _loud(f, flights, masks):
        return None
    effects = (*f.instrument.effects, EffectSetting(MOTION_SATURATION))
    instrument = replace(f.instrument, effects=effects)
    return fit(f.model, instrument, observations_of(flights, instrument))


def _mask(x: Flight) -> NDArray[np.bool_]:
    found = motion_at_the_end(x.channels, x.valid)
    return np.asarray(np.any([np.zeros(len(x), dtype=np.bool_), *found.values()], axis=0))


def _loud(f: Fitted, flights: Sequence[Flight], masks: Sequence[NDArray[np.bool_]]) -> bool:
    layout = f.instrument.layout
    of_observation = [
        m
        for x, m in zip(flights, masks, strict=True)
        for k in range(len(layout.outputs))
        if recorded(x, layout, k)
    ]
    sums = np.zeros((2, 2))  # (elsewhere, at the end) x (samples, squares)
    for w, mask in zip(f.prepared, of_observation, strict=True):

        def counted(piece: Piece, mask: NDArray[np.bool_] = mask) -> Array:
            valid = piece.observation.record.valid
            here = mask[piece.segment.rows][valid]
            e2 = np.sum(np.square(piece.residual[:, valid]), axis=0)
            return np.array([[np.sum(k), np.sum(e2[k])] for k in (~here, here)])

        for part in w.each(counted, whitened=False):
            sums += part
    (n, elsewhere), (m, end) = sums
    return bool(n and m and end / m > LOUDER * elsewhere / n)
