"""`ragg compensate`: the gradient that was flown over comes out, as sure as it is said to be, and nothing else."""

from __future__ import annotations

import dataclasses
import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest
import xarray
from numpy.typing import NDArray
from scipy import signal

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation import compensate
from ragg_runtime.compensation.compensate import Compensated, Kind, Prepared, prepared
from ragg_runtime.compensation.series import Quality, Segment, Series
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.model import model as load
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.signals.demodulators import CUTOFF, DEMODULATORS, ORDER, demodulator
from tests.rate import RATE
from tests.runtime.flown_twice import BRIEF, DURATION, files, flights, new_model, run, truth


def compensated(s: Scenario, x: Flight, kind: Kind = "self", name: str = "fir") -> tuple[Compensated, Series]:
    """A flight's whole series."""
    return series(prepared(load.packaged(), s.sheet, [x], kind), x, name)


def series(p: Prepared, x: Flight, name: str) -> tuple[Compensated, Series]:
    c = Compensated(p, 0, name)
    parts = list(c.segments())
    return c, Series(
        rows=slice(0, len(x.time)),
        gradient=np.concatenate([p.gradient for p in parts]),
        nominal=parts[0].nominal,
        parameters=np.concatenate([p.parameters for p in parts], axis=1),
        std=np.concatenate([p.std for p in parts], axis=1),
        quality=np.concatenate([p.quality for p in parts]),
    )


@cache
def flown(seed: int, kind: Kind) -> tuple[Flight, Prepared]:
    """A flight over a gradient, fitted."""
    s = scenario(seed, duration=DURATION, rate=RATE, gradient_rms=50e-9)
    x = s.simulate({}).flight()
    return x, prepared(load.packaged(), s.sheet, [x], kind)


@pytest.mark.parametrize(("kind", "name"), [("crossed", "butterworth"), ("self", "causal")])
def test_the_truth_lies_within_the_stated_uncertainty_as_often_as_stated(kind: Kind, name: str) -> None:
    scores = []
    for seed in (11, 12, 13):
        x, p = flown(seed, kind)
        c, found = series(p, x, name)
        error = found.gradient - truth(x, c.demodulator)
        z = np.stack([error.real, error.imag]) / found.std
        scores.append(
            z[:, found.good][:, :: int(2 * RATE)]
        )  # a low-pass of 0.2 Hz makes two seconds of one value
        assert np.mean(error[found.good]) == pytest.approx(0.0, abs=0.5)
    z = np.concatenate(scores, axis=1)
    assert 0.62 < np.mean(np.abs(z) < 1.0) < 0.74  # of some 2,600 values, half of them independent
    assert 0.925 < np.mean(np.abs(z) < 1.96) < 0.975


def test_frozen_parameters_compensate_another_flight_as_well(tmp_path: Path) -> None:
    model, (one, two) = new_model(tmp_path), files(tmp_path)
    run("calibrate", model, one, "--save")
    run(
        "compensate",
        model,
        two,
        "-o",
        tmp_path / "o.parquet",
        "--calibration",
        "frozen",
        "--json",
        tmp_path / "o.json",
    )
    found = pq.read_table(tmp_path / "o.parquet").to_pandas()
    assert list(found) == ["time", "inline", "cross", "inline_std", "cross_std", "quality"]
    g = truth(flights()[1], demodulator("fir", RATE))
    g = g[np.searchsorted(flights()[1].time, found["time"])]
    good = np.asarray(found["quality"] & ~int(Quality.MOTION) == 0)
    assert not found["quality"].iloc[[0, -1]].any(), "it begins and ends where there are values"
    for channel, true in (("inline", g.real), ("cross", g.imag)):
        z = ((found[channel] - true) / found[f"{channel}_std"])[good][:: int(2 * RATE)]
        assert 0.6 < np.mean(np.abs(z) < 1.0) < 0.76
    o = json.loads((tmp_path / "o.json").read_text())
    assert o["calibration"] == "frozen"
    assert o["frozen"]["flights"].keys() == {"one"}
    assert o["frozen"]["holds"] is True
    assert not any("does NOT hold" in text for text in o["notes"])
    assert o["converged"] is True
    (told,) = o["flights"]
    assert (
        told["density"]["before"]["inline_Eo_per_rtHz"] > 1e3 * told["density"]["after"]["inline_Eo_per_rtHz"]
    )
    assert told["density"]["after"]["cross_Eo_per_rtHz"] == pytest.approx(2.0, rel=0.3)
    assert told["density"]["noise"]["cross_Eo_per_rtHz"] == pytest.approx(2.0, rel=0.1)
    assert {"everything", "imbalance of K1"} <= {q["of"] for q in told["contributions"]}


