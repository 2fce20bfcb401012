"""Is anything left? A search over generic terms of the residual, and the names of those that are there.

After the model and the chosen effects are projected out, every term of the dictionary is scored against
what remains. The largest score of an effect-free record is known, so its significance is; terms are taken
one by one (orthogonal matching pursuit) while the largest is significant. Scores and inner products are sums
over the segments of a flight.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base import false_alarms
from ragg_runtime.estimation import whitening
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.likelihood_ratio import Scatter, Test, sum_variances, test_variance
from ragg_runtime.estimation.regressors import predict_observed
from ragg_runtime.estimation.scores import INDISTINGUISHABLE, log_sf_t
from ragg_runtime.estimation.whitening import Piece, PreparedFlight, Projector
from ragg_runtime.identification.dictionary import Dictionary, Term, find_term_unit, whiten_terms
from ragg_runtime.identification.time_varying import BlockScores

Array = NDArray[np.float64]
T = TypeVar("T")

# probability with which anything at all may seem left of an effect-free record
FAMILY = false_alarms.REMAINDER
# what steady terms have of it, and terms that come and go
SHARE = false_alarms.REMAINDER_SHARE

# share of a term's square that must be left of it beside the base's columns for it to have a direction of its own: single precision
# knows no less
OWN = 1e-6
# share of a term's square that must be left of it beside the terms taken before, for its score to count
APART = 0.05

MOST_TERMS = 8

SHORTLIST = 400  # terms among which several are sought: those with the largest scores


@dataclass(frozen=True)
class ResidualTerm:
    """A generic term in a residual, and its coefficient with standard deviation, V per SI unit of the product of channels.

    ``kind`` is ``steady``, ``varying`` (``coefficient`` is then the root mean square of its values in blocks of time, ``how`` how it
    varies, in words) or ``line`` (the harmonic then names the frequency). ``z``, ``chi2``: its significance when it was taken, in standard
    deviations, and what its ``rank`` coefficients explained then; ``mean_square``: of the term in the residual, V^2 (about its mean, for
    const terms); ``centre``: means that its auxiliary channels enter less.
    """

    term: Term
    coefficient: float
    std: float
    z: float
    chi2: float
    mean_square: float
    kind: str = "steady"
    how: str = ""
    centre: Mapping[str, float] = field(default_factory=dict)
    rank: int = 1

    @staticmethod
    def of_line(frequency: float, amplitude: float, chi2: float) -> ResidualTerm:
        """A line of so many Hz and V."""
        term, z = Term(f"line {frequency:.5g} Hz", ()), float(np.sqrt(chi2))
        std, mean_square = amplitude / max(z, 1.0), amplitude**2 / 2
        return ResidualTerm(term, amplitude, std, z, chi2, mean_square, kind="line", rank=2)


@dataclass(frozen=True)
class Omnibus:
    """The search over one flight's dictionary: ``log_p`` of the most significant finding of all tests, of ``tried`` terms.

    ``terms``, ``chi2``, ``square``: what is left, in terms, and what these explain of the whitened residual's sum of squares.
    ``steady``, ``varying``: the significant terms, fitted jointly, and those that come and go, each alone. ``explained``: chi-square of
    the first 1, 2, ... of the steady terms, with the priors of the base; ``shift``: how far the coefficients of the projected columns move
    when the steady terms are fitted jointly, in scales.
    """

    log_p: float
    tried: int
    terms: tuple[ResidualTerm, ...]
    chi2: float
    square: float
    steady: tuple[ResidualTerm, ...] = ()
    explained: tuple[float, ...] = ()
    varying: tuple[ResidualTerm, ...] = ()
    shift: Array | None = None


class Scores:
    """The dictionary of a flight against its whitened residual, base and chosen effects projected out.

    Sums over segments: of every term its inner products with the residual (``dot``), with the basis of what is projected out (``along``)
    and with itself (``norm2``), and the sum and the square of its plain series (``raw``); the residual's ``square``.
    """

    def __init__(
        self,
        prepared: PreparedFlight,
        projector: Projector,
        only: int | None = None,
        dictionary: Dictionary | None = None,
    ) -> None:
        self.prepared, self.projector, self.only = prepared, projector, only
        self.dictionary = dictionary or make_dictionary(prepared)
        count = len(self.dictionary.terms)
        self.dot, self.norm2, *self.raw = np.zeros((4, count))
        self.along = np.zeros((count, len(projector.along)))
        self.samples, self.square = 0, 0.0
        self.blocks = BlockScores(self.dictionary.first_order, prepared.observation.record.time)

    def collect(self, further: Callable[[Piece, Array], T]) -> list[T]:
        """Count in the whole flight, in one pass; what ``further`` makes of every segment and its whitened, projected residual."""

        def count_in(piece: Piece) -> T:
            Q = self.projector.basis(piece)
            y = self.projector.project_residual(piece, Q)
            self.square += float(y @ y)
            self.samples += int(np.sum(piece.observation.record.valid))
            self.blocks.level(piece, y)
            right = np.column_stack([y, Q])
            for at, x, X in self._whiten_chunks(piece, self.dictionary.terms):
                inner = X @ right
                self.dot[at] += inner[:, 0]
                self.along[at] += inner[:, 1:]
                self.norm2[at] += np.einsum("ij,ij->i", X, X)
                self.blocks.add(piece, y, at, X)
                self.raw[0][at] += np.sum(x, axis=1)
                self.raw[1][at] += np.einsum("ij,ij->i", x, x)
            return further(piece, y)

        return [*self.prepared.each(count_in)]

    def _whiten_chunks(self, piece: Piece, terms: Sequence[Term]) -> Iterator[tuple[slice, Array, Array]]:
        return whiten_terms(self.prepared, self.dictionary, piece, terms, self.only)

    @property
    def norms(self) -> Array:
        """(terms,): lengths of the whitened terms beside what is projected out; infinite where next to nothing is left."""
        left2 = self.norm2 - np.einsum("ij,ij->i", self.along, self.along)
        good = left2 > OWN * self.norm2
        return np.asarray(np.sqrt(np.where(good, left2, np.inf)))

    def whiten(self, piece: Piece, places: Iterable[int]) -> Array:
        """(places, rows): the whitened series of some terms over a segment."""
        terms = [self.dictionary.terms[k] for k in places]
        return np.concatenate([X for _, _, X in self._whiten_chunks(piece, terms)])

    def gram(self, places: NDArray[np.intp]) -> Array:
        """Inner products of some whitened terms, base projected out, by another pass over the flight."""

        def inner(piece: Piece) -> Array:
            X = self.whiten(piece, places)
            return np.asarray(X @ X.T)

        A = self.along[places]
        return np.asarray(sum(self.prepared.each(inner), -A @ A.T))

    def measure_scatter(self, places: NDArray[np.intp]) -> Scatter:
        """How many times more the scores of some terms vary than they should, each beside the term itself."""
        along, coefficient = self.along[places], (self.dot / self.norms**2)[places]

        def of(piece: Piece) -> Array:
            Q = self.projector.basis(piece)
            X = (self.whiten(piece, places) - along @ Q.T).T
            return Scatter.of(X, self.projector.project_residual(piece, Q)[:, None] - X * coefficient)

        return Scatter.from_sums(sum(self.prepared.each(of), np.zeros((3, len(places)))))


def make_dictionary(x: PreparedFlight) -> Dictionary:
    """The dictionary of a flight, with the output that the model predicts, free of the record's noise, where G_out was recorded."""
    o = x.observation
    if o.recorded.demodulated or len(o.series) != 1:
        return Dictionary(o.record)
    parts = (predict_observed(x.at.model, o.part(rows), x.at.p)[0] for rows in o.segments)
    return Dictionary(o.record, np.concatenate([*parts]))


