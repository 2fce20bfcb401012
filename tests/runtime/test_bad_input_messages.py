"""Every bad input of the table: exit status, one message with its facts, nothing changed."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from bad_input_table import (
    TABLE,
    blank,
    flown,
    inside,
    jittered,
    kept,
    motion,
    outputs,
    ran,
    stage,
    struck,
    timed,
)

from ragg_runtime import api
from ragg_runtime.io import Flight

pytestmark = pytest.mark.usefixtures("no_next_motion")


@pytest.mark.parametrize("name", TABLE)
def test_bad_input(name: str, tmp_path: Path) -> None:
    row = TABLE[name]
    r = ran(row, tmp_path)
    assert r.status == row.status, r.out + r.err
    said = r.message if row.status else r.out
    for fact in row.says:
        assert fact in said, f"{fact!r} is not in: {said}"
    assert "Traceback" not in r.out + r.err
    assert r.unchanged
    if row.status:
        assert r.out == ""
        assert len(re.findall(r"^(ragg: |Usage: )", r.message, re.MULTILINE)) == 1, r.message
        assert len(r.message) < 3000


AWKWARD: dict[str, Callable[[Flight], Flight]] = {
    "1 % spikes, blanks in the motion": lambda x: motion(blank)(outputs(struck)(x)),
    "gaps, and jittering stamps": lambda x: timed(jittered(0.2))(kept(lambda k: k[k // 100 % 12 != 5])(x)),
}


@pytest.mark.parametrize("name", sorted(AWKWARD))
def test_the_hidden_effect_is_found_all_the_same(name: str, tmp_path: Path) -> None:
    stage(tmp_path)
    with inside(tmp_path):
        flown(AWKWARD[name], "flight.parquet", hidden=True, derived=True)()
        m = api.load("model")
        d = api.diagnose(m, api.read_flights(m, ["flight.parquet"]))
    assert (d.verdict, d.found) == ("missing-effect", ("thermal-scale",))
    assert d.after.rms_Eo == pytest.approx(4.04, rel=0.02)  # the noise, as on the clean record
    value = {p.accelerometer: p.value for p in d.ranking[0].parameters}
    assert value[3] - value[4] == pytest.approx(2e-7, rel=0.02)  # what G_out sees of A3 and A4
