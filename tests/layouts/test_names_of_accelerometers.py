"""An accelerometer that the sheet calls "north" is called so wherever a result names it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ragg_runtime.estimation.regressors import list_base_columns, spell_name
from ragg_runtime.identification.comparison import compare
from ragg_runtime.instrument.read_toml import parse_instrument
from ragg_runtime.model import derive
from ragg_runtime.wording.describe import write_parameter
from tests.layouts import sheets
from tests.layouts.flown import flown_by

NAMES = ("north", "south", "east", "west")


def test_what_is_far_off_its_sheet_is_called_by_its_name_there() -> None:
    angles = ((0.0, 1), (180.0, 1), (90.0, -1), (270.0, -1))
    four = [sheets.accelerometer(n, a, s) for n, (a, s) in zip(NAMES, angles, strict=True)]
    sheet = parse_instrument(sheets.sheet([sheets.disc("A", four)], 4))
    K1 = np.array(sheet.accelerometers["K1"])
    K1[1] *= 1.01
    flight = flown_by(replace(sheet, accelerometers={**sheet.accelerometers, "K1": K1}), 120.0)
    model = derive.derived((), (), sheet.form, sheet.layout)[0]

    farthest = compare(model, sheet, [flight]).off_sheet[0]
    assert farthest.in_words().startswith("K1 of south is ")
    assert farthest.as_json()["accelerometer"] == 2
    assert farthest.as_json()["accelerometer_name"] == "south"
    assert {c.accelerometer_name for c, _ in list_base_columns(model, sheet)} == set(NAMES)
    said = {"name": "K1", "accelerometer": 2, "value": 1.0, "std": 0.1, "unit": "mA/g"}
    assert write_parameter({**said, **spell_name(2, "south")}).startswith("K1 of south = ")


def test_usual_names_are_not_repeated_in_json() -> None:
    assert spell_name(2, "A2") == spell_name(None, "") == {}
    assert write_parameter(
        {"name": "K1", "accelerometer": 2, "value": 1.0, "std": 0.1, "unit": "g"}
    ).startswith("K1 of A2 = ")
