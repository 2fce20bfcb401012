"""A survey: every flight diagnosed by itself, on this machine or on a Dask cluster, and what they say together."""

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
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from functools import partial
from itertools import islice
from pathlib import Path
from typing import IO, Any

import click

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import file_digest
from ragg_runtime.base.progress import INTERVAL
from ragg_runtime.io.record import same_record
from ragg_runtime.survey.result import Survey
from ragg_runtime.survey.task import (
    BETWEEN,
    CONTENT,
    Job,
    Record,
    divided,
    examine,
    expanded,
    job,
)

Progress = Callable[[int, int, Record | None], None]
"""Called with the number of flights done, of all, and the record just made (``None`` at the beginning)."""

ATTEMPTS = 3
"""How often a flight is tried whose worker dies or runs out of memory."""


def survey(
    text: str,
    path: Path,
    flights: Sequence[Path | str],
    *,
    jobs: int | None = None,
    scheduler: str | None = None,
    resume: Path | None = None,
    progress: Progress | None = None,
    mapping: tuple[str, str, bool] | None = None,
) -> Survey:
    """Diagnose flights one by one; each line of a file that has several is a flight.

    Parameters
    ----------
    text, path
        model.toml and where it is.
    flights
        Files; the order does not matter, a file named twice counts once.
    jobs
        Worker processes on this machine (default: one per processor).
    scheduler
        Address of a dask.distributed scheduler, ``tcp://host:port``: its workers do it instead. What answers there
        can run code in this process: name addresses that you trust. Certificates are Dask's own configuration.
    resume
        Results file: what it holds is not done again (flights in error are), what is done is added.
    mapping
        Text and place of the mapping by which flights are read, and whether it is the model's own.

    Returns
    -------
    Survey
        A record per flight, in the order of their names, and their summary.

    Raises
    ------
    UserError
        For bad input to the survey as a whole. A single flight that fails has its error in its record.
    """
    _check(flights, jobs, scheduler)
    given = job(text, path, cluster=scheduler is not None, mapping=mapping)
    files = expanded(given, ordered(flights))
    names = distinct_names(files)
    records: dict[str, Record] = {}
    with contextlib.nullcontext() if resume is None else open_journal(resume) as journal:
        if journal is not None:
            records |= journal.read(given, files)
        if progress is not None:
            progress(len(records), len(files), None)
        left = [f for f in files if f not in records]
        if left:
            found = (
                examine_here(given, left, jobs or processors())
                if scheduler is None
                else examine_on_cluster(given, left, scheduler)
            )
            with contextlib.closing(found):
                for file, record in found:
                    records[file] = record = record | {"flight": names[file]}
                    if journal is not None:
                        journal.append(record)
                    if progress is not None:
                        progress(len(records), len(files), record)
    # what was kept may have been named among other files
    return Survey(tuple(once([records[f] | {"flight": names[f]} for f in files])))


def _check(flights: Sequence[Path | str], jobs: int | None, scheduler: str | None) -> None:
    if not flights:
        raise UserError("a survey needs flights", expected="one file or more")
    if jobs is not None and scheduler is not None:
        raise UserError("a survey runs on this machine or on a cluster", found="--jobs and --scheduler")
    if jobs is not None and jobs < 1:
        raise UserError("a survey needs a worker", where="--jobs", found=jobs, expected="1 or more")


def once(records: Sequence[Record]) -> Iterator[Record]:
    """The records; of those of one and the same record of an instrument the first, the others in error."""
    first: dict[str, str] = {}
    for r in records:
        same = r["file"] if CONTENT not in r else first.setdefault(r[CONTENT], r["file"])
        if same != r["file"]:
            error = {"kind": "input", "message": f"{r['file']}: {same_record(same)}"}
            yield {k: r[k] for k in ("flight", "file", "sha256")} | {"error": error}
        else:
            yield {k: v for k, v in r.items() if k != CONTENT}


def distinct_names(files: Sequence[str]) -> dict[str, str]:
    """File -> the flight's name: that of the file, with as many folders before it as distinguish it from all others."""
    split = {f: divided(f) for f in files}
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


