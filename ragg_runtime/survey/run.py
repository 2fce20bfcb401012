"""A survey: every flight diagnosed by itself, on this machine or on a cluster, and what they say together."""

from __future__ import annotations

import contextlib
from collections import Counter
from collections.abc import Callable, Generator, Iterator, Sequence
from pathlib import Path

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight.record import same_record
from ragg_runtime.survey import cluster, local
from ragg_runtime.survey.journal import Journal, journal
from ragg_runtime.survey.result import Survey
from ragg_runtime.survey.task import BETWEEN, CONTENT, Job, Record, divided, expanded, job

Progress = Callable[[int, int, Record | None], None]
"""Called with the number of flights done, of all, and the record just made (``None`` at the beginning)."""


def survey(
    text: str,
    path: Path,
    flights: Sequence[Path | str],
    *,
    jobs: int | None = None,
    scheduler: str | None = None,
    resume: Path | None = None,
    progress: Progress | None = None,
    mapping: tuple[str, str, bool] | None = None,
) -> Survey:
    """Diagnose flights one by one; each line of a file that has several is a flight.

    Parameters
    ----------
    text, path
        model.toml and where it stands.
    flights
        Files; the order does not matter, a file named twice counts once.
    jobs
        Worker processes on this machine (default: one per processor).
    scheduler
        Address of a dask.distributed scheduler, ``tcp://host:port``: its workers do it instead. What answers there
        can run code in this process: name addresses that you trust. Certificates are Dask's own configuration.
    resume
        Results file: what stands in it is not done again (flights in error are), what is done is added.
    mapping
        Text and place of the mapping by which flights are read, and whether it is the model's own.

    Raises
    ------
    UserError
        For bad input to the survey as a whole. A single flight that fails has its error in its record.
    """
    _check(flights, jobs, scheduler)
    given = job(text, path, cluster=scheduler is not None, mapping=mapping)
    files = expanded(given, ordered(flights))
    names = distinct_names(files)
    records: dict[str, Record] = {}
    with _kept(resume) as kept:
        if kept is not None:
            records |= kept.read(given, files)
        if progress is not None:
            progress(len(records), len(files), None)
        left = [f for f in files if f not in records]
        if left:
            with contextlib.closing(_examined(given, left, jobs, scheduler)) as found:
                for file, record in found:
                    records[file] = record = record | {"flight": names[file]}
                    if kept is not None:
                        kept.append(record)
                    if progress is not None:
                        progress(len(records), len(files), record)
    # what was kept may have been named among other files
    return Survey(tuple(once([records[f] | {"flight": names[f]} for f in files])))


def _check(flights: Sequence[Path | str], jobs: int | None, scheduler: str | None) -> None:
    if not flights:
        raise UserError("a survey needs flights", expected="one file or more")
    if jobs is not None and scheduler is not None:
        raise UserError("a survey runs on this machine or on a cluster", found="--jobs and --scheduler")
    if jobs is not None and jobs < 1:
        raise UserError("a survey needs a worker", where="--jobs", found=jobs, expected="1 or more")


def once(records: Sequence[Record]) -> Iterator[Record]:
    """The records; of those that are of one and the same record of an instrument the first, the others in error."""
    first: dict[str, str] = {}
    for r in records:
        same = r["file"] if CONTENT not in r else first.setdefault(r[CONTENT], r["file"])
        if same != r["file"]:
            error = {"kind": "input", "message": f"{r['file']}: {same_record(same)}"}
            yield {k: r[k] for k in ("flight", "file", "sha256")} | {"error": error}
        else:
            yield {k: v for k, v in r.items() if k != CONTENT}


def distinct_names(files: Sequence[str]) -> dict[str, str]:
    """File -> the flight's name: that of the file, with as many folders before it as tell it from all others."""
    split = {f: divided(f) for f in files}
    left, depth = {path for path, _ in split.values()}, 0
    known: dict[Path, str] = {}
    while left:
        depth += 1
        count = Counter(p.parts[-depth:] for p in left)
        known |= {p: "/".join(p.parts[-depth:]) for p in left if count[p.parts[-depth:]] == 1}
        left -= known.keys()
    return {
        f: known[path] + ("" if line is None else f"{BETWEEN}{line}") for f, (path, line) in split.items()
    }


def ordered(flights: Sequence[Path | str]) -> list[str]:
    """Absolute paths, each once, in the order of the names that the flights will have: what drifts is read in it."""
    names = distinct_names([str(Path(f).resolve()) for f in flights])
    return sorted(names, key=lambda f: (names[f], f))


def _examined(
    given: Job, files: Sequence[str], jobs: int | None, scheduler: str | None
) -> Generator[tuple[str, Record]]:
    if scheduler is not None:
        return cluster.examined(given, files, scheduler)
    return local.examined(given, files, jobs or local.processors())


@contextlib.contextmanager
def _kept(resume: Path | None) -> Iterator[Journal | None]:
    if resume is None:
        yield None
    else:
        with journal(resume) as kept:
            yield kept
