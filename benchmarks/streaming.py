"""An hour at 100 Hz from a file, and the dense way on the same columns.

The dense way fits each effect by least squares on base and candidate columns, all rows at once, to everything and
to the blocks of time that are not held out: ``numpy.linalg.lstsq``, and ``statsmodels`` GLS on columns that we have
whitened (a few effects are timed, and the mean stands for each). Left to whiten for itself, GLS would want a
terabyte for the covariance of an hour; it is timed on 5 minutes at 16 Hz.
"""

from __future__ import annotations

import resource
import statistics
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from benchmarks import RATIO, Row
from benchmarks.loop import timed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ragg_runtime.fit.fitted import Fitted
    from ragg_runtime.workflow.loop import Loaded

    Array = NDArray[Any]

EFFECTS = 3
"""Effects that are fitted the dense way."""


HIDDEN = ("thermal-scale:dK1_dT=0/0/6e-8/0",)


def run() -> list[Row]:
    """Diagnosis of an hour, its memory, and the dense way."""
    from ragg_runtime.fit import fitted, observation
    from ragg_runtime.flight import write_flight
    from ragg_runtime.workflow import loop
    from ragg_runtime.workflow.simulate import simulated

    with tempfile.TemporaryDirectory() as folder:
        m = loop.new(Path(folder) / "model")
        path = Path(folder) / "hour.parquet"
        write_flight(simulated(m.instrument, HIDDEN, seed=1, duration=3600.0, rate=100.0), path)

        def diagnose() -> None:
            found = loop.diagnose(m, loop.read_flights(m, [path])).found
            if found != ("thermal-scale",):
                raise RuntimeError(f"the diagnosis is wrong: {found}")

        rows = timed("diagnose an hour at 100 Hz, reading it included", diagnose, 20.0, repeats=1)
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        rows.append(Row("peak memory", memory, "MB", "of the process, all imports in"))
        (flight,) = loop.read_flights(m, [path])
        f = fitted.fit(m.model, m.instrument, [observation.observe(flight, m.instrument)])
    return [*rows, *_dense(f), *_coloured(m)]


def _dense(f: Fitted) -> list[Row]:
    """Every effect fitted by least squares on all whitened rows, over our triangles."""
    import numpy as np
    import statsmodels.api as sm

    from ragg_runtime.base.threads import one_thread
    from ragg_runtime.evidence.selection import field_of, testable_effects
    from ragg_runtime.fit import columns as design
    from ragg_runtime.fit import fitted, square_root

    candidates = design.grouped(design.candidate_columns(f.model, f.instrument))
    tested = testable_effects(f)
    columns = np.concatenate([*f.prepared[0].each(lambda p: p.white)], axis=1)
    edges = f.prepared[0].edges
    fitted_rows = np.concatenate([np.arange(edges[b], edges[b + 1]) for b in fitted.FITTED_BLOCKS])
    places = {e: [n for n, _ in candidates[e]] for e in tested}

    @one_thread
    def ours() -> None:
        blocks = tuple(square_root.triangle(columns[:, a:b]) for a, b in pairwise(edges))
        again = replace(f, triangles=(blocks,))
        field_of(again, tested).tests()
        for e in tested:
            again.coefficients(places[e])
            again.coefficients(places[e], held_out=True)

    def picked(effect: str, rows: Array | slice) -> tuple[Array, Array]:
        wanted = [*range(f.n_base), *(f.n_base + n for n in places[effect])]
        return columns[wanted][:, rows].T, columns[-1][rows]

    @one_thread
    def dense(effect: str) -> None:
        for rows in (slice(None), fitted_rows):
            np.linalg.lstsq(*picked(effect, rows), rcond=None)

    @one_thread
    def gls(effect: str) -> None:
        for rows in (slice(None), fitted_rows):
            X, y = picked(effect, rows)
            sm.GLS(y, X).fit()

    note = (
        f"{columns.shape[1]} rows, {len(columns) - 1} columns, processor time, one thread of linear algebra: "
        "every effect's test, and its fit to everything and to the blocks of time that are not held out"
    )
    triangles = _processor_time(ours)
    rows = [Row("triangles and fits of the whole catalogue", triangles, "s", note)]
    some = tested[:: max(1, len(tested) // EFFECTS)][:EFFECTS]
    for name, way in (("numpy.linalg.lstsq", dense), ("statsmodels GLS, whitened by us", gls)):
        spent = [_processor_time(partial(way, e)) for e in some]
        rows += _over(name, spent, len(tested), triangles)
    return rows


def _over(name: str, spent: Sequence[float], effects: int, ours: float) -> list[Row]:
    ratio = statistics.mean(spent) * effects / ours
    return [
        Row(f"{name}, one effect", statistics.mean(spent), "s", f"{len(spent)} of {effects} timed"),
        Row(
            f"{name} over ours",
            ratio,
            RATIO,
            f"each of {effects} effects fitted by itself",
            "at least 20",
            met=ratio >= 20,
        ),
    ]


def _coloured(m: Loaded) -> list[Row]:
    """GLS that is given the covariance of the noise, on five minutes at 16 Hz."""
    import numpy as np
    import statsmodels.api as sm
    from scipy.linalg import toeplitz

    from ragg_runtime.fit import fitted, observation, prepared_flight
    from ragg_runtime.workflow.simulate import simulated

    short = simulated(m.instrument, HIDDEN, seed=1, duration=300.0, rate=16.0)
    f = fitted.fit(m.model, m.instrument, [observation.observe(short, m.instrument)])
    (piece,) = f.prepared[0].each(lambda p: p)
    X, y = piece.columns[:, 0, :], piece.residual[0]
    n = X.shape[1]
    psd = f.prepared[0].noise.models[0].psd(np.fft.rfftfreq(2 * n, 1 / 16.0))
    sigma = toeplitz(np.fft.irfft(psd)[:n] * 8.0)
    whole = _processor_time(lambda: sm.GLS(y, X[: f.n_base].T, sigma=sigma).fit())  # its root of sigma, too
    streamed = _processor_time(lambda: prepared_flight.blocks(f.prepared[0].released()))
    return [
        Row("statsmodels GLS, base columns alone", whole, "s", f"{n} rows; an hour at 100 Hz needs 1 TB"),
        Row("our whitened triangles, all columns", streamed, "s", f"{n} rows"),
        Row("GLS over ours", whole / streamed, RATIO, "the same noise"),
    ]


def _processor_time(work: Callable[[], object]) -> float:
    start = time.process_time()
    work()
    return time.process_time() - start
