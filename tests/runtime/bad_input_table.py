"""The table of bad and awkward inputs: how to make each, and what the program has to say about it.

Every row is a test (``test_bad_input_messages.py``) and a paragraph of ``docs/bad-input.md``, which
``python tests/runtime/bad_input_table.py`` writes anew.
"""

from __future__ import annotations

import dataclasses
import gzip
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import commands
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from ragg_runtime.flight import Flight, write_flight
from ragg_runtime.instrument.edit_toml import model_text
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.workflow import loop

Arrays = Mapping[str, np.ndarray]

G0 = 9.8
DOCS = Path(__file__).parents[2] / "docs" / "bad-input.md"
DEG_PER_HOUR = np.pi / 180 / 3600
HIDDEN = {"thermal-scale": {"dK1_dT": [0.0, 0.0, 2e-7, 0.0]}}


@dataclass(frozen=True)
class Row:
    """One bad input.

    Attributes
    ----------
    id
        In words.
    make
        Puts it into the current folder, where a good ``model`` directory stands already.
    says
        What the message has to contain.
    command
        After ``ragg``.
    status
        2: refused; 0: handled, and the result says so.
    """

    id: str
    make: Callable[[], None]
    says: tuple[str, ...]
    command: tuple[str, ...] = ("compare", "model", "flight.csv")
    status: int = 2


# --- what is good --------------------------------------------------------------------------------------


@cache
def good() -> Scenario:
    return scenario(48, duration=300.0)


@cache
def record(hidden: bool = False, voltages: bool = False) -> Flight:
    return good().simulate(HIDDEN if hidden else {}).flight(voltages=voltages)


@cache
def _template() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="bad-input-"))
    (folder / "sheet.toml").write_text(model_text(good().sheet))
    loop.new(folder / "model", folder / "sheet.toml")
    return folder / "model"


def stage(folder: Path) -> None:
    """A folder with a good model directory and a small, well-formed flight in it."""
    shutil.copytree(_template(), folder / "model")
    (folder / "flight.csv").write_text(TEXT)


_NAMES = ["time", *(f"{q}_{k}" for q in ("a", "omega") for k in "xyz"), "G_out"]
_UNITS = ["s", "g", "g", "g", "deg/h", "deg/h", "deg/h", "V"]
HEADER = ",".join(f"{n} [{u}]" for n, u in zip(_NAMES, _UNITS, strict=True))


def _line(k: int) -> str:
    numbers = (k / 16, *(0.01 * np.sin(0.3 * k + n) for n in range(7)))
    return ",".join(f"{x:.6g}" for x in numbers)


TEXT = "\n".join([HEADER, *(_line(k) for k in range(40))]) + "\n"


# --- how to spoil it -----------------------------------------------------------------------------------


def text(new: str, name: str = "flight.csv") -> Callable[[], None]:
    return lambda: void(Path(name).write_text(new))


def void(_: object) -> None:
    return None


def odd_name(name: str) -> Callable[[], None]:
    """A Parquet file whose column ``Temp`` is named in Latin-1 (Temp with an umlaut)."""

    def make() -> None:
        fields = [pa.field(n, pa.float64(), metadata={"units": "1"}) for n in ("time", "Temp")]
        table = pa.Table.from_arrays([pa.array([0.0, 1.0])] * 2, schema=pa.schema(fields))
        pq.write_table(table, name, store_schema=False)
        path = Path(name)
        path.write_bytes(path.read_bytes().replace(b"Temp", b"T\xe4mp"))

    return make


def edited(old: str, new: str) -> Callable[[], None]:
    assert TEXT.count(old), old
    return text(TEXT.replace(old, new, 1))


def binary(content: bytes, name: str) -> Callable[[], None]:
    return lambda: void(Path(name).write_bytes(content))


def toml(old: str, new: str) -> Callable[[], None]:
    def make() -> None:
        path = Path("model/model.toml")
        found = path.read_text()
        assert re.search(old, found, re.MULTILINE), old
        path.write_text(re.sub(old, lambda _: new, found, count=1, flags=re.MULTILINE))

    return make


def flown(
    change: Callable[[Flight], Flight],
    name: str = "flight.csv",
    *,
    hidden: bool = False,
    voltages: bool = False,
    units: Mapping[str, str] | None = None,
    derived: bool = False,
) -> Callable[[], None]:
    """A simulated flight, changed; ``derived``: without the angular acceleration."""

    def make() -> None:
        x = change(record(hidden, voltages))
        if derived:
            kept = {n: v for n, v in x.channels.items() if not n.startswith("omegadot")}
            x = dataclasses.replace(x, channels=kept)
        write_flight(x, name, units, G0)

    return make


