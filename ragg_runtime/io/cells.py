"""Cells and headings of tables as texts: names with units, numbers as people write them, what holds nothing."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from datetime import datetime, timedelta
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError, one_line
from ragg_runtime.instrument.units import units
from ragg_runtime.io.record import SI_UNITS, Array, Mask

_WORDS = (
    "nan NaN NAN NaT NA N/A n/a n.a. <NA> null NULL None -nan nan(ind) -nan(ind) inf -inf Inf -Inf INF -INF"
)
_OF_C = tuple(f"{sign}1.#{word}" for sign in ("", "-") for word in ("IND", "QNAN", "INF"))
_OF_EXCEL = ("#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!")
MISSING = frozenset(
    ("", "?", *(c * k for c in "-*" for k in range(1, 25)), *_WORDS.split(), *_OF_C, *_OF_EXCEL)
)
"""Cells that hold nothing; Fortran writes asterisks for what has no room."""

_HEADING = re.compile(
    r"(?P<name>[^\[\]]*?)\s*\[(?P<inside>[^\[\]]*)\]"
    r"|(?P<other>.*?\S)(?:\s*[({<](?P<round>[^(){}<>]+)[)}>]|\s*[,:]\s*(?P<behind>\S+)| / (?P<over>\S+))"
)
"""``name [unit]``, or ``name (unit)``, ``name {unit}``, ``name <unit>``, ``name, unit``, ``name: unit``, ``name / unit`` (ISO 80000-1)."""

_ALONE = re.compile(r"[({<]([^(){}<>]+)[)}>]")
"""A unit in brackets below a name, or below one for several columns."""

_QUANTITY = re.compile(
    r"\s*(?P<number>[+-]?[.,]?\d[\d.,]*(?:[eE][+-]?\d+)?)\s*(?P<unit>[A-Za-z\u00b5\u03bc\u00b0%\u2103].*?)?\s*"
)
"""A number, perhaps with its unit in the same cell."""

_EXPONENT = re.compile(r"([\d.])[dD]([+-]?\d)")
_GROUPED = re.compile(r"(?<=\d)['\u2019 \u00a0\u202f](?=\d{3}(?:\D|$))")
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+(?:\.\d*)?")
_POINTED = re.compile(r"[+-]?[1-9]\d{0,2}(?:\.\d{3})+,\d*")
"""Numbers with commas between thousands (1,234.5), and with points (1.234,5)."""


# --- headings ------------------------------------------------------------------------------------------


def read_heading(text: str) -> tuple[str, str]:
    """Name and unit of ``name [unit]``, or of another way in which what should be the unit is one (see above)."""
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
    found = [read_heading(t) for t in texts]
    numbered = Counter(name for name, unit in found if unit.isdigit())
    return [
        (one_line(text.strip()), "") if unit.isdigit() and numbered[name] > 1 else (name, unit)
        for text, (name, unit) in zip(texts, found, strict=True)
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


def is_quantity(text: str) -> bool:
    """Whether a cell is a number, however its thousands and decimals are divided, perhaps with a unit."""
    return _QUANTITY.fullmatch(_write_plain(text)) is not None


def is_number(text: str) -> bool:
    """Whether a cell is a number without a unit."""
    match = _QUANTITY.fullmatch(_write_plain(text))
    return match is not None and not match["unit"]


def _write_plain(text: str) -> str:
    """A number with the minus of print, the D of Fortran or blanks between thousands as programs read it."""
    return _GROUPED.sub("", _EXPONENT.sub(r"\1e\2", text.replace("\u2212", "-")))


def parse_quantities(texts: Iterable[str]) -> tuple[Array, str, Mask]:
    """Numbers in cells, with their units if they have such (``0.12 m/s2``).

    Parameters
    ----------
    texts
        n cells.

    Returns
    -------
    numbers : (n,) array
        NaN where a cell holds none.
    unit : str
        Of the numbers: that of the first one; ``""`` where cells have none.
    spoiled : (n,) array
        Where a cell is neither such a number nor one of those that hold nothing.
    """
    texts = [*texts]
    matches = [None if t in MISSING else _QUANTITY.fullmatch(_write_plain(t)) for t in texts]
    given = [*dict.fromkeys(m["unit"] for m in matches if m and m["unit"])]
    known = units(9.8)
    given = given if all(is_unit(u) and known.fits(u, given[0]) for u in given) else []
    own = [(m["unit"] or "") if m else "" for m in matches]
    fits = [m if m and (u in given if given else not u) else None for m, u in zip(matches, own, strict=True)]
    numbers = _parse_numbers([m["number"] if m else "" for m in fits])
    for unit in given[1:]:
        here, si = np.array([u == unit for u in own]), known.base_unit(given[0])
        numbers[here] = known.from_si(known.to_si(numbers[here], unit, si), si, given[0])
    spoiled = np.isnan(numbers) & np.array([t not in MISSING for t in texts], dtype=np.bool_)
    return numbers, given[0] if given else "", spoiled


def _parse_numbers(texts: Sequence[str]) -> NDArray[np.float64]:
    """Numbers of texts, NaN where they are none.

    Where a number has points and then a comma (1.234,5) the comma is decimal in all; where one has a point, commas separate
    thousands. Commas alone are decimal, unless all of them may separate thousands (1,234), which is not decided.
    """

    def parse(text: str) -> float:
        try:
            return float(text)
        except ValueError:
            return np.nan

    if any(map(_POINTED.fullmatch, texts)):
        texts = [t.replace(".", "").replace(",", ".") for t in texts]
    elif any("." in t for t in texts):
        texts = [t.replace(",", "") if _THOUSANDS.fullmatch(t) else t for t in texts]
    elif not all(map(_THOUSANDS.fullmatch, (t for t in texts if "," in t))):
        texts = [t.replace(",", ".") for t in texts]
    return np.array([parse(t) for t in texts])
