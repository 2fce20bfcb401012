"""ragg in Python: derived models of a rotating-accelerometer gravity gradiometer, held against flights.

>>> import ragg                                               # doctest: +SKIP
>>> m = ragg.new("my-model")
>>> flights = ragg.read_flights(m, ["flight.csv"])
>>> d = ragg.diagnose(m, flights)
>>> d.verdict, d.found
>>> ragg.add(m, d.found[0], flights)

Results have ``as_json()``, a short ``repr`` and a rich display in notebooks. Bad input raises :class:`UserError`.
This package holds no code of its own: names are loaded from ``ragg_runtime`` when they are first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ragg_runtime.base.errors import UserError as UserError
    from ragg_runtime.workflow.after import calibrate as calibrate
    from ragg_runtime.workflow.after import compensate as compensate
    from ragg_runtime.workflow.after import export as export
    from ragg_runtime.workflow.catalogue import effects as effects
    from ragg_runtime.workflow.loop import add as add
    from ragg_runtime.workflow.loop import compare as compare
    from ragg_runtime.workflow.loop import diagnose as diagnose
    from ragg_runtime.workflow.loop import load as load
    from ragg_runtime.workflow.loop import new as new
    from ragg_runtime.workflow.loop import read_flights as read_flights
    from ragg_runtime.workflow.loop import remove as remove
    from ragg_runtime.workflow.loop import survey as survey
    from ragg_runtime.workflow.online import online as online
    from ragg_runtime.workflow.simulate import simulate as simulate

_FROM = {
    "UserError": "ragg_runtime.base.errors",
    "add": "ragg_runtime.workflow.loop",
    "calibrate": "ragg_runtime.workflow.after",
    "compare": "ragg_runtime.workflow.loop",
    "compensate": "ragg_runtime.workflow.after",
    "diagnose": "ragg_runtime.workflow.loop",
    "effects": "ragg_runtime.workflow.catalogue",
    "export": "ragg_runtime.workflow.after",
    "load": "ragg_runtime.workflow.loop",
    "new": "ragg_runtime.workflow.loop",
    "online": "ragg_runtime.workflow.online",
    "read_flights": "ragg_runtime.workflow.loop",
    "remove": "ragg_runtime.workflow.loop",
    "simulate": "ragg_runtime.workflow.simulate",
    "survey": "ragg_runtime.workflow.loop",
}

__all__ = sorted(_FROM)


def __getattr__(name: str) -> Any:
    if name not in _FROM:
        raise AttributeError(f"module 'ragg' has no attribute {name!r}")
    value = getattr(import_module(_FROM[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_FROM})