def same(x: Flight) -> Flight:
    return x


def channels(change: Callable[[Arrays], Arrays]) -> Callable[[Flight], Flight]:
    return lambda x: dataclasses.replace(x, channels={**x.channels, **change(x.channels)})


def outputs(change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Flight], Flight]:
    return lambda x: dataclasses.replace(x, outputs={n: change(v) for n, v in x.outputs.items()})


def scaled(stems: tuple[str, ...], factor: float) -> Callable[[Flight], Flight]:
    return channels(lambda c: {n: factor * v for n, v in c.items() if n.rsplit("_", 1)[0] in stems})


def motion(change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Flight], Flight]:
    return channels(lambda c: {n: change(v) for n, v in c.items() if n.startswith(("a_", "omega"))})


def exchanged(*pairs: tuple[str, str]) -> Callable[[Flight], Flight]:
    return channels(lambda c: {a: c[b] for p in pairs for a, b in (p, p[::-1])})


def timed(change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Flight], Flight]:
    return lambda x: dataclasses.replace(x, time=change(x.time))


def kept(choose: Callable[[np.ndarray], np.ndarray]) -> Callable[[Flight], Flight]:
    """Some of the rows, as a file that lacks the others."""

    def change(x: Flight) -> Flight:
        rows = choose(np.arange(len(x)))
        return dataclasses.replace(
            x,
            time=x.time[rows],
            channels={n: v[rows] for n, v in x.channels.items()},
            outputs={n: v[rows] for n, v in x.outputs.items()},
            valid=x.valid[rows],
        )

    return change


