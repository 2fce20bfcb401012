"""The series that the page draws, each made when it is first asked for."""

from __future__ import annotations

import struct
import tempfile
import threading
from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime import api
from ragg_runtime.api import Compensation, Loaded
from ragg_runtime.base.errors import UserError
from ragg_runtime.identification import comparison, foresee, heat
from ragg_runtime.identification import series as reported
from ragg_runtime.identification.comparison import Comparison
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.io import Flight
from ragg_runtime.io.record import DEMODULATED
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]

KEPT = 48
"""Most series that are kept: of a day at 100 Hz each takes 40 MB, of an hour at 16 Hz a quarter of one."""

MOST_BYTES = 1 << 30
"""Most memory that they may take together, bytes."""

NOT_SPINNING = "disc not spinning: no demodulation"


@dataclass(frozen=True)
class Effect:
    """Samples of a flight, and what effects would take out of the residual there, V."""

    rows: slice
    volts: Array


@dataclass
class Cache:
    """Made things by name, the least used forgotten first."""

    _found: OrderedDict[tuple[object, ...], object] = field(default_factory=OrderedDict)
    _making: dict[tuple[object, ...], threading.Lock] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def get(self, key: tuple[object, ...], make: Callable[[], object]) -> object:
        """What belongs to ``key``; one thread makes it, those that want the same wait."""
        with self._lock:
            own = self._making.setdefault(key, threading.Lock())
        with own:
            with self._lock:
                if key in self._found:
                    self._found.move_to_end(key)
                    return self._found[key]
            made = make()
            with self._lock:
                self._found[key] = made
                while len(self._found) > KEPT or (len(self._found) > 2 and self._bytes() > MOST_BYTES):
                    self._found.popitem(last=False)
            return made

    def _bytes(self) -> int:
        return sum(_size(x) for x in self._found.values())


def _size(x: object) -> int:
    if isinstance(x, Pyramid):
        return x.values.nbytes
    return x.nbytes if isinstance(x, np.ndarray) else sum(map(_size, x)) if isinstance(x, list) else 0


