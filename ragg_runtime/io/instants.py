"""Instants as files write them, in seconds: ISO 8601, d/m/y and m/d/y, times of the day, elapsed times, GPS weeks.

A date whose day and month could change places is refused until ``format`` settles it.
"""

from __future__ import annotations

import contextlib
import itertools
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from datetime import UTC, datetime, timedelta
from types import MappingProxyType
from typing import Any

import numpy as np
import pyarrow as pa
from dateutil import parser  # type: ignore[import-untyped]
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.io.tables import MISSING

Array = NDArray[np.float64]
Nanoseconds = NDArray[np.int64]

# week 0 of GPS time; it counts no leap seconds (Interface Control Document IS-GPS-200, 20.3.3.3)
GPS_EPOCH = datetime(1980, 1, 6, tzinfo=UTC)

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

MIDNIGHT = "midnight"  # what times of the day count from
_EPOCH = datetime(1970, 1, 1)
_SECOND = 10**9
_LOOKED_AT = 64  # stamps that show how all are written
_DAY, _HOUR = 86400 * _SECOND, 3600 * _SECOND
_NO_HOUR = "000000"
_NONE = np.iinfo(np.int64).min  # as NaT
_STAMP = re.compile(
    r"(?:(?P<days>-?\d+)(?: +days?,?(?: +|$)|\.(?=\d\d:\d\d:\d\d)))?"
    r"(?:(?P<date>\d[\w/.-]*\d|(?=.*[A-Za-z]{3})[\w.,/ -]*?\w)(?:(?:,|,?[T _-]) *(?=\d+:)|,?$))?"
    r"(?:(?P<h>\d{1,6}):(?P<m>[0-5]?\d)(?::(?P<s>[0-5]?\d|60)(?:[.,](?P<f>\d*))?)?(?: *(?P<half>[AaPp])\.? ?[Mm]\.?)?)?"
    r" *(?P<zone>Z|UTC|GMT|[+-]\d{2}(?::?\d{2})?)?(?P<year> \d{4})?"
)
_NUMBERS = re.compile(r"(\d{1,4})([-/. ])(\d{1,2})\2(\d{1,4})")
_PACKED = re.compile(
    r"(?:19|20)\d\d(?:0[1-9]|1[0-2])(?:0[1-9]|[12]\d|3[01])(?:[01]\d|2[0-3])[0-5]\d[0-5]\d(?:\.?\d{0,9})"
)
_SPELLINGS = tuple(
    (re.compile(pattern), plain)
    for pattern, plain in (
        (r"^\[(.+)\]$", r"\1"),
        (r"(:\d\d:\d\d):(\d{3,9})(?!\d)", r"\1.\2"),  # 13:28:50:400
        (r"^(\d{4}):(\d{3})[:T ](?=\d\d:\d\d:)", r"\1-\2T"),  # 2026:060:13:28:50 of the day of the year
        (r"^(\d{4}):(\d\d):(\d\d)[:T ](?=\d\d:\d\d:)", r"\1-\2-\3T"),
        (r"^(\d\d:\d\d[.,]\d+)$", rf"{_NO_HOUR}:\1"),  # 28:50.4, as Excel shows times
        (rf"^(?={_PACKED.pattern}$)(\d{{8}})(\d\d)(\d\d)(\d\d)\.?", r"\1T\2:\3:\4."),  # 20260301132850.4
        (r"^(\d{8}|\d{4}-\d\d-\d\d)[T _-](\d\d)(\d\d)(\d\d)", r"\1T\2:\3:\4"),  # 20260301T132850.4
        (r"^(\d\d?:\d\d\S*(?: [AaPp][Mm])?),? +(\d+([-/.])\w+\3\d+)$", r"\2 \1"),  # 13:28:50.4 31/12/2026
        (r"^(\d\d?)\. ?(\d\d?)\. ?(\d{4})\.?(?= )", r"\1.\2.\3"),  # 31. 12. 2026
        (r"^(\d+[-/]?[A-Za-z]{3}[-/]?\d{4}):", r"\1 "),  # 31/Dec/2026:13:28:50
        (r"^(\d+([-/.])\w+\2\d+[T _])(\d\d)([-.])(\d\d)\4(\d\d)", r"\1\3:\5:\6"),  # 2026-12-31 13.28.50
    )
)
"""Other ways of writing a stamp, and what they mean."""

