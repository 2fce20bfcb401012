"""Which of the chosen effects may be claimed although something else remains in a record.

A model is never complete: y = h(theta) + d + n, with d what no effect explains. A claim is made if

(a) the claims together explain more than generic terms could on the residual of the model without them: the difference of log
    evidence (``likelihood_ratio.weigh``), each side charged for its coefficients and for what it was chosen from. Where d is
    significant its excess over the noise divides both chi-squares, the claims must be ahead plainly, and each must explain more than
    the best generic term of d;
(b) its coefficients are significant with a variance estimated from their scores in blocks of time (P. Huber 1967; H. White, Econometrica
    48, 1980), of few blocks with the correction CR2 (R. Bell and D. McCaffrey, Survey Methodology 28, 2002);
(c) held-out, interleaved blocks of time do not speak against it, by their predictive density.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.special import fdtri

from ragg_runtime.estimation.fitted import FITTED_BLOCKS, Fitted
from ragg_runtime.estimation.likelihood_ratio import TESTABLE, weigh
from ragg_runtime.estimation.scores import log_sf, log_sf_f
from ragg_runtime.identification.omnibus import Omnibus, Remainder
from ragg_runtime.identification.parameters import list_bounded_columns

Array = NDArray[np.float64]

# times the chi-square that claims beside a remainder must explain: all of them, of the best single generic term, as the difference of
# two explanations grows with their strength and their ratio does not; each of them, of the best generic term of the remainder
MORE = 1.5
# posterior variance of a direction of the coefficients, in that of the prior, below which the record tells it
SEEN = 1.0 / (1.0 + TESTABLE**2)
LEVERAGE = 1e-3  # least share of a block's rows that its own leverage may leave (CR2)
SCATTER = 0.01  # probability with which the scores of a correct noise model seem to scatter too much


@dataclass(frozen=True)
class Regression:
    """A fit of some flights, block of time by block: R factors [columns | residual], and the prior's ``centre`` (n,) of unit width.

    ``absent`` (n,): the coefficients where no effect acts, which the prior of one with a physical size is not centred on; ``effects``:
    the effect of every column, ``None`` of the instrument's own; ``shapes``: the columns that but shape what others of the effect cause.
    """

    flights: tuple[tuple[Array, ...], ...]
    centre: Array
    absent: Array
    effects: tuple[str | None, ...]
    shapes: frozenset[int] = frozenset()

    @staticmethod
    def of(f: Fitted, extra: Sequence[int] = ()) -> Regression:
        """Of the base columns of a fit and ``extra`` candidates."""
        picked = [*range(f.n_base), *(f.n_base + k for k in extra), -1]
        columns = f.calibration.columns
        names = {f"{e.id}.{q.name}" for e in f.model.effects for q in e.parameters if q.shape}
        shapes = [n for n, c in enumerate(columns) if c.name in names]
        # neutral values of effects, and nominal ones of the instrument, less the calibrated
        absent = f.to_nominal.copy()
        for n, c, q in list_bounded_columns(f):
            absent[n] = (
                (q.neutral or 0.0) * c.unit_factor - f.calibration.p[f.calibration.index[n]]
            ) / c.scale
        absent[shapes] = 0.0  # of what is not there any shape will do
        return Regression(
            flights=tuple(tuple(t[:, picked] for t in factors) for factors in f.r_factors),
            centre=np.concatenate([f.to_nominal, np.zeros(len(extra))]),
            absent=np.concatenate([absent, np.zeros(len(extra))]),
            effects=tuple([c.effect for c in columns] + [f.candidates[k].effect for k in extra]),
            shapes=frozenset(shapes),
        )

    def columns(self, effect: str) -> list[int]:
        return [k for k, e in enumerate(self.effects) if e == effect]

    def blocks(self, only: Sequence[int] | None = None) -> list[Array]:
        """R factors of the blocks that hold any sample: of all blocks of each flight, or of ``only`` these."""
        return [
            t for ts in self.flights for b, t in enumerate(ts) if (only is None or b in only) and np.any(t)
        ]

    def log_evidence(self, only: Sequence[int] | None = None, without: Sequence[int] = ()) -> float:
        """Log of the Gaussian integral over the fitted coefficients, up to a constant of the blocks."""
        R = self._factor(only, without)
        k = len(self.centre) - len(without)
        return -0.5 * float(np.sum(R[k:, k] ** 2)) - float(np.sum(np.log(np.abs(np.diag(R)[:k]))))

    def _factor(self, only: Sequence[int] | None, without: Sequence[int]) -> Array:
        """The R factor of [fitted columns | data], the prior included."""
        n = len(self.centre)
        kept = [k for k in range(n) if k not in without]
        fixed = np.zeros(n)
        fixed[list(without)] = self.absent[list(without)]
        rows = [np.column_stack([t[:, kept], t[:, -1] - t[:, :n] @ fixed]) for t in self.blocks(only)]
        sheet = np.column_stack([np.eye(len(kept)), self.centre[kept]])
        return np.asarray(np.linalg.qr(np.vstack([*rows, sheet]), mode="r"))

    # --- the fit, with a covariance from the scores in blocks of time next to the model's own

    @cached_property
    def _root(self) -> tuple[Array, Array]:
        """Coefficients (n,), and a root of their covariance (n, n)."""
        n, R = len(self.centre), self._factor(None, ())
        root = np.asarray(np.linalg.inv(R[:n, :-1]))
        return root @ R[:n, -1], root

    @property
    def value(self) -> Array:
        """(n,): the coefficients."""
        return self._root[0]

    @property
    def covariance(self) -> Array:
        """(n, n): the model's own."""
        root = self._root[1]
        return np.asarray(root @ root.T)

    @cached_property
    def sandwich(self) -> Array:
        """(n, n): the covariance from the scores."""
        (value, root), scores = self._root, []
        for t in self.blocks():
            A = t[:, :-1] @ root
            w, U = np.linalg.eigh(np.eye(len(A)) - A @ A.T)
            left = t[:, -1] - t[:, :-1] @ value
            scores.append(A.T @ (U @ ((U.T @ left) / np.sqrt(np.maximum(w, LEVERAGE)))))
        S = root @ np.array(scores).T
        return np.asarray(S @ S.T)

    def significance(self, effect: str) -> Significance:
        """The significance of an effect fitted jointly with all others, by its columns other than shapes."""
        E, C = [k for k in self.columns(effect) if k not in self.shapes], self.covariance
        submatrix = np.ix_(E, E)
        # from the root: where the record tells a direction well, rounding of the covariance may be more than its variance
        U, stds, _ = np.linalg.svd(self._root[1][E], full_matrices=False)
        determined = stds**2 < SEEN
        U, sizes = U[:, determined], stds[determined] ** 2
        # of a value that is not there: the prior, which does not scatter, holds it back
        spread = sizes * (1.0 - sizes)
        y = U.T @ (self.value[E] - self.absent[E])
        along = U @ (y / spread)
        expected = float(np.sum(y**2 / spread))
        by = float(along @ self.sandwich[submatrix] @ along) / expected if expected > 0.0 else 1.0
        direction, blocks = C[:, E] @ along, self.blocks()
        carried = np.array([np.sum((t[:, :-1] @ direction) ** 2) for t in blocks])
        carriers = float(np.sum(carried) ** 2 / np.sum(carried**2)) if expected > 0.0 else 1.0
        return Significance(chi2=expected, rank=len(y), inflation=by, blocks=len(blocks), carriers=carriers)


