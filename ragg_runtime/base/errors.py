"""The one error that a user sees: what is wrong, where, found, expected, remedy; and checks of values read from files."""

from __future__ import annotations

import difflib
import functools
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from derive.names import EXPECTED, is_name


class UserError(Exception):
    """Bad input or usage: what is wrong (no full stop), where, what was found, what is expected, and the remedy."""

    def __init__(
        self,
        what: str,
        *,
        where: str | Path | None = None,
        found: object = None,
        expected: object = None,
        remedy: str | None = None,
    ) -> None:
        self.what = what
        self.where = None if where is None else one_line(str(where))  # names of files may hold anything
        self.found = None if found is None else str(found)
        self.expected = None if expected is None else str(expected)
        self.remedy = remedy
        super().__init__(self.message)

    @property
    def facts(self) -> dict[str, Any]:
        """Its parts by name."""
        return {k: getattr(self, k) for k in ("what", "where", "found", "expected", "remedy")}

    @property
    def message(self) -> str:
        """The whole message, one fact per line."""
        head = self.what if self.where is None else f"{self.where}: {self.what}"
        facts = (("found", self.found), ("expected", self.expected), ("remedy", self.remedy))
        # Further lines of a fact are indented: names in it could otherwise pass for another fact.
        lines = (f"  {name}: {text}".replace("\n", "\n    ") for name, text in facts if text is not None)
        return "\n".join([head, *lines])

    def __reduce__(self) -> tuple[Callable[..., UserError], tuple[()]]:
        # Keyword arguments would be lost between processes otherwise.
        return functools.partial(UserError, **self.facts), ()


EXTRAS = {
    **dict.fromkeys(("h5netcdf", "h5py", "openpyxl"), "files"),
    **dict.fromkeys(("starlette", "uvicorn"), "studio"),
    "distributed": "cluster",
    "matplotlib": "plots",
}
"""Package -> the extra of this project that brings it."""


def missing_package(error: BaseException) -> UserError | None:
    """A UserError that says what to install, if an optional package is missing; else ``None``."""
    if isinstance(error.__cause__, ModuleNotFoundError):  # pandas wraps it
        error = error.__cause__
    name = (error.name or "").split(".")[0] if isinstance(error, ModuleNotFoundError) else ""
    if name not in EXTRAS:
        return None
    return UserError(
        f"this needs {name}, which is not installed", remedy=f"pip install 'ragg[{EXTRAS[name]}]'"
    )


def at(*places: object) -> str:
    """Join file, table and key into one place: ``model.toml: [disc] radius``."""
    return ": ".join(str(p) for p in places if p is not None and str(p))


def count(number: int, what: str) -> str:
    """So many of something, in words: ``1 row``, ``2 rows``."""
    return f"{number} {what}{'s' * (number != 1)}"


def did_you_mean(name: str, choices: Iterable[str]) -> str | None:
    """A remedy that names the closest known name, or ``None``."""
    choices = list(choices)
    folded = {k.casefold(): k for k in reversed(choices)}
    near = difflib.get_close_matches(name.casefold(), list(folded), n=1, cutoff=0.6)
    return f"did you mean {folded[near[0]]!r}?" if near else None


def check_keys(keys: Iterable[object], allowed: Iterable[str], where: str | Path | None = None) -> None:
    """UserError at the first key that is none of the known ones."""
    allowed = list(allowed)
    for key in keys:
        if key not in allowed:
            raise UserError(
                f"unknown key {str(key)[:60]!r}",
                where=where,
                expected="one of " + ", ".join(allowed),
                remedy=did_you_mean(str(key)[:60], allowed),
            )


def check_table(table: object, what: str, where: str | Path | None, expected: str) -> dict[str, Any]:
    """``table``; UserError if it is no table of TOML."""
    if not isinstance(table, dict):
        raise UserError(f"{what} must be a table", where=where, found=repr(table)[:60], expected=expected)
    return table


def check_choice(value: object, choices: Sequence[object], where: str, what: str = "no such choice") -> Any:
    """``value``, if it is one of the ``choices``, of the same type (true is no 1); else UserError."""
    for choice in choices:
        if type(value) is type(choice) and value == choice:
            return choice
    expected = " or ".join(f'"{v}"' if isinstance(v, str) else str(v).lower() for v in choices)
    near = did_you_mean(value, [v for v in choices if isinstance(v, str)]) if isinstance(value, str) else None
    raise UserError(what, where=where, found=repr(value)[:60], expected=expected, remedy=near)


def printable(text: str) -> str:
    """``text`` without control sequences of terminals: names in files may hold anything."""
    return "".join(c if c.isprintable() or c in "\n\t" else c.encode("unicode_escape").decode() for c in text)


def one_line(text: str) -> str:
    """As :func:`printable`, line ends and tabs too: a name of several lines could pass for further messages."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def read_name(value: object, where: str, example: str | None = None) -> str:
    """``value``, from ``where`` (file and key); UserError if it is not a name."""
    if isinstance(value, str) and is_name(value):
        return value
    raise UserError(
        "not a name",
        where=where,
        found=repr(value)[:80],
        expected=EXPECTED + ("" if example is None else f", such as {example}"),
    )


def is_column(name: str) -> bool:
    """Whether a column may be a channel, an output, a voltage or a disc's angle."""
    return is_name(name.removeprefix("V_").removeprefix("spin_angle_")) or is_name(name)
