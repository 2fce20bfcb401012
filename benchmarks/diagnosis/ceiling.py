"""What could be found at most: an oracle that knows noise and true instrument tests the effect that is hidden, and no other.

Its test is that of the diagnosis, with the same columns and the same sheet (``likelihood_ratio.test``), at the level of the catalogue over
the number of independent tests; of a step it knows the instant. Of effects without columns it has the scores of ``strength``.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import special

from benchmarks.diagnosis.fly import Prepared, prepared
from benchmarks.diagnosis.plan import Spec
from benchmarks.diagnosis.strength import Hidden, Oracle
from ragg_runtime.base import false_alarms
from ragg_runtime.estimation.least_squares import compute_r_factor
from ragg_runtime.estimation.observation import BLOCKS, observe
from ragg_runtime.estimation.regressors import list_base_columns, predict_observed
from ragg_runtime.identification import likelihood_ratio
from ragg_runtime.identification.selection import ProjectedProblem
from ragg_runtime.model.model import make_vector

Array = NDArray[np.float64]


def tested(spec: Spec) -> dict[str, Any]:
    """The oracle's p-value of what is hidden in a flight, by itself and over the catalogue."""
    p = prepared(spec)
    (h,), o = p.hidden, p.oracle
    assert o is not None
    left = _left(p, o)
    log_p = _log_p(o, h, left) / np.log(10.0)
    over = log_p + np.log10(_field(o, left).effective_count)
    return {
        "id": spec.id,
        "kind": spec.kind,
        "hidden": h.effect,
        "log10_p": round(log_p, 2),
        "over_catalogue": round(over, 2),
        "alone": int(log_p < np.log10(false_alarms.PROMISED)),
        "found": int(over < np.log10(false_alarms.CATALOGUE)),
    }


def _left(p: Prepared, o: Oracle) -> Array:
    """(rows + n,): the whitened record and the sheet, less what the true instrument makes of the recorded motion, projected."""
    w = p.world
    outputs = {n: np.nan_to_num(p.table[n]) for n in o.flight.outputs}
    x = observe(
        replace(o.flight, channels={n: p.table[n] for n in o.flight.channels}, outputs=outputs), w.known
    )
    true = make_vector(o.model, w.known)
    rest = np.stack(x.series) - predict_observed(o.model, x, true)
    base = list_base_columns(o.model, w.known)
    sheet = [(make_vector(o.model, w.scenario.sheet)[k] - true[k]) / c.scale for c, k in base]
    y = np.concatenate([o.whitened(np.where(o.valid, rest, 0.0)[None])[0], sheet])
    return np.asarray(y - o.Q @ (o.Q.T @ y))


def _log_p(o: Oracle, h: Hidden, left: Array) -> float:
    """Logarithm of the p-value of an effect's own test."""
    at, data = o.of(h.effect), left[: o.rows]
    if o.kinds[h.effect] == "random":
        shape = o.white[at[0]] ** 2
        return _normal((shape - np.mean(shape)) @ data**2 / np.sqrt(2.0 * len(data)) / np.std(shape))
    if h.effect == "quantisation":
        return _normal(np.sum(data**2 - 1.0) / np.sqrt(2.0 * len(data)))
    if h.effect == "saturation":
        G, most = o.flight.outputs["G_out"], h.values["V_max"]
        clipped = o.row(np.clip(G, -most, most) - G)
        return _normal(clipped @ left / np.linalg.norm(clipped))
    block = o.block(h.effect, h.values.get("t_step"))  # type: ignore[arg-type]
    P = compute_r_factor(np.concatenate([block, left[None]]))
    columns = [(n, o.columns[k]) for n, k in enumerate(at)]
    charge = float(np.log(2 * BLOCKS)) if o.kinds[h.effect] == "step" else 0.0
    return likelihood_ratio.test(P, columns, np.full(len(P), likelihood_ratio.TESTABLE), charge).log_p


def _normal(z: float | np.floating[Any]) -> float:
    return float(special.log_ndtr(-z))


def _field(o: Oracle, left: Array) -> ProjectedProblem:
    """All effects with columns; steps from the middle on."""
    middle = float(np.mean(o.flight.time[[0, -1]]))
    ids = [e for e, kind in o.kinds.items() if kind in ("deterministic", "step")]
    T = compute_r_factor(np.concatenate([*(o.block(e, middle) for e in ids), left[None]]))
    columns = iter(enumerate(o.columns[k] for e in ids for k in o.of(e)))
    candidates = {e: tuple(next(columns) for _ in o.of(e)) for e in ids}
    return ProjectedProblem(T=T, n_base=0, candidates=candidates)
