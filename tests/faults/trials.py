"""One trial: a command on a model directory, or on the root of a project, with a fault; and what must hold."""

from __future__ import annotations

import contextlib
import io
import os
import random
import shutil
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from derive import everything, tree
from ragg_runtime.base import transaction
from ragg_runtime.base.lock import locked
from ragg_runtime.cli.main import main
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model_dir import derive
from ragg_runtime.model_dir.directory import load_model_dir
from ragg_runtime.workflow import loop
from tests.derived import derived

from .injected import NOBODY, Ended, Fault, run

EFFECT = "lag"
KINDS = ("kill at", "kill", "full", "quota", "forbidden")


@dataclass(frozen=True)
class Command:
    """A command under test: how a place for it is made, its arguments, and which state a place is in."""

    name: str
    prepare: Callable[[Path], Path]
    arguments: Callable[[Path], Sequence[str]]
    state: Callable[[Path], str]
    changes: int
    """About how many changes of the disc it makes."""
    next: Callable[[Path], Sequence[str]]
    """What somebody may do after it is done."""


@dataclass(frozen=True)
class Outcome:
    """What a trial found; ``wrong`` is empty if all held."""

    command: str
    fault: Fault
    ended: Ended
    state: str
    wrong: tuple[str, ...]


def warm() -> None:
    """Compute in this process what its forks would all compute again, and load what they need.

    A fork that becomes another user may not be able to read Python's own files any more (an interpreter below
    the home of the superuser): whatever a command imports is imported here.
    """
    everything.folders = derived  # type: ignore[assignment]
    derived()
    with tempfile.TemporaryDirectory() as folder, _silent():
        for command in COMMANDS:
            base = Path(folder) / command.name
            base.mkdir()
            main(command.arguments(command.prepare(base)))
    for effects in ([], [EFFECT]):
        instrument = parse_instrument(_sheet(effects))
        derive.model_of(instrument)
        derive.files_of(instrument)


@contextlib.contextmanager
def _silent() -> Iterator[None]:
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        yield


def _sheet(effects: Sequence[str]) -> str:
    from importlib import resources

    text = resources.files("ragg_runtime").joinpath("example.toml").read_text("utf-8")
    return text.replace("effects = []", f"effects = {list(effects)!r}".replace("'", '"'))


def _model(effects: Sequence[str]) -> Callable[[Path], Path]:
    def make(base: Path) -> Path:
        sheet = base / "sheet.toml"
        sheet.write_text(_sheet(effects), "utf-8")
        loop.new(base / "model", sheet)
        sheet.unlink()
        return base / "model"

    return make


def model_state(place: Path) -> str:
    """``old`` without the effect, ``new`` with it; raises AssertionError for anything between."""
    found = load_model_dir(place)
    effects = [e.id for e in found.instrument.effects]
    assert effects in ([], [EFFECT]), effects
    files = derive.files_of(found.instrument)
    if found.generated is None:
        assert not files, "generated/ is missing"
    else:
        assert not tree.difference(files, found.generated), tree.difference(files, found.generated)
    return EFFECT if effects else "plain"


def _project(base: Path) -> Path:
    """A project whose generated files are those of another derivation."""
    root = base / "project"
    for folder, files in derived().items():
        old = {n: f"old\n{t}" for n, t in files.items()} | {"gone.txt": "old\n"}
        tree.write(old, root / folder)
    (root / "docs").mkdir()
    (root / "docs" / "mine.md").write_text("mine\n")
    return root


def project_state(root: Path) -> str:
    """As ``ragg derive --check`` sees it, after it has finished what was begun."""
    settle(root, tuple(derived()))
    assert (root / "docs" / "mine.md").read_text() == "mine\n"
    found = {}
    for folder, files in derived().items():
        old = all((root / folder / n).read_text("utf-8") == f"old\n{t}" for n, t in files.items())
        new = all((root / folder / n).read_text("utf-8") == t for n, t in files.items())
        assert old or new, f"{folder} is a mixture"
        if folder == everything.GENERATED:
            assert (root / folder / "gone.txt").exists() == old
        found[folder] = "plain" if old else "derived"
    assert len(set(found.values())) == 1, found
    return found[everything.GENERATED]


def settle(root: Path, among: Sequence[str]) -> None:
    """Finish what a killed change left, as the next command does that writes there."""
    with locked(root, 5.0):
        transaction.finish(root, among)


def _derive(place: Path) -> Sequence[str]:
    return ["derive", "--out", str(place)]


COMMANDS: tuple[Command, ...] = (
    Command(
        "add",
        _model([]),
        lambda p: ["add", str(p), EFFECT],
        model_state,
        30,
        lambda p: ["remove", str(p), EFFECT],
    ),
    Command(
        "remove",
        _model([EFFECT]),
        lambda p: ["remove", str(p), EFFECT],
        model_state,
        25,
        lambda p: ["add", str(p), EFFECT],
    ),
    Command("derive", _project, _derive, project_state, 160, _derive),
)


def trial(command: Command, kind: str, base: Path, chance: random.Random, spent: float) -> Outcome:
    """Run the command with a fault of this kind; ``spent`` is how long it takes undisturbed, s."""
    place = command.prepare(base)
    scratch = base / "scratch"
    scratch.mkdir(mode=0o777)
    scratch.chmod(0o777)
    before = command.state(place)
    beside = sorted(os.listdir(base))
    fault = Fault(kind, _moment(kind, command, chance, spent))
    readable = os.stat(place).st_mode
    if kind == "forbidden" and os.geteuid() != 0:
        place.chmod(0o555)
    ended = run(command.arguments(place), fault, scratch, main)
    place.chmod(readable)
    wrong = []
    try:
        state = command.state(place)
    except Exception as error:
        return Outcome(command.name, fault, ended, "broken", (f"{type(error).__name__}: {error}",))
    if "Traceback" in ended.said or ended.status not in (0, 2, -9):
        wrong.append(f"status {ended.status}: {ended.said[-1500:]}")
    if ended.status == 0 and state == before:
        wrong.append("it said that it was done, and it was not")
    if ended.status == 2 and state != before and kind != "full":
        wrong.append("it said that it failed, and it did not")
    if kind == "forbidden" and (ended.status != 2 or state != before):
        wrong.append(f"it was not refused: {ended.status}")
    # The next command works, and nothing is left over.
    arguments = command.arguments(place) if state == before else command.next(place)
    again = run(arguments, Fault("none"), scratch, main)
    if again.status != 0 or (command.state(place) == state and arguments != _derive(place)):
        wrong.append(f"the next command failed: {again.said[-1500:]}")
    hidden = [p.name for p in place.iterdir() if p.name.startswith(".")]
    left = [*hidden, *os.listdir(scratch), *(set(os.listdir(base)) - set(beside))]
    if left:
        wrong.append(f"left over: {left}")
    shutil.rmtree(place)
    shutil.rmtree(scratch)
    return Outcome(command.name, fault, ended, "old" if state == before else "new", tuple(wrong))


def _moment(kind: str, command: Command, chance: random.Random, spent: float) -> float:
    if kind == "kill at":
        return chance.uniform(0.0, 1.1 * spent)
    if kind == "quota":
        return float(chance.choice((0, 100, 1000, chance.randrange(60_000))))
    return float(chance.randrange(1, command.changes))


__all__ = ["COMMANDS", "KINDS", "NOBODY", "Command", "Outcome", "trial", "warm"]
