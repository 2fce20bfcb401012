"""Effects in one line come from strangers: nothing but the formula is evaluated or written, whatever the names."""

from __future__ import annotations

import time
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from derive.effect import Effect
from derive.effects import catalogue
from derive.expression import ExpressionError, from_expression
from derive.pipeline import derive_model
from ragg_runtime.model.model import Model, load_files

K = {"K": {"unit": "ug"}}


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("", "not an expression"),
        ("K*" + "1" * 600, "longer than 500"),
        ("K*" + "(" * 240 + "f_i", "not an expression"),
        ("K*" + "-" * 400 + "f_i", "nested too deeply"),
        ("K*" + "+".join(["f_i"] * 80), "nested too deeply"),
        ("K*\0", "null bytes"),
        ("K*f_i\ud800", "not an expression"),
        ("K*\uff46_i", "ASCII"),  # Python would read a full-width f as f
        ("K*f_i # \u202e", "ASCII"),
        ("K*10**10**10", "whole number from 1 to 8"),
        ("K*f_i**9", "whole number from 1 to 8"),
        ("K*f_i**-1", "whole number from 1 to 8"),
        ("K*(((((9**8)**8)**8)**8)**8)**8", "degree"),
        ("K*((f_i**8)**8)**8", "degree"),
        ("K*(1e29**8)**3", "out of range"),
        ("K*" + "*".join(["1e29"] * 40), "out of range"),
        ("K*1e400", "out of range"),
        ("K*1e-400*f_i + K*1e-300", "out of range"),
        ("K*" + "9" * 490, "out of range"),
        ("K*0x" + "f" * 480, "out of range"),
        ("K*f_i/0", "division by zero"),
        ("K*f_i/(f_o-f_o)", "division by zero"),
        ("K*exp(exp(exp(99)))", "exp of a number"),
        ("K*sin(1e29)", "sin of a number"),
        ("K*sin(f_i, 1)", "one argument"),
        ("K*sin(*f_i)", "one argument"),
        ("K*sin(x=f_i)", "one argument"),
        ("K*f_i.real", "not allowed"),
        ("K*f_i[0]", "not allowed"),
        ("K*().__class__", "not allowed"),
        ("K*__import__('os').system('true')", "not allowed"),
        ("K*(lambda: 1)()", "not allowed"),
        ("K*[x for x in (1,)][0]", "not allowed"),
        ("K*(x := f_i)", "not allowed"),
        ("K*f'{f_i}'", "not allowed"),
        ("K*'a'", "not allowed"),
        ("K*1j", "not allowed"),
        ("K*True", "not allowed"),
        ("K*f_i if 1 else 2", "not allowed"),
        ("K @ f_i", "not allowed"),
        ("K*f_i + 1", "does not vanish"),
        ("K/K*f_i", "does not vanish"),
        ("sqrt(K)*f_i", "no finite slope"),
        ("f_i/(1 + 1/K)*K/K", "vanish|slope"),
        ("K*__class__", "cannot name a channel"),
        ("K*" + "a" * 100, "cannot name a channel"),
    ],
)
def test_what_is_no_formula_is_refused_at_once(text: str, why: str) -> None:
    began = time.process_time()
    with pytest.raises(ExpressionError, match=why):
        from_expression("mine", "transducer", text, K)
    assert time.process_time() - began < 5


@pytest.mark.parametrize(
    ("identifier", "parameters"),
    [
        ("../up", K),
        ("_mine", K),
        ("m" * 65, K),
        ("mine", {"K-x": {"unit": "ug"}}),
        ("a" + "/b", K),
        ("mine\n", K),
        ("mine", {}),
        ("mine", {"f_i": {"unit": "ug"}}),
        ("mine", {"__K": {"unit": "ug"}}),
        ("mine", {"a_x": {"unit": "ug"}}),
        ("mine", {"sin": {"unit": "ug"}}),
        ("mine", {"K": {"unit": "ug", "plausible": "1"}}),
        ("mine", {"K": {"unit": "ug", "plausible": float("nan")}}),
        ("mine", {"K": {"unit": "ug", "plausible": 0}}),
        ("mine", {"K": {"unit": "ug", "plausible": 10**400}}),
        ("mine", {"K": {"unit": "ug", "shared": "yes"}}),
        ("mine", {"K": {"unit": "ug"}, "x": {"unit": "ug"}}),
    ],
)
def test_ids_and_parameters(identifier: str, parameters: dict[str, dict[str, object]]) -> None:
    with pytest.raises(ExpressionError):
        from_expression(identifier, "transducer", "K*f_i", parameters)


def test_what_stands_beside_the_formula_reaches_no_generated_file() -> None:
    """Comments and line breaks are no part of the formula: they could end a comment in C or a docstring."""
    text = '(K* # */ int evil; """ import evil\n f_i)  # */ evil'
    written = derive_model((from_expression("mine", "transducer", text, K),), ())
    clean = derive_model((from_expression("mine", "transducer", "K * f_i", K),), ())
    assert dict(written) == dict(clean)
    assert not [name for name, t in written.items() if "evil" in t]


Array = NDArray[np.float64]
SAMPLES = 7
# One or more of every stage.
CHOSEN = ("arm-sag", "time-offset", "thermal-bias", "second-order-misalignment", "spin-phase-offset")


def model(*effects: Effect) -> Model:
    return load_files(derive_model(effects, ()))


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
    return m.chain.voltages(t, [inputs[n] for n in m.chain.INPUTS], p, 2 * np.pi * p[1] * t)


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
