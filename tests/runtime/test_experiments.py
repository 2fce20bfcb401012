"""The paper's experiments: against independent formulas, limits and the printed numbers."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from ragg_runtime.base.errors import UserError
from ragg_runtime.experiments import paper
from ragg_runtime.experiments.command import experiment
from ragg_runtime.experiments.dynamic import Dynamic, dynamic
from ragg_runtime.experiments.dynamic_checks import WholeAttraction, model_difference
from ragg_runtime.experiments.models import ANGLES_DROPPED, channels, error, output, over_turns
from ragg_runtime.experiments.multifrequency import MultiFrequency, multifrequency
from ragg_runtime.experiments.page import DEFAULT, page
from ragg_runtime.experiments.regular import WITH_MASS, regular_run
from ragg_runtime.experiments.result import Printed, Row, judge
from ragg_runtime.experiments.turbulence import Turbulence, turbulence
from ragg_runtime.experiments.turbulence_checks import _noise_for, statistics
from ragg_runtime.experiments.turbulent import gaussian, turbulent_motion, turbulent_run
from ragg_runtime.experiments.vartheta_x import response, smallest_angles, with_angles
from ragg_runtime.reference import simulate, still
from ragg_runtime.reference.gravity import G
from ragg_runtime.reference.instruments import perfect, table_v

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def third_a() -> MultiFrequency:
    return multifrequency()


@pytest.fixture(scope="module")
def third_b() -> Dynamic:
    return dynamic()


@pytest.fixture(scope="module")
def third_c() -> Turbulence:
    return turbulence()


def _row(rows: tuple[Row, ...], quantity: str) -> Row:
    (found,) = (r for r in rows if r.quantity == quantity)
    return found


# --- verdicts ---


@pytest.mark.parametrize(
    ("text", "ours", "agrees"),
    [
        ("-0.72", -0.7249, True),
        ("-0.72", -0.7251, False),
        ("4.54e-4", 4.5418e-4, True),
        ("4.54e-4", 4.55e-4, False),
    ],
)
def test_a_printed_number_is_met_to_its_last_digit(text: str, ours: float, agrees: bool) -> None:
    assert (judge("x", Printed(text, "Eo", "here"), ours).verdict == "agrees") is agrees


@pytest.mark.parametrize(
    ("ours", "agrees"), [(9e-4, True), (9e-3, True), (2e-4, False), (1.1e-2, False), (-1e-3, False)]
)
def test_an_order_of_magnitude_has_bounds(ours: float, agrees: bool) -> None:
    assert Printed("1e-3", "V", "here", order=True).matches(ours) is agrees


def test_a_disagreement_is_open_only_within_reach() -> None:
    printed = Printed("1.0", "Eo", "here")
    row = judge("x", printed, 3.0, reach=(0.5, 4.0), open_input="why", unexplained="no")
    assert (row.verdict, row.reason) == ("open input", "why")
    assert judge("x", printed, 3.0, reach=(2.0, 4.0), open_input="why", unexplained="no").reason == "no"
    assert judge("x", printed, 3.0, unexplained="no").verdict == "unexplained"


# --- III.A ---


def test_centre_gradient_is_that_of_a_point_mass(third_a: MultiFrequency) -> None:
    c = third_a.centre
    angle = np.deg2rad(c.time + 0.1 / 0.0628 * (1 - np.cos(0.0628 * c.time)))
    amplitude = 3 * G * 486 / 1.2**3 * 1e9
    np.testing.assert_allclose(c.inline, amplitude * np.cos(2 * angle), rtol=0, atol=1e-9)
    np.testing.assert_allclose(c.cross, amplitude / 2 * np.sin(2 * angle), rtol=0, atol=1e-9)


def test_numerical_difference_is_the_next_multipoles(third_a: MultiFrequency) -> None:
    # cos 2x in P_4 and P_6 of the potential of a mass in the disc's plane, over that in P_2.
    ratio = (0.1 / 1.2) ** 2
    factor = (20 / 64) / (3 / 4) * ratio + (105 / 512) / (3 / 4) * ratio**2
    found = third_a.differences["numerical"]
    np.testing.assert_allclose(found.inline, factor * third_a.centre.inline, rtol=0, atol=2e-4)
    np.testing.assert_allclose(found.cross, factor * third_a.centre.cross, rtol=0, atol=2e-4)


def test_derived_models_measure_the_centre(third_a: MultiFrequency) -> None:
    for model in ("analytical", "simplified"):
        assert (
            max(
                np.abs(third_a.differences[model].inline).max(),
                np.abs(third_a.differences[model].cross).max(),
            )
            < 1e-4
        )
    assert _row(third_a.rows, "numerical minus centre, largest of both channels").verdict == "agrees"


# --- III.B ---


def test_section_three_b_before_demodulation_agrees(third_b: Dynamic) -> None:
    assert {r.verdict for r in third_b.rows[:6]} == {"agrees"}
    assert _row(third_b.rows, "k_ggi").ours == pytest.approx(4.54187e-4, rel=1e-5)


def test_the_filter_and_the_mean_over_turns_agree(third_b: Dynamic) -> None:
    for model, c in third_b.demodulated.items():
        inline, cross = over_turns(third_b.errors[model], third_b.run)
        assert np.abs(c.inline - inline).max() < 1e-3
        assert np.abs(c.cross - cross).max() < 1e-3


def test_all_four_model_errors_have_the_printed_signs(third_b: Dynamic) -> None:
    rows = [
        r
        for r in third_b.rows
        if r.quantity.startswith(("analytical model error, ", "simplified model error, "))
    ]
    assert len(rows) == 4
    assert all(r.ours * r.printed.value > 0 for r in rows)


@pytest.mark.parametrize("rate", [16.0, 64.0])
def test_analytical_error_is_second_order_coefficients_times_angles(rate: float) -> None:
    run = regular_run(effects=ANGLES_DROPPED, rate=rate)
    assert np.abs(error("analytical", run)).max() < 1e-8
    assert np.abs(run.G_out).max() > 1e5
    zero = dict.fromkeys(("K2", "K4", "K5", "K6", "K7", "K8"), 0.0)
    assert np.abs(error("analytical", regular_run(table_v().replace(**zero), rate=rate))).max() < 1e-8


def test_sampling_does_not_matter_in_regular_motion() -> None:
    few, many = (
        over_turns(error("simplified", r), r) for r in (regular_run(rate=16.0), regular_run(rate=100.0))
    )
    # to the round-off of the generated model (tests/generated/test_precision.py: below 1e-6 Eo)
    np.testing.assert_allclose(few, many, rtol=0, atol=1e-6)


def test_simplified_minus_analytical_needs_no_numerical_model() -> None:
    base = model_difference(np.zeros((1, 6)))[0]
    for run in (
        regular_run(),
        regular_run(rotations="exact"),
        regular_run(with_angles(np.array([9.0, -8, 7, 30]))),
    ):
        pairs = [np.array(over_turns(error(m, run), run)) for m in ("simplified", "analytical")]
        np.testing.assert_allclose(pairs[0] - pairs[1], base, rtol=0, atol=1e-6)


def test_motion_variants_are_what_a_simulation_of_them_gives() -> None:
    from ragg_runtime.experiments.regular import regular_motion

    phases = np.array([0.3, 1.0, -2.0, 0.7, 2.2, -0.4])
    run = regular_run(motion=regular_motion(dict(zip(paper.TABLE_VI, phases, strict=True))))
    direct = over_turns(output("analytical", run) - output("simplified", run), run)
    np.testing.assert_allclose(model_difference(phases[None])[0], direct, rtol=0, atol=1e-7)
    without = model_difference(np.zeros((1, 6)), np.zeros((1, 3)))[0]
    assert np.abs(without).max() < 0.3


def test_the_missing_angle_can_give_the_printed_error() -> None:
    def measure(instrument):  # type: ignore[no-untyped-def]
        run = regular_run(instrument)
        return np.array(over_turns(error("analytical", run), run))

    printed = np.array([-0.72, 0.56])
    angles = smallest_angles(*response(measure), printed)
    np.testing.assert_allclose(measure(with_angles(angles)), printed, rtol=0, atol=2e-3)
    assert np.abs(angles).max() < 40


def test_attraction_common_to_the_four_is_unseen_by_a_perfect_instrument() -> None:
    runs = [
        simulate(perfect(), still(), 8, 16, gravity=g, auxiliaries={})
        for g in (WITH_MASS, WholeAttraction(WITH_MASS))
    ]
    assert np.abs(runs[0].voltages - runs[1].voltages).max() > 0.01
    np.testing.assert_allclose(runs[0].G_out, runs[1].G_out, rtol=0, atol=1e-12)


# --- III.C ---


@pytest.mark.parametrize("experiment_number", [1, 2, 3])
def test_turbulence_has_the_moments_of_table_vii(experiment_number: int) -> None:
    row = paper.TABLE_VII[experiment_number - 1]
    time = np.arange(20000) / 20
    state = turbulent_motion(np.random.default_rng(3), row, 1000, 20).at(time)
    milli_g = 9.8e-3
    np.testing.assert_allclose(state.a[2].mean(), row.a_mean * milli_g, rtol=0.005)
    np.testing.assert_allclose(state.a[2].std(), row.a_std * milli_g, rtol=0.02)
    for axis in (0, 1):
        ratio = math.sqrt(np.mean(state.a[axis] ** 2) / np.mean(state.a[2] ** 2))
        assert ratio == pytest.approx(0.15, rel=0.01)
    np.testing.assert_allclose(np.rad2deg(state.omega).std(axis=1) * 3600, row.omega_std, rtol=0.02)
    np.testing.assert_allclose(np.rad2deg(state.omega).mean(axis=1) * 3600, row.omega_mean, atol=1.5)


@pytest.mark.parametrize("derivative", ["central", "backward"])
def test_sampled_noise_and_its_derivative_belong_together(derivative: str) -> None:
    s = gaussian(np.random.default_rng(0), 4000, 50.0, 2.0, 3.0, derivative)  # type: ignore[arg-type]
    time = np.arange(4000) / 50
    v, d = s.value(time), s.rate(time)
    step = (v[2:] - v[:-2]) * 25 if derivative == "central" else (v[1:-1] - v[:-2]) * 50
    np.testing.assert_allclose(d[1:-1], step, rtol=0, atol=1e-9)
    with pytest.raises(UserError, match="own instants"):
        s.value(time + 0.003)
    with pytest.raises(UserError, match="own instants"):
        s.value(time, 1e-6)


def test_without_angular_motion_the_two_models_are_one(third_c: Turbulence) -> None:
    for n in ("in", "cs"):
        for letter in ("M", "sigma"):
            np.testing.assert_allclose(
                third_c.statistics[1, f"{letter}_{n}"],
                third_c.statistics[1, f"{letter}s_{n}"],
                rtol=0,
                atol=1e-4,
            )


def test_analytical_error_is_quadratic_in_the_acceleration(third_c: Turbulence) -> None:
    s = third_c.statistics
    np.testing.assert_allclose(s[3, "M_in"] / s[1, "M_in"], 4, rtol=0.05)
    np.testing.assert_allclose(s[3, "sigma_in"] / s[1, "sigma_in"], 2, rtol=0.05)
    # Angular motion does not enter it.
    np.testing.assert_allclose(s[2, "sigma_in"], s[1, "sigma_in"], rtol=0.02)


@pytest.mark.parametrize(
    "entry", ["sigma, inline, simplified", "sigma, cross, simplified", "noise density, simplified"]
)
@pytest.mark.parametrize("number", [2, 3])
def test_simplified_sigmas_of_table_viii(third_c: Turbulence, entry: str, number: int) -> None:
    row = _row(third_c.rows, f"exp. {number}: {entry}")
    assert row.verdict == "agrees"
    assert row.ours == pytest.approx(row.printed.value, rel=0.05)


def test_what_the_printed_equations_cannot_give_is_called_unexplained(third_c: Turbulence) -> None:
    for entry in ("M, inline", "M, cross", "sigma, inline", "sigma, cross"):
        assert _row(third_c.rows, f"exp. 1: {entry}, simplified").verdict == "unexplained"


def test_noise_for_a_sigma_gives_that_sigma() -> None:
    noise = _noise_for(0.06, table_v(), 20.0)
    runs = [turbulent_run(1, 5, duration=2000, effects=ANGLES_DROPPED, noise=n) for n in (noise, None)]
    found = statistics(runs[0])
    assert statistics(runs[1])["sigma_in"] < 1e-6
    assert found["sigma_in"] == pytest.approx(0.06, rel=0.1)
    # White noise of G_out: the inline channel has twice the gain of the cross channel.
    assert found["sigma_in"] / found["sigma_cs"] == pytest.approx(2, rel=0.1)


def test_draws_of_the_missing_angle_are_what_a_simulation_gives() -> None:
    def measure(instrument):  # type: ignore[no-untyped-def]
        run = turbulent_run(3, 2, instrument=instrument, duration=120)
        return channels(error("analytical", run), run).inline

    base, slopes = response(measure)
    angles = np.array([12.0, -25.0, 7.0, 18.0])
    np.testing.assert_allclose(measure(with_angles(angles)), base + angles @ slopes, rtol=0, atol=2e-4)


def test_equal_seeds_equal_numbers_other_seeds_others() -> None:
    first, again, other = (statistics(turbulent_run(2, seed, duration=120)) for seed in (4, 4, 5))
    assert first == again
    assert first["sigmas_in"] != other["sigmas_in"]


@pytest.mark.parametrize(
    "arguments", [{"rate": -1.0}, {"rate": math.nan}, {"duration": 0.0}, {"experiment": 4}]
)
def test_impossible_records_are_refused(arguments: dict[str, float]) -> None:
    with pytest.raises(UserError):
        turbulent_run(**({"experiment": 1, "seed": 0} | arguments))  # type: ignore[arg-type]


def test_no_seed_is_refused() -> None:
    with pytest.raises(UserError, match="seed"):
        turbulence(seeds=())


# --- what a reader gets ---


def test_results_are_frozen_and_go_to_json(
    third_a: MultiFrequency, third_b: Dynamic, third_c: Turbulence
) -> None:
    for result in (third_a, third_b, third_c):
        with pytest.raises(dataclasses.FrozenInstanceError):
            result.title = "other"  # type: ignore[misc]
        back = json.loads(json.dumps(result.as_json(), allow_nan=False))
        assert [r["quantity"] for r in back["rows"]] == [r.quantity for r in result.rows]
        assert all(r["reason"] or r["verdict"] == "agrees" for r in back["rows"])
        text = result.text()
        assert all(r.quantity in text for r in result.rows)


def test_figures_are_written(
    tmp_path: Path, third_a: MultiFrequency, third_b: Dynamic, third_c: Turbulence
) -> None:
    for result, count in ((third_a, 3), (third_b, 1), (third_c, 3)):
        paths = result.figures(tmp_path / "figures")
        assert len(paths) == count
        assert all(p.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n" for p in paths)


def test_command_gives_json_and_figures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    figures = tmp_path / "new"
    experiment.main(["multifrequency", "--json", "-", "--figures", str(figures)], standalone_mode=False)
    assert json.loads(capsys.readouterr().out)["rows"][0]["verdict"] == "agrees"
    assert len(list(figures.iterdir())) == 3
    file = tmp_path / "dynamic.json"
    run = CliRunner().invoke(experiment, ["dynamic", "--json", str(file)])
    assert "k_ggi" in run.stdout
    assert json.loads(file.read_text())["title"].startswith("Dynamic")
    failed = CliRunner().invoke(experiment, ["turbulence", "--duration", "10"])
    assert isinstance(failed.exception, UserError)


def _pieces(text: str) -> tuple[list[str], list[float]]:
    number = r"(?<![\w.])-?\d+\.?\d*(?:e[+-]?\d+)?(?![\w.]*\w)"
    return re.split(number, text), [float(v) for v in re.findall(number, text)]


def test_the_page_is_as_the_program_writes_it(
    third_a: MultiFrequency, third_b: Dynamic, third_c: Turbulence
) -> None:
    # Numbers to a few units of their third digit: the last one may differ between machines.
    words, numbers = _pieces((ROOT / DEFAULT).read_text("utf-8"))
    again, computed = _pieces(page((third_a, third_b, third_c)))
    assert words == again, "run python -m ragg_runtime.experiments docs"
    np.testing.assert_allclose(numbers, computed, rtol=0.02, atol=2e-5)
