"""Compensated series in a file, written as they come: CSV, Parquet or NetCDF-4 by the ending of its name."""

from __future__ import annotations

import contextlib
import gzip
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import IO, Any

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import replacing, require_room
from ragg_runtime.compensation.compensate import Compensated
from ragg_runtime.compensation.series import Series
from ragg_runtime.flight.netcdf_file import room
from ragg_runtime.flight.record import DEMODULATED
from ragg_runtime.instrument.layout import column_endings
from ragg_runtime.signals.tensor import COMPONENTS, Tensor, tensor

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Table:
    """The columns of one flight, by its outputs that see a gradient.

    Of an instrument with one output they are ``inline``, ``cross``, their standard uncertainties and ``quality``; with
    several each has the output's own ending (``inline_A`` of ``G_out_A``). Three discs add the tensor and ``closure``.

    Attributes
    ----------
    endings
        Of every output; empty of an only one.
    tensor
        (6 + checks, 2 outputs): the tensor's components and the closure, by the channels; ``None``: not determined.
    several
        Whether there are several flights: then ``flight`` counts them from 1.
    """

    endings: tuple[str, ...]
    tensor: Array | None
    several: bool

    @staticmethod
    def of(outputs: Sequence[Compensated], *, several: bool) -> Table:
        layout = outputs[0].instrument.layout
        known = dict(zip(layout.output_names, column_endings(layout.output_names), strict=True))
        endings = tuple(known[x.setting.observation.output.name] for x in outputs)
        return Table(endings=endings, tensor=_by_channels(outputs), several=several)

    @property
    def units(self) -> dict[str, str]:
        """Columns and their units, in order."""
        found = {"time": "s"}
        for end in self.endings:
            found |= {f"{c}{end}": "Eo" for c in DEMODULATED}
            found |= {f"{c}{end}_std": "Eo" for c in DEMODULATED}
            found[f"quality{end}"] = "1"
        if self.tensor is not None:
            found |= {f"Gamma_{c}": "Eo" for c in COMPONENTS} | {f"Gamma_{c}_std": "Eo" for c in COMPONENTS}
            found |= dict.fromkeys(self._checks, "1")
        return found | ({"flight": "1"} if self.several else {})

    @property
    def _checks(self) -> list[str]:
        count = 0 if self.tensor is None else len(self.tensor) - len(COMPONENTS)
        return ["closure"] if count == 1 else [f"closure_{k + 1}" for k in range(count)]

    def rows(self, time: Array, parts: Sequence[Series], number: int) -> dict[str, NDArray[np.generic]]:
        """The columns of one segment: ``time`` (n,) s, a series of each output, and the number of the flight."""
        found: dict[str, NDArray[np.generic]] = {"time": time}
        for end, x in zip(self.endings, parts, strict=True):
            found |= {f"inline{end}": x.gradient.real, f"cross{end}": x.gradient.imag}
            found |= {f"inline{end}_std": x.std[0], f"cross{end}_std": x.std[1], f"quality{end}": x.quality}
        if self.tensor is not None:
            seen = np.concatenate([[x.gradient.real, x.gradient.imag] for x in parts])
            std = np.concatenate([x.std for x in parts])
            values = self.tensor @ seen
            spread = np.sqrt(self.tensor[: len(COMPONENTS)] ** 2 @ std**2)
            for k, c in enumerate(COMPONENTS):
                found |= {f"Gamma_{c}": values[k], f"Gamma_{c}_std": spread[k]}
            found |= dict(zip(self._checks, values[len(COMPONENTS) :], strict=True))
        return found | {"flight": np.full(len(time), number, dtype=np.int64)}


def _by_channels(outputs: Sequence[Compensated]) -> Array | None:
    """The tensor and its closure by the channels; ``None`` where the outputs do not determine it."""
    layout = outputs[0].instrument.layout
    observed = [x.setting.observation for x in outputs]
    axes = [layout.discs[o.output.disc].across for o in observed]
    std = np.array([s for x in outputs for s in x.setting.noise])
    try:
        found: Tensor = tensor(axes, np.eye(2 * len(outputs)), std)
    except UserError:
        return None
    return np.concatenate([found.gamma, found.closure])


def joined(
    parts: Sequence[Mapping[str, NDArray[np.generic]]], names: Sequence[str]
) -> dict[str, NDArray[np.generic]]:
    """The columns of all segments."""
    return {n: np.concatenate([r[n] for r in parts]) for n in names}


