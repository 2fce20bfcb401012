"""The worked examples of CONTRIBUTING, carried out: each file is written to where its first line says, and does what is promised."""

from __future__ import annotations

import importlib
import json
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import derive.effects
import derive.emit
import ragg_runtime.flight
import ragg_runtime.report.panel
from derive import pipeline
from derive.emit import target
from derive.symbols import MOTION
from generated import folded
from ragg_runtime.base.errors import UserError
from ragg_runtime.diagnosis.comparison import compare
from ragg_runtime.evidence.random_effects import Variance
from ragg_runtime.flight import formats
from ragg_runtime.flight.convert import convert
from ragg_runtime.flight.source import Column, Look, Written
from ragg_runtime.model.model import from_files, packaged
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.report import panel
from ragg_runtime.report.compare_page import compare_html
from tests.generated import draws

TEXT = (Path(__file__).parents[2] / "CONTRIBUTING.md").read_text("utf-8")
EXAMPLES = {
    path: body
    for body in re.findall(r"^```(?:python|jinja)\n(.*?)^```$", TEXT, flags=re.MULTILINE | re.DOTALL)
    for path in re.findall(r"\A(?:# |{# )(\S+)", body)
}

Put = Callable[[str, ModuleType], ModuleType]


@pytest.fixture
def put(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Put]:
    """Write an example beside the files of its package, as far as Python is concerned, and import it."""
    caches = (derive.effects.catalogue, target.targets, panel.files)
    made: list[str] = []

    def put(path: str, package: ModuleType) -> ModuleType:
        """The files of CONTRIBUTING at ``path`` (a file or a folder), in ``package``."""
        folder = Path(*package.__name__.split("."))
        for name, body in EXAMPLES.items():
            if name == path or Path(path) in Path(name).parents:
                place = tmp_path / Path(name).relative_to(folder)
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_text(body, "utf-8")
        monkeypatch.setattr(package, "__path__", [*package.__path__, str(tmp_path)])
        made.append(f"{package.__name__}.{Path(path).stem}")
        for c in caches:
            c.cache_clear()
        importlib.invalidate_caches()
        return importlib.import_module(made[-1])

    yield put
    for name in made:
        sys.modules.pop(name, None)
        package, _, own = name.rpartition(".")
        delattr(sys.modules[package], own)
    for c in caches:
        c.cache_clear()


def test_every_kind_of_thing_has_an_example() -> None:
    assert sorted(EXAMPLES) == [
        "derive/effects/gain_noise.py",
        "derive/effects/humidity_bias.py",
        "derive/effects/misalignment_step.py",
        "derive/effects/stuck_output.py",
        "derive/emit/micropython/__init__.py",
        "derive/emit/micropython/templates/folded.py.j2",
        "ragg_runtime/flight/json_file.py",
        "ragg_runtime/report/panel/largest_residual.py",
    ]


def _run(text: str) -> Any:
    made = ModuleType("derived")
    exec(compile(text, "derived.py", "exec"), made.__dict__)
    return made


SAMPLES = 60
T = np.linspace(0.0, 100.0, SAMPLES)


def _arguments(chain: Any, own: dict[str, float], humidity: float = 0.5) -> tuple[np.ndarray, ...]:
    """Time, cosine and sine of the disc angle, inputs and parameters: one and the same flight, some parameters changed."""
    draw = np.random.default_rng(1)
    inputs = dict(zip((c.name for c in MOTION), draws.motion(draw, SAMPLES), strict=True))
    inputs["humidity"] = np.full(SAMPLES, humidity)
    p = list(draws.instrument(draw))
    named = dict(folded.PARAMETERS)
    places = dict(zip(named, np.cumsum([0, *named.values()]), strict=False))
    for name, value in own.items():
        if name in places:
            p[places[name] : places[name] + 4] = [x + value for x in p[places[name] : places[name] + 4]]
    for name, size in chain.PARAMETERS[len(named) :]:
        p += [own.get(name.rpartition("__")[2], 0.0)] * size
    phi = 2 * np.pi * 0.25 * T
    return T, np.cos(phi), np.sin(phi), np.stack([inputs[n] for n in chain.INPUTS]), np.array(p)


def _voltages(chain: Any, own: dict[str, float], humidity: float = 0.5) -> np.ndarray:
    """(4, N) V."""
    return np.asarray(chain.voltages(*_arguments(chain, own, humidity)))


