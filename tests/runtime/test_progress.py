"""How far a command is: what is foretold is about what is done, and how it is shown."""

from __future__ import annotations

import time

import pytest

from ragg_runtime.base import progress


def test_lines_tell_share_and_time_left(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    now = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    with progress.shown("diagnose", 1000):
        for _ in range(10):
            now[0] += 10.0
            progress.step(progress.PASSES["diagnose"] * 1000 / 20)
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "... 10 % done, about 3 min left"
    assert lines[-1] == "... 50 % done, about 100 s left" or lines[-1] == "... 50 % done, about 2 min left"
    progress.step(1.0)  # nobody listens any more
    assert capsys.readouterr().err == ""


def test_short_commands_show_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    with progress.shown("diagnose", 10):
        progress.step(20.0)
    assert capsys.readouterr().err == ""


def test_what_takes_longer_than_foretold_is_not_almost_done(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    now = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    with progress.shown("diagnose", 1000):
        for _ in range(2):
            now[0] += 300.0
            progress.step(progress.PASSES["diagnose"] * 1000)
    assert (
        capsys.readouterr().err.splitlines()[-1]
        == "... 99 % done, takes longer than estimated, 10 min so far"
    )
