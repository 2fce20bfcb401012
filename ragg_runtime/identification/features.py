"""Series that generic terms are made of: recorded channels, forces that turn with the disc, and what follows them.

Their names are those of :mod:`ragg_runtime.base.series_name`. ``f_i`` and ``f_o`` are the specific force along the input
and output axes of the first accelerometer, a_y cos phi - a_x sin phi and a_x cos phi + a_y sin phi (those of the others
are the same up to sign, in the third and fourth with f_i and f_o exchanged).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from ragg_runtime.base import series_name
from ragg_runtime.base.series_name import ChannelName, Derivative, Function, Product, Relaxation, Series
from ragg_runtime.io.record import SI_UNITS
from ragg_runtime.model.record import Record

Array = NDArray[np.float64]

FORCES = ("f_i", "f_o")
"""Forces that turn with the disc."""

OUTPUT = "G_out"
"""The output as the model predicts it: what a converter or an amplifier bends, whatever it is made of."""

GRID = 1000
"""Samples between the places from which relaxations can be taken up."""


def is_slow(name: str) -> bool:
    """Whether a series remembers more of the past than a part of a record holds."""
    return isinstance(series_name.series(name), Relaxation)


def is_recorded(name: str, r: Record) -> bool:
    """Whether a record has all that a series needs."""
    found = series_name.list_channels(series_name.series(name, r.wide.keys()))
    needed = {x for n in found for x in (("a_x", "a_y") if n in FORCES and n not in r.wide else (n,))}
    return needed <= {"time", *r.wide}


NOTHING: Mapping[str, float] = MappingProxyType({})


def make_series(name: str, r: Record, centre: Mapping[str, float] = NOTHING) -> Array:
    """(N,), SI: a series over a record or a part of it, relaxations excepted (:class:`Relaxations`); channels less their ``centre``."""
    return _series(series_name.series(name, r.wide.keys()), r, centre)


def _series(s: Series, r: Record, centre: Mapping[str, float]) -> Array:
    if isinstance(s, Function):
        functions = {"abs": np.abs, "sign": np.sign, "square": np.square}
        return np.asarray(functions[s.name](_series(s.of, r, centre)))
    if isinstance(s, Product):
        return np.asarray(np.prod([_series(x, r, centre) for x in s.of], axis=0))
    name = str(s)
    if name not in r.wide and series_name.list_channels(s)[0] in FORCES:
        return _turn_forces(name, r)
    known = r.time if name == "time" else r.series(name)
    assert known is not None, name
    return np.asarray(known - centre[name]) if name in centre else known


def _turn_forces(name: str, r: Record) -> Array:
    """f_i, f_o and derivatives: real and imaginary part of (d/dt + i Omega)^n (a_y + i a_x) times e^(i phi)."""
    order = {"": 0, "d_": 1, "d2_": 2}[name[:-3]]
    spin = 2j * np.pi * r.spin_frequency
    factors = ([1.0], [spin, 1.0], [spin**2, 2 * spin, 1.0])[order]
    z = np.zeros(len(r.time), dtype=np.complex128)
    for prefix, factor in zip(("", "d_", "d2_"), factors, strict=False):
        x, y, _ = r.along_disc(prefix)
        z += factor * (y + 1j * x)
    z *= r.cos_phi + 1j * r.sin_phi
    return np.asarray(z.real if name.endswith("f_i") else z.imag)


def begins_at_zero(s: Series, centre: Mapping[str, float]) -> bool:
    """Whether a series relaxes from zero: a force that turns with the disc, or a function of what has no ``centre``; others from their
    first value.
    """
    if isinstance(s, Product):
        return any(begins_at_zero(x, centre) for x in s.of)
    (base,) = series_name.list_channels(s)
    return base in FORCES or (isinstance(s, Function) and base not in centre)


class Relaxations:
    """Series ``slow(X, T s)``: y' = (X - y)/T, from rest; zero is the value at the first valid sample, unless X turns with the disc
    (:func:`begins_at_zero`).

    They are run through once, segment by segment (:meth:`advance`), and then taken up again anywhere
    (:meth:`series`, which changes nothing).
    """

    def __init__(self, names: Sequence[str], record: Record, centre: Mapping[str, float] = NOTHING) -> None:
        self._record, self._centre = record, centre
        self._of: dict[str, tuple[Series, float]] = {}
        for name in names:
            slow = series_name.series(name, record.wide.keys())
            assert isinstance(slow, Relaxation), name
            self._of[name] = (slow.of, float(np.exp(-1.0 / (record.rate * float(slow.seconds)))))
        self._origin: dict[Series, float] = {}
        self._last = dict.fromkeys(self._of, 0.0)
        self._states: list[dict[str, float]] = []  # before every GRID-th sample
        self._done = 0

    def advance(self, r: Record) -> dict[str, Array]:
        """All series over the next part of the record, (N,), SI."""
        made = {n: self._run(n, r, self._last[n]) for n in self._of}
        for k in range(-self._done % GRID, len(r.time), GRID):
            self._states.append({n: float(y[k - 1]) if k else self._last[n] for n, y in made.items()})
        self._done += len(r.time)
        self._last = {n: float(y[-1]) for n, y in made.items()}
        return made

    def series(self, name: str, r: Record) -> Array:
        """(N,), SI, over any part of the record."""
        start = int(np.searchsorted(self._record.time, r.time[0]))
        k, between = divmod(start, GRID)
        last = self._states[k][name]
        if between:
            last = float(self._run(name, self._record.part(slice(start - between, start)), last)[-1])
        return self._run(name, r, last)

    def _run(self, name: str, r: Record, last: float) -> Array:
        of, c = self._of[name]
        x = _series(of, r, self._centre)
        if begins_at_zero(of, self._centre):
            origin = 0.0
        else:
            if of not in self._origin and r.valid.any():
                self._origin[of] = float(x[np.argmax(r.valid)])
            origin = self._origin.get(of, 0.0)
        x = np.where(r.valid, x - origin, 0.0)
        x = (1.0 - c) * x
        x[:1] += c * last
        # y_n - c y_n-1 = x_n, solved forwards
        bands = np.array([np.ones(len(x)), np.full(len(x), -c)])
        return np.asarray(linalg.blas.dtbsv(1, bands, x, lower=1, diag=1, overwrite_x=True))


def find_term_unit(channels_: Sequence[str]) -> str:
    """Unit of a term's coefficient: V over the units of its channels."""
    units = [find_channel_unit(c) for c in channels_]
    return "V" if not units else f"V/({'*'.join(units)})"


def find_channel_unit(name: str) -> str:
    """SI unit of a series."""
    return _unit(series_name.series(name, SI_UNITS.keys()))


def _unit(s: Series) -> str:
    match s:
        case ChannelName(name):
            return "m/s^2" if name in FORCES else SI_UNITS.get(name, "1")
        case Derivative(of, order):
            unit = _unit(of)
            return f"m/s^{2 + order}" if unit == "m/s^2" else f"{unit}/{'s' if order == 1 else 's^2'}"
        case Function(name, of):
            unit = _unit(of)
            return {"abs": unit, "sign": "1", "square": f"({unit})^2"}[name]
        case Product(factors):
            return "*".join(f"({_unit(x)})" for x in factors)
        case Relaxation(of):
            return _unit(of)
