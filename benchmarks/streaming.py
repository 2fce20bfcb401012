"""An hour at 100 Hz from a file, and the dense way on the same columns.

The dense way tests each effect by least squares on base and candidate columns, all rows at once:
``numpy.linalg.lstsq`` (a few effects are timed, and the mean stands for each), and for coloured noise
``statsmodels`` GLS, whose covariance matrix of an hour would take a terabyte; it is timed on 5 minutes at 16 Hz.
"""

from __future__ import annotations

import resource
import statistics
import tempfile
import time
from pathlib import Path

from benchmarks import RATIO, Row
from benchmarks.loop import timed

EFFECTS = 3
"""Effects that are tested the dense way."""


def run() -> list[Row]:
    """Diagnosis of an hour, its memory, and the dense way."""
    import numpy as np
    import statsmodels.api as sm
    from scipy.linalg import toeplitz

    from ragg_runtime import compare, design, workflow
    from ragg_runtime.evidence import likelihood, work
    from ragg_runtime.flight import write_flight
    from ragg_runtime.simulate import simulated
    from ragg_runtime.threads import one_thread

    rows: list[Row] = []
    hidden = ["thermal-scale:dK1_dT=0/0/6e-8/0"]
    with tempfile.TemporaryDirectory() as folder:
        m = workflow.new(Path(folder) / "model")
        path = Path(folder) / "hour.parquet"
        write_flight(simulated(m.instrument, hidden, seed=1, duration=3600.0, rate=100.0), path)

        def diagnose() -> None:
            found = workflow.diagnose(m, workflow.read_flights(m, [path])).found
            if found != ("thermal-scale",):
                raise RuntimeError(f"the diagnosis is wrong: {found}")

        rows += timed("diagnose an hour at 100 Hz, reading it included", diagnose, 20.0, repeats=1)
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        rows.append(Row("peak memory", memory, "MB", "of the process, all imports in", better="lower"))
        (flight,) = workflow.read_flights(m, [path])
        f = compare.fit(m.model, m.instrument, [compare.observe(flight, m.instrument)])

    candidates = likelihood.grouped(design.candidate_columns(f.model, f.instrument))
    tested = compare.testable_effects(f)
    columns = np.concatenate([*f.flown[0].each(lambda p: p.white)], axis=1)

    @one_thread
    def ours() -> None:
        whole = design.triangle(columns)
        field = compare.Field(
            likelihood.with_prior(whole, f.n_base, f.to_nominal),
            f.n_base,
            {e: tuple(candidates[e]) for e in tested},
            columns.shape[1],
        )
        field.tests()

    @one_thread
    def dense(effect: str) -> None:
        picked = [*range(f.n_base), *(f.n_base + n for n, _ in candidates[effect])]
        np.linalg.lstsq(columns[picked].T, columns[-1], rcond=None)

    start = time.process_time()
    ours()
    triangles = time.process_time() - start
    spent = []
    for e in tested[:: max(1, len(tested) // EFFECTS)][:EFFECTS]:
        start = time.process_time()
        dense(e)
        spent.append(time.process_time() - start)
    each = statistics.mean(spent)
    note = (
        f"{columns.shape[1]} rows, {len(columns) - 1} columns, processor time, one thread of linear algebra"
    )
    rows += [
        Row("triangle and tests of the whole catalogue", triangles, "s", note, better="lower"),
        Row("numpy.linalg.lstsq, one effect", each, "s", f"{len(spent)} of {len(tested)} effects timed"),
        Row(
            "the dense way over ours",
            each * len(tested) / triangles,
            RATIO,
            f"each of {len(tested)} effects tested by itself",
            "at least 20",
            better="higher",
            met=each * len(tested) / triangles >= 20,
        ),
    ]

    short = simulated(m.instrument, hidden, seed=1, duration=300.0, rate=16.0)
    f = compare.fit(m.model, m.instrument, [compare.observe(short, m.instrument)])
    (piece,) = f.flown[0].each(lambda p: p)
    X, y = piece.columns[:, 0, :], piece.residual[0]
    n = X.shape[1]
    psd = f.flown[0].noise.models[0].psd(np.fft.rfftfreq(2 * n, 1 / 16.0))
    sigma = toeplitz(np.fft.irfft(psd)[:n] * 8.0)
    start = time.process_time()
    sm.GLS(y, X[: f.n_base].T, sigma=sigma).fit()
    gls = time.process_time() - start
    start = time.process_time()
    work.block_triangles(f.flown[0].released())
    streamed = time.process_time() - start
    return [
        *rows,
        Row("statsmodels GLS, base columns alone", gls, "s", f"{n} rows; an hour at 100 Hz needs 1 TB"),
        Row("our whitened triangles, all columns", streamed, "s", f"{n} rows"),
        Row("GLS over ours", gls / streamed, RATIO, "the same noise", better="higher"),
    ]
