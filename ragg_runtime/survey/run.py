"""A survey: every flight diagnosed by itself, on this machine or on a cluster, and what they say together."""

from __future__ import annotations

import contextlib
import errno
import hashlib
import importlib
import json
import logging
import os
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Generator, Iterator, Sequence
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any

import click

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import file_digest
from ragg_runtime.base.progress import INTERVAL
from ragg_runtime.io.record import same_record
from ragg_runtime.survey import local
from ragg_runtime.survey.local import ATTEMPTS, lost
from ragg_runtime.survey.result import Survey
from ragg_runtime.survey.task import (
    BETWEEN,
    CONTENT,
    Job,
    Record,
    divided,
    examine,
    expanded,
    fingerprint,
    job,
)

Progress = Callable[[int, int, Record | None], None]
"""Called with the number of flights done, of all, and the record just made (``None`` at the beginning)."""


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
        model.toml and where it stands.
    flights
        Files; the order does not matter, a file named twice counts once.
    jobs
        Worker processes on this machine (default: one per processor).
    scheduler
        Address of a dask.distributed scheduler, ``tcp://host:port``: its workers do it instead. What answers there
        can run code in this process: name addresses that you trust. Certificates are Dask's own configuration.
    resume
        Results file: what stands in it is not done again (flights in error are), what is done is added.
    mapping
        Text and place of the mapping by which flights are read, and whether it is the model's own.

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
    with contextlib.nullcontext() if resume is None else journal(resume) as kept:
        if kept is not None:
            records |= kept.read(given, files)
        if progress is not None:
            progress(len(records), len(files), None)
        left = [f for f in files if f not in records]
        if left:
            with contextlib.closing(_examined(given, left, jobs, scheduler)) as found:
                for file, record in found:
                    records[file] = record = record | {"flight": names[file]}
                    if kept is not None:
                        kept.append(record)
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
    """The records; of those that are of one and the same record of an instrument the first, the others in error."""
    first: dict[str, str] = {}
    for r in records:
        same = r["file"] if CONTENT not in r else first.setdefault(r[CONTENT], r["file"])
        if same != r["file"]:
            error = {"kind": "input", "message": f"{r['file']}: {same_record(same)}"}
            yield {k: r[k] for k in ("flight", "file", "sha256")} | {"error": error}
        else:
            yield {k: v for k, v in r.items() if k != CONTENT}


def distinct_names(files: Sequence[str]) -> dict[str, str]:
    """File -> the flight's name: that of the file, with as many folders before it as tell it from all others."""
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


def _examined(
    given: Job, files: Sequence[str], jobs: int | None, scheduler: str | None
) -> Generator[tuple[str, Record]]:
    if scheduler is not None:
        return examined_on_cluster(given, files, scheduler)
    return local.examined(given, files, jobs or local.processors())


PATIENCE = 5.0
"""How long the scheduler, and then its first worker, is waited for, s."""

AHEAD = 4
"""Flights that the scheduler knows for each thread of its workers: its memory does not grow with their number."""


def examined_on_cluster(job: Job, files: Sequence[str], address: str) -> Generator[tuple[str, Record]]:
    """(file, record) of every flight as it is done. Raises UserError if the cluster cannot be used, or is lost."""
    with _client(address) as (distributed, client):
        _check_workers(client, address)
        ask = partial(client.submit, partial(examine, job), pure=False, retries=ATTEMPTS - 1)
        waiting = iter(files)
        ahead = AHEAD * sum(client.nthreads().values())
        asked = {ask(file): file for file in islice(waiting, ahead)}
        done = distributed.as_completed(list(asked), loop=client.loop)
        for future in done:
            file = asked.pop(future)
            yield file, _record(address, file, future)
            future.release()
            for following in islice(waiting, 1):
                new = ask(following)
                asked[new] = following
                done.add(new)


