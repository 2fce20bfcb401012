"""A package of an extra that is missing: one message with what to install, and pages without figures."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from ragg_runtime.base.errors import EXTRAS, missing_package
from ragg_runtime.cli.main import main
from ragg_runtime.report.page import Origin, render_page
from ragg_runtime.wording.sections import Bar, Bars, Section


def test_a_missing_reader_ends_in_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
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
        "kind", [Section("verdict"), Section("more", plots=(figure,))], Origin("t", "ragg", ())
    )
    assert "pip install &#x27;ragg[plots]&#x27;" in page
    assert "<svg" not in page


def test_other_errors_are_no_missing_extra() -> None:
    assert missing_package(ValueError()) is None
    assert missing_package(ModuleNotFoundError(name="numpy")) is None
    wrapped = ImportError()
    wrapped.__cause__ = ModuleNotFoundError(name="openpyxl")
    assert EXTRAS["openpyxl"] in str(missing_package(wrapped))
