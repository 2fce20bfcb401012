"""Fly the benchmark of the diagnosis, or the ablation, with progress and resumably; print the tables, write files.

python -m benchmarks.diagnosis [--seed N ...] [--jobs N] [--only KIND] [--save FILE] [--against FILE]
python -m benchmarks.diagnosis --array [--real FOLDER]     questions asked of the real array
python -m benchmarks.diagnosis --ablate [--rule ID ...] [--jobs N]
python -m benchmarks.diagnosis --record KIND ... [--count N] [--seed N]      nothing hidden, one kind of record
python -m benchmarks.diagnosis --ceiling [--jobs N]        what an oracle finds of weak effects
python -m benchmarks.diagnosis --flight ID      one flight, shown
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import json
import multiprocessing
import subprocess
import sys
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import nullcontext, suppress
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks.diagnosis import ablation, array, ceiling, plan, records, score, table
from benchmarks.diagnosis.fly import fly
from benchmarks.diagnosis.plan import Spec
from benchmarks.diagnosis.score import Row

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CACHE = ROOT / "build" / "bench-diagnosis.jsonl"
RESULTS = {n: HERE / f"{n}.csv" for n in ("reference", "ceiling", "ablation", "array")}

SOURCES = ("generated", "derive", "ragg_runtime", "benchmarks/diagnosis")
"""What the result of a flight depends on."""


def source_digest() -> str:
    """Of the sources."""
    digest = hashlib.sha256()
    for path in sorted(p for folder in SOURCES for p in (ROOT / folder).rglob("*.py")):
        digest.update(path.relative_to(ROOT).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:12]


def commit() -> str:
    """The commit that is checked out."""
    words = ["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"]
    return subprocess.run(words, capture_output=True, text=True, check=False).stdout.strip()


class Cache:
    """Results that are there: a line of JSON each, by their key; a line that was cut off by an interruption is left out."""

    def __init__(self, path: Path, source: str) -> None:
        self.path, self.source = path, source
        self.lines: dict[str, dict[str, Any]] = {}
        text = path.read_text("utf-8") if path.exists() else ""
        if text and not text.endswith("\n"):
            path.write_text(text + "\n", "utf-8")
        for one in text.splitlines():
            with suppress(json.JSONDecodeError):
                x = json.loads(one)
                if x["source"] == source:
                    self.lines[x["key"]] = x

    def add(self, key: str, x: dict[str, Any]) -> None:
        x = {"key": key, "source": self.source} | x
        self.lines[key] = x
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(x) + "\n")


Task = Callable[[], dict[str, Any]]


def run(tasks: dict[str, Task], cache: Cache, jobs: int) -> None:
    """Do what is not done yet; an interruption loses only what is in the air."""
    missing = {k: t for k, t in tasks.items() if k not in cache.lines}
    at = {"commit": commit()}
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, spawn) if jobs > 1 else nullcontext() as pool:
        flying = {} if pool is None else {pool.submit(t): k for k, t in missing.items()}
        done = ((flying[future], future.result()) for future in as_completed(flying))
        try:
            for n, (key, result) in enumerate(done if flying else ((k, t()) for k, t in missing.items())):
                cache.add(key, at | result)
                print(f"\r{n + 1} of {len(missing)} of {len(tasks)}: {key}\033[K", end="", file=sys.stderr)
        except BaseException:
            if pool is not None:
                pool.shutdown(cancel_futures=True)
            raise


def read_rows(path: Path) -> list[Row]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def write_rows(rows: Iterable[Row], path: Path) -> None:
    rows = list(rows)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    print(f"written: {path}", file=sys.stderr)


def committed_page() -> str:
    """The page of the site, from the results that are committed."""
    return table.page({n: read_rows(p) for n, p in RESULTS.items()})


def _run_mode(o: argparse.Namespace, cache: Cache) -> list[Row]:
    """Carry out a mode, print its table."""
    seeds = o.seed or plan.REFERENCE
    if o.mode == "array":
        tasks: dict[str, Task] = {f"{r}/{c}": partial(array.asked, p, c) for r, p, c in array.cases(o.real)}
    elif o.mode == "ceiling":
        weak = [s for n in seeds for s in plan.specs(n) if s.kind in ("five", "ten")]
        tasks = {s.id: partial(ceiling.tested, s) for s in weak}
    elif o.mode == "record":
        own = o.seed or [plan.RECORDS]
        specs = [Spec("quiet", r, k, n) for r in o.record for n in own for k in range(o.count)]
        tasks = {s.id: partial(fly, s) for s in specs}
    else:
        specs = [s for n in seeds for s in plan.specs(n) if not o.only or s.kind in o.only]
        tasks = {s.id: partial(fly, s) for s in specs}
    run(tasks, cache, o.jobs)
    found = [(key, cache.lines[key]) for key in tasks]
    if o.mode == "array":
        rows, show = [row for key, line in found for row in array.rows(key, line)], table.array
    elif o.mode == "ceiling":
        rows = [{n: str(v) for n, v in line.items() if n not in ("key", "source")} for _, line in found]
        show = table.ceiling
    else:
        rows = [score.row(line) for _, line in found]
        show = table.quiet_records if o.mode == "record" else table.flights
    print("\n" + "\n".join(show(rows)))
    if o.against is not None:
        print("\n".join(table.against(rows, read_rows(o.against))))
    return rows


def _ablate(o: argparse.Namespace, cache: Cache) -> list[Row]:
    rows = []
    for r in (r for r in ablation.RULES if not o.rule or r.id in o.rule):
        flights = ablation.flights(r)
        run({f"/{s.id}": partial(ablation.watched, s) for s in flights}, cache, o.jobs)
        acting = [s for s in flights if ablation.acts(r, cache.lines[f"/{s.id}"])]
        run({f"{r.id}/{s.id}": partial(ablation.without, r.id, s) for s in acting}, cache, o.jobs)
        rows.append(ablation.row(r, flights, cache.lines))
        print("\n" + "\n".join(table.ablation(rows[-1:])), flush=True)
    print("\n".join(table.ablation(rows)))
    return rows


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.diagnosis")
    ask = parser.add_argument
    ask("--seed", type=int, action="append", help="which flights (default: the reference's)")
    ask("--only", action="append", choices=list(plan.COUNTS), help="kinds of flights")
    ask("--flight", action="append", default=[], metavar="ID", help="show one flight")
    mode = partial(ask, action="store_const", dest="mode")
    mode("--array", const="array", help="ask the real array instead")
    mode("--ceiling", const="ceiling", help="what an oracle that knows the noise finds of weak effects")
    mode("--ablate", const="ablation", help="without one rule after the other")
    ask("--record", action="append", choices=list(records.KINDS), help="one kind of record, nothing hidden")
    ask("--count", type=int, default=40, help="flights of each of these")
    ask("--real", type=Path, metavar="FOLDER", help="its recordings, *.bin.gz (default: what is shipped)")
    ask("--rule", action="append", choices=[r.id for r in ablation.RULES], help="of the ablation")
    ask("--jobs", type=int, default=1, help="processes")
    ask("--cache", type=Path, default=CACHE, help="results, a JSON line each")
    ask("--save", type=Path, metavar="CSV", help="keep the results in short")
    ask("--against", type=Path, metavar="CSV", help="compare flight by flight with results in short")
    o = parser.parse_args(arguments)
    for name in o.flight:
        sample, kind, record, index = name.split("/")
        print(json.dumps(fly(Spec(kind, record, int(index), int(sample))), indent=1))
    if o.flight:
        return 0
    o.mode = o.mode or ("record" if o.record else "flights")
    path = o.cache if o.mode in ("flights", "record") else o.cache.with_stem(f"{o.cache.stem}-{o.mode}")
    try:
        rows = (_ablate if o.mode == "ablation" else _run_mode)(o, Cache(path, source_digest()))
    except KeyboardInterrupt:
        print("interrupted: run it again to go on", file=sys.stderr)
        return 130
    if o.save is not None:
        write_rows(rows, o.save)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
