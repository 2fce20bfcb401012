"""What the page asks for and what it can do: JSON, binary series, events, files."""

from __future__ import annotations

import asyncio
import json
import math
import secrets
import traceback
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from http.cookies import CookieError, SimpleCookie
from importlib import metadata, resources
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import Headers
from starlette.requests import ClientDisconnect, Request
from starlette.responses import (
    HTMLResponse,
    JSONResponse,
    PlainTextResponse,
    RedirectResponse,
    Response,
    StreamingResponse,
)
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ragg_runtime.base.errors import UserError
from ragg_runtime.identification import foresee
from ragg_runtime.studio import drawing, mapping, states, views
from ragg_runtime.studio.mapping import check_upload, receive
from ragg_runtime.studio.session import Busy, Session
from ragg_runtime.studio.views import take_away

BEAT = 0.15
"""How often a page hears of changes, s."""

WATCH = 1.5
"""How often the model directory is looked at for changes by others, s."""

UPLOAD = "/api/upload"

UNFINISHED = 10.0
"""Longest wait for the rest of a request, s."""

Answer = Callable[[Session, Request], Awaitable[Response]]


def application(session: Session) -> Starlette:
    """The routes, without the guard."""

    def route(path: str, answer: Answer, method: str = "GET") -> Route:
        async def asked(request: Request) -> Response:
            return await _guarded(answer, session, request)

        return Route(path, asked, methods=[method])

    static = Path(str(resources.files("ragg_runtime.studio").joinpath("static")))
    return Starlette(
        routes=[
            route("/", _page(static)),
            Mount("/static", StaticFiles(directory=static)),
            route("/api/state", _state),
            route("/api/events", _events),
            route("/api/series", _series),
            route("/api/spectrum", _spectrum),
            route("/api/spectrogram", _spectrogram),
            route("/api/heat", _heat),
            route("/api/preview", _preview),
            route("/api/folder", _folder),
            route("/api/mapping", _mapping),
            route("/api/mapping", _mapped, "POST"),
            route("/api/take/{what}", _take),
            route("/api/do/{what}", _do, "POST"),
            route(UPLOAD, _upload, "POST"),
        ]
    )


async def _guarded(answer: Answer, session: Session, request: Request) -> Response:
    try:
        return await answer(session, request)
    except UserError as e:
        facts = {k: getattr(e, k) for k in ("what", "where", "found", "expected", "remedy")}
        return JSONResponse({"error": facts}, 400)
    except Busy:
        return JSONResponse({"error": {"what": "something else is being worked on; cancel it or wait"}}, 409)
    except TooLong:
        return JSONResponse({"error": {"what": "the request is too long"}}, 413)
    except ClientDisconnect:
        return JSONResponse({"error": {"what": "the request did not come to its end"}}, 408)
    except Exception as e:
        if not isinstance(e, OSError):
            traceback.print_exc()
            return JSONResponse(
                {"error": {"what": "this is a fault of the program; the terminal shows where"}}, 500
            )
        return JSONResponse({"error": {"what": e.strerror or "the system refuses", "where": e.filename}}, 400)


def _page(static: Path) -> Answer:
    """The page; it names all modules at once, so that they come in one round instead of one for each level of imports."""
    modules = sorted(m.relative_to(static).as_posix() for m in static.glob("**/*.js"))
    links = "\n".join(f'<link rel="modulepreload" href="/static/{m}">' for m in modules)
    text = (static / "index.html").read_text("utf-8").replace("</head>", f"{links}\n</head>")

    async def page(session: Session, request: Request) -> Response:
        return Response(text, media_type="text/html")

    return page


