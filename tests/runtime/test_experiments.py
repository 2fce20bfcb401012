"""The paper's experiments: against independent formulas, limits and the printed numbers."""

from __future__ import annotations

import numpy as np
import pytest
from click.testing import CliRunner

from ragg_runtime.experiments.__main__ import main
from ragg_runtime.experiments.paper import (
    Channels,
    Experiment,
    Printed,
    PrintedEntry,
    find_error,
    judge,
    write_page,
)
from ragg_runtime.experiments.regular import (
    find_centre,
    repeat_dynamic,
    repeat_multifrequency,
    run_mass,
    run_regular,
    subtract_centre,
)
from ragg_runtime.experiments.turbulence import repeat_turbulence
from ragg_runtime.reference.gravity import G
from ragg_runtime.reference.scenario import table_v


@pytest.fixture(scope="module")
def third_a() -> Experiment:
    return repeat_multifrequency()


@pytest.fixture(scope="module")
def third_b() -> Experiment:
    return repeat_dynamic()


@pytest.fixture(scope="module")
def third_c() -> Experiment:
    return repeat_turbulence()


@pytest.fixture(scope="module")
def beside_the_mass() -> tuple[Channels, dict[str, Channels]]:
    """The centre gradients, and what the models differ from them."""
    run = run_mass()
    found = dict(subtract_centre(run))
    return find_centre(run, found["numerical"]), found


def _row(rows: tuple[PrintedEntry, ...], quantity: str) -> PrintedEntry:
    (found,) = (r for r in rows if r.quantity == quantity)
    return found


def test_a_number_is_met_to_its_last_digit_and_a_disagreement_open_only_within_reach() -> None:
    for text, ours, agrees in (
        ("-0.72", -0.7249, True),
        ("-0.72", -0.7251, False),
        ("4.54e-4", 4.55e-4, False),
    ):
        assert (judge("x", Printed(text, "Eo", "here"), ours).verdict == "agrees") is agrees
    about = Printed("1e-3", "V", "here", order=True)
    assert [about.matches(x) for x in (9e-3, 2e-4, 1.1e-2, -1e-3)] == [True, False, False, False]
    printed = Printed("1.0", "Eo", "here")
    row = judge("x", printed, 3.0, reach=(0.5, 4.0), open_input="why", unexplained="no")
    assert (row.verdict, row.reason) == ("open input", "why")
    assert judge("x", printed, 3.0, reach=(2.0, 4.0), open_input="why", unexplained="no").reason == "no"
    assert judge("x", printed, 3.0, unexplained="no").verdict == "unexplained"


def test_centre_gradient_is_that_of_a_point_mass(beside_the_mass) -> None:
    c, _ = beside_the_mass
    angle = np.deg2rad(c.time + 0.1 / 0.0628 * (1 - np.cos(0.0628 * c.time)))
    amplitude = 3 * G * 486 / 1.2**3 * 1e9
    np.testing.assert_allclose(c.inline, amplitude * np.cos(2 * angle), rtol=0, atol=1e-9)
    np.testing.assert_allclose(c.cross, amplitude / 2 * np.sin(2 * angle), rtol=0, atol=1e-9)


def test_derived_models_measure_the_centre(beside_the_mass, third_a) -> None:
    _, found = beside_the_mass
    for model in ("analytical", "simplified"):
        assert np.abs([found[model].inline, found[model].cross]).max() < 1e-4
    assert _row(third_a.rows, "numerical minus centre, largest of both channels").verdict == "agrees"


def test_analytical_error_is_second_order_coefficients_times_angles() -> None:
    run = run_regular(effects={"second-order-misalignment": {"kappa": 0.0}})  # without angles in Eq. 5
    assert np.abs(find_error("analytical", run)).max() < 1e-8
    assert np.abs(run.G_out).max() > 1e5
    zero = dict.fromkeys(("K2", "K4", "K5", "K6", "K7", "K8"), 0.0)
    assert np.abs(find_error("analytical", run_regular(table_v().replace(**zero)))).max() < 1e-8


def test_the_page_counts_the_verdicts_of_all_printed_numbers(third_a, third_b, third_c) -> None:
    text = write_page([third_a, third_b, third_c])
    assert "Of 41 printed numbers, **15 agree**, **19 depend on an input" in " ".join(text.split())
    for row in third_c.rows:
        assert f"| {row.quantity} | {row.printed.text} |" in text


def test_the_command_prints_the_page_of_one(third_b: Experiment) -> None:
    assert CliRunner().invoke(main, ["dynamic"]).stdout == write_page([third_b])
    assert all(r.reason or r.verdict == "agrees" for r in third_b.rows)
