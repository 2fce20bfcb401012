"""What the studio has open, and what is known of it: one state, replaced whole, that every page shows."""

from __future__ import annotations

import os
import re
import threading
import time
import traceback
import unicodedata
from collections import OrderedDict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ragg_runtime import api
from ragg_runtime.api import Added, Compensation, Loaded
from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.progress import PASSES
from ragg_runtime.identification import predict
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.predict import Unwhitened
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.instrument.edit_toml import add_effect, set_parameters
from ragg_runtime.instrument.instrument import EffectSetting
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.io import Flight
from ragg_runtime.io.draft import draft_mapping
from ragg_runtime.io.files import ENDINGS, ending_of
from ragg_runtime.model import derive
from ragg_runtime.model.directory import Step, load_model_dir
from ragg_runtime.studio.sampled import Cache

Part = Callable[[str, float], None]
Edit = tuple[RawQuantity, tuple[float, ...] | None]
"""Values of a parameter, and the sheet's sigmas in the same unit (``None``: it says nothing)."""

KEPT = 4
"""Results that are remembered, by model and flights: undo, redo and taking back a cut cost nothing."""

SMALL = 1e6
"""Samples of all flights together up to which they are: what belongs to a result grows with them, and so would memory."""


@dataclass(frozen=True)
class State:
    """What is open and known; ``None`` and empty where it is not yet.

    ``read`` are the flights as they were read, ``cuts`` the segments (from, to, s) of each that are left out;
    ``compared``, ``diagnosed`` and ``unwhitened`` are results for exactly these. ``previous`` is the comparison before
    the last step, ``beside`` a state of the history with its comparison, ``trial`` an own effect that is not kept yet;
    ``cache`` holds series that were made of these.
    """

    loaded: Loaded | None = None
    paths: tuple[Path, ...] = ()
    flights: tuple[Flight, ...] = ()
    read: tuple[Flight, ...] = ()
    cuts: tuple[tuple[tuple[float, float], ...], ...] = ()
    compared: Comparison | None = None
    diagnosed: Diagnosis | None = None
    unwhitened: Unwhitened | None = None
    previous: Comparison | None = None
    beside: tuple[int, Comparison] | None = None
    trial: tuple[str, str, Mapping[str, str], Added] | None = None
    compensated: Compensation | None = None
    cache: Cache = field(default_factory=Cache)

    @property
    def model(self) -> Loaded:
        """The model; UserError if none is open."""
        if self.loaded is None:
            raise UserError(
                "no model is open", remedy="choose a model directory, or make one from a test sheet"
            )
        return self.loaded

    @property
    def samples(self) -> float:
        return float(sum(map(len, self.flights)))


