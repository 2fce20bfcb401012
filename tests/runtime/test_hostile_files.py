"""Files of strangers in the field's formats: one clear message, nothing executed, nothing read elsewhere, no endless memory."""

from __future__ import annotations

import struct
import zipfile
import zlib
from pathlib import Path

import h5py
import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.flight import excel_file, mat_file, read_flight
from ragg_runtime.flight.files import write_tables
from ragg_runtime.flight.source import Column, Written
from ragg_runtime.flight.sources import open_sources

NAMES = ("time", "a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z", "G_out")
UNITS = ("s", "g", "g", "g", "deg/s", "deg/s", "deg/s", "V")
ENDINGS = (".nc", ".h5", ".mat", ".xlsx", ".xyz", ".dat")


def good(path: Path, lines: tuple[str, ...] = ()) -> Path:
    rng = np.random.default_rng(1)
    tables = []
    for line in lines or (None,):
        columns = [(Column(n, u), rng.normal(size=60)) for n, u in zip(NAMES, UNITS, strict=True)]
        columns[0] = (columns[0][0], np.arange(60) / 16)
        tables.append(Written(columns, line))
    write_tables(path, lambda: tables)
    return path


def message(path: Path) -> str:
    with pytest.raises(UserError) as caught:
        for s in open_sources(path):
            list(s.batches())
    text = str(caught.value)
    assert len(text) < 3000
    assert "Traceback" not in text
    return text


@pytest.mark.parametrize("ending", ENDINGS)
def test_good_ones_are_read(tmp_path: Path, ending: str) -> None:
    assert len(read_flight(good(tmp_path / f"x{ending}"), 9.8)) == 60


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize("lines", [(), ("1", "2")])
def test_damaged_anywhere(tmp_path: Path, ending: str, lines: tuple[str, ...]) -> None:
    path = good(tmp_path / f"x{ending}", lines)
    data = path.read_bytes()
    rng = np.random.default_rng(2)
    for trial in range(60):
        broken = bytearray(data)
        if trial % 3 == 0:
            broken = broken[: rng.integers(1, len(data))]
        else:
            for place in rng.integers(0, len(data), rng.integers(1, 6)):
                broken[place] = rng.integers(0, 256)
        path.write_bytes(bytes(broken))
        try:
            for s in open_sources(path):
                for batch in s.batches():
                    assert all(v.dtype == np.float64 for v in batch.values())
        except UserError as error:
            assert len(str(error)) < 3000, str(error)[:500]


@pytest.mark.parametrize("ending", [".h5", ".nc", ".mat"])
def test_numbers_in_other_files_are_not_read(tmp_path: Path, ending: str) -> None:
    secret = tmp_path / "secret.bin"
    secret.write_bytes(np.arange(60.0).tobytes())
    good(tmp_path / "other.h5")
    path = tmp_path / f"x{ending}"
    for trick in ("external", "link", "virtual"):
        good(tmp_path / "base.h5")
        (tmp_path / "base.h5").replace(path)
        with h5py.File(path, "a") as file:
            del file["G_out"]
            if trick == "external":
                file.create_dataset("G_out", shape=(60,), dtype="f8", external=[(str(secret), 0, 480)])
            elif trick == "link":
                file["G_out"] = h5py.ExternalLink(str(tmp_path / "other.h5"), "/G_out")
            else:
                layout = h5py.VirtualLayout((60,), "f8")
                layout[:] = h5py.VirtualSource(str(tmp_path / "other.h5"), "G_out", (60,))
                file.create_virtual_dataset("G_out", layout)
            if trick != "link":
                file["G_out"].attrs["units"] = "V"
        assert "does not hold its numbers itself" in message(path), trick


def test_groups_in_a_circle_end(tmp_path: Path) -> None:
    path = good(tmp_path / "x.h5")
    with h5py.File(path, "a") as file:
        group = file
        for _ in range(40):
            group = group.create_group("deeper")
        group["round"] = file["/"]
    assert len(read_flight(path, 9.8)) == 60


def test_a_dataset_out_of_proportion(tmp_path: Path) -> None:
    path = tmp_path / "x.h5"
    with h5py.File(path, "w") as file:
        file.create_dataset("time", shape=(1 << 40,), dtype="f8", chunks=(1 << 16,)).attrs["units"] = "s"
    assert path.stat().st_size < 10_000
    assert "proportion" in message(path)


