"""The gates: committed bytes against the derivation, the physics at 50 digits against the instrument, C clean and equal to NumPy."""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from itertools import product
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import sympy as sp

import generated
from derive import pipeline
from derive.chain import accelerometer
from derive.effect import STAGES, Effect
from derive.effects import catalogue
from derive.pipeline import derive_model
from derive.propagation import Collected
from derive.simplify import simplified as simplified_model
from derive.stages import PAPER
from generated import analytical, chain, folded, signatures, simplified
from ragg_runtime.cli.main import main
from ragg_runtime.instrument.units import units
from tests.generated import compiled, draws
from tests.generated import fifty_digits as fifty
from tests.generated.draws import Array

COMMITTED = Path(str(generated.__file__)).parent
ROOT = COMMITTED.parent


def copy_of_generated(folder: Path) -> Path:
    shutil.copytree(COMMITTED, folder / "generated", ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def test_check_shows_the_difference_and_the_command_that_mends_it(tmp_path, monkeypatch, capsys) -> None:
    committed = {
        n: (COMMITTED / n).read_text() for n in json.loads((COMMITTED / "manifest.json").read_text())["files"]
    }
    monkeypatch.setattr(pipeline, "derive_base", lambda: committed)  # which the test below holds to it
    root = copy_of_generated(tmp_path)
    changed = root / "generated" / "simplified.py"
    changed.write_text(changed.read_text().replace("D1234(K0*k1)", "D1234(-K0*k1)"))
    (root / "generated" / "c" / "chain.h").unlink()
    (root / "generated" / "by_hand.py").write_text("x = 1\n")

    with pytest.raises(SystemExit) as end:
        main(["derive", "--check", "--out", str(root)])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert "Traceback" not in said
    assert "missing: c/chain.h" in said
    assert "not derived: by_hand.py" in said
    lines = [line.strip() for line in said.splitlines()]
    assert any(line.startswith("-") and "D1234(-K0*k1)" in line for line in lines)
    assert any(line.startswith("+") and "D1234(K0*k1)" in line for line in lines)
    assert "make derive" in said

    main(["derive", "--out", str(root)])
    mended = capsys.readouterr().out
    assert {"simplified.py", "chain.h", "by_hand.py"} <= {Path(n).name for n in mended.split()}
    assert not pipeline.diff_files(committed, root / "generated")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [("a\nb\n", "a\nb", "final newline"), ("a\nb\n", "a\r\nb\r\n", ""), ("a\nb\n", "a\nc\n", "-c")],
)
def test_every_byte_counts(tmp_path: Path, old: str, new: str, message: str) -> None:
    (tmp_path / "x.py").write_bytes(new.encode())
    found = pipeline.diff_files({"x.py": old}, tmp_path)
    assert found
    assert message in found
    pipeline.write({"x.py": old}, tmp_path)
    assert not pipeline.diff_files({"x.py": old}, tmp_path)


def test_committed_files_are_what_the_derivation_yields_under_any_hash_seed() -> None:
    """SymPy keeps arguments in sets; nothing of their order may reach a file. ``make check`` has a seed at random."""
    command = [sys.executable, "-m", "ragg_runtime", "derive", "--check"]
    environment = os.environ | {"PYTHONHASHSEED": "31337"}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_generated_code_is_the_instrument_at_50_digits() -> None:
    """The committed NumPy and C, analytical model and chain, at parameters of order one: every term counts."""
    library = compiled.committed()
    for seed in range(3):
        draw = np.random.default_rng(100 + seed)
        p = np.concatenate([[0.7, 0.25], draw.uniform(-1, 1, 60)])
        inputs, t = draw.uniform(-1, 1, (15, 7)), draw.uniform(0, 4, 7)
        angle = analytical.disc_angle(t, 0.25)
        q = fifty.exact(p)
        V = np.array(
            [
                [float(v) for v in fifty.voltages(s, fifty.exact(inputs[:, n]), q)]
                for n, s in enumerate(fifty.exact(t))
            ]
        ).T
        G = V[0] + V[1] - V[2] - V[3]
        size = 1e-13 * np.max(np.abs(V))
        found = {
            "analytical.py": analytical.output(t, inputs, p),
            "analytical.c": library["analytical"].output(t, inputs, p),
            "folded.py": folded.output(t, inputs, p),
            "folded.c": library["folded"].output(t, inputs, p),
            "chain.py": chain.output(t, np.cos(angle), np.sin(angle), inputs, p),
            "chain.c": library["chain"].output(t, inputs, p),
        }
        for name, output in found.items():
            np.testing.assert_allclose(output, G, rtol=0, atol=10 * size, err_msg=name)
        np.testing.assert_allclose(library["chain"].voltages(t, inputs, p), V, rtol=0, atol=size)
        voltages = chain.voltages(t, np.cos(angle), np.sin(angle), inputs, p)
        np.testing.assert_allclose(voltages, V, rtol=0, atol=size)


