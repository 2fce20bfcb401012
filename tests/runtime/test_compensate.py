"""`ragg compensate`, `calibrate --save`: the gradient flown over comes out, as sure as it is said; frozen and drifting parameters."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
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
from ragg_runtime.cli.main import main
from ragg_runtime.compensation import calibrate as calibration
from ragg_runtime.compensation import compensate as output_channel
from ragg_runtime.compensation import drift
from ragg_runtime.compensation.calibrate import calibrate, make_saved
from ragg_runtime.compensation.compensate import (
    Compensated,
    Kind,
    OutputChannel,
    Quality,
    leave_out_gradients,
    prepare,
)
from ragg_runtime.estimation import unknown_gradient
from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.io import Flight, write_flight
from ragg_runtime.model.model import load_packaged
from ragg_runtime.reference.scenario import Scenario, scenario
from ragg_runtime.signals.demodulators import CORNER, DEMODULATORS, ORDER, find_demodulator
from tests.runtime.flown_twice import BRIEF, DURATION, files, flights, new_model, run, truth
from tests.simulated import RATE


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, Path, dict[str, Any]]:
    folder = tmp_path_factory.mktemp("kept")
    model, (one, two) = new_model(folder), files(folder)
    run("calibrate", model, one, "--save", "--json", folder / "c.json")
    return model, one, two, json.loads((folder / "c.json").read_text())


def compensated(
    s: Scenario, x: Flight, kind: Kind = "self", name: str = "fir"
) -> tuple[OutputChannel, Compensated]:
    ((c,),) = prepare(load_packaged(), s.sheet, [x], kind, name).channels
    return c, c.compensate()


@cache
def flown(seed: int, kind: Kind, name: str) -> tuple[Scenario, Flight, OutputChannel]:
    """A flight over a gradient, fitted."""
    s = scenario(seed, duration=DURATION, rate=RATE, gradient_rms=50e-9)
    x = s.simulate({}).flight()
    ((c,),) = prepare(load_packaged(), s.sheet, [x], kind, name).channels
    return s, x, c


@pytest.mark.parametrize(("kind", "name"), [("crossed", "butterworth"), ("self", "causal")])
def test_the_truth_lies_within_the_stated_uncertainty_as_often_as_stated(kind: Kind, name: str) -> None:
    scores = []
    for seed in (11, 12):
        _, x, c = flown(seed, kind, name)
        result = c.compensate()
        error = result.gradient - truth(x, c.demodulator)
        good = np.isfinite(error)
        z = np.stack([error.real, error.imag]) / result.std
        scores.append(z[:, good][:, :: int(2 * RATE)])  # a low-pass of 0.2 Hz makes two seconds of one value
        assert np.mean(error[good]) == pytest.approx(0.0, abs=0.5)
    z = np.concatenate(scores, axis=1)
    assert 0.62 < np.mean(np.abs(z) < 1.0) < 0.74  # of some 1,700 values, half of them independent
    assert 0.925 < np.mean(np.abs(z) < 1.96) < 0.975


def test_frozen_parameters_compensate_another_flight_as_well(kept: tuple[Any, ...], tmp_path: Path) -> None:
    model, _, two, _ = kept
    out, report = tmp_path / "o.parquet", tmp_path / "o.json"
    stdout = run("compensate", model, two, "-o", out, "--calibration", "frozen", "--json", report)
    assert "too near an end of the record for the low-pass: no value." in stdout
    table = pq.read_table(out)
    assert table.schema.field("inline").metadata[b"units"] == b"Eo"
    frame = table.to_pandas()
    assert list(frame) == ["time", "inline", "cross", "inline_std", "cross_std", "quality"]
    g = truth(flights()[1], find_demodulator("fir", RATE))
    g = g[np.searchsorted(flights()[1].time, frame["time"])]
    good = np.asarray(frame["quality"] & ~int(Quality.MOTION) == 0)
    assert not frame["quality"].iloc[[0, -1]].any(), "it begins and ends where there are values"
    for channel, true in (("inline", g.real), ("cross", g.imag)):
        z = ((frame[channel] - true) / frame[f"{channel}_std"])[good][:: int(2 * RATE)]
        assert 0.6 < np.mean(np.abs(z) < 1.0) < 0.76
    o = json.loads(report.read_text())
    assert (o["calibration"], o["converged"], o["frozen"]["holds"]) == ("frozen", True, True)
    assert o["frozen"]["flights"].keys() == {"one"}
    (flight,) = o["flights"]
    density = flight["density"]
    assert density["before"]["inline_Eo_per_rtHz"] > 1e3 * density["after"]["inline_Eo_per_rtHz"]
    unknown = tmp_path / "unknown.parquet"
    write_flight(leave_out_gradients(flights()[1]), unknown)
    nominal = api.compare(api.load(model), unknown).as_json()["error"]["nominal"]
    assert density["before"]["inline_Eo_per_rtHz"] == pytest.approx(nominal["inline_Eo_per_rtHz"], rel=1e-3)
    assert density["after"]["cross_Eo_per_rtHz"] == pytest.approx(2.0, rel=0.3)
    assert density["noise"]["cross_Eo_per_rtHz"] == pytest.approx(2.0, rel=0.1)
    assert {"everything", "imbalance of K1"} <= {q["of"] for q in flight["contributions"]}


def test_nothing_of_recorded_gradients_gets_into_the_series(tmp_path: Path) -> None:
    model, two = new_model(tmp_path), flights()[1].part(BRIEF)
    rng = np.random.default_rng(1)
    none = {n: x for n, x in two.channels.items() if not n.startswith("Gamma")}
    wrong = {n: x + 1e-7 * rng.standard_normal(len(x)) for n, x in two.channels.items() if n not in none}
    written = []
    for channels in (two.channels, none, none | wrong):
        write_flight(dataclasses.replace(two, channels=channels), tmp_path / "two.parquet")
        run("compensate", model, tmp_path / "two.parquet", "-o", tmp_path / "o.csv")
        written.append((tmp_path / "o.csv").read_bytes())
    assert written[0] == written[1] == written[2]
    header = b"time [s],inline [Eo],cross [Eo],inline_std [Eo],cross_std [Eo],quality [1]\n"
    assert written[0].startswith(header)


def test_gradients_of_the_surveys_wavelengths_are_not_eaten() -> None:
    """A short and a long wave in inline and, half as large, in cross, laid over the flight."""
    s, x, c = flown(11, "self", "causal")
    waves = [30.0 * np.exp(2j * np.pi * x.time / period) for period in (8.0, 900.0)]
    each = [w.real + 0.5j * w.imag for w in waves]
    g = each[0] + each[1]
    phi = 2 * np.pi * s.sheet.spin_frequency * x.time
    volts = s.instrument.scale_factor * 1e-9 * (g.real / 2 * np.sin(2 * phi) - g.imag * np.cos(2 * phi))
    more = dataclasses.replace(x, outputs={"G_out": x.outputs["G_out"] + volts})
    difference = compensated(s, more, "self", "causal")[1].gradient - c.compensate().gradient
    passed = [c.demodulator.low_pass(w) for w in each]
    ok = np.isfinite(difference)
    for part in (np.real, np.imag):
        gains = np.linalg.lstsq(
            np.stack([part(y[ok]) for y in passed], axis=1), part(difference[ok]), rcond=None
        )[0]
        # the instrument's own scale factor is 0.1 % from the sheet's
        assert gains == pytest.approx([1.0, 1.0], abs=0.01)


def test_the_division_into_segments_leaves_no_trace(monkeypatch: pytest.MonkeyPatch) -> None:
    c = flown(11, "self", "causal")[-1]
    whole = c.compensate()
    for module in (output_channel, unknown_gradient):
        monkeypatch.setattr(module, "ROWS", 500)
    parts = dataclasses.replace(c).compensate()
    assert np.array_equal(whole.quality, parts.quality)
    assert np.nanmax(np.abs(whole.gradient - parts.gradient)) < 1e-6
    assert np.nanmax(np.abs(whole.std / parts.std - 1)) < 0.02


def test_holes_are_bridged_or_flagged() -> None:
    s = scenario(11, duration=600.0, rate=16.0, gradient_rms=50e-9)  # three samples are brief
    x = s.simulate({}).flight()
    valid = np.ones(len(x.time), dtype=bool)
    valid[5000] = valid[6000:6003] = False  # short ones
    valid[9000:9080] = False  # five seconds
    G = np.where(valid, x.outputs["G_out"], np.nan)
    c, found = compensated(s, dataclasses.replace(x, outputs={"G_out": G}, valid=valid))
    error = found.gradient - truth(x, c.demodulator)
    for k in (5000, 6001):
        assert found.quality[k] == Quality.BRIDGED
        assert abs(error[k].real) < 4 * found.std[0, k]
    assert found.quality[9040] & Quality.GAP
    assert not np.isfinite(found.gradient[9040].real)
    head = c.demodulator.settling[0]
    assert np.all(found.quality[:head] & Quality.EDGE)
    assert found.quality[head + 1] == found.quality[7500] == 0
    ok = np.isfinite(error)
    assert np.std(error[ok].real) < 1.1 * np.mean(found.std[0, ok])


def test_the_instruments_own_response_to_the_gradient_is_undone() -> None:
    """Mounted 200 arcsec off in phase, an instrument mixes inline and cross; what it is known to do is put right."""
    s = scenario(31, duration=200.0, rate=RATE, noise_density=0.0, perturbation=0.0, gradient_rms=1e-6)
    sheet = s.sheet.replace(beta_z=s.sheet.accelerometers["beta_z"] + 200 * np.pi / 648000)
    s = dataclasses.replace(s, sheet=sheet, instrument=sheet)
    x = s.simulate({}).flight()
    c, found = compensated(s, x)
    true, ideal = truth(x, c.demodulator), c.estimate_first(c.predict())
    ok = np.isfinite(found.gradient)
    assert np.std((found.gradient - true)[ok].imag) < 0.1 * np.std((ideal - true)[ok].imag)


def test_kernels_are_the_filters_that_they_stand_for() -> None:
    rate = 16.0
    x: NDArray[np.float64] = np.random.default_rng(3).standard_normal(12000)
    sections = signal.butter(ORDER, CORNER, fs=rate, output="sos")
    inner = slice(2500, -2500)
    expected = signal.sosfilt(sections, signal.sosfilt(sections, x)[::-1])[::-1]
    both, causal = find_demodulator("butterworth", rate), find_demodulator("causal", rate)
    assert np.max(np.abs(both.low_pass(x + 0j).real - expected)[inner]) < 1e-8
    assert np.max(np.abs(causal.low_pass(x + 0j).real - signal.sosfilt(sections, x))) < 1e-8
    assert causal.ahead == 0
    b, a = signal.butter(ORDER, 2 * np.pi * CORNER, analog=True)
    w = 2 * np.pi * np.array([1e-4, 2e-4])
    phase = np.angle(signal.freqs(b, a, w)[1])
    assert causal.latency == pytest.approx(-np.diff(phase)[0] / np.diff(w)[0], rel=1e-3)
    for name in DEMODULATORS:
        gain = np.abs(find_demodulator(name, rate).response(np.array([0.0, 0.05, 0.5])))
        assert gain[0] == pytest.approx(1.0)
        assert gain[1] > 0.99
        assert gain[2] < 0.003


def test_motion_beyond_what_the_calibration_knows_is_flagged(kept: tuple[Any, ...]) -> None:
    m = api.load(kept[0])
    x = flights()[1].part(BRIEF)
    warm = dict(x.channels) | {"temperature": x.channels["temperature"] + 50.0}
    c = api.compensate(m, [dataclasses.replace(x, channels=warm)], "frozen")
    assert np.all(c.series[0]["quality"] & int(Quality.AUXILIARY))
    assert set(c.as_json()["quality"]) == {str(int(q)) for q in Quality}
    assert "compensation" in repr(c)
    assert "<table" in str(c._repr_html_())


def test_formats_and_several_flights(tmp_path: Path) -> None:
    model, places = new_model(tmp_path), files(tmp_path, rows=BRIEF)
    m = api.load(model)
    c = api.compensate(m, places, demodulator="butterworth", output=tmp_path / "o.nc")
    with xarray.open_dataset(tmp_path / "o.nc", engine="h5netcdf", decode_times=False) as found:
        assert found["inline"].attrs["units"] == "Eo"
        assert set(np.unique(found["flight"])) == {1, 2}
        inline = found["inline"].values
    valued = [np.isfinite(s["inline_std"]) for s in c.series]
    kept, std = (
        np.concatenate([s[n][v] for s, v in zip(c.series, valued, strict=True)])
        for n in ("inline", "inline_std")
    )
    assert len(inline) == len(kept) < 2 * BRIEF.stop
    assert np.max(np.abs(kept - inline)) <= 0.05 * np.min(std), "and one digit more than is known"


BAD: dict[str, list[str]] = {
    "is too short for the demodulator": ["o.csv"],
    "unknown file ending": ["o.docx"],
    "no saved calibration": ["o.csv", "--calibration", "frozen"],
}


@pytest.mark.parametrize("message", sorted(BAD))
def test_bad_input_is_one_message_and_leaves_no_file(message: str, tmp_path: Path, capfd: Any) -> None:
    model, (out, *rest) = new_model(tmp_path), BAD[message]
    write_flight(flights()[0].part(slice(0, 300)), tmp_path / "short.parquet")
    with pytest.raises(SystemExit) as end:
        main(["compensate", str(model), str(tmp_path / "short.parquet"), "-o", str(tmp_path / out), *rest])
    assert end.value.code == 2
    assert message in capfd.readouterr().err
    assert not (tmp_path / out).exists()


def test_no_such_kind_or_demodulator() -> None:
    with pytest.raises(UserError, match="no such demodulator"):
        find_demodulator("box", RATE)
    with pytest.raises(UserError, match="no such calibration"):
        prepare(load_packaged(), scenario(11, duration=60.0).sheet, [], "none")  # type: ignore[arg-type]


def test_parameters_with_their_sheet_and_what_the_record_sees(kept: tuple[Any, ...]) -> None:
    c = kept[3]
    assert c["converged"] is True
    assert c["error"]["calibrated"]["rms_Eo"] < 1e-3 * c["error"]["nominal"]["rms_Eo"]
    keys = {"name", "accelerometer", "value", "std", "unit", "sheet", "sheet_sigma"}
    assert all(keys <= set(q) and 0 < q["std"] <= 1.001 * q["sheet_sigma"] for q in c["parameters"])
    assert 0 < c["directions"]["seen"] < c["directions"]["fitted"] == len(c["parameters"])
    s = scenario(7, duration=DURATION, rate=RATE)
    patterns = {"Sigma": (1, 1, 1, 1), "D1234": (1, 1, -1, -1)}
    for q in c["combinations"]:
        pattern, name = q["name"].split()[0], q["name"].split()[-1]
        if pattern in patterns and name in ("K6", "K7") and q["unit"] == "ug/g^2":
            g = s.sheet.accelerometers["k_VI"] * s.sheet.accelerometers["K1"]
            each = s.instrument.accelerometers[name] * g / np.mean(g)
            true = float(np.sum(np.array(patterns[pattern]) * each))
            assert abs(q["value"] - true * 9.8 / 1e-6) < 5 * q["std"]


def test_what_is_kept_is_what_was_found_to_the_last_bit_with_its_history(kept: tuple[Any, ...]) -> None:
    model, _, _, c = kept
    m = api.load(model)
    saved = api.saved_calibration(m)
    values = {(q["name"], q["accelerometer"]): q["value"] for q in c["parameters"]}
    for column, place in zip(saved.columns, saved.index, strict=True):
        value = saved.p[place] / column.unit_factor
        assert value == pytest.approx(values[column.name, column.accelerometer], rel=1e-12)
    directory = dataclasses.replace(m.directory, calibration=saved.as_text())
    again = api.saved_calibration(dataclasses.replace(m, directory=directory))
    assert np.array_equal(again.information, saved.information)
    assert np.array_equal(again.p, saved.p)
    assert saved.validity["a_z"][0] < saved.validity["a_z"][1]
    assert list(saved.flights) == ["one"]
    assert [s.action for s in m.directory.history] == ["new", "calibrate"]


@pytest.mark.usefixtures("no_figures")
def test_on_another_flight_of_the_same_instrument_it_holds(kept: tuple[Any, ...], tmp_path: Path) -> None:
    model, _, two, _ = kept
    result, report = tmp_path / "f.json", tmp_path / "f.html"
    assert "holds here" in run("compare", model, two, "--frozen", "--json", result, "--report", report)
    f = json.loads(result.read_text())
    assert f["frozen"]["holds"] is True
    assert 0.01 < f["frozen"]["p_value"] <= 1
    assert f["error"]["calibrated"] == f["error"]["holdout"]
    assert f["error"]["calibrated"]["rms_Eo"] < 1.02 * f["frozen"]["free"]["calibrated"]["rms_Eo"]
    page = report.read_text()
    assert "holds here: its error is" in page
    assert ">frozen<" in page and ">held out<" not in page  # nothing is fitted on half of the blocks


def test_an_instrument_that_has_changed_is_told_with_what_would_explain_it(kept: tuple[Any, ...]) -> None:
    m = api.load(kept[0])
    h = api.compare_frozen(m, [flights(2e-8)[1]])
    assert not h.change.holds
    suspects = {s["name"]: s for s in h.as_json()["frozen"]["suspects"]}
    assert max(s["share"] for s in suspects.values()) > 0.9
    if "K1[1]" in suspects:
        expected = 2e-8 * float(m.instrument.accelerometers["K1"][0]) / (1e-3 / 9.8)  # in mA/g
        assert suspects["K1[1]"]["change"] == pytest.approx(expected, rel=0.1)
    assert h.comparison.calibrated.rms_Eo > 1.5 * h.free.rms_Eo


def test_what_is_compensated_by_a_calibration_that_does_not_hold_says_so(kept: tuple[Any, ...]) -> None:
    result = api.compensate(api.load(kept[0]), [flights(1e-6)[1]], "frozen")
    c = result.as_json()
    assert np.all(result.series[0]["quality"] & int(Quality.CALIBRATION)), "no sample is good"
    assert c["frozen"]["holds"] is False
    assert c["frozen"]["chi2"] > 100
    assert "does NOT hold" in c["notes"][0]


@pytest.mark.parametrize(("changed", "holds"), [(0.0, True), (1e-6, False)])
def test_of_a_long_flight_some_blocks_say_whether_it_holds(changed, holds, kept, monkeypatch) -> None:
    """Without an encoder the disc's angle counts from the flight's beginning, not from a block's."""
    monkeypatch.setattr(calibration, "TESTED", 500)
    c = api.compensate(api.load(kept[0]), [flights(changed)[1]], "frozen").as_json()
    assert c["frozen"]["holds"] is holds
    assert ("notes" in c) is not holds


