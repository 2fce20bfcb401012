"""A model directory is in the old or the new state, whatever happens; what is derived, compiled and executed of it, and of the user's."""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import stat
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import derive.effects as derive_effects
from derive import pipeline
from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import lock
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.model import chain as compiler
from ragg_runtime.model import derive
from ragg_runtime.model import directory as md
from ragg_runtime.model.chain import _say_once
from ragg_runtime.model.derive import effects
from ragg_runtime.model.directory import (
    HistoryStep,
    ModelDir,
    compute_digest,
    create_model_dir,
    load_model_dir,
    replace_model_dir,
)
from ragg_runtime.model.model import load_packaged
from tests.generated import draws

MODEL = """# state {n}
effects = []
[disc]
radius = "{n} m"
spin_frequency = "0.25 Hz"
g0 = "9.8 m/s^2"
[accelerometers]
K1 = "10 mA/g"
k_VI = "1e9 ohm"
"""
NAMES = ["generated", "history.json", "model.toml"]


def text_of(n: int) -> str:
    return MODEL.format(n=n)


def code_of(n: int) -> dict[str, str]:
    """Code of state n: none for every third one."""
    return {} if n % 3 == 0 else {"deep/chain.py": f"STATE = {n}\n" * 50, "digest": str(n)}


def step_of(n: int) -> HistoryStep:
    return HistoryStep("add", "2024-01-01T00:00:00Z", f"state-{n}")


def state_number(directory: ModelDir) -> int:
    """The number of the state, after a check that model and history are of the same one."""
    n = int(directory.instrument.radius)
    assert directory.text == text_of(n)
    assert directory.history[-1].effect == f"state-{n}"
    return n


def make(tmp_path: Path, n: int) -> ModelDir:
    return create_model_dir(tmp_path / "model", text_of(n), generated=code_of(n), history=(step_of(n),))


def change(current: ModelDir, n: int) -> ModelDir:
    return replace_model_dir(current, text_of(n), generated=code_of(n), step=step_of(n))


def entries(path: Path) -> list[str]:
    return sorted(p.name for p in path.iterdir())


def test_a_model_of_nothing_but_model_toml(tmp_path: Path) -> None:
    (tmp_path / "model.toml").write_text(text_of(2))
    directory = load_model_dir(tmp_path)
    assert (directory.generated, directory.history, directory.instrument.radius) == (None, (), 2.0)
    assert entries(tmp_path) == ["model.toml"]


@pytest.mark.parametrize(("old", "new"), [(1, 2), (1, 3), (3, 1)])
def test_replace(tmp_path: Path, old: int, new: int) -> None:
    current = make(tmp_path, old)
    (current.path / "notes.txt").write_text("mine")
    (current.path / "model.toml").chmod(0o640)
    changed = change(current, new)
    assert state_number(changed) == state_number(load_model_dir(changed.path)) == new
    assert changed.digest != current.digest
    assert changed.history[-1].digests == (compute_digest(text_of(old)), compute_digest(text_of(new)))
    assert (changed.path / "notes.txt").read_text() == "mine"
    assert (changed.path / "model.toml").stat().st_mode & 0o777 == 0o640
    assert entries(changed.path) == [x for x in [*NAMES, "notes.txt"] if x != "generated" or new % 3]
    if new % 3:
        assert (changed.path / "generated" / "deep" / "chain.py").read_text().startswith(f"STATE = {new}\n")
    assert entries(tmp_path) == ["model"]


def test_a_change_that_was_cut_off_is_dropped_and_an_edit_by_hand_is_not(tmp_path: Path) -> None:
    first = make(tmp_path, 1)
    change(first, 2)
    toml = first.path / "model.toml"
    toml.write_text(text_of(1))  # the history was written, model.toml was not
    directory = load_model_dir(first.path)
    assert (state_number(directory), len(directory.history)) == (1, 1)
    second = change(directory, 4)
    assert [s.effect for s in second.history] == ["state-1", "state-4"]
    assert len(json.loads((first.path / "history.json").read_text())["steps"]) == 2
    toml.write_text(text_of(4) + "# mine\n")
    assert [s.effect for s in load_model_dir(first.path).history] == ["state-1", "state-4"]
    with pytest.raises(UserError, match="changed in the meantime"):
        change(second, 3)


