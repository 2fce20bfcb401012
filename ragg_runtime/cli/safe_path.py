"""No code from the current folder: what ``python -m`` looks up there first is left out.

``python -m ragg_runtime`` puts the current folder in front of everything that is imported from then on; in a folder
that somebody sent, a ``click.py`` or ``generated/`` would be executed. This module imports nothing that such a
folder could stand in for: ``os`` and ``sys`` are there before any program begins.
"""

from __future__ import annotations

import os
import sys


def without_current_folder() -> None:
    """Drop the entry that ``python -m`` made, unless it is where this very program was imported from."""
    if sys.flags.safe_path or not sys.path:
        return
    own = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    try:
        here = os.getcwd()
    except OSError:  # the folder is gone, and nothing can be imported from it
        return
    if sys.path[0] in ("", here) and os.path.realpath(here) != os.path.realpath(own):
        del sys.path[0]
