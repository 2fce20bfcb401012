"""What is made of a flight's mapped columns lies on disk, too, with the same numbers."""

from __future__ import annotations

import errno
import os
import tempfile

import numpy as np
import pytest

from ragg_runtime.base.errors import UserError
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


@pytest.mark.skipif(not hasattr(os, "posix_fallocate"), reason="no such system call")
def test_a_full_disk_is_said_before_anything_is_filled(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with tempfile.TemporaryFile() as file:
        mapped = np.memmap(file, np.float64, mode="w+", shape=(10,))
    monkeypatch.setattr(os, "posix_fallocate", full)
    with pytest.raises(UserError, match="too little room"):
        spool.room_like(mapped, (10,))
