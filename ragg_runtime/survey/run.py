"""A survey: every flight diagnosed separately by processes or a Dask cluster, each result kept at once, and a summary."""

from __future__ import annotations

import contextlib
import hashlib
import importlib
import json
import logging
import multiprocessing
import os
import signal
import threading
from collections import Counter, deque
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from functools import partial
from pathlib import Path
from typing import IO, Any

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import file_digest, read_text
from ragg_runtime.base.progress import remark
from ragg_runtime.io.record import SAME_RECORD
from ragg_runtime.survey.examine import BETWEEN, CONTENT, Job, Record, examine, expand_lines, split_line
from ragg_runtime.survey.result import Survey
from ragg_runtime.workspace import Loaded, mapping_of

# called with the number of flights done, of all, and the record just made (None at the beginning)
Progress = Callable[[int, int, Record | None], None]
ATTEMPTS = 3  # how often a flight is tried whose worker dies or runs out of memory
PATIENCE = 5.0  # how long the scheduler of a cluster, and then its first worker, is waited for, s
# flights that the scheduler knows for each thread of its workers: its memory does not grow with their number
AHEAD = 4


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
    mapped = mapping_of(m, mapping)
    job = Job(
        text=m.directory.text,
        path=str((m.directory.path / "model.toml").resolve()),
        mapping=None if mapped is None else (read_text(mapped.path), str(mapped.path.resolve()), mapped.kept),
        cluster=scheduler is not None,
    )
    names = name_flights(expand_lines(job, [str(Path(f).resolve()) for f in flights]))
    tell = progress or (lambda done, total, record: None)
    with open_journal(resume, job, [*names]) as (records, keep):
        tell(len(records), len(names), None)
        unfinished = [f for f in names if f not in records]
        if scheduler is None:
            cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
            results = examine_all(job, unfinished, partial(open_processes, jobs or cores))
        else:
            results = examine_all(job, unfinished, partial(open_cluster, scheduler), attempts=1)
        with contextlib.closing(results):
            for file, record in results:
                records[file] = record | {"flight": names[file]}
                keep(records[file])
                tell(len(records), len(names), records[file])
    # what was kept may have been named among other files
    return Survey(tuple(drop_repeated([records[f] | {"flight": name} for f, name in names.items()])))


def name_flights(files: Sequence[str]) -> dict[str, str]:
    """File -> the flight's name, sorted by name: the file's own, after as many folders as make it unique."""
    split = {f: split_line(f) for f in files}
    unnamed, depth = {path for path, _ in split.values()}, 0
    names: dict[Path, str] = {}
    while unnamed:
        depth += 1
        count = Counter(p.parts[-depth:] for p in unnamed)
        names |= {p: "/".join(p.parts[-depth:]) for p in unnamed if count[p.parts[-depth:]] == 1}
        unnamed -= names.keys()
    ordered = sorted(split.items(), key=lambda x: names[x[1][0]])
    return {f: names[path] + ("" if line is None else f"{BETWEEN}{line}") for f, (path, line) in ordered}


def drop_repeated(records: Sequence[Record]) -> Iterator[Record]:
    """The records; where several are of the same recording, the first, and an error for each other."""
    first: dict[str, str] = {}
    for r in records:
        same = r["file"] if CONTENT not in r else first.setdefault(r[CONTENT], r["file"])
        if same != r["file"]:
            error = {"kind": "input", "message": f"{r['file']}: {SAME_RECORD.format(same)}"}
            yield {k: r[k] for k in ("flight", "file", "sha256")} | {"error": error}
        else:
            yield {k: v for k, v in r.items() if k != CONTENT}


# --- workers -------------------------------------------------------------------------------------------


# opens workers for so many flights: an executor, and how many flights it is given at a time
OpenPool = Callable[[int], contextlib.AbstractContextManager[tuple[Executor, int]]]


def examine_all(
    job: Job, files: Sequence[str], open_pool: OpenPool, attempts: int = ATTEMPTS
) -> Generator[tuple[str, Record]]:
    """(file, record) of every flight as it is done; closing the iterator ends the work.

    Flights at which a worker died are tried again at the end, each alone, to find which one it was.
    """
    failed: dict[str, BaseException | None] = dict.fromkeys(files)
    for attempt in range(attempts):
        for waiting in [deque([f]) for f in failed] if attempt else [deque(files)]:
            while waiting:  # a pool that breaks is replaced
                with open_pool(len(waiting)) as (pool, limit):
                    for file, future in _run(pool, job, waiting, limit):
                        failed[file] = future.exception()
                        if failed[file] is None:
                            del failed[file]
                            yield file, future.result()
    for file, error in failed.items():
        what = f"{type(error).__name__}: {error}"
        if type(error).__name__ in ("BrokenProcessPool", "KilledWorker"):
            what = "the worker process died (out of memory, or killed)"
        lost = {"kind": "lost", "message": f"{file}: {what}, {ATTEMPTS} times"}
        yield file, {"flight": os.path.basename(file), "file": file, "error": lost}


def _run(pool: Executor, job: Job, waiting: deque[str], limit: int) -> Generator[tuple[str, Future[Record]]]:
    """(file, future) of flights as they are done, ``limit`` at a time, until none waits or a worker's death breaks the pool."""
    running: dict[Future[Record], str] = {}
    broken = False
    while not broken and (waiting or running):
        while waiting and len(running) < limit:
            file = waiting.popleft()
            running[pool.submit(examine, job, file)] = file
        done = wait(running, return_when=FIRST_COMPLETED).done
        if any(f.cancelled() for f in done):
            raise UserError(
                "the connection to the scheduler is lost",
                remedy="survey again with the same --resume file: finished flights are kept",
            )
        broken = any(isinstance(f.exception(), BrokenProcessPool) for f in done)
        for future in wait(running).done if broken else done:
            yield running.pop(future), future


