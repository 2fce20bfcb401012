"""The record of an unfinished change is text of whoever made the directory: it reaches nothing outside of it."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import pytest

from ragg_runtime.base import transaction
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.folder import Folder, NotPlainError, is_plain
from ragg_runtime.base.lock import locked
from ragg_runtime.cli.main import main
from ragg_runtime.model_dir.directory import NAMES, load_model_dir
from ragg_runtime.model_dir.publish import publish
from ragg_runtime.workflow import loop

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="links and pipes")


@pytest.fixture
def model(tmp_path: Path) -> Path:
    (tmp_path / "victim").mkdir()
    (tmp_path / "victim" / ".bashrc").write_text("mine\n")
    return loop.new(tmp_path / "model").directory.path


def plant(root: Path, **journal: object) -> Path:
    """An unfinished change with this journal; returns its folder."""
    commit = root / ".ragg" / "commit"
    commit.mkdir(parents=True)
    whole = {"folders": {}, "files": [], "removed": []} | journal
    (commit / "journal.json").write_text(json.dumps(whole))
    return commit


def seen(root: Path) -> dict[str, object]:
    """Everything below a folder: names, kinds, contents."""
    return {
        p.relative_to(root).as_posix(): os.readlink(p)
        if p.is_symlink()
        else p.read_bytes()
        if p.is_file()
        else "folder"
        for p in sorted(root.rglob("*"))
        if "ragg-cache" not in p.parts
    }


def refused(capsys: pytest.CaptureFixture[str], *arguments: str | Path) -> str:
    with pytest.raises(SystemExit) as end:
        main([str(a) for a in arguments])
    said = capsys.readouterr().err
    assert end.value.code == 2, said
    assert "Traceback" not in said
    return said


COMMANDS = (["history"], ["compare", "f.csv"], ["add", "lag"], ["remove", "lag"], ["build"])


@pytest.mark.parametrize("command", COMMANDS, ids=lambda c: c[0])
@pytest.mark.parametrize(
    "journal",
    [
        {"removed": ["../victim"]},
        {"removed": ["/victim"]},
        {"removed": [".."]},
        {"removed": [".git"]},
        {"folders": {"../victim": 1}},
        {"folders": {"generated": 1, "extra": 2}},
        {"files": ["../victim/.bashrc"]},
        {"files": ["d/.bashrc"]},
        {"files": ["model.toml/../../victim/.bashrc"]},
        {"files": ["/etc/passwd"]},
        {"files": [["model.toml"]]},
        {"files": ["x\0y"]},
        {"files": 3},
        {"folders": {"generated": "one"}},
        {"removed": None},
    ],
    ids=str,
)
def test_a_journal_reaches_nothing_outside(
    model: Path, capsys: pytest.CaptureFixture[str], journal: dict[str, object], command: list[str]
) -> None:
    commit = plant(model, **journal)
    (model / "d").symlink_to(model.parent / "victim")
    (commit / "d").mkdir()
    (commit / "d" / ".bashrc").write_text("evil\n")
    before = seen(model.parent)
    said = refused(capsys, command[0], model, *command[1:])
    assert "none that this program writes" in said
    assert "ragg doctor" in said
    assert seen(model.parent) == before


@pytest.mark.parametrize("what", ["nothing", "link", "pipe", "folder", "half", "deep", "long"])
def test_a_journal_that_is_none(model: Path, capsys: pytest.CaptureFixture[str], what: str) -> None:
    commit = plant(model)
    journal = commit / "journal.json"
    journal.unlink()
    texts = {"half": '{"files": [', "deep": "[" * 100_000, "long": " " * (1 << 20) + "{}"}
    if what == "link":
        journal.symlink_to(model.parent / "victim" / ".bashrc")
    elif what == "pipe":
        os.mkfifo(journal)
    elif what == "folder":
        journal.mkdir()
    elif what in texts:
        journal.write_text(texts[what])
    for command in (["history", model], ["add", model, "lag"]):
        assert "unfinished change" in refused(capsys, *command)


@pytest.mark.parametrize("name", [".ragg", "commit"])
def test_a_link_is_no_unfinished_change(model: Path, name: str) -> None:
    """Where the record itself is a link, nothing is read, written or removed at its other end."""
    outside = model.parent / "outside"
    outside.mkdir()
    commit = plant(outside, removed=["history.json"])
    (commit / "model.toml").write_text("evil")
    if name == ".ragg":
        (model / ".ragg").symlink_to(outside / ".ragg")
    else:
        (model / ".ragg").mkdir()
        (model / ".ragg" / "commit").symlink_to(commit)
    before = seen(outside)
    if name == ".ragg":
        loop.add(loop.load(model), "lag")
        assert [e.id for e in loop.load(model).model.effects] == ["lag"]
    else:
        with pytest.raises(UserError, match=r"a link where a folder is expected|cannot be read"):
            load_model_dir(model)
    assert seen(outside) == before


def test_the_parts_of_a_change_may_be_links(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a change brings may be a link; it is put in place as one, and not followed then either."""
    commit = plant(model, files=["model.toml", "history.json"])
    (commit / "model.toml").symlink_to(model.parent / "victim" / ".bashrc")
    (commit / "history.json").write_text('{"steps": []}')
    before = seen(model.parent)
    for command in (["history", model], ["compare", model, "f.csv"]):
        assert "links in a model directory are not followed" in refused(capsys, *command)
        assert seen(model.parent) == before
    assert "are not followed" in refused(capsys, "add", model, "lag")
    assert (model.parent / "victim" / ".bashrc").read_text() == "mine\n"


