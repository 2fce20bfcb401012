"""[[disc]] in model.toml: read, written, refused with one message; its names stand wherever a result names an accelerometer."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.regressors import list_base_columns, spell_name
from ragg_runtime.identification.comparison import compare
from ragg_runtime.instrument import layout as layouts
from ragg_runtime.instrument.layout import scale
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.model import derive
from ragg_runtime.wording.describe import write_parameter
from tests.layouts import sheets
from tests.layouts.flown import flown_by

FOUR = sheets.sheet([sheets.disc("A", sheets.four("A", "G_out"))], 4)


def test_the_papers_four_written_as_discs_are_the_papers_instrument() -> None:
    i = parse_instrument(FOUR)
    assert i.layout.like_paper
    assert i.g0 == 9.8
    k = i.accelerometers
    plain = layouts.paper(0.1, 0.25)
    k1, R = k["k_VI"] * k["K1"], i.radii + k["dR"]
    assert scale(i.layout.outputs[0], k1, R) == scale(plain.outputs[0], k1, R) == float(np.sum(k1 * R))


def test_one_number_stands_for_all_and_lists_are_as_long_as_there_are_accelerometers() -> None:
    text = sheets.sheet(sheets.complements(), 8)
    i = parse_instrument(text)
    assert i.accelerometers["k_VI"].shape == (8,)
    shorter = re.sub(r"K0 = \{ value = \[[^,]*, ", "K0 = { value = [", text)
    with pytest.raises(UserError) as told:
        parse_instrument(shorter)
    assert "7 values" in told.value.message
    assert "one number, or 8 (A1 ... A8)" in told.value.message


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('name = "A2"', 'name = "A1"', "two of the same name"),
        ("sign = 1", "sign = 2", "sign must be 1 or -1"),
        ("sign = 1", "sign = true", "sign must be 1 or -1"),
        ('angle = "0.0 deg"', "angle = 90", "unit"),
        ('angle = "0.0 deg"\n', "", "angle is missing"),
        ('output = "G_out"\n', "", "output is missing"),
        ('output = "G_out"', 'output = ""', "output: not a name"),
        ('radius = "0.1 m"\n', "", "radius is missing"),
        ('radius = "0.1 m"', 'radius = "-0.1 m"', "out of range"),
        ('radius = "0.1 m"', 'radius = "0.1 s"', "dimension"),
        ('spin_frequency = "0.25 Hz"\n', "", "spin_frequency is missing"),
        ("axis = [0, 0, 1]", "axis = [0, 0, 0]", "axis is not a direction"),
        ("axis = [0, 0, 1]", "axis = [0, 1]", "axis is not a direction"),
        ("axis = [0, 0, 1]", "axis = [0, 0, nan]", "axis is not a direction"),
        ("axis = [0, 0, 1]", "axis = [0, 0, 1]\nzero = [0, 0, 2]", "zero must not lie along the axis"),
        ("axis = [0, 0, 1]", "axes = [0, 0, 1]", "did you mean 'axis'"),
        ('output = "G_out"', 'output = "V_A2"', "has the name of a voltage"),
        ('g0 = "9.8 m/s^2"', 'g0 = "9.8 g"', "g0 defines it"),
        ('spin_frequency = "0.25 Hz"', 'spin_frequency = "0.25 Hz"\ng0 = "9.81 m/s^2"', "g0 is given twice"),
    ],
)
def test_refused(old: str, new: str, words: str) -> None:
    assert old in FOUR
    with pytest.raises(UserError, match=re.escape(words)):
        parse_instrument(FOUR.replace(old, new, 1))


def test_an_output_across_discs_is_refused() -> None:
    discs = [sheets.disc(n, [sheets.accelerometer(f"{n}1", 0.0, 1)]) for n in "AB"]
    with pytest.raises(UserError, match="accelerometers of several discs"):
        parse_instrument(sheets.sheet(discs, 2))


def test_gain_and_phase_of_a_complement_turned_by_an_eighth() -> None:
    i = parse_instrument(sheets.sheet(sheets.complements(), 8))
    k1, R = np.ones(8), np.full(8, 0.1)
    first, second = (layouts.gain(o, k1, R) for o in i.layout.outputs)
    assert first == pytest.approx(0.4)
    assert second == pytest.approx(0.4j)


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
    assert farthest.name == "K1"
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
