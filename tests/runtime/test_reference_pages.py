"""What pages state is what the code has, reads and writes; commands and worked examples of the project work as they are typed."""

from __future__ import annotations

import ast
import importlib
import json
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import click
import numpy as np
import pyarrow.parquet as pq
import pytest
from commands import ragg
from scipy import signal

import derive.effects
from derive import emit, pipeline
from derive.symbols import MOTION
from docs import made
from generated import folded
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.series_name import series
from ragg_runtime.cli.main import COMMANDS, cli
from ragg_runtime.estimation.spectrum import Stretch
from ragg_runtime.identification.dictionary import list_generic
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import files
from ragg_runtime.model.model import load_files
from ragg_runtime.report import plots
from ragg_runtime.report.plots import draw_plot
from ragg_runtime.wording.sections import render_html
from tests.generated import draws

DISC = '[disc]\nradius = "0.1 m"\nspin_frequency = "0.25 Hz"\ng0 = "9.8 m/s^2"\n'
DISCS = '[[disc]]\nspin_frequency = "0.25 Hz"\n'
LAST = '[accelerometers]\nK1 = "10 mA/g"\nk_VI = "1e9 ohm"\n'
WITH_AN_UNKNOWN_KEY = {
    "Top level": "odd = 1",
    "[model]": "[model]\nodd = 1",
    "[model], order": "[model]\norder = { odd = 1 }",
    "[disc]": "[disc]\nodd = 1",
    "[[disc]]": f"{DISCS}odd = 1\n{LAST}",
    "[[disc.accelerometer]]": f"{DISCS}[[disc.accelerometer]]\nodd = 1\n{LAST}",
    "[accelerometers]": f"{DISC}[accelerometers]\nodd = 1",
    "[demodulator]": f"[demodulator]\nkind = 'causal'\nodd = 1\n{DISC}{LAST}",
}
"""Section of the page -> a model.toml that is refused, with the keys that are known there."""


@pytest.mark.parametrize("title", WITH_AN_UNKNOWN_KEY)
def test_the_page_of_model_toml_has_every_key_that_is_read_and_no_other(title: str) -> None:
    with pytest.raises(UserError, match="unknown key 'odd'") as refused:
        parse_instrument(WITH_AN_UNKNOWN_KEY[title])
    assert refused.value.expected is not None
    keys = set(str(refused.value.expected).removeprefix("one of ").split(", "))
    name, _, table = title.partition(", ")
    page = made.model_toml()
    listed = set(
        re.findall(r"^\| `([\w.]+)` ", page.split(f"## {name}\n", 1)[1].split("\n## ", 1)[0], re.MULTILINE)
    )
    if table:
        listed = {k.removeprefix(f"{table}.") for k in listed if k.startswith(f"{table}.")}
    elif name == "Top level":
        listed |= {t.strip("[]") for t in re.findall(r"^## (\[\w+\])$", page, re.MULTILINE)}
    else:
        listed = {k for k in listed if "." not in k}
    assert listed == keys


def test_the_page_of_json_has_every_command_that_writes_any_and_every_key_a_meaning() -> None:
    shown = {line.split()[0] for line in made.LINES} | {"compare", "diagnose", "add"}
    context = click.Context(cli)
    commands = {name: cli.get_command(context, name) for name in COMMANDS}
    assert {n for n, c in commands.items() if c and any(p.name == "json_file" for p in c.params)} == shown
    with pytest.raises(KeyError, match="odd of compare"):
        made.meaning("compare", "error.odd", made.read_meanings())


def test_the_json_of_commands_that_fit_nothing_has_meanings(tmp_path, monkeypatch) -> None:
    """Of the others the tests of these commands: ``commands.ragg`` looks up every key."""
    monkeypatch.chdir(tmp_path)
    pq.write_table(pq.read_table(made.FLIGHT).slice(0, 960), "flight.parquet")
    for line in (
        "new model",
        "effects",
        "effects lag",
        "info flight.parquet",
        "convert flight.parquet flight.csv",
        "simulate model -o simulated.parquet --duration 60",
        "add model bias-drift",
        "history model",
        "remove model bias-drift",
    ):
        done = ragg(*line.split(), "--json", "written.json")
        assert done.returncode == 0, line + done.stderr


ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")
SAMPLES = 2880
"""Three minutes of the shipped flight are enough for all that README shows."""


