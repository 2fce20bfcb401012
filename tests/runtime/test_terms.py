"""Generic terms, constant and varying: noise does not raise them, and they name what is really there."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import signal, stats

from derive.expression import from_expression
from ragg_runtime.estimation import fitted, observation, whitening
from ragg_runtime.estimation.whitening import Piece
from ragg_runtime.identification import comparison, dictionary, formula, omnibus
from ragg_runtime.identification.dictionary import Dictionary, Term
from ragg_runtime.identification.omnibus import Scores
from ragg_runtime.identification.time_varying import BlockScores
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.instrument.units import units
from ragg_runtime.io import Flight
from ragg_runtime.model import derive
from ragg_runtime.model import model as load
from ragg_runtime.model.record import Record
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.reference.simulate import Simulation
from tests.simulated import RATE, diagnosed

Array = NDArray[np.float64]

TIME = np.arange(6000) / 50.0


@pytest.fixture(scope="module")
def smooth() -> Record:
    """A record of smooth channels."""
    wide = {
        "a_x": 0.3 * np.sin(1.1 * TIME) + 0.2 * np.cos(0.4 * TIME),
        "a_y": 0.4 * np.cos(0.9 * TIME + 0.3),
        "a_z": 9.0 + np.sin(0.7 * TIME),
        "temperature": 293.0 + 0.01 * TIME,
    }
    return Record(TIME, wide, 50.0, np.ones(len(TIME), dtype=bool), 0.25)


@pytest.mark.parametrize(("axis", "turn"), [("f_i", 0.25), ("f_o", 0.0)])
def test_turning_forces_and_their_derivatives(axis: str, turn: float, smooth: Record) -> None:
    """Of the first accelerometer; those of the others are these up to sign and exchange."""
    phi = 2 * np.pi * (0.25 * TIME + turn)
    f = smooth.wide["a_x"] * np.cos(phi) + smooth.wide["a_y"] * np.sin(phi)
    first = np.gradient(f, TIME, edge_order=2)
    inner = slice(50, -50)
    for name, expected, most in (
        (axis, f, 1e-12),
        (f"d_{axis}", first, 1e-3),
        (f"d2_{axis}", np.gradient(first, TIME, edge_order=2), 3e-3),
        (f"abs({axis})", np.abs(f), 1e-12),
    ):
        series = dictionary.make_series(name, smooth)
        np.testing.assert_allclose(series[inner], expected[inner], atol=most)
    turned = dataclasses.replace(smooth, wide={**smooth.wide, "spin_angle": smooth.phi + np.pi / 2})
    other, sign = ("f_o", -1.0) if axis == "f_i" else ("f_i", 1.0)
    expected = sign * dictionary.make_series(other, smooth)
    np.testing.assert_allclose(dictionary.make_series(axis, turned), expected, atol=1e-12)


def test_what_a_record_lacks_makes_no_term(smooth: Record) -> None:
    all_terms = {t.product for t in Dictionary(smooth).terms}
    assert {"f_i*f_i*f_i*f_i", "f_i*temperature*temperature", "slow(f_o, 1 s)"} <= all_terms
    bare = dataclasses.replace(smooth, wide={n: x for n, x in smooth.wide.items() if n != "a_x"})
    names = {c for t in Dictionary(bare).terms for c in t.channels}
    assert not any("f_i" in n or "f_o" in n or "a_x" in n for n in names)
    assert "abs(a_z)" in names


@pytest.fixture(scope="module")
def scored() -> tuple[Scores, Array, Array]:
    """An effect-free flight: its scores, its whitened terms (float32) and the basis of what is projected out."""
    s = scenario(71, duration=200.0, rate=RATE)
    f = fitted.fit(load.load_packaged(), s.sheet, [observation.observe(s.simulate({}).flight(), s.sheet)])
    projector = whitening.make_projector(f.r_factors[0], f.n_base, ())
    scores = Scores(f.prepared[0], projector)
    (piece,) = scores.collect(lambda piece, y: piece)
    X = scores.whiten(piece, range(len(scores.dictionary.terms)))
    return scores, X, projector.basis(piece)


def test_noise_raises_no_term(scored: tuple[Scores, Array, Array]) -> None:
    """Over many draws of white noise each term is a standard normal deviate, and the largest alarms as seldom as claimed."""
    scores, X, Q = scored
    rng = np.random.default_rng(8)
    draws = 400
    noise = rng.standard_normal((X.shape[1], draws)).astype(np.float32)
    left = scores.norm2 - np.sum(scores.along**2, axis=1)
    good = left > 1e-6 * scores.norm2
    projected = noise - Q.astype(np.float32) @ (Q.astype(np.float32).T @ noise)
    z = (X[good] @ projected) / np.sqrt(left[good])[:, None]
    products = [t for t, kept in zip(scores.dictionary.terms, good, strict=True) if kept]
    further = np.array([len(t.channels) > 3 or "f_" in t.product or "slow" in t.product for t in products])
    assert np.sum(further) > 150
    for some in (z[further], z[~further]):
        spread = np.std(some, axis=1)  # of one term over the draws
        assert np.all(np.abs(spread - 1.0) < 5.0 / np.sqrt(2 * draws))
        assert abs(np.mean(some**2) - 1.0) < 0.05
    p = np.array([omnibus._log_p(column, int(np.sum(good))) for column in z.T])
    for level in (0.05, 0.2):
        alarms = np.sum(p + np.log(omnibus.SHARE) < np.log(level))
        assert alarms <= stats.binom.ppf(0.999, draws, level)


def _transducer(run: Simulation, s: Scenario, change: Callable[[dict[str, Array]], Array]) -> Flight:
    """A flight in which the first accelerometer also feels ``change``, of forces by the definition of its axes."""
    psi = 2 * np.pi * s.instrument.spin_frequency * run.time
    a_x, a_y, a_z = (run.channels[f"a_{k}"] for k in "xyz")
    forces = {"f_i": a_y * np.cos(psi) - a_x * np.sin(psi), "f_p": -a_z, "t": run.time}
    k = s.instrument.accelerometers
    volts = (k["K1"] * k["k_VI"])[0] * change(forces)
    return dataclasses.replace(run.flight(), outputs={"G_out": run.G_out + volts})


def test_a_product_with_a_force_at_a_harmonic_is_one_formula() -> None:
    """Too many terms of the dictionary for one of them to stand out, and none of them with a sign."""
    s = scenario(72, duration=250.0, rate=RATE)
    run, turn = s.simulate({}), 2 * np.pi * s.instrument.spin_frequency
    centred = {n: x - np.mean(x) for n, x in run.channels.items()}
    sense = np.sign(centred["roll"] * centred["pressure"])
    flight = _transducer(run, s, lambda w: 2e-9 * w["f_i"] * sense * np.cos(3 * turn * w["t"]))
    d = diagnosed(s, flight)
    assert (d.verdict, d.found) == ("unexplained", ())
    assert not any(x.steady for x in d.remainder.searches)
    (first,) = d.terms()
    assert (first["harmonic"], first["term"]) == ("cos 3", "f_i*sign(pressure)*sign(roll)")
    assert d.expression() is not None and "f_i*sign(pressure - " in str(d.expression())


def _crept(f: Array, t: Array, constant: float) -> Array:
    """Creep: y' = (f - y)/T by the trapezoidal rule."""
    c = float(t[1] - t[0]) / (2 * constant)
    return np.asarray(signal.lfilter([c, c], [1 + c, c - 1], f))


