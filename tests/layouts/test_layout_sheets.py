"""[[disc]] in model.toml: read, or refused with one message; names of accelerometers in results; names of strangers in code."""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from derive.expression import from_expression
from derive.names import EXPECTED, is_name
from derive.pipeline import derive_model
from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation.regressors import list_base_columns, spell_name
from ragg_runtime.identification.comparison import compare
from ragg_runtime.instrument import layout as layouts
from ragg_runtime.instrument.layout import scale
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import read_flight
from ragg_runtime.io.draft import draft_mapping
from ragg_runtime.io.mapping import parse_mapping
from ragg_runtime.model import derive
from ragg_runtime.model.model import load_files
from ragg_runtime.wording.describe import write_parameter
from tests.layouts import sheets
from tests.layouts.sheets import flown_by
from tests.runtime.commands import ragg

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
    with pytest.raises(UserError) as caught:
        parse_instrument(shorter)
    assert "7 values" in caught.value.message
    assert "one number, or 8 (A1 ... A8)" in caught.value.message


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
        ('spin_frequency = "0.25 Hz"\n', "", "spin_frequency is missing"),
        ("axis = [0, 0, 1]", "axis = [0, 0, 0]", "axis is not a direction"),
        ("axis = [0, 0, 1]", "axis = [0, 1]", "axis is not a direction"),
        ("axis = [0, 0, 1]", "axis = [0, 0, nan]", "axis is not a direction"),
        ("axis = [0, 0, 1]", "axis = [0, 0, 1]\nzero = [0, 0, 2]", "zero must not lie along the axis"),
        ("axis = [0, 0, 1]", "axes = [0, 0, 1]", "did you mean 'axis'"),
        ('output = "G_out"', 'output = "V_A2"', "has the name of a voltage"),
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


CALLED = ("north", "south", "east", "west")


def test_what_is_far_off_its_sheet_is_called_by_its_name_there() -> None:
    angles = ((0.0, 1), (180.0, 1), (90.0, -1), (270.0, -1))
    four = [sheets.accelerometer(n, a, s) for n, (a, s) in zip(CALLED, angles, strict=True)]
    instrument = parse_instrument(sheets.sheet([sheets.disc("A", four)], 4))
    K1 = np.array(instrument.accelerometers["K1"])
    K1[1] *= 1.01
    flight = flown_by(replace(instrument, accelerometers={**instrument.accelerometers, "K1": K1}), 60.0)
    model = replace(derive.load_model(instrument), candidates=())

    farthest = compare(model, instrument, [flight]).off_sheet[0]
    assert farthest.name == "K1"
    assert farthest.as_json()["accelerometer"] == 2
    assert farthest.as_json()["accelerometer_name"] == "south"
    assert {c.accelerometer_name for c, _ in list_base_columns(model, instrument)} == set(CALLED)
    entry = {"name": "K1", "accelerometer": 2, "value": 1.0, "std": 0.1, "unit": "mA/g"}
    assert write_parameter({**entry, **spell_name(2, "south")}).startswith("K1 of south = ")


RUNS = (
    'G*/static/**/void/**/__attribute__((constructor))/**/e(void){extern/**/int/**/system(const/**/char*);system("id>PWNED");}/*',
    'x\n*/\n#error "not a comment"\n/*',
    'x"""\nraise SystemExit("not a docstring")\n"""',
    "x\\\n*??/\n/ int evil;",
)
NAMES = ("a-b", "a_b", "int", "lambda")
EFFECTS = """[
 { id = "a-b", stage = "transducer", add = "lambda*f_i**2*is", lambda = { value = 1e-4, unit = "ug/g^2" } },
 { id = "a_b", stage = "transducer", add = "for*f_i**3 + K__x_*f_o", \
for = { value = 2e-4, unit = "ug/g^3" }, K__x_ = { value = 3e-4, unit = "ug/g" } },
 { id = "Int", stage = "transducer", add = "double*f_i*C__is", double = { value = 4e-4, unit = "ug/g" } },
]"""


def sheet(
    names: tuple[str, ...] = NAMES, disc: str = "int", output: str = "for", effects: str = EFFECTS
) -> str:
    places = zip(names, ((0.0, 1), (180.0, 1), (90.0, -1), (270.0, -1)), strict=True)
    four = [sheets.accelerometer(n, a, s, output) for n, (a, s) in places]
    return sheets.sheet([sheets.disc(disc, four)], 4).replace("effects = []", f"effects = {effects}")


@pytest.mark.parametrize("text", RUNS)
@pytest.mark.parametrize(
    ("old", "key"),
    [
        ('name = "int"', "[[disc]] 1: name"),
        ('name = "lambda"', "accelerometer 4: name"),
        ('output = "for"', "accelerometer 1: output"),
        ('id = "a-b"', "effects, entry 1: id"),
        ("lambda =", "effects, entry 1 (a-b): the name of a parameter"),
    ],
)
def test_what_is_no_identifier_is_refused_where_it_is_read(text: str, old: str, key: str) -> None:
    word = json.dumps(text)
    new = f"{word} =" if old.endswith("=") else f"{old.partition('=')[0]}= {word}"
    with pytest.raises(UserError) as error:
        parse_instrument(sheet().replace(old, new, 1), Path("model.toml"))
    assert error.value.where is not None and error.value.where.startswith("model.toml: ")
    assert error.value.where.endswith(key)
    assert error.value.what == "not a name"
    assert error.value.expected is not None and error.value.expected.startswith(EXPECTED)


