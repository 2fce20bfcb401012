"""Flights simulated for a model directory."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from ragg_runtime import api, reference
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.simulate import simulate_flight


def test_flights_are_of_one_instrument_unless_another_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A calibration of the first flight holds on the second."""
    true: list[Instrument] = []
    simulate = reference.simulate

    def watched(instrument: Instrument, *rest: object, **options: object) -> object:
        true.append(instrument)
        return simulate(instrument, *rest, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(reference, "simulate", watched)
    m = api.new(tmp_path / "m")
    one, two, _ = (
        simulate_flight(m.instrument, [], seed=k, instrument_seed=n, duration=10.0)
        for k, n in ((1, 0), (2, 0), (1, 3))
    )
    first, second, third = (i.accelerometers["K0"] for i in true)
    np.testing.assert_array_equal(first, second)
    assert np.all(first != third)
    assert np.all(one.channels["a_x"] != two.channels["a_x"])
