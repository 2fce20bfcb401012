"""`ragg export`: a calibrated, extended model elsewhere, and the recursive form: the same figures from C17 or NumPy."""

from __future__ import annotations

import dataclasses
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.export import write_values
from ragg_runtime.compensation.recursive import UPDATE
from ragg_runtime.io import read_flight, write_flight
from ragg_runtime.model.model import evaluate_output, make_vector, scale_factor
from ragg_runtime.model.record import record
from tests.runtime.flown_twice import BRIEF, files, flights, new_model, run
from tests.simulated import RATE

Array = NDArray[np.float64]

HALF = slice(0, 3600)

WARNED = "CFLAGS=-std=c17 -O0 -Wall -Wextra -Wconversion -Wno-sign-conversion -Werror -pedantic"
STRICT = f"{WARNED} -fsanitize=undefined,address -fno-sanitize-recover=all"


def make_strictly(folder: Path, target: str) -> str:
    """With every warning an error, and for the sanitizers."""
    words = ["make", "-C", str(folder), STRICT, target]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def program(folder: Path, motion: bytes) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run([folder / "ragg_model"], input=motion, capture_output=True, check=False)


def answer(text: bytes) -> tuple[Array, Array]:
    lines = text.decode().splitlines()
    assert lines[0] == "time,G_out"
    rows = np.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    return rows[:, 0], rows[:, 1]


def answered(folder: Path, which: str = "motion") -> Array:
    """G_out of a test of an export."""
    return np.asarray(np.genfromtxt(folder / "test" / f"{which}.csv", delimiter=",", names=True)["G_out_V"])


@pytest.fixture(scope="module")
def base(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, Path]:
    """A calibrated model, its program, and a flight as CSV in SI."""
    folder = tmp_path_factory.mktemp("base")
    model, (one, _) = new_model(folder), files(folder, rows=BRIEF)
    run("calibrate", model, one, "--save")
    run("export", model, folder / "c", "--c")
    assert "largest difference" in make_strictly(folder / "c", "check")
    write_flight(flights()[0].part(HALF), folder / "one.csv")
    return model, folder / "c", folder / "one.csv"


@pytest.fixture(scope="module")
def extended(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, Path]:
    """The same with the disc's own rate, a lag, which needs derivatives of the motion, and an effect of the temperature."""
    folder = tmp_path_factory.mktemp("extended")
    model = new_model(folder)
    text = (model / "model.toml").read_text()
    values = (
        'effects = [{ id = "lag", tau = { value = [1e-8, 0, 2e-8, 0], unit = "s" } }, '
        '{ id = "thermal-scale", dK1_dT = { value = [0, 0, 2e-4, 0], unit = "1/K" } }]'
    )
    assert "effects = []" in text
    full = text.replace("effects = []", values).replace('"platform"', '"full"')
    (folder / "extended.toml").write_text(full)
    run("new", folder / "e", "--from", folder / "extended.toml")
    run("export", folder / "e", folder / "c", "--c")
    make_strictly(folder / "c", "check")
    x = flights()[0].part(HALF)
    late = x.time + 10.25  # by the convention the disc's angle is not 0 at the first sample
    write_flight(dataclasses.replace(x, time=late, began=None), folder / "one.csv")
    return folder / "e", folder / "c", folder / "one.csv"


def expected(model: Path, flight: Path) -> tuple[Array, float]:
    m = api.load(model)
    p = api.contents(m).p
    x, chain = read_flight(flight, m.instrument.g0), dataclasses.replace(m.model.chain, sources={})
    return evaluate_output(chain, record(x, m.instrument), p), scale_factor(m.model, p)


@pytest.mark.parametrize("which", ["base", "extended"])
def test_the_program_gives_what_python_gives(which: str, request: pytest.FixtureRequest) -> None:
    model, folder, flight = request.getfixturevalue(which)
    time, G = answer(program(folder, flight.read_bytes()).stdout)
    found, k_ggi = expected(model, flight)
    assert len(G) == len(found)
    assert np.max(np.abs(G - found)) / k_ggi < 1e-6
    assert np.std(G) / k_ggi > 1e4
    if which == "extended":
        assert np.max(np.abs(G - found)) / k_ggi < 1e-9
    assert time[1] == flights()[0].time[1] + (10.25 if which == "extended" else 0.0)