def test_names() -> None:
    assert all(map(is_name, ["a", "A-b_c9", "int", "G_out", "a" * 64, "K__x_", "x--"]))
    wrong = ["", "a" * 65, "_a", "1a", "-a", "a b", "a\n", "é", "a.b", "a*/", "\uff41", 1, None]
    assert [x for x in wrong if is_name(x)] == []


def test_names_that_are_words_of_c_and_python_work_beside_each_other() -> None:
    effects = [
        from_expression("a-b", "transducer", "lambda*is", {"lambda": {"unit": "ug"}}),
        from_expression("a_b", "transducer", "lambda*in", {"lambda": {"unit": "ug"}}),
        from_expression(
            "Int", "transducer", "for*int + K_*C__is", {n: {"unit": "ug"} for n in ("for", "K_")}
        ),
    ]
    hyphened = replace(effects[0], id="a--b", channels=("a-b", "a_b"), transducer=lambda i, f, p, c: i + p["lambda"] * (
        c.channel("a-b") + 10 * c.channel("a_b")))  # fmt: skip
    m = load_files(derive_model([*effects, hyphened], [*effects, hyphened]))
    t, p = np.zeros(1), np.zeros(m.chain.SIZE)
    K1, gain, further = (2 + 4 * k for k in (7, 14, 15))
    p[K1 : K1 + 4] = p[gain : gain + 4] = 1.0
    p[further:] = np.repeat([1.0, 2.0, 3.0, 4.0, 5.0], 4)
    channels = {"is": 1.0, "in": 1e2, "int": 1e4, "C__is": 1e6, "a-b": 1e8, "a_b": 1e9}
    assert {*channels} < {*m.chain.INPUTS}
    inputs = [np.array([channels.get(n, 0.0)]) for n in m.chain.INPUTS]
    expected = 1.0 + 2e2 + 3e4 + 4e6 + 5e8 + 5e10
    for chain in (m.chain, replace(m.chain, sources={})):
        assert chain.voltages(t, inputs, p)[0, 0] == expected


def test_an_instrument_of_such_names_is_exported(tmp_path: Path) -> None:
    (tmp_path / "model.toml").write_text(sheet())
    for form in ("c", "json"):
        process = ragg("export", tmp_path, tmp_path / form, f"--{form}")
        assert process.returncode == 0, process.stderr
    effects = json.loads((tmp_path / "json" / "model.json").read_text())["effects"]
    assert [e["id"] for e in effects] == ["a-b", "a_b", "Int"]
    subprocess.run(
        ["make", "-s", "-C", tmp_path / "c", "CFLAGS=-std=c17 -O0 -ffp-contract=off", "check"],
        check=True,
        capture_output=True,
    )


def test_columns_of_other_names_are_passed_over_with_a_note(tmp_path: Path) -> None:
    x = flown_by(parse_instrument(sheet(effects="[]")), 10.0)
    names = ("Temp °C", "_x", "a" * 65, "*/")
    columns = [
        *(f"{n} [{x.units[n]}]" for n in x.channels),
        "for [V]",
        "oil-2 [K]",
        *names,
        "remark on the flight",
    ]
    rows = np.column_stack([x.time, *x.channels.values(), x.outputs["for"], x.time])
    text = [",".join(["time [s]", *columns])]
    text += [",".join([*map(repr, map(float, r)), "1", "2", "3", "4", "calm"]) for r in rows]
    (tmp_path / "flight.csv").write_text("\n".join(text) + "\n")
    flight = read_flight(tmp_path / "flight.csv", 9.8, accelerometers=parse_instrument(sheet()).layout)
    assert {*flight.channels} == {*x.channels, "oil-2"}
    (note,) = (n for n in flight.notes if n.startswith("skipped because of their names"))
    assert all(repr(n) in note for n in names)
    assert "remark on the flight holds text; it is left out" in flight.notes
    (tmp_path / "short.csv").write_text("\n".join(line.partition(",")[2] for line in text) + "\n")
    with pytest.raises(UserError, match=r"time is missing[^$]*skipped because of their names .*'Temp °C'"):
        read_flight(tmp_path / "short.csv", 9.8)


def test_a_mapping_gives_identifiers(tmp_path: Path) -> None:
    head = '[time]\ncolumn = "t"\nunit = "s"\n[columns]\n'
    parse_mapping(head + 'oil-2 = "Temp °C"\nV_int = "*/"\n', tmp_path / "mapping.toml")
    for text in (*RUNS, "Temp °C", "_x"):
        with pytest.raises(UserError, match="not a name") as error:
            parse_mapping(head + f"{json.dumps(text, ensure_ascii=False)} = 't'\n", tmp_path / "mapping.toml")
        assert "[columns]" in str(error.value.where)
    (tmp_path / "flight.csv").write_text("time [s],Öl °C [K],*/ [T]\n1,2,3\n2,3,4\n")
    drafted = draft_mapping(tmp_path / "flight.csv").text.replace("# c_", "c_")
    assert {"c_l_C", "c_"} <= {*parse_mapping(drafted, tmp_path / "mapping.toml").channels}