MANIFEST = json.loads((COMMITTED / "manifest.json").read_text())
MODULES = {m.__name__.split(".")[-1]: m for m in (analytical, simplified, folded, chain, signatures)}


def test_manifest_lists_every_file_and_model() -> None:
    present = {
        p.relative_to(COMMITTED).as_posix()
        for p in COMMITTED.rglob("*")
        if p.is_file() and "__pycache__" not in p.parts
    }
    assert set(MANIFEST["files"]) == present
    assert set(MANIFEST["models"]) == set(MODULES) == set(generated.__all__)
    assert MANIFEST["format"] == 1
    assert MANIFEST["sympy"].split(".")[0] == sp.__version__.split(".")[0]
    assert len(MANIFEST["digest"]) == 64
    assert MANIFEST["effects"] == []
    assert [e["id"] for e in MANIFEST["catalogue"]] == [e.id for e in catalogue()]












USE = Path(__file__).with_name("use.c")
MODELS = ("analytical", "chain", "folded", "signatures", "simplified")
SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-g", "-O0")
"""Optimised, what they instrument is compiled ten times as long; warnings that need it are given of the libraries."""
FIRST_INSTANT = 1e5


def have(compiler: str) -> str:
    if compiler != "gcc" and shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is not installed")
    return compiler


@pytest.fixture(scope="module")
def library() -> dict[str, compiled.Library]:
    return compiled.committed()