@dataclass(frozen=True)
class Tracks:
    """Series of one comparison, and of the one before it."""

    now: Comparison | None = None
    before: Comparison | None = None
    found: Diagnosis | None = None
    cache: Cache = field(default_factory=Cache)

    @staticmethod
    def of(now: Comparison, before: Comparison | None) -> Tracks:
        return Tracks(now=now, before=before)

    def diagnosed(self, d: Diagnosis) -> Tracks:
        """The same with what needs the columns of the candidates."""
        return replace(self, found=d)

    @property
    def compared(self) -> Comparison:
        """UserError if there is none yet."""
        if self.now is None:
            raise UserError("there is nothing to draw yet", remedy="wait until the flights are compared")
        return self.now

    def places(self, flight: int) -> list[int]:
        """What was compared of a flight, by its place among all: one observation of each output that it holds."""
        return [n for n, o in enumerate(self.compared.fitted.observations) if o.flight == flight]

    def place(self, flight: int, output: int) -> int:
        """Which observation an output of a flight is: what ``flight`` means everywhere below."""
        known = self.places(flight)
        if not 0 <= output < len(known):
            raise UserError("there is no such flight", found=f"flight {flight + 1}, output {output + 1}")
        return known[output]

    def volts(self, name: str, flight: int) -> Array:
        """(N,) V of ``measured``, ``modelled``, ``residual`` or ``before``; zero where a sample is not valid."""
        now = self.compared
        f = now.fitted
        if not 0 <= flight < len(f.prepared):
            raise UserError("there is no such flight", found=flight + 1)
        if name == "before":
            old = self.before
            same = old is not None and len(old.fitted.prepared) == len(f.prepared)
            if old is None or not same:
                raise UserError("there is no step before this one")
            return self._of("before", lambda: old.residual)[flight]
        if name == "residual":
            return self._of("residual", lambda: now.residual)[flight]
        if name == "measured":
            return reported.measured(f.prepared[flight])
        if name == "modelled":
            return self.volts("measured", flight) - self.volts("residual", flight)
        raise UserError("there is no such series", found=repr(name[:40]))

    def _of(self, name: str, make: Callable[[], list[Array]]) -> list[Array]:
        return self.cache.get((name,), make)  # type: ignore[return-value]

    def effect(
        self, effects: tuple[str, ...], flight: int, window: tuple[float, float] | None = None
    ) -> Effect:
        """What these effects would take out of the residual, of a long flight where ``window`` (s) lies alone."""
        d = self.found
        if d is None:
            raise UserError("the effects are not tested yet", remedy="wait a moment")
        if not 0 <= flight < len(d.fitted.prepared):
            raise UserError("there is no such flight", found=flight + 1)
        rows = foresee.rows_within(d.fitted, flight, window or (0.0, float("inf")))

        def make() -> Effect:
            v = foresee.coefficients(d.fitted, foresee.field(d), effects)
            return Effect(*foresee.signature(d.fitted, flight, v, rows))

        return self.cache.get(("effect", effects, flight, rows.start, rows.stop), make)  # type: ignore[return-value]

    def term(self, harmonic: str, product: str, flight: int) -> Array:
        """(N,) V: a generic term as it would be fitted by itself."""
        h = self.heat((), flight)
        if harmonic not in h.harmonics or product not in h.products:
            raise UserError("there is no such term", found=f"{harmonic} x {product}"[:80])
        c = float(h.coefficient[h.harmonics.index(harmonic), h.products.index(product)])
        if not np.isfinite(c):
            raise UserError("the model holds this term already", found=f"{harmonic} x {product}")
        prepared = self.compared.fitted.prepared[flight]
        return self.cache.get(  # type: ignore[return-value]
            ("term", harmonic, product, flight), lambda: heat.series(prepared, harmonic, product, c)
        )

    def band(self, name: str, flight: int) -> Array:
        """(N,) V: what of the residual lies in a band, ``band:low:high`` (Hz)."""
        try:
            low, high = (float(x) for x in name.split(":")[1:])
        except ValueError:
            raise UserError("a band is needed", found=repr(name[:40]), expected="band:0.2:0.3") from None
        r = self.compared.fitted.prepared[flight].observation.record
        return reported.within_band(self.volts("residual", flight), r.rate, low, high)

    def heat(self, effects: tuple[str, ...], flight: int) -> heat.Heat:
        """Harmonic x motion term of what is left once these effects are in."""
        d = self.found
        f = self.compared.fitted if d is None else d.fitted
        given = [] if d is None else foresee.columns_of(foresee.field(d), effects)
        if not 0 <= flight < len(f.prepared):
            raise UserError("there is no such flight", found=flight + 1)

        def make() -> heat.Heat:
            return heat.heat(f.prepared[flight], f.triangles[flight], f.n_base, given)

        return self.cache.get(("heat", effects, flight, d is None), make)  # type: ignore[return-value]

    def drawn(
        self,
        name: str,
        unit: str,
        flight: int,
        effects: tuple[str, ...] = (),
        window: tuple[float, float] | None = None,
    ) -> Pyramid:
        """A series in V, Eo, or demodulated (``inline``, ``cross``, Eo).

        ``effect`` is what ``effects`` would take out of the residual, ``left`` what they would leave.
        """
        f = self.compared.fitted
        r = f.prepared[flight if 0 <= flight < len(f.prepared) else 0].observation.record
        if name in ("effect", "left"):
            e = self.effect(effects, flight, window)
            if len(e.volts) < len(r.time):
                return self._stretch(name, unit, flight, e)

        def make() -> Pyramid:
            x = self.series(name, flight, effects)
            time = r.time
            if unit in DEMODULATED:
                if not r.turning:
                    raise UserError(NOT_SPINNING)
                found = comparison.demodulated_one(f, flight, x)
                if not len(found[0]):
                    raise UserError(
                        "the flight is too short to be demodulated", where=f.observations[flight].name
                    )
                time, x = found[0], found[1 + DEMODULATED.index(unit)]
                return _pyramid_of_gaps(time, x, 1.0 / r.rate)
            scale = 1.0 if unit == "V" else 1.0 / f.scales[flight]
            y = np.where(r.valid, x * scale, np.nan)
            return pyramid(float(time[0]), 1.0 / r.rate, len(y), lambda s: y[s])

        return self.cache.get(("drawn", name, unit, flight, effects), make)  # type: ignore[return-value]

    def _stretch(self, name: str, unit: str, flight: int, e: Effect) -> Pyramid:
        """The part of a long flight for which an effect's signature is known."""
        if unit in DEMODULATED:
            raise UserError("the signature of an effect is drawn in V or Eo alone in so long a flight")
        f = self.compared.fitted
        r = f.prepared[flight].observation.record
        x = e.volts if name == "effect" else self.volts("residual", flight)[e.rows] - e.volts
        y = np.where(r.valid[e.rows], x * (1.0 if unit == "V" else 1.0 / f.scales[flight]), np.nan)
        return pyramid(float(r.time[e.rows.start]), 1.0 / r.rate, len(y), lambda s: y[s])

    def series(self, name: str, flight: int, effects: tuple[str, ...] = ()) -> Array:
        """(N,) V of any series: ``effect``, ``left`` (the residual without them), ``term:h:p``, or one of volts."""
        if name == "effect":
            return self.effect(effects, flight).volts
        if name == "left":
            return self.volts("residual", flight) - self.effect(effects, flight).volts
        if name.startswith("term:"):
            _, harmonic, product = name.split(":", 2)
            return self.term(harmonic, product, flight)
        if name.startswith("band:"):
            return self.band(name, flight)
        return self.volts(name, flight)

    def channel(self, name: str, flight: int) -> Pyramid:
        """A recorded channel in its own unit."""
        r = self.compared.fitted.prepared[flight].observation.record
        if name not in r.wide:
            raise UserError("the flight has no such channel", found=repr(name[:40]))
        y = np.where(r.valid, r.wide[name], np.nan)
        made = lambda: pyramid(float(r.time[0]), 1.0 / r.rate, len(y), lambda s: y[s])  # noqa: E731
        return self.cache.get(("channel", name, flight), made)  # type: ignore[return-value]


