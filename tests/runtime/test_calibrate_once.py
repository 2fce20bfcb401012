"""`ragg calibrate --save`, and what the kept calibration is worth on another flight."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ragg_runtime import api
from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation import calibrated, frozen
from ragg_runtime.compensation.saved import read, with_another
from ragg_runtime.compensation.series import Quality
from ragg_runtime.model import model as load
from ragg_runtime.reference.scenario import scenario
from tests.rate import RATE
from tests.runtime.flown_twice import DURATION, files, flights, new_model, run


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, Path, dict[str, Any]]:
    folder = tmp_path_factory.mktemp("kept")
    model, (one, two) = new_model(folder), files(folder)
    run("calibrate", model, one, "--save", "--json", folder / "c.json")
    return model, one, two, json.loads((folder / "c.json").read_text())


def test_parameters_with_their_sheet_and_what_the_record_sees(kept: tuple[Any, ...]) -> None:
    _, _, _, c = kept
    assert c["converged"] is True
    assert c["error"]["calibrated"]["rms_Eo"] < 1e-3 * c["error"]["nominal"]["rms_Eo"]
    assert {"name", "accelerometer", "value", "std", "unit", "sheet", "sheet_sigma"} <= set(
        c["parameters"][0]
    )
    assert 0 < c["directions"]["seen"] < c["directions"]["fitted"] == len(c["parameters"])
    s = scenario(7, duration=DURATION, rate=RATE)
    for q in c["parameters"]:
        assert 0 < q["std"] <= 1.001 * q["sheet_sigma"]
    for q in c["combinations"]:
        name, signs = (
            q["name"].split()[-1],
            {"Sigma": (1, 1, 1, 1), "D1234": (1, 1, -1, -1)}.get(q["name"].split()[0]),
        )
        if signs and name in ("K6", "K7") and q["unit"] == "ug/g^2":
            g = s.sheet.accelerometers["k_VI"] * s.sheet.accelerometers["K1"]
            true = float(np.sum(np.array(signs) * s.instrument.accelerometers[name] * g / np.mean(g)))
            assert abs(q["value"] - true * 9.8 / 1e-6) < 5 * q["std"]


def test_what_is_kept_is_what_was_found_to_the_last_bit_with_its_history(kept: tuple[Any, ...]) -> None:
    model, _, _, c = kept
    m = api.load(model)
    assert m.directory.calibration is not None
    (saved,) = read(m.directory.calibration, "here")
    found = {(q["name"], q["accelerometer"]): q["value"] for q in c["parameters"]}
    for column, place in zip(saved.columns, saved.index, strict=True):
        assert saved.p[place] / column.unit_factor == pytest.approx(
            found[column.name, column.accelerometer], rel=1e-12
        )
    again = read(with_another(None, saved, "here"), "here")[0]
    assert np.array_equal(again.information, saved.information)
    assert np.array_equal(again.p, saved.p)
    assert saved.validity["a_z"][0] < saved.validity["a_z"][1]
    assert list(saved.flights) == ["one"]
    assert [s.action for s in m.directory.history] == ["new", "calibrate"]
    assert "calibrate" in run("history", model)


def test_on_another_flight_of_the_same_instrument_it_holds(kept: tuple[Any, ...], tmp_path: Path) -> None:
    model, _, two, _ = kept
    told = run(
        "compare", model, two, "--frozen", "--json", tmp_path / "f.json", "--report", tmp_path / "f.html"
    )
    f = json.loads((tmp_path / "f.json").read_text())
    assert f["frozen"]["holds"] is True
    assert 0.01 < f["frozen"]["p_value"] <= 1
    assert f["error"]["calibrated"] == f["error"]["holdout"]
    assert f["error"]["calibrated"]["rms_Eo"] < 1.02 * f["frozen"]["free"]["calibrated"]["rms_Eo"]
    assert max(abs(q["z"]) for q in f["frozen"]["drift"]) < 4
    assert "holds here" in told
    page = (tmp_path / "f.html").read_text()
    assert "The saved calibration holds here" in page
    assert ">frozen<" in page and ">held out<" not in page  # nothing is fitted on half of the blocks
    assert "scored on the others" not in page


def test_an_instrument_that_has_changed_is_told_with_what_would_explain_it(kept: tuple[Any, ...]) -> None:
    m = api.load(kept[0])
    h = frozen.hold(m.model, m.instrument, [flights(2e-8)[1]], api.saved_calibration(m))
    assert not h.holds
    found = {s["name"]: s for s in h.suspects()}
    best = max(s["share"] for s in found.values())
    assert best > 0.9
    K1 = float(m.instrument.accelerometers["K1"][0])
    expected = 2e-8 * K1 / (1e-3 / 9.8)  # in mA/g
    if "K1[1]" in found:
        assert found["K1[1]"]["change"] == pytest.approx(expected, rel=0.1)
    assert h.comparison.calibrated.rms_Eo > 1.5 * h.free.rms_Eo


@pytest.mark.parametrize("length", [10**6, 500])
def test_what_is_compensated_by_a_calibration_that_does_not_hold_says_so(
    kept: tuple[Any, ...], length: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(frozen, "LOOKED", length)  # of a long flight stretches are looked at
    m = api.load(kept[0])
    found = api.compensate(m, [flights(1e-6)[1]], "frozen")
    c = found.as_json()
    assert np.all(found.series[0]["quality"] & int(Quality.CALIBRATION)), "no sample is good"
    assert c["frozen"]["holds"] is False
    assert c["frozen"]["chi2"] > 100
    assert "does NOT hold" in c["notes"][0]
    assert found.series[0]["quality"].all()


def test_a_disc_angle_from_elsewhere_is_told_and_nothing_is_called_good(kept: tuple[Any, ...]) -> None:
    m, x = api.load(kept[0]), flights()[1]
    late = dataclasses.replace(
        x, time=x.time + 10.0, began=None
    )  # half a turn by the convention, none by its own
    found = api.compensate(m, [late], "frozen")
    assert found.as_json()["frozen"]["holds"] is False
    assert 'angle_origin = "first-sample"' in found.as_json()["notes"][1]
    assert found.series[0]["quality"].all()


def test_stretches_of_a_long_flight_do_not_contradict_a_calibration_that_holds(
    kept: tuple[Any, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without an encoder the disc's angle counts from the flight's beginning, not from a stretch's."""
    monkeypatch.setattr(frozen, "LOOKED", 500)
    c = api.compensate(api.load(kept[0]), [flights()[1]], "frozen").as_json()
    assert c["frozen"]["holds"] is True
    assert "notes" not in c


