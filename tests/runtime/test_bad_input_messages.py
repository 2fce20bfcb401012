"""Every bad input of the table: exit status, one message with its facts, nothing changed."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from bad_input_table import TABLE, ran


@pytest.mark.parametrize("name", TABLE)
def test_bad_input(name: str, tmp_path: Path) -> None:
    row = TABLE[name]
    r = ran(row, tmp_path)
    assert r.status == row.status, r.out + r.err
    said = r.message if row.status else r.out
    for fact in row.says:
        assert fact in said, f"{fact!r} is not in: {said}"
    assert "Traceback" not in r.out + r.err
    assert r.before == r.after
    if row.status:
        assert r.out == ""
        assert len(re.findall(r"^(ragg: |Usage: )", r.message, re.MULTILINE)) == 1, r.message
        assert len(r.message) < 3000