def _record(address: str, file: str, future: Any) -> Record:
    if future.cancelled():
        raise UserError(
            "the connection to the scheduler is lost",
            where=address,
            remedy="survey again with the same --resume file: what is done is kept",
        )
    try:
        record: Record = future.result()
    except Exception as error:
        if type(error).__name__ != "KilledWorker":
            return lost(file, error)
        died = "every worker that was given the flight died (out of memory, or killed)"
        return lost(file, RuntimeError(died))
    return record


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
        try:
            yield distributed, client
        finally:
            with contextlib.suppress(Exception):
                client.close(timeout=PATIENCE)
    finally:
        log.setLevel(level)


def _check_workers(client: Any, address: str) -> None:
    """UserError unless every worker runs this very program: the figures would not be the same."""
    with contextlib.suppress(Exception):
        client.wait_for_workers(1, timeout=PATIENCE)
    answers: dict[str, Any] = client.run(fingerprint, on_error="return")
    if not answers:
        raise UserError("the cluster has no workers", where=address, remedy="start some: dask worker ADDRESS")
    own = fingerprint()
    for worker, answer in sorted(answers.items()):
        if answer != own:
            raise UserError(
                "a worker of the cluster does not run this version of the program",
                where=worker,
                found=f"{answer!r}"[:300] if isinstance(answer, Exception) else _listed(answer),
                expected=_listed(own),
                remedy="install the same versions of ragg, NumPy, SciPy and SymPy on all workers",
            )


def _listed(versions: Sequence[tuple[str, str]]) -> str:
    return ", ".join(f"{n} {v}" for n, v in versions)


@contextlib.contextmanager
def results_file(resume: Path | None) -> Iterator[Path]:
    """The results file: the one asked for, else one that is kept only if the survey is cut short."""
    if resume is not None:
        path, temporary = resume, False
    else:
        handle, name = tempfile.mkstemp(prefix="ragg-survey-", suffix=".jsonl")
        os.close(handle)
        path, temporary = Path(name), True
        # A survey that is killed outright cannot say it any more.
        click.echo(f"... if it is cut short, continue with --resume {path}", err=True)
    before = path.stat().st_size if path.is_file() else 0
    try:
        yield path
    except BaseException:
        # Nothing that was there before is read: it may be anything, and a refusal says so.
        if path.is_file() and path.stat().st_size > before and path.read_bytes().count(b"\n") > 1:
            click.echo(f"ragg: what is done is kept; continue with --resume {path}", err=True)
        elif temporary:
            path.unlink(missing_ok=True)
        raise
    if temporary:
        path.unlink(missing_ok=True)


@contextlib.contextmanager
def shown() -> Iterator[Progress]:
    """A bar with the time left where stderr is a terminal, else a line now and then."""
    if sys.stderr.isatty():
        with _bar() as show:
            yield show
    else:
        yield _lines()


