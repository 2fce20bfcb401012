"""Generated C of other instruments and orders against the paper's, a sample, on one core, in turn.

An output of four accelerometers each, so that a ratio a sample is one a sample and accelerometer.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any

from benchmarks import RATIO, Row
from benchmarks.rivals import aligned
from benchmarks.timing import interleaved, ratio

LAYOUT, FULL, EXACT = 1.3, 1.3, 2.0
"""At most so many times the paper's model a sample: other layouts, full kinematics, exact order."""

PAPER = "the paper's model"
STREAMING, IN_CACHE = 1_000_000, 16_000


def rows(t: Any, x: Any, p: Any) -> list[Row]:
    """Ratios streaming and in cache; ``t``, ``x``, ``p``: of the paper's instrument (``benchmarks.evaluation``)."""
    import numpy as np

    turning = np.stack([np.full(len(t), 2 * np.pi * p[1]), np.zeros(len(t))])
    wide, models = np.vstack([x, turning]), list(_models(p))
    found = []
    for label, n, rounds, inner in (("streaming", STREAMING, 15, 1), ("in cache", IN_CACHE, 15, 20)):
        s, y, out = aligned(t[:n]), aligned(wide[:, :n]), aligned(np.zeros(n))
        calls: Mapping[str, Callable[[], object]] = {
            name: partial(e.output, s, y[: len(e.inputs)], q, out=out) for name, e, q, _ in models
        }
        times = interleaved(calls, rounds, inner, clock=time.process_time, prime=inner > 1)
        for name, _, _, limit in models[1:]:
            r = ratio(times[name], times[PAPER])
            ns = 1e9 * times[name].median / n
            found.append(
                Row(
                    f"{name} / {PAPER}, {label}",
                    r.value,
                    RATIO,
                    f"generated C, {ns:.1f} ns a sample",
                    low=r.low,
                    high=r.high,
                    target=f"at most {limit:g}",
                    met=r.value <= limit,
                )
            )
    return found


def _models(p: Any) -> Iterator[tuple[str, Any, Any, float]]:
    """Name, evaluator, parameters and the largest ratio aimed at; the paper's first."""
    from ragg_runtime.instrument.form import PRESETS, Form
    from ragg_runtime.instrument.read_toml import parse_instrument
    from ragg_runtime.model.evaluate import vector
    from ragg_runtime.model.model import packaged
    from ragg_runtime.model_dir import derive
    from tests.layouts import sheets

    exact = Form(kinematics="full", **dict(PRESETS["exact"]))  # type: ignore[arg-type]
    yield PAPER, packaged().compiled("c"), p, 1.0
    yield "full kinematics", packaged("full").compiled("c"), p, FULL
    yield "full kinematics and exact order", derive.derived((), (), exact)[0].compiled("c"), p, EXACT
    for name, discs, count in (
        ("two complements on a disc, an output", sheets.complements(), 8),
        ("an umbrella of three discs, an output", sheets.umbrella(), 12),
    ):
        i = parse_instrument(sheets.sheet(discs, count))
        model = derive.derived((), (), i.form, i.layout)[0]
        yield name, model.compiled("c"), vector(model, i), LAYOUT
