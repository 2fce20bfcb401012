"""What a command writes: refused over anything that it reads, made before it begins, put in place after it has ended.

A command whose last act changes a model thus has its results safely on the disc before, and one that cannot
write them changes nothing.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import click

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import Target

STDOUT = ("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1")
"""Names of stdout; where JSON is asked for there, it is all that stands there."""

_KEY = f"{__name__}.outputs"
_OF_A_MODEL = (
    ("model.toml", "history.json", "calibration.json", "mapping.toml"),
    ("generated",),
)  # files, and folders with all in them


class OutputFile(click.Path):
    """The type of an option that names a file to write; only one for ``records`` may replace a record."""

    def __init__(self, *, records: bool = False) -> None:
        super().__init__(path_type=str)
        self.records = records

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        name = os.fsdecode(super().convert(value, param, ctx))
        path = Path(name)
        if not self.records and path.is_file() and path.stat().st_size:
            from ragg_runtime.flight.formats import ending_of  # only here: to import it takes a while

            if ending_of(path.name) is not None:
                raise _over("a record", path, "a file that is not empty, with the ending of a flight file")
            if path.name in _OF_A_MODEL[0] and (path.resolve().parent / "model.toml").is_file():
                raise _over("a file of a model directory", path, path.name)
        return name


def _over(what: str, path: Path, found: str) -> UserError:
    return UserError(
        f"a result would be written over {what}",
        where=path,
        found=found,
        remedy="name another file, or delete this one first",
    )


class Outputs:
    """The files that a command was asked to write, ready to be written; :meth:`place` ends them all."""

    def __init__(self, targets: dict[str, Target]) -> None:
        self._targets = targets
        self._written: list[Target] = []

    def write(self, name: str, content: str | bytes) -> None:
        """Write one of them; nothing stands in its place yet, but what goes to stdout is said at once."""
        if name in STDOUT:
            self._targets[name] = Target(Path("/dev/stdout"))
        self._targets[name].write(content.encode() if isinstance(content, str) else content)
        self._written.append(self._targets[name])

    def place(self) -> None:
        for t in self._written:
            t.place()
        self._written.clear()

    def close(self) -> None:
        for t in self._targets.values():
            t.close()


def asked() -> Outputs:
    """The outputs of the command that runs."""
    found: Outputs = click.get_current_context().meta[_KEY]
    return found


class Command(click.Command):
    """A command whose outputs are made ready before it begins; all other paths that it takes are inputs."""

    def invoke(self, ctx: click.Context) -> Any:
        if sys.stdout is None:
            raise UserError(
                "the result cannot be written: stdout is closed",
                remedy="if it is not wanted, send it away: > /dev/null",
            )
        inputs = [Path(os.fsdecode(p)) for p in _paths(self, ctx, outputs=False)]
        with contextlib.closing(_opened(_paths(self, ctx, outputs=True), inputs)) as outputs:
            ctx.meta[_KEY] = outputs
            result = super().invoke(ctx)
            outputs.place()
        return result


def _paths(command: click.Command, ctx: click.Context, *, outputs: bool) -> list[str]:
    """Values of those parameters that name files to write, or of all other paths."""
    found: list[str] = []
    for p in command.params:
        value = ctx.params.get(p.name or "")
        if isinstance(p.type, click.Path) and isinstance(p.type, OutputFile) == outputs and value is not None:
            found += [str(v) for v in (value if p.multiple or p.nargs == -1 else (value,))]
    return found


def _opened(names: Sequence[str], inputs: Sequence[Path]) -> Outputs:
    targets: dict[str, Target] = {}
    outputs = Outputs(targets)
    try:
        for name in names:
            if name in STDOUT:
                continue
            _check(Path(name), inputs)
            for other in targets.values():
                if not other.is_stream and _same(Path(name), other.path):
                    raise UserError("two results would be written to one file", where=name)
            targets[name] = Target(Path(name))
    except BaseException:
        outputs.close()
        raise
    return outputs


def _check(path: Path, inputs: Iterable[Path]) -> None:
    """UserError if ``path`` is a file that the command reads, or one of a model directory's or folder's own."""
    for given in inputs:
        files, folders = [given], [given / f for f in _OF_A_MODEL[1]]
        if given.is_dir():
            files += [given / f for f in _OF_A_MODEL[0]]
        real = Path(os.path.realpath(path))
        inside = next((f for f in folders if Path(os.path.realpath(f)) in real.parents), None)
        over = next((f for f in files if _same(path, f)), inside)
        if over is not None:
            raise UserError(
                "a result would be written over what the command reads",
                where=path,
                found=f"the same as {over}" if over is not inside else f"a file in {over}",
                expected="a file of its own",
                remedy="name another file",
            )


def _same(one: Path, other: Path) -> bool:
    if os.path.realpath(one) == os.path.realpath(other):
        return True
    with contextlib.suppress(OSError):
        return one.samefile(other)
    return False
