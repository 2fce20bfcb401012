"""``generated/`` of a model directory is never executed, but what was derived here."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive import pipeline
from ragg_runtime import api
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model import derive

ROOT = Path(api.__file__).parents[1]
EVIL = "\nimport pathlib\npathlib.Path({mark!r}).write_text('executed')\n"


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(derive, "_folder", lambda: tmp_path / "cache" / "derived")
    derive._executed.cache_clear()


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return api.add(api.new(tmp_path / "model"), "gain-drift").loaded.directory.path


def derives(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Counts derivations from here on; those of this process so far are forgotten."""
    derive.derived.cache_clear()
    derive._executed.cache_clear()
    count: list[int] = []
    original = pipeline.derive_model

    def counted(*a: object) -> object:
        count.append(1)
        return original(*a)  # type: ignore[arg-type]

    monkeypatch.setattr(pipeline, "derive_model", counted)
    return count


def test_what_was_derived_before_is_not_derived_again(model: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    count = derives(monkeypatch)
    m = api.load(model)
    assert ([e.id for e in m.model.effects], m.notes, count) == (["gain-drift"], (), [])
    for file in (model.parent / "cache" / "derived").iterdir():
        file.unlink()
    assert m.model.digest == derive.model_of(m.instrument).digest
    assert count == [1], "what is not kept is derived"


@pytest.mark.parametrize("name", ["chain.py", "digest"])
def test_generated_is_not_executed(
    model: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
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


@pytest.mark.parametrize("damage", ["{", '{"chain.py": 3}'])
def test_what_is_damaged_is_derived_anew(model: Path, monkeypatch: pytest.MonkeyPatch, damage: str) -> None:
    for file in (model.parent / "cache" / "derived").iterdir():
        file.write_text(damage)
    count = derives(monkeypatch)
    assert [e.id for e in api.load(model).model.effects] == ["gain-drift"]
    assert count == [1]


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
