"""The benchmark of the diagnosis: strengths, scoring, resumption, the plan."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest

from benchmarks.diagnosis import __main__ as command
from benchmarks.diagnosis import ablation, fly, oracle, plan, records, score
from benchmarks.diagnosis.oracle import Oracle
from benchmarks.diagnosis.plan import Spec, model_text
from ragg_runtime.instrument.model_toml import parse_instrument


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
    found = fly.tested(Spec("ten", "with-temperature", 5, 4401))
    assert found["hidden"] == "imu-acceleration-bias"
    assert found["found"] and -30.0 < found["log10_p"] < -12.0


def test_what_is_outside_keeps_its_strength_beyond_the_catalogue() -> None:
    w, plain, o, _ = prepared("white")
    term = fly.Outside.of("resonance at 3 Hz", o, plain, w.scenario)
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
    ranking = [{"effect": e, "log10_p": -9.0, "twins": twins.get(e, [])} for e in found]
    x = {"id": "1/x", "kind": kind, "record": "white", "verdict": verdict, "found": found, "reason": None}
    return x | {"ranking": ranking, "hidden": [{"effect": e} for e in hidden], "tested": 40} | more


@pytest.mark.parametrize(
    ("x", "outcome"),
    [
        (line("ten", "missing-effect", ["lag"], ["lag"]), "right"),
        (line("ten", "partly-explained", ["lag"], ["time-offset"]), "right"),
        (line("ten", "partly-explained", ["lag", "arm-sag"], ["lag"]), "wrong"),
        (line("ten", "adequate", [], ["lag"]), "silent"),
        (line("ten", "unexplained", [], ["lag"], reason="lines"), "unexplained"),
        (line("pair", "missing-effect", ["lag"], ["lag", "arm-sag"]), "part"),
        (line("pair", "missing-effect", ["lag", "arm-sag"], ["arm-sag", "time-offset"]), "right"),
        (line("quiet", "adequate", [], []), "right"),
        (line("quiet", "unexplained", [], []), "unexplained"),
        (line("quiet", "refused", [], [], reason="units"), "said"),
        (line("quiet", "missing-effect", ["lag"], []), "wrong"),
        (line("quiet", "missing-effect", ["quantisation"], [], record="coarse"), "right"),
        (line("quiet", "adequate", [], [], record="shuffled"), "wrong"),
        (line("outside", "unexplained", [], [], outside=["omega_z", 9.0]), "right"),
        (line("outside", "partly-explained", ["lag"], [], outside=["omega_z", 9.0]), "wrong"),
        (
            line("outside", "missing-effect", ["misalignment-step"], [], outside=["misalignment jump", 9.0]),
            "right",
        ),
    ],
)
def test_scoring(x: dict[str, Any], outcome: str) -> None:
    assert score.outcome(x) == outcome


def test_the_interval_of_a_share_is_that_of_published_tables() -> None:
    assert score.share([True] * 3 + [False] * 57) == "3 of 60 (5 %, 2-12)"
    assert score.share([False] * 60) == "0 of 60 (0 %, 0-4)"


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
    every = [s for n in plan.REFERENCE for s in plan.specs(n)]
    assert len({s.id for s in every}) == len(every)
    assert {s.record for s in every if s.kind == "quiet"} == set(records.FIRST)
    assert not {*plan.REFERENCE, plan.ABLATION} & set(plan.HELD)
    assert sum(s.kind == "quiet" for s in every) >= 300 and sum(s.kind == "outside" for s in every) >= 100
    assert {fly.name_of(s) for s in every if s.kind == "outside"} == set(fly.TERMS)
