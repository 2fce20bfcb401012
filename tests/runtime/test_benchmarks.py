"""The framework of the benchmarks: what is run, what the page shows."""

from __future__ import annotations

import math

import numpy as np

from benchmarks import Row, evaluation
from benchmarks.__main__ import find_benchmarks, main, write_table
from benchmarks.evaluation import instrument_and_motion
from benchmarks.rivals import program, write_function
from generated import folded


def test_benchmarks_are_found_by_their_run() -> None:
    assert set(find_benchmarks()) == {"commands", "evaluation"}
    assert main(["no-such"]) == 2


def test_a_table_shows_rows_and_targets() -> None:
    text = write_table(
        [Row("fast", 1.234, "x", limit=1.0, at_least=True, low=1.1, high=1.4), Row("gone", math.nan, "ns")]
    )
    assert "| fast | 1.23 x | 1.10 to 1.40 | at least 1: met |" in text
    assert "| gone | nan ns |" in text


def test_functions_are_timed_in_turn() -> None:
    order: list[str] = []
    clock = iter(np.arange(100.0))
    found = evaluation.interleave(
        {n: lambda n=n: order.append(n) for n in "ab"},  # type: ignore[misc]
        repeats=2, clock=lambda: float(next(clock)),
    )  # fmt: skip
    assert "".join(order) == "ab" + "abab"
    assert found["a"].tolist() == [1.0, 1.0]
    row = Row.of("", [1.0, 2.0, 3.0], "s CPU", limit=1.5)
    assert (row.low, row.value, row.high, row.target) == (1.5, 2.0, 2.5, "at most 1.5 s: not met")


def test_the_rival_is_given_the_same_model() -> None:
    t, x, p = instrument_and_motion(5000)
    true, phi = folded.output(t, x, p), 2 * np.pi * p[1] * t
    found = write_function(program(p), np)(np.cos(phi), np.sin(phi), *x)
    np.testing.assert_allclose(found, true, rtol=0, atol=1e-9 * np.max(np.abs(true)))


def test_what_is_timed_is_what_fifty_digits_say() -> None:
    _, _, p = evaluation.instrument_and_motion(40)
    functions = evaluation.contenders(p)
    ours = {name: functions[name] for name in (evaluation.OURS, evaluation.OURS_NUMPY)}
    assert max(evaluation.errors(p, ours).values()) < 2e-7
