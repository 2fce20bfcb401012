"""The two gates: committed bytes against the derivation, and the physics at 50 digits against the instrument.

The second holds whatever the tools do to the text: a release of SymPy that only orders terms anew fails the
first gate (derive again) and casts no doubt on the physics."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
import numpy as np
import pytest
import generated
from derive import everything, pipeline
from derive.propagation import collect, motion_numbers
from derive.symbols import MOTION, symbol
from generated import analytical, chain, folded
from ragg_runtime.cli.main import main
from tests.generated import compiled, draws
from tests.generated import fifty_digits as fifty
import sympy
from derive.effects import catalogue
from generated import analytical, chain, folded, signatures, simplified
from tests.generated import draws

COMMITTED = Path(str(generated.__file__)).parent
ROOT = COMMITTED.parent


def copy_of_generated(folder: Path) -> Path:
    shutil.copytree(COMMITTED, folder / "generated", ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def test_check_shows_the_difference_and_the_command_that_mends_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
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
    assert not everything.diff_files(committed, root / "generated")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [("a\nb\n", "a\nb", "final newline"), ("a\nb\n", "a\r\nb\r\n", ""), ("a\nb\n", "a\nc\n", "-c")],
)
def test_every_byte_counts(tmp_path: Path, old: str, new: str, message: str) -> None:
    (tmp_path / "x.py").write_bytes(new.encode())
    found = everything.diff_files({"x.py": old}, tmp_path)
    assert found
    assert message in found
    everything.write({"x.py": old}, tmp_path)
    assert not everything.diff_files({"x.py": old}, tmp_path)


def test_committed_files_are_what_the_derivation_yields_under_any_hash_seed() -> None:
    """SymPy keeps arguments in sets; nothing of their order may reach a file. ``make check`` has a seed at random."""
    command = [sys.executable, "-m", "ragg_runtime", "derive", "--check"]
    environment = os.environ | {"PYTHONHASHSEED": "31337"}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("seed", range(3))
def test_derived_amplitudes_are_the_instrument_at_50_digits(seed: int) -> None:
    """Eq. 17-19 as derived, exact rationals, against Eq. 1-15 in vectors: equal to 45 digits."""
    draw = np.random.default_rng(seed)
    # of order one, so that every term, up to the fourth order in the angles, counts
    p = np.concatenate([[0.7, 0.25], draw.uniform(-1, 1, 60)])
    x = fifty.exact(draw.uniform(-1, 1, 15))
    q, t = fifty.exact(p), fifty.exact(draw.uniform(0, 4, 1))[0]
    true = fifty.output(t, x, q)
    derived = fifty.from_amplitudes(fifty.amplitudes(collect(), x, q), t, q[1])
    assert abs(derived - true) < fifty.real(10) ** -45 * max(1, abs(true))


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


FOLDER = Path(str(generated.__file__)).parent
MANIFEST = json.loads((FOLDER / "manifest.json").read_text())
MODULES = {m.__name__.split(".")[-1]: m for m in (analytical, simplified, folded, chain, signatures)}


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


def project(root: Path, version: str, code: str) -> Path:
    (root / "generated").mkdir()
    (root / "generated" / "chain.py").write_text(code)
    (root / "generated" / "manifest.json").write_text(
        pipeline.manifest_text({"sympy": version, "digest": "1"})
    )
    return root


@pytest.fixture(autouse=True)
def derived(monkeypatch: pytest.MonkeyPatch) -> None:
    manifest = pipeline.manifest_text({"sympy": sympy.__version__, "digest": "1"})
    files = {"chain.py": "a + b\n", "manifest.json": manifest}
    monkeypatch.setattr(pipeline, "derive_base", lambda: files)


def test_the_same_code_of_another_sympy_is_the_same(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["derive", "--check", "--out", str(project(tmp_path, "1.0", "a + b\n"))])
    assert "derived with SymPy 1.0, and is the same here" in capsys.readouterr().out


def test_terms_in_another_order_are_told_with_the_versions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as end:
        main(["derive", "--check", "--out", str(project(tmp_path, "1.0", "b + a\n"))])
    said = capsys.readouterr().err
    assert end.value.code == 2
    assert "-b + a" in said
    assert "+a + b" in said
    assert f"SymPy is {sympy.__version__} here, and the code was derived with 1.0" in said
    assert "50-digit test" in said


@pytest.mark.parametrize("damage", ["", "[]", '{"sympy": 3}', "{"])
def test_a_damaged_manifest_is_a_difference(tmp_path: Path, damage: str) -> None:
    root = project(tmp_path, "1.0", "a + b\n")
    (root / "generated" / "manifest.json").write_text(damage)
    assert everything.difference(root)
    assert everything.about_versions(root) is None
