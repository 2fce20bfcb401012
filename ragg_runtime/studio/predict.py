"""What effects would do before they are derived, and a generic term by itself: the error left, significances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.base.progress import one_thread
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.whitening import PreparedFlight
from ragg_runtime.identification import omnibus
from ragg_runtime.identification.dictionary import Term, list_harmonics
from ragg_runtime.identification.omnibus import Scores
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.identification.selection import ProjectedProblem, make_problem

Array = NDArray[np.float64]


def make_problem_of(d: Diagnosis) -> ProjectedProblem:
    """The testable effects, steps included, on the R factors of everything."""
    return make_problem(d.fitted, [r.effect for r in d.ranking])


def list_columns(problem: ProjectedProblem, effects: Sequence[str]) -> list[int]:
    """The testable candidate columns of some effects."""
    return [n for e in effects if e in problem.candidates for n in problem.testable(e)]


def fit_effects(
    f: Fitted, problem: ProjectedProblem, effects: Sequence[str], *, held_out: bool = False
) -> Array:
    """(size,): fitted coefficients of all columns with these effects in."""
    extra = list_columns(problem, effects)
    fitted, _ = f.coefficients(extra, held_out=held_out)
    return f.vector(fitted, extra)


@one_thread
def predict_error(f: Fitted, problem: ProjectedProblem, effects: Sequence[str]) -> tuple[float, float]:
    """The error before demodulation, Eo, calibrated and held out, that these effects would leave if everything is linear."""
    whole, held_out = f.score([fit_effects(f, problem, effects, held_out=h) for h in (False, True)])
    return whole.whole.rms_Eo, held_out.held_out.rms_Eo


# --- harmonic x motion term: the significance of every generic term in the residual of a flight


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
def score_terms(f: Fitted, flight: int, given: Sequence[int] = ()) -> Heat:
    """The scores of all terms in one flight once base and ``given`` candidate columns are projected out, in one pass."""
    prepared, projector, _ = omnibus.project_out(f, flight, given)
    s = Scores(prepared, projector)
    s.collect(lambda piece, y: None)
    norm = np.where(np.isfinite(s.norms), s.norms, np.nan)
    terms = s.dictionary.terms
    rows = list_harmonics()
    columns = tuple(dict.fromkeys(t.product for t in terms if t.harmonic in rows))
    z, coefficient = (np.full((len(rows), len(columns)), np.nan) for _ in range(2))
    row, column = ({name: k for k, name in enumerate(names)} for names in (rows, columns))
    for k, t in enumerate(terms):
        if t.harmonic in row:
            at = row[t.harmonic], column[t.product]
            z[at] = s.dot[k] / norm[k]
            coefficient[at] = z[at] / (norm[k] * s.dictionary.size(t))
    share = omnibus.FAMILY * omnibus.SHARES[0] / (2 * max(int(np.sum(np.isfinite(norm))), 1))
    return Heat(
        harmonics=rows, products=columns, z=z, coefficient=coefficient, level=-float(special.ndtri(share))
    )


def compute_term(prepared: PreparedFlight, harmonic: str, product: str, coefficient: float) -> Array:
    """(N,) V: a generic term over a whole flight, with this coefficient."""
    r = prepared.observation.record
    channels = () if product == "1" else tuple(product.split("*"))
    x = coefficient * omnibus.make_dictionary(prepared).series(Term(harmonic, channels), r)
    return np.asarray(np.where(r.valid, x, 0.0))
