"""What the studio has open, and its results: one state, replaced whole, that every page shows."""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ragg_runtime import api
from ragg_runtime.api import Held, Loaded
from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io import Flight
from ragg_runtime.model.directory import HistoryStep, load_model_dir
from ragg_runtime.studio.files import Places
from ragg_runtime.studio.mapping import is_foreign

Say = Callable[[str], None]  # says what is being worked on

NOTHING: Mapping[str, None] = MappingProxyType(dict.fromkeys(("compared", "diagnosed", "held", "previous")))
"""What is known of another model or other flights."""


@dataclass(frozen=True)
class State:
    """What is open, and its results; ``None`` or empty where there is none yet.

    ``read``: the flights as they were read; ``cuts``: the segments (from, to, s) of each that are left out; ``kept``: those
    that are kept for validation. ``compared``, ``diagnosed``: results for the other flights; ``held``: how their calibration
    holds on those kept. ``previous``: the comparison before the last step.
    """

    loaded: Loaded | None = None
    paths: tuple[Path, ...] = ()
    flights: tuple[Flight, ...] = ()
    read: tuple[Flight, ...] = ()
    cuts: tuple[tuple[tuple[float, float], ...], ...] = ()
    kept: frozenset[int] = frozenset()
    compared: Comparison | None = None
    diagnosed: Diagnosis | None = None
    held: Held | None = None
    previous: Comparison | None = None

    def require(self, name: str) -> Any:
        """A result of the state by name; UserError if there is none yet."""
        result = getattr(self, name)
        if result is None:
            raise UserError("there is no result yet", remedy=REMEDIES[name])
        return result

    @property
    def model(self) -> Loaded:
        """The model; UserError if none is open."""
        if self.loaded is None:
            remedy = "choose a model directory, or make one from a test sheet"
            raise UserError("no model is open", remedy=remedy)
        return self.loaded

    @property
    def fitted(self) -> tuple[Flight, ...]:
        """The flights that are not kept for validation; UserError if no flight is open."""
        if not self.flights:
            raise UserError("no flight is open", remedy="choose one first")
        return tuple(x for n, x in enumerate(self.flights) if n not in self.kept)

    def result_for(self, flight: int) -> tuple[Comparison, int]:
        """The comparison with a flight, and its number there; flights kept for validation have that of the others' calibration."""
        if self.held is None or flight not in self.kept:
            return self.require("compared"), flight - sum(n < flight for n in self.kept)
        return self.held.comparison, sorted(self.kept).index(flight)


REMEDIES = {
    "compared": "open a flight and wait until it is compared",
    "diagnosed": "wait until every effect is tested",
    "previous": "derive an effect into the model first",
}


class Session:
    """The state and the only ways to change it; long ones run as jobs."""

    def __init__(self, places: Places) -> None:
        self.places = places
        self.jobs = Jobs()
        self.state = State()
        self._lock = threading.Lock()

    def _put(self, **changes: object) -> None:
        with self._lock:
            self.state = replace(self.state, **changes)  # type: ignore[arg-type]
        self.jobs.tell_change()

    def _forget(self, **changes: object) -> None:
        self._put(**{**NOTHING, **changes})

    def open(self, model: Path | None, flights: Sequence[Path]) -> None:
        """Open a model directory and flights (``None``, none: those that are open stay), and look at them."""

        def work(say: Say) -> None:
            if model is not None:
                self._forget(loaded=api.load(model))
            if flights:
                self._forget(paths=tuple(flights), flights=(), read=(), cuts=(), kept=frozenset())
                say("reading and examining the flights")
                try:
                    records = tuple(api.read_flights(self.state.model, flights))
                except UserError:
                    if any(is_foreign(self.state.model, p) for p in flights):
                        return  # the page asks what the columns are
                    raise
                places = tuple(
                    x.path or flights[0] for x in records
                )  # a file of several lines is as many flights
                self._put(paths=places, flights=records, read=records, cuts=((),) * len(records))
            self._look(say)

        self.jobs.start("opening", work)

    def new(self, model: Path, sheet: Path | None) -> None:
        """Make a model directory from a test sheet, and open it."""
        api.new(model, sheet)
        self.open(model, ())

    def leave_out(self, flight: int, segment: tuple[float, float] | None) -> None:
        """Leave a segment of a flight (from, to, s) out of everything; ``None``: take all of it back."""
        s = self._idle(flight)
        cuts = list(s.cuts)
        cuts[flight] = () if segment is None else (*cuts[flight], segment)
        flights = tuple(x.without(c) for x, c in zip(s.read, cuts, strict=True))
        if not any(flights[flight].valid):
            raise UserError("nothing of the flight would be left", where=s.read[flight].name)
        self._forget(flights=flights, cuts=tuple(cuts))
        self.look()

    def keep_for_validation(self, flight: int) -> None:
        """Keep a flight out of the calibration; one that is kept already is fitted again."""
        s = self._idle(flight)
        kept = s.kept ^ {flight}
        if len(kept) == len(s.flights):
            raise UserError("one flight at least is needed to calibrate", remedy="open another flight")
        self._forget(kept=kept)
        self.look()

    def look(self) -> None:
        """Compare and diagnose what is open."""
        self.jobs.start("looking", self._look)

    def _look(self, say: Say) -> None:
        s = self.state
        if s.loaded is None or not s.flights:
            return
        if s.compared is None:
            say("calibrating and comparing")
            self._put(compared=api.compare(s.loaded, s.fitted))
        compared = self.state.require("compared")
        if s.kept:
            say("validating")
            others = [s.flights[n] for n in sorted(s.kept)]
            self._put(held=api.validate(s.loaded, compared, s.fitted, others))
        say("testing every effect")
        self._put(diagnosed=api.diagnose(s.loaded, s.fitted, compared=compared))

    def reread(self) -> None:
        """Load the model directory again if someone else has changed it."""
        m = self.state.loaded
        if m is None or self.jobs.status.job:
            return
        if load_model_dir(m.directory.path).digest != m.directory.digest:
            self._change(api.load(m.directory.path))

    def _change(self, m: Loaded) -> None:
        """Replace the model; its comparison becomes the previous one."""
        self._forget(previous=self.state.compared, loaded=m)
        self.look()

    def add(self, effects: Sequence[str]) -> None:
        """Derive effects into the model, one after the other, and calibrate."""
        if not effects:
            raise UserError("no effect is chosen", remedy="tick one or several")
        m = self.state.model

        def work(say: Say) -> None:
            # the page keeps the old state until all is done, and sees the error fall
            s, extended = self.state, m
            flights = s.fitted if s.flights else ()
            for e in effects:
                say(f"deriving {e} and calibrating")
                extended = api.add(extended, e, flights).loaded
            say("calibrating and comparing")
            compared = api.compare(extended, flights) if flights else None
            self._forget(previous=s.compared, compared=compared, loaded=extended)
            self._look(say)

        self.jobs.start(f"deriving {effects[0]} into {m.name}", work)

    def remove(self, effect: str) -> None:
        """Remove an effect from the model."""
        self._idle()
        self._change(api.remove(self.state.model, effect))

    def edit(self, text: str) -> None:
        """Put another text in the place of model.toml."""
        self._idle()
        m = self.state.model
        if text == m.directory.text:
            raise UserError("nothing was changed", remedy="change the text, then save")
        self._change(api.change(m, text, "edit"))

    def undo(self) -> None:
        """Go back to the state before the present one."""
        self._idle()
        m, history = self.state.model, self.state.model.directory.history
        path = list_present(history)
        if len(path) < 2 or not history[path[-2]].text:
            raise UserError("there is nothing to undo")
        self._change(api.change(m, history[path[-2]].text, "undo", str(path[-2])))

    def _idle(self, flight: int | None = None) -> State:
        """The state, if nothing is being worked on (else Busy) and there is such a flight (else UserError)."""
        if self.jobs.status.job:
            raise Busy
        if flight is not None and not 0 <= flight < len(self.state.read):
            raise UserError("there is no such flight", found=str(flight + 1))
        return self.state


