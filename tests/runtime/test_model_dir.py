"""A model directory is in the old or in the new state, whatever happens in between."""

from __future__ import annotations

import contextlib
import functools
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from ragg_runtime.base import folder
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.lock import locked
from ragg_runtime.model_dir import directory as md
from ragg_runtime.model_dir.directory import ModelDir, create_model_dir, load_model_dir, replace_model_dir
from ragg_runtime.model_dir.history import Step

MODEL = """# state {n}
effects = []
[disc]
radius = "{n} m"
spin_frequency = "0.25 Hz"
g0 = "9.8 m/s^2"
[accelerometers]
K1 = "10 mA/g"
k_VI = "1e9 ohm"
"""
FILES = 6
ROOT = Path(__file__).resolve().parents[2]


def text_of(n: int) -> str:
    return MODEL.format(n=n)


def history_of(n: int) -> tuple[Step, ...]:
    return (Step("add", "2024-01-01T00:00:00Z", f"state-{n}"),)


def code_of(folder: Path, n: int) -> Path | None:
    """Code of state n: none for every third one."""
    if n % 3 == 0:
        return None
    code = folder / f"code{n}"
    if not code.exists():
        (code / "deep").mkdir(parents=True)
        for k in range(FILES):
            (code / "deep" / f"{k}.py").write_text(f"STATE = {n}\n" * 50)
    return code


def state_number(found: ModelDir) -> int:
    """The number of the state, after a check that all three things are of the same one."""
    n = int(found.instrument.radius)
    assert found.text == text_of(n)
    assert found.history[-1:] == history_of(n)
    if n % 3 == 0:
        assert found.generated is None
    else:
        assert found.generated is not None
        files = sorted((found.generated / "deep").iterdir())
        assert len(files) == FILES
        assert all(f.read_text() == f"STATE = {n}\n" * 50 for f in files)
    return n


def make(tmp_path: Path, n: int) -> ModelDir:
    return create_model_dir(
        tmp_path / "model", text_of(n), generated=code_of(tmp_path, n), history=history_of(n)
    )


def change(tmp_path: Path, current: ModelDir, n: int) -> ModelDir:
    return replace_model_dir(current, text_of(n), generated=code_of(tmp_path, n), step=history_of(n)[0])


def entries(path: Path) -> list[str]:
    return sorted(p.name for p in path.iterdir())


@pytest.mark.parametrize("n", [1, 3])
def test_create_then_load(tmp_path: Path, n: int) -> None:
    made = make(tmp_path, n)
    assert state_number(load_model_dir(made.path)) == n
    assert entries(made.path) == sorted(["history.json", "model.toml"] + ["generated"] * (n == 1))
    assert not [p for p in tmp_path.iterdir() if p.name.startswith(".")]


def test_a_model_of_nothing_but_model_toml(tmp_path: Path) -> None:
    (tmp_path / "model.toml").write_text(text_of(2))
    found = load_model_dir(tmp_path)
    assert (found.generated, found.history, found.instrument.radius) == (None, (), 2.0)
    assert entries(tmp_path) == ["model.toml"]


@pytest.mark.parametrize(("old", "new"), [(1, 2), (1, 3), (3, 1), (3, 6)])
def test_replace(tmp_path: Path, old: int, new: int) -> None:
    current = make(tmp_path, old)
    (current.path / "my_effects").mkdir()
    (current.path / "notes.txt").write_text("mine")
    (current.path / "model.toml").chmod(0o640)
    made = change(tmp_path, current, new)
    assert state_number(made) == new
    assert made.digest != current.digest
    assert (made.path / "notes.txt").read_text() == "mine"
    assert (made.path / "model.toml").stat().st_mode & 0o777 == 0o640
    known = ["history.json", "model.toml", "my_effects", "notes.txt"] + ["generated"] * (new % 3 != 0)
    assert entries(made.path) == sorted(known)


