"""The machinery of the diagnosis benchmark: strengths, resumption, selection, scores, the page."""

from __future__ import annotations

import itertools
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.diagnosis import __main__ as command
from benchmarks.diagnosis import fly, inject, outside, peers, plan, score, table
from benchmarks.diagnosis.inject import Bench
from ragg_runtime.fit import fitted as fitted_
from ragg_runtime.fit import observation
from ragg_runtime.model import model
from ragg_runtime.reference.scenario import Scenario, scenario


@pytest.fixture(scope="module")
def flown() -> tuple[Scenario, Bench]:
    s = scenario(7, duration=240.0, trim="table-v", red_corner=0.1)
    sim = s.simulate()
    fitted = fitted_.fit(model.packaged(), s.sheet, [observation.observe(sim.flight(), s.sheet)])
    return s, Bench(fitted, sim)


@pytest.mark.parametrize("effect", ["thermal-scale", "gain-step", "odd-quadratic", "lag", "spin-axis-tilt"])
def test_the_simulator_confirms_the_strength(effect: str, flown: tuple[Scenario, Bench]) -> None:
    s, bench = flown
    hidden = inject.drawn(bench, effect, 10.0, np.random.default_rng(1))
    assert hidden is not None
    with_it, without = s.simulate({effect: hidden.values}), bench.simulation
    change = bench.whitened(with_it.G_out_noise_free - without.G_out_noise_free)
    assert np.linalg.norm(change) == pytest.approx(10.0, rel=0.02)
    assert change @ hidden.signature == pytest.approx(100.0, rel=0.02)  # and the direction: sign included


def test_an_effect_beside_another_keeps_its_strength(flown: tuple[Scenario, Bench]) -> None:
    _, bench = flown
    other = bench.block("thermal-scale")
    alone = inject.drawn(bench, "gain-drift", 10.0, np.random.default_rng(2))
    beside = inject.drawn(bench, "gain-drift", 10.0, np.random.default_rng(2), other)
    assert alone is not None
    assert beside is not None
    assert beside.plausible > 2 * alone.plausible  # temperature grows nearly with time
    assert "thermal-scale" in inject.twins(bench, alone)
    assert "thermal-scale" not in inject.twins(bench, beside)


def test_an_absorbed_effect_is_untestable(flown: tuple[Scenario, Bench]) -> None:
    _, bench = flown
    assert inject.drawn(bench, "second-order-misalignment", 10.0, np.random.default_rng(3)) is None


@pytest.mark.parametrize("name", ["omega_z", "sin 5 phi", outside.SPIN_RATE, *outside.FURTHER])
def test_what_is_outside_keeps_its_strength_beyond_the_catalogue(
    name: str, flown: tuple[Scenario, Bench]
) -> None:
    s, bench = flown
    r = bench.piece.observation.record
    term = outside.drawn(bench, s, name, 10.0, np.arctan2(r.sin_phi, r.cos_phi))
    row = bench.whitened(term.change)
    Q = bench.basis(range(len(bench.columns)))
    assert np.linalg.norm(row - Q @ (Q.T @ row)) == pytest.approx(10.0, rel=1e-6)
    assert term.strength_with_mimics >= 10.0


def _noisy(planted: dict[int, float], n: int = 7, rows: int = 500) -> peers.Columns:
    rng = np.random.default_rng(5)
    X = rng.standard_normal((rows, n))
    X[:, 1] += X[:, 0]  # collinear in part
    X /= np.linalg.norm(X, axis=0)
    y = rng.standard_normal(rows) + sum((size * X[:, k] for k, size in planted.items()), np.zeros(rows))
    return peers.Columns(X, y, tuple(f"e{k}" for k in range(n)))