BASE = _run(pipeline.derive_model((), ())["chain.py"])


def _added(put: Put, name: str) -> tuple[Any, Any]:
    """An effect of the catalogue that one file made, and the chain with it."""
    put(f"derive/effects/{name.replace('-', '_')}.py", derive.effects)
    effect = next(e for e in derive.effects.catalogue() if e.id == name)
    return effect, _run(pipeline.derive_model((effect,), ())["chain.py"])


def test_a_deterministic_effect_is_one_file(put: Put) -> None:
    effect, chain = _added(put, "humidity-bias")
    assert effect.channels == ("humidity",)
    bias = 1e-6 * 9.8 * 0.5
    found = _voltages(chain, {"dK0_dh": 1e-6 * 9.8}, humidity=0.5)
    assert found == pytest.approx(_voltages(BASE, {"K0": bias}), rel=1e-12)
    assert not np.allclose(found, _voltages(BASE, {}), rtol=1e-9)


def test_a_step_is_one_file(put: Put) -> None:
    """What it adds begins at its instant; and it is offered with an instant to be looked for, not fitted."""
    effect, chain = _added(put, "misalignment-step")
    assert [q.name for q in effect.parameters if not q.fitted] == ["t_step"]
    found = _voltages(chain, {"dvartheta_z": 1e-5, "t_step": 40.0})
    before, after = _voltages(BASE, {}), _voltages(BASE, {"vartheta_z": 1e-5})
    assert found == pytest.approx(np.where(T >= 40.0, after, before), rel=1e-12)


def test_a_random_effect_is_one_file(put: Put) -> None:
    """Its signature is the sensitivity: of the scale factor, the voltage itself."""
    put("derive/effects/gain_noise.py", derive.effects)
    effect = next(e for e in derive.effects.catalogue() if e.id == "gain-noise")
    files = pipeline.derive_model((), [effect])
    made, (row,) = _run(files["signatures.py"]), json.loads(files["manifest.json"])["catalogue"]
    assert (row["id"], row["kind"]) == ("gain-noise", "random")
    *motion, p = _arguments(made, {})
    place = [name for name, _ in made.ROWS].index("gain-noise.sigma_K1")
    rows = [made.derivatives(j, *motion, made.values_of(j, p))[place] for j in range(4)]
    assert np.stack(rows) == pytest.approx(_voltages(BASE, {}), rel=1e-9)


def test_a_random_effect_is_recognised_where_its_sensitivity_is() -> None:
    """The test that a random effect gets for nothing: variance that follows the sensitivity, and not without it."""
    rng = np.random.default_rng(2)
    s = rng.normal(size=20000)

    def log_p(residual: np.ndarray) -> float:
        s2, e2 = s**2, residual**2
        sums = np.array([np.sum(s2), np.sum(e2), s2 @ s2, e2 @ e2, s2 @ e2])
        return Variance(len(s), sums).test().log_p

    assert log_p(rng.normal(size=20000)) > np.log(1e-3)
    assert log_p(rng.normal(size=20000) + 0.3 * s * rng.normal(size=20000)) < np.log(1e-12)


def test_an_effect_of_the_recorder_is_one_file() -> None:
    """Taken as a model's own: derived, handed on to the runtime, and recognised, beside those of the catalogue."""
    path = "derive/effects/stuck_output.py"
    (effect,) = derive.effects.from_sources({Path(path): EXAMPLES[path].encode()})
    offered = [e for e in derive.effects.catalogue() if e.kind == "output" or e.id == "cubic-input"]
    assert "EFFECT" not in effect.recogniser
    assert "from derive" not in effect.recogniser
    files = pipeline.derive_model((), (*offered, effect))
    assert "output_effects/stuck_output.py" in json.loads(files["manifest.json"])["files"]
    model = from_files(files)
    assert list(model.recognisers) == ["imu-saturation", "quantisation", "saturation", "stuck-output"]

    def recognised(values: np.ndarray, noise: float) -> list[str]:
        valid = np.ones(len(values), dtype=bool)
        of_outputs = {e: r for e, r in model.recognisers.items() if not hasattr(r, "CHANNELS")}
        return [e for e, r in of_outputs.items() if r.present(values, valid, noise)]

    x = np.random.default_rng(3).normal(size=5000)
    assert recognised(x, 1.0) == []
    stuck = x.copy()
    for n in (100, 900, 1700, 2500, 3300, 4100):
        stuck[n] = stuck[n - 1]
    assert recognised(stuck, 1.0) == ["stuck-output"]
    assert recognised(np.round(x * 2) / 2, 0.5) == ["quantisation"]
    assert "saturation" in recognised(np.clip(x, -2.0, 2.0), 1.0)
    with pytest.raises(ValueError, match="present"):
        text = EXAMPLES[path].replace("def present", "def somewhere")
        derive.effects.from_sources({Path(path): text.encode()})


