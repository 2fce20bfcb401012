"""Every format gives back what was written; files of other tools are read; damaged ones and strange names are one message."""

from __future__ import annotations

import gzip
import hashlib
import itertools
import json
import shutil
import sys
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import xarray
from scipy.io import netcdf_file, savemat
from workers import in_process

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import main
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import Flight, files, read_flight, write_flight
from ragg_runtime.io.files import convert, read_recordings, write_tables
from ragg_runtime.io.mapping import parse_mapping
from ragg_runtime.io.record import require_distinct
from ragg_runtime.reference.scenario import scenario
from ragg_runtime.simulate import simulate_flight
from ragg_runtime.survey import run
from tests.runtime.foreign_files import ENDINGS, G0, HEADER, make_lines, write, write_sheets

WRITTEN = (".csv", ".csv.gz", ".parquet", ".nc")


def content(path: Path) -> dict[str | None, dict[str, tuple[str, np.ndarray]]]:
    return {r.line: {c.name: (c.unit, c.values) for c in r.columns} for r in read_recordings(path)}


def same(left: dict, right: dict, rtol: float = 0.0) -> None:
    assert list(left) == list(right)
    for line, columns in left.items():
        assert list(columns) == list(right[line])
        for name, (unit, values) in columns.items():
            assert unit == right[line][name][0], name
            np.testing.assert_allclose(right[line][name][1], values, rtol=rtol, atol=0.0, err_msg=name)


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize("lines", [(), ("1010", "T20", "north 3")])
def test_round_trip(tmp_path: Path, ending: str, lines: tuple[str, ...]) -> None:
    if lines and ending == ".mat":
        lines = ("10", "20", "30")  # names of structures
    tables = make_lines(*lines)
    parts = content(write(tmp_path / f"x{ending}", tables))
    expected = {t.line: {c.name: (c.unit, c.values) for c in t.columns} for t in tables}
    same(expected, parts, rtol=1e-15 if ending == ".xlsx" else 0.0)  # openpyxl writes 16 digits


def test_converted_there_and_back(tmp_path: Path) -> None:
    first = tmp_path / f"0{WRITTEN[0]}"
    write_tables(first, make_lines("7", "20.5"))
    for k, (_, after) in enumerate(itertools.pairwise((*WRITTEN, WRITTEN[0])), 1):
        report = convert(next(tmp_path.glob(f"{k - 1}.*")), tmp_path / f"{k}{after}")
        assert (report["lines"], report["rows"]) == (2, 120)
    same(content(first), content(tmp_path / f"{len(WRITTEN)}{WRITTEN[0]}"))
    with pytest.raises(UserError, match="itself"):
        convert(first, first)
    for ending in (".h5", ".mat", ".xlsx"):
        with pytest.raises(UserError, match=r"are read, not written[^$]*\.parquet"):
            convert(first, tmp_path / f"y{ending}")


def flight(n: int = 300, lost: tuple[int, ...] = ()) -> Flight:
    rng = np.random.default_rng(1)
    names = [f"{v}_{k}" for v in ("a", "omega", "omegadot") for k in "xyz"] + ["temperature", "fuel"]
    channels = {name: rng.normal(size=n) * 10.0 ** rng.integers(-9, 9) for name in names}
    valid = ~np.isin(np.arange(n), lost)
    outputs = {"G_out": np.where(valid, rng.normal(size=n), np.nan), "inline": rng.normal(size=n) * 1e-9}
    return Flight(1e5 + np.arange(n) / 16, channels, outputs, valid=valid, units={"fuel": "kg"})


@pytest.mark.parametrize("suffix", WRITTEN)
def test_a_flight_keeps_every_bit(tmp_path: Path, suffix: str) -> None:
    x = flight(lost=(0, 7, 8, 299))
    path = tmp_path / f"x{suffix}"
    write_flight(x, path)
    copy = read_flight(path, G0)
    assert np.array_equal(x.time, copy.time) and np.array_equal(x.valid, copy.valid)
    assert dict(x.units) == dict(copy.units)
    for left, right in ((x.channels, copy.channels), (x.outputs, copy.outputs)):
        assert list(left) == list(right)
        assert all(np.array_equal(v[x.valid], right[n][x.valid]) for n, v in left.items())
    assert [p.name for p in tmp_path.iterdir()] == [path.name]
    if suffix == ".csv":  # units stand where other tools look
        assert path.read_text().splitlines()[0].startswith("time [s],a_x [m/s^2],")
    elif suffix == ".parquet":
        assert pq.read_schema(path).field("omega_x").metadata[b"units"] == b"rad/s"
    elif suffix == ".nc":
        with xarray.open_dataset(path, engine="h5netcdf") as data:
            assert (data["omega_x"].attrs["units"], data["omega_x"].dims) == ("rad/s", ("time",))


