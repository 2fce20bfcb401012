"""What one would try instead, on the same columns: stepwise BIC, lasso, PySINDy, FROLS.

Every method gets the residual and the candidate columns at the calibrated point, in units of the error, with
the base columns (and those of an unknown gradient) projected out by ordinary least squares: calibration is
done for it. It does not get the noise's spectrum. It selects columns; the effects of these columns, in the
order in which the method ranks them, are what it claims.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.fit import columns as design
from ragg_runtime.fit.fitted import Fitted

Array = NDArray[np.float64]

MOST = 20
"""Most columns that a method may select."""

RIDGE = 10.0
"""Of PySINDy's regressions, on columns of unit rms: the best of 0.05, 10, 100 on trial flights."""


@dataclass(frozen=True)
class Columns:
    """X (rows, n) of unit norm, y (rows,), and the effect of every column."""

    X: Array
    y: Array
    effects: tuple[str, ...]


def columns(f: Fitted, kinds: Sequence[str] = ("deterministic", "step")) -> Columns:
    """The candidate columns and the residual of one flight, base projected out, not whitened."""
    (piece,) = f.prepared[0].each(lambda p: p)  # short flights are one piece
    valid = piece.observation.record.valid
    whole_columns = piece.columns[:, 0, valid]
    for w in piece.windows:  # an unknown gradient is projected out of everything
        whole_columns[:, w.places] -= (whole_columns[:, w.places] @ w.raw) @ w.raw.T
    base, y = whole_columns[: f.n_base], whole_columns[-1] / f.k_ggi
    norms = np.linalg.norm(base, axis=1)
    U, s, _ = np.linalg.svd((base[norms > 0] / norms[norms > 0, None]).T, full_matrices=False)
    U = U[:, s > 1e-9 * s[0]]
    usable = {e.id for e in f.model.candidates if e.kind in kinds}
    found = design.candidate_columns(f.model, f.instrument)
    X = whole_columns[f.n_base : -1] / f.k_ggi
    whole = np.linalg.norm(X, axis=1)
    for _ in range(2):  # twice, for the rounding
        X = X - (X @ U) @ U.T
        y = y - U @ (U.T @ y)
    left = np.linalg.norm(X, axis=1)
    kept = [n for n, c in enumerate(found) if c.effect in usable and left[n] > 1e-6 * whole[n] > 0]
    return Columns((X[kept] / left[kept, None]).T, y, tuple(str(found[n].effect) for n in kept))


def bic(rss: float, rows: int, parameters: int) -> float:
    """Schwarz's criterion for white Gaussian noise of unknown variance."""
    return float(rows * np.log(rss / rows) + parameters * np.log(rows))


def stepwise(c: Columns) -> list[int]:
    """Forward regression: the column that lowers the residual most, while BIC falls."""
    gram, projection, rss = c.X.T @ c.X, c.X.T @ c.y, float(c.y @ c.y)
    rows = len(c.y)
    chosen: list[int] = []
    best = bic(rss, rows, 0)
    left = np.diag(gram).copy()
    basis = np.empty((0, len(left)))  # rows of the Cholesky factor: columns' products with chosen directions
    while len(chosen) < MOST:
        gain = np.where(left > 1e-9, projection**2 / np.maximum(left, 1e-9), 0.0)
        gain[chosen] = 0.0
        k = int(np.argmax(gain))
        value = bic(rss - float(gain[k]), rows, len(chosen) + 1)
        if value >= best:
            break
        row = (gram[k] - basis[:, k] @ basis) / np.sqrt(left[k])
        along = projection[k] / np.sqrt(left[k])
        best, rss = value, rss - float(gain[k])
        projection, left = projection - along * row, left - row**2
        basis = np.vstack([basis, row])
        chosen.append(k)
    return chosen


