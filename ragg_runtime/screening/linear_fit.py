"""How well a model can explain a record if its parameters may move as far as is plausible: one number.

One linear fit about the test sheet, with every parameter's prior, robust against outliers, the size of the
residual being the only thing unknown. It costs milliseconds; it is no calibration. The number is minus the log
evidence of the fit (D. MacKay, Neural Computation 4, 1992, 415), so that whatever may be wrong with a record, a unit,
an axis, a clock or the sheet itself, competes by the same.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.estimation.least_squares import compute_r_factor
from ragg_runtime.estimation.regressors import Column, list_base_columns, list_own_columns, put_derivatives
from ragg_runtime.model.model import make_vector, scale_factor
from ragg_runtime.screening.sampler import Rows, Sampler

Array = NDArray[np.float64]

GRADIENT_SCALE = 1e4
"""Prior of a gravity gradient that was not recorded, Eo."""

OUTLIER = 8.0
"""Residual, in robust standard deviations, from which a sample is left out of the fit."""

QUARTILE = 0.75
"""Quantile of the residuals that tells their size. Not the median: where the residual is a beat rather than noise that says little."""

QUARTILE_OF_NORMAL = 1.15
"""The same quantile of the modulus of a normal variable, in standard deviations."""

RARE = 0.01
"""Probability of an outlier: what recorders' glitches make."""

INDEPENDENT = 150.0
"""Rows that a fit counts as, however many it takes: what a wrong model leaves is a wave and no noise. Measured on the benchmark's
flights, two choices of rows tell the residual of a record to 10 %, and the parameters' squared moves to 30: as many rows weigh
both alike (2 x 150 log 1.1)."""

SETTLED = 0.999
"""Factor by which the noise must still fall for the estimate to go on."""


@dataclass(frozen=True)
class LinearFit:
    """What a model leaves of rows of a record once its parameters are fitted.

    Attributes
    ----------
    rms
        Size of the residual without its outliers, Eo.
    size
        Size of the output about its mean, Eo.
    p
        Fitted parameter vector of the model's chain, SI.
    surprise
        Sum of the squares of the parameters' moves, in plausible sizes.
    volume
        What the record determines of the parameters: the logarithm of prior over posterior volume, the price of wide priors.
    kept
        Share of the rows that are no outliers.
    """

    rms: float
    size: float
    p: Array
    surprise: float
    volume: float
    kept: float = 1.0

    @property
    def share(self) -> float:
        """Residual over output: the same in any unit of the output."""
        return self.rms / self.size if self.size > 0 else 1.0

    @property
    def misfit(self) -> float:
        """Minus the log likelihood of a row: 0 of a model that predicts nothing. An outlier is explained by nothing, and is rare."""
        return self.kept * float(np.log(max(self.share, 1e-300))) - (1.0 - self.kept) * float(np.log(RARE))

    @property
    def score(self) -> float:
        """Minus the log evidence, with :data:`INDEPENDENT` rows; the smaller the better."""
        return INDEPENDENT * self.misfit + self.surprise / 2 + self.volume


@dataclass(frozen=True)
class Hypothesis:
    """What may be wrong with a record or its sheet.

    Attributes
    ----------
    what, remedy
        In words.
    fitted
        What the model leaves if this is so.
    cost
        What orders hypotheses that explain as much, the plainest first: far below ``mistakes.AS_GOOD``.
    kind
        ``record`` (units, signs, axes, clock: the record is refused), ``shift`` (motion and output apart in time), ``origin``
        (the disc angle counts from elsewhere), ``losses`` (rows are missing all along) or ``sheet`` (its priors are too narrow).
    effects
        Ids of effects that describe the same.
    calming
        Whether it is enough that the parameters stay closer to the sheet; a mistake of timing must leave less.
    """

    what: str
    remedy: str
    fitted: LinearFit
    cost: float = 0.0
    kind: str = "record"
    effects: tuple[str, ...] = ()
    calming: bool = False

    def score(self, before: LinearFit) -> float:
        """Minus the log evidence: one number for any mistake; ``before``: the record as it is."""
        calmed = 0.0 if self.calming else max(0.0, before.surprise - self.fitted.surprise)
        return self.fitted.score + self.cost + calmed / 2


def fit_rows(rows: Rows) -> LinearFit:
    """Fit the model's parameters about the instrument's values, with their priors."""
    s, p = rows.sampler, make_vector(rows.sampler.model, rows.sampler.instrument)
    X, y = (x.reshape(*x.shape[:-2], -1) for x in linearise(rows))
    theta, kept, volume = fit_robustly(X, y)
    size = rows.data[:, rows.inner] / scale_factor(s.model, p, s.place)
    size = (size - np.mean(size, axis=1, keepdims=True)).reshape(-1)
    own = list_columns(s)
    moves = theta[: len(own)]
    for (column, place), move in zip(own, moves, strict=True):
        p[place] += move * column.scale
    return LinearFit(
        rms=float(np.sqrt(np.mean((y - theta @ X)[kept] ** 2))),
        size=float(np.sqrt(np.mean(size[kept] ** 2))),
        p=p,
        surprise=float(np.sum(moves**2)),
        volume=volume,
        kept=float(np.mean(kept)),
    )


