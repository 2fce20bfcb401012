"""A survey: every flight diagnosed separately, on a pool of processes or on a Dask cluster, kept as it is done, and a summary."""

from __future__ import annotations

import contextlib
import hashlib
import importlib
import json
import logging
import multiprocessing
import os
import signal
import sys
import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import click

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import file_digest, locked, read_text
from ragg_runtime.base.progress import INTERVAL
from ragg_runtime.io.record import same_record
from ragg_runtime.survey.examine import (
    BETWEEN,
    CONTENT,
    Job,
    Record,
    examine,
    expand_lines,
    make_job,
    split_line,
)
from ragg_runtime.survey.result import Survey
from ragg_runtime.workspace import Loaded, mapping_of

Progress = Callable[[int, int, Record | None], None]
"""Called with the number of flights done, of all, and the record just made (``None`` at the beginning)."""

ATTEMPTS = 3
"""How often a flight is tried whose worker dies or runs out of memory."""

PATIENCE = 5.0
"""How long the scheduler of a cluster, and then its first worker, is waited for, s."""

AHEAD = 4
"""Flights that the scheduler knows for each thread of its workers: its memory does not grow with their number."""


def survey(
    m: Loaded,
    flights: Sequence[Path | str],
    *,
    jobs: int | None = None,
    scheduler: str | None = None,
    resume: Path | None = None,
    progress: Progress | None = None,
    mapping: Path | None = None,
) -> Survey:
    """Diagnose many flights separately, and summarise them; each line of a file that has several is a flight.

    Parameters
    ----------
    m
        The model.
    flights
        Files; the order does not matter, a file named twice counts once. One that cannot be read is listed as an error.
    jobs
        Processes on this machine (default: one per processor).
    scheduler
        Address of a dask.distributed scheduler, ``tcp://host:port``: its workers do it instead. What answers there
        can run code in this process: name addresses that you trust. Certificates are Dask's own configuration.
    resume
        Results file: what it holds is not done again (flights in error are), what is done is added.
    progress
        Called with the number of finished flights.
    mapping
        Description of the files' columns; default: the one kept with the model.

    Returns
    -------
        ``records``, one per flight in the order of their names, ``summary``, ``as_json()``.

    Raises
    ------
    UserError
        For bad input to the survey as a whole. A single flight that fails has its error in its record.
    """
    if not flights:
        raise UserError("a survey needs flights", expected="one file or more")
    if jobs is not None and scheduler is not None:
        raise UserError("a survey runs on this machine or on a cluster", found="--jobs and --scheduler")
    if jobs is not None and jobs < 1:
        raise UserError("a survey needs a worker", where="--jobs", found=jobs, expected="1 or more")
    how = mapping_of(m, mapping)
    job = make_job(
        m.directory.text,
        m.directory.path / "model.toml",
        cluster=scheduler is not None,
        mapping=None if how is None else (read_text(how.path), str(how.path.resolve()), how.kept),
    )
    files = expand_lines(job, order_files(flights))
    names = name_flights(files)
    with contextlib.nullcontext() if resume is None else open_journal(resume, job) as journal:
        records = {} if journal is None else journal.read(files)
        tell = progress or (lambda done, total, record: None)
        tell(len(records), len(files), None)
        left = [f for f in files if f not in records]
        with contextlib.closing(_examine_all(job, left, jobs, scheduler)) as found:
            for file, record in found:
                records[file] = record | {"flight": names[file]}
                if journal is not None:
                    journal.append(records[file])
                tell(len(records), len(files), records[file])
    # what was kept may have been named among other files
    return Survey(tuple(drop_repeated([records[f] | {"flight": names[f]} for f in files])))


def order_files(flights: Sequence[Path | str]) -> list[str]:
    """Absolute paths, each once, in the order of the names that the flights will have: what drifts is read in it."""
    names = name_flights([str(Path(f).resolve()) for f in flights])
    return sorted(names, key=lambda f: (names[f], f))


