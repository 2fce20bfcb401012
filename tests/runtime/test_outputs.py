"""What commands say and write: one message whatever goes wrong, never over what they read, with what made it, in the same bytes."""

from __future__ import annotations

import hashlib
import io
import json
import os
import re
import shlex
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import click
import commands
import numpy as np
import pytest

from benchmarks.diagnosis.plan import model_text
from ragg_runtime import api
from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import COMMANDS, cli, main
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.report.pages import draw_figure
from ragg_runtime.screening import timing
from ragg_runtime.simulate import simulate_flight
from ragg_runtime.wording.sections import Bar, Bars
from tests.simulated import RATE

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="devices, links and pipes of Unix")


@pytest.fixture(scope="module")
def given(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """A model directory with an effect, and a flight of 150 s."""
    place = tmp_path_factory.mktemp("outputs")
    m = api.new(place / "model")
    flight = simulate_flight(m.instrument, [], seed=3, duration=150.0, rate=8.0)
    write_flight(flight, place / "flight.parquet")
    api.add(m, "thermal-scale")
    return place / "model", place / "flight.parquet"


def state(*places: Path) -> dict[str, bytes]:
    files = [p for x in places for p in ((x,) if x.is_file() else sorted(x.rglob("*"))) if p.is_file()]
    return {str(p): p.read_bytes() for p in files}


def ragg(*arguments: object, redirect: str = "") -> tuple[int, str]:
    """Exit status and stderr of a command, its output redirected by a shell if that is asked for."""
    done: subprocess.CompletedProcess[str]
    if redirect:
        line = ["sh", "-c", f'exec "$0" -m ragg_runtime "$@" {redirect}', sys.executable]
        done = subprocess.run([*line, *map(str, arguments)], capture_output=True, text=True)
    else:
        done = commands.ragg(*arguments)
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stderr


@pytest.mark.parametrize("how", ["report", "json", "stdout full", "json full"])
def test_a_result_that_cannot_be_written_leaves_the_model_as_it_was(how, given, tmp_path) -> None:
    model, flight = given
    before = state(model, flight)
    nowhere = tmp_path / "nowhere"
    further: dict[str, tuple[list[object], str]] = {
        "report": (["--report", nowhere / "r.html"], ""),
        "json": (["--json", nowhere / "r.json"], ""),
        "stdout full": ([], "> /dev/full"),
        "json full": (["--json", "/dev/full"], ""),
    }
    arguments, redirect = further[how]
    command = ["add", model, "odd-quadratic", flight]
    if how != "report":
        command = ["remove", model, "thermal-scale"]
    status, said = ragg(*command, *arguments, redirect=redirect)
    assert status == 2, said
    assert said.count("ragg:") == 1
    assert state(model, flight) == before
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_written_over_what_is_read(given, tmp_path) -> None:
    model, flight = given
    (tmp_path / "sheet.csv").symlink_to(model / "model.toml")
    files = [model / n for n in ("model.toml", "history.json", "calibration.json", "mapping.toml")]
    compare = ("compare", model, flight)
    cases: list[tuple[object, ...]] = [
        *((*compare, "--json", f) for f in (*files, flight)),
        ("compensate", model, flight, "-o", flight),
        ("simulate", model, "--motion", flight, "-o", flight),
        ("simulate", model, "-o", tmp_path / "sheet.csv"),
    ]
    before = state(model, flight)
    for words in cases:
        status, said = ragg(*words)
        assert (status, "would overwrite what the command reads" in said) == (2, True), (words, said)
        assert state(model, flight) == before


def test_devices_and_pipes(given: tuple[Path, Path], tmp_path: Path) -> None:
    model, _ = given
    assert ragg("history", model, "--json", "/dev/null")[0] == 0
    assert Path("/dev/null").is_char_device()
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    read: list[str] = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_text()), daemon=True)
    reader.start()
    assert ragg("history", model, "--json", pipe)[0] == 0
    reader.join(10)
    assert [s["action"] for s in json.loads(read[0])["steps"]] == ["new", "add"]
    assert pipe.is_fifo()
    out = tmp_path / "out"
    assert ragg("history", model, "--json", "/dev/stdout", redirect=f"> {out}")[0] == 0
    assert json.loads(out.read_text())["steps"]


DAY = re.compile(r"20\d\d-\d\d-\d\d")


def json_of(arguments: Sequence[str], folder: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Any, str]:
    monkeypatch.chdir(folder)
    monkeypatch.setattr(sys, "argv", ["ragg", *arguments, "--json", "result.json"])
    main(sys.argv[1:])
    text = (folder / "result.json").read_text("utf-8")
    return json.loads(text), text


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_a_result_names_what_made_it(given, monkeypatch) -> None:
    place, arguments = given[0].parent, ["compare", "model", "flight.parquet"]
    found, text = json_of(arguments, place, monkeypatch)
    made = found["provenance"]
    assert made["python"] == "{}.{}.{}".format(*sys.version_info)
    assert [made[n] for n in ("numpy", "scipy", "sympy")] == [version(n) for n in ("numpy", "scipy", "sympy")]
    assert made["command"] == shlex.join(["ragg", *arguments, "--json", "result.json"])
    assert (made["model"], made["model_digest"]) == ("model", sha256(place / "model" / "model.toml"))
    assert made["flights"] == [{"path": "flight.parquet", "digest": sha256(place / "flight.parquet")}]
    assert not DAY.search(text), "a result of today is no other than one of tomorrow"
    assert json_of(arguments, place, monkeypatch)[1] == text