@pytest.mark.parametrize("which", ["base", "extended"])
def test_the_angular_acceleration_is_derived_as_python_does_it(
    which: str, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    """From a file with neither omegadot nor all of its rows: beside gaps and ends too, wherever Python has a value."""
    model, folder, flight = request.getfixturevalue(which)
    table = [line.split(",") for line in flight.read_text().splitlines()]
    kept = [k for k, name in enumerate(table[0]) if not name.startswith("omegadot")]
    rows = [",".join(row[k] for k in kept) for row in [*table[:1500], *table[1507:2800], *table[3000:]]]
    bare = tmp_path / "bare.csv"
    bare.write_text("\n".join(rows))
    time, G = answer(program(folder, bare.read_bytes()).stdout)
    m = api.load(model)
    x = read_flight(bare, m.instrument.g0)
    p = api.contents(m).p
    output, k_ggi = evaluate_output(m.model.chain, record(x, m.instrument), p), scale_factor(m.model, p)
    places = np.searchsorted(x.time, time - 1e-3)
    assert len(places) == len(rows) - 1
    gaps = np.abs(np.subtract.outer(time, time[[0, 1498, 1499, 2791, 2792, -1]])).min(axis=1)
    away = gaps > (0.0 if which == "base" else 2.0)  # the lag's further derivatives begin anew after a gap
    # differences of the rates multiply their rounding, most of all near the ends: 1.01e-6 Eo there, 7e-8 in the median
    assert np.max(np.abs(G - output[places])[away]) / k_ggi < 2e-6
    assert np.median(np.abs(G - output[places])[away]) / k_ggi < 2e-7
    one = rows[0] + ",omegadot_y [rad/s^2]\n" + rows[1] + ",0"
    assert b"omegadot_x: the column is missing" in program(folder, one.encode()).stderr
    lines = [
        ",".join([str(float(row.split(",")[0]) + 0.01 * (k % 2)), row.partition(",")[2]])
        for k, row in enumerate(rows[1:99])
    ]
    uneven = program(folder, "\n".join([rows[0], *lines]).encode())
    assert (uneven.returncode, b"or columns omegadot_x" in uneven.stderr) == (2, True)


def test_the_values_are_the_calibrated_ones(base: tuple[Path, Path, Path]) -> None:
    model, folder, _ = base
    m = api.load(model)
    saved = api.saved_calibration(m)
    assert not np.array_equal(saved.p, make_vector(m.model, m.instrument))
    stdout = subprocess.run(
        [folder / "ragg_model", "--values"], capture_output=True, text=True, check=True
    ).stdout
    assert [float(line.split()[2]) for line in stdout.splitlines()] == saved.p.tolist()
    assert "K1[1] = " in stdout
    assert "calibrated" in (folder / "values.h").read_text()


BAD = {
    "a_x [m/s^2]": ("a_x [g]", "a_x: the column is not in SI units"),
    "omega_y [rad/s]": ("omega_y [deg/h]", "omega_y: the column is not in SI units"),
    "a_z [m/s^2]": ("a_zz [m/s^2]", "a_z: the column is missing"),
    "omegadot_z [rad/s^2]": ("my_z [rad/s^2]", "omegadot_z: the column is missing"),
    "time [s]": ("time [ms]", "time: the column is not in SI units"),
    "a_y [m/s^2]": ("a_y", "a_y: the column has no unit"),
    "omega_x [rad/s]": ("a_x [m/s^2]", "a_x: the column appears twice"),
}


def test_the_functions_are_called_from_cpp(base: tuple[Path, Path, Path], tmp_path: Path) -> None:
    _, folder, _ = base
    headers = sorted(x.name for x in folder.glob("*.h"))
    calls = (
        "static const double t = 0.0, p[RAGG_FOLDED_PARAMETERS] = {}; double G = 1.0; const double *in[RAGG_FOLDED_INPUTS];"
        " for (const double *&x : in) x = &t; ragg_folded_output(1, &t, in, p, nullptr, &G);"
    )
    text = "".join(f'#include "{h}"\n' for h in headers) + f"int main() {{ {calls} return 0; }}\n"
    (tmp_path / "use.cpp").write_text(text, "utf-8")
    warned = "-std=c++17 -O0 -Wall -Wextra -pedantic -Werror -Wno-unused-function"
    for command in (
        f"gcc -std=c17 -O0 -c {folder}/folded.c -o folded.o",
        f"g++ {warned} -I{folder} use.cpp folded.o -lm -o use",
        "./use",
    ):
        done = subprocess.run(command.split(), cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr


def test_a_wrong_header_or_row_is_one_message(base: tuple[Path, Path, Path]) -> None:
    _, folder, flight = base
    lines = flight.read_text().splitlines()[:40]
    for what, (wrong, message) in BAD.items():
        assert what in lines[0]
        done = program(folder, "\n".join([lines[0].replace(what, wrong), *lines[1:]]).encode())
        assert (done.returncode, done.stdout, done.stderr.count(b"ragg_model:")) == (2, b"", 1)
        assert message in done.stderr.decode()
    rows = {
        "row 3 after the header, column time": [*lines[:3], "x" + lines[3]],
        "wrong number of values": [*lines[:3], "1,2"],
        "no rows": lines[:1],
    }
    for message, text in rows.items():
        done = program(folder, "\n".join(text).encode())
        assert (done.returncode, message in done.stderr.decode()) == (2, True)
    missing = list(lines)
    for at, code in ((5, ""), (7, "-9999"), (9, "-999.25"), (11, "1e32"), (13, "NaN")):
        missing[at] = re.sub(",[^,]*,", f",{code},", lines[at], count=1)
    G = answer(program(folder, ("\ufeff# a note\n\n" + "\n".join(missing)).encode()).stdout)[1]
    assert np.flatnonzero(np.isnan(G)).tolist() == [4, 6, 8, 10, 12]
    quoted = '"' + lines[0].replace(",", '";"') + '"'
    done = program(folder, "\n".join([quoted, *(x.replace(",", ";") for x in lines[1:])]).encode())
    assert (done.returncode, done.stdout.count(b"\n")) == (0, len(lines))


def test_numpy_alone_gives_the_same(extended: tuple[Path, Path, Path], tmp_path: Path) -> None:
    model, _, flight = extended
    run("export", model, tmp_path / "n", "--numpy")
    command = [sys.executable, "-I", "-c", _ALONE, str(tmp_path / "n")]
    short = "\n".join(flight.read_text().splitlines()[:2000])
    done = subprocess.run(command, input=short, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    _, G = answer(done.stdout.encode())
    found, k_ggi = expected(model, flight)
    # the derivative at the cut's end is another
    assert np.max(np.abs(G[:1900] - found[:1900])) / k_ggi < 1e-6
    motion, derived = (
        (tmp_path / "n" / "test" / f"{x}.csv").read_text() for x in ("motion", "derived_motion")
    )
    done = subprocess.run(command, input=motion, capture_output=True, text=True, check=True)
    gap = np.abs(answer(done.stdout.encode())[1] - answered(tmp_path / "n", "motion"))
    assert np.max(gap) / k_ggi < 1e-6
    done = subprocess.run(command, input=derived, capture_output=True, text=True, check=False)
    assert done.returncode == 1 and "is not derived from spin_angle here" in done.stderr


_ALONE = """
import runpy, sys
folder = sys.argv[1]
sys.path.insert(0, folder)
class Only:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("scipy", "pandas", "sympy", "ragg_runtime", "derive", "generated"):
            raise ImportError(name)
sys.meta_path.insert(0, Only())
runpy.run_path(folder + "/ragg_model.py", run_name="__main__")
"""


def test_the_document_holds_everything(extended: tuple[Path, Path, Path], tmp_path: Path) -> None:
    model, _, _ = extended
    run("export", model, tmp_path / "j", "--json")
    d = json.loads((tmp_path / "j" / "model.json").read_text())
    assert [e["id"] for e in d["effects"]] == ["lag", "thermal-scale"]
    p = np.concatenate([q["values"] for q in d["parameters"]])
    m = api.load(model)
    assert np.array_equal(p, make_vector(m.model, m.instrument))
    assert all(q["unit"] and q["meaning"] for q in d["parameters"])
    assert len(d["example"]["G_out"]) == len(d["example"]["columns"]["time"])
    before = (tmp_path / "j" / "model.json").read_bytes()
    run("export", model, tmp_path / "j", "--json")  # over its own
    assert (tmp_path / "j" / "model.json").read_bytes() == before


def test_codes_of_the_mapping_are_missing_values(extended: tuple[Path, Path, Path], tmp_path: Path) -> None:
    model, _, flight = extended
    shutil.copytree(model, tmp_path / "m")
    columns = 'a_x = { column = "A", unit = "m/s^2" }\na_y = { column = "B", unit = "m/s^2", null = 7 }\n'
    mapping = f'null = [-5, "x"]\n[time]\ncolumn = "t"\nunit = "s"\n[columns]\n{columns}'
    (tmp_path / "m" / "mapping.toml").write_text(mapping)
    c = api.contents(api.load(tmp_path / "m"))
    assert c.null == {"time": [-5.0], "a_x": [-5.0], "a_y": [-5.0, 7.0]}
    names = re.findall(r'^    \{"(\w+)", ".*", \d\},$', write_values(c, "plain"), re.MULTILINE)
    codes = [(names[k], x) for k, x in _codes(write_values(c, "plain")) if k >= 0]
    assert sorted(codes) == sorted((n, x) for n, several in c.null.items() for x in several)
    run("export", tmp_path / "m", tmp_path / "n", "--numpy")
    lines = flight.read_text().splitlines()[:100]
    at = lines[0].split(",").index("a_y [m/s^2]")
    cells = lines[50].split(",")
    lines[50] = ",".join([*cells[:at], "7", *cells[at + 1 :]])
    command = [sys.executable, "-I", "-c", _ALONE, str(tmp_path / "n")]
    done = subprocess.run(command, input="\n".join(lines), capture_output=True, text=True, check=True)
    assert np.isnan(answer(done.stdout.encode())[1][49])
    assert np.isfinite(answer(done.stdout.encode())[1][:20]).all()


def _codes(text: str) -> list[tuple[int, float]]:
    listed = re.search(r"CODE\[CODES\] = \{(.*)\};", text)
    assert listed is not None
    return [(int(k), float(x)) for k, x in re.findall(r"\{(-?\d+), ([^}]+)\}", listed[1])]


def test_a_folder_with_other_things_is_left_alone(base: tuple[Path, Path, Path], tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(UserError, match="not empty"):
        api.export(api.load(base[0]), tmp_path, "c")
    assert [p.name for p in tmp_path.iterdir()] == ["mine.txt"]
    with pytest.raises(UserError, match="unknown form"):
        api.export(api.load(base[0]), tmp_path / "x", "fortran")


def test_a_calibration_of_another_model_is_not_exported(
    base: tuple[Path, Path, Path], tmp_path: Path
) -> None:
    model, _, _ = base
    copy = new_model(tmp_path)
    text = (model / "calibration.json").read_text().replace('"effects": []', '"effects": ["lag"]')
    (copy / "calibration.json").write_text(text)
    stdout = run("export", copy, tmp_path / "c", "--c")
    assert "values of model.toml: the saved calibration belongs to another model" in stdout


def test_an_effect_with_a_memory_is_refused_by_name(tmp_path: Path) -> None:
    c = api.contents(api.new(tmp_path / "m"))
    slips = c.model.effect("bias-hysteresis")
    assert slips is not None
    with pytest.raises(UserError, match="bias-hysteresis cannot be exported"):
        dataclasses.replace(c, model=dataclasses.replace(c.model, effects=(slips,))).inputs()


def test_the_command_follows_a_flight_within_its_uncertainty(
    base: tuple[Path, Path, Path], tmp_path: Path
) -> None:
    model, _, _ = base
    flight = flights()[1].part(slice(0, 3200))
    write_flight(flight, tmp_path / "two.parquet")
    out = ("-o", tmp_path / "o.csv", "--json", tmp_path / "o.json")
    stdout = run("compensate", model, tmp_path / "two.parquet", "--calibration", "online", *out)
    assert "time constant 0.796 s" in stdout
    rows = np.genfromtxt(tmp_path / "o.csv", delimiter=",", names=True)
    assert len(rows) == 3200 / RATE / UPDATE - 1
    c = flight.channels
    true = {"inline": c["Gamma_xx"] - c["Gamma_yy"], "cross": c["Gamma_xy"]}
    assert set(rows["quality_1"]) == {0}
    for name, x in true.items():
        error = rows[f"{name}_Eo"] - np.interp(rows["time_s"], flight.time, x / 1e-9)
        z = (error / rows[f"{name}_std_Eo"])[rows["time_s"] > 10]
        assert 0.6 < np.mean(np.abs(z) < 1) < 0.9
        assert np.mean(np.abs(z) < 1.96) > 0.9
    d = json.loads((tmp_path / "o.json").read_text())
    assert d["calibration"] == "online" and d["started"].startswith("calibration made")
    assert 1.0 < d["noise_Eo_per_rtHz"] < 3.0


def test_a_fresh_model_follows_with_stated_noise_and_flags_a_gap(tmp_path: Path) -> None:
    fresh, flight = new_model(tmp_path), flights()[1].part(slice(0, 3200))
    with pytest.raises(UserError, match="the noise is not known"):
        api.compensate(api.load(fresh), [flight], "online")
    G = np.array(flight.outputs["G_out"][:400])
    G[200:240] = np.nan
    gap = dataclasses.replace(flight.part(slice(0, 400)), outputs={"G_out": G})
    w = api.compensate(api.load(fresh), [gap], "online", noise=2.0, forget=100.0)
    assert (w.as_json()["started"], w.as_json()["forget_s"]) == ("sheet", 100.0)
    assert list(w.series[0]) == ["time", "inline", "cross", "inline_std", "cross_std", "quality"]
    bridged = w.series[0]["time"][w.series[0]["quality"] > 0]
    assert flight.time[199] < bridged.min() < bridged.max() < flight.time[240] + UPDATE