def block(heading: str) -> str:
    """The indented block of a section of README."""
    section = README.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    return "".join(f"{x}\n" for x in re.findall(r"^    (.*)$|^$", section, flags=re.MULTILINE)).strip()


SHELL, PYTHON = block("Step by step"), block("From Python")
"""The second is carried out in test_report.py."""


def put_flight(folder: Path) -> None:
    (folder / "examples").mkdir()
    pq.write_table(pq.read_table(made.FLIGHT).slice(0, SAMPLES), folder / "examples" / "demo-flight.parquet")


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """What the commands need of a fresh clone, and the folder where they run: the files that they name."""
    place = tmp_path_factory.mktemp("clone")
    put_flight(place)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(place)
        patch.setattr(plots, "draw_plot", lambda _: "<svg></svg>")  # test_report.py has figures
        yield place


@pytest.fixture(scope="module")
def said(clone: Path) -> dict[str, str]:
    """Each command of the block and what it printed, its JSON kept beside."""
    outputs = {}
    for line in SHELL.splitlines():
        program, command, *rest = shlex.split(line, comments=True)
        more = ["--json", f"{command}.json"] if command in ("compare", "diagnose", "add", "history") else []
        done = ragg(command, *rest, *more)
        assert (program, done.returncode) == ("ragg", 0), line + done.stderr
        outputs[command] = done.stdout
    return outputs


def test_the_commands_work_as_typed_and_print_the_next_one(said: dict[str, str], clone: Path) -> None:
    assert "NOT adequate" in said["compare"]
    assert "thermal-scale" in said["diagnose"]
    assert "the model is now adequate" in said["add"]
    assert "thermal-scale" in said["history"]
    for name in re.findall(r"(?:--report|-o) (\S+)", SHELL):
        assert (clone / name).stat().st_size > 1000, name
    assert (clone / "my-model-c" / "Makefile").exists()
    flight = "examples/demo-flight.parquet"
    assert f"next: ragg diagnose my-model {flight}" in said["compare"]
    assert f"next: ragg add my-model thermal-scale {flight}" in said["diagnose"]
    assert f"next: ragg calibrate my-model {flight} --save" in said["add"]


ERROR = {"rms_V", "rms_Eo", "inline_Eo", "cross_Eo", "inline_Eo_per_rtHz", "cross_Eo_per_rtHz"}
DIAGNOSIS = {"verdict", "ranking", "found", "not_testable", "unexplained"}
RANKED = {"effect", "p_value", "delta_bic", "error_before", "error_after", "error_after_holdout"}


def strict(text: str) -> Any:
    def refuse(name: str) -> None:
        raise AssertionError(f"{name} is not JSON")

    return json.loads(text, parse_constant=refuse)


def test_the_commands_speak_the_interface(said: dict[str, str], clone: Path) -> None:
    compared, diagnosed, added, history = (
        strict((clone / f"{n}.json").read_text()) for n in ("compare", "diagnose", "add", "history")
    )
    assert {"effects", "duration_s", "rate_Hz", "noise_floor", "where"} <= set(compared)
    assert (compared["adequate"], compared["samples"]) == (False, SAMPLES)
    assert all(set(compared["error"][k]) == ERROR for k in ("nominal", "calibrated", "holdout"))
    assert set(compared["where"]) == {"harmonics", "time", "motion"}
    assert {"harmonic", "term", "share"} <= set(compared["where"]["motion"][0])
    assert set(diagnosed) >= DIAGNOSIS
    assert (diagnosed["verdict"], diagnosed["found"]) == ("missing-effect", ["thermal-scale"])
    first = diagnosed["ranking"][0]
    assert set(first) >= RANKED
    assert set(first["parameters"][0]) == {"name", "accelerometer", "value", "std", "unit"}
    assert (clone / "diagnosis.html").read_text().startswith("<!")
    assert {"effect", "before", "after", "parameters"} <= set(added)
    assert added["after"]["calibrated"]["rms_Eo"] < 0.9 * added["before"]["calibrated"]["rms_Eo"]
    assert [s["action"] for s in history["steps"]] == ["new", "add"]