def _pyramid_of_gaps(time: Array, x: Array, step: float) -> Pyramid:
    """Of a series on a uniform grid some of whose samples are missing: NaN there."""
    places = np.round((time - time[0]) / step).astype(np.intp)
    y = np.full(int(places[-1]) + 1, np.nan)
    y[places] = x
    return pyramid(float(time[0]), step, len(y), lambda s: y[s])


Floats = NDArray[np.floating[Any]]
Singles = NDArray[np.float32]

FINEST = 16
"""Samples in a stretch of the finest level: below it the samples themselves are sent."""

FACTOR = 4
"""How many stretches make one of the next level."""

CHUNK = 1 << 20
"""Samples that are looked at at a time: a multiple of ``FINEST``."""

HEAD = struct.Struct("<4sIddI")
"""What is sent: mark, number of points, first abscissa, step, kind (0: values, 1: least and greatest values)."""


@dataclass(frozen=True)
class Pyramid:
    """A uniformly sampled series (N,), NaN where there is none, from ``start`` in steps of ``step`` (s), and its
    extremes.

    ``levels`` are (2, n), least and greatest value of stretches of ``FINEST * FACTOR**k`` samples.
    """

    start: float
    step: float
    values: Singles
    levels: tuple[Singles, ...]

    def window(self, first: float, last: float, points: int) -> bytes:
        """The series between two abscissae in at most about ``points`` values or pairs, as :data:`HEAD` and floats."""
        n = len(self.values)
        a = int(np.clip(np.floor((first - self.start) / self.step), 0, n))
        b = int(np.clip(np.ceil((last - self.start) / self.step) + 1, a, n))
        if b - a <= 2 * points or not self.levels:
            return _packed(self.values[None, a:b], self.start + a * self.step, self.step, 0)
        level = 0
        while level + 1 < len(self.levels) and (b - a) / (FINEST * FACTOR ** (level + 1)) >= points:
            level += 1
        length = FINEST * FACTOR**level
        i, j = a // length, -(-b // length)
        middle = self.start + (i + 0.5) * length * self.step - 0.5 * self.step
        return _packed(self.levels[level][:, i:j], middle, length * self.step, 1)