@dataclass(frozen=True)
class Significance:
    """The chi-square of ``rank`` coefficients, and how much more its scores vary between blocks of time than the noise would.

    ``carriers``: number of equal blocks by which that is as well known (F. Satterthwaite, Biometrics 2, 1946): those that hardly carry
    the effect tell nothing.
    """

    chi2: float
    rank: int
    inflation: float
    blocks: int
    carriers: float

    def log_p(self, log_p: float | None, *, doubted: bool) -> float:
        """Logarithm of the p-value with the variance of the scores.

        ``log_p`` is that of a noise that is as its model says, where a test of fewer coefficients knows it. Unless the noise is
        ``doubted`` it holds as long as the scores scatter no more than is likely of it.
        """
        freedom = self.blocks - 1.0
        if log_p is None:
            log_p = log_sf(self.chi2, self.rank)
        if not self.rank or freedom < 1.0:
            return log_p
        if not doubted and self.inflation < float(fdtri(max(1.0, self.carriers - 1.0), 1e9, 1.0 - SCATTER)):
            return log_p
        by = max(1.0, self.inflation)
        return max(log_p, log_sf_f(self.chi2 / by / self.rank, self.rank, freedom))


def weigh_held_out(x: Regression, effect: str) -> float:
    """Log of the ratio of the predictive densities of the blocks that a fit does not see, with an effect and without it.

    That is what its log evidence gains from them: of an effect that the others do not determine nothing is held against it.
    """
    E = x.columns(effect)
    whole, fitted = (x.log_evidence(blocks) - x.log_evidence(blocks, E) for blocks in (None, FITTED_BLOCKS))
    return whole - fitted