def name_flights(files: Sequence[str]) -> dict[str, str]:
    """File -> the flight's name: that of the file, with as many folders before it as distinguish it from all others."""
    split = {f: split_line(f) for f in files}
    left, depth = {path for path, _ in split.values()}, 0
    known: dict[Path, str] = {}
    while left:
        depth += 1
        count = Counter(p.parts[-depth:] for p in left)
        known |= {p: "/".join(p.parts[-depth:]) for p in left if count[p.parts[-depth:]] == 1}
        left -= known.keys()
    return {
        f: known[path] + ("" if line is None else f"{BETWEEN}{line}") for f, (path, line) in split.items()
    }


def drop_repeated(records: Sequence[Record]) -> Iterator[Record]:
    """The records; of those of one and the same record of an instrument the first, the others in error."""
    first: dict[str, str] = {}
    for r in records:
        same = r["file"] if CONTENT not in r else first.setdefault(r[CONTENT], r["file"])
        if same != r["file"]:
            error = {"kind": "input", "message": f"{r['file']}: {same_record(same)}"}
            yield {k: r[k] for k in ("flight", "file", "sha256")} | {"error": error}
        else:
            yield {k: v for k, v in r.items() if k != CONTENT}


def _examine_all(
    job: Job, files: Sequence[str], jobs: int | None, scheduler: str | None
) -> Generator[tuple[str, Record]]:
    """(file, record) of every flight as it is done; closing the iterator ends the work."""
    if not files:
        return
    if scheduler is not None:
        yield from examine_on_cluster(job, files, scheduler)
        return
    own = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    yield from examine_here(job, files, jobs or own)


def _run(pool: Executor, job: Job, waiting: deque[str], most: int) -> Generator[tuple[str, Future[Record]]]:
    """(file, future) of flights as they are done, ``most`` at a time: all that wait, or until a worker's death breaks the pool."""
    running: dict[Future[Record], str] = {}
    broken = False
    while not broken:
        while waiting and len(running) < most:
            file = waiting.popleft()
            running[pool.submit(examine, job, file)] = file
        if not running:
            return
        done = wait(running, return_when=FIRST_COMPLETED).done
        broken = any(not f.cancelled() and isinstance(f.exception(), BrokenProcessPool) for f in done)
        for future in wait(running).done if broken else done:
            yield running.pop(future), future


def _give_up(file: str, error: BaseException) -> Record:
    """The record of a flight on which every attempt failed."""
    what = f"{type(error).__name__}: {error}"
    if type(error).__name__ in ("BrokenProcessPool", "KilledWorker"):
        what = "the worker process died (out of memory, or killed)"
    message = f"{file}: {what}, {ATTEMPTS} times"
    return {"flight": os.path.basename(file), "file": file, "error": {"kind": "lost", "message": message}}


# --- on this machine -----------------------------------------------------------------------------------


def examine_here(job: Job, files: Sequence[str], jobs: int) -> Generator[tuple[str, Record]]:
    """(file, record) of every flight as it is done, on a pool of processes.

    Flights at which a worker died are tried again at the end, each alone: so it is plain which of them it was.
    """
    failed: dict[str, BaseException] = {}

    def attempt(waiting: deque[str], most: int) -> Generator[tuple[str, Record]]:
        while waiting:  # a pool that breaks is replaced
            with _open_pool(most) as pool:
                # no more than there are workers: what is running when one dies is what it may have died of
                for file, future in _run(pool, job, waiting, most):
                    error = future.exception()
                    if error is None:
                        failed.pop(file, None)
                        yield file, future.result()
                    else:
                        failed[file] = error

    yield from attempt(deque(files), min(jobs, len(files)))
    for _ in range(ATTEMPTS - 1):
        for file in list(failed):
            yield from attempt(deque([file]), 1)
    for file, error in failed.items():
        yield file, _give_up(file, error)


