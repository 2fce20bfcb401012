"""The motion to fly next: its promises, and those promises flown in the reference."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from commands import ragg

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.fitted import Fitted, fit, prepare_evidence
from ragg_runtime.estimation.observation import Observation, observe_flights
from ragg_runtime.estimation.regressors import compute_residual, group_by_effect
from ragg_runtime.identification import next_motion
from ragg_runtime.identification.next_motion import Alternatives, Sinusoid
from ragg_runtime.identification.selection import ProjectedProblem, make_problem
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.model.model import load_packaged
from ragg_runtime.next_flight import ChannelVariance, next_flight, write_run_sheet
from ragg_runtime.reference.effects import EffectValues
from ragg_runtime.reference.motion import MotionSignals, Sinusoids
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.simulate import simulate_flight
from tests.simulated import RATE

LAG = {"lag": {"tau": [2e-9, 0, 0, 0]}}
PAIRS = [("lag", "time-offset"), ("lag", "arm-stretch")]


def fitted(s: Scenario, *flights: Flight) -> Fitted:
    return fit(load_packaged(), s.sheet, observe_flights(flights, s.sheet))


def flown(s: Scenario, sinusoids: Sequence[Sinusoid], effects: EffectValues) -> Callable[[str], float]:
    """Fly sinusoids about the mean of a flight; of a rival, how many sigma it is ruled out by both flights.

    The mean significance: what the reference's own effect (the output with it less that without, noise left out), whitened with
    the noise that the fit of both flights estimates, has beyond the model's parameters and the rival's.
    """
    t = np.arange(int(s.duration * s.rate)) / s.rate
    parts = []
    for name, signal in zip(next_motion.AXES, (*s.motion.a, *s.motion.omega), strict=True):
        of_axis = [x for x in sinusoids if x[0] == name]
        f, amplitude, phase = ([x[k] for x in of_axis] for k in (1, 2, 3))
        parts.append(Sinusoids(float(np.mean(signal(t))), amplitude, f, phase))
    motion = MotionSignals(tuple(parts[:3]), tuple(parts[3:]))
    runs = [
        (w.simulate(effects), w.simulate()) for w in (s, replace(s, motion=motion, seed=s.seed + 100_000))
    ]
    both = fitted(s, *(a.flight() for a, _ in runs))
    clean: list[Observation] = []
    for k, pair in enumerate(runs):
        quiet = [replace(q.flight(), outputs=dict(q.outputs_noise_free)) for q in pair]
        a, b = observe_flights(quiet, s.sheet)
        rest = compute_residual(both.model, b, both.calibration.p)
        clean.append(replace(a, series=tuple(np.atleast_2d(a.data - rest)), flight=k))
    signal = prepare_evidence(both.model, both.instrument, clean, both.calibration)
    n, columns = both.n_base, group_by_effect(both.candidates)

    def shown(rival: str) -> float:
        rows = signal.data[:, [*range(n), *(n + k for k, _ in columns[rival]), -1]]
        return float(abs(np.linalg.qr(np.vstack([rows, np.eye(n, rows.shape[1])]), mode="r")[-1, -1]))

    return shown


@pytest.fixture(scope="module")
def weak() -> tuple[Scenario, Fitted, ProjectedProblem]:
    """A weak lag, which its alternatives imitate."""
    s = scenario(52, duration=300.0, rate=RATE)
    f = fitted(s, s.simulate(LAG).flight())
    return s, f, make_problem(f)


def test_promises_are_kept_when_the_motion_is_flown(weak: tuple[Scenario, Fitted, ProjectedProblem]) -> None:
    """By the multisine, which separates all pairs in both directions and better than the best sinusoid."""
    s, f, field = weak
    asked = Alternatives.of(f, field, PAIRS, both=True)
    tones = next_motion.list_tones(0.25, next_motion.LIMITS, (0.0, 1.0))
    motion = next_motion.find_motion(asked.known, asked.worth, tones, 300.0)
    promised = {(p.effect, p.rival): p for p in asked.promise(motion, 300.0)}
    assert list(promised) == [*PAIRS, *((r, e) for e, r in PAIRS)]
    shown = flown(s, motion, LAG)
    p = promised["lag", "time-offset"]
    assert shown(p.rival) == pytest.approx(p.then, rel=0.3)
    assert p.then > max(6.0, p.now)
    assert 0.0 < p.spread < p.then
    assert max(shown("arm-stretch"), promised["lag", "arm-stretch"].then) < 3.0, "they act alike"
    best = {p.rival: p for p in next_motion.propose_motions(f, field, PAIRS)}["time-offset"]
    alone = flown(s, [(best.axis, best.frequency_Hz, best.amplitude, 0.0)], LAG)
    then = best.separation_then * np.sqrt(s.duration / next_motion.DURATION)
    assert alone("time-offset") == pytest.approx(then, rel=0.3)


def test_what_the_flight_does_not_determine_is_not_promised(
    weak: tuple[Scenario, Fitted, ProjectedProblem],
) -> None:
    """Nothing is known of an effect that is not there: a motion to which it could answer promises nothing but noise."""
    _, f, field = weak
    (p,) = Alternatives.of(f, field, [("arm-sag", "lag")]).promise([("a_z", 0.5, 0.49, 0.0)], 600.0)
    assert p.then < 6.0
    s = scenario(53, duration=300.0, rate=RATE)
    g = fitted(s, s.simulate({"cubic-input": {"K_iii": [4e-8, 0, 0, 0]}}).flight())
    # K_iii of one accelerometer and K_ooo of its neighbour weigh the same force: no motion separates them
    for q in next_motion.propose_motions(g, make_problem(g), [("cubic-input", "cubic-cross")]):
        assert not q.as_json()["separates"]


def test_the_motion_keeps_to_its_limits_and_can_be_flown(tmp_path: Path) -> None:
    """Where nothing is left to separate, it excites everything."""
    m = api.new(tmp_path / "m")
    x = simulate_flight(m.instrument, [], seed=8, duration=120.0, rate=RATE)
    limits = api.parse_limits(m, ["a=30mg", "a_z=3mg", "jerk=1m/s^3", "alpha=1deg/s^2"])
    n = next_flight(m, [x], limits, duration=60.0, band=(0.1, 1.6))
    assert n.promise == {"separations": []}
    assert {axis for axis, *_ in n.sinusoids} == set(next_motion.AXES)
    write_flight(n.motion(), tmp_path / "motion.csv")
    motion = simulate_flight(m.instrument, [], motion=tmp_path / "motion.csv")
    assert len(motion) == len(n.motion())
    for axis in "xyz":
        a = n.motion().channels[f"a_{axis}"] - n.mean[f"a_{axis}"]
        most = 9.81 * (0.003 if axis == "z" else 0.03)
        assert 0.1 * most < np.max(np.abs(a)) < most
        assert np.max(np.abs(np.gradient(a, n.motion().time))) < 1.0
        assert np.max(np.abs(motion.channels[f"omega_{axis}"] - n.mean[f"omega_{axis}"])) < 2.41e-3
    for band in ((0.3, 0.35), (0.0, 5.0)):
        with pytest.raises(UserError, match="no motion is possible"):
            next_flight(m, [x], next_motion.LIMITS, band=band)
    assert limits["alpha"] == pytest.approx(np.pi / 180)
    assert limits["omega"] == next_motion.LIMITS["omega"]
    for wrong in ("b=1mg", "a", "a=-1mg", "a_w=1mg", "omega=1mg", "jerk=1m/s^2"):
        with pytest.raises(UserError):
            api.parse_limits(m, [wrong])


def test_a_calibration_reaches_what_was_planned(tmp_path: Path) -> None:
    """Through the commands, and in half the time that all sinusoids together take."""
    m = api.new(tmp_path / "m")
    write_flight(simulate_flight(m.instrument, [], seed=3, duration=150.0, rate=RATE), tmp_path / "x.parquet")
    sheet, plan_file, found_file = (tmp_path / n for n in ("sheet.md", "plan.json", "c.json"))
    flown, motion = [tmp_path / "x.parquet", tmp_path / "y.parquet"], tmp_path / "motion.csv"
    words = ["--for", "calibration", "--criterion", "D", "--duration", 300]
    options = ["--run-sheet", sheet, "--json", plan_file]
    ragg("next-motion", tmp_path / "m", flown[0], "-o", motion, *words, *options)
    plan = json.loads(plan_file.read_text())
    assert plan["criterion"] == "D"
    assert plan["channels"]["planned"]["inline_Eo"] < 0.5 * plan["channels"]["now"]["inline_Eo"]
    assert f"| {plan['sinusoids'][0]['axis']} |" in sheet.read_text()
    write_flight(simulate_flight(m.instrument, [], seed=3, motion=motion), flown[1])
    ragg("calibrate", tmp_path / "m", *flown, "--plan", plan_file, "--json", found_file)
    found = json.loads(found_file.read_text())
    ratios = [q["std_reached"] / q["std_planned"] for q in found["certificate"]]
    assert np.allclose(ratios, 1.0, atol=0.05)
    combinations, channels = found["certified"]["combinations"], found["certified"]["channels"]
    assert all(q["reached"] for q in (*found["certificate"], *combinations))
    assert min(q["std_planned"] / q["std_before"] for q in combinations) < 0.3
    assert all(x["reached"] == pytest.approx(x["planned"], rel=0.1) for x in channels.values())
    assert all(f"| {q['name']} |" in sheet.read_text() for q in combinations)
    f = fit(m.model, m.instrument, observe_flights(api.read_flights(m, flown[:1]), m.instrument))
    spread, tones = ChannelVariance.of(f), next_motion.list_tones(0.25, next_motion.LIMITS, (0.0, 3.2))
    criteria = spread.weigh_variance, spread.weigh_volume
    A, D = (spread.known.fly(next_motion.find_motion(spread.known, c, tones, 600.0), 600.0) for c in criteria)
    assert [c(A) > c(D) for c in criteria] == [True, False]
    even = next_motion.share_evenly(tones)
    assert spread.rms(A) < spread.rms(spread.known.fly(even, 1200.0))


def test_a_body_that_is_moved_is_weighed_as_planned(tmp_path: Path) -> None:
    """Its mass is a parameter here: as sure as planned, and what it truly is."""
    m = api.new(tmp_path / "m")
    with pytest.raises(UserError, match="no body that could be moved"):
        limits = api.parse_limits(m, ["mass_x=0.3m"])
        next_flight(m, [simulate_flight(m.instrument, [], duration=60.0)], limits, purpose="calibration")
    place = (("x", 1.0), ("y", 0.0), ("z", 0.0))
    body = ", ".join(f'{n} = {{ value = {v}, unit = "m", fixed = true }}' for n, v in place)
    text = (tmp_path / "m" / "model.toml").read_text()
    (tmp_path / "sheet.toml").write_text(
        text.replace("effects = []", f'effects = [{{ id = "near-sphere", {body} }}]')
    )
    m = api.new(tmp_path / "with-body", tmp_path / "sheet.toml")
    x = simulate_flight(m.instrument, [], seed=3, duration=150.0, rate=4.0)
    x = replace(x, channels={**x.channels, "mass_x": np.full(len(x), 1e6)})
    limits = api.parse_limits(m, ["mass_x=0.3m", "speed=0.1m/s"])
    n = next_flight(m, [x], limits, duration=300.0, purpose="calibration")
    assert "near-sphere, x = 1.0 m" in write_run_sheet(n) and "| mass_x |" in write_run_sheet(n)
    n = replace(n, sinusoids=(("mass_x", 0.05, 0.3, 0.0), ("a_z", 0.1, 0.3, 0.0)))
    write_flight(n.motion(), tmp_path / "motion.csv")
    run = ["near-sphere:M=500,x=1,y=0,z=0"]
    y = simulate_flight(m.instrument, run, seed=3, motion=tmp_path / "motion.csv")
    assert y.channels["mass_x"] == pytest.approx(0.3 * np.sin(0.1 * np.pi * y.time), abs=1e-3)
    observed = (observe_flights(some, m.instrument) for some in ([x], [x, y]))
    first, both = (fit(m.model, m.instrument, o, candidates=False) for o in observed)
    (k,) = (k for k, q in enumerate(first.calibration.columns) if q.name == "near-sphere.M")
    planned = ChannelVariance.of(first).promise(n.sinusoids, 300.0)["parameters"][k]
    q, c = both.calibration.columns[k], both.calibration
    std = float(np.sqrt(c.covariance[k, k])) * q.scale
    assert planned["then"] * q.unit_factor == pytest.approx(std, rel=0.2)
    assert std < 50.0
    assert c.p[c.index[k]] == pytest.approx(500.0, abs=4 * std)