def test_a_calibration_saved_meanwhile_hinders_nobody_and_stays(tmp_path: Path) -> None:
    """As in a notebook: calibrate(m, flights, save=True), then add(m, effect, flights) with the same m."""
    first = make(tmp_path, 1)
    step = HistoryStep("calibrate", "2024-01-01T00:00:00Z")
    for kept in ("1", "2"):
        replace_model_dir(first, first.text, generated=code_of(1), step=step, calibration=kept)
    second = change(first, 2)
    assert [x.action for x in second.history] == ["add", "calibrate", "calibrate", "add"]
    assert second.calibration == "2"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork and SIGKILL")
def test_a_reader_beside_a_writer_that_is_killed_sees_whole_states(tmp_path: Path) -> None:
    directory = make(tmp_path, 1)
    chance = random.Random(20240101)
    seen = set()
    for _ in range(12):
        last = load_model_dir(directory.path).digest
        writer = os.fork()
        if writer == 0:
            current = load_model_dir(directory.path)
            for n in range(int(current.instrument.radius), 100000):
                current = change(current, 1 + n % 12)
            os._exit(1)
        try:
            deadline = time.monotonic() + 30
            while load_model_dir(directory.path).digest == last and time.monotonic() < deadline:
                state_number(load_model_dir(directory.path))
            time.sleep(chance.uniform(0.0, 0.02))
        finally:
            os.kill(writer, signal.SIGKILL)
            _, status = os.waitpid(writer, 0)
        assert os.waitstatus_to_exitcode(status) == -signal.SIGKILL, "the writer failed"
        seen.add(state_number(load_model_dir(directory.path)))
    assert len(seen) > 3, "the writer never wrote"
    assert state_number(change(load_model_dir(directory.path), 5)) == 5
    assert entries(directory.path) == NAMES


def test_what_fails_leaves_not_a_trace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    current = make(tmp_path, 1)
    before = {p: p.read_bytes() for p in sorted(current.path.rglob("*")) if p.is_file()}
    write_bytes = Path.write_bytes
    for error in (OSError(28, "No space left on device"), KeyboardInterrupt()):

        def fails(place: Path, data: bytes, error: BaseException = error) -> int:
            if place.name == "chain.py":
                raise error
            return write_bytes(place, data)

        with monkeypatch.context() as patch:
            patch.setattr(Path, "write_bytes", fails)
            with pytest.raises((UserError, KeyboardInterrupt)):
                change(current, 2)
        assert {p: p.read_bytes() for p in sorted(current.path.rglob("*")) if p.is_file()} == before
    with pytest.raises(UserError, match="TOML"):
        replace_model_dir(current, "radius =", generated={}, step=step_of(2))
    assert entries(current.path) == NAMES


def test_links_are_replaced_not_followed(tmp_path: Path) -> None:
    """Whoever sends a model directory writes nowhere else by it."""
    current = make(tmp_path, 1)
    (current.path / "history.json").unlink()
    (current.path / "history.json").symlink_to(tmp_path / "elsewhere.json")
    (current.path / ".model.toml.new").symlink_to(tmp_path / "elsewhere.toml")
    shutil.rmtree(current.path / "generated")
    (current.path / "generated").symlink_to(tmp_path / "outside")
    (tmp_path / "outside").mkdir()
    (tmp_path / "outside" / "mine").write_text("mine")
    assert state_number(change(load_model_dir(current.path), 2)) == 2
    assert entries(tmp_path) == ["model", "outside"]
    assert entries(tmp_path / "outside") == ["mine"]


def test_messages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(UserError, match="no model directory"):
        load_model_dir(tmp_path / "none")
    with pytest.raises(UserError, match=r"model\.toml is missing"):
        load_model_dir(tmp_path)
    directory = make(tmp_path, 1)
    with pytest.raises(UserError, match="exists already"):
        make(tmp_path, 1)
    monkeypatch.setattr(md, "_PATIENCE", 0.05)
    with lock(directory.path, 0.0), pytest.raises(UserError, match="another command"):
        change(directory, 2)
    whole = {"action": "add", "effect": "lag", "time": "now"}
    odd = ({"before": 3}, {"before": {"calibrated": [1]}}, {"after": {"rms_Eo": "many"}}, {"flights": ["a"]})
    steps = (json.dumps({"steps": [whole | step]}) for step in odd)
    for bad in ("{", "[]", '{"steps": [{}]}', '{"steps": 3}', *steps):
        (directory.path / "history.json").write_text(bad)
        with pytest.raises(UserError, match="history is damaged"):
            load_model_dir(directory.path)


# --- what is executed: effects of packages and of the user's own folder, never generated/ of a model directory ---

CUBIC = (Path(derive_effects.__file__).parent / "cubic_input.py").read_text("utf-8")
EVIL = "\nimport pathlib\npathlib.Path({mark!r}).write_text('executed')\n"


