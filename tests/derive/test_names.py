"""Effects of every stage under ids that the derivation uses itself, and the slopes of steps."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from derive.effect import Effect
from derive.effects import catalogue
from derive.expression import ExpressionError, from_expression
from derive.pipeline import derive_model
from ragg_runtime.model.model import Model, from_files

Array = NDArray[np.float64]
SAMPLES = 7
# One or more of every stage.
CHOSEN = ("arm-sag", "time-offset", "thermal-bias", "second-order-misalignment", "spin-phase-offset")


def model(*effects: Effect) -> Model:
    return from_files(derive_model(effects, ()))


def drawn(m: Model, seed: int = 3) -> tuple[dict[str, Array], Array, Array]:
    """Inputs of a model by name, parameters by place, and the time."""
    chance = np.random.default_rng(seed)
    base = np.random.default_rng(seed + 1).uniform(0.5, 1.5, (15, SAMPLES))
    inputs = {
        n: base[k] if k < 15 else chance.uniform(0.5, 1.5, SAMPLES) for k, n in enumerate(m.chain.INPUTS)
    }
    p = np.random.default_rng(seed + 2).uniform(0.5, 1.5, 2000)[: m.chain.SIZE]
    return inputs, p, np.linspace(0.0, 3.0, SAMPLES)


def evaluated(m: Model, inputs: dict[str, Array], p: Array, t: Array) -> Array:
    """V_j, (4, N)."""
    phi = 2 * np.pi * p[1] * t
    x = np.stack([inputs[n] for n in m.chain.INPUTS])
    return np.stack([
        m.chain.accelerometer(j, t, np.cos(phi), np.sin(phi), x, m.chain.values_of(j, p)) for j in range(4)
    ])  # fmt: skip


@cache
def under(identifier: str) -> Model:
    """The model with effects of all stages under two ids."""
    made = [e for e in catalogue() if e.id in CHOSEN]
    return model(*(Effect(**{**vars(e), "id": f"{identifier}{'-a' * n}"}) for n, e in enumerate(made)))


@pytest.mark.parametrize("identifier", ["d2", "f-disc", "sensed"])
def test_every_stage_under_ids_that_the_derivation_uses_itself(identifier: str) -> None:
    """Effects of all stages under two ids at once: what they do depends on the ids in no way."""
    one, other = under(identifier), under("zz")
    inputs, p, t = drawn(other)
    assert one.chain.INPUTS == other.chain.INPUTS
    np.testing.assert_allclose(evaluated(one, inputs, p, t), evaluated(other, inputs, p, t), rtol=1e-12)


@pytest.mark.parametrize("text", ["sign(K*f_i)", "K*f_i + sign(K)"])
def test_a_step_at_the_neutral_value_of_a_parameter_is_refused(text: str) -> None:
    with pytest.raises(ExpressionError, match="no finite slope"):
        from_expression("mine", "transducer", text, {"K": {"unit": "ug"}})
