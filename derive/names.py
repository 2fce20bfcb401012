"""Names that files give to effects, parameters, channels, discs, accelerometers and outputs, and what they become in code."""

from __future__ import annotations

import re

LONGEST = 64
EXPECTED = f"a letter, then letters, digits, _ or -; {LONGEST} at most"
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_ID = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
_PARAMETER = re.compile(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*")


def is_name(x: object) -> bool:
    """Whether this may be a name."""
    return isinstance(x, str) and len(x) <= LONGEST and _NAME.fullmatch(x) is not None


def id_in_code(identifier: str) -> str:
    """What an effect's id is in names of generated code; of two ids two names, neither with ``__``."""
    # X is in no id of small letters, so that a-b and a_b do not meet.
    return identifier.replace("-", "_") if _ID.fullmatch(identifier) else "X" + _spell(identifier)


def parameter_in_code(identifier: str, name: str) -> str:
    """What a parameter of an effect is in generated code."""
    spelling = name if _PARAMETER.fullmatch(name) else "X__" + _spell(name)
    return f"{id_in_code(identifier)}__{spelling}"


def channel_in_code(column: str) -> str:
    """What a recorded channel is in generated code that has no name for it; :func:`channel_of` is the way back."""
    return f"H__{_spell(column)}" if "-" in column else f"C__{column}"


def channel_of(name: str) -> str:
    """The recorded channel that has this name in generated code."""
    if name.startswith("H__"):
        return name[3:].replace("_1", "-").replace("_0", "_")
    return name.removeprefix("C__")


def _spell(name: str) -> str:
    """A name without hyphens that marks which of its underscores were hyphens."""
    return name.replace("_", "_0").replace("-", "_1")


def in_comment(x: object) -> str:
    """Text that ends no comment or string of C, Python or LaTeX, and no line."""
    text = "".join(c if c.isprintable() and c != "\\" else "_" for c in str(x)).replace('"', "'")
    return text.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?")