@contextlib.contextmanager
def _open_pool(jobs: int) -> Iterator[ProcessPoolExecutor]:
    """A pool of processes that are there already, and have inherited no Ctrl-C: that is the parent's. At the end they are killed."""
    context = multiprocessing.get_context("spawn")  # the same on every system; no locks are inherited
    pool = ProcessPoolExecutor(jobs, context, initializer=_begin)
    masks = hasattr(signal, "pthread_sigmask")
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT]) if masks else None
    try:
        started = [pool.submit(os.getpid) for _ in range(jobs)]
        if mask is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        if isinstance(started[0].exception(), BrokenProcessPool):
            raise UserError(
                "no worker process can be started",
                expected="a program that can be imported: workers begin by importing it",
                remedy="in a script of your own, call survey below `if __name__ == '__main__':`",
            )
        yield pool
    finally:
        for p in list((getattr(pool, "_processes", None) or {}).values()):
            with contextlib.suppress(ValueError, OSError):
                p.kill()
        pool.shutdown(wait=True, cancel_futures=True)


def _begin() -> None:
    """First call in a worker: Ctrl-C is the parent's; a worker does not outlive its parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def follow() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=follow, daemon=True).start()


# --- on a cluster --------------------------------------------------------------------------------------


def examine_on_cluster(job: Job, files: Sequence[str], address: str) -> Generator[tuple[str, Record]]:
    """(file, record) of every flight as it is done. Raises UserError if the cluster cannot be used, or is lost."""
    with _connect(address) as client:
        with contextlib.suppress(Exception):
            client.wait_for_workers(1, timeout=PATIENCE)
        threads = sum(client.nthreads().values())
        if not threads:
            raise UserError(
                "the cluster has no workers", where=address, remedy="start some: dask worker ADDRESS"
            )
        pool = client.get_executor(pure=False, retries=ATTEMPTS - 1)
        for file, future in _run(pool, job, deque(files), AHEAD * threads):
            if future.cancelled():
                raise UserError(
                    "the connection to the scheduler is lost",
                    where=address,
                    remedy="survey again with the same --resume file: finished flights are kept",
                )
            error = future.exception()
            yield file, future.result() if error is None else _give_up(file, error)


@contextlib.contextmanager
def _connect(address: str) -> Iterator[Any]:
    """Dask's client of the scheduler; what Dask logs is reported here, in one message."""
    try:
        distributed: Any = importlib.import_module("distributed")
    except ImportError:
        raise UserError(
            "a survey on a cluster needs Dask",
            where="--scheduler",
            found="no package distributed",
            remedy="pip install 'ragg[cluster]'; or leave --scheduler out: the survey then runs on this machine",
        ) from None
    log = logging.getLogger("distributed")
    level, client = log.level, None
    log.setLevel(logging.CRITICAL)
    try:
        try:
            client = distributed.Client(address, timeout=PATIENCE, set_as_default=False, name="ragg-survey")
        except Exception as error:
            raise UserError(
                "the scheduler cannot be reached",
                where=address,
                found=f"{type(error).__name__}: {error}"[:300],
                expected="a dask.distributed scheduler, tcp://host:port or tls://host:port, as it prints its address",
                remedy="check the address and that the scheduler runs; Dask must be of the same version there",
            ) from None
        yield client
    finally:
        if client is not None:
            with contextlib.suppress(Exception):
                client.close(timeout=PATIENCE)
        log.setLevel(level)


# --- progress ------------------------------------------------------------------------------------------


def show_progress() -> Progress:
    """Lines on stderr, now and then: flights done, in error, and the time left; on a terminal one line, again and again."""
    start = last = time.monotonic()
    before = failed = 0
    terminal = sys.stderr.isatty()

    def show(done: int, total: int, record: Record | None) -> None:
        nonlocal last, before, failed
        now = time.monotonic()
        if record is None:
            before = done
            click.echo(f"... {total} flights{f', {done} of them done before' if done else ''}", err=True)
            return
        failed += "verdict" not in record
        if terminal or now - last >= INTERVAL or done == total:
            last = now
            left = (now - start) / max(done - before, 1) * (total - done)
            text = f"... {done} of {total}{f', {failed} in error' if failed else ''}, {left:.0f} s left"
            click.echo(f"\r{text}\033[K" if terminal else text, err=True, nl=not terminal or done == total)

    return show


