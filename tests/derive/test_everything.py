"""``ragg derive --check`` where SymPy is another than the one that the committed code was derived with."""

from __future__ import annotations

from pathlib import Path

import pytest
import sympy

from derive import everything, pipeline
from ragg_runtime.cli.main import main


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
