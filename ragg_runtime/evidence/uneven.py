"""Scores that vary more than they should: what tests are worth where the noise is not one of known weights.

A likelihood-ratio test trusts that whitened noise has unit variance everywhere. Where the noise's level was seen to change
(``signals.noise_level``) the weights are estimates by groups, tails are heavy, and a term that is large in a few swings
of the motion rides on them. The scores of what is tested, summed in blocks of time, tell how variable they really are: the
ratio to what unit variance gives divides chi-square (J. N. K. Rao, A. J. Scott, Ann. Stat. 12, 1984, first-order correction).
That ratio is known from so many blocks: the test then follows Fisher's F, as one of a variance that was estimated.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.evidence.likelihood_ratio import Test
from ragg_runtime.fit.significance import log_sf

Array = NDArray[np.float64]

FEWEST = 8
"""Blocks from which a spread of scores is taken for known: of fewer it is known to a factor of two at best."""

DIRECTIONS = 1e-7
"""Relative size below which a direction of the tested columns is rounding."""


def inflation(T: Array, blocks: Sequence[Array], given: Sequence[int], tested: Sequence[int]) -> float:
    """How much more the scores vary than they should: at least 1.

    That is the variance of a block's scores, relative to that of noise of unit variance, mean over directions.
    ``T`` is the triangle [columns | data], ``blocks`` those of blocks of time with any sample; ``given`` are in the model, ``tested``
    beside them. What is left of the data has both fitted, so that what is tested raises no doubt about itself.
    """
    if len(blocks) < FEWEST:
        return 1.0
    B = np.linalg.lstsq(T[:, given], T[:, tested], rcond=None)[0]
    X = T[:, tested] - T[:, given] @ B
    _, s, Vt = np.linalg.svd(X, full_matrices=False)
    known = s > DIRECTIONS * s[0]
    W = Vt[known].T / s[known]
    fitted = [*given, *tested]
    g = np.linalg.lstsq(T[:, fitted], T[:, -1], rcond=None)[0]
    power = 0.0
    for t in blocks:
        score = W.T @ (t[:, tested] - t[:, given] @ B).T @ (t[:, -1] - t[:, fitted] @ g)
        power += float(score @ score)
    return max(1.0, power / int(np.sum(known)))


def telling(blocks: Iterable[Array]) -> tuple[Array, ...]:
    """Those in which there is any sample."""
    return tuple(t for t in blocks if np.any(t))


def tempered(t: Test, by: float, freedom: float, blocks: int) -> Test:
    """A test with the p-value of its chi-square divided, by what so many blocks tell; corrections for variants stay."""
    if by <= 1.0:
        return t
    known = min(freedom, t.rank * (blocks - 1.0))
    change = log_sf(t.chi2 / by, t.rank, known) - log_sf(t.chi2, t.rank, freedom)
    return replace(t, log_p=min(0.0, t.log_p + change))
