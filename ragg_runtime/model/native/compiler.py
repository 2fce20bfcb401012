"""Generated C -> shared library in a cache of the user, named by the digest of source, compiler, options and processor.

Compiled is only text that this program has derived or that comes with it, never a file found in a model directory.
"""

from __future__ import annotations

import atexit
import hashlib
import os
import platform
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

import platformdirs

from ragg_runtime.base import progress

VARIABLE = "RAGG_NATIVE"
"""``off``: never compile."""

COMMON = ("-std=c17", "-ffp-contract=off", "-fno-math-errno", "-fPIC", "-shared", "-DRAGG_SERIES_ALONE")
"""No -ffast-math: it gains nothing and costs exactness. Contraction is off because the code says itself where
products are fused; so a sample has the same bits wherever it stands, and with whatever effort it was compiled. What a chain
offers for single instants is left out: nobody calls it here."""

THOROUGH, QUICK = "-O3", "-O1"

FOR_PROCESSOR: tuple[tuple[str, ...], ...] = (
    ("-march=native", "-mprefer-vector-width=512"),
    ("-march=native",),
    ("-mcpu=native",),
    (),
)
"""Tried in turn: not every compiler knows every processor."""

HANGING = 30.0
"""How long a compiler is waited for, s: half a second is usual, on a busy machine ten. NumPy serves after that."""

_hung: dict[str, str] = {}
"""Compilers that were given up in this process, and why: they are not waited for again."""


class NativeWarning(UserWarning):
    """There is no machine code; the NumPy model serves."""


class BuildError(Exception):
    """The C cannot be compiled; the message says why and what to do."""


def build(sources: Mapping[str, str], folder: Path | None = None, *, quick: bool = False) -> Path:
    """Compile C files (name -> text) to one library in ``folder`` (by default the user's cache), unless it is there.
    Raises BuildError.
    """
    compiler = find_compiler()
    if compiler[0] in _hung:
        raise BuildError(_hung[compiler[0]])
    place = private_folder(folder)
    version = _version(tuple(compiler))
    text = "".join(f"{name}\0{sources[name]}\0" for name in sorted(sources))
    effort = QUICK if quick else THOROUGH
    identity = "\0".join((text, version, *compiler, effort, *COMMON, repr(FOR_PROCESSOR), processor()))
    name = hashlib.sha256(identity.encode()).hexdigest()[:32]
    library = place / f"{name}.so"
    try:
        if not library.exists():
            _compile([*compiler, effort], sources, library)
    except OSError as error:
        raise BuildError(f"the cache {place} cannot be written: {error.strerror}") from None
    return library


def find_compiler() -> Sequence[str]:
    """The C compiler as the beginning of a command. Raises BuildError if there is none."""
    if os.environ.get(VARIABLE, "").lower() in ("off", "0", "none"):
        raise BuildError(f"{VARIABLE} is {os.environ[VARIABLE]}")
    try:
        named = shlex.split(os.environ.get("CC", ""))
    except ValueError as error:
        raise BuildError(f"CC cannot be read as a command: {error}") from None
    for command in (named,) if named else (["cc"], ["gcc"], ["clang"]):
        path = shutil.which(command[0])
        if path:
            return [path, *command[1:]]
    looked = named[0] if named else "cc, gcc, clang"
    raise BuildError(f"there is no C compiler ({looked}): install one, or name it in CC")


def private_folder(folder: Path | None = None) -> Path:
    """The cache, if it can be written, by its owner alone; else one for this process."""
    place = folder if folder is not None else platformdirs.user_cache_path("ragg") / "native"
    try:
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
        if os.access(place, os.W_OK) and not place.stat().st_mode & 0o022:
            return place
    except OSError:
        pass
    return _own_folder()


@cache
def _own_folder() -> Path:
    folder = tempfile.mkdtemp(prefix="ragg-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return Path(folder)


@cache
def processor() -> str:
    """What ``native`` means here: caches are shared between machines where home directories are."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").splitlines()
    except OSError:
        lines = []
    found = [x for x in lines if x.startswith(("model name", "flags", "Features", "CPU part"))]
    return "\n".join((platform.system(), platform.machine(), platform.processor(), *dict.fromkeys(found)))


@cache
def _version(compiler: tuple[str, ...]) -> str:
    status, said = _run([*compiler, "--version"])
    return said if status == 0 else ""


def _compile(compiler: Sequence[str], sources: Mapping[str, str], library: Path) -> None:
    """Compile in a folder of its own, then put the library into its place."""
    errors = ""
    with tempfile.TemporaryDirectory(prefix=".", dir=library.parent) as work:
        for name, text in sources.items():
            (Path(work) / name).write_text(text, "utf-8")
        units = [name for name in sorted(sources) if name.endswith(".c")]
        for options in FOR_PROCESSOR:
            status, said = _run([*compiler, *COMMON, *options, *units, "-lm", "-o", "library.so"], work)
            if status == 0:
                os.replace(Path(work) / "library.so", library)
                return
            errors = errors or said
    last = [x for x in errors.strip().splitlines() if "error" in x][:1] or ["it says nothing"]
    raise BuildError(f"the C compiler {compiler[0]} fails: {last[0]}")


def _run(command: Sequence[str], folder: str | None = None) -> tuple[int, str]:
    """Exit status, and what was said: to a file, as children of a compiler that hangs would keep a pipe open."""
    with tempfile.TemporaryFile("w+", errors="replace") as said:
        try:
            done = subprocess.run(
                command,
                cwd=folder,
                stdin=subprocess.DEVNULL,
                stdout=said,
                stderr=said,
                timeout=HANGING,
                check=False,
            )
        except subprocess.TimeoutExpired:
            _hung[command[0]] = f"the C compiler {command[0]} does not answer within {HANGING:g} s"
            progress.remark(f"{_hung[command[0]]}; the slower NumPy code serves")
            raise BuildError(_hung[command[0]]) from None
        except OSError as error:
            raise BuildError(f"the C compiler {command[0]} cannot be run: {error}") from None
        said.seek(0)
        return done.returncode, said.read()
