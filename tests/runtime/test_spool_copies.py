"""What is made of a flight's mapped columns lies on disk, too, with the same numbers."""

from __future__ import annotations

import tempfile

import numpy as np
import pytest

from ragg_runtime.flight import spool
from ragg_runtime.plausibility.spikes import glitches


def test_copies_lie_where_their_columns_lie(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spool, "COPIED", 1000)
    t = np.arange(50_000.0)
    x = np.sin(t / 30.0)
    x[20_000] += 3.0
    with tempfile.TemporaryFile() as file:
        mapped = np.memmap(file, np.float64, mode="w+", shape=x.shape)
    mapped[:] = x
    there = np.ones(len(x), dtype=np.bool_)
    in_memory, on_disk = (glitches(y, there, part=4096) for y in (x, mapped))
    assert np.flatnonzero(on_disk[0]).tolist() == [20_000]
    np.testing.assert_array_equal(on_disk[0], in_memory[0])
    np.testing.assert_array_equal(on_disk[1], in_memory[1])
    assert isinstance(on_disk[1], np.memmap)
    assert not isinstance(in_memory[1], np.memmap)
    assert mapped[20_000] == x[20_000]  # the column itself is left as it was
    assert spool.room_like(mapped, (2, 7)).shape == (2, 7)
