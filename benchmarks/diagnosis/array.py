"""The questions of ``examples.mimu.elsewhere``, asked of the record that is shipped and of recordings in a folder."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from benchmarks.diagnosis.score import Row
from examples.mimu import elsewhere


def cases(folder: Path | None) -> Iterator[tuple[str, Path | None, str]]:
    """Name of a recording, its file (``None``: what is shipped), and the name of a case."""
    paths = [None] if folder is None else sorted(folder.glob("*.bin.gz"))
    for path in paths:
        name = "shipped" if path is None else path.name.removesuffix(".bin.gz")
        for case in elsewhere.SHIPPED if path is None else elsewhere.CASES:
            yield name, path, case


def asked(path: Path | None, case: str) -> dict[str, Any]:
    """The answers about a case."""
    begin = time.process_time()
    (c,) = (c for c in elsewhere.cases(path) if c.name == case)
    answers = [[a.question, a.holds, a.words, list(a.unfounded)] for a in elsewhere.questions(c)]
    return {"answers": answers, "cpu": round(time.process_time() - begin, 1)}


def rows(key: str, line: Mapping[str, Any]) -> list[Row]:
    """The answers in short."""
    recording, _, case = key.partition("/")
    return [
        {
            "recording": recording,
            "case": case,
            "question": question,
            "holds": str(int(holds)),
            "unfounded": "+".join(unfounded),
            "words": words,
            "commit": line["commit"],
        }
        for question, holds, words, unfounded in line["answers"]
    ]
