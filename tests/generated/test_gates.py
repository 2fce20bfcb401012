"""The gates: committed bytes against the derivation, the physics at 50 digits against the instrument, C clean and equal to NumPy."""

from __future__ import annotations

import ctypes
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from itertools import product
from pathlib import Path

import numpy as np
import pytest

import generated
from derive import pipeline
from derive.propagation import Collected
from derive.simplify import simplified as simplified_model
from generated import analytical, chain, folded, signatures, simplified
from ragg_runtime.cli.main import main
from tests.generated import draws
from tests.generated import fifty_digits as fifty
from tests.generated.draws import Array

COMMITTED = Path(str(generated.__file__)).parent
ROOT = COMMITTED.parent
SOURCES = COMMITTED / "c"
NATIVE = ("-march=native",)
MODELS = ("analytical", "chain", "folded", "signatures", "simplified")
STRICT = ("-std=c17", "-Wall", "-Wextra", "-Wconversion", "-Werror", "-pedantic")


def compile_with(compiler: str, arguments: Sequence[str]) -> None:
    """Run a compiler; what it says is the error."""
    done = subprocess.run([compiler, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def at(x: Array) -> ctypes.c_void_p:
    assert x.flags.c_contiguous and x.dtype == np.float64
    return ctypes.c_void_p(x.ctypes.data)


class Library:
    """One generated model: the functions ragg_<name>_... of a shared library."""

    def __init__(self, file: Path, name: str) -> None:
        self._library, self._name = ctypes.CDLL(str(file)), name

    def _call(
        self,
        function: str,
        rows: int,
        t: Array,
        inputs: Array,
        p: Array,
        *first: int,
        angle: Array | None = None,
    ) -> Array:
        series, values = np.ascontiguousarray(inputs), np.full((rows, len(t)), np.nan)
        pointers = (ctypes.c_void_p * len(series))(*(row.ctypes.data for row in series))
        counts = map(ctypes.c_size_t, (*first, len(t)))
        further = None if angle is None else at(angle)
        call = getattr(self._library, f"ragg_{self._name}_{function}")
        call(*counts, at(np.ascontiguousarray(t)), pointers, at(p), further, at(values))
        return values

    def output(self, t: Array, inputs: Array, p: Array, angle: Array | None = None) -> Array:
        return self._call("output", 1, t, inputs, p, angle=angle)[0]

    def voltages(self, t: Array, inputs: Array, p: Array) -> Array:
        return self._call("voltages", 4, t, inputs, p)

    def jacobian(self, t: Array, inputs: Array, p: Array) -> Array:
        return self._call("jacobian", len(p), t, inputs, p)

    def derivatives(self, j: int, t: Array, inputs: Array, p: Array, rows: int) -> Array:
        return self._call("derivatives", rows, t, inputs, p, j)

    def amplitudes(self, inputs: Array, p: Array, count: int) -> Array:
        values = np.full((inputs.shape[1], count), np.nan)
        for row, column in zip(values, np.ascontiguousarray(inputs.T), strict=True):
            getattr(self._library, f"ragg_{self._name}_amplitudes")(at(column), at(p), at(row))
        return values.T


def build(
    folder: Path, processor: Sequence[str] = NATIVE, names: Sequence[str] = MODELS
) -> dict[str, Library]:
    """The packaged models, all or some, by name, compiled by gcc with every warning an error."""
    file = folder / "models.so"
    # vectors, and the scalar code for what they leave over
    options = [*STRICT, "-O3", *processor, "-ffp-contract=off", "-shared", "-fPIC"]
    compile_with("gcc", [*options, *(str(SOURCES / f"{n}.c") for n in names), "-lm", "-o", str(file)])
    return {n: Library(file, n) for n in names}


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Library]:
    return build(tmp_path_factory.mktemp("c"))


def test_check_shows_the_difference_and_the_command_that_mends_it(tmp_path, monkeypatch, capsys) -> None:
    committed = {
        n: (COMMITTED / n).read_text() for n in json.loads((COMMITTED / "manifest.json").read_text())["files"]
    }
    monkeypatch.setattr(pipeline, "derive_base", lambda: committed)  # which the test below holds to it
    root = tmp_path
    shutil.copytree(COMMITTED, root / "generated", ignore=shutil.ignore_patterns("__pycache__"))
    changed = root / "generated" / "simplified.py"
    changed.write_text(changed.read_text().replace("D1234(K0*k1)", "D1234(-K0*k1)"))
    (root / "generated" / "c" / "chain.h").unlink()
    (root / "generated" / "by_hand.py").write_text("x = 1\n")

    with pytest.raises(SystemExit) as end:
        main(["derive", "--check", "--out", str(root)])
    assert end.value.code == 2
    stderr = capsys.readouterr().err
    assert "Traceback" not in stderr
    assert "missing: c/chain.h" in stderr
    assert "not derived: by_hand.py" in stderr
    lines = [line.strip() for line in stderr.splitlines()]
    assert any(line.startswith("-") and "D1234(-K0*k1)" in line for line in lines)
    assert any(line.startswith("+") and "D1234(K0*k1)" in line for line in lines)
    assert "make derive" in stderr

    main(["derive", "--out", str(root)])
    mended = capsys.readouterr().out
    assert {"simplified.py", "chain.h", "by_hand.py"} <= {Path(n).name for n in mended.split()}
    assert not pipeline.diff_files(committed, root / "generated")


def test_committed_files_are_what_the_derivation_yields_under_any_hash_seed() -> None:
    """SymPy keeps arguments in sets; nothing of their order may reach a file. ``make check`` has a seed at random."""
    command = [sys.executable, "-m", "ragg_runtime", "derive", "--check"]
    environment = os.environ | {"PYTHONHASHSEED": "31337"}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_generated_code_is_the_instrument_at_50_digits(library: Mapping[str, Library]) -> None:
    """The committed NumPy and C, analytical model and chain, at parameters of order one: every term counts."""
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
        outputs = {
            "analytical.py": analytical.output(t, inputs, p),
            "analytical.c": library["analytical"].output(t, inputs, p),
            "folded.py": folded.output(t, inputs, p),
            "folded.c": library["folded"].output(t, inputs, p),
            "chain.py": chain.output(t, np.cos(angle), np.sin(angle), inputs, p),
            "chain.c": library["chain"].output(t, inputs, p),
        }
        for name, output in outputs.items():
            np.testing.assert_allclose(output, G, rtol=0, atol=10 * size, err_msg=name)
        np.testing.assert_allclose(library["chain"].voltages(t, inputs, p), V, rtol=0, atol=size)
        voltages = chain.voltages(t, np.cos(angle), np.sin(angle), inputs, p)
        np.testing.assert_allclose(voltages, V, rtol=0, atol=size)


MODULES = {m.__name__.split(".")[-1]: m for m in (analytical, simplified, folded, chain, signatures)}


def test_harmonic_models_equal_numpy(library: Mapping[str, Library]) -> None:
    draw = np.random.default_rng(20)
    t, inputs, p = 1e6 + draw.uniform(0, 100, 50), draws.motion(draw, 50), draws.instrument(draw)
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


@pytest.mark.parametrize("name", ["chain", "signatures"])
def test_chain_and_signatures_equal_numpy(name: str, library: Mapping[str, Library]) -> None:
    """Voltages, output and derivatives, to a few roundings."""
    draw, module, c = np.random.default_rng(21), MODULES[name], library[name]
    t = 1e6 + np.sort(draw.uniform(0, 100, 40))
    p = np.concatenate([draws.instrument(draw), np.zeros(module.SIZE - 62)])
    inputs = np.vstack([draws.motion(draw, 40), draw.uniform(-1, 1, (len(module.INPUTS) - 15, 40))])
    phi = analytical.disc_angle(t, float(p[1]))
    turning = np.cos(phi), np.sin(phi)
    V, G = (f(t, *turning, inputs, p) for f in (module.voltages, module.output))
    size = np.max(np.abs(V))
    np.testing.assert_allclose(c.voltages(t, inputs, p), V, rtol=0, atol=1e-14 * size)
    np.testing.assert_allclose(c.output(t, inputs, p), G, rtol=0, atol=4e-14 * size)
    for j in range(4):
        D = module.derivatives(j, t, *turning, inputs, module.values_of(j, p))
        derivatives = c.derivatives(j, t, inputs, p, len(D))
        bad = np.any(np.abs(derivatives - D) > 1e-10 * np.max(np.abs(D), axis=1, keepdims=True), axis=1)
        assert not bad.any(), [n for (n, _), b in zip(module.ROWS, bad, strict=True) if b]


def test_a_sample_has_the_same_bits_wherever_it_stands(library: Mapping[str, Library]) -> None:
    """In a vector, in what a vector leaves over, alone; which is why any number of threads gives the same."""
    draw = np.random.default_rng(24)
    t, inputs, p = draw.uniform(0, 1e4, 1100), draws.motion(draw, 1100), draws.instrument(draw)
    for name in ("folded", "chain"):
        whole = library[name].output(t, inputs, p)
        for first, count in ((0, 1), (1, 7), (511, 2), (513, 515), (3, 1097)):
            part = slice(first, first + count)
            np.testing.assert_array_equal(library[name].output(t[part], inputs[:, part], p), whole[part])


SECONDS = (0.0, 1e6)


def cases(start: float, seed: int, count: int = 10) -> list[tuple[Array, Array, Array]]:
    """(t, inputs, p): instants of one turn of the disc from ``start``."""
    draw = np.random.default_rng(seed)
    return [
        (start + draw.uniform(0, 4, 6), draws.motion(draw, 6), draws.instrument(draw)) for _ in range(count)
    ]


def error_eotvos(values: Array, true: list[object], p: Array) -> float:
    """Largest difference from the 50-digit value, in Eo of gradient signal."""
    difference = [float(fifty.real(float(g)) - v) for g, v in zip(values, true, strict=True)]
    return float(np.max(np.abs(difference))) / draws.signal(p) / draws.EOTVOS


def true_output(t: Array, inputs: Array, p: Array, model: Collected | None) -> list[object]:
    """At 50 digits: the instrument itself, or a collected model."""
    q = fifty.exact(p)
    values = []
    for n, instant in enumerate(fifty.exact(t)):
        x = fifty.exact(inputs[:, n])
        if model is None:
            values.append(fifty.output(instant, x, q))
        else:
            values.append(fifty.of_model(model, instant, x, q))
    return values


@pytest.mark.parametrize("start", SECONDS)
def test_outputs_within_a_millionth_of_an_eotvos(start, library) -> None:
    """The instrument, by the analytical model and its folded form; the simplified model, by its code."""
    worst, simple = dict[str, float](), simplified_model()
    for t, inputs, p in cases(start, seed=1):
        true, of_simple = (true_output(t, inputs, p, model) for model in (None, simple))
        for name, right in (("analytical", true), ("folded", true), ("simplified", of_simple)):
            outputs = [f(t, inputs, p) for f in (MODULES[name].output, library[name].output)]
            worst[name] = max(worst.get(name, 0.0), *(error_eotvos(x, right, p) for x in outputs))
    assert max(worst.values()) < 1e-6, worst
    assert worst["folded"] < 2e-7, worst  # the price of float64 channels is 1e-7


@pytest.mark.parametrize(("processor", "most"), [(NATIVE, 1.2e-16), ((), 1.4e-16)], ids=["native", "any"])
def test_fast_sine_and_cosine_are_good_to_the_last_bit(processor, most, tmp_path) -> None:
    """Read off the model itself: a force along x of an instrument whose A1 alone has a gain is -sin or cos.

    Any processor of a family may have to round products before it adds to them.
    """
    model = build(tmp_path, processor, ("folded",))["folded"]
    draw, spin = np.random.default_rng(6), 0.2503
    t = np.concatenate([x + draw.uniform(0, 8, 60) for x in (-1e3, 1e6, 2e9)] + [np.arange(-4, 4, 0.5)])
    p = np.zeros(analytical.SIZE)
    at = {name: 2 + 4 * (n - 2) for n, (name, _) in enumerate(analytical.PARAMETERS)}
    p[1], p[at["K1"]], p[at["k_VI"]] = spin, 1.0, 1.0
    for axis, by_encoder in product((0, 1), (False, True)):
        inputs = np.zeros((15, len(t)))
        inputs[axis] = 1.0
        output = model.output(t, inputs, p, t if by_encoder else None)
        for instant, value in zip(t, output, strict=True):
            angle = fifty.real(float(instant))
            if not by_encoder:
                angle *= 2 * fifty.CONTEXT.pi * fifty.real(spin)
            true = (-fifty.CONTEXT.sin(angle), fifty.CONTEXT.cos(angle))[axis]
            assert abs(float(fifty.real(float(value)) - true)) < most


def test_jacobian_is_the_derivative_of_the_instrument(library: dict[str, Library]) -> None:
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
