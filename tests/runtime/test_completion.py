"""The shell completes ids of effects, those of the catalogue and a model's own, and never fails."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

RAGG = [sys.executable, "-m", "ragg_runtime"]


def completed(*words: str, shell: str = "bash") -> list[str]:
    """What the shell is offered for the last word: lines ``kind,value``."""
    own = {"COMP_WORDS": " ".join(["ragg", *words]), "COMP_CWORD": str(len(words))}
    own |= {"_RAGG_COMPLETE": f"{shell}_complete", "PYTHONPATH": str(Path(__file__).parents[2])}
    done = subprocess.run(RAGG, env=os.environ | own, capture_output=True, text=True, timeout=60)
    assert done.stderr == ""
    return [line.split(",", 1)[1] for line in done.stdout.splitlines() if "," in line]


@pytest.fixture
def model(tmp_path: Path) -> Path:
    place = tmp_path / "model"
    place.mkdir()
    own = '{ id = "satin-mine", stage = "transducer", add = "K_x * f_i", K_x = { unit = "1" } }'
    known = '{ id = "saturation", V_max = { value = 9.0, unit = "V" } }'
    (place / "model.toml").write_text(f"effects = [{own}, {known}, 'lag']\n")
    return place


def test_effects_of_the_catalogue() -> None:
    assert completed("effects", "thermal-") == ["thermal-bias", "thermal-lag", "thermal-scale"]


def test_add_offers_what_the_model_does_not_have_yet(model: Path) -> None:
    assert completed("add", str(model), "sat") == ["satin-mine"]
    assert completed("add", str(model), "la") == ["lag"]  # listed without values: it is calibrated
    assert completed("add", str(model.parent / "none"), "sat") == ["saturation"]


def test_remove_offers_what_the_model_lists(model: Path) -> None:
    assert completed("remove", str(model), "sa") == ["satin-mine", "saturation"]


@pytest.mark.parametrize("text", ["", "effects = 3", "effects = [[1]]", "effects = [{}]", "= = ="])
def test_a_damaged_model_completes_nothing(model: Path, text: str) -> None:
    (model / "model.toml").write_text(text)
    assert completed("remove", str(model), "s") == []


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_line_that_switches_it_on_prints_a_script(shell: str) -> None:
    own = {"_RAGG_COMPLETE": f"{shell}_source", "PYTHONPATH": str(Path(__file__).parents[2])}
    done = subprocess.run(RAGG, env=os.environ | own, capture_output=True, text=True, timeout=60)
    if shell == "bash" and "Couldn't detect Bash" in done.stderr:
        pytest.skip("no Bash here")
    assert "_RAGG_COMPLETE" in done.stdout
