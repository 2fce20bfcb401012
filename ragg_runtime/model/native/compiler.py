"""Generated C -> shared library in a cache of the user.

What is compiled is text that this program has derived or that is packaged with it, never a file that was found
in a model directory. The library's name is the digest of everything that it depends on: source, compiler,
options, processor.
"""

from __future__ import annotations

import atexit
import contextlib
import hashlib
import os
import platform
import shlex
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import platformdirs

from ragg_runtime.base import progress
from ragg_runtime.base.lock import locked

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

ANSWERING = 4.0
"""How long a compiler is waited for that is asked its version, s."""

HANGING = 9.0
"""How long it is waited for when it compiles, s: it takes half a second. NumPy serves after that."""

PATIENT = 3.0
"""As often it is said what is waited for, s: nobody should wonder for more than five."""

_hung: dict[str, str] = {}
"""Compilers that were given up in this process, and why: they are not waited for again."""

_PATIENCE = 120.0  # s; another process may be compiling the same


class NativeWarning(UserWarning):
    """There is no machine code; the NumPy model serves."""


class BuildError(Exception):
    """The C cannot be compiled; the message says why and what to do."""


@dataclass(frozen=True)
class Built:
    """A shared library.

    Attributes
    ----------
    library
        The file.
    command
        The command that made it, for the record.
    fresh
        Whether it was compiled just now.
    """

    library: Path
    command: str
    fresh: bool


def build(sources: Mapping[str, str], folder: Path | None = None, *, quick: bool = False) -> Built:
    """Compile C files (name -> text; headers beside them) to one library, unless it is in the cache already.

    ``folder`` is the cache; by default the user's. ``quick``: with less effort, in a third of the time. Raises BuildError.
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
    library, record = place / f"{name}.so", place / f"{name}.txt"
    command = _kept(library, record)
    if command is None:
        try:
            with locked(place, _PATIENCE):
                command = _kept(library, record)
                if command is None:
                    command = _compile([*compiler, effort], sources, library, record)
                    return Built(library, command, True)
        except TimeoutError:
            raise BuildError(f"another process keeps the cache {place} locked") from None
        except OSError as error:
            raise BuildError(f"the cache {place} cannot be written: {error.strerror}") from None
    return Built(library, command, False)


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
    done = _run([*compiler, "--version"])
    return done.stdout if done.returncode == 0 else ""


def _compile(compiler: Sequence[str], sources: Mapping[str, str], library: Path, record: Path) -> str:
    """Compile into a folder of its own, then put library and record into their places; the command."""
    errors = ""
    with tempfile.TemporaryDirectory(prefix=".", dir=library.parent) as work:
        for name, text in sources.items():
            (Path(work) / name).write_text(text, "utf-8")
        units = [name for name in sorted(sources) if name.endswith(".c")]
        for options in FOR_PROCESSOR:
            command = [*compiler, *COMMON, *options, *units, "-lm", "-o", "library.so"]
            done = _run(command, work)
            if done.returncode == 0:
                break
            errors = errors or done.stderr
        else:
            last = [x for x in errors.strip().splitlines() if "error" in x][:1] or ["it says nothing"]
            raise BuildError(f"the C compiler {compiler[0]} fails: {last[0]}")
        made = Path(work) / "library.so"
        shown = shlex.join(command)
        (Path(work) / "record").write_text(f"{_digest(made)}\n{shown}\n", "utf-8")
        os.replace(made, library)
        os.replace(Path(work) / "record", record)
    return shown


def _run(command: Sequence[str], folder: str | None = None) -> subprocess.CompletedProcess[str]:
    patience = HANGING if folder is not None else ANSWERING
    try:
        process = subprocess.Popen(
            command,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
            start_new_session=True,
        )
    except OSError as error:
        raise BuildError(f"the C compiler {command[0]} cannot be run: {error}") from None
    with process:
        try:
            out, err = _answer(process, command[0], patience)
        except BaseException as error:
            # What it has started goes with it, and with that the pipes that are waited for.
            if hasattr(os, "killpg"):
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGKILL)
            process.kill()
            if not isinstance(error, subprocess.TimeoutExpired):
                raise
            _hung[command[0]] = f"the C compiler {command[0]} does not answer within {patience:g} s"
            progress.remark(f"{_hung[command[0]]}; the slower NumPy code serves")
            raise BuildError(_hung[command[0]]) from None
    return subprocess.CompletedProcess(command, process.returncode, out, err)


def _answer(process: subprocess.Popen[str], name: str, patience: float) -> tuple[str, str]:
    """What a compiler says. Raises TimeoutExpired after ``patience``; that it is waited for is told meanwhile."""
    while patience > PATIENT:
        with contextlib.suppress(subprocess.TimeoutExpired):
            return process.communicate(timeout=PATIENT)
        patience -= PATIENT
        progress.remark(f"waiting for the C compiler {name}, {patience:g} s more at most")
    return process.communicate(timeout=patience)


def _kept(library: Path, record: Path) -> str | None:
    """The command that made a library, if it is there as it was made."""
    try:
        digest, _, command = record.read_text("utf-8").partition("\n")
        whole = digest == _digest(library)
    except (OSError, UnicodeDecodeError):
        return None
    return command.strip() if whole else None


def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()
