"""Every bad input of the table: exit status, one message with its facts, nothing changed."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from bad_input_table import TABLE, blank, flown, inside, motion, outputs, ran, stage, struck

from ragg_runtime import api

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


@pytest.mark.usefixtures("no_next_motion")
def test_the_hidden_effect_is_found_beside_spikes_and_blanks(tmp_path: Path) -> None:
    """Spikes in one sample of a hundred, and gaps in the motion alone."""
    stage(tmp_path)
    with inside(tmp_path):
        flown(lambda x: motion(blank)(outputs(struck)(x)), "flight.parquet", hidden=True, derived=True)()
        m = api.load("model")
        d = api.diagnose(m, api.read_flights(m, ["flight.parquet"]))
    assert (d.verdict, d.found) == ("missing-effect", ("thermal-scale",))
    assert d.after.rms_Eo == pytest.approx(4.04, rel=0.02)  # the noise, as on the clean record
    value = {p.accelerometer: p.value for p in d.ranking[0].parameters}
    assert value[3] - value[4] == pytest.approx(2e-7, rel=0.02)  # what G_out sees of A3 and A4