def test_what_a_transducer_may_do_beyond_the_catalogue_is_unexplained_and_named() -> None:
    s = scenario(72, duration=250.0, rate=RATE)
    creep = _transducer(s.simulate({}), s, lambda w: 1e-7 * _crept(w["f_p"] - w["f_p"][0], w["t"], 20.0))
    d = diagnosed(s, creep)
    assert (d.verdict, d.found) == ("unexplained", ())
    term = max((t for x in d.remainder.searches for t in x.terms), key=lambda t: abs(t.z)).term
    assert term.harmonic == "const" and term.product.startswith("slow(a_z, 20 s)")


def test_the_line_that_is_offered_takes_what_is_left_away() -> None:
    """As a user would: the line into model.toml, derive, calibrate."""
    s = scenario(72, duration=400.0, rate=RATE)
    flight = _transducer(s.simulate({}), s, lambda w: 1.3e-7 * w["f_i"] ** 4)
    d = diagnosed(s, flight)
    line = d.expression()
    assert line is not None
    assert 'add = "K_x*f_i**4", K_x = { unit = "s^6/m^3" }' in line
    assert d.needs() == []
    unit = line.split('unit = "')[1].split('"')[0]
    mine = EffectSetting(
        "my-effect",
        expression={"stage": "transducer", "add": "K_x*f_i**4", "params": {"K_x": {"unit": unit}}},
    )
    sheet = dataclasses.replace(s.sheet, effects=(mine,))
    after = comparison.compare(derive.load_model(sheet), sheet, [flight])
    assert not d.remainder.log_p > -20
    assert after.remainder.log_p > np.log(0.05)
    assert after.calibrated.rms_Eo == pytest.approx(after.noise_floor, rel=0.01)


