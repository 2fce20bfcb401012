"""The audit's exact evaluation, its dynamic experiment and its numbers, against independent statements."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

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


def exchanged(p: direct.NumericPoint, order: tuple[int, ...]) -> direct.NumericPoint:
    return replace(p, accelerometers={n: tuple(v[j] for j in order) for n, v in p.accelerometers.items()})


def test_half_a_turn_exchanges_the_accelerometers_of_a_pair():
    for p in direct.points(3, 7):
        turned = replace(exchanged(p, (1, 0, 3, 2)), cosine=-p.cosine, sine=-p.sine)
        assert direct.output(turned) == direct.output(p)


def test_a_quarter_turn_exchanges_the_pairs_and_the_sign():
    for p in direct.points(3, 8):
        # A quarter turn ahead, A1 is where A3 was, A3 where A2 was, A2 where A4 was, A4 where A1 was.
        turned = replace(exchanged(p, (2, 3, 1, 0)), cosine=-p.sine, sine=p.cosine)
        assert direct.output(turned) == -direct.output(p)


def perfect(p: direct.NumericPoint) -> direct.NumericPoint:
    keep = {"k1": Fraction(3), "R": Fraction(1, 10)}
    return replace(p, accelerometers={n: (keep.get(n, Fraction(0)),) * 4 for n in p.accelerometers})


def test_a_perfect_instrument_sees_the_gradients_alone():
    """Eq. 30: k_ggi (T_1 sin 2 phi + T_2 cos 2 phi), whatever a and omegadot are."""
    for p in map(perfect, direct.points(5, 9)):
        (xx, xy, _), (_, yy, _), _ = p.Gamma
        wx, wy, _ = p.omega
        sin2, cos2 = 2 * p.sine * p.cosine, p.cosine**2 - p.sine**2
        T1, T2 = (xx - yy + wy**2 - wx**2) / 2, wx * wy - xy
        assert direct.output(p) == Fraction(12, 10) * (T1 * sin2 + T2 * cos2)


def test_points_are_rotations_and_harmonic_gradients():
    for p in direct.points(20, 10):
        assert p.cosine**2 + p.sine**2 == 1
        assert sum(p.Gamma[i][i] for i in range(3)) == 0


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


def test_costs_add():
    read = model_reader().read
    one, two = (
        {"A_2c": read(r"a_x a_y \sum_{k_6}")},
        {"A_2c": read(r"0.5(a_x^2-a_y^2)\sum_{k_5-k_2}")},
    )
    both = experiment.cost({"A_2c": one["A_2c"] + two["A_2c"]})
    assert both.cross == pytest.approx(experiment.cost(one).cross + experiment.cost(two).cross, rel=1e-12)
