"""Nothing is left in the temporary folder, little becomes much there, and a compiler that hangs is not waited for."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import clear_stale, scratch, temporary_name
from ragg_runtime.flight import Flight, files, lines, read_flight
from ragg_runtime.flight.formats import open_file
from ragg_runtime.flight.source import Column, Look, Written
from ragg_runtime.model import native
from ragg_runtime.model.native import compiler
from ragg_runtime.workflow import loop

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="files without a name, scripts as compilers")

UNITS = (
    {"time": "s"} | {f"a_{k}": "g" for k in "xyz"} | {f"omega_{k}": "deg/h" for k in "xyz"} | {"G_out": "V"}
)


def bomb(path: Path, rows: int) -> Path:
    """A flight in which nothing changes but the time, and that by a fixed step."""
    schema = pa.schema([pa.field(n, pa.float64(), metadata={"units": u}) for n, u in UNITS.items()])
    with pq.ParquetWriter(path, schema, compression="zstd", use_byte_stream_split=["time"]) as writer:
        for start in range(0, rows, 1 << 18):
            n = min(1 << 18, rows - start)
            time_ = (start + np.arange(n)) / 16
            columns = [pa.array(time_ if name == "time" else np.full(n, 0.5)) for name in UNITS]
            writer.write_table(pa.Table.from_arrays(columns, schema=schema))
    return path


def test_a_file_that_unfolds_without_end_is_refused_before_it_fills_the_disc(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "empty"))
    (tmp_path / "empty").mkdir()
    path = bomb(tmp_path / "bomb.parquet", 1 << 21)
    monkeypatch.setattr(files, "UNFOLDS", (1 << 27) / path.stat().st_size * 0.8)
    laid: list[int] = []
    spooled = files.spooled

    def counted(parts: Iterable[Flight]) -> Iterator[Flight]:
        for x in parts:
            laid.append(x.time.nbytes * (len(x.channels) + 3))
            yield x

    def watched(parts: Iterable[Flight], *others: Any) -> Flight:
        return spooled(counted(parts), *others)

    monkeypatch.setattr(files, "spooled", watched)
    with pytest.raises(UserError, match="unfolds to more than a record can be compressed"):
        read_flight(path, 9.8)
    assert sum(laid) <= files.UNFOLDS * path.stat().st_size  # and no more was on the disk on the way
    assert list((tmp_path / "empty").iterdir()) == []


def test_the_limit_is_far_above_what_a_record_compresses_to(tmp_path: Path) -> None:
    assert (1 << 24) * 8 * 8 / bomb(tmp_path / "bomb.parquet", 1 << 18).stat().st_size < files.UNFOLDS * 64
    assert files.UNFOLDS >= 100


def test_a_killed_command_leaves_nothing_of_a_long_flight(tmp_path: Path) -> None:
    path = bomb(tmp_path / "long.parquet", 1 << 20)
    place = tmp_path / "tmp"
    place.mkdir()
    script = (
        "import sys, time\nfrom ragg_runtime.flight import files\nfiles.UNFOLDS = 10**9\n"
        "f = files.read_flight(sys.argv[1], 9.8)\n"
        "print(len(f), flush=True); time.sleep(60)"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", script, str(path)],
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"TMPDIR": str(place)},
    )
    assert process.stdout is not None
    assert process.stdout.readline() == f"{1 << 20}\n"
    assert list(place.iterdir()) == []
    process.send_signal(signal.SIGKILL)
    process.wait()
    process.stdout.close()


def test_what_another_user_left_is_not_cleared(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "x.json"
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    left = Path(str(temporary_name(target)).replace(f"-{os.getpid()}-", f"-{dead.pid}-"))
    left.write_text("")
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 1)
    clear_stale(target)
    assert left.exists()
    monkeypatch.undo()
    clear_stale(target)
    assert not left.exists()


@pytest.mark.parametrize("when", ["version", "compiling"])
def test_a_compiler_that_hangs_is_given_up(
    when: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its children hold the pipes open; it was waited for 304 s."""
    script = tmp_path / "cc"
    hang = "sleep 300 & sleep 300"
    body = hang if when == "version" else f'case "$1" in --version) echo 1;; *) {hang};; esac'
    script.write_text(f"#!/bin/sh\n{body}\n")
    script.chmod(0o755)
    monkeypatch.setenv("CC", str(script))
    monkeypatch.delenv("RAGG_NATIVE", raising=False)
    monkeypatch.setattr("ragg_runtime.model.native.compiler.HANGING", 1.0)
    monkeypatch.setattr("ragg_runtime.model.native.compiler.ANSWERING", 1.0)
    start = time.monotonic()
    with pytest.raises(native.BuildError, match="does not answer within 1 s"):
        native.build({"a.c": "int f(void) { return 1; }\n"}, tmp_path / "cache")
    assert time.monotonic() - start < 8
    assert not list((tmp_path / "cache").glob(".*so"))