@pytest.mark.parametrize("kind", ["self", "frozen"])
def test_nothing_of_recorded_gradients_gets_into_the_series(kind: str, tmp_path: Path) -> None:
    model = new_model(tmp_path)
    one, two = (x.part(BRIEF) for x in flights())
    write_flight(one, tmp_path / "one.parquet")
    run("calibrate", model, tmp_path / "one.parquet", "--save")
    rng = np.random.default_rng(1)
    written = []
    for what in ("kept", "none", "wrong"):
        channels = {n: x for n, x in two.channels.items() if what != "none" or not n.startswith("Gamma")}
        if what == "wrong":
            channels |= {
                n: x + 1e-7 * rng.standard_normal(len(x)) for n, x in channels.items() if "Gamma" in n
            }
        write_flight(dataclasses.replace(two, channels=channels), tmp_path / "two.parquet")
        run("compensate", model, tmp_path / "two.parquet", "-o", tmp_path / "o.csv", "--calibration", kind)
        written.append((tmp_path / "o.csv").read_bytes())
    assert written[0] == written[1] == written[2]
    assert written[0].startswith(
        b"time [s],inline [Eo],cross [Eo],inline_std [Eo],cross_std [Eo],quality [1]\n"
    )


def with_wave(s: Scenario, x: Flight, period: float, size: float) -> tuple[Flight, NDArray[np.complex128]]:
    """The flight over a further gradient, a wave in inline and (half as large) in cross, Eo; and that wave."""
    wave = size * np.exp(2j * np.pi * x.time / period)
    g = wave.real + 0.5j * wave.imag
    phi = 2 * np.pi * s.sheet.spin_frequency * x.time
    k = s.instrument.scale_factor * 1e-9
    G = k * (g.real / 2 * np.sin(2 * phi) - g.imag * np.cos(2 * phi))
    return dataclasses.replace(x, outputs={"G_out": x.outputs["G_out"] + G}), g


@cache
def still() -> tuple[Scenario, Flight, Compensated, Series]:
    """A flight over no gradient, compensated."""
    s = scenario(21, duration=DURATION, rate=RATE)
    x = s.simulate({}).flight()
    return s, x, *compensated(s, x)


@pytest.mark.parametrize("period", [8.0, 900.0])
def test_a_gradient_of_the_surveys_wavelengths_is_not_eaten(period: float) -> None:
    s, x, c, without = still()
    more, g = with_wave(s, x, period, 30.0)
    _, found = compensated(s, more)
    passed = c.demodulator.low_passed(g)
    ok = found.good & without.good
    difference = (found.gradient - without.gradient)[ok]
    for part in (np.real, np.imag):
        gain = float(part(difference) @ part(passed[ok]) / (part(passed[ok]) @ part(passed[ok])))
        assert gain == pytest.approx(
            1.0, abs=0.01
        )  # the instrument's own scale factor is 0.1 % from the sheet's


def test_the_division_into_segments_leaves_no_trace(monkeypatch: pytest.MonkeyPatch) -> None:
    s = scenario(11, duration=DURATION, rate=RATE, gradient_rms=50e-9)
    x = s.simulate({}).flight()
    _, whole = compensated(s, x)
    monkeypatch.setattr(compensate, "ROWS", 500)
    c, parts = compensated(s, x)
    assert c._rows() < len(x.time) / 3
    assert np.array_equal(whole.quality, parts.quality)
    assert np.nanmax(np.abs(whole.gradient - parts.gradient)) < 1e-6
    assert np.nanmax(np.abs(whole.std / parts.std - 1)) < 0.02  # the directions are sought on other stretches


