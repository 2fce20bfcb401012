"""The forms in which a model is exported."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from ragg_runtime.base.errors import UserError
from ragg_runtime.compensation.export.contents import Contents
from ragg_runtime.compensation.export.numpy_folder import json_files, numpy_files, write_folder
from ragg_runtime.compensation.export.program import c_program
from ragg_runtime.model import derive


def write_export(c: Contents, folder: Path, form: str) -> list[Path]:
    """Write what is exported into a folder; the files."""
    if form not in FORMS:
        raise UserError("unknown form of export", found=repr(form), expected=", ".join(FORMS))
    return write_folder(folder, FORMS[form](c))


def _harmonics(c: Contents) -> Mapping[str, str]:
    """The outputs as harmonics of their discs' angles, beside the values that go into them."""
    return {**derive.harmonics_of(c.instrument), **json_files(c)}


FORMS: Mapping[str, Callable[[Contents], Mapping[str, str]]] = MappingProxyType(
    {"c": c_program, "numpy": numpy_files, "json": json_files, "harmonics": _harmonics}
)
"""Form of an export -> its files."""