class Session:
    """The state and the only ways to change it; long ones run as jobs."""

    def __init__(self, places: Places) -> None:
        self.places = places
        self.jobs = Jobs()
        self._lock = threading.Lock()
        self._state = State()
        self.shown: tuple[State, dict[str, Any]] | None = None
        self._results: OrderedDict[object, tuple[Comparison, Diagnosis, Unwhitened]] = OrderedDict()

    @property
    def state(self) -> State:
        return self._state

    def _put(self, **changes: object) -> None:
        with self._lock:
            self._state = replace(self._state, **changes)  # type: ignore[arg-type]
        self.jobs.changed()

    def open(self, model: Path | None, flights: Sequence[Path]) -> None:
        """Open a model directory and flights (``None``, none: those that are open stay), and look at them."""
        self.jobs.start("opening", partial(self._open, model, tuple(flights)))

    def _open(self, model: Path | None, flights: tuple[Path, ...], part: Part) -> None:
        if model is not None:
            self._put(**_nothing(), loaded=api.load(model))
        if flights:
            self._put(**_nothing(), paths=flights, flights=(), read=(), cuts=())
            part("reading and examining the flights", 1.0)
            try:
                read = tuple(api.read_flights(self.state.model, flights))
            except UserError:
                if any(is_foreign(p) for p in flights):
                    return  # the page asks what the columns are
                raise
            places = tuple(x.path or flights[0] for x in read)  # a file of several lines is as many flights
            self._put(**_nothing(), paths=places, flights=read, read=read, cuts=((),) * len(read))
        self._look(part)

    def leave_out(self, flight: int, stretch: tuple[float, float] | None) -> None:
        """Leave a stretch of a flight (from, to, s) out of everything; ``None``: take all of it back."""
        self._idle()
        s = self.state
        if not 0 <= flight < len(s.read):
            raise UserError("there is no such flight", found=str(flight + 1))
        cuts = list(s.cuts)
        cuts[flight] = () if stretch is None else (*cuts[flight], stretch)
        flights = tuple(x.without(c) for x, c in zip(s.read, cuts, strict=True))
        if not any(flights[flight].valid):
            raise UserError("nothing of the flight would be left", where=s.read[flight].name)
        self._put(**_nothing(), flights=flights, cuts=tuple(cuts))
        self.look()

    def new(self, model: Path, sheet: Path | None) -> None:
        """Make a model directory from a test sheet, and open it."""
        api.new(model, sheet)
        self.open(model, ())

    def look(self) -> None:
        """Compare and diagnose what is open."""
        self.jobs.start("looking", self._look)

    def _look(self, part: Part) -> None:
        s = self.state
        if s.loaded is None or not s.flights:
            return
        key = (s.loaded.directory.text, tuple(x.digest for x in s.flights), s.cuts)
        known = self._results.get(key)
        if known is not None:
            compared, d, unwhitened = known
            self._put(compared=compared, diagnosed=d, unwhitened=unwhitened, cache=Cache())
            return
        if s.compared is None:
            part("calibrating and comparing", PASSES["compare"] * s.samples)
            compared = api.compare(s.loaded, s.flights)
            self._put(compared=compared, cache=Cache())
        s = self.state
        part("testing every effect", PASSES["diagnose"] * s.samples)
        d = api.diagnose(s.model, s.flights, compared=s.compared)
        part("preparing the preview", s.samples)
        unwhitened = predict.pass_unwhitened(d.fitted)
        self._put(diagnosed=d, unwhitened=unwhitened)
        if s.compared is not None and s.samples <= SMALL:
            self._results[key] = s.compared, d, unwhitened
            while len(self._results) > KEPT:
                self._results.popitem(last=False)

    def reread(self) -> None:
        """Load the model directory again if someone else has changed it."""
        s = self.state
        if s.loaded is None or self.jobs.status.name:
            return
        if load_model_dir(s.loaded.directory.path).digest != s.loaded.directory.digest:
            self._changed(api.load(s.loaded.directory.path))

    def _changed(self, m: Loaded) -> None:
        """Another model in the place of this one: what was known of it becomes the state before."""
        self._put(**(_nothing() | {"previous": self.state.compared}), loaded=m)
        self.look()

    def add(self, effects: Sequence[str]) -> None:
        """Derive effects into the model, one after the other, and calibrate."""
        m = self.state.model
        if not effects:
            raise UserError("no effect is chosen", remedy="tick one or several")
        self.jobs.start(f"deriving {effects[0]} into {m.name}", partial(self._add, tuple(effects)))

    def _add(self, effects: tuple[str, ...], part: Part) -> None:
        s, m = self.state, self.state.model
        for e in effects:
            part(f"deriving {e} and calibrating", PASSES["add"] * s.samples)
            m = api.add(m, e, s.flights).loaded
        self._after(m, part)

    def _after(self, m: Loaded, part: Part) -> None:
        """What the effects that were added have done: the page keeps the old state until then, and sees the error fall."""
        s = self.state
        part("calibrating and comparing", PASSES["compare"] * s.samples)
        compared = api.compare(m, s.flights) if s.flights else None
        self._put(**(_nothing() | {"previous": s.compared, "compared": compared, "loaded": m}))
        self._look(part)

    def remove(self, effect: str) -> None:
        """Take an effect out of the model."""
        self._idle()
        self._changed(api.remove(self.state.model, effect))

    def edit(self, values: Mapping[str, Edit]) -> None:
        """Change values of the test sheet, and how sure it is of them."""
        self._idle()
        sheet = {n: value for n, (value, _) in values.items()}
        sigmas = {n: sigma for n, (_, sigma) in values.items()}
        m = self.state.model
        text = set_parameters(m.directory.text, sheet, sigmas)
        self._changed(api.change(m, text, "edit", ", ".join(values)))

    def go(self, action: str, step: int | None = None) -> None:
        """Undo, redo, or go back to the state after a step of the history."""
        self._idle()
        m = self.state.model
        past, future = branches(m.directory.history)
        if action == "undo" and len(past) > 1:
            to = past[-2]
        elif action == "redo" and future:
            to = future[-1]
        elif action == "restore" and step is not None and 0 <= step < len(m.directory.history):
            to = step
        else:
            raise UserError(f"there is nothing to {action}")
        self._changed(api.change(m, text_of(m.directory.history, to), action, str(to)))

    def beside(self, step: int | None) -> None:
        """Compare the model as it was after a step with the same flights; ``None``: no longer."""
        if step is None:
            self._put(beside=None)
            return
        history = self.state.model.directory.history
        if not 0 <= step < len(history):
            raise UserError("there is no such step", found=step)
        self.jobs.start("comparing an earlier model", partial(self._beside, step, text_of(history, step)))

    def _beside(self, step: int, text: str, part: Part) -> None:
        s = self.state
        part("comparing an earlier model", PASSES["compare"] * s.samples)
        old = api.as_of(s.model, text)
        self._put(beside=(step, api.compare(old, s.flights)))

    def attempt(self, effect: str, add: str, units: Mapping[str, str]) -> None:
        """Try an effect of the user's own: derived and calibrated, but not kept."""
        listed = with_own(self.state.model, effect, add, units)
        self._flown()
        self.jobs.start(f"trying {effect}", partial(self._attempt, listed, effect, add, dict(units)))

    def _attempt(self, listed: Loaded, effect: str, add: str, units: Mapping[str, str], part: Part) -> None:
        part(f"deriving {effect} and calibrating", PASSES["add"] * self.state.samples)
        result = api.add(listed, effect, self.state.flights, save=False)
        self._put(trial=(effect, add, units, result))

    def keep(self) -> None:
        """Keep what was tried as an effect of the model."""
        trial = self.state.trial
        if trial is None:
            raise UserError("nothing was tried", remedy="try an expression first")
        self.jobs.start(f"keeping {trial[0]}", partial(self._keep, trial[0], trial[1], trial[2]))

    def _keep(self, effect: str, add: str, units: Mapping[str, str], part: Part) -> None:
        s = self.state
        part(f"deriving {effect} and calibrating", PASSES["add"] * s.samples)
        self._after(api.add(with_own(s.model, effect, add, units), effect, s.flights).loaded, part)

    def compensate(self, kind: str, demodulator: str) -> None:
        """Compensate the flights that are open."""
        self._flown()

        def work(part: Part) -> None:
            s = self.state
            part("compensating", PASSES["compare"] * s.samples)
            self._put(compensated=api.compensate(s.model, s.flights, kind, demodulator))  # type: ignore[arg-type]

        self.jobs.start("compensating", work)

    def calibrate(self) -> None:
        """Keep the parameters fitted to these flights with the model, as ``ragg calibrate --save``."""
        self._flown()

        def work(part: Part) -> None:
            s = self.state
            part("calibrating", PASSES["compare"] * s.samples)
            self._put(loaded=api.calibrate(s.model, s.flights, save=True).loaded)

        self.jobs.start("calibrating", work)

    def _flown(self) -> None:
        if not self.state.flights:
            raise UserError("no flight is open", remedy="choose one first")

    def _idle(self) -> None:
        if self.jobs.status.name:
            raise Busy


