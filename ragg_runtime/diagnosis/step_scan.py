"""Steps at an unknown instant: the most likely instant of each, and their columns from there on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.evidence import selection
from ragg_runtime.evidence import steps as special
from ragg_runtime.evidence.selection import Field, field_of, testable_effects
from ragg_runtime.fit import columns as design
from ragg_runtime.fit import prepared_flight
from ragg_runtime.fit.fitted import Fitted, fit
from ragg_runtime.fit.noise import estimate_noise
from ragg_runtime.fit.prepared_flight import PreparedFlight
from ragg_runtime.fit.segments import BLOCKS

Array = NDArray[np.float64]


BESIDE = 20.0
"""Logarithm of the p-value by which a step must be surer beside the first effect than by itself to be taken at that instant."""


def with_steps(f: Fitted, *, quiet: bool = False) -> tuple[Field, Fitted, dict[str, float]]:
    """The field of all deterministic candidates, steps at their most likely instant among them.

    Returns the field, the flights with the steps' columns put in, and the instants by effect, s. A step that no column
    explained is part of the noise that was estimated: once its instant is known the noise is estimated again, and
    everything with it (``quiet``: that has been done).
    """
    available = testable_effects(f)
    steps = [e for e in f.model.candidates if e.kind == "step"]
    if len(f.prepared) != 1 or not steps:
        return field_of(f, available), f, {}
    x, triangles = f.prepared[0], f.triangles[0]
    time = x.observation.record.time
    columns = design.candidate_columns(f.model, f.instrument)
    plain = field_of(f, available)
    first = [n for e in selection.choose(plain).chosen for n, _ in plain.candidates[e]]
    instants: dict[str, float] = {}
    exact: dict[str, float] = {}
    stepped, sums = list(triangles), f.sums[0].copy()
    for e in steps:
        own = [(n, c) for n, c in enumerate(columns) if c.effect == e.id]
        edges = [int(k) for k in x.edges[1:-1]]
        scans = [
            (special.best_step(triangles, edges, f.n_base, given, own, f.to_nominal), given)
            for given in ([[], first] if first else [[]])
        ]
        # By itself, unless it explains far more beside the first choice.
        step, given = scans[-1] if scans[-1][0].test.log_p < scans[0][0].test.log_p - BESIDE else scans[0]
        places = [f.n_base + n for n, _ in own]
        found = _stepped(stepped, x, step, places)
        field = _with_penalty(replace(f, triangles=(tuple(found),)), [*available, *instants, e.id])
        if e.id in selection.choose(field).chosen:
            step = special.refined(x, step, f.n_base, given, own, f.to_nominal)
            projector = prepared_flight.projector(triangles, f.n_base, given)
            step = replace(step, sample=special.sharpened(x, step.sample, projector, places))
            exact[e.id] = float(time[step.sample])
        instants[e.id] = float(time[step.sample])
        stepped = _stepped(stepped, x, step, places)
        sums[np.ix_(x.edges[:-1] < step.sample, np.array(places))] = 0.0
    if exact and not quiet:
        noise = estimate_noise(replace(x.at, instants=exact), x.observation)
        calmer = fit(f.model, f.instrument, f.observations, [noise], f.calibration.p)
        return with_steps(calmer, quiet=True)
    if exact:  # the columns themselves, to the sample, and through the filter
        x = replace(x.released(), at=replace(x.at, instants=exact))
        triangles, sums = prepared_flight.blocks(x)
        stepped = list(triangles)
    elif instants:
        moved = {e: [f.n_base + n for n, c in enumerate(columns) if c.effect == e] for e in instants}
        x = x.with_steps(instants, moved)
    f = replace(f, prepared=(x,), triangles=(tuple(stepped),), sums=(sums,))
    return _with_penalty(f, [*available, *instants]), f, instants


def _stepped(
    triangles: Sequence[Array], x: PreparedFlight, step: special.Step, places: Sequence[int]
) -> list[Array]:
    """Block triangles with the columns at ``places`` put to zero before a step on the edge of a block."""
    found = [t.copy() for t in triangles]
    for b in range(BLOCKS):
        if x.edges[b] < step.sample:
            found[b][:, list(places)] = 0.0
    return found


def _with_penalty(f: Fitted, effects: Sequence[str]) -> Field:
    """The field of effects, steps among them charged for the choice of their instant."""
    steps = [e.id for e in f.model.candidates if e.kind == "step"]
    return replace(field_of(f, effects), penalty=dict.fromkeys(steps, float(np.log(2 * BLOCKS))))
