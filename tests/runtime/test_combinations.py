"""Noise that all accelerometers of a disc share must not hide what only their differences tell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from ragg_runtime.api import example
from ragg_runtime.estimation.fitted import estimated
from ragg_runtime.signals.combinations import basis, telling
from ragg_runtime.simulate import simulated
from tests.rate import RATE
from tests.runtime.diagnosed import diagnosed

SIGNS = np.array([1.0, 1.0, -1.0, -1.0])


def test_of_the_papers_disc_they_are_its_sums_and_differences() -> None:
    """D^1234, Sigma, D^12, D^34 of Eq. 18-19."""
    D12, D34 = np.array([1, -1, 0, 0]), np.array([0, 0, 1, -1])
    expected = np.stack([SIGNS / 2, np.ones(4) / 2, D12 / np.sqrt(2), D34 / np.sqrt(2)])
    assert basis(SIGNS) == pytest.approx(expected)


@pytest.mark.parametrize("signs", [(1, 1), (1, -1), (1, 1, 1), (1, -1, 1, -1), (1, 1, -1, -1, 1, 1, -1, -1)])
def test_of_any_signs_they_are_orthonormal_and_the_output_is_the_first(signs: tuple[int, ...]) -> None:
    s = np.array(signs, dtype=np.float64)
    rows = basis(s)
    assert rows @ rows.T == pytest.approx(np.eye(len(s)))
    assert rows[0] == pytest.approx(s / np.sqrt(len(s)))


def test_only_noise_that_is_shared_is_taken_apart() -> None:
    rng = np.random.default_rng(11)
    own = rng.standard_normal((4, 2000))
    assert telling(own, SIGNS) is None
    assert telling(own * np.array([[1.0], [1.0], [1.0], [10.0]]), SIGNS) is None
    assert telling(own[:1], SIGNS[:1]) is None
    apart = telling(own + 3.0 * rng.standard_normal(2000), SIGNS)
    assert apart is not None
    assert apart == pytest.approx(basis(SIGNS))


def test_an_effect_is_found_beside_a_shake_that_all_accelerometers_share() -> None:
    i = example()
    x = simulated(
        i, ["cubic-input:K_iii=0/3/0/0"], seed=4, duration=150.0, rate=RATE, voltages=True, no_gradient=False
    )
    G = sum(s * x.outputs[f"V_{j}"] for j, s in enumerate(SIGNS, 1))
    shake = 30.0 * np.std(np.diff(G)) * np.random.default_rng(5).standard_normal(len(G))
    volts = {f"V_{j}": x.outputs[f"V_{j}"] + shake for j in range(1, 5)}  # cancels in G_out
    shaken = replace(x, outputs=volts)
    d = diagnosed(i, shaken)
    assert d.found == ("cubic-input",)
    assert d.final is not None
    (prepared,) = d.final.prepared
    assert prepared.noise.combinations is not None
    assert np.sqrt(estimated(prepared)) < 0.1 * np.std(shake)
