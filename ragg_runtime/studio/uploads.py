"""Flights that are dropped on the page: laid down whole or not at all in the folder ``flights`` of the model directory."""

from __future__ import annotations

import shutil
from pathlib import Path

from starlette.requests import ClientDisconnect, Request

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import replacing
from ragg_runtime.studio.places import safe_name
from ragg_runtime.studio.session import State

MOST = 4 << 30
"""Largest file that is taken, bytes: a day at 100 Hz with all channels is 2 GB."""

FOLDER = "flights"


async def receive(s: State, name: str, request: Request) -> Path:
    """The body of a request as a file; nothing is overwritten. UserError if it is too long or does not fit."""
    folder = s.model.directory.path.resolve() / FOLDER
    wanted = safe_name(name)
    announced = int(request.headers.get("content-length", "0") or 0)
    folder.mkdir(exist_ok=True)
    if folder.is_symlink():
        raise UserError("the folder for flights is a link", where=folder, remedy="make it a folder")
    room = min(MOST, shutil.disk_usage(folder).free // 2)
    if announced > room:
        raise _too_long(announced, room)
    path = _free(folder, wanted)
    written = 0
    try:
        with replacing(path) as temporary, temporary.open("wb") as target:
            async for chunk in request.stream():
                written += len(chunk)
                if written > room:
                    raise _too_long(written, room)
                target.write(chunk)
            if not written:
                raise UserError("the file is empty", where=wanted)
    except ClientDisconnect:
        raise UserError("the upload was broken off; nothing was kept", where=wanted) from None
    return path


def _free(folder: Path, name: str) -> Path:
    """A name that is not taken: ``flight.csv``, ``flight-2.csv`` ..."""
    stem, dot, ending = name.partition(".")
    for n in range(1, 1000):
        path = folder / (name if n == 1 else f"{stem}-{n}{dot}{ending}")
        if not path.exists():
            return path
    raise UserError("there are too many files of this name", where=name)


def _too_long(found: int, room: int) -> UserError:
    return UserError(
        "the file is too large",
        found=f"at least {found / 1e6:.0f} MB",
        expected=f"at most {room / 1e6:.0f} MB",
        remedy="put it beside the model and choose it there",
    )
