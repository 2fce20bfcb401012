"""Damaged files and files of strangers: one clear message, nothing executed, nothing of another file read."""

from __future__ import annotations

import gzip
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.io import read_flight
from ragg_runtime.io.files import read_recordings
from ragg_runtime.io.mapping import parse_mapping
from ragg_runtime.io.tables import DataColumn, DataTable
from tests.runtime.foreign_files import ENDINGS, write

NAMES = ("time", "a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z", "G_out")
UNITS = ("s", "g", "g", "g", "deg/s", "deg/s", "deg/s", "V")
HEADER = ",".join(f"{n} [{u}]" for n, u in zip(NAMES, UNITS, strict=True)) + "\n"
MAPPING = """
[time]
column = "UTC"
format = "iso"
[columns]
a_x = { column = "ACC1", unit = "g", scale = 2.0 }
[axes]
x = "y"
y = "x"
z = "-z"
"""
SHEET = (Path(__file__).parents[2] / "ragg_runtime" / "example.toml").read_text("utf-8")


def good(path: Path, lines: tuple[str, ...] = ()) -> Path:
    rng = np.random.default_rng(1)
    tables = []
    for line in lines or (None,):
        columns = [DataColumn(n, u, rng.normal(size=60)) for n, u in zip(NAMES, UNITS, strict=True)]
        columns[0] = DataColumn("time", "s", np.arange(60) / 16)
        tables.append(DataTable(tuple(columns), line))
    return write(path, tables)


def broken(data: bytes, trial: int, rng: np.random.Generator) -> bytes:
    """Cut off, or with some bytes changed."""
    if trial % 3 == 0:
        return data[: rng.integers(1, len(data))]
    made = bytearray(data)
    for place in rng.integers(0, len(data), rng.integers(1, 6)):
        made[place] = rng.integers(0, 256)
    return bytes(made)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_damaged_file_is_read_or_refused_with_one_message(tmp_path: Path, ending: str) -> None:
    path = good(tmp_path / f"x{ending}", ("1", "2"))
    data = path.read_bytes()
    assert all(len(s) == 60 for s in read_recordings(path))
    rng = np.random.default_rng(2)
    for trial in range(40):
        path.write_bytes(broken(data, trial, rng))
        try:
            for s in read_recordings(path):
                assert all(c.values.dtype == np.float64 for c in s.columns)
        except UserError as error:
            assert len(str(error)) < 3000, str(error)[:500]


@pytest.mark.parametrize(("parse", "text"), [(parse_mapping, MAPPING), (parse_instrument, SHEET)])
def test_a_damaged_text_is_read_or_refused_with_one_message(
    parse: Callable[[str, Path], object], text: str
) -> None:
    parse(text, Path("x.toml"))
    rng = np.random.default_rng(3)
    for trial in range(150):
        try:
            parse(broken(text.encode(), trial, rng).decode("utf-8", "replace"), Path("x.toml"))
        except UserError as error:
            assert len(str(error)) < 3000, str(error)[:500]


@pytest.mark.parametrize("trick", ["external", "link", "virtual"])
def test_numbers_in_other_files_are_not_read(tmp_path: Path, trick: str) -> None:
    secret = tmp_path / "secret.bin"
    secret.write_bytes(np.arange(60.0).tobytes())
    other, path = good(tmp_path / "other.h5"), good(tmp_path / "x.h5")
    with h5py.File(path, "a") as file:
        del file["G_out"]
        if trick == "external":
            file.create_dataset("G_out", shape=(60,), dtype="f8", external=[(str(secret), 0, 480)])
        elif trick == "link":
            file["G_out"] = h5py.ExternalLink(str(other), "/G_out")
        else:
            layout = h5py.VirtualLayout((60,), "f8")
            layout[:] = h5py.VirtualSource(str(other), "G_out", (60,))
            file.create_virtual_dataset("G_out", layout)
    with pytest.raises(UserError, match="output is missing"):
        read_flight(path, 9.8)


def test_groups_in_a_circle_end(tmp_path: Path) -> None:
    path = good(tmp_path / "x.h5")
    with h5py.File(path, "a") as file:
        file.create_group("deeper").create_group("deeper")["round"] = file["/"]
    assert len(read_flight(path, 9.8)) == 60


def test_differing_tables_ask_for_a_choice(tmp_path: Path) -> None:
    path = tmp_path / "x.h5"
    with h5py.File(path, "w") as file:
        file["imu/time"], file["imu/a_x"] = np.arange(9.0), np.ones(9)
        file["ggi/time"], file["ggi/G_out"] = np.arange(5.0), np.ones(5)
    with pytest.raises(UserError) as refused:
        read_recordings(path)
    assert all(w in str(refused.value) for w in ("/imu", "/ggi", "[file] part"))


@pytest.mark.parametrize("text", ["a" * (3 << 20), HEADER + "1" * (3 << 20), "# " + "a" * (3 << 20)])
def test_a_line_without_end(tmp_path: Path, text: str) -> None:
    (tmp_path / "flight.csv.gz").write_bytes(gzip.compress(text.encode()))
    with pytest.raises(UserError, match="not a table"):
        read_flight(tmp_path / "flight.csv.gz", 9.8)
