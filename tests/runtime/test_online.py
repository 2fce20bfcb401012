"""The recursive form: the batch fit sample by sample, in Python and in C, following what drifts."""

from __future__ import annotations

import dataclasses
import json
import subprocess
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.base.threads import split_range
from ragg_runtime.compensation.export.program import format_csv
from ragg_runtime.compensation.recursive import UNKNOWN_EO, UPDATE, Online, Tuning
from ragg_runtime.estimation.observation import Observation, observe
from ragg_runtime.io import write_flight
from ragg_runtime.io.record import SI_UNITS
from ragg_runtime.model import model as load
from ragg_runtime.reference.scenario import Scenario, scenario
from tests.rate import RATE
from tests.runtime.flown_twice import files, flights, new_model, run
from tests.runtime.test_export import make_strictly

Array = NDArray[np.float64]

DENSITY = 2.0


@cache
def flown(duration: float = 450.0, gradient: float = 0.0) -> tuple[Scenario, Observation]:
    s = scenario(5, duration=duration, rate=RATE, gradient_rms=gradient * 1e-9)
    return s, observe(s.simulate({}).flight(), s.sheet)


def noise(s: Scenario) -> float:
    """Of a sample of G_out, V: white, of the density of the scenario in the cross channel (see eotvos_noise)."""
    return DENSITY / np.sqrt(2) * s.sheet.scale_factor * 1e-9 * np.sqrt(RATE / 2)


def test_with_nothing_forgotten_it_is_the_batch_fit_to_rounding() -> None:
    s, o = flown()
    f = Online(load.packaged(), s.sheet, Tuning(noise=noise(s)))
    rows = f._rows(o)
    n = len(f.columns)
    prior = np.zeros((n + 2, n + 3))
    prior[:n, :n] = np.eye(n)
    prior[n:, n : n + 2] = np.eye(2) / UNKNOWN_EO
    batch = np.linalg.qr(np.vstack([prior, rows]), mode="r")
    x = np.linalg.solve(batch[:-1, :-1], batch[:-1, -1])
    for rows in split_range(len(o.record.time), 388):  # in parts of any length
        f.feed(o.part(rows))
    found = np.linalg.solve(f.R[:, :-1], f.R[:, -1])
    # in standard deviations: eps times a dynamic of 1e11
    assert np.linalg.norm(batch[:-1, :-1] @ (found - x)) < 1e-3
    p, root = f.parameters()
    assert np.max(np.abs(p[f.index] - f.p[f.index] - found[:n] * f.scale) / f.scale) < 1e-9
    # the information of the parameters is what is left whatever the gradient may be
    std, whole = (np.linalg.norm(np.linalg.inv(R), axis=1) for R in (root, batch[:-1, :-1]))
    assert std == pytest.approx(whole[:n], rel=1e-4)


def test_a_drift_is_followed_with_the_stated_lag() -> None:
    """A scale factor that grows steadily: what the filter believes lags by the time constant of its memory."""
    s, o = flown(700.0)
    forget, rate = 100.0, 1e-8  # s; of A1's own, a second
    model = load.packaged()
    filters = [Online(model, s.sheet, Tuning(noise=noise(s), walk=0.3, forget=forget)) for _ in range(2)]
    rows = filters[0]._rows(o)
    k = next(n for n, q in enumerate(filters[0].columns) if q.label == "K1[1]")
    step = rate * s.sheet.accelerometers["K1"][0] / filters[0].columns[k].scale  # scales a second
    drift = o.record.time * step * rows[:, k] * noise(s)
    filters[0].feed(o)
    filters[1].feed(dataclasses.replace(o, series=(o.series[0] + drift,)))
    a, b = (np.linalg.solve(f.R[:, :-1], f.R[:, -1]) for f in filters)
    believed = rows[-800:, :-1] @ (b - a)
    true = rows[-800:, k]
    size = float(believed @ true / (true @ true))  # scales of K1[1]
    lag = o.record.time[-1] - size / step
    assert lag == pytest.approx(forget, rel=0.25)


def test_gaps_and_missing_samples_are_passed_over() -> None:
    s, o = flown()
    r = o.record
    G = o.series[0].copy()
    G[50:55] = np.nan
    valid = r.valid.copy()
    valid[50:55] = valid[1000:2000] = False
    holed = dataclasses.replace(o, record=dataclasses.replace(r, valid=valid), series=(G,))
    f = Online(load.packaged(), s.sheet, Tuning(noise=noise(s), walk=0.5))
    got = f.feed(holed)
    assert np.isfinite(got.inline).all()
    inside, ahead = (np.searchsorted(got.time, r.time[i]) for i in (1999, 999))
    assert got.inline_std[inside] > 3 * got.inline_std[ahead]  # it wanders meanwhile
    whole = Online(load.packaged(), s.sheet, Tuning(noise=noise(s), walk=0.5)).feed(o)
    last = np.abs(got.inline[-1] - whole.inline[-1]) / whole.inline_std[-1]
    assert last < 3


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, Path]:
    folder = tmp_path_factory.mktemp("online")
    model, (one, two) = new_model(folder), files(folder)
    run("calibrate", model, one, "--save")
    run("export", model, folder / "c", "--c")
    make_strictly(folder / "c", "ragg_online")
    return model, folder / "c", two


