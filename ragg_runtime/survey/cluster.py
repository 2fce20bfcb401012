"""An existing Dask cluster, given by its scheduler's address.

Encryption and certificates are Dask's own configuration (``distributed.comm.tls``). Whoever can reach a scheduler
can run code on its workers, and whoever answers as the scheduler can run code here, since its answers are unpickled.
"""

from __future__ import annotations

import contextlib
import importlib
import logging
from collections.abc import Generator, Iterator, Sequence
from functools import partial
from itertools import islice
from typing import Any

from ragg_runtime.base.errors import UserError
from ragg_runtime.survey.local import ATTEMPTS, lost
from ragg_runtime.survey.task import Job, Record, examine, fingerprint

PATIENCE = 5.0
"""How long the scheduler, and then its first worker, is waited for, s."""

AHEAD = 4
"""Flights that the scheduler knows for each thread of its workers: its memory does not grow with their number."""


def examined(job: Job, files: Sequence[str], address: str) -> Generator[tuple[str, Record]]:
    """(file, record) of every flight, in the order in which they are done.

    Raises UserError if the cluster cannot be used, or is lost on the way.
    """
    with _client(address) as (distributed, client):
        _check(client, address)
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


def _check(client: Any, address: str) -> None:
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