def test_a_change_names_the_state_before_and_after(monkeypatch, tmp_path) -> None:
    api.new(tmp_path / "model")
    toml = tmp_path / "model" / "model.toml"
    digests = [sha256(toml)]
    for arguments in (["add", "model", "lag"], ["remove", "model", "lag"]):
        provenance = json_of(arguments, tmp_path, monkeypatch)[0]["provenance"]
        digests.append(sha256(toml))
        assert [provenance["model_digest_before"], provenance["model_digest"]] == digests[-2:]
    assert digests[0] == digests[2] != digests[1]


def test_the_same_result_on_any_number_of_threads(given, monkeypatch) -> None:
    """BLAS splits sums by the number of its threads; the verdict and the figures must not notice. ``make test`` has one."""
    words = ["diagnose", "model", "flight.parquet", "--json", "result.json"]
    place, threads = given[0].parent, {"OPENBLAS_NUM_THREADS": "2", "OMP_NUM_THREADS": "2"}
    results = [json_of(words[:3], place, monkeypatch)[1]]
    program = [sys.executable, "-m", "ragg_runtime"]
    subprocess.run([*program, *words], cwd=place, env=os.environ | threads, capture_output=True, check=True)
    results.append((place / "result.json").read_text("utf-8"))
    if np.lib.NumpyVersion(np.__version__) >= "2.0.0":
        assert results[0] == results[1]
    else:  # BLAS of that time: sums depend on where in memory their terms lie
        first, second = (json.loads(r) for r in results)
        assert (first["verdict"], first["found"]) == (second["verdict"], second["found"])
        errors = [[r["error_after"]["rms_Eo"] for r in x["ranking"]] for x in (first, second)]
        np.testing.assert_allclose(errors[0], errors[1], rtol=1e-3)


# --- one message ---


def refused(*words: object, capsys: pytest.CaptureFixture[str]) -> str:
    """What a command that ends with status 2 says."""
    with pytest.raises(SystemExit) as end:
        main(list(map(str, words)))
    assert end.value.code == 2
    return capsys.readouterr().err


def test_every_refusal_of_the_system_names_its_place(given, capsys, monkeypatch) -> None:
    def refuses(*_: object) -> None:
        raise OSError(40, "Too many levels of symbolic links", "/some\n/where")

    monkeypatch.setattr(api, "load", refuses)
    message = refused("compare", given[0], "f.csv", capsys=capsys)
    assert message == "ragg: /some\\n/where: Too many levels of symbolic links\n"


def test_a_missing_extra_ends_in_what_to_install(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.setitem(sys.modules, "h5py", None)
    (tmp_path / "flight.h5").write_bytes(b"\x89HDF\r\n\x1a\n")
    message = refused("convert", tmp_path / "flight.h5", tmp_path / "flight.csv", capsys=capsys)
    assert "pip install 'ragg[files]'" in message


def test_without_matplotlib_a_page_names_the_extra_where_a_figure_would_be(monkeypatch) -> None:
    for name in [n for n in sys.modules if n.startswith(("matplotlib", "ragg_runtime.report.plots"))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert "ragg[plots]" in draw_figure(Bars("b", "caption", (Bar("x", 1.0),), "axis"))


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (lambda p: (os.mkfifo(p / "pipe"), api.new(p / "m", p / "pipe")), "not a pipe or a device"),
        (lambda p: api.new(p / "m", Path("/dev/zero")), "not a pipe or a device"),
    ],
)
def test_what_never_ends_is_refused(asked, said: str, tmp_path: Path) -> None:
    with pytest.raises(UserError, match=said):
        asked(tmp_path)


def test_a_bar_never_reaches_its_end_before_the_work_does(monkeypatch: pytest.MonkeyPatch) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with progress.show_progress("diagnosing", "diagnose", 1000):
        for _ in range(30):
            progress.step(progress.PASSES["diagnose"] * 100.0)
    shares = [int(x) for x in re.findall(r"(\d+)%", terminal.getvalue())]
    assert max(shares) < 99
    progress.step(1.0)  # nobody listens any more


def test_no_summary_is_cut_off() -> None:
    context = click.Context(cli)
    for name in COMMANDS:
        command = cli.get_command(context, name)
        assert command is not None
        assert command.get_short_help_str(1000) == command.get_short_help_str(60), name
    shown = cli.get_help(context)
    assert "\n  derive " not in shown
    assert [x for x in ("Model:", "Flights:", "After:", "Tools:") if x not in shown] == []


Change = Callable[[np.ndarray], np.ndarray]


@cache
def good(duration: float = 200.0, rate: float = RATE) -> Scenario:
    return scenario(48, duration=duration, rate=rate)


# --- bad and awkward inputs that users meet ---


@pytest.fixture
def good_model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
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


@pytest.mark.usefixtures("good_model")
@pytest.mark.parametrize("name", TABLE)
def test_bad_input_is_one_message_and_changes_nothing(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    make, flights, facts = TABLE[name]
    if "time" not in name:  # no mistake of time is looked for, which takes most of the search
        monkeypatch.setattr(timing, "propose_times", lambda *_: [])
    make()
    before = {p: p.read_bytes() for p in Path("model").rglob("*") if p.is_file()}
    done = commands.ragg("compare", "model", *flights.split())
    message = "\n".join(x for x in done.stderr.splitlines() if not x.startswith("... "))  # without progress
    assert (done.returncode, done.stdout) == (2, "")
    assert [f for f in facts if f not in message] == [], message
    assert len(re.findall(r"^(ragg: |Usage: )", message, re.MULTILINE)) == 1 and "Traceback" not in message
    assert len(message) < 3000
    assert {p: p.read_bytes() for p in Path("model").rglob("*") if p.is_file()} == before


@pytest.mark.usefixtures("good_model")
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
