"""How far a survey is, on stderr, and where its results are kept meanwhile."""

from __future__ import annotations

import contextlib
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import click

from ragg_runtime.base.progress import INTERVAL
from ragg_runtime.survey.run import Progress
from ragg_runtime.survey.task import Record


@contextlib.contextmanager
def results_file(resume: Path | None) -> Iterator[Path]:
    """The results file: the one asked for, else one that is kept only if the survey is cut short."""
    if resume is not None:
        path, temporary = resume, False
    else:
        handle, name = tempfile.mkstemp(prefix="ragg-survey-", suffix=".jsonl")
        os.close(handle)
        path, temporary = Path(name), True
        # A survey that is killed outright cannot say it any more.
        click.echo(f"... if it is cut short, continue with --resume {path}", err=True)
    before = path.stat().st_size if path.is_file() else 0
    try:
        yield path
    except BaseException:
        # Nothing that was there before is read: it may be anything, and a refusal says so.
        if path.is_file() and path.stat().st_size > before and path.read_bytes().count(b"\n") > 1:
            click.echo(f"ragg: what is done is kept; continue with --resume {path}", err=True)
        elif temporary:
            path.unlink(missing_ok=True)
        raise
    if temporary:
        path.unlink(missing_ok=True)


@contextlib.contextmanager
def shown() -> Iterator[Progress]:
    """A bar with the time left where stderr is a terminal, else a line now and then."""
    if sys.stderr.isatty():
        with _bar() as show:
            yield show
    else:
        yield _lines()


@contextlib.contextmanager
def _bar() -> Iterator[Progress]:
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (
        TextColumn("flights"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("time left"),
        TimeRemainingColumn(),
        TextColumn("{task.fields[failed]}"),
    )
    with Progress(*columns, console=Console(stderr=True), speed_estimate_period=600.0) as bar:
        task = bar.add_task("", total=None, failed="")
        failed = 0

        def show(done: int, total: int, record: Record | None) -> None:
            nonlocal failed
            failed += record is not None and "error" in record and "verdict" not in record
            bar.update(task, completed=done, total=total, failed=f"[red]{failed} in error" if failed else "")

        yield show


def _lines() -> Progress:
    start = last = time.monotonic()
    before = 0

    def show(done: int, total: int, record: Record | None) -> None:
        nonlocal last, before
        now = time.monotonic()
        if record is None:
            before = done
            kept = f", {done} of them done before" if done else ""
            click.echo(f"... {total} flights{kept}", err=True)
        elif now - last >= INTERVAL or done == total:
            last = now
            left = (now - start) / max(done - before, 1) * (total - done)
            click.echo(f"... {done} of {total}, {left:.0f} s left", err=True)

    return show