def list_present(history: Sequence[HistoryStep]) -> list[int]:
    """The steps that lead to the present state, by their numbers: an undo takes the last of them back."""
    path: list[int] = []
    for n, s in enumerate(history):
        if s.action == "undo":
            path = path[:-1]
        elif s.action != "calibrate":  # which leaves the model as it is
            path.append(n)
    return path


# --- jobs ----------------------------------------------------------------------------------------------


class Cancelled(Exception):
    """The user does not want the result any more."""


class Busy(Exception):
    """Something else is being worked on."""


@dataclass(frozen=True)
class Status:
    """What the page shows: ``revision`` grows with the state alone, ``job`` is worked on, ``error`` the last failure."""

    count: int = 0
    revision: int = 0
    job: str = ""
    error: dict[str, str | None] | None = None


def describe_failure(error: Exception) -> dict[str, str | None]:
    """What went wrong, and where, by name; a fault of the program also goes to the terminal."""
    match error:
        case UserError():
            return error.facts
        case OSError():
            where = None if error.filename is None else one_line(str(error.filename))
            return {"what": error.strerror or "the system refused", "where": where}
        case MemoryError():
            return {"what": "there is not enough memory; nothing was changed"}
    traceback.print_exception(error)
    return {"what": "this is a fault of the program, not of your input; see the terminal"}


class Jobs:
    """One worker. Its status changes in its thread."""

    def __init__(self) -> None:
        self.status = Status()
        self._lock = threading.Lock()
        self._cancel = threading.Event()
        self._thread: threading.Thread | None = None

    def start(self, name: str, work: Callable[[Say], None]) -> None:
        """Begin ``work``, which is given a function to say what it does. Raises Busy."""
        with self._lock:
            if self._thread is not None and self._thread.is_alive() and self.status.job:
                raise Busy
            self._cancel.clear()
            self._tell(job=name, error=None)
            self._thread = threading.Thread(target=self._run, args=(work,), name="work", daemon=True)
            self._thread.start()

    def cancel(self) -> None:
        """Ask the work to end at its next step."""
        self._cancel.set()

    def wait(self, seconds: float) -> None:
        """Until the work has ended."""
        if self._thread is not None:
            self._thread.join(seconds)

    def tell_change(self) -> None:
        """Something that the page shows has changed."""
        self._tell(revision=self.status.revision + 1)

    def _tell(self, **changes: object) -> None:
        self.status = replace(self.status, count=self.status.count + 1, **changes)  # type: ignore[arg-type]

    def _run(self, work: Callable[[Say], None]) -> None:
        def go_on() -> None:
            if self._cancel.is_set():
                raise Cancelled

        def say(name: str) -> None:
            go_on()
            self._tell(job=name)

        error: dict[str, str | None] | None = None
        try:
            with progress.listening(lambda amount: go_on()):
                work(say)
        except Cancelled:
            error = {"what": "cancelled; nothing was changed"}
        except Exception as e:
            error = describe_failure(e)
        finally:
            self._tell(job="", error=error)
