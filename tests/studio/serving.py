"""The real command, started as a user starts it, for tests that talk to it."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq

DEMO = Path(__file__).parents[2] / "examples" / "demo-flight.parquet"
BRIEF = np.arange(0, 2 * 60 * 16, 2)
"""Rows of the flight, which pass for two minutes at 8 Hz."""
PATIENCE = 120.0  # s; a busy machine is no failure


@dataclass
class Served:
    """A server: its address with the token, and the process."""

    address: str
    process: subprocess.Popen[str]
    exchanged: httpx.Response | None = None

    @property
    def origin(self) -> str:
        return self.address.split("/?")[0]

    @property
    def port(self) -> int:
        return int(self.origin.rsplit(":", 1)[1])

    @contextmanager
    def client(self) -> Iterator[httpx.Client]:
        """One that has exchanged the token for the cookie."""
        with httpx.Client(base_url=self.origin, timeout=PATIENCE, headers={"origin": self.origin}) as c:
            self.exchanged = c.get(self.address.removeprefix(self.origin))
            assert self.exchanged.status_code == 303
            yield c


def brief(flight: Path, start: int = 0) -> None:
    """Two minutes of every other row of the shipped flight: for what is about the server, not about the flight."""
    pq.write_table(pq.read_table(DEMO).take(BRIEF + start), flight)


def foreign(path: Path) -> None:
    """Two minutes of it as a company might hand them over: other names, and no unit of the accelerations."""
    names = {"time": "GPSTIME [s]", "G_out": "SUM [V]"}
    names |= {f"a_{k}": f"ACC_{k.upper()}" for k in "xyz"} | {
        f"omega_{k}": f"gyro_{k} [rad/s]" for k in "xyz"
    }
    table = pq.read_table(DEMO, columns=list(names)).take(BRIEF)
    pa.csv.write_csv(table.rename_columns(list(names.values())), path)


@contextmanager
def served(*arguments: object, browser: str = "") -> Iterator[Served]:
    """``browser``: as the environment's variable; none is opened without."""
    further = [] if browser else ["--no-browser"]
    process = subprocess.Popen(
        [sys.executable, "-m", "ragg_runtime", "studio", *map(str, arguments), *further],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1", "BROWSER": browser},
    )
    assert process.stdout is not None
    assert process.stderr is not None
    try:
        line = process.stdout.readline()
        assert re.fullmatch(r"http://127\.0\.0\.1:\d+/\?token=[\w-]{40,}\n", line), process.stderr.read()
        yield Served(line.strip(), process)
    finally:
        if process.poll() is None:  # else a test has killed it
            process.send_signal(signal.SIGINT)  # as a user ends it: no failure
            assert process.wait(60) == 0, process.stderr.read()
        process.stdout.close()
        process.stderr.close()


def wait_for(client: httpx.Client, done: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        state: dict[str, Any] = client.get("/api/state").json()
        if done(state):
            return state
        time.sleep(0.1)
    raise AssertionError("the server does not come to an end")


def settled(client: httpx.Client, *, diagnosed: bool = True) -> dict[str, Any]:
    """The state once nothing is being worked on."""
    return wait_for(
        client,
        lambda s: not s["status"]["job"] and (not diagnosed or bool(s["effects"] or s["status"]["error"])),
    )


def compared(client: httpx.Client, what: str = "error") -> dict[str, Any]:
    """The state once the flights are compared; the tests of the effects, which take most of the time, are cancelled."""
    wait_for(client, lambda s: bool(s[what]) or not s["status"]["job"])
    client.post("/api/do/cancel", json={})
    return settled(client, diagnosed=False)