def test_stepwise_finds_the_least_bic_that_one_more_column_cannot_lower() -> None:
    c = _noisy({2: 8.0, 5: -6.0})
    rows = len(c.y)

    def value(chosen: tuple[int, ...]) -> float:
        X = c.X[:, list(chosen)]
        e = c.y - X @ np.linalg.lstsq(X, c.y, rcond=None)[0] if chosen else c.y
        return peers.bic(float(e @ e), rows, len(chosen))

    chosen = peers.stepwise(c)
    assert chosen[:2] == [2, 5]
    every = [s for k in range(4) for s in itertools.combinations(range(7), k)]
    assert set(chosen) == set(min(every, key=value))
    assert peers.stepwise(_noisy({})) == []


@pytest.mark.parametrize("name", ["lasso (BIC)", "PySINDy (SSR)", "FROLS"])
def test_the_other_methods_find_planted_columns(name: str) -> None:
    pytest.importorskip({"l": "sklearn", "P": "pysindy", "F": "sysidentpy"}[name[0]])
    c = _noisy({2: 12.0, 5: -9.0})
    found = {name: claims["effects"] for name, claims in peers.claims(c).items()}[name]
    assert isinstance(found, list)
    assert found[:2] == ["e2", "e5"]
    assert peers.PEERS[name](_noisy({})) == []


def _line(identifier: str, **changes: Any) -> dict[str, Any]:
    spec = plan.spec(identifier.split("/")[0], int(identifier.split("/")[1]))
    nothing = {name: {"effects": [], "columns": 0, "seconds": 0.1} for name in peers.PEERS}
    return {
        "id": identifier,
        "kind": spec.kind,
        "plan": spec.digest,
        "source": "s",
        "hidden": [],
        "untestable": [],
        "outside": {"name": "sin 5 phi", "strength_with_mimics": 12.0} if spec.kind == "outside" else None,
        "verdict": "adequate",
        "found": [],
        "ranking": [{"effect": "lag", "log_p": -1.0, "twins": []}],
        "tested": 20,
        "remainder_log_p": -0.5,
        "terms": [],
        "seconds": 1.0,
        "errors": None,
        "peers": nothing,
        "peer_columns": [100, 10],
    } | changes


def _hidden(effect: str, *twins: str) -> dict[str, Any]:
    return {"effect": effect, "twins": list(twins), "kind": "deterministic"}


def test_right_means_first_and_found_alone_or_in_its_group() -> None:
    ranking = [
        {"effect": "lag", "log_p": -40.0, "twins": ["time-offset"]},
        {"effect": "arm-sag", "log_p": -20.0, "twins": []},
    ]
    common = {"verdict": "missing-effect", "ranking": ranking}
    for truth, found, right, alone in (
        ("lag", ["lag"], True, True),
        ("time-offset", ["lag"], True, True),
        ("time-offset", ["lag", "arm-sag"], True, False),
        ("arm-sag", ["lag", "arm-sag"], False, False),
        ("lag", [], False, False),
    ):
        x = _line("single-10/000", hidden=[_hidden(truth)], found=found, **common)
        assert (score.right_first(x), score.right_alone(x)) == (right, alone)
    two = _line(
        "two/000", hidden=[_hidden("time-offset"), _hidden("arm-sag")], found=["lag", "arm-sag"], **common
    )
    assert score.both(two)
    assert score.exactly_both(two)
    assert not score.both({**two, "found": ["lag"]})


def test_a_peer_is_right_with_what_no_method_can_tell_apart() -> None:
    x = _line("single-10/000", hidden=[_hidden("lag", "time-offset")])
    x["peers"]["FROLS"]["effects"] = ["time-offset", "arm-sag"]
    p = score.Peer("FROLS")
    assert p.right_first(x)
    assert not p.right_alone(x)
    assert not score.Peer("stepwise BIC").right_first(x)


def test_the_interval_of_a_share_holds_its_value_and_stays_within_its_bounds() -> None:
    for hits in (0, 1, 30, 60):
        s = score.Share(hits, 60)
        low, high = s.interval()
        assert low - 1e-12 < s.value < high + 1e-12
        assert low > -1e-12
        assert high < 1 + 1e-12
    assert score.Share(3, 60).interval() == pytest.approx((0.0171, 0.1370), abs=1e-4)  # as published tables


