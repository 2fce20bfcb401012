"""Each effect that a diagnosis looks for, as the independent simulator has it: named first, or one that is stated to be like it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.diagnosis import fly, plan, records
from benchmarks.diagnosis.oracle import NEVER, Oracle
from ragg_runtime.estimation.observation import observe
from ragg_runtime.estimation.regressors import group_by_effect, linearise, make_point
from ragg_runtime.identification.selection import ProjectedProblem, choose, find_alternatives
from ragg_runtime.model.model import load_packaged, make_vector

Array = NDArray[np.float64]

SIGMAS, DIRECTIONS = 30.0, 10

ABSORBED = ("spin-axis-wobble", "spin-phase-offset")
"""What the mounting angles of four accelerometers take for themselves within what a sheet leaves open."""

SEARCHED = [
    e.id
    for e in load_packaged().candidates
    if e.kind == "deterministic" and e.searched and e.id not in (*NEVER, *ABSORBED)
]


@dataclass(frozen=True)
class WhitenedFlight:
    """A short flight without effects, whitened, with the triangle [base | candidates] and its rotation, and a noise."""

    world: plan.World
    oracle: Oracle
    Q: Array
    R: Array
    noise: Array

    def field(self, y: Array) -> ProjectedProblem:
        """That of a residual (rows,), whitened."""
        o, size = self.oracle, len(self.R)
        padded = np.concatenate([np.zeros(o.n), y])
        T = np.zeros((size + 1, size + 1))
        T[:size, :size], T[:size, -1] = self.R, self.Q.T @ padded
        T[-1, -1] = np.sqrt(max(padded @ padded - T[:size, -1] @ T[:size, -1], 0.0))
        return ProjectedProblem(
            T=T,
            n_base=o.n,
            candidates={
                e: tuple(c) for e, c in group_by_effect(o.columns).items() if e in (*SEARCHED, *ABSORBED)
            },
            contains={e.id: e.contains for e in o.model.candidates},
        )


@pytest.fixture(scope="module")
def flight() -> WhitenedFlight:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(plan, "DURATION", 200.0)
        patch.setattr(plan, "RATE", 8.0)
        spec = plan.Spec("each", "white", 0, 4430)
        world = plan.world(spec)
    plain = fly.simulated(world, {})
    loudness = records.KINDS["white"].noise(fly.table(plain, plain.voltages_noise_free), spec.rng(2))
    oracle = Oracle(world, plain.flight(), loudness)
    white = oracle.whitened(oracle.raw)
    prior = np.pad(np.eye(oracle.n), ((0, 0), (0, len(white) - oracle.n)))
    Q, R = np.linalg.qr(np.concatenate([prior, white.T]))
    return WhitenedFlight(world, oracle, Q, R, np.random.default_rng(0).standard_normal(oracle.rows))


@pytest.mark.parametrize("effect", SEARCHED)
def test_it_is_named_first_or_one_that_is_stated_to_be_like_it(flight: WhitenedFlight, effect: str) -> None:
    o, rng = flight.oracle, np.random.default_rng(1)
    hidden = next(h for h in (o.drawn(effect, SIGMAS, rng) for _ in range(DIRECTIONS)) if h is not None)
    sim = fly.simulated(flight.world, {effect: hidden.values})
    known = make_point(o.model, flight.world.known, make_vector(o.model, flight.world.known))
    residual = linearise(known, observe(sim.flight(), flight.world.known))[-1]
    field = flight.field(o.whitened(residual[None])[0] + flight.noise)
    chosen = choose(field)
    first = next(iter(chosen))
    assert effect in (first, *find_alternatives(field, chosen)[first])
