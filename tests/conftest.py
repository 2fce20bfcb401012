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

import derive  # noqa: F401  (tells SymPy how much to remember, which must be before any test imports SymPy)

settings.register_profile("project", deadline=None, derandomize=True)
settings.load_profile("project")

# Nothing of the user's own (effects in Python, what was derived and compiled) is read or written by tests. What one
# worker has derived and compiled the others find.
_home = tempfile.mkdtemp(prefix="ragg-tests-")
atexit.register(shutil.rmtree, _home, ignore_errors=True)
_cache = os.environ.setdefault("RAGG_TESTS_CACHE", f"{_home}/cache")
os.environ["XDG_CACHE_HOME"] = _cache
os.environ.pop("RAGG_EFFECTS", None)


DEAREST = (
    "survey studio_browser verdict loop series screening_mistakes studio_server compensate outputs next_motion effect_conformance "
    "layouts_physics reference_pages benchmarks real_measurements gates reference terms several_outputs report instrument export"
)
"""The longest first: what one worker begins last the other waits for."""


WHOLE = ("test_next_motion.py", "test_outputs.py", "test_screening_mistakes.py")
"""Files in which nothing is left out of reading and diagnosis; servers and other processes of their own leave nothing out either."""

SCREENED = (*WHOLE, "test_instrument.py", "test_reference_pages.py")


@pytest.fixture(scope="module", autouse=True)
def brief(request: pytest.FixtureRequest) -> Iterator[None]:
    """Elsewhere no mistake of time is looked for in a flight, and no motion to fly next: they take most of a reading, and a fifth
    of a diagnosis.
    """
    from ragg_runtime.identification import next_motion
    from ragg_runtime.screening import timing

    with pytest.MonkeyPatch.context() as patch:
        if request.path.name not in WHOLE:
            patch.setattr(next_motion, "propose_motions", lambda *_: ())
        if request.path.name not in SCREENED:
            patch.setattr(timing, "propose_times", lambda *_: [])
        yield


@pytest.fixture
def no_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pages without figures, which take nearly all of a page's time: for what is about its words."""
    from ragg_runtime.report import plots

    monkeypatch.setattr(plots, "draw_plot", lambda _: "<svg></svg>")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The dearest files first, each whole."""
    rank = {name: k for k, name in enumerate(DEAREST.split())}
    items.sort(key=lambda item: rank.get(item.path.stem.removeprefix("test_"), len(rank)))


def pytest_collection_finish() -> None:
    """What is imported by now stays as long as the tests: the collector of garbage need not look at it each time."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(100_000, 20, 50)
