"""`ragg calibrate --save`, what the kept calibration is worth on another flight, and parameters that drift."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation import drift, frozen
from ragg_runtime.compensation.calibrate import calibrate, make_saved
from ragg_runtime.compensation.channel import Quality
from ragg_runtime.compensation.compensate import prepare
from ragg_runtime.estimation.fitted import fit
from ragg_runtime.estimation.observation import observe_flights
from ragg_runtime.model import model as load
from ragg_runtime.model.model import load_packaged
from ragg_runtime.reference.scenario import scenario
from tests.rate import RATE
from tests.runtime.flown_twice import DURATION, files, flights, new_model, run, truth


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, Path, dict[str, Any]]:
    folder = tmp_path_factory.mktemp("kept")
    model, (one, two) = new_model(folder), files(folder)
    run("calibrate", model, one, "--save", "--json", folder / "c.json")
    return model, one, two, json.loads((folder / "c.json").read_text())


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
    found = {(q["name"], q["accelerometer"]): q["value"] for q in c["parameters"]}
    for column, place in zip(saved.columns, saved.index, strict=True):
        value = saved.p[place] / column.unit_factor
        assert value == pytest.approx(found[column.name, column.accelerometer], rel=1e-12)
    directory = dataclasses.replace(m.directory, calibration=saved.as_text())
    again = api.saved_calibration(dataclasses.replace(m, directory=directory))
    assert np.array_equal(again.information, saved.information)
    assert np.array_equal(again.p, saved.p)
    assert saved.validity["a_z"][0] < saved.validity["a_z"][1]
    assert list(saved.flights) == ["one"]
    assert [s.action for s in m.directory.history] == ["new", "calibrate"]


def test_a_sheet_of_another_certainty_changes_the_scales_alone(kept: tuple[Any, ...], tmp_path: Path) -> None:
    """The covariance in SI is the one that was saved, whatever the sheet says now."""
    copy = new_model(tmp_path)
    saved = api.saved_calibration(api.load(kept[0]))
    text = (copy / "model.toml").read_text()
    (copy / "model.toml").write_text(text.replace("[accelerometers.K2]", "[accelerometers.K2]\nsigma = 5e-6"))
    (copy / "calibration.json").write_text((kept[0] / "calibration.json").read_text())
    again = api.saved_calibration(api.load(copy))
    scales = [np.array([c.scale for c in x.columns]) for x in (saved, again)]
    assert not np.array_equal(*scales)
    inverse = [np.linalg.inv(x.information) * s[:, None] for x, s in zip((saved, again), scales, strict=True)]
    std = [np.linalg.norm(x, axis=1) for x in inverse]
    assert std[0] == pytest.approx(std[1], rel=1e-9)


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
    found = {s["name"]: s for s in h.as_json()["frozen"]["suspects"]}
    assert max(s["share"] for s in found.values()) > 0.9
    if "K1[1]" in found:
        expected = 2e-8 * float(m.instrument.accelerometers["K1"][0]) / (1e-3 / 9.8)  # in mA/g
        assert found["K1[1]"]["change"] == pytest.approx(expected, rel=0.1)
    assert h.comparison.calibrated.rms_Eo > 1.5 * h.free.rms_Eo


def test_what_is_compensated_by_a_calibration_that_does_not_hold_says_so(kept: tuple[Any, ...]) -> None:
    found = api.compensate(api.load(kept[0]), [flights(1e-6)[1]], "frozen")
    c = found.as_json()
    assert np.all(found.series[0]["quality"] & int(Quality.CALIBRATION)), "no sample is good"
    assert c["frozen"]["holds"] is False
    assert c["frozen"]["chi2"] > 100
    assert "does NOT hold" in c["notes"][0]


@pytest.mark.parametrize(("changed", "holds"), [(0.0, True), (1e-6, False)])
def test_of_a_long_flight_some_blocks_say_whether_it_holds(changed, holds, kept, monkeypatch) -> None:
    """Without an encoder the disc's angle counts from the flight's beginning, not from a block's."""
    monkeypatch.setattr(frozen, "TESTED", 500)
    c = api.compensate(api.load(kept[0]), [flights(changed)[1]], "frozen").as_json()
    assert c["frozen"]["holds"] is holds
    assert ("notes" in c) is not holds


def test_chi_square_is_one_a_direction_if_nothing_changed() -> None:
    """Over several pairs of flights of unchanged instruments the statistic has its mean."""
    total, directions, model = 0.0, 0, load.load_packaged()
    for seed in (1, 2):
        s = scenario(seed, duration=200.0, rate=RATE)
        saved = make_saved(calibrate(model, s.sheet, [s.simulate({}).flight()]), [], "now")
        t = scenario(seed + 50, duration=200.0, rate=RATE)
        x = dataclasses.replace(s, motion=t.motion, seed=t.seed).simulate({}).flight()
        h = frozen.compare_frozen(model, s.sheet, [x], saved)
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


def test_the_walk_is_the_sum_of_its_steps() -> None:
    """Against dense least squares of two states of three parameters, one of which walks."""
    rng = np.random.default_rng(1)
    prior, first, second = (np.linalg.qr(rng.standard_normal((6, 4)), mode="r") for _ in range(3))
    walk = np.array([0.0, 0.5, 0.0])
    forward, _ = drift._filter(prior, [first, second], np.array([1.0]), walk)
    A = np.zeros((3 + 4 + 4 + 1, 5))  # x0, x1, x2 and x1 after its step at the end
    b = np.zeros(12)
    A[:3, :3], b[:3] = prior[:3, :3], prior[:3, 3]
    A[3:7, :3], b[3:7] = first[:, :3], first[:, 3]
    A[7:11, [0, 3, 2]], b[7:11] = second[:, :3], second[:, 3]
    A[11, [1, 3]] = -1 / 0.5, 1 / 0.5
    x = np.linalg.lstsq(A, b, rcond=None)[0]
    R = forward[-1]
    assert np.linalg.solve(R[:, :3], R[:, 3]) == pytest.approx(x[[0, 3, 2]])
    C = np.linalg.inv(A[:, :4].T @ A[:, :4])
    assert np.linalg.inv(R[:, :3].T @ R[:, :3])[1, 1] == pytest.approx(C[3, 3])


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
    s = scenario(3, duration=450.0, rate=RATE, gradient_rms=50e-9)
    still = s.simulate({}).flight()
    f = fit(load_packaged(), s.sheet, observe_flights([still], s.sheet), candidates=False)
    assert drift.smooth_drift(f, [still]).rates == {}
    x = s.simulate({"gain-drift": {"dK1_dt": [2e-10, -2e-10, 4e-11, -4e-11]}}).flight()  # 1/s: 1e-7 in 500 s
    rms = {}
    for kind in ("self", "smoothed"):
        ((c,),) = prepare(load_packaged(), s.sheet, [x], kind).channels  # type: ignore[arg-type]
        found = c.compensate()
        z = ((found.gradient - truth(x, c.demodulator)).real / found.std[0])[:: int(2 * RATE)]
        rms[kind] = np.sqrt(np.nanmean(z**2))
    assert 0.7 < rms["smoothed"] < 1.4
    assert rms["self"] > 2.0
