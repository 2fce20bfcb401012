"""Models in machine code: equal to NumPy, and NumPy without a compiler."""

from __future__ import annotations

import json
import shutil
import stat
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from derive.effects import catalogue
from derive.pipeline import derive_model
from ragg_runtime.estimation import observation
from ragg_runtime.estimation.regressors import linearise, list_candidate_columns, make_point
from ragg_runtime.model.chain import BuildError, _say_once, build, find_compiler, load
from ragg_runtime.model.model import load_files, load_packaged, make_vector
from ragg_runtime.reference.scenario import scenario
from tests.generated import draws

needs_compiler = pytest.mark.skipif(
    not any(shutil.which(c) for c in ("cc", "gcc", "clang")), reason="no C compiler is installed"
)
LENGTH = 3 * 4096 + 77


@pytest.fixture(autouse=True)
def compiling(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("RAGG_NATIVE", raising=False)
    _say_once.cache_clear()


@needs_compiler
def test_fits_in_machine_code_are_those_in_numpy() -> None:
    """But for rounding."""
    s = scenario(63, duration=60.0)
    flight = s.simulate({"thermal-scale": {"dK1_dT": [0, 0, 2e-7, 0]}}).flight()
    model, o = load_packaged(), observation.observe(flight, s.sheet)
    without = {n: replace(getattr(model, n), sources={}) for n in ("chain", "signatures")}
    c, n = (
        linearise(make_point(m, s.sheet, make_vector(m, s.sheet), list_candidate_columns(m, s.sheet)), o)
        for m in (model, replace(model, **without))
    )
    assert model.chain.library is not None
    assert model.signatures.library is not None
    size = np.max(np.abs(n), axis=2, keepdims=True)
    assert np.sum(size > 0.0) > 150
    assert np.all(np.abs(c - n) <= 1e-9 * size)


@needs_compiler
def test_fits_of_a_derived_model_run_in_machine_code_candidates_too() -> None:
    """Of any length: those of long flights ended in a missing symbol. A directory's files are as they were."""
    chosen = [e for e in catalogue() if e.id in ("cubic-input", "thermal-scale")]
    files = derive_model(chosen[:1], chosen)
    model = load_files(files)
    assert sorted(n for n in files if n.startswith("fits/")) == ["fits/signatures.c", "fits/signatures.h"]
    assert not any("fits/" in n for n in json.loads(files["manifest.json"])["files"])
    t, draw = np.linspace(0.0, 50.0, 300), np.random.default_rng(7)
    for chain in (model.chain, model.signatures):
        inputs, p = draw.uniform(-1.0, 1.0, (len(chain.INPUTS), len(t))), draw.uniform(0.1, 1.0, chain.SIZE)
        D = replace(chain, sources={}).derivatives(2, t, inputs, p)
        assert chain.library is not None
        assert np.all(np.abs(chain.derivatives(2, t, inputs, p) - D) <= 1e-11 * np.max(np.abs(D), 1)[:, None])


def test_without_a_compiler_numpy_serves_and_says_so_once(monkeypatch, tmp_path, capsys) -> None:
    draw = np.random.default_rng(40)
    t, inputs, p = np.sort(draw.uniform(0, 1e4, LENGTH)), draws.motion(draw, LENGTH), draws.instrument(draw)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    assert find_compiler()[1:] == ["-m", "ziglang", "cc"]
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    for chain in (replace(load_packaged().chain), replace(load_packaged().chain)):
        assert np.all(np.isfinite(chain.output(t, inputs, p)))
        assert chain.library is None
    assert capsys.readouterr().err.count("slower NumPy code is used: there is no C compiler") == 1
    monkeypatch.setenv("RAGG_NATIVE", "off")
    assert replace(load_packaged().chain).library is None
    assert capsys.readouterr().err == ""


@needs_compiler
def test_library_is_made_once_and_anew_when_anything_changes(tmp_path, monkeypatch) -> None:
    source = {"one.c": "int one(void) { return 1; }\n"}
    first = build(source, tmp_path)
    made = first.stat().st_mtime_ns
    assert build(source, tmp_path) == first
    assert first.stat().st_mtime_ns == made
    assert build({"one.c": "int one(void) { return 2; }\n"}, tmp_path) != first
    monkeypatch.setenv("CC", f"{find_compiler()[0]} -DX=1")
    assert build(source, tmp_path) != first
    monkeypatch.delenv("CC")
    first.write_bytes(first.read_bytes()[:100])  # damaged: refused once, then made anew
    with pytest.raises(BuildError, match="cannot be loaded"):
        load(build(source, tmp_path))
    load(build(source, tmp_path))


@needs_compiler
def test_a_cache_that_others_can_write_to_is_not_used(tmp_path: Path) -> None:
    tmp_path.chmod(0o777)
    made = build({"three.c": "int three(void) { return 3; }\n"}, tmp_path)
    assert made.parent != tmp_path
    assert stat.S_IMODE(made.parent.stat().st_mode) == 0o700
    assert list(tmp_path.iterdir()) == []