def choose(s: Scores) -> Omnibus:
    """What is left of a flight: steady terms, or else one that comes and goes."""
    steady = pursue(s)
    steady = replace(steady, steady=steady.terms)
    found = _find_varying(s)
    if found is None:
        return steady
    log_p, varying = found
    steady = replace(steady, log_p=min(steady.log_p, log_p))
    if log_p >= np.log(FAMILY):
        return steady
    steady = replace(steady, varying=(varying,))
    return steady if steady.terms else replace(steady, terms=(varying,), chi2=varying.chi2)


def _find_varying(s: Scores) -> tuple[float, ResidualTerm] | None:
    """The logarithm of its p-value, and the term that varies most; one that the model has, with one coefficient for the whole flight, may
    vary as well as any other.
    """
    v = s.blocks.best(s.norm2 > 0.0)
    if v is None:
        return None
    term = s.dictionary.terms[v.place]
    size = s.dictionary.size(term)
    mean_square = v.coefficient**2 * float(s.raw[1][v.place]) / max(s.samples, 1)
    z = float(np.sqrt(v.chi2))
    varying = ResidualTerm(
        term, v.coefficient / size, v.std / size, z, v.chi2, mean_square, "varying", v.how, rank=v.rank
    )
    return min(0.0, v.log_p - float(np.log(SHARE))), varying


