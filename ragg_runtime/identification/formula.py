"""A formula of one line for what remains: harmonic x stage x product of two factors, each a channel or a function of it, x memory.

The dictionary tests whether anything is left, in terms that are few enough for the test to see little. What is left may be a product
that is a sum of several of them, or of so many that none stands out: with the force on an accelerometer at a harmonic, with the
output's gain, with a sign. Here all products are asked, as they are and as they relax. With the whitened residual y, filter W, carrier
and stage w, and products P (a matrix) the scores of all are P (w W'y). Their lengths are taken as if the products were slow against
the carrier; the best are then scored as the dictionary's terms are.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product
from math import comb

import numpy as np
from numpy.typing import NDArray
from scipy import signal
from scipy.special import ndtri

from ragg_runtime.base import series_name
from ragg_runtime.base.series_name import ChannelName, Derivative, Function, Product, Relaxation, Series
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.whitening import PreparedFlight, Projector
from ragg_runtime.identification import omnibus
from ragg_runtime.identification.dictionary import (
    FORCES,
    MOTION,
    OUTPUT,
    Dictionary,
    Term,
    begins_at_zero,
    list_harmonics,
    make_carrier,
)
from ragg_runtime.identification.omnibus import Omnibus, Remainder, Scores
from ragg_runtime.io.record import RATES

Array = NDArray[np.float64]
Singles = NDArray[np.float32]

# products that are scored exactly: of all, and of each stage and harmonic, as lengths of the fast ones are rough
SHORTLIST, OF_EACH = 200, 8
# time constants, s, of products that relax: within a factor of 2.2 of any from 0.5 to 45 s
MEMORIES = (1, 5, 20)
FINE = 4  # means in the shortest of them, at least, by which these are screened

ONE = Term("const", ())


def propose_formulas(f: Fitted, extra: Sequence[int], left: Remainder) -> Remainder:
    """What is left of all flights of a fit beside ``extra`` candidate columns, in formulas where these are significant.

    What claims compete with are the dictionary's terms.
    """
    searches = [
        s if x.observation.recorded.demodulated else _propose_formula(f, n, extra, s)
        for n, (x, s) in enumerate(zip(f.prepared, left.searches, strict=True))
    ]
    return Remainder(tuple(searches))


def _propose_formula(f: Fitted, flight: int, extra: Sequence[int], search: Omnibus) -> Omnibus:
    prepared, projector, _ = omnibus.project_out(f, flight, extra)
    dictionary = omnibus.make_dictionary(prepared)
    terms, tried = _screen(prepared, projector, dictionary)
    terms += [t.term for t in search.steady]
    scores = Scores(prepared, projector, dictionary=dictionary.with_terms([*dict.fromkeys(terms)]))
    scores.collect(lambda piece, y: None)
    # a steady term that is left has been tested; another must stand out among all products
    best = omnibus.pursue(scores, search.tried if search.steady else tried + search.tried)
    # what comes second is not known to be there: it stands out among all products
    level = -float(ndtri(omnibus.FAMILY * omnibus.SHARE / (2 * (tried + search.tried))))
    taken = (*best.terms[:1], *(t for t in best.terms[1:] if abs(t.z) > level))
    log_p = search.log_p if search.steady else min(search.log_p, best.log_p)
    return replace(search, log_p=log_p, terms=taken, chi2=sum(t.chi2 for t in taken)) if taken else search


def _screen(x: PreparedFlight, projector: Projector, dictionary: Dictionary) -> tuple[list[Term], int]:
    """The most promising products, and the number of all."""
    turns = list_harmonics() if x.observation.record.turning else ("const",)
    stages = [(), *((n,) for n in (*FORCES, OUTPUT) if n in dictionary)]
    d = dictionary.with_terms([Term(h, s) for s, h in product(stages, turns)])
    first = Scores(x, projector, dictionary=d)
    back = _filter_back(x, first.collect(lambda piece, y: (piece.sample, y)))
    gain = (first.norm2 / first.raw[1]).reshape(len(stages), len(turns))
    named = (f"{function}({n})" for function in ("square", "sign", "abs") for n in d.channels)
    d = d.with_terms([ONE, *(Term("const", (n,)) for n in (*d.channels, *named))])
    dots, squares = _sum_products(x, d, stages, turns, back)
    half = np.where([h == "const" for h in turns], 1.0, 0.5)
    length = (squares[..., None] * (gain * half)).reshape(dots.shape)
    score = np.where(length > 0.0, np.abs(dots) / np.sqrt(np.where(length > 0.0, length, 1.0)), 0.0)
    each = score.reshape(-1, score.shape[-1])
    best = np.argpartition(-each, OF_EACH, axis=0)[:OF_EACH] * each.shape[1] + np.arange(each.shape[1])
    best = np.union1d(best, np.argpartition(-score, SHORTLIST, axis=None)[:SHORTLIST])
    terms = [
        _make_term(
            turns[k % len(turns)], stages[k // len(turns)], m, (*d.terms[a].channels, *d.terms[b].channels)
        )
        for m, a, b, k in zip(*np.unravel_index(best[score.flat[best] > 0.0], score.shape), strict=True)
    ]
    return terms, int(np.count_nonzero(score))


def _sum_products(
    x: PreparedFlight, d: Dictionary, stages: Sequence[tuple[str, ...]], turns: Sequence[str], back: Array
) -> tuple[Array, Array]:
    """(memories, n, n, stages x turns): scores of the products of two of a dictionary's n terms, as they are and relaxing; and
    (memories, n, n, stages): their squares, times those of the stage. ``back`` (N,): see :func:`_filter_back`.
    """
    rate = x.observation.record.rate
    few = max(1, int(rate * MEMORIES[0] / FINE))
    decay = np.exp(-few / (rate * np.array(MEMORIES)))
    at_zero = [any(begins_at_zero(series_name.series(n), d.centre) for n in t.channels) for t in d.terms]
    shape = (1 + len(MEMORIES), len(d.terms), len(d.terms))
    dots, squares = np.zeros((*shape, len(stages) * len(turns))), np.zeros((*shape, len(stages)))
    last, origin = np.zeros((*shape, 1), dtype=np.float32), None
    for rows in x.observation.segments:
        r = x.observation.record.part(rows)
        F = np.concatenate([X for _, X in d.make_chunks(r, d.terms)])
        at = np.array([d.series(Term("const", n), r) / d.size(Term("const", n)) for n in stages])
        turned = np.array([make_carrier(r, h) * back[rows] for h in turns])
        weights = (at[:, None] * turned).reshape(dots.shape[-1], -1).T.astype(np.float32)
        power = np.square(at).T.astype(np.float32)
        sums = _average(weights.T, few).T * few, _average(power.T, few).T * few
        if origin is None and r.valid.any():
            origin = np.where(at_zero, np.float32(0.0), F[:, np.argmax(r.valid)])
        for a in range(len(F)):
            P = F[a] * F[a:]  # a product of two is one, in either order
            dots[0, a, a:] += P @ weights
            squares[0, a, a:] += P**2 @ power
            begin = 0.0 if origin is None else (origin[a] * origin[a:])[:, None]
            P = _average(np.where(r.valid, P - begin, np.float32(0.0)), few)
            for m, c in enumerate(decay, 1):
                share, pole = np.array([1 - c], dtype=np.float32), np.array([1, -c], dtype=np.float32)
                y, last[m, a, a:] = signal.lfilter(share, pole, P, zi=last[m, a, a:])
                dots[m, a, a:] += y @ sums[0]
                squares[m, a, a:] += y**2 @ sums[1]
    return dots, squares


def _average(X: Array | Singles, few: int) -> Singles:
    """(k, N / few): means of so many samples."""
    n = X.shape[-1] // few
    return np.asarray(X[:, : n * few].reshape(len(X), n, few).mean(axis=-1), dtype=np.float32)


def _make_term(harmonic: str, stage: tuple[str, ...], memory: int, factors: tuple[str, ...]) -> Term:
    """A product of factors, squares spelled out, or as it relaxes."""
    if memory:
        return Term(harmonic, (*stage, f"slow({' '.join(factors)}, {MEMORIES[memory - 1]} s)"))
    channels = [*stage]
    for n in factors:
        s = series_name.series(n)
        channels += [str(s.of)] * 2 if isinstance(s, Function) and s.name == "square" else [n]
    return Term(harmonic, tuple(channels))


def _filter_back(x: PreparedFlight, parts: Sequence[tuple[NDArray[np.intp], Array]]) -> Array:
    """(N,): the whitened residual of a flight through the transposed filter: its product with a series is that series' score."""
    o, noise = x.observation, x.noise
    y = np.zeros((noise.outputs, len(o.record.time)))
    for sample, left in parts:
        count = len(left) // noise.outputs
        y[:, sample[:count]] = left.reshape(noise.outputs, count)
    level = np.broadcast_to(noise.level.of(o.record.quantity), o.record.valid.shape)
    return noise.whiten_back(y, noise.weights(o.weights), o.record.valid, level)


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
    columns = {}
    for name in term.channels:
        s = series_name.series(name)
        while isinstance(s, Function):
            s = s.of
        if not isinstance(s, ChannelName) and str(s) not in RATES:
            columns[_name_column(s)] = f"{_name_column(s)} ({describe_series(s)})"
    return list(columns.values())


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
    recorded = isinstance(s, ChannelName) and s.name not in (*MOTION, *FORCES)
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
    function, k = series_name.harmonic(name)
    if not k:
        return ()
    terms = []
    # powers of i sin phi: real for cos, imaginary for sin
    for n in range(0 if function == "cos" else 1, k + 1, 2):
        factor = comb(k, n) * (-1) ** (n // 2)
        powers = [f"{name}**{e}" if e > 1 else name for name, e in (("cos_phi", k - n), ("sin_phi", n)) if e]
        terms.append("*".join([*([] if factor == 1 else [str(factor)]), *powers]))
    return (terms[0],) if len(terms) == 1 else (f"({' + '.join(terms)})",)
