"""Fly the benchmark of the diagnosis: resumable, with progress; writes docs/diagnosis.md once complete."""

from __future__ import annotations

import argparse
import hashlib
import json
import multiprocessing
import sys
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from benchmarks.diagnosis import plan, table
from benchmarks.diagnosis.fly import fly
from benchmarks.diagnosis.plan import Spec

ROOT = Path(__file__).resolve().parents[2]
CACHE = ROOT / "build" / "bench-diagnosis.jsonl"
PAGE = ROOT / "docs" / "diagnosis.md"

ROOMS = (
    "base",
    "diagnosis",
    "evidence",
    "fit",
    "flight",
    "instrument",
    "lack_of_fit",
    "model",
    "model_dir",
    "plausibility",
    "reference",
    "signals",
)
"""Of the runtime: what the result of a flight depends on; a change elsewhere (reports, commands) flies nothing anew."""

SOURCES = (
    "generated/manifest.json",
    "derive/**/*.py",
    *(f"ragg_runtime/{room}/**/*.py" for room in ROOMS),
    *(f"benchmarks/diagnosis/{name}.py" for name in ("fly", "inject", "outside", "peers")),
)


def source_digest(root: Path = ROOT) -> str:
    """Digest of the sources that a flight's result depends on.

    Raises
    ------
    FileNotFoundError
        A pattern of ``SOURCES`` names no file: it has moved, and its changes would go unseen.
    """
    digest = hashlib.sha256()
    for pattern in SOURCES:
        paths = sorted(root.glob(pattern))
        if not paths:
            raise FileNotFoundError(f"no file is called {pattern}; name what took its place in SOURCES")
        for path in paths:
            digest.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:12]


def read(cache: Path) -> Iterator[dict[str, Any]]:
    """Lines of a cache; one cut off by an interruption is left out."""
    if not cache.exists():
        return
    for text in cache.read_text("utf-8").splitlines():
        try:
            yield json.loads(text)
        except json.JSONDecodeError:
            continue


def finished(
    lines: Iterator[dict[str, Any]], specs: Sequence[Spec], source: str | None
) -> dict[str, dict[str, Any]]:
    """The newest line of every planned flight, of this source version (``None``: of any)."""
    wanted = {s.id: s.digest for s in specs}
    return {
        x["id"]: x
        for x in lines
        if wanted.get(x["id"]) == x["plan"] and (source is None or x["source"] == source)
    }


def run(specs: Sequence[Spec], cache: Path, jobs: int, source: str, sample: int = 0) -> None:
    """Fly specs, appending a line to the cache as each is done; an interruption loses only those in the air."""
    cache.parent.mkdir(parents=True, exist_ok=True)
    if cache.exists() and not cache.read_bytes().endswith(b"\n"):
        with cache.open("a", encoding="utf-8") as file:
            file.write("\n")
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(elapsed_when_finished=False),
    )
    with (
        Progress(*columns, console=Console(stderr=True)) as progress,
        cache.open("a", encoding="utf-8") as file,
    ):
        task = progress.add_task("flights", total=len(specs))

        def done(spec: Spec, result: Mapping[str, object]) -> None:
            line: dict[str, object] = {"id": spec.id, "kind": spec.kind, "plan": spec.digest}
            line |= {"source": source, "seed": sample} | dict(result)
            file.write(json.dumps(line) + "\n")
            file.flush()
            progress.update(task, advance=1, description=spec.id)

        if jobs == 1:
            for spec in specs:
                done(spec, fly(spec))
            return
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(jobs, mp_context=context) as pool:
            flying: dict[Future[dict[str, object]], Spec] = {pool.submit(fly, s): s for s in specs}
            try:
                while flying:
                    for future in wait(flying, return_when=FIRST_COMPLETED).done:
                        done(flying.pop(future), future.result())
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.diagnosis", description=__doc__)
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--only", action="append", choices=list(plan.COUNTS), help="kinds of flights")
    parser.add_argument(
        "--seed",
        type=int,
        default=plan.PAGE,
        help=f"which sample of flights (default, that of the page in docs: {plan.PAGE})",
    )
    parser.add_argument("--flights", type=int, help="at most so many of each kind")
    parser.add_argument(
        "--flight", action="append", default=[], metavar="KIND/NUMBER", help="show one flight"
    )
    parser.add_argument("--cache", type=Path, default=CACHE, help="results, a JSON line a flight")
    parser.add_argument("--keep", action="store_true", help="keep results of other versions of the sources")
    parser.add_argument(
        "--page", type=Path, help="written once all flights are done (default sample: docs/diagnosis.md)"
    )
    parser.add_argument("--table", action="store_true", help="fly nothing: print the page of what is there")
    options = parser.parse_args(arguments)
    for name in options.flight:
        kind, _, number = name.partition("/")
        print(json.dumps(fly(plan.spec(kind, int(number), options.seed)), indent=1))
    if options.flight:
        return 0
    source = source_digest()
    everything = plan.specs(sample=options.seed)
    chosen = plan.specs(options.only, options.flights, options.seed)
    accepted = None if options.keep or options.table else source
    if not options.table:
        have = finished(read(options.cache), chosen, accepted)
        print(f"{len(have)} of {len(chosen)} flights are done already", file=sys.stderr)
        try:
            run([s for s in chosen if s.id not in have], options.cache, options.jobs, source, options.seed)
        except KeyboardInterrupt:
            print("interrupted: run it again to go on", file=sys.stderr)
            return 130
    lines = list(finished(read(options.cache), everything, accepted).values())
    text = table.page(lines, complete=len(lines) == len(everything), sample=options.seed)
    print(text)
    page = options.page or (PAGE if options.seed == plan.PAGE else None)
    if page is not None and len(lines) == len(everything) and not options.table:
        page.write_text(text, "utf-8")
        print(f"written: {page}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
