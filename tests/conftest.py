"""Every run of the tests is the same run: hypothesis draws the same examples, and no clock decides."""

from __future__ import annotations

import atexit
import gc
import os
import shutil
import tempfile
from collections.abc import Iterator

import pytest
from hypothesis import settings

settings.register_profile("project", deadline=None, derandomize=True)
settings.load_profile("project")

# Nothing of the user's own (list of trusted files, what was derived and compiled) is read or written by tests. What one
# worker has derived and compiled the others find.
_home = tempfile.mkdtemp(prefix="ragg-tests-")
atexit.register(shutil.rmtree, _home, ignore_errors=True)
_cache = os.environ.setdefault("RAGG_TESTS_CACHE", f"{_home}/cache")
os.environ |= {"XDG_CONFIG_HOME": f"{_home}/config", "XDG_CACHE_HOME": _cache}


@pytest.fixture
def small_heap() -> Iterator[None]:
    """What was imported is kept out of garbage collection: for tests that ask for many of them."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()