def test_holes_are_bridged_or_told() -> None:
    s = scenario(11, duration=DURATION, rate=16.0, gradient_rms=50e-9)  # three samples are brief
    x = s.simulate({}).flight()
    valid = np.ones(len(x.time), dtype=bool)
    valid[5000] = valid[6000:6003] = False  # short ones
    valid[9000:9080] = False  # five seconds
    G = np.where(valid, x.outputs["G_out"], np.nan)
    c, found = compensated(s, dataclasses.replace(x, outputs={"G_out": G}, valid=valid))
    error = found.gradient - truth(x, c.demodulator)
    assert found.quality[5000] == found.quality[6001] == Quality.BRIDGED
    assert abs(error[5000].real) < 4 * found.std[0, 5000]
    assert abs(error[6001].real) < 4 * found.std[0, 6001]
    assert found.quality[9040] & Quality.GAP
    assert not np.isfinite(found.gradient[9040].real)
    assert found.quality[7500] == 0
    head = c.demodulator.settling[0]
    assert np.all(found.quality[:head] & Quality.EDGE)
    assert found.quality[head + 1] == 0
    ok = found.good
    assert np.std(error[ok].real) < 1.1 * np.mean(found.std[0, ok])


def test_the_instruments_own_response_to_the_gradient_is_undone() -> None:
    """Mounted 200 arcsec off in phase, an instrument mixes inline and cross; what it is known to do is put right."""
    s = scenario(31, duration=DURATION, rate=RATE, noise_density=0.0, perturbation=0.0, gradient_rms=1e-6)
    turned = {"beta_z": s.sheet.accelerometers["beta_z"] + 200 * np.pi / 648000}
    sheet = s.sheet.replace(**turned)
    s = dataclasses.replace(s, sheet=sheet, instrument=sheet)
    x = s.simulate({}).flight()
    p = prepared(load.packaged(), sheet, [x], "self")
    c = Compensated(p, 0, "fir")
    found = np.concatenate([part.gradient for part in c.segments()])
    error = found - truth(x, c.demodulator)
    ideal = np.concatenate([_ideal(c, x)])
    ok = np.isfinite(found.real)
    assert np.std(error[ok].imag) < 0.1 * np.std((ideal - truth(x, c.demodulator))[ok].imag)


def _ideal(c: Compensated, x: Flight) -> NDArray[np.complex128]:
    return Segment(c.setting, slice(0, len(x.time)), holes=False).first_estimate()


def test_kernels_are_the_filters_that_they_stand_for() -> None:
    rate = 16.0
    rng = np.random.default_rng(3)
    x = rng.standard_normal(12000)
    sections = signal.butter(ORDER, CUTOFF, fs=rate, output="sos")
    inner = slice(2500, -2500)
    both = demodulator("butterworth", rate)
    expected = signal.sosfilt(sections, signal.sosfilt(sections, x)[::-1])[::-1]
    assert np.max(np.abs(both.low_passed(x + 0j).real - expected)[inner]) < 1e-8
    causal = demodulator("causal", rate)
    assert np.max(np.abs(causal.low_passed(x + 0j).real - signal.sosfilt(sections, x))) < 1e-8
    assert causal.ahead == 0
    b, a = signal.butter(ORDER, 2 * np.pi * CUTOFF, analog=True)
    w = 2 * np.pi * np.array([1e-4, 2e-4])
    phase = np.angle(signal.freqs(b, a, w)[1])
    assert causal.latency == pytest.approx(-np.diff(phase)[0] / np.diff(w)[0], rel=1e-3)
    for name in DEMODULATORS:
        d = demodulator(name, rate)
        assert np.sum(d.taps) == pytest.approx(1.0, abs=1e-12)
        f = np.array([0.0, 0.05, 0.25, 0.5])
        gain = np.abs(d.response(f))
        assert gain[0] == pytest.approx(1.0)
        assert gain[1] > 0.99
        assert gain[3] < 0.003