def samples(o: Observation, G: Array) -> str:
    """A record as CSV in SI units."""
    r = o.record
    columns = {"time": r.time, **{n: x for n, x in r.channels.items() if n in SI_UNITS}, "G_out": G}
    return format_csv({f"{n} [{SI_UNITS[n]}]": x for n, x in columns.items()})


@pytest.mark.parametrize(("walk", "gap"), [(0.0, 0.0), (1.0, 1e6)])
def test_the_c_is_the_same_filter(walk: float, gap: float, exported: tuple[Path, Path, Path]) -> None:
    """Also beyond a gap so long that nothing of what the flight said is left."""
    model, folder, two = exported
    m = api.load(model)
    x = api.read_for_compensation(m, [two])[0].part(slice(0, 900))
    o = observe(x, m.instrument)
    valid = o.record.valid.copy()
    valid[250:350] = False
    time = o.record.time + np.where(np.arange(900) < 500, 0.0, gap)
    o = dataclasses.replace(o, record=dataclasses.replace(o.record, valid=valid, time=time))
    c = api.contents(m)
    sigma, forget = 4 * c.outputs()[0].scale_factor, 60.0
    done = subprocess.run(
        [folder / "ragg_online", f"{sigma:.17g}", str(walk), str(forget)],
        input=samples(o, np.where(valid, o.series[0], np.nan)), capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    found = np.array([[float(y) for y in line.split(",")] for line in lines[1:] if line[0] != "#"])
    assert c.saved is not None
    f = Online(m.model, m.instrument, Tuning(noise=sigma, walk=walk, forget=forget), c.p, c.saved.information)
    got = f.feed(o)
    assert np.array_equal(found[:, 0], got.time)
    assert np.max(np.abs(found[:, 1] - got.inline) / got.inline_std) < 1e-4
    assert np.max(np.abs(found[:, 2] - got.cross) / got.cross_std) < 1e-4
    assert found[:, 3] == pytest.approx(got.inline_std, rel=1e-6)
    p = np.array([float(line[2:]) for line in lines if line[0] == "#"])
    assert np.max(np.abs(p - f.parameters()[0])[f.index] / f.scale) < 1e-4


def test_the_command_follows_a_flight_within_its_uncertainty(
    exported: tuple[Path, Path, Path], tmp_path: Path
) -> None:
    model, _, _ = exported
    flight = flights()[1].part(slice(0, 3200))
    write_flight(flight, tmp_path / "two.parquet")
    out = ("-o", tmp_path / "o.csv", "--json", tmp_path / "o.json")
    told = run("compensate", model, tmp_path / "two.parquet", "--calibration", "online", *out)
    assert "time constant 0.796 s" in told
    rows = np.genfromtxt(tmp_path / "o.csv", delimiter=",", names=True)
    assert len(rows) == 3200 / RATE / UPDATE - 1
    c = flight.channels
    true = {"inline": c["Gamma_xx"] - c["Gamma_yy"], "cross": c["Gamma_xy"]}
    for name, x in true.items():
        error = rows[f"{name}_Eo"] - np.interp(rows["time_s"], flight.time, x / 1e-9)
        z = (error / rows[f"{name}_std_Eo"])[rows["time_s"] > 10]
        assert 0.6 < np.mean(np.abs(z) < 1) < 0.9
        assert np.mean(np.abs(z) < 1.96) > 0.9
    d = json.loads((tmp_path / "o.json").read_text())
    assert d["calibration"] == "online"
    assert set(rows["quality_1"]) == {0}
    assert d["started"].startswith("calibration made")
    assert 1.0 < d["noise_Eo_per_rtHz"] < 3.0
    k1 = [q for q in d["flights"][0]["parameters"] if q["name"] == "K1"]
    assert [q["accelerometer"] for q in k1] == [1, 2, 3, 4]
    fresh = new_model(tmp_path)
    with pytest.raises(UserError, match="the noise is not known"):
        api.compensate(api.load(fresh), [flight], "online")
    G = np.array(flight.outputs["G_out"][:400])
    G[200:240] = np.nan
    gap = dataclasses.replace(flight.part(slice(0, 400)), outputs={"G_out": G})
    w = api.compensate(api.load(fresh), [gap], "online", noise=2.0, forget=100.0)
    assert (w.as_json()["started"], w.as_json()["forget_s"]) == ("sheet", 100.0)
    assert list(w.units) == ["time", "inline", "cross", "inline_std", "cross_std", "quality"]
    bridged = w.series[0]["time"][w.series[0]["quality"] > 0]
    assert flight.time[199] < bridged.min() < bridged.max() < flight.time[240] + UPDATE
