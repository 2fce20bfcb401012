"""Lines of one file in a survey: each is a flight of its own, told apart by name, read by the survey's mapping."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ragg_runtime.flight.source import Heading, Written
from ragg_runtime.survey import journal
from ragg_runtime.survey.run import distinct_names
from ragg_runtime.survey.task import divided, examine, expanded, job
from ragg_runtime.workflow import loop
from ragg_runtime.workflow.simulate import simulated
from tests.runtime.foreign_files import write

MAPPING = '[time]\ncolumn = "T"\nunit = "s"\n[columns]\n'


def made(tmp_path: Path) -> tuple[Path, str, Path]:
    """Two simulated flights as lines of one file under other names; the mapping; model.toml."""
    m = loop.new(tmp_path / "model")
    tables, entries = [], []
    for seed in (1, 2):
        x = simulated(m.instrument, [], seed=seed, duration=120.0, rate=16.0)
        columns = {**x.channels, **x.outputs}
        names = {n: f"C{k}" for k, n in enumerate(columns)}
        entries = [f'{n} = {{ column = "{c}", unit = "{x.units[n]}" }}' for n, c in names.items()]
        rows = [(Heading("T", ""), np.asarray(x.time))]
        rows += [(Heading(names[n], ""), np.asarray(v)) for n, v in columns.items()]
        tables.append(Written(rows, str(10 * seed)))
    write(tmp_path / "s.h5", tables)
    return tmp_path / "s.h5", MAPPING + "\n".join(entries) + "\n", tmp_path / "model" / "model.toml"


def test_lines_are_flights(tmp_path: Path) -> None:
    path, text, toml = made(tmp_path)
    given = job(toml.read_text(), toml, mapping=(text, "mapping.toml", False))
    files = expanded(given, [str(path), str(tmp_path / "none.csv")])
    assert files == [f"{path}::10", f"{path}::20", str(tmp_path / "none.csv")]
    assert divided(files[0]) == (path, "10")
    record = examine(given, files[1])
    assert record["flight"] == "s.h5::20"
    assert record["verdict"] == "adequate"
    assert record["sha256"] == journal.sha256(Path(files[1])) == journal.sha256(path)
    assert "several lines" in examine(given, str(path))["error"]["message"]
    assert "no unit" in examine(job(toml.read_text(), toml), files[0])["error"]["message"]


def test_a_results_file_of_another_mapping_is_refused(tmp_path: Path) -> None:
    _, text, toml = made(tmp_path)
    plain, mapped = (job(toml.read_text(), toml, mapping=x) for x in (None, (text, "m.toml", False)))
    assert "mapping" not in journal.head(plain)
    assert (
        journal.head(mapped)["mapping"]
        != journal.head(job(toml.read_text(), toml, mapping=("", "m", True)))["mapping"]
    )


def test_flights_of_one_file_name_are_told_apart_by_their_folders() -> None:
    files = ["/s/01/flight.csv", "/s/02/flight.csv", "/t/02/flight.csv", "/s/other.csv", "/none/s.csv::20"]
    assert distinct_names(files) == dict(
        zip(
            files,
            ["01/flight.csv", "s/02/flight.csv", "t/02/flight.csv", "other.csv", "s.csv::20"],
            strict=True,
        )
    )
    many = [f"/s/{n}/flight.csv" for n in range(3000)]
    assert distinct_names(many)[many[7]] == "7/flight.csv"
