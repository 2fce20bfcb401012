"""What is executed: effects in Python of packages and of the user's own folder; never ``generated/`` of a model directory."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

import derive.effects as derive_effects
from derive import pipeline
from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.model import derive
from ragg_runtime.model.derive import effects

CUBIC = (Path(derive_effects.__file__).parent / "cubic_input.py").read_text("utf-8")


def mine(identifier: str) -> str:
    return CUBIC.replace('id="cubic-input"', f'id="{identifier}"')


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    derive._load_installed.cache_clear()
    derive._execute_files.cache_clear()


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
        assert [*derive.list_known(instrument)][-1] == "theirs"
        assert "theirs" in {e.id for e in derive.load_model(instrument).candidates}
    finally:
        for name in ("ragg_theirs", "ragg_theirs.power"):
            sys.modules.pop(name, None)
        derive._load_installed.cache_clear()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("EFFECT = 3", "defines no EFFECT"),
        ("1 / 0", "ZeroDivisionError"),
        ("raise SystemExit(3)", "SystemExit"),
        (mine("lag"), "the id of your effect is taken"),
    ],
)
def test_one_that_cannot_be_read_is_one_message(tmp_path, monkeypatch, text, said) -> None:
    (tmp_path / "mine.py").write_text(text)
    monkeypatch.setenv("RAGG_EFFECTS", str(tmp_path))
    with pytest.raises(UserError, match=said):
        derive.load_model(api.example())
    monkeypatch.setenv("RAGG_EFFECTS", str(tmp_path / "nowhere"))
    with pytest.raises(UserError, match="no folder of effects"):
        derive.load_model(api.example())


ROOT = Path(api.__file__).parents[1]
EVIL = "\nimport pathlib\npathlib.Path({mark!r}).write_text('executed')\n"


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return api.add(api.new(tmp_path / "model"), "gain-drift").loaded.directory.path


def derives(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Counts derivations from here on; those of this process so far are forgotten."""
    derive.derived.cache_clear()
    derive._execute_files.cache_clear()
    count: list[int] = []
    original = pipeline.derive_model

    def counted(*a: object) -> object:
        count.append(1)
        return original(*a)  # type: ignore[arg-type]

    monkeypatch.setattr(pipeline, "derive_model", counted)
    return count


@pytest.mark.parametrize("damage", [None, "{", '{"chain.py": 3}'])
def test_what_was_derived_before_is_not_derived_again_unless_it_is_damaged(
    model: Path, monkeypatch: pytest.MonkeyPatch, damage: str | None
) -> None:
    for file in (model.parent / "cache" / "ragg" / "derived").iterdir() if damage else ():
        file.write_text(str(damage))
    count = derives(monkeypatch)
    m = api.load(model)
    assert ([e.id for e in m.model.effects], m.notes, count) == (["gain-drift"], (), [1] if damage else [])


@pytest.mark.parametrize("name", ["chain.py", "digest"])
def test_generated_is_not_executed(model, tmp_path, monkeypatch, name) -> None:
    mark = tmp_path / "mark"
    with (model / "generated" / name).open("a") as stream:
        stream.write(EVIL.format(mark=str(mark)))
    count = derives(monkeypatch)
    m = api.load(model)
    assert not mark.exists()
    assert count == []
    assert [e.id for e in m.model.effects] == ["gain-drift"]


def test_generated_is_derived_anew_where_it_is_of_another_model(model: Path) -> None:
    """As after a change by hand, or one that was cut off before this folder was in place."""
    toml = model / "model.toml"
    toml.write_text(
        toml.read_text("utf-8").replace("order", "# order").replace('"full"', '"platform"'), "utf-8"
    )
    m = api.load(model)
    assert "was not derived for this model.toml" in m.notes[0]
    before = (model / "generated" / "digest").read_text()
    m = api.add(m, "lag").loaded
    assert m.notes == api.load(model).notes == ()
    assert (model / "generated" / "digest").read_text() != before
    assert "lag" in (model / "generated" / "chain.py").read_text("utf-8")


def test_a_request_depends_on_all_that_is_derived(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (ROOT / "ragg_runtime" / "example.toml").read_text("utf-8")
    line = '{ id = "mine", stage = "transducer", add = "K * f_i**2", K = { unit = "ug/g^2" } }'
    lists = [
        '["gain-drift"]',
        '["gain-drift", "cubic-input"]',
        '["cubic-input", "gain-drift"]',
        f"[{line}]",
        f"[{line.replace('**2', '**3')}]",
        f"[{line.replace('ug/g^2', 'mg/g^2')}]",
        f"[{line.replace('unit =', 'shared = true, unit =')}]",
    ]
    found = {derive.request(parse_instrument(text.replace("effects = []", f"effects = {e}"))) for e in lists}
    monkeypatch.setenv("RAGG_EFFECTS", str(tmp_path))
    for source in ("# 1\n", "# 2\n"):
        (tmp_path / "a.py").write_text(source)
        found.add(derive.request(parse_instrument(text)))
    assert len(found) == len(lists) + 2
