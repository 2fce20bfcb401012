"""The audit's exact evaluation, its dynamic experiment and its numbers, against independent statements."""

from __future__ import annotations

import math

import pytest

from derive.audit import direct, experiment, proof
from derive.audit.compare import derived_amplitude, derived_transducer, printed_order, select
from derive.audit.reading import model_reader
from derive.propagation import collect


def amplitudes():
    c = collect()
    return {n: select(derived_amplitude(c, n), printed_order) for n in c.amplitudes}


@pytest.mark.parametrize("seed", [1, 2])
def test_derivation_equals_direct_evaluation_exactly(seed):
    for p in direct.points(3, seed):
        value = direct.output(p)
        assert value != 0
        assert proof.output(amplitudes(), p) == value
        for j in range(4):
            assert proof.current(derived_transducer(), p, j) == direct.current(p, j, p.a)


# --- dynamic experiment ---


def test_scale_factor_is_the_papers():
    assert experiment.scale_factor() * experiment.EOTVOS == pytest.approx(4.54e-4, rel=1e-3)


def test_signal_costs_what_it_is():
    """k_ggi T_1 sin 2 phi demodulates to 2 mean(T_1): T_1 has no fourth harmonic."""
    c = experiment.cost({"A_2s": model_reader().read(r"T_1 \sum_{k_1 R}")})
    per_hour = math.pi / 648000
    mean = (1500**2 + 900**2 / 2 - 1000**2 - 700**2 / 2) / 2 * per_hour**2 / 1e-9
    assert c.inline == pytest.approx(2 * mean, rel=1e-12)
    # The harmonics of T_1 (once and twice the spin rate) do not leak into the other channel.
    assert c.cross == pytest.approx(0, abs=1e-6 * mean)


def test_demodulation_rejects_constants_and_the_first_harmonic():
    read = model_reader().read
    c = experiment.cost({"A_0": read("D_{k_0}^{1234}"), "A_1c": read("D_{k_0}^{12}")})
    assert c.rms > 0
    assert (c.inline, c.cross) == (0, 0)
