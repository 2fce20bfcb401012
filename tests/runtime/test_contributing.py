"""The worked example of CONTRIBUTING: the file is written to where its first line says, and does what is promised."""

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

import derive.effects
from derive import pipeline
from derive.symbols import MOTION
from generated import folded
from tests.generated import draws

TEXT = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text("utf-8")
T = np.linspace(0.0, 100.0, 60)


@pytest.fixture
def effect(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The example, beside the files of the catalogue as far as Python is concerned."""
    (body,) = re.findall(
        r"^```python\n(# derive/effects/humidity_bias.py\n.*?)^```$", TEXT, re.MULTILINE | re.DOTALL
    )
    (tmp_path / "humidity_bias.py").write_text(body, "utf-8")
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
