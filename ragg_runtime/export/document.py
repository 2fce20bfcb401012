"""A model as one JSON document: everything that another program needs to rebuild or to read it."""

from __future__ import annotations

import json
from typing import Any

from ragg_runtime.base.form_version import Form
from ragg_runtime.export.contents import Contents, unit_of

FORM = Form("the exported model")


def document(c: Contents) -> dict[str, Any]:
    """The model's description, its parameters with units, its inputs, and an example with its answer."""
    motion, G = c.example()
    return {
        **FORM.stamp(),
        "model": c.name,
        "origin": c.origin,
        "derivation": c.model.digest,
        "g0": {"value": c.instrument.g0, "unit": "m/s^2"},
        "scale_factor": {"value": c.scale_factor, "unit": "V/Eo"},
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
        "output": {"name": "G_out", "unit": "V", "is": "V_1 + V_2 - V_3 - V_4"},
        "calibration": None if c.calibration is None else dict(c.calibration),
        "example": {
            "columns": {n: [float(x) for x in values] for n, values in motion.items()},
            "G_out": [float(x) for x in G],
        },
    }


def json_files(c: Contents) -> dict[str, str]:
    """File name -> text."""
    return {"model.json": json.dumps(document(c), indent=1, ensure_ascii=False, allow_nan=False) + "\n"}
