"""Tables: columns with names and units as files have them, their cells and headings, and the flight lines among them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Container, Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.instrument.instrument import Demodulation
from ragg_runtime.instrument.units import units
from ragg_runtime.io.record import SI_UNITS, Array, Mask

INDEX = "index"  # name of a column that labels the rows and has none
SHARE = 0.5  # of the free memory that a table may take: reading and fitting it take as much again

_WORDS = (
    "nan NaN NAN NaT NA N/A n/a n.a. <NA> null NULL None -nan nan(ind) -nan(ind) inf -inf Inf -Inf INF -INF"
)
_OF_C = tuple(f"{sign}1.#{word}" for sign in ("", "-") for word in ("IND", "QNAN", "INF"))
_OF_EXCEL = ("#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!")
MISSING = frozenset(
    ("", "?", *(c * k for c in "-*=" for k in range(1, 25)), *_WORDS.split(), *_OF_C, *_OF_EXCEL)
)
"""Cells that hold nothing; Fortran writes asterisks for what has no room, and rulers stand below headers."""

_HEADING = re.compile(
    r"(?P<name>[^\[\]]*?)\s*\[(?P<inside>[^\[\]]*)\]"
    r"|(?P<other>.*?\S)(?:\s*[({<](?P<round>[^(){}<>]+)[)}>]|\s*[,:]\s*(?P<behind>\S+)| / (?P<over>\S+))"
)
"""``name [unit]``, or ``name (unit)``, ``name {unit}``, ``name <unit>``, ``name, unit``, ``name: unit``, ``name / unit`` (ISO 80000-1)."""

# a unit in brackets below a name, or below one for several columns
_ALONE = re.compile(r"[({<]([^(){}<>]+)[)}>]")
_QUANTITY = re.compile(
    r"\s*(?P<number>[+-]?[.,]?\d[\d.,]*(?:[eE][+-]?\d+)?)\s*(?P<unit>[A-Za-z\u00b5\u03bc\u00b0%\u2103].*?)?\s*"
)
"""A number, perhaps with its unit in the same cell."""

_SIGN = re.compile(r"^([+-])\s+(?=[\d.,])")
_EXPONENT = re.compile(r"([\d.])[dD]([+-]?\d)")
_GROUPED = re.compile(r"(?<=\d)['\u2019 \u00a0\u202f](?=\d{3}(?:\D|$))")
_THOUSANDS = {m: rf"[+-]?[1-9]\d{{0,2}}(?:[{m}]\d{{3}})+" for m in ",."}
_DECIMALS = {
    m: rf"[+-]?(?:\d*|[1-9]\d{{0,2}}(?:[{o}]\d{{3}})+)[{m}]\d*(?:[eE][+-]?\d+)?" for m, o in (",.", ".,")
}
_DIVIDED = {m: re.compile(rf"{_THOUSANDS[o]}(?:[{m}]\d*)?") for m, o in (",.", ".,")}
# numbers whose marks may stand between thousands (1,234), and with a decimal mark, as Arrow's expressions
_UNIT = r"(?:\s*[A-Za-z\x{b5}\x{3bc}\x{b0}%].*)?"

ISOLATED = 10.0
"""Steps into and out of a missing-value code, over the largest step of all other values: those of readings are at most
a few times it, those of a code (-9999 among temperatures) hundreds or more."""

# share of the steps that are compared with those of a usual code: spikes beside it do not hide it
QUIET = 0.99
FEWEST_VARYING = 0.5
"""Share of steps other than 0 from which a column varies, so that equal values far outside are no readings: switches and
counters stand still nearly always."""

_NINES = re.compile(r"-?9{3,}(?:\.(?:0|25|9+))?")


@dataclass(frozen=True, eq=False)
class DataColumn:
    """A column of a table, as a file has it."""

    name: str
    unit: str  # "": none given; of instants "s since 2026-03-01"
    values: NDArray[Any]  # (n,) float64 with NaN for nothing, or object: texts with "" for nothing

    @property
    def is_text(self) -> bool:
        return self.values.dtype == object

    @property
    def is_instant(self) -> bool:
        return " since " in self.unit

    @property
    def is_number(self) -> bool:
        return not self.is_text and not self.is_instant


@dataclass(frozen=True, eq=False)
class DataTable:
    """Columns of one length: as a file has them or, once read, those of a flight under the names of the contract."""

    columns: tuple[DataColumn, ...]
    line: str | None = None  # the flight line, where there are several
    part: str = ""  # group, structure or sheet
    notes: tuple[str, ...] = ()  # what was made of the file
    index: str | None = None  # the column that labels the rows: the index of a DataFrame
    # how the file counts its rows: its word for them, and the number of the first
    counts: tuple[str, int] = ("row", 1)
    decimal: str = ""  # the mark in its texts
    # of a flight
    place: str = ""  # for messages
    # the instant at which time is 0, if known (UTC, or GPS time where the file has that)
    origin: datetime | None = None
    instants: bool = False  # whether its stamps are instants, not seconds
    demodulation: Demodulation | None = None  # how its channels were made, if that is known

    def __len__(self) -> int:
        return len(self.columns[0].values) if self.columns else 0

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(c.name for c in self.columns)

    def column(self, name: str) -> DataColumn:
        """The first column of this name; KeyError if there is none."""
        return {c.name: c for c in reversed(self.columns)}[name]

    def row(self, position: int) -> str:
        """A row as the file counts it: ``line 9``."""
        return f"{self.counts[0]} {self.counts[1] + position}"

    def rows(self, chosen: NDArray[Any]) -> DataTable:
        """Some of the rows, by their positions."""
        return replace(self, columns=tuple(replace(c, values=c.values[chosen]) for c in self.columns))


# --- headings ------------------------------------------------------------------------------------------


def read_heading(text: str) -> tuple[str, str]:
    """Name and unit of ``name [unit]``, or of another form (see above), if what stands for the unit is one."""
    text = " ".join(text.split())
    if text.startswith("/'"):  # LabVIEW: /'group'/'name (unit)'
        text = re.sub(r"([\[(][^\[\]()]+[\])])'$", r"'\1", text)
    if (alone := _ALONE.fullmatch(text)) and is_unit(alone[1]):
        return "", alone[1]
    match = _HEADING.fullmatch(text)
    if match and match["inside"] is not None:
        return one_line(match["name"]), match["inside"].strip()
    if match:
        unit = (match["round"] or match["behind"] or match["over"]).strip()
        if is_unit(unit) or match["other"] in SI_UNITS:
            return one_line(match["other"]), unit
    return one_line(text), ""


def read_headings(texts: Sequence[str]) -> list[tuple[str, str]]:
    """Names and units of a header; of ``gyro[0]``, ``gyro[1]``, ``gyro[2]`` the numbers belong to the names."""
    headings = [read_heading(t) for t in texts]
    numbered = Counter(name for name, unit in headings if unit.isdigit())
    return [
        (one_line(text.strip()), "") if unit.isdigit() and numbered[name] > 1 else (name, unit)
        for text, (name, unit) in zip(texts, headings, strict=True)
    ]


def is_unit(text: str) -> bool:
    """Whether the text reads as a unit."""
    try:
        units(9.8).parse(text)  # whether a text is a unit does not depend on the model's g
    except UserError:
        return False
    return bool(text.strip())


# --- cells ---------------------------------------------------------------------------------------------


def write_cell(cell: Any) -> str:
    """A cell as text: dates in ISO 8601, 1010 for 1010.0, nothing for ``None`` and NaN; elapsed times with their days.

    Elapsed times beyond 24 h are dates of 1900 for Excel.
    """
    if str(cell) in ("None", "nan", "NaT", "<NA>"):
        return ""
    if isinstance(cell, bytes):
        cell = cell.decode("utf-8", "replace")
    if isinstance(cell, datetime) and cell.year in (1899, 1900):
        cell = cell.replace(tzinfo=None) - datetime(1899, 12, 31)
    if isinstance(cell, timedelta):
        return f"{cell.days} days {cell - timedelta(cell.days)}"
    if hasattr(cell, "isoformat"):
        return str(cell.isoformat())
    if isinstance(cell, float):
        return str(int(cell)) if cell.is_integer() and abs(cell) < 1e15 else repr(float(cell))
    return str(cell).strip("\0 \t\r\n")


def split_quantity(text: str) -> tuple[str, str]:
    """Number and unit of a cell, however its thousands and decimals are divided; both empty where it holds no number.

    The minus of print, the D of Fortran, and blanks behind signs and between thousands become what programs read.
    """
    plain = _EXPONENT.sub(r"\1e\2", _SIGN.sub(r"\1", text.replace("\u2212", "-")))
    match = _QUANTITY.fullmatch(_GROUPED.sub("", plain))
    return (match["number"], match["unit"] or "") if match else ("", "")


def find_decimal(columns: Iterable[Any]) -> str:
    """The decimal mark, ``.`` or ``,``, of columns of texts that were written together; ``""``: they leave it open.

    A mark that may as well stand between thousands (1,234) tells nothing; 0,5 and 1.234,5 do, in whichever column.
    """
    texts = [c if isinstance(c, pa.ChunkedArray) else pa.array(c, pa.string()) for c in columns]
    marked = {m: [t.filter(pc.match_substring(t, m)) for t in texts] for m in ",."}
    if not any(map(len, marked[","])):
        return "."

    def is_told(cells: Any, mark: str) -> bool:
        number, thousands = (rf"^\s*{x[mark]}{_UNIT}\s*$" for x in (_DECIMALS, _THOUSANDS))
        numbers = pc.and_not(
            pc.match_substring_regex(cells, number), pc.match_substring_regex(cells, thousands)
        )
        return bool(pc.any(numbers).as_py())

    marks = [m for m in ",." if any(is_told(t, m) for t in marked[m])]
    return marks[0] if len(marks) == 1 else ""


def read_numbers(c: DataColumn, decimal: str = "", null: Container[object] = ()) -> tuple[DataColumn, Mask]:
    """A column of n cells as numbers, NaN where there is none, in the unit of the first (``0.12 m/s2``) or its own; and the cells (n,) that
    are neither such numbers nor marks of missing ones, as ``null`` lists more. ``decimal``: their mark; ``""``: they tell it themselves.
    """
    texts = ["" if t in null else str(t) for t in c.values]
    decimal = decimal or find_decimal([texts])
    cells = [split_quantity(t) for t in texts]
    symbols, registry = [*dict.fromkeys(u for _, u in cells if u)], units(9.8)
    symbols = symbols if all(is_unit(u) and registry.fits(u, symbols[0]) for u in symbols) else []
    fits = [u in symbols if symbols else not u for _, u in cells]
    numbers = np.array([_parse(n, decimal) if ok else np.nan for (n, _), ok in zip(cells, fits, strict=True)])
    for unit in symbols[1:]:
        here, si = np.array([u == unit for _, u in cells]), registry.base_unit(symbols[0])
        numbers[here] = registry.from_si(registry.to_si(numbers[here], unit, si), si, symbols[0])
    spoiled = np.isnan(numbers) & np.array([t not in MISSING for t in texts], dtype=np.bool_)
    return replace(c, unit=symbols[0] if symbols else c.unit, values=numbers), spoiled


def _parse(number: str, decimal: str) -> float:
    """A number with a decimal mark and perhaps the other mark between thousands; NaN where it is none."""
    if decimal and _DIVIDED[decimal].fullmatch(number):
        number = number.replace("." if decimal == "," else ",", "")
    try:
        return float(number.replace(",", ".") if decimal == "," else number)
    except ValueError:
        return float("nan")


# --- codes of missing values ----------------------------------------------------------------------------


def find_codes(values: Array, *, known_only: bool = False) -> list[float]:
    """Codes of missing values in a column (n,): isolated extremes that repeat, or are usual codes such as -9999 (``known_only``)."""
    x = values[np.isfinite(values)]
    usual = _find_extremes(x, lambda _, v: _is_usual(v))
    rest = x[~np.isin(x, usual)]
    if not len(rest):  # a sensor that was not there
        return [c for c in usual if c < 0 or c >= 1e20]
    codes = [c for c in usual if _is_isolated(x[(x == c) | ~np.isin(x, usual)], c, rest, QUIET)]
    return codes + ([] if known_only else _find_extremes(x[~np.isin(x, codes)], _is_unusual_code))


def _find_extremes(x: Array, is_code: Callable[[Array, float], bool]) -> list[float]:
    """Extremes that are codes, one after the other."""
    extremes: list[float] = []
    while len(x) and (codes := [v for v in (float(x.min()), float(x.max())) if is_code(x, v)]):
        extremes.append(codes[0])
        x = x[x != codes[0]]
    return extremes


def _is_unusual_code(x: Array, code: float) -> bool:
    """Whether an extreme of no usual form is a code: it repeats, far from values that vary."""
    hit = x == code
    if not 1 < np.sum(hit) < len(x) / 2:
        return False
    rest = x[~hit]
    return bool(np.mean(np.diff(rest) != 0) > FEWEST_VARYING) and _is_isolated(x, code, rest, 1.0)


def _is_isolated(x: Array, code: float, rest: Array, share: float) -> bool:
    """Whether a value lies outside all others, and every step into and out of it is far larger than ``share`` of theirs."""
    if len(rest) < 2 or rest.min() <= code <= rest.max():
        return False
    hit = x == code
    steps, others = np.abs(np.diff(x)), np.abs(np.diff(rest))
    into = np.min(steps[hit[1:] != hit[:-1]], initial=np.inf)
    return bool(into > ISOLATED * np.quantile(others, share, method="lower"))


def _is_usual(value: float) -> bool:
    """-999, -9999, -999.25, 99999.9, -32768, 1e20 and beyond: what programs write where nothing was measured."""
    size = abs(value)
    if size >= 1e20 or size in (32767.0, 32768.0, 2147483647.0, 2147483648.0):
        return True
    digits = (f"{value:.10g}", f"{value:.7g}")  # in single precision, too
    return 999 <= size < 1e12 and any(map(_NINES.fullmatch, digits))


# --- memory --------------------------------------------------------------------------------------------


def require_memory(path: Path, size: float) -> None:
    """UserError if a table of so many bytes is more than ``SHARE`` of the memory that is free."""
    free = find_free_memory()
    if free is not None and size > SHARE * free:
        raise UserError(
            "the table is too large for the memory of this computer",
            where=path,
            found=f"about {size / 1e9:.3g} GB once it is read",
            expected=f"at most {SHARE * free / 1e9:.3g} GB, half of what is free",
            remedy="divide the file, or leave out columns and lines that are not needed",
        )


def find_free_memory() -> float | None:
    """Bytes that can be had without swapping; ``None`` where the system does not report it."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            return next(float(x.split()[1]) * 1024 for x in lines if x.startswith("MemAvailable:"))
    except (OSError, StopIteration, ValueError):
        return None  # on other systems NumPy raises its own MemoryError
