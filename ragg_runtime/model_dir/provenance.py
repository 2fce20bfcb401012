"""What makes a result again: versions, digests of what was read, the command. No times: same input, same bytes."""

from __future__ import annotations

import hashlib
import platform
import shlex
import sys
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from ragg_runtime.base.form_version import VERSION, Form, installed
from ragg_runtime.flight import Flight
from ragg_runtime.model_dir.directory import ModelDir
from ragg_runtime.model_dir.trust import read_effects

LIBRARIES = ("numpy", "scipy", "sympy", "pint", "pandas", "pyarrow", "xarray", "h5netcdf", "h5py")
"""What the numbers of a result depend on, beside this package."""

RESULT = Form("the result")
"""The JSON of a command; who wrote it stands in its ``provenance``."""


def versioned(result: Mapping[str, Any]) -> dict[str, Any]:
    """A JSON result with its version in front."""
    return {VERSION: RESULT.version, **result}


@cache
def versions() -> dict[str, str]:
    """Name -> version of this package, Python and the libraries that results depend on."""
    found = {"ragg": installed("ragg"), "python": platform.python_version()}
    return found | {name: installed(name) for name in LIBRARIES}


def command() -> str:
    """The command line of this process, as a shell would read it again."""
    return shlex.join(["ragg", *sys.argv[1:]])


def provenance(
    made_by: str,
    directory: ModelDir | None = None,
    flights: Sequence[Flight] = (),
    derivation: str | None = None,
    *,
    files: Sequence[tuple[str, str | None]] = (),
    before: ModelDir | None = None,
) -> dict[str, object]:
    """The object ``provenance`` of a JSON result.

    Parameters
    ----------
    made_by
        The command line.
    directory
        The model directory as it was read; its digest is that of model.toml.
    flights
        The flights, with the SHA-256 of their files.
    derivation
        Digest of the derived model.
    files
        Further flights: (path, SHA-256 or ``None`` where there is no such file).
    before
        The model directory that the command began with, where it has changed it.
    """
    found: dict[str, object] = {**versions()}
    if directory is not None:
        found["model"] = str(directory.path)
        found["model_digest"] = _sha256(directory)
        if before is not None:
            found["model_digest_before"] = _sha256(before)
        folder = directory.instrument.effects_folder
        if folder is not None:
            found["effects_folder_digest"] = read_effects(folder).digest
    if derivation is not None:
        found["derivation_digest"] = derivation
    every = [*((_path(x.path, x.name), x.digest) for x in flights), *files]
    found["flights"] = [{"path": path, "digest": digest} for path, digest in every]
    found["command"] = made_by
    return found


def _sha256(directory: ModelDir) -> str:
    return hashlib.sha256(directory.text.encode()).hexdigest()


def _path(path: Path | None, name: str) -> str:
    return name if path is None else str(path)