def test_digest_tells_states_apart_and_ignores_byte_code(tmp_path: Path) -> None:
    made = make(tmp_path, 1)
    assert made.generated is not None
    (made.generated / "__pycache__").mkdir()
    (made.generated / "__pycache__" / "x.pyc").write_bytes(b"0")
    assert load_model_dir(made.path).digest == made.digest
    (made.generated / "deep" / "0.py").write_text("")
    assert load_model_dir(made.path).digest != made.digest


def test_steps_survive_the_file(tmp_path: Path) -> None:
    error = {"rms_V": 1.25, "rms_Eo": 0.1 + 0.2, "inline_Eo": None}
    step = Step("add", "2024-02-03T04:05:06Z", "lag", error, {"rms_V": 0.5}, {"01": "ab" * 32})
    made = create_model_dir(tmp_path / "m", text_of(1), history=(Step("new", "2024-02-03T00:00:00Z"), step))
    assert made.history[1] == step
    assert json.loads((made.path / "history.json").read_text())["steps"][0]["effect"] is None


def die(moves: Iterator[int], after: int) -> None:
    """End the process at once, without any clean-up, after that many moves."""
    if next(moves) == after:
        os._exit(9)


def _moves(monkeypatch: pytest.MonkeyPatch, when: Callable[[], None]) -> None:
    """Call ``when`` after every single move of a file or folder."""
    for owner, name in ((folder.Folder, "move"), (folder.Folder, "exchange")):
        original = getattr(owner, name)

        def moved(*a: object, _original: Callable[..., object] = original, **k: object) -> object:
            result = _original(*a, **k)
            when()
            return result

        monkeypatch.setattr(owner, name, moved)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.parametrize(("old", "new"), [(1, 2), (1, 3), (3, 1), (3, 6)])
def test_killed_after_any_move(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, old: int, new: int) -> None:
    """The process dies after its first, second, ... move: the next reader finds one whole state."""
    found = []
    for dies_after in range(1, 20):
        base = tmp_path / str(dies_after)
        base.mkdir()
        current = make(base, old)
        child = os.fork()
        if child == 0:
            with monkeypatch.context() as patch:
                moves = iter(range(1, 100))
                _moves(patch, functools.partial(die, moves, dies_after))
                change(base, current, new)
            os._exit(0)
        _, status = os.waitpid(child, 0)
        assert state_number(load_model_dir(current.path)) == new  # the first move is the commit
        again = change(base, load_model_dir(current.path), old)
        assert state_number(again) == old
        assert not [e for e in entries(again.path) if e.startswith(".")]
        found.append(os.waitstatus_to_exitcode(status))
        if found[-1] == 0:
            break
    assert found[-1] == 0
    assert len(found) >= 4
    assert set(found[:-1]) == {9}


