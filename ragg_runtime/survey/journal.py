"""The file that an interrupted survey continues from: one line of JSON for every flight that is done.

The first line says what was asked (digest of model.toml, versions), every other holds a record and its digest. A line
is written by one call, so that it is there or not; what a killed process left of a line is cut off by the next one.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import json
import os
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import file_digest
from ragg_runtime.survey.task import Job, Record, divided

KIND = "ragg survey"
_LONGEST_HEAD = 1 << 16  # bytes


def head(job: Job) -> Record:
    """The first line: figures under the same head may stand in one table."""
    text = hashlib.sha256(job.text.encode()).hexdigest()
    found: Record = {"kind": KIND, "model": text, "program": dict(job.program)}
    if job.mapping is not None:
        found["mapping"] = hashlib.sha256(job.mapping[0].encode()).hexdigest()
    return found


def sha256(path: Path) -> str | None:
    """Digest of a file, as a flight's (also of ``file::line``); ``None`` if it cannot be read."""
    path, _ = divided(str(path))
    try:
        return file_digest(path)
    except (OSError, UserError):
        return None


class Journal:
    """Records of flights in a file, appended one by one; use :func:`journal`."""

    def __init__(self, path: Path, handle: int) -> None:
        self.path = path
        self._handle = handle

    def append(self, record: Record) -> None:
        """Add a record; on return it is on the disc."""
        self._write({"digest": _digest(record), "record": record})

    def _write(self, content: Record) -> None:
        line = (_text(content) + "\n").encode()
        try:
            end = os.lseek(self._handle, 0, os.SEEK_END)
            try:
                written = os.write(self._handle, line)
                if written < len(line):  # a full disc
                    raise OSError(28, "No space left on device")
                os.fsync(self._handle)
            except OSError:
                os.ftruncate(self._handle, end)
                raise
        except OSError as error:
            raise UserError(
                "the results file cannot be written", where=self.path, found=error.strerror
            ) from None

    def read(self, job: Job, files: Sequence[str]) -> dict[str, Record]:
        """Records that still hold, by file: of the same model, program and content; errors do not.

        Raises UserError if the file is another survey's, or no survey's.
        """
        lines = self._lines()
        if lines:
            self._compare(lines[0], job)
        found: dict[str, Record] = {}
        for number, line in enumerate(lines[1:], 2):
            kept = self._parsed(line, number)
            record = kept.get("record")
            if isinstance(record, dict) and kept.get("digest") == _digest(record):  # else it is done again
                found[record["file"]] = record
        # Only now is it certain that the file is a survey's, and what follows its last line one that was cut off.
        os.ftruncate(self._handle, sum(map(len, lines)))
        if not lines:
            self._write(head(job))
        return {
            file: found[file]
            for file in files
            if "verdict" in found.get(file, {}) and found[file]["sha256"] == sha256(Path(file))
        }

    def _lines(self) -> list[bytes]:
        """The whole lines of the file, with their ends. UserError if it does not begin as a survey's does."""
        with open(self._handle, "rb", closefd=False) as stream:
            stream.seek(0)
            first = stream.readline(_LONGEST_HEAD)
            if first and self._parsed(first, 1).get("kind") != KIND:
                raise self._foreign(first[:80].decode(errors="replace"))
            text = first + stream.read()
        return text[: text.rfind(b"\n") + 1].splitlines(keepends=True)

    def _compare(self, line: bytes, job: Job) -> None:
        found, asked = self._parsed(line, 1), head(job)
        for key, what in (
            ("model", "model.toml"),
            ("program", "version of the program"),
            ("mapping", "mapping of the flights' columns"),
        ):
            if found.get(key) != asked.get(key):
                raise UserError(
                    f"these results are of another {what}",
                    where=self.path,
                    found=found.get(key),
                    expected=asked.get(key, "none"),
                    remedy="name another results file: the figures of both would not fit together",
                )

    def _parsed(self, line: bytes, number: int) -> Record:
        try:
            record = json.loads(line, parse_constant=_refused)
        except (ValueError, RecursionError):  # NaN and Infinity are no JSON
            record = None
        if not isinstance(record, dict):
            raise self._foreign(f"line {number}: {line[:80].decode(errors='replace')}")
        return record

    def _foreign(self, found: str) -> UserError:
        return UserError(
            "not a results file of a survey",
            where=self.path,
            found=found,
            expected="a file that `ragg survey --resume` has written, or none",
            remedy="name another file",
        )


def _text(content: Record) -> str:
    return json.dumps(content, allow_nan=False, separators=(",", ":"))


def _digest(record: Record) -> str:
    """Of a record as it is written: a line that was changed does not count."""
    return hashlib.sha256(_text(record).encode()).hexdigest()[:16]


def _refused(name: str) -> None:
    raise ValueError(name)


@contextlib.contextmanager
def journal(path: Path) -> Iterator[Journal]:
    """Open or make a results file; UserError if that cannot be done or another survey is writing to it."""
    flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0)
    try:
        if path.exists() and not path.is_file():
            raise OSError(errno.EINVAL, "it is not a regular file")
        handle = os.open(path, flags, 0o666)
    except OSError as error:
        raise UserError(
            "the results file cannot be written",
            where=path,
            found=error.strerror,
            remedy="name a file in a folder that exists and that you may write to",
        ) from None
    try:
        _claim(handle, path)
        yield Journal(path, handle)
    finally:
        os.close(handle)


def _claim(handle: int, path: Path) -> None:
    if sys.platform == "win32":
        return
    import fcntl

    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise UserError(
            "another survey is writing to this results file",
            where=path,
            remedy="wait until it has ended, or name another file",
        ) from None
    except OSError:
        return  # a file system without locks
