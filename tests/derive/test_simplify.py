"""Eq. 31-47 and Tables I to III: what the rule keeps, and why."""

from __future__ import annotations

import dataclasses
import math
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from derive.effects import catalogue
from derive.propagation import COEFFICIENT_PARAMETERS, MOTION_NUMBERS, Collected, collect
from derive.simplify import (
    DYNAMIC_EXPERIMENT,
    PAPER_ENVELOPE,
    Envelope,
    critical_conditions,
    simplified,
    sizes,
)
from derive.simplify.page import Condition
from derive.symbols import ANGLES, SECOND_ORDER
from ragg_runtime.estimation.regressors import list_base_columns
from ragg_runtime.model.model import packaged
from ragg_runtime.reference.instruments import table_v

G = 9.8
Key = tuple[int, tuple[int, ...], tuple[int, ...]]


def keys(model: Collected) -> set[Key]:
    return {
        (n, motion, parameters)
        for (n, _), terms in model.generic.items()
        for motion, coefficient in terms.items()
        for parameters in coefficient.monoms()
    }


def size_of(envelope: Envelope, harmonic: int, motion: str, parameters: str) -> float:
    """The size of the term that a harmonic and two lists of factors name, in Eo."""
    powers = tuple(motion.split().count(n) for n in MOTION_NUMBERS)
    of = tuple(parameters.split().count(n) for n in COEFFICIENT_PARAMETERS)
    found = [s for s in sizes(envelope) if (s.harmonic, s.motion, s.parameters) == (harmonic, powers, of)]
    assert len(found) == 1
    return float(found[0].eotvos)


# --- Eq. 42-47 -----------------------------------------------------------------------------------------


def test_the_dynamic_experiment_needs_what_the_paper_drops_by_mistake() -> None:
    """All that Tables V and VI ask for beyond Eq. 42-47 is K T a, whose critical T is misprinted."""
    more = keys(simplified(DYNAMIC_EXPERIMENT)) - keys(simplified())
    assert keys(simplified()) < keys(simplified(DYNAMIC_EXPERIMENT))
    for _, motion, parameters in more:
        powers = dict(zip(COEFFICIENT_PARAMETERS, parameters, strict=True))
        assert any(powers[n] for n in SECOND_ORDER)
        assert any(motion[:3])
        assert any(motion[3:])


def test_the_signal_is_never_dropped() -> None:
    at_rest = PAPER_ENVELOPE.scaled(("a", "omega", "omegadot", "Gamma", "K0"), 0.0)
    model = simplified(at_rest)
    assert {n: len(t) for n, t in model.amplitudes.items() if t} == {"A_2s": 1, "A_2c": 1}


# --- sizes ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("harmonic", "motion", "parameters", "eotvos"),
    [
        # Eq. 37: 0.25 K a a / R, half of it for a_x^2
        (0, "a_x a_x", "k1 K2", 0.5 * 0.25 * 1e-6 / G * (0.1 * G) ** 2 / 0.1 * 1e9),
        # Eq. 37a: 0.25 x 1e-4 a / R
        (1, "a_x", "k1", 0.25 * 1e-4 * 0.1 * G / 0.1 * 1e9),
        # Eq. 38: 0.25 K T a, with T_6 = omegadot_z
        (0, "a_z T_6", "k1 R K4", 0.25 * 1e-6 * 1e-3 * 0.1 * 1e9),
        # Eq. 41
        (1, "a_x", "k1 vartheta_z", 0.25 * 1e-4 * 0.1 * G / 0.1 * 1e9),
        (1, "a_x", "k1 beta_x vartheta_y", 0.25 * 1e-8 * 0.1 * G / 0.1 * 1e9),
        # the imbalance of k1 R: 1e-4 of k1 and 35 um of 0.1 m
        (0, "T_6", "k1 R", 0.25 * ((1 + 1e-4) * (1 + 35e-5) - 1) * 1e-3 * 1e9),
        (0, "", "k1 K0", 0.25 * 10e-6 * G / 0.1 * 1e9),
    ],
)
def test_sizes_are_those_of_the_papers_equations(
    harmonic: int, motion: str, parameters: str, eotvos: float
) -> None:
    assert size_of(PAPER_ENVELOPE, harmonic, motion, parameters) == pytest.approx(eotvos, rel=1e-12)


@settings(max_examples=15, deadline=None, derandomize=True)
@given(
    st.sampled_from(["a", "omega", "omegadot", "Gamma", *ANGLES, *SECOND_ORDER, "K0", "imbalance"]),
    st.floats(-3, 3),
    st.floats(0, 1),
)
def test_a_wider_envelope_keeps_no_less(name: str, exponent: float, more: float) -> None:
    narrow = PAPER_ENVELOPE.scaled((name,), 10**exponent)
    assert keys(simplified(narrow)) <= keys(simplified(narrow.scaled((name,), 1 + more)))


