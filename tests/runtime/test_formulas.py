"""What pages and lists of the project state is what its code has; the worked examples of CONTRIBUTING do what is promised."""

from __future__ import annotations

import ast
import importlib
import re
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from scipy import signal

import derive.effects
from derive import emit, pipeline
from derive.symbols import MOTION
from generated import folded
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.series_name import ChannelName, Derivative, Function, Relaxation, harmonic, series
from ragg_runtime.estimation.spectrum import Stretch
from ragg_runtime.identification.dictionary import list_generic, list_harmonics
from ragg_runtime.io import files
from ragg_runtime.model.model import load_files
from ragg_runtime.report.plots import draw_plot
from ragg_runtime.wording.sections import render_html
from tests.generated import draws

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs" / "explanation" / "formulas.md").read_text("utf-8")
PYTHON = {p: p.read_text("utf-8") for p in sorted((ROOT / "ragg_runtime").rglob("*.py"))}


def _names() -> set[str]:
    """All names that the runtime's code defines or uses, attributes and parameters too."""
    found: set[str] = set()
    for text in PYTHON.values():
        for node in ast.walk(ast.parse(text)):
            for field in ("id", "attr", "name", "arg"):
                value = getattr(node, field, None)
                if isinstance(value, str):
                    found.add(value)
    return found


def test_every_symbol_of_the_page_is_a_name_of_the_code() -> None:
    named = set(re.findall(r"\\mathtt\{([^}]+)\}", TEXT)) | set(re.findall(r"`([A-Za-z_.0-9\[\]]+)`", TEXT))
    own = {
        re.sub(r"\[\d\]", "", n.replace("\\_", "_")) for n in named if "/" not in n and not n.endswith(".py")
    }
    known = _names()
    assert len(own) > 40
    modules = {p.stem for p in PYTHON}
    assert sorted(n for n in own if not set(n.split(".")) <= known | modules) == []


def test_every_file_of_the_page_is_there() -> None:
    places = set(re.findall(r"`((?:[a-z_]+/)*[a-z_0-9]+\.py)`", TEXT))
    assert len(places) > 12
    files = {p.relative_to(ROOT).as_posix() for p in PYTHON}
    assert [p for p in sorted(places) if not any(f == p or f.endswith(f"/{p}") for f in files)] == []


def test_every_name_of_the_dictionary_is_printed_as_it_was_parsed() -> None:
    names = {n for product in list_generic(["temperature", "time"]) for n in product}
    assert len(names) > 50
    assert [str(series(n)) for n in sorted(names)] == sorted(names)
    assert [str(harmonic(h)) for h in list_harmonics()] == list(list_harmonics())


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("d2_a_x", Derivative(ChannelName("a_x"), 2)),
        ("abs(d_f_i)", Function("abs", Derivative(ChannelName("f_i"), 1))),
        ("slow(square(a_z), 20 s)", Relaxation(Function("square", ChannelName("a_z")), "20")),
        ("slow(a_z)", ChannelName("slow(a_z)")),
        ("abs(a", ChannelName("abs(a")),
    ],
)
def test_names_are_read(text: str, expected: object) -> None:
    assert series(text) == expected


def test_a_recorded_channel_stands_for_itself_whatever_its_name() -> None:
    assert series("d_x") == Derivative(ChannelName("x"), 1)
    assert series("d_x", {"d_x"}) == ChannelName("d_x")
    assert series("abs(d_x)", {"d_x"}) == Function("abs", ChannelName("d_x"))


VENDOR = ROOT / "ragg_runtime" / "studio" / "static" / "vendor"


def test_every_vendored_file_is_listed_with_its_licence() -> None:
    listed = tomllib.loads((VENDOR / "vendored.toml").read_text("utf-8"))["component"]
    named = {name for c in listed for name in (*c["files"], c["licence_file"])}
    assert {p.name for p in VENDOR.iterdir()} == named | {"vendored.toml"}
    for c in listed:
        assert c["version"] in (VENDOR / c["files"][0]).read_text("utf-8")[:400]
        assert (VENDOR / c["licence_file"]).stat().st_size > 500


RECIPES = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text("utf-8")
TIMES = np.linspace(0.0, 100.0, 60)


def body_of(path: str) -> str:
    """The example whose first line names this path."""
    (found,) = re.findall(rf"^```python\n(# {re.escape(path)}\n.*?)^```$", RECIPES, re.MULTILINE | re.DOTALL)
    return str(found)


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


def voltages(effects: tuple[Any, ...], own: dict[str, float]) -> np.ndarray:
    """(4, N) V of one and the same flight, at a humidity of 0.5."""
    chain, draw = load_files(pipeline.derive_model(effects, ())).chain, np.random.default_rng(1)
    inputs = dict(zip((c.name for c in MOTION), draws.motion(draw, len(TIMES)), strict=True))
    inputs["humidity"] = np.full(len(TIMES), 0.5)
    p = np.zeros(chain.SIZE)
    p[: folded.SIZE] = draws.instrument(draw)
    for name, value in own.items():
        p[chain.places[name]] += value
    return chain.voltages(TIMES, [inputs[n] for n in chain.INPUTS], p)


def test_an_effect_is_one_file(effect: Any) -> None:
    assert effect.channels == ("humidity",)
    bias = 1e-6 * 9.8
    found = voltages((effect,), {"humidity_bias__dK0_dh": bias})
    assert found == pytest.approx(voltages((), {"K0": 0.5 * bias}), rel=1e-12)
    assert not np.allclose(found, voltages((), {}), rtol=1e-9)


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
