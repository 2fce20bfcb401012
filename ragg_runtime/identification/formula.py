"""A formula of one line for what remains: harmonic x stage x product of two factors, each a channel or a function of it.

The dictionary tests whether anything is left, in terms that are few enough for the test to see little. What is left may be a
product that is a sum of several of them: with the force on an accelerometer at a harmonic, with the output's gain, with a sign. Here
all products are asked, where something is left. With the whitened residual y, filter W, carrier and stage w, and factors F (a matrix),
the scores of all are F diag(w W'y) F': one product of matrices for each w. Their lengths are taken as if the factors were slow against
the carrier; the best are then scored as the dictionary's terms are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from ragg_runtime.base import series_name
from ragg_runtime.base.series_name import Function
from ragg_runtime.estimation import whitening
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.whitening import PreparedFlight, Projector, divide_flight
from ragg_runtime.identification import omnibus
from ragg_runtime.identification.dictionary import MEMORY, Dictionary, Term, list_harmonics, make_carrier
from ragg_runtime.identification.features import FORCES, OUTPUT
from ragg_runtime.identification.omnibus import Omnibus, Remainder, Scores
from ragg_runtime.signals.fir import filter_columns

Array = NDArray[np.float64]

SHORTLIST, OF_EACH = 200, 8
"""Products that are scored exactly: of all, and of each stage and harmonic, as lengths of the fast ones are rough."""

MEMORIES = (1, 5, 20)
"""Time constants, s, of factors that relax: within a factor of 2.2 of any from 0.5 to 45 s."""

ONE = Term("const", ())


def propose_formulas(f: Fitted, given: Sequence[int], left: Remainder) -> Remainder:
    """What is left of all flights of a fit beside ``given`` candidate columns, in formulas where these are significant.

    Only the terms change: the tests, and what claims compete with, are of the dictionary.
    """
    found = [
        s
        if x.observation.recorded.demodulated or all(t.kind != "steady" for t in s.terms)
        else _of_flight(f, n, given, s)
        for n, (x, s) in enumerate(zip(f.prepared, left.searches, strict=True))
    ]
    return Remainder(tuple(found))


def _of_flight(f: Fitted, flight: int, given: Sequence[int], search: Omnibus) -> Omnibus:
    whole = whitening.make_projector(f.r_factors[flight], f.n_base, given, f.to_nominal)
    prepared, projector, _ = whole.lean(f.prepared[flight])
    known = omnibus.make_dictionary(prepared)
    terms, tried = _screen(prepared, projector, known)
    terms += [t.term for t in search.terms]
    scores = Scores(prepared, projector, dictionary=known.with_terms([*dict.fromkeys(terms)]))
    scores.collect(lambda piece, y: None)
    best = omnibus.pursue(scores, search.tried)  # that something is left has been tested
    # what comes second is not known to be there: it stands out among all products
    level = -float(ndtri(omnibus.FAMILY * omnibus.SHARES[0] / (2 * (tried + search.tried))))
    taken = (*best.terms[:1], *(t for t in best.terms[1:] if abs(t.z) > level))
    return replace(search, terms=taken, chi2=sum(t.chi2 for t in taken)) if taken else search


def _screen(x: PreparedFlight, projector: Projector, known: Dictionary) -> tuple[list[Term], int]:
    """The most promising products, and the number of all."""
    now, factors = _list_factors(known)
    turns = list_harmonics() if x.observation.record.turning else ("const",)
    stages = [(), *((n,) for n in (*FORCES, OUTPUT) if n in known)]
    d = known.with_terms([Term(h, s) for s, h in product(stages, turns)])
    first = Scores(x, projector, dictionary=d)
    back = _filter_back(x, first.collect(lambda piece, y: (piece.sample, y)))
    gain = (first.sums.norm2 / first.sums.raw[1]).reshape(len(stages), len(turns))
    d = d.with_terms(factors)
    factors = list(d.terms)
    few = sum(t in now for t in factors)
    dots = np.zeros((len(stages), len(turns), few, len(factors)))
    squares = np.zeros((len(stages), few, len(factors)))
    for s in divide_flight(x.observation):
        r = x.observation.record.part(s.rows)
        F = np.concatenate([X for _, X in d.make_chunks(r, factors)])
        at = [d.series(Term("const", n), r) / d.size(Term("const", n)) for n in stages]
        carriers = [make_carrier(r, h) * back[s.rows] for h in turns]
        for n, w in enumerate(at):
            squares[n] += (F[:few] ** 2 * (w**2).astype(np.float32)) @ (F**2).T
            for k, c in enumerate(carriers):
                dots[n, k] += (F[:few] * (w * c).astype(np.float32)) @ F.T
    half = np.where([h == "const" for h in turns], 1.0, 0.5)
    length = squares[:, None] * (gain * half)[:, :, None, None]
    score = np.where(length > 0.0, np.abs(dots) / np.sqrt(np.where(length > 0.0, length, 1.0)), 0.0)
    score[..., :few] = np.triu(score[..., :few])  # a product of two is one, in either order
    each = score.reshape(len(stages) * len(turns), -1)
    best = (
        np.argpartition(-each, OF_EACH, axis=1)[:, :OF_EACH] + each.shape[1] * np.arange(len(each))[:, None]
    )
    best = np.union1d(best, np.argpartition(-score, SHORTLIST, axis=None)[:SHORTLIST])
    terms = [
        Term(turns[k], (*stages[n], *factors[a].channels, *factors[b].channels))
        for n, k, a, b in zip(*np.unravel_index(best, score.shape), strict=True)
    ]
    return [_spell_out(t) for t in terms], int(np.count_nonzero(score))


def _filter_back(x: PreparedFlight, parts: Sequence[tuple[NDArray[np.intp], Array]]) -> Array:
    """(N,): the whitened residual of a flight through the transposed filter: its product with a series is that series' score."""
    o, noise = x.observation, x.noise
    y = np.zeros((noise.outputs, len(o.record.time)))
    for sample, left in parts:
        count = len(left) // noise.outputs
        y[:, sample[:count]] = left.reshape(noise.outputs, count)
    level = noise.level.of(o.record.quantity)
    y = noise.divide(y, level, filtered=True)
    found = np.zeros(y.shape[1])
    for own, w, taps in zip(y, noise.weights(o.weights), noise.taps(MEMORY), strict=True):
        found += filter_columns(np.ascontiguousarray(own[None, ::-1]), np.asarray(w * taps))[0, ::-1]
    return noise.divide(found, level, filtered=False)


def _list_factors(d: Dictionary) -> tuple[list[Term], list[Term]]:
    """Factors as they are, and these with those that have a memory."""
    remembered = [*d.channels, *(f"{function}({n})" for n in d.channels for function in ("square", "sign"))]
    now = [ONE, *(Term("const", (n,)) for n in (*remembered, *(f"abs({n})" for n in d.channels)))]
    return now, [*now, *(Term("const", (f"slow({n}, {t} s)",)) for n in remembered for t in MEMORIES)]


def _spell_out(t: Term) -> Term:
    """A square as a product."""
    channels: list[str] = []
    for n in t.channels:
        s = series_name.series(n)
        channels += [str(s.of)] * 2 if isinstance(s, Function) and s.name == "square" else [n]
    return Term(t.harmonic, tuple(channels))
