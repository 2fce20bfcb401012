"""ragg in Python: compare derived models of a rotating-accelerometer gravity gradiometer with flights.

>>> import ragg                                               # doctest: +SKIP
>>> m = ragg.new("my-model")
>>> flights = ragg.read_flights(m, ["flight.csv"])
>>> d = ragg.diagnose(m, flights)
>>> d.verdict, d.found
>>> ragg.add(m, d.found[0], flights)

Results have ``as_json()``, a short ``repr`` and a rich display in notebooks. Bad input raises :class:`UserError`.
This package re-exports names of ``ragg_runtime``, which are imported when they are first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ragg_runtime.api import add as add
    from ragg_runtime.api import calibrate as calibrate
    from ragg_runtime.api import compare as compare
    from ragg_runtime.api import compensate as compensate
    from ragg_runtime.api import diagnose as diagnose
    from ragg_runtime.api import export as export
    from ragg_runtime.api import load as load
    from ragg_runtime.api import new as new
    from ragg_runtime.api import read_flights as read_flights
    from ragg_runtime.api import remove as remove
    from ragg_runtime.api import survey as survey
    from ragg_runtime.base.errors import UserError as UserError
    from ragg_runtime.model.derive import effects as effects
    from ragg_runtime.simulate import simulate as simulate

_MODULES = {
    "base.errors": ("UserError",),
    "api": (
        "add", "calibrate", "compare", "compensate", "diagnose", "export", "load", "new", "read_flights", "remove",
        "survey",
    ),
    "model.derive": ("effects",),
    "simulate": ("simulate",),
}  # fmt: skip
__all__ = sorted(name for names in _MODULES.values() for name in names)


def __getattr__(name: str) -> Any:
    for module, names in _MODULES.items():
        if name in names:
            return getattr(import_module(f"ragg_runtime.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