@pytest.mark.parametrize("name", ["model.toml", "history.json"])
def test_links_in_a_model_directory(model: Path, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    (model / name).rename(model.parent / name)
    (model / name).symlink_to(model.parent / name)
    assert "links in a model directory are not followed" in refused(capsys, "history", model)


def interrupted(model: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """`ragg add MODEL lag`, cut off at the instant at which it was made."""

    def cut_off(*_: object) -> None:
        raise OSError(5, "cut off")

    m = loop.load(model)
    with monkeypatch.context() as patch:
        patch.setattr(transaction, "_complete", cut_off)
        with pytest.raises(UserError, match="cut off"):
            loop.add(m, "lag")


def test_who_reads_sees_the_new_state_and_moves_nothing(
    model: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    interrupted(model, monkeypatch)
    before = seen(model)
    assert (model / "model.toml").read_text().count('"lag"') == 0
    main(["history", str(model), "--json", "-"])
    said = capsys.readouterr()
    assert [s["effect"] for s in json.loads(said.out)["steps"]] == [None, "lag"]
    assert said.err.count("cut off after it had been made") == 1
    m = loop.load(model)
    assert [e.id for e in m.model.effects] == ["lag"]
    assert len(m.notes) == 1, "what was derived is seen too"
    assert seen(model) == before
    loop.remove(m, "lag")
    assert sorted(p.name for p in model.iterdir()) == ["history.json", "model.toml"]
    assert [s.effect for s in load_model_dir(model).history] == ["", "lag", "lag"]


def test_a_removal_that_is_unfinished(model: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    loop.add(loop.load(model), "lag")
    whole = load_model_dir(model)
    plant(model, removed=["generated"])
    found = load_model_dir(model)
    assert (found.generated, found.unfinished, found.digest == whole.digest) == (None, True, False)
    with locked(model, 0.0):
        transaction.finish(model, NAMES)
    assert sorted(p.name for p in model.iterdir()) == ["history.json", "model.toml"]
    assert load_model_dir(model).digest == found.digest


def test_to_check_the_derivation_moves_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    root = tmp_path / "root"
    root.mkdir()
    (tmp_path / "victim").mkdir()
    plant(root, removed=["../victim"])
    before = seen(tmp_path)
    assert "cut off" in refused(capsys, "derive", "--check", "--out", root)
    assert "none that this program writes" in refused(capsys, "derive", "--out", root)
    assert seen(tmp_path) == before


def test_what_is_derived_is_written_through_no_link(tmp_path: Path) -> None:
    (tmp_path / "victim").mkdir()
    (tmp_path / "root").mkdir()
    (tmp_path / "root" / "docs").symlink_to(tmp_path / "victim")
    with pytest.raises(UserError, match="a link where a folder is expected"):
        publish(tmp_path / "root", {"docs": {"errata.md": "1"}}, ())
    assert seen(tmp_path) == {"victim": "folder", "root": "folder", "root/docs": str(tmp_path / "victim")}


def test_names_in_an_open_folder_are_plain(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "a")
    with Folder.at(tmp_path) as top:
        for name in ("..", ".", "", "a/b", "/", "a\\b", "C:x", "a\0", "x" * 300):
            assert not is_plain(name)
            for use in (top.status, top.remove, lambda n: top.read(n, 9), lambda n: top.move(n, top, "b")):
                with pytest.raises(NotPlainError):
                    use(name)
        with pytest.raises(NotPlainError), top.below("link"):
            pass
        with pytest.raises(NotPlainError):
            top.read("link", 9)
