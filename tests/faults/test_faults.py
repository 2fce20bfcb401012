"""A few trials of each fault; ``make faults`` runs two hundred."""

from __future__ import annotations

import os
import random
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from derive import everything
from ragg_runtime.base import folder
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import clear_stale, temporary_name, write_text
from ragg_runtime.base.lock import locked
from ragg_runtime.cli.main import main
from ragg_runtime.model_dir.directory import load_model_dir
from ragg_runtime.model_dir.publish import publish
from ragg_runtime.workflow import loop

from . import surveys
from .injected import Fault, run
from .trials import COMMANDS, KINDS, model_state, settle, trial, warm

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs fork and SIGKILL")


@pytest.fixture(scope="module", autouse=True)
def warmed() -> Iterator[None]:
    original = everything.folders
    warm()
    yield
    everything.folders = original


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("command", COMMANDS, ids=lambda c: c.name)
def test_old_or_new_and_nothing_left_over(command: object, kind: str, tmp_path: Path) -> None:
    if os.geteuid() == 0:
        for folder in (tmp_path, *tmp_path.parents[:2]):
            folder.chmod(0o755)
    outcome = trial(command, kind, tmp_path, random.Random(f"{command.name} {kind}"), 0.1)  # type: ignore[attr-defined, arg-type]
    assert not outcome.wrong, outcome


def test_a_survey_continues_after_its_disc_was_full(tmp_path: Path) -> None:
    place = surveys.made(tmp_path)
    how, wrong = surveys.trial(place, "quota", 0, random.Random(3))
    assert not wrong
    assert how.startswith("struck")


def test_two_processes_on_one_model(tmp_path: Path) -> None:
    """Both add an effect at once: each is done, or told that it was not; what is there is whole."""
    model = loop.new(tmp_path / "model").directory.path
    (tmp_path / "scratch").mkdir()
    for _ in range(3):
        children = []
        for effect in ("lag", "odd-quadratic"):
            child = os.fork()
            if child == 0:
                ended = run(["add", str(model), effect], Fault("none"), tmp_path / "scratch", main)
                os._exit(ended.status if ended.status in (0, 2) else 1)
            children.append((effect, child))
        codes = {e: os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) for e, child in children}
        assert set(codes.values()) <= {0, 2}
        done = [e for e, code in codes.items() if code == 0]
        assert done, "neither of them was done"
        m = loop.load(model)
        assert sorted(e.id for e in m.model.effects) == sorted(done)
        for effect in done:
            m = loop.remove(m, effect)
        assert model_state(model) == "plain"


def test_derive_waits_for_another_and_says_so_in_the_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ragg_runtime.model_dir.publish._PATIENCE", 0.05)
    with locked(tmp_path, 0.0), pytest.raises(UserError, match="another command is deriving there"):
        publish(tmp_path, {"a": {"x": "1"}}, ())
    assert list(tmp_path.iterdir()) == []


def test_derive_changes_only_what_differs(tmp_path: Path) -> None:
    folders = {"a": {"x": "1", "deep/y": "2"}, "b": {"z": "3"}}
    assert publish(tmp_path, folders, ("a",)) == ["a/x", "a/deep/y", "b/z"]
    before = (tmp_path / "a").stat().st_ino
    (tmp_path / "b" / "mine").write_text("mine")
    assert publish(tmp_path, folders, ("a",)) == []
    assert publish(tmp_path, folders | {"b": {"z": "4"}}, ("a",)) == ["b/z"]
    assert (tmp_path / "a").stat().st_ino == before, "a folder that is right is not touched"
    assert publish(tmp_path, {"a": {"x": "1"}}, ("a",)) == ["a/deep/y"]
    found = sorted(p.relative_to(tmp_path).as_posix() for p in tmp_path.rglob("*"))
    assert found == ["a", "a/x", "b", "b/mine", "b/z"]


def test_without_an_exchange_of_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the system cannot exchange folders at a stroke, a killed change is still finished by the next."""
    monkeypatch.setattr(folder, "renameat2", lambda: None)
    publish(tmp_path, {"a": {"x": "1"}}, ("a",))
    for after in range(1, 80):
        (tmp_path / "scratch").mkdir()
        text = str(after + 1)
        ended = run([text], Fault("kill", after), tmp_path / "scratch", lambda t: _publish(tmp_path, t[0]))
        settle(tmp_path, ("a",))
        assert (tmp_path / "a" / "x").read_text() in (str(after), text)
        (tmp_path / "scratch").rmdir()
        publish(tmp_path, {"a": {"x": text}}, ("a",))
        assert sorted(p.name for p in tmp_path.iterdir()) == ["a"]
        if ended.status == 0:
            return
    pytest.fail("it was killed every time: the list of moments is too short")


def _publish(root: Path, text: str) -> None:
    publish(root, {"a": {"x": text}}, ("a",))


def test_files_of_killed_commands_do_not_add_up(tmp_path: Path) -> None:
    target = tmp_path / "report.html"
    (tmp_path / "scratch").mkdir()
    for _ in range(3):
        run(["x"], Fault("kill", 3), tmp_path / "scratch", lambda t: write_text(target, t[0]))
    write_text(target, "done")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["report.html", "scratch"]
    mine = temporary_name(target)
    mine.write_text("of a process that lives")
    clear_stale(target)
    assert mine.exists()


def test_links_and_pipes_in_generated_are_not_followed(tmp_path: Path) -> None:
    m = loop.add(loop.new(tmp_path / "model"), "lag").loaded.directory
    generated = m.path / "generated"
    os.mkfifo(generated / "pipe")
    (generated / "all").symlink_to("/")
    assert load_model_dir(m.path).digest != m.digest
    for place in generated.rglob("*"):
        if not place.is_dir() or place.is_symlink():
            place.unlink()
    (generated / "c").rmdir()
    generated.rmdir()
    generated.symlink_to("/")
    found = loop.load(m.path)
    assert [e.id for e in found.model.effects] == ["lag"]
    loop.remove(found, "lag")
    assert sorted(p.name for p in m.path.iterdir()) == ["history.json", "model.toml"]
    assert Path("/").exists()
