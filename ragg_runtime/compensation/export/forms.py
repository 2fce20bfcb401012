"""The forms in which a model is exported, and the folder that they are written into."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from importlib import resources
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import write_text
from ragg_runtime.compensation.export.contents import Contents, unit_of
from ragg_runtime.compensation.export.program import make_program
from ragg_runtime.model.record import HALO, SPIN_WINDOW
from ragg_runtime.signals.angular_acceleration import wide_weights
from ragg_runtime.signals.derivative import DEGREES, WINDOW, weights

Files = Mapping[str, str]
"""File name -> text."""


def make_c(c: Contents) -> Files:
    """A C program with its tests."""
    return {**make_program(c), **make_tests(c)}


def make_numpy(c: Contents) -> Files:
    """A folder that needs only NumPy."""
    slopes = {
        "short": [weights(WINDOW, k).tolist() for k in range(WINDOW // 2 + 1)],
        "long": wide_weights().tolist(),
        "spin": {"seconds": SPIN_WINDOW, "most": HALO, "degrees": DEGREES},
    }
    here = resources.files("ragg_runtime.compensation.export")
    return {
        **make_json(c),
        "chain.py": c.module,
        "derivative.json": json.dumps(slopes) + "\n",
        "ragg_model.py": here.joinpath("python", "ragg_model.py").read_text("utf-8"),
        **make_tests(c),
    }


def make_json(c: Contents) -> Files:
    """One document."""
    return {"model.json": json.dumps(c.document(), indent=1, ensure_ascii=False, allow_nan=False) + "\n"}


def make_tests(c: Contents) -> Files:
    """Two short motions with the model's answers; the second without angular acceleration but with encoders."""
    found = {}
    for name, derived in (("motion", False), ("derived_motion", True)):
        motion, outputs = c.example(derived=derived)
        columns = {f"{n} [{unit_of(n)}]": x for n, x in motion.items()}
        found[f"test/{name}.csv"] = format_csv(columns | {f"{n} [V]": x for n, x in outputs.items()})
    return found


def format_csv(columns: Mapping[str, NDArray[np.float64]]) -> str:
    """Columns as CSV with 17 digits."""
    rows = zip(*columns.values(), strict=True)
    return "\n".join([",".join(columns), *(",".join(f"{x:.17g}" for x in row) for row in rows)]) + "\n"


FORMS: Mapping[str, Callable[[Contents], Files]] = MappingProxyType(
    {"c": make_c, "numpy": make_numpy, "json": make_json}
)
"""Form of an export -> its files."""

MARK = ".ragg-export"
"""The file by which a folder is known as that of an export; what an earlier one wrote is replaced file by file."""


def write_export(c: Contents, folder: Path, form: str) -> list[Path]:
    """Write what is exported into a folder; the files. UserError if the folder holds anything else."""
    if form not in FORMS:
        raise UserError("unknown form of export", found=repr(form), expected=", ".join(FORMS))
    if folder.exists() and not folder.is_dir():
        raise UserError("the export needs a folder", where=folder, found="a file", remedy="name another one")
    if folder.is_dir() and any(folder.iterdir()) and not (folder / MARK).is_file():
        raise UserError(
            "the folder is not empty and was not made by an export",
            where=folder,
            remedy="name another folder, or empty this one",
        )
    files = FORMS[form](c)
    written = []
    for name, text in {MARK: "\n".join(sorted(files)) + "\n", **files}.items():
        place = folder / name
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UserError("the folder cannot be made", where=place.parent, found=error.strerror) from None
        write_text(place, text)
        written.append(place)
    return written
