"""Units, in which g is the model's g0, and mapping.toml: what they say, what is refused, what `ragg map` writes of strange files."""

from __future__ import annotations

import contextlib
import math
import pickle
import tomllib
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import cli
from ragg_runtime.instrument.units import Units, units
from ragg_runtime.io import Flight, read_flight, read_flights, write_flight
from ragg_runtime.io.draft import draft_mapping
from ragg_runtime.io.files import read_recordings
from ragg_runtime.io.mapping import Mapped, parse_mapping

G0 = 9.8
HERE = Path("mapping.toml")
MOTION = ("a_x", "a_y", "a_z", "omega_x", "omega_y", "omega_z")


def made(n: int = 300) -> Flight:
    rng = np.random.default_rng(5)
    channels = {name: rng.normal(size=n) for name in MOTION}
    return Flight(time=np.arange(n) / 16, channels=channels, outputs={"G_out": rng.normal(size=n)})


def foreign(path: Path, time: str = "{t:.4f}", head: str = "T", lines: tuple[int, ...] = ()) -> Flight:
    """A recorder's CSV: NED axes in g and dps, the output of the wrong sign in mV."""
    x = made()
    names = ["AN", "AE", "AD", "GN", "GE", "GD", "OUT"]
    rows = ["LINE," * bool(lines) + f"{head}," + ",".join(names)]
    a = np.stack([x.channels[n] for n in ("a_y", "a_x", "a_z")]) / G0
    w = np.degrees([x.channels[n] for n in ("omega_y", "omega_x", "omega_z")])
    a[2], w[2] = -a[2], -w[2]
    table = np.vstack([a, w, -1e3 * x.outputs["G_out"]]).T.tolist()
    for line in lines or (0,):
        for t, values in zip(x.time, table, strict=True):
            front = f"{line}," * bool(lines) + time.format(t=t, s=t % 60)
            rows.append(front + "," + ",".join(map(repr, values)))
    path.write_text("\n".join(rows) + "\n")
    return x


TEXT = """
[time]
column = "T"
unit = "s"
[columns]
a_x = { column = "AN", unit = "g" }
a_y = { column = "AE", unit = "g" }
a_z = { column = "AD", unit = "g" }
omega_x = { column = "GN", unit = "dps" }
omega_y = { column = "GE", unit = "dps" }
omega_z = { column = "GD", unit = "dps" }
G_out = { column = "OUT", unit = "V", sign = -1, scale = 1e-3 }
[axes]
x = "y"
y = "x"
z = "-z"
"""


def parse(text: str = TEXT) -> Mapped:
    return parse_mapping(text, HERE)


def test_units_signs_scales_and_axes(tmp_path: Path) -> None:
    x = foreign(tmp_path / "x.csv")
    flight = read_flight(tmp_path / "x.csv", G0, mapping=parse())
    assert flight.time == pytest.approx(x.time)
    for name, values in {**x.channels, **x.outputs}.items():
        read = {**flight.channels, **flight.outputs}[name]
        assert read == pytest.approx(values, rel=1e-12, abs=1e-12), name
    assert flight.notes[0].startswith("read by mapping.toml (SHA-256 ")


def test_the_axes_turn_places_too() -> None:
    x, places = made(), {f"mass_{k}": np.arange(300.0) + n for n, k in enumerate("xyz")}
    head, tail = TEXT.split("[columns]")[0], TEXT.split("[axes]")[1]
    columns = [(n, v) for n, v in ({**x.channels, **x.outputs, **places}).items()]
    units = {n: x.units.get(n, "m") for n, _ in columns}
    lines = "".join(f'{n} = {{ column = "{n}", unit = "{u}" }}\n' for n, u in units.items())
    mapping = parse(f"{head}[columns]\n{lines}[axes]{tail}")
    flight = read_flight({"T": x.time, **dict(columns)}, G0, mapping=mapping)
    assert [flight.channels[f"mass_{k}"][0] for k in "xyz"] == [1.0, 0.0, -2.0]
    assert np.array_equal(flight.channels["a_z"], -x.channels["a_z"])


