"""Surveys on this machine and on a real dask.distributed cluster on loopback: the same figures, bit for bit; workers that die."""

from __future__ import annotations

import io
import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pyarrow.parquet as pq
import pytest
from commands import ragg
from workers import begin, die, in_process

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.io import read_flight, write_flight
from ragg_runtime.io.tables import DataColumn, DataTable
from ragg_runtime.simulate import simulate_flight
from ragg_runtime.survey import run
from ragg_runtime.survey.examine import Job, Record, examine, expand_lines, split_line
from ragg_runtime.survey.result import Survey, make_parquet
from ragg_runtime.survey.run import digest_file, name_flights
from ragg_runtime.wording.sections import render_text
from tests.runtime.foreign_files import write

Flights = tuple[Path, list[Path]]


@pytest.fixture(scope="module")
def flights(tmp_path_factory: pytest.TempPathFactory) -> Flights:
    """Three flights of 150 s, an effect hidden in the first, and a damaged file."""
    folder = tmp_path_factory.mktemp("survey")
    m, paths = api.new(folder / "model"), [folder / f"flight-{k}.parquet" for k in range(3)]
    for k, path in enumerate(paths):
        hidden = [] if k else ["thermal-scale:dK1_dT=0/0/6e-8/0"]
        write_flight(simulate_flight(m.instrument, hidden, seed=k + 50, duration=150.0, rate=8.0), path)
    damaged = folder / "flight-2b.parquet"
    damaged.write_bytes(paths[1].read_bytes()[:5000])
    return folder / "model", [*paths, damaged]


