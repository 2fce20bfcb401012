"""Every format of the field keeps names, units, lines and every number; each reads what others' tools write."""

from __future__ import annotations

import errno
import itertools
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import file_digest
from ragg_runtime.flight import mat_file
from ragg_runtime.flight.convert import convert
from ragg_runtime.flight.files import write_tables
from ragg_runtime.flight.formats import ALL, open_file
from ragg_runtime.flight.hdf5_file import room_for
from ragg_runtime.flight.source import Column, Look, Written
from ragg_runtime.flight.sources import open_sources
from ragg_runtime.survey.journal import sha256

ENDINGS = (".csv", ".csv.gz", ".parquet", ".nc", ".h5", ".mat", ".xlsx", ".xyz", ".dat")
UNITS = {"time": "s", "a_x": "g", "omega_y": "deg/h", "inline": "Eo", "fuel": "kg", "odd [name]": "1"}

numbers = st.one_of(st.just(float("nan")), st.floats(allow_infinity=False, allow_nan=False))


def written(n: int, lines: tuple[str, ...], seed: int = 0) -> list[Written]:
    rng = np.random.default_rng(seed)
    found = []
    for k, line in enumerate(lines or (None,)):
        columns = [(Column("time", "s"), np.arange(n + k) / 3.0)]
        for name in ("a_x", "omega_y", "inline", "fuel"):
            values = rng.normal(size=n + k) * 10.0 ** rng.integers(-12, 12)
            values[rng.integers(0, n + k)] = np.nan
            columns.append((Column(name, UNITS[name]), values))
        found.append(Written(columns, line))
    return found


def content(path: Path) -> dict[str | None, dict[str, tuple[str, np.ndarray]]]:
    found = {}
    for s in open_sources(path, lenient=True):
        batches = list(s.batches())
        found[s.line] = {c.name: (c.unit, np.concatenate([b[c.name] for b in batches])) for c in s.columns}
    return found


def same(left: dict, right: dict, *, ordered: bool = True) -> None:
    kind = list if ordered else set
    assert list(left) == list(right)
    for line, columns in left.items():
        assert kind(columns) == kind(right[line])
        for name, (unit, values) in columns.items():
            assert unit == right[line][name][0], name
            assert values.tobytes() == np.where(values == values, right[line][name][1], values).tobytes(), (
                name
            )
            assert np.array_equal(np.isnan(values), np.isnan(right[line][name][1])), name


def expected(tables: list[Written]) -> dict:
    several = len(tables) > 1
    return {t.line if several else None: {c.name: (c.unit, v) for c, v in t.columns} for t in tables}


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize("lines", [(), ("10", "20.5", "1030"), ("L1", "T20", "north 3")])
def test_round_trip(tmp_path: Path, ending: str, lines: tuple[str, ...]) -> None:
    tables = written(40, lines)
    path = tmp_path / f"x{ending}"
    write_tables(path, lambda: tables)
    found = content(path)
    if ending == ".nc":  # names of lines are words in the CF conventions
        found = {None if k is None else k.replace("_", " "): v for k, v in found.items()}
    same(expected(tables), found)
    assert sorted(p.suffix for p in tmp_path.iterdir()) == (
        [".dat", ".dfn"] if ending == ".dat" else [path.suffix]
    )


@pytest.mark.parametrize("lines", [(), ("10", "1030")])
def test_matlab_73_with_units_of_any_length(
    tmp_path: Path, lines: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mat_file, "_LARGE", 0)
    tables = written(40, lines)
    write_tables(tmp_path / "x.mat", lambda: tables)
    assert (tmp_path / "x.mat").read_bytes().startswith(b"MATLAB 7.3")
    same(expected(tables), content(tmp_path / "x.mat"), ordered=False)


@settings(deadline=None, max_examples=25, suppress_health_check=list(HealthCheck))
@given(values=arrays(np.float64, st.integers(2, 12), elements=numbers), ending=st.sampled_from(ENDINGS))
def test_any_number_comes_back_to_the_last_bit(
    tmp_path_factory: pytest.TempPathFactory, values: np.ndarray, ending: str
) -> None:
    path = tmp_path_factory.mktemp("bits") / f"x{ending}"
    tables = [Written([(Column("time", "s"), np.arange(len(values)) * 0.1), (Column("v", "V"), values)])]
    write_tables(path, lambda: tables)
    same(expected(tables), content(path))


@pytest.mark.parametrize("pair", list(itertools.pairwise((*ENDINGS, ENDINGS[0]))))
def test_converted_there_and_back(tmp_path: Path, pair: tuple[str, str]) -> None:
    first, second = (tmp_path / f"{n}{e}" for n, e in zip("ab", pair, strict=True))
    back = tmp_path / f"c{pair[0]}"
    tables = written(25, ("7", "8"))
    write_tables(first, lambda: tables)
    told = convert(first, second)
    assert (told.lines, told.rows) == (2, 51)
    convert(second, back)
    same(content(first), content(back))


@pytest.mark.parametrize("ending", [e for e in ENDINGS if e not in (".nc", ".h5")])
def test_equal_tables_give_equal_files(tmp_path: Path, ending: str) -> None:
    for name in "ab":
        write_tables(tmp_path / f"{name}{ending}", lambda: written(20, ("1", "2")))
    assert (tmp_path / f"a{ending}").read_bytes() == (tmp_path / f"b{ending}").read_bytes()


def test_every_format_is_registered_once() -> None:
    endings = [e for f in ALL for e in f.ENDINGS]
    assert len(endings) == len(set(endings))
    assert set(ENDINGS) <= set(endings)