def test_chi_square_is_one_a_direction_if_nothing_changed() -> None:
    """Over several pairs of flights of unchanged instruments the statistic has its mean."""
    total, directions, model = 0.0, 0, load_packaged()
    for seed in (1, 2):
        s = scenario(seed, duration=200.0, rate=RATE)
        saved = make_saved(calibrate(model, s.sheet, [s.simulate({}).flight()]), [], "now")
        t = scenario(seed + 50, duration=200.0, rate=RATE)
        x = dataclasses.replace(s, motion=t.motion, seed=t.seed).simulate({}).flight()
        h = calibration.compare_frozen(model, s.sheet, [x], saved)
        total, directions = total + h.change.chi2, directions + len(h.change.z)
    assert abs(total - directions) < 4 * np.sqrt(2 * directions)


def _set(*path: Any, to: Any) -> Callable[[str], str]:
    def edit(text: str) -> str:
        content = json.loads(text)
        at: Any = content
        for key in path[:-1]:
            at = at[key]
        at[path[-1]] = to
        return json.dumps(content)

    return edit


DAMAGED: dict[str, Callable[[str], str]] = {
    "no JSON": lambda text: text[:1000],
    "nothing in it": lambda text: "[]",
    "NaN": _set("values", "K1", to=[float("nan")] * 4),
    "a parameter too few": _set("values", "K1", to=[1e-3] * 3),
    "singular": _set("square_root_information", 0, 0, to=0.0),
    "ragged": _set("square_root_information", 3, to=[1.0]),
    "no such parameter": _set("fitted", 0, "name", to="K9"),
    "no limits": _set("validity", "a_z", to=[1.0]),
    "negative gain": _set("values", "K1", to=[-1e-3] * 4),
    "another spin": _set("values", "spin_frequency", to=[0.5]),
    "other effects": _set("model", "effects", to=["lag"]),
}


