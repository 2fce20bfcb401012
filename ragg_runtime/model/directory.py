"""A model directory: model.toml, history.json, calibration.json, mapping.toml and generated/ (never executed).

A change replaces file after file under a lock, history.json before model.toml. The history has digests of model.toml
before and after: where the file is still the one before, the change was cut off, and its entry is dropped.
"""

from __future__ import annotations

import hashlib
import json
import secrets
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.base.files import lock, put_in_place, read_text, refuse_to_write
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.model_toml import parse_instrument

MODEL, GENERATED, HISTORY, CALIBRATION = "model.toml", "generated", "history.json", "calibration.json"
# how the columns of the instrument's flight files are read (see flight.mapping); only what the user gives replaces it
MAPPING = "mapping.toml"
DIGEST = "digest"  # the file in generated/ that says for which model its files were derived

LONGEST = 1 << 26  # bytes of history.json and of calibration.json
_PATIENCE = 30.0  # s; a change holds the lock for a fraction of a second


def compute_digest(text: str | None) -> str:
    """SHA-256 of a file's text, hexadecimal; of a file that is not there, that of nothing."""
    return hashlib.sha256((text or "").encode()).hexdigest()


@dataclass(frozen=True)
class HistoryStep:
    """An entry of history.json; ``time`` is UTC, ISO 8601, ``before`` and ``after`` are error objects (rms_V, rms_Eo,
    ...).

    ``action`` is ``new``, ``add``, ``remove`` or ``calibrate``; ``flights`` have their SHA-256; ``text`` is model.toml
    as it then was; ``digests`` are those of the file changed, before and after. Older histories lack the last two.
    """

    action: str
    time: str
    effect: str = ""
    before: Mapping[str, Any] | None = None
    after: Mapping[str, Any] | None = None
    flights: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    text: str = ""
    digests: tuple[str, ...] = ()

    def was_cut_off(self, model: str, calibration: str | None) -> bool:
        """Whether the file that the step changes is still the one before: the history is written first."""
        digest = compute_digest(calibration if self.action == "calibrate" else model)
        return len(self.digests) == 2 and digest == self.digests[0] != self.digests[1]

    def as_json(self) -> dict[str, Any]:
        """The entry as in the file."""
        return {
            "action": self.action,
            "effect": self.effect or None,
            "time": self.time,
            "before": self.before,
            "after": self.after,
            "flights": dict(self.flights),
            **({"model": self.text} if self.text else {}),
            **({"digests": list(self.digests)} if self.digests else {}),
        }


def history_text(steps: Sequence[HistoryStep]) -> str:
    """The text of a history.json."""
    return json.dumps({"steps": [step.as_json() for step in steps]}, indent=2, allow_nan=False) + "\n"


def _check_error(error: Any) -> Mapping[str, Any] | None:
    """An error object as in the file; TypeError, ValueError or AttributeError if it is none."""
    if error is not None:
        float(error.get("calibrated", error).get("rms_Eo") or 0.0)
    return error  # type: ignore[no-any-return]


