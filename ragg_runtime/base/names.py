"""Names that a file gives: identifiers, or refused where they are read."""

from __future__ import annotations

from derive.names import EXPECTED, LONGEST, in_comment, is_name
from ragg_runtime.base.errors import UserError

__all__ = ["EXPECTED", "LONGEST", "in_comment", "is_column", "is_name", "read_name"]

_SHOWN = 80
"""Letters of what is no name that a message repeats."""


def read_name(found: object, where: str, example: str | None = None) -> str:
    """``found``, from ``where`` (file and key); UserError if it is not a name."""
    if isinstance(found, str) and is_name(found):
        return found
    raise UserError(
        "not a name",
        where=where,
        found=repr(found)[:_SHOWN],
        expected=EXPECTED + ("" if example is None else f", such as {example}"),
    )


def is_column(name: str) -> bool:
    """Whether a column may be a channel, an output, a voltage or a disc's angle."""
    return is_name(name.removeprefix("V_").removeprefix("spin_angle_")) or is_name(name)
