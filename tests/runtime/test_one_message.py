"""One message, whatever goes wrong: streams, histories, compilers, missing extras, odd arguments."""

from __future__ import annotations

import os
import sys
import time
from importlib import resources
from pathlib import Path
from typing import Any

import pytest

from ragg_runtime import api
from ragg_runtime.base.errors import EXTRAS, UserError, missing_package
from ragg_runtime.cli.main import main
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.model import chain as compiler
from ragg_runtime.report.pages import render_page
from ragg_runtime.simulate import simulate_flight
from ragg_runtime.wording.sections import Bar, Bars, Section
from ragg_runtime.workspace import Source

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="such names and streams")


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return api.new(tmp_path / "model").directory.path


def test_every_refusal_of_the_system_names_its_place(model, capsys, monkeypatch) -> None:
    def refuses(*_: object) -> None:
        raise OSError(40, "Too many levels of symbolic links", "/some\n/where")

    monkeypatch.setattr(api, "load", refuses)
    with pytest.raises(SystemExit) as end:
        main(["compare", str(model), "f.csv"])
    assert end.value.code == 2
    assert capsys.readouterr().err == "ragg: /some\\n/where: Too many levels of symbolic links\n"


def test_a_missing_reader_ends_in_what_to_install(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.setitem(sys.modules, "h5py", None)
    (tmp_path / "flight.h5").write_bytes(b"\x89HDF\r\n\x1a\n")
    with pytest.raises(SystemExit) as end:
        main(["convert", str(tmp_path / "flight.h5"), str(tmp_path / "flight.csv")])
    assert end.value.code == 2
    assert "pip install 'ragg[files]'" in capsys.readouterr().err


def test_a_page_without_matplotlib_says_so_where_a_figure_would_be(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [n for n in sys.modules if n.startswith(("matplotlib", "ragg_runtime.report.plots"))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    figure = Bars("b", "label", "caption", (Bar("x", 1.0),), "axis")
    page = render_page(
        "kind", [Section("verdict"), Section("more", plots=(figure,))], Source("ragg", title="t")
    )
    assert "pip install &#x27;ragg[plots]&#x27;" in page
    assert "<svg" not in page


def test_other_errors_are_no_missing_extra() -> None:
    assert missing_package(ValueError()) is None
    assert missing_package(ModuleNotFoundError(name="numpy")) is None
    wrapped = ImportError()
    wrapped.__cause__ = ModuleNotFoundError(name="openpyxl")
    assert EXTRAS["openpyxl"] in str(missing_package(wrapped))


def test_a_compiler_that_hangs_is_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its children hold the pipes open; it was waited for 304 s."""
    script = tmp_path / "cc"
    script.write_text("#!/bin/sh\nsleep 300 & sleep 300\n")
    script.chmod(0o755)
    monkeypatch.setenv("CC", str(script))
    monkeypatch.delenv("RAGG_NATIVE", raising=False)
    monkeypatch.setattr("ragg_runtime.model.chain.PATIENCE", 1.0)
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


@pytest.mark.parametrize("option", ["--duration", "--noise"])
@pytest.mark.parametrize("value", ["nan", "inf"])
def test_a_number_must_be_one(option, value, tmp_path, capsys) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["simulate", str(tmp_path / "m"), "-o", str(tmp_path / "x.csv"), option, value])
    assert ended.value.code == 2
    assert "not a finite number" in capsys.readouterr().err


@pytest.mark.skipif(sys.platform == "win32", reason="pipes and devices of Unix")
def test_a_test_sheet_that_never_ends(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for source in (tmp_path / "pipe", Path("/dev/zero")):
        with pytest.raises(UserError, match="not a pipe or a device"):
            api.new(tmp_path / "m", source)


def test_a_flight_longer_than_memory(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="too long to be simulated"):
        simulate_flight(api.new(tmp_path / "m").instrument, [], duration=1e18)


@pytest.mark.parametrize(
    "asked", [{"noise": 1e308}, {"sheet_error": 1e300}, {"spin": ["1e300"]}, {"spin": ["0.25,0.1@1e300"]}]
)
def test_a_flight_beyond_all_numbers_is_refused(asked: dict[str, Any]) -> None:
    """It ended in a traceback, or in a file of NaN."""
    instrument = parse_instrument(resources.files("ragg_runtime").joinpath("example.toml").read_text("utf-8"))
    with pytest.raises(UserError, match="values are not finite"):
        simulate_flight(instrument, [], duration=20.0, rate=8.0, **asked)
