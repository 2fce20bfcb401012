"""ragg in Python: derived models of a rotating-accelerometer gravity gradiometer, held against flights.

>>> import ragg                                               # doctest: +SKIP
>>> m = ragg.new("my-model")
>>> flights = ragg.read_flights(m, ["flight.csv"])
>>> d = ragg.diagnose(m, flights)
>>> d.verdict, d.found
>>> ragg.add(m, d.found[0], flights)

Results have ``as_json()``, a short ``repr`` and a rich display in notebooks. Bad input raises :class:`UserError`.
This package holds no code of its own: its stub says which names of ``ragg_runtime`` it hands on; they load when they
are first used.
"""

from ragg_runtime.base.late import hand_on

hand_on(__name__)
