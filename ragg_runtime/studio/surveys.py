"""A survey of the flights of a folder: each diagnosed by itself beside the server, and kept so that no flight is done twice."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import platformdirs

from ragg_runtime.base import progress
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import read_text
from ragg_runtime.flight.formats import ending_of
from ragg_runtime.report.survey_page import shown
from ragg_runtime.studio.places import Places
from ragg_runtime.survey.result import Survey
from ragg_runtime.survey.task import Record, fingerprint
from ragg_runtime.survey.tls import Tls
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.loop import Loaded

MOST = 20_000
"""Flights of a folder that are taken."""

KEPT = 8
"""Results files that are kept, the latest: of a model that has changed they serve nobody."""


@dataclass(frozen=True)
class Workers:
    """Who examines the flights: processes of this machine, or a Dask cluster at ``scheduler``."""

    scheduler: str | None = None
    tls: Tls | None = None

    @property
    def options(self) -> list[str]:
        """The same as words of a command."""
        cluster = [] if self.scheduler is None else ["--scheduler", self.scheduler]
        t = self.tls
        files = [] if t is None else ["--tls-ca", t.ca, "--tls-cert", t.cert, "--tls-key", t.key]
        return [*cluster, *map(str, files)]


@dataclass(frozen=True)
class Surveyed:
    """A survey, the folder of its flights, the model that it was made with, and who examined them."""

    folder: Path
    model: Loaded
    survey: Survey
    workers: Workers


def surveyed(
    m: Loaded,
    folder: Path,
    files: Sequence[Path],
    workers: Workers,
    part: Callable[[str, float], None],
    note: Callable[[str], None],
) -> Surveyed:
    """Diagnose the flights of ``folder``; what is done is kept, and is taken when it is asked for again.

    ``part`` is told how many there are, ``note`` how many are done.
    """

    def show(done: int, total: int, record: Record | None) -> None:
        if record is None:
            part(f"surveying {total} flights", float(total))
        progress.step(float(done) if record is None else 1.0)
        note(f"{done} of {total} done")

    found = loop.survey(
        m, files, scheduler=workers.scheduler, tls=workers.tls, resume=_results(m, folder), progress=show
    )
    return Surveyed(folder=folder, model=m, survey=found, workers=workers)


def flights_below(folder: Path, places: Places) -> list[Path]:
    """Files there that can be flights; links that lead out of the studio's folders are left out."""
    if not folder.is_dir():
        raise UserError("there is no such folder", where=folder)
    files = (p for p in sorted(folder.rglob("*")) if not p.name.startswith(".") and ending_of(p.name))
    found = [p for p in files if p.is_file() and places.holds(p)]
    if not 0 < len(found) <= MOST:
        raise UserError(
            "a survey needs flights",
            where=folder,
            found=f"{len(found)} flight files there and below",
            expected=f"1 to {MOST}",
        )
    return found


def _results(m: Loaded, folder: Path) -> Path:
    """Where results of this model and folder are kept: beside no data, and no file of another model."""
    kept = platformdirs.user_cache_path("ragg") / "surveys"
    kept.mkdir(parents=True, exist_ok=True, mode=0o700)
    how = loop.mapping_of(m, None)
    columns = None if how is None else read_text(how.path)
    identity = json.dumps([str(m.directory.path), m.directory.text, columns, str(folder), fingerprint()])
    own = kept / f"{hashlib.sha256(identity.encode()).hexdigest()[:32]}.jsonl"
    for old in sorted(set(kept.glob("*.jsonl")) - {own}, key=lambda p: p.stat().st_mtime)[: -KEPT + 1]:
        old.unlink(missing_ok=True)
    return own


def shown_survey(x: Surveyed, m: Loaded) -> dict[str, Any]:
    """What the page says of it, in the words and digits of the report."""
    s = x.survey
    return shown(s) | {
        "folder": str(x.folder),
        "of_this_model": x.model.directory.text == m.directory.text,
        "files": [r["file"] for r in s.done],
        "drawn": [
            {"label": t.label, "unit": t.unit, "mean": t.mean, "values": list(t.values), "stds": list(t.stds)}
            for t in s.summary.trends
        ],
    }
