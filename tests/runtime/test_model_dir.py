"""A model directory is in the old or in the new state, whatever happens in between."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import locked
from ragg_runtime.model import directory as md
from ragg_runtime.model.directory import (
    HistoryStep,
    ModelDir,
    compute_digest,
    create_model_dir,
    load_model_dir,
    replace_model_dir,
)

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
ROOT = Path(__file__).resolve().parents[2]
NAMES = ["generated", "history.json", "model.toml"]


def text_of(n: int) -> str:
    return MODEL.format(n=n)


def code_of(n: int) -> dict[str, str]:
    """Code of state n: none for every third one."""
    return {} if n % 3 == 0 else {"deep/chain.py": f"STATE = {n}\n" * 50, "digest": str(n)}


def step_of(n: int) -> HistoryStep:
    return HistoryStep("add", "2024-01-01T00:00:00Z", f"state-{n}")


def state_number(found: ModelDir) -> int:
    """The number of the state, after a check that model and history are of the same one."""
    n = int(found.instrument.radius)
    assert found.text == text_of(n)
    assert found.history[-1].effect == f"state-{n}"
    return n


def make(tmp_path: Path, n: int) -> ModelDir:
    return create_model_dir(tmp_path / "model", text_of(n), generated=code_of(n), history=(step_of(n),))


def change(current: ModelDir, n: int) -> ModelDir:
    return replace_model_dir(current, text_of(n), generated=code_of(n), step=step_of(n))


def entries(path: Path) -> list[str]:
    return sorted(p.name for p in path.iterdir())


def test_a_model_of_nothing_but_model_toml(tmp_path: Path) -> None:
    (tmp_path / "model.toml").write_text(text_of(2))
    found = load_model_dir(tmp_path)
    assert (found.generated, found.history, found.instrument.radius) == (None, (), 2.0)
    assert entries(tmp_path) == ["model.toml"]


@pytest.mark.parametrize(("old", "new"), [(1, 2), (1, 3), (3, 1)])
def test_replace(tmp_path: Path, old: int, new: int) -> None:
    current = make(tmp_path, old)
    (current.path / "notes.txt").write_text("mine")
    (current.path / "model.toml").chmod(0o640)
    made = change(current, new)
    assert state_number(made) == state_number(load_model_dir(made.path)) == new
    assert made.digest != current.digest
    assert made.history[-1].digests == (compute_digest(text_of(old)), compute_digest(text_of(new)))
    assert (made.path / "notes.txt").read_text() == "mine"
    assert (made.path / "model.toml").stat().st_mode & 0o777 == 0o640
    assert entries(made.path) == [x for x in [*NAMES, "notes.txt"] if x != "generated" or new % 3]
    if new % 3:
        assert (made.path / "generated" / "deep" / "chain.py").read_text().startswith(f"STATE = {new}\n")
    assert entries(tmp_path) == ["model"]


def test_a_change_that_was_cut_off_is_dropped_and_an_edit_by_hand_is_not(tmp_path: Path) -> None:
    first = make(tmp_path, 1)
    change(first, 2)
    toml = first.path / "model.toml"
    toml.write_text(text_of(1))  # the history was written, model.toml was not
    found = load_model_dir(first.path)
    assert (state_number(found), len(found.history)) == (1, 1)
    made = change(found, 4)
    assert [s.effect for s in made.history] == ["state-1", "state-4"]
    assert len(json.loads((first.path / "history.json").read_text())["steps"]) == 2
    toml.write_text(text_of(4) + "# mine\n")
    assert [s.effect for s in load_model_dir(first.path).history] == ["state-1", "state-4"]


def test_a_calibration_saved_meanwhile_hinders_nobody_and_stays(tmp_path: Path) -> None:
    """As in a notebook: calibrate(m, flights, save=True), then add(m, effect, flights) with the same m."""
    first = make(tmp_path, 1)
    step = HistoryStep("calibrate", "2024-01-01T00:00:00Z")
    for n in (1, 2):
        replace_model_dir(
            first,
            first.text,
            generated=code_of(1),
            step=step,
            calibration=f"{n}",
        )
    found = change(first, 2)
    assert [x.action for x in found.history] == ["add", "calibrate", "calibrate", "add"]
    assert found.calibration == "2"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork and SIGKILL")
def test_killed_at_random_instants(tmp_path: Path) -> None:
    made = make(tmp_path, 1)
    chance = random.Random(20240101)
    seen = set()
    for _ in range(12):
        last = load_model_dir(made.path).digest
        writer = os.fork()
        if writer == 0:
            current = load_model_dir(made.path)
            for n in range(int(current.instrument.radius), 100000):
                current = change(current, 1 + n % 12)
            os._exit(1)
        try:
            # A reader beside the writer sees whole states only; the writer dies at any instant.
            deadline = time.monotonic() + 30
            while load_model_dir(made.path).digest == last and time.monotonic() < deadline:
                state_number(load_model_dir(made.path))
            time.sleep(chance.uniform(0.0, 0.02))
        finally:
            os.kill(writer, signal.SIGKILL)
            _, status = os.waitpid(writer, 0)
        assert os.waitstatus_to_exitcode(status) == -signal.SIGKILL, "the writer failed"
        seen.add(state_number(load_model_dir(made.path)))
    assert len(seen) > 3, "the writer never wrote"
    assert state_number(change(load_model_dir(made.path), 5)) == 5
    assert entries(made.path) == NAMES


def test_what_fails_leaves_not_a_trace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    current = make(tmp_path, 1)
    before = {p: p.read_bytes() for p in sorted(current.path.rglob("*")) if p.is_file()}
    write_bytes = Path.write_bytes
    for error in (OSError(28, "No space left on device"), KeyboardInterrupt()):

        def fails(place: Path, data: bytes, error: BaseException = error) -> int:
            if place.name == "chain.py":
                raise error
            return write_bytes(place, data)

        with monkeypatch.context() as patch:
            patch.setattr(Path, "write_bytes", fails)
            with pytest.raises((UserError, KeyboardInterrupt)):
                change(current, 2)
        assert {p: p.read_bytes() for p in sorted(current.path.rglob("*")) if p.is_file()} == before
    with pytest.raises(UserError, match="TOML"):
        replace_model_dir(current, "radius =", generated={}, step=step_of(2))
    assert entries(current.path) == NAMES


@pytest.mark.parametrize("by", [text_of(2), text_of(1) + "# mine\n"])
def test_a_stale_change_is_refused(tmp_path: Path, by: str) -> None:
    first = make(tmp_path, 1)
    (first.path / "model.toml").write_text(by)
    with pytest.raises(UserError, match="changed in the meantime"):
        change(first, 3)


def test_links_are_replaced_not_followed(tmp_path: Path) -> None:
    """Whoever sends a model directory writes nowhere else by it."""
    current = make(tmp_path, 1)
    (current.path / "history.json").unlink()
    (current.path / "history.json").symlink_to(tmp_path / "elsewhere.json")
    (current.path / ".model.toml.new").symlink_to(tmp_path / "elsewhere.toml")
    shutil.rmtree(current.path / "generated")
    (current.path / "generated").symlink_to(tmp_path / "outside")
    (tmp_path / "outside").mkdir()
    (tmp_path / "outside" / "mine").write_text("mine")
    assert state_number(change(load_model_dir(current.path), 2)) == 2
    assert entries(tmp_path) == ["model", "outside"]
    assert entries(tmp_path / "outside") == ["mine"]


def test_the_lock_holds_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    current = make(tmp_path, 1)
    monkeypatch.setattr(md, "_PATIENCE", 0.05)
    with locked(current.path, 0.0), pytest.raises(UserError, match="another command"):
        change(current, 2)
    assert state_number(change(current, 2)) == 2


def test_messages(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="no model directory"):
        load_model_dir(tmp_path / "none")
    with pytest.raises(UserError, match=r"model\.toml is missing"):
        load_model_dir(tmp_path)
    made = make(tmp_path, 1)
    with pytest.raises(UserError, match="exists already"):
        make(tmp_path, 1)
    whole = {"action": "add", "effect": "lag", "time": "now"}
    odd = ({"before": 3}, {"before": {"calibrated": [1]}}, {"after": {"rms_Eo": "many"}}, {"flights": ["a"]})
    steps = (json.dumps({"steps": [whole | step]}) for step in odd)
    for bad in ("{", "[]", '{"steps": [{}]}', '{"steps": 3}', *steps):
        (made.path / "history.json").write_text(bad)
        with pytest.raises(UserError, match="history is damaged"):
            load_model_dir(made.path)


def test_a_model_directory_is_not_imported_from(tmp_path: Path) -> None:
    """`python -m` looks into the current folder first, and a model directory has a `generated/`."""
    place = api.new(tmp_path / "model").directory.path
    (place / "generated").mkdir()
    (place / "generated" / "__init__.py").write_text("raise SystemExit('executed')\n")
    command = [sys.executable, "-m", "ragg_runtime", "history", "."]
    done = subprocess.run(command, cwd=place, capture_output=True, text=True, check=False)
    assert (done.returncode, "executed" in done.stderr) == (0, False), done.stderr