def test_every_recogniser_that_is_offered_comes_with_the_program() -> None:
    assert list(packaged().recognisers) == [e.id for e in packaged().candidates if e.kind == "output"]


def test_a_file_format_is_one_file_and_a_line(
    put: Put, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    json_file = put("ragg_runtime/flight/json_file.py", ragg_runtime.flight)
    monkeypatch.setattr(formats, "ALL", (*formats.ALL, json_file))
    monkeypatch.setattr(formats, "ENDINGS", {**formats.ENDINGS, ".json": json_file})
    x = np.random.default_rng(4).normal(size=40)
    x[3] = np.nan
    (tmp_path / "files").mkdir()
    path = tmp_path / "files" / "x.json"
    json_file.write_tables(path, [Written([(Column("time", "s"), np.arange(40.0)), (Column("a_x", "g"), x)])])
    convert(path, path.with_suffix(".parquet"), None)
    convert(path.with_suffix(".parquet"), tmp_path / "files" / "back.json", None)
    (table,) = formats.open_file(tmp_path / "files" / "back.json", Look())
    (batch,) = table.batches()
    assert [(h.name, h.unit) for h in table.headings] == [("time", "s"), ("a_x", "g")]
    assert batch["a_x"].tobytes() == x.tobytes()
    whole = path.read_text()
    for damaged in (whole[:100], "[" * 100000, "{}", '[{"columns": 3}]', whole.replace('"unit"', '"u"', 1)):
        path.write_text(damaged)
        if damaged == "{}":
            assert list(formats.open_file(path, Look())) == []
            continue
        with pytest.raises(UserError, match="cannot be read as JSON"):
            formats.open_file(path, Look())


def test_a_target_is_one_folder(put: Put) -> None:
    """What it writes runs without NumPy, and is the NumPy model to rounding."""
    put("derive/emit/micropython", derive.emit)
    assert len(target.targets()) == 4
    own = next(t for t in target.targets() if t.__name__.endswith("micropython"))
    (name, text), *_ = own.folded(pipeline._folded(pipeline.PAPERS)).items()
    assert name == "micropython/folded.py"
    assert "numpy" not in text
    made: dict = {}
    exec(compile(text, name, "exec"), made)
    draw = np.random.default_rng(5)
    p, inputs, t = draws.instrument(draw), draws.motion(draw, 20), draw.uniform(0, 4, 20)
    four = {q: p[2 + 4 * n : 6 + 4 * n].tolist() for n, (q, _) in enumerate(folded.PARAMETERS[2:])}
    c = made["fold"](float(p[0]), four)
    phi = folded.disc_angle(t, float(p[1]))
    found = [made["output"](c, float(f), x.tolist()) for f, x in zip(phi, inputs.T, strict=True)]
    off = np.max(np.abs(found - folded.output(t, inputs, p))) / draws.signal(p) / draws.EOTVOS
    assert off < 1e-3  # Eo: the coefficients are folded in doubles here


def test_a_panel_is_one_file(put: Put) -> None:
    put("ragg_runtime/report/panel/largest_residual.py", ragg_runtime.report.panel)
    s = scenario(3, duration=150.0)
    c = compare(packaged(), s.sheet, [s.simulate().flight()])
    text = compare_html(c, title="t", command="c", sources=())
    assert "Largest residual" in text
    (residual,) = c.residual
    k = int(np.argmax(np.where(c.fitted.prepared[0].observation.record.valid, np.abs(residual), 0.0)))
    assert f"at {c.fitted.prepared[0].observation.record.time[k]:.6g} s." in text
    assert text.index("Demodulated channels") < text.index(
        "Largest residual"
    )  # in the order of the files' names
