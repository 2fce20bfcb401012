"""Flights of different instruments under one sheet are inconsistent; an effect between flights is found."""

from __future__ import annotations

import dataclasses
from typing import Any

import pytest

from ragg_runtime.identification import contenders
from ragg_runtime.io import Flight
from ragg_runtime.reference.scenario import Scenario, scenario
from tests.rate import RATE
from tests.runtime.diagnosed import diagnosed


def flown(s: Scenario, name: str, hidden: dict[str, Any] | None = None) -> Flight:
    return dataclasses.replace(s.simulate(hidden or {}).flight(), name=name)


def test_flights_of_two_instruments_are_told_apart_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        contenders, "fit_contender", lambda *arguments: pytest.fail("no effect is to be tried")
    )
    one, other, third = (scenario(k, duration=100.0, rate=RATE) for k in (57, 58, 59))
    again = dataclasses.replace(third, instrument=one.instrument)
    d = diagnosed(one, flown(one, "monday"), flown(other, "tuesday"), flown(again, "friday"))
    assert (d.verdict, d.found) == ("unexplained", ())
    assert d.remark is not None
    assert "inconsistent" in d.remark
    assert "monday, friday; tuesday" in d.remark


def test_a_strong_effect_between_flights_is_no_contradiction() -> None:
    one, other = (scenario(k, duration=100.0, rate=RATE) for k in (57, 58))
    other = dataclasses.replace(other, instrument=one.instrument)
    hidden = {"pressure-bias": {"dK0_dp": [1e-8, 0.0, 0.0, -2e-9]}}
    d = diagnosed(one, flown(one, "low", hidden), flown(other, "high", hidden))
    assert (d.verdict, d.found) == ("missing-effect", ("pressure-bias",))


def test_what_each_flight_alone_lacks_is_said_where_all_together_are_not_explained() -> None:
    one, other = (scenario(k, duration=100.0, rate=RATE) for k in (57, 58))
    other = dataclasses.replace(other, instrument=one.instrument)
    hidden = {"cubic-input": {"K_iii": [4e-8, 0.0, 0.0, 0.0]}}
    d = diagnosed(one, flown(one, "monday", hidden), flown(other, "tuesday"))
    assert (d.verdict, d.found) == ("unexplained", ())
    said = d.as_json()["disagree"]
    assert said == [
        {"flights": ["monday"], "found": ["cubic-input"]},
        {"flights": ["tuesday"], "found": []},
    ]
    assert "cubic-input in monday; nothing in tuesday" in str(d.as_json()["reason"])