@pytest.mark.parametrize(
    ("channels", "text", "needs"),
    [
        (("f_i", "temperature", "temperature"), "K_x*f_i*(temperature - 293.25)**2", []),
        (("f_i", "roll", "roll"), "K_x*f_i*(roll + 0.5)**2", []),
        (("f_o", "abs(f_o)"), "K_x*f_o*abs(f_o)", []),
        (("f_i", "sign(temperature)"), "K_x*f_i*sign(temperature - 293.25)", []),
        (("temperature", "roll"), "K_x*(temperature - 293.25)*(roll + 0.5)", []),
        (("slow(f_i, 0.3 s)",), "K_x*slow_f_i", ["slow_f_i (f_i through a relaxation of 0.3 s)"]),
        (("a_z", "a_z", "sign(d_f_i)"), "K_x*a_z**2*sign(d_f_i)", ["d_f_i (time derivative of f_i)"]),
        (
            ("slow(square(f_i), 20 s)",),
            "K_x*slow_square_f_i",
            ["slow_square_f_i (square of f_i through a relaxation of 20 s)"],
        ),
        (
            ("slow(a_x square(B_y), 5 s)",),
            "K_x*slow_a_x_square_B_y",
            ["slow_a_x_square_B_y (a_x times square of B_y less its mean through a relaxation of 5 s)"],
        ),
        (("d2_f_i",), "K_x*d2_f_i", ["d2_f_i (second time derivative of f_i)"]),
    ],
)
def test_every_term_is_offered_as_an_expression_or_with_the_column_that_it_lacks(
    channels: tuple[str, ...], text: str, needs: list[str]
) -> None:
    term = Term("const", channels)
    unit = units(9.8).divide("m/s^2", map(dictionary.find_channel_unit, channels))
    line = formula.write_effect(term, {"temperature": 293.25, "roll": -0.5}, unit)
    assert f'add = "{text}"' in (line or "")
    assert formula.list_effect_columns(term) == needs
    e = from_expression("my-effect", "transducer", text, {"K_x": {"unit": unit}})
    assert set(e.channels) == {n.split()[0] for n in needs} | {
        c for c in ("temperature", "roll") if c in text
    }


# --- whose coefficient varies ---

SAMPLES, TERMS = 9600, 40
LONG = np.arange(SAMPLES) / 16.0


def _piece(sample: NDArray[np.intp]) -> Piece:
    return cast(Piece, SimpleNamespace(sample=sample))


def _scores(y: Array, X: Array, cuts: tuple[int, ...] = ()) -> BlockScores:
    """Over segments that end at ``cuts``, one after the other."""
    total = BlockScores(len(X), LONG)
    for rows in np.split(np.arange(SAMPLES), list(cuts)):
        total.level(_piece(rows), y[rows])
        half = len(X) // 2
        for at in (slice(0, half), slice(half, len(X) + 7)):  # more terms than are asked about
            columns = X[at, rows] if at.start == 0 else np.concatenate([X[half:, rows], X[:7, rows]])
            total.add(_piece(rows), y[rows], at, columns)
    return total


def _columns(rng: np.random.Generator) -> Array:
    """Slow and fast columns, of power that is not the same throughout."""
    k = np.arange(1, TERMS + 1)[:, None]
    swell = 1.0 + 0.8 * np.sin(2 * np.pi * LONG / 400.0)
    return np.asarray(np.sin(0.3 * k * LONG + rng.uniform(0, 6, (TERMS, 1))) * swell)


def test_noise_raises_none_and_segments_leave_no_trace() -> None:
    rng = np.random.default_rng(3)
    X = _columns(rng) ** 9  # with peaks, on which one sample of heavy tails may fall
    everything = np.ones(TERMS, dtype=bool)
    results = []
    for n in range(120):
        loud = 1.0 + 0.3 * np.sin(2 * np.pi * LONG / 600.0) * (n % 2)  # every other not quite stationary
        y = (rng.standard_normal(SAMPLES) if n % 3 else rng.standard_t(2, SAMPLES)) * loud
        best = _scores(y / np.std(y), X).best(everything)
        assert best is not None
        results.append(best.log_p)
        if n == 0:
            parts = _scores(y / np.std(y), X, (1000, 1003, 5000)).best(everything)
            assert parts is not None
            assert (parts.place, parts.how) == (best.place, best.how)
            assert parts.chi2 == pytest.approx(best.chi2, rel=1e-5)
    for level in (0.05, 0.2):
        assert np.sum(np.array(results) < np.log(level)) <= stats.binom.ppf(0.999, len(results), level)


@pytest.mark.parametrize(
    ("shape", "said"),
    [
        (np.where(np.abs(LONG - 250.0) < 20.0, 1.0, 0.0), "from"),
        (np.where(LONG > 300.0, 1.0, -1.0), "since"),
        (np.cos(2 * np.pi * LONG / 40.0 + 1.0), "with a period of 40 s"),
        (np.random.default_rng(1).standard_normal(24).repeat(SAMPLES // 24), "from block to block"),
    ],
)
def test_each_way_of_varying_is_seen_and_said(shape: Array, said: str) -> None:
    rng = np.random.default_rng(4)
    X = _columns(rng)
    change = shape * X[11]
    change *= 11.0 / np.linalg.norm(change)
    best = _scores(rng.standard_normal(SAMPLES) + change, X).best(np.ones(TERMS, dtype=bool))
    assert best is not None
    assert best.log_p < np.log(1e-3)
    assert best.place == 11
    assert said in best.how
    rms = float(np.sqrt(np.mean(shape**2))) * 11.0 / np.linalg.norm(shape * X[11])
    assert best.coefficient == pytest.approx(rms, rel=0.35)