def read_history(path: Path) -> tuple[HistoryStep, ...]:
    """The steps of a history.json, oldest first; none if there is no file. UserError if it is damaged."""
    if not path.exists():
        return ()
    try:
        steps = tuple(
            HistoryStep(
                action=one_line(str(s["action"])),
                time=one_line(str(s["time"])),
                effect=one_line(str(s["effect"] or "")),
                before=_check_error(s.get("before")),
                after=_check_error(s.get("after")),
                flights={str(n): str(d) for n, d in s.get("flights", {}).items()},
                text=str(s.get("model", "")),
                digests=tuple(map(str, s.get("digests", ()))),
            )
            for s in json.loads(read_text(path, LONGEST))["steps"]
        )
        history_text(steps)  # it is written again with the next step, and holds numbers only
    except (ArithmeticError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise UserError(
            "the history is damaged",
            where=path,
            found=str(error),
            expected='{"steps": [{"action", "effect", "time", "before", "after", "flights"}, ...]}',
            remedy="restore the file, or remove it: a new history begins with the next step",
        ) from None
    return steps


@dataclass(frozen=True, eq=False)
class ModelDir:
    """The state of a model directory as it was read; ``text`` is model.toml, comments and all, ``history`` oldest
    first.

    ``generated`` is ``None`` for the packaged base model; so are ``calibration`` and ``mapping`` where there is none.
    """

    path: Path
    text: str
    instrument: Instrument
    generated: Path | None
    history: tuple[HistoryStep, ...]
    calibration: str | None = None
    mapping: Path | None = None

    @property
    def digest(self) -> str:
        """SHA-256 over model, history and calibration, hexadecimal: equal states have equal digests."""
        parts = (self.text, history_text(self.history), self.calibration)
        return compute_digest("".join(map(compute_digest, parts)))


def load_model_dir(path: Path | str) -> ModelDir:
    """The model in a directory. UserError if it is none, or one of its files is damaged. Nothing is written."""
    path = Path(path)
    if not path.is_dir():
        raise UserError(
            "there is no model directory",
            where=path,
            found="a file" if path.exists() else "nothing",
            remedy=f"make one with: ragg new {path}",
        )
    while True:
        text, calibration = texts = _read_texts(path)
        history = read_history(path / HISTORY)
        if _read_texts(path) == texts:  # else a change came between
            break
    if history and history[-1].was_cut_off(text, calibration):
        history = history[:-1]
    generated, mapping = path / GENERATED, path / MAPPING
    return ModelDir(
        path=path,
        text=text,
        instrument=parse_instrument(text, path / MODEL),
        generated=generated if generated.is_dir() else None,
        history=history,
        calibration=calibration,
        mapping=mapping if mapping.exists() else None,
    )


def _read_texts(path: Path) -> tuple[str, str | None]:
    """The texts of model.toml and calibration.json."""
    if not (path / MODEL).exists():
        raise UserError(
            "not a model directory: model.toml is missing",
            where=path,
            found=", ".join(sorted(p.name for p in path.iterdir())[:8]) or "an empty directory",
            remedy="make a model with: ragg new",
        )
    calibration = path / CALIBRATION
    return read_text(path / MODEL), read_text(calibration, LONGEST) if calibration.exists() else None


def create_model_dir(
    path: Path | str,
    text: str,
    *,
    generated: Mapping[str, str],
    history: tuple[HistoryStep, ...],
    mapping: str | None = None,
) -> ModelDir:
    """Make a model directory, whole or not at all; UserError if ``path`` is not empty or ``text`` is no good model.toml."""
    path = Path(path)
    parse_instrument(text, path / MODEL)
    if path.exists() and not (path.is_dir() and not any(path.iterdir())):
        raise UserError(
            "the model directory exists already", where=path, remedy="choose another name or remove it first"
        )
    fresh = path.absolute().with_name(f".{path.absolute().name[:60]}.{secrets.token_hex(4)}")
    try:
        fresh.mkdir(parents=True)
        _put(fresh, {MODEL: text, HISTORY: history_text(history), MAPPING: mapping}, generated)
        if path.exists():
            fresh.chmod(path.stat().st_mode & 0o7777)
            path.rmdir()
        fresh.rename(path)
    except OSError as error:
        raise refuse_to_write("the model directory", path, error) from None
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
    return load_model_dir(path)


def replace_model_dir(
    current: ModelDir,
    text: str,
    *,
    generated: Mapping[str, str],
    step: HistoryStep,
    calibration: str | None = None,
    mapping: str | None = None,
) -> ModelDir:
    """Put a new state in place of ``current``: all of it, or nothing if this fails or is killed. What is not given
    stays.

    ``generated`` are path -> text. Raises UserError if model.toml was changed since, or if the directory cannot be written.
    """
    path = current.path
    parse_instrument(text, path / MODEL)
    try:
        with lock(path, _PATIENCE):
            stored = load_model_dir(path)
            if stored.text != current.text:
                raise UserError(
                    "the model was changed in the meantime",
                    where=path,
                    remedy="look at it with: ragg history, load it again and repeat the change",
                )
            changed = (stored.text, text) if calibration is None else (stored.calibration, calibration)
            history = (*stored.history, replace(step, digests=tuple(map(compute_digest, changed))))
            files = {MAPPING: mapping, HISTORY: history_text(history), CALIBRATION: calibration}
            _put(path, files | {MODEL: None if text == stored.text else text}, generated)
    except TimeoutError:
        raise UserError(
            "another command is changing the model", where=path, remedy="wait for it to end and try again"
        ) from None
    except OSError as error:
        raise refuse_to_write("the model", path, error) from None
    return load_model_dir(path)


def _put(path: Path, files: Mapping[str, str | None], generated: Mapping[str, str]) -> None:
    """Write these files in this order and generated/ after them; all that may fail is done before the first is in place."""
    new = {path / name: (path / f".{name}.new", text) for name, text in files.items() if text is not None}
    code, fresh = path / GENERATED, path / f".{GENERATED}.new"
    same = code.is_dir() and read_digest(code) == generated.get(DIGEST)
    try:
        for place, text in new.values():
            place.unlink(missing_ok=True)  # it may be a link
            place.write_bytes(text.encode())
        _remove(fresh)
        for name, text in {} if same else generated.items():
            (fresh / name).parent.mkdir(parents=True, exist_ok=True)
            (fresh / name).write_bytes(text.encode())
        for target, (place, _) in new.items():
            put_in_place(place, target)
        if not same:
            _remove(code)
            if generated:
                fresh.rename(code)
    finally:
        for place, _ in new.values():
            place.unlink(missing_ok=True)
        _remove(fresh)


def read_digest(generated: Path) -> str | None:
    """For which model the files in generated/ were derived; ``None``: unknown."""
    try:
        return (generated / DIGEST).read_text("utf-8")
    except (OSError, UnicodeError):
        return None


def _remove(place: Path) -> None:
    if place.is_symlink() or place.is_file():
        place.unlink()
    elif place.exists():
        shutil.rmtree(place)
