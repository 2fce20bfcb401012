"""The server of the studio: for one user on this machine, one token and then a cookie, until it is interrupted."""

from __future__ import annotations

import asyncio
import contextlib
import secrets
import socket
import webbrowser
from collections.abc import Callable, Sequence
from http.cookies import CookieError, SimpleCookie
from pathlib import Path
from urllib.parse import parse_qs

import h11
import uvicorn
from starlette.datastructures import Headers
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from ragg_runtime.base.errors import UserError
from ragg_runtime.studio.files import Places
from ragg_runtime.studio.routes import UPLOAD, make_application
from ragg_runtime.studio.session import Session

LOOPBACK = "127.0.0.1"

CLOSING = 1  # longest wait for open pages once it is interrupted, s
WHOLE = 10.0  # how long a request may take to arrive, s; of a file, how long nothing may arrive
BODY = 1 << 20  # longest body of a request, bytes; files have a limit of their own

ONCE = "open the address that `ragg studio` printed; it works once: start it again for a new one"

HEADERS = {
    # nothing from elsewhere, no code and no style inside the page itself
    "content-security-policy": "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:;"
    " connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-store",
}

# for an SVG, whose styles are attributes; it can neither run code nor load anything
PICTURE = {"content-security-policy": "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'"}


def serve(
    model: Path | None, flights: Sequence[Path], port: int, say: Callable[[str], None], *, browser: bool
) -> None:
    """Open model and flights and serve the page; ``say`` is called with its address once."""
    for path in (*([model] if model else []), *flights):
        if not path.exists():
            raise UserError("there is no such file or folder", where=path)
    session = Session(Places.of(model, flights))
    with _listen(port) as listening:
        bound_port = int(listening.getsockname()[1])
        guard = Guard(make_application(session), bound_port, (UPLOAD,))
        config = uvicorn.Config(
            guard,
            log_level="warning",
            access_log=False,  # the token does not belong in a log
            server_header=False,
            proxy_headers=False,
            lifespan="off",
            ws="none",
            http=Connection,
            timeout_graceful_shutdown=CLOSING,
        )
        if model is not None:
            session.open(model, flights)  # first: a page that is opened at once finds it being read
        address = f"http://{LOOPBACK}:{bound_port}/?token={guard.token}"
        say(address)
        if browser:
            webbrowser.open(address)
        with contextlib.suppress(KeyboardInterrupt):  # which is how one ends it: what was done is kept
            uvicorn.Server(config).run(sockets=[listening])
        session.jobs.cancel()
        session.jobs.wait(WHOLE)  # a thread that is in compiled code when Python ends aborts the process


def _listen(port: int) -> socket.socket:
    """A socket on the loopback alone; 0 takes a free port."""
    listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((LOOPBACK, port))
    except OSError as error:
        listening.close()
        remedy = "choose another with --port"
        raise UserError(
            "the port cannot be used", where=str(port), found=error.strerror, remedy=remedy
        ) from None
    listening.listen(128)
    return listening


class Connection(H11Protocol):
    """A connection that is closed where a request does not arrive within ``WHOLE``."""

    _end: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self._end = self.loop.call_later(WHOLE, transport.close)

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        is_coming = self.conn.their_state in (h11.IDLE, h11.SEND_BODY)
        if self._end and (not is_coming or (self.scope and self.scope["path"] == UPLOAD)):
            self._end.cancel()
            self._end = None
        if is_coming and not self._end:
            self._end = self.loop.call_later(WHOLE, self.transport.close)

    def connection_lost(self, exc: Exception | None) -> None:
        if self._end:
            self._end.cancel()
        super().connection_lost(exc)


class Guard:
    """Lets through what comes from our own page; ``uploads`` are the paths whose bodies may be long.

    The token of the address serves once, and is exchanged for the secret of a cookie.
    """

    def __init__(self, app: ASGIApp, port: int, uploads: tuple[str, ...] = ()) -> None:
        self.token = secrets.token_urlsafe(32)
        self._app, self._uploads, self._secret, self._used = app, uploads, secrets.token_urlsafe(32), False
        self._hosts = (f"{LOOPBACK}:{port}", f"localhost:{port}")
        self._cookie = f"ragg-studio-{port}"

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http":  # there is no websocket here
            await (self._refuse(scope) or self._app)(scope, receive, _add_headers(send))

    def _refuse(self, scope: Scope) -> Response | None:
        """An answer in the place of the application's; ``None``: the request may pass."""
        headers, path, safe = Headers(scope=scope), scope["path"], scope["method"] in ("GET", "HEAD")
        host, origin = headers.get("host", ""), headers.get("origin")
        if host not in self._hosts:
            return _answer_refused("this server answers to 127.0.0.1 only", 421)
        if origin != f"http://{host}" and not (safe and origin is None):
            return _answer_refused("the request comes from another site, or does not say from where")
        length = headers.get("content-length", "0" if safe else "")
        if not length.isdecimal() or (int(length) > BODY and path not in self._uploads):
            return _answer_refused("the request is too long, or has no length", 413)
        if self._is_known(headers):
            return RedirectResponse("/", 303) if path == "/" and scope["query_string"] else None
        if path == "/" and scope["method"] == "GET":
            token = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
            if secrets.compare_digest(token.encode(), self.token.encode()) and not self._used:
                self._used = True
                response = RedirectResponse("/", 303)  # the token does not stay in the address
                response.set_cookie(self._cookie, self._secret, httponly=True, samesite="strict", path="/")
                return response
        return _answer_refused(ONCE)

    def _is_known(self, headers: Headers) -> bool:
        try:
            cookie = SimpleCookie(headers.get("cookie", "")).get(self._cookie)
        except CookieError:
            return False
        return cookie is not None and secrets.compare_digest(cookie.value.encode(), self._secret.encode())


def _add_headers(send: Send) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            picture = (b"content-type", b"image/svg+xml") in message["headers"]
            fixed = {k.encode(): v.encode() for k, v in (HEADERS | PICTURE if picture else HEADERS).items()}
            further = [(k, v) for k, v in message["headers"] if k.lower() not in fixed]
            message = {**message, "headers": [*further, *fixed.items()]}
        await send(message)

    return sent


def _answer_refused(reason: str, status: int = 403) -> Response:
    return PlainTextResponse(f"refused: {reason}\n", status)