def lasso(c: Columns) -> list[int]:
    """scikit-learn's LassoLarsIC with BIC; ranked by size."""
    from sklearn.linear_model import LassoLarsIC

    fitted = LassoLarsIC(criterion="bic", fit_intercept=False, max_iter=60).fit(_scaled(c), c.y)
    return _by_size(fitted.coef_)


def sindy(c: Columns) -> list[int]:
    """PySINDy's stepwise sparse regression on its identity library, the sparsity by BIC, none allowed.

    (Its default, STLSQ, starts from all columns at once and keeps most of them where they are nearly collinear,
    as these are, at any threshold.) Columns rank by how long they survive.
    """
    import pysindy

    rows, R = len(c.y), np.linalg.qr(np.column_stack([_scaled(c), c.y]), mode="r")
    X, y = R[:, :-1], R[:, -1]  # the same normal equations in a few rows
    optimizer = pysindy.SSR(alpha=RIDGE, max_iter=X.shape[1])
    model = pysindy.SINDy(optimizer=optimizer, feature_library=pysindy.IdentityLibrary())
    model.fit(X, t=1.0, x_dot=y[:, None])
    best: tuple[float, list[int]] = (bic(float(c.y @ c.y), rows, 0), [])
    survived: dict[int, int] = {}
    for step, coefficients in enumerate(optimizer.history_):
        kept = [int(k) for k in np.flatnonzero(np.asarray(coefficients)[0])]
        survived |= dict.fromkeys(kept, step)
        if 0 < len(kept) <= MOST:
            e = y - X[:, kept] @ np.linalg.lstsq(X[:, kept], y, rcond=None)[0]
            best = min(best, (bic(float(e @ e), rows, len(kept)), kept))
    return sorted(best[1], key=lambda k: (-survived[k], k))


def frols(c: Columns) -> list[int]:
    """FROLS of SysIdentPy, of first degree and without lags; order by BIC, none allowed."""
    from sysidentpy.basis_function import Polynomial
    from sysidentpy.model_structure_selection import FROLS
    from sysidentpy.parameter_estimation import LeastSquares

    X, y = _scaled(c), c.y[:, None]
    model = FROLS(
        ylag=1,
        xlag=[[1]] * X.shape[1],
        model_type="NFIR",
        order_selection=True,
        info_criteria="bic",
        n_info_values=min(12, X.shape[1]),
        basis_function=Polynomial(degree=1),
        estimator=LeastSquares(),
    )
    # its regressors are a constant and x(k-1): it is given the columns a sample ahead
    model.fit(X=np.vstack([X[1:], X[-1:]]), y=y)
    rows = len(y) - 1
    if rows * np.log(np.var(y[1:], ddof=1)) <= np.nanmin(model.info_values):
        return []
    return [int(k) - 1 for k in model.pivv[: model.n_terms] if k > 0]


PEERS: Mapping[str, Callable[[Columns], list[int]]] = {
    "stepwise BIC": stepwise,
    "lasso (BIC)": lasso,
    "PySINDy (SSR)": sindy,
    "FROLS": frols,
}
"""Columns selected by each method, best first."""


def claims(c: Columns) -> dict[str, dict[str, object]]:
    """What every method claims on one flight: effects in order, how many columns, seconds."""
    found: dict[str, dict[str, object]] = {}
    for name, method in PEERS.items():
        begin = time.perf_counter()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of convergence and collinearity: they get what they choose
            chosen = method(c)
        effects = list(dict.fromkeys(c.effects[k] for k in chosen))
        seconds = time.perf_counter() - begin
        found[name] = {"effects": effects, "columns": len(chosen), "seconds": round(seconds, 3)}
    return found


def _scaled(c: Columns) -> Array:
    """Columns of unit rms."""
    return np.asarray(c.X * np.sqrt(len(c.y)))


def _by_size(coefficients: Array) -> list[int]:
    order = np.argsort(-np.abs(coefficients))
    return [int(k) for k in order if coefficients[k] != 0.0]
