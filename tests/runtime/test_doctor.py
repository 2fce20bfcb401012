"""Each damaged state of a model directory has one message and a way back."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from test_unfinished_changes import interrupted, plant, seen

from ragg_runtime.cli.main import main
from ragg_runtime.model_dir import trust
from ragg_runtime.workflow import loop


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return loop.add(loop.new(tmp_path / "model"), "lag").loaded.directory.path


def doctor(model: Path, capsys: pytest.CaptureFixture[str], *more: str, status: int = 0) -> str:
    capsys.readouterr()
    try:
        main(["doctor", str(model), *more])
        code: object = 0
    except SystemExit as end:
        code = end.code
    said = capsys.readouterr()
    assert "Traceback" not in said.err
    assert code == status, said
    return said.out + said.err


def half(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def unfinished(model: Path) -> None:
    with pytest.MonkeyPatch.context() as patch:
        loop.remove(loop.load(model), "lag")
        interrupted(model, patch)


def staged(model: Path) -> None:
    (model / ".ragg" / "next").mkdir(parents=True)
    (model / ".ragg" / "next" / "model.toml").write_text("half")


def stranger(model: Path) -> None:
    plant(model, removed=["../victim"])


DAMAGES: dict[str, tuple[Callable[[Path], object], str, str]] = {
    "half a history": (
        lambda m: half(m / "history.json"),
        "the history is damaged",
        "history.json.damaged-1",
    ),
    "a folder for a history": (
        lambda m: ((m / "history.json").unlink(), (m / "history.json").mkdir()),
        "the history is no file",
        "history.json.damaged-1",
    ),
    "a calibration that is none": (
        lambda m: (m / "calibration.json").write_text('{"version": 1, "calibrations": [{}]}'),
        "the saved calibration is damaged",
        "calibration.json.damaged-1",
    ),
    "a calibration that is a link": (
        lambda m: (m / "calibration.json").symlink_to("/etc/passwd"),
        "the saved calibration is no file",
        "calibration.json.damaged-1",
    ),
    "no code": (lambda m: shutil.rmtree(m / "generated"), "generated/ is missing", "derived again"),
    "half of the code": (
        lambda m: half(m / "generated" / "chain.py"),
        "not what model.toml derives",
        "derived again",
    ),
    "code that is a link": (
        lambda m: (shutil.rmtree(m / "generated"), (m / "generated").symlink_to("/")),
        "not what model.toml derives",
        "derived again",
    ),
    "a change that was made": (unfinished, "cut off after it had been made", "it is complete now"),
    "a change that was not": (staged, "cut off before its change was made", "cleared away"),
    "a change of a stranger": (stranger, "none that this program writes", "ragg-unfinished-1"),
}


@pytest.mark.skipif(sys.platform == "win32", reason="links")
@pytest.mark.parametrize("name", DAMAGES)
def test_a_way_back(model: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    damage, what, way = DAMAGES[name]
    damage(model)
    before = seen(model.parent)
    said = doctor(model, capsys, "--look", status=2)
    assert said.count(what) == 1
    assert seen(model.parent) == before, "to look changes nothing"
    said = doctor(model, capsys)
    assert said.count(what) == 1
    assert way in said
    assert "mended" in said
    assert "in order" in doctor(model, capsys)
    m = loop.load(model)
    assert [e.id for e in m.model.effects] == ["lag"]
    assert m.notes == ()
    loop.remove(m, "lag")


def test_several_at_once(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    stranger(model)
    half(model / "history.json")
    shutil.rmtree(model / "generated")
    said = doctor(model, capsys)
    assert said.count("->") == 3
    assert "in order" in doctor(model, capsys)


@pytest.mark.parametrize("damage", ["missing", "half", "pipe", "link"])
def test_what_only_its_owner_can_mend(model: Path, capsys: pytest.CaptureFixture[str], damage: str) -> None:
    place = model / "model.toml"
    text = place.read_bytes()
    place.unlink()
    if damage == "half":
        place.write_bytes(text[: len(text) // 2])
    elif damage == "pipe":
        os.mkfifo(place)
    elif damage == "link":
        place.symlink_to(model.parent / "elsewhere.toml")
    before = seen(model) if damage != "pipe" else {}
    said = doctor(model, capsys, status=2)
    assert "model.toml" in said
    assert damage == "pipe" or seen(model) == before


@pytest.mark.parametrize("damage", ["half", "link"])
def test_a_mapping_is_left_to_whoever_wrote_it(
    model: Path, capsys: pytest.CaptureFixture[str], damage: str
) -> None:
    place = model / "mapping.toml"
    if damage == "half":
        place.write_text("[time]\ncolumn = ")
    else:
        place.symlink_to("/etc/passwd")
    before = seen(model)
    said = doctor(model, capsys, status=2)
    assert said.count("mapping.toml: ") == 1
    assert ("mend it by hand" if damage == "half" else "links in a model directory are not followed") in said
    assert seen(model) == before


def test_python_that_is_not_trusted(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (model / "effects").mkdir()
    (model / "effects" / "x.py").write_text("raise SystemExit('executed')")
    toml = model / "model.toml"
    toml.write_text('effects_folder = "effects"\n' + toml.read_text("utf-8"), "utf-8")
    assert not trust.is_trusted(trust.read_effects(model / "effects"))
    assert "ragg trust" in doctor(model, capsys, status=2)