def mine(identifier: str) -> str:
    return CUBIC.replace('id="cubic-input"', f'id="{identifier}"')


def forget() -> None:
    """What this process has derived and loaded so far."""
    for cache in (derive._load_installed, derive._execute_files):
        cache.cache_clear()


@pytest.fixture(scope="module")
def derived_once(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A model with an effect, and a cache of what was derived for it."""
    place = tmp_path_factory.mktemp("derived")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(place / "cache"))
        forget()
        api.add(api.new(place / "model"), "gain-drift")
    return place


@pytest.fixture
def model(derived_once: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of both for each test."""
    shutil.copytree(derived_once, tmp_path, dirs_exist_ok=True)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    forget()
    return tmp_path / "model"


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


def test_effects_of_the_folder_that_the_user_names(model: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = model.parent / "own"
    folder.mkdir()
    (folder / "mine.py").write_text(mine("mine"))
    (folder / "__init__.py").write_text("raise SystemExit('executed')")
    with pytest.raises(UserError, match="unknown effect"):
        api.add(api.load(model), "mine")
    monkeypatch.setenv("RAGG_EFFECTS", str(folder))
    m = api.load(model)
    assert "mine" in {e.id for e in m.model.candidates}
    assert effects()["mine"]["title"] == effects()["cubic-input"]["title"]
    m = api.add(m, "mine").loaded
    assert [e.id for e in api.load(model).model.effects] == ["gain-drift", "mine"]
    monkeypatch.delenv("RAGG_EFFECTS")
    with pytest.raises(UserError, match="unknown effect"):
        api.load(model)


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
    package, info = tmp_path / "ragg_theirs", tmp_path / "ragg_theirs-1.dist-info"
    package.mkdir()
    info.mkdir()
    (package / "__init__.py").write_text("")
    (package / "power.py").write_text(mine("theirs"))
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: ragg-theirs\nVersion: 1\n")
    (info / "entry_points.txt").write_text("[ragg.effects]\ntheirs = ragg_theirs.power\n")
    monkeypatch.syspath_prepend(tmp_path)
    forget()
    try:
        assert [*derive.list_known(api.example())][-1] == "theirs"
        assert "theirs" in {e.id for e in derive.load_model(api.example()).candidates}
    finally:
        for name in ("ragg_theirs", "ragg_theirs.power"):
            sys.modules.pop(name, None)
        forget()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("EFFECT = 3", "defines no EFFECT"),
        ("1 / 0", "ZeroDivisionError"),
        ("raise SystemExit(3)", "SystemExit"),
        (mine("lag"), "the id of your effect is taken"),
        (None, "no folder of effects"),
    ],
)
def test_an_effect_that_cannot_be_read_is_one_message(tmp_path, monkeypatch, text, said) -> None:
    if text is not None:
        (tmp_path / "own").mkdir()
        (tmp_path / "own" / "mine.py").write_text(text)
    monkeypatch.setenv("RAGG_EFFECTS", str(tmp_path / "own"))
    with pytest.raises(UserError, match=said):
        derive.load_model(api.example())


@pytest.mark.parametrize("damage", [None, "{", '{"chain.py": 3}'])
def test_what_was_derived_is_not_derived_again_unless_it_is_damaged(model, monkeypatch, damage) -> None:
    """And generated/ is for people to read: it is not executed."""
    for file in (model.parent / "cache" / "ragg" / "derived").iterdir() if damage else ():
        file.write_text(damage)
    for name in ("chain.py", "digest"):
        with (model / "generated" / name).open("a") as stream:
            stream.write(EVIL.format(mark=str(model / "mark")))
    count: list[int] = []
    original = pipeline.derive_model
    monkeypatch.setattr(pipeline, "derive_model", lambda *a: count.append(1) or original(*a))
    m = api.load(model)
    assert ([e.id for e in m.model.effects], count) == (["gain-drift"], [1] if damage else [])
    assert not (model / "mark").exists()


def test_generated_is_derived_anew_where_it_is_of_another_model(model: Path) -> None:
    """As after a change by hand, or one that was cut off before this folder was in place."""
    toml = model / "model.toml"
    text = toml.read_text("utf-8")
    toml.write_text(text.replace("order", "# order").replace('"full"', '"platform"'), "utf-8")
    m = api.load(model)
    assert "was not derived for this model.toml" in m.notes[0]
    before = (model / "generated" / "digest").read_text()
    m = api.add(m, "lag").loaded
    assert m.notes == api.load(model).notes == ()
    assert (model / "generated" / "digest").read_text() != before
    assert "lag" in (model / "generated" / "chain.py").read_text("utf-8")