_YEAR_DAY = re.compile(r"(\d{4})[-/.]?(\d{3})")


def _match(text: str) -> re.Match[str] | None:
    """A stamp taken apart, however it is written."""
    for pattern, plain in _SPELLINGS:
        text = pattern.sub(plain, text)
    return _STAMP.fullmatch(text)


def are_packed(values: Iterable[Any]) -> bool:
    """Whether numbers or texts are instants without marks between their parts, such as 20260301132850.4."""
    texts = [t for v in itertools.islice(values, _LOOKED_AT) if (t := _write_clock(v)) not in MISSING]
    return bool(texts) and all(map(_PACKED.fullmatch, texts))


def find_parts(text: str) -> tuple[bool, bool]:
    """Whether there is a date in a stamp, and whether a time."""
    m = _match(text.strip())
    dated = m is not None and m["date"] is not None and _read_date(_join_date(m), "dmy") is not None
    return dated, m is not None and (m["h"] is not None or m["days"] is not None)


def parse_order(format_: str) -> str | None:
    """``dmy``, ``mdy`` or ``ymd`` of ``d/m/y``, ``mm/dd/yyyy``, ``%d.%m.%Y %H:%M:%S``; ``None``: no such format."""
    letters = "".join(dict.fromkeys(re.findall("[dmy]", format_.casefold())))
    return letters if letters in ("dmy", "mdy", "ymd") and re.match(r"\W*[dmy]", format_.casefold()) else None


def read_stamps(
    columns: Sequence[NDArray[Any]], way: str | None, where: str, row: Callable[[int], str] = "row {}".format
) -> tuple[Array, str, tuple[str, ...]]:
    """The stamps in one or two columns of texts or numbers (n,), written in one of :data:`WAYS` or another order of day, month and year
    (``None``: seen from the values), as seconds (n,), NaN where there is none; their unit, with what instants count from; and notes.

    UserError, with its place ``where`` and its ``row``, at the first that cannot be read, or if day and month could change places.
    """
    first, last = columns[0], [_write_clock(v) for v in columns[-1]]
    if way == "gps":
        return *count_seconds(_read_gps(first, columns[1], where)), ()
    pairs = zip(map(_write_date, first), last, strict=True)
    texts = last if len(columns) == 1 else [f"{d} {c}" if d and c else "" for d, c in pairs]
    order = None if way is None else parse_order(way)
    fast = _read_iso(texts) if order in (None, "ymd") else None
    return _read_texts(texts, order, where, row) if fast is None else (*count_seconds(fast), ())


def read_epoch(date: str) -> datetime | None:
    """The instant from which stamps count ``since`` a date; ``None`` if the date is none."""
    try:
        seconds, unit, _ = read_stamps([np.array([date], dtype=object)], None, "")
        midnight = datetime.fromisoformat(unit.removeprefix("s since "))
        return midnight.replace(tzinfo=UTC) + timedelta(seconds=float(seconds[0]))
    except (UserError, ValueError):
        return None


def count_seconds(x: NDArray[Any]) -> tuple[Array, str]:
    """Instants or elapsed times in seconds, and their unit: instants count from the midnight before the first of them."""
    if x.dtype.kind == "m":
        return np.where(np.isnat(x), np.nan, x.astype("m8[ns]").astype(np.int64) / _SECOND), "s"
    present = x[~np.isnat(x)]
    midnight = present[0].astype("M8[D]") if len(present) else np.datetime64("1970-01-01")
    return count_seconds(x.astype("M8[ns]") - midnight)[0], f"s since {midnight}"


