"""Who may ask the studio: one token, then a cookie; only from the page itself, and only to 127.0.0.1."""

from __future__ import annotations

import asyncio
import math
import secrets
from collections.abc import Callable
from dataclasses import dataclass, field
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs

from starlette.datastructures import Headers
from starlette.responses import HTMLResponse, PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

UNFINISHED = 10.0
"""Longest wait for the rest of a request, s."""

BODY = 1 << 20
"""Longest body of a request, bytes; files have a limit of their own."""

POSTED = 1 << 10
"""Longest body that hands over the token, bytes."""

ONCE = "open the address that `ragg studio` printed; it serves once: start it again for a new one"

POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self'",
        "img-src 'self' data: blob:",
        "connect-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
        "frame-ancestors 'none'",
    )
)
"""Content security policy: nothing from elsewhere, no code and no style inside the page itself."""

HEADERS = {
    "content-security-policy": POLICY,
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-store",
}


@dataclass
class Keys:
    """The one-time token of the address and the secret of the cookie it is exchanged for; ``forget`` is called when it is."""

    token: str = field(default_factory=lambda: secrets.token_urlsafe(32))
    cookie: str = field(default_factory=lambda: secrets.token_urlsafe(32))
    used: bool = False
    forget: Callable[[], None] = lambda: None

    def exchange(self, token: str) -> bool:
        """Whether this is the token, for the first time."""
        good = secrets.compare_digest(token.encode(), self.token.encode()) and not self.used
        self.used = self.used or good
        if good:
            self.forget()
        return good


class Guard:
    """Lets through what comes from our own page. ``uploads`` are the paths whose bodies may be long."""

    def __init__(self, app: ASGIApp, keys: Keys, port: int, uploads: tuple[str, ...] = ()) -> None:
        self._app, self._keys, self._uploads = app, keys, uploads
        self._hosts = (f"127.0.0.1:{port}", f"localhost:{port}")
        self._name = f"ragg-studio-{port}"

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":  # there is no websocket here
            return
        refusal = await self._posted(scope, receive) or self._refusal(scope)
        await (refusal or self._inner)(scope, receive, _with_headers(send))

    async def _posted(self, scope: Scope, receive: Receive) -> Response | None:
        """The answer to the file that the browser was opened with (its origin is none); ``None``: this is no such request."""
        headers = Headers(scope=scope)
        if (scope["method"], scope["path"]) != ("POST", "/") or headers.getlist("host") != [self._hosts[0]]:
            return None
        body, more = b"", True
        while more and len(body) <= POSTED:
            message = await receive()
            body += message.get("body", b"")
            more = message.get("more_body", False)
        token = parse_qs(body.decode("latin-1")).get("token", [""])[0] if len(body) <= POSTED else ""
        if not self._keys.exchange(token):
            return _refused(ONCE)
        # The browser would not send a strict cookie where a redirect follows another site's form: the page goes on itself.
        return self._with_cookie(HTMLResponse('<!doctype html><meta http-equiv="refresh" content="0;url=/">'))

    def _refusal(self, scope: Scope) -> Response | None:
        headers = Headers(scope=scope)
        hosts = headers.getlist("host")
        if len(hosts) != 1 or hosts[0] not in self._hosts:
            return _refused("this server answers to 127.0.0.1 alone", 421)
        own = f"http://{hosts[0]}"
        origins = headers.getlist("origin")
        if any(o != own for o in origins):
            return _refused("the request comes from another site")
        safe = scope["method"] in ("GET", "HEAD")
        if not safe and len(origins) != 1:
            return _refused("a request that changes something must say where it comes from")
        if not safe and headers.get("sec-fetch-site", "same-origin") != "same-origin":
            return _refused("the request comes from another site")
        if self._known(headers):
            return RedirectResponse("/", 303) if scope["path"] == "/" and scope["query_string"] else None
        if headers.get("sec-fetch-site", "none") not in ("none", "same-origin"):
            return _refused("the request comes from another site")
        if scope["path"] == "/" and scope["method"] == "GET":
            token = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
            if self._keys.exchange(token):
                return self._with_cookie(RedirectResponse("/", 303))  # the token does not stay in the address
        return _refused(ONCE)

    def _known(self, headers: Headers) -> bool:
        try:
            found = SimpleCookie(headers.get("cookie", "")).get(self._name)
        except CookieError:
            return False
        return found is not None and secrets.compare_digest(found.value.encode(), self._keys.cookie.encode())

    def _with_cookie(self, response: Response) -> Response:
        response.set_cookie(self._name, self._keys.cookie, httponly=True, samesite="strict", path="/")
        return response

    async def _inner(self, scope: Scope, receive: Receive, send: Send) -> None:
        long = scope["path"] in self._uploads
        await self._app(scope, _limited(receive, math.inf if long else BODY), send)


class TooLong(Exception):
    """A body longer than :data:`BODY`."""


def _limited(receive: Receive, longest: float) -> Receive:
    """The body of a request up to a length; one that does not come on is given up as if the page had gone."""
    seen, whole = 0, False

    async def counted() -> Message:
        nonlocal seen, whole
        if whole:
            return await receive()
        try:
            message = await asyncio.wait_for(receive(), UNFINISHED)
        except TimeoutError:
            return {"type": "http.disconnect"}
        seen += len(message.get("body", b""))
        whole = not message.get("more_body", False)
        if seen > longest:
            raise TooLong
        return message

    return counted


def _with_headers(send: Send) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            own = {k.encode(): v.encode() for k, v in HEADERS.items()}
            others = [(k, v) for k, v in message["headers"] if k.lower() not in own]
            message = {**message, "headers": [*others, *own.items()]}
        await send(message)

    return sent


def _refused(why: str, status: int = 403) -> Response:
    return PlainTextResponse(f"refused: {why}\n", status)