def test_a_damaged_calibration_is_one_message_and_so_is_none(kept: tuple[Any, ...], tmp_path: Path) -> None:
    copy, text = new_model(tmp_path), (kept[0] / "calibration.json").read_text()
    with pytest.raises(UserError, match="no saved calibration"):
        api.saved_calibration(api.load(copy))
    for damage in DAMAGED.values():
        (copy / "calibration.json").write_text(damage(text))
        with pytest.raises(UserError) as error:
            api.saved_calibration(api.load(copy))
        assert str(copy) in error.value.message


def test_gaps_between_flights_are_those_of_their_stamps() -> None:
    """Of dates, in any order; of times of a day unless two flights overlap; of seconds nothing is known."""
    x = scenario(3, duration=60.0, rate=RATE).simulate({}).flight()
    late = dataclasses.replace(x, time=x.time + 7200.0)
    for instants, other, expected in ((True, late, 7200.0), (True, x, 60.0), (False, late, 60.0)):
        both = [dataclasses.replace(y, instants=instants) for y in (x, other)]
        (first, second), timed = drift.find_starts(both)
        assert second - first == pytest.approx(expected, abs=1.0)
        assert timed == (expected == 7200.0)
    days = [dataclasses.replace(x, origin=datetime(2026, 3, n, tzinfo=UTC)) for n in (2, 1)]
    assert drift.find_starts(days) == ([86400.0, 0.0], True)


