"""Outputs that were recorded more seldom than the motion, and filled in: only what was recorded is used."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.io import Flight
from ragg_runtime.model import model
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.screening import examined
from ragg_runtime.screening.filled_in import without_filling

N = 4096


def flight(x: np.ndarray) -> Flight:
    return Flight(time=np.arange(len(x)) / 16.0, channels={}, outputs={"inline": x, "cross": 2.0 * x})


def smooth(seed: int = 0) -> np.ndarray:
    """A series in the band of a demodulator, 0.2 Hz at 16 Hz."""
    x = np.random.default_rng(seed).standard_normal(N + 200)
    return np.convolve(x, np.hanning(81), "same")[100:-100]


@pytest.mark.parametrize("every", [2, 4, 16, 160])
@pytest.mark.parametrize("first", [0, 1])
@pytest.mark.parametrize("how", ["repeated", "joined by straight lines"])
def test_values_between_the_recorded_ones_are_not_used(every: int, first: int, how: str) -> None:
    x, k = smooth(), np.arange(first, N, every)
    if how == "repeated":
        y = x[np.maximum(((np.arange(N) - first) // every) * every + first, 0)]
    else:
        y = np.round(np.interp(np.arange(N), k, x[k]), 7)
    found, notes = without_filling(flight(y))
    there = np.flatnonzero(np.isfinite(found.outputs["cross"]))
    np.testing.assert_array_equal(there[1:-1], k[1:-1] if there[0] == k[0] else k[: len(there)][1:-1])
    assert notes == [
        f"inline, cross: recorded every {every / 16:.4g} s and {how} in between; only what was recorded is used"
    ]


@pytest.mark.parametrize(
    "x",
    [
        smooth(),
        np.round(smooth(), 0),
        np.round(np.random.default_rng(1).standard_normal(N), 0),
        np.where(np.random.default_rng(2).random(N) < 0.4, np.nan, smooth()),
        np.zeros(N),
        np.arange(N) * 1.0,
    ],
    ids=["smooth", "quantised", "quantised noise", "gaps", "still", "a ramp"],
)
def test_other_series_are_left_alone(x: np.ndarray) -> None:
    y = flight(x)
    assert without_filling(y) == (y, [])


def test_an_output_that_is_repeated_too_seldom_for_the_disc_is_refused() -> None:
    s = scenario(72, duration=120.0)
    x = s.simulate().flight()
    held = {n: v[np.arange(N)[: len(v)] // 16 * 16] for n, v in x.outputs.items()}
    with pytest.raises(UserError, match="the output is sampled too slowly for the disc"):
        examined(model.packaged(), s.sheet, replace(x, outputs=held))
