"""What the page asks for and what it can do: JSON, pictures, events, files."""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
from collections.abc import AsyncIterator, Callable, Mapping
from dataclasses import asdict
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
from ragg_runtime.studio import figures, mapping, views
from ragg_runtime.studio.files import check_flight, receive_flight
from ragg_runtime.studio.session import Busy, Session, describe_failure

BEAT = 0.15  # how often a page hears of changes, s
WATCH = 1.5  # how often the model directory is looked at for changes by others, s

UPLOAD = "/api/upload"

Body = Mapping[str, Any]


def make_application(session: Session) -> Starlette:
    """The routes, without the guard."""
    static = Path(str(resources.files("ragg_runtime.studio").joinpath("static")))
    failures = (UserError, OSError, Busy, ClientDisconnect, Exception)
    app = Starlette(
        routes=[
            Route("/", FileResponse(static / "index.html")),
            Mount("/static", StaticFiles(directory=static)),
            Route("/api/events", _send_events),
            Route("/api/mapping", _try_mapping, methods=["POST"]),
            Route("/api/take/{what}", _take_away),
            Route("/api/do/{what}", _do, methods=["POST"]),
            Route(UPLOAD, _upload, methods=["POST"]),
            Route("/api/{what}", _read),
        ],
        exception_handlers=dict.fromkeys(failures, _fail),
    )
    app.state.session = session
    return app


def _session(request: Request) -> Session:
    session: Session = request.app.state.session
    return session


async def _fail(request: Request, error: Exception) -> Response:
    """What went wrong, as the page shows it."""
    if isinstance(error, Busy):
        return JSONResponse({"error": {"what": "another task is running; cancel it or wait"}}, 409)
    if isinstance(error, ClientDisconnect):
        return JSONResponse({"error": {"what": "the request was incomplete"}}, 408)
    expected = isinstance(error, UserError | OSError)
    return JSONResponse({"error": describe_failure(error)}, 400 if expected else 500)


# --- what is read --------------------------------------------------------------------------------------


async def _read(request: Request) -> Response:
    """A result for the page: a picture as it is, everything else as JSON."""
    make = READS.get(request.path_params["what"])
    if make is None:
        return Response(status_code=404)
    content = await run_in_threadpool(make, _session(request), request)
    if isinstance(content, bytes):
        return Response(content, media_type="image/svg+xml")
    return _send_json(content)


def _send_json(content: Any) -> Response:  # Starlette's own does not take names of files that are not UTF-8
    return Response(json.dumps(content, allow_nan=False), media_type="application/json")


def _show_state(session: Session, request: Request) -> Any:
    return {"status": asdict(session.jobs.status)} | views.describe_state(session.state)


async def _send_events(request: Request) -> Response:
    session = _session(request)

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
    try:
        flight, output, spread = (int(q.get(name, 0)) for name in ("flight", "output", "fan"))
        window = (float(q.get("from", -math.inf)), float(q.get("to", math.inf)))
    except ValueError as error:
        raise UserError("a number is needed", where="flight, output, from, to", found=error) from None
    return figures.draw(session.state, figures.Asked(q.get("what", ""), flight, output, window, spread > 0))


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


async def _take_away(request: Request) -> Response:
    what = request.path_params["what"]
    kind, data = await run_in_threadpool(views.take_away, _session(request).state, what)
    # A report holds its style and its figures in itself: it is handed over as a file, never shown as our page.
    return Response(data, media_type=kind, headers={"content-disposition": f'attachment; filename="{what}"'})


# --- what is done --------------------------------------------------------------------------------------


async def _upload(request: Request) -> Response:
    path = await receive_flight(_session(request).state.model, request.query_params.get("name", ""), request)
    await run_in_threadpool(check_flight, path)
    return _send_json({"path": str(path)})


async def _try_mapping(request: Request) -> Response:
    def tried(session: Session, body: Body) -> Any:
        path = session.places.inside(body["flight"])
        return mapping.try_mapping(session.state.model, path, body["mapping"])

    return _send_json(await _act(tried, request))


async def _do(request: Request) -> Response:
    action = ACTIONS.get(request.path_params["what"])
    if action is None:
        raise UserError("there is no such action", found=request.path_params["what"][:40])
    await _act(action, request)
    return JSONResponse({"status": asdict(_session(request).jobs.status)}, 202)


async def _act(action: Callable[[Session, Body], Any], request: Request) -> Any:
    """The result of an action; UserError if the request is not one that the page makes."""
    if request.headers.get("content-type", "").split(";")[0] != "application/json":
        raise UserError("the body must be JSON", where=request.url.path)
    body = await request.body()
    try:
        return await run_in_threadpool(action, _session(request), json.loads(body))
    except (LookupError, TypeError, AttributeError, ValueError, ArithmeticError, RecursionError) as error:
        text = f"{type(error).__name__}: {error}"
        raise UserError("the page does not ask in this way", found=text[:80]) from error


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
    if "from" not in body:
        session.leave_out(body["flight"], None)
        return
    first, last = float(body["from"]), float(body["to"])
    if not first < last:
        raise UserError("a segment of time is needed", found=f"{first:g} to {last:g} s")
    session.leave_out(body["flight"], (first, last))


ACTIONS: Mapping[str, Callable[[Session, Body], None]] = {
    "open": _open,
    "new": _new,
    "map": _map,
    "look": lambda session, body: session.look(),
    "add": lambda session, body: session.add([*body["effects"]]),
    "remove": lambda session, body: session.remove(body["effect"]),
    "edit": lambda session, body: session.edit(body["text"]),
    "leave": _leave,
    "validate": lambda session, body: session.keep_for_validation(body["flight"]),
    "undo": lambda session, body: session.undo(),
    "cancel": lambda session, body: session.jobs.cancel(),
}
"""What the page can do, by the last part of the address."""