@contextlib.contextmanager
def _bar() -> Iterator[Progress]:
    from rich import progress as rich_progress
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn

    columns = (
        TextColumn("flights"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("time left"),
        TimeRemainingColumn(),
        TextColumn("{task.fields[failed]}"),
    )
    with rich_progress.Progress(*columns, console=Console(stderr=True), speed_estimate_period=600.0) as bar:
        task = bar.add_task("", total=None, failed="")
        failed = 0

        def show(done: int, total: int, record: Record | None) -> None:
            nonlocal failed
            failed += record is not None and "error" in record and "verdict" not in record
            bar.update(task, completed=done, total=total, failed=f"[red]{failed} in error" if failed else "")

        yield show


def _lines() -> Progress:
    start = last = time.monotonic()
    before = 0

    def show(done: int, total: int, record: Record | None) -> None:
        nonlocal last, before
        now = time.monotonic()
        if record is None:
            before = done
            kept = f", {done} of them done before" if done else ""
            click.echo(f"... {total} flights{kept}", err=True)
        elif now - last >= INTERVAL or done == total:
            last = now
            left = (now - start) / max(done - before, 1) * (total - done)
            click.echo(f"... {done} of {total}, {left:.0f} s left", err=True)

    return show


KIND = "ragg survey"
_LONGEST_HEAD = 1 << 16  # bytes


def head(job: Job) -> Record:
    """The first line: figures under the same head may stand in one table."""
    text = hashlib.sha256(job.text.encode()).hexdigest()
    found: Record = {"kind": KIND, "model": text, "program": dict(job.program)}
    if job.mapping is not None:
        found["mapping"] = hashlib.sha256(job.mapping[0].encode()).hexdigest()
    return found


def sha256(path: Path) -> str | None:
    """Digest of a file, as a flight's (also of ``file::line``); ``None`` if it cannot be read."""
    path, _ = divided(str(path))
    try:
        return file_digest(path)
    except (OSError, UserError):
        return None


class Journal:
    """Records of flights in a file, appended one by one; use :func:`journal`."""

    def __init__(self, path: Path, handle: int) -> None:
        self.path = path
        self._handle = handle

    def append(self, record: Record) -> None:
        """Add a record; on return it is on the disc."""
        self._write({"digest": _digest(record), "record": record})

    def _write(self, content: Record) -> None:
        line = (_text(content) + "\n").encode()
        try:
            end = os.lseek(self._handle, 0, os.SEEK_END)
            try:
                written = os.write(self._handle, line)
                if written < len(line):  # a full disc
                    raise OSError(28, "No space left on device")
                os.fsync(self._handle)
            except OSError:
                os.ftruncate(self._handle, end)
                raise
        except OSError as error:
            raise UserError(
                "the results file cannot be written", where=self.path, found=error.strerror
            ) from None

    def read(self, job: Job, files: Sequence[str]) -> dict[str, Record]:
        """Records that still hold, by file: same model, program and content, no error. UserError for another survey's."""
        lines = self._lines()
        if lines:
            self._compare(lines[0], job)
        found: dict[str, Record] = {}
        for number, line in enumerate(lines[1:], 2):
            kept = self._parsed(line, number)
            record = kept.get("record")
            if isinstance(record, dict) and kept.get("digest") == _digest(record):  # else it is done again
                found[record["file"]] = record
        # Only now is it certain that the file is a survey's, and what follows its last line one that was cut off.
        os.ftruncate(self._handle, sum(map(len, lines)))
        if not lines:
            self._write(head(job))
        return {
            file: found[file]
            for file in files
            if "verdict" in found.get(file, {}) and found[file]["sha256"] == sha256(Path(file))
        }

    def _lines(self) -> list[bytes]:
        """The whole lines of the file, with their ends. UserError if it does not begin as a survey's does."""
        with open(self._handle, "rb", closefd=False) as stream:
            stream.seek(0)
            first = stream.readline(_LONGEST_HEAD)
            if first and self._parsed(first, 1).get("kind") != KIND:
                raise self._foreign(first[:80].decode(errors="replace"))
            text = first + stream.read()
        return text[: text.rfind(b"\n") + 1].splitlines(keepends=True)

    def _compare(self, line: bytes, job: Job) -> None:
        found, asked = self._parsed(line, 1), head(job)
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


def _text(content: Record) -> str:
    return json.dumps(content, allow_nan=False, separators=(",", ":"))


def _digest(record: Record) -> str:
    """Of a record as it is written: a line that was changed does not count."""
    return hashlib.sha256(_text(record).encode()).hexdigest()[:16]


def _refused(name: str) -> None:
    raise ValueError(name)


@contextlib.contextmanager
def journal(path: Path) -> Iterator[Journal]:
    """Open or make a results file; UserError if that cannot be done or another survey is writing to it."""
    flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0)
    try:
        if path.exists() and not path.is_file():
            raise OSError(errno.EINVAL, "it is not a regular file")
        handle = os.open(path, flags, 0o666)
    except OSError as error:
        raise UserError(
            "the results file cannot be written",
            where=path,
            found=error.strerror,
            remedy="name a file in a folder that exists and that you may write to",
        ) from None
    try:
        _claim(handle, path)
        yield Journal(path, handle)
    finally:
        os.close(handle)


def _claim(handle: int, path: Path) -> None:
    if sys.platform == "win32":
        return
    import fcntl

    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise UserError(
            "another survey is writing to this results file",
            where=path,
            remedy="wait until it has ended, or name another file",
        ) from None
    except OSError:
        return  # a file system without locks