@pytest.mark.parametrize("when", ["version", "compiling"])
def test_a_command_with_a_compiler_that_hangs(when: str, tmp_path: Path) -> None:
    """It says what it waits for, gives up once, and goes on without; the figures are those of NumPy."""
    script = tmp_path / "cc"
    body = "sleep 300" if when == "version" else 'case "$1" in --version) echo 1;; *) sleep 300;; esac'
    script.write_text(f"#!/bin/sh\n{body}\n")
    script.chmod(0o755)
    model = loop.new(tmp_path / "model").directory.path
    flight = Path(loop.__file__).parents[2] / "examples" / "demo-flight.parquet"
    environment = os.environ | {
        "PYTHONPATH": str(Path(loop.__file__).parents[2]),
        "CC": str(script),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
    }
    environment.pop("RAGG_NATIVE", None)
    command = [sys.executable, "-m", "ragg_runtime", "compare", str(model), str(flight)]
    with subprocess.Popen(
        command, stderr=subprocess.PIPE, stdout=subprocess.PIPE, env=environment
    ) as process:
        assert process.stderr is not None
        told = [(time.monotonic(), line.decode()) for line in process.stderr]
        assert process.stdout is not None
        assert b"noise floor" in process.stdout.read()
    assert process.returncode == 0
    waited = [k for k, (_, line) in enumerate(told) if "waiting for the C compiler" in line]
    given_up = [k for k, (_, line) in enumerate(told) if "does not answer" in line]
    assert len(waited) == {"version": 1, "compiling": 2}[when]
    assert len(given_up) == 1
    assert "NumPy code serves" in told[given_up[0]][1]
    said = [at for at, _ in told[waited[0] : given_up[0] + 1]]
    assert all(later - at < 5.0 for at, later in pairwise(said))
    assert compiler.PATIENT < 5.0
    assert compiler.HANGING < 10.0


@pytest.mark.parametrize("cc", ['"unclosed', "gcc --no-such-option", "/", "/dev/null", "false"])
def test_an_odd_compiler_is_one_message(cc: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", cc)
    monkeypatch.delenv("RAGG_NATIVE", raising=False)
    with pytest.raises(native.BuildError):
        native.build({"a.c": "int f(void) { return 1; }\n"}, tmp_path / "cache")


def test_folders_of_killed_processes_are_cleared_from_the_temporary_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    script = (
        "import os\nfrom ragg_runtime.base.files import scratch\n"
        "with scratch() as folder:\n    (folder / 'x').write_text('x')\n    os._exit(9)"
    )
    environment = os.environ | {"TMPDIR": str(tmp_path), "PYTHONPATH": str(Path(loop.__file__).parents[2])}
    subprocess.run([sys.executable, "-c", script], env=environment, check=False)
    (left,) = tmp_path.iterdir()
    with scratch() as folder:
        assert [p for p in tmp_path.iterdir() if p != folder] == []
    assert not left.exists()
    assert list(tmp_path.iterdir()) == []


def test_a_table_of_lines_is_laid_down_without_a_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """400 MB of a killed command stood in the temporary folder."""
    monkeypatch.setattr(lines, "HELD", 1000)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "tmp"))
    (tmp_path / "tmp").mkdir()
    n = 500
    columns = [(Column("line", "1"), np.repeat([1.0, 2.0], n)), (Column("time", "s"), np.arange(2.0 * n))]
    files.write_tables(tmp_path / "x.csv", lambda: [Written(columns)])
    (table,) = open_file(tmp_path / "x.csv", Look())
    one, two = lines.split(table, "line")
    assert list((tmp_path / "tmp").iterdir()) == []
    for part, first in ((one, 0), (two, n)):
        times = np.concatenate([b["time"] for b in part.batches()])
        np.testing.assert_array_equal(times, np.arange(first, first + n))
