"""What only the whole of a file tells: gathered in one pass over it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ragg_runtime.flight import slow
from ragg_runtime.flight.angular_acceleration import HEAD
from ragg_runtime.flight.assemble import BRIDGED, ENDLESS, MOST_UNUSED, Layout, Whole, samples_of
from ragg_runtime.flight.record import ANGULAR_RATE, AUXILIARY, SI_UNITS
from ragg_runtime.flight.source import Batch


class Gathering:
    """Gathers what only the whole file tells, in one pass over it, batch by batch."""

    def __init__(self, plan: Layout) -> None:
        self._plan = plan
        self._auxiliary = [c for c in plan.columns if c.name not in SI_UNITS or c.name in AUXILIARY]
        self._rates = [c for c in plan.columns if c.name in ANGULAR_RATE]
        self._time = next(c for c in plan.columns if c.name == "time")
        self._collected = {c.name: slow.Collector() for c in self._auxiliary}
        self._head: list[Batch] = []
        self._rows, self._first, self._last = 0, np.nan, np.nan

    def add(self, batch: Batch) -> None:
        """Some rows more, in the file's units."""
        t = self._plan.converted(self._time, batch["time"])
        if self._rows < HEAD:
            names = (self._time, *self._rates)
            self._head.append({c.name: batch[c.name][: HEAD - self._rows] for c in names})
        self._rows += len(t)
        if len(t):
            self._first, self._last = (t[0] if np.isnan(self._first) else self._first), t[-1]
        for c in self._auxiliary:
            # One value in two seconds: more often than that, blanks are bridged where they stand.
            most = (
                1000 + 2 * int(min(max(np.nan_to_num(t[-1] - self._first), 0.0) / BRIDGED, ENDLESS))
                if len(t)
                else 0
            )
            self._collected[c.name].add(t, self._plan.converted(c, batch[c.name]), most)

    def expected(self) -> Whole:
        """What there is to tell if no channel turns out to be one of a lower rate."""
        names = ["time", *(c.name for c in self._rates)]
        joined = {n: np.concatenate([np.empty(0), *(b[n] for b in self._head)]) for n in names}
        return Whole(self._rows, self._plan.derivative(joined))

    def whole(self) -> Whole:
        """What the whole file tells, after all rows."""
        found: dict[str, slow.Slow] = {}
        left_out, notes = [], []
        for name, collector in self._collected.items():
            series = collector.series() if collector.sparse else None
            if series is None:
                continue
            if self._plan.si_units[name] == "rad":
                series = series[0], np.unwrap(series[1])
            judged = slow.judged(*series)
            whole = self._last - self._first
            if isinstance(judged, slow.Slow) and judged.covered < (1 - MOST_UNUSED) * whole:
                judged = f"its values cover {judged.covered:.4g} s of {whole:.4g} s"
            lacking = self._rows - collector.count
            if isinstance(judged, slow.Slow):
                found[name] = judged
                notes.append(
                    f"{name}: recorded every {judged.step:.4g} s; interpolated (at {lacking} samples)"
                )
            else:
                left_out.append(name)
                notes.append(f"{name}: without a value at {samples_of(lacking)}; left out: {judged}")
        return replace(self.expected(), slow=found, left_out=tuple(left_out), notes=tuple(notes))
