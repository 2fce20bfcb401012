"""The corpus: ``corpus/<target>/*``, well-formed seeds and everything that was ever found.

``python -m tests.fuzz.seeds`` writes the seeds again; findings are added by hand, under a name that says what
they were.
"""

from __future__ import annotations

import gzip
import tempfile
from pathlib import Path

import numpy as np

CORPUS = Path(__file__).parent / "corpus"

EXPRESSIONS = (
    "K*f_i",
    "K_x * f_i**2 * temperature",
    "K*(f_o - 0.5*f_p)**3/(1 + 1e-3*abs(f_i))",
    "c*tanh(f_i)*sign(omega_z) + K*exp(-time)",
    "K*sqrt(abs(f_p))*cos_phi - K*sin(sin_phi)",
    "-K*+f_i/3",
)

MODEL = """# a model
effects = ["lag", { id = "cubic-input", K_iii = { value = [2, 0, 0, 0], unit = "ug/g^3" } },
  { id = "mine", stage = "transducer", add = "K_x * f_i**2 * temperature", K_x = { unit = "ug/g^2/K" } }]
[disc]
radius = "0.1 m"
spin_frequency = "0.25 Hz"
g0 = "9.8 m/s^2"
[accelerometers]
dR = { value = [1, -2, 3, 0.5], unit = "um" }
K0 = "30 ug"
K1 = { value = 10, unit = "mA/g" }
K2 = { value = [1.5, 2, 3, 4], unit = "ug/g^2" }
k_VI = "1e9 ohm"
"""
TABLES = """[disc]
radius = "100 mm"
spin_frequency = "15 rpm"
g0 = "980 cm/s^2"
[[effects]]
id = "gain-step"
t_step = "3 s"
[[effects]]
id = "own"
stage = "transducer"
add = "c*f_o**3"
params = { c = { unit = "ug/g^3", plausible = 2.0, shared = true } }
[accelerometers]
K1 = "10 mA/g" # a comment
k_VI = "1e9 ohm"
"""

MAPPING = """version = 1
[file]
line = "LINE"
lines = ["1010", "1020"]
part = "flight/imu"
[time]
column = ["WEEK", "SECOND"]
format = "gps"
[columns]
a_x = { column = "ACC1", unit = "g", sign = -1, scale = 1.0, offset = 0.25 }
temperature = "T"
[axes]
x = "y"
y = "x"
z = "-z"
[demodulator]
kind = "butterworth"
cutoff = "0.18 Hz"
order = 6
delay = "2 s"
"""
SECONDS = """[time]
column = "UTC"
format = "seconds"
unit = "ms"
origin = 2026-03-01T00:00:00Z
[columns]
omega_z = { column = "G3", unit = "deg/h" }
"""
STEPS = """{"version": 1, "written_by": "ragg 0.1.0", "steps": [
{"action": "new", "effect": null, "time": "2026-11-22T03:47:29+00:00", "before": null, "after": null, "flights": {}},
{"action": "add", "effect": "lag", "time": "2026-11-22T03:47:35+00:00",
 "before": {"nominal": {"rms_V": 34.5, "rms_Eo": 84517.5}, "calibrated": {"rms_V": 0.0018, "rms_Eo": 4.39, "inline_Eo": null}},
 "after": {"rms_V": 0.001, "rms_Eo": 2.9}, "flights": {"north": "9af0414b949fdd4e"}, "model": "effects = []"}]}
"""
CHANGE = """{"version": 1, "written_by": "ragg 0.1.0", "folders": {"generated": 7}, "files": ["model.toml", "history.json"],
"removed": ["calibration.json"]}"""
SAVED = """{"version": 1, "written_by": "ragg 0.1.0", "calibrations": [
{"time": "2026-11-22T03:47:29+00:00", "converged": true, "model": {"effects": ["lag"], "form": "paper", "derivation": "00"},
 "values": {"radius": [0.1], "K1": [1.0, 1.0]}, "sheet": {"radius": [0.1], "K1": [1.0, 1.5]},
 "fitted": [{"name": "K1", "accelerometer": 1, "effect": null, "place": 1, "scale": 1e-3, "unit": "mA/g", "unit_factor": 1.0},
  {"name": "K1", "accelerometer": 2, "effect": "lag", "place": 2, "scale": 1e-3, "unit": "mA/g", "unit_factor": 2.0}],
 "square_root_information": [[2.0, 0.5], [3.0]], "validity": {"time": [0.0, 9.5]}, "flights": {"north": "00"},
 "error": {"nominal": {"rms_Eo": 1.0}}}
]}
"""


def make() -> dict[str, dict[str, bytes]]:
    """Target -> name -> seed."""
    csv = _table("flight.csv")
    return {
        "expression": {f"seed-{n}": t.encode() for n, t in enumerate(EXPRESSIONS)},
        "model_toml": {"seed-0": MODEL.encode(), "seed-1": TABLES.encode()},
        "edited_toml": {"seed-0": MODEL.encode(), "seed-1": TABLES.encode()},
        "mapping": {"seed-0": MAPPING.encode(), "seed-1": SECONDS.encode()},
        "history": {"seed-0": STEPS.encode(), "seed-1": b'{"steps": []}'},
        "unfinished": {"seed-0": CHANGE.encode(), "seed-1": b'{"folders": {}, "files": [], "removed": []}'},
        "calibration": {"seed-0": SAVED.encode()},
        "generated_model": {f"seed-{n}": str(n).encode() for n in range(3)},
        "flight_csv": {
            "seed-0": csv,
            "seed-1": csv.replace(b",", b";").replace(b"\n", b"\r\n"),
            "seed-2": gzip.compress(csv, mtime=0),
            "seed-3": b"# remark\n\n" + b"\n".join(csv.split(b"\n")[:4]) + b"\n0.1875,,,,,,,nan\n",
        },
        "flight_parquet": {"seed-0": _table("flight.parquet")},
        "flight_netcdf": {"seed-0": _table("flight.nc")},
    }


def _table(name: str) -> bytes:
    """A short flight as the program itself writes it."""
    from ragg_runtime.flight import Flight, write_flight

    time = np.arange(12) / 16.0
    names = [f"{n}_{k}" for n in ("a", "omega") for k in "xyz"]
    channels = {n: np.round(np.sin(time + i), 3) for i, n in enumerate(names)}
    flight = Flight(time, channels, {"G_out": np.round(np.cos(time), 3)})
    with tempfile.TemporaryDirectory() as folder:
        write_flight(flight, Path(folder) / name)
        return (Path(folder) / name).read_bytes()


def corpus(target: str) -> dict[str, bytes]:
    """Name -> content of what is committed for a target."""
    return {p.name: p.read_bytes() for p in sorted((CORPUS / target).iterdir()) if p.is_file()}


def main() -> None:
    for target, files in make().items():
        (CORPUS / target).mkdir(parents=True, exist_ok=True)
        for name, data in files.items():
            (CORPUS / target / name).write_bytes(data)


if __name__ == "__main__":
    main()
