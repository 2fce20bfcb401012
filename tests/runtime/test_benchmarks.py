"""The benchmarks: strengths, scoring, resumption, the plan; what is timed; and each effect that a diagnosis looks for."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks import evaluation
from benchmarks.diagnosis import __main__ as command
from benchmarks.diagnosis import ablation, fly, oracle, plan, records, score
from benchmarks.diagnosis.oracle import NEVER, Oracle
from benchmarks.diagnosis.plan import Spec, model_text
from benchmarks.evaluation import motion_and_instrument, program, write_function
from generated import folded
from ragg_runtime.estimation.observation import observe
from ragg_runtime.estimation.regressors import group_by_effect, linearise, make_point
from ragg_runtime.identification.selection import ProjectedProblem, choose, find_alternatives
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.model.model import load_packaged, make_vector

Array = NDArray[np.float64]


def prepared(record: str) -> tuple[plan.World, Any, Oracle, records.Loudness]:
    w = plan.world(Spec("ten", record, 0, 7))
    plain = fly.simulated(w, {})
    x = fly.table(plain, plain.voltages_noise_free)
    noise_rms = records.KINDS[record].noise(x, np.random.default_rng(1))
    return w, plain, Oracle(w, plain.flight(), noise_rms), noise_rms


def test_every_rule_of_the_ablation_is_still_in_the_code() -> None:
    for name, neutral in ((n, x) for r in ablation.RULES for n, x in r.neutral.items()):
        with patch(f"ragg_runtime.{name}", neutral):
            pass


def test_the_oracle_makes_the_noise_white() -> None:
    w, _, o, noise_rms = prepared("along-axes")
    i = w.scenario.instrument.accelerometers
    rng, size = np.random.default_rng(2), len(o.flight)
    n = (i["k_VI"] * i["K1"])[:, None] * records.sampled(noise_rms, w.density, rng, size, o.flight.rate)
    y = o.whitened((n[0] + n[1] - n[2] - n[3])[None, None])[0][200:]
    assert np.std(y) == pytest.approx(1.0, abs=0.04)
    power = np.abs(np.fft.rfft(y)) ** 2 / len(y)
    for part in np.array_split(power[1:], 8):
        assert np.mean(part) == pytest.approx(1.0, abs=0.25)


def test_the_simulator_confirms_the_strength() -> None:
    effect = "gain-step"
    w, plain, o, _ = prepared("red")
    hidden = o.drawn(effect, 10.0, np.random.default_rng(1))
    assert hidden is not None
    sim = fly.simulated(w, {effect: hidden.values})
    at = oracle.make_point(o.model, w.known, oracle.make_vector(o.model, w.known))
    left = [oracle.linearise(at, oracle.observe(s.flight(), w.known))[-1] for s in (sim, plain)]
    assert np.linalg.norm(o.projected(o.whitened((left[0] - left[1])[None]))) == pytest.approx(10.0, rel=0.03)


def test_the_oracle_finds_what_is_in_the_recorded_motion() -> None:
    result = fly.tested(Spec("ten", "with-temperature", 5, 4401))
    assert result["hidden"] == "imu-acceleration-bias"
    assert result["found"] and -30.0 < result["log10_p"] < -12.0


def test_what_is_outside_keeps_its_strength_beyond_the_catalogue() -> None:
    w, plain, o, _ = prepared("white")
    term = fly.make_outside("resonance at 3 Hz", o, plain, w.scenario)
    assert o.beyond_all(term.change) == pytest.approx(10.0, rel=1e-6)
    assert term.with_mimics >= 10.0


@pytest.mark.parametrize("spec", [Spec("quiet", "elsewhere", 3, 4403), Spec("off-sheet", "red", 2, 4401)])
def test_the_sheet_in_the_file_is_that_of_the_flight(spec: Spec) -> None:
    sheet = plan.world(spec).scenario.sheet
    read = parse_instrument(model_text(sheet))
    assert (read.radius, read.spin_frequency, read.g0) == (sheet.radius, sheet.spin_frequency, sheet.g0)
    for own, other in ((read.accelerometers, sheet.accelerometers), (read.sigmas, sheet.sigmas)):
        assert {n: x.tolist() for n, x in own.items()} == {n: x.tolist() for n, x in other.items()}


def line(kind: str, verdict: str, found: list[str], hidden: list[str], **more: Any) -> dict[str, Any]:
    twins = {"lag": ["time-offset"]}
    ranking = [{"effect": e, "log10_p": -9.0, "indistinguishable_from": twins.get(e, [])} for e in found]
    x = {"id": "1/x", "kind": kind, "record": "white", "verdict": verdict, "found": found, "remark": None}
    return x | {"ranking": ranking, "hidden": [{"effect": e} for e in hidden], "tests": 40} | more


@pytest.mark.parametrize(
    ("x", "outcome"),
    [
        (line("ten", "missing-effect", ["lag"], ["lag"]), "right"),
        (line("ten", "partly-explained", ["lag", "arm-sag"], ["lag"]), "wrong"),
        (line("ten", "adequate", [], ["lag"]), "silent"),
        (line("ten", "unexplained", [], ["lag"], remark="lines"), "unexplained"),
        (line("pair", "missing-effect", ["lag"], ["lag", "arm-sag"]), "part"),
        (line("pair", "missing-effect", ["lag", "arm-sag"], ["arm-sag", "time-offset"]), "right"),
        (line("quiet", "adequate", [], []), "right"),
        (line("quiet", "refused", [], [], remark="units"), "said"),
        (line("quiet", "missing-effect", ["lag"], []), "wrong"),
        (line("quiet", "adequate", [], [], record="shuffled"), "wrong"),
        (line("outside", "unexplained", [], [], outside=["omega_z", 9.0]), "right"),
        (line("outside", "partly-explained", ["lag"], [], outside=["omega_z", 9.0]), "wrong"),
    ],
)
def test_scoring(x: dict[str, Any], outcome: str) -> None:
    assert score.outcome(x) == outcome


def test_a_run_resumes_where_it_was_cut_off(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []

    def fake(spec: Spec) -> dict[str, Any]:
        asked.append(spec.id)
        return {"id": spec.id, "kind": spec.kind, "record": spec.record, "crash": "no"}

    monkeypatch.setattr(command, "fly", fake)
    arguments = ["--cache", str(tmp_path / "c.jsonl"), "--seed", "5", "--only", "pair"]
    assert command.main([*arguments, "--save", str(tmp_path / "r.csv")]) == 0
    assert len(asked) == plan.COUNTS["pair"]
    text = (tmp_path / "c.jsonl").read_text()
    (tmp_path / "c.jsonl").write_text(text[:-40])  # killed while the last line was written
    last = json.loads(text.splitlines()[-1])["key"]
    asked.clear()
    assert command.main([*arguments, "--against", str(tmp_path / "r.csv")]) == 0
    assert asked == [last]


def test_the_plan_is_large_enough_and_seeds_have_nothing_in_common() -> None:
    specs = [s for n in plan.REFERENCE for s in plan.specs(n)]
    assert len({s.id for s in specs}) == len(specs)
    assert {s.record for s in specs if s.kind == "quiet"} == set(records.FIRST)
    assert not {*plan.REFERENCE, plan.ABLATION} & set(plan.HELD)
    assert sum(s.kind == "quiet" for s in specs) >= 300 and sum(s.kind == "outside" for s in specs) >= 100
    assert {fly.name_of(s) for s in specs if s.kind == "outside"} == set(fly.TERMS)


def test_the_rival_is_given_the_same_model() -> None:
    (t, *x), p = motion_and_instrument(5000)
    true, phi = folded.output(t, np.array(x), p), 2 * np.pi * p[1] * t
    values = write_function(program(p), np)(np.cos(phi), np.sin(phi), *x)
    np.testing.assert_allclose(values, true, rtol=0, atol=1e-9 * np.max(np.abs(true)))


def test_what_is_timed_is_what_fifty_digits_say() -> None:
    _, p = motion_and_instrument(40)
    ours = {evaluation.OURS: evaluation.contenders(p)[evaluation.OURS]}
    assert evaluation.errors(p, ours)[evaluation.OURS] < 2e-7


SIGMAS, DIRECTIONS = 30.0, 10

ABSORBED = ("spin-axis-wobble", "spin-phase-offset")
"""What the mounting angles of four accelerometers take for themselves within what a sheet leaves open."""

SEARCHED = [
    e.id
    for e in load_packaged().candidates
    if e.kind == "deterministic" and e.searched and e.id not in (*NEVER, *ABSORBED)
]


@dataclass(frozen=True)
class WhitenedFlight:
    """A short flight without effects, whitened; the triangle [base | candidates], its rotation, and a noise."""

    world: plan.World
    oracle: Oracle
    Q: Array
    R: Array
    noise: Array

    def field(self, y: Array) -> ProjectedProblem:
        """That of a residual (rows,), whitened."""
        o, size = self.oracle, len(self.R)
        padded = np.concatenate([np.zeros(o.n), y])
        T = np.zeros((size + 1, size + 1))
        T[:size, :size], T[:size, -1] = self.R, self.Q.T @ padded
        T[-1, -1] = np.sqrt(max(padded @ padded - T[:size, -1] @ T[:size, -1], 0.0))
        return ProjectedProblem(
            T=T,
            n_base=o.n,
            candidates={
                e: tuple(c) for e, c in group_by_effect(o.columns).items() if e in (*SEARCHED, *ABSORBED)
            },
            contains={e.id: e.contains for e in o.model.candidates},
        )


@pytest.fixture(scope="module")
def flight() -> WhitenedFlight:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(plan, "DURATION", 200.0)
        patch.setattr(plan, "RATE", 8.0)
        spec = plan.Spec("each", "white", 0, 4430)
        world = plan.world(spec)
    plain = fly.simulated(world, {})
    loudness = records.KINDS["white"].noise(fly.table(plain, plain.voltages_noise_free), spec.rng(2))
    oracle = Oracle(world, plain.flight(), loudness)
    white = oracle.whitened(oracle.raw)
    prior = np.pad(np.eye(oracle.n), ((0, 0), (0, len(white) - oracle.n)))
    Q, R = np.linalg.qr(np.concatenate([prior, white.T]))
    return WhitenedFlight(world, oracle, Q, R, np.random.default_rng(0).standard_normal(oracle.rows))


@pytest.mark.parametrize("effect", SEARCHED)
def test_it_is_named_first_or_one_that_is_stated_to_be_like_it(flight: WhitenedFlight, effect: str) -> None:
    o, rng = flight.oracle, np.random.default_rng(1)
    hidden = next(h for h in (o.drawn(effect, SIGMAS, rng) for _ in range(DIRECTIONS)) if h is not None)
    sim = fly.simulated(flight.world, {effect: hidden.values})
    point = make_point(o.model, flight.world.known, make_vector(o.model, flight.world.known))
    residual = linearise(point, observe(sim.flight(), flight.world.known))[-1]
    field = flight.field(o.whitened(residual[None])[0] + flight.noise)
    chosen = choose(field)
    first = next(iter(chosen))
    assert effect in (first, *find_alternatives(field, chosen)[first])
