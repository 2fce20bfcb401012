"""A record that is given twice is refused, or counted once, whatever its format."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from flights_of_a_survey import in_process

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.io.record import distinct
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.simulate import simulate_flight
from ragg_runtime.survey import run


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> api.Loaded:
    return api.new(tmp_path_factory.mktemp("same") / "model")


@pytest.fixture(scope="module")
def flight(model: api.Loaded) -> Flight:
    return simulate_flight(model.instrument, [], seed=1, duration=150.0, rate=8.0)


def test_in_two_formats_it_is_refused_everywhere(model: api.Loaded, flight: Flight, tmp_path: Path) -> None:
    write_flight(flight, tmp_path / "x.csv")
    write_flight(flight, tmp_path / "y.parquet")
    both = api.read_flights(model, [tmp_path / "x.csv", tmp_path / "y.parquet"])
    for use in (
        api.compare,
        api.diagnose,
        lambda m, x: api.add(m, "lag", x),
        lambda m, x: api.calibrate(m, x, save=True),
        api.compensate,
        api.compare_frozen,
    ):
        with pytest.raises(UserError, match=r"the same record as .*: it would count twice"):
            use(model, both)
    kept = api.load(model.directory.path)
    assert (kept.model.effects, kept.directory.calibration) == ((), None)


def test_other_records_are_others(flight: Flight) -> None:
    """The same motion flown again with other noise; flights at rest."""
    s = scenario(5, duration=150.0, trim="table-v")
    flights = [
        s.simulate().flight("once"),
        dataclasses.replace(s, seed=99).simulate().flight("again"),
        flight,
    ]
    rest = {n: np.full(len(flight), 9.8 if n == "a_z" else 0.0) for n in flight.channels}
    for seed in (1, 2):
        noise = np.random.default_rng(seed).normal(size=len(flight))
        flights.append(dataclasses.replace(flight, channels=rest, outputs={"G_out": noise}))
    distinct(flights)


def test_a_survey_counts_one_record_once(
    model: api.Loaded, flight: Flight, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run, "examine_here", in_process)
    write_flight(flight, tmp_path / "a.parquet")
    write_flight(flight, tmp_path / "b.csv")
    kept = tmp_path / "kept.jsonl"
    for _ in range(2):
        s = api.survey(model, [tmp_path / "b.csv", tmp_path / "a.parquet"], resume=kept)
        assert [("verdict" in r, "error" in r) for r in s.records] == [(True, True), (False, True)]
        assert "the same record as" in s.records[1]["error"]["message"]
        assert "content" not in s.records[0]
    assert s.as_json()["counts"]["error"] == 1
