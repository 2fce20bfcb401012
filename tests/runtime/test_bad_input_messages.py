"""Every bad input of the table: exit status, one message with its facts, nothing changed."""

from __future__ import annotations

import re
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest
from bad_input_table import DOCS, TABLE, Row, inside, paragraph, ran, rows, stage, tree

ROWS = rows()


def test_the_table_is_large_and_its_names_are_different() -> None:
    assert len(ROWS) >= 60
    assert len({row.id for _, row in ROWS}) == len(ROWS)


def _without_numbers(text: str) -> str:
    return re.sub(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", "#", text)


@pytest.mark.parametrize("row", [pytest.param(row, id=f"{topic}: {row.id}") for topic, row in ROWS])
def test_bad_input(row: Row, tmp_path: Path) -> None:
    r = ran(row, tmp_path)
    assert r.status == row.status, r.out + r.err
    said = r.message if row.status else r.out
    for fact in row.says:
        assert fact in said, f"{fact!r} is not in: {said}"
    assert "Traceback" not in r.out + r.err
    assert r.before == r.after
    if row.status:
        assert r.out == ""
        assert len(re.findall(r"^(ragg: |Usage: )", r.message, re.MULTILINE)) == 1, r.message
        assert len(r.message) < 3000
    if r.message.startswith("Usage: ") and version("click") < "8.2":
        return  # the words of click, which were others then
    # up to the numbers, whose last digits are the machine's
    assert _without_numbers(paragraph(row, r)) in _without_numbers(DOCS.read_text("utf-8")), (
        "the documentation is not current; run: python tests/runtime/bad_input_table.py"
    )


PICKED = (
    ("model.toml", "a hostile expression"),
    ("The flight file", "a truncated gzip file"),
    ("Likely mistakes", "the sign of G_out reversed"),
)


@pytest.mark.parametrize(("topic", "name"), PICKED)
def test_as_a_process_of_its_own(topic: str, name: str, tmp_path: Path) -> None:
    row = next(row for row in TABLE[topic] if row.id == name)
    stage(tmp_path)
    with inside(tmp_path):
        row.make()
        before = tree(Path("model"))
        done = subprocess.run(
            [sys.executable, "-m", "ragg_runtime", *row.command],
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )
        assert done.returncode == 2
        assert done.stdout == ""
        for fact in row.says:
            assert fact in done.stderr
        assert "Traceback" not in done.stderr
        assert tree(Path("model")) == before


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory is read from /proc")
@pytest.mark.parametrize("name", ["10 GB of nothing (sparse CSV)", "a good header, then 10 GB of nothing"])
def test_ten_gigabytes_take_no_memory(name: str, tmp_path: Path) -> None:
    row = next(row for row in TABLE["The flight file"] if row.id == name)
    stage(tmp_path)
    program = (
        "import resource, runpy, sys; sys.argv = ['ragg', *sys.argv[1:]]\n"
        "try: runpy.run_module('ragg_runtime', run_name='__main__')\n"
        "finally: print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    )
    with inside(tmp_path):
        row.make()
        done = subprocess.run(
            [sys.executable, "-c", program, *row.command],
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )
    assert done.returncode == 2
    assert int(done.stdout) < 700_000  # kB; the program alone takes some 250 MB


def test_the_documentation_has_every_row_and_no_other() -> None:
    titles = [x for x in DOCS.read_text("utf-8").splitlines() if x.startswith("**")]
    assert len(titles) == len(ROWS)
