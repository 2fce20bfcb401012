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
import hashlib
import json
import multiprocessing
import operator
import sys
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import nullcontext, suppress
from functools import partial
from pathlib import Path
from typing import Any

from pandas import DataFrame

from benchmarks import ROOT, commit
from benchmarks.diagnosis import ablation, plan, records, score
from benchmarks.diagnosis.fly import fly, tested
from benchmarks.diagnosis.plan import Spec
from examples.mimu import elsewhere

CACHE = ROOT / "build" / "bench-diagnosis.jsonl"

# What the result of a flight depends on
SOURCES = ("generated", "derive", "ragg_runtime", "benchmarks/diagnosis")
Task = Callable[[], dict[str, Any]]


class Cache:
    """Results of these sources that are there: a line of JSON each, by their key."""

    def __init__(self, path: Path) -> None:
        digest = hashlib.sha256()
        for file in sorted(p for folder in SOURCES for p in (ROOT / folder).rglob("*.py")):
            digest.update(file.relative_to(ROOT).as_posix().encode() + b"\0" + file.read_bytes() + b"\0")
        self.path, self.at = path, {"source": digest.hexdigest()[:12], "commit": commit()}
        self.lines: dict[str, dict[str, Any]] = {}
        for line in path.read_text("utf-8").splitlines() if path.exists() else ():
            with suppress(json.JSONDecodeError):  # of a line that was cut off by an interruption
                x = json.loads(line)
                if x["source"] == self.at["source"]:
                    self.lines[x["key"]] = x

    def run(self, tasks: Mapping[str, Task], jobs: int) -> list[dict[str, Any]]:
        """The results of tasks; what is not there is done, and an interruption loses only what is in the air."""
        missing = {k: t for k, t in tasks.items() if k not in self.lines}
        self.path.parent.mkdir(parents=True, exist_ok=True)
        spawn = multiprocessing.get_context("spawn")
        with (
            self.path.open("a", encoding="utf-8") as file,
            ProcessPoolExecutor(jobs, spawn) if jobs > 1 else nullcontext() as pool,
        ):
            results = (pool.map if pool else map)(operator.call, missing.values())
            for n, (key, result) in enumerate(zip(missing, results, strict=True), 1):
                self.lines[key] = {"key": key} | self.at | result
                print("\n" + json.dumps(self.lines[key]), end="", file=file, flush=True)
                print(f"\r{n} of {len(missing)} of {len(tasks)}: {key}\033[K", end="", file=sys.stderr)
        return [self.lines[key] for key in tasks]


def fly_plan(o: argparse.Namespace, cache: Cache) -> DataFrame:
    """All flights of the seeds, or those of some kinds."""
    specs = [s for n in o.seed or plan.REFERENCE for s in plan.specs(n) if not o.only or s.kind in o.only]
    return _fly(specs, score.flights, o, cache)


def fly_records(o: argparse.Namespace, cache: Cache) -> DataFrame:
    """Flights of some kinds of record, with nothing hidden."""
    seeds = o.seed or [plan.RECORDS]
    specs = [Spec("quiet", r, k, n) for r in o.record for n in seeds for k in range(o.count)]
    return _fly(specs, score.quiet_records, o, cache)


def _fly(
    specs: Sequence[Spec], show: Callable[[DataFrame], str], o: argparse.Namespace, cache: Cache
) -> DataFrame:
    lines = cache.run({s.id: partial(fly, s) for s in specs}, o.jobs)
    rows = DataFrame([score.row(x) for x in lines])
    print(f"\n{show(rows)}")
    if o.against is not None:
        print(score.against(rows, score.read(o.against)))
    return rows


def find_ceiling(o: argparse.Namespace, cache: Cache) -> DataFrame:
    """What an oracle finds of weak effects."""
    specs = [s for n in o.seed or plan.REFERENCE for s in plan.specs(n) if s.kind in ("five", "ten")]
    lines = cache.run({f"ceiling/{s.id}": partial(tested, s) for s in specs}, o.jobs)
    rows = DataFrame(lines).drop(columns=["key", "source"]).astype(str)
    print(f"\n{score.ceiling(rows)}")
    return rows


def ask_array(o: argparse.Namespace, cache: Cache) -> DataFrame:
    """The questions of ``examples.mimu.elsewhere``, asked of the record that is shipped, or of recordings in a folder."""
    paths = sorted(o.real.glob("*.bin.gz")) if o.real else [None]
    names = {p: p.name.removesuffix(".bin.gz") if p else "shipped" for p in paths}
    tasks = {
        f"{name}/{case}": partial(elsewhere.answer, path, case)
        for path, name in names.items()
        for case in (elsewhere.CASES if path else elsewhere.SHIPPED)
    }
    rows = []
    for x in cache.run(tasks, o.jobs):
        recording, _, case = x["key"].partition("/")
        for a in x["answers"]:
            row = {"recording": recording, "case": case} | a | {"commit": x["commit"]}
            rows.append(row | {"holds": str(int(a["holds"])), "unfounded": "+".join(a["unfounded"])})
    print(f"\n{score.array(DataFrame(rows))}")
    return DataFrame(rows)


def ablate(o: argparse.Namespace, cache: Cache) -> DataFrame:
    """A row a rule, printed as soon as it is known."""
    rows = []
    for r in (r for r in ablation.RULES if not o.rule or r.id in o.rule):
        specs = r.flights()[: o.count]
        on = cache.run({f"/{s.id}": partial(fly, s) for s in specs}, o.jobs)
        off = cache.run({f"{r.id}/{s.id}": partial(ablation.without, r.id, s) for s in specs}, o.jobs)
        rows.append(ablation.row(r, on, off))
        print(f"\n{score.ablation(DataFrame(rows[-1:]))}", flush=True)
    print(score.ablation(DataFrame(rows)))
    return DataFrame(rows)


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.diagnosis")
    ask = parser.add_argument
    ask("--seed", type=int, action="append", help="which flights (default: the reference's)")
    ask("--only", action="append", choices=list(plan.COUNTS), help="kinds of flights")
    ask("--flight", action="append", default=[], metavar="ID", help="show one flight")
    mode = partial(ask, action="store_const", dest="mode", default=fly_plan)
    mode("--array", const=ask_array, help="ask the real array instead")
    mode("--ceiling", const=find_ceiling, help="what an oracle that knows the noise finds of weak effects")
    mode("--ablate", const=ablate, help="without one rule after the other")
    ask("--record", action="append", choices=list(records.KINDS), help="one kind of record, nothing hidden")
    ask("--count", type=int, default=40, help="flights of each of these, or of each rule")
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
    try:
        rows = (fly_records if o.record else o.mode)(o, Cache(o.cache))
    except KeyboardInterrupt:
        print("interrupted: run it again to go on", file=sys.stderr)
        return 130
    if o.save is not None:
        rows.to_csv(o.save, index=False)
        print(f"written: {o.save}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
