"""Effects in one line come from strangers: nothing but the formula is evaluated or written, whatever the names."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from numpy.typing import NDArray

from derive.chain import accelerometer
from derive.effect import STAGES, Effect
from derive.effects import catalogue
from derive.expression import ExpressionError, from_expression
from derive.pipeline import derive_model
from derive.tape import partials
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
        ("K*f_i**9", "whole number from 1 to 8"),
        ("K*((f_i**8)**8)**8", "degree"),
        ("K*(1e29**8)**3", "out of range"),
        ("K*" + "*".join(["1e29"] * 40), "out of range"),
        ("K*1e400", "out of range"),
        ("K*1e-400*f_i + K*1e-300", "out of range"),
        ("K*f_i/0", "division by zero"),
        ("K*f_i/(f_o-f_o)", "division by zero"),
        ("K*exp(exp(exp(99)))", "exp of a number"),
        ("K*sin(1e29)", "sin of a number"),
        ("K*sin(f_i, 1)", "one argument"),
        ("K*sin(*f_i)", "one argument"),
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
        ("K*f_i if 1 else 2", "not allowed"),
        ("K @ f_i", "not allowed"),
        ("K*f_i + 1", "does not vanish"),
        ("K/K*f_i", "does not vanish"),
        *((text, "no finite slope") for text in ("sqrt(K)*f_i", "sign(K*f_i)", "K*f_i + sign(K)")),
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
        ("mine", {"K-x": {"unit": "ug"}}),
        ("mine", {}),
        ("mine", {"f_i": {"unit": "ug"}}),
        ("mine", {"__K": {"unit": "ug"}}),
        ("mine", {"a_x": {"unit": "ug"}}),
        ("mine", {"sin": {"unit": "ug"}}),
        ("mine", {"K": {"unit": "ug", "plausible": "1"}}),
        ("mine", {"K": {"unit": "ug", "plausible": float("nan")}}),
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


def under(ids: Sequence[str]) -> Model:
    """The model with effects of all stages under other ids."""
    effects = [e for e in catalogue() if e.id in CHOSEN]
    return model(*(Effect(**{**vars(e), "id": i}) for i, e in zip(ids, effects, strict=True)))


def test_every_stage_under_ids_that_the_derivation_uses_itself() -> None:
    """What effects do depends on their ids in no way."""
    one, other = under(["d2", "f-disc", "sensed", "d2-a", "sensed-a"]), under(["z1", "z2", "z3", "z4", "z5"])
    inputs, p, t = drawn(other)
    assert one.chain.INPUTS == other.chain.INPUTS
    np.testing.assert_allclose(evaluated(one, inputs, p, t), evaluated(other, inputs, p, t), rtol=1e-12)


def list_constructs(e: Effect) -> set[str]:
    """Functions and powers in the chain of an effect, and the stages that it changes."""
    values = [value for _, value in accelerometer((e,)).tape.assignments]
    names = {type(x).__name__ for v in values for x in v.atoms(sp.Function)}
    names |= {str(x.exp) for v in values for x in v.atoms(sp.Pow)}
    return names | {stage for stage in STAGES if getattr(e, stage) is not None}


def test_effects_in_c_are_those_in_numpy() -> None:
    """All effects that hold something which those before do not."""
    chosen: list[Effect] = []
    seen: set[str] = set()
    for e in catalogue():
        if e.kind in ("deterministic", "step") and not list_constructs(e) <= seen:
            chosen.append(e)
            seen |= list_constructs(e)
    m = model(*chosen)
    assert m.chain.library is not None
    inputs, p, t = drawn(m)
    series, phi = [inputs[n] for n in m.chain.INPUTS], 2 * np.pi * p[1] * t
    both = m.chain, replace(m.chain, sources={})
    V, expected = (c.voltages(t, series, p, phi) for c in both)
    np.testing.assert_allclose(V, expected, rtol=1e-11)
    for j in range(4):
        D, true = (c.derivatives(j, t, series, p, phi) for c in both)
        assert np.all(np.abs(D - true) <= 1e-10 * np.max(np.abs(true), axis=1, keepdims=True))


X, Y, Z = sp.symbols("x y z", real=True)


@pytest.mark.parametrize(
    "e",
    [
        3 * X * Y**2 - Z / 7,
        X**Y + sp.exp(X * Z),
        sp.sin(X * Y) * sp.cos(Z) + Y * sp.Abs(Y),
        sp.pi * X * sp.Heaviside(Y, 1),
        X / sp.sin(sp.sign(X / Y)),
        sp.sin(sp.Abs(sp.sqrt(X)) * Y),
        Z * sp.exp(sp.sign(sp.sqrt(X) - Y)),
        sp.tanh(sp.Abs(X / Y) * Z),
    ],
    ids=str,
)
def test_no_derivative_is_left_open(e: sp.Expr) -> None:
    """Of functions of signs and moduli whose argument SymPy does not know to be real; against differences."""
    at, h = {X: 0.7, Y: 1.3, Z: -0.4}, 1e-6
    slopes = partials(e)
    for s in at:
        ends = [e.subs(at | {s: at[s] + d}).evalf() for d in (h, -h)]
        slope = slopes.get(s, sp.Integer(0)).subs(at).evalf()
        assert float(slope) == pytest.approx(float(ends[0] - ends[1]) / (2 * h), abs=1e-6)
