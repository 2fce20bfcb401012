"""Every format gives back what was written, to the last bit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import xarray

from ragg_runtime.base.errors import UserError
from ragg_runtime.io import Flight, formats, read_flight, write_flight

G0 = 9.8
SUFFIXES = (".csv", ".csv.gz", ".parquet", ".nc")


def flight(n: int = 500, seed: int = 1, lost: tuple[int, ...] = ()) -> Flight:
    rng = np.random.default_rng(seed)
    names = [f"{v}_{k}" for v in ("a", "omega", "omegadot") for k in "xyz"] + ["temperature", "fuel"]
    channels = {name: rng.normal(size=n) * 10.0 ** rng.integers(-9, 9) for name in names}
    valid = np.ones(n, dtype=bool)
    valid[list(lost)] = False
    outputs = {"G_out": np.where(valid, rng.normal(size=n), np.nan), "inline": rng.normal(size=n) * 1e-9}
    return Flight(
        time=1e5 + np.arange(n) / 16,
        channels=channels,
        outputs=outputs,
        valid=valid,
        units={"fuel": "kg"},
    )


def same(a: Flight, b: Flight) -> None:
    assert np.array_equal(a.time, b.time)
    assert np.array_equal(a.valid, b.valid)
    assert dict(a.units) == dict(b.units)
    for left, right in ((a.channels, b.channels), (a.outputs, b.outputs)):
        assert list(left) == list(right)
        for name, values in left.items():
            assert np.array_equal(values[a.valid], right[name][a.valid]), name


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_exact_round_trip(tmp_path: Path, suffix: str) -> None:
    made = flight(lost=(0, 7, 8, 499))
    path = tmp_path / f"x{suffix}"
    write_flight(made, path)
    found = read_flight(path, G0)
    same(made, found)
    assert found.name == "x"
    assert sorted(p.name for p in tmp_path.iterdir()) == [path.name]


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_units_of_choice(tmp_path: Path, suffix: str) -> None:
    made = flight()
    path = tmp_path / f"x{suffix}"
    chosen = {
        "a_x": "mg",
        "omega_y": "deg/h",
        "inline": "Eo",
        "temperature": "degC",
        "fuel": "t",
        "time": "ms",
    }
    write_flight(made, path, chosen, g0=G0)
    found = read_flight(path, G0)
    for name in ("a_x", "omega_y", "temperature", "fuel"):
        scale = 300.0 if name == "temperature" else 0.0
        assert found.channels[name] == pytest.approx(made.channels[name], rel=1e-14, abs=1e-12 * scale)
    assert found.outputs["inline"] == pytest.approx(made.outputs["inline"], rel=1e-14)
    other = read_flight(path, 2 * G0)
    assert other.channels["a_x"] == pytest.approx(2 * found.channels["a_x"])
    with pytest.raises(ValueError, match="g0"):
        write_flight(made, path, {"a_x": "mg"})
    with pytest.raises(UserError, match="dimension"):
        write_flight(made, path, {"a_x": "V"})


def test_units_stand_where_other_tools_look(tmp_path: Path) -> None:
    made = flight()
    for suffix in SUFFIXES:
        write_flight(made, tmp_path / f"x{suffix}")
    assert (tmp_path / "x.csv").read_text().splitlines()[0].startswith("time [s],a_x [m/s^2],")
    assert pq.read_schema(tmp_path / "x.parquet").field("omega_x").metadata[b"units"] == b"rad/s"
    with xarray.open_dataset(tmp_path / "x.nc", engine="h5netcdf") as data:
        assert data["omega_x"].attrs["units"] == "rad/s"
        assert data["omega_x"].dims == ("time",)
        assert np.array_equal(data["a_z"].values, made.channels["a_z"])


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_failed_writer_leaves_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, suffix: str
) -> None:
    path = tmp_path / f"x{suffix}"
    path.write_bytes(b"old")

    def full(target: Path, *_: object) -> None:
        target.write_bytes(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(formats.format_of(path), "write_tables", full)
    with pytest.raises(UserError, match="No space left"):
        write_flight(flight(), path)
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


def test_where_nothing_can_be_written(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="does not exist"):
        write_flight(flight(), tmp_path / "none" / "x.csv")
    with pytest.raises(UserError, match="ending"):
        write_flight(flight(), tmp_path / "x.xls")


def table(**changes: pa.Array) -> pa.Table:
    made = flight(50)
    arrays = {"time": pa.array(made.time), **{n: pa.array(v) for n, v in made.channels.items()}}
    arrays |= {"G_out": pa.array(made.outputs["G_out"])} | changes
    fields = [pa.field(n, a.type, metadata={"units": made.units.get(n, "V")}) for n, a in arrays.items()]
    return pa.Table.from_arrays(list(arrays.values()), schema=pa.schema(fields))


def test_parquet_of_other_tools(tmp_path: Path) -> None:
    path = tmp_path / "x.parquet"
    counts = np.arange(50, dtype=np.int32)
    nulls = pa.array([None if k == 4 else float(k) for k in range(50)])
    pq.write_table(table(G_out=pa.array(counts), a_x=nulls, a_y=pa.array(counts.astype(np.float32))), path)
    found = read_flight(path, G0)
    assert np.array_equal(found.outputs["G_out"], counts)
    assert np.flatnonzero(~found.valid).tolist() == [4]
    for column, what in (
        (pa.array(["x"] * 50), "numbers"),
        (pa.array([None] * 50, pa.timestamp("ns")), "numbers"),
    ):
        pq.write_table(table(a_x=column), path)
        with pytest.raises(UserError, match=what):
            read_flight(path, G0)
    pq.write_table(
        table().replace_schema_metadata().cast(pa.schema([(n, pa.float64()) for n in table().column_names])),
        path,
    )
    with pytest.raises(UserError, match="no unit"):
        read_flight(path, G0)


def test_netcdf_of_other_tools(tmp_path: Path) -> None:
    path = tmp_path / "x.nc"
    made = flight(50)
    variables = {n: ("t", v, {"units": made.units[n]}) for n, v in {**made.channels, **made.outputs}.items()}
    variables["time"] = ("t", made.time - made.time[0], {"units": "seconds since 2024-01-01 00:00:00"})
    xarray.Dataset(variables).to_netcdf(path, engine="h5netcdf")
    found = read_flight(path, G0)
    assert found.time == pytest.approx(made.time - made.time[0])
    assert found.rate == pytest.approx(16)
    for bad, what in (
        ({"a_x": (("t", "k"), np.zeros((50, 2)), {"units": "g"})}, "a_x is missing"),
        ({"a_x": ("t", np.zeros(50), {})}, "no unit"),
        ({"a_x": ("t", np.array(["x"] * 50), {"units": "g"})}, "a_x is missing"),
        ({"time": ((), 3.0, {"units": "s"})}, "time is missing"),
        ({"a_x": ("k", np.zeros(40), {"units": "g"})}, "differ in length"),
    ):
        xarray.Dataset(variables | bad).to_netcdf(path, engine="h5netcdf")
        with pytest.raises(UserError, match=what):
            read_flight(path, G0)
    del variables["time"]
    xarray.Dataset(variables).to_netcdf(path, engine="h5netcdf")
    with pytest.raises(UserError, match="time is missing"):
        read_flight(path, G0)