# --- the results file --------------------------------------------------------------------------------


KIND = "ragg survey"

PARTS = {
    "model": "model.toml",
    "program": "version of the program",
    "mapping": "mapping of the flights' columns",
}
"""What must be the same for figures to be in one table, by its key in the first line of a results file."""


def make_head(job: Job) -> Record:
    """The first line of a results file: figures under the same head may be in one table."""
    digests = {"model": job.text} | ({} if job.mapping is None else {"mapping": job.mapping[0]})
    head = {name: hashlib.sha256(text.encode()).hexdigest() for name, text in digests.items()}
    return {"kind": KIND, "program": dict(job.program), **head}


@dataclass(frozen=True)
class Journal:
    """An open results file."""

    path: Path
    stream: IO[bytes]
    head: Record

    def append(self, record: Record) -> None:
        """Add a record; on return it is on the disc."""
        self._write({"record": record})

    def _write(self, content: Record) -> None:
        text = json.dumps(content, allow_nan=False, separators=(",", ":"))
        with _writing(self.path):
            self.stream.write(f"{text}\n".encode())
            self.stream.flush()
            os.fsync(self.stream.fileno())

    def read(self, files: Sequence[str]) -> dict[str, Record]:
        """Records that still hold, by file: same model, program and content, no error. UserError for another survey's."""
        self.stream.seek(0)
        text = self.stream.read()
        whole = text[: text.rfind(b"\n") + 1]  # a line that was cut off is done again
        lines = [self._parse(line) for line in whole.splitlines()]
        if text and (not lines or lines[0].get("kind") != KIND):
            raise self._refuse(text)
        if lines:
            self._require_same(lines[0])
            self.stream.truncate(len(whole))
        else:
            self._write(self.head)
        records = {r["file"]: r for r in (x.get("record", {}) for x in lines[1:]) if "verdict" in r}
        return {f: records[f] for f in files if f in records and records[f]["sha256"] == digest_file(f)}

    def _require_same(self, found: Mapping[str, Any]) -> None:
        for key, what in PARTS.items():
            if found.get(key) != self.head.get(key):
                raise UserError(
                    f"these results are of another {what}",
                    where=self.path,
                    found=found.get(key, "none"),
                    expected=self.head.get(key, "none"),
                    remedy="name another results file: the results would not be comparable",
                )

    def _parse(self, line: bytes) -> Record:
        try:
            record = json.loads(line)
        except (ValueError, RecursionError):
            record = None
        if not isinstance(record, dict):
            raise self._refuse(line)
        return record

    def _refuse(self, found: bytes) -> UserError:
        return UserError(
            "not a results file of a survey",
            where=self.path,
            found=found[:80].decode(errors="replace"),
            expected="a file that `ragg survey --resume` has written, or none",
            remedy="name another file",
        )


def digest_file(file: str) -> str | None:
    """Digest of a file, as a flight's (also of ``file::line``); ``None`` if it cannot be read."""
    try:
        return file_digest(split_line(file)[0])
    except (OSError, UserError):
        return None


@contextlib.contextmanager
def _writing(path: Path) -> Iterator[None]:
    """Turn what goes wrong with a results file into one message."""
    try:
        yield
    except TimeoutError:
        remedy = "wait until it has ended, or name another file"
        raise UserError("another survey is writing to this results file", where=path, remedy=remedy) from None
    except OSError as error:
        remedy = "name a file in a folder that exists and that you may write to"
        raise UserError(
            "the results file cannot be written", where=path, found=error.strerror, remedy=remedy
        ) from None


@contextlib.contextmanager
def open_journal(path: Path, job: Job) -> Iterator[Journal]:
    """Open or make a results file; UserError if that cannot be done or another survey is writing to it."""
    with contextlib.ExitStack() as held:
        with _writing(path):
            if path.exists() and not path.is_file():
                raise OSError(22, "it is not a regular file")
            stream = held.enter_context(path.open("a+b"))
            held.enter_context(locked(path, 0.0))
        yield Journal(path, stream, make_head(job))