def test_a_failed_writer_leaves_the_old_file(tmp_path, monkeypatch) -> None:
    path = tmp_path / "x.csv"
    path.write_bytes(b"old")

    def full(target: Path, *_: object) -> None:
        target.write_bytes(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setitem(files.ENDINGS, ".csv", replace(files.find_format(path), write=full))
    with pytest.raises(UserError, match="No space left"):
        write_flight(flight(), path)
    assert path.read_bytes() == b"old" and [p.name for p in tmp_path.iterdir()] == [path.name]
    with pytest.raises(UserError, match="does not exist"):
        write_flight(flight(), tmp_path / "none" / "x.csv")


def test_parquet_of_other_tools(tmp_path: Path) -> None:
    path, x = tmp_path / "x.parquet", flight(50)
    counts = np.arange(50, dtype=np.int32)

    def save(**changes: pa.Array) -> None:
        arrays = {"time": pa.array(x.time), **{n: pa.array(v) for n, v in x.channels.items()}}
        arrays |= {"G_out": pa.array(counts)} | changes
        fields = [pa.field(n, a.type, metadata={"units": x.units.get(n, "V")}) for n, a in arrays.items()]
        pq.write_table(pa.Table.from_arrays(list(arrays.values()), schema=pa.schema(fields)), path)

    save(
        a_x=pa.array([None if k == 4 else float(k) for k in range(50)]),
        a_y=pa.array([str(k).encode() for k in counts]),
        tags=pa.array([["a", "b"]] * 50),
        switch=pa.array([True] * 50),
        nanoseconds=pa.array(1_772_000_000_000_000_001 + counts.astype(np.int64)),
    )
    copy = read_flight(path, G0)
    assert np.array_equal(copy.outputs["G_out"], counts)
    assert np.flatnonzero(~copy.valid).tolist() == [4]
    assert any("'tags'" in n for n in copy.notes)
    for column in (pa.array(["x"] * 50), pa.array([None] * 50, pa.timestamp("ns"))):
        save(a_x=column)
        with pytest.raises(UserError, match="numbers"):
            read_flight(path, G0)


@pytest.mark.parametrize("classic", [False, True])
def test_netcdf_of_other_tools(tmp_path: Path, classic: bool) -> None:
    """Variables that are not along time are passed over; what the CF conventions call missing is missing."""
    path, x = tmp_path / "x.nc", flight(50)
    variables = {n: ("t", v, {"units": x.units[n]}) for n, v in {**x.channels, **x.outputs}.items()}
    variables["time"] = ("t", x.time - x.time[0], {"units": "seconds since 2024-01-01 00:00:00"})
    packed = np.arange(50, dtype=np.int16)
    packed[[3, 9, 11]] = 99, -32767, 200
    about = {"units": "g", "scale_factor": 0.5, "add_offset": 1.0}
    about |= {"_FillValue": np.int16(99), "valid_max": np.int16(100)}
    flags = {"flag_values": np.int8([1, 0]), "flag_meanings": "on off"}
    variables |= {
        "a_x": ("t", packed, about),
        "crs": ((), np.int32(4326), {}),
        "count": ("t", np.full(50, -2, np.int16), {"units": "1", "_Unsigned": "true"}),
        "line": ("k", np.arange(2.0), {}),
        "load": ("t", np.arange(50, dtype=np.int16), {"units": "1", "scale": 0.5, "offset": "1"}),
        "state": ("t", np.arange(50, dtype=np.int8) % 2, flags),
    }

    def save(change: dict = {}, drop: str = "") -> None:  # noqa: B006
        chosen = {n: v for n, v in (variables | change).items() if n != drop}
        if not classic:
            with h5py.File(path, "w") as file:
                for n, (_, values, attributes) in chosen.items():
                    file[n] = values
                    file[n].attrs.update({**attributes, "DIMENSION_LIST": 0})
            return
        with netcdf_file(path, "w") as file:
            for n, (dims, values, attributes) in chosen.items():
                for d, size in zip(dims, np.shape(values), strict=True):
                    if d not in file.dimensions:
                        file.createDimension(d, size)
                v = file.createVariable(n, np.asarray(values).dtype.newbyteorder(">"), tuple(dims))
                v[...] = values
                vars(v)["_attributes"].update(attributes)

    save()
    copy = read_flight(path, G0)
    assert copy.instants and copy.channels["count"][0] == 65534
    assert copy.time == pytest.approx(x.time - x.time[0])
    places = np.setdiff1d(np.arange(50), [3, 11] if classic else [3, 9, 11])
    assert copy.channels["a_x"][places[:3]] == pytest.approx(G0 * (0.5 * packed[places[:3]] + 1.0))
    assert np.flatnonzero(~copy.valid).tolist() == ([3, 11] if classic else [3, 9, 11])
    assert "state holds text; it is left out" in copy.notes
    assert copy.channels["load"][2] == 2.0 and "load: attributes offset, scale: applied" in copy.notes
    (note,) = (n for n in copy.notes if n.startswith("skipped"))
    assert "'crs' (a single value)" in note and "'line' (2)" in note
    for change, drop, what in (
        ({"a_x": ("t", np.zeros(50), {})}, "", "no unit"),
        ({"a_x": ("j", np.zeros(40), {"units": "g"})}, "", r"a_x is missing[^$]*'a_x' \(40\)"),
        ({}, "time", "time is missing"),
    ):
        save(change, drop)
        with pytest.raises(UserError, match=what):
            read_flight(path, G0)


def test_tables_of_records_in_hdf5(tmp_path: Path) -> None:
    """PyTables keeps records; the names in a block of pandas are in a pickle, which is not executed."""
    x = flight(60)
    names = [*x.channels, "G_out"]
    units = [*(x.units[n] for n in x.channels), "V"]
    values = [*x.channels.values(), x.outputs["G_out"]]
    records = np.zeros(60, dtype=[("time", "f8"), *((n, "f8") for n in names)])
    for n, v in zip(["time", *names], [x.time, *values], strict=True):
        records[n] = v
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["flight/table"] = records
        file["flight/table"].attrs["units"] = ["s", *units]
        file["settings"] = np.arange(7.0)
    titles = [f"{n} [{u}]" for n, u in zip(names, units, strict=True)]
    pickled = "(lp0\n" + "".join(f"V{t}\np{k}\na" for k, t in enumerate(titles, 1)) + "."
    block = np.zeros(60, dtype=[("index", "i8"), ("values_block_0", "f8", (len(names),))])
    block["index"] = np.round((x.time - x.time[0]) * 1e9)
    block["values_block_0"] = np.stack(values, axis=1)
    with h5py.File(tmp_path / "b.h5", "w") as file:
        file["df/table"] = block
        file["df/table"].attrs["values_block_0_kind"] = np.bytes_(pickled)
        file["df/table"].attrs["index_kind"] = np.bytes_("timedelta64")
        file["df/_i_table/index/sorted"] = np.arange(60)  # of PyTables itself
    with h5py.File(tmp_path / "d.h5", "w") as file:  # pandas, fixed format
        file["df/axis0"] = file["df/block0_items"] = np.array(titles, "S")
        file["df/axis1"], file["df/block0_values"] = block["index"], block["values_block_0"]
        file["df/axis1"].attrs.update({"kind": np.bytes_("timedelta64[ns]"), "name": np.bytes_("N.")})
        file["df/block1_items"], file["df/block1_values"] = np.array(["n [1]"], "S"), np.ones((60, 1))
    with h5py.File(tmp_path / "e.h5", "w") as file:  # HDF5 makes groups of "omega_x [deg/h]"
        file["time [s]"] = x.time
        for title, v in zip(titles, values, strict=True):
            file[title] = v
    with h5py.File(tmp_path / "c.h5", "w") as file:
        file["all"] = np.stack([x.time, *values], axis=1)
        file["all"].attrs.update({"columns": ["time", *names], "units": ["s", *units]})
    for name in "abcde":
        copy = read_flight(tmp_path / f"{name}.h5", G0)
        assert not copy.instants
        assert np.diff(copy.time) == pytest.approx(np.diff(x.time), abs=1e-9)
        assert np.array_equal(copy.channels["a_y"], x.channels["a_y"])


def test_a_workspace_of_matlab(tmp_path: Path) -> None:
    """Vectors of other lengths, texts, cells and structures beside the flight are passed over."""
    x = flight(60)
    cell = np.array(["__import__('os').system('true')", "a", "b"], dtype=object)
    motion = np.stack([x.channels[f"a_{k}"] for k in "xyz"], axis=1)
    whole = {"time": x.time[:, None], "a": motion, "window": np.hanning(16), "c": cell}
    whole |= {"comment": "calm", "fs": 16.0, "settings": {"gain": np.ones(5), "name": "x"}}
    whole |= {n: v for n, v in {**x.channels, **x.outputs}.items() if not n.startswith("a_")}
    whole["units"] = {n: str(x.units.get(n, "m/s^2")) for n in whole if n in (*x.units, "a")}
    savemat(tmp_path / "x.mat", whole)
    (table,) = (r for r in read_recordings(tmp_path / "x.mat"))
    assert {"time", "a_x", "a_z", "G_out"} <= {*table.names}
    assert table.column("a_y").unit == "m/s^2"
    assert any("'window' (16)" in n for n in table.notes)
    with h5py.File(tmp_path / "y.mat", "w") as file:  # version 7.3: texts are numbers
        for n, v in whole["units"].items():
            file[n], letters = np.atleast_2d(whole[n]), np.array([[ord(c)] for c in v], np.uint16)
            file.create_dataset(f"units/{n}", data=letters).attrs["MATLAB_class"] = np.bytes_("char")
        file["#refs#/a"] = np.zeros(60)
    copy = read_flight(tmp_path / "y.mat", G0)
    assert np.array_equal(copy.channels["a_z"], x.channels["a_z"]) and "a" not in copy.channels


def test_structures_in_a_record_belong_to_it(tmp_path: Path) -> None:
    x = flight(60)
    log = {"t": x.time, "acc": {k: x.channels[f"a_{k}"] for k in "xyz"}, "set": {"gain": np.ones(5)}}
    log["imu"] = {"gyro": {k: x.channels[f"omega_{k}"] for k in "xyz"}, "late": {"t": x.time}}
    savemat(tmp_path / "x.mat", {"log": log})
    first, *rest = files.read_tables(tmp_path / "x.mat")
    both = {"imu": {"time": x.time, **x.channels}, "ggi": {"time": x.time, **x.outputs}}
    savemat(tmp_path / "two.mat", both)
    (table,) = files.read_tables(tmp_path / "two.mat")
    late = {"t": x.time + 0.5, "G_out": x.outputs["G_out"]}
    savemat(tmp_path / "late.mat", {"time": x.time, **x.channels, "ggi": late})
    apart = [t.names for t in files.read_tables(tmp_path / "late.mat")]
    assert apart == [("time", *x.channels), ("t", "G_out")]
    assert table.names == ("time", *x.channels, *x.outputs)
    axes = [f"{n}_{k}" for n in ("acc", "imu_gyro") for k in "xyz"]
    assert first.names == ("t", *axes) and [t.part for t in rest] == ["/log/set", "/log/imu/late"]


def test_a_workbook_is_not_computed_and_read_beyond_its_dimension(tmp_path: Path) -> None:
    path = tmp_path / "x.xlsx"
    formula = '=1/0+WEBSERVICE("http://127.0.0.1")'
    rows = [["a survey"], ["time", "v"], ["s", "mV"], [0.0, formula], [1.0, 2.0], [2, "#N/A"]]
    write_sheets(path, {"Sheet": rows})
    unpacked = tmp_path / "x"
    shutil.unpack_archive(path, unpacked, "zip")
    sheet = unpacked / "xl/worksheets/sheet1.xml"
    sheet.write_text(sheet.read_text().replace('<dimension ref="A1:B6"', '<dimension ref="A1:A3"'))
    shutil.make_archive(str(tmp_path / "y"), "zip", unpacked)
    shutil.move(tmp_path / "y.zip", path)
    tables = content(path)[None]
    assert [(n, u) for n, (u, _) in tables.items()] == [("time", "s"), ("v", "mV")]
    # the file holds no value of the formula
    np.testing.assert_array_equal(tables["v"][1], [np.nan, 2.0, np.nan])


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


def broken(data: bytes, trial: int, rng: np.random.Generator) -> bytes:
    """Cut off, or with some bytes changed."""
    if trial % 3 == 0:
        return data[: rng.integers(1, len(data))]
    damaged = bytearray(data)
    for place in rng.integers(0, len(data), rng.integers(1, 6)):
        damaged[place] = rng.integers(0, 256)
    return bytes(damaged)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_damaged_file_is_read_or_refused_with_one_message(tmp_path: Path, ending: str) -> None:
    path = write(tmp_path / f"x{ending}", make_lines("1", "2"))
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
def test_a_damaged_text_is_read_or_refused_with_one_message(parse, text) -> None:
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
    other, path = (write(tmp_path / n, make_lines()) for n in ("other.h5", "x.h5"))
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
    path = write(tmp_path / "x.h5", make_lines())
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


@pytest.mark.parametrize(
    "text", ["a" * (3 << 20), ",".join(HEADER) + "\n" + "1" * (3 << 20), "# " + "a" * (3 << 20)]
)
def test_a_line_without_end(tmp_path: Path, text: str) -> None:
    (tmp_path / "flight.csv.gz").write_bytes(gzip.compress(text.encode()))
    with pytest.raises(UserError, match="not a table"):
        read_flight(tmp_path / "flight.csv.gz", 9.8)


STRANGE = "\x1b[31m<script>alert(1)\u202e&\"'"
SAID = "samples are spikes"


@pytest.mark.usefixtures("no_figures")
def test_a_flight_with_such_a_name_and_spikes_in_it(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    m = api.new("model")
    x = simulate_flight(m.instrument, [], seed=1, duration=60.0, rate=8.0)
    G = x.outputs["G_out"] + np.where(np.arange(len(x)) % 97 == 50, 5 * np.std(x.outputs["G_out"]), 0.0)
    write_flight(replace(x, outputs={"G_out": G}), "plain.parquet")
    flight = Path("plain.parquet").rename(f"{STRANGE}.parquet")
    words = ["compare", "model", str(flight), "--json", "out.json", "--report", "out.html"]
    monkeypatch.setattr(sys, "argv", ["ragg", *words])
    main(words)
    printed = capsys.readouterr()
    assert not {"\x1b", "\u202e"} & set(printed.out)
    assert r"\x1b[31m<script>alert(1)\u202e" in printed.out
    page = Path("out.html").read_text("utf-8")
    assert "<script>alert" not in page and "&lt;script&gt;alert(1)" in page
    result = json.loads(Path("out.json").read_text("utf-8"))
    assert result["provenance"]["flights"][0]["path"] == f"{STRANGE}.parquet"
    assert SAID in printed.out and SAID in page and any(SAID in note for note in result["notes"])
    assert "--json out.json --report out.html" in page
    for path in (Path("model", "model.toml"), flight):
        assert hashlib.sha256(path.read_bytes()).hexdigest() in page


def test_an_error_about_such_a_name(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    api.new("model")
    Path(f"{STRANGE}.csv").write_text(f"time [s],{STRANGE}[x [g]\n0,0\n", "utf-8")
    with pytest.raises(SystemExit) as end:
        main(["compare", "model", f"{STRANGE}.csv"])
    assert end.value.code == 2
    stderr = capsys.readouterr().err
    assert not {"\x1b", "\u202e"} & set(stderr)


@pytest.fixture(scope="module")
def loaded(tmp_path_factory: pytest.TempPathFactory) -> api.Loaded:
    return api.new(tmp_path_factory.mktemp("same") / "model")


@pytest.fixture(scope="module")
def short_flight(loaded: api.Loaded) -> Flight:
    return simulate_flight(loaded.instrument, [], seed=1, duration=60.0, rate=8.0)


def test_in_two_formats_it_is_refused_everywhere(loaded, short_flight, tmp_path) -> None:
    write_flight(short_flight, tmp_path / "x.csv")
    write_flight(short_flight, tmp_path / "y.parquet")
    both = [tmp_path / "x.csv", tmp_path / "y.parquet"]
    for use in (
        api.compare,
        api.diagnose,
        lambda m, x: api.add(m, "lag", x),
        lambda m, x: api.calibrate(m, x, save=True),
        api.compensate,
        api.compare_frozen,
    ):
        with pytest.raises(UserError, match=r"the same record as .*: it would count twice"):
            use(loaded, both)
    kept = api.load(loaded.directory.path)
    assert (kept.model.effects, kept.directory.calibration) == ((), None)


def test_other_records_are_others(short_flight: Flight) -> None:
    """The same motion flown again with other noise; flights at rest."""
    s = scenario(5, duration=60.0, trim="table-v")
    flights = [s.simulate().flight("once"), replace(s, seed=99).simulate().flight("again"), short_flight]
    rest = {n: np.full(len(short_flight), 9.8 if n == "a_z" else 0.0) for n in short_flight.channels}
    for seed in (1, 2):
        noise = np.random.default_rng(seed).normal(size=len(short_flight))
        flights.append(replace(short_flight, channels=rest, outputs={"G_out": noise}))
    require_distinct(flights)


def test_a_survey_counts_one_record_once(loaded, short_flight, tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(run, "examine_all", in_process)
    write_flight(short_flight, tmp_path / "a.parquet")
    write_flight(short_flight, tmp_path / "b.csv")
    kept = tmp_path / "kept.jsonl"
    for _ in range(2):
        s = api.survey(loaded, [tmp_path / "b.csv", tmp_path / "a.parquet"], resume=kept)
        assert [("verdict" in r, "error" in r) for r in s.records] == [(True, True), (False, True)]
        assert "the same record as" in s.records[1]["error"]["message"]
        assert "content" not in s.records[0]
    assert s.as_json()["counts"]["error"] == 1
