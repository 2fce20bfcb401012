"""What the page asks for and what it can do: JSON, pictures, events, files."""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from dataclasses import asdict
from functools import partial
from importlib import resources
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, JSONResponse, Response, StreamingResponse
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

from ragg_runtime.base.errors import UserError
from ragg_runtime.instrument.units import RawQuantity
from ragg_runtime.studio import figures, mapping, views
from ragg_runtime.studio.files import check_flight, receive_flight
from ragg_runtime.studio.session import Busy, Session, SheetEdit, describe_failure
from ragg_runtime.wording import numbers

BEAT = 0.15  # how often a page hears of changes, s
WATCH = 1.5  # how often the model directory is looked at for changes by others, s

UPLOAD = "/api/upload"

Answer = Callable[[Session, Request], Awaitable[Response]]
Body = Mapping[str, Any]


def make_application(session: Session) -> Starlette:
    """The routes, without the guard."""

    def route(path: str, answer: Answer, method: str = "GET") -> Route:
        async def asked(request: Request) -> Response:
            return await _answer(answer, session, request)

        return Route(path, asked, methods=[method])

    static = Path(str(resources.files("ragg_runtime.studio").joinpath("static")))
    return Starlette(
        routes=[
            Route("/", FileResponse(static / "index.html")),
            Mount("/static", StaticFiles(directory=static)),
            route("/api/events", _send_events),
            route("/api/mapping", _try_mapping, "POST"),
            route("/api/take/{what}", _take_away),
            route("/api/do/{what}", _do, "POST"),
            route(UPLOAD, _upload, "POST"),
            *(route(f"/api/{name}", partial(_read, make)) for name, make in READS.items()),
        ]
    )


async def _answer(answer: Answer, session: Session, request: Request) -> Response:
    try:
        return await answer(session, request)
    except Busy:
        what = "another task is running; cancel it or wait"
        return JSONResponse({"error": {"what": what}}, 409)
    except ClientDisconnect:
        return JSONResponse({"error": {"what": "the request was incomplete"}}, 408)
    except Exception as e:
        return JSONResponse(
            {"error": describe_failure(e)}, 400 if isinstance(e, UserError | OSError) else 500
        )


# --- what is read --------------------------------------------------------------------------------------


async def _read(make: Callable[[Session, Request], Any], session: Session, request: Request) -> Response:
    """A result for the page: a picture as it is, everything else as JSON."""
    content = await run_in_threadpool(make, session, request)
    return (
        Response(content, media_type="image/svg+xml") if isinstance(content, bytes) else _send_json(content)
    )


