"""Does the HDF5 library come through a file at all?

A damaged file can lead it in circles for ever, or end the process (a heap of variable-length attributes whose entries have no
size, for one). So its tables, not its data, are read in a child first, which says after each object that it lives.
"""

from __future__ import annotations

import contextlib
import os
import select
import signal
from collections.abc import Callable
from pathlib import Path

import h5py

from ragg_runtime.base.errors import UserError

PATIENCE = 8.0
"""Seconds that one object may take, whose tables are some kilobytes."""


def refuse_endless(path: Path, wrong: Callable[[Path], object]) -> None:
    """UserError if the tables of the file cannot be read to their end; systems that cannot fork do without.

    Where ``wrong`` finds something in the file, which its reader will find again, nothing more of it is touched.
    """
    if not hasattr(os, "fork"):
        return
    ear, mouth = os.pipe()
    child = os.fork()
    if child == 0:
        with contextlib.suppress(BaseException):  # what is merely wrong, its reader says in words
            if not wrong(path):
                _visit(path, lambda: os.write(mouth, b"."))
        os._exit(0)
    os.close(mouth)
    try:
        while True:
            if not select.select([ear], [], [], PATIENCE)[0]:
                os.kill(child, signal.SIGKILL)
                break
            if not os.read(ear, 1 << 16):  # its end of the pipe is closed: it ends
                break
        _, status = os.waitpid(child, 0)
    finally:
        os.close(ear)
    if status != 0:
        raise UserError(
            "the file is damaged: its tables cannot be read to their end",
            where=path,
            expected="an HDF5 or NetCDF file as it was written",
            remedy="copy it again from where it was recorded",
        )


def _visit(path: Path, lives: Callable[[], object]) -> None:
    """Attributes and dimensions of everything in the file."""

    def look(_: str, thing: h5py.Group | h5py.Dataset) -> None:
        lives()
        with contextlib.suppress(OSError, ValueError, TypeError, KeyError, RuntimeError):
            dict(thing.attrs)
        if isinstance(thing, h5py.Dataset):
            with contextlib.suppress(OSError, ValueError, TypeError, KeyError, RuntimeError):
                [len(d) for d in thing.dims]

    with h5py.File(path, "r") as file:
        look("", file)
        file.visititems(look)