def test_motion_beyond_what_the_calibration_knows_is_flagged(tmp_path: Path) -> None:
    model, (one, two) = new_model(tmp_path), files(tmp_path, rows=BRIEF)
    run("calibrate", model, one, "--save")
    m = api.load(model)
    x = api.read_for_compensation(m, [two])[0]
    strong = dict(x.channels)
    strong["temperature"] = strong["temperature"] + 50.0
    c = api.compensate(m, [dataclasses.replace(x, channels=strong)], "frozen")
    assert np.all(c.series[0]["quality"] & int(Quality.AUXILIARY))
    assert set(c.as_json()["quality"]) == {str(int(q)) for q in Quality}
    assert "compensation" in repr(c)
    assert "<table" in c._repr_html_()


def test_formats_and_several_flights(tmp_path: Path) -> None:
    model, places = new_model(tmp_path), files(tmp_path, rows=BRIEF)
    run("compensate", model, *places, "-o", tmp_path / "o.nc", "--demodulator", "butterworth")
    with xarray.open_dataset(tmp_path / "o.nc", engine="h5netcdf", decode_times=False) as found:
        assert found["inline"].attrs["units"] == "Eo"
        assert set(np.unique(found["flight"])) == {1, 2}
        inline = found["inline"].values
    m = api.load(model)
    c = api.compensate(m, api.read_for_compensation(m, places), demodulator="butterworth")
    valued = [np.isfinite(s["inline_std"]) for s in c.series]
    assert len(inline) == sum(map(np.sum, valued)) < 2 * BRIEF.stop
    kept, std = (
        np.concatenate([s[n][v] for s, v in zip(c.series, valued, strict=True)])
        for n in ("inline", "inline_std")
    )
    assert np.max(np.abs(kept - inline)) <= 0.05 * np.min(std), "and one digit more than is known"
    c.write(str(tmp_path / "again.csv"))
    assert all(len(x) < 8 for x in (tmp_path / "again.csv").read_text().splitlines()[5].split(",")[1:])
    before = c.as_json()["flights"][0]["density"]["before"]
    nominal = api.compare(m, api.read_flights(m, places[:1])).nominal.as_json()
    assert before == pytest.approx({k: nominal[k] for k in before}, rel=1e-3)
    field = pq.ParquetFile(_parquet(model, places[0], tmp_path)).schema_arrow.field("inline")
    assert field.metadata[b"units"] == b"Eo"


def _parquet(model: Path, flight: Path, folder: Path) -> Path:
    run("compensate", model, flight, "-o", folder / "o.parquet")
    return folder / "o.parquet"


BAD: dict[str, list[Any]] = {
    "is too short for the demodulator": ["short.parquet", "-o", "o.csv", "--demodulator", "fir"],
    "no flight format has this file name ending": ["one.parquet", "-o", "o.xyz"],
    "no saved calibration": ["one.parquet", "-o", "o.csv", "--calibration", "frozen"],
}


@pytest.mark.parametrize("message", sorted(BAD))
def test_bad_input_is_one_message_and_leaves_no_file(message: str, tmp_path: Path, capfd: Any) -> None:
    model = new_model(tmp_path)
    one = flights()[0]
    write_flight(one, tmp_path / "one.parquet")
    write_flight(one.part(slice(0, 300)), tmp_path / "short.parquet")
    first, *rest = BAD[message]
    rest[1] = tmp_path / rest[1]
    from ragg_runtime.cli.main import main

    with pytest.raises(SystemExit) as end:
        main(["compensate", str(model), str(tmp_path / first), *map(str, rest)])
    assert end.value.code == 2
    assert message in capfd.readouterr().err
    assert not rest[1].exists()


def test_no_such_kind_or_demodulator() -> None:
    with pytest.raises(UserError, match="no such demodulator"):
        demodulator("box", RATE)
    s = scenario(11, duration=60.0)
    with pytest.raises(UserError, match="no such calibration"):
        prepared(load.packaged(), s.sheet, [], "none")  # type: ignore[arg-type]
