"""What the page asks for and what it can do: JSON, binary series, pictures, events, files."""

from __future__ import annotations

import asyncio
import json
import math
import traceback
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from functools import partial
from importlib import resources
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, Response, StreamingResponse
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.studio import mapping, series, views
from ragg_runtime.studio.guard import TooLong
from ragg_runtime.studio.mapping import check_upload, receive
from ragg_runtime.studio.session import Busy, Edit, Session

BEAT = 0.15
"""How often a page hears of changes, s."""

WATCH = 1.5
"""How often the model directory is looked at for changes by others, s."""

UPLOAD = "/api/upload"

Answer = Callable[[Session, Request], Awaitable[Response]]
Body = Mapping[str, Any]


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
            route("/api/events", _events),
            route("/api/mapping", _mapped, "POST"),
            route("/api/take/{what}", _take),
            route("/api/do/{what}", _do, "POST"),
            route(UPLOAD, _upload, "POST"),
            *(route(f"/api/{name}", partial(_read, make)) for name, make in READS.items()),
        ]
    )


async def _guarded(answer: Answer, session: Session, request: Request) -> Response:
    def refused(status: int, what: str | None, **facts: object) -> Response:
        return JSONResponse({"error": {"what": what, **facts}}, status)

    try:
        return await answer(session, request)
    except UserError as e:
        return JSONResponse({"error": e.facts}, 400)
    except Busy:
        return refused(409, "something else is being worked on; cancel it or wait")
    except TooLong:
        return refused(413, "the request is too long")
    except ClientDisconnect:
        return refused(408, "the request did not come to its end")
    except OSError as e:
        return refused(400, e.strerror or "the system refuses", where=e.filename)
    except Exception:
        traceback.print_exc()
        return refused(500, "this is a fault of the program; the terminal shows where")


def _page(static: Path) -> Answer:
    """The page; it names all modules at once, so that they come in one round instead of one for each level of imports."""
    modules = sorted(m.relative_to(static).as_posix() for m in static.glob("**/*.js"))
    links = "\n".join(f'<link rel="modulepreload" href="/static/{m}">' for m in modules)
    text = (static / "index.html").read_text("utf-8").replace("</head>", f"{links}\n</head>")

    async def page(session: Session, request: Request) -> Response:
        return Response(text, media_type="text/html")

    return page


async def _read(make: Callable[[Session, Request], Any], session: Session, request: Request) -> Response:
    """What is asked for: bytes as they are (pictures begin with ``<``), everything else as JSON."""
    made = await run_in_threadpool(make, session, request)
    if isinstance(made, bytes):
        kind = "image/svg+xml" if made.startswith(b"<") else "application/octet-stream"
        return Response(made, media_type=kind)
    return _json(made)


