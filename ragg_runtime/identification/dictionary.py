"""Generic terms, harmonic x product of channels: where a residual lives, in no effect's name.

The dictionary behind ``where`` and ``unexplained``, searched sparsely: harmonics 0 ... 4 of the spin times products
of up to three channels (motion, its time derivatives, auxiliary channels); and, without harmonics, what a transducer
may make of the forces on it as they turn with the disc: higher powers, kinks and signs, rates, after-effects,
products with auxiliary channels and with rotation. Of those, a sum of harmonics would have to be long: f_i^4 alone is
fifteen of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from itertools import combinations_with_replacement, product
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime.base import series_name
from ragg_runtime.base.progress import split_range
from ragg_runtime.base.series_name import ChannelName, Derivative, Function, Product, Relaxation, Series
from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.whitening import Piece, PreparedFlight
from ragg_runtime.io.record import GRADIENT, SI_UNITS, is_disc_angle
from ragg_runtime.model.record import Record
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]
Singles = NDArray[np.float32]

FORCES = ("f_i", "f_o")  # forces that turn with the disc

NOTHING: Mapping[str, float] = MappingProxyType({})

# the output as the model predicts it: what a converter or an amplifier bends, whatever it is made of
OUTPUT = "G_out"
HIGHEST = 4  # highest multiple of the spin rate: what second-order terms of a rotating force reach (Eq. 17)
HIGHEST_OF_ONE = 6  # the same of constants and single channels, which are few

MOTION = tuple(f"{n}_{k}" for n in ("a", "omega", "omegadot") for k in "xyz")
_CUBIC = tuple(f"{n}_{k}" for n in ("a", "omega") for k in "xyz")
_RATES = tuple(f"{d}_{n}_{k}" for d, n in (("d", "a"), ("d2", "a"), ("d", "omegadot")) for k in "xyz")

# what the first accelerometer feels along its input, output and (but for the sign) pendulous axis
_FORCES = (*FORCES, "a_z")
CREEP = (1, 5, 20, 60)  # time constants, s, of relaxations of channels
# the same of forces that turn with the disc, of which a slower one keeps little
TURNING_CREEP = (0.1, 0.3, 1, 3, 10)
# the same of the sense of motion: play and friction give way over some way after it turns round
FRICTION = (0.2, 0.5, 1)
WARMTH = (5, 20, 60)  # the same of squares: what the power that a motion dissipates warms
TOGETHER = 32  # terms whose series are made at a time
# terms of the output itself
OF_OUTPUT = ((OUTPUT, OUTPUT), (OUTPUT, OUTPUT, OUTPUT), (f"abs({OUTPUT})",), (f"sign({OUTPUT})",))


@dataclass(frozen=True)
class Term:
    """``harmonic`` (const, cos k, sin k) times the product of ``channels`` (none: 1)."""

    harmonic: str
    channels: tuple[str, ...]

    @property
    def product(self) -> str:
        """Names joined by ``*``, ``1`` for none."""
        return "*".join(self.channels) or "1"

    @property
    def order(self) -> int:
        """Number of channels, and of functions of them: how much a term asks one to believe."""
        return sum(
            n.count("(") + len(series_name.list_channels(series_name.series(n))) for n in self.channels
        )

    @property
    def felt(self) -> Term:
        """As an accelerometer feels it: a change of the output's gain is one of the scale factors."""
        once = self.channels.count(OUTPUT) == 1
        return replace(self, channels=tuple("f_i" if once and n == OUTPUT else n for n in self.channels))

    @property
    def words(self) -> str:
        """What effects of which it is all that a record shows have in common."""
        kind, _, turns = self.harmonic.partition(" ")
        if not self.channels:
            return f"a constant term at {name_multiple(int(turns))}" if turns else "a constant offset"
        where = "" if kind == "const" else f" at {name_multiple(int(turns))}"
        return f"a term proportional to {numbers.product(self.product)}{where}"


def name_multiple(turns: int) -> str:
    """A multiple of the spin rate."""
    return {1: "the spin rate", 2: "twice the spin rate"}.get(turns, f"{turns} times the spin rate")


