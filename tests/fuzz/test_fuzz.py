"""A short run over every reader; ``make fuzz`` runs the long one."""

from __future__ import annotations

import itertools
import sys
import warnings

import pytest

from .mutate import mutants
from .seeds import corpus, make
from .targets import TARGETS

EXECUTIONS = {
    "expression": 3000,
    "model_toml": 1500,
    "edited_toml": 500,
    "mapping": 500,
    "history": 500,
    "unfinished": 500,
    "calibration": 500,
    "flight_csv": 800,
    "flight_parquet": 500,
    "flight_netcdf": 30,
    "generated_model": 3,
}


@pytest.mark.parametrize("name", list(TARGETS))
def test_the_corpus(name: str) -> None:
    """What was found once is not found again; what is well formed is read."""
    for file, data in corpus(name).items():
        outcome = TARGETS[name](data)
        if file.startswith("seed-"):
            assert outcome == "read", file


@pytest.mark.parametrize("name", list(TARGETS))
def test_mutants(name: str) -> None:
    outcomes = {"read": 0, "refused": 0}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for data in itertools.islice(mutants(list(corpus(name).values()), 20240501), EXECUTIONS[name]):
            try:
                outcomes[TARGETS[name](data)] += 1
            except Exception as error:
                error.add_note(f"the input: {data[:2000]!r}")
                raise
    assert outcomes["read"] > 0, "the mutations leave nothing whole: the fuzzer tests nothing"
    if name != "generated_model":  # drawn from the grammar: most are well formed
        assert outcomes["refused"] > 0


def test_the_seeds_are_what_the_program_writes() -> None:
    for name, files in make().items():
        for file, data in files.items():
            if name not in ("flight_parquet", "flight_netcdf"):  # these name the library's version
                assert corpus(name)[file] == data or sys.platform == "win32"
