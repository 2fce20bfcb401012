"""A compiler that hangs is not waited for."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from itertools import pairwise
from pathlib import Path

import pytest

from ragg_runtime.model import native
from ragg_runtime.model.native import compiler
from ragg_runtime.workflow import loop

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="files without a name, scripts as compilers")


@pytest.mark.parametrize("when", ["version", "compiling"])
def test_a_compiler_that_hangs_is_given_up(
    when: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its children hold the pipes open; it was waited for 304 s."""
    script = tmp_path / "cc"
    hang = "sleep 300 & sleep 300"
    body = hang if when == "version" else f'case "$1" in --version) echo 1;; *) {hang};; esac'
    script.write_text(f"#!/bin/sh\n{body}\n")
    script.chmod(0o755)
    monkeypatch.setenv("CC", str(script))
    monkeypatch.delenv("RAGG_NATIVE", raising=False)
    monkeypatch.setattr("ragg_runtime.model.native.compiler.HANGING", 1.0)
    monkeypatch.setattr("ragg_runtime.model.native.compiler.ANSWERING", 1.0)
    start = time.monotonic()
    with pytest.raises(native.BuildError, match="does not answer within 1 s"):
        native.build({"a.c": "int f(void) { return 1; }\n"}, tmp_path / "cache")
    assert time.monotonic() - start < 8
    assert not list((tmp_path / "cache").glob(".*so"))


@pytest.mark.parametrize("when", ["version", "compiling"])
def test_a_command_with_a_compiler_that_hangs(when: str, tmp_path: Path) -> None:
    """It says what it waits for, gives up once, and goes on without; the figures are those of NumPy."""
    script = tmp_path / "cc"
    body = "sleep 300" if when == "version" else 'case "$1" in --version) echo 1;; *) sleep 300;; esac'
    script.write_text(f"#!/bin/sh\n{body}\n")
    script.chmod(0o755)
    model = loop.new(tmp_path / "model").directory.path
    flight = Path(loop.__file__).parents[2] / "examples" / "demo-flight.parquet"
    environment = os.environ | {
        "PYTHONPATH": str(Path(loop.__file__).parents[2]),
        "CC": str(script),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
    }
    environment.pop("RAGG_NATIVE", None)
    command = [sys.executable, "-m", "ragg_runtime", "compare", str(model), str(flight)]
    with subprocess.Popen(
        command, stderr=subprocess.PIPE, stdout=subprocess.PIPE, env=environment
    ) as process:
        assert process.stderr is not None
        told = [(time.monotonic(), line.decode()) for line in process.stderr]
        assert process.stdout is not None
        assert b"noise floor" in process.stdout.read()
    assert process.returncode == 0
    waited = [k for k, (_, line) in enumerate(told) if "waiting for the C compiler" in line]
    given_up = [k for k, (_, line) in enumerate(told) if "does not answer" in line]
    assert len(waited) == {"version": 1, "compiling": 2}[when]
    assert len(given_up) == 1
    assert "NumPy code serves" in told[given_up[0]][1]
    said = [at for at, _ in told[waited[0] : given_up[0] + 1]]
    assert all(later - at < 5.0 for at, later in pairwise(said))
    assert compiler.PATIENT < 5.0
    assert compiler.HANGING < 10.0


@pytest.mark.parametrize("cc", ['"unclosed', "gcc --no-such-option", "/", "/dev/null", "false"])
def test_an_odd_compiler_is_one_message(cc: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", cc)
    monkeypatch.delenv("RAGG_NATIVE", raising=False)
    with pytest.raises(native.BuildError):
        native.build({"a.c": "int f(void) { return 1; }\n"}, tmp_path / "cache")
