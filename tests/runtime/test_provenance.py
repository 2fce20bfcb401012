"""Every JSON says what made it, in the same bytes for the same input; every report too."""

from __future__ import annotations

import hashlib
import json
import re
import shlex
import subprocess
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ragg_runtime import api
from ragg_runtime.cli.main import main
from ragg_runtime.io import write_flight
from ragg_runtime.simulate import simulate_flight

DAY = re.compile(r"20\d\d-\d\d-\d\d")


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A model and a flight of two minutes."""
    folder = tmp_path_factory.mktemp("provenance")
    m = api.new(folder / "model")
    flight = simulate_flight(m.instrument, [], seed=1, duration=120.0, rate=8.0)
    write_flight(flight, folder / "flight.parquet")
    return folder


def json_of(arguments: Sequence[str], folder: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Any, str]:
    monkeypatch.chdir(folder)
    monkeypatch.setattr(sys, "argv", ["ragg", *arguments, "--json", "result.json"])
    main(sys.argv[1:])
    text = (folder / "result.json").read_text("utf-8")
    return json.loads(text), text


@pytest.mark.parametrize(
    "arguments", [["compare", "model", "flight.parquet"], ["effects", "lag"]], ids=" ".join
)
def test_a_result_names_what_made_it(
    place: Path, monkeypatch: pytest.MonkeyPatch, arguments: Sequence[str]
) -> None:
    found, text = json_of(arguments, place, monkeypatch)
    made = found["provenance"]
    assert made["python"] == "{}.{}.{}".format(*sys.version_info)
    assert {n: made[n] for n in ("numpy", "scipy", "sympy")} == {
        n: version(n) for n in ("numpy", "scipy", "sympy")
    }
    assert made["command"] == shlex.join(["ragg", *arguments, "--json", "result.json"])
    if "model" in arguments:
        digest = hashlib.sha256((place / "model" / "model.toml").read_bytes()).hexdigest()
        assert (made["model"], made["model_digest"]) == ("model", digest)
    if "flight.parquet" in arguments:
        digest = hashlib.sha256((place / "flight.parquet").read_bytes()).hexdigest()
        assert made["flights"] == [{"path": "flight.parquet", "digest": digest}]
        assert not DAY.search(text), "a result of today is no other than one of tomorrow"
    assert json_of(arguments, place, monkeypatch)[1] == text


def test_a_change_names_the_state_before_and_after(
    place: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    api.new(tmp_path / "model")
    toml = tmp_path / "model" / "model.toml"
    digests = [hashlib.sha256(toml.read_bytes()).hexdigest()]
    for arguments in (["add", "model", "lag"], ["remove", "model", "lag"]):
        made = json_of(arguments, tmp_path, monkeypatch)[0]["provenance"]
        digests.append(hashlib.sha256(toml.read_bytes()).hexdigest())
        assert [made["model_digest_before"], made["model_digest"]] == digests[-2:]
    assert digests[0] == digests[2] != digests[1]


def test_the_same_result_on_any_number_of_threads(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """BLAS splits sums by the number of its threads; the verdict and the figures must not notice. ``make test`` has one."""
    words = ["diagnose", "model", "flight.parquet", "--json", "result.json"]
    results = [json_of(words[:3], place, monkeypatch)[1]]
    subprocess.run(
        [sys.executable, "-m", "ragg_runtime", *words],
        cwd=place,
        env={**_environment(), "OPENBLAS_NUM_THREADS": "2", "OMP_NUM_THREADS": "2"},
        capture_output=True,
        check=True,
    )
    results.append((place / "result.json").read_text("utf-8"))
    if np.lib.NumpyVersion(np.__version__) >= "2.0.0":
        assert results[0] == results[1]
    else:  # BLAS of that time: sums depend on where in memory their terms lie
        first, second = (json.loads(r) for r in results)
        assert (first["verdict"], first["found"]) == (second["verdict"], second["found"])
        errors = [[r["error_after"]["rms_Eo"] for r in x["ranking"]] for x in (first, second)]
        np.testing.assert_allclose(errors[0], errors[1], rtol=1e-3)


def _environment() -> dict[str, str]:
    import os

    root = str(Path(api.__file__).parents[1])
    return {**os.environ, "PYTHONPATH": root}