def pursue(s: Scores, tried: int = 0) -> Omnibus:
    """The largest scores, one by one, while they are significant; ``tried``: number of terms, if not of the dictionary's alone."""
    norm = s.norms
    tried = tried or int(np.sum(np.isfinite(norm)))
    z = s.dot / norm
    freedom = s.prepared.noise.freedom
    first = _log_p(z, tried, freedom)
    nothing = Omnibus(log_p=first, tried=tried, terms=(), chi2=0.0, square=s.square)
    if first >= np.log(FAMILY):
        return nothing
    places = np.argsort(-np.abs(z), kind="stable")[: min(SHORTLIST, int(np.sum(np.isfinite(norm))))]
    sober, degrees = np.ones(len(places)), np.full(len(places), freedom)
    if s.prepared.noise.uneven:
        scatter = s.measure_scatter(places)
        sober, degrees = np.sqrt(scatter.inflation), np.minimum(freedom, scatter.freedom)
        first = _log_p(z[places] / sober, tried, degrees)
        if first >= np.log(FAMILY):
            return replace(nothing, log_p=first)
    G = s.gram(places) / np.outer(norm[places], norm[places])
    order = np.array([s.dictionary.terms[k].order for k in places])
    taken = list(_pursue(z[places], sober, G, order, lambda x: _log_p(x, tried, degrees)))
    if not taken:
        return replace(nothing, log_p=first)
    # together the terms take so much of each, in whitened units, and with it what of each the columns explain
    picked = [k for k, *_ in taken]
    gram, scores = G[np.ix_(picked, picked)], z[places[picked]]
    each = np.linalg.lstsq(gram, scores, rcond=None)[0] / norm[places[picked]]
    along = s.along[places[picked]]
    explained = s.projector.measure_explained(along / norm[places[picked], None], gram, scores)
    return replace(
        nothing,
        log_p=first,
        terms=tuple(_make_term(s, int(places[k]), *numbers) for k, *numbers in taken),
        chi2=sum(amount**2 for _, _, amount, _ in taken),
        explained=tuple(float(x) for x in explained),
        shift=-s.projector.to_basis @ (along.T @ each),
    )


def _pursue(
    score: Array, sober: Array, G: Array, order: NDArray[np.intp], log_p: Callable[[Array], float]
) -> Iterator[tuple[int, float, float, float]]:
    """Orthogonal matching pursuit: the terms with the largest scores (n,) beside those before, while they are significant.

    Of each its place, its significance then, the component of the residual along what is new in it, and the share of its length that is
    new. ``sober`` (n,): what scores are divided by before they are judged; ``G`` (n, n): inner products of the terms of unit length;
    ``order`` (n,): of terms that do as well the simplest is taken.
    """
    # a term that is almost absorbed: its square is below single precision, and it cannot be separated from another
    left = (np.abs(np.diag(G) - 1.0) < APART).astype(np.float64)
    left[int(np.argmax(np.abs(score) / sober))] = 1.0
    directions: list[Array] = []  # components of every term along each direction taken
    while len(directions) < MOST_TERMS:
        now = np.where(left > APART, score / np.sqrt(np.maximum(left, APART)), 0.0)
        if log_p(now / sober) >= np.log(FAMILY):
            return
        near = np.flatnonzero(now**2 > np.max(now**2) - INDISTINGUISHABLE)
        k = int(min(near, key=lambda n: (order[n], -abs(now[n]))))
        length = float(np.sqrt(left[k]))
        along = (G[:, k] - sum((d * d[k] for d in directions), np.zeros(len(score)))) / length
        amount = float(score[k]) / length
        directions.append(along)
        score = score - along * amount
        left = left - along**2
        yield k, float(now[k]), amount, length


