"""The bad and awkward inputs that users meet: how to make each, and what the program has to say about it."""

from __future__ import annotations

import contextlib
import dataclasses
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from unittest import mock

import commands
import numpy as np

from benchmarks.sheet import model_text
from ragg_runtime import api
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.screening import timing

Arrays = Mapping[str, np.ndarray]
Make = Callable[[], object]
Change = Callable[[Flight], Flight]

G0 = 9.8
HIDDEN = {"thermal-scale": {"dK1_dT": [0.0, 0.0, 2e-7, 0.0]}}
COMPARE = ("compare", "model", "flight.csv")


@dataclass(frozen=True)
class MessageCase:
    """One bad input: ``make`` puts it into the current folder, where a good ``model`` directory stands already;
    ``says`` is what the message has to contain; ``status`` 2: refused, 0: handled, and the result says so.
    Unless it is ``of_time`` no mistake of time is looked for, which takes most of the search."""

    make: Make
    says: tuple[str, ...]
    command: tuple[str, ...] = COMPARE
    status: int = 2
    of_time: bool = False


@cache
def good() -> Scenario:
    return scenario(48, duration=300.0)


@cache
def record(hidden: bool = False, voltages: bool = False) -> Flight:
    return good().simulate(HIDDEN if hidden else {}).flight(voltages=voltages)


@cache
def _template() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="bad-input-"))
    (folder / "sheet.toml").write_text(model_text(good().sheet))
    api.new(folder / "model", folder / "sheet.toml")
    return folder / "model"


def stage(folder: Path) -> None:
    """A folder with a good model directory and a small, well-formed flight in it."""
    shutil.copytree(_template(), folder / "model")
    (folder / "flight.csv").write_text(TEXT)


_NAMES = ["time", *(f"{q}_{k}" for q in ("a", "omega") for k in "xyz"), "G_out"]
_UNITS = ["s", "g", "g", "g", "deg/h", "deg/h", "deg/h", "V"]
HEADER = ",".join(f"{n} [{u}]" for n, u in zip(_NAMES, _UNITS, strict=True))


def _line(k: int) -> str:
    numbers = (k / 16, *(0.01 * np.sin(0.3 * k + n) for n in range(7)))
    return ",".join(f"{x:.6g}" for x in numbers)


TEXT = "\n".join([HEADER, *(_line(k) for k in range(40))]) + "\n"


def toml(old: str, new: str) -> Make:
    def make() -> None:
        path = Path("model/model.toml")
        found = path.read_text()
        assert re.search(old, found, re.MULTILINE), old
        path.write_text(re.sub(old, lambda _: new, found, count=1, flags=re.MULTILINE))

    return make


def flown(
    change: Change,
    name: str = "flight.csv",
    *,
    hidden: bool = False,
    voltages: bool = False,
    derived: bool = False,
) -> Make:
    """A simulated flight, changed; ``derived``: without the angular acceleration."""

    def make() -> None:
        x = change(record(hidden, voltages))
        write_flight(without(x, "omegadot") if derived else x, name)

    return make


def without(x: Flight, stem: str) -> Flight:
    return dataclasses.replace(x, channels={n: v for n, v in x.channels.items() if not n.startswith(stem)})


def same(x: Flight) -> Flight:
    return x


def channels(change: Callable[[Arrays], Arrays]) -> Change:
    return lambda x: dataclasses.replace(x, channels={**x.channels, **change(x.channels)})


def outputs(change: Callable[[np.ndarray], np.ndarray]) -> Change:
    return lambda x: dataclasses.replace(x, outputs={n: change(v) for n, v in x.outputs.items()})


def motion(change: Callable[[np.ndarray], np.ndarray]) -> Change:
    return channels(lambda c: {n: change(v) for n, v in c.items() if n.startswith(("a_", "omega"))})


def timed(change: Callable[[np.ndarray], np.ndarray]) -> Change:
    return lambda x: dataclasses.replace(x, time=change(x.time))