def test_a_process_of_its_own_sees_the_model_and_removing_makes_it_what_it_was(said, clone) -> None:
    flight = "examples/demo-flight.parquet"
    assert (clone / "my-model" / "generated" / "manifest.json").is_file()
    words = [sys.executable, "-m", "ragg_runtime", "compare", "my-model", flight, "--json", "-"]
    again = subprocess.run(words, capture_output=True, text=True, check=True, timeout=120)
    assert strict(again.stdout)["adequate"] is True
    refused = ragg("add", "my-model", "thermal-scale", flight)
    assert (refused.returncode, "already" in refused.stderr) == (2, True)
    assert ragg("remove", "my-model", "thermal-scale").returncode == 0
    assert ragg("new", "another").returncode == 0
    assert (clone / "my-model" / "model.toml").read_text() == (clone / "another" / "model.toml").read_text()
    assert not (clone / "my-model" / "generated").exists()


TEXT = (ROOT / "docs" / "explanation" / "formulas.md").read_text("utf-8")
MODULES = {p: p.read_text("utf-8") for p in sorted((ROOT / "ragg_runtime").rglob("*.py"))}


def _names() -> set[str]:
    """All names that the runtime's code defines or uses, attributes and parameters too."""
    names: set[str] = set()
    for text in MODULES.values():
        for node in ast.walk(ast.parse(text)):
            for field in ("id", "attr", "name", "arg"):
                value = getattr(node, field, None)
                if isinstance(value, str):
                    names.add(value)
    return names


def test_every_symbol_of_the_page_is_a_name_of_the_code() -> None:
    named = set(re.findall(r"\\mathtt\{([^}]+)\}", TEXT)) | set(re.findall(r"`([A-Za-z_.0-9\[\]]+)`", TEXT))
    symbols = {
        re.sub(r"\[\d\]", "", n.replace("\\_", "_")) for n in named if "/" not in n and not n.endswith(".py")
    }
    names = _names()
    assert len(symbols) > 40
    modules = {p.stem for p in MODULES}
    assert sorted(n for n in symbols if not set(n.split(".")) <= names | modules) == []


def test_every_file_of_the_page_is_there() -> None:
    places = set(re.findall(r"`((?:[a-z_]+/)*[a-z_0-9]+\.py)`", TEXT))
    assert len(places) > 12
    files = {p.relative_to(ROOT).as_posix() for p in MODULES}
    assert [p for p in sorted(places) if not any(f == p or f.endswith(f"/{p}") for f in files)] == []


def test_every_name_of_the_dictionary_is_printed_as_it_was_parsed() -> None:
    names = {n for product in list_generic(["temperature", "time"]) for n in product}
    assert len(names) > 50
    assert [str(series(n)) for n in sorted(names)] == sorted(names)


RECIPES = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text("utf-8")
TIMES = np.linspace(0.0, 100.0, 60)


def body_of(path: str) -> str:
    """The example whose first line names this path."""
    (body,) = re.findall(rf"^```python\n(# {re.escape(path)}\n.*?)^```$", RECIPES, re.MULTILINE | re.DOTALL)
    return str(body)


def module_of(path: str) -> ModuleType:
    """The example as a module."""
    module = ModuleType(Path(path).stem)
    exec(compile(body_of(path), path, "exec"), module.__dict__)
    return module


