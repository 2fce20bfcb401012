"""Surveys on a real dask.distributed cluster, scheduler and workers on loopback: the same figures, bit for bit."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from flights_of_a_survey import in_process, lines_of, make, without_effect

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.survey import run
from ragg_runtime.survey.examine import Record, examine, make_job
from ragg_runtime.survey.result import Survey

Flights = tuple[Path, list[Path]]
HERE = "127.0.0.1"


@pytest.fixture(scope="module")
def flights(tmp_path_factory: pytest.TempPathFactory) -> Flights:
    model, files = make(tmp_path_factory.mktemp("survey"))
    return model, without_effect(files)


@pytest.fixture(scope="module")
def whole(flights: Flights) -> Survey:
    """What this process says."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run, "examine_here", in_process)
        return api.survey(api.load(flights[0]), flights[1])


def summary(s: Survey) -> str:
    return json.dumps({k: v for k, v in s.as_json().items() if k != "flights"})


class Cluster:
    """A scheduler and workers, each a process of its own, without nannies: a killed worker stays dead."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.processes: list[subprocess.Popen[bytes]] = []
        file = folder / "scheduler.json"
        words = ("--host", HERE, "--port", "0", "--no-dashboard", "--scheduler-file", file)
        self.scheduler = self._start("dask_scheduler", *words)
        self.address = str(self._wait(lambda: json.loads(file.read_text())["address"]))

    def _start(self, module: str, *arguments: object) -> subprocess.Popen[bytes]:
        words = [sys.executable, "-m", f"distributed.cli.{module}", *map(str, arguments)]
        paths = [str(Path(api.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(p for p in paths if p)}
        with (self.folder / f"{len(self.processes)}.log").open("wb") as log:
            process = subprocess.Popen(
                words, cwd=self.folder, stdout=log, stderr=subprocess.STDOUT, env=environment
            )
        self.processes.append(process)
        return process

    def worker(self) -> subprocess.Popen[bytes]:
        return self._start(
            *("dask_worker", self.address, "--host", HERE, "--no-nanny", "--nthreads", "1", "--no-dashboard"),
        )

    @staticmethod
    def _wait(get: Any) -> Any:
        deadline = time.monotonic() + 60
        while True:
            with contextlib.suppress(OSError, ValueError):
                return get()
            assert time.monotonic() < deadline
            time.sleep(0.05)

    def wait_for_workers(self, count: int) -> None:
        import distributed

        with distributed.Client(self.address, set_as_default=False, timeout=30) as client:
            client.wait_for_workers(count, timeout=90)

    def end(self) -> None:
        for p in reversed(self.processes):
            p.kill()
            p.wait(30)


@contextlib.contextmanager
def running(folder: Path, workers: int) -> Iterator[Cluster]:
    pytest.importorskip("distributed", reason="Dask is an optional extra: pip install 'ragg[cluster]'")
    c = Cluster(folder)
    try:
        for _ in range(workers):
            c.worker()
        if workers:
            c.wait_for_workers(workers)
        yield c
    finally:
        c.end()


def test_the_figures_are_those_of_this_machine_though_a_worker_is_killed(
    flights: Flights, whole: Survey, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And once the scheduler is lost that is one message, and what is done is kept."""
    killed: list[int] = []
    m, kept = api.load(flights[0]), tmp_path / "kept.jsonl"
    with running(tmp_path, 2) as c:

        def kill_one(done: int, total: int, record: Record | None) -> None:
            if record is not None and not killed:
                killed.append(c.processes[1].pid)
                c.processes[1].send_signal(signal.SIGKILL)
                c.processes[1].wait(30)

        found = api.survey(m, flights[1], scheduler=c.address, progress=kill_one)
        assert killed
        assert summary(found) == summary(whole)
        for there, here in zip(found.records, whole.records, strict=True):
            if "verdict" in here:
                assert json.dumps(there) == json.dumps(here)
        assert [r["flight"] for r in found.records if "verdict" not in r] == ["flight-2b.parquet"]

        # A file that the workers do not see; the survey is done all the same.
        (lost,) = api.survey(m, ["elsewhere.parquet"], scheduler=c.address).records
        assert "does not see the flight file" in lost["error"]["message"]

        def kill_scheduler(done: int, total: int, record: Record | None) -> None:
            if done == 1:
                c.scheduler.kill()

        with pytest.raises(UserError, match="connection to the scheduler is lost"):
            api.survey(m, flights[1], scheduler=c.address, resume=kept, progress=kill_scheduler)
    assert 2 <= len(lines_of(kept)) < len(flights[1]) + 1
    monkeypatch.setattr(run, "examine_here", in_process)
    again = api.survey(m, flights[1], resume=kept)  # continued on this machine
    assert summary(again) == summary(whole)


def test_a_record_of_another_program_is_not_taken(flights: Flights) -> None:
    toml = flights[0] / "model.toml"
    asked = replace(make_job(toml.read_text(), toml), program=(("numpy", "1.0"),))
    record = examine(asked, str(flights[1][0]))
    assert "another version of the program" in record["error"]["message"]


@pytest.mark.parametrize("address", ["free", "127.0.0.1", "tcp://", "", "scheduler.json"])
def test_a_scheduler_that_is_not_there_is_one_message(
    flights: Flights, address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed", reason="Dask is an optional extra: pip install 'ragg[cluster]'")
    if address == "free":
        with socket.socket() as s:
            s.bind((HERE, 0))
            address = f"tcp://{HERE}:{s.getsockname()[1]}"
    monkeypatch.setattr(run, "PATIENCE", 1.0)
    with pytest.raises(UserError, match="cannot be reached"):
        api.survey(api.load(flights[0]), flights[1], scheduler=address)


def test_without_the_extra_it_is_one_message(flights: Flights, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(UserError, match=r"ragg\[cluster\]"):
        api.survey(api.load(flights[0]), flights[1], scheduler=f"tcp://{HERE}:8786")