class Dictionary:
    """The terms that a flight allows, and their series over the flight or a part of it.

    Of auxiliary channels and of time only the changes are physics here (their means are in the base), so
    these enter less their means. ``output`` (N,), V: what the model predicts, where one output is recorded (``None``: several are).
    """

    def __init__(self, r: Record, output: Array | None = None) -> None:
        self._record = r
        self._of_output: dict[str, Array] = {}
        if output is not None:
            bent = {f"abs({OUTPUT})": np.abs(output), f"sign({OUTPUT})": np.sign(output)}
            self._of_output = {OUTPUT: output, **bent}
        centred = sorted(n for n in r.wide if n not in (*MOTION, *GRADIENT) and not is_disc_angle(n))
        self.centre: Mapping[str, float] = {}
        self.centre = {n: float(np.mean(self._channel(n, r)[r.valid])) for n in (*centred, "time")}
        rates = [n for n in _RATES if n.partition("_")[2] in r.wide]
        names = [*(n for n in MOTION if n in r.wide), *centred, "time", *rates, *(f"d_{n}" for n in centred)]
        further = [c for c in list_generic([*centred, "time"]) if all(is_recorded(n, r) for n in c)]
        functions = dict.fromkeys(n for c in further for n in c if n not in names)
        self._size = self._measure([*names, *functions, *self._of_output])
        names = [n for n in names if n in self._size]
        motion = [n for n in names if n in MOTION]
        other = [n for n in names if n not in MOTION]
        products: list[tuple[str, ...]] = [(), *((n,) for n in names)]
        products += list(combinations_with_replacement(motion, 2))
        products += [
            (m, o) for m in motion if m.startswith(("a_", "omega_")) for o in other if o in self.centre
        ]
        products += list(combinations_with_replacement([n for n in names if n in _CUBIC], 3))
        # of a disc at rest every harmonic is a constant
        of_one, of_several = (list_harmonics(n if r.turning else 0) for n in (HIGHEST_OF_ONE, HIGHEST))
        alone = [Term(h, c) for c in products if len(c) <= 1 for h in of_one]
        alone += [Term("const", (f,)) for f in FORCES if f in self._size]
        several = [Term(h, c) for c in products if len(c) > 1 for h in of_several]
        generic = [c for c in (*further, *OF_OUTPUT) if all(n in self._size for n in c)]
        self.terms: tuple[Term, ...] = (*alone, *several, *(Term("const", c) for c in generic))
        self.first_order = len(alone)
        """Constants, single channels and turning forces: so many of the terms, the first."""
        self.channels = tuple(n for n in names if n in MOTION or n in self.centre)
        """Of these terms the recorded ones, and time."""

    def with_terms(self, terms: Sequence[Term]) -> Dictionary:
        """The dictionary of other terms, whose functions of auxiliary channels may be new."""
        dictionary = copy(self)
        names = dict.fromkeys(n for t in terms for n in t.channels if n not in self._size)
        dictionary._size = self._size | self._measure([*names])
        dictionary.terms = tuple(t for t in terms if all(n in dictionary._size for n in t.channels))
        dictionary.first_order = 0
        return dictionary

    def _measure(self, names: Sequence[str]) -> dict[str, float]:
        """Root mean squares, SI, of those series that are not constant."""
        sizes, r = {}, self._record
        for n in names:
            x = self._channel(n, r)[r.valid]
            if np.ptp(x) > 0.0 or n in self._of_output:
                sizes[n] = float(np.sqrt(np.mean(x**2))) or 1.0
        return sizes

    def __contains__(self, name: str) -> bool:
        """Whether a series is there and not constant."""
        return name in self._size

    def size(self, term: Term) -> float:
        """A fixed size of the term's series, SI: the product of its channels' root mean squares."""
        return float(np.prod([self._size[n] for n in term.channels])) if term.channels else 1.0

    def series(self, term: Term, r: Record) -> Array:
        """(N,), SI, over a record of this flight."""
        if any(n not in self._size for n in term.channels):
            return self.with_terms([term]).series(term, r)
        x = make_carrier(r, term.harmonic)
        for name in term.channels:
            x = x * self._channel(name, r)
        return x

    def make_chunks(self, r: Record, chosen: Sequence[Term]) -> Iterator[tuple[slice, Singles]]:
        """Places of the chosen terms, a few at a time, and their series (terms, N) over ``size``, zero where not valid."""
        carriers = {
            h: make_carrier(r, h).astype(np.float32) for h in dict.fromkeys(t.harmonic for t in chosen)
        }
        names = dict.fromkeys(n for t in chosen for n in t.channels)
        channels = {
            n: (np.where(r.valid, self._channel(n, r), 0.0) / self._size[n]).astype(np.float32) for n in names
        }
        one = np.where(r.valid, np.float32(1.0), np.float32(0.0))
        for places in split_range(len(chosen), TOGETHER):
            part = chosen[places]
            x = np.empty((len(part), len(one)), dtype=np.float32)
            product, of = one, tuple[str, ...]()
            for n, t in enumerate(part):
                if t.channels != of:
                    product, of = one, t.channels
                    for name in of:
                        product = product * channels[name]
                np.multiply(product, carriers[t.harmonic], out=x[n])
            yield places, x

    def _channel(self, name: str, r: Record) -> Array:
        first = int(np.searchsorted(self._record.time, r.time[0]))
        rows = slice(first, first + len(r.time))
        if name in self._of_output:
            return self._of_output[name][rows]
        if isinstance(
            series_name.series(name), Relaxation
        ):  # it remembers more than a part of a record holds
            return relax(name, self._record, rows, self.centre)
        return make_series(name, r, self.centre)