@pytest.mark.parametrize(
    ("time", "head", "written", "start", "origin"),
    [
        ("2026-03-01T12:00:{s:07.4f}Z", "T", 'column = "T"\nformat = "iso"', 43200.0, 1),
        ("1200{s:07.4f}", "T", 'column = "T"\nformat = "clock"', 43200.0, None),
        ("{t:.4f}", "T", 'column = "T"\nunit = "s"\norigin = 2026-03-01T00:00:00Z', 0.0, 1),
        ("{t:.4f}", "T", 'rate = "16 Hz"', 0.0, None),
        ("2408,{t:.4f}", "W,S", 'column = ["W", "S"]\nformat = "gps"', 0.0, 1),  # 1 March 2026 is a Sunday
    ],
)
def test_clocks(tmp_path: Path, time: str, head: str, written: str, start: float, origin: int | None) -> None:
    path = tmp_path / "x.csv"
    x = foreign(path, time, head)
    mapping = parse(TEXT.replace('column = "T"\nunit = "s"', written))
    (source,) = read_recordings(path, mapping)
    assert source.origin == (None if origin is None else datetime(2026, 3, origin, tzinfo=UTC))
    assert read_flight(path, G0, mapping=mapping).time == pytest.approx(start + x.time, abs=1e-4)


def test_lines_become_flights(tmp_path: Path) -> None:
    path = tmp_path / "x.csv"
    foreign(path, lines=(1010, 1020))
    mapping = parse('[file]\nline = "LINE"\n' + TEXT)
    assert [x.name for x in read_flights(path, G0, mapping=mapping)] == ["x:1010", "x:1020"]
    with pytest.raises(UserError, match="several lines"):
        read_flight(path, G0, mapping=mapping)
    one = parse('[file]\nline = "LINE"\nlines = ["1020"]\n' + TEXT)
    assert [x.name for x in read_flights(path, G0, mapping=one)] == ["x"]
    with pytest.raises(UserError, match="no such line"):
        read_flights(path, G0, mapping=parse('[file]\nline = "LINE"\nlines = ["7"]\n' + TEXT))


@pytest.mark.parametrize(
    ("old", "new", "facts"),
    [
        ('unit = "dps"', 'unit = "?"', ("omega_x", "not answered", "none is guessed")),
        ('unit = "dps"', 'unit = "parsnips"', ("not a unit", "parsnips")),
        ("sign = -1", "sign = -2", ("sign", "scale")),
        ("scale = 1e-3", "scale = 0", ("zero",)),
        ("scale = 1e-3", "scale = nan", ("scale", "number")),
        ('x = "y"', 'x = "-y"', ("mirror",)),
        ('x = "y"', 'x = "z"', ("twice",)),
        ('x = "y"', 'x = "w"', ("not an axis",)),
        ('column = "T"', 'column = ["T", "U"]', ("one column",)),
        ('unit = "s"', 'format = "iso8601"', ("format", "iso")),
        ('unit = "s"', 'format = "gps"', ("two columns",)),
        ('unit = "s"', 'unit = "s"\norigin = "2026"', ("origin",)),
        ('unit = "s"', 'unit = "s"\nrate = "16 Hz"', ("rate", "no unit")),
        ('unit = "s"', 'rate = "0 Hz"', ("rate", "above zero")),
        ("[axes]", "[axis]", ("unknown key", "axes")),
        ('column = "AN"', 'colum = "AN"', ("not named",)),
        ('column = "AN"', 'column = 3', ("column", "text")),
        ('column = "AN"', 'column = "AX"', ("AX", "not in the file", "ragg map")),
        ("[time]", "[[time]]", ("must be a table",)),
        ("[columns]", "[columns", ("TOML",)),
        ('[time]\ncolumn = "T"\nunit = "s"', "", ("[time] is missing",)),
        ('a_x = { column = "AN", unit = "g" }\n', "", ("axes", "a_y", "a_x")),
    ],
)  # fmt: skip
def test_refused(tmp_path: Path, old: str, new: str, facts: tuple[str, ...]) -> None:
    path = tmp_path / "x.csv"
    foreign(path)
    assert old in TEXT
    with pytest.raises(UserError) as caught:
        read_flight(path, G0, mapping=parse(TEXT.replace(old, new, 1)))
    assert all(f in str(caught.value) for f in facts), str(caught.value)
    assert len(str(caught.value)) < 2000


