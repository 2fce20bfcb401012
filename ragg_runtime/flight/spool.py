"""Flights too long for memory: their columns on disk, seen through memory maps that are let go of after use."""

from __future__ import annotations

import contextlib
import math
import mmap
import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import IO

import numpy as np
import pyarrow as pa

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import take_room
from ragg_runtime.base.process import give_back
from ragg_runtime.flight.record import Array, Flight, Mask

COPIED = 1 << 20
"""Samples of a column that are copied at a time."""

NOTES = 12
"""Most notes that are kept of the parts of a flight."""


def spooled(parts: Iterable[Flight], path: Path, most: int) -> Flight:
    """The flight that consecutive parts make up, its columns in files without a name, which vanish with the process.

    Raises
    ------
    UserError
        If they take more than ``most`` bytes, or half of what is free on the disk of the temporary folder.
    """
    folder = Path(tempfile.gettempdir())
    room = shutil.disk_usage(folder).free // 2
    names: list[tuple[str, str]] = []
    notes: dict[str, None] = {}
    first: Flight | None = None
    written = 0
    with contextlib.ExitStack() as stack:
        handles: list[IO[bytes]] = []
        try:
            for part in parts:
                if first is None:
                    first = part
                    names = [("channels", n) for n in part.channels] + [("outputs", n) for n in part.outputs]
                    names += [("own", "time"), ("own", "valid")]
                    # Files without a name: however the process ends, nothing is left of them.
                    handles = [stack.enter_context(tempfile.TemporaryFile(dir=folder)) for _ in names]
                own = {"time": part.time, "valid": part.valid}
                groups = {"channels": part.channels, "outputs": part.outputs, "own": own}
                for (group, n), handle in zip(names, handles, strict=True):
                    handle.write(np.ascontiguousarray(groups[group][n]).data)
                notes |= dict.fromkeys(part.notes)
                written += part.time.nbytes * len(handles)
                if written > most:
                    raise _endless(path, most, len(handles))
                if written > room:
                    raise _no_room(path, folder)
            for h in handles:
                h.flush()
        except OSError as error:
            raise _no_room(path, folder, error.strerror) from None
        assert first is not None  # a file without rows is refused before
        # What is mapped stays until it is let go, though the file is closed.
        maps = dict(zip(names, handles, strict=True))
        valid: Mask = np.memmap(maps.pop(("own", "valid")), np.bool_, mode="r")
        mapped: dict[tuple[str, str], Array] = {
            k: np.memmap(h, np.float64, mode="r") for k, h in maps.items()
        }
    said = list(notes)
    if len(said) > NOTES:
        said = [*said[:NOTES], f"and {len(said) - NOTES} further notes of this kind"]
    return Flight(
        time=mapped["own", "time"],
        channels={n: x for (group, n), x in mapped.items() if group == "channels"},
        outputs={n: x for (group, n), x in mapped.items() if group == "outputs"},
        name=first.name,
        path=first.path,
        digest=first.digest,
        notes=tuple(said),
        valid=valid,
        units=first.units,
        written=first.written,
    )


def room_like(x: Array, shape: tuple[int, ...]) -> Array:
    """An array to be filled, float64: in a file without a name where ``x`` is mapped, else in memory.

    Raises
    ------
    UserError
        If the disk has no room for it.
    """
    if not _mapping(x):
        return np.empty(shape)
    with tempfile.TemporaryFile() as file:
        try:  # a full disk says so here, not by a signal where the array is filled
            take_room(file, 8 * math.prod(shape))
        except OSError as error:
            raise _no_room(None, Path(tempfile.gettempdir()), error.strerror) from None
        return np.memmap(file, np.float64, mode="w+", shape=shape)


def copied(x: Array) -> Array:
    """A copy that can be written to, kept where :func:`room_like` says."""
    found = room_like(x, x.shape)
    for start in range(0, len(x), COPIED):
        found[start : start + COPIED] = x[start : start + COPIED]
        let_go(found, x)
    return found


def settled(flight: Flight) -> Flight:
    """The flight, once it has been read and examined: what that has left of the memory is given back."""
    let_go(flight.time, flight.valid, *flight.channels.values(), *flight.outputs.values())
    pa.default_memory_pool().release_unused()
    give_back()
    return flight


def let_go(*arrays: Array | Mask) -> None:
    """Let the pages of mapped columns out of memory; of arrays in memory nothing changes."""
    for x in arrays:
        held = _mapping(x)
        if held is not None and hasattr(mmap, "MADV_DONTNEED"):
            held.madvise(mmap.MADV_DONTNEED)


def _mapping(x: Array | Mask) -> mmap.mmap | None:
    """What maps an array's file, if it lies in one."""
    base: object = x
    while isinstance(base, np.ndarray) and not isinstance(base, np.memmap):
        base = base.base
    return getattr(base, "_mmap", None)


def _endless(path: Path, most: int, columns: int) -> UserError:
    return UserError(
        "the flight is too long",
        where=path,
        found=f"more than {most // 8 // columns} rows in {path.stat().st_size / 1e9:.3g} GB on disk",
        expected=f"at most {most // 8 // columns} rows of {columns} columns",
        remedy="cut it into several files of one instrument; ragg diagnose and add take them together",
    )


def _no_room(path: Path | None, folder: Path, reason: str | None = None) -> UserError:
    return UserError(
        "the flight is too long for memory, and the disk has too little room to lay its columns down",
        where=path,
        found=reason or f"{shutil.disk_usage(folder).free / 1e9:.3g} GB free in {folder}",
        expected="twice the size of the columns in float64",
        remedy="name another folder in the environment variable TMPDIR, or cut the file into several",
    )
