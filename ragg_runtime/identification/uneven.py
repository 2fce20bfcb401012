"""Scores that vary more than they should: what tests are worth where the noise is not one of known weights.

A likelihood-ratio test trusts that whitened noise has unit variance everywhere. Where the noise's level was seen to change
(``estimation.noise_level``) the weights are estimates by groups, tails are heavy, and a term that is large in a few swings
of the motion rides on them. The scores of what is tested, summed in blocks of time, give their real variance: the
ratio to what unit variance gives divides chi-square (J. N. K. Rao, A. J. Scott, Ann. Stat. 12, 1984, first-order correction).
That ratio is known from so many blocks: the test then follows Fisher's F, as one of a variance that was estimated.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.scores import log_sf
from ragg_runtime.identification.likelihood_ratio import Test, log_bayes

Array = NDArray[np.float64]

FEWEST = 8
"""Blocks from which a spread of scores is taken for known: of fewer it is known to a factor of two at best."""

DIRECTIONS = 1e-7
"""Relative size below which a direction of the tested columns is rounding."""


@dataclass(frozen=True)
class ProjectedBlocks:
    """An R factor [columns | data] and those of blocks of time, with what is in the model projected out.

    Attributes
    ----------
    T, blocks
        R factors: of everything, and of those blocks in which there is any sample.
    base, others
        What is in the model: the first so many columns, and others.
    B
        (base + others, columns + 1): what these explain of every column, and of the data.
    data
        What is left of the data, of everything and of each block.
    """

    T: Array
    blocks: Sequence[Array]
    base: int
    others: Sequence[int]
    B: Array = field(init=False)
    data: tuple[Array, ...] = field(init=False)

    def __post_init__(self) -> None:
        given = [*range(self.base), *self.others]
        object.__setattr__(self, "B", np.linalg.lstsq(self.T[:, given], self.T, rcond=None)[0])
        object.__setattr__(self, "data", tuple(self.left(t, [-1])[:, 0] for t in (self.T, *self.blocks)))

    def left(self, t: Array, columns: Sequence[int]) -> Array:
        """What is left of some columns of the R factor of everything, or of a block."""
        n = self.base
        found = t[:, columns] - t[:, :n] @ self.B[:n, columns]
        return np.asarray(found - t[:, self.others] @ self.B[n:, columns] if self.others else found)


def measure_inflation(beside: ProjectedBlocks, tested: Sequence[int]) -> float:
    """How much more the scores vary than they should: at least 1.

    That is the variance of a block's score along what is fitted, relative to that of noise of unit variance. What is left
    of the data has the columns ``tested`` fitted, too, so that what is tested raises no doubt about itself.
    """
    if len(beside.blocks) < FEWEST:
        return 1.0
    whole, *parts = beside.data
    U, s, Vt = np.linalg.svd(beside.left(beside.T, tested), full_matrices=False)
    known = s > DIRECTIONS * s[0]
    W = Vt[known].T / s[known]
    along = U[:, known].T @ whole
    g = W @ along
    power = 0.0
    for t, y in zip(beside.blocks, parts, strict=True):
        X = beside.left(t, tested)
        power += float(g @ (X.T @ (y - X @ g))) ** 2
    return max(1.0, power / float(along @ along))


def list_nonempty_blocks(blocks: Iterable[Array]) -> tuple[Array, ...]:
    """Those in which there is any sample."""
    return tuple(t for t in blocks if np.any(t))


def temper_test(t: Test, by: float, freedom: float, blocks: int) -> Test:
    """A test whose chi-square is divided by the variance of the blocks; corrections for variants stay."""
    if by <= 1.0:
        return t
    known = min(freedom, blocks - 1.0)
    change = log_sf(t.chi2 / by, t.rank, known) - log_sf(t.chi2, t.rank, freedom)
    less = float(log_bayes(t.chi2, t.rank) - log_bayes(t.chi2 / by, t.rank))
    return replace(t, log_p=min(0.0, t.log_p + change), log_b=t.log_b - less, inflation=by)