def blank(x: np.ndarray) -> np.ndarray:
    return np.where((np.arange(len(x)) // 100) % 12 == 5, np.nan, x)


def struck(x: np.ndarray) -> np.ndarray:
    rng = np.random.default_rng(7)
    hit = rng.random(len(x)) < 0.01
    return np.where(hit, x + 5 * np.std(x) * rng.choice([-1.0, 1.0], len(x)), x)


def jittered(size: float) -> Callable[[np.ndarray], np.ndarray]:
    return lambda t: t + np.random.default_rng(8).uniform(-size, size, len(t)) / 16


def with_angle(factor: float) -> Callable[[Flight], Flight]:
    def change(x: Flight) -> Flight:
        return dataclasses.replace(
            x, channels={**x.channels, "spin_angle": factor * 2 * np.pi * 0.25 * x.time}
        )

    return change


def sparse(name: str, head: bytes = b"", size: int = 10 << 30) -> Callable[[], None]:
    def make() -> None:
        with open(name, "wb") as stream:
            stream.write(head)
            stream.truncate(size)

    return make


def cut(name: str, share: float = 0.5) -> Callable[[], None]:
    def make() -> None:
        flown(same, name)()
        whole = Path(name).read_bytes()
        Path(name).write_bytes(whole[: int(share * len(whole))])

    return make


def voltages_ordered(*order: str) -> Callable[[Flight], Flight]:
    def change(x: Flight) -> Flight:
        volts = {f"V_{j}": x.outputs[n] for j, n in enumerate(order, 1)}
        return dataclasses.replace(x, outputs=volts)

    return change


def _with_thermal_effect() -> None:
    toml(r"^effects = \[\]", 'effects = ["thermal-scale"]')()
    flown(
        lambda x: dataclasses.replace(x, channels={n: v for n, v in x.channels.items() if n != "temperature"})
    )()


def folder(name: str) -> Callable[[], None]:
    return lambda: Path(name).mkdir()


def both(*makes: Callable[[], None]) -> Callable[[], None]:
    return lambda: void([m() for m in makes])


def _second_flight_bad() -> None:
    flown(same)()
    flown(outputs(lambda v: -v), "second.csv")()


# --- the table -----------------------------------------------------------------------------------------

_MODEL = "model/model.toml"
_RADIUS = r"^radius = .*$"
_SPIN = r"^spin_frequency = .*$"
_LIKELY = "likely mistake"

TABLE: dict[str, tuple[Row, ...]] = {
    "model.toml": (
        Row(
            "an unknown key",
            toml(r"^radius", "raduis"),
            (_MODEL, "[disc]", "'raduis'", "did you mean 'radius'?"),
        ),
        Row("an unknown table", toml(r"^\[disc\]", "[disk]"), (_MODEL, "'disk'", "did you mean 'disc'?")),
        Row("an unknown parameter", toml(r"^K2 =", "K3 ="), (_MODEL, "[accelerometers]", "'K3'", "one of")),
        Row("a missing table", text("effects = []\n", _MODEL), (_MODEL, "[disc] is missing")),
        Row(
            "a missing value", toml(_RADIUS, ""), (_MODEL, "[disc]", "radius is missing", 'radius = "... m"')
        ),
        Row(
            "a wrong dimension",
            toml(_RADIUS, 'radius = "0.1 s"'),
            (_MODEL, "[disc] radius", "dimension", "'s'", "m"),
        ),
        Row("no unit", toml(_RADIUS, "radius = 0.1"), (_MODEL, "[disc] radius", "unit is missing")),
        Row(
            "an unknown unit",
            toml(_RADIUS, 'radius = "0.1 meterz"'),
            (_MODEL, "[disc] radius", "not a unit", "meterz"),
        ),
        Row(
            "a unit that is code",
            toml(_RADIUS, "radius = \"0.1 __import__('os').system('x')\""),
            (_MODEL, "[disc] radius"),
        ),
        Row(
            "three values",
            toml(r"^dR = .*$", 'dR = { value = [0, 30, 35], unit = "um" }'),
            (_MODEL, "dR", "3 values", "4"),
        ),
        Row(
            "four values where one belongs",
            toml(_RADIUS, 'radius = { value = [1, 2, 3, 4], unit = "m" }'),
            (_MODEL, "[disc] radius", "one number"),
        ),
        Row(
            "NaN",
            toml(r"^dR = .*$", 'dR = { value = [0, nan, 35, 25], unit = "um" }'),
            (_MODEL, "dR", "not finite"),
        ),
        Row(
            "infinity", toml(r"^K0 = .*$", 'K0 = { value = inf, unit = "ug" }'), (_MODEL, "K0", "not finite")
        ),
        Row(
            "text for a number",
            toml(r"^dR = .*$", 'dR = { value = ["a", "b", "c", "d"], unit = "um" }'),
            (_MODEL, "dR", "number"),
        ),
        Row(
            "a negative radius",
            toml(_RADIUS, 'radius = "-0.1 m"'),
            (_MODEL, "[disc] radius", "positive", "-0.1 m"),
        ),
        Row(
            "a negative spin frequency",
            toml(_SPIN, 'spin_frequency = "-0.25 Hz"'),
            (_MODEL, "spin_frequency", "positive"),
        ),
        Row("g0 in g", toml(r"^g0 = .*$", 'g0 = "1 g"'), (_MODEL, "[disc] g0", "defines")),
        Row("a scale factor of zero", toml(r"^K1 = .*$", 'K1 = "0 mA/g"'), (_MODEL, "K1", "zero")),
        Row(
            "an accelerometer beyond the centre",
            toml(r"^dR = .*$", 'dR = { value = [0, 0, 0, -0.2], unit = "m" }'),
            (_MODEL, "dR", "radius + dR", "positive"),
        ),
        Row(
            "an unknown effect",
            toml(r"^effects = .*$", 'effects = ["thermal-scal"]'),
            (_MODEL, "thermal-scal", "did you mean", "thermal-scale"),
        ),
        Row(
            "an effect listed twice",
            toml(r"^effects = .*$", 'effects = ["lag", "lag"]'),
            (_MODEL, "'lag'", "twice", "remove one"),
        ),
        Row(
            "effects that are no list",
            toml(r"^effects = .*$", 'effects = "lag"'),
            (_MODEL, "effects must be a list", '["lag"]'),
        ),
        Row(
            "an effect without an id",
            toml(r"^effects = .*$", "effects = [{ tau = 3 }]"),
            (_MODEL, "entry 1", "not an effect"),
        ),
        Row(
            "an unknown parameter of an effect",
            toml(r"^effects = .*$", 'effects = [{ id = "lag", tao = "1 ms" }]'),
            (_MODEL, "lag", "tao", "tau"),
        ),
        Row(
            "a wrong dimension of an effect's parameter",
            toml(r"^effects = .*$", 'effects = [{ id = "lag", tau = "1 m" }]'),
            ("lag", "tau", "dimension"),
        ),
        Row(
            "a hostile expression",
            toml(
                r"^effects = .*$",
                'effects = [{ id = "x", stage = "transducer", add = "K * __import__(\'os\').system(\'x\')", K = { unit = "ug" } }]',
            ),
            ("x", "__import__"),
        ),
        Row(
            "an effect whose channel the flight lacks",
            _with_thermal_effect,
            ("thermal-scale", "temperature", "flight.csv", "ragg remove"),
        ),
        Row("broken TOML", toml(_RADIUS, 'radius = "0.1 m'), (_MODEL, "not a TOML file", "line")),
        Row("not UTF-8", binary("radius = 1µm".encode("latin-1"), _MODEL), (_MODEL, "not UTF-8")),
        Row(
            "no model directory",
            lambda: None,
            ("nowhere", "no model directory"),
            ("compare", "nowhere", "flight.csv"),
        ),
        Row("a model directory that exists already", lambda: None, ("model", "exist"), ("new", "model")),
        Row(
            "a test sheet that does not exist",
            lambda: None,
            ("none.toml", "does not exist"),
            ("new", "other", "--from", "none.toml"),
        ),
    ),
    "The flight file": (
        Row("no such file", lambda: None, ("none.csv", "does not exist"), ("compare", "model", "none.csv")),
        Row(
            "a directory",
            folder("folder.csv"),
            ("folder.csv", "directory"),
            ("compare", "model", "folder.csv"),
        ),
        Row(
            "a pipe",
            lambda: os.mkfifo("pipe.csv"),
            ("pipe.csv", "pipe", "regular file"),
            ("compare", "model", "pipe.csv"),
        ),
        Row(
            "an unknown ending",
            text(TEXT, "flight.xls"),
            ("flight.xls", ".parquet", ".csv"),
            ("compare", "model", "flight.xls"),
        ),
        Row(
            "an Excel file with the ending csv",
            binary(b"PK\x03\x04....", "flight.csv"),
            ("flight.csv", "Excel", "save it as CSV"),
        ),
        Row(
            "Parquet with the ending csv",
            both(flown(same, "x.parquet"), lambda: void(Path("x.parquet").replace("flight.csv"))),
            ("flight.csv", "parquet", "rename"),
        ),
        Row("an empty file", text(""), ("flight.csv", "empty")),
        Row("a header alone", text(HEADER + "\n"), ("flight.csv", "too few samples", "0 rows")),
        Row(
            "one row",
            text("\n".join(TEXT.splitlines()[:2]) + "\n"),
            ("flight.csv", "too few samples", "1 row"),
        ),
        Row(
            "not a table: prose",
            text("Dear colleague,\n\nplease find the flight attached.\n"),
            ("flight.csv", "unit", "column"),
        ),
        Row(
            "not a table: a picture",
            binary(b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 8, "flight.csv"),
            ("flight.csv", "not a table"),
        ),
        Row(
            "a row with too few values",
            edited(_line(7), "0.4375,1,2"),
            ("flight.csv", "line 9", "wrong number of values", "3", "8"),
        ),
        Row(
            "text among the numbers",
            edited(_line(7), "0.4375,fast,2,3,4,5,6,7"),
            ("flight.csv", "line 9", "'a_x'", "'fast'", "decimal point"),
        ),
        Row("decimal commas", edited(_line(7), _line(7).replace(".", ",")), ("flight.csv", "line 9")),
        Row(
            "a truncated gzip file",
            cut("flight.csv.gz"),
            ("flight.csv.gz", "cut off"),
            ("compare", "model", "flight.csv.gz"),
        ),
        Row(
            "a damaged gzip file",
            binary(gzip.compress(TEXT.encode())[:-30] + b"?" * 30, "flight.csv.gz"),
            ("flight.csv.gz",),
            ("compare", "model", "flight.csv.gz"),
        ),
        Row(
            "a truncated Parquet file",
            cut("flight.parquet"),
            ("flight.parquet", "damaged"),
            ("compare", "model", "flight.parquet"),
        ),
        Row(
            "a Parquet file with a name that is not UTF-8",
            odd_name("flight.parquet"),
            ("flight.parquet", "the name of a column is not UTF-8 text", "xe4mp"),
            ("compare", "model", "flight.parquet"),
        ),
        Row(
            "a truncated NetCDF file",
            cut("flight.nc"),
            ("flight.nc", "damaged"),
            ("compare", "model", "flight.nc"),
        ),
        Row(
            "10 GB of nothing (sparse CSV)",
            sparse("flight.csv"),
            ("flight.csv", "1048576 characters", "not fully copied"),
        ),
        Row("a good header, then 10 GB of nothing", sparse("flight.csv", TEXT.encode()), ("flight.csv",)),
        Row(
            "10 GB of nothing (sparse Parquet)",
            sparse("flight.parquet", b"PAR1"),
            ("flight.parquet", "damaged"),
            ("compare", "model", "flight.parquet"),
        ),
        Row(
            "10 GB of nothing (sparse NetCDF)",
            sparse("flight.nc", b"\x89HDF\r\n\x1a\n"),
            ("flight.nc", "damaged"),
            ("compare", "model", "flight.nc"),
        ),
        Row(
            "a missing column",
            edited("a_y [g]", "ay [g]"),
            ("flight.csv", "a_y is missing", "is 'ay' meant for a_y?"),
        ),
        Row(
            "no output",
            edited("G_out [V]", "gout [V]"),
            ("flight.csv", "output is missing", "did you mean 'G_out'?"),
        ),
        Row(
            "three of four voltages",
            text(
                "\n".join(
                    [
                        HEADER.replace("G_out [V]", "V_1 [V],V_2 [V],V_4 [V]"),
                        *(f"{_line(k)},1,2" for k in range(40)),
                    ]
                )
                + "\n"
            ),
            ("flight.csv", "output is missing", "V_1 V_2 V_3 V_4"),
        ),
        Row(
            "no unit of a column",
            edited("a_y [g]", "a_y"),
            ("flight.csv", "'a_y'", "no unit", "a_y [g]", "none is guessed"),
        ),
        Row(
            "an unknown unit of a column",
            edited("a_y [g]", "a_y [gees]"),
            ("flight.csv", "'a_y'", "not a unit", "gees"),
        ),
        Row(
            "a wrong dimension of a column",
            edited("omega_x [deg/h]", "omega_x [deg]"),
            ("flight.csv", "'omega_x'", "dimension", "rad/s"),
        ),
        Row("a column twice", edited("a_y [g]", "a_x [g]"), ("flight.csv", "'a_x'", "twice", "rename one")),
        Row(
            "a column of nothing",
            flown(channels(lambda c: {"a_y": np.full_like(c["a_y"], np.nan)})),
            ("flight.csv", "'a_y'", "no number"),
        ),
    ),
    "Time": (
        Row(
            "an instant twice",
            edited(_line(8), _line(7)),
            ("flight.csv", "'time'", "twice", "row 8", "remove doubled rows"),
        ),
        Row(
            "time reversed",
            text("\n".join([HEADER, *(_line(k) for k in range(39, -1, -1))])),
            ("flight.csv", "'time'", "backwards", "sort"),
        ),
        Row(
            "two rows exchanged",
            edited(f"{_line(7)}\n{_line(8)}", f"{_line(8)}\n{_line(7)}"),
            ("flight.csv", "'time'", "runs back", "row 8", "sort"),
        ),
        Row(
            "time standing still",
            text("\n".join([HEADER, *("1" + _line(k)[_line(k).index(",") :] for k in range(40))])),
            ("flight.csv", "'time'", "stands still"),
        ),
        Row("an instant missing", edited("\n0.5,", "\n,"), ("flight.csv", "'time'", "missing", "row 9")),
        Row(
            "no steady rate at all",
            flown(timed(lambda t: np.cumsum(np.random.default_rng(1).exponential(1 / 16, len(t))))),
            ("flight.csv", "not uniformly sampled", "resample"),
        ),
        Row(
            "pieces far apart",
            flown(timed(lambda t: np.where(t < 150, t, t + 1e6))),
            ("flight.csv", "nine samples in ten", "split"),
        ),
        Row(
            "shorter than one revolution",
            text("\n".join([HEADER, *(_line(k) for k in range(40))])),
            ("flight.csv", "shorter than one revolution", "4 s", "unit of time"),
        ),
        Row(
            "time in seconds, called milliseconds",
            flown(timed(lambda t: 1e-3 * t), units={"time": "ms"}),
            ("flight.csv", "shorter than one revolution", "unit of time"),
        ),
        Row(
            "time in milliseconds, called seconds",
            flown(timed(lambda t: 1e3 * t)),
            ("flight.csv", "too slowly", "unit of time"),
        ),
        Row(
            "jittering stamps",
            flown(timed(jittered(0.1)), hidden=True, derived=True),
            ("jitters", "sampled evenly", "replaced by even ones"),
            status=0,
        ),
        Row(
            "heavily jittering stamps",
            flown(timed(jittered(0.4)), hidden=True, derived=True),
            ("jitters", "sampled evenly"),
            status=0,
        ),
        Row(
            "gaps",
            flown(kept(lambda k: k[(k // 100) % 12 != 5])),
            ("4 gaps: 400 of 4800 samples missing", "not used"),
            status=0,
        ),
        Row("a time that starts anywhere", flown(timed(lambda t: t + 1.7e9)), ("4800 samples",), status=0),
        Row(
            "a file cut out of a longer one",
            flown(kept(lambda k: k[37:])),
            ("angle 0 at t = 0 s", "counted from there"),
            status=0,
        ),
        Row(
            "a file cut out of a longer one, its time set to zero",
            flown(lambda x: timed(lambda t: t - t[0])(kept(lambda k: k[37:])(x))),
            (_LIKELY, "degrees at the first sample", "cut out", "spin_angle"),
        ),
    ),
    "Values": (
        Row(
            "runs of NaN in the output",
            flown(outputs(blank)),
            ("G_out: without a value at 400 samples, not used",),
            status=0,
        ),
        Row(
            "runs of NaN in the motion",
            flown(motion(blank), derived=True),
            ("a_x: without a value at 400 samples, not used",),
            status=0,
        ),
        Row(
            "1 % spikes in the output",
            flown(outputs(struck)),
            ("G_out", "samples stand far off the neighbours", "not used"),
            status=0,
        ),
        Row(
            "1 % spikes in the motion",
            flown(channels(lambda c: {n: struck(c[n]) for n in ("a_y", "omega_x")}), derived=True),
            ("far off the neighbours", "not used"),
            status=0,
        ),
        Row(
            "a saturated output",
            flown(outputs(lambda v: np.clip(v, -60, 60))),
            ("saturated, not used",),
            status=0,
        ),
        Row(
            "an output that does not change",
            flown(outputs(lambda v: np.full_like(v, 1.5))),
            ("flight.csv", "'G_out'", "does not change", "disconnected"),
        ),
        Row(
            "a motion column that does not change",
            flown(channels(lambda c: {"omega_z": np.full_like(c["omega_z"], 5e-4)})),
            ("omega_z does not change", "stuck sensor"),
            status=0,
        ),
        Row(
            "all motion constant",
            flown(
                channels(lambda c: {n: np.full_like(v, v[0]) for n, v in c.items() if n[:2] in ("a_", "om")})
            ),
            ("motion does not change at all",),
            status=0,
        ),
    ),
    "Likely mistakes": (
        Row(
            "g, called m/s^2",
            flown(scaled(("a",), 1 / G0)),
            (_LIKELY, "a_x, a_y, a_z are in g, not in m/s^2", "[g]"),
        ),
        Row(
            "m/s^2, called g, with the voltages",
            flown(scaled(("a",), G0), voltages=True, units={f"a_{k}": "g" for k in "xyz"}),
            (_LIKELY, "are in m/s^2, not in g"),
        ),
        Row(
            "deg/s, called deg/h",
            flown(scaled(("omega",), 1 / 3600), derived=True, units={f"omega_{k}": "deg/h" for k in "xyz"}),
            (_LIKELY, "in deg/s, not in deg/h", "[deg/s]"),
        ),
        Row(
            "deg/h, called deg/s",
            flown(scaled(("omega",), 3600), derived=True, units={f"omega_{k}": "deg/s" for k in "xyz"}),
            (_LIKELY, "in deg/h, not in deg/s", "[deg/h]"),
        ),
        Row(
            "deg/s, called rad/s",
            flown(scaled(("omega",), 180 / np.pi), derived=True),
            (_LIKELY, "in deg/s, not in rad/s"),
        ),
        Row(
            "an angular rate off by 3600, its derivative right",
            flown(scaled(("omega",), 1 / 3600), units={f"omega_{k}": "deg/h" for k in "xyz"}),
            (_LIKELY, "omega_x, omega_y, omega_z", "deg/h for deg/s?"),
        ),
        Row(
            "output in mV, called V",
            flown(outputs(lambda v: 1e3 * v)),
            (_LIKELY, "G_out is in mV, not in V", "[mV]"),
        ),
        Row(
            "output in V, called mV",
            flown(outputs(lambda v: 1e-3 * v), units={"G_out": "mV"}),
            (_LIKELY, "G_out is in V, not in mV"),
        ),
        Row(
            "a_x and a_z exchanged", flown(exchanged(("a_x", "a_z"))), (_LIKELY, "a_x and a_z are exchanged")
        ),
        Row(
            "omega_x and omega_z exchanged",
            flown(exchanged(("omega_x", "omega_z")), derived=True),
            (_LIKELY, "omega_x and omega_z are exchanged"),
        ),
        Row(
            "a_y with the wrong sign",
            flown(channels(lambda c: {"a_y": -c["a_y"]})),
            (_LIKELY, "a_y has the wrong sign"),
        ),
        Row(
            "the sign of G_out reversed",
            flown(outputs(lambda v: -v)),
            (_LIKELY, "the sign of G_out is reversed", "-1"),
        ),
        Row(
            "the sign of Gamma reversed",
            flown(scaled(("Gamma",), -1.0)),
            (_LIKELY, "the sign of Gamma is reversed"),
        ),
        Row(
            "V_2 and V_3 exchanged",
            flown(voltages_ordered("V_1", "V_3", "V_2", "V_4"), voltages=True),
            (_LIKELY, "V_2 and V_3 are exchanged"),
        ),
        Row(
            "spin rate 1 % too high",
            both(flown(same), toml(_SPIN, 'spin_frequency = "0.2525 Hz"')),
            (_LIKELY, "the spin rate is 0.25 Hz", "0.2525 Hz", 'spin_frequency = "0.25 Hz"'),
        ),
        Row(
            "spin rate 1 % too low",
            both(flown(same), toml(_SPIN, 'spin_frequency = "0.2475 Hz"')),
            (_LIKELY, "the spin rate is 0.25 Hz"),
        ),
        Row(
            "an encoder that runs backwards",
            flown(with_angle(-1.0)),
            (_LIKELY, "turns the other way", "spin_angle runs backwards"),
        ),
        Row(
            "an encoder in degrees, called radians",
            flown(with_angle(180 / np.pi)),
            ("spin_angle", "degrees for radians?"),
        ),
        Row(
            "motion 2 s late",
            flown(motion(lambda v: np.roll(v, 32))),
            (_LIKELY, "the motion record is 2 s (32 samples) late"),
            status=0,
        ),
        Row(
            "motion one sample early",
            flown(motion(lambda v: np.roll(v, -1))),
            (_LIKELY, "0.0625 s (1 sample) early"),
            status=0,
        ),
        Row(
            "output and disc apart",
            flown(outputs(lambda v: np.roll(v, 5))),
            (_LIKELY, "the output is 0.3125 s (5 samples) late"),
            status=0,
        ),
        Row(
            "the second of two flights",
            _second_flight_bad,
            ("second.csv", _LIKELY, "sign of G_out"),
            ("diagnose", "model", "flight.csv", "second.csv"),
        ),
    ),
    "Commands": (
        Row(
            "an effect that is not known",
            flown(same),
            ("lagg", "did you mean", "lag"),
            ("add", "model", "lagg", "flight.csv"),
        ),
        Row(
            "an effect that is not in the model",
            lambda: None,
            ("lag", "not in the model"),
            ("remove", "model", "lag"),
        ),
        Row(
            "a number that is none",
            lambda: None,
            ("lag", "not a number", "fast"),
            ("simulate", "model", "--effect", "lag:tau=fast", "-o", "x.csv"),
        ),
        Row(
            "a hidden effect without a value",
            lambda: None,
            ("lag", "no value", "lag:tau=VALUE"),
            ("simulate", "model", "--effect", "lag", "-o", "x.csv"),
        ),
        Row(
            "three values of a hidden effect",
            lambda: None,
            ("tau", "four joined by /"),
            ("simulate", "model", "--effect", "lag:tau=1/2/3", "-o", "x.csv"),
        ),
        Row(
            "a negative duration",
            lambda: None,
            ("--duration",),
            ("simulate", "model", "--duration", "-5", "-o", "x.csv"),
        ),
        Row(
            "an output file of no known format",
            lambda: None,
            ("x.xls", ".parquet"),
            ("simulate", "model", "--duration", "60", "-o", "x.xls"),
        ),
        Row("no flight", lambda: None, ("FLIGHTS",), ("compare", "model")),
        Row(
            "a report without a flight",
            lambda: None,
            ("report", "flight"),
            ("add", "model", "lag", "--report", "r.html"),
        ),
        Row(
            "JSON into a folder that is not there",
            flown(same),
            ("none",),
            ("compare", "model", "flight.csv", "--json", "none/x.json"),
        ),
        Row(
            "a report into a folder that is not there",
            flown(same),
            ("none",),
            ("compare", "model", "flight.csv", "--report", "none/x.html"),
        ),
        Row("an unknown option", lambda: None, ("--jsn",), ("compare", "model", "flight.csv", "--jsn", "-")),
    ),
    "Mappings and the field's files": (
        Row(
            "a mapping with a question left",
            both(
                flown(same),
                text('[time]\ncolumn = "time"\n[columns]\na_x = { column = "a_x", unit = "?" }\n', "m.toml"),
            ),
            ("m.toml", "a_x", "not answered"),
            ("compare", "model", "flight.csv", "--map", "m.toml"),
        ),
        Row(
            "a mapping of another file",
            both(flown(same), text('[time]\ncolumn = "UTC"\nformat = "iso"\n', "m.toml")),
            ("UTC", "not in the file", "ragg map"),
            ("compare", "model", "flight.csv", "--map", "m.toml"),
        ),
        Row(
            "axes that are a mirror image",
            both(flown(same), text('[time]\ncolumn = "time"\n[axes]\nx = "y"\ny = "x"\n', "m.toml")),
            ("mirror", "right-handed", "sign = -1"),
            ("compare", "model", "flight.csv", "--map", "m.toml"),
        ),
        Row(
            "a .dat file without its .dfn",
            text("1 2 3\n", "flight.dat"),
            ("flight.dfn", "missing"),
            ("compare", "model", "flight.dat"),
        ),
        Row(
            "an XYZ file without units",
            text("/ time a_x\nLine 10\n0 1\n1 2\n", "flight.xyz"),
            ("no unit", "ragg map"),
            ("compare", "model", "flight.xyz"),
        ),
        Row(
            "converted into an unknown format",
            flown(same),
            (".xls", ".xlsx"),
            ("convert", "flight.csv", "flight.xls"),
        ),
    ),
}


# --- running it ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Ran:
    """What a command did: exit status, both streams, and the model directory before and after."""

    status: int
    out: str
    err: str
    before: Mapping[str, bytes] = field(repr=False)
    after: Mapping[str, bytes] = field(repr=False)

    @property
    def message(self) -> str:
        """The error, or the notes of a result, without progress."""
        if self.status:
            return "\n".join(x for x in self.err.splitlines() if not x.startswith("... "))
        return "\n".join(x for x in self.out.splitlines() if x.startswith("note: "))


def tree(path: Path) -> dict[str, bytes]:
    return {str(p.relative_to(path)): p.read_bytes() for p in sorted(path.rglob("*")) if p.is_file()}


@contextmanager
def inside(place: Path) -> Iterator[None]:
    old, name = Path.cwd(), sys.argv[0]
    os.chdir(place)
    sys.argv[0] = "ragg"
    try:
        yield
    finally:
        os.chdir(old)
        sys.argv[0] = name


def ran(row: Row, place: Path) -> Ran:
    """Make the input in an empty folder and run the command in this process."""
    stage(place)
    with inside(place):
        row.make()
        before = tree(Path("model"))
        done = commands.ragg(*row.command)
        return Ran(done.returncode, done.stdout, done.stderr, before, tree(Path("model")))


def rows() -> list[tuple[str, Row]]:
    return [(topic, row) for topic, found in TABLE.items() for row in found]


def paragraph(row: Row, r: Ran) -> str:
    """An input and its message, as the documentation shows it."""
    outcome = f"exit status {r.status}" if r.status else "handled"
    first = row.id.split()[0].rstrip(",")
    # a name or a unit stays as it is written
    title = (
        row.id if (len(first) > 1 and not first.isalpha()) or first == "g" else row.id[0].upper() + row.id[1:]
    )
    message = [f"    {x}".rstrip() for x in (r.message or "(nothing to say)").splitlines()]
    return "\n".join([f"**{title}** (`ragg {' '.join(row.command)}`; {outcome})", "", *message])


def page() -> str:
    """The documentation: every input and its message."""
    lines = [
        "# Bad and awkward input",
        "",
        "Written by `python tests/runtime/bad_input_table.py` from the table that the tests run through. Bad input ends",
        "with exit status 2, one message (what, where, found, expected, remedy) and everything left as it was. What can",
        "be handled is handled, and the result says so in its notes (on the terminal, in `notes` of the JSON, in the",
        "report). A likely mistake is recognised by undoing it: the model, which leaves most of the record unexplained",
        "as it stands, explains it then. Where two mistakes would explain a record equally well both are named.",
        "What no record can tell is not guessed: on an instrument with matched scale factors, of which G_out alone was",
        "recorded, a specific force 9.8 times too large is made up for by scale factors that match a little better still.",
        "",
        f"{len(rows())} inputs:",
    ]
    for topic, found in TABLE.items():
        lines += ["", f"## {topic}"]
        for row in found:
            with tempfile.TemporaryDirectory() as place:
                lines += ["", paragraph(row, ran(row, Path(place)))]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    DOCS.write_text(page(), "utf-8")
    sys.stdout.write(f"{DOCS}\n")
