"""An existing Dask cluster, given by its scheduler's address.

The scheduler hands flights to workers by path; those of a worker that dies go to another one. Whoever can
reach a scheduler can run code on its workers, and whoever answers as the scheduler can run code here, since its
answers are unpickled: that is how Dask works, and why it belongs behind a wall or TLS (:mod:`ragg_runtime.survey.tls`).
"""

from __future__ import annotations

import asyncio
import contextlib
import importlib
import logging
import queue
import time
import uuid
from collections import Counter, deque
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import count
from typing import Any

from ragg_runtime.base.errors import UserError
from ragg_runtime.survey.local import ATTEMPTS, lost
from ragg_runtime.survey.task import Job, Record, examine, fingerprint
from ragg_runtime.survey.tls import Tls, security

PATIENCE = 5.0
"""How long the scheduler, and then its first worker, is waited for, s."""

RECONNECTED = 20.0
"""How long a scheduler whose connection broke is waited for, s."""

WITHOUT_WORKERS = 60.0
"""How long a survey waits for a worker when all are gone, s."""

AHEAD = 4
"""Flights that the scheduler knows for each thread of its workers: enough that none of them waits for us."""

RENEWED = 10.0
"""How long the number of threads is believed, s."""


def examined(
    job: Job, files: Sequence[str], address: str, tls: Tls | None = None
) -> Generator[tuple[str, Record]]:
    """(file, record) of every flight, in the order in which they are done.

    Raises UserError if the cluster cannot be used, or is lost on the way.
    """
    with _client(address, tls) as client:
        _check(client, address)
        flights = _Queue(client, job, files)
        try:
            while flights.submit():
                file, future = _next(client, address, flights.done)
                # its worker died with the result: it is being made again
                if future.status in ("lost", "pending"):
                    flights.wait(file, future)
                    continue
                # A client that has lost its scheduler for a moment cancels everything; the flights are done again.
                if future.status == "cancelled" and flights.attempts[file] < ATTEMPTS and _connected(client):
                    flights.ask(file)
                    continue
                yield file, _record(client, address, file, future)
                flights.release(file)
        finally:
            with contextlib.suppress(Exception):
                if client.status == "running":
                    client.cancel(list(flights.asked.values()), force=True)


class _Queue:
    """Flights that wait here, those that the scheduler has been asked for, and those that are done.

    The scheduler never knows more than ``AHEAD`` flights a thread of its workers, and forgets each result once it is
    here: its memory, and that of the workers, does not grow with the number of flights.

    Attributes
    ----------
    asked
        File -> future of the flights that the scheduler has been asked for.
    attempts
        File -> how often it has been asked for.
    done
        (file, future), as they end.
    """

    def __init__(self, client: Any, job: Job, files: Sequence[str]) -> None:
        self._client = client
        self._examine = partial(examine, job)
        self._waiting = deque(files)
        run = uuid.uuid4().hex  # another survey may ask the same scheduler
        self._keys = (f"ragg-survey-{run}-{n}" for n in count())
        self._room, self._known_until = 0, 0.0
        self.asked: dict[str, Any] = {}
        self.attempts: Counter[str] = Counter()
        self.done: queue.Queue[tuple[str, Any]] = queue.Queue()

    def submit(self) -> bool:
        """Ask for as many flights as there is room for; whether any flight is still to come."""
        now = time.monotonic()
        if now > self._known_until and self._waiting:  # workers come and go
            with contextlib.suppress(Exception):
                self._room = AHEAD * max(1, sum(self._client.nthreads().values()))
            self._known_until = now + RENEWED
        while self._waiting and len(self.asked) < max(self._room, AHEAD):
            self.ask(self._waiting.popleft())
        return bool(self.asked)

    def wait(self, file: str, future: Any) -> None:
        """Tell of a future when it is done."""
        future.add_done_callback(lambda f: self.done.put((file, f)))

    def release(self, file: str) -> None:
        """Let the cluster forget a flight whose record is here."""
        with contextlib.suppress(Exception):
            self.asked[file].release()
        del self.asked[file]

    def ask(self, file: str) -> None:
        """Give a flight to the scheduler."""
        self.attempts[file] += 1
        future = self._client.submit(
            self._examine, file, pure=False, retries=ATTEMPTS - 1, key=next(self._keys)
        )
        self.asked[file] = future
        self.wait(file, future)


def _record(client: Any, address: str, file: str, future: Any) -> Record:
    if future.status == "finished":
        record: Record = future.result()
        return record
    if future.status == "error":
        error = future.exception()
        if type(error).__name__ == "KilledWorker":
            return lost_worker(file)
        return lost(file, error)
    raise _gone(address)  # cancelled: the scheduler has forgotten it


def _connected(client: Any) -> bool:
    """Whether the scheduler is there, or comes back within ``RECONNECTED``."""
    until = time.monotonic() + RECONNECTED
    while client.status == "connecting" and time.monotonic() < until:
        time.sleep(0.2)
    return bool(client.status == "running")


