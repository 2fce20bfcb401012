"""The command line in the process of the tests, which has imported everything already."""

from __future__ import annotations

import contextlib
import io
import subprocess

from ragg_runtime.cli.main import main


def ragg(*arguments: object) -> subprocess.CompletedProcess[str]:
    """Exit status, stdout and stderr of a command. What is about processes or their streams needs one of its own."""
    words, status = list(map(str, arguments)), 0
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            main(words)
        except SystemExit as end:
            status = int(end.code or 0)
    return subprocess.CompletedProcess(words, status, out.getvalue(), err.getvalue())
