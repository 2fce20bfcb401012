"""Effects beyond the paper's model, injected into the numerical reference in full, nonlinear form, by stages."""

from __future__ import annotations

from ragg_runtime.reference.effects.catalogue import (
    CATALOGUE,
    EffectValues,
    Injected,
    InjectedParameter,
    channels_needed,
    resolve,
)

__all__ = ["CATALOGUE", "EffectValues", "Injected", "InjectedParameter", "channels_needed", "resolve"]
