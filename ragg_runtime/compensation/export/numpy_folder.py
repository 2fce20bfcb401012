"""A model as a folder that runs with NumPy alone, as one JSON document, and how the folder of an export is written."""

from __future__ import annotations

import json
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from ragg_runtime.base.errors import UserError
from ragg_runtime.base.files import write_text
from ragg_runtime.compensation.export.contents import Contents, unit_of
from ragg_runtime.compensation.export.program import example_files
from ragg_runtime.io.angular_acceleration import wide_weights
from ragg_runtime.model.record import HALO, SPIN_WINDOW
from ragg_runtime.signals.derivative import DEGREES, WINDOW, weights


def numpy_files(c: Contents) -> dict[str, str]:
    """File name -> text."""
    short = [[float(x) for x in weights(WINDOW, k)] for k in range(WINDOW // 2 + 1)]
    slopes = {
        "short": short,
        "long": [float(x) for x in wide_weights()],
        "spin": {"seconds": SPIN_WINDOW, "most": HALO, "degrees": DEGREES},
    }
    program = (
        resources.files("ragg_runtime.compensation.export")
        .joinpath("python", "ragg_model.py")
        .read_text("utf-8")
    )
    return {
        **json_files(c),
        "chain.py": c.module,
        "derivative.json": json.dumps(slopes) + "\n",
        "ragg_model.py": program,
        **example_files(c),
    }


def document(c: Contents) -> dict[str, Any]:
    """The model's description, its parameters with units, its inputs and outputs, and an example with its answer."""
    motion, answers = c.example()
    outputs = [
        {
            "name": o.name,
            "unit": "V",
            "is": o.formula,
            "accelerometers": list(o.members),
            "signs": list(o.signs),
            "spin_angle": o.angle_column,
            "spin_frequency": float(c.p[o.spin]),
            "scale_factor": {"value": o.scale_factor, "unit": "V/Eo"},
        }
        for o in c.outputs()
    ]
    return {
        "model": c.name,
        "origin": c.origin,
        "derivation": c.model.digest,
        "angle_origin": c.instrument.angle_origin or "zero",
        "g0": {"value": c.instrument.g0, "unit": "m/s^2"},
        "effects": [
            {"id": e.id, "title": e.title, "physics": e.physics, "equation": e.equation, "source": e.source}
            for e in c.model.effects
        ],
        "parameters": [
            {"name": v.name, "unit": v.unit, "meaning": v.meaning, "values": [float(x) for x in v.values]}
            for v in c.values()
        ],
        "inputs": [
            {"name": x.name, "column": x.column, "derivative": x.derivative, "unit": unit_of(x.column)}
            for x in c.inputs()
        ],
        "outputs": outputs,
        **({"output": outputs[0], "scale_factor": outputs[0]["scale_factor"]} if len(outputs) == 1 else {}),
        "calibration": None if c.calibration is None else dict(c.calibration),
        "example": {
            "columns": {n: [float(x) for x in values] for n, values in motion.items()},
            **{n: [float(x) for x in answer] for n, answer in answers.items()},
        },
    }


def json_files(c: Contents) -> dict[str, str]:
    """File name -> text."""
    return {"model.json": json.dumps(document(c), indent=1, ensure_ascii=False, allow_nan=False) + "\n"}


MARK = ".ragg-export"
"""The file by which a folder is known as that of an export; what an earlier one wrote is replaced file by file."""


def write_folder(folder: Path, files: Mapping[str, str]) -> list[Path]:
    """Write text files into the folder; UserError if it holds anything else."""
    if folder.exists() and not folder.is_dir():
        raise UserError("the export needs a folder", where=folder, found="a file", remedy="name another one")
    if folder.is_dir() and any(folder.iterdir()) and not (folder / MARK).is_file():
        raise UserError(
            "the folder is not empty, and not that of an export",
            where=folder,
            remedy="name another folder, or empty this one",
        )
    written = []
    for name, text in {MARK: "\n".join(sorted(files)) + "\n", **files}.items():
        place = folder / name
        if place.is_symlink() or (place.parent != folder and place.parent.is_symlink()):
            raise UserError(
                "a link stands where the export is to be written",
                where=place,
                remedy="name another folder, or remove the link",
            )
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UserError("the folder cannot be made", where=place.parent, found=error.strerror) from None
        write_text(place, text)
        written.append(place)
    return written
