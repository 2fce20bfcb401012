"""MATLAB flights, version 5 to 7.3: vectors, or structures of vectors (several alike are lines); units in a structure ``units``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.io import hdf5_file
from ragg_runtime.io.hdf5_file import Place, places
from ragg_runtime.io.source import Heading, Look, Rows, Table, chosen, distinct, heading

if TYPE_CHECKING:
    import h5py

NAME = "MATLAB"
ENDINGS = (".mat",)
MAGIC = (b"MATLAB 5", b"MATLAB 7", *hdf5_file.MAGIC)


def open_tables(path: Path, look: Look) -> Sequence[Table]:
    """The tables of a MATLAB file."""
    with path.open("rb") as stream:
        head = stream.read(10)
    if head.startswith((b"MATLAB 7.3", hdf5_file.MAGIC[0][:8])):
        return hdf5_file.tables_of(path, look, _unit_73)
    return chosen(path, list(_structures(_loaded(path), look, path)), look)


def _structures(variables: Mapping[str, Any], look: Look, path: Path) -> Iterator[Table]:
    waiting: list[tuple[str, Mapping[str, Any]]] = [("", variables)]
    while waiting:
        place, inside = waiting.pop(0)
        arrays: dict[str, NDArray[Any]] = {}
        for name, value in inside.items():
            if name in ("units", "names"):
                continue
            if isinstance(value, np.ndarray) and value.dtype.names is not None:
                parts = value.ravel()
                for k, element in enumerate(parts, 1):
                    fields = {n: element[n] for n in value.dtype.names}
                    own = _word(fields.get("line"))
                    label = own or (name if len(parts) == 1 else f"{name}_{k}")
                    waiting.append((f"{place}/{label}" if place else label, fields))
            elif isinstance(value, np.ndarray) and (values := _vector(value)) is not None:
                arrays[name] = values
        yield _structure(place, inside, arrays, look, path)


def _structure(
    place: str, inside: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]], look: Look, path: Path
) -> Table:
    """A structure of vectors as a table; where it stands is the name of its line."""
    units, names = _fields(inside.get("units")), _fields(inside.get("names"))
    if look.only is not None:
        wanted = look.only | {n.rsplit("_", 1)[0] for n in look.only}
        arrays = {n: v for n, v in arrays.items() if n in wanted or names.get(n) in wanted}
    arrays = {n: v for n, v in arrays.items() if v.dtype.kind in "fiub" or look.allows_text(n)}
    found = places({n: v.shape for n, v in arrays.items()}, f"{path}: {place or 'variables'}")
    columns = []
    for number, p in enumerate(found, 1):
        h = heading(names.get(p.column, p.column), path, number)
        if look.wants(h.name):
            text = arrays[p.array].dtype.kind == "O"
            unit = units.get(p.column) or units.get(p.array) or h.unit
            columns.append((Heading(h.name, unit, text), p))
    headings = distinct(path, [h for h, _ in columns])
    return Table(path, headings, partial(_rows, columns, arrays), place, place)


def _rows(columns: Sequence[tuple[Heading, Place]], arrays: Mapping[str, NDArray[Any]]) -> Rows:
    found: dict[str, NDArray[Any]] = {}
    for h, p in columns:
        values = p.of(arrays[p.array])
        found[h.name] = values if h.text else values.astype(np.float64)
    return found


def _vector(value: NDArray[Any]) -> NDArray[Any] | None:
    """An array of numbers, or of texts (object), or ``None``."""
    if value.dtype.kind in "fiub":
        return value if value.size > 1 else None
    if value.dtype.kind == "U" and value.size > 1:
        return np.array([t.strip() for t in value.ravel()], dtype=object)
    if value.dtype.kind == "O" and value.size > 1:  # a cell array
        words = [_word(v) for v in value.ravel()]
        return np.array(words, dtype=object) if any(words) else None
    return None


def _word(value: Any) -> str:
    """The text that a variable holds; ``""`` if it is none."""
    while isinstance(value, np.ndarray) and value.size == 1:
        value = value.ravel()[0]
    return str(value).strip() if isinstance(value, str) else ""


def _fields(value: Any) -> dict[str, str]:
    """Texts in the fields of a structure."""
    if not (isinstance(value, np.ndarray) and value.dtype.names is not None and value.size == 1):
        return {}
    element = value.ravel()[0]
    return {n: _word(element[n]) for n in value.dtype.names if _word(element[n])}


def _loaded(path: Path) -> dict[str, Any]:
    from scipy.io import loadmat  # slow to import, and only this format needs it

    try:
        found = loadmat(path, mat_dtype=False, chars_as_strings=True)
    except Exception as error:  # SciPy raises what it comes upon
        raise UserError(
            "the MATLAB file is damaged",
            where=path,
            found=(str(error) or type(error).__name__).split("\n", 1)[0][:200],
            expected="a whole MAT-file, version 5 to 7.3",
            remedy="copy it again, or save it again: save('flight.mat', '-v7')",
        ) from None
    return {n: v for n, v in found.items() if not n.startswith("__")}


def _unit_73(data: h5py.Dataset) -> str:
    """The unit of a dataset in a MATLAB 7.3 file: in the structure ``units`` beside it."""
    import h5py  # slow to import, and only files built on HDF5 need it

    units = data.parent.get("units")
    name = data.name.rsplit("/", 1)[-1]
    text = hdf5_file.matlab_text(units.get(name)) if isinstance(units, h5py.Group) else ""
    return text or hdf5_file.unit_of(data)