def _nothing() -> dict[str, object]:
    """Of another model or other flights nothing is known yet."""
    names = ("compared", "diagnosed", "unwhitened", "previous", "beside", "trial", "compensated")
    return dict.fromkeys(names) | {"cache": Cache()}


def with_own(m: Loaded, effect: str, add: str, units: Mapping[str, str]) -> Loaded:
    """The model with an effect of one's own listed, ``add`` at the transducer (unit of each parameter), in memory alone."""
    parameters = MappingProxyType({n: MappingProxyType({"unit": u}) for n, u in units.items()})
    expression = MappingProxyType({"stage": "transducer", "add": add, "params": parameters})
    if effect in {e.id for e in derive.known(m.instrument).effects}:
        raise UserError(
            "an effect of this id exists already", found=repr(effect[:80]), remedy="choose another name"
        )
    return api.as_of(m, add_effect(m.directory.text, EffectSetting(effect, expression=expression)))


def text_of(history: Sequence[Step], step: int) -> str:
    """model.toml as it was after a step; UserError if that was not kept."""
    if not history[step].text:
        raise UserError(
            "that state was not kept: an older version made the step",
            found=f"step {step + 1}",
            remedy="remove effects one by one instead",
        )
    return history[step].text


def branches(history: Sequence[Step]) -> tuple[list[int], list[int]]:
    """Steps on the present branch, and those that undo has left (nearest last); undo and redo are steps themselves."""
    past: list[int] = []
    future: list[int] = []
    for n, s in enumerate(history):
        if s.action == "calibrate":
            continue  # the model stays as it is
        if s.action == "undo" and len(past) > 1:
            future.append(past.pop())
        elif s.action == "redo" and future:
            past.append(future.pop())
        else:
            past.append(n)
            future.clear()
    return past, future


