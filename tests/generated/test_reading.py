"""The generated code can be read, and says what it is."""

from __future__ import annotations

import ast
import inspect
import json
import re
from pathlib import Path

import numpy as np
import sympy

import generated
from derive.effects import catalogue
from generated import analytical, chain, folded, signatures, simplified
from tests.generated import draws

FOLDER = Path(str(generated.__file__)).parent
MANIFEST = json.loads((FOLDER / "manifest.json").read_text())
MODULES = {m.__name__.split(".")[-1]: m for m in (analytical, simplified, folded, chain, signatures)}


def term(source: str, amplitude: str, motion: str) -> str:
    """The line of an amplitude in ``amplitudes`` that multiplies this product of motion numbers."""
    block = source[source.index(f"# {amplitude}\n") :].split("    )\n")[0]
    lines = [line.strip() for line in block.splitlines() if line.rstrip().endswith(f"* {motion}")]
    assert len(lines) == 1, (amplitude, motion, lines)
    return lines[0].removeprefix("+ ")


def test_what_the_instrument_is_there_for_can_be_found() -> None:
    """Eq. 18: the sum over k1 R multiplies T_1 in the sine and T_2 in the cosine of twice the spin rate."""
    source = inspect.getsource(analytical.amplitudes)
    for amplitude, motion in (("A_2s", "T_1"), ("A_2c", "T_2")):
        assert term(source, amplitude, motion).startswith(
            "(Sigma(R*k1) + Sigma((R*beta_z*k1)*("
        )  # and angles
        assert term(inspect.getsource(simplified.amplitudes), amplitude, motion) == f"Sigma(R*k1) * {motion}"


def test_error_propagation_coefficients_of_eq_18_can_be_found() -> None:
    """One of each kind of combination, written as the paper writes it."""
    source = inspect.getsource(analytical.amplitudes)
    assert "D1234(K0*k1)" in source  # A_0: null bias through the scale factors
    assert term(source, "A_0", "a_z**2.0") == "D1234(K7*k1) * a_z**2.0"
    assert term(source, "A_0", "T_6**2.0") == "D1234(K2*R**2.0*k1) * T_6**2.0"
    assert term(source, "A_1c", "(a_x*a_z)") == "(D12(-K8*k1) + D34(-K4*k1)) * (a_x*a_z)"
    assert all(f"{name}(" in source for name in ("D12", "D34", "D1234", "Sigma"))


def test_amplitudes_have_the_names_of_the_paper() -> None:
    names = ("A_0", *(f"A_{n}{w}" for n in range(1, 5) for w in "cs"))
    assert names == analytical.AMPLITUDES
    source = inspect.getsource(analytical.amplitudes)
    assert [source.index(f"# {n}\n") for n in names] == sorted(source.index(f"# {n}\n") for n in names)


def test_every_public_function_says_shape_and_unit() -> None:
    for module in (analytical, simplified, folded, chain, signatures):
        tree = ast.parse(inspect.getsource(module))
        assert ast.get_docstring(tree)
        for node in tree.body:
            if isinstance(node, ast.FunctionDef) and len(node.args.args) > 2:
                doc = ast.get_docstring(node) or ""
                assert re.search(r"\((\S+, )*N,?\)", doc), (module.__name__, node.name)


def test_manifest_lists_every_file_and_model() -> None:
    present = {
        p.relative_to(FOLDER).as_posix()
        for p in FOLDER.rglob("*")
        if p.is_file() and "__pycache__" not in p.parts
    }
    assert set(MANIFEST["files"]) == present
    assert set(MANIFEST["models"]) == set(MODULES) == set(generated.__all__)
    assert MANIFEST["format"] == 1
    assert MANIFEST["sympy"].split(".")[0] == sympy.__version__.split(".")[0]
    assert len(MANIFEST["digest"]) == 64
    assert MANIFEST["effects"] == []
    assert [e["id"] for e in MANIFEST["catalogue"]] == [e.id for e in catalogue()]


def test_manifest_describes_what_the_modules_hold() -> None:
    for name, module in MODULES.items():
        entry = MANIFEST["models"][name]
        assert [i["name"] for i in entry["inputs"]] == list(module.INPUTS)
        assert [(q["name"], q["size"]) for q in entry["parameters"]][: len(module.PARAMETERS)] == list(
            module.PARAMETERS
        )
        assert all(q["unit"] for q in entry["parameters"])
        assert all(count > 0 for count in entry["operations"].values())
        if name in ("analytical", "simplified"):
            assert entry["amplitudes"] == list(module.AMPLITUDES)
        elif name != "folded":
            assert entry["rows"] == [n for n, _ in module.ROWS]


def test_simplified_model_is_the_cheaper_and_the_shorter() -> None:
    cost = {n: MANIFEST["models"][n]["operations"] for n in ("analytical", "simplified")}
    assert all(2 * cost["simplified"][k] < cost["analytical"][k] for k in ("coefficients", "amplitudes"))
    source = {m: inspect.getsource(m.amplitudes) for m in (analytical, simplified)}
    assert 2 * len(source[simplified]) < len(source[analytical])


def test_amplitudes_and_output_are_one_model() -> None:
    """Eq. 17 put together by hand; four quarters of a turn at constant motion give A_0."""
    draw = np.random.default_rng(11)
    p, inputs = draws.instrument(draw), np.repeat(draws.motion(draw, 1), 8, axis=1)
    t = np.arange(8) / 2.0  # one turn at 0.25 Hz
    for module in (analytical, simplified):
        A = module.amplitudes(inputs, p)
        G = module.output(t, inputs, p)
        phi = 2 * np.pi * 0.25 * t
        by_hand = A[0] + sum(
            A[2 * n - 1] * np.cos(n * phi) + A[2 * n] * np.sin(n * phi) for n in range(1, (len(A) + 1) // 2)
        )
        np.testing.assert_allclose(G, by_hand, rtol=0, atol=1e-12 * np.max(np.abs(G)))
        np.testing.assert_allclose(np.mean(G), A[0, 0], rtol=0, atol=1e-12 * np.max(np.abs(G)))
