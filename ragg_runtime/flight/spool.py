"""Flights too long for memory: their columns on disk, seen through memory maps that are let go of after use."""

from __future__ import annotations

import mmap
import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pyarrow as pa

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.memory import give_back
from ragg_runtime.flight.record import Array, Flight, Mask

NOTES = 12
"""Most notes that are kept of the parts of a flight."""


def spooled(parts: Iterable[Flight], path: Path, most: int) -> Flight:
    """The flight that consecutive parts make up, its columns in files that vanish with the process.

    Raises
    ------
    UserError
        If they take more than ``most`` bytes, or half of what is free on the disk of the temporary folder.
    """
    folder = Path(tempfile.mkdtemp(prefix="ragg-"))
    try:
        room = shutil.disk_usage(folder).free // 2
        files: dict[str, list[str]] = {}
        notes: dict[str, None] = {}
        first: Flight | None = None
        written = 0
        handles = {}
        try:
            for part in parts:
                if first is None:
                    first = part
                    files = {
                        "channels": list(part.channels),
                        "outputs": list(part.outputs),
                        "own": ["time", "valid"],
                    }
                    names = [f"{group}.{n}" for group, members in files.items() for n in members]
                    handles = {n: (folder / str(k)).open("wb") for k, n in enumerate(names)}
                for group, values in (("channels", part.channels), ("outputs", part.outputs)):
                    for n in files[group]:
                        handles[f"{group}.{n}"].write(np.ascontiguousarray(values[n]).data)
                handles["own.time"].write(np.ascontiguousarray(part.time).data)
                handles["own.valid"].write(np.ascontiguousarray(part.valid).data)
                notes |= dict.fromkeys(part.notes)
                written += part.time.nbytes * len(handles)
                if written > most:
                    raise _endless(path, most, len(handles))
                if written > room:
                    raise _no_room(path, folder)
        except OSError as error:
            raise _no_room(path, folder, error.strerror) from None
        finally:
            for h in handles.values():
                h.close()
        assert first is not None  # a file without rows is refused before
        places = {n: folder / str(k) for k, n in enumerate(handles)}
        valid: Mask = np.memmap(places.pop("own.valid"), dtype=np.bool_, mode="r")
        found: dict[str, Array] = {n: np.memmap(p, dtype=np.float64, mode="r") for n, p in places.items()}
    finally:
        shutil.rmtree(folder)  # what is mapped stays until it is let go
    told = list(notes)
    if len(told) > NOTES:
        told = [*told[:NOTES], f"and {len(told) - NOTES} further notes of this kind"]
    return Flight(
        time=found["own.time"],
        channels={n: found[f"channels.{n}"] for n in files["channels"]},
        outputs={n: found[f"outputs.{n}"] for n in files["outputs"]},
        name=first.name,
        path=first.path,
        digest=first.digest,
        notes=tuple(told),
        valid=valid,
        units=first.units,
    )


def settled(flight: Flight) -> Flight:
    """The flight, once it has been read and examined: what that has left of the memory is given back."""
    let_go(flight.time, flight.valid, *flight.channels.values(), *flight.outputs.values())
    pa.default_memory_pool().release_unused()
    give_back()
    return flight


def let_go(*arrays: Array | Mask) -> None:
    """Let the pages of mapped columns out of memory; of arrays in memory nothing changes."""
    for x in arrays:
        base: object = x
        while isinstance(base, np.ndarray) and not isinstance(base, np.memmap):
            base = base.base
        held = getattr(base, "_mmap", None)
        if held is not None and hasattr(mmap, "MADV_DONTNEED"):
            held.madvise(mmap.MADV_DONTNEED)


def _endless(path: Path, most: int, columns: int) -> UserError:
    return UserError(
        "the flight is too long",
        where=path,
        found=f"more than {most // 8 // columns} rows in {path.stat().st_size / 1e9:.3g} GB on disk",
        expected=f"at most {most // 8 // columns} rows of {columns} columns",
        remedy="cut it into several files of one instrument; ragg diagnose and add take them together",
    )


def _no_room(path: Path, folder: Path, reason: str | None = None) -> UserError:
    return UserError(
        "the flight is too long for memory, and the disk has too little room to lay its columns down",
        where=path,
        found=reason or f"{shutil.disk_usage(folder.parent).free / 1e9:.3g} GB free in {folder.parent}",
        expected="twice the size of the columns in float64",
        remedy="name another folder in the environment variable TMPDIR, or cut the file into several",
    )
