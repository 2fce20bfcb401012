"""One record given twice is recognised by its content, however it is kept; different records never are."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight import Flight, read_flight, write_flight
from ragg_runtime.flight.landmarks import Landmarks, distinct, landmarks, overlap, repeated
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.workflow import after, loop
from ragg_runtime.workflow.simulate import simulated

G0 = 9.8


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> loop.Loaded:
    return loop.new(tmp_path_factory.mktemp("landmarks") / "model")


@pytest.fixture(scope="module")
def flight(model: loop.Loaded) -> Flight:
    return simulated(model.instrument, [], seed=1, duration=600.0, rate=16.0)


def printed(flight: Flight, path: Path, format_: str, drop: tuple[str, ...] = ()) -> Flight:
    """The flight as a logger prints it."""
    units = {"a": ("mg", 9.8e-3), "omega": ("deg/h", np.pi / 648000), "G": ("uV", 1e-6), "time": ("s", 1.0)}
    names = ["time", "a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z", "G_out"]
    names = [n for n in names if n not in drop]
    columns = [flight.time if n == "time" else {**flight.channels, **flight.outputs}[n] for n in names]
    scale = [units[n.split("_")[0]] for n in names]
    header = ",".join(f"{n} [{u}]" for n, (u, _) in zip(names, scale, strict=True))
    table = np.column_stack([v / s for v, (_, s) in zip(columns, scale, strict=True)])
    np.savetxt(path, table, format_, ",", header=header, comments="")
    return read_flight(path, G0)


@pytest.mark.parametrize("format_", ["%.17g", "%.12g", "%.9g", "%.8g", "%.7g", "%.6g", "%.4f"])
def test_printed_to_some_digits_it_is_the_same_record(format_: str, flight: Flight, tmp_path: Path) -> None:
    assert overlap(landmarks(flight), landmarks(printed(flight, tmp_path / "x.csv", format_))) is not None


def test_as_csv_and_as_parquet_it_is_refused_everywhere(
    model: loop.Loaded, flight: Flight, tmp_path: Path
) -> None:
    write_flight(flight, tmp_path / "x.csv")
    write_flight(flight, tmp_path / "y.parquet")
    both = loop.read_flights(model, [tmp_path / "x.csv", tmp_path / "y.parquet"])
    assert loop.load(model.directory.path).directory.calibration is None
    for use in (
        loop.compare,
        loop.diagnose,
        lambda m, x: loop.add(m, "lag", x),
        lambda m, x: after.calibrate(m, x, save=True),
        after.compensate,
        lambda m, x: after.compensate(m, x, "crossed"),
        after.compare_frozen,
    ):
        with pytest.raises(UserError, match=r"the same record as .*as evidence it would count twice"):
            use(model, both)
    kept = loop.load(model.directory.path)
    assert (kept.model.effects, kept.directory.calibration) == ((), None)


def test_overlapping_cuts_with_times_of_their_own(flight: Flight) -> None:
    one, other, next_ = (
        flight.part(slice(0, 6000)),
        flight.part(slice(3500, 9600)),
        flight.part(slice(6000, 9600)),
    )
    other = dataclasses.replace(other, time=other.time - other.time[0])
    found = overlap(landmarks(one), landmarks(other))
    assert found is not None
    assert 0 <= found.first < found.last <= 2500 / 16
    with pytest.raises(UserError, match="same record"):
        distinct([one, other])
    distinct([one, next_])
    few = overlap(landmarks(one, 16), landmarks(other, 16))
    assert few is not None


def test_other_records_are_others(flight: Flight, model: loop.Loaded) -> None:
    """Other seeds; the same motion flown again with other noise; a flight at rest."""
    s = scenario(5, duration=600.0, trim="table-v")
    flights = [
        s.simulate().flight("once"),
        dataclasses.replace(s, seed=99).simulate().flight("again"),
        flight,
    ]
    flights += [simulated(model.instrument, [], seed=k, duration=600.0, rate=16.0) for k in (2, 3)]
    rest = {n: np.full(len(flight), 9.8 if n == "a_z" else 0.0) for n in flight.channels}
    for seed in (1, 2):
        noise = np.random.default_rng(seed).normal(size=len(flight))
        coarse = dataclasses.replace(flight, channels=rest, outputs={"G_out": np.round(noise, 1)})
        flights.append(dataclasses.replace(coarse, name=f"rest {seed}"))
    distinct(flights)


def test_landmarks_pass_through_json(flight: Flight) -> None:
    one = landmarks(flight, 64)
    other = Landmarks.from_json("other", one.as_json())
    found = overlap(one, other)
    assert found is not None
    assert found.landmarks == len(one.rows) <= 64


def test_a_survey_counts_one_record_once(model: loop.Loaded, flight: Flight, tmp_path: Path) -> None:
    short = flight.part(slice(0, 2400))
    write_flight(short, tmp_path / "a.parquet")
    write_flight(short, tmp_path / "b.csv")
    kept = tmp_path / "kept.jsonl"
    for _ in range(2):
        s = loop.survey(model, [tmp_path / "b.csv", tmp_path / "a.parquet"], jobs=1, resume=kept)
        assert [("verdict" in r, "error" in r) for r in s.records] == [(True, True), (False, True)]
        assert "the same record as" in s.records[1]["error"]["message"]
        assert "landmarks" not in s.records[0]
    assert s.summary.counts["error"] == 1


def test_of_many_flights_only_those_that_can_agree_are_compared_and_none_is_missed() -> None:
    rng = np.random.default_rng(4)

    def some(name: str, digit: float) -> Landmarks:
        columns = {c: rng.normal(size=12) for c in ("a_x", "a_y", "omega_z", "G_out")}
        if digit:
            columns = {c: np.round(v / digit) * digit for c, v in columns.items()}
        columns["a_y"][3] = np.nan
        rows = np.sort(rng.choice(5000, 12, replace=False))
        spread = dict.fromkeys(columns, 1.0)
        return Landmarks(name, 16.0, rows, columns, dict.fromkeys(columns, digit), spread)

    every = [some(str(k), (0.0, 1e-6, 1e-3)[k % 3]) for k in range(60)]
    for k in (7, 20, 42):  # printed anew to four digits, cut, and from another time on
        x = every[k]
        columns = {c: np.round(v[2:], 4) for c, v in x.columns.items()}
        every.append(
            dataclasses.replace(x, rows=x.rows[2:] + 99, columns=columns, digit=dict.fromkeys(columns, 1e-4))
        )
    every.append(dataclasses.replace(every[-1], columns={c: every[-1].columns[c] for c in ("a_x", "G_out")}))
    brute = {}
    for j, other in enumerate(every):
        for i in range(j):
            shared = overlap(every[i], other)
            if shared is not None:
                brute.setdefault(j, (i, shared))
    assert {j: (i, shared) for j, i, shared in repeated(every)} == brute
    assert {j: i for j, (i, _) in brute.items()} == {60: 7, 61: 20, 62: 42, 63: 42}


def test_in_single_precision() -> None:
    s = scenario(6, duration=600.0)
    x = s.simulate().flight()
    single = {n: v.astype(np.float32).astype(float) for n, v in x.channels.items()}
    outputs = {n: v.astype(np.float32).astype(float) for n, v in x.outputs.items()}
    assert (
        overlap(landmarks(x), landmarks(dataclasses.replace(x, channels=single, outputs=outputs))) is not None
    )
