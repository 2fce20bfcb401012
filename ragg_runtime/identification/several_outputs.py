"""Several outputs of one instrument together: the error of each, the tensor of all, and where they disagree."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from ragg_runtime.base.errors import UserError
from ragg_runtime.estimation import regressors
from ragg_runtime.estimation.fitted import Fitted
from ragg_runtime.estimation.observation import Observation, combine_output, segments
from ragg_runtime.estimation.scores import channels, measure_error
from ragg_runtime.instrument.units import EOTVOS
from ragg_runtime.io.record import GRADIENT
from ragg_runtime.model.evaluate import voltages
from ragg_runtime.model.recorded import put_on_carriers
from ragg_runtime.signals.demodulate import low_pass
from ragg_runtime.signals.tensor import Tensor, spread_across, tensor

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Seen:
    """The gradient as one output saw it: time (N,) s, inline and cross (N,) Eo, and their noise, Eo."""

    place: int
    time: Array
    inline: Array
    cross: Array
    inline_std: float
    cross_std: float


@dataclass(frozen=True)
class Together:
    """One flight's outputs side by side: its name, and the gradient by each output of a turning disc."""

    name: str
    fitted: Fitted
    seen: tuple[Seen, ...]

    @cached_property
    def common(self) -> Array:
        """(N,) s: where all outputs have a value."""
        found = self.seen[0].time
        for s in self.seen[1:]:
            found = np.intersect1d(found, s.time)
        return np.asarray(found)

    def at(self, s: Seen) -> tuple[Array, Array]:
        """Inline and cross of an output where all have a value."""
        here = np.isin(s.time, self.common)
        return s.inline[here], s.cross[here]

    @cached_property
    def tensor(self) -> Tensor | None:
        """The gravity gradient tensor in the measurement frame, Eo; ``None`` where the discs do not determine it."""
        layout = self.fitted.instrument.layout
        if not len(self.common):
            return None
        rows: list[Array] = []
        std: list[float] = []
        axes = []
        for s in self.seen:
            rows.extend(self.at(s))
            std += [s.inline_std, s.cross_std]
            axes.append(layout.discs[layout.outputs[s.place].disc].across)
        try:
            return tensor(axes, np.array(rows), np.array(std))
        except UserError:
            return None

    def differences(self) -> list[dict[str, object]]:
        """Complements on one disc: what differs between them is noise, half of its variance of each."""
        layout = self.fitted.instrument.layout
        found: list[dict[str, object]] = []
        for a, b in combinations(self.seen, 2):
            if layout.outputs[a.place].disc != layout.outputs[b.place].disc or not len(self.common):
                continue
            inline, cross = (x - y for x, y in zip(self.at(a), self.at(b), strict=True))
            found.append(
                {
                    "outputs": [layout.outputs[a.place].name, layout.outputs[b.place].name],
                    "inline_Eo": float(np.std(inline) / np.sqrt(2)),
                    "cross_Eo": float(np.std(cross) / np.sqrt(2)),
                    "expected_inline_Eo": float(np.hypot(a.inline_std, b.inline_std) / np.sqrt(2)),
                    "expected_cross_Eo": float(np.hypot(a.cross_std, b.cross_std) / np.sqrt(2)),
                }
            )
        return found

    def as_json(self) -> dict[str, object]:
        figures: dict[str, object] = {"flight": self.name, "noise_between_complements": self.differences()}
        t = self.tensor
        if t is not None:
            figures["tensor"] = {
                "mean_Eo": [float(x) for x in np.mean(t.gamma, axis=1)],
                "std_Eo": [float(x) for x in t.std],
                "closure": t.quality,
            }
        return figures


def compare_outputs(f: Fitted) -> list[Together]:
    """Of every flight with several turning outputs what they saw."""
    found = []
    for first, last in pairwise([*f.first, len(f.observations)]):
        own = [n for n in range(first, last) if f.observations[n].record.turning]
        seen = tuple(s for s in (estimate_gradient(f, n) for n in own) if len(s.time))
        if len(seen) > 1:
            found.append(Together(name=f.observations[first].flight_name, fitted=f, seen=seen))
    return found


def estimate_gradient(f: Fitted, n: int) -> Seen:
    """What an observation's output saw of the gradient: all that the calibrated model explains is taken out but it."""
    o, k_ggi = f.observations[n], f.scales[n]
    rows = [s.rows for s in segments(len(o.record.time))]
    left = np.concatenate([_without_motion(f, o.part(some)) for some in rows])
    time, inline, cross = channels(left, o.record, k_ggi, o.record.valid)
    if len(
        time
    ):  # what the instrument makes of this gradient differs from what an ideal one does, by its angles above all
        g = [np.interp(o.record.time, time, x) for x in (inline, cross)]
        off = [_beyond_ideal(f, o.part(some), g[0][some], g[1][some], k_ggi) for some in rows]
        time, inline, cross = channels(left - np.concatenate(off), o.record, k_ggi, o.record.valid)
    rate = o.record.rate
    psd = f.prepared[n].noise_psd(np.array([2 * abs(o.record.spin_frequency)]))
    noise = float(np.sqrt(float(psd[0]) * rate * np.sum(low_pass(rate) ** 2))) / k_ggi
    return Seen(place=o.place, time=time, inline=inline, cross=cross, inline_std=2 * noise, cross_std=noise)


def _without_motion(f: Fitted, o: Observation) -> Array:
    return combine_output(o, np.where(o.record.valid, o.data - _predicted(f, o, {}), 0.0))


def _beyond_ideal(f: Fitted, o: Observation, inline: Array, cross: Array, k_ggi: float) -> Array:
    """What the model makes of a gradient, Eo, in the output, less what an ideal instrument would, (N,) V."""
    axes = f.instrument.layout.discs[o.output.disc].across
    seen = spread_across(axes, inline, cross)
    wide = dict(zip(GRADIENT, (np.pad(EOTVOS * x, o.record.halo, mode="edge") for x in seen), strict=True))
    response = combine_output(o, _predicted(f, o, wide) - _predicted(f, o, {}))
    ideal = o.recorded.through(put_on_carriers(inline, cross, o.record, k_ggi), o.record)
    return np.where(o.record.valid, response - ideal, 0.0)


def _predicted(f: Fitted, o: Observation, gradient: Mapping[str, Array]) -> Array:
    """What the calibrated model predicts of what is observed, of another gradient than was recorded."""
    wide = {name: x for name, x in o.record.wide.items() if name not in GRADIENT} | dict(gradient)
    other = replace(o.record, wide=wide)
    volts = voltages(f.model.chain, other, f.calibration.p, o.output)
    return regressors.observe_voltages(replace(o, record=other), volts, None)


def errors(f: Fitted, residuals: Sequence[Array]) -> list[dict[str, object]]:
    """The error object of every output of every flight."""
    return [
        {"observation": o.name, "output": o.output.name, **measure_error(e, o.record, k).as_json()}
        for o, e, k in zip(f.observations, residuals, f.scales, strict=True)
    ]
