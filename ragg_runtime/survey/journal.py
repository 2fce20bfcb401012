"""The results file of a survey: a line of JSON for each flight, appended as it is done, from which the survey is continued."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import click

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import file_digest, locked
from ragg_runtime.survey.examine import Job, Record, split_line

KIND = "ragg survey"

PARTS = {
    "model": "model.toml",
    "program": "version of the program",
    "mapping": "mapping of the flights' columns",
}
"""What must be the same for figures to be in one table, by its key in the first line of a results file."""


def make_head(job: Job) -> Record:
    """The first line of a results file: figures under the same head may be in one table."""
    digests = {"model": job.text} | ({} if job.mapping is None else {"mapping": job.mapping[0]})
    head = {name: hashlib.sha256(text.encode()).hexdigest() for name, text in digests.items()}
    return {"kind": KIND, "program": dict(job.program), **head}


@dataclass(frozen=True)
class Journal:
    """An open results file."""

    path: Path
    stream: IO[bytes]
    head: Record

    def append(self, record: Record) -> None:
        """Add a record; on return it is on the disc."""
        self._write({"record": record})

    def _write(self, content: Record) -> None:
        text = json.dumps(content, allow_nan=False, separators=(",", ":"))
        with _writing(self.path):
            self.stream.write(f"{text}\n".encode())
            self.stream.flush()
            os.fsync(self.stream.fileno())

    def read(self, files: Sequence[str]) -> dict[str, Record]:
        """Records that still hold, by file: same model, program and content, no error. UserError for another survey's."""
        self.stream.seek(0)
        text = self.stream.read()
        whole = text[: text.rfind(b"\n") + 1]  # a line that was cut off is done again
        lines = [self._parse(line) for line in whole.splitlines()]
        if text and (not lines or lines[0].get("kind") != KIND):
            raise self._refuse(text)
        if lines:
            self._require_same(lines[0])
            self.stream.truncate(len(whole))
        else:
            self._write(self.head)
        records = {r["file"]: r for r in (x.get("record", {}) for x in lines[1:]) if "verdict" in r}
        return {f: records[f] for f in files if f in records and records[f]["sha256"] == digest_file(f)}

    def _require_same(self, found: Mapping[str, Any]) -> None:
        for key, what in PARTS.items():
            if found.get(key) != self.head.get(key):
                raise UserError(
                    f"these results are of another {what}",
                    where=self.path,
                    found=found.get(key, "none"),
                    expected=self.head.get(key, "none"),
                    remedy="name another results file: the results would not be comparable",
                )

    def _parse(self, line: bytes) -> Record:
        try:
            record = json.loads(line)
        except (ValueError, RecursionError):
            record = None
        if not isinstance(record, dict):
            raise self._refuse(line)
        return record

    def _refuse(self, found: bytes) -> UserError:
        return UserError(
            "not a results file of a survey",
            where=self.path,
            found=found[:80].decode(errors="replace"),
            expected="a file that `ragg survey --resume` has written, or none",
            remedy="name another file",
        )


def digest_file(file: str) -> str | None:
    """Digest of a file, as a flight's (also of ``file::line``); ``None`` if it cannot be read."""
    try:
        return file_digest(split_line(file)[0])
    except (OSError, UserError):
        return None


@contextlib.contextmanager
def _writing(path: Path) -> Iterator[None]:
    """Turn what goes wrong with a results file into one message."""
    try:
        yield
    except TimeoutError:
        remedy = "wait until it has ended, or name another file"
        raise UserError("another survey is writing to this results file", where=path, remedy=remedy) from None
    except OSError as error:
        remedy = "name a file in a folder that exists and that you may write to"
        raise UserError(
            "the results file cannot be written", where=path, found=error.strerror, remedy=remedy
        ) from None


@contextlib.contextmanager
def open_journal(path: Path, job: Job) -> Iterator[Journal]:
    """Open or make a results file; UserError if that cannot be done or another survey is writing to it."""
    with contextlib.ExitStack() as held:
        with _writing(path):
            if path.exists() and not path.is_file():
                raise OSError(22, "it is not a regular file")
            stream = held.enter_context(path.open("a+b"))
            held.enter_context(locked(path, 0.0))
        yield Journal(path, stream, make_head(job))


@contextlib.contextmanager
def keep_results(resume: Path | None) -> Iterator[Path]:
    """The results file: the one asked for, else one that is kept only if the survey is cut short."""
    path = resume
    if path is None:
        handle, name = tempfile.mkstemp(prefix="ragg-survey-", suffix=".jsonl")
        os.close(handle)
        path = Path(name)
        # a survey that is killed cannot report it
        click.echo(f"... if it is cut short, continue with --resume {path}", err=True)
    before = path.stat().st_size if path.is_file() else 0
    try:
        yield path
    except BaseException:
        # nothing that was there before is read: it may be anything, and is refused
        if path.is_file() and path.stat().st_size > before and path.read_bytes().count(b"\n") > 1:
            click.echo(f"ragg: finished flights are kept; continue with --resume {path}", err=True)
        elif resume is None:
            path.unlink(missing_ok=True)
        raise
    if resume is None:
        path.unlink(missing_ok=True)
