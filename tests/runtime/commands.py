"""The command line in the process of the tests, which has imported everything already."""

from __future__ import annotations

import contextlib
import io
import json
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from docs import made
from ragg_runtime.cli.main import main


def ragg(*arguments: object) -> subprocess.CompletedProcess[str]:
    """Exit status, stdout and stderr of a command, whose JSON the reference page must explain.

    What is about processes or their streams needs one of its own.
    """
    words, status = list(map(str, arguments)), 0
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            main(words)
        except SystemExit as end:
            status = int(end.code or 0)
    if not status:
        require_meanings(words, out.getvalue())
    return subprocess.CompletedProcess(words, status, out.getvalue(), err.getvalue())


def require_meanings(words: Sequence[str], printed: str) -> None:
    """KeyError if the page of JSON has no meaning of a key that the command wrote."""
    if "--json" not in words or words[0] == "export":
        return
    name = words[words.index("--json") + 1]
    if name == "-" or Path(name).is_file():
        explain(words[0], json.loads(printed if name == "-" else Path(name).read_text("utf-8")))


def explain(command: str, document: Any) -> None:
    """KeyError if the page of JSON has no meaning of a key of this command's document."""
    meanings = made.read_meanings()
    for path, _ in made.keys(document):
        made.meaning(command, path, meanings)
