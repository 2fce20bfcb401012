"""Users may call parameters, channels and effects what they like: generated names are another name space."""

from __future__ import annotations

import builtins
import keyword
import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import sympy
from numpy.typing import NDArray

import derive
import generated
from derive.chain import accelerometer
from derive.effect import Effect
from derive.effects import catalogue
from derive.expression import _TAKEN, ExpressionError, from_expression
from derive.pipeline import derive_model
from derive.symbols import AUXILIARY, RATES
from ragg_runtime.model.model import Model, from_files
from ragg_runtime.model.native.compiler import BuildError, find_compiler

Array = NDArray[np.float64]
WORDS_OF_C = (
    *("auto", "break", "case", "char", "const", "default", "do", "double", "enum", "extern", "float", "goto"),
    *(
        "inline",
        "int",
        "long",
        "register",
        "restrict",
        "short",
        "signed",
        "sizeof",
        "static",
        "struct",
        "switch",
    ),
    *(
        "typedef",
        "union",
        "unsigned",
        "void",
        "volatile",
        "main",
        "NULL",
        "errno",
        "printf",
        "fma",
        "floor",
        "log",
    ),
)
SAMPLES = 7
# One or more of every stage.
CHOSEN = ("arm-sag", "time-offset", "thermal-bias", "second-order-misalignment", "spin-phase-offset")


