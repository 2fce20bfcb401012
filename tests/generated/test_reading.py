"""The generated code can be read, and says what it is."""

from __future__ import annotations

import json
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
