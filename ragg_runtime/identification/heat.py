"""Harmonic x motion term: the significance of every generic term in the residual of a flight."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.base.threads import one_thread
from ragg_runtime.estimation import whitening
from ragg_runtime.estimation.whitening import PreparedFlight
from ragg_runtime.identification import omnibus
from ragg_runtime.identification.dictionary import Term, harmonics
from ragg_runtime.identification.omnibus import Scores

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Heat:
    """Significance ``z`` (harmonics, products of channels) of generic terms, each alone, in standard deviations (NaN: not
    asked); ``coefficient`` in V per SI unit of the product; from ``level`` on one of all the terms is significant.
    """

    harmonics: tuple[str, ...]
    products: tuple[str, ...]
    z: Array
    coefficient: Array
    level: float


@one_thread
def heat(
    prepared: PreparedFlight, r_factors: Sequence[Array], n_base: int, given: Sequence[int] = ()
) -> Heat:
    """The scores of all terms once base and ``given`` candidate columns are projected out, in one pass."""
    prepared, projector, _ = whitening.projector(r_factors, n_base, given).lean(prepared)
    scores = Scores(prepared, projector)
    scores.collect(lambda piece, y: None)
    return _table(scores)


def _table(s: Scores) -> Heat:
    norm = np.where(np.isfinite(s.norms), s.norms, np.nan)
    terms = s.dictionary.terms
    rows = harmonics()
    columns = tuple(dict.fromkeys(t.product for t in terms if t.harmonic in rows))
    z, coefficient = (np.full((len(rows), len(columns)), np.nan) for _ in range(2))
    row, column = ({name: k for k, name in enumerate(names)} for names in (rows, columns))
    for k, t in enumerate(terms):
        if t.harmonic in row:
            at = row[t.harmonic], column[t.product]
            z[at] = s.sums.dot[k] / norm[k]
            coefficient[at] = z[at] / (norm[k] * s.dictionary.size(t))
    share = omnibus.FAMILY * omnibus.SHARES[0] / (2 * max(int(np.sum(np.isfinite(norm))), 1))
    return Heat(
        harmonics=rows, products=columns, z=z, coefficient=coefficient, level=-float(special.ndtri(share))
    )


def series(prepared: PreparedFlight, harmonic: str, product: str, coefficient: float) -> Array:
    """(N,) V: a generic term over a whole flight, with this coefficient."""
    from ragg_runtime.identification.dictionary import Dictionary

    r = prepared.observation.record
    channels = () if product == "1" else tuple(product.split("*"))
    x = coefficient * Dictionary(r).series(Term(harmonic, channels), r)
    return np.asarray(np.where(r.valid, x, 0.0))