@cache
def names() -> tuple[str, ...]:
    """Every name that generated code, its templates or the derivation use, and words of Python, C, NumPy, SymPy."""
    texts = [p.read_text("utf-8") for p in sorted(Path(generated.__file__).parent.rglob("*.[pch]*"))
             if "__pycache__" not in p.parts and p.suffix in (".py", ".c", ".h")]  # fmt: skip
    texts += [
        p.read_text("utf-8") for p in sorted(Path(derive.__file__).parent.glob("emit/templates/*.[pcf]*"))
    ]
    own = from_expression("mine", "transducer", "K*f_i*foo", {"K": {"unit": "ug"}})
    few = [
        e for e in catalogue() if e.id in CHOSEN
    ]  # of every stage: what stands in front is the same for all
    texts += derive_model((*few, own), (*catalogue(), own)).values()
    found = {w for text in texts for w in re.findall(r"[A-Za-z]\w*", text)}
    hooked = [e for e in catalogue() if e.kind != "output"]
    found |= {s.name for s, _ in accelerometer(hooked, candidates=hooked).tape.assignments}
    tape = {s.name for s, _ in accelerometer(few).tape.assignments}
    found |= {f"{prefix}{w}" for w in tape for prefix in ("", "rate_", "bar_", "in_")} | {*RATES}
    found |= {*WORDS_OF_C, *dir(builtins), *(n for n in dir(sympy) if len(n) < 3)}
    found |= {"C__a_x", "x0", "x12345", "C", "V", "bar_V", "out_V", "spin_angle"}
    good = re.compile(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*")
    kept = sorted(w for w in found if good.fullmatch(w) and len(w) <= 64 and not keyword.iskeyword(w))
    return tuple(w for w in kept if not re.fullmatch(r"x\d{2,4}", w))  # numbered ones: x0 ... x9, x12345


def batches(every: Sequence[str], size: int) -> list[Sequence[str]]:
    return [every[k : k + size] for k in range(0, len(every), size)]


def model(*effects: Effect) -> Model:
    return from_files(derive_model(effects, ()))


def drawn(m: Model, seed: int = 3) -> tuple[dict[str, Array], Array, Array]:
    """Inputs of a model by name, parameters by place, and the time."""
    chance = np.random.default_rng(seed)
    base = np.random.default_rng(seed + 1).uniform(0.5, 1.5, (400, SAMPLES))
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


BASE = 2 + 4 * 15
PLAIN: dict[str, Array] = {}


def added(m: Model, inputs: dict[str, Array], p: Array, t: Array) -> Array:
    """What the effects add to I_j/K_j1, (4, N): V_j less that of the paper's model, over k_VI K1."""
    if not PLAIN:
        plain = model()
        PLAIN["V"] = evaluated(plain, *drawn(plain))
    sizes = dict(m.chain.PARAMETERS)
    start = np.cumsum([0, *sizes.values()])
    k = dict(zip(sizes, start, strict=False))
    scale = p[k["k_VI"] : k["k_VI"] + 4] * p[k["K1"] : k["K1"] + 4]
    return (evaluated(m, inputs, p, t) - PLAIN["V"]) / scale[:, None]


def free(word: str) -> bool:
    return word not in _TAKEN


def test_there_are_many_of_them() -> None:
    assert len(names()) > 1000
    assert {"delta_phi", "i_mine", "cos_psi", "bar_V", "x0", "D", "q", "np", "double", "K1", "radius"} <= {
        *names()
    }
    assert {c for e in catalogue() if e.kind != "output" for c in e.channels} <= {*AUXILIARY}


def test_every_name_as_a_channel() -> None:
    """The sum of many channels, each with a factor of its own, is what the effect adds, whatever they are called."""
    words = [w for w in names() if free(w) and w != "K"]
    for group in batches(words, 400):
        factors = [round(1.0 + 0.01 * n, 2) for n in range(len(group))]
        parts = [" + ".join(f"{c}*{w}" for c, w in zip(factors, group, strict=True))]
        effects = []
        for n, text in enumerate(split(parts[0], 430)):
            effects.append(from_expression(f"mine-{n}", "transducer", f"K*({text})", {"K": {"unit": "ug"}}))
        m = model(*effects)
        inputs, p, t = drawn(m)
        assert {*group} <= {*m.chain.INPUTS} and len({*m.chain.INPUTS}) == len(m.chain.INPUTS)
        expected = np.zeros((4, SAMPLES))
        start = BASE
        for e in effects:
            terms = [x.strip().split("*") for x in e.equation.split("(", 1)[1].rstrip(")").split("+")]
            total = sum(float(c) * inputs[w.strip()] for c, w in terms)
            expected += p[start : start + 4, None] * total
            start += 4
        np.testing.assert_allclose(added(m, inputs, p, t), expected, rtol=1e-9)


def split(text: str, longest: int) -> list[str]:
    """A sum in pieces that are short enough for one expression."""
    pieces: list[str] = []
    for term in text.split(" + "):
        if pieces and len(pieces[-1]) + len(term) + 3 <= longest and pieces[-1].count("+") < 25:
            pieces[-1] += f" + {term}"
        else:
            pieces.append(term)
    return pieces


def test_every_name_as_a_parameter() -> None:
    words = [w for w in names() if free(w)]
    for group in batches(words, 400):
        text = " + ".join(f"{w}*ch{n}" for n, w in enumerate(group))
        pieces = split(text, 430)
        effects = []
        for n, piece in enumerate(pieces):
            own = [term.split("*")[0] for term in piece.split(" + ")]
            parameters = {w: {"unit": "ug", "shared": True} for w in own}
            effects.append(from_expression(f"mine-{n}", "transducer", piece, parameters))
        m = model(*effects)
        inputs, p, t = drawn(m)
        expected = sum(p[BASE + n] * inputs[f"ch{n}"] for n in range(len(group)))
        np.testing.assert_allclose(added(m, inputs, p, t), np.broadcast_to(expected, (4, SAMPLES)), rtol=1e-9)


def test_every_name_as_an_id() -> None:
    """And every ending of one: the derivation makes names of ids by putting something in front."""
    ends = {"-".join(w.lower().split("_")[k:]) for w in names() for k in range(w.count("_") + 1)}
    ids = sorted(i for i in ends if re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", i))
    for group in batches(ids, 400):
        effects = [
            from_expression(i, "transducer", "K*ch", {"K": {"unit": "ug", "shared": True}}) for i in group
        ]
        m = model(*effects)
        inputs, p, t = drawn(m)
        expected = inputs["ch"] * np.sum(p[BASE : BASE + len(group)])
        np.testing.assert_allclose(added(m, inputs, p, t), np.broadcast_to(expected, (4, SAMPLES)), rtol=1e-9)


@cache
def under(identifier: str) -> Model:
    """The model with effects of all stages under two ids."""
    made = [e for e in catalogue() if e.id in CHOSEN]
    return model(*(Effect(**{**vars(e), "id": f"{identifier}{'-a' * n}"}) for n, e in enumerate(made)))


@pytest.mark.parametrize(
    "identifier", ["f", "q", "b", "d", "d2", "disc", "f-disc", "q-i", "rate", "bar", "in", "m", "sensed"]
)
def test_every_stage_under_ids_that_the_derivation_uses_itself(identifier: str) -> None:
    """Effects of all stages under two ids at once: what they do depends on the ids in no way."""

    one, other = under(identifier), under("zz")
    inputs, p, t = drawn(other)
    assert one.chain.INPUTS == other.chain.INPUTS
    np.testing.assert_allclose(evaluated(one, inputs, p, t), evaluated(other, inputs, p, t), rtol=1e-12)
    for j in range(2):
        x, phi = np.stack([*inputs.values()]), 2 * np.pi * p[1] * t
        D = [
            m.chain.derivatives(j, t, np.cos(phi), np.sin(phi), x, m.chain.values_of(j, p))
            for m in (one, other)
        ]
        np.testing.assert_allclose(D[0], D[1], rtol=1e-9, atol=1e-12)


def test_machine_code_of_such_names() -> None:
    try:
        find_compiler()
    except BuildError:
        pytest.skip("no C compiler")
    words = ["double", "at", "cosine", "sine", "rows", "in_a_x", "out_V", "bar_V", "x0", "i", "n", "p", "t", "ROWS",
             "BLOCK", "FMA", "fma", "main", "size_t", "K1", "radius", "cos_j", "V", "i_mine", "delta_phi"]  # fmt: skip
    text = " + ".join(words)
    m = model(from_expression("mine", "transducer", f"K*({text})", {"K": {"unit": "ug"}}))
    inputs, p, t = drawn(m)
    made = m.compiled("c").voltages(t, [inputs[n] for n in m.chain.INPUTS], p)
    np.testing.assert_allclose(made, evaluated(m, inputs, p, t), rtol=1e-9)


def test_a_parameter_without_which_nothing_moves_has_no_rate() -> None:
    """A parameter of an effect whose id begins with d- is a constant, not a derivative of a channel."""
    m = model(Effect(**{**vars(next(e for e in catalogue() if e.id == "time-offset")), "id": "d-late"}))
    assert {*m.chain.INPUTS} - {*model().chain.INPUTS} <= {*RATES}


SHAPES = (
    "K*{}",
    "K*f_i*{}",
    "K*abs(f_o)*{}",
    "K*({} + f_i)",
    "K*{}**3",
    "K*tanh({})",
    "f_i*tanh(K*{})",
    "K*{}*temperature",
)
STEPS = (
    "sign(f_i)",
    "sign(f_i*f_o)",
    "abs(sign(f_p))",
    "sign(abs(f_i) - f_o)",
    "sign(sin(f_i))",
    "abs(abs(f_i) - f_o)",
)


@pytest.mark.parametrize("step", STEPS)
def test_a_step_has_no_slope(step: str) -> None:
    """sign(...) in an effect: its derivatives are those between the steps."""
    for n, shape in enumerate(SHAPES):
        effect = from_expression("mine", "transducer", shape.format(step), {"K": {"unit": "ug"}})
        m = from_files(derive_model((effect,), (effect,)))
        inputs, p, t = drawn(m, seed=n)
        x, phi = np.stack([*inputs.values()]), 2 * np.pi * p[1] * t
        values = [m.chain.values_of(1, p) for _ in range(2)]
        rows = [name for name, _ in m.chain.ROWS]
        D = m.chain.derivatives(1, t, np.cos(phi), np.sin(phi), x, values[0])
        for name in ("vartheta_z", "mine.K"):
            k = [n for n, _ in m.chain.PARAMETERS].index(name.replace(".", "__"))
            V = []
            for h in (1e-6, -1e-6):
                q = values[0].copy()
                q[k] += h
                V.append(m.chain.accelerometer(1, t, np.cos(phi), np.sin(phi), x, q))
            np.testing.assert_allclose(D[rows.index(name)], (V[0] - V[1]) / 2e-6, rtol=1e-4, atol=1e-4)


@pytest.mark.parametrize("text", ["sign(K*f_i)", "K*f_i + sign(K)"])
def test_a_step_at_the_neutral_value_of_a_parameter_is_refused(text: str) -> None:
    with pytest.raises(ExpressionError, match="no finite slope"):
        from_expression("mine", "transducer", text, {"K": {"unit": "ug"}})
