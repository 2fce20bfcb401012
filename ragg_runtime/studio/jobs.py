"""Long work beside the server: one thing at a time, with its progress; it can be cancelled and leaves nothing half done."""

from __future__ import annotations

import threading
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError, one_line


class Cancelled(Exception):
    """The user does not want the result any more."""


class Busy(Exception):
    """Something else is being worked on."""


@dataclass(frozen=True)
class Status:
    """What the page shows: a count that grows with every change, and what is being worked on.

    ``revision`` grows with the state alone, not with progress; ``share`` is done of it (0 ... 1),
    ``error`` are the facts of the last failure.
    """

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
    """One worker. ``told`` is called, in its thread, whenever the status changes."""

    status: Status = field(default_factory=Status)
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _cancel: threading.Event = field(default_factory=threading.Event)
    _thread: threading.Thread | None = None

    def start(self, name: str, work: Callable[[Callable[[str, float], None]], None]) -> None:
        """Begin ``work``, which is given a function (what, how much in samples of a pass) to announce its parts.

        Raises Busy if something is being worked on.
        """
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
            facts = ("what", "where", "found", "expected", "remedy")
            error = {k: getattr(e, k) for k in facts}
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