def test_a_name_that_begins_like_a_formula_is_text(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    path = tmp_path / "x.xlsx"
    evil = "=1+1"
    write_tables(
        path, lambda: [Written([(Column("time", "s"), np.arange(3.0)), (Column(evil, "V"), np.ones(3))])]
    )
    cell = openpyxl.load_workbook(path).active["B1"]
    assert (cell.data_type, cell.value) == ("s", f"{evil} [V]")


def test_lines_in_a_column(tmp_path: Path) -> None:
    path = tmp_path / "x.csv"
    path.write_text("line [1],time [s],v [V]\n10,0,1\n20,0,2\n10,1,3\n20,1,4\n")
    found = content(path)
    assert {k: v["v"][1].tolist() for k, v in found.items()} == {"10": [1.0, 3.0], "20": [2.0, 4.0]}
    path.write_text("line [1],time [s],v [V]\n10,0,1\n10,1,3\n")
    assert list(content(path)) == [None]


def test_look_takes_only_what_is_asked_for(tmp_path: Path) -> None:
    for ending in ENDINGS:
        path = tmp_path / f"x{ending}"
        write_tables(path, lambda: written(5, ()))
        (table,) = open_file(path, Look(only=frozenset(("time", "fuel"))))
        assert {h.name for h in table.headings} == {"time", "fuel"}, ending
        assert set(next(iter(table.batches()))) == {"time", "fuel"}, ending


def test_a_file_into_itself(tmp_path: Path) -> None:
    path = tmp_path / "x.csv"
    write_tables(path, lambda: written(5, ()))
    with pytest.raises(UserError, match="itself"):
        convert(path, path)


def test_a_pair_of_files_is_one_record(tmp_path: Path) -> None:
    """Its digest is of both, neither is written over the other, and a survey's results know it."""
    path = tmp_path / "x.dat"
    write_tables(path, lambda: written(5, ()))
    definition = path.with_suffix(".dfn")
    digest = file_digest(path)
    assert digest == file_digest(definition) == sha256(path) == sha256(Path(f"{path}::1"))
    before = path.read_bytes(), definition.read_bytes()
    for one, other in ((path, definition), (definition, path)):
        with pytest.raises(UserError, match="itself"):
            convert(one, other)
    assert (path.read_bytes(), definition.read_bytes()) == before
    definition.write_text(definition.read_text("utf-8").replace("UNIT=s", "UNIT=h"), "utf-8")
    assert file_digest(path) != digest


def test_a_killed_writer_of_a_workbook_leaves_what_the_next_clears_away(tmp_path: Path) -> None:
    """Its sheets wait beside it under a name that tells whose they are, not in the temporary folder."""
    target = tmp_path / "x.xlsx"
    script = (
        "import os, sys\nfrom pathlib import Path\nimport numpy as np\n"
        "from ragg_runtime.base.files import replacing\nfrom ragg_runtime.flight import excel_file\n"
        "from ragg_runtime.flight.source import Column, Written\n"
        "excel_file._undated = lambda path: os._exit(9)\nimport openpyxl.worksheet._writer as w\n"
        "w.WorksheetWriter.cleanup = lambda self: None\n"
        "with replacing(Path(sys.argv[1])) as file:\n"
        "    excel_file.write_tables(file, [Written([(Column('time', 's'), np.arange(5.0))])])\n"
    )
    temporary = tmp_path / "tmp"
    temporary.mkdir()
    environment = os.environ | {"TMPDIR": str(temporary), "PYTHONPATH": str(Path(__file__).parents[2])}
    done = subprocess.run([sys.executable, "-c", script, str(target)], env=environment, check=False)
    assert done.returncode == 9
    assert len([p for p in tmp_path.iterdir() if p.name.startswith(".x.xlsx.")]) == 2
    assert list(temporary.iterdir()) == []
    write_tables(target, lambda: written(5, ()))
    assert sorted(p.name for p in tmp_path.iterdir()) == ["tmp", "x.xlsx"]


@pytest.mark.parametrize("ending", [".nc", ".h5"])
def test_a_disc_without_room_is_asked_beforehand(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ending: str
) -> None:
    """HDF5 does not survive a write that fails: it ended in a crash as the process ended."""
    path, tables = tmp_path / f"x{ending}", written(500, ("10", "20"))
    room = room_for(tables)
    full = shutil.disk_usage(tmp_path)._replace(free=room - 1)
    with monkeypatch.context() as patch:
        patch.setattr(shutil, "disk_usage", lambda place: full)
        with pytest.raises(UserError, match=os.strerror(errno.ENOSPC)):
            write_tables(path, lambda: tables)
    with monkeypatch.context() as patch:

        def over(handle: int, offset: int, size: int) -> None:
            raise OSError(errno.EDQUOT, os.strerror(errno.EDQUOT))

        patch.setattr(os, "posix_fallocate", over)
        with pytest.raises(UserError, match=os.strerror(errno.EDQUOT)):
            write_tables(path, lambda: tables)
    assert list(tmp_path.iterdir()) == []
    write_tables(path, lambda: tables)
    assert path.stat().st_size <= room


@pytest.mark.skipif(sys.platform == "win32", reason="limits of Unix")
def test_a_full_disc_amidst_a_workbook_is_one_message(tmp_path: Path) -> None:
    """What openpyxl had begun complained on stderr as it was cleared away."""
    write_tables(tmp_path / "x.csv", lambda: written(5000, ()))
    script = (
        "import resource, sys\nfrom ragg_runtime.cli.main import main\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))\nmain(sys.argv[1:])"
    )
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])}
    command = [sys.executable, "-c", script, "convert", str(tmp_path / "x.csv"), str(tmp_path / "y.xlsx")]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.startswith(f"ragg: {tmp_path / 'y.xlsx'}: the file cannot be written")
    assert len(done.stderr.splitlines()) == 2
    assert [p.name for p in tmp_path.iterdir()] == ["x.csv"]