def _send_json(content: Any) -> Response:
    text = json.dumps(_make_plain(content), allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    return Response(text.encode("utf-8", "replace"), media_type="application/json")


def _make_plain(x: Any) -> Any:
    """The same without what JSON does not know (NaN), and without control characters, which names in files may hold."""
    match x:
        case float():
            return x if math.isfinite(x) else None
        case str():
            return numbers.clean(x)
        case dict():
            return {k: _make_plain(v) for k, v in x.items()}
        case list() | tuple():
            return [_make_plain(v) for v in x]
    return x


def _show_state(session: Session, request: Request) -> Any:
    return {"status": asdict(session.jobs.status)} | views.describe_state(session.state)


async def _send_events(session: Session, request: Request) -> Response:
    async def events() -> AsyncIterator[str]:
        last, waited = -1, 0.0
        while not await request.is_disconnected():
            status = session.jobs.status
            if status.count != last:
                last = status.count
                yield f"data: {json.dumps(asdict(status))}\n\n"
            await asyncio.sleep(BEAT)
            waited += BEAT
            if waited > WATCH:
                waited = 0.0
                with contextlib.suppress(UserError, Busy, OSError):  # half-edited by hand: look again later
                    await run_in_threadpool(session.reread)
                yield ": still here\n\n"

    return StreamingResponse(events(), media_type="text/event-stream")


def _draw(session: Session, request: Request) -> bytes:
    q = request.query_params

    def number(name: str, default: float) -> float:
        try:
            value = float(q.get(name, default))
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise UserError("a number is needed", where=name, found=q[name][:40])
        return value

    flight, output, spread = (int(number(name, 0)) for name in ("flight", "output", "fan"))
    window = (number("from", -1e12), number("to", 1e12))
    return figures.draw(
        session.state, figures.Asked(q.get("what", "time"), flight, output, window, spread > 0)
    )


def _draft_mapping(session: Session, request: Request) -> Any:
    path = session.places.inside(request.query_params.get("flight", ""))
    return mapping.draft(session.state.model, path)


READS: Mapping[str, Callable[[Session, Request], Any]] = {
    "state": _show_state,
    "panel": _draw,
    "folder": lambda session, request: session.places.listing(request.query_params.get("place", "")),
    "mapping": _draft_mapping,
}
"""What the page reads, by the last part of the address."""


async def _take_away(session: Session, request: Request) -> Response:
    what = request.path_params["what"]
    kind, data = await run_in_threadpool(views.take_away, session.state, what)
    # A report holds its style and its figures in itself: it is handed over as a file, never shown as our page.
    return Response(data, media_type=kind, headers={"content-disposition": f'attachment; filename="{what}"'})


# --- what is done --------------------------------------------------------------------------------------


async def _upload(session: Session, request: Request) -> Response:
    path = await receive_flight(session.state.model, request.query_params.get("name", ""), request)
    await run_in_threadpool(check_flight, path)
    return _send_json({"path": str(path)})


async def _try_mapping(session: Session, request: Request) -> Response:
    def tried(session: Session, body: Body) -> Any:
        path = session.places.inside(body["flight"])
        return mapping.try_mapping(session.state.model, path, body["mapping"])

    return _send_json(await _act(tried, session, await _read_body(request)))


async def _do(session: Session, request: Request) -> Response:
    body = await _read_body(request)
    action = ACTIONS.get(request.path_params["what"])
    if action is None:
        raise UserError("there is no such action", found=request.path_params["what"][:40])
    await _act(action, session, body)
    return JSONResponse({"status": asdict(session.jobs.status)}, 202)


async def _act(action: Callable[[Session, Body], Any], session: Session, body: Body) -> Any:
    """The result of an action; UserError if the request is not one that the page makes."""
    try:
        return await run_in_threadpool(action, session, body)
    except (LookupError, TypeError, AttributeError, ValueError, ArithmeticError) as error:
        text = f"{type(error).__name__}: {error}"
        raise UserError("the page does not ask in this way", found=text[:80]) from error


async def _read_body(request: Request) -> dict[str, Any]:
    if request.headers.get("content-type", "").split(";")[0] != "application/json":
        raise UserError("the body must be JSON", where=str(request.url.path))
    try:
        body = json.loads(await request.body())
    except (ValueError, RecursionError):
        raise UserError("the body is not JSON", where=str(request.url.path)) from None
    if not isinstance(body, dict):
        raise UserError("the body is not a table", where=str(request.url.path))
    return body


def _open(session: Session, body: Body) -> None:
    model = session.places.inside(body["model"]) if body.get("model") else None
    session.open(model, [session.places.inside(f) for f in body.get("flights") or ()])


def _new(session: Session, body: Body) -> None:
    sheet = session.places.inside(body["sheet"]) if body.get("sheet") else None
    session.new(session.places.inside(body["model"]), sheet)


def _map(session: Session, body: Body) -> None:
    flight, m = session.places.inside(body["flight"]), session.state.model
    mapping.keep(m, flight, body["mapping"], replace=body.get("replace") is True)
    session.open(m.directory.path, [flight])  # the model anew: the mapping is its own now


def _leave(session: Session, body: Body) -> None:
    ends = [body.get(k) for k in ("from", "to")]
    if ends == [None, None]:
        session.leave_out(body["flight"], None)
        return
    first, last = (math.nan if x is None else float(x) for x in ends)
    if not first < last:
        raise UserError("a segment of time is needed", where="from, to", found=repr(ends)[:80])
    session.leave_out(body["flight"], (first, last))


def _edit(session: Session, body: Body) -> None:
    """Values of the test sheet: name -> as many numbers as accelerometers, unit, sigma, fixed."""
    edits: dict[str, SheetEdit] = {}
    for name, entry in body["values"].items():
        sigma = None if entry.get("sigma") is None else tuple(map(float, entry["sigma"]))
        value = RawQuantity(tuple(map(float, entry["value"])), entry["unit"])
        edits[name] = SheetEdit(value, sigma, entry.get("fixed") is True)
    if not edits:
        raise UserError("no value was changed", remedy="change one, then save")
    session.edit(edits)


ACTIONS: Mapping[str, Callable[[Session, Body], None]] = {
    "open": _open,
    "new": _new,
    "map": _map,
    "look": lambda session, body: session.look(),
    "add": lambda session, body: session.add([*body["effects"]]),
    "remove": lambda session, body: session.remove(body["effect"]),
    "edit": _edit,
    "leave": _leave,
    "validate": lambda session, body: session.keep_for_validation(body["flight"]),
    "undo": lambda session, body: session.undo(),
    "cancel": lambda session, body: session.jobs.cancel(),
}
"""What the page can do, by the last part of the address."""
