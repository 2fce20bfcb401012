"""Fly the benchmark of the diagnosis, or the ablation, with progress and resumably; print the tables, write files.

python -m benchmarks.diagnosis [--seed N ...] [--jobs N] [--only KIND] [--real FOLDER] [--save FILE] [--against FILE]
python -m benchmarks.diagnosis --ablate [--rule ID ...] [--jobs N]
python -m benchmarks.diagnosis --catalogue [--jobs N]      each effect in turn, 30 sigma
python -m benchmarks.diagnosis --grammar [--jobs N]        terms drawn from a grammar
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
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, as_completed
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks.diagnosis import ablation, array, ceiling, plan, records, score, table
from benchmarks.diagnosis.fly import fly
from benchmarks.diagnosis.plan import Spec
from benchmarks.diagnosis.score import Row
from benchmarks.diagnosis.strength import NEVER
from ragg_runtime.model.model import load_packaged

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CACHE = ROOT / "build" / "bench-diagnosis.jsonl"
RESULTS = {n: HERE / f"{n}.csv" for n in ("reference", "ceiling", "grammar", "ablation", "array")}

ASIDE = ("report", "studio", "cli", "wording", "survey", "experiments", "compensation")
"""Of the runtime: what no diagnosis depends on; a change there flies nothing anew."""

OWN = ("plan", "records", "strength", "outside", "fly")


def source_digest(root: Path = ROOT) -> str:
    """Of the sources that a flight's result depends on."""
    paths = [root / "generated" / "manifest.json", *(root / "derive").rglob("*.py")]
    paths += (root / "ragg_runtime").glob("*.py")
    for package in sorted((root / "ragg_runtime").iterdir()):
        if package.is_dir() and package.name not in ASIDE:
            paths += package.rglob("*.py")
    paths += [root / "benchmarks" / "diagnosis" / f"{n}.py" for n in OWN]
    digest = hashlib.sha256()
    for path in sorted(paths):
        digest.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
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


def run(tasks: dict[str, Task], cache: Cache, pool: Executor | None = None) -> None:
    """Do what is not done yet; an interruption loses only what is in the air."""
    missing = {k: t for k, t in tasks.items() if k not in cache.lines}
    at = {"commit": commit()}
    flying = {} if pool is None else {pool.submit(t): k for k, t in missing.items()}
    results = ((k, t()) for k, t in missing.items())
    if flying:
        results = ((flying[future], future.result()) for future in as_completed(flying))
    try:
        for n, (key, result) in enumerate(results):
            cache.add(key, at | result)
            print(f"\r{n + 1} of {len(missing)} of {len(tasks)}: {key}\033[K", end="", file=sys.stderr)
    except BaseException:
        for future in flying:
            future.cancel()
        raise


@contextmanager
def pool_of(jobs: int) -> Iterator[Executor | None]:
    """So many processes; none for one."""
    if jobs == 1:
        yield None
        return
    with ProcessPoolExecutor(jobs, mp_context=multiprocessing.get_context("spawn")) as pool:
        yield pool


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
    return table.page({n: read_rows(p) for n, p in RESULTS.items() if p.exists()})


Rows = Callable[[str, dict[str, Any]], list[Row]]
"""What is kept of a line of the cache, with its key."""


def _keep_flight(key: str, line: dict[str, Any]) -> list[Row]:
    return [score.row(line)]


def _keep_all(key: str, line: dict[str, Any]) -> list[Row]:
    return [{n: str(v) for n, v in line.items() if n not in ("key", "source")}]


MODES: dict[str, tuple[str, Rows, Callable[[Sequence[Row]], list[str]]]] = {
    "flights": ("which flights of the plan are diagnosed rightly", _keep_flight, table.flights),
    "catalogue": ("hide each effect of the catalogue in turn", _keep_flight, table.catalogue),
    "grammar": ("hide terms drawn from a grammar", _keep_flight, table.grammar),
    "record": ("one kind of record, nothing hidden", _keep_flight, table.quiet_records),
    "ceiling": ("what an oracle that knows the noise finds of weak effects", _keep_all, table.ceiling),
    "array": ("ask the real array instead", array.rows, table.array),
}
"""What can be run: in words, what is kept of a result, and the table of all."""


def _list_tasks(o: argparse.Namespace) -> dict[str, Task]:
    """What a mode has to do, by key."""
    seeds = o.seed or plan.REFERENCE
    if o.mode == "array":
        return {f"{r}/{c}": partial(array.asked, path, c) for r, path, c in array.cases(o.real)}
    if o.mode == "ceiling":
        weak = [s for n in seeds for s in plan.specs(n) if s.kind in ("five", "ten")]
        return {s.id: partial(ceiling.tested, s) for s in weak}
    if o.mode == "catalogue":
        searched = [e.id for e in load_packaged().candidates if e.searched and e.id not in NEVER]
        specs = plan.catalogue(len(searched))
    elif o.mode == "grammar":
        specs = plan.grammar()
    elif o.mode == "record":
        own = o.seed or [plan.RECORDS]
        specs = [s for r in o.record for n in own for s in plan.of_record(r, o.count, n)]
    else:
        specs = [s for n in seeds for s in plan.specs(n) if not o.only or s.kind in o.only]
    return {s.id: partial(fly, s) for s in specs}


def _run_mode(o: argparse.Namespace, cache: Cache, pool: Executor | None) -> list[Row]:
    _, keep, show = MODES[o.mode]
    tasks = _list_tasks(o)
    run(tasks, cache, pool)
    rows = [row for key in tasks for row in keep(key, cache.lines[key])]
    print("\n" + "\n".join(show(rows)))
    if o.against is not None:
        print("\n".join(table.against(rows, read_rows(o.against))))
    return rows


def _ablate(o: argparse.Namespace, cache: Cache, pool: Executor | None) -> list[Row]:
    rows = []
    for r in (r for r in ablation.RULES if not o.rule or r.id in o.rule):
        flights = ablation.flights(r)
        run({f"/{s.id}": partial(ablation.watched, s) for s in flights}, cache, pool)
        acting = [s for s in flights if ablation.acts(r, cache.lines[f"/{s.id}"])]
        run({f"{r.id}/{s.id}": partial(ablation.without, r.id, s) for s in acting}, cache, pool)
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
    for name in ("array", "catalogue", "ceiling", "grammar"):
        ask(f"--{name}", action="store_const", dest="mode", const=name, help=MODES[name][0])
    ask("--record", action="append", choices=list(records.KINDS), help=MODES["record"][0])
    ask("--count", type=int, default=40, help="flights of each of these")
    ask("--real", type=Path, metavar="FOLDER", help="its recordings, *.bin.gz (default: what is shipped)")
    ask(
        "--ablate",
        action="store_const",
        dest="mode",
        const="ablation",
        help="without one rule after the other",
    )
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
    cache = o.cache if o.mode in ("flights", "record") else o.cache.with_stem(f"{o.cache.stem}-{o.mode}")
    try:
        with pool_of(o.jobs) as pool:
            rows = (_ablate if o.mode == "ablation" else _run_mode)(o, Cache(cache, source_digest()), pool)
        if o.save is not None:
            write_rows(rows, o.save)
    except KeyboardInterrupt:
        print("interrupted: run it again to go on", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
