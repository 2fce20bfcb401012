"""What an oracle would see of a hidden effect: a likelihood ratio with that effect alone added to the model, nothing searched for.

An effect that is hidden at so many sigmas on the effect-free flight need not show them in the flight itself. The oracle
knows which effect it is, at which instant, all others that are hidden (they are in both models), and the noise of the effect-free
flight of the same seed. Both models are calibrated from the sheet, nonlinearly. What it gains in chi-square, with as many
degrees of freedom as the effect has parameters that the record then knows, is more than a search of the catalogue can:
where it is below what the search asks of an effect whose parameters are all tried at once, nothing was there to be found.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from benchmarks.diagnosis import fly
from benchmarks.diagnosis.inject import Hidden
from ragg_runtime.base import false_alarms
from ragg_runtime.fit import calibrate, observation
from ragg_runtime.fit.calibrate import Calibration
from ragg_runtime.fit.fitted import Fitted
from ragg_runtime.fit.significance import log_sf
from ragg_runtime.fit.switching import certain
from ragg_runtime.model import model as load
from ragg_runtime.model_dir import derive

MODELLED = ("deterministic", "step")
"""Kinds of effects that can be in a model."""


def seen(p: fly.Prepared) -> list[dict[str, float] | None]:
    """Of each hidden effect what adding it gains; ``None`` of one that no model can hold (random, of the recorder)."""
    model = load.packaged()
    kinds = {e.id: e.kind for e in model.candidates}
    held = [h for h in p.hidden if kinds[h.effect] in MODELLED]
    with_all = _fitted(p, held)
    return [
        _gain(with_all, _fitted(p, [o for o in held if o is not h]), h.effect) if h in held else None
        for h in p.hidden
    ]


def gain(
    f: Fitted, hidden: Sequence[str], instants: Mapping[str, float], effect: str
) -> dict[str, float] | None:
    """The same of a flight that is fitted, with the noise that was estimated there: no candidate is in that."""
    known = {e.id: e.kind for e in f.model.candidates}
    if known[effect] not in MODELLED or any(known[e] not in MODELLED for e in hidden):
        return None

    def fitted(ids: Sequence[str]) -> Calibration:
        sheet = fly._with_instants(f.instrument, {e: t for e, t in instants.items() if e in ids})
        model = derive.with_effects(sheet, f.model, ids) if ids else replace(f.model, candidates=())
        return calibrate.fit(model, sheet, certain(model, sheet, f.observations), noise=f.calibration.noise)

    return _gain(fitted(hidden), fitted([e for e in hidden if e != effect]), effect)


def _fitted(p: fly.Prepared, hidden: Sequence[Hidden]) -> Calibration:
    model, sheet = load.packaged(), p.scenario.sheet
    ids = [h.effect for h in hidden]
    sheet = fly._with_instants(sheet, {h.effect: h.instant for h in hidden if h.instant is not None})
    model = derive.with_effects(sheet, model, ids) if ids else replace(model, candidates=())
    observations = certain(model, sheet, [observation.observe(p.flight, sheet)])
    return calibrate.fit(model, sheet, observations, noise=[p.bench.noise])


def _gain(with_it: Calibration, without: Calibration, effect: str) -> dict[str, float]:
    own = [n for n, q in enumerate(with_it.columns) if q.effect == effect]
    information = np.linalg.inv(with_it.covariance[np.ix_(own, own)]) - np.eye(
        len(own)
    )  # without the prior's
    rank = max(1, int(np.sum(np.linalg.eigvalsh(information) > 1.0)))
    chi2 = max(0.0, without.chi2 - with_it.chi2)
    return {"chi2": chi2, "rank": rank, "log_p": max(log_sf(chi2, rank), -1e9)}


def detectable(x: Mapping[str, object], catalogue: int) -> bool:
    """Whether the oracle sees every hidden effect at the level at which one of the catalogue is claimed."""
    found = x.get("oracle")
    if not isinstance(found, list):
        return True
    levels = (false_alarms.CATALOGUE, *(false_alarms.COMPANION,) * len(found))
    ordered = sorted(g["log_p"] for g in found if g is not None)
    return all(p + np.log(catalogue) < np.log(level) for p, level in zip(ordered, levels, strict=False))
