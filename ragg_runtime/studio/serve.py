"""The server: on this machine alone, until it is interrupted."""

from __future__ import annotations

import contextlib
import socket
import sys
import webbrowser
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import uvicorn

from ragg_runtime.base.errors import UserError
from ragg_runtime.studio.guard import Guard, Keys
from ragg_runtime.studio.opening import remove_opening, write_opening
from ragg_runtime.studio.places import Places
from ragg_runtime.studio.routes import UPLOAD, application
from ragg_runtime.studio.session import Session

LOOPBACK = "127.0.0.1"

SWITCH = 0.0005
"""How long a thread that computes may keep one waiting that answers the page, s."""

CLOSING = 1
"""Longest wait for open pages once it is interrupted, s."""


def serve(
    model: Path | None,
    flights: Sequence[Path],
    port: int,
    say: Callable[[str], None],
    *,
    browser: bool,
) -> None:
    """Open model and flights and serve the page; ``say`` is told its address once."""
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
            proxy_headers=False,
            lifespan="off",
            ws="none",
            timeout_graceful_shutdown=CLOSING,
        )
        address = f"http://{LOOPBACK}:{own}/?token={keys.token}"
        say(address)
        if model is not None:
            session.open(model, flights)
        if browser:
            page = write_opening(f"http://{LOOPBACK}:{own}/", keys.token)
            keys.forget = partial(remove_opening, page)
            webbrowser.open(page.as_uri())
        with contextlib.suppress(KeyboardInterrupt):  # which is how one ends it: what was done is kept
            _Server(config, keys).run(sockets=[listening])
        session.jobs.cancel()


class _Server(uvicorn.Server):
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