def lost_worker(file: str) -> Record:
    """The record of a flight at which worker after worker died."""
    return lost(file, RuntimeError("every worker that was given the flight died (out of memory, or killed)"))


def _next(client: Any, address: str, done: queue.Queue[tuple[str, Any]]) -> tuple[str, Any]:
    since = None
    while True:
        with contextlib.suppress(queue.Empty):
            return done.get(timeout=1.0)
        if not _connected(client):
            raise _gone(address)
        try:
            workers = client.nthreads()
        except Exception:
            raise _gone(address) from None
        now = time.monotonic()
        since = None if workers else (since or now)
        if since is not None and now - since > WITHOUT_WORKERS:
            raise UserError(
                "all workers of the cluster are gone",
                where=address,
                remedy="start workers and survey again with the same --resume file: what is done is kept",
            )


def _gone(address: str) -> UserError:
    return UserError(
        "the connection to the scheduler is lost",
        where=address,
        remedy="survey again with the same --resume file: what is done is kept",
    )


@contextlib.contextmanager
def _client(address: str, tls: Tls | None) -> Iterator[Any]:
    try:
        distributed: Any = importlib.import_module("distributed")
    except ImportError:
        raise UserError(
            "a survey on a cluster needs Dask",
            where="--scheduler",
            found="no package distributed",
            remedy="pip install 'ragg[cluster]'; or leave --scheduler out: the survey then runs on this machine",
        ) from None
    rest = address.partition("://")[2]
    if not rest or not rest.rpartition(":")[2].rstrip("/").isdecimal():
        raise UserError(
            "not the address of a scheduler",
            where="--scheduler",
            found=repr(address),
            expected="tcp://host:port or tls://host:port, as the scheduler prints it",
        )
    proof = security(address, tls)
    log = logging.getLogger("distributed")
    level = log.level
    log.setLevel(logging.CRITICAL)  # what it has to say is said here, in one message
    try:
        try:
            _greet(address, proof)
            client = distributed.Client(
                address, timeout=PATIENCE, set_as_default=False, name="ragg-survey", security=proof
            )
        except Exception as error:
            raise UserError(
                "the scheduler cannot be reached",
                where=address,
                found="no answer"
                if isinstance(error, TimeoutError)
                else f"{type(error).__name__}: {error}"[:300],
                expected=f"a dask.distributed scheduler that answers within {PATIENCE:g} s",
                remedy="check the address and that the scheduler runs; Dask must be of the same version there",
            ) from None
        try:
            yield client
        finally:
            with contextlib.suppress(Exception):
                client.close(timeout=PATIENCE)
    finally:
        log.setLevel(level)


def _greet(address: str, proof: Any) -> None:
    """Ask who is there: Dask's own client waits for ever for a listener that says nothing."""
    from distributed.core import rpc

    async def asked() -> Any:
        scheduler = rpc(address, connection_args=proof.get_connection_args("client"))
        try:
            return await asyncio.wait_for(scheduler.identity(), PATIENCE)
        finally:
            await scheduler.close_rpc()

    # In a thread of its own: a notebook has an event loop already.
    with ThreadPoolExecutor(1) as own:
        answer = own.submit(asyncio.run, asked()).result()
    if answer.get("type") != "Scheduler":
        raise ConnectionError(f"a {answer.get('type', 'stranger')}, not a scheduler")


def _check(client: Any, address: str) -> None:
    """Every worker runs this very program, or the figures would not be the same."""
    with contextlib.suppress(Exception):
        client.wait_for_workers(1, timeout=PATIENCE)
    try:
        answers: dict[str, Any] = client.run(fingerprint, on_error="return")
    except Exception as error:
        raise UserError(
            "the workers of the cluster do not answer",
            where=address,
            found=f"{type(error).__name__}: {error}".split("\n")[0][:300],
            expected="workers with this version of ragg and of Dask",
            remedy="install the same versions on all workers",
        ) from None
    if not answers:
        raise UserError("the cluster has no workers", where=address, remedy="start some: dask worker ADDRESS")
    own = dict(_own())
    for worker, answer in sorted(answers.items()):
        if isinstance(answer, BaseException):
            found: object = f"{type(answer).__name__}: {answer}"
        else:
            theirs = dict(answer)
            different = {n: theirs.get(n) for n in own if theirs.get(n) != own[n]}
            if not different:
                continue
            found = ", ".join(f"{n} {v}" for n, v in different.items())
        raise UserError(
            "a worker of the cluster does not run this version of the program",
            where=worker,
            found=found,
            expected=", ".join(f"{n} {v}" for n, v in own.items()),
            remedy="install the same versions of ragg, NumPy, SciPy and SymPy on all workers",
        )


def _own() -> tuple[tuple[str, str], ...]:
    return fingerprint()
