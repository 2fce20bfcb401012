"""Users may call parameters, channels and effects what they like: generated names are another name space."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from derive.effect import Effect
from derive.effects import catalogue
from derive.expression import _TAKEN, ExpressionError, from_expression
from derive.pipeline import derive_model
from ragg_runtime.model.model import Model, from_files
from ragg_runtime.model.native.compiler import BuildError, find_compiler

Array = NDArray[np.float64]
# Of C, of NumPy and SymPy, of the templates, the tape and the emitters.
WORDS = (
    *("double", "int", "static", "main", "errno", "fma", "floor", "size_t", "BLOCK", "ROWS", "FMA", "NULL"),
    *("np", "list", "print", "self", "S", "I", "E", "Q", "N", "C", "D", "V", "x0", "x12345"),
    *("at", "cosine", "sine", "rows", "in_a_x", "out_V", "bar_V", "rate_x", "cos_psi", "cos_j", "spin_angle"),
    *(
        "i",
        "n",
        "p",
        "t",
        "q",
        "j",
        "K1",
        "radius",
        "delta_phi",
        "i_mine",
        "inputs",
        "parameters",
        "values_of",
    ),
)
WORDS = tuple(w for w in WORDS if w not in _TAKEN)
SAMPLES = 7
# One or more of every stage.
CHOSEN = ("arm-sag", "time-offset", "thermal-bias", "second-order-misalignment", "spin-phase-offset")
BASE = 2 + 4 * 15


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


def added(m: Model, inputs: dict[str, Array], p: Array, t: Array) -> Array:
    """What the effects add to I_j/K_j1, (4, N): V_j less that of the paper's model, over k_VI K1."""
    plain = model()
    sizes = dict(m.chain.PARAMETERS)
    k = dict(zip(sizes, np.cumsum([0, *sizes.values()]), strict=False))
    scale = p[k["k_VI"] : k["k_VI"] + 4] * p[k["K1"] : k["K1"] + 4]
    return (evaluated(m, inputs, p, t) - evaluated(plain, *drawn(plain))) / scale[:, None]


def groups(size: int = 12) -> list[tuple[str, ...]]:
    return [WORDS[k : k + size] for k in range(0, len(WORDS), size)]


def test_words_as_channels() -> None:
    """The sum of many channels, each with a factor of its own, is what the effects add, whatever they are called."""
    effects, factors = [], {w: round(1.0 + 0.01 * n, 2) for n, w in enumerate(WORDS)}
    for n, group in enumerate(groups()):
        text = " + ".join(f"{factors[w]}*{w}" for w in group)
        effects.append(
            from_expression(f"mine-{n}", "transducer", f"K_own*({text})", {"K_own": {"unit": "ug"}})
        )
    m = model(*effects)
    inputs, p, t = drawn(m)
    assert {*WORDS} <= {*m.chain.INPUTS} and len({*m.chain.INPUTS}) == len(m.chain.INPUTS)
    expected = np.zeros((4, SAMPLES))
    for n, group in enumerate(groups()):
        own = p[BASE + 4 * n : BASE + 4 * n + 4, None]
        expected += own * sum(factors[w] * inputs[w] for w in group)
    np.testing.assert_allclose(added(m, inputs, p, t), expected, rtol=1e-9)


def test_words_as_parameters_and_as_ids() -> None:
    effects = []
    for n, w in enumerate(WORDS):
        identifier = w.lower().replace("_", "-")
        identifier = f"{identifier}-{n}" if identifier in {e.id for e in effects} else identifier
        own = {w: {"unit": "ug", "shared": True}}
        effects.append(from_expression(identifier.replace("--", "-"), "transducer", f"{w}*ch{n}", own))
    m = model(*effects)
    inputs, p, t = drawn(m)
    expected = sum(p[BASE + n] * inputs[f"ch{n}"] for n in range(len(WORDS)))
    np.testing.assert_allclose(added(m, inputs, p, t), np.broadcast_to(expected, (4, SAMPLES)), rtol=1e-9)


@cache
def under(identifier: str) -> Model:
    """The model with effects of all stages under two ids."""
    made = [e for e in catalogue() if e.id in CHOSEN]
    return model(*(Effect(**{**vars(e), "id": f"{identifier}{'-a' * n}"}) for n, e in enumerate(made)))


@pytest.mark.parametrize("identifier", ["f", "d2", "f-disc", "rate", "bar", "in", "sensed"])
def test_every_stage_under_ids_that_the_derivation_uses_itself(identifier: str) -> None:
    """Effects of all stages under two ids at once: what they do depends on the ids in no way."""
    one, other = under(identifier), under("zz")
    inputs, p, t = drawn(other)
    assert one.chain.INPUTS == other.chain.INPUTS
    np.testing.assert_allclose(evaluated(one, inputs, p, t), evaluated(other, inputs, p, t), rtol=1e-12)


def test_machine_code_of_such_names() -> None:
    try:
        find_compiler()
    except BuildError:
        pytest.skip("no C compiler")
    m = model(
        *(
            from_expression(f"mine-{n}", "transducer", f"K_own*({' + '.join(g)})", {"K_own": {"unit": "ug"}})
            for n, g in enumerate(groups())
        )
    )
    inputs, p, t = drawn(m)
    made = m.compiled("c").voltages(t, [inputs[n] for n in m.chain.INPUTS], p)
    np.testing.assert_allclose(made, evaluated(m, inputs, p, t), rtol=1e-9)


@pytest.mark.parametrize(
    "step", ["sign(f_i)", "abs(sign(f_p))", "sign(abs(f_i) - f_o)", "abs(abs(f_i) - f_o)"]
)
@pytest.mark.parametrize("shape", ["K*f_i*{}", "K*({} + f_i)", "K*tanh({})", "f_i*tanh(K*{})"])
def test_a_step_has_no_slope(step: str, shape: str) -> None:
    """sign(...) in an effect: its derivatives are those between the steps."""
    effect = from_expression("mine", "transducer", shape.format(step), {"K": {"unit": "ug"}})
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