def _make_term(s: Scores, place: int, z: float, amount: float, length: float) -> ResidualTerm:
    """What was taken, in the units of its channels."""
    term = s.dictionary.terms[place]
    size = s.dictionary.size(term)
    std = 1.0 / (float(s.norms[place]) * length * size)
    mean, square = (x[place] / max(s.samples, 1) for x in s.raw)
    spread = square - mean**2 if term.harmonic == "const" else square
    mean_square = (amount * std * size) ** 2 * float(spread)
    return ResidualTerm(term, amount * std, std, z, amount**2, mean_square, centre=s.dictionary.centre)


def _log_p(z: Array, tried: int, freedom: Array | float = np.inf) -> float:
    """p-value, as a logarithm, of the most significant of so many standard deviates; ``freedom``: from which the variance of all, or of
    each, is known.
    """
    size = np.abs(z)
    if np.ndim(freedom) == 0:
        least = log_sf_t(float(np.max(size, initial=0.0)), float(freedom))
    else:
        least = min(log_sf_t(float(x), float(f)) for x, f in zip(size, np.asarray(freedom), strict=True))
    return min(0.0, least + float(np.log(2 * max(tried, 1) / SHARE)))


@dataclass(frozen=True)
class Remainder:
    """What is left of all flights: one search of the dictionary a flight."""

    searches: tuple[Omnibus, ...]

    @property
    def log_p(self) -> float:
        """Significance of the largest score of all flights."""
        return min(0.0, min(s.log_p for s in self.searches) + float(np.log(len(self.searches))))

    @property
    def significant(self) -> bool:
        return bool(self.log_p < np.log(FAMILY))


def search_residual(f: Fitted, only: int | None = None) -> Remainder:
    """Search the residual, or ``only`` one of its series, once the base columns are projected out."""
    return search(f, (), {}, only)[0]


def search(
    f: Fitted, extra: Sequence[int], random: Mapping[str, int], only: int | None = None
) -> tuple[Remainder, dict[str, Test]]:
    """The same with ``extra`` candidate columns, and the tests of ``random`` effects (each with the place of its column)."""
    searches, sums = [], []
    for flight in range(len(f.prepared)):
        lean, projector, places = project_out(f, flight, extra, [*random.values()])
        scores = Scores(lean, projector, only)
        sums += scores.collect(lambda piece, y, columns=places: [sum_variances(piece, k, y) for k in columns])  # type: ignore[misc]
        searches.append(choose(scores))
    tests = {e: test_variance(np.sum([row[n] for row in sums], axis=0)) for n, e in enumerate(random)}
    return Remainder(tuple(searches)), tests


def project_out(
    f: Fitted, flight: int, extra: Sequence[int], further: Sequence[int] = ()
) -> tuple[PreparedFlight, Projector, list[int]]:
    """A flight of a fit, what projects base and ``extra`` candidate columns out of it, and where it has ``further`` columns."""
    projector = whitening.make_projector(f.r_factors[flight], f.n_base, extra, f.to_nominal)
    return projector.lean(f.prepared[flight], further)


def search_residuals(f: Fitted) -> list[Remainder]:
    """What terms of the output are left, and where each accelerometer's voltage was recorded, terms of one voltage alone."""
    count = min(len(o.series) for o in f.observations)
    return [search_residual(f), *(search_residual(f, only=k) for k in range(count) if count > 1)]


def list_terms(rem: Remainder, mean_squares: Sequence[float]) -> list[dict[str, object]]:
    """Generic terms in residuals of these mean squares, V^2, largest first; ``share`` is of the power."""
    best: dict[tuple[str, str], tuple[ResidualTerm, float]] = {}
    for s, power in zip(rem.searches, mean_squares, strict=True):
        for t in s.terms:
            key = (t.term.harmonic, t.term.product)
            if key not in best or abs(t.z) > abs(best[key][0].z):
                best[key] = t, min(1.0, t.mean_square / power)
    return [
        {
            "harmonic": t.term.harmonic,
            "term": t.term.product,
            "coefficient": float(t.coefficient),
            "std": float(t.std),
            "unit": find_term_unit(t.term.channels),
            "share": share,
            "z": t.z,
            "kind": t.kind,
            "how": t.how,
        }
        for t, share in sorted(best.values(), key=lambda x: -abs(x[0].z))
    ]