def list_columns(s: Sampler) -> list[tuple[Column, int]]:
    """The parameters of an output, each with its place in the parameter vector."""
    base = list_base_columns(s.model, s.instrument)
    return [base[k] for k in list_own_columns([c for c, _ in base], s.instrument, s.place)]


def linearise(rows: Rows) -> tuple[Array, Array]:
    """The output by every parameter, times the width of its prior, and by a gradient that was not recorded, (n, m, rows), and the
    output less the model at the sheet's values, (m, rows), Eo, of those of the rows that are fitted.
    """
    s, o, x = rows.sampler, rows.sampler.output, rows.inputs
    p, chain = make_vector(s.model, s.instrument), s.model.chain
    nominal = s.recorded.of_voltages(o, chain.voltages(rows.time, x, p, rows.phi, o.members))
    own = [c for c, _ in list_columns(s)]
    columns = np.zeros((len(own), *nominal.shape))
    put_derivatives(columns, chain, own, (rows.time, x, rows.phi), p, s.recorded, o)
    eotvos = scale_factor(s.model, p, s.place)
    gradient = () if rows.gradient_recorded else (_make_gradient(rows),)
    X, y = rows.seen(np.concatenate([columns / eotvos, *gradient])), rows.data - rows.seen(nominal)
    return X[..., rows.inner], y[:, rows.inner] / eotvos


def _make_gradient(rows: Rows) -> Array:
    """(2, m, N): columns of a constant gradient, before demodulation."""
    o = rows.sampler.output
    share = np.array(o.carriers) * np.array(o.radii) / max((*o.radii, 1e-300)) / len(o.members)
    wave = GRADIENT_SCALE * share[:, None] * np.exp(2j * rows.phi)
    return np.stack([rows.sampler.recorded.of_voltages(o, x) for x in (wave.imag, wave.real)])


def find_least(cost: Callable[[float], float], grid: NDArray[np.floating[Any]], finest: float) -> float:
    """Where a cost is least: on an even grid, then beside the best, at half the distance each time, until that is ``finest``."""
    tried, step = {float(x): cost(float(x)) for x in grid}, float(grid[1] - grid[0])
    best = min(tried, key=tried.__getitem__)
    while step > finest:
        step /= 2
        tried |= {x: cost(x) for x in (best - step, best + step)}
        best = min(tried, key=tried.__getitem__)
    return best


def find_inliers(left: Array) -> NDArray[np.bool_]:
    """Which of the moduli of some residuals, (..., rows), are no outliers."""
    return np.asarray(left <= OUTLIER * float(np.quantile(left, QUARTILE)) / QUARTILE_OF_NORMAL)


def fit_robustly(X: Array, y: Array) -> tuple[Array, NDArray[np.bool_], float]:
    """Coefficients (n,) of columns X (n, rows), the rows that are no outliers of the fit, and the information about the coefficients."""
    kept = np.ones(len(y), dtype=np.bool_)
    theta, volume = fit_shrunken(X, y)
    for _ in range(10):
        left = np.abs(y - theta @ X)
        now = find_inliers(left)
        if np.array_equal(now, kept) or np.sum(now) < 2 * len(X):
            break
        kept = now
        theta, volume = fit_shrunken(X[:, kept], y[kept])
    return theta, kept, volume


def fit_shrunken(X: Array, y: Array) -> tuple[Array, float]:
    """Coefficients (n,) of columns X (n, rows), each with a prior of unit width, and y's information about them; y's noise is estimated.

    The noise is what the fit leaves: starting from "all is noise" it falls until fit and noise agree.
    """
    R = compute_r_factor(np.vstack([X, y]))
    n = len(X)
    U, s, Vt = np.linalg.svd(R[:n, :n])
    d = U.T @ R[:n, n]
    rest = float(R[n, n] ** 2)
    noise = max(float(np.mean(y**2)), 1e-30)
    for _ in range(200):
        left = d * noise / (s**2 + noise)
        found = max((float(np.sum(left**2)) + rest) / len(y), 1e-30)
        if found > SETTLED * noise:
            break
        noise = found
    volume = 0.5 * float(np.sum(np.log1p(s**2 * INDEPENDENT / (len(y) * noise))))
    return np.asarray(Vt.T @ (d * s / (s**2 + noise))), volume
