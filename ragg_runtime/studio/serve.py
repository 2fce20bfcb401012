"""The server: on this machine alone, until it is interrupted."""

from __future__ import annotations

import asyncio
import contextlib
import html
import os
import socket
import sys
import tempfile
import webbrowser
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import platformdirs
import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

from ragg_runtime.base.errors import UserError
from ragg_runtime.studio.guard import UNFINISHED, Guard, Keys
from ragg_runtime.studio.routes import UPLOAD, application
from ragg_runtime.studio.session import Places, Session

LOOPBACK = "127.0.0.1"

SWITCH = 0.0005
"""How long a thread that computes may keep one waiting that answers the page, s."""

CLOSING = 1
"""Longest wait for open pages once it is interrupted, s."""


def serve(
    model: Path | None, flights: Sequence[Path], port: int, say: Callable[[str], None], *, browser: bool
) -> None:
    """Open model and flights and serve the page; ``say`` is called with its address once."""
    for path in (*([model] if model else []), *flights):
        if not path.exists():
            raise UserError("there is no such file or folder", where=path)
    sys.setswitchinterval(SWITCH)
    session = Session(Places.of(model, flights))
    with _listening(port) as listening:
        keys = Keys()
        own = int(listening.getsockname()[1])
        app = Guard(application(session), keys, own, (UPLOAD,))
        config = uvicorn.Config(
            app,
            log_level="warning",
            access_log=False,  # the token does not belong in a log
            server_header=False,
            http=Connection,
            proxy_headers=False,
            lifespan="off",
            ws="none",
            timeout_graceful_shutdown=CLOSING,
        )
        address = f"http://{LOOPBACK}:{own}/?token={keys.token}"
        if model is not None:
            session.open(model, flights)  # first: a page that is opened at once finds it being read
        say(address)
        if browser:
            page = write_opening(f"http://{LOOPBACK}:{own}/", keys.token)
            keys.forget = partial(remove_opening, page)
            webbrowser.open(page.as_uri())
        with contextlib.suppress(KeyboardInterrupt):  # which is how one ends it: what was done is kept
            StudioServer(config, keys).run(sockets=[listening])
        session.jobs.cancel()


class Connection(H11Protocol):
    """A connection that is closed if the head of a request is not complete after :data:`UNFINISHED` seconds."""

    deadline: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self._wait()

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        if self._waits:
            self._wait()
        elif self.deadline is not None:
            self.deadline.cancel()
            self.deadline = None

    @property
    def _waits(self) -> bool:
        return self.cycle is None or self.cycle.response_complete

    def _wait(self) -> None:
        if self.deadline is None:
            self.deadline = self.loop.call_later(UNFINISHED, self._expire)

    def _expire(self) -> None:
        self.deadline = None
        if self._waits and not self.transport.is_closing():
            self.transport.close()


class StudioServer(uvicorn.Server):
    """One that leaves no token behind, however it is ended."""

    def __init__(self, config: uvicorn.Config, keys: Keys) -> None:
        super().__init__(config)
        self._keys = keys

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._keys.forget()
        await super().shutdown(sockets)


def _listening(port: int) -> socket.socket:
    """A socket on the loopback alone; 0 takes a free port."""
    made = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        made.bind((LOOPBACK, port))
    except OSError as error:
        made.close()
        raise UserError(
            "the port cannot be used",
            where=str(port),
            found=error.strerror,
            remedy="choose another with --port",
        ) from None
    made.listen(128)
    return made


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