SURVEY = """Line,X,Y,Altitude,Cross1_raw,Inline1_raw,HHMMSS,YYMMDD,Gyro_X
10,436702.0,3327648.7,75.0,1354.8,-335.3,235959.0,20080703,
10,436702.1,3327648.8,75.1,1354.9,-335.4,000000.0,20080704,0.5
T20,436702.0,3327648.7,75.0,1354.8,,132850.4,20080704,0.1
T20,436702.1,3327648.8,75.1,1354.9,-335.4,132851.4,20080704,0.2
"""


def test_a_mapping_is_begun_from_a_survey(tmp_path: Path) -> None:
    path = tmp_path / "x.csv"
    path.write_text(SURVEY.replace("\n10,", "\nL10,"))
    d = draft_mapping(path)
    assert 'column = ["YYMMDD", "HHMMSS"]  # likely' in d.text
    assert 'inline_1 = { column = "Inline1_raw", unit = "?", scale = 2 }  # likely' in d.text
    assert 'omega_x = { column = "Gyro_X", unit = "?" }  # likely' in d.text
    with pytest.raises(UserError, match="not answered"):
        parse_mapping(d.text, HERE)
    answered = d.text.replace('unit = "?"', 'unit = "E"')
    first, second = read_recordings(path, parse_mapping(answered, HERE))
    assert (first.line, second.line) == ("L10", "T20")
    assert [r.origin for r in (first, second)] == [datetime(2008, 7, d, tzinfo=UTC) for d in (3, 4)]
    rows = {c.name: c.values for c in first.columns}
    assert rows["time"].tolist() == [86399.0, 86400.0]
    assert rows["inline_1"].tolist() == [-670.6, -670.8]
    assert np.isnan(rows["omega_x"][0])


def test_names_in_another_language_are_recognised_by_unit_and_axis(tmp_path: Path) -> None:
    head = [f"{n} {x} [{u}]" for n, u in (("Beschleunigung", "m/s²"), ("Drehrate", "°/s")) for x in "XYZ"]
    path = tmp_path / "x.csv"
    path.write_text(";".join(["Zeit [s]", *head, "Summe [mV]"]) + "\n" + "0,1;1;2;9,8;0,1;0,2;0,3;7,5\n" * 3)
    d = draft_mapping(path)
    motion = {f"{n}_{x}" for n in ("a", "omega") for x in "xyz"}
    assert {n for n, rating in d.sure.items() if rating == "guess"} == motion | {"G_out"}
    assert 'omega_y = { column = "Drehrate Y", unit = "°/s" }  # guess: by its unit and axis' in d.text
    path.write_text(
        path.read_text().replace("Summe [mV]", "Summe [mV];Strom [V]").replace("7,5\n", "7,5;1\n")
    )
    assert "G_out" not in draft_mapping(path).sure


LOGGERS = (
    (
        "timestamp,gyro_rad[0],gyro_rad[1],gyro_rad[2],accelerometer_m_s2[0],accelerometer_m_s2[1],accelerometer_m_s2[2],G_out [V]",
        "w0 w1 w2 a0 a1 a2 G",
    ),
    ("TimeUS,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,T,out", "w0 w1 w2 a0 a1 a2 - G"),
    ("GPS Seconds,Z Accel,-(Y Accel),X Accel,Z Gyro,-(Y Gyro),X Gyro,Vout", "a2 a1 a0 w2 w1 w0 G"),
    ("SampleTimeFine,Acc_X,Acc_Y,Acc_Z,FreeAcc_X,Gyr_X,Gyr_Y,Gyr_Z,volts (V)", "a0 a1 a2 - w0 w1 w2 G"),
    (
        "t,acc_north_mps2,acc_east_mps2,acc_down_mps2,gyr_e_dps,gyr_n_dps,gyr_u_dps,g_out_V",
        "a0 a1 a2 w0 w1 w2 G",
    ),
    ("t,acc_fwd,acc_left,acc_up,Roll Rate,Pitch Rate,Yaw Rate,GGI output", "a0 a1 a2 w0 w1 w2 G"),
    (
        "%time,field.angular_velocity.x,field.angular_velocity.y,field.angular_velocity.z,field.angular_velocity_covariance_x,"
        "field.linear_acceleration.x,field.linear_acceleration.y,field.linear_acceleration.z,G_out",
        "w0 w1 w2 - a0 a1 a2 G",
    ),
    (
        "/'D'/'Time' [s],/'D'/'Accel X (g)',/'D'/'Accel Y (g)',/'D'/'Accel Z (g)',/'D'/'p',/'D'/'q',/'D'/'r',/'D'/'Output (V)'",
        "a0 a1 a2 w0 w1 w2 G",
    ),
)
"""Headers of flight controllers, inertial sensors and data loggers, and the channels that the columns after time are."""