def test_parameters_walk_on_between_flights(monkeypatch: pytest.MonkeyPatch) -> None:
    """A gain that changed from one flight to the next, an hour later; given in the wrong order."""
    s = scenario(3, duration=60.0, rate=RATE)
    i, day = s.instrument, datetime(2026, 3, 1, tzinfo=UTC)
    later = i.replace(K1=i.accelerometers["K1"] * (1 + 1e-7 * np.array([1.0, -1.0, 1.0, 0.0])))
    flights = [
        dataclasses.replace(dataclasses.replace(s, instrument=k).simulate({}).flight(), origin=at)
        for k, at in ((later, day + timedelta(hours=1)), (i, day))
    ]
    f = fit(load_packaged(), s.sheet, observe_flights(flights, s.sheet), candidates=False)
    monkeypatch.setattr(drift, "_find_rates", lambda *_: {"K1": 1e-4})  # the search takes most of the time
    d = drift.smooth_drift(f, flights)
    assert [e.flight for e in d.epochs] == [1] * 24 + [0] * 24
    assert d.epochs[24].elapsed - d.epochs[0].elapsed == pytest.approx(3600.0)
    assert d.timed
    jump = np.linalg.norm(np.diff(d.steps, axis=0), axis=1)
    assert np.argmax(jump) == 23


def test_drifting_gains_are_followed_and_constant_ones_left_alone() -> None:
    """What is compensated with them is as sure as it says; with constant parameters it is not."""
    s = scenario(3, duration=300.0, rate=RATE, gradient_rms=50e-9)
    still = s.simulate({}).flight()
    f = fit(load_packaged(), s.sheet, observe_flights([still], s.sheet), candidates=False)
    assert drift.smooth_drift(f, [still]).rates == {}
    x = s.simulate({"gain-drift": {"dK1_dt": [4e-10, -4e-10, 8e-11, -8e-11]}}).flight()  # 1/s: 1e-7 in 250 s
    rms = {}
    for kind in ("self", "smoothed"):
        ((c,),) = prepare(load_packaged(), s.sheet, [x], kind).channels  # type: ignore[arg-type]
        result = c.compensate()
        z = ((result.gradient - truth(x, c.demodulator)).real / result.std[0])[:: int(2 * RATE)]
        rms[kind] = np.sqrt(np.nanmean(z**2))
    assert 0.7 < rms["smoothed"] < 1.4
    assert rms["self"] > 2.0
