"""Targets that read what this program keeps: histories, records of changes, calibrations, mappings."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from ragg_runtime.base import transaction
from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation import saved
from ragg_runtime.flight.mapping import parse_mapping
from ragg_runtime.model_dir.directory import MODEL, NAMES
from ragg_runtime.model_dir.history import history_text, read_history
from ragg_runtime.report import in_words

from .places import Outcome, place, shown


def history(data: bytes) -> Outcome:
    """history.json: told on a terminal, and what is written again is read as the same."""
    path = place("history.json", data)
    try:
        steps = read_history(path)
    except UserError as error:
        return shown(error)
    told = in_words.history([s.as_json() for s in steps])
    assert len(told.splitlines()) == len(steps) + 1
    path.write_text(history_text(steps), "utf-8")
    assert read_history(path) == steps
    return "read"


def unfinished(data: bytes) -> Outcome:
    """The record of an unfinished change in a model directory: followed or refused, and nothing outside is touched."""
    folder = place("stranger", None)
    shutil.rmtree(folder, ignore_errors=True)
    commit = folder / "model" / transaction.WORK / "commit"
    commit.mkdir(parents=True)
    victim = folder / "victim"
    victim.write_bytes(b"mine")
    (folder / "model" / MODEL).write_bytes(b"old")
    (commit / MODEL).write_bytes(b"new")
    (commit / "journal.json").write_bytes(data)
    try:
        transaction.places(folder / "model", NAMES)
        transaction.finish(folder / "model", NAMES)
    except UserError as error:
        assert (folder / "model" / MODEL).read_bytes() == b"old"
        return shown(error)
    finally:
        assert victim.read_bytes() == b"mine"
        assert sorted(os.listdir(folder)) == ["model", "victim"]
    assert not transaction.is_committing(folder / "model")
    return "read"


def calibration(data: bytes) -> Outcome:
    """calibration.json."""
    try:
        found = saved.read(data.decode("utf-8", "replace"), "calibration.json")
    except UserError as error:
        return shown(error)
    assert saved.read(saved.with_another(None, found[-1], "again"), "again")[-1].time == found[-1].time
    return "read"


def mapping(data: bytes) -> Outcome:
    """mapping.toml."""
    try:
        found = parse_mapping(data.decode("utf-8", "replace"), Path("mapping.toml"))
    except UserError as error:
        return shown(error)
    assert found.columns
    return "read"
