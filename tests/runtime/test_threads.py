"""The same figures, to the byte, however many threads the work is divided among."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping

import pytest

from ragg_runtime.base.process import ONE_THREAD
from ragg_runtime.base.threads import VARIABLE
from ragg_runtime.fit import passes, prepared_flight
from ragg_runtime.flight import Flight
from ragg_runtime.reference.scenario import Scenario, scenario
from tests.rate import RATE
from tests.runtime.diagnosed import diagnosed

Hidden = Mapping[str, Mapping[str, object]]


def _as_json(s: Scenario, flight: Flight, threads: int, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.setenv(VARIABLE, str(threads))
    return json.dumps(diagnosed(s, flight).as_json())


@pytest.mark.parametrize(
    ("hidden", "rows", "known"),
    [
        pytest.param({"bias-step": {"dK0": [3e-8, 0, 0, 0], "t_step": 300.0}}, 30000, True, id="step"),
        pytest.param({"thermal-scale": {"dK1_dT": [0, 0, 2e-7, 0]}}, 850, True, id="segments"),
        pytest.param({"thermal-scale": {"dK1_dT": [0, 0, 2e-7, 0]}}, 30000, False, id="unknown gradient"),
    ],
)
def test_figures_do_not_know_how_many_threads_there_were(
    hidden: Hidden, rows: int, known: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    s = scenario(61, duration=600.0, rate=RATE)
    flight = s.simulate(hidden, record_gradient=known).flight()
    for module in (passes, prepared_flight):
        monkeypatch.setattr(module, "ROWS", rows)
    one, two = (_as_json(s, flight, threads, monkeypatch) for threads in (1, 2))
    assert next(iter(hidden)) in json.loads(one)["found"]
    assert one == two


def test_a_command_starts_no_threads_of_linear_algebra_and_keeps_what_its_user_says() -> None:
    program = (
        "import os, sys; from ragg_runtime.cli.main import main\n"
        "assert 'numpy' not in sys.modules\n"
        "try: main(['--version'])\n"
        "except SystemExit: pass\n"
        "import threadpoolctl, ragg_runtime.base.threads\n"
        "print(*{x['num_threads'] for x in threadpoolctl.threadpool_info() if x['user_api'] == 'blas'})"
    )
    own = {name: x for name, x in os.environ.items() if name not in ONE_THREAD}
    two = str(min(2, os.cpu_count() or 1))
    for said, threads in (({}, "1"), ({"OPENBLAS_NUM_THREADS": "2"}, two)):
        done = subprocess.run(
            [sys.executable, "-c", program], env=own | said, capture_output=True, text=True, check=True
        )
        assert done.stdout.splitlines()[-1] == threads