def list_generic(auxiliary: Sequence[str]) -> list[tuple[str, ...]]:
    """Products, of any order, by which a transducer may depend on the force on it; ``auxiliary``: see above."""
    a, omega, omegadot = (tuple(f"{n}_{k}" for k in "xyz") for n in ("a", "omega", "omegadot"))
    rates = tuple(f"d_{f}" for f in _FORCES)
    turning = FORCES
    pairs = list(combinations_with_replacement(_FORCES, 2))
    memory = [
        f"slow({x}, {t} s)" for names, ts in ((a, CREEP), (turning, TURNING_CREEP)) for x in names for t in ts
    ]
    memory += [f"slow(square({x}), {t} s)" for x in ("f_i", "a_z") for t in WARMTH]
    memory += [f"slow(sign(d_{x}), {t} s)" for x in turning for t in FRICTION]
    products: list[tuple[str, ...]] = [(n,) for n in memory]
    products += [(n,) for f in turning for n in (f"d_{f}", f"d2_{f}")]
    products += [(n,) for x in (*_FORCES, *rates) for n in (f"abs({x})", f"sign({x})")]
    products += [(x, f"abs({y})") for x, y in product(_FORCES, _FORCES)]
    products += [(x, x, f"sign({y})") for x, y in product(_FORCES, rates)]
    products += [(x, x, f"abs({x})") for x in _FORCES]
    products += combinations_with_replacement(_FORCES, 4)
    products += [(x,) * 5 for x in _FORCES]
    products += product(_FORCES, rates)
    products += combinations_with_replacement(rates, 2)
    products += [(*p, d) for p in pairs for d in rates]
    products += product(turning, (*omega, *omegadot))
    products += [(x, *p) for x in turning for p in combinations_with_replacement(omega, 2)]
    products += [(*p, w) for p in pairs for w in (*omega, *omegadot)]
    for n in auxiliary:
        products += [(n, n), *((x, n) for x in turning)]
        products += [(x, n, n) for x in _FORCES] + [(*p, n) for p in pairs]
        products += [] if n == "time" else [(x, f"d_{n}") for x in _FORCES]
    return products


def list_harmonics(highest: int = HIGHEST) -> tuple[str, ...]:
    """const, cos 1, sin 1 ... up to a multiple of the spin rate."""
    return ("const", *(f"{f} {k}" for k in range(1, highest + 1) for f in ("cos", "sin")))


def make_carrier(r: Record, harmonic: str) -> Array:
    """(N,): 1, cos(k phi) or sin(k phi)."""
    function, multiple = series_name.harmonic(harmonic)
    if not multiple:
        return np.ones(len(r.time))
    z = (r.cos_phi + 1j * r.sin_phi) ** multiple
    return np.asarray(z.real if function == "cos" else z.imag)


# --- whitened: the directions along which a residual is asked. Any tells a standard normal deviate from white noise; the
# whitened series of a term is the one that finds the term best.


def whiten_terms(
    x: PreparedFlight, dictionary: Dictionary, piece: Piece, terms: Sequence[Term], only: int | None = None
) -> Iterator[tuple[slice, Array, Array]]:
    """Of some terms, a few at a time, their places, their series (terms, N) over a segment, and these whitened (terms, rows).

    As terms of the output, or of ``only`` one of its series. They are made in single precision, and summed in double.
    """
    o, rows, noise = piece.observation, piece.rows, x.noise
    signs = o.weights if only is None else np.where(np.arange(len(o.signs)) == only, o.signs, 0.0)
    lead = min(rows.start, noise.memory)
    wide = x.observation.record.part(slice(rows.start - lead, rows.stop)) if lead else o.record
    level = np.broadcast_to(noise.level.of(wide.quantity), wide.valid.shape)
    for at, series in dictionary.make_chunks(wide, terms):
        if o.recorded.demodulated:  # what the recorder made of G_out before it was recorded
            series = o.recorded.through(series.astype(np.float64), wide).astype(np.float32)
            series[:, ~wide.valid] = 0.0
        whole = (noise.whiten_series(series, k, None, level, None, lead)[0] for k in range(noise.outputs))
        parts = [float(w) * y[:, o.record.valid] for w, y in zip(noise.weights(signs), whole, strict=True)]
        X = np.concatenate(parts, axis=1)
        unknown_gradient.project(X, piece.windows)
        yield at, series[:, lead:].astype(np.float64), X.astype(np.float64)


