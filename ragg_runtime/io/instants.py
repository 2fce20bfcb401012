"""Instants as files write them, in seconds: ISO 8601, d/m/y and m/d/y, times of the day, elapsed times, GPS weeks.

A date whose day and month could change places is refused until ``format`` says which is which.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from types import MappingProxyType
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError

Array = NDArray[np.float64]
Nanoseconds = NDArray[np.int64]

GPS_EPOCH = datetime(1980, 1, 6, tzinfo=UTC)
"""Week 0 of GPS time; it counts no leap seconds (Interface Control Document IS-GPS-200, 20.3.3.3)."""

WAYS: Mapping[str, tuple[int, str]] = MappingProxyType(
    {
        "iso": (1, "2026-03-01T12:00:00.5Z"),
        "clock": (1, "13:28:50.4 or 132850.4"),
        "date clock": (2, "20260301 and 13:28:50.4"),
        "gps": (2, "week 2407 and 43200.5 s"),
        "d/m/y": (1, "31/12/2026 13:28:50.4, one column or two"),
        "m/d/y": (1, "12/31/2026 1:28:50.4 PM, one column or two"),
    }
)
"""The formats that a mapping may name beside plain seconds: columns that they take, and an example."""

_SECOND = 10**9
_DAY = 86400 * _SECOND
_NONE = np.iinfo(np.int64).min
_NOTHING = ("", "NaT", "nan", "NaN", "None", "null", "-", "--")
_MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
_ISO = re.compile(r"\d{4}-\d{2}-\d{2}(?:[T ]\d.*)?")
_INSTANT = re.compile(
    r"(?:(?P<days>\d+) +days?,?(?: +|$))?"
    r"(?:(?P<a>\d{1,4})(?P<sep>[-/. ])(?P<b>\d{1,2}|[A-Za-z]{3,9})(?P=sep)(?P<c>\d{1,4})(?:[T, ]+(?=\d)|$))?"
    r"(?:(?P<h>\d{1,6}):(?P<m>\d{1,2})(?::(?P<s>\d{1,2}))?(?:[.,](?P<f>\d*))?(?: *(?P<half>[AaPp])\.?[Mm]\.?)?)?"
    r" *(?P<zone>Z|UTC|GMT|[+-]\d{2}:?\d{2})?"
)


@dataclass(frozen=True)
class Seconds:
    """Stamps in seconds (n,), NaN where nothing stands.

    ``instants``: they are dates, times of the day or GPS time and count from ``origin``, the midnight before the first one
    (UTC, or GPS time where the file counts in that; ``None`` if the day is not known). Otherwise they are elapsed times.
    """

    values: Array
    instants: bool = True
    origin: datetime | None = None
    notes: tuple[str, ...] = ()


def _spread(text: str) -> str:
    """A stamp without blanks at its ends; 20260301T132850.4 as 2026-03-01T13:28:50.4."""
    return re.sub(r"^(\d{4})(\d\d)(\d\d)[T ](\d\d)(\d\d)(\d\d)", r"\1-\2-\3T\4:\5:\6", text.strip())


def is_instant(text: str) -> bool:
    """Whether a text is a date, with or without a time, a time of the day, or an elapsed time."""
    return any(parts_of(text))


def parts_of(text: str) -> tuple[bool, bool]:
    """Whether there is a date in a stamp, and whether a time."""
    match = _INSTANT.fullmatch(_spread(text))
    if match is None:
        return False, False
    return match["a"] is not None, match["h"] is not None or match["days"] is not None


def order_of(format_: str) -> str | None:
    """``dmy``, ``mdy`` or ``ymd`` of ``d/m/y``, ``mm/dd/yyyy``, ``%d.%m.%Y %H:%M:%S``; ``None``: no such format."""
    letters = "".join(dict.fromkeys(re.findall("[dmy]", format_.casefold())))
    return letters if letters in ("dmy", "mdy", "ymd") and re.match(r"\W*[dmy]", format_.casefold()) else None


def read_stamps(
    columns: Sequence[NDArray[Any]], way: str | None, where: str, row: Any = "row {}".format
) -> Seconds:
    """The stamps in one or two columns of text, dates or numbers.

    Parameters
    ----------
    columns
        (n,) each, as :class:`ragg_runtime.io.tables.Column` holds them.
    way
        One of :data:`WAYS`, or another order of day, month and year; ``None``: seen from the values.
    where
        Place for messages; ``row`` names a row by its position, there too.

    Raises
    ------
    UserError
        At the first stamp that cannot be read, or if day and month could change places.
    """
    first = columns[0]
    if way == "gps":
        return _since_midnight(_read_gps(first, columns[1], where), dated=True)
    if first.dtype.kind == "m":
        there = ~np.isnat(first)
        return Seconds(np.where(there, first.astype(np.int64) / _SECOND, np.nan), instants=False)
    if first.dtype.kind == "M":
        total = first.astype("datetime64[ns]").astype(np.int64)  # NaT is the least integer
        if len(columns) == 2:
            total = _add(total - total % _DAY * (total != _NONE), _read_clock(columns[1], where, row)[0])
        return _since_midnight(total, dated=True)
    order = None if way is None else order_of(way)
    if len(columns) == 2:
        dates = _written_dates(first)
        if columns[1].dtype.kind == "f":
            days = _read_texts(dates, order, where, row)
            return _since_midnight(_add(days.total, _read_clock(columns[1], where, row)[0]), dated=True)
        texts = np.array(
            [f"{d} {c}".strip() if d and c else "" for d, c in zip(dates, columns[1], strict=True)],
            dtype=object,
        )
        return _read_texts(texts, order, where, row).seconds()
    if first.dtype.kind == "f":
        return _since_midnight(*_read_clock(first, where, row))
    fast = _read_iso(first) if order in (None, "ymd") else None
    return (
        _since_midnight(fast, dated=True)
        if fast is not None
        else _read_texts(first, order, where, row).seconds()
    )


def count_from(values: Array, epoch: str) -> Seconds | None:
    """Seconds (n,) since a date as instants; ``None`` if the date is none."""
    try:
        start = read_stamps([np.array([epoch], dtype=object)], None, "")
    except UserError:
        return None
    if start.origin is None:
        return None
    return Seconds(values, origin=start.origin + timedelta(seconds=float(start.values[0])))


def _since_midnight(
    total: Nanoseconds, dated: bool, period: int = _DAY, notes: tuple[str, ...] = ()
) -> Seconds:
    """Instants as seconds since the midnight before the first; times of the day (not ``dated``) go on over midnight."""
    there = total != _NONE
    values = total[there]
    if not len(values):
        return Seconds(np.full(len(total), np.nan), notes=notes)
    first = int(values[0]) // _DAY if dated else 0
    if not dated:
        values = values + np.cumsum(np.diff(values, prepend=values[:1]) < -(period // 2)) * period
    found = np.full(len(total), np.nan)
    found[there] = (values - first * _DAY) / _SECOND
    origin = datetime(1970, 1, 1, tzinfo=UTC) + timedelta(days=first) if dated else None
    return Seconds(found, origin=origin, notes=notes)


def _add(day: Nanoseconds, clock: Nanoseconds) -> Nanoseconds:
    return np.where((day == _NONE) | (clock == _NONE), _NONE, day + clock)


def _read_iso(values: NDArray[Any]) -> Nanoseconds | None:
    """Nanoseconds since 1970 of ISO 8601 texts, all with a zone or all without; ``None`` if one is anything else."""
    texts = [t.strip().replace("/", "-").replace(",", ".") for t in values]
    if not _ISO.fullmatch(next(filter(None, texts), "")):
        return None
    texts = [re.sub(r"(\.\d{9})\d+", r"\1", t) for t in texts]
    for zone in (None, "UTC"):
        try:
            column = pa.array([t or None for t in texts]).cast(pa.string()).cast(pa.timestamp("ns", tz=zone))
        except pa.ArrowException:
            continue
        return np.asarray(column.cast(pa.int64()).fill_null(_NONE).to_numpy(zero_copy_only=False), np.int64)
    return None


@dataclass(frozen=True)
class _Texts:
    """Nanoseconds since 1970, or since midnight where there are no dates, and how they are to be taken."""

    total: Nanoseconds
    dated: bool
    elapsed: bool
    period: int
    notes: tuple[str, ...]

    def seconds(self) -> Seconds:
        if not self.elapsed:
            return _since_midnight(self.total, self.dated, self.period, self.notes)
        return Seconds(np.where(self.total == _NONE, np.nan, self.total / _SECOND), instants=False)


def _read_texts(values: NDArray[Any], order: str | None, where: str, row: Any) -> _Texts:
    """Dates and times as people write them."""
    values = np.array(["" if str(t).strip() in _NOTHING else _spread(str(t)) for t in values], dtype=object)
    matches = [_INSTANT.fullmatch(t) if t else None for t in values]
    for k, (t, m) in enumerate(zip(values, matches, strict=True)):
        if t and (m is None or (m["days"], m["a"], m["h"]) == (None, None, None)):
            raise _unreadable(where, t, row(k))
    there = np.array([m is not None for m in matches], dtype=np.bool_)
    found = [m for m in matches if m is not None]
    dated = bool(found) and found[0]["a"] is not None
    for k in np.flatnonzero(there).tolist():
        if ((m := matches[k]) is not None) and (m["a"] is not None) != dated:
            raise _unreadable(where, values[k], row(k))
    written = list(dict.fromkeys((m["a"], m["sep"], m["b"], m["c"]) for m in found)) if dated else []
    order = order or (_find_order(written, where) if dated else "ymd")
    days = {w: _day(w, order) for w in written}
    total = np.full(len(values), _NONE)
    clocks = [_clock(m) for m in found]
    for k, m, clock in zip(np.flatnonzero(there).tolist(), found, clocks, strict=True):
        day = days[(m["a"], m["sep"], m["b"], m["c"])] if dated else 0
        if day is None or clock is None:
            raise _unreadable(where, values[k], row(k))
        total[k] = day * _DAY + clock
    leaps = np.flatnonzero([m is not None and m["s"] == "60" for m in matches])
    if len(leaps):  # the seconds after it have the numbers that they would have had without it
        total[leaps[-1] + 1 :] += np.where(there[leaps[-1] + 1 :], _SECOND, 0)
    minutes = not dated and all(m["s"] is None and m["f"] is not None for m in found)
    elapsed = not dated and any(m["days"] or (int(m["h"] or 0) > 23 and not minutes) for m in found)
    notes = ("a leap second (hh:mm:60) is counted",) if len(leaps) else ()
    return _Texts(total, dated, elapsed, _DAY // 24 if minutes else _DAY, notes)


def _clock(m: re.Match[str]) -> int | None:
    """Nanoseconds of the time in a stamp, zone and days of an elapsed time included; ``None`` if it is none."""
    if m["h"] is None:
        return int(m["days"] or 0) * _DAY
    hours, minutes, seconds = int(m["h"]), int(m["m"]), int(m["s"] or 0)
    if m["s"] is None and m["f"] is not None:  # mm:ss.f
        hours, minutes, seconds = 0, hours, minutes
    if minutes > 59 or seconds > 60 or (m["a"] is not None and hours > 24):
        return None
    if m["half"] is not None:
        if not 1 <= hours <= 12:
            return None
        hours = hours % 12 + (12 if m["half"] in "pP" else 0)
    total = ((hours * 60 + minutes) * 60 + seconds) * _SECOND + int(((m["f"] or "") + "0" * 9)[:9])
    zone = m["zone"] or ""
    if zone[:1] in ("+", "-") and m["a"] is not None:
        offset = int(zone[1:3]) * 60 + int(zone[-2:])
        total -= (offset if zone[0] == "+" else -offset) * 60 * _SECOND
    return total + int(m["days"] or 0) * _DAY


def find_order(values: NDArray[Any]) -> str | None:
    """``ymd``, ``dmy`` or ``mdy`` of dates (n,) as text; ``None`` where two are possible."""
    matches = (_INSTANT.fullmatch(_spread(str(t))) for t in dict.fromkeys(values))
    written = dict.fromkeys((m["a"], m["sep"], m["b"], m["c"]) for m in matches if m and m["a"])
    try:
        return _find_order(list(written), "")
    except UserError:
        return None


def _find_order(dates: Sequence[tuple[str, str, str, str]], where: str) -> str:
    """The order of day, month and year, by all dates; UserError if two are possible."""
    if all(len(a) == 4 for a, *_ in dates):
        return "ymd"
    if any(
        sep == "." or b.isalpha() for _, sep, b, _ in dates
    ):  # dots stand between day, month and year alone
        return "dmy"
    month_first = any(int(b) > 12 for _, _, b, _ in dates)
    day_first = any(int(a) > 12 for a, *_ in dates)
    if day_first or month_first:
        return "dmy" if day_first else "mdy"
    a, sep, b, c = dates[0]
    raise UserError(
        "a date could be day/month or month/day",
        where=where,
        found=repr(f"{a}{sep}{b}{sep}{c}"),
        expected="dates of which one order alone is possible, or yyyy-mm-dd",
        remedy='say in a mapping which it is: [time] format = "d/m/y" or "m/d/y"',
    )


def _day(written: tuple[str, str, str, str], order: str) -> int | None:
    """Days since 1970 of a date; ``None`` if there is none such."""
    a, _, b, c = written
    part = dict(zip(order, (a, b, c), strict=True))
    month = part["m"]
    try:
        number = int(month) if month.isdigit() else _MONTHS.index(month[:3].casefold()) + 1
        year = int(part["y"])
        if len(part["y"]) <= 2:
            year += 1900 if year >= 70 else 2000
        return datetime(year, number, int(part["d"])).toordinal() - datetime(1970, 1, 1).toordinal()
    except ValueError:
        return None


def _written_dates(values: NDArray[Any]) -> NDArray[Any]:
    """Dates as text: ``20260301`` as ``2026-03-01``."""
    texts = [f"{v:.0f}" if np.isfinite(v) else "" for v in values] if values.dtype.kind == "f" else values
    found = [re.sub(r"^(\d{4})(\d{2})(\d{2})$", r"\1-\2-\3", str(t).strip()) for t in texts]
    return np.array(found, dtype=object)


def _read_clock(values: NDArray[Any], where: str, row: Any) -> tuple[Nanoseconds, bool]:
    """Nanoseconds since midnight of hh:mm:ss as text, or of hhmmss.s as numbers; never dated."""
    if values.dtype.kind != "f":
        return _read_texts(values, None, where, row).total, False
    there = np.isfinite(values)
    v = np.where(there, values, 0.0)
    hours, minutes = np.floor(v / 1e4), np.floor(v % 1e4 / 100)
    wrong = np.flatnonzero((v < 0) | (hours > 24) | (minutes >= 60) | (v % 100 >= 61))
    if len(wrong):
        raise _unreadable(where, float(v[wrong[0]]), row(wrong[0]))
    second = np.rint((v % 100) * 1e6).astype(np.int64) * 1000  # a number of this size has 1e-10 s
    total = (hours * 3600 + minutes * 60).astype(np.int64) * _SECOND + second
    return np.where(there, total, _NONE), False


def _read_gps(week: NDArray[Any], second: NDArray[Any], where: str) -> Nanoseconds:
    """Nanoseconds since 1970, in GPS time."""
    if week.dtype.kind != "f" or second.dtype.kind != "f":
        raise _unreadable(where, (second if week.dtype.kind == "f" else week)[0], "as week and seconds")
    there = np.isfinite(week) & np.isfinite(second)
    w, s = np.where(there, week, 0.0), np.where(there, second, 0.0)
    wrong = (np.abs(w - np.rint(w)) > 0) | (w < 0) | (w > 9999) | (s < 0) | (s > 604800 + 1)
    if wrong.any():
        raise UserError(
            "the instant cannot be read",
            where=where,
            found=f"week {w[wrong][0]:g}, {s[wrong][0]:g} s",
            expected="a whole week, and seconds from 0 to 604800 in it",
        )
    epoch = int(GPS_EPOCH.timestamp()) * _SECOND
    total = epoch + w.astype(np.int64) * 7 * _DAY + np.rint(s * 1e9).astype(np.int64)
    return np.where(there, total, _NONE)


def _unreadable(where: str, found: object, row: str) -> UserError:
    shown = str(found)
    return UserError(
        "the instant cannot be read",
        where=where,
        found=f"{row}: {shown[:60]!r}" + "..." * (len(shown) > 60),
        expected="; ".join(example for _, example in WAYS.values()) + "; or plain seconds",
        remedy="say in a mapping how time is written ([time] format = ...), or write ISO 8601",
    )