def test_the_dynamic_envelope_holds_the_experiment() -> None:
    """Tables V and VI, motion over one turn of the disc and its exact derivative."""
    e, hour = DYNAMIC_EXPERIMENT, math.radians(1) / 3600
    turn = np.linspace(0, 2 * math.pi, 401)
    for n, (mean, amplitude) in enumerate(((0.08, 0.005), (0.06, 0.006), (0.1, 0.05))):
        assert np.max(mean + amplitude * np.sin(turn)) * G == pytest.approx(e.a[n], rel=1e-12)
    for n, (mean, amplitude) in enumerate(((1000, 700), (1500, 900), (2000, 800))):
        assert np.max(mean + amplitude * np.sin(turn)) * hour == pytest.approx(e.omega[n], rel=1e-12)
        assert amplitude * hour * 2 * math.pi * 0.25 == pytest.approx(e.omegadot[n], rel=1e-12)
    k1 = np.array([10, 11, 11.5, 12])
    assert np.max(np.abs(k1 / k1.mean() - 1)) <= e.imbalance


@pytest.mark.parametrize(
    "change",
    [{"a": (1.0, -1.0, 0.0)}, {"K7": math.nan}, {"imbalance": 1.0}, {"dR": 0.2}, {"Gamma": math.inf}],
)
def test_an_envelope_that_is_none_is_refused(change: dict[str, object]) -> None:
    with pytest.raises(ValueError):
        dataclasses.replace(PAPER_ENVELOPE, **change)  # type: ignore[arg-type]


# --- Tables I to III -----------------------------------------------------------------------------------


def condition(where: str, envelope: Envelope = PAPER_ENVELOPE) -> Condition:
    return next(c for c in critical_conditions(envelope) if c.kind.where == where)


@pytest.mark.parametrize(
    ("where", "printed"),
    [
        ("Table I", 2e8),
        ("Table III, row 1", 4e3),
        ("Table III, row 2", 4e7),
        ("Table III, row 3", 4e11),
        ("below Eq. 37", 2e-3),
        ("below Eq. 37a", 4e-8),
        ("below Eq. 41, one angle", 4e-8),
        ("below Eq. 41, two angles", 4e-4),
        ("below Eq. 41, three angles", 4.0),
    ],
)
def test_critical_values_are_the_printed_ones_to_their_digit(where: str, printed: float) -> None:
    c = condition(where)
    computed = c.critical / (1e-9 if c.angular else G)
    assert computed == pytest.approx(printed, rel=0.05)


@pytest.mark.parametrize("where", ["Table I", "Table II", "Table III, row 1", "Table III, row 3"])
def test_critical_motion_just_satisfies_eq_33(where: str) -> None:
    c = condition(where)
    assert c.angular is not None
    w, wd = c.angular.omega, c.angular.omegadot
    T = {"1": w**2 / 2, "2": w**2, "3": wd + w**2, "4": w**2 + wd, "5": 0.5 * 4 * w**2, "6": wd}
    assert max(T.values()) == pytest.approx(c.critical, rel=1e-12)
    assert T["5"] == pytest.approx(c.critical, rel=1e-12)
    assert T["3"] == pytest.approx(c.critical, rel=1e-12)
    assert c.angular.amplitude == pytest.approx(min(w, wd / (2 * math.pi * 0.25)), rel=1e-12)


def test_at_the_critical_acceleration_the_term_has_the_error_allotted() -> None:
    """The table of conditions and the sizes that the model is chosen by are one measure."""
    for where, motion, parameters in (
        ("below Eq. 37a", "a_x", "k1"),
        ("below Eq. 41, one angle", "a_x", "k1 vartheta_z"),
        ("below Eq. 41, two angles", "a_x", "k1 beta_x vartheta_y"),
        ("below Eq. 41, three angles", "a_x", "k1 beta_x beta_z vartheta_y"),
    ):
        a = condition(where).critical
        envelope = dataclasses.replace(PAPER_ENVELOPE, a=(a, a, a))
        assert size_of(envelope, 1, motion, parameters) == pytest.approx(0.1, rel=1e-9)


def test_the_page_counts_parameters_as_the_code_does() -> None:
    """52 of accelerometers, two of the disc; the combinations of both models; and each effect that it names is one."""
    page = (Path(__file__).parents[2] / "docs" / "explanation" / "instrument.md").read_text("utf-8")
    text = page[page.index("## How many parameters") :]

    def combinations(model: Collected) -> int:
        terms = (t for of_harmonic in model.amplitudes.values() for t in of_harmonic)
        return len({(t.combination, t.coefficient.monic()) for t in terms})

    assert f"{len(list_base_columns(packaged(), table_v()))} |" in text
    assert f"in {combinations(simplified())} combinations" in text
    assert f"instead of {combinations(collect())}," in text
    there = {COEFFICIENT_PARAMETERS[k] for *_, powers in keys(collect()) for k, n in enumerate(powers) if n}
    assert "vartheta_x" not in there
    named = set(re.findall(r"`([a-z]+(?:-[a-z]+)+)`", text))
    assert len(named) > 10
    assert named <= {e.id for e in catalogue()}