def weigh_generic_terms(
    bases: Sequence[Remainder], claimed: float, most: int, spread: float = 1.0
) -> tuple[float, Remainder]:
    """Log evidence of the best that ``most`` generic terms could do on the residual of a model, and that residual.

    ``bases`` are searches for terms of several kinds. Terms that explain hardly more than what is ``claimed`` are taken to explain as much:
    their chi-squares are those of a periodic filter. ``spread``: variance of their scores.
    """
    gains = [sum(max([0.0, *_weigh_terms(s, claimed, most, spread)]) for s in b.searches) for b in bases]
    best = int(np.argmax(gains))
    return gains[best] - float(np.log(len(bases))), bases[best]


# share by which second orders, and the filter that generic terms pass, may change what an explanation explains
SECOND_ORDER = 0.05


def _weigh_terms(s: Omnibus, claimed: float, most: int, spread: float) -> list[float]:
    charge = float(np.log(max(1, s.tried)))
    sets = [(chi2, n, n * charge) for n, chi2 in enumerate(s.explained[:most], start=1)]
    sets += [(t.chi2, t.rank, charge) for t in s.varying]
    capped = (
        (min(x, claimed + n) if x < (1.0 + SECOND_ORDER) * claimed + n else x, n, paid) for x, n, paid in sets
    )
    return [weigh(*c, spread) for c in capped]


def find_best_single(bases: Sequence[Remainder]) -> float:
    """Chi-square that the best generic term of one coefficient explains."""

    def singles(s: Omnibus) -> list[float]:
        return [t.z**2 for t in (*s.steady[:1], *s.varying) if t.rank == 1]

    return max(sum(max([0.0, *singles(s)]) for s in b.searches) for b in bases)


def estimate_covariance(
    x: Regression, left: Remainder, columns: Sequence[str], projected: Sequence[str]
) -> Array:
    """(n, n): the covariance to state of ``columns``, no variance below the model's own, with how far the values move when the generic
    terms that are left are fitted beside the columns ``projected`` out of the residual.
    """
    n = len(x.value)
    at = {label: k for k, label in enumerate(columns)}
    places = [at[label] for label in projected if label in at]
    picked = [k for k, label in enumerate(projected) if label in at]
    moved = np.zeros(n)
    for factors, s in zip(x.flights, left.searches, strict=True):
        if s.shift is not None:
            full = np.zeros(n)
            full[places] = s.shift[picked]
            moved += sum((t[:, :n].T @ (t[:, :n] @ full) for t in factors), np.zeros(n))
    C = x.covariance
    V = x.sandwich + C @ C  # with what the prior leaves open: its rows are those of unit
    wider = np.sqrt(np.maximum(1.0, np.diag(C) / np.maximum(np.diag(V), 1e-300)))
    return np.asarray(V * np.outer(wider, wider) + np.outer(C @ moved, C @ moved))