def test_a_request_depends_on_all_that_is_derived(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = api.new(tmp_path / "model").directory.text
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
    keys = {derive.identify(parse_instrument(text.replace("effects = []", f"effects = {e}"))) for e in lists}
    monkeypatch.setenv("RAGG_EFFECTS", str(tmp_path))
    for source in ("# 1\n", "# 2\n"):
        (tmp_path / "a.py").write_text(source)
        keys.add(derive.identify(parse_instrument(text)))
    assert len(keys) == len(lists) + 2


def test_a_model_directory_is_not_imported_from(tmp_path: Path) -> None:
    """`python -m` looks into the current folder first, and a model directory has a `generated/`."""
    place = api.new(tmp_path / "model").directory.path
    (place / "generated").mkdir()
    (place / "generated" / "__init__.py").write_text("raise SystemExit('executed')\n")
    command = [sys.executable, "-m", "ragg_runtime", "history", "."]
    done = subprocess.run(command, cwd=place, capture_output=True, text=True, check=False)
    assert (done.returncode, "executed" in done.stderr) == (0, False), done.stderr


# --- machine code: equal to NumPy, and NumPy without a compiler ---

needs_compiler = pytest.mark.skipif(
    not any(shutil.which(c) for c in ("cc", "gcc", "clang")), reason="no C compiler is installed"
)
ONE = {"one.c": "int one(void) { return 1; }\n"}


@pytest.fixture
def compiling(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("RAGG_NATIVE", raising=False)
    _say_once.cache_clear()


@pytest.mark.usefixtures("compiling")
def test_without_a_compiler_numpy_serves_and_says_so_once(monkeypatch, tmp_path, capsys) -> None:
    draw = np.random.default_rng(40)
    t, inputs, p = np.arange(20.0), draws.motion(draw, 20), draws.instrument(draw)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    assert compiler.find_compiler()[1:] == ["-m", "ziglang", "cc"]
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    for chain in (replace(load_packaged().chain), replace(load_packaged().chain)):
        assert np.all(np.isfinite(chain.output(t, inputs, p)))
        assert chain.library is None
    assert capsys.readouterr().err.count("slower NumPy code is used: there is no C compiler") == 1
    monkeypatch.setenv("RAGG_NATIVE", "off")
    assert replace(load_packaged().chain).library is None
    assert capsys.readouterr().err == ""


@needs_compiler
def test_library_is_made_once_and_anew_when_anything_changes(tmp_path, monkeypatch) -> None:
    first = compiler.compile_library(ONE, tmp_path)
    stamp = first.stat().st_mtime_ns
    assert compiler.compile_library(ONE, tmp_path) == first
    assert first.stat().st_mtime_ns == stamp
    assert compiler.compile_library({"one.c": "int one(void) { return 2; }\n"}, tmp_path) != first
    monkeypatch.setenv("CC", f"{compiler.find_compiler()[0]} -DX=1")
    assert compiler.compile_library(ONE, tmp_path) != first
    monkeypatch.delenv("CC")
    first.write_bytes(first.read_bytes()[:100])  # damaged: refused once, then made anew
    with pytest.raises(compiler.BuildError, match="cannot be loaded"):
        compiler.load(compiler.compile_library(ONE, tmp_path))
    compiler.load(compiler.compile_library(ONE, tmp_path))


@needs_compiler
def test_a_cache_that_others_can_write_to_is_not_used(tmp_path: Path) -> None:
    tmp_path.chmod(0o777)
    library = compiler.compile_library(ONE, tmp_path)
    assert library.parent != tmp_path
    assert stat.S_IMODE(library.parent.stat().st_mode) == 0o700
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="a script of Unix")
@pytest.mark.usefixtures("compiling")
def test_a_compiler_that_hangs_or_fails_is_one_message(tmp_path: Path, monkeypatch) -> None:
    """Its children hold the pipes open; it was waited for 304 s."""
    script = tmp_path / "cc"
    script.write_text("#!/bin/sh\nsleep 300 & sleep 300\n")
    script.chmod(0o755)
    monkeypatch.setattr(compiler, "PATIENCE", 1.0)
    start = time.monotonic()
    for cc in (str(script), '"unclosed', "gcc --no-such-option", "/", "/dev/null", "false"):
        monkeypatch.setenv("CC", cc)
        expected = "does not answer within 1 s" if cc == str(script) else None
        with pytest.raises(compiler.BuildError, match=expected):
            compiler.compile_library(ONE, tmp_path / "cache")
    assert time.monotonic() - start < 20
    assert not list((tmp_path / "cache").glob(".*so"))
