"""Bad and awkward inputs that users meet: exit status, one message with its facts, nothing changed."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from commands import ragg

from benchmarks.diagnosis.plan import model_text
from ragg_runtime import api
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.screening import timing
from tests.rate import RATE

Change = Callable[[np.ndarray], np.ndarray]


@cache
def good(duration: float = 200.0, rate: float = RATE) -> Scenario:
    return scenario(48, duration=duration, rate=rate)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A good model directory in the current folder."""
    monkeypatch.chdir(tmp_path)
    Path("sheet.toml").write_text(model_text(good().sheet))
    api.new("model", "sheet.toml")


def fly(name: str = "flight.csv", outputs: Change | None = None, lacking: str = "no channel") -> None:
    x = good().simulate().flight()
    kept = {n: v for n, v in x.channels.items() if n != lacking}
    write_flight(
        replace(x, channels=kept, outputs={n: (outputs or np.array)(v) for n, v in x.outputs.items()}), name
    )


def cut_out() -> None:
    x = good().simulate().flight().part(slice(37, None))
    write_flight(replace(x, time=x.time - x.time[0], began=None), "flight.csv")


def exchange() -> None:
    x = good().simulate().flight(voltages=True)
    order = {"V_1": "V_1", "V_2": "V_3", "V_3": "V_2", "V_4": "V_4"}
    write_flight(replace(x, outputs={n: x.outputs[o] for n, o in order.items()}), "flight.csv")


def ask_for(effect: str) -> None:
    path = Path("model/model.toml")
    path.write_text(re.sub(r"(?m)^effects = .*$", f'effects = ["{effect}"]', path.read_text()))
    fly(lacking="temperature")


def two_flights() -> None:
    fly()
    fly("second.csv", lambda v: -v)


TABLE: Mapping[str, tuple[Callable[[], object], str, tuple[str, ...]]] = {
    "an unknown effect": (lambda: ask_for("thermal-scal"), "flight.csv", ("did you mean", "thermal-scale")),
    "an effect whose channel the flight lacks": (
        lambda: ask_for("thermal-scale"), "flight.csv", ("thermal-scale", "temperature", "flight.csv", "ragg remove"),
    ),
    "a pipe": (lambda: os.mkfifo("p.csv"), "p.csv", ("p.csv", "regular file")),
    "cut out, its time set to zero": (cut_out, "flight.csv", ("likely mistake", "cut out", "spin_angle")),
    "an output that does not change": (
        lambda: fly(outputs=lambda v: np.full_like(v, 1.5)), "flight.csv", ("'G_out'", "does not change", "disconnected"),
    ),
    "V_2 and V_3 exchanged": (exchange, "flight.csv", ("likely mistake", "V_2 and V_3 are exchanged")),
    "the second of two flights": (
        two_flights, "flight.csv second.csv", ("second.csv", "likely mistake", "the sign of G_out is reversed", "-1"),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", TABLE)
def test_bad_input_is_one_message_and_changes_nothing(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    make, flights, facts = TABLE[name]
    if "time" not in name:  # no mistake of time is looked for, which takes most of the search
        monkeypatch.setattr(timing, "propose_times", lambda *_: [])
    make()
    before = {p: p.read_bytes() for p in Path("model").rglob("*") if p.is_file()}
    done = ragg("compare", "model", *flights.split())
    said = "\n".join(x for x in done.stderr.splitlines() if not x.startswith("... "))  # without progress
    assert (done.returncode, done.stdout) == (2, "")
    assert [f for f in facts if f not in said] == [], said
    assert len(re.findall(r"^(ragg: |Usage: )", said, re.MULTILINE)) == 1 and "Traceback" not in said
    assert len(said) < 3000
    assert {p: p.read_bytes() for p in Path("model").rglob("*") if p.is_file()} == before


def test_the_hidden_effect_is_found_beside_spikes_and_blanks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Spikes in one sample of a hundred, and gaps in the motion alone."""
    monkeypatch.setattr(timing, "propose_times", lambda *_: [])
    x: Flight = good(300.0, 16.0).simulate({"thermal-scale": {"dK1_dT": [0.0, 0.0, 2e-7, 0.0]}}).flight()
    rng, blank = np.random.default_rng(7), (np.arange(len(x)) // 100) % 12 == 5
    size, hit = 5 * np.std(x.outputs["G_out"]) * rng.choice([-1.0, 1.0], len(x)), rng.random(len(x)) < 0.01
    motion = {n: np.where(blank, np.nan, v) for n, v in x.channels.items() if re.match("a_|omega_", n)}
    channels = {n: v for n, v in x.channels.items() if "dot" not in n} | motion
    write_flight(
        replace(x, channels=channels, outputs={"G_out": x.outputs["G_out"] + size * hit}), "flight.parquet"
    )
    m = api.load("model")
    d = api.diagnose(m, api.read_flights(m, ["flight.parquet"]))
    assert (d.verdict, d.found) == ("missing-effect", ("thermal-scale",))
    assert d.after.rms_Eo == pytest.approx(4.04, rel=0.02)  # the noise, as on the clean record
    value = {p.accelerometer: p.value for p in d.ranking[0].parameters}
    assert value[3] - value[4] == pytest.approx(2e-7, rel=0.02)  # what G_out sees of A3 and A4
