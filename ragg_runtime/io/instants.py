"""Instants as files write them, in seconds: ISO 8601, dates and clock, hh:mm:ss, GPS week and seconds."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from types import MappingProxyType
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.io.record import Array

Nanoseconds = NDArray[np.int64]

GPS_EPOCH = datetime(1980, 1, 6, tzinfo=UTC)
"""Week 0 of GPS time; it counts no leap seconds (Interface Control Document IS-GPS-200, 20.3.3.3)."""

_DAY = 86400 * 10**9
_NONE = np.iinfo(np.int64).min
_CLOCK = re.compile(r"\s*(\d{1,2}):([0-5]?\d)(?::([0-5]?\d(?:[.,]\d*)?|60(?:[.,]\d*)?))?\s*")
_DATE = re.compile(r"\s*\d{4}[-/]\d{1,2}[-/]\d{1,2}([T ]\s*\d.*)?", re.DOTALL)
_ROLLED = _DAY // 2  # a clock that falls back by more has passed midnight


def is_instant(text: str) -> bool:
    """Whether a text is an ISO date, with or without a time, or a time of the day."""
    return _DATE.fullmatch(text) is not None or is_clock(text)


def is_clock(text: str) -> bool:
    """Whether a text is hh:mm or hh:mm:ss."""
    return _CLOCK.fullmatch(text) is not None


def _iso(values: NDArray[Any], where: str) -> Nanoseconds:
    """Nanoseconds since 1970 of ISO 8601 texts; what has no zone counts as UTC."""
    if values.dtype.kind == "M":
        return values.astype("datetime64[ns]").astype(np.int64)
    texts = [str(t).strip().replace("/", "-").replace(",", ".") for t in values]
    texts = [re.sub(r"(\.\d{9})\d+", r"\1", t) for t in texts]
    for zone in (None, "UTC"):
        try:
            column = pa.array([t or None for t in texts]).cast(pa.string()).cast(pa.timestamp("ns", tz=zone))
        except pa.ArrowException:
            continue
        return np.asarray(column.cast(pa.int64()).fill_null(_NONE).to_numpy(zero_copy_only=False), np.int64)
    wrong = next((t for t in texts if t and _DATE.fullmatch(t) is None), texts[0])
    raise _unreadable(where, wrong, "2026-03-01T12:00:00.5Z, all with a zone or all without")


def _clock(values: NDArray[Any], where: str) -> Nanoseconds:
    """Nanoseconds since midnight of hh:mm:ss as text, or of hhmmss.s as numbers."""
    if values.dtype.kind == "f":
        there = np.isfinite(values)
        v = np.where(there, values, 0.0)
        hours, minutes = np.floor(v / 1e4), np.floor(v % 1e4 / 100)
        wrong = (v < 0) | (hours > 24) | (minutes >= 60) | (v % 100 >= 61)
        if wrong.any():
            raise _unreadable(where, float(v[wrong][0]), "hhmmss.s, such as 132850.4")
        second = np.rint((v % 100) * 1e6).astype(np.int64) * 1000  # a number of this size has 1e-10 s
        total = (hours * 3600 + minutes * 60).astype(np.int64) * 10**9 + second
        return np.where(there, total, _NONE)
    found = np.empty(len(values), dtype=np.int64)
    for n, text in enumerate(values):
        match = _CLOCK.fullmatch(str(text))
        if match is None:
            if str(text).strip():
                raise _unreadable(where, text, "hh:mm:ss, such as 13:28:50.4")
            found[n] = _NONE
            continue
        fraction = float((match[3] or "0").replace(",", "."))
        found[n] = (int(match[1]) * 3600 + int(match[2]) * 60) * 10**9 + round(fraction * 1e9)
    return found


def _date(values: NDArray[Any], where: str) -> Nanoseconds:
    """Nanoseconds since 1970 of the midnight of yyyy-mm-dd as text, or of yyyymmdd as numbers."""
    if values.dtype.kind == "f":
        texts = np.array([f"{v:.0f}" if np.isfinite(v) else "" for v in values], dtype=object)
    else:
        texts = np.array([str(v).strip() for v in values], dtype=object)
    days: dict[str, str] = {}
    for text in dict.fromkeys(texts):
        plain = text.replace("/", "-")
        if re.fullmatch(r"\d{8}", plain):
            plain = f"{plain[:4]}-{plain[4:6]}-{plain[6:]}"
        if text and re.fullmatch(r"\d{4}-\d{2}-\d{2}", plain) is None:
            raise _unreadable(where, text, "yyyymmdd or yyyy-mm-dd")
        days[text] = plain
    return _iso(np.array([days[t] for t in texts], dtype=object), where)


def _gps(week: NDArray[Any], second: NDArray[Any], where: str) -> Nanoseconds:
    """Nanoseconds since 1970, in GPS time."""
    if week.dtype.kind != "f" or second.dtype.kind != "f":
        raise _unreadable(
            where, week[0] if week.dtype.kind != "f" else second[0], "a week and seconds, as numbers"
        )
    there = np.isfinite(week) & np.isfinite(second)
    w, s = np.where(there, week, 0.0), np.where(there, second, 0.0)
    wrong = (np.abs(w - np.rint(w)) > 0) | (w < 0) | (w > 9999) | (s < 0) | (s > 604800 + 1)
    if wrong.any():
        raise _unreadable(
            where,
            f"week {w[wrong][0]:g}, {s[wrong][0]:g} s",
            "a whole week, and seconds from 0 to 604800 in it",
        )
    epoch = int(GPS_EPOCH.timestamp()) * 10**9
    total = epoch + w.astype(np.int64) * 7 * _DAY + np.rint(s * 1e9).astype(np.int64)
    return np.where(there, total, _NONE)


def _date_clock(date: NDArray[Any], clock: NDArray[Any], where: str) -> Nanoseconds:
    day, time = _date(date, where), _clock(clock, where)
    return np.where((day == _NONE) | (time == _NONE), _NONE, day + time)


@dataclass(frozen=True)
class Way:
    """A way in which instants are written: how many columns it takes, and how they become nanoseconds."""

    columns: int
    read: Callable[..., Nanoseconds]
    dated: bool
    example: str


WAYS: Mapping[str, Way] = MappingProxyType(
    {
        "iso": Way(columns=1, read=_iso, dated=True, example="2026-03-01T12:00:00.5Z"),
        "clock": Way(columns=1, read=_clock, dated=False, example="13:28:50.4 or 132850.4"),
        "date clock": Way(columns=2, read=_date_clock, dated=True, example="20260301 and 13:28:50.4"),
        "gps": Way(columns=2, read=_gps, dated=True, example="week 2407 and 43200.5 s"),
    }
)
"""The formats that ``[time] format`` in a mapping may name, beside plain seconds."""


def seconds(
    way: Way, columns: Sequence[NDArray[Any]], where: str, origin: datetime | None = None
) -> tuple[Array, datetime | None]:
    """(N,) s, NaN where nothing stands, and where they begin: ``origin``, or the midnight before the first instant."""
    total = way.read(*columns, where)
    there = total != _NONE
    if way.dated:
        origin = origin or midnight(total)
        total = np.where(there, total - _nanoseconds(origin), total)
    else:
        values = total[there]
        total[there] = values + np.cumsum(np.diff(values, prepend=values[:1]) < -_ROLLED) * _DAY
    return np.where(there, total / 1e9, np.nan), origin


def midnight(total: Nanoseconds) -> datetime | None:
    """The midnight before the first instant; ``None`` if there is none."""
    there = total[total != _NONE]
    if not len(there):
        return None
    return datetime(1970, 1, 1, tzinfo=UTC) + timedelta(days=int(there[0] // _DAY))


def way_of(values: NDArray[Any]) -> Way | None:
    """How instants in one column of text are written; ``None`` if they are none."""
    if values.dtype.kind == "M":
        return WAYS["iso"]
    text = next((str(t) for t in values if str(t).strip()), "")
    if is_clock(text):
        return WAYS["clock"]
    return WAYS["iso"] if is_instant(text) else None


def _nanoseconds(instant: datetime | None) -> int:
    if instant is None:
        return 0
    return (instant - datetime(1970, 1, 1, tzinfo=UTC)) // timedelta(microseconds=1) * 1000


def _unreadable(where: str, found: object, expected: str) -> UserError:
    shown = str(found)
    return UserError(
        "the instant cannot be read",
        where=where,
        found=repr(shown if len(shown) <= 60 else shown[:60] + "..."),
        expected=expected,
        remedy="say in a mapping how time is written: ragg map FLIGHT -o mapping.toml",
    )
