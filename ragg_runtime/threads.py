"""The same figures on any machine of a kind, however many cores it has."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import ParamSpec, TypeVar

import scipy.linalg  # noqa: F401  (brings a BLAS of its own, which must be there to be limited)
import threadpoolctl

P = ParamSpec("P")
R = TypeVar("R")


def one_thread(function: Callable[P, R]) -> Callable[P, R]:
    """Let linear algebra run in one thread while ``function`` does.

    BLAS splits sums by the number of its threads, and the last digits follow; after the iterations of a fit
    they are no longer the last. The matrices here are small enough to lose nothing by it.
    """

    @functools.wraps(function)
    def wrapped(*args: P.args, **kwargs: P.kwargs) -> R:
        with threadpoolctl.threadpool_limits(limits=1):
            return function(*args, **kwargs)

    return wrapped
