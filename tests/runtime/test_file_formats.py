"""Every format of the field keeps names, units, lines and every number."""

from __future__ import annotations

import errno
import itertools
import os
import shutil
from pathlib import Path

import numpy as np
import openpyxl
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.io.files import convert, write_tables
from ragg_runtime.io.formats import open_file
from ragg_runtime.io.netcdf_file import room
from ragg_runtime.io.source import Heading, Look, Written
from ragg_runtime.io.sources import open_sources
from tests.runtime.foreign_files import ENDINGS, write

WRITTEN = (".csv", ".csv.gz", ".parquet", ".nc")
UNITS = {"time": "s", "a_x": "g", "omega_y": "deg/h", "inline": "Eo", "fuel": "kg"}


def made(n: int, lines: tuple[str, ...], seed: int = 0) -> list[Written]:
    rng = np.random.default_rng(seed)
    found = []
    for k, line in enumerate(lines or (None,)):
        columns = [(Heading("time", "s"), np.arange(n + k) / 3.0)]
        for name in ("a_x", "omega_y", "inline", "fuel"):
            values = np.round(rng.normal(size=n + k), 9) * 10.0 ** rng.integers(-12, 12)
            values[rng.integers(0, n + k)] = np.nan
            columns.append((Heading(name, UNITS[name]), values))
        found.append(Written(columns, line))
    return found


def content(path: Path) -> dict[str | None, dict[str, tuple[str, np.ndarray]]]:
    found = {}
    for s in open_sources(path, lenient=True):
        rows = s.rows()
        found[s.line] = {c.name: (c.unit, rows[c.name]) for c in s.columns}
    return found


def same(left: dict, right: dict, rtol: float = 0.0) -> None:
    assert list(left) == list(right)
    for line, columns in left.items():
        assert list(columns) == list(right[line])
        for name, (unit, values) in columns.items():
            assert unit == right[line][name][0], name
            np.testing.assert_allclose(right[line][name][1], values, rtol=rtol, atol=0.0, err_msg=name)


def expected(tables: list[Written]) -> dict:
    several = len(tables) > 1
    return {t.line if several else None: {c.name: (c.unit, v) for c, v in t.columns} for t in tables}


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize("lines", [(), ("10", "20.5", "1030"), ("1010", "T20", "north 3")])
def test_round_trip(tmp_path: Path, ending: str, lines: tuple[str, ...]) -> None:
    if lines and ending == ".mat":
        lines = ("10", "20", "30")  # names of structures
    tables = made(40, lines)
    found = content(write(tmp_path / f"x{ending}", tables))
    if ending == ".nc":  # names of lines are words in the CF conventions
        found = {None if k is None else k.replace("_", " "): v for k, v in found.items()}
    same(expected(tables), found, rtol=1e-15 if ending == ".xlsx" else 0.0)  # openpyxl writes 16 digits


@pytest.mark.parametrize("pair", list(itertools.pairwise((*WRITTEN, WRITTEN[0]))))
def test_converted_there_and_back(tmp_path: Path, pair: tuple[str, str]) -> None:
    first, second = (tmp_path / f"{n}{e}" for n, e in zip("ab", pair, strict=True))
    back = tmp_path / f"c{pair[0]}"
    write_tables(first, made(25, ("7", "8")))
    told = convert(first, second)
    assert (told.lines, told.rows) == (2, 51)
    convert(second, back)
    same(content(first), content(back))


@pytest.mark.parametrize("ending", [".h5", ".mat", ".xlsx"])
def test_formats_that_are_read_alone(tmp_path: Path, ending: str) -> None:
    source = write(tmp_path / "x.csv", made(5, ()))
    with pytest.raises(UserError, match=r"are read, not written") as refused:
        convert(source, tmp_path / f"y{ending}")
    assert ".parquet" in refused.value.message
    assert [p.name for p in tmp_path.iterdir()] == ["x.csv"]


def test_lines_in_a_column(tmp_path: Path) -> None:
    path = tmp_path / "x.csv"
    path.write_text("line [1],time [s],v [V]\n10,0,1\n20,0,2\n,9,9\n10,1,3\n20,1,4\n")
    found = content(path)
    assert {k: v["v"][1].tolist() for k, v in found.items()} == {"10": [1.0, 3.0], "20": [2.0, 4.0]}
    path.write_text("line [1],time [s],v [V]\n10,0,1\n10,1,3\n")
    assert list(content(path)) == [None]


@pytest.mark.parametrize("ending", ENDINGS)
def test_look_takes_only_what_is_asked_for(tmp_path: Path, ending: str) -> None:
    path = write(tmp_path / f"x{ending}", made(5, ()))
    (table,) = open_file(path, Look(only=frozenset(("time", "fuel"))))
    assert {h.name for h in table.headings} == set(table.rows()) == {"time", "fuel"}


def test_a_file_into_itself(tmp_path: Path) -> None:
    path = write(tmp_path / "x.csv", made(5, ()))
    with pytest.raises(UserError, match="itself"):
        convert(path, path)


def test_a_workbook_is_not_computed(tmp_path: Path) -> None:
    path = tmp_path / "x.xlsx"
    book = openpyxl.Workbook()
    book.active.append(["time [s]", "v [V]"])
    book.active.append([0.0, '=1/0+WEBSERVICE("http://127.0.0.1")'])
    book.active.append([1.0, 2.0])
    book.save(path)
    _, values = content(path)[None]["v"]
    assert np.isnan(values[0])  # the file holds no value
    assert values[1] == 2.0


def test_units_below_the_names_in_a_workbook(tmp_path: Path) -> None:
    path = tmp_path / "x.xlsx"
    book = openpyxl.Workbook()
    for row in (["a survey"], ["time", "v"], ["s", "mV"], [0.0, 1.0], [1.0, None], [2.0, 3]):
        book.active.append(row)
    book.save(path)
    found = content(path)[None]
    assert [(n, u) for n, (u, _) in found.items()] == [("time", "s"), ("v", "mV")]
    np.testing.assert_array_equal(found["v"][1], [1.0, np.nan, 3.0])


def test_a_disc_without_room_is_asked_beforehand(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """HDF5 does not survive a write that fails: it ended in a crash as the process ended."""
    path, tables = tmp_path / "x.nc", made(500, ())
    size = room([500] * 5)
    full = shutil.disk_usage(tmp_path)._replace(free=size - 1)
    with monkeypatch.context() as patch:
        patch.setattr(shutil, "disk_usage", lambda place: full)
        with pytest.raises(UserError, match=os.strerror(errno.ENOSPC)):
            write_tables(path, tables)
    assert list(tmp_path.iterdir()) == []
    write_tables(path, tables)
    assert path.stat().st_size <= size