def lineage(history: Sequence[Step]) -> list[int]:
    """The steps that lead to the present state, without those that were undone or left."""
    past, _ = branches(history)
    back = next((k for k in reversed(range(len(past))) if history[past[k]].action == "restore"), None)
    if back is None:
        return past
    return [*lineage(history[: int(history[past[back]].effect) + 1]), *past[back + 1 :]]


LISTED = 500
"""Most entries of a folder that are shown."""

LONGEST_NAME = 120
"""Longest name of an uploaded file, characters."""


@dataclass(frozen=True)
class Places:
    """Folders, resolved, below which files may be touched."""

    roots: tuple[Path, ...]

    @staticmethod
    def of(model: Path | None, flights: Sequence[Path]) -> Places:
        """Those of the model directory and of the flights; the working directory where nothing is named."""
        named = [*([model.parent if model.name else model] if model else []), *(f.parent for f in flights)]
        found = [p.resolve() for p in named] or [Path.cwd()]
        return Places(tuple(dict.fromkeys(found)))

    def inside(self, text: str) -> Path:
        """The file or folder of this name if it lies, links followed, below one of the folders."""
        try:
            path = Path(text).resolve() if text and "\0" not in text else None
        except (OSError, RuntimeError, ValueError):
            path = None
        if path is None or not self.holds(path):
            raise UserError(
                "this place is not open to the studio",
                where=text[:200] or "(no name)",
                expected="a place below " + ", ".join(map(str, self.roots)),
                remedy="name its folder when you start `ragg studio`",
            )
        return path

    def holds(self, path: Path) -> bool:
        """Whether it lies, links followed, below one of the folders."""
        real = path.resolve()
        return any(real == r or r in real.parents for r in self.roots)

    def listing(self, text: str) -> dict[str, object]:
        """What of a folder can be opened: folders, model directories, flights."""
        folder = self.inside(text) if text else self.roots[0]
        if not folder.is_dir():
            raise UserError("there is no such folder", where=folder)
        entries: list[dict[str, object]] = []
        with os.scandir(folder) as found:
            for e in sorted(found, key=lambda e: e.name):
                kind = _kind(e)
                if kind is not None and len(entries) < LISTED:
                    entries.append({"name": e.name, "path": e.path, "kind": kind, "bytes": _size(e)})
        above = str(folder.parent) if any(r in folder.parents for r in self.roots) else None
        return {
            "folder": str(folder),
            "above": above,
            "roots": list(map(str, self.roots)),
            "entries": entries,
        }


def is_foreign(path: Path) -> bool:
    """Whether a file has columns of which it must be asked what they are."""
    try:
        return bool(draft_mapping(path).questions)
    except (UserError, OSError):
        return False


