"""Generic terms: what they are made of, that noise does not raise them, and that they name what is really there."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats

from derive.expression import from_expression
from ragg_runtime.estimation import fitted, observation, whitening
from ragg_runtime.identification import comparison, dictionary, formula, omnibus
from ragg_runtime.identification.dictionary import Dictionary, Term
from ragg_runtime.identification.omnibus import Scores
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.io import Flight
from ragg_runtime.model import derive
from ragg_runtime.model import model as load
from ragg_runtime.model.record import Record
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.reference.simulate import Simulation
from tests.rate import RATE
from tests.runtime.diagnosed import diagnosed

Array = NDArray[np.float64]

FINE, SPIN = 50.0, 0.25


@pytest.fixture(scope="module")
def smooth() -> tuple[Record, dict[str, Callable[[Array], Array]]]:
    """A record of smooth channels, and the same as functions of time."""
    exact: dict[str, Callable[[Array], Array]] = {
        "a_x": lambda t: 0.3 * np.sin(1.1 * t) + 0.2 * np.cos(0.4 * t),
        "a_y": lambda t: 0.4 * np.cos(0.9 * t + 0.3),
        "a_z": lambda t: 9.0 + np.sin(0.7 * t),
        "temperature": lambda t: 293.0 + 0.01 * t,
    }
    time = np.arange(6000) / FINE
    valid = np.ones(len(time), dtype=bool)
    return Record(time, {n: x(time) for n, x in exact.items()}, FINE, valid, SPIN), exact


def _force(exact: dict[str, Callable[[Array], Array]], axis: str) -> Callable[[Array], Array]:
    """Along the input or output axis of the first accelerometer, of its own axes e_t and e_r."""

    def f(t: Array) -> Array:
        phi = 2 * np.pi * SPIN * t
        across, along = (-np.sin(phi), np.cos(phi)), (np.cos(phi), np.sin(phi))
        u = across if axis == "f_i" else along
        return np.asarray(exact["a_x"](t) * u[0] + exact["a_y"](t) * u[1])

    return f


@pytest.mark.parametrize("axis", ["f_i", "f_o"])
def test_turning_forces_and_their_derivatives(axis, smooth) -> None:
    r, exact = smooth
    f, h, t = _force(exact, axis), 1e-4, r.time
    inner = slice(50, -50)
    np.testing.assert_allclose(dictionary.make_series(axis, r), f(t), atol=1e-12)
    first = (f(t + h) - f(t - h)) / (2 * h)
    second = (f(t + h) - 2 * f(t) + f(t - h)) / h**2
    np.testing.assert_allclose(dictionary.make_series(f"d_{axis}", r)[inner], first[inner], atol=1e-5)
    np.testing.assert_allclose(dictionary.make_series(f"d2_{axis}", r)[inner], second[inner], atol=1e-4)
    np.testing.assert_allclose(dictionary.make_series(f"abs({axis})", r), np.abs(f(t)), atol=1e-12)
    clear = np.abs(f(t)) > 1e-9
    np.testing.assert_array_equal(dictionary.make_series(f"sign({axis})", r)[clear], np.sign(f(t))[clear])


def test_forces_of_the_other_accelerometers_are_these_up_to_sign_and_exchange(smooth) -> None:
    """A2 is half a turn on, A3 a quarter, A4 three quarters: no further terms are needed for them."""
    r, _ = smooth
    f = {n: dictionary.make_series(n, r) for n in ("f_i", "f_o")}
    for turns, force, expected in (
        (0.50, "f_i", -f["f_i"]),
        (0.25, "f_i", -f["f_o"]),
        (0.25, "f_o", f["f_i"]),
        (0.75, "f_i", f["f_o"]),
        (0.75, "f_o", -f["f_i"]),
    ):
        turned = dataclasses.replace(r, wide={**r.wide, "spin_angle": r.phi + 2 * np.pi * turns})
        np.testing.assert_allclose(dictionary.make_series(force, turned), expected, atol=1e-12)


def test_relaxations_are_those_of_the_differential_equation_wherever_they_are_taken_up(smooth) -> None:
    r, _ = smooth
    x = r.wide["a_z"] - r.wide["a_z"][0]
    # y' = (x - y)/T for sin(w t): (sin(wt) - wT cos(wt) + wT exp(-t/T))/(1 + w^2 T^2)
    w, T, t = 0.7, 5.0, r.time
    expected = (np.sin(w * t) - w * T * np.cos(w * t) + w * T * np.exp(-t / T)) / (1 + (w * T) ** 2)
    np.testing.assert_allclose(x, np.sin(w * t), atol=1e-12)
    name = "slow(a_z, 5 s)"
    whole = dictionary.relax(name, r, slice(0, 6000))
    np.testing.assert_allclose(whole, expected, atol=3e-3)  # of a signal held over a sample
    for rows in (slice(0, 1500), slice(400, 1900), slice(4500, 6000), slice(5900, 6000)):
        np.testing.assert_allclose(dictionary.relax(name, r, rows), whole[rows], atol=1e-8)


def test_what_a_record_lacks_makes_no_term(smooth) -> None:
    r, _ = smooth
    all_terms = {t.product for t in Dictionary(r).terms}
    assert {"f_i*f_i*f_i*f_i", "f_i*temperature*temperature", "slow(f_o, 1 s)"} <= all_terms
    bare = dataclasses.replace(r, wide={n: x for n, x in r.wide.items() if n != "a_x"})
    names = {c for t in Dictionary(bare).terms for c in t.channels}
    assert not any("f_i" in n or "f_o" in n or "a_x" in n for n in names)
    assert "abs(a_z)" in names


@pytest.fixture(scope="module")
def scored() -> tuple[Scores, Array, Array]:
    """An effect-free flight: its scores, its whitened terms (float32) and the basis of what is projected out."""
    s = scenario(71, duration=300.0)
    f = fitted.fit(load.load_packaged(), s.sheet, [observation.observe(s.simulate({}).flight(), s.sheet)])
    projector = whitening.make_projector(f.r_factors[0], f.n_base, ())
    scores = Scores(f.prepared[0], projector)
    (piece,) = scores.collect(lambda piece, y: piece)
    X = scores.whitened(piece, range(len(scores.dictionary.terms)))
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
    further = np.array(
        [
            len(t.channels) > 3 or "f_" in t.product or "slow" in t.product
            for t in np.array(scores.dictionary.terms, dtype=object)[good]
        ]
    )
    assert np.sum(further) > 150
    for some in (z[further], z[~further]):
        spread = np.std(some, axis=1)  # of one term over the draws
        assert np.all(np.abs(spread - 1.0) < 5.0 / np.sqrt(2 * draws))
        assert abs(np.mean(some**2) - 1.0) < 0.05
    p = np.array([omnibus._log_p(column, int(np.sum(good))) for column in z.T])
    for level in (0.05, 0.2):
        alarms = np.sum(p + np.log(omnibus.SHARES[0]) < np.log(level))
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
    """Creep: y' = (f - y)/T by the trapezoidal rule, a sample at a time."""
    h = float(t[1] - t[0])
    y = np.zeros(len(f))
    for n in range(1, len(f)):
        y[n] = ((1 - h / (2 * constant)) * y[n - 1] + h / (2 * constant) * (f[n] + f[n - 1])) / (
            1 + h / (2 * constant)
        )
    return y


