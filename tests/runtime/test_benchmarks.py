"""The framework of the benchmarks: what is run, how changes are told, what the page shows."""

from __future__ import annotations

import importlib
import json
import math

import numpy as np
import pytest

from benchmarks import Row, bounds, page, timing, where
from benchmarks.__main__ import LAST, main, modules, ratios
from benchmarks.evaluation import instrument_and_motion
from benchmarks.rivals import lambdify, numpy_blocks, program
from generated import folded


def test_benchmarks_are_found_by_their_run() -> None:
    assert {"derivation", "evaluation"} <= set(modules())
    assert not {"timing", "page", "machine", "rivals", "bounds"} & set(modules())
    assert main(["no-such"]) == 2


@pytest.mark.parametrize("step", where.STEPS)
def test_the_profile_watches_functions_that_exist(step: str) -> None:
    module, _, name = step.partition(":")
    assert callable(getattr(importlib.import_module(f"ragg_runtime.{module}"), name))


def test_last_run_is_of_benchmarks_that_exist() -> None:
    last = json.loads(LAST.read_text("utf-8"))
    assert set(last) <= set(modules())
    assert all(math.isfinite(v) and v > 0 for rows in last.values() for v in rows.values())


@pytest.mark.parametrize(
    ("better", "before", "after", "said"),
    [
        ("lower", 2.0, 2.2, "+10 %"),
        ("lower", 2.0, 3.0, "+50 % WORSE"),
        ("lower", 2.0, 1.0, "-50 %"),
        ("higher", 2.0, 1.0, "-50 % WORSE"),
        ("higher", 2.0, 4.0, "+100 %"),
        (None, 2.0, 4.0, "+100 %"),
    ],
)
def test_changes_for_the_worse_are_marked(better: str | None, before: float, after: float, said: str) -> None:
    row = Row("r", after, "x", better=better)  # type: ignore[arg-type]
    assert page.changes([row], {"r": before}) == {"r": said}
    assert page.changes([Row("r", after, "s", better="lower")], {"r": before}) == {}  # no ratio
    assert page.changes([row], {}) == {}


def test_page_shows_rows_targets_failures_and_changes() -> None:
    rows = [
        Row("fast", 1.234, "x", target="at least 1", met=True, low=1.1, high=1.4, better="higher"),
        Row("gone", math.nan, "ns"),
    ]
    results = {
        "a": {"seconds": 1.0, "load": 0.1, "rows": [vars(r) for r in rows]},
        "b": {"failed": "exit status 3", "rows": []},
    }
    text = page.page({"machine": {"cores": "2"}, "results": results}, {"a": "About a."}, {"a": {"fast": 1.0}})
    assert "| fast | 1.23 x | 1.10 ... 1.40 | at least 1: met |  | +23 % |" in text
    assert "Failed: exit status 3." in text
    assert "About a." in text
    rows = [Row("slow", 2.0, "s")]
    some = {"b": {"seconds": 2.0, "load": 0.2, "rows": [vars(r) for r in rows]}}
    again = page.renewed(text, some, {"b": "About b."}, {})  # one alone: the other stays as it was
    assert again.split("## b")[0] == text.split("## b")[0]
    assert "| slow | 2.00 s |" in again
    assert "Failed" not in again
    assert page.renewed(again, {}, {}, {}) == again
    assert ratios(results) == {"a": {"fast": 1.234}}


def test_functions_are_timed_in_turn() -> None:
    order: list[str] = []
    clock = iter(np.arange(100.0))
    found = timing.interleaved(
        {n: lambda n=n: order.append(n) for n in "ab"},  # type: ignore[misc]
        repeats=2, clock=lambda: float(next(clock)),
    )  # fmt: skip
    assert "".join(order) == "ab" + "abab"
    assert found["a"].seconds == (1.0, 1.0)
    twice = timing.ratio(timing.Timing((2.0, 4.0, 6.0)), timing.Timing((1.0, 2.0, 3.0)))
    assert (twice.value, twice.low, twice.high) == (2.0, 2.0, 2.0)


def test_rivals_evaluate_the_same_model() -> None:
    t, x, p = instrument_and_motion(5000)
    code, true = program(p), folded.output(t, x, p)
    for make in (numpy_blocks, lambdify):
        out = np.empty(len(t))
        make(code, float(p[1]))(t, x, out)
        np.testing.assert_allclose(out, true, rtol=0, atol=1e-9 * np.max(np.abs(true)))


def test_operations_of_the_generated_c_are_counted() -> None:
    assert 120 < bounds.instructions() < 200  # 49 coefficients, twelve turned numbers, one sine and cosine
