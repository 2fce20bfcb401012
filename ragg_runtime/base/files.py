"""Files that appear whole or not at all; what makes a result again."""

from __future__ import annotations

import atexit
import contextlib
import errno
import hashlib
import os
import platform
import secrets
import shutil
import stat
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from importlib import metadata
from io import BufferedReader
from pathlib import Path

import filelock
import platformdirs

from ragg_runtime.base.errors import UserError


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A temporary file that takes the place of ``path`` on success and vanishes on failure; a device or a pipe is written to."""
    with _report_refusal(path):
        mode = _find_mode(path)
        is_stream = mode is not None and not stat.S_ISREG(mode)
        place = Path(os.path.realpath(path))
        folder = Path(tempfile.gettempdir()) if is_stream else place.parent
        temporary = folder / f".{place.name[:60]}.{secrets.token_hex(4)}{path.suffix}"
        try:
            yield temporary
            if is_stream:
                path.write_bytes(temporary.read_bytes())
            else:
                put_in_place(temporary, place)
        finally:
            temporary.unlink(missing_ok=True)


def put_in_place(new: Path, target: Path) -> None:
    """Let a new file, on the disc, take the place of another, with its rights."""
    with new.open("r+b") as stream:
        os.fsync(stream)
    if target.exists():
        new.chmod(target.stat().st_mode & 0o777)
    os.replace(new, target)


def check_writable(path: Path) -> None:
    """UserError where :func:`replacing` would not begin."""
    with _report_refusal(path):
        mode = _find_mode(path)
        if mode is None or stat.S_ISREG(mode):
            tempfile.TemporaryFile(dir=os.path.dirname(os.path.realpath(path))).close()


@contextlib.contextmanager
def _report_refusal(path: Path) -> Iterator[None]:
    """UserError where the system refuses to write."""
    try:
        yield
    except OSError as error:
        raise refuse_to_write("the file", path, error) from None


def refuse_to_write(what: str, where: Path, error: OSError) -> UserError:
    """The UserError where the system refuses to write."""
    full = error.errno in (errno.ENOSPC, errno.EDQUOT)
    remedy = (
        "make room on its disc, or write elsewhere"
        if full
        else "check who may write there, or write elsewhere"
    )
    return UserError(f"{what} cannot be written", where=where, found=error.strerror or error, remedy=remedy)


def _find_mode(path: Path) -> int | None:
    """The mode of what exists at a path; ``None``: nothing. OSError where it is a folder, or a device that may not be written."""
    if not path.parent.exists():
        raise UserError("the folder does not exist", where=path.parent, remedy="make it first")
    if not path.exists():
        return None
    mode = path.stat().st_mode
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(mode) and not os.access(path, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    return mode


def write_text(path: Path, text: str) -> None:
    """Write UTF-8 text whole or not at all."""
    write_bytes(path, text.encode())


def write_bytes(path: Path, content: bytes) -> None:
    """Write bytes whole or not at all."""
    with replacing(path) as temporary:
        temporary.write_bytes(content)


def open_regular(path: Path) -> BufferedReader:
    """A user's file, to read. A pipe or a device would be waited for, or never end: UserError."""
    if path.exists() and not path.is_file():
        what = "directory" if path.is_dir() else "pipe or a device"
        raise UserError(f"a regular file is needed here, not a {what}", where=path)
    return path.open("rb")


def file_digest(path: Path) -> str:
    """SHA-256 of a user's file, hexadecimal."""
    with open_regular(path) as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def read_text(path: Path, longest: int = 1 << 20) -> str:
    """The text of a user's file, UTF-8 with or without a byte-order mark, of at most ``longest`` bytes."""
    try:
        with open_regular(path) as stream:
            data = stream.read(longest + 1)
        if len(data) > longest:
            raise UserError("the file is too long", where=path, expected=f"at most {longest} bytes")
        return data.decode("utf-8-sig")
    except FileNotFoundError:
        raise UserError(
            "the file does not exist", where=path, remedy="check the name and the folder"
        ) from None
    except UnicodeDecodeError as error:
        raise UserError(
            "the file is not UTF-8 text",
            where=path,
            found=f"byte {error.object[error.start]:#04x} at {error.start}",
        ) from None
    except OSError as error:
        raise UserError("the file cannot be read", where=path, found=error.strerror) from None


def lock(path: Path, patience: float) -> filelock.BaseFileLock:
    """The lock of a file or folder, held in a ``with`` block; TimeoutError if another process of the user holds it for longer, s."""
    name = hashlib.sha256(os.fsencode(os.path.realpath(path))).hexdigest()[:32]
    return filelock.FileLock(find_private_folder("locks") / name, timeout=patience)


def find_private_folder(name: str, folder: Path | None = None) -> Path:
    """``folder``, by default one of the user's cache, if its owner alone can write to it (it holds code); else one for this process."""
    place = folder if folder is not None else platformdirs.user_cache_path("ragg") / name
    try:
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
        if os.access(place, os.W_OK) and not place.stat().st_mode & 0o022:
            return place
    except OSError:
        pass
    return _make_own_folder()


@cache
def _make_own_folder() -> Path:
    folder = tempfile.mkdtemp(prefix="ragg-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return Path(folder)


# libraries on which the numbers of a result depend
LIBRARIES = ("numpy", "scipy", "sympy", "pint", "pandas", "pyarrow", "xarray", "h5netcdf", "h5py")


MISSING = "not installed"


@cache
def list_versions() -> dict[str, str]:
    """Name -> version of this package, Python and the libraries that results depend on."""
    program = {"ragg": _find_version("ragg"), "python": platform.python_version()}
    return program | {name: _find_version(name) for name in LIBRARIES}


def _find_version(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return MISSING


def provenance(
    made_by: str, model: Mapping[str, object] | None = None, files: Sequence[tuple[str, str | None]] = ()
) -> dict[str, object]:
    """The object ``provenance`` of a JSON result: command line, identity of the model, (path, SHA-256) of the flights."""
    flights = [{"path": path, "digest": digest} for path, digest in files]
    return {**list_versions(), **(model or {}), "flights": flights, "command": made_by}


@cache
def digest_sources(*packages: str, suffixes: tuple[str, ...] = (".py",), first: str = "") -> str:
    """SHA-256 of the text of the program's own packages, wherever they are, and of what comes ``first``."""
    total, root = hashlib.sha256(first.encode()), Path(__file__).parents[2]
    files = {p.relative_to(root).as_posix(): p for name in packages for p in (root / name).rglob("*")}
    for name in sorted(n for n in files if n.endswith(suffixes)):
        text = files[name].read_bytes()
        total.update(f"{name} {len(text)}\n".encode() + text)
    return total.hexdigest()
