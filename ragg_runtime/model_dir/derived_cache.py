"""Is a model directory's ``generated/`` what the derivation yields for its effects?

To derive takes a second or more. So each user keeps a list, out of reach of any model directory: digest of what
a derivation depends on -> digest of what it yielded. Code from a model directory is executed only if both match;
then it is, byte for byte, what this program derived before.
"""

from __future__ import annotations

import hashlib
import json
import os
import stat
from collections.abc import Mapping
from functools import cache
from importlib import metadata, resources
from importlib.resources.abc import Traversable
from pathlib import Path

import platformdirs

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import write_text
from ragg_runtime.base.ownership import belongs_to_user
from ragg_runtime.instrument import stations
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model_dir.trust import trusted_sources

_LARGEST = 1 << 24  # bytes of all generated files together
_MOST = 100  # files


def request(instrument: Instrument) -> str:
    """Digest of all that the derivation for this instrument depends on."""
    effects = [
        [s.id, None if s.expression is None else _expression(s.expression)] for s in instrument.effects
    ]
    own = {}
    if instrument.effects_folder is not None:
        found = trusted_sources(instrument.effects_folder, instrument.path)
        own = {path.name: hashlib.sha256(text).hexdigest() for path, text in found.items()}
    asked: list[object] = [_derivation(), effects, own, instrument.form.as_json()]
    if not instrument.layout.like_paper:
        layout = instrument.layout
        asked += [
            layout.names,
            dict(stations.constants(layout)),
            [[o.name, o.members, o.signs] for o in layout.outputs],
        ]
    return _sha256(json.dumps(asked, sort_keys=True))


def matching(generated: Path | None, asked: str) -> Mapping[str, str] | None:
    """The files of ``generated``, if they are what was derived for this request before; else ``None``."""
    if generated is None:
        return None
    known, found = _known(asked), read(generated)
    return found if known is not None and found is not None and digest(found) == known else None


def remember(asked: str, files: Mapping[str, str]) -> None:
    """Put down what a derivation yielded; where that cannot be written, it will be derived again."""
    place = _list() / asked
    try:
        place.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        write_text(place, digest(files) + "\n")
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


def digest(files: Mapping[str, str]) -> str:
    """SHA-256 over names and texts."""
    return _sha256(json.dumps(sorted(files.items())))


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


def _known(asked: str) -> str | None:
    place = _list() / asked
    try:
        with place.open(encoding="ascii") as stream:
            mine = belongs_to_user(os.fstat(stream.fileno())) and belongs_to_user(place.parent.stat())
            return stream.read(200).strip() if mine else None
    except (OSError, ValueError):
        return None


def _list() -> Path:
    return platformdirs.user_cache_path("ragg") / "derived"


def _raise(error: OSError) -> None:
    raise error


def _sha256(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
