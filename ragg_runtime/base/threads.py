"""Linear algebra on one thread, and series in segments: BLAS splits its sums by threads, which changes the last digits."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import ParamSpec, TypeVar

import scipy.linalg  # noqa: F401  (brings a BLAS of its own, which must be there to be limited)
import threadpoolctl

P = ParamSpec("P")
R = TypeVar("R")


def split_range(length: int, most: int) -> list[slice]:
    """Consecutive slices of at most so many of ``length`` items."""
    return [slice(k, min(k + most, length)) for k in range(0, length, most)]


@functools.cache
def _libraries() -> threadpoolctl.ThreadpoolController:
    """Those of linear algebra. To look for them takes as long as a small fit; all are there once this module is."""
    return threadpoolctl.ThreadpoolController()


def one_thread(function: Callable[P, R]) -> Callable[P, R]:
    """Let linear algebra run in one thread while ``function`` does."""

    @functools.wraps(function)
    def wrapped(*args: P.args, **kwargs: P.kwargs) -> R:
        with _libraries().limit(limits=1):
            return function(*args, **kwargs)

    return wrapped
