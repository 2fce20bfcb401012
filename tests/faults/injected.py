"""Faults, injected into a command that runs in a forked child: at a moment, or at the n-th change of the disc."""

from __future__ import annotations

import contextlib
import errno
import os
import resource
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

# What Python reports (sys.addaudithook) before it changes something on the disc.
_CHANGES = frozenset(
    (
        "os.rename",
        "os.mkdir",
        "os.remove",
        "os.rmdir",
        "os.truncate",
        "os.chmod",
        "shutil.copymode",
        "shutil.rmtree",
    )
)
_NEEDS_SPACE = frozenset(("open", "os.rename", "os.mkdir"))
NOBODY = 65534


@dataclass(frozen=True)
class Ended:
    """How a command ended: exit status (negative: the signal that killed it), what it said, whether a fault struck."""

    status: int
    said: str
    struck: bool


@dataclass(frozen=True)
class Fault:
    """What goes wrong.

    Attributes
    ----------
    kind
        ``none``; ``kill at`` (SIGKILL after ``at`` seconds); ``kill`` (SIGKILL just before the ``at``-th change
        of the disc); ``full`` (the ``at``-th and every later one that needs space fails); ``quota`` (no file
        grows beyond ``at`` bytes); ``forbidden`` (another user runs the command).
    """

    kind: str
    at: float = 0.0


def run(
    arguments: Sequence[str], fault: Fault, scratch: Path, main: Callable[[Sequence[str]], None]
) -> Ended:
    """Run the command line in a child of this process with this fault; ``scratch`` is its temporary folder."""
    hears, says = os.pipe()  # a file would fill the quota
    struck = scratch.parent / f"struck-{os.getpid()}"
    struck.unlink(missing_ok=True)
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        _child(arguments, fault, scratch, says, struck, main)
    os.close(says)
    if fault.kind == "kill at":
        time.sleep(fault.at)
        with contextlib.suppress(ProcessLookupError):
            os.kill(child, signal.SIGKILL)
    with os.fdopen(hears, encoding="utf-8", errors="replace") as stream:
        said = stream.read()
    _, status = os.waitpid(child, 0)
    code = os.waitstatus_to_exitcode(status)
    hit = struck.exists() or code == -signal.SIGKILL
    struck.unlink(missing_ok=True)
    return Ended(code, said, hit)


def _child(
    arguments: Sequence[str],
    fault: Fault,
    scratch: Path,
    says: int,
    struck: Path,
    main: Callable[[Sequence[str]], None],
) -> None:
    code = 99
    try:
        mark = os.open(struck.parent, os.O_RDONLY)
        os.dup2(says, 1)
        os.dup2(says, 2)
        # Under pytest these are files of its own.
        sys.stdout = open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
        sys.stderr = open(2, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
        tempfile.tempdir = str(scratch)
        _inject(fault, mark, struck.name)
        try:
            main(arguments)
            code = 0
        except SystemExit as end:
            code = int(end.code or 0)
        sys.stdout.flush()
        sys.stderr.flush()
    except BaseException:
        # Whatever gets out of the command is a finding, and must be heard.
        os.write(says, traceback.format_exc().encode())
    finally:
        os._exit(code)


def _inject(fault: Fault, folder: int, mark: str) -> None:
    """Arm the fault; ``mark`` appears in ``folder`` when it strikes."""
    if fault.kind == "quota":
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # the write fails instead
        resource.setrlimit(resource.RLIMIT_FSIZE, (int(fault.at), int(fault.at)))
    elif fault.kind == "forbidden" and os.geteuid() == 0:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)
    elif fault.kind in ("kill", "full"):
        count, busy = 0, False

        def hook(event: str, arguments: tuple[object, ...]) -> None:
            nonlocal count, busy
            writes = event == "open" and len(arguments) > 2 and _for_writing(arguments[2])
            if busy or not (writes or event in _CHANGES):
                return
            if fault.kind == "full" and (event not in _NEEDS_SPACE or isinstance(arguments[0], int)):
                return  # what has a descriptor already, a pipe to a worker say, takes no room
            count += 1
            if count < fault.at:
                return
            if fault.kind == "kill":
                os.kill(os.getpid(), signal.SIGKILL)
            busy = True
            os.close(os.open(mark, os.O_WRONLY | os.O_CREAT, dir_fd=folder))
            busy = False
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        sys.addaudithook(hook)


def _for_writing(flags: object) -> bool:
    return isinstance(flags, int) and flags & (os.O_WRONLY | os.O_RDWR) != 0