def test_what_a_transducer_may_do_beyond_the_catalogue_is_unexplained_and_named() -> None:
    s = scenario(72, duration=250.0, rate=RATE)
    creep = _transducer(s.simulate({}), s, lambda w: 1e-7 * _crept(w["f_p"] - w["f_p"][0], w["t"], 20.0))
    d = diagnosed(s, creep)
    assert (d.verdict, d.found) == ("unexplained", ())
    term = max((t for x in d.remainder.searches for t in x.terms), key=lambda t: abs(t.z)).term
    assert term.harmonic == "const"
    assert term.product.startswith("slow(a_z, 20 s)")


def test_a_bent_converter_of_the_output_is_its_curve() -> None:
    s = scenario(72, duration=250.0, rate=RATE)
    run = s.simulate({})
    flight, G = run.flight(), run.G_out
    noise = float(np.std(run.G_out - run.G_out_noise_free))
    term = 40.0 * noise / np.sqrt(len(G)) * G**3 / np.std(G**3)  # far smaller than what it is made of
    d = diagnosed(s, dataclasses.replace(flight, outputs={"G_out": G + term}))
    assert d.found == ("output-curve",), (d.verdict, d.terms())
    assert d.verdict == "missing-effect"


def test_the_line_that_is_offered_takes_what_is_left_away() -> None:
    """As a user would: the line into model.toml, derive, calibrate. The search needs half of the samples."""
    s, fine = (scenario(72, duration=600.0, rate=rate) for rate in (RATE, 2 * RATE))
    coarse, flight = (_transducer(x.simulate({}), x, lambda w: 1e-7 * w["f_i"] ** 4) for x in (s, fine))
    d = diagnosed(s, coarse)
    line = d.expression()
    assert line is not None
    assert 'add = "K_x*f_i**4"' in line
    assert d.needs() == []
    unit = line.split('unit = "')[1].split('"')[0]
    mine = EffectSetting(
        "my-effect",
        expression={"stage": "transducer", "add": "K_x*f_i**4", "params": {"K_x": {"unit": unit}}},
    )
    sheet = dataclasses.replace(fine.sheet, effects=(mine,))
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
            ("slow(a_x B_y, 5 s)",),
            "K_x*slow_a_x_B_y",
            ["slow_a_x_B_y (a_x times B_y less its mean through a relaxation of 5 s)"],
        ),
        (("d2_f_i",), "K_x*d2_f_i", ["d2_f_i (second time derivative of f_i)"]),
    ],
)
def test_every_term_is_offered_as_an_expression_or_with_the_column_that_it_lacks(
    channels: tuple[str, ...], text: str, needs: list[str]
) -> None:
    term = Term("const", channels)
    line = formula.write_effect(term, {"temperature": 293.25, "roll": -0.5}, "m/s^2")
    assert line is not None
    assert f'add = "{text}"' in line
    assert formula.list_effect_columns(term) == needs
    e = from_expression("my-effect", "transducer", text, {"K_x": {"unit": "m/s^2"}})
    assert set(e.channels) == {n.split()[0] for n in needs} | {
        c for c in ("temperature", "roll") if c in text
    }
