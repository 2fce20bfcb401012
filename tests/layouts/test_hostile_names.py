"""Names in a stranger's files: identifiers, or refused where they are read; and what becomes of them in code."""

from __future__ import annotations

import ast
import json
import re
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from derive.expression import from_expression
from derive.layout import PAPER, SymbolicForm, SymbolicOutput
from derive.names import EXPECTED, channel_in_code, channel_of, id_in_code, is_name, parameter_in_code
from derive.pipeline import derive_model, derive_plain
from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.model_toml import parse_instrument
from ragg_runtime.io import read_flight
from ragg_runtime.io.draft import draft_mapping
from ragg_runtime.io.mapping import parse_mapping
from ragg_runtime.model.model import load_files
from tests.layouts import sheets
from tests.layouts.flown import flown_by
from tests.runtime.commands import ragg

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


def code_alone(name: str, text: str) -> str:
    """A file without comments and docstrings."""
    if name.endswith((".c", ".h")):
        return re.sub(r"/\*.*?\*/", "", re.sub(r"\?\?/|\\\n", "", text), flags=re.DOTALL)
    if name.endswith(".tex"):
        return re.sub(r"^%.*\n", "", text, flags=re.MULTILINE)
    tree = ast.parse(text)
    assert isinstance(tree.body[0], ast.Expr)
    return ast.dump(ast.Module(tree.body[1:], []))


@pytest.mark.parametrize("text", RUNS)
def test_emitters_let_no_name_out_of_a_comment(text: str) -> None:
    """Whatever came through: the code is that of plain names."""

    def files(name: str) -> dict[str, str]:
        shape = replace(
            PAPER,
            names=(name, "b", "c", "d"),
            outputs=(SymbolicOutput(name, (0, 1), (1, 1)), SymbolicOutput("G", (2, 3), (1, -1))),
        )
        form = SymbolicForm(layout=replace(shape, own=True))
        made = from_expression("mine", "transducer", "K*f_i", {"K": {"unit": "ug"}})
        q = replace(made.parameters[0], meaning=name, latex=name)
        effect = replace(made, title=name, physics=name, source=name, equation=name, parameters=(q,))
        found = {**derive_model((), (), form), **derive_plain((effect,), form)}
        found |= {f"own/{n}": t for n, t in derive_model((effect,), (effect,), form).items()}
        return {n: t for n, t in found.items() if not n.endswith(".json")}

    plain, evil = files("G_out"), files(text)
    assert plain.keys() == evil.keys() and len(plain) > 10
    for name in plain:
        assert code_alone(name, evil[name]) == code_alone(name, plain[name]), name


def test_effects_say_what_is_no_name() -> None:
    plain = from_expression("mine", "transducer", "K*f_i", {"K": {"unit": "ug"}})
    q = plain.parameters[0]
    for change in (
        {"id": "a*/"},
        {"channels": ("a*/",)},
        {"parameters": (replace(q, name="a*/"),)},
        {"parameters": (replace(q, channel="a*/"),)},
    ):
        with pytest.raises(ValueError, match="expected a letter"):
            replace(plain, **change)


def test_no_two_names_are_one_in_code() -> None:
    names = [
        f"{a}{m}{b}"
        for a in ("a", "A", "a_", "Xa")
        for b in ("b", "0b", "1b", "")
        for m in ("-", "_", "__", "-_", "_-", "")
    ]
    names = [*dict.fromkeys(n for n in names if is_name(n))]
    ids = [id_in_code(n) for n in names]
    both = [parameter_in_code(i, n) for i in names for n in names]
    channels = [channel_in_code(n) for n in names]
    assert len({*ids}) == len(ids) and len({*both}) == len(both)
    assert len({*ids, *both, *channels}) == len(ids) + len(both) + len(channels)
    assert [channel_of(c) for c in channels] == names
    assert all(x.isidentifier() for x in (*ids, *both, *channels)) and not any("__" in i for i in ids)


def test_names_that_are_words_of_c_and_python_work_beside_each_other() -> None:
    made = [
        from_expression("a-b", "transducer", "lambda*is", {"lambda": {"unit": "ug"}}),
        from_expression("a_b", "transducer", "lambda*in", {"lambda": {"unit": "ug"}}),
        from_expression(
            "Int", "transducer", "for*int + K_*C__is", {n: {"unit": "ug"} for n in ("for", "K_")}
        ),
    ]
    own = replace(made[0], id="a--b", channels=("a-b", "a_b"), transducer=lambda i, f, p, c: i + p["lambda"] * (
        c.channel("a-b") + 10 * c.channel("a_b")))  # fmt: skip
    m = load_files(derive_model([*made, own], [*made, own]))
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
        found = ragg("export", tmp_path, tmp_path / form, f"--{form}")
        assert found.returncode == 0, found.stderr
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
    found = read_flight(tmp_path / "flight.csv", 9.8, accelerometers=parse_instrument(sheet()).layout)
    assert {*found.channels} == {*x.channels, "oil-2"}
    (note,) = (n for n in found.notes if n.startswith("skipped because of their names"))
    assert all(repr(n) in note for n in names)
    assert "remark on the flight holds text; it is left out" in found.notes
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
    made = draft_mapping(tmp_path / "flight.csv").text.replace("# c_", "c_")
    assert {"c_l_C", "c_"} <= {*parse_mapping(made, tmp_path / "mapping.toml").channels}


def test_an_output_is_no_other_column() -> None:
    for name in ("time", "a_x", "spin_angle_int", "inline", "Gamma_xx", "V_a-b"):
        with pytest.raises(UserError, match="has the name of"):
            parse_instrument(sheet(output=name))
