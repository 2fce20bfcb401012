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


@pytest.mark.parametrize(
    "text",
    [
        "K*f_i*sign(f_i)",
        "K*(abs(sign(f_p)) + f_i)",
        "K*tanh(sign(abs(f_i) - f_o))",
        "f_i*tanh(K*abs(abs(f_i) - f_o))",
    ],
)
def test_a_step_has_no_slope(text: str) -> None:
    """sign(...) in an effect: its derivatives are those between the steps."""
    effect = from_expression("mine", "transducer", text, {"K": {"unit": "ug"}})
    m = from_files(derive_model((effect,), (effect,)))
    inputs, p, t = drawn(m)
    x, phi = np.stack([*inputs.values()]), 2 * np.pi * p[1] * t
    values = m.chain.values_of(1, p)
    rows = [name for name, _ in m.chain.ROWS]
    D = m.chain.derivatives(1, t, np.cos(phi), np.sin(phi), x, values)
    for name in ("vartheta_z", "mine.K"):
        k = [n for n, _ in m.chain.PARAMETERS].index(name.replace(".", "__"))
        V = []
        for h in (1e-6, -1e-6):
            q = values.copy()
            q[k] += h
            V.append(m.chain.accelerometer(1, t, np.cos(phi), np.sin(phi), x, q))
        np.testing.assert_allclose(D[rows.index(name)], (V[0] - V[1]) / 2e-6, rtol=1e-4, atol=1e-4)


@pytest.mark.parametrize("text", ["sign(K*f_i)", "K*f_i + sign(K)"])
def test_a_step_at_the_neutral_value_of_a_parameter_is_refused(text: str) -> None:
    with pytest.raises(ExpressionError, match="no finite slope"):
        from_expression("mine", "transducer", text, {"K": {"unit": "ug"}})
