"""The reference pages hold what the code reads and writes; each command's JSON is held against its page in ``commands.ragg``."""

from __future__ import annotations

import re
from pathlib import Path

import click
import pyarrow.parquet as pq
import pytest
from commands import ragg

from docs import made
from ragg_runtime.base.errors import UserError
from ragg_runtime.cli.main import COMMANDS, cli
from ragg_runtime.instrument.read_toml import parse_instrument

DISC = '[disc]\nradius = "0.1 m"\nspin_frequency = "0.25 Hz"\ng0 = "9.8 m/s^2"\n'
DISCS = '[[disc]]\nspin_frequency = "0.25 Hz"\n'
LAST = '[accelerometers]\nK1 = "10 mA/g"\nk_VI = "1e9 ohm"\n'
WITH_AN_UNKNOWN_KEY = {
    "Top level": "odd = 1",
    "[model]": "[model]\nodd = 1",
    "[model], order": "[model]\norder = { odd = 1 }",
    "[disc]": "[disc]\nodd = 1",
    "[[disc]]": f"{DISCS}odd = 1\n{LAST}",
    "[[disc.accelerometer]]": f"{DISCS}[[disc.accelerometer]]\nodd = 1\n{LAST}",
    "[accelerometers]": f"{DISC}[accelerometers]\nodd = 1",
    "[demodulator]": f"[demodulator]\nodd = 1\n{DISC}{LAST}",
}
"""Section of the page -> a model.toml that is refused, with the keys that are known there."""


@pytest.mark.parametrize("title", WITH_AN_UNKNOWN_KEY)
def test_the_page_of_model_toml_has_every_key_that_is_read_and_no_other(title: str) -> None:
    with pytest.raises(UserError, match="unknown key 'odd'") as refused:
        parse_instrument(WITH_AN_UNKNOWN_KEY[title])
    assert refused.value.expected is not None
    known = set(str(refused.value.expected).removeprefix("one of ").split(", "))
    name, _, table = title.partition(", ")
    page = made.model_toml()
    listed = set(
        re.findall(r"^\| `([\w.]+)` ", page.split(f"## {name}\n", 1)[1].split("\n## ", 1)[0], re.MULTILINE)
    )
    if table:
        listed = {k.removeprefix(f"{table}.") for k in listed if k.startswith(f"{table}.")}
    elif name == "Top level":
        listed |= {t.strip("[]") for t in re.findall(r"^## (\[\w+\])$", page, re.MULTILINE)}
    else:
        listed = {k for k in listed if "." not in k}
    assert listed == known


def test_the_page_of_json_has_every_command_that_writes_any() -> None:
    shown = {line.split()[0] for line in made.LINES} | {"compare", "diagnose", "add"}
    context = click.Context(cli)
    commands = {name: cli.get_command(context, name) for name in COMMANDS}
    assert {n for n, c in commands.items() if c and any(p.name == "json_file" for p in c.params)} == shown


def test_a_key_without_a_meaning_is_an_error() -> None:
    with pytest.raises(KeyError, match="odd of compare"):
        made.meaning("compare", "error.odd", made.read_meanings())


def test_the_json_of_commands_that_fit_nothing_has_meanings(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of the others the tests of these commands: ``commands.ragg`` looks up every key."""
    monkeypatch.chdir(tmp_path)
    pq.write_table(pq.read_table(made.FLIGHT).slice(0, 960), "flight.parquet")
    for line in (
        "new model",
        "effects",
        "effects lag",
        "info flight.parquet",
        "convert flight.parquet flight.csv",
        "simulate model -o simulated.parquet --duration 60",
        "add model bias-drift",
        "history model",
        "remove model bias-drift",
    ):
        done = ragg(*line.split(), "--json", "written.json")
        assert done.returncode == 0, line + done.stderr
