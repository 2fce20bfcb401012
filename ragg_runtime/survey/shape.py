"""The shape of a flight's record: what a results file holds may have been written by anyone.

:func:`misshapen` says where a record is not what :func:`ragg_runtime.survey.task.examine` tells of a flight.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ragg_runtime.survey.summary import VERDICTS
from ragg_runtime.survey.task import LANDMARKS

Check = Callable[[Any], str | None]
"""Where a value is not as it should be (a path below it), or ``None``."""

LARGEST = 1e60
"""Beyond any quantity of a record in SI or in its display units; squares and their products stay finite."""


def misshapen(record: Mapping[str, Any]) -> str | None:
    """Where the record of a flight that was diagnosed is none; ``None`` if it is one."""
    return _RECORD(record) or (None if _named_after(record["flight"], Path(record["file"])) else ".flight")


def _named_after(flight: str, file: Path) -> bool:
    """Whether a flight has the name of its file, with folders before it where others have that name too."""
    return bool(flight) and f"/{file.as_posix()}".endswith(f"/{flight.lstrip('/')}")


def _is(kind: Callable[[Any], bool]) -> Check:
    return lambda x: None if kind(x) else ""


def _text(x: Any) -> bool:
    return isinstance(x, str)


def _line(x: Any) -> bool:
    return isinstance(x, str) and x.isprintable()


def _number(x: Any) -> bool:
    return isinstance(x, int | float) and not isinstance(x, bool) and abs(x) < LARGEST


def _whole(x: Any) -> bool:
    return isinstance(x, int) and not isinstance(x, bool) and 0 <= x < 1 << 53


def _maybe(check: Check) -> Check:
    return lambda x: None if x is None else check(x)


def _each(check: Check) -> Check:
    def checked(x: Any) -> str | None:
        if not isinstance(x, list):
            return ""
        return next((f"[{n}]{bad}" for n, y in enumerate(x) if (bad := check(y)) is not None), None)

    return checked


def _named(check: Check) -> Check:
    def checked(x: Any) -> str | None:
        if not isinstance(x, dict):
            return ""
        return next((f".{n}{bad}" for n, y in x.items() if (bad := check(y)) is not None), None)

    return checked


def _fields(**checks: Check) -> Check:
    """An object with these keys; others are left alone."""

    def checked(x: Any) -> str | None:
        if not isinstance(x, dict):
            return ""
        for name, check in checks.items():
            if name not in x:
                return f".{name}"
            bad = check(x[name])
            if bad is not None:
                return f".{name}{bad}"
        return None

    return checked


def _optional(name: str, check: Check) -> Check:
    return lambda x: None if name not in x or (bad := check(x[name])) is None else f".{name}{bad}"


def _all(*checks: Check) -> Check:
    return lambda x: next((bad for check in checks if (bad := check(x)) is not None), None)


def _landmarks(x: Any) -> str | None:
    bad = _all(
        _fields(
            rate=_is(lambda v: _number(v) and v > 1.0 / LARGEST),
            rows=_each(_is(_whole)),
            columns=_named(_each(_maybe(_is(_number)))),
            digit=_named(_is(_number)),
            spread=_named(_maybe(_is(_number))),
        )
    )(x)
    if bad is not None:
        return bad
    sizes = {len(v) for v in x["columns"].values()}
    same = sizes <= {len(x["rows"])} and set(x["columns"]) <= set(x["digit"]) & set(x["spread"])
    return None if same else ".columns"


_TEXT, _LINE, _NUMBER, _MAYBE = _is(_text), _is(_line), _is(_number), _maybe(_is(_number))
_ERROR = _all(_named(_MAYBE), _fields(rms_Eo=_MAYBE))
_SPREAD = _is(lambda v: v == 0 or (_number(v) and v > 1.0 / LARGEST))
_PARAMETER = _fields(
    name=_LINE, accelerometer=_maybe(_is(_whole)), value=_MAYBE, std=_maybe(_SPREAD), unit=_LINE
)
_RECORD = _all(
    _fields(
        flight=_TEXT,
        file=_TEXT,
        sha256=_LINE,
        samples=_is(_whole),
        duration_s=_NUMBER,
        rate_Hz=_NUMBER,
        notes=_each(_TEXT),
        verdict=_is(lambda v: v in VERDICTS if isinstance(v, str) else False),
        found=_each(_LINE),
        indistinguishable=_named(_each(_LINE)),
        ranking=_each(_fields(effect=_LINE, log10_p=_MAYBE, delta_bic=_MAYBE)),
        not_testable=_each(_LINE),
        error=_fields(
            nominal=_ERROR,
            calibrated=_ERROR,
            holdout=_maybe(_ERROR),
            after=_ERROR,
            after_holdout=_maybe(_ERROR),
        ),
        noise_floor=_fields(rms_Eo=_NUMBER),
        parameters=_each(_PARAMETER),
    ),
    _optional("terms", _each(_fields(harmonic=_LINE, term=_LINE))),
    _optional(LANDMARKS, _landmarks),
)