@pytest.mark.parametrize(("compiler", "sanitized"), [("clang", False), ("gcc", True)])
def test_program_of_a_user(compiler: str, sanitized: bool, tmp_path: Path) -> None:
    """A program in C that uses all models, every warning an error; its numbers agree with each other."""
    program = tmp_path / "use"
    sources = [str(USE), *(str(compiled.SOURCES / f"{n}.c") for n in MODELS)]
    options = SANITIZERS if sanitized else ("-O2",)
    compiled.compile_with(
        have(compiler),
        [*compiled.STRICT, *options, f"-I{compiled.SOURCES}", *sources, "-lm", "-o", str(program)],
    )
    done = subprocess.run([str(program)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    t, G, G_simplified, G_chain, by_K1, A_0, signature = np.loadtxt(done.stdout.splitlines()).T
    np.testing.assert_array_equal(t, FIRST_INSTANT + 0.3 * np.arange(16))
    size = np.max(np.abs(G))
    np.testing.assert_allclose(G_chain, G, rtol=0, atol=1e-11 * size)  # two forms of one model
    assert 0 < np.max(np.abs(G_simplified - G)) < 1e-5 * size  # the simplified one is near, not equal
    assert all(np.isfinite(x).all() and np.std(x) > 0 for x in (by_K1, A_0, signature))


@pytest.mark.parametrize("start", [0.0, 1e6])
def test_harmonic_models_equal_numpy(start: float, library: Mapping[str, compiled.Library]) -> None:
    draw = np.random.default_rng(20)
    t, inputs, p = start + draw.uniform(0, 100, 50), draws.motion(draw, 50), draws.instrument(draw)
    for module in (analytical, simplified):
        c = library[module.__name__.split(".")[-1]]
        A = module.amplitudes(inputs, p)
        sizes = np.max(np.abs(A), axis=1, keepdims=True)
        assert np.all(np.abs(c.amplitudes(inputs, p, len(A)) - A) <= 1e-13 * sizes)
        G = module.output(t, inputs, p)
        np.testing.assert_allclose(c.output(t, inputs, p), G, rtol=0, atol=1e-14 * np.max(np.abs(sizes)))
        J = module.jacobian(t, inputs, p)
        rows = np.max(np.abs(J), axis=1, keepdims=True)
        assert np.all(np.abs(c.jacobian(t, inputs, p) - J) <= 1e-12 * rows)


def same_chain(module: ModuleType, c: compiled.Library, t: Array, inputs: Array, p: Array) -> None:
    """Voltages, output and derivatives of a chain: C against NumPy, to a few roundings."""
    phi = analytical.disc_angle(t, float(p[1]))
    turning = np.cos(phi), np.sin(phi)
    V = module.voltages(t, *turning, inputs, p)
    assert np.all(np.isfinite(V))
    size = np.max(np.abs(V))
    np.testing.assert_allclose(c.voltages(t, inputs, p), V, rtol=0, atol=1e-14 * size)
    np.testing.assert_allclose(
        c.output(t, inputs, p), module.output(t, *turning, inputs, p), rtol=0, atol=4e-14 * size
    )
    for j in range(4):
        D = module.derivatives(j, t, *turning, inputs, module.values_of(j, p))
        found = c.derivatives(j, t, inputs, p, len(D))
        rows = np.max(np.abs(D), axis=1, keepdims=True)
        names = [
            n
            for (n, _), bad in zip(module.ROWS, np.any(np.abs(found - D) > 1e-10 * rows, axis=1), strict=True)
            if bad
        ]
        assert not names, names


def inputs_of(module: ModuleType, draw: np.random.Generator, n: int) -> Array:
    """Motion of Table VI, rates of it, and auxiliary channels of order one."""
    further = draw.uniform(-1, 1, (len(module.INPUTS) - 15, n))
    return np.vstack([draws.motion(draw, n), further])


def plausible(effects: tuple[Effect, ...], draw: np.random.Generator, half_way: float) -> Array:
    """Values of plausible size of the parameters that effects bring; a step begins half-way."""
    known = units(draws.G0)
    values: list[float] = []
    for e in effects:
        for q in e.parameters:
            si = float(known.to_si(1.0, q.unit, known.base_unit(q.unit)))
            for sign in draw.choice((-1.0, 1.0), 1 if q.shared else 4):
                values.append(
                    half_way
                    if not math.isfinite(q.neutral) or q.name == "t_step"
                    else sign * si * q.plausible
                )
    return np.array(values)


@pytest.mark.parametrize("start", [0.0, 1e6])
def test_folded_model_equals_numpy_and_the_other_forms(start, library) -> None:
    """Some four blocks and a part; of the time, and of an encoder's angle of many turns, either way."""
    draw = np.random.default_rng(23)
    n = 2000
    t, inputs, p = start + draw.uniform(0, 100, n), draws.motion(draw, n), draws.instrument(draw)
    c = library["folded"].output(t, inputs, p)
    size = np.max(np.abs(analytical.amplitudes(inputs, p)))
    np.testing.assert_allclose(c, folded.output(t, inputs, p), rtol=0, atol=1e-14 * size)
    np.testing.assert_allclose(c, analytical.output(t, inputs, p), rtol=0, atol=1e-14 * size)
    np.testing.assert_allclose(c, library["chain"].output(t, inputs, p), rtol=0, atol=1e-13 * size)
    angle = draw.uniform(-1, 1, n) * (10 + start)
    expected = folded.output(t, inputs, p, angle)
    np.testing.assert_allclose(analytical.output(t, inputs, p, angle), expected, rtol=0, atol=1e-14 * size)
    for name in ("folded", "chain"):
        found = library[name].output(t, inputs, p, angle)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-13 * size)


def test_a_sample_has_the_same_bits_wherever_it_stands(library: Mapping[str, compiled.Library]) -> None:
    """In a vector, in what a vector leaves over, alone; which is why any number of threads gives the same."""
    draw = np.random.default_rng(24)
    t, inputs, p = draw.uniform(0, 1e4, 1100), draws.motion(draw, 1100), draws.instrument(draw)
    for name in ("folded", "chain"):
        whole = library[name].output(t, inputs, p)
        for first, count in ((0, 1), (1, 7), (511, 2), (513, 515), (3, 1097)):
            part = slice(first, first + count)
            np.testing.assert_array_equal(library[name].output(t[part], inputs[:, part], p), whole[part])


@pytest.mark.parametrize("start", [0.0, 1e6])
def test_chain_and_signatures_equal_numpy(start: float, library: Mapping[str, compiled.Library]) -> None:
    draw = np.random.default_rng(21)
    t = start + np.sort(draw.uniform(0, 100, 40))
    for name, module in (("chain", chain), ("signatures", signatures)):
        p = np.concatenate([draws.instrument(draw), np.zeros(module.SIZE - 62)])
        same_chain(module, library[name], t, inputs_of(module, draw, len(t)), p)


def list_constructs(e: Effect) -> set[str]:
    """Functions and powers in the chain of an effect, and the stages that it changes."""
    values = [value for _, value in accelerometer((e,)).tape.assignments]
    found = {type(x).__name__ for v in values for x in v.atoms(sp.Function)}
    found |= {str(x.exp) for v in values for x in v.atoms(sp.Pow)}
    return found | {stage for stage in STAGES if getattr(e, stage) is not None}


def test_effects_equal_numpy(tmp_path: Path) -> None:
    """The chain extended by effects at a plausible size, some at a time: all that holds something which those before do not."""
    every: list[Effect] = []
    seen: set[str] = set()
    for e in catalogue():
        if e.kind in ("deterministic", "step") and not list_constructs(e) <= seen:
            every.append(e)
            seen |= list_constructs(e)
    effects = {f"part{k}": tuple(every[k::2]) for k in range(2)}
    texts = {i: derive_model(part, ()) for i, part in effects.items()}
    draw = np.random.default_rng(22)
    t = np.linspace(0.3, 100.0, 41)  # no multiples of a turn: every harmonic is seen
    for identifier, c in compiled.chains(tmp_path, texts).items():
        module = ModuleType(identifier)
        exec(compile(texts[identifier]["chain.py"], f"<{identifier}>", "exec"), module.__dict__)
        p = np.concatenate([draws.instrument(draw), plausible(effects[identifier], draw, 51.0)])
        assert len(p) == module.SIZE
        try:
            same_chain(module, c, t, inputs_of(module, draw, len(t)), p)
        except AssertionError as error:
            raise AssertionError(f"{identifier}: {error}") from None


SECONDS = (0.0, 1e6)


def cases(start: float, seed: int, count: int = 10) -> list[tuple[Array, Array, Array]]:
    """(t, inputs, p): instants of one turn of the disc from ``start``."""
    draw = np.random.default_rng(seed)
    return [
        (start + draw.uniform(0, 4, 6), draws.motion(draw, 6), draws.instrument(draw)) for _ in range(count)
    ]


def error_eotvos(found: Array, true: list[object], p: Array) -> float:
    """Largest difference from the 50-digit value, in Eo of gradient signal."""
    difference = [float(fifty.real(float(g)) - v) for g, v in zip(found, true, strict=True)]
    return float(np.max(np.abs(difference))) / draws.signal(p) / draws.EOTVOS


def true_output(t: Array, inputs: Array, p: Array, model: Collected | None) -> list[object]:
    """At 50 digits: the instrument itself, or a collected model."""
    q = fifty.exact(p)
    found = []
    for n, instant in enumerate(fifty.exact(t)):
        x = fifty.exact(inputs[:, n])
        if model is None:
            found.append(fifty.output(instant, x, q))
        else:
            found.append(fifty.of_model(model, instant, x, q))
    return found


@pytest.mark.parametrize("start", SECONDS)
def test_analytical_output_within_a_millionth_of_an_eotvos(start, library) -> None:
    outputs = {
        "analytical.py": analytical.output,
        "analytical.c": library["analytical"].output,
        "folded.py": folded.output,
        "folded.c": library["folded"].output,
    }
    worst = dict.fromkeys(outputs, 0.0)
    for t, inputs, p in cases(start, seed=1):
        true = true_output(t, inputs, p, None)
        for name, output in outputs.items():
            worst[name] = max(worst[name], error_eotvos(output(t, inputs, p), true, p))
    assert max(worst.values()) < 1e-6, worst
    assert max(worst["folded.py"], worst["folded.c"]) < 2e-7, worst  # the price of float64 channels is 1e-7


@pytest.mark.parametrize(
    ("processor", "most"), [(compiled.NATIVE, 1.2e-16), ((), 1.4e-16)], ids=["native", "any"]
)
def test_fast_sine_and_cosine_are_good_to_the_last_bit(processor: tuple[str, ...], most: float) -> None:
    """Read off the model itself: a force along x of an instrument whose A1 alone has a gain is -sin or cos.

    Any processor of a family may have to round products before it adds to them.
    """
    model = compiled.committed(processor, ("folded",))["folded"]
    draw, spin = np.random.default_rng(6), 0.2503
    t = np.concatenate([x + draw.uniform(0, 8, 60) for x in (-1e3, 1e6, 2e9)] + [np.arange(-4, 4, 0.5)])
    p = np.zeros(analytical.SIZE)
    at = {name: 2 + 4 * (n - 2) for n, (name, _) in enumerate(analytical.PARAMETERS)}
    p[1], p[at["K1"]], p[at["k_VI"]] = spin, 1.0, 1.0
    for axis, by_encoder in product((0, 1), (False, True)):
        inputs = np.zeros((15, len(t)))
        inputs[axis] = 1.0
        found = model.output(t, inputs, p, t if by_encoder else None)
        for instant, value in zip(t, found, strict=True):
            angle = fifty.real(float(instant))
            if not by_encoder:
                angle *= 2 * fifty.CONTEXT.pi * fifty.real(spin)
            true = (-fifty.CONTEXT.sin(angle), fifty.CONTEXT.cos(angle))[axis]
            assert abs(float(fifty.real(float(value)) - true)) < most


@pytest.mark.parametrize("start", SECONDS)
def test_simplified_output_within_a_millionth_of_an_eotvos(start, library) -> None:
    worst = {"numpy": 0.0, "c": 0.0}
    model = simplified_model()
    for t, inputs, p in cases(start, seed=2):
        true = true_output(t, inputs, p, model)
        for name, output in (("numpy", simplified.output), ("c", library["simplified"].output)):
            worst[name] = max(worst[name], error_eotvos(output(t, inputs, p), true, p))
    assert max(worst.values()) < 1e-6, worst


def test_jacobian_is_the_derivative_of_the_instrument(library: dict[str, compiled.Library]) -> None:
    """Against central differences at 50 digits, which are exact to 1e-30."""
    t, inputs, p = cases(1e6, seed=4, count=1)[0]
    q = fifty.exact(p)
    true = np.empty((len(p), len(t)))
    for n, instant in enumerate(fifty.exact(t)):
        x = fifty.exact(inputs[:, n])
        for k in range(len(p)):
            step = fifty.real(10) ** -18 * (abs(q[k]) if q[k] else 1)
            up, down = (fifty.output(instant, x, [*q[:k], q[k] + s, *q[k + 1 :]]) for s in (step, -step))
            true[k, n] = float((up - down) / (2 * step))
    scale = np.max(np.abs(true), axis=1, keepdims=True)
    names = [n for n, size in analytical.PARAMETERS for _ in range(size)]
    zero = [n for n, s in zip(names, scale[:, 0], strict=True) if s == 0]
    assert zero == ["vartheta_x"] * 4  # it turns about the input axis' normal: no first-order effect (Eq. 5a)
    scale[scale == 0] = 1.0
    for jacobian in (analytical.jacobian, library["analytical"].jacobian):
        wrong = np.max(np.abs(jacobian(t, inputs, p) - true) / scale, axis=1)
        assert np.max(wrong) < 1e-11, {n: w for n, w in zip(names, wrong, strict=True) if w >= 1e-11}
