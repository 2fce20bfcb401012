"""Noise that all accelerometers of a disc share must not hide what only their differences show."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ragg_runtime.api import example
from ragg_runtime.estimation.fitted import estimate_variance
from ragg_runtime.simulate import simulate_flight
from tests.rate import RATE
from tests.runtime.diagnosed import diagnosed

SIGNS = np.array([1.0, 1.0, -1.0, -1.0])


def test_an_effect_is_found_beside_a_shake_that_all_accelerometers_share() -> None:
    i = example()
    x = simulate_flight(
        i, ["cubic-input:K_iii=0/3/0/0"], seed=4, duration=100.0, rate=RATE, voltages=True, no_gradient=False
    )
    G = sum(s * x.outputs[f"V_{j}"] for j, s in enumerate(SIGNS, 1))
    shake = 30.0 * np.std(np.diff(G)) * np.random.default_rng(5).standard_normal(len(G))
    volts = {f"V_{j}": x.outputs[f"V_{j}"] + shake for j in range(1, 5)}  # cancels in G_out
    d = diagnosed(i, replace(x, outputs=volts))
    assert d.found == ("cubic-input",)
    assert d.final is not None
    (prepared,) = d.final.prepared
    assert np.sqrt(estimate_variance(prepared)) < 0.1 * np.std(shake)
