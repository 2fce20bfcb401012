"""A pool of processes on this machine.

Every worker is a pool of one: if it dies (out of memory, killed, a fault in a library) it is plain which
flight it was at, the others go on, and the flight is done again by a new one.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import queue
import signal
import threading
from collections import deque
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import Any

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.process import ONE_THREAD, reuse_memory
from ragg_runtime.survey.task import Job, Record, examine

ATTEMPTS = 3
"""How often a flight is tried whose worker dies or runs out of memory."""

_SAFE_PATH = "PYTHONSAFEPATH"
"""Set for processes that this program starts: they do not look into the current folder at all."""


def processors() -> int:
    """Processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def examined(job: Job, files: Sequence[str], jobs: int) -> Generator[tuple[str, Record]]:
    """(file, record) of every flight, in the order in which they are done.

    Raises UserError if no worker can be started. Closing the iterator ends the workers.
    """
    waiting = deque((file, 1) for file in files)
    done: queue.Queue[tuple[_Worker, str, int, Future[Record]]] = queue.Queue()
    workers = [_Worker() for _ in range(min(jobs, len(files)))]
    busy = 0
    try:
        for w in workers:
            w.give(job, *waiting.popleft(), done)
            busy += 1
        while busy:
            w, file, attempt, future = done.get()
            busy -= 1
            error = future.exception()
            if error is None:
                yield file, future.result()
            elif isinstance(error, BrokenProcessPool) and not w.started:
                waiting.appendleft((file, attempt))  # the flight has nothing to do with it
            elif attempt < ATTEMPTS:
                waiting.append((file, attempt + 1))
            else:
                yield file, lost(file, error)
            if isinstance(error, BrokenProcessPool):
                w.renew()
            if waiting:
                w.give(job, *waiting.popleft(), done)
                busy += 1
    finally:
        for w in workers:
            w.end()


def lost(file: str, error: BaseException) -> Record:
    """The record of a flight on which every attempt failed."""
    what = (
        "the worker process died (out of memory, or killed)"
        if isinstance(error, BrokenProcessPool)
        else f"{type(error).__name__}: {error}"
    )
    message = f"{file}: {what}, {ATTEMPTS} times"
    return {"flight": os.path.basename(file), "file": file, "error": {"kind": "lost", "message": message}}


class _Worker:
    """A pool of one process."""

    def __init__(self) -> None:
        self.failed_starts = 0
        self._start()

    @property
    def started(self) -> bool:
        """Whether the process has come as far as to work."""
        return self.ready.done() and self.ready.exception() is None

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")  # the same on every system; no locks are inherited
        with _inherited():
            self.pool = ProcessPoolExecutor(1, context, initializer=_begin)
            self.ready = self.pool.submit(os.getpid)

    def renew(self) -> None:
        """A new process in place of a dead one; UserError if none comes as far as to work."""
        self.failed_starts = 0 if self.started else self.failed_starts + 1
        if self.failed_starts >= ATTEMPTS:
            raise UserError(
                "no worker process can be started",
                expected="a program that can be imported: workers begin by importing it",
                remedy="in a script of your own, call survey below `if __name__ == '__main__':`",
            )
        self.pool.shutdown(wait=True)
        self._start()

    def give(self, job: Job, file: str, attempt: int, done: queue.Queue[Any]) -> None:
        """Let the process look at a flight; ``done`` gets (worker, file, attempt, future)."""
        while True:
            try:
                future = self.pool.submit(examine, job, file)
                break
            except BrokenProcessPool:  # died while it had nothing to do
                self.renew()
        future.add_done_callback(lambda f: done.put((self, file, attempt, f)))

    def end(self) -> None:
        """End the process, whatever it is at: what it has done is here, and to tidy up takes it half a second."""
        processes: dict[int, Any] = dict(getattr(self.pool, "_processes", None) or {})
        for p in processes.values():
            with contextlib.suppress(ValueError, OSError):
                p.kill()
        self.pool.shutdown(wait=True, cancel_futures=True)


@contextlib.contextmanager
def _inherited() -> Iterator[None]:
    """What a new process inherits: linear algebra on one thread, no Ctrl-C (that is the parent's), a safe path.

    Python would let it look for its own modules in the current folder first, whoever's that is. Once it is up,
    it imports from where this process does.
    """
    old = {name: os.environ.get(name) for name in (*ONE_THREAD, _SAFE_PATH)}
    os.environ.update(dict.fromkeys(old, "1"))
    mask = (
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
        if hasattr(signal, "pthread_sigmask")
        else None
    )
    try:
        yield
    finally:
        if mask is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for name, value in old.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _begin() -> None:
    """First call in a worker: Ctrl-C is the parent's; a worker does not outlive its parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    reuse_memory()
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_follow, args=(parent,), daemon=True).start()


def _follow(parent: Any) -> None:
    parent.join()
    os._exit(1)