def ordered(flights: Sequence[Path | str]) -> list[str]:
    """Absolute paths, each once, in the order of the names that the flights will have: what drifts is read in it."""
    names = distinct_names([str(Path(f).resolve()) for f in flights])
    return sorted(names, key=lambda f: (names[f], f))


def sha256(path: Path) -> str | None:
    """Digest of a file, as a flight's (also of ``file::line``); ``None`` if it cannot be read."""
    try:
        return file_digest(divided(str(path))[0])
    except (OSError, UserError):
        return None


def lost(file: str, error: BaseException) -> Record:
    """The record of a flight on which every attempt failed."""
    what = f"{type(error).__name__}: {error}"
    if isinstance(error, BrokenProcessPool) or type(error).__name__ == "KilledWorker":
        what = "the worker process died (out of memory, or killed)"
    message = f"{file}: {what}, {ATTEMPTS} times"
    return {"flight": os.path.basename(file), "file": file, "error": {"kind": "lost", "message": message}}


# --- on this machine


def processors() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def examine_here(given: Job, files: Sequence[str], jobs: int) -> Generator[tuple[str, Record]]:
    """(file, record) of every flight as it is done, on a pool of processes; closing the iterator ends them.

    Flights at which a worker died are tried again at the end, each alone: so it is plain which of them it was.
    """
    again: dict[str, BaseException] = {}
    yield from _pooled(given, files, min(jobs, len(files)), again)
    for file in list(again):
        for _ in range(ATTEMPTS - 1):
            failed: dict[str, BaseException] = {}
            yield from _pooled(given, [file], 1, failed)
            if not failed:
                break
        else:
            yield file, lost(file, failed[file])


def _pooled(
    given: Job, files: Sequence[str], jobs: int, failed: dict[str, BaseException]
) -> Generator[tuple[str, Record]]:
    """The flights that a pool gets done; ``failed`` takes the others."""
    waiting, pool = iter(files), _new_pool(jobs)
    try:
        _try(pool)
        at: dict[Future[Record], str] = {}
        while True:
            # no more than there are workers: what is in the air when one dies is what it may have died of
            at |= {pool.submit(examine, given, f): f for f in islice(waiting, jobs - len(at))}
            if not at:
                return
            done = wait(at, return_when=FIRST_COMPLETED).done
            broken = any(isinstance(f.exception(), BrokenProcessPool) for f in done)
            for future in wait(at).done if broken else done:
                file, error = at.pop(future), future.exception()
                if error is None:
                    yield file, future.result()
                else:
                    failed[file] = error
            if broken:
                _end(pool)
                pool = _new_pool(jobs)
    finally:
        _end(pool)


def _new_pool(jobs: int) -> ProcessPoolExecutor:
    """A pool of processes that are there already, and have inherited no Ctrl-C: that is the parent's."""
    context = multiprocessing.get_context("spawn")  # the same on every system; no locks are inherited
    masks = hasattr(signal, "pthread_sigmask")
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT]) if masks else None
    try:
        pool = ProcessPoolExecutor(jobs, context, initializer=_begin)
        for _ in range(jobs):
            pool.submit(os.getpid)
        return pool
    finally:
        if mask is not None:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)


def _try(pool: ProcessPoolExecutor) -> None:
    """UserError if no process comes as far as to work."""
    try:
        pool.submit(os.getpid).result()
    except BrokenProcessPool:
        raise UserError(
            "no worker process can be started",
            expected="a program that can be imported: workers begin by importing it",
            remedy="in a script of your own, call survey below `if __name__ == '__main__':`",
        ) from None


def _end(pool: ProcessPoolExecutor) -> None:
    """End the processes, whatever they are at: what they have done is here."""
    for p in list((getattr(pool, "_processes", None) or {}).values()):
        with contextlib.suppress(ValueError, OSError):
            p.kill()
    pool.shutdown(wait=True, cancel_futures=True)


