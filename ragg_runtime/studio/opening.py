"""The page that hands the token over to the server: a file that nobody else may read, so that no command line holds the token.

A browser's command line is seen by every user of the machine, and the first to come with the token has the studio.
"""

from __future__ import annotations

import contextlib
import html
import os
import tempfile
from pathlib import Path

import platformdirs

_PAGE = """<!doctype html>
<meta charset="utf-8">
<meta name="referrer" content="no-referrer">
<title>ragg studio</title>
<form method="post" action="{address}"><input type="hidden" name="token" value="{token}"><button>Open ragg studio</button></form>
<script>document.forms[0].submit()</script>
"""


def write_opening(address: str, token: str) -> Path:
    """A file of mode 0600, in a folder of its own, that posts the token to the address."""
    folder = Path(tempfile.mkdtemp(prefix="ragg-studio-", dir=_runtime_folder()))
    page = folder / "open.html"
    with open(os.open(page, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w", encoding="utf-8") as f:
        f.write(_PAGE.format(address=html.escape(address), token=html.escape(token)))
    return page


def remove_opening(page: Path) -> None:
    """Take it away, if it is still there."""
    with contextlib.suppress(OSError):
        page.unlink(missing_ok=True)
        page.parent.rmdir()


def _runtime_folder() -> Path | None:
    """The user's own folder for what lives as long as a session; ``None``: there is none, the temporary files' serves."""
    folder = platformdirs.user_runtime_path()
    try:
        known = folder.stat()
    except OSError:
        return None
    return (
        folder
        if hasattr(os, "getuid") and known.st_uid == os.getuid() and not known.st_mode & 0o077
        else None
    )
