"""What a flight file says in SI, what is derived from it, and what is refused."""

from __future__ import annotations

import gzip
from collections.abc import Callable, Mapping
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import Flight, read_flight
from ragg_runtime.model.record import record

G0 = 9.8
RATE = 16.0
N = 200
MOTION_UNITS = {"time": "s", "a_x": "g", "a_y": "mg", "a_z": "m/s^2"}
MOTION_UNITS |= {"omega_x": "deg/h", "omega_y": "rad/s", "omega_z": "deg/s"}


def columns(n: int = N) -> dict[str, np.ndarray]:
    """Motion and output of a smooth flight, in the units of MOTION_UNITS and V."""
    rng = np.random.default_rng(1)
    t = np.arange(n) / RATE
    wave = {n: np.sin(rng.uniform(0.5, 3) * t + rng.uniform(0, 6)) for n in list(MOTION_UNITS)[1:]}
    return {"time": t, **wave, "G_out": np.cos(3.1 * t)}


def csv_text(table: Mapping[str, np.ndarray], units: Mapping[str, str] = MOTION_UNITS) -> str:
    header = ",".join(f"{name} [{units.get(name, 'V')}]" for name in table)
    cells = zip(*table.values(), strict=True)
    rows = (",".join("" if np.isnan(x) else repr(float(x)) for x in row) for row in cells)
    return "\n".join([header, *rows]) + "\n"


@pytest.fixture
def load(tmp_path: Path) -> Callable[..., Flight]:
    def load(table: Mapping[str, np.ndarray] | str, units: Mapping[str, str] = {}) -> Flight:
        text = table if isinstance(table, str) else csv_text(table, MOTION_UNITS | dict(units))
        (tmp_path / "record.csv").write_text(text)
        return read_flight(tmp_path / "record.csv", G0)

    return load


Load = Callable[..., Flight]


