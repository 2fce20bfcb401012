"""No Python of a model directory is executed before the user has listed exactly these bytes."""

from __future__ import annotations

import contextlib
import hashlib
import os
import sys
from pathlib import Path

import pytest

import derive.effects
from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import main
from ragg_runtime.model_dir import trust
from ragg_runtime.workflow import loop

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
    for text in (*what, "effects_folder", "ragg trust", "mine.py", "none was executed"):
        assert text in caught.value.message


def listed(model: Path) -> trust.OwnEffects:
    return trust.read_effects(model / "effects")


def test_nothing_runs_before_it_is_listed(model: Path, tmp_path: Path) -> None:
    """However harmless it looks, and though it is the user's own, written a moment ago."""
    refused(model, hashlib.sha256(EFFECT.encode()).hexdigest())
    trust.trust(listed(model))
    m = loop.load(model)
    assert "mine" in [e.id for e in m.model.candidates]
    assert [e.id for e in loop.add(m, "mine").loaded.model.effects] == ["mine"]


@pytest.mark.parametrize(
    "line",
    [
        "import sympy as sp\nsp.S(\"__import__('pathlib').Path({mark!r}).write_text('x')\")",
        "import sympy as sp\nsp.Matrix([[\"__import__('pathlib').Path({mark!r}).write_text('x')\"]])",
        "import sympy as sp\nx = sp.Symbol('x')\n"
        "(x + 1).subs('x', \"__import__('pathlib').Path({mark!r}).write_text('x')\")",
        "import pathlib\npathlib.Path({mark!r}).write_text('x')",
    ],
)
def test_text_that_sympy_evaluates_is_code(model: Path, tmp_path: Path, line: str) -> None:
    mark = tmp_path / "mark"
    put(model / "effects" / "mine.py", EFFECT + "\n" + line.format(mark=str(mark)) + "\n")
    refused(model)
    for command in (["compare", str(model), "f.csv"], ["add", str(model), "lag"], ["build", str(model)]):
        with pytest.raises(SystemExit) as end:
            main(command)
        assert end.value.code == 2
    for command in (["history", str(model)], ["trust", str(model), "--list"]):
        main(command)
    assert not mark.exists()
    trust.trust(listed(model))
    with contextlib.suppress(UserError):
        loop.load(model)
    assert mark.exists(), "the text would have run: the trial is a fair one"


def test_no_byte_code_is_written_nor_read(model: Path) -> None:
    trust.trust(listed(model))
    loop.load(model)
    assert [p.name for p in (model / "effects").iterdir()] == ["mine.py"]


@pytest.mark.parametrize("by", ["symlink", ".."])
def test_a_folder_outside_follows_the_same_rule(model: Path, tmp_path: Path, by: str) -> None:
    (model / "effects").rename(tmp_path / "outside")
    if by == "symlink":
        (model / "effects").symlink_to(tmp_path / "outside")
    else:
        toml = model / "model.toml"
        put(toml, toml.read_text("utf-8").replace('"effects"', '"../outside"'))
    refused(model)
    trust.trust(trust.read_effects(tmp_path / "outside"))
    assert "mine" in [e.id for e in loop.load(model).model.candidates]


@pytest.mark.parametrize("change", ["another byte", "another file", "another name"])
def test_trust_ends_with_the_first_change(model: Path, change: str) -> None:
    trust.trust(listed(model))
    loop.load(model)
    if change == "another byte":
        put(model / "effects" / "mine.py", EFFECT + " ")
    elif change == "another file":
        put(model / "effects" / "other.py", "")
    else:
        (model / "effects" / "mine.py").rename(model / "effects" / "mine.py.txt")
        put(model / "effects" / "mine_.py", EFFECT)
        with pytest.raises(UserError, match="ragg trust"):
            loop.load(model)
        return
    refused(model)


def test_trust_can_be_taken_back(model: Path) -> None:
    trust.trust(listed(model))
    loop.load(model)
    assert trust.forget(listed(model))
    assert not trust.forget(listed(model))
    refused(model)


def test_a_list_that_others_can_write_counts_for_nothing(model: Path) -> None:
    trust.trust(listed(model)).chmod(0o666)
    refused(model)


def test_the_variable(model: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(trust.VARIABLE, "listed")
    refused(model)
    monkeypatch.setenv(trust.VARIABLE, "all")
    loop.load(model)
    monkeypatch.setenv(trust.VARIABLE, "yes")
    with pytest.raises(UserError, match="expected: all, listed"):
        loop.load(model)


def test_the_command_lists_what_would_run(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Names of several lines, or with signs that steer a terminal, are shown as what they are."""
    odd = "a\n  remedy: ragg trust \x1b[2J.py"
    put(model / "effects" / odd, EFFECT)
    with pytest.raises(SystemExit):
        main(["add", str(model), "lag"])
    shown = r"a\n  remedy: ragg trust \x1b[2J.py"
    said = capsys.readouterr().err
    assert shown in said
    assert "\x1b" not in said
    main(["trust", str(model)])
    said = capsys.readouterr().out
    assert [line.split("  (")[0] for line in said.splitlines()[:2]] == [
        str(model / "effects" / shown),
        str(model / "effects" / "mine.py"),
    ]
    assert hashlib.sha256(EFFECT.encode()).hexdigest() in said
    (model / "effects" / odd).unlink()
    main(["trust", str(model), "--list"])
    assert "Not on the list" in capsys.readouterr().out
    main(["trust", str(model / "model.toml")])
    main(["trust", str(model), "--list"])
    assert "On the list" in capsys.readouterr().out
    main(["trust", str(model), "--forget"])
    refused(model)


@pytest.mark.skipif(sys.platform == "win32", reason="there are no such pipes")
def test_a_pipe_is_not_waited_for(model: Path) -> None:
    os.mkfifo(model / "effects" / "other.py")
    with pytest.raises(UserError, match="not a regular file"):
        loop.load(model)


def test_a_folder_that_cannot_be_read_and_a_fault_in_it(model: Path) -> None:
    put(model / "effects" / "mine.py", "EFFECT = 1 / 0\n")
    trust.trust(listed(model))
    with pytest.raises(UserError, match=r"mine\.py: ZeroDivisionError"):
        loop.load(model)
    put(model / "effects" / "mine.py", "raise SystemExit(0)\n")
    trust.trust(listed(model))
    with pytest.raises(UserError, match="SystemExit"):
        loop.load(model)
    (model / "effects" / "mine.py").unlink()
    (model / "effects" / "mine.py").symlink_to(model / "nowhere")
    with pytest.raises(UserError, match="cannot be read"):
        loop.load(model)


def test_a_new_model_from_a_sheet_finds_the_folder_of_the_sheet(model: Path, tmp_path: Path) -> None:
    with pytest.raises(UserError, match="none was executed"):
        loop.new(tmp_path / "first", model / "model.toml")
    trust.trust(listed(model))
    m = loop.new(tmp_path / "second", model / "model.toml")
    assert "mine" in [e.id for e in m.model.candidates]
