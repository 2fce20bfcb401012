"""What was derived before, kept for the next time.

To derive takes a second or more. So each user keeps what derivations yielded, out of reach of any model directory, by the
digest of what a derivation depends on. Only that is executed, or what is derived anew: never a model directory's own
``generated/``, which is no more than compared with it.
"""

from __future__ import annotations

import hashlib
import json
import os
import stat
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import metadata, resources
from importlib.resources.abc import Traversable
from pathlib import Path

import platformdirs

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import write_text
from ragg_runtime.base.kept import keep_below
from ragg_runtime.base.ownership import belongs_to_user
from ragg_runtime.instrument import stations
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model_dir.trust import trusted_sources

_LARGEST = 1 << 24
"""Bytes of all generated files together."""

_MOST = 100
"""Generated files of one model."""

MOST_KEPT = 1 << 26
"""Bytes of derivations that are kept, at most half a megabyte each: a catalogue's effects one by one, and pairs of those
that are used."""


def request(instrument: Instrument, ids: Sequence[str] | None = None, *, candidates: bool = True) -> str:
    """Digest of all that a derivation depends on: for this instrument, with effects of these ids (its own if none are
    given), and with the signatures of all others if ``candidates``.
    """
    expressions = {s.id: _expression(s.expression) for s in instrument.effects if s.expression is not None}
    chosen = [s.id for s in instrument.effects] if ids is None else ids
    effects = [[i, expressions.get(i)] for i in chosen]
    own = {}
    if instrument.effects_folder is not None:
        found = trusted_sources(instrument.effects_folder, instrument.path)
        own = {path.name: hashlib.sha256(text).hexdigest() for path, text in found.items()}
    asked: list[object] = [_derivation(), effects, own, instrument.form.as_json(), candidates and expressions]
    if not instrument.layout.like_paper:
        layout = instrument.layout
        asked += [
            layout.names,
            dict(stations.constants(layout)),
            [[o.name, o.members, o.signs] for o in layout.outputs],
        ]
    return _sha256(json.dumps(asked, sort_keys=True))


def kept(asked: str) -> Mapping[str, str] | None:
    """The files that were derived for this request before, if they are at hand and nobody else can have written them."""
    place = _folder() / f"{asked}.json"
    try:
        with place.open("rb") as stream:
            if not (belongs_to_user(os.fstat(stream.fileno())) and belongs_to_user(place.parent.stat())):
                return None
            found = json.loads(stream.read(_LARGEST))
        os.utime(place)  # used last: the others go first
    except (OSError, ValueError, RecursionError):
        return None
    whole = isinstance(found, dict) and all(isinstance(text, str) for text in found.values())
    return found if whole and "manifest.json" in found else None


def keep(asked: str, files: Mapping[str, str]) -> None:
    """Keep what a derivation yielded; where that cannot be written, it will be derived again."""
    place = _folder() / f"{asked}.json"
    try:
        place.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        write_text(place, json.dumps(dict(files)))
        keep_below(place.parent, MOST_KEPT)
    except (OSError, UserError):
        return


def read(folder: Path) -> Mapping[str, str] | None:
    """Path -> text of every file in a folder but byte code; ``None`` if it holds anything that is no such file."""
    found: dict[str, str] = {}
    size = 0
    try:
        if folder.is_symlink():
            return None
        for place, folders, files in os.walk(folder, onerror=_raise):
            if any(Path(place, f).is_symlink() for f in folders):
                return None
            folders[:] = [f for f in folders if f != "__pycache__"]
            for name in files:
                path = Path(place, name)
                status = path.lstat()
                size += status.st_size
                if not stat.S_ISREG(status.st_mode) or size > _LARGEST or len(found) >= _MOST:
                    return None
                found[path.relative_to(folder).as_posix()] = path.read_bytes().decode()
    except (OSError, UnicodeError):
        return None
    return found


def _expression(e: Mapping[str, object]) -> object:
    parameters = e["params"]
    assert isinstance(parameters, Mapping)
    kept = {
        name: {k: repr(q[k]) for k in ("unit", "plausible", "shared") if k in q}
        for name, q in parameters.items()
    }
    return [str(e["stage"]), str(e["add"]), kept]


@cache
def _derivation() -> str:
    """Digest of the derivation itself: its sources, and the SymPy that it uses."""
    total = hashlib.sha256(metadata.version("sympy").encode())
    pending: list[tuple[str, Traversable]] = [("derive", resources.files("derive"))]
    sources: dict[str, bytes] = {}
    while pending:
        name, place = pending.pop()
        if place.is_dir():
            pending += [(f"{name}/{p.name}", p) for p in place.iterdir() if p.name != "__pycache__"]
        elif name.endswith((".py", ".j2")):
            sources[name] = place.read_bytes()
    for name in sorted(sources):
        total.update(f"{name} {len(sources[name])}\n".encode() + sources[name])
    return total.hexdigest()


def _folder() -> Path:
    return platformdirs.user_cache_path("ragg") / "derived"


def _raise(error: OSError) -> None:
    raise error


def _sha256(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