def test_a_matlab_bomb(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = good(tmp_path / "x.mat")
    squeezed = zlib.compress(bytes(8 << 20), 9)
    monkeypatch.setattr(mat_file, "MOST_BYTES", 1 << 20)
    path.write_bytes(path.read_bytes() + struct.pack("<II", 15, len(squeezed)) + squeezed)
    assert "proportion" in message(path)


def test_objects_and_functions_in_a_matlab_file_are_not_touched(tmp_path: Path) -> None:
    from scipy.io import savemat

    path = tmp_path / "x.mat"
    cell = np.empty(3, dtype=object)
    cell[:] = ["__import__('os').system('true')", "a", "b"]
    savemat(path, {"time": np.arange(3.0), "v": np.ones(3), "c": cell, "units": {"time": "s", "v": "V"}})
    (source,) = open_sources(path)
    assert [c.name for c in source.columns] == ["time", "v"]


def test_an_excel_bomb_and_formulas(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    path = tmp_path / "x.xlsx"
    book = openpyxl.Workbook()
    book.active.append(["time [s]", "v [V]"])
    book.active.append([0.0, '=1/0+WEBSERVICE("http://127.0.0.1")'])
    book.active.append([1.0, 2.0])
    book.save(path)
    (source,) = open_sources(path)
    values = next(iter(source.batches()))["v"]
    assert np.isnan(values[0])  # nothing is computed; the file holds no value
    assert values[1] == 2.0
    monkeypatch.setattr(excel_file, "MOST_BYTES", 100)
    assert "proportion" in message(path)


def test_entities_in_a_workbook_do_not_unfold(tmp_path: Path) -> None:
    path = good(tmp_path / "x.xlsx")
    with zipfile.ZipFile(path) as old:
        parts = {n: old.read(n) for n in old.namelist()}
    name = next(n for n in parts if "sheet1" in n)
    entities = b"".join(
        b'<!ENTITY l%d "%s">' % (k, b"&l%d;" % (k - 1) * 10 if k else b"lol") for k in range(30)
    )
    parts[name] = (
        parts[name]
        .replace(b"<worksheet", b"<!DOCTYPE x [" + entities + b"]><worksheet", 1)
        .replace(b"time [s]", b"&l29;")
    )
    with zipfile.ZipFile(path, "w") as new:
        for n, data in parts.items():
            new.writestr(n, data)
    with pytest.raises(UserError):
        for s in open_sources(path):
            list(s.batches())


@pytest.mark.parametrize(
    ("text", "fact"),
    [
        ("", "is empty"),
        ("/ x y\nLine 1\n", "no rows"),
        ("/ time v\nLine 1\n0 1\n1 2 3\n", "wrong number of values"),
        ("/ time v\nLine 1\n0 1\n1 zwei\n", "not a number"),
        ("/ time v\nLine 1\n0 1\n1 1_0\n", "not a number"),
        ("/ time time\n0 1\n", "twice"),
        ("/ time v\n0 1\n1 2\n", "no unit"),
        ("x" * (1 << 20) + "\n", "million"),
    ],
)
def test_xyz(tmp_path: Path, text: str, fact: str) -> None:
    path = tmp_path / "x.xyz"
    path.write_text(text)
    if "unit" in fact or "number" in fact:
        path.write_text(text.replace("v\n", "v\n/ [s] [V]\n", "unit" not in fact))
    assert fact in message(path)


@pytest.mark.parametrize(
    ("definition", "data", "fact"),
    [
        ("", "1 2\n", "names no data"),
        ("DEFN 1 ST=RECD,RT=;time:F9999999.2\n", "1 2\n", "format of a field"),
        ("DEFN 1 ST=RECD,RT=;time:Q5\n", "1 2\n", "format of a field"),
        ("DEFN 1 ST=RECD,RT=;time:99999F65000.2:UNIT=s\n", "1 2\n", "format of a field"),
        ("DEFN 1 ST=RECD,RT=;time:F5.1:UNIT=s\n", "  1.0\n  2.x\n", "not a number"),
        ("DEFN 1 ST=RECD,RT=;time:F5.1:UNIT=s\n", "  1.0 2.0\n", "longer than its definition"),
        ("DEFN 1 ST=RECD,RT=;time:F5.1\n", "  1.0\n", "no unit"),
        (None, "  1.0\n", "belongs to it is missing"),
    ],
)
def test_gdf2(tmp_path: Path, definition: str | None, data: str, fact: str) -> None:
    (tmp_path / "x.dat").write_text(data)
    if definition is not None:
        (tmp_path / "x.dfn").write_text(definition)
    assert fact in message(tmp_path / "x.dat")


def test_gdf2_of_others(tmp_path: Path) -> None:
    """Record types, comments, several columns of one field, nulls, blanks, stars, units with remarks."""
    (tmp_path / "X.DFN").write_text(
        "DEFN   ST=RECD,RT=COMM;RT:A4;COMMENTS:A20\n"
        "DEFN 1 ST=RECD,RT=DATA;RT:A4;LINE:I6;time: F8.2: UNIT=s, since midnight\n"
        "DEFN 2 ST=RECD,RT=DATA;f:2F9.2:UNIT=mGal,NULL=-999.99;flag:A2\n"
        "DEFN 3 ST=RECD,RT=DATA;END DEFN\n"
    )
    (tmp_path / "X.DAT").write_text(
        "COMMa remark            \n"
        "DATA  1010    0.00     1.50  -999.99ok\n"
        "DATA  1010    0.50 ********      2D0ok\n"
        "DATA  1020    1.00     2.50         x\n"
    )
    with pytest.raises(UserError, match="does not hold numbers"):
        open_sources(tmp_path / "X.DAT")
    first, second = open_sources(tmp_path / "X.DAT", lenient=True)
    rows = next(iter(first.batches()))
    assert (first.line, second.line) == ("1010", "1020")
    assert [c.unit for c in first.columns] == ["s", "mGal", "mGal"]
    assert rows["time"].tolist() == [0.0, 0.5]
    assert rows["f_1"][0] == 1.5
    assert rows["f_2"][1] == 2.0
    assert np.isnan([rows["f_1"][1], rows["f_2"][0]]).all()


def test_differing_tables_ask_for_a_choice(tmp_path: Path) -> None:
    path = tmp_path / "x.h5"
    with h5py.File(path, "w") as file:
        file["imu/time"], file["imu/a_x"] = np.arange(9.0), np.ones(9)
        file["ggi/time"], file["ggi/G_out"] = np.arange(5.0), np.ones(5)
    text = message(path)
    assert all(w in text for w in ("/imu", "/ggi", "[file] part"))
