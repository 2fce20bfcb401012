"""What an effect would do before it is derived, and a generic term by itself: the error left, signatures, significances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy import special

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import one_thread
from ragg_runtime.estimation import unknown_gradient, whitening
from ragg_runtime.estimation.fitted import HELD_OUT_BLOCKS, Fitted
from ragg_runtime.estimation.least_squares import compute_r_factor, join
from ragg_runtime.estimation.observation import BLOCKS, ROWS, combine_output, split_at_blocks
from ragg_runtime.estimation.whitening import Piece, PreparedFlight, divide_flight
from ragg_runtime.identification import omnibus
from ragg_runtime.identification.dictionary import Term, list_harmonics
from ragg_runtime.identification.omnibus import Scores
from ragg_runtime.identification.result import Diagnosis
from ragg_runtime.identification.selection import ProjectedProblem, make_problem

Array = NDArray[np.float64]

WIDEST = 8 * ROWS
"""Most samples of a long flight for which the signature of an effect is computed while one waits."""


@dataclass(frozen=True)
class Unwhitened:
    """The columns [base | candidates | residual] of G_out, not whitened: an R factor (n + 1, n + 1), V, of all flights in each block
    of time, and its valid samples (BLOCKS,).
    """

    r_factors: tuple[Array, ...]
    samples: Array

    def rms(self, v: Array, blocks: Sequence[int]) -> float:
        """Root mean square, V, of the residual in some blocks once columns have coefficients v (n,)."""
        w = np.append(-v, 1.0)
        squares = sum(float(np.sum((self.r_factors[b] @ w) ** 2)) for b in blocks)
        count = float(np.sum(self.samples[list(blocks)]))
        return float(np.sqrt(squares / count)) if count else float("nan")


@one_thread
def pass_unwhitened(f: Fitted) -> Unwhitened:
    """The R factors of the unwhitened columns, in one pass over the flights."""
    found: list[list[Array]] = [[] for _ in range(BLOCKS)]
    samples = np.zeros(BLOCKS)

    def own(piece: Piece, count: int) -> list[tuple[int, Array, int]]:
        r, whole = piece.observation.record, piece.segment.rows
        e = combine_output(
            piece.observation, unknown_gradient.take_out(piece.columns, piece.windows, r.valid)
        )
        parts = []
        for b, rows in split_at_blocks(whole, count):
            here = slice(rows.start - whole.start, rows.stop - whole.start)
            parts.append((b, compute_r_factor(e[:, here]), int(np.sum(r.valid[here]))))
        return parts

    for x in f.prepared:
        for parts in x.each(partial(own, count=len(x.observation.record.time)), whitened=False):
            for b, T, valid in parts:
                found[b].append(T)
                samples[b] += valid
    nothing = np.zeros((f.size + 1, f.size + 1))
    return Unwhitened(tuple(join(t) if t else nothing for t in found), samples)


@dataclass(frozen=True)
class Prediction:
    """What a choice of effects would leave, if everything is linear: calibrated and held-out error before demodulation, Eo, and the
    chi-square that ``rank`` coefficients explain beyond the model.
    """

    effects: tuple[str, ...]
    rms_Eo: float
    holdout_Eo: float
    chi2: float
    rank: int

    def as_json(self) -> dict[str, object]:
        return {**asdict(self), "effects": list(self.effects)}


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
def predict_error(
    f: Fitted, known: Unwhitened, problem: ProjectedProblem, effects: Sequence[str]
) -> Prediction:
    """The error that the flights would leave with these effects in the model."""
    chi2, rank = problem.joint([list_columns(problem, [e]) for e in effects]) if effects else (0.0, 0)
    return Prediction(
        effects=tuple(effects),
        rms_Eo=known.rms(fit_effects(f, problem, effects), range(BLOCKS)) / f.k_ggi,
        holdout_Eo=known.rms(fit_effects(f, problem, effects, held_out=True), HELD_OUT_BLOCKS) / f.k_ggi,
        chi2=chi2,
        rank=rank,
    )


def choose_rows(f: Fitted, flight: int, window: tuple[float, float]) -> slice:
    """Samples of which a signature is computed: of a long flight only segments that meet ``window`` (s); UserError if it is wide."""
    r = f.prepared[flight].observation.record
    n = len(r.time)
    if n <= ROWS:
        return slice(0, n)
    a, b = (int(np.clip((t - r.time[0]) * r.rate, 0, n)) for t in window)
    if b - a > WIDEST or b <= a:
        raise UserError(
            "the signature of an effect is drawn of a part of so long a flight",
            remedy=f"zoom in to less than {WIDEST / r.rate:.0f} s",
        )
    return slice(ROWS * (a // ROWS), min(n, ROWS * -(-b // ROWS)))


def compute_signature(f: Fitted, flight: int, v: Array, rows: slice | None = None) -> tuple[slice, Array]:
    """(samples, V): what coefficients v (size,) take out of the calibrated residual of G_out of one flight, in the segments that
    hold ``rows`` (or all), and where these begin and end.
    """
    x = f.prepared[flight]
    wanted = rows or slice(0, len(x.observation.record.time))
    chosen = [
        s for s in divide_flight(x.observation) if s.rows.start < wanted.stop and s.rows.stop > wanted.start
    ]
    both = np.stack([v, np.zeros_like(v)])

    def taken(piece: Piece) -> Array:
        after, before = piece.left(both)
        return np.asarray(before - after)

    parts = [*x.each(taken, chosen=chosen, whitened=False)]
    return slice(chosen[0].rows.start, chosen[-1].rows.stop), np.concatenate(parts)


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
    projector = whitening.make_projector(f.r_factors[flight], f.n_base, given)
    prepared, projector, _ = projector.lean(f.prepared[flight])
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
            z[at] = s.sums.dot[k] / norm[k]
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
