"""An instrument of the paper's layout that was drawn, as the model.toml that describes it."""

from __future__ import annotations

from typing import Any

import tomlkit

from ragg_runtime.instrument.instrument import DISC_UNITS, PARAMETERS, Instrument


def model_text(instrument: Instrument) -> str:
    """A model.toml in SI, which reads back to the same numbers; effects are left out."""
    document: dict[str, Any] = {
        "effects": [],
        "model": {"kinematics": instrument.form.kinematics, "order": instrument.form.preset},
        "disc": {n: f"{getattr(instrument, n)!r} {unit}" for n, unit in DISC_UNITS.items()},
        "accelerometers": {},
    }
    if instrument.demodulation is not None:
        document["demodulator"] = dict(instrument.demodulation.entries())
    for p in PARAMETERS:
        entry = {"value": instrument.accelerometers[p.name].tolist(), "unit": p.si_unit}
        if p.name in instrument.sigmas:
            entry["sigma"] = instrument.sigmas[p.name].tolist()
        document["accelerometers"][p.name] = entry
    return tomlkit.dumps(document)