@pytest.mark.parametrize(("header", "wanted"), LOGGERS, ids=range(len(LOGGERS)))
def test_names_of_loggers_are_known(tmp_path: Path, header: str, wanted: str) -> None:
    _, *names = header.split(",")
    rows = "".join(f"{k / 16}" + f",{k % 7}.5" * len(names) + "\n" for k in range(20))
    (tmp_path / "x.csv").write_text(f"{header}\n{rows}")
    d = draft_mapping(tmp_path / "x.csv")
    toml, long = tomllib.loads(d.text), {"a": "a", "w": "omega"}
    expected = {
        "G_out" if w == "G" else f"{long[w[0]]}_{'xyz'[int(w[1])]}": name
        for name, w in zip(names, wanted.split(), strict=True)
        if w != "-"
    }
    assert {*toml["columns"]} == {*expected} and toml["time"]["column"] != "?", d.text
    assert all(expected[n].startswith(x["column"].rstrip("'")) for n, x in toml["columns"].items()), d.text
    assert ("-(Y" in header) == ("scale = -1" in d.text)


def test_kept_with_the_model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mapping.toml").write_text(TEXT)
    how = api.mapping_of(api.new("model", None, Path("mapping.toml")), None)
    assert Path("model/mapping.toml").read_text() == TEXT
    assert how is not None and how.kept
    foreign(Path("x.csv"))
    write_flight(made(), "plain.csv")  # a file that has none of its columns is read as it is
    for path in ("x.csv", "plain.csv"):
        (copy,) = read_flights(path, G0, mapping=how)
        assert copy.channels["a_x"] == pytest.approx(made().channels["a_x"])
    run = CliRunner().invoke(cli, ["new", "other", "--map", "none.toml"])
    assert isinstance(run.exception, UserError)
    assert not Path("other").exists()


def test_commands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    foreign(Path("x.csv"))
    Path("m.toml").write_text(TEXT)
    run = CliRunner().invoke(cli, ["convert", "x.csv", "y.parquet", "--map", "m.toml"])
    assert (run.exit_code, run.exception) == (0, None)
    assert "300 rows of 8 columns" in run.output
    assert read_flight("y.parquet", G0).channels["a_z"] == pytest.approx(made().channels["a_z"])
    run = CliRunner().invoke(cli, ["map", "x.csv", "-o", "draft.toml"])
    assert run.exit_code == 0
    assert "question" in run.output
    assert "[columns]" in Path("draft.toml").read_text()
    run = CliRunner().invoke(cli, ["map", "x.csv", "-o", "draft.toml"])
    assert isinstance(run.exception, UserError)  # what was answered is not overwritten


# --- units ---


@pytest.mark.parametrize("g0", [0.3, 9.80665])
def test_g_is_g0_wherever_it_stands(g0: float) -> None:
    registry = Units(g0)
    for unit, si_unit, expected in (
        ("g", "m/s^2", g0),
        ("mg", "m/s^2", 1e-3 * g0),
        ("ug", "m/s^2", 1e-6 * g0),
        ("µg", "m/s^2", 1e-6 * g0),
        ("mA/g", "A/(m/s^2)", 1e-3 / g0),
        ("ug/g", "1", 1e-6),
        ("ug/g^2", "1/(m/s^2)", 1e-6 / g0),
        ("ug/g^3", "(m/s^2)^-2", 1e-6 / g0**2),
        ("um/g", "s^2", 1e-6 / g0),
        ("rad/g", "rad/(m/s^2)", 1 / g0),
        ("g^2", "m^2/s^4", g0**2),
        ("ug/K", "m/s^2/K", 1e-6 * g0),
    ):
        assert registry.to_si(1.0, unit, si_unit) == pytest.approx(expected, rel=1e-14), unit