def test_fails_before_the_commit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What fails, or is interrupted, while the new state is prepared leaves not a trace."""
    current = make(tmp_path, 1)
    before = {p: p.read_bytes() for p in sorted(current.path.rglob("*")) if p.is_file()}
    for error in (OSError(28, "No space left on device"), KeyboardInterrupt()):

        def fails(*_: object, error: BaseException = error, **__: object) -> None:
            raise error

        with monkeypatch.context() as patch:
            patch.setattr(shutil, "copytree", fails)
            with pytest.raises((UserError, KeyboardInterrupt)):
                change(tmp_path, current, 2)
        assert {p: p.read_bytes() for p in sorted(current.path.rglob("*")) if p.is_file()} == before
        assert entries(current.path) == ["generated", "history.json", "model.toml"]


def write_for_ever(folder: Path) -> None:
    current = load_model_dir(folder / "model")
    for n in range(int(current.instrument.radius), 100000):
        current = change(folder, current, 1 + n % 12)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork and SIGKILL")
def test_killed_at_random_instants(tmp_path: Path) -> None:
    made = make(tmp_path, 1)
    for n in range(1, 13):
        code_of(tmp_path, n)
    chance = random.Random(20240101)
    seen, last = set(), made.digest
    for _ in range(20):
        writer = os.fork()
        if writer == 0:
            with contextlib.suppress(BaseException):
                write_for_ever(tmp_path)
            os._exit(1)
        try:
            # A reader beside the writer sees whole states only; the writer dies at any instant.
            changes, wanted, deadline = 0, chance.randrange(1, 4), time.monotonic() + 30
            while changes < wanted and time.monotonic() < deadline:
                found = load_model_dir(made.path)
                changes += found.digest != last
                last = found.digest
                time.sleep(0.002)
            time.sleep(chance.uniform(0.0, 0.02))
        finally:
            os.kill(writer, signal.SIGKILL)
            _, status = os.waitpid(writer, 0)
        assert os.waitstatus_to_exitcode(status) == -signal.SIGKILL, "the writer failed"
        seen.add(state_number(load_model_dir(made.path)))
    assert len(seen) > 3, "the writer never wrote"
    assert state_number(change(tmp_path, load_model_dir(made.path), 5)) == 5
    assert entries(made.path) == ["generated", "history.json", "model.toml"]


def test_a_stale_change_is_refused(tmp_path: Path) -> None:
    first = make(tmp_path, 1)
    change(tmp_path, first, 2)
    with pytest.raises(UserError, match="changed by someone else"):
        change(tmp_path, first, 3)
    assert state_number(load_model_dir(first.path)) == 2


def test_a_calibration_saved_meanwhile_hinders_nobody_and_stays(tmp_path: Path) -> None:
    """As in a notebook: calibrate(m, flights, save=True), then add(m, effect, flights) with the same m."""
    first = make(tmp_path, 1)
    kept = Step("calibrate", "2024-01-01T00:00:00Z")
    code = code_of(tmp_path, 1)
    replace_model_dir(
        first, first.text, generated=code, step=kept, calibration=lambda text: f"1 after {text}"
    )
    replace_model_dir(
        first, first.text, generated=code, step=kept, calibration=lambda text: f"2 after {text}"
    )
    found = change(tmp_path, first, 2)
    assert state_number(found) == 2
    assert [x.action for x in found.history] == ["add", "calibrate", "calibrate", "add"]
    assert found.calibration == "2 after 1 after None"


def test_an_edit_by_hand_counts_as_a_change(tmp_path: Path) -> None:
    first = make(tmp_path, 1)
    (first.path / "model.toml").write_text(text_of(1) + "# mine\n")
    with pytest.raises(UserError, match="changed by someone else"):
        change(tmp_path, first, 2)


def test_the_lock_holds_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    current = make(tmp_path, 1)
    monkeypatch.setattr(md, "_PATIENCE", 0.05)
    with locked(current.path, 0.0), pytest.raises(UserError, match="another command"):
        change(tmp_path, current, 2)
    assert state_number(change(tmp_path, current, 2)) == 2


def test_the_lock_ends_with_its_process(tmp_path: Path) -> None:
    code = (
        "import sys, pathlib, ragg_runtime.base.lock as l\n"
        "with l.locked(pathlib.Path(sys.argv[1]), 0): print(1, flush=True); input()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code, tmp_path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=ROOT
    ) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline() == b"1\n"
        with pytest.raises(TimeoutError), locked(tmp_path, 0.02):
            pass
        holder.kill()
    with locked(tmp_path, 0.0):
        assert entries(tmp_path) == []


def test_bad_new_state_is_refused_before_anything_is_touched(tmp_path: Path) -> None:
    current = make(tmp_path, 1)
    with pytest.raises(UserError, match="TOML"):
        replace_model_dir(current, "radius =", generated=None)
    assert state_number(load_model_dir(current.path)) == 1


def test_messages(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="no model directory"):
        load_model_dir(tmp_path / "none")
    with pytest.raises(UserError, match=r"model\.toml is missing"):
        load_model_dir(tmp_path)
    made = make(tmp_path, 1)
    with pytest.raises(UserError, match="exists already"):
        make(tmp_path, 1)
    for bad in ("{", "[]", '{"steps": [{}]}', '{"steps": 3}'):
        (made.path / "history.json").write_text(bad)
        with pytest.raises(UserError, match="history is damaged"):
            load_model_dir(made.path)
