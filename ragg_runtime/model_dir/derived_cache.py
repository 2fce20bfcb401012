"""What was derived before, kept for the next time.

To derive takes a second or more. So each user keeps what derivations yielded, out of reach of any model directory, by the
digest of what a derivation depends on. Only that is executed, or what is derived anew: never a model directory's own
``generated/``.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import metadata, resources
from importlib.resources.abc import Traversable
from pathlib import Path

import platformdirs

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import write_text
from ragg_runtime.instrument import layout as layouts
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model_dir.own_effects import own_sources

_LARGEST = 1 << 24
"""Bytes of all generated files together."""

MOST_KEPT = 200
"""Derivations that are kept, at most half a megabyte each: a catalogue's effects one by one, and pairs of those that are used."""


def request(instrument: Instrument, ids: Sequence[str] | None = None, *, candidates: bool = True) -> str:
    """Digest of all that a derivation depends on: for this instrument, with effects of these ids (its own if none are
    given), and with the signatures of all others if ``candidates``.
    """
    expressions = {s.id: _expression(s.expression) for s in instrument.effects if s.expression is not None}
    chosen = [s.id for s in instrument.effects] if ids is None else ids
    effects = [[i, expressions.get(i)] for i in chosen]
    own = sorted(map(_sha256, own_sources().values()))
    asked: list[object] = [_derivation(), effects, own, instrument.form.as_json(), candidates and expressions]
    if not instrument.layout.like_paper:
        layout = instrument.layout
        asked += [
            layout.names,
            dict(layouts.constants(layout)),
            [[o.name, o.members, o.signs] for o in layout.outputs],
        ]
    return _sha256(json.dumps(asked, sort_keys=True))


def kept(asked: str) -> Mapping[str, str] | None:
    """The files that were derived for this request before, if they are at hand."""
    place = _folder() / f"{asked}.json"
    try:
        with place.open("rb") as stream:
            found = json.loads(stream.read(_LARGEST))
        os.utime(place)  # used last: the others go first
    except (OSError, ValueError, RecursionError):
        return None
    whole = isinstance(found, dict) and all(isinstance(text, str) for text in found.values())
    return found if whole and "manifest.json" in found else None


def keep(asked: str, files: Mapping[str, str]) -> None:
    """Keep what a derivation yielded; where that cannot be written, it will be derived again."""
    folder = _folder()
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        write_text(folder / f"{asked}.json", json.dumps(dict(files)))
        for old in sorted(folder.glob("*.json"), key=lambda p: -p.stat().st_mtime)[MOST_KEPT:]:
            old.unlink(missing_ok=True)
    except (OSError, UserError):
        return


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


def _sha256(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