def safe_name(name: str) -> str:
    """A name for an uploaded flight: one part, no control characters, of a known ending; or UserError."""
    plain = unicodedata.normalize("NFC", name).replace("\\", "/").split("/")[-1]
    plain = re.sub(r"[^\w.+ ()-]", "_", plain).strip(" .")
    ending = ending_of(plain)
    if ending is None or len(plain) == len(ending):
        raise UserError(
            "this is not a flight file",
            where=name[:200],
            expected="a name that ends in " + ", ".join(ENDINGS),
        )
    if len(plain) > LONGEST_NAME:
        raise UserError("the name is too long", where=plain[:60] + "…", expected=f"{LONGEST_NAME} characters")
    return plain


def _kind(e: os.DirEntry[str]) -> str | None:
    if e.name.startswith("."):
        return None
    if e.is_dir():
        return "model" if Path(e.path, "model.toml").is_file() else "folder"
    if e.name.lower().endswith(".toml"):
        return "sheet"
    return "flight" if ending_of(e.name) else None


def _size(e: os.DirEntry[str]) -> int:
    try:
        return e.stat().st_size if e.is_file() else 0
    except OSError:
        return 0


class Cancelled(Exception):
    """The user does not want the result any more."""


class Busy(Exception):
    """Something else is being worked on."""


@dataclass(frozen=True)
class Status:
    """What the page shows: ``revision`` grows with the state alone, ``share`` is done (0 ... 1), ``error`` the last failure."""

    count: int = 0
    revision: int = 0
    name: str = ""
    share: float = 0.0
    began: float = 0.0
    error: dict[str, str | None] | None = None

    def as_json(self) -> dict[str, object]:
        spent = time.monotonic() - self.began if self.name else 0.0
        return {
            "count": self.count,
            "revision": self.revision,
            "job": self.name,
            "share": self.share,
            "spent_s": spent,
            "error": self.error,
        }


@dataclass
class Jobs:
    """One worker. Its status changes in its thread."""

    status: Status = field(default_factory=Status)
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _cancel: threading.Event = field(default_factory=threading.Event)
    _thread: threading.Thread | None = None

    def start(self, name: str, work: Callable[[Callable[[str, float], None]], None]) -> None:
        """Begin ``work``, which is given a function (what, samples of a pass) to announce its parts. Raises Busy."""
        with self._lock:
            if self._thread is not None and self._thread.is_alive() and self.status.name:
                raise Busy
            self._cancel.clear()
            self._tell(name=name, share=0.0, began=time.monotonic(), error=None)
            self._thread = threading.Thread(target=self._run, args=(work,), name="work", daemon=True)
            self._thread.start()

    def cancel(self) -> None:
        """Ask the work to end at its next step."""
        self._cancel.set()

    def wait(self, seconds: float) -> None:
        """Until the work has ended."""
        if self._thread is not None:
            self._thread.join(seconds)

    def changed(self) -> None:
        """Something that the page shows has changed."""
        self._tell(revision=self.status.revision + 1)

    def _tell(self, **changes: object) -> None:
        self.status = replace(self.status, count=self.status.count + 1, **changes)  # type: ignore[arg-type]

    def _run(self, work: Callable[[Callable[[str, float], None]], None]) -> None:
        total, done = 1.0, 0.0

        def step(amount: float) -> None:
            nonlocal done
            if self._cancel.is_set():
                raise Cancelled
            done += amount
            share = min(done / total, 0.99)
            if share - self.status.share > 0.01:
                self._tell(share=share)

        def part(name: str, amount: float) -> None:
            nonlocal total, done
            if self._cancel.is_set():
                raise Cancelled
            total, done = max(amount, 1.0), 0.0
            self._tell(name=name, share=0.0, began=time.monotonic())

        error: dict[str, str | None] | None = None
        try:
            with progress.listening(step):
                work(part)
        except Cancelled:
            error = {"what": "cancelled; nothing was changed"}
        except UserError as e:
            error = e.facts
        except OSError as e:
            error = {"what": e.strerror or "the system refuses", "where": _shown(e.filename)}
        except MemoryError:
            error = {"what": "there is not enough memory for this; nothing was changed"}
        except Exception:
            traceback.print_exc()
            error = {"what": "this is a fault of the program, not of your input; the terminal shows where"}
        finally:
            self._tell(name="", share=0.0, error=error)


def _shown(name: object) -> str | None:
    return None if name is None else one_line(str(name))
