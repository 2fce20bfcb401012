"""Where a result comes from: what makes it again, and what was done to what it was made of."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ragg_runtime.base.provenance import provenance
from ragg_runtime.flight import Flight
from ragg_runtime.model_dir.identity import identity
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.loop import Loaded

if TYPE_CHECKING:
    from ragg_runtime.survey.result import Survey


def origin(
    m: Loaded,
    flights: Sequence[Flight],
    command: str,
    *,
    files: Sequence[tuple[str, str | None]] = (),
    before: Loaded | None = None,
) -> dict[str, object]:
    """What makes a result again (``provenance``), and what the reader did to the flights (``notes``).

    ``files`` (path, SHA-256) are flights that were read elsewhere; ``before`` is the model that the command
    has changed.
    """
    model = identity(m.directory, m.model.digest, None if before is None else before.directory)
    read = [(x.name if x.path is None else str(x.path), x.digest) for x in flights]
    return {"notes": notes(m, flights), "provenance": provenance(command, model, [*read, *files])}


def of_survey(m: Loaded, s: Survey, command: str) -> tuple[dict[str, object], dict[str, Any]]:
    """The same of a survey that was made with ``m``, and what its report says about itself.

    Flights that could not be read are among the files, too.
    """
    from ragg_runtime.survey.journal import sha256  # slow to import, and only surveys need it

    files = [(r["file"], r["sha256"] if "sha256" in r else sha256(Path(r["file"]))) for r in s.records]
    read = [(r["flight"], digest) for r, (_, digest) in zip(s.records, files, strict=True) if digest]
    sources = [*loop.sources(m, []), *read]
    told = origin(m, [], command, files=files) | {"sources": [{"name": n, "sha256": d} for n, d in sources]}
    title = f"{m.name} and {len(s.records)} flights"
    return told, {"title": title, "command": command, "digest": m.model.digest, "sources": sources}


def notes(m: Loaded, flights: Sequence[Flight]) -> list[str]:
    """What was done to model directory and flights, or looks odd in them."""
    return [*m.notes, *(f"{x.name}: {note}" for x in flights for note in x.notes)]