@pytest.fixture(scope="module")
def whole(flights: Flights) -> Survey:
    """What this process says; that a pool says the same is seen where one is cut short."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run, "examine_all", in_process)
        return api.survey(api.load(flights[0]), flights[1])


def of_some(whole: Survey, files: list[Path]) -> Survey:
    """The survey of some of the flights."""
    return Survey(tuple(r for r in whole.records if r["flight"] in [p.name for p in files]))


def lines_of(path: Path) -> list[Any]:
    """Every complete line of a results file."""
    text = path.read_bytes()
    return [json.loads(line) for line in text[: text.rfind(b"\n") + 1].splitlines()]


def test_every_flight_has_its_own_figures_and_one_that_cannot_be_read_stops_nothing(flights, whole) -> None:
    m = api.load(flights[0])
    assert [r["flight"] for r in whole.records] == sorted(p.name for p in flights[1])
    first, plain, failed = (whole.records[k] for k in (0, 1, 3))
    assert "thermal-scale" in first["found"]
    assert first["error"]["after"]["rms_Eo"] < 0.9 * first["error"]["calibrated"]["rms_Eo"]
    assert (plain["verdict"], plain["found"]) == ("adequate", [])
    c = api.compare(m, api.read_flights(m, [flights[1][1]]))
    figures = {k: plain["error"][k]["rms_Eo"] for k in ("after", "nominal", "holdout")}
    expected = {"after": c.calibrated.rms_Eo, "nominal": c.nominal.rms_Eo, "holdout": c.holdout.rms_Eo}
    assert figures == pytest.approx(expected, rel=1e-9)
    assert failed["flight"] == "flight-2b.parquet"
    assert "damaged" in failed["error"]["message"]
    assert (whole.as_json()["counts"]["error"], len(whole.done)) == (1, 3)
    text = render_text(whole.sections(flights[0]))
    assert "1 in error" in text and "flight-2b.parquet  " in text and "ragg add" in text
    advice = whole.as_json()["recommendation"][0]
    assert (advice["effect"], advice["firm"]) == ("thermal-scale", True)
    assert "flight-0.parquet" in advice["flights"]


def test_a_flight_that_kills_every_worker_is_given_up(flights, monkeypatch) -> None:
    monkeypatch.setattr(run, "examine", die)
    # ours imports the program, which takes a second each time
    monkeypatch.setattr(run, "_begin", begin)
    files = [str(p) for p in flights[1]]
    results = dict(run.examine_all(None, files, partial(run.open_processes, 1)))  # type: ignore[arg-type]
    assert sorted(results) == sorted(files)
    failed = {Path(f).name: r["error"] for f, r in results.items() if "error" in r}
    assert sorted(failed) == ["flight-1.parquet", "flight-2.parquet"]
    assert "died" in failed["flight-1.parquet"]["message"]
    assert "MemoryError" in failed["flight-2.parquet"]["message"]
    assert {e["kind"] for e in failed.values()} == {"lost"}


def test_a_survey_that_is_cut_short_continues(flights, whole, tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(run, "examine_all", in_process)
    files = flights[1][1:]
    kept = tmp_path / "kept.jsonl"
    command = ("survey", flights[0], *files, "--jobs", 1, "--resume", kept)
    words = [sys.executable, "-m", "ragg_runtime", *map(str, command)]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while not (kept.exists() and kept.read_bytes().count(b"\n") > 1):
        assert process.poll() is None
        time.sleep(0.02)
    workers = psutil.Process(process.pid).children()
    process.kill()
    _, said = process.communicate(timeout=60)
    assert psutil.wait_procs(workers, timeout=60)[1] == []
    assert "Traceback" not in said
    before = kept.read_bytes()
    assert 1 <= len(lines_of(kept)) - 1 < len(files)
    kept.write_bytes(before + b'{"flight": "half a li')
    done = ragg(*command, "--json", tmp_path / "again.json")
    assert (done.returncode, "1 in error" in done.stdout, "done before" in done.stderr) == (0, True, True)
    assert kept.read_bytes().startswith(before)
    again = json.loads((tmp_path / "again.json").read_text())
    assert json.dumps(again["flights"]) == json.dumps(of_some(whole, files).records)


def test_results_of_something_else_and_bad_use_are_refused(flights: Flights, tmp_path: Path) -> None:
    m, kept = api.load(flights[0]), tmp_path / "kept.jsonl"
    other = json.dumps({"kind": "ragg survey", "model": "0" * 64, "program": {}}) + "\n"
    strange = ('{"kind": "another"}\n', "[1, 2]\n", "no line end")
    for text, said in (*((x, "not a results file") for x in strange), (other, r"another model\.toml")):
        kept.write_text(text)
        with pytest.raises(UserError, match=said):
            api.survey(m, flights[1], jobs=1, resume=kept)
        assert kept.read_text() == text
    with pytest.raises(UserError, match="needs flights"):
        api.survey(m, [])
    with pytest.raises(UserError, match="or on a cluster"):
        api.survey(m, flights[1], jobs=1, scheduler="tcp://127.0.0.1:1")
    asked = Job(m.directory.text, str(flights[0] / "model.toml"), program=(("numpy", "1.0"),))
    assert "another version of the program" in examine(asked, str(flights[1][0]))["error"]["message"]


def test_only_flights_that_have_not_changed_are_taken_from_the_results(
    flights: Flights, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def glance(_: Job, files: Sequence[str], pool: object) -> Iterator[tuple[str, Record]]:
        """Stands in for a diagnosis, to which a file that is cut off is an error."""
        for f in files:
            done = record("", {}) if Path(f).stat().st_size > 5000 else {"error": {"message": "damaged"}}
            yield f, done | {"file": f, "sha256": digest_file(f)}

    monkeypatch.setattr(run, "examine_all", glance)
    m = api.load(flights[0])
    kept, one, two = (tmp_path / n for n in ("kept.jsonl", "a/line.parquet", "b/line.parquet"))
    one.parent.mkdir()
    two.parent.mkdir()
    one.write_bytes(flights[1][1].read_bytes())
    two.write_bytes(flights[1][3].read_bytes())  # the damaged one
    first = api.survey(m, [one, two], jobs=1, resume=kept)
    two.write_bytes(flights[1][2].read_bytes())
    seen: list[str] = []

    def note(done: int, total: int, record: Record | None) -> None:
        seen.append(f"{done}/{total}" if record is None else record["flight"])

    second = api.survey(m, [two, one, one], jobs=1, resume=kept, progress=note)
    assert seen == ["1/2", "b/line.parquet"]
    assert second.records[0] == first.records[0]
    assert ("verdict" in first.records[1], "verdict" in second.records[1]) == (False, True)


def record(name: str, found: dict[str, list[str]], value: float = 1.0, log10_p: float = -5.0) -> Record:
    error = {k: {"rms_Eo": 2.0} for k in ("nominal", "calibrated", "holdout", "after", "after_holdout")}
    return {
        "flight": name, "file": name, "verdict": "missing-effect" if found else "adequate",
        "found": list(found), "indistinguishable": found, "not_testable": ["lag"], "notes": [],
        "ranking": [{"effect": e, "log10_p": log10_p, "delta_bic": 9.0} for e in found],
        "error": error, "noise_floor": {"rms_Eo": 2.0},
        "parameters": [
            {"name": "K2", "accelerometer": 1, "value": value, "std": 0.1, "unit": "ug/g^2"},
            {"name": "K1", "accelerometer": 2, "value": 1e9 + value % 0.01, "std": 0.1, "unit": "V"},
        ],
    }  # fmt: skip


def test_the_table_has_a_row_a_flight_and_the_figures_of_the_json(whole: Survey) -> None:
    table = make_parquet(whole.records)
    assert table == make_parquet(whole.records)
    for row, r in zip(pq.read_table(io.BytesIO(table)).to_pylist(), whole.records, strict=True):
        assert (row["flight"], row["file"], row["verdict"]) == (r["flight"], r["file"], r.get("verdict"))
        if "verdict" not in r:
            assert (row["error"], row["calibrated_Eo"]) == (r["error"]["message"], None)
            continue
        assert row["error"] is None
        assert row["calibrated_Eo"] == r["error"]["calibrated"]["rms_Eo"]
        assert row["noise_floor_Eo"] == r["noise_floor"]["rms_Eo"]
        assert (row["found"], row["ranking"]) == (r["found"], r["ranking"])
        assert row["parameters"] == [{k: p.get(k) for k in row["parameters"][0]} for p in r["parameters"]]


def advised(s: Survey) -> list[tuple[str, bool]]:
    return [(a["effect"], a["firm"]) for a in s.as_json()["recommendation"]]


def test_few_flights_are_chance_many_are_not() -> None:
    def with_lag(count: int, log10_p: float = -5.0) -> Survey:
        records = (record(f"{k:03}", {"lag": []} if k < count else {}, log10_p=log10_p) for k in range(100))
        return Survey(tuple(records))

    assert advised(with_lag(4)) == [("lag", False)]
    assert advised(with_lag(15)) == [("lag", True)]
    assert advised(with_lag(1, -90.0)) == [("lag", True)]


def test_an_effect_that_accounts_for_all_flights_is_advised_before_those_that_fit_some() -> None:
    claims: list[dict[str, list[str]]] = [
        {"arm-sag": ["lag"]}, {"cubic-input": ["lag", "arm-sag"]}, {"lag": ["cubic-input"]}, {"lag": []},
    ]  # fmt: skip
    s = Survey(tuple(record(f"{k}", c) for k, c in enumerate(claims))).as_json()
    (advice,) = s["recommendation"]
    assert (advice["effect"], advice["flights"], advice["alternatives"]) == ("lag", ["0", "1", "2", "3"], [])
    assert s["effects"][0] == {"effect": "lag", "found": 2, "perhaps": 2, "testable": 0}


def test_trends_tell_constant_drifting_and_scattered_parameters() -> None:
    noise = np.random.default_rng(8).normal(size=60)

    def trend_of(values: np.ndarray[Any, Any], name: str = "K2") -> Record:
        s = Survey(tuple(record(f"{k:02}", {}, v) for k, v in enumerate(values)))
        return next(t for t in s.as_json()["parameters"] if t["name"] == name)

    constant, drifting = trend_of(3.0 + 0.1 * noise), trend_of(3.0 + 0.02 * np.arange(60))
    assert not constant["varies"]
    assert constant["mean"] == pytest.approx(3.0, abs=0.05)
    assert constant["chi2"] / constant["dof"] == pytest.approx(1.0, abs=0.4)
    assert drifting["varies"]
    assert drifting["slope_z"] > 10
    scattered = trend_of(3.0 + noise)
    assert scattered["varies"]
    assert abs(scattered["slope_z"]) < 4  # not a trend, however small the single standard deviations
    assert scattered["scatter"] == pytest.approx(1.0, rel=0.25)
    large = trend_of(3.0 + 0.1 * noise, "K1")
    assert 1e9 <= large["mean"] <= 1e9 + 0.01  # no digits lost to the large mean
    assert large["chi2"] < 1.0


def test_lines_are_flights(flights: Flights, tmp_path: Path) -> None:
    """Two flights as lines of one file, under other names."""
    path, toml, tables = tmp_path / "s.h5", flights[0] / "model.toml", []
    for k in range(2):
        x = read_flight(flights[1][k], 9.8)
        columns = {**x.channels, **x.outputs}
        names = {n: f"C{k}" for k, n in enumerate(columns)}
        rows = [DataColumn("T", "", np.asarray(x.time))]
        rows += [DataColumn(names[n], "", np.asarray(v)) for n, v in columns.items()]
        tables.append(DataTable(tuple(rows), str(10 * (k + 1))))
    write(path, tables)
    entries = [f'{n} = {{ column = "{c}", unit = "{x.units[n]}" }}' for n, c in names.items()]
    text = "\n".join(['[time]\ncolumn = "T"\nunit = "s"\n[columns]', *entries])
    job = Job(toml.read_text(), str(toml), mapping=(text, "mapping.toml", False))
    files = expand_lines(job, [str(path), str(tmp_path / "none.csv")])
    assert files == [f"{path}::10", f"{path}::20", str(tmp_path / "none.csv")]
    assert split_line(files[0]) == (path, "10")
    record = examine(job, files[1])
    assert (record["flight"], record["verdict"]) == ("s.h5::20", "adequate")
    assert record["sha256"] == digest_file(files[1]) == digest_file(str(path))
    assert "several lines" in examine(job, str(path))["error"]["message"]
    assert "the columns time, a_x" in examine(Job(toml.read_text(), str(toml)), files[0])["error"]["message"]


def test_flights_of_one_file_name_are_named_with_their_folders_and_in_order() -> None:
    days = [f"/s/day-{d}/line-{n}.csv" for d in (1, 0) for n in (1, 0)]
    # the days follow one another, and so does what drifts
    assert list(name_flights([*days, days[0]])) == sorted(days)
    assert list(name_flights(["/s/a/2.csv", "/s/b/1.csv"])) == ["/s/b/1.csv", "/s/a/2.csv"]
    files = ["/s/01/flight.csv", "/s/02/flight.csv", "/t/02/flight.csv", "/s/other.csv", "/none/s.csv::20"]
    names = ["01/flight.csv", "s/02/flight.csv", "t/02/flight.csv", "other.csv", "s.csv::20"]
    assert name_flights(files) == dict(zip(files, names, strict=True))


HERE = "127.0.0.1"


def test_the_figures_are_those_of_this_machine_though_a_worker_is_killed(flights, whole, tmp_path) -> None:
    """And once the scheduler is lost that is one message, and what is done is kept."""
    distributed = pytest.importorskip("distributed", reason="needs the extra cluster")
    m, kept, files = api.load(flights[0]), tmp_path / "kept.jsonl", flights[1][1:]
    expected = of_some(whole, files)
    killed: list[int] = []
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, host=HERE, dashboard_address=None
    ) as cluster:
        with distributed.Client(cluster, set_as_default=False) as client:
            workers = list(client.run(os.getpid).values())

        def kill_one(done: int, total: int, record: Record | None) -> None:
            if record is not None and not killed:
                killed.append(workers[0])
                os.kill(workers[0], signal.SIGKILL)

        survey = api.survey(m, files, scheduler=cluster.scheduler_address, progress=kill_one)
        assert killed
        assert json.dumps(survey.records) == json.dumps(expected.records)

        # A file that the workers do not see; the survey is done all the same.
        (lost,) = api.survey(m, ["elsewhere.parquet"], scheduler=cluster.scheduler_address).records
        assert "does not see the flight file" in lost["error"]["message"]

        def end(done: int, total: int, record: Record | None) -> None:
            if done == 1:
                cluster.close()

        with pytest.raises(UserError, match="connection to the scheduler is lost"):
            api.survey(m, files, scheduler=cluster.scheduler_address, resume=kept, progress=end)
    assert 2 <= len(lines_of(kept)) < len(files) + 1


@pytest.mark.parametrize("address", ["free", "127.0.0.1", "", "scheduler.json"])
def test_a_scheduler_that_is_not_there_is_one_message(flights, address, monkeypatch) -> None:
    pytest.importorskip("distributed", reason="Dask is an optional extra: pip install 'ragg[cluster]'")
    if address == "free":
        with socket.socket() as s:
            s.bind((HERE, 0))
            address = f"tcp://{HERE}:{s.getsockname()[1]}"
    monkeypatch.setattr(run, "PATIENCE", 1.0)
    with pytest.raises(UserError, match="cannot be reached"):
        api.survey(api.load(flights[0]), flights[1], scheduler=address)