def _json(content: Any) -> Response:
    text = json.dumps(_finite(content), allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    return Response(text.encode("utf-8", "replace"), media_type="application/json")


def _finite(x: Any) -> Any:
    """JSON knows no NaN: null in its place."""
    if isinstance(x, float):
        return x if math.isfinite(x) else None
    if isinstance(x, Mapping):
        return {k: _finite(v) for k, v in x.items()}
    return [_finite(v) for v in x] if isinstance(x, list | tuple) else x


def _state(session: Session, request: Request) -> Any:
    status, s = {"status": session.jobs.status.as_json()}, session.state
    if (
        session.shown is None or session.shown[0] is not s
    ):  # a state never changes: what is said of it is made once
        session.shown = s, views.overview(s) | {"roots": [str(r) for r in session.places.roots]}
    return status | session.shown[1]


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


def _asked(request: Request) -> series.Asked:
    q = request.query_params
    unit = q.get("unit", "Eo")
    if unit not in series.UNITS:
        raise UserError("the unit is not known", found=unit[:40], expected=", ".join(series.UNITS))
    return series.Asked(
        what=q.get("what", "residual"),
        unit=unit,
        flight=int(_number(request, "flight", 0)),
        output=int(_number(request, "output", 0)),
        effects=tuple(sorted({e for e in q.get("effects", "").split(",") if e})),
        first=_number(request, "from", -1e12),
        last=_number(request, "to", 1e12),
        points=int(min(max(_number(request, "points", 1500), 16), 20000)),
    )


def _begun(session: Session, request: Request) -> Any:
    path = session.places.inside(request.query_params.get("flight", ""))
    return mapping.begun(session.state.model, path)


READS: Mapping[str, Callable[[Session, Request], Any]] = {
    "state": _state,
    "series": lambda session, request: series.draw_series(session.state, _asked(request)),
    "spectrum": lambda session, request: series.draw_spectra(session.state, _asked(request)),
    "spectrogram": lambda session, request: series.draw_spectrogram(session.state, _asked(request)),
    "heat": lambda session, request: series.draw_heat(session.state, _asked(request)),
    "panel": lambda session, request: series.draw_panel(session.state, _asked(request)),
    "preview": lambda session, request: series.predict_error(session.state, _asked(request)),
    "folder": lambda session, request: session.places.listing(request.query_params.get("place", "")),
    "mapping": _begun,
}
"""What the page reads, by the last part of the address."""


async def _mapped(session: Session, request: Request) -> Response:
    body = await _body(request)
    path = session.places.inside(_text(body, "flight"))
    return _json(await run_in_threadpool(mapping.tried, session.state.model, path, _given(body)))


def _given(body: Body) -> dict[str, Any]:
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
    kind, data = await run_in_threadpool(views.take_away, session.state, what)
    # A report holds its style and its figures in itself: it is handed over as a file, never shown as our page.
    return Response(data, media_type=kind, headers={"content-disposition": f'attachment; filename="{what}"'})


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
    return JSONResponse({"status": session.jobs.status.as_json()}, 202)


def _text(body: Body, key: str, longest: int = 4096) -> str:
    value = body.get(key)
    if not isinstance(value, str) or len(value) > longest:
        raise UserError("a text is needed", where=key, found=repr(value)[:80])
    return value


def _texts(body: Body, key: str) -> list[str]:
    value = body.get(key)
    if not isinstance(value, list) or not all(isinstance(x, str) for x in value) or len(value) > 2000:
        raise UserError("a list of texts is needed", where=key, found=repr(value)[:80])
    return value


def _count(body: Body, key: str) -> int:
    value = body.get(key)
    if type(value) is not int:
        raise UserError("a whole number is needed", where=key, found=repr(value)[:40])
    return value


def _numbers(given: object, where: str) -> tuple[float, ...]:
    if isinstance(given, list) and given and all(type(x) in (int, float) for x in given):
        return tuple(float(x) for x in given)
    raise UserError("numbers are needed", where=where[:40], found=repr(given)[:80])


def _open(session: Session, body: Body) -> None:
    model = session.places.inside(_text(body, "model")) if body.get("model") else None
    flights = [session.places.inside(f) for f in _texts(body, "flights")] if body.get("flights") else []
    session.open(model, flights)


def _new(session: Session, body: Body) -> None:
    sheet = session.places.inside(_text(body, "sheet")) if body.get("sheet") else None
    session.new(session.places.inside(_text(body, "model")), sheet)


def _map(session: Session, body: Body) -> None:
    flight = session.places.inside(_text(body, "flight"))
    m = session.state.model
    mapping.keep(m, flight, _given(body), replace=body.get("replace") is True)
    session.open(m.directory.path, [flight])  # the model anew: the mapping is its own now


def _leave(session: Session, body: Body) -> None:
    flight, ends = _count(body, "flight"), [body.get(k) for k in ("from", "to")]
    if ends == [None, None]:
        session.leave_out(flight, None)
        return
    first, last = (float(x) if isinstance(x, int | float) else math.nan for x in ends)
    if not first < last:
        raise UserError("a segment of time is needed", where="from, to", found=repr(ends)[:80])
    session.leave_out(flight, (first, last))


def _edit(session: Session, body: Body) -> None:
    """Values of the test sheet: name -> as many numbers as accelerometers, unit, sigma."""
    values, found = body.get("values"), dict[str, Edit]()
    for name, given in values.items() if isinstance(values, dict) else ():
        own = given if isinstance(given, dict) else {}
        value, sigma = _numbers(own.get("value"), name), own.get("sigma")
        of_sheet = None if sigma is None else _numbers(sigma, f"{name}, sigma")
        found[name] = RawQuantity(value, _text(own, "unit", 80)), of_sheet
    if not found:
        raise UserError("no value was changed", remedy="change one, then save")
    session.edit(found)


def _try(session: Session, body: Body) -> None:
    units = body.get("units")
    if not isinstance(units, dict):
        raise UserError("every parameter needs a unit", where="units", found=repr(units)[:80])
    session.attempt(_text(body, "id", 80), _text(body, "add", 600), {n: _text(units, n, 80) for n in units})


ACTIONS: Mapping[str, Callable[[Session, Body], None]] = {
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
    "restore": lambda session, body: session.go("restore", _count(body, "step")),
    "beside": lambda session, body: session.beside(
        None if body.get("step") is None else _count(body, "step")
    ),
    "try": _try,
    "keep": lambda session, body: session.keep(),
    "compensate": lambda session, body: session.compensate(
        _text(body, "calibration", 40), _text(body, "demodulator", 40)
    ),
    "calibrate": lambda session, body: session.calibrate(),
    "cancel": lambda session, body: session.jobs.cancel(),
}
"""What the page can do, by the last part of the address."""
