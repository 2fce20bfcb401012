"""Writing MATLAB 7.3: HDF5 behind a block of 512 bytes, with the attributes by which MATLAB knows its classes."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import h5py

_BLOCK = 512


def write_73(path: Path, variables: Mapping[str, Any]) -> None:
    """Write (N, 1) arrays, texts, and structures (mappings) of these."""
    import h5py  # slow to import, and only files built on HDF5 need it

    with h5py.File(path, "w", userblock_size=_BLOCK, track_order=True) as file:
        _write(file, variables)
    text = b"MATLAB 7.3 MAT-file, written by ragg HDF5 schema 1.00 ."
    with path.open("r+b") as stream:
        stream.write(text.ljust(116) + bytes(8) + struct.pack("<H", 0x0200) + b"IM")


def _write(group: h5py.Group, variables: Mapping[str, Any]) -> None:
    for name, value in variables.items():
        if isinstance(value, Mapping):
            inside = group.create_group(name, track_order=True)
            inside.attrs["MATLAB_class"] = np.bytes_("struct")
            _write(inside, value)
        elif isinstance(value, str):
            data = group.create_dataset(
                name, data=np.frombuffer(value.encode("utf-16-le"), np.uint16)[:, None]
            )
            data.attrs["MATLAB_class"] = np.bytes_("char")
            data.attrs["MATLAB_int_decode"] = np.int32(2)
        else:
            data = group.create_dataset(name, data=np.asarray(value).T)  # MATLAB counts columns first
            data.attrs["MATLAB_class"] = np.bytes_("double")