def _follow(total: Nanoseconds, period: int) -> tuple[Array, str]:
    """Times that begin anew every day, or every hour, as seconds that go on, and their unit."""
    total, present = total.copy(), total != _NONE
    again = np.cumsum(np.diff(total[present], prepend=total[present][:1]) < -(period // 2))
    total[present] += again * period
    return count_seconds(total.view("m8[ns]"))[0], f"s since {MIDNIGHT}"


def _write_clock(value: Any) -> str:
    """A stamp as text: 132850.4 as 13:28:50.4."""
    if not isinstance(value, float):
        return str(value).strip()
    text = f"{value:013.6f}"
    if text[4:6] == "60" and value % 100 < 60:  # of 59.9999999 no leap second
        text = f"{value - 1e-6:013.6f}"
    if value >= 1e13:  # with the date in front; of single milliseconds nothing is known
        return f"{value:.3f}"
    return f"{text[:2]}:{text[2:4]}:{text[4:]}" if np.isfinite(value) else ""


def _write_date(value: Any) -> str:
    """A date as text: the number 20260301 without a point."""
    if isinstance(value, float):
        return f"{value:.0f}" if np.isfinite(value) else ""
    return str(value).strip().removesuffix("T00:00:00")


def _read_iso(values: Sequence[str]) -> NDArray[np.datetime64] | None:
    """Millions of ISO 8601 texts as instants; ``None`` if one is anything else."""
    texts = [re.sub(r"(\.\d{9})\d+", r"\1", t.replace(",", ".")) or None for t in values]
    for zone in (None, "UTC"):
        with contextlib.suppress(pa.ArrowException):
            column = pa.array(texts, pa.string()).cast(pa.timestamp("ns", tz=zone))
            return np.asarray(column.to_numpy(zero_copy_only=False))
    return None


def _read_texts(
    values: Sequence[str], order: str | None, where: str, row: Callable[[int], str]
) -> tuple[Array, str, tuple[str, ...]]:
    """Dates and times as people write them; see :func:`read_stamps`."""
    matches = {k: _match(t) for k, t in enumerate(values) if t not in MISSING}
    readable = {k: m for k, m in matches.items() if m is not None}
    dates = dict.fromkeys(d for m in readable.values() if (d := _join_date(m)))
    dated, days = bool(dates), dict[str, int | None]({"": 0})
    notes: tuple[str, ...] = ()
    if dated and order is None and all(m and _join_date(m) for m in matches.values()):
        order = find_order(dates)
        first = next(iter(dates))
        if order == "dmy" and _read_date(first, "ymd") not in (None, _read_date(first, "dmy")):
            notes = (
                f'dates are read as d/m/y, {first} as the day {first[:2]}; otherwise: [time] format = "y/m/d"',
            )
        if order is None:
            raise UserError(
                "a date could be day/month or month/day",
                where=where,
                found=repr(next(filter(_NUMBERS.fullmatch, dates))),
                remedy='specify it in a mapping: [time] format = "d/m/y" or "m/d/y"; or write yyyy-mm-dd',
            )
    days |= {d: _read_date(d, order or "dmy") for d in dates}
    total = np.full(len(values), _NONE)
    for k, m in matches.items():
        day = None if m is None or bool(_join_date(m)) != dated else days[_join_date(m)]
        clock = None if m is None else _read_clock(m)
        if day is None or clock is None:
            raise _refuse(where, values[k], row(k))
        total[k] = day * _DAY + clock
    leaps = [k for k, m in readable.items() if m["s"] == "60"]
    if leaps:  # the seconds after it have the numbers that they would have had without it
        after = np.arange(len(total)) > leaps[-1]
        total[after & (total != _NONE)] += _SECOND
    if readable and all(m["h"] == _NO_HOUR for m in readable.values()):
        return *_follow(total, _HOUR), ()
    elapsed = not dated and any(m["days"] or int(m["h"]) > 23 for m in readable.values())
    notes += ("a leap second (hh:mm:60) is counted",) * bool(leaps and not elapsed)
    if dated or elapsed:
        return *count_seconds(total.view("M8[ns]" if dated else "m8[ns]")), notes
    return *_follow(total, _DAY), notes


def _join_date(m: re.Match[str]) -> str:
    """The date in a stamp, with a year that follows the time of the day; ``""``: there is none."""
    return (m["date"] or "") + (m["year"] or "")


def _read_clock(m: re.Match[str]) -> int | None:
    """Nanoseconds of the time in a stamp, zone and days of an elapsed time included; ``None`` if it is none."""
    days = int(m["days"] or 0) * _DAY
    if m["h"] is None:
        return days if m["days"] or m["date"] else None
    hours, dated = int(m["h"]), m["date"] is not None
    if m["half"] and 1 <= hours <= 12:
        hours = hours % 12 + 12 * (m["half"] in "pP")
    elif m["half"] or (dated and hours > 24):
        return None
    zone, minutes = m["zone"] or "", hours * 60 + int(m["m"])
    if zone[:1] in ("+", "-") and dated:
        minutes -= int(zone[0] + "1") * (int(zone[1:3]) * 60 + int(zone[3:].lstrip(":") or 0))
    return days + (minutes * 60 + int(m["s"] or 0)) * _SECOND + int(f"{m['f'] or '':0<9.9}")


def find_order(values: Iterable[Any]) -> str | None:
    """``ymd``, ``dmy`` or ``mdy`` of stamps as text, by all their dates; ``None`` where two are possible."""
    matches = (_match(str(t).strip()) for t in dict.fromkeys(values))
    dates = [*dict.fromkeys(d for m in matches if m and (d := _join_date(m)))]
    days = {o: [_read_date(d, o) for d in dates] for o in ("ymd", "dmy", "mdy")}
    numbers = filter(None, map(_NUMBERS.fullmatch, dates))
    if any(m[2] == "." for m in numbers) and None not in days["dmy"]:  # with dots the day is first
        del days["mdy"]
    orders = {o: [x for x in v if x is not None] for o, v in days.items() if None not in v}
    if len({tuple(v) for v in orders.values()}) < 2:
        return next(iter(orders), "dmy")
    spans = {o: max(v) - min(v) for o, v in orders.items()}
    if spans.pop("ymd", np.inf) < spans.get("dmy", np.inf):  # 26/03/01, 26/03/02
        return "ymd"
    return next(iter(spans)) if len(spans) == 1 else None


def _read_date(text: str, order: str) -> int | None:
    """Days since 1970 of a date; ``None`` if there is none such."""
    try:
        if m := _NUMBERS.fullmatch(text):
            part = dict(zip("ymd" if len(m[1]) == 4 else order, (m[1], m[3], m[4]), strict=True))
            year = int(part["y"]) + (0 if len(part["y"]) > 2 else 1900 if int(part["y"]) >= 70 else 2000)
            return (datetime(year, int(part["m"]), int(part["d"])) - _EPOCH).days
        if m := _YEAR_DAY.fullmatch(text):  # ISO 8601, day of the year
            return (datetime(int(m[1]), 1, 1) - _EPOCH).days + int(m[2]) - 1
        # for a missing part of a date the parser takes its default
        both = {
            parser.parse(text, default=datetime(year, year % 9 + 1, 3 + year % 9)) for year in (1970, 2004)
        }
        return (both.pop() - _EPOCH).days if len(both) == 1 else None
    except (ValueError, OverflowError, TypeError):
        return None


def _read_gps(week: NDArray[Any], second: NDArray[Any], where: str) -> NDArray[np.datetime64]:
    """Instants, in GPS time."""
    if week.dtype.kind != "f" or second.dtype.kind != "f":
        raise _refuse(where, (second if week.dtype.kind == "f" else week)[0], "as week and seconds")
    present = np.isfinite(week) & np.isfinite(second)
    w, s = np.where(present, (week, second), 0.0)
    wrong = (w != np.rint(w)) | (w < 0) | (w > 9999) | (s < 0) | (s > 604800 + 1)
    if wrong.any():
        stamp = f"week {w[wrong][0]:g}, {s[wrong][0]:g} s"
        raise _refuse(where, stamp, "as a whole week and seconds in it")
    weeks = int(GPS_EPOCH.timestamp()) * _SECOND + w.astype(np.int64) * 7 * _DAY
    return np.where(present, weeks + np.rint(s * 1e9).astype(np.int64), _NONE).view("M8[ns]")


def _refuse(where: str, stamp: object, row: str) -> UserError:
    shown = str(stamp)
    return UserError(
        "the instant cannot be read",
        where=where,
        found=f"{row}: {shown[:60]!r}" + "..." * (len(shown) > 60),
        expected="; ".join(example for _, example in WAYS.values()) + "; or plain seconds",
        remedy="specify the format in a mapping ([time] format = ...), or write ISO 8601",
    )