@pytest.fixture
def effect(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The example, beside the files of the catalogue as far as Python is concerned."""
    (tmp_path / "humidity_bias.py").write_text(body_of("derive/effects/humidity_bias.py"), "utf-8")
    monkeypatch.setattr(derive.effects, "__path__", [*derive.effects.__path__, str(tmp_path)])
    derive.effects.catalogue.cache_clear()
    importlib.invalidate_caches()
    yield next(e for e in derive.effects.catalogue() if e.id == "humidity-bias")
    sys.modules.pop("derive.effects.humidity_bias", None)
    delattr(derive.effects, "humidity_bias")
    derive.effects.catalogue.cache_clear()


def voltages(effects: tuple[Any, ...], changes: dict[str, float]) -> np.ndarray:
    """(4, N) V of one and the same flight, at a humidity of 0.5."""
    chain, draw = load_files(pipeline.derive_model(effects, ())).chain, np.random.default_rng(1)
    inputs = dict(zip((c.name for c in MOTION), draws.motion(draw, len(TIMES)), strict=True))
    inputs["humidity"] = np.full(len(TIMES), 0.5)
    p = np.zeros(chain.SIZE)
    p[: folded.SIZE] = draws.instrument(draw)
    for name, value in changes.items():
        p[chain.places[name]] += value
    return chain.voltages(TIMES, [inputs[n] for n in chain.INPUTS], p)


def test_an_effect_is_one_file(effect: Any) -> None:
    assert effect.channels == ("humidity",)
    bias = 1e-6 * 9.8
    volts = voltages((effect,), {"humidity_bias__dK0_dh": bias})
    assert volts == pytest.approx(voltages((), {"K0": 0.5 * bias}), rel=1e-12)
    assert not np.allclose(volts, voltages((), {}), rtol=1e-9)


def test_a_file_format_is_a_function_and_a_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    read_rec = module_of("ragg_runtime/io/rec_file.py").read_rec
    monkeypatch.setitem(files.ENDINGS, ".rec", files.Format("rec", (".rec",), read_rec))
    rows = [f"{k / 16} " + " ".join(f"{x:.6f}" for x in np.sin(k + np.arange(7))) for k in range(800)]
    head = "# time a_x a_y a_z omega_x omega_y omega_z G_out\n# s g g g deg/h deg/h deg/h V\n"
    (tmp_path / "flight.rec").write_text(head + "\n".join(rows))
    flight = files.read_flight(tmp_path / "flight.rec", 9.8)
    assert (len(flight), flight.rate) == (800, 16.0)
    assert flight.channels["a_y"][3] == pytest.approx(9.8 * np.sin(4.0), abs=1e-5)
    (tmp_path / "flight.rec").write_text("1 2 3\n")
    with pytest.raises(UserError, match="header"):
        files.read_flight(tmp_path / "flight.rec", 9.8)


def test_a_target_is_a_package_with_a_function_for_each_form(monkeypatch: pytest.MonkeyPatch) -> None:
    names = module_of("derive/emit/names/__init__.py")
    monkeypatch.setattr(emit, "targets", lambda: (names,))
    table = pipeline.derive_model((), ())["names/chain.csv"].splitlines()
    assert table[0] == "kind,name,values"
    assert {"input,a_x,1", "parameter,K1,4", "parameter,radius,1"} <= set(table)


def test_a_panel_is_a_function_that_returns_a_section() -> None:
    panel = module_of("ragg_runtime/report/against.py").describe_against
    x = np.linspace(0.0, 2.0, 400)
    section = panel(x, 3.0 * x, "temperature")
    assert "changes by 5.7 Eo" in section.sentences[0]
    assert "<svg" in render_html([section], draw_plot)


def test_a_noise_model_is_a_function_from_residuals_to_a_density() -> None:
    estimate_white = module_of("ragg_runtime/estimation/white.py").estimate_white
    x = 3.0 * np.random.default_rng(1).standard_normal(20_000)
    model = estimate_white([Stretch(x[:5000], 16.0), Stretch(x[5000:], 16.0)])
    assert model.rms == pytest.approx(3.0, rel=0.02)
    assert np.std(signal.lfilter(model.whitening_filter(64), [1.0], x)) == pytest.approx(1.0, rel=0.02)