def _json(content: Any, status: int = 200) -> Response:
    text = json.dumps(_finite(content), allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    return Response(text.encode("utf-8", "replace"), status, media_type="application/json")


def _finite(x: Any) -> Any:
    """JSON knows no NaN: null in its place."""
    if isinstance(x, float):
        return x if math.isfinite(x) else None
    if isinstance(x, Mapping):
        return {k: _finite(v) for k, v in x.items()}
    return [_finite(v) for v in x] if isinstance(x, list | tuple) else x


async def _state(session: Session, request: Request) -> Response:
    status = {"status": session.jobs.status.as_json()}

    def made() -> Response:
        s = session.state
        known = session.shown
        if known is None or known[0] is not s:  # a state never changes: what is said of it is made once
            said = views.overview(s, metadata.version("ragg")) | {"commands": views.commands(s)}
            session.shown = known = (s, said | {"roots": [str(r) for r in session.places.roots]})
        return _json(status | known[1])

    return await run_in_threadpool(made)


async def _events(session: Session, request: Request) -> Response:
    async def events() -> AsyncIterator[str]:
        last, waited = -1, 0.0
        while not await request.is_disconnected():
            status = session.jobs.status
            if status.count != last:
                last = status.count
                yield f"data: {json.dumps(status.as_json())}\n\n"
            await asyncio.sleep(BEAT)
            waited += BEAT
            if waited > WATCH:
                waited = 0.0
                await _watched(session)
                yield ": still here\n\n"

    return StreamingResponse(events(), media_type="text/event-stream")


async def _watched(session: Session) -> None:
    try:
        await run_in_threadpool(session.reread)
    except (UserError, Busy, OSError):
        return  # half-edited by hand: look again later


def _number(request: Request, name: str, default: float) -> float:
    try:
        value = float(request.query_params.get(name, default))
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise UserError("a number is needed", where=name, found=request.query_params[name][:40])
    return value


def _asked(request: Request) -> drawing.Asked:
    q = request.query_params
    effects = tuple(sorted({e for e in q.get("effects", "").split(",") if e}))
    unit = q.get("unit", "Eo")
    if unit not in drawing.UNITS:
        raise UserError("the unit is not known", found=unit[:40], expected=", ".join(drawing.UNITS))
    return drawing.Asked(
        what=q.get("what", "residual"),
        unit=unit,
        flight=int(_number(request, "flight", 0)),
        output=int(_number(request, "output", 0)),
        effects=effects,
        first=_number(request, "from", -1e12),
        last=_number(request, "to", 1e12),
        points=int(min(max(_number(request, "points", 1500), 16), 20000)),
    )


async def _series(session: Session, request: Request) -> Response:
    data = await run_in_threadpool(drawing.series, session.state, _asked(request))
    return Response(data, media_type="application/octet-stream")


async def _spectrum(session: Session, request: Request) -> Response:
    return _json(await run_in_threadpool(drawing.spectra, session.state, _asked(request)))


async def _spectrogram(session: Session, request: Request) -> Response:
    highest = _number(request, "top", 0.0)
    data = await run_in_threadpool(drawing.spectrogram_of, session.state, _asked(request), highest)
    return Response(data, media_type="application/octet-stream")


async def _heat(session: Session, request: Request) -> Response:
    return _json(await run_in_threadpool(drawing.heat_map, session.state, _asked(request)))


async def _preview(session: Session, request: Request) -> Response:
    asked = _asked(request)

    def made() -> Any:
        s = session.state
        d, unwhitened = s.diagnosed, s.unwhitened
        if d is None or unwhitened is None:
            raise UserError("the effects are not tested yet", remedy="wait a moment")
        known = foresee.field(d)

        def foreseen(*effects: str) -> foresee.Foreseen:
            make = partial(foresee.foreseen, d.fitted, unwhitened, known, effects)
            return s.tracks.cache.get(("foreseen", effects), make)  # type: ignore[return-value]

        found, without = foreseen(*(e for e in asked.effects if e in known.candidates)), foreseen()
        return found.as_json() | {"before_Eo": without.rms_Eo, "noise_Eo": d.noise_floor}

    return _json(await run_in_threadpool(made))


async def _folder(session: Session, request: Request) -> Response:
    place = request.query_params.get("place", "")
    return _json(await run_in_threadpool(session.places.listing, place))


async def _mapping(session: Session, request: Request) -> Response:
    path = session.places.inside(request.query_params.get("flight", ""))
    return _json(await run_in_threadpool(mapping.begun, session.state.model, path))


async def _mapped(session: Session, request: Request) -> Response:
    body = await _body(request)
    path = session.places.inside(_text(body, "flight"))
    return _json(await run_in_threadpool(mapping.tried, session.state.model, path, _given(body)))


def _given(body: Mapping[str, Any]) -> dict[str, Any]:
    """A mapping as the page sends it: tables of texts and numbers."""
    given = body.get("mapping")
    if isinstance(given, dict):
        rows = given.get("rows")
        tables = [given.get(k, {}) for k in ("time", "file", "axes")]
        named = isinstance(rows, list) and all(
            isinstance(r, dict) and isinstance(r.get("channel"), str) for r in rows
        )
        if named and all(isinstance(t, dict) for t in tables):
            return given
    raise UserError("a mapping is needed", where="mapping", found=repr(given)[:80])


async def _take(session: Session, request: Request) -> Response:
    what = request.path_params["what"]
    name, kind, data = await run_in_threadpool(take_away, session.state, what)
    # A report holds its style and its figures in itself: it is handed over as a file, never shown as our page.
    headers = {"content-disposition": f'attachment; filename="{name}"'}
    return Response(data, media_type=kind, headers=headers)


async def _upload(session: Session, request: Request) -> Response:
    path = await receive(session.state, request.query_params.get("name", ""), request)
    await run_in_threadpool(check_upload, path)
    return _json({"path": str(path)})


async def _body(request: Request) -> dict[str, Any]:
    if request.headers.get("content-type", "").split(";")[0] != "application/json":
        raise UserError("the body must be JSON", where=str(request.url.path))
    try:
        body = json.loads(await request.body(), parse_int=_whole)
    except (ValueError, RecursionError):
        raise UserError("the body is no JSON", where=str(request.url.path)) from None
    if not isinstance(body, dict):
        raise UserError("the body is no table", where=str(request.url.path))
    return body


def _whole(text: str) -> int:
    """A whole number that a float holds as well: whatever the page asks for is far smaller."""
    if abs(number := int(text)) > 1 << 53:
        raise ValueError("a number is out of range")
    return number


async def _do(session: Session, request: Request) -> Response:
    body = await _body(request)
    action = ACTIONS.get(request.path_params["what"])
    if action is None:
        raise UserError("there is no such thing to do", found=request.path_params["what"][:40])
    await run_in_threadpool(action, session, body)
    return _json({"status": session.jobs.status.as_json()}, 202)


def _text(body: Mapping[str, Any], key: str, longest: int = 4096) -> str:
    value = body.get(key)
    if not isinstance(value, str) or len(value) > longest:
        raise UserError("a text is needed", where=key, found=repr(value)[:80])
    return value


def _texts(body: Mapping[str, Any], key: str) -> list[str]:
    value = body.get(key)
    if not isinstance(value, list) or not all(isinstance(x, str) for x in value) or len(value) > 2000:
        raise UserError("a list of texts is needed", where=key, found=repr(value)[:80])
    return value


def _step(body: Mapping[str, Any]) -> int | None:
    value = body.get("step")
    if value is not None and (not isinstance(value, int) or isinstance(value, bool)):
        raise UserError("the number of a step is needed", where="step", found=repr(value)[:40])
    return value


def _open(session: Session, body: Mapping[str, Any]) -> None:
    model = session.places.inside(_text(body, "model")) if body.get("model") else None
    flights = [session.places.inside(f) for f in _texts(body, "flights")] if body.get("flights") else []
    session.open(model, flights)


def _new(session: Session, body: Mapping[str, Any]) -> None:
    sheet = session.places.inside(_text(body, "sheet")) if body.get("sheet") else None
    session.new(session.places.inside(_text(body, "model")), sheet)


def _map(session: Session, body: Mapping[str, Any]) -> None:
    flight = session.places.inside(_text(body, "flight"))
    m = session.state.model
    mapping.keep(m, flight, _given(body), replace=body.get("replace") is True)
    session.open(m.directory.path, [flight])  # the model anew: the mapping is its own now


def _leave(session: Session, body: Mapping[str, Any]) -> None:
    flight, ends = body.get("flight"), [body.get(k) for k in ("from", "to")]
    if not isinstance(flight, int) or isinstance(flight, bool):
        raise UserError("the number of a flight is needed", where="flight", found=repr(flight)[:40])
    if ends == [None, None]:
        session.leave_out(flight, None)
        return
    first, last = (float(x) if isinstance(x, int | float) else math.nan for x in ends)
    if not first < last:
        raise UserError("a stretch of time is needed", where="from, to", found=repr(ends)[:80])
    session.leave_out(flight, (first, last))


def _edit(session: Session, body: Mapping[str, Any]) -> None:
    session.edit(states.asked_sheet(body.get("values")))


def _try(session: Session, body: Mapping[str, Any]) -> None:
    units = body.get("units")
    if not isinstance(units, dict) or not all(isinstance(u, str) and len(u) < 80 for u in units.values()):
        raise UserError("every parameter needs a unit", where="units", found=repr(units)[:80])
    session.attempt(_text(body, "id", 80), _text(body, "add", 600), units)


ACTIONS: Mapping[str, Callable[[Session, Mapping[str, Any]], None]] = {
    "open": _open,
    "new": _new,
    "map": _map,
    "look": lambda session, body: session.look(),
    "add": lambda session, body: session.add(_texts(body, "effects")),
    "remove": lambda session, body: session.remove(_text(body, "effect", 80)),
    "edit": _edit,
    "leave": _leave,
    "undo": lambda session, body: session.go("undo"),
    "redo": lambda session, body: session.go("redo"),
    "restore": lambda session, body: session.go("restore", _step(body)),
    "beside": lambda session, body: session.beside(_step(body)),
    "try": _try,
    "keep": lambda session, body: session.keep(),
    "compensate": lambda session, body: session.compensate(
        _text(body, "calibration", 40), _text(body, "demodulator", 40)
    ),
    "calibrate": lambda session, body: session.calibrate(),
    "cancel": lambda session, body: session.jobs.cancel(),
}
"""What the page can do, by the last part of the address."""


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
