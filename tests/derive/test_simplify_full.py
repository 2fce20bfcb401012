"""Simplified models of full kinematics: certified bounds, and samples of what they bound."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from numpy.typing import NDArray

from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS, Collected, collect, motion_numbers
from derive.simplify import (
    DYNAMIC_EXPERIMENT,
    PAPER_ENVELOPE,
    Envelope,
    certified_bound,
    simplified,
)
from derive.symbols import MOTION, QUARTER_TURNS, SIGNS, SPIN_ACCELERATION, SPIN_RATE, symbol

Array = NDArray[np.float64]
FULL = replace(PAPER_ENVELOPE, kinematics="full", spin_acceleration=1e-3)
DYNAMIC_FULL = replace(DYNAMIC_EXPERIMENT, kinematics="full")


def output(model: Collected, motion: dict[str, Array], p: dict[str, Array], phi: Array) -> Array:
    """G_out over k_ggi, Eo, of a collected model; k1 in units of the nominal one."""
    numbers = [motion[n] for n in MOTION_NUMBERS]
    G = np.zeros(phi.size)
    for j, (sign, quarter) in enumerate(zip(SIGNS, QUARTER_TURNS, strict=True)):
        psi = phi + quarter * np.pi / 2
        values = [p[n][j] for n in COEFFICIENT_PARAMETERS]
        for (n, phase), terms in model.generic.items():
            wave = np.cos(n * psi) if phase == "c" else np.sin(n * psi)
            for powers, coefficient in terms.items():
                size = sum(
                    float(c) * np.prod([v**e for v, e in zip(values, m, strict=True) if e])
                    for m, c in coefficient.terms()
                )
                G += (
                    sign
                    * size
                    * wave
                    * np.prod([v**e for v, e in zip(numbers, powers, strict=True) if e], axis=0)
                )
    return G / np.sum(p["k1"] * p["R"]) / 1e-9


def drawn(
    envelope: Envelope, seed: int, samples: int = 200
) -> tuple[dict[str, Array], dict[str, Array], Array]:
    """Motion numbers, parameters and angles: corners of the envelope, and points inside."""
    rng = np.random.default_rng(seed)
    spin = 2 * np.pi * envelope.spin_frequency

    def within(bound: Fraction) -> Array:
        return float(bound) * np.where(
            rng.random(samples) < 0.7, rng.choice([-1.0, 1.0], samples), rng.uniform(-1, 1, samples)
        )

    x = {c.name: within(envelope.channel(c.name)) for c in MOTION}
    x |= {
        SPIN_RATE.name: np.full(samples, spin),
        SPIN_ACCELERATION.name: within(Fraction(envelope.spin_acceleration)),
    }
    symbols = [symbol(n) for n in x]
    found = {
        n: np.broadcast_to(sp.lambdify(symbols, e)(*x.values()), samples)
        for n, e in motion_numbers(envelope.kinematics).items()
    }
    found |= {n: x[n] for n in ("a_x", "a_y", "a_z")}
    p = {
        n: float(envelope.parameter(n)) * rng.choice([-1.0, 1.0], 4)
        for n in COEFFICIENT_PARAMETERS
        if n not in ("k1", "R")
    }
    p["k1"] = 1 + envelope.imbalance * rng.choice([-1.0, 1.0], 4)
    p["R"] = envelope.radius + envelope.dR * rng.choice([-1.0, 1.0], 4)
    return found, p, rng.uniform(0, 2 * np.pi, samples)


@pytest.mark.parametrize("envelope", [FULL, DYNAMIC_FULL], ids=["paper", "dynamic"])
def test_what_a_simplified_model_of_full_kinematics_misses_is_bounded(envelope: Envelope) -> None:
    model, full = simplified(envelope), collect()
    terms = [sum(len(c) for t in m.generic.values() for c in t.values()) for m in (model, full)]
    assert terms[0] < terms[1]
    bound = certified_bound(envelope, model).eotvos
    worst = 0.0
    for seed in range(20):
        motion, p, phi = drawn(envelope, seed)
        worst = max(
            worst, float(np.max(np.abs(output(full, motion, p, phi) - output(model, motion, p, phi))))
        )
    assert 0 < worst <= bound
    assert worst > bound / 50  # no empty promise


def test_the_spin_makes_terms_that_the_paper_may_drop_matter() -> None:
    """The paper's own simplified model, with the spin in its numbers, misses a thousand eotvos."""
    of_paper = certified_bound(FULL, simplified(PAPER_ENVELOPE)).eotvos
    of_full = certified_bound(FULL, simplified(FULL)).eotvos
    assert of_paper > 100 * of_full
    assert of_full < 20