def kept(choose: Callable[[np.ndarray], np.ndarray]) -> Change:
    """Some of the rows, as a file that lacks the others."""

    def change(x: Flight) -> Flight:
        rows = choose(np.arange(len(x)))
        return dataclasses.replace(
            x,
            time=x.time[rows],
            channels={n: v[rows] for n, v in x.channels.items()},
            outputs={n: v[rows] for n, v in x.outputs.items()},
            valid=x.valid[rows],
        )

    return change


def blank(x: np.ndarray) -> np.ndarray:
    return np.where((np.arange(len(x)) // 100) % 12 == 5, np.nan, x)


def struck(x: np.ndarray) -> np.ndarray:
    rng = np.random.default_rng(7)
    hit = rng.random(len(x)) < 0.01
    return np.where(hit, x + 5 * np.std(x) * rng.choice([-1.0, 1.0], len(x)), x)


def voltages_ordered(*order: str) -> Change:
    return lambda x: dataclasses.replace(x, outputs={f"V_{j}": x.outputs[n] for j, n in enumerate(order, 1)})


def both(*makes: Make) -> Make:
    return lambda: [m() for m in makes]


_EFFECTS = r"^effects = .*$"
_LIKELY = "likely mistake"

TABLE = {
    "an unknown effect": MessageCase(
        toml(_EFFECTS, 'effects = ["thermal-scal"]'), ("did you mean", "thermal-scale")
    ),
    "an effect whose channel the flight lacks": MessageCase(
        both(toml(_EFFECTS, 'effects = ["thermal-scale"]'), flown(lambda x: without(x, "temperature"))),
        ("thermal-scale", "temperature", "flight.csv", "ragg remove"),
    ),
    "a pipe": MessageCase(
        lambda: os.mkfifo("p.csv"), ("p.csv", "regular file"), ("compare", "model", "p.csv")
    ),
    "cut out, its time set to zero": MessageCase(
        flown(lambda x: timed(lambda t: t - t[0])(kept(lambda k: k[37:])(x))),
        (_LIKELY, "cut out", "spin_angle"),
        of_time=True,
    ),
    "an output that does not change": MessageCase(
        flown(outputs(lambda v: np.full_like(v, 1.5))), ("'G_out'", "does not change", "disconnected")
    ),
    "V_2 and V_3 exchanged": MessageCase(
        flown(voltages_ordered("V_1", "V_3", "V_2", "V_4"), voltages=True),
        (_LIKELY, "V_2 and V_3 are exchanged"),
    ),
    "the second of two flights": MessageCase(
        both(flown(same), flown(outputs(lambda v: -v), "second.csv")),
        ("second.csv", _LIKELY, "the sign of G_out is reversed", "-1"),
        ("diagnose", "model", "flight.csv", "second.csv"),
    ),
}


@dataclass(frozen=True)
class Ran:
    """What a command did: exit status, both streams, and whether the model directory is as it was."""

    status: int
    out: str
    err: str
    unchanged: bool

    @property
    def message(self) -> str:
        """The error, or the notes of a result, without progress."""
        if self.status:
            return "\n".join(x for x in self.err.splitlines() if not x.startswith("... "))
        return "\n".join(x for x in self.out.splitlines() if x.startswith("note: "))


def tree(path: Path) -> dict[str, bytes]:
    return {str(p.relative_to(path)): p.read_bytes() for p in sorted(path.rglob("*")) if p.is_file()}


@contextmanager
def inside(place: Path) -> Iterator[None]:
    with contextlib.chdir(place), mock.patch.object(sys, "argv", ["ragg", *sys.argv[1:]]):
        yield


def ran(row: MessageCase, place: Path) -> Ran:
    """Make the input in an empty folder and run the command in this process."""
    stage(place)
    with (
        inside(place),
        nullcontext() if row.of_time else mock.patch.object(timing, "propose_times", lambda *_: []),
    ):
        row.make()
        before = tree(Path("model"))
        done = commands.ragg(*row.command)
        return Ran(done.returncode, done.stdout, done.stderr, before == tree(Path("model")))