@contextlib.contextmanager
def open_processes(jobs: int, flights: int) -> Iterator[tuple[Executor, int]]:
    """Processes of this machine, at most one a flight, and how many flights run at once: one each, so that few are suspect when one dies.

    Ctrl-C goes to the parent alone; processes are killed at the end.
    """
    jobs = min(jobs, flights)
    context = multiprocessing.get_context("spawn")  # the same on every system; no locks are inherited
    pool = ProcessPoolExecutor(jobs, context, initializer=_begin)
    try:
        started = [pool.submit(os.getpid) for _ in range(jobs)]
        if isinstance(started[0].exception(), BrokenProcessPool):
            raise UserError(
                "no worker process can be started",
                expected="a program that can be imported: workers begin by importing it",
                remedy="in a script of your own, call survey below `if __name__ == '__main__':`",
            )
        yield pool, jobs
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


@contextlib.contextmanager
def open_cluster(address: str, flights: int) -> Iterator[tuple[Executor, int]]:
    """The workers of a Dask cluster, which tries a flight again itself; what Dask logs is reported here, in one message."""
    distributed: Any = importlib.import_module("distributed")
    log = logging.getLogger("distributed")
    level, client = log.level, None
    log.setLevel(logging.CRITICAL)
    try:
        try:
            client = distributed.Client(address, timeout=PATIENCE, set_as_default=False, name="ragg-survey")
            client.wait_for_workers(1, timeout=PATIENCE)
        except Exception as error:
            raise UserError(
                "the scheduler cannot be reached, or has no workers",
                where=address,
                found=f"{type(error).__name__}: {error}"[:300],
                expected="a dask.distributed scheduler, tcp://host:port or tls://host:port, as it prints its address",
                remedy="check the address, and that scheduler and workers run, with Dask of the same version",
            ) from None
        pool = client.get_executor(pure=False, retries=ATTEMPTS - 1)
        yield pool, min(AHEAD * sum(client.nthreads().values()), flights)
    finally:
        if client is not None:
            with contextlib.suppress(Exception):
                client.close(timeout=PATIENCE)
        log.setLevel(level)


# --- progress and the results file ---------------------------------------------------------------------


def tell_progress(done: int, total: int, record: Record | None) -> None:
    """A line on stderr for every flight as it is done."""
    if record is None:
        remark(f"{total} flights{f', {done} of them done before' if done else ''}")
    else:
        remark(f"{done} of {total}, {record['flight']}: {record.get('verdict', 'in error')}")


@contextlib.contextmanager
def open_journal(
    path: Path | None, job: Job, files: Sequence[str]
) -> Iterator[tuple[dict[str, Record], Callable[[Record], None]]]:
    """Open or make a results file: its records of unchanged files, errors left out; and a function that writes a record to disc.

    UserError if it is another survey's; without a path nothing is kept.
    """
    if path is None:
        yield {}, lambda record: None
        return
    with path.open("a+b") as stream:

        def write(content: Record) -> None:
            text = json.dumps(content, allow_nan=False, separators=(",", ":"))
            stream.write(f"{text}\n".encode())
            stream.flush()
            os.fsync(stream.fileno())

        head, (first_line, *lines) = _make_head(job), _read_lines(stream, path)
        if not first_line:
            write(head)
        elif first_line != head:
            raise UserError(
                "these results are of another model.toml, mapping or version of the program",
                where=path,
                remedy="name another results file: the results would not be comparable",
            )
        done = {r["file"]: r for r in (x["record"] for x in lines) if "verdict" in r}
        unchanged = {f: done[f] for f in files if f in done and done[f]["sha256"] == digest_file(f)}
        yield unchanged, lambda record: write({"record": record})


def _make_head(job: Job) -> Record:
    """The first line of a results file: figures under the same head may be in one table."""
    texts = [job.text] if job.mapping is None else [job.text, job.mapping[0]]
    digests = [hashlib.sha256(text.encode()).hexdigest() for text in texts]
    return {"kind": "ragg survey", "program": dict(job.program), "read": digests}


def _read_lines(stream: IO[bytes], path: Path) -> list[Record]:
    """The lines of a results file, of a new one an empty line; one that was cut off is left out, there too."""
    stream.seek(0)
    text = stream.read()
    complete = text[: text.rfind(b"\n") + 1]
    try:
        lines: list[Record] = [json.loads(line) for line in complete.splitlines()]
        sound = not text or (lines[0]["kind"] == "ragg survey" and all("record" in x for x in lines[1:]))
    except (ValueError, LookupError, TypeError, RecursionError):
        sound = False
    if not sound:
        raise UserError(
            "not a results file of a survey",
            where=path,
            found=text[:80].decode(errors="replace"),
            expected="a file that `ragg survey --resume` has written, or none",
            remedy="name another file",
        )
    stream.truncate(len(complete))
    return lines or [{}]


def digest_file(file: str) -> str | None:
    """Digest of a file, as a flight's (also of ``file::line``); ``None`` if it cannot be read."""
    try:
        return file_digest(split_line(file)[0])
    except (OSError, UserError):
        return None