def _begin() -> None:
    """First call in a worker: Ctrl-C is the parent's; a worker does not outlive its parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:

        def follow() -> None:
            parent.join()
            os._exit(1)

        threading.Thread(target=follow, daemon=True).start()


# --- on a cluster

PATIENCE = 5.0
"""How long the scheduler, and then its first worker, is waited for, s."""

AHEAD = 4
"""Flights that the scheduler knows for each thread of its workers: its memory does not grow with their number."""


def examine_on_cluster(given: Job, files: Sequence[str], address: str) -> Generator[tuple[str, Record]]:
    """(file, record) of every flight as it is done. Raises UserError if the cluster cannot be used, or is lost."""
    with _client(address) as (distributed, client):
        with contextlib.suppress(Exception):
            client.wait_for_workers(1, timeout=PATIENCE)
        ahead = AHEAD * sum(client.nthreads().values())
        if not ahead:
            raise UserError(
                "the cluster has no workers", where=address, remedy="start some: dask worker ADDRESS"
            )
        ask = partial(client.submit, partial(examine, given), pure=False, retries=ATTEMPTS - 1)
        waiting = iter(files)
        asked = {ask(f): f for f in islice(waiting, ahead)}
        done = distributed.as_completed(list(asked), loop=client.loop)
        for future in done:
            file = asked.pop(future)
            if future.cancelled():
                raise UserError(
                    "the connection to the scheduler is lost",
                    where=address,
                    remedy="survey again with the same --resume file: what is done is kept",
                )
            error = future.exception()
            yield file, future.result() if error is None else lost(file, error)
            future.release()
            for following in islice(waiting, 1):
                new = ask(following)
                asked[new] = following
                done.add(new)


@contextlib.contextmanager
def _client(address: str) -> Iterator[tuple[Any, Any]]:
    """Dask, and its client of the scheduler; what Dask logs is said here, in one message."""
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
    level = log.level
    log.setLevel(logging.CRITICAL)
    try:
        client = distributed.Client(address, timeout=PATIENCE, set_as_default=False, name="ragg-survey")
    except Exception as error:
        log.setLevel(level)
        raise UserError(
            "the scheduler cannot be reached",
            where=address,
            found=f"{type(error).__name__}: {error}"[:300],
            expected="a dask.distributed scheduler, tcp://host:port or tls://host:port, as it prints its address",
            remedy="check the address and that the scheduler runs; Dask must be of the same version there",
        ) from None
    try:
        yield distributed, client
    finally:
        with contextlib.suppress(Exception):
            client.close(timeout=PATIENCE)
        log.setLevel(level)


# --- results files

KIND = "ragg survey"


def head(given: Job) -> Record:
    """The first line of a results file: figures under the same head may be in one table."""
    found: Record = {
        "kind": KIND,
        "model": hashlib.sha256(given.text.encode()).hexdigest(),
        "program": dict(given.program),
    }
    if given.mapping is not None:
        found["mapping"] = hashlib.sha256(given.mapping[0].encode()).hexdigest()
    return found


class Journal:
    """Records of flights in a file, a line of JSON each, appended one by one; use :func:`open_journal`."""

    def __init__(self, path: Path, stream: IO[bytes]) -> None:
        self.path, self._stream = path, stream

    def append(self, record: Record) -> None:
        """Add a record; on return it is on the disc."""
        self._write({"digest": _digest(record), "record": record})

    def _write(self, content: Record) -> None:
        end = self._stream.seek(0, os.SEEK_END)
        try:
            try:
                self._stream.write((_text(content) + "\n").encode())
                self._stream.flush()
                os.fsync(self._stream.fileno())
            except OSError:
                os.ftruncate(self._stream.fileno(), end)
                raise
        except OSError as error:
            raise UserError(
                "the results file cannot be written", where=self.path, found=error.strerror
            ) from None

    def read(self, given: Job, files: Sequence[str]) -> dict[str, Record]:
        """Records that still hold, by file: same model, program and content, no error. UserError for another survey's."""
        self._stream.seek(0)
        text = self._stream.read()
        whole = text[: text.rfind(b"\n") + 1]  # a line that was cut off is done again
        lines = [self._parsed(line, n) for n, line in enumerate(whole.splitlines(), 1)]
        if (lines and lines[0].get("kind") != KIND) or (text and not lines):
            raise self._foreign(text[:80].decode(errors="replace"))
        if lines:
            self._compare(lines[0], head(given))
        self._stream.truncate(len(whole))
        if not lines:
            self._write(head(given))
        found = {x["record"]["file"]: x["record"] for x in lines[1:] if _holds(x)}
        return {f: found[f] for f in files if f in found and found[f]["sha256"] == sha256(Path(f))}

    def _compare(self, found: Record, asked: Record) -> None:
        for key, what in (
            ("model", "model.toml"),
            ("program", "version of the program"),
            ("mapping", "mapping of the flights' columns"),
        ):
            if found.get(key) != asked.get(key):
                raise UserError(
                    f"these results are of another {what}",
                    where=self.path,
                    found=found.get(key),
                    expected=asked.get(key, "none"),
                    remedy="name another results file: the figures of both would not fit together",
                )

    def _parsed(self, line: bytes, number: int) -> Record:
        try:
            record = json.loads(line, parse_constant=_refused)
        except (ValueError, RecursionError):  # NaN and Infinity are no JSON
            record = None
        if not isinstance(record, dict):
            raise self._foreign(f"line {number}: {line[:80].decode(errors='replace')}")
        return record

    def _foreign(self, found: str) -> UserError:
        return UserError(
            "not a results file of a survey",
            where=self.path,
            found=found,
            expected="a file that `ragg survey --resume` has written, or none",
            remedy="name another file",
        )


