"""A compiler that hangs is not waited for."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import pytest

from ragg_runtime.model import compile as compiler

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="files without a name, scripts as compilers")


def test_a_compiler_that_hangs_is_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its children hold the pipes open; it was waited for 304 s."""
    script = tmp_path / "cc"
    script.write_text("#!/bin/sh\nsleep 300 & sleep 300\n")
    script.chmod(0o755)
    monkeypatch.setenv("CC", str(script))
    monkeypatch.delenv("RAGG_NATIVE", raising=False)
    monkeypatch.setattr("ragg_runtime.model.compile.PATIENCE", 1.0)
    start = time.monotonic()
    with pytest.raises(compiler.BuildError, match="does not answer within 1 s"):
        compiler.build({"a.c": "int f(void) { return 1; }\n"}, tmp_path / "cache")
    assert time.monotonic() - start < 8
    assert not list((tmp_path / "cache").glob(".*so"))


@pytest.mark.parametrize("cc", ['"unclosed', "gcc --no-such-option", "/", "/dev/null", "false"])
def test_an_odd_compiler_is_one_message(cc: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", cc)
    monkeypatch.delenv("RAGG_NATIVE", raising=False)
    with pytest.raises(compiler.BuildError):
        compiler.build({"a.c": "int f(void) { return 1; }\n"}, tmp_path / "cache")