def test_a_run_resumes_where_it_was_cut_off(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []

    def fake(spec: plan.Spec) -> dict[str, object]:
        asked.append(spec.id)
        return {k: v for k, v in _line(spec.id).items() if k not in ("id", "kind", "plan", "source")}

    monkeypatch.setattr(command, "fly", fake)
    cache = tmp_path / "deep" / "cache.jsonl"
    arguments = ["--cache", str(cache), "--page", str(tmp_path / "page.md"), "--flights", "2"]
    assert command.main([*arguments, "--only", "two"]) == 0
    assert asked == ["two/000", "two/001"]
    text = cache.read_text()
    cache.write_text(text[:-40])  # killed while the second line was written
    asked.clear()
    assert command.main([*arguments, "--only", "two", "--only", "outside"]) == 0
    assert sorted(asked) == ["outside/000", "outside/001", "two/001"]
    specs = plan.specs(["two"], 2, plan.PAGE)
    lines = [json.loads(x) for x in cache.read_text().splitlines() if x.endswith("}")]
    source = lines[0]["source"]
    assert set(command.finished(iter(lines), specs, source)) == {"two/000", "two/001"}
    assert not command.finished(iter(lines), specs, "another version")
    assert not command.finished(iter([x | {"plan": "changed"} for x in lines]), specs, None)
    assert not (tmp_path / "page.md").exists()  # not complete


def test_a_flight_without_end_is_a_crash(monkeypatch: pytest.MonkeyPatch) -> None:
    def endless(spec: plan.Spec) -> dict[str, object]:
        while True:
            pass

    monkeypatch.setattr(fly, "_flown", endless)
    monkeypatch.setattr(fly, "LONGEST", 0.2)
    assert "TimeoutError" in str(fly.fly(plan.spec("two", 0))["crash"])


def test_the_plan_is_large_enough_and_always_the_same() -> None:
    specs = plan.specs()
    assert len(specs) >= 200
    assert plan.COUNTS["effect-free"] >= 60
    assert plan.COUNTS["outside"] >= len(outside.NAMES) >= 20
    assert len({s.seed for s in specs}) == len({s.digest for s in specs}) == len(specs)
    assert plan.spec("two", 3) == plan.spec("two", 3)
    others = plan.specs(sample=1)
    assert not {s.seed for s in others} & {s.seed for s in specs}
    assert not {s.digest for s in others} & {s.digest for s in specs}
    assert [s.id for s in others] == [s.id for s in specs]
    assert {s.motion for s in specs} == {"mixed", "recorded", *("dryden", "flat", "kolmogorov", "resonant")}


def test_the_page_depends_on_the_lines_alone() -> None:
    lines = [
        _line("effect-free/000"),
        _line("effect-free/001", verdict="missing-effect", found=["lag"]),
        _line(
            "single-10/000",
            hidden=[_hidden("lag")],
            found=["lag"],
            verdict="missing-effect",
            errors={"before": [2.0, 2.0], "tool": [1.5, 1.5], "oracle": [1.0, 1.0]},
        ),
        _line("two/001", crash="Traceback\nValueError: no"),
    ]
    assert "Not an independent sample" in table.page(lines, complete=False)
    assert "`--seed 7`" in table.page(lines, complete=False, sample=7)
    text = table.page(lines, complete=False)
    assert text == table.page(lines[::-1], complete=False)
    assert "1 of 2 (50 %" in text
    assert "worst 1.5000" in text
    assert "crash: ValueError: no" in text


def test_the_digest_of_the_sources_sees_every_room_that_a_diagnosis_loads(tmp_path: Path) -> None:
    loaded = subprocess.run(
        [
            sys.executable,
            "-c",
            "import sys, benchmarks.diagnosis.fly; print(*{m.split('.')[1] for m in sys.modules"
            " if m.startswith('ragg_runtime.')})",
        ],
        cwd=command.ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    assert set(loaded) - {"wording"} <= set(command.ROOMS)
    with pytest.raises(FileNotFoundError, match=r"generated/manifest\.json"):
        command.source_digest(tmp_path)