# --- series that terms are made of: recorded channels, forces that turn with the disc, and what follows them. Their names are those of
# :mod:`ragg_runtime.base.series_name`. ``f_i`` and ``f_o`` are the specific force along the input and output axes of the first
# accelerometer, a_y cos phi - a_x sin phi and a_x cos phi + a_y sin phi (those of the others are the same up to sign, in the third and
# fourth with f_i and f_o exchanged).


def is_recorded(name: str, r: Record) -> bool:
    """Whether a record has all that a series needs."""
    channels = series_name.list_channels(series_name.series(name, r.wide.keys()))
    needed = {x for n in channels for x in (("a_x", "a_y") if n in FORCES and n not in r.wide else (n,))}
    return needed <= {"time", *r.wide}


def make_series(name: str, r: Record, centre: Mapping[str, float] = NOTHING) -> Array:
    """(N,), SI: a series over a record or a part of it, relaxations excepted (:func:`relax`); channels less their ``centre``."""
    return _evaluate(series_name.series(name, r.wide.keys()), r, centre)


def _evaluate(s: Series, r: Record, centre: Mapping[str, float]) -> Array:
    if isinstance(s, Function):
        functions = {"abs": np.abs, "sign": np.sign, "square": np.square}
        return np.asarray(functions[s.name](_evaluate(s.of, r, centre)))
    if isinstance(s, Product):
        return np.asarray(np.prod([_evaluate(x, r, centre) for x in s.of], axis=0))
    name = str(s)
    if name not in r.wide and series_name.list_channels(s)[0] in FORCES:
        return _turn_forces(name, r)
    values = r.time if name == "time" else r.series(name)
    assert values is not None, name
    return np.asarray(values - centre[name]) if name in centre else values


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


FORGOTTEN = 20.0  # time constants after which a relaxation no longer knows where it began: e^-20 is 2e-9


def relax(name: str, r: Record, rows: slice, centre: Mapping[str, float] = NOTHING) -> Array:
    """(N,), SI: the series ``slow(X, T s)`` over some rows of a record: y' = (X - y)/T, from rest.

    Zero is the value of X at the first valid sample, unless X turns with the disc (:func:`begins_at_zero`).
    """
    s = series_name.series(name, r.wide.keys())
    assert isinstance(s, Relaxation), name
    samples = r.rate * float(s.seconds)
    lead = min(rows.start, int(FORGOTTEN * samples))
    part, first = r.part(slice(rows.start - lead, rows.stop)), int(np.argmax(r.valid))
    origin = 0.0
    if not begins_at_zero(s.of, centre):
        origin = float(_evaluate(s.of, r.part(slice(first, first + 1)), centre)[0])
    x = np.where(part.valid, _evaluate(s.of, part, centre) - origin, 0.0)
    decay = float(np.exp(-1.0 / samples))
    return np.asarray(signal.lfilter([1.0 - decay], [1.0, -decay], x)[lead:])


def find_term_unit(channels_: Sequence[str]) -> str:
    """Unit of a term's coefficient: V over the units of its channels."""
    units = [u for c in channels_ if (u := find_channel_unit(c)) != "1"]
    return "V" if not units else f"V/({'*'.join(units)})"


def find_channel_unit(name: str) -> str:
    """SI unit of a series."""
    return _derive_unit(series_name.series(name, SI_UNITS.keys()))


def _derive_unit(s: Series) -> str:
    match s:
        case ChannelName(name):
            return "m/s^2" if name in FORCES else SI_UNITS.get(name, "1")
        case Derivative(of, order):
            unit = _derive_unit(of)
            return f"m/s^{2 + order}" if unit == "m/s^2" else f"{unit}/{'s' if order == 1 else 's^2'}"
        case Function(name, of):
            unit = _derive_unit(of)
            return {"abs": unit, "sign": "1", "square": f"({unit})^2"}[name]
        case Product(factors):
            return "*".join(f"({_derive_unit(x)})" for x in factors)
        case Relaxation(of):
            return _derive_unit(of)
