"""Threads, and the same figures however many of them there are.

Work that is divided (segments of a flight, motions to compare) is given back in the order in which it was
asked for, and only then summed; linear algebra runs in one thread, because BLAS splits its sums by the
number of threads.
"""

from __future__ import annotations

import contextlib
import functools
import os
import threading
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from typing import ParamSpec, TypeVar

import scipy.linalg  # noqa: F401  (brings a BLAS of its own, which must be there to be limited)
import threadpoolctl

P = ParamSpec("P")
R = TypeVar("R")
T = TypeVar("T")

VARIABLE = "RAGG_THREADS"
"""Environment variable: the number of threads (default: one per processor, at most ``MOST``)."""

MOST = 2
"""Most threads unless asked for: each takes some 150 MB on a long flight."""

_here = threading.local()


def count() -> int:
    """How many threads the work may be divided among; one within work that is divided already."""
    if getattr(_here, "divided", False):
        return 1
    given = os.environ.get(VARIABLE, "")
    if given.isdigit() and int(given) > 0:
        return int(given)
    return min(
        MOST, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    )


@contextlib.contextmanager
def alone() -> Iterator[None]:
    """Work on one thread here: what is done is one of several things that are done at a time."""
    before = getattr(_here, "divided", False)
    _here.divided = True
    try:
        yield
    finally:
        _here.divided = before


def mapped(function: Callable[[T], R], items: Sequence[T]) -> Iterator[R]:
    """``function`` of every item, in order, several at a time; few are begun before they are asked for.

    Items are begun in order: one may wait for what those before it do.
    """
    threads = count()
    if threads == 1 or len(items) == 1:
        yield from map(function, items)
        return

    def within(item: T) -> R:
        with alone():
            return function(item)

    with ThreadPoolExecutor(threads) as pool:
        waiting: deque[Future[R]] = deque()
        try:
            for item in items:
                waiting.append(pool.submit(within, item))
                if len(waiting) > threads:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        finally:
            for future in waiting:
                future.cancel()


def stretches(length: int, most: int) -> list[slice]:
    """``length`` items in a row as neighbouring slices of at most so many."""
    return [slice(k, min(k + most, length)) for k in range(0, length, most)]


@functools.cache
def _libraries() -> threadpoolctl.ThreadpoolController:
    """Those of linear algebra. To look for them takes as long as a small fit; all are there once this module is."""
    return threadpoolctl.ThreadpoolController()


def one_thread(function: Callable[P, R]) -> Callable[P, R]:
    """Let linear algebra run in one thread while ``function`` does.

    BLAS splits sums by the number of its threads, and the last digits follow; after the iterations of a fit
    they are no longer the last. The matrices here are small enough to lose nothing by it.
    """

    @functools.wraps(function)
    def wrapped(*args: P.args, **kwargs: P.kwargs) -> R:
        with _libraries().limit(limits=1):
            return function(*args, **kwargs)

    return wrapped
