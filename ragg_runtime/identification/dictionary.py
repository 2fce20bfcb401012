"""Generic terms, harmonic x product of channels: where a residual lives, in no effect's name.

The dictionary behind ``where`` and ``unexplained``, searched sparsely: harmonics 0 ... 4 of the spin times products
of up to three channels (motion, its time derivatives, auxiliary channels); and, without harmonics, what a transducer
may make of the forces on it as they turn with the disc: higher powers, kinks and signs, rates, after-effects,
products with auxiliary channels and with rotation. Of those, a sum of harmonics would have to be long: f_i^4 alone is
fifteen of them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from itertools import combinations_with_replacement, product
from math import comb

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import series_name
from ragg_runtime.base.progress import split_range
from ragg_runtime.base.series_name import ChannelName, Derivative, Function, Product, Relaxation, Series
from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.observation import divide_into_segments
from ragg_runtime.estimation.whitening import Piece, PreparedFlight
from ragg_runtime.identification import features
from ragg_runtime.identification.features import OUTPUT, Relaxations
from ragg_runtime.io.record import GRADIENT, RATES, is_disc_angle
from ragg_runtime.model.record import Record
from ragg_runtime.signals.fir import filter_columns
from ragg_runtime.wording import numbers

Array = NDArray[np.float64]
Singles = NDArray[np.float32]

HIGHEST = 4
"""Highest multiple of the spin rate: what second-order terms of a rotating force reach (Eq. 17)."""

HIGHEST_OF_ONE = 6
"""The same of constants and single channels, which are few."""

_MOTION = tuple(f"{n}_{k}" for n in ("a", "omega", "omegadot") for k in "xyz")
_CUBIC = tuple(f"{n}_{k}" for n in ("a", "omega") for k in "xyz")
_RATES = tuple(f"{d}_{n}_{k}" for d, n in (("d", "a"), ("d2", "a"), ("d", "omegadot")) for k in "xyz")
_NOT_A_CHANNEL = frozenset(GRADIENT)

_FORCES = (*features.FORCES, "a_z")
"""What the first accelerometer feels along its input, output and (but for the sign) pendulous axis."""

CREEP = (1, 5, 20, 60)
"""Time constants, s, of relaxations of channels."""

TURNING_CREEP = (0.1, 0.3, 1, 3, 10)
"""The same of forces that turn with the disc, of which a slower one keeps little."""

FRICTION = (0.2, 0.5, 1)
"""The same of the sense of motion: play and friction give way over some way after it turns round."""

WARMTH = (5, 20, 60)
"""The same of squares: what the power that a motion dissipates warms."""

TOGETHER = 32
"""Terms whose series are made at a time."""

OF_OUTPUT = ((OUTPUT, OUTPUT), (OUTPUT, OUTPUT, OUTPUT), (f"abs({OUTPUT})",), (f"sign({OUTPUT})",))
"""Terms of the output itself."""


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
        self._of_output = {} if output is None else _make_functions(output)
        centred = sorted(n for n in r.wide if n not in _MOTION and _is_channel(n))
        rates = [n for n in _RATES if n.partition("_")[2] in r.wide]
        names = [*(n for n in _MOTION if n in r.wide), *centred, "time", *rates, *(f"d_{n}" for n in centred)]
        further = [c for c in list_generic([*centred, "time"]) if all(features.is_recorded(n, r) for n in c)]
        made = dict.fromkeys(n for c in further for n in c if n not in names)
        found, self._slow = _measure(r, [*names, *made])
        self.centre = {n: found[n].mean for n in (*centred, "time")}
        self._size = {n: s.rms if n not in self.centre else s.spread for n, s in found.items() if s.varies}
        self._size |= {n: _rms(x[r.valid]) or 1.0 for n, x in self._of_output.items()}
        names = [n for n in names if n in self._size]
        motion = [n for n in names if n in _MOTION]
        other = [n for n in names if n not in _MOTION]
        products: list[tuple[str, ...]] = [(), *((n,) for n in names)]
        products += list(combinations_with_replacement(motion, 2))
        products += [
            (m, o) for m in motion if m.startswith(("a_", "omega_")) for o in other if o in self.centre
        ]
        products += list(combinations_with_replacement([n for n in names if n in _CUBIC], 3))
        # of a disc at rest every harmonic is a constant
        of_one, of_several = (list_harmonics(n if r.turning else 0) for n in (HIGHEST_OF_ONE, HIGHEST))
        alone = [Term(h, c) for c in products if len(c) <= 1 for h in of_one]
        alone += [Term("const", (f,)) for f in features.FORCES if f in self._size]
        several = [Term(h, c) for c in products if len(c) > 1 for h in of_several]
        made_of = [c for c in (*further, *OF_OUTPUT) if all(n in self._size for n in c)]
        self.terms: tuple[Term, ...] = (*alone, *several, *(Term("const", c) for c in made_of))
        self.first_order = len(alone)
        """Constants, single channels and turning forces: so many of the terms, the first."""
        self.channels = tuple(n for n in names if n in _MOTION or n in self.centre)
        """Of these terms the recorded ones, and time."""

    def with_terms(self, terms: Sequence[Term]) -> Dictionary:
        """The same of other terms, which may be of further functions: of auxiliary channels less their means."""
        made = copy(self)
        names = dict.fromkeys(n for t in terms for n in t.channels if n not in self._size)
        found, slow = _measure(self._record, [*names], self.centre)
        made._slow = self._slow | slow
        made._size = self._size | {n: s.rms for n, s in found.items() if s.varies}
        made.terms = tuple(t for t in terms if all(n in made._size for n in t.channels))
        made.first_order = 0
        return made

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
        """Of some terms, a few at a time, the places and their series (terms, N) over ``size``, zero where not valid."""
        carriers = {
            h: make_carrier(r, h).astype(np.float32) for h in dict.fromkeys(t.harmonic for t in chosen)
        }
        wanted = dict.fromkeys(n for t in chosen for n in t.channels)
        channels = {
            n: (np.where(r.valid, self._channel(n, r), 0.0) / self._size[n]).astype(np.float32)
            for n in wanted
        }
        one = np.where(r.valid, np.float32(1.0), np.float32(0.0))
        for some in split_range(len(chosen), TOGETHER):
            part = chosen[some]
            x = np.empty((len(part), len(one)), dtype=np.float32)
            product, of = one, tuple[str, ...]()
            for n, t in enumerate(part):
                if t.channels != of:
                    product, of = one, t.channels
                    for name in of:
                        product = product * channels[name]
                np.multiply(product, carriers[t.harmonic], out=x[n])
            yield some, x

    def _channel(self, name: str, r: Record) -> Array:
        if name in self._of_output:
            first = int(np.searchsorted(self._record.time, r.time[0]))
            return self._of_output[name][first : first + len(r.time)]
        slow = self._slow.get(name)
        return features.make_series(name, r, self.centre) if slow is None else slow.series(name, r)


def _make_functions(output: Array) -> dict[str, Array]:
    return {OUTPUT: output, f"abs({OUTPUT})": np.abs(output), f"sign({OUTPUT})": np.sign(output)}


def _rms(x: Array) -> float:
    return float(np.sqrt(np.mean(x**2))) if len(x) else 0.0


def _is_channel(name: str) -> bool:
    """Whether a column that is no motion may enter a term: not gradients, nor the angles of discs."""
    return name not in _NOT_A_CHANNEL and not is_disc_angle(name)


@dataclass(frozen=True)
class _Statistics:
    mean: float
    rms: float
    spread: float
    varies: bool


def list_generic(auxiliary: Sequence[str]) -> list[tuple[str, ...]]:
    """Products, of any order, by which a transducer may depend on the force on it; ``auxiliary``: see above."""
    a, omega, omegadot = (tuple(f"{n}_{k}" for k in "xyz") for n in ("a", "omega", "omegadot"))
    rates = tuple(f"d_{f}" for f in _FORCES)
    turning = features.FORCES
    pairs = list(combinations_with_replacement(_FORCES, 2))
    memory = [
        f"slow({x}, {t} s)" for names, ts in ((a, CREEP), (turning, TURNING_CREEP)) for x in names for t in ts
    ]
    memory += [f"slow(square({x}), {t} s)" for x in ("f_i", "a_z") for t in WARMTH]
    memory += [f"slow(sign(d_{x}), {t} s)" for x in turning for t in FRICTION]
    found: list[tuple[str, ...]] = [(n,) for n in memory]
    found += [(n,) for f in turning for n in (f"d_{f}", f"d2_{f}")]
    found += [(n,) for x in (*_FORCES, *rates) for n in (f"abs({x})", f"sign({x})")]
    found += [(x, f"abs({y})") for x, y in product(_FORCES, _FORCES)]
    found += [(x, x, f"sign({y})") for x, y in product(_FORCES, rates)]
    found += [(x, x, f"abs({x})") for x in _FORCES]
    found += combinations_with_replacement(_FORCES, 4)
    found += [(x,) * 5 for x in _FORCES]
    found += product(_FORCES, rates)
    found += combinations_with_replacement(rates, 2)
    found += [(*p, d) for p in pairs for d in rates]
    found += product(turning, (*omega, *omegadot))
    found += [(x, *p) for x in turning for p in combinations_with_replacement(omega, 2)]
    found += [(*p, w) for p in pairs for w in (*omega, *omegadot)]
    for n in auxiliary:
        found += [(n, n), *((x, n) for x in turning)]
        found += [(x, n, n) for x in _FORCES] + [(*p, n) for p in pairs]
        found += [] if n == "time" else [(x, f"d_{n}") for x in _FORCES]
    return found


def _measure(
    r: Record, names: Sequence[str], centre: Mapping[str, float] = features.NOTHING
) -> tuple[dict[str, _Statistics], dict[str, Relaxations]]:
    """Over the valid samples of a flight, a segment at a time; and the relaxations by name, which are run through on the way."""
    slow = Relaxations([n for n in names if features.is_slow(n)], r, centre)
    count = 0.0
    first: dict[str, float] = {}
    sums = {n: np.zeros(2) for n in names}
    ends = {n: np.array([np.inf, -np.inf]) for n in names}
    for rows in divide_into_segments(len(r.time)):
        part = r.part(rows)
        count += float(np.sum(part.valid))
        relaxed = slow.advance(part)
        for n in names:
            x = (relaxed[n] if n in relaxed else features.make_series(n, part, centre))[part.valid]
            if not len(x):
                continue
            y = x - first.setdefault(n, float(x[0]))  # squares of differences, so that no digits are lost
            sums[n] += (np.sum(y), y @ y)
            ends[n] = np.array([min(ends[n][0], np.min(x)), max(ends[n][1], np.max(x))])
    found = {}
    for n in names:
        mean, square = sums[n] / max(count, 1.0)
        origin = first.get(n, 0.0)
        spread = float(np.sqrt(max(0.0, square - mean**2)))
        mean = float(mean + origin)
        varies = bool(ends[n][1] > ends[n][0])
        found[n] = _Statistics(mean, float(np.hypot(mean, spread)) or 1.0, spread or 1.0, varies)
    return found, {n: slow for n in names if features.is_slow(n)}


def list_harmonics(highest: int = HIGHEST) -> tuple[str, ...]:
    """const, cos 1, sin 1 ... up to a multiple of the spin rate."""
    return ("const", *(f"{f} {k}" for k in range(1, highest + 1) for f in ("cos", "sin")))


def make_carrier(r: Record, harmonic: str) -> Array:
    """(N,): 1, cos(k phi) or sin(k phi)."""
    h = series_name.harmonic(harmonic)
    if not h.multiple:
        return np.ones(len(r.time))
    z = (r.cos_phi + 1j * r.sin_phi) ** h.multiple
    return np.asarray(z.real if h.function == "cos" else z.imag)


# --- whitened: the directions along which a residual is asked. Any tells a standard normal deviate from white noise; the
# whitened series of a term is the one that finds the term best.

MEMORY = 16384
"""Most taps of the filter that terms are whitened with: a direction need not be the best one for its
score to be a standard normal deviate, and slower memory than this buys little."""

SEGMENT = 2048
"""Samples that are summed in single precision."""


def multiply(X: Singles, right: Array | Singles) -> Array:
    """X (terms, N) times right (N, k): single precision within a segment, double between segments."""
    singles = right.astype(np.float32, copy=False)
    total = np.zeros((len(X), right.shape[1]))
    for start in range(0, X.shape[1], SEGMENT):
        total += X[:, start : start + SEGMENT] @ singles[start : start + SEGMENT]
    return total


def sum_squares(X: Singles) -> Array:
    """(terms,): sums of squares of X (terms, N), as :func:`multiply` sums."""
    total = np.zeros(len(X))
    for start in range(0, X.shape[1], SEGMENT):
        part = X[:, start : start + SEGMENT]
        total += np.matmul(part[:, None, :], part[:, :, None])[:, 0, 0]
    return total


def _keep_valid(X: Singles, valid: NDArray[np.bool_]) -> Singles:
    return X if valid.all() else X[:, valid]


class Directions:
    """Whitened series of the terms of a dictionary over a segment, as terms of the output or of ``only`` one of its series."""

    def __init__(
        self, prepared: PreparedFlight, dictionary: Dictionary, piece: Piece, only: int | None = None
    ) -> None:
        self.piece, self.dictionary, self.whole = piece, dictionary, prepared.observation
        self.noise, self.filters = prepared.noise, prepared.noise.taps(MEMORY)
        o = piece.observation
        self.weights = prepared.noise.weights(
            o.weights if only is None else np.where(np.arange(len(o.signs)) == only, o.signs, 0.0)
        )

    def whitened(self, terms: Sequence[Term]) -> Iterator[tuple[slice, Singles, Singles]]:
        """Places of some terms, their series (terms, N), and these whitened (terms, rows), through the filter."""
        o, piece = self.piece.observation, self.piece
        rows = piece.rows
        lead = min(rows.start, max(len(t) for t in self.filters) - 1)
        wide = self.whole.record.part(slice(rows.start - lead, rows.stop)) if lead else o.record
        valid, level = o.record.valid, np.broadcast_to(self.noise.level.of(wide.quantity), wide.valid.shape)
        for at, x in self.dictionary.make_chunks(wide, terms):
            if o.recorded.demodulated:  # what the recorder made of G_out before it was recorded
                x = o.recorded.through(x.astype(np.float64), wide).astype(np.float32)
                x[:, ~wide.valid] = 0.0
            even = self.noise.divide(x, level, filtered=False)
            made = (
                filter_columns(even, np.asarray(w * taps), lead=lead)
                for w, taps in zip(self.weights, self.filters, strict=True)
            )
            parts = [_keep_valid(self.noise.divide(X, level[lead:], filtered=True), valid) for X in made]
            yield at, x[:, lead:], self._without_gradient(parts)

    def _without_gradient(self, parts: Sequence[Singles]) -> Singles:
        X = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)
        unknown_gradient.project(X, self.piece.windows)
        return X


# --- a term as an effect of the user's own: a line for ``effects`` in model.toml, and what the flight must have for it

_FUNCTION_NAMES = {"abs": "absolute value", "sign": "sign", "square": "square"}
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*")


def write_effect(term: Term, centre: Mapping[str, float], unit: str) -> str | None:
    """The effect as one line of model.toml; ``None`` if a channel's name is not possible in an expression, or it is made of the output.

    ``centre`` are the means that auxiliary channels enter less; ``unit`` is that of the term's channels.
    """
    if any(OUTPUT in series_name.list_channels(series_name.series(n)) for n in term.channels):
        return None  # no stage sees the output
    # of the only channel of a term that does not turn the mean is a parameter of the model; elsewhere it would be a further term
    alone = term.harmonic == "const" and sum(n in centre for n in term.channels) == 1
    factors: list[str] = []
    for name in dict.fromkeys(term.channels):
        s = series_name.series(name)
        plain = alone and isinstance(s, ChannelName)
        text = _write_series(s, {} if plain else centre)
        if text is None:
            return None
        n = term.channels.count(name)
        text = f"({text})" if " " in text and isinstance(s, ChannelName) else text
        factors.append(text if n == 1 else f"{text}**{n}")
    product = "*".join(("K_x", *factors, *_write_carrier(term.harmonic)))
    return f'{{ id = "my-effect", stage = "transducer", add = "{product}", K_x = {{ unit = "{unit}" }} }}'


def list_effect_columns(term: Term) -> list[str]:
    """In words: the columns that a flight must have for :func:`write_effect`, since an expression has only the values of one instant."""
    found = {}
    for name in term.channels:
        s = series_name.series(name)
        while isinstance(s, Function):
            s = s.of
        if not isinstance(s, ChannelName) and str(s) not in RATES:
            found[_name_column(s)] = f"{_name_column(s)} ({describe_series(s)})"
    return list(found.values())


def describe_series(s: Series) -> str:
    """What a series is."""
    match s:
        case ChannelName(name):
            return name
        case Derivative(of, order):
            return f"{'second ' if order == 2 else ''}time derivative of {of}"
        case Function(name, of):
            return f"{_FUNCTION_NAMES[name]} of {_describe_centred(of)}"
        case Product(factors):
            return " times ".join(_describe_centred(x) for x in factors)
        case Relaxation(of, seconds):
            return f"{describe_series(of)} through a relaxation of {seconds} s"


def _describe_centred(s: Series) -> str:
    recorded = isinstance(s, ChannelName) and s.name not in (*_MOTION, *features.FORCES)
    return f"{describe_series(s)}{' less its mean' if recorded else ''}"


def _name_column(s: Series) -> str:
    """Name for a column of the flight that holds a series which no expression can form."""
    if isinstance(s, Relaxation):
        return "slow_" + re.sub(r"[( ]", "_", str(s.of)).replace(")", "")
    return str(s)


def _write_series(s: Series, centre: Mapping[str, float]) -> str | None:
    if isinstance(s, Function):
        inner = _write_series(s.of, centre)
        return None if inner is None else f"{s.name}({inner})"
    text = _name_column(s)
    if not _NAME.fullmatch(text):
        return None
    mean = centre.get(str(s), 0.0)
    return text if not mean else f"{text} {'-' if mean > 0 else '+'} {abs(mean):.6g}"


def _write_carrier(name: str) -> tuple[str, ...]:
    """A harmonic of the disc angle as a polynomial in cos_phi and sin_phi (de Moivre)."""
    h = series_name.harmonic(name)
    k = h.multiple
    if not k:
        return ()
    terms = []
    # powers of i sin phi: real for cos, imaginary for sin
    for n in range(0 if h.function == "cos" else 1, k + 1, 2):
        factor = comb(k, n) * (-1) ** (n // 2)
        powers = [f"{name}**{e}" if e > 1 else name for name, e in (("cos_phi", k - n), ("sin_phi", n)) if e]
        terms.append("*".join([*([] if factor == 1 else [str(factor)]), *powers]))
    return (terms[0],) if len(terms) == 1 else (f"({' + '.join(terms)})",)
