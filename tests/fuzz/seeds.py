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


def make() -> dict[str, dict[str, bytes]]:
    """Target -> name -> seed."""
    csv = _table("flight.csv")
    return {
        "expression": {f"seed-{n}": t.encode() for n, t in enumerate(EXPRESSIONS)},
        "model_toml": {"seed-0": MODEL.encode(), "seed-1": TABLES.encode()},
        "edited_toml": {"seed-0": MODEL.encode(), "seed-1": TABLES.encode()},
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
