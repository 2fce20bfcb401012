"""An instrument that was drawn, as the model.toml that describes it."""

from __future__ import annotations

from typing import Any

import tomlkit

from ragg_runtime.instrument.edit_toml import add_effect, plain_number, quantity_table
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.instrument.layout import Layout
from ragg_runtime.instrument.parameters import DISC_UNITS, PARAMETER, PARAMETERS
from ragg_runtime.instrument.units import RawQuantity


def model_text(instrument: Instrument) -> str:
    """A whole model.toml for an instrument, in display units; reads back to the same SI numbers."""
    layout, form = instrument.layout, instrument.form
    document: dict[str, Any] = {"effects": []}
    if not layout.of_paper:
        document["g0"] = f"{instrument.g0!r} m/s^2"
    document["model"] = {"kinematics": form.kinematics, "order": form.preset or dict(form.order)}
    if instrument.angle_origin is not None:
        document["model"]["angle_origin"] = instrument.angle_origin
    if instrument.demodulation is not None:
        document["demodulator"] = dict(instrument.demodulation.entries())
    if layout.of_paper:
        document["disc"] = {n: f"{getattr(instrument, n)!r} {unit}" for n, unit in DISC_UNITS.items()}
    else:
        document["disc"] = _discs(layout)
    document["accelerometers"] = accelerometers = {}
    for p in PARAMETERS:
        accelerometers[p.name] = entry = quantity_table(
            RawQuantity(_shortest(p.name, instrument), p.display_unit)
        )
        if p.name in instrument.sigmas:
            sigma = instrument.units.from_si(instrument.sigmas[p.name], p.si_unit, p.display_unit)
            entry.add("sigma", [plain_number(v) for v in sigma])
    text = tomlkit.dumps(document)
    for setting in instrument.effects:
        text = add_effect(text, setting)
    return text


def _discs(layout: Layout) -> list[dict[str, Any]]:
    discs: list[dict[str, Any]] = [
        {
            "name": d.name,
            "spin_frequency": f"{d.spin_frequency!r} Hz",
            "axis": list(d.axis),
            "zero": list(d.zero),
            "accelerometer": [],
        }
        for d in layout.discs
    ]
    for p in layout.places:
        place: dict[str, Any] = {"name": p.name, "angle": f"{p.angle!r} rad", "radius": f"{p.radius!r} m"}
        place |= {"height": f"{p.height!r} m", "direction": list(p.direction)}
        place |= {"sign": p.sign, "output": layout.output_names[p.output]}
        discs[p.disc]["accelerometer"].append(place)
    return discs


def _shortest(name: str, instrument: Instrument) -> tuple[float, ...]:
    """Values in the display unit with the fewest digits that still convert to the instrument's SI values."""
    p, known = PARAMETER[name], instrument.units
    target = instrument.accelerometers[name]
    result = []
    for value, si in zip(known.from_si(target, p.si_unit, p.display_unit), target, strict=True):
        near = (float(f"{value:.{digits}g}") for digits in (6, 9, 12, 15, 16, 17))
        result.append(
            next((v for v in near if known.to_si(v, p.display_unit, p.si_unit) == si), float(value))
        )
    return tuple(result)