ENDINGS: Mapping[str, str] = MappingProxyType(
    {
        ".csv": "csv",
        ".csv.gz": "csv",
        ".parquet": "parquet",
        ".pq": "parquet",
        ".nc": "netcdf",
        ".nc4": "netcdf",
    }
)
"""Endings of file names, and the formats that they stand for."""

PAGE = 1 << 15
"""Rows of a column that are encoded at a time: those of a segment."""

Rows = Mapping[str, NDArray[Any]]
Write = Callable[[Rows], None]


@contextlib.contextmanager
def writing(path: Path, samples: int, units: Mapping[str, str]) -> Iterator[Write]:
    """A function that takes columns of successive rows; the file appears whole or not at all.

    ``samples`` is the number of all rows; ``units`` names the columns, in order, and their units.
    """
    kind = format_for(path)
    schema = pa.schema([pa.field(n, _type(n), metadata={"units": unit}) for n, unit in units.items()])
    with replacing(path) as temporary:
        if kind == "parquet":
            with _parquet(temporary, schema) as writer:
                yield lambda rows: writer.write_table(_table(rows, schema))
        elif kind == "csv":
            with _text(temporary, path.name.lower().endswith(".gz")) as stream:
                stream.write((",".join(f"{n} [{unit}]" for n, unit in units.items()) + "\n").encode())
                options = pyarrow.csv.WriteOptions(include_header=False)
                yield lambda rows: pyarrow.csv.write_csv(_table(rows, schema), stream, options)
        else:
            with _netcdf(temporary, units, samples) as write:
                yield write


def format_for(path: Path) -> str:
    """``csv``, ``parquet`` or ``netcdf`` by the ending of the name; UserError for any other."""
    found = next((kind for ending, kind in ENDINGS.items() if path.name.lower().endswith(ending)), None)
    if found is None:
        raise UserError(
            "a compensated series is not written in this format",
            where=path,
            found=path.suffix or "no ending",
            expected=", ".join(ENDINGS),
            remedy="choose one of these; `ragg convert` writes others",
        )
    return found


def _is_whole(name: str) -> bool:
    return name == "flight" or name.partition("_")[0] == "quality"


def _type(name: str) -> pa.DataType:
    return pa.int64() if _is_whole(name) else pa.float64()


def _parquet(path: Path, schema: pa.Schema) -> pq.ParquetWriter:
    """A writer that spends no time where nothing is to be gained: the digits of measured values have nothing in common, and
    whoever looks for rows looks for them by their time.
    """
    alike = [n for n in schema.names if _is_whole(n) or n == "time"]
    return pq.ParquetWriter(
        path,
        schema,
        compression={n: "snappy" if n in alike else "none" for n in schema.names},
        use_dictionary=[n for n in alike if _is_whole(n)],
        write_statistics=["time"],
        write_batch_size=PAGE,
    )


def _table(rows: Rows, schema: pa.Schema) -> pa.Table:
    return pa.Table.from_arrays([_array(rows[f.name], f.type) for f in schema], schema=schema)


def _array(values: NDArray[Any], kind: pa.DataType) -> pa.Array:
    """A column without a copy; NaN is missing. (``pa.array`` would import pandas to look whether it is a series.)"""
    x = np.ascontiguousarray(values, dtype=kind.to_pandas_dtype())
    missing = np.isnan(x)
    there = pa.py_buffer(np.packbits(~missing, bitorder="little")) if missing.any() else None
    return pa.Array.from_buffers(kind, len(x), [there, pa.py_buffer(x)])


@contextlib.contextmanager
def _text(path: Path, compressed: bool) -> Iterator[IO[bytes]]:
    with path.open("wb") as raw:
        if not compressed:
            yield raw
            return
        with gzip.GzipFile("", "wb", 6, raw, mtime=0) as stream:  # equal series give equal files
            yield stream  # type: ignore[misc]


@contextlib.contextmanager
def _netcdf(path: Path, units: Mapping[str, str], samples: int) -> Iterator[Write]:
    import h5netcdf  # slow to import, and only this format needs it

    require_room(path, room([samples] * len(units)))
    with h5netcdf.File(path, "w") as file:
        file.dimensions = {"time": samples}
        for n, unit in units.items():
            variable = file.create_variable(n, ("time",), np.int64 if _is_whole(n) else np.float64)
            variable.attrs["units"] = unit
        done = 0

        def write(rows: Rows) -> None:
            nonlocal done
            count = len(rows["time"])
            for n in units:
                file.variables[n][done : done + count] = rows[n]
            done += count

        yield write
