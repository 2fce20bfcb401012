"""Generated C -> shared library, in a cache of the user under the digest of source, command and processor.

The compiler is ``CC``, else ``cc``, ``gcc`` or ``clang``, else that of the package ``ziglang`` (``pip install 'ragg[compiler]'``).
``RAGG_NATIVE=off``: never compile. Compiled is only text that this program has derived or that comes with it.
"""

from __future__ import annotations

import ctypes
import hashlib
import importlib.util
import os
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from ragg_runtime.base.files import find_private_folder

VARIABLE = "RAGG_NATIVE"

OPTIONS = ("-std=c17", "-ffp-contract=off", "-fno-math-errno", "-fPIC", "-shared")
"""No -ffast-math: it gains nothing and costs exactness. Contraction is off because the code says itself where products are fused: a
sample has the same bits wherever it stands, and with whatever effort it was compiled."""

FOR_PROCESSOR: tuple[tuple[str, ...], ...] = (
    ("-march=native", "-mprefer-vector-width=512"),
    ("-march=native",),
    ("-mcpu=native",),
    (),
)
"""Tried in turn: not every compiler knows every processor."""

PATIENCE = 60.0
"""How long a compiler is waited for, s: half a second is usual, and half a minute for ziglang, which compiles its own library first."""


class BuildError(Exception):
    """The C cannot be compiled or loaded; the message has the reason."""


def build(sources: Mapping[str, str], folder: Path | None = None, *, quick: bool = False) -> Path:
    """Compile C files (name -> text) to one library in ``folder`` (by default the user's cache), unless it is there.

    Raises
    ------
    BuildError
        If there is no compiler, or if it fails.
    """
    command, place = (
        [*find_compiler(), "-O1" if quick else "-O3", *OPTIONS],
        find_private_folder("native", folder),
    )
    text = [f"{name}\0{sources[name]}" for name in sorted(sources)]
    identity = "\0".join((*text, *command, repr(FOR_PROCESSOR), describe_processor()))
    library = place / f"{hashlib.sha256(identity.encode()).hexdigest()[:32]}.so"
    if library.exists():
        return library
    command += ["-o", "library.so", *(n for n in sorted(sources) if n.endswith(".c")), "-lm"]
    said = ""
    try:
        with tempfile.TemporaryDirectory(prefix=".", dir=place) as work:
            for name, content in sources.items():
                (Path(work) / name).write_text(content, "utf-8")
            for options in FOR_PROCESSOR:
                with (Path(work) / "said").open(
                    "w+", errors="replace"
                ) as told:  # a child that hangs would keep a pipe open
                    io: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": told, "stderr": told}
                    done = subprocess.run([*command, *options], cwd=work, timeout=PATIENCE, check=False, **io)
                    told.seek(0)
                    said = said or next((line for line in told if "error" in line), "")
                if done.returncode == 0:
                    os.replace(Path(work) / "library.so", library)
                    return library
    except subprocess.TimeoutExpired:
        raise BuildError(f"the C compiler {command[0]} does not answer within {PATIENCE:g} s") from None
    except OSError as refused:
        raise BuildError(f"{command[0]} or the cache {place} cannot be used: {refused.strerror}") from None
    raise BuildError(f"the C compiler {command[0]} fails: {said.strip() or 'without a message'}")


def is_off() -> bool:
    """Whether nothing is to be compiled."""
    return os.environ.get(VARIABLE, "").lower() in ("off", "0", "none")


def find_compiler() -> list[str]:
    """The C compiler as the beginning of a command; BuildError if there is none."""
    try:
        named = shlex.split(os.environ.get("CC", ""))
    except ValueError as error:
        raise BuildError(f"CC cannot be read as a command: {error}") from None
    for command in (named,) if named else (["cc"], ["gcc"], ["clang"]):
        path = shutil.which(command[0])
        if path:
            return [path, *command[1:]]
    if not named and importlib.util.find_spec("ziglang") is not None:
        return [sys.executable, "-m", "ziglang", "cc"]
    looked = named[0] if named else "cc, gcc, clang"
    remedy = "install one (pip install 'ragg[compiler]' brings one), or name it in CC"
    raise BuildError(f"there is no C compiler ({looked}): {remedy}")


@cache
def describe_processor() -> str:
    """What ``native`` means here: caches are shared between machines where home directories are."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").splitlines()
    except OSError:
        lines = []
    own = (x for x in lines if x.startswith(("model name", "flags", "Features", "CPU part")))
    return "\n".join((platform.system(), platform.machine(), platform.processor(), *dict.fromkeys(own)))


def load(file: Path) -> ctypes.CDLL:
    """A library of functions ragg_<model>_<function>; a damaged one is removed and made anew the next time (BuildError)."""
    try:
        return ctypes.CDLL(str(file))
    except OSError as error:
        file.unlink(missing_ok=True)
        raise BuildError(f"the compiled model cannot be loaded: {error}") from None
