"""Where the program meets the system: every refusal of the system ends in one message with its place."""

from __future__ import annotations

import os
import sys

from ragg_runtime.base.errors import one_line


def refusal(error: OSError) -> str:
    """What the system refused, and where, in one line."""
    try:
        os.getcwd()
    except OSError:
        return "the current folder is no longer there: change into one that is"
    places = [os.fsdecode(p) for p in (error.filename, error.filename2) if isinstance(p, (str, bytes))]
    what = error.strerror or (str(error).splitlines() or [type(error).__name__])[0]
    return one_line(": ".join([" and ".join(places), what] if places else [what]))


def hold_streams() -> None:
    """Put the null device in place of closed standard streams: the next file would be taken for one of them."""
    for number, flags in ((0, os.O_RDONLY), (1, os.O_WRONLY), (2, os.O_WRONLY)):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, flags)  # the lowest free number, which is this one
    # Python has none where it found them closed. Without stdout no result can be told: commands say so (cli.outputs).
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
