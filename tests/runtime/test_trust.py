"""Whose Python is executed: a user's own effects at once, a stranger's not unasked."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

import derive.effects
from ragg_runtime.base.errors import UserError
from ragg_runtime.model_dir import trust
from ragg_runtime.model_dir.effect_source import unusual
from ragg_runtime.workflow import loop

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="owners and modes mean something else there")

PACKAGED = Path(derive.effects.__file__).parent
EFFECT = (PACKAGED / "cubic_input.py").read_text("utf-8").replace('id="cubic-input"', 'id="mine"')
MARK = "\nimport pathlib\npathlib.Path({mark!r}).write_text('executed')\n"


@pytest.fixture(autouse=True)
def own_list(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trust, "_list_file", lambda: tmp_path / "config" / "trusted-effects")
    monkeypatch.delenv(trust.VARIABLE, raising=False)


@pytest.fixture
def model(tmp_path: Path) -> Path:
    """A model directory with a folder of own effects."""
    loop.new(tmp_path / "model")
    (tmp_path / "model" / "effects").mkdir(mode=0o755)
    put(tmp_path / "model" / "effects" / "mine.py", EFFECT)
    toml = tmp_path / "model" / "model.toml"
    put(toml, 'effects_folder = "effects"\n' + toml.read_text("utf-8"))
    return tmp_path / "model"


def put(path: Path, text: str) -> None:
    path.write_text(text, "utf-8")
    path.chmod(0o644)


def refused(model: Path, *what: str) -> None:
    with pytest.raises(UserError) as caught:
        loop.load(model)
    for text in (*what, "effects_folder", "ragg trust"):
        assert text in caught.value.message


def listed(model: Path) -> trust.OwnEffects:
    return trust.read_effects(model / "effects", model / "model.toml")


def test_an_effect_of_ones_own_works_at_once(model: Path) -> None:
    m = loop.load(model)
    assert "mine" in [e.id for e in m.model.candidates]
    assert [e.id for e in loop.add(m, "mine").loaded.model.effects] == ["mine"]


def test_no_byte_code_is_written_nor_read(model: Path) -> None:
    loop.load(model)
    assert [p.name for p in (model / "effects").iterdir()] == ["mine.py"]


@pytest.mark.parametrize("place", ["effects", "effects/mine.py", "model.toml"])
def test_what_everybody_can_write_is_refused(model: Path, place: str) -> None:
    (model / place).chmod((model / place).stat().st_mode | 0o002)
    refused(model, place, "can be written by everybody")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can give files away")
@pytest.mark.parametrize("place", ["effects", "effects/mine.py", "model.toml"])
def test_what_belongs_to_somebody_else_is_refused(model: Path, place: str) -> None:
    os.chown(model / place, 65534, 65534)
    refused(model, place, "belongs to another user (uid 65534)")


@pytest.mark.parametrize("by", ["symlink", ".."])
def test_a_folder_outside_follows_the_same_rule(model: Path, tmp_path: Path, by: str) -> None:
    (model / "effects").rename(tmp_path / "outside")
    if by == "symlink":
        (model / "effects").symlink_to(tmp_path / "outside")
    else:
        toml = model / "model.toml"
        put(toml, toml.read_text("utf-8").replace('"effects"', '"../outside"'))
    assert "mine" in [e.id for e in loop.load(model).model.candidates]
    (tmp_path / "outside").chmod(0o777)
    refused(model, "can be written by everybody")


def test_a_file_that_does_more_is_not_executed_unasked(model: Path, tmp_path: Path) -> None:
    mark = tmp_path / "mark"
    put(model / "effects" / "mine.py", EFFECT + MARK.format(mark=str(mark)))
    refused(model, "mine.py, line", "imports pathlib")
    assert not mark.exists()
    trust.trust(listed(model))
    loop.load(model)
    assert mark.exists()


def test_trust_ends_with_the_first_changed_byte(model: Path) -> None:
    (model / "effects").chmod(0o777)
    trust.trust(listed(model))
    loop.load(model)
    put(model / "effects" / "mine.py", EFFECT + "\n# another\n")
    refused(model)
    put(model / "effects" / "mine.py", EFFECT)
    assert trust.forget(listed(model))
    assert not trust.forget(listed(model))
    refused(model)


def test_a_list_that_others_can_write_counts_for_nothing(model: Path) -> None:
    (model / "effects").chmod(0o777)
    trust.trust(listed(model)).chmod(0o666)
    refused(model)


def test_the_variable(model: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(trust.VARIABLE, "listed")
    refused(model, "not listed")
    trust.trust(listed(model))
    loop.load(model)
    trust.forget(listed(model))
    (model / "effects").chmod(0o777)
    monkeypatch.setenv(trust.VARIABLE, "all")
    loop.load(model)
    monkeypatch.setenv(trust.VARIABLE, "yes")
    with pytest.raises(UserError, match="expected: all, listed"):
        loop.load(model)


def test_a_pipe_is_not_waited_for(model: Path) -> None:
    os.mkfifo(model / "effects" / "other.py")
    with pytest.raises(UserError, match="not a regular file"):
        loop.load(model)


def test_a_folder_that_cannot_be_read_and_a_fault_in_it(model: Path) -> None:
    put(model / "effects" / "mine.py", "EFFECT = 1 / 0\n")
    with pytest.raises(UserError, match=r"mine\.py: ZeroDivisionError"):
        loop.load(model)
    put(model / "effects" / "mine.py", "raise SystemExit(0)\n")
    with pytest.raises(UserError, match="SystemExit"):
        loop.load(model)
    (model / "effects" / "mine.py").unlink()
    (model / "effects" / "mine.py").symlink_to(model / "nowhere")
    with pytest.raises(UserError, match="cannot be read"):
        loop.load(model)


def test_a_new_model_from_a_sheet_finds_the_folder_of_the_sheet(model: Path, tmp_path: Path) -> None:
    m = loop.new(tmp_path / "second", model / "model.toml")
    assert "mine" in [e.id for e in m.model.candidates]


@pytest.mark.parametrize("path", sorted(p for p in PACKAGED.glob("*.py") if p.name != "__init__.py"))
def test_every_packaged_effect_would_pass_as_ones_own(path: Path) -> None:
    assert unusual(path.read_bytes()) is None


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("import os", "imports os"),
        ("import sympy, subprocess", "imports subprocess"),
        ("from os import system", "imports from os"),
        ("from . import x", "imports from ."),
        ("from derive import tree", "imports from derive"),
        ("from derive.effects import importlib", "imports from derive.effects"),
        ("from sympy import *", "imports *"),
        ("from sympy import sympify", "imports sympify"),
        ("import sympy as sp\nsp.sys.modules", "line 2: uses .modules"),
        ("import sympy as sp\nx = sp.sin('__import__(\"os\")')", "line 2: hands text to sin"),
        ("from sympy import sin\nx = sin(f'{1}')", "line 2: hands text to sin"),
        ("import sympy as sp\ngetattr(sp, 's' + 'ys')", "getattr on a module"),
        ("().__class__.__bases__", "__bases__"),
        ("open('x', 'w')", "uses open"),
        ("eval('1')", "uses eval"),
        ("import numpy as np\nnp.loadtxt(x)", "uses .loadtxt"),
    ],
)
def test_what_is_unusual(text: str, why: str) -> None:
    found = unusual(text.encode())
    assert found is not None
    assert why in found
