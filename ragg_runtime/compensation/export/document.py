"""A model as one JSON document: everything that another program needs to rebuild or to read it."""

from __future__ import annotations

import json
from typing import Any

from ragg_runtime.compensation.export.contents import Contents, unit_of


def document(c: Contents) -> dict[str, Any]:
    """The model's description, its parameters with units, its inputs and outputs, and an example with its answer.

    An input of the column ``disc`` is made of the angle of the output's own disc.
    """
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
