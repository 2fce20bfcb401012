"""The worked examples of CONTRIBUTING: each file does what is promised."""

from __future__ import annotations

import importlib
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from scipy import signal

import derive.effects
from derive import pipeline
from derive.symbols import MOTION
from generated import folded
from ragg_runtime.base.errors import UserError
from ragg_runtime.io import files
from ragg_runtime.report.plots import draw_plot
from ragg_runtime.wording.sections import render_html
from tests.generated import draws

TEXT = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text("utf-8")
T = np.linspace(0.0, 100.0, 60)


def body_of(path: str) -> str:
    """The example whose first line names this path."""
    (found,) = re.findall(rf"^```python\n(# {re.escape(path)}\n.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)
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
    chain: Any = ModuleType("derived")
    exec(compile(pipeline.derive_model(effects, ())["chain.py"], "chain.py", "exec"), chain.__dict__)
    draw = np.random.default_rng(1)
    inputs = dict(zip((c.name for c in MOTION), draws.motion(draw, len(T)), strict=True))
    inputs["humidity"] = np.full(len(T), 0.5)
    p = list(draws.instrument(draw))
    named = dict(folded.PARAMETERS)
    places = dict(zip(named, np.cumsum([0, *named.values()]), strict=False))
    for name in named.keys() & own.keys():
        p[places[name] : places[name] + 4] = [x + own[name] for x in p[places[name] : places[name] + 4]]
    for name, size in chain.PARAMETERS[len(named) :]:
        p += [own[name.rpartition("__")[2]]] * size
    phi = 2 * np.pi * 0.25 * T
    rows = np.stack([inputs[n] for n in chain.INPUTS])
    return np.asarray(chain.voltages(T, np.cos(phi), np.sin(phi), rows, np.array(p)))


def test_an_effect_is_one_file(effect: Any) -> None:
    assert effect.channels == ("humidity",)
    bias = 1e-6 * 9.8
    found = voltages((effect,), {"dK0_dh": bias})
    assert found == pytest.approx(voltages((), {"K0": 0.5 * bias}), rel=1e-12)
    assert not np.allclose(found, voltages((), {}), rtol=1e-9)


def test_a_file_format_is_a_function_and_a_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    read_rec = module_of("ragg_runtime/io/rec_file.py").read_rec
    monkeypatch.setitem(files.ENDINGS, ".rec", files.Format("rec", (".rec",), (), read_rec))
    rows = [f"{k / 16} " + " ".join(f"{x:.6f}" for x in np.sin(k + np.arange(7))) for k in range(800)]
    head = "# time a_x a_y a_z omega_x omega_y omega_z G_out\n# s g g g deg/h deg/h deg/h V\n"
    (tmp_path / "flight.rec").write_text(head + "\n".join(rows))
    flight = files.read_flight(tmp_path / "flight.rec", 9.8)
    assert (len(flight), flight.rate) == (800, 16.0)
    assert flight.channels["a_y"][3] == pytest.approx(9.8 * np.sin(4.0), abs=1e-5)
    (tmp_path / "flight.rec").write_text("1 2 3\n")
    with pytest.raises(UserError, match="header"):
        files.read_flight(tmp_path / "flight.rec", 9.8)


def test_a_target_is_a_package_with_four_functions(monkeypatch: pytest.MonkeyPatch) -> None:
    names = module_of("derive/emit/names/__init__.py")
    monkeypatch.setattr(pipeline, "targets", lambda: (names,))
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
    model = estimate_white([x[:5000], x[5000:]], 16.0)
    assert model.rms == pytest.approx(3.0, rel=0.02)
    assert np.std(signal.lfilter(model.whitening_filter(64), [1.0], x)) == pytest.approx(1.0, rel=0.02)