def test_chi_square_is_one_a_direction_if_nothing_changed() -> None:
    """Over several pairs of flights of unchanged instruments the statistic has its mean."""
    total, directions = 0.0, 0
    for seed in (1, 2, 3):
        s = scenario(seed, duration=450.0)
        model = load.packaged()
        c = calibrated.calibrated(model, s.sheet, [s.simulate({}).flight()])
        saved = read(with_another(None, calibrated.to_save(c, [], "now"), "x"), "x")[-1]
        t = scenario(seed + 50, duration=450.0)
        x = s.__class__(**{**s.__dict__, "motion": t.motion, "seed": t.seed}).simulate({}).flight()
        h = frozen.hold(model, s.sheet, [x], saved)
        total, directions = total + h.change.chi2, directions + len(h.change.z)
    assert abs(total - directions) < 4 * np.sqrt(2 * directions)


def _edited(change: Callable[[dict[str, Any]], None]) -> Callable[[str], str]:
    def edit(text: str) -> str:
        content = json.loads(text)
        change(content["calibrations"][0])
        return json.dumps(content)

    return edit


def _set(*path: Any, to: Any) -> Callable[[str], str]:
    def change(entry: dict[str, Any]) -> None:
        at: Any = entry
        for key in path[:-1]:
            at = at[key]
        at[path[-1]] = to

    return _edited(change)


HOSTILE: dict[str, Callable[[str], str]] = {
    "no JSON": lambda text: text[:1000],
    "nothing in it": lambda text: '{"calibrations": []}',
    "NaN": _set("values", "K1", to=[float("nan")] * 4),
    "a parameter too few": _set("values", "K1", to=[1e-3] * 3),
    "singular": _set("square_root_information", 0, 0, to=0.0),
    "ragged": _set("square_root_information", 3, to=[1.0]),
    "place outside": _set("fitted", 0, "place", to=10**6),
    "no limits": _set("validity", "a_z", to=[1.0]),
    "negative gain": _set("values", "K1", to=[-1e-3] * 4),
    "another spin": _set("values", "spin_frequency", to=[0.5]),
    "other effects": _set("model", "effects", to=["lag"]),
}


@pytest.mark.parametrize("what", sorted(HOSTILE))
def test_a_file_that_anyone_may_have_written_is_refused_in_one_message(
    what: str, kept: tuple[Any, ...], tmp_path: Path
) -> None:
    text = (kept[0] / "calibration.json").read_text()
    copy = new_model(tmp_path)
    (copy / "calibration.json").write_text(HOSTILE[what](text))
    m = api.load(copy)
    with pytest.raises(UserError) as error:
        api.saved_calibration(m)
    assert str(copy) in error.value.message


def test_without_a_saved_calibration_frozen_says_what_to_do(tmp_path: Path) -> None:
    copy = new_model(tmp_path)
    with pytest.raises(UserError, match="no saved calibration"):
        api.saved_calibration(api.load(copy))
