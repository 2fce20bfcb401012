"""Settings of a model file that no instrument has."""

from __future__ import annotations

from ragg_runtime.base.errors import UserError, at, did_you_mean
from ragg_runtime.instrument.instrument import Instrument
from ragg_runtime.model.model import Model


def check_settings(model: Model, instrument: Instrument) -> None:
    """UserError if model.toml gives an effect a parameter that it does not have, or one of a wrong dimension."""
    for e in model.effects:
        setting = instrument.effect(e.id)
        if setting is None:
            continue
        names = {q.name: q for q in e.parameters}
        for name in setting.values:
            if name not in names:
                raise UserError(
                    f"the effect {e.id} has no parameter {name!r}",
                    where=at(instrument.path, "effects", e.id),
                    expected="one of " + ", ".join(names),
                    remedy=did_you_mean(name, names),
                )
            q = names[name]
            where = str(instrument.path) if instrument.path else None
            si_unit = instrument.units.base_unit(q.unit)
            setting.si(
                name, si_unit, instrument.g0, shared=q.shared, where=where, count=instrument.layout.size
            )