def _holds(line: Record) -> bool:
    """Whether a line is a diagnosed flight's, as it was written."""
    record = line.get("record")
    return isinstance(record, dict) and line.get("digest") == _digest(record) and "verdict" in record


def _text(content: Record) -> str:
    return json.dumps(content, allow_nan=False, separators=(",", ":"))


def _digest(record: Record) -> str:
    return hashlib.sha256(_text(record).encode()).hexdigest()[:16]


def _refused(name: str) -> None:
    raise ValueError(name)


@contextlib.contextmanager
def open_journal(path: Path) -> Iterator[Journal]:
    """Open or make a results file; UserError if that cannot be done or another survey is writing to it."""
    try:
        if path.exists() and not path.is_file():
            raise OSError(22, "it is not a regular file")
        stream = path.open("a+b")
    except OSError as error:
        raise UserError(
            "the results file cannot be written",
            where=path,
            found=error.strerror,
            remedy="name a file in a folder that exists and that you may write to",
        ) from None
    with stream:
        _lock(stream, path)
        yield Journal(path, stream)


def _lock(stream: IO[bytes], path: Path) -> None:
    """UserError if another survey is writing; a file system without locks is noted, and goes without."""
    try:
        import fcntl

        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise UserError(
            "another survey is writing to this results file",
            where=path,
            remedy="wait until it has ended, or name another file",
        ) from None
    except (ImportError, OSError):
        click.echo(f"note: {path} cannot be locked here: let one survey at a time write to it", err=True)


@contextlib.contextmanager
def results_file(resume: Path | None) -> Iterator[Path]:
    """The results file: the one asked for, else one that is kept only if the survey is cut short."""
    path = resume
    if path is None:
        handle, name = tempfile.mkstemp(prefix="ragg-survey-", suffix=".jsonl")
        os.close(handle)
        path = Path(name)
        # a survey that is killed outright cannot say it any more
        click.echo(f"... if it is cut short, continue with --resume {path}", err=True)
    before = path.stat().st_size if path.is_file() else 0
    try:
        yield path
    except BaseException:
        # nothing that was there before is read: it may be anything, and a refusal says so
        if path.is_file() and path.stat().st_size > before and path.read_bytes().count(b"\n") > 1:
            click.echo(f"ragg: what is done is kept; continue with --resume {path}", err=True)
        elif resume is None:
            path.unlink(missing_ok=True)
        raise
    if resume is None:
        path.unlink(missing_ok=True)


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