@pytest.mark.parametrize(
    ("unit", "si_unit", "expected"),
    [
        ("Eo", "s^-2", 1e-9),
        ("Eo/m", "1/(s^2*m)", 1e-9),
        ("arcsec", "rad", math.pi / 180 / 3600),
        ("deg/h", "rad/s", math.pi / 180 / 3600),
        ("°", "rad", math.pi / 180),
        ("%", "1", 0.01),
        ("rad/s^0.5", "rad/s^0.5", 1.0),
        ("ug/(rad/s^2)", "m/s^2/(rad/s^2)", 9.8e-6),
        ("kg", "kg", 1.0),
        ("N/kg", "m/s^2", 1.0),
        ("Gal", "m/s^2", 0.01),
        ("rpm", "rad/s", 2 * math.pi / 60),
        ("rpm", "Hz", 1 / 60),
        ("rad/s", "Hz", 1 / (2 * math.pi)),
        ("deg/s", "Hz", 1 / 360),
        ("mG", "m/s^2", 9.8e-3),
        ("M/S2", "m/s^2", 1.0),
        ("MV", "V", 1e6),
        *((volt, "V", 1.0) for volt in ("Volt", "volts")),
        ("mVolt", "V", 1e-3),
        ("DEG/S", "rad/s", math.pi / 180),
        *(("mdps", "rad/s", math.pi / 180e3), ("degrees_north", "rad", math.pi / 180), ("mb", "Pa", 100.0)),
        ("Deg/Hr", "rad/s", math.pi / 180 / 3600),
        ("m/s²", "m/s^2", 1.0),
        ("G", "m/s^2", 9.8),
        *((celsius, "K", 274.15) for celsius in ("\u2103", "C", "degC", "degrees_celsius", "ºC", "Deg. C")),
        *((kelvin, "K", 1.0) for kelvin in ("deg K", "°K", "k")),
        *((acceleration, "m/s^2", 1.0) for acceleration in ("ms-2", "mps2")),
        *((rate, "rad/s", math.pi / 180) for rate in ("°s⁻¹", "deg_per_s", "degree_per_second")),
        ("RPM", "rad/s", 2 * math.pi / 60),
    ],
)
def test_conversions(unit: str, si_unit: str, expected: float) -> None:
    assert units(9.8).to_si(1.0, unit, si_unit) == pytest.approx(expected, rel=1e-14)


NO_UNITS = (
    *("furlogn", "m+s", "m;s", "2 m", "m 2", "m^", "m^^2", "m**n", "(m", "m)", "m/", "'m'", "m s^", "m^-", "//"),
    *("9**9**9", "m**9**9**9", "m^1e400", "m^99", "m" * 200, "__import__('os')", "lambda: 0", "m\x00"),
)  # fmt: skip


@pytest.mark.parametrize("unit", NO_UNITS)
def test_what_is_no_unit(unit: str) -> None:
    with pytest.raises(UserError, match="not a unit"):
        units(9.8).parse(unit, "here")


@settings(deadline=None)
@given(st.text(alphabet="mgsAVK019.^*/() -+uE", max_size=20))
def test_any_text_is_a_unit_or_a_user_error(text: str) -> None:
    with contextlib.suppress(UserError):
        assert units(9.8).base_unit(text)


def test_message_holds_every_fact_and_travels_between_processes() -> None:
    error = UserError("wrong", where="here", found=3, expected="four", remedy="add one")
    assert str(error) == "here: wrong\n  found: 3\n  expected: four\n  remedy: add one"
    assert str(pickle.loads(pickle.dumps(error))) == str(error)
