"""Effects in Python: of installed packages and of the user's own folder, never of a model directory."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

import derive.effects as derive_effects
from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.model import derive
from ragg_runtime.model.catalogue import effects

CUBIC = (Path(derive_effects.__file__).parent / "cubic_input.py").read_text("utf-8")


def mine(identifier: str) -> str:
    return CUBIC.replace('id="cubic-input"', f'id="{identifier}"')


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(derive, "_folder", lambda: tmp_path / "cache")
    derive._installed.cache_clear()


def test_effects_folder_is_refused_with_what_to_do(tmp_path: Path) -> None:
    m = api.new(tmp_path / "model")
    (tmp_path / "model" / "mine").mkdir()
    (tmp_path / "model" / "mine" / "evil.py").write_text("raise SystemExit('executed')")
    toml = tmp_path / "model" / "model.toml"
    toml.write_text('effects_folder = "mine"\n' + m.directory.text)
    with pytest.raises(UserError) as refused:
        api.load(tmp_path / "model")
    for text in (str(toml), "effects_folder", "'mine'", "RAGG_EFFECTS"):
        assert text in refused.value.message


def test_effects_of_the_folder_that_the_user_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "mine.py").write_text(mine("mine"))
    (tmp_path / "own" / "__init__.py").write_text("raise SystemExit('executed')")
    m = api.new(tmp_path / "model")
    assert "mine" not in {e.id for e in m.model.candidates}
    with pytest.raises(UserError, match="unknown effect"):
        api.add(m, "mine")
    monkeypatch.setenv("RAGG_EFFECTS", str(tmp_path / "own"))
    m = api.load(tmp_path / "model")
    assert "mine" in {e.id for e in m.model.candidates}
    assert effects()["mine"]["title"] == effects()["cubic-input"]["title"]
    m = api.add(m, "mine").loaded
    assert [e.id for e in api.load(tmp_path / "model").model.effects] == ["mine"]
    monkeypatch.delenv("RAGG_EFFECTS")
    with pytest.raises(UserError, match="unknown effect"):
        api.load(tmp_path / "model")


def test_an_effect_is_added_to_what_model_toml_states_of_it(tmp_path: Path) -> None:
    """Of a body beside the instrument its place, which stays."""
    place = 'effects = [{ id = "near-sphere", x = { value = 1.2, unit = "m", fixed = true } }]'
    text = api.new(tmp_path / "model").directory.text
    toml = tmp_path / "model" / "model.toml"
    toml.write_text(text.replace("effects = []", place))
    m = api.add(api.load(tmp_path / "model"), "near-sphere").loaded
    assert [e.id for e in m.model.effects] == ["near-sphere"]
    assert m.instrument.effects[0].fixed == {"x"}
    toml.write_text(text.replace("effects = []", place.replace(" }]", ', M = "60 kg" }]')))
    with pytest.raises(UserError, match="already in the model"):
        api.add(api.load(tmp_path / "model"), "near-sphere")


def test_effects_of_an_installed_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "site" / "ragg_theirs"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    (package / "power.py").write_text(mine("theirs"))
    info = tmp_path / "site" / "ragg_theirs-1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: ragg-theirs\nVersion: 1\n")
    (info / "entry_points.txt").write_text("[ragg.effects]\ntheirs = ragg_theirs.power\n")
    monkeypatch.syspath_prepend(tmp_path / "site")
    try:
        instrument = api.example()
        assert [*derive.known(instrument)][-1] == "theirs"
        assert "theirs" in {e.id for e in derive.model_of(instrument).candidates}
    finally:
        for name in ("ragg_theirs", "ragg_theirs.power"):
            sys.modules.pop(name, None)
        derive._installed.cache_clear()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("EFFECT = 3", "defines no EFFECT"),
        ("1 / 0", "ZeroDivisionError"),
        ("raise SystemExit(3)", "SystemExit"),
        (mine("lag"), "the id of your effect is taken"),
    ],
)
def test_one_that_cannot_be_read_is_one_message(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, said: str
) -> None:
    (tmp_path / "mine.py").write_text(text)
    monkeypatch.setenv("RAGG_EFFECTS", str(tmp_path))
    with pytest.raises(UserError, match=said):
        derive.model_of(api.example())
    monkeypatch.setenv("RAGG_EFFECTS", str(tmp_path / "nowhere"))
    with pytest.raises(UserError, match="no folder of effects"):
        derive.model_of(api.example())
