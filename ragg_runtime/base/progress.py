"""Passes over flights: in segments, with linear algebra on one thread, and how far a command is with them.

Passes report (:func:`step`), a command listens (:func:`listening`). The unit is one sample in one pass with all columns, whitened;
``PASSES`` are estimates.
"""

from __future__ import annotations

import contextlib
import functools
import sys
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextvars import ContextVar
from typing import TYPE_CHECKING, ParamSpec, TypeVar

import click

if TYPE_CHECKING:
    import threadpoolctl

# passes over the flights that a command takes, about
PASSES = {"compare": 9.0, "diagnose": 10.5, "add": 17.0}

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
def show_progress(text: str, command: str, samples: int) -> Iterator[None]:
    """Say on stderr what is being done, on a terminal with how far ``command`` is with flights of so many ``samples``.

    Nobody knows how much comes beyond the estimate: the bar never reaches its end before.
    """
    length = int(PASSES[command] * max(samples, 1))
    with click.progressbar(
        length=length, label=f"... {text}", file=sys.stderr, update_min_steps=max(1, length // 200)
    ) as bar:

        def tell(amount: float) -> None:
            assert bar.length is not None
            if bar.pos + amount > 0.95 * bar.length:
                bar.length = int(1.2 * (bar.pos + amount))
            bar.update(int(amount))

        with listening(tell):
            yield


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
