"""A pool of processes on this machine, each a pool of one: if it dies, it is plain which flight it was at."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import queue
import signal
import threading
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from typing import Any

from ragg_runtime.base.errors import UserError
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
    """(file, record) of every flight as it is done; closing the iterator ends the workers. Raises UserError."""
    pools: queue.Queue[ProcessPoolExecutor] = queue.Queue()
    started: list[ProcessPoolExecutor] = []
    ended = threading.Event()

    def start() -> ProcessPoolExecutor:
        started.append(_pool())
        return started[-1]

    def record(file: str) -> Record:
        error: BaseException
        for _ in range(ATTEMPTS):
            pool = pools.get()
            try:
                return pool.submit(examine, job, file).result()
            except BrokenProcessPool as died:
                error = died
                if not ended.is_set():
                    pool = start()
            except Exception as failed:
                error = failed
            finally:
                pools.put(pool)
        return lost(file, error)

    try:
        count = min(jobs, len(files))
        for _ in range(count):
            pools.put(start())
        _try(started[0])
        with ThreadPoolExecutor(count) as threads:
            try:
                futures = {threads.submit(record, file): file for file in files}
                for future in as_completed(futures):
                    yield futures[future], future.result()
            finally:
                ended.set()
                threads.shutdown(wait=False, cancel_futures=True)
                _end(started)  # which lets the threads go on
    finally:
        _end(started)


def lost(file: str, error: BaseException) -> Record:
    """The record of a flight on which every attempt failed."""
    what = (
        "the worker process died (out of memory, or killed)"
        if isinstance(error, BrokenProcessPool)
        else f"{type(error).__name__}: {error}"
    )
    message = f"{file}: {what}, {ATTEMPTS} times"
    return {"flight": os.path.basename(file), "file": file, "error": {"kind": "lost", "message": message}}


def _pool() -> ProcessPoolExecutor:
    """A pool of one process, which is there already."""
    context = multiprocessing.get_context("spawn")  # the same on every system; no locks are inherited
    with _inherited():
        pool = ProcessPoolExecutor(1, context, initializer=_begin)
        pool.submit(os.getpid)
    return pool


def _try(pool: ProcessPoolExecutor) -> None:
    """UserError if the process does not come as far as to work."""
    try:
        pool.submit(os.getpid).result()
    except BrokenProcessPool:
        raise UserError(
            "no worker process can be started",
            expected="a program that can be imported: workers begin by importing it",
            remedy="in a script of your own, call survey below `if __name__ == '__main__':`",
        ) from None


def _end(pools: Sequence[ProcessPoolExecutor]) -> None:
    """End processes, whatever they are at: what they have done is here, and to tidy up takes them half a second."""
    for pool in list(pools):
        processes: dict[int, Any] = dict(getattr(pool, "_processes", None) or {})
        for p in processes.values():
            with contextlib.suppress(ValueError, OSError):
                p.kill()
        pool.shutdown(wait=True, cancel_futures=True)


@contextlib.contextmanager
def _inherited() -> Iterator[None]:
    """What a new process inherits: no Ctrl-C (that is the parent's), and no imports from the current folder."""
    old = os.environ.get(_SAFE_PATH)
    os.environ[_SAFE_PATH] = "1"
    masks = hasattr(signal, "pthread_sigmask")
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT]) if masks else None
    try:
        yield
    finally:
        if mask is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        if old is None:
            del os.environ[_SAFE_PATH]
        else:
            os.environ[_SAFE_PATH] = old


def _begin() -> None:
    """First call in a worker: Ctrl-C is the parent's; a worker does not outlive its parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_follow, args=(parent,), daemon=True).start()


def _follow(parent: Any) -> None:
    parent.join()
    os._exit(1)