def test_units_and_fields(load: Load, tmp_path: Path) -> None:
    table = columns()
    flight = load(table)
    assert flight.channels["a_x"] == pytest.approx(table["a_x"] * G0)
    assert flight.channels["a_y"] == pytest.approx(table["a_y"] * G0 * 1e-3)
    assert np.array_equal(flight.channels["a_z"], table["a_z"])
    assert flight.channels["omega_x"] == pytest.approx(np.deg2rad(table["omega_x"]) / 3600)
    assert flight.channels["omega_z"] == pytest.approx(np.deg2rad(table["omega_z"]))
    assert np.array_equal(flight.outputs["G_out"], table["G_out"])
    assert np.array_equal(flight.time, table["time"])
    assert (flight.name, flight.path, len(flight.digest)) == ("record", tmp_path / "record.csv", 64)
    assert flight.rate == pytest.approx(RATE)
    assert flight.duration == pytest.approx(N / RATE)
    assert flight.valid[N // 8 : -N // 8].all()  # omegadot is derived, poorly at the ends
    assert not flight.time.flags.writeable


def test_auxiliary_channels_of_any_name_come_in_si(load: Load) -> None:
    values = {"temperature": 20.0, "roll": 180.0, "fuel": 3.0, "B_x": 5e4, "B_y": 0.5, "valve": 1.0}
    units = {"temperature": "degC", "roll": "deg", "fuel": "t", "B_x": "nT", "B_y": "G", "valve": "1"}
    flight = load(columns() | {n: np.full(N, v) for n, v in values.items()}, units)
    expected = {"temperature": 293.15, "roll": np.pi, "fuel": 3000.0, "B_x": 5e-5, "B_y": 5e-5, "valve": 1.0}
    for name, value in expected.items():
        assert flight.channels[name] == pytest.approx(np.full(N, value))
    assert (flight.units["temperature"], flight.units["fuel"], flight.units["valve"]) == ("K", "kg", "1")


def test_G_out_of_the_voltages(load: Load) -> None:
    table = columns()
    del table["G_out"]
    v = np.random.default_rng(2).normal(size=(4, N))
    table |= {f"V_{j + 1}": v[j] for j in range(4)}
    flight = load(table, {"V_1": "mV"})
    assert flight.outputs["G_out"] == pytest.approx(v[0] * 1e-3 + v[1] - v[2] - v[3])
    assert any("G_out is derived" in note for note in flight.notes)
    wrong = load(table | {"G_out": v[0] * 1e-3 - v[1] + v[2] - v[3]}, {"V_1": "mV"})
    assert any("signs of the voltages" in note for note in wrong.notes)


def test_angular_acceleration_is_derived(load: Load) -> None:
    table = columns()
    table["omega_y"] = np.sin(2 * table["time"])
    flight = load(table)
    assert flight.channels["omegadot_y"] == pytest.approx(2 * np.cos(2 * table["time"]), abs=3e-4)
    assert any("omegadot" in note for note in flight.notes)
    off = np.isin(np.arange(N), range(60, 90))  # without power
    powerless = {"a_z": np.where(off, np.nan, table["a_z"]), "omega_y": np.where(off, 0.0, table["omega_y"])}
    assert np.array_equal(load(table | powerless).lacking, off)
    names = [f"omegadot_{k}" for k in "xyz"]
    recorded = load(table | dict.fromkeys(names, np.full(N, 7.0)), dict.fromkeys(names, "deg/s^2"))
    assert recorded.channels["omegadot_y"] == pytest.approx(np.full(N, np.deg2rad(7)))
    assert not recorded.notes


def test_a_gradient_that_violates_laplace_is_noted(load: Load) -> None:
    sizes = {"xx": 300.0, "xy": 1, "xz": 2, "yy": 200, "yz": 3, "zz": -500}
    gradient = {f"Gamma_{k}": v for k, v in sizes.items()}
    eo = dict.fromkeys(gradient, "Eo")
    table = columns() | {f"omegadot_{k}": np.zeros(N) for k in "xyz"}
    eo |= {f"omegadot_{k}": "rad/s^2" for k in "xyz"}
    assert load(table | {n: np.full(N, v) for n, v in gradient.items()}, eo).notes == ()
    gradient["Gamma_zz"] = 500
    assert "1e+03 Eo" in load(table | {n: np.full(N, v) for n, v in gradient.items()}, eo).notes[0]


def test_rows_that_a_file_has_twice_count_once(load: Load) -> None:
    """One file was appended to another, with an overlap; where the rows differ in a digit nobody knows which are right."""
    rows = np.r_[0:120, 80:N]
    doubled, whole = {n: v[rows] for n, v in columns().items()}, load(columns())
    flight = load(doubled)
    assert "40 rows that the file has twice left out (the first at t = 5 s)" in flight.notes
    assert all(np.array_equal(flight.channels[n], v, equal_nan=True) for n, v in whole.channels.items())
    doubled["G_out"][150] += 1.0
    with pytest.raises(UserError, match=r"jump back by 2\.5 s"):
        load(doubled)


def test_a_row_whose_stamp_is_out_of_order_is_left_out(load: Load) -> None:
    table = columns()
    table["time"][[50, 120]] += [1.0, -1.0]
    flight = load(table)
    assert "2 rows whose time stamp is out of order left out (the first after t = 3.0625 s)" in flight.notes
    assert len(flight) == N and not flight.present[[50, 120]].any()


def test_gaps_are_filled_in_and_marked(load: Load) -> None:
    table = columns()
    keep = np.ones(N, dtype=bool)
    keep[50:60] = False
    keep[120] = False
    flight = load({n: v[keep] for n, v in table.items()})
    assert len(flight) == N
    # omegadot is derived; of runs as short as these nothing tells how good it is at their ends
    trusted = keep.copy()
    for first, last in ((0, 50), (60, N)):  # it is bridged over one sample
        poor = (last - first) // 8
        trusted[first : first + poor] = trusted[last - poor : last] = False
    assert np.array_equal(flight.valid, trusted)
    assert flight.time == pytest.approx(table["time"])
    assert flight.rate == pytest.approx(RATE)
    assert np.array_equal(flight.channels["a_z"][keep], table["a_z"][keep])
    assert all(np.isfinite(v).all() for v in flight.channels.values())
    assert np.array_equal(np.isnan(flight.outputs["G_out"]), ~keep)
    assert any("2 gaps: 11 of 200 samples" in note for note in flight.notes)
    # One sample is hardly missed; the derivative knows nothing of the other side of a gap.
    whole = load(table)
    inside = np.r_[0:44, 77:120, 121:N]
    for name in ("omegadot_x", "omegadot_y", "omegadot_z"):
        true = whole.channels[name]
        assert flight.channels[name][inside] == pytest.approx(true[inside], abs=1e-3 * float(np.std(true)))


def test_empty_cells_are_marked(load: Load) -> None:
    table = columns() | {"temperature": np.full(N, 290.0)} | {f"omegadot_{k}": np.zeros(N) for k in "xyz"}
    table["a_x"][7] = np.nan
    table["G_out"][[9, 10]] = np.nan
    table["temperature"][np.arange(N) % 16 != 0] = np.nan  # sampled once a second
    table["temperature"][100:160] = np.nan
    flight = load(table, {"temperature": "K"} | {f"omegadot_{k}": "rad/s^2" for k in "xyz"})
    lost = np.zeros(N, dtype=bool)
    lost[[7, 9, 10]] = True
    lost[97:160] = True  # four seconds without a temperature
    lost[193:] = True  # and no later one to interpolate to
    assert np.array_equal(flight.valid, ~lost)
    assert flight.channels["temperature"] == pytest.approx(np.full(N, 290.0))
    assert np.isfinite(flight.channels["a_x"]).all()
    assert any(note == "a_x: without a value at 1 sample, not used" for note in flight.notes)
    assert any(note.startswith("temperature") and "interpolated" in note for note in flight.notes)


def edited(**changes: np.ndarray) -> dict[str, np.ndarray]:
    return columns() | changes


def without(*names: str) -> dict[str, np.ndarray]:
    return {n: v for n, v in columns().items() if n not in names}


TEXT = csv_text(columns(5))
T, ODD = np.arange(N) / RATE, np.where(np.arange(N) % 2, 1.0, np.nan)
# two records joined by their times, filled with the value before
FILLED = {n: v[(np.arange(N) + (n == "G_out")) // 2] for n, v in columns().items()} | {"time": T}


@pytest.mark.parametrize(
    ("table", "facts"),
    [
        (without("time"), ("time is missing", "a_x")),
        (without("a_x", "omega_z"), ("a_x, omega_z are missing",)),
        (without("G_out"), ("output is missing", "G_out", "inline")),
        (without("G_out") | {"V_1": T, "V_2": T, "V_4": T}, ("output is missing", "V_4")),
        (edited(omegadot_x=T), ("omegadot_y, omegadot_z",)),
        (TEXT.replace("a_x [g]", "ax [g]"), ("a_x is missing", "'ax' meant for a_x")),
        (TEXT.replace("a_x [g]", "a_x"), ("'a_x'", "no unit", "a_x [m/s^2]")),
        (TEXT.replace("a_x [g]", "[g]"), ("a_x is missing", "'[g]'", "letter")),
        (TEXT.replace("a_x [g]", "a_x [gg]"), ("'a_x'", "not a unit", "gg")),
        (TEXT.replace("omega_y [rad/s]", "omega_y [Hz]"), ("'omega_y'", "frequency", "rad/s")),
        (TEXT.replace("a_y [mg]", "a_x [mg]"), ("'a_x'", "twice")),
        (TEXT.replace("\n0.125,", "\nhigh noon,"), ("line 4", "'time'", "'high noon'")),
        (TEXT.replace("\n0.125,", "\n0.125,0,"), ("line 4", "9", "8")),
        (TEXT.splitlines()[0] + "\n", ("too few samples", "0 rows")),
        ("", ("empty",)),
        ("\n\n", ("no header",)),
        (edited(time=T + np.random.default_rng(3).uniform(-0.4, 0.4, N) / RATE), ("not uniformly sampled",)),
        (edited(time=np.full(N, 3.0)), ("too coarse", "the clock stands still")),
        (dict.fromkeys(columns(), np.zeros(N)), ("too coarse", "the clock stands still")),
        (edited(time=T[::-1]), ("backwards",)),
        (edited(time=T - (T > 0.6)), ("jump back", "row 10", "row 11", "0.5625 s")),
        (edited(time=np.repeat(T[: N // 2], 2)), ("too coarse", "100 different stamps in 200 rows")),
        (edited(time=np.where(T < 6, T, T + 1e6)), ("jump by 1e+06 s at t = 5.9375 s", "split")),
        (edited(G_out=np.full(N, np.nan), time=T), ("output is missing",)),
        (edited(a_x=ODD, G_out=ODD[::-1]), ("in different rows", "both in 0")),
        (FILLED, ("in different rows", "100 of 200", "both in 1")),
    ],
)
def test_what_is_refused(load, tmp_path, table, facts) -> None:
    with pytest.raises(UserError) as caught:
        load(table, {"V_1": "V", "omegadot_x": "rad/s^2"})
    assert [f for f in (str(tmp_path / "record.csv"), *facts) if f not in str(caught.value)] == []


def test_files_that_are_something_else(tmp_path: Path) -> None:
    for name, content, fact in (
        ("x.csv", b"PAR1....", "no header"),
        ("x.csv", b"PK\x03\x04\0\0..", "another format"),
        ("x.nc", TEXT.encode(), "damaged"),
        ("x.nc", b"CDF\x01", "damaged"),
        ("x.parquet", TEXT.encode(), "damaged"),
        ("x.parquet", b"PAR1" + b"0" * 40, "damaged"),
        ("x.nc", b"\x89HDF\r\n\x1a\n" + b"0" * 40, "damaged"),
        ("x.csv", b"", "empty"),
        ("x.csv", TEXT.replace("g]", "µ]", 1).encode("latin-1"), "'µ'"),
        ("x.xls", b"PK", ".parquet"),
        ("flight", b"PK", "no ending"),
        ("x.csv.gz", gzip.compress(TEXT.encode())[:150], "x.csv.gz"),
    ):
        path = tmp_path / name
        path.write_bytes(content)
        with pytest.raises(UserError) as caught:
            read_flight(path, G0)
        assert fact in str(caught.value), name
    with pytest.raises(UserError, match="does not exist"):
        read_flight(tmp_path / "none.csv", G0)
    (tmp_path / "folder.csv").mkdir()
    with pytest.raises(UserError, match="directory"):
        read_flight(tmp_path / "folder.csv", G0)


def test_the_derivative_of_the_motion_is_no_column(load: Load) -> None:
    """A column that is called like a series which models form themselves does not take its place."""
    table = columns() | {"d_a_x": np.full(N, 1e6), "d_temp": np.full(N, 3.0)}
    flight = load(table, {"d_a_x": "m/s^3", "d_temp": "K/s"})
    assert "d_a_x: not used; models form this derivative themselves" in flight.notes
    instrument = parse_instrument(resources.files("ragg_runtime").joinpath("example.toml").read_text("utf-8"))
    r = record(flight, instrument)
    formed, recorded = r.series("d_a_x"), r.series("d_temp")
    assert formed is not None and recorded is not None
    assert np.max(np.abs(formed)) < 1e3
    assert np.all(recorded == 3.0)