def pyramid(start: float, step: float, count: int, part: Callable[[slice], Floats]) -> Pyramid:
    """The pyramid of ``count`` samples; ``part`` yields some of them, in any float, NaN where there is none."""
    values = np.empty(count, dtype=np.float32)
    for k in range(0, count, CHUNK):
        some = slice(k, min(k + CHUNK, count))
        values[some] = part(some)
    levels: list[Singles] = []
    length = FINEST
    while count > 4 * length:
        levels.append(_coarser(levels[-1], FACTOR) if levels else _coarser(values[None], FINEST))
        length *= FACTOR
    return Pyramid(start=start, step=step, values=values, levels=tuple(levels))


def _coarser(below: Singles, by: int) -> Singles:
    """Extremes of stretches of ``by`` samples, a power of two: by halves, a quarter of the time of a reduction of each."""
    short = -below.shape[1] % by
    whole = np.pad(below, ((0, 0), (0, short)), constant_values=np.nan) if short else below
    least, greatest = whole[0], whole[-1]
    with np.errstate(invalid="ignore"):  # fmin and fmax pass NaN over
        while by > 1:
            least, greatest = np.fmin(least[::2], least[1::2]), np.fmax(greatest[::2], greatest[1::2])
            by //= 2
    return np.stack([least, greatest])


def _packed(values: Singles, start: float, step: float, kind: int) -> bytes:
    head = HEAD.pack(b"RAGG", values.shape[1], start, step, kind)
    return head + np.ascontiguousarray(values, dtype="<f4").tobytes()


def compensated(m: Loaded, flights: Sequence[Flight], kind: str, demodulator: str) -> Compensation:
    """As ``ragg compensate``."""
    if not flights:
        raise UserError("no flight is open", remedy="choose one first")
    return api.compensate(m, flights, kind, demodulator)  # type: ignore[arg-type]


def kept(m: Loaded) -> str | None:
    """Where the calibration comes from that is kept with the model, or why it does not count; ``None``: there is none."""
    if m.directory.calibration is None:
        return None
    try:
        saved = api.saved_calibration(m)
    except UserError as e:
        return f"not used: {e.what}"
    return f"of {saved.time[:16].replace('T', ' ')} UTC, on {numbers.listed([numbers.clean(n) for n in saved.flights])}"


def curve(c: Compensation | None, what: str, flight: int) -> Pyramid:
    """``inline`` and such, or ``inline:low`` and ``inline:high``: one standard uncertainty below and above it, Eo."""
    name, _, edge = what.partition(":")
    if (
        c is None
        or not 0 <= flight < len(c.series)
        or f"{name}_std" not in c.units
        or edge not in ("", "low", "high")
    ):
        raise UserError("there is no such compensated channel", found=what[:40])
    x = c.series[flight]
    time, sign = x["time"], {"": 0.0, "low": -1.0, "high": 1.0}[edge]
    step = float(time[-1] - time[0]) / max(1, len(time) - 1)
    return pyramid(
        float(time[0]),
        step,
        len(time),
        lambda s: x[name][s] + sign * x[f"{name}_std"][s] if sign else x[name][s],
    )


def file_of(c: Compensation, name: str) -> bytes:
    """The series as CSV or Parquet, by the ending of the name."""
    with tempfile.TemporaryDirectory(prefix="ragg-") as folder:
        path = Path(folder, name)
        c.write(path)
        return path.read_bytes()
