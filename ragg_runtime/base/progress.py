"""Passes over flights: in segments, with linear algebra on one thread, and how far a command is with them.

Passes report (:func:`step`), a command listens (:func:`shown`). The unit is one sample in one pass with all columns, whitened;
``PASSES`` are estimates.
"""

from __future__ import annotations

import contextlib
import functools
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextvars import ContextVar
from typing import TYPE_CHECKING, ParamSpec, TypeVar

import click

if TYPE_CHECKING:
    import threadpoolctl

# passes over the flights that a command takes, about
PASSES = {"compare": 9.0, "diagnose": 10.5, "add": 17.0}
QUIET = 4.0  # a command that takes no longer than this shows no progress, s
INTERVAL = 15.0  # time between two lines where stderr is a file, s

_listener: ContextVar[Callable[[float], None] | None] = ContextVar("listener", default=None)


def step(amount: float) -> None:
    """So much more has been done, in samples of a pass."""
    tell = _listener.get()
    if tell is not None:
        tell(amount)


def remark(text: str) -> None:
    """Say on stderr what is being done, or why nothing happens."""
    click.echo(f"... {text}", err=True)


@contextlib.contextmanager
def listening(tell: Callable[[float], None]) -> Iterator[None]:
    """Call ``tell`` at every step; what it raises ends the work."""
    token = _listener.set(tell)
    try:
        yield
    finally:
        _listener.reset(token)


@contextlib.contextmanager
def show_progress(command: str, samples: int) -> Iterator[None]:
    """Report on stderr the progress of ``command`` with flights of so many ``samples``: in one line that changes, or line by line."""
    total, terminal = PASSES[command] * max(samples, 1), sys.stderr.isatty()
    done, start = 0.0, time.monotonic()
    due = first = start + (QUIET if terminal else INTERVAL)

    def tell(amount: float) -> None:
        nonlocal done, due
        done += amount
        now = time.monotonic()
        if now >= due:
            due = now + (1.0 if terminal else INTERVAL)
            text = f"... {_describe(done / total, now - start)}"
            click.echo(f"\r{text:<60}" if terminal else text, err=True, nl=not terminal)

    with listening(tell):
        yield
    if terminal and due > first:
        click.echo(f"\r{'':<60}\r", err=True, nl=False)


def _describe(share: float, spent: float) -> str:
    """``share``: of the passes estimated; nobody knows how many more there will be beyond them."""
    if share > 0.99:
        return f"{spent:.0f} s so far, longer than estimated"
    return f"{100 * share:.0f} % done, about {spent * (1 / share - 1):.0f} s left"


P = ParamSpec("P")
R = TypeVar("R")
T = TypeVar("T")


def split_range(length: int, longest: int) -> list[slice]:
    """Consecutive slices of at most so many of ``length`` items."""
    return [slice(k, min(k + longest, length)) for k in range(0, length, longest)]


@functools.cache
def _find_libraries() -> threadpoolctl.ThreadpoolController:
    """Libraries of linear algebra; finding them takes as long as a small fit."""
    import scipy.linalg  # noqa: F401  (brings a BLAS of its own, which must be there to be limited)
    import threadpoolctl

    return threadpoolctl.ThreadpoolController()


def map_ahead(function: Callable[[T], R], items: Iterable[T]) -> Iterator[R]:
    """``map`` whose next result is made in another thread while the caller works on one; of a single item there is nothing to overlap."""
    todo = list(items)
    if len(todo) < 2:
        yield from map(function, todo)
        return
    with ThreadPoolExecutor(1) as ahead:
        future = ahead.submit(function, todo[0])
        for x in todo[1:]:
            result, future = future.result(), ahead.submit(function, x)
            yield result
            del result
        yield future.result()


def one_thread(function: Callable[P, R]) -> Callable[P, R]:
    """Let linear algebra run in one thread while ``function`` does: BLAS splits its sums by threads, which changes the last digits."""

    @functools.wraps(function)
    def wrapped(*args: P.args, **kwargs: P.kwargs) -> R:
        with _find_libraries().limit(limits=1):
            return function(*args, **kwargs)

    return wrapped
